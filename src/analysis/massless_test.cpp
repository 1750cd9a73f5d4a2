// Freedoms without mass: which they are, and the limit of vanishing mass in closed form.
#include "analysis/massless.h"

#include <gmock/gmock.h>

#include "analysis/acceleration_equations.h"
#include "analysis/massless_runaway.h"
#include "system/model_test_support.h"

namespace dynalin::analysis_test::massless_test {
namespace {

using system_test::system_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Parts on a line along z: PART/2 without mass at z = 1, PART/3 of mass 3 at z = 2.
const std::string line =
    "PART/2, QG=0,0,1\nMARKER/20\nJOINT/2, TRANSLATIONAL, I=20, J=1\n"
    "PART/3, MASS=3, CM=30, IP=1,1,1, QG=0,0,2\nMARKER/30\nJOINT/3, TRANSLATIONAL, I=30, J=1\n";
std::string link(int id, int i, int j, const std::string& k, const std::string& c, double length = 1) {
  return "SPRINGDAMPER/" + std::to_string(id) + ", TRANSLATIONAL, I=" + std::to_string(i) + ", J=" + std::to_string(j) +
         ", K=" + k + ", C=" + c + ", LENGTH=" + std::to_string(length) + "\n";
}

struct Limit {
  std::shared_ptr<const System> system;
  OperatingPoint op = system->drawn();
  ConstraintRows rows;
  Equations eq;
  Partition part;

