// What statics may call an equilibrium and what not: forces that fade or just miss zero, light parts beside heavy ones,
// contacts, equations without a value, models that nothing holds.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "analysis/statics.h"
#include "cases/dataset_text.h"
#include "cases/study_of.h"
#include "elements/catalogue.h"
#include "places/sanitizers.h"

namespace dynalin::cases::static_truth_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double two_pi = 2 * 3.14159265358979323846;

class StaticTruth : public Cases {
 protected:
  static std::string dataset(const std::string& elements, const std::string& gravity) {
    return "Statics\nUNITS/SYSTEM=MKS\nACCGRAV/" + gravity + "\nPART/1, GROUND\nMARKER/1\n" + elements + "END\n";
  }
  RunResult rest(const std::string& elements, const std::string& gravity = "KGRAV=0") const {
    return run(dataset(elements, gravity), "SIMULATE/STATIC\nLINEAR/EIGENSOL\n");
  }
  // A unit mass on a slide along z at a height, under a force along it.
  static std::string slide(const std::string& force, double height) {
    return fmt::format(
        "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,{}\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
        "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION={}\n",
        height, force);
  }
};

const std::vector<std::pair<std::string, double>> without_equilibrium = {
    {"1/DZ(20,1)**2", 3},
    {"1/DZ(20,1)**2", 3e4},
    {"EXP(-DZ(20,1))", 1},
    {"EXP(-DZ(20,1)**2)", 1},
    {"EXP(-1000*DZ(20,1))", 0.1},  // gives no more than 0 at places where the search
                                   // looks
    {"-(DZ(20,1)-.3)**2-1E-10", 1},
    {"-(DZ(20,1)-.3)**2-1E-10", 0.2},
    {"-(DZ(20,1)-.3)**2-1E-16", 1},
    {"1E-12*EXP(-DZ(20,1))", 1},
    {"1E12/DZ(20,1)**3", 1},
};

TEST_F(StaticTruth, a_force_that_fades_or_just_misses_zero_is_no_equilibrium_and_its_part_is_named) {
  for (const auto& [force, height] : without_equilibrium) {
    const RunResult r = rest(slide(force, height));
    EXPECT_EQ(r.status, 2) << force;
    EXPECT_THAT(r.err, HasSubstr("PART/2")) << force;
    EXPECT_EQ(r.out, "") << force;
  }
}

