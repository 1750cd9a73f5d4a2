#include "geometry/torus_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dynalin {

namespace {

constexpr double one_turn = 2 * std::numbers::pi;

double nearest_turn(double angle, double to) { return angle - one_turn * std::round((angle - to) / one_turn); }

// Of 1, cos u, sin u, cos² u and sin u cos u.
using OfU = std::array<double, 5>;
// ∫ dS and, with y = x − origin, ∫ n · y dS and ∫ (n · y) y dS, or what they are made of.
struct SurfaceIntegrals {
  double area = 0, height = 0;
  Vector moment{};  // away from the axis at the origin, around it, along it
  SurfaceIntegrals& operator+=(const SurfaceIntegrals& b) {
    area += b.area, height += b.height, moment += b.moment;
    return *this;
  }
  SurfaceIntegrals operator*(double s) const { return {area * s, height * s, moment * s}; }
};

// ∫ cosⁿ v dv, ∫ sin v cosⁿ v dv and ∫ sin² v cosⁿ v dv from the angle of the origin on.
struct PowersOfV {
  std::array<double, 4> c;
  std::array<double, 3> s;
  std::array<double, 2> ss;

  static PowersOfV between(double from, double w) {
    const double half = std::sin(0.5 * w), middle = from + 0.5 * w, c0 = std::cos(from), c1 = std::cos(from + w),
                 s0 = std::sin(from), s1 = std::sin(from + w);
    const double dc = 2 * std::sin(middle) * half, ds = 2 * std::cos(middle) * half;
    const double cubes = ds * (s0 * s0 + s0 * s1 + s1 * s1) / 3, twice = 0.5 * std::cos(2 * middle) * std::sin(w);
    return {{w, ds, 0.5 * w + twice, ds - cubes},
            {dc, 0.5 * dc * (c0 + c1), dc * (c0 * c0 + c0 * c1 + c1 * c1) / 3},
            {0.5 * w - twice, cubes}};
  }
  static PowersOfV whole() {
    constexpr double pi = std::numbers::pi;
    return {{one_turn, 0, pi, 0}, {0, 0, 0}, {pi, 0}};
  }
};

}  // namespace

// A place of the surface is (R + r cos v) away from the axis and r sin v high, with the normal n, n · x = R cos v + r
// and dS = r (R + r cos v) du dv. The origin is `a` away from the axis and `h` high.
struct TorusSums::OverSurface {
  double R, r, a, h;
  SurfaceIntegrals sum{};
  double angles = 0;  // ∫ du dv
  double u_turns = 0, v_turns = 0;

  // Integrals over v, by du, of what depends on u as given by `of`.
  SurfaceIntegrals by_du(const PowersOfV& v, const OfU& of) const {
    const auto J = [&](const auto& powers, std::size_t n) { return r * (R * powers[n] + r * powers[n + 1]); };
    const double c0 = J(v.c, 0), c1 = J(v.c, 1), c2 = J(v.c, 2), s0 = J(v.s, 0), s1 = J(v.s, 1), ss = J(v.ss, 0);
    // n · y is A − a cos v cos u with A = r + R cos v − h sin v.
    const double A = r * c0 + R * c1 - h * s0, A_cos = r * c1 + R * c2 - h * s1, A_sin = r * s0 + R * s1 - h * ss;
    const double A_far = R * A + r * A_cos, cos_far = R * c1 + r * c2;
    return {c0 * of[0],
            A * of[0] - a * c1 * of[1],
            {-a * A * of[0] + (A_far + a * a * c1) * of[1] - a * cos_far * of[3], A_far * of[2] - a * cos_far * of[4],
             (r * A_sin - h * A) * of[0] - a * (r * s1 - h * c1) * of[1]}};
  }
};

void TorusSums::set_origin(const Vector& p) {
  origin = p;
  radius_ = std::hypot(p.x, p.y), cos_u_ = p.x / radius_, sin_u_ = p.y / radius_;
  v_ = std::atan2(p.z, radius_ - torus_.major()), cos_v_ = std::cos(v_), sin_v_ = std::sin(v_);
}

