// Where two solids meet.
#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>

#include "solids.h"

namespace dynalin::oracle {

namespace {

// The directions of an ellipsoid and another solid. With less of it by some thickness everywhere, no more than its
// least radius of curvature, an ellipsoid is convex still and no longer overlaps; then the largest separation is
// the distance of both, which has one minimum and a direction without doubt: from the nearest point of the other one.
struct Thinned {
  const Solid& ellipsoid;
  const MarkerPose& pose;
  DistanceOf other;
  Real thickness;

  [[nodiscard]] Vec nearest(const Vec& n) const { return support(ellipsoid, pose, -n) + thickness * normalized(n); }
  [[nodiscard]] Real distance(const Vec& n) const { return other(nearest(n)).value; }
  // n less the direction that its own nearest point has from the other solid.
  [[nodiscard]] Vec error(const Vec& n) const { return n - other(nearest(n)).gradient; }

  // Among directions all around, then ever closer about the best.
  [[nodiscard]] Vec searched() const {
    Vec best{0, 0, 1};
    Real least = distance(best);
    const auto offer = [&](const Vec& n) {
      const Real d = distance(n);
      if (d >= least) return false;
      least = d, best = n;
      return true;
    };
    constexpr int samples = 600;
    for (int k = 0; k < samples; ++k) {
      const Real z = (2 * k + 1.0L) / samples - 1, turn = k * std::numbers::pi_v<Real> * (3 - std::sqrt(5.0L));
      const Real r = std::sqrt(1 - z * z);
      (void)offer({r * std::cos(turn), r * std::sin(turn), z});
    }
    for (Real size = 0.1L; size > 1e-5L;) {
      const Vec aside = std::fabs(best.x) < 0.6L ? Vec{1, 0, 0} : Vec{0, 1, 0};
      const Vec e = normalized(cross(best, aside)), f = cross(best, e), centre = best;
      bool better = false;
      for (int k = 0; k < 8; ++k) {
        const Real angle = k * std::numbers::pi_v<Real> / 4;
        better = offer(normalized(centre + size * (std::cos(angle) * e + std::sin(angle) * f))) || better;
      }
      if (!better) size /= 2;
    }
    return best;
  }

  [[nodiscard]] Vec direction() const {
    Vec n = searched();
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Vec error_here = error(n);
      if (norm(error_here) < 1e-18L) break;
      constexpr Real h = 1e-7L;
      const auto column = [&](const Vec& e) { return (1 / (2 * h)) * (error(n + h * e) - error(n - h * e)); };
      const Mat slopes{{column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})}};
      const Vec step = solve3(slopes, error_here);
      n = n - step;
      if (iteration > 2 && norm(step) < 1e-18L) break;
    }
    if (!(norm(error(n)) < 1e-15L)) throw std::runtime_error("a direction of separation is lost");
    return n;
  }
};

TouchPlace ellipsoid_with(const Solid& ellipsoid, const MarkerPose& pose, const DistanceOf& other) {
  const auto [least, most] = std::minmax_element(ellipsoid.size.begin(), ellipsoid.size.end());
  const Thinned thinned{ellipsoid, pose, other, static_cast<Real>(*least) * *least / *most / 4};
  const Vec x = thinned.nearest(thinned.direction());
  const Distance d = other(x);
  if (!(d.value > 0)) throw std::runtime_error("an ellipsoid is too deep in a solid");
  return place_of(x, thinned.thickness, d);
}

// The deepest of an ellipsoid through the mantle of a frustum: each line of it has a plane that touches it there, of
// those the one which the ellipsoid is farthest beyond.
TouchPlace ellipsoid_with_mantle(const Solid& ellipsoid, const MarkerPose& pose, const Solid& frustum,
                                 const MarkerPose& of_frustum, const DistanceOf& wall) {
  const Circle bottom = rims(frustum, of_frustum)[frustum.size[1] > 0 ? 0 : 1];
  const auto inwards = [&](Real u) { return wall(bottom.at(u)).gradient; };
  const Real u = least_on_turn([&](Real angle) {
    const Vec n = inwards(angle), on_line = bottom.at(angle), x = support(ellipsoid, pose, -n);
    return OnTurn{dot(n, x - on_line), dot(cross(of_frustum.R.column[2], n), x - on_line)};
  });
  const Vec n = inwards(u), x = support(ellipsoid, pose, -n);
  return place_of(x, 0, {dot(n, x - bottom.at(u)), n});
}

TouchPlace reversed(const TouchPlace& p) { return {-p.normal, p.point, p.gap}; }

}  // namespace

TouchPlace place_between(const Solid& a, const MarkerPose& A, const Solid& b, const MarkerPose& B) {
  const DistanceOf from_b = distance_from(b, B);
  if (a.shape == SolidShape::ellipsoid) return ellipsoid_with(a, A, from_b);
  const Vec centre = nearest_on(centre_circle(a, A), from_b);
  return place_of(centre, a.size[1], from_b(centre));
}

std::vector<TouchPlace> places_in_cavity(const Solid& inside, const MarkerPose& pose, const Solid& cavity,
                                         const MarkerPose& of_cavity) {
  std::vector<TouchPlace> places;
  const std::vector<DistanceOf> walls = walls_of(cavity, of_cavity);
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const DistanceOf& wall = walls[k];
    const auto add = [&](const Vec& centre, Real radius) { places.push_back(place_of(centre, radius, wall(centre))); };
    switch (inside.shape) {
      case SolidShape::box:
      case SolidShape::wedge:
        for (const Vec& corner : corners(inside, pose)) add(corner, 0);
        break;
      case SolidShape::frustum:
        for (const Circle& rim : rims(inside, pose)) add(nearest_on(rim, wall), 0);
        break;
      case SolidShape::torus:
        add(nearest_on(centre_circle(inside, pose), wall), inside.size[1]);
        break;
      case SolidShape::ellipsoid:
        if (cavity.shape == SolidShape::frustum && k == 1) {
          places.push_back(ellipsoid_with_mantle(inside, pose, cavity, of_cavity, wall));
        } else if (cavity.shape != SolidShape::ellipsoid) {
          add(support(inside, pose, -wall(pose.p).gradient), 0);
        } else {
          throw std::logic_error("an ellipsoid in an ellipsoid has no definite places");
        }
        break;
    }
  }
  return places;
}

std::vector<TouchPlace> places_of_solids(const Touch& t, const MarkerPose& I, const MarkerPose& J) {
  std::vector<TouchPlace> places;
  if (t.cavity == Cavity::j) return places_in_cavity(t.solid_i, I, t.solid_j, J);
  if (t.cavity == Cavity::i) {
    places = places_in_cavity(t.solid_j, J, t.solid_i, I);
    for (TouchPlace& p : places) p = reversed(p);
    return places;
  }
  const auto rank = [](const Solid& s) {
    return s.shape == SolidShape::torus ? 2 : s.shape == SolidShape::ellipsoid ? 1 : 0;
  };
  if (rank(t.solid_i) >= rank(t.solid_j)) return {place_between(t.solid_i, I, t.solid_j, J)};
  return {reversed(place_between(t.solid_j, J, t.solid_i, I))};
}

}  // namespace dynalin::oracle
