// GCON/id [, I=], FUNCTION=
//
// Drives a function expression to zero. One without velocities is a position row Φ(q, t) = 0; one with velocities
// is a velocity row Ψ(q, q′, t) = 0, which takes a rate from the model and no position. The generalized forces are
// λ Φ_q, or λ Ψ_q′: a constraint force does no work in a permitted motion. I only says where a force is reported.
#include <fmt/format.h>

#include "elements/constraints/without_variables.h"
#include "elements/families/markers.h"
#include "expression/functions.h"
#include "mechanics/bound_expression.h"
#include "mechanics/wrench_source.h"
#include "model/model.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct GeneralConstraint {
  MarkerId i;
  Expression function;

  static constexpr std::array<Argument<GeneralConstraint>, 2> arguments = {{
      {.name = "I", .slot = &GeneralConstraint::i, .help = "marker at which the force is reported"},
      {.name = "FUNCTION",
       .slot = &GeneralConstraint::function,
       .required = true,
       .help = "displacements, velocities and TIME; it is held at zero"},
  }};

  RowLevel level() const {
    for (const Atom& atom : function.atoms()) {
      if (atom.function->order > 0) return RowLevel::velocity;
    }
    return RowLevel::position;
  }
};

// Accelerations, forces and states follow from the constraint.
constexpr Readable measures_and_time = {[](const Atom& a) {
                                          const bool is_measure = a.function->family == AtomFamily::marker_measure;
                                          return a.function->family == AtomFamily::time ||
                                                 (is_measure && a.function->order <= 1);
                                        },
                                        "displacements, velocities and TIME only", "unfit-constraint"};

class GeneralConstraintKernel final : public Kernel, public WrenchSource {
 public:
  GeneralConstraintKernel(const std::vector<GeneralConstraint>& elements, const std::vector<ElementLabel>& labels,
                          Layout& layout)
      : labels_(&labels), layout_(&layout) {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const RowLevel level = elements[k].level();
      const std::int32_t row = layout.add_row(labels[k], "FUNCTION", level);
      rows_.push_back({elements[k].function, {}, level, row});
      if (elements[k].i.valid()) reported_.push_back({k, elements[k].i});
    }
  }

  void bind(Binder& binder) override {
    for (Row& r : rows_) {
      r.function = BoundExpression(r.written, binder);
      const auto atom = r.function.atom_on_curve();
      if (!atom) continue;
      binder.problem("unfit-constraint", atom->at,
                     fmt::format("{} follows a marker along a curve, which no constraint can", atom->at.text()));
    }
  }
  void constraints(const Motion& motion, ConstraintRows& rows) const override {
    for (const Row& r : rows_) {
      rows.set(r.row, r.level == RowLevel::position ? r.function.add_position(motion, rows, r.row)
                                                    : r.function.add_velocity(motion, rows, r.row));
    }
  }
  // What acts on the body of the marker that I names, at its origin.
  const WrenchSource* reported_wrenches() const override { return this; }
  std::size_t wrench_count(std::size_t) const override { return reported_.size(); }
  std::size_t element_of_wrench(std::size_t which) const override { return reported_[which].first; }
  MarkerId marker_I(std::size_t which) const override { return reported_[which].second; }
  MarkerId marker_J(std::size_t) const override { return global_frame; }
  void wrench(const Motion& motion, std::size_t which, Partials, MarkerWrench& out) const override {
    const Row& r = rows_[reported_[which].first];
    ConstraintRows gradient;
    gradient.resize(*layout_, 1);
    if (r.level == RowLevel::position) {
      r.function.add_position(motion, gradient, 0);
    } else {
      r.function.add_velocity(motion, gradient, 0);
    }
    const MarkerPlace& I = layout_->marker(reported_[which].second);
    const BodyBlock& block = layout_->body(I.body);
    std::array<double, 6> load{};  // at the origin of the BCS
    for (const ConstraintRows::Entry& e : gradient.row(0)) {
      if (e.column < block.offset || e.column >= block.offset + block.count) continue;
      load[static_cast<std::size_t>(e.column - block.offset)] = motion.lambda[static_cast<std::size_t>(r.row)] * e.c.g;
    }
    out.force.force = {load[0], load[1], load[2]};
    const Vector arm = motion.point(I) - motion.body(I.body).r;
    out.force.torque = Vector{load[3], load[4], load[5]} - cross(arm, out.force.force);
  }
  void equations(const Motion& motion, Equations& eq) const override {
    if (!eq.wants_partials()) return;
    for (const Row& r : rows_) {
      eq.begin_constraint(r.row);
      r.function.add_reaction_partials(motion, eq, motion.lambda[static_cast<std::size_t>(r.row)], r.level);
    }
  }
  void undefined_values(const Motion& motion, UndefinedValues& undefined_values) const override {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      rows_[k].function.find_undefined(motion, (*labels_)[k], undefined_values,
                                       BoundExpression::Derivatives::with_rates);
    }
  }

 private:
  struct Row {
    Expression written;
    BoundExpression function;
    RowLevel level;
    std::int32_t row;
  };
  std::vector<Row> rows_;
  std::vector<std::pair<std::size_t, MarkerId>> reported_;  // those with I
  const std::vector<ElementLabel>* labels_;
  const Layout* layout_;
};

class GeneralConstraintSet final : public TypedSet<GeneralConstraint> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override { read_arguments(elements[k], reader); }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      GeneralConstraint& g = elements[k];
      if (g.i.valid()) check_fixed(model, labels[k], g.i, "I", diagnostics);
      auto function = WithoutVariables(model, labels[k], measures_and_time, diagnostics).of(g.function);
      if (!function) continue;
      g.function = std::move(*function);
      for (const Expression::Call& call : g.function.calls()) {
        if (!has_kinks(call.name)) continue;
        diagnostics.error(measures_and_time.code, call.at,
                          fmt::format("{} uses {}, which has kinks or jumps", labels[k].text(), call.name));
      }
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<GeneralConstraintKernel>(elements, labels, layout);
  }
};

}  // namespace

extern constinit const Kind gcon =
    Kind{"GCON",
         "",
         "Holds a function of displacements, velocities and time at zero.",
         Kind::Role::element,
         detail::argument_infos<GeneralConstraint>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<GeneralConstraintSet>(kind); }}
        .deactivatable()
        .with_example("GCON/1, FUNCTION=DX(20,1)-0.1");

}  // namespace dynalin
