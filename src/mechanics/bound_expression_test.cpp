// Bound expressions against differences of varied paths: residuals, rows, rates and reactions with all their partials.
#include "mechanics/bound_expression.h"

#include <gmock/gmock.h>

#include "mechanics/binding_test_support.h"
#include "mechanics/turn_counter.h"

namespace dynalin::mechanics_test::bound_expression_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Values outside bodies that an expression may read: w of VARIABLEs, z of states and z′.
struct Values {
  std::array<Real, 3> w{};
  std::array<Real, 2> z{}, zdot{};
};
Values values_of(const Motion& m) {
  return {
      {m.algebraic[0], m.algebraic[1], m.algebraic[2]}, {m.state[0], m.state[1]}, {m.state_rate[0], m.state_rate[1]}};
}

constexpr std::initializer_list<PartialBy> all_partials = {
    PartialBy::position,  PartialBy::velocity, PartialBy::damping,   PartialBy::acceleration,
    PartialBy::algebraic, PartialBy::state,    PartialBy::state_rate};

// Row and partials of factor · f(moment, values) that `add` makes.
template <class Add, class Function>
void expect_equation(const SmallSystem& s, PartialBy velocity_family, const Add& add, const Function& f) {
  const std::int32_t row = s.p.layout.coordinate_count + 1;
  const Equations eq = assembled(s.p.layout, all_partials, [&](Equations& e) { add(e, row); });
  const Values now = values_of(s.p.motion);
  EXPECT_TRUE(agree(eq.residual()[static_cast<std::size_t>(row)], f(s.p.now(), now)));
  const std::array families = {PartialBy::position, velocity_family, PartialBy::acceleration};
  for (std::int32_t c = 0; c < s.p.layout.coordinate_count; ++c) {
    for (std::size_t level = 0; level < 3; ++level) {
      const Real expected = s.p.now().partial(c, level, [&](const Moment& m) { return f(m, now); });
      EXPECT_TRUE(agree(entry(eq.matrix(families[level]), row, c), expected)) << coordinate_name(s.p.layout, c, level);
    }
    const PartialBy other = velocity_family == PartialBy::velocity ? PartialBy::damping : PartialBy::velocity;
    EXPECT_EQ(entry(eq.matrix(other), row, c), 0) << "in the family of the other rates";
  }
  const auto by = [&](auto member, std::size_t k) {
    return slope([&](Real size) {
      Values v = now;
      (v.*member)[k] += size;
      return f(s.p.now(), v);
    });
  };
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_TRUE(agree(entry(eq.matrix(PartialBy::algebraic), row, static_cast<std::int32_t>(k)), by(&Values::w, k)))
        << "value " << k;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto column = static_cast<std::int32_t>(k);
    EXPECT_TRUE(agree(entry(eq.matrix(PartialBy::state), row, column), by(&Values::z, k))) << "state " << k;
    EXPECT_TRUE(agree(entry(eq.matrix(PartialBy::state_rate), row, column), by(&Values::zdot, k))) << "rate " << k;
  }
}

RealVector between(const Moment& m, int i, int j) { return m.origin(MarkerId{i}) - m.origin(MarkerId{j}); }
RealVector velocity(const Moment& m, int i, int j, int l) {
  return m.rate_seen_from(MarkerId{l}, [&](const Moment& n) { return between(n, i, j); });
}
RealVector acceleration(const Moment& m, int i, int j, int l) {
  return m.rate_seen_from(MarkerId{l}, [&](const Moment& n) { return velocity(n, i, j, l); });
}
RealMatrix axes(const Moment& m, int k) { return m.axes(MarkerId{k}); }
RealVector turning(const Moment& m, int i) { return m.angular_velocity(MarkerId{i}); }

// --- residuals ------------------------------------------------------------------------------------------------------

TEST(BoundExpression, of_displacements_and_values_has_all_its_partials) {
  SmallSystem s;
  const BoundExpression e = s.bound("DX(2,5,9)*VARVAL(1)+SIN(DM(4,7))*DIF(2)**2-3*DIF1(1)*DZ(8)+TIME*VARVAL(9)");
  EXPECT_EQ(e.order(), 0);
  const auto f = [&](const Moment& m, const Values& v) {
    return dot(axes(m, 9).x, between(m, 2, 5)) * v.w[0] + std::sin(norm(between(m, 4, 7))) * v.z[1] * v.z[1] -
           3 * v.zdot[0] * m.origin(MarkerId{8}).z + static_cast<Real>(s.p.motion.time) * 2.5L;
  };
  for (const double factor : {1.0, -2.5}) {
    expect_equation(
        s, PartialBy::damping,
        [&](Equations& eq, std::int32_t row) { e.add(s.p.motion, eq, row, factor, PartialBy::damping); },
        [&](const Moment& m, const Values& v) { return factor * f(m, v); });
  }
  ExpressionScratch scratch;
  EXPECT_TRUE(agree(e.value(s.p.motion, scratch), f(s.p.now(), values_of(s.p.motion))));
}

