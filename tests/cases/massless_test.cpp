// Freedoms without mass or inertia: LINEAR gives the limit of vanishing mass, in closed form and against small masses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases::massless_test {
namespace {

using ::testing::HasSubstr;
using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

// Where and how a model stands, and its units.
struct Stand {
  Vector at{};
  Matrix3 axes = Matrix3::identity();
  double length = 1, mass = 1, force = 1;  // in units of the dataset
  const char* units = "UNITS/SYSTEM=MKS";
};

Matrix3 turned() { return rotation_exponential(Vector{0.4, -0.9, 0.7}); }

// Bodies on a line, z of the stand, at z = 1, 2, …: PART/2, PART/3, … of given masses (none for 0), each sliding along
// it. Part p has the marker 10 p at its origin; ground has the marker 1 at the origin of the line.
std::string line(const std::vector<double>& masses, const std::string& more, const Stand& s = {}) {
  std::string text =
      fmt::format("On a line\n{}\nPART/1, GROUND\nMARKER/1, QP={}, REULER={}\n", s.units, xyz(s.at), reuler(s.axes));
  for (std::size_t k = 0; k < masses.size(); ++k) {
    const std::size_t p = k + 2;
    const Vector at = s.at + s.axes * Vector{0, 0, s.length * static_cast<double>(k + 1)};
    const std::string mass = masses[k] > 0 ? fmt::format(", MASS={:.17g}, CM={}", masses[k] * s.mass, 10 * p) : "";
    text += fmt::format("PART/{0}{1}, QG={2}, REULER={3}\nMARKER/{4}\nJOINT/{0}, TRANSLATIONAL, I={4}, J=1\n", p, mass,
                        xyz(at), reuler(s.axes), 10 * p);
  }
  return text + more + "END\n";
}
// A spring and damper between neighbours of the line, without load.
std::string link(int id, int i, int j, double k, double c, const Stand& s = {}) {
  const double stiffness = k * s.force / s.length, damping = c * s.force / s.length;
  return fmt::format("SPRINGDAMPER/{}, TRANSLATIONAL, I={}, J={}, K={:.17g}, C={:.17g}, LENGTH={:.17g}\n", id, i, j,
                     stiffness, damping, s.length);
}

class Massless : public Cases {
 protected:
  // rad per unit time, each pair twice
  std::vector<Complex> solve(const std::string& dataset, const std::string& before = "",
                             const std::string& options = "") const {
    const RunResult r = run(dataset, before + "LINEAR/EIGENSOL" + options + "\n");
    EXPECT_EQ(r.status, 0) << r.err;
    if (r.status != 0) return {};
    std::vector<Complex> values = r.eigenvalues(r.json.at("results").size() - 1);
    for (Complex& v : values) v *= 2 * pi;
    return values;
  }
  std::string refusal(const std::string& dataset, const std::string& commands = "LINEAR/EIGENSOL\n") const {
    const RunResult r = run(dataset, commands);
    EXPECT_EQ(r.status, 2) << r.out;
    return r.err;
  }
};

// Roots of a polynomial with real coefficients, highest power first, by simultaneous iteration.
std::vector<Complex> roots(std::vector<Complex> p) {
  const std::size_t n = p.size() - 1;
  const Complex lead = p[0];
  double size = 0;
  for (Complex& c : p) c /= lead;
  for (std::size_t k = 1; k <= n; ++k) size = std::max(size, std::pow(std::abs(p[k]), 1.0 / static_cast<double>(k)));
  std::vector<Complex> z(n);
  for (std::size_t k = 0; k < n; ++k) z[k] = size * std::pow(Complex(0.4, 0.9), static_cast<double>(k));
  for (int i = 0; i < 500; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      Complex value = 1, slope = 1;
      for (std::size_t c = 1; c <= n; ++c) value = value * z[k] + p[c];
      for (std::size_t j = 0; j < n; ++j) {
        if (j != k) slope *= z[k] - z[j];
      }
      z[k] -= value / slope;
    }
  }
  return z;
}

