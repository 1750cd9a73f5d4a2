// FE_PART/id, TYPE=3DBEAM, MATERIAL=, NODE_LABELS=, X= [, Y=, Z=, PSI=, THETA=, PHI=], AREA=, IYY=, IZZ= [, IYZ=, IXX=,
// ASY=, ASZ=, CRATIO=, QG=, {REULER= | ZG=, XG=}, VX= … WZ=, VM=, WM=]
//
// A beam with mass that may bend, twist, stretch and shear as far as it will: a geometrically exact beam between nodes
// that have positions, axes and slopes of their own (flexible/beam_element.h). Nodes are stated in the BCS, undeformed,
// with the x axis along the line of centroids. A list of numbers has one for each node, or one for all.
#include "elements/bodies/fe_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dataset/characters.h"
#include "elements/families/beam_body.h"
#include "elements/families/orientation.h"
#include "elements/settings/material.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct FePart {
  std::string type;
  std::optional<std::int64_t> material;
  std::vector<std::int64_t> numbers;
  std::vector<double> x, y, z, psi, theta, phi;
  std::vector<double> area, torsion, yy, zz, yz, shear_y, shear_z;
  double damping = 0;
  Vector origin;
  std::optional<Vector> angles, z_point, x_point;
  std::optional<double> vx, vy, vz, wx, wy, wz;
  MarkerId vm, wm;
  Matrix3 axes = Matrix3::identity();
  ElementHandle made_of;
  Span material_at;
  std::vector<BeamElement> elements;
  std::vector<BodyId> nodes;

  static constexpr std::array<Argument<FePart>, 29> arguments = {{
      {.name = "TYPE", .slot = &FePart::type, .required = true, .help = "3DBEAM; the plane ones are not available"},
      {.name = "MATERIAL", .slot = &FePart::material, .required = true, .help = "the MATERIAL that it is made of"},
      {.name = "NODE_LABELS",
       .slot = &FePart::numbers,
       .required = true,
       .help = "numbers of the nodes, from end to end"},
      {.name = "X",
       .slot = &FePart::x,
       .required = true,
       .unit = unit::length,
       .help = "places of the nodes in the BCS"},
      {.name = "Y", .slot = &FePart::y, .unit = unit::length, .help = "the same along y; 0 unless stated"},
      {.name = "Z", .slot = &FePart::z, .unit = unit::length, .help = "the same along z; 0 unless stated"},
      {.name = "PSI",
       .slot = &FePart::psi,
       .unit = unit::angle,
       .help = "axes of the nodes in the BCS, 3-1-3 angles: about z"},
      {.name = "THETA", .slot = &FePart::theta, .unit = unit::angle, .help = "then about x"},
      {.name = "PHI", .slot = &FePart::phi, .unit = unit::angle, .help = "then about z"},
      {.name = "AREA", .slot = &FePart::area, .required = true, .unit = "length²", .help = "of the section"},
      {.name = "IXX", .slot = &FePart::torsion, .unit = "length⁴", .help = "of torsion; IYY + IZZ unless stated"},
      {.name = "IYY", .slot = &FePart::yy, .required = true, .unit = "length⁴", .help = "integral of z²"},
      {.name = "IZZ", .slot = &FePart::zz, .required = true, .unit = "length⁴", .help = "integral of y²"},
      {.name = "IYZ", .slot = &FePart::yz, .unit = "length⁴", .help = "integral of y·z; 0 unless stated"},
      {.name = "ASY", .slot = &FePart::shear_y, .help = "area by that which carries shear along y; 1.2 unless stated"},
      {.name = "ASZ", .slot = &FePart::shear_z, .help = "the same along z"},
      {.name = "CRATIO",
       .slot = &FePart::damping,
       .unit = "time",
       .minimum = 0,
       .help = "damping by stiffness: stresses of strain rates; 0 unless stated"},
      {.name = "QG",
       .slot = &FePart::origin,
       .unit = unit::length,
       .help = "origin of the BCS",
       .start = StatedStart::place},
      {.name = "REULER",
       .slot = &FePart::angles,
       .unit = unit::angle,
       .help = "3-1-3 angles of the BCS",
       .ends = "ZG XG",
       .start = StatedStart::place},
      {.name = "ZG",
       .slot = &FePart::z_point,
       .unit = unit::length,
       .help = "global point on +z of the BCS",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "XG",
       .slot = &FePart::x_point,
       .unit = unit::length,
       .help = "global point in the x-z plane",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "VX",
       .slot = &FePart::vx,
       .unit = unit::velocity,
       .help = "initial velocity of the BCS, with which all moves as if rigid",
       .start = StatedStart::velocity},
      {.name = "VY",
       .slot = &FePart::vy,
       .unit = unit::velocity,
       .help = "the same along y",
       .start = StatedStart::velocity},
      {.name = "VZ",
       .slot = &FePart::vz,
       .unit = unit::velocity,
       .help = "the same along z",
       .start = StatedStart::velocity},
      {.name = "WX",
       .slot = &FePart::wx,
       .unit = unit::angular_velocity,
       .help = "initial angular velocity of the whole",
       .start = StatedStart::velocity},
      {.name = "WY",
       .slot = &FePart::wy,
       .unit = unit::angular_velocity,
       .help = "the same about y",
       .start = StatedStart::velocity},
      {.name = "WZ",
       .slot = &FePart::wz,
       .unit = unit::angular_velocity,
       .help = "the same about z",
       .start = StatedStart::velocity},
      {.name = "VM",
       .slot = &FePart::vm,
       .help = "axes of VX, VY, VZ; global by default",
       .start = StatedStart::velocity},
      {.name = "WM",
       .slot = &FePart::wm,
       .help = "axes of WX, WY, WZ; those of the BCS by default",
       .start = StatedStart::velocity},
  }};
};

