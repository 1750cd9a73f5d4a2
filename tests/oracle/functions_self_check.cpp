// Functions, measures and loads of the oracle against differences and closed forms.
#include <string>

#include "evaluation.h"
#include "self_check.h"

namespace dynalin::oracle::functions_self_check {
namespace {

Real value_at(Function f, const std::vector<double>& a) {
  return mathematical_function<Real>(f, std::vector<Real>(a.begin(), a.end()));
}

struct Example {
  Function function;
  std::vector<double> arguments;
  double value;
};

std::string text_of(const Example& e) {
  std::vector<Expr> arguments;
  for (const double a : e.arguments) arguments.push_back(constant(a));
  return expression_text(call(e.function, arguments));
}

// Values by hand from the definitions.
const std::vector<Example> examples{
    {Function::sin, {pi / 6}, 0.5},
    {Function::cos, {pi / 3}, 0.5},
    {Function::tan, {pi / 4}, 1},
    {Function::asin, {0.5}, pi / 6},
    {Function::acos, {-0.5}, 2 * pi / 3},
    {Function::atan, {-1}, -pi / 4},
    {Function::atan2, {1, -1}, 3 * pi / 4},
    {Function::sinh, {std::log(2.0)}, 0.75},
    {Function::cosh, {std::log(2.0)}, 1.25},
    {Function::tanh, {std::log(2.0)}, 0.6},
    {Function::exp, {std::log(3.0)}, 3},
    {Function::log, {std::exp(2.0)}, 2},
    {Function::log10, {1000}, 3},
    {Function::sqrt, {2.25}, 1.5},
    {Function::raise, {4, 1.5}, 8},
    {Function::abs, {-2.5}, 2.5},
    {Function::aint, {-2.7}, -2},
    {Function::anint, {-2.7}, -3},
    {Function::dim, {3, 1.25}, 1.75},
    {Function::dim, {1, 3.25}, 0},
    {Function::maximum, {1, 4, 2}, 4},
    {Function::minimum, {3, 1.5, 2}, 1.5},
    {Function::mod, {7.5, 2}, 1.5},
    {Function::mod, {-7.5, 2}, -1.5},
    {Function::sign, {2, -0.5}, -2},
    {Function::sign, {-2, -0.5}, -2},
    {Function::sign, {-2, 0.5}, 2},
    {Function::choose, {-0.1, 5, 6, 7}, 5},
    {Function::choose, {0.1, 5, 6, 7}, 7},
    {Function::step, {0.25, 0, 1, 1, 3}, 1 + 2 * 0.15625},
    {Function::step5, {0.25, 0, 1, 1, 3}, 1 + 2 * 0.103515625},
    {Function::havsin, {0.25, 0, 1, 1, 3}, 2 - std::sqrt(0.5)},
    {Function::step5, {-1, 0, 1, 1, 3}, 1},
    {Function::havsin, {2, 0, 1, 1, 3}, 3},
    // Penetration 0.5 at speed 2 inwards: 3 * 0.25 + 0.8 * 0.5 * 2; full damping at depth 1.
    {Function::impact, {0.5, -2, 1, 3, 2, 0.8, 1}, 0.75 + 0.8},
    {Function::impact, {0.5, 4, 1, 3, 2, 0.8, 1}, 0},  // never pulls
    {Function::impact, {1.5, -2, 1, 3, 2, 0.8, 1}, 0},
    {Function::bistop, {0.5, -2, 1, 5, 3, 2, 0.8, 1}, 0.75 + 0.8},
    {Function::bistop, {5.5, 2, 1, 5, 3, 2, 0.8, 1}, -0.75 - 0.8},
    {Function::bistop, {3, 2, 1, 5, 3, 2, 0.8, 1}, 0},
    {Function::poly, {3, 1, 5, 4, 3, 2}, 5 + 8 + 12 + 16},
    {Function::cheby, {1.5, 1, 5, 4, 3, 2}, 5 + 2 - 1.5 - 2},  // T2(1/2) = -1/2, T3(1/2) = -1
    {Function::forsin, {1, 0.5, pi, 5, 4, 3}, 5 + 4},
    {Function::forcos, {1, 0.5, pi, 5, 4, 3}, 5 - 3},
    {Function::shf, {1, 0.5, 2, pi, pi / 3, 7}, 8},
    // Half way up the ramp (STEP5 = 1/2), at a phase of 2 pi (1/2 + 3/4 * 1/2 ... ): F = 0.5 * 1 + 0.5 + 1 * 0.25 / 4.
    {Function::sweep, {1.5, 4, 1, 1, 3, 2, 1}, 0.5 * 4 * std::sin(2 * pi * (1 + 0.5 + 0.0625))},
    {Function::sweep, {4, 4, 1, 1, 3, 2, 1}, 4 * std::sin(2 * pi * (1 + 3 + 2))},
};

TEST(Oracle, functions_have_the_values_of_their_definitions) {
  std::vector<bool> seen(static_cast<std::size_t>(Function::sweep) + 1, false);
  for (const Example& e : examples) {
    seen[static_cast<std::size_t>(e.function)] = true;
    EXPECT_NEAR(static_cast<double>(value_at(e.function, e.arguments)), e.value, 1e-13 * (1 + std::fabs(e.value)))
        << text_of(e);
  }
  for (std::size_t k = 0; k < seen.size(); ++k) EXPECT_TRUE(seen[k]) << k;
}

// All arguments move at once along a line.
TEST(Oracle, jets_of_functions_are_differences_of_values) {
  for (const Example& e : examples) {
    if (e.function == Function::sweep && e.arguments[0] > 3) continue;
    SCOPED_TRACE(text_of(e));
    const auto at = [&](Real t) {
      std::vector<Real> a;
      for (std::size_t k = 0; k < e.arguments.size(); ++k) {
        a.push_back(e.arguments[k] + t * (0.3L + 0.1L * static_cast<Real>(k)));
      }
      return mathematical_function<Real>(e.function, a);
    };
    std::vector<Jet> a;
    for (std::size_t k = 0; k < e.arguments.size(); ++k) {
      a.push_back({e.arguments[k], 0.3L + 0.1L * static_cast<Real>(k), 0});
    }
    const Jet jet = mathematical_function<Jet>(e.function, a);
    const Real h = 1e-3L;
    const Real v = at(0), p1 = at(h), m1 = at(-h), p2 = at(2 * h), m2 = at(-2 * h);
    const double first = static_cast<double>((8 * (p1 - m1) - (p2 - m2)) / (12 * h));
    const double second = static_cast<double>((16 * (p1 + m1) - (p2 + m2) - 30 * v) / (12 * h * h));
    EXPECT_NEAR(static_cast<double>(jet.v), static_cast<double>(v), 1e-15 * (1 + std::fabs(e.value)));
    EXPECT_NEAR(static_cast<double>(jet.d), first, 1e-8 * (1 + std::fabs(first)));
    EXPECT_NEAR(static_cast<double>(jet.dd), second, 1e-6 * (1 + std::fabs(second)));
  }
}

// Euler angles and others of a marker turned by known angles.
TEST(Oracle, angles_are_those_of_their_sequences) {
  const double a = 0.5, b = 0.8, c = -0.6;
  Mechanism m = with_ground();
  const BodyRef part = add_part(m, 1, 1, {1, 1, 1, 0, 0, 0}, 1);
  const auto turn_y = [](Real angle) {
    return Mat{{Vec{std::cos(angle), 0, -std::sin(angle)}, Vec{0, 1, 0}, Vec{std::sin(angle), 0, std::cos(angle)}}};
  };
  const Mat C = rotation_z(a) * turn_y(b) * rotation_x(c);
  const Vec& z = C.column[2];
  const Triple three_two_one = to_triple(
      {std::atan2(z.x, -z.y), std::atan2(std::hypot(z.x, z.y), z.z), std::atan2(C.column[0].z, C.column[1].z)});
  m.markers = {{1, part, {1, 0, 0}, {a, b, c}}, {2, ground, origin, origin}, {3, ground, {0, 2, 0}, three_two_one}};
  const Model model(m);
  const auto value = [&](const Expr& e) { return static_cast<double>(model.evaluate(e)); };
  EXPECT_NEAR(value(measure(Measure::PSI, {1, 2})), a, 1e-15);
  EXPECT_NEAR(value(measure(Measure::THETA, {1, 2})), b, 1e-15);
  EXPECT_NEAR(value(measure(Measure::PHI, {1, 2})), c, 1e-15);
  EXPECT_NEAR(value(measure(Measure::YAW, {3, 2})), a, 1e-15);
  EXPECT_NEAR(value(measure(Measure::PITCH, {3, 2})), -b, 1e-15);
  EXPECT_NEAR(value(measure(Measure::ROLL, {3, 2})), c, 1e-15);
  EXPECT_NEAR(value(measure(Measure::INCANG, {1, 2, 3})), pi / 2, 1e-15);
  EXPECT_NEAR(value(axis_component(Measure::UVX, 1, 2, 2)), std::sin(b) * std::sin(c), 1e-15);
}

TEST(Oracle, nforce_of_one_marker_is_a_field) {
  Mechanism m = with_ground();
  const BodyRef part = add_part(m, 1, 2, {0.4, 0.5, 0.6, 0, 0, 0}, 1);
  m.markers = {{1, part, origin, origin},
               {2, part, {0.2, 0.1, -0.3}, {0.2, 0.3, 0.1}},
               {3, ground, {0.1, 0, 0.5}, {0.1, 0.2, 0.4}}};
  body(m, 1).w = Triple{0.3, -0.5, 0.7};
  body(m, 1).v = Triple{0.1, 0.2, 0.3};
  LinearForce field{1, LinearKind::field, 2, 3};
  NumberMatrix K{1, 6, 6, {}}, C{2, 6, 6, {}}, length{3, 6, 1, {}}, force{4, 6, 1, {}};
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < 6; ++c) {
      field.k[r][c] = (r == c ? 5 : 0) + 0.1 * static_cast<double>(r) - 0.2 * static_cast<double>(c);
      field.c[r][c] = 0.1 * field.k[c][r];
      K.values.push_back(field.k[r][c]);
      C.values.push_back(field.c[r][c]);
    }
    field.length[r] = 0.1 * static_cast<double>(r);
    field.force[r] = 0.5 - 0.2 * static_cast<double>(r);
    length.values.push_back(field.length[r]);
    force.values.push_back(field.force[r]);
  }
  std::vector<ChosenState> states;
  for (int c = 0; c < 6; ++c) states.insert(states.end(), {rate(1, c), value(1, c)});
  Mechanism other = m;
  m.linears = {field};
  other.matrices = {K, C, length, force};
  other.nforces = {{1, 3, {2}, 1, 2, 3, 4}};
  expect_matrix(linearize_drawn(other, states).A, linearize_drawn(m, states).A, 1e-13);
}

