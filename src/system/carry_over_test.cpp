// What an edited model takes over from an operating point: by class and id, and nothing that is stated anew.
#include "system/carry_over.h"

#include <gtest/gtest.h>

#include "system/model_test_support.h"

namespace dynalin::system_test::carry_over_test {
namespace {

const std::string hinge = "MARKER/31, PART=3\nMARKER/5, PART=1, QP=4,0,0\nJOINT/1, REVOLUTE, I=31, J=5\n";
std::string part(int id, const std::string& at = "1,0,0") {
  const std::string n = std::to_string(id);
  return "PART/" + n + ", MASS=1, CM=" + n + "0, IP=1,1,1, QG=" + at + "\nMARKER/" + n + "0\n";
}
std::string diff(int id) {
  const std::string n = std::to_string(id);
  return "DIFF/" + n + ", IC=0, FUNCTION=-DIF(" + n + ")\nVARIABLE/" + n + ", IC=0, FUNCTION=AZ(30,1)\n";
}

// Every number of a point is another one.
OperatingPoint numbered(const System& s, double from) {
  OperatingPoint op = s.drawn();
  op.time = 3;
  op.mode = AnalysisMode::statics;
  op.redundancy_tolerance = 1e-4;
  const auto number = [&](std::vector<double>& values) {
    for (double& v : values) v = from += 1;
  };
  for (std::size_t b = 1; b < op.poses.size(); ++b) op.poses[b].r = {from += 1, from += 1, from += 1};
  for (auto* x : {&op.velocity, &op.acceleration, &op.lambda, &op.algebraic, &op.state, &op.state_rate, &op.memory})
    number(*x);
  return op;
}

std::size_t body_of(const System& s, std::int64_t id) {
  for (std::size_t b = 0; b < s.layout().bodies.size(); ++b) {
    if (s.layout().bodies[b].label.id == id) return b;
  }
  throw std::runtime_error("no such part");
}
std::size_t place_of(const System& s, std::int64_t id, const std::vector<DifferentialState>& states) {
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (states[k].owner->id == id) return k;
  }
  throw std::runtime_error("no such state in " + s.model().title);
}

TEST(CarryOver, goes_by_class_and_id_and_not_by_place) {
  const auto from = system_of(part(2) + part(3, "4,0,0") + hinge + diff(1) + diff(2));
  const auto to = system_of(part(9) + part(3, "4,0,0") + part(2) + hinge + diff(2) + diff(5) + diff(1));
  const OperatingPoint op = numbered(*from, 10), now = carried_over(*from, op, *to);
  EXPECT_EQ(now.time, 3);
  EXPECT_EQ(now.mode, AnalysisMode::statics);
  EXPECT_EQ(now.redundancy_tolerance, 1e-4);
  for (const std::int64_t id : {2, 3}) {
    const std::size_t a = body_of(*from, id), b = body_of(*to, id);
    const BodyBlock &before = from->layout().bodies[a], &after = to->layout().bodies[b];
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(now.poses[b].r[k], op.poses[a].r[k]);
    for (std::int32_t k = 0; k < 6; ++k) {
      EXPECT_EQ(now.velocity[static_cast<std::size_t>(after.offset + k)],
                op.velocity[static_cast<std::size_t>(before.offset + k)]);
      EXPECT_EQ(now.acceleration[static_cast<std::size_t>(after.offset + k)],
                op.acceleration[static_cast<std::size_t>(before.offset + k)]);
    }
  }
  EXPECT_EQ(now.lambda, op.lambda);  // the rows of JOINT/1
  for (const std::int64_t id : {1, 2}) {
    const std::size_t a = place_of(*from, id, from->layout().states), b = place_of(*to, id, to->layout().states);
    EXPECT_EQ(now.state[b], op.state[a]);
    EXPECT_EQ(now.state_rate[b], op.state_rate[a]);
    EXPECT_EQ(now.algebraic[b], op.algebraic[a]);  // one VARIABLE a DIFF
  }
}

TEST(CarryOver, what_is_new_starts_as_drawn) {
  const auto from = system_of(part(2));
  const auto to = system_of(part(2) + part(3, "4,5,6") + hinge + diff(1));
  const OperatingPoint now = carried_over(*from, numbered(*from, 10), *to);
  const std::size_t b = body_of(*to, 3);
  EXPECT_EQ(now.poses[b].r.y, 5);
  EXPECT_EQ(now.velocity[static_cast<std::size_t>(to->layout().bodies[b].offset)], 0);
  EXPECT_EQ(now.lambda, std::vector<double>(5, 0.0));
  EXPECT_EQ(now.state, std::vector<double>{0.0});
}

TEST(CarryOver, what_is_stated_anew_starts_as_stated) {
  const auto from = system_of(part(2) + part(3, "4,0,0") + hinge + diff(1) + diff(2));
  const OperatingPoint op = numbered(*from, 10);
  Restated restated;
  restated.starts = {{"PART", 3}, {"DIFF", 1}, {"VARIABLE", 2}};
  const OperatingPoint now = carried_over(*from, op, *from, restated);
  EXPECT_EQ(now.poses[1].r.x, op.poses[1].r.x);
  EXPECT_EQ(now.poses[2].r.x, 4);
  EXPECT_EQ(now.velocity[6], 0);
  EXPECT_EQ(now.velocity[5], op.velocity[5]);
  EXPECT_EQ(now.state[0], 0);
  EXPECT_EQ(now.state[1], op.state[1]);
  EXPECT_EQ(now.algebraic[0], op.algebraic[0]);
  EXPECT_EQ(now.algebraic[1], 0);
}

TEST(CarryOver, a_body_of_another_kind_is_another_body) {
  const auto from = system_of("PART/2, MASS=1, CM=20, QG=7,0,0\nMARKER/20\n");
  const auto to = system_of("POINT_MASS/2, MASS=1, CM=20, QG=7,0,0\nMARKER/20, POINT_MASS=2\n");
  const OperatingPoint now = carried_over(*from, numbered(*from, 10), *to);
  EXPECT_EQ(now.poses[1].r.x, 7);
}

// The BCS of a part far from its markers moves to one of them: where that is changes with the model.
TEST(CarryOver, a_body_whose_origin_is_taken_elsewhere_keeps_its_place_and_motion) {
  const auto text = [](const std::string& cm) {
    return "PART/2, MASS=1, CM=" + cm +
           ", IP=1,1,1, QG=-1E6,0,0\nMARKER/20, QP=1E6,0,0\nMARKER/21, QP=1E6,2,1\nMARKER/7, PART=1, QP=1,0,0\n";
  };
  const auto from = system_of(text("20")), to = system_of(text("21"));
  OperatingPoint op = from->drawn();
  op.poses[1].R = rotation_exponential({0.3, -0.4, 0.9});
  op.velocity = {1, 2, 3, 0.4, -0.5, 0.6};
  op.acceleration = {7, 8, 9, -1, 2, 0.5};
  const OperatingPoint now = carried_over(*from, op, *to);
  // The same material point, marker 21, before and after
  const auto at = [](const System& s, const OperatingPoint& p) {
    return s.motion(p).frame(s.layout().marker(*s.model().find_marker(21)));
  };
  const Frame<Taylor> a = at(*from, op), b = at(*to, now);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(b.origin[k].value, a.origin[k].value, 1e-9);
    EXPECT_NEAR(b.origin[k].rate, a.origin[k].rate, 1e-9);
    EXPECT_NEAR(b.origin[k].acceleration, a.origin[k].acceleration, 1e-9);
  }
  EXPECT_NE(now.poses[1].r.y, op.poses[1].r.y);
}

