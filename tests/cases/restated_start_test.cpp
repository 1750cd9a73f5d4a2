// What a command states about the start of one element, while the model moves, begins; all else goes on as it was.
#include <gmock/gmock.h>

#include "cases/curves.h"
#include "cases/fe_parts.h"
#include "cases/flexible.h"
#include "cases/run.h"

namespace dynalin::cases::restated_start_test {
namespace {

using ::testing::HasSubstr;

using Numbers = std::vector<double>;

class RestatedStart : public Cases {
 protected:
  // Where the dataset is after these commands.
  nlohmann::json after(const std::string& dataset, const std::string& commands) const {
    const RunResult r = run(dataset, commands + "SIMULATE/INITIAL_CONDITIONS\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.json.at("results").back().at("operating_point") : nlohmann::json();
  }
};

// Of a body: "position", "velocity", "angular_velocity".
Numbers of(const nlohmann::json& point, const std::string& element, const std::string& what) {
  for (const auto& body : point.at("bodies"))
    if (body.at("element") == element) return body.at(what);
  ADD_FAILURE() << "no " << element;
  return Numbers(3);
}
// Modal coordinates, or their rates.
Numbers shape(const nlohmann::json& point, const std::string& what) {
  Numbers all;
  for (const auto& c : point.at("curve_parameters")) all.push_back(c.at(what));
  return all;
}
void expect_near(const Numbers& found, const Numbers& wanted, double tolerance = 1e-6) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], wanted[k], tolerance) << k;
}

const std::string fall = "SIMULATE/DYNAMICS, END=1\n";
constexpr double g = 9.81;
// Two bodies thrown along x that turn, and a point mass.
const std::string thrown =
    "thrown\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/5, PART=1, REULER=90D,0,0\n"
    "PART/2, MASS=1, CM=20, IP=1,1,1, VX=1, WZ=2\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,1, VX=4, WZ=5\nMARKER/30\n"
    "POINT_MASS/4, MASS=1, CM=40, VX=6\nMARKER/40, POINT_MASS=4\nDIFF/1, IC=3, FUNCTION=1\nVARIABLE/1, "
    "FUNCTION=DIF(1)\n"
    "INTEGRATOR/ERROR=1E-8\nEND\n";

TEST_F(RestatedStart, a_component_of_velocity_begins_and_no_other_does) {
  const auto p = after(thrown, fall + "PART/2, VX=7\n");
  expect_near(of(p, "PART/2", "velocity"), {7, -g, 0});
  expect_near(of(p, "PART/2", "angular_velocity"), {0, 0, 2});
  expect_near(of(p, "PART/2", "position"), {1, -g / 2, 0});
  expect_near(of(p, "PART/3", "velocity"), {4, -g, 0});
  expect_near(of(p, "PART/3", "angular_velocity"), {0, 0, 5});
  expect_near(of(p, "POINT_MASS/4", "velocity"), {6, -g, 0});

  const auto mass = after(thrown, fall + "POINT_MASS/4, VY=2\n");
  expect_near(of(mass, "POINT_MASS/4", "velocity"), {6, 2, 0});
  expect_near(of(mass, "PART/2", "velocity"), {1, -g, 0});

  const auto turning = after(thrown, fall + "PART/3, WX=1\n");
  expect_near(of(turning, "PART/3", "velocity"), {4, -g, 0});
  // Along the axes of the CM, which has turned by 5 about z.
  expect_near(of(turning, "PART/3", "angular_velocity"), {std::cos(5), std::sin(5), 5}, 1e-5);
}

// The axes of a velocity belong to what is stated along them.
TEST_F(RestatedStart, other_axes_state_all_that_is_along_them) {
  const auto p = after(thrown, fall + "PART/2, VM=5\n");
  expect_near(of(p, "PART/2", "velocity"), {1, 1, 0});
  expect_near(of(after(thrown, fall + "PART/2, VM=5, VX=3, VY=2\n"), "PART/2", "velocity"), {-2, 3, 0});
  expect_near(of(p, "PART/2", "angular_velocity"), {0, 0, 2});
  expect_near(of(p, "PART/3", "velocity"), {4, -g, 0});
}

