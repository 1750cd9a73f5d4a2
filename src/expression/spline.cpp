#include "expression/spline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "expression/functions.h"

namespace dynalin {

namespace {

using Points = std::vector<double>;

// t_i from the slopes of four neighbouring pieces; beyond the ends the slopes go on with constant difference.
Points akima_slopes(const Points& m) {
  const std::size_t n = m.size() + 1;
  Points s(m.size() + 4);  // two more at either end
  std::copy(m.begin(), m.end(), s.begin() + 2);
  s[1] = 2 * s[2] - s[3], s[0] = 2 * s[1] - s[2];
  const std::size_t e = s.size();
  s[e - 2] = 2 * s[e - 3] - s[e - 4], s[e - 1] = 2 * s[e - 2] - s[e - 3];
  Points t(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double right = std::abs(s[i + 3] - s[i + 2]), left = std::abs(s[i + 1] - s[i]);
    t[i] = right + left == 0 ? 0.5 * (s[i + 1] + s[i + 2]) : (right * s[i + 1] + left * s[i + 2]) / (right + left);
  }
  return t;
}

// Third divided difference of four points, a sixth of the third derivative of the cubic through them.
double third_difference(const Points& x, const Points& y, std::size_t i) {
  const auto first = [&](std::size_t k) { return (y[k + 1] - y[k]) / (x[k + 1] - x[k]); };
  const auto second = [&](std::size_t k) { return (first(k + 1) - first(k)) / (x[k + 2] - x[k]); };
  return (second(i + 1) - second(i)) / (x[i + 3] - x[i]);
}

// Slopes t of the C² spline: inside  t_{i−1}/h_{i−1} + 2 (1/h_{i−1} + 1/h_i) t_i + t_{i+1}/h_i
// = 3 (m_{i−1}/h_{i−1} + m_i/h_i); at the ends the third derivative of the piece, 6 (t_0 + t_1 − 2 m_0)/h_0², is given.
Points cubic_slopes(const Points& x, const Points& y, const Points& m) {
  const std::size_t n = x.size();
  Points lower(n, 0), diagonal(n, 0), upper(n, 0), right(n, 0);
  const auto h = [&](std::size_t i) { return x[i + 1] - x[i]; };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    lower[i] = 1 / h(i - 1), upper[i] = 1 / h(i), diagonal[i] = 2 * (lower[i] + upper[i]);
    right[i] = 3 * (m[i - 1] / h(i - 1) + m[i] / h(i));
  }
  diagonal[0] = upper[0] = 1, right[0] = 2 * m[0] + third_difference(x, y, 0) * h(0) * h(0);
  diagonal[n - 1] = lower[n - 1] = 1, right[n - 1] = 2 * m[n - 2] + third_difference(x, y, n - 4) * h(n - 2) * h(n - 2);
  for (std::size_t i = 1; i < n; ++i) {
    const double f = lower[i] / diagonal[i - 1];
    diagonal[i] -= f * upper[i - 1];
    right[i] -= f * right[i - 1];
  }
  Points t(n);
  t[n - 1] = right[n - 1] / diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) t[i] = (right[i] - upper[i] * t[i + 1]) / diagonal[i];
  return t;
}

}  // namespace

