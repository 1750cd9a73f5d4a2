#include "geometry/convex_touch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/convex_parting.h"
#include "geometry/looking_side.h"
#include "geometry/placed_box.h"

namespace dynalin {

namespace {

using Index = ConvexBody::Index;

constexpr double nearly_open =
    1e-6;  // of the size: how far apart places still count, so that what just touches is told
constexpr double seen_at_all = 1e-9;  // cosine: of a face that is seen at all
constexpr std::size_t most_convex_touches = 512, crossings = 64;

// One of the bodies in the axes of J.
template <class T>
struct PlacedConvex {
  const ConvexBody& body;
  RelativeFrame<T> frame;

  Vec3<T> turned(const Vector& v) const { return frame.x * v.x + frame.y * v.y + frame.z * v.z; }
  Vec3<T> at(const Vector& v) const { return frame.p + turned(v); }
  Vec3<T> corner(Index c) const { return at(body.corners()[c]); }
};

template <class T>
RelativeFrame<double> plain_frame(const RelativeFrame<T>& f) {
  return {value_of(f.p), value_of(f.x), value_of(f.y), value_of(f.z)};
}

// Of the faces at an edge or a corner, or of the one that is given, that which looks most in a direction.
template <class Faces>
Index most_looking(const ConvexBody& body, const Faces& faces, const Vector& direction) {
  return *std::ranges::max_element(faces, {}, [&](Index f) { return dot(body.faces()[f].normal, direction); });
}

// Two bodies that touch along a normal, in the axes of J.
template <class T>
class Touching {
 public:
  Touching(const PlacedConvex<T>& I, const PlacedConvex<T>& J, const ConvexParting& part, double tolerance)
      : I_(I),
        J_(J),
        plain_I_{I.body, plain_frame(I.frame)},
        plain_J_{J.body, plain_frame(J.frame)},
        part_(part),
        tolerance_(tolerance) {}

  void find(std::span<Touch<T>> out) {
    normal_ = across();
    place_sides();
    if (part_.face_of_I && part_.face_of_J) normal_ = common_normal();
    for (const Index c : side_of_I_->corners) add(corner_of_I(c, normal_));
    for (const Index c : side_of_J_->corners) add(corner_of_J(c, normal_));
    add_crossings();
    const bool pushes = std::ranges::any_of(found_, [](const Touch<T>& t) { return t.closed(); });
    if (part_.overlap > 0 && !pushes) found_.push_back(deepest());
    for (Touch<T>& t : found_) t.defined = part_.definite;
    const std::size_t count = std::min(found_.size(), out.size());
    std::copy_n(found_.begin(), count, out.begin());
    if (found_.size() > count) out.back().defined = false;
  }

 private:
  // A face and an edge of one of the sides where they stand, in plain numbers.
  struct PlacedFace {
    Vector normal;
    double height;
  };
  struct PlacedLine {
    Vector from, way;
  };
  struct PlacedSide {
    std::vector<PlacedFace> faces, beyond;
    std::vector<PlacedLine> outline;
    double reach = -unbounded;  // along the direction in which it looks
  };

  // --- the normal

  Vec3<T> of_face(const PlacedConvex<T>& X, Index face) const { return X.turned(X.body.faces()[face].normal); }
  Vec3<T> across() const {
    if (part_.face_of_J) return of_face(J_, *part_.face_of_J);
    if (part_.face_of_I) return -of_face(I_, *part_.face_of_I);
    const ConvexBody::Edge &e = I_.body.edges()[part_.edge_of_I], &f = J_.body.edges()[part_.edge_of_J];
    const Vec3<T> n = normalized(cross(I_.turned(e.along), J_.turned(f.along)));
    const Vec3<T> out = of_face(J_, f.left) + of_face(J_, f.right);
    return value_of(dot(n, out)) > 0 ? n : -n;
  }
  // Of parallel faces the one that holds more corners of the other one is the one whose normal stays where the bodies
  // tilt.
  Vec3<T> common_normal() const {
    const Vec3<T> of_J = of_face(J_, *part_.face_of_J), of_I = -of_face(I_, *part_.face_of_I);
    double by_I = 0, by_J = 0;
    for (const Index c : side_of_I_->corners) by_J += weight_of(corner_of_I(c, of_J));
    for (const Index c : side_of_J_->corners) by_I += weight_of(corner_of_J(c, of_J));
    if (by_I + by_J == 0) by_I = by_J = 1;
    return normalized(of_J * by_J + of_I * by_I);
  }
  static double weight_of(const std::optional<Touch<T>>& t) { return t ? value_of(t->weight) : 0; }

