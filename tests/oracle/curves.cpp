#include "curves.h"

#include <algorithm>

namespace dynalin::oracle {

namespace {

// n (n - 1) ... of `count` factors.
Real falling(std::size_t n, int count) {
  Real product = 1;
  for (int k = 0; k < count; ++k) product *= static_cast<Real>(n) - static_cast<Real>(k);
  return product;
}

// B-spline i of order k on the knots t by its recursive definition.
Real b_spline(const std::vector<Real>& t, std::size_t i, std::size_t k, Real u) {
  if (k == 1) return u >= t[i] && u < t[i + 1] ? 1 : 0;
  Real sum = 0;
  if (t[i + k - 1] > t[i]) sum += (u - t[i]) / (t[i + k - 1] - t[i]) * b_spline(t, i, k - 1, u);
  if (t[i + k] > t[i + 1]) sum += (t[i + k] - u) / (t[i + k] - t[i + 1]) * b_spline(t, i + 1, k - 1, u);
  return sum;
}

// The one on whole numbers, about zero: differences of truncated powers.
Real centred_b_spline(std::size_t k, Real x) {
  Real sum = 0, binomial = 1;
  for (std::size_t j = 0; j <= k; ++j) {
    const Real beyond = x + static_cast<Real>(k) / 2 - static_cast<Real>(j);
    if (beyond > 0) sum += (j % 2 == 0 ? 1 : -1) * binomial * std::pow(beyond, static_cast<Real>(k - 1));
    binomial *= static_cast<Real>(k - j) / static_cast<Real>(j + 1);
  }
  return sum / falling(k - 1, static_cast<int>(k) - 1);
}

Real mean(const std::vector<Real>& list, std::size_t first, std::size_t count) {
  Real sum = 0;
  for (std::size_t k = first; k < first + count; ++k) sum += list[k];
  return sum / static_cast<Real>(count);
}

}  // namespace

CurveShape::CurveShape(const Curve& curve, const NumberMatrix& points)
    : closed_(curve.closed), order_(static_cast<std::size_t>(curve.order)) {
  std::vector<Vec> p;
  for (std::size_t r = 0; 3 * r < points.values.size(); ++r) {
    p.push_back({points.values[3 * r], points.values[3 * r + 1], points.values[3 * r + 2]});
  }
  closed_ ? take_closed(p, curve.controls) : take_open(p, curve.controls);
}

// Through points: equal steps of u, knots at the means of k - 1 of these parameters. Along control points: uniform
// knots; the spline is met at the means of k - 1 knots, with what the B-splines give there.
void CurveShape::take_open(const std::vector<Vec>& points, bool controls) {
  const std::size_t n = points.size(), k = order_;
  std::vector<Real> parameters;
  for (std::size_t i = 0; i < n; ++i) parameters.push_back(-1 + 2 * static_cast<Real>(i) / static_cast<Real>(n - 1));
  if (!controls) {
    for (std::size_t j = 1; j + k <= n; ++j) knots_.push_back(mean(parameters, j, k - 1));
    interpolate(parameters, points);
    return;
  }
  for (std::size_t j = 1; j + k <= n; ++j)
    knots_.push_back(-1 + 2 * static_cast<Real>(j) / static_cast<Real>(n - k + 1));
  std::vector<Real> t(k, -1);
  t.insert(t.end(), knots_.begin(), knots_.end());
  t.insert(t.end(), k, 1);
  std::vector<Vec> values(n);
  for (std::size_t i = 0; i < n; ++i) {
    parameters[i] = mean(t, i + 1, k - 1);
    for (std::size_t j = 0; j < n; ++j) values[i] += b_spline(t, j, k, parameters[i]) * points[j];
  }
  values[0] = points[0], values[n - 1] = points[n - 1];
  interpolate(parameters, values);
}

// The last point is the first. Knots at the points, or halfway between them where the order is odd.
void CurveShape::take_closed(const std::vector<Vec>& points, bool controls) {
  const std::size_t n = points.size() - 1;
  const Real step = 2 / static_cast<Real>(n);
  first_ = order_ % 2 == 0 ? -1 : -1 - step / 2;
  std::vector<Real> parameters;
  std::vector<Vec> values(n);
  for (std::size_t i = 0; i < n; ++i) {
    parameters.push_back(-1 + static_cast<Real>(i) * step);
    if (i > 0) knots_.push_back(first_ + static_cast<Real>(i) * step);
    values[i] = controls ? Vec{} : points[i];
    for (std::size_t j = 0; j < n && controls; ++j) {
      for (int turn = -2; turn <= 2; ++turn) {  // around the closure
        const Real away = static_cast<Real>(i) - static_cast<Real>(j) + static_cast<Real>(turn) * static_cast<Real>(n);
        values[i] += centred_b_spline(order_, away) * points[j];
      }
    }
  }
  interpolate(parameters, values);
}

Real CurveShape::basis(std::size_t k, Real u, int derivative) const {
  const std::size_t power = std::min(k, order_ - 1);
  const Real s = u - (k < order_ ? first_ : knots_[k - order_]);
  if (power < static_cast<std::size_t>(derivative) || (k >= order_ && s <= 0)) return 0;
  Real value = falling(power, derivative);
  for (auto j = static_cast<std::size_t>(derivative); j < power; ++j) value *= s;
  return value;
}

void CurveShape::interpolate(const std::vector<Real>& parameters, const std::vector<Vec>& values) {
  const std::size_t n = order_ + knots_.size(), given = parameters.size();
  Dense A(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < given; ++i) A(i, j) = basis(j, parameters[i], 0);
    for (std::size_t i = given; i < n; ++i) {
      const auto m = static_cast<int>(i - given);
      A(i, j) = basis(j, first_ + 2, m) - basis(j, first_, m);
    }
  }
  const Lu lu(A);
  coefficient_.assign(n, {});
  for (int c = 0; c < 3; ++c) {
    std::vector<Real> b(n, 0);
    for (std::size_t i = 0; i < given; ++i) b[i] = component(values[i], c);
    const std::vector<Real> x = lu.solve(b);
    for (std::size_t j = 0; j < n; ++j) set_component(coefficient_[j], c, x[j]);
  }
}