SplineCurves::SplineCurves(std::shared_ptr<const SplineData> data, SplineMethod method)
    : data_(std::move(data)), method_(method) {
  const Points& x = data_->x;
  const std::size_t n = x.size();
  for (const Points& y : data_->y) {
    Points m(n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i) m[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    const Points t = method == SplineMethod::akima   ? akima_slopes(m)
                     : method == SplineMethod::cubic ? cubic_slopes(x, y, m)
                                                     : Points();
    std::vector<Piece> pieces;
    // The line or parabola through the points at an end, from the end point on.
    const auto beyond = [&](std::size_t end, std::size_t next, std::size_t third) {
      const double slope = (y[next] - y[end]) / (x[next] - x[end]);
      if (data_->linear_extrapolation) return Piece{x[end], {y[end], slope, 0, 0}};
      const double far = (y[third] - y[next]) / (x[third] - x[next]);
      const double bend = (far - slope) / (x[third] - x[end]);
      return Piece{x[end], {y[end], slope - bend * (x[next] - x[end]), bend, 0}};
    };
    pieces.push_back(beyond(0, 1, 2));
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double h = x[i + 1] - x[i];
      if (t.empty()) {
        pieces.push_back({x[i], {y[i], m[i], 0, 0}});
      } else {
        pieces.push_back(
            {x[i], {y[i], t[i], (3 * m[i] - 2 * t[i] - t[i + 1]) / h, (t[i] + t[i + 1] - 2 * m[i]) / (h * h)}});
      }
    }
    pieces.push_back(beyond(n - 1, n - 2, n - 3));
    pieces_.push_back(std::move(pieces));
  }
  for (std::size_t derivative = 0; derivative < range_.size(); ++derivative) {
    const double factor = derivative == 2 ? 2 : 1;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& curve : pieces_) {
      for (std::size_t k = 1; k < curve.size(); ++k) {  // the last one begins at the last point
        const double v = factor * curve[k].c[derivative];
        low = std::min(low, v), high = std::max(high, v);
      }
    }
    range_[derivative] = high - low;
  }
}

const SplineCurves::Piece& SplineCurves::piece(std::size_t curve, double x) const {
  const Points& points = data_->x;
  // The last point itself belongs to the last piece inside.
  std::size_t k = static_cast<std::size_t>(std::upper_bound(points.begin(), points.end(), x) - points.begin());
  if (x == points.back()) --k;
  return pieces_[curve][k];
}

std::size_t SplineCurves::curve_below(double z) const {
  const std::vector<double>& all = data_->z;
  const auto above = std::upper_bound(all.begin() + 1, all.end() - 1, z);
  return static_cast<std::size_t>(above - all.begin()) - 1;
}

template <class T>
T SplineCurves::at(const T& x, const T& z, int derivative) const {
  const auto along = [&](std::size_t curve) {
    const Piece& p = piece(curve, value_of(x));
    const T s = x - T(p.origin);
    const auto& c = p.c;
    if (derivative == 0) return T(c[0]) + s * (T(c[1]) + s * (T(c[2]) + s * c[3]));
    if (derivative == 1) return T(c[1]) + s * (T(2 * c[2]) + s * (3 * c[3]));
    return T(2 * c[2]) + s * (6 * c[3]);
  };
  if (pieces_.size() == 1) return along(0);
  const std::vector<double>& all = data_->z;
  const std::size_t k = curve_below(value_of(z));
  const T share = (z - T(all[k])) * (1 / (all[k + 1] - all[k]));
  const T low = along(k);
  return low + share * (along(k + 1) - low);
}

SplineCurves::Expansion SplineCurves::expand(double x, double z) const {
  const auto along = [&](std::size_t curve) -> std::array<double, 4> {
    const Piece& p = piece(curve, x);
    const double s = x - p.origin;
    const auto& c = p.c;
    return {c[0] + s * (c[1] + s * (c[2] + s * c[3])), c[1] + s * (2 * c[2] + s * (3 * c[3])), c[2] + s * (3 * c[3]),
            c[3]};
  };
  Expansion e;
  if (pieces_.size() == 1) {
    e.along = along(0);
    return e;
  }
  const std::vector<double>& all = data_->z;
  const std::size_t k = curve_below(z);
  const std::array<double, 4> low = along(k), high = along(k + 1);
  for (std::size_t j = 0; j < low.size(); ++j) {
    e.by_z[j] = (high[j] - low[j]) / (all[k + 1] - all[k]);
    e.along[j] = low[j] + (z - all[k]) * e.by_z[j];
  }
  return e;
}

void SplineCurves::switches(double x, double z, int derivative, SwitchList& out) const {
  const int continuous = method_ == SplineMethod::linear ? 0 : method_ == SplineMethod::akima ? 1 : 2;
  std::span<const double> knots = data_->x;
  if (continuous - derivative <= 0) {
    // Straight lines go on as they are.
    if (method_ == SplineMethod::linear && data_->linear_extrapolation) knots = knots.subspan(1, knots.size() - 2);
    out.add(knot_switch(knots, x));
  } else {
    out.add(x - knots.front());
    out.add(x - knots.back());
  }
  if (data_->z.size() > 2) out.add(knot_switch(std::span(data_->z).subspan(1, data_->z.size() - 2), z));
}

