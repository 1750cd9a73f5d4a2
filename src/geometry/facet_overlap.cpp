#include "geometry/facet_overlap.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "geometry/facet_pairs.h"

namespace dynalin {

namespace {

using Index = FacetBody::Index;
constexpr Index none = std::numeric_limits<Index>::max();

// Of the size: how far the one body is moved aside before it is looked where surfaces cross, so that edges which lie in
// a facet or meet another edge, as those of parts drawn flush do, are beside it for all who ask.
constexpr double aside = 1e-13;
const Vector shift_aside{0.5412, -0.2987, 0.7861};

constexpr double roundings = 1e-9;  // of an area

std::uint64_t pair_key(Index a, Index b) { return std::uint64_t{a} << 32 | b; }

// By its corners, the same for all who ask.
struct PlaneOfTriangle {
  Vector origin, across;
  int outwards;

  // 1 where a point is in front of it, −1 behind it.
  int side(const Vector& p) const { return dot(across, p - origin) > 0 ? outwards : -outwards; }
};

// One of the bodies in the axes of J, perhaps with the inside out.
class Placed {
 public:
  Placed(const FacetBody& body, const RelativeFrame<double>& frame, bool turned_over)
      : body_(body), frame_(frame), turned_over_(turned_over) {}

  const FacetBody& body() const { return body_; }
  Vector at(Index v) const {
    const Vector& b = body_.vertices()[v];
    return frame_.p + frame_.x * b.x + frame_.y * b.y + frame_.z * b.z;
  }
  Vector normal(Index t) const {
    const Vector& n = body_.triangles()[t].normal;
    const Vector out = frame_.x * n.x + frame_.y * n.y + frame_.z * n.z;
    return turned_over_ ? -out : out;
  }
  // Corners counter-clockwise as seen from outside of what is full; side n leads from corner n to the next one.
  Index corner(Index t, std::size_t n) const { return body_.triangles()[t].corner[turned_over_ ? (3 - n) % 3 : n % 3]; }
  Index across(Index t, std::size_t side) const { return body_.triangles()[t].across[turned_over_ ? 2 - side : side]; }
  std::size_t side_from(Index t, Index v) const { return corner(t, 0) == v ? 0 : corner(t, 1) == v ? 1 : 2; }
  // The same edge as a side of the triangle across it.
  std::size_t side_across(Index t, std::size_t side) const { return side_from(across(t, side), corner(t, side + 1)); }
  bool owns(Index t, std::size_t side) const { return t < across(t, side); }

  PlaneOfTriangle plane(Index t) const {
    const auto& c = body_.triangles()[t].corner;
    const Vector o = at(c[0]);
    return {o, cross(at(c[1]) - o, at(c[2]) - o), turned_over_ ? -1 : 1};
  }
  double height(Index t, const Vector& p) const { return dot(normal(t), p - at(corner(t, 0))); }

