// Curves and contacts of the oracle against their definitions and closed forms.
#include "curves.h"
#include "self_check.h"

namespace dynalin::oracle::contacts_self_check {
namespace {

void expect_near(const Vec& a, const Vec& b, double tolerance) {
  EXPECT_LT(static_cast<double>(norm(a - b)), tolerance);
}

NumberMatrix points(int id, const std::vector<Triple>& rows) {
  NumberMatrix m{id, static_cast<int>(rows.size()), 3, {}};
  for (const Triple& r : rows) m.values.insert(m.values.end(), r.begin(), r.end());
  return m;
}

const std::vector<Triple> bow{{-1, 0.2, 0.1},   {-0.4, -0.3, 0}, {0.1, 0.5, 0.3},
                              {0.4, 0.1, -0.2}, {0.8, 0.3, 0},   {1, -0.1, 0.2}};
const std::vector<Triple> ring{{1, 0, 0},       {0.4, 0.9, 0.2}, {-0.8, 0.7, 0}, {-0.9, -0.6, 0.1},
                               {0.2, -1, -0.3}, {0.8, -0.7, 0},  {1, 0, 0}};

TEST(Oracle, curves_pass_their_points) {
  for (const int order : {4, 5, 6}) {
    for (const bool closed : {false, true}) {
      const auto& rows = closed ? ring : bow;
      const CurveShape c({1, 1, closed, false, order}, points(1, rows));
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const Real u = -1 + 2 * static_cast<Real>(k) / static_cast<Real>(rows.size() - 1);
        expect_near(c.at(u), to_vec(rows[k]), 1e-14);
      }
    }
  }
}

// Six points of a polynomial of degree k - 1 in u give it back.
TEST(Oracle, open_curves_reproduce_polynomials) {
  for (const int order : {4, 5, 6}) {
    const auto polynomial = [&](Real u) { return Vec{u, std::pow(u, order - 1.0L), 1 - 2 * u + 3 * u * u}; };
    std::vector<Triple> rows;
    for (int k = 0; k < 6; ++k) rows.push_back(to_triple(polynomial(-1 + 0.4L * k)));
    const CurveShape c({1, 1, false, false, order}, points(1, rows));
    for (const Real u : {-0.93L, -0.31L, 0.17L, 0.78L}) expect_near(c.at(u), polynomial(u), 1e-14);
    expect_near(c.at(0.17L, 2), {0, (order - 1.0L) * (order - 2.0L) * std::pow(0.17L, order - 3.0L), 6}, 1e-13);
  }
}

TEST(Oracle, an_open_cubic_has_no_knot_next_to_its_ends) {
  const CurveShape c({1, 1, false, false, 4}, points(1, bow));
  for (const Real at : {-0.6L, 0.6L}) expect_near(c.at(at - 0.01L, 3), c.at(at + 0.01L, 3), 1e-13);
  EXPECT_GT(static_cast<double>(norm(c.at(-0.21L, 3) - c.at(-0.19L, 3))), 1);
  EXPECT_NEAR(static_cast<double>(c.clearance(-0.25L)), 0.05, 1e-15);
  EXPECT_NEAR(static_cast<double>(c.clearance(0.9L)), 0.1, 1e-15);
}

TEST(Oracle, closed_curves_go_on_smoothly) {
  for (const int order : {4, 5, 6}) {
    for (const bool controls : {false, true}) {
      const CurveShape c({1, 1, true, controls, order}, points(1, ring));
      for (int m = 0; m <= order - 2; ++m) {
        const Real start = order % 2 == 0 ? -1 : -1 - 1 / 6.0L;
        expect_near(c.at(start + 1e-15L, m), c.at(start + 2 - 1e-15L, m), 1e-10);
      }
      expect_near(c.at(0.3L), c.at(4.3L), 1e-14);
    }
  }
}

// Four control points of a cubic are those of Bezier; a closed cubic has a sixth, four sixths, a sixth at a knot.
TEST(Oracle, control_points_pull_the_curve) {
  const std::vector<Triple> four(bow.begin(), bow.begin() + 4);
  const CurveShape bezier({1, 1, false, true, 4}, points(1, four));
  const auto p = [](const std::vector<Triple>& list, std::size_t k) { return to_vec(list[k]); };
  const Real s = 0.3L, r = 1 - s;
  expect_near(bezier.at(2 * s - 1),
              r * r * r * p(four, 0) + 3 * r * r * s * p(four, 1) + 3 * r * s * s * p(four, 2) + s * s * s * p(four, 3),
              1e-15);
  const CurveShape six({1, 1, false, true, 4}, points(1, bow));
  expect_near(six.at(-1.0L, 1), (3 / (2 / 3.0L)) * (p(bow, 1) - p(bow, 0)), 1e-13);
  const CurveShape closed({1, 1, true, true, 4}, points(1, ring));
  expect_near(closed.at(-1.0L), (1 / 6.0L) * (p(ring, 5) + 4 * p(ring, 0) + p(ring, 1)), 1e-15);
}

std::vector<Triple> parabola(double a) {
  std::vector<Triple> rows;
  for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0}) rows.push_back({x, a * x * x, 0});
  return rows;
}

