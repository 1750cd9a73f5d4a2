// Mass, damping and stiffness of chosen coordinates: they make the state matrices that linearize() finds by another
// way, elements add up to the whole, and single ones are what a textbook says.
#include "linear/physical_matrices.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "elements/catalogue.h"
#include "oracle/mechanism.h"

namespace dynalin::oracle::physical_matrices_test {
namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

std::shared_ptr<const System> system_of(const std::string& text) {
  auto dataset = parse_dataset(std::make_shared<const SourceText>("physical.adm", text));
  EXPECT_FALSE(dataset.diagnostics.has_errors()) << render(dataset.diagnostics);
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  EXPECT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  return System::make(std::move(model.value)).value();
}

LinearOptions options_of(const dynalin::Model& model) {
  LinearOptions options;
  if (const auto list = model.find("PINPUT", 1)) options.pinput = *list;
  if (const auto list = model.find("POUTPUT", 1)) options.poutput = *list;
  return options;
}

Result<PhysicalEquations> physical_of(const System& system, const OperatingPoint& op) {
  const auto perturbation = perturb(system, op, options_of(system.model()));
  if (!perturbation) return tl::unexpected(perturbation.error());
  return PhysicalEquations::make(system, *perturbation);
}

// [A B; C D] with states as linearize() lists them.
Matrix state_space(const PhysicalMatrices& p) {
  const Matrix M_inverse = p.force.of_accelerations.inverse();
  const auto r = static_cast<Index>(p.with_rate.size()), x = static_cast<Index>(p.coordinates.size());
  const auto z = static_cast<Index>(p.states.size()), u = static_cast<Index>(p.inputs.size());
  // By x′, x, z, u.
  const auto joined = [&](const MotionMap& m) {
    Matrix all(m.of_rates.rows(), r + x + z + u);
    all << m.of_rates, m.of_coordinates, m.of_states, m.of_inputs;
    return all;
  };
  const Matrix acceleration = -M_inverse * joined(p.force);
  const auto follows = [&](const MotionMap& m) { return (joined(m) + m.of_accelerations * acceleration).eval(); };
  const Matrix rate = follows(p.rate), state_rate = follows(p.state_rate), output = follows(p.output);
  Matrix rows(r + x + z + output.rows(), r + x + z + u);
  rows << acceleration, rate, state_rate, output;
  // The rate of a coordinate stands before it.
  std::vector<Index> order;
  for (Index k = 0, next = 0; k < x; ++k) {
    if (next < r && p.with_rate[static_cast<std::size_t>(next)] == static_cast<std::size_t>(k)) order.push_back(next++);
    order.push_back(r + k);
  }
  std::vector<Index> columns = order, all = order;
  for (Index k = r + x; k < rows.cols(); ++k) columns.push_back(k);
  for (Index k = r + x; k < rows.rows(); ++k) all.push_back(k);
  return rows(all, columns);
}

Matrix joined(const StateSpace& s) {
  Matrix all(s.A.rows() + s.C.rows(), s.A.cols() + s.B.cols());
  all << s.A, s.B, s.C, s.D;
  return all;
}

struct Sums {
  MotionMap all;
  int elements = 0;
};
Sums sum_of_elements(const PhysicalEquations& physical) {
  Sums sums;
  for (const ElementLabel* label : physical.elements()) {
    const MotionMap one = physical.of(*label);
    if (sums.elements++ == 0)
      sums.all = one;
    else
      sums.all += one;
  }
  return sums;
}

void expect_near(const Matrix& a, const Matrix& b, double size, const char* what) {
  ASSERT_EQ(a.rows(), b.rows()) << what;
  ASSERT_EQ(a.cols(), b.cols()) << what;
  if (a.size() > 0) {
    EXPECT_LE((a - b).cwiseAbs().maxCoeff(), size) << what << "\n" << a << "\n\n" << b;
  }
}

TEST(PhysicalMatrices, make_the_state_matrices_and_are_the_sum_of_their_elements) {
  int compared = 0, velocity_constrained = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto system = system_of(dataset_text(random_mechanism(seed)));
    Findings findings;
    const auto op = initial_conditions(*system, findings);
    ASSERT_TRUE(op) << op.error().message;
    const LinearOptions options = options_of(system->model());
    const auto linear = linearize(*system, *op, options);
    ASSERT_TRUE(linear) << linear.error().message;
    if (linear->has_massless_states || linear->kinematic_states == 0) continue;
    const auto physical = PhysicalEquations::make(*system, *linear);
    ASSERT_TRUE(physical) << physical.error().message;
    const PhysicalMatrices& p = physical->whole();
    // Row by row, beside what an entry is made of.
    const Matrix expected = joined(linear->model), found = state_space(p);
    ASSERT_EQ(expected.rows(), found.rows());
    ASSERT_EQ(expected.cols(), found.cols());
    for (Index k = 0; k < expected.rows(); ++k) {
      const double size = expected.row(k).cwiseAbs().maxCoeff();
      EXPECT_LE((expected.row(k) - found.row(k)).cwiseAbs().maxCoeff(), 1e-9 * (1 + size)) << "row " << k;
    }
    const Sums sums = sum_of_elements(*physical);
    const auto compare = [&](const Matrix& one, const Matrix& other, const char* what) {
      expect_near(one, other, 1e-10 * (1 + one.cwiseAbs().sum()), what);
    };
    compare(p.force.of_accelerations, sums.all.of_accelerations, "M");
    compare(p.force.of_rates, sums.all.of_rates, "C");
    compare(p.force.of_coordinates, sums.all.of_coordinates, "K");
    compare(p.force.of_states, sums.all.of_states, "Z");
    compare(p.force.of_inputs, sums.all.of_inputs, "P");
    ++compared;
    velocity_constrained += p.with_rate.size() < p.coordinates.size();
  }
  EXPECT_GE(compared, 30);
  EXPECT_GE(velocity_constrained, 3);
}