TEST(BoundExpression, of_velocities_puts_rates_into_the_family_of_its_owner) {
  SmallSystem s;
  const BoundExpression e = s.bound("VX(2,5,9,4)*DY(8,2,5)+WZ(4,9,2)*VARVAL(2)");
  EXPECT_EQ(e.order(), 1);
  for (const PartialBy family : {PartialBy::damping, PartialBy::velocity}) {
    expect_equation(
        s, family, [&](Equations& eq, std::int32_t row) { e.add(s.p.motion, eq, row, 1.5, family); },
        [&](const Moment& m, const Values& v) {
          return 1.5L * (dot(axes(m, 9).x, velocity(m, 2, 5, 4)) * dot(axes(m, 5).y, between(m, 8, 2)) +
                         dot(axes(m, 2).z, turning(m, 4) - turning(m, 9)) * v.w[1]);
        });
  }
}

TEST(BoundExpression, of_accelerations_has_partials_on_three_levels) {
  SmallSystem s;
  const BoundExpression e = s.bound("ACCZ(2,5,9,4)*VARVAL(1)");
  EXPECT_EQ(e.order(), 2);
  expect_equation(
      s, PartialBy::damping,
      [&](Equations& eq, std::int32_t row) { e.add(s.p.motion, eq, row, 1, PartialBy::damping); },
      [&](const Moment& m, const Values& v) { return dot(axes(m, 9).z, acceleration(m, 2, 5, 4)) * v.w[0]; });
}

TEST(BoundExpression, an_angle_counts_turns_and_keeps_its_slope) {
  SmallSystem s;
  const BoundExpression e = s.bound("AZ(2,5)");
  ExpressionScratch scratch;
  const double first = e.value(s.p.motion, scratch);
  constexpr double turns = 6 * 3.14159265358979323846;
  s.p.motion.memory = {first + turns + 0.5};
  EXPECT_NEAR(e.value(s.p.motion, scratch), first + turns, 1e-12);
  Memory memory = {first + turns - 0.5};
  TurnCounter(s).remember(s.p.motion, memory);
  EXPECT_NEAR(memory[0], first + turns, 1e-12);
  // That of x of I about z of J, from its first value on
  const auto angle = [](const Moment& m) {
    return std::atan2(dot(axes(m, 5).y, axes(m, 2).x), dot(axes(m, 5).x, axes(m, 2).x));
  };
  expect_equation(
      s, PartialBy::damping,
      [&](Equations& eq, std::int32_t row) { e.add(s.p.motion, eq, row, 1, PartialBy::damping); },
      [&](const Moment& m, const Values&) { return angle(m) - angle(s.p.now()) + first + turns; });
  EXPECT_TRUE(agree(first, angle(s.p.now())));
}

TEST(BoundExpression, partials_by_atoms_come_in_their_order) {
  SmallSystem s;
  const BoundExpression e = s.bound("VARVAL(1)*DIF(1)-VARVAL(2)");
  ExpressionScratch scratch;
  const auto partials = e.partials(s.p.motion, scratch);
  EXPECT_THAT(std::vector<double>(partials.begin(), partials.end()), ElementsAre(0.9, 0.3, -1.0));
}

TEST(BoundExpression, a_size_that_is_zero_has_no_direction) {
  SmallSystem s;
  const BoundExpression e = s.bound("5*DM(2,2)+VM(1,1)+VARVAL(1)");
  expect_equation(
      s, PartialBy::damping,
      [&](Equations& eq, std::int32_t row) { e.add(s.p.motion, eq, row, 1, PartialBy::damping); },
      [&](const Moment&, const Values& v) { return v.w[0]; });
}

// --- forces that an expression reads --------------------------------------------------------------------------------

