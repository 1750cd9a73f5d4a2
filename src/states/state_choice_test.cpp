#include "states/state_choice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/initial.h"
#include "system/model_test_support.h"

namespace dynalin::state_choice_test {
namespace {

// The chosen states as "PART/2 6", those that are rates with an R, in the order of the list.
struct Chosen {
  std::shared_ptr<const System> system;
  StateChoice choice;

  explicit Chosen(const std::string& text) : system(system_test::system_of(text)) {
    Findings findings;
    const auto op = initial_conditions(*system, findings);
    if (!op) throw std::runtime_error(op.error().message);
    const Motion motion = system->motion(*op);
    ConstraintRows rows;
    rows.resize(system->layout(), system->layout().row_count());
    system->constraints(motion, rows);
    auto chosen = choose_states(*system, motion, rows, {});
    if (!chosen) throw std::runtime_error(chosen.error().message);
    choice = std::move(*chosen);
  }
  std::vector<std::string> states() const {
    std::vector<std::string> list;
    for (const StateLabel& s : choice.states)
      list.push_back(s.owner.statement + "/" + std::to_string(s.element) + " " + std::to_string(s.coordinate) +
                     (s.is_rate ? "R" : ""));
    return list;
  }
};

using States = std::vector<std::string>;

std::string part(int id, const std::string& place) {
  const std::string n = std::to_string(id);
  return "PART/" + n + ", MASS=1, CM=" + n + "0, IP=1,2,3, QG=" + place + "\nMARKER/" + n + "0\n";
}

TEST(StateChoice, a_free_part_has_all_six_each_with_its_rate) {
  const Chosen free(part(2, "1,2,3"));
  ASSERT_EQ(free.choice.coordinates.size(), 6u);
  ASSERT_EQ(free.choice.size(), 12);
  EXPECT_FALSE(free.choice.splits_unequally());
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_TRUE(free.choice.has_position[k] && free.choice.has_rate[k]);
    // The gradient of a coordinate of the layout is a one.
    ASSERT_EQ(free.choice.gradient[k].size(), 1u);
    EXPECT_EQ(free.choice.gradient[k][0].c.g, 1);
    const auto rate = static_cast<std::size_t>(free.choice.rate_state[k]),
               position = static_cast<std::size_t>(free.choice.position_state[k]);
    EXPECT_EQ(rate + 1, position) << "a rate stands before its coordinate";
    EXPECT_TRUE(free.choice.states[rate].is_rate && !free.choice.states[position].is_rate);
  }
}

// The hinge is at the origin, the part at (1, 0, 0): its turn about z is the coordinate, not one of its ways.
TEST(StateChoice, a_hinge_leaves_the_turn_about_its_axis) {
  const Chosen hinged(part(2, "1,0,0") + "MARKER/21, PART=2, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\n");
  ASSERT_EQ(hinged.choice.coordinates.size(), 1u);
  EXPECT_EQ(hinged.choice.coordinates[0].label.coordinate, 6);
  EXPECT_EQ(hinged.choice.coordinates[0].rate.coordinate, 12);
}

TEST(StateChoice, a_guide_leaves_the_way_along_its_axis) {
  const std::string guide =
      part(2, "0,0,0") + "MARKER/21, PART=2, REULER=90D,90D,0\nMARKER/22, PART=1, REULER=90D,90D,0\n";
  const Chosen guided(guide + "JOINT/1, TRANSLATIONAL, I=21, J=22\n");
  ASSERT_EQ(guided.choice.coordinates.size(), 1u);
  EXPECT_EQ(guided.choice.coordinates[0].label.coordinate, 1);
}

// Two parts and a gear between their turns: one is left, and every row counts.
TEST(StateChoice, rows_that_hold_a_coordinate_are_active) {
  const Chosen geared(part(2, "0,0,0") + part(3, "0,0,0") +
                      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=1\n"
                      "COUPLER/1, JOINTS=1,2, SCALES=1,2\n");
  EXPECT_EQ(geared.choice.coordinates.size(), 1u);
  EXPECT_EQ(std::count(geared.choice.active.begin(), geared.choice.active.end(), true), 11);
  EXPECT_FALSE(geared.choice.redundant && !geared.choice.redundant->rows.empty());
}

// A second hinge about the same axis repeats all five rows of the first.
TEST(StateChoice, rows_that_repeat_others_are_redundant) {
  const Chosen twice(part(2, "0,0,0") +
                     "MARKER/21, PART=2, QP=0,0,1\nMARKER/9, PART=1, QP=0,0,1\n"
                     "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=21, J=9\n");
  EXPECT_EQ(twice.choice.coordinates.size(), 1u);
  ASSERT_TRUE(twice.choice.redundant);
  EXPECT_EQ(twice.choice.redundant->rows.size(), 5u);
}

TEST(StateChoice, differential_states_stand_behind_coordinates) {
  const Chosen model(
      "POINT_MASS/2, MASS=1, CM=20\nMARKER/20, POINT_MASS=2\n"
      "DIFF/7, IC=0, FUNCTION=-DIF(7)\nDIFF/4, IC=0, FUNCTION=-2*DIF(4)\n");
  ASSERT_EQ(model.choice.first_differential, 6);
  EXPECT_EQ(model.choice.differential, (std::vector<std::int32_t>{1, 0})) << "by the numbers of their statements";
  const States states = model.states();
  ASSERT_EQ(states.size(), 8u);
  EXPECT_EQ(states[6], "DIFF/4 1");
  EXPECT_EQ(states[7], "DIFF/7 1");
}

}  // namespace
}  // namespace dynalin::state_choice_test