// Two free bodies tied to a third by one NFORCE: momentum and moment of momentum stay.
TEST(Oracle, nforce_is_in_balance) {
  Mechanism m = with_ground();
  NumberMatrix K{1, 12, 12, {}}, C{2, 12, 12, {}};
  for (int k = 0; k < 144; ++k) {
    K.values.push_back(std::sin(1.7 * k) + (k % 13 == 0 ? 4 : 0));
    C.values.push_back(0.3 * std::cos(2.3 * k));
  }
  m.matrices = {K, C};
  for (int k = 1; k <= 3; ++k) {
    const BodyRef part = add_part(m, k, 1 + k, {0.4, 0.5, 0.6, 0.01 * k, 0, 0.02}, k);
    body(m, k).qg = {0.4 * k, 0.3 * k * k, -0.2 * k};
    body(m, k).reuler = {0.1 * k, 0.2, -0.1 * k};
    body(m, k).w = Triple{0.3, -0.5 * k, 0.7};
    body(m, k).v = Triple{0.1 * k, 0.2, -0.3};
    m.markers.push_back({k, part, {0.1, 0.2, -0.1}, origin});
    m.markers.push_back({10 + k, part, {-0.2, 0.1 * k, 0}, {0.2, 0.1 * k, 0}});
  }
  m.nforces = {{1, 13, {11, 12}, 1, 2}};
  Model model(m);
  place(model, drawn_point(m));
  (void)solve_algebra(model);
  Vec momentum, moment;
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    const Model::BodyData& body_data = model.bodies[b];
    const BodyMotion& k = model.motion[b];
    const Vec c = k.R * body_data.c;
    const Vec a = k.a + cross(k.al, c) + cross(k.w, cross(k.w, c));
    const auto J = [&](const Vec& w) { return k.R * (body_data.inertia * (transpose(k.R) * w)); };
    momentum += body_data.mass * a;
    moment += cross(k.p + c, body_data.mass * a) + J(k.al) + cross(k.w, J(k.w));
  }
  EXPECT_NEAR(static_cast<double>(norm(momentum)), 0, 1e-16);
  EXPECT_NEAR(static_cast<double>(norm(moment)), 0, 1e-16);
}

