// DELAY along a motion in time: what it reads is what its argument was, with exact partials.
#include "elements/families/delay.h"

#include <gtest/gtest.h>

#include <cmath>

#include "system/carry_over.h"
#include "system/model_test_support.h"

namespace dynalin::system_test::delay_test {
namespace {

double e(double t) { return std::sin(2 * t) + 0.5 * t; }
const std::string written_e = "SIN(2*TIME)+0.5*TIME";

// A system and a point that is led through time: its states and values have the values of functions of time.
class Led {
 public:
  explicit Led(const std::string& text, DelayReading reading = DelayReading::first_order)
      : system(system_of(text, {reading, {}})), op(system->drawn()) {
    op.mode = AnalysisMode::dynamics;
    eq_.resize(system->layout());
    rows_.resize(system->layout());
  }
  // Of a labelled unknown: "DELAY/1", "VARIABLE/1".
  std::size_t unknown(const std::string& statement, std::int64_t id) const {
    const auto& all = system->layout().algebraic;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].owner->statement == statement && all[k].owner->id == id) return k;
    }
    throw std::runtime_error("no such unknown");
  }
  void evaluate(std::initializer_list<PartialBy> wanted = {}) {
    const Motion m = system->motion(op);
    system->constraints(m, rows_);
    system->equations(m, rows_, eq_, wanted);
  }
  double residual(std::size_t algebraic) {
    evaluate();
    return eq_.residual()[static_cast<std::size_t>(eq_.algebraic_row(static_cast<std::int32_t>(algebraic)))];
  }
  // What the DELAY is where its residual w − … vanishes; the equation is linear in w.
  double delayed(std::int64_t id = 1) {
    const std::size_t w = unknown("DELAY", id);
    op.algebraic[w] = 0;
    return -residual(w);
  }
  double partial(PartialBy family, std::size_t row, std::int32_t column) {
    evaluate({family});
    double sum = 0;
    for_each_in_column(eq_.matrix(family), column, [&](std::int32_t r, double v) {
      if (r == eq_.algebraic_row(static_cast<std::int32_t>(row))) sum += v;
    });
    return sum;
  }
  void record_from(double from, double to, double h) {
    for (double t = from; t < to + 1e-12; t += h) op.time = t, system->record(op);
  }

  std::shared_ptr<const System> system;
  OperatingPoint op;

 private:
  Equations eq_;
  ConstraintRows rows_;
};

std::string delay_of(const std::string& e, const std::string& tau, const std::string& history) {
  return "VARIABLE/1, FUNCTION=DELAY(" + e + "," + tau + "," + history + ")\n";
}

TEST(DelayInTime, reads_the_history_before_the_start_and_the_past_behind_it) {
  for (const DelayReading reading : {DelayReading::first_order, DelayReading::pade}) {
    Led led(delay_of(written_e, "0.3", "7-TIME"), reading);
    EXPECT_NEAR(led.delayed(), 7.3, 1e-14);  // nothing has moved yet
    led.record_from(0, 2, 0.02);
    led.op.time = 0.2;
    EXPECT_NEAR(led.delayed(), 7.1, 1e-14);
    for (const double t : {0.31, 1.0, 1.777, 2.1}) {
      led.op.time = t;
      EXPECT_NEAR(led.delayed(), e(t - 0.3), 1e-6) << t;
    }
    // t − τ lies behind the last accepted instant.
    led.op.time = 2.31;
    EXPECT_NEAR(led.delayed(), e(2.01), 2e-3);
    led.op.time = 2.0;
    EXPECT_NEAR(led.delayed(), e(1.7), 1e-6);
  }
}

TEST(DelayInTime, rests_in_statics_and_after_them) {
  Led led(delay_of(written_e, "0.3", "7"));
  led.record_from(0, 2, 0.02);
  led.op.mode = AnalysisMode::statics;
  EXPECT_NEAR(led.delayed(), e(led.op.time), 1e-14);
}

// A delay of zero or less is none, also where it becomes so on the way.
TEST(DelayInTime, no_delay_is_the_present) {
  Led led(delay_of(written_e, "0.5-TIME", "7"));
  led.record_from(0, 1, 0.02);
  led.op.time = 0.75;
  EXPECT_NEAR(led.delayed(), e(0.75), 1e-14);
  led.op.time = 0.4;
  EXPECT_NEAR(led.delayed(), e(0.3), 1e-6);
}

// τ = VARVAL(2): ∂w/∂τ = −e′(t − τ).
TEST(DelayInTime, partial_with_respect_to_the_delay_is_that_of_what_is_read) {
  Led led(delay_of(written_e, "VARVAL(2)", "3*TIME") + "VARIABLE/2, FUNCTION=0.3\n");
  led.record_from(0, 1, 0.1);
  const std::size_t w = led.unknown("DELAY", 1), tau = led.unknown("VARIABLE", 2);
  for (const auto& [time, lag] : {std::pair{1.0, 0.33}, {0.2, 0.5}, {1.08, 0.04}, {1.0, -0.2}}) {
    led.op.time = time;
    const auto residual = [&](double l) {
      led.op.algebraic[tau] = l;
      return led.residual(w);
    };
    const double difference = (residual(lag + 1e-6) - residual(lag - 1e-6)) / 2e-6;
    led.op.algebraic[tau] = lag;
    EXPECT_NEAR(led.partial(PartialBy::algebraic, w, static_cast<std::int32_t>(tau)), difference, 1e-8) << time;
  }
}

