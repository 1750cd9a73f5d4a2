// What is said of FRICTION: of its values, and of where it has no derivative.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mechanics/vanishing_source.h"
#include "system/model_test_support.h"
#include "system/sources.h"

namespace dynalin::system_test::friction_words_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string rubbing(const std::string& argument = "") {
  return "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nJOINT/1, REVOLUTE, I=30, J=1\nFRICTION/4, JOINT=1" + argument +
         "\n";
}

TEST(FrictionWords, of_a_value_say_what_it_must_be_wherever_it_lies_below) {
  for (const std::string value : {"1", "0.5", "-2"}) {
    EXPECT_THAT([&] { (void)model_of(rubbing(", TRANSITION_VELOCITY_COEFFICIENT=" + value)); },
                ThrowsMessage<std::runtime_error>(HasSubstr("TRANSITION_VELOCITY_COEFFICIENT of FRICTION/4 is " +
                                                            value + ", it must be more than 1")));
  }
  for (const std::string name : {"STICTION_TRANSITION_VELOCITY", "MAX_STICTION_DEFORMATION", "PIN_RADIUS",
                                 "FRICTION_ARM", "BENDING_REACTION_ARM"}) {
    for (const std::string value : {"0", "-0.1"}) {
      EXPECT_THAT([&] { (void)model_of(rubbing(", " + name + "=" + value)); },
                  ThrowsMessage<std::runtime_error>(
                      HasSubstr(name + " of FRICTION/4 is " + value + ", it must be more than 0")));
    }
  }
}

// Of a load that is zero it goes by the size, where the surfaces slip or where they stick with bristles that are bent.
TEST(FrictionWords, of_a_load_that_vanishes_say_what_the_surfaces_do) {
  const auto system = system_of(rubbing());
  const auto reason = [&](double slip, double creep) {
    OperatingPoint op = system->drawn();
    op.mode = AnalysisMode::linear;
    op.velocity[5] = slip, op.state[0] = creep;
    std::vector<VanishingSize> sizes;
    for_each_source<VanishingSource>(*system, [&](const ElementSet&, const VanishingSource& source) {
      source.vanishing(system->motion(op), system->layout(), sizes);
    });
    return sizes.empty() ? std::string() : sizes.front().reason;
  };
  const std::string zero = "FRICTION/4: a force or moment that JOINT/1 bears across its surfaces is zero while ";
  EXPECT_THAT(reason(2, 0), HasSubstr(zero + "they slip, and"));
  EXPECT_THAT(reason(0, 0.004), HasSubstr(zero + "bristles between them are bent, and"));
  EXPECT_EQ(reason(0, 0), "");
}

}  // namespace
}  // namespace dynalin::system_test::friction_words_test
