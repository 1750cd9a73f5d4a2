// Events of a simulation at points made by hand: switches of the equations, sensors with all they do, SENVAL.
#include "simulation/events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/carry_over.h"
#include "system/model_test_support.h"

namespace dynalin::system_test::events_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A DIFF whose state x is set by hand.
const std::string state = "DIFF/1, IC=0, FUNCTION=1\n";

class Watched {
 public:
  explicit Watched(const std::string& text)
      : system(system_of(state + text)), op(system->drawn()), events(*system), last_(events.size()) {
    op.mode = AnalysisMode::dynamics;
  }
  // Where the simulation begins.
  EventAction start(double x) {
    move(0, x);
    system->remember(op);
    const EventAction action = events.at_start(op);
    events.values(system->motion(op), last_);
    return action;
  }
  // The next instant, with what has changed its sign since the last one; accepted behind it.
  EventAction go(double time, double x) {
    move(time, x);
    std::vector<double> now(events.size());
    events.values(system->motion(op), now);
    crossed.assign(events.size(), 0);
    for (std::size_t k = 0; k < now.size(); ++k) {
      if ((now[k] < 0) != (last_[k] < 0)) crossed[k] = now[k] < 0 ? -1 : 1;
    }
    last_ = now;
    const EventAction action = events.at(crossed, op);
    system->remember(op);
    return action;
  }
  double senval() {  // VARIABLE/1 reads it
    Equations eq;
    ConstraintRows rows;
    eq.resize(system->layout()), rows.resize(system->layout());
    const Motion m = system->motion(op);
    system->constraints(m, rows);
    system->equations(m, rows, eq, {});
    return -eq.residual()[static_cast<std::size_t>(eq.algebraic_row(0))];
  }

  std::shared_ptr<const System> system;
  OperatingPoint op;
  Events events;
  std::vector<int> crossed;

 private:
  void move(double time, double x) { op.time = time, op.state[0] = x; }
  std::vector<double> last_;
};

TEST(Events, of_equations_make_the_integration_begin_anew) {
  Watched w("VARIABLE/2, FUNCTION=ABS(DIF(1)-1)\nVARIABLE/3, FUNCTION=IF(DIF(1)-3: 1, 0, STEP(DIF(1),0,0,4,1))\n");
  ASSERT_EQ(w.events.size(), 4u);
  EXPECT_FALSE(w.start(-1).restart);
  EXPECT_FALSE(w.go(1, 0.5).restart);  // STEP begins in a branch that is not taken
  EXPECT_THAT(w.crossed, ::testing::Each(0));
  EXPECT_TRUE(w.go(2, 1.5).restart);
  EXPECT_FALSE(w.go(3, 2.5).restart);
  EXPECT_TRUE(w.go(4, 3.5).restart);
  EXPECT_TRUE(w.go(5, 4.5).restart);
  const EventAction back = w.go(6, 3.5);
  EXPECT_TRUE(back.restart);
  EXPECT_FALSE(back.output || back.ends() || back.refactor || back.dump || back.output_step || back.step_size);
  EXPECT_EQ(back.text, "");
}

TEST(Events, of_what_nothing_follows_from_are_none) {
  Watched w("SENSOR/1, FUNCTION=ABS(DIF(1)-1), VALUE=5, EVALUATE=IF(DIF(1):1,2,3)\n");
  EXPECT_EQ(w.events.size(), 3u);
}

TEST(Events, ge_triggers_upwards_once_until_its_condition_has_been_false) {
  Watched w("SENSOR/1, FUNCTION=DIF(1), VALUE=1, GE, PRINT\n");
  EXPECT_FALSE(w.start(0).output);
  EXPECT_FALSE(w.go(1, 0.9).output);
  EXPECT_TRUE(w.go(2, 1.00001).output);
  EXPECT_FALSE(w.go(3, 2).output);
  EXPECT_FALSE(w.go(4, 0.99999).output);  // downwards
  EXPECT_TRUE(w.go(5, 1.5).output);
}

TEST(Events, le_triggers_downwards) {
  Watched w("SENSOR/1, FUNCTION=DIF(1), VALUE=1, LE, PRINT\n");
  EXPECT_FALSE(w.start(2).output);
  EXPECT_TRUE(w.go(1, 0.5).output);
  EXPECT_FALSE(w.go(2, 1.5).output);
  EXPECT_TRUE(w.go(3, 0.5).output);
}

