// What an OPENBOX writes, and what may be done with it afterwards.
#include <gmock/gmock.h>

#include "nastran/closed_box.h"
#include "nastran/deck_roots_test_support.h"
#include "nastran/open_box.h"
#include "nastran/unused_items.h"

namespace dynalin::nastran::open_box_cards_test {
namespace {

using namespace nastran_test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

Deck box_of(const Linearization& of, const ExportOptions& options = {}) {
  Diagnostics remarks;
  return value_or_throw(open_box(of, options, remarks));
}
std::string error_of(const Linearization& of, const ExportOptions& options) {
  Diagnostics remarks;
  const auto deck = open_box(of, options, remarks);
  return deck ? "" : deck.error().message;
}
std::vector<std::string> remarks_of(const Linearization& of, const ExportOptions& options = {}) {
  Diagnostics remarks;
  value_or_throw(open_box(of, options, remarks));
  std::vector<std::string> found;
  for (const Diagnostic& d : remarks.items()) found.push_back(std::string(d.code) + ": " + d.message);
  return found;
}
std::vector<std::string> names_of(const Deck& deck) {
  std::vector<std::string> names;
  for (const Matrix& m : deck.matrices) names.push_back("KBM"[static_cast<std::size_t>(m.kind)] + m.suffix);
  return names;
}

// Two bodies in no field of gravity on bushings without load, the pose turned so that no block is diagonal.
std::string on_bushings(const std::string& stiffness, const std::string& further = "") {
  return "PART/2, MASS=2, CM=20, IP=0.4,0.5,0.6, QG=0.1,0.2,0.3, REU=0.4,0.5,0.6\nMARKER/20, PART=2, QP=0.2,0.1,-0.1\n"
         "MARKER/21, PART=2, QP=0.3,0,0, REU=0,0.3,0\nMARKER/22, PART=2\n"
         "PART/3, MASS=1, CM=30, IP=0.1,0.1,0.1, QG=0.1,0.2,0.3, REU=0.4,0.5,0.6\nMARKER/30, PART=3, QP=1,0,0\n"
         "MARKER/31, PART=3, QP=0.3,0,0, REU=0,0.3,0\nMARKER/12, PART=1, QP=0.1,0.2,0.3, REU=0.4,0.5,0.6\n"
         "BUSHING/1, I=31, J=21, K=" +
         stiffness + ", KT=30,40,50, C=1,2,3, CT=1,1,1\nBUSHING/2, I=12, J=22, K=500,600,700, KT=20,25,15\n" + further;
}

TEST(OpenBoxCards, a_bushing_changed_in_the_deck_is_the_one_changed_in_the_dataset) {
  Deck deck = box_of(linearization_of(on_bushings("100,150,200")));
  ASSERT_EQ(deck.bushes.size(), 2u);
  EXPECT_EQ(deck.bushes[0].id, 6000001);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(deck.bushes[0].stiffness[k], 100 + 50 * static_cast<double>(k), 1e-9);
    deck.bushes[0].stiffness[k] *= 2;
  }
  const auto expected = eigenvalues_of(linearization_of(on_bushings("200,300,400")));
  expect_roots(deck, expected);
  // Without the rest of the exact matrices: there is none of an unloaded bushing.
  ExportOptions options;
  options.export_residuals = false;
  deck = box_of(linearization_of(on_bushings("200,300,400")), options);
  EXPECT_THAT(deck.matrices, IsEmpty());
  expect_roots(deck, expected);
}

TEST(OpenBoxCards, a_line_force_is_a_bush_along_its_line) {
  const Deck deck = box_of(linearization_of(
      "PART/2, MASS=2, CM=20, IP=0.4,0.5,0.6, QG=1,2,2\nMARKER/20, PART=2\nMARKER/21, PART=2, REU=1,2,3\n"
      "SPRINGDAMPER/4, TRANSLATIONAL, I=21, J=1, K=70, C=3, LENGTH=2\nBUSHING/1, I=20, J=12, K=9,9,9, KT=9,9,9\n"
      "MARKER/12, PART=1, QP=1,2,2\n",
      Start::as_stated));
  ASSERT_EQ(deck.bushes.size(), 2u);
  for (const Bush& bush : deck.bushes) {
    if (bush.name != "SPRINGDAMPER/4") continue;
    EXPECT_NEAR(bush.stiffness[0], 70, 1e-11);
    EXPECT_NEAR(bush.damping[0], 3, 1e-12);
    for (std::size_t k = 1; k < 6; ++k) EXPECT_EQ(bush.stiffness[k], 0);
    const auto axes = std::ranges::find(deck.systems, bush.system, &CoordinateSystem::id);
    ASSERT_NE(axes, deck.systems.end());
    EXPECT_NEAR(axes->axes.x.x, 1.0 / 3, 1e-15);
    EXPECT_NEAR(axes->axes.x.z, 2.0 / 3, 1e-15);
  }
  // Across its line a stretched spring is stiff by the change of its direction.
  EXPECT_THAT(names_of(deck), ElementsAre("KSPRIN4"));
}

// A bushing that holds points alone has moments about mass centres, which cancel at the marker.
TEST(OpenBoxCards, a_bush_has_what_is_soft_and_not_what_is_rounding) {
  const Deck deck = box_of(
      linearization_of("PART/2, MASS=2, CM=20, IP=0.4,0.5,0.6, QG=0.1,0.2,0.3\nMARKER/20, PART=2, QP=0.2,0.1,-0.1\n"
                       "MARKER/21, PART=2, QP=0.9,0.7,0.3, REU=0.3,0.7,0.2\nMARKER/22, PART=2\n"
                       "MARKER/12, PART=1, QP=1,0.9,0.6, REU=0.3,0.7,0.2\nMARKER/13, PART=1, QP=0.1,0.2,0.3\n"
                       "BUSHING/1, I=21, J=12, K=3E6,3E-6,3E6\nBUSHING/2, I=22, J=13, K=9,9,9, KT=5E-9,5E3,5E3\n"));
  ASSERT_EQ(deck.bushes.size(), 2u);
  EXPECT_NEAR(deck.bushes[0].stiffness[1], 3e-6, 1e-8);
  EXPECT_NEAR(deck.bushes[1].stiffness[3], 5e-9, 1e-11);
  for (std::size_t k = 3; k < 6; ++k) EXPECT_EQ(deck.bushes[0].stiffness[k], 0) << k;
}

TEST(OpenBoxCards, what_a_bush_cannot_have_is_not_left_out_in_silence) {
  const Linearization of = linearization_of(
      "PART/2, MASS=2, CM=20, IP=0.4,0.5,0.6\nMARKER/20, PART=2\nMARKER/21, PART=2, QP=1,0,0\n"
      "BUSHING/1, I=20, J=1, K=9,9,9, KT=9,9,9\n"
      "SFORCE/4, TRANSLATIONAL, I=21, J=1, FUNCTION=2*(DM(21,1)-1)\n");
  ExportOptions options;
  EXPECT_THAT(remarks_of(of, options), IsEmpty());
  EXPECT_THAT(names_of(box_of(of, options)), ElementsAre("KSFORC4"));
  options.export_residuals = false;
  EXPECT_THAT(remarks_of(of, options), ElementsAre(HasSubstr("SFORCE/4 is negative along K1 of its CBUSH")));
  EXPECT_THAT(box_of(of, options).matrices, IsEmpty());
}

TEST(OpenBoxCards, forces_that_are_singled_out_have_matrices_of_their_own) {
  const std::string further =
      "SFORCE/77, ROTATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=-3*AX(30)\nVFORCE/123456, I=30, "
      "JFLOAT=13, RM=1, FX=-5*VX(30)\\FY=0\\FZ=0\nMARKER/13, PART=1, FLOATING\n"
      "SFORCE/1234, ROTATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=-3*AY(30)\n";
  const Linearization of = linearization_of(on_bushings("100,150,200", further));
  ExportOptions options;
  options.export_cbush = false;
  EXPECT_THAT(names_of(box_of(of, options)),
              UnorderedElementsAre("KBUSHI1", "BBUSHI1", "KBUSHI2", "KSFOR77", "BF00001", "KSF1234"));
  options.all_forces_editable = false;
  options.force_editable = {{"sforce", 77, "", "sf7"}};
  EXPECT_THAT(names_of(box_of(of, options)), UnorderedElementsAre("KSF7", "KVVV", "BVVV"));
  options.forces_dmig_name = "FQ";
  EXPECT_THAT(names_of(box_of(of, options)), UnorderedElementsAre("KSF7", "KFQ", "BFQ"));

  const auto refused = [&](Editable wanted) {
    options.force_editable = {std::move(wanted)};
    return error_of(of, options);
  };
  EXPECT_THAT(refused({"sforce", 78, "", "A"}), HasSubstr("SFORCE/78 does not exist"));
  EXPECT_THAT(refused({"bushing", 77, "", "A"}), HasSubstr("BUSHING/77 does not exist"));
  EXPECT_THAT(refused({"sforce", {}, "model.nothing", "A"}), HasSubstr("no SFORCE has the name model.nothing"));
  EXPECT_THAT(refused({"sforce", 77, "", "EIGHTEEN"}), HasSubstr("up to 7 letters"));
  // Two letters before those of a matrix in two parts.
  options.solution_number = 108;
  EXPECT_THAT(refused({"sforce", 77, "", "SEVENTY"}), HasSubstr("up to 6 letters"));
  options.solution_number = 107;
  EXPECT_THAT(refused({"sforce", 77, "", "FQ"}), HasSubstr("FQ already"));
  options.force_editable = {{"sforce", 77, "", "A"}, {"sforce", 1234, "", "a"}};
  EXPECT_THAT(error_of(of, options), HasSubstr("both have the suffix a"));
  options.ignore_errors = true;
  EXPECT_THAT(remarks_of(of, options), ElementsAre(HasSubstr("both have the suffix a")));
  options.ignore_errors = false;
  EXPECT_EQ(refused({"sforce", 77, "", "SEVENTY"}), "");
}

// A hinge as relations makes places of the pendulum dependent: its velocity at the start is that of its angle.
TEST(OpenBoxCards, initial_conditions_are_those_of_independent_freedoms) {
  ExportOptions options;
  options.use_rjoints = false;
  const Deck deck = box_of(linearization_of("PART/2, MASS=1, CM=20, IP=1,1,1, WZ=2\nMARKER/20, QP=0,-1,0\nMARKER/21\n"
                                            "JOINT/1, REVOLUTE, I=21, J=1\n",
                                            Start::as_stated),
                           options);
  ASSERT_EQ(deck.initial_states.size(), 1u);
  EXPECT_EQ(deck.initial_states[0].dof.component, 6);
  EXPECT_EQ(deck.initial_states[0].velocity, 2);
}

TEST(OpenBoxCards, damping_is_left_out_where_it_is_not_wanted) {
  const std::string further =
      "DIFF/1, FUNCTION=-3*DIF(1)+2*DX(30)-VY(20)\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=30, J=12, FUNCTION=4*DIF(1)-VX(30)\n";
  LinearRequest request;
  request.without_damping = true;
  const Linearization with = linearization_of(on_bushings("100,150,200", further)),
                      without = linearization_of(on_bushings("100,150,200", further), Start::at_rest, request);
  ExportOptions options;
  options.use_damping = false;
  expect_roots(box_of(with, options), eigenvalues_of(without));
  expect_roots(box_of(without), eigenvalues_of(with));
}

TEST(OpenBoxCards, a_part_without_mass_gets_a_small_one) {
  const std::string chain =
      "PART/2, QG=1,0,0\nMARKER/20, PART=2, REU=90D,90D,0\nPART/3, MASS=2, CM=30, IP=1,1,1, QG=2,0,0\n"
      "MARKER/30, PART=3, REU=90D,90D,0\nMARKER/12, PART=1, REU=90D,90D,0\n"
      "JOINT/2, TRANSLATIONAL, I=20, J=12\nJOINT/3, TRANSLATIONAL, I=30, J=12\n"
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=100, LENGTH=1\n"
      "SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=20, K=50, LENGTH=1\n";
  const Linearization of = linearization_of(chain);
  const Deck deck = box_of(of);
  ASSERT_EQ(deck.masses.size(), 2u);
  EXPECT_DOUBLE_EQ(deck.masses[0].mass, 2e-8);
  EXPECT_GT(trace(deck.masses[0].inertia), 0);
  expect_roots(deck, eigenvalues_of(of), 1e-7);
  EXPECT_THAT(remarks_of(of),
              ElementsAre(HasSubstr("export-differs: a mass of 2e-08 is given to what has none, PART/2")));
  ExportOptions options;
  options.small_mass = 0.5;
  EXPECT_EQ(box_of(of, options).masses[0].mass, 0.5);
}

TEST(OpenBoxCards, masses_are_in_units_of_force) {
  const auto model =
      system_test::model_of(on_bushings("100,150,200"), "FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND");
  const Linearization of = linearization_of(*System::make(model));
  const Deck deck = box_of(of);
  EXPECT_NEAR(deck.masses[0].mass, 2e-3, 1e-18);
  // In these units frequencies lie five orders apart, of which the dense solution here loses digits.
  expect_roots(deck, eigenvalues_of(of), 1e-6);
}

TEST(OpenBoxCards, a_point_without_freedoms_is_exported) {
  const std::string held =
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, PART=2, QP=1,0,0\nMARKER/21, PART=2\n"
      "JOINT/1, REVOLUTE, I=21, J=1\nMOTION/1, JOINT=1, FUNCTION=0\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=3-DX(20)\n";
  const Linearization of = linearization_of(held, Start::as_stated);
  const Deck deck = box_of(of);
  EXPECT_EQ(deck.states, 0u);
  EXPECT_EQ(DenseDeck(deck).free.cols(), 0);
  const Linearization with_state = linearization_of(held + "DIFF/1, FUNCTION=-3*DIF(1)\n", Start::as_stated);
  expect_roots(box_of(with_state), {Complex(-3)});
}

TEST(OpenBoxCards, velocities_are_written_where_there_are_any) {
  const Linearization of = linearization_of(
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0.4,0,0, WZ=3\nMARKER/20, PART=2, QP=1,0,0\nMARKER/21, PART=2, QP=-0.4,0,0\n"
      "JOINT/1, REVOLUTE, I=21, J=1\n",
      Start::as_stated);
  EXPECT_THAT(remarks_of(of), ElementsAre(HasSubstr("export-differs: the model moves")));
  const Deck deck = box_of(of);
  std::map<int, double> velocity;
  for (const InitialState& s : deck.initial_states) {
    EXPECT_EQ(s.dof.point, 100002);
    velocity[s.dof.component] = s.velocity;
  }
  EXPECT_NEAR(velocity[2], 1.4 * 3, 1e-12);  // of the mass centre
  EXPECT_NEAR(velocity[6], 3, 1e-12);
  const Linearization at_rest =
      linearization_of("PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, PART=2\nJOINT/1, REVOLUTE, I=20, J=1\n");
  EXPECT_THAT(box_of(at_rest).initial_states, IsEmpty());
}

TEST(OpenBoxCards, only_a_point_at_rest_is_taken_as_such) {
  const std::string falling =
      "ACCGRAV/JGRAV=-9.81\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, PART=2, QP=1,0,0\n"
      "MARKER/21, PART=2\nJOINT/1, REVOLUTE, I=21, J=1\n";
  EXPECT_THAT(remarks_of(linearization_of(falling)), IsEmpty());
  EXPECT_THAT(remarks_of(linearization_of(falling, Start::as_stated)), ElementsAre(HasSubstr("moves or accelerates")));
}

TEST(OpenBoxCards, joints_hold_components_where_they_can) {
  const std::string bodies =
      "PART/2, MASS=1, CM=20, IP=1,1,1, REU=1,2,3\nMARKER/20, PART=2, QP=1,0,0\nMARKER/21, PART=2\nMARKER/22, PART=2, "
      "QP=0,0,0.2\nPART/3, MASS=1, CM=30, IP=1,1,1, REU=1,2,3\nMARKER/30, PART=3, QP=1,0,0\nMARKER/31, PART=3\n"
      "MARKER/32, PART=3, REU=0,90D,0\nBUSHING/1, I=21, J=1, K=9,9,9, KT=9,9,9\nBUSHING/2, I=31, J=1, K=9,9,9, "
      "KT=9,9,9\n";
  const auto components = [&](const std::string& joint) {
    const Deck deck = box_of(linearization_of(bodies + joint + "\n", Start::as_stated));
    return deck.rigid_joints.empty() ? "none, " + std::to_string(deck.relations.size())
                                     : deck.rigid_joints[0].components;
  };
  EXPECT_EQ(components("JOINT/1, FIXED, I=31, J=21"), "123456");
  EXPECT_EQ(components("JOINT/1, REVOLUTE, I=31, J=21"), "12345");
  EXPECT_EQ(components("JOINT/1, SPHERICAL, I=31, J=21"), "123");
  EXPECT_EQ(components("JOINT/1, CYLINDRICAL, I=31, J=21"), "1245");
  EXPECT_EQ(components("JOINT/1, TRANSLATIONAL, I=31, J=21"), "12456");
  EXPECT_EQ(components("JOINT/1, PLANAR, I=31, J=21"), "345");
  EXPECT_EQ(components("JPRIM/1, INLINE, I=31, J=21"), "12");
  EXPECT_EQ(components("JPRIM/1, PARALLEL_AXES, I=31, J=21"), "45");
  // Apart along a free direction the rows turn with the body.
  EXPECT_EQ(components("JOINT/1, TRANSLATIONAL, I=31, J=22"), "none, 5");
  // About the common normal of two crossed axes, which here is an axis of J; at another angle it is not.
  EXPECT_EQ(components("JOINT/1, UNIVERSAL, I=32, J=21"), "1234");
  ExportOptions options;
  options.use_rjoints = false;
  const Deck deck = box_of(linearization_of(bodies + "JOINT/1, REVOLUTE, I=31, J=21\n", Start::as_stated), options);
  EXPECT_THAT(deck.rigid_joints, IsEmpty());
  EXPECT_EQ(deck.relations.size(), 5u);
}

TEST(OpenBoxCards, numbers_follow_the_ids_or_one_another) {
  const Linearization of =
      linearization_of(on_bushings("100,150,200",
                                   "POINT_MASS/4, MASS=1, CM=40\nMARKER/40, POINT_MASS=4\nDIFF/9, FUNCTION=-DIF(9)\n"
                                   "BUSHING/3, I=40, J=1, K=9,9,9\nMARKER/14, PART=1, FLOATING\n"));
  const auto ids = [](const Deck& deck) {
    std::vector<std::int64_t> list;
    for (const Grid& g : deck.grids) list.push_back(g.id);
    for (const ScalarPoint& p : deck.scalar_points) list.push_back(p.id);
    return list;
  };
  const std::vector<std::int64_t> found = ids(box_of(of));
  for (const std::int64_t id : {100001, 100002, 100003, 2000004, 1000020, 1000030, 1000040, 3000009})
    EXPECT_THAT(found, ::testing::Contains(id));
  EXPECT_THAT(found, ::testing::Contains(1000012));  // of BUSHING/2
  ExportOptions options;
  options.use_adams_ids = false, options.grid_offset = 500;
  const std::vector<std::int64_t> sequential = ids(box_of(of, options));
  EXPECT_EQ(sequential.size(), found.size());
  EXPECT_EQ(*std::ranges::min_element(sequential), 500);
  EXPECT_EQ(*std::ranges::max_element(sequential), 500 + static_cast<std::int64_t>(found.size()) - 1);
}

TEST(OpenBoxCards, rigid_joints_have_the_ids_of_the_dataset_behind_their_offset) {
  const Linearization of = linearization_of(
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, QP=0,-1,0\nMARKER/21\nJOINT/7, REVOLUTE, I=21, J=1\n"
      "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30, QP=0,-2,0\nMARKER/31, PART=3\nJOINT/12, FIXED, I=31, J=21\n");
  ExportOptions options;
  options.rjoint_offset = 2000;
  const auto ids = [&] {
    std::vector<std::int64_t> list;
    for (const RigidJoint& j : box_of(of, options).rigid_joints) list.push_back(j.id);
    return list;
  };
  EXPECT_THAT(ids(), ::testing::UnorderedElementsAre(2007, 2012));
  options.use_adams_ids = false;
  EXPECT_THAT(ids(), ::testing::UnorderedElementsAre(2000, 2001));
}

TEST(OpenBoxCards, unused_items_can_be_left_out_of_frequency_response) {
  const Linearization of = linearization_of(
      on_bushings("100,150,200", "MARKER/33, PART=3, QP=1,1,1\nSFORCE/5, TRANSLATIONAL, I=33, J=1, FUNCTION=TIME\n"));
  ExportOptions options;
  const auto count = [&] {
    Deck deck = box_of(of, options);
    std::vector<std::string> details;
    remove_unused(deck, options, details);
    EXPECT_NO_THROW(DenseDeck{deck});
    return std::pair(deck.grids.size(), deck.bushes.size());
  };
  const auto all = count();
  options.remove_unused_items = {"cbush", "grid"};
  const auto used = count();
  EXPECT_EQ(all.second, 3u);
  EXPECT_EQ(used.second, 2u);
  EXPECT_EQ(used.first, 3u + 4u);  // ground and bodies; the markers of two bushings
  EXPECT_GT(all.first, used.first);
}

// Points that only draw count as well.
TEST(OpenBoxCards, unused_points_are_counted) {
  Deck deck;
  deck.grids.resize(2), deck.shape_grids.resize(3);
  for (std::size_t k = 0; k < 2; ++k) deck.grids[k].id = static_cast<std::int64_t>(k + 1);
  for (std::size_t k = 0; k < 3; ++k) deck.shape_grids[k].id = static_cast<std::int64_t>(k + 11);
  ExportOptions options;
  options.remove_unused_items = {"grid"};
  std::vector<std::string> details;
  remove_unused(deck, options, details);
  EXPECT_TRUE(deck.grids.empty() && deck.shape_grids.empty());
  EXPECT_THAT(details, ElementsAre("GRID cards taken out: 5"));
}

TEST(OpenBoxCards, response_at_channels_is_that_of_the_closed_box) {
  const Linearization of = linearization_of(
      "ACCGRAV/JGRAV=-9.81\nPART/2, MASS=2, CM=20, IP=0.1,0.2,0.3, QG=0.1,0.2,0\nMARKER/20, PART=2, QP=0.4,-0.3,0.1\n"
      "MARKER/21, PART=2, REU=0.1,0.2,0.3\nMARKER/11, PART=1, QP=0.1,0.2,0, REU=0.1,0.2,0.3\n"
      "JOINT/1, REVOLUTE, I=21, J=11\nSPRINGDAMPER/1, ROTATIONAL, I=21, J=11, KT=30, CT=2\n"
      "MARKER/25, PART=2, QP=1,0.2,0.1, REU=0.4,0.2,2\n");
  for (const Axes axes : {Axes::local, Axes::global}) {
    ExportOptions options;
    options.solution_number = 108;
    InputChannel in;
    in.name = "in", in.marker_id = 20, in.mode = axes;
    OutputChannel out;
    out.name = "out", out.marker_id = 25, out.mode = axes;
    options.force_input_channel = {in};
    options.displacement_output_channel = {out};
    const Deck open = box_of(of, options);
    Diagnostics remarks;
    const Deck closed = value_or_throw(closed_box(of, options, remarks));
    const DenseDeck a(open), b(closed);
    double largest = 0, difference = 0;
    for (int r = 1; r <= 6; ++r) {
      for (int c = 1; c <= 6; ++c) {
        const Complex s(0, 4);
        const Complex x = a.response({open.outputs[0].grid, r}, {open.inputs[0].grid, c}, s),
                      y = b.response({closed.outputs[0].grid, r}, {closed.inputs[0].grid, c}, s);
        largest = std::max(largest, std::abs(x)), difference = std::max(difference, std::abs(x - y));
      }
    }
    EXPECT_LT(difference, 1e-12 * largest);
    EXPECT_GT(largest, 1e-3);
  }
}

TEST(OpenBoxCards, mode_shapes_are_those_of_the_deck) {
  const Linearization of =
      linearization_of(on_bushings("100,150,200",
                                   "JOINT/1, REVOLUTE, I=31, J=21\nDIFF/1, FUNCTION=-3*DIF(1)+2*DX(30)-VY(20)\n"
                                   "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=30, J=12, FUNCTION=4*DIF(1)-VX(30)\n"));
  ExportOptions options;
  options.export_mode_shapes = true;
  EXPECT_THAT(box_of(of).modes, IsEmpty());
  const Deck deck = box_of(of, options);
  EXPECT_THAT(deck.mode_points, ElementsAre(100002, 100003, 3000001));
  ASSERT_GT(deck.modes.size(), 6u);
  const DenseDeck dense(deck);
  for (const DeckMode& mode : deck.modes) {
    // The motion that the constraints let pass and that has these values at the points.
    std::vector<Eigen::Index> places;
    std::vector<Complex> values;
    double largest = 0;
    for (std::size_t p = 0; p < deck.mode_points.size(); ++p) {
      const bool scalar = p == 2;
      for (std::size_t c = 0; c < (scalar ? 1u : 6u); ++c) {
        places.push_back(dense.place({deck.mode_points[p], scalar ? 0 : static_cast<int>(c) + 1}));
        values.emplace_back(mode.shape[p][c][0], mode.shape[p][c][1]);
        largest = std::max(largest, std::abs(values.back()));
      }
    }
    EXPECT_NEAR(largest, 1, 1e-9);
    Eigen::MatrixXcd at(static_cast<Eigen::Index>(places.size()), dense.free.cols());
    Eigen::VectorXcd shape(at.rows());
    for (Eigen::Index r = 0; r < at.rows(); ++r) {
      at.row(r) = dense.free.row(places[static_cast<std::size_t>(r)]).cast<Complex>();
      shape(r) = values[static_cast<std::size_t>(r)];
    }
    const Eigen::VectorXcd q = at.colPivHouseholderQr().solve(shape);
    EXPECT_LT((at * q - shape).norm(), 1e-8);
    const Complex s(mode.eigenvalue[0], mode.eigenvalue[1]);
    const Eigen::MatrixXcd polynomial = s * s * dense.M + s * dense.B + dense.K.cast<Complex>();
    const Eigen::MatrixXcd reduced = dense.free.transpose() * polynomial * dense.free;
    EXPECT_LT((reduced * q).norm(), 1e-8 * reduced.norm() * q.norm());
  }
}

}  // namespace
}  // namespace dynalin::nastran::open_box_cards_test
