// What the linear model of a point takes, refuses and says.
#include "study/linearization.h"

#include <gmock/gmock.h>

#include <cmath>

#include "system/model_test_support.h"

namespace dynalin::linearization_test {
namespace {

using system_test::system_of;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Turns at 3 rad/s where it is started; hangs where it rests.
const std::string pendulum =
    "ACCGRAV/JGRAV=-9.81\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0, WZ=3\nMARKER/20\nMARKER/21, QP=-1,0,0\n"
    "JOINT/1, REVOLUTE, I=21, J=1\n";

StudyPoint start_of(const std::string& text) {
  auto found = initial_conditions(as_drawn(system_of(text)));
  if (!found) throw std::runtime_error(found.error().message);
  return found->point;
}
std::string refusal(const StudyPoint& point, const LinearRequest& request) {
  const auto linear = linearized(point, request);
  return linear ? "none" : linear.error().message;
}

TEST(Linearization, finds_what_the_request_names_or_refuses) {
  const StudyPoint point = start_of(pendulum + "MARKER/9, FLOATING\n");
  EXPECT_EQ(refusal(point, {.pstate = 4}), "PSTATE/4 does not exist");
  EXPECT_EQ(refusal(point, {.pinput = 5}), "PINPUT/5 does not exist");
  EXPECT_EQ(refusal(point, {.poutput = 6}), "POUTPUT/6 does not exist");
  EXPECT_EQ(refusal(point, {.rm = 7}), "MARKER/7 does not exist");
  EXPECT_EQ(refusal(point, {.rm = 9}), "MARKER/9 is floating");
  const auto linear = linearized(point, {.rm = 1, .without_damping = true});
  ASSERT_TRUE(linear);
  EXPECT_EQ(linear->linear.model.rm, 1);
  EXPECT_TRUE(linear->linear.model.without_damping);
  EXPECT_EQ(linear->states(), 2u);
  EXPECT_TRUE(linear->has_state_matrix());
}

TEST(Linearization, refuses_a_model_without_states_unless_told_otherwise) {
  const StudyPoint point = start_of("");
  const auto refused = linearized(point, {});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("the model has no states"));
  const auto taken = linearized(point, {}, Stateless::taken);
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->states(), 0u);
}

TEST(Linearization, takes_a_static_solution_as_it_was_found_where_that_is_asked_for) {
  const auto rest = static_equilibrium(as_drawn(system_of(pendulum)), {});
  ASSERT_TRUE(rest);
  const auto moving = linearized(rest->point, {});
  ASSERT_TRUE(moving);
  EXPECT_FALSE(moving->at_rest_as_found);
  EXPECT_NEAR(moving->point.velocity[5], 3, 1e-9);
  for (const LinearRequest& request :
       {LinearRequest{.original = true}, LinearRequest{.without_reconciliation = true}}) {
    const auto found = linearized(rest->point, request);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->at_rest_as_found);
    EXPECT_EQ(found->point.velocity[5], 0);
  }
}

TEST(Linearization, forms_the_state_matrix_up_to_a_size_and_afterwards) {
  const StudyPoint point = start_of(pendulum);
  auto linear = linearized(point, {}, Stateless::refused, {.up_to = 1});
  ASSERT_TRUE(linear);
  EXPECT_FALSE(linear->has_state_matrix());
  const auto whole = with_state_matrix(*linear);
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->has_state_matrix());
  const auto modes = modes_of(*whole, Vectors::none);
  ASSERT_TRUE(modes);
  EXPECT_THAT(modes->solution.modes, SizeIs(2));
}

TEST(Linearization, says_what_was_asked_for_and_is_not_there) {
  const auto rest = static_equilibrium(as_drawn(system_of(pendulum)), {});
  ASSERT_TRUE(rest);
  const auto linear = linearized(rest->point, {});
  ASSERT_TRUE(linear);
  const auto modes = modes_of(*linear, Vectors::none, NearestModes{5});
  ASSERT_TRUE(modes);
  EXPECT_THAT(modes->solution.modes, SizeIs(1));
  const auto missing = [](const Diagnostic& d) { return d.code == "missing-mode"; };
  EXPECT_TRUE(std::ranges::any_of(modes->remarks.items(), missing));
}

TEST(Linearization, refuses_matrices_that_nobody_meant) {
  EXPECT_TRUE(check_size_of_matrices(state_matrices_up_to, {}));
  const auto refused = check_size_of_matrices(state_matrices_up_to + 1, {});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("--dense-up-to 5001 (dense_up_to) forms it"));
  EXPECT_TRUE(check_size_of_matrices(state_matrices_up_to + 1, {.dense_up_to = state_matrices_up_to + 1}));
  EXPECT_FALSE(check_size_of_matrices(2, {.dense_up_to = 1}));
}

TEST(Linearization, announces_what_all_modes_cost_where_that_is_much) {
  EXPECT_THAT(cost_of_all_modes(all_modes_unannounced_up_to).items(), IsEmpty());
  EXPECT_THAT(cost_of_all_modes(20000).items().at(0).message, HasSubstr("20000 states take about 4 h and 104 GB"));
}

}  // namespace
}  // namespace dynalin::linearization_test