// Two masses on a line, a spring and a damper between them, and a spring to ground.
TEST(PhysicalMatrices, of_two_masses_are_those_of_the_textbook) {
  const auto system = system_of(
      "Masses\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=0\nPART/1, GROUND\nMARKER/1\n"
      "PART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0,1\nMARKER/20\nPART/3, MASS=3, CM=30, IP=1,1,1, QG=0,0,2.5\nMARKER/30\n"
      "JOINT/2, TRANSLATIONAL, I=20, J=1\nJOINT/3, TRANSLATIONAL, I=30, J=1\n"
      "SPRINGDAMPER/4, TRANSLATIONAL, I=20, J=1, K=50, C=0.5, LENGTH=1\n"
      "SPRINGDAMPER/5, TRANSLATIONAL, I=30, J=20, K=70, C=0.7, LENGTH=1.5\n"
      "VARIABLE/1, FUNCTION=0\nPINPUT/1, VARIABLES=1\nSFORCE/6, TRANSLATIONAL, I=30, J=1, ACTIONONLY, "
      "FUNCTION=4*VARVAL(1)\nVARIABLE/2, FUNCTION=DZ(30,1)\nPOUTPUT/1, VARIABLES=2\nEND\n");
  Findings findings;
  const auto op = initial_conditions(*system, findings);
  ASSERT_TRUE(op) << op.error().message;
  const auto physical = physical_of(*system, *op);
  ASSERT_TRUE(physical) << physical.error().message;
  const PhysicalMatrices& p = physical->whole();
  ASSERT_EQ(p.coordinates.size(), 2u);
  ASSERT_EQ(p.coordinates[0].owner, (ElementId{"PART", 2}));
  const auto two = [](double a, double b, double c) { return Matrix{{a, b}, {b, c}}; };
  expect_near(p.force.of_accelerations, two(2, 0, 3), 1e-14, "M");
  expect_near(p.force.of_rates, two(1.2, -0.7, 0.7), 1e-14, "C");
  expect_near(p.force.of_coordinates, two(120, -70, 70), 1e-12, "K");
  expect_near(p.force.of_inputs, Matrix{{0}, {-4}}, 1e-14, "P");
  expect_near(p.output.of_coordinates, Matrix{{0, 1}}, 1e-14, "y");
  const auto of = [&](const char* statement, std::int64_t id) {
    return physical->of(system->model().label(*system->model().find(statement, id)));
  };
  expect_near(of("SPRINGDAMPER", 5).of_coordinates, two(70, -70, 70), 1e-12, "K of the spring between");
  expect_near(of("SPRINGDAMPER", 5).of_rates, two(0.7, -0.7, 0.7), 1e-14, "C of the spring between");
  expect_near(of("SPRINGDAMPER", 4).of_coordinates, two(50, 0, 0), 1e-12, "K of the spring to ground");
  expect_near(of("SFORCE", 6).of_inputs, Matrix{{0}, {-4}}, 1e-14, "P of the force");
  expect_near(of("JOINT", 2).of_coordinates, two(0, 0, 0), 0, "K of a joint without load");
}

// A pendulum of mass 2 at 0.5 below its pin, with a moment of inertia of 0.1: the weight turns with nothing, so that
// its stiffness is that of the reaction, whose point moves up.
TEST(PhysicalMatrices, of_a_pendulum_has_the_stiffness_of_its_weight) {
  const auto system = system_of(
      "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1, REULER=0,90D,0\n"
      "PART/2, MASS=2, CM=20, IP=.1,.1,.1, QG=0,0,-.5\nMARKER/20\nMARKER/21, QP=0,0,.5, REULER=0,90D,0\n"
      "JOINT/1, REVOLUTE, I=21, J=1\nEND\n");
  Findings findings;
  const auto op = initial_conditions(*system, findings);
  ASSERT_TRUE(op) << op.error().message;
  const auto physical = physical_of(*system, *op);
  ASSERT_TRUE(physical) << physical.error().message;
  expect_near(physical->whole().force.of_accelerations, Matrix{{0.6}}, 1e-14, "M");
  expect_near(physical->whole().force.of_coordinates, Matrix{{9.81}}, 1e-12, "K");
  EXPECT_EQ(physical->elements().size(), 2u);
}

}  // namespace
}  // namespace dynalin::oracle::physical_matrices_test
