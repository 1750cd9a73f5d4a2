// Constraints on velocities that are not linear in them: initial velocities meet them all the same, and everything
// after them starts from there.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/run.h"

namespace dynalin::cases::curved_velocity_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CurvedVelocity : public Cases {
 protected:
  // Of a free mass that a GCON holds, with stated velocities.
  RunResult with(const std::string& stated, const std::string& function, const std::string& more = "",
                 const std::string& commands = "SIMULATE/INITIAL_CONDITIONS\n") const {
    return run("Curved\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPOINT_MASS/2, MASS=2, CM=20" + stated +
                   "\nMARKER/20, POINT_MASS=2\nGCON/1, FUNCTION=" + function +
                   "\nREQUEST/1, F2=VX(20)\\F3=VY(20)\\F4=VZ(20)\n" + more + "END\n",
               commands);
  }
  static std::vector<double> velocity(const RunResult& r, std::size_t result = 0) {
    if (r.status != 0) return {9, 9, 9};
    return r.result(result).at("operating_point").at("requests").at(0).at("values").get<std::vector<double>>();
  }
};

// v + 0.1 v² = 1
TEST_F(CurvedVelocity, is_a_root_and_not_that_of_the_tangent_at_rest) {
  const RunResult r = with("", "VX(20)+0.1*VX(20)**2-1");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(velocity(r)[0], (std::sqrt(1.4) - 1) / 0.2, 1e-14);
}

TEST_F(CurvedVelocity, that_is_stated_and_meets_the_constraint_stays) {
  for (const std::string speed : {"VX(20)**2+VY(20)**2-25", "VM(20)-5"}) {
    const RunResult r = with(", VX=3, VY=4", speed);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_NEAR(velocity(r)[0], 3, 1e-15) << speed;
    EXPECT_NEAR(velocity(r)[1], 4, 1e-15) << speed;
    EXPECT_THAT(r.err, Not(HasSubstr("changed"))) << r.err;
  }
}

// What is not stated follows.
TEST_F(CurvedVelocity, takes_what_is_left_open) {
  const RunResult r = with(", VX=2, VZ=3", "VX(20)*VZ(20)-VY(20)");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(velocity(r)[0], 2, 1e-14);
  EXPECT_NEAR(velocity(r)[1], 6, 1e-13);
  EXPECT_NEAR(velocity(r)[2], 3, 1e-14);
}

TEST_F(CurvedVelocity, that_is_stated_and_cannot_be_is_changed_with_a_warning) {
  const RunResult r = with(", VX=1, VY=2, VZ=3", "VX(20)*VZ(20)-VY(20)");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::vector<double> v = velocity(r);
  EXPECT_NEAR(v[0] * v[2], v[1], 1e-13);
  EXPECT_THAT(r.err, HasSubstr("contradicts the constraints and was changed"));
}

// Five times as fast as the speed allows: the same way, slower.
TEST_F(CurvedVelocity, is_nearest_to_what_is_stated) {
  const RunResult r = with(", VX=15, VY=20", "VM(20)-5");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(velocity(r)[0], 3, 1e-9);
  EXPECT_NEAR(velocity(r)[1], 4, 1e-9);
}

// A mass of 2 of constant speed 5 along x, on a spring of 8 across: ω² = 8/2 in z; what drives it works along x alone.
TEST_F(CurvedVelocity, is_where_the_linear_model_is) {
  const RunResult r = with(", VX=5", "VM(20)-5",
                           "MARKER/9, PART=1, FLOATING\n"
                           "VFORCE/1, I=20, JFLOAT=9, RM=1, FX=0\\, FY=0\\, FZ=-8*DZ(20,1)\n",
                           "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  double highest = 0;
  for (const auto& v : r.eigenvalues(0)) highest = std::max(highest, v.imag());
  EXPECT_NEAR(highest * 2 * std::numbers::pi, 2, 1e-12);
}

// Acceleration along the tangent: Ψ′ = 0 is a = 0 with the gradient 1 + 0.2 v.
TEST_F(CurvedVelocity, goes_on_so_in_time) {
  const RunResult r =
      with("", "VX(20)+0.1*VX(20)**2-1-TIME", "", "SIMULATE/DYNAMICS, END=1, STEPS=2\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(velocity(r, 1)[0], (std::sqrt(1.8) - 1) / 0.2, 1e-5);
}

TEST_F(CurvedVelocity, that_does_not_exist_is_refused) {
  const RunResult r = with(", VX=0.3", "VX(20)**2+1");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("not linear in them"));
}

}  // namespace
}  // namespace dynalin::cases::curved_velocity_test
