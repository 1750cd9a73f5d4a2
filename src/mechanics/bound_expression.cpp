#include "mechanics/bound_expression.h"

#include <algorithm>
#include <cmath>

#include "mechanics/seeded_frames.h"

namespace dynalin {

namespace {

template <std::size_t N>
void add_measure_gradient(Measure measure, const std::array<PlacedMarker, 4>& places, const Motion& motion, BodyId body,
                          Equations& eq, std::int32_t row, double factor, Column velocity_family) {
  const BodyBlock& block = eq.layout().body(body);
  const auto g = path::seeded_measure<N>(measure, places, motion, body).value.partial;
  const std::array families = {Column::position, velocity_family, Column::acceleration};
  for (std::size_t level = 0; 6 * level < N; ++level) {
    for (std::int32_t k = 0; k < block.count; ++k) {
      const double value = g[6 * level + static_cast<std::size_t>(k)];
      eq.add(families[level], row, block.offset + k, factor == 0.0 ? 0.0 : factor * value);
    }
  }
}

// Whether a measure looks at the axes of its k-th marker.
bool reads_axes(Measure m, std::size_t k) {
  switch (m) {
    case Measure::INCANG:
      return false;
    case Measure::DX:
    case Measure::DY:
    case Measure::DZ:
    case Measure::DM:
    case Measure::VX:
    case Measure::VY:
    case Measure::VZ:
    case Measure::VM:
    case Measure::VR:
    case Measure::ACCX:
    case Measure::ACCY:
    case Measure::ACCZ:
    case Measure::ACCM:
      return k >= 2;
    default:
      return true;
  }
}

// Where a marker is, and its axes where they are read: a floating marker has no place of its own. One on a curve whose
// axes do not matter is as well at the origin of the fixed marker that lies there, if there is one.
PlacedMarker find_marker(const Signals& signals, const Atom& atom, std::int64_t id, bool axes) {
  const Layout& layout = signals.layout();
  const MarkerId m = signals.marker(id), followed = signals.place_of(m);
  if (!signals.has_place(m)) {
    signals.problem("unplaced-marker", atom.at,
                    std::string(atom.at.text()) + " reads " +
                        layout.marker_labels[static_cast<std::size_t>(m.index)].full_text() +
                        ", a floating marker that no element gives a place");
  }
  const CurvePoint* on = layout.curve_point(m);
  if (!on || (!axes && !(followed == m))) return {layout.marker(followed)};
  return {layout.marker(on->carrier), on->curve.get(), on->coordinate, layout.extra_index(on->coordinate)};
}

}  // namespace

BoundExpression::BoundExpression(Expression expression, const Signals& signals, Binding binding)
    : expression_(expression.with_curves([&](SplineUse& use) { signals.attach(use); })) {
  for (const Atom& atom : expression_.atoms()) {
    atoms_.push_back(bind(atom, signals, binding));
    const BoundAtom& a = atoms_.back();
    for (std::size_t b = 0; b < a.body_count; ++b) {
      if (std::find(bodies_.begin(), bodies_.end(), a.bodies[b]) == bodies_.end()) bodies_.push_back(a.bodies[b]);
    }
    using Kind = BoundAtom::Kind;
    if (a.kind == Kind::measure) order_ = std::max(order_, static_cast<int>(a.order));
    if (a.kind == Kind::force) order_ = 2;
    if (a.kind == Kind::channel) reads_channels_ = true;
    if (binding == Binding::rates || binding == Binding::condition_rates) {
      const bool impossible = a.kind == Kind::force || (a.kind == Kind::measure && a.order == 2) ||
                              (a.kind == Kind::channel && a.channel.kind == Channel::Kind::state_rate);
      if (impossible) {
        signals.problem("unknown-rate", atom.at,
                        std::string(atom.at.text()) +
                            " stands in an expression whose time derivative DIF1 or DELAY needs, and has none that is "
                            "known",
                        "a DELAY needs none as a Padé approximant, run with --pade");
      } else if (a.kind == Kind::channel) {
        atoms_.back().rate = signals.rate_of(a.channel);
      }
    }
    if (a.kind != Kind::time && a.kind != Kind::mode && a.kind != Kind::constant) only_time_ = false;
  }
}

void BoundExpression::note_parameter(BoundAtom& a, const PlacedMarker& marker) {
  const auto end = a.parameters.begin() + a.parameter_count;
  if (marker.curve && std::find(a.parameters.begin(), end, marker.parameter) == end) {
    a.parameters[a.parameter_count++] = marker.parameter;
  }
}

const Atom* BoundExpression::atom_on_curve() const {
  for (std::size_t k = 0; k < atoms_.size(); ++k) {
    if (atoms_[k].parameter_count > 0) return &expression_.atoms()[k];
  }
  return nullptr;
}

BoundExpression::BoundAtom BoundExpression::bind(const Atom& atom, const Signals& signals, Binding binding) const {
  using Kind = BoundAtom::Kind;
  BoundAtom a{};
  const AtomFunction& f = *atom.function;
  switch (f.family) {
    case AtomFamily::time:
      a.kind = Kind::time;
      break;
    case AtomFamily::marker_measure: {
      a.kind = Kind::measure;
      a.measure = *find_measure(f.name);
      a.order = f.order;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int64_t written = k < atom.argument_count ? atom.argument[k] : 0;
        a.places[k] = find_marker(signals, atom, written, reads_axes(a.measure, k));
        note_parameter(a, a.places[k]);
        const BodyId body = a.places[k].place.body;
        const auto end = a.bodies.begin() + a.body_count;
        if (body != ground_body && std::find(a.bodies.begin(), end, body) == end) {
          a.bodies[a.body_count++] = body;
        }
      }
      if (counts_turns(a.measure) && binding != Binding::gradient) a.memory = signals.add_memory(0.0);
      break;
    }
    case AtomFamily::data:
      if (f.name == "MODE") {
        a.kind = Kind::mode;
        break;
      }
      if (f.name == "SENVAL") {
        a.kind = Kind::constant;  // no analysis of ours lets a sensor trigger
        break;
      }
      if (f.name == "DIF1" && (binding == Binding::condition || binding == Binding::condition_rates)) {
        a.kind = Kind::constant;
        break;
      }
      a.channel = signals.data(atom);
      if (a.channel.kind == Channel::Kind::none) {
        signals.problem("unfilled-entry", atom.at,
                        std::string(atom.at.text()) + " reads an entry that does not exist, or that nothing fills");
        a.channel = {Channel::Kind::constant, 0, 0};
      }
      a.kind = a.channel.kind == Channel::Kind::constant ? Kind::constant : Kind::channel;
      a.constant = a.channel.constant;
      break;
    case AtomFamily::delay:
      a.kind = Kind::channel;
      a.channel = signals.delayed(atom);
      break;
    case AtomFamily::element_force:
      a.kind = Kind::force;
      a.terms.push_back({signals.element(f.statement, atom.argument[0]), atom.argument[1] == 1});
      a.component = static_cast<std::uint8_t>(atom.argument[2]);
      a.axes_marker = find_marker(signals, atom, atom.argument[3], true);
      note_parameter(a, a.axes_marker);
      break;
    case AtomFamily::marker_force: {
      a.kind = Kind::force;
      static constexpr std::array<std::string_view, 8> names = {"FM", "FX", "FY", "FZ", "TM", "TX", "TY", "TZ"};
      a.component = static_cast<std::uint8_t>(std::find(names.begin(), names.end(), f.name) - names.begin() + 1);
      const MarkerId i = signals.marker(atom.argument[0]);
      const bool from_all = atom.argument[1] == 0;
      const MarkerId j = signals.marker(atom.argument[1]);
      for (const Signals::Element& e : signals.elements_at(i)) {
        const bool is_I = e.kernel->marker_I(e.index) == i;
        const MarkerId other = is_I ? e.kernel->marker_J(e.index) : e.kernel->marker_I(e.index);
        if (from_all || other == j) a.terms.push_back({e, !is_I});
      }
      a.axes_marker = find_marker(signals, atom, atom.argument[2], true);
      note_parameter(a, a.axes_marker);
      break;
    }
  }
  return a;
}

