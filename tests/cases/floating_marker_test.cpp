// Floating markers on flexible bodies: what reacts there on a node, what on the body as if that were rigid, and curves
// that ride on nodes.
#include <gmock/gmock.h>

#include "cases/decks.h"
#include "cases/sliding_lumps.h"

namespace dynalin::cases::floating_marker_test {
namespace {

using namespace sliding_lumps;
using ::testing::HasSubstr;

class FloatingMarker : public Cases {};

// Floating markers on a node of lump A or on none, which is the core, take reactions of forces of the pendulum.
TEST_F(FloatingMarker, take_reactions_as_parts_do) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  const auto forces = [](const std::string& on_lump, const std::string& on_core) {
    return "MARKER/61, FLOATING, " + on_lump + "\nMARKER/62, FLOATING, " + on_core + "\nMARKER/63, FLOATING, " +
           on_lump +
           "\nVFORCE/11, I=52, JFLOAT=61, RM=31, FX=8+5*VARVAL(9)\\ , FY=-20*DX(52,41,31)\\ , FZ=-VZ(61,31,31,31)\n"
           "GFORCE/12, I=52, JFLOAT=62, RM=2, FX=-7+3*DY(62,2)\\ , FZ=0.3*VARVAL(9)-0.4*VX(51,41,41)\\ , "
           "TY=0.6*AX(52,31)\n"
           "VTORQUE/13, I=51, JFLOAT=63, RM=52, TX=2*SIN(AZ(51,41))\\ , TZ=0.4+VARVAL(9)\n"
           "VARIABLE/31, FUNCTION=GFORCE(12,1,7,31)+FX(61,52,2)+TZ(63,51)\nPOUTPUT/2, VARIABLES=22,23,24,25,31\n";
  };
  std::string flexible = lumps_with(false, forces("FLEX_BODY=2, NODE_ID=200", "FLEX_BODY=2")),
              rigid = lumps_with(true, forces("PART=3", "PART=2"));
  const std::string commands = "SIM/INITIAL\nLINEAR/STATEMAT, PSTATE=1, PINPUT=1, POUTPUT=2, FILE=x\nSTOP\n";
  expect_equal_models(run(flexible, commands), run(rigid, commands), 1e-9);
  const std::string drive = "MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=9*TIME\n";
  for (std::string* t : {&flexible, &rigid}) t->erase(t->find(drive), drive.size());
  expect_equal_models(run(flexible, commands), run(rigid, commands), 1e-9);
}

// A bead on a curve that rides on lump A, and a body whose curve slides along one of lump B.
TEST_F(FloatingMarker, carry_curves_as_parts_do) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  const auto contacts = [](const std::string& on_A, const std::string& on_B) {
    const auto turning = [](const Vector& at) {
      const Vector p = origin + axes * at;
      return fmt::format(", QG={}, REULER={}, VX={:.17g}, VY={:.17g}, VZ=0", text(p), angles(axes), -speed * p.y,
                         speed * p.x);
    };
    // Curves of four points are one cubic: y = x² + 0.2 x³ with z = 0.3 x² − 0.1 x; y = x²/2; y = −0.8 x² + 0.3 x³. The
    // bead is at x = 0.2 of the first, the start of the third at x = 0.3 of the second, along its tangent.
    const Matrix3 R31 = rotation_313(0.3, 0.8, -0.4), R41 = rotation_313(1, 0.4, 0.2);
    const Vector bead = Vector{0.7, 0.3, 0.1} + R31 * Vector{0.2, 0.0416, -0.008},
                 disk = Vector{0.2, -0.4, 0.3} + R41 * Vector{0.3, 0.045, 0};
    const Matrix3 rolled = R41 * rotation_313(std::atan(0.3), 0, 0);
    return "MATRIX/1, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=-0.9,0.6642,0.333, -0.3,0.0846,0.057, 0.3,0.0954,-0.003, "
           "0.9,0.9558,0.153\n"
           "MATRIX/2, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=-0.9,0.405,0, -0.3,0.045,0, 0.3,0.045,0, 0.9,0.405,0\n"
           "MATRIX/3, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=-0.9,-0.8667,0, -0.3,-0.0801,0, 0.3,-0.0639,0, "
           "0.9,-0.4293,0\n"
           "CURVE/1, OPEN, MATRIX=1, CURVE_POINTS\nCURVE/2, OPEN, MATRIX=2, CURVE_POINTS\nCURVE/3, OPEN, MATRIX=3, "
           "CURVE_POINTS\nMARKER/71, FLOATING, " +
           on_A + "\nMARKER/72, FLOATING, " + on_B + "\nPOINT_MASS/7, MASS=0.8, CM=70" + turning(bead) +
           "\nMARKER/70\nPTCV/1, I=70, JFLOAT=71, CURVE=1, RM=31, DISP=" + text(bead - Vector{0.3, 0.1, -0.2}) +
           ", ICM=32\nSPRINGDAMPER/7, TRANSLATIONAL, I=70, J=2, K=90, C=1, LENGTH=0.3\n"
           "PART/8, MASS=0.5, CM=80, IP=0.01,0.012,0.02" +
           turning(disk) +
           fmt::format(", WX=0, WY=0, WZ={:.17g}, VM=1, WM=1\nMARKER/80, REULER={}\n", speed, angles(rolled)) +
           "MARKER/82, REULER=1,0.4,0.2\nMARKER/81, FLOATING\nJPRIM/8, ORIENTATION, I=82, J=41\n"
           "SPRINGDAMPER/8, TRANSLATIONAL, I=80, J=23, K=200, C=2, LENGTH=0.5\n"
           "CVCV/1, IFLOAT=81, ICURVE=3, IRM=80, JFLOAT=72, JCURVE=2, JRM=41\n"
           "VARIABLE/31, FUNCTION=PTCV(1,1,3,31)+CVCV(1,0,2,41)+FY(72,81,2)\n"
           "VARIABLE/32, FUNCTION=DX(72,41,41)+WZ(71,31,31)\n"
           "VARIABLE/33, FUNCTION=DX(70,31,31)\nVARIABLE/34, FUNCTION=DX(80,41,41)\n"
           "POUTPUT/2, VARIABLES=22,23,24,25,31,32\nPSTATE/2, VARIABLES=11,12,13,14,15,16,33,34\n";
  };
  std::string flexible = lumps_with(false, contacts("FLEX_BODY=2", "FLEX_BODY=2, NODE_ID=300")),
              rigid = lumps_with(true, contacts("PART=3", "PART=4"));
  const std::string commands = "SIM/INITIAL\nLINEAR/STATEMAT, PSTATE=2, PINPUT=1, POUTPUT=2, FILE=x\nSTOP\n";
  expect_equal_models(run(flexible, commands), run(rigid, commands), 1e-8);
  const std::string drive = "MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=9*TIME\n";
  for (std::string* t : {&flexible, &rigid}) t->erase(t->find(drive), drive.size());
  expect_equal_models(run(flexible, commands), run(rigid, commands), 1e-8);
}

