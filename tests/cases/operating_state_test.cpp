// The operating point as it is handed out: by the library, in JSON, in the results file, in the message file and on the
// terminal.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/run.h"
#include "cases/study_of.h"

namespace dynalin::cases::operating_state_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double pi = std::numbers::pi;

void expect_triple(const Triple& value, const Triple& expected, double tolerance = 1e-12) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(value[k], expected[k], tolerance) << k;
}
void expect_triple(const nlohmann::json& value, const Triple& expected, double tolerance = 1e-12) {
  expect_triple(value.get<Triple>(), expected, tolerance);
}

// A rod of length 2, mass 3 and inertia 1 about its centre on a hinge at (1, 2, 0), level and turning at 4 rad/time.
// The axes of the hinge's J marker are turned by 90 degrees about z. The weight 30 brings α = −30/(1 + 3) = −7.5.
const std::string pendulum =
    "Rod\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND\nACCGRAV/JGRAV=-10\nPART/1, GROUND\n"
    "MARKER/1, QP=1,2,0, REULER=90D,0,0\n! adams_view_name='.plant.rod'\nPART/2, MASS=3, CM=20, IP=1,1,1, QG=2,2,0, "
    "WZ=4\nMARKER/20\nMARKER/21, QP=-1,0,0, REULER=90D,0,0\n! adams_view_name='.plant.hinge'\n"
    "JOINT/5, REVOLUTE, I=21, J=1\nVARIABLE/7, FUNCTION=2*WZ(21)\nDIFF/8, IC=0.5, FUNCTION=3-DIF(8)\n"
    "PINPUT/1, VARIABLES=9\nVARIABLE/9, FUNCTION=0\nPOUTPUT/2, VARIABLES=7,9\n";

class OperatingStates : public Cases {};

TEST_F(OperatingStates, of_the_library_hold_motion_reactions_and_values) {
  const auto study = study_of(pendulum + "END\n");
  const OperatingState s = study.initial_conditions().state();
  EXPECT_EQ(s.time, 0);
  ASSERT_EQ(s.bodies.size(), 1u);
  const BodyState& rod = s.bodies[0];
  EXPECT_EQ(rod.element.text(), "PART/2");
  EXPECT_EQ(rod.view_name, ".plant.rod");
  expect_triple(rod.position, {2, 2, 0});
  expect_triple(rod.angles, {0, 0, 0});
  expect_triple(rod.velocity, {0, 4, 0});
  expect_triple(rod.angular_velocity, {0, 0, 4});
  expect_triple(rod.acceleration, {-16, -7.5, 0});
  expect_triple(rod.angular_acceleration, {0, 0, -7.5});
  expect_triple(rod.centre_acceleration, {-16, -7.5, 0});
  // What the hinge exerts on the rod: m a − weight.
  ASSERT_EQ(s.reactions.size(), 1u);
  const Load& hinge = s.reactions[0];
  EXPECT_EQ(hinge.element.text(), "JOINT/5");
  EXPECT_EQ(hinge.variant, "REVOLUTE");
  EXPECT_EQ(hinge.marker_I, 21);
  EXPECT_EQ(hinge.marker_J, 1);
  EXPECT_EQ(hinge.axes, 1);
  expect_triple(hinge.force, {-48, 7.5, 0});
  expect_triple(hinge.force_in_axes, {7.5, 48, 0});
  expect_triple(hinge.torque, {0, 0, 0});
  EXPECT_TRUE(s.forces.empty());
  ASSERT_EQ(s.constraints.size(), 5u);
  for (const ConstraintValue& row : s.constraints) {
    EXPECT_EQ(row.element.text(), "JOINT/5");
    EXPECT_FALSE(row.redundant);
  }
  ASSERT_EQ(s.variables.size(), 2u);
  EXPECT_EQ(s.variables[0].id, 7);
  EXPECT_NEAR(s.variables[0].value, 8, 1e-13);
  ASSERT_EQ(s.states.size(), 1u);
  EXPECT_EQ(s.states[0].element.text(), "DIFF/8");
  EXPECT_EQ(s.states[0].value, 0.5);
  EXPECT_NEAR(s.states[0].rate, 2.5, 1e-14);
  ASSERT_EQ(s.plant_outputs.size(), 1u);
  EXPECT_EQ(s.plant_outputs[0].values.size(), 2u);
  EXPECT_NEAR(s.plant_outputs[0].values[0], 8, 1e-13);
  EXPECT_EQ(s.plant_inputs.at(0).element.text(), "PINPUT/1");
  EXPECT_EQ(study.model().units().length, "METER");
}

