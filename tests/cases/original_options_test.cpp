// ORIGINAL and its environment variables, each alone and together: the dropped coupling of differential states to
// rates, the static solution taken as it was found. Expected values come from closed forms.
#include <gmock/gmock.h>

#include "cases/original_cases.h"
#include "cases/study_of.h"

namespace dynalin::cases::original_options_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Complex = std::complex<double>;
using OriginalOptions = OriginalCases;

// Each variable alone and together on one model: a hanging pendulum that turns at the rate w, with a torque −c α′² and
// z′ = a α′ − d z. In α:  α″ = −κ α − 2 (c/J) w α′, and at rest without the second term; in X = l sin α, κ grows by w².
TEST_F(OriginalOptions, every_combination_of_variables_by_hand) {
  const Pendulum p;
  const double w = 1.3, c = 0.4, a = 0.9, d = 0.7;
  const std::string model = p.text(0, w,
                                   fmt::format("SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=-{}*WZ(21,1)**2\nDIFF/1, "
                                               "FUNCTION={}*WZ(21,1)-{}*DIF(1)\n",
                                               c, a, d));
  for (int set = 0; set < 9; ++set) {
    const bool original = set == 8;
    const bool principal = original || (set & 1), dropped = original || (set & 2), as_found = original || (set & 4);
    std::optional<Variable> first, second, third;
    if (!original && principal) first.emplace(pbcs_states);
    if (!original && dropped) second.emplace(nodamp_diff, "");
    if (!original && as_found) third.emplace(no_checks, "0");
    const std::string word = original ? ", ORIGINAL" : "";
    const RunResult r =
        run(model, "SIM/STAT\nLINEAR/MKB, FILE=a" + word + "\nLINEAR/MKB, FILE=b, NODAMPIN" + word + "\n");
    ASSERT_EQ(r.status, 0) << r.err;
    for (const std::size_t k : {1u, 2u}) {
      const bool no_damping = k == 2;
      const double rate = as_found ? 0 : w;
      const double damping = no_damping ? 0 : 2 * c / p.J() * rate;
      const double stiffness = p.kappa() + (principal ? rate * rate : 0);
      const double seen = no_damping && dropped ? 0 : a / (principal ? p.l : 1);
      SCOPED_TRACE(fmt::format("combination {}, damping {}", set, !no_damping));
      expect_matrices(r.matrix(k, "M"), {{1, 0}, {0, 0}}, 1e-13);
      expect_matrices(r.matrix(k, "B"), {{damping, 0}, {-seen, 1}}, 1e-12);
      expect_matrices(r.matrix(k, "K"), {{stiffness, 0}, {0, d}}, 1e-12);
      EXPECT_EQ(codes(r, k)[0], principal ? (std::array{1, 2, 1}) : (std::array{21, 2, 6}));
      EXPECT_EQ(codes(r, k)[1], (std::array{5, 1, 1}));
    }
    const auto told = [&](const char* name) { return HasSubstr(fmt::format("environment variable {} is set", name)); };
    EXPECT_EQ(::testing::Matches(told(pbcs_states))(r.err), !original && principal);
    EXPECT_EQ(::testing::Matches(told(nodamp_diff))(r.message), !original && dropped);
    EXPECT_EQ(::testing::Matches(told(no_checks))(r.message), !original && as_found);
  }
}

