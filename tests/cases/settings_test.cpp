// Settings in datasets and as commands: checked like every other statement, obeyed where something acts on them, and
// named once where nothing does.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/run.h"

namespace dynalin::cases::settings_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string pendulum =
    "pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\nPART/2, QG=1,0,0, MASS=1, CM=20, "
    "IP=0,0,1.5\nMARKER/20\nMARKER/21, QP=-1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\n";

class Settings : public Cases {
 protected:
  RunResult with(const std::string& lines, const std::string& commands = "LINEAR/EIGENSOL\n") const {
    return run(pendulum + lines + "END\n", commands);
  }
  std::size_t count(const std::string& text, const std::string& part) const {
    std::size_t n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
  }
};

TEST_F(Settings, of_every_statement_are_read) {
  const RunResult r = with(
      "EQUILIBRIUM/ERROR=1E-6, IMBALANCE=1e-5, MAXIT=50, TLIMIT=20, ALIMIT=10D, STABILITY=1E-5, PATTERN=T:F:T, "
      "METHOD=ORIGINAL, ATOL=1e-6\nIC/ERROR=1e-10, MAXIT=25, VERR=1e-4, AERR=1e-4, AMAXIT=25, ALIMIT=30D, PATTERN=T\n"
      "INTEGRATOR/GSTIFF, SI2, ERROR=1e-3, HMAX=0.01, KMAX=6, CORRECTOR=MODIFIED, INTERPOLATE=ON, PATTERN=T:F\n"
      "KINEMATICS/ERROR=1e-4, AERROR=1e-4, MAXIT=10, HMAX=0.1, PATTERN=T\nOUTPUT/REQSAVE, GRSAVE, NOPRINT, DSCALE=1,2, "
      "OSFORMAT\n"
      "RESULTS/XRF, DECIMALPLACES=8, NOACCELERATIONS, COMMENT=a, b: c\nDEBUG/EPRINT, NODUMP\nLSOLVER/AUTO\n"
      "GRAPHICS/1, BOX, CORNER=20, X=20, Y=-10, Z=5\ngra/2, cylind, cm=20, len=50, r=4, seg=20, sides=10\n"
      "GRAPHICS/3, SPDP, I=20, J=1, COILS=10, DA=8\nGRAPHICS/4, OUTLINE=20,21\nGRAPHICS/5, FORCE, ETYPE=SFORCE, EID=7, "
      "EMARKER=20\nGRAPHICS/6, EXTERNAL, RM=20, FILE=a.xmt_txt, ELEMENT=SHELL_10, FACETING_TOLERANCE=300\n"
      "MREQUEST/1, DISPLACEMENT, PARTS=ALL\nMATERIAL/1, NAME=steel, Hardness=3\nMATERIAL/2, HARDNESS=4\nFEMDATA/1, "
      "LOADS\nFEMDATA/2, "
      "STRAIN\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(count(r.err, "nothing here acts on"), 1u) << r.err;
  for (const char* name :
       {"EQUILIBRIUM/ATOL", "IC/PATTERN", "INTEGRATOR/CORRECTOR", "KINEMATICS/AERROR", "KINEMATICS/PATTERN",
        "OUTPUT/OSFORMAT", "DEBUG/NODUMP", "LSOLVER/AUTO", "FEMDATA", "MATERIAL/HARDNESS"})
    EXPECT_EQ(count(r.err, name), 1u) << name;
  for (const char* acting : {"IC/MAXIT",
                             "IC/VERROR",
                             "IC/AERROR",
                             "IC/AMAXIT",
                             "IC/ALIMIT",
                             "EQUILIBRIUM/MAXIT",
                             "EQUILIBRIUM/ALIMIT",
                             "EQUILIBRIUM/TLIMIT",
                             "EQUILIBRIUM/ERROR",
                             "EQUILIBRIUM/IMBALANCE",
                             "EQUILIBRIUM/STABILITY",
                             "EQUILIBRIUM/PATTERN",
                             "EQUILIBRIUM/METHOD",
                             "KINEMATICS/ERROR",
                             "KINEMATICS/MAXIT",
                             "KINEMATICS/HMAX",
                             "RESULTS",
                             "GRAPHICS",
                             "OUTPUT/REQSAVE",
                             "OUTPUT/DSCALE"})
    EXPECT_THAT(r.err, Not(HasSubstr(acting)));
}

TEST_F(Settings, units_by_their_symbols_get_the_names_of_the_language) {
  const RunResult r = run("t\nUNITS/FORCE=NEWTON, MASS=kg, LENGTH=mm, TIME=ms\nPART/1, GROUND\nEND\n", "LINEAR/EIG\n");
  EXPECT_EQ(r.status, 1);
  for (const char* name : {"KILOGRAM", "MILLIMETER", "MILLISECONDS"})
    EXPECT_THAT(r.err, HasSubstr("did you mean " + std::string(name) + "?"));
}

// What is stated twice with one value, and what a DEFAULT has ended, says nothing new.
TEST_F(Settings, that_take_the_place_of_others_get_a_warning_at_their_place) {
  const RunResult r = with("EQUILIBRIUM/MAXIT=3, ERROR=1E-6\nEQUILIBRIUM/MAXIT=9\n", "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("model.adm:11:13: warning: MAXIT of EQUILIBRIUM is given a second value, which takes "
                               "the place of the first [duplicate-argument]"));
  EXPECT_THAT(r.err, HasSubstr("model.adm:10:13: note: the first one is here"));
  EXPECT_THAT(with("INTEGRATOR/GSTIFF\nINTEGRATOR/HHT\n").err,
              HasSubstr("HHT of INTEGRATOR takes the place of GSTIFF, which was given before"));
  for (const char* sound :
       {"EQUILIBRIUM/MAXIT=3\nEQUILIBRIUM/ERROR=1E-6\n", "EQUILIBRIUM/MAXIT=3\nEQUILIBRIUM/MAXIT=3\n",
        "EQUILIBRIUM/MAXIT=3\nEQUILIBRIUM/DEFAULT, MAXIT=9\n", "STRING/1, STRING=a\nSTRING/2, STRING=b\n"})
    EXPECT_THAT(with(sound).err, Not(HasSubstr("[duplicate-argument]"))) << sound;
}

