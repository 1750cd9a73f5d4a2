#include "plane_beams.h"

#include "model.h"

namespace dynalin::oracle {

namespace {

// About the normal, by less than half a turn.
template <class T>
T angle_between(const Vector3<T>& from, const Vector3<T>& to) {
  using std::atan2;
  return atan2(cross(from, to).z, dot(from, to));
}

template <class T>
Vector3<T> middle_slope(const PlanePose<T>& p, Real length) {
  return T(1.5L / length) * (p.r[1] - p.r[0]) - T(0.25L) * (p.s[0] + p.s[1]);
}

// Which coordinate: of the triples r1, s1, r2, s2, and along a or b.
struct Coordinate {
  std::size_t end;
  bool of_slope, along_b;
};
Coordinate coordinate(std::size_t k) { return {k / 4, (k / 2) % 2 == 1, k % 2 == 1}; }

// The integral of the squares of distances from the line through the centroid along the normal: those are
// N_z y - N_y z, where N_y and N_z are the components of the normal along y and z of the section.
Real second_moment(const Beam& beam, std::size_t k, const Vec& normal) {
  const Mat section = rotation_313(beam.reuler) * rotation_313(beam.angles[k]);
  const Real y = dot(normal, section.column[1]), z = dot(normal, section.column[2]);
  return z * z * beam.zz[k] + y * y * beam.yy[k] - 2 * y * z * beam.yz[k];
}

}  // namespace

PlaneAxes axes_of(BeamPlane plane) {
  switch (plane) {
    case BeamPlane::yz:
      return {1, 2, 0};
    case BeamPlane::zx:
      return {2, 0, 1};
    default:
      return {0, 1, 2};
  }
}

template <class T>
PlaneShape<T> PlaneElement::shape(const PlanePose<T>& p) const {
  using std::atan2;
  const Vector3<T> middle = middle_slope(p, length_);
  const T first = norm(p.s[0]) - T(1), half_way = norm(middle) - T(1), second = norm(p.s[1]) - T(1);
  const T to_first = angle_between(middle, p.s[0]), to_second = angle_between(middle, p.s[1]);
  PlaneShape<T> out;
  for (std::size_t g = 0; g < strain_points; ++g) {
    const Real xi = 2 * three_points()[g].at - 1;
    out.stretch[g] = T(xi * (xi - 1) / 2) * first + T((1 - xi) * (1 + xi)) * half_way + T(xi * (xi + 1) / 2) * second;
    out.curvature[g] = T(2 / length_) * (T(xi - 0.5L) * to_first + T(xi + 0.5L) * to_second);
  }
  for (std::size_t g = 0; g < line_points; ++g) {
    const Real x = four_points()[g].at, xi = 2 * x - 1;
    out.angle[g] = atan2(middle.y, middle.x) + T(xi * (xi - 1) / 2) * to_first + T(xi * (xi + 1) / 2) * to_second;
    const auto h = cubics(x, length_);
    out.place[g] = T(h[0]) * p.r[0] + T(h[1]) * p.s[0] + T(h[2]) * p.r[1] + T(h[3]) * p.s[1];
  }
  return out;
}
template PlaneShape<Real> PlaneElement::shape(const PlanePose<Real>& pose) const;
template PlaneShape<Jet> PlaneElement::shape(const PlanePose<Jet>& pose) const;

PlaneElement::PlaneElement(const Beam& beam, std::size_t k, Real ucf)
    : axes_(axes_of(beam.plane)), damping_(beam.damping) {
  const Mat bcs = rotation_313(beam.reuler);
  Vec normal;
  set_component(normal, axes_.normal, 1);
  PlanePose<Real> drawn;
  std::array<Real, 2> moment{};
  for (std::size_t end = 0; end < 2; ++end) {
    drawn.r[end] = in_plane(axes_, to_vec(beam.qg) + bcs * to_vec(beam.places[k + end]));
    drawn.s[end] = in_plane(axes_, bcs * rotation_313(beam.angles[k + end]).column[0]);
    moment[end] = second_moment(beam, k + end, normal);
  }
  // As long as makes the slope in the middle one of no stretch: |t chord - mean| = 1 with t = 1.5/l.
  const Vec chord = drawn.r[1] - drawn.r[0], mean = 0.25L * (drawn.s[0] + drawn.s[1]);
  const Real along = dot(chord, mean), square = dot(chord, chord);
  length_ = 1.5L * square / (along + std::sqrt(along * along + square * (1 - dot(mean, mean))));
  const PlaneShape<Real> undeformed = shape(drawn);
  const Real E = beam.youngs_modulus, density = beam.density / ucf;
  const auto area = [&](Real x) { return (1 - x) * beam.area[k] + x * beam.area[k + 1]; };
  for (std::size_t g = 0; g < strain_points; ++g) {
    const auto [x, weight] = three_points()[g];
    strain_[g] = {weight * length_, E * area(x), E * ((1 - x) * moment[0] + x * moment[1]), undeformed.curvature[g]};
  }
  for (std::size_t g = 0; g < line_points; ++g) {
    const auto [x, weight] = four_points()[g];
    line_weight_[g] = weight * length_;
    line_mass_[g] = line_weight_[g] * density * area(x);
  }
}

std::array<PlaneShape<Real>, plane_freedoms> PlaneElement::directions(const PlanePose<Real>& pose) const {
  const auto still = [](const Vec& v) { return Vector3<Jet>{v.x, v.y, v.z}; };
  std::array<PlaneShape<Real>, plane_freedoms> out;
  for (std::size_t k = 0; k < plane_freedoms; ++k) {
    const Coordinate c = coordinate(k);
    PlanePose<Jet> p;
    for (std::size_t end = 0; end < 2; ++end) p.r[end] = still(pose.r[end]), p.s[end] = still(pose.s[end]);
    Vector3<Jet>& moved = (c.of_slope ? p.s : p.r)[c.end];
    (c.along_b ? moved.y : moved.x).d = 1;
    const PlaneShape<Jet> there = shape(p);
    for (std::size_t g = 0; g < strain_points; ++g)
      out[k].stretch[g] = there.stretch[g].d, out[k].curvature[g] = there.curvature[g].d;
    for (std::size_t g = 0; g < line_points; ++g) {
      out[k].angle[g] = there.angle[g].d;
      out[k].place[g] = {there.place[g].x.d, there.place[g].y.d, 0};
    }
  }
  return out;
}

PlaneLoads PlaneElement::loads(const PlanePose<Jet>& along, const Vec& gravity) const {
  const PlaneShape<Jet> now = shape(along);
  PlanePose<Real> pose;
  for (std::size_t end = 0; end < 2; ++end) {
    pose.r[end] = {along.r[end].x.v, along.r[end].y.v, 0};
    pose.s[end] = {along.s[end].x.v, along.s[end].y.v, 0};
  }
  const auto by = directions(pose);
  const Vec g_plane = in_plane(axes_, gravity);
  PlaneLoads out{};
  for (std::size_t g = 0; g < strain_points; ++g) {
    const StrainPoint& p = strain_[g];
    const Real force = p.stretching * (now.stretch[g].v + damping_ * now.stretch[g].d);
    const Real moment = p.bending * (now.curvature[g].v - p.curvature + damping_ * now.curvature[g].d);
    for (std::size_t k = 0; k < plane_freedoms; ++k)
      out[k] -= p.weight * (force * by[k].stretch[g] + moment * by[k].curvature[g]);
  }
  for (std::size_t g = 0; g < line_points; ++g) {
    const Vec force = line_mass_[g] * (g_plane - Vec{now.place[g].x.dd, now.place[g].y.dd, 0});
    for (std::size_t k = 0; k < plane_freedoms; ++k) out[k] += dot(force, by[k].place[g]);
  }
  return out;
}

PlaneLoads PlaneElement::loads(const PlanePose<Real>& pose, const LineLoads& on) const {
  const auto by = directions(pose);
  PlaneLoads out{};
  for (std::size_t g = 0; g < line_points; ++g) {
    const Vec force = in_plane(axes_, on.force[g]);
    const Real moment = component(on.moment[g], axes_.normal);
    for (std::size_t k = 0; k < plane_freedoms; ++k)
      out[k] += line_weight_[g] * (dot(force, by[k].place[g]) + moment * by[k].angle[g]);
  }
  return out;
}

Real PlaneElement::mass(std::size_t a, std::size_t b) const {
  if (coordinate(a).along_b != coordinate(b).along_b) return 0;
  Real sum = 0;
  for (std::size_t g = 0; g < line_points; ++g) {
    const auto h = cubics(four_points()[g].at, length_);
    sum += line_mass_[g] * h[a / 2] * h[b / 2];
  }
  return sum;
}

}  // namespace dynalin::oracle
