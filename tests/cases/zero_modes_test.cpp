// Eigenvalues that are zero by the structure of the model are exactly zero, and soft ones are not taken for them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases::zero_modes_test {
namespace {

class ZeroModes : public Cases {
 protected:
  struct Spectrum {
    std::size_t zeros = 0;                     // exact and said to follow from the structure
    std::vector<std::complex<double>> others;  // rad per unit time
  };
  Spectrum solve(const std::string& dataset, const std::string& before = "") const {
    const RunResult r = run(dataset, before + "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    Spectrum s;
    if (r.status != 0) return s;
    const std::size_t last = r.json.at("results").size() - 1;
    for (const auto& v : r.eigenvalues(last)) {
      if (v == 0.0) {
        ++s.zeros;
      } else {
        s.others.push_back(v * 2.0 * std::numbers::pi);
      }
    }
    std::size_t structural = 0;
    for (const auto& m : r.result(last).at("modes")) {
      if (!m.at("structural_zero").get<bool>()) continue;
      ++structural;
      EXPECT_EQ(m.at("error_bound_hz").get<double>(), 0.0);
    }
    EXPECT_EQ(structural, s.zeros);
    return s;
  }
};

std::string free_body(const Vector& at, const char* angles) {
  return fmt::format(
      "Free body\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nPART/2, MASS=3, CM=20, IP=0.5,0.7,0.6,0.05,-0.04,0.06, QG={}, "
      "REULER={}\nMARKER/20, QP=0.2,-0.3,0.1, REULER=0.3,0.8,1.4\nEND\n",
      xyz(at), angles);
}

TEST_F(ZeroModes, a_free_body_has_twelve) {
  for (const Vector& at : {Vector{0, 0, 0}, Vector{1, 2, 3}, Vector{-4e5, 3e6, 7.7e4}}) {
    for (const char* angles : {"0,0,0", "0.4,0.9,-0.7"}) {
      const Spectrum s = solve(free_body(at, angles));
      EXPECT_EQ(s.zeros, 12u);
      EXPECT_TRUE(s.others.empty());
    }
  }
}

// What the bodies feel, gravity less acceleration, is zero, and so is all that follows from it.
TEST_F(ZeroModes, bodies_in_free_fall_have_twelve_each) {
  for (const double scale : {1.0, 10.0}) {
    const Spectrum s = solve(fmt::format(
        "Falling\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=1.76,JGRAV=-6.246,KGRAV=-0.09\nPART/1, GROUND\n"
        "PART/2, MASS=2.428, CM=20, IP=0.5,0.7,0.6,0.05,-0.04,0.06, QG={0},2.931,-0.535, REULER=1.558,-0.761,1.621\n"
        "MARKER/20, PART=2, QP=-4.091,5.434,4.137, REULER=-0.516,0.23,1.092\n"
        "PART/3, MASS=1818, CM=30, IP=50,70,60,5,-4,6, QG=0.965,5.492,-4.221, REULER=1.82,1.114,2.066\n"
        "MARKER/30, PART=3, QP=-2.96,{0},5.405, REULER=1.829,-0.329,-2.437\nEND\n",
        -7.324 * scale));
    EXPECT_EQ(s.zeros, 24u);
    EXPECT_TRUE(s.others.empty());
  }
}

// Two bodies on one mount, with the same place and turn of everything.
std::string tied(const std::string& units, const Vector& at, const Matrix3& turn, double stiffness) {
  const Vector p{0.7, -0.4, 0.9}, q{-0.5, 0.2, -0.6};  // the mount from either body
  const Matrix3 other = turn * rotation_313(0.6, 1.2, -0.8);
  const Vector second = at + turn * p - other * q;
  return "Tied\n" + units +
         fmt::format(
             "PART/1, GROUND\nPART/2, MASS=3, CM=20, IP=0.5,0.7,0.6,0.05,-0.04,0.06, QG={}, REULER={}\n"
             "MARKER/20, QP=0.2,-0.3,0.1\nMARKER/21, QP={}\nPART/3, MASS=2, CM=30, IP=0.3,0.2,0.4, QG={}, REULER={}\n"
             "MARKER/30, QP=-0.1,0.2,0.3\nMARKER/31, QP={}, REULER={}\nBUSHING/1, I=31, J=21, "
             "K={:.17g},{:.17g},{:.17g}, "
             "KT={:.17g},{:.17g},{:.17g}, C=1,2,3, CT=0.1,0.2,0.3\nEND\n",
             xyz(at), reuler(turn), xyz(p), xyz(second), reuler(other), xyz(q), reuler(transpose(other) * turn),
             stiffness, 2 * stiffness, 3 * stiffness, stiffness, 0.5 * stiffness, 0.7 * stiffness);
}

TEST_F(ZeroModes, two_tied_bodies_that_float_have_twelve) {
  const std::string imperial = "UNITS/FORCE=POUND_FORCE, MASS=POUND_MASS, LENGTH=INCH, TIME=SECOND\n",
                    millimetres = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=MILLISECOND\n",
                    metres = "UNITS/SYSTEM=MKS\n";
  for (const std::string& units : {metres, imperial, millimetres}) {
    for (const Vector& at : {Vector{0, 0, 0}, Vector{50, -30, 20}, Vector{-700, 400, 1100}}) {
      for (const double stiffness : {1.0, 1e3, 1e7}) {
        const Spectrum s = solve(tied(units, at, rotation_313(0.4, 0.9, -0.7), stiffness));
        EXPECT_EQ(s.zeros, 12u) << units << xyz(at) << " " << stiffness;
        EXPECT_EQ(s.others.size(), 12u);
      }
    }
  }
}

// The frequencies do not depend on where and how it floats, nor on the zeros taken out.
TEST_F(ZeroModes, what_is_left_does_not_depend_on_the_place) {
  const std::string units = "UNITS/SYSTEM=MKS\n";
  const Spectrum at_origin = solve(tied(units, {0, 0, 0}, Matrix3::identity(), 1e3)),
                 away = solve(tied(units, {50, -30, 20}, rotation_313(0.4, 0.9, -0.7), 1e3));
  ASSERT_EQ(at_origin.others.size(), 12u);
  expect_same(at_origin.others, away.others, 1e-11);
}

// Two round bodies on a flexible joint spin about their axis: nothing acts on them but what rounding leaves. Place,
// velocity, attitude and axis are free.
std::string satellite(const Vector& at, const Matrix3& turn, double spin) {
  return fmt::format(
      "Satellite\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n"
      "PART/2, MASS=10, CM=20, IP=3,3,5, QG={0}, REULER={1}, VX=0, VY=0, VZ=0, WX=0, WY=0, WZ={2}\nMARKER/20\n"
      "MARKER/21, QP=0,0,0.4\n"
      "PART/3, MASS=2, CM=30, IP=0.3,0.3,0.4, QG={3}, REULER={1}, VX=0, VY=0, VZ=0, WX=0, WY=0, WZ={2}\nMARKER/30\n"
      "MARKER/31, QP=0,0,-0.3\nJOINT/1, SPHERICAL, I=31, J=21\n"
      "BUSHING/1, I=31, J=21, K=0,0,0, KT=200,200,250, C=0,0,0, CT=0.5,0.5,0.7\nEND\n",
      xyz(at), reuler(turn), spin, xyz(at + turn * Vector{0, 0, 0.7}));
}

TEST_F(ZeroModes, a_spinning_satellite_has_ten_wherever_it_is) {
  for (const double spin : {0.5, 2.0, 20.0}) {
    const Spectrum upright = solve(satellite({0, 0, 0}, Matrix3::identity(), spin));
    EXPECT_EQ(upright.zeros, 10u);
    EXPECT_EQ(upright.others.size(), 8u);
    for (const auto& [at, turn] : {std::pair(Vector{0, 0, 0}, rotation_313(0.4, 0.9, -0.7)),
                                   std::pair(Vector{4, -7, 9}, rotation_313(2.9, 1.5707, -1.5708)),
                                   std::pair(Vector{700, -400, 1100}, rotation_313(-1.1, 2.2, 0.3))}) {
      const Spectrum moved = solve(satellite(at, turn, spin));
      EXPECT_EQ(moved.zeros, 10u) << xyz(at);
      expect_same(moved.others, upright.others, 1e-10);
    }
  }
}

// A carriage on a rail carries a pendulum: two zeros, and the pendulum with the carriage free, w² = m g l (M + m) /
// (J (M + m) + m l² M).
TEST_F(ZeroModes, a_carriage_with_a_pendulum_has_two) {
  const Spectrum s = solve(
      "Carriage\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1, "
      "REULER=1.5707963267948966,1.5707963267948966,0\nPART/2, MASS=3, CM=20, IP=1,1,1\nMARKER/20\n"
      "MARKER/21, REULER=1.5707963267948966,1.5707963267948966,0\n"
      "PART/3, MASS=2, CM=30, IP=0.4,0.4,0.4\nMARKER/30, QP=0,-0.7,0\nMARKER/31\n"
      "JOINT/1, TRANSLATIONAL, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=20\nEND\n");
  EXPECT_EQ(s.zeros, 2u);
  ASSERT_EQ(s.others.size(), 2u);
  const double w = std::sqrt(2 * 9.81 * 0.7 * 5 / (0.4 * 5 + 2 * 0.49 * 3));
  for (const auto& v : s.others) {
    EXPECT_NEAR(std::abs(v.imag()), w, 1e-12 * w);
    EXPECT_NEAR(v.real(), 0, 1e-12 * w);
  }
}

// Integrators behind a lag, driven by a damped slide: chains of zeros among controllers.
TEST_F(ZeroModes, integrators_have_one_each) {
  const std::string slide =
      "Integrators\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0,1\nMARKER/20\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nSPRINGDAMPER/1, TRANSLATION, I=20, J=1, K=18, C=4, LENGTH=1\n";
  const auto transfer = [](int id, const char* u, const char* numerator, const char* denominator) {
    return fmt::format(
        "VARIABLE/{0}, FUNCTION={1}\nARRAY/{0}0, U, VARIABLES={0}\nARRAY/{0}1, X\nARRAY/{0}2, Y\n"
        "TFSISO/{0}, X={0}1, U={0}0, Y={0}2, NUMERATOR={2}, DENOMINATOR={3}\n",
        id, u, numerator, denominator);
  };
  const std::vector<std::complex<double>> of_slide = {{-1, std::sqrt(8.0)}, {-1, -std::sqrt(8.0)}};
  const auto check = [&](const std::string& more, std::size_t zeros, std::vector<std::complex<double>> others) {
    others.insert(others.end(), of_slide.begin(), of_slide.end());
    const Spectrum s = solve(slide + more + "END\n");
    EXPECT_EQ(s.zeros, zeros) << more;
    expect_same(s.others, others, 1e-12);
  };
  check(transfer(1, "DZ(20)", "1", "0,1"), 1, {});
  check(transfer(1, "DZ(20)", "10", "1,0.005") + transfer(2, "ARYVAL(12,1)", "1", "0,1"), 1, {-200});
  check(transfer(1, "DZ(20)", "1", "0,0,1"), 2, {});
  check(transfer(1, "VZ(20)", "1", "0,3,1") + transfer(2, "ARYVAL(12,1)", "2,1", "0,0.1"), 2, {-3});
  check("DIFF/1, FUNCTION=DZ(20)\nDIFF/2, FUNCTION=DIF(1)\nDIFF/3, FUNCTION=DIF(2)-0.1*DIF(1)\n", 3, {});
}

// A spring of 1e-6 next to one of 1e6 gives a slow mode that is no zero. Sum and product of the two w² are known.
TEST_F(ZeroModes, soft_springs_are_not_rigid) {
  for (const double soft : {1.0, 1e-3, 1e-6}) {
    const double stiff = 1e6, m1 = 2, m2 = 3;
    const Spectrum s = solve(
        fmt::format("Soft\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS={}, CM=20, IP=1,1,1, QG=0,0,1\n"
                    "MARKER/20\nPART/3, MASS={}, CM=30, IP=1,1,1, QG=0,0,2\nMARKER/30\n"
                    "JOINT/1, TRANSLATIONAL, I=20, J=1\nJOINT/2, TRANSLATIONAL, I=30, J=1\n"
                    "SPRINGDAMPER/1, TRANSLATION, I=20, J=1, K={:.17g}, LENGTH=1\n"
                    "SPRINGDAMPER/2, TRANSLATION, I=30, J=20, K={:.17g}, LENGTH=1\nEND\n",
                    m1, m2, soft, stiff));
    EXPECT_EQ(s.zeros, 0u) << soft;
    ASSERT_EQ(s.others.size(), 4u);
    const double sum = (soft + stiff) / m1 + stiff / m2, product = soft * stiff / (m1 * m2);
    const double high = 0.5 * (sum + std::sqrt(sum * sum - 4 * product)), low = product / high;
    // The sum of the springs in one entry keeps the soft one to 1e-16 · stiff.
    const double tolerance = std::max(1e-12, 4e-16 * stiff / soft);
    for (const double w2 : {low, high}) {
      const double w = std::sqrt(w2);
      const auto nearest = std::min_element(s.others.begin(), s.others.end(), [&](auto a, auto b) {
        return std::abs(std::abs(a) - w) < std::abs(std::abs(b) - w);
      });
      EXPECT_NEAR(std::abs(*nearest), w, tolerance * w) << soft;
    }
  }
}

// The same of a body on a mount with one soft direction that lies askew.
TEST_F(ZeroModes, soft_directions_are_not_rigid) {
  const Matrix3 R = rotation_313(0.4, 0.9, -0.7);
  const Spectrum s = solve("Soft mount\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=" + reuler(R) +
                           "\nPART/2, MASS=2, CM=20, IP=0.3,0.3,0.3\nMARKER/20, REULER=" + reuler(R) +
                           "\nBUSHING/1, I=20, J=1, K=1E6,2E6,1E-6, KT=1E6,1E-6,2E6\nEND\n");
  EXPECT_EQ(s.zeros, 0u);
  ASSERT_EQ(s.others.size(), 12u);
  for (const double w2 : {1e-6 / 2, 1e-6 / 0.3}) {
    const double w = std::sqrt(w2);
    const auto near =
        std::count_if(s.others.begin(), s.others.end(), [&](auto v) { return std::abs(std::abs(v) - w) < 1e-3 * w; });
    EXPECT_EQ(near, 2) << w;
  }
}

// However soft a direction is beside the others, what is printed of it is the value within its bound.
TEST_F(ZeroModes, the_softest_directions_are_within_their_bounds) {
  for (const char* angles : {"0,0,0", "0.4,0.9,-0.7"}) {
    for (const double ratio : {1e-11, 1e-12, 1e-13, 1e-14}) {
      const double stiff = 1e9, mass = 2;
      const RunResult r =
          run(fmt::format("Soft\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER={}\nPART/2, MASS={}, CM=20, "
                          "IP=1,1,1\nMARKER/20, REULER={}\nBUSHING/1, I=20, J=1, K={},{},{}, KT={},{},{}\nEND\n",
                          angles, mass, angles, stiff, ratio * stiff, stiff, stiff, stiff, stiff),
              "LINEAR/EIGENSOL\nLINEAR/EIGENSOL, NMODES=2\n");
      ASSERT_EQ(r.status, 0) << r.err;
      const double expected = std::sqrt(ratio * stiff / mass) / (2 * std::numbers::pi);
      for (std::size_t k = 0; k < 2; ++k) {
        double nearest = std::numeric_limits<double>::infinity(), bound = 0;
        for (const auto& m : r.result(k).at("modes")) {
          const double size = std::hypot(m.at("real_hz").get<double>(), m.at("imag_hz").get<double>());
          if (!(std::abs(size - expected) < nearest)) continue;
          nearest = std::abs(size - expected);
          const auto& of = m.at("error_bound_hz");
          bound = of.is_null() ? std::numeric_limits<double>::infinity() : of.get<double>();
        }
        EXPECT_LE(nearest, bound + 1e-12 * expected) << angles << " " << ratio << " " << k;
      }
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::zero_modes_test
