// MOTION/id, {JOINT= [, ROTATION | TRANSLATION] | I=, J=, {X | Y | Z | B1 | B2 | B3}}, FUNCTION=
//     [, DISPLACEMENT | VELOCITY | ACCELERATION] [, ICDISP=] [, ICVEL=]
//
// FUNCTION depends on TIME, on numbers of an ARRAY, and on VARIABLEs that depend on these themselves, which are put
// into it.
//
// Drives one displacement q of a joint or of a marker pair by a function of time (families/pair_displacement.h):
//
//     DISPLACEMENT   q − f(t) = 0                  angles are compared modulo 2π
//     VELOCITY       q − s = 0,   s′ = f(t)        s starts at ICDISP, or where the dataset draws it
//     ACCELERATION   q − s = 0,   s″ = f(t)        s′ starts at ICVEL, or 0
//
// s and s′ are courses (DifferentialState::course_of_motion): integrated as the model moves in time. A linear model is
// taken at one instant and holds them: no state belongs to the motion. Where neither ICDISP nor ICVEL says so, a motion
// that joins a run goes on with what it finds, and so does one that a command lets drive another displacement.
#include <fmt/format.h>

#include <algorithm>

#include "elements/constraints/motion_routine.h"
#include "elements/constraints/without_variables.h"
#include "elements/families/pair_displacement.h"
#include "expression/program.h"
#include "mechanics/bound_expression.h"
#include "mechanics/pair_state_source.h"
#include "mechanics/row_terms.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

namespace {

enum class DriveLevel : std::uint8_t { displacement, velocity, acceleration };

constexpr StartArguments course_starts{"ICDISP", "ICVEL"};

struct PrescribedMotion {
  JointRef joint;
  MarkerId i, j;  // of the joint when there is one
  bool rotation = false, translation = false;
  bool x = false, y = false, z = false, b1 = false, b2 = false, b3 = false;
  bool displacement = false, velocity = false, acceleration = false;
  std::optional<double> icdisp, icvel;
  Expression function;

  // Set when the model is complete.
  Displacement kind = Displacement::rotation;
  DriveLevel level = DriveLevel::displacement;
  double start = 0;  // of s

  using M = PrescribedMotion;
  static constexpr std::string_view other_axes = "X Y Z B1 B2 B3";
  static constexpr std::array<Argument<M>, 17> arguments = {{
      {.name = "JOINT", .slot = &M::joint, .help = "the joint that is driven", .ends = "I J X Y Z B1 B2 B3"},
      {.name = "I", .slot = &M::i, .help = "the marker that is driven", .ends = "JOINT ROTATIONAL TRANSLATIONAL"},
      {.name = "J",
       .slot = &M::j,
       .help = "the marker relative to which it is driven",
       .ends = "JOINT ROTATIONAL TRANSLATIONAL"},
      {.name = "ROTATIONAL", .slot = &M::rotation, .help = "drives the rotation of the joint", .ends = "TRANSLATIONAL"},
      {.name = "TRANSLATIONAL",
       .slot = &M::translation,
       .help = "drives the translation of the joint",
       .ends = "ROTATIONAL"},
      {.name = "X", .slot = &M::x, .help = "drives the displacement of I along x of J", .ends = other_axes},
      {.name = "Y", .slot = &M::y, .help = "drives the displacement of I along y of J", .ends = other_axes},
      {.name = "Z", .slot = &M::z, .help = "drives the displacement of I along z of J", .ends = other_axes},
      {.name = "B1",
       .slot = &M::b1,
       .help = "drives the first angle of the body-fixed 1-2-3 sequence",
       .ends = other_axes},
      {.name = "B2", .slot = &M::b2, .help = "drives the second angle", .ends = other_axes},
      {.name = "B3", .slot = &M::b3, .help = "drives the third angle", .ends = other_axes},
      {.name = "FUNCTION", .slot = &M::function, .required = true, .help = "a function of TIME alone"},
      {.name = "DISPLACEMENT",
       .slot = &M::displacement,
       .help = "FUNCTION is the displacement (default)",
       .ends = "VELOCITY ACCELERATION ICDISP ICVEL"},
      {.name = "VELOCITY",
       .slot = &M::velocity,
       .help = "FUNCTION is the velocity",
       .ends = "DISPLACEMENT ACCELERATION ICVEL"},
      {.name = "ACCELERATION",
       .slot = &M::acceleration,
       .help = "FUNCTION is the acceleration",
       .ends = "DISPLACEMENT VELOCITY"},
      {.name = "ICDISP",
       .slot = &M::icdisp,
       .unit = {"length or rad", true},
       .help = "displacement at the start",
       .start = StatedStart::alone},
      {.name = "ICVEL",
       .slot = &M::icvel,
       .unit = {"length or rad, per time", true},
       .help = "velocity at the start",
       .start = StatedStart::alone},
  }};

