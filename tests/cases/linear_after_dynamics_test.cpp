// A linear model knows nothing of how its point was reached: after a simulation it is that of the same state given as
// initial conditions, to 1e-8.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases/study_of.h"

namespace dynalin::linear_after_dynamics_test {
namespace {

struct Start {
  Triple position, angles, velocity, turning;
};

// Two links, the second one skew in space, on a spring, with gravity, a controller and a motor that speeds up.
std::string model(const Start& arm, const Start& rod, double state, double time) {
  const auto part = [](int id, const std::string& mass, const Start& s) {
    return fmt::format(
        "PART/{0}, {1}, CM={0}0, QG={2:.17g},{3:.17g},{4:.17g}, REULER={5:.17g},{6:.17g},{7:.17g}, VX={8:.17g}, "
        "VY={9:.17g}, VZ={10:.17g}, WM=1, WX={11:.17g}, WY={12:.17g}, WZ={13:.17g}\nMARKER/{0}0, PART={0}\n",
        id, mass, s.position[0], s.position[1], s.position[2], s.angles[0], s.angles[1], s.angles[2], s.velocity[0],
        s.velocity[1], s.velocity[2], s.turning[0], s.turning[1], s.turning[2]);
  };
  return "Two links\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1\nMARKER/2, PART=1, "
         "QP=0,0,2\n" +
         part(2, "MASS=2, IP=0.1,0.2,0.3", arm) + part(3, "MASS=1, IP=0.05,0.02,0.03", rod) +
         "MARKER/21, PART=2, QP=-0.5,0,0\nMARKER/22, PART=2, QP=0.5,0,0, REULER=0.3,0.7,0.2\n"
         "MARKER/31, PART=3, QP=-0.4,0,0, REULER=0.3,0.7,0.2\nMARKER/32, PART=3, QP=0.4,0,0\n"
         "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\n"
         "SPRINGDAMPER/1, TRANSLATIONAL, I=32, J=2, K=30, C=0.4, LENGTH=0.5\n"
         "SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=3*SIN(2*(TIME+" +
         fmt::format("{:.17g}", time) +
         "))-0.2*WZ(21,1)+DIF(1)\n"
         "DIFF/1, FUNCTION=-4*DIF(1)+2*AZ(21,1), IC=" +
         fmt::format("{:.17g}", state) + "\nEND\n";
}

TEST(LinearAfterDynamics, is_that_of_the_same_state_given_as_initial_conditions) {
  const Start arm{{0.5, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const Start rod{{1.4, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const library::Study study = study_of(model(arm, rod, 0.3, 0));
  const auto run = study.simulate({.end = 0.83, .steps = 7, .error = 1e-6});
  EXPECT_EQ(run.end, SimulationEnd::reached);
  const auto start = [&](std::int64_t part) {
    const BodyState s = run.point.part(part);
    return Start{s.position, s.angles, s.velocity, s.angular_velocity};
  };
  const double state = run.point.state().states.front().value;
  const library::Study same = study_of(model(start(2), start(3), state, 0.83));
  const auto there = study.linearize(run.point).modes().modes, here = same.linearize().modes().modes;
  ASSERT_EQ(there.size(), here.size());
  ASSERT_GE(there.size(), 3u);
  for (std::size_t k = 0; k < there.size(); ++k)
    EXPECT_LT(std::abs(there[k].eigenvalue_hz - here[k].eigenvalue_hz), 1e-8 * std::abs(here[k].eigenvalue_hz)) << k;
  // The point has moved far from where it started.
  EXPECT_GT(std::abs(run.point.part(2).angular_velocity[2]), 0.05);
}

}  // namespace
}  // namespace dynalin::linear_after_dynamics_test