  // --- what looks along it

  static PlacedSide placed(const PlacedConvex<double>& X, const LookingSide& side, const Vector& direction) {
    PlacedSide placed;
    const auto place = [&](const std::vector<Index>& faces, std::vector<PlacedFace>& out) {
      for (const Index f : faces) {
        const Vector n = X.turned(X.body.faces()[f].normal);
        out.push_back({n, X.body.faces()[f].height + dot(n, X.frame.p)});
      }
    };
    place(side.faces, placed.faces), place(side.beyond, placed.beyond);
    for (const OutlineEdge& e : side.outline)
      placed.outline.push_back({X.corner(e.from), X.corner(e.to) - X.corner(e.from)});
    for (const Index c : side.corners) placed.reach = std::max(placed.reach, dot(direction, X.corner(c)));
    return placed;
  }
  // As deep as the bodies overlap; where they have a normal of both, that is another one in the end.
  LookingSide looking(const PlacedConvex<double>& X, const std::optional<Index>& face, const std::vector<Index>& others,
                      const Vector& direction) const {
    const RelativeFrame<double>& f = X.frame;
    const Vector own{dot(f.x, direction), dot(f.y, direction), dot(f.z, direction)};
    const Index most = face ? *face : most_looking(X.body, others, own);
    if (part_.face_of_I && part_.face_of_J) return {X.body, most, own, -unbounded};
    const Index top = X.body.farthest(own, X.body.faces()[most].corners[0]);
    return {X.body, most, own, dot(own, X.body.corners()[top]) - part_.overlap - 2 * open()};
  }
  void place_sides() {
    const Vector n = value_of(normal_);
    const bool by_face = part_.face_of_I || part_.face_of_J;
    const auto beside = [](const ConvexBody& body, Index edge) {
      return std::vector<Index>{body.edges()[edge].left, body.edges()[edge].right};
    };
    side_of_I_.emplace(looking(plain_I_, part_.face_of_I,
                               by_face ? I_.body.faces_at(part_.deepest_of_I) : beside(I_.body, part_.edge_of_I), -n));
    side_of_J_.emplace(looking(plain_J_, part_.face_of_J,
                               by_face ? J_.body.faces_at(part_.deepest_of_J) : beside(J_.body, part_.edge_of_J), n));
    placed_I_ = placed(plain_I_, *side_of_I_, -n), placed_J_ = placed(plain_J_, *side_of_J_, n);
  }

  // --- places, all along the normal

  // Where a line from a place leads out of a side; nothing where that is far below the place, or beside the side.
  struct Way {
    std::size_t face = 0;
    double length = std::numeric_limits<double>::infinity(), inside = unbounded, share = 1;
  };
  std::optional<Way> way_out(const Vector& from, const Vector& direction, const PlacedSide& side) const {
    if (dot(direction, from) > side.reach + open()) return std::nullopt;
    Way way;
    for (std::size_t k = 0; k < side.faces.size(); ++k) {
      const auto& [n, height] = side.faces[k];
      const double climb = dot(n, direction);
      if (!(climb > seen_at_all)) continue;
      if (const double length = (height - dot(n, from)) / climb; length < way.length) way.length = length, way.face = k;
    }
    if (!(way.length > -open())) return std::nullopt;
    const Vector foot = from + way.length * direction;
    for (const auto& [n, height] : side.beyond) {
      const double depth = height - dot(n, foot);
      if (depth < -tolerance_) return std::nullopt;
      way.inside = std::min(way.inside, depth), way.share *= share_inside(depth, tolerance_);
    }
    if (way.inside <= tolerance_) way.inside = 0;
    return way;
  }
  double open() const { return nearly_open / solid::coincidence * tolerance_; }

  static T length_to(const PlacedConvex<T>& X, Index face, const Vec3<T>& from, const Vec3<T>& direction) {
    const ConvexBody::Face& f = X.body.faces()[face];
    const Vec3<T> n = X.turned(f.normal);
    return (T(f.height) - dot(from - X.frame.p, n)) / dot(direction, n);
  }
  static Touch<T> with(Touch<T> t, const Way& way) {
    t.inside = way.inside, t.weight = T(way.share);
    return t;
  }
  std::optional<Touch<T>> corner_of_I(Index c, const Vec3<T>& normal) const {
    const auto way = way_out(plain_I_.corner(c), value_of(normal), placed_J_);
    if (!way) return std::nullopt;
    const Vec3<T> corner = I_.corner(c);
    const T depth = length_to(J_, side_of_J_->faces[way->face], corner, normal);
    return with(between(corner + normal * depth, T(-depth), normal), *way);
  }
  std::optional<Touch<T>> corner_of_J(Index c, const Vec3<T>& normal) const {
    const auto way = way_out(plain_J_.corner(c), -value_of(normal), placed_I_);
    if (!way) return std::nullopt;
    const Vec3<T> corner = J_.corner(c);
    return with(between(corner, T(-length_to(I_, side_of_I_->faces[way->face], corner, -normal)), normal), *way);
  }

