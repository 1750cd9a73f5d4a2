#include "flexible/spatial_beam.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace dynalin::spatial_beam_test {

namespace {

using Scalar = BeamMotion::Scalar;

const BeamMaterial material{3.0, 200.0, 80.0, 0.07};
const BeamSection thick{1.5, 0.9, 0.4, 0.7, 0.15, 1.2, 1.3}, thin{1.1, 0.6, 0.3, 0.5, -0.1, 1.1, 1.4};

Matrix3 turn(const Vector& a) { return rotation::exponential(a); }

SpatialBeam element() {
  return {material, {thick, thin}, {1.9, 0.2, -0.1}, {turn({0.1, 0.05, -0.1}), turn({-0.2, -0.1, 0.3})}};
}

// All coordinates, which may depend on time.
template <class T>
struct Place {
  std::array<Vec3<T>, 2> r;
  std::array<Mat3<T>, 2> axes;
  std::array<Vec3<T>, 2> slope;
  Vec3<T> middle;
};
template <class T>
Place<T> at(const T& t) {
  const T u = t * t;
  return {{Vec3<T>{0.3 + 0.2 * t, -0.1 * t + u, 0.4 * u}, Vec3<T>{2.3 - 0.3 * t, 0.4 + 0.5 * t - u, 0.3 * t}},
          {rotation::exponential(Vec3<T>{0.2 + t, 0.3 - 0.4 * t, -0.1 + 0.3 * u}),
           rotation::exponential(Vec3<T>{0.5 - 0.6 * t, 0.4 * t, 0.3 + 0.7 * t - u})},
          {Vec3<T>{1.02 + 0.1 * t, 0.1 + 0.2 * u, -0.2 * t}, Vec3<T>{T(0.97), 0.3 - 0.3 * t, 0.2 * u - 0.1}},
          {0.05 + 0.2 * t, -0.03 + 0.1 * u, 0.04 - 0.3 * t}};
}
template <class T>
Place<T> moved(Place<T> p, std::size_t coordinate, const T& by) {
  Vec3<T> e{T(0.0), T(0.0), T(0.0)};
  e[coordinate % 3] = by;
  switch (coordinate / 3) {
    case 0:
      p.r[0] += e;
      break;
    case 1:
      p.axes[0] = rotation::exponential(e) * p.axes[0];
      break;
    case 2:
      p.r[1] += e;
      break;
    case 3:
      p.axes[1] = rotation::exponential(e) * p.axes[1];
      break;
    case 4:
      p.slope[0] += e;
      break;
    case 5:
      p.slope[1] += e;
      break;
    default:
      p.middle += e;
  }
  return p;
}
Scalar time_at(double t) { return {t, 1, 0}; }

BeamMotion motion_of(const Place<Scalar>& p) {
  const auto acceleration = [](const Vec3<Scalar>& v) {
    return Vector{v.x.acceleration, v.y.acceleration, v.z.acceleration};
  };
  return {p.r[1] - p.r[0], {acceleration(p.r[0]), acceleration(p.r[1])}, p.axes, p.slope, p.middle};
}
BeamMotion still(const Place<double>& p) {
  const auto constant = [](const Vector& v) { return Vec3<Scalar>{Scalar(v.x), Scalar(v.y), Scalar(v.z)}; };
  BeamMotion m;
  m.chord = constant(p.r[1] - p.r[0]);
  m.middle = constant(p.middle);
  for (std::size_t k = 0; k < 2; ++k) {
    m.axes[k] = {constant(p.axes[k].x), constant(p.axes[k].y), constant(p.axes[k].z)};
    m.slope[k] = constant(p.slope[k]);
  }
  return m;
}

const Vector gravity{0.3, -0.7, 1.1};

// Strain energy of a place by the formulas of the header alone: curvatures by differences.
double strain_energy(const SpatialBeam& e, const Place<double>& p) {
  const std::array<Matrix3, 2> drawn = {turn({0.1, 0.05, -0.1}), turn({-0.2, -0.1, 0.3})};
  const double l = e.length();
  const std::array<double, 3> places = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weights = {5. / 9, 8. / 9, 5. / 9};
  const auto strains = [&](const Vector& chord, const std::array<Matrix3, 2>& R, const std::array<Vector, 2>& slope,
                           const Vector& phi, double x) {
    const Matrix3 middle = R[0] * turn(0.5 * rotation::logarithm(transpose(R[0]) * R[1])) * turn(phi);
    const auto axes = [&](double y) {
      return middle * turn((0.5 * y * (y - 1)) * rotation::logarithm(transpose(middle) * R[0]) +
                           (0.5 * y * (y + 1)) * rotation::logarithm(transpose(middle) * R[1]));
    };
    // The strain in the middle by Newton's method on where the line ends, which is linear.
    const Vector first = transpose_times(R[0], slope[0]), last = transpose_times(R[1], slope[1]);
    const auto strain = [&](const Vector& half, double y) {
      return (0.5 * y * (y - 1)) * first + (1 - y * y) * half + (0.5 * y * (y + 1)) * last;
    };
    const auto end = [&](const Vector& half) {
      Vector sum;
      for (std::size_t k = 0; k < 3; ++k) sum += (0.5 * l * weights[k]) * (axes(places[k]) * strain(half, places[k]));
      return sum;
    };
    Eigen::Matrix3d by;
    const Vector off = chord - end({});
    for (std::size_t c = 0; c < 3; ++c) {
      Vector unit;
      unit[c] = 1;
      const Vector column = end(unit) - end({});
      for (std::size_t r = 0; r < 3; ++r) by(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = column[r];
    }
    const Eigen::Vector3d half = by.lu().solve(Eigen::Vector3d(off.x, off.y, off.z));
    const double h = 1e-5;
    const Vector kappa = (1 / (2 * h) * 2 / l) * rotation::logarithm(transpose(axes(x - h)) * axes(x + h));
    return std::pair{strain({half(0), half(1), half(2)}, x), kappa};
  };
  double energy = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = places[k], b = 0.5 * (1 + x), a = 1 - b;
    const auto now = strains(p.r[1] - p.r[0], p.axes, p.slope, p.middle, x);
    const auto before = strains({1.9, 0.2, -0.1}, drawn, {drawn[0].x, drawn[1].x}, {}, x);
    const Vector g = now.first - before.first, c = now.second - before.second;
    const auto mean = [&](double BeamSection::*what) { return a * (thick.*what) + b * (thin.*what); };
    const double A = mean(&BeamSection::area), E = material.E, G = material.G;
    energy += 0.25 * l * weights[k] *
              (E * A * g.x * g.x + G * A / mean(&BeamSection::shear_y) * g.y * g.y +
               G * A / mean(&BeamSection::shear_z) * g.z * g.z + G * mean(&BeamSection::torsion) * c.x * c.x +
               E * (mean(&BeamSection::yy) * c.y * c.y + mean(&BeamSection::zz) * c.z * c.z -
                    2 * mean(&BeamSection::yz) * c.y * c.z));
  }
  return energy;
}

}  // namespace

