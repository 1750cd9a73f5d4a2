// Contacts over time against closed forms and what must be conserved: balls that roll and slide down a slope, ten balls
// in a box.
#include <fmt/format.h>

#include <numbers>
#include <random>

#include "time/course.h"
#include "time/momenta.h"

namespace dynalin::in_time::contact_test {
namespace {

// A ball in space, or a disc in a plane, that starts at rest on a slope, as deep in it as its weight presses.
struct Slope {
  double angle = 0.2, mass = 2, radius = 0.1, stiffness = 1e6;
  double mu_static = 0.3, mu_dynamic = 0.2, stiction_speed = 1e-3;
  bool disc = false;

  double weight() const { return 10 * mass; }
  double pressed() const { return weight() * std::cos(angle); }
  double depth() const { return std::pow(pressed() / stiffness, 1 / 1.5); }
  double arm() const { return radius - 0.5 * depth(); }  // friction acts half-way between the surfaces
  double inertia() const { return (disc ? 0.5 : 0.4) * mass * radius * radius; }

  std::string text() const {
    const double off = radius - depth();
    // z of marker 9 is the normal of the slope, its x points downhill, its y is the axis of rolling.
    std::string t = fmt::format(
        "Slope\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\n"
        "MARKER/9, PART=1, REULER=90D,{0:.17g},-90D\n"
        "PART/2, MASS={1:.17g}, CM=2, IP={2:.17g},{2:.17g},{2:.17g}, QG={3:.17g},0,{4:.17g}, REULER=90D,{0:.17g},-90D\n"
        "MARKER/2\n",
        angle, mass, inertia(), off * std::sin(angle), off * std::cos(angle));
    if (disc) {
      // Curves lie in the planes across y.
      t += fmt::format(
          "MARKER/22, PART=2, REULER=0,90D,0\nJOINT/1, PLANAR, I=22, J=19\nMARKER/19, PART=1, REULER=0,90D,0, RM=9\n"
          "GRAPHICS/2, CIRCLE, CM=22, RADIUS={}\nMARKER/31, PART=1, QP=9,0,0, REULER=0,90D,0, RM=9\n"
          "MARKER/32, PART=1, QP=-9,0,0, REULER=0,90D,0, RM=9\nGRAPHICS/9, OUTLINE=31,32\n",
          radius);
    } else {
      t += fmt::format(
          "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE={0}, YSCALE={0}, ZSCALE={0}\n"
          "GRAPHICS/9, PLANE, RM=9, XMIN=-9, XMAX=9, YMIN=-9, YMAX=9\n",
          2 * radius);
    }
    return t + fmt::format(
                   "CONTACT/1, IGEOM=2, JGEOM=9, IMPACT, STIFFNESS={}, EXPONENT=1.5, DAMPING=0, DMAX=1\n"
                   ", COULOMB_FRICTION=ON, MU_STATIC={}, MU_DYNAMIC={}, STICTION_TRANSITION_VELOCITY={}, "
                   "FRICTION_TRANSITION_VELOCITY={}\n"
                   "VARIABLE/1, FUNCTION=VX(2,1,9)\nVARIABLE/2, FUNCTION=WY(2,1,9)\nVARIABLE/3, FUNCTION=DZ(2,1,9)\n"
                   "VARIABLE/4, FUNCTION=CONTACT(1,0,2,9)\nEND\n",
                   stiffness, mu_static, mu_dynamic, stiction_speed, 2 * stiction_speed);
  }

