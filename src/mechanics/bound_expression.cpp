#include "mechanics/bound_expression.h"

#include <algorithm>
#include <cmath>

#include "mechanics/frame_variations.h"

namespace dynalin {

template <std::size_t N>
void BoundExpression::add_measure_gradient(const BoundAtom& a, const Motion& motion, const CoordinateBlock& block,
                                           const IntoEquation& into, double factor, bool passes_over) {
  const auto g = [&] {
    if constexpr (N == 6) {
      return path::varied_displacement(a.measure, a.places, motion, block).partial;
    } else {
      return path::varied_measure<N>(a.measure, a.places, motion, block).value.partial;
    }
  }();
  const std::array families = {PartialBy::position, into.velocity_family, PartialBy::acceleration};
  for (std::size_t level = 0; 6 * level < N; ++level) {
    for (std::int32_t k = 0; k < block.count; ++k) {
      const double value = g[6 * level + static_cast<std::size_t>(k)];
      into.eq.add(families[level], into.row, block.column + k, factor == 0.0 && passes_over ? 0.0 : factor * value);
    }
  }
}

double BoundExpression::atom_value(const BoundAtom& a, const Motion& motion) const {
  using Kind = BoundAtom::Kind;
  switch (a.kind) {
    case Kind::time:
      return motion.time;
    case Kind::mode:
      return static_cast<double>(motion.mode);
    case Kind::progress:
      return motion.progress.*a.progress;
    case Kind::constant:
      return a.constant;
    case Kind::remembered:
      return motion.memory[static_cast<std::size_t>(a.kept)];
    case Kind::channel: {
      const auto k = static_cast<std::size_t>(a.channel.index);
      if (a.channel.kind == Channel::Kind::algebraic) return motion.algebraic[k];
      return a.channel.kind == Channel::Kind::state ? motion.state[k] : motion.state_rate[k];
    }
    case Kind::measure: {
      if (a.order > 0) return atom_along_motion(a, motion).value;
      const auto frame = [&](std::size_t p) {
        return path::at_instant(a.places[p].frame(motion, a.places[0].place().body));
      };
      const double value = evaluate_measure<double>(a.measure, {frame(0), frame(1), frame(2), frame(3)});
      return a.memory < 0 ? value : unwrapped(value, motion.memory[static_cast<std::size_t>(a.memory)]);
    }
    case Kind::force:
      return force_value(a, motion);
  }
  return 0;
}

Taylor BoundExpression::atom_along_motion(const BoundAtom& a, const Motion& motion) const {
  using Kind = BoundAtom::Kind;
  if (a.kind == Kind::time) return {motion.time, 1.0, 0.0};
  if (a.kind == Kind::channel) {
    // Only a state knows its rate here; what an algebraic value does in time is not known.
    const double missing = detail::missing(0.0);
    const auto k = static_cast<std::size_t>(a.channel.index);
    const bool is_state = a.channel.kind == Channel::Kind::state;
    return {atom_value(a, motion), is_state ? motion.state_rate[k] : missing, missing};
  }
  if (a.kind != Kind::measure) return {atom_value(a, motion)};
  const auto frame = [&](std::size_t p) { return a.places[p].frame(motion, a.places[0].place().body); };
  Taylor m = evaluate_measure<Taylor>(a.measure, {frame(0), frame(1), frame(2), frame(3)});
  if (a.memory >= 0) m.value = unwrapped(m.value, motion.memory[static_cast<std::size_t>(a.memory)]);
  return m;
}

double BoundExpression::value(const Motion& motion, ExpressionScratch& scratch) const {
  scratch.atoms.resize(bound_atoms().size());
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) scratch.atoms[k] = atom_value(bound_atoms()[k], motion);
  return expression_.evaluate<double>(scratch.atoms, scratch.plain);
}

std::span<const double> BoundExpression::partials(const Motion& motion, ExpressionScratch& scratch) const {
  scratch.atoms.resize(bound_atoms().size());
  scratch.partials.resize(bound_atoms().size());
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) scratch.atoms[k] = atom_value(bound_atoms()[k], motion);
  expression_.evaluate<double>(scratch.atoms, std::span(scratch.partials), scratch.plain);
  return scratch.partials;
}

