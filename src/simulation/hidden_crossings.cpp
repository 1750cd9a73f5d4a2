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
constexpr int most_looks = 20;  // of one step, besides these

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

double tolerance_of(double from, double to) {
  return 100 * std::numeric_limits<double>::epsilon() * (std::abs(to) + std::abs(to - from));
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
    const double v0 = before_[k], v1 = looks_[1].values[k], v2 = looks_[2].values[k], v3 = at_end[k];
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

const HiddenCrossings::Look& HiddenCrossings::look(double part, double from, double length, const Values& values) {
  if (looks_.size() == looked_) looks_.emplace_back();
  Look& l = looks_[looked_];
  l.part = part;
  l.values.resize(before_.size());
  values(from + part * length, l.values);
  const auto begin = looks_.begin(), end = begin + static_cast<std::ptrdiff_t>(looked_++);
  const auto place = std::upper_bound(begin, end, part, [](double p, const Look& other) { return p < other.part; });
  std::rotate(place, end, end + 1);
  return *place;
}

// The first part of the step before `until` at which a function may be zero that is not where it was looked at: between
// two looks, lines from both meet beyond zero that fall as steeply as it was ever seen to. They are a little steeper,
// and the part is where they meet without that.
std::optional<double> HiddenCrossings::within_reach(double until) const {
  constexpr double steeper = 1.1, shortest = 1e-4;
  std::optional<double> first;
  for (std::size_t k = 0; k < before_.size(); ++k) {
    const int side = sign(before_[k]);
    if (side == 0) continue;
    double slope = 0, smallest = std::abs(before_[k]);
    for (std::size_t i = 1; i < looked_; ++i) {
      const Look &a = looks_[i - 1], &b = looks_[i];
      slope = std::max(slope, std::abs(b.values[k] - a.values[k]) / (b.part - a.part));
      smallest = std::min(smallest, std::abs(b.values[k]));
    }
    if (!(2 * smallest < steeper * third * slope)) continue;
    for (std::size_t i = 1; i < looked_ && looks_[i - 1].part < until; ++i) {
      const Look &a = looks_[i - 1], &b = looks_[i];
      const double length = b.part - a.part, va = std::abs(a.values[k]), vb = std::abs(b.values[k]);
      if (length < shortest || sign(a.values[k]) != side || sign(b.values[k]) != side) continue;
      if (va + vb >= steeper * slope * length) continue;
      const double middle = 0.5 * (a.part + b.part) + 0.5 * (va - vb) / slope;
      const double part = std::clamp(middle, a.part + 0.1 * length, b.part - 0.1 * length);
      if (part < until && (!first || part < *first)) first = part;
      break;
    }
  }
  return first;
}

std::optional<double> HiddenCrossings::seen(double from, double to, std::span<const double> at_end,
                                            const Values& values) {
  const double h = to - from;
  if (!(h > 4 * tolerance_of(from, to))) return std::nullopt;
  looked_ = 0;
  const auto known = [&](double part, std::span<const double> all) {
    look(part, from, h, [&](double, std::span<double> v) { std::ranges::copy(all, v.begin()); });
  };
  known(0, before_);
  look(third, from, h, values);
  look(2 * third, from, h, values);
  known(1, at_end);
  // What is exactly zero where it begins has the sign that it takes.
  for (std::size_t k = 0; k < before_.size(); ++k) {
    if (before_[k] == 0) before_[k] = looks_[0].values[k] = looks_[1].values[k];
  }
  double beyond = 2;  // part of the step
  if (has_crossed(looks_[1].values)) {
    beyond = third;
  } else if (has_crossed(looks_[2].values)) {
    beyond = 2 * third;
  }
  for (const double part : suspects(at_end)) {
    if (part >= beyond) break;
    if (has_crossed(look(part, from, h, values).values)) beyond = part;
  }
  for (int k = 0; k < most_looks; ++k) {
    const auto part = within_reach(beyond);
    if (!part) break;
    if (has_crossed(look(*part, from, h, values).values)) beyond = std::min(beyond, *part);
  }
  if (beyond > 1) return std::nullopt;
  return from + beyond * h;
}

std::optional<double> HiddenCrossings::first(double from, double to, std::span<const double> at_end,
                                             const Values& values, const Reported& reported) {
  now_.resize(at_end.size());
  const double tolerance = tolerance_of(from, to);
  std::optional<double> beyond = seen(from, to, at_end, values);
  for (std::size_t k = 0; reported && !beyond && k < at_end.size(); ++k) {
    const bool told = k < reported->size() && (*reported)[k] != 0;
    if (!told && sign(at_end[k]) * sign(before_[k]) < 0) beyond = to;
  }
  if (!beyond) {
    begin(at_end);
    return std::nullopt;
  }
  const double t = closed_in(from, *beyond, tolerance, values);
  if (t - from <= 2 * tolerance) {  // the sign with which it begins was rounding
    begin(now_);
    return first(t, to, at_end, values, reported);
  }
  crossed_.assign(at_end.size(), 0);
  for (std::size_t k = 0; k < at_end.size(); ++k) {
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
