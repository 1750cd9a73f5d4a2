// Where the distance of a point from a body of facets is critical.
#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "geometry/facet_body.h"

namespace dynalin {

namespace {

// Which faces, edges and vertices count is told for a point beside the one that is meant, so that it is never exactly
// above an edge: what counts there or not has the same distance from both.
const Vector off_symmetry{0.5412, -0.2987, 0.7861};
constexpr double shift = 1e-9;  // of the size

}  // namespace

class FacetBody::Critical {
 public:
  Critical(const FacetBody& of, const Vector& p, double radius, bool cavity, std::vector<Place>& places)
      : of_(of),
        p_(p),
        beside_(p + shift * of.radius_ * off_symmetry),
        radius_(radius),
        cavity_(cavity),
        places_(places) {}

  void face(Index t) {
    const Triangle& f = of_.triangles_[t];
    const double height = dot(f.normal, beside_ - of_.vertices_[f.corner[0]]);
    if ((height > 0) == cavity_) return;
    const Vector foot = beside_ - f.normal * height;
    for (std::size_t n = 0; n < 3; ++n) {
      const Vector &from = of_.vertices_[f.corner[n]], &to = of_.vertices_[f.corner[(n + 1) % 3]];
      if (!(dot(f.normal, cross(to - from, foot - from)) > 0)) return;
    }
    add(1, {Feature::Kind::face, of_.vertices_[f.corner[0]], f.normal});
  }

  // Of the triangle t, from corner n to the next one.
  void edge(Index t, std::size_t n) {
    const Triangle &A = of_.triangles_[t], &B = of_.triangles_[A.across[n]];
    const Vector &from = of_.vertices_[A.corner[n]], &to = of_.vertices_[A.corner[(n + 1) % 3]];
    const double length = norm(to - from), s = dot(beside_ - from, to - from) / (length * length);
    if (!(s > 0 && s < 1)) return;
    const Vector along = (to - from) / length, away = beside_ - from - along * (s * length);
    const Vector into_A = cross(A.normal, along), into_B = -cross(B.normal, along);
    const bool stands_out = (dot(A.normal, into_B) < 0) != cavity_;
    const double fall_A = dot(away, into_A), fall_B = dot(away, into_B);
    const Feature line{Feature::Kind::edge, from, along};
    if (stands_out && fall_A < 0 && fall_B < 0) add(1, line);
    if (!stands_out && fall_A > 0 && fall_B > 0) add(-1, line);
  }

  void vertex(const Fan& fan) {
    const Vector away = beside_ - of_.vertices_[fan.vertex];
    const std::size_t count = fan.edges.size();
    int sectors = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const bool falls = dot(away, fan.edges[k]) > 0, fell = dot(away, fan.edges[(k + count - 1) % count]) > 0;
      sectors += falls && !fell;
    }
    if (sectors == 1 || is_outside(fan, away) == cavity_) return;
    add(1 - sectors, {Feature::Kind::vertex, of_.vertices_[fan.vertex], {}});
  }

 private:
  // Whether a direction from a vertex leads out of the body: by the nearest place of the cone that its triangles span.
  bool is_outside(const Fan& fan, const Vector& away) const {
    double least = norm(away);
    double side = dot(away, of_.vertex_features_[fan.vertex].outward);
    for (std::size_t k = 0; k < fan.edges.size(); ++k) {
      const Vector &u = fan.edges[k], &v = fan.edges[(k + 1) % fan.edges.size()];
      const Vector &n = of_.triangles_[fan.triangles[k]].normal,
                   &before = of_.triangles_[fan.triangles[(k + fan.edges.size() - 1) % fan.edges.size()]].normal;
      const double height = dot(away, n);
      const Vector foot = away - n * height;
      if (dot(n, cross(u, foot)) >= 0 && dot(n, cross(foot, v)) >= 0 && std::abs(height) < least)
        least = std::abs(height), side = height;
      const double reach = dot(away, u), off = norm(away - u * reach);
      if (reach > 0 && off < least) least = off, side = dot(away, n + before);
    }
    return side >= 0;
  }

  void add(int weight, const Feature& feature) {
    Vector away = p_ - feature.origin;
    if (feature.kind == Feature::Kind::face) away = feature.direction * dot(away, feature.direction);
    if (feature.kind == Feature::Kind::edge) away = away - feature.direction * dot(away, feature.direction);
    const double distance = norm(away);
    if (distance < radius_)
      places_.push_back({distance, static_cast<double>(weight), !cavity_, true, p_ - away, feature});
  }

  const FacetBody& of_;
  const Vector p_, beside_;
  double radius_;
  bool cavity_;
  std::vector<Place>& places_;
};

void FacetBody::critical_places(const Vector& p, double radius, bool cavity, std::vector<Place>& places) const {
  places.clear();
  std::vector<Near> found;
  find_within(p, radius + 2 * shift * radius_, found);
  std::unordered_set<Index> within, seen;
  for (const Near& n : found) within.insert(n.triangle);
  Critical critical(*this, p, radius, cavity, places);
  for (const Near& near : found) {
    const Index t = near.triangle;
    critical.face(t);
    for (std::size_t n = 0; n < 3; ++n) {
      const Index other = triangles_[t].across[n];
      if (t < other || !within.contains(other)) critical.edge(t, n);
      if (seen.insert(fan_of_[t][n]).second) critical.vertex(fans_[fan_of_[t][n]]);
    }
  }
  std::ranges::stable_sort(places, {}, &Place::distance);
}

}  // namespace dynalin