  std::string_view kind_text() const {
    static constexpr std::array<std::string_view, 7> names = {"rotation", "X", "Y", "Z", "B1", "B2", "B3"};
    if (joint.valid() && kind == translation_of_joint) return "translation";
    return names[static_cast<std::size_t>(kind)];
  }
};

class MotionKernel final : public Kernel,
                           public WrenchSource,
                           public RowTermsSource,
                           public PairStateSource,
                           public StartDisplacementSource {
 public:
  MotionKernel(const std::vector<PrescribedMotion>& elements, const std::vector<ElementLabel>& labels, Layout& layout)
      : labels_(&labels) {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const PrescribedMotion& e = elements[k];
      driven_.push_back(
          {e, {layout.marker(e.i), layout.marker(e.j), e.kind}, layout.add_row(labels[k], e.kind_text()), {}});
      Driven& d = driven_.back();
      ConstraintRow& row = layout.rows[static_cast<std::size_t>(d.row)];
      row.prescribed = true;
      if (e.level == DriveLevel::displacement) continue;
      layout.velocity_driven.push_back(&labels[k]);
      d.course = row.course = layout.add_state(course(labels[k], 1, e.start, !e.icdisp, course_starts.displacement));
      if (e.level == DriveLevel::acceleration)
        d.course_rate = row.course_rate =
            layout.add_state(course(labels[k], 2, e.icvel.value_or(0.0), !e.icvel, course_starts.velocity));
    }
  }

  void bind(Binder& binder) override {
    for (Driven& d : driven_) d.function = BoundExpression(d.element.function, binder);
  }

  void constraints(const Motion& motion, ConstraintRows& rows) const override {
    for (const Driven& d : driven_) {
      const Taylor q = d.displacement.along_motion(motion), f = driven_along(d, motion, rows.scratch);
      Taylor row(q.value - f.value, q.rate - f.rate, q.acceleration - f.acceleration);
      if (is_angle(d.element.kind)) row.value = angle_between(q.value, f.value);
      rows.set(d.row, row);
      d.displacement.add_to_row(motion, 1.0, d.row, rows);
    }
  }

  void equations(const Motion& motion, Equations& eq) const override {
    for (const Driven& d : driven_) {
      if (d.course >= 0) add_course(d, motion, eq);
      if (!eq.wants(PartialBy::position)) continue;
      eq.begin_constraint(d.row);
      d.displacement.add_reaction_partials(motion, lambda(d, motion), eq);
    }
  }

  void course_rates(const Motion& motion, std::span<double> state_rates) const override {
    ExpressionScratch scratch;
    for (const Driven& d : driven_) {
      if (d.course < 0) continue;
      const double f = d.function.value(motion, scratch);
      if (d.course_rate >= 0) state_rates[static_cast<std::size_t>(d.course)] = state(d.course_rate, motion);
      state_rates[static_cast<std::size_t>(d.course_rate >= 0 ? d.course_rate : d.course)] = f;
    }
  }

  void tell_row_terms(const Motion& motion, std::span<RowTerms> rows) const override {
    ExpressionScratch scratch;
    for (const Driven& d : driven_) {
      RowTerms& row = rows[static_cast<std::size_t>(d.row)];
      const double to = d.course >= 0 ? state(d.course, motion) : d.function.value(motion, scratch);
      row.size = std::abs(to);
      if (is_angle(d.element.kind)) row.driven_angle = to;
    }
  }

  // A routine may not be asked before anything has begun.
  void start_displacements(const Motion& start, std::vector<StartDisplacements>& out) const override {
    ExpressionScratch scratch;
    for (std::size_t k = 0; k < driven_.size(); ++k) {
      const Driven& d = driven_[k];
      const PrescribedMotion& e = d.element;
      const bool turns = e.kind == Displacement::rotation;
      if (!turns && e.kind != translation_of_joint) continue;
      StartDisplacements s{.terms = {{e.i, e.j, turns}}, .of = &(*labels_)[k], .argument = {}};
      if (e.level != DriveLevel::displacement) {
        if (!e.icdisp) continue;
        s.constant = *e.icdisp, s.argument = course_starts.displacement;
      } else {
        if (!e.function.program().routines().empty()) continue;
        s.constant = d.function.value(start, scratch);
      }
      out.push_back(std::move(s));
    }
  }

