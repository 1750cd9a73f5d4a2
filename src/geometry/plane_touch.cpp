#include "geometry/plane_touch.h"

#include <algorithm>
#include <array>

#include "geometry/placed_curve.h"

namespace dynalin {

namespace {

using plane::cross_z;
using plane::dot_xy;
using plane::Foot;
using plane::nearest_foot;
using plane::norm_xy;
using plane::over_foot;
using plane::OverFoot;
using plane::PlacedCurve;
using plane::refine;
using plane::untwisted;
using CurvePiece = PlaneCurve::Piece;
using Corner = PlaneCurve::Corner;

// Where both curves are nearest: on a piece of each, or at a corner of one.
struct Place {
  const CurvePiece *on_I = nullptr, *on_J = nullptr;
  double u = 0, v = 0;
  const Corner *corner_I = nullptr, *corner_J = nullptr;
  Foot foot;  // of such a corner on the other curve
  double gap = 0, inside = 0;
  bool defined = true;
  Vector at;  // half-way
};

// Both curves have parallel tangents in a line across them: f of the parameters, and its slopes.
template <class T>
std::array<T, 2> conditions(const PlacedCurve<T>& I, const PlacedCurve<T>& J, const Place& p, const T& u, const T& v) {
  const Vec3<T> s = J.at(*p.on_J, v, 1);
  return {dot_xy(I.at(*p.on_I, u) - J.at(*p.on_J, v), s), cross_z(I.at(*p.on_I, u, 1), s)};
}
struct Slopes {
  double a, b, c, d;
  double determinant() const { return a * d - b * c; }
};
Slopes slopes(const PlacedCurve<double>& I, const PlacedCurve<double>& J, const Place& p) {
  const Vector t = I.at(*p.on_I, p.u, 1), tt = I.at(*p.on_I, p.u, 2), s = J.at(*p.on_J, p.v, 1);
  const Vector ss = J.at(*p.on_J, p.v, 2), gap = I.at(*p.on_I, p.u) - J.at(*p.on_J, p.v);
  return {dot_xy(t, s), dot_xy(gap, ss) - dot_xy(s, s), cross_z(tt, s), cross_z(t, ss)};
}

class Places {
 public:
  Places(const PlacedCurve<double>& I, const PlacedCurve<double>& J)
      : I_(I), J_(J), size_(std::max(I.curve.radius(), J.curve.radius())) {
    for (const CurvePiece& a : I.curve.pieces()) {
      for (const CurvePiece& b : J.curve.pieces()) find_between(a, b);
    }
    for (const Corner& c : I.curve.corners()) {
      if (I.solid(c)) add_corner(I_, c, J_, true);
    }
    for (const Corner& c : J.curve.corners()) {
      if (J.solid(c)) add_corner(J_, c, I_, false);
    }
    const auto is_closed = [](const Place& p) { return p.gap < 0 && p.inside >= 0; };
    if (lost_.gap < 0 && std::none_of(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(count_), is_closed))
      add(lost_);
    std::sort(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(count_),
              [](const Place& a, const Place& b) { return a.gap < b.gap; });
  }
  std::span<const Place> all() const { return {all_.data(), count_}; }

 private:
  static constexpr std::size_t most = 64;

  void find_between(const CurvePiece& a, const CurvePiece& b) {
    if (a.curved()) find_along(I_, a, J_, b, true);
    if (b.curved()) find_along(J_, b, I_, a, false);
  }

  // Along the samples of one piece, where it is lowest above the other one.
  void find_along(const PlacedCurve<double>& X, const CurvePiece& x, const PlacedCurve<double>& Y, const CurvePiece& y,
                  bool X_is_I) {
    const std::size_t n = x.samples.size();
    struct Sample {
      double height, parameter;
    };
    const auto above = [&](std::size_t k) {
      const Vector p = Y.local(X.frame.p + X.turned(x.points[k]));
      const double at = Y.curve.nearly_nearest(y, p);
      return Sample{Y.curve.height(y, at, p) * (Y.reversed ? -1 : 1), at};
    };
    const Sample first = above(0), second = above(1);
    Sample before = x.round ? above(n - 1) : first, here = first, behind = second;
    double low = first.height, high = first.height;
    for (std::size_t k = 0; k < n; ++k) {
      low = std::min(low, here.height), high = std::max(high, here.height);
      const bool begins = !x.round && k == 0, ends = !x.round && k + 1 == n;
      if ((begins || here.height < before.height) && (ends || here.height <= behind.height))
        settle(x, x.samples[k], y, here.parameter, here.height, X_is_I, begins || ends);
      before = here, here = behind;
      behind = k + 2 < n ? above(k + 2) : k + 2 == n && x.round ? first : behind;
    }
    if (x.round && high - low <= 1e-12 * size_ && low < 0) add(undefined_at(X.frame.p, low));
  }

