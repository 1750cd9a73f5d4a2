// What states of two markers become where an edit lets them tell of others: bristles of FRICTION, courses of MOTION.
#include "system/carried_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "system/carry_over.h"
#include "system/model_test_support.h"
#include "system/saved_point.h"

namespace dynalin::system_test::carried_pairs_test {
namespace {

std::string part(int id) {
  const std::string n = std::to_string(id);
  return "PART/" + n + ", MASS=1, CM=" + n + "0, IP=1,1,1, QG=1,0,0\nMARKER/" + n + "0\n";
}

// Creep is of I relative to J: the joint with its ends swapped has the opposite one.
TEST(CarriedPairs, bristles_bend_the_other_way_where_the_ends_of_their_joint_are_swapped) {
  const auto rubbing = [](const std::string& type, const std::string& ends) {
    return system_of(part(3) + "JOINT/1, " + type + ", " + ends + "\nFRICTION/4, JOINT=1\n");
  };
  const std::string drawn = "I=30, J=1", swapped = "I=1, J=30";
  for (const std::string type : {"TRANSLATIONAL", "REVOLUTE", "CYLINDRICAL", "SPHERICAL"}) {
    const auto from = rubbing(type, drawn);
    OperatingPoint op = from->drawn();
    op.poses[1].r = {};  // where the joint has it
    for (std::size_t k = 0; k < op.state.size(); ++k) op.state[k] = 1e-3 * static_cast<double>(k + 1);
    op.state_rate = op.state;
    ASSERT_FALSE(op.state.empty()) << type;
    const OperatingPoint same = carried_over(*from, op, *rubbing(type, drawn));
    EXPECT_EQ(same.state, op.state) << type;
    const OperatingPoint now = carried_over(*from, op, *rubbing(type, swapped));
    for (std::size_t k = 0; k < op.state.size(); ++k) {
      EXPECT_EQ(now.state.at(k), -op.state[k]) << type << k;
      EXPECT_EQ(now.state_rate.at(k), -op.state[k]) << type << k;
      // What equilibria go on from.
      EXPECT_EQ(now.memory.at(10 + k), -op.state[k]) << type << k;
    }
  }
}

// Of a ball they bend along axes of J, which others may be: in space they stay as they are.
TEST(CarriedPairs, bristles_of_a_ball_stay_as_they_are_in_space) {
  const auto ball = [](const std::string& ends) {
    return system_of(part(3) + "MARKER/31, PART=3\nMARKER/2, PART=1, REULER=0,90D,0\nJOINT/1, SPHERICAL, " + ends +
                     "\nFRICTION/4, JOINT=1\n");
  };
  const auto from = ball("I=30, J=1");
  OperatingPoint op = from->drawn();
  op.poses[1] = {{}, rotation_exponential({0, 0, 0.5})};
  op.state = {1e-3, 2e-3, 3e-3};
  const auto expect = [&](const std::string& ends, const Vector& bent) {
    const std::vector<double> now = carried_over(*from, op, *ball(ends)).state;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(now.at(k), bent[k], 1e-17) << ends << k;
  };
  expect("I=30, J=2", {1e-3, 3e-3, -2e-3});  // its y is z of the ground
  expect("I=1, J=31", transpose(op.poses[1].R) * Vector{-1e-3, -2e-3, -3e-3});
}

// Of the same joint between the same bodies at the same place, whatever markers say so; others begin straight.
TEST(CarriedPairs, bristles_are_of_their_surfaces) {
  const std::string model =
      part(3) + part(4) +
      "MARKER/31, PART=3, REULER=0,180D,0\nMARKER/2, PART=1, REULER=0,180D,0\nMARKER/32, PART=3, QP=0,0,2\n"
      "MARKER/33, PART=3, QP=2,0,0\nMARKER/3, PART=1, QP=2,0,0\nMARKER/34, PART=3, REULER=0,90D,0\n"
      "MARKER/4, PART=1, REULER=0,90D,0\n";
  const auto rubbing = [&](const std::string& joint, const std::string& type, const std::string& other = "J=1") {
    return system_of(model + "JOINT/1, " + type + ", " + joint + "\nJOINT/2, " + type + ", I=40, " + other +
                     "\nFRICTION/4, JOINT=1\n");
  };
  constexpr double bent = 2e-3;
  const auto carried = [&](const std::string& type, const System& to) {
    const auto from = rubbing("I=30, J=1", type);
    OperatingPoint op = from->drawn();
    op.poses[1].r = op.poses[2].r = {};
    op.state = op.state_rate = {bent};
    const OperatingPoint now = carried_over(*from, op, to);
    EXPECT_EQ(now.state_rate, now.state);
    EXPECT_EQ(now.memory.at(10), now.state.at(0));
    return now.state.at(0);
  };
  for (const std::string type : {"TRANSLATIONAL", "REVOLUTE"}) {
    const auto to = [&](const std::string& joint) { return carried(type, *rubbing(joint, type)); };
    EXPECT_EQ(to("I=31, J=2"), -bent) << type;  // both z reversed
    EXPECT_EQ(to("I=2, J=31"), bent) << type;
    EXPECT_EQ(to("I=32, J=1"), bent) << type;  // farther along the axis
    EXPECT_EQ(to("I=34, J=4"), 0) << type;     // another axis
    EXPECT_EQ(to("I=40, J=1"), 0) << type;     // another part
    // A slide is the same all over its bodies, a pin is not.
    EXPECT_EQ(to("I=33, J=3"), type == "REVOLUTE" ? 0 : bent);
  }
  EXPECT_EQ(carried("TRANSLATIONAL", *rubbing("I=30, J=1", "REVOLUTE")), 0);
  EXPECT_EQ(carried("REVOLUTE", *system_of(model + "JOINT/1, REVOLUTE, I=30, J=1\nJOINT/2, REVOLUTE, I=40, J=1\n"
                                                   "FRICTION/4, JOINT=2\n")),
            0);
}

// The bar of a cross that is fixed on I is the one fixed on J where these are swapped.
TEST(CarriedPairs, bristles_on_the_cross_are_of_one_bar) {
  const auto cross = [](const std::string& rest, const std::string& ends) {
    return system_of(part(3) + "MARKER/31, PART=3, REULER=0,90D,0\nJOINT/1, UNIVERSAL, " + ends +
                     "\nFRICTION/4, JOINT=1" + rest + "\n");
  };
  const auto from = cross("", "I=31, J=1");
  OperatingPoint op = from->drawn();
  op.poses[1].r = {};
  op.state = {2e-3};
  const auto to = [&](const std::string& rest, const std::string& ends) {
    return carried_over(*from, op, *cross(rest, ends)).state.at(0);
  };
  EXPECT_EQ(to(", I_YOKE", "I=31, J=1"), 2e-3);
  EXPECT_EQ(to(", J_YOKE", "I=31, J=1"), 0);
  EXPECT_EQ(to("", "I=1, J=31"), 0);
  EXPECT_EQ(to(", J_YOKE", "I=1, J=31"), -2e-3);
}

// Whatever is driven next is driven on from where it is.
TEST(CarriedPairs, a_motion_that_is_given_another_displacement_goes_on_with_what_it_finds) {
  const std::string joints = part(3) + part(4) + "MARKER/31, PART=3, QP=2,0,3\n" +
                             "JOINT/1, CYLINDRICAL, I=30, J=1\nJOINT/2, CYLINDRICAL, I=40, J=1\n";
  const auto driven = [&](const std::string& motion, const std::string& ends = "I=30, J=1") {
    std::string text = joints;
    text.replace(text.find("I=30, J=1"), 9, ends);
    return system_of(text + "MOTION/1, " + motion + "\n");
  };
  const std::string rest = ", ACCELERATION, FUNCTION=1, ICDISP=9, ICVEL=8";
  const auto from = driven("JOINT=1, TRANSLATION" + rest);
  OperatingPoint op = from->drawn();
  op.poses[1] = {{0.1, 0.2, 0.5}, rotation_exponential({0, 0, 0.3})};
  op.poses[2].r = {0, 0, 0.7};
  op.velocity = {2, 3, 4, 0, 0, 5, 0, 0, 6, 0, 0, 0};
  op.state = {0.5 + 1e-9, 4};
  const auto expect = [&](const System& to, double displacement, double velocity) {
    const std::vector<double> now = carried_over(*from, op, to).state;
    const bool is_angle = to.layout().rows.back().name == "rotation";  // which is one but for whole turns
    const double off = now.at(0) - displacement;
    EXPECT_NEAR(is_angle ? std::remainder(off, 2 * std::numbers::pi) : off, 0, 1e-14);
    EXPECT_NEAR(now.at(1), velocity, 1e-14);
  };
  EXPECT_EQ(carried_over(*from, op, *driven("JOINT=1, TRANSLATION, ACCELERATION, FUNCTION=TIME")).state, op.state);
  expect(*driven("JOINT=2, TRANSLATION" + rest), 0.7, 6);
  expect(*driven("JOINT=1, ROTATION" + rest), 0.3, 5);
  expect(*driven("JOINT=1, TRANSLATION" + rest, "I=1, J=30"), -0.5, -4);
  expect(*driven("JOINT=1, TRANSLATION" + rest, "I=31, J=1"), 3.5, 4);
  expect(*driven("I=30, J=1, X" + rest), 0.1, 2);
  expect(*driven("I=30, J=1, Y" + rest), 0.2, 3);
  // What a command states counts all the same.
  Restated restated;
  restated.state({"MOTION", 1}, "ICDISP");
  EXPECT_EQ(carried_over(*from, op, *driven("JOINT=2, TRANSLATION" + rest), restated).state,
            (std::vector<double>{9, 6}));
}

// A model that a point is put into by what was saved of it sees them as one that a command has made.
TEST(CarriedPairs, go_with_a_saved_point) {
  const auto model = [](const std::string& joint, const std::string& friction = "JOINT=1") {
    return system_of(part(3) + "MARKER/31, PART=3, REULER=0,90D,0\nMARKER/2, PART=1, REULER=0,90D,0\n" +
                     "JOINT/1, TRANSLATIONAL, " + joint + "\nJOINT/2, TRANSLATIONAL, " + joint + "\nFRICTION/4, " +
                     friction + "\nMOTION/5, JOINT=1, VELOCITY, FUNCTION=1, ICDISP=7\n");
  };
  const auto from = model("I=30, J=1");
  OperatingPoint op = from->drawn();
  op.poses[1].r = {0, 0, 0.4};
  const auto place = [](const System& s, std::int64_t id) {
    std::size_t k = 0;
    while (s.layout().states[k].owner->id != id) ++k;
    return k;
  };
  op.state[place(*from, 4)] = 1e-3, op.state[place(*from, 5)] = 0.4;
  const SavedPoint saved = saved_point(*from, op);
  const auto expect = [&](const System& to, double bent, double displacement, bool said) {
    const RestoredPoint now = restored_point(saved, to);
    EXPECT_NEAR(now.point.state[place(to, 4)], bent, 1e-18);
    EXPECT_NEAR(now.point.state[place(to, 5)], displacement, 1e-15);
    EXPECT_EQ(now.not_saved, said ? std::vector<std::string>{"FRICTION/4"} : std::vector<std::string>{});
  };
  expect(*model("I=30, J=1"), 1e-3, 0.4, false);
  expect(*model("I=1, J=30"), -1e-3, -0.4, false);
  expect(*model("I=30, J=1", "JOINT=2"), 0, 0.4, true);
  expect(*model("I=31, J=2"), 0, 0, true);
}

}  // namespace
}  // namespace dynalin::system_test::carried_pairs_test
