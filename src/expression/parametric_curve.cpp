#include "expression/parametric_curve.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <limits>
#include <utility>

namespace dynalin {

namespace {

using Knots = std::vector<double>;

// The k B-splines of order k that do not vanish in [t_l, t_{l+1}], at u: B_{l−k+1} … B_l (Cox, de Boor).
std::vector<double> basis(const Knots& t, std::size_t k, std::size_t l, double u) {
  std::vector<double> b(k, 0.0);
  b[0] = 1;
  for (std::size_t r = 1; r < k; ++r) {
    double carried = 0;
    for (std::size_t j = 0; j < r; ++j) {
      const double right = t[l + 1 + j], left = t[l + 1 + j - r];
      const double share = b[j] / (right - left);
      b[j] = carried + (right - u) * share;
      carried = (u - left) * share;
    }
    b[r] = carried;
  }
  return b;
}

// Derivative m at u of the spline of order k in the span [t_l, t_{l+1}], from its k control points there.
Vec3<double> spline_derivative(const Knots& t, std::size_t k, std::size_t l, std::vector<Vec3<double>> p, std::size_t m,
                               double u) {
  const std::size_t first = l + 1 - k;
  for (std::size_t r = 1; r <= m; ++r) {
    for (std::size_t j = k - 1; j >= r; --j) {
      const double width = t[first + j + k - r] - t[first + j];
      p[j] = (p[j] - p[j - 1]) * (static_cast<double>(k - r) / width);
    }
  }
  for (std::size_t r = 1; r + m < k; ++r) {
    for (std::size_t j = k - 1; j >= m + r; --j) {
      const double left = t[first + j], share = (u - left) / (t[first + j + k - m - r] - left);
      p[j] = p[j - 1] * (1 - share) + p[j] * share;
    }
  }
  return p[k - 1];
}

// Control points whose spline meets the given points; row r holds the values of the B-splines at the point r.
std::vector<Vec3<double>> solve(const std::vector<Eigen::Triplet<double>>& entries,
                                const std::vector<Vec3<double>>& points, std::size_t n) {
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixXd right(size, 3);
  for (Eigen::Index r = 0; r < size; ++r) {
    const Vec3<double>& p = points[static_cast<std::size_t>(r)];
    right.row(r) << p.x, p.y, p.z;
  }
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
  const Eigen::MatrixXd x = lu.solve(right);
  std::vector<Vec3<double>> controls;
  for (Eigen::Index r = 0; r < size; ++r) controls.push_back({x(r, 0), x(r, 1), x(r, 2)});
  return controls;
}

}  // namespace

ParametricCurve::ParametricCurve(const Points& points, Shape shape, Data data, int order)
    : shape_(shape), order_(static_cast<std::size_t>(order)) {
  shape == Shape::open ? take_open(points, data) : take_closed(points, data);
  measure_speed();
}

ParametricCurve::ParametricCurve(std::shared_ptr<const CurveLaw> law, Shape shape, double first, double last)
    : shape_(shape), order_(CurveLaw::highest_order + 1), law_(std::move(law)) {
  constexpr std::size_t pieces = 64;  // which samples are spread over
  for (std::size_t k = 0; k < pieces; ++k)
    breaks_.push_back(first + (last - first) * (static_cast<double>(k) / static_cast<double>(pieces)));
  breaks_.push_back(last);
  measure_speed();
}

void ParametricCurve::measure_speed() {
  double fastest = 0;
  least_speed_ = std::numeric_limits<double>::infinity();
  for (const double u : samples(std::numeric_limits<std::size_t>::max())) {
    const double speed = norm(at(u, 1));
    fastest = std::max(fastest, speed), least_speed_ = std::min(least_speed_, speed);
  }
  least_speed_ = std::max(least_speed_, 1e-3 * fastest);
}

void ParametricCurve::take_open(const Points& points, Data data) {
  const std::size_t n = points.size(), k = order_;
  const auto parameter = [](std::size_t i, std::size_t count) {
    return -1 + 2 * static_cast<double>(i) / static_cast<double>(count);
  };
  Knots t(k, -1.0);
  for (std::size_t j = 1; j + k <= n; ++j) {
    // The mean of k − 1 parameters at equal steps is that of the first and the last.
    t.push_back(data == Data::points ? 0.5 * (parameter(j, n - 1) + parameter(j + k - 2, n - 1))
                                     : parameter(j, n - k + 1));
  }
  t.insert(t.end(), k, 1.0);
  Points controls = points;
  if (data == Data::points) {
    std::vector<Eigen::Triplet<double>> entries;
    std::size_t l = k - 1;
    for (std::size_t i = 0; i < n; ++i) {
      const double u = parameter(i, n - 1);
      while (l + 1 < n && t[l + 1] <= u) ++l;
      const auto b = basis(t, k, l, u);
      for (std::size_t j = 0; j < k; ++j)
        entries.emplace_back(static_cast<int>(i), static_cast<int>(l + 1 - k + j), b[j]);
    }
    controls = solve(entries, points, n);
  }
  breaks_.push_back(-1);
  for (std::size_t l = k - 1; l < n; ++l) add_piece(t, controls, l);
}

void ParametricCurve::take_closed(const Points& points, Data data) {
  const std::size_t n = points.size() - 1, k = order_;
  const double step = 2 / static_cast<double>(n);
  // B-spline j has its middle at the parameter −1 + j·step of point j: its first knot lies k/2 steps before.
  Knots t;
  for (std::size_t j = 0; j < n + 3 * k; ++j) {
    t.push_back(-1 + step * (static_cast<double>(j) - 0.5 * static_cast<double>(k) - static_cast<double>(k - 1)));
  }
  // With k − 1 knots put before, knot j + k − 1 is the first one of B-spline j.
  Points controls(points.begin(), points.end() - 1);
  if (data == Data::points) {
    std::vector<Eigen::Triplet<double>> entries;
    const std::size_t l0 = k - 1 + k / 2;
    const auto b = basis(t, k, l0, -1.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < k; ++j) {
        // Local spline j is number l0 − (k − 1) + j of the knots, k − 1 less of the points.
        const std::size_t column = (i + l0 + j + n * k - 2 * (k - 1)) % n;
        entries.emplace_back(static_cast<int>(i), static_cast<int>(column), b[j]);
      }
    }
    controls = solve(entries, controls, n);
  }
  Points wrapped;
  for (std::size_t j = 0; j < n + 2 * k; ++j) wrapped.push_back(controls[(j + n * k - (k - 1)) % n]);
  breaks_.push_back(t[k - 1 + k / 2]);
  for (std::size_t i = 0; i < n; ++i) add_piece(t, wrapped, k - 1 + k / 2 + i);
}

