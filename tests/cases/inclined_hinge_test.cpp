// A part on a hinge that is drawn aslant, where all that there is beside what acts about the hinge is rounding.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::inclined_hinge_test {
namespace {

constexpr std::array slants = {"1,1,1", "1,2,3", "-1.909,-1.611,-1.696", "0.3,-0.7,2.2", "2.5,0.4,-1.3"};

class InclinedHinge : public Cases {
 protected:
  // I about the hinge is 0.5.
  static std::string hinge(const std::string& slant, const std::string& torque) {
    return fmt::format(
        "Hinge\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=1.343,-1.555,-2.401, REULER={0}\n"
        "PART/2, MASS=1, CM=2, IP=1,1,0.5, QG=1.343,-1.555,-2.401, REULER={0}\nMARKER/2\n"
        "JOINT/1, REVOLUTE, I=2, J=1\nSFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION={1}\nEND\n",
        slant, torque);
  }
};

// A steady torque begins to turn it: no spring, no damper, and no rounding beside an acceleration of 4 rad/s².
TEST_F(InclinedHinge, is_free_under_a_steady_torque) {
  for (const std::string slant : slants) {
    SCOPED_TRACE(slant);
    const RunResult r = run(hinge(slant, "2"), "LINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    for (const auto& value : r.eigenvalues(0)) EXPECT_EQ(std::abs(value), 0);
  }
}

}  // namespace
}  // namespace dynalin::cases::inclined_hinge_test