TEST(Events, eq_triggers_both_ways) {
  Watched w("SENSOR/1, FUNCTION=DIF(1), VALUE=1, PRINT\n");
  EXPECT_FALSE(w.start(2).output);
  EXPECT_TRUE(w.go(1, 0.5).output);
  EXPECT_TRUE(w.go(2, 1.0001).output);
  EXPECT_TRUE(w.go(3, 0.9999).output);
  EXPECT_FALSE(w.go(4, 0).output);
}

// A new start of the integration may put the point back by the accuracy to which it is made consistent.
TEST(Events, the_same_crossing_again_is_the_same_event) {
  for (const std::string how : {"GE", "EQ"}) {
    Watched w("SENSOR/1, FUNCTION=DIF(1), VALUE=1, PRINT, " + how + "\n");
    w.start(0);
    EXPECT_TRUE(w.go(1, 1 + 1e-12).output);
    std::vector<int> up = {1, 0, 0};
    w.op.state[0] = 1 - 1e-9;
    w.system->remember(w.op);
    w.op.state[0] = 1 + 1e-9;
    EXPECT_FALSE(w.events.at(up, w.op).output) << how;
  }
}

// VALUE ± ERROR is met by what comes as near and turns back.
TEST(Events, a_function_that_turns_back_near_its_value_triggers_where_it_leaves) {
  for (const std::string how : {"EQ", "GE", "LE"}) {
    const double from = how == "LE" ? 2 : 0, near = how == "LE" ? 1.05 : 0.95;
    Watched w("SENSOR/1, FUNCTION=DIF(1), VALUE=1, ERROR=0.1, PRINT, " + how + "\n");
    EXPECT_FALSE(w.start(from).output) << how;
    EXPECT_FALSE(w.go(1, near).output) << how;
    EXPECT_TRUE(w.go(2, from).output) << how;
    EXPECT_FALSE(w.go(3, near).output) << how;
    EXPECT_TRUE(w.go(4, 1 + (1 - near)).output) << how << " passes";
    EXPECT_FALSE(w.go(5, 2 - from).output) << how << " leaves on the other side";
    // From the other side only EQ is met.
    EXPECT_EQ(w.go(6, 2 - near).output, false) << how;
    EXPECT_EQ(w.go(7, 2 - from).output, how == "EQ") << how;
    EXPECT_FALSE(w.go(8, 2 - near).output) << how;
    EXPECT_EQ(w.start(2 - near).output, how == "EQ") << how << " is near as the next simulation begins";
  }
  Watched angle("SENSOR/1, FUNCTION=DIF(1), VALUE=30D, EQ, ERROR=2D, ANGULAR, PRINT\n");
  const double d = std::numbers::pi / 180;
  EXPECT_FALSE(angle.start(0).output);
  EXPECT_FALSE(angle.go(1, 29 * d).output);
  EXPECT_TRUE(angle.go(2, 20 * d).output);
  EXPECT_FALSE(angle.go(3, 209 * d).output);
  EXPECT_FALSE(angle.go(4, 200 * d).output) << "half a turn further";
}

TEST(Events, a_condition_that_holds_at_the_start_triggers_at_once) {
  Watched ge("SENSOR/1, FUNCTION=DIF(1), VALUE=1, GE, PRINT, ERROR=0.1\n");
  EXPECT_TRUE(ge.start(0.95).output);
  EXPECT_FALSE(ge.go(1, 1.5).output);  // it has held since
  EXPECT_FALSE(ge.start(1.5).output);  // of the next simulation
  EXPECT_FALSE(ge.start(0.5).output);
  EXPECT_TRUE(ge.start(1.5).output);
  Watched le("SENSOR/1, FUNCTION=DIF(1), VALUE=1, LE, PRINT\n");
  EXPECT_TRUE(le.start(1.0005).output);
  Watched eq("SENSOR/1, FUNCTION=DIF(1), VALUE=1, EQ, PRINT, ERROR=0.1\n");
  EXPECT_FALSE(eq.start(2).output);
  EXPECT_TRUE(eq.start(1.05).output);
  EXPECT_FALSE(eq.go(1, 0.95).output);
  EXPECT_FALSE(eq.go(2, 0.5).output);
  EXPECT_TRUE(eq.go(3, 1.5).output);
}

