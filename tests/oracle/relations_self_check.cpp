// Constraints of the oracle against differences along a path, and relations against closed forms.
#include <string>

#include "self_check.h"

namespace dynalin::oracle::relations_self_check {
namespace {

// The bodies along r + v t + a t^2/2, exp((w t + al t^2/2)^) R, which has these velocities and accelerations at t = 0.
class Path {
 public:
  explicit Path(const Mechanism& m) : model_(m) {
    place(model_, drawn_point(m));
    (void)solve_algebra(model_);
    start_ = model_.motion;
    time_ = model_.time;
  }
  Model& at(Real t) {
    model_.time = time_ + t;
    for (std::size_t b = 1; b < start_.size(); ++b) {
      const BodyMotion& s = start_[b];
      BodyMotion& m = model_.motion[b];
      const Vec turn = t * s.w + (t * t / 2) * s.al;
      m.p = s.p + t * s.v + (t * t / 2) * s.a;
      m.R = rotation_exponential(turn) * s.R;
      m.v = s.v + t * s.a;
      m.w = left_jacobian(turn) * (s.w + t * s.al);
    }
    model_.update_positions();
    model_.update_velocities();
    model_.update_accelerations();
    return model_;
  }

 private:
  Model model_;
  std::vector<BodyMotion> start_;
  Real time_ = 0;
};

// Central difference, extrapolated once.
template <class F>
Real slope(F&& f, Real h) {
  const Real wide = (f(h) - f(-h)) / (2 * h), narrow = (f(h / 2) - f(-h / 2)) / h;
  return narrow + (narrow - wide) / 3;
}

TEST(Oracle, rows_have_the_rates_and_gradients_of_their_positions) {
  int relations = 0, velocity_rows = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Mechanism m = random_mechanism(seed);
    Path path(m);
    const std::vector<Row> rows = path.at(0).rows;
    const Dense G = path.at(0).gradient();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      SCOPED_TRACE("row " + std::to_string(k));
      relations += rows[k].type == Row::Type::expression ? 1 : 0;
      velocity_rows += rows[k].of_rates ? 1 : 0;
      const auto position = [&](Real t) { return path.at(t).row_position(path.at(t).rows[k]); };
      const auto velocity = [&](Real t) { return path.at(t).row_velocity(path.at(t).rows[k]); };
      const double tolerance = 1e-10 * static_cast<double>(path.at(0).length);
      if (!rows[k].of_rates) {
        const Real seen = slope(position, 1e-4L);
        EXPECT_NEAR(static_cast<double>(seen), static_cast<double>(velocity(0)), tolerance);
      }
      const Real second = slope(velocity, 1e-4L);
      // Rows of angles between parallel axes hold on the constraint alone: the path leaves it with the third power.
      EXPECT_NEAR(static_cast<double>(second), static_cast<double>(path.at(0).row_acceleration(path.at(0).rows[k])),
                  tolerance * 10);
      Model& still = path.at(0);
      for (std::size_t b = 1; b < still.bodies.size(); ++b) {
        for (int c = 0; c < still.bodies[b].dof; ++c) {
          const BodyMotion before = still.motion[b];
          const auto moved = [&](Real h) {
            Vec step;
            set_component(step, c % 3, h);
            BodyMotion& motion = still.motion[b];
            if (rows[k].of_rates) (c < 3 ? motion.v : motion.w) += step;
            if (!rows[k].of_rates && c < 3) motion.p += step;
            if (!rows[k].of_rates && c >= 3) motion.R = rotation_exponential(step) * motion.R;
            still.update_positions();
            still.update_velocities();
            const Real value = rows[k].of_rates ? still.row_velocity(still.rows[k]) : still.row_position(still.rows[k]);
            motion = before;
            return value;
          };
          const Real seen = slope(moved, 1e-4L);
          EXPECT_NEAR(static_cast<double>(seen),
                      static_cast<double>(G(k, static_cast<std::size_t>(still.bodies[b].offset + c))), tolerance);
        }
      }
    }
  }
  EXPECT_GE(relations, 60);
  EXPECT_GE(velocity_rows, 15);
}

// A body that slides and turns along z, on a spring of stiffness k.
Mechanism nut(double mass, double inertia, double k) {
  Mechanism m = with_ground();
  const BodyRef part = add_part(m, 1, mass, {1, 1, inertia, 0, 0, 0}, 1);
  m.markers = {{1, part, origin, origin}, {2, ground, origin, origin}, {3, ground, {0, 0, -1}, origin}};
  m.joints = {{1, JointType::cylindrical, 1, 2}};
  m.springs = {{1, Direction::translational, 1, 3, k, 0, 0, 1}};
  return m;
}

