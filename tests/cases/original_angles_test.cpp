// ORIGINAL near the singularity of its angles, and what its numbers of a mode refer to.
#include <gmock/gmock.h>

#include <map>

#include "cases/original_cases.h"

namespace dynalin::cases::original_angles_test {
namespace {

using OriginalAngles = OriginalCases;

// A part on a joint at the origin, its principal z axis inclined by theta against the vertical, on springs.
std::string held_by(const std::string& joint, double theta) {
  return fmt::format(
      "Held\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, PART=1, REULER=0.3,0.9,0.2\n"
      "MARKER/3, PART=1, QP=0.2,-1,0.5\nPART/2, MASS=2, CM=20, IP=1,1.4,2.1, QG=0.1,0.2,-0.3, REULER=0.7,{:.17g},0.4\n"
      "MARKER/20, QP=0.1,0.2,-0.4\nMARKER/21, PART=2\nMARKER/22, PART=2, QP=0.5,0.1,0.3\n"
      "FIELD/1, I=21, J=4, KMATRIX=400,0,0,0,0,0, 0,500,0,0,0,0, 0,0,600,0,0,0, 0,0,0,70,0,0, 0,0,0,0,80,0, "
      "0,0,0,0,0,90, LENGTH=0,0,0,0,0,0, FORCE=0,0,0,0,0,0\nMARKER/4, PART=1, QP=0.1,0.2,-0.3\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=22, J=3, K=200, C=2, LENGTH=1\n{}END\n",
      theta, joint);
}

TEST_F(OriginalAngles, near_the_singularity_states_are_still_those_of_the_original_implementation) {
  const std::vector<std::pair<std::string, std::size_t>> joints = {
      {"", 12},
      {"JPRIM/1, ATPOINT, I=21, J=4\n", 6},
      {"JPRIM/1, PARALLEL_AXES, I=21, J=4\n", 8},
      {"JPRIM/1, PERPENDICULAR, I=21, J=2\n", 10},
      {"JPRIM/1, ATPOINT, I=21, J=4\nJPRIM/2, PERPENDICULAR, I=21, J=2\n", 4},
      {"JPRIM/1, INLINE, I=21, J=4\n", 8}};
  for (const auto& [joint, states] : joints) {
    for (const double degrees : {0.0, 0.06, 0.3, 1.0, 3.0, 4.9, 30.0, 176.0, 179.9, 180.0}) {
      SCOPED_TRACE(fmt::format("{} degrees, {}", degrees, joint));
      const RunResult r = run(held_by(joint, degrees * std::numbers::pi / 180),
                              "SIMULATE/INITIAL\nLINEAR/EIGENSOL, ORIGINAL\nLINEAR/EIGENSOL\n");
      ASSERT_EQ(r.status, 0) << r.err;
      ASSERT_EQ(codes(r, 1).size(), states);
      for (const auto& code : codes(r, 1)) EXPECT_EQ(code[0], 1);
    }
  }
}

// By hand, at ψ = 0 and the nutation θ, c = cos θ, s = sin θ: a unit of ψ turns about Z, one of θ about X, one of φ
// about the third axis (0, −s, c). A body of inertia 1 about all axes, held by 4, 9 and 16 about X, Y and Z:
//
//     turn about X    δθ                      δθ″ = −4 δθ
//     turn about Y    −s δφ                −s δφ″ = 9 s δφ
//     turn about Z    δψ + c δφ    δψ″ + c δφ″ = −16 (δψ + c δφ)
//
// so that δφ″ = −9 δφ and δψ″ = −16 δψ − 7 c δφ, however small θ is. All states are of type 1, the angles 4 ψ, 5 θ, 6
// φ, their rates 10, 11, 12.
TEST_F(OriginalAngles, of_a_body_on_springs_have_the_equations_found_by_hand) {
  for (const double degrees : {0.06, 0.3, 1.0, 4.9, 30.0}) {
    SCOPED_TRACE(degrees);
    const double theta = degrees * std::numbers::pi / 180;
    const RunResult r =
        run(fmt::format("Held\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\n"
                        "MARKER/20, REULER=0,{:.17g},0.4\nMARKER/21\n"
                        "BUSHING/1, I=21, J=1, K=50,72,98, KT=4,9,16, C=0,0,0, CT=0,0,0\nEND\n",
                        theta),
            "SIMULATE/STATIC\nLINEAR/STATEMAT, ORIGINAL, FILE=a\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto states = codes(r, 1);
    ASSERT_EQ(states.size(), 12u);
    std::map<int, std::size_t> at;
    for (std::size_t k = 0; k < states.size(); ++k) {
      EXPECT_EQ(states[k][0], 1);
      EXPECT_EQ(states[k][1], 2);
      at[states[k][2]] = k;
    }
    ASSERT_EQ(at.size(), 12u);
    std::vector<std::vector<double>> expected(12, std::vector<double>(12, 0.0));
    for (int n = 1; n <= 6; ++n) expected[at.at(n)][at.at(n + 6)] = 1;
    const std::array<double, 6> diagonal = {-25, -36, -49, -16, -4, -9};
    for (int n = 1; n <= 6; ++n) expected[at.at(n + 6)][at.at(n)] = diagonal[static_cast<std::size_t>(n - 1)];
    expected[at.at(10)][at.at(6)] = -7 * std::cos(theta);
    expect_matrices(r.matrix(1, "A"), expected, 1e-12);
  }
}

TEST_F(OriginalAngles, near_the_singularity_eigenvalues_at_rest_stay_what_they_are) {
  for (const double degrees : {0.1, 1.0, 3.0, 30.0}) {
    SCOPED_TRACE(degrees);
    const RunResult r = run(held_by("", degrees * std::numbers::pi / 180),
                            "SIMULATE/STATIC\nLINEAR/EIGENSOL, ORIGINAL\nLINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    // ψ and φ move 1/sin θ times as far as their sum, which costs as many digits of the state matrix.
    expect_same(r.eigenvalues(1), r.eigenvalues(2), 1e-9);
  }
}

// A rod on a hinge at the origin and a second part fixed to it, at distances l and far from the hinge.
std::string levers(double l, double far) {
  return fmt::format(
      "Levers\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=0.3,0.2,0.5\nMARKER/20, "
      "QP=0,-{0},0\n"
      "MARKER/21\nPART/3, MASS=3, CM=30, IP=0.1,0.2,0.25\nMARKER/30, QP=0,-{1},0\nMARKER/31\nJOINT/1, REVOLUTE, I=21, "
      "J=1\n"
      "JOINT/2, FIXED, I=31, J=21\nSPRINGDAMPER/1, ROTATIONAL, I=21, J=1, KT=900\nEND\n",
      l, far);
}

TEST_F(OriginalAngles, generalized_mass_refers_to_the_largest_of_all_coordinates_chosen_or_not) {
  for (const auto& [l, far] : {std::pair{0.5, 4.0}, std::pair{0.5, 0.25}, std::pair{3.0, 2.0}}) {
    SCOPED_TRACE(fmt::format("{} {}", l, far));
    const RunResult r = run(levers(l, far), "LINEAR/EIGENSOL, ORIGINAL, COORDS=1\nLINEAR/EIGENSOL, COORDS=1\n");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(r.labels(0)[1], "Global displacement DX(PBCS) PART/2");
    const double inertia = 0.5 + 2 * l * l + 0.25 + 3 * far * far, square = 900 / inertia;
    ASSERT_GT(square, 1);
    // Per radian the mass centres move l and far, the angle about z itself 1.
    const double largest = std::max({1.0, l, far});
    const std::string text = r.text("model.txt"), second = text.substr(text.rfind("Energy table for MODE"));
    expect_close(after(text, "Generalized stiffness"), inertia / (largest * largest), 1e-5);
    expect_close(after(text, "Generalized mass"), inertia / (largest * largest) / square, 1e-5);
    expect_close(after(text, "Kinetic energy"), inertia / (largest * largest) / 2, 1e-5);
    // The default refers to its state, the angle.
    expect_close(after(second, "Generalized mass"), inertia / square, 1e-5);
  }
}

}  // namespace
}  // namespace dynalin::cases::original_angles_test
