// MFORCE/id, FLEX_BODY= [, JFLOAT=], {CASE_INDEX=, SCALE= | FUNCTION=USER(…) | FORCE=USER(…)}
//
// A load on the coordinates of a flexible body: column CASE_INDEX of its modal loads, a force f and a torque t about
// the BCS, along its axes A, and Q of the modes, times SCALE. With w = SCALE
//
//     F = w A f,   L = w A t   on the body at the BCS,   Q w   on its modal coordinates
//
// and −F, −L at the same place on the body of the floating marker JFLOAT. What the modes take has no reaction.
#include <fmt/format.h>

#include "elements/bodies/flex_body.h"
#include "mechanics/binder.h"
#include "mechanics/bound_expression.h"
#include "mechanics/kernel.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct ModalForce {
  BodyId body;
  MarkerId jfloat;
  std::optional<std::int64_t> index;
  Expression scale;
  UserSubroutine function{"MFOSUB"}, force{"MFOSUB"};
  Span index_at;

  static constexpr std::array<Argument<ModalForce>, 6> arguments = {{
      {.name = "FLEX_BODY", .slot = &ModalForce::body, .required = true, .help = "the flexible body it acts on"},
      {.name = "JFLOAT", .slot = &ModalForce::jfloat, .help = "floating marker whose body takes the reaction"},
      {.name = "CASE_INDEX", .slot = &ModalForce::index, .minimum = 1, .help = "which of the body's modal loads"},
      {.name = "SCALE", .slot = &ModalForce::scale, .help = "factor of that load"},
      {.name = "FUNCTION", .slot = &ModalForce::function, .help = "USER(…): not available"},
      {.name = "FORCE", .slot = &ModalForce::force, .help = "USER(…): not available"},
  }};
};

class ModalForceKernel final : public Kernel {
 public:
  ModalForceKernel(const std::vector<ModalForce>& forces, const std::vector<ElementLabel>& labels, const Model& model,
                   Layout& layout)
      : labels_(&labels) {
    const std::vector<FlexibleBody> flexible = flexible_bodies(model);
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const FlexibleBody& f = *std::ranges::find(flexible, forces[k].body, &FlexibleBody::body);
      Load load{f.body,
                std::nullopt,
                {},
                {},
                {},
                layout.body_coordinate_count + static_cast<std::int32_t>(f.first),
                layout.add_algebraic(labels[k]),
                forces[k].scale,
                {}};
      const Eigen::VectorXd column = f.flexible->loads.col(*forces[k].index - 1);
      load.force = {column(0), column(1), column(2)}, load.torque = {column(3), column(4), column(5)};
      load.of_modes.assign(column.data() + 6, column.data() + column.size());
      if (forces[k].jfloat.valid()) load.reacts_on = model.marker(forces[k].jfloat).place.body;
      loads_.push_back(std::move(load));
    }
  }

  void bind(Binder& binder) override {
    for (Load& l : loads_) l.factor = BoundExpression(l.scale, binder);
  }

  void equations(const Motion& motion, Equations& eq) const override {
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      const Load& l = loads_[k];
      eq.begin_element((*labels_)[k]);
      const double w = motion.algebraic[static_cast<std::size_t>(l.algebraic)];
      const std::int32_t row = eq.algebraic_row(l.algebraic);
      eq.add_residual(row, w);
      eq.add(PartialBy::algebraic, row, l.algebraic, 1.0);
      l.factor.add(motion, eq, row, -1.0, PartialBy::damping);

      const Matrix3& A = motion.body(l.body).R;
      const Vector force = A * l.force, torque = A * l.torque;  // by a unit of w
      eq.apply(l.body, w * force, w * torque);
      eq.add_column(PartialBy::algebraic, l.body, l.algebraic, force, torque);
      for (std::size_t m = 0; m < l.of_modes.size(); ++m) {
        const std::int32_t at = l.modes + static_cast<std::int32_t>(m);
        eq.add_residual(at, -w * l.of_modes[m]);
        eq.add(PartialBy::algebraic, at, l.algebraic, -l.of_modes[m]);
      }
      const std::int32_t own = eq.layout().body(l.body).offset;
      for (std::size_t a = 0; a < 3; ++a) {
        const Vector turned_force = w * cross(unit_vectors[a], force),
                     turned_torque = w * cross(unit_vectors[a], torque);
        eq.add_column(PartialBy::position, l.body, own + 3 + static_cast<std::int32_t>(a), turned_force, turned_torque);
      }
      if (l.reacts_on) react(l, motion, w, force, torque, eq);
    }
  }

  void remember(const Motion& motion, Memory& memory) const override {
    for (const Load& l : loads_) l.factor.remember(motion, memory);
  }
  void undefined_values(const Motion& motion, std::vector<UndefinedValue>& values) const override {
    for (std::size_t k = 0; k < loads_.size(); ++k) loads_[k].factor.find_undefined(motion, (*labels_)[k], values);
  }

 private:
  struct Load {
    BodyId body;
    std::optional<BodyId> reacts_on;
    Vector force, torque;  // axes of the BCS
    std::vector<double> of_modes;
    std::int32_t modes;  // first column of the modal coordinates
    std::int32_t algebraic;
    Expression scale;
    BoundExpression factor;
  };

  // The opposite at the place of the BCS, on the body of JFLOAT; `force` and `torque` by a unit of w.
  static void react(const Load& l, const Motion& motion, double w, const Vector& force, const Vector& torque,
                    Equations& eq) {
    const BodyId on = *l.reacts_on;
    const BodyBlock& block = eq.layout().body(on);
    if (block.count == 0) return;
    const Vector arm = motion.body(l.body).r - motion.body(on).r;
    const auto about_origin = [&](const Vector& f, const Vector& t) { return t + cross(arm, f); };
    eq.apply(on, -w * force, -w * about_origin(force, torque));
    eq.add_column(PartialBy::algebraic, on, l.algebraic, -force, -about_origin(force, torque));
    const std::int32_t loaded = eq.layout().body(l.body).offset;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto k = static_cast<std::int32_t>(a);
      const Vector& e = unit_vectors[a];
      const Vector turned_force = w * cross(e, force), turned_torque = w * cross(e, torque);
      eq.add_column(PartialBy::position, on, loaded + 3 + k, -turned_force, -about_origin(turned_force, turned_torque));
      const Vector by_arm = w * cross(e, force);
      eq.add_column(PartialBy::position, on, loaded + k, Vector{}, -by_arm);
      eq.add_column(PartialBy::position, on, block.offset + k, Vector{}, by_arm);
    }
  }

  const std::vector<ElementLabel>* labels_;
  std::vector<Load> loads_;
};

