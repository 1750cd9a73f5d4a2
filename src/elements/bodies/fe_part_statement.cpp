#include "elements/bodies/fe_part_statement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "dataset/characters.h"
#include "elements/bodies/fe_part_rows.h"
#include "flexible/rotation_field.h"

namespace dynalin {

namespace {

double at(const std::vector<double>& list, std::size_t k, double unstated) {
  return list.empty() ? unstated : list.size() == 1 ? list.front() : list[k];
}

// The type as a word; the lexer takes 3D for an angle, so that blanks may have come between.
bool is_type(const std::string& written, std::string_view name) {
  std::string text;
  for (const char c : written) {
    if (c != ' ') text += c;
  }
  return equal_ignoring_case(text, name);
}

struct PlaneType {
  std::string_view name;
  BeamPlane plane;
};
constexpr std::array<PlaneType, 3> plane_types = {
    {{"2DBEAMXY", {0, 1, 2}}, {"2DBEAMYZ", {1, 2, 0}}, {"2DBEAMZX", {2, 0, 1}}}};

bool takes_type(FePart& f, ElementReader& reader) {
  f.plane.reset();
  if (is_type(f.type, "3DBEAM")) return true;
  for (const auto& [name, plane] : plane_types) {
    if (!is_type(f.type, name)) continue;
    f.type = name, f.plane = plane;
    return true;
  }
  reader.error("unknown-word", reader.at("TYPE"),
               fmt::format("TYPE is 3DBEAM, 2DBEAMXY, 2DBEAMYZ or 2DBEAMZX, not {}", f.type));
  return false;
}

// Places and sections, each in one of its two forms.
bool states_what_it_needs(ElementReader& reader) {
  bool ok = true;
  for (const auto& [argument, rows] : {std::pair{"NODE_LABELS", "COORDINATES"},
                                       {"X", "COORDINATES"},
                                       {"AREA", "SECTION"},
                                       {"IYY", "SECTION"},
                                       {"IZZ", "SECTION"}}) {
    if (reader.given(argument) || reader.given(rows)) continue;
    reader.error("missing-argument", reader.statement().at,
                 fmt::format("{} needs {}, or {}", reader.label().text(), argument, rows));
    ok = false;
  }
  return ok;
}

bool has_one_damping(const FePart& f, ElementReader& reader) {
  const std::string name = reader.label().text();
  if (f.damping_by_mass.value_or(0) > 0) {
    reader.error("argument-not-built", reader.at("CRATIOM"),
                 fmt::format("CRATIOM of {} is not available: what damping by mass does is not published", name),
                 "CRATIOK is damping by stiffness");
    return false;
  }
  if (!reader.given("CRATIO") || !reader.given("CRATIOK")) return true;
  reader.error("excluded-arguments", reader.at("CRATIO"), fmt::format("CRATIOK and CRATIO of {} state the same", name),
               "leave one of them out");
  return false;
}

bool has_labels(const FePart& f, ElementReader& reader) {
  const std::size_t n = f.numbers.size();
  const std::string name = reader.label().text();
  if (n < 2) {
    reader.error("wrong-count", reader.at(reader.given("NODE_LABELS") ? "NODE_LABELS" : "COORDINATES"),
                 fmt::format("{} has {} node, it needs two or more", name, n));
    return false;
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (std::count(f.numbers.begin(), f.numbers.end(), f.numbers[k]) == 1 && f.numbers[k] > 0) continue;
    reader.error("value-out-of-range", reader.at("NODE_LABELS"),
                 fmt::format("NODE_LABELS of {} are positive numbers, each once: {}", name, f.numbers[k]));
    return false;
  }
  return true;
}

bool has_counts(const FePart& f, ElementReader& reader) {
  const std::size_t n = f.numbers.size();
  const std::string name = reader.label().text();
  bool ok = true;
  for (const Argument<FePart>& a : FePart::arguments) {
    const auto* list = std::get_if<std::vector<double> FePart::*>(&a.slot);
    if (!list || is_rows(a.name) || (f.**list).size() <= 1 || (f.**list).size() == n) continue;
    reader.error("wrong-count", reader.at(a.name),
                 fmt::format("{} has {} values, {} has {} nodes", a.name, (f.**list).size(), name, n),
                 "one value for each node, or one for all");
    ok = false;
  }
  return ok;
}

bool has_sections(const FePart& f, ElementReader& reader) {
  const std::string name = reader.label().text();
  for (const auto& [word, list] : {std::pair{"AREA", &f.area},
                                   {"IXX", &f.torsion},
                                   {"IYY", &f.yy},
                                   {"IZZ", &f.zz},
                                   {"ASY", &f.shear_y},
                                   {"ASZ", &f.shear_z}}) {
    // A row has it whether or not the beam twists.
    if (list == &f.torsion && f.plane && reader.given("SECTION")) continue;
    for (std::size_t k = 0; k < list->size(); ++k) {
      if ((*list)[k] > 0) continue;
      reader.error("value-out-of-range", stated_at(f, word, k, reader),
                   fmt::format("{} of {} is {:g}, it must be positive", word, name, (*list)[k]));
      return false;
    }
  }
  for (std::size_t k = 0; k < f.numbers.size(); ++k) {
    const BeamSection s = section_of(f, k);
    if (s.yz * s.yz < s.yy * s.zz) continue;
    reader.error("value-out-of-range", stated_at(f, "IYZ", k, reader),
                 fmt::format("IYZ of {} is {:g}, its square must be below IYY times IZZ", name, s.yz));
    return false;
  }
  return true;
}

bool lies_along_its_nodes(const FePart& f, ElementReader& reader) {
  constexpr double steepest = 0.5;  // cos 60 degrees
  const std::string name = reader.label().text();
  for (std::size_t k = 0; k + 1 < f.numbers.size(); ++k) {
    const Vector chord = place_of_node(f, k + 1) - place_of_node(f, k);
    const double l = norm(chord);
    if (!(l > 0)) {
      reader.error("value-out-of-range", stated_at(f, "X", k + 1, reader),
                   fmt::format("nodes {} and {} of {} are at one place", f.numbers[k], f.numbers[k + 1], name));
      return false;
    }
    for (const std::size_t node : {k, k + 1}) {
      if (dot(axes_of_node(f, node).x, chord) >= steepest * l) continue;
      reader.error("value-out-of-range", stated_at(f, "PSI", node, reader),
                   fmt::format("the x axis of node {} of {} must lead from node {} to node {}", f.numbers[node], name,
                               f.numbers[k], f.numbers[k + 1]),
                   reader.given("COORDINATES")
                       ? "the last three numbers of each node are the 3-1-3 angles of its axes in the BCS"
                       : "PSI, THETA and PHI are angles of the axes of nodes in the BCS, 0 unless stated");
      return false;
    }
  }
  return true;
}

bool lies_in_its_plane(const FePart& f, ElementReader& reader) {
  constexpr double out_of_plane = 1e-6;
  static constexpr std::array<std::string_view, 3> normals = {"x", "y", "z"};
  const std::string name = reader.label().text();
  const auto error = [&](const Span& at, const std::string& what) {
    reader.error("value-out-of-range", at,
                 fmt::format("{} of {} must lie in a plane across the global {} axis: its TYPE is {}", what, name,
                             normals[f.plane->normal], f.type),
                 "QG, REULER, ZG and XG place the BCS; a 3DBEAM lies as it will");
  };
  for (std::size_t k = 0; k < f.numbers.size(); ++k) {
    const Vector from_first = f.axes * (place_of_node(f, k) - place_of_node(f, 0));
    if (std::abs(from_first[f.plane->normal]) > out_of_plane * norm(from_first)) {
      error(stated_at(f, "X", k, reader), fmt::format("nodes {} and {}", f.numbers[0], f.numbers[k]));
      return false;
    }
    if (std::abs((f.axes * axes_of_node(f, k).x)[f.plane->normal]) > out_of_plane) {
      const bool has_angles = reader.given("PSI") || reader.given("COORDINATES");
      error(has_angles ? stated_at(f, "PSI", k, reader) : reader.at("TYPE"),
            fmt::format("the x axis of node {}", f.numbers[k]));
      return false;
    }
  }
  return true;
}

void warn_of_unused(ElementReader& reader) {
  std::vector<std::string_view> unused;
  for (const std::string_view name : {"IXX", "ASY", "ASZ"}) {
    if (reader.given(name)) unused.push_back(name);
  }
  if (unused.empty()) return;
  reader.warning("passed-over", reader.at(unused.front()),
                 fmt::format("{} of {} {} no influence: a beam in a plane neither twists nor shears",
                             fmt::join(unused, ", "), reader.label().text(), unused.size() == 1 ? "has" : "have"));
}

// Initial velocities out of the plane, in axes that are known while the statement is read.
void warn_of_velocities_across(const FePart& f, ElementReader& reader) {
  constexpr double part_across = 1e-9;
  const Vector v{f.vx.value_or(0), f.vy.value_or(0), f.vz.value_or(0)};
  const Vector w = f.axes * Vector{f.wx.value_or(0), f.wy.value_or(0), f.wz.value_or(0)};
  Vector in_plane = w;
  in_plane[f.plane->normal] = 0;
  const auto warn = [&](std::initializer_list<std::string_view> names, std::string_view which) {
    const auto first = std::find_if(names.begin(), names.end(), [&](std::string_view n) { return reader.given(n); });
    reader.warning("passed-over", reader.at(*first),
                   fmt::format("the initial {} of {} has no influence: {} keeps to its plane", which,
                               reader.label().text(), f.type));
  };
  constexpr std::array<std::string_view, 3> along = {"VX", "VY", "VZ"};
  if (!f.vm.valid() && std::abs(v[f.plane->normal]) > part_across * norm(v))
    warn({along[f.plane->normal]}, "velocity across the plane");
  if (!f.wm.valid() && norm(in_plane) > part_across * norm(w))
    warn({"WX", "WY", "WZ"}, "angular velocity along the plane");
}

}  // namespace

Matrix3 axes_of_node(const FePart& f, std::size_t k) {
  const auto about = [](double angle, const Vector& axis) { return rotation::exponential(angle * axis); };
  // From −π to π, where the series of the exponential is exact.
  const auto angle = [&](const std::vector<double>& list) {
    return std::remainder(at(list, k, 0), 2 * 3.14159265358979323846);
  };
  return about(angle(f.psi), {0, 0, 1}) * about(angle(f.theta), {1, 0, 0}) * about(angle(f.phi), {0, 0, 1});
}
Vector place_of_node(const FePart& f, std::size_t k) { return {at(f.x, k, 0), at(f.y, k, 0), at(f.z, k, 0)}; }

BeamSection section_of(const FePart& f, std::size_t k) {
  const double yy = at(f.yy, k, 0), zz = at(f.zz, k, 0);
  return {at(f.area, k, 0),      at(f.torsion, k, yy + zz), yy, zz, at(f.yz, k, 0),
          at(f.shear_y, k, 1.2), at(f.shear_z, k, 1.2)};
}

bool describes_beam(FePart& f, ElementReader& reader) {
  return states_what_it_needs(reader) && has_one_damping(f, reader) && takes_type(f, reader) &&
         labels_nodes(f, reader) && has_labels(f, reader) && take_rows(f, reader) && has_counts(f, reader) &&
         has_sections(f, reader) && lies_along_its_nodes(f, reader);
}

void check_plane(const FePart& f, ElementReader& reader) {
  if (!lies_in_its_plane(f, reader)) return;
  warn_of_unused(reader);
  warn_of_velocities_across(f, reader);
}

}  // namespace dynalin
