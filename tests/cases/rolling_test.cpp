// Mechanisms with velocity constraints: they roll or skate, and have more positions than rates.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "cases/run.h"

namespace dynalin::cases::rolling_test {
namespace {

// Eigenvalues in rad per unit time by size, largest first; `rates` counts the states that are velocities.
struct Spectrum {
  std::vector<std::complex<double>> values;
  std::size_t rates = 0;
};

class Rolling : public Cases {
 protected:
  Spectrum solve(const std::string& dataset) const {
    const RunResult r = run(dataset, "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    Spectrum s;
    if (r.status != 0) return s;
    s.values = r.eigenvalues(0);
    for (const auto& mode : r.result(0).at("modes")) {
      for (const auto& entry : mode.at("vector")) EXPECT_TRUE(entry.at(0).is_number() && entry.at(1).is_number());
    }
    for (auto& v : s.values) v *= 2 * std::numbers::pi;
    std::stable_sort(s.values.begin(), s.values.end(), [](auto a, auto b) { return std::abs(a) > std::abs(b); });
    for (const std::string& label : r.labels(0)) s.rates += label.starts_with("derivative");
    return s;
  }
};

void expect_near(std::complex<double> value, std::complex<double> expected, double tolerance) {
  EXPECT_LE(std::abs(value - expected), tolerance) << value << " instead of " << expected;
}

class Sleigh : public Rolling, public ::testing::WithParamInterface<std::pair<double, double>> {};

TEST_P(Sleigh, has_three_positions_two_rates_and_one_eigenvalue) {
  const auto [speed, expected] = GetParam();
  const Spectrum s =
      solve(fmt::format("Chaplygin sleigh\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n"
                        "PART/2, MASS=2, CM=20, IP=0.3,0.3,0.3, VX={}, VY=0, WZ=0\nMARKER/20\n"
                        "MARKER/21, QP=-0.4,0,0\nJOINT/1, PLANAR, I=20, J=1\n"
                        "GCON/1, FUNCTION=VY(21,0,21)\nEND\n",
                        speed));
  ASSERT_EQ(s.values.size(), 5u);
  EXPECT_EQ(s.rates, 2u);
  expect_near(s.values[0], expected, 1e-12);
  for (std::size_t k = 1; k < 5; ++k) EXPECT_EQ(s.values[k], 0.0);
}
INSTANTIATE_TEST_SUITE_P(speeds, Sleigh,
                         ::testing::Values(std::pair(1.0, -1.2903225806451615), std::pair(3.0, -3.8709677419354844),
                                           std::pair(-2.0, 2.580645161290323)));

// A coordinate that follows the chosen one with a factor above ten keeps its rate beside a velocity constraint
// elsewhere: the slide moves 53 units along z for one along x, which is the state.
TEST_F(Rolling, sleigh_leaves_the_rate_of_a_steep_slide_alone) {
  const Spectrum s = solve(
      "Slide and sleigh\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, ZP=0.15,1,8\nMARKER/2\n"
      "PART/2, MASS=4, CM=20, IP=1,1,1\nMARKER/20, ZP=0.15,1,8\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nBUSHING/1, I=20, J=1, K=0,0,36\n"
      "PART/3, MASS=2, CM=30, IP=0.3,0.3,0.3, VX=1, VY=0, WZ=0\nMARKER/30\nMARKER/31, QP=-0.4,0,0\n"
      "JOINT/2, PLANAR, I=30, J=2\nGCON/1, FUNCTION=VY(31,0,31)\nEND\n");
  ASSERT_EQ(s.values.size(), 7u);
  EXPECT_EQ(s.rates, 3u);
  expect_near({s.values[0].real(), std::abs(s.values[0].imag())}, {0, 3}, 1e-12);
  expect_near(s.values[2], -1.2903225806451615, 1e-12);
  for (std::size_t k = 3; k < 7; ++k) EXPECT_EQ(s.values[k], 0.0);
}

// Rolling without slip of a wheel of radius r about its axle: contact on the ground and no velocity there. `centre` is
// at the wheel's centre, `axle` one unit away along the axle, both on the wheel.
std::string rolling(int first_id, int centre, int axle, double r) {
  const std::string ax = fmt::format("DX({},{})", axle, centre), ay = fmt::format("DY({},{})", axle, centre),
                    az = fmt::format("DZ({},{})", axle, centre), s = fmt::format("SQRT(1-{}**2)", az);
  const std::string dx = fmt::format("({}*{}*{}/{})", r, ax, az, s), dy = fmt::format("({}*{}*{}/{})", r, ay, az, s),
                    dz = fmt::format("(-{}*{})", r, s);
  return fmt::format(
      "GCON/{0}, FUNCTION=DZ({1})-{2}*{3}\nGCON/{4}, FUNCTION=VX({1})+WY({1})*{5}-WZ({1})*{6}\n"
      "GCON/{7}, FUNCTION=VY({1})+WZ({1})*{8}-WX({1})*{5}\n",
      first_id, centre, r, s, first_id + 1, dz, dy, first_id + 2, dx);
}

struct Wheel {
  double diametral, axial, speed, squared_eigenvalue;
};
void PrintTo(const Wheel& w, std::ostream* out) { *out << "speed " << w.speed; }
class Disk : public Rolling, public ::testing::WithParamInterface<Wheel> {};

TEST_P(Disk, rolls_upright_with_the_closed_form) {
  const Wheel w = GetParam();
  const Spectrum s = solve(fmt::format(
      "Wheel\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n"
      "PART/2, MASS=4, CM=20, QG=0,0,0.5, IP={0},{1},{0}, VX={2:.17g}, VY=0, VZ=0, WX=0, WY={3:.17g}, WZ=0\nMARKER/20\n"
      "MARKER/21, QP=0,1,0\n{4}END\n",
      w.diametral, w.axial, w.speed, w.speed / 0.5, rolling(1, 20, 21, 0.5)));
  ASSERT_EQ(s.values.size(), 8u);
  EXPECT_EQ(s.rates, 3u);
  const std::complex<double> expected = std::sqrt(std::complex<double>(w.squared_eigenvalue));
  for (std::size_t k = 0; k < 2; ++k) {
    expect_near(s.values[k] * s.values[k], w.squared_eigenvalue, 1e-11 * std::abs(w.squared_eigenvalue));
    EXPECT_NEAR(std::abs(s.values[k]), std::abs(expected), 1e-11 * std::abs(expected));
  }
  for (std::size_t k = 2; k < 8; ++k) EXPECT_EQ(s.values[k], 0.0);
}
INSTANTIATE_TEST_SUITE_P(disk, Disk,
                         ::testing::Values(Wheel{0.25, 0.5, 0.5, 13.296}, Wheel{0.25, 0.5, 1.0, 6.096},
                                           Wheel{0.25, 0.5, 1.5, -5.904}, Wheel{0.25, 0.5, 2.0, -22.704},
                                           Wheel{0.25, 0.5, 3.0, -70.704}));
INSTANTIATE_TEST_SUITE_P(hoop, Disk,
                         ::testing::Values(Wheel{0.5, 1, 0.5, 10.41333333333333333},
                                           Wheel{0.5, 1, 1.0, 2.41333333333333333}, Wheel{0.5, 1, 1.5, -10.92},
                                           Wheel{0.5, 1, 2.0, -29.5866666666666667}, Wheel{0.5, 1, 3.0, -82.92}));

// Where the bicycle is on the ground and which way it rides, rad from x.
struct Place {
  double heading = 0, x = 0, y = 0;
};

// The bicycle of the published benchmark, z up, with the rear contact and the direction of `at`.
std::string bicycle(double v, const Place& at = {}) {
  const double rear = 0.3, front = 0.35, tilt = std::numbers::pi / 10;
  const double c = std::cos(at.heading), s = std::sin(at.heading);
  const auto part = [&](int id, double m, double x, double z, const char* ip, double spin) {
    return fmt::format(
        "PART/{0}, MASS={1}, CM={0}0, QG={2:.17g},{3:.17g},{4}, REULER={5:.17g},0,0, IP={6}, VX={7:.17g}, VY={8:.17g}, "
        "VZ=0, WX=0, WY={9:.17g}, WZ=0\nMARKER/{0}0\n",
        id, m, at.x + c * x, at.y + s * x, z, at.heading, ip, v * c, v * s, spin);
  };
  // The hinge of the axle has its z axis along y.
  const auto axle_at = [](int id, double x, double z) {
    return fmt::format("MARKER/{}, QP={:.17g},0,{:.17g}, REULER=0,-90D,0\n", id, x, z);
  };
  // The steering axis through (1.1, 0, 0), seen from a body at (x, z).
  const auto steering_at = [&](int id, double x, double z) {
    return fmt::format("MARKER/{}, QP={:.17g},0,{:.17g}, ZP={:.17g},0,{:.17g}, XP={:.17g},1,{:.17g}\n", id, 1.1 - x, -z,
                       1.1 - x - std::sin(tilt), -z + std::cos(tilt), 1.1 - x, -z);
  };
  return "Bicycle\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n" +
         part(2, 2, 0, rear, "0.0603,0.12,0.0603", v / rear) + "MARKER/21, QP=0,1,0\n" + axle_at(22, 0, 0) +
         part(3, 85, 0.3, 0.9, "9.2,11,2.8,0,2.4,0", 0) + axle_at(32, -0.3, rear - 0.9) + steering_at(33, 0.3, 0.9) +
         part(4, 4, 0.9, 0.7, "0.05892,0.06,0.00708,0,-0.00756,0", 0) + axle_at(42, 1.02 - 0.9, front - 0.7) +
         steering_at(43, 0.9, 0.7) + part(5, 3, 1.02, front, "0.1405,0.28,0.1405", v / front) +
         "MARKER/51, QP=0,1,0\n" + axle_at(52, 0, 0) +
         "JOINT/1, REVOLUTE, I=22, J=32\nJOINT/2, REVOLUTE, I=43, J=33\nJOINT/3, REVOLUTE, I=52, J=42\n" +
         rolling(1, 20, 21, rear) + rolling(11, 50, 51, front) + "END\n";
}

struct Ride {
  double speed, castering, capsize, weave_re, weave_im;
};
void PrintTo(const Ride& r, std::ostream* out) { *out << r.speed; }
class Bicycle : public Rolling, public ::testing::WithParamInterface<Ride> {
 protected:
  void expect_published(const Ride& ride, Spectrum s) const;
};

void Bicycle::expect_published(const Ride& ride, Spectrum s) const {
  ASSERT_EQ(s.values.size(), 10u);
  EXPECT_EQ(s.rates, 3u);
  std::vector<std::complex<double>> expected = {ride.castering, ride.capsize};
  if (ride.speed == 0) {
    expected.insert(expected.end(), {ride.weave_re, ride.weave_im});
  } else {
    expected.insert(expected.end(), {{ride.weave_re, ride.weave_im}, {ride.weave_re, -ride.weave_im}});
  }
  for (const auto& e : expected) {
    const auto nearest = std::min_element(s.values.begin(), s.values.end(),
                                          [&](auto a, auto b) { return std::abs(a - e) < std::abs(b - e); });
    expect_near(*nearest, e, 1e-11 * std::max(1.0, std::abs(e)));
    s.values.erase(nearest);
  }
  for (const auto& zero : s.values) EXPECT_EQ(zero, 0.0);
}

TEST_P(Bicycle, has_ten_states_and_the_published_eigenvalues) {
  expect_published(GetParam(), solve(bicycle(GetParam().speed)));
}

// The zeros come from the structure, and the small capsize value is as exact, wherever it rides: the states, and the
// rounding of everything, differ from place to place.
TEST_P(Bicycle, has_them_wherever_it_rides) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> heading(-std::numbers::pi, std::numbers::pi), place(-10, 10);
  std::vector<Place> places = {{0, 10, 0},        {0.2}, {-1.1, 5, 7}, {1.5738}, {-1.5728, -7.8}, {0, 1000, -2000},
                               {0.7, 1000, -2000}};
  for (int k = 0; k < 10; ++k) {
    places.push_back({heading(random)});
    places.push_back({heading(random), place(random), place(random)});
  }
  for (const Place& at : places) {
    SCOPED_TRACE(fmt::format("heading {} at {}, {}", at.heading, at.x, at.y));
    expect_published(GetParam(), solve(bicycle(GetParam().speed, at)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    speeds, Bicycle,
    ::testing::Values(Ride{0, -5.5309437176539346, -3.1316432479065557, 3.1316432479065557, 5.5309437176539346},
                      Ride{1, -7.1100801463744077, -3.1342312506657842, 3.5269617099006942, 0.80774027519931005},
                      Ride{2, -8.6738798483173716, -3.0715864564151425, 2.6823451751274535, 1.6806629659067578},
                      Ride{3, -10.351014672459228, -2.6336613725366530, 1.7067560566397352, 2.3158244738432436},
                      Ride{4, -12.158614265764440, -1.4294442736132575, 0.41325331521124132, 3.0791081860320536},
                      Ride{5, -14.078389692798247, -0.32286642900408708, -0.77534188219584193, 4.4648677137882251},
                      Ride{6, -16.085371230980284, -0.0040669007697033624, -1.5264448658414171, 5.8767306059870840},
                      Ride{7, -18.157884661252021, 0.10268170574766416, -2.1387564425836343, 7.1952591332980426},
                      Ride{8, -20.279408943945663, 0.14327879765712950, -2.6934868358109477, 8.4603797139693359},
                      Ride{9, -22.437885590408591, 0.15790184030917298, -3.2167540225249075, 9.6937735153178220},
                      Ride{10, -24.624596350174000, 0.16105338653171554, -3.7201684043728757, 10.906811394762882}));

// A thin disk that rolls along x. Beside five zeros of the structure, in chains, a zero is computed, which nothing
// proves: it has a bound as every other value. The lean: A (A + m r²) s² + C (C + m r²) Ω² − A m g r = 0.
TEST_F(Rolling, a_zero_beside_those_of_the_structure_has_a_bound) {
  const RunResult r = run(
      "t\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.8125\nPART/1, GROUND\nMARKER/1\nPART/3, MASS=2, CM=30, "
      "IP=0.125,0.125,0.25, QG=0,0,0.5, REULER=0,90D,0, VX=2.0, WZ=-4, WY=0, WX=0\nMARKER/30\nMARKER/31, QP=0,0,1\n"
      "GCON/1, FUNCTION=DZ(30)-0.5*SQRT(1-DZ(31,30)**2)\n"
      "GCON/2, FUNCTION=VX(30)+WY(30)*(-0.5)*SQRT(1-DZ(31,30)**2)-WZ(30)*0.5*DZ(31,30)*DY(31,30)/SQRT(1-DZ(31,30)**2)\n"
      "GCON/3, FUNCTION=VY(30)+WZ(30)*0.5*DZ(31,30)*DX(31,30)/SQRT(1-DZ(31,30)**2)+WX(30)*0.5*SQRT(1-DZ(31,30)**2)\n"
      "END\n",
      "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const double lean = std::sqrt((0.75 * 0.25 * 16 - 0.125 * 9.8125) / (0.625 * 0.125)) / (2 * std::numbers::pi);
  const auto& modes = r.result(0).at("modes");
  ASSERT_EQ(modes.size(), 7u);
  for (const auto& m : modes) {
    ASSERT_FALSE(m.at("error_bound_hz").is_null());
    EXPECT_LT(m.at("error_bound_hz"), 1e-12);
  }
  for (std::size_t k = 0; k < 6; ++k) EXPECT_LE(std::abs(modes[k].at("real_hz").get<double>()), 1e-12);
  EXPECT_NEAR(modes[6].at("imag_hz"), lean, 1e-13);
}

// A wheel on a straight way between springs, one on its place and one on its turn: written on velocities it rests where
// it does written on positions, and the multiplier is the force at the contact.
class RollingRest : public Rolling {
 protected:
  RunResult rest(const std::string& constraint,
                 const std::string& commands = "SIMULATE/STATICS\nLINEAR/EIGENSOL\n") const {
    RunResult r = run(
        "Wheel\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/11, QP=0,1,0\nMARKER/12, QP=0,1,0, REULER=0,90D,0\n"
        "MARKER/19, FLOATING\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=0,1,0\nMARKER/20\n"
        "JOINT/1, PLANAR, I=20, J=11\nJPRIM/1, INPLANE, I=20, J=12\nVFORCE/1, I=20, JFLOAT=19, RM=1, "
        "FX=3-DX(20,11)\\FY=0\\FZ=0\nSFORCE/1, ROTATION, I=20, J=11, FUNCTION=-2*AZ(20,11)\n" +
            constraint + "END\n",
        commands);
    EXPECT_EQ(r.status, 0) << r.err;
    return r;
  }
  static double place(const RunResult& r) {
    return r.result(0).at("operating_point").at("bodies").at(0).at("position").at(0);
  }
};

TEST_F(RollingRest, is_that_of_the_constraint_on_positions) {
  const RunResult by_velocity = rest("GCON/1, FUNCTION=VX(20)+WZ(20)\n"),
                  by_position = rest("GCON/1, FUNCTION=DX(20)+AZ(20,11)\n");
  // 3 − x = 2 x
  EXPECT_NEAR(place(by_position), 1, 1e-12);
  EXPECT_NEAR(place(by_velocity), 1, 1e-12);
  EXPECT_THAT(by_velocity.err, ::testing::HasSubstr("[rest-by-rolling]"));
  EXPECT_THAT(by_position.err, ::testing::Not(::testing::HasSubstr("[rest-by-rolling]")));
  // (m + J) x″ = −3 x; on velocities a zero stands beside.
  const double hz = std::sqrt(1.5) / (2 * std::numbers::pi);
  EXPECT_NEAR(std::abs(by_position.eigenvalues(1).back().imag()), hz, 1e-12);
  EXPECT_NEAR(std::abs(by_velocity.eigenvalues(1).back().imag()), hz, 1e-12);
  EXPECT_EQ(by_velocity.eigenvalues(1).front(), 0.0);
  for (const RunResult* r : {&by_velocity, &by_position}) {
    for (const auto& c : r->result(0).at("operating_point").at("constraints")) {
      if (c.at("element") == "GCON/1") {
        EXPECT_NEAR(std::abs(c.at("multiplier").get<double>()), 2, 1e-12) << c;
      }
    }
  }
}

// What says the same as rows on positions is held by these.
TEST_F(RollingRest, is_not_held_twice) {
  EXPECT_NEAR(place(rest("GCON/1, FUNCTION=DX(20)+AZ(20,11)\nGCON/2, FUNCTION=VX(20)+WZ(20)\n")), 1, 1e-12);
  EXPECT_NEAR(place(rest("GCON/1, FUNCTION=VX(20)+WZ(20)\nGCON/2, FUNCTION=2*VX(20)+2*WZ(20)\n"
                         "GCON/3, FUNCTION=DX(20)+AZ(20,11)\n")),
              1, 1e-12);
}

// A friction gear: nothing holds either wheel by itself.
TEST_F(Rolling, rests_where_forces_balance_through_the_contact) {
  const RunResult r =
      run("Gear\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=1,0,0\nPART/2, MASS=1, CM=20, "
          "IP=1,1,1\nMARKER/20\n"
          "PART/3, MASS=1, CM=30, IP=1,1,1, QG=1,0,0\nMARKER/30\nJOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, "
          "I=30, J=2\n"
          "GCON/1, FUNCTION=WZ(20,1)-2*WZ(30,2)\nSFORCE/1, ROTATION, I=20, J=1, FUNCTION=3\n"
          "SFORCE/2, ROTATION, I=30, J=2, FUNCTION=-20*AZ(30,2)\nREQUEST/1, F2=AZ(30,2)\\F3=AZ(20,1)\nEND\n",
          "SIMULATE/STATICS\nLINEAR/EIGENSOL\nSIMULATE/DYNAMICS, END=3, STEPS=3\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto angle = [&](std::size_t result, std::size_t body) {
    const auto& x = r.result(result).at("operating_point").at("bodies").at(body).at("axes").at(0);
    return std::atan2(x.at(1).get<double>(), x.at(0).get<double>());
  };
  EXPECT_NEAR(angle(0, 1), 0.3, 1e-12);
  EXPECT_NEAR(angle(0, 0), 0.6, 1e-12);
  // (4 + 1) α″ = −20 α
  EXPECT_NEAR(std::abs(r.eigenvalues(1).back().imag()), 2 / (2 * std::numbers::pi), 1e-12);
}

}  // namespace
}  // namespace dynalin::cases::rolling_test