// z^3 + z = x, so that z' = x' / (1 + 3 z^2).
TEST(Oracle, algebraic_diff_is_an_unknown_with_a_rate) {
  Mechanism m = with_ground();
  const BodyRef part = add_part(m, 1, 2, {1, 1, 1, 0, 0, 0}, 1);
  m.markers = {{1, part, origin, z_along_x}, {2, ground, {-10, 0, 0}, z_along_x}};
  m.joints = {{1, JointType::translational, 1, 2}};
  const double v = 0.7;
  body(m, 1).v = Triple{v, 0, 0};
  const Expr z = dif(1);
  m.diffs = {{1, 0, square(z) * z + z - measure(Measure::DX, {1, 2}), DiffKind::algebraic, {}, true}};
  m.variables = {{1, z}, {2, dif1(1)}};
  m.poutput = {1, {1, 2}};
  const OracleLinearModel r = linearize_drawn(m, {rate(1, 0), value(1, 0)});
  const double g = 1.0 / 13, bend = -12 * g * g * g;  // z = 2; z'' over x is -6 z / (1 + 3 z^2)^3
  EXPECT_NEAR(r.outputs[0], 2, 1e-15);
  EXPECT_NEAR(r.outputs[1], v * g, 1e-15);
  expect_matrix(r.C, {{0, g}, {g, bend * v}}, 1e-13);
}

