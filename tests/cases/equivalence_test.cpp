// One mechanism written in several ways has one set of eigenvalues; redundant mechanisms keep theirs.
#include <gmock/gmock.h>

#include "cases/dataset_text.h"

namespace dynalin::cases::equivalence_test {
namespace {

class Equivalence : public Cases {
 protected:
  std::vector<std::complex<double>> solve(const std::string& dataset,
                                          const std::string& first = "SIMULATE/INITIAL") const {
    const RunResult r = run(dataset, first + "\nLINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.eigenvalues(1) : std::vector<std::complex<double>>();
  }
};

TEST_F(Equivalence, transfer_function_state_equations_and_differential_equations) {
  // y = (2 + 3 s + s²)/(5 + 4 s + 2 s² + s³) u from a displacement to a force.
  const std::string input =
      "VARIABLE/1, FUNCTION=DX(31,21)+0.2*VY(30,1)\nVARIABLE/3, FUNCTION=VARVAL(2)\nSFORCE/1, TRANSLATIONAL, I=30, "
      "J=20, FUNCTION=5*VARVAL(3)\n";
  const std::string arrays = "ARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\nVARIABLE/2, FUNCTION=ARYVAL(3,1)\n";
  const auto tfsiso = solve(two_bodies(input + arrays + "TFSISO/1, U=1, X=2, Y=3, NUM=2,3,1, DEN=5,4,2,1\n"));
  const auto lse = solve(two_bodies(
      input + arrays +
      "MATRIX/1, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=0,1,0, 0,0,1, -5,-4,-2\nMATRIX/2, SPARSE, I=3, J=1, VALUES=1\n"
      "MATRIX/3, FULL=RORDER, ROWS=1, COLUMNS=3, VALUES=2,3,1\nLSE/1, U=1, X=2, Y=3, A=1, B=2, C=3\n"));
  const auto diff = solve(two_bodies(
      input +
      "DIFF/1, FUNCTION=DIF(2)\nDIFF/2, FUNCTION=DIF(3)\nDIFF/3, FUNCTION=-5*DIF(1)-4*DIF(2)-2*DIF(3)+VARVAL(1)\n"
      "VARIABLE/2, FUNCTION=2*DIF(1)+3*DIF(2)+DIF(3)\n"));
  const auto implicit =
      solve(two_bodies(input +
                       "DIFF/1, FUNCTION=DIF(2)\nDIFF/2, FUNCTION=DIF(3)\nDIFF/3, IMPLICIT, "
                       "FUNCTION=DIF1(3)+5*DIF(1)+4*DIF(2)+2*DIF(3)-VARVAL(1)\n"
                       "DIFF/4, IMPLICIT, FUNCTION=DIF(4)-2*DIF(1)-3*DIF1(1)-DIF1(2)\nVARIABLE/2, FUNCTION=DIF(4)\n"));
  EXPECT_FALSE(tfsiso.empty());
  expect_same(tfsiso, lse);
  expect_same(tfsiso, diff);
  expect_same(tfsiso, implicit);
}

TEST_F(Equivalence, a_transfer_function_of_seventh_order) {
  std::string chain, arrays = "ARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\nVARIABLE/2, FUNCTION=ARYVAL(3,1)\n";
  const std::string input = "VARIABLE/1, FUNCTION=DX(31,21)\nSFORCE/1, TRANSLATIONAL, I=30, J=20, FUNCTION=VARVAL(2)\n";
  for (int k = 1; k < 7; ++k) chain += fmt::format("DIFF/{}, FUNCTION=DIF({})\n", k, k + 1);
  chain +=
      "DIFF/7, FUNCTION=VARVAL(1)-(9*DIF(1)+20*DIF(2)+30*DIF(3)+25*DIF(4)+16*DIF(5)+9*DIF(6)+4*DIF(7))\nVARIABLE/2, "
      "FUNCTION=4*DIF(1)-3*DIF(4)\n";
  expect_same(solve(two_bodies(input + arrays + "TFSISO/1, U=1, X=2, Y=3, NUM=4,0,0,-3, DEN=9,20,30,25,16,9,4,1\n")),
              solve(two_bodies(input + chain)));
}

TEST_F(Equivalence, a_part_in_two_pieces_that_are_fixed_to_each_other) {
  // The same mass and inertia as one part and as two; the second piece rides on the first.
  const auto text = [](bool split) {
    std::string s =
        "Pieces\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=1,0.5,0\nMARKER/3, "
        "QP=-0.6,0.8,0.2\nMARKER/4, QP=0.1,-0.7,0.9\n";
    if (split) {
      s += "PART/2, MASS=2, CM=20, IP=0.2,0.3,0.4, WX=0.4, WY=-0.3, WZ=0.8\nMARKER/20\nMARKER/21, QP=0.5,0.2,-0.1, "
           "REULER=0.3,0.7,-0.4\n"
           "PART/3, MASS=1, CM=30, IP=0.1,0.15,0.12, QG=0.5,0.2,-0.1, "
           "REULER=0.3,0.7,-0.4\nMARKER/30\nMARKER/31\nJOINT/2, FIXED, I=31, J=21\n";
    } else {
      // About the common mass centre c = (r1·2 + r2·1)/3.
      const Vector r2{0.5, 0.2, -0.1}, c = r2 / 3.0;
      const Matrix3 R = rotation_313(0.3, 0.7, -0.4);
      Matrix3 J = R * Matrix3{{0.1, 0, 0}, {0, 0.15, 0}, {0, 0, 0.12}} * transpose(R);
      J = J + Matrix3{{0.2, 0, 0}, {0, 0.3, 0}, {0, 0, 0.4}};
      const Matrix3 S1 = skew(c), S2 = skew(r2 - c);
      J = J + 2.0 * (transpose(S1) * S1) + transpose(S2) * S2;
      s += fmt::format(
          "PART/2, MASS=3, CM=20, IP={:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}, WX=0.4, WY=-0.3, "
          "WZ=0.8\nMARKER/20, QP={}\nMARKER/21, QP=0.5,0.2,-0.1\n",
          J(0, 0), J(1, 1), J(2, 2), -J(0, 1), -J(0, 2), -J(1, 2), xyz(c));
    }
    return s +
           "MARKER/22, PART=2\nJOINT/1, SPHERICAL, I=22, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=21, J=2, K=90, C=1, "
           "LENGTH=0.6\n"
           "SPRINGDAMPER/2, TRANSLATIONAL, I=21, J=3, K=70, C=1, LENGTH=0.7\nSPRINGDAMPER/3, TRANSLATIONAL, I=21, J=4, "
           "K=50, C=2, LENGTH=0.4\nEND\n";
  };
  expect_same(solve(text(false)), solve(text(true)));
}

// Six bars along the edges of a cube with hinges across both their neighbours: mobile, though it has thirty rows.
std::string bricard(const std::string& last_joint) {
  const std::array<Vector, 6> P = {Vector{0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {1, -1, 1}, {0, -1, 1}, {0, 0, 1}};
  // REULER that puts z along the axis of the hinge at each corner: y, z, x, y, z, x.
  const std::array<const char*, 6> axes = {"0,-90D,0", "0,0,0", "90D,90D,0", "0,-90D,0", "0,0,0", "90D,90D,0"};
  std::string s = "Bricard\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\n";
  s += fmt::format("MARKER/1, QP={}, REULER={}\nMARKER/2, QP={}, REULER={}\nMARKER/3, QP=2,-1,2\n", xyz(P[0]), axes[0],
                   xyz(P[5]), axes[5]);
  for (std::size_t k = 0; k < 5; ++k) {
    const Vector along = P[k + 1] - P[k];
    const auto inertia = [&](double x) { return x != 0 ? 1e-4 : 1.0 / 12; };
    s += fmt::format(
        "PART/{0}, MASS=1, CM={1}, IP={2},{3},{4}, QG={5}\nMARKER/{1}, QP={6}\nMARKER/{7}, REULER={8}\nMARKER/{9}, "
        "QP={10}, REULER={11}\n",
        k + 2, 10 * (k + 2), inertia(along.x), inertia(along.y), inertia(along.z), xyz(P[k]), xyz(along / 2.0),
        10 * (k + 2) + 1, axes[k], 10 * (k + 2) + 2, xyz(along), axes[k + 1]);
  }
  s += "JOINT/1, REVOLUTE, I=21, J=1\n";
  for (int k = 2; k <= 5; ++k) s += fmt::format("JOINT/{0}, REVOLUTE, I={1}1, J={0}2\n", k, k + 1);
  return s + last_joint + "SPRINGDAMPER/1, TRANSLATIONAL, I=42, J=3, K=60, C=1, LENGTH=0.5\nEND\n";
}

TEST_F(Equivalence, bricards_mechanism_has_one_freedom_and_names_one_row) {
  const RunResult whole = run(bricard("JOINT/6, REVOLUTE, I=62, J=2\n"), "SIMULATE/STATIC\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_EQ(whole.eigenvalues(1).size(), 2u);
  std::size_t named = 0;
  for (std::size_t at = whole.message.find("deactivating"); at != std::string::npos;
       at = whole.message.find("deactivating", at + 1))
    ++named;
  EXPECT_EQ(named, 1u);
  // Without the row that depends on the others.
  const std::string point = "JPRIM/6, ATPOINT, I=62, J=2\n";
  expect_same(
      whole.eigenvalues(1),
      solve(bricard(point + "JPRIM/7, PERPENDICULAR, I=63, J=2\nMARKER/63, PART=6, QP=0,1,0\n"), "SIMULATE/STATIC"),
      1e-8);
}

}  // namespace
}  // namespace dynalin::cases::equivalence_test