  explicit Limit(const std::string& text) : system(system_of(text)) {
    rows.resize(system->layout());
    eq.resize(system->layout());
    const Motion m = system->motion(op);
    system->constraints(m, rows);
    eq.keep_sizes();
    system->equations(m, rows, eq,
                      {PartialBy::position, PartialBy::velocity, PartialBy::damping, PartialBy::acceleration,
                       PartialBy::lambda, PartialBy::algebraic, PartialBy::state, PartialBy::state_rate});
    part = system->partition(rows, RowLevel::velocity);
  }
  MasslessDirections directions() const { return massless_directions(*system, system->motion(op), rows, part.active); }
  Result<std::optional<MasslessLimit>> limit(bool without_damping = false) const {
    const std::vector<bool> none;
    return massless_limit(*system, system->motion(op), rows, eq, {part.active, none, without_damping});
  }
};

TEST(Massless, mass_is_lacking_where_a_mass_or_a_principal_inertia_is_zero) {
  const auto lacks = [](const std::string& text) { return lacks_mass(*system_of(text)); };
  EXPECT_FALSE(lacks("PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"));
  EXPECT_FALSE(lacks("PART/2, MASS=1E-20, CM=20, IP=1E-20,1E-20,1E-25\nMARKER/20\n"));  // small is not zero
  EXPECT_TRUE(lacks("PART/2\nMARKER/20\n"));
  EXPECT_TRUE(lacks("PART/2, MASS=1, CM=20, IP=1,1,0\nMARKER/20\n"));
  // An axis without inertia that is none of the axes of the data: Ixx = Iyy = 1, Ixy = −1 … leaves (1, ±1, 0)
  EXPECT_TRUE(lacks("PART/2, MASS=1, CM=20, IP=1,1,2,1,0,0\nMARKER/20\n"));
  EXPECT_FALSE(lacks("POINT_MASS/2, MASS=1, CM=20\nMARKER/20, POINT_MASS=2\n"));
  EXPECT_TRUE(lacks("POINT_MASS/2, MASS=0\nMARKER/20, POINT_MASS=2\n"));
}

TEST(Massless, directions_are_what_constraints_leave_open_of_what_has_no_mass) {
  const Limit l(line + link(1, 20, 1, "5", "0") + link(2, 30, 20, "7", "0"));
  const MasslessDirections d = l.directions();
  ASSERT_EQ(d.count(), 1);
  EXPECT_EQ(l.system->layout().coordinate_text(d.coordinate[0]), "DZ of PART/2");
  for (Eigen::Index k = 0; k < 12; ++k) EXPECT_NEAR(d.basis(k, 0), k == 2 ? 1 : 0, 1e-15);
}

// A rod without mass from a ball at the origin to a ball at the mass: it turns about itself.
TEST(Massless, a_rod_without_inertia_turns_about_its_own_axis) {
  const Limit l("PART/2, MASS=1, CM=20, IP=1,1,0, QG=1,2,3, REULER=0.4,0.9,0.3\nMARKER/20\n");
  const MasslessDirections d = l.directions();
  ASSERT_EQ(d.count(), 1);
  const Vector axis = l.op.poses[1].R.z;
  const double size = d.basis.col(0).norm();
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(d.basis(static_cast<Eigen::Index>(k), 0), 0, 1e-14);
    EXPECT_NEAR(std::abs(d.basis(static_cast<Eigen::Index>(3 + k), 0)), std::abs(size * axis[k]), 1e-13);
  }
}

TEST(Massless, an_offset_mass_centre_takes_the_origin_along) {
  // No inertia about z: turning about the axis through the mass centre moves the origin by −ω × c.
  const Limit l("PART/2, MASS=1, CM=20, IP=1,1,0\nMARKER/20, QP=0,2,0\n");
  const MasslessDirections d = l.directions();
  ASSERT_EQ(d.count(), 1);
  const double w = d.basis(5, 0);
  ASSERT_NE(w, 0);
  EXPECT_NEAR(d.basis(0, 0) / w, 2, 1e-14);  // −(ω × c)_x = ω c_y
  EXPECT_NEAR(d.basis(1, 0), 0, 1e-14);
}

TEST(Massless, springs_condense_a_point_and_dampers_make_it_of_first_order) {
  const Limit held(line + link(1, 20, 1, "5", "0") + link(2, 30, 20, "7", "0"));
  const auto a = held.limit();
  ASSERT_TRUE(a && *a) << (a ? "" : a.error().message);
  EXPECT_EQ((*a)->condensed(), 1);
  EXPECT_EQ((*a)->damped(), 0);
  EXPECT_NEAR((*a)->stiffness(0, 0), 12, 1e-12);
  EXPECT_NEAR((*a)->on_positions(0, 8), -7, 1e-12);  // of the mass
  EXPECT_EQ(runaway_by_stiffness(*held.system, **a).cols(), 0);

  const Limit damped(line + link(1, 20, 1, "5", "2") + link(2, 30, 20, "7", "3"));
  const auto b = damped.limit();
  ASSERT_TRUE(b && *b);
  EXPECT_EQ((*b)->damped(), 1);
  EXPECT_EQ((*b)->condensed(), 0);
  EXPECT_NEAR((*b)->on_rates(0, 2), 5, 1e-12);
  EXPECT_NEAR((*b)->on_rates(0, 8), -3, 1e-12);
  EXPECT_NEAR((*b)->damped_rows((*b)->on_positions)(0, 2), 12, 1e-12);
  EXPECT_NEAR((*b)->damped_directions()(2, 0), 1, 1e-15);
  EXPECT_EQ(runaway_by_damping(*damped.system, **b).cols(), 0);
  EXPECT_EQ((*damped.limit(true))->condensed(), 1);  // NODAMPIN
}

TEST(Massless, negative_stiffness_and_damping_run_away) {
  const Limit spring(line + link(1, 20, 1, "5", "0") +
                     "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=9*(DZ(20,1)-1)\n");
  const auto a = spring.limit();
  ASSERT_TRUE(a && *a);
  EXPECT_GT(runaway_by_stiffness(*spring.system, **a).cols(), 0);
  const Limit damper(line + link(1, 20, 1, "5", "1") +
                     "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=9*VZ(20,1)\n");
  const auto b = damper.limit();
  ASSERT_TRUE(b && *b);
  EXPECT_GT(runaway_by_damping(*damper.system, **b).cols(), 0);
}

// A point that a force drives by its own displacements or velocities; along z it is held.
std::string driven_point(const std::string& fx, const std::string& fy) {
  return "POINT_MASS/2, MASS=0\nMARKER/20, POINT_MASS=2\nMARKER/11, PART=1, FLOATING\n"
         "VFORCE/1, I=20, JFLOAT=11, RM=1, FX=" +
         fx + "\\FY=" + fy + "\\FZ=-5*DZ(20,1)-VZ(20,1,1)\n";
}

// Of [5 3; −3 5] the eigenvalues 5 ± 3 j are no squares of frequencies; [1 30; 0 1] decays, though not along (1, −1).
TEST(Massless, what_is_not_symmetric_runs_away_by_its_eigenvalues) {
  const Limit flutter(driven_point("-5*DX(20,1)-3*DY(20,1)", "3*DX(20,1)-5*DY(20,1)"));
  const auto a = flutter.limit();
  ASSERT_TRUE(a && *a) << (a ? "" : a.error().message);
  ASSERT_EQ((*a)->condensed(), 2);
  const Eigen::MatrixXd grows = runaway_by_stiffness(*flutter.system, **a);
  ASSERT_GT(grows.cols(), 0);
  EXPECT_EQ(names_of(*flutter.system, (*a)->directions, grows), "DX of POINT_MASS/2, DY of POINT_MASS/2");
  EXPECT_EQ(runaway_by_damping(*flutter.system, **a).cols(), 0);

  const Limit decays(driven_point("-VX(20,1,1)-30*VY(20,1,1)", "-VY(20,1,1)"));
  const auto b = decays.limit();
  ASSERT_TRUE(b && *b) << (b ? "" : b.error().message);
  ASSERT_EQ((*b)->damped(), 3);
  EXPECT_EQ(runaway_by_damping(*decays.system, **b).cols(), 0);
}

TEST(Massless, an_acceleration_that_its_own_force_reads_is_a_mass) {
  for (const char* mass : {"1E-2", "1E-12"}) {
    const auto l = Limit(line + link(1, 20, 1, "5", "0") + link(2, 30, 20, "7", "0") +
                         "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=-" + mass + "*ACCZ(20,1)\n")
                       .limit();
    ASSERT_TRUE(l) << l.error().message;
    EXPECT_FALSE(l->has_value()) << mass;
  }
}

// Left null vectors reach masses by rounding alone where axes are none of the coordinates'.
TEST(Massless, axes_that_stand_askew_bring_no_mass) {
  for (const char* axes : {"2,1,0.5", "0.3,0.5,0.7", "-1.1,0.4,2.2", "1.76,1.9317,-0.0898"}) {
    for (const char* joint : {"REVOLUTE", "CYLINDRICAL"}) {
      const std::string of = std::string(", REULER=") + axes + "\n";
      const auto l = Limit("MARKER/12, PART=1" + of + "PART/2, MASS=3, CM=20, IP=0.2,0.3,0.25\nMARKER/20\nMARKER/22" +
                           of + "PART/6\nMARKER/62" + of + "JOINT/1, " + joint + ", I=62, J=22\n" +
                           "BUSHING/1, I=62, J=12, K=50,60,70, KT=5,6,7\n")
                         .limit();
      ASSERT_TRUE(l) << l.error().message;
      EXPECT_TRUE(l->has_value()) << axes << " " << joint;
    }
  }
}

TEST(Massless, two_points_that_one_damper_joins_are_one_of_each_kind) {
  const Limit l(line + "PART/4, QG=0,0,3\nMARKER/40\nJOINT/4, TRANSLATIONAL, I=40, J=1\n" + link(1, 20, 1, "5", "0") +
                link(2, 40, 20, "0", "4", 2) + link(3, 40, 30, "6", "0"));
  const auto a = l.limit();
  ASSERT_TRUE(a && *a) << (a ? "" : a.error().message);
  EXPECT_EQ((*a)->damped(), 1);
  EXPECT_EQ((*a)->condensed(), 1);
  // Moving together they feel both springs.
  const Eigen::MatrixXd both = (*a)->condensed_directions();
  EXPECT_NEAR(both(2, 0), both(14, 0), 1e-13);
  EXPECT_NEAR((*a)->stiffness(0, 0) / (both(2, 0) * both(2, 0)), 11, 1e-12);
}

TEST(Massless, what_neither_stiffness_nor_damping_holds_is_named) {
  const auto l = Limit(line + link(2, 30, 1, "7", "0", 2)).limit();
  ASSERT_FALSE(l);
  EXPECT_THAT(l.error().message, HasSubstr("nothing fixes DZ of PART/2: there is neither mass nor damping"));
}

TEST(Massless, with_mass_everywhere_there_is_no_limit) {
  const auto l = Limit("PART/3, MASS=3, CM=30, IP=1,1,1, QG=0,0,2\nMARKER/30\n").limit();
  ASSERT_TRUE(l);
  EXPECT_FALSE(l->has_value());
}

TEST(Massless, rest_is_balance_without_velocities_whatever_the_freedoms_do) {
  Limit l(line + link(1, 20, 1, "5", "2") + link(2, 30, 20, "7", "3"));
  const MasslessDirections d = l.directions();
  EXPECT_TRUE(at_rest(*l.system, l.op, d));
  OperatingPoint op = l.op;
  op.velocity[2] = 4;  // of the point alone
  EXPECT_TRUE(at_rest(*l.system, op, d));
  op.velocity[8] = 1e-3;
  EXPECT_FALSE(at_rest(*l.system, op, d));
  op = l.op;
  op.poses[2].r.z += 0.1;  // out of balance
  EXPECT_FALSE(at_rest(*l.system, op, d));
  const Limit driven(line + link(1, 20, 1, "5", "2") + link(2, 30, 20, "7", "3") +
                     "SFORCE/1, TRANSLATIONAL, I=30, J=1, ACTIONONLY, FUNCTION=TIME\n");
  EXPECT_FALSE(at_rest(*driven.system, driven.op, driven.directions()));
}

// c₁ v + c₂ (v − v₃) = −k₁ (z − l₁): the spring is stretched by 0.5.
TEST(MasslessBalance, a_damped_point_has_the_velocity_of_balance) {
  const auto system = system_of(line + link(1, 20, 1, "6", "1", 0.5) + link(2, 30, 20, "0", "3"));
  Findings findings;
  const auto op = initial_conditions(*system, findings);
  ASSERT_TRUE(op) << op.error().message;
  EXPECT_NEAR(op->velocity[2], -6 * 0.5 / 4, 1e-12);
  EXPECT_NEAR(op->acceleration[8], 3 * op->velocity[2] / 3, 1e-12);
}

TEST(MasslessBalance, a_condensed_point_must_stand_where_its_forces_balance) {
  const auto solved = [](double length) {
    const auto system = system_of(line + link(1, 20, 1, "6", "0", length) + link(2, 30, 20, "2", "0"));
    Findings findings;
    return initial_conditions(*system, findings);
  };
  EXPECT_TRUE(solved(1));
  const auto off = solved(0.5);
  ASSERT_FALSE(off);
  EXPECT_THAT(off.error().message, HasSubstr("DZ of PART/2 has neither mass nor damping"));
  EXPECT_THAT(off.error().message, HasSubstr("miss by 3"));    // 6 · 0.5
  EXPECT_THAT(off.error().details.at(0), HasSubstr("0.375"));  // 3/(6 + 2)
}

}  // namespace
}  // namespace dynalin::analysis_test::massless_test