// Eigenvalues are as exact as those of any model: a few hundred roundings.
constexpr double exact = 1e-12;

TEST_F(Massless, a_point_between_two_springs_joins_them_in_series) {
  const std::string springs = link(1, 20, 1, 300, 0) + link(2, 30, 20, 600, 0);
  expect_same(solve(line({0, 2}, springs)), {{0, 10}, {0, -10}}, exact);
  const RunResult r = run(line({0, 2}, springs), "LINEAR/EIGENSOL\n");
  EXPECT_THAT(r.labels(0), ::testing::Each(HasSubstr("DZ")));
  EXPECT_EQ(r.labels(0).size(), 2u);
  EXPECT_THAT(r.err, HasSubstr("Global displacement DZ(BCS) of PART/2 has no mass and is held by stiffness alone"));
}

TEST_F(Massless, two_points_in_a_row_are_condensed_both) {
  const std::string springs = link(1, 20, 1, 300, 0) + link(2, 30, 20, 600, 0) + link(3, 40, 30, 200, 0);
  expect_same(solve(line({0, 0, 1}, springs)), {{0, 10}, {0, -10}}, exact);
}

TEST_F(Massless, a_point_on_a_damper_is_of_first_order) {
  const double m = 2, k = 50, c = 7, K = 90;
  const std::string more = link(1, 20, 1, 0, c) + link(2, 30, 20, k, 0) +
                           fmt::format("SPRINGDAMPER/3, TRANSLATIONAL, I=30, J=1, K={}, C=0, LENGTH=2\n", K);
  // (m λ² + K)(c λ + k) + k c λ = 0
  expect_same(solve(line({0, m}, more)), roots({m * c, m * k, K * c + k * c, K * k}), exact);
  const RunResult r = run(line({0, m}, more), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.labels(0).size(), 3u);
  EXPECT_THAT(r.err, HasSubstr("of PART/2 has no mass: its velocity follows"));
}

TEST_F(Massless, a_spring_and_a_damper_in_parallel_between_masses_keep_their_first_order) {
  const double m = 2, c1 = 7, k1 = 20, c2 = 3, k2 = 50;
  // (c₁λ + k₁) y = (c₂λ + k₂)(x − y),  m λ² x = −(c₂λ + k₂)(x − y)
  const double c = c1 + c2, k = k1 + k2;
  expect_same(solve(line({0, m}, link(1, 20, 1, k1, c1) + link(2, 30, 20, k2, c2))),
              roots({m * c, m * k + c1 * c2, c1 * k2 + k1 * c2, k1 * k2}), exact);
}

TEST_F(Massless, a_mixed_row_of_points_has_each_its_own_order) {
  const double m = 1.5, c = 4;
  const std::vector<double> k = {80, 60, 40};
  // ground –k₀– a (condensed) –k₁– b, damper c to the ground, –k₂– mass
  const std::string more = link(1, 20, 1, k[0], 0) + link(2, 30, 20, k[1], 0) + link(3, 40, 30, k[2], 0) +
                           fmt::format("SPRINGDAMPER/4, TRANSLATIONAL, I=30, J=1, K=0, C={}, LENGTH=2\n", c);
  const double s = k[0] * k[1] / (k[0] + k[1]);
  // (c λ + s + k₂) b = k₂ x,  (m λ² + k₂) x = k₂ b
  expect_same(solve(line({0, 0, m}, more)), roots({m * c, m * (s + k[2]), k[2] * c, k[2] * s}), exact);
}

