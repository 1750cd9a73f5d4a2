// Beams of finite elements (FE_PART): nodes and elements out of the statements (fe_part_statement.h).
#include "elements/bodies/fe_part.h"

#include <fmt/format.h>

#include <algorithm>

#include "elements/bodies/fe_part_statement.h"
#include "elements/families/beam_body.h"
#include "elements/families/beam_states.h"
#include "elements/families/markers.h"
#include "elements/families/orientation.h"
#include "elements/settings/material.h"
#include "flexible/spatial_beam.h"

namespace dynalin {

namespace {

class FePartSet final : public TypedSet<FePart> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    FePart& f = elements[k];
    if (!read_arguments(f, reader)) return;
    if (!describes_beam(f, reader)) return;
    f.material_at = reader.at("MATERIAL");
    const auto made_of = reader.element("MATERIAL", {*f.material, f.material_at});
    if (!made_of) return;
    f.made_of = *made_of;
    const auto axes = orientation({f.angles, f.z_point, f.x_point, "REULER", "ZG", "XG"}, f.origin, reader);
    if (!axes) return;
    f.axes = *axes;
    if (f.plane) check_plane(f, reader);
  }

  // Markers and expressions ask for nodes: this runs before theirs.
  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      FePart& f = elements[k];
      check_velocity_axes(model, labels[k], f.vm, f.wm, diagnostics);
      const auto material = material_of(f, labels[k], model, diagnostics);
      if (!material) continue;
      f.elements.reserve(f.numbers.size() - 1);
      for (std::size_t e = 0; e + 1 < f.numbers.size(); ++e) f.elements.push_back(element(f, e, *material));
      add_nodes(f, labels[k], model);
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    return std::make_unique<BeamBodyKernel>(beam_bodies(model), model, layout);
  }

 private:
  static std::shared_ptr<const BeamElement> element(const FePart& f, std::size_t e, const BeamMaterial& material) {
    const std::array<BeamSection, 2> sections = {section_of(f, e), section_of(f, e + 1)};
    const Vector chord = place_of_node(f, e + 1) - place_of_node(f, e);
    const std::array<Matrix3, 2> axes = {axes_of_node(f, e), axes_of_node(f, e + 1)};
    if (!f.plane) return std::make_shared<SpatialBeam>(material, sections, chord, axes);
    return std::make_shared<PlaneBeam>(*f.plane, material, sections, f.axes * chord,
                                       std::array{f.axes * axes[0], f.axes * axes[1]});
  }

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
    const BeamStates states(f.numbers.size(), f.plane);
    for (std::size_t k = 0; k < f.numbers.size(); ++k) {
      Body& body = model.bodies[static_cast<std::size_t>(f.nodes[k].index)];
      body.nature = std::make_shared<const BodyNature>(
          BodyNature{{BodyRole::nodal, f.numbers[k], {StateType::fe_part, states.of_pose(k), states.count()}}, {}, {}});
      body.pose = {f.origin + f.axes * place_of_node(f, k), f.axes * axes_of_node(f, k)};
      for (std::size_t side = 0; side < 2; ++side) {  // the element before it, the one behind
        if (side == 0 ? k == 0 : k == f.elements.size()) continue;
        const BeamElement& e = *f.elements[side == 0 ? k - 1 : k];
        body.mass += e.nodal_mass(1 - side);
        body.J_BC += e.nodal_inertia(1 - side);
      }
      body.user_mass = body.mass * model.units.ucf;
    }
  }
};

}  // namespace

std::vector<BeamBody> beam_bodies(const Model& model) {
  std::vector<BeamBody> list;
  for (const auto& set : model.sets) {
    const auto* beams = dynamic_cast<const FePartSet*>(set.get());
    for (std::size_t k = 0; beams && k < beams->elements.size(); ++k) {
      const FePart& f = beams->elements[k];
      if (f.nodes.empty()) continue;
      BeamBody b{&beams->labels[k], f.nodes, f.numbers, {}, &f.elements, f.plane, {f.origin, f.axes}, {}, 0};
      for (std::size_t node = 0; node < f.numbers.size(); ++node) b.places.push_back(place_of_node(f, node));
      b.velocity = {{f.vx, f.vy, f.vz}, {f.wx, f.wy, f.wz}, f.vm.valid() ? f.vm : global_frame, f.wm};
      list.push_back(std::move(b));
    }
  }
  return list;
}

std::vector<BeamBody> beam_bodies(const Model& model, const Layout& layout) {
  std::vector<BeamBody> list = beam_bodies(model);
  find_coordinates(list, layout);
  return list;
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