TEST(spatial_beam, forces_are_the_slopes_of_the_strain_energy) {
  const SpatialBeam e = element();
  const Place<double> p = at(0.2);
  BeamForces f;
  e.forces(still(p), {}, Partials::no, f);
  constexpr double h = 1e-5;
  for (std::size_t k = 0; k < beam_coordinates; ++k) {
    const double slope = (strain_energy(e, moved(p, k, h)) - strain_energy(e, moved(p, k, -h))) / (2 * h);
    EXPECT_NEAR(f.elastic(static_cast<Eigen::Index>(k)), slope, 2e-7 * f.elastic.norm()) << k;
  }
}

// The path of all coordinates is varied as the partials mean it: places by ε, rates by ε t, accelerations by ½ ε t².
TEST(spatial_beam, partials_are_those_of_the_forces_along_varied_motions) {
  const SpatialBeam e = element();
  constexpr double t0 = 0.2, h = 1e-6;
  BeamForces f;
  e.forces(motion_of(at(time_at(t0))), gravity, Partials::yes, f);
  for (std::size_t k = 0; k < beam_coordinates; ++k) {
    for (int level = 0; level < 3; ++level) {
      const auto forces = [&](double by) {
        const Scalar varies = level == 0 ? Scalar(by) : level == 1 ? Scalar{0, by, 0} : Scalar{0, 0, by};
        BeamForces out;
        e.forces(motion_of(moved(at(time_at(t0)), k, varies)), gravity, Partials::no, out);
        return out;
      };
      const BeamForces plus = forces(h), minus = forces(-h);
      const auto at_k = static_cast<Eigen::Index>(k);
      const BeamVector elastic = (plus.elastic - minus.elastic) / (2 * h),
                       inertia = (plus.inertia - minus.inertia) / (2 * h);
      const BeamVector zero = BeamVector::Zero();
      const BeamVector& want_elastic = level == 0   ? BeamVector(f.stiffness.col(at_k))
                                       : level == 1 ? BeamVector(f.damping.col(at_k))
                                                    : zero;
      const BeamVector want_inertia = level == 0   ? BeamVector(f.by_position.col(at_k))
                                      : level == 1 ? BeamVector(f.by_rate.col(at_k))
                                                   : BeamVector(f.mass.col(at_k));
      EXPECT_LT((elastic - want_elastic).norm(), 1e-8 * f.stiffness.norm()) << k << " level " << level;
      EXPECT_LT((inertia - want_inertia).norm(), 1e-8 * f.mass.norm()) << k << " level " << level;
    }
  }
}

