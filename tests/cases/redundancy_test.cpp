// Redundant and contradicting constraints, undetermined masses, and wrong input, each named.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/run.h"

namespace dynalin::cases::redundancy_test {
namespace {

using Redundancy = Cases;
using WrongInput = Cases;

std::string four_bar() {
  const double f = 2.2343310190175859, c = std::cos(f), s = std::sin(f), J = 1.0 / 12;
  const auto rod = [&](int id, double x, double y, double dx, double dy) {
    // A slender rod from (x, y) along (dx, dy): only Izz matters in the plane.
    return fmt::format(
        "PART/{0}, MASS=1, CM={1}, IP={2:.17g},{2:.17g},{2:.17g}, QG={3:.17g},{4:.17g},0\nMARKER/{1}, "
        "QP={5:.17g},{6:.17g},0\n"
        "MARKER/{7}\nMARKER/{8}, QP={9:.17g},{10:.17g},0\n",
        id, 10 * id, J, x, y, dx / 2, dy / 2, 10 * id + 1, 10 * id + 2, dx, dy);
  };
  return "Four equal links with a diagonal spring\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, "
         "GROUND\nMARKER/1\nMARKER/2, QP=1,0,0\n" +
         rod(2, 0, 0, c, s) + rod(3, c, s, 1, 0) + rod(4, 1, 0, c, s) +
         "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\nJOINT/3, REVOLUTE, I=42, J=32\nJOINT/4, "
         "REVOLUTE, I=41, J=2\n"
         "SPRINGDAMPER/1, TRANSLATIONAL, I=32, J=1, K=25, C=1, LENGTH=1.4142135623730951\nEND\n";
}

TEST_F(Redundancy, four_bar_of_four_hinges_has_one_freedom_and_names_three_rows) {
  const RunResult r = run(four_bar(), "SIM/STAT\nLIN/EIG\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(1),
                     {std::complex(-0.24238580931050510, 2.1339550283483803) / (2 * std::numbers::pi)}, 1e-11);
  std::size_t named = 0;
  for (std::size_t at = r.message.find("deactivating"); at != std::string::npos;
       at = r.message.find("deactivating", at + 1))
    ++named;
  EXPECT_EQ(named, 3u);
}

constexpr const char* pendulum =
    "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, "
    "IP=1,1,1\nMARKER/20, QP=0,-1,0\nMARKER/21\n"
    "JOINT/1, REVOLUTE, I=21, J=1\n";

TEST_F(Redundancy, a_part_without_mass_that_nothing_holds_is_named) {
  const RunResult r =
      run(std::string(pendulum) + "PART/3\nMARKER/31\nJOINT/2, REVOLUTE, I=31, J=20\nEND\n", "LIN/EIG\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("AZ of PART/3"), std::string::npos) << r.err;
  EXPECT_NE(r.message.find("Ended early"), std::string::npos);
}

TEST_F(Redundancy, contradicting_motions_are_named) {
  const RunResult r =
      run(std::string(pendulum) +
              "MOTION/1, ROTATIONAL, JOINT=1, FUNCTION=0.1\nMOTION/2, ROTATIONAL, JOINT=1, FUNCTION=0.2\nEND\n",
          "LIN/EIG\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("MOTION/"), std::string::npos) << r.err;
}

TEST_F(Redundancy, an_unsolvable_variable_is_named) {
  const RunResult r = run(std::string(pendulum) + "VARIABLE/7, FUNCTION=VARVAL(7)+1\nEND\n", "LIN/EIG\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("VARIABLE/7"), std::string::npos) << r.err;
}

TEST_F(Redundancy, stated_velocities_that_contradict_a_joint_are_changed_with_a_warning) {
  const std::string text =
      std::string(pendulum).replace(std::string(pendulum).find("IP=1,1,1"), 8, "IP=1,1,1, WZ=2, VX=5") + "END\n";
  const RunResult r = run(text, "LIN/EIG\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.err.find("contradicts the constraints"), std::string::npos) << r.err;
}

TEST_F(WrongInput, every_problem_is_reported_at_its_place_and_nothing_is_written) {
  write("model.adm",
        "bad\nUNITS/SYSTEM=MKX\nPART/1, GROUND\nPART/2, MASS=1\nMARKER/3, PART=7\nJOINT/1, REVOLUTE, I=3, J=99\n"
        "VARIABLE/1, FUNCTION=SINN(2)\nSFORCE/1, TRANS, I=3, J=4\nUCON/1\nPART/2, MASS=2\nEND\n");
  write("model.acf",
        "model\nmodel\nLINEAR/EIGENSOL, STATEMAT, COORDS=0\nLINEAR/EXPORT, FILE=x, TYPE=OPENBOX, NOVECTOR\n");
  const RunResult r = run_file("model.acf");
  EXPECT_EQ(r.status, 1);
  for (const char* expected :
       {"model.acf:3:18: error: LINEAR takes exactly one", "[excluded-arguments]",
        "model.acf:4:38: error: NOVECTOR goes with EIGENSOL only", "model.adm:2:7: error", "[unknown-unit]",
        "model.adm:4:1: error", "[missing-cm]", "model.adm:5:16: error", "[unknown-body]", "model.adm:6:27: error",
        "[unknown-marker]", "model.adm:7:22: error", "[unknown-function]", "model.adm:8:1: error", "[missing-argument]",
        "model.adm:9:1: error", "[statement-not-built]", "model.adm:10:1: error", "[duplicate-id]"}) {
    EXPECT_NE(r.err.find(expected), std::string::npos) << expected << "\n" << r.err;
  }
  EXPECT_FALSE(r.wrote("model.msg"));
  EXPECT_FALSE(r.wrote("results.json"));
}

}  // namespace
}  // namespace dynalin::cases::redundancy_test