TEST(Oracle, screw_adds_the_inertia_of_its_turning) {
  Mechanism m = nut(2, 0.3, 40);
  m.joints.push_back({2, JointType::screw, 1, 2, 0.5});
  const double turns = 2 * pi / 0.5;
  const OracleLinearModel r = linearize_drawn(m, {rate(1, 2), value(1, 2)});
  expect_matrix(r.A, {{0, -40 / (2 + 0.3 * turns * turns)}, {1, 0}}, 1e-12);
  // Its sense: a turn of 2 pi advances by the pitch.
  body(m, 1).w = Triple{0, 0, 2};
  EXPECT_NEAR(drawn_point(m).bodies[0].velocity[2], 2 * 0.5 / (2 * pi), 1e-14);
}

TEST(Oracle, pinion_rolls_towards_the_line_of_its_rack) {
  Mechanism m = with_ground();
  const BodyRef part = add_part(m, 1, 2, {1, 1, 0.3, 0, 0, 0}, 1);
  m.markers = {{1, part, origin, origin},
               {2, ground, origin, origin},
               {3, ground, origin, z_along_x},
               {4, ground, {-1, 0, 0}, origin}};
  m.joints = {{1, JointType::planar, 1, 2}, {2, JointType::inline_, 1, 3}, {3, JointType::rackpin, 1, 3, 0.5}};
  m.springs = {{1, Direction::translational, 1, 4, 40, 0, 0, 1}};
  const OracleLinearModel r = linearize_drawn(m, {rate(1, 0), value(1, 0)});
  expect_matrix(r.A, {{0, -40 / (2 + 0.3 * 4 / 0.25)}, {1, 0}}, 1e-12);
  body(m, 1).w = Triple{0, 0, 2};
  EXPECT_NEAR(drawn_point(m).bodies[0].velocity[0], 2 * 0.25, 1e-14);
}

// Two wheels on ground, the first on a torsion spring.
Mechanism wheels() {
  Mechanism m = with_ground();
  const BodyRef one = add_part(m, 1, 1, {1, 1, 0.7, 0, 0, 0}, 1);
  const BodyRef two = add_part(m, 2, 1, {1, 1, 0.2, 0, 0, 0}, 2);
  body(m, 2).qg = {0.4, 0, 0};
  m.markers = {{1, one, origin, origin},
               {2, two, origin, origin},
               {3, ground, origin, origin},
               {4, ground, {0.4, 0, 0}, origin},
               {5, ground, {0.3, 0, 0}, {0, -pi / 2, 0}}};
  m.joints = {{1, JointType::revolute, 1, 3}, {2, JointType::revolute, 2, 4}};
  m.springs = {{1, Direction::rotational, 1, 3, 9, 0, 0, 0}};
  return m;
}

TEST(Oracle, coupler_and_gear_add_inertia_by_the_square_of_their_ratio) {
  Mechanism coupled = wheels();
  coupled.couplers = {{1, {1, 2}, {1, -3}, "RR"}};  // q1 = 3 q2
  expect_matrix(linearize_drawn(coupled, {rate(1, 5), value(1, 5)}).A, {{0, -9 / (0.7 + 0.2 / 9)}, {1, 0}}, 1e-12);
  // Radii 0.3 and 0.1 that touch at x = 0.3: backwards, three times as fast; whichever marker the carrier holds.
  Mechanism geared = wheels();
  geared.gears = {{1, {1, 2}, 5}};
  expect_matrix(linearize_drawn(geared, {rate(1, 5), value(1, 5)}).A, {{0, -9 / (0.7 + 0.2 * 9)}, {1, 0}}, 1e-12);
  body(geared, 1).w = Triple{0, 0, 2};
  EXPECT_NEAR(drawn_point(geared).bodies[1].angular_velocity[2], -6, 1e-13);
  std::swap(geared.joints[1].i, geared.joints[1].j);
  EXPECT_NEAR(drawn_point(geared).bodies[1].angular_velocity[2], -6, 1e-13);
}

