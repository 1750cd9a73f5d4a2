// POINT_MASS/id, MASS=, CM=, QG=, {REULER= | ZG=, XG=}, VX=, VY=, VZ=, EXACT=
//
// A mass with three translations and no rotation: its axes keep their orientation for ever. CM locates the mass in
// the body coordinate system.
#include <fmt/format.h>

#include "elements/families/inertia.h"
#include "elements/families/orientation.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct PointMass {
  double mass = 0;
  MarkerId cm;
  Vector origin;
  std::optional<Vector> angles, z_point, x_point;
  std::optional<double> vx, vy, vz;
  std::vector<std::string> exact;
  Matrix3 axes = Matrix3::identity();

  static constexpr std::array<Argument<PointMass>, 10> arguments = {{
      {.name = "MASS", .slot = &PointMass::mass, .unit = unit::mass, .minimum = 0, .help = "0 unless stated"},
      {.name = "CM", .slot = &PointMass::cm, .help = "marker at the mass"},
      {.name = "QG",
       .slot = &PointMass::origin,
       .unit = unit::length,
       .help = "origin of the BCS",
       .start = StatedStart::place},
      {.name = "REULER",
       .slot = &PointMass::angles,
       .unit = unit::angle,
       .help = "3-1-3 angles of the BCS",
       .ends = "ZG XG",
       .start = StatedStart::place,
       .unstated = 0},
      {.name = "ZG",
       .slot = &PointMass::z_point,
       .unit = unit::length,
       .help = "global point on +z",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "XG",
       .slot = &PointMass::x_point,
       .unit = unit::length,
       .help = "global point in the x-z plane",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "VX",
       .slot = &PointMass::vx,
       .unit = unit::velocity,
       .help = "initial velocity, global axes",
       .start = StatedStart::velocity},
      {.name = "VY",
       .slot = &PointMass::vy,
       .unit = unit::velocity,
       .help = "the same along y",
       .start = StatedStart::velocity},
      {.name = "VZ",
       .slot = &PointMass::vz,
       .unit = unit::velocity,
       .help = "the same along z",
       .start = StatedStart::velocity},
      {.name = "EXACT", .slot = &PointMass::exact, .help = "coordinates the assembly should keep: X:Y:Z"},
  }};
};

class PointMassSet final : public TypedSet<PointMass> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    PointMass& p = elements[k];
    if (!read_arguments(p, reader)) return;
    const auto axes = orientation({p.angles, p.z_point, p.x_point, "REULER", "ZG", "XG"}, p.origin, reader);
    if (axes) p.axes = *axes;
    for (const std::string& word : p.exact) {
      if (word != "X" && word != "Y" && word != "Z") {
        reader.error("unknown-word", reader.at("EXACT"), fmt::format("EXACT has no coordinate {}", word),
                     "one of X, Y, Z");
      }
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    BodyNature of_points;
    of_points.listed.states.types = {StateType::point_mass, StateType::point_mass_relative,
                                     StateType::point_mass_original};
    of_points.listed.states.rates_behind = 3;
    const auto nature = std::make_shared<const BodyNature>(std::move(of_points));
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const PointMass& p = elements[k];
      const BodyId id = *model.find_body("POINT_MASS", labels[k].id);
      Body& body = model.bodies[static_cast<std::size_t>(id.index)];
      body.pose = {p.origin, p.axes};
      body.nature = nature;
      body.user_mass = p.mass;
      body.mass = p.mass / model.units.ucf;
      if (p.cm.valid()) {
        if (model.marker(p.cm).place.body != id || model.marker(p.cm).floating) {
          diagnostics.error("foreign-marker", labels[k].at,
                            fmt::format("CM of {} must be a fixed marker of that point mass, {} is not",
                                        labels[k].text(), model.marker(p.cm).label->text()));
        }
        body.p_BC = model.marker(p.cm).place.p_BM;
      }
      if (p.vx || p.vy || p.vz)
        body.velocity =
            std::make_shared<const StatedVelocity>(StatedVelocity{{p.vx, p.vy, p.vz}, {}, global_frame, global_frame});
      for (const std::string& word : p.exact) body.exact[static_cast<std::size_t>(word[0] - 'X')] = true;
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    return std::make_unique<InertiaKernel>(model, layout, BodyKind::point_mass);
  }
};

}  // namespace

extern constinit const Kind point_mass =
    Kind{"POINT_MASS",
         "",
         "A mass that translates and never turns.",
         Kind::Role::body,
         detail::argument_infos<PointMass>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<PointMassSet>(kind); }}
        .without_rotation()
        .with_example("POINT_MASS/3, MASS=2");

}  // namespace dynalin
