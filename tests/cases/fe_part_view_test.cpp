// Beams of finite elements in the form that pre-processors write: rows of numbers for each node, statements for who
// draws them, and markers with places in the body coordinate system.
#include <dynalin/study.h>
#include <gmock/gmock.h>

#include <cmath>

#include "cases/fe_parts.h"
#include "cases/run.h"
#include "cases/study_of.h"

namespace dynalin::cases::fe_part_view_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using Row = std::vector<double>;

std::string numbers(const Row& row) { return fmt::format("{:.17g}", fmt::join(row, ", ")); }

// A bow of steel that tapers: nodes on an arc, numbered as pre-processors may leave them.
struct Bow {
  std::vector<int> labels{4, 1, 7, 3};
  std::vector<Row> places, sections;  // x, y, z, psi, theta, phi; area, Iyy, Izz, Iyz, J

  Bow() {
    for (int k = 0; k < 4; ++k) {
      const double a = 0.3 * (k - 1.5), b = 0.02 - 0.002 * k, h = 0.01 + 0.001 * k;
      // The turn about x leaves x where it is.
      places.push_back({std::sin(a), 1 - std::cos(a), 0.1, a, 0.1 * k, 0});
      sections.push_back({b * h, b * b * b * h / 12, b * h * h * h / 12, 1e-11 * k, 1e-9 + 1e-10 * k});
    }
  }
  std::string all_labels() const { return fmt::format("NODE_LABELS={}", fmt::join(labels, ", ")); }
  static Row column(const std::vector<Row>& rows, std::size_t k) {
    Row list;
    for (const Row& row : rows) list.push_back(row[k]);
    return list;
  }
  std::string lists(const std::vector<Row>& rows, const std::vector<std::string>& names) const {
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k) text += fmt::format("\n, {}={}", names[k], numbers(column(rows, k)));
    return text;
  }
  std::string by_lists() const {
    return all_labels() + lists(places, {"X", "Y", "Z", "PSI", "THETA", "PHI"}) +
           lists(sections, {"AREA", "IYY", "IZZ", "IYZ", "IXX"}) + "\n, CRATIO=1E-4";
  }
  std::string rows(const std::vector<Row>& list, const std::vector<std::size_t>& order) const {
    std::string text;
    for (const std::size_t k : order) text += fmt::format("\n, {}, {}", labels[k], numbers(list[k]));
    return text;
  }
  std::string by_rows(bool with_labels, const std::vector<std::size_t>& order) const {
    return (with_labels ? all_labels() + "\n, " : "") + "COORDINATES = " + rows(places, order) +
           "\n, SECTION =" + rows(sections, order) + "\n, CRATIOK = 1E-4";
  }
  std::string at(std::size_t k) const {
    return fmt::format("QP={:.17g},{:.17g},{:.17g}", places[k][0], places[k][1], places[k][2]);
  }
  std::string model(const std::string& nodes, const std::string& further = "") const {
    return beam_model(
        "ACCGRAV/KGRAV=-9.81\nMATERIAL/1, NAME=steel, DENSITY=7800, YOUNGS_MODULUS=2.1E11, "
        "POISSONS_RATIO=0.3\nFE_PART/2, TYPE=3DBEAM, QG=0.2,0.1,-0.3, REULER=20D,35D,-10D, MATERIAL=1\n, " +
        nodes + "\nMARKER/21, FE_PART=2, NODE_LABEL=4, " + at(0) + "\nMARKER/22, FE_PART=2, NODE_LABEL=3, " + at(3) +
        "\nMARKER/3, PART=1, QP=0.2,0.1,-0.3, REULER=20D,35D,-10D\nMARKER/4, PART=1, RM=3, " + at(0) +
        "\nJOINT/1, FIXED, I=21, J=4\n" + further);
  }
};

}  // namespace

class FePartView : public Cases {};

TEST_F(FePartView, rows_state_what_lists_do) {
  const Bow bow;
  const std::string commands = "SIMULATE/STATICS\nLINEAR/EIGENSOL\nLINEAR/STATEMAT, FILE=a\n";
  const RunResult lists = run(bow.model(bow.by_lists()), commands);
  ASSERT_EQ(lists.status, 0) << lists.err;
  EXPECT_GE(lists.eigenvalues(1).size(), 60u);
  for (const std::string& nodes :
       {bow.by_rows(true, {0, 1, 2, 3}), bow.by_rows(false, {0, 1, 2, 3}), bow.by_rows(true, {2, 0, 3, 1})}) {
    const RunResult rows = run(bow.model(nodes), commands);
    ASSERT_EQ(rows.status, 0) << rows.err;
    EXPECT_EQ(rows.json.at("results"), lists.json.at("results")) << nodes;
  }
}

