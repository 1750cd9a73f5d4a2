// What is out of range in requests, all of it at once.
#include "library/request_checks.h"

#include <gmock/gmock.h>

#include <limits>

#include "dynalin/error.h"

namespace dynalin::library::request_checks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The reason and what stands below it; nothing of a request that passes.
template <class Check>
std::vector<std::string> faults(const Check& check) {
  try {
    check();
  } catch (const Error& e) {
    std::vector<std::string> list{e.problems.at(0).message};
    list.insert(list.end(), e.details.begin(), e.details.end());
    return list;
  }
  return {};
}
template <class Request>
std::vector<std::string> of(const Request& request) {
  return faults([&] { check(request); });
}

TEST(RequestChecks, take_what_is_in_range) {
  EXPECT_THAT(of(InitialConditionRequest{.error = 0.0}), IsEmpty());
  EXPECT_THAT(of(StaticRequest{}), IsEmpty());
  EXPECT_THAT(of(StaticRequest{.error = 0.0, .iteration_limit = 1, .settling_time = 2.0}), IsEmpty());
  EXPECT_THAT(of(ModeSelection(NearestModes{1, 0.0})), IsEmpty());
  EXPECT_THAT(of(ModeSelection(ModesInBand{0, 1})), IsEmpty());
}

TEST(RequestChecks, name_everything_that_is_not) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(of(InitialConditionRequest{.error = -1.0}), ElementsAre("error is -1 and may not be less than 0"));
  EXPECT_THAT(of(StaticRequest{.error = -1.0, .imbalance = nan, .iteration_limit = 0}),
              ElementsAre("error is -1 and may not be less than 0", "imbalance is nan and may not be less than 0",
                          "iteration_limit is 0 and must be at least 1"));
  EXPECT_THAT(of(ModeSelection(NearestModes{0})), ElementsAre("count is 0 and must be at least 1"));
  EXPECT_THAT(of(ModeSelection(ModesInBand{2, 2})), ElementsAre(HasSubstr("0 ≤ low < high, not 2 and 2")));
  EXPECT_THAT(of(ModeSelection(ModesInBand{-1, 2})), ElementsAre(HasSubstr("not -1 and 2")));
}

TEST(RequestChecks, simulations_go_on_from_the_present) {
  const auto simulation = [](const SimulationRequest& request) { return faults([&] { check(request, 1.0); }); };
  EXPECT_THAT(simulation({.end = 2, .steps = 10}), IsEmpty());
  EXPECT_THAT(simulation({.end = 1}), ElementsAre("the end, 1, is not a time after the present one, 1"));
  EXPECT_THAT(simulation({.end = 2, .output_step = 0.1, .steps = 10}),
              ElementsAre("either the time between outputs is stated or their number"));
  EXPECT_THAT(simulation({.end = 2, .output_step = 0.0, .error = 0.0, .least_step = -1.0, .largest_order = 0}),
              ElementsAre("output_step is 0 and must be more than 0", "error is 0 and must be more than 0",
                          "least_step is -1 and may not be less than 0", "largest_order is 0 and must be at least 1"));
}

}  // namespace
}  // namespace dynalin::library::request_checks_test