TEST_F(OperatingStates, have_the_angles_of_reuler) {
  const auto angles = [](const std::string& reuler) {
    const auto study =
        study_of("Angles\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nPART/2, MASS=1, CM=20, IP=1,2,2, REULER=" + reuler +
                 "\nMARKER/20\nEND\n");
    return study.as_drawn().state().bodies.at(0).angles;
  };
  expect_triple(angles("20D,50D,-70D"), {20 * pi / 180, 50 * pi / 180, -70 * pi / 180});
  expect_triple(angles("-120D,130D,170D"), {-120 * pi / 180, 130 * pi / 180, 170 * pi / 180});
  // Where z is vertical the sum, or the difference, goes to psi.
  expect_triple(angles("20D,0,30D"), {50 * pi / 180, 0, 0});
  expect_triple(angles("20D,180D,30D"), {-10 * pi / 180, pi, 0});
}

TEST_F(OperatingStates, tell_what_turns) {
  const auto bodies = study_of(
                          "Two\nPART/1, GROUND\nPART/2, MASS=1, CM=20, IP=1,2,2\nMARKER/20\nPOINT_MASS/3, MASS=1, "
                          "CM=30\nMARKER/30\nEND\n")
                          .as_drawn()
                          .state()
                          .bodies;
  EXPECT_TRUE(bodies.at(0).turns);
  EXPECT_FALSE(bodies.at(1).turns);
}

// In the axes that each statement documents: J of a BUSHING, RM of a GFORCE.
TEST_F(OperatingStates, hold_applied_forces_in_the_axes_of_their_markers) {
  const auto study = study_of(
      "Forces\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, REULER=90D,0,0\nMARKER/2, FLOATING, PART=1\nMARKER/3, "
      "PART=1, REULER=0,90D,0\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=0.5,0,0\nMARKER/20\n"
      "BUSHING/4, I=20, J=1, K=2,3,5, KT=1,1,1\nGFORCE/6, I=20, JFLOAT=2, RM=3, FX=1\\ FY=2\\ FZ=3\\ TX=0\\ TY=0\\ "
      "TZ=4\n"
      "END\n");
  const OperatingState s = study.initial_conditions().state();
  ASSERT_EQ(s.forces.size(), 2u);
  EXPECT_EQ(s.forces[0].element.text(), "BUSHING/4");
  EXPECT_EQ(s.forces[0].axes, 1);
  expect_triple(s.forces[0].force_in_axes, {0, 1.5, 0});  // x of the ground is −y of J
  expect_triple(s.forces[0].force, {-1.5, 0, 0});
  EXPECT_EQ(s.forces[1].element.text(), "GFORCE/6");
  EXPECT_EQ(s.forces[1].axes, 3);
  expect_triple(s.forces[1].force_in_axes, {1, 2, 3});
  expect_triple(s.forces[1].torque_in_axes, {0, 0, 4});
  expect_triple(s.forces[1].force, {1, -3, 2});
}

// Two wheels on the ground, coupled by q1 + 3 q2 = 0; torque 5 on the first and −6 on the second, inertias 2 and 4.
// λ follows from 2 q1″ = 5 + λ, 4 q2″ = −6 + 3 λ: 0 = 5/2 − 18/4 + λ (1/2 + 9/4), λ = 8/11.
const std::string wheels =
    "Wheels\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=3,0,0\nPART/2, MASS=1, CM=20, IP=1,1,2\n"
    "MARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,4, QG=3,0,0\nMARKER/30\nJOINT/1, REVOLUTE, I=20, J=1\n"
    "JOINT/2, REVOLUTE, I=30, J=2\nSFORCE/1, ROTATIONAL, I=20, J=1, FUNCTION=5\n"
    "SFORCE/2, ROTATIONAL, I=30, J=2, FUNCTION=-6\n";

