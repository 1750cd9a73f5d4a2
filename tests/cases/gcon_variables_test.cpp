// GCONs that read VARIABLEs and ARRAYs: what these stand for is put in their place.
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::gcon_variables_test {
namespace {

using ::testing::HasSubstr;

class GconVariables : public Cases {
 protected:
  // A bead on a wire in a plane; `wire` is its height, `more` what that reads.
  RunResult bead(const std::string& wire, const std::string& more = "", const std::string& ahead = "") const {
    return run(
        "Bead\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\nPOINT_MASS/2, MASS=3, CM=2, VX=0.1\n"
        "MARKER/2\n" +
            ahead + "GCON/1, FUNCTION=DZ(2,1)-(" + wire + ")\nGCON/2, FUNCTION=DY(2,1)\n" + more + "END\n",
        "LINEAR/EIGENSOL\nSIMULATE/DYNAMICS, END=0.3, STEPS=3\n");
  }
};

TEST_F(GconVariables, count_with_what_they_stand_for) {
  const RunResult spelled_out = bead("2*DX(2,1)**2+0.1*SIN(TIME)");
  ASSERT_EQ(spelled_out.status, 0) << spelled_out.err;
  const std::string variables =
      "VARIABLE/1, FUNCTION=VARVAL(2)**2\nVARIABLE/2, FUNCTION=DX(2,1)\n"
      "VARIABLE/3, FUNCTION=ARYVAL(1,2)*SIN(TIME)\nARRAY/1, IC, NUMBERS=2,0.1\n";
  for (const bool ahead : {false, true}) {
    const RunResult read = bead("ARYVAL(1,1)*VARVAL(1)+VARVAL(3)", ahead ? "" : variables, ahead ? variables : "");
    ASSERT_EQ(read.status, 0) << read.err;
    EXPECT_EQ(read.eigenvalues(0), spelled_out.eigenvalues(0));
    EXPECT_EQ(read.result(0).at("operating_point").at("constraints"),
              spelled_out.result(0).at("operating_point").at("constraints"));
    for (std::size_t c = 0; c < 3; ++c) {
      const auto place = [&](const RunResult& r) {
        return r.result(1).at("operating_point").at("bodies").at(0).at("position").at(c).get<double>();
      };
      EXPECT_NEAR(place(read), place(spelled_out), 1e-12);
    }
  }
}

TEST_F(GconVariables, read_nothing_that_follows_from_the_constraint) {
  for (const auto& [wire, more, why] : std::vector<std::array<std::string, 3>>{
           {"VARVAL(1)", "VARIABLE/1, FUNCTION=FX(2)\n", "depends on FX(2)"},
           {"VARVAL(1)", "VARIABLE/1, FUNCTION=ACCX(2)\n", "depends on ACCX(2)"},
           {"VARVAL(1)", "VARIABLE/1, FUNCTION=ABS(DX(2))\n", "uses ABS, which has kinks"},
           {"VARVAL(1)", "VARIABLE/1, FUNCTION=0.5*VARVAL(1)\n", "depends on itself"},
           {"DIF(1)", "DIFF/1, FUNCTION=-DIF(1)\n", "depends on DIF(1)"}}) {
    const RunResult r = bead(wire, more);
    EXPECT_EQ(r.status, 1) << wire << more;
    EXPECT_THAT(r.err, HasSubstr(why)) << more;
    EXPECT_THAT(r.err, HasSubstr("[unfit-constraint]")) << more;
  }
}

}  // namespace
}  // namespace dynalin::cases::gcon_variables_test
