#include "simulation/hidden_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dynalin {

namespace {

constexpr double third = 1.0 / 3;
constexpr double next_to_zero = 0.05;  // of the largest of the four values: the cubic is off by as much
constexpr std::size_t most_suspects = 4;

int sign(double v) { return (v > 0) - (v < 0); }

// Where the cubic through values at 0, 1/3, 2/3 and 1 has its extrema, and what it is there.
struct Extremum {
  double at, value;
};
std::array<std::optional<Extremum>, 2> extrema(double v0, double v1, double v2, double v3) {
  const double d1 = v1 - v0, d2 = v2 - 2 * v1 + v0, d3 = v3 - 3 * v2 + 3 * v1 - v0;
  // Newton's form in s = 3u: v0 + d1 s + d2 s (s − 1)/2 + d3 s (s − 1) (s − 2)/6.
  const double a = d3 / 6, b = d2 / 2 - d3 / 2, c = d1 - d2 / 2 + d3 / 3;
  const double discriminant = b * b - 3 * a * c;
  std::array<std::optional<Extremum>, 2> found;
  if (!(discriminant >= 0)) return found;
  // The roots of 3a s² + 2b s + c without cancellation.
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  const std::array<double, 2> roots = {q / (3 * a), c / q};
  for (std::size_t k = 0; k < 2; ++k) {
    const double s = roots[k];
    if (s > 0 && s < 3) found[k] = Extremum{third * s, v0 + s * (c + s * (b + s * a))};
  }
  return found;
}

}  // namespace

bool HiddenCrossings::has_crossed(std::span<const double> values) const {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (sign(values[k]) * sign(before_[k]) < 0) return true;
  }
  return false;
}

// Parts of the step at which a function may be beyond zero though it is not at thirds, in their order.
std::vector<double> HiddenCrossings::suspects(std::span<const double> at_end) const {
  std::vector<double> parts;
  for (std::size_t k = 0; k < at_end.size() && parts.size() < most_suspects; ++k) {
    const double v0 = before_[k], v1 = first_third_[k], v2 = second_third_[k], v3 = at_end[k];
    if (sign(v0) == 0 || sign(v0) != sign(v3)) continue;
    const double largest = std::max({std::abs(v0), std::abs(v1), std::abs(v2), std::abs(v3)});
    for (const auto& e : extrema(v0, v1, v2, v3)) {
      if (e && sign(v0) * e->value < next_to_zero * std::min(largest, std::abs(v0) + std::abs(v3)))
        parts.push_back(e->at);
    }
  }
  std::ranges::sort(parts);
  return parts;
}

std::optional<double> HiddenCrossings::first(double from, double to, std::span<const double> at_end,
                                             const Values& values) {
  const std::size_t n = at_end.size();
  for (auto* v : {&first_third_, &second_third_, &now_}) v->resize(n);
  const double h = to - from;
  const double tolerance = 100 * std::numeric_limits<double>::epsilon() * (std::abs(to) + std::abs(h));
  std::optional<double> beyond;
  if (h > 4 * tolerance) {
    values(from + third * h, first_third_);
    values(from + 2 * third * h, second_third_);
    // What is exactly zero where it begins has the sign that it takes.
    for (std::size_t k = 0; k < n; ++k) {
      if (before_[k] == 0) before_[k] = first_third_[k];
    }
    if (has_crossed(first_third_)) beyond = from + third * h;
    for (const double part : suspects(at_end)) {
      const double t = from + part * h;
      if (beyond && t >= *beyond) break;
      values(t, now_);
      if (has_crossed(now_)) beyond = t;
    }
    if (!beyond && has_crossed(second_third_)) beyond = from + 2 * third * h;
  }
  if (!beyond) {
    begin(at_end);
    return std::nullopt;
  }
  const double t = closed_in(from, *beyond, tolerance, values);
  if (t - from <= 2 * tolerance) {  // the sign with which it begins was rounding
    begin(now_);
    return first(t, to, at_end, values);
  }
  crossed_.assign(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    if (sign(now_[k]) * sign(before_[k]) < 0) crossed_[k] = sign(now_[k]);
  }
  begin(now_);
  return t;
}

// Halves the stretch until its end is just behind the change; the values there are the last ones.
double HiddenCrossings::closed_in(double from, double beyond, double tolerance, const Values& values) {
  while (beyond - from > tolerance) {
    const double middle = from + 0.5 * (beyond - from);
    if (!(middle > from && middle < beyond)) break;
    values(middle, now_);
    (has_crossed(now_) ? beyond : from) = middle;
  }
  values(beyond, now_);
  return beyond;
}

}  // namespace dynalin
