#include "beams.h"

#include <cmath>

#include "model.h"

namespace dynalin::oracle {

namespace {

template <class T>
struct Quaternion {
  T w;
  Vector3<T> v;
};
template <class T>
Quaternion<T> operator*(const Quaternion<T>& a, const Quaternion<T>& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}
template <class T>
Quaternion<T> conjugate(const Quaternion<T>& q) {
  return {q.w, -q.v};
}
template <class T>
std::array<Vector3<T>, 3> axes_of(const Quaternion<T>& q) {
  const auto turned = [&](const Vector3<T>& e) {
    const Vector3<T> t = 2 * cross(q.v, e);
    return e + q.w * t + cross(q.v, t);
  };
  return {turned({T(1), T(0), T(0)}), turned({T(0), T(1), T(0)}), turned({T(0), T(0), T(1)})};
}
// Of R by its columns, turned by less than half a turn.
template <class T>
Quaternion<T> quaternion(const std::array<Vector3<T>, 3>& R) {
  using std::sqrt;
  const T w = 0.5L * sqrt(T(1) + R[0].x + R[1].y + R[2].z);
  const T f = T(0.25L) / w;
  return {w, f * Vector3<T>{R[1].z - R[2].y, R[2].x - R[0].z, R[0].y - R[1].x}};
}
template <class T>
std::array<Vector3<T>, 3> seen_from(const std::array<Vector3<T>, 3>& R, const std::array<Vector3<T>, 3>& from) {
  std::array<Vector3<T>, 3> out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = {dot(from[0], R[c]), dot(from[1], R[c]), dot(from[2], R[c])};
  return out;
}

// cos(a/2) and sin(a/2)/a with their slopes by x = a^2, as sums of powers that are exact beyond a whole turn.
struct HalfAngleSeries {
  std::array<Real, 20> c{}, s{};
  constexpr HalfAngleSeries() {
    Real term = 1;  // 4^-k (-1)^k / (2k)!
    for (std::size_t k = 0; k < c.size(); ++k) {
      const Real n = static_cast<Real>(k);
      c[k] = term, s[k] = term / (2 * (2 * n + 1));
      term *= -0.25L / ((2 * n + 1) * (2 * n + 2));
    }
  }
};
// The sum of powers, its slope, and half of its second and a sixth of its third derivative.
std::array<Real, 4> sum_of_powers(const std::array<Real, 20>& of, Real x) {
  std::array<Real, 4> d{};
  for (std::size_t k = of.size(); k-- > 0;) {
    d[3] = d[3] * x + d[2];
    d[2] = d[2] * x + d[1];
    d[1] = d[1] * x + d[0];
    d[0] = d[0] * x + of[k];
  }
  return d;
}
Real from_derivatives(Real, Real f, Real, Real) { return f; }
Jet from_derivatives(const Jet& x, Real f, Real f1, Real f2) { return chain(x, f, f1, f2); }
template <class T>
struct HalfAngle {
  T c, s, c1, s1;
  explicit HalfAngle(const T& x) {
    static constexpr HalfAngleSeries series;
    const auto of_c = sum_of_powers(series.c, value_of(x)), of_s = sum_of_powers(series.s, value_of(x));
    c = from_derivatives(x, of_c[0], of_c[1], 2 * of_c[2]), c1 = from_derivatives(x, of_c[1], 2 * of_c[2], 6 * of_c[3]);
    s = from_derivatives(x, of_s[0], of_s[1], 2 * of_s[2]), s1 = from_derivatives(x, of_s[1], 2 * of_s[2], 6 * of_s[3]);
  }
};
template <class T>
Quaternion<T> exponential(const Vector3<T>& a) {
  const HalfAngle<T> h(dot(a, a));
  return {h.c, h.s * a};
}
template <class T>
Vector3<T> logarithm(const Quaternion<T>& q) {
  using std::atan2, std::sqrt;
  const T x = dot(q.v, q.v);
  if (value_of(x) > 0.01L) {
    const T sine = sqrt(x);
    return (2 * atan2(sine, q.w) / sine) * q.v;
  }
  // asin(s)/s in powers of s^2
  std::array<Real, 14> of{1};
  for (std::size_t k = 1; k < of.size(); ++k) {
    const Real n = static_cast<Real>(k);
    of[k] = of[k - 1] * (2 * n - 1) / (2 * n);
  }
  T sum(0);
  for (std::size_t k = of.size(); k-- > 0;) sum = sum * x + T(of[k] / static_cast<Real>(2 * k + 1));
  return (2 * sum) * q.v;
}

// Rotations along an element: of its first end, its middle, and of both ends from that.
template <class T>
struct Turning {
  std::array<Vector3<T>, 3> first;
  Quaternion<T> middle;  // from the first end
  std::array<Vector3<T>, 2> to_end;
  explicit Turning(const BeamPose<T>& p) : first(p.axis[0]) {
    const Quaternion<T> across = quaternion(seen_from(p.axis[1], p.axis[0]));
    middle = exponential(0.5L * logarithm(across)) * exponential(p.phi);
    to_end = {logarithm(conjugate(middle)), logarithm(conjugate(middle) * across)};
  }
  // x from 0 to 1
  struct Section {
    std::array<Vector3<T>, 3> axis;
    Vector3<T> curvature;  // by x
  };
  [[nodiscard]] Section at(Real x) const {
    const Vector3<T> a = ((2 * x - 1) * (x - 1)) * to_end[0] + ((2 * x - 1) * x) * to_end[1];
    const Vector3<T> a1 = (4 * x - 3) * to_end[0] + (4 * x - 1) * to_end[1];
    const HalfAngle<T> h(dot(a, a));
    const T x1 = 2 * dot(a, a1);
    const Quaternion<T> q{h.c, h.s * a}, q1{h.c1 * x1, h.s * a1 + (h.s1 * x1) * a};
    const std::array<Vector3<T>, 3> local = axes_of(middle * q);
    Section out;
    for (std::size_t c = 0; c < 3; ++c)
      out.axis[c] = local[c].x * first[0] + local[c].y * first[1] + local[c].z * first[2];
    out.curvature = 2 * (conjugate(q) * q1).v;
    return out;
  }
};

template <class T>
Vector3<T> in_axes(const std::array<Vector3<T>, 3>& axis, const Vector3<T>& v) {
  return {dot(axis[0], v), dot(axis[1], v), dot(axis[2], v)};
}
template <class T>
Vector3<T> out_of_axes(const std::array<Vector3<T>, 3>& axis, const Vector3<T>& v) {
  return v.x * axis[0] + v.y * axis[1] + v.z * axis[2];
}

// Stretches along an element from those of both ends and what must lead from one to the other: the integral of R times
// the parabola over the element, at three points.
template <class T>
struct Stretches {
  std::array<Vector3<T>, 3> of;  // first end, middle, second end
  static std::array<Real, 3> parabolas(Real x) { return {(2 * x - 1) * (x - 1), 4 * x * (1 - x), (2 * x - 1) * x}; }
  [[nodiscard]] Vector3<T> at(Real x) const {
    const auto N = parabolas(x);
    return N[0] * of[0] + N[1] * of[1] + N[2] * of[2];
  }
};
template <class T>
Stretches<T> stretches(const BeamPose<T>& p, const Turning<T>& turning, Real length) {
  Stretches<T> out;
  out.of[0] = in_axes(p.axis[0], p.s[0]), out.of[2] = in_axes(p.axis[1], p.s[1]);
  Vector3<T> rest = (1 / length) * (p.r[1] - p.r[0]);
  std::array<Vector3<T>, 3> column{};  // what the middle one leads along
  for (const GaussPoint& g : three_points()) {
    const auto N = Stretches<T>::parabolas(g.at);
    const auto section = turning.at(g.at);
    rest = rest - g.weight * out_of_axes(section.axis, N[0] * out.of[0] + N[2] * out.of[2]);
    for (std::size_t c = 0; c < 3; ++c) column[c] += (g.weight * N[1]) * section.axis[c];
  }
  const Vector3<T> yz = cross(column[1], column[2]);
  const T volume = dot(column[0], yz);
  out.of[1] = (T(1) / volume) *
              Vector3<T>{dot(rest, yz), dot(rest, cross(column[2], column[0])), dot(rest, cross(column[0], column[1]))};
  return out;
}

template <class T>
Vec value(const Vector3<T>& v) {
  return {value_of(v.x), value_of(v.y), value_of(v.z)};
}
Vec first(const Vector3<Jet>& v) { return {v.x.d, v.y.d, v.z.d}; }
Vec second(const Vector3<Jet>& v) { return {v.x.dd, v.y.dd, v.z.dd}; }
// The spin of axes along a jet, and its rate.
Vec spin(const std::array<Vector3<Jet>, 3>& axis) {
  Vec w;
  for (const auto& e : axis) w += 0.5L * cross(value(e), first(e));
  return w;
}
Vec spin_rate(const std::array<Vector3<Jet>, 3>& axis) {
  Vec al;
  for (const auto& e : axis) al += 0.5L * cross(value(e), second(e));
  return al;
}

}  // namespace

template <class T>
BeamShape<T> BeamElement::shape(const BeamPose<T>& p) const {
  BeamShape<T> out;
  const Turning<T> turning(p);
  const Stretches<T> along = stretches(p, turning, length_);
  for (std::size_t g = 0; g < strain_points; ++g) {
    const Real x = three_points()[g].at;
    const auto section = turning.at(x);
    out.stretch[g] = along.at(x), out.curvature[g] = (1 / length_) * section.curvature, out.axis[g] = section.axis;
  }
  for (std::size_t g = 0; g < line_points; ++g) {
    const Real x = four_points()[g].at;
    const auto h = cubics(x, length_);
    out.line_axis[g] = turning.at(x).axis;
    out.place[g] = h[0] * p.r[0] + h[1] * p.s[0] + h[2] * p.r[1] + h[3] * p.s[1];
  }
  return out;
}

BeamElement::BeamElement(const Beam& beam, std::size_t k, Real ucf) : damping_(beam.damping) {
  BeamPose<Real> drawn;
  for (std::size_t end = 0; end < 2; ++end) {
    const Triple& a = beam.angles[k + end];
    drawn.r[end] = to_vec(beam.places[k + end]);
    drawn.axis[end] = rotation_313(a[0], a[1], a[2]).column;
    drawn.s[end] = drawn.axis[end][0];
  }
  // As long as a line without stretch along these rotations that spans the distance.
  const Turning<Real> turning(drawn);
  Vec mean;
  for (const GaussPoint& g : three_points()) mean += g.weight * turning.at(g.at).axis[0];
  length_ = norm(drawn.r[1] - drawn.r[0]) / norm(mean);
  const BeamShape<Real> undeformed = shape(drawn);
  const Real E = beam.youngs_modulus, G = E / (2 + 2 * static_cast<Real>(beam.poissons_ratio)),
             density = beam.density / ucf;
  const auto mean_of = [&](const std::vector<double>& list, Real x) { return (1 - x) * list[k] + x * list[k + 1]; };
  for (std::size_t g = 0; g < strain_points; ++g) {
    const auto [x, weight] = three_points()[g];
    const Real A = mean_of(beam.area, x), yy = mean_of(beam.yy, x), zz = mean_of(beam.zz, x), yz = mean_of(beam.yz, x);
    StrainPoint& p = strain_[g];
    p.weight = weight * length_;
    p.stretch = undeformed.stretch[g], p.curvature = undeformed.curvature[g];
    p.stretching = {E * A, G * A / mean_of(beam.shear_y, x), G * A / mean_of(beam.shear_z, x)};
    p.torsion = G * mean_of(beam.torsion, x), p.yy = E * yy, p.zz = E * zz, p.yz = E * yz;
    p.second = {density * yy, density * zz, density * yz};
  }
  for (std::size_t g = 0; g < line_points; ++g) {
    const auto [x, weight] = four_points()[g];
    line_weight_[g] = weight * length_;
    line_mass_[g] = line_weight_[g] * density * mean_of(beam.area, x);
  }
}

BeamDirections BeamElement::directions(const BeamPose<Real>& pose) const {
  BeamDirections out;
  const auto jet = [](const Vec& v, const Vec& d) { return Vector3<Jet>{{v.x, d.x, 0}, {v.y, d.y, 0}, {v.z, d.z, 0}}; };
  for (std::size_t a = 0; a < beam_freedoms; ++a) {
    // Triples in the order r1, spin 1, r2, spin 2, s1, s2, phi.
    const std::size_t triple = a / 3;
    Vec e;
    set_component(e, static_cast<int>(a % 3), 1);
    const auto by = [&](std::size_t which) { return triple == which ? e : Vec{}; };
    BeamPose<Jet> p;
    for (std::size_t end = 0; end < 2; ++end) {
      p.r[end] = jet(pose.r[end], by(2 * end)), p.s[end] = jet(pose.s[end], by(4 + end));
      for (std::size_t c = 0; c < 3; ++c)
        p.axis[end][c] = jet(pose.axis[end][c], cross(by(2 * end + 1), pose.axis[end][c]));
    }
    p.phi = jet(pose.phi, by(6));
    const BeamShape<Jet> moved = shape(p);
    for (std::size_t g = 0; g < strain_points; ++g) {
      out.by[a].stretch[g] = first(moved.stretch[g]), out.by[a].curvature[g] = first(moved.curvature[g]);
      out.by[a].spin[g] = spin(moved.axis[g]);
    }
    for (std::size_t g = 0; g < line_points; ++g) {
      out.by[a].line_spin[g] = spin(moved.line_axis[g]);
      out.by[a].place[g] = first(moved.place[g]);
    }
  }
  return out;
}

Vec BeamElement::spun(std::size_t point, const std::array<Vec, 3>& axes, const Vec& w) const {
  const auto [zz, yy, yz] = strain_[point].second;  // integrals of z z, y y, y z
  const Vec in = in_axes(axes, w);
  return out_of_axes(axes, Vec{(yy + zz) * in.x, zz * in.y - yz * in.z, yy * in.z - yz * in.y});
}

std::array<Real, beam_freedoms> BeamElement::loads(const BeamPose<Jet>& along, const BeamDirections& by,
                                                   const Vec& gravity) const {
  const BeamShape<Jet> now = shape(along);
  std::array<Real, beam_freedoms> out{};
  for (std::size_t g = 0; g < strain_points; ++g) {
    const StrainPoint& p = strain_[g];
    const Vec stretch = value(now.stretch[g]) - p.stretch + damping_ * first(now.stretch[g]);
    const Vec bend = value(now.curvature[g]) - p.curvature + damping_ * first(now.curvature[g]);
    const Vec N{p.stretching.x * stretch.x, p.stretching.y * stretch.y, p.stretching.z * stretch.z};
    const Vec M{p.torsion * bend.x, p.yy * bend.y - p.yz * bend.z, p.zz * bend.z - p.yz * bend.y};
    std::array<Vec, 3> axes;
    for (std::size_t c = 0; c < 3; ++c) axes[c] = value(now.axis[g][c]);
    const Vec w = spin(now.axis[g]);
    const Vec torque = spun(g, axes, spin_rate(now.axis[g])) + cross(w, spun(g, axes, w));
    for (std::size_t a = 0; a < beam_freedoms; ++a) {
      const BeamDirections::One& d = by.by[a];
      out[a] -= p.weight * (dot(N, d.stretch[g]) + dot(M, d.curvature[g]) + dot(torque, d.spin[g]));
    }
  }
  for (std::size_t g = 0; g < line_points; ++g) {
    const Vec force = line_mass_[g] * (gravity - second(now.place[g]));
    for (std::size_t a = 0; a < beam_freedoms; ++a) out[a] += dot(force, by.by[a].place[g]);
  }
  return out;
}

std::array<Real, beam_freedoms> BeamElement::loads(const LineLoads& on, const BeamDirections& by) const {
  std::array<Real, beam_freedoms> out{};
  for (std::size_t g = 0; g < line_points; ++g) {
    for (std::size_t a = 0; a < beam_freedoms; ++a)
      out[a] += line_weight_[g] * (dot(on.force[g], by.by[a].place[g]) + dot(on.moment[g], by.by[a].line_spin[g]));
  }
  return out;
}

Real BeamElement::mass(const BeamPose<Real>& pose, const BeamDirections& by, std::size_t a, std::size_t b) const {
  const BeamShape<Real> now = shape(pose);
  Real sum = 0;
  for (std::size_t g = 0; g < strain_points; ++g)
    sum += strain_[g].weight * dot(by.by[a].spin[g], spun(g, now.axis[g], by.by[b].spin[g]));
  for (std::size_t g = 0; g < line_points; ++g) sum += line_mass_[g] * dot(by.by[a].place[g], by.by[b].place[g]);
  return sum;
}

// ---------------------------------------------------------------------------------------- of a model

void Model::read_beams() {
  for (const Beam& b : mechanism_.beams) {
    if (b.is_plane()) continue;
    std::vector<Real> lengths;
    const std::size_t first_piece = pieces_.size();
    for (std::size_t k = 0; k + 1 < b.nodes(); ++k) {
      BeamPiece piece;
      piece.element = BeamElement(b, k, mechanism_.ucf);
      const std::array<BodyRef, 5> parts = {b.node(k), b.node(k + 1), b.slope(k), b.slope(k + 1), b.middle(k)};
      for (std::size_t p = 0; p < parts.size(); ++p) piece.body[p] = static_cast<std::size_t>(body_index(parts[p]));
      lengths.push_back(piece.element.length());
      pieces_.push_back(piece);
    }
    const std::vector<LoadedSpan> spans = loaded_spans(b, lengths);
    for (std::size_t k = 0; k < spans.size(); ++k) pieces_[first_piece + k].span = spans[k];
  }
}

std::vector<Model::LoadedSpan> Model::loaded_spans(const Beam& beam, const std::vector<Real>& lengths) const {
  Real whole = 0, before = 0;
  for (const Real l : lengths) whole += l;
  std::vector<LoadedSpan> spans;
  for (const Real l : lengths) {
    LoadedSpan span;
    for (std::size_t k = 0; k < mechanism_.beam_loads.size(); ++k) {
      if (mechanism_.beam_loads[k].beam == beam.id) span.loads.push_back(k);
    }
    for (std::size_t g = 0; g < line_points; ++g) span.place[g] = (before + four_points()[g].at * l) / whole;
    const std::size_t k = spans.size();
    const std::array<BodyRef, 4> parts = {beam.node(k), beam.slope(k), beam.node(k + 1), beam.slope(k + 1)};
    for (std::size_t p = 0; p < parts.size(); ++p) span.body[p] = static_cast<std::size_t>(body_index(parts[p]));
    span.length = l;
    before += l;
    spans.push_back(span);
  }
  return spans;
}

LinePoint Model::line_point(const LoadedSpan& span, std::size_t point) const {
  LinePoint out{span.place[point], {}, {}};
  const auto factor = cubics(four_points()[point].at, span.length);
  for (std::size_t p = 0; p < span.body.size(); ++p) {
    const BodyMotion& m = motion[span.body[p]];
    out.motion[0] += factor[p] * m.p, out.motion[1] += factor[p] * m.v, out.motion[2] += factor[p] * m.a;
  }
  return out;
}

LineLoads Model::line_loads(const LoadedSpan& span, const Turnings& turnings) const {
  LineLoads out;
  for (const std::size_t l : span.loads) {
    const BeamLoad& load = mechanism_.beam_loads[l];
    const auto& axis = markers_[static_cast<std::size_t>(marker_index(load.rm))].axis;
    for (std::size_t g = 0; g < line_points; ++g) {
      LinePoint at = line_point(span, g);
      at.turning = turnings[g];
      for (std::size_t c = 0; c < 6; ++c) {
        if (!load.component[c]) continue;
        (c < 3 ? out.force : out.moment)[g] += evaluate_at(*load.component[c], at) * axis[c % 3];
      }
    }
  }
  return out;
}

BeamPose<Jet> Model::pose_along_motion(const BeamPiece& piece) const {
  const auto jets = [](const Vec& v, const Vec& d, const Vec& dd) {
    return Vector3<Jet>{{v.x, d.x, dd.x}, {v.y, d.y, dd.y}, {v.z, d.z, dd.z}};
  };
  const auto triple = [&](std::size_t p) {
    const BodyMotion& m = motion[piece.body[p]];
    return jets(m.p, m.v, m.a);
  };
  BeamPose<Jet> out;
  for (std::size_t end = 0; end < 2; ++end) {
    const BodyMotion& m = motion[piece.body[end]];
    out.r[end] = triple(end), out.s[end] = triple(2 + end);
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec& e = m.R.column[c];
      out.axis[end][c] = jets(e, cross(m.w, e), cross(m.al, e) + cross(m.w, cross(m.w, e)));
    }
  }
  out.phi = triple(4);
  return out;
}