  // It keeps the creep s that carries the friction of rolling: F = N μ s (3 − s²/v²)/(2 v).
  double friction() const { return weight() * std::sin(angle) / (1 + mass * arm() * arm() / inertia()); }
  double creep() const {
    double low = 0, high = stiction_speed;
    for (int k = 0; k < 100; ++k) {
      const double s = 0.5 * (low + high), x = s / stiction_speed;
      (0.5 * mu_static * pressed() * x * (3 - x * x) < friction() ? low : high) = s;
    }
    return low;
  }
};

// Of g sin α, 5/7 for a ball and 2/3 for a disc, but for the arm of the friction and the creep.
TEST(ContactInTime, what_rolls_down_a_slope_has_its_share_of_gravity) {
  for (const bool disc : {false, true}) {
    SCOPED_TRACE(disc ? "disc" : "ball");
    Slope slope;
    slope.disc = disc;
    const Course c = led_through_time(slope.text(), {.end = 1, .steps = 10, .error = 1e-9});
    ASSERT_TRUE(c.ok()) << c.failure;
    const double share = slope.inertia() / (slope.mass * slope.arm() * slope.arm()), s = slope.creep();
    EXPECT_NEAR(1 / (1 + share), disc ? 2.0 / 3 : 5.0 / 7, 2e-3);
    for (std::size_t k = 1; k < c.times.size(); ++k) {
      const double speed = (10 * std::sin(slope.angle) * c.times[k] + share * s) / (1 + share);
      EXPECT_NEAR(c.variables.at(1)[k], speed, 2e-7);
      EXPECT_NEAR(c.variables.at(2)[k], (speed - s) / slope.arm(), 3e-6);
      EXPECT_NEAR(c.variables.at(4)[k], -slope.friction(), 1e-5 * slope.friction());
    }
    EXPECT_LT(c.drift(3), 1e-9);
  }
}

// Steeper than friction can hold: α with tan α beyond 7/2 μ of a ball, 3 μ of a disc.
TEST(ContactInTime, what_slides_down_a_slope_is_held_by_friction_alone) {
  for (const bool disc : {false, true}) {
    SCOPED_TRACE(disc ? "disc" : "ball");
    Slope slope;
    slope.disc = disc, slope.angle = 1;
    const Course c = led_through_time(slope.text(), {.end = 0.5, .steps = 2, .error = 1e-9});
    ASSERT_TRUE(c.ok()) << c.failure;
    const double N = slope.pressed();
    EXPECT_NEAR((c.variables.at(1)[2] - c.variables.at(1)[1]) / 0.25,
                10 * std::sin(slope.angle) - slope.mu_dynamic * N / slope.mass, 1e-6);
    EXPECT_NEAR((c.variables.at(2)[2] - c.variables.at(2)[1]) / 0.25,
                slope.mu_dynamic * N * slope.arm() / slope.inertia(), 1e-4);
  }
}

// In a box of edge 1 about the origin, without gravity.
struct TenBalls {
  static constexpr int count = 10;
  double radius = 0.1, stiffness = 2e4;
  double damping = 0;

  std::string text() const {
    std::mt19937_64 random(5);
    const auto uniform = [&](double size) {
      return size * (2 * std::ldexp(static_cast<double>(random() >> 11U), -53) - 1);
    };
    std::string t =
        "Ten balls in a box\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/900, QP=-0.5,-0.5,-0.5\n"
        "GRAPHICS/1, BOX, CORNER=900, X=1, Y=1, Z=1\n";
    for (int b = 0; b < count; ++b) {
      const int id = part(b);
      t += fmt::format(
          "PART/{0}, MASS={1}, CM={0}, IP=0.004,0.004,0.004, QG={2:.17g},{3:.17g},{4:.17g}, VX={5:.17g}, VY={6:.17g}"
          ", VZ={7:.17g}\nMARKER/{0}\nGRAPHICS/{0}, ELLIPSOID, CM={0}, XSCALE={8}, YSCALE={8}, ZSCALE={8}\n",
          id, 1 + 0.1 * b, 0.28 * (b % 3 - 1) + uniform(0.03), 0.28 * (b / 3 % 3 - 1) + uniform(0.03),
          (b == 9 ? 0.28 : -0.1) + uniform(0.03), uniform(2), uniform(2), uniform(2), 2 * radius);
    }
    for (int b = 0; b < count; ++b) {
      t += contact(b + 1, fmt::format("IGEOM={}, JGEOM=1, JFLIP_GEOMETRY=1", part(b)));
      for (int a = 0; a < b; ++a) t += contact(100 + 10 * b + a, fmt::format("IGEOM={}, JGEOM={}", part(a), part(b)));
    }
    return t + kept() + "END\n";
  }