Vec CurveShape::at(Real u, int derivative) const {
  if (!closed_ && std::fabs(u) > 1) {
    const Real end = u > 0 ? 1 : -1;
    if (derivative > 1) return {};
    const Vec slope = at(end, 1);
    return derivative == 1 ? slope : at(end) + (u - end) * slope;
  }
  const Real s = u - (closed_ ? first_ + 2 * std::floor((u - first_) / 2) : first_);
  Vec sum{};
  const auto lowest = static_cast<std::size_t>(derivative);
  for (std::size_t j = order_; j-- > lowest;) sum = s * sum + falling(j, derivative) * coefficient_[j];
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    const Real beyond = s - (knots_[k] - first_);
    if (beyond <= 0) break;
    Real power = falling(order_ - 1, derivative);
    for (std::size_t j = lowest; j + 1 < order_; ++j) power *= beyond;
    sum += power * coefficient_[order_ + k];
  }
  return sum;
}

Vector3<Jet> CurveShape::at(const Jet& u, int derivative) const {
  const Vec c = at(u.v, derivative), c1 = at(u.v, derivative + 1), c2 = at(u.v, derivative + 2);
  return {chain(u, c.x, c1.x, c2.x), chain(u, c.y, c1.y, c2.y), chain(u, c.z, c1.z, c2.z)};
}

Real CurveShape::clearance(Real u) const {
  const Real at = closed_ ? u - 2 * std::floor((u - first_) / 2) : u;
  Real least = std::min(at - first_, first_ + 2 - at);
  for (const Real t : knots_) least = std::min(least, std::fabs(at - t));
  return least;
}

}  // namespace dynalin::oracle
