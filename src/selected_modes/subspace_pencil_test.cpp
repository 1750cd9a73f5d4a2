#include "selected_modes/subspace_pencil.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <numbers>

#include "eigenvalues/eigen.h"
#include "selected_modes/phased_subspace.h"
#include "system/model_test_support.h"

namespace dynalin::subspace_pencil_test {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

// Three pendulums in a row on springs, at rest in equilibrium: positions and rates of three hinges.
constexpr const char* hanging = R"(
MARKER/10, PART=1, REULER=0D,90D,0D
PART/2, MASS=2, CM=20, IP=0.1,0.2,0.3
MARKER/20, PART=2, QP=0,0,-1
MARKER/21, PART=2, REULER=0D,90D,0D
MARKER/22, PART=2, QP=0,0,-2, REULER=0D,90D,0D
PART/3, MASS=1, CM=30, IP=0.1,0.2,0.3
MARKER/30, PART=3, QP=0,0,-2.5
MARKER/31, PART=3, QP=0,0,-2, REULER=0D,90D,0D
MARKER/32, PART=3, QP=0,0,-3, REULER=0D,90D,0D
PART/4, MASS=3, CM=40, IP=0.1,0.2,0.3
MARKER/40, PART=4, QP=0,0,-3.5
MARKER/41, PART=4, QP=0,0,-3, REULER=0D,90D,0D
JOINT/1, REVOLUTE, I=21, J=10
JOINT/2, REVOLUTE, I=31, J=22
JOINT/3, REVOLUTE, I=41, J=32
SPRINGDAMPER/1, ROTATION, I=21, J=1, KT=5
SPRINGDAMPER/2, ROTATION, I=41, J=32, KT=7
ACCGRAV/KGRAV=-9.81
)";

struct Conservative {
  std::shared_ptr<const System> system = system_test::system_of(hanging);
  Perturbation perturbation;
  std::shared_ptr<const ConservativeModel> model;
  Eigen::MatrixXd A;

  Conservative() {
    Findings findings;
    perturbation = perturb(*system, initial_conditions(*system, findings).value(), {}).value();
    model = ConservativeModel::make(perturbation);
    A = reduce(*system, perturbation).value().A;
  }
};

// Modes that are off by a millionth, with real positions and imaginary rates.
Subspace nearly_invariant(const Conservative& of) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(of.A);
  Subspace s;
  s.X.resize(6, 3), s.B = Eigen::MatrixXcd::Zero(3, 3), s.V.resize(6, 0), s.N.resize(0, 0), s.C.resize(0, 3);
  s.Y = s.X;
  const Eigen::MatrixXcd left = solver.eigenvectors().inverse().adjoint();
  Index column = 0;
  for (Index k = 0; k < 6; ++k) {
    if (solver.eigenvalues()(k).imag() < 0) continue;
    s.B(column, column) = Complex(0, solver.eigenvalues()(k).imag() * (1 + 1e-6));
    const Index at = of.model->positions()[0];
    const Complex x = solver.eigenvectors()(at, k), phase = x / std::abs(x);
    s.X.col(column) = solver.eigenvectors().col(k) / phase, s.Y.col(column) = left.col(k) / phase;
    for (std::size_t j = 0; j < 3; ++j) {
      const Index p = of.model->positions()[j], r = of.model->rates()[j];
      const double off = 1 + 1e-6 * static_cast<double>(j + 1) * static_cast<double>(column + 1);
      s.X(p, column) = s.X(p, column).real() * off, s.X(r, column) = Complex(0, s.X(r, column).imag() / off);
      s.Y(p, column) = s.Y(p, column).real() / off, s.Y(r, column) = Complex(0, s.Y(r, column).imag());
    }
    ++column;
  }
  return s;
}

// Other phases of vectors change nothing but that numbers are not real: both ways must say the same.
TEST(SubspacePencil, IsTheSameWithoutPhases) {
  const Conservative of;
  ASSERT_TRUE(of.model);
  ShiftInverse op(*of.perturbation.equations, of.model);
  ASSERT_TRUE(op.move_to(Complex(0, 0.1)));
  const Subspace real = nearly_invariant(of);
  ASSERT_TRUE(RealSubspace::of(real));
  Subspace turned = real;
  for (Index c = 0; c < 3; ++c) {
    const Complex phase = std::polar(1.0, 0.3 + static_cast<double>(c));
    turned.X.col(c) *= phase, turned.Y.col(c) *= phase;
  }
  ASSERT_FALSE(RealSubspace::of(turned));
  const SubspacePencil a = measured(*of.perturbation.equations, op, real, 1, 10),
                       b = measured(*of.perturbation.equations, op, turned, 1, 10);
  for (Index c = 0; c < 3; ++c) {
    EXPECT_NEAR(a.residual.col(c).norm(), b.residual.col(c).norm(), 1e-13);
    EXPECT_GT(a.residual.col(c).norm(), 1e-7);
    for (Index r = 0; r < 3; ++r) {
      const auto phase = std::polar<long double>(1, static_cast<long double>(c - r));
      EXPECT_LT(std::abs(b.value(r, c) - phase * a.value(r, c)), 1e-13) << r << c;
      EXPECT_NEAR(a.uncertainty(r, c), b.uncertainty(r, c), 1e-3 * b.uncertainty(r, c)) << r << c;
      EXPECT_NEAR(a.unknown(r, c), b.unknown(r, c), 1e-6 * b.unknown(r, c)) << r << c;
    }
  }
}

}  // namespace
}  // namespace dynalin::subspace_pencil_test
