// FRICTION in what commands make of it: statics, the warning of a joint in stiction, deactivation.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cases/run.h"
#include "places/symmetric_friction.h"

namespace dynalin::cases::friction_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace symmetric;

class FrictionCases : public Cases {};

std::string block(const std::string& friction, const std::string& more = "") {
  return "Block\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\nMARKER/11, REULER=90D,90D,0\n"
         "PART/2, MASS=2, CM=2, IP=1,1,1\nMARKER/2, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=2, J=11\n" +
         friction + more + "END\n";
}

TEST_F(FrictionCases, a_joint_in_stiction_is_named_with_its_mode) {
  const std::string sticks = "FRICTION/4, JOINT=1, MU_STATIC=0.4, STICTION_TRANSITION_VELOCITY=1\n";
  const RunResult r = run(block(sticks), "LINEAR/EIGENSOL\n");
  EXPECT_THAT(r.err,
              HasSubstr("JOINT/1 is in stiction: the stiffness of FRICTION/4 may be spurious, and with it modes, "
                        "most of all in mode 2 of 3.8985 cycles/s [joint-in-stiction]"));
}

// Of creep alone, whose eigenvalue is zero: its velocities are rounding, and nothing is shared out of them.
TEST_F(FrictionCases, a_mode_of_creep_has_no_table_of_dissipated_power) {
  const std::string second =
      "PART/3, MASS=1.5, CM=3, IP=1,1,1, QG=0.5,0,0\nMARKER/3\nMARKER/33, REULER=90D,90D,0\nMARKER/12, PART=1, "
      "QP=-1,0,0\nJOINT/2, TRANSLATIONAL, I=33, J=11\nSPRINGDAMPER/1, TRANSLATIONAL, I=3, J=2, K=100, C=2, "
      "LENGTH=0.4\nSPRINGDAMPER/3, TRANSLATIONAL, I=3, J=12, K=20, C=1, LENGTH=1.5\n";
  const RunResult r =
      run(block("FRICTION/4, JOINT=1\n", second), "SIMULATE/STATICS\nLINEAR/EIGENSOL, DISSIPAT=1,3, STRAIN=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  ASSERT_LT(std::abs(r.eigenvalues(1)[0]), 1e-12);
  const std::string text = r.text("model.txt"), note = "No element of this table dissipates power in this mode.";
  EXPECT_NE(text.find(note), std::string::npos) << text;
  EXPECT_EQ(text.find(note), text.rfind(note)) << text;
}

TEST_F(FrictionCases, what_does_not_stick_is_not_named) {
  const auto warned = [&](const std::string& friction, const std::string& commands = "") {
    const RunResult r = run(block(friction), commands + "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err.find("joint-in-stiction") != std::string::npos;
  };
  EXPECT_TRUE(warned("FRICTION/4, JOINT=1\n"));
  EXPECT_TRUE(warned("FRICTION/4, JOINT=1, EFFECT=STICTION\n"));
  EXPECT_FALSE(warned("FRICTION/4, JOINT=1, EFFECT=SLIDING\n"));
  EXPECT_FALSE(warned("FRICTION/4, JOINT=1, INPUTS=NONE\n"));
  EXPECT_FALSE(warned("FRICTION/4, JOINT=1\n", "DEACTIVATE/FRICTION, ID=4\n"));
}

// A block on springs whose joint is taken out has 12 states, and none of bristles that nothing bends; they are there
// again with the joint.
TEST_F(FrictionCases, has_no_bristles_without_its_joint) {
  const RunResult r = run(block("FRICTION/4, JOINT=1, MU_STATIC=0.4\n", "BUSHING/1, I=2, J=11, K=10,20,30, KT=1,2,3\n"),
                          "LINEAR/EIGENSOL\nDEACTIVATE/JOINT, ID=1\nLINEAR/EIGENSOL\nSIMULATE/DYNAMICS, END=0.1\n"
                          "ACTIVATE/JOINT, ID=1\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(0).at("states").size(), 3u);
  EXPECT_EQ(r.result(2).at("states").size(), 12u);
  EXPECT_EQ(r.result(5).at("states").size(), 3u);
}

// Friction by the size of a load that is zero, where it may go to all sides.
TEST_F(FrictionCases, without_a_load_slip_has_no_derivative_and_the_joint_is_named) {
  const auto spin = [&](const std::string& friction) {
    return run(
        "Spin\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, WZ=3\nMARKER/20\n"
        "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nMARKER/3, PART=1, FLOATING\n"
        "VFORCE/1, I=20, JFLOAT=3, RM=1, FX=5*DX(30,1)\\FY=0\\FZ=0\n"
        "JOINT/1, REVOLUTE, I=20, J=1\nFRICTION/4, JOINT=1, EFFECT=SLIDING" +
            friction + "\nEND\n",
        "LINEAR/EIGENSOL\n");
  };
  const RunResult r = spin("");
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err,
              HasSubstr("FRICTION/4: a force or moment that JOINT/1 bears across its surfaces is zero while they "
                        "slip, and friction by its size has no derivative there"));
  EXPECT_EQ(spin(", INPUTS=PRELOAD, FRICTION_TORQUE_PRELOAD=2").status, 0);
}

// A pendulum of l = 0.1 with its pin of radius R: (I + m l²)|α| = μ R √((m g + m l ω²)² + (m l α)²) has no solution
// once μ R m l > I + m l², here from R = 0.67 on.
TEST_F(FrictionCases, that_locks_itself_is_said_to_have_no_solution) {
  const auto pendulum = [&](double radius) {
    return run(fmt::format("Pin\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\n"
                           "PART/2, MASS=1, CM=20, IP=0.01,0.01,0.01, QG=0,-0.1,0, VX=1, WZ=10\nMARKER/20\n"
                           "MARKER/21, QP=0,0.1,0\nJOINT/1, REVOLUTE, I=21, J=1\n"
                           "FRICTION/1, JOINT=1, PIN_RADIUS={}\nEND\n",
                           radius),
               "LINEAR/EIGENSOL\n");
  };
  EXPECT_EQ(pendulum(0.3).status, 0);
  const RunResult r = pendulum(1);
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("FRICTION/1"), HasSubstr("there may be none that meet all equations")));
}

