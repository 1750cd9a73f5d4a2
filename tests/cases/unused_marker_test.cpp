// Markers at which nothing acts change nothing, however far out they stand: not what is chosen as states of a mechanism
// in motion, nor how one that is drawn open is put together, nor what counts as met.
#include <gmock/gmock.h>

#include <cmath>

#include "cases/dataset_text.h"
#include "cases/study_of.h"

namespace dynalin::cases::unused_marker_test {
namespace {

using ::testing::HasSubstr;

const std::string far_out =
    "MARKER/777, PART=1, QP=700,0,0\nMARKER/778, PART=2, QP=0,-50,3\n"
    "REQUEST/7, DISPLACEMENT, I=778, J=777\nGRAPHICS/7, CIRCLE, CM=778, RADIUS=2\n";

class UnusedMarker : public Cases {
 protected:
  // A crank of 0.1 at 8 rad/s drives a rod of 0.3 and a slider on a spring along x.
  static std::string crank(const std::string& more) {
    return "Crank\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, REULER=90D,90D,0\n"
           "PART/2, MASS=1, CM=20, IP=0.1,0.1,0.1, REULER=40D,0,0, WZ=8\nMARKER/20, QP=0.05,0,0\nMARKER/21\n"
           "MARKER/22, QP=0.1,0,0\n"
           "PART/3, MASS=2, CM=30, IP=0.3,0.3,0.3, QG=0.0766044443118978,0.0642787609686539,0, "
           "REULER=-0.2159367698246117,0,0\nMARKER/30, QP=0.15,0,0\nMARKER/31\nMARKER/32, QP=0.3,0,0\n"
           "PART/4, MASS=1, CM=40, IP=0.1,0.1,0.1, QG=0.3696372567527946,0,0\nMARKER/40\nMARKER/41, REULER=90D,90D,0\n"
           "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\nJOINT/3, REVOLUTE, I=40, J=32\n"
           "JOINT/4, TRANSLATIONAL, I=41, J=2\nSPRINGDAMPER/1, TRANSLATIONAL, I=40, J=1, K=100, LENGTH=0.3\n" +
           more + "END\n";
  }
};

TEST_F(UnusedMarker, decides_nothing_about_states) {
  for (const char* command : {"LINEAR/EIGENSOL\n", "LINEAR/EIGENSOL, ORIGINAL\n"}) {
    const RunResult plain = run(crank(""), command), with = run(crank(far_out), command);
    ASSERT_EQ(plain.status, 0) << plain.err;
    ASSERT_EQ(with.status, 0) << with.err;
    ASSERT_EQ(plain.eigenvalues(0).size(), 2u);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(std::abs(with.eigenvalues(0)[k] - plain.eigenvalues(0)[k]), 0, 1e-12) << command;
  }
}

// Turned and moved alike to bring its pin to its hole.
TEST_F(UnusedMarker, decides_nothing_about_assembly) {
  const auto assembled = [](const std::string& more) {
    return study_of(
               "Open\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n"
               "PART/2, MASS=2, CM=20, IP=0.1,0.1,0.1, QG=0.42,-0.1,0\nMARKER/20\nMARKER/21, QP=-0.4,0,0\n"
               "JOINT/1, REVOLUTE, I=21, J=1\nVARIABLE/1, FUNCTION=AZ(20,1)\n" +
               more + "END\n")
        .initial_conditions()
        .variable(1);
  };
  const double turned = assembled("");
  EXPECT_GT(std::abs(turned), 0.05);
  EXPECT_NEAR(assembled(far_out), turned, 1e-14);
}

// Two slides that are a millionth apart.
TEST_F(UnusedMarker, decides_nothing_about_what_is_met) {
  const std::string slides =
      "Apart\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=1E-6,0,1\n"
      "PART/2, MASS=1, CM=20, IP=0.1,0.1,0.1\nMARKER/20\nMARKER/21, QP=0,0,1\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nJOINT/2, TRANSLATIONAL, I=21, J=2\n";
  for (const std::string& more : {std::string(), "MARKER/779, PART=1, QP=1E5,0,0\n" + far_out}) {
    const RunResult r = run(slides + more + "END\n", "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 2) << more;
    EXPECT_THAT(r.err, HasSubstr("contradict")) << more;
  }
}

}  // namespace
}  // namespace dynalin::cases::unused_marker_test
