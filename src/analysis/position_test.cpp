// Assembly of positions: the least change, in closed form.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>

#include "analysis/initial.h"
#include "system/carried_turns.h"
#include "system/model_test_support.h"
#include "system/operating_state.h"

namespace dynalin::analysis_test::position_test {
namespace {

using system_test::system_of;
using ::testing::HasSubstr;

Result<OperatingPoint> assembled(const System& s, const Restated& starts = {}) {
  Findings findings;
  return assemble_position(s, s.drawn(), findings, starts);
}
Result<OperatingPoint> assembled(const std::string& text, const Restated& starts = {}) {
  return assembled(*system_of(text), starts);
}
const std::string point = "POINT_MASS/2, MASS=1, CM=20, QG=3,4,0\nMARKER/20, POINT_MASS=2\n";

TEST(Position, a_point_goes_to_the_nearest_place_on_a_sphere) {
  const auto op = assembled(point + "GCON/1, FUNCTION=DM(20,1)-2\n");
  ASSERT_TRUE(op) << op.error().message;
  EXPECT_NEAR(op->poses[1].r.x, 1.2, 1e-12);
  EXPECT_NEAR(op->poses[1].r.y, 1.6, 1e-12);
  EXPECT_EQ(op->poses[1].r.z, 0);
}

TEST(Position, two_points_share_the_change_of_what_joins_them) {
  const auto op = assembled(point +
                            "POINT_MASS/3, MASS=7, CM=30, QG=3,10,0\nMARKER/30, POINT_MASS=3\n"
                            "GCON/1, FUNCTION=DM(20,30)-4\n");
  ASSERT_TRUE(op) << op.error().message;
  EXPECT_NEAR(op->poses[1].r.y, 5, 1e-12);  // whatever their masses
  EXPECT_NEAR(op->poses[2].r.y, 9, 1e-12);
}

// y + a θ = c with the least (y/L)² + θ²: y = c L²/(L² + a²), θ = c a/(L² + a²).
TEST(Position, displacements_and_rotations_change_in_proportion_to_the_length_of_the_model) {
  const double a = 3, L = 8, c = 1e-5;
  const auto op = assembled(
      "MARKER/2, QP=0,0,8\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, QP=3,0,0\n"
      "GCON/1, FUNCTION=DY(21,1)-1E-5\n");
  ASSERT_TRUE(op) << op.error().message;
  // The longest distance between markers is from (3, 0, 0) to (0, 0, 8).
  const double L2 = L * L + a * a;
  EXPECT_NEAR(op->poses[1].r.y, c * L2 / (L2 + a * a), 1e-10);
  EXPECT_NEAR(op->poses[1].R(1, 0), c * a / (L2 + a * a), 1e-10);
}

TEST(Position, coordinates_named_by_exact_stay_while_others_can_move) {
  const std::string text = "PART/2, MASS=1, CM=20, IP=1,1,1, QG=2,2,0";
  const std::string rest = "\nMARKER/20\nGCON/1, FUNCTION=DX(20,1)+DY(20,1)-1\n";
  const auto free = assembled(text + rest), kept = assembled(text + ", EXACT=X" + rest),
             both = assembled(text + ", EXACT=X:Y" + rest);
  ASSERT_TRUE(free && kept && both);
  EXPECT_NEAR(free->poses[1].r.x, 0.5, 1e-12);
  EXPECT_NEAR(kept->poses[1].r.x, 2, 1e-6);
  EXPECT_NEAR(kept->poses[1].r.y, -1, 1e-6);
  EXPECT_NEAR(both->poses[1].r.x, 0.5, 1e-12);  // neither can be kept
}

// None of ψ, θ and φ is a turn about an axis of the ground: where two of them are kept the third alone moves.
TEST(Position, angles_named_by_exact_stay_while_others_can_change) {
  const Triple drawn{0.4, 1.2, -0.7};
  const std::array<const char*, 3> kept = {"THETA:PHI", "PSI:PHI", "PSI:THETA"};
  for (std::size_t moved = 0; moved < 3; ++moved) {
    const auto op = assembled(std::string("PART/2, MASS=1, CM=20, IP=1,1,1, REULER=0.4,1.2,-0.7, EXACT=") +
                              kept[moved] + "\nMARKER/20\nGCON/1, FUNCTION=PSI(20,1)+THETA(20,1)+PHI(20,1)-1\n");
    ASSERT_TRUE(op) << op.error().message;
    const Triple found = angles_313(op->poses[1].R);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(found[k], drawn[k] + (k == moved ? 0.1 : 0.0), 1e-3 * 0.1) << kept[moved] << ", angle " << k;
  }
}

TEST(Position, a_point_that_fits_comes_back_untouched) {
  const auto system = system_of(
      "POINT_MASS/2, MASS=1, CM=20, QG=0.1,0.7,0\nMARKER/20, POINT_MASS=2\n"
      "GCON/1, FUNCTION=DX(20,1)-0.1\n");
  const auto op = assembled(*system);
  ASSERT_TRUE(op);
  EXPECT_EQ(op->poses[1].r.x, 0.1);
  EXPECT_EQ(op->poses[1].r.y, 0.7);
}

TEST(Position, conditions_of_the_start_hold_only_where_they_are_asked_for) {
  const std::string slide =
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,2\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1, IC=0.5,0\n";
  const auto ignored = assembled(slide), held = assembled(slide, Restated::all());
  ASSERT_TRUE(ignored && held);
  EXPECT_EQ(ignored->poses[1].r.z, 2);
  EXPECT_NEAR(held->poses[1].r.z, 0.5, 1e-12);
  Restated stated, of_another;
  stated.state({"JOINT", 1}, "IC"), of_another.state({"JOINT", 2}, "IC");
  EXPECT_NEAR(assembled(slide, stated)->poses[1].r.z, 0.5, 1e-12);
  EXPECT_EQ(assembled(slide, of_another)->poses[1].r.z, 2);
}

TEST(Position, rows_that_contradict_each_other_are_named) {
  const auto op = assembled(point + "GCON/1, FUNCTION=DX(20,1)-1\nGCON/2, FUNCTION=2*DX(20,1)-3\n");
  ASSERT_FALSE(op);
  EXPECT_THAT(op.error().message, HasSubstr("contradict"));
  EXPECT_THAT(op.error().message, HasSubstr("GCON/"));
}

TEST(Position, redundant_rows_may_differ_by_the_error_of_ic_and_no_more) {
  const auto system = system_of(point + "GCON/1, FUNCTION=DX(20,1)-1\nGCON/2, FUNCTION=DX(20,1)-1.0000001\n");
  Findings findings;
  OperatingPoint op = system->drawn();
  op.redundancy_tolerance = 1e-6;
  EXPECT_TRUE(assemble_position(*system, op, findings));
  op.redundancy_tolerance = 1e-9;
  EXPECT_FALSE(assemble_position(*system, op, findings));
}

// From (3, 4, 0) to DX = 1: a way of 2, and one iteration where nothing bounds it.
TEST(Position, steps_and_iterations_are_as_ic_bounds_them) {
  const std::string moved = point + "GCON/1, FUNCTION=DX(20,1)-1\n";
  EXPECT_TRUE(assembled(moved + "IC/MAXIT=1\n"));
  EXPECT_TRUE(assembled(moved + "IC/MAXIT=4, TLIMIT=0.5\n"));
  const auto short_of_it = assembled(moved + "IC/MAXIT=3, TLIMIT=0.5\n");
  ASSERT_FALSE(short_of_it);
  EXPECT_THAT(short_of_it.error().details, ::testing::Contains("IC allows 3 iterations (MAXIT)"));
  EXPECT_THAT(short_of_it.error().message, HasSubstr("violated by 1.000e-01"));

  // A quarter turn about z in steps of 30 degrees.
  const std::string turned =
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\nMOTION/1, JOINT=1, FUNCTION=PI/2\n";
  EXPECT_TRUE(assembled(turned + "IC/MAXIT=4, ALIMIT=30D\n"));
  EXPECT_FALSE(assembled(turned + "IC/MAXIT=2, ALIMIT=30D\n"));
}

// Two wheels, the second `by` times as far as the first. What it turns the pose at the end does not tell.
TEST(Position, turns_are_counted_from_one_iteration_to_the_next) {
  const std::string wheels =
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n"
      "MARKER/3, PART=1, QP=3,0,0\nPART/3, MASS=1, CM=30, IP=1,1,1, QG=3,0,0\nMARKER/30\n"
      "JOINT/3, REVOLUTE, I=30, J=3\nVARIABLE/1, FUNCTION=AZ(20,1)+AZ(30,3)\n";
  const auto coupled = [](double by) { return fmt::format("COUPLER/1, JOINTS=1,3, SCALES={},-1\n", by); };
  const std::string gear = "MARKER/8, PART=1, QP=2,0,0, REULER=180D,90D,0\nGEAR/1, JOINTS=1,3, CV=8\n";
  struct Case {
    double turned, by;
    std::string relation, more = "";
  };
  for (const Case& c :
       {Case{80, 2, coupled(2)}, Case{100, 2, coupled(2)}, Case{-100, 2, coupled(2)}, Case{100, -5, coupled(-5)},
        Case{170, 1 / 0.3, coupled(1 / 0.3)}, Case{80, -2, gear}, Case{100, -2, gear}, Case{170, -2, gear},
        Case{100, 400, coupled(400)}, Case{100, 3, coupled(3), "IC/ALIMIT=10D, MAXIT=100\n"},
        Case{100, 3, coupled(3), "IC/ALIMIT=400D\n"}, Case{100, 2, "COUPLER/1, JOINTS=1,3, SCALES=1,-0.5\n"}}) {
    const auto system =
        system_of(wheels + c.relation + c.more + fmt::format("MOTION/1, JOINT=1, FUNCTION={}D\n", c.turned));
    const auto op = assembled(*system);
    ASSERT_TRUE(op) << c.relation << c.turned << op.error().message;
    const KnownTurns turns = known_turns(*system, *op);
    const double first = c.turned * std::numbers::pi / 180;
    for (const auto& [name, total] : turns) EXPECT_NEAR(total, name.i == 20 ? first : c.by * first, 1e-9) << c.relation;
    EXPECT_EQ(turns.size(), 2u);
  }
}

// Axes far from parallel: on the way to where a lock holds the angle between them runs through more than half a turn.
// No row asks for it, and the spring that reads it finds it next to where it was drawn.
TEST(Position, turns_on_a_way_on_which_nothing_holds_do_not_count) {
  const std::string parts =
      "PART/2, MASS=1, CM=20, IP=1,1,1, REULER=-0.2,1.0,2.5\nMARKER/20\nMARKER/13, PART=2, REULER=1.8,1.9,-2.1\n"
      "MARKER/70, PART=2, REULER=1.2,0.8,2.6\nPART/3, MASS=1, CM=30, IP=1,1,1, REULER=-3.0,-2.0,2.9\nMARKER/30\n"
      "MARKER/17, PART=3, REULER=-0.8,1.2,0.6\nMARKER/71, PART=3, REULER=-0.6,-0.4,0.4\n"
      "VARIABLE/1, FUNCTION=AZ(13,17)\n";
  const auto turned = [](const std::string& text) {
    const auto system = system_of(text);
    const auto op = assembled(*system);
    EXPECT_TRUE(op);
    const KnownTurns turns = op ? known_turns(*system, *op) : KnownTurns();
    EXPECT_EQ(turns.size(), 1u);
    return turns.empty() ? 0.0 : turns.begin()->second;
  };
  EXPECT_LE(std::abs(turned(parts + "JPRIM/1, ORIENTATION, I=71, J=70\n") - turned(parts)), std::numbers::pi);
}

TEST(Position, what_cannot_be_reached_is_named_with_its_violation) {
  const auto op = assembled(point + "GCON/5, FUNCTION=DX(20,1)**2+DY(20,1)**2+1\n");
  ASSERT_FALSE(op);
  EXPECT_THAT(op.error().message, HasSubstr("GCON/5"));
}

TEST(Position, a_row_without_a_value_is_named) {
  const auto op = assembled(point + "GCON/5, FUNCTION=SQRT(DX(20,1)-9)\n");
  ASSERT_FALSE(op);
  EXPECT_THAT(op.error().message, HasSubstr("GCON/5"));
  EXPECT_THAT(op.error().message, HasSubstr("SQRT of -6"));
}

TEST(Position, a_violation_is_measured_in_the_scale_of_its_row) {
  const auto system = system_of(point +
                                "MARKER/2, QP=0,0,10\nGCON/1, FUNCTION=100*(DX(20,1)-2)\n"
                                "GCON/2, FUNCTION=1E-3*(DY(20,1)-1)\n");
  ConstraintRows rows;
  rows.resize(system->layout());
  system->constraints(system->motion(system->drawn()), rows);
  const Violation v = position_violation(*system, rows);
  EXPECT_EQ(v.row, 1);
  EXPECT_NEAR(v.relative, 3 / system->length(), 1e-12);
}

}  // namespace
}  // namespace dynalin::analysis_test::position_test
