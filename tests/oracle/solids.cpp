// How far a point is from a solid or a wall.
#include "solids.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>

namespace dynalin::oracle {

namespace {

Real sign(Real x) { return x < 0 ? -1 : 1; }

// The foot y with x = y + t N y, where y is on the surface y.N y = 1, of N = diag(1/a^2). Of those t the nearest foot
// has the largest. From below the root the sum of squares falls and is convex: Newton comes up to it.
Distance from_ellipsoid(const Triple& scales, const Vec& x) {
  const std::array<Real, 3> a{scales[0] / 2.0L, scales[1] / 2.0L, scales[2] / 2.0L};
  Real t = -1e300L;
  for (int k = 0; k < 3; ++k) {
    const Real half = a[static_cast<std::size_t>(k)];
    t = std::max(t, half * std::fabs(component(x, k)) - half * half);
  }
  for (int n = 0; n < 200; ++n) {
    Real f = -1, slope = 0;
    for (int k = 0; k < 3; ++k) {
      const Real half = a[static_cast<std::size_t>(k)], below = half * half + t;
      const Real y = component(x, k) == 0 ? 0 : half * component(x, k) / below;
      f += y * y, slope -= y == 0 ? 0 : 2 * y * y / below;
    }
    const Real change = f / slope;
    t -= change;
    if (!(f > 0) || std::fabs(change) < 1e-20L * a[0] * a[0]) break;
  }
  Vec foot, normal;
  for (int k = 0; k < 3; ++k) {
    const Real half = a[static_cast<std::size_t>(k)], n = component(x, k) / (half * half + t);
    set_component(foot, k, half * half * n);
    set_component(normal, k, n);
  }
  normal = normalized(normal);
  return {dot(x - foot, normal), normal};
}

Distance from_box(const Triple& extents, const Vec& x) {
  Vec beyond, outside;
  int nearest = 0;
  const Vec middle = x - 0.5L * Vec{extents[0], extents[1], extents[2]};
  for (int k = 0; k < 3; ++k) {
    const Real m = component(middle, k), d = std::fabs(m) - std::fabs(extents[static_cast<std::size_t>(k)]) / 2.0L;
    set_component(beyond, k, d);
    if (d > 0) set_component(outside, k, sign(m) * d);
    if (d > component(beyond, nearest)) nearest = k;
  }
  if (norm(outside) > 0) return {norm(outside), normalized(outside)};
  return {component(beyond, nearest), sign(component(middle, nearest)) * unit(nearest)};
}

// In the half-plane through its axis, r outwards and z from the bottom towards the top: bottom, mantle, top.
struct Profile {
  struct Point {
    Real r = 0, z = 0;
  };
  std::array<Point, 4> corner;
  explicit Profile(const Triple& size) {
    const Real length = std::fabs(size[0]);
    corner = {Point{0, 0}, Point{size[1], 0}, Point{size[2], length}, Point{0, length}};
  }
  // Out of the side after a corner.
  [[nodiscard]] Point normal(std::size_t k) const {
    const Real r = corner[k + 1].r - corner[k].r, z = corner[k + 1].z - corner[k].z, size = std::hypot(r, z);
    return {z / size, -r / size};
  }
  [[nodiscard]] Real beyond(std::size_t k, const Point& x) const {
    const Point n = normal(k);
    return n.r * (x.r - corner[k].r) + n.z * (x.z - corner[k].z);
  }
};

// A point and a direction of the half-plane in which a point lies.
struct HalfPlane {
  Vec outwards;
  Real up = 1;
  Profile::Point x;
  HalfPlane(const Triple& size, const Vec& p) : up(size[0] < 0 ? -1 : 1), x{std::hypot(p.x, p.y), up * p.z} {
    outwards = x.r > 0 ? Vec{p.x / x.r, p.y / x.r, 0} : unit(0);
  }
  [[nodiscard]] Vec turned(const Profile::Point& n) const { return n.r * outwards + (up * n.z) * unit(2); }
};

Distance from_frustum(const Triple& size, const Vec& p) {
  const Profile profile(size);
  const HalfPlane half(size, p);
  std::size_t farthest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (profile.beyond(k, half.x) > profile.beyond(farthest, half.x)) farthest = k;
  }
  const Real out = profile.beyond(farthest, half.x);
  if (out <= 0) return {out, half.turned(profile.normal(farthest))};
  Distance nearest{1e300L, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const Profile::Point n = profile.normal(k), a = profile.corner[k], b = profile.corner[k + 1];
    const Real length = std::hypot(b.r - a.r, b.z - a.z);
    const Real along = -n.z * (half.x.r - a.r) + n.r * (half.x.z - a.z);
    if (along >= 0 && along <= length) {
      const Real d = profile.beyond(k, half.x);
      if (d > 0 && d < nearest.value) nearest = {d, half.turned(n)};
    } else {
      const Profile::Point from = along < 0 ? a : b, away{half.x.r - from.r, half.x.z - from.z};
      const Real d = std::hypot(away.r, away.z);
      if (d < nearest.value) nearest = {d, half.turned({away.r / d, away.z / d})};
    }
  }
  return nearest;
}

// The outline of a wedge, counter-clockwise from its axis.
std::vector<Profile::Point> outline(const Triple& size) {
  std::vector<Profile::Point> points{{0, 0}};
  for (int k = 0; k <= 3; ++k)
    points.push_back({size[1] * std::cos(size[2] * k / 3.0L), size[1] * std::sin(size[2] * k / 3.0L)});
  return points;
}

// From a convex outline, and so much along z beyond the nearer end.
Distance from_wedge(const Triple& size, const Vec& p) {
  const std::vector<Profile::Point> corner = outline(size);
  Distance across{-1e300L, {}}, apart{1e300L, {}};
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const Profile::Point &a = corner[k], &b = corner[(k + 1) % corner.size()];
    const Vec side{b.r - a.r, b.z - a.z, 0}, from{p.x - a.r, p.y - a.z, 0};
    const Vec out = normalized({side.y, -side.x, 0});
    if (const Real beyond = dot(out, from); beyond > across.value) across = {beyond, out};
    const Real along = std::clamp<Real>(dot(from, side) / dot(side, side), 0, 1);
    const Vec away = from - along * side;
    if (const Real d = norm(away); d < apart.value) apart = {d, normalized(away)};
  }
  if (across.value > 0) across = apart;
  const Real middle = p.z - size[0] / 2.0L, beyond = std::fabs(middle) - std::fabs(size[0]) / 2.0L;
  const Vec up = sign(middle) * unit(2);
  if (across.value > 0 && beyond > 0) {
    const Vec both = across.value * across.gradient + beyond * up;
    return {norm(both), normalized(both)};
  }
  return across.value > beyond ? across : Distance{beyond, up};
}

