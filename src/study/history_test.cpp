// What VARIABLEs and REQUESTs were, output by output.
#include "study/history.h"

#include <gmock/gmock.h>

#include "system/model_test_support.h"

namespace dynalin::history_test {
namespace {

using system_test::system_of;
using ::testing::ElementsAre;
using ::testing::SizeIs;

TEST(History, has_every_variable_and_request_at_each_time) {
  const auto system = system_of(
      "PART/2, MASS=1, CM=20, QG=3,0,0\nMARKER/20\n! adams_view_name='height'\nVARIABLE/7, FUNCTION=TIME\nVARIABLE/5, "
      "FUNCTION=0\nREQUEST/9, DISPLACEMENT, I=20, J=1\n");
  History history;
  OperatingPoint point = system->drawn();
  for (const double t : {0.0, 0.5, 2.0}) {
    point.time = t;
    point.algebraic = {10 * t, -t};
    point.poses[1].r.x = 3 + t;
    append(history, *system, point);
  }
  EXPECT_THAT(history.times, ElementsAre(0, 0.5, 2));
  ASSERT_THAT(history.variables, SizeIs(2));
  EXPECT_EQ(history.variables[0].id, 7);
  EXPECT_EQ(history.variables[0].view_name, "height");
  EXPECT_THAT(history.variables[0].values, ElementsAre(0, 5, 20));
  EXPECT_EQ(history.variables[1].id, 5);
  EXPECT_THAT(history.variables[1].values, ElementsAre(0, -0.5, -2));
  ASSERT_THAT(history.requests, SizeIs(1));
  const RequestHistory& request = history.requests[0];
  EXPECT_EQ(request.request.text(), "REQUEST/9");
  ASSERT_THAT(request.values, SizeIs(3));
  const auto x = std::ranges::find(request.components, "X") - request.components.begin();
  ASSERT_LT(static_cast<std::size_t>(x), request.components.size());
  EXPECT_EQ(request.values[2][static_cast<std::size_t>(x)], 5);
}

// A zero has no sign in tables.
TEST(History, has_no_negative_zeros) {
  const auto system = system_of("VARIABLE/1, FUNCTION=0\n");
  OperatingPoint point = system->drawn();
  point.algebraic = {-0.0};
  History history;
  append(history, *system, point);
  EXPECT_FALSE(std::signbit(history.variables.at(0).values.at(0)));
}

}  // namespace
}  // namespace dynalin::history_test