TEST_F(RestatedStart, a_body_that_is_placed_begins_there_and_no_other_does) {
  const auto p = after(thrown, fall + "PART/2, QG=0,0,9\n");
  expect_near(of(p, "PART/2", "position"), {0, 0, 9});
  expect_near(of(p, "PART/2", "velocity"), {1, 0, 0});
  expect_near(of(p, "PART/2", "angular_velocity"), {0, 0, 2});
  expect_near(of(p, "PART/3", "position"), {4, -g / 2, 0});
  expect_near(of(p, "PART/3", "velocity"), {4, -g, 0});
  expect_near(of(p, "POINT_MASS/4", "velocity"), {6, -g, 0});
}

// Nothing of EXACT, of a marker and of a state moves a body.
TEST_F(RestatedStart, what_states_no_motion_leaves_all_velocities) {
  for (const char* edit : {"PART/2, EXACT=X:Y", "MARKER/20, QP=0,0,0", "DIFF/1, IC=8", "PART/3, MASS=2"}) {
    const auto p = after(thrown, fall + edit + "\n");
    expect_near(of(p, "PART/2", "velocity"), {1, -g, 0});
    expect_near(of(p, "PART/3", "velocity"), {4, -g, 0});
    EXPECT_NEAR(p.at("variables").at(0).at("value").get<double>(), edit[0] == 'D' ? 8 : 4, 1e-6) << edit;
  }
}

// Several commands add up until an analysis has begun with them.
TEST_F(RestatedStart, what_was_stated_has_begun_once) {
  const auto both = after(thrown, fall + "PART/2, VX=7\nPART/3, MASS=2\nPART/3, VX=8\nPART/2, WZ=0\n");
  expect_near(of(both, "PART/2", "velocity"), {7, -g, 0});
  expect_near(of(both, "PART/2", "angular_velocity"), {0, 0, 0});
  expect_near(of(both, "PART/3", "velocity"), {8, -g, 0});
  const auto later = after(thrown, fall + "PART/2, VY=7\nSIMULATE/DYNAMICS, END=2\nPART/3, VX=8\n");
  expect_near(of(later, "PART/2", "velocity"), {1, 7 - g, 0});
}

// Two rods behind each other: where a constraint asks for it the others follow, as little as they can.
TEST_F(RestatedStart, neighbours_follow_as_constraints_ask) {
  const std::string chain =
      "chain\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0, WZ=1\nMARKER/20\n"
      "MARKER/21, QP=-1,0,0\nMARKER/22, QP=1,0,0\nPART/3, MASS=1, CM=30, IP=1,1,1, QG=2,0,0, WZ=3\nMARKER/30\n"
      "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=30, J=22\nEND\n";
  const auto p = after(chain, "SIMULATE/INITIAL_CONDITIONS\nPART/2, WZ=5\n");
  expect_near(of(p, "PART/2", "velocity"), {0, 5, 0}, 1e-12);
  expect_near(of(p, "PART/3", "velocity"), {0, 10, 0}, 1e-12);
  EXPECT_NEAR(of(p, "PART/3", "angular_velocity")[2], 3, 1e-12);
}

// Two equal points on a line whose distance changes by the mode, and one more body that falls.
class RestatedShape : public RestatedStart {
 protected:
  void SetUp() override {
    RestatedStart::SetUp();
    const std::vector<FlexibleNode> nodes = {{1, {0, 0, 0}, 1, {.1, .1, .1}, {{0, 0, 0}, {0, 0, 0}}, {{}, {}}},
                                             {2, {1, 0, 0}, 1, {.1, .1, .1}, {{1, 0, 0}, {0, 1, 0}}, {{}, {}}}};
    write("body.fem", modal_text(nodes, 50 * Eigen::MatrixXd::Identity(2, 2)));
  }
  std::string body(const std::string& more) const {
    return "body\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=body.fem, "
           "CRATIO=0, VZ=2\nMARKER/21, FLEX_BODY=2, NODE_ID=1\nMARKER/22, FLEX_BODY=2, NODE_ID=2\n"
           "PART/3, MASS=1, CM=30, IP=1,1,1, VX=4\nMARKER/30\nINTEGRATOR/ERROR=1E-8\n" +
           more + "END\n";
  }
};

TEST_F(RestatedShape, rates_of_modes_begin_and_the_body_falls_on) {
  const auto p = after(body(""), fall + "FLEX_BODY/2, VMODE=0.3,0.1\n");
  expect_near(shape(p, "rate"), {0.3, 0.1});
  expect_near(shape(p, "value"), {0, 0});
  expect_near(of(p, "FLEX_BODY/2", "velocity"), {0, -g, 2});
  expect_near(of(p, "FLEX_BODY/2", "position"), {0, -g / 2, 2});
  expect_near(of(p, "PART/3", "velocity"), {4, -g, 0});
}