  // Newton's method from there.
  void settle(const CurvePiece& x, double at_x, const CurvePiece& y, double at_y, double height, bool X_is_I,
              bool at_end) {
    Place p;
    p.on_I = X_is_I ? &x : &y, p.on_J = X_is_I ? &y : &x;
    p.u = X_is_I ? at_x : at_y, p.v = X_is_I ? at_y : at_x;
    const double most_u = longest_step(*p.on_I), most_v = longest_step(*p.on_J);
    const double start_u = p.u, start_v = p.v;
    bool settled = false;
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 50 && !settled; ++k) {
      const Slopes m = slopes(I_, J_, p);
      const auto f = conditions(I_, J_, p, p.u, p.v);
      const double det = m.determinant();
      double du = (m.b * f[1] - m.d * f[0]) / det, dv = (m.c * f[0] - m.a * f[1]) / det;
      const double share = std::max(std::abs(du) / most_u, std::abs(dv) / most_v);
      if (!std::isfinite(share)) break;
      if (share > 1) du /= share, dv /= share;
      p.u += du, p.v += dv;
      settled = share < 1e-8 && (share < 1e-13 || share > 0.5 * last);
      last = share;
      if (std::abs(p.u - start_u) > 4 * most_u || std::abs(p.v - start_v) > 4 * most_v) break;
    }
    if (settled && add_common(p)) return;
    // One curve is in the other, but no place of it is the deepest.
    if (at_end || height >= lost_.gap || !in_range(*p.on_I, start_u) || !in_range(*p.on_J, start_v)) return;
    const Vector where = X_is_I ? I_.at(x, at_x) : J_.at(x, at_x);
    const PlacedCurve<double>& other = X_is_I ? J_ : I_;
    const Foot foot = nearest_foot(other.curve, other.local(where));
    if (foot.piece == nullptr || other.curve.inside(*foot.piece, foot.u) < 0) return;
    if (over_foot(other, foot, where).gap < -1e-6 * size_) lost_ = undefined_at(where, height);
  }

  static double longest_step(const CurvePiece& p) {
    return p.curved() ? 2 * (p.to - p.from) / static_cast<double>(p.samples.size()) : 1e3;
  }
  static bool in_range(const CurvePiece& p, double u) {
    return p.round || ((p.start_free || u >= p.from) && (p.end_free || u <= p.to));
  }

  // False where no place is.
  bool add_common(Place p) {
    if (!in_range(*p.on_I, p.u) || !in_range(*p.on_J, p.v)) return true;  // a corner is next to it
    const Vector A = I_.at(*p.on_I, p.u), B = J_.at(*p.on_J, p.v);
    const Vector t = I_.at(*p.on_I, p.u, 1), s = J_.at(*p.on_J, p.v, 1), n = J_.normal(s);
    if (dot_xy(I_.normal(t), n) >= 0) return false;
    p.gap = dot_xy(A - B, n);
    const double of_I = dot_xy(I_.at(*p.on_I, p.u, 2), n) / dot_xy(t, t);
    const double of_J = -dot_xy(J_.at(*p.on_J, p.v, 2), n) / dot_xy(s, s);
    const double together = of_I + of_J + p.gap * of_I * of_J;
    // Otherwise they are farthest there, or agree too well to say where.
    if (together < -1e-9 / size_) return false;
    p.defined = together > 1e-9 / size_;
    // Deepest below an edge that is far from it: what lies between is not matter of both.
    if (p.gap < 0 && (height(J_, A) > 1e-9 * size_ || height(I_, B) > 1e-9 * size_)) return false;
    p.inside = std::min(I_.curve.inside(*p.on_I, p.u), J_.curve.inside(*p.on_J, p.v));
    p.at = 0.5 * (A + B);
    add(p);
    return true;
  }

  static double height(const PlacedCurve<double>& c, const Vector& p) {
    return over_foot(c, nearest_foot(c.curve, c.local(p)), p).gap;
  }

  // A corner of X over Y. On what is flat, and in a notch, each corner stands for itself, so that two hold an edge;
  // on what bends only one that is lowest among its neighbours.
  void add_corner(const PlacedCurve<double>& X, const Corner& c, const PlacedCurve<double>& Y, bool X_is_I) {
    Place p;
    (X_is_I ? p.corner_I : p.corner_J) = &c;
    const Vector at = X.corner(c);
    p.foot = nearest_foot(Y.curve, Y.local(at));
    refine(Y, p.foot, at);
    const OverFoot<double> over = over_foot(Y, p.foot, at);
    if (!over.defined) {
      if (over.gap < 0) add(undefined_at(at, over.gap));
      return;
    }
    if (p.foot.piece != nullptr && p.foot.piece->curved()) {
      if (dot_xy(over.normal, X.turned(c.back)) < 0 || dot_xy(over.normal, X.turned(c.on)) < 0) return;
    }
    p.gap = over.gap;
    p.inside =
        p.foot.piece != nullptr ? Y.curve.inside(*p.foot.piece, p.foot.u) : std::numeric_limits<double>::infinity();
    p.at = 0.5 * (at + over.at);
    add(p);
  }

  static Place undefined_at(const Vector& at, double gap) {
    Place p;
    p.gap = gap, p.inside = std::numeric_limits<double>::infinity(), p.defined = false, p.at = at;
    return p;
  }
  void add(const Place& p) {
    for (const Place& q : all()) {
      const Vector d = p.at - q.at;
      if (std::abs(p.gap - q.gap) + norm_xy(d) < 1e-8 * size_) return;
    }
    if (count_ < most) all_[count_++] = p;
  }

