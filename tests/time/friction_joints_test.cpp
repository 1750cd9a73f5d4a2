// Dry friction in joints that turn or slide in more than one direction: motions that friction ends, and such that begin
// where a growing load tears the joint loose, against the equations of each joint integrated by other means.
#include <fmt/format.h>

#include <array>

#include "time/course.h"
#include "time/dry_friction.h"
#include "time/reference_integration.h"

namespace dynalin::in_time::friction_joints_test {
namespace {

constexpr double mass = 2;

// A body on ground in a joint at its mass centre, with axes along those of ground as it starts. Of marker 21 z points
// along the body's x, of 11 along ground's y and of 12 along ground's x.
std::string jointed(const std::string& start, const std::array<double, 3>& gravity, const std::string& further) {
  return fmt::format(
      "Joint that rubs\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV={}, JGRAV={}, KGRAV={}\nPART/1, GROUND\nMARKER/1\n"
      "MARKER/7, PART=1, FLOATING\nMARKER/11, PART=1, REULER=180D,90D,0\nMARKER/12, PART=1, REULER=90D,90D,0\n"
      "PART/2, MASS={}, CM=2, {}\nMARKER/2\nMARKER/21, PART=2, REULER=90D,90D,0\n{}END\n",
      gravity[0], gravity[1], gravity[2], mass, start, further);
}

std::string statement(int id, const DryFriction& law, const std::string& further) {
  return fmt::format(
      "FRICTION/{}, JOINT=1, MU_STATIC={}, MU_DYNAMIC={}, STICTION_TRANSITION_VELOCITY={}, "
      "TRANSITION_VELOCITY_COEFFICIENT={}, MAX_STICTION_DEFORMATION={}\n, {}\n",
      id, law.mu_static, law.mu_dynamic, law.stiction_velocity, law.ratio, law.deformation, further);
}

struct Coming {
  const char* name;
  bool torn;  // from rest by a load that grows, else friction ends what moves
};
constexpr std::array comings = {Coming{"friction ends it", false}, Coming{"a load tears it loose", true}};

// The slip passes from sliding to stiction, or the other way.
void expect_passed(const DryFriction& law, double first, double last, bool torn) {
  const double fast = torn ? last : first, slow = torn ? first : last;
  EXPECT_GT(fast, 1.5 * law.ratio * law.stiction_velocity);
  EXPECT_LT(slow, law.stiction_velocity);
}

void expect_course(const Course& c, std::int64_t variable, const std::vector<Values>& expected, std::size_t of,
                   double within) {
  const std::vector<double>& found = c.variables.at(variable);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    ASSERT_NEAR(found[k], expected[k][of], within) << "VARIABLE/" << variable << " at " << c.times[k];
}

// A ball in its socket: Euler's equations in the body, friction against the slip in ground's axes. What pulls at the
// centre grows as well, and with it what presses.
TEST(FrictionOfJoints, a_ball_turns_by_eulers_equations_and_its_friction) {
  const DryFriction law{0.4, 0.25, 0.02, 1e-3};
  const double radius = 0.05, preload = 0.03;
  const std::array<double, 3> inertia = {0.1, 0.2, 0.3};
  for (const auto& [name, torn] : comings) {
    SCOPED_TRACE(name);
    const Values w = torn ? Values{0, 0, 0} : Values{3, -2, 4};
    const Values grows = torn ? Values{1, 1.6, -1.2} : Values{0, 0, 0};  // torque by time
    const double pull = 15;                                              // force by time
    const std::string text = jointed(
        fmt::format("IP={},{},{}, WX={}, WY={}, WZ={}", inertia[0], inertia[1], inertia[2], w[0], w[1], w[2]),
        {0, 0, -10},
        "JOINT/1, SPHERICAL, I=2, J=1\n" +
            statement(1, law, fmt::format("BALL_RADIUS={}, FRICTION_TORQUE_PRELOAD={}", radius, preload)) +
            fmt::format("GFORCE/1, I=2, JFLOAT=7, RM=1, FX={}*TIME\\FY=0\\FZ=0\\TX={}*TIME\\TY={}*TIME\\TZ={}*TIME\n",
                        pull, grows[0], grows[1], grows[2]) +
            "VARIABLE/1, FUNCTION=WX(2)\nVARIABLE/2, FUNCTION=WY(2)\nVARIABLE/3, FUNCTION=WZ(2)\n");
    const Course c = led_through_time(text, {.end = torn ? 0.8 : 3.5, .steps = 70, .error = 1e-8});
    ASSERT_TRUE(c.ok()) << c.failure;
    // The columns of the rotation, the angular velocity in ground's axes, the creep.
    const auto rate = [&](double t, const Values& y) {
      const auto column = [&](std::size_t k) { return Vector{y[3 * k], y[3 * k + 1], y[3 * k + 2]}; };
      const std::array<Vector, 3> axis = {column(0), column(1), column(2)};
      const Vector turns = column(3);
      const Values slip = {radius * turns.x, radius * turns.y, radius * turns.z}, creep = {y[12], y[13], y[14]};
      const double moment = law.coefficient(slip) * radius * std::hypot(pull * t, 10 * mass) + preload;
      const Values s = law.direction(slip, creep), z = law.creep_rate(slip, creep);
      const Vector torque = t * Vector{grows[0], grows[1], grows[2]} - moment * Vector{s[0], s[1], s[2]};
      Vector spin{}, faster{};
      for (std::size_t k = 0; k < 3; ++k) spin += inertia[k] * dot(axis[k], turns) * axis[k];
      const Vector rest = torque - cross(turns, spin);
      for (std::size_t k = 0; k < 3; ++k) faster += dot(axis[k], rest) / inertia[k] * axis[k];
      Values yp;
      for (const Vector& v : {cross(turns, axis[0]), cross(turns, axis[1]), cross(turns, axis[2]), faster})
        yp.insert(yp.end(), {v.x, v.y, v.z});
      yp.insert(yp.end(), z.begin(), z.end());
      return yp;
    };
    const auto expected = integrated(rate, {1, 0, 0, 0, 1, 0, 0, 0, 1, w[0], w[1], w[2], 0, 0, 0}, c.times, 1e-3);
    const auto slip = [&](const Values& y) { return radius * DryFriction::size({y[9], y[10], y[11]}); };
    expect_passed(law, slip(expected.front()), slip(expected.back()), torn);
    for (std::size_t k = 0; k < 3; ++k) expect_course(c, static_cast<std::int64_t>(k + 1), expected, 9 + k, 1e-6);
  }
}

// A cross that turns by b about ground's y, its bar on J, and by a about the body's x, the bar on I. With equal
// inertias the angles have no other coupling than by what the joint bears: the force of the weight, across and along
// each bar, and the moment J a′ b′ across both.
TEST(FrictionOfJoints, both_bars_of_a_cross_rub_by_what_they_bear) {
  const DryFriction law{0.4, 0.25, 0.02, 1e-3};
  const double pin = 0.04, arm = 0.07, bending = 0.3, preload = 0.02, J = 0.1;
  const std::array<double, 3> up = {-2.5, 1.5, 10};  // the force of the joint by the mass
  const std::string lengths =
      fmt::format("PIN_RADIUS={}, FRICTION_ARM={}, BENDING_REACTION_ARM={}, FRICTION_TORQUE_PRELOAD={}", pin, arm,
                  bending, preload);
  for (const std::string joint : {"HOOKE, I=2, J=1", "UNIVERSAL, I=21, J=11"}) {
    for (const auto& [name, torn] : comings) {
      SCOPED_TRACE(joint + ", " + name);
      const double a = torn ? 0 : 4, b = torn ? 0 : 2.5, of_a = torn ? 3 : 0, of_b = torn ? 4 : 0;
      const std::string text =
          jointed(fmt::format("IP={0},{0},{0}, WX={1}, WY={2}", J, a, b), {-up[0], -up[1], -up[2]},
                  "JOINT/1, " + joint + "\n" + statement(1, law, lengths) + statement(2, law, lengths + ", J_YOKE") +
                      fmt::format("VTORQUE/1, I=2, JFLOAT=7, RM=2, TX={}*TIME\\TY=0\\TZ=0\n", of_a) +
                      fmt::format("VTORQUE/2, I=2, JFLOAT=7, RM=1, TX=0\\TY={}*TIME\\TZ=0\n", of_b) +
                      "VARIABLE/1, FUNCTION=WX(2,1,2)\nVARIABLE/2, FUNCTION=WY(2,1)\n");
      const Course c = led_through_time(text, {.end = torn ? 0.6 : 2.0, .steps = 60, .error = 1e-8});
      ASSERT_TRUE(c.ok()) << c.failure;
      const auto rate = [&](double t, const Values& y) {  // b, a′, b′, creep of both
        const double along_a = mass * std::abs(up[0] * std::cos(y[0]) - up[2] * std::sin(y[0])),
                     along_b = mass * std::abs(up[1]),
                     force = mass * std::sqrt(up[0] * up[0] + up[1] * up[1] + up[2] * up[2]),
                     across_both = J * std::abs(y[1] * y[2]);
        const auto friction = [&](double turns, double along, double creep) {
          const Values slip = {pin * turns};
          const double presses =
              pin * std::sqrt(force * force - along * along) + arm * along + pin / bending * across_both;
          return -(law.coefficient(slip) * presses + preload) * law.direction(slip, {creep})[0];
        };
        return Values{y[2], (of_a * t + friction(y[1], along_a, y[3])) / J,
                      (of_b * t + friction(y[2], along_b, y[4])) / J, law.creep_rate({pin * y[1]}, {y[3]})[0],
                      law.creep_rate({pin * y[2]}, {y[4]})[0]};
      };
      const auto expected = integrated(rate, {0, a, b, 0, 0}, c.times, 1e-3);
      for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
        expect_passed(law, pin * std::abs(expected.front()[k]), pin * std::abs(expected.back()[k]), torn);
        expect_course(c, static_cast<std::int64_t>(k), expected, k, 1e-6);
      }
    }
  }
}

// A sleeve that slides along ground's x and turns about it rubs in one direction of both. Its marker stands beside the
// mass centre, so that it bears the moment of the weight as well, on an overlap that grows.
TEST(FrictionOfJoints, a_sleeve_slides_and_turns_against_one_friction) {
  const DryFriction law{0.4, 0.25, 0.02, 1e-3};
  const double pin = 0.04, beside = 0.15, overlap = 0.8, force_preload = 0.6, torque_preload = 0.05, J = 0.02;
  for (const auto& [name, torn] : comings) {
    SCOPED_TRACE(name);
    const double v = torn ? 0 : 0.6, w = torn ? 0 : 15, pulls = torn ? 15 : 0, turns = torn ? 0.9 : 0;
    const std::string text = jointed(
        fmt::format("IP={},0.3,0.3, VX={}, WX={}", J, v, w), {0, 0, -10},
        fmt::format("MARKER/22, PART=2, QP={},0,0, REULER=90D,90D,0\nJOINT/1, CYLINDRICAL, I=22, J=12\n", beside) +
            statement(1, law,
                      fmt::format("PIN_RADIUS={}, INITIAL_OVERLAP={}, OVERLAP_DELTA=INCREASE, "
                                  "FRICTION_FORCE_PRELOAD={}, FRICTION_TORQUE_PRELOAD={}",
                                  pin, overlap, force_preload, torque_preload)) +
            fmt::format("GFORCE/1, I=2, JFLOAT=7, RM=1, FX={}*TIME\\FY=0\\FZ=0\\TX={}*TIME\\TY=0\\TZ=0\n", pulls,
                        turns) +
            "VARIABLE/1, FUNCTION=DX(2)\nVARIABLE/2, FUNCTION=VX(2)\nVARIABLE/3, FUNCTION=WX(2)\n");
    const Course c = led_through_time(text, {.end = 1.2, .steps = 60, .error = 1e-8});
    ASSERT_TRUE(c.ok()) << c.failure;
    const auto rate = [&](double t, const Values& y) {
      const Values slip = {y[1], pin * y[2]}, creep = {y[3], y[4]};
      const Values s = law.direction(slip, creep), z = law.creep_rate(slip, creep);
      const double N = law.coefficient(slip) * 10 * mass * (1 + beside / (overlap + y[0]));
      return Values{y[1], (pulls * t - s[0] * (N + force_preload)) / mass,
                    (turns * t - s[1] * (pin * N + torque_preload)) / J, z[0], z[1]};
    };
    // Steps that are short beside the swing on its bristles that is left when it is stuck.
    const auto expected = integrated(rate, {0, v, w, 0, 0}, c.times, 1e-4);
    const auto slip = [&](const Values& y) { return DryFriction::size({y[1], pin * y[2]}); };
    expect_passed(law, slip(expected.front()), slip(expected.back()), torn);
    expect_course(c, 1, expected, 0, 1e-6);
    expect_course(c, 2, expected, 1, 1e-6);
    expect_course(c, 3, expected, 2, 1e-5);
  }
}

}  // namespace
}  // namespace dynalin::in_time::friction_joints_test
