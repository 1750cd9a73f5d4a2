// Where the surfaces of two bodies of facets cross, and what the crossings bound: straight pieces around the part of
// each facet that is in the other body, and which of them bound one volume that both have in common.
#pragma once

#include <array>
#include <limits>
#include <unordered_set>
#include <utility>
#include <vector>

#include "geometry/facet_body.h"
#include "mechanics/path.h"

namespace dynalin {

// By its corners, the same for all who ask.
struct PlaneOfTriangle {
  Vector origin, across;
  int outwards;

  // 1 where a point is in front of it, −1 behind it.
  int side(const Vector& p) const { return dot(across, p - origin) > 0 ? outwards : -outwards; }
};

// One of the bodies in the axes of J, perhaps with the inside out.
class PlacedSurface {
 public:
  PlacedSurface(const FacetBody& body, const RelativeFrame<double>& frame, bool turned_over)
      : body_(body), frame_(frame), turned_over_(turned_over) {}

  const FacetBody& body() const { return body_; }
  Vector at(FacetBody::Index v) const {
    const Vector& b = body_.vertices()[v];
    return frame_.p + frame_.x * b.x + frame_.y * b.y + frame_.z * b.z;
  }
  Vector normal(FacetBody::Index t) const {
    const Vector& n = body_.triangles()[t].normal;
    const Vector out = frame_.x * n.x + frame_.y * n.y + frame_.z * n.z;
    return turned_over_ ? -out : out;
  }
  // Corners counter-clockwise as seen from outside of what is full; side n leads from corner n to the next one.
  FacetBody::Index corner(FacetBody::Index t, std::size_t n) const {
    return body_.triangles()[t].corner[turned_over_ ? (3 - n) % 3 : n % 3];
  }
  FacetBody::Index across(FacetBody::Index t, std::size_t side) const {
    return body_.triangles()[t].across[turned_over_ ? 2 - side : side];
  }
  std::size_t side_from(FacetBody::Index t, FacetBody::Index v) const {
    return corner(t, 0) == v ? 0 : corner(t, 1) == v ? 1 : 2;
  }
  // The same edge as a side of the triangle across it.
  std::size_t side_across(FacetBody::Index t, std::size_t side) const {
    return side_from(across(t, side), corner(t, side + 1));
  }
  bool owns(FacetBody::Index t, std::size_t side) const { return t < across(t, side); }

  PlaneOfTriangle plane(FacetBody::Index t) const {
    const auto& c = body_.triangles()[t].corner;
    const Vector o = at(c[0]);
    return {o, cross(at(c[1]) - o, at(c[2]) - o), turned_over_ ? -1 : 1};
  }
  double height(FacetBody::Index t, const Vector& p) const { return dot(normal(t), p - at(corner(t, 0))); }

 private:
  const FacetBody& body_;
  RelativeFrame<double> frame_;
  bool turned_over_;
};

// A straight piece of what bounds the part of a triangle that is in the other body, which is to its left.
struct SurfacePiece {
  static constexpr FacetBody::Index none = std::numeric_limits<FacetBody::Index>::max();

  std::size_t volume;  // to which it belongs
  bool of_I;
  FacetBody::Index triangle;
  Vector from, to;
  FacetBody::Index other = none;  // the triangle that cuts here, none on an edge of its own
};

struct SurfaceArrangement {
  std::vector<SurfacePiece> pieces;  // ordered by volume, body and triangle
  bool consistent = true;            // each cut has two ends, and each edge goes in and out by turns
  std::array<std::unordered_set<FacetBody::Index>, 2> lumps;  // of J and of I, that cross something
};
// Of triangles of I and of J that may meet.
SurfaceArrangement arrangement(const PlacedSurface& I, const PlacedSurface& J,
                               const std::vector<std::pair<FacetBody::Index, FacetBody::Index>>&);

}  // namespace dynalin