TEST_F(OperatingStates, hold_what_a_coupler_does_to_each_of_its_joints) {
  const OperatingState s = study_of(wheels + "COUPLER/7, JOINTS=1,2, SCALES=1,3\nEND\n").initial_conditions().state();
  ASSERT_EQ(s.reactions.size(), 4u);
  for (std::size_t k = 0; k < 2; ++k) {
    const Load& l = s.reactions[2 + k];
    EXPECT_EQ(l.element.text(), "COUPLER/7");
    EXPECT_EQ(l.marker_I, k == 0 ? 20 : 30);
    EXPECT_EQ(l.marker_J, k == 0 ? 1 : 2);
    expect_triple(l.force, {0, 0, 0});
    expect_triple(l.torque, {0, 0, (k == 0 ? 1 : 3) * 8.0 / 11});
  }
  expect_triple(s.bodies.at(0).angular_acceleration, {0, 0, (5 + 8.0 / 11) / 2});
  expect_triple(s.bodies.at(1).angular_acceleration, {0, 0, (-6 + 24.0 / 11) / 4});
}

// The pitch point lies 1 from the first axis and −2 from the second: q1 = −2 q2, that is q1 + 2 q2 = 0 about z, and
// 0 = 5/2 − 12/4 + λ (1/2 + 4/4).
TEST_F(OperatingStates, hold_what_a_gear_does_to_each_of_its_joints) {
  const OperatingState s =
      study_of(wheels + "MARKER/3, PART=1, QP=1,0,0, REULER=0,-90D,0\nGEAR/7, JOINTS=1,2, CV=3\nEND\n")
          .initial_conditions()
          .state();
  ASSERT_EQ(s.reactions.size(), 4u);
  EXPECT_EQ(s.reactions[2].element.text(), "GEAR/7");
  expect_triple(s.reactions[2].torque, {0, 0, 1.0 / 3});
  expect_triple(s.reactions[3].torque, {0, 0, 2.0 / 3});
  expect_triple(s.bodies.at(0).angular_acceleration, {0, 0, (5 + 1.0 / 3) / 2});
}

// A point mass apart, an arm of length 2 held level by a force at its end: I says where it is reported.
TEST_F(OperatingStates, hold_what_a_gcon_does_to_the_body_of_its_marker) {
  const auto load = [](const std::string& function) {
    const OperatingState s =
        study_of(
            "Arm\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1, QP=3,-7,4\n"
            "PART/2, MASS=3, CM=20, IP=1,1,1, QG=3,-7,4\n"
            "MARKER/20, QP=1,0,0\nMARKER/21, QP=2,0,0, REULER=30D,0,0\nMARKER/22\nJOINT/1, REVOLUTE, I=22, J=1\n"
            "GCON/4, I=21, FUNCTION=" +
            function + "\nGCON/5, FUNCTION=DZ(20,1)\nEND\n")
            .initial_conditions()
            .state();
    EXPECT_EQ(s.reactions.size(), 2u) << "without I there is nothing to report it at";
    const Load l = s.reactions.at(1);
    EXPECT_EQ(l.element.text(), "GCON/4");
    EXPECT_EQ(l.marker_I, 21);
    EXPECT_EQ(l.axes, 0);
    return l;
  };
  // Half the weight at the end, or all of it as a torque.
  for (const char* at_end : {"DY(21,1)", "VY(21)"}) {
    expect_triple(load(at_end).force, {0, 15, 0});
    expect_triple(load(at_end).torque, {0, 0, 0});
  }
  for (const char* turning : {"AZ(21)-30D", "WZ(21)"}) {
    expect_triple(load(turning).force, {0, 0, 0});
    expect_triple(load(turning).torque, {0, 0, 30});
  }
}

// Of two hinges on one axis, rows of the second are left out and have no multiplier.
TEST_F(OperatingStates, mark_redundant_rows) {
  const auto study = study_of(
      "Door\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,0,1\nPART/2, MASS=1, CM=20, "
      "IP=1,1,1\nMARKER/20\n"
      "MARKER/21, QP=0,0,1\nJOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=21, J=2\nEND\n");
  std::size_t redundant = 0;
  for (const ConstraintValue& row : study.initial_conditions().state().constraints) {
    redundant += row.redundant;
    EXPECT_TRUE(!row.redundant || row.multiplier == 0);
  }
  EXPECT_EQ(redundant, 5u);
}

