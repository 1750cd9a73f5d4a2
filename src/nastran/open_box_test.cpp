// OPENBOX: the deck of masses, joints and force matrices has the eigenvalues of the model in static equilibrium,
// whatever is singled out and however joints are written.
#include "nastran/open_box.h"

#include "nastran/deck_roots_test_support.h"

namespace dynalin::nastran {
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
    "MARKER/20, PART=2, QP=0.2,0.1,-0.1\nMARKER/22, PART=2, QP=0.5,0,0, REU=0.3,0.5,0.2\nMARKER/21, PART=2, REU=1,0.4,2\n"
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
        Named{"universal",
              "JOINT/1, UNIVERSAL, I=33, J=22\nMARKER/33, PART=3, QP=-0.3,0.1,-0.1, REU=0.3,2.0708,0.2\n"},
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

}  // namespace
}  // namespace dynalin::nastran