  // Where an edge of I and one of J cross, seen along the normal.
  struct Crossing {
    Touch<T> touch;
    T square_of_sine{};  // of their angle
  };
  std::optional<Crossing> crossing(Index e_from, Index e_to, Index f_from, Index f_to) const {
    const Vector &a = I_.body.corners()[e_from], &b = J_.body.corners()[f_from];
    const Vector e_way = I_.body.corners()[e_to] - a, f_way = J_.body.corners()[f_to] - b;
    const double e_length = norm(e_way), f_length = norm(f_way);
    const Vec3<T> u = I_.turned(e_way / e_length), v = J_.turned(f_way / f_length);
    const T area = dot(cross(u, v), normal_);
    const T un = dot(u, normal_), vn = dot(v, normal_);
    Crossing found;
    found.square_of_sine = area * area / ((1.0 - un * un) * (1.0 - vn * vn));
    if (!(value_of(found.square_of_sine) > least_sine * least_sine)) return std::nullopt;
    const Vec3<T> d = I_.at(a) - J_.at(b);
    const T s = -dot(d, cross(v, normal_)) / area, r = -dot(d, cross(u, normal_)) / area;
    const T gap = dot(d + u * s - v * r, normal_);
    Touch<T>& t = found.touch = between(J_.at(b) + v * r, gap, normal_);
    for (const double depth : {value_of(s), e_length - value_of(s), value_of(r), f_length - value_of(r)})
      t.inside = std::min(t.inside, depth), t.weight *= T(share_inside(depth, tolerance_));
    if (t.inside < -tolerance_) return std::nullopt;
    if (t.inside <= tolerance_) t.inside = 0;
    return found;
  }
  // Told from plain numbers: most edges of outlines do not.
  bool may_cross(std::size_t i, std::size_t j) const {
    const auto& [a, u] = placed_I_.outline[i];
    const auto& [b, v] = placed_J_.outline[j];
    const Vector n = value_of(normal_), d = a - b;
    const double area = dot(cross(u, v), n), s = -dot(d, cross(v, n)), r = -dot(d, cross(u, n));
    const double sign = area < 0 ? -1 : 1, most = std::abs(area) * (1 + 1e-6), least = -1e-6 * most;
    const double beyond_I = tolerance_ * norm(v), beyond_J = tolerance_ * norm(u);
    return sign * s >= least - beyond_I && sign * s <= most + beyond_I && sign * r >= least - beyond_J &&
           sign * r <= most + beyond_J;
  }
  std::optional<Crossing> crossing(std::size_t i, std::size_t j) const {
    if (i == no_edge || j == no_edge || !may_cross(i, j)) return std::nullopt;
    const OutlineEdge &e = side_of_I_->outline[i], &f = side_of_J_->outline[j];
    return crossing(e.from, e.to, f.from, f.to);
  }

  // As between boxes (box_touch.cpp): both edges of a corner that has left over an edge share its force.
  static T share_beside(const Crossing& own, const std::optional<Crossing>& other) {
    if (!other || value_of(own.touch.gap) >= 0) return T(1.0);
    const T ratio = other->touch.gap / own.touch.gap;
    if (value_of(ratio) <= 0) return T(1.0);
    const T alone = value_of(ratio) < 1 ? T((1.0 - ratio) * (1.0 - ratio) * (1.0 + 2.0 * ratio)) : T(0.0);
    const T share = own.square_of_sine / (own.square_of_sine + other->square_of_sine);
    return share + (1.0 - share) * alone;
  }

