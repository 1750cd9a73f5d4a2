// Function expressions, control elements and placing: the part of the model that reads, not moves.
#include <algorithm>
#include <stdexcept>

#include "model.h"

namespace dynalin::oracle {

namespace {

int id_or_zero(const std::vector<int>& ids, std::size_t k) { return k < ids.size() ? ids[k] : 0; }

}  // namespace

Real Model::evaluate(const Expr& expression) const { return evaluate_node(*expression.node); }

Real Model::evaluate_node(const Node& n) const {
  switch (n.op) {
    case Op::constant:
      return n.value;
    case Op::time:
      return time;
    case Op::add:
      return evaluate(n.arguments[0]) + evaluate(n.arguments[1]);
    case Op::subtract:
      return evaluate(n.arguments[0]) - evaluate(n.arguments[1]);
    case Op::multiply:
      return evaluate(n.arguments[0]) * evaluate(n.arguments[1]);
    case Op::divide:
      return evaluate(n.arguments[0]) / evaluate(n.arguments[1]);
    case Op::power: {
      const Real base = evaluate(n.arguments[0]);
      return base * base;
    }
    case Op::function:
      return evaluate_function(n);
    case Op::measure:
      return evaluate_measure(n);
    case Op::varval:
      return variable_values[static_cast<std::size_t>(variable_index(n.ids[0]))];
    case Op::aryval:
      return array_entry(n.ids[0], n.ids[1]);
    case Op::dif:
      return z[diff_of_id_.at(n.ids[0])];
    case Op::joint: {
      const int joint = joint_index_.at(n.ids[0]);
      const auto [i, j] = joint_markers_[static_cast<std::size_t>(joint)];
      const Vec i_from_j = markers_[static_cast<std::size_t>(i)].p - markers_[static_cast<std::size_t>(j)].p;
      return wrench_component(joint_wrench(joint), i_from_j, n.ids);
    }
    case Op::sforce: {
      const auto k = static_cast<std::size_t>(sforce_index_.at(n.ids[0]));
      const auto [i, j] = sforce_markers_[k];
      const Sforce& s = mechanism_.sforces[k];
      const Vec i_from_j = markers_[static_cast<std::size_t>(i)].p - markers_[static_cast<std::size_t>(j)].p;
      if (s.reaction == Reaction::action_only && n.ids[1] == 1) return 0;
      return wrench_component(sforce_wrench(s, sforce_values[k]), i_from_j, n.ids);
    }
    case Op::linear: {
      const auto found = std::find_if(mechanism_.linears.begin(), mechanism_.linears.end(), [&](const LinearForce& f) {
        return f.id == n.ids[0] && static_cast<int>(f.kind) == n.ids[4];
      });
      const Vec i_from_j = markers_[static_cast<std::size_t>(marker_index(found->i))].p -
                           markers_[static_cast<std::size_t>(marker_index(found->j))].p;
      return wrench_component(linear_wrench(*found), i_from_j, n.ids);
    }
    case Op::spline: {
      const auto found = std::find_if(mechanism_.splines.begin(), mechanism_.splines.end(),
                                      [&](const SplinePoints& p) { return p.id == n.ids[0]; });
      return spline_value(*found, evaluate(n.arguments[0]), n.ids[1] != 0);
    }
    case Op::gforce:
      return wrench_component(general_wrench(static_cast<std::size_t>(gforce_index_.at(n.ids[0]))), Vec{}, n.ids);
  }
  throw std::runtime_error("an expression has an unknown operation");
}

// Inside the points only. The cubic spline by its second derivatives, with third differences given at the ends.
Real Model::spline_value(const SplinePoints& points, Real at, bool akima) const {
  const std::size_t n = points.x.size();
  const auto x = [&](std::size_t k) { return static_cast<Real>(points.x[k]); };
  const auto y = [&](std::size_t k) { return static_cast<Real>(points.y[k]); };
  const auto h = [&](std::size_t k) { return x(k + 1) - x(k); };
  const auto m = [&](std::size_t k) { return (y(k + 1) - y(k)) / h(k); };
  std::size_t k = 0;
  while (k + 2 < n && at >= x(k + 1)) ++k;
  const Real s = at - x(k);
  if (akima) {
    std::vector<Real> slope(n + 3);  // two beyond either end, with constant differences
    for (std::size_t i = 0; i + 1 < n; ++i) slope[i + 2] = m(i);
    slope[1] = 2 * slope[2] - slope[3], slope[0] = 2 * slope[1] - slope[2];
    slope[n + 1] = 2 * slope[n] - slope[n - 1], slope[n + 2] = 2 * slope[n + 1] - slope[n];
    const auto tangent = [&](std::size_t i) {
      const Real right = std::fabs(slope[i + 3] - slope[i + 2]), left = std::fabs(slope[i + 1] - slope[i]);
      return right + left == 0 ? (slope[i + 1] + slope[i + 2]) / 2
                               : (right * slope[i + 1] + left * slope[i + 2]) / (right + left);
    };
    // Hermite's basis on the piece.
    const Real t = s / h(k), u = 1 - t;
    return y(k) * u * u * (1 + 2 * t) + y(k + 1) * t * t * (3 - 2 * t) +
           h(k) * (tangent(k) * t * u * u - tangent(k + 1) * t * t * u);
  }
  Dense A(n, n);
  std::vector<Real> b(n, 0);
  const auto third = [&](std::size_t i) {
    const Real first = (m(i + 1) - m(i)) / (x(i + 2) - x(i)), second = (m(i + 2) - m(i + 1)) / (x(i + 3) - x(i + 1));
    return 6 * (second - first) / (x(i + 3) - x(i));
  };
  A(0, 0) = -1, A(0, 1) = 1, b[0] = third(0) * h(0);
  A(n - 1, n - 2) = -1, A(n - 1, n - 1) = 1, b[n - 1] = third(n - 4) * h(n - 2);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    A(i, i - 1) = h(i - 1), A(i, i) = 2 * (h(i - 1) + h(i)), A(i, i + 1) = h(i);
    b[i] = 6 * (m(i) - m(i - 1));
  }
  const std::vector<Real> M = Lu(A).solve(b);
  return y(k) + s * (m(k) - h(k) * (2 * M[k] + M[k + 1]) / 6) + s * s * M[k] / 2 +
         s * s * s * (M[k + 1] - M[k]) / (6 * h(k));
}

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

