// The directions in which a frustum may part soonest from a box or from another frustum: those in which the separation
// of all of both,
//
//     h(n) = min n·x of I − max n·x of J,
//
// is as large as in all directions nearby: normals of faces, common normals of two lines (of mantles and edges),
// normals of a mantle or an edge where the other side has a corner or a rim, and those where two rims meet. These are
// the normals of all smooth points on the surface of { x of I less x of J }; what is convex is what all planes there
// leave of space, and so one of them parts what is apart, whatever is nearest to what.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <span>

#include "geometry/placed_frustum.h"
#include "geometry/rim_normal.h"

namespace dynalin::solid {

struct PartingDirection {
  enum class Of { face, lines, ruled_I, ruled_J, rims };
  Vector normal;  // out of J
  double separation = 0;
  Of of = Of::face;
  std::size_t which = 0;  // line direction of a box; of a convex body the face (of I: none of them) or edge
  bool level = false;     // a whole circle of directions is as good
};

// What parts so much later than the best is not where they touch, whatever has been missed before it.
inline constexpr double deeper = 2;

// In fixed room for all there can be: 24 local maxima of 48 samples on each of four circles, 8 faces and 6 normals of
// lines; of two frusta half of that and those of rims, each of these once. Of more, which a convex body may have,
// those that part last are left out.
class PartingDirections {
 public:
  void add(const PartingDirection& d) {
    if (count_ < room_.size()) {
      room_[count_++] = d;
    } else if (auto last = std::ranges::min_element(room_, {}, &PartingDirection::separation);
               last->separation < d.separation) {
      *last = d;
    }
    largest_ = std::max(largest_, d.separation);
  }
  double largest() const { return largest_; }
  // Those that part soonest first; of equal ones that of a face, then those of lines.
  void sort(double tolerance) {
    const auto rank = [&](const PartingDirection& d) { return d.separation - tolerance * static_cast<int>(d.of); };
    std::sort(room_.begin(), room_.begin() + static_cast<std::ptrdiff_t>(count_),
              [&](const auto& a, const auto& b) { return rank(a) > rank(b); });
  }
  std::span<const PartingDirection> all() const { return {room_.data(), count_}; }

 private:
  std::array<PartingDirection, 112> room_;
  std::size_t count_ = 0;
  double largest_ = -unbounded;
};

// --- what a side has

inline std::size_t lines_of(const PlacedFrustum<double>&) { return 1; }
inline std::size_t lines_of(const PlacedBox<double>&) { return 3; }
template <class T>
Ruled<T> lines(const PlacedFrustum<T>& f, std::size_t, const Vector&) {
  return f.mantle();
}
// The edge along axis `k` that is farthest in a direction.
template <class T>
Ruled<T> lines(const PlacedBox<T>& b, std::size_t k, const Vector& n) {
  Vector p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = i != k && dot(value_of(b.axes[i]), n) > 0 ? b.box.high[i] : b.box.low[i];
  return ruled_of(Edge<T>{b.at(p), b.axes[k], b.box.high[k] - b.box.low[k]}, b.axes[(k + 1) % 3]);
}

template <class Visit>
void for_each_normal(const PlacedFrustum<double>& f, const Visit& visit) {
  for (const bool upper : {false, true}) {
    if (f.radius(upper) > 0) visit(f.end_normal(upper));
  }
}
template <class Visit>
void for_each_normal(const PlacedBox<double>& b, const Visit& visit) {
  for (const Vector& a : b.axes) visit(a), visit(-a);
}

// --- the search

template <class Other>
class Parting {
 public:
  Parting(const PlacedFrustum<double>& I, const Other& J) : I_(I), J_(J), size_(std::min(I.size(), J.size())) {
    using Of = PartingDirection::Of;
    for_each_normal(J, [&](const Vector& n) { add(n, Of::face); });
    for_each_normal(I, [&](const Vector& n) { add(-n, Of::face); });
    for (std::size_t k = 0; k < lines_of(J); ++k) {
      const Ruled<double> of_J = lines(J, k, {});
      if (const auto both = common_normals(I.mantle(), of_J)) {
        for (const Vector& n : *both) add(n, Of::lines, k);
      }
      search_circle(of_J, 1, Of::ruled_J, k);
    }
    search_circle(I.mantle(), -1, Of::ruled_I, 0);
    if constexpr (std::is_same_v<Other, PlacedFrustum<double>>) search_rims();
    found_.sort(coincidence * size_);
  }
  std::span<const PartingDirection> all() const { return found_.all(); }

