// Functions that have a pole where the model is drawn, and read what lies there through a VARIABLE: the value comes to
// it by steps of its own, and the function has to be asked where it has come to.
#include <gmock/gmock.h>

#include "analysis/initial.h"
#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::pole_test {
namespace {

using ::testing::HasSubstr;

constexpr std::array heights = {"1", "1.1", "0.3", "7", "1234.5"};

// A part on a vertical rail, `height` above the marker that its distance is measured from.
std::string drawn_at(const std::string& height) {
  return "ACCGRAV/KGRAV=-9.81\nPART/2, MASS=3, CM=20, IP=1,2,3, QG=0,0," + height +
         "\nMARKER/20\nMARKER/9, PART=1, FLOATING\nJOINT/2, TRANSLATIONAL, I=20, J=1\nVARIABLE/1, FUNCTION=DM(20,1)\n";
}

std::vector<std::string> with_a_pole_at(const std::string& height) {
  const std::string pole = "1/(VARVAL(1)-" + height + ")";
  return {"SFORCE/9, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=" + pole + "\n",
          "VFORCE/9, I=20, JFLOAT=9, RM=1, FX=0\\, FY=0\\, FZ=" + pole + "\n", "VARIABLE/9, FUNCTION=" + pole + "\n",
          "DIFF/9, IC=0, FUNCTION=" + pole + "\n",
          "VARIABLE/9, FUNCTION=1/(VARVAL(2)-" + height + ")\nVARIABLE/2, FUNCTION=VARVAL(1)\n"};
}

TEST(Pole, that_a_value_leads_to_is_named_by_initial_conditions) {
  for (const std::string height : heights) {
    for (const std::string& element : with_a_pole_at(height)) {
      SCOPED_TRACE(element);
      Findings findings;
      const auto op = initial_conditions(*system_of(drawn_at(height) + element), findings);
      ASSERT_FALSE(op);
      EXPECT_THAT(op.error().message, HasSubstr("division by 0"));
      EXPECT_THAT(op.error().message, HasSubstr("/9"));
      EXPECT_EQ(op.error().code, "undefined-value");
    }
  }
}

TEST(Pole, that_a_value_leads_to_is_named_by_statics) {
  for (const std::string height : heights) {
    for (const std::string& element : with_a_pole_at(height)) {
      SCOPED_TRACE(element);
      const auto system = system_of(drawn_at(height) + element);
      StaticsReport report;
      Findings findings;
      const auto op = find_equilibrium(*system, system->drawn(), {}, report, findings);
      ASSERT_FALSE(op);
      EXPECT_THAT(op.error().message, HasSubstr("division by 0"));
      EXPECT_THAT(op.error().message, HasSubstr("/9"));
    }
  }
}

// A step of Newton's method that goes too far says nothing of where it comes from: v = log v + 2 from 0.1.
TEST(Pole, is_not_where_a_step_went_too_far) {
  for (const char* value :
       {"VARIABLE/9, IC=0.1, FUNCTION=LOG(VARVAL(9))+2\n", "VARIABLE/9, IC=9, FUNCTION=1/VARVAL(9)\n"}) {
    SCOPED_TRACE(value);
    const auto system =
        system_of(std::string("PART/2, MASS=3, CM=20, IP=1,2,3\nMARKER/20\nJOINT/2, FIXED, I=20, J=1\n") + value);
    Findings findings;
    EXPECT_TRUE(initial_conditions(*system, findings));
    StaticsReport report;
    EXPECT_TRUE(find_equilibrium(*system, system->drawn(), {}, report, findings));
  }
}

}  // namespace
}  // namespace dynalin::analysis_test::pole_test
