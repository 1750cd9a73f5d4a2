// MFORCE/id, FLEX_BODY= [, JFLOAT=], {CASE_INDEX=, SCALE= | FUNCTION=USER(…) | FORCE=USER(…)}
//
// A load on the coordinates of a flexible body: column CASE_INDEX of its modal loads, a force f and a torque t about
// the BCS, along its axes A, and Q of the modes, times SCALE. With w = SCALE
//
//     F = w A f,   L = w A t   on the body at the BCS,   Q w   on its modal coordinates
//
// and −F, −L at the same place on the body of the floating marker JFLOAT, or on its node. What the modes take has no
// reaction.
#include <fmt/format.h>

#include "elements/bodies/flex_body.h"
#include "mechanics/binder.h"
#include "mechanics/bound_expression.h"
#include "mechanics/kernel.h"
#include "mechanics/pair.h"
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
      Load load;
      load.bcs.body = f.body;
      load.modes = layout.body_coordinate_count + static_cast<std::int32_t>(f.first);
      load.algebraic = layout.add_algebraic(labels[k]);
      load.scale = forces[k].scale;
      const Eigen::VectorXd column = f.flexible->loads.col(*forces[k].index - 1);
      load.force = {column(0), column(1), column(2)}, load.torque = {column(3), column(4), column(5)};
      load.of_modes.assign(column.data() + 6, column.data() + column.size());
      if (forces[k].jfloat.valid()) load.reacts_on = layout.marker(forces[k].jfloat), load.has_reaction = true;
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

      const PairMotion pair = pair_motion(motion, l.bcs, l.reacts_on);
      const Matrix3& A = motion.body(l.bcs.body).R;
      const Vector force = A * l.force, torque = A * l.torque;  // by a unit of w
      PairForce load;
      load.force = w * force, load.torque = w * torque;
      load.force_on_position.axes_I = -skew(load.force), load.torque_on_position.axes_I = -skew(load.torque);
      load.reaction = l.has_reaction ? Reaction::at_I : Reaction::none;
      apply(pair, load, eq);
      apply_column(pair, force, torque, l.has_reaction, PartialBy::algebraic, l.algebraic, eq);
      for (std::size_t m = 0; m < l.of_modes.size(); ++m) {
        const std::int32_t at = l.modes + static_cast<std::int32_t>(m);
        eq.add_residual(at, -w * l.of_modes[m]);
        eq.add(PartialBy::algebraic, at, l.algebraic, -l.of_modes[m]);
      }
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
    MarkerPlace bcs, reacts_on;  // of ground where nothing takes the reaction
    bool has_reaction = false;
    Vector force, torque;  // axes of the BCS
    std::vector<double> of_modes;
    std::int32_t modes = 0;  // first column of the modal coordinates
    std::int32_t algebraic = 0;
    Expression scale;
    BoundExpression factor;
  };

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
