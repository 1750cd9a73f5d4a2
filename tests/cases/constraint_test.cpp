// Every joint, primitive, motion and relation against the same constraint written as GCONs in marker measures, in a
// loaded and moving mechanism; and what has a closed form.
#include <numbers>

#include "cases/chain.h"

namespace dynalin::cases::constraint_test {
namespace {

const Matrix3 one = Matrix3::identity();
const Matrix3 turned = about({0, 0, 1}, 0.7), anyhow = rotation_313(0.5, 0.8, -0.3);
const Matrix3 crossed = rotation_313(0.3, std::numbers::pi / 2, 0.5);
const Vector none{}, along{0, 0, 0.2}, within{0.1, 0.2, 0}, off{0.1, -0.15, 0.2};
const std::string DX = "DX(31,22,22)", DY = "DY(31,22,22)", DZ = "DZ(31,22,22)", XY = "DY(311,31,22)",
                  YX = "DX(312,31,22)", ZX = "DX(313,31,22)", ZY = "DY(313,31,22)", ZZ = "DZ(313,31,22)";
std::string number(double x) { return fmt::format("{:.17g}", x); }
std::string angle_z() { return "AZ(31,22)"; }
std::string minus_drawn(const std::string& f, double value) { return f + "-(" + number(value) + ")"; }

std::vector<Held> all() {
  const double drawn_turn = 0.7;
  // R = Rx(B1) Ry(B2) Rz(B3)
  const double B1 = 0.4, B2 = -0.3, B3 = 0.6;
  const Matrix3 sequence = about({1, 0, 0}, B1) * about({0, 1, 0}, B2) * about({0, 0, 1}, B3);
  const auto drive = [&](const std::string& word, const std::string& f) {
    return "MOTION/1, I=31, J=22, " + word + ", FUNCTION=" + f;
  };
  const std::string wave = "+0.1*TIME+0.05*SIN(2*TIME)";
  std::vector<Held> list = {
      {"revolute", "JOINT/2, REVOLUTE, I=31, J=22", none, turned, {DX, DY, DZ, ZX, ZY}},
      {"translational", "JOINT/2, TRANSLATIONAL, I=31, J=22", along, one, {DX, DY, ZX, ZY, XY}},
      {"cylindrical", "JOINT/2, CYLINDRICAL, I=31, J=22", along, turned, {DX, DY, ZX, ZY}},
      {"spherical", "JOINT/2, SPHERICAL, I=31, J=22", none, anyhow, {DX, DY, DZ}},
      {"planar", "JOINT/2, PLANAR, I=31, J=22", within, turned, {DZ, ZX, ZY}},
      {"universal", "JOINT/2, UNIVERSAL, I=31, J=22", none, crossed, {DX, DY, DZ, ZZ}},
      {"hooke", "JOINT/2, HOOKE, I=31, J=22", none, about({0, 1, 0}, 0.4) * about({1, 0, 0}, 0.6), {DX, DY, DZ, XY}},
      {"convel",
       "JOINT/2, CONVEL, I=31, J=22",
       none,
       about({std::cos(0.3), std::sin(0.3), 0}, 0.5),
       {DX, DY, DZ, XY + "-" + YX}},
      {"fixed", "JOINT/2, FIXED, I=31, J=22", none, one, {DX, DY, DZ, ZX, ZY, XY}},
      {"screw",
       "JOINT/2, SCREW, I=31, J=22, PITCH=0.8",
       along,
       turned,
       {minus_drawn(DZ, 0.2) + "-0.8/(2*PI)*(" + minus_drawn(angle_z(), drawn_turn) + ")"}},
      {"rackpin",
       "JOINT/2, RACKPIN, I=31, J=22, PD=0.6",
       off,
       crossed,
       // z of J seen from I turns back by what the pinion turns forward.
       {minus_drawn(DZ, 0.2) + "+0.3*(ATAN2(DZ(312,31,22),DZ(311,31,22))-ATAN2(" + number(crossed(2, 1)) + "," +
        number(crossed(2, 0)) + "))"}},
      {"atpoint", "JPRIM/2, ATPOINT, I=31, J=22", none, anyhow, {DX, DY, DZ}},
      {"inline", "JPRIM/2, INLINE, I=31, J=22", along, anyhow, {DX, DY}},
      {"inplane", "JPRIM/2, INPLANE, I=31, J=22", within, anyhow, {DZ}},
      {"orientation", "JPRIM/2, ORIENTATION, I=31, J=22", off, one, {ZX, ZY, XY}},
      {"parallel_axes", "JPRIM/2, PARALLEL_AXES, I=31, J=22", off, turned, {ZX, ZY}},
      {"perpendicular", "JPRIM/2, PERPENDICULAR, I=31, J=22", off, crossed, {ZZ}},
      {"motion_x", drive("X", number(off.x) + wave), off, anyhow, {DX + "-(" + number(off.x) + wave + ")"}},
      {"motion_y", drive("Y", number(off.y) + wave), off, anyhow, {DY + "-(" + number(off.y) + wave + ")"}},
      {"motion_z", drive("Z", number(off.z) + wave), off, anyhow, {DZ + "-(" + number(off.z) + wave + ")"}},
      {"motion_b1",
       drive("B1", number(B1) + wave),
       off,
       sequence,
       {"ATAN2(-" + ZY + "," + ZZ + ")-(" + number(B1) + wave + ")"}},
      {"motion_b2", drive("B2", number(B2) + wave), off, sequence, {"ASIN(" + ZX + ")-(" + number(B2) + wave + ")"}},
      {"motion_b3",
       drive("B3", number(B3) + wave),
       off,
       sequence,
       {"ATAN2(-" + YX + ",DX(311,31,22))-(" + number(B3) + wave + ")"}},
      {"motion_velocity",
       "MOTION/1, I=31, J=22, Z, VELOCITY, FUNCTION=0.3+0.2*TIME",
       off,
       anyhow,
       {minus_drawn(DZ, off.z) + "-0.3*TIME-0.1*TIME**2"}},
      {"motion_acceleration",
       "MOTION/1, I=31, J=22, Z, ACCELERATION, ICVEL=0.3, FUNCTION=0.2+TIME",
       off,
       anyhow,
       {minus_drawn(DZ, off.z) + "-0.3*TIME-0.1*TIME**2"}},
      {"joint_motion",
       "JOINT/2, CYLINDRICAL, I=31, J=22\nMOTION/1, JOINT=2, ROTATION, FUNCTION=0.7" + wave,
       along,
       turned,
       {DX, DY, ZX, ZY, angle_z() + "-(0.7" + wave + ")"}},
      {"joint_motion_translation",
       "JOINT/2, CYLINDRICAL, I=31, J=22\nMOTION/1, JOINT=2, TRANSLATION, FUNCTION=0.2" + wave,
       along,
       turned,
       {DX, DY, ZX, ZY, DZ + "-(0.2" + wave + ")"}},
      {"coupled",
       "JOINT/2, CYLINDRICAL, I=31, J=22\nCOUPLER/1, JOINTS=2,2, TYPE=T:R, SCALES=-3.5",
       along,
       turned,
       {DX, DY, ZX, ZY, DZ + "-3.5*" + angle_z()}},
  };
  list.back().axes = about({0, 0, 1}, 0.2 / 3.5);
  return list;
}

class SameAsFunctions : public Cases, public ::testing::WithParamInterface<Held> {
 protected:
  // Not at rest: what prescribes velocities, and the pinion, which turns past the cut of ATAN2 on its way.
  static bool rests(const Held& h) {
    return h.name != "motion_velocity" && h.name != "motion_acceleration" && h.name != "rackpin";
  }
};

TEST_P(SameAsFunctions, at_rest_under_load_and_in_motion) {
  for (const char* commands : {"SIMULATE/INITIAL\nLINEAR/EIGENSOL\n", "SIMULATE/STATIC\nLINEAR/EIGENSOL\n"}) {
    if (std::string(commands).find("STATIC") != std::string::npos && !rests(GetParam())) continue;
    const RunResult element = run(mechanism(GetParam(), false), commands),
                    functions = run(mechanism(GetParam(), true), commands);
    ASSERT_EQ(element.status, 0) << element.err;
    ASSERT_EQ(functions.status, 0) << functions.err;
    EXPECT_EQ(element.labels(1), functions.labels(1));
    expect_same(element.eigenvalues(1), functions.eigenvalues(1));
  }
}
INSTANTIATE_TEST_SUITE_P(every, SameAsFunctions, ::testing::ValuesIn(all()),
                         [](const auto& p) { return p.param.name; });

// Joints and the primitives that make them up.
class SameAsPrimitives : public Cases, public ::testing::WithParamInterface<std::pair<const char*, std::string>> {};

TEST_P(SameAsPrimitives, in_every_eigenvalue) {
  const auto [name, primitives] = GetParam();
  const std::vector<Held> list = all();
  Held joint = *std::find_if(list.begin(), list.end(), [name = name](const Held& h) { return h.name == name; });
  const RunResult whole = run(mechanism(joint, false), "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
  joint.statement = primitives;
  const RunResult parts = run(mechanism(joint, false), "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(whole.status, 0) << whole.err;
  ASSERT_EQ(parts.status, 0) << parts.err;
  expect_same(whole.eigenvalues(1), parts.eigenvalues(1));
}
const std::string on = ", I=31, J=22\n";
INSTANTIATE_TEST_SUITE_P(
    joints, SameAsPrimitives,
    ::testing::Values(std::pair("revolute", "JPRIM/1, ATPOINT" + on + "JPRIM/2, PARALLEL_AXES" + on),
                      std::pair("translational", "JPRIM/1, INLINE" + on + "JPRIM/2, ORIENTATION" + on),
                      std::pair("cylindrical", "JPRIM/1, INLINE" + on + "JPRIM/2, PARALLEL_AXES" + on),
                      std::pair("planar", "JPRIM/1, INPLANE" + on + "JPRIM/2, PARALLEL_AXES" + on),
                      std::pair("universal", "JPRIM/1, ATPOINT" + on + "JPRIM/2, PERPENDICULAR" + on),
                      std::pair("fixed", "JPRIM/1, ATPOINT" + on + "JPRIM/2, ORIENTATION" + on)),
    [](const auto& p) { return std::string(p.param.first); });

// --- closed forms ------------------------------------------------------------------------------------------------

class ClosedForm : public Cases {
 protected:
  // The one frequency of a model with one freedom, rad per unit time.
  double frequency(const std::string& body) const {
    const RunResult r =
        run("Closed form\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n" + body + "END\n", "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    if (r.status != 0 || r.eigenvalues(0).size() != 2u) return -1;
    EXPECT_NEAR(r.eigenvalues(0)[0].real(), 0, 1e-12);
    return 2 * std::numbers::pi * std::abs(r.eigenvalues(0)[0].imag());
  }
};

TEST_F(ClosedForm, screw_adds_the_inertia_of_its_turning) {
  const double m = 2, J = 0.3, P = 0.5, k = 40, ratio = 2 * std::numbers::pi / P;
  const std::string text = fmt::format(
      "MARKER/2, QP=0,0,-1\nPART/2, MASS={}, CM=20, IP=1,1,{}\nMARKER/20\nJOINT/1, CYLINDRICAL, I=20, J=1\n"
      "JOINT/2, SCREW, I=20, J=1, PITCH={}\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=2, K={}, LENGTH=1\n",
      m, J, P, k);
  EXPECT_NEAR(frequency(text), std::sqrt(k / (m + J * ratio * ratio)), 1e-13);
}

TEST_F(ClosedForm, pinion_rolls_on_its_rack) {
  const double m = 2, J = 0.3, PD = 0.5, k = 40;
  // The pinion turns about z and rolls along x; the rack's marker has z along x. A MOTION of the sense documented tells
  // the sign.
  const std::string text = fmt::format(
      "MARKER/2, QP=-1,0,0\nMARKER/3, REULER=90D,90D,0\nPART/2, MASS={}, CM=20, IP=1,1,{}\nMARKER/20\n"
      "JOINT/1, PLANAR, I=20, J=1\nJPRIM/1, INLINE, I=20, J=3\nJOINT/2, RACKPIN, I=20, J=3, PD={}\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=2, K={}, LENGTH=1\n",
      m, J, PD, k);
  EXPECT_NEAR(frequency(text), std::sqrt(k / (m + J * 4 / (PD * PD))), 1e-13);
}

TEST_F(ClosedForm, coupled_wheels) {
  const double J1 = 0.7, J2 = 0.2, k = 9;
  // 1 q1 − 3 q2 = 0: the second wheel turns a third of the first.
  const std::string wheels = fmt::format(
      "PART/2, MASS=1, CM=20, IP=1,1,{}\nMARKER/20\nPART/3, MASS=1, CM=30, IP=1,1,{}, QG=0.4,0,0\nMARKER/30\nMARKER/3, "
      "PART=1, QP=0.4,0,0\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=3\nSPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT={}\n",
      J1, J2, k);
  EXPECT_NEAR(frequency(wheels + "COUPLER/1, JOINTS=1,2, SCALES=-3\n"), std::sqrt(k / (J1 + J2 / 9)), 1e-13);
  EXPECT_NEAR(frequency(wheels + "COUPLER/1, JOINTS=1,2, SCALES=2,-6\n"), std::sqrt(k / (J1 + J2 / 9)), 1e-13);
  // Gears of radii 0.3 and 0.1 that touch at x = 0.3: the small one turns three times as fast, backwards.
  const std::string gears = wheels + "MARKER/5, PART=1, QP=0.3,0,0, REULER=0,-90D,0\nGEAR/1, JOINTS=1,2, CV=5\n";
  EXPECT_NEAR(frequency(gears), std::sqrt(k / (J1 + J2 * 9)), 1e-13);
  // The carrier may hold the I marker.
  std::string swapped = gears;
  swapped.replace(swapped.find("I=30, J=3"), 9, "I=3, J=30");
  EXPECT_NEAR(frequency(swapped), std::sqrt(k / (J1 + J2 * 9)), 1e-13);
}

TEST_F(ClosedForm, constraints_have_the_sense_they_are_documented_with) {
  // Each mechanism is driven at one end; the velocity at the other is read through a VARIABLE as an output.
  const auto reading = [&](const std::string& body, const std::string& output) {
    const RunResult r = run("Sense\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n" + body +
                                "VARIABLE/9, FUNCTION=0\nPART/9, MASS=1, CM=90, IP=1,1,1\nMARKER/90\nMARKER/91, "
                                "PART=1\nJOINT/9, TRANSLATIONAL, I=90, J=91\n"
                                "VARIABLE/1, FUNCTION=(" +
                                output + ")*VZ(90)\nPOUTPUT/1, VARIABLES=1\nPINPUT/1, VARIABLES=9\nEND\n",
                            "LINEAR/STATEMAT, FILE=m, PINPUT=1, POUTPUT=1\n");
    EXPECT_EQ(r.status, 0) << r.err;
    if (r.status != 0) return 0.0;
    double largest = 0;
    const auto C = r.matrix(0, "C");
    for (const double c : C[0]) largest = std::abs(c) > std::abs(largest) ? c : largest;
    return largest;
  };
  EXPECT_NEAR(reading("PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, CYLINDRICAL, I=20, J=1\nJOINT/2, SCREW, "
                      "I=20, J=1, PITCH=0.5\n"
                      "MOTION/1, JOINT=1, ROTATION, FUNCTION=2*TIME\n",
                      "VZ(20,1)"),
              2 * 0.5 / (2 * std::numbers::pi), 1e-12);
  EXPECT_NEAR(reading("MARKER/3, REULER=90D,90D,0\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, PLANAR, I=20, "
                      "J=1\nJPRIM/1, INLINE, I=20, J=3\n"
                      "JOINT/2, RACKPIN, I=20, J=3, PD=0.5\nMOTION/1, I=20, J=1, B3, FUNCTION=2*TIME\n",
                      "VX(20,1)"),
              2 * 0.25, 1e-12);
}

TEST_F(ClosedForm, joints_start_where_and_as_fast_as_they_are_asked) {
  // The pendulum's eigenvalue at an angle and with a speed: θ″ = −(g/l) sin θ about θ = 0.5; coordinates read the rest.
  const auto run_with = [&](const std::string& joint, const std::string& output) {
    return run(
        "Starts\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, QP=0.3,0,0\n"
        "MARKER/21\nVARIABLE/1, FUNCTION=" +
            output +
            "*VZ(31)\nPART/3, MASS=1, CM=31, IP=1,1,1\nMARKER/31\n"
            "MARKER/32, PART=1\nJOINT/9, TRANSLATIONAL, I=31, J=32\nVARIABLE/2, FUNCTION=0\nPINPUT/1, "
            "VARIABLES=2\nPOUTPUT/1, VARIABLES=1\n" +
            joint + "\nEND\n",
        "LINEAR/STATEMAT, FILE=m, PINPUT=1, POUTPUT=1\n");
  };
  const auto reading = [&](const std::string& joint, const std::string& output) {
    const RunResult r = run_with(joint, output);
    EXPECT_EQ(r.status, 0) << r.err;
    double largest = 0;
    if (r.status == 0) {
      const auto C = r.matrix(0, "C");
      for (const double c : C[0]) largest = std::abs(c) > std::abs(largest) ? c : largest;
    }
    return largest;
  };
  EXPECT_NEAR(reading("JOINT/1, REVOLUTE, I=21, J=1, IC=30D,2", "AZ(21,1)"), std::numbers::pi / 6, 1e-13);
  EXPECT_NEAR(reading("JOINT/1, REVOLUTE, I=21, J=1, IC=30D,2", "WZ(21,1)"), 2, 1e-13);
  EXPECT_NEAR(reading("JOINT/1, TRANSLATIONAL, I=21, J=1, IC=0.7", "DZ(21,1)"), 0.7, 1e-13);
  EXPECT_NEAR(reading("JOINT/1, CYLINDRICAL, I=21, J=1, ICTRAN=0.7,3, ICROT=-1,5", "VZ(21,1)"), 3, 1e-13);
  EXPECT_NEAR(reading("JOINT/1, CYLINDRICAL, I=21, J=1, ICTRAN=0.7,3, ICROT=-1,5", "AZ(21,1)"), -1, 1e-13);
  const RunResult clash = run_with("JOINT/1, REVOLUTE, I=21, J=1, IC=30D\nMOTION/1, JOINT=1, FUNCTION=0.1", "AZ(21,1)");
  EXPECT_EQ(clash.status, 2);
  EXPECT_NE(clash.err.find("JOINT/1"), std::string::npos) << clash.err;
}

}  // namespace
}  // namespace dynalin::cases::constraint_test