TEST(spatial_beam, power_of_its_inertia_is_the_rate_of_kinetic_energy) {
  const SpatialBeam e = element();
  constexpr double t0 = 0.2, h = 1e-4;
  const auto velocity = [&](double t) {
    const Place<Scalar> p = at(time_at(t));
    BeamVector v;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      for (std::size_t node = 0; node < 2; ++node) {
        const auto first = static_cast<Eigen::Index>(6 * node);
        v(first + i) = p.r[node][k].rate;
        v(12 + 3 * static_cast<Eigen::Index>(node) + i) = p.slope[node][k].rate;
        const auto& R = p.axes[node];
        const std::size_t i1 = (k + 1) % 3, i2 = (k + 2) % 3;  // ω = ½ Σ a × a′
        double w = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
          w += 0.5 * (R[axis][i1].value * R[axis][i2].rate - R[axis][i2].value * R[axis][i1].rate);
        v(first + 3 + i) = w;
      }
      v(18 + i) = p.middle[k].rate;
    }
    return v;
  };
  const auto energy = [&](double t) {
    double sum = 0;
    for (const double x : e.kinetic_terms(motion_of(at(time_at(t))), velocity(t))) sum += 0.5 * x;
    return sum;
  };
  BeamForces f;
  e.forces(motion_of(at(time_at(t0))), {}, Partials::no, f);
  EXPECT_NEAR(f.inertia.dot(velocity(t0)), (energy(t0 + h) - energy(t0 - h)) / (2 * h), 1e-5 * energy(t0));
  const BeamVector v = velocity(t0);
  EXPECT_NEAR(0.5 * v.dot(e.mass_matrix(motion_of(at(time_at(t0)))) * v), energy(t0), 1e-12 * energy(t0));
}

TEST(spatial_beam, turned_and_moved_as_a_whole_is_not_strained) {
  const SpatialBeam e = element();
  const Matrix3 R = turn({2.1, -1.3, 0.8});
  Place<double> p;
  const std::array<Matrix3, 2> drawn = {turn({0.1, 0.05, -0.1}), turn({-0.2, -0.1, 0.3})};
  p.r = {Vector{5, -7, 3}, Vector{5, -7, 3} + R * Vector{1.9, 0.2, -0.1}};
  for (std::size_t k = 0; k < 2; ++k) p.axes[k] = R * drawn[k], p.slope[k] = R * drawn[k].x;
  BeamForces f;
  e.forces(still(p), {}, Partials::no, f);
  EXPECT_LT(f.elastic.norm(), 1e-12 * material.E);
}

TEST(spatial_beam, weight_and_inertia_of_a_translation_are_those_of_its_mass) {
  const SpatialBeam e = element();
  BeamMotion m = still(at(0.2));
  m.acceleration = {Vector{1, 2, 3}, Vector{1, 2, 3}};
  BeamForces f;
  e.forces(m, gravity, Partials::no, f);
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_NEAR(f.inertia(k) + f.inertia(6 + k),
                e.mass() * (static_cast<double>(k) + 1 - gravity[static_cast<std::size_t>(k)]), 1e-6 * e.mass());
  }
  EXPECT_NEAR(e.nodal_mass(0) + e.nodal_mass(1), e.mass(), 1e-14 * e.mass());
}

TEST(spatial_beam, between_nodes_of_an_arc_is_as_long_as_the_arc) {
  for (const double angle : {0.05, 0.2}) {
    const Vector chord{std::sin(angle), 1 - std::cos(angle), 0};
    const SpatialBeam e(material, {thick, thick}, chord, {Matrix3::identity(), turn({0, 0, angle})});
    EXPECT_NEAR(e.length(), angle, 1e-5 * std::pow(angle, 6));
  }
}

}  // namespace dynalin::spatial_beam_test
