// OPENBOX: the deck of masses, joints and force matrices has the eigenvalues of the model in static equilibrium,
// whatever is singled out and however joints are written.
#include "nastran/open_box.h"

#include "nastran/deck_roots_test_support.h"

namespace dynalin::nastran::open_box_test {
namespace {

using namespace nastran_test;

Deck box_of(const Linearization& of, const ExportOptions& options = {}) {
  Diagnostics remarks;
  return value_or_throw(open_box(of, options, remarks));
}

// Every way to write the same model.
std::vector<ExportOptions> ways() {
  std::vector<ExportOptions> all(5);
  all[1].all_forces_editable = false;
  all[2].use_rjoints = false;
  all[3].export_cbush = false;
  all[4].use_adams_ids = false;
  return all;
}

// Expects the roots in all ways, and says how many there are.
std::size_t expect_same(const std::string& model, double tolerance = 1e-8, Start start = Start::at_rest) {
  const Linearization of = linearization_of(model, start);
  const std::vector<Complex> expected = eigenvalues_of(of);
  for (const ExportOptions& options : ways()) {
    const Deck deck = box_of(of, options);
    SCOPED_TRACE(options.all_forces_editable
                     ? options.use_rjoints ? options.export_cbush ? "as it is" : "no CBUSH" : "no RJOINT"
                     : "in common");
    expect_roots(deck, expected, tolerance);
    const DenseDeck dense(deck);
    EXPECT_EQ(dense.rank, dense.rows) << "constraints of the deck depend on each other";
  }
  return expected.size();
}

const std::string gravity = "ACCGRAV/JGRAV=-9.81\n";
// A rod in the plane of x and y, its BCS away from the mass centre, hanging on a skew hinge.
const std::string pendulum = gravity +
                             "PART/2, MASS=2, CM=20, IP=0.1,0.2,0.3,0.01,0.02,-0.03, QG=0.1,0.2,0, REU=20D,0,0\n"
                             "MARKER/20, PART=2, QP=0.4,-0.3,0.1\nMARKER/21, PART=2, REU=0.1,0.2,0.3\n"
                             "MARKER/11, PART=1, QP=0.1,0.2,0, REU=0.4491,0.2,0.3\nJOINT/1, REVOLUTE, I=21, J=11\n";

TEST(OpenBox, of_a_pendulum) {
  EXPECT_EQ(expect_same(pendulum), 2u);
  const Deck deck = box_of(linearization_of(pendulum));
  ASSERT_EQ(deck.rigid_joints.size(), 1u);
  EXPECT_EQ(deck.rigid_joints[0].components, "12345");
  EXPECT_TRUE(deck.open);
  ASSERT_EQ(deck.masses.size(), 1u);
  EXPECT_EQ(deck.masses[0].mass, 2);
  ASSERT_EQ(deck.matrices.size(), 1u);
  EXPECT_EQ(deck.matrices[0].suffix, "VVV");
}

// Two bodies whose mass centres, BCS and markers all lie apart, hanging from bushings; 22 and 31 are at one place.
const std::string two_bodies =
    "ACCGRAV/IGRAV=-1, JGRAV=2, KGRAV=-9.81\n"
    "PART/2, MASS=2, CM=20, IP=0.4,0.5,0.6,0.05,0.02,-0.03, QG=0.1,0.2,0.3\n"
    "MARKER/20, PART=2, QP=0.2,0.1,-0.1\nMARKER/22, PART=2, QP=0.5,0,0, REU=0.3,0.5,0.2\nMARKER/21, PART=2, "
    "REU=1,0.4,2\n"
    "PART/3, MASS=1.5, CM=30, IP=0.3,0.2,0.4,0.01,-0.02,0.03, QG=0.9,0.1,0.4\n"
    "MARKER/30, PART=3, QP=0.1,-0.2,0.1\nMARKER/31, PART=3, QP=-0.3,0.1,-0.1, REU=0.3,0.5,0.2\n"
    "MARKER/32, PART=3, QP=0.4,0.2,0.1, REU=0.5,1.4,2\n"
    "MARKER/10, PART=1, QP=0.3,0.3,0.2, REU=0.2,0.3,-0.4\nMARKER/11, PART=1, QP=1,-0.1,0.5, REU=0.2,0.9,0.1\n"
    "BUSHING/1, I=20, J=10, K=800,900,1000, KT=30,40,50, C=5,6,7, CT=1,2,3, FORCE=3,-2,4, TORQUE=2,1,-1\n"
    "BUSHING/2, I=30, J=11, K=500,600,700, KT=20,25,15, C=3,2,1, CT=0.5,0.4,0.2\n";

TEST(OpenBox, of_two_bodies_on_bushings) {
  EXPECT_EQ(expect_same(two_bodies), 24u);
  const Deck deck = box_of(linearization_of(two_bodies));
  ASSERT_EQ(deck.bushes.size(), 2u);
  // The rest of an unloaded bushing is small beside it, and its damping all but in the bush.
  EXPECT_NEAR(deck.bushes[0].stiffness[0], 800, 1e-9);
  EXPECT_NEAR(deck.bushes[0].damping[5], 3, 1e-9);
}

struct Named {
  const char* name;
  const char* text;
};
void PrintTo(const Named& n, std::ostream* out) { *out << n.name; }

class OpenBoxConstraint : public ::testing::TestWithParam<Named> {};
TEST_P(OpenBoxConstraint, has_the_roots_of_the_model_in_every_way_of_writing) {
  EXPECT_LT(expect_same(two_bodies + GetParam().text), 24u);
}
INSTANTIATE_TEST_SUITE_P(
    joints, OpenBoxConstraint,
    ::testing::Values(
        Named{"fixed", "JOINT/1, FIXED, I=31, J=22\n"}, Named{"revolute", "JOINT/1, REVOLUTE, I=31, J=22\n"},
        Named{"spherical", "JOINT/1, SPHERICAL, I=31, J=22\n"},
        Named{"translational", "JOINT/1, TRANSLATIONAL, I=31, J=22\n"},
        Named{"cylindrical", "JOINT/1, CYLINDRICAL, I=31, J=22\n"}, Named{"planar", "JOINT/1, PLANAR, I=31, J=22\n"},
        Named{"hooke", "JOINT/1, HOOKE, I=33, J=22\nMARKER/33, PART=3, QP=-0.3,0.1,-0.1, REU=0.3,0.5,0.2\n"},
        Named{"universal", "JOINT/1, UNIVERSAL, I=33, J=22\nMARKER/33, PART=3, QP=-0.3,0.1,-0.1, REU=0.3,2.0708,0.2\n"},
        Named{"convel", "JOINT/1, CONVEL, I=33, J=22\nMARKER/33, PART=3, QP=-0.3,0.1,-0.1, REU=0.3,3.3,0.2\n"},
        Named{"screw", "JOINT/1, CYLINDRICAL, I=31, J=22\nJOINT/2, SCREW, I=31, J=22, PITCH=0.4\n"},
        Named{"inline", "JPRIM/1, INLINE, I=31, J=22\n"}, Named{"inplane", "JPRIM/1, INPLANE, I=31, J=22\n"},
        Named{"orientation", "JPRIM/1, ORIENTATION, I=31, J=22\n"},
        Named{"parallel", "JPRIM/1, PARALLEL_AXES, I=32, J=23\nMARKER/23, PART=2, REU=0.5,1.3,2\n"},
        Named{"perpendicular", "JPRIM/1, PERPENDICULAR, I=32, J=21\n"},
        Named{"to_ground", "JOINT/1, REVOLUTE, I=22, J=12\nMARKER/12, PART=1, QP=0.6,0.2,0.3, REU=0.3,0.5,0.2\n"},
        Named{"from_ground", "JOINT/1, REVOLUTE, I=12, J=22\nMARKER/12, PART=1, QP=0.6,0.2,0.3, REU=0.3,0.5,0.2\n"},
        Named{"motion", "JOINT/1, REVOLUTE, I=31, J=22\nMOTION/1, JOINT=1, FUNCTION=0.3\n"},
        Named{"motion_of_markers", "MOTION/1, I=31, J=10, X, FUNCTION=0.35\n"},
        Named{"condition", "GCON/1, FUNCTION=DX(31)*DY(20)-0.3*DZ(30,21)+0.2\n"},
        Named{"velocity_condition", "GCON/1, FUNCTION=VX(31,1,31)-0.3*WZ(20)\n"},
        Named{"coupler",
              "JOINT/1, CYLINDRICAL, I=31, J=22\nJOINT/2, CYLINDRICAL, I=21, J=12\nMARKER/12, PART=1, QP=0.1,0.2,0.3, "
              "REU=1,0.4,2\nCOUPLER/1, JOINTS=1,2, TYPE=T:R, SCALES=2,-0.7\n"},
        Named{"gear",
              "JOINT/1, REVOLUTE, I=31, J=22\nJOINT/2, REVOLUTE, I=24, J=12\nMARKER/24, PART=2, QP=0,0,0, "
              "REU=0.3,0.5,0.2\nMARKER/12, PART=1, QP=0.1,0.2,0.3, REU=0.3,0.5,0.2\n"
              "MARKER/25, PART=2, QP=0.2,0,0, REU=0.3,0.5,0.2\nGEAR/1, JOINTS=1,2, CV=25\n"},
        Named{"rackpin",
              "JOINT/1, PLANAR, I=31, J=22\nJPRIM/1, INLINE, I=31, J=26\nMARKER/26, PART=2, QP=0.5,0,0, "
              "REU=0.3,2.0708,0.2\nJOINT/2, RACKPIN, I=31, J=26, PD=0.3\n"}),
    [](const auto& test) { return std::string(test.param.name); });

class OpenBoxForce : public ::testing::TestWithParam<Named> {};
TEST_P(OpenBoxForce, has_the_roots_of_the_model_in_every_way_of_writing) {
  const std::string joint = "JOINT/1, SPHERICAL, I=31, J=22\n";
  EXPECT_GE(expect_same(two_bodies + joint + GetParam().text), 18u);
}
INSTANTIATE_TEST_SUITE_P(
    forces, OpenBoxForce,
    ::testing::Values(
        Named{"spring", "SPRINGDAMPER/1, TRANSLATIONAL, I=32, J=20, K=300, C=4, LENGTH=0.2, FORCE=5\n"},
        Named{"spring_to_ground",
              "SPRINGDAMPER/1, TRANSLATIONAL, I=12, J=32, K=300, C=4, LENGTH=0.2\nMARKER/12, PART=1\n"},
        Named{"torsion_spring", "SPRINGDAMPER/1, ROTATIONAL, I=31, J=22, KT=30, CT=0.4, TORQUE=3\n"},
        Named{"beam",
              "BEAM/1, I=32, J=20, LENGTH=0.9, AREA=4E-3, IXX=1E-3, IYY=4E-4, IZZ=1E-4, EMODULUS=1E5, GMODULUS=4E4, "
              "CRATIO=0.01\n"},
        Named{"field",
              "FIELD/1, I=32, J=21, KMATRIX=300,10,20,1,2,3, 10,200,30,4,5,6, 20,30,400,7,8,9, 1,4,7,20,1,2, "
              "2,5,8,1,30,3, 3,6,9,2,3,40, CRATIO=0.01, FORCE=3,4,5,1,1,2\n"},
        Named{"unsymmetric_field",
              "FIELD/1, I=32, J=21, KMATRIX=300,10,20,1,2,3, 10,200,30,4,5,6, 25,30,400,7,8,9, 1,4,7,20,1,2, "
              "2,5,3,1,30,3, 3,6,9,2,5,40, FORCE=3,4,5,1,1,2\n"},
        Named{"single_force", "SFORCE/1, TRANSLATIONAL, I=32, J=20, FUNCTION=-200*(DM(32,20)-0.4)-3*VR(32,20)\n"},
        Named{"action_only", "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=32, J=20, FUNCTION=4-30*DX(32)-VY(20)\n"},
        Named{"single_torque", "SFORCE/1, ROTATIONAL, I=31, J=22, FUNCTION=2-20*AZ(31,22)-WZ(31,22)\n"},
        Named{"vforce",
              "VFORCE/1, I=32, JFLOAT=13, RM=20, FX=-30*DX(32,20)+4\\FY=-40*DY(32,20)-VX(32)\\FZ=5*DX(20)\n"
              "MARKER/13, PART=2, FLOATING\n"},
        Named{"vtorque",
              "VTORQUE/1, I=32, JFLOAT=13, RM=20, TX=-3*AX(32,20)+4\\TY=-4*AY(32,20)-WX(32)\\TZ=5*DX(20)\n"
              "MARKER/13, PART=2, FLOATING\n"},
        Named{"gforce_to_ground",
              "GFORCE/1, I=32, JFLOAT=13, RM=31, FX=-30*DX(32,20)+4\\FY=-40*DY(32,20)-VX(32)\\FZ=5*DX(20)\\TX=DX(30)\\"
              "TY=-WZ(20)\\TZ=3\nMARKER/13, PART=1, FLOATING\n"},
        Named{"of_variables",
              "VARIABLE/1, FUNCTION=3*DX(32)-VY(20)\nVARIABLE/2, FUNCTION=VARVAL(1)**2+DZ(30,20)+TIME\n"
              "SFORCE/1, TRANSLATIONAL, I=32, J=20, FUNCTION=4*VARVAL(2)-10*VARVAL(1)-50*DM(32,20)\n"},
        Named{"of_a_loop_of_variables",
              "VARIABLE/1, IC=1, FUNCTION=3*DX(32)-0.4*VARVAL(2)\nVARIABLE/2, "
              "FUNCTION=0.3*SIN(VARVAL(1))+DZ(30,20)+VARVAL(4)\n"
              "VARIABLE/3, FUNCTION=VARVAL(2)-2*VARVAL(1)\nVARIABLE/4, FUNCTION=VX(32)\n"
              "SFORCE/1, TRANSLATIONAL, I=32, J=20, FUNCTION=4*VARVAL(3)-50*DM(32,20)\n"},
        Named{"of_accelerations",
              "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=32, J=20, FUNCTION=-0.2*ACCZ(32)+0.1*ACCX(20)\n"},
        Named{"of_reactions",
              "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=32, J=20, FUNCTION=0.2*FX(31,22,20)+0.1*FM(31,22)\n"},
        Named{"of_forces", "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=32, J=20, FUNCTION=0.2*BUSH(1,0,2,20)\n"},
        Named{"of_reactions_through_variables",
              "VARIABLE/1, FUNCTION=0.3*FZ(31,22,1)\nVARIABLE/2, FUNCTION=VARVAL(1)*DX(20)-DX(32)\n"
              "VFORCE/1, I=32, JFLOAT=13, RM=20, FX=VARVAL(2)\\FY=VARVAL(1)\\FZ=0.1*VARVAL(1)\nMARKER/13, PART=2, "
              "FLOATING\n"},
        Named{"nforce",
              "NFORCE/1, IMARKERS=32,20, J=10, KMATRIX=1, FORCE=3\n"
              "MATRIX/1, SPARSE, ROWS=12, COLUMNS=12, I=1,2,3,4,9,3,9,7,1, J=1,2,3,4,9,9,3,7,7, "
              "VALUES=100,200,300,20,300,-100,-100,150,-40\n"
              "MATRIX/3, FULL=CORDER, ROWS=12, COLUMNS=1, VALUES=1,2,3,1,0,2,2,1,1,0,1,1\n"},
        Named{"difference",
              "DIFF/1, FUNCTION=-3*DIF(1)+2*DX(32)-VY(20)\n"
              "SFORCE/1, TRANSLATIONAL, I=32, J=20, FUNCTION=4*DIF(1)-0.2*DIF1(1)-50*DM(32,20)\n"},
        Named{"implicit_differences",
              "DIFF/1, IMPLICIT, IC=0.1,0, FUNCTION=DIF1(1)+0.3*DIF1(2)+2*DIF(1)-DX(32)\n"
              "DIFF/2, IMPLICIT, IC=0.1,0, FUNCTION=DIF1(2)-0.2*DIF1(1)+3*DIF(2)-VY(20)\n"
              "DIFF/3, IMPLICIT, IC=0.1, FUNCTION=DIF(3)+0.1*DIF(3)**3-DIF(1)-DX(20)\n"
              "SFORCE/1, TRANSLATIONAL, I=32, J=20, FUNCTION=4*DIF(2)+DIF(3)-0.2*DIF1(1)-50*DM(32,20)\n"},
        Named{"state_space",
              "VARIABLE/1, FUNCTION=DX(32)\nVARIABLE/2, FUNCTION=VY(20)\nARRAY/1, U, VARIABLES=1,2\nARRAY/2, "
              "X\nARRAY/3, Y\n"
              "MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=-2,1,-3,-1\n"
              "MATRIX/2, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=1,0.5,0.2,1\n"
              "MATRIX/3, FULL=RORDER, ROWS=1, COLUMNS=2, VALUES=2,3\n"
              "MATRIX/4, FULL=RORDER, ROWS=1, COLUMNS=2, VALUES=-4,-0.5\n"
              "LSE/1, U=1, X=2, Y=3, A=1, B=2, C=3, D=4\n"
              "SFORCE/1, TRANSLATIONAL, I=32, J=20, FUNCTION=4*ARYVAL(3,1)-50*DM(32,20)\n"},
        Named{
            "transfer_function",
            "VARIABLE/1, FUNCTION=DX(32)+0.1*FX(31,22,1)\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\n"
            "TFSISO/1, U=1, X=2, Y=3, NUMERATOR=1,2,0.5, DENOMINATOR=1,0.5,0.2\n"
            "VFORCE/1, I=32, JFLOAT=13, RM=20, FX=ARYVAL(3,1)\\FY=2*ARYVAL(3,1)\\FZ=0\nMARKER/13, PART=2, FLOATING\n"}),
    [](const auto& test) { return std::string(test.param.name); });

class OpenBoxModel : public ::testing::TestWithParam<Named> {};
TEST_P(OpenBoxModel, has_its_roots_in_every_way_of_writing) { EXPECT_GT(expect_same(GetParam().text), 0u); }
INSTANTIATE_TEST_SUITE_P(
    models, OpenBoxModel,
    ::testing::Values(
        // Revolutes in one plane hold three components too many.
        Named{"four_bar",
              "ACCGRAV/JGRAV=-9.81\nMARKER/2, PART=1, QP=3,0,0\n"
              "PART/2, MASS=1, CM=20, IP=0.1,0.1,0.1, QG=0,0,0\nMARKER/20, PART=2, QP=0,0.5,0\nMARKER/21, PART=2\n"
              "MARKER/22, PART=2, QP=0,1,0\n"
              "PART/3, MASS=2, CM=30, IP=0.3,0.3,0.3, QG=0,1,0\nMARKER/30, PART=3, QP=1,0.5,0\nMARKER/31, PART=3\n"
              "MARKER/32, PART=3, QP=3,1,0\n"
              "PART/4, MASS=1, CM=40, IP=0.2,0.2,0.2, QG=3,0,0\nMARKER/40, PART=4, QP=0,1,0\nMARKER/41, PART=4\n"
              "MARKER/42, PART=4, QP=0,2,0\n"
              "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\nJOINT/3, REVOLUTE, I=42, J=32\n"
              "JOINT/4, REVOLUTE, I=41, J=2\nSPRINGDAMPER/1, ROTATIONAL, I=21, J=1, KT=60, CT=1\n"},
        Named{
            "driven_slider_crank",
            "ACCGRAV/JGRAV=-9.81\nMARKER/2, PART=1, REU=90D,90D,0\n"
            "PART/2, MASS=1, CM=20, IP=0.1,0.1,0.1, QG=0,0,0, REU=50D,0,0\nMARKER/20, PART=2, QP=0.3,0,0\n"
            "MARKER/21, PART=2\nMARKER/22, PART=2, QP=1,0,0\n"
            "PART/3, MASS=2, CM=30, IP=0.3,0.3,0.3, QG=0.6427876,0.7660444,0, REU=-14.7959D,0,0\n"
            "MARKER/30, PART=3, QP=1,0,0\nMARKER/31, PART=3\nMARKER/32, PART=3, QP=3,0,0\n"
            "PART/4, MASS=1, CM=40, IP=0.2,0.2,0.2, QG=3.543,0,0\nMARKER/40, PART=4\nMARKER/41, PART=4, REU=90D,90D,0\n"
            "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, SPHERICAL, I=31, J=22\nJOINT/3, REVOLUTE, I=32, J=40\n"
            "JOINT/4, TRANSLATIONAL, I=41, J=2\nMOTION/1, JOINT=1, FUNCTION=50D\n"
            "PART/5, MASS=3, CM=50, IP=1,1,1, QG=4.5,0,0\nMARKER/50, PART=5\n"
            "BUSHING/1, I=50, J=40, K=100,200,300, KT=10,20,30, C=1,1,1\n"},
        Named{"bead_on_a_curve",
              "ACCGRAV/JGRAV=-9.81\nMARKER/9, FLOATING\nMATRIX/1, FULL=RORDER, ROWS=5, COLUMNS=3, "
              "VALUES=-1,1.7,0, -0.5,0.425,0, 0,0,0, 0.5,0.425,0, 1,1.7,0\nCURVE/1, OPEN, MATRIX=1, CURVE_POINTS\n"
              "POINT_MASS/2, MASS=3, CM=2, QG=0.05,0.004,0\nMARKER/2\nPTCV/1, I=2, JFLOAT=9, CURVE=1, RM=1\n"},
        Named{"curve_on_a_body",
              "ACCGRAV/JGRAV=-9.81\nMATRIX/1, FULL=RORDER, ROWS=5, COLUMNS=3, "
              "VALUES=-1,1.7,0, -0.5,0.425,0, 0,0,0, 0.5,0.425,0, 1,1.7,0\nCURVE/1, OPEN, MATRIX=1, CURVE_POINTS\n"
              "PART/2, MASS=2, CM=20, IP=0.4,0.5,0.6\nMARKER/20, PART=2, QP=0.1,0.2,0.1\nMARKER/21, PART=2\nMARKER/9, "
              "PART=2, FLOATING\n"
              "BUSHING/1, I=20, J=1, K=800,900,1000, KT=300,400,500\n"
              "POINT_MASS/3, MASS=3, CM=30, QG=0.05,0.004,0\nMARKER/30\nPTCV/1, I=30, JFLOAT=9, CURVE=1, RM=21\n"
              "SPRINGDAMPER/1, TRANSLATIONAL, I=30, J=20, K=20, C=0.3, LENGTH=0.1\n"},
        Named{"rocking_curve",
              "ACCGRAV/JGRAV=-9.81\nMARKER/9, FLOATING\nMATRIX/1, FULL=RORDER, ROWS=5, COLUMNS=3, "
              "VALUES=-1,0.8,0, -0.5,0.2,0, 0,0,0, 0.5,0.2,0, 1,0.8,0\nMATRIX/2, FULL=RORDER, ROWS=4, COLUMNS=3, "
              "VALUES=-1,0,0, -0.4,0,0, 0.4,0,0, 1,0,0\nCURVE/1, OPEN, MATRIX=1, CURVE_POINTS\n"
              "CURVE/2, OPEN, MATRIX=2, CURVE_POINTS\nPART/2, MASS=2, CM=20, IP=1,1,0.4, QG=0.2,0,0\n"
              "MARKER/20, QP=0,0.3,0\nMARKER/21\nMARKER/29, FLOATING\nJOINT/1, PLANAR, I=20, J=1\n"
              "CVCV/1, IFLOAT=29, ICURVE=1, IRM=21, JFLOAT=9, JCURVE=2, JRM=1\n"
              "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=8, K=50, LENGTH=1\nMARKER/8, PART=1, QP=-1,0.1,0\n"},
        Named{
            "point_masses",
            "ACCGRAV/JGRAV=-9.81\nPOINT_MASS/2, MASS=3, CM=20, QG=0.3,-1,0.1\nMARKER/20\nPOINT_MASS/3, MASS=2, CM=30, "
            "QG=0.4,-2,0.2\nMARKER/30\nJPRIM/1, INPLANE, I=20, J=1\n"
            "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=200, C=1, LENGTH=1\n"
            "SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=300, C=2, LENGTH=1\n"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(OpenBox, holds_velocities_that_depend_on_displacements) {
  // At rest as it stands; the condition lets it move back by its own place.
  EXPECT_EQ(expect_same("POINT_MASS/2, MASS=2, CM=20\nMARKER/20\nMARKER/13, PART=1, FLOATING\n"
                        "VFORCE/1, I=20, JFLOAT=13, RM=1, FX=-10*DX(20)+3*DY(20)\\FY=-20*DY(20)\\FZ=-30*DZ(20)-VX(20)\n"
                        "GCON/1, FUNCTION=VX(20)+0.4*DX(20)-0.2*VY(20)+0.3*DY(20)\n",
                        1e-8, Start::as_stated),
            5u);
}

}  // namespace
}  // namespace dynalin::nastran::open_box_test
