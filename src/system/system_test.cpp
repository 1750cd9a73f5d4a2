// How a System is made of a model: numbers, bindings, problems, and what its references lead to.
#include "system/system.h"

#include <gmock/gmock.h>

#include "expression/expression.h"
#include "mechanics/wrench_source.h"
#include "system/model_test_support.h"
#include "system/signal_table.h"

namespace dynalin::system_test::system_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A part on a hinge and a point mass, listed against the order of their ids.
const std::string bodies =
    "PART/3, MASS=1, CM=30, IP=1,1,1, QG=4,0,0\nMARKER/30\nPOINT_MASS/2, MASS=1, CM=20, QG=0,3,0\n"
    "MARKER/20, POINT_MASS=2\n";
const std::string hinge = "MARKER/31, PART=3\nMARKER/5, PART=1, QP=4,0,0\nJOINT/1, REVOLUTE, I=31, J=5\n";

Atom atom(std::string_view function, std::int32_t id, std::int32_t entry = 0) {
  Atom a;
  a.function = find_atom_function(function);
  a.argument = {id, entry};
  a.argument_count = entry ? 2 : 1;
  return a;
}

// --- numbers and scales ---------------------------------------------------------------------------------------------

TEST(System, coordinates_are_wanted_as_states_by_id_rotations_first) {
  const auto s = system_of(bodies);
  EXPECT_EQ(s->coordinates(), 9u);
  // POINT_MASS/2 before PART/3, whose rotations come before its displacements
  EXPECT_THAT(s->preference(), ElementsAre(6, 7, 8, 3, 4, 5, 0, 1, 2));
}

TEST(System, displacements_compare_with_rotations_by_the_length_of_the_model) {
  const auto s = system_of(bodies);
  EXPECT_DOUBLE_EQ(s->length(), 5);  // between the markers at (4, 0, 0) and (0, 3, 0)
  EXPECT_DOUBLE_EQ(s->coordinate_scale(0), 5);
  EXPECT_DOUBLE_EQ(s->coordinate_scale(3), 1);
  EXPECT_DOUBLE_EQ(s->coordinate_scale(8), 5);
}

TEST(System, a_few_markers_far_out_are_no_length_of_the_model) {
  const auto length = [](const std::string& far) {
    return system_of(bodies + "MARKER/99, PART=1, QP=0,0," + far + "\nBUSHING/9, I=30, J=99, K=1,1,1\n")->length();
  };
  EXPECT_DOUBLE_EQ(length("400"), std::hypot(400.0, 4.0));
  EXPECT_LT(length("1E20"), 1e6);
  EXPECT_DOUBLE_EQ(length("1E20"), length("1E19"));
  // Nor is one at which nothing acts.
  EXPECT_DOUBLE_EQ(system_of(bodies + "MARKER/99, PART=1, QP=0,0,400\n")->length(), 5);
  // Those that stand at one place but for rounding are no length either.
  EXPECT_DOUBLE_EQ(system_of("PART/2, MASS=1, CM=20, IP=1,1,1, REULER=0,0.5,0\nMARKER/20, QP=0,0,-1\n"
                             "MARKER/21, QP=1.2E-16,0,0\nMARKER/22, QP=0,-3E-15,0\nMARKER/23\nMARKER/24\n")
                       ->length(),
                   1);
  // Where all do, and a body is thirty times as large: √(trace of inertia / mass).
  for (const char* off : {"0", "6E-17"}) {
    EXPECT_DOUBLE_EQ(
        system_of(std::string("PART/2, MASS=4, CM=20, IP=1200,1200,1200\nMARKER/20\nMARKER/21, PART=1, QP=") + off +
                  ",0,0\n")
            ->length(),
        30);
  }
}

TEST(System, a_curve_says_how_long_a_model_is_whose_markers_stand_at_one_place_of_it) {
  const auto length = [](const char* off) {
    return system_of(std::string("MARKER/9, FLOATING\nMATRIX/1, FULL=RORDER, ROWS=4, COLUMNS=3\n"
                                 ", VALUES=0,0,0, 10,0,0, 20,0,0, 30,0,0\nCURVE/1, OPEN, MATRIX=1, CURVE_POINTS\n"
                                 "POINT_MASS/2, MASS=3, CM=2, QG=") +
                     off + ",0,0\nMARKER/2\nPTCV/1, I=2, JFLOAT=9, CURVE=1, RM=1\n")
        ->length();
  };
  EXPECT_NEAR(length("1E-12"), 30, 1e-12);
  EXPECT_DOUBLE_EQ(length("1E-3"), 1e-3);
}