TEST(Events, whole_turns_do_not_count_in_angles) {
  Watched w("SENSOR/1, FUNCTION=DIF(1), VALUE=30D, GE, ANGULAR, PRINT\n");
  const double d = std::numbers::pi / 180;
  EXPECT_FALSE(w.start(10 * d).output);
  EXPECT_TRUE(w.go(1, 31 * d).output);
  EXPECT_FALSE(w.go(2, 100 * d).output);
  EXPECT_FALSE(w.go(3, 211 * d).output);  // half a turn further
  EXPECT_FALSE(w.go(4, 300 * d).output);
  EXPECT_TRUE(w.go(5, 391 * d).output);
  // Backwards through half a turn from VALUE is no coming to it.
  EXPECT_FALSE(w.go(6, 380 * d).output);
  EXPECT_FALSE(w.go(7, 209 * d).output);
  Watched at_start("SENSOR/1, FUNCTION=DIF(1), VALUE=30D, EQ, ANGULAR, PRINT\n");
  EXPECT_TRUE(at_start.start(750 * d).output);
}

TEST(Events, sensors_do_all_they_say) {
  Watched w(
      "SENSOR/7, FUNCTION=DIF(1), VALUE=1, GE, HALT, RETURN, RESTART, CODGEN, YYDUMP, DT=0.01, STEPSIZE=0.001\n"
      "SENSOR/8, FUNCTION=DIF(1), VALUE=2, GE, PRINT\n");
  w.start(0);
  const EventAction a = w.go(1.5, 1.1);
  EXPECT_TRUE(a.halts && a.returns && a.ends() && a.restart && a.refactor && a.dump);
  EXPECT_FALSE(a.output);
  EXPECT_EQ(a.output_step, 0.01);
  EXPECT_EQ(a.step_size, 0.001);
  EXPECT_THAT(a.text, HasSubstr("SENSOR/7 triggers at time 1.5: FUNCTION is 1.1, and ends the run (HALT)\n"));
  EXPECT_THAT(a.text, HasSubstr("state 1 of DIFF/1: 1.1"));
  const EventAction b = w.go(2, 3);
  EXPECT_TRUE(b.output);
  EXPECT_FALSE(b.ends() || b.restart || b.refactor || b.dump || b.output_step || b.step_size);
}

TEST(Events, senval_is_what_evaluate_gave_last) {
  const std::string text =
      "VARIABLE/1, FUNCTION=SENVAL(3)\nSENSOR/3, FUNCTION=DIF(1), VALUE=1, GE, EVALUATE=10*DIF(1)+TIME\n";
  Watched w(text);
  w.start(0);
  EXPECT_EQ(w.senval(), 0);
  const EventAction a = w.go(1, 1.5);
  EXPECT_TRUE(a.restart);  // VARIABLE/1 jumps
  EXPECT_THAT(a.text, HasSubstr("EVALUATE is 16"));
  EXPECT_EQ(w.senval(), 16);
  w.go(2, 3);
  EXPECT_EQ(w.senval(), 16);
  w.go(3, 0);
  w.go(4, 2);
  EXPECT_EQ(w.senval(), 24);
  // In a model of the same text it goes on, and so does that the sensor has triggered.
  Watched edited(text);
  edited.op = carried_over(*w.system, w.op, *edited.system);
  EXPECT_EQ(edited.senval(), 24);
  EXPECT_FALSE(edited.events.at_start(edited.op).restart);
  EXPECT_EQ(edited.senval(), 24);
}

// The points of a run are values: what one of them remembers is not that of another.
TEST(Events, change_the_point_they_are_given) {
  Watched w("VARIABLE/1, FUNCTION=SENVAL(3)\nSENSOR/3, FUNCTION=DIF(1), VALUE=1, GE, EVALUATE=5\n");
  w.start(0);
  const OperatingPoint before = w.op;
  w.go(1, 2);
  EXPECT_EQ(w.senval(), 5);
  w.op = before;
  EXPECT_EQ(w.senval(), 0);
}

}  // namespace
}  // namespace dynalin::system_test::events_test