TorusSums::Angles TorusSums::angles(const Vector& p) const {
  const double beyond = std::hypot(p.x, p.y) - torus_.major();
  return {std::atan2(p.y * cos_u_ - p.x * sin_u_, p.x * cos_u_ + p.y * sin_u_),
          std::atan2(p.z * cos_v_ - beyond * sin_v_, beyond * cos_v_ + p.z * sin_v_)};
}

void TorusSums::add(const TorusSection& section) {
  const Vector& n = section.normal;
  const Vector start = section.chains.empty() ? section.edges.front().from : section.chains.front().from;
  if (sections_.empty()) set_origin(start);
  sections_.push_back(&section);
  Facet facet{n, start - origin, {}, {}};
  facet.part.triangle = section.triangle;
  const auto add_straight = [&](const Vector& from, const Vector& to) {
    overlap.corners.push_back(from - origin);
    facet.moments.add(facet.start, from - origin, to - origin, n);
  };
  for (const TorusSection::Edge& e : section.edges) add_straight(e.from, e.to);
  for (const TorusSection::Chain& chain : section.chains) {
    if (chain.arcs.empty()) add_straight(chain.from, chain.to);
    for (const SpiricPiece& p : chain.arcs) {
      add_straight(p.from, p.to);
      overlap.corners.push_back(p.places[p.places.size() / 2].at - origin);
      add_arc(torus_, p, facet);
    }
  }
  FacetSums::add(facet);
}

// What is in the body is to the right of a line that has the facet to its left. Green's theorem: what is below a line,
// from the angle of the origin on, and where a line has gone up by a turn, as much as a turn has from there to where u
// begins anew.
void TorusSums::add_chain(const TorusSection::Chain& chain, OverSurface& over) const {
  Angles here = angles(chain.from);
  const auto go_on = [&](const Vector& p) {
    const Angles next = angles(p);
    here = {nearest_turn(next.u, here.u), nearest_turn(next.v, here.v)};
  };
  for (const SpiricPiece& piece : chain.arcs) {
    piece.for_each_place([&](const SpiricPiece::Place& place) {
      go_on(place.at);
      const Vector &p = place.at, &t = place.tangent;
      const double du = (p.x * t.y - p.y * t.x) / (p.x * p.x + p.y * p.y) * place.share;
      const double c = std::cos(here.u), s = std::sin(here.u);
      over.sum += over.by_du(PowersOfV::between(v_, here.v), {1, c, s, c * c, s * c}) * du;
      over.angles += here.v * du;
    });
  }
  go_on(chain.to);
  const Angles there = angles(chain.to);
  const double v_turns = std::round((here.v - there.v) / one_turn), u = here.u;
  if (v_turns != 0) {
    const double c = std::cos(u), s = std::sin(u);
    over.sum += over.by_du(PowersOfV::whole(), {u, s, 1 - c, 0.5 * (u + s * c), 0.5 * s * s}) * -v_turns;
    over.angles -= one_turn * v_turns * u;
  }
  over.v_turns += v_turns, over.u_turns += std::round((u - there.u) / one_turn);
}

bool TorusSums::finish(bool holds_most) {
  OverSurface over{torus_.major(), torus_.minor(), radius_, origin.z};
  for (const TorusSection* s : sections_) {
    for (const TorusSection::Chain& chain : s->chains) add_chain(chain, over);
  }
  // What bounds a part of a surface comes back to where it was.
  if (over.u_turns != 0 || over.v_turns != 0) return false;
  const double whole = one_turn * one_turn, all = between_none_and(whole, over.angles, holds_most);
  const double times = std::round((all - over.angles) / whole);
  if (times != 0) over.sum += over.by_du(PowersOfV::whole(), {one_turn, 0, 0, std::numbers::pi, 0}) * times;
  const SurfaceIntegrals& sum = over.sum;
  curved.area = sum.area;
  overlap.volume = (height_ + sum.height) / 3;
  const Vector& m = sum.moment;
  overlap.moment = (height_moment_ + Vector{cos_u_ * m.x - sin_u_ * m.y, sin_u_ * m.x + cos_u_ * m.y, m.z}) * 0.25;
  carry_along();
  return true;
}

}  // namespace dynalin