TEST_F(RestatedShape, modal_coordinates_begin_and_the_body_falls_on) {
  const auto p = after(body(""), fall + "FLEX_BODY/2, VMODE=0.3,0.1\nSIMULATE/INITIAL\nFLEX_BODY/2, DMODE=0.02,0.01\n");
  expect_near(shape(p, "value"), {0.02, 0.01});
  expect_near(shape(p, "rate"), {0.3, 0.1});
  expect_near(of(p, "FLEX_BODY/2", "velocity"), {0, -g, 2});
  expect_near(of(p, "FLEX_BODY/2", "position"), {0, -g / 2, 2});
  expect_near(of(p, "PART/3", "velocity"), {4, -g, 0});
}

// The velocity of the BCS alone: the shape goes on.
TEST_F(RestatedShape, the_velocity_of_a_body_begins_and_its_shape_goes_on) {
  const auto p = after(body(""), "FLEX_BODY/2, DMODE=0.02,0, VMODE=0,0.1\nSIMULATE/INITIAL\nFLEX_BODY/2, VX=7\n");
  expect_near(of(p, "FLEX_BODY/2", "velocity"), {7, 0, 2});
  expect_near(shape(p, "value"), {0.02, 0});
  expect_near(shape(p, "rate"), {0, 0.1});
}

// Without its modes for a while: what has no shape has none to go on with.
TEST_F(RestatedShape, a_body_that_takes_its_modes_again_begins_with_the_shape_that_is_stated) {
  const std::string stated = "FLEX_BODY/2, DMODE=0.02,0.01, VMODE=0.3,0.1\n", next = "SIMULATE/DYNAMICS, END=2\n";
  for (const auto& [rigid, modal] : {std::pair{"REPRESENTATION=RIGID\n", "REPRESENTATION=MODAL\n"},
                                     {"INVARIANTS=T:T:F:F:F:F:T:F:F\n", "INVARIANTS=T:T:T:T:T:T:T:T:T\n"}}) {
    SCOPED_TRACE(rigid);
    const std::string to_rigid = std::string("FLEX_BODY/2, ") + rigid, to_modal = std::string("FLEX_BODY/2, ") + modal;
    const auto p = after(body(""), stated + fall + to_rigid + next + to_modal);
    expect_near(shape(p, "value"), {0.02, 0.01}, 1e-15);
    expect_near(shape(p, "rate"), {0.3, 0.1}, 1e-15);
    const auto moving = after(body(""), stated + fall + to_rigid + next);
    EXPECT_LT(of(moving, "FLEX_BODY/2", "velocity")[1], -9);
    expect_near(of(p, "FLEX_BODY/2", "velocity"), of(moving, "FLEX_BODY/2", "velocity"), 1e-12);
    expect_near(of(p, "FLEX_BODY/2", "position"), of(moving, "FLEX_BODY/2", "position"), 1e-12);
    // One that has its modes goes on with them.
    const auto swinging = after(body(""), stated + fall), same = after(body(""), stated + fall + to_modal);
    EXPECT_EQ(shape(same, "rate"), shape(swinging, "rate"));
    EXPECT_EQ(shape(same, "value"), shape(swinging, "value"));
  }
}

TEST_F(RestatedShape, what_a_file_says_of_the_start_begins_with_its_modes) {
  const std::string text = read_file(folder_ / "body.fem");
  const std::size_t places = text.find("**\n** RECORD GROUP 5");
  ASSERT_NE(places, std::string::npos);
  write("body.fem", text.substr(0, places) + "**\n** RECORD GROUP 3\n 0.02 0.01\n**\n** RECORD GROUP 4\n 0.3 0.1\n" +
                        text.substr(places));
  const std::string rigid = fall + "FLEX_BODY/2, REPRESENTATION=RIGID\n", modal = "FLEX_BODY/2, REPRESENTATION=MODAL\n";
  const auto p = after(body(""), rigid + "SIMULATE/INITIAL\n" + modal);
  expect_near(shape(p, "value"), {0.02, 0.01}, 1e-15);
  expect_near(shape(p, "rate"), {0.3, 0.1}, 1e-15);
  // Nothing has been without them here.
  EXPECT_EQ(shape(after(body(""), rigid + modal), "value"), shape(after(body(""), fall), "value"));
}