TEST(CarryOver, turns_that_were_counted_stay_with_their_place_in_the_text) {
  const auto s = system_of(part(3) + diff(1) + diff(2));
  OperatingPoint op = s->drawn();
  ASSERT_EQ(op.memory.size(), 2u);
  op.memory = {6.5, -13};
  EXPECT_EQ(carried_over(*s, op, *s).memory, op.memory);
}

// The course of a motion goes on under another function, and starts anew where that is stated.
TEST(CarryOver, courses_of_motions_go_on_unless_their_start_is_stated) {
  const auto driven = [](const std::string& motion) {
    return system_of(part(3) + hinge + "MOTION/1, JOINT=1, " + motion + "\n");
  };
  const auto from = driven("ACCELERATION, FUNCTION=1, ICDISP=2");
  OperatingPoint op = from->drawn();
  EXPECT_EQ(op.state, (std::vector<double>{2, 0}));
  op.state = {9, 3};
  EXPECT_EQ(carried_over(*from, op, *driven("ACCELERATION, FUNCTION=TIME, ICDISP=2")).state,
            (std::vector<double>{9, 3}));
  Restated restated;
  restated.starts = {{"MOTION", 1}};
  EXPECT_EQ(carried_over(*from, op, *driven("ACCELERATION, FUNCTION=1, ICDISP=5, ICVEL=1"), restated).state,
            (std::vector<double>{5, 1}));
}

// Where no course is known, it begins with the displacement and the velocity at hand, angles but for whole turns.
TEST(CarryOver, a_motion_that_joins_a_run_goes_on_with_what_it_finds) {
  const std::string hinged = part(3) + "JOINT/1, REVOLUTE, I=30, J=1\n";
  const auto free = system_of(hinged);
  OperatingPoint op = free->drawn();
  op.poses[1].R = rotation_exponential({0, 0, 0.8});
  op.velocity[5] = 4;
  const auto joined = [&](const std::string& motion) {
    return carried_over(*free, op, *system_of(hinged + "MOTION/1, JOINT=1, " + motion + "\n")).state;
  };
  const std::vector<double> found = joined("ACCELERATION, FUNCTION=1");
  EXPECT_NEAR(found.at(0), 0.8, 1e-15);
  EXPECT_NEAR(found.at(1), 4, 1e-15);
  EXPECT_NEAR(joined("VELOCITY, FUNCTION=1").at(0), 0.8, 1e-15);
  EXPECT_EQ(joined("ACCELERATION, FUNCTION=1, ICDISP=3, ICVEL=-2"), (std::vector<double>{3, -2}));
}

}  // namespace
}  // namespace dynalin::system_test::carry_over_test