TEST_F(Settings, without_xrf_say_that_there_is_no_results_file) {
  const RunResult none = with("RESULTS/\n");
  EXPECT_EQ(none.status, 0) << none.err;
  EXPECT_THAT(none.err, HasSubstr("model.adm:10:1: warning: no results file is written, as RESULTS does not say XRF"));
  EXPECT_FALSE(none.wrote("model.res"));
  const RunResult swallowed = with("RESULTS/COMMENT=foo, XRF\n");
  EXPECT_THAT(swallowed.err, HasSubstr("COMMENT takes the rest of its line, and XRF in it asks for nothing"));
  EXPECT_THAT(swallowed.err, HasSubstr("no results file is written"));
  for (const char* sound : {"RESULTS/XRF, COMMENT=a, b: c\n", "RESULTS/NOLINEAR\nRESULTS/XRF\n"}) {
    const RunResult r = with(sound);
    EXPECT_THAT(r.err, Not(HasSubstr("[passed-over]"))) << sound;
    EXPECT_TRUE(r.wrote("model.res")) << sound;
  }
}

TEST_F(Settings, a_string_is_no_setting_but_text_for_routines_that_is_listed) {
  const RunResult r = with("STRING/1, STRING=gains\n", "STRING/1, LIST\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, Not(HasSubstr("STRING"))) << r.err;
  EXPECT_THAT(r.out, HasSubstr("Current STRING/1 data are:"));
  EXPECT_THAT(r.out, HasSubstr("gains"));
  EXPECT_THAT(with("", "STRING/1, LIST\n").err, HasSubstr("model.acf:3:1: error: STRING/1 does not exist"));
}

TEST_F(Settings, of_graphics_over_time_are_passed_over) {
  EXPECT_EQ(count(with("TIMGRAPHICS/1\nTIMGRAPHICS/2\n").err, "nothing here acts on TIMGRAPHICS, which is"), 1u);
}

TEST_F(Settings, that_do_not_exist_are_errors_at_their_place) {
  const auto error = [&](const std::string& line) {
    const RunResult r = with(line + "\n");
    EXPECT_EQ(r.status, 1) << line;
    return r.err;
  };
  EXPECT_THAT(error("EQUILIBRIUM/FOO=1"), HasSubstr("model.adm:10:13: error"));
  EXPECT_THAT(error("EQUILIBRIUM/MAXIT=0"), HasSubstr("[value-out-of-range]"));
  EXPECT_THAT(error("EQUILIBRIUM/ERROR=abc"), HasSubstr("[expected-number]"));
  EXPECT_THAT(error("EQUILIBRIUM/MAXIT=20, METHOD=NEWTON"), HasSubstr("model.adm:10:23: error"));
  EXPECT_THAT(error("EQUILIBRIUM/METHOD=A"), HasSubstr("[unknown-word]"));
  EXPECT_THAT(error("EQUILIBRIUM/PATTERN=T:X"), HasSubstr("PATTERN of EQUILIBRIUM takes TRUE or FALSE, not X"));
  EXPECT_THAT(error("EQUILIBRIUM/PATTERN=T:T:T:T:T:T:T:T:T:T:T"), HasSubstr("[value-out-of-range]"));
  EXPECT_THAT(error("IC/HMAX=1"), HasSubstr("[unknown-argument]"));
  EXPECT_THAT(error("INTEGRATOR/GSTIF, HHH"), HasSubstr("model.adm:10:19: error"));
  EXPECT_THAT(error("OUTPUT/REQSAV, GR521SAV"), HasSubstr("model.adm:10:16: error"));
  EXPECT_THAT(error("RESULTS/XRF, DECIMALPLACES=0"), HasSubstr("[value-out-of-range]"));
  EXPECT_THAT(error("REQUEST/1, DISPLACEMENT, K=3"), HasSubstr("model.adm:10:26: error"));
  EXPECT_THAT(error("GRAPHICS/1, BALL, CM=20"), HasSubstr("[unknown-argument]"));
  EXPECT_THAT(error("DEBUG/EVERYTHING"), HasSubstr("[unknown-argument]"));
  EXPECT_THAT(error("PREFERENCES/SOLVERS=F77"), HasSubstr("[unknown-argument]"));
  // Commands have no id.
  EXPECT_THAT(with("", "SAVE/STATES\n").err, HasSubstr("SAVE needs FILE"));
  EXPECT_THAT(error("PART/9, MASS=2.0d0"), HasSubstr("the letter of an exponent is E"));
  EXPECT_THAT(error("PART/9, MASS=2 kg"), HasSubstr("units are not written behind numbers"));
  const RunResult command = with("", "EQUIL/MAXIT=20, FOO=3\nSIM/STAT\n");
  EXPECT_EQ(command.status, 1);
  EXPECT_THAT(command.err, HasSubstr("model.acf:3:17: error"));
}

TEST_F(Settings, of_commands_replace_those_of_the_dataset_and_are_named_once) {
  const RunResult r =
      with("EQUILIBRIUM/STABILITY=1E-6\n",
           "equil/maxit=100,stab=1e-3,imb=1,alim=2.0D,tlim=5,err=0.5\nequil/err=0.5, stab=1e-6\nint/hht, "
           "error=1e-5\ninte/list\nequilibrium/list\noutput/noprint\nic/list\nsim/stat\nlin/eig\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(count(r.err, "EQUILIBRIUM/ERROR"), 0u) << r.err;
  EXPECT_EQ(count(r.err, "EQUILIBRIUM/STABILITY"), 0u) << r.err;
  EXPECT_EQ(count(r.err, "INTEGRATOR/HHT"), 0u) << r.err;
  EXPECT_EQ(count(r.err, "OUTPUT/NOPRINT"), 0u) << r.err;
  expect_eigenvalues(r.eigenvalues(8), {{0, 2 / (2 * std::numbers::pi)}}, 1e-11);
}

TEST_F(Settings, a_rotation_limit_bounds_the_steps_of_statics) {
  // The drawn pendulum is level: steps of at most one degree need nearly ninety of them, ones of forty few.
  const auto iterations = [&](const std::string& lines, const std::string& commands) {
    const RunResult r = with(lines, commands + "SIMULATE/STATIC\nLINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    const auto at = r.message.find("converged in ");
    return at == std::string::npos ? -1 : std::stoi(r.message.substr(at + 13));
  };
  const int coarse = iterations("EQUILIBRIUM/ALIMIT=40D\n", ""), fine = iterations("EQUILIBRIUM/ALIMIT=1D\n", "");
  EXPECT_GT(coarse, 0);
  EXPECT_LT(coarse, 40);
  EXPECT_GT(fine, 75);
  EXPECT_EQ(iterations("EQUILIBRIUM/ALIMIT=40D\n", "EQUILIBRIUM/ALIMIT=1D\n"), fine);
  EXPECT_EQ(iterations("EQUILIBRIUM/ALIMIT=1D\n", "EQUILIBRIUM/DEFAULT, ALIMIT=40D\n"), coarse);
}

// A slider along z under a force; the model is 1 long.
class StaticSettings : public Settings {
 protected:
  RunResult slider(const std::string& force, const std::string& settings) const {
    return run(
        "Slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,1\n"
        "MARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=" +
            force + "\n" + settings + "END\n",
        "SIMULATE/STATICS\n");
  }
};

TEST_F(StaticSettings, a_translation_limit_bounds_the_steps) {
  const auto iterations = [&](const std::string& settings) {
    const RunResult r = slider("101-DZ(20)", settings);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.result(0).at("iterations").get<int>() : -1;
  };
  EXPECT_LT(iterations(""), 5);
  EXPECT_GE(iterations("EQUILIBRIUM/TLIMIT=2\n"), 50);
  EXPECT_LT(iterations("EQUILIBRIUM/TLIMIT=2\n"), 60);
  EXPECT_LT(iterations("EQUILIBRIUM/TLIMIT=50\n"), 8);
}

// A pendulum that leans 0.5 rad from upright: Newton's method climbs, everything else falls.
class StaticMethods : public Settings {
 protected:
  RunResult leaning(const std::string& settings, const std::string& commands = "") const {
    return run(
        "Leaning\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1, REULER=0,90D,0\nPART/2, "
        "REULER=0,0.5,0, QG=0,-0.479425538604203,0.877582561890373, MASS=1, CM=20, IP=0.1,0.1,0.1\nMARKER/20\n"
        "MARKER/21, QP=0,0,-1, REULER=90D,90D,0\nMARKER/2, PART=1, REULER=90D,90D,0\n"
        "JOINT/1, REVOLUTE, I=21, J=2\n" +
            settings + "END\n",
        commands + "SIMULATE/STATICS\n");
  }
};

TEST_F(StaticMethods, newtons_comes_first_where_it_is_asked_for) {
  for (const char* settings : {"EQUILIBRIUM/METHOD=ORIGINAL\n", "EQUILIBRIUM/METH=ORIG, STAB=1E-3, PATTERN=T:F\n",
                               "EQUILIBRIUM/STABILITY=1E-4\n", "EQUILIBRIUM/PATTERN=TRUE\n"}) {
    const RunResult r = leaning(settings);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("unstable: 1 mode grows")) << settings;
  }
  for (const char* settings : {"", "EQUILIBRIUM/MAXIT=200\n", "EQUILIBRIUM/STABILITY=1E-4, METHOD=ADVANCED\n",
                               "EQUILIBRIUM/METHOD=ORIGINAL\nEQUILIBRIUM/DEFAULT\n"}) {
    const RunResult r = leaning(settings);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("nothing grows")) << settings;
  }
}

TEST_F(StaticMethods, where_newtons_fails_the_others_follow_and_a_remark_says_so) {
  const RunResult r = leaning("EQUILIBRIUM/METHOD=ORIGINAL, MAXIT=2\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("came to no equilibrium in 2 iterations"));
  EXPECT_EQ(r.json.at("warnings").at(0).at("code"), "other-search");
  EXPECT_THAT(r.out, HasSubstr("nothing grows"));
}

TEST_F(StaticMethods, a_damped_motion_comes_first_where_it_is_asked_for) {
  const RunResult r = leaning("EQUILIBRIUM/DYNAMIC, GLOBAL_DAMPING=3\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.err.find("other-search"), std::string::npos) << r.err;
  EXPECT_THAT(r.out, HasSubstr("nothing grows"));
  for (const char* settings : {"EQUILIBRIUM/DYNAMIC, SETTLING_TIME=1E-9\n", "EQUILIBRIUM/DYNAMIC, TEND=1E-9\n"}) {
    const RunResult brief = leaning(settings);
    ASSERT_EQ(brief.status, 0) << brief.err;
    EXPECT_THAT(brief.err, HasSubstr("did not settle")) << settings;
    EXPECT_THAT(brief.out, HasSubstr("nothing grows"));
  }
  const RunResult still = leaning("EQUILIBRIUM/DYNAMIC, SETTLING_TIME=1E-9\nEQUILIBRIUM/STATIC\n");
  EXPECT_EQ(still.err.find("did not settle"), std::string::npos) << still.err;
}

// 0.01 + 100 |z − 1.001| has no zero: the step to its kink is of 1e-4, and 0.01 stays out of balance there. A force
// that fades like e^−z is as small as one likes somewhere, and Newton's step stays 1.
TEST_F(StaticSettings, error_and_imbalance_say_what_is_taken_where_nothing_is_exact) {
  const std::string kink = "0.01+100*ABS(DZ(20)-1.001)", fade = "EXP(-DZ(20))";
  const auto status = [&](const std::string& force, const std::string& settings) {
    const RunResult r = slider(force, settings);
    if (r.status == 0) {
      EXPECT_EQ(r.json.at("warnings").at(0).at("code"), "loose-equilibrium") << r.err;
      EXPECT_THAT(r.err, HasSubstr("within what EQUILIBRIUM allows"));
    } else {
      EXPECT_THAT(r.err, HasSubstr("no equilibrium was found"));
    }
    return r.status;
  };
  EXPECT_EQ(status(kink, ""), 2);
  EXPECT_EQ(status(kink, "EQUILIBRIUM/ERROR=1e-3, IMBALANCE=0.1\n"), 0);
  EXPECT_EQ(status(kink, "EQUILIBRIUM/ERROR=1e-3, IMBALANCE=1e-3\n"), 2);
  EXPECT_EQ(status(kink, "EQUILIBRIUM/ERROR=1e-6, IMBALANCE=0.1\n"), 2);
  EXPECT_EQ(status(fade, ""), 2);
  EXPECT_EQ(status(fade, "EQUILIBRIUM/ERROR=2\n"), 0);
  EXPECT_EQ(status(fade, "EQUILIBRIUM/ERROR=0.5\n"), 2);
  EXPECT_EQ(status(fade, "EQUILIBRIUM/IMBALANCE=100\n"), 2);
}

TEST_F(StaticSettings, never_make_an_equilibrium_less_exact) {
  const RunResult r = slider("2-DZ(20)**3", "EQUILIBRIUM/ERROR=1, IMBALANCE=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(r.result(0).at("operating_point").at("bodies").at(0).at("position").at(2).get<double>(), std::cbrt(2.0),
              1e-15);
  EXPECT_TRUE(r.json.at("warnings").empty()) << r.err;
}

TEST_F(Settings, nolinear_keeps_linear_results_out_of_the_results_file) {
  const RunResult with_linear = with("RESULTS/XRF\n");
  ASSERT_EQ(with_linear.status, 0) << with_linear.err;
  EXPECT_THAT(with_linear.text("model.res"), HasSubstr("<dl:Mode"));
  const RunResult without = with("RESULTS/XRF, NOLINEAR\n", "LINEAR/EIGENSOL\nLINEAR/STATEMAT, FILE=a\n");
  ASSERT_EQ(without.status, 0) << without.err;
  EXPECT_THAT(without.text("model.res"), HasSubstr("<Results"));
  EXPECT_THAT(without.text("model.res"), Not(HasSubstr("<dl:Linear")));
}

TEST_F(Settings, that_nothing_was_said_of_give_no_remark) {
  const RunResult r = with("");
  EXPECT_THAT(r.err, Not(HasSubstr("passed over")));
}

}  // namespace
}  // namespace dynalin::cases::settings_test
