// The directions in which a frustum may part soonest from a convex body of flat faces: those of frustum_parting.h, each
// where it is normal to the body at the face, edge or corner that it belongs to. Faces and ends say how soon both part
// at most, and one point of the frustum, that which is nearest to a face, how soon they can across an edge of it.
#pragma once

#include "geometry/ellipsoid_separation.h"
#include "geometry/flat_body.h"

namespace dynalin::solid {

class FlatParting {
 public:
  FlatParting(const PlacedFrustum<double>& I, const FlatBody& J)
      : I_(I), J_(J), tolerance_(coincidence * std::min(I.size(), J.size())) {
    using Of = PartingDirection::Of;
    const ConvexBody& body = J.body;
    const std::size_t faces = body.faces().size();
    std::vector<Vector> nearest(faces);
    std::vector<double> across(faces);
    for (std::size_t k = 0; k < faces; ++k) {
      const ConvexBody::Face& face = body.faces()[k];
      nearest[k] = farthest(I, -face.normal), across[k] = dot(face.normal, nearest[k]) - face.height;
    }
    double most = *std::ranges::max_element(across);
    for_each_normal(I, [&](const Vector& n) { most = std::max(most, separation(-n)); });
    least_ = (most < 0 ? 2 : 1) * most - tolerance_;
    for (std::size_t k = 0; k < faces; ++k)
      if (across[k] >= least_) found_.add({body.faces()[k].normal, across[k], Of::face, k});
    for_each_normal(I, [&](const Vector& n) { add(-n, Of::face, faces); });

    const Ruled<double> mantle = I.mantle();
    for (const ConvexBody::Index k : candidates(nearest)) {
      const ConvexBody::Edge& e = body.edges()[k];
      if (const auto both =
              common_normals(mantle, ruled_of(edge_at<double>(body, e), Vector(body.faces()[e.left].normal)))) {
        for (const Vector& n : *both)
          if (is_normal_at(body, e, n, beside)) add(n, Of::lines, k);
      }
      search_edge(k);
    }
    for (ConvexBody::Index c = 0; c < body.corners().size(); ++c) {
      const Vector from = body.corners()[c] - mantle.origin;
      const double x = dot(mantle.first, from), y = dot(mantle.second, from);
      const Vector n = -mantle.normal(std::atan2(y, x));
      if (is_normal_at(body, c, n, beside)) add(n, Of::ruled_I, 0, std::hypot(x, y) < tolerance_);
    }
    found_.sort(tolerance_);
  }
  std::span<const PartingDirection> all() const { return found_.all(); }
  // What is found is held against all directions.
  bool is_sound() const {
    return !some_direction_exceeds(found_.largest() + tolerance_, [&](const Vector& n) { return separation(n); });
  }

 private:
  static constexpr double beside = 1e-9;  // sine

  double separation(const Vector& n) const { return dot(n, farthest(I_, -n) - farthest(J_, n)); }
  void add(const Vector& n, PartingDirection::Of of, std::size_t which, bool level = false) {
    if (const double here = separation(n); here >= least_) found_.add({n, here, of, which, level});
  }
  // Edges across which both may part so soon.
  std::vector<ConvexBody::Index> candidates(const std::vector<Vector>& nearest) const {
    const ConvexBody& body = J_.body;
    std::vector<ConvexBody::Index> list;
    for (ConvexBody::Index k = 0; k < body.edges().size(); ++k) {
      const ConvexBody::Edge& e = body.edges()[k];
      const auto most = [&](ConvexBody::Index face) {
        return most_along(body, e, nearest[face] - body.corners()[e.from]);
      };
      if (most(e.left) >= least_ && most(e.right) >= least_) list.push_back(k);
    }
    return list;
  }
  // Each place between the normals of both faces where the separation is larger than beside it.
  void search_edge(ConvexBody::Index k) {
    constexpr int samples = 16;
    const ConvexBody::Edge& e = J_.body.edges()[k];
    const NormalsAtEdge normals(J_.body, e);
    const Vector& on_edge = J_.body.corners()[e.from];
    const auto slope = [&](double s) { return dot(normals.turned(s), farthest(I_, -normals.normal(s)) - on_edge); };
    double before = slope(0);
    for (int i = 1; i <= samples; ++i) {
      double from = normals.turn * (i - 1) / samples, to = normals.turn * i / samples;
      const double here = slope(to);
      if (before > 0 && here <= 0) {
        for (int step = 0; step < 60; ++step) {
          const double middle = 0.5 * (from + to);
          (slope(middle) > 0 ? from : to) = middle;
        }
        add(normals.normal(0.5 * (from + to)), PartingDirection::Of::ruled_J, k);
      }
      before = here;
    }
  }

  const PlacedFrustum<double>& I_;
  const FlatBody& J_;
  double tolerance_;
  double least_ = 0;  // twice as deep as the least known: what parts later is not looked at
  PartingDirections found_;
};

}  // namespace dynalin::solid
