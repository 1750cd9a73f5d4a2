// Open boxes of flexible bodies and of beams of finite elements: whatever has matrices of its own, the roots of the
// deck are the eigenvalues of the model.
#include <gmock/gmock.h>

#include "cases/dataset_text.h"
#include "cases/decks.h"
#include "cases/fe_parts.h"
#include "cases/flexible.h"

namespace dynalin::cases::flexible_deck_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A boom of four modes on a fixed joint, and at its end a part in a bushing and a beam of finite elements; skew and
// under gravity.
class FlexibleDeck : public ProgramLibraryAndDecks {
 protected:
  void SetUp() override {
    ProgramLibraryAndDecks::SetUp();
    const LumpedBeam boom{6, 0.6, 4.2e8, 9e4, 1.3e5, 2.1e5, 1.9e4, 25};
    const ReducedBody body = reduced(boom, vibration(boom, 6).shapes.leftCols(4));
    write("boom.fem", modal_text(body.nodes, body.stiffness));
  }

  static std::string model() {
    StraightBeam beam{.elements = 2, .length = 0.5, .height = 0.02, .width = 0.03, .E = 2e12, .density = 9e6, .id = 4};
    beam.further = ", QG=0.2,0.1,0.4, REULER=0.3,1.2,-0.7";
    return "Boom\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=0.6, JGRAV=-9.81, KGRAV=0.4\nPART/1, GROUND\n"
           "MARKER/1, QP=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1\n"
           "! adams_view_name='boom'\n"
           "FLEX_BODY/2, MNF_FILE=boom.fem, QG=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1\n"
           "MARKER/21, NODE_ID=1\nMARKER/22, NODE_ID=6\nMARKER/23, NODE_ID=3, QP=0.05,0,0\nJOINT/1, FIXED, I=21, J=1\n"
           "PART/3, MASS=4E3, CM=30, IP=100,200,300, QG=0.3,-0.2,0.7\nMARKER/30, QP=0.1,0.2,0.3\n"
           "BUSHING/1, I=30, J=22, K=9E6,8E6,7E6, KT=9E5,8E5,7E5, C=3E4,2E4,1E4, CT=3E3,2E3,1E3\n" +
           beam.text() +
           "MARKER/43, FE_PART=4, NODE_LABEL=2, QP=0.25,0,0\n"
           "BUSHING/2, I=41, J=23, K=5E6,6E6,4E6, KT=5E5,6E5,7E5, C=1E4,2E4,3E4, CT=1E3,2E3,3E3\n"
           "SPRINGDAMPER/1, TRANSLATIONAL, I=43, J=30, K=5E5, C=4E3, LENGTH=0.1\nEND\n";
  }

  // Suffixes of matrices by the names of the deck's files.
  std::vector<std::string> matrices() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("deck_") && name.ends_with(".bdf") && name != "deck_GRAPHICS.bdf")
        names.push_back(name.substr(5, name.size() - 9));
    }
    std::ranges::sort(names);
    return names;
  }
};

