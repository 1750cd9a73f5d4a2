// DIFFs that share their rates: as many states as the equations have rank, the rest by conditions without rates.
#include <numbers>

#include "cases/dataset_text.h"

namespace dynalin::cases::implicit_diff_test {
namespace {

class ImplicitDiffs : public Cases {
 protected:
  static std::string at_rest(const std::string& more) {
    return "DIFFs\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n" + more + "END\n";
  }
  // Eigenvalues in rad per unit time of DIFFs alone.
  std::vector<std::complex<double>> rates(const std::string& diffs) const {
    const RunResult r = run(at_rest(diffs), "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    if (r.status != 0) return {};
    auto values = r.eigenvalues(1);
    for (auto& v : values) v *= 2 * std::numbers::pi;
    return values;
  }
  // Two moving bodies with a force and a controller made of the expression given.
  RunResult with_bodies(const std::string& expression, const std::string& more,
                        const std::string& commands = "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n") const {
    return run(two_bodies("SFORCE/1, TRANSLATIONAL, I=30, J=20, FUNCTION=VARVAL(1)\nVARIABLE/1, FUNCTION=" +
                          expression + "\nDIFF/9, FUNCTION=-2*DIF(9)+VARVAL(1)\n" + more),
               commands);
  }
  std::vector<std::complex<double>> solve(const std::string& expression, const std::string& more) const {
    const RunResult r = with_bodies(expression, more);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.eigenvalues(1) : std::vector<std::complex<double>>();
  }
  void expect_refused(const std::string& diffs, const std::vector<std::string>& words) const {
    const RunResult r = run(at_rest(diffs), "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
    EXPECT_NE(r.status, 0);
    for (const std::string& w : words) EXPECT_NE(r.err.find(w), std::string::npos) << w << " in " << r.err;
  }

  const std::string x_ = "DX(31,21,21)", v_ = "VX(31,21,21,21)";  // v = x′
};

// z₁′ + z₂′ + 2 z₁ = u and 2 z₁′ + 2 z₂′ + z₁ − 2 z₂ = 2 u: the second less twice the first is 3 z₁ + 2 z₂ = 0, so
// z₁′ = 4 z₁ − 2 u, z₂ = −1.5 z₁.
TEST_F(ImplicitDiffs, two_that_share_one_rate_are_one_state) {
  const RunResult r =
      run(at_rest("DIFF/1, IMPLICIT, IC=0.3, FUNCTION=DIF1(1)+DIF1(2)+2*DIF(1)-VARVAL(1)\n"
                  "DIFF/2, IMPLICIT, FUNCTION=2*DIF1(1)+2*DIF1(2)+DIF(1)-2*DIF(2)-2*VARVAL(1)\n"
                  "VARIABLE/1, FUNCTION=0\nVARIABLE/2, FUNCTION=DIF1(2)+3*DIF(2)\nVARIABLE/3, FUNCTION=DIF1(1)\n"
                  "PINPUT/1, VARIABLES=1\nPOUTPUT/1, VARIABLES=2,3\n"),
          "LINEAR/STATEMAT, PINPUT=1, POUTPUT=1, FILE=s\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.err.find("DIFF/2"), std::string::npos);
  EXPECT_NE(r.err.find("contributes no state"), std::string::npos) << r.err;
  const auto near = [&](const std::string& name, const std::vector<std::vector<double>>& expected) {
    const auto m = r.matrix(0, name);
    ASSERT_EQ(m.size(), expected.size()) << name;
    for (std::size_t i = 0; i < m.size(); ++i) {
      ASSERT_EQ(m[i].size(), expected[i].size()) << name;
      for (std::size_t j = 0; j < m[i].size(); ++j) EXPECT_NEAR(m[i][j], expected[i][j], 1e-12) << name;
    }
  };
  near("A", {{4}});
  near("B", {{-2}});
  near("C", {{-1.5 * 4 - 4.5}, {4}});
  near("D", {{3}, {-2}});
  EXPECT_EQ(r.result(0).at("states").at(0).at("element"), 1);
}

// Σ z′ = −z₁, z₂ = 2 z₁, z₃ = 3 z₁.
TEST_F(ImplicitDiffs, three_of_rank_one_in_any_order) {
  const std::vector<std::string> lines = {"DIFF/1, IMPLICIT, IC=1, FUNCTION=DIF1(1)+DIF1(2)+DIF1(3)+DIF(1)\n",
                                          "DIFF/2, IMPLICIT, FUNCTION=2*(DIF1(1)+DIF1(2)+DIF1(3))+DIF(2)\n",
                                          "DIFF/3, IMPLICIT, FUNCTION=DIF1(1)+DIF1(2)+DIF1(3)+DIF(3)-2*DIF(1)\n"};
  for (const auto& order : {std::array{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}) {
    std::string text;
    for (const int k : order) text += lines[static_cast<std::size_t>(k)];
    expect_same(rates(text), {{-1.0 / 6, 0}}, 1e-12);
  }
  // The same with other numbers for the DIFFs.
  expect_same(rates("DIFF/3, IMPLICIT, IC=1, FUNCTION=DIF1(3)+DIF1(1)+DIF1(2)+DIF(3)\n"
                    "DIFF/1, IMPLICIT, FUNCTION=2*(DIF1(3)+DIF1(1)+DIF1(2))+DIF(1)\n"
                    "DIFF/2, IMPLICIT, FUNCTION=DIF1(3)+DIF1(1)+DIF1(2)+DIF(2)-2*DIF(3)\n"),
              {{-1.0 / 6, 0}}, 1e-12);
}

// Rank two of three: z₁′ + z₃′ = −z₁, z₂′ = z₁ − z₂, and z₃ = 2 z₁ + z₂, so 3 z₁′ = −2 z₁ + z₂.
TEST_F(ImplicitDiffs, three_of_rank_two) {
  expect_same(rates("DIFF/1, IMPLICIT, FUNCTION=DIF1(1)+DIF1(3)+DIF(1)\n"
                    "DIFF/2, IMPLICIT, FUNCTION=DIF1(2)-DIF(1)+DIF(2)\n"
                    "DIFF/3, IMPLICIT, FUNCTION=DIF1(1)+DIF1(3)+DIF1(2)+2*DIF(2)-DIF(3)+2*DIF(1)\n"),
              rates("DIFF/1, FUNCTION=(-2*DIF(1)+DIF(2))/3\nDIFF/2, FUNCTION=DIF(1)-DIF(2)\n"), 1e-12);
}

TEST_F(ImplicitDiffs, an_equation_may_determine_the_rate_of_another) {
  // The first is z₁ = 2 z₂ without rates; the second is what remains for z₁: 1.5 z₁′ = −0.5 z₁.
  expect_same(rates("DIFF/1, IMPLICIT, FUNCTION=0*DIF1(1)+DIF(1)-2*DIF(2)\n"
                    "DIFF/2, IMPLICIT, FUNCTION=DIF1(1)+DIF1(2)+DIF(2)\n"),
              {{-1.0 / 3, 0}}, 1e-12);
  // One that does not read its own rate but is asked for it: z₂ = z₁′ and z₂′ = −z₁ − 0.5 z₂.
  expect_same(
      rates("DIFF/1, IMPLICIT, FUNCTION=DIF1(1)+2*DIF1(2)+2*DIF(1)\nDIFF/2, IMPLICIT, FUNCTION=DIF1(1)-DIF(2)\n"),
      rates("DIFF/1, FUNCTION=DIF(2)\nDIFF/2, FUNCTION=-DIF(1)-0.5*DIF(2)\n"), 1e-12);
}

// c: 3 z₁ + 2 z₂ = 0.7 x, so z₁′ = 0.7 v + 4 z₁ − 2 x and z₂′ = 0.35 v − 1.5 z₁′; forces see all of it.
TEST_F(ImplicitDiffs, forces_read_the_rate_of_what_is_no_state) {
  const std::string shared = "DIFF/1, IMPLICIT, IC=0.2, FUNCTION=DIF1(1)+DIF1(2)+2*DIF(1)-" + x_ +
                             "\nDIFF/2, IMPLICIT, FUNCTION=2*DIF1(1)+2*DIF1(2)+DIF(1)-2*DIF(2)+0.7*" + x_ + "-2*" + x_ +
                             "\n";
  const std::string apart = "DIFF/1, IC=0.2, FUNCTION=0.7*" + v_ + "+4*DIF(1)-2*" + x_ + "\n";
  const std::string z2 = "(0.35*" + x_ + "-1.5*DIF(1))", rate2 = "(0.35*" + v_ + "-1.5*DIF1(1))";
  expect_same(solve("0.4*DIF1(2)", shared), solve("0.4*" + rate2, apart), 1e-10);
  expect_same(solve("DIF(2)*DIF1(2)+DIF1(1)", shared), solve(z2 + "*" + rate2 + "+DIF1(1)", apart), 1e-10);
}

// z₂³ + z₂ = z₁ − 0.2 x with slope s = 3 z₂² + 1: z₂′ = (z₁′ − 0.2 v)/s.
TEST_F(ImplicitDiffs, conditions_may_be_nonlinear) {
  const std::string sum = "(DIF1(1)+DIF1(2))*(2+SIN(DIF(1)))";
  const std::string shared = "DIFF/1, IMPLICIT, IC=0.8, FUNCTION=" + sum + "+DIF(1)-" + x_ +
                             "\nDIFF/2, IMPLICIT, FUNCTION=" + sum + "+DIF(1)-" + x_ + "+DIF(2)**3+DIF(2)-DIF(1)+0.2*" +
                             x_ + "\n";
  const std::string s = "(3*DIF(2)**2+1)";
  const std::string apart = "DIFF/2, IMPLICIT, FUNCTION=DIF(2)**3+DIF(2)-DIF(1)+0.2*" + x_ +
                            "\nDIFF/1, IC=0.8, FUNCTION=((" + x_ + "-DIF(1))/(2+SIN(DIF(1)))+0.2*" + v_ + "/" + s +
                            ")/(1+1/" + s + ")\n";
  expect_same(solve("DIF1(2)+DIF(2)*DIF1(1)", shared), solve("DIF1(2)+DIF(2)*DIF1(1)", apart), 1e-10);
}

// The condition z₂ = 0.3 x takes the explicit one; its equation remains for z₁: z₁′ = −z₁ − 0.3 v.
TEST_F(ImplicitDiffs, an_explicit_one_may_be_held_too) {
  expect_same(solve("DIF1(1)+DIF1(2)*DIF(2)", "DIFF/1, IMPLICIT, IC=0.5, FUNCTION=DIF1(1)+DIF1(2)+DIF(1)+DIF(2)-0.3*" +
                                                  x_ + "\nDIFF/2, FUNCTION=-DIF1(1)-DIF(1)\n"),
              solve("DIF1(1)+0.09*" + v_ + "*" + x_, "DIFF/1, IC=0.5, FUNCTION=-DIF(1)-0.3*" + v_ + "\n"), 1e-10);
}

// 2 z₂ = 3 z₁ − 0.7 x, so 2.5 z₁′ = x − 2 z₁ + 0.35 v. The forces leave PART/3 free to spin about the line through its
// markers; a bushing holds that.
TEST_F(ImplicitDiffs, statics_find_the_same_rest) {
  const std::string held = "BUSHING/7, I=30, J=1, K=0,0,0, KT=8,9,10, C=0,0,0, CT=.1,.1,.1\n";
  const std::string shared = "DIFF/1, IMPLICIT, IC=0.2, FUNCTION=DIF1(1)+DIF1(2)+2*DIF(1)-" + x_ +
                             "\nDIFF/2, IMPLICIT, FUNCTION=2*DIF1(1)+2*DIF1(2)+DIF(1)+2*DIF(2)-1.3*" + x_ + "\n" + held;
  const std::string apart = "DIFF/1, IC=0.2, FUNCTION=(" + x_ + "-2*DIF(1)+0.35*" + v_ + ")/2.5\n" + held;
  const std::string commands = "SIMULATE/STATIC\nLINEAR/EIGENSOL\n";
  const RunResult a = with_bodies("0.3*DIF(2)+0.5*DIF1(2)", shared, commands);
  const RunResult b =
      with_bodies("0.3*(1.5*DIF(1)-0.35*" + x_ + ")+0.5*(1.5*DIF1(1)-0.35*" + v_ + ")", apart, commands);
  ASSERT_EQ(a.status, 0) << a.err;
  ASSERT_EQ(b.status, 0) << b.err;
  expect_same(a.eigenvalues(1), b.eigenvalues(1), 1e-9);
}

TEST_F(ImplicitDiffs, a_start_that_contradicts_the_condition_is_moved_with_a_warning) {
  const std::string diffs =
      "DIFF/1, IMPLICIT, IC=0.4, FUNCTION=DIF1(1)+DIF1(2)+DIF(1)**2\n"
      "DIFF/2, IMPLICIT, IC=5, FUNCTION=DIF1(1)+DIF1(2)+DIF(1)**2+DIF(2)-2*DIF(1)\n";
  const RunResult r = run(at_rest(diffs), "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.err.find("starts at 0.8"), std::string::npos) << r.err;
  // 3 z₁′ = −z₁² at z₁ = 0.4
  EXPECT_NEAR(r.eigenvalues(1).at(0).real() * 2 * std::numbers::pi, -0.8 / 3, 1e-12);
  EXPECT_EQ(run(at_rest("DIFF/1, IMPLICIT, IC=0.4, FUNCTION=DIF1(1)+DIF1(2)+DIF(1)\n"
                        "DIFF/2, IMPLICIT, IC=0.8, FUNCTION=DIF1(1)+DIF1(2)-DIF(2)+3*DIF(1)\n"),
                "SIMULATE/INITIAL\n")
                .err.find("starts at"),
            std::string::npos);
}

TEST_F(ImplicitDiffs, what_cannot_be_reduced_is_refused_by_name) {
  // z₁ + z₂ = 0 and its rate is z₁′ + z₂′ again.
  expect_refused(
      "DIFF/1, IMPLICIT, FUNCTION=DIF1(1)+DIF1(2)+2*DIF(1)\n"
      "DIFF/2, IMPLICIT, FUNCTION=2*DIF1(1)+2*DIF1(2)+DIF(1)-3*DIF(2)\n",
      {"DIFF/1", "DIFF/2", "higher index"});
  // z₁ (first) − (second) has no rates, but nothing of what is written cancels.
  expect_refused(
      "DIFF/1, IMPLICIT, IC=1, FUNCTION=DIF1(1)+DIF1(2)+DIF(1)\n"
      "DIFF/2, IMPLICIT, IC=1, FUNCTION=DIF(1)*(DIF1(1)+DIF1(2))+DIF(2)\n",
      {"the equations of DIFF/1, DIFF/2 do not determine their DIF1 here", "depend on each other"});
  // z₂² = −1 has no root.
  expect_refused(
      "DIFF/1, IMPLICIT, IC=1, FUNCTION=DIF1(1)+DIF1(2)+DIF(1)\n"
      "DIFF/2, IMPLICIT, IC=0.7, FUNCTION=DIF1(1)+DIF1(2)+DIF(1)+DIF(2)**2+1\n",
      {"DIFF/2", "did not converge"});
}

// The second equation reads z₁′ once more beyond a threshold: z₁′ = z₁ − z₂ and z₂′ = z₂ − 2 z₁ there, and no rates
// below it, where the equations depend on each other.
TEST_F(ImplicitDiffs, rank_is_asked_for_where_the_model_stands) {
  const auto switched = [](int threshold) {
    return "DIFF/1, IMPLICIT, IC=100, FUNCTION=DIF1(1)+DIF1(2)+DIF(1)\n"
           "DIFF/2, IMPLICIT, IC=1, FUNCTION=DIF1(1)+DIF1(2)+DIF(2)+IF(DIF(1)-" +
           std::to_string(threshold) + ": 0, 0, DIF1(1))\n";
  };
  expect_same(rates(switched(50)), {{1 - std::numbers::sqrt2, 0}, {1 + std::numbers::sqrt2, 0}}, 1e-12);
  expect_refused(switched(1000), {"DIFF/1, DIFF/2", "depend on each other"});
}

// z₁ z₁′ + z₁ = 0 says nothing of z₁′ at zero; a rate that is read through a VARIABLE counts, though nothing shows it.
TEST_F(ImplicitDiffs, one_alone_has_a_rank_too) {
  expect_refused("DIFF/1, IMPLICIT, FUNCTION=DIF(1)*DIF1(1)+DIF(1)\n",
                 {"the equation of DIFF/1 does not determine its DIF1 here"});
  expect_same(rates("DIFF/1, IMPLICIT, FUNCTION=0*DIF1(1)+VARVAL(1)+3*DIF(1)\nVARIABLE/1, FUNCTION=DIF1(1)\n"),
              {{-3, 0}}, 1e-12);
  expect_same(rates("DIFF/1, IMPLICIT, FUNCTION=0*DIF1(1)+POUVAL(7,1)+3*DIF(1)\nVARIABLE/1, "
                    "FUNCTION=DIF1(1)\nPOUTPUT/7, VARIABLES=1\n"),
              {{-3, 0}}, 1e-12);
}

// z₁ = 3 z₂ at every instant: IC is where its search begins.
TEST_F(ImplicitDiffs, one_that_does_not_read_its_rate_is_no_state_and_says_so) {
  const RunResult r = run(at_rest("DIFF/1, IMPLICIT, IC=0.7, FUNCTION=DIF(1)-3*DIF(2)\nDIFF/2, FUNCTION=-DIF(1)\n"),
                          "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_same({r.eigenvalues(1)[0] * (2 * std::numbers::pi)}, {{-3, 0}}, 1e-12);
  EXPECT_NE(r.err.find("DIFF/1 does not read its own DIF1: it is algebraic and contributes no state"),
            std::string::npos)
      << r.err;
  EXPECT_EQ(r.err.find("warning:"), r.err.rfind("warning:")) << r.err;
}

// A factor that is the same in both equations cancels as it is written, also where both have no value at other places.
TEST_F(ImplicitDiffs, combinations_are_found_by_how_equations_are_written) {
  const std::string factor = "*SQRT(DIF(1)-0.2)*LOG(5-DIF(1))";
  expect_same(rates("DIFF/1, IMPLICIT, IC=0.4, FUNCTION=(DIF1(1)+DIF1(2))" + factor + "+DIF(1)-0.4\n" +
                    "DIFF/2, IMPLICIT, IC=0.8, FUNCTION=(DIF1(1)+DIF1(2))" + factor + "+3*DIF(1)-DIF(2)-0.4\n"),
              rates("DIFF/1, IC=0.4, FUNCTION=-(DIF(1)-0.4)/(3*SQRT(DIF(1)-0.2)*LOG(5-DIF(1)))\n"), 1e-12);
}

}  // namespace
}  // namespace dynalin::cases::implicit_diff_test