void BoundExpression::fill_along_motion(const Motion& motion, std::span<const Taylor> given,
                                        std::vector<Taylor>& atoms) const {
  atoms.resize(bound_atoms().size());
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    const bool from_others = !given.empty() && bound_atoms()[k].kind == BoundAtom::Kind::channel;
    atoms[k] = from_others ? given[k] : atom_along_motion(bound_atoms()[k], motion);
  }
}

Taylor BoundExpression::along_motion(const Motion& motion, ExpressionScratch& scratch) const {
  return along_motion(motion, scratch, {});
}

Taylor BoundExpression::along_motion(const Motion& motion, ExpressionScratch& scratch,
                                     std::span<const Taylor> given) const {
  fill_along_motion(motion, given, scratch.taylor_atoms);
  return expression_.evaluate<Taylor>(scratch.taylor_atoms, scratch.taylor);
}

void BoundExpression::add(const Motion& motion, Equations& eq, std::int32_t row, double factor,
                          PartialBy velocity_family) const {
  ExpressionScratch& scratch = eq.scratch;
  if (!eq.wants_partials()) {
    eq.add_residual(row, factor * value(motion, scratch));
    return;
  }
  scratch.atoms.resize(bound_atoms().size());
  scratch.partials.resize(bound_atoms().size());
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) scratch.atoms[k] = atom_value(bound_atoms()[k], motion);
  const double e = expression_.evaluate<double>(scratch.atoms, std::span(scratch.partials), scratch.plain);
  eq.add_residual(row, factor * e);
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    // A size that is zero grows whichever way things move: of no direction, and so its gradient counts as zero.
    const bool flat = is_size(bound_atoms()[k]) && scratch.atoms[k] == 0.0;
    const double partial = flat ? 0.0 : factor * scratch.partials[k];
    eq.begin_term(partial);
    add_atom(bound_atoms()[k], motion, {eq, row, velocity_family}, partial,
             flat || partial != 0.0 || passes_over(k, scratch));
  }
  eq.end_terms();
}

// A kink vanishes with its factor; a jump does only where nothing reads it.
bool BoundExpression::passes_over(std::size_t atom, const ExpressionScratch& scratch) const {
  const BoundAtom& a = bound_atoms()[atom];
  const bool jumps = a.kind == BoundAtom::Kind::measure && may_jump(a.measure);
  return !jumps || !expression_.reaches(atom, scratch.plain);
}

void BoundExpression::add_atom(const BoundAtom& a, const Motion& motion, const IntoEquation& into, double factor,
                               bool passes_over) const {
  using Kind = BoundAtom::Kind;
  if (a.kind == Kind::channel) {
    const PartialBy family = a.channel.kind == Channel::Kind::algebraic ? PartialBy::algebraic
                             : a.channel.kind == Channel::Kind::state   ? PartialBy::state
                                                                        : PartialBy::state_rate;
    into.eq.add(family, into.row, a.channel.index, factor);
  } else if (a.kind == Kind::force) {
    add_force(a, motion, into, factor);
  } else if (a.kind == Kind::measure) {
    for (const CoordinateBlock& block : blocks(a)) {
      const auto add_levels = [&]<std::size_t N>() {
        add_measure_gradient<N>(a, motion, block, into, factor, passes_over);
      };
      if (a.order == 0) add_levels.operator()<6>();
      if (a.order == 1) add_levels.operator()<12>();
      if (a.order == 2) add_levels.operator()<18>();
    }
  }
}

template <std::size_t N>
void BoundExpression::add_block_to_row(const BoundAtom& a, const Motion& motion, const CoordinateBlock& block,
                                       const IntoConstraint& into, const Taylor& partial) {
  const path::Seeded<N> m = path::varied_measure<N>(a.measure, a.places, motion, block);
  const bool nothing = partial.value == 0.0 && partial.rate == 0.0 && partial.acceleration == 0.0;
  // δX = Σ X_l δq^(l) and its rate, both times the partial e_X(t) of the expression.
  for (std::int32_t k = 0; k < block.count; ++k) {
    const auto at = [&](std::size_t level) {
      const std::size_t seed = 6 * level + static_cast<std::size_t>(k);
      const Taylor course(m.value.partial[seed], m.rate.partial[seed], m.acceleration.partial[seed]);
      return nothing ? Taylor() : partial * course;
    };
    const std::int32_t column = block.column + k;
    if (into.level == RowLevel::position) {
      into.rows.add_coordinate(into.row, column, at(0));
    } else if constexpr (N == 6) {
      const Taylor c0 = at(0);  // a displacement inside a velocity row has no δq′ of its own
      into.rows.add(into.row, column, {0.0, c0.value, c0.value, c0.rate});
    } else {
      const Taylor c0 = at(0), c1 = at(1);
      into.rows.add(into.row, column, {c1.value, c0.value, c1.rate, c0.rate});
    }
  }
}

