// Functions at a point that no statement of the model has.
#include "study/measured.h"

#include <gmock/gmock.h>

#include "system/model_test_support.h"

namespace dynalin::measured_test {
namespace {

using system_test::system_of;
using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::Pointwise;
using Functions = std::vector<std::string>;

// Ids of VARIABLEs beyond which those of the functions must be.
const std::string sliding =
    "PART/2, MASS=2, CM=20, QG=3,0,0, VX=4\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=21, J=2\nMARKER/21, PART=2, "
    "REU=90D,90D,0D\nMARKER/2, PART=1, REU=90D,90D,0D\nVARIABLE/1, FUNCTION=7\nVARIABLE/12, FUNCTION=8\n"
    "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=21, J=2, FUNCTION=VARVAL(12)\n";

StudyResult<std::vector<double>> values_of(const StudyPoint& point, const Functions& functions) {
  return measured(point, point.system->model().dataset, functions);
}

TEST(Measured, has_a_value_of_each_function_in_its_order) {
  const auto found = initial_conditions(as_drawn(system_of(sliding)));
  ASSERT_TRUE(found);
  const auto values = values_of(found->point, {"DX(20,1)", "VX(20)", "ACCX(20)", "VARVAL(1)+VARVAL(12)", "TIME"});
  ASSERT_TRUE(values) << values.error().message;
  EXPECT_THAT(*values, Pointwise(DoubleNear(1e-12), {3.0, 4.0, 4.0, 15.0, 0.0}));
  EXPECT_TRUE(values_of(found->point, {})->empty());
}

TEST(Measured, makes_a_copy_of_the_point_consistent_where_it_is_not) {
  const StudyPoint drawn = as_drawn(system_of(sliding));
  const auto values = values_of(drawn, {"ACCX(20)"});
  ASSERT_TRUE(values) << values.error().message;
  EXPECT_THAT(*values, Pointwise(DoubleNear(1e-12), {4.0}));
  EXPECT_FALSE(drawn.consistent);
}

TEST(Measured, says_what_is_wrong_with_a_function) {
  const StudyPoint drawn = as_drawn(system_of(sliding));
  const auto why = [&](const std::string& function) {
    const auto values = values_of(drawn, {"TIME", function});
    return values ? "a value" : values.error().message;
  };
  EXPECT_THAT(why("DX(99,1)"), HasSubstr("MARKER/99"));
  EXPECT_THAT(why("SIN("), HasSubstr("error"));
  EXPECT_THAT(why("NOTHING(1)"), HasSubstr("NOTHING"));
  EXPECT_EQ(why("1, IC=3"), "'1, IC=3' is not one function");
  EXPECT_EQ(why("1\nPART/9"), "a function has several lines");
}

}  // namespace
}  // namespace dynalin::measured_test