namespace {

// Force or torque on the marker of a term, global axes.
Vector on_marker(const MarkerWrench& w, bool on_J, bool torque) {
  if (!on_J) return torque ? w.force.torque : w.force.force;
  if (!w.force.acts_on_J) return {};
  if (!torque) return -w.force.force;
  const Vector delta = value(w.pair.I.origin) - value(w.pair.J.origin);
  return -w.force.torque - cross(delta, w.force.force);
}

bool is_torque(std::uint8_t component) { return component > 4; }
bool is_magnitude(std::uint8_t component) { return component == 1 || component == 5; }
std::size_t axis_of(std::uint8_t component) { return (component - 2u) % 4u; }

}  // namespace

double BoundExpression::atom_value(const BoundAtom& a, const Motion& motion) const {
  using Kind = BoundAtom::Kind;
  switch (a.kind) {
    case Kind::time:
      return motion.time;
    case Kind::mode:
      return static_cast<double>(motion.mode);
    case Kind::constant:
      return a.constant;
    case Kind::channel: {
      const auto k = static_cast<std::size_t>(a.channel.index);
      if (a.channel.kind == Channel::Kind::algebraic) return motion.algebraic[k];
      return a.channel.kind == Channel::Kind::state ? motion.state[k] : motion.state_rate[k];
    }
    case Kind::measure:
      return atom_along_motion(a, motion).value;
    case Kind::force: {
      Vector sum{};
      MarkerWrench w;
      for (const ForceTerm& t : a.terms) {
        w.clear();
        t.element.kernel->wrench(motion, t.element.index, false, w);
        sum += on_marker(w, t.on_J, is_torque(a.component));
      }
      if (is_magnitude(a.component)) return norm(sum);
      return dot(a.axes_marker.axes(motion)[axis_of(a.component)], sum);
    }
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
  Taylor m = evaluate_measure<Taylor>(a.measure, {a.places[0].frame(motion), a.places[1].frame(motion),
                                                  a.places[2].frame(motion), a.places[3].frame(motion)});
  if (a.memory >= 0) m.value = unwrapped(m.value, motion.memory[static_cast<std::size_t>(a.memory)]);
  return m;
}

double BoundExpression::value(const Motion& motion, ExpressionScratch& scratch) const {
  scratch.atoms.resize(atoms_.size());
  for (std::size_t k = 0; k < atoms_.size(); ++k) scratch.atoms[k] = atom_value(atoms_[k], motion);
  return expression_.evaluate<double>(scratch.atoms, scratch.plain);
}

std::span<const double> BoundExpression::partials(const Motion& motion, ExpressionScratch& scratch) const {
  scratch.atoms.resize(atoms_.size());
  scratch.partials.resize(atoms_.size());
  for (std::size_t k = 0; k < atoms_.size(); ++k) scratch.atoms[k] = atom_value(atoms_[k], motion);
  expression_.evaluate<double>(scratch.atoms, std::span(scratch.partials), scratch.plain);
  return scratch.partials;
}

Taylor BoundExpression::along_motion(const Motion& motion, ExpressionScratch& scratch) const {
  scratch.taylor_atoms.resize(atoms_.size());
  for (std::size_t k = 0; k < atoms_.size(); ++k) {
    scratch.taylor_atoms[k] = atom_along_motion(atoms_[k], motion);
  }
  return expression_.evaluate<Taylor>(scratch.taylor_atoms, scratch.taylor);
}

void BoundExpression::add(const Motion& motion, Equations& eq, std::int32_t row, double factor,
                          Column velocity_family) const {
  ExpressionScratch& scratch = eq.scratch;
  if (!eq.wants_partials()) {
    eq.add_residual(row, factor * value(motion, scratch));
    return;
  }
  scratch.atoms.resize(atoms_.size());
  scratch.partials.resize(atoms_.size());
  for (std::size_t k = 0; k < atoms_.size(); ++k) scratch.atoms[k] = atom_value(atoms_[k], motion);
  const double e = expression_.evaluate<double>(scratch.atoms, std::span(scratch.partials), scratch.plain);
  eq.add_residual(row, factor * e);
  for (std::size_t k = 0; k < atoms_.size(); ++k) {
    add_atom(atoms_[k], motion, eq, row, factor * scratch.partials[k], velocity_family);
  }
}

void BoundExpression::add_atom(const BoundAtom& a, const Motion& motion, Equations& eq, std::int32_t row, double factor,
                               Column velocity_family) const {
  using Kind = BoundAtom::Kind;
  if (a.kind == Kind::channel) {
    const Column family = a.channel.kind == Channel::Kind::algebraic ? Column::algebraic
                          : a.channel.kind == Channel::Kind::state   ? Column::state
                                                                     : Column::state_rate;
    eq.add(family, row, a.channel.index, factor);
  } else if (a.kind == Kind::force) {
    add_force(a, motion, eq, row, factor, velocity_family);
  } else if (a.kind == Kind::measure) {
    for (std::size_t b = 0; b < a.body_count; ++b) {
      const auto add_levels = [&]<std::size_t N>() {
        add_measure_gradient<N>(a.measure, a.places, motion, a.bodies[b], eq, row, factor, velocity_family);
      };
      if (a.order == 0) add_levels.operator()<6>();
      if (a.order == 1) add_levels.operator()<12>();
      if (a.order == 2) add_levels.operator()<18>();
    }
    const std::array families = {Column::position, velocity_family, Column::acceleration};
    for (std::size_t p = 0; p < a.parameter_count; ++p) {
      const auto m = path::measure_by_parameter(a.measure, a.places, motion, a.parameters[p]);
      for (std::size_t level = 0; level <= static_cast<std::size_t>(a.order); ++level) {
        eq.add(families[level], row, a.parameters[p], factor == 0.0 ? 0.0 : factor * m.value.partial[level]);
      }
    }
  }
}

void BoundExpression::add_force(const BoundAtom& a, const Motion& motion, Equations& eq, std::int32_t row,
                                double factor, Column velocity_family) const {
  const bool torque = is_torque(a.component);
  std::vector<MarkerWrench> wrenches(a.terms.size());
  Vector sum{};
  for (std::size_t t = 0; t < a.terms.size(); ++t) {
    const ForceTerm& term = a.terms[t];
    term.element.kernel->wrench(motion, term.element.index, true, wrenches[t]);
    sum += on_marker(wrenches[t], term.on_J, torque);
  }
  // The direction that picks the component: an axis of the marker, or that of the vector itself.
  Vector e{};
  if (is_magnitude(a.component)) {
    const double size = norm(sum);
    if (size > 0) e = sum / size;
  } else {
    e = a.axes_marker.axes(motion)[axis_of(a.component)];
    const BodyBlock& block = eq.layout().body(a.axes_marker.place.body);
    if (block.count == 6) {
      const Vector turn = cross(e, sum);
      for (std::size_t k = 0; k < 3; ++k) {
        eq.add(Column::position, row, block.offset + 3 + static_cast<std::int32_t>(k), factor * turn[k]);
      }
    }
    for (std::size_t p = 0; p < a.parameter_count; ++p) {
      const auto axes = path::frame_by_parameter(motion, a.axes_marker, a.parameters[p]).axes;
      const auto& axis = axes[axis_of(a.component)];
      const Vector slope{axis.x.value.partial[0], axis.y.value.partial[0], axis.z.value.partial[0]};
      eq.add(Column::position, row, a.parameters[p], factor * dot(slope, sum));
    }
  }

  for (std::size_t t = 0; t < a.terms.size(); ++t) {
    const MarkerWrench& w = wrenches[t];
    const PairMotion& p = w.pair;
    const bool on_J = a.terms[t].on_J;
    if (on_J && !w.force.acts_on_J) continue;
    const Vector delta = dynalin::value(p.I.origin) - dynalin::value(p.J.origin);
    // e·(vector of interest) in terms of force and torque on I.
    const auto picked = [&](const Vector& f, const Vector& m) {
      if (!torque) return on_J ? -dot(e, f) : dot(e, f);
      return on_J ? -dot(e, m) - dot(e, cross(delta, f)) : dot(e, m);
    };
    const std::array<const BodyBlock*, 2> blocks = {&eq.layout().body(p.body_I), &eq.layout().body(p.body_J)};
    const Matrix3 one = Matrix3::identity();
    const std::array<Matrix3, 4> delta_groups = {one, -skew(dynalin::value(p.arm_I)), -one,
                                                 skew(dynalin::value(p.arm_J))};
    for (std::size_t g = 0; g < 4; ++g) {
      const BodyBlock& block = *blocks[g / 2];
      const std::int32_t first = g % 2 == 0 ? 0 : 3;
      if (block.count < first + 3) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t column = block.offset + first + static_cast<std::int32_t>(k);
        double value = picked(w.force.force_on_position.group[g][k], w.force.torque_on_position.group[g][k]);
        if (torque && on_J && !w.J_follows_I) value -= dot(e, cross(delta_groups[g][k], w.force.force));
        eq.add(Column::position, row, column, factor * value);
        eq.add(velocity_family, row, column,
               factor * picked(w.force.force_on_velocity.group[g][k], w.force.torque_on_velocity.group[g][k]));
      }
    }
    for (const MarkerWrench::Scalar& s : w.scalars) {
      const Column family = s.family == Column::damping ? velocity_family : s.family;
      eq.add(family, row, s.column, factor * picked(s.force, s.torque));
    }
    for (const MarkerWrench::Turn& turn : w.turns) {
      const BodyBlock& block = eq.layout().body(turn.body);
      for (std::int32_t k = 0; k < 3 && block.count == 6; ++k) {
        const auto at = static_cast<std::size_t>(k);
        eq.add(Column::position, row, block.offset + 3 + k, factor * picked(turn.force[at], turn.torque[at]));
      }
    }
  }
}

