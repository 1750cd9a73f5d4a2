// PART/id, GROUND   or   PART/id, MASS=, CM=, IM=, IP=, QG=, {REULER= | ZG=, XG=}, VX= … WZ=, VM=, WM=, EXACT=,
// MATERIAL=
//
// A rigid body. IP holds Ixx, Iyy, Izz, Ixy, Ixz, Iyz with positive product integrals, so that the tensor has −Ixy …
// off its diagonal, about the origin and along the axes of IM (CM if IM is absent). Initial velocities are those of the
// CM along the axes of VM (global) and the angular velocity along those of WM (CM); a component that is not stated
// may change freely.
#include "elements/bodies/part.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "elements/families/inertia.h"
#include "elements/families/markers.h"
#include "elements/families/orientation.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct PartStatement {
  bool ground = false;
  double mass = 0;
  MarkerId cm, im, vm, wm;
  std::vector<double> ip;
  Vector origin;
  std::optional<Vector> angles, z_point, x_point;
  std::optional<double> vx, vy, vz, wx, wy, wz;
  std::vector<std::string> exact;
  std::string material;

  static constexpr std::array<Argument<PartStatement>, 19> arguments = {{
      {.name = "GROUND", .slot = &PartStatement::ground, .help = "this is the inertial body"},
      {.name = "MASS", .slot = &PartStatement::mass, .unit = unit::mass, .minimum = 0, .help = "0 unless stated"},
      {.name = "CM", .slot = &PartStatement::cm, .help = "marker at the centre of mass"},
      {.name = "IM", .slot = &PartStatement::im, .help = "marker that IP refers to, CM by default"},
      {.name = "IP", .slot = &PartStatement::ip, .unit = unit::inertia, .help = "Ixx, Iyy, Izz [, Ixy, Ixz, Iyz]"},
      {.name = "QG",
       .slot = &PartStatement::origin,
       .unit = unit::length,
       .help = "origin of the BCS",
       .start = StatedStart::place},
      {.name = "REULER",
       .slot = &PartStatement::angles,
       .unit = unit::angle,
       .help = "3-1-3 angles of the BCS",
       .ends = "ZG XG",
       .start = StatedStart::place,
       .unstated = 0},
      {.name = "ZG",
       .slot = &PartStatement::z_point,
       .unit = unit::length,
       .help = "global point on +z of the BCS",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "XG",
       .slot = &PartStatement::x_point,
       .unit = unit::length,
       .help = "global point in the x-z plane",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "VX",
       .slot = &PartStatement::vx,
       .unit = unit::velocity,
       .help = "initial velocity of the CM",
       .start = StatedStart::velocity},
      {.name = "VY",
       .slot = &PartStatement::vy,
       .unit = unit::velocity,
       .help = "the same along y",
       .start = StatedStart::velocity},
      {.name = "VZ",
       .slot = &PartStatement::vz,
       .unit = unit::velocity,
       .help = "the same along z",
       .start = StatedStart::velocity},
      {.name = "WX",
       .slot = &PartStatement::wx,
       .unit = unit::angular_velocity,
       .help = "initial angular velocity",
       .start = StatedStart::velocity},
      {.name = "WY",
       .slot = &PartStatement::wy,
       .unit = unit::angular_velocity,
       .help = "the same about y",
       .start = StatedStart::velocity},
      {.name = "WZ",
       .slot = &PartStatement::wz,
       .unit = unit::angular_velocity,
       .help = "the same about z",
       .start = StatedStart::velocity},
      {.name = "VM",
       .slot = &PartStatement::vm,
       .help = "axes of VX, VY, VZ; global by default",
       .start = StatedStart::velocity_axes},
      {.name = "WM",
       .slot = &PartStatement::wm,
       .help = "axes of WX, WY, WZ; those of CM by default",
       .start = StatedStart::angular_axes},
      {.name = "EXACT",
       .slot = &PartStatement::exact,
       .help = "coordinates the assembly should keep: X:Y:Z:PSI:THETA:PHI"},
      {.name = "MATERIAL",
       .slot = &PartStatement::material,
       .help = "name of a MATERIAL; has no effect on a rigid part"},
  }};
};

// What stays of it beside the body of the model until all markers are known.
struct ReadPart {
  bool ground = false, has_inertia = false;
  MarkerId cm, im, vm, wm;
};

std::optional<std::size_t> exact_coordinate(const std::string& word) {
  static constexpr std::array<std::string_view, 6> names = {"X", "Y", "Z", "PSI", "THETA", "PHI"};
  return find_keyword(word, names);
}

void check_exact(const std::vector<std::string>& words, ElementReader& reader) {
  for (const std::string& word : words) {
    if (!exact_coordinate(word)) {
      reader.error("unknown-word", reader.at("EXACT"), fmt::format("EXACT has no coordinate {}", word),
                   "one of X, Y, Z, PSI, THETA, PHI");
    }
  }
}