Distance from_torus(const Triple& size, const Vec& p) {
  const Real r = std::hypot(p.x, p.y), out = r - size[0], d = std::hypot(out, p.z);
  return {d - size[1], {out / d * p.x / r, out / d * p.y / r, p.z / d}};
}

Distance local_distance(const Solid& solid, const Vec& x) {
  switch (solid.shape) {
    case SolidShape::ellipsoid:
      return from_ellipsoid(solid.size, x);
    case SolidShape::box:
      return from_box(solid.size, x);
    case SolidShape::frustum:
      return from_frustum(solid.size, x);
    case SolidShape::torus:
      return from_torus(solid.size, x);
    case SolidShape::wedge:
      return from_wedge(solid.size, x);
  }
  throw std::logic_error("no such solid");
}

}  // namespace

DistanceOf distance_from(const Solid& solid, const MarkerPose& pose) {
  return [=](const Vec& x) {
    const Distance d = local_distance(solid, pose.seen(x));
    return Distance{d.value, pose.R * d.gradient};
  };
}

std::vector<DistanceOf> walls_of(const Solid& cavity, const MarkerPose& pose) {
  std::vector<DistanceOf> walls;
  if (cavity.shape == SolidShape::ellipsoid) {
    const DistanceOf out = distance_from(cavity, pose);
    walls.emplace_back([=](const Vec& x) {
      const Distance d = out(x);
      return Distance{-d.value, -d.gradient};
    });
  } else if (cavity.shape == SolidShape::box) {
    for (int k = 0; k < 3; ++k) {
      const Real extent = cavity.size[static_cast<std::size_t>(k)];
      for (const bool far : {false, true}) {
        const Vec inwards = (sign(extent) * (far ? -1 : 1)) * (pose.R * unit(k));
        const Vec on_wall = pose.at((far ? extent : 0) * unit(k));
        walls.emplace_back([=](const Vec& x) { return Distance{dot(inwards, x - on_wall), inwards}; });
      }
    }
  } else if (cavity.shape == SolidShape::frustum) {
    for (std::size_t side = 0; side < 3; ++side) {
      walls.emplace_back([=](const Vec& x) {
        const Profile profile(cavity.size);
        const HalfPlane half(cavity.size, pose.seen(x));
        return Distance{-profile.beyond(side, half.x), -(pose.R * half.turned(profile.normal(side)))};
      });
    }
  } else {
    throw std::logic_error("no such cavity");
  }
  return walls;
}

