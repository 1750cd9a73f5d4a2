// A flexible body whose modes are stiff is a part to everything that stands on its nodes: each joint, primitive and
// force between two of them, at the static equilibrium under the weight of both.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "cases/flexible.h"
#include "cases/run.h"

namespace dynalin::cases::stiff_flex_body_test {
namespace {

struct Element {
  const char* name;
  const char* text;
};

// Body 2 is drawn on PART/3: markers 21, 23 and 25 along it stand at 31, 33 and 35 with the same axes, and x of 36 at
// 33 points along z there.
const Element elements[] = {
    {"REVOLUTE", "JOINT/1, REVOLUTE, I=21, J=31\n"},
    {"TRANSLATIONAL", "JOINT/1, TRANSLATIONAL, I=21, J=31\n"},
    {"CYLINDRICAL", "JOINT/1, CYLINDRICAL, I=23, J=33\n"},
    {"SPHERICAL", "JOINT/1, SPHERICAL, I=25, J=35\n"},
    {"FIXED", "JOINT/1, FIXED, I=21, J=31\n"},
    {"PLANAR", "JOINT/1, PLANAR, I=23, J=33\n"},
    {"SCREW", "JOINT/1, SCREW, I=21, J=31, PITCH=0.3\n"},
    {"UNIVERSAL", "JOINT/1, UNIVERSAL, I=23, J=36\n"},
    {"HOOKE", "JOINT/1, HOOKE, I=23, J=33\n"},
    {"CONVEL", "JOINT/1, CONVEL, I=25, J=35\n"},
    {"ATPOINT", "JPRIM/1, ATPOINT, I=25, J=35\n"},
    {"INLINE", "JPRIM/1, INLINE, I=21, J=31\n"},
    {"INPLANE", "JPRIM/1, INPLANE, I=25, J=35\n"},
    {"ORIENTATION", "JPRIM/1, ORIENTATION, I=23, J=33\n"},
    {"PARALLEL_AXES", "JPRIM/1, PARALLEL_AXES, I=21, J=31\n"},
    {"PERPENDICULAR", "JPRIM/1, PERPENDICULAR, I=23, J=36\n"},
    {"GCON", "GCON/1, FUNCTION=DX(25,31,31)-0.3*DY(21,35,31)\n"},
    {"MOTION of a joint", "JOINT/1, REVOLUTE, I=21, J=31\nMOTION/1, JOINT=1, ROTATION, FUNCTION=0.1\n"},
    {"MOTION of markers", "MOTION/1, I=25, J=35, X, FUNCTION=0.02\n"},
    {"COUPLER", "JOINT/1, REVOLUTE, I=21, J=31\nJOINT/2, REVOLUTE, I=40, J=42\nCOUPLER/1, JOINTS=1,2, SCALES=-2\n"},
    {"GEAR",
     "JOINT/1, REVOLUTE, I=21, J=31\nJOINT/2, REVOLUTE, I=41, J=37\nMARKER/38, PART=3, QP=0.1,0,0, "
     "REULER=10D,110D,30D\nGEAR/1, JOINTS=1,2, CV=38\n"},
    {"RACKPIN",
     "JOINT/1, TRANSLATIONAL, I=21, J=31\nJOINT/2, REVOLUTE, I=43, J=38\nMARKER/38, PART=3, QP=0.3,0.02,0.03, "
     "REULER=10D,110D,30D\nJOINT/3, RACKPIN, I=43, J=21, "
     "PD=0.2\n"},
    {"PTCV", "PTCV/1, I=37, JFLOAT=61, CURVE=1, RM=23\n"},
    {"CVCV", "CVCV/1, IFLOAT=62, ICURVE=2, IRM=33, JFLOAT=61, JCURVE=1, JRM=23\n"},
    {"FRICTION", "JOINT/1, SPHERICAL, I=25, J=35\nFRICTION/1, JOINT=1, EFFECT=SLIDING, BALL_RADIUS=0.02\n"},
    {"BUSHING", "BUSHING/1, I=25, J=31, K=1000,2000,3000, KT=1,2,3, C=1,1,1, CT=.1,.1,.1\n"},
    {"BEAM",
     "BEAM/1, I=25, J=30, LENGTH=0.3, AREA=1E-4, IXX=2E-9, IYY=1E-9, IZZ=1E-9, EMODULUS=1E9, GMODULUS=4E8, "
     "CRATIO=0.001\n"},
    {"FIELD",
     "FIELD/1, I=25, J=31, CRATIO=0.01, LENGTH=0.5,0,0,0,0,0, KMATRIX=1000,0,0,0,0,0, 0,2000,0,0,0,30, "
     "0,0,1500,0,20,0, 0,0,0,10,0,0, 0,0,20,0,20,0, 0,30,0,0,0,30\n"},
    {"SPRINGDAMPER", "SPRINGDAMPER/1, TRANS, I=25, J=31, K=1000, C=5, LENGTH=0.5\n"},
    {"SPRINGDAMPER of turning", "SPRINGDAMPER/1, ROT, I=25, J=35, KT=30, CT=0.5, ANGLE=5D\n"},
    {"SFORCE", "SFORCE/1, TRANSLATIONAL, I=25, J=31, FUNCTION=-300*(DM(25,31)-0.5)-4*VR(25,31)\n"},
    {"SFORCE alone", "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=25, J=31, FUNCTION=5+20*DX(25,1)\n"},
    {"SFORCE of turning", "SFORCE/1, ROTATIONAL, I=25, J=35, FUNCTION=-3*AZ(25,35)-0.1\n"},
    {"VFORCE", "VFORCE/1, I=25, JFLOAT=63, RM=25, FX=3\\FY=-30*DY(25,8)\\FZ=1\n"},
    {"VTORQUE", "VTORQUE/1, I=25, JFLOAT=63, RM=25, TX=.3\\TY=.3*WY(25,31)\\TZ=-1\n"},
    {"GFORCE",
     "GFORCE/1, I=25, JFLOAT=63, RM=21, FX=3-50*DX(25,31,21)\\FY=2*VX(25,31,21)\\FZ=1\\TX=0.1*AX(25,35)\\TY=0.2\\"
     "TZ=WZ(25,31)\n"},
    {"reaction on a node", "GFORCE/1, I=37, JFLOAT=64, RM=31, FX=3\\FY=2\\FZ=-30*DZ(25,1)\\TX=0.3\\TY=0.2\\TZ=0\n"},
    {"NFORCE",
     "MATRIX/5, SPARSE, ROWS=12, COLUMNS=12, I=1,2,3,5,7,7,8,9,1, J=1,2,3,5,7,1,8,9,7, "
     "VALUES=300,400,500,6,350,-100,450,550,-100\nMATRIX/6, FULL=RORDER, ROWS=12, COLUMNS=1, "
     "VALUES=0.1,0,0,0,0,0,0.5,0,0,0,0,0\n"
     "NFORCE/1, IMARKERS=21,25, J=31, KMATRIX=5, CRATIO=0.01, LENGTH=6\n"},
    {"CABLE", "CABLE/1, MARKERS=8,25,30, K=50, LENGTH=1\n"},
    {"JOURNAL", "JOURNAL/1, I=23, J=33, RADIUS=0.1, LENGTH=0.05, CLEARANCE=0.02, VISCOSITY=5, SPEED=200\n"},
    {"CONTACT",
     "GRAPHICS/1, PLANE, RM=8, XMIN=-5, XMAX=5, YMIN=-5, YMAX=5\nGRAPHICS/2, ELLIPSOID, CM=25, XSCALE=1.2, YSCALE=1.2, "
     "ZSCALE=1.2\nCONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E3, EXPONENT=1.5, DAMPING=10, DMAX=0.01\n"
     ", COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.2, STICTION_TRANSITION_VELOCITY=0.1, "
     "FRICTION_TRANSITION_VELOCITY=0.5\n"},
};

class StiffFlexBody : public Cases {
 protected:
  static constexpr double length = 0.6;
  static constexpr std::size_t nodes = 5;

