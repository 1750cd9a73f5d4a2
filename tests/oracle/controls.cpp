// What control elements and loads read as: arrays, states, rates, and the force functions.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model.h"

namespace dynalin::oracle {

Real Model::wrench_component(const Wrench& on_i, const Vec& i_from_j, const std::vector<int>& ids) const {
  Wrench w = on_i;
  if (ids[1] == 1) w = {-on_i.f, -on_i.t - cross(i_from_j, on_i.f)};
  const int comp = ids[2];
  if (comp == 1) return norm(w.f);
  if (comp == 5) return norm(w.t);
  const auto& axes = markers_[static_cast<std::size_t>(marker_index(ids[3]))].axis;
  if (comp < 5) return dot(w.f, axes[static_cast<std::size_t>(comp - 2)]);
  return dot(w.t, axes[static_cast<std::size_t>(comp - 6)]);
}

Real Model::load_value(const Node& n) const {
  const auto numbered = [&](const auto& list, auto&& same) {
    return static_cast<std::size_t>(std::find_if(list.begin(), list.end(), same) - list.begin());
  };
  const auto has_id = [&](const auto& element) { return element.id == n.ids[0]; };
  switch (n.op) {
    case Op::joint: {
      const int joint = joint_index_.at(n.ids[0]);
      const auto [i, j] = joint_markers_[static_cast<std::size_t>(joint)];
      return wrench_component(joint_wrench(joint), between(i, j), n.ids);
    }
    case Op::motion: {
      const std::size_t k = numbered(mechanism_.motions, has_id);
      const auto [i, j] = joint_markers_[static_cast<std::size_t>(joint_index_.at(mechanism_.motions[k].joint))];
      return wrench_component(motion_wrench(static_cast<int>(k)), between(i, j), n.ids);
    }
    case Op::sforce: {
      const std::size_t k = numbered(mechanism_.sforces, has_id);
      const auto [i, j] = sforce_markers_[k];
      if (mechanism_.sforces[k].reaction == Reaction::action_only && n.ids[1] == 1) return 0;
      return wrench_component(sforce_wrench(k), between(i, j), n.ids);
    }
    case Op::friction: {
      const std::size_t k = numbered(mechanism_.frictions, has_id);
      const auto [i, j] = joint_markers_[static_cast<std::size_t>(joint_index_.at(mechanism_.frictions[k].joint))];
      return wrench_component(friction_wrench(k), between(i, j), n.ids);
    }
    case Op::touch: {
      const std::size_t k = numbered(mechanism_.touches, has_id);
      const Touch& t = mechanism_.touches[k];
      return wrench_component(touch_wrench(k), between(marker_index(t.i), marker_index(t.j)), n.ids);
    }
    case Op::spring: {
      const std::size_t k = numbered(mechanism_.springs, has_id);
      const auto [i, j] = spring_markers_[k];
      return wrench_component(spring_wrench(k), between(i, j), n.ids);
    }
    case Op::linear: {
      const std::size_t k = numbered(mechanism_.linears, [&](const LinearForce& f) {
        return f.id == n.ids[0] && static_cast<int>(f.kind) == n.ids[4];
      });
      const LinearForce& f = mechanism_.linears[k];
      return wrench_component(linear_wrench(f), between(marker_index(f.i), marker_index(f.j)), n.ids);
    }
    case Op::gforce:
      return wrench_component(general_wrench(numbered(mechanism_.gforces, has_id)), Vec{}, n.ids);
    case Op::contact: {
      const std::size_t k = numbered(mechanism_.contacts, [&](const Contact& c) {
        return c.id == n.ids[0] && !c.plane && !c.axis && c.two_curves == (n.ids[4] != 0);
      });
      return wrench_component(contact_wrench(k), Vec{}, n.ids);
    }
    case Op::marker_force:
      return wrench_component(net_wrench(n.ids[0], n.ids[1]), Vec{}, {0, 0, n.ids[2], n.ids[3]});
    default:
      throw std::logic_error("not a load");
  }
}

// The torque is about the origin of marker i. Elements count that name the marker, and j as their other one.
Wrench Model::net_wrench(int i_id, int j_id) const {
  const int i = marker_index(i_id), j = j_id == 0 ? -1 : marker_index(j_id);
  Wrench sum;
  const auto add = [&](int on, int from, const Wrench& w, bool reacts) {
    if (on == i && (j < 0 || from == j)) sum.f += w.f, sum.t += w.t;
    if (!reacts || from != i || (j >= 0 && on != j)) return;
    sum.f += -w.f;
    sum.t += -w.t - cross(between(on, from), w.f);
  };
  for (std::size_t k = 0; k < mechanism_.joints.size(); ++k) {
    add(joint_markers_[k][0], joint_markers_[k][1], joint_wrench(static_cast<int>(k)), true);
  }
  for (std::size_t k = 0; k < mechanism_.motions.size(); ++k) {
    const auto [a, b] = joint_markers_[static_cast<std::size_t>(joint_index_.at(mechanism_.motions[k].joint))];
    add(a, b, motion_wrench(static_cast<int>(k)), true);
  }
  for (std::size_t k = 0; k < mechanism_.springs.size(); ++k) {
    add(spring_markers_[k][0], spring_markers_[k][1], spring_wrench(k), true);
  }
  for (std::size_t k = 0; k < mechanism_.sforces.size(); ++k) {
    const bool reacts = mechanism_.sforces[k].reaction == Reaction::on_j;
    add(sforce_markers_[k][0], sforce_markers_[k][1], sforce_wrench(k), reacts);
  }
  for (std::size_t k = 0; k < mechanism_.frictions.size(); ++k) {
    const auto [a, b] = joint_markers_[static_cast<std::size_t>(joint_index_.at(mechanism_.frictions[k].joint))];
    add(a, b, friction_wrench(k), true);
  }
  for (std::size_t k = 0; k < mechanism_.touches.size(); ++k) {
    const Touch& t = mechanism_.touches[k];
    add(marker_index(t.i), marker_index(t.j), touch_wrench(k), true);
  }
  for (const LinearForce& f : mechanism_.linears) add(marker_index(f.i), marker_index(f.j), linear_wrench(f), true);
  for (const Journal& f : mechanism_.journals) add(marker_index(f.i), marker_index(f.j), journal_wrench(f), true);
  for (std::size_t k = 0; k < mechanism_.gforces.size(); ++k) {
    // The floating marker stands at the origin of I.
    const GeneralForce& f = mechanism_.gforces[k];
    const Wrench w = general_wrench(k);
    if (marker_index(f.i) == i && (j < 0 || marker_index(f.jfloat) == j)) sum.f += w.f, sum.t += w.t;
    if (marker_index(f.jfloat) == i && (j < 0 || marker_index(f.i) == j)) sum.f += -w.f, sum.t += -w.t;
  }
  for (std::size_t k = 0; k < mechanism_.contacts.size(); ++k) {
    // Floating markers stand at the contact, and so does I of a PTCV.
    const Contact& c = mechanism_.contacts[k];
    const int on_i = marker_index(c.floats_on_i() ? c.ifloat : c.i), on_j = marker_index(c.jfloat);
    const Wrench w = contact_wrench(k);
    if (on_i == i && (j < 0 || on_j == j)) sum.f += w.f, sum.t += w.t;
    if (on_j == i && (j < 0 || on_i == j)) sum.f += -w.f, sum.t += -w.t;
  }
  return sum;
}

// At rest it is e itself.
Real Model::delayed_value(const Node& n) const {
  const Real lag = evaluate(n.arguments[1]);
  if (clock == 0 || lag <= 0) return evaluate(n.arguments[0]);
  if (delay_offset.empty()) return n.arguments[2].node->value + n.arguments[3].node->value * (time - lag);
  const Jet e = evaluate_along(n.arguments[0]);
  return e.v - lag * e.d + delay_offset.at(&n);
}

void Model::expand_delays() {
  std::map<const Node*, Real> offset;
  const auto record = [&](const Expr& e) {
    walk(e, [&](const Node& n) {
      if (n.op != Op::delay) return;
      const Jet now = evaluate_along(n.arguments[0]);
      const Real lag = evaluate(n.arguments[1]);
      offset[&n] = delayed_value(n) - (now.v - lag * now.d);
    });
  };
  for (const Variable& v : mechanism_.variables) record(v.function);
  for (const Sforce& s : mechanism_.sforces) record(s.function);
  for (const Diff& d : mechanism_.diffs) record(d.function);
  delay_offset = std::move(offset);
}

Real Model::diff_value(std::size_t k) const {
  return mechanism_.diffs[k].kind == DiffKind::algebraic ? algebraic_values[k] : z[diff_slot_[k]];
}

Real Model::diff_rate(std::size_t k) const {
  const Diff& diff = mechanism_.diffs[k];
  if (diff.kind == DiffKind::algebraic) return algebraic_rates[k];
  if (!held_rates.empty()) return held_rates[k];
  const Real function = evaluate(diff.function);
  return diff.kind == DiffKind::explicit_rate ? function : function / evaluate(diff.coefficient);
}

Real Model::input_entry(int array, std::size_t index) const {
  const Array& a = mechanism_.arrays[static_cast<std::size_t>(array_index_.at(array))];
  return variable_values[static_cast<std::size_t>(variable_index(a.variables.at(index)))];
}

Real Model::array_entry(int id, int index) const {
  const Array& a = mechanism_.arrays[static_cast<std::size_t>(array_index_.at(id))];
  const auto at = static_cast<std::size_t>(index - 1);
  if (a.kind == ArrayKind::ic) return a.numbers.at(at);
  if (a.kind == ArrayKind::u) return input_entry(id, at);
  for (std::size_t k = 0; k < mechanism_.tfsisos.size(); ++k) {
    const Tfsiso& tf = mechanism_.tfsisos[k];
    if (tf.x == id) return z[tfsiso_slot_[k] + at];
    if (tf.y != id) continue;
    const std::size_t order = tf.denominator.size() - 1;
    const Real q =
        tf.numerator.size() == order + 1 ? static_cast<Real>(tf.numerator[order]) / tf.denominator[order] : 0.0L;
    return (order > 0 ? z[tfsiso_slot_[k]] : 0.0L) + q * input_entry(tf.u, 0);
  }
  for (std::size_t k = 0; k < mechanism_.lses.size(); ++k) {
    const Lse& lse = mechanism_.lses[k];
    if (lse.x == id) return z[lse_slot_[k] + at];
    if (lse.y != id) continue;
    Real sum = 0;
    const auto times = [&](int matrix, auto&& entry) {
      if (matrix == 0) return;
      const NumberMatrix& m = number_matrix(matrix);
      const auto columns = static_cast<std::size_t>(m.columns);
      for (std::size_t c = 0; c < columns; ++c) sum += m.values[at * columns + c] * entry(c);
    };
    times(lse.c, [&](std::size_t c) { return z[lse_slot_[k] + c]; });
    times(lse.d, [&](std::size_t c) { return input_entry(lse.u, c); });
    return sum;
  }
  for (std::size_t k = 0; k < mechanism_.gses.size(); ++k) {
    if (mechanism_.gses[k].x == id) return z[gse_slot_[k] + at];
    if (mechanism_.gses[k].y == id) return gse_output(k, at);
  }
  throw std::runtime_error("an ARRAY belongs to no element");
}

// The observer form in ascending coefficients: row m of the denominator made monic stands in the first
// column, the inputs carry the numerator.
std::vector<Real> Model::tfsiso_rates(std::size_t k) const {
  const Tfsiso& tf = mechanism_.tfsisos[k];
  const std::size_t order = tf.denominator.size() - 1;
  const Real lead = tf.denominator[order];
  const auto p = [&](std::size_t m) { return tf.denominator[m] / lead; };
  const auto q = [&](std::size_t m) { return m < tf.numerator.size() ? tf.numerator[m] / lead : 0.0L; };
  const Real u = input_entry(tf.u, 0);
  const std::size_t first = tfsiso_slot_[k];
  std::vector<Real> rates(order);
  for (std::size_t m = 0; m < order; ++m) {
    const std::size_t power = order - 1 - m;
    rates[m] = -p(power) * z[first] + (q(power) - p(power) * q(order)) * u;
    if (m + 1 < order) rates[m] += z[first + m + 1];
  }
  return rates;
}

std::vector<Real> Model::lse_rates(std::size_t k) const {
  const Lse& lse = mechanism_.lses[k];
  const NumberMatrix& a = number_matrix(lse.a);
  const auto n = static_cast<std::size_t>(a.rows);
  std::vector<Real> rates(n, 0);
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c < n; ++c) rates[r] += a.values[r * n + c] * z[lse_slot_[k] + c];
    if (lse.b == 0) continue;
    const NumberMatrix& b = number_matrix(lse.b);
    const auto columns = static_cast<std::size_t>(b.columns);
    for (std::size_t c = 0; c < columns; ++c) {
      rates[r] += b.values[r * columns + c] * input_entry(lse.u, c);
    }
  }
  return rates;
}

