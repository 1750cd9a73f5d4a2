// A closed surface of triangles as something to touch: which of its places is nearest to a point, whether that is
// inside, and where about it the distance is critical. Triangles near a point are found in a tree of boxes (Eigen's
// KdBVH).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "geometry/mesh.h"

namespace dynalin {

class ConvexBody;

class FacetBody {
 public:
  using Index = Mesh::Index;
  struct Triangle {
    std::array<Index, 3> corner;  // counter-clockwise as seen from outside
    std::array<Index, 3> across;  // the triangle at the edge from this corner to the next one
    Vector normal;                // unit vector, outwards
  };
  struct Tree;  // of boxes about all triangles (facet_tree.h)

  // Of a mesh whose faces bound a volume and look outwards (mesh.h: close). Quadrilaterals are halved. Facets that are
  // of one plane but for the roundings of single precision, which files have, become so (facet_planes.h).
  explicit FacetBody(const Mesh&);
  ~FacetBody();

  // What of the surface is nearest: the plane of a face, the line of an edge, a vertex. Edges between faces of one
  // plane, and vertices on straight edges or among such faces, count as the face or edge they lie in.
  struct Feature {
    enum class Kind : std::uint8_t { face, edge, vertex } kind = Kind::face;
    Vector origin, direction;  // a place on it; of a face its normal, of an edge a unit vector along it
  };
  struct Place {
    double distance = 0;
    double weight = 1;
    bool outside = true;   // of the body, the point that it is nearest to
    bool definite = true;  // no other place is as near
    Vector point;
    Feature feature;
  };

  Place nearest(const Vector& p) const;
  // Places within `radius` of p where its distance from the surface is critical, on the side of p, or of the body if
  // that is a cavity: least in a face or on an edge or vertex that stands out with the weight 1, most across an edge
  // that stands in with the weight −1, and at vertices 1 less the number of sectors in which the distance falls
  // (Banchoff's index of critical points). So a place that is born where two facets meet is born together with its
  // opposite, and any function of the distance, summed up over all places by weight, goes on smoothly. The nearest
  // comes first.
  void critical_places(const Vector& p, double radius, bool cavity, std::vector<Place>&) const;

  // Vertices that are alone the farthest of their neighbourhood in some direction.
  const std::vector<Vector>& corners() const { return corners_; }
  // The same body as faces and edges, null where it is not convex.
  const ConvexBody* convex() const { return convex_.get(); }
  Vector centre() const { return centre_; }
  double radius() const { return radius_; }  // about the centre, of all of it

  const std::vector<Vector>& vertices() const { return vertices_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  // All about a corner of a triangle, one after the other.
  std::span<const Index> around(Index triangle, std::size_t corner) const {
    return fans_[fan_of_[triangle][corner]].triangles;
  }
  // Parts of the surface that hang together: of each triangle its number, from 0 on without gaps.
  const std::vector<Index>& lump_of() const { return lump_of_; }
  const Tree& tree() const { return *tree_; }

 private:
  // The nearest place of one triangle.
  struct Near {
    Index triangle = 0;
    // 0 to 2: the corner; 3 to 5: the edge from corner n − 3 to the next one; 6: between them.
    int part = 6;
    Vector point;
    double distance = std::numeric_limits<double>::infinity();
  };

  Near nearest_of(Index triangle, const Vector& p) const;
  bool is_outside(const Near&, const Vector& p) const;
  Feature feature_of(const Near&) const;
  bool same_place(const Near&, const Near&) const;
  void find_within(const Vector& p, double radius, std::vector<Near>&) const;
  Place place_of(const Near&, const Vector& p) const;
  void find_neighbours();
  void find_lumps();
  void flatten();
  void find_fans();
  void classify_vertices();

  // What a vertex or an edge belongs to.
  struct VertexFeature {
    Feature feature;
    Vector outward;  // sum of the normals of its triangles, each by its angle there
  };
  // Triangles around a vertex one after the other; where lumps share a vertex it has several.
  struct Fan {
    Index vertex;
    std::vector<Index> triangles;
    std::vector<Vector> edges;  // unit vectors from the vertex, the one on which the triangle of the same number begins
  };
  class Critical;  // places about one point

  std::vector<Vector> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Index> lump_of_;
  std::vector<Fan> fans_;
  std::vector<std::array<Index, 3>> fan_of_;  // of each corner of each triangle
  std::vector<VertexFeature> vertex_features_;
  std::vector<Vector> corners_;
  Vector centre_;
  double radius_ = 0;
  std::unique_ptr<Tree> tree_;
  std::shared_ptr<const ConvexBody> convex_;
};

}  // namespace dynalin