// A lump of 2 on a mode of stiffness 800 along x, held at its other node, and a part of 1.5 that a force of 300 by
// length of their distance pulls to it. The opposite moves the lump, or the body as a whole, which is held.
TEST_F(FloatingMarker, takes_the_reaction_to_its_node_or_to_no_mode) {
  const std::vector<FlexibleNode> nodes = {{1, {0, 0, 0}, 3, {1, 1, 1}, {Vector{}}, {Vector{}}},
                                           {2, {1, 0, 0}, 2, {}, {{1, 0, 0}}, {Vector{}}}};
  write("lump.fem", modal_text(nodes, Eigen::MatrixXd::Constant(1, 1, 800)));
  const auto squares = [&](const std::string& on) {
    const RunResult r =
        run("Lump\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=0,0.4,0.3, REULER=90D,90D,0\nMARKER/2\nFLEX_BODY/2, "
            "MNF_FILE=lump.fem, CRATIO=0\n"
            "MARKER/21, NODE_ID=1\nMARKER/22, NODE_ID=2\nJOINT/1, FIXED, I=21, J=2\n"
            "PART/3, MASS=1.5, CM=30, IP=1,1,1, QG=1,0.4,0.3\nMARKER/30\nMARKER/31, REULER=90D,90D,0\nJOINT/2, "
            "TRANSLATIONAL, I=31, J=1\n"
            "MARKER/23, FLEX_BODY=2, " +
                on + "FLOATING\nVFORCE/1, I=30, JFLOAT=23, RM=2, FX=-300*DX(30,22)\nEND\n",
            "LINEAR/EIGENSOL\nSTOP\n");
    EXPECT_EQ(r.status, 0) << r.err;
    std::vector<double> found;
    for (const auto& z : r.eigenvalues(0)) {
      EXPECT_NEAR(z.real(), 0, 1e-9);
      if (z.imag() > 0) found.push_back(std::pow(2 * M_PI * z.imag(), 2));
    }
    std::ranges::sort(found);
    return found;
  };
  const auto one = squares(""), node = squares("NODE_ID=2, ");
  ASSERT_EQ(one.size(), 2u);
  ASSERT_EQ(node.size(), 2u);
  EXPECT_NEAR(one[0], 200, 1e-7);
  EXPECT_NEAR(one[1], 400, 1e-7);
  // M = diag(2, 1.5), K = [1100, -300; -300, 300].
  const double sum = 1100 / 2.0 + 300 / 1.5, product = (1100 * 300 - 300 * 300) / (2 * 1.5);
  EXPECT_NEAR(node[0] + node[1], sum, 1e-7);
  EXPECT_NEAR(node[0] * node[1], product, 1e-4);
}