// Knots between are compared with what is expected; of each piece the middle as well, which is all there is to see of a
// bulge between two points alike. Steps end at knots, but a bulge that is ahead is entered.
void SplineCurves::look_ahead(double x0, double z0, double x1, double z1, int derivative, StepReach& reach) const {
  constexpr double just_behind = 1e-6;  // of the step: one that was to end at a knot may have ended right before it
  constexpr double begun = 0.25;        // of a piece
  const double allowed = reach.tolerance() * range_[static_cast<std::size_t>(derivative)];
  const double from = x0 + just_behind * (x1 - x0);
  if (!(from != x1) || !std::isfinite(x0) || !std::isfinite(x1) || !(allowed > 0)) return;
  const Points& knots = data_->x;
  // The knots between, in the order in which they are met, from `next` on; the number of the one before may be −1.
  const bool up = x1 > x0;
  const auto below = [&](double x) {  // how many
    return std::lower_bound(knots.begin(), knots.end(), x) - knots.begin();
  };
  std::ptrdiff_t next = up ? below(from) : below(from) - 1;
  const std::ptrdiff_t step = up ? 1 : -1, last = up ? below(x1) - 1 : below(x1);
  if ((last - next) * step < 0) return;
  const auto knot = [&](std::ptrdiff_t k) { return knots[static_cast<std::size_t>(k)]; };
  const auto value = [&](double x) { return at(x, z0 + (x - x0) / (x1 - x0) * (z1 - z0), derivative); };
  const std::ptrdiff_t before = next - step, count = static_cast<std::ptrdiff_t>(knots.size());
  const auto share = [&](double x) { return (x - x0) / (x1 - x0); };
  using Course = TimeTaylor<double>;
  const Course begin = at(Course(from, 1.0, 0.0), Course(z0, (z1 - z0) / (x1 - x0), 0.0), derivative);
  const ExpectedCourse expected(from, begin.value, begin.rate, x1, value(x1));
  if (before >= 0 && before < count && (from - knot(before)) / (knot(next) - knot(before)) < begun) {
    const double middle = 0.5 * (from + knot(next));
    if (std::abs(value(middle) - 0.5 * (value(from) + value(knot(next)))) > allowed) reach.end_at(share(middle));
  }
  const auto is_expected = [&](double x) { return std::abs(value(x) - expected.at(x)) <= allowed; };
  for (; (last - next) * step >= 0; next += step) {
    if (share(knot(next)) >= reach.share()) return;
    const double end = next == last ? x1 : knot(next + step);
    if (!is_expected(knot(next)) || !is_expected(0.5 * (knot(next) + end))) return reach.end_at(share(knot(next)));
  }
}

void SplineUse::look_ahead(double x0, double z0, double x1, double z1, StepReach& reach) const {
  if (curves) curves->look_ahead(x0, z0, x1, z1, derivative, reach);
}

void SplineUse::switches(double x, double z, SwitchList& out) const {
  if (parametric) parametric->switches(x, derivative, out);
  if (curves) curves->switches(x, z, derivative, out);
}

template <class T>
T SplineUse::evaluate(const T& x, const T& z) const {
  if (signal) return signal->at(x);
  if (parametric) return parametric->at(x, derivative)[*component];
  return curves ? curves->at(x, z, derivative) : T(std::numeric_limits<double>::quiet_NaN());
}

template double SplineUse::evaluate(const double&, const double&) const;
template TimeTaylor<double> SplineUse::evaluate(const TimeTaylor<double>&, const TimeTaylor<double>&) const;
template Seeded SplineUse::evaluate(const Seeded&, const Seeded&) const;
template TimeTaylor<Seeded> SplineUse::evaluate(const TimeTaylor<Seeded>&, const TimeTaylor<Seeded>&) const;

}  // namespace dynalin