TEST_F(OriginalOptions, coupling_to_rates_goes_with_damping_only) {
  // m x″ = −k x − c x′ + h z,  z′ = a x′ + b x + d z. Without damping and coupling: λ³ − dλ² + k/m λ − (k d + b h)/m =
  // 0; with the coupling the term in λ is k/m − a h/m.
  const double m = 2, k = 50, a = 0.8, b = -1.5, d = -0.6, h = 3;
  const std::string model = fmt::format(
      "Slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS={}, CM=20, IP=1,1,1\nMARKER/20\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nDIFF/1, FUNCTION={}*VZ(20)+{}*DZ(20)+({})*DIF(1)\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-{}*DZ(20)-5*VZ(20)+{}*DIF(1)\nEND\n",
      m, a, b, d, k, h);
  const auto polynomial = [&](Complex hz, double coupling, double damping) {
    const Complex s = hz * two_pi;
    // (λ² + c/m λ + k/m)(λ − d) = h/m (a λ + b)
    return (s * s + damping / m * s + k / m) * (s - d) - h / m * (coupling * s + b);
  };
  const auto check = [&](const RunResult& r, std::size_t at, double coupling, double damping) {
    ASSERT_EQ(r.eigenvalues(at).size(), 3u);
    for (const Complex& value : r.eigenvalues(at)) {
      EXPECT_LT(std::abs(polynomial(value, coupling, damping)), 1e-11) << "result " << at;
      EXPECT_GT(std::abs(polynomial(value, coupling - 0.1, damping)), 1e-3);
    }
  };
  const std::string commands =
      "LINEAR/EIGENSOL\nLINEAR/EIGENSOL, NODAMPIN\nLINEAR/EIGENSOL, ORIGINAL\nLINEAR/EIGENSOL, NODAMPIN, ORIGINAL\n";
  const RunResult plain = run(model, commands);
  ASSERT_EQ(plain.status, 0) << plain.err;
  check(plain, 0, a, 5);
  check(plain, 1, a, 0);
  check(plain, 2, a, 5);
  check(plain, 3, 0, 0);
  const Variable variable(nodamp_diff);
  const RunResult set = run(model, commands);
  check(set, 0, a, 5);
  check(set, 1, 0, 0);
}