// Stiff modes change what is slow by the square of the ratio of frequencies, whatever takes the reaction.
TEST_F(FloatingMarker, of_stiff_modes_is_one_of_a_part) {
  const LumpedBeam stiff{7, 0.6, 4.2e12, 9e8, 1.3e9, 2.1e9, 1.9, 2.5e-3};
  const ReducedBody body = reduced(stiff, vibration(stiff, 0).shapes.middleCols(6, 5));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  double mass = 0, first = 0, xx = 0, yy = 0, zz = 0;
  for (const FlexibleNode& n : body.nodes) {
    mass += n.mass, first += n.mass * n.at.x;
    xx += n.own.x, yy += n.own.y + n.mass * n.at.x * n.at.x, zz += n.own.z + n.mass * n.at.x * n.at.x;
  }
  const double cm = first / mass;
  const std::string pose = ", QG=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1\n";
  const auto model = [&](const std::string& beam, const std::string& floating) {
    return "Beam\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/6, QP=0.3,-0.2,0.7, "
           "REULER=0.4,0.9,-1.1\n" +
           beam + "MARKER/24, " + floating +
           "FLOATING\nBUSHING/1, I=21, J=6, K=2E3,3E3,4E3, KT=200,300,150, C=3,4,5, CT=0.4,0.3,0.2\n"
           "PART/5, MASS=2, CM=50, IP=0.1,0.2,0.3, QG=0.6,0.1,0.4, REULER=20D,30D,40D\nMARKER/50, "
           "QP=0.05,0.1,0\nMARKER/51\n"
           "BUSHING/2, I=51, J=1, K=900,800,700, KT=50,60,40\n"
           "GFORCE/1, I=50, JFLOAT=24, RM=51, FX=-400*DX(50,33,51)-VX(50,33,51,51)\\ , FZ=7-300*DZ(50,33,51)\\ , "
           "TX=-30*AX(50,33)\\ , TY=0.4-WY(50,33,51)\nEND\n";
  };
  const auto roots = [&](const std::string& dataset) {
    const RunResult r = run(dataset, "SIMULATE/STATIC\nLINEAR/EIGENSOL\nSTOP\n");
    EXPECT_EQ(r.status, 0) << r.err;
    auto list = r.eigenvalues(1);
    std::ranges::sort(list, {}, [](const auto& z) { return std::pair(std::round(1e6 * std::abs(z)), z.imag()); });
    return list;
  };
  const auto rigid =
      roots(model(fmt::format("PART/2, MASS={:.17g}, CM=20, IP={:.17g},{:.17g},{:.17g}", mass, xx, yy - mass * cm * cm,
                              zz - mass * cm * cm) +
                      pose + fmt::format("MARKER/20, QP={:.17g},0,0\nMARKER/21\nMARKER/33, QP=0.5,0,0\n", cm),
                  "PART=2, "));
  ASSERT_EQ(rigid.size(), 24u);
  for (const std::string on : {"FLEX_BODY=2, ", "FLEX_BODY=2, NODE_ID=6, "}) {
    SCOPED_TRACE(on);
    const auto flexible = roots(
        model("FLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=0" + pose + "MARKER/21, NODE_ID=1\nMARKER/33, NODE_ID=6\n", on));
    ASSERT_EQ(flexible.size(), 34u);
    for (std::size_t k = 0; k < rigid.size(); ++k)
      EXPECT_NEAR(std::abs(flexible[k] - rigid[k]), 0, 1e-5 * std::abs(rigid[k])) << k;
  }
}