  void SetUp() override {
    Cases::SetUp();
    const Vibration free = vibration(beam_, 0);
    lowest_ = std::sqrt(free.squares(6));
    const ReducedBody body = reduced(beam_, free.shapes.middleCols(6, 8));
    write("stiff.fem", modal_text(body.nodes, body.stiffness));
    double mass = 0, own_x = 0, own_y = 0, own_z = 0;
    for (const FlexibleNode& n : body.nodes) {
      const double beside = n.mass * (n.at.x - length / 2) * (n.at.x - length / 2);
      mass += n.mass, own_x += n.own.x, own_y += n.own.y + beside, own_z += n.own.z + beside;
    }
    flexible_ = "FLEX_BODY/2, MNF_FILE=stiff.fem, CRATIO=0, " + pose + "\n";
    rigid_ = fmt::format("PART/2, MASS={:.17g}, CM=29, IP={:.17g},{:.17g},{:.17g}, {}\nMARKER/29, PART=2, QP={},0,0\n",
                         mass, own_x, own_y, own_z, pose, length / 2);
    for (const int node : {1, 3, 5}) {
      flexible_ += fmt::format("MARKER/2{0}, FLEX_BODY=2, NODE_ID={0}, {1}\n", node, axes);
      rigid_ += fmt::format("MARKER/2{}, PART=2, QP={:.17g},0,0, {}\n", node, 0.25 * length * (node - 1), axes);
    }
    flexible_ += "MARKER/61, FLEX_BODY=2, NODE_ID=3, FLOATING\nMARKER/64, FLEX_BODY=2, NODE_ID=5, FLOATING\n";
    rigid_ += "MARKER/61, PART=2, FLOATING\nMARKER/64, PART=2, FLOATING\n";
  }
  // What is slow beside the modes.
  std::vector<std::complex<double>> values(const std::string& body, const Element& element) const {
    const RunResult r = run(head + body + rest + element.text + "END\n", "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << element.name << ": " << r.err;
    std::vector<std::complex<double>> slow;
    if (r.status != 0) return slow;
    for (const auto& e : r.eigenvalues(1)) {
      if (2 * std::numbers::pi * std::abs(e) < 0.01 * lowest_) slow.push_back(e);
    }
    return slow;
  }

  std::string flexible_, rigid_;
  double lowest_ = 0;

 private:
  const std::string pose = "QG=0.1,0.2,-0.1, REULER=20D,35D,-15D", axes = "REULER=10D,20D,30D";
  const std::string head =
      "Stiff\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/8, PART=1, QP=0.2,0.5,-0.6\n"
      "MARKER/9, PART=1, QP=-0.4,-0.3,0.4\n";
  const std::string rest =
      "PART/3, MASS=2, CM=30, IP=.02,.03,.04, " + pose + "\nMARKER/30, PART=3, QP=0.2,0.1,0\nMARKER/31, PART=3, " +
      axes + "\nMARKER/33, PART=3, QP=0.3,0,0, " + axes + "\nMARKER/35, PART=3, QP=0.6,0,0, " + axes +
      "\nMARKER/36, PART=3, QP=0.3,0,0, REULER=10D,110D,30D\nMARKER/37, PART=3, QP=0.3,0.02,0.03, REULER=10D,20D,30D\n"
      "MARKER/62, PART=3, FLOATING\nMARKER/63, PART=3, FLOATING\n"
      "PART/4, MASS=1, CM=40, IP=.1,.1,.1, " +
      pose +
      "\nMARKER/40\nMARKER/41, PART=4, QP=0.3,0.02,0.03, REULER=10D,20D,30D\n"
      "MARKER/42, PART=1, QP=0.1,0.2,-0.1, REULER=20D,35D,-15D\nMARKER/43, PART=4, QP=0.3,0.02,0.03, "
      "REULER=10D,110D,30D\n"
      "BUSHING/91, I=30, J=1, K=400,500,600, KT=50,60,70, C=1,2,3, CT=.1,.1,.1\n"
      "BUSHING/92, I=23, J=1, K=300,350,450, KT=40,50,60, C=1,1,1, CT=.1,.1,.1\n"
      "BUSHING/93, I=40, J=42, K=300,350,450, KT=40,50,60, C=1,1,1, CT=.1,.1,.1\n"
      // y = 0.3 x² and z = 0 through points of a curve, and a circle.
      "MATRIX/1, FULL=RORDER, ROWS=5, COLUMNS=3, VALUES=-1,0.3,0, -0.5,0.075,0, 0,0,0, 0.5,0.075,0, 1,0.3,0\n"
      "CURVE/1, OPEN, MATRIX=1, CURVE_POINTS\n"
      "MATRIX/2, FULL=RORDER, ROWS=5, COLUMNS=3, VALUES=-1,1,0, -0.5,0.25,0, 0,0,0, 0.5,0.25,0, 1,1,0\n"
      "CURVE/2, OPEN, MATRIX=2, CURVE_POINTS\n";
  static constexpr LumpedBeam beam_{nodes, length, 4.2e12, 9e8, 1.3e9, 2.1e9, 1.9, 2.5e-3};
};

// Modes give by the square of the ratio of frequencies.
TEST_F(StiffFlexBody, is_a_part_to_each_joint_and_force) {
  for (const Element& element : elements) {
    SCOPED_TRACE(element.name);
    const auto found = values(flexible_, element), expected = values(rigid_, element);
    EXPECT_EQ(found.size(), expected.size());
    EXPECT_FALSE(expected.empty());
    double size = 0;
    for (const auto& e : expected) size = std::max(size, std::abs(e));
    for (const auto& e : expected) {
      double nearest = 1e300;
      for (const auto& f : found) nearest = std::min(nearest, std::abs(e - f));
      EXPECT_LE(nearest, 2e-7 * size) << e;
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::stiff_flex_body_test