Real Model::evaluate_function(const Node& n) const {
  const Real a = evaluate(n.arguments[0]);
  switch (n.function) {
    case Function::sin:
      return std::sin(a);
    case Function::cos:
      return std::cos(a);
    case Function::tanh:
      return std::tanh(a);
    case Function::exp:
      return std::exp(a);
    case Function::sqrt:
      return std::sqrt(a);
    case Function::atan:
      return std::atan(a);
    case Function::atan2:
      return std::atan2(a, evaluate(n.arguments[1]));
    case Function::step: {
      const Real x0 = evaluate(n.arguments[1]), h0 = evaluate(n.arguments[2]);
      const Real x1 = evaluate(n.arguments[3]), h1 = evaluate(n.arguments[4]);
      if (a <= x0) return h0;
      if (a >= x1) return h1;
      const Real s = (a - x0) / (x1 - x0);
      return h0 + (h1 - h0) * s * s * (3 - 2 * s);
    }
  }
  throw std::runtime_error("an expression has an unknown function");
}

Real Model::evaluate_measure(const Node& n) const {
  const auto marker = [&](std::size_t k) -> const MarkerMotion& {
    return markers_[static_cast<std::size_t>(marker_index(id_or_zero(n.ids, k)))];
  };
  const MarkerMotion& i = marker(0);
  const MarkerMotion& j = marker(1);
  const Vec r = i.p - j.p;
  const auto along = [&](const Vec& v, int k) { return dot(v, marker(2).axis[static_cast<std::size_t>(k)]); };
  // The reference frame of derivatives is the fourth marker; the magnitudes have no axes, so their
  // frame is the third.
  const bool magnitude = n.measure == Measure::VM || n.measure == Measure::ACCM || n.measure == Measure::WDTM;
  const MarkerMotion& l = magnitude ? marker(2) : marker(3);
  const auto velocity = [&] { return i.v - j.v - cross(l.w, r); };
  const auto acceleration = [&] {
    return i.a - j.a - cross(l.al, r) - 2.0L * cross(l.w, velocity()) - cross(l.w, cross(l.w, r));
  };
  const auto angular = [&] { return i.al - j.al - cross(l.w, i.w - j.w); };
  const int index = static_cast<int>(n.measure);
  const auto from = [&](Measure first) { return index - static_cast<int>(first); };
  switch (n.measure) {
    case Measure::DX:
    case Measure::DY:
    case Measure::DZ:
      return along(r, from(Measure::DX));
    case Measure::DM:
      return norm(r);
    case Measure::VX:
    case Measure::VY:
    case Measure::VZ:
      return along(velocity(), from(Measure::VX));
    case Measure::VM:
      return norm(velocity());
    case Measure::VR:
      return dot(r, i.v - j.v) / norm(r);
    case Measure::WX:
    case Measure::WY:
    case Measure::WZ:
      return along(i.w - j.w, from(Measure::WX));
    case Measure::WM:
      return norm(i.w - j.w);
    case Measure::ACCX:
    case Measure::ACCY:
    case Measure::ACCZ:
      return along(acceleration(), from(Measure::ACCX));
    case Measure::ACCM:
      return norm(acceleration());
    case Measure::WDTX:
    case Measure::WDTY:
    case Measure::WDTZ:
      return along(angular(), from(Measure::WDTX));
    case Measure::WDTM:
      return norm(angular());
    case Measure::AX:
      return std::atan2(-dot(i.axis[2], j.axis[1]), dot(i.axis[2], j.axis[2]));
    case Measure::AY:
      return std::atan2(dot(i.axis[2], j.axis[0]), dot(i.axis[2], j.axis[2]));
    case Measure::AZ:
      return std::atan2(dot(i.axis[0], j.axis[1]), dot(i.axis[0], j.axis[0]));
  }
  throw std::runtime_error("an expression has an unknown measure");
}

// --------------------------------------------------------------------------------------- controls

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

std::vector<Real> Model::differential_rates() const {
  std::vector<Real> rates;
  const auto append = [&](const std::vector<Real>& more) { rates.insert(rates.end(), more.begin(), more.end()); };
  for (std::size_t k = 0; k < mechanism_.lses.size(); ++k) append(lse_rates(k));
  for (std::size_t k = 0; k < mechanism_.tfsisos.size(); ++k) append(tfsiso_rates(k));
  for (const Diff& diff : mechanism_.diffs) {
    rates.push_back(evaluate(diff.function) / (diff.coefficient ? evaluate(*diff.coefficient) : 1));
  }
  return rates;
}

}  // namespace dynalin::oracle