// Two parts that a lock ties and nothing else acts on, drawn apart: after assembly they rest as they are, without any
// reaction. Steps that only chase rounding would leave some of 1e-90, which make nonsense of the linear model.
TEST_F(StaticTruth, where_nothing_acts_nothing_reacts) {
  const RunResult r = rest(
      "PART/2, MASS=1, CM=20, IP=1,1,1, REULER=-1.1516,2.0449,3.035\nMARKER/20\n"
      "MARKER/70, PART=2, REULER=1.552,0.6057,-1.1099\nPART/3, MASS=1, CM=30, IP=1,1,1, REULER=-1.0988,1.4543,1.5829\n"
      "MARKER/30\nMARKER/71, PART=3, REULER=-2.2043,0.8792,-2.5246\nJPRIM/1, ORIENTATION, I=71, J=70\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto& reaction = r.result(0).at("operating_point").at("reactions").at(0);
  for (const char* part : {"force", "torque"}) {
    for (const double x : reaction.at(part).get<std::vector<double>>()) EXPECT_EQ(x, 0) << part;
  }
  EXPECT_EQ(r.eigenvalues(1).size(), 18u);
}

// A mechanism that a motion has led to where it is, without any load: its reactions of before are gone at once, and it
// stays. Each step would leave a part of 1e-16 of them, and what is chased to 1e-272 led the slider to its other
// branch.
TEST_F(StaticTruth, what_was_led_somewhere_and_bears_nothing_stays_there) {
  const std::string crank =
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/22, PART=2, QP=1,0,0\n"
      "PART/3, MASS=2, CM=30, IP=3,3,3, QG=2.5,0,0\nMARKER/30\nMARKER/31, PART=3, QP=-1.5,0,0\nMARKER/32, PART=3, "
      "QP=1.5,0,0\nPART/4, MASS=3, CM=40, IP=1,1,1, QG=4,0,0\nMARKER/40, PART=4, REULER=90D,90D,0\nMARKER/41, PART=4\n"
      "MARKER/4, PART=1, REULER=90D,90D,0\nJOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=31, J=22\n"
      "JOINT/3, REVOLUTE, I=32, J=41\nJOINT/4, TRANSLATIONAL, I=40, J=4\nMOTION/1, JOINT=1, FUNCTION=TIME\n";
  const std::string damper = "SPRINGDAMPER/1, TRANSLATIONAL, I=40, J=1, K=0, C=3, LENGTH=1\n";
  // What does bear something, beside it.
  const std::string loaded =
      "PART/9, MASS=5, CM=90, IP=1,1,1, QG=0,0,9\nMARKER/90\nMARKER/9, PART=1, QP=0,0,9\nJOINT/9, TRANSLATIONAL, I=90, "
      "J=9\nSFORCE/9, TRANSLATIONAL, I=90, J=9, ACTIONONLY, FUNCTION=7-100*DZ(90,9)\n";
  for (const std::string& with : {std::string(), damper, loaded}) {
    for (const double angle : {0.13, 0.71, 1.9, 3.3}) {
      const RunResult r =
          run(dataset(crank + with, "KGRAV=0"), fmt::format("SIMULATE/{}, END={}, STEPS=10\nSIMULATE/STATICS\n",
                                                            with == loaded ? "DYNAMICS" : "KINEMATICS", angle));
      ASSERT_EQ(r.status, 0) << r.err;
      const auto& bodies = r.result(1).at("operating_point").at("bodies");
      EXPECT_NEAR(bodies.at(2).at("position").at(0).get<double>(),
                  std::cos(angle) + std::sqrt(9 - std::sin(angle) * std::sin(angle)), 1e-9)
          << with << angle;
    }
  }
}

TEST_F(StaticTruth, nor_is_it_beside_a_part_a_million_times_as_heavy) {
  for (const auto& [force, height] : without_equilibrium) {
    const RunResult r = rest(slide(force, height) +
                                 "PART/3, MASS=1E6, CM=30, IP=1,1,1, QG=1,0,0\nMARKER/30\nMARKER/3, PART=1, QP=1,0,0\n"
                                 "JOINT/3, TRANSLATIONAL, I=30, J=3\nSFORCE/3, TRANSLATIONAL, I=30, J=3, ACTIONONLY, "
                                 "FUNCTION=-1E9*DZ(30,3)-1E7\n",
                             "IGRAV=-9.81");
    EXPECT_EQ(r.status, 2) << force;
    EXPECT_THAT(r.err, HasSubstr("PART/2")) << force;
  }
}

// The weight that the slide carries hides the force in its rounding after 35 lengths.
TEST_F(StaticTruth, nor_is_it_where_the_rounding_of_a_carried_weight_hides_it) {
  for (const char* force : {"EXP(-DZ(22,2))", "EXP(-20*DZ(22,2))"}) {
    const RunResult r =
        rest(fmt::format("PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/22, REULER=120D,90D,0\nMARKER/2, PART=1, "
                         "REULER=120D,90D,0\nJOINT/1, TRANSLATIONAL, I=22, J=2\nMARKER/3, PART=1, QP=1,0,0\n"
                         "SFORCE/1, TRANSLATIONAL, I=22, J=2, ACTIONONLY, FUNCTION={}\n",
                         force),
             "IGRAV=-5, JGRAV=-8.66025403784438646763");
    EXPECT_EQ(r.status, 2) << force << r.out;
    EXPECT_THAT(r.err, HasSubstr("PART/2"));
  }
}

TEST_F(StaticTruth, a_state_whose_rate_only_fades_does_not_rest) {
  const RunResult r = rest(slide("-DZ(20,1)", 1) + "DIFF/7, IC=1, FUNCTION=EXP(-DIF(7))\n");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("DIFF/7"));
}

TEST_F(StaticTruth, what_balances_a_small_force_is_found_to_the_last_digits) {
  for (const double load : {1e-4, 1e-8, 1e-12}) {
    const RunResult r = rest(slide(fmt::format("EXP(-DZ(20,1))-{}", load), 1));
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_NEAR(r.eigenvalues(1)[0].imag(), std::sqrt(load) / two_pi, 1e-9 * std::sqrt(load));
  }
}

// The tangent vanishes at z = 0.3, where the force is zero all the same; steps that halve come to an end.
TEST_F(StaticTruth, a_double_root_is_an_equilibrium_as_far_as_numbers_tell) {
  const RunResult r = rest(slide("-(DZ(20,1)-.3)**2", 1));
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_LT(std::abs(r.eigenvalues(1)[0]), 1e-5);  // √(2 d)/2π at the distance d
}

TEST_F(StaticTruth, two_roots_that_are_close_together_are_found_apart) {
  const RunResult r = rest(slide("-(DZ(20,1)-.3)**2+1E-10", 1));
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(r.eigenvalues(1)[0].imag(), std::sqrt(2e-5) / two_pi, 1e-9);
}