Circle centre_circle(const Solid& torus, const MarkerPose& pose) {
  return {pose.p, torus.size[0] * pose.R.column[0], torus.size[0] * pose.R.column[1]};
}

std::vector<Circle> rims(const Solid& frustum, const MarkerPose& pose) {
  const auto& [length, bottom, top] = frustum.size;
  return {{pose.p, bottom * pose.R.column[0], bottom * pose.R.column[1]},
          {pose.at({0, 0, length}), top * pose.R.column[0], top * pose.R.column[1]}};
}

std::vector<Vec> corners(const Solid& box, const MarkerPose& pose) {
  std::vector<Vec> points;
  if (box.shape == SolidShape::wedge) {
    for (const Profile::Point& p : outline(box.size)) {
      for (const Real z : {Real(0), Real(box.size[0])}) points.push_back(pose.at({p.r, p.z, z}));
    }
    return points;
  }
  for (int k = 0; k < 8; ++k) {
    points.push_back(pose.at({(k & 1) * box.size[0], (k >> 1 & 1) * box.size[1], (k >> 2) * box.size[2]}));
  }
  return points;
}

Vec support(const Solid& ellipsoid, const MarkerPose& pose, const Vec& along) {
  Vec stretched = transpose(pose.R) * along;
  for (int k = 0; k < 3; ++k) {
    set_component(stretched, k, component(stretched, k) * ellipsoid.size[static_cast<std::size_t>(k)] / 2);
  }
  stretched = normalized(stretched);
  for (int k = 0; k < 3; ++k) {
    set_component(stretched, k, component(stretched, k) * ellipsoid.size[static_cast<std::size_t>(k)] / 2);
  }
  return pose.at(stretched);
}

Real least_on_turn(const std::function<OnTurn(Real)>& f) {
  constexpr int samples = 120;
  constexpr Real step = 2 * std::numbers::pi_v<Real> / samples;
  int best = 0;
  std::vector<Real> values;
  for (int k = 0; k < samples; ++k) {
    values.push_back(f(step * k).value);
    if (values.back() < values[static_cast<std::size_t>(best)]) best = k;
  }
  Real low = step * (best - 1), high = step * (best + 1);
  if (!(f(low).slope < 0 && f(high).slope > 0)) throw std::runtime_error("nothing on a turn is nearest");
  for (int k = 0; k < 70; ++k) {
    const Real middle = (low + high) / 2;
    (f(middle).slope < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

Vec nearest_on(const Circle& circle, const DistanceOf& distance) {
  return circle.at(least_on_turn([&](Real u) {
    const Distance d = distance(circle.at(u));
    return OnTurn{d.value, dot(d.gradient, circle.slope(u))};
  }));
}

}  // namespace dynalin::oracle
