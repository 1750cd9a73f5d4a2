#include "evaluation.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <utility>

namespace dynalin::oracle {

namespace {

int id_or_zero(const std::vector<int>& ids, std::size_t k) { return k < ids.size() ? ids[k] : 0; }

Vector3<Jet> jets(const Vec& v, const Vec& d, const Vec& dd) {
  return {{v.x, d.x, dd.x}, {v.y, d.y, dd.y}, {v.z, d.z, dd.z}};
}
Vec dark() { return {unknown(), unknown(), unknown()}; }

}  // namespace

template <>
Real Evaluator<Real>::without_rate(Real value) {
  return value;
}
template <>
Jet Evaluator<Jet>::without_rate(Real value) {
  return {value, unknown(), unknown()};
}

template <class T>
Evaluator<T>::View::View(const Evaluator& of, int id)
    : m_(of.model_.markers_[static_cast<std::size_t>(of.model_.marker_index(id))]), variation_(of.variation_) {
  const auto& data = of.model_.marker_data_[static_cast<std::size_t>(of.model_.marker_index(id))];
  if (data.contact >= 0) {
    at_contact_ = of.contact_view(static_cast<std::size_t>(data.contact), data.on_i);
  } else if (variation_ != nullptr && data.body == variation_->body) {
    turn_ = variation_->turn;
    shift_ = variation_->shift + cross(turn_, m_.p - of.model_.motion[static_cast<std::size_t>(data.body)].p);
  }
}
template <class T>
Vector3<T> Evaluator<T>::View::p() const {
  if (at_contact_) return at_contact_->p;
  if constexpr (std::is_same_v<T, Real>)
    return m_.p;
  else if (variation_ == nullptr)
    return jets(m_.p, m_.v, m_.a);
  else
    return jets(m_.p, variation_->of_rates ? Vec{} : shift_, dark());
}
template <class T>
Vector3<T> Evaluator<T>::View::v() const {
  if (at_contact_) return at_contact_->v;
  if constexpr (std::is_same_v<T, Real>)
    return m_.v;
  else if (variation_ == nullptr)
    return jets(m_.v, m_.a, dark());
  else
    return jets(m_.v, variation_->of_rates ? shift_ : dark(), dark());
}
template <class T>
Vector3<T> Evaluator<T>::View::a() const {
  if (at_contact_) return at_contact_->a;
  if constexpr (std::is_same_v<T, Real>)
    return m_.a;
  else
    return jets(m_.a, dark(), dark());
}
template <class T>
Vector3<T> Evaluator<T>::View::w() const {
  if (at_contact_) return at_contact_->w;
  if constexpr (std::is_same_v<T, Real>)
    return m_.w;
  else if (variation_ == nullptr)
    return jets(m_.w, m_.al, dark());
  else
    return jets(m_.w, variation_->of_rates ? turn_ : dark(), dark());
}
template <class T>
Vector3<T> Evaluator<T>::View::al() const {
  if (at_contact_) return at_contact_->al;
  if constexpr (std::is_same_v<T, Real>)
    return m_.al;
  else
    return jets(m_.al, dark(), dark());
}
template <class T>
Vector3<T> Evaluator<T>::View::axis(std::size_t k) const {
  if (at_contact_) return at_contact_->axis[k];
  if constexpr (std::is_same_v<T, Real>)
    return m_.axis[k];
  else if (variation_ == nullptr)
    return jets(m_.axis[k], m_.axis1[k], m_.axis2[k]);
  else
    return jets(m_.axis[k], variation_->of_rates ? Vec{} : cross(turn_, m_.axis[k]), dark());
}

// A VARIABLE is an unknown of its own; its rate is that of its expression.
template <>
Real Evaluator<Real>::variable(int id) const {
  return model_.variable_values[static_cast<std::size_t>(model_.variable_index(id))];
}
template <>
Jet Evaluator<Jet>::variable(int id) const {
  if (depth_ > 20) throw std::logic_error("a VARIABLE that refers to itself has no rate here");
  const auto k = static_cast<std::size_t>(model_.variable_index(id));
  if (model_.cut[k] != 0) return {model_.variable_values[k], 0, 0};
  ++depth_;
  Jet along = (*this)(model_.mechanism_.variables[k].function);
  --depth_;
  along.v = model_.variable_values[k];
  return along;
}

template <>
Real Evaluator<Real>::state(int id) const {
  return model_.diff_value(model_.diff_index_.at(id));
}
template <>
Jet Evaluator<Jet>::state(int id) const {
  const std::size_t k = model_.diff_index_.at(id);
  return {model_.diff_value(k), model_.diff_rate(k), unknown()};
}

template <class T>
T Evaluator<T>::node(const Node& n) const {
  const auto argument = [&](std::size_t k) { return (*this)(n.arguments[k]); };
  switch (n.op) {
    case Op::constant:
      return T(static_cast<Real>(n.value));
    case Op::time:
      if constexpr (std::is_same_v<T, Jet>) return {model_.time, variation_ == nullptr ? model_.clock : 0, 0};
      return T(model_.time);
    case Op::place:
      return T(line_point().place);
    case Op::line_motion:
      return without_rate(
          component((n.ids[1] < 3 ? line_point().motion : line_point().turning)[static_cast<std::size_t>(n.ids[0])],
                    n.ids[1] % 3));
    case Op::add:
      return argument(0) + argument(1);
    case Op::subtract:
      return argument(0) - argument(1);
    case Op::multiply:
      return argument(0) * argument(1);
    case Op::divide:
      return argument(0) / argument(1);
    case Op::power: {
      const T base = argument(0);
      return base * base;
    }
    case Op::function: {
      std::vector<T> values;
      for (const Expr& a : n.arguments) values.push_back((*this)(a));
      return mathematical_function(n.function, values);
    }
    case Op::measure:
      return measured(n);
    case Op::varval:
      return variable(n.ids[0]);
    case Op::input_value:
      return variable(model_.mechanism_.pinput.variables.at(static_cast<std::size_t>(n.ids[1] - 1)));
    case Op::output_value:
      return variable(model_.mechanism_.poutput.variables.at(static_cast<std::size_t>(n.ids[1] - 1)));
    case Op::dif:
      return state(n.ids[0]);
    case Op::dif1:
      return without_rate(model_.diff_rate(model_.diff_index_.at(n.ids[0])));
    case Op::aryval:
      return without_rate(model_.array_entry(n.ids[0], n.ids[1]));
    case Op::spline:
      return spline(n);
    case Op::spectrum:
      return spectrum(n);
    case Op::senval:
      return T(0);
    case Op::delay:
      return without_rate(model_.delayed_value(n));
    case Op::curve:
      return curve(n);
    case Op::gap:
      return gap(n);
    default:
      return without_rate(model_.load_value(n));
  }
}

template <class T>
T Evaluator<T>::spline(const Node& n) const {
  const auto& splines = model_.mechanism_.splines;
  const auto found =
      std::find_if(splines.begin(), splines.end(), [&](const SplinePoints& p) { return p.id == n.ids[0]; });
  const T x = (*this)(n.arguments[0]);
  const auto curve = [&](const std::vector<double>& y) {
    const Piece p = spline_piece(found->x, y, value_of(x), static_cast<Interpolation>(n.ids[1]));
    const T s = x - T(p.start);
    if (n.ids[2] == 2) return T(2 * p.c) + T(6 * p.d) * s;
    if (n.ids[2] == 1) return T(p.b) + s * (T(2 * p.c) + T(3 * p.d) * s);
    return T(p.a) + s * (T(p.b) + s * (T(p.c) + T(p.d) * s));
  };
  if (n.arguments.size() < 2) return curve(found->y);
  const T z = (*this)(n.arguments[1]);
  const T share = (z - T(static_cast<Real>(found->z[0]))) / T(static_cast<Real>(found->z[1]) - found->z[0]);
  return (T(1) - share) * curve(found->y) + share * curve(found->beyond);
}

// Phase k of a seed: the generator's number k scaled to a turn. Each step adds a constant, so number k needs no other.
Real phase_of(int seed, int k) {
  std::uint64_t word = static_cast<std::uint64_t>(seed) + static_cast<std::uint64_t>(k + 1) * 11400714819323198485u;
  for (const auto& [shift, factor] : {std::pair{30, 13787848793156543929u}, {27, 10723151780598845931u}}) {
    word ^= word >> shift;
    word *= factor;
  }
  word ^= word >> 31;
  return 2 * std::numbers::pi_v<Real> * std::ldexp(static_cast<Real>(word >> 11), -53);
}

template <class T>
T Evaluator<T>::spectrum(const Node& n) const {
  using std::cos;
  using std::sin;
  const auto& splines = model_.mechanism_.splines;
  const auto data =
      std::find_if(splines.begin(), splines.end(), [&](const SplinePoints& p) { return p.id == n.ids[0]; });
  // The density accumulated up to f, by trapezia.
  const auto power_below = [&](Real f) {
    Real sum = 0;
    for (std::size_t k = 0; k + 1 < data->x.size() && data->x[k] < f; ++k) {
      const Real h = static_cast<Real>(data->x[k + 1]) - data->x[k], s = std::min<Real>(1, (f - data->x[k]) / h);
      const Real at_s = data->y[k] + s * (static_cast<Real>(data->y[k + 1]) - data->y[k]);
      sum += (data->y[k] + at_s) / 2 * s * h;
    }
    return sum;
  };
  const T x = (*this)(n.arguments[0]);
  const Real low = n.arguments[1].node->value, high = n.arguments[2].node->value;
  T sum(0);
  for (int k = 0; k < n.ids[1]; ++k) {
    const auto edge = [&](int j) { return low + (high - low) * j / n.ids[1]; };
    const Real size = std::sqrt(2 * (power_below(edge(k + 1)) - power_below(edge(k)))), phase = phase_of(n.ids[2], k);
    const T turn = T(std::numbers::pi_v<Real> * (edge(k) + edge(k + 1))) * x;
    sum = sum + T(size * std::cos(phase)) * sin(turn) + T(size * std::sin(phase)) * cos(turn);
  }
  return sum;
}

template <class T>
T Evaluator<T>::curve(const Node& n) const {
  return component(model_.curves_.at(n.ids[0]).at((*this)(n.arguments[0]), n.ids[1]), n.ids[2] - 1);
}

template <class T>
T Evaluator<T>::measured(const Node& n) const {
  using std::atan2;
  const View i = view(n.ids[0]), j = view(id_or_zero(n.ids, 1));
  const Vector3<T> r = i.p() - j.p();
  const auto along = [&](const Vector3<T>& v, int k) {
    return dot(v, view(id_or_zero(n.ids, 2)).axis(static_cast<std::size_t>(k)));
  };
  // The reference frame of derivatives is the fourth marker; the magnitudes have no axes, so their
  // frame is the third.
  const bool magnitude = n.measure == Measure::VM || n.measure == Measure::ACCM || n.measure == Measure::WDTM;
  const auto velocity = [&](const View& l) { return i.v() - j.v() - cross(l.w(), r); };
  const auto from = [&](Measure first) { return static_cast<int>(n.measure) - static_cast<int>(first); };
  // Row a, column b of the axes of I in those of J, 1-based.
  const auto R = [&](std::size_t a, std::size_t b) { return dot(j.axis(a - 1), i.axis(b - 1)); };
  using std::sqrt;
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
      return along(velocity(view(id_or_zero(n.ids, 3))), from(Measure::VX));
    case Measure::VR:
      return dot(r, i.v() - j.v()) / norm(r);
    case Measure::WX:
    case Measure::WY:
    case Measure::WZ:
      return along(i.w() - j.w(), from(Measure::WX));
    case Measure::WM:
      return norm(i.w() - j.w());
    case Measure::VM:
    case Measure::ACCX:
    case Measure::ACCY:
    case Measure::ACCZ:
    case Measure::ACCM: {
      const View l = view(id_or_zero(n.ids, magnitude ? 2 : 3));
      if (n.measure == Measure::VM) return norm(velocity(l));
      const Vector3<T> a =
          i.a() - j.a() - cross(l.al(), r) - T(2) * cross(l.w(), velocity(l)) - cross(l.w(), cross(l.w(), r));
      return n.measure == Measure::ACCM ? norm(a) : along(a, from(Measure::ACCX));
    }
    case Measure::WDTX:
    case Measure::WDTY:
    case Measure::WDTZ:
    case Measure::WDTM: {
      const View l = view(id_or_zero(n.ids, magnitude ? 2 : 3));
      const Vector3<T> a = i.al() - j.al() - cross(l.w(), i.w() - j.w());
      return n.measure == Measure::WDTM ? norm(a) : along(a, from(Measure::WDTX));
    }
    case Measure::AX:
      return atan2(-R(2, 3), R(3, 3));
    case Measure::AY:
      return atan2(R(1, 3), R(3, 3));
    case Measure::AZ:
      return atan2(R(2, 1), R(1, 1));
    case Measure::PSI:
      return atan2(R(1, 3), -R(2, 3));
    case Measure::THETA:
      return atan2(sqrt(R(1, 3) * R(1, 3) + R(2, 3) * R(2, 3)), R(3, 3));
    case Measure::PHI:
      return atan2(R(3, 1), R(3, 2));
    case Measure::YAW:
      return atan2(R(2, 1), R(1, 1));
    case Measure::PITCH:
      return atan2(R(3, 1), sqrt(R(1, 1) * R(1, 1) + R(2, 1) * R(2, 1)));
    case Measure::ROLL:
      return atan2(R(3, 2), R(3, 3));
    case Measure::INCANG: {
      const Vector3<T> other = view(n.ids[2]).p() - j.p();
      return atan2(norm(cross(r, other)), dot(r, other));
    }
    case Measure::UVX:
    case Measure::UVY:
    case Measure::UVZ:
      return dot(i.axis(static_cast<std::size_t>(from(Measure::UVX))), j.axis(static_cast<std::size_t>(n.ids[2])));
  }
  throw std::runtime_error("an expression has an unknown measure");
}

