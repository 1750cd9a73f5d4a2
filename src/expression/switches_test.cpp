// Switching functions of every function: they change their sign where difference quotients show a kink or a jump, and
// nowhere else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "expression/expression_test_support.h"
#include "expression/functions.h"
#include "expression/switch_test_support.h"

namespace dynalin::expression_test::switches_test {
namespace {

using Taylor = TimeTaylor<double>;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

constexpr double pi = std::numbers::pi;

// An expression of one variable x, VARVAL(1).
class Course {
 public:
  explicit Course(const std::string& text) : parsed_(parse(text)) {
    if (parsed_.diagnostics.has_errors()) throw std::runtime_error(render(parsed_.diagnostics));
  }
  const SwitchList& switches(double x) {
    list_.clear();
    parsed_.expression.switches(std::span(&x, parsed_.expression.atoms().size()), plain_, list_);
    return list_;
  }
  // Value and two derivatives.
  Taylor at(double x) {
    const Taylor atom(x, 1.0, 0.0);
    return parsed_.expression.evaluate<Taylor>(std::span(&atom, parsed_.expression.atoms().size()), taylor_);
  }
  std::vector<double> changes(double from, double to) {
    return sign_changes([&](double x) { return switches(x); }, from, to);
  }
  // The lowest derivative that jumps at x, up to the third; 4 if none does.
  int jump(double x) {
    constexpr double h = 1e-5;
    const Taylor far_left = at(x - 2 * h), left = at(x - h), right = at(x + h), far_right = at(x + 2 * h);
    const auto third = [&](const Taylor& a, const Taylor& b) { return (b.acceleration - a.acceleration) / h; };
    // What is smooth changes over 2h by its derivative, which is moderate in all rows.
    if (std::abs(right.value - left.value) > 0.01) return 0;
    if (std::abs(right.rate - left.rate) > 0.01) return 1;
    if (std::abs(right.acceleration - left.acceleration) > 0.1) return 2;
    return std::abs(third(right, far_right) - third(far_left, left)) > 1 ? 3 : 4;
  }

 private:
  ParsedText parsed_;
  ExpressionWorkspace<double> plain_;
  ExpressionWorkspace<Taylor> taylor_;
  SwitchList list_;
};

struct Row {
  std::string text;  // of x
  std::vector<double> places;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> table = {
      {"ABS(x-0.3)", {0.3}},
      {"SIGN(2,x)", {0}},
      {"SIGN(x,x-1)", {0, 1}},
      {"AINT(x)", {-2, -1, 1, 2}},
      {"ANINT(x)", {-2.5, -1.5, -0.5, 0.5, 1.5, 2.5}},
      {"MOD(x,0.7)", {-2.8, -2.1, -1.4, -0.7, 0.7, 1.4, 2.1, 2.8}},
      {"MOD(x+10,-4)", {-2, 2}},
      {"DIM(x,0.2)", {0.2}},
      {"MAX(x,0.5)", {0.5}},
      {"MAX(x,x*x,0.25)", {-0.5, 0.25, 1}},
      {"MAX(0.25,x,x*x)", {-0.5, 0.25, 1}},
      {"MIN(x,0.5,0.2-x)", {0.1}},
      {"MIN(x,0.5,1.2-x)", {0.5, 0.7}},
      {"IF(x-0.4: 1, 2, x)", {0.4}},
      {"IF(x-0.4: IF(x+1: 0, 0, 1), 0, IF(x+2: 1, 2, 3))", {-1, 0.4}},
      {"IF(IF(x:-1,0,1)*IF(x-1:-1,0,1): x, x, 2)", {0, 1}},
      {"ATAN2(SIN(2*x),COS(2*x))", {-pi / 2, pi / 2}},
      {"STEP(x,-1,1,1,2)", {-1, 1}},
      {"STEP(x,1,1,-1,2)", {-1, 1}},
      {"STEP(x*x,1,0,4,1)", {-2, -1, 1, 2}},
      {"STEP5(x,0,1,0.5,2)", {0, 0.5}},
      {"HAVSIN(x,-2,1,1,2)", {-2, 1}},
      {"IMPACT(x,-1,0.5,10,2,2,0.4)", {0.1, 0.5}},
      {"IMPACT(x,-1,0.5,10,1.0,0,0.4)", {0.5}},
      {"BISTOP(x,0.1,-1,0.5,10,2,2,0.4)", {-1.4, -1, 0.5, 0.9}},
      {"SWEEP(x,1,-1,0.3,1.5,1,0.5)", {-1, -0.5, 1.5}},
      {"SWEEP(x,1,-1,0.3,1.5,0.3,0.5)", {-1, -0.5}},
      {"POLY(x,0,1,2,3)", {}},
      {"CHEBY(x,0,1,0.2,0.3)", {}},
      {"FORSIN(x,0,1,2,1)+FORCOS(x,0,1,2,1)+SHF(x,0,1,2,1,0)", {}},
      {"SIN(x)*EXP(x/3)/(4+x)+SQRT(x+4)+TANH(x)+ATAN(x)", {}},
      {"x**3", {}},
  };
  return table;
}

std::string with_variable(std::string text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == 'x') text.replace(k, 1, "VARVAL(1)");
  }
  return text;
}

TEST(Switches, change_their_sign_at_kinks_and_jumps_and_nowhere_else) {
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.text);
    Course course(with_variable(row.text));
    EXPECT_THAT(course.changes(-2.9, 2.93), Pointwise(DoubleNear(1e-9), row.places));
    for (const double x : row.places) EXPECT_LE(course.jump(x), 3) << "at " << x;
    for (double x = -2.95; x < 2.95; x += 0.00931) {
      const bool near =
          std::any_of(row.places.begin(), row.places.end(), [&](double place) { return std::abs(x - place) < 1e-4; });
      if (!near) {
        EXPECT_EQ(course.jump(x), 4) << "at " << x;
      }
    }
  }
}