namespace {

template <std::size_t N>
void add_measure_row(Measure measure, const std::array<PlacedMarker, 4>& places, const Motion& motion, BodyId body,
                     ConstraintRows& rows, std::int32_t row, const BodyBlock& block, const Taylor& partial,
                     RowLevel row_level) {
  const path::Seeded<N> m = path::seeded_measure<N>(measure, places, motion, body);
  // δX = Σ X_l δq^(l) and its rate, both times the partial e_X(t) of the expression.
  for (std::int32_t k = 0; k < block.count; ++k) {
    const auto at = [&](std::size_t level) {
      const std::size_t seed = 6 * level + static_cast<std::size_t>(k);
      const Taylor course(m.value.partial[seed], m.rate.partial[seed], m.acceleration.partial[seed]);
      return partial * course;
    };
    const std::int32_t column = block.offset + k;
    if (row_level == RowLevel::position) {
      rows.add_coordinate(row, column, at(0));
    } else if constexpr (N == 6) {
      const Taylor c0 = at(0);  // a displacement inside a velocity row has no δq′ of its own
      rows.add(row, column, {0.0, c0.value, c0.value, c0.rate});
    } else {
      const Taylor c0 = at(0), c1 = at(1);
      rows.add(row, column, {c1.value, c0.value, c1.rate, c0.rate});
    }
  }
}

}  // namespace

