#include "analysis/turned_wholes.h"

#include <gtest/gtest.h>

#include "system/model_test_support.h"

namespace dynalin::turned_wholes_test {
namespace {

// Three parts along x that belong together, as nodes of a beam do.
struct Nodes {
  std::shared_ptr<const System> system;
  Layout layout;
  OperatingPoint from, to;
  Eigen::VectorXd step;

  Nodes()
      : system(system_test::system_of("PART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0\nMARKER/20\n"
                                      "PART/3, MASS=1, CM=30, IP=1,1,1, QG=2,0,0\nMARKER/30\n"
                                      "PART/4, MASS=1, CM=40, IP=1,1,1, QG=3,0,0\nMARKER/40\n")),
        layout(system->layout()),
        from(system->drawn()),
        to(from),
        step(Eigen::VectorXd::Zero(layout.coordinate_count)) {
    TurningWhole whole;
    for (std::int32_t b = 1; b <= 3; ++b) whole.bodies.push_back(BodyId{b});
    layout.turning_wholes = {whole};
  }
  const Vector& place(std::size_t b) const { return to.poses[b].r; }
  void move(std::size_t b, const Vector& way, const Vector& turn) {
    const Eigen::Index at = layout.bodies[b].offset;
    for (std::size_t k = 0; k < 3; ++k) {
      step(at + static_cast<Eigen::Index>(k)) = way[k];
      step(at + 3 + static_cast<Eigen::Index>(k)) = turn[k];
    }
  }
  void move_as_one(const Vector& centre, const Vector& way, const Vector& turn) {
    for (std::size_t b = 1; b <= 3; ++b) move(b, way + cross(turn, from.poses[b].r - centre), turn);
    turn_wholes(layout, from, step, to);
  }
};

TEST(TurnedWholes, a_turn_about_a_point_that_stays_is_a_finite_one) {
  Nodes n;
  const double angle = 1.2;
  n.move_as_one({}, {}, {0, 0, angle});
  for (std::size_t b = 1; b <= 3; ++b) {
    const auto r = static_cast<double>(b);
    EXPECT_NEAR(n.place(b).x, r * std::cos(angle), 1e-12);
    EXPECT_NEAR(n.place(b).y, r * std::sin(angle), 1e-12);
    EXPECT_NEAR(n.to.poses[b].R(1, 0), std::sin(angle), 1e-12);
  }
}

TEST(TurnedWholes, a_shift_shifts) {
  Nodes n;
  n.move_as_one({}, {0.5, -2, 7}, {});
  EXPECT_NEAR(n.place(2).x, 2.5, 1e-14);
  EXPECT_NEAR(n.place(2).y, -2, 1e-14);
  EXPECT_NEAR(n.place(2).z, 7, 1e-14);
}

// Pitch: along the axis by what the step says, round it as a circle.
TEST(TurnedWholes, a_screw_goes_along_its_axis) {
  Nodes n;
  n.move_as_one({}, {0, 0, 0.3}, {0, 0, 0.8});
  EXPECT_NEAR(n.place(3).z, 0.3, 1e-13);
  EXPECT_NEAR(n.place(3).x, 3 * std::cos(0.8), 1e-12);
}

// To first order it is the step, whatever it is.
TEST(TurnedWholes, small_steps_are_what_they_are) {
  Nodes n;
  const double small = 1e-6;
  n.move(1, {small, 0, 0}, {0, small, 0});
  n.move(2, {0, -small, 0}, {0, 0, 2 * small});
  n.move(3, {0, 0, small}, {-small, 0, 0});
  turn_wholes(n.layout, n.from, n.step, n.to);
  for (std::size_t b = 1; b <= 3; ++b) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(n.place(b)[k] - n.from.poses[b].r[k],
                  n.step(n.layout.bodies[b].offset + static_cast<Eigen::Index>(k)), 20 * small * small);
    }
    EXPECT_NEAR(n.to.poses[b].R(1, 0), n.step(n.layout.bodies[b].offset + 5), 20 * small * small);
  }
}

TEST(TurnedWholes, what_belongs_to_none_stays_where_the_step_put_it) {
  Nodes n;
  n.layout.turning_wholes[0].bodies.pop_back();
  n.to.poses[3].r = {9, 9, 9};
  n.move_as_one({}, {}, {0, 0, 0.5});
  EXPECT_EQ(n.place(3).x, 9);
}

}  // namespace
}  // namespace dynalin::turned_wholes_test
