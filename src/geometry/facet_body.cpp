#include "geometry/facet_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "geometry/convex_body.h"
#include "geometry/facet_planes.h"
#include "geometry/facet_tree.h"

namespace dynalin {

namespace {

constexpr double coplanar = 1e-6;      // sine of an angle between faces that are one: files hold single precision
constexpr double pointed = 1e-5;       // sine by which all edges of a corner turn away from a plane through it
constexpr double equally_near = 1e-9;  // of the size: places that are as near
constexpr double one_place = 1e-7;     // of the size: places that are not told apart

// Some direction that all of `edges`, unit vectors out of a vertex, turn away from: one exists where planes through
// pairs of them hold all others on one side, and the sum of the normals of all such planes is inside of what they
// bound.
bool is_pointed(const std::vector<Vector>& edges, const Vector& outward) {
  const auto turns_away = [&](const Vector& e) {
    return std::ranges::all_of(edges, [&](const Vector& u) { return dot(e, u) < -pointed; });
  };
  if (turns_away(normalized(outward))) return true;
  if (turns_away(-normalized(outward))) return false;  // the bottom of a pit
  Vector sum{};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Vector n = cross(edges[i], edges[k]);
      if (i == k || norm(n) <= coplanar) continue;
      const Vector e = normalized(n);
      if (std::ranges::all_of(edges, [&](const Vector& u) { return dot(e, u) <= coplanar; })) sum += e;
    }
  }
  return norm(sum) > pointed && turns_away(normalized(sum)) && dot(sum, outward) > 0;
}

}  // namespace

FacetBody::~FacetBody() = default;

FacetBody::FacetBody(const Mesh& mesh) : vertices_(mesh.vertices) {
  const auto add = [&](Index a, Index b, Index c) {
    triangles_.push_back({{a, b, c}, {}, normalized(cross(vertices_[b] - vertices_[a], vertices_[c] - vertices_[a]))});
  };
  for (const auto& t : mesh.triangles) add(t[0], t[1], t[2]);
  for (const auto& q : mesh.quads) add(q[0], q[1], q[2]), add(q[0], q[2], q[3]);

  BoundingBox all;
  for (const Vector& v : vertices_) all.extend(to_eigen(v));
  const Eigen::Vector3d middle = all.center();
  centre_ = {middle.x(), middle.y(), middle.z()};
  for (const Vector& v : vertices_) radius_ = std::max(radius_, norm(v - centre_));

  find_neighbours();
  find_lumps();
  flatten();
  find_fans();
  classify_vertices();
  convex_ = ConvexBody::of(vertices_, triangles_.size(), [&](std::size_t t) {
    const Triangle& f = triangles_[t];
    return FacetOfPlane{f.corner, f.across, f.normal};
  });
  tree_ = std::make_unique<Tree>();
  for (const Triangle& t : triangles_) {
    BoundingBox box;
    for (const Index v : t.corner) box.extend(to_eigen(vertices_[v]));
    tree_->boxes.push_back(box);
  }
  tree_->items.resize(triangles_.size());
  std::iota(tree_->items.begin(), tree_->items.end(), 0);
  tree_->hierarchy.init(tree_->items.begin(), tree_->items.end(), tree_->boxes.begin(), tree_->boxes.end());
}

void FacetBody::find_neighbours() {
  const auto key = [](Index from, Index to) { return (std::uint64_t{from} << 32) | to; };
  std::unordered_map<std::uint64_t, Index> by_side;
  for (Index t = 0; t < triangles_.size(); ++t) {
    for (std::size_t n = 0; n < 3; ++n)
      by_side.emplace(key(triangles_[t].corner[n], triangles_[t].corner[(n + 1) % 3]), t);
  }
  for (Triangle& t : triangles_) {
    for (std::size_t n = 0; n < 3; ++n) t.across[n] = by_side.at(key(t.corner[(n + 1) % 3], t.corner[n]));
  }
}

void FacetBody::find_lumps() {
  constexpr Index none = std::numeric_limits<Index>::max();
  lump_of_.assign(triangles_.size(), none);
  Index lumps = 0;
  std::vector<Index> next;
  for (Index first = 0; first < triangles_.size(); ++first) {
    if (lump_of_[first] != none) continue;
    lump_of_[first] = lumps, next.push_back(first);
    while (!next.empty()) {
      const Index t = next.back();
      next.pop_back();
      for (const Index beside : triangles_[t].across) {
        if (lump_of_[beside] == none) lump_of_[beside] = lumps, next.push_back(beside);
      }
    }
    ++lumps;
  }
}

