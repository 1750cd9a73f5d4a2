#include "flexible/plane_beam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "flexible/beam_load.h"

namespace dynalin::plane_beam_test {

namespace {

using Scalar = BeamMotion::Scalar;

const BeamMaterial material{3.0, 200.0, 80.0, 0.07};
const BeamSection thick{1.5, 0.9, 0.4, 0.7, 0.15, 1.2, 1.3}, thin{1.1, 0.6, 0.3, 0.5, -0.1, 1.1, 1.4};
constexpr BeamPlane xy{0, 1, 2}, yz{1, 2, 0}, zx{2, 0, 1};
const Vector gravity{0.3, -0.7, 1.1};

// An angle in the plane, then one about the beam.
struct Ends {
  std::array<double, 2> heading, roll;
};
constexpr Ends skewed{{0.2, -0.3}, {0.4, -0.5}};

// Axes whose x leads along the heading in the plane and whose y and z are rolled about it.
Matrix3 axes_in(const BeamPlane& p, double heading, double roll) {
  Vector x, across, normal;
  x[p.first] = std::cos(heading), x[p.second] = std::sin(heading);
  across[p.first] = -std::sin(heading), across[p.second] = std::cos(heading);
  normal[p.normal] = 1;
  return {x, std::cos(roll) * across + std::sin(roll) * normal, std::cos(roll) * normal - std::sin(roll) * across};
}
Vector in(const BeamPlane& p, double a, double b) {
  Vector v;
  v[p.first] = a, v[p.second] = b;
  return v;
}
PlaneBeam element(const BeamPlane& p, const Ends& e = skewed, double c = 0.07) {
  BeamMaterial damped = material;
  damped.damping = c;
  return {p,
          damped,
          {thick, thin},
          in(p, 1.9, 0.2),
          {axes_in(p, e.heading[0], e.roll[0]), axes_in(p, e.heading[1], e.roll[1])}};
}

// r₁, s₁, r₂, s₂ in the plane, with rates and accelerations.
using Eight = std::array<Scalar, 8>;
Eight far_bent() {
  return {Scalar{0.3, 0.2, -0.4}, {-0.1, -0.5, 0.6}, {1.02, 0.4, 0.1}, {0.5, -0.9, 0.2},
          {1.7, -0.3, 0.7},       {1.1, 0.8, -0.2},  {0.4, 0.6, 0.9},  {0.93, -0.2, 0.3}};
}
BeamMotion motion_of(const BeamPlane& p, const Eight& q) {
  const auto vector = [&](std::size_t at) {
    Vec3<Scalar> v{Scalar(0.0), Scalar(0.0), Scalar(0.0)};
    v[p.first] = q[at], v[p.second] = q[at + 1];
    return v;
  };
  const auto acceleration = [](const Vec3<Scalar>& v) {
    return Vector{v.x.acceleration, v.y.acceleration, v.z.acceleration};
  };
  BeamMotion m{};
  m.chord = vector(4) - vector(0);
  m.acceleration = {acceleration(vector(0)), acceleration(vector(4))};
  m.slope = {vector(2), vector(6)};
  return m;
}
// Where they stand among the coordinates of an element.
Eigen::Index place(const BeamPlane& p, std::size_t k) {
  static constexpr std::array<std::size_t, 4> first = {0, 12, 6, 15};
  return static_cast<Eigen::Index>(first[k / 2] + (k % 2 == 0 ? p.first : p.second));
}
Eight values_of(const Eight& q) {
  Eight still;
  for (std::size_t k = 0; k < 8; ++k) still[k] = Scalar(q[k].value);
  return still;
}
Eight moved(Eight q, std::size_t k, double by, int level) {
  q[k] += level == 0 ? Scalar(by) : level == 1 ? Scalar{0, by, 0} : Scalar{0, 0, by};
  return q;
}

// The formulas of the header over lengths and angles found on their own.
struct Line {
  std::array<double, 3> size, angle;
  Line(const Eight& q, double l) {
    const auto at = [&](std::size_t k) { return std::complex<double>(q[k].value, q[k + 1].value); };
    const std::array<std::complex<double>, 3> v = {at(2), 1.5 / l * (at(4) - at(0)) - 0.25 * (at(2) + at(6)), at(6)};
    for (std::size_t k = 0; k < 3; ++k) size[k] = std::abs(v[k]), angle[k] = std::arg(v[k] / v[1]);
  }
};
double strain_energy(const PlaneBeam& e, const Eight& q, const Ends& ends = skewed) {
  const double l = e.length();
  Eight drawn;
  const std::array<double, 8> at = {0,   0,   std::cos(ends.heading[0]), std::sin(ends.heading[0]),
                                    1.9, 0.2, std::cos(ends.heading[1]), std::sin(ends.heading[1])};
  for (std::size_t k = 0; k < 8; ++k) drawn[k] = Scalar(at[k]);
  const Line now(q, l), before(drawn, l);
  // Simpson's rule on so many intervals is exact to rounding.
  constexpr int n = 400;
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double x = -1 + 2.0 * k / n, a = 0.5 * (1 - x), b = 0.5 * (1 + x);
    const auto inertia = [&](const BeamSection& s, double roll) {
      const double y = std::sin(roll), z = std::cos(roll);
      return z * z * s.zz + y * y * s.yy - 2 * y * z * s.yz;
    };
    const double A = a * thick.area + b * thin.area,
                 I = a * inertia(thick, ends.roll[0]) + b * inertia(thin, ends.roll[1]);
    const auto stretch = [&](const Line& of) {
      return 0.5 * x * (x - 1) * of.size[0] + (1 - x * x) * of.size[1] + 0.5 * x * (x + 1) * of.size[2] - 1;
    };
    const auto bending = [&](const Line& of) { return 2 / l * ((x - 0.5) * of.angle[0] + (x + 0.5) * of.angle[2]); };
    const double eps = stretch(now) - stretch(before), kappa = bending(now) - bending(before);
    sum += (k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2) * 0.5 * material.E * (A * eps * eps + I * kappa * kappa);
  }
  return sum * l / n / 3;
}

}  // namespace

