#include "geometry/facet_arrangement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "base/joined_sets.h"

namespace dynalin {

namespace {

using Index = FacetBody::Index;

std::uint64_t pair_key(Index a, Index b) { return std::uint64_t{a} << 32 | b; }

// On which side one edge passes another one. The same for all who ask, from whichever end.
int passes(const PlacedSurface& A, Index a, Index b, const PlacedSurface& B, Index c, Index d) {
  int sign = 1;
  if (a > b) std::swap(a, b), sign = -sign;
  if (c > d) std::swap(c, d), sign = -sign;
  const Vector from = A.at(a), other = B.at(c);
  return dot(cross(A.at(b) - from, B.at(d) - other), other - from) > 0 ? sign : -sign;
}

// Where an edge of one body crosses a facet of the other one.
struct EdgeCrossing {
  bool edge_of_I;
  Index triangle;  // one that has the edge
  std::size_t side;
  Index face;
  double along;  // 0 to 1, as the side of the triangle runs
  Vector point;
  bool leaves;  // the other body, as the side runs
};

// All crossings of two surfaces and what they bound.
class SurfaceCrossings {
 public:
  SurfaceCrossings(const PlacedSurface& I, const PlacedSurface& J, const std::vector<std::pair<Index, Index>>& pairs)
      : I_(I), J_(J) {
    for (const auto& [a, b] : pairs) {
      const auto corners_of_I = sides_of_plane(I, a, J, b), corners_of_J = sides_of_plane(J, b, I, a);
      if (!crosses_plane(corners_of_I) || !crosses_plane(corners_of_J)) continue;
      for (std::size_t side = 0; side < 3; ++side) {
        const std::size_t next = (side + 1) % 3;
        if (I.owns(a, side) && corners_of_I[side] != corners_of_I[next])
          cross_edge(true, a, side, b, corners_of_I[side] < 0);
        if (J.owns(b, side) && corners_of_J[side] != corners_of_J[next])
          cross_edge(false, b, side, a, corners_of_J[side] < 0);
      }
    }
    find_cuts();
    find_edges();
    spread_inside();
  }
  SurfaceArrangement arrangement() {
    for (SurfacePiece& p : pieces_) p.volume = groups_.of(p.volume);
    std::ranges::stable_sort(pieces_, {},
                             [](const SurfacePiece& p) { return std::tuple(p.volume, !p.of_I, p.triangle); });
    return {std::move(pieces_), consistent_, std::move(lumps_)};
  }

 private:
  struct Cut {  // of one triangle of I by one of J: as the part of I's triangle is to its left
    std::size_t start = missing, end = missing;
  };
  static constexpr std::size_t missing = std::numeric_limits<std::size_t>::max();

  const PlacedSurface& body(bool of_I) const { return of_I ? I_ : J_; }

  // Of the corners of a triangle, by the plane of one of the other body.
  using Sides = std::array<int, 3>;
  static Sides sides_of_plane(const PlacedSurface& A, Index t, const PlacedSurface& B, Index face) {
    const PlaneOfTriangle plane = B.plane(face);
    return {plane.side(A.at(A.corner(t, 0))), plane.side(A.at(A.corner(t, 1))), plane.side(A.at(A.corner(t, 2)))};
  }
  static bool crosses_plane(const Sides& s) { return s[0] != s[1] || s[1] != s[2]; }

  // An edge whose ends are on both sides of the plane of a face.
  void cross_edge(bool of_I, Index t, std::size_t side, Index face, bool leaves) {
    const PlacedSurface &A = body(of_I), &B = body(!of_I);
    const Index from = A.corner(t, side), to = A.corner(t, side + 1);
    const Vector u = A.at(from), v = A.at(to);
    const Index b0 = B.corner(face, 0), b1 = B.corner(face, 1), b2 = B.corner(face, 2);
    const auto passing = [&](Index c, Index d) {
      return of_I ? passes(I_, from, to, J_, c, d) : passes(I_, c, d, J_, from, to);
    };
    const int first = passing(b0, b1);
    if (passing(b1, b2) != first || passing(b2, b0) != first) return;
    const double h = std::abs(B.height(face, u)), k = std::abs(B.height(face, v));
    const double along = h + k > 0 ? h / (h + k) : 0.5;
    crossings_.push_back({of_I, t, side, face, along, u + (v - u) * along, leaves});
    groups_.add();
    lumps_[of_I].insert(A.body().lump_of()[t]), lumps_[!of_I].insert(B.body().lump_of()[face]);
  }

  // An end of the cut of two triangles at a crossing: an edge that leaves the other body, as it runs about its
  // triangle, is followed by the cut.
  void end_cut(std::size_t crossing, bool edge_of_I, Index triangle, Index face, bool leaves) {
    Cut& cut = cuts_[edge_of_I ? pair_key(triangle, face) : pair_key(face, triangle)];
    std::size_t& end = leaves == edge_of_I ? cut.start : cut.end;
    consistent_ = consistent_ && end == missing;
    end = crossing;
  }
  void find_cuts() {
    for (std::size_t k = 0; k < crossings_.size(); ++k) {
      const EdgeCrossing& c = crossings_[k];
      end_cut(k, c.edge_of_I, c.triangle, c.face, c.leaves);
      end_cut(k, c.edge_of_I, body(c.edge_of_I).across(c.triangle, c.side), c.face, !c.leaves);
    }
    for (const auto& [triangles, cut] : cuts_) {
      if (cut.start == missing || cut.end == missing) {
        consistent_ = false;
        continue;
      }
      groups_.join(cut.start, cut.end);
      const auto a = static_cast<Index>(triangles >> 32), b = static_cast<Index>(triangles);
      const Vector &start = crossings_[cut.start].point, &end = crossings_[cut.end].point;
      pieces_.push_back({cut.start, true, a, start, end, b});
      pieces_.push_back({cut.start, false, b, end, start, a});
    }
  }

