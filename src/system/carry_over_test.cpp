// What an edited model takes over from an operating point: by class and id, and nothing that is stated anew.
#include "system/carry_over.h"

#include <gtest/gtest.h>

#include "system/carried_turns.h"
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
  for (const Restated::Element& e : {Restated::Element{"PART", 3}, {"DIFF", 1}, {"VARIABLE", 2}}) restated.begin(e);
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

// A velocity is brought about by the next analysis, not here.
TEST(CarryOver, a_body_goes_on_where_only_a_velocity_of_it_is_stated_anew) {
  const auto from = system_of(part(2) + part(3, "4,0,0"));
  const OperatingPoint op = numbered(*from, 10);
  Restated restated;
  restated.state({"PART", 3}, "VX");
  const OperatingPoint now = carried_over(*from, op, *from, restated);
  EXPECT_EQ(now.poses[2].r.x, op.poses[2].r.x);
  EXPECT_EQ(now.velocity, op.velocity);
}

// Of a motion that states its acceleration the one course may begin without the other.
TEST(CarryOver, the_courses_of_a_motion_begin_each_by_its_own) {
  const auto s = system_of(part(3) + hinge + "MOTION/1, JOINT=1, ACCELERATION, FUNCTION=1, ICDISP=2, ICVEL=5\n");
  OperatingPoint op = s->drawn();
  op.state = {9, 3};
  const auto with = [&](const std::string& argument) {
    Restated restated;
    restated.state({"MOTION", 1}, argument);
    return carried_over(*s, op, *s, restated).state;
  };
  EXPECT_EQ(with("ICDISP"), (std::vector<double>{2, 3}));
  EXPECT_EQ(with("ICVEL"), (std::vector<double>{9, 5}));
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

// A rotor that has turned by 15 about the axes of several markers.
constexpr double turned = 15;
const std::string rotor =
    "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, REULER=1.2,0,0\nMARKER/22, REULER=0,180D,0\n"
    "MARKER/23, REULER=0,90D,0\nMARKER/2, PART=1\nMARKER/3, PART=1, REULER=-0.5,0,0\n"
    "MARKER/4, PART=1, REULER=0,90D,0\nJOINT/1, REVOLUTE, I=20, J=2\n";
OperatingPoint turn(const System& s) {
  OperatingPoint op = s.drawn();
  constexpr int steps = 10;
  for (int k = 0; k < steps; ++k) {
    op.poses[1].R = rotation_exponential({0, 0, turned / steps}) * op.poses[1].R;
    s.remember(op);
  }
  return op;
}
double angle(const System& s, const OperatingPoint& op, const AngleName& of) { return known_turns(s, op).at(of); }
constexpr Measure AX = Measure::AX, AY = Measure::AY, AZ = Measure::AZ;

TEST(CarryOver, all_that_reads_an_angle_counts_the_same_turns) {
  const auto s = system_of(rotor +
                           "VARIABLE/1, FUNCTION=AZ(20,2)\nVARIABLE/2, FUNCTION=2*AZ(20,2)\n"
                           "SPRINGDAMPER/1, ROTATIONAL, I=20, J=2, KT=1\nBUSHING/1, I=20, J=2, K=1,1,1, KT=1,1,1\n");
  EXPECT_EQ(s->layout().angles.size(), 3u);
  EXPECT_NEAR(angle(*s, turn(*s), {AZ, 20, 2}), turned, 1e-12);
}

TEST(CarryOver, turns_go_on_whatever_the_edited_text_looks_like) {
  const auto from = system_of(rotor + "SFORCE/1, ROTATIONAL, I=20, J=2, FUNCTION=-0.1*AZ(20,2)\n");
  const auto to = system_of(rotor + "BUSHING/1, I=20, J=2, K=1,1,1, KT=1,1,1\nVARIABLE/7, FUNCTION=SIN(AZ(20,2)/9)\n");
  EXPECT_NEAR(angle(*to, carried_over(*from, turn(*from), *to), {AZ, 20, 2}), turned, 1e-12);
}

TEST(CarryOver, turns_are_counted_on_where_nothing_reads_the_angle_for_a_while) {
  const std::string spring = "SPRINGDAMPER/1, ROTATIONAL, I=20, J=2, KT=1\n";
  const auto with = system_of(rotor + spring);
  const auto without = system_of(rotor, {.counted_before = angle_names(with->layout())});
  const auto again = system_of(rotor + spring, {.counted_before = angle_names(without->layout())});
  OperatingPoint op = carried_over(*with, turn(*with), *without);
  for (int k = 0; k < 3; ++k) {
    op.poses[1].R = rotation_exponential({0, 0, 2}) * op.poses[1].R;
    without->remember(op);
  }
  EXPECT_NEAR(angle(*again, carried_over(*without, op, *again), {AZ, 20, 2}), turned + 6, 1e-12);
}

// About the same axis of the same bodies angles differ by what they differed as drawn.
TEST(CarryOver, an_angle_that_nothing_has_counted_takes_its_turns_from_one_about_the_same_axis) {
  const auto from = system_of(rotor + "VARIABLE/1, FUNCTION=AZ(20,2)\n");
  const auto to = system_of(rotor + "VARIABLE/1, FUNCTION=AZ(21,3)+AZ(2,20)+AZ(22,2)+AY(23,4)+AX(23,4)\n");
  const OperatingPoint now = carried_over(*from, turn(*from), *to);
  EXPECT_NEAR(angle(*to, now, {AZ, 21, 3}), turned + 1.7, 1e-12);
  EXPECT_NEAR(angle(*to, now, {AZ, 2, 20}), -turned, 1e-12);
  EXPECT_NEAR(angle(*to, now, {AZ, 22, 2}), turned, 1e-12);
  EXPECT_NEAR(std::abs(angle(*to, now, {AY, 23, 4})), turned, 1e-12);
}

TEST(CarryOver, an_angle_whose_turns_nothing_tells_begins_within_half_a_turn) {
  const auto from = system_of(rotor), to = system_of(rotor + "VARIABLE/1, FUNCTION=AZ(20,2)\n");
  constexpr double pi = 3.14159265358979323846;
  EXPECT_NEAR(angle(*to, carried_over(*from, turn(*from), *to), {AZ, 20, 2}), turned - 4 * pi, 1e-12);
}

// What is drawn counts as where the first turn begins, so that rounding there makes none.
TEST(CarryOver, turns_begin_with_the_angle_as_drawn) {
  const auto s = system_of(
      "PART/2, MASS=1, CM=20, IP=1,1,1, REULER=3,0,0\nMARKER/20\nMARKER/2, PART=1\n"
      "VARIABLE/1, FUNCTION=AZ(20,2)\n");
  OperatingPoint op = s->drawn();
  op.poses[1].R = rotation_exponential({0, 0, 0.5}) * op.poses[1].R;
  s->remember(op);
  EXPECT_NEAR(angle(*s, op, {AZ, 20, 2}), 3.5, 1e-12);
}

std::string delaying(const std::string& function) {
  return "VARIABLE/1, FUNCTION=TIME\nVARIABLE/2, FUNCTION=" + function + "\n";
}
// The motion of VARIABLE/1 that was recorded until time 3.
OperatingPoint recorded(const System& s) {
  OperatingPoint op = s.drawn();
  op.mode = AnalysisMode::dynamics;
  for (int k = 0; k <= 300; ++k) {
    op.time = 0.01 * k;
    for (std::size_t w = 0; w < s.layout().algebraic.size(); ++w)
      if (s.layout().algebraic[w].owner->id == 1) op.algebraic[w] = op.time;
    s.record(op);
  }
  return op;
}

TEST(CarryOver, the_past_of_a_delay_belongs_to_what_is_delayed) {
  const auto from = system_of(delaying("DELAY(VARVAL(1),2,0)"));
  const OperatingPoint op = recorded(*from);
  ASSERT_EQ(op.delays->of_call.size(), 1u);
  const auto same = system_of(delaying("3*DELAY( varval(1), 1.5, 7) +0"));
  const auto other = system_of(delaying("DELAY(2*VARVAL(1),2,0)"));
  const auto past = carried_over(*from, op, *same).delays;
  ASSERT_EQ(past->of_call.size(), 1u);
  EXPECT_EQ(past->of_call[0].start(), 0);
  EXPECT_NEAR(past->of_call[0].at(1.23).value, 1.23, 1e-12);
  EXPECT_TRUE(carried_over(*from, op, *other).delays->of_call[0].empty());
}

// A longer delay cannot read what was not kept.
TEST(CarryOver, a_past_begins_with_what_is_kept) {
  const auto from = system_of(delaying("DELAY(VARVAL(1),0.02,0)"));
  const auto to = system_of(delaying("DELAY(VARVAL(1),2.9,0)"));
  const auto past = carried_over(*from, recorded(*from), *to).delays;
  const DelayHistory& history = past->of_call.at(0);
  EXPECT_GT(history.start(), 0.5);
  EXPECT_LT(history.start(), 3 - 0.02);
  EXPECT_EQ(history.start(), history.oldest());
  EXPECT_TRUE(history.instants().front().begins);
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
  restated.begin({"MOTION", 1});
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
