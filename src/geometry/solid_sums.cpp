#include "geometry/solid_sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynalin {

namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

// Twice the area of a triangle with the axis, without cancellation where its corners are next to each other.
double area_about_z(const Vector& p, const Vector& q) {
  const double x = q.x - p.x, y = q.y - p.y;
  return x * x + y * y < 0.1 * (p.x * p.x + p.y * p.y) ? p.x * y - p.y * x : p.x * q.y - p.y * q.x;
}
// By which an angle about z grows.
double angle_about_z(const Vector& p, const Vector& q) { return std::atan2(area_about_z(p, q), p.x * q.x + p.y * q.y); }

// Of a triangle on the unit sphere, with its sign (van Oosterom and Strackee 1983).
double solid_angle(const Vector& a, const Vector& b, const Vector& c) {
  return 2 * std::atan2(dot(a, cross(b - a, c - a)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

// Along a mantle from a height on: ∫ r dz, ∫ r (z − base) dz and ∫ r² dz.
struct MantleIntegrals {
  double area, height, radius;
  MantleIntegrals(const QuadricSolid& s, double base, double z) {
    const double r = s.radius_at(base), k = s.slope(), d = z - base;
    area = d * (r + 0.5 * k * d);
    height = d * d * (0.5 * r + d * k / 3);
    radius = d * (r * r + d * (r * k + d * k * k / 3));
  }
};

}  // namespace

void SolidSums::add(const FacetSection& section, const std::vector<ConicPiece>& arcs) {
  const Vector& n = section.normal;
  Facet facet{n, section.boundary.front().from, {}, {}};
  facet.part.triangle = section.triangle;
  for (const FacetSection::Piece& p : section.boundary) {
    overlap.corners.push_back(p.from);
    if (p.face == SolidFace::curved) continue;
    facet.moments.add(facet.start, p.from, p.to, n);
    if (p.face != SolidFace::none) add_end(p.face == SolidFace::high, p, n, facet.part);
  }
  for (const ConicPiece& p : arcs) {
    overlap.corners.push_back(p.from), overlap.corners.push_back(p.place(0.5, 0).at);
    facet.moments.add(facet.start, p.from, p.to, n);
    add_arc(solid_, p, facet);
    if (solid_.has_ends()) {
      on_mantle_.push_back(p);
    } else {
      keep_on_sphere(p, n);
    }
  }
  FacetSums::add(facet);
}

// ∫ Q dφ, ∫ Q cos φ dφ and ∫ Q sin φ dφ by parts: by how much the angle has grown, not how fast, so that ends of arcs
// that are as far beside each other as roundings of grazing lines leave them do not count.
void SolidSums::add_to_mantle(const ConicPiece& p) {
  const double radius = std::hypot(p.from.x, p.from.y), cosine = p.from.x / radius, sine = p.from.y / radius;
  // By how much (sin φ, −cos φ) has grown since the beginning.
  const auto grown = [&](double turn) {
    const double s = std::sin(turn), half = std::sin(0.5 * turn), c = 2 * half * half;
    return Vector{cosine * s - sine * c, sine * s + cosine * c, 0};
  };
  Vector last = p.from;
  double turn = 0;
  const auto add = [&](double s, double weight) {
    const ConicPiece::Place at = p.place(s, weight);
    const double dz = ConicPiece::tangent(solid_, p, at).z * weight, z = at.at.z, r = solid_.radius_at(z);
    turn += angle_about_z(last, at.at), last = at.at;
    area_ -= r * turn * dz;
    first_ -= (grown(turn) * (r * r) + Vector{0, 0, r * (z - base_) * turn}) * dz;
  };
  for (std::size_t k = 0; k < gauss_14.size(); ++k) add(gauss_14[k][0], gauss_14[k][1]);
  for (std::size_t k = gauss_14.size(); k-- > 0;) add(1 - gauss_14[k][0], gauss_14[k][1]);
  turn += angle_about_z(last, p.to);
  const MantleIntegrals q(solid_, base_, p.to.z);
  turn_ += turn, area_ += q.area * turn;
  first_ += grown(turn) * q.radius + Vector{0, 0, q.height * turn};
}

// In axes by which the ellipsoid is the unit sphere, the arc is one of a circle.
void SolidSums::keep_on_sphere(const ConicPiece& p, const Vector& normal) {
  const Vector& a = solid_.semi_axes();
  const auto scaled = [&](const Vector& v) { return normalized(Vector{v.x / a.x, v.y / a.y, v.z / a.z}); };
  on_sphere_.push_back({scaled(p.from), scaled(p.to), Vector{normal.x * a.x, normal.y * a.y, normal.z * a.z}});
}

// Of the sphere to the left of arcs: triangles about an apex, and what is between the sides of these and the arcs.
double SolidSums::angle_on_sphere(const Vector& apex) const {
  double sum = 0;
  for (const auto& [from, to, across] : on_sphere_) {
    // The middle of the arc's circle on the sphere that is the nearer one.
    const Vector n = across / (dot(across, from) < 0 ? -norm(across) : norm(across));
    const double beside = 0.5 * dot(from - n, from - n);  // 1 − n · from
    const Vector u = from - n * (1 - beside), v = to - n * dot(n, to);
    const double turn = std::atan2(dot(n, cross(u, v)), dot(u, v));
    sum += solid_angle(apex, from, to) + turn * beside - solid_angle(n, from, to);
  }
  return sum;
}

void SolidSums::add_end(bool upper, const FacetSection::Piece& p, const Vector& normal, Overlap::FixedPart& part) {
  const Vector out{0, 0, upper ? 1.0 : -1.0};
  if (const auto cut = StraightCut::of(p.from, p.to, normal, out, 1)) cut->add_to(part);
  if (const auto cut = StraightCut::of(p.from, p.to, out, normal, -1)) cut->add_to(upper ? high : low);
  End& end = ends_[upper];
  // Seen from outside of either end a disc has its rim the other way round.
  const double sign = upper ? 1 : -1, radius = solid_.radius(upper);
  const Vector way = p.to - p.from, middle = 0.5 * (p.from + p.to);
  end.turn += sign * angle_about_z(p.from, p.to);
  end.area -= sign * 0.5 * area_about_z(p.from, p.to);
  end.way += sign * way;
  // ∫ (r² − x² − y²) along it.
  const double square = middle.x * middle.x + middle.y * middle.y + (way.x * way.x + way.y * way.y) / 12;
  const double beside = sign * 0.5 * (radius * radius - square);
  end.first += Vector{beside * way.y, -beside * way.x, 0};
}

bool SolidSums::finish(bool lower, bool upper) {
  if (!(solid_.has_ends() ? finish_frustum(lower, upper) : finish_ellipsoid(upper))) return false;
  carry_along();
  return true;
}

// About the place of the axis from which what bounds the volume on the mantle reaches to the wider end: there nothing
// is large that cancels, whether the volume is small or the solid comes to a point in it.
bool SolidSums::finish_frustum(bool lower, bool upper) {
  constexpr double one_turn = 1e-3;
  const bool widens = solid_.frustum().high_radius > solid_.frustum().low_radius;
  base_ = solid_.height(widens);
  for (const ConicPiece& p : on_mantle_) {
    for (const double z : {p.from.z, p.to.z}) base_ = widens ? std::min(base_, z) : std::max(base_, z);
  }
  for (const ConicPiece& p : on_mantle_) add_to_mantle(p);

  const double steep = std::hypot(1, solid_.slope()), r0 = solid_.radius_at(base_) / steep;
  Vector moment = height_moment_ - along_ * base_ + Vector{0, 0, base_ * (base_ * net_.z - height_)};
  double volume = height_ - base_ * net_.z;
  std::array<double, 2> turns;
  Vector first = first_;
  curved.area = area_;
  for (const bool high_end : {false, true}) {
    const End& end = ends_[high_end];
    const double sign = high_end ? 1 : -1, r = solid_.radius(high_end), h = solid_.height(high_end) - base_;
    turns[high_end] = between_none_and(whole_turn, end.turn, high_end ? upper : lower);
    Overlap::Part& part = high_end ? high : low;
    part.area = 0.5 * r * r * turns[high_end] + end.area;
    volume += sign * h * part.area;
    moment += (end.first + Vector{0, 0, h * part.area}) * (sign * h);
    const MantleIntegrals whole(solid_, base_, solid_.height(high_end));
    curved.area += sign * whole.area * turns[high_end];
    first.z += sign * whole.height * turns[high_end];
    if (r > 0) first += Vector{end.way.y, -end.way.x, 0} * (sign * whole.radius / r);
  }
  // A way around the mantle and back by another one.
  if (std::abs(turns[0] - turns[1] - turn_) > one_turn) return false;
  curved.area *= steep;
  overlap.volume = (volume + r0 * curved.area) / 3;
  overlap.moment = (moment + first * (steep * r0)) * 0.25 + Vector{0, 0, base_ * overlap.volume};
  return true;
}

bool SolidSums::finish_ellipsoid(bool holds_pole) {
  const Vector& a = solid_.semi_axes();
  const double whole = a.x * a.y * a.z;
  Vector on_sphere;  // ∫ n dS of the sphere that it is in other axes
  for (std::size_t k = 0; k < 3; ++k) {
    overlap.moment[k] = 0.25 * (height_moment_[k] - a[k] * a[k] * net_[k]);
    on_sphere[k] = -net_[k] * a[k] / whole;
  }
  // About the middle of a small part of it, or of what is missing of it, nothing is large that cancels.
  const double flat = norm(on_sphere);
  Vector apex = flat > 0 ? on_sphere / flat : Vector{0, 0, 1}, around{};
  for (const SphereArc& arc : on_sphere_) around += arc.from;
  if (dot(apex, around) < 0) apex = -apex;
  const double angle = between_none_and(2 * whole_turn, -angle_on_sphere(apex), holds_pole);
  overlap.volume = (height_ + whole * angle) / 3;
  // Where it is nearly flat it is as large as its net area; how much larger where it bends, as on that sphere.
  curved.area = flat > 0 ? norm(net_) * std::max(angle, 0.0) / flat : 0;
  return true;
}

}  // namespace dynalin
