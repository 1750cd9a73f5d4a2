// Elements that commands take away and bring back between simulations over time, against closed forms.
#include <fmt/format.h>

#include "cases/run.h"

namespace dynalin::cases::changed_on_the_way_test {
namespace {

class ChangedOnTheWay : public Cases {};

// The VARIABLEs at the ends of simulations.
std::vector<std::map<std::string, double>> ends_of(const RunResult& r) {
  std::vector<std::map<std::string, double>> at;
  for (const auto& result : r.json.at("results")) {
    if (!result.contains("history")) continue;
    std::map<std::string, double>& last = at.emplace_back();
    for (const auto& [id, values] : result.at("history").at("variables").items())
      last[id] = values.get<std::vector<double>>().back();
  }
  return at;
}

// Let go by its hinge, a rod flies along the tangent and goes on turning; a mass on a spring that is taken away goes on
// at its speed, and swings about the same place when the spring is there again.
TEST_F(ChangedOnTheWay, what_is_deactivated_lets_go_and_what_is_activated_holds_again) {
  const RunResult r = run(R"(let go
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=21, IP=1,1,1, WZ=2, VY=2
MARKER/20, PART=2
MARKER/21, PART=2, QP=1,0,0
JOINT/1, REVOLUTE, I=20, J=1
PART/3, MASS=1, CM=30, IP=1,1,1, QG=0,0,1
MARKER/30, PART=3
JOINT/3, TRANSLATIONAL, I=30, J=1
SFORCE/3, TRANSLATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=-4*DZ(30,1)
VARIABLE/1, FUNCTION=DX(21,1)
VARIABLE/2, FUNCTION=DY(21,1)
VARIABLE/3, FUNCTION=AZ(20,1)
VARIABLE/4, FUNCTION=DZ(30,1)
INTEGRATOR/ERROR=1E-7
END
)",
                          "SIM/DYN, END=1, STEPS=10\nDEACT/JOINT, ID=1\nDEACT/SFORCE, ID=3\n"
                          "SIM/DYN, END=2, STEPS=10\nACT/SFORCE, ID=3\nSIM/DYN, END=3, STEPS=10\n");
  ASSERT_EQ(r.status, 0) << r.err;
  auto at = ends_of(r);
  ASSERT_EQ(at.size(), 3u);
  const double c = std::cos(2), s = std::sin(2), allowed = 1e-6;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto flown = static_cast<double>(k);
    EXPECT_NEAR(at[k]["1"], c - 2 * s * flown, allowed);
    EXPECT_NEAR(at[k]["2"], s + 2 * c * flown, allowed);
    EXPECT_NEAR(at[k]["3"], 2 + 2 * flown, allowed);
  }
  const double before = c - 2 * s;
  EXPECT_NEAR(at[0]["4"], c, allowed);
  EXPECT_NEAR(at[1]["4"], before, allowed);
  EXPECT_NEAR(at[2]["4"], before * c - s * s, allowed);
}

// A rotor at 30 rad/s on a torsion spring: θ″ = −ω² θ with ω² = 0.1/2.
const std::string sprung = R"(many turns
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/2, PART=1
PART/2, MASS=1, CM=20, IP=1,1,2, WZ=30
MARKER/20, PART=2
JOINT/1, REVOLUTE, I=20, J=2
SFORCE/1, ROTATIONAL, I=20, J=2, FUNCTION=-0.1*AZ(20,2)
INTEGRATOR/ERROR=1E-8
)";
constexpr double speed = 30;
const double omega = std::sqrt(0.05);