// As a closed box too.
TEST_F(FlexibleDeck, has_the_roots_of_the_model) {
  const RunResult r = run(model(), "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_GE(r.eigenvalues(1).size(), 10u);
}

// Its rows hold slopes and rotations of a plane beam in the plane.
TEST_F(FlexibleDeck, has_the_roots_of_plane_beams) {
  const StraightBeam beam{.elements = 3, .height = 0.02, .width = 0.03, .E = 2e12, .density = 9e6, .type = "2DBEAMXY"};
  const RunResult r = run(clamped_beam(beam, "ACCGRAV/JGRAV=-9.81\n"), "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_GE(r.eigenvalues(1).size(), 8u);
}

TEST_F(FlexibleDeck, gives_bodies_matrices_of_their_own_or_none) {
  struct Way {
    const char* directives;
    std::vector<std::string> matrices;
  };
  const std::vector<Way> ways = {
      {"",
       {"BBUSHI1", "BBUSHI2", "BFLEXB2", "BSPRIN1", "KBUSHI1", "KBUSHI2", "KFEPAR4", "KFLEXB2", "KSPRIN1", "KVVV",
        "MFEPAR4", "MFLEXB2"}},
      {"all_flexbodies_editable = no\nall_forces_editable = no\n", {"BVVV", "KVVV", "MVVV"}},
      {"all_flexbodies_editable = no\nall_forces_editable = no\nflexbody_editable_by_id = 2, OFABOOM\n",
       {"BOFABOOM", "BVVV", "KOFABOOM", "KVVV", "MOFABOOM", "MVVV"}},
      {"all_flexbodies_editable = no\nall_forces_editable = no\nflexbody_editable_by_name = boom, OWN\n",
       {"BOWN", "BVVV", "KOWN", "KVVV", "MOWN", "MVVV"}},
  };
  for (const Way& way : ways) {
    write("export.cfg", std::string("split_dmigs = no\nexport_cbush = no\n") + way.directives);
    const RunResult r = Cases::run(
        model(), "SIMULATE/STATICS\nLINEAR/EIGENSOL\nLINEAR/EXPORT, TYPE=OPENBOX, FILE=deck, CONFIG=export.cfg\n");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(matrices(), way.matrices) << way.directives;
    expect_roots((folder_ / "deck.dat").string(), roots_of(r.result(1)), 1e-8);
    for (const std::string& name : matrices()) std::filesystem::remove(folder_ / ("deck_" + name + ".bdf"));
  }
}

// What a joint holds on a node that bends follows from the shape: all modal coordinates are states, and stiff ones
// need not cancel in the deck of a closed box.
TEST_F(FlexibleDeck, shapes_are_states_where_a_part_hangs_on_them) {
  const RunResult r =
      run("Boom\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=0.3,-0.2,0.7\nMARKER/2, QP=0.6,-0.2,0.7\n"
          "FLEX_BODY/2, MNF_FILE=boom.fem, QG=0.3,-0.2,0.7\nMARKER/21, NODE_ID=1\nMARKER/22, NODE_ID=6\n"
          "MARKER/23, NODE_ID=4\nPART/3, MASS=4E3, CM=31, IP=100,200,300, QG=0.9,-0.2,0.7\nMARKER/30\n"
          "MARKER/31, QP=0.1,0.2,0.3\nJOINT/1, FIXED, I=22, J=30\n"
          "BUSHING/1, I=21, J=1, K=9E6,8E6,7E6, KT=9E5,8E5,7E5\nBUSHING/2, I=23, J=2, K=9E6,8E6,7E6, KT=9E5,8E5,7E5\n"
          "END\n",
          "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  int modal = 0, all = 0;
  for (const auto& state : r.result(1).at("states")) {
    ++all;
    modal += state.dump().find("Modal generalized coordinate Q") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(all, 20);
  EXPECT_EQ(modal, 8);
}

// Nothing but what a static solution leaves of nothing accelerates a free boom that is pulled straight.
TEST_F(FlexibleDeck, is_at_rest_where_nothing_loads_it) {
  const RunResult r = Cases::run(
      "Free\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=boom.fem\nMARKER/21, NODE_ID=1\n"
      "PART/3, MASS=4E3, CM=30, IP=100,200,300, QG=0.1,0.2,0.3, REULER=20D,30D,40D\nMARKER/30\n"
      "BUSHING/1, I=30, J=21, K=9E6,8E6,7E6, KT=9E5,8E5,7E5\nEND\n",
      "SIMULATE/STATICS\nLINEAR/EXPORT, TYPE=OPENBOX, FILE=deck\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, Not(HasSubstr("moves or accelerates")));
}

TEST_F(FlexibleDeck, says_that_few_digits_are_too_few) {
  write("export.cfg", "use_dmig_long_format = no\n");
  const std::string commands = "LINEAR/EXPORT, TYPE=OPENBOX, FILE=deck";
  EXPECT_THAT(Cases::run(model(), commands + ", CONFIG=export.cfg\n").err,
              HasSubstr("FLEX_BODY/2 (boom), which bends"));
  EXPECT_THAT(Cases::run(model(), commands + "\n").err, Not(HasSubstr("which bends")));
}

TEST_F(FlexibleDeck, names_a_body_that_is_not_there) {
  write("export.cfg", "flexbody_editable_by_id = 4, OWN\n");
  const RunResult r = Cases::run(model(), "LINEAR/EXPORT, TYPE=OPENBOX, FILE=deck, CONFIG=export.cfg\n");
  EXPECT_NE(r.status, 0);
  EXPECT_THAT(r.err, HasSubstr("export.cfg:1:27: error: FLEX_BODY/4 does not exist"));
}

// Grids of bodies, nodes and part, then four modal coordinates and those of the beam.
TEST_F(FlexibleDeck, has_modal_coordinates_in_its_punch_file) {
  write("export.cfg", "export_mode_shapes = yes\nexport_graphics = no\n");
  const RunResult r =
      Cases::run(model(), "SIMULATE/STATICS\nLINEAR/EXPORT, TYPE=OPENBOX, FILE=deck, CONFIG=export.cfg\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string deck = r.text("deck_MODEL.nas"), punch = r.text("deck.pch");
  const std::string first_mode = punch.substr(0, punch.find("$TITLE", 10));
  const auto count = [](const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++n;
    return n;
  };
  EXPECT_EQ(count(first_mode, "       G "), 5u) << first_mode;
  EXPECT_EQ(count(first_mode, "       S "), count(deck, "SPOINT"));
  EXPECT_EQ(count(deck, "SPOINT"), 4u + 3u * 3u + 3u * 2u);
  EXPECT_EQ(count(deck, "CONM2"), 1u);  // of the part
  // Its grid is in the middle of the boom, 0.3 along its axis.
  const Vector axis = rotation_313(0.4, 0.9, -1.1) * Vector{0.3, 0, 0};
  EXPECT_THAT(deck, HasSubstr("$centre of mass of boom\n"));
  const std::string card = deck.substr(deck.find("$centre of mass of boom\n") + 24, 80);
  EXPECT_NEAR(std::stod(card.substr(40, 16)), 0.3 + axis.x, 0.05);
  EXPECT_NEAR(std::stod(card.substr(56, 16)), -0.2 + axis.y, 0.05);
  EXPECT_THAT(deck, HasSubstr("FE_PART/4, node 2"));
}

}  // namespace
}  // namespace dynalin::cases::flexible_deck_test