// omega^2 = 2 a g, less the square of the speed at which the wire turns about the vertical.
TEST(Oracle, bead_on_a_parabola_swings) {
  const double a = 1.7, g = 9.81;
  Mechanism m = with_ground();
  m.gravity = {0, -g, 0};
  Body bead;
  bead.ref = {BodyKind::point_mass, 1};
  bead.mass = 3, bead.cm = 1;
  m.bodies.push_back(bead);
  m.markers = {{1, bead.ref, origin, origin}, {2, ground, origin, origin}, {3, ground, origin, origin, true}};
  m.matrices = {points(1, parabola(a))};
  m.curves = {{1, 1}};
  m.contacts = {{1, false, 1, 2, 0, 3, 0, 1, 0, 0.05}};
  const ChosenState place{Kind::coordinate, 1, BodyKind::point_mass, 0, {}, 0, 1},
      speed{Kind::rate, 1, BodyKind::point_mass, 0, {}, 0, 1};
  expect_matrix(linearize_drawn(m, {speed, place}).A, {{0, -2 * a * g}, {1, 0}}, 1e-12);
  // Above the vertex by a x^2, at the speed v along the wire.
  Model model(m);
  model.motion[1].v = {2, 0, 0};
  model.update_velocities();
  EXPECT_NEAR(static_cast<double>(model.contact_speeds(0)[1]), 2, 1e-15);
}

// docs/elements/cvcv.md: omega^2 = m g (1/(2a) - H)/J, on a table that is a curve as well.
TEST(Oracle, parabola_rocks_on_a_table) {
  const double a = 0.8, H = 0.3, mass = 2, inertia = 0.4, g = 9.81;
  Mechanism m = with_ground();
  m.gravity = {0, -g, 0};
  const BodyRef part = add_part(m, 2, mass, {1, 1, inertia, 0, 0, 0}, 20);
  body(m, 2).qg = {0.2, 0, 0};
  m.markers = {{20, part, {0, H, 0}, origin},
               {21, part, origin, origin},
               {29, part, origin, origin, true},
               {1, ground, origin, origin},
               {9, ground, origin, origin, true}};
  m.joints = {{1, JointType::planar, 20, 1}};
  m.matrices = {points(1, parabola(a)), points(2, parabola(0))};
  m.curves = {{1, 1}, {2, 2}};
  m.contacts = {{1, true, 21, 1, 29, 9, 1, 2, 0.1, 0.1}};
  const Model model(m);
  EXPECT_NEAR(static_cast<double>(norm(model.contact_point(0) - Vec{0.2, 0, 0})), 0, 1e-15);
  // Turned by q about its BCS, the vertex, and shifted by x: the vertex stays on the table to first order.
  const OracleLinearModel r = linearize_drawn(m, {rate(2, 0), value(2, 0), rate(2, 5), value(2, 5)});
  const double w2 = mass * g * (1 / (2 * a) - H) / inertia;
  expect_matrix(r.A, {{0, 0, 0, -H * w2}, {1, 0, 0, 0}, {0, 0, 0, -w2}, {0, 0, 1, 0}}, 1e-11);
}

}  // namespace
}  // namespace dynalin::oracle::contacts_self_check