TEST_F(RestatedShape, what_is_held_of_the_shape_is_held_when_a_body_takes_its_modes_again) {
  const std::string held =
      body("MARKER/6, PART=1, QP=1,0,0, REULER=135D,90D,0\nJOINT/1, FIXED, I=21, J=1\nJPRIM/1, INPLANE, I=22, J=6\n");
  const auto p = after(held,
                       "FLEX_BODY/2, MODAL_EXACT_DISP=1, MODAL_EXACT_VEL=1, DMODE=0.02,0, VMODE=0.3,0\n"
                       "FLEX_BODY/2, REPRESENTATION=RIGID\nSIMULATE/INITIAL\nFLEX_BODY/2, REPRESENTATION=MODAL\n");
  expect_near(shape(p, "value"), {0.02, -0.02}, 1e-9);
  expect_near(shape(p, "rate"), {0.3, -0.3}, 1e-9);
}

// Swung to some side, it does not hang as drawn again.
TEST_F(RestatedShape, a_pendulum_goes_on_from_where_it_has_swung) {
  const std::string hinged = body("JOINT/1, SPHERICAL, I=21, J=1\nVARIABLE/1, FUNCTION=DX(22,1)\n");
  const std::string swing = "SIMULATE/DYNAMICS, END=0.2\n";
  const auto before = after(hinged, swing), p = after(hinged, swing + "FLEX_BODY/2, DMODE=0,0\n");
  EXPECT_GT(std::abs(before.at("bodies").at(0).at("angles").at(0).get<double>()), 0.1);
  expect_near(p.at("bodies").at(0).at("angles"), before.at("bodies").at(0).at("angles"), 1e-12);
  expect_near(of(p, "FLEX_BODY/2", "angular_velocity"), of(before, "FLEX_BODY/2", "angular_velocity"), 1e-12);
  expect_near(shape(p, "value"), {0, 0}, 1e-15);
  expect_near(shape(p, "rate"), shape(before, "rate"), 1e-12);
}

// In a plane that asks both modes to give way alike, one that is to keep what is stated does not, once it is stated.
TEST_F(RestatedShape, what_is_held_of_the_shape_is_held_when_it_is_stated_anew) {
  const std::string held =
      body("MARKER/6, PART=1, QP=1,0,0, REULER=135D,90D,0\nJOINT/1, FIXED, I=21, J=1\nJPRIM/1, INPLANE, I=22, J=6\n");
  const std::string begun = "SIMULATE/INITIAL\nFLEX_BODY/2, ", stated = "DMODE=0.02,0, VMODE=0.3,0\n";
  const auto free = after(held, begun + stated);
  expect_near(shape(free, "value"), {0.01, -0.01}, 1e-9);
  expect_near(shape(free, "rate"), {0.15, -0.15}, 1e-9);
  const auto both = after(held, begun + "MODAL_EXACT_DISP=1, MODAL_EXACT_VEL=1, " + stated);
  expect_near(shape(both, "value"), {0.02, -0.02}, 1e-9);
  expect_near(shape(both, "rate"), {0.3, -0.3}, 1e-9);
  const auto place = after(held, begun + "MODAL_EXACT_DISP=1, MODAL_EXACT_VEL=1, DMODE=0.02,0\n");
  expect_near(shape(place, "value"), {0.02, -0.02}, 1e-9);
  expect_near(shape(place, "rate"), {0, 0}, 1e-9);
}

// A beam moves as if it were rigid with what is stated, wherever it is by now.
TEST_F(RestatedStart, a_beam_begins_as_a_whole_and_no_other_does) {
  const StraightBeam beam{.elements = 2, .further = ", VY=3, WZ=1"}, other{.elements = 2, .further = ", VX=4", .id = 3};
  const auto p = after(beam_model(beam.text() + other.text()), "SIMULATE/DYNAMICS, END=0.5\nFE_PART/2, WZ=2\n");
  const Numbers first = of(p, "FE_PART/2 node 1", "position"), last = of(p, "FE_PART/2 node 3", "position");
  const Numbers v = of(p, "FE_PART/2 node 3", "velocity");
  EXPECT_GT(first[1], 1);
  expect_near(of(p, "FE_PART/2 node 1", "velocity"), {0, 3, 0}, 1e-9);
  expect_near(v, {-2 * (last[1] - first[1]), 3 + 2 * (last[0] - first[0]), 0}, 1e-9);
  expect_near(of(p, "FE_PART/2 node 2", "angular_velocity"), {0, 0, 2}, 1e-9);
  expect_near(of(p, "FE_PART/3 node 3", "velocity"), {4, 0, 0}, 1e-3);
}