Real Model::gse_output(std::size_t k, std::size_t row) const {
  const Gse& e = mechanism_.gses[k];
  const auto n = static_cast<std::size_t>(e.states), m = static_cast<std::size_t>(e.inputs);
  Real y = e.g[row] * std::tanh(z[gse_slot_[k]]);
  for (std::size_t c = 0; c < n; ++c) y += e.c[row * n + c] * z[gse_slot_[k] + c];
  for (std::size_t c = 0; c < m; ++c) y += e.d[row * m + c] * input_entry(e.u, c);
  return y;
}

std::vector<Real> Model::gse_rates(std::size_t k) const {
  const Gse& e = mechanism_.gses[k];
  const auto n = static_cast<std::size_t>(e.states), m = static_cast<std::size_t>(e.inputs);
  const Real* x = z.data() + gse_slot_[k];
  std::vector<Real> rates(n);
  for (std::size_t r = 0; r < n; ++r) {
    rates[r] = e.e[r] * std::sin(x[r]) * input_entry(e.u, 0);
    for (std::size_t c = 0; c < n; ++c) rates[r] += e.a[r * n + c] * x[c];
    for (std::size_t c = 0; c < m; ++c) rates[r] += e.b[r * m + c] * input_entry(e.u, c);
    if (e.implicit) rates[r] /= 2 + std::sin(x[r]);
  }
  return rates;
}

std::vector<Real> Model::diff_rates() const {
  std::vector<Real> rates;
  for (std::size_t k = 0; k < mechanism_.diffs.size(); ++k) rates.push_back(diff_rate(k));
  return rates;
}

std::vector<Real> Model::differential_rates() const {
  std::vector<Real> rates;
  const auto append = [&](const std::vector<Real>& more) { rates.insert(rates.end(), more.begin(), more.end()); };
  for (std::size_t k = 0; k < mechanism_.lses.size(); ++k) append(lse_rates(k));
  for (std::size_t k = 0; k < mechanism_.gses.size(); ++k) append(gse_rates(k));
  for (std::size_t k = 0; k < mechanism_.tfsisos.size(); ++k) append(tfsiso_rates(k));
  for (std::size_t k = 0; k < mechanism_.diffs.size(); ++k) {
    if (mechanism_.diffs[k].kind != DiffKind::algebraic) rates.push_back(diff_rate(k));
  }
  for (std::size_t k = 0; k < mechanism_.frictions.size(); ++k) append(creep_rates(k));
  return rates;
}

}  // namespace dynalin::oracle
