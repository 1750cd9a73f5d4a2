// A convex body of flat faces: corners, edges and faces, and what lies next to what. Contacts of two of them
// (convex_touch.h) go from face to face and from corner to corner, and look at few.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "geometry/facet_planes.h"

namespace dynalin {

class ConvexBody {
 public:
  using Index = std::uint32_t;

  // All corners of a face lie in its plane, counter-clockwise as seen from outside. Its side n leads from corner n to
  // the next one.
  struct Face {
    Vector normal;
    double height = 0;                   // along the normal, from the origin
    std::vector<Index> corners, across;  // across: the face beyond each side
    Index before = 0;                    // a neighbour that comes earlier in the list, 0 of the first one
  };
  // Between two faces, one to its left and one to its right as seen from outside.
  struct Edge {
    Index from = 0, to = 0, left = 0, right = 0;
    Vector along;                  // unit vector
    Vector into_left, into_right;  // unit vectors from it into both faces, across it
    double length = 0;
  };

  // Of triangles that bound a volume, by what is across each of their sides; null where that is not convex. Neighbours
  // whose normals differ by less than 1e-6 are one face. Where two are hollow by less than a millionth of the size, as
  // roundings leave them, they are divided the other way.
  static std::shared_ptr<const ConvexBody> of(std::span<const Vector> vertices, std::size_t count,
                                              const std::function<FacetOfPlane(std::size_t)>&);
  static ConvexBody box(const Vector& low, const Vector& high);

  const std::vector<Vector>& corners() const { return corners_; }
  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<Edge>& edges() const { return edges_; }
  const std::vector<Index>& faces_at(Index corner) const { return at_[corner].faces; }
  const std::vector<Index>& edges_at(Index corner) const { return at_[corner].edges; }
  double size() const { return size_; }
  // A ball about its middle that the body holds.
  const Vector& middle() const { return middle_; }
  double depth() const { return depth_; }

  // The corner that is farthest in a direction: from `start` on, each next one is a neighbour that is farther.
  Index farthest(const Vector& direction, Index start) const;

 private:
  struct AtCorner {
    std::vector<Index> neighbours, faces, edges;
  };

  ConvexBody(std::vector<Vector> corners, std::vector<Face> faces);
  bool bulges() const;

  std::vector<Vector> corners_;
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  std::vector<AtCorner> at_;
  double size_ = 0, depth_ = 0;
  Vector middle_;
};

}  // namespace dynalin