double at(const std::vector<double>& list, std::size_t k, double unstated) {
  return list.empty() ? unstated : list.size() == 1 ? list.front() : list[k];
}

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

// The type as a word; the lexer takes 3D for an angle, so that blanks may have come between.
bool is_type(const std::string& written, std::string_view name) {
  std::string text;
  for (const char c : written) {
    if (c != ' ') text += c;
  }
  return equal_ignoring_case(text, name);
}

bool takes_type(const FePart& f, ElementReader& reader) {
  if (is_type(f.type, "3DBEAM")) return true;
  for (const std::string_view plane : {"2DBEAMXY", "2DBEAMYZ", "2DBEAMZX"}) {
    if (!is_type(f.type, plane)) continue;
    reader.error("argument-not-built", reader.at("TYPE"),
                 fmt::format("TYPE={} of {} is not available", plane, reader.label().text()),
                 "a 3DBEAM whose nodes are held in the plane by JPRIMs");
    return false;
  }
  reader.error("unknown-word", reader.at("TYPE"),
               fmt::format("TYPE is 3DBEAM, 2DBEAMXY, 2DBEAMYZ or 2DBEAMZX, not {}", f.type));
  return false;
}

bool has_counts(const FePart& f, ElementReader& reader) {
  const std::size_t n = f.numbers.size();
  const std::string name = reader.label().text();
  if (n < 2) {
    reader.error("wrong-count", reader.at("NODE_LABELS"), fmt::format("{} has {} node, it needs two or more", name, n));
    return false;
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (std::count(f.numbers.begin(), f.numbers.end(), f.numbers[k]) == 1 && f.numbers[k] > 0) continue;
    reader.error("value-out-of-range", reader.at("NODE_LABELS"),
                 fmt::format("NODE_LABELS of {} are positive numbers, each once: {}", name, f.numbers[k]));
    return false;
  }
  bool ok = true;
  for (const Argument<FePart>& a : FePart::arguments) {
    const auto* list = std::get_if<std::vector<double> FePart::*>(&a.slot);
    if (!list || (f.**list).size() <= 1 || (f.**list).size() == n) continue;
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
    for (const double v : *list) {
      if (v > 0) continue;
      reader.error("value-out-of-range", reader.at(word),
                   fmt::format("{} of {} is {:g}, it must be positive", word, name, v));
      return false;
    }
  }
  for (std::size_t k = 0; k < f.numbers.size(); ++k) {
    const BeamSection s = section_of(f, k);
    if (s.yz * s.yz < s.yy * s.zz) continue;
    reader.error("value-out-of-range", reader.at("IYZ"),
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
      reader.error("value-out-of-range", reader.at("X"),
                   fmt::format("nodes {} and {} of {} are at one place", f.numbers[k], f.numbers[k + 1], name));
      return false;
    }
    for (const std::size_t node : {k, k + 1}) {
      if (dot(axes_of_node(f, node).x, chord) >= steepest * l) continue;
      reader.error("value-out-of-range", reader.at("PSI"),
                   fmt::format("the x axis of node {} of {} must lead from node {} to node {}", f.numbers[node], name,
                               f.numbers[k], f.numbers[k + 1]),
                   "PSI, THETA and PHI are angles of the axes of nodes in the BCS, 0 unless stated");
      return false;
    }
  }
  return true;
}

