// Rest of models in which stiff elements stand beside soft ones: what their rounding is as large as a load, or larger,
// moves what it holds in itself and nothing else.
#include <dynalin/study.h>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "cases/study_of.h"

namespace dynalin::cases::stiff_statics_test {
namespace {

StaticResult rest_of(const std::string& text) { return study_of(text).static_equilibrium().static_result(); }
double height_of(const StaticResult& r, std::size_t body) { return r.at_rest.bodies.at(body).position[1]; }

// Two lumps of a gram, one welded to the other by an element between markers 30 and 21, hang on a soft spring in a
// slide that is drawn away from the origin.
struct Welded {
  std::string weld;
  double soft = 1e-3, away = 1000;
  std::string units = "FORCE=NEWTON,MASS=KILOGRAM,LENGTH=MILLIMETER,TIME=SECOND";
  double gravity = -9806.65;

  std::string text() const {
    return fmt::format(
        "Welded lumps\nUNITS/{4}\nACCGRAV/JGRAV={5}\nPART/1,GROUND\n"
        "MARKER/1,QP={0},{0},0\nPART/2,MASS=0.001,CM=20,IP=1,1,1,QG={0},{0},0\nMARKER/20\nMARKER/21,QP=50,0,0\n"
        "PART/3,MASS=0.001,CM=30,IP=1,1,1,QG={1},{0},0\nMARKER/30\nJOINT/1,TRANS,I=22,J=2\n"
        "MARKER/22,PART=2,REULER=0,-90D,0\nMARKER/2,PART=1,QP={0},{0},0,REULER=0,-90D,0\n"
        "BUSHING/1,I=20,J=1,K={2},{2},{2}\n{3}END\n",
        away, away + 50, soft, weld, units, gravity);
  }
  double sag() const { return height_of(rest_of(text()), 0) - away; }
  double expected() const { return -2 * 0.001 * 9.80665 / soft; }
};

std::string bushing(double k) { return fmt::format("BUSHING/2,I=30,J=21,K={0},{0},{0},KT={0},{0},{0}\n", k); }

TEST(StiffStatics, what_a_stiff_bushing_welds_hangs_as_what_a_joint_welds) {
  struct Case {
    double stiffness, soft, away;
  };
  for (const auto& [stiffness, soft, away] : {Case{1e9, 1e-3, 1e3},
                                              {1e8, 1e-3, 1e4},
                                              {1e8, 1e-2, 1e5},
                                              {1e7, 1e-3, 1e5},
                                              {1e9, 1e-2, 1e4},
                                              {1e10, 1e-2, 0},
                                              {1e10, 1e-2, 100}}) {
    const Welded w{.weld = bushing(stiffness), .soft = soft, .away = away};
    EXPECT_NEAR(w.sag(), w.expected(), 1e-6 * std::abs(w.expected())) << stiffness << " at " << away;
  }
}

TEST(StiffStatics, so_does_what_other_stiff_elements_weld) {
  std::string field = "FIELD/2,I=30,J=21,KMATRIX=1E9";
  for (int k = 1; k < 36; ++k) field += fmt::format("{},{}", k % 6 == 0 ? "\n" : "", k % 7 == 0 ? "1E9" : "0");
  const std::string slide =
      "JOINT/2,TRANS,I=32,J=24\nMARKER/32,PART=3,REULER=0,-90D,0\nMARKER/24,PART=2,QP=50,0,0,REULER=0,-90D,0\n"
      "MARKER/25,PART=2,QP=50,-100,0\n";
  for (const std::string& weld : {
           field + "\n",
           std::string("BEAM/2,I=30,J=20,LENGTH=50,IXX=1E6,IYY=1E6,IZZ=1E6,AREA=1E5,EMOD=2E9,GMOD=1E9\n"),
           slide + "SFORCE/2,TRANS,I=32,J=25,FUNCTION=-1E9*(DM(32,25)-100)\n",
           slide + "SPRINGDAMPER/2,TRANS,I=32,J=25,K=1E9,LENGTH=100\n",
       }) {
    const Welded w{.weld = weld};
    EXPECT_NEAR(w.sag(), w.expected(), 1e-6 * std::abs(w.expected())) << weld;
  }
}

// A third lump, welded to the second.
TEST(StiffStatics, so_do_three_in_a_row) {
  const Welded w{.weld = bushing(1e9) +
                         "PART/4,MASS=0.001,CM=40,IP=1,1,1,QG=1100,1000,0\nMARKER/40\nMARKER/31,PART=3,QP=50,0,0\n"
                         "BUSHING/3,I=40,J=31,K=1E9,1E9,1E9,KT=1E9,1E9,1E9\n"};
  EXPECT_NEAR(w.sag(), 1.5 * w.expected(), 1e-6 * std::abs(w.expected()));
}

// What spins freely beside it says nothing of what is welded.
TEST(StiffStatics, so_do_two_beside_a_part_that_turns_as_it_likes) {
  const Welded w{.weld = bushing(1e9) +
                         "PART/4,MASS=0.001,CM=40,IP=1,1,1,QG=500,0,0\nMARKER/40\nMARKER/41,PART=1,QP=500,0,0\n"
                         "JOINT/4,SPHERICAL,I=40,J=41\n"};
  EXPECT_NEAR(w.sag(), w.expected(), 1e-6 * std::abs(w.expected()));
}

// Beyond what 16 digits tell apart nothing is found rather than something wrong.
TEST(StiffStatics, a_weld_whose_rounding_is_stiffer_than_the_support_is_refused) {
  for (const double stiffness : {1e12, 1e13, 1e14, 1e15, 1e17}) {
    const Welded w{.weld = bushing(stiffness)};
    try {
      EXPECT_NEAR(w.sag(), w.expected(), 1e-2 * std::abs(w.expected())) << stiffness;
    } catch (const Error& e) {
      EXPECT_THAT(std::string(e.what()), ::testing::HasSubstr("no equilibrium was found")) << stiffness;
    }
  }
}

// Newtons and meters, gravity in them: 1e12 N/m and 1 N/m at a kilometer.
TEST(StiffStatics, units_make_no_difference) {
  const Welded w{.weld = bushing(1e12), .soft = 1, .away = 1, .units = "SYSTEM=MKS", .gravity = -9.80665};
  EXPECT_NEAR(w.sag(), w.expected(), 1e-6 * std::abs(w.expected()));
}

// F L³/3EI; the shear is next to nothing.
TEST(StiffStatics, a_beam_that_shear_does_not_bend_bends_under_its_load) {
  const std::string text =
      "Beam\nUNITS/SYSTEM=MKS\nPART/1,GROUND\nMARKER/1\nMATERIAL/1,DENSITY=7800,YOUNGS_MODULUS=2.1E11,"
      "POISSONS_RATIO=0.3\nFE_PART/2,TYPE=3DBEAM,MATERIAL=1,NODE_LABELS=1,2,3,X=0,0.5,1,AREA=1E-4,IYY=8E-10,IZZ=5E-10,"
      "ASY=1E-6,ASZ=1E-6\nMARKER/21,FE_PART=2,NODE_LABEL=1\nMARKER/22,FE_PART=2,NODE_LABEL=3,QP=1,0,0\n"
      "JOINT/1,FIXED,I=21,J=1\nMARKER/9,PART=1,FLOATING\nGFORCE/1,I=22,JFLOAT=9,RM=1,FY=0.1\nEND\n";
  EXPECT_NEAR(height_of(rest_of(text), 2), 0.1 / (3 * 2.1e11 * 5e-10), 1e-9);
}

// An arm of a meter on a bushing, stiff along the arm: m g/k + m g/k_T · 1 down, and the arm is level to 1e-4.
TEST(StiffStatics, an_arm_that_is_held_stiffly_along_itself_sinks_as_far_as_softness_across_it_lets_it) {
  for (const char* stiffness : {"1E6", "1E9", "1E11", "1E12", "1E13", "1E14"}) {
    const std::string text = fmt::format(
        "Arm\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1,GROUND\nMARKER/1\nPART/2,MASS=0.001,CM=2,IP=1,1,1,"
        "QG=1,0,0\nMARKER/2\nMARKER/3,QP=-1,0,0\nBUSHING/1,I=3,J=1,K={0},1,1,KT={0},1,1\nEND\n",
        stiffness);
    // φ = m g cos φ/k_T turns the arm.
    double angle = 0;
    for (int k = 0; k < 20; ++k) angle = 0.01 * std::cos(angle);
    EXPECT_NEAR(height_of(rest_of(text), 0), -0.01 - std::sin(angle), 1e-9) << stiffness;
  }
}

// T L/G J at the end of a rod.
TEST(StiffStatics, a_rod_that_is_twisted_far_rests) {
  const std::string text =
      "Rod\nUNITS/FORCE=NEWTON,MASS=KILOGRAM,LENGTH=MILLIMETER,TIME=SECOND\nPART/1,GROUND\nMARKER/1\nMARKER/"
      "9,FLOATING\n"
      "MATERIAL/1,DENSITY=7.8E-6,YOUNGS_MODULUS=2.1E5,POISSONS_RATIO=.3\n"
      "FE_PART/2,TYPE=3DBEAM,MATERIAL=1,NODE_LABELS=1,2,3,4,5,6,7,X=0,84.947043834196776,169.89408766839355,"
      "254.84113150259031,339.78817533678711,424.7352191709839,509.68226300518063,AREA=187.94139577918645,"
      "IYY=2810.832923156633,IZZ=2810.832923156633\nMARKER/21,NODE_LABEL=1\nMARKER/"
      "22,NODE_LABEL=7,QP=509.68226300518063,0,0\n"
      "JOINT/1,FIXED,I=21,J=1\nGFORCE/1,I=22,JFLOAT=9,RM=1,TX=3403.20321\nEND\n";
  EXPECT_NEAR(rest_of(text).at_rest.bodies.at(6).position[0], 509.68226300518063, 1e-6);
}

// A mass on a slide at a meter from where a force is zero.
std::string slide(const std::string& force, double at) {
  return fmt::format(
      "Slide\nUNITS/SYSTEM=MKS\nPART/1,GROUND\nMARKER/1\nMARKER/2,PART=1,REULER=90D,90D,0\nPART/2,MASS=2,CM=20,"
      "IP=1,1,1,QG={},0,0\nMARKER/20\nMARKER/22,PART=2,REULER=90D,90D,0\nJOINT/1,TRANSLATIONAL,I=22,J=2\n{}END\n",
      at, force);
}

// The point itself is one where the spring has no direction.
TEST(StiffStatics, a_spring_without_length_draws_its_mass_in) {
  for (const double at : {1.0, 0.3, -7.0, 1e3}) {
    const auto r = rest_of(slide("SPRINGDAMPER/1,TRANS,I=20,J=1,K=10\n", at));
    EXPECT_NEAR(r.at_rest.bodies.at(0).position[0], 0, 1e-12 * std::abs(at)) << at;
    EXPECT_LT(r.iterations, 200) << at;
  }
}

TEST(StiffStatics, a_force_that_vanishes_in_any_order_lets_its_mass_rest_where_it_does) {
  for (const char* power : {"3", "5"}) {
    for (const double at : {1.0, 0.3, -7.0}) {
      const auto r =
          rest_of(slide(fmt::format("SFORCE/1,TRANSLATIONAL,ACTIONONLY,I=20,J=2,FUNCTION=-DX(20)**{}\n", power), at));
      EXPECT_NEAR(r.at_rest.bodies.at(0).position[0], 0, 1e-4) << at;
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::stiff_statics_test