// Bent, stretched and swinging by then: moved as if rigid, its slopes turn and its middles have no rate.
TEST_F(RestatedStart, a_beam_that_swings_begins_as_if_rigid) {
  const std::string push =
      "VFORCE/1, I=21, JFLOAT=2, RM=1, FX=-STEP(TIME,0,40,0.1,0)\\FY=STEP(TIME,0,40,0.1,0)\\FZ=9\n";
  for (const std::string type : {"3DBEAM", "2DBEAMXY"}) {
    SCOPED_TRACE(type);
    const std::string dataset = beam_model(StraightBeam{.elements = 2, .type = type}.text() + push);
    const std::string swing = "SIMULATE/DYNAMICS, END=0.2\n";
    const auto before = after(dataset, swing);
    for (const auto& [edit, spin] : {std::pair{"FE_PART/2, VX=0\n", 0.0}, {"FE_PART/2, WM=1, WZ=2\n", 2.0}}) {
      const auto p = after(dataset, swing + edit);
      const Numbers value = shape(p, "value"), rate = shape(p, "rate"), was = shape(before, "rate");
      ASSERT_EQ(rate.size(), type == "3DBEAM" ? 15u : 9u);
      EXPECT_EQ(value, shape(before, "value"));
      for (std::size_t k = 0; k < rate.size(); ++k) {
        const std::size_t axis = k % 3;
        const double turned = k >= 9 || axis == 2 ? 0 : axis == 0 ? -spin * value[k + 1] : spin * value[k - 1];
        EXPECT_NEAR(rate[k], turned, 1e-14) << k;
      }
      if (type == "3DBEAM") {
        EXPECT_GT(std::abs(was[11]), 0.1);
      }
      expect_near(of(p, "FE_PART/2 node 1", "velocity"), {0, 0, 0}, 1e-12);
      expect_near(of(p, "FE_PART/2 node 2", "angular_velocity"), {0, 0, spin}, 1e-12);
    }
  }
}

const std::string driven =
    "driven\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
    "JOINT/1, TRANSLATIONAL, I=20, J=1\nPART/3, MASS=1, CM=30, IP=1,1,1, VX=4\nMARKER/30\n";

TEST_F(RestatedStart, a_motion_begins_with_another_speed_where_it_is_and_elsewhere_with_the_speed_it_has) {
  const std::string dataset = driven + "MOTION/1, JOINT=1, ACCELERATION, FUNCTION=0, ICDISP=2, ICVEL=1\nEND\n";
  const auto speed = after(dataset, fall + "MOTION/1, ICVEL=5\n"),
             place = after(dataset, fall + "MOTION/1, ICDISP=9\n");
  expect_near(of(speed, "PART/2", "position"), {0, 0, 3});
  expect_near(of(speed, "PART/2", "velocity"), {0, 0, 5});
  expect_near(of(place, "PART/2", "position"), {0, 0, 9});
  expect_near(of(place, "PART/2", "velocity"), {0, 0, 1});
  expect_near(of(place, "PART/3", "velocity"), {4, 0, 0});
}

TEST_F(RestatedStart, a_joint_begins_where_its_conditions_are_stated) {
  const std::string dataset = driven + "END\n";
  const auto both = after(dataset, fall + "JOINT/1, IC=0.5,7\n"), place = after(dataset, fall + "JOINT/1, IC=0.5\n");
  expect_near(of(both, "PART/2", "position"), {0, 0, 0.5});
  expect_near(of(both, "PART/2", "velocity"), {0, 0, 7});
  expect_near(of(both, "PART/3", "velocity"), {4, 0, 0});
  expect_near(of(place, "PART/2", "position"), {0, 0, 0.5});
  expect_near(of(place, "PART/2", "velocity"), {0, 0, 0});
  // It is over with the analysis that begins there.
  const auto later = after(dataset, "JOINT/1, IC=0.5,7\n" + fall + "PART/3, VX=2\n");
  expect_near(of(later, "PART/2", "position"), {0, 0, 7.5});
}