TEST(System, a_partition_leaves_the_wanted_coordinate_and_names_redundant_rows) {
  const auto one = system_of(bodies + hinge);
  ConstraintRows rows;
  rows.resize(one->layout());
  one->constraints(one->motion(one->drawn()), rows);
  const Partition p = one->partition(rows, RowLevel::position);
  EXPECT_THAT(p.independent, ElementsAre(6, 7, 8, 5));
  EXPECT_THAT(p.redundant, IsEmpty());
  EXPECT_THAT(p.active, ElementsAre(true, true, true, true, true));

  const auto two = system_of(bodies + hinge + "JOINT/2, SPHERICAL, I=31, J=5\n");
  rows.resize(two->layout());
  two->constraints(two->motion(two->drawn()), rows);
  const Partition q = two->partition(rows, RowLevel::position);
  EXPECT_THAT(q.independent, ElementsAre(6, 7, 8, 5));
  EXPECT_EQ(q.redundant.size(), 3u);
}

TEST(System, the_drawn_point_has_poses_and_starts_of_the_dataset_and_stands_still) {
  const auto s =
      system_of(bodies + "DIFF/1, IMPLICIT, IC=0.5,0.25, FUNCTION=DIF1(1)+DIF(1)-0.75\nVARIABLE/1, IC=3, FUNCTION=3\n");
  const OperatingPoint op = s->drawn();
  EXPECT_EQ(op.poses[1].r.x, 4);
  EXPECT_EQ(op.poses[2].r.y, 3);
  EXPECT_THAT(op.velocity, ::testing::Each(0.0));
  EXPECT_THAT(op.state, ElementsAre(0.5));
  EXPECT_THAT(op.state_rate, ElementsAre(0.25));
  EXPECT_THAT(op.algebraic, ElementsAre(3));
}

TEST(System, a_motion_takes_velocities_and_accelerations_from_their_coordinates) {
  const auto s = system_of(bodies);
  OperatingPoint op = s->drawn();
  for (std::size_t k = 0; k < 9; ++k)
    op.velocity[k] = 1.0 + static_cast<double>(k), op.acceleration[k] = 10 * op.velocity[k];
  const Motion m = s->motion(op);
  EXPECT_EQ(m.bodies[1].rdot.y, 2);
  EXPECT_EQ(m.bodies[1].w.z, 6);
  EXPECT_EQ(m.bodies[1].rddot.x, 10);
  EXPECT_EQ(m.bodies[1].wdot.y, 50);
  EXPECT_EQ(m.bodies[2].rdot.z, 9);
  EXPECT_EQ(m.bodies[2].rddot.x, 70);
  EXPECT_EQ(norm(m.bodies[2].w), 0);
}

TEST(System, rows_and_starts_are_named_by_element) {
  const auto s = system_of(
      bodies + "MARKER/31, PART=3\nMARKER/5, PART=1, QP=4,0,0\nJOINT/7, TRANSLATIONAL, I=31, J=5, IC=0.2,0\n");
  EXPECT_THAT(s->row_text(0), HasSubstr("JOINT/7"));
  ASSERT_EQ(s->starts().size(), 1u);
  const auto beyond = static_cast<std::int32_t>(s->layout().row_count());
  EXPECT_THAT(s->row_text(beyond), HasSubstr("the initial"));
  EXPECT_THAT(s->row_text(beyond), HasSubstr("JOINT/7"));
}

// Reactions stand in the balance as −λ times the gradient of their row.
TEST(System, residuals_hold_reactions) {
  const auto s = system_of(bodies + hinge);
  OperatingPoint op = s->drawn();
  Equations eq;
  eq.resize(s->layout());
  ConstraintRows rows;
  rows.resize(s->layout());
  const auto residual = [&] {
    const Motion m = s->motion(op);
    s->constraints(m, rows);
    s->equations(m, rows, eq, {});
    return std::vector<double>(eq.residual().begin(), eq.residual().end());
  };
  const std::vector<double> without = residual();
  op.lambda[1] = 2.5;
  const std::vector<double> with = residual();
  for (const auto& e : rows.row(1))
    EXPECT_DOUBLE_EQ(with[static_cast<std::size_t>(e.column)] - without[static_cast<std::size_t>(e.column)],
                     -2.5 * e.c.g);
}