TEST_F(FePartView, angles_of_rows_are_radians_or_degrees) {
  const auto model = [](const std::string& psi) {
    return beam_model(
        "MATERIAL/1, DENSITY=1, YOUNGS_MODULUS=1E7, POISSONS_RATIO=0.3\nFE_PART/2, TYPE=3DBEAM, "
        "MATERIAL=1, COORDINATES=1,0,0,0,0,0,0, 2,1,0.2,0," +
        psi +
        ",0,0, SECTION=1,1E-4,1E-9,1E-9,0,2E-9, 2,1E-4,1E-9,1E-9,0,2E-9\nMARKER/21, FE_PART=2, "
        "NODE_LABEL=1\nJOINT/1, FIXED, I=21, J=1\n");
  };
  const RunResult radians = run(model("0.52359877559829887"), "LINEAR/EIGENSOL\n"),
                  degrees = run(model("30D"), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(degrees.status, 0) << degrees.err;
  EXPECT_THAT(degrees.err, Not(HasSubstr("[degrees-without-angle]")));
  const auto a = radians.eigenvalues(0), b = degrees.eigenvalues(0);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(std::abs(a[k] - b[k]), 0, 1e-9 * std::abs(a[k])) << k;
}

// One that stays in a plane does not twist: the last number of its sections is any.
TEST_F(FePartView, rows_of_a_beam_in_a_plane_have_a_number_without_influence) {
  const auto values = [&](const std::string& nodes) {
    const RunResult r = run(beam_model("MATERIAL/1, DENSITY=1, YOUNGS_MODULUS=1E7, POISSONS_RATIO=0.3\nFE_PART/2, "
                                       "TYPE=2DBEAMXY, MATERIAL=1, " +
                                       nodes + "\nMARKER/21, FE_PART=2, NODE_LABEL=1\nJOINT/1, FIXED, I=21, J=1\n"),
                            "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.err, Not(HasSubstr("no influence")));
    return r.eigenvalues(0);
  };
  EXPECT_EQ(values("COORDINATES=1,0,0,0,0,0,0, 2,1,0,0,0,0,0, SECTION=1,1E-4,1E-9,2E-9,0,0, 2,1E-4,1E-9,2E-9,0,0"),
            values("NODE_LABELS=1,2, X=0,1, AREA=1E-4, IYY=1E-9, IZZ=2E-9"));
}

// F L³/(3 E I) + 1.2 F L/(G A), drawn across its own axes, in millimetres; what is for the eye alone is passed over.
TEST_F(FePartView, a_cantilever_bends_under_its_tip_load) {
  const std::string dataset =
      "Cantilever\nUNITS/\n, FORCE = NEWTON\n, MASS = KILOGRAM\n, LENGTH = MILLIMETER\n, TIME = SECOND\n"
      "PART/1\n, GROUND\nMARKER/1\n, PART = 1\n, QP = 40, -300, 0\n, REULER = 90D, 0D, 0D\nMARKER/9\n, PART = 1\n"
      ", FLOATING\n"
      "SECTION/1\n, TYPE = Solid Rectangular\n, RECT_BASE = 20\n, RECT_HEIGHT = 10\n, IYY = 6666.666667\n"
      ", IZZ = 1666.666667\n, IYZ = 0\n, JXX = 4577\n, AREA = 200\n"
      "FE_PART/2\n, TYPE = 3DBEAM\n, NODE_LABELS = 1, 2, 3\n"
      ", COORDINATES = 1, 40, -300, 0, 1.5707963267948966, 0, 0, 2, 40, -50, 0\n"
      ", 1.5707963267948966, 0, 0, 3, 40, 200, 0, 1.5707963267948966, 0, 0\n, SECTION =\n"
      ", 1, 200, 6666.666667, 1666.666667, 0, 4577\n, 2, 200, 6666.666667, 1666.666667, 0, 4577\n"
      ", 3, 200, 6666.666667, 1666.666667, 0, 4577\n, MATERIAL = 1\n, CRATIOK = 0.01\n"
      "MATERIAL/1\n, NAME = steel\n, DENSITY = 7.801E-006\n, YOUNGS_MODULUS = 2.07E+005\n, POISSONS_RATIO = 0.29\n"
      "MARKER/7\n, FE_PART = 2\n, NODE_LABEL = 1\n, QP = 40, -300, 0\n, REULER = 90D, 0D, 0D\n"
      "MARKER/8\n, FE_PART = 2\n, NODE_LABEL = 3\n, QP = 40, 200, 0\n"
      "FE_NODE/1\n, FE_PART = 2\n, LABEL = 2\n, S = 0.5\n, ANGLE = 0\n, SECTION_NODE = 1\n, QG = 40, -50, 0\n"
      ", REULER = 90D, 0D, 0D\n"
      "JOINT/1\n, FIXED\n, I = 7\n, J = 1\nVFORCE/1\n, I = 8\n, JFLOAT = 9\n, RM = 1\n, FX = 0\\\n, FY = 0.2\\\n"
      ", FZ = 0.3\nEND\n";
  const RunResult r = run(dataset, "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("nothing here acts on SECTION, FE_NODE, which are"));
  EXPECT_THAT(r.err, Not(HasSubstr("[marker-off-node]")));
  const auto point = study_of(dataset).static_equilibrium();
  const double E = 2.07e5, L = 500, shear = 1.2 * L / (E / 2.58 * 200);
  const double softly = L * L * L / (3 * E * 1666.666667) + shear, stiffly = L * L * L / (3 * E * 6666.666667) + shear;
  const Triple at = point.marker(8).position;
  EXPECT_NEAR(at[0], 40 - 0.2 * softly, 1e-7);
  EXPECT_NEAR(at[1], 200, 1e-5);
  EXPECT_NEAR(at[2], 0.3 * stiffly, 1e-7);
}

// Wherever a node stands and however its section is turned: undeformed, places are those of the body coordinate system.
TEST_F(FePartView, places_of_markers_are_in_the_body_coordinate_system) {
  const Bow bow;
  std::string markers;
  for (const int label : bow.labels)
    markers +=
        fmt::format("MARKER/{}, FE_PART=2, NODE_LABEL={}, QP=0.3,-0.2,0.4, REULER=50D,60D,70D\n", 30 + label, label);
  const auto study = study_of(bow.model(bow.by_lists(),
                                        "MARKER/5, PART=1, RM=3, QP=0.3,-0.2,0.4, "
                                        "REULER=50D,60D,70D\n" +
                                            markers));
  const auto drawn = study.initial_conditions(), bent = study.static_equilibrium();
  for (const int label : bow.labels) {
    const auto marker = drawn.marker(30 + label), ground = drawn.marker(5);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(marker.position[k], ground.position[k], 1e-14) << label;
      for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(marker.axes[axis][k], ground.axes[axis][k], 1e-14);
    }
  }
  // The last node carries its marker as a rigid body would: at the same place in the axes of another marker of it.
  const auto seen = [](const auto& point) {
    const auto from = point.marker(22), to = point.marker(33);
    Triple p{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t k = 0; k < 3; ++k) p[axis] += from.axes[axis][k] * (to.position[k] - from.position[k]);
    }
    return p;
  };
  const Triple before = seen(drawn), after = seen(bent);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(before[k], after[k], 1e-12);
  EXPECT_GT(std::abs(bent.marker(33).position[2] - drawn.marker(33).position[2]), 1e-4);
  EXPECT_GT(std::abs(bent.marker(33).position[2] - bent.marker(34).position[2]), 1e-4);
}

TEST_F(FePartView, who_leaves_out_the_place_of_a_marker_is_told_where_its_node_is) {
  const auto err = [&](const std::string& marker) {
    const RunResult r = run(clamped_beam({.elements = 2, .length = 2.5}, marker + "\n"), "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err;
  };
  const std::string said = err("MARKER/5, FE_PART=2, NODE_LABEL=2");
  EXPECT_THAT(said, HasSubstr("MARKER/5 states no QP and is at the origin of FE_PART/2, 1.25 away from its node 2 at "
                              "(1.25, 0, 0) [marker-off-node]"));
  EXPECT_THAT(said, HasSubstr("QP=1.25, 0, 0 puts it at the node"));
  EXPECT_THAT(err("MARKER/5, FE_PART=2, NODE_LABEL=2, REULER=1,0,0"), HasSubstr("[marker-off-node]"));
  for (const std::string marker :
       {"MARKER/5, FE_PART=2, NODE_LABEL=1", "MARKER/5, FE_PART=2, NODE_LABEL=3, QP=0,0,0",
        "MARKER/5, FE_PART=2, NODE_LABEL=3, RM=22", "MARKER/5, FE_PART=2, NODE_LABEL=3, FLOATING"})
    EXPECT_THAT(err(marker), Not(HasSubstr("[marker-off-node]"))) << marker;
}

// A row in a command takes the place of what was stated in either form; a list does not go with rows.
TEST_F(FePartView, commands_state_rows_anew) {
  const Bow bow;
  const std::string end = "\nLINEAR/EIGENSOL\n";
  Bow wider = bow;
  for (Row& section : wider.sections) section[0] *= 1.5;
  const std::string rows = "FE_PART/2, COORDINATES=" + bow.rows(bow.places, {0, 1, 2, 3}) +
                           "\n, SECTION=" + wider.rows(wider.sections, {0, 1, 2, 3}) + ", CRATIOK=2E-4";
  std::string stated = wider.model(wider.by_rows(true, {0, 1, 2, 3}));
  stated.replace(stated.find("CRATIOK = 1E-4"), 14, "CRATIOK = 2E-4");
  const RunResult expected = run(stated, "LINEAR/EIGENSOL\n");
  for (const std::string& before : {bow.by_lists(), bow.by_rows(true, {0, 1, 2, 3})}) {
    const RunResult r = run(bow.model(before), rows + end);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(r.json.at("results").back().at("eigenvalues"), expected.json.at("results").back().at("eigenvalues"));
  }
  const RunResult mixed = run(bow.model(bow.by_rows(true, {0, 1, 2, 3})), "FE_PART/2, X=0,1,2,3" + end);
  EXPECT_EQ(mixed.status, 1);
  EXPECT_THAT(mixed.err, HasSubstr("COORDINATES and X of FE_PART/2 state the same"));
}

}  // namespace dynalin::cases::fe_part_view_test