class PartSet final : public TypedSet<ReadPart> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    PartStatement p;
    if (!read_arguments(p, reader)) return;
    if (p.ground && reader.statement().arguments.size() > (reader.given("MATERIAL") ? 2u : 1u)) {
      reader.error("argument-of-ground", reader.at("GROUND"),
                   fmt::format("{} is the ground and takes no other argument", reader.label().text()));
      return;
    }
    if (!p.ip.empty() && p.ip.size() != 3 && p.ip.size() != 6) {
      reader.error("wrong-count", reader.at("IP"), fmt::format("IP has {} values, it takes 3 or 6", p.ip.size()));
    }
    if ((p.mass > 0 || has_inertia(p)) && !p.cm.valid()) {
      reader.error("missing-cm", reader.statement().at,
                   fmt::format("{} has mass or inertia but no CM", reader.label().text()),
                   "CM= names the marker at the centre of mass");
    }
    if (p.mass == 0 && has_inertia(p)) {
      reader.warning("inertia-without-mass", reader.at("IP"),
                     fmt::format("{} has inertia but no mass", reader.label().text()));
    }
    check_exact(p.exact, reader);
    const auto axes = orientation({p.angles, p.z_point, p.x_point, "REULER", "ZG", "XG"}, p.origin, reader);
    elements[k] = {p.ground, !p.ip.empty(), p.cm, p.im, p.vm, p.wm};
    if (p.ground) return;
    Body& body = *reader.own_body();
    if (axes) body.pose = {p.origin, *axes};
    body.user_mass = p.mass;
    if (!p.ip.empty()) body.J_BC = written_inertia(p.ip);  // until the markers are known
    for (const std::string& word : p.exact) {
      if (const auto coordinate = exact_coordinate(word)) body.exact[*coordinate] = true;
    }
    if (p.vx || p.vy || p.vz || p.wx || p.wy || p.wz) {
      body.velocity = std::make_shared<const StatedVelocity>(StatedVelocity{{p.vx, p.vy, p.vz},
                                                                            {p.wx, p.wy, p.wz},
                                                                            p.vm.valid() ? p.vm : global_frame,
                                                                            p.wm.valid()   ? p.wm
                                                                            : p.cm.valid() ? p.cm
                                                                                           : global_frame});
    }
  }

  std::vector<MarkerId> centres;  // CM of each

  void finish(Model& model, Diagnostics& diagnostics) override {
    bring_origins_near(model);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const ReadPart& p = elements[k];
      if (p.ground) continue;
      const BodyId id = *model.find_body("PART", labels[k].id);
      Body& body = model.bodies[static_cast<std::size_t>(id.index)];
      body.mass = body.user_mass / model.units.ucf;
      place_mass(p, labels[k], id, model, body, diagnostics);
      check_velocity_axes(model, labels[k], p.vm, p.wm, diagnostics);
      const bool turns = std::ranges::any_of(body.velocity->angular, [](const auto& w) { return w.has_value(); });
      if (!p.wm.valid() && !p.cm.valid() && turns) {
        diagnostics.error("missing-cm", labels[k].at,
                          fmt::format("{} states an angular velocity but neither WM nor CM", labels[k].text()));
      }
    }
    centres.clear();
    for (const ReadPart& p : elements) centres.push_back(p.cm);
    std::vector<ReadPart>().swap(elements);  // all that counts is in the model now
  }

  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    return std::make_unique<InertiaKernel>(model, layout, BodyKind::part);
  }

 private:
  // In lengths of the model: an origin farther from all markers than that costs digits that they have, its square those
  // of the inertia.
  static constexpr double far_origin = 1e3;

  // Takes a marker as the origin of each BCS that stands far from all that its part has. The differences between
  // markers stay as written.
  void bring_origins_near(Model& model) const {
    const double limit = far_origin * model.characteristic_length();
    std::vector<double> nearest(model.bodies.size(), std::numeric_limits<double>::infinity());
    std::vector<MarkerId> first(model.bodies.size());
    for (std::size_t m = 1; m < model.markers.size(); ++m) {
      const Marker& marker = model.markers[m];
      if (marker.floating) continue;
      const auto b = static_cast<std::size_t>(marker.place.body.index);
      nearest[b] = std::min(nearest[b], norm(marker.place.p_BM));
      if (!first[b].valid()) first[b] = MarkerId{static_cast<std::int32_t>(m)};
    }
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const ReadPart& p = elements[k];
      if (p.ground) continue;
      const auto b = static_cast<std::size_t>(model.find_body("PART", labels[k].id)->index);
      Body& body = model.bodies[b];
      if (body.exact != std::array<bool, 6>{} || !first[b].valid() || nearest[b] <= limit) continue;
      const bool own = p.cm.valid() && static_cast<std::size_t>(model.marker(p.cm).place.body.index) == b;
      body.origin_at = own ? p.cm : first[b];
      body.origin_offset = model.marker(body.origin_at).place.p_BM;
      body.pose.r += body.pose.R * body.origin_offset;
    }
    for (Marker& marker : model.markers) {
      const Body& body = model.bodies[static_cast<std::size_t>(marker.place.body.index)];
      if (!marker.floating && body.origin_at.valid()) marker.place.p_BM -= body.origin_offset;
    }
  }

  static bool has_inertia(const PartStatement& p) {
    return std::any_of(p.ip.begin(), p.ip.end(), [](double x) { return x != 0.0; });
  }

  // Ixx, Iyy, Izz [, Ixy, Ixz, Iyz] about the origin of a marker and along its axes; more values are an error.
  static Matrix3 written_inertia(const std::vector<double>& ip) {
    std::array<double, 6> all{};
    std::copy_n(ip.begin(), std::min(ip.size(), all.size()), all.begin());
    const auto& [xx, yy, zz, xy, xz, yz] = all;
    return {{xx, -xy, -xz}, {-xy, yy, -yz}, {-xz, -yz, zz}};
  }

  static void place_mass(const ReadPart& p, const ElementLabel& label, BodyId id, const Model& model, Body& body,
                         Diagnostics& diagnostics) {
    if (!p.cm.valid()) return;
    const auto owned = [&](MarkerId m, std::string_view argument) {
      if (model.marker(m).place.body == id && !model.marker(m).floating) return true;
      diagnostics.error("foreign-marker", label.at,
                        fmt::format("{} of {} must be a fixed marker of that part, {} is not", argument, label.text(),
                                    model.marker(m).label->text()));
      return false;
    };
    if (!owned(p.cm, "CM") || (p.im.valid() && !owned(p.im, "IM"))) return;
    const MarkerPlace& cm = model.marker(p.cm).place;
    const MarkerPlace& im = model.marker(p.im.valid() ? p.im : p.cm).place;
    body.p_BC = cm.p_BM;
    body.R_BI = im.R_BM;
    if (!p.has_inertia) return;
    const Matrix3 J_IM = body.J_BC;
    // From the origin of IM to the centre of mass, then from model units to dynamical ones.
    const Vector s = cm.p_BM - im.p_BM;
    const Matrix3 about_im = im.R_BM * J_IM * transpose(im.R_BM);
    Matrix3 about_cm = about_im - body.user_mass * (Matrix3::diagonal(dot(s, s)) - outer(s, s));

    Eigen::Matrix3d J;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        J(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = about_cm(r, c);
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(J);
    Eigen::Vector3d principal = solver.eigenvalues();
    // What cancels between the two points is zero: a thin rod has no inertia about its axis, a heavy point none at all.
    const double roundings = 16 * std::numeric_limits<double>::epsilon() * body.user_mass * dot(s, s);
    if ((principal.array().abs() < roundings).any()) {
      principal = (principal.array().abs() < roundings).select(0.0, principal);
      J = solver.eigenvectors() * principal.asDiagonal() * solver.eigenvectors().transpose();
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
          about_cm(r, c) = J(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
        }
      }
    }
    body.J_BC = (1.0 / model.units.ucf) * about_cm;
    const double scale = principal.cwiseAbs().maxCoeff();
    if (principal(0) < -1e-6 * scale) {
      diagnostics.error("negative-inertia", label.at,
                        fmt::format("the inertia tensor of {} about its centre of mass has the negative "
                                    "principal value {:.4g}",
                                    label.text(), principal(0)));
    } else if (principal(0) > 0 && principal(2) > (principal(0) + principal(1)) * (1 + 1e-4)) {
      // With a principal value of exactly zero a planar model is meant, and no body is claimed.
      diagnostics.warning("impossible-inertia", label.at,
                          fmt::format("no rigid body has the principal inertias {:.4g}, {:.4g}, {:.4g} of {}",
                                      principal(0), principal(1), principal(2), label.text()),
                          "the largest is more than the sum of the others");
    }
  }
};

}  // namespace

std::vector<PartCentre> part_centres(const Model& model) {
  std::vector<PartCentre> list;
  for (const auto& set : model.sets) {
    const auto* parts = dynamic_cast<const PartSet*>(set.get());
    for (std::size_t k = 0; parts && k < parts->centres.size(); ++k)
      list.push_back({&parts->labels[k], parts->centres[k]});
  }
  return list;
}

extern constinit const Kind part =
    Kind{"PART",
         "",
         "A rigid body, or the ground.",
         Kind::Role::body,
         detail::argument_infos<PartStatement>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<PartSet>(kind); }}
        .grounded_by("GROUND")
        .with_example("PART/2, MASS=3.5");

}  // namespace dynalin