TEST_F(StaticTruth, a_cable_that_becomes_slack_leaves_its_load_where_it_is) {
  const RunResult r = rest(slide("-MAX(0,DZ(20,1)-1)", 3));
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST_F(StaticTruth, a_light_part_on_a_heavy_one_rests_as_exactly_as_the_heavy_one) {
  const std::string heavy =
      "PART/2, MASS=1E6, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=-1E9*DZ(20,1)\n"
      "PART/3, MASS=1E-6, CM=30, IP=1,1,1, QG=0,0,-1\nMARKER/30\nJOINT/2, TRANSLATIONAL, I=30, J=20\n";
  // Hanging at a distance d with 1E-6 (e^(d−1) − 1) = 1E-6 · 9.81; k/m = e^(d−1) = 10.81.
  const RunResult r =
      rest(heavy + "SFORCE/2, TRANSLATIONAL, I=30, J=20, FUNCTION=-1E-6*(EXP(-DZ(30,20)-1)-1)\n", "KGRAV=-9.81");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto values = r.eigenvalues(1);
  ASSERT_EQ(values.size(), 4u);
  EXPECT_NEAR(values[0].imag(), std::sqrt(10.81) / two_pi, 1e-9);
  EXPECT_THAT(r.err, Not(HasSubstr("accelerates")));
}

TEST_F(StaticTruth, the_imbalance_that_is_printed_is_that_of_the_point) {
  const RunResult r = rest(slide("-(DZ(20,1)-.3)**2+1E-10", 1));
  ASSERT_EQ(r.status, 0) << r.err;
  const auto at = r.out.find("imbalance ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_LT(std::stod(r.out.substr(at + 10)), 1e-16);
}

// Not what is left of it while the value of the force itself is still to be changed: nowhere is the force below 1E-10.
TEST_F(StaticTruth, so_is_the_imbalance_of_a_search_that_failed) {
  for (const double least : {1e-10, 1e-3}) {
    const RunResult r = rest(slide(fmt::format("-(DZ(20,1)-.3)**2-{}", least), 1));
    EXPECT_EQ(r.status, 2);
    int printed = 0;
    for (auto at = r.err.find("imbalance "); at != std::string::npos;
         at = r.err.find("imbalance ", at + 1), ++printed) {
      EXPECT_GE(std::stod(r.err.substr(at + 10)), 0.9 * least) << r.err;
    }
    EXPECT_GE(printed, 2) << r.err;
  }
}

TEST_F(StaticTruth, a_mass_far_inside_a_contact_or_far_above_it_comes_to_rest_on_it) {
  for (const double exponent : {1.5, 2.2, 3.0}) {
    for (const double height : {-50.0, -0.5, 0.0999, 3.0, 1e4}) {
      const RunResult r =
          rest(slide(fmt::format("IMPACT(DZ(20,1),VZ(20,1),0.1,1E8,{},1E4,1E-3)", exponent), height), "KGRAV=-9.81");
      ASSERT_EQ(r.status, 0) << exponent << " from " << height << r.err;
      // k p^e = m g; k e p^(e−1) is the stiffness, and their product with the damping the eigenvalues' product.
      const double depth = std::pow(9.81 / 1e8, 1 / exponent);
      const auto values = r.eigenvalues(1);
      ASSERT_EQ(values.size(), 2u);
      const double product = std::abs(values[0] * values[1]) * two_pi * two_pi;
      EXPECT_NEAR(product, exponent * 9.81 / depth, 1e-7 * exponent * 9.81 / depth) << exponent << " from " << height;
    }
  }
}

TEST_F(StaticTruth, a_contact_without_weight_opens_and_leaves_the_mass_there) {
  for (const double exponent : {1.5, 2.2}) {
    const RunResult r = rest(slide(fmt::format("IMPACT(DZ(20,1),VZ(20,1),0.1,1E8,{},1E4,1E-3)", exponent), -0.5));
    EXPECT_EQ(r.status, 0) << exponent << r.err;
  }
}

struct Fault {
  std::string elements, named;
};
const std::string free_part = "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n";
const std::vector<Fault> faults = {
    {free_part + "JOINT/1, TRANSLATIONAL, I=20, J=1\nVARIABLE/1, FUNCTION=DM(20,1)\n"
                 "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=100*(0.5/VARVAL(1))**1.4\n",
     "SFORCE/1: division by 0"},
    {free_part + "JOINT/1, TRANSLATIONAL, I=20, J=1\nVARIABLE/1, FUNCTION=0\n"
                 "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=100*(0.5/VARVAL(1))**1.4\n",
     "SFORCE/1: division by 0"},
    {free_part + "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=10, LENGTH=1\n", "SPRINGDAMPER/1"},
    {free_part + "DIFF/1, FUNCTION=1/DIF(1)-1\n", "DIFF/1: division by 0"},
};

TEST_F(StaticTruth, equations_without_a_value_at_the_start_fail_by_name) {
  for (const Fault& f : faults) {
    const RunResult r = rest(f.elements);
    EXPECT_EQ(r.status, 2);
    EXPECT_THAT(r.err, HasSubstr(f.named));
    const auto study = study_of(dataset(f.elements, "KGRAV=0"));
    try {
      study.static_equilibrium();
      ADD_FAILURE() << "no error: " << f.named;
    } catch (const Error& e) {
      EXPECT_THAT(std::string(e.what()), HasSubstr(f.named));
    }
  }
}

TEST_F(StaticTruth, without_anything_that_moves_there_is_nothing_to_find) {
  for (const std::string& elements : {std::string(), free_part + "JOINT/1, FIXED, I=20, J=1\n"}) {
    const RunResult r = run(dataset(elements, "KGRAV=-9.81"), "SIMULATE/STATIC\n");
    EXPECT_EQ(r.status, 0) << r.err;
    const auto found = study_of(dataset(elements, "KGRAV=-9.81")).static_equilibrium();
    EXPECT_EQ(found.static_result().iterations, 0);
  }
}

// What damps at rest drives at the velocity of the dataset, −v + v³.
TEST_F(StaticTruth, stability_is_that_of_rest_and_not_of_the_velocities_that_come_back) {
  const RunResult r = rest(
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,1, VZ=5\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=-10*DZ(20,1)-VZ(20,1)+VZ(20,1)**3\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("nothing grows"));
  const auto values = r.eigenvalues(1);
  EXPECT_TRUE(std::any_of(values.begin(), values.end(), [](auto e) { return e.real() > 1; }));
}

// What has no slope at the point may hold or drive a little beside it: eigenvalues of zero do not say.
TEST_F(StaticTruth, stability_is_not_known_where_force_begins_with_a_higher_order) {
  for (const char* function : {"-(DZ(20,1)-.3)**2", "-(DZ(20,1)-.3)**3", "(DZ(20,1)-.3)**3"}) {
    const RunResult r = rest(slide(function, .3));
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("stability not known: to first order nothing holds DZ of PART/2 here"));
    EXPECT_THAT(r.out, Not(HasSubstr("nothing grows")));
  }
  // A box on a plane turns about the vertical as it likes, whichever way it stands: friction only slows it down.
  for (const char* angle : {"0", "1D", "3D", "20D", "45D", "90D"}) {
    const RunResult box =
        rest(std::string("PART/2, MASS=2, CM=20, IP=0.02,0.03,0.04, QG=0.1,0,0.049, REULER=") + angle +
                 ",0,0\nMARKER/20\nMARKER/21, QP=-0.1,-0.15,-0.05\nGRAPHICS/1, PLANE, RM=1, XMIN=-3, XMAX=3, YMIN=-3, "
                 "YMAX=3\nGRAPHICS/2, BOX, CORNER=21, X=0.2, Y=0.3, Z=0.1\nCONTACT/1, IGEOM=2, JGEOM=1, IMPACT, "
                 "STIFFNESS=2E4, EXPONENT=1.5, DAMPING=40, DMAX=0.001, COULOMB_FRICTION=ON, MU_STATIC=0.5, "
                 "MU_DYNAMIC=0.3, STICTION_TRANSITION_VELOCITY=0.1, FRICTION_TRANSITION_VELOCITY=0.5\n",
             "KGRAV=-10");
    ASSERT_EQ(box.status, 0) << box.err;
    EXPECT_THAT(box.out, HasSubstr("nothing grows")) << angle;
  }
  // What is free stays free.
  const RunResult free = rest(slide("0", .3));
  ASSERT_EQ(free.status, 0) << free.err;
  EXPECT_THAT(free.out, HasSubstr("nothing grows"));
}

// What grows at 1 rad/s beside a mass that swings at 1e8 rad/s.
TEST_F(StaticTruth, a_stiff_part_hides_no_growth_of_another) {
  const auto beside = [&](const char* force) {
    return rest(slide(force, .3) +
                "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nJOINT/2, TRANSLATIONAL, I=30, J=1\n"
                "SFORCE/2, TRANSLATIONAL, I=30, J=1, ACTIONONLY, FUNCTION=-1E16*DZ(30,1)\n");
  };
  const RunResult grows = beside("DZ(20,1)-.3"), swings = beside(".3-DZ(20,1)"),
                  damped = beside("-VZ(20,1)+.3-DZ(20,1)"), driven = beside("1E-3*VZ(20,1)+.3-DZ(20,1)");
  EXPECT_THAT(grows.out, HasSubstr("unstable: 1 mode grows")) << grows.err;
  EXPECT_THAT(swings.out, HasSubstr("nothing grows")) << swings.err;
  EXPECT_THAT(damped.out, HasSubstr("nothing grows")) << damped.err;
  EXPECT_THAT(driven.out, HasSubstr("unstable: 1 mode grows")) << driven.err;
}

// A part without mass between springs: nothing gives it an acceleration, and rest asks for none.
TEST_F(StaticTruth, parts_without_mass_need_none_to_rest) {
  const std::string text = dataset(
      "MARKER/2, QP=0,0,3\nPART/2, QG=0,0,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "PART/3, MASS=1, CM=30, IP=1,1,1, QG=0,0,2\nMARKER/30\nJOINT/2, TRANSLATIONAL, I=30, J=1\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=10, LENGTH=1.2\n"
      "SPRINGDAMPER/2, TRANSLATIONAL, I=20, J=30, K=10, LENGTH=1\n"
      "SPRINGDAMPER/3, TRANSLATIONAL, I=30, J=2, K=10, LENGTH=1\n",
      "KGRAV=-9.81");
  auto written = parse_dataset(std::make_shared<const SourceText>("massless.adm", text));
  auto built = build_model(std::make_shared<const Dataset>(std::move(written.value)), catalogue());
  ASSERT_FALSE(built.diagnostics.has_errors()) << render(built.diagnostics);
  const auto made = System::make(std::move(built.value)).value();
  const System& system = *made;
  Findings findings;
  StaticsReport report;
  const auto op = find_equilibrium(system, system.drawn(), {}, report, findings);
  ASSERT_TRUE(op) << op.error().message;
  // 2 z₂ = z₃ + 0.2 and 2 z₃ = z₂ + 3 − 0.981.
  EXPECT_NEAR(op->poses[1].r.z, 2.419 / 3, 1e-13);
  EXPECT_NEAR(op->poses[2].r.z, 4.838 / 3 - 0.2, 1e-13);
}

// A chain of links on pins, the last one turned by a torque that no pose of the chain can balance.
std::string spun_chain(int links) {
  std::string s;
  for (int k = 2; k < links + 2; ++k) {
    s += fmt::format(
        "PART/{0}, MASS=1, CM={0}0, IP=.1,.1,.1, QG={1},0,0\nMARKER/{0}0\nMARKER/{0}1, QP=-.5,0,0, REULER=0,90D,0\n"
        "MARKER/{0}2, QP=.5,0,0, REULER=0,90D,0\nJOINT/{0}, REVOLUTE, I={0}1, J={2}\n"
        "SFORCE/{0}, ROTATIONAL, I={0}1, J={2}, FUNCTION=10000\n",
        k, k - 1.5, k == 2 ? "2" : fmt::format("{}2", k - 1));
  }
  return "MARKER/2, PART=1, REULER=0,90D,0\n" + s;
}

TEST_F(StaticTruth, a_long_chain_without_equilibrium_is_refused_in_seconds_and_a_few_lines) {
  const std::clock_t start = std::clock();
  const RunResult r = rest(spun_chain(60), "KGRAV=-9.81");
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("PART/"));
  EXPECT_LE(std::count(r.err.begin(), r.err.end(), '\n'), 6);  // the last one names the files
  EXPECT_LT(seconds, sanitized ? 180 : 30);                    // of the processor; it was minutes
}

TEST_F(StaticTruth, a_part_so_far_out_that_rounding_is_larger_than_the_model_is_named) {
  std::string s;
  for (int k = 2; k < 22; ++k) {
    s += fmt::format(
        "PART/{0}, MASS=1, CM={0}0, IP=.1,.1,.1, QG={1:.17g},0,0\nMARKER/{0}0\n"
        "SPRINGDAMPER/{0}, TRANSLATIONAL, I={0}0, J={2}, K=1000, LENGTH=0.7\n",
        k, k == 12 ? 1e20 : k - 1.0, k == 2 ? "1" : fmt::format("{}0", k - 1));
  }
  const RunResult r = rest(s, "KGRAV=-9.81");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("PART/12 is so far out"));
}

}  // namespace
}  // namespace dynalin::cases::static_truth_test