TEST_F(OriginalOptions, a_held_state_keeps_the_rate_that_the_static_solution_gave_it) {
  // Force −k x (1 + 0.01 z′²): statics has z′ = 0, but z = 2 is held and z′ = −3 z = −6 once it moves.
  const std::string model =
      "Held\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nDIFF/1, IC=2, STATIC_HOLD, FUNCTION=-3*DIF(1)\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-50*DZ(20)*(1+0.01*DIF1(1)**2)\nEND\n";
  const double decay = -3 / two_pi;
  const Complex found(0, std::sqrt(50.0 / 2) / two_pi), reconciled(0, std::sqrt(50 * 1.36 / 2) / two_pi);
  const RunResult r = run(
      model,
      "SIM/STAT\nLINEAR/EIGENSOL\nLINEAR/EIGENSOL, ORIGINAL\nLINEAR/EIGENSOL\nSIM/INIT\nLINEAR/EIGENSOL, ORIGINAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(1), {decay, reconciled}, 1e-12);
  expect_eigenvalues(r.eigenvalues(2), {decay, found}, 1e-12);
  expect_eigenvalues(r.eigenvalues(3), {decay, reconciled}, 1e-12);
  // Initial conditions came last: they reconcile.
  expect_eigenvalues(r.eigenvalues(5), {decay, reconciled}, 1e-12);
  // With no analysis before it there is nothing to take over.
  const RunResult alone = run(model, "LINEAR/EIGENSOL, ORIGINAL\n");
  ASSERT_EQ(alone.status, 0) << alone.err;
  expect_eigenvalues(alone.eigenvalues(0), {decay, reconciled}, 1e-12);
  const Variable variable(no_checks);
  const RunResult set = run(model, "SIM/STAT\nLINEAR/EIGENSOL\n");
  expect_eigenvalues(set.eigenvalues(1), {decay, found}, 1e-12);
}

TEST_F(OriginalOptions, tables_belong_to_the_point_that_was_linearized) {
  // At rest the damper −c α′² dissipates nothing; with the restored rate it does.
  const Pendulum p;
  const RunResult r = run(p.text(0, 1.3, "SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=-0.4*WZ(21,1)**2\n"),
                          "SIM/STAT\nLINEAR/EIGENSOL, ORIGINAL, DISSIPAT=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(1), {Complex(0, std::sqrt(p.kappa()) / two_pi)}, 1e-12);
  EXPECT_THAT(r.text("model.txt"), HasSubstr("SFOR/1"));
  EXPECT_THAT(r.text("model.txt"), Not(HasSubstr("100.00")));
}

TEST_F(OriginalOptions, library_has_options_and_looks_at_no_environment) {
  const Pendulum p;
  const double w = 1.3;
  const Variable all_set[] = {Variable(pbcs_states), Variable(nodamp_diff), Variable(no_checks), Variable(no_restore)};
  const auto study = study_of(p.text(0, w));
  auto point = study.static_equilibrium();
  const auto matrices = [&](const LinearRequest& request) { return study.linearize(point, request).state_space(); };
  const auto stiffness = [&](const LinearRequest& request) { return -matrices(request).A(0, 1); };
  LinearRequest request;
  EXPECT_NEAR(stiffness(request), p.kappa(), 1e-12);
  EXPECT_EQ(matrices(request).states[0].type, StateType::part);
  request.principal_states = true;
  EXPECT_NEAR(stiffness(request), p.kappa() + w * w, 1e-12);
  EXPECT_EQ(matrices(request).states[0].type, StateType::part_euler);
  request.without_reconciliation = true;
  EXPECT_NEAR(stiffness(request), p.kappa(), 1e-12);
  EXPECT_FALSE(study.linearize(point, request).modes().original);
  LinearRequest original;
  original.original = true;
  EXPECT_NEAR(stiffness(original), p.kappa(), 1e-12);
  EXPECT_EQ(matrices(original).states[0].type, StateType::part_euler);
  EXPECT_TRUE(study.linearize(point, original).modes().original);
  point = study.initial_conditions(point);
  EXPECT_NEAR(stiffness(request), p.kappa() + w * w, 1e-12);
  StaticRequest at_rest;
  at_rest.restore_velocities = false;
  point = study.static_equilibrium(at_rest);
  request.without_reconciliation = false;
  EXPECT_NEAR(stiffness(request), p.kappa(), 1e-12);
}

TEST_F(OriginalOptions, the_command_environment_sets_variables_for_what_follows) {
  const Pendulum p;
  const double w = 1.3;
  const RunResult r = run(p.text(0, w),
                          "SIM/STAT\nLINEAR/EIGENSOL\nENVIRONMENT/NAME=MSC_LINEAR_PBCS_STATES, VALUE=1\n"
                          "LINEAR/EIGENSOL\nENV/NAME=MSC_ADAMS_LINEAR_NO_CHECKS_FOR_CONSISTENCY, VALUE=yes\n"
                          "LINEAR/EIGENSOL\nENVIRONMENT/NAME=SOMETHING_ELSE, VALUE=3\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const Complex plain(0, std::sqrt(p.kappa()) / two_pi), moving(0, std::sqrt(p.kappa() + w * w) / two_pi);
  expect_eigenvalues(r.eigenvalues(1), {plain}, 1e-12);
  expect_eigenvalues(r.eigenvalues(3), {moving}, 1e-12);
  expect_eigenvalues(r.eigenvalues(5), {plain}, 1e-12);
  EXPECT_EQ(codes(r, 5)[1], (std::array{1, 2, 1}));
  EXPECT_THAT(r.message, HasSubstr("SOMETHING_ELSE means nothing here"));
  // It is a variable of the run, not of the process.
  EXPECT_EQ(std::getenv(pbcs_states), nullptr);
}

TEST_F(OriginalOptions, statics_stay_at_rest_where_the_environment_says_so) {
  const Pendulum p;
  const Variable variable(no_restore);
  const Variable states(pbcs_states);
  const RunResult r = run(p.text(0, 1.3), "SIM/STAT\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_eigenvalues(r.eigenvalues(1), {Complex(0, std::sqrt(p.kappa()) / two_pi)}, 1e-12);
  EXPECT_THAT(r.err, HasSubstr("environment variable MSC_ADAMS_STATICS_NO_RESTORE_VELOCITIES is set"));
}

}  // namespace
}  // namespace dynalin::cases::original_options_test
