// Every type of GRAPHICS in one dataset: it is read without a word, drawn, and changes no eigenvalue.
#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "cases/run.h"
#include "elements/catalogue.h"
#include "geometry/shape_source.h"
#include "model/model.h"
#include "nastran_reader/solve.h"

namespace dynalin::cases::graphics_test {
namespace {

const std::string mechanism =
    "Crane\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1, PART=1\nMARKER/2, PART=1, QP=1,0,0\n"
    "PART/2, QG=0,-1,0, MASS=2, CM=20, IP=1,1,1\nMARKER/20, PART=2\nMARKER/21, PART=2, QP=0,1,0\nMARKER/22, PART=2, "
    "QP=1,0,0\nJOINT/1, REVOLUTE, I=21, J=1\n"
    "SPRINGDAMPER/1, TRANSLATIONAL, I=22, J=2, K=20, C=0.3, LENGTH=1\n";
const std::string pictures =
    "MATRIX/1, FULL=RORDER, ROWS=6, COLUMNS=3\n, VALUES=1,0,0, 2,0,0.2, 2,0,1, 1.4,0,1.5, 1,0,1, 1,0,0\n"
    "CURVE/1, CLOSED, MATRIX=1, CURVE_POINTS\n"
    "GRAPHICS/1, BOX, CORNER=20, X=0.2, Y=-0.1, Z=0.5\nGRAPHICS/2, CYLINDER, CM=20, LENGTH=0.5, RADIUS=0.04, SEG=20, "
    "SIDES=10\n"
    "GRAPHICS/3, FRUSTUM, CM=20, LENGTH=1, TOP=0.1, BOTTOM=0.2, RANGLE=90D\nGRAPHICS/4, CIRCLE, CM=1, RADIUS=3\n"
    "GRAPHICS/5, ARC, CM=1, RADIUS=3, RANGLE=45D, SEG=4\nGRAPHICS/6, ELLIPSOID, CM=20, XSCALE=1, YSCALE=1, ZSCALE=1\n"
    "GRAPHICS/7, TORUS, CM=20, RMAJOR=1, RMINOR=0.1\nGRAPHICS/8, OUTLINE=1,20,2\nGRAPHICS/9, CURVE, CID=1, CRM=20\n"
    "GRAPHICS/10, PLANE, RM=1, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1\nGRAPHICS/11, POINT, RM=20\n"
    "GRAPHICS/12, EXTERNAL, RM=20, FILE=lid.stl, ELEMENT=SHELL_10, FACETING_TOLERANCE=300\n"
    "GRAPHICS/13, SPDP, I=22, J=2, COILS=10, DA=0.1, DB=0.04, DC=0.05, LA=0.1, LB=0.1, LC=0.3, LD=0.3\n"
    "GRAPHICS/14, FORCE, ETYPE=SPRINGDAMPER, EID=1, EMARKER=22\nGRAPHICS/15, PLATE, MARKERS=20,21,22, THICKNESS=0.1, "
    "RADIUS=0.1\n"
    "GRAPHICS/16, LINK, I=21, J=20, WIDTH=0.2, DEPTH=0.1\nGRAPHICS/17, EXTRUSION, CID=1, CRM=20, LENGTH=0.5\n"
    "GRAPHICS/18, REVOLUTION, CID=1, CRM=20, RANGLE=180D\n";

class Graphics : public Cases {
 protected:
  void SetUp() override {
    Cases::SetUp();
    write("lid.stl",
          "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
          "endsolid\n");
  }
};

TEST_F(Graphics, of_every_type_pass_the_check) {
  write("model.adm", mechanism + pictures + "END\n");
  SessionOptions options;
  options.file = (folder_ / "model.adm").string();
  std::ostringstream out, err;
  EXPECT_EQ(check_file(options, out, err), 0) << err.str();
  EXPECT_EQ(err.str(), "");
}

TEST_F(Graphics, of_every_type_are_drawn) {
  auto dataset = parse_dataset(
      std::make_shared<const SourceText>((folder_ / "model.adm").string(), mechanism + pictures + "END\n"));
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  ASSERT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  Diagnostics remarks;
  std::set<std::int64_t> seen;
  std::size_t solids = 0;
  for (const Shape& shape : shapes_of(*model.value, drawn_poses(*model.value), remarks)) {
    seen.insert(shape.label.id);
    EXPECT_FALSE(shape.mesh.vertices.empty());
    solids += shape.mesh.closed;
  }
  EXPECT_TRUE(remarks.items().empty()) << render(remarks);
  for (std::int64_t id = 1; id <= 18; ++id) EXPECT_EQ(seen.contains(id), id != 14) << id;
  EXPECT_EQ(solids, 9u) << "1, 2, 3, 6, 7 and 15 to 18";
}

TEST_F(Graphics, change_no_eigenvalue) {
  const RunResult with = run(mechanism + pictures + "END\n", "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(with.status, 0) << with.err;
  const RunResult without = run(mechanism + "END\n", "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(without.status, 0) << without.err;
  EXPECT_EQ(with.result(1).at("eigenvalues"), without.result(1).at("eigenvalues"));
}

class ExportedGraphics : public Graphics, public ::testing::WithParamInterface<const char*> {};

// The deck is legal and has the eigenvalues of the mechanism, whatever its shapes are made of.
TEST_P(ExportedGraphics, leave_the_eigenvalues_of_the_deck_alone) {
  write("export.cfg", GetParam());
  const RunResult r = run(mechanism + pictures + "END\n",
                          "SIMULATE/STATICS\nLINEAR/EIGENSOL\nLINEAR/EXPORT, TYPE=OPENBOX, FILE=deck.dat, "
                          "CONFIG=export.cfg\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, ::testing::Not(::testing::HasSubstr("GRAPHICS")));
  std::string path;
  for (const auto& file : r.result(2).at("files")) {
    if (file.get<std::string>().find("_") == std::string::npos || path.empty()) path = file.get<std::string>();
  }
  const auto deck = nastran_reader::prepare(path, nastran_reader::Purpose::check);
  EXPECT_FALSE(deck.diagnostics.has_errors()) << render(deck.diagnostics);
  const auto modes = nastran_reader::solve_modes(path);
  ASSERT_TRUE(modes) << modes.error();
  const auto expected = r.eigenvalues(1);
  ASSERT_EQ(modes->eigenvalues.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const auto wanted = expected[k] * 2.0 * std::numbers::pi;
    const auto near = std::any_of(modes->eigenvalues.begin(), modes->eigenvalues.end(), [&](const auto& value) {
      return std::abs(value - wanted) < 1e-7 * std::abs(wanted);
    });
    EXPECT_TRUE(near) << wanted << " " << modes->eigenvalues.front();
  }
}
INSTANTIATE_TEST_SUITE_P(styles, ExportedGraphics,
                         ::testing::Values("", "use_plotel = yes\n", "use_wireframe = yes\n", "file_name_style = B\n",
                                           "file_name_style = C\n", "use_adams_ids = no\nuse_includes = no\n",
                                           "use_long_format = no\nexport_spdp = no\nexport_external = no\n",
                                           "export_graphics = no\n"));

TEST_F(Graphics, of_an_export_that_cannot_be_drawn_are_remarked) {
  const RunResult r = run(mechanism + "GRAPHICS/1, EXTERNAL, RM=20, FILE=lid.x_t\nEND\n",
                          "SIMULATE/STATICS\nLINEAR/EXPORT, TYPE=OPENBOX, FILE=deck\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err,
              ::testing::HasSubstr("model.adm:13:30: warning: GRAPHICS/1 is not drawn: lid.x_t has a format that "
                                   "is not read [geometry-format]"));
}

}  // namespace
}  // namespace dynalin::cases::graphics_test
