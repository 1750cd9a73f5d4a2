#include "geometry/convex_body.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <unordered_map>

namespace dynalin {

namespace {

using Index = ConvexBody::Index;

constexpr double one_face = 1e-6;  // of normals of neighbours
constexpr double hollow = 1e-6;    // of the size
constexpr Index unset = std::numeric_limits<Index>::max();

std::size_t side_from(const FacetOfPlane& f, Index corner) {
  return static_cast<std::size_t>(std::ranges::find(f.corner, corner) - f.corner.begin());
}

double size_of(std::span<const Vector> points) {
  Vector low = points.front(), high = low;
  for (const Vector& c : points) {
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], c[k]), high[k] = std::max(high[k], c[k]);
  }
  const Vector middle = (low + high) * 0.5;
  double radius = 0;
  for (const Vector& c : points) radius = std::max(radius, norm(c - middle));
  return 2 * radius;
}

// Divides four corners of two neighbours along their other diagonal wherever these are hollow. False where they are so
// by more than `deepest`.
bool bend_outwards(std::span<const Vector> at, std::vector<FacetOfPlane>& facets, double deepest) {
  std::vector<Index> next(facets.size());
  for (Index t = 0; t < facets.size(); ++t) next[t] = t;
  std::size_t left = 10 * facets.size();
  while (!next.empty()) {
    const Index t = next.back();
    next.pop_back();
    for (std::size_t n = 0; n < 3; ++n) {
      const FacetOfPlane A = facets[t];
      const Index u = A.across[n];
      const FacetOfPlane B = facets[u];
      if (norm(A.normal - B.normal) <= one_face) continue;
      const Index a = A.corner[n], b = A.corner[(n + 1) % 3], c = A.corner[(n + 2) % 3];
      const std::size_t m = side_from(B, b);
      const Index d = B.corner[(m + 2) % 3];
      const double height = dot(A.normal, at[d] - at[a]);
      if (height <= 0) continue;
      if (height > deepest || left-- == 0) return false;
      const Index beyond_bc = A.across[(n + 1) % 3], beyond_ad = B.across[(m + 1) % 3];
      const auto normal = [&](Index i, Index j, Index k) { return cross(at[j] - at[i], at[k] - at[i]); };
      const Vector of_t = normal(c, a, d), of_u = normal(d, b, c), before = A.normal + B.normal;
      if (!(dot(of_t, before) > 0) || !(dot(of_u, before) > 0)) return false;
      facets[t] = {{c, a, d}, {A.across[(n + 2) % 3], beyond_ad, u}, of_t / norm(of_t)};
      facets[u] = {{d, b, c}, {B.across[(m + 2) % 3], beyond_bc, t}, of_u / norm(of_u)};
      facets[beyond_ad].across[side_from(facets[beyond_ad], d)] = t;
      facets[beyond_bc].across[side_from(facets[beyond_bc], c)] = u;
      next.push_back(t), next.push_back(u);
      break;
    }
  }
  return true;
}

// Which face each facet belongs to.
struct FacesOfFacets {
  std::vector<Index> of;
  std::vector<Vector> normals;
};
FacesOfFacets faces_of_facets(const std::vector<FacetOfPlane>& facets) {
  FacesOfFacets faces{std::vector<Index>(facets.size(), unset), {}};
  std::vector<Index> next;
  for (Index first = 0; first < facets.size(); ++first) {
    if (faces.of[first] != unset) continue;
    const auto face = static_cast<Index>(faces.normals.size());
    faces.normals.push_back(facets[first].normal);
    faces.of[first] = face;
    next.assign(1, first);
    while (!next.empty()) {
      const FacetOfPlane& f = facets[next.back()];
      next.pop_back();
      for (const Index other : f.across) {
        if (faces.of[other] != unset || norm(facets[other].normal - f.normal) > one_face) continue;
        faces.of[other] = face;
        next.push_back(other);
      }
    }
  }
  return faces;
}

// A side of a facet on the outline of its face.
struct SideOfFace {
  Index from, to, across;
};

// The corners of a face one after the other, where the face beyond its outline changes; nothing where its outline is
// not one ring with three corners at least.
std::optional<ConvexBody::Face> ring_of(const std::vector<SideOfFace>& sides) {
  std::unordered_map<Index, const SideOfFace*> from;
  for (const SideOfFace& s : sides) {
    if (!from.emplace(s.from, &s).second) return std::nullopt;
  }
  std::vector<const SideOfFace*> chain;
  for (const SideOfFace* s = &sides.front(); chain.empty() || s != chain.front();) {
    chain.push_back(s);
    const auto next = from.find(s->to);
    if (next == from.end() || chain.size() > sides.size()) return std::nullopt;
    s = next->second;
  }
  if (chain.size() != sides.size()) return std::nullopt;
  ConvexBody::Face face;
  for (std::size_t n = 0; n < chain.size(); ++n) {
    if (chain[n]->across == chain[(n + chain.size() - 1) % chain.size()]->across) continue;
    face.corners.push_back(chain[n]->from), face.across.push_back(chain[n]->across);
  }
  if (face.corners.size() < 3) return std::nullopt;
  return face;
}

// Each face after one of its neighbours. False where they do not all hang together.
bool put_in_order(std::vector<ConvexBody::Face>& faces) {
  std::vector<Index> order{0}, place(faces.size(), unset), before{0};
  place[0] = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (const Index other : faces[order[k]].across) {
      if (place[other] != unset) continue;
      place[other] = static_cast<Index>(order.size());
      order.push_back(other), before.push_back(static_cast<Index>(k));
    }
  }
  if (order.size() != faces.size()) return false;
  std::vector<ConvexBody::Face> ordered;
  for (std::size_t k = 0; k < order.size(); ++k) {
    ordered.push_back(std::move(faces[order[k]]));
    ordered.back().before = before[k];
    for (Index& other : ordered.back().across) other = place[other];
  }
  faces = std::move(ordered);
  return true;
}

}  // namespace