TEST(BoundExpression, of_a_force_follows_all_that_the_force_depends_on) {
  SmallSystem s;
  struct Case {
    std::string text;
    RealVector (*of)(const RealVector& force, const Moment&);
    int axes, axis;
  };
  const auto on_I = [](const RealVector& f, const Moment&) { return f; };
  const auto on_J = [](const RealVector& f, const Moment&) { return -f; };
  // At marker 5 the opposite acts at the origin of I: −delta × f, which vanishes for a force along the line
  const auto torque_on_J = [](const RealVector& f, const Moment& m) { return -cross(between(m, 2, 5), f); };
  for (const Case& c :
       {Case{"SFORCE(1,0,3,9)", on_I, 9, 1}, Case{"FX(2,5,4)", on_I, 4, 0}, Case{"FZ(5,2,9)", on_J, 9, 2},
        Case{"FY(5,0,2)", on_J, 2, 1}, Case{"SFORCE(1,1,2,4)", on_J, 4, 0}, Case{"TY(5,2,9)", torque_on_J, 9, 1}}) {
    SCOPED_TRACE(c.text);
    const BoundExpression e = s.bound(c.text);
    EXPECT_EQ(e.order(), 2);
    expect_equation(
        s, PartialBy::damping,
        [&](Equations& eq, std::int32_t row) { e.add(s.p.motion, eq, row, 2, PartialBy::damping); },
        [&](const Moment& m, const Values& v) {
          return 2 * dot(axes(m, c.axes)[static_cast<std::size_t>(c.axis)], c.of(s.spring.force(m, v.w[0]), m));
        });
  }
}

TEST(BoundExpression, of_the_size_of_a_force_turns_with_the_force) {
  SmallSystem s;
  const BoundExpression e = s.bound("FM(2,5)");
  expect_equation(
      s, PartialBy::damping,
      [&](Equations& eq, std::int32_t row) { e.add(s.p.motion, eq, row, 1, PartialBy::damping); },
      [&](const Moment& m, const Values& v) { return norm(s.spring.force(m, v.w[0])); });
}

TEST(BoundExpression, of_a_force_without_reaction_is_zero_on_J) {
  SmallSystem s;
  s.spring.acts_on_J = false;
  const BoundExpression e = s.bound("FX(5,2,9)");
  expect_equation(
      s, PartialBy::damping,
      [&](Equations& eq, std::int32_t row) { e.add(s.p.motion, eq, row, 1, PartialBy::damping); },
      [](const Moment&, const Values&) { return Real(0); });
}

TEST(BoundExpression, of_a_force_that_is_not_there_is_zero) {
  SmallSystem s;
  ExpressionScratch scratch;
  EXPECT_EQ(s.bound("SFORCE(2,0,3,9)").value(s.p.motion, scratch), 0);
  EXPECT_EQ(s.bound("FX(8,9,0)").value(s.p.motion, scratch), 0);
}

// --- rates ----------------------------------------------------------------------------------------------------------

TEST(BoundExpression, its_rate_follows_from_atoms_that_move_and_from_rates_of_channels) {
  SmallSystem s;
  const BoundExpression e = s.bound("DX(2,5,9)*VARVAL(1)+DIF(2)**2*TIME-DM(4,7)**3", Binding::rates);
  EXPECT_THAT(s.problems, IsEmpty());
  const Real time = s.p.motion.time;
  // By the product rule over paths: w₃ is the rate of w₁.
  const auto rate = [&](const Moment& m, const Values& v) {
    const auto of = [&](const Moment& n, Real t) {
      const Real w = v.w[0] + v.w[2] * t, z = v.z[1] + v.zdot[1] * t;
      return dot(axes(n, 9).x, between(n, 2, 5)) * w + z * z * (time + t) - std::pow(norm(between(n, 4, 7)), 3);
    };
    return slope([&](Real t) { return of(m.later(t), t); });
  };
  for (const double factor : {1.0, -0.5}) {
    expect_equation(
        s, PartialBy::damping,
        [&](Equations& eq, std::int32_t row) { e.add_rate(s.p.motion, eq, row, factor, PartialBy::damping); },
        [&](const Moment& m, const Values& v) { return factor * rate(m, v); });
  }
  ExpressionScratch scratch;
  EXPECT_TRUE(agree(e.rate(s.p.motion, scratch), rate(s.p.now(), values_of(s.p.motion))));
}