  const PlacedCurve<double>&I_, &J_;
  double size_;
  Place lost_;
  std::array<Place, most> all_;
  std::size_t count_ = 0;
};

template <class T>
Touch<T> touch_at(const Place& p, const PlacedCurve<T>& I, const PlacedCurve<T>& J, const Slopes& m) {
  Touch<T> t;
  t.inside = p.inside, t.defined = p.defined;
  Vec3<T> A, B;
  if (!p.defined) {
    t.gap = T(p.gap), t.normal = {T(1.0), T(0.0), T(0.0)}, t.point = {T(p.at.x), T(p.at.y), T(p.at.z)};
    return t;
  }
  if (p.corner_I != nullptr) {
    A = I.corner(*p.corner_I);
    const OverFoot<T> over = over_foot(J, p.foot, A);
    B = over.at, t.gap = over.gap, t.normal = over.normal;
  } else if (p.corner_J != nullptr) {
    B = J.corner(*p.corner_J);
    const OverFoot<T> over = over_foot(I, p.foot, B);
    A = over.at, t.gap = over.gap, t.normal = -over.normal;
  } else {
    const auto f = conditions(I, J, p, T(p.u), T(p.v));
    const double det = m.determinant();
    const T u = T(p.u) + (f[1] * m.b - f[0] * m.d) * (1 / det), v = T(p.v) + (f[0] * m.c - f[1] * m.a) * (1 / det);
    A = I.at(*p.on_I, u), B = J.at(*p.on_J, v);
    t.normal = J.normal(J.at(*p.on_J, v, 1));
    t.gap = dot_xy(A - B, t.normal);
  }
  t.point = {(A.x + B.x) * 0.5, (A.y + B.y) * 0.5, A.z};
  return t;
}

}  // namespace

template <class T>
void touch_curves(const PlaneCurve& I, bool I_reversed, const RelativeFrame<T>& at, const PlaneCurve& J,
                  bool J_reversed, std::span<Touch<T>> out) {
  const RelativeFrame<double> from{value_of(at.p), value_of(at.x), value_of(at.y), value_of(at.z)};
  const auto still = []<class U>(U) {
    return RelativeFrame<U>{
        {U(0.0), U(0.0), U(0.0)}, {U(1.0), U(0.0), U(0.0)}, {U(0.0), U(1.0), U(0.0)}, {U(0.0), U(0.0), U(1.0)}};
  };
  const PlacedCurve<double> I_here{I, I_reversed, untwisted(I, from)}, J_here{J, J_reversed, still(0.0)};
  const Places places(I_here, J_here);
  const PlacedCurve<T> I_seen{I, I_reversed, untwisted(I, at)}, J_seen{J, J_reversed, still(T(0.0))};
  const std::span<const Place> all = places.all();
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (k < all.size()) {
      const bool common = all[k].defined && all[k].corner_I == nullptr && all[k].corner_J == nullptr;
      out[k] = touch_at(all[k], I_seen, J_seen, common ? slopes(I_here, J_here, all[k]) : Slopes{});
    } else {
      out[k] = Touch<T>{};
      out[k].gap = T(2 * (I.radius() + J.radius()));
      out[k].normal = {T(1.0), T(0.0), T(0.0)}, out[k].point = {T(0.0), T(0.0), T(0.0)};
    }
  }
  if (all.size() > out.size() && all[out.size()].gap < 0) out.back().defined = false;
}

template <class T>
Touch<T> touch_point(const Vec3<T>& point, const PlaneCurve& curve, bool reversed) {
  const RelativeFrame<T> still{
      {T(0.0), T(0.0), T(0.0)}, {T(1.0), T(0.0), T(0.0)}, {T(0.0), T(1.0), T(0.0)}, {T(0.0), T(0.0), T(1.0)}};
  const Vector at = value_of(point);
  const Foot foot = nearest_foot(curve, {at.x, at.y, 0});
  const OverFoot<T> over = over_foot(PlacedCurve<T>{curve, reversed, still}, foot, point);
  Touch<T> t;
  t.gap = over.gap, t.normal = over.normal, t.defined = over.defined;
  t.point = {(point.x + over.at.x) * 0.5, (point.y + over.at.y) * 0.5, point.z};
  if (foot.piece != nullptr) t.inside = curve.inside(*foot.piece, foot.u);
  return t;
}

template void touch_curves(const PlaneCurve&, bool, const RelativeFrame<double>&, const PlaneCurve&, bool,
                           std::span<Touch<double>>);
template void touch_curves(const PlaneCurve&, bool, const RelativeFrame<Dual<12>>&, const PlaneCurve&, bool,
                           std::span<Touch<Dual<12>>>);
template Touch<double> touch_point(const Vec3<double>&, const PlaneCurve&, bool);
template Touch<Dual<12>> touch_point(const Vec3<Dual<12>>&, const PlaneCurve&, bool);

}  // namespace dynalin