  // Parts of edges that cross something.
  void find_edges() {
    std::vector<std::size_t> order(crossings_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t k) {
      const EdgeCrossing& c = crossings_[k];
      return std::tuple(c.edge_of_I, c.triangle, c.side, c.along);
    });
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      const EdgeCrossing& first = crossings_[order[begin]];
      const auto same = [&](std::size_t k) {
        const EdgeCrossing& c = crossings_[k];
        return c.edge_of_I == first.edge_of_I && c.triangle == first.triangle && c.side == first.side;
      };
      while (end < order.size() && same(order[end])) ++end;
      find_edge({order.begin() + static_cast<std::ptrdiff_t>(begin), order.begin() + static_cast<std::ptrdiff_t>(end)});
    }
  }
  void find_edge(const std::vector<std::size_t>& along) {
    const EdgeCrossing& first = crossings_[along.front()];
    const bool of_I = first.edge_of_I;
    const PlacedSurface& A = body(of_I);
    const Index t = first.triangle;
    crossed_[of_I].insert(pair_key(t, static_cast<Index>(first.side)));
    const auto add = [&](std::size_t volume, const Vector& from, const Vector& to) {
      pieces_.push_back({volume, of_I, t, from, to});
      pieces_.push_back({volume, of_I, A.across(t, first.side), to, from});
    };
    bool inside = first.leaves;
    for (std::size_t k = 0; k < along.size(); ++k) {
      const EdgeCrossing& c = crossings_[along[k]];
      consistent_ = consistent_ && c.leaves == inside;
      inside = !c.leaves;
      if (!c.leaves) continue;
      if (k == 0) {
        const Index v = A.corner(t, first.side);
        groups_.join(is_inside(of_I, v, t), along[k]);
        add(along[k], A.at(v), c.point);
      } else {
        groups_.join(along[k - 1], along[k]);
        add(along[k], crossings_[along[k - 1]].point, c.point);
      }
    }
    if (!inside) return;
    const Index v = A.corner(t, first.side + 1);
    groups_.join(is_inside(of_I, v, t), along.back());
    add(along.back(), crossings_[along.back()].point, A.at(v));
  }

  // What is told of vertices in the other body goes on along all edges that cross nothing.
  std::size_t is_inside(bool of_I, Index v, Index triangle) {
    const auto [it, is_new] = inside_[of_I].try_emplace(v, 0);
    if (is_new) {
      it->second = groups_.add();
      found_.push_back({of_I, v, triangle});
    }
    return it->second;
  }
  bool is_crossed(bool of_I, Index t, std::size_t side) const {
    const PlacedSurface& A = body(of_I);
    return crossed_[of_I].contains(A.owns(t, side)
                                       ? pair_key(t, static_cast<Index>(side))
                                       : pair_key(A.across(t, side), static_cast<Index>(A.side_across(t, side))));
  }
  void spread_inside() {
    std::array<std::unordered_set<Index>, 2> touched;
    while (!found_.empty()) {
      const auto [of_I, v, triangle] = found_.back();
      found_.pop_back();
      const PlacedSurface& A = body(of_I);
      const auto& corners = A.body().triangles()[triangle].corner;
      const auto n = static_cast<std::size_t>(std::ranges::find(corners, v) - corners.begin());
      for (const Index t : A.body().around(triangle, n)) {
        touched[of_I].insert(t);
        const std::size_t side = A.side_from(t, v);
        if (!is_crossed(of_I, t, side)) groups_.join(inside_[of_I].at(v), is_inside(of_I, A.corner(t, side + 1), t));
      }
    }
    for (const bool of_I : {false, true}) {
      const PlacedSurface& A = body(of_I);
      for (const Index t : touched[of_I]) {
        for (std::size_t side = 0; side < 3; ++side) {
          const auto from = inside_[of_I].find(A.corner(t, side));
          if (from == inside_[of_I].end() || is_crossed(of_I, t, side)) continue;
          pieces_.push_back({from->second, of_I, t, A.at(from->first), A.at(A.corner(t, side + 1))});
        }
      }
    }
  }

  struct Found {
    bool of_I;
    Index vertex, triangle;
  };

  const PlacedSurface &I_, &J_;
  bool consistent_ = true;
  std::vector<EdgeCrossing> crossings_;
  JoinedSets groups_;  // of crossings, then of vertices
  std::unordered_map<std::uint64_t, Cut> cuts_;
  std::array<std::unordered_set<std::uint64_t>, 2> crossed_;  // edges
  std::array<std::unordered_map<Index, std::size_t>, 2> inside_;
  std::array<std::unordered_set<Index>, 2> lumps_;
  std::vector<Found> found_;
  std::vector<SurfacePiece> pieces_;
};

}  // namespace

SurfaceArrangement arrangement(const PlacedSurface& I, const PlacedSurface& J,
                               const std::vector<std::pair<Index, Index>>& pairs) {
  return SurfaceCrossings(I, J, pairs).arrangement();
}

}  // namespace dynalin
