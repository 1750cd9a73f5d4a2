// STATIC_HOLD: states that statics leave at their first value, whatever else they look for.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "cases/run.h"

namespace dynalin::cases::static_hold_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class StaticHold : public Cases {
 protected:
  // The differential states at rest, in the order of the layout.
  std::vector<double> states(const std::string& statements, const std::string& command = "SIMULATE/STATICS\n") const {
    const RunResult r = run("Held\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n" + statements + "END\n", command);
    EXPECT_EQ(r.status, 0) << r.err << statements;
    std::vector<double> list;
    if (r.json.is_null()) return list;
    for (const auto& s : r.result(0).at("operating_point").at("states")) list.push_back(s.at("value"));
    return list;
  }
};

TEST_F(StaticHold, is_exact_beside_states_that_follow) {
  for (const double factor : {1.0, 0.1, 0.001}) {
    const auto z = states("DIFF/1, IC=0.5, FUNCTION=-DIF(1), STATIC_HOLD\n" +
                          fmt::format("DIFF/2, IC=0.8, FUNCTION=DIF(1)-{}*DIF(2)\n", factor));
    ASSERT_EQ(z.size(), 2u);
    EXPECT_EQ(z[0], 0.5) << factor;
    EXPECT_NEAR(z[1], 0.5 / factor, 1e-9 / factor) << factor;
  }
}

TEST_F(StaticHold, is_exact_in_every_kind_of_state_equations) {
  const std::string follows =
      "VARIABLE/1, FUNCTION=2\nARRAY/2, U, VARIABLES=1\nARRAY/1, X\nARRAY/3, Y\n"
      "DIFF/1, IC=0.1, FUNCTION=0.4-3*DIF(1)+0.2*DIF(1)**2+ARYVAL(1,1)\n";
  const double rest = (3 - std::sqrt(9 - 0.8 * 0.7)) / 0.4;  // of 0.4 - 3 z + 0.2 z² + 0.3
  const auto lse = states(follows +
                          "LSE/1, X=1, U=2, Y=3, A=1, B=2, C=3, IC=4, STATIC_HOLD\nARRAY/4, IC, NUMBERS=0.3\n"
                          "MATRIX/1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=-1\n"
                          "MATRIX/2, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1\n"
                          "MATRIX/3, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1\n");
  ASSERT_EQ(lse.size(), 2u);
  for (const double z : lse) EXPECT_NEAR(z, std::abs(z - 0.3) < 1e-3 ? 0.3 : rest, 1e-12);
}

TEST_F(StaticHold, is_exact_in_quasi_statics) {
  const auto z = states("DIFF/1, IC=0.4, FUNCTION=-DIF(1), STATIC_HOLD\nDIFF/2, IC=0.8, FUNCTION=DIF(1)+TIME-DIF(2)\n",
                        "SIMULATE/STATICS, END=1, STEPS=4\n");
  ASSERT_EQ(z.size(), 2u);
  EXPECT_EQ(z[0], 0.4);
  EXPECT_NEAR(z[1], 1.4, 1e-9);
}

// Forces are in balance all along there: what is not at rest is the state.
TEST_F(StaticHold, is_advised_where_the_input_of_an_integrator_does_not_vanish) {
  const auto refused = [&](const std::string& statements) {
    const RunResult r =
        run("Held\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n" + statements + "END\n", "SIMULATE/STATICS\n");
    EXPECT_EQ(r.status, 2) << statements;
    return r.err;
  };
  const std::string slide =
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-100*DZ(20,1)\n";
  const std::string diff = refused(slide + "DIFF/1, IC=0, FUNCTION=DZ(20,1)-0.1\n");
  EXPECT_THAT(diff,
              HasSubstr("the state of DIFF/1 does not come to rest, its rate is still 1.000e-01 (with STATIC_HOLD "
                        "it would keep its value)"));
  EXPECT_THAT(diff, HasSubstr("iteration 0: imbalance 0.00000e+00 and a state that changes at a rate of 1.000e-01\n"));
  const std::string transfer = refused(slide +
                                       "VARIABLE/1, FUNCTION=DZ(20,1)-0.1\nARRAY/1, X\nARRAY/2, U, VARIABLES=1\n"
                                       "ARRAY/3, Y\n"
                                       "TFSISO/1, X=1, U=2, Y=3, NUMERATOR=1, DENOMINATOR=0,1\n");
  EXPECT_THAT(transfer, HasSubstr("the state of TFSISO/1 does not come to rest"));
  EXPECT_THAT(transfer, HasSubstr("with STATIC_HOLD it would keep its value"));
  // A force that is out of balance is not described by states.
  const std::string falls = refused(
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=1\n");
  EXPECT_THAT(falls, Not(HasSubstr("STATIC_HOLD")));
  EXPECT_THAT(falls, Not(HasSubstr("rate")));
}

}  // namespace
}  // namespace dynalin::cases::static_hold_test