class ModalForceSet final : public TypedSet<ModalForce> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    if (!read_arguments(elements[k], reader)) return;
    const std::string name = reader.label().text();
    for (const auto& [word, other] : {std::pair{"CASE_INDEX", "SCALE"}, {"SCALE", "CASE_INDEX"}}) {
      if (reader.given(word)) continue;
      reader.error("missing-argument", reader.at(other),
                   reader.given(other) ? fmt::format("{} of {} needs {}", other, name, word)
                                       : fmt::format("{} needs CASE_INDEX and SCALE", name));
      return;
    }
    elements[k].index_at = reader.at("CASE_INDEX");
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    const std::vector<const ModalBody*> flexible = flexible_by_body(model);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const ModalForce& f = elements[k];
      const std::string name = labels[k].text(), body = model.body(f.body).label.text();
      if (f.jfloat.valid()) check_reaction(f, labels[k], model, diagnostics);
      const ModalBody* loaded = flexible[static_cast<std::size_t>(f.body.index)];
      if (!loaded) continue;  // its own statement has errors
      if (loaded->loads.cols() == 0) {
        diagnostics.error("missing-load", f.index_at, fmt::format("{} takes a modal load, and {} has none", name, body),
                          "a MATRIX named MODLOAD among the MATRICES of the body");
      } else if (*f.index > loaded->loads.cols()) {
        diagnostics.error("missing-load", f.index_at,
                          fmt::format("{} takes modal load {}, {} has {}", name, *f.index, body, loaded->loads.cols()));
      }
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    return std::make_unique<ModalForceKernel>(elements, labels, model, layout);
  }

 private:
  static void check_reaction(const ModalForce& f, const ElementLabel& label, const Model& model,
                             Diagnostics& diagnostics) {
    const Marker& floating = model.marker(f.jfloat);
    if (!floating.floating) {
      diagnostics.error(
          "fixed-marker", label.at,
          fmt::format("JFLOAT of {}, {}, must be a floating marker", label.text(), floating.label->text()),
          "write FLOATING into the MARKER statement");
    } else if (floating.place.body == f.body) {
      diagnostics.error(
          "same-body", label.at,
          fmt::format("JFLOAT of {} is on {}, which it acts on", label.text(), model.body(f.body).label.text()));
    } else if (model.body(floating.place.body).kind == BodyKind::point_mass) {
      diagnostics.error("rotation-of-point-mass", label.at,
                        fmt::format("{} acts on the rotation of {}, which has none", label.text(),
                                    model.body(floating.place.body).label.text()));
    }
  }
};

}  // namespace

extern constinit const Kind mforce = Kind{
    "MFORCE",
    "",
    "Load on the coordinates of a flexible body.",
    Kind::Role::element,
    detail::argument_infos<ModalForce>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<ModalForceSet>(kind);
    }}.deactivatable();

}  // namespace dynalin