void BoundExpression::add_measure_to_row(const BoundAtom& a, const Motion& motion, const IntoConstraint& into,
                                         const Taylor& partial) const {
  for (const CoordinateBlock& block : blocks(a)) {
    if (a.order == 0) {
      add_block_to_row<6>(a, motion, block, into, partial);
    } else {
      add_block_to_row<12>(a, motion, block, into, partial);
    }
  }
}

template <class Factor>
Taylor BoundExpression::add_to_row(const Motion& motion, const IntoConstraint& into, const Factor& factor,
                                   std::span<const Taylor> given) const {
  ExpressionScratch& scratch = into.rows.scratch;
  scratch.taylor_partials.resize(bound_atoms().size());
  fill_along_motion(motion, given, scratch.taylor_atoms);
  const Taylor e =
      expression_.evaluate<Taylor>(scratch.taylor_atoms, std::span(scratch.taylor_partials), scratch.taylor);
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    if (bound_atoms()[k].kind == BoundAtom::Kind::measure) {
      add_measure_to_row(bound_atoms()[k], motion, into, factor * scratch.taylor_partials[k]);
    }
  }
  return factor * e;
}

Taylor BoundExpression::add_position(const Motion& motion, ConstraintRows& rows, std::int32_t row,
                                     double factor) const {
  return add_to_row(motion, {rows, row, RowLevel::position}, factor, {});
}

void BoundExpression::add_position(const Motion& motion, ConstraintRows& rows, std::int32_t row, const Taylor& factor,
                                   std::span<const Taylor> given) const {
  add_to_row(motion, {rows, row, RowLevel::position}, factor, given);
}

Taylor BoundExpression::add_velocity(const Motion& motion, ConstraintRows& rows, std::int32_t row,
                                     double factor) const {
  return add_to_row(motion, {rows, row, RowLevel::velocity}, factor, {});
}

namespace {
// Principal values of angles that go on half a turn further on the other side.
bool jumps_by_a_turn(Measure m) {
  return m == Measure::PSI || m == Measure::PHI || m == Measure::YAW || m == Measure::ROLL;
}
}  // namespace

bool BoundExpression::has_switches() const {
  return expression_.has_switches() || std::any_of(bound_atoms().begin(), bound_atoms().end(), [](const BoundAtom& a) {
           return a.kind == BoundAtom::Kind::measure && jumps_by_a_turn(a.measure);
         });
}

void BoundExpression::switches(const Motion& motion, ExpressionScratch& scratch, SwitchList& out) const {
  scratch.atoms.resize(bound_atoms().size());
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    const BoundAtom& a = bound_atoms()[k];
    scratch.atoms[k] = atom_value(a, motion);
    const bool jumps = a.kind == BoundAtom::Kind::measure && jumps_by_a_turn(a.measure);
    if (jumps) out.add(std::sin(scratch.atoms[k]), std::cos(scratch.atoms[k]) < 0.0);
  }
  expression_.switches(scratch.atoms, scratch.plain, out);
}

void BoundExpression::look_ahead(const Motion& from, const Motion& to, ExpressionScratch& scratch,
                                 StepReach& reach) const {
  if (!has_tables()) return;
  scratch.atoms.resize(bound_atoms().size());
  std::vector<double> ahead(bound_atoms().size());
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    scratch.atoms[k] = atom_value(bound_atoms()[k], from);
    ahead[k] = atom_value(bound_atoms()[k], to);
  }
  expression_.look_ahead(scratch.atoms, ahead, scratch.plain, reach);
}

bool BoundExpression::reads_states_only() const {
  return std::all_of(bound_atoms().begin(), bound_atoms().end(), [](const BoundAtom& a) {
    using Kind = BoundAtom::Kind;
    if (a.kind == Kind::channel) return a.channel.kind == Channel::Kind::state;
    return a.kind != Kind::force && (a.kind != Kind::measure || a.order < 2);
  });
}

}  // namespace dynalin