TEST(BoundExpression, the_rate_of_velocities_has_partials_by_accelerations) {
  SmallSystem s;
  const BoundExpression e = s.bound("VX(2,5,9)*VARVAL(1)", Binding::rates);
  expect_equation(
      s, PartialBy::velocity,
      [&](Equations& eq, std::int32_t row) { e.add_rate(s.p.motion, eq, row, 1, PartialBy::velocity); },
      [&](const Moment& m, const Values& v) {
        return slope([&](Real t) {
          const Moment n = m.later(t);
          return dot(axes(n, 9).x, velocity(n, 2, 5, 0)) * (v.w[0] + v.w[2] * t);
        });
      });
}

TEST(BoundExpression, time_stands_still_in_statics) {
  SmallSystem s;
  const BoundExpression e = s.bound("3*TIME", Binding::rates);
  ExpressionScratch scratch;
  EXPECT_EQ(e.rate(s.p.motion, scratch), 3);
  s.p.motion.mode = AnalysisMode::statics;
  EXPECT_EQ(e.rate(s.p.motion, scratch), 0);
}

TEST(BoundExpression, what_has_no_rate_is_a_problem_of_the_input) {
  SmallSystem s;
  s.bound("ACCX(2,5)", Binding::rates);
  s.bound("FX(2,5,0)", Binding::rates);
  s.bound("DIF1(1)", Binding::rates);
  EXPECT_THAT(s.problems, ElementsAre("unknown-rate", "unknown-rate", "unknown-rate"));
  s.problems.clear();
  s.bound("VARVAL(7)");
  s.unplaced = 7;
  s.bound("DX(7)");
  EXPECT_THAT(s.problems, ElementsAre("unfilled-entry", "unplaced-marker"));
}

TEST(BoundExpression, a_condition_reads_every_rate_of_a_state_as_zero) {
  SmallSystem s;
  ExpressionScratch scratch;
  EXPECT_EQ(s.bound("DIF1(1)+DIF(1)", Binding::condition).value(s.p.motion, scratch), 0.9);
  EXPECT_EQ(s.bound("DIF1(1)+DIF(1)").value(s.p.motion, scratch), 0.9 + 0.35);
}

// --- constraint rows ------------------------------------------------------------------------------------------------

template <class Function>
void expect_position_row(const SmallSystem& s, const ConstraintRows& rows, const Function& f) {
  for (std::int32_t c = 0; c < s.p.layout.coordinate_count; ++c) {
    const RowCoefficients k = coefficients(rows, 0, c);
    const auto gradient = [&](const Moment& m) { return m.partial(c, 0, f); };
    const std::string by = coordinate_name(s.p.layout, c);
    EXPECT_TRUE(agree(k.g, gradient(s.p.now()))) << by;
    EXPECT_TRUE(agree(k.v, s.p.now().rate(gradient))) << by;
    EXPECT_TRUE(agree(k.a1, 2 * s.p.now().rate(gradient))) << by;
    EXPECT_TRUE(agree(k.a0, s.p.now().second_rate(gradient))) << by;
  }
}

TEST(BoundExpression, a_row_on_positions_has_its_gradient_with_two_rates) {
  SmallSystem s;
  const BoundExpression e = s.bound("DX(2,5,9)**2*COS(DZ(4,8))+TIME*DM(6,2)");
  const auto f = [&](const Moment& m) {
    const Real dx = dot(axes(m, 9).x, between(m, 2, 5));
    return -1.5L * (dx * dx * std::cos(between(m, 4, 8).z) + (s.p.motion.time + m.t) * norm(between(m, 6, 2)));
  };
  ConstraintRows rows;
  rows.resize(s.p.layout);
  rows.begin();
  const Taylor course = e.add_position(s.p.motion, rows, 0, -1.5);
  EXPECT_TRUE(agree(course.value, f(s.p.now())));
  EXPECT_TRUE(agree(course.rate, s.p.now().rate(f)));
  EXPECT_TRUE(agree(course.acceleration, s.p.now().second_rate(f)));
  expect_position_row(s, rows, f);
  EXPECT_TRUE(rows.row(1).empty());
}