// Behind the last accepted instant w follows the present value of e = VARVAL(2).
TEST(DelayInTime, partial_with_respect_to_the_present_is_that_of_the_course_to_it) {
  Led led(delay_of("VARVAL(2)", "0.05", "0") + "VARIABLE/2, FUNCTION=TIME**2\n");
  const std::size_t w = led.unknown("DELAY", 1), v = led.unknown("VARIABLE", 2);
  for (double t = 0; t < 1.05; t += 0.1) led.op.algebraic[v] = t * t, led.op.time = t, led.system->record(led.op);
  for (const double t : {1.12, 1.04}) {
    led.op.time = t;
    const auto residual = [&](double present) {
      led.op.algebraic[v] = present;
      return led.residual(w);
    };
    const double difference = residual(2.5) - residual(1.5);
    EXPECT_EQ(difference == 0, t < 1.05);
    EXPECT_NEAR(led.partial(PartialBy::algebraic, w, static_cast<std::int32_t>(v)), difference, 1e-13);
  }
}

// The start, where e begins; τ = 0 where τ varies; and kinks of the history before the start.
TEST(DelayInTime, switches_where_a_jump_comes_back) {
  Led led(delay_of(written_e, "0.3", "ABS(TIME+0.1)"));
  led.record_from(0, 1, 0.1);
  const auto changes = [&](double from, double to) {
    ExpressionScratch scratch;
    SwitchList before, behind;
    led.op.time = from;
    led.system->switches(led.system->motion(led.op), scratch, before);
    led.op.time = to;
    led.system->switches(led.system->motion(led.op), scratch, behind);
    EXPECT_EQ(before.value.size(), behind.value.size());
    int count = 0;
    for (std::size_t k = 0; k < before.value.size(); ++k)
      count += (before.value[k] < 0) != (behind.value[k] < 0) && behind.counts[k];
    return count;
  };
  EXPECT_EQ(changes(0.15, 0.25), 1);  // TIME = −0.1 in the history
  EXPECT_EQ(changes(0.29, 0.31), 1);  // the start
  EXPECT_EQ(changes(0.35, 1.5), 0);
  Led varying(delay_of(written_e, "TIME-1", "0"));
  ExpressionScratch scratch;
  SwitchList list;
  for (const double t : {0.5, 1.5}) {
    varying.op.time = t;
    varying.system->switches(varying.system->motion(varying.op), scratch, list);
    ASSERT_EQ(list.value.size(), 2u);
    EXPECT_EQ(list.value[1], t - 1);
  }
}

TEST(DelayInTime, a_kink_of_what_is_delayed_is_one_of_the_motion) {
  Led led(delay_of("ABS(TIME-0.5)", "0.3", "0"));
  ExpressionScratch scratch;
  SwitchList list;
  led.system->switches(led.system->motion(led.op), scratch, list);
  EXPECT_EQ(list.value.size(), 2u);  // its own, and where the past has one
}

TEST(DelayInTime, steps_are_no_longer_than_the_shortest_delay_that_does_not_vary) {
  Led led(delay_of(written_e, "0.3", "0") + "VARIABLE/2, FUNCTION=DELAY(TIME,0.2,0)+DELAY(TIME,-1,0)\n");
  EXPECT_EQ(led.system->longest_step(led.system->motion(led.op)), 0.2);
  Led varying(delay_of(written_e, "1-TIME", "0"));
  varying.op.time = 0.999;
  EXPECT_EQ(varying.system->longest_step(varying.system->motion(varying.op)), std::numeric_limits<double>::infinity());
  EXPECT_EQ(system_of("VARIABLE/1, FUNCTION=1\n")->longest_step({}), std::numeric_limits<double>::infinity());
}

// Histories go on in an edited model, each with the call it belongs to.
TEST(DelayInTime, histories_are_carried_over) {
  const std::string text = delay_of(written_e, "0.3", "0") + "VARIABLE/2, FUNCTION=DELAY(TIME,0.5,0)\n";
  Led led(text), edited(text);
  led.record_from(0, 2, 0.02);
  const double first = led.delayed(1), second = led.delayed(2);
  edited.op = carried_over(*led.system, led.op, *edited.system);
  EXPECT_NE(edited.op.delays, nullptr);
  edited.op.mode = AnalysisMode::dynamics;
  EXPECT_EQ(edited.delayed(1), first);
  EXPECT_EQ(edited.delayed(2), second);
}

}  // namespace
}  // namespace dynalin::system_test::delay_test