TEST(Oracle, driven_angles_are_those_of_the_sequence_x_y_z) {
  const double b1 = 0.4, b2 = -0.7, b3 = 1.1;
  Mechanism m = with_ground();
  const BodyRef part = add_part(m, 1, 1, {1, 1, 1, 0, 0, 0}, 1);
  const auto turn_y = [](Real a) {
    return Mat{{Vec{std::cos(a), 0, -std::sin(a)}, Vec{0, 1, 0}, Vec{std::sin(a), 0, std::cos(a)}}};
  };
  const Mat C = rotation_x(b1) * turn_y(b2) * rotation_z(b3);
  const Vec &x = C.column[0], &y = C.column[1], &z = C.column[2];
  const Vec g = z;
  m.markers = {{1, part, origin, origin}, {2, ground, origin, origin}};
  m.markers[0].reuler = to_triple({std::atan2(g.x, -g.y), std::atan2(std::hypot(g.x, g.y), g.z), std::atan2(x.z, y.z)});
  m.joints = {{1, JointType::spherical, 1, 2}};
  m.motions = {{1, 1, {{b1, 1, 0, 0}, 0, 0, 0}, '1'},
               {2, 1, {{b2, 0, 0, 0}, 0, 0, 0}, '2'},
               {3, 1, {{b3, 0, 0, 0}, 0, 0, 0}, '3'}};
  const Model model(m);
  for (const Row& row : model.rows) EXPECT_NEAR(static_cast<double>(model.row_position(row)), 0, 1e-15);
  // B1 is the outermost turn: about x of J.
  const Triple w = drawn_point(m).bodies[0].angular_velocity;
  EXPECT_NEAR(w[0], 1, 1e-14);
  EXPECT_NEAR(std::hypot(w[1], w[2]), 0, 1e-14);
}

// Chaplygin's sleigh: lambda = -m a u / (I + m a^2), all others zero; three positions, two velocities.
TEST(Oracle, knife_edge_damps_or_drives_the_turn_of_a_sleigh) {
  for (const double u : {1.0, 3.0, -2.0}) {
    Mechanism m = with_ground();
    const double mass = 2, inertia = 0.3, a = 0.4;
    const BodyRef part = add_part(m, 1, mass, {1, 1, inertia, 0, 0, 0}, 1);
    m.markers = {{1, part, origin, origin}, {2, part, {-a, 0, 0}, origin}, {3, ground, origin, origin}};
    body(m, 1).v = Triple{u, 0, 0};
    m.joints = {{1, JointType::planar, 1, 3}};
    m.gcons = {{1, true, measure(Measure::VY, {2, 0, 2})}};
    const OraclePoint point = drawn_point(m);
    const OracleLinearModel r =
        oracle_linearize(m, point, {rate(1, 0), value(1, 0), value(1, 1), rate(1, 5), value(1, 5)});
    const auto p = characteristic_polynomial(r.A);
    const std::vector<double> expected{1, mass * a * u / (inertia + mass * a * a), 0, 0, 0, 0};
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(p[k], expected[k], 1e-11) << u << " " << k;
    EXPECT_EQ(choose_states(m, point).size(), 5U);
  }
}

// An upright disk that rolls along x without slip: benchmarks.md section 3, disk at v = 2.
TEST(Oracle, rolling_disk_leans_and_steers_as_tabulated) {
  const double mass = 4, r = 0.5, v = 2;
  Mechanism m = with_ground();
  m.gravity = {0, 0, -9.81};
  const BodyRef disk = add_part(m, 1, mass, {0.25, 0.5, 0.25, 0, 0, 0}, 1);
  body(m, 1).qg = {0, 0, r};
  body(m, 1).v = Triple{v, 0, 0};
  body(m, 1).w = Triple{0, v / r, 0};
  m.markers = {{1, disk, origin, origin}, {2, disk, {0, 1, 0}, origin}};
  // From the centre to the point of contact: down in the plane of the disk.
  const auto axis = [&](Measure d) { return measure(d, {2, 1}); };
  const Expr s = call(Function::sqrt, {constant(1) - square(axis(Measure::DZ))});
  const auto arm = [&](Measure d) { return r * (axis(d) * axis(Measure::DZ) / s); };
  const Expr down = -r * s;
  const auto w = [&](Measure k) { return measure(k, {1}); };
  m.gcons = {{1, false, measure(Measure::DZ, {1}) - r * s},
             {2, true, measure(Measure::VX, {1}) + w(Measure::WY) * down - w(Measure::WZ) * arm(Measure::DY)},
             {3, true, measure(Measure::VY, {1}) + w(Measure::WZ) * arm(Measure::DX) - w(Measure::WX) * down}};
  const OraclePoint point = drawn_point(m);
  const std::vector<ChosenState> states{value(1, 0), value(1, 1), rate(1, 3), value(1, 3),
                                        rate(1, 4),  value(1, 4), rate(1, 5), value(1, 5)};
  const OracleLinearModel model = oracle_linearize(m, point, states);
  const auto p = characteristic_polynomial(model.A);
  // lambda^6 (lambda^2 + 22.704) = 0
  const std::vector<double> expected{1, 0, 22.704, 0, 0, 0, 0, 0, 0};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(p[k], expected[k], 1e-9) << k;
}

}  // namespace
}  // namespace dynalin::oracle::relations_self_check
