// Mechanisms near their dead points, moving and at rest: the linear model is right, or it is refused with a reason.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <regex>

#include "cases/dataset_text.h"

namespace dynalin::cases::near_singular_test {
namespace {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

class NearSingular : public Cases {
 protected:
  // Examines one mechanism of one freedom whose coefficients are known: x″ = a1 x′ + a0 x, known to `digits` relative.
  // Says whether it was linearized.
  bool examine(const std::string& dataset, double a1, double a0, double digits,
               const std::string& commands = "") const {
    const RunResult r = run(dataset, commands + "LINEAR/EIGENSOL\n");
    if (r.status == 2) {
      EXPECT_NE(r.err.find("singular"), std::string::npos) << r.err;
      EXPECT_TRUE(r.err.find("JOINT/") != std::string::npos || r.err.find("GEAR/") != std::string::npos) << r.err;
      return false;
    }
    EXPECT_EQ(r.status, 0) << r.err;
    if (r.status != 0) return false;
    const std::string said = r.err + r.out + r.message;
    if (said.find("configuration is singular") != std::string::npos) return false;
    std::smatch stated;
    if (std::regex_search(said, stated, std::regex("changes the state matrix by ([0-9.e+-]+) of its size")))
      digits = std::max(digits, 10 * std::stod(stated[1]));
    const auto& result = r.result(r.json.at("results").size() - 1);
    const auto values = r.eigenvalues(r.json.at("results").size() - 1);
    EXPECT_EQ(values.size(), 2u);
    if (values.size() != 2) return true;
    constexpr double cycle = 2 * std::numbers::pi;
    double bound = 0;
    for (const auto& mode : result.at("modes"))
      bound = std::max(bound, cycle * mode.at("error_bound_hz").get<double>());
    const std::complex<double> sum = cycle * (values[0] + values[1]), product = cycle * cycle * values[0] * values[1];
    const double sizes = cycle * (std::abs(values[0]) + std::abs(values[1]));
    EXPECT_LE(std::abs(product + a0), digits * std::abs(a0) + bound * (sizes + bound)) << product << " for " << -a0;
    EXPECT_LE(std::abs(sum - a1), digits * std::max(std::abs(a1), std::sqrt(std::abs(a0))) + 2 * bound)
        << sum << " for " << a1;
    return true;
  }
};

std::string angles_text(const Real& psi, const Real& theta = 0, const Real& phi = 0) {
  return fmt::format("{:.17g},{:.17g},{:.17g}", psi.convert_to<double>(), theta.convert_to<double>(),
                     phi.convert_to<double>());
}

TEST_F(NearSingular, parallelograms_near_the_flat_position) {
  for (int k = 1; k <= 12; ++k) {
    const double angle = std::pow(10.0, -k);
    const bool at_rest = examine(parallelogram(angle, 0, 28), 0, -8, 1e-9);
    EXPECT_TRUE(at_rest || k > 8) << k;
    const bool moving = examine(parallelogram(angle, 300, 28), 0, -8, 1e-9);
    EXPECT_TRUE(moving || k > 4) << k;
  }
}

// Where a row is left out as dependent that is none right beside the point, the model would have a freedom too many.
TEST_F(NearSingular, parallelograms_that_would_gain_a_freedom_are_refused_with_the_row_and_the_distance) {
  for (const double angle : {3e-10, 1e-11, 4e-13}) {
    EXPECT_EQ(run(parallelogram(angle, 0, 28), "LINEAR/EXPORT, TYPE=OPENBOX, FILE=deck\n").status, 2) << angle;
    const RunResult r = run(parallelogram(angle, 0, 28), "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 2) << angle;
    std::smatch stated;
    ASSERT_TRUE(std::regex_search(
        r.err, stated,
        std::regex(R"(in JOINT/\d+ .*all but depend.*relative distance below ([0-9.e+-]+).*1 more degree of freedom)")))
        << r.err;
    EXPECT_GE(std::stod(stated[1]), angle / 10);
    EXPECT_LE(std::stod(stated[1]), 100 * angle);
  }
  // A third rocker makes rows redundant everywhere, drawn as exactly as numbers are or not.
  for (const double off : {0.0, 1e-11}) {
    std::string text = parallelogram(0.7, 0, 28);
    text.insert(text.find("JOINT/1"), "MARKER/3, PART=1, QP=1,0,0\nMARKER/33, PART=3, QP=1,0,0\n");
    text.insert(text.find("JOINT/1"),
                fmt::format("PART/5, MASS=1, CM=50, IP=1,1,1, QG={:.17g},0,0, REULER=0.7,0,0\nMARKER/50, "
                            "QP=0.5,0,0\nMARKER/51\nMARKER/52, QP=1,0,0\n",
                            1 + off));
    text.insert(text.find("SPRINGDAMPER"), "JOINT/5, REVOLUTE, I=51, J=3\nJOINT/6, REVOLUTE, I=52, J=33\n");
    const RunResult r = run(text, "LINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(r.eigenvalues(0).size(), 2u);
  }
}

// Gears of inertia 2 and 5 on springs 8 and 3, 0.4 apart. Their teeth meet at `pitch` on the line of centres and move
// along an axis that is `tilt` away from the axes of the gears: b₁ = pitch sin(tilt), b₂ = (pitch − 0.4) sin(tilt).
std::string gears(double pitch, double tilt, double speed) {
  const double ratio = pitch / (pitch - 0.4);
  return fmt::format(
      "Gears\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/8, QP={:.17g},0,0, REULER=180D,{:.17g},0\n"
      "MARKER/9, QP=0.4,0,0\nPART/2, MASS=1, CM=20, IP=1,1,2, WZ={:.17g}\nMARKER/20\n"
      "PART/3, MASS=1, CM=30, IP=4,4,5, QG=0.4,0,0, WZ={:.17g}\nMARKER/30\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=9\nGEAR/1, JOINTS=1,2, CV=8\n"
      "SPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=8, CT=0, ANGLE=0\n"
      "SPRINGDAMPER/2, ROTATIONAL, I=30, J=9, KT=3, CT=0, ANGLE=0\nEND\n",
      pitch, tilt, speed, ratio * speed);
}

// One of the gears is held where the teeth meet on its axis; with both radii small, or teeth that move all but along
// the axes, the ratio is what it was.
TEST_F(NearSingular, gears_with_teeth_near_an_axis_or_moving_nearly_along_it) {
  const auto expected = [](double pitch) {
    const double r = pitch / (pitch - 0.4);
    return -(8 + 3 * r * r) / (2 + 5 * r * r);
  };
  for (int k = 1; k <= 12; ++k) {
    const double near = std::pow(10.0, -k);
    for (const double speed : {0.0, 30.0}) {
      SCOPED_TRACE(fmt::format("{} {}", k, speed));
      EXPECT_TRUE(examine(gears(near, 1.1, speed), 0, expected(near), 1e-12));
      EXPECT_TRUE(examine(gears(-near, 1.1, speed), 0, expected(-near), 1e-12));
      // The second radius is a difference, of which the numbers of the dataset leave so much.
      const double radius = 0.4 - (0.4 - near);
      EXPECT_TRUE(examine(gears(0.4 - near, 1.1, speed / 1000), 0, expected(0.4 - radius), 1e-12 + 1e-16 / near));
      EXPECT_TRUE(examine(gears(0.1, near, speed), 0, expected(0.1), 1e-12));
      if (k > 8) continue;
      EXPECT_TRUE(examine(gears(0.1, std::numbers::pi - near, speed), 0, expected(0.1), 1e-12));
    }
  }
  // Where the teeth move along the axes, turning does not move them.
  const RunResult r = run(gears(0.1, 0, 0), "LINEAR/EIGENSOL\n");
  EXPECT_NE(r.err.find("GEAR/1"), std::string::npos) << r.err;
  EXPECT_TRUE(r.status == 2 || r.eigenvalues(0).size() == 4) << r.err;
}

// Shafts of inertia 2 and 3 on springs 5 and 7, the second `bend` away from being in line with the first.
std::string constant_velocity(double bend, double turn, double speed) {
  const auto along = [&](double about) {
    return fmt::format("{:.17g},{:.17g},{:.17g}", std::numbers::pi / 2, std::numbers::pi - bend,
                       about - std::numbers::pi / 2);
  };
  return fmt::format(R"(Shafts
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1
MARKER/2, REULER={0}
PART/2, MASS=1, CM=20, IP=1,1,2, WZ={2:.17g}
MARKER/20
MARKER/21, REULER={3:.17g},0,0
PART/3, MASS=1, CM=30, IP=3,3,3, WZ={2:.17g}
MARKER/30, REULER={0}
MARKER/31, REULER={1}
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, REVOLUTE, I=30, J=2
JOINT/3, CONVEL, I=21, J=31
SPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=5, CT=0, ANGLE=0
SPRINGDAMPER/2, ROTATIONAL, I=30, J=2, KT=7, CT=0, ANGLE=0
END
)",
                     along(0), along(turn), speed, turn);
}

TEST_F(NearSingular, constant_velocity_joints_with_their_shafts_nearly_in_line) {
  for (int k = 1; k <= 8; ++k) {
    for (const double turn : {0.0, 0.4}) {
      for (const double speed : {0.0, 50.0}) {
        const std::string dataset = constant_velocity(std::pow(10.0, -k), turn, speed);
        EXPECT_TRUE(examine(dataset, 0, -12.0 / 5, 1e-12)) << k << ' ' << turn << ' ' << speed;
      }
    }
  }
  // Nearer than that the equation counts as redundant, and in line there is none.
  for (const double bend : {1e-9, 1e-11}) {
    const RunResult r = run(constant_velocity(bend, 0.4, 50), "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.eigenvalues(0).size(), 4u) << bend;
    EXPECT_NE(r.err.find("JOINT/3 depends on other constraints but for less than"), std::string::npos) << r.err;
  }
  const RunResult r = run(constant_velocity(std::numbers::pi, 0.4, 0), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.eigenvalues(0).size(), 2u);
  std::string in_line = constant_velocity(0, 0.4, 50);
  for (const std::string_view name : {"MARKER/2,", "MARKER/30,", "MARKER/31,"}) {
    const std::size_t at = in_line.find(name);
    in_line.replace(at, in_line.find('\n', at) - at, std::string(name) + " REULER=0,180D,0");
  }
  const RunResult free = run(in_line, "LINEAR/EIGENSOL\n");
  EXPECT_EQ(free.eigenvalues(0).size(), 4u);
  EXPECT_NE(free.err.find("Xi.Yj-Yi.Xj in JOINT/3 holds nothing here"), std::string::npos) << free.err;
}

// Crank of length 1 with inertia 2 about its hinge, rod of length 3 with its mass 1 and inertia 1/2 at the wrist pin,
// slider of mass 2, a spring of stiffness 7 on the crank that is free at `free_angle`.
std::string slider_crank(const Real& angle, double speed, double free_angle) {
  const Real c = cos(angle), s = sin(angle), tilt = asin(s / 3), x = c + 3 * cos(tilt);
  const Real w = speed, tilt_rate = w * c / (3 * cos(tilt)), v = -w * s - 3 * sin(tilt) * tilt_rate;
  const auto d = [](const Real& r) { return r.convert_to<double>(); };
  return fmt::format(
      "Slider-crank\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, REULER=90D,90D,0\n"
      "PART/2, MASS=1, CM=20, IP=2,2,2, REULER={0}, WZ={1:.17g}\nMARKER/20\nMARKER/22, QP=1,0,0\n"
      "PART/3, MASS=1, CM=30, IP=0.5,0.5,0.5, QG={2:.17g},{3:.17g},0, REULER={4}, VX={5:.17g}, VY=0, "
      "WZ={6:.17g}\nMARKER/30, QP=3,0,0\nMARKER/31\nPART/4, MASS=2, CM=40, IP=1,1,1, QG={7:.17g},0,0, "
      "VX={5:.17g}\nMARKER/40\nMARKER/41, REULER=90D,90D,0\nJOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=31, "
      "J=22\n"
      "JOINT/3, REVOLUTE, I=30, J=40\nJOINT/4, TRANSLATIONAL, I=41, J=2\n"
      "SPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=7, CT=0, ANGLE={8:.17g}\n",
      angles_text(angle), speed, d(c), d(s), angles_text(-tilt), d(v), d(-tilt_rate), d(x), free_angle);
}

// J(a) a″ + ½ J′ a′² + 7 (a − free) = 0.
Real slider_crank_inertia(const Real& a) {
  const Real tilt = asin(sin(a) / 3), tilt_slope = cos(a) / (3 * cos(tilt));
  const Real slope = -sin(a) - 3 * sin(tilt) * tilt_slope;
  return 2 + 3 * slope * slope + tilt_slope * tilt_slope / 2;
}
template <class F>
Real slope_of(F&& f, const Real& at) {
  const Real h("1e-16");
  return (8 * (f(at + h) - f(at - h)) - (f(at + 2 * h) - f(at - 2 * h))) / (12 * h);
}

TEST_F(NearSingular, slider_cranks_near_both_dead_points) {
  for (int k = 1; k <= 12; ++k) {
    for (const double dead : {0.0, std::numbers::pi}) {
      for (const double speed : {0.0, 40.0}) {
        const Real angle = Real(dead == 0 ? std::pow(10.0, -k) : dead - std::pow(10.0, -k));
        const auto inertia_slope = [](const Real& a) { return slope_of(slider_crank_inertia, a); };
        const auto acceleration = [&](const Real& a) {
          return -(inertia_slope(a) * speed * speed / 2 + 7 * (a - Real("0.3"))) / slider_crank_inertia(a);
        };
        const Real a0 = slope_of(acceleration, angle), a1 = -inertia_slope(angle) * speed / slider_crank_inertia(angle);
        EXPECT_TRUE(
            examine(slider_crank(angle, speed, 0.3) + "END\n", a1.convert_to<double>(), a0.convert_to<double>(), 1e-9))
            << k << " " << dead << " " << speed;
      }
    }
  }
}

// With the slider's displacement as the coordinate the crank moves 1/angle times as far. At rest where the spring is
// free the values do not depend on it: 7/J.
TEST_F(NearSingular, slider_cranks_in_the_coordinate_of_the_slider) {
  for (int k = 1; k <= 12; ++k) {
    const double angle = std::pow(10.0, -k);
    const std::string dataset =
        slider_crank(Real(angle), 0, angle) + "VARIABLE/1, FUNCTION=DX(40,1)\nPSTATE/1, VARIABLES=1\nEND\n";
    const RunResult r = run(dataset, "LINEAR/EIGENSOL, PSTATE=1\n");
    if (r.status == 2) {
      EXPECT_NE(r.err.find("singular"), std::string::npos) << r.err;
      EXPECT_GT(k, 6);
      continue;
    }
    ASSERT_EQ(r.status, 0) << r.err;
    const double w = std::sqrt(7 / slider_crank_inertia(Real(angle)).convert_to<double>()) / (2 * std::numbers::pi);
    const auto values = r.eigenvalues(0);
    ASSERT_EQ(values.size(), 2u);
    EXPECT_NEAR(std::abs(values[0]), w, 1e-6 * w) << k;
  }
}

// Two shafts on hinges with a universal joint between them, the second bent by nearly 90 degrees; the pins of the first
// at `turn`. A spring of stiffness 5 on the first; the second turns r times as far, w² = 5/(2 + 3 r²).
struct Shafts {
  std::string dataset;
  Real ratio;
};
using Vector3 = std::array<Real, 3>;
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
// 3-1-3 angles of axes with this z.
std::string along(const Vector3& z) { return angles_text(atan2(z[0], -z[1]), acos(z[2] / sqrt(dot(z, z)))); }

Shafts shafts(const Real& from_square, const Real& turn) {
  const Vector3 first{0, 0, 1}, second{cos(from_square), 0, sin(from_square)}, pin{cos(turn), sin(turn), 0};
  const Vector3 other = cross(second, pin), normal = cross(pin, other);
  return {fmt::format("Shafts\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, REULER={0}\n"
                      "PART/2, MASS=1, CM=20, IP=1,1,2\nMARKER/20\nMARKER/21, REULER={1}\n"
                      "PART/3, MASS=1, CM=30, IP=3,3,3\nMARKER/30, REULER={0}\nMARKER/31, REULER={2}\n"
                      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=2\nJOINT/3, UNIVERSAL, I=21, J=31\n"
                      "SPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=5, CT=0, ANGLE=0\nEND\n",
                      along(second), along(pin), along(other)),
          dot(first, normal) / dot(second, normal)};
}

TEST_F(NearSingular, universal_joints_bent_by_nearly_a_right_angle) {
  for (int k = 1; k <= 12; ++k) {
    for (const double turn : {1e-3, 0.4, std::numbers::pi / 2}) {
      const Real off = pow(Real(10), -k);
      const Shafts s = shafts(off, Real(turn));
      const double a0 = (-5 / (2 + 3 * s.ratio * s.ratio)).convert_to<double>();
      const bool done = examine(s.dataset, 0, a0, 1e-15);
      EXPECT_TRUE(done || k > 7) << k << " " << turn;
    }
  }
}

// With the pins of the first shaft in the plane of both it turns least: h(y) = atan(s tan y) for y of the second, s the
// sine of what the bend is off a right angle. Turning with w and w/s,  3 y″ + 2 h′ (h′ y″ + h″ y′²) = −7 y − 5 h h′
// has w² (1 − s²) 4 + 7 + 5 s² for 3 + 2 s². Terms of (w/s)² cancel in it.
TEST_F(NearSingular, universal_joints_bent_by_nearly_a_right_angle_and_turning) {
  int linearized = 0;
  for (int k = 2; k <= 60; ++k) {
    const double off = std::pow(10.0, -0.15 * k), speed = k % 2 ? 50.0 : 1.0, s = std::sin(off);
    std::string dataset = shafts(Real(off), Real(0)).dataset;
    const auto put = [&](const std::string& before, const std::string& text) {
      dataset.insert(dataset.find(before), text);
    };
    put("\nMARKER/20", fmt::format(", WZ={:.17g}", speed));
    put("\nMARKER/30", fmt::format(", WZ={:.17g}", speed / s));  // about the axes of its mass centre
    put("END",
        "SPRINGDAMPER/2, ROTATIONAL, I=30, J=2, KT=7, CT=0, ANGLE=0\nVARIABLE/1, FUNCTION=AZ(30,2)\n"
        "PSTATE/1, VARIABLES=1\n");
    const RunResult r = run(dataset, "LINEAR/EIGENSOL, PSTATE=1\n");
    if (r.status == 2) {
      EXPECT_NE(r.err.find("singular"), std::string::npos) << r.err;
      continue;
    }
    ASSERT_EQ(r.status, 0) << r.err;
    if (r.err.find("configuration is singular") != std::string::npos) continue;
    ++linearized;
    const auto values = r.eigenvalues(0);
    ASSERT_EQ(values.size(), 2u) << off;
    const Real sine = sin(Real(off)), W = speed;
    const Real w = sqrt((4 * W * W * (1 - sine * sine) + 7 + 5 * sine * sine) / (3 + 2 * sine * sine));
    const Real cycle = 2 * boost::math::constants::pi<Real>();
    const double bound = r.result(0).at("modes").at(0).at("error_bound_hz").get<double>();
    EXPECT_LE(abs(values[0].imag() - w / cycle), bound) << off << " " << speed;
    EXPECT_LE(std::abs(values[0].real()), bound) << off << " " << speed;
  }
  EXPECT_GT(linearized, 30);
}

// Nothing but rounding stands in the state matrix of a disc that turns freely: its own turning is what that is
// measured against, and no configuration is singular.
TEST_F(NearSingular, a_disc_that_turns_freely_about_an_axis_away_from_its_origin_is_none) {
  for (const double speed : {0.0, 1e-3, 2.0, 1e4}) {
    for (const double offset : {0.1, 3.0, 700.0}) {
      const RunResult r = run(fmt::format("Disc\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, "
                                          "IP=1,2,3, QG={0:.17g},0,0, WZ={1:.17g}\nMARKER/20, QP={2:.17g},0.3,0\n"
                                          "MARKER/21, QP={2:.17g},0,0\nJOINT/1, REVOLUTE, I=21, J=1\nEND\n",
                                          -offset, speed, offset),
                              "LINEAR/EIGENSOL\n");
      ASSERT_EQ(r.status, 0) << r.err;
      EXPECT_EQ(r.err.find("singular"), std::string::npos) << r.err;
      const auto values = r.eigenvalues(0);
      ASSERT_EQ(values.size(), 2u);
      // A displacement of the origin is the sine of the angle, which swings with the speed of turning.
      const std::string label = r.result(0).at("states").at(0).at("label");
      const double own = label.find("displacement") == std::string::npos ? 0 : speed / 2 / std::numbers::pi;
      for (const auto& v : values) {
        EXPECT_NEAR(v.real(), 0, 1e-7 * speed) << speed << " " << offset;
        EXPECT_NEAR(std::abs(v.imag()), own, 1e-7 * speed) << speed << " " << offset;
      }
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::near_singular_test