TEST(Oracle, net_force_of_a_marker_is_the_sum_of_what_names_it) {
  // A mass on a slide, pushed by a spring and an action-only force at the marker that hangs on the joint.
  Mechanism m = with_ground();
  m.gravity = {0, -10, 0};
  const BodyRef part = add_part(m, 1, 2, {1, 1, 1, 0, 0, 0}, 1);
  m.markers = {{1, part, {3, 0, 0}, origin},
               {2, part, {1, 0, 0}, z_along_x},
               {3, ground, origin, z_along_x},
               {4, ground, {0, 0, 0}, origin}};
  m.joints = {{1, JointType::translational, 2, 3}};
  m.springs = {{1, Direction::translational, 2, 4, 5, 0, 0, 3}};
  m.sforces = {{1, Direction::translational, Reaction::action_only, 2, 3, constant(4)}};
  const std::vector<Expr> read{marker_load(3, 2, 0, 0), marker_load(2, 2, 0, 0), marker_load(2, 2, 4, 0),
                               marker_load(2, 4, 2, 0), marker_load(8, 3, 2, 0), marker_load(2, 3, 0, 0),
                               spring_load(1, 1, 2, 0), marker_load(1, 2, 4, 0)};
  for (std::size_t k = 0; k < read.size(); ++k) {
    m.variables.push_back({static_cast<int>(k) + 1, read[k]});
    m.poutput.variables.push_back(static_cast<int>(k) + 1);
  }
  m.poutput.id = 1;
  const OracleLinearModel r = linearize_drawn(m, {rate(1, 0), value(1, 0)});
  const double expected[] = {20, 14, 10, -10, -60, 0, -10, 10};
  for (std::size_t k = 0; k < read.size(); ++k) EXPECT_NEAR(r.outputs[k], expected[k], 1e-12) << k;
}

}  // namespace
}  // namespace dynalin::oracle::functions_self_check
