// Published mechanisms: Andrews' squeezer (its solution at 30 ms in "Test Set for Initial Value Problem Solvers", Bari
// and Amsterdam), and of the IFToMM collection the chain of N four-bars and Bricard's mechanism, which are a matter of
// redundant constraints, and the slider-crank in space.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "time/course.h"
#include "time/reference_integration.h"

namespace dynalin::in_time::published_test {
namespace {

constexpr double pi = std::numbers::pi;

struct Bar {
  std::string name;
  double mass, inertia, x, y, angle;  // where its BCS stands
  double cx, cy;                      // mass centre in it
};

// Seven bodies in the plane, driven by a moment of 33 mNm on the first; times to 30 ms.
std::string squeezer() {
  constexpr double b = -0.0617138900142764496, th = 0, g = 0.455279819163070380, ph = 0.222668390165885885,
                   d = 0.487364979543842550, om = -0.222668390165885885, ep = 1.23054744454982119;
  constexpr double xa = -0.06934, ya = -0.00227, xb = -0.03635, yb = 0.03273;
  constexpr double rr = 0.007, zt = 0.04, u = 0.04;
  const double x2 = rr * std::cos(b), y2 = rr * std::sin(b);
  const double x4 = xa + zt * std::cos(d), y4 = ya + zt * std::sin(d);
  const double x6 = xa + u * std::sin(ep), y6 = ya - u * std::cos(ep);
  const std::vector<Bar> bars = {
      {"K1", 0.04325, 2.194e-6, 0, 0, b, 0.00092, 0},
      {"K2", 0.00365, 4.410e-7, x2, y2, b + th, -0.0115, 0},
      {"K3", 0.02373, 5.255e-6, xb, yb, g, 0.01043, -0.01874},
      {"K4", 0.00706, 5.667e-7, x4, y4, ph + d, 0, -(0.02 - 0.01421)},
      {"K5", 0.07050, 1.169e-5, xa, ya, d, 0.02308, 0.00916},
      {"K6", 0.00706, 5.667e-7, x6, y6, om + ep, 0.02 - 0.01421, 0},
      {"K7", 0.05498, 1.912e-5, xa, ya, ep, -0.00449, -0.01228},
  };
  std::string text = "Andrews' squeezer\nUNITS/SYSTEM=MKS\nPART/9, GROUND\nMARKER/900, PART=9\n";
  text += fmt::format("MARKER/901, PART=9, QP={},{},0\nMARKER/902, PART=9, QP={},{},0\n", xa, ya, xb, yb);
  text += "MARKER/903, PART=9, QP=0.014,0.072,0\n";
  for (std::size_t k = 1; k <= bars.size(); ++k) {
    const Bar& bar = bars[k - 1];
    text += fmt::format("PART/{0}, MASS={1}, CM={0}1, IP={2},{2},{2}, QG={3},{4},0, REULER={5},0,0\n", k, bar.mass,
                        bar.inertia, bar.x, bar.y, bar.angle);
    text += fmt::format("MARKER/{0}0, PART={0}\nMARKER/{0}1, PART={0}, QP={1},{2},0\n", k, bar.cx, bar.cy);
  }
  // Joints at the ends away from the BCS, and where the spring pulls.
  text +=
      "MARKER/12, PART=1, QP=0.007,0,0\nMARKER/22, PART=2, QP=-0.028,0,0\nMARKER/32, PART=3, QP=0,-0.035,0\n"
      "MARKER/33, PART=3, QP=0.02,-0.018,0\nMARKER/42, PART=4, QP=0,-0.02,0\nMARKER/52, PART=5, QP=0.04,0,0\n"
      "MARKER/62, PART=6, QP=0.02,0,0\nMARKER/72, PART=7, QP=0,-0.04,0\n";
  const std::array<std::pair<int, int>, 10> pins = {
      {{10, 900}, {20, 12}, {30, 902}, {50, 901}, {70, 901}, {40, 52}, {60, 72}, {32, 22}, {42, 22}, {62, 22}}};
  for (std::size_t k = 0; k < pins.size(); ++k)
    text += fmt::format("JOINT/{}, REVOLUTE, I={}, J={}\n", k + 1, pins[k].first, pins[k].second);
  text +=
      "SPRINGDAMPER/1, TRANSLATIONAL, I=33, J=903, K=4530, LENGTH=0.07785\n"
      "SFORCE/1, ROTATIONAL, ACTIONONLY, I=10, J=900, FUNCTION=0.033\n"
      "VARIABLE/1, FUNCTION=AZ(10)\nVARIABLE/2, FUNCTION=AZ(20,10)\nVARIABLE/3, FUNCTION=AZ(30)\n"
      "VARIABLE/4, FUNCTION=AZ(40,50)\nVARIABLE/5, FUNCTION=AZ(50)\nVARIABLE/6, FUNCTION=AZ(60,70)\n"
      "VARIABLE/7, FUNCTION=AZ(70)\nEND\n";
  return text;
}

TEST(Published, squeezer_of_Andrews_reaches_the_reference_solution_at_30_ms) {
  constexpr std::array reference = {15.81077119629904,  -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
                                    0.5244099658805304, 0.5347301163226948, 1.048080741042263};
  for (const auto& [error, limit] : {std::pair{1e-3, 3e-3}, std::pair{1e-6, 3e-6}, std::pair{1e-9, 1e-8}}) {
    const Course c = led_through_time(squeezer(), {0.03, 60, error});
    ASSERT_TRUE(c.ok()) << c.failure;
    for (std::size_t k = 0; k < reference.size(); ++k)
      EXPECT_NEAR(c.last(static_cast<std::int64_t>(k) + 1), reference[k], limit) << error << ", coordinate " << k + 1;
  }
}

// N squares of uniform rods, 1 m and 1 kg each, over one another's shoulders: N + 1 cranks on the ground and N rods
// that stay level, of which all but one freedom is lost, and in the positions where all rods lie in one line N + 1 are
// left.
std::string four_bars(int n) {
  std::string text = "N four-bars\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\n";
  for (int k = 0; k <= n; ++k) {
    const int crank = 100 + k;
    text += fmt::format("MARKER/{}, PART=1, QP={},0,0\n", 10000 + k, k);
    text += fmt::format(
        "PART/{0}, MASS=1, CM={1}, IP=1,1,0.08333333333333333, QG={6},0,0, REULER=90D,0,0, WZ=-1\n"
        "MARKER/{3}, PART={0}\nMARKER/{1}, PART={0}, QP=0.5,0,0\nMARKER/{4}, PART={0}, QP=1,0,0\n"
        "JOINT/{2}0, REVOLUTE, I={3}, J={5}\n",
        crank, 20000 + k, k + 1, 30000 + k, 40000 + k, 10000 + k, k);
  }
  for (int k = 0; k < n; ++k) {
    text += fmt::format(
        "PART/{0}, MASS=1, CM={1}, IP=1,1,0.08333333333333333, QG={2},1,0\nMARKER/{3}, PART={0}\n"
        "MARKER/{1}, PART={0}, QP=0.5,0,0\nMARKER/{4}, PART={0}, QP=1,0,0\n"
        "JOINT/{5}1, REVOLUTE, I={3}, J={6}\nJOINT/{5}2, REVOLUTE, I={4}, J={7}\n",
        500 + k, 50000 + k, k, 60000 + k, 70000 + k, k + 1, 40000 + k, 40001 + k);
  }
  return text + "VARIABLE/1, FUNCTION=AZ(30000,10000)\nVARIABLE/2, FUNCTION=WZ(30000)\nEND\n";
}

// A pendulum of one angle: ((N + 1)/3 + N) θ″ = −g ((N + 1)/2 + N) cos θ.
TEST(Published, four_bars_pass_through_their_change_points_as_one_pendulum) {
  for (const auto& [n, error] : {std::pair{2, 1e-6}, std::pair{6, 1e-3}, std::pair{6, 1e-6}}) {
    const Course c = led_through_time(four_bars(n), {5, 50, error});
    ASSERT_TRUE(c.ok()) << c.failure;
    const double inertia = (n + 1) / 3.0 + n, moment = 9.81 * ((n + 1) / 2.0 + n);
    const auto rate = [&](double, const Values& x) { return Values{x[1], -moment / inertia * std::cos(x[0])}; };
    const auto truth = integrated(rate, {pi / 2, -1}, c.times);
    // It comes to rest nearly upright again and again, which makes of errors ten times as much; steps that differ by
    // rounding alone scatter it by half of that.
    for (std::size_t k = 0; k < c.times.size(); ++k) {
      EXPECT_NEAR(c.variables.at(1)[k], truth[k][0], 45 * error) << n << " at " << c.times[k];
      EXPECT_NEAR(c.variables.at(2)[k], truth[k][1], 90 * error) << n << " at " << c.times[k];
    }
  }
}

// Six rods along edges of a cube, each pin across its two rods: mobile though a count of freedoms says it is rigid.
TEST(Published, mechanism_of_Bricard_keeps_its_energy) {
  const Course c = led_through_time(R"(Bricard
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/11, PART=1
MARKER/16, PART=1, QP=0,0,1, ZP=1,0,1, XP=0,1,1
PART/2, MASS=1, CM=20, IP=0,0.08333333333333333,0.08333333333333333
MARKER/20, PART=2, QP=0.5,0,0
MARKER/21, PART=2
MARKER/22, PART=2, QP=1,0,0
PART/3, MASS=1, CM=30, IP=0.08333333333333333,0,0.08333333333333333, QG=1,0,0
MARKER/30, PART=3, QP=0,-0.5,0
MARKER/32, PART=3
MARKER/33, PART=3, QP=0,-1,0, ZP=1,-1,0, XP=0,0,0
PART/4, MASS=1, CM=40, IP=0.08333333333333333,0.08333333333333333,0, QG=1,-1,0
MARKER/40, PART=4, QP=0,0,0.5
MARKER/43, PART=4, ZP=1,0,0, XP=0,1,0
MARKER/44, PART=4, QP=0,0,1, ZP=0,1,1, XP=1,0,1
PART/5, MASS=1, CM=50, IP=0,0.08333333333333333,0.08333333333333333, QG=1,-1,1
MARKER/50, PART=5, QP=-0.5,0,0
MARKER/54, PART=5, ZP=0,1,0, XP=1,0,0
MARKER/55, PART=5, QP=-1,0,0
PART/6, MASS=1, CM=60, IP=0.08333333333333333,0,0.08333333333333333, QG=0,-1,1
MARKER/60, PART=6, QP=0,0.5,0
MARKER/65, PART=6
MARKER/66, PART=6, QP=0,1,0, ZP=1,1,0, XP=0,2,0
MARKER/12, PART=1, ZP=0,1,0, XP=1,0,0
MARKER/23, PART=2, ZP=0,1,0, XP=1,0,0
JOINT/1, REVOLUTE, I=23, J=12
JOINT/2, REVOLUTE, I=32, J=22
JOINT/3, REVOLUTE, I=43, J=33
JOINT/4, REVOLUTE, I=54, J=44
JOINT/5, REVOLUTE, I=65, J=55
JOINT/6, REVOLUTE, I=66, J=16
VARIABLE/2, FUNCTION=0.5*VM(20)**2+9.81*DY(20)+0.04166666666666667*(WM(20)**2-WX(20,11,20)**2)
VARIABLE/3, FUNCTION=0.5*VM(30)**2+9.81*DY(30)+0.04166666666666667*(WM(30)**2-WY(30,11,30)**2)
VARIABLE/4, FUNCTION=0.5*VM(40)**2+9.81*DY(40)+0.04166666666666667*(WM(40)**2-WZ(40,11,40)**2)
VARIABLE/5, FUNCTION=0.5*VM(50)**2+9.81*DY(50)+0.04166666666666667*(WM(50)**2-WX(50,11,50)**2)
VARIABLE/6, FUNCTION=0.5*VM(60)**2+9.81*DY(60)+0.04166666666666667*(WM(60)**2-WY(60,11,60)**2)
VARIABLE/90, FUNCTION=VARVAL(2)+VARVAL(3)+VARVAL(4)+VARVAL(5)+VARVAL(6)
VARIABLE/7, FUNCTION=DX(33,11)
VARIABLE/8, FUNCTION=DY(33,11)
VARIABLE/9, FUNCTION=DZ(33,11)
END
)",
                                    {10, 100, 1e-5});
  ASSERT_TRUE(c.ok()) << c.failure;
  EXPECT_GT(c.drift(8), 0.1);  // it does move
  EXPECT_LT(c.drift(90), 1e-4);
}

// The crank turns about x at A, its pin leads a rod whose other end is on a slider along x, by a cross of which one bar
// is along x. One freedom, and nothing takes energy: ½ m(θ) θ′² + V(θ) stays what it is.
TEST(Published, slider_crank_in_space_follows_its_energy) {
  constexpr double crank = 0.08, rod = 0.3, ya = 0.1, za = 0.12, gravity = 9.81;
  constexpr double rod_mass = 0.5, slider_mass = 2, crank_inertia = 1e-4, across = 0.004, along = 0.0004, start = 6;
  const std::string text = R"(slider-crank in space
UNITS/SYSTEM=MKS
ACCGRAV/KGRAV=-9.81
PART/1, GROUND
MARKER/11, PART=1, QP=0,0.1,0.12, ZP=1,0.1,0.12
MARKER/12, PART=1, ZP=1,0,0
PART/2, MASS=0.12, CM=20, IP=0.0001,0.00001,0.0001, QG=0,0.1,0.12, WX=6
MARKER/20, PART=2
MARKER/21, PART=2, ZP=1,0,0
MARKER/22, PART=2, QP=0,0,0.08
PART/3, MASS=0.5, CM=30, IP=0.004,0.004,0.0004, QG=0.1,0.05,0.1
MARKER/30, PART=3, ZP=0.1,-0.05,-0.1
MARKER/31, PART=3, QP=-0.1,0.05,0.1
MARKER/32, PART=3, QP=0.1,-0.05,-0.1, ZP=0.1,0.15,-0.2
PART/4, MASS=2, CM=40, IP=0.0001,0.0001,0.0001, QG=0.2,0,0
MARKER/40, PART=4, ZP=1,0,0
JOINT/1, REVOLUTE, I=21, J=11
JOINT/2, SPHERICAL, I=22, J=31
JOINT/3, UNIVERSAL, I=40, J=32
JOINT/4, TRANSLATIONAL, I=40, J=12
VARIABLE/1, FUNCTION=AZ(21,11)
VARIABLE/2, FUNCTION=WX(20)
VARIABLE/3, FUNCTION=DX(40)
END
)";
  using Vector = Eigen::Vector3d;
  struct Place {
    double slider, inertia, potential;
  };
  // Places and speeds for θ′ = 1.
  const auto place = [&](double angle) {
    const Vector x = Vector::UnitX(), pin(0, ya - crank * std::sin(angle), za + crank * std::cos(angle));
    const Vector pin_rate(0, -crank * std::cos(angle), -crank * std::sin(angle));
    const double slider = std::sqrt(rod * rod - pin.squaredNorm()), slider_rate = -pin.dot(pin_rate) / slider;
    const Vector direction = (slider * x - pin) / rod, turning = (slider_rate * x - pin_rate) / rod;
    const Vector bar = x.cross(direction).normalized(), tilt = direction.cross(turning);
    const double spin = -x.dot(tilt.cross(bar)) / x.dot(direction.cross(bar));
    const Vector middle_rate = 0.5 * (pin_rate + slider_rate * x);
    return Place{slider,
                 crank_inertia + rod_mass * middle_rate.squaredNorm() + across * tilt.squaredNorm() +
                     along * spin * spin + slider_mass * slider_rate * slider_rate,
                 rod_mass * gravity * 0.5 * pin.z()};
  };
  const double energy = 0.5 * place(0).inertia * start * start + place(0).potential;
  const auto rate = [&](double, const Values& v) {
    const Place at = place(v[0]);
    return Values{std::sqrt(2 * (energy - at.potential) / at.inertia)};
  };
  for (const double error : {1e-4, 1e-7}) {
    const Course c = led_through_time(text, {5, 50, error});
    ASSERT_TRUE(c.ok()) << c.failure;
    const auto truth = integrated(rate, {0}, c.times);
    EXPECT_GT(truth.back()[0], 2 * pi);
    // Of runs that differ by a hundredth of ERROR the angle at the end is off by 1 to 14 times ERROR, to either side.
    for (std::size_t k = 0; k < c.times.size(); ++k) {
      EXPECT_NEAR(c.variables.at(1)[k], truth[k][0], 40 * error) << error << " at " << c.times[k];
      EXPECT_NEAR(c.variables.at(2)[k], rate(0, truth[k])[0], 100 * error) << error << " at " << c.times[k];
      EXPECT_NEAR(c.variables.at(3)[k], place(truth[k][0]).slider, 2 * error) << error << " at " << c.times[k];
    }
  }
}

}  // namespace
}  // namespace dynalin::in_time::published_test
