// Bodies whose inertia about one axis is small beside the others: rods, shafts, needles. Their moments about that axis
// have all their digits as long as it lies along an axis of ground.
#include <gmock/gmock.h>

#include <algorithm>

#include "cases/dataset_text.h"

namespace dynalin::cases::slender_body_test {
namespace {

class SlenderBody : public Cases {
 protected:
  // What a torsional spring of 1 about the hinge's axis does to a body at rest: −1/J.
  double acceleration(const std::string& inertia, const std::string& axes, const std::string& arm = "0, 0, 0") const {
    const RunResult r =
        run("Slender\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=" + axes +
                "\nPART/2, MASS=1, CM=21, IP=" + inertia + "\nMARKER/20, REULER=" + axes + "\nMARKER/21, QP=" + arm +
                "\nJOINT/1, REVOLUTE, I=20, J=1\nSPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=1\nEND\n",
            "LINEAR/STATEMAT, FILE=m\n");
    EXPECT_EQ(r.status, 0) << r.err;
    double least = 0;
    for (const auto& row : r.matrix(0, "A")) least = std::min(least, std::ranges::min(row));
    return least;
  }
};

TEST_F(SlenderBody, turns_about_its_axis_by_the_inertia_that_is_stated) {
  const std::string about_z = "0, 0, 0", about_x = "90D, 90D, 0";
  for (const auto& [inertia, axial] :
       {std::pair{"2, 2, 1E-6", 1e-6}, {"1, 1, 1E-9", 1e-9}, {"3, 2.9999999, 3E-7", 3e-7}})
    EXPECT_NEAR(acceleration(inertia, about_z) * axial, -1, 1e-14) << inertia;
  EXPECT_NEAR(acceleration("1E-12, 1, 1", about_x) * 1e-12, -1, 1e-14);
  // A mass centre along the axis adds nothing.
  EXPECT_NEAR(acceleration("2, 2, 1E-6", about_z, "0, 0, 3.7") * 1e-6, -1, 1e-14);
}

}  // namespace
}  // namespace dynalin::cases::slender_body_test