  void pair_states(const Motion&, std::vector<PairStates>& out) const override {
    for (std::size_t k = 0; k < driven_.size(); ++k) {
      const PrescribedMotion& e = driven_[k].element;
      if (driven_[k].course < 0) continue;
      out.push_back(
          {.of = &(*labels_)[k], .motion = e.kind_text(), .ends = {{{e.i, {}, {}}, {e.j, {}, {}}}}, .directions = {}});
    }
  }

  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return driven_[k].element.i; }
  MarkerId marker_J(std::size_t k) const override { return driven_[k].element.j; }
  void wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const override {
    const Driven& d = driven_[k];
    d.displacement.wrench(motion, lambda(d, motion), d.row, wanted, out);
  }
  void undefined_values(const Motion& motion, UndefinedValues& undefined_values) const override {
    ExpressionScratch scratch;
    for (std::size_t k = 0; k < driven_.size(); ++k) {
      const std::size_t before = undefined_values.values().size();
      const ElementLabel& label = (*labels_)[k];
      driven_[k].function.find_undefined(motion, label, undefined_values);
      if (undefined_values.values().size() > before) continue;
      // A routine has functions of its own for them.
      const Taylor f = driven_[k].function.along_motion(motion, scratch);
      if (std::isfinite(f.rate) && std::isfinite(f.acceleration)) continue;
      undefined_values.add(UndefinedValue{&label,
                                          fmt::format("the {} derivative of FUNCTION of {} by time has no finite value",
                                                      std::isfinite(f.rate) ? "second" : "first", label.full_text()),
                                          false});
    }
  }

 private:
  struct Driven {
    PrescribedMotion element;
    PairDisplacement displacement;
    std::int32_t row;
    BoundExpression function;
    std::int32_t course = -1, course_rate = -1;  // s and s′ among the differential states, −1 for what is given
  };
  static DifferentialState course(const ElementLabel& owner, std::int32_t number, double start, bool goes_on,
                                  std::string_view start_argument) {
    return {.owner = &owner,
            .coordinate = number,
            .initial = start,
            .held_in_statics = true,
            .course_of_motion = true,
            .goes_on = goes_on,
            .start_argument = start_argument};
  }
  static double state(std::int32_t k, const Motion& motion) { return motion.state[static_cast<std::size_t>(k)]; }
  // s′ = f, or s′ = p and p′ = f.
  static void add_course(const Driven& d, const Motion& motion, Equations& eq) {
    const auto rate = [&](std::int32_t k) {
      eq.add_residual(eq.state_row(k), motion.state_rate[static_cast<std::size_t>(k)]);
      eq.add(PartialBy::state_rate, eq.state_row(k), k, 1.0);
    };
    rate(d.course);
    std::int32_t last = d.course;
    if (d.course_rate >= 0) {
      eq.add_residual(eq.state_row(d.course), -state(d.course_rate, motion));
      eq.add(PartialBy::state, eq.state_row(d.course), d.course_rate, -1.0);
      rate(last = d.course_rate);
    }
    d.function.add(motion, eq, eq.state_row(last), -1.0, PartialBy::velocity);
  }
  // Less whole turns, which are taken from the larger one first: no rounding of theirs is left.
  static double angle_between(double q, double f) {
    constexpr double turn = 2 * std::numbers::pi;
    return std::remainder(q - std::remainder(f, turn), turn);
  }
  static double lambda(const Driven& d, const Motion& motion) { return motion.lambda[static_cast<std::size_t>(d.row)]; }
  // What the displacement is driven along, with its rates.
  static Taylor driven_along(const Driven& d, const Motion& motion, ExpressionScratch& scratch) {
    const Taylor f = d.function.along_motion(motion, scratch);
    switch (d.element.level) {
      case DriveLevel::displacement:
        return f;
      case DriveLevel::velocity:
        return {state(d.course, motion), f.value, f.rate};
      case DriveLevel::acceleration:
        return {state(d.course, motion), state(d.course_rate, motion), f.value};
    }
    return f;
  }
  std::vector<Driven> driven_;
  const std::vector<ElementLabel>* labels_;
};