class FePartSet final : public TypedSet<FePart> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    FePart& f = elements[k];
    if (!read_arguments(f, reader)) return;
    if (!takes_type(f, reader) || !has_counts(f, reader) || !has_sections(f, reader) ||
        !lies_along_its_nodes(f, reader))
      return;
    f.material_at = reader.at("MATERIAL");
    const auto made_of = reader.element("MATERIAL", {*f.material, f.material_at});
    if (!made_of) return;
    f.made_of = *made_of;
    const auto axes = orientation({f.angles, f.z_point, f.x_point, false, "REULER", "ZG", "XG"}, f.origin, reader);
    if (axes) f.axes = *axes;
  }

  // Markers and expressions ask for nodes: this runs before theirs.
  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      FePart& f = elements[k];
      const auto material = material_of(f, labels[k], model, diagnostics);
      if (!material) continue;
      f.elements.reserve(f.numbers.size() - 1);
      for (std::size_t e = 0; e + 1 < f.numbers.size(); ++e) {
        f.elements.emplace_back(*material, std::array{section_of(f, e), section_of(f, e + 1)},
                                place_of_node(f, e + 1) - place_of_node(f, e),
                                std::array{axes_of_node(f, e), axes_of_node(f, e + 1)});
      }
      add_nodes(f, labels[k], model);
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    return std::make_unique<BeamBodyKernel>(model, layout);
  }

 private:
  static std::optional<BeamMaterial> material_of(const FePart& f, const ElementLabel& label, const Model& model,
                                                 Diagnostics& diagnostics) {
    const MaterialData* m = material_data(model, f.made_of);
    if (!m) return std::nullopt;
    const std::string name = model.label(f.made_of).text();
    if (m->other.source) {
      diagnostics.error("argument-not-built", m->other,
                        fmt::format("{} is the material of {}, which takes DENSITY, YOUNGS_MODULUS and POISSONS_RATIO",
                                    name, label.text()));
      return std::nullopt;
    }
    if (!m->youngs_modulus || !m->poissons_ratio || !(m->density > 0) || !(*m->youngs_modulus > 0) ||
        !(*m->poissons_ratio > -1)) {
      diagnostics.error("missing-argument", f.material_at,
                        fmt::format("{} needs a DENSITY and a YOUNGS_MODULUS above 0 and a POISSONS_RATIO of {}",
                                    label.text(), name));
      return std::nullopt;
    }
    const double E = *m->youngs_modulus;
    return BeamMaterial{m->density / model.units.ucf, E, E / (2 * (1 + *m->poissons_ratio)), f.damping};
  }

  static void add_nodes(FePart& f, const ElementLabel& label, Model& model) {
    f.nodes.push_back(*model.find_body("FE_PART", label.id));
    for (std::size_t k = 1; k < f.numbers.size(); ++k) {
      f.nodes.push_back(BodyId{static_cast<std::int32_t>(model.bodies.size())});
      Body& body = model.bodies.emplace_back();
      body.label = label;
    }
    for (std::size_t k = 0; k < f.numbers.size(); ++k) {
      Body& body = model.bodies[static_cast<std::size_t>(f.nodes[k].index)];
      body.pose = {f.origin + f.axes * place_of_node(f, k), f.axes * axes_of_node(f, k)};
      for (std::size_t side = 0; side < 2; ++side) {  // the element before it, the one behind
        if (side == 0 ? k == 0 : k == f.elements.size()) continue;
        const BeamElement& e = f.elements[side == 0 ? k - 1 : k];
        body.mass += e.nodal_mass(1 - side);
        body.J_BC += e.nodal_inertia(1 - side);
      }
      body.user_mass = body.mass * model.units.ucf;
    }
  }
};

}  // namespace

