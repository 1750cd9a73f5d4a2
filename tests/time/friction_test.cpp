// Dry friction in joints over time: a block that a belt takes along, sticks and slips, against another integration and
// against Coulomb's law in closed form; oscillations that friction ends, by the energy of each swing.
#include <fmt/format.h>

#include <numbers>

#include "places/symmetric_friction.h"
#include "time/course.h"
#include "time/dry_friction.h"
#include "time/reference_integration.h"

namespace dynalin::in_time::friction_test {
namespace {

// A block on a belt that runs at `speed`, tied to ground by a spring; z of all markers points along x.
struct Belt {
  double mass = 1, stiffness = 100, weight = 10, speed = 0.5;
  double mu_static = 0.5, mu_dynamic = 0.3, stiction_velocity = 0.01, deformation = 1e-4;

  std::string text() const {
    return fmt::format(
        "Belt\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV={}\nPART/1, GROUND\nMARKER/10, PART=1, REULER=90D,90D,0\n"
        "PART/2, MASS=3, CM=20, IP=1,1,1, VX={}\nMARKER/20, REULER=90D,90D,0\n"
        "PART/3, MASS={}, CM=30, IP=1,1,1, VX={}\nMARKER/30, REULER=90D,90D,0\n"
        "JOINT/1, TRANSLATIONAL, I=20, J=10\nMOTION/1, JOINT=1, FUNCTION={}*TIME\n"
        "JOINT/2, TRANSLATIONAL, I=30, J=20\n"
        "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=30, J=10, FUNCTION=-{}*DZ(30,10,10)\n"
        "FRICTION/1, JOINT=2, MU_STATIC={}, MU_DYNAMIC={}, STICTION_TRANSITION_VELOCITY={}, "
        "MAX_STICTION_DEFORMATION={}\n"
        "VARIABLE/1, FUNCTION=DZ(30,10,10)\nVARIABLE/2, FUNCTION=VZ(30,10,10)\n"
        "VARIABLE/3, FUNCTION=FRICTION(1,0,4,10)\nEND\n",
        -weight / mass, speed, mass, speed, speed, stiffness, mu_static, mu_dynamic, stiction_velocity, deformation);
  }

  // Of the block, for slip u and creep z.
  double friction(double u, double z) const { return -law().coefficient({u}) * weight * law().direction({u}, {z})[0]; }
  double creep_rate(double u, double z) const { return law().creep_rate({u}, {z})[0]; }

