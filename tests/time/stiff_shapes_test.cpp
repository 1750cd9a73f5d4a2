// Undamped stiff modes that hardly move do not hold steps down to their periods.
#include "time/course.h"

namespace dynalin::in_time::stiff_shapes_test {
namespace {

// A rod of steel of length 1 on a hinge, let go from lying: its stretching has 20000 periods in the time of the run.
// The rod as a rigid one is at θ″ = −3/2 g cos θ.
TEST(StiffShapes, a_rod_that_swings_without_damping_takes_steps_of_its_swing) {
  const Course c = led_through_time(
      "Rod\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n"
      "MATERIAL/2, DENSITY=7850, YOUNGS_MODULUS=2.1E11, POISSONS_RATIO=0.3\n"
      "FE_PART/2, TYPE=3DBEAM, MATERIAL=2, NODE_LABELS=1,2,3,4,5, X=0,.25,.5,.75,1, AREA=1E-4, IYY=8.333E-10, "
      "IZZ=8.333E-10\n"
      "MARKER/21, FE_PART=2, NODE_LABEL=1\nMARKER/22, FE_PART=2, NODE_LABEL=5, QP=1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\n"
      "VARIABLE/1, FUNCTION=DY(22)\nEND\n",
      {0.4, 4});
  ASSERT_TRUE(c.ok()) << c.failure;
  EXPECT_LT(c.simulated.statistics.steps, 30000);
  double theta = 0, rate = 0;
  constexpr int steps = 40000;
  for (int k = 0; k < steps; ++k) {  // leapfrog
    rate -= 1.5 * 9.81 * std::cos(theta) * 0.4 / steps * (k == 0 ? 0.5 : 1.0);
    theta += rate * 0.4 / steps;
  }
  EXPECT_NEAR(c.last(1), std::sin(theta), 2e-3);
}

}  // namespace
}  // namespace dynalin::in_time::stiff_shapes_test
