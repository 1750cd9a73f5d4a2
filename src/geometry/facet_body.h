// A closed surface of triangles as something to touch: which of its places is nearest to a point, and whether that is
// inside. Triangles near a point are found in a tree of boxes (Eigen's KdBVH).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/vec3.h"
#include "geometry/mesh.h"

namespace dynalin {

class FacetBody {
 public:
  // Of a mesh whose faces bound a volume and look outwards (mesh.h: close). Quadrilaterals are halved.
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
    bool outside = true;   // of the body, the point that it is nearest to
    bool definite = true;  // no other place is as near
    Vector point;
    Feature feature;
  };

  Place nearest(const Vector& p) const;
  // The nearest place of each piece of surface within `radius` of p that looks towards it, or away from it if the body
  // is a cavity. Pieces that meet within the radius are one. The nearest comes first.
  void nearest_of_pieces(const Vector& p, double radius, bool cavity, std::vector<Place>&) const;

  // Vertices that are alone the farthest of their neighbourhood in some direction.
  const std::vector<Vector>& corners() const { return corners_; }
  Vector centre() const { return centre_; }
  double radius() const { return radius_; }  // about the centre, of all of it

 private:
  using Index = Mesh::Index;
  struct Near;  // the nearest place of one triangle
  struct Tree;

  Near nearest_of(Index triangle, const Vector& p) const;
  bool is_outside(const Near&, const Vector& p) const;
  Feature feature_of(const Near&) const;
  bool same_place(const Near&, const Near&) const;
  void find_within(const Vector& p, double radius, std::vector<Near>&) const;
  Place place_of(const Near&, const Vector& p) const;
  void find_neighbours();
  void classify_vertices();

  struct Triangle {
    std::array<Index, 3> corner;
    std::array<Index, 3> across;  // the triangle at the edge from this corner to the next one
    Vector normal;                // unit vector, outwards
  };
  // What a vertex or an edge belongs to.
  struct VertexFeature {
    Feature feature;
    Vector outward;  // sum of the normals of its triangles, each by its angle there
  };
  std::vector<Vector> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<VertexFeature> vertex_features_;
  std::vector<Vector> corners_;
  Vector centre_;
  double radius_ = 0;
  std::unique_ptr<Tree> tree_;
};

}  // namespace dynalin