 private:
  double separation(const Vector& n) const { return dot(n, farthest(I_, -n) - farthest(J_, n)); }
  void add(const Vector& n, PartingDirection::Of of, std::size_t which = 0, bool level = false) {
    found_.add({n, separation(n), of, which, level});
  }

  // Whether all normals within so many radians about one are too deep to count: the farthest points d of both there say
  // that the separation across another one m is at most m·d.
  bool is_deep_beside(const Ruled<double>& r, double angle, double sense, double within) const {
    const Vector n = r.normal(angle) * sense, d = farthest(I_, -n) - farthest(J_, n);
    const double most = dot(n, d) + within * std::abs(dot(r.turned(angle), d)) +
                        0.5 * within * within * std::abs(r.along_radius * dot(r.outward(angle), d));
    return most < deeper * std::min(found_.largest(), 0.0) - 2 * coincidence * size_;
  }
  // Each place on the circle of its normals where the separation is the largest of those nearby.
  void search_circle(const Ruled<double>& r, double sense, PartingDirection::Of of, std::size_t which) {
    constexpr std::size_t samples = 48;
    constexpr double step = 2 * std::numbers::pi / samples;
    std::array<double, samples> at;
    for (std::size_t k = 0; k < samples; ++k) at[k] = separation(r.normal(static_cast<double>(k) * step) * sense);
    const auto [low, high] = std::minmax_element(at.begin(), at.end());
    if (*high - *low < coincidence * size_) return add(r.normal(0.0) * sense, of, which, true);
    for (std::size_t k = 0; k < samples; ++k) {
      if (at[k] < at[(k + samples - 1) % samples] || at[k] <= at[(k + 1) % samples]) continue;
      if (is_deep_beside(r, static_cast<double>(k) * step, sense, step)) continue;
      double from = (static_cast<double>(k) - 1) * step, to = (static_cast<double>(k) + 1) * step;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (from + to);
        const Vector n = r.normal(middle) * sense;
        (dot(r.turned(middle) * sense, farthest(I_, -n) - farthest(J_, n)) > 0 ? from : to) = middle;
      }
      add(r.normal(0.5 * (from + to)) * sense, of, which);
    }
  }

