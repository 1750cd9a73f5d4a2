#include "linear/physical_matrices.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/initial.h"
#include "linear/linear_system.h"
#include "system/model_test_support.h"

namespace dynalin::physical_matrices_test {
namespace {

struct Matrices {
  std::shared_ptr<const System> system;
  std::optional<PhysicalEquations> equations;

  explicit Matrices(const std::string& text) : system(system_test::system_of(text)) {
    Findings findings;
    const auto op = initial_conditions(*system, findings);
    if (!op) throw std::runtime_error(op.error().message);
    const auto perturbation = perturb(*system, *op, {});
    if (!perturbation) throw std::runtime_error(perturbation.error().message);
    auto made = PhysicalEquations::make(*system, *perturbation);
    if (!made) throw std::runtime_error(made.error().message);
    equations = std::move(*made);
  }
  const MotionMap& force() const { return equations->whole().force; }
  MotionMap of(const std::string& element) const {
    for (const ElementLabel* label : equations->elements()) {
      if (label->text() == element) return equations->of(*label);
    }
    throw std::runtime_error(element + " contributes nothing");
  }
};

void expect_near(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-12 * std::max(1.0, b.cwiseAbs().maxCoeff())) << a << "\nbut\n" << b;
}
Eigen::MatrixXd one(double x) { return Eigen::MatrixXd::Constant(1, 1, x); }

// A rod of mass 2 and inertia 0.3 hangs by its end, a length of 0.5 above its centre, with a spring and a damper.
// M = I + m l², C = c, K = k + m g l.
TEST(PhysicalMatrices, of_a_pendulum_in_its_angle) {
  const Matrices m(
      "ACCGRAV/JGRAV=-10\nPART/2, MASS=2, CM=20, IP=0.1,0.2,0.3, QG=0,-0.5,0\nMARKER/20\n"
      "MARKER/21, PART=2, QP=0,0.5,0\nJOINT/1, REVOLUTE, I=21, J=1\n"
      "SPRINGDAMPER/4, ROTATION, I=21, J=1, KT=7, CT=0.25\n");
  expect_near(m.force().of_accelerations, one(0.3 + 2 * 0.25));
  expect_near(m.force().of_rates, one(0.25));
  expect_near(m.force().of_coordinates, one(7 + 2 * 10 * 0.5));
  expect_near(m.of("PART/2").of_accelerations, one(0.8));
  expect_near(m.of("SPRINGDAMPER/4").of_coordinates, one(7));
  expect_near(m.of("SPRINGDAMPER/4").of_rates, one(0.25));
}

// The elements add up to the whole, whoever gets what of the reactions.
TEST(PhysicalMatrices, of_elements_add_up) {
  const Matrices m(
      "ACCGRAV/JGRAV=-10\nPART/2, MASS=2, CM=20, IP=0.1,0.2,0.3, QG=0,-0.5,0\nMARKER/20\n"
      "MARKER/21, PART=2, QP=0,0.5,0\nMARKER/22, PART=2, QP=0,-0.5,0\n"
      "PART/3, MASS=1, CM=30, IP=0.1,0.1,0.1, QG=0.4,-1,0\nMARKER/30\nMARKER/31, PART=3, QP=-0.4,0,0\n"
      "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\n"
      "BUSHING/3, I=30, J=1, K=30,20,10, C=3,2,1\n");
  const Eigen::Index n = m.force().of_accelerations.rows();
  ASSERT_EQ(n, 2);
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n), C = M, K = M;
  for (const ElementLabel* label : m.equations->elements()) {
    const MotionMap of = m.equations->of(*label);
    M += of.of_accelerations, C += of.of_rates, K += of.of_coordinates;
  }
  expect_near(M, m.force().of_accelerations);
  expect_near(C, m.force().of_rates);
  expect_near(K, m.force().of_coordinates);
  expect_near(M, M.transpose());
}

// A DIFF pulls: Q = m x″ + k x − 5 z.
TEST(PhysicalMatrices, of_states_are_what_they_pull_by) {
  const Matrices m(
      "POINT_MASS/2, MASS=4, CM=20\nMARKER/20, POINT_MASS=2\nMARKER/9, PART=1, FLOATING\n"
      "JPRIM/1, INLINE, I=20, J=1\nDIFF/7, IC=0, FUNCTION=-2*DIF(7)+6*DZ(20,1)\n"
      "VFORCE/1, I=20, JFLOAT=9, RM=1, FX=0\\, FY=0\\, FZ=-11*DZ(20,1)+5*DIF(7)\n");
  expect_near(m.force().of_accelerations, one(4));
  expect_near(m.force().of_coordinates, one(11));
  expect_near(m.force().of_states, one(-5));
  expect_near(m.equations->whole().state_rate.of_coordinates, one(6));
  expect_near(m.equations->whole().state_rate.of_states, one(-2));
}

}  // namespace
}  // namespace dynalin::physical_matrices_test