std::array<std::int32_t, beam_coordinates> BeamBody::columns(const Layout& layout, std::size_t element) const {
  std::array<std::int32_t, beam_coordinates> list{};
  const auto put = [&](std::size_t first, std::int32_t column, std::int32_t count) {
    for (std::int32_t k = 0; k < count; ++k) list[first + static_cast<std::size_t>(k)] = column + k;
  };
  const auto outside = [&](std::size_t extra) {
    return layout.body_coordinate_count + static_cast<std::int32_t>(extra);
  };
  put(0, layout.body(nodes[element]).offset, 6);
  put(6, layout.body(nodes[element + 1]).offset, 6);
  put(12, outside(slope(element)), 3);
  put(15, outside(slope(element + 1)), 3);
  put(18, outside(middle(element)), 3);
  return list;
}

BeamMotion BeamBody::motion(const Motion& motion, std::size_t element) const {
  BeamMotion m;
  const auto three = [&](std::size_t extra) {
    return Vec3<Taylor>{motion.outside_poses(extra), motion.outside_poses(extra + 1), motion.outside_poses(extra + 2)};
  };
  const BodyMotion &one = motion.body(nodes[element]), &other = motion.body(nodes[element + 1]);
  m.chord = along_motion(other.r - one.r, other.rdot - one.rdot, other.rddot - one.rddot);
  m.acceleration = {one.rddot, other.rddot};
  m.axes = {one.axes(), other.axes()};
  m.slope = {three(slope(element)), three(slope(element + 1))};
  m.middle = three(middle(element));
  return m;
}

std::vector<BeamBody> beam_bodies(const Model& model) {
  std::vector<BeamBody> list;
  for (const auto& set : model.sets) {
    const auto* beams = dynamic_cast<const FePartSet*>(set.get());
    for (std::size_t k = 0; beams && k < beams->elements.size(); ++k) {
      const FePart& f = beams->elements[k];
      if (f.nodes.empty()) continue;
      BeamBody b{&beams->labels[k], f.nodes, f.numbers, &f.elements, {f.origin, f.axes}, {}, 0};
      b.velocity = {{f.vx, f.vy, f.vz}, {f.wx, f.wy, f.wz}, f.vm.valid() ? f.vm : global_frame, f.wm};
      list.push_back(std::move(b));
    }
  }
  return list;
}

std::vector<BeamBody> beam_bodies(const Model& model, const Layout& layout) {
  std::vector<BeamBody> list = beam_bodies(model);
  for (BeamBody& b : list) {
    for (const ExtraBlock& e : layout.extras) {
      if (same_element(e.label, *b.label)) b.first_extra = layout.extra_index(e.offset);
    }
  }
  return list;
}

std::vector<bool> beam_nodes(const Model& model) {
  std::vector<bool> is_node(model.bodies.size(), false);
  for (const BeamBody& b : beam_bodies(model)) {
    for (const BodyId node : b.nodes) is_node[static_cast<std::size_t>(node.index)] = true;
  }
  return is_node;
}

void start_beams(const Model& model, const Layout& layout, const Motion& motion, std::span<double> start) {
  for (const BeamBody& b : beam_bodies(model, layout)) {
    const auto along = [&](const std::array<std::optional<double>, 3>& stated, const Matrix3& axes) {
      Vector sum;
      for (std::size_t k = 0; k < 3; ++k) sum += stated[k].value_or(0) * axes[k];
      return sum;
    };
    const Vector v = along(b.velocity.of_cm, motion.axes(layout.marker(b.velocity.cm_axes)));
    const Vector w =
        along(b.velocity.angular,
              b.velocity.angular_axes.valid() ? motion.axes(layout.marker(b.velocity.angular_axes)) : b.drawn.R);
    const auto put = [&](std::int32_t at, const Vector& x) {
      for (std::size_t k = 0; k < 3; ++k) start[static_cast<std::size_t>(at) + k] = x[k];
    };
    for (std::size_t k = 0; k < b.nodes.size(); ++k) {
      const std::int32_t offset = layout.body(b.nodes[k]).offset;
      put(offset, v + cross(w, motion.body(b.nodes[k]).r - b.drawn.r));
      put(offset + 3, w);
      const std::size_t s = b.slope(k);
      put(layout.body_coordinate_count + static_cast<std::int32_t>(s),
          cross(w, Vector{motion.extra[s], motion.extra[s + 1], motion.extra[s + 2]}));
    }
  }
}

extern constinit const Kind fe_part = Kind{
    "FE_PART",
    "",
    "A beam with mass that bends, twists and stretches as far as it will.",
    Kind::Role::body,
    detail::argument_infos<FePart>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<FePartSet>(kind);
    }}.with_example("FE_PART/2, CRATIO=1E-4");

}  // namespace dynalin