namespace {

BeamPose<Real> still(const BeamPose<Jet>& p) {
  BeamPose<Real> out;
  for (std::size_t end = 0; end < 2; ++end) {
    out.r[end] = value(p.r[end]), out.s[end] = value(p.s[end]);
    for (std::size_t c = 0; c < 3; ++c) out.axis[end][c] = value(p.axis[end][c]);
  }
  out.phi = value(p.phi);
  return out;
}
// Which of the bodies of a piece has a coordinate, and whether it turns it.
struct Place {
  std::size_t part;
  bool turns;
};
constexpr std::array<Place, 7> triples = {
    {{0, false}, {0, true}, {1, false}, {1, true}, {2, false}, {3, false}, {4, false}}};

}  // namespace

const BeamDirections& Model::directions(std::size_t piece) const {
  if (beam_directions_.empty()) {
    for (const BeamPiece& p : pieces_) beam_directions_.push_back(p.element.directions(still(pose_along_motion(p))));
  }
  return beam_directions_[piece];
}

Model::Turnings Model::turnings_of(const BeamPiece& piece) const {
  Turnings out{};
  if (piece.span.loads.empty()) return out;
  const BeamShape<Jet> shape = piece.element.shape(pose_along_motion(piece));
  for (std::size_t g = 0; g < line_points; ++g) {
    const auto& axis = shape.line_axis[g];
    const Vec ex = value(axis[0]), ey = value(axis[1]), ez = value(axis[2]);
    out[g][0] = {std::atan2(ez.x, -ez.y), std::atan2(std::hypot(ez.x, ez.y), ez.z), std::atan2(ex.z, ey.z)};
    out[g][1] = spin(axis), out[g][2] = spin_rate(axis);
  }
  return out;
}