ConvexBody::ConvexBody(std::vector<Vector> corners, std::vector<Face> faces)
    : corners_(std::move(corners)), faces_(std::move(faces)), at_(corners_.size()) {
  for (Index f = 0; f < faces_.size(); ++f) {
    Face& face = faces_[f];
    face.height = dot(face.normal, corners_[face.corners[0]]);
    for (std::size_t n = 0; n < face.corners.size(); ++n) {
      const Index from = face.corners[n], to = face.corners[(n + 1) % face.corners.size()];
      at_[from].faces.push_back(f), at_[from].neighbours.push_back(to);
      if (face.across[n] < f) continue;
      Edge e;
      e.from = from, e.to = to, e.left = f, e.right = face.across[n];
      const Vector way = corners_[to] - corners_[from];
      e.length = norm(way), e.along = way / e.length;
      e.into_left = cross(face.normal, e.along), e.into_right = cross(e.along, faces_[e.right].normal);
      for (const Index end : {from, to}) at_[end].edges.push_back(static_cast<Index>(edges_.size()));
      edges_.push_back(e);
    }
  }
  size_ = size_of(corners_);
  for (const Vector& c : corners_) middle_ += c / static_cast<double>(corners_.size());
  depth_ = size_;
  for (const Face& f : faces_) depth_ = std::min(depth_, f.height - dot(f.normal, middle_));
}

// A surface that is closed, of one piece, without holes through it and bent outwards at each edge is that of a convex
// body.
bool ConvexBody::bulges() const {
  if (corners_.size() + faces_.size() != edges_.size() + 2) return false;
  std::size_t sides = 0;
  for (const Face& f : faces_) sides += f.corners.size();
  if (sides != 2 * edges_.size()) return false;
  return std::ranges::all_of(edges_, [&](const Edge& e) {
    const std::vector<Index>& back = faces_[e.right].across;
    return dot(e.into_left, faces_[e.right].normal) < 0 && std::ranges::count(back, e.left) == 1 &&
           std::ranges::count(faces_[e.left].across, e.right) == 1;
  });
}

std::shared_ptr<const ConvexBody> ConvexBody::of(std::span<const Vector> vertices, std::size_t count,
                                                 const std::function<FacetOfPlane(std::size_t)>& facet) {
  std::vector<FacetOfPlane> facets;
  for (std::size_t t = 0; t < count; ++t) facets.push_back(facet(t));
  if (!bend_outwards(vertices, facets, hollow * size_of(vertices))) return nullptr;
  const FacesOfFacets flat = faces_of_facets(facets);
  std::vector<std::vector<SideOfFace>> sides(flat.normals.size());
  for (std::size_t t = 0; t < count; ++t) {
    const FacetOfPlane& f = facets[t];
    for (std::size_t n = 0; n < 3; ++n) {
      const Index across = flat.of[f.across[n]];
      if (across != flat.of[t]) sides[flat.of[t]].push_back({f.corner[n], f.corner[(n + 1) % 3], across});
    }
  }
  std::vector<Face> faces;
  std::vector<Index> corner_of(vertices.size(), unset);
  std::vector<Vector> corners;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (sides[k].empty()) return nullptr;
    std::optional<Face> face = ring_of(sides[k]);
    if (!face) return nullptr;
    face->normal = flat.normals[k];
    for (Index& c : face->corners) {
      if (corner_of[c] == unset) corner_of[c] = static_cast<Index>(corners.size()), corners.push_back(vertices[c]);
      c = corner_of[c];
    }
    faces.push_back(std::move(*face));
  }
  if (faces.size() < 4 || !put_in_order(faces)) return nullptr;
  const std::shared_ptr<const ConvexBody> body(new ConvexBody(std::move(corners), std::move(faces)));
  return body->bulges() ? body : nullptr;
}

ConvexBody ConvexBody::box(const Vector& low, const Vector& high) {
  std::vector<Vector> corners;
  for (std::size_t k = 0; k < 8; ++k)
    corners.push_back({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
  // Faces 2k and 2k + 1 look against the axis k and along it.
  std::vector<Face> faces(6);
  for (Index k = 0; k < 3; ++k) {
    const Index u = (k + 1) % 3, v = (k + 2) % 3;
    const std::array<Index, 4> around{0, 1U << u, (1U << u) | (1U << v), 1U << v},
        beyond{2 * v, 2 * u + 1, 2 * v + 1, 2 * u};
    for (Index n = 0; n < 4; ++n) {
      faces[2 * k + 1].corners.push_back(around[n] | (1U << k)), faces[2 * k + 1].across.push_back(beyond[n]);
      faces[2 * k].corners.push_back(around[(4 - n) % 4]), faces[2 * k].across.push_back(beyond[3 - n]);
    }
    faces[2 * k].normal[k] = -1, faces[2 * k + 1].normal[k] = 1;
  }
  put_in_order(faces);
  return {std::move(corners), std::move(faces)};
}

Index ConvexBody::farthest(const Vector& direction, Index start) const {
  Index best = start;
  double most = dot(direction, corners_[best]);
  for (bool moved = true; moved;) {
    moved = false;
    for (const Index n : at_[best].neighbours) {
      if (const double reach = dot(direction, corners_[n]); reach > most) most = reach, best = n, moved = true;
    }
  }
  return best;
}

}  // namespace dynalin