template class Evaluator<Real>;
template class Evaluator<Jet>;

Real Model::evaluate(const Expr& expression) const { return Evaluator<Real>(*this)(expression); }
Real Model::evaluate_at(const Expr& expression, const LinePoint& point) const {
  return Evaluator<Real>(*this, nullptr, &point)(expression);
}
Jet Model::evaluate_along(const Expr& expression) const { return Evaluator<Jet>(*this)(expression); }

// Inside the points only.
Piece spline_piece(const std::vector<double>& xs, const std::vector<double>& ys, Real at, Interpolation method) {
  const std::size_t n = xs.size();
  const auto x = [&](std::size_t k) { return static_cast<Real>(xs[k]); };
  const auto y = [&](std::size_t k) { return static_cast<Real>(ys[k]); };
  const auto h = [&](std::size_t k) { return x(k + 1) - x(k); };
  const auto m = [&](std::size_t k) { return (y(k + 1) - y(k)) / h(k); };
  std::size_t k = 0;
  while (k + 2 < n && at >= x(k + 1)) ++k;
  if (method == Interpolation::linear) return {x(k), y(k), m(k), 0, 0};
  if (method == Interpolation::akima) {
    std::vector<Real> slope(n + 3);  // two beyond either end, with constant differences
    for (std::size_t i = 0; i + 1 < n; ++i) slope[i + 2] = m(i);
    slope[1] = 2 * slope[2] - slope[3], slope[0] = 2 * slope[1] - slope[2];
    slope[n + 1] = 2 * slope[n] - slope[n - 1], slope[n + 2] = 2 * slope[n + 1] - slope[n];
    const auto tangent = [&](std::size_t i) {
      const Real right = std::fabs(slope[i + 3] - slope[i + 2]), left = std::fabs(slope[i + 1] - slope[i]);
      return right + left == 0 ? (slope[i + 1] + slope[i + 2]) / 2
                               : (right * slope[i + 1] + left * slope[i + 2]) / (right + left);
    };
    // The cubic with these values and tangents at both ends.
    const Real t0 = tangent(k), t1 = tangent(k + 1);
    return {x(k), y(k), t0, (3 * m(k) - 2 * t0 - t1) / h(k), (t0 + t1 - 2 * m(k)) / (h(k) * h(k))};
  }
  // The cubic spline by its second derivatives, with third differences given at the ends.
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
  return {x(k), y(k), m(k) - h(k) * (2 * M[k] + M[k + 1]) / 6, M[k] / 2, (M[k + 1] - M[k]) / (6 * h(k))};
}

}  // namespace dynalin::oracle