// A load on the body as a whole is a force and torque at its BCS: also what reacts on another flexible body.
TEST_F(FloatingMarker, takes_the_reaction_of_a_modal_load) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  const Vector force{3, -2, 1.5}, torque{0.4, 0.9, -0.6};
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(9, 1);
  loads.col(0).head(6) << force.x, force.y, force.z, torque.x, torque.y, torque.z;
  const std::string scale = "1.5*VARVAL(9)+0.3*DY(52,2)+SIN(DZ(51,1))";
  std::string gforce = "GFORCE/9, I=24, JFLOAT=7, RM=24";
  for (std::size_t c = 0; c < 3; ++c)
    gforce += fmt::format(", F{0}={1}*({2})\\ , T{0}={3}*({2}){4}", "XYZ"[c], force[c], scale, torque[c],
                          c < 2 ? "\\" : "\n");
  for (const std::string on : {"", "NODE_ID=300, "}) {
    SCOPED_TRACE(on);
    const std::string other =
        "FLEX_BODY/6, MNF_FILE=lumps.fem, CRATIO=0, QG=1.7,0.2,0.4, REULER=0.5,0.8,0.3, VX=0.2, WY=0.7, WX=-0.4\n"
        "MARKER/64, FLEX_BODY=6, NODE_ID=300\nMARKER/24, FLEX_BODY=2, NODE_ID=100\nMARKER/7, FLEX_BODY=6, " +
        on +
        "FLOATING\nBUSHING/6, I=64, J=2, K=400,500,300, KT=50,60,40\n"
        "VARIABLE/31, FUNCTION=DX(64,2,31)\nPOUTPUT/2, VARIABLES=22,24,31\n";
    const std::string commands = "SIM/INITIAL\nLINEAR/STATEMAT, PINPUT=1, POUTPUT=2, FILE=x\nSTOP\n";
    expect_equal_models(
        run(lumps_with(false, other + "MFORCE/2, FLEX_BODY=2, JFLOAT=7, CASE_INDEX=1, SCALE=" + scale + "\n", loads),
            commands),
        run(lumps_with(false, other + gforce, loads), commands), 1e-11);
  }
}

// Where a curve is, is a node: that of RM, and no other.
TEST_F(FloatingMarker, of_a_curve_is_on_the_node_of_that) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  const RunResult r = run(
      "Curve\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, FLOATING\nFLEX_BODY/2, MNF_FILE=lumps.fem\n"
      "MARKER/20, NODE_ID=200\nMARKER/21, FLOATING, NODE_ID=300\nMARKER/22, FLOATING\nMARKER/23, FLOATING, NODE_ID=77\n"
      "MATRIX/1, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=-1,1,0, 0,0,0, 1,1,0, 2,3,0\nCURVE/1, OPEN, MATRIX=1, "
      "CURVE_POINTS\n"
      "PTCV/1, I=1, JFLOAT=21, CURVE=1, RM=20\nJOINT/1, SPHERICAL, I=1, J=22\nVFORCE/1, I=20, JFLOAT=22, RM=1, "
      "FX=1\nEND\n",
      "STOP\n");
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err,
              HasSubstr("JFLOAT of PTCV/1, MARKER/21, is on another node of FLEX_BODY/2 than MARKER/20, which carries "
                        "the curve"));
  EXPECT_THAT(r.err, HasSubstr("JOINT/1 uses MARKER/22, which is floating"));
  EXPECT_THAT(r.err, HasSubstr("I and JFLOAT of VFORCE/1 are both on FLEX_BODY/2"));
  EXPECT_THAT(r.err, HasSubstr("FLEX_BODY/2 has no node 77"));
}

class FloatingMarkerDeck : public ProgramLibraryAndDecks {};

// At rest under its weight, with decks of all kinds.
TEST_F(FloatingMarkerDeck, has_the_roots_of_the_model) {
  write("lumps.fem", modal_text(nodes_of_lumps(), stiffness));
  const RunResult r =
      run("Lumps\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=0.6, JGRAV=-9.81, KGRAV=0.4\nPART/1, GROUND\nMARKER/1\n"
          "FLEX_BODY/2, MNF_FILE=lumps.fem, QG=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1\nMARKER/21, NODE_ID=100\nMARKER/22, "
          "NODE_ID=200\n"
          "MARKER/23, FLOATING\nMARKER/24, FLOATING, NODE_ID=300\n"
          "BUSHING/1, I=21, J=1, K=900,800,700, KT=500,600,400, C=3,4,5, CT=2,3,4\n"
          "PART/3, MASS=1.4, CM=30, IP=0.1,0.2,0.3, QG=0.5,0.2,0.1, REULER=0.3,1.2,-0.7\nMARKER/30, "
          "QP=0.1,0.2,0.3\nMARKER/31\n"
          "BUSHING/2, I=31, J=22, K=400,300,500, KT=60,70,80, C=1,2,1, CT=0.3,0.2,0.4\n"
          "VFORCE/1, I=30, JFLOAT=23, RM=31, FX=-50*DX(30,22)-VX(30,22)\\ , FY=-40*DY(30,21)\\ , FZ=2\n"
          "GFORCE/2, I=31, JFLOAT=24, RM=1, FZ=-30*DZ(31,22)\\ , TX=-8*AX(31,21)\\ , TY=0.4-WY(31,22)\nEND\n",
          "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_GE(r.eigenvalues(1).size(), 12u);
}

}  // namespace
}  // namespace dynalin::cases::floating_marker_test
