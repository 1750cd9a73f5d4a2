// Solids of a CONTACT as sets of points: how far a point is from one, and where two of them meet. Nothing but this
// follows the motion: rates of a gap are the velocities of the material there.
//
//     A torus meets another solid with that point of its centre circle which is nearest to it, a ball as thick as the
//     tube. An ellipsoid meets a box or a frustum along the direction of the largest separation. In a cavity every
//     place is a point of the body within, or such a ball, farthest out through one of the walls.
#pragma once

#include <functional>
#include <vector>

#include "mechanism.h"
#include "small_algebra.h"

namespace dynalin::oracle {

struct MarkerPose {
  Vec p;
  Mat R;
  [[nodiscard]] Vec at(const Vec& local) const { return p + R * local; }
  [[nodiscard]] Vec seen(const Vec& global) const { return transpose(R) * (global - p); }
};

// From a surface, negative beyond it in matter, and the unit vector along which it grows.
struct Distance {
  Real value = 0;
  Vec gradient;
};
using DistanceOf = std::function<Distance(const Vec&)>;  // of a point, global axes

// From a solid, negative inside.
[[nodiscard]] DistanceOf distance_from(const Solid& solid, const MarkerPose& pose);
// From the walls of a cavity, into it: planes of a box, unlimited; mantle, as a cone without end, and ends of a
// frustum; the surface of an ellipsoid.
[[nodiscard]] std::vector<DistanceOf> walls_of(const Solid& cavity, const MarkerPose& pose);

struct Circle {
  Vec centre, x, y;  // two of its radii, at right angles
  [[nodiscard]] Vec at(Real u) const { return centre + std::cos(u) * x + std::sin(u) * y; }
  [[nodiscard]] Vec slope(Real u) const { return std::cos(u) * y - std::sin(u) * x; }
};
[[nodiscard]] Circle centre_circle(const Solid& torus, const MarkerPose& pose);
[[nodiscard]] std::vector<Circle> rims(const Solid& frustum, const MarkerPose& pose);  // bottom, top
[[nodiscard]] std::vector<Vec> corners(const Solid& box_or_wedge, const MarkerPose& pose);
// The point of an ellipsoid farthest along a direction of any length.
[[nodiscard]] Vec support(const Solid& ellipsoid, const MarkerPose& pose, const Vec& along);

// A value and its derivative by an angle.
struct OnTurn {
  Real value = 0, slope = 0;
};
// Where on a turn the value is least. Throws std::runtime_error where that is nowhere.
[[nodiscard]] Real least_on_turn(const std::function<OnTurn(Real)>& f);
[[nodiscard]] Vec nearest_on(const Circle& circle, const DistanceOf& distance);

// Half-way between both surfaces, the normal out of the one body towards the other, the gap between them.
struct TouchPlace {
  Vec normal, point;
  Real gap = 0;
};
[[nodiscard]] inline TouchPlace place_of(const Vec& centre, Real radius, const Distance& from) {
  return {from.gradient, centre - ((radius + from.value) / 2) * from.gradient, from.value - radius};
}

// A torus with any solid, or an ellipsoid with a box, a frustum or a wedge; the normal out of b.
[[nodiscard]] TouchPlace place_between(const Solid& a, const MarkerPose& A, const Solid& b, const MarkerPose& B);
// Of what is inside with every wall, closed or not; normals into the cavity.
[[nodiscard]] std::vector<TouchPlace> places_in_cavity(const Solid& inside, const MarkerPose& pose, const Solid& cavity,
                                                       const MarkerPose& of_cavity);
// Normals from J to I.
[[nodiscard]] std::vector<TouchPlace> places_of_solids(const Touch& touch, const MarkerPose& I, const MarkerPose& J);

}  // namespace dynalin::oracle