class MotionSet final : public TypedSet<PrescribedMotion> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    PrescribedMotion& m = elements[k];
    if (!read_arguments(m, reader)) return;
    constexpr std::array data = {DataSource::value, DataSource::array_entry, DataSource::list_entry};
    for (const Atom& atom : m.function.atoms()) {
      const bool reads_data = std::find(data.begin(), data.end(), atom.function->reads) != data.end();
      if (atom.function->family == AtomFamily::time || reads_data) continue;  // of which finish() looks what it is
      reader.error("function-of-state", atom.at,
                   fmt::format("FUNCTION of {} depends on {}, it may depend on TIME only", reader.label().text(),
                               atom.function->name));
    }
    const std::string name = reader.label().text();
    const Span whole = reader.statement().at;
    const int levels = m.displacement + m.velocity + m.acceleration;
    if (levels > 1) {
      reader.error("excluded-arguments", whole,
                   fmt::format("{} takes one of DISPLACEMENT, VELOCITY and ACCELERATION", name));
    }
    m.level = m.velocity ? DriveLevel::velocity : m.acceleration ? DriveLevel::acceleration : DriveLevel::displacement;
    if (m.icdisp && m.level == DriveLevel::displacement) {
      reader.error("unexpected-argument", reader.at("ICDISP"), "ICDISP goes with VELOCITY and ACCELERATION");
    }
    if (m.icvel && m.level != DriveLevel::acceleration) {
      reader.error("unexpected-argument", reader.at("ICVEL"), "ICVEL goes with ACCELERATION");
    }

    const std::array<std::pair<bool, Displacement>, 6> words = {{{m.x, Displacement::X},
                                                                 {m.y, Displacement::Y},
                                                                 {m.z, Displacement::Z},
                                                                 {m.b1, Displacement::B1},
                                                                 {m.b2, Displacement::B2},
                                                                 {m.b3, Displacement::B3}}};
    int chosen = 0;
    for (const auto& [given, kind] : words) {
      if (!given) continue;
      ++chosen;
      m.kind = kind;
    }
    const bool by_joint = reader.given("JOINT"), by_markers = reader.given("I") || reader.given("J");
    if (by_joint && (by_markers || chosen > 0)) {
      reader.error("excluded-arguments", whole, fmt::format("{} drives either a JOINT or a pair of markers", name));
    } else if (!by_joint && !by_markers) {
      reader.error("missing-argument", whole, fmt::format("{} needs JOINT, or I and J", name));
    } else if (by_markers && !(reader.given("I") && reader.given("J"))) {
      reader.error("missing-argument", whole, fmt::format("{} needs both I and J", name));
    } else if (by_markers && (m.rotation || m.translation)) {
      const std::string_view word = m.rotation ? "ROTATIONAL" : "TRANSLATIONAL";
      reader.error("excluded-arguments", reader.at(word),
                   fmt::format("{} of {} goes with JOINT, not with I and J", word, name),
                   chosen == 0 ? "I and J go with one of X, Y, Z, B1, B2 and B3" : "leave it out");
    } else if (by_markers && chosen != 1) {
      reader.error("wrong-freedom", whole, fmt::format("{} must name the one displacement that it drives", name),
                   "X, Y, Z, B1, B2 or B3");
    } else if (by_joint && m.rotation && m.translation) {
      reader.error("wrong-freedom", whole, fmt::format("{} takes one of ROTATION and TRANSLATION", name));
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      PrescribedMotion& m = elements[k];
      auto in_time = WithoutVariables(model, labels[k], time_alone, diagnostics).of(m.function);
      if (!in_time) continue;
      m.function = std::move(*in_time);
      if (m.joint.valid()) {
        const DrivenFreedom wanted = m.rotation      ? DrivenFreedom::rotation
                                     : m.translation ? DrivenFreedom::translation
                                                     : DrivenFreedom::only;
        const auto freedom = joint_freedom(model, labels[k], m.joint, wanted, diagnostics);
        if (!freedom) continue;
        m.i = freedom->i, m.j = freedom->j, m.kind = freedom->kind;
      } else if (!check_pair(model, labels[k], m.i, m.j, {.rotation_of_I = is_angle(m.kind), .rotation_of_J = true},
                             diagnostics)) {
        continue;
      }
      m.start = m.icdisp.value_or(dynalin::displacement(m.kind, drawn_frame(model, m.i, m.j)));
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<MotionKernel>(elements, labels, layout);
  }
};

}  // namespace

extern constinit const Kind motion =
    Kind{"MOTION",
         "",
         "Drives a displacement of a joint or of a pair of markers by a function of time.",
         Kind::Role::element,
         detail::argument_infos<PrescribedMotion>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<MotionSet>(kind); }}
        .deactivatable()
        .calling(motion_routines)
        .with_example("MOTION/1, FUNCTION=20*TIME");

}  // namespace dynalin