// --- problems -------------------------------------------------------------------------------------------------------

TEST(System, problems_of_all_expressions_come_back_once_and_there_is_no_system) {
  EXPECT_THAT(problems_of("ARRAY/1, IC, SIZE=2, NUMBERS=1,2\nVARIABLE/1, FUNCTION=ARYVAL(1,5)\n"
                          "VARIABLE/2, FUNCTION=ARYVAL(1,7)+ARYVAL(1,2)\n"),
              ElementsAre("unfilled-entry 6", "unfilled-entry 7"));
  EXPECT_THAT(problems_of("VARIABLE/1, FUNCTION=2\n"), IsEmpty());
}

TEST(System, a_rate_that_is_asked_for_twice_is_made_or_refused_once) {
  const std::string reads =
      "DIFF/1, IMPLICIT, FUNCTION=VARVAL(1)-DIF(1)\nVARIABLE/1, FUNCTION=ACCX(30,1)\n"
      "VARIABLE/2, FUNCTION=DELAY(VARVAL(1),0.1,0)+DELAY(VARVAL(1),0.2,0)\n";
  EXPECT_THAT(problems_of(bodies + reads), ElementsAre("unknown-rate 10"));
}

// --- rates and delays -----------------------------------------------------------------------------------------------

TEST(SystemBinder, the_rate_of_a_variable_is_one_unknown_however_many_read_it) {
  const auto s = system_of(bodies +
                           "VARIABLE/1, FUNCTION=DX(30,1)**2\n"
                           "VARIABLE/2, FUNCTION=DELAY(VARVAL(1),0.1,0)+DELAY(VARVAL(1)*2,0.2,0)\n");
  const Layout& l = s->layout();
  ASSERT_EQ(l.algebraic.size(), 5u);  // two variables, two delays, one rate
  std::vector<std::int32_t> rates;
  for (const AlgebraicUnknown& a : l.algebraic) {
    if (a.rate >= 0) rates.push_back(a.rate);
  }
  ASSERT_EQ(rates.size(), 1u);
  EXPECT_EQ(l.algebraic[0].rate, rates[0]);
  EXPECT_EQ(l.algebraic[static_cast<std::size_t>(rates[0])].owner->id, 1);
}

TEST(SystemBinder, rates_of_rates_get_their_equations_too) {
  const auto s = system_of(bodies +
                           "VARIABLE/1, FUNCTION=DX(30,1)**2\nVARIABLE/2, FUNCTION=3*VARVAL(1)\n"
                           "VARIABLE/3, FUNCTION=DELAY(VARVAL(2),0.1,0)\n");
  const Layout& l = s->layout();
  ASSERT_EQ(l.algebraic.size(), 6u);
  const std::int32_t first = l.algebraic[0].rate, second = l.algebraic[1].rate;
  ASSERT_GE(first, 0);
  ASSERT_GE(second, 0);
  // w₂′ = 3 w₁′ and w₁′ = 2 x x′ at x = 4, x′ = 0.5
  OperatingPoint op = s->drawn();
  op.velocity[0] = 0.5;
  op.algebraic[static_cast<std::size_t>(first)] = 4;
  op.algebraic[static_cast<std::size_t>(second)] = 12;
  Equations eq;
  eq.resize(l);
  ConstraintRows rows;
  rows.resize(l);
  const Motion m = s->motion(op);
  s->constraints(m, rows);
  s->equations(m, rows, eq, {});
  EXPECT_NEAR(eq.residual()[static_cast<std::size_t>(eq.algebraic_row(first))], 0, 1e-14);
  EXPECT_NEAR(eq.residual()[static_cast<std::size_t>(eq.algebraic_row(second))], 0, 1e-14);
}

