// LINEAR right at a kink or a jump of a function: the side that is taken is said, and what is smooth to first order is
// not a kink, in any units and next to the kink as far as rounding goes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cases/run.h"

namespace dynalin::cases::kink_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Kinks : public Cases {
 protected:
  // A block on a rail along x, drawn at `x`, under a force along x, positive to the right.
  static std::string block(const std::string& force, double x = 0, const std::string& more = "") {
    return fmt::format(
        "Block\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/3, REULER=90D,90D,0\nPART/2, MASS=1, CM=2, "
        "IP=1,1,1, "
        "QG={:.17g},0,0\nMARKER/2\nMARKER/4, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=4, J=3\nSFORCE/1, "
        "TRANSLATIONAL, ACTIONONLY, I=2, J=3, FUNCTION={}\n{}END\n",
        x, force, more);
  }
  std::string said(const std::string& dataset, const std::string& commands = "LINEAR/EIGENSOL\n") const {
    const RunResult r = run(dataset, commands);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err;
  }
};

TEST_F(Kinks, are_named_with_the_slopes_of_both_sides) {
  EXPECT_THAT(said(block("-5*ABS(DX(2))")),
              HasSubstr("-5*ABS(DX(2)) of SFORCE/1 has a kink here: along DX(2) its slope by it changes from 5 to -5, "
                        "and 0 is taken"));
  for (const char* force : {"-100*DX(2)-50*MAX(0,DX(2))", "IF(DX(2): -100*DX(2), 0, -200*DX(2))", "-DIM(DX(2),0)",
                            "IMPACT(DX(2),VX(2),0,1E3,1.0,1,0.1)", "-MIN(DX(2),2*DX(2))", "-100*DX(2)-ABS(VX(2))",
                            "-100*DX(2)+MAX(DX(2),VX(2))"}) {
    EXPECT_THAT(said(block(force)), HasSubstr("has a kink here")) << force;
  }
  for (const std::string from : {"0.3", "0.7", "1.1", "1.9"}) {
    const std::string force = "STEP5(DX(2)+2.6," + from + ",1,2.6,-2)";
    EXPECT_THAT(said(block(force)), Not(HasSubstr("kink"))) << force;
  }
  // With the corner a little beside the point as well: nothing jumps there.
  EXPECT_THAT(said(block("-ABS(DX(2)-1E-13)")),
              HasSubstr("has a kink here: along DX(2) its slope by it changes from 1 to -1"));
  EXPECT_THAT(said(block("-DX(2)-IF(DX(2)-1E-13: 0, 0, 1E-3)")), HasSubstr("jumps here from"));
  EXPECT_THAT(said(block("-100*DX(2)-AKISPL(DX(2),0,1)", 0, "SPLINE/1, X=-2,-1,0,1,2, Y=-2,-1,0,1,2\n")),
              Not(HasSubstr("kink")));
}

TEST_F(Kinks, are_jumps_as_well) {
  EXPECT_THAT(said(block("-SIGN(5,DX(2))")), HasSubstr("of SFORCE/1 jumps here from 5 to -5 with DX(2)"));
  EXPECT_THAT(said(block("IF(DX(2): 1, 0, -1)-100*DX(2)")), HasSubstr("jumps here from 1 to -1 with DX(2)"));
}

TEST_F(Kinks, are_none_where_the_slope_goes_on) {
  for (const char* force :
       {"-10*DX(2)*ABS(DX(2))-DX(2)", "IMPACT(DX(2),VX(2),0,1E3,1.5,1,0.1)", "-100*DX(2)+STEP(DX(2),0,0,1,5)",
        "-100*DX(2)-MAX(0,DX(2))**2", "-100*DX(2)-ABS(VX(2))*VX(2)", "-100*DX(2)-COS(DX(2))", "-100*DX(2)-DX(2)**3",
        "-100*DX(2)+IF(TIME: 0,0,1)", "-100*DX(2)-ABS(DX(2)-0.5)", "-100*DX(2)-MAX(1,2)*DX(2)",
        "-100*DX(2)*IF(TIME-1: 1, 2, 3)"}) {
    EXPECT_THAT(said(block(force)), Not(HasSubstr("kink"))) << force;
    EXPECT_THAT(said(block(force)), Not(HasSubstr("jumps"))) << force;
  }
}

TEST_F(Kinks, are_found_where_rounding_has_left_the_point_beside_them) {
  const double third = 1.0 / 3;
  EXPECT_THAT(said(block("-100*(DX(2)-1/3)-50*MAX(0,DX(2)-1/3)", third)), HasSubstr("has a kink here"));
  EXPECT_THAT(said(block("-100*(DX(2)-1/3)-50*MAX(0,DX(2)-1/3)", third + 1e-6)), Not(HasSubstr("has a kink here")));
  // Statics come to rest where the stop begins.
  EXPECT_THAT(said(block("-100*(DX(2)-0.7)-50*MAX(0,DX(2)-0.7)", 0.2), "SIMULATE/STATIC\nLINEAR/EIGENSOL\n"),
              HasSubstr("has a kink here"));
}

