#include "flexible/plane_beam.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flexible/beam_points.h"

namespace dynalin {

using beam::cubic_at, beam::four_places, beam::three_places, beam::three_weights;

namespace {

Eigen::Vector2d in(const BeamPlane& plane, const Vector& v) { return {v[plane.first], v[plane.second]}; }
Eigen::Vector2d quarter_turned(const Eigen::Vector2d& v) { return {-v(1), v(0)}; }
double angle_between(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(quarter_turned(from).dot(to), from.dot(to));
}

// Such that v_m = 1.5 chord/l − σ, σ = ¼ (s₁ + s₂), has the length 1.
double length_between(const BeamPlane& plane, const Vector& chord, const std::array<Matrix3, 2>& axes) {
  const Eigen::Vector2d c = in(plane, chord), mean = 0.25 * (in(plane, axes[0].x) + in(plane, axes[1].x));
  const double along = c.dot(mean), square = c.squaredNorm();
  return 1.5 * square / (along + std::sqrt(along * along + square * (1 - mean.squaredNorm())));
}

// About the normal of the plane, a direction across the beam.
double about_normal(const BeamSection& s, const BeamPlane& plane, const Matrix3& axes) {
  const double y = axes.y[plane.normal], z = axes.z[plane.normal];
  return z * z * s.zz + y * y * s.yy - 2 * y * z * s.yz;
}

// What angles at the ends and in the middle make of the angle at x.
Eigen::Vector3d shape_of_angle(double x) { return {0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)}; }
Eigen::Vector3d slope_of_angle(double x, double length) {
  return Eigen::Vector3d(x - 0.5, -2 * x, x + 0.5) * (2 / length);
}

}  // namespace

PlaneBeam::PlaneBeam(const BeamPlane& plane, const BeamMaterial& material, const std::array<BeamSection, 2>& sections,
                     const Vector& chord, const std::array<Matrix3, 2>& axes)
    : BeamElement(material, sections, length_between(plane, chord, axes)), plane_(plane) {
  const double by_chord = 1.5 / length();
  shares_ << 0, 1, 0, 0, -by_chord, -0.25, by_chord, -0.25, 0, 0, 0, 1;
  stretching_.setZero(), bending_.setZero();
  const std::array<double, 2> inertia = {about_normal(sections[0], plane, axes[0]),
                                         about_normal(sections[1], plane, axes[1])};
  for (std::size_t k = 0; k < three_places.size(); ++k) {
    const double x = three_places[k], weight = 0.5 * length() * three_weights[k] * material.E;
    const Eigen::Vector3d N = shape_of_angle(x), N1 = slope_of_angle(x, length());
    stretching_ += weight * section_at(x).area * N * N.transpose();
    bending_ += weight * 0.5 * ((1 - x) * inertia[0] + (1 + x) * inertia[1]) * N1 * N1.transpose();
  }
  const Eigen::Vector2d one = in(plane, axes[0].x), other = in(plane, axes[1].x),
                        middle = by_chord * in(plane, chord) - 0.25 * (one + other);
  undeformed_ << angle_between(middle, one), 0, angle_between(middle, other);
  for (std::size_t end = 0; end < 2; ++end) {
    const Matrix3& node = axes[end];
    roll_[end] = std::atan2(node.y[plane.normal], node.z[plane.normal]);
  }
  roll_[1] = roll_[0] + std::remainder(roll_[1] - roll_[0], 2 * std::numbers::pi);
}

PlaneBeam::Directions PlaneBeam::directions(const BeamMotion& m) const {
  const auto now = [&](const Vec3<BeamMotion::Scalar>& v) {
    return Eigen::Vector2d(v[plane_.first].value, v[plane_.second].value);
  };
  const auto rate = [&](const Vec3<BeamMotion::Scalar>& v) {
    return Eigen::Vector2d(v[plane_.first].rate, v[plane_.second].rate);
  };
  const auto direction = [](const Eigen::Vector2d& v, const Eigen::Vector2d& v1) {
    Direction d;
    d.size = v.norm();
    d.n = v / d.size, d.p = quarter_turned(d.n);
    d.size_rate = d.n.dot(v1), d.turn_rate = d.p.dot(v1) / d.size;
    return d;
  };
  const auto middle = [&](const auto& of) -> Eigen::Vector2d {
    return shares_(1, 2) * of(m.chord) - 0.25 * (of(m.slope[0]) + of(m.slope[1]));
  };
  return {direction(now(m.slope[0]), rate(m.slope[0])), direction(middle(now), middle(rate)),
          direction(now(m.slope[1]), rate(m.slope[1]))};
}