void BoundExpression::add_measure_to_row(const BoundAtom& a, const Motion& motion, ConstraintRows& rows,
                                         std::int32_t row, const Taylor& partial, RowLevel level) const {
  // Only rows without reactions read curve parameters, and those are rows of positions.
  for (std::size_t p = 0; p < a.parameter_count; ++p) {
    const auto m = path::measure_by_parameter(a.measure, a.places, motion, a.parameters[p]);
    rows.add_coordinate(row, a.parameters[p],
                        partial * Taylor(m.value.partial[0], m.rate.partial[0], m.acceleration.partial[0]));
  }
  for (std::size_t b = 0; b < a.body_count; ++b) {
    const BodyBlock& block = rows.layout().body(a.bodies[b]);
    if (a.order == 0) {
      add_measure_row<6>(a.measure, a.places, motion, a.bodies[b], rows, row, block, partial, level);
    } else {
      add_measure_row<12>(a.measure, a.places, motion, a.bodies[b], rows, row, block, partial, level);
    }
  }
}

Taylor BoundExpression::add_to_row(const Motion& motion, ConstraintRows& rows, std::int32_t row, double factor,
                                   RowLevel level) const {
  ExpressionScratch& scratch = rows.scratch;
  scratch.taylor_atoms.resize(atoms_.size());
  scratch.taylor_partials.resize(atoms_.size());
  for (std::size_t k = 0; k < atoms_.size(); ++k) {
    scratch.taylor_atoms[k] = atom_along_motion(atoms_[k], motion);
  }
  const Taylor e =
      expression_.evaluate<Taylor>(scratch.taylor_atoms, std::span(scratch.taylor_partials), scratch.taylor);
  for (std::size_t k = 0; k < atoms_.size(); ++k) {
    if (atoms_[k].kind == BoundAtom::Kind::measure) {
      add_measure_to_row(atoms_[k], motion, rows, row, factor * scratch.taylor_partials[k], level);
    }
  }
  return factor * e;
}