TEST_F(OperatingStates, of_statics_are_those_at_rest_and_come_with_stability) {
  const auto study = study_of(pendulum + "END\n");
  EXPECT_THROW(static_cast<void>(study.initial_conditions().static_result()), Error);
  const auto m = study.static_equilibrium();
  const StaticResult r = m.static_result();
  EXPECT_GT(r.iterations, 0);
  EXPECT_EQ(r.stability.verdict, Stability::Verdict::stable);
  expect_triple(r.at_rest.bodies.at(0).position, {1, 1, 0});
  expect_triple(r.at_rest.bodies.at(0).velocity, {0, 0, 0});
  expect_triple(r.at_rest.reactions.at(0).force, {0, 30, 0});
  // The point itself has the dataset's velocity again.
  EXPECT_NEAR(m.state().bodies.at(0).angular_velocity[2], 4, 1e-12);
}

TEST_F(OperatingStates, are_in_json_with_each_command) {
  const RunResult r = run(pendulum + "END\n",
                          "SIMULATE/INITIAL_CONDITIONS\nSIMULATE/STATICS\nLINEAR/EIGENSOL\nLINEAR/STATEMAT, FILE=a\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto& first = r.result(0).at("operating_point");
  EXPECT_EQ(first.at("time"), 0);
  const auto& rod = first.at("bodies").at(0);
  EXPECT_EQ(rod.at("element"), "PART/2");
  EXPECT_EQ(rod.at("name"), ".plant.rod");
  expect_triple(rod.at("acceleration"), {-16, -7.5, 0});
  expect_triple(rod.at("mass_centre").at("velocity"), {0, 4, 0});
  const auto& hinge = first.at("reactions").at(0);
  EXPECT_EQ(hinge.at("axes"), 1);
  expect_triple(hinge.at("force"), {7.5, 48, 0});
  expect_triple(hinge.at("global_force"), {-48, 7.5, 0});
  EXPECT_NEAR(first.at("variables").at(0).at("value").get<double>(), 8, 1e-13);
  EXPECT_EQ(first.at("states").at(0).at("element"), "DIFF/8");
  EXPECT_EQ(first.at("plant_outputs").at(0).at("values").size(), 2u);

  const auto& statics = r.result(1);
  EXPECT_EQ(statics.at("stability").at("verdict"), "stable");
  EXPECT_EQ(statics.at("stability").at("growing_modes"), 0);
  EXPECT_LE(statics.at("imbalance").get<double>(), 1e-12);
  EXPECT_GT(statics.at("iterations").get<int>(), 0);
  expect_triple(statics.at("operating_point").at("bodies").at(0).at("velocity"), {0, 0, 0});
  expect_triple(statics.at("operating_point").at("reactions").at(0).at("global_force"), {0, 30, 0});
  // The dataset's velocity is back where LINEAR looks at the model.
  for (const std::size_t k : {2u, 3u})
    expect_triple(r.result(k).at("operating_point").at("bodies").at(0).at("angular_velocity"), {0, 0, 4});
}

TEST_F(OperatingStates, of_an_unstable_equilibrium_count_what_grows) {
  std::string upright = pendulum;
  upright.replace(upright.find("JGRAV=-10"), 9, "IGRAV=-10");
  upright.replace(upright.find("WZ=4"), 4, "WZ=0");
  const RunResult r = run(upright + "END\n", "SIMULATE/STATICS\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(0).at("stability").at("verdict"), "unstable");
  EXPECT_EQ(r.result(0).at("stability").at("growing_modes"), 1);
  EXPECT_THAT(r.out, HasSubstr("unstable: 1 mode grows"));
}

TEST_F(OperatingStates, are_steps_of_the_results_file) {
  const std::string xrf = pendulum + "RESULTS/XRF, DECIMALPLACES=6\nEND\n";
  const RunResult r = run(xrf, "SIMULATE/INITIAL\nSIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string xml = r.text("model.res");
  EXPECT_THAT(
      xml, HasSubstr("<Units angle=\"rad\" length=\"meter\" mass=\"kg\" time=\"sec\" />\n<StepMap name=\"map_001\">\n"
                     "<Entity name=\"time\">\n<Component name=\"TIME\" unitsValue=\"sec\" id=\"1\" />\n</Entity>\n"
                     "<Entity name=\"rod_XFORM\" entity=\"rod\" entType=\"Part\" objectId=\"2\">\n"
                     "<Component name=\"X\" unitsValue=\"meter\" id=\"2\" />\n"));
  EXPECT_THAT(xml, HasSubstr("<Component name=\"ACCX\" unitsValue=\"meter/sec**2\" id=\"14\" />"));
  EXPECT_THAT(xml, HasSubstr("<Entity name=\"hinge\" entity=\"hinge\" entType=\"Joint\" objectId=\"5\">\n"
                             "<Component name=\"FX\" unitsValue=\"newton\" id=\"20\" />"));
  EXPECT_THAT(xml, HasSubstr("<Entity name=\"VARIABLE_7\" entity=\"VARIABLE_7\" entType=\"ADAMS_Variable\" "
                             "objectId=\"7\">\n<Component name=\"Q\" id=\"26\" />"));
  EXPECT_THAT(xml, HasSubstr("entType=\"Plant_Input\" objectId=\"1\">\n<Component name=\"IN1\" id=\"28\" />"));
  EXPECT_THAT(xml, HasSubstr("<Component name=\"OUT2\" id=\"30\" />"));
  // The k-th number of a step is the component with the id k.
  const auto step = [&](const std::string& name) {
    const auto at = xml.find(">\n", xml.find("<Step", xml.find("<Data name=\"" + name + "\""))) + 2;
    std::istringstream in(xml.substr(at, xml.find("</Step>", at) - at));
    std::vector<double> values;
    for (double v; in >> v;) values.push_back(v);
    return values;
  };
  const auto first = step("initialConditions_001"), rest = step("static_001"), again = step("initialConditions_002");
  ASSERT_EQ(first.size(), 32u);
  EXPECT_EQ(std::vector<double>(first.begin(), first.begin() + 4), (std::vector<double>{0, 2, 2, 0}));
  EXPECT_NEAR(first[13], -16, 1e-4);
  EXPECT_NEAR(first[19], -48, 1e-4);
  EXPECT_NEAR(first[25], 8, 1e-5);
  EXPECT_NEAR(first[30], 0.5, 1e-6);
  EXPECT_NEAR(first[31], 2.5, 1e-5);
  ASSERT_EQ(rest.size(), 32u);
  EXPECT_NEAR(rest[20], 30, 1e-4);
  EXPECT_NEAR(rest[7], 0, 1e-12);
  ASSERT_EQ(again.size(), 32u);
  EXPECT_NEAR(again[12], 4, 1e-5);
  EXPECT_THAT(xml, HasSubstr("<TerminationStatus runTermObject=\"\" runStatus=\"Successful\" />"));

  const RunResult parts =
      run(pendulum + "RESULTS/XRF, NOVELOCITIES, NOREACTIONFORCES, NOSYSTEMELEMENTS\nEND\n", "SIMULATE/INITIAL\n");
  const std::string less = parts.text("model.res");
  EXPECT_THAT(less, AllOf(HasSubstr("name=\"PSI\""), HasSubstr("name=\"ACCX\""), Not(HasSubstr("name=\"VX\"")),
                          Not(HasSubstr("entType=\"Joint\"")), Not(HasSubstr("ADAMS_Variable"))));
  EXPECT_THAT(
      run(pendulum + "RESULTS/XRF, NODISPLACEMENTS, NOACCELERATIONS\nEND\n", "SIMULATE/INITIAL\n").text("model.res"),
      AllOf(Not(HasSubstr("name=\"PSI\"")), Not(HasSubstr("name=\"ACCX\"")), HasSubstr("entType=\"Joint\"")));
}

TEST_F(OperatingStates, of_edited_models_stand_in_an_analysis_of_their_own) {
  const RunResult r = run(pendulum + "RESULTS/XRF, DECIMALPLACES=6\nEND\n",
                          "SIMULATE/INITIAL\nDEACTIVATE/JOINT, ID=5\nSIMULATE/INITIAL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.result(0).at("operating_point").at("reactions").size(), 1u);
  EXPECT_EQ(r.result(2).at("operating_point").at("reactions").size(), 0u);
  EXPECT_THAT(r.text("model.res"), HasSubstr("initialConditions_002"));
  const std::string xml = r.text("model.res"), second = xml.substr(xml.find("ANALYSIS_02"));
  EXPECT_THAT(xml.substr(0, xml.size() - second.size()), HasSubstr("entType=\"Joint\""));
  EXPECT_THAT(second, AllOf(HasSubstr("<StepMap name=\"map_002\">"), Not(HasSubstr("entType=\"Joint\"")),
                            HasSubstr("initialConditions_002\" id=\"2\"")));
}

TEST_F(OperatingStates, are_printed_on_request_and_short_for_statics) {
  write("model.adm", pendulum + "END\n");
  const auto printed = [&](bool state, bool quiet, std::vector<std::string> commands) {
    SessionOptions options;
    options.file = (folder_ / "model.adm").string();
    options.commands = std::move(commands);
    options.state = state, options.quiet = quiet;
    std::ostringstream out, err;
    EXPECT_EQ(run_session(options, out, err), 0) << err.str();
    return out.str();
  };
  const std::string full = printed(true, false, {"lin/eig"});
  for (const char* part :
       {"Operating point at time = 0.00000E+00", "positions of the BCS [meter], angles psi, theta, phi",
        "velocities of the BCS, global [meter/s, rad/s]", "accelerations of the BCS", "reactions on marker I",
        "JOINT/5 (.plant.hinge) on MARKER/21", "MARKER/1\n", "VARIABLE/7", "DIFF/8 state 1", "-48"})
    EXPECT_THAT(full, HasSubstr(part == std::string("-48") ? "48" : part)) << full;
  EXPECT_THAT(printed(false, false, {"lin/eig"}), Not(HasSubstr("positions")));
  const std::string statics = printed(false, false, {"sim/stat", "lin/eig"});
  EXPECT_THAT(statics, AllOf(HasSubstr("static equilibrium after"), HasSubstr("positions of the BCS"),
                             HasSubstr("reactions on marker I"), Not(HasSubstr("velocities"))));
  EXPECT_EQ(printed(true, true, {"sim/stat", "lin/eig"}), "");
  // One point is printed once: the second LINEAR looks at the same.
  const std::string twice = printed(true, false, {"lin/eig", "lin/eig"});
  EXPECT_EQ(twice.find("Operating point"), twice.rfind("Operating point"));
  EXPECT_THAT(read_file(folder_ / "model.msg"),
              AllOf(HasSubstr("  Operating point at time"), HasSubstr("reactions on")));
}

// Tables are for the eye; other files have the number as it is.
TEST_F(OperatingStates, show_no_component_below_the_rounding_of_its_vector) {
  const RunResult r =
      run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, "
          "QG=2,-3E-17,0\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,1, QG=0,-3E-17,0\nMARKER/30\nEND\n",
          "SIMULATE/INITIAL_CONDITIONS\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.message, HasSubstr("PART/2              2            0            0"));
  EXPECT_THAT(r.message, HasSubstr("PART/3              0       -3e-17            0"));
  EXPECT_THAT(r.json.dump(), HasSubstr("[2.0,-3e-17,0.0]"));
}

TEST_F(OperatingStates, on_the_terminal_stop_after_some_rows_where_there_are_many) {
  std::string chain = "Chain\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\n";
  for (int k = 2; k <= 10; ++k) {
    chain += "PART/" + std::to_string(k) + ", MASS=1, CM=" + std::to_string(10 * k) + ", IP=1,1,1, QG=0,-" +
             std::to_string(k) + ",0\nMARKER/" + std::to_string(10 * k) + "\nJOINT/" + std::to_string(k) +
             ", FIXED, I=" + std::to_string(10 * k) + ", J=1\n";
  }
  std::string fixed = chain;
  const RunResult r = run(fixed + "DIFF/1, IC=1, FUNCTION=-DIF(1)\nEND\n", "SIMULATE/STATICS\n");
  // Fixed joints between markers apart pull every part to one place.
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("... and 3 more"));
  EXPECT_THAT(r.out, Not(HasSubstr("PART/9 ")));
  EXPECT_THAT(r.message, HasSubstr("PART/9 "));
}

}  // namespace
}  // namespace dynalin::cases::operating_state_test