TEST(BoundExpression, values_of_others_in_a_row_move_along_with_it) {
  SmallSystem s;
  const BoundExpression e = s.bound("DX(2,5,9)*VARVAL(1)");
  const Taylor w(0.3, -0.7, 1.1), factor(2.0, 0.5, -0.3);
  const auto course = [](const Taylor& x, Real t) { return x.value + x.rate * t + x.acceleration * (t * t / 2); };
  const auto f = [&](const Moment& m) {
    return course(factor, m.t) * dot(axes(m, 9).x, between(m, 2, 5)) * course(w, m.t);
  };
  ConstraintRows rows;
  rows.resize(s.p.layout);
  rows.begin();
  const std::array<Taylor, 2> given = {Taylor(0.0), w};
  e.add_position(s.p.motion, rows, 0, factor, given);
  expect_position_row(s, rows, f);
  // What the value is multiplied with is left behind.
  const auto slope_of_w = [&](const Moment& m) { return dot(axes(m, 9).x, between(m, 2, 5)); };
  EXPECT_TRUE(agree(rows.scratch.taylor_partials[1].value, slope_of_w(s.p.now())));
  EXPECT_TRUE(agree(rows.scratch.taylor_partials[1].rate, s.p.now().rate(slope_of_w)));
}

TEST(BoundExpression, a_row_on_velocities_has_partials_by_positions_velocities_and_their_rates) {
  SmallSystem s;
  const BoundExpression e = s.bound("VX(2,5,9)*DY(4,8)-WZ(4,2,9)*TIME+DX(8)");
  const auto f = [&](const Moment& m) {
    return 2 * (dot(axes(m, 9).x, velocity(m, 2, 5, 0)) * between(m, 4, 8).y -
                dot(axes(m, 9).z, turning(m, 4) - turning(m, 2)) * (s.p.motion.time + m.t) + m.origin(MarkerId{8}).x);
  };
  ConstraintRows rows;
  rows.resize(s.p.layout);
  rows.begin();
  const Taylor course = e.add_velocity(s.p.motion, rows, 1, 2);
  EXPECT_TRUE(agree(course.value, f(s.p.now())));
  EXPECT_TRUE(agree(course.rate, s.p.now().rate(f)));
  for (std::int32_t c = 0; c < s.p.layout.coordinate_count; ++c) {
    const RowCoefficients k = coefficients(rows, 1, c);
    const auto rate = [&](const Moment& m) { return m.rate(f); };
    const std::string by = coordinate_name(s.p.layout, c);
    EXPECT_TRUE(agree(k.g, s.p.now().partial(c, 1, f))) << by;
    EXPECT_TRUE(agree(k.v, s.p.now().partial(c, 0, f))) << by;
    // δΨ′ = g δq″ + a1 δq′ + a0 δq
    EXPECT_TRUE(agree(k.a1, s.p.now().partial(c, 1, rate))) << by;
    EXPECT_TRUE(agree(k.a0, s.p.now().partial(c, 0, rate))) << by;
  }
}

// --- reactions of rows ----------------------------------------------------------------------------------------------

// −λ ∂Φ along one unit displacement (or velocity), varied by another coordinate that moves first.
// `seen` are the coordinates of the bodies it reads, which come first.
template <class Function>
void expect_reaction_partials(const SmallSystem& s, const BoundExpression& e, RowLevel level, std::int32_t seen,
                              const Function& f) {
  constexpr double lambda = -1.7;
  const Equations eq = assembled(s.p.layout, {PartialBy::position, PartialBy::velocity},
                                 [&](Equations& q) { e.add_reaction_partials(s.p.motion, q, lambda, level); });
  const std::size_t inner = level == RowLevel::position ? 0 : 1;
  for (std::int32_t i = 0; i < s.p.layout.body_coordinate_count; ++i) {
    for (std::int32_t j = 0; j < s.p.layout.body_coordinate_count; ++j) {
      for (std::size_t outer = 0; outer < 2; ++outer) {
        const auto force = [&](const Moment& m) { return m.partial(i, inner, f); };
        const Real expected = outer <= inner && i < seen && j < seen ? -lambda * s.p.now().partial(j, outer, force) : 0;
        EXPECT_TRUE(agree(entry(eq.matrix(outer == 0 ? PartialBy::position : PartialBy::velocity), i, j), expected))
            << "force on " << coordinate_name(s.p.layout, i) << " by " << coordinate_name(s.p.layout, j, outer);
      }
    }
  }
}

TEST(BoundExpression, reactions_of_a_row_on_positions_have_their_stiffness) {
  SmallSystem s;
  const BoundExpression e = s.bound("DX(2,5,4)*DM(4,6)");
  expect_reaction_partials(s, e, RowLevel::position, 15, [](const Moment& m) {
    return dot(axes(m, 4).x, between(m, 2, 5)) * norm(between(m, 4, 6));
  });
}