// In the direction of no axis: the size of what is zero.
TEST_F(Kinks, are_sizes_of_vectors_that_are_zero) {
  EXPECT_THAT(said(block("-100*DX(2)-5*VM(2)")),
              HasSubstr("has a kink here: VM(2) is 0 and grows whichever way it moves, and its slope is taken as 0"));
  for (const char* size : {"MAG(VXYZ(2))", "MAG(2*VXYZ(2))", "MAG([DX(2),3*DX(2),0])"})
    EXPECT_THAT(said(block(std::string("-100*DX(2)-5*") + size)),
                HasSubstr("has a kink here: " + std::string(size) +
                          " is 0 and grows whichever way it moves, and its "
                          "slope is taken as 0"));
  for (const char* smooth : {"VM(2)**2", "MAG(2*VXYZ(2))**2", "DX(2)*MAG(2*VXYZ(2))", "MAG([DX(2)**2,VX(2)**3,0])"})
    EXPECT_THAT(said(block(std::string("-100*DX(2)-5*") + smooth)), Not(HasSubstr("kink"))) << smooth;
}

TEST_F(Kinks, are_found_in_values_that_functions_read) {
  EXPECT_THAT(
      said(block("VARVAL(2)-100*DX(2)", 0, "VARIABLE/2, FUNCTION=ABS(VARVAL(3))\nVARIABLE/3, FUNCTION=DX(2)\n")),
      HasSubstr("ABS(VARVAL(3)) of VARIABLE/2 has a kink here"));
  EXPECT_THAT(said(block("-100*DX(2)", 0, "DIFF/1, FUNCTION=-DIF(1)-ABS(DIF(1))\n")),
              HasSubstr("of DIFF/1 has a kink here"));
}

// A stop with an exponent below 1 is infinitely stiff at the touch.
TEST_F(Kinks, of_roots_have_an_infinite_slope_on_one_side) {
  for (const char* at : {"0", "0.7"}) {
    const std::string stop = fmt::format("IMPACT(DX(2),VX(2),{},100,0.5,0,0.1)", at);
    EXPECT_THAT(
        said(block("-100*DX(2)+" + stop, std::stod(at))),
        HasSubstr("has a kink here: along DX(2) its slope by it changes from -infinite to -100, and -100 is taken"));
  }
  EXPECT_THAT(said(block("-DX(2)+BISTOP(DX(2),VX(2),-2,0,100,0.9,0,0.1)")), HasSubstr("changes from -1 to -infinite"));
  EXPECT_THAT(said(block("-DX(2)+BISTOP(DX(2),VX(2),-2,0,100,1.0,0,0.1)")), HasSubstr("changes from -1 to -101"));
  EXPECT_THAT(said(block("-DX(2)-7*ABS(DX(2))**0.5*DX(2)**2-ABS(DX(2))")),
              AllOf(HasSubstr("to -2, and -1 is taken"), Not(HasSubstr("-infinite"))));
}

// A first-order DELAY reads the rate of its value, ẋ dF/dx, which bends where F has another curvature.
TEST_F(Kinks, of_rates_are_said_where_a_delay_reads_them) {
  const auto falling = [&](const std::string& value, const std::string& more = "") {
    return said("Touch\nPART/1, GROUND\nMARKER/1\nDIFF/1, FUNCTION=-1-DIF(1), IC=0\n" + more +
                "VARIABLE/1, FUNCTION=DELAY(" + value + ",0.1,0)\nEND\n");
  };
  EXPECT_THAT(
      falling("STEP(DIF(1),0,0,1,1)"),
      HasSubstr("STEP(DIF(1),0,0,1,1) of DELAY/1 (in VARIABLE/1) has a kink here: along DIF(1) the slope of its rate "
                "by it changes from 0 to -6, and 0 is taken"));
  EXPECT_THAT(falling("IMPACT(DIF(1),0,0,100,2,0,0.1)"), HasSubstr("by it changes from -200 to 0, and 0 is taken"));
  EXPECT_THAT(falling("IMPACT(DIF(1),0,0,100,1.5,0,0.1)"),
              HasSubstr("by it changes from -infinite to 0, and 0 is taken"));
  EXPECT_THAT(falling("VARVAL(2)", "VARIABLE/2, FUNCTION=STEP(DIF(1),0,0,1,1)\n"),
              HasSubstr("STEP(DIF(1),0,0,1,1) of VARIABLE/2 has a kink here: along DIF(1) the slope of its rate"));
  for (const char* smooth : {"STEP5(DIF(1),0,0,1,1)", "STEP(DIF(1),-1,0,1,1)", "IMPACT(DIF(1),0,0,100,2.5,0,0.1)",
                             "DIF(1)*ABS(DIF(1))**1.5"})
    EXPECT_THAT(falling(smooth), Not(HasSubstr("kink"))) << smooth;
  // What rests has no rate to bend.
  EXPECT_THAT(said("Touch\nPART/1, GROUND\nMARKER/1\nDIFF/1, FUNCTION=-DIF(1), IC=0\nVARIABLE/1, "
                   "FUNCTION=DELAY(STEP(DIF(1),0,0,1,1),0.1,0)\nEND\n"),
              Not(HasSubstr("kink")));
}

TEST_F(Kinks, are_said_of_matrices_too) {
  EXPECT_THAT(said(block("-5*ABS(DX(2))"), "LINEAR/STATEMAT, FILE=a\nLINEAR/MKB, FILE=b\n"),
              HasSubstr("has a kink here"));
}

}  // namespace
}  // namespace dynalin::cases::kink_test