void ParametricCurve::add_piece(const Knots& t, const Points& controls, std::size_t span) {
  const auto first = controls.begin() + static_cast<std::ptrdiff_t>(span + 1 - order_);
  const Points local(first, first + static_cast<std::ptrdiff_t>(order_));
  double factorial = 1;
  for (std::size_t m = 0; m < order_; ++m) {
    if (m > 0) factorial *= static_cast<double>(m);
    coefficient_.push_back(spline_derivative(t, order_, span, local, m, 0.5 * (t[span] + t[span + 1])) / factorial);
  }
  breaks_.push_back(t[span + 1]);
}

std::size_t ParametricCurve::piece(double u) const {
  const auto above = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, u);
  return static_cast<std::size_t>(above - breaks_.begin()) - 1;
}

bool ParametricCurve::straight_at(double u) const {
  const Vec3<double> slope = at(u, 1);
  return !(norm(cross(slope, at(u, 2))) > 1e-9 * dot(slope, slope));
}

bool ParametricCurve::corner_at(double u) const {
  if (order_ > 2) return false;
  for (std::size_t k = shape_ == Shape::open ? 1 : 0; k + 1 < breaks_.size(); ++k) {
    if (std::abs(difference(u, breaks_[k])) > end_tolerance) continue;
    const Vec3<double> before = coefficient_[(k == 0 ? breaks_.size() - 2 : k - 1) * order_ + 1];
    const Vec3<double> behind = coefficient_[k * order_ + 1];
    return norm(before - behind) > 1e-9 * (norm(before) + norm(behind));
  }
  return false;
}

void ParametricCurve::switches(double u, int derivative, SwitchList& out) const {
  if (law_) return;
  const int continuous = static_cast<int>(order_) - 2 - derivative;
  if (shape_ == Shape::closed) {
    if (continuous > 0) return;
    // Pieces are counted on from one turn to the next.
    const double turns = std::floor((u - breaks_.front()) / 2);
    const auto odd = static_cast<std::size_t>(std::abs(std::fmod(turns * static_cast<double>(breaks_.size() - 1), 2)));
    out.add(knot_switch(breaks_, u - 2 * turns, odd));
  } else if (continuous > 0) {
    out.add(u + 1);
    out.add(u - 1);
  } else {
    // A polygon goes on as it is beyond its ends.
    const std::span<const double> all = breaks_;
    out.add(knot_switch(order_ == 2 ? all.subspan(1, all.size() - 2) : all, u));
  }
}

double ParametricCurve::difference(double u, double v) const {
  return shape_ == Shape::closed ? std::remainder(u - v, range()) : u - v;
}

std::vector<double> ParametricCurve::samples(std::size_t most) const {
  std::vector<double> all;
  const std::size_t pieces = breaks_.size() - 1;
  const std::size_t stride = std::max<std::size_t>(1, 4 * pieces / std::max<std::size_t>(most, 1));
  for (std::size_t i = 0; i < 4 * pieces; i += stride) {
    const double share = static_cast<double>(i % 4) / 4;
    all.push_back(breaks_[i / 4] + share * (breaks_[i / 4 + 1] - breaks_[i / 4]));
  }
  all.push_back(breaks_.back());
  return all;
}

double ParametricCurve::nearest(const Vec3<double>& p) const {
  const auto distance = [&](double u) {
    const Vec3<double> d = at(u) - p;
    return dot(d, d);
  };
  const std::vector<double> all = samples(std::numeric_limits<std::size_t>::max());
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (distance(all[i]) < distance(all[best])) best = i;
  }
  // Newton on ½|c − p|² between the neighbours, halving towards the better end where it leaves them or climbs.
  double low = all[best > 0 ? best - 1 : 0], high = all[std::min(best + 1, all.size() - 1)];
  if (shape_ == Shape::closed && best == 0) low = all[0] - (all.back() - all[all.size() - 2]);
  if (shape_ == Shape::closed && best + 1 == all.size()) high = all.back() + (all[1] - all[0]);
  double u = all[best];
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Vec3<double> d = at(u) - p, slope = at(u, 1);
    const double g = dot(d, slope), h = dot(slope, slope) + dot(d, at(u, 2));
    if (g > 0) high = u;
    if (g < 0) low = u;
    double next = h > 0 ? u - g / h : 0.5 * (low + high);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (g == 0 || std::abs(next - u) <= 1e-15) break;
    u = next;
  }
  return u;
}

}  // namespace dynalin
