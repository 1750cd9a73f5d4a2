// DELAY in linear models: e − τ e′, or with --pade (1 − τs/2)/(1 + τs/2), against characteristic polynomials by hand.
#include <gmock/gmock.h>

#include <numbers>

#include "cases/run.h"
#include "cases/study_of.h"

namespace dynalin::cases::delay_test {
namespace {

using ::testing::HasSubstr;

// A mass of 2 that slides along z with the force F on it, z = z0 and z′ = v0 at the start.
std::string slider(const std::string& force, const std::string& more = "", double z0 = 0, double v0 = 0) {
  return "A slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0," +
         std::to_string(z0) + ", VZ=" + std::to_string(v0) +
         "\nMARKER/20\nMARKER/10, PART=1, FLOATING\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
         "VFORCE/1, I=20, JFLOAT=10, RM=1, FX=0\\ FY=0\\ FZ=" +
         force + "\n" + more + "END\n";
}

using Complex = std::complex<double>;

class Delays : public Cases {
 protected:
  std::vector<Complex> eigenvalues(const std::string& dataset, bool pade, const std::string& commands) const {
    write("model.adm", dataset);
    write("model.acf", "model\nmodel\n" + commands);
    SessionOptions options;
    options.file = (folder_ / "model.acf").string();
    options.json = (folder_ / "results.json").string();
    options.pade = pade;
    std::ostringstream out, err;
    const int status = run_session(options, out, err);
    EXPECT_EQ(status, 0) << err.str();
    if (status != 0) return {};
    std::vector<Complex> values;
    const auto json = nlohmann::json::parse(read_file(options.json));
    for (const auto& e : json.at("results").back().at("eigenvalues")) {
      values.push_back(2 * std::numbers::pi * Complex(e.at("real_hz"), e.at("imag_hz")));
    }
    return values;
  }
  // The eigenvalues are the roots of Σ c_k s^k, no other number of them: Vieta's sum and product, and each one a root.
  void expect_roots(const std::string& dataset, bool pade, const std::vector<double>& c,
                    const std::string& commands = "LINEAR/EIGENSOL\n") const {
    const auto s = eigenvalues(dataset, pade, commands);
    const std::size_t n = c.size() - 1;
    ASSERT_EQ(s.size(), n);
    Complex sum = 0, product = 1;
    for (const Complex& root : s) {
      Complex value = 0;
      double size = 0;
      for (std::size_t k = n + 1; k-- > 0;) value = value * root + c[k], size = size * std::abs(root) + std::abs(c[k]);
      EXPECT_LE(std::abs(value), 1e-12 * size) << root;
      sum += root, product *= root;
    }
    EXPECT_NEAR(std::abs(sum + c[n - 1] / c[n]), 0, 1e-11 * (1 + std::abs(c[n - 1] / c[n])));
    EXPECT_NEAR(std::abs(product - (n % 2 == 0 ? 1.0 : -1.0) * c[0] / c[n]), 0, 1e-11 * (1 + std::abs(c[0] / c[n])));
  }
};

const std::string z = "DZ(20,1,1)", v = "VZ(20,1,1)", a = "ACCZ(20,1,1)";
std::string delay(const std::string& e, const std::string& tau = "0.3", const std::string& history = "0") {
  return "DELAY(" + e + "," + tau + "," + history + ")";
}

// 2 z″ = −8 z(t − τ):  2 s² + 8 (1 − τ s),  and 2 s² (1 + τs/2) + 8 (1 − τs/2).
TEST_F(Delays, spring_that_acts_late_drives_the_motion) {
  const std::string dataset = slider("-8*" + delay(z));
  expect_roots(dataset, false, {8, -8 * 0.3, 2});
  expect_roots(dataset, true, {8, -4 * 0.3, 2, 0.3});
}

// 2 z″ + 8 z = −3 z′(t − τ), whose rate is an acceleration: 2 s² + 8 + 3 s (1 − τ s).
TEST_F(Delays, damper_that_acts_late_takes_away_mass) {
  const std::string dataset = slider("-8*" + z + "-3*" + delay(v));
  expect_roots(dataset, false, {8, 3, 2 - 3 * 0.3});
  expect_roots(dataset, true, {8, 3 + 8 * 0.15, 2 - 3 * 0.15, 2 * 0.15});
}

// The same through VARIABLEs, an ARRAY of them, and where the same call stands twice.
TEST_F(Delays, rates_go_through_variables) {
  const std::string more = "VARIABLE/1, FUNCTION=2*VARVAL(2)\nVARIABLE/2, FUNCTION=" + z +
                           "\nVARIABLE/3, FUNCTION=" + delay("VARVAL(1)") + "\n";
  expect_roots(slider("-4*VARVAL(3)", more), false, {8, -8 * 0.3, 2});
  expect_roots(slider("-4*VARVAL(3)", more), true, {8, -4 * 0.3, 2, 0.3});
  expect_roots(slider("-4*" + delay(z) + "-4*" + delay(z)), false, {8, -8 * 0.3, 2});
}

// x′ = −x(t − τ):  s (1 − τ) + 1,  and s (1 + τs/2) + 1 − τs/2.
TEST_F(Delays, states_may_be_delayed) {
  const std::string dataset =
      "A state\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nDIFF/1, IC=1, FUNCTION=-DELAY(DIF(1),0.3,0)\nEND\n";
  expect_roots(dataset, false, {1, 0.7});
  expect_roots(dataset, true, {1, 0.85, 0.15});
}

// Accelerations, forces and other delays have no rate that is known; the Padé approximant needs none.
// 2 z″ = −8 z − 0.5 z″(t − τ):  (2 s² + 8)(1 + τs/2) + 0.5 s² (1 − τs/2).
TEST_F(Delays, what_has_no_known_rate_is_an_error_with_its_place_but_not_for_pade) {
  const std::string dataset = slider("-8*" + z + "-0.5*" + delay(a));
  const RunResult r = run(dataset, "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("model.adm:9:"));
  EXPECT_THAT(r.err, HasSubstr("error: ACCZ(20,1,1) stands in an expression whose time derivative"));
  expect_roots(dataset, true, {8, 8 * 0.15, 2.5, (2 - 0.5) * 0.15});

  // 2 z″ = F(t − τ)/2 with F = −8 z a VFORCE of its own: FZ on 20 holds both, w = 0.5 P (−8 z + w).
  const RunResult nested = run(
      slider("VARVAL(1)", "VARIABLE/1, FUNCTION=" + delay("VARVAL(2)") + "\nVARIABLE/2, FUNCTION=" + delay(z) + "\n"),
      "LINEAR/EIGENSOL\n");
  EXPECT_EQ(nested.status, 1);
  EXPECT_THAT(nested.err, HasSubstr("the time derivative of DELAY/2 (in VARIABLE/2)"));
}

// Two in series, −8 z delayed twice: 2 s² (1 + τs/2)² + 8 (1 − τs/2)², τ/2 = h.
TEST_F(Delays, pade_approximants_may_follow_each_other) {
  const double h = 0.15;
  const std::string more = "VARIABLE/1, FUNCTION=" + delay("VARVAL(2)") + "\nVARIABLE/2, FUNCTION=" + delay(z) + "\n";
  expect_roots(slider("-8*VARVAL(1)", more), true, {8, -16 * h, 2 + 8 * h * h, 4 * h, 2 * h * h});
}

TEST_F(Delays, pade_states_are_named_and_numbered_as_they_stand_in_the_dataset) {
  write("model.adm", slider("-8*" + delay(z), "DIFF/1, FUNCTION=-DELAY(DIF(1),1,0)\n"));
  SessionOptions options;
  options.file = (folder_ / "model.adm").string();
  options.commands = {"LINEAR/EIGENSOL"};
  options.json = (folder_ / "results.json").string();
  options.pade = true;
  std::ostringstream out, err;
  ASSERT_EQ(run_session(options, out, err), 0) << err.str();
  const auto json = nlohmann::json::parse(read_file(options.json));
  std::vector<std::string> labels;
  for (const auto& s : json.at("results")[0].at("states")) labels.push_back(s.at("label"));
  ASSERT_EQ(labels.size(), 5u);
  EXPECT_EQ(labels[3], "State 1 DELAY/1");
  EXPECT_EQ(labels[4], "State 1 DELAY/2");
}

// w = e(t − τ) with e = 5 t + z², τ = 0.2 + z/10, at z = 3, z′ = 2:  e′ = 5 + 2 z z′ = 17, τ = 0.5,
// δw = 2 z δz − τ (2 z′ δz + 2 z δz′) − e′ δz/10 = (6 − 2 − 1.7) δz − 3 δz′.
TEST_F(Delays, first_order_holds_second_derivatives_time_and_a_delay_that_varies) {
  const std::string more = "VARIABLE/1, FUNCTION=" + delay("5*TIME+" + z + "**2", "0.2+" + z + "/10") +
                           "\nVARIABLE/2, FUNCTION=0\nPOUTPUT/1, VARIABLES=1\nPINPUT/1, VARIABLES=2\n";
  const RunResult r = run(slider("0", more, 3, 2), "LINEAR/STATEMAT, PINPUT=1, POUTPUT=1, FILE=s\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto c = r.matrix(0, "C");
  ASSERT_EQ(c[0].size(), 2u);
  EXPECT_NEAR(c[0][0], -3, 1e-13);
  EXPECT_NEAR(c[0][1], 2.3, 1e-13);
}

// A controller's partials stay with NODAMPIN, and so do those of a DELAY.
TEST_F(Delays, nodampin_keeps_them) {
  expect_roots(slider("-8*" + delay(z) + "-4*" + v), false, {8, -8 * 0.3, 2}, "LINEAR/EIGENSOL, NODAMPIN\n");
}

TEST_F(Delays, value_is_the_history_at_the_start_and_e_at_rest) {
  const auto mechanism = [](const std::string& of_tau, bool pade) {
    return study_of(
        slider("-8*" + delay("VARVAL(2)", of_tau, "7+2*TIME") + "+4",
               "VARIABLE/1, FUNCTION=" + delay("VARVAL(2)", of_tau, "7+2*TIME") + "\nVARIABLE/2, FUNCTION=" + z + "\n",
               3, 2),
        {pade});
  };
  for (const bool pade : {false, true}) {
    const auto study = mechanism("0.5", pade);
    EXPECT_NEAR(study.initial_conditions().variable(1), 6, 1e-13);  // 7 + 2 (0 − 0.5)
    StaticRequest request;
    request.restore_velocities = false;
    const auto at_rest = study.static_equilibrium(request);
    EXPECT_NEAR(at_rest.variable(1), 0.5, 1e-12);
    EXPECT_NEAR(at_rest.variable(2), 0.5, 1e-12);
  }
  for (const std::string none : {"0", "-0.5", "0*TIME-0.5"}) {
    EXPECT_NEAR(mechanism(none, false).initial_conditions().variable(1), 3, 1e-13) << none;
  }
}

// w = h(−τ) = −4 τ and τ = 0.1 + w/20: w = −0.4/1.2.
TEST_F(Delays, delay_may_depend_on_what_is_delayed) {
  const auto study = study_of(slider("0",
                                     "VARIABLE/1, FUNCTION=DELAY(9,VARVAL(2),4*TIME)\n"
                                     "VARIABLE/2, FUNCTION=0.1+VARVAL(1)/20\n"));
  EXPECT_NEAR(study.initial_conditions().variable(1), -1.0 / 3, 1e-13);
}

TEST_F(Delays, constant_of_no_delay_has_no_state) {
  expect_roots(slider("-8*" + delay(z, "0")), true, {8, 0, 2});
  expect_roots(slider("-8*" + delay(a + "+" + z, "-1")), false, {8, 0, 10});
}

TEST_F(Delays, pade_approximant_of_no_delay_is_refused) {
  const auto study = study_of(slider("-8*" + delay(z, z)), {.pade_delays = true});
  try {
    study.initial_conditions();
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("DELAY/1 (in VFORCE/1): the Padé approximant needs a delay above 0, here it is 0"));
  }
}

}  // namespace
}  // namespace dynalin::cases::delay_test
