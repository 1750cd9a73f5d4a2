#include "geometry/spiric_curve.h"

#include <algorithm>
#include <numbers>
#include <optional>

namespace dynalin {

namespace {

struct Range {
  double low, high;
};

// Where a line is in a disc.
std::optional<Range> in_disc(double from_middle, double middle, double radius) {
  const double square = (radius - from_middle) * (radius + from_middle);
  if (!(square > 0)) return std::nullopt;
  return Range{middle - std::sqrt(square), middle + std::sqrt(square)};
}

// Where |c + s a| is at most `most`.
void clip(std::optional<Range>& range, double c, double s, double most) {
  if (!range) return;
  if (s == 0) {
    if (std::abs(c) >= most) range.reset();
    return;
  }
  const double one = (-most - c) / s, other = (most - c) / s;
  range->low = std::max(range->low, std::min(one, other)), range->high = std::min(range->high, std::max(one, other));
  if (!(range->low < range->high)) range.reset();
}

}  // namespace

SpiricCurve::SpiricCurve(const TorusSolid& torus, const Vector& normal, double height)
    : torus_(torus), normal_(normal), height_(height), sine_(std::hypot(normal.x, normal.y)), cosine_(normal.z) {
  const Vector outwards = sine_ > 0 ? Vector{normal.x / sine_, normal.y / sine_, 0} : Vector{1, 0, 0};
  level_ = {-outwards.y, outwards.x, 0};
  along_ = outwards * cosine_ - Vector{0, 0, sine_};
  const double R = torus.major(), r = torus.minor();
  std::vector<Range> discs;
  for (const double side : {-R, R}) {
    if (const auto disc = in_disc(height - side * sine_, side * cosine_, r)) discs.push_back(*disc);
  }
  std::ranges::sort(discs, {}, &Range::low);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::optional<Range> between = Range{-infinite, infinite};
  clip(between, height * sine_, cosine_, R);
  clip(between, height * cosine_, -sine_, r);
  if (discs.empty() && !between) return;

  Range all{infinite, -infinite};
  for (const Range& d : discs) all.low = std::min(all.low, d.low), all.high = std::max(all.high, d.high);
  const bool low_flat = between && between->low < all.low, high_flat = between && between->high > all.high;
  if (low_flat) all.low = between->low;
  if (high_flat) all.high = between->high;
  const auto add = [&](bool outer, const Range& range, bool flat_low, bool flat_high) {
    for (const bool upper : {false, true})
      stretches_.push_back({outer, upper, range.low, range.high, flat_low, flat_high});
  };
  add(true, all, low_flat, high_flat);
  double from = all.low;
  for (std::size_t k = 0; k <= discs.size(); ++k) {
    const Range hole{from, k < discs.size() ? discs[k].low : all.high};
    if (k < discs.size()) from = discs[k].high;
    if (hole.low < hole.high) add(false, hole, k == 0 && low_flat, k == discs.size() && high_flat);
  }
  link();
}

std::size_t SpiricCurve::next_of(std::size_t k) const {
  const Stretch& s = stretches_[k];
  const bool at_high = s.increases(), flat = at_high ? s.high_flat : s.low_flat;
  for (std::size_t n = 0; n < stretches_.size(); ++n) {
    const Stretch& t = stretches_[n];
    if (flat ? t.outer == s.outer || t.upper != s.upper : t.outer != s.outer || t.upper == s.upper) continue;
    if (at_high ? t.high == s.high && t.high_flat == flat : t.low == s.low && t.low_flat == flat) return n;
  }
  return none;
}

void SpiricCurve::link() {
  for (std::size_t k = 0; k < stretches_.size(); ++k) {
    if (stretches_[k].loop != none) continue;
    Loop loop;
    loop.is_hole = true;
    for (std::size_t n = k; n != none && stretches_[n].loop == none; n = next_of(n)) {
      stretches_[n].loop = loops_.size(), stretches_[n].order = loop.stretches.size();
      loop.is_hole = loop.is_hole && !stretches_[n].outer;
      loop.stretches.push_back(n);
    }
    loops_.push_back(loop);
  }
}

double SpiricCurve::a_at(const Place& place) const {
  const Stretch& s = stretches_[place.stretch];
  const double half = std::sin(0.5 * place.turn), way = (s.high - s.low) * half * half;
  return s.increases() ? s.low + way : s.high - way;
}

// `side`: 1 on the outer surface of the tube, −1 on the inner one, 0 between both.
double SpiricCurve::across_at(double side, double a) const {
  const double z = std::abs(height_ * cosine_ - a * sine_), x = std::abs(height_ * sine_ + a * cosine_),
               r = torus_.minor();
  const double radius = torus_.major() + side * std::sqrt(std::max((r - z) * (r + z), 0.0));
  return std::sqrt(std::max((radius - x) * (radius + x), 0.0));
}

Vector SpiricCurve::at(const Place& place) const {
  const Stretch& s = stretches_[place.stretch];
  const bool is_end = place.turn <= 0 || place.turn >= std::numbers::pi, at_high = (place.turn > 0) == s.increases();
  const double a = !is_end ? a_at(place) : at_high ? s.high : s.low;
  double b = 0;
  if (!is_end) {
    b = across_at(s.outer ? 1 : -1, a);
  } else if (at_high ? s.high_flat : s.low_flat) {
    b = across_at(0, a);
  }
  Vector p = normal_ * height_ + along_ * a + level_ * (s.upper ? b : -b);
  // Onto the surface, in the plane.
  for (int n = 0; n < 4; ++n) {
    const Vector slope = torus_.gradient(p), within = slope - normal_ * dot(normal_, slope);
    const double square = dot(within, within), value = torus_.value(p);
    if (!(square > 0) || value * value > 1e-4 * square * torus_.minor() * torus_.minor()) break;
    const Vector step = within * (value / square);
    p = p - step;
    if (norm(step) < 1e-16 * torus_.size()) break;
  }
  return p;
}

SpiricCurve::Place SpiricCurve::find(const Vector& p) const {
  const double a = dot(p, along_);
  const bool upper = dot(p, level_) > 0, outer = std::hypot(p.x, p.y) >= torus_.major();
  std::size_t best = none;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < stretches_.size(); ++k) {
    const Stretch& s = stretches_[k];
    if (s.upper != upper) continue;
    // Where the one kind goes over into the other, roundings may say either.
    const double beside = std::max({s.low - a, a - s.high, 0.0}) + (s.outer == outer ? 0.0 : 1e-7 * torus_.size());
    if (beside < least) least = beside, best = k;
  }
  const Stretch& s = stretches_[best];
  const double share = std::clamp((s.increases() ? a - s.low : s.high - a) / (s.high - s.low), 0.0, 1.0);
  return {best, 2 * std::asin(std::sqrt(share))};
}

Vector SpiricCurve::out_of_hole(const Place& place) const {
  const double a = a_at(place), length = across_at(1, a) - across_at(-1, a);
  return level_ * (stretches_[place.stretch].upper ? length : -length);
}

}  // namespace dynalin