void FacetBody::flatten() {
  const std::vector<FacetPlane> planes = facet_planes(vertices_, radius_, triangles_.size(), [&](std::size_t t) {
    const Triangle& f = triangles_[t];
    return FacetOfPlane{f.corner, f.across, f.normal};
  });
  put_into_planes(vertices_, radius_, planes);
  for (Triangle& t : triangles_) {
    const Vector area =
        cross(vertices_[t.corner[1]] - vertices_[t.corner[0]], vertices_[t.corner[2]] - vertices_[t.corner[0]]);
    if (norm(area) > 0) t.normal = normalized(area);
  }
  for (const FacetPlane& plane : planes) {
    for (const Index t : plane.facets) triangles_[t].normal = plane.normal;
  }
}

void FacetBody::find_fans() {
  constexpr Index none = std::numeric_limits<Index>::max();
  fan_of_.assign(triangles_.size(), {none, none, none});
  const auto corner_at = [&](Index t, Index v) {
    const auto& c = triangles_[t].corner;
    return static_cast<std::size_t>(std::ranges::find(c, v) - c.begin());
  };
  for (Index first = 0; first < triangles_.size(); ++first) {
    for (std::size_t n = 0; n < 3; ++n) {
      if (fan_of_[first][n] != none) continue;
      const Index v = triangles_[first].corner[n];
      Fan fan{v, {}, {}};
      // Over the edge that leads to the vertex comes the next triangle around it.
      for (Index t = first; fan_of_[t][corner_at(t, v)] == none; t = triangles_[t].across[(corner_at(t, v) + 2) % 3]) {
        const std::size_t at = corner_at(t, v);
        fan_of_[t][at] = static_cast<Index>(fans_.size());
        fan.triangles.push_back(t);
        fan.edges.push_back(normalized(vertices_[triangles_[t].corner[(at + 1) % 3]] - vertices_[v]));
      }
      fans_.push_back(std::move(fan));
    }
  }
}

void FacetBody::classify_vertices() {
  struct Ring {
    std::vector<Vector> edges, normals;  // that differ
    std::vector<Vector> creases;         // edges between faces that differ
    Vector outward{};
  };
  std::vector<Ring> rings(vertices_.size());
  for (const Triangle& t : triangles_) {
    for (std::size_t n = 0; n < 3; ++n) {
      Ring& ring = rings[t.corner[n]];
      const Vector& at = vertices_[t.corner[n]];
      const Vector out = normalized(vertices_[t.corner[(n + 1) % 3]] - at),
                   in = normalized(vertices_[t.corner[(n + 2) % 3]] - at);
      ring.outward += t.normal * std::atan2(norm(cross(out, in)), dot(out, in));
      ring.edges.push_back(out);  // the other one is that of a neighbour
      if (norm(t.normal - triangles_[t.across[n]].normal) > coplanar) ring.creases.push_back(out);
      if (std::ranges::none_of(ring.normals, [&](const Vector& m) { return norm(t.normal - m) <= coplanar; }))
        ring.normals.push_back(t.normal);
    }
  }
  vertex_features_.resize(vertices_.size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const Ring& ring = rings[v];
    if (ring.edges.empty()) continue;
    VertexFeature& f = vertex_features_[v];
    f.outward = ring.outward;
    f.feature = {Feature::Kind::vertex, vertices_[v], {}};
    if (ring.creases.empty()) {
      f.feature = {Feature::Kind::face, vertices_[v], ring.normals.front()};
    } else if (ring.creases.size() == 2 && norm(ring.creases[0] + ring.creases[1]) <= coplanar) {
      f.feature = {Feature::Kind::edge, vertices_[v], ring.creases.front()};
    } else if (is_pointed(ring.edges, ring.outward)) {
      corners_.push_back(vertices_[v]);
    }
  }
}