TEST(SystemBinder, delays_are_called_by_their_order_and_the_statement_they_stand_in) {
  const std::string text = "VARIABLE/4, FUNCTION=DELAY(DIF(1),0.1,0)\nDIFF/1, FUNCTION=-DIF(1)+DELAY(TIME,0.2,0)\n";
  const auto s = system_of(text);
  std::vector<std::string> labels;
  for (const AlgebraicUnknown& a : s->layout().algebraic) labels.push_back(a.owner->full_text());
  EXPECT_THAT(labels,
              ::testing::UnorderedElementsAre("VARIABLE/4", HasSubstr("(in VARIABLE/4)"), HasSubstr("(in DIFF/1)")));
  EXPECT_EQ(s->layout().states.size(), 1u);
  const auto pade = system_of(text, {DelayReading::pade, {}});
  EXPECT_EQ(pade->layout().states.size(), 3u);
}

// --- signals --------------------------------------------------------------------------------------------------------

const std::string signals_text =
    bodies +
    "VARIABLE/1, FUNCTION=2\nVARIABLE/2, FUNCTION=VARVAL(1)\nDIFF/7, FUNCTION=-DIF(7)\n"
    "ARRAY/1, IC, SIZE=3, NUMBERS=4,5,6\nARRAY/2, U, VARIABLES=2,1\nARRAY/3, X\nARRAY/4, Y\n"
    "MATRIX/1, FULL, RORDER, ROWS=2, COLUMNS=2, VALUES=-1,0,0,-2\nMATRIX/2, FULL, RORDER, ROWS=2, COLUMNS=2, "
    "VALUES=1,0,0,1\n"
    "MATRIX/3, FULL, RORDER, ROWS=1, COLUMNS=2, VALUES=1,1\n"
    "LSE/1, X=3, A=1, U=2, B=2, Y=4, C=3\nPINPUT/1, VARIABLES=2,1\n"
    "MARKER/9, PART=1, FLOATING\nMARKER/8, PART=1, FLOATING\n"
    "VFORCE/1, I=30, JFLOAT=9, RM=1, FX=1\\, FY=0\\, FZ=0\n"
    "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=30, K=1, C=0, LENGTH=1\n";

TEST(SignalTable, channels_lead_to_values_states_rates_and_constants) {
  const auto s = system_of(signals_text);
  const Signals& t = s->signals();
  const Layout& l = s->layout();
  const auto owner_of_value = [&](const Channel& c) {
    EXPECT_EQ(c.kind, Channel::Kind::algebraic);
    return l.algebraic[static_cast<std::size_t>(c.index)].owner->id;
  };
  EXPECT_EQ(owner_of_value(t.data(atom("VARVAL", 1))), 1);
  EXPECT_EQ(owner_of_value(t.data(atom("VARVAL", 2))), 2);
  EXPECT_EQ(owner_of_value(t.data(atom("PINVAL", 1, 1))), 2);
  EXPECT_EQ(owner_of_value(t.data(atom("PINVAL", 1, 2))), 1);
  EXPECT_EQ(t.data(atom("PINVAL", 1, 3)).kind, Channel::Kind::none);
  EXPECT_EQ(owner_of_value(t.data(atom("ARYVAL", 2, 1))), 2);
  const Channel number = t.data(atom("ARYVAL", 1, 3));
  EXPECT_EQ(number.kind, Channel::Kind::constant);
  EXPECT_EQ(number.constant, 6);
  EXPECT_EQ(t.data(atom("ARYVAL", 1, 4)).kind, Channel::Kind::none);
  const Channel state = t.data(atom("DIF", 7));
  EXPECT_EQ(state.kind, Channel::Kind::state);
  EXPECT_EQ(l.states[static_cast<std::size_t>(state.index)].owner->statement, "DIFF");
  const Channel second = t.data(atom("ARYVAL", 3, 2));
  EXPECT_EQ(second.kind, Channel::Kind::state);
  EXPECT_EQ(l.states[static_cast<std::size_t>(second.index)].coordinate, 2);
  EXPECT_EQ(t.data(atom("ARYVAL", 4, 1)).kind, Channel::Kind::algebraic);
  EXPECT_EQ(t.data(atom("VARVAL", 99)).kind, Channel::Kind::none);
}

