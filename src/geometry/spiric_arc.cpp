#include "geometry/spiric_arc.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace dynalin {

namespace {

constexpr double small_tail = 1e-9;
constexpr double one_spot = 1e-13;  // of the size
constexpr int most_halvings = 40;

constexpr std::size_t count = 2 * gauss_14.size();
// From 0 to 1, in order: places, weights, and weights of the 12th and 13th coefficients of Legendre polynomials.
struct Rule {
  std::array<double, count> at{}, weight{}, tail_12{}, tail_13{};
  Rule() {
    for (std::size_t k = 0; k < gauss_14.size(); ++k) {
      at[k] = gauss_14[k][0], at[count - 1 - k] = 1 - gauss_14[k][0];
      weight[k] = weight[count - 1 - k] = gauss_14[k][1];
    }
    for (std::size_t k = 0; k < count; ++k) {
      const double x = 2 * at[k] - 1;
      double before = 1, here = x;
      for (int n = 1; n < 13; ++n) {
        const double next = ((2 * n + 1) * x * here - n * before) / (n + 1);
        before = here, here = next;
      }
      tail_12[k] = 25 * weight[k] * before, tail_13[k] = 27 * weight[k] * here;
    }
  }
};
const Rule& rule() {
  static const Rule the_rule;
  return the_rule;
}

}  // namespace

std::optional<SpiricPiece::Place> SpiricPiece::place(const TorusSolid& torus, double s, double share) const {
  const double rest = 1 - s;
  Place p{s, share, from + way * s, {}, s * rest * (slope_[0] * rest - slope_[1] * s), 0, {}};
  for (int n = 0; n < 20; ++n) {
    p.at = p.on_chord + across * p.height;
    const Vector gradient = torus.gradient(p.at);
    p.rise = dot(gradient, across);
    if (!(p.rise > 0)) return std::nullopt;
    const double step = torus.value(p.at) / p.rise;
    p.tangent = way - across * (dot(gradient, way) / p.rise);
    if (std::abs(step) <= 1e-15 * torus.size()) return p;
    // Roundings of places where the plane hardly cuts the torus.
    if (n > 6 && std::abs(step) * p.rise <= 1e-15 * torus.size() * torus.size()) return p;
    p.height -= step;
    if (!(std::abs(p.height) <= norm(way))) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<SpiricPiece> SpiricPieces::piece(const Vector& from, const Vector& to) const {
  constexpr double steepest = 1.5;  // slope against the chord
  SpiricPiece p;
  p.from = from, p.to = to, p.way = to - from;
  const double length = norm(p.way);
  p.across = cross(p.way, normal_) / length;
  for (const bool at_end : {false, true}) {
    const Vector gradient = torus_.gradient(at_end ? to : from);
    const double rise = dot(gradient, p.across), along = dot(gradient, p.way);
    if (!(rise > 0) || !(std::abs(along) <= steepest * length * rise)) return std::nullopt;
    p.slope_[at_end] = -along / rise;
  }
  const Rule& r = rule();
  for (std::size_t k = 0; k < count; ++k) {
    const auto place = p.place(torus_, r.at[k], r.weight[k]);
    if (!place || !(dot(place->tangent, place->tangent) <= (1 + 2 * steepest * steepest) * length * length))
      return std::nullopt;
    p.places[k] = *place;
  }
  return p;
}

bool SpiricPieces::is_smooth(const SpiricPiece& p) const {
  const double length = norm(p.way), R = torus_.major(), share = torus_.size() / length;
  // [0]: at 12, [1]: at 13
  double height[2]{}, about_axis[2]{}, in_tube[2]{};
  const Rule& r = rule();
  for (std::size_t k = 0; k < count; ++k) {
    const Vector &at = p.places[k].at, &t = p.places[k].tangent;
    const double square = at.x * at.x + at.y * at.y, radius = std::sqrt(square), beyond = radius - R;
    const double outwards = (at.x * t.x + at.y * t.y) / radius;
    const double slope = dot(t, p.across), turn = (at.x * t.y - at.y * t.x) / square * R,
                 roll = (beyond * t.z - at.z * outwards) / torus_.minor();
    height[0] += r.tail_12[k] * slope, height[1] += r.tail_13[k] * slope;
    about_axis[0] += r.tail_12[k] * turn, about_axis[1] += r.tail_13[k] * turn;
    in_tube[0] += r.tail_12[k] * roll, in_tube[1] += r.tail_13[k] * roll;
  }
  const auto size = [](const double(&tail)[2]) { return std::abs(tail[0]) + std::abs(tail[1]); };
  // Where it is short roundings of its places count.
  constexpr double rounding_of_tail = 4 * std::numeric_limits<double>::epsilon();
  return size(height) + size(about_axis) + size(in_tube) <= (small_tail + rounding_of_tail * share * share) * length;
}

bool SpiricPieces::add_part(const Vector& from, const Vector& to, std::size_t stretch, double begin, double end,
                            int halvings) {
  const double length = norm(to - from);
  if (length <= one_spot * torus_.size() && end - begin < 1) return true;
  if (length > 0) {
    const auto p = piece(from, to);
    if (p && is_smooth(*p)) {
      out_.push_back(*p);
      return true;
    }
  }
  if (halvings == 0) return false;
  const double middle = 0.5 * (begin + end);
  const Vector between = curve_.at({stretch, middle});
  return add_part(from, between, stretch, begin, middle, halvings - 1) &&
         add_part(between, to, stretch, middle, end, halvings - 1);
}

bool SpiricPieces::add(const Vector& from, const SpiricCurve::Place& begin, const Vector& to,
                       const SpiricCurve::Place& end, bool around) {
  constexpr double last = std::numbers::pi, short_turn = 0.1;
  struct Stage {
    std::size_t stretch;
    double begin, end;
    Vector from, to;
  };
  std::vector<Stage> stages;
  Vector at = from;
  double turn = begin.turn;
  const double least = one_spot * torus_.size();
  // Where an end is at a joint of two stretches, but for roundings, the one has nothing of the arc.
  const auto add_stage = [&](std::size_t stretch, double until, const Vector& there) {
    const bool is_none = norm(there - at) <= least && until - turn < short_turn;
    if (!is_none) stages.push_back({stretch, turn, std::max(turn, until), at, there}), at = there;
    turn = 0;
  };
  if (begin.stretch != end.stretch || around) {
    const auto& stretches = curve_.loops()[curve_.loop_of(begin.stretch)].stretches;
    const std::size_t first = curve_.order_of(begin.stretch), size = stretches.size();
    const std::size_t steps =
        begin.stretch == end.stretch ? size : (curve_.order_of(end.stretch) + size - first) % size;
    for (std::size_t k = 0; k < steps; ++k) {
      const std::size_t stretch = stretches[(first + k) % size];
      add_stage(stretch, last, curve_.at({stretch, last}));
    }
  }
  add_stage(end.stretch, end.turn, to);
  if (!stages.empty()) stages.back().to = to;
  return std::ranges::all_of(
      stages, [&](const Stage& s) { return add_part(s.from, s.to, s.stretch, s.begin, s.end, most_halvings); });
}

bool SpiricPieces::add(const SpiricCurve::Loop& loop) {
  const Vector start = curve_.at({loop.stretches.front(), 0});
  Vector at = start;
  for (const std::size_t stretch : loop.stretches) {
    const bool is_last = stretch == loop.stretches.back();
    const Vector there = is_last ? start : curve_.at({stretch, std::numbers::pi});
    if (!add_part(at, there, stretch, 0, std::numbers::pi, most_halvings)) return false;
    at = there;
  }
  return true;
}

}  // namespace dynalin
