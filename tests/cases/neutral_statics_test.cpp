// What may stand anywhere stays where it is drawn: statics do not move along what nothing holds, however the model as
// a whole is turned. Where a load drives such a motion, a refusal names what moves.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "cases/run.h"
#include "cases/study_of.h"

namespace dynalin::cases::neutral_statics_test {
namespace {

using Matrix = Eigen::Matrix3d;
using Vector3 = Eigen::Vector3d;

// Body-fixed 3-1-3.
Matrix turned(const Vector3& angles) {
  using Eigen::AngleAxisd;
  return (AngleAxisd(angles[0], Vector3::UnitZ()) * AngleAxisd(angles[1], Vector3::UnitX()) *
          AngleAxisd(angles[2], Vector3::UnitZ()))
      .toRotationMatrix();
}
std::string text(const Vector3& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v[0], v[1], v[2]); }

// A cylinder that lies on a box and may roll, a millimetre too deep: it is pushed out, and nothing turns it.
std::string rolling_cylinder(const Vector3& angles) {
  const Matrix R = turned(angles);
  const Vector3 g = R * Vector3(0, 0, -10);
  const std::string turn = ", REULER=" + text(angles);
  return fmt::format("Cylinder lying on a box\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV={:.17g}, JGRAV={:.17g}, KGRAV={:.17g}\n",
                     g[0], g[1], g[2]) +
         "PART/1, GROUND\nMARKER/1" + turn + "\nMARKER/5, QP=" + text(R * Vector3(-2, -2, -0.5)) + turn +
         "\nGRAPHICS/1, BOX, CORNER=5, X=4, Y=4, Z=.5\nPART/2, MASS=2, CM=2, IP=.02,.03,.04, QG=" +
         text(R * Vector3(0, 0, 0.149)) + turn +
         "\nMARKER/2\nMARKER/3, QP=-.2,0,0, REULER=90D,90D,0\nGRAPHICS/2, CYLINDER, CM=3, LENGTH=.4, RADIUS=.15\n"
         "BUSHING/1, I=2, J=1, K=30,30,0, KT=0,0,1\nCONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E4, EXPONENT=1.3, "
         "DAMPING=20, DMAX=.001\nEND\n";
}

class NeutralStatics : public Cases {};

TEST_F(NeutralStatics, leave_a_cylinder_that_may_roll_as_it_is_turned) {
  for (const Vector3& angles : {Vector3(0, 0, 0), Vector3(0, 0.01, 0), Vector3(0.3, 0.7, -0.4), Vector3(-1, 2, 0.6),
                                Vector3(0, 1.5, 0), Vector3(1e-9, 1e-7, 0)}) {
    const auto study = study_of(rolling_cylinder(angles));
    const auto rest = study.static_equilibrium();
    // As seen from the box: each axis of the cylinder along that of the box, and where the weight of 20 is borne.
    const std::vector<double> seen =
        study.measured(rest, {"DX(2,1,1)", "DY(2,1,1)", "DZ(2,1,1)", "AX(2,1)", "AY(2,1)", "AZ(2,1)"});
    const double depth = std::pow(10 / 1e4, 1 / 1.3);  // at both ends
    EXPECT_NEAR(seen[0], 0, 1e-12) << text(angles);
    EXPECT_NEAR(seen[1], 0, 1e-12) << text(angles);
    EXPECT_NEAR(seen[2], 0.15 - depth, 1e-9) << text(angles);
    for (std::size_t k = 3; k < 6; ++k) EXPECT_NEAR(seen[k], 0, 1e-8) << text(angles) << " " << k;
  }
}

// A load of 2 pulls the rope off a drum of radius 0.25, for ever.
TEST_F(NeutralStatics, name_what_a_load_moves_that_nothing_holds) {
  const RunResult r = run(
      "Load on a drum\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\nPART/3, MASS=50, CM=30, "
      "IP=10,10,10\nMARKER/30\nMARKER/31, QP=0,0,-0.1\nMARKER/36, QP=-1,0,0.3, REULER=0,90D,0\nBUSHING/1, I=30, J=1, "
      "K=1E6,2E6,3E6, KT=1E5,2E5,3E5\nPART/7, MASS=5, CM=70, IP=1,1,1, QG=-1,0,0.3\nMARKER/70, REULER=0,90D,0\n"
      "JOINT/6, REVOLUTE, I=70, J=36\nPART/9, MASS=2, CM=90, IP=1,2,3, QG=0.01,0.02,-3\nMARKER/90\nMARKER/91, "
      "QP=0,0,0.2\nBUSHING/2, I=91, J=31, K=0,0,0, KT=1,2,3\nVARIABLE/7, FUNCTION=2.7-0.25*AZ(70,36)\nSFORCE/1, "
      "TRANSLATIONAL, I=91, J=31, FUNCTION=-1E4*(DM(91,31)-VARVAL(7))\nSFORCE/6, ROTATIONAL, I=70, J=36, "
      "FUNCTION=0.25*SFORCE(1,0,1,0)\nEND\n",
      "SIMULATE/STATICS\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, ::testing::HasSubstr("nothing holds PART/7, PART/9 against the moment (0, -4.99"));
  EXPECT_THAT(r.err, ::testing::Not(::testing::HasSubstr("undetermined")));
}

}  // namespace
}  // namespace dynalin::cases::neutral_statics_test