TEST(SignalTable, markers_know_where_they_are_and_what_acts_on_them) {
  const auto s = system_of(signals_text);
  const Signals& t = s->signals();
  const Model& model = s->model();
  const auto id = [&](MarkerId m) { return model.marker(m).label->id; };
  EXPECT_EQ(id(t.marker(30)), 30);
  EXPECT_EQ(t.marker(0), global_frame);
  EXPECT_EQ(id(t.place_of(t.marker(9))), 30);  // the floating marker of the force is at its I
  EXPECT_EQ(id(t.place_of(t.marker(20))), 20);
  EXPECT_TRUE(t.has_place(t.marker(9)));
  EXPECT_FALSE(t.has_place(t.marker(8)));
  ASSERT_EQ(t.wrenches_at(t.marker(30)).size(), 2u);
  ASSERT_EQ(t.wrenches_at(t.marker(20)).size(), 1u);
  EXPECT_TRUE(t.wrenches_at(t.marker(1)).empty());
  const Signals::Wrench spring = t.wrench("SPRINGDAMPER", 1);
  ASSERT_TRUE(spring.source);
  EXPECT_EQ(spring.source, t.wrenches_at(t.marker(20))[0].source);
  EXPECT_EQ(id(spring.source->marker_J(spring.which)), 30);
  EXPECT_EQ(t.wrench("SPRINGDAMPER", 2).source, nullptr);
}

// --- switches -------------------------------------------------------------------------------------------------------

std::vector<double> switches_of(const System& s, const OperatingPoint& op) {
  ExpressionScratch scratch;
  SwitchList list;
  s.switches(s.motion(op), scratch, list);
  EXPECT_EQ(list.value.size(), list.counts.size());
  return list.value;
}

// Whatever element an expression stands in; those that rates are made of count once.
TEST(System, switches_of_all_expressions_are_known) {
  const auto s = system_of(bodies + hinge +
                           "MOTION/1, JOINT=1, ROTATION, FUNCTION=STEP(TIME,1,0,2,1)\nMARKER/32, PART=3\n"
                           "SFORCE/1, TRANSLATION, I=20, J=1, FUNCTION=ABS(TIME-3)\nMARKER/33, PART=1, FLOATING\n"
                           "VFORCE/1, I=20, JFLOAT=33, RM=1, FX=MAX(TIME,4)\\FY=0\\FZ=MIN(TIME,5)\n"
                           "GCON/1, FUNCTION=DX(20,1)-STEP5(TIME,6,0,7,1)\n"
                           "VARIABLE/1, FUNCTION=IF(TIME-8:0,0,1)\nVARIABLE/2, FUNCTION=SIN(VARVAL(1))\n"
                           "DIFF/1, IMPLICIT, IC=0, FUNCTION=DIM(TIME,9)-DIF(1)\nDIFF/2, FUNCTION=DIF1(1)\n");
  OperatingPoint op = s->drawn();
  op.time = 100;
  EXPECT_THAT(switches_of(*s, op), ::testing::UnorderedElementsAre(99, 98, 97, 96, 95, 94, 93, 92, 91));
  op.time = -1;
  EXPECT_EQ(switches_of(*s, op).size(), 9u);
  // Those of elements that a command has taken out of the model are none.
  EXPECT_THAT(switches_of(*system_of(bodies), op), IsEmpty());
}

TEST(System, a_contact_switches_at_the_corners_of_its_curve) {
  const auto s = system_of(
      bodies +
      "MARKER/9, PART=1, FLOATING\nMATRIX/1, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=0,0,0,4,0,0,8,3,0,12,3,0\n"
      "CURVE/1, OPEN, MATRIX=1, ORDER=2\nPTCV/1, I=20, JFLOAT=9, CURVE=1, RM=1\n");
  OperatingPoint op = s->drawn();
  const auto at = [&](double u) {
    op.extra[0] = u;
    return switches_of(*s, op);
  };
  for (const double corner : {-1.0 / 3, 1.0 / 3}) {
    ASSERT_EQ(at(corner - 0.01).size(), 1u);
    EXPECT_LT(at(corner - 0.01)[0] * at(corner + 0.01)[0], 0);
  }
  EXPECT_GT(at(0.4)[0] * at(1.4)[0], 0);
}

}  // namespace
}  // namespace dynalin::system_test::system_test