Eigen::Vector3d PlaneBeam::angles(const Directions& d) {
  return {angle_between(d[1].n, d[0].n), 0, angle_between(d[1].n, d[2].n)};
}

void PlaneBeam::add(const std::array<Eigen::Vector2d, 3>& on, BeamVector& out) const {
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Eigen::Vector2d f = shares_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(a)) * on[j];
      out(cubic_at[a] + static_cast<Eigen::Index>(plane_.first)) += f(0);
      out(cubic_at[a] + static_cast<Eigen::Index>(plane_.second)) += f(1);
    }
  }
}

void PlaneBeam::add(const Block& by, BeamMatrix& out) const {
  const std::array<Eigen::Index, 2> axis = {static_cast<Eigen::Index>(plane_.first),
                                            static_cast<Eigen::Index>(plane_.second)};
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t k = 0; k < 3; ++k)
          sum += shares_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(a)) *
                 shares_(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(b)) * by[j][k];
      }
      for (std::size_t r = 0; r < 2; ++r) {
        for (std::size_t c = 0; c < 2; ++c)
          out(cubic_at[a] + axis[r], cubic_at[b] + axis[c]) +=
              sum(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
      }
    }
  }
}

// With T and M the stresses on |v| and on the angles, f = T n + M p/|v| acts on a direction; n turns by p δα, and |v|
// changes by n·δv.
void PlaneBeam::forces(const BeamMotion& m, const Vector& gravity, Partials wanted, BeamForces& out) const {
  out.clear(wanted);
  const Directions d = directions(m);
  const double c = material().damping;
  Eigen::Vector3d stretch, turn = angles(d) - undeformed_;
  for (std::size_t j = 0; j < 3; ++j) {
    const auto k = static_cast<Eigen::Index>(j);
    stretch(k) = d[j].size - 1 + c * d[j].size_rate;
    turn(k) += c * d[j].turn_rate;
  }
  const Eigen::Vector3d T = stretching_ * stretch, M = bending_ * turn;
  std::array<Eigen::Vector2d, 3> on;
  for (std::size_t j = 0; j < 3; ++j) {
    const auto k = static_cast<Eigen::Index>(j);
    on[j] = T(k) * d[j].n + M(k) * d[j].of_angle();
  }
  add(on, out.elastic);
  add_translation(m, gravity, wanted, out);
  if (wanted == Partials::no) return;
  Block stiffness, damping;
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double A = stretching_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)),
                   B = bending_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k));
      const Eigen::RowVector2d by_size = (d[k].n + c * d[k].turn_rate * d[k].p).transpose(),
                               by_turn = (d[k].of_angle() + c * d[k].of_turn_rate()).transpose();
      stiffness[j][k] = A * d[j].n * by_size + B * d[j].of_angle() * by_turn;
      damping[j][k] = c * (A * d[j].n * d[k].n.transpose() + B * d[j].of_angle() * d[k].of_angle().transpose());
    }
    const auto at = static_cast<Eigen::Index>(j);
    stiffness[j][j] += T(at) / d[j].size * d[j].p * d[j].p.transpose() + M(at) * d[j].of_angle_twice();
  }
  add(stiffness, out.stiffness);
  add(damping, out.damping);
}

double PlaneBeam::largest_turn(const BeamMotion& m) const { return 2 * angles(directions(m)).cwiseAbs().maxCoeff(); }

bool PlaneBeam::turns_sections(std::size_t coordinate) const {
  return !is_beam_rotation(coordinate) && coordinate % 3 != plane_.normal;
}