TEST_F(FrictionCases, a_coefficient_that_is_not_read_is_not_compared) {
  for (const std::string effect : {"EFFECT=SLIDING, MU_DYNAMIC=0.6", "EFFECT=STICTION, MU_STATIC=0.2"}) {
    const RunResult r = run(block("FRICTION/4, JOINT=1, " + effect + "\n"), "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(r.err.find("coefficient-order"), std::string::npos) << r.err;
  }
}

// How redundant joints share a load nothing says; what bears none, or all of it, is another matter.
TEST_F(FrictionCases, by_reactions_that_nothing_determines_is_warned_of) {
  const auto warnings = [&](const std::string& joints, const std::string& gravity, const std::string& velocity = "VZ") {
    const RunResult r =
        run("guides\nUNITS/SYSTEM=MKS\nACCGRAV/" + gravity +
                "\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,0,1\nMARKER/3, QP=2,0,0\n"
                "PART/2, MASS=2, CM=20, IP=1,2,3, " +
                velocity +
                "=0.4\nMARKER/20, QP=0.3,0.1,0\nMARKER/21\n"
                "MARKER/22, QP=0,0,1\nMARKER/23, QP=0,1,0\nPART/3, MASS=1, CM=30, IP=1,1,1, QG=0,1,0\nMARKER/30\n"
                "MARKER/31\nMARKER/32, QP=2,0,0\nPART/4, MASS=1, CM=40, IP=1,1,1, QG=2,0,0\n"
                "MARKER/40, QP=0,0.5,0\nMARKER/41\nMARKER/42, QP=0,1,0\n" +
                joints + "END\n",
            "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    std::string found;
    for (std::size_t at = 0;
         (at = r.err.find("follows from reactions that nothing determines: how ", at)) != r.err.npos;) {
      const auto name = r.err.rfind("warning: ", at) + 9, joined = r.err.find("how ", at) + 4;
      found += r.err.substr(name, at - name) + "by " + r.err.substr(joined, r.err.find(" share", at) - joined) + "; ";
      at = joined;
    }
    return found;
  };
  // Parts 3 and 4 stay where they are.
  const std::string rest = "JOINT/8, FIXED, I=31, J=3\nJOINT/9, FIXED, I=41, J=1\n";
  const std::string guides = rest + "JOINT/1, TRANSLATIONAL, I=21, J=1\nJOINT/2, TRANSLATIONAL, I=22, J=2\n";
  const std::string friction = "FRICTION/4, JOINT=1\n";
  EXPECT_EQ(warnings(guides + friction, "JGRAV=-9"), "FRICTION/4 by JOINT/1, JOINT/2; ");
  EXPECT_EQ(warnings(guides + "FRICTION/4, JOINT=2\n", "JGRAV=-9"), "FRICTION/4 by JOINT/1, JOINT/2; ");
  EXPECT_EQ(warnings(guides + "VARIABLE/3, FUNCTION=2*JOINT(1,0,3,0)\n", "JGRAV=-9"),
            "VARIABLE/3 by JOINT/1, JOINT/2; ");
  // At rest no friction acts however the load is shared, but its slope does.
  EXPECT_EQ(warnings(guides + friction, "JGRAV=-9", "VZ=0, VX"), "FRICTION/4 by JOINT/1, JOINT/2; ");
  // Along the guides nothing is borne, and friction by preload asks for nothing.
  EXPECT_EQ(warnings(guides + "FRICTION/4, JOINT=1, INPUTS=PRELOAD, FRICTION_FORCE_PRELOAD=3\n", "JGRAV=-9"), "");
  EXPECT_EQ(warnings(rest + "JOINT/1, TRANSLATIONAL, I=21, J=1\n" + friction, "JGRAV=-9"), "");
  // In a four-bar of hinges what is redundant lies across its plane, where nothing is borne but what comes from there.
  const std::string four_bar =
      "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=23, J=31\nJOINT/3, REVOLUTE, I=32, J=42\n"
      "JOINT/4, REVOLUTE, I=41, J=3\n" +
      friction;
  EXPECT_EQ(warnings(four_bar, "JGRAV=-9", "WZ"), "");
  EXPECT_EQ(warnings(four_bar, "JGRAV=-9, KGRAV=-2", "WZ"), "FRICTION/4 by JOINT/1, JOINT/2, JOINT/3, JOINT/4; ");
}

TEST_F(FrictionCases, of_a_model_that_is_too_large_to_look_at_its_reactions_that_is_said) {
  std::string many =
      "guides\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,0,1\nPART/2, MASS=2, CM=21, "
      "IP=1,2,3, VZ=1\nMARKER/21\nMARKER/22, QP=0,0,1\nJOINT/1, TRANSLATIONAL, I=21, J=1\nJOINT/2, "
      "TRANSLATIONAL, I=22, J=2\nFRICTION/4, JOINT=1\n";
  for (int k = 100; k < 4400; ++k)
    many += fmt::format("PART/{0}, MASS=1, CM={0}, IP=1,1,1\nMARKER/{0}\nJOINT/{0}, FIXED, I={0}, J=1\n", k);
  const RunResult r = run(many + "END\n", "SIMULATE/INITIAL\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("the model is too large to look whether functions and FRICTION read reactions of"));
}

// In equilibria bristles follow the surfaces: drawn anywhere the block stays where they hold it, and where it has come
// to rest in time as well. What goes without friction in statics finds the equilibrium of the other forces.
TEST_F(FrictionCases, bears_in_statics_what_its_bristles_hold) {
  const auto place = [](const RunResult& r, std::size_t result) {
    for (const auto& body : r.result(result).at("operating_point").at("bodies")) {
      if (body.at("element") == "PART/2") return body.at("position").at(0).get<double>();
    }
    return -1.0;
  };
  const std::string spring = "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=11, FUNCTION=6-200*DZ(2,11,11)\n";
  const std::string friction = "FRICTION/4, JOINT=1, STICTION_TRANSITION_VELOCITY=0.01, MAX_STICTION_DEFORMATION=1E-4";
  for (const std::string inactive : {"", ", INACTIVE=STATIC"}) {
    const RunResult drawn = run(block(friction + inactive + "\n", spring), "SIMULATE/STATICS\n");
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    if (inactive.empty()) {
      EXPECT_GT(place(drawn, 0), 0);
      EXPECT_LT(place(drawn, 0), 1e-4);
    } else {
      EXPECT_NEAR(place(drawn, 0), 0.03, 1e-12);
    }
    const RunResult stuck =
        run(block(friction + inactive + "\n", spring), "SIMULATE/DYNAMICS, END=2, STEPS=2\nSIMULATE/STATICS\n");
    ASSERT_EQ(stuck.status, 0) << stuck.err;
    EXPECT_LT(place(stuck, 0), 0.02);
    EXPECT_NEAR(place(stuck, 1), inactive.empty() ? place(stuck, 0) : 0.03, 1e-8);
  }
}

// What a command or assembly moves has not slipped.
TEST_F(FrictionCases, goes_on_from_where_it_is_when_markers_are_put_elsewhere) {
  const std::string pushed = "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=11, FUNCTION=6\n";
  const std::string friction = "FRICTION/4, JOINT=1, MAX_STICTION_DEFORMATION=1E-4\n";
  const auto places = [](const RunResult& r) {
    EXPECT_EQ(r.status, 0) << r.err;
    std::vector<double> x;
    for (const auto& result : r.json.at("results")) {
      if (!result.contains("operating_point")) continue;
      for (const auto& body : result.at("operating_point").at("bodies")) {
        if (body.at("element") == "PART/2") x.push_back(body.at("position").at(0).get<double>());
      }
    }
    return x;
  };
  const double creep = 4.257e-5;  // x (3 − x²)/2 = 0.6
  const auto edited = places(run(block(friction, pushed), "SIMULATE/STATICS\nMARKER/11, QP=1,0,0\nSIMULATE/STATICS\n"));
  ASSERT_EQ(edited.size(), 2u);
  EXPECT_NEAR(edited[0], creep, 5e-9);
  EXPECT_NEAR(edited[1], edited[0], 1e-12);
  // Drawn open by 0.2 across the slide, and as far along it.
  std::string open = block(friction, pushed);
  open.replace(open.find("IP=1,1,1"), 8, "IP=1,1,1, QG=0.2,0.2,0.2");
  const auto assembled = places(run(open, "SIMULATE/STATICS\n"));
  ASSERT_EQ(assembled.size(), 1u);
  EXPECT_NEAR(assembled[0], 0.2 + edited[0], 1e-12);
}

// What is borne, over what could be borne at most, is σ of the creep, and that is the way of the surface. More than
// can be borne finds no equilibrium.
TEST_F(FrictionCases, surfaces_give_way_in_statics_until_bristles_bear_the_load) {
  struct Joint {
    const char *type, *friction, *load;  // moves by `load` times what can be borne
    const char* way;                     // of the surface
  };
  // The joint bears 20 across its axis; coefficient 0.5.
  for (const Joint& j :
       {Joint{"TRANSLATIONAL", "", "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=11, FUNCTION=10*{}", "DZ(2,11,11)"},
        {"REVOLUTE", ", PIN_RADIUS=0.2", "SFORCE/1, ROTATIONAL, ACTIONONLY, I=2, J=11, FUNCTION=2*{}", "0.2*AZ(2,11)"},
        {"CYLINDRICAL", ", PIN_RADIUS=0.2", "SFORCE/1, ROTATIONAL, ACTIONONLY, I=2, J=11, FUNCTION=2*{}",
         "0.2*AZ(2,11)"},
        {"CYLINDRICAL", ", PIN_RADIUS=0.2", "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=11, FUNCTION=10*{}",
         "DZ(2,11,11)"},
        {"HOOKE", ", PIN_RADIUS=0.2, FRICTION_ARM=0.2", "SFORCE/1, ROTATIONAL, ACTIONONLY, I=22, J=12, FUNCTION=2*{}",
         "0.2*AZ(22,12)"},
        {"SPHERICAL", ", BALL_RADIUS=0.2", "SFORCE/1, ROTATIONAL, ACTIONONLY, I=2, J=11, FUNCTION=2*{}",
         "0.2*AZ(2,11)"}}) {
    const bool crossed = std::string(j.type) == "HOOKE";
    const auto rest = [&](double share) {
      // Of a HOOKE the x axis of I and the y axis of J are bars of the cross: x of marker 22 is z of marker 12.
      std::string text =
          "Block\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\nMARKER/11, REULER=90D,90D,0\n"
          "MARKER/12, REULER=90D,90D,0\nMARKER/13, REULER=0,0,0\n"
          "PART/2, MASS=2, CM=2, IP=1,1,1\nMARKER/2, REULER=90D,90D,0\nMARKER/22, REULER=90D,90D,0\nMARKER/23\n";
      text +=
          fmt::format("JOINT/1, {}, I={}, J={}\nFRICTION/4, JOINT=1, MU_STATIC=0.5, MAX_STICTION_DEFORMATION=1E-3{}\n",
                      j.type, crossed ? 23 : 2, crossed ? 13 : 11, j.friction);
      if (crossed) text += "JPRIM/1, PERPENDICULAR, I=22, J=13\n";
      return run(text + fmt::format(fmt::runtime(j.load), share) + "\nREQUEST/1, F2=" + j.way + "\nEND\n",
                 "SIMULATE/STATICS\nSIMULATE/STATICS\n");
    };
    for (const double share : {0.1, -0.7, 0.98}) {
      const RunResult r = rest(share);
      ASSERT_EQ(r.status, 0) << j.type << share << r.err;
      for (const std::size_t k : {0u, 1u}) {
        const double z = r.result(k).at("operating_point").at("requests").at(0).at("values").at(0).get<double>() / 1e-3;
        // Beyond 0.9 the creep is less than the way.
        const double x = std::abs(z) < 0.9 ? z : std::copysign(1 - 0.1 * std::exp((0.9 - std::abs(z)) / 0.1), z);
        EXPECT_NEAR(x * (3 - x * x) / 2, share, 1e-9) << j.type << ' ' << j.way << share;
      }
    }
    const RunResult over = rest(1.1);
    EXPECT_EQ(over.status, 2) << j.type;
    EXPECT_THAT(over.err, AllOf(HasSubstr("no equilibrium was found"), HasSubstr("FRICTION/4 bears "),
                                HasSubstr("as much as JOINT/1 can bear by friction")))
        << j.type;
  }
}

// On a slope: what holds nothing in statics is named with its joint, and by what it is so.
TEST_F(FrictionCases, that_is_left_out_of_statics_is_named_where_nothing_else_holds) {
  const std::string slope = "ACCGRAV/IGRAV=3, JGRAV=-9\n";
  for (const auto& [option, says] :
       {std::pair{"INACTIVE=STATIC", "FRICTION/4 of JOINT/1 is left out of statics by INACTIVE=STATIC"},
        std::pair{"EFFECT=SLIDING", "FRICTION/4 of JOINT/1 has no bristles, and holds nothing at rest"}}) {
    std::string model = block(fmt::format("FRICTION/4, JOINT=1, MU_STATIC=0.5, {}\n", option));
    model.replace(model.find("ACCGRAV/JGRAV=-10\n"), std::string("ACCGRAV/JGRAV=-10\n").size(), slope);
    const RunResult r = run(model, "SIMULATE/STATICS\n");
    EXPECT_EQ(r.status, 2) << option;
    EXPECT_THAT(r.err, AllOf(HasSubstr("nothing holds PART/2 against the force (6, 0, 0)"), HasSubstr(says)));
  }
}

// The search tries bristles that are bent farther than they go: what is said is the most that they bear.
TEST_F(FrictionCases, of_bristles_that_bear_by_how_far_they_bend_is_said_at_most) {
  for (const char* law : {"", ", FORMULATION=LUGRE"}) {
    const RunResult r = run(std::string("Block\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=5, JGRAV=-8.660254\nPART/1, GROUND\n"
                                        "MARKER/11, REULER=90D,90D,0\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n"
                                        "MARKER/2, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=2, J=11\n"
                                        "FRICTION/1, JOINT=1, MU_STATIC=0.5") +
                                law + "\nEND\n",
                            "SIMULATE/STATICS\n");
    EXPECT_EQ(r.status, 2) << law;
    EXPECT_THAT(r.err, HasSubstr("FRICTION/1 bears 8.66")) << law;
  }
}

// A slip of 1e-8 one way or the other is what the integrator leaves of none: the linear model is that of the
// equilibrium.
TEST_F(FrictionCases, that_has_come_to_rest_has_one_linear_model) {
  const auto block = [](const char* law, const char* force) {
    return std::string(
               "Block\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\n"
               "MARKER/11, REULER=90D,90D,0\nPART/2, MASS=2, CM=2, IP=1,1,1\nMARKER/2, REULER=90D,90D,0\n"
               "JOINT/1, TRANSLATIONAL, I=2, J=11\nSFORCE/1, TRANSLATION, I=2, J=11, ACTIONONLY, FUNCTION=") +
           force + "\nFRICTION/1, JOINT=1, MU_STATIC=0.5, MU_DYNAMIC=0.5" + law + "\nEND\n";
  };
  const char* lugre = ", FORMULATION=LUGRE, BRISTLE_STIFFNESS_COEFFICIENT=30, DAMPING_COEFFICIENT=0.5";
  struct Row {
    const char *law, *load, *grown;
  };
  for (const Row& row : {Row{lugre, "6", "STEP(TIME,0,0,1,6)"}, Row{"", "9.95", "STEP(TIME,0,0,1,9.95)"}}) {
    const RunResult still = run(block(row.law, row.load), "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
    const RunResult moved = run(block(row.law, row.grown),
                                "SIMULATE/DYNAMICS, END=60, STEPS=6\nLINEAR/EIGENSOL\nSIMULATE/DYNAMICS, END=100, "
                                "STEPS=4\nLINEAR/EIGENSOL\n");
    ASSERT_EQ(still.status, 0) << still.err;
    ASSERT_EQ(moved.status, 0) << moved.err;
    const auto expected = still.eigenvalues(1);
    double frequency = 0;
    for (const auto& e : expected) frequency = std::max(frequency, e.imag());
    EXPECT_GT(frequency, 1);
    for (const std::size_t k : {1u, 3u}) {
      const auto found = moved.eigenvalues(k);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t e = 0; e < found.size(); ++e)
        EXPECT_LE(std::abs(found[e] - expected[e]), 1e-3 * frequency) << row.load << " " << k;
    }
  }
}

// By forces and moments that symmetry keeps at zero: what forces that cancel leave of them is rounding, and neither it
// nor where the model stands matters.
class SymmetricFriction : public FrictionCases {
 protected:
  void expect_same_linear_model(const std::string& a, const std::string& b, const std::string& states = "") {
    const std::string command = "LINEAR/EIGENSOL" + states + "\n";
    const RunResult one = run(a, command), other = run(b, command);
    ASSERT_EQ(one.status, 0) << one.err << a;
    ASSERT_EQ(other.status, 0) << other.err << b;
    EXPECT_THAT(one.err, Not(HasSubstr("lost-digits")));
    const auto x = one.eigenvalues(0), y = other.eigenvalues(0);
    ASSERT_EQ(x.size(), y.size());
    double largest = 0;
    for (const auto& v : y) largest = std::max(largest, std::abs(v));
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_LT(std::abs(x[k] - y[k]), 1e-9 * largest) << a;
  }
};

TEST_F(SymmetricFriction, has_the_linear_model_of_what_stands_in_the_middle_wherever_it_stands) {
  for (const Placed& place : placements) {
    for (const auto& model : {slider, hinge}) {
      expect_same_linear_model(model(place, 0.3, ""), model(place, 0, ""));
      expect_same_linear_model(model(place, 0.3, ""), model(placements[0], 0, ""));
    }
    // In motion the choice of states is a part of the model.
    const std::string states = "PSTATE/1, VARIABLE=1,2\nVARIABLE/1, FUNCTION=AZ(31,4)\nVARIABLE/2, FUNCTION=DZ";
    for (const double beside : {0.0, 0.3}) {
      expect_same_linear_model(sleeve(place, beside, states + "(31,4,4)\n"),
                               sleeve(placements[0], 0, states + "(31,4,4)\n"), ", PSTATE=1");
      expect_same_linear_model(slider_on_arm(place, beside, states + "(51,34,34)\n"),
                               slider_on_arm(placements[0], 0, states + "(51,34,34)\n"), ", PSTATE=1");
    }
    expect_same_linear_model(ball(place, ""), ball(place, "INPUTS=PRELOAD"));
    expect_same_linear_model(cross(place, 0.3), cross(place, 0));
  }
}

TEST_F(SymmetricFriction, starts_rests_and_moves) {
  for (const Placed& place : placements) {
    for (const std::string& text :
         {slider(place, 0.3, ""), hinge(place, 0.3, ""), sleeve(place, 0.3, ""), ball(place, ""), cross(place, 0.3)}) {
      const RunResult r = run(text, "SIMULATE/INITIAL\nSIMULATE/DYNAMIC, END=0.02, STEPS=2\nSIMULATE/STATICS\n");
      EXPECT_EQ(r.status, 0) << r.err << text;
    }
  }
}

TEST_F(SymmetricFriction, that_a_motion_disturbs_has_no_derivative_and_is_named) {
  for (const Placed& place : placements) {
    const RunResult r = run(slider(place, 0.3, moment_along(0)), "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 2) << slider(place, 0.3, moment_along(0));
    EXPECT_THAT(r.err, HasSubstr("FRICTION/2: a force or moment that JOINT/2 bears across its surfaces is zero while "
                                 "they slip, and friction by its size has no derivative there"));
    EXPECT_EQ(run(slider(place, 0.3, moment_along(0)), "SIMULATE/INITIAL\n").status, 0);
  }
}

// Little is not nothing: it has the slope of its sign.
TEST_F(SymmetricFriction, of_a_small_moment_that_changes_has_the_slope_of_its_sign) {
  for (const Placed& place : {placements[0], placements[1]}) {
    const auto fastest = [&](double moment) {
      const RunResult r = run(slider(place, 0.3, moment_along(moment)), "LINEAR/EIGENSOL\n");
      EXPECT_EQ(r.status, 0) << r.err;
      return r.eigenvalues(0).back();
    };
    EXPECT_LT(std::abs(fastest(1e-9) - fastest(1e-5)), 1e-4);
    EXPECT_LT(std::abs(fastest(-1e-9) - fastest(-1e-5)), 1e-4);
    EXPECT_GT(std::abs(fastest(1e-9) - fastest(-1e-9)), 1e-3);
  }
}

}  // namespace
}  // namespace dynalin::cases::friction_test
