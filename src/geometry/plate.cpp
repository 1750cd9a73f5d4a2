#include "geometry/plate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/polygon.h"

namespace dynalin {

namespace {

constexpr double straight = 1e-9;  // of angles [rad] and of areas

struct OutlineSide {
  Vector direction, outwards;
};

// Neighbours that are the same point are one.
std::vector<Vector> distinct_corners(std::span<const Vector> corners) {
  std::vector<Vector> all;
  for (const Vector& p : corners) {
    if (all.empty() || norm(Vector{p.x, p.y, 0} - all.back()) > 0) all.push_back({p.x, p.y, 0});
  }
  while (all.size() > 1 && norm(all.front() - all.back()) == 0) all.pop_back();
  return all;
}

// Twice the area, 0 where rounding may have made all of it.
double area_of(const std::vector<Vector>& at) {
  double around = 0;
  for (std::size_t k = 0; k < at.size(); ++k) around += norm(at[(k + 1) % at.size()] - at[k]);
  const double twice = 2 * vector_area(at).z;
  return std::abs(twice) > straight * around * around ? twice : 0;
}

}  // namespace

std::optional<std::vector<Vector>> rounded_outline(std::span<const Vector> corners, double radius,
                                                   std::size_t segments) {
  std::vector<Vector> at = distinct_corners(corners);
  const std::size_t n = at.size();
  if (n < 2 || (n == 2 && radius == 0)) return std::nullopt;
  const double area = area_of(at);
  if (n > 2 && area == 0) return std::nullopt;
  if (area < 0) std::reverse(at.begin(), at.end());

  std::vector<OutlineSide> sides;  // from each corner to the next
  for (std::size_t k = 0; k < n; ++k) {
    const Vector d = normalized(at[(k + 1) % n] - at[k]);
    sides.push_back({d, {d.y, -d.x, 0}});
  }
  std::vector<Vector> outline;
  std::vector<std::size_t> first(n), last(n);  // points of the outline that belong to each corner
  for (std::size_t k = 0; k < n; ++k) {
    const OutlineSide &in = sides[(k + n - 1) % n], &out = sides[k];
    first[k] = outline.size();
    double angle = std::atan2(cross(in.direction, out.direction).z, dot(in.direction, out.direction));
    if (n == 2) angle = std::numbers::pi;
    if (angle < 0) {
      const double share = 1 + dot(in.outwards, out.outwards);
      if (share < straight) return std::nullopt;  // it turns back
      outline.push_back(at[k] + (radius / share) * (in.outwards + out.outwards));
    } else {
      const double wanted = angle / (2 * std::numbers::pi) * static_cast<double>(std::max<std::size_t>(segments, 3));
      const auto count = radius > 0 ? static_cast<std::size_t>(std::ceil(wanted - straight)) : 0;
      for (std::size_t i = 0; i <= count; ++i) {
        const double a = count > 0 ? angle * static_cast<double>(i) / static_cast<double>(count) : 0;
        outline.push_back(at[k] + radius * (std::cos(a) * in.outwards + std::sin(a) * in.direction));
      }
    }
    last[k] = outline.size() - 1;
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (!(dot(outline[first[(k + 1) % n]] - outline[last[k]], sides[k].direction) > 0)) return std::nullopt;
  }
  return outline;
}

}  // namespace dynalin