FacetBody::Near FacetBody::nearest_of(Index triangle, const Vector& p) const {
  const Triangle& t = triangles_[triangle];
  Near found{triangle, 6, {}, 0};
  const auto at = [&](std::size_t n) -> const Vector& { return vertices_[t.corner[n % 3]]; };
  const double height = dot(t.normal, p - at(0));
  const Vector foot = p - t.normal * height;
  bool within = true;
  for (std::size_t n = 0; n < 3; ++n) within = within && dot(t.normal, cross(at(n + 1) - at(n), foot - at(n))) >= 0;
  if (within) {
    found.point = foot, found.distance = std::abs(height);
    return found;
  }
  found.distance = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < 3; ++n) {
    const Vector side = at(n + 1) - at(n);
    const double s = dot(p - at(n), side) / dot(side, side);
    const auto end = static_cast<int>(s <= 0 ? n : s >= 1 ? (n + 1) % 3 : n + 3);
    const Vector q = end >= 3 ? at(n) + side * s : at(static_cast<std::size_t>(end));
    if (const double d = norm(p - q); d < found.distance) found.part = end, found.point = q, found.distance = d;
  }
  return found;
}

bool FacetBody::is_outside(const Near& n, const Vector& p) const {
  const Triangle& t = triangles_[n.triangle];
  const auto part = static_cast<std::size_t>(n.part);
  const Vector outward = part == 6  ? t.normal
                         : part < 3 ? vertex_features_[t.corner[part]].outward
                                    : t.normal + triangles_[t.across[part - 3]].normal;
  return dot(p - n.point, outward) >= 0;
}

FacetBody::Feature FacetBody::feature_of(const Near& n) const {
  const Triangle& t = triangles_[n.triangle];
  const auto part = static_cast<std::size_t>(n.part);
  if (part < 3) return vertex_features_[t.corner[part]].feature;
  const bool flat = part == 6 || norm(t.normal - triangles_[t.across[part - 3]].normal) <= coplanar;
  if (flat) return {Feature::Kind::face, vertices_[t.corner[0]], t.normal};
  const Vector &from = vertices_[t.corner[part - 3]], &to = vertices_[t.corner[(part - 2) % 3]];
  return {Feature::Kind::edge, from, normalized(to - from)};
}

// On one face, or on two that do not stand in, distances grow at least as the places move apart: h² + s².
bool FacetBody::same_place(const Near& a, const Near& b) const {
  const double apart = norm(a.point - b.point), alike = one_place * radius_;
  return apart * apart <= 4 * std::abs(a.distance * a.distance - b.distance * b.distance) + alike * alike;
}

FacetBody::Place FacetBody::place_of(const Near& n, const Vector& p) const {
  return {n.distance, 1, is_outside(n, p), true, n.point, feature_of(n)};
}

namespace {

// What Eigen asks for the search of all items whose box a ball meets.
template <class Take>
struct WithinBall {
  Eigen::Vector3d centre;
  double square;
  Take take;

  bool intersectVolume(const BoundingBox& box) const { return box.squaredExteriorDistance(centre) <= square; }
  bool intersectObject(int item) const {
    take(item);
    return false;  // go on
  }
};

// And for that of the nearest one.
template <class Look>
struct LeastDistance {
  using Scalar = double;
  Eigen::Vector3d centre;
  Look look;

  double minimumOnVolume(const BoundingBox& box) const { return box.squaredExteriorDistance(centre); }
  double minimumOnObject(int item) const { return look(item); }
};

}  // namespace

void FacetBody::find_within(const Vector& p, double radius, std::vector<Near>& found) const {
  const auto take = [&](int item) {
    const Near near = nearest_of(static_cast<Index>(item), p);
    if (near.distance <= radius) found.push_back(near);
  };
  WithinBall<decltype(take)> ball{to_eigen(p), radius * radius, take};
  Eigen::BVIntersect(tree_->hierarchy, ball);
}

FacetBody::Place FacetBody::nearest(const Vector& p) const {
  Near best;
  const auto look = [&](int item) {
    const Near near = nearest_of(static_cast<Index>(item), p);
    if (near.distance < best.distance) best = near;
    return near.distance * near.distance;
  };
  LeastDistance<decltype(look)> least{to_eigen(p), look};
  Eigen::BVMinimize(tree_->hierarchy, least);
  Place place = place_of(best, p);
  std::vector<Near> as_near;
  find_within(p, best.distance + equally_near * radius_, as_near);
  place.definite = std::ranges::all_of(as_near, [&](const Near& n) { return same_place(n, best); });
  return place;
}

}  // namespace dynalin