 private:
  DryFriction law() const { return {mu_static, mu_dynamic, stiction_velocity, deformation}; }
};

TEST(Friction, block_on_a_belt_sticks_and_slips_like_another_integration) {
  const Belt belt;
  const Course c = led_through_time(belt.text(), {.end = 3, .steps = 3000, .error = 1e-8});
  ASSERT_TRUE(c.ok()) << c.failure;
  const auto rate = [&](const Values& y, double) {
    const double u = y[1] - belt.speed;
    return Values{y[1], (belt.friction(u, y[2]) - belt.stiffness * y[0]) / belt.mass, belt.creep_rate(u, y[2])};
  };
  const auto expected = integrated([&](double t, const Values& y) { return rate(y, t); }, {0, belt.speed, 0}, c.times);
  double farthest = 0;
  for (std::size_t k = 0; k < c.times.size(); ++k)
    farthest = std::max(farthest, std::abs(c.variables.at(1)[k] - expected[k][0]));
  EXPECT_LT(farthest, 1e-6);  // of an amplitude of 0.08, after five stops

  // Coulomb: at most x₁ = μ_s N/k, then about μ_d N/k until the velocity is that of the belt again.
  const double omega = std::sqrt(belt.stiffness / belt.mass);
  const double a = (belt.mu_static - belt.mu_dynamic) * belt.weight / belt.stiffness;
  const double slips = (2 * std::numbers::pi - 2 * std::atan(a * omega / belt.speed)) / omega;
  const double period = slips + 2 * a / belt.speed;
  std::vector<double> passes;  // of the place about which it slips, backwards
  const double middle = belt.mu_dynamic * belt.weight / belt.stiffness;
  const auto& x = c.variables.at(1);
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    if (x[k] > middle && x[k + 1] <= middle)
      passes.push_back(c.times[k] + (c.times[k + 1] - c.times[k]) * (x[k] - middle) / (x[k] - x[k + 1]));
  }
  ASSERT_GE(passes.size(), 4u);
  for (std::size_t k = 1; k < passes.size(); ++k) EXPECT_NEAR(passes[k] - passes[k - 1], period, 0.02 * period);
}

// LuGre's law by the equations of its authors.
TEST(Friction, block_on_a_belt_follows_lugre) {
  const double N = 10, k = 50, V = 0.1, mu_s = 0.5, mu_d = 0.3, v_s = 0.02, s0 = 500, s1 = 5, s2 = 0.02;
  Belt belt;
  belt.stiffness = k, belt.speed = V;
  std::string text = belt.text();
  const std::size_t from = text.find("FRICTION/1"), to = text.find("\n", from);
  text.replace(from, to - from,
               fmt::format("FRICTION/1, JOINT=2, FORMULATION=LUGRE, MU_STATIC={}, MU_DYNAMIC={}\n"
                           ", STICTION_TRANSITION_VELOCITY={}, BRISTLE_STIFFNESS_COEFFICIENT={}\n"
                           ", DAMPING_COEFFICIENT={}, VISCOUS_FRICTION_COEFFICIENT={}",
                           mu_s, mu_d, v_s, s0, s1, s2));
  const Course c = led_through_time(text, {.end = 5, .steps = 500, .error = 1e-9});
  ASSERT_TRUE(c.ok()) << c.failure;
  const auto rate = [&](double, const Values& y) {
    const double u = y[1] - V, g = mu_d + (mu_s - mu_d) * std::exp(-u * u / (v_s * v_s));
    const double bends = u - s0 * std::abs(u) * y[2] / g;
    return Values{y[1], -k * y[0] - N * (s0 * y[2] + s1 * bends + s2 * u), bends};
  };
  const auto expected = integrated(rate, {0, V, 0}, c.times);
  double farthest = 0, reached = 0;
  for (std::size_t t = 0; t < c.times.size(); ++t) {
    farthest = std::max(farthest, std::abs(c.variables.at(1)[t] - expected[t][0]));
    reached = std::max(reached, expected[t][0]);
  }
  EXPECT_GT(reached, 0.09);  // it sticks as long as the belt takes it that far
  EXPECT_LT(farthest, 1e-6);
}

// With a constant moment of friction each swing of a pendulum ends where m g l (cos θ₁ − cos θ₀) = T (θ₀ + θ₁).
TEST(Friction, swings_of_a_dry_pendulum_end_by_their_energy) {
  const double T = 0.4, m = 2, l = 0.5, g = 10, start = 1;
  const std::string text = fmt::format(
      "Dry pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV={}\nPART/1, GROUND\nMARKER/10, PART=1\n"
      "PART/2, MASS={}, CM=21, IP=0.01,0.01,0.01, REULER={},0,0\nMARKER/20\nMARKER/21, QP=0,{},0\n"
      "JOINT/1, REVOLUTE, I=20, J=10\n"
      "FRICTION/1, JOINT=1, INPUTS=PRELOAD, FRICTION_TORQUE_PRELOAD={}, STICTION_TRANSITION_VELOCITY=1E-4, "
      "MAX_STICTION_DEFORMATION=1E-6\nVARIABLE/1, FUNCTION=AZ(20,10)\nEND\n",
      -g, m, start, -l, T);
  const Course c = led_through_time(text, {.end = 4, .steps = 8000, .error = 1e-7});
  ASSERT_TRUE(c.ok()) << c.failure;
  const auto& angle = c.variables.at(1);
  double from = start;
  int swings = 0;
  for (std::size_t k = 1; k + 1 < angle.size() && swings < 4; ++k) {
    const double before = std::abs(angle[k] - angle[k - 1]);
    const bool turns = (angle[k] - angle[k - 1]) * (angle[k + 1] - angle[k]) < 0 && before > 0;
    if (!turns) continue;
    const double to = std::abs(angle[k]);
    EXPECT_NEAR(m * g * l * (std::cos(to) - std::cos(from)), T * (from + to), 1e-3 * m * g * l);
    from = to;
    ++swings;
  }
  EXPECT_EQ(swings, 4);
}

// Left alone it stops with its bristles as a spring between the load and what they hold.
TEST(Friction, a_block_stops_and_stays_on_a_slope) {
  const std::string text =
      "Slope\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=3, JGRAV=-10\nPART/1, GROUND\nMARKER/10, PART=1, REULER=90D,90D,0\n"
      "PART/2, MASS=2, CM=20, IP=1,1,1, VX=0.5\nMARKER/20, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=20, J=10\n"
      "FRICTION/1, JOINT=1, MU_STATIC=0.6, MU_DYNAMIC=0.5, MAX_STICTION_DEFORMATION=1E-4, "
      "STICTION_TRANSITION_VELOCITY=0.01\n"
      "VARIABLE/1, FUNCTION=DX(20)\nVARIABLE/2, FUNCTION=VX(20)\nVARIABLE/3, FUNCTION=FRICTION(1,0,2,0)\nEND\n";
  const Course c = led_through_time(text, {.end = 3, .steps = 300});
  ASSERT_TRUE(c.ok()) << c.failure;
  EXPECT_NEAR(c.last(1), 0.25 / (2 * 2), 1e-3);  // v²/2a with a = 5 − 3
  EXPECT_NEAR(c.last(2), 0, 1e-6);
  EXPECT_NEAR(c.last(3), -6, 1e-4);
  EXPECT_NEAR(c.variables.at(1)[200], c.last(1), 1e-7);
}

// What springs on both sides of a plane of symmetry leave of a moment is rounding: the motion is that of springs in the
// plane.
TEST(Friction, of_a_symmetric_mechanism_leads_it_like_its_middle) {
  using namespace symmetric;
  for (const Placed& place : placements) {
    for (const auto& model : {symmetric::slider, symmetric::hinge, symmetric::sleeve}) {
      const std::string reads = "VARIABLE/1, FUNCTION=DX(30,4,4)\nVARIABLE/2, FUNCTION=DZ(30,4,4)\n";
      const in_time::Run run{.end = 0.5, .steps = 50, .error = 1e-8};
      const Course beside = led_through_time(model(place, 0.3, reads), run);
      const Course middle = led_through_time(model(place, 0, reads), run);
      ASSERT_TRUE(beside.ok()) << beside.failure;
      ASSERT_TRUE(middle.ok()) << middle.failure;
      EXPECT_GT(middle.drift(1) + middle.drift(2), 0.01);
      for (const std::int64_t variable : {1, 2}) {
        const auto &x = beside.variables.at(variable), &expected = middle.variables.at(variable);
        for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], expected[k], 1e-6) << k;
      }
    }
  }
}

}  // namespace
}  // namespace dynalin::in_time::friction_test
