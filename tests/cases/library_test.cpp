// The library as a program of others uses it.
#include <dynalin/mechanism.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <thread>

namespace dynalin {
namespace {

const std::string pendulum =
    "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n! adams_view_name='bob'\nPART/2, "
    "MASS=1, CM=20, IP=0.1,0.1,0.1, QG=1,0,0, WZ=0\n"
    "MARKER/20\nMARKER/21, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\nVARIABLE/3, FUNCTION=AZ(21,1)\nVARIABLE/4, "
    "FUNCTION=0\n"
    "SFORCE/1, ROTATIONAL, ACTIONONLY, I=20, J=20, FUNCTION=VARVAL(4)\nPINPUT/1, VARIABLES=4\nPOUTPUT/1, "
    "VARIABLES=3\nEND\n";

TEST(Library, finds_the_point_and_the_linear_model) {
  Mechanism m = Mechanism::from_text(pendulum);
  EXPECT_GT(m.static_equilibrium(), 0);
  EXPECT_NEAR(m.variable(3), -std::numbers::pi / 2, 1e-12);
  ASSERT_EQ(m.bodies().size(), 1u);
  EXPECT_EQ(m.bodies()[0].name, "PART/2 (bob)");
  EXPECT_NEAR(m.bodies()[0].position[1], -1, 1e-12);
  EXPECT_NEAR(m.bodies()[0].axes[0][1], -1, 1e-12);
  const EigenSolution e = m.eigensolution();
  ASSERT_EQ(e.modes.size(), 1u);
  EXPECT_NEAR(e.modes[0].eigenvalue_hz.imag(), std::sqrt(9.81 / 1.1) / (2 * std::numbers::pi), 1e-14);
  EXPECT_EQ(e.modes[0].moves_most, "PART/2 (bob)");
  LinearRequest request;
  request.pinput = 1, request.poutput = 1;
  const StateSpace s = m.state_space(request);
  EXPECT_NEAR(s.B(0, 0) + s.B(1, 0), 1 / 1.1, 1e-13);
  EXPECT_EQ(s.inputs.at(0).variable, 4);
  EXPECT_TRUE(m.redundant_rows().empty());
}

TEST(Library, says_everything_that_is_wrong) {
  try {
    Mechanism::from_text("x\nUNITS/SYSTEM=MKX\nPART/1, GROUND\nJOINT/1, REVOLUTE, I=1, J=2\nEND\n", "some.adm");
    FAIL();
  } catch (const Error& e) {
    EXPECT_GE(e.problems.size(), 3u);
    EXPECT_THAT(e.what(), ::testing::HasSubstr("some.adm:2:"));
    EXPECT_THAT(e.what(), ::testing::HasSubstr("some.adm:4:"));
  }
  EXPECT_THROW(Mechanism::load("no_such_file.adm"), Error);
  Mechanism m = Mechanism::from_text(pendulum);
  LinearRequest request;
  request.pinput = 77;
  EXPECT_THROW(m.state_space(request), Error);
  EXPECT_THROW(m.variable(9), Error);
}

TEST(Library, ten_models_in_ten_threads_give_what_one_gives) {
  const auto solve = [] {
    Mechanism m = Mechanism::from_text(pendulum);
    m.static_equilibrium();
    return m.eigensolution().modes[0].eigenvalue_hz;
  };
  const auto alone = solve();
  std::vector<std::complex<double>> found(10);
  std::vector<std::thread> threads;
  for (auto& f : found) {
    threads.emplace_back([&f, &solve] {
      for (int k = 0; k < 20; ++k) f = solve();
    });
  }
  for (auto& t : threads) t.join();
  for (const auto& f : found) EXPECT_EQ(f, alone);
}

}  // namespace
}  // namespace dynalin