void Model::apply_beams(std::vector<Wrench>& loads) const {
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const BeamPiece& piece = pieces_[k];
    const BeamDirections& by = directions(k);
    std::array<Real, beam_freedoms> all = piece.element.loads(pose_along_motion(piece), by, to_vec(mechanism_.gravity));
    const auto more = piece.element.loads(line_loads(piece.span, turnings_of(piece)), by);
    for (std::size_t a = 0; a < beam_freedoms; ++a) all[a] += more[a];
    for (std::size_t t = 0; t < triples.size(); ++t) {
      Wrench& on = loads[piece.body[triples[t].part]];
      (triples[t].turns ? on.t : on.f) += Vec{all[3 * t], all[3 * t + 1], all[3 * t + 2]};
    }
  }
}

void Model::add_beam_masses(Dense& mass) const {
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const BeamPose<Real> pose = still(pose_along_motion(pieces_[k]));
    const auto row = [&](std::size_t a) {
      const Place& p = triples[a / 3];
      return static_cast<std::size_t>(bodies[pieces_[k].body[p.part]].offset + (p.turns ? 3 : 0)) + a % 3;
    };
    for (std::size_t a = 0; a < beam_freedoms; ++a) {
      for (std::size_t b = 0; b < beam_freedoms; ++b)
        mass(row(a), row(b)) += pieces_[k].element.mass(pose, directions(k), a, b);
    }
  }
}

}  // namespace dynalin::oracle