TEST(BoundExpression, reactions_of_a_row_on_velocities_have_partials_by_positions_and_velocities) {
  SmallSystem s;
  const BoundExpression e = s.bound("VX(2,0,2)**2*DY(2)");
  expect_reaction_partials(s, e, RowLevel::velocity, 6, [](const Moment& m) {
    const Real v = dot(axes(m, 2).x, velocity(m, 2, 0, 0));
    return v * v * m.origin(MarkerId{2}).y;
  });
}

TEST(BoundExpression, a_reaction_of_zero_keeps_the_pattern) {
  SmallSystem s;
  const BoundExpression e = s.bound("DX(2,5,4)*DM(4,6)");
  const auto places = [&](double lambda) {
    return assembled(s.p.layout, {PartialBy::position},
                     [&](Equations& q) { e.add_reaction_partials(s.p.motion, q, lambda, RowLevel::position); })
        .matrix(PartialBy::position)
        .value.size();
  };
  EXPECT_EQ(places(0.0), places(1.0));
  EXPECT_GT(places(0.0), 0u);
}

// --- where nothing is defined ---------------------------------------------------------------------------------------

TEST(BoundExpression, what_has_no_value_or_derivative_is_named_with_its_reason) {
  SmallSystem s;
  const ElementLabel label{"VARIABLE", 1, {}, {}};
  const auto reason = [&](const std::string& text) {
    UndefinedValues found;
    s.bound(text).find_undefined(s.p.motion, label, found);
    const std::vector<UndefinedValue>& all = found.values();
    return all.empty() ? std::string() : (all[0].in_value ? "value: " : "slope: ") + all[0].reason;
  };
  EXPECT_EQ(reason("SQRT(VARVAL(1))"), "");
  EXPECT_EQ(reason("SQRT(VARVAL(2))"), "value: VARIABLE/1: SQRT of -0.8");
  EXPECT_EQ(reason("SQRT(DIF(1)-0.9)"), "slope: VARIABLE/1: the derivative of SQRT is infinite at 0");
  EXPECT_EQ(reason("0*SQRT(1+VARVAL(1))"), "");
}

// --- switches -------------------------------------------------------------------------------------------------------

TEST(BoundExpression, with_kinks_is_noted_where_it_is_part_of_an_equation) {
  SmallSystem s;
  s.bound("SIN(TIME)+DX(2,5)");
  EXPECT_TRUE(s.switching.empty());
  const BoundExpression e = s.bound("ABS(DX(2,5)-1)");
  ASSERT_EQ(s.switching.size(), 1u);
  s.bound("ABS(DX(2,5)-1)", Binding::rates);
  s.bound("ABS(DX(2,5)-1)", Binding::observation);
  EXPECT_EQ(s.switching.size(), 1u);
  ExpressionScratch scratch;
  SwitchList list;
  s.switching[0].switches(s.p.motion, scratch, list);
  const BoundExpression inner = s.bound("DX(2,5)-1");
  ASSERT_EQ(list.value.size(), 1u);
  EXPECT_EQ(list.value[0], inner.value(s.p.motion, scratch));
}

// The principal value of an angle goes on half a turn further on the other side; AX counts turns.
TEST(BoundExpression, switches_where_an_angle_jumps_by_a_turn) {
  SmallSystem s;
  for (const std::string name : {"PSI", "PHI", "YAW", "ROLL"}) {
    const BoundExpression e = s.bound("2*" + name + "(2,5)"), angle = s.bound(name + "(2,5)");
    ASSERT_TRUE(e.has_switches()) << name;
    ExpressionScratch scratch;
    SwitchList list;
    e.switches(s.p.motion, scratch, list);
    const double value = angle.value(s.p.motion, scratch);
    ASSERT_EQ(list.value.size(), 1u);
    EXPECT_DOUBLE_EQ(list.value[0], std::sin(value));
    EXPECT_EQ(list.counts[0], std::abs(value) > 0.5 * std::numbers::pi);
  }
  for (const std::string text : {"AX(2,5)", "THETA(2,5)", "PSI(2,5)+PHI(2,5)"})
    EXPECT_FALSE(s.bound(text).has_switches());
}

TEST(BoundExpression, senval_is_what_the_memory_holds) {
  SmallSystem s;
  const BoundExpression e = s.bound("3*SENVAL(1)");
  s.p.motion.memory.back() = 1.5;
  ExpressionScratch scratch;
  EXPECT_EQ(e.value(s.p.motion, scratch), 4.5);
  EXPECT_FALSE(e.has_switches());
}

}  // namespace
}  // namespace dynalin::mechanics_test::bound_expression_test