TEST(plane_beam, forces_are_the_slopes_of_the_strain_energy) {
  const Eight q = values_of(far_bent());
  const PlaneBeam e = element(xy);
  BeamForces f;
  e.forces(motion_of(xy, q), {}, Partials::no, f);
  constexpr double h = 1e-5;
  double found = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    const double slope = (strain_energy(e, moved(q, k, h, 0)) - strain_energy(e, moved(q, k, -h, 0))) / (2 * h);
    EXPECT_NEAR(f.elastic(place(xy, k)), slope, 1e-7 * f.elastic.norm()) << k;
    found += slope * slope;
  }
  EXPECT_NEAR(found, f.elastic.squaredNorm(), 1e-6 * found) << "nothing acts on other coordinates";
}

// Places are varied by ε, rates by ε and accelerations by ε each on its own.
TEST(plane_beam, partials_are_those_of_the_forces_along_varied_motions) {
  for (const BeamPlane& p : {xy, yz, zx}) {
    const PlaneBeam e = element(p);
    BeamForces f;
    e.forces(motion_of(p, far_bent()), gravity, Partials::yes, f);
    constexpr double h = 1e-6;
    for (std::size_t k = 0; k < 8; ++k) {
      for (int level = 0; level < 3; ++level) {
        const auto forces = [&](double by) {
          BeamForces out;
          e.forces(motion_of(p, moved(far_bent(), k, by, level)), gravity, Partials::no, out);
          return out;
        };
        const BeamForces plus = forces(h), minus = forces(-h);
        const BeamVector elastic = (plus.elastic - minus.elastic) / (2 * h),
                         inertia = (plus.inertia - minus.inertia) / (2 * h), zero = BeamVector::Zero();
        const auto at = place(p, k);
        EXPECT_LT((elastic - (level == 0   ? BeamVector(f.stiffness.col(at))
                              : level == 1 ? BeamVector(f.damping.col(at))
                                           : zero))
                      .norm(),
                  1e-8 * f.stiffness.norm())
            << k << " level " << level;
        EXPECT_LT((inertia - (level == 2 ? BeamVector(f.mass.col(at)) : zero)).norm(), 1e-8 * f.mass.norm())
            << k << " level " << level;
      }
    }
    EXPECT_LT((f.mass - e.mass_matrix(motion_of(p, far_bent()))).norm(), 1e-15 * f.mass.norm());
    EXPECT_EQ(f.by_position.norm() + f.by_rate.norm(), 0);
  }
}

