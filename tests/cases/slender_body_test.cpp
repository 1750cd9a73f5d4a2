// Bodies whose inertia about one axis is small beside the others: rods, shafts, needles. Their moments about that axis
// have all their digits as long as it lies along an axis of ground.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "cases/dataset_text.h"

namespace dynalin::cases::slender_body_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class SlenderBody : public Cases {
 protected:
  // A torsional spring of 1 about the z axis of a hinge to ground. What is written of inertia and arm is in axes of the
  // body, which stands as ground does, and the hinge as `axes` says, unless the body is turned with its hinge.
  RunResult on_spring(const std::string& inertia, const std::string& axes, const std::string& arm = "0, 0, 0") const {
    return run_with(inertia, axes, "0, 0, 0", axes, arm);
  }
  RunResult turned(const std::string& inertia, const std::string& body) const {
    return run_with(inertia, body, body, "0, 0, 0", "0, 0, 0");
  }
  // What it does to the body at rest: −1/J.
  static double acceleration(const RunResult& r) {
    double least = 0;
    for (const auto& row : r.matrix(0, "A")) least = std::min(least, std::ranges::min(row));
    return least;
  }

 private:
  RunResult run_with(const std::string& inertia, const std::string& on_ground, const std::string& body,
                     const std::string& on_body, const std::string& arm) const {
    RunResult r = run("Slender\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=" + on_ground +
                          "\nPART/2, MASS=1, CM=21, IP=" + inertia + ", REULER=" + body +
                          "\nMARKER/20, REULER=" + on_body + "\nMARKER/21, QP=" + arm +
                          "\nJOINT/1, REVOLUTE, I=20, J=1\nSPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=1\nEND\n",
                      "LINEAR/STATEMAT, FILE=m\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r;
  }
};

TEST_F(SlenderBody, turns_about_its_axis_by_the_inertia_that_is_stated) {
  const std::string about_z = "0, 0, 0", about_x = "90D, 90D, 0";
  for (const auto& [inertia, axial] :
       {std::pair{"2, 2, 1E-6", 1e-6}, {"1, 1, 1E-9", 1e-9}, {"3, 2.9999999, 3E-7", 3e-7}})
    EXPECT_NEAR(acceleration(on_spring(inertia, about_z)) * axial, -1, 1e-14) << inertia;
  EXPECT_NEAR(acceleration(on_spring("1E-12, 1, 1", about_x)) * 1e-12, -1, 1e-14);
  // A mass centre along the axis adds nothing.
  EXPECT_NEAR(acceleration(on_spring("2, 2, 1E-6", about_z, "0, 0, 3.7")) * 1e-6, -1, 1e-14);
}

TEST_F(SlenderBody, askew_says_how_far_its_moment_may_be_off) {
  constexpr std::string_view said = "may be off by ";
  const std::string askew = "0.3, 0.7, 0.2";
  for (const auto& [inertia, axial] : {std::pair{"1, 1, 1E-9", 1e-9}, {"1, 1, 1E-8", 1e-8}, {"5, 3, 1E-7", 1e-7}}) {
    const RunResult r = turned(inertia, askew);
    const auto at = r.err.find(said);
    ASSERT_NE(at, std::string::npos) << inertia << ": " << r.err;
    const double bound = std::stod(r.err.substr(at + said.size()));
    const double off = std::abs(acceleration(r) * axial + 1);
    EXPECT_LT(off, bound) << inertia;
    EXPECT_LT(bound, 1e-15 / axial * 100) << inertia;
  }
  EXPECT_THAT(turned("2, 2, 1E-2", askew).err, Not(HasSubstr("rounded-matrix")));
}

}  // namespace
}  // namespace dynalin::cases::slender_body_test