 private:
  const FacetBody& body_;
  RelativeFrame<double> frame_;
  bool turned_over_;
};

// On which side one edge passes another one. The same for all who ask, from whichever end.
int passes(const Placed& A, Index a, Index b, const Placed& B, Index c, Index d) {
  int sign = 1;
  if (a > b) std::swap(a, b), sign = -sign;
  if (c > d) std::swap(c, d), sign = -sign;
  const Vector from = A.at(a), other = B.at(c);
  return dot(cross(A.at(b) - from, B.at(d) - other), other - from) > 0 ? sign : -sign;
}

// Where an edge of one body crosses a facet of the other one.
struct Crossing {
  bool edge_of_I;
  Index triangle;  // one that has the edge
  std::size_t side;
  Index face;
  double along;  // 0 to 1, as the side of the triangle runs
  Vector point;
  bool leaves;  // the other body, as the side runs
};

// A straight piece of what bounds the part of a triangle that is in the other body, which is to its left.
struct Piece {
  std::size_t volume;  // to which it belongs
  bool of_I;
  Index triangle;
  Vector from, to;
  Index other = none;  // the triangle that cuts here, none on an edge of its own
};

// Numbers that belong together.
class Groups {
 public:
  std::size_t add() {
    above_.push_back(above_.size());
    return above_.size() - 1;
  }
  std::size_t of(std::size_t k) {
    while (above_[k] != k) k = above_[k] = above_[above_[k]];
    return k;
  }
  void join(std::size_t a, std::size_t b) { above_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> above_;
};

// All crossings of two surfaces and what they bound.
class Arrangement {
 public:
  Arrangement(const Placed& I, const Placed& J, const std::vector<std::pair<Index, Index>>& pairs) : I_(I), J_(J) {
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
  // Whether each cut has two ends, and each edge goes in and out by turns.
  bool consistent() const { return consistent_; }
  bool crosses() const { return !crossings_.empty(); }
  bool crosses_lump(bool of_I, Index lump) const { return lumps_[of_I].contains(lump); }

  // Ordered by volume, body and triangle.
  std::vector<Piece> pieces() {
    for (Piece& p : pieces_) p.volume = groups_.of(p.volume);
    std::ranges::stable_sort(pieces_, {}, [](const Piece& p) { return std::tuple(p.volume, !p.of_I, p.triangle); });
    return std::move(pieces_);
  }

 private:
  struct Cut {  // of one triangle of I by one of J: as the part of I's triangle is to its left
    std::size_t start = missing, end = missing;
  };
  static constexpr std::size_t missing = std::numeric_limits<std::size_t>::max();

  const Placed& body(bool of_I) const { return of_I ? I_ : J_; }

  // Of the corners of a triangle, by the plane of one of the other body.
  using Sides = std::array<int, 3>;
  static Sides sides_of_plane(const Placed& A, Index t, const Placed& B, Index face) {
    const PlaneOfTriangle plane = B.plane(face);
    return {plane.side(A.at(A.corner(t, 0))), plane.side(A.at(A.corner(t, 1))), plane.side(A.at(A.corner(t, 2)))};
  }
  static bool crosses_plane(const Sides& s) { return s[0] != s[1] || s[1] != s[2]; }

  // An edge whose ends are on both sides of the plane of a face.
  void cross_edge(bool of_I, Index t, std::size_t side, Index face, bool leaves) {
    const Placed &A = body(of_I), &B = body(!of_I);
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
      const Crossing& c = crossings_[k];
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
      const Crossing& c = crossings_[k];
      return std::tuple(c.edge_of_I, c.triangle, c.side, c.along);
    });
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      const Crossing& first = crossings_[order[begin]];
      const auto same = [&](std::size_t k) {
        const Crossing& c = crossings_[k];
        return c.edge_of_I == first.edge_of_I && c.triangle == first.triangle && c.side == first.side;
      };
      while (end < order.size() && same(order[end])) ++end;
      find_edge({order.begin() + static_cast<std::ptrdiff_t>(begin), order.begin() + static_cast<std::ptrdiff_t>(end)});
    }
  }
  void find_edge(const std::vector<std::size_t>& along) {
    const Crossing& first = crossings_[along.front()];
    const bool of_I = first.edge_of_I;
    const Placed& A = body(of_I);
    const Index t = first.triangle;
    crossed_[of_I].insert(pair_key(t, static_cast<Index>(first.side)));
    const auto add = [&](std::size_t volume, const Vector& from, const Vector& to) {
      pieces_.push_back({volume, of_I, t, from, to});
      pieces_.push_back({volume, of_I, A.across(t, first.side), to, from});
    };
    bool inside = first.leaves;
    for (std::size_t k = 0; k < along.size(); ++k) {
      const Crossing& c = crossings_[along[k]];
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
    const Placed& A = body(of_I);
    return crossed_[of_I].contains(A.owns(t, side)
                                       ? pair_key(t, static_cast<Index>(side))
                                       : pair_key(A.across(t, side), static_cast<Index>(A.side_across(t, side))));
  }
  void spread_inside() {
    std::array<std::unordered_set<Index>, 2> touched;
    while (!found_.empty()) {
      const auto [of_I, v, triangle] = found_.back();
      found_.pop_back();
      const Placed& A = body(of_I);
      const auto& corners = A.body().triangles()[triangle].corner;
      const auto n = static_cast<std::size_t>(std::ranges::find(corners, v) - corners.begin());
      for (const Index t : A.body().around(triangle, n)) {
        touched[of_I].insert(t);
        const std::size_t side = A.side_from(t, v);
        if (!is_crossed(of_I, t, side)) groups_.join(inside_[of_I].at(v), is_inside(of_I, A.corner(t, side + 1), t));
      }
    }
    for (const bool of_I : {false, true}) {
      const Placed& A = body(of_I);
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

  const Placed &I_, &J_;
  bool consistent_ = true;
  std::vector<Crossing> crossings_;
  Groups groups_;  // of crossings, then of vertices
  std::unordered_map<std::uint64_t, Cut> cuts_;
  std::array<std::unordered_set<std::uint64_t>, 2> crossed_;  // edges
  std::array<std::unordered_map<Index, std::size_t>, 2> inside_;
  std::array<std::unordered_set<Index>, 2> lumps_;
  std::vector<Found> found_;
  std::vector<Piece> pieces_;
};

// --- integrals

Matrix3 outer(const Vector& a, const Vector& b) { return {a * b.x, a * b.y, a * b.z}; }

// Over a part of a plane.
struct PlaneMoments {
  double area = 0;
  Vector first{};    // ∫ x dS
  Matrix3 second{};  // ∫ x xᵀ dS
  void add(const Vector& a, const Vector& b, const Vector& c, const Vector& normal) {
    const double s = 0.5 * dot(normal, cross(b - a, c - a));
    const Vector sum = a + b + c;
    area += s;
    first += sum * (s / 3);
    second += (s / 12) * (outer(a, a) + outer(b, b) + outer(c, c) + outer(sum, sum));
  }
};

// The part of one triangle, with the normal n out of what is full, that bounds a volume.
void add_part(const PlaneMoments& m, const Vector& n, bool of_I, Overlap& o) {
  o.volume += dot(n, m.first) / 3;
  for (std::size_t k = 0; k < 3; ++k) o.moment[k] += 0.5 * n[k] * m.second(k, k);
  if (!of_I) return;
  // The surface moves by (d + w × x) · n = d · n + w · (x × n).
  o.volume_by_shift += n * m.area;
  o.volume_by_turn += cross(m.first, n);
  o.moment_by_shift += outer(m.first, n);
  const auto crossed = [&](const Vector& row) { return cross(row, n); };
  const Matrix3 rows = {crossed(m.second.x), crossed(m.second.y), crossed(m.second.z)};
  o.moment_by_turn += transpose(rows);
}

// How the part of a facet grows where a facet of the other body cuts it: the cut moves over it with the velocity, seen
// from it, of the other body along the normal of that one's facet by the sine of the angle between both.
void add_cut(const Piece& p, const Vector& normal, const Vector& other_normal, const Vector& origin,
             Overlap::Part& part) {
  constexpr double parallel = 1e-9;  // sine: of facets in one plane, of which either all or nothing is inside
  const double sine = norm(cross(normal, other_normal));
  if (sine <= parallel) return;
  const double length = (p.of_I ? -1 : 1) * norm(p.to - p.from) / sine;
  const Vector middle = 0.5 * (p.from + p.to) - origin;
  part.area_by_shift += other_normal * length;
  part.area_by_turn += cross(middle, other_normal) * length;
}

std::vector<Overlap> integrals(const std::vector<Piece>& pieces, const Placed& I, const Placed& J, double size) {
  std::vector<Overlap> volumes;
  const auto same_volume = [](const Piece& a, const Piece& b) { return a.volume == b.volume; };
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    const Piece& first = pieces[begin];
    if (begin == 0 || !same_volume(pieces[begin - 1], first)) volumes.emplace_back().origin = first.from;
    Overlap& o = volumes.back();
    const Placed &A = first.of_I ? I : J, &B = first.of_I ? J : I;
    const Vector n = A.normal(first.triangle);
    const Vector start = first.from - o.origin;
    Overlap::Part part{first.triangle};
    PlaneMoments m;
    double reach = 0;
    for (; end < pieces.size(); ++end) {
      const Piece& p = pieces[end];
      if (!same_volume(p, first) || p.of_I != first.of_I || p.triangle != first.triangle) break;
      m.add(start, p.from - o.origin, p.to - o.origin, n);
      reach = std::max(reach, norm(p.to - first.from));
      if (p.other != none) add_cut(p, n, B.normal(p.other), o.origin, part);
    }
    // What bounds a hole in the part of another volume.
    if (m.area < -roundings * reach * (reach + 1e-3 * size)) o.whole = false;
    add_part(m, n, first.of_I, o);
    part.area = m.area;
    (first.of_I ? o.of_I : o.of_J).push_back(part);
  }
  return volumes;
}

// Whether a lump of one of the bodies that crosses nothing is wholly in the other one: in what the facets of B bound,
// or in a cavity in what is around them.
bool engulfs(const Arrangement& found, bool of_I, const FacetBody& A, const RelativeFrame<double>& A_from_B,
             const FacetBody& B, bool cavity) {
  Index next = 0;
  for (Index t = 0; t < A.lump_of().size(); ++t) {
    if (A.lump_of()[t] != next) continue;
    const Index lump = next++;
    if (found.crosses_lump(of_I, lump)) continue;
    const Placed placed(A, A_from_B, false);
    if (B.nearest(placed.at(placed.corner(t, 0))).outside == cavity) return true;
  }
  return false;
}

}  // namespace

Overlaps find_overlaps(const FacetBody& I, const RelativeFrame<double>& f, const FacetBody& J, bool cavity) {
  Overlaps found;
  const double size = I.radius() + J.radius();
  const RelativeFrame<double> own{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const RelativeFrame<double> J_from_I{-Vector{dot(f.x, f.p), dot(f.y, f.p), dot(f.z, f.p)},
                                       {f.x.x, f.y.x, f.z.x},
                                       {f.x.y, f.y.y, f.z.y},
                                       {f.x.z, f.y.z, f.z.z}};
  const auto pairs = near_pairs(I, f, J);
  for (const double times : {1.0, -7.0, 53.0}) {
    RelativeFrame<double> beside = f;
    beside.p += (times * aside * size) * shift_aside;
    const Placed placed_I(I, beside, false), placed_J(J, own, cavity);
    Arrangement arrangement(placed_I, placed_J, pairs);
    found.definite = arrangement.consistent();
    if (!found.definite) continue;
    found.engulfed = engulfs(arrangement, true, I, f, J, cavity) || engulfs(arrangement, false, J, J_from_I, I, false);
    found.volumes = integrals(arrangement.pieces(), placed_I, placed_J, size);
    return found;
  }
  return found;
}

}  // namespace dynalin