TEST_F(Massless, two_points_that_a_damper_joins_have_one_state) {
  const double ka = 30, kb = 20, c = 4;
  // c (a′ − b′) + k_a a = 0 and k_a a + k_b b = 0
  const std::string more = link(1, 20, 1, ka, 0) + link(2, 30, 20, 0, c) +
                           fmt::format("SPRINGDAMPER/3, TRANSLATIONAL, I=30, J=1, K={}, C=0, LENGTH=2\n", kb);
  expect_same(solve(line({0, 0}, more)), {{-ka * kb / (c * (ka + kb)), 0}}, exact);
}

// Axes that are turned by right angles leave 6e-17 where zero is meant.
TEST_F(Massless, dampers_across_the_freedom_do_not_damp_it) {
  const std::string across =
      "PART/9\nMARKER/90, REULER=1.5707963267948966,1.5707963267948966,0\nMARKER/91, PART=1, "
      "REULER=1.5707963267948966,1.5707963267948966,0\nJOINT/9, TRANSLATIONAL, I=90, J=91\n"
      "FIELD/1, I=90, J=91, KMATRIX=5,0,0,0,0,0, 0,5,0,0,0,0, 0,0,{0},0,0,0, 0,0,0,1,0,0, 0,0,0,0,1,0, 0,0,0,0,0,1, "
      "CMATRIX=3,0,0,0,0,0, 0,3,0,0,0,0, 0,0,0,0,0,0, 0,0,0,1,0,0, 0,0,0,0,1,0, 0,0,0,0,0,1\n";
  const RunResult r =
      run(line({0, 2}, link(1, 20, 1, 300, 0) + link(2, 30, 20, 600, 0) + fmt::format(fmt::runtime(across), 7)),
          "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.labels(0).size(), 2u);
  EXPECT_THAT(refusal(line({2}, fmt::format(fmt::runtime(across), 0))), HasSubstr("PART/9"));
}

TEST_F(Massless, what_moves_and_turns_rigidly_or_changes_units_keeps_its_spectrum) {
  const Stand tilted{{3, -40, 7}, turned()};
  const Stand millimetres{
      {3000, -40, 7}, turned(), 1000, 1, 1, "UNITS/FORCE=NEWTON, LENGTH=MILLIMETER, MASS=KILOGRAM, TIME=SECOND"};
  const Stand tonnes{{}, turned(), 1000, 1e-3, 1, "UNITS/UCF=1"};
  const auto model = [](const Stand& s) {
    return line({0, 2, 0, 3},
                link(1, 20, 1, 300, 4, s) + link(2, 30, 20, 500, 1, s) + link(3, 40, 30, 200, 0, s) +
                    link(4, 50, 40, 700, 0, s),
                s);
  };
  const auto reference = solve(model({}));
  ASSERT_EQ(reference.size(), 5u);
  for (const Stand& s : {tilted, millimetres, tonnes}) expect_same(solve(model(s)), reference, 1e-11);
}

TEST_F(Massless, coordinates_relative_to_the_point_itself_give_the_same_spectrum) {
  const std::string springs = link(1, 20, 1, 300, 0) + link(2, 30, 20, 600, 0);
  const std::string dampers = link(1, 20, 1, 300, 5) + link(2, 30, 20, 600, 3);
  for (const std::string& more : {springs, dampers}) {
    const auto reference = solve(line({0, 2}, more));
    for (const char* rm : {", RM=20", ", RM=30", ", ORIGINAL"})
      expect_same(solve(line({0, 2}, more), "", rm), reference, exact);
  }
}

TEST_F(Massless, a_rod_without_mass_is_a_plain_pendulum) {
  const RunResult r = run(
      "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1, REULER=0,1.5707963267948966,0\n"
      "PART/2, QG=0,0,0\nMARKER/20, REULER=0,1.5707963267948966,0\nMARKER/21, QP=0,0,-0.7\nJOINT/1, REVOLUTE, I=20, "
      "J=1\nPART/3, MASS=4, CM=30, QG=0,0,-0.7\nMARKER/30\nJOINT/2, FIXED, I=30, J=21\nEND\n",
      "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.err.find("no mass"), std::string::npos) << "nothing without mass moves by itself";
  expect_eigenvalues(r.eigenvalues(0), {{0, std::sqrt(9.81 / 0.7) / (2 * pi)}}, exact);
}

// A part on a ball with inertia about x and y only, held by torsion springs and a spring or damper about its own axis.
std::string spindle(const Matrix3& axes, double k, double c, double inertia = 0) {
  return fmt::format(
      "Spindle\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER={0}\nPART/2, MASS=3, CM=20, IP=0.5,0.8,{1}, "
      "REULER={0}\nMARKER/20\nJOINT/1, SPHERICAL, I=20, J=1\n"
      "GFORCE/1, I=20, JFLOAT=11, RM=1, FX=0\\FY=0\\FZ=0\\TX=-20*AX(20,1)\\TY=-50*AY(20,1)\\TZ={2}*AZ(20,1)"
      "{3:+}*WZ(20,1,1)\nMARKER/11, FLOATING, PART=1\nEND\n",
      reuler(axes), inertia, -k, -c);
}

TEST_F(Massless, a_part_without_inertia_about_its_axis_turns_about_it_without_inertia) {
  const double a = std::sqrt(20 / 0.5), b = std::sqrt(50 / 0.8);
  const std::vector<Complex> others = {{0, a}, {0, -a}, {0, b}, {0, -b}};
  for (const Matrix3& axes : {Matrix3::identity(), turned()}) {
    expect_same(solve(spindle(axes, 3, 0)), others, exact);
    auto first_order = others;
    first_order.emplace_back(-3 / 0.25);
    expect_same(solve(spindle(axes, 3, 0.25)), first_order, exact);
    EXPECT_THAT(refusal(spindle(axes, 0, 0)), HasSubstr("PART/2"));
  }
}

TEST_F(Massless, small_masses_are_ordinary_numbers) {
  const auto values = solve(line({1e-30, 2}, link(1, 20, 1, 300, 0) + link(2, 30, 20, 600, 0)));
  ASSERT_EQ(values.size(), 4u);
  double fastest = 0;
  for (const Complex& v : values) fastest = std::max(fastest, std::abs(v));
  EXPECT_NEAR(fastest, std::sqrt(900 / 1e-30), 1e-9 * fastest);
}

TEST_F(Massless, what_nothing_determines_is_refused_by_name) {
  const std::string err = refusal(line({0, 2}, link(2, 30, 1, 600, 0)));
  EXPECT_THAT(err, HasSubstr("nothing fixes DZ of PART/2"));
  // Damping alone is no help where NODAMPIN takes it out.
  const std::string damped = line({0, 2}, link(1, 20, 1, 0, 4) + link(2, 30, 1, 600, 0));
  EXPECT_EQ(run(damped, "LINEAR/EIGENSOL\n").status, 0);
  EXPECT_THAT(refusal(damped, "LINEAR/EIGENSOL, NODAMPIN\n"), HasSubstr("NODAMPIN"));
}

TEST_F(Massless, without_damping_a_damped_point_is_condensed) {
  const std::string more = link(1, 20, 1, 300, 5) + link(2, 30, 20, 600, 3);
  expect_same(solve(line({0, 2}, more), "", ", NODAMPIN"), {{0, 10}, {0, -10}}, exact);
}

TEST_F(Massless, a_pose_out_of_balance_is_refused_and_statics_brings_balance) {
  const std::string model = line({0, 2},
                                 "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=300, C=0, LENGTH=0.8\n"
                                 "SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=600, C=0, LENGTH=1\n");
  const std::string err = refusal(model);
  EXPECT_THAT(err, HasSubstr("DZ of PART/2 has neither mass nor damping"));
  EXPECT_THAT(err, HasSubstr("SIMULATE/STATIC"));
  expect_same(solve(model, "SIMULATE/STATIC\n"), {{0, 10}, {0, -10}}, 1e-9);
}

TEST_F(Massless, a_loaded_damper_moves_with_the_velocity_of_balance) {
  // Force 6 on a damper of slope c(v) = 1 + 2 v: v + v² = 6, v = 2, slope 5; spring 10 beside it.
  const std::string model =
      line({0}, "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=6-VZ(20)-VZ(20)**2-10*(DZ(20,1)-1)\n");
  expect_same(solve(model), {{-10.0 / 5.0, 0}}, 1e-11);
}

TEST_F(Massless, a_stated_velocity_gives_way_to_balance_with_a_warning) {
  std::string model = line({0, 2}, link(1, 20, 1, 0, 5) + link(2, 30, 20, 600, 0));
  model.insert(model.find("PART/2") + 6, ", VZ=3, VM=1");
  const RunResult r = run(model, "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("the initial velocity of DZ of PART/2 is changed from 3 to 0"));
}

TEST_F(Massless, inputs_and_outputs_pass_through_a_condensed_point) {
  const double k1 = 300, k2 = 600, m = 2, k = k1 + k2;
  const RunResult r = run(line({0, m}, link(1, 20, 1, k1, 0) + link(2, 30, 20, k2, 0) +
                                           "VARIABLE/1, FUNCTION=0\nVARIABLE/2, FUNCTION=DZ(20,1)\n"
                                           "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=VARVAL(1)\n"
                                           "PINPUT/1, VARIABLES=1\nPOUTPUT/1, VARIABLES=2\n"),
                          "LINEAR/STATEMAT, FILE=m, PINPUT=1, POUTPUT=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  // x₂ = (k₂ x₃ + u)/k,  m x₃″ = k₂(x₂ − x₃)
  const auto A = r.matrix(0, "A"), B = r.matrix(0, "B"), C = r.matrix(0, "C"), D = r.matrix(0, "D");
  expect_close(A[0][1], -k1 * k2 / k / m, exact);
  expect_close(B[0][0], k2 / k / m, exact);
  expect_close(C[0][1], k2 / k, exact);
  expect_close(C[0][0], 0, exact);
  expect_close(D[0][0], 1 / k, exact);
}

TEST_F(Massless, velocities_and_accelerations_of_points_are_exact_outputs) {
  const double k1 = 300, k2 = 600, c1 = 7, c2 = 3, m = 2, k = k1 + k2;
  const std::string outputs =
      "VARIABLE/1, FUNCTION=VZ(20,1)\nVARIABLE/2, FUNCTION=ACCZ(20,1)\nPOUTPUT/1, VARIABLES=1,2\n";
  const std::string statemat = "LINEAR/STATEMAT, FILE=m, POUTPUT=1\n";
  const RunResult r = run(line({0, m}, link(1, 20, 1, k1, 0) + link(2, 30, 20, k2, 0) + outputs), statemat);
  ASSERT_EQ(r.status, 0) << r.err;
  const auto C = r.matrix(0, "C");
  expect_close(C[0][0], k2 / k, exact);
  expect_close(C[0][1], 0, exact);
  expect_close(C[1][0], 0, exact);
  expect_close(C[1][1], -k2 / k * (k1 * k2 / k / m), exact);
  // With dampers y′ = (c₂ v + k₂ x − k y)/c, and y″ follows from it.
  const RunResult d = run(line({0, m}, link(1, 20, 1, k1, c1) + link(2, 30, 20, k2, c2) + outputs), statemat);
  ASSERT_EQ(d.status, 0) << d.err;
  const double c = c1 + c2;
  const std::array<double, 3> rate = {c2 / c, k2 / c, -k / c};  // of v, x, y
  // m v′ = −c₂(v − y′) − k₂(x − y)
  const std::array<double, 3> a = {(-c2 + c2 * rate[0]) / m, (-k2 + c2 * rate[1]) / m, (k2 + c2 * rate[2]) / m};
  const auto D = d.matrix(0, "C");
  const auto states = d.result(0).at("states");
  for (std::size_t s = 0; s < 3; ++s) {
    const int part = states[s].at("element"), coordinate = states[s].at("coordinate");
    const std::size_t mine = part == 2 ? 2 : coordinate > 6 ? 0 : 1;
    const double second = (c2 * a[mine] + (mine == 0 ? k2 : 0) - k * rate[mine]) / c;
    expect_close(D[0][s], rate[mine], exact);
    expect_close(D[1][s], second, exact);
  }
}

TEST_F(Massless, a_rate_that_needs_the_rate_of_an_input_is_refused) {
  EXPECT_THAT(refusal(line({0, 2}, link(1, 20, 1, 300, 0) + link(2, 30, 20, 600, 0) +
                                       "VARIABLE/1, FUNCTION=0\nVARIABLE/2, FUNCTION=VZ(20,1)\n"
                                       "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=VARVAL(1)\n"
                                       "PINPUT/1, VARIABLES=1\nPOUTPUT/1, VARIABLES=2\n"),
                      "LINEAR/STATEMAT, FILE=m, PINPUT=1, POUTPUT=1\n"),
              HasSubstr("VARIABLE/2 reads a rate or an acceleration of a freedom without mass"));
}

TEST_F(Massless, in_motion_a_condensed_point_is_exact_where_nothing_reads_its_rate) {
  const auto moving = [](const std::string& more) {
    std::string model = line({0, 2}, link(1, 20, 1, 300, 0) + link(2, 30, 20, 600, 0) + more);
    return model.insert(model.find("PART/3") + 6, ", VZ=1.5, VM=1");
  };
  expect_same(solve(moving("")), {{0, 10}, {0, -10}}, exact);
  EXPECT_THAT(refusal(moving("VARIABLE/1, FUNCTION=VZ(20,1)\nPOUTPUT/1, VARIABLES=1\n"),
                      "LINEAR/STATEMAT, FILE=m, POUTPUT=1\n"),
              HasSubstr("VARIABLE/1 reads a rate or an acceleration of a freedom without mass"));
}

TEST_F(Massless, negative_damping_of_a_point_gives_the_formal_limit_and_a_warning) {
  const double m = 2, k = 50, c = -7, K = 90;
  const std::string more = fmt::format("SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION={}*VZ(20,1)\n", -c) +
                           link(2, 30, 20, k, 0) +
                           fmt::format("SPRINGDAMPER/3, TRANSLATIONAL, I=30, J=1, K={}, C=0, LENGTH=2\n", K);
  expect_same(solve(line({0, m}, more)), roots({m * c, m * k, K * c + k * c, K * k}), exact);
  EXPECT_THAT(run(line({0, m}, more), "LINEAR/EIGENSOL\n").err,
              HasSubstr("damping of freedoms without mass drives them on (DZ of PART/2)"));
}

TEST_F(Massless, controllers_drive_points_without_mass) {
  // z′ = −3 z + x₃ pushes the point: x₂ = (k₂ x₃ + 40 z)/k.
  const double k1 = 300, k2 = 600, m = 2, k = k1 + k2;
  const std::string springs = link(1, 20, 1, k1, 0) + link(2, 30, 20, k2, 0);
  const std::string diff =
      "DIFF/1, IC=0, FUNCTION=-3*DIF(1)+DZ(30,1)-2\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, "
      "J=1, FUNCTION=40*DIF(1)\n";
  // (m λ² + s)(λ + 3) − 40 k₂/k = 0
  const auto expected = roots({m, 3 * m, k1 * k2 / k, 3 * k1 * k2 / k - 40 * k2 / k});
  expect_same(solve(line({0, m}, springs + diff)), expected, exact);
  const std::string tfsiso =
      "VARIABLE/1, FUNCTION=DZ(30,1)-2\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\nTFSISO/1, U=1, X=2, Y=3, "
      "NUMERATOR=1, DENOMINATOR=3,1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=40*ARYVAL(3,1)\n";
  expect_same(solve(line({0, m}, springs + tfsiso)), expected, exact);
}

TEST_F(Massless, second_order_matrices_give_the_points_rows_of_first_order) {
  const double m = 2, k1 = 20, c1 = 7, k2 = 50;
  const RunResult r = run(line({0, m}, link(1, 20, 1, k1, c1) + link(2, 30, 20, k2, 0)), "LINEAR/MKB, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto M = r.matrix(0, "M"), B = r.matrix(0, "B"), K = r.matrix(0, "K");
  // s = (x₃, x₂): x₃″ + k₂/m (x₃ − x₂) = 0,  x₂′ + (k₁ + k₂)/c₁ x₂ − k₂/c₁ x₃ = 0
  EXPECT_EQ(M[0][0], 1);
  EXPECT_EQ(M[1][1], 0);
  expect_close(K[0][0], k2 / m, exact);
  expect_close(K[0][1], -k2 / m, exact);
  expect_close(K[1][0], -k2 / c1, exact);
  expect_close(K[1][1], (k1 + k2) / c1, exact);
  EXPECT_EQ(B[0][0], 0);
  EXPECT_EQ(B[1][1], 1);
  EXPECT_THAT(r.message, ::testing::HasSubstr("        3 kinematic states"));
  const RunResult condensed = run(line({0, m}, link(1, 20, 1, k1, 0) + link(2, 30, 20, k2, 0)), "LINEAR/MKB, FILE=m\n");
  ASSERT_EQ(condensed.status, 0) << condensed.err;
  expect_close(condensed.matrix(0, "K")[0][0], k1 * k2 / (k1 + k2) / m, exact);
}

TEST_F(Massless, tables_of_modes_know_what_points_do) {
  const RunResult r = run(line({0, 2}, link(1, 20, 1, 300, 6) + link(2, 30, 20, 600, 0)),
                          "LINEAR/EIGENSOL, KINETIC=1,3, STRAIN=1,3, DISSIPAT=1,3, COORDS=1,3, TABLE_PRECISION=8\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const RunResult masses = run(line({0, 2}, link(1, 20, 1, 300, 0) + link(2, 30, 20, 600, 0)),
                               "LINEAR/EIGENSOL, ENERGY_PER_MODE=ALL, MASS_PER_MODE=ALL\n");
  EXPECT_EQ(masses.status, 0) << masses.err;
}

// A chain in space: a heavy body hangs on two links without mass, of which the lower one is held by its load alone, in
// a wind of springs that load it. `mass` and `inertia` of the links go to zero.
std::string loaded_links(double mass) {
  const std::string of = mass > 0 ? fmt::format(", MASS={0:.17g}, IP={0:.17g},{0:.17g},{0:.17g}, CM=", mass) : "";
  const auto link = [&](const char* cm) { return mass > 0 ? of + cm : std::string(); };
  return fmt::format(
      "Links\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=0.7, JGRAV=-0.4, KGRAV=-9.81\nPART/1, GROUND\nMARKER/1, QP=0.1,0.2,2\n"
      "MARKER/2, QP=1,0.3,0.4\nMARKER/3, QP=-0.8,0.9,0.5\nMARKER/4, QP=-0.2,-1.1,0.9\n"
      "PART/2{}, QG=0.1,0.2,2\nMARKER/20\nMARKER/21, QP=0,0,-0.8\nMARKER/22, QP=0.1,0,-0.4\n"
      "PART/3, MASS=5, CM=30, IP=0.3,0.2,0.4, QG=0.1,0.2,0.6\nMARKER/30\nMARKER/31, QP=0,0,0.6\n"
      "MARKER/32, QP=0.2,0.1,-0.1\nJOINT/1, SPHERICAL, I=20, J=1\nJOINT/2, SPHERICAL, I=31, J=21\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=22, J=2, K=60, C=0, LENGTH=0.5\n"
      "SPRINGDAMPER/2, TRANSLATIONAL, I=32, J=3, K=80, C=1, LENGTH=0.6\n"
      "SPRINGDAMPER/3, TRANSLATIONAL, I=30, J=4, K=50, C=0.5, LENGTH=0.9\n"
      "SPRINGDAMPER/4, TRANSLATIONAL, I=22, J=30, K=30, C=0, LENGTH=0.3\nEND\n",
      link("22"));
}

// The eigenvalue of `from` nearest to one.
Complex nearest(const std::vector<Complex>& from, const Complex& to) {
  return *std::min_element(from.begin(), from.end(),
                           [&](auto a, auto b) { return std::abs(a - to) < std::abs(b - to); });
}

TEST_F(Massless, links_in_space_under_load_are_the_limit_of_small_masses) {
  const auto limit = solve(loaded_links(0), "SIMULATE/STATIC\n");
  // Gravity moves the equilibrium with the mass, in first order; so Richardson of 1e-6 and 1e-7 leaves 1e-12 of the
  // second order, and what statics leaves.
  const auto coarse = solve(loaded_links(1e-6), "SIMULATE/STATIC\n");
  const auto fine = solve(loaded_links(1e-7), "SIMULATE/STATIC\n");
  ASSERT_GT(limit.size(), 6u);
  ASSERT_LT(limit.size(), coarse.size());
  for (const Complex& v : limit) {
    const Complex a = nearest(coarse, v), b = nearest(fine, v);
    EXPECT_LE(std::abs(v - (10.0 * b - a) / 9.0), 2e-8 * std::abs(v)) << v << " " << a << " " << b;
  }
}

// A lever of no mass that turns with a damper, θ′ = −(3 + 2) θ/2, pushes a slider that hangs between two equal springs:
// of turns and displacements the lever has 1, the slider half.
TEST_F(Massless, what_moves_most_is_found_by_displacements_and_turns) {
  const RunResult r = run(
      "Lever and slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,1,0, REULER=90D,90D,0\n"
      "MARKER/3, QP=-1,1,0\nPART/2\nMARKER/20, PART=2\nMARKER/21, PART=2, QP=0,1,0\nJOINT/1, REVOLUTE, I=20, J=1\n"
      "PART/3, QG=1,1,0\nMARKER/30, PART=3\nMARKER/31, PART=3, REULER=90D,90D,0\nJOINT/2, TRANSLATIONAL, I=31, J=2\n"
      "SPRINGDAMPER/1, ROTATION, I=20, J=1, KT=3, CT=2\nSPRINGDAMPER/2, TRANSLATION, I=30, J=21, K=4, LENGTH=1\n"
      "SPRINGDAMPER/3, TRANSLATION, I=30, J=3, K=4, LENGTH=2\nEND\n",
      "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(r.eigenvalues(0)[0].real(), -2.5 / (2 * pi), 1e-14);
  EXPECT_EQ(r.result(0).at("modes")[0].at("moves_most"), "PART/2");
}

// A wheel that turns about its centre pushes a rack twice as far, wherever the BCS of the wheel is.
TEST_F(Massless, what_moves_most_is_found_by_the_mass_centre_and_not_the_origin) {
  const RunResult r =
      run("Wheel and rack\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, REULER=90D,90D,0\n"
          "PART/2, QG=10,0,0, CM=20\nMARKER/20, QP=-10,0,0\nPART/3, CM=30\nMARKER/30, REULER=90D,90D,0\n"
          "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, TRANSLATIONAL, I=30, J=2\n"
          "COUPLER/1, JOINTS=1,2, TYPE=R:T, SCALES=1,0.5\nSPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=2, CT=1\nEND\n",
          "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(0).at("modes")[0].at("moves_most"), "PART/3");
}

}  // namespace
}  // namespace dynalin::cases::massless_test
