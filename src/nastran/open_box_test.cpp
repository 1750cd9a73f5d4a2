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

}  // namespace
}  // namespace dynalin::nastran
