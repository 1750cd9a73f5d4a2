#include "geometry/plate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/polygon.h"

namespace dynalin {

namespace {

constexpr double straight = 1e-9;  // [rad] a corner that turns by less is none

struct Side {
  Vector direction, outwards;
};

// Neighbours that are the same point, and corners that do not turn, left out.
std::vector<Vector> true_corners(std::span<const Vector> corners) {
  std::vector<Vector> all;
  for (const Vector& p : corners) {
    if (all.empty() || norm(p - all.back()) > 0) all.push_back({p.x, p.y, 0});
  }
  while (all.size() > 1 && norm(all.front() - all.back()) == 0) all.pop_back();
  if (all.size() < 3) return all;
  std::vector<Vector> turning;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Vector in = all[k] - all[(k + all.size() - 1) % all.size()], out = all[(k + 1) % all.size()] - all[k];
    if (std::abs(cross(in, out).z) > straight * norm(in) * norm(out) || dot(in, out) < 0) turning.push_back(all[k]);
  }
  return turning;
}

}  // namespace

std::optional<std::vector<Vector>> rounded_outline(std::span<const Vector> corners, double radius,
                                                   std::size_t segments) {
  std::vector<Vector> at = true_corners(corners);
  const std::size_t n = at.size();
  if (n < 2 || (n == 2 && radius == 0)) return std::nullopt;
  const double area = vector_area(at).z;
  if (n > 2 && area == 0) return std::nullopt;
  if (area < 0) std::reverse(at.begin(), at.end());

  std::vector<Side> sides;  // from each corner to the next
  for (std::size_t k = 0; k < n; ++k) {
    const Vector d = normalized(at[(k + 1) % n] - at[k]);
    sides.push_back({d, {d.y, -d.x, 0}});
  }
  std::vector<Vector> outline;
  std::vector<std::size_t> first(n), last(n);  // points of the outline that belong to each corner
  for (std::size_t k = 0; k < n; ++k) {
    const Side &in = sides[(k + n - 1) % n], &out = sides[k];
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
