// Elements that commands take away and bring back between simulations over time, against closed forms.
#include "cases/run.h"

namespace dynalin::cases::changed_on_the_way_test {
namespace {

class ChangedOnTheWay : public Cases {};

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
  std::vector<std::map<std::string, double>> at;  // the ends of the simulations
  for (const auto& result : r.json.at("results")) {
    if (!result.contains("history")) continue;
    std::map<std::string, double>& last = at.emplace_back();
    for (const auto& [id, values] : result.at("history").at("variables").items())
      last[id] = values.get<std::vector<double>>().back();
  }
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

}  // namespace
}  // namespace dynalin::cases::changed_on_the_way_test