Taylor BoundExpression::add_position(const Motion& motion, ConstraintRows& rows, std::int32_t row,
                                     double factor) const {
  return add_to_row(motion, rows, row, factor, RowLevel::position);
}

Taylor BoundExpression::add_velocity(const Motion& motion, ConstraintRows& rows, std::int32_t row,
                                     double factor) const {
  return add_to_row(motion, rows, row, factor, RowLevel::velocity);
}

void BoundExpression::remember(const Motion& motion, Memory& memory) const {
  for (const BoundAtom& a : atoms_) {
    if (a.memory >= 0) memory[static_cast<std::size_t>(a.memory)] = atom_along_motion(a, motion).value;
  }
}

std::string BoundExpression::fault(const Motion& motion) const {
  std::vector<double> values;
  for (const BoundAtom& a : atoms_) values.push_back(atom_value(a, motion));
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isfinite(values[k])) continue;
    const BoundAtom& a = atoms_[k];
    const bool straight =
        a.axes_marker.straight(motion) ||
        std::any_of(a.places.begin(), a.places.end(), [&](const auto& p) { return p.straight(motion); });
    return std::string(expression_.atoms()[k].at.text()) +
           (straight ? " reads the y or z axis of a marker at a point of contact where the curve is straight"
                     : " has no finite value");
  }
  const auto found = expression_.find_fault<double>(values, FaultSearch::value_and_partials);
  return found ? found->reason : std::string();
}

}  // namespace dynalin