  // Where two rims have a common normal: uphill from the best of many directions, and of those beside either axis,
  // where the farthest point of a rim turns fast.
  void search_rims() {
    if (found_.largest() > 0) return;  // apart already
    constexpr std::size_t rings = 8, most = 4;
    std::array<std::array<Start, most>, 4> best;
    for (std::size_t i = 0; i < rings; ++i) {
      const double polar = std::numbers::pi * (static_cast<double>(i) + 0.5) / rings;
      const auto around = static_cast<std::size_t>(std::lround(2 * rings * std::sin(polar)));
      for (std::size_t k = 0; k < around; ++k) {
        const Start start =
            start_at(J_.at, polar, 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(around));
        auto& of_pair = best[start.pair];
        // The best of those that are not beside each other.
        std::size_t place = most - 1;
        for (std::size_t m = 0; m < most; ++m) {
          if (dot(of_pair[m].normal, start.normal) > least_cosine) {
            place = m;
            break;
          }
          if (of_pair[m].separation < of_pair[place].separation) place = m;
        }
        if (start.separation > of_pair[place].separation) of_pair[place] = start;
      }
    }
    for (const auto& of_pair : best) {
      for (const Start& s : of_pair) climb(s);
    }
    for (const RelativeFrame<double>* axes : {&I_.at, &J_.at}) {
      for (const bool other_way : {false, true}) {
        for (const double beside : {0.02, 0.1}) {
          Start steepest;
          for (std::size_t k = 0; k < 8; ++k) {
            const double polar = other_way ? std::numbers::pi - beside : beside;
            const Start start = start_at(*axes, polar, std::numbers::pi / 4 * static_cast<double>(k));
            if (start.separation > steepest.separation) steepest = start;
          }
          climb(steepest);
        }
      }
    }
    search_beside_ends(I_, J_, true), search_beside_ends(J_, I_, false);
    search_beyond_lines();
  }
  // What is largest about a mantle, with the place beyond an end of the line there, is not so across the mantle: it
  // goes on uphill with the rim at this end. However narrow the directions are in which both rims reach, nothing is
  // missed so where a place passes over a rim.
  void search_beyond_lines() {
    const std::size_t count = found_.all().size();
    for (std::size_t k = 0; k < count; ++k) {
      const PartingDirection d = found_.all()[k];
      const bool of_I = d.of == PartingDirection::Of::ruled_I;
      if (d.level || (!of_I && d.of != PartingDirection::Of::ruled_J)) continue;
      const Vector& n = d.normal;
      const Ruled<double> mantle = of_I ? I_.mantle() : J_.mantle();
      const Edge<double> line = mantle.line(of_I ? -n : n);
      const bool upper = upper_reaches(of_I ? J_ : I_, of_I ? n : -n);
      const Vector other = farthest((of_I ? J_ : I_).rim(upper), of_I ? n : -n);
      const double along = dot(other - line.from, line.along);
      if (along >= 0 && along <= line.length) continue;
      const bool beyond_upper = along > 0;
      climb({n, d.separation,
             of_I ? (beyond_upper ? 2u : 0u) + (upper ? 1u : 0u) : (upper ? 2u : 0u) + (beyond_upper ? 1u : 0u)});
    }
  }
  // Where the deepest point below an end of `f` is a little outside of its rim, both rims have a common normal a little
  // beside that of the end, tilted towards this point: between all directions that are looked at otherwise.
  void search_beside_ends(const PlacedFrustum<double>& f, const PlacedFrustum<double>& other, bool of_I) {
    for (const bool upper : {false, true}) {
      if (f.radius(upper) == 0) continue;
      const Vector out = f.end_normal(upper), from_centre = farthest(other, -out) - f.centre(upper);
      const Vector aside = from_centre - dot(from_centre, out) * out;
      const double outside = norm(aside) - f.radius(upper);
      if (!(outside > 0)) continue;
      for (const double share : {0.1, 1.0, 5.0}) {
        const Vector tilted = out + std::min(0.3, share * outside / size_) / norm(aside) * aside;
        const Vector n = (of_I ? -1 : 1) / norm(tilted) * tilted;
        climb({n, separation(n), (upper_reaches(I_, -n) ? 2u : 0u) + (upper_reaches(J_, n) ? 1u : 0u)});
      }
    }
  }
  struct Start {
    Vector normal;
    double separation = -unbounded;
    std::size_t pair = 0;  // of rims: 2 with the upper one of I, 1 with that of J
  };
  Start start_at(const RelativeFrame<double>& axes, double polar, double azimuth) const {
    const Vector n =
        std::sin(polar) * (std::cos(azimuth) * axes.x + std::sin(azimuth) * axes.y) + std::cos(polar) * axes.z;
    return {n, separation(n), (upper_reaches(I_, -n) ? 2u : 0u) + (upper_reaches(J_, n) ? 1u : 0u)};
  }
  void climb(const Start& s) {
    // Both farthest points bound the separation of other directions m: it is at most m·(point of I − point of J).
    constexpr double within = 0.3;  // radians between these directions, at most
    const Vector d = farthest(I_, -s.normal) - farthest(J_, s.normal);
    const double across = norm(d - s.separation * s.normal);
    if (s.separation * std::cos(within) + across * std::sin(within) < found_.largest()) return;
    const Circle<double> on_I = I_.rim(s.pair >= 2), on_J = J_.rim(s.pair % 2 == 1);
    if (!std::isfinite(s.separation) || on_I.radius == 0 || on_J.radius == 0) return;
    const auto n = RimPair(on_I, on_J).uphill(s.normal);
    // Of the rims that reach there, and once.
    if (!n || upper_reaches(I_, -*n) != (s.pair >= 2) || upper_reaches(J_, *n) != (s.pair % 2 == 1)) return;
    const auto found = found_.all();
    const bool again = std::any_of(found.begin(), found.end(), [&](const PartingDirection& other) {
      return other.of == PartingDirection::Of::rims && other.which == s.pair && norm(other.normal - *n) < 1e-7;
    });
    if (!again) add(*n, PartingDirection::Of::rims, s.pair);
  }

  const PlacedFrustum<double>& I_;
  const Other& J_;
  double size_;
  PartingDirections found_;
};

}  // namespace dynalin::solid