TEST_F(ChangedOnTheWay, turns_go_on_in_a_function_that_is_stated_anew) {
  const RunResult r =
      run(sprung + "VARIABLE/1, FUNCTION=AZ(20,2)\nVARIABLE/2, FUNCTION=SFORCE(1,0,8,2)\nEND\n",
          "SIM/DYN, END=0.5, STEPS=5\nSFORCE/1, FUNCTION=-0.1*AZ(20,2)\nVARIABLE/1, FUNCTION=2*AZ(20,2)\n"
          "SIM/DYN, END=1, STEPS=5\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const double angle = speed / omega * std::sin(omega);
  EXPECT_NEAR(ends_of(r).at(1).at("1"), 2 * angle, 1e-5);
  EXPECT_NEAR(ends_of(r).at(1).at("2"), -0.1 * angle, 1e-6);
}

// 20 rad behind the start, a wheel is turned on from 20/3 to 10: more than half a turn in one assembly.
TEST_F(ChangedOnTheWay, a_coupler_of_other_scales_turns_as_far_as_it_says) {
  for (const double scale : {2.0, 2.5, 4.0, -1.0}) {
    const RunResult r =
        run("geared\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=1, CM=20, IP=1,1,2\n"
            "MARKER/20, PART=2\nJOINT/1, REVOLUTE, I=20, J=1\nPART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30, PART=3\n"
            "JOINT/3, REVOLUTE, I=30, J=1\nCOUPLER/1, JOINTS=1,3, SCALES=1,-3\n"
            "MOTION/1, JOINT=1, FUNCTION=10*TIME\nVARIABLE/1, FUNCTION=AZ(20,1)\nVARIABLE/3, FUNCTION=AZ(30,1)\nEND\n",
            fmt::format("SIM/KIN, END=2, STEPS=2\nCOUPLER/1, SCALES=1,{}\nSIM/KIN, END=3, STEPS=2\n", -scale));
    ASSERT_EQ(r.status, 0) << scale << r.err;
    EXPECT_NEAR(ends_of(r).at(1).at("1"), 30, 1e-9) << scale;
    EXPECT_NEAR(ends_of(r).at(1).at("3"), 30 / scale, 1e-9) << scale;
  }
}

// Nothing else reads the angle: it is counted while the spring is away.
TEST_F(ChangedOnTheWay, a_spring_that_comes_back_knows_how_far_it_was_turned) {
  const std::string reads = "VARIABLE/2, FUNCTION=SFORCE(1,0,8,2)\nEND\n";
  const RunResult r = run(sprung + reads,
                          "DEACT/SFORCE, ID=1\nSIM/DYN, END=0.5, STEPS=5\nSAVE/SYSTEM, FILE=away.save\n"
                          "ACT/SFORCE, ID=1\nSIM/DYN, END=1, STEPS=5\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const double later = 0.5;
  const double angle = speed * later * std::cos(omega * later) + speed / omega * std::sin(omega * later);
  EXPECT_NEAR(ends_of(r).at(1).at("2"), -0.1 * angle, 1e-6);

  const RunResult reloaded =
      run(sprung + reads, "RELOAD/SYSTEM, FILE=away.save\nACT/SFORCE, ID=1\nSIM/DYN, END=1, STEPS=5\n");
  ASSERT_EQ(reloaded.status, 0) << reloaded.err;
  EXPECT_NEAR(ends_of(reloaded).at(0).at("2"), -0.1 * angle, 1e-6);
}

// y′ = −y(t − 1) with y = 1 at and before the start, by the method of steps.
constexpr double delayed_end = -0.481333333333;  // 1 − t + (t − 1)²/2 − (t − 2)³/6 at t = 2.2
const std::string delayed = R"(the past
UNITS/SYSTEM=MKS
PART/1, GROUND
DIFF/1, IC=1, FUNCTION=-DELAY(DIF(1),1,1)
DIFF/2, IC=1, FUNCTION=-VARVAL(2)
VARIABLE/1, FUNCTION=DIF(1)
VARIABLE/2, FUNCTION=DELAY(DIF(2),1,1)
VARIABLE/3, FUNCTION=DIF(2)
INTEGRATOR/ERROR=1E-8
END
)";

TEST_F(ChangedOnTheWay, the_past_goes_on_where_the_same_is_delayed) {
  const RunResult r = run(delayed,
                          "SIM/DYN, END=1.3, STEPS=13\nDIFF/1, FUNCTION=-delay( dif(1) , 1, 1)\n"
                          "DIFF/2, FUNCTION=-DELAY(DIF(2),1,1)\nVARIABLE/2, FUNCTION=0\nSAVE/SYSTEM, FILE=past.save\n"
                          "SIM/DYN, END=2.2, STEPS=9\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(ends_of(r).at(1).at("1"), delayed_end, 1e-6);
  EXPECT_NEAR(ends_of(r).at(1).at("3"), delayed_end, 1e-6);
  const RunResult reloaded = run(delayed, "RELOAD/SYSTEM, FILE=past.save\nSIM/DYN, END=2.2, STEPS=9\n");
  ASSERT_EQ(reloaded.status, 0) << reloaded.err;
  EXPECT_NEAR(ends_of(reloaded).at(0).at("1"), delayed_end, 1e-6);
}

// A friction that is taken in again has no bristles that were bent before: a static equilibrium leaves it where it is.
TEST_F(ChangedOnTheWay, friction_that_is_taken_in_begins_where_it_is) {
  const RunResult r = run(R"(sticks
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=1,1,1, VZ=1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
FRICTION/1, JOINT=1, FRICTION_FORCE_PRELOAD=2
VARIABLE/1, FUNCTION=DZ(20,1)
END
)",
                          "DEACT/FRICTION, ID=1\nSIM/DYN, END=1, STEPS=10\nACT/FRICTION, ID=1\nSIM/STATICS\n"
                          "SIM/DYN, END=2, STEPS=2\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(ends_of(r).at(1).at("1"), 1, 1e-6);
}

}  // namespace
}  // namespace dynalin::cases::changed_on_the_way_test