// Each function of the tables that is made of pieces stands in a row above; the others have no switches.
TEST(Switches, are_known_of_every_function_that_has_kinks) {
  for (const auto& family : {elementary_functions(), contact_functions(), series_functions()}) {
    for (const Function& f : family) {
      const bool in_a_row = std::any_of(rows().begin(), rows().end(), [&](const Row& row) {
        return !row.places.empty() && row.text.starts_with(std::string(f.name) + "(");
      });
      EXPECT_EQ(f.switches != nullptr, in_a_row) << f.name;
      EXPECT_TRUE(f.switches || !f.kinked) << f.name;
    }
  }
}

TEST(Switches, of_constants_are_none) {
  for (const std::string text : {"VARVAL(1)*STEP(1,0,0,2,1)", "VARVAL(1)+IF(2: 1, 2, 3)", "IF(MODE-5: 1, 2, VARVAL(1))",
                                 "VARVAL(1)*ABS(-3)", "IF(SENVAL(1)-2: 1, 2, VARVAL(1))"}) {
    EXPECT_FALSE(parse(text).expression.has_switches()) << text;
  }
  // Whatever the condition jumps with is known already.
  Course nested("IF(IF(VARVAL(1): -1, 0, 1): 1, 2, 3)");
  EXPECT_EQ(nested.switches(0.5).value.size(), 1u);
}

TEST(Switches, are_as_many_in_the_same_order_in_every_branch) {
  Course course(
      "IF(VARVAL(1): ABS(VARVAL(1)+1), 0, IF(VARVAL(1)-1: 0, 1, SQRT(VARVAL(1)-1)+ABS(SQRT(VARVAL(1)-1)-2)))");
  EXPECT_THAT(course.switches(-2).value, ElementsAre(-2, -1, -3, 1));
  EXPECT_THAT(course.switches(-2).counts, ElementsAre(true, true, false, false));
  EXPECT_THAT(course.switches(0.5).value, ElementsAre(0.5, 1.5, -0.5, 1));
  EXPECT_THAT(course.switches(0.5).counts, ElementsAre(true, false, true, false));
  EXPECT_THAT(course.switches(2).value, ElementsAre(2, 3, 1, -1));
  EXPECT_THAT(course.switches(2).counts, ElementsAre(true, false, true, true));
}

// The damper pulls more than the stop pushes, so that there is no force, at depths p at which
// c v (p/d)² (3 − 2 p/d) > k p²: below 0.175. The contact is left at p = 0 all the same, without any kink.
TEST(Switches, of_a_stop_end_with_the_contact) {
  Course leaving("IMPACT(VARVAL(1),2,0.5,25,2,0.4,0.2)");
  EXPECT_THAT(leaving.changes(0, 0.6),
              ElementsAre(DoubleNear(0.3, 1e-9), DoubleNear(0.325, 1e-9), DoubleNear(0.5, 1e-9)));
  EXPECT_LE(leaving.jump(0.3), 3);
  EXPECT_EQ(leaving.jump(0.325), 1);
  EXPECT_EQ(leaving.jump(0.5), 4);
  // Deeper than the damping takes to come in: where it is in full the force is held, which leaves no kink there.
  Course held("IMPACT(VARVAL(1),2,0.5,25,2,1,0.2)");
  EXPECT_THAT(held.changes(0, 0.6), ElementsAre(DoubleNear(0.5 - std::sqrt(2.0 / 25), 1e-9), DoubleNear(0.5, 1e-9)));
}

TEST(Switches, of_definitions_come_with_them) {
  const ParsedText outer = parse("2*VARVAL(1)"), inner = parse("ABS(TIME-1)");
  const Expression e = outer.expression.with_definitions([&](const Atom&) { return inner.expression; });
  EXPECT_FALSE(outer.expression.has_switches());
  ASSERT_TRUE(e.has_switches());
  SwitchList list;
  ExpressionWorkspace<double> workspace;
  const double time = 3;
  e.switches(std::span(&time, 1), workspace, list);
  EXPECT_THAT(list.value, ElementsAre(2));
}

TEST(KnotSwitch, changes_its_sign_at_each_knot) {
  const std::vector<double> knots = {-1, 0.5, 0.75, 4};
  const std::vector<double> between = {-3, 0, 0.6, 1, 9};
  for (const std::size_t first : {0u, 1u}) {
    double sign = first == 0 ? -1 : 1;
    for (const double x : between) {
      EXPECT_GT(sign * knot_switch(knots, x, first), 0) << x;
      sign = -sign;
    }
    for (const double k : knots) EXPECT_NEAR(knot_switch(knots, k, first), 0, 1e-15);
  }
  EXPECT_NEAR(knot_switch(knots, 4 - 1e-6) - knot_switch(knots, 4 + 1e-6), 0, 1e-5);
  const double one = 2;
  EXPECT_EQ(knot_switch(std::span(&one, 1), 2.5), 0.5);
  EXPECT_EQ(knot_switch(std::span(&one, 1), 1), -1);
  // Knots that have been left behind keep their sign.
  EXPECT_LT(knot_switch({}, 7, 0), 0);
  EXPECT_GT(knot_switch({}, 7, 1), 0);
  EXPECT_GT(knot_switch(std::span(knots).subspan(1), 0, 1), 0);
}

}  // namespace
}  // namespace dynalin::expression_test::switches_test
