// The oracle against closed forms and published numbers, so that a disagreement with the product has one
// suspect only.
#include "self_check.h"

namespace dynalin::oracle::oracle_self_check {
namespace {

TEST(Oracle, pendulum_about_any_axis_swings_at_the_frequency_of_the_compound_pendulum) {
  for (const double ucf : {1.0, 1000.0}) {
    Mechanism m = with_ground();
    m.ucf = ucf;
    m.gravity = {1.5, -4, -8};
    const Triple hinge{0.7, 1.1, 0.4};  // 3-1-3 angles of the hinge frame, z the axis
    const Mat H = rotation_313(hinge[0], hinge[1], hinge[2]);
    const Vec n = H.column[2];
    const Vec g = to_vec(m.gravity);
    const Vec down = g - dot(g, n) * n;
    const Real arm = 0.8L;
    const Vec cm = (arm / norm(down)) * down + 0.3L * n;
    const BodyRef part = add_part(m, 1, 2.5, {0.5, 0.7, 0.9, 0.1, -0.05, 0.08}, 3);
    m.markers = {{1, ground, {0, 0, 0}, hinge}, {2, part, {0, 0, 0}, hinge}, {3, part, to_triple(cm), {0, 0, 0}}};
    m.joints = {{1, JointType::revolute, 2, 1}};
    const Mat J{{Vec{0.5, -0.1, 0.05}, Vec{-0.1, 0.7, -0.08}, Vec{0.05, -0.08, 0.9}}};
    const Real about_hinge = dot(n, J * n) + 2.5L * arm * arm;
    const double expected = static_cast<double>(2.5L * norm(down) * arm / about_hinge);
    const OracleLinearModel r = linearize_drawn(m, {rate(1, 3), value(1, 3)});
    expect_matrix(r.A, {{0, -expected}, {1, 0}}, 1e-12 * expected);
    EXPECT_LT(r.error_estimate, 1e-12);
  }
}

// benchmarks.md section 5: upright tops, non-spinning coordinates, any local axis along the spin.
void expect_top(double spin, const std::array<double, 2>& expected, const Triple& orientation) {
  Mechanism m = with_ground();
  m.gravity = {0, 0, -9.81};
  const Mat R = rotation_313(orientation[0], orientation[1], orientation[2]);
  const double about_pivot = 0.010658333333333333, mass_arm = 1 * 0.1 * 0.1;
  const Real A = about_pivot - mass_arm, C = 0.00125L;
  const Mat up = transpose(R);
  const Mat J = up * Mat{{Vec{A, 0, 0}, Vec{0, A, 0}, Vec{0, 0, C}}} * R;
  const auto entry = [&](std::size_t c, int k) { return static_cast<double>(component(J.column[c], k)); };
  const BodyRef part =
      add_part(m, 1, 1, {entry(0, 0), entry(1, 1), entry(2, 2), -entry(0, 1), -entry(0, 2), -entry(1, 2)}, 2);
  body(m, 1).reuler = orientation;
  body(m, 1).w = to_triple(up * Vec{0, 0, spin});
  m.markers = {{1, part, {0, 0, 0}, {0, 0, 0}},
               {2, part, to_triple(up * Vec{0, 0, 0.1L}), {0, 0, 0}},
               {3, ground, {0, 0, 0}, {0.3, 0.5, 0.7}}};
  m.joints = {{1, JointType::spherical, 1, 3}};
  const OracleLinearModel r =
      linearize_drawn(m, {rate(1, 3), value(1, 3), rate(1, 4), value(1, 4), rate(1, 5), value(1, 5)});
  const double a = expected[0] * expected[0], b = expected[1] * expected[1];
  const std::vector<double> p = characteristic_polynomial(r.A);
  const std::vector<double> q{1, 0, a + b, 0, a * b, 0, 0};
  for (std::size_t k = 0; k < q.size(); ++k) EXPECT_NEAR(p[k], q[k], 1e-9 * (a + b + a * b)) << k;
}

TEST(Oracle, sleeping_top_is_the_same_about_any_local_axis) {
  const std::vector<Triple> orientations{origin, z_along_x, z_along_y, {0.4, 1.2, -0.9}};
  for (const Triple& orientation : orientations) {
    expect_top(200, {18.473523837522, 4.982301025652}, orientation);
    expect_top(300, {32.337484461703, 2.846252833058}, orientation);
  }
}

TEST(Oracle, turning_a_free_tumbling_body_changes_nothing) {
  Mechanism m = with_ground();
  const BodyRef part = add_part(m, 1, 2, {1, 2, 2.5, 0.2, -0.1, 0.15}, 1);
  body(m, 1).reuler = {0.3, 0.9, -0.4};
  body(m, 1).w = Triple{1, 2, -1.5};
  body(m, 1).v = Triple{0.1, 0.2, 0.3};
  m.markers = {{1, part, {0, 0, 0}, {0, 0, 0}}};
  std::vector<ChosenState> states;
  for (int c = 0; c < 6; ++c) states.insert(states.end(), {rate(1, c), value(1, c)});
  const OracleLinearModel r = linearize_drawn(m, states);
  for (std::size_t i = 0; i < 12; i += 2) {
    for (std::size_t j = 1; j < 12; j += 2) EXPECT_NEAR(r.A[i][j], 0, 1e-13);
  }
}

// LINEAR command 5.1.2: arm and slider, states AZ of the arm and DX of the slider's BCS.
TEST(Oracle, rotating_slider_has_the_published_state_matrix) {
  Mechanism m = with_ground();
  const BodyRef arm = add_part(m, 2, 3, {10, 10, 10, 0, 0, 0}, 7);
  const BodyRef slider = add_part(m, 3, 3, {10, 10, 10, 0, 0, 0}, 8);
  body(m, 2).w = body(m, 3).w = Triple{0, 0, 10};
  m.markers = {{6, ground, {0, 0, 0}, {0, 0, 0}},  {5, arm, {0, 0, 0}, {0, 0, 0}},
               {7, arm, {1, 0, 0}, {0, 0, 0}},     {10, arm, {0, 0, 0}, z_along_x},
               {8, slider, {10, 0, 0}, {0, 0, 0}}, {9, slider, {0, 0, 0}, z_along_x}};
  m.joints = {{1, JointType::revolute, 5, 6}, {2, JointType::translational, 9, 10}};
  m.springs = {{1, Direction::translational, 6, 8, 5, 0, 0, 10}};
  const OracleLinearModel r = linearize_drawn(m, {rate(2, 5), rate(3, 0), value(2, 5), value(3, 0)});
  expect_matrix(r.A, {{0, -600.0 / 323, 0, 0}, {200, 0, 0, -5.0 / 3}, {1, 0, 0, 0}, {0, 1, 0, 0}}, 1e-11);
  EXPECT_NEAR(r.accelerations[1].acceleration[0], 1000, 1e-10);  // along the slide: 10^2 times 10
  EXPECT_NEAR(std::sqrt(600.0 / 323 * 200 + 5.0 / 3) / (2 * pi), 3.074549302168, 1e-11);
}

// LINEAR command 5.1.3: a blade on a massless driven link.
Mechanism driven_blade() {
  Mechanism m = with_ground();
  const BodyRef link = add_part(m, 2, 0, {}, 0);
  const BodyRef blade = add_part(m, 3, 3, {0, 0, 10, 0, 0, 0}, 10);
  body(m, 3).w = Triple{0, 0, 10};
  m.markers = {{6, ground, {0, 0, 0}, {0, 0, 0}},
               {5, link, {0, 0, 0}, {0, 0, 0}},
               {8, link, {2, 0, 0}, {0, 0, 0}},
               {7, blade, {2, 0, 0}, {0, 0, 0}},
               {10, blade, {12, 0, 0}, {0, 0, 0}}};
  m.joints = {{1, JointType::revolute, 5, 6}, {2, JointType::revolute, 7, 8}};
  m.motions = {{1, 1, {{0, 10, 0, 0}, 0, 0, 0}}};
  return m;
}

TEST(Oracle, driven_blade_has_the_published_frequency) {
  const Mechanism m = driven_blade();
  const OraclePoint point = drawn_point(m);
  EXPECT_NEAR(point.bodies[1].velocity[1] + 12 * point.bodies[1].angular_velocity[2], 120, 1e-12);
  const OracleLinearModel r = oracle_linearize(m, point, {rate(3, 5), value(3, 5)});
  expect_matrix(r.A, {{0, -6000.0 / 310}, {1, 0}}, 1e-12);
  EXPECT_NEAR(std::sqrt(6000.0 / 310) / (2 * pi), 0.7001883973744, 1e-12);
}

// The same blade in its global y at the mass centre, taken as a coordinate by placing the BCS there: the
// chart that moves with the nominal motion adds the square of the driving rate.
TEST(Oracle, driven_blade_in_global_y_has_the_published_frequency) {
  Mechanism m = driven_blade();
  body(m, 3).qg = {12, 0, 0};
  m.markers[3].qp = {-10, 0, 0};
  m.markers[4].qp = {0, 0, 0};
  const OracleLinearModel r = linearize_drawn(m, {rate(3, 1), value(3, 1)});
  expect_matrix(r.A, {{0, -6000.0 / 310 - 100}, {1, 0}}, 1e-11);
  EXPECT_NEAR(std::sqrt(6000.0 / 310 + 100) / (2 * pi), 1.738762025947, 1e-12);
}

// benchmarks.md section 12. The pendulum tilts about +y, which turns its top towards +x: the opposite
// sense of the table's phi.
TEST(Oracle, cart_pole_has_the_tabulated_state_space) {
  Mechanism m = with_ground();
  m.gravity = {0, 0, -9.8};
  const BodyRef cart = add_part(m, 1, 0.5, {1, 1, 1, 0, 0, 0}, 1);
  const BodyRef pole = add_part(m, 2, 0.2, {0.006, 0.006, 0.006, 0, 0, 0}, 2);
  m.markers = {{1, cart, {0, 0, 0}, {0, 0, 0}},   {2, pole, {0, 0, 0.3}, {0, 0, 0}}, {3, cart, {0, 0, 0}, z_along_x},
               {4, ground, {0, 0, 0}, z_along_x}, {5, cart, {0, 0, 0}, z_along_y},   {6, pole, {0, 0, 0}, z_along_y},
               {7, ground, {-5, 0, 0}, {0, 0, 0}}};
  m.joints = {{1, JointType::translational, 3, 4}, {2, JointType::revolute, 6, 5}};
  m.springs = {{1, Direction::translational, 1, 7, 0, 0.1, 0, 5}};
  m.variables = {{1, constant(0)},
                 {2, measure(Measure::DX, {1})},
                 {3, measure(Measure::AY, {2})},
                 {4, measure(Measure::ACCX, {1})},
                 {5, joint_reaction(2, 0, 4, 0)},
                 {6, joint_reaction(2, 1, 2, 0)},
                 {7, joint_reaction(1, 0, 4, 0)}};
  m.sforces = {{1, Direction::translational, Reaction::action_only, 1, 4, varval(1)}};
  m.pinput = {1, {1}};
  m.poutput = {1, {2, 3, 4, 5, 6, 7}};
  const OracleLinearModel r = linearize_drawn(m, {rate(1, 0), value(1, 0), rate(2, 4), value(2, 4)});
  const double a = 0.1818181818181818, b = 2.672727272727273, c = 0.4545454545454545;
  const double d = 31.18181818181818, e = 1.818181818181818, f = 4.545454545454545;
  expect_matrix(r.A, {{-a, 0, 0, -b}, {1, 0, 0, 0}, {c, 0, 0, d}, {0, 0, 1, 0}}, 1e-12);
  expect_matrix(r.B, {{e}, {0}, {-f}, {0}}, 1e-12);
  // The pin pushes the cart along x with the part of its force balance that input and damper leave.
  const double px = 0.5 * e - 1, pa = -0.5 * a + 0.1, pb = -0.5 * b;
  expect_matrix(r.C, {{0, 1, 0, 0}, {0, 0, 0, 1}, {-a, 0, 0, -b}, {0, 0, 0, 0}, {pa, 0, 0, pb}, {0, 0, 0, 0}}, 1e-12);
  expect_matrix(r.D, {{0}, {0}, {e}, {0}, {px}, {0}}, 1e-12);
  EXPECT_NEAR(r.outputs[3], 0.2 * 9.8, 1e-13);  // the pin carries the pole: up on the pole
  EXPECT_NEAR(r.outputs[5], 0.7 * 9.8, 1e-12);  // the slide carries both: up on the cart
}

TEST(Oracle, reaction_on_j_is_the_opposite_wrench_moved_to_the_origin_of_j) {
  // A cantilevered mass on a slide whose markers are apart: moments about I and J differ.
  Mechanism m = with_ground();
  m.gravity = {0, -10, 0};
  const BodyRef part = add_part(m, 1, 2, {1, 1, 1, 0, 0, 0}, 1);
  m.markers = {{1, part, {3, 0, 0}, {0, 0, 0}}, {2, part, {1, 0, 0}, z_along_x}, {3, ground, {0, 0, 0}, z_along_x}};
  m.joints = {{1, JointType::translational, 2, 3}};
  for (int k = 0; k < 6; ++k) {
    const int comp[] = {3, 8, 3, 8, 1, 5};
    const int flag[] = {0, 0, 1, 1, 1, 1};
    m.variables.push_back({k + 1, joint_reaction(1, flag[k], comp[k], 0)});
    m.poutput.variables.push_back(k + 1);
  }
  m.poutput.id = 1;
  const OracleLinearModel r = linearize_drawn(m, {rate(1, 0), value(1, 0)});
  const double expected[] = {20, 40, -20, -60, 20, 60};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(r.outputs[k], expected[k], 1e-12) << k;
}

// LINEAR command 7.2, Listing 3: inverted pendulum with actuator and integrator, STATEMAT printed in full.
TEST(Oracle, actuated_pendulum_has_the_published_state_space) {
  Mechanism m = with_ground();
  m.gravity = {0, 0, -1};
  const BodyRef cart = add_part(m, 1, 10, {10, 10, 10, 0, 0, 0}, 10);
  const BodyRef pole = add_part(m, 2, 1, {1, 1, 1, 0, 0, 0}, 20);
  m.markers = {{99, ground, {0, 0, 0}, z_along_x}, {10, cart, {5, 0, 0}, {0, 0, 0}},  {11, cart, {5, 0, 2}, z_along_y},
               {13, cart, {5, 0, 0}, z_along_x},   {14, cart, {5, 0, 12}, {0, 0, 0}}, {15, cart, {12, 0, 2}, {0, 0, 0}},
               {20, pole, {5, 0, 12}, {0, 0, 0}},  {21, pole, {5, 0, 2}, z_along_y},  {23, pole, {5, 0, 7}, {0, 0, 0}}};
  m.joints = {{1, JointType::translational, 13, 99}, {2, JointType::revolute, 11, 21}};
  m.springs = {{1, Direction::translational, 99, 13, 200, 40, 0, 5}};
  m.sforces = {{1, Direction::translational, Reaction::on_j, 15, 23, aryval(3, 1)}};
  m.variables = {{2, constant(0)},
                 {1, measure(Measure::DX, {20, 14})},
                 {10, varval(1)},
                 {20, measure(Measure::VX, {20, 14})},
                 {30, aryval(22, 1)}};
  m.arrays = {{1, ArrayKind::u, {2}, {}},  {2, ArrayKind::x, {}, {}},  {3, ArrayKind::y, {}, {}},
              {20, ArrayKind::u, {1}, {}}, {21, ArrayKind::x, {}, {}}, {22, ArrayKind::y, {}, {}}};
  m.tfsisos = {{1, 2, 1, 3, {10}, {1, 0.005}}, {2, 21, 20, 22, {1}, {0, 1}}};
  m.pinput = {1, {2}};
  m.poutput = {1, {10, 20, 30}};
  const OracleLinearModel r =
      linearize_drawn(m, {rate(1, 0), value(1, 0), rate(2, 4), value(2, 4), tfsiso_state(1), tfsiso_state(2)});
  const double b = 0.0402439896739235888, c = -0.0442683886413159505;
  const double a31 = 0.395647873392680538, a32 = 1.97823936696340263;
  expect_matrix(r.A,
                {{-4040.0 / 1011, -20200.0 / 1011, 0, -100.0 / 1011, b, 0},
                 {1, 0, 0, 0, 0, 0},
                 {a31, a32, 0, 110.0 / 1011, c, 0},
                 {0, 0, 1, 0, 0, 0},
                 {0, 0, 0, 0, -200, 0},
                 {0, 0, 0, 10, 0, 0}},
                1e-12);
  expect_matrix(r.B, {{0}, {0}, {0}, {0}, {2000}, {0}}, 1e-10);
  expect_matrix(r.C, {{0, 0, 0, 10, 0, 0}, {0, 0, 10, 0, 0, 0}, {0, 0, 0, 0, 0, 1}}, 1e-12);
  expect_matrix(r.D, {{0}, {0}, {0}}, 1e-12);
}

// Observer form of order two: the transfer function of A, B, C, D at s = 1 is that of the coefficients.
TEST(Oracle, tfsiso_of_order_two_has_its_transfer_function) {
  Mechanism m = driven_blade();
  m.variables = {{1, constant(0)}, {2, aryval(3, 1)}};
  m.arrays = {{1, ArrayKind::u, {1}, {}}, {2, ArrayKind::x, {}, {}}, {3, ArrayKind::y, {}, {}}};
  m.tfsisos = {{1, 2, 1, 3, {2, 3, 5}, {7, 11, 4}}};
  m.pinput = {1, {1}};
  m.poutput = {1, {2}};
  ChosenState second = tfsiso_state(1);
  second.index = 2;
  const OracleLinearModel r = linearize_drawn(m, {rate(3, 5), value(3, 5), tfsiso_state(1), second});
  const double a = 1 - r.A[2][2], b = -r.A[2][3], c = -r.A[3][2], d = 1 - r.A[3][3];
  const double x1 = (d * r.B[2][0] - b * r.B[3][0]) / (a * d - b * c);
  const double x2 = (a * r.B[3][0] - c * r.B[2][0]) / (a * d - b * c);
  EXPECT_NEAR(r.C[0][2] * x1 + r.C[0][3] * x2 + r.D[0][0], 10.0 / 22, 1e-13);
  EXPECT_NEAR(r.C[0][2], 1, 1e-14);
}

TEST(Oracle, two_charts_of_one_mechanism_have_one_spectrum_at_rest) {
  // At rest and balanced the chart does not matter: rotations, or a rotation and a place.
  Mechanism m = with_ground();
  m.gravity = {0, 0, -9.81};
  const BodyRef upper = add_part(m, 1, 1, {0.1, 0.2, 0.25, 0.01, 0, 0.02}, 1);
  const BodyRef lower = add_part(m, 2, 2, {0.3, 0.2, 0.25, 0, 0.03, 0}, 2);
  m.markers = {{1, upper, {0, 0, -0.5}, {0, 0, 0}}, {2, lower, {0, 0, -1.5}, {0, 0, 0}},
               {3, upper, {0, 0, 0}, z_along_x},    {4, ground, {0, 0, 0}, z_along_x},
               {5, upper, {0, 0, -1}, z_along_y},   {6, lower, {0, 0, -1}, z_along_y}};
  body(m, 2).qg = {0, 0, -2};
  m.markers[1].qp = {0, 0, 0.5};
  m.markers[5].qp = {0, 0, 1};
  m.joints = {{1, JointType::revolute, 3, 4}, {2, JointType::revolute, 6, 5}};
  const auto p = characteristic_polynomial(linearize_drawn(m, {rate(1, 3), value(1, 3), rate(2, 4), value(2, 4)}).A);
  const auto q = characteristic_polynomial(linearize_drawn(m, {rate(1, 3), value(1, 3), rate(2, 0), value(2, 0)}).A);
  for (std::size_t k = 0; k < p.size(); ++k) EXPECT_NEAR(p[k], q[k], 1e-10 * (1 + std::fabs(p[k])));
}

TEST(Oracle, redundant_constraints_leave_the_motion_unchanged) {
  // A body on two coaxial hinges: five of the ten rows are redundant.
  Mechanism m = with_ground();
  m.gravity = {0, 0, -9.81};
  const BodyRef part = add_part(m, 1, 1, {0.1, 0.1, 0.1, 0, 0, 0}, 1);
  m.markers = {{1, part, {0, 0, -1}, {0, 0, 0}},
               {2, part, {-1, 0, 0}, z_along_x},
               {3, ground, {-1, 0, 0}, z_along_x},
               {4, part, {1, 0, 0}, z_along_x},
               {5, ground, {1, 0, 0}, z_along_x}};
  m.joints = {{1, JointType::revolute, 2, 3}, {2, JointType::revolute, 4, 5}};
  const OracleLinearModel r = linearize_drawn(m, {rate(1, 3), value(1, 3)});
  expect_matrix(r.A, {{0, -9.81 / 1.1}, {1, 0}}, 1e-12);
}

}  // namespace
}  // namespace dynalin::oracle::oracle_self_check