TEST(plane_beam, is_the_same_in_every_plane) {
  BeamForces one, other;
  element(xy).forces(motion_of(xy, far_bent()), {}, Partials::yes, one);
  for (const BeamPlane& p : {yz, zx}) {
    element(p).forces(motion_of(p, far_bent()), {}, Partials::yes, other);
    for (std::size_t k = 0; k < 8; ++k) {
      EXPECT_NEAR(one.elastic(place(xy, k)), other.elastic(place(p, k)), 1e-12 * one.elastic.norm());
      for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_NEAR(one.stiffness(place(xy, k), place(xy, i)), other.stiffness(place(p, k), place(p, i)),
                    1e-12 * one.stiffness.norm());
      }
    }
  }
}

// Euler's and Bernoulli's: bending by 4, 6 and 12 EI, stretch of the parabola of slopes and chord by E A.
TEST(plane_beam, small_strains_of_a_straight_one_are_those_of_the_cubic) {
  const double l = 2, E = 200;
  const PlaneBeam e(xy, {3, E, 80, 0}, {thick, thick}, {l, 0, 0}, {Matrix3::identity(), Matrix3::identity()});
  EXPECT_NEAR(e.length(), l, 1e-15);
  Eight q;
  for (Scalar& x : q) x = Scalar(0.0);
  q[2] = q[6] = Scalar(1.0), q[4] = Scalar(l);
  BeamForces f;
  e.forces(motion_of(xy, q), {}, Partials::yes, f);
  EXPECT_LT(f.elastic.norm(), 1e-12);
  const std::array<std::size_t, 4> across = {1, 3, 5, 7}, along = {0, 2, 4, 6};
  const std::array<std::array<double, 4>, 4> bends = {{{12, 6 * l, -12, 6 * l},
                                                       {6 * l, 4 * l * l, -6 * l, 2 * l * l},
                                                       {-12, -6 * l, 12, -6 * l},
                                                       {6 * l, 2 * l * l, -6 * l, 4 * l * l}}};
  // ∫ h′_a h′_b of the cubics h, the same as of a beam under tension.
  const std::array<std::array<double, 4>, 4> stretches = {{{36, 3 * l, -36, 3 * l},
                                                           {3 * l, 4 * l * l, -3 * l, -l * l},
                                                           {-36, -3 * l, 36, -3 * l},
                                                           {3 * l, -l * l, -3 * l, 4 * l * l}}};
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      EXPECT_NEAR(f.stiffness(place(xy, across[a]), place(xy, across[b])), E * thick.zz / (l * l * l) * bends[a][b],
                  1e-10);
      EXPECT_NEAR(f.stiffness(place(xy, along[a]), place(xy, along[b])), E * thick.area / (30 * l) * stretches[a][b],
                  1e-10);
      EXPECT_NEAR(f.stiffness(place(xy, across[a]), place(xy, along[b])), 0, 1e-12);
    }
  }
}

TEST(plane_beam, moved_and_turned_in_the_plane_is_not_strained) {
  const PlaneBeam e = element(xy);
  const std::complex<double> turn = std::polar(1.0, 2.3), away(5, -7);
  const auto put = [](Eight& q, std::size_t k, std::complex<double> v) {
    q[k] = Scalar(v.real()), q[k + 1] = Scalar(v.imag());
  };
  Eight q;
  put(q, 0, away), put(q, 4, away + turn * std::complex<double>(1.9, 0.2));
  put(q, 2, turn * std::polar(1.0, skewed.heading[0])), put(q, 6, turn * std::polar(1.0, skewed.heading[1]));
  BeamForces f;
  e.forces(motion_of(xy, q), {}, Partials::no, f);
  EXPECT_LT(f.elastic.norm(), 1e-12 * material.E);
  q = far_bent();
  e.forces(motion_of(xy, values_of(q)), {}, Partials::no, f);
  EXPECT_GT(f.elastic.norm(), 1e-2 * material.E);
}

