// Control elements, inputs and outputs of a draw.
#include <algorithm>
#include <string>

#include "generator.h"

namespace dynalin::oracle {

Expr Draw::feature(int self) {
  Expr sum = constant(uniform(-0.5, 0.5));
  const int terms = 1 + pick(3);
  for (int k = 0; k < terms; ++k) {
    Expr term = shaped_kinematic();
    if (chance(0.3)) term = term * shaped_kinematic();
    sum = sum + uniform(-0.6, 0.6) * term;
  }
  if (chance(0.4)) sum = sum + uniform(-0.25, 0.25) * shaped(acceleration());
  if (chance(0.4)) sum = sum + uniform(-0.25, 0.25) * shaped(reaction());
  if (chance(0.5)) sum = sum + uniform(-0.3, 0.3) * shaped(varval(one_of(features_)));
  if (chance(0.15)) sum = sum + uniform(-0.3, 0.3) * call(Function::sin, {varval(self) + time_now()});
  if (!states_.empty() && chance(0.4)) sum = sum + uniform(-0.5, 0.5) * one_of(states_);
  if (chance(0.15)) sum = sum + uniform(-0.5, 0.5) * shaped(delayed_signal(true));
  if (chance(0.1)) sum = sum + uniform(-0.3, 0.3) * ((constant(1) + senval(1)) * kinematic());
  if (chance(0.2))
    sum = sum + uniform(-0.4, 0.4) *
                    (chance(0.3) ? input_value(1 + pick(static_cast<int>(inputs_.size()))) : varval(one_of(inputs_)));
  return sum;
}

// Of what has a rate that is known, by a time that may depend on the state. The rate of a state is evaluated here, so
// no state may be delayed in its own rate.
Expr Draw::delayed_signal(bool of_states) {
  Expr e = uniform(-0.6, 0.6) * shaped_kinematic();
  const auto smooth = [&] {
    return uniform(-0.5, 0.5) * call(Function::sin, {kinematic()}) * call(Function::atan, {kinematic()});
  };
  if (chance(0.5)) e = e + uniform(-0.5, 0.5) * varval(variable(smooth() + uniform(-0.3, 0.3) * kinematic()));
  if (chance(0.3)) e = e + uniform(-0.3, 0.3) * call(Function::sin, {2.0 * time_now()});
  if (of_states && !m_.diffs.empty() && m_.diffs[0].kind != DiffKind::algebraic) e = e + uniform(-0.3, 0.3) * dif(1);
  Expr lag = constant(uniform(0.05, 0.2));
  if (chance(0.4)) lag = lag + 0.04 * call(Function::sin, {kinematic()});
  return delayed(e, lag, uniform(-0.3, 0.3), uniform(-1, 1));
}

void Draw::draw_differential_elements() {
  const auto inputs_of = [&](int n) {
    Array u{next_array_++, ArrayKind::u, {}, {}};
    for (int k = 0; k < n; ++k) u.variables.push_back(chance(0.3) ? one_of(inputs_) : one_of(features_));
    m_.arrays.push_back(u);
    return u.id;
  };
  const auto owned = [&](ArrayKind kind) {
    m_.arrays.push_back({next_array_, kind, {}, {}});
    return next_array_++;
  };
  const auto matrix = [&](int rows, int columns, double size) {
    NumberMatrix a{next_matrix_++, rows, columns, {}};
    for (int k = 0; k < rows * columns; ++k) a.values.push_back(uniform(-size, size));
    m_.matrices.push_back(a);
    return a.id;
  };
  if (chance(0.45)) {
    const int order = 1 + pick(3);
    Tfsiso t;
    t.id = 1;
    t.u = inputs_of(1);
    t.x = owned(ArrayKind::x);
    t.y = owned(ArrayKind::y);
    for (int k = 0; k <= order; ++k) t.denominator.push_back(uniform(0.5, 3));
    const int numerator_order = pick(order + 1);
    for (int k = 0; k <= numerator_order; ++k) t.numerator.push_back(uniform(-1, 1));
    m_.tfsisos.push_back(t);
    states_.push_back(aryval(t.y, 1));
    states_.push_back(aryval(t.x, order));
  }
  if (chance(0.35)) {
    const int n = 1 + pick(3), inputs = 1 + pick(2);
    Lse e;
    e.id = 1;
    e.u = inputs_of(inputs);
    e.x = owned(ArrayKind::x);
    e.y = owned(ArrayKind::y);
    e.a = matrix(n, n, 1.5);
    e.b = matrix(n, inputs, 1);
    e.c = matrix(2, n, 0.7);
    if (chance(0.5)) e.d = matrix(2, inputs, 0.3);
    if (chance(0.6)) {
      Array ic{next_array_++, ArrayKind::ic, {}, {}};
      for (int k = 0; k < n; ++k) ic.numbers.push_back(uniform(-1, 1));
      m_.arrays.push_back(ic);
      e.ic = ic.id;
    }
    m_.lses.push_back(e);
    states_.push_back(aryval(e.y, 1 + pick(2)));
  }
  draw_gse();
  const int diffs = chance(0.5) ? 1 + pick(2) : 0;
  for (int k = 1; k <= diffs; ++k) {
    m_.diffs.push_back({k, uniform(-1, 1), {}});
    states_.push_back(dif(k));
    rates_.push_back(dif1(k));
  }
  draw_algebraic_diffs();
}

void Draw::draw_diff_functions() {
  for (Diff& d : m_.diffs) {
    if (d.kind == DiffKind::algebraic) continue;
    d.function = uniform(-1.5, 0.5) * dif(d.id) + uniform(-1, 1) * varval(one_of(features_)) +
                 uniform(-0.5, 0.5) * shaped(dif(d.id) * kinematic());
    if (chance(0.3)) d.function = d.function + uniform(-0.5, 0.5) * varval(one_of(inputs_));
    if (chance(0.3)) d.function = d.function + uniform(-0.5, 0.5) * acceleration();
    if (chance(0.2)) d.function = d.function + uniform(-0.5, 0.5) * delayed_signal(false);
    if (!chance(0.4)) continue;
    d.kind = DiffKind::implicit_rate;
    d.coefficient = constant(uniform(1, 2)) + uniform(-0.3, 0.3) * shaped_kinematic() + 0.1 * square(dif(d.id));
  }
}

// Unknowns of their own: a z + b z^3 = g has one root. With DIF1 asked for, g has a rate that is known: no
// accelerations, no reactions, and VARIABLEs without loops.
void Draw::draw_algebraic_diffs() {
  const int count = chance(0.5) ? 1 + pick(2) : 0;
  for (int k = 0; k < count; ++k) {
    Diff d;
    d.id = static_cast<int>(m_.diffs.size()) + 1;
    d.ic = uniform(-0.5, 0.5);
    d.kind = DiffKind::algebraic;
    d.rate_read = chance(0.5);
    const auto smooth = [&] {
      return uniform(-0.5, 0.5) * call(Function::sin, {kinematic()}) * call(Function::atan, {kinematic()});
    };
    Expr g = constant(uniform(-0.3, 0.3)) + uniform(-0.5, 0.5) * shaped_kinematic();
    if (d.rate_read) {
      const int inner = variable(smooth() + uniform(-0.3, 0.3) * kinematic());
      const int outer = variable(square(varval(inner)) + smooth());
      g = constant(uniform(-0.3, 0.3)) + uniform(-0.8, 0.8) * varval(outer) + smooth() +
          uniform(-0.3, 0.3) * call(Function::sin, {2.0 * time_now()});
      if (!m_.diffs.empty() && m_.diffs[0].kind != DiffKind::algebraic) g = g + uniform(-0.3, 0.3) * dif(1);
      rates_.push_back(dif1(d.id));
    } else {
      g = g + uniform(-0.4, 0.4) * varval(one_of(features_));
      if (chance(0.4)) g = g + uniform(-0.2, 0.2) * reaction();
      if (chance(0.4)) g = g + uniform(-0.2, 0.2) * acceleration();
    }
    const Expr z = dif(d.id);
    d.function = uniform(0.8, 2) * z + uniform(0.1, 0.6) * square(z) * z - g;
    m_.diffs.push_back(d);
    states_.push_back(z);
  }
}

void Draw::draw_controls() {
  const int inputs = 1 + pick(2), features = 2 + pick(3);
  for (int k = 0; k < inputs; ++k) inputs_.push_back(variable(constant(0)));
  for (int k = 0; k < features; ++k) features_.push_back(variable(constant(0)));
  draw_differential_elements();
  for (const int id : features_) m_.variables[static_cast<std::size_t>(id - 1)].function = feature(id);
  // Three variables deep, with a reaction at the bottom of some.
  const int bottom = variable(constant(uniform(-0.3, 0.3)) + 0.5 * reaction());
  const int first =
      variable(shaped(varval(chance(0.5) ? bottom : one_of(features_))) + uniform(-0.3, 0.3) * shaped_kinematic());
  const int second = variable(shaped(varval(first)) * varval(first));
  features_.push_back(variable(shaped(varval(second)) + uniform(-0.2, 0.2) * varval(first)));
  for (const int id : inputs_) {
    if (chance(0.2)) {
      m_.variables[static_cast<std::size_t>(id - 1)].function = uniform(-0.5, 0.5) * shaped_kinematic();
    }
  }
  draw_diff_functions();
  m_.pinput = {1, inputs_};
}

void Draw::draw_outputs() {
  std::vector<int> outputs;
  outputs.push_back(variable(displacement()));
  outputs.push_back(variable(velocity()));
  outputs.push_back(variable(acceleration()));
  outputs.push_back(variable(reaction()));
  const Sforce& s = one_of(m_.sforces);
  const bool line = s.direction == Direction::translational;
  const int flag = s.reaction == Reaction::action_only ? 0 : pick(2);
  const int rm = chance(0.5) ? 0 : one_of(oriented_);
  outputs.push_back(variable((line ? 1 / F_ : 1 / (F_ * L_)) * sforce_load(s.id, flag, (line ? 2 : 6) + pick(3), rm)));
  outputs.push_back(one_of(features_));
  if (!m_.linears.empty()) outputs.push_back(variable(load()));
  if (!m_.gforces.empty()) {
    const int comp = 2 + pick(3) + 4 * pick(2);
    outputs.push_back(variable((1 / (comp > 4 ? F_ * L_ : F_)) *
                               gforce_load(general_statement(m_.gforces[0]), 1, pick(2), comp, one_of(oriented_))));
  }
  if (!states_.empty()) outputs.push_back(variable(one_of(states_)));
  if (!rates_.empty()) outputs.push_back(variable(rate()));
  outputs.push_back(variable(net_load()));
  outputs.push_back(variable(shaped(output_value(1 + pick(4)))));
  if (chance(0.2)) outputs.push_back(one_of(inputs_));
  m_.poutput = {1, outputs};
  // Coordinates wanted as states: bare displacements and angles.
  if (chance(0.6)) return;
  for (int k = 1 + pick(2); k > 0; --k) {
    const auto [i, j] = distant_pair(true);
    const bool turns = body_of(i).kind != BodyKind::point_mass && chance(0.3);
    const auto kind = static_cast<Measure>(turns ? static_cast<int>(Measure::AX) + pick(3) : pick(3));
    m_.pstate.variables.push_back(variable(turns         ? measure(kind, {i, j})
                                           : chance(0.3) ? measure(Measure::DM, {i, j})
                                                         : measure(kind, {i, j, j})));
  }
  m_.pstate.id = 1;
}

}  // namespace dynalin::oracle