BeamElement::Spins PlaneBeam::spins(const BeamMotion& m) const {
  Spins out{};
  const Directions d = directions(m);
  for (std::size_t g = 0; g < beam_load_points; ++g) {
    const Eigen::Vector3d N = shape_of_angle(four_places[g]);
    BeamVector by = BeamVector::Zero();
    add({N(0) * d[0].of_angle(), N(1) * d[1].of_angle(), N(2) * d[2].of_angle()}, by);
    for (std::size_t k = 0; k < coordinates(); ++k) out[g][k][plane_.normal] = by(static_cast<Eigen::Index>(k));
  }
  return out;
}

BeamElement::SectionMotion PlaneBeam::section_along(const BeamMotion& m, std::size_t load_point) const {
  using Scalar = BeamMotion::Scalar;
  struct Direction2 {
    Scalar first, second;
  };
  const auto in_plane = [&](const Vec3<Scalar>& v) { return Direction2{v[plane_.first], v[plane_.second]}; };
  const Direction2 one = in_plane(m.slope[0]), chord = in_plane(m.chord), other = in_plane(m.slope[1]);
  const auto middle = [&](const Scalar& c, const Scalar& s1, const Scalar& s2) {
    return shares_(1, 2) * c - 0.25 * (s1 + s2);
  };
  const std::array<Direction2, 3> v = {
      one, {middle(chord.first, one.first, other.first), middle(chord.second, one.second, other.second)}, other};
  const double x = four_places[load_point];
  const Eigen::Vector3d N = shape_of_angle(x);
  SectionMotion out{};
  Scalar angle = atan2(v[1].second, v[1].first);
  for (std::size_t j = 0; j < 3; ++j) {
    const double share = N(static_cast<Eigen::Index>(j));
    if (j != 1)
      angle += share * atan2(v[1].first * v[j].second - v[1].second * v[j].first,
                             v[1].first * v[j].first + v[1].second * v[j].second);
    // By v: a quarter of a turn from it, divided by |v|².
    const Scalar square = v[j].first * v[j].first + v[j].second * v[j].second;
    const Scalar by_first = (-share) * v[j].second / square, by_second = share * v[j].first / square;
    for (std::size_t a = 0; a < 4; ++a) {
      const double of_coordinate = shares_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(a));
      const auto at = static_cast<std::size_t>(cubic_at[a]);
      out.spin[at + plane_.first][plane_.normal] += of_coordinate * by_first;
      out.spin[at + plane_.second][plane_.normal] += of_coordinate * by_second;
    }
  }
  const double roll = 0.5 * ((1 - x) * roll_[0] + (1 + x) * roll_[1]);
  const Scalar c = cos(angle), s = sin(angle);
  out.axes.x[plane_.first] = c, out.axes.x[plane_.second] = s;
  out.axes.y[plane_.first] = -std::cos(roll) * s, out.axes.y[plane_.second] = std::cos(roll) * c;
  out.axes.y[plane_.normal] = Scalar(std::sin(roll));
  out.axes.z[plane_.first] = std::sin(roll) * s, out.axes.z[plane_.second] = -std::sin(roll) * c;
  out.axes.z[plane_.normal] = Scalar(std::cos(roll));
  return out;
}

BeamMatrix PlaneBeam::moments_by_position(const BeamMotion& m, const Moments& moments) const {
  const Directions d = directions(m);
  Eigen::Vector3d on = Eigen::Vector3d::Zero();
  for (std::size_t g = 0; g < beam_load_points; ++g) on += moments[g][plane_.normal] * shape_of_angle(four_places[g]);
  Block by;
  for (std::size_t j = 0; j < 3; ++j) {
    by[j].fill(Eigen::Matrix2d::Zero());
    by[j][j] = on(static_cast<Eigen::Index>(j)) * d[j].of_angle_twice();
  }
  BeamMatrix out = BeamMatrix::Zero();
  add(by, out);
  return out;
}

}  // namespace dynalin