// A moment bends a straight element into an arc: with |v_m| = 1 at the half of the turn nothing stretches, and the
// moment is EI times turn by length whatever the turn, on the slope across it.
TEST(plane_beam, pure_bending_is_exact_however_far_it_goes) {
  const double l = 2, E = 200;
  const PlaneBeam e(xy, {3, E, 80, 0}, {thick, thick}, {l, 0, 0}, {Matrix3::identity(), Matrix3::identity()});
  for (const double turn : {0.1, 1.0, 2.5}) {
    const std::complex<double> end = std::polar(1.0, turn), half = std::polar(1.0, turn / 2),
                               chord = l / 1.5 * (half + 0.25 * (1.0 + end));
    Eight q;
    const std::array<double, 8> at = {0, 0, 1, 0, chord.real(), chord.imag(), end.real(), end.imag()};
    for (std::size_t k = 0; k < 8; ++k) q[k] = Scalar(at[k]);
    BeamForces f;
    e.forces(motion_of(xy, q), {}, Partials::no, f);
    const double moment = E * thick.zz * turn / l;
    EXPECT_NEAR(f.elastic(place(xy, 3)), -moment, 1e-11 * moment);
    EXPECT_NEAR(f.elastic(place(xy, 6)), -moment * end.imag(), 1e-11 * moment);
    EXPECT_NEAR(f.elastic(place(xy, 7)), moment * end.real(), 1e-11 * moment);
    for (const std::size_t k : {0u, 1u, 2u, 4u, 5u}) EXPECT_NEAR(f.elastic(place(xy, k)), 0, 1e-11 * moment) << k;
    EXPECT_NEAR(e.largest_turn(motion_of(xy, q)), turn, 1e-14);
  }
}

TEST(plane_beam, between_nodes_of_an_arc_is_as_long_as_the_arc) {
  for (const double angle : {0.05, 0.2}) {
    const PlaneBeam e(xy, material, {thick, thick}, {std::sin(angle), 1 - std::cos(angle), 0},
                      {axes_in(xy, 0, 0), axes_in(xy, angle, 0)});
    EXPECT_NEAR(e.length(), angle, 1e-3 * std::pow(angle, 5));
  }
}

TEST(plane_beam, weight_and_inertia_of_a_translation_are_those_of_its_mass) {
  const PlaneBeam e = element(yz);
  BeamMotion m = motion_of(yz, values_of(far_bent()));
  m.acceleration = {Vector{1, 2, 3}, Vector{1, 2, 3}};
  BeamForces f;
  e.forces(m, gravity, Partials::no, f);
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_NEAR(f.inertia(k) + f.inertia(6 + k),
                e.mass() * (static_cast<double>(k) + 1 - gravity[static_cast<std::size_t>(k)]), 1e-12 * e.mass());
  }
}

// Moments along it work on the angle of the line.
TEST(plane_beam, moments_work_on_the_turning_of_sections) {
  constexpr double h = 1e-5;
  for (const BeamPlane& p : {xy, zx}) {
    const PlaneBeam e = element(p);
    const Eight q = values_of(far_bent());
    const std::array<Vector, beam_load_points> moments = {Vector{1, -2, 3}, {0.5, 2, -1}, {-2, 1, 1}, {0.3, -1, 0.7}};
    const auto points = beam_load_points_of(e, motion_of(p, q), true);
    const BeamMatrix partials = beam_moments_by_position(e, motion_of(p, q), moments);
    EXPECT_GT(partials.norm(), 0.1);
    for (std::size_t k = 0; k < 8; ++k) {
      const auto loads = [&](double by) {
        BeamVector sum = BeamVector::Zero();
        const auto there = beam_load_points_of(e, motion_of(p, moved(q, k, by, 0)), true);
        for (std::size_t g = 0; g < beam_load_points; ++g) there[g].add({}, moments[g], sum);
        return sum;
      };
      EXPECT_LT((partials.col(place(p, k)) - (loads(h) - loads(-h)) / (2 * h)).norm(), 1e-8) << k;
      EXPECT_TRUE(e.turns_sections(static_cast<std::size_t>(place(p, k))));
      for (std::size_t g = 0; g < beam_load_points; ++g) {
        const double x = 2 * beam_load_place(g) - 1, weight = points[g].line[0] + points[g].line[2];
        const auto angle = [&](double by) {
          const Eight there = moved(q, k, by, 0);
          const Line line(there, e.length());
          const std::complex<double> middle =
              1.5 / e.length() *
                  std::complex<double>(there[4].value - there[0].value, there[5].value - there[1].value) -
              0.25 * std::complex<double>(there[2].value + there[6].value, there[3].value + there[7].value);
          return std::arg(middle) + 0.5 * x * (x - 1) * line.angle[0] + 0.5 * x * (x + 1) * line.angle[2];
        };
        EXPECT_NEAR(points[g].turning[static_cast<std::size_t>(place(p, k))][p.normal],
                    weight * (angle(h) - angle(-h)) / (2 * h), 1e-8);
      }
    }
  }
}

}  // namespace dynalin::plane_beam_test
