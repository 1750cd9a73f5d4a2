// A zero eigenvalue is said to be exact where the structure of the model proves it, and nowhere else.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases::structural_zero_test {
namespace {

class StructuralZeros : public Cases {
 protected:
  struct Mode {
    std::complex<double> value;  // rad per unit time
    double bound;
    bool structural_zero;
  };
  std::vector<Mode> solve(const std::string& dataset, const std::string& commands = "LINEAR/EIGENSOL\n") const {
    const RunResult r = run(dataset, commands);
    EXPECT_EQ(r.status, 0) << r.err;
    std::vector<Mode> modes;
    if (r.status != 0) return modes;
    for (const auto& m : r.result(r.json.at("results").size() - 1).at("modes")) {
      constexpr double cycle = 2 * std::numbers::pi;
      modes.push_back({cycle * std::complex<double>(m.at("real_hz"), m.at("imag_hz")),
                       m.at("error_bound_hz").is_null() ? std::numeric_limits<double>::infinity()
                                                        : cycle * m.at("error_bound_hz").get<double>(),
                       m.at("structural_zero")});
    }
    return modes;
  }
  static std::size_t zeros(const std::vector<Mode>& modes) {
    return static_cast<std::size_t>(std::count_if(modes.begin(), modes.end(), [](const Mode& m) {
      EXPECT_TRUE(!m.structural_zero || (m.value == 0.0 && m.bound == 0));
      return m.structural_zero;
    }));
  }
};

// z′ = A z, A by rows.
std::string linear_states(std::size_t n, const std::vector<double>& A) {
  std::string s = fmt::format(
      "States\nPART/1, GROUND\nARRAY/1, X\nMATRIX/1, FULL=RORDER, ROWS={0}, COLUMNS={0}, "
      "VALUES={1:.17g}",
      n, A[0]);
  for (std::size_t k = 1; k < A.size(); ++k) s += fmt::format("{}{:.17g}", k % 6 ? "," : "\n,  ", A[k]);
  return s + "\nLSE/1, X=1, A=1\nEND\n";
}

TEST_F(StructuralZeros, coefficients_that_all_but_cancel_make_none) {
  const auto modes = solve(linear_states(2, {1e7, -9999999, 10000001, -1e7}));
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_EQ(zeros(modes), 0u);
  for (const Mode& m : modes) EXPECT_LE(std::abs(std::abs(m.value.real()) - 1), m.bound) << m.value << " " << m.bound;
}

// The same as forces: x″ = A x has the values ±1 and ±j.
TEST_F(StructuralZeros, forces_that_all_but_cancel_make_none) {
  const auto modes = solve(
      "Forces\nPART/1, GROUND\nMARKER/1, REULER=90D,90D,0\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, "
      "REULER=90D,90D,0\n"
      "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "JOINT/2, TRANSLATIONAL, I=30, J=1\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=1E7*DX(20,1,0)-9999999*DX(30,1,0)\n"
      "SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=10000001*DX(20,1,0)-1E7*DX(30,1,0)\nEND\n");
  EXPECT_EQ(zeros(modes), 0u);
  for (const Mode& m : modes) EXPECT_LE(std::abs(std::abs(m.value) - 1), m.bound) << m.value << " " << m.bound;
}

// Slides along x with unit masses; springs by stiffness between neighbours, the first one to the ground.
std::string slides(const std::vector<double>& stiffness) {
  std::string s = "Slides\nPART/1, GROUND\nMARKER/1, REULER=90D,90D,0\n";
  for (std::size_t k = 0; k < stiffness.size(); ++k) {
    const std::size_t part = k + 2;
    s += fmt::format(
        "PART/{0}, MASS=1, CM={0}0, IP=1,1,1, QG={1},0,0\nMARKER/{0}0\nMARKER/{0}1, REULER=90D,90D,0\n"
        "JOINT/{0}, TRANSLATIONAL, I={0}1, J=1\n",
        part, part - 1);
    if (stiffness[k] != 0)
      s += fmt::format("SPRINGDAMPER/{0}, TRANSLATION, I={0}0, J={2}, K={1:.17g}, LENGTH=1\n", part, stiffness[k],
                       k == 0 ? "1" : fmt::format("{}0", part - 1));
  }
  return s + "END\n";
}

TEST_F(StructuralZeros, a_soft_spring_beside_a_stiff_one_is_none) {
  for (const double soft : {1e-2, 1e-4, 1e-6, 1e-10}) {
    const auto modes = solve(slides({soft, 1e12}));
    EXPECT_EQ(zeros(modes), 0u) << soft;
  }
  // One that the sum of both still has digits of: w² = k/2.
  const auto modes = solve(slides({1e-1, 1e12}));
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_NEAR(std::norm(modes[0].value), 0.05, 1e-3 * 0.05);
}

// Both slides move alike, and nothing holds them; what lies between stiff and soft springs does not spoil that.
// The same with both directions in one element, along the axes of the ground or not: 14 digits are between them.
TEST_F(StructuralZeros, a_soft_direction_beside_a_stiff_one_of_the_same_element_is_none) {
  const char* const field =
      "FIELD/1, I=2, J=1, KMATRIX=1E14,0,0,0,0,0\n, 0,0.5,0,0,0,0\n, 0,0,2,0,0,0\n, 0,0,0,0,0,0\n, 0,0,0,0,0,0\n, "
      "0,0,0,0,0,0\n";
  for (const char* const force : {"BUSHING/1, I=2, J=1, K=1E14,0.5,2\n", field}) {
    for (const char* const axes : {"", ", REULER=0.3,0.7,0.4"}) {
      for (const char* const beside : {"", "POINT_MASS/9, MASS=1, CM=99, QG=5,0,0\nMARKER/99\n"}) {
        const auto modes =
            solve(fmt::format("Mount\nPART/1, GROUND\nMARKER/1{0}\nPOINT_MASS/2, MASS=1, CM=20\n"
                              "MARKER/20\nMARKER/2\n{1}{2}END\n",
                              axes, force, beside));
        EXPECT_EQ(zeros(modes), *beside ? 6u : 0u) << force << axes;
        // Turned axes leave of the soft direction what their rounding of the stiff one does.
        for (const double soft : {std::sqrt(0.5), std::sqrt(2.0)}) {
          EXPECT_TRUE(std::ranges::any_of(modes,
                                          [&](const Mode& m) {
                                            return std::abs(m.value - std::complex<double>(0, soft)) <= m.bound &&
                                                   (*axes || m.bound < 0.5 * soft);
                                          }))
              << soft << force << axes;
        }
      }
    }
  }
}

// What stiff springs bear holds what is between them across their line, however little that is beside their stiffness;
// at their free length they bear nothing, wherever that is.
TEST_F(StructuralZeros, what_a_stiff_string_bears_beside_its_stiffness_is_none) {
  const auto string = [](const std::array<double, 3>& u, double preload, bool one_side) {
    const double length = std::hypot(u[0], u[1], u[2]);
    std::string s = fmt::format(
        "String\nPART/1, GROUND\nMARKER/1\nMARKER/3, QP={:.17g},{:.17g},{:.17g}\n"
        "POINT_MASS/2, MASS=1, CM=20, QG={:.17g},{:.17g},{:.17g}\nMARKER/20\n",
        2 * u[0], 2 * u[1], 2 * u[2], u[0], u[1], u[2]);
    for (const int to : {1, 3}) {
      if (to == 3 && one_side) continue;
      s += fmt::format("SPRINGDAMPER/{0}, TRANSLATION, I=20, J={0}, K=1E14, LENGTH={1:.17g}, FORCE={2}\n", to, length,
                       preload);
    }
    return s + "END\n";
  };
  for (const std::array<double, 3>& u :
       {std::array{1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.6, 0.8, 0.0}, {0.3, 0.7, 0.4}}) {
    for (const bool one_side : {false, true}) {
      EXPECT_EQ(zeros(solve(string(u, 0, one_side))), 4u) << u[0] << one_side;
      for (const double preload : {-0.5, -1e-3}) {
        // Unbalanced, and no more than what rounding of the length makes of the stiffness.
        if (one_side && preload > -0.5) continue;
        const auto modes = solve(string(u, preload, one_side));
        EXPECT_EQ(zeros(modes), 0u) << preload << " " << u[0] << one_side;
        const double across = std::sqrt(-preload * (one_side ? 1 : 2) / std::hypot(u[0], u[1], u[2]));
        const auto holds = [&](const Mode& m) { return std::abs(m.value - std::complex(0.0, across)) <= m.bound; };
        EXPECT_GE(std::ranges::count_if(modes, holds), 2) << preload << " " << u[0] << one_side;
      }
    }
  }
}

// A bushing that is the same all round lets its own axes spin, whatever it bears and however stiff it is along them.
TEST_F(StructuralZeros, a_loaded_bushing_that_is_the_same_all_round_lets_its_axes_spin) {
  for (const char* const axes : {"", ", REULER=0.3,0.7,0.4"}) {
    const auto modes =
        solve(fmt::format("Rotor\nPART/1, GROUND\nMARKER/1{0}\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=0.002,0.001,0\n"
                          "MARKER/20\nMARKER/2{0}\nBUSHING/1, I=1, J=2, K=500,500,4E13, KT=50,50,0\n"
                          "END\n",
                          axes));
    EXPECT_EQ(zeros(modes), 2u) << axes;
  }
}

TEST_F(StructuralZeros, what_nothing_holds_has_two_whatever_holds_it_together) {
  for (const std::vector<double>& k : {std::vector<double>{0, 1e12, 1e-2, 3}, std::vector<double>{0, 1, 1e-9, 1e9},
                                       std::vector<double>{0, 1e-3, 2e-3}}) {
    const auto modes = solve(slides(k));
    EXPECT_EQ(zeros(modes), 2u);
    for (const Mode& m : modes) EXPECT_EQ(m.structural_zero, m.value == 0.0);
  }
}

TEST_F(StructuralZeros, a_frank_matrix_has_none) {
  for (const std::size_t n : {12u, 16u, 17u, 20u}) {
    std::vector<double> A;
    for (std::size_t i = 1; i <= n; ++i) {
      for (std::size_t j = 1; j <= n; ++j) A.push_back(j + 1 < i ? 0.0 : static_cast<double>(n + 1 - std::max(i, j)));
    }
    EXPECT_EQ(zeros(solve(linear_states(n, A))), 0u) << n;
  }
}

// Integrators first, last and between lags, and states without an equation of their own.
TEST_F(StructuralZeros, integrators_anywhere_in_a_chain_have_one_each) {
  const auto modes = solve(
      "Chain\nPART/1, GROUND\nDIFF/1, IC=1, FUNCTION=DIF(2)\nDIFF/2, IC=1, FUNCTION=-2*DIF(2)+DIF(3)\n"
      "DIFF/3, IC=1, FUNCTION=3*DIF(4)\nDIFF/4, IC=1, FUNCTION=-5*DIF(4)+DIF(5)\nDIFF/5, IC=1, FUNCTION=0\n"
      "DIFF/6, IC=1, FUNCTION=-DIF(6)+DIF(5)\nEND\n");
  ASSERT_EQ(modes.size(), 6u);
  EXPECT_EQ(zeros(modes), 3u);
  EXPECT_NEAR(modes[3].value.real(), -1, 1e-14);
  EXPECT_NEAR(modes[4].value.real(), -2, 1e-14);
  EXPECT_NEAR(modes[5].value.real(), -5, 1e-14);
}

// A sensor with a lag on a slide that floats follows it; a controller that holds the slide by a measured place ends it.
TEST_F(StructuralZeros, sensors_follow_and_controllers_hold) {
  const std::string slide =
      "Slide\nPART/1, GROUND\nMARKER/1, REULER=90D,90D,0\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, "
      "REULER=90D,90D,0\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nDIFF/1, IC=0, FUNCTION=-4*DIF(1)+DX(20,1)\n";
  const auto sensed = solve(slide + "END\n");
  ASSERT_EQ(sensed.size(), 3u);
  EXPECT_EQ(zeros(sensed), 2u);
  const auto held = solve(slide + "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-1E-6*DIF(1)\nEND\n");
  EXPECT_EQ(zeros(held), 0u);
}

// Displacements taken with equal weight: their difference is meant.
TEST_F(StructuralZeros, a_force_of_a_difference_of_displacements_lets_both_go) {
  const auto modes = solve(
      "Difference\nPART/1, GROUND\nMARKER/1, REULER=90D,90D,0\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, "
      "REULER=90D,90D,0\nPART/3, MASS=2, CM=30, IP=1,1,1\nMARKER/30, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=20, "
      "J=1\n"
      "JOINT/2, TRANSLATIONAL, I=30, J=1\n"
      "SFORCE/1, TRANSLATIONAL, I=20, J=30, ACTIONONLY, FUNCTION=-3E5*(DX(20,1)-DX(30,1))\n"
      "SFORCE/2, TRANSLATIONAL, I=30, J=20, ACTIONONLY, FUNCTION=3E5*(DX(20,1)-DX(30,1))\nEND\n");
  ASSERT_EQ(modes.size(), 3u);
  EXPECT_EQ(zeros(modes), 2u);
}

TEST_F(StructuralZeros, a_parallelogram_near_its_flat_position_keeps_its_stiffness) {
  for (const double angle : {1e-1, 1e-3, 1e-5, 1e-6}) {
    for (const double speed : {0.0, 300.0}) {
      const auto modes = solve(parallelogram(angle, speed, 25));
      EXPECT_EQ(zeros(modes), 0u) << angle << " " << speed;
    }
  }
}

TEST_F(StructuralZeros, a_parallelogram_without_a_spring_moves_freely) {
  for (const double angle : {1e-1, 0.7, 1.2}) EXPECT_EQ(zeros(solve(parallelogram(angle, 0, 0))), 2u);
}

// A part on a stretched spring at its mass centre turns freely, whatever accelerates: its angular acceleration is none,
// though the torque of a force at an arm along it is rounding.
TEST_F(StructuralZeros, a_part_that_is_pulled_at_its_mass_centre_turns_freely) {
  for (const char* at : {"-0.94,-0.56,0.8", "-0.31,0.77,1.1", "0.5,0.25,0.125"}) {
    const RunResult r =
        run(fmt::format("Pulled\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=-0.3,0.5,0.2\n"
                        "PART/2, MASS=5.65, CM=20, IP=0.706,0.385,0.73, QG=-0.92,0.12,0.81\nMARKER/20\n"
                        "MARKER/21, QP=0.11,-0.07,0.05\nMARKER/22, QP=-0.09,0.12,0.06\n"
                        "PART/3, MASS=2.91, CM=30, IP=0.28,0.333,0.382, QG={}\nMARKER/30\n"
                        "BUSHING/1, I=21, J=1, K=708,484,110, KT=66,77,56, C=0.54,0.37,0.084, CT=0.05,0.06,0.04\n"
                        "SPRINGDAMPER/2, TRANSLATIONAL, I=22, J=30, K=1422, C=5.7, LENGTH=0.84\nEND\n",
                        at),
            "LINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    std::size_t zeros = 0;
    for (const auto& m : r.result(0).at("modes")) zeros += m.at("structural_zero").get<bool>() ? 1u : 0u;
    EXPECT_EQ(zeros, 6u) << at;
  }
}

// An integrator that nothing follows takes away none of the motions of what floats: two bodies on a bushing have
// twelve zeros and a clock one more.
// What a spin makes of the inertia cancels along an axis of it, and is nothing but rounding where the axis is inclined.
TEST_F(StructuralZeros, of_a_rotor_that_spins_on_an_inclined_hinge_are_two) {
  const auto rotor = [](const Vector& angles, const std::string& more) {
    return fmt::format(
        "Rotor\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER={0}\n"
        "PART/2, MASS=1, CM=2, IP=1,1,0.1, REULER={0}, WZ=2\nMARKER/2\nJOINT/1, REVOLUTE, I=2, J=1\n{1}END\n",
        xyz(angles), more);
  };
  for (const Vector& angles : {Vector{1, 1, 1}, Vector{-2.3, 0.7, 2.9}, Vector{0.4, -1.2, 0.3}, Vector{2, 2.5, -3}}) {
    for (const char* more : {"", "SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=2\n"}) {
      const auto modes = solve(rotor(angles, more));
      ASSERT_EQ(modes.size(), 2u);
      EXPECT_EQ(zeros(modes), 2u) << xyz(angles) << more;
    }
    // Far softer than the spin is stiff, and held all the same: ω² = KT/Izz.
    const auto held = solve(rotor(angles, "SPRINGDAMPER/1, ROTATIONAL, I=2, J=1, KT=1E-9, CT=0, ANGLE=0\n"));
    EXPECT_EQ(zeros(held), 0u) << xyz(angles);
    for (const Mode& m : held) EXPECT_LE(std::abs(std::abs(m.value.imag()) - 1e-4), m.bound + 1e-12) << xyz(angles);
  }
}

TEST_F(StructuralZeros, of_floating_bodies_stand_beside_integrators) {
  const std::string bodies =
      "Bodies\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,2,2.5\nMARKER/2, PART=2\n"
      "PART/3, MASS=1.3, CM=3, IP=1,2,2.5, QG=1,0,0\nMARKER/3, PART=3\nMARKER/4, PART=3, QP=-1,0,0\n"
      "BUSHING/1, I=4, J=2, K=100,200,300, KT=10,20,30, C=0.1,0.2,0.3, CT=0.1,0.2,0.1\n";
  EXPECT_EQ(zeros(solve(bodies + "END\n")), 12u);
  for (const std::string more : {"DIFF/1, FUNCTION=1\n", "DIFF/1, FUNCTION=VZ(2,1,1)\n",
                                 "VARIABLE/1, FUNCTION=DX(2)\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\n"
                                 "TFSISO/1, U=1, X=2, Y=3, NUMERATOR=1, DENOMINATOR=0,1\n"})
    EXPECT_EQ(zeros(solve(bodies + more + "END\n")), 13u) << more;
}

}  // namespace
}  // namespace dynalin::cases::structural_zero_test