  // The neighbour with which an edge of an outline meets at its end outside of the other outline. Both run
  // counter-clockwise as seen from outside of their own body: what J holds is on the left seen against the normal.
  void add_crossings() {
    const Vector n = value_of(normal_);
    const auto &of_I = side_of_I_->outline, &of_J = side_of_J_->outline;
    bool met = false;
    for (std::size_t i = 0; i < of_I.size(); ++i) {
      const Vector& u = placed_I_.outline[i].way;
      for (std::size_t j = 0; j < of_J.size(); ++j) {
        std::optional<Crossing> c = crossing(i, j);
        if (!c || value_of(c->touch.gap) > open()) continue;
        met = met || is_across(of_I[i], of_J[j]);
        const Vector& v = placed_J_.outline[j].way;
        const bool I_leaves_at_end = dot(u, cross(n, v)) < 0, J_leaves_at_end = dot(v, cross(u, n)) < 0;
        const T by_I = share_beside(*c, crossing(I_leaves_at_end ? of_I[i].after : of_I[i].before, j)),
                by_J = share_beside(*c, crossing(i, J_leaves_at_end ? of_J[j].after : of_J[j].before));
        c->touch.weight *= value_of(by_I) < value_of(by_J) ? by_I : by_J;
        found_.push_back(c->touch);
      }
    }
    if (met || part_.face_of_I || part_.face_of_J) return;
    const ConvexBody::Edge &e = I_.body.edges()[part_.edge_of_I], &f = J_.body.edges()[part_.edge_of_J];
    if (const auto c = crossing(e.from, e.to, f.from, f.to)) found_.push_back(c->touch);
  }
  // Whether these are the edges across which the bodies part.
  bool is_across(const OutlineEdge& i, const OutlineEdge& j) const {
    const auto is = [](const OutlineEdge& o, const ConvexBody::Edge& e) {
      return (o.from == e.from && o.to == e.to) || (o.from == e.to && o.to == e.from);
    };
    return is(i, I_.body.edges()[part_.edge_of_I]) && is(j, J_.body.edges()[part_.edge_of_J]);
  }

  // Where roundings, or the preference for faces, have left none: the corner that is deepest across the face.
  Touch<T> deepest() const {
    if (part_.face_of_J) {
      const Vec3<T> corner = I_.corner(part_.deepest_of_I);
      const T depth = length_to(J_, *part_.face_of_J, corner, normal_);
      return between(corner + normal_ * depth, T(-depth), normal_);
    }
    if (part_.face_of_I) {
      const Vec3<T> corner = J_.corner(part_.deepest_of_J);
      return between(corner, T(-length_to(I_, *part_.face_of_I, corner, -normal_)), normal_);
    }
    const ConvexBody::Edge &e = I_.body.edges()[part_.edge_of_I], &f = J_.body.edges()[part_.edge_of_J];
    const Vec3<T> on_I = I_.corner(e.from), on_J = J_.corner(f.from);
    return between(on_J, dot(on_I - on_J, normal_), normal_);
  }

  void add(const std::optional<Touch<T>>& t) {
    if (t) found_.push_back(*t);
  }

  const PlacedConvex<T>&I_, &J_;
  PlacedConvex<double> plain_I_, plain_J_;
  const ConvexParting& part_;
  double tolerance_;
  Vec3<T> normal_;
  std::optional<LookingSide> side_of_I_, side_of_J_;
  PlacedSide placed_I_, placed_J_;
  std::vector<Touch<T>> found_;
};

}  // namespace

std::size_t convex_touches(std::size_t corners_of_I, std::size_t corners_of_J) {
  return std::min(corners_of_I + corners_of_J + crossings, most_convex_touches);
}

template <class T>
void touch_convex(const ConvexBody& I_body, const RelativeFrame<T>& R, const ConvexBody& J_body,
                  std::span<Touch<T>> out) {
  const ConvexParting part = convex_parting(I_body, plain_frame(R), J_body);
  const double size = std::min(I_body.size(), J_body.size());
  Touch<T> far;
  far.gap = T(std::max(-part.overlap, size));
  std::fill(out.begin(), out.end(), far);
  out[0].gap = T(-part.overlap);
  if (part.overlap < -nearly_open * size) return;
  const Vec3<T> x{T(1.0), T(0.0), T(0.0)}, y{T(0.0), T(1.0), T(0.0)}, z{T(0.0), T(0.0), T(1.0)};
  const PlacedConvex<T> I{I_body, R}, J{J_body, {{T(0.0), T(0.0), T(0.0)}, x, y, z}};
  Touching<T>(I, J, part, solid::coincidence * size).find(out);
}

template void touch_convex(const ConvexBody&, const RelativeFrame<double>&, const ConvexBody&,
                           std::span<Touch<double>>);
template void touch_convex(const ConvexBody&, const RelativeFrame<Dual<12>>&, const ConvexBody&,
                           std::span<Touch<Dual<12>>>);

}  // namespace dynalin
