// Tables of modes in which something is zero but for rounding: it has no share, whatever units and angles are.
#include <gmock/gmock.h>

#include "cases/modal_sums_cases.h"

namespace dynalin::cases::rounding_shares_test {
namespace {

using ::testing::HasSubstr;
using RoundingShares = ModalSumCases;

// A slider on a plane at odd angles, on springs; a controller pushes it along MARKER/4.
std::string slider(const std::string& direction, const std::string& state, const std::string& force) {
  return "Slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=1.91,0.81,0.12\nMARKER/4, REULER=" + direction +
         "\nMARKER/3, QP=1,.2,.3\nPART/2, MASS=1, VX=1, VY=.5, CM=20, IP=1,1,1\nMARKER/20\n"
         "MARKER/21, REULER=1.91,0.81,0.12\nMARKER/22, QP=.1,.3,.2\nMARKER/23, QP=.2,-.3,.1\nJOINT/1, PLANAR, I=21, "
         "J=1\n"
         "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=3, K=10, C=.1, LENGTH=1\n"
         "SPRINGDAMPER/2, TRANSLATIONAL, I=22, J=3, K=10, C=.1, LENGTH=1\n"
         "SPRINGDAMPER/3, TRANSLATIONAL, I=23, J=3, K=10, C=.1, LENGTH=1\n"
         "DIFF/7, FUNCTION=" +
         state + "\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=4, FUNCTION=" + force + "\nEND\n";
}
const std::string along_normal = "1.91,0.81,0.17";

TEST_F(RoundingShares, a_controller_that_pushes_against_a_guide_moves_no_mass) {
  const std::string still = slider(along_normal, "-0.1*DIF(7)+DX(20)", "-5*DIF(7)"),
                    without = slider(along_normal, "-0.1*DIF(7)+DX(20)", "0");
  const std::string tables = ", KINETIC=1,9, DISSIPAT=1,9, STRAIN=1,9, MASS_PER_MODE=ALL, TABLE_PRECISION=5";
  for (const char* option : {"", ", ORIGINAL", ", RM=20", ", NMODES=6, NEAR=0.05"}) {
    SCOPED_TRACE(option);
    const std::string command = "LINEAR/EIGENSOL" + tables + option + "\n";
    const RunResult r = run(still, command);
    ASSERT_EQ(r.status, 0) << r.err;
    const auto& modes = r.result(0).at("modes");
    std::size_t of_controller = 0;
    for (std::size_t k = 0; k < modes.size(); ++k) {
      if (modes[k].at("moves_most") != "DIFF/7") continue;
      of_controller = k + 1;
      for (std::size_t e = 0; e < 6; ++e) EXPECT_EQ(modes[k].at("shape")[e][0], 0) << e;
    }
    ASSERT_GT(of_controller, 0u) << modes;
    const std::string text = r.text("model.txt");
    const std::string mode = std::to_string(of_controller);
    for (const double x : row(text, "Modal effective mass", mode)) EXPECT_EQ(x, 0);
    EXPECT_THAT(text, HasSubstr("Mode " + mode + ": nothing that has mass moves."));
    EXPECT_THAT(text, HasSubstr("Nothing that has mass moves in this mode."));
  }
  // What the slider does is as without the force.
  const auto sum_of = [&](const std::string& model) {
    const RunResult r = run(model, "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL, TABLE_PRECISION=9\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return row(r.text("model.txt"), "Energies per mode", "Model");
  };
  const std::vector<double> one = sum_of(still), other = sum_of(without);
  ASSERT_EQ(one.size(), 6u);
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(one[k], other[k], 1e-9 * std::abs(other[k])) << k;
}

}  // namespace
}  // namespace dynalin::cases::rounding_shares_test