TEST_F(RestatedStart, states_of_control_elements_begin_where_their_arrays_say) {
  const std::string filters =
      "filters\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nTFSISO/1, X=1, U=2, Y=3, NUMERATOR=1, DENOMINATOR=1,1\n"
      "ARRAY/1, X\nARRAY/2, U, VARIABLES=5\nARRAY/3, Y\nLSE/2, X=6, A=1\nARRAY/6, X\n"
      "MATRIX/1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=-1\nARRAY/9, IC, NUMBERS=0.7\nVARIABLE/5, FUNCTION=0\n"
      "VARIABLE/1, FUNCTION=ARYVAL(1,1)\nVARIABLE/2, FUNCTION=ARYVAL(6,1)\nEND\n";
  const auto values = [&](const std::string& commands) {
    Numbers list;
    const auto point = after(filters, "SIMULATE/INITIAL_CONDITIONS\n" + commands);
    for (const auto& v : point.at("variables"))
      if (v.at("element") != "VARIABLE/5") list.push_back(v.at("value"));
    return list;
  };
  expect_near(values(""), {0, 0});
  expect_near(values("TFSISO/1, IC=9\n"), {0.7, 0});
  expect_near(values("LSE/2, IC=9\n"), {0, 0.7});
}

// A bead that has slid along its curve is put elsewhere on it, or given another speed, and nothing else.
TEST_F(RestatedStart, a_point_of_contact_begins_where_and_as_fast_as_it_is_asked) {
  const std::string bead =
      "bead\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/9, FLOATING\n" + parabola(1, 1.7) +
      "POINT_MASS/2, MASS=3, CM=2\nMARKER/2\nPTCV/1, I=2, JFLOAT=9, CURVE=1, RM=1, DISP=0.5,0.425,0\n"
      "PART/3, MASS=1, CM=30, IP=1,1,1, QG=9,0,0, VX=2\nMARKER/30\nINTEGRATOR/ERROR=1E-8\nEND\n";
  const double x = 0.3, along = std::sqrt(1 + 4 * 1.7 * 1.7 * x * x);
  const auto moved = after(bead, "SIMULATE/DYNAMICS, END=0.1\nPTCV/1, DISP=0.3,0.153,0\nPTCV/1, VEL=2\n");
  expect_near(of(moved, "POINT_MASS/2", "position"), {x, 1.7 * x * x, 0});
  expect_near(of(moved, "POINT_MASS/2", "velocity"), {2 / along, 2 * 3.4 * x / along, 0});
  expect_near(of(moved, "PART/3", "position"), {9.2, -9.81 * 0.01 / 2, 0});
  const auto before = after(bead, "SIMULATE/DYNAMICS, END=0.1\n"),
             faster = after(bead, "SIMULATE/DYNAMICS, END=0.1\nPTCV/1, VEL=-3\n");
  expect_near(of(faster, "POINT_MASS/2", "position"), of(before, "POINT_MASS/2", "position"));
  const Numbers v = of(faster, "POINT_MASS/2", "velocity");
  EXPECT_NEAR(std::hypot(v[0], v[1]), 3, 1e-6);
  EXPECT_LT(v[0], 0);
}

TEST_F(RestatedStart, a_saved_point_knows_what_is_stated) {
  const std::string stated = "PART/2, VX=7\nPART/3, QG=0,0,9\n";
  const auto direct = after(thrown, fall + stated);
  for (const std::string what : {"SYSTEM", "STATES"}) {
    const auto r = run(thrown, fall + stated + "SAVE/" + what + ", FILE=stated.save\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const std::string edits = what == "SYSTEM" ? "" : stated;
    EXPECT_EQ(after(thrown, edits + "RELOAD/" + what + ", FILE=stated.save\n").at("bodies"), direct.at("bodies"))
        << what;
  }
  const auto content = nlohmann::json::parse(read_file(folder_ / "stated.save")).at("content");
  EXPECT_EQ(content.at("restated"), nlohmann::json::parse(R"([{"statement": "PART", "id": 3},
                                      {"statement": "PART", "id": 2, "arguments": ["VX"]}])"));
}

TEST_F(RestatedStart, changed_models_of_the_library_begin_so_too) {
  const auto before = study_of(thrown);
  const auto fallen = before.simulate(before.initial_conditions(), {.end = 1}).point;
  const auto model = before.model().edited("PART/2, VX=7").with("PART/3 WZ", 1);
  const library::Study study(model);
  const auto now = study.initial_conditions(study.continued(fallen));
  const auto triple = [](const Triple& t) { return Numbers{t[0], t[1], t[2]}; };
  expect_near(triple(now.part(2).velocity), {7, -g, 0});
  expect_near(triple(now.part(2).angular_velocity), {0, 0, 2});
  expect_near(triple(now.part(3).velocity), {4, -g, 0});
  expect_near(triple(now.part(3).angular_velocity), {0, 0, 1});
}

}  // namespace
}  // namespace dynalin::cases::restated_start_test