 private:
  static int part(int b) { return b + 2; }
  std::string contact(int id, const std::string& shapes) const {
    return fmt::format("CONTACT/{}, {}, IMPACT, STIFFNESS={}, EXPONENT=1.5, DAMPING={}, DMAX=0.001\n", id, shapes,
                       stiffness, damping);
  }
  // VARIABLEs: 1 energy with that of the springs, 2–4 momentum less what the walls gave, 5 what is in the springs.
  std::string kept() const {
    std::string t, energy, springs;
    const auto spring = [&](const std::string& depth) {
      return fmt::format("+{}*MAX(0,{})**2.5", stiffness / 2.5, depth);
    };
    for (int b = 0; b < count; ++b) {
      const int id = part(b);
      const double m = 1 + 0.1 * b;
      std::string elastic = "0";
      for (const char axis : {'X', 'Y', 'Z'})
        elastic += spring(fmt::format("ABS(D{}({},1))-{}", axis, id, 0.5 - radius));
      for (int a = 0; a < b; ++a) elastic += spring(fmt::format("{}-DM({},{})", 2 * radius, part(a), id));
      t += fmt::format("VARIABLE/{}, FUNCTION={}\n", 100 + b, elastic);
      t += fmt::format("VARIABLE/{}, FUNCTION={}*VM({},1)**2\n", 200 + b, 0.5 * m, id);
      energy += fmt::format("+VARVAL({})", 200 + b), springs += fmt::format("+VARVAL({})", 100 + b);
    }
    t += "VARIABLE/1, FUNCTION=VARVAL(5)" + energy + "\nVARIABLE/5, FUNCTION=0" + springs + "\n";
    for (int k = 0; k < 3; ++k) {
      std::string momentum, walls;
      for (int b = 0; b < count; ++b) {
        momentum += fmt::format("{:+}*V{}({},1)", 1 + 0.1 * b, "XYZ"[k], part(b));
        walls += fmt::format("+CONTACT({},0,{},1)", b + 1, 2 + k);
      }
      t += fmt::format("DIFF/{0}, IC=0, FUNCTION=0{1}\nVARIABLE/{2}, FUNCTION=-DIF({0}){3}\n", k + 1, walls, k + 2,
                       momentum);
    }
    return t;
  }
};

TEST(ContactInTime, ten_balls_in_a_box_keep_their_energy_and_momentum) {
  const Course c = led_through_time(TenBalls{}.text(), {.end = 0.3, .steps = 300, .error = 1e-8});
  ASSERT_TRUE(c.ok()) << c.failure;
  const double energy = c.variables.at(1)[0];
  EXPECT_GT(energy, 5);
  EXPECT_LT(c.drift(1), 2e-5 * energy);
  for (const int k : {2, 3, 4}) EXPECT_LT(c.drift(k), 1e-5) << k;
  // They did meet, and often.
  int blows = 0;
  const std::vector<double>& springs = c.variables.at(5);
  for (std::size_t k = 2; k < springs.size(); ++k)
    blows += springs[k - 1] > 0.01 * energy && springs[k - 1] > springs[k] && springs[k - 1] >= springs[k - 2];
  EXPECT_GT(blows, 5);
}

// Dampers take energy, never momentum. On the way there are instants at which a spin is 1e-50 of what it takes to see
// it.
TEST(ContactInTime, ten_balls_that_damp_lose_energy_alone) {
  TenBalls balls;
  balls.damping = 20;
  const Course c = led_through_time(balls.text(), {.end = 0.2, .steps = 100, .error = 1e-7});
  ASSERT_TRUE(c.ok()) << c.failure;
  const std::vector<double>& energy = c.variables.at(1);
  for (std::size_t k = 1; k < energy.size(); ++k) EXPECT_LT(energy[k], energy[k - 1] + 1e-4 * energy[0]);
  EXPECT_LT(energy.back(), 0.98 * energy[0]);
  for (const int k : {2, 3, 4}) EXPECT_LT(c.drift(k), 1e-4) << k;
}

// Where two edges meet they push with their whole force, and where a corner leaves over an edge its two edges have it
// between them: what comes in goes out again.
TEST(ContactInTime, boxes_that_tumble_into_each_other_keep_their_energy) {
  for (const char* start : {"REULER=0.3,0.4,0.5, VZ=-3, WX=1, WY=2", "REULER=1.3,0.8,-0.5, VZ=-2, VX=0.3, WX=-1, WZ=2",
                            "REULER=0.785398,0.785398,0, VZ=-3, WZ=1"}) {
    const std::string text =
        "Two bars\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=2, IP=0.3,0.3,0.3, QG=0.4,0.3,1.4, " +
        std::string(start) +
        "\nMARKER/2\nMARKER/4, PART=2, QP=-0.5,-0.5,-0.5\nGRAPHICS/2, BOX, CORNER=4, X=1, Y=1, Z=1\n"
        "PART/3, MASS=3, CM=5, IP=0.5,0.5,0.5, QG=0,0,-0.5, REULER=0.785398,0.785398,0\nMARKER/5, PART=3\n"
        "MARKER/6, PART=3, QP=-0.5,-0.5,-0.5\nGRAPHICS/3, BOX, CORNER=6, X=1, Y=1, Z=1\n"
        "CONTACT/1, IGEOM=2, JGEOM=3, IMPACT, STIFFNESS=1E6, EXPONENT=1.5, DAMPING=0, DMAX=0.001\n"
        "VARIABLE/1, FUNCTION=VM(2)**2+1.5*VM(5)**2+0.15*WM(2)**2+0.25*WM(5)**2\n"
        "VARIABLE/2, FUNCTION=CONTACT(1,0,1,0)\nEND\n";
    const Course c = led_through_time(text, {.end = 0.6, .steps = 60, .error = 1e-8});
    ASSERT_TRUE(c.ok()) << start << c.failure;
    const auto& energy = c.variables.at(1);
    EXPECT_EQ(c.variables.at(2).back(), 0) << start;  // apart again
    EXPECT_NEAR(energy.back(), energy.front(), 5e-3 * energy.front()) << start;
    EXPECT_LT(*std::min_element(energy.begin(), energy.end()), 0.999 * energy.front()) << start;  // they have met
  }
}

// Two boxes of one size in space, a corner of the one beside an edge of the other: what one loses the other gets.
// A small ball that flies past another one, at a distance at which they overlap for a thousandth of a step: whether it
// is turned aside is no matter of how many outputs there are.
TEST(ContactInTime, a_short_touch_in_a_long_step_is_found) {
  double first = 0;
  for (const int steps : {100, 20, 5, 1}) {
    const Course c = led_through_time(
        "Passing\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n"
        "PART/2, MASS=1, CM=2, IP=1E-4,1E-4,1E-4, QG=-1.165,0,0.015, VX=10\nMARKER/2\n"
        "GRAPHICS/1, ELLIPSOID, CM=1, XSCALE=0.02, YSCALE=0.02, ZSCALE=0.02\n"
        "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.02, YSCALE=0.02, ZSCALE=0.02\n"
        "CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E5, EXPONENT=1.5, DAMPING=0, DMAX=0.001\n"
        "VARIABLE/1, FUNCTION=VZ(2)\nEND\n",
        {0.3, steps, 1e-6});
    ASSERT_TRUE(c.ok()) << c.failure;
    if (first == 0) first = c.last(1);
    EXPECT_GT(c.last(1), 0.05);
    EXPECT_NEAR(c.last(1), first, 1e-5) << steps;
  }
}

TEST(ContactInTime, boxes_that_meet_keep_their_momentum_and_spin) {
  std::string text =
      "Two boxes\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n"
      "PART/2, MASS=2, CM=2, IP=0.3,0.3,0.3, QG=0.4,0.3,0.9, REULER=0.3,0.4,0.5, VZ=-3, WX=1, WY=2\nMARKER/2\n"
      "MARKER/4, PART=2, QP=-0.5,-0.5,-0.5\nGRAPHICS/2, BOX, CORNER=4, X=1, Y=1, Z=1\n"
      "PART/3, MASS=3, CM=5, IP=0.5,0.5,0.5, QG=0,0,-0.5\nMARKER/5, PART=3\n"
      "MARKER/6, PART=3, QP=-0.5,-0.5,-0.5\nGRAPHICS/3, BOX, CORNER=6, X=1, Y=1, Z=1\n"
      "CONTACT/1, IGEOM=2, JGEOM=3, IMPACT, STIFFNESS=2E5, EXPONENT=1.5, DAMPING=100, DMAX=0.001\n"
      ", COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.2, STICTION_TRANSITION_VELOCITY=0.1"
      ", FRICTION_TRANSITION_VELOCITY=1\nVARIABLE/9, FUNCTION=VZ(5)\n";
  const Course c = led_through_time(text + momenta_of_two_bodies() + "END\n", {.end = 0.3, .steps = 60, .error = 1e-8});
  ASSERT_TRUE(c.ok()) << c.failure;
  for (const int k : {1, 2, 3, 4, 5, 6}) EXPECT_LT(c.drift(k), 1e-6) << k;
  EXPECT_LT(c.variables.at(9).back(), -1);
}

}  // namespace
}  // namespace dynalin::in_time::contact_test
