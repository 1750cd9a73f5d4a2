#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "elements/graphics/drawn_model_test_support.h"

namespace dynalin::graphics_test {
namespace {

using ::testing::HasSubstr;
constexpr double pi = std::numbers::pi;

double polygon_area(double n) { return n / 2 * std::sin(2 * pi / n); }

// Least and greatest coordinates in global axes, as drawn.
struct Extent {
  Vector low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
};
Extent extent_of(const DrawnModel& m, const Shape& s) {
  Extent e;
  const auto poses = drawn_poses(*m.model);
  for (Mesh::Index v = 0; v < s.mesh.vertices.size(); ++v) {
    const Vector p = s.global(v, poses);
    for (std::size_t k = 0; k < 3; ++k) e.low[k] = std::min(e.low[k], p[k]), e.high[k] = std::max(e.high[k], p[k]);
  }
  return e;
}
void expect_near(const Vector& a, const Vector& b) {
  EXPECT_NEAR(norm(a - b), 0, 1e-12) << a.x << " " << a.y << " " << a.z;
}

// PART/2 has x along global y and y against global x; MARKER/21 has z along x of the part and x along its y.
TEST(Graphics, boxes_stand_in_the_axes_of_their_marker) {
  DrawnModel m = sound_model_of("GRAPHICS/7, BOX, CORNER=21, X=1, Y=-2, Z=5");
  const Shape s = m.shape();
  EXPECT_EQ(s.label.text(), "GRAPHICS/7");
  EXPECT_EQ(m.model->body(s.body).label.text(), "PART/2");
  expect_closed(s.mesh, 2);
  EXPECT_NEAR(volume_of(s.mesh), 10, 1e-12);
  // The corner at (10 − 2, 1, 3); x is −x, y is z and z is y of ground.
  const Extent e = extent_of(m, s);
  expect_near(e.low, {7, 1, 1}), expect_near(e.high, {8, 6, 3});
}

TEST(Graphics, round_solids_have_their_size_and_place) {
  DrawnModel m = sound_model_of(
      "GRAPHICS/1, CYLINDER, CM=21, LENGTH=4, RADIUS=0.5, SEG=16, SIDES=9\n"
      "GRAPHICS/2, CYLINDER, CM=30, LENGTH=-4, RADIUS=0.5, SEG=16, RANGLE=90D\n"
      "GRAPHICS/3, FRUSTUM, CM=30, LENGTH=3, TOP=0, BOTTOM=2, SEG=8\n"
      "GRAPHICS/4, ELLIPSOID, CM=1, XSCALE=2, YSCALE=4, ZSCALE=6\n"
      "GRAPHICS/5, TORUS, CM=30, MAJOR_RADIUS=5, MINOR_RADIUS=1, SEG=16\n"
      "GRAPHICS/6, TORUS, CM=30, RMAJ=5, RMIN=1, RANGLE=180D, SEG=8\n");
  const auto s = m.shapes();
  ASSERT_EQ(s.size(), 6u);
  for (const Shape& shape : s) expect_closed(shape.mesh, shape.label.id == 5 ? 0 : 2), expect_plane(shape.mesh);
  EXPECT_NEAR(volume_of(s[0].mesh), polygon_area(16) / 4 * 4, 1e-12);
  const Extent e = extent_of(m, s[0]);
  expect_near(e.low, {7.5, 1, 2.5}), expect_near(e.high, {8.5, 5, 3.5});
  EXPECT_NEAR(volume_of(s[1].mesh), 8 * std::sin(pi / 32) * 4 * 0.25, 1e-12) << "16 pieces of a quarter of a turn";
  expect_near(extent_of(m, s[1]).low, {0, 20, -4});
  EXPECT_NEAR(volume_of(s[2].mesh), polygon_area(8) * 4, 1e-12);
  for (const Vector& p : s[2].mesh.vertices) EXPECT_TRUE(p.z == 0 || std::hypot(p.x, p.y) == 0) << "wide at its marker";
  expect_near(extent_of(m, s[3]).low, {-1, -2, -3});
  EXPECT_EQ(s[3].body, ground_body);
  EXPECT_NEAR(volume_of(s[4].mesh), 2 * polygon_area(16) * 5 * polygon_area(8), 1e-10);
  EXPECT_NEAR(volume_of(s[5].mesh), 8 * std::sin(pi / 8) * 5 * polygon_area(4), 1e-10);
}

TEST(Graphics, lines_planes_and_points_are_where_they_are_stated) {
  DrawnModel m = sound_model_of(
      "GRAPHICS/1, CIRCLE, CM=30, RADIUS=2\nGRAPHICS/2, ARC, CM=30, RADIUS=2, RANGLE=-90D, SEG=3\n"
      "GRAPHICS/3, PLANE, RM=31, XMIN=-1, XMAX=2, YMIN=0, YMAX=5\nGRAPHICS/4, POINT, RM=21\n");
  const auto s = m.shapes();
  ASSERT_EQ(s.size(), 4u);
  for (const Shape& shape : s) expect_sound(shape.mesh);
  EXPECT_EQ(s[0].mesh.segments.size(), 20u);
  EXPECT_EQ(s[1].mesh.segments.size(), 3u);
  expect_near(extent_of(m, s[1]).low, {0, 18, 0}), expect_near(extent_of(m, s[1]).high, {2, 20, 0});
  expect_near(extent_of(m, s[2]).low, {-1, 20, 4}), expect_near(extent_of(m, s[2]).high, {2, 25, 4});
  const auto corners = corners_of(s[2].mesh, s[2].mesh.quads.at(0));
  EXPECT_GT(cross(corners[1] - corners[0], corners[2] - corners[1]).z, 0) << "it is seen from z";
  EXPECT_EQ(s[3].mesh.points.size(), 1u);
  expect_near(extent_of(m, s[3]).low, {8, 1, 3});
}

TEST(Graphics, an_outline_goes_from_body_to_body) {
  DrawnModel m = sound_model_of("GRAPHICS/1, OUTLINE=20, 30, 31, 1\nGRAPHICS/2, OUTLINE = 30,31\n");
  const auto s = m.shapes();
  ASSERT_EQ(s.size(), 2u);
  auto poses = drawn_poses(*m.model);
  poses[1].r = {7, 8, 9};
  ASSERT_EQ(s[0].vertex_bodies.size(), 4u);
  EXPECT_EQ(s[0].mesh.segments.size(), 3u);
  expect_near(s[0].global(0, poses), {7, 8, 9});
  expect_near(s[0].global(2, poses), {0, 20, 4});
  expect_near(s[0].global(3, poses), {0, 0, 0});
  EXPECT_TRUE(s[1].vertex_bodies.empty());
  EXPECT_EQ(m.model->body(s[1].body).label.text(), "PART/3");
}

const std::string square =
    "MATRIX/1, FULL=RORDER, ROWS=5, COLUMNS=3, VALUES=1,0,0, 3,0,0, 3,0,2, 1,0,2, 1,0,0\nCURVE/1, CLOSED, MATRIX=1, "
    "ORDER=2\n"
    "MATRIX/2, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=0,0,0, 2,0,0, 2,0,1, 0,0,1\nCURVE/2, OPEN, MATRIX=2, ORDER=2\n"
    "MATRIX/3, FULL=RORDER, ROWS=5, COLUMNS=3, VALUES=0,0,0, 2,0,0, 2,3,0, 0,3,0, 0,0,0\nCURVE/3, CLOSED, MATRIX=3, "
    "ORDER=2\n";
DrawnModel with_curves(const std::string& lines) {
  DrawnModel m = model_of(square + lines);
  EXPECT_FALSE(m.diagnostics.has_errors()) << render(m.diagnostics);
  return m;
}

TEST(Graphics, curves_keep_the_corners_of_polygons_and_close) {
  DrawnModel m = with_curves("GRAPHICS/1, CURVE, CID=1, CRM=31\nGRAPHICS/2, CURVE, CID=2, CRM=31, SEG=6\n");
  const auto s = m.shapes();
  ASSERT_EQ(s.size(), 2u);
  for (const Shape& shape : s) expect_sound(shape.mesh);
  const auto length = [](const Mesh& mesh) {
    double sum = 0;
    for (const auto& e : mesh.segments) sum += norm(mesh.vertices[e[0]] - mesh.vertices[e[1]]);
    return sum;
  };
  EXPECT_NEAR(length(s[0].mesh), 8, 1e-12);
  EXPECT_EQ(s[0].mesh.segments.size(), s[0].mesh.vertices.size());
  EXPECT_GE(s[0].mesh.segments.size(), 20u);
  EXPECT_EQ(s[1].mesh.segments.size(), 6u);
  EXPECT_NEAR(length(s[1].mesh), 5, 1e-12);
  expect_near(extent_of(m, s[0]).low, {1, 20, 4}), expect_near(extent_of(m, s[0]).high, {3, 20, 6});
}

TEST(Graphics, curves_sweep_solids_and_sheets) {
  DrawnModel m = with_curves(
      "GRAPHICS/1, REVOLUTION, CID=1, CRM=30, SEG=12\nGRAPHICS/2, REVOLUTION, CID=1, CRM=30, RANGLE=90D, SEG=4\n"
      "GRAPHICS/3, REVOLUTION, CID=2, CRM=30, SEG=12\nGRAPHICS/4, EXTRUSION, CID=3, CRM=30, LENGTH=-4\n"
      "GRAPHICS/5, EXTRUSION, CID=2, CRM=30, LENGTH=4\n");
  const auto s = m.shapes();
  ASSERT_EQ(s.size(), 5u) << render(m.remarks);
  expect_closed(s[0].mesh, 0);
  EXPECT_EQ(s[0].mesh.quads.size(), 48u) << "a side of the square for each of its corners, no more";
  EXPECT_NEAR(volume_of(s[0].mesh), 2 * polygon_area(12) * 2 * 4, 1e-11);
  expect_closed(s[1].mesh, 2);
  EXPECT_NEAR(volume_of(s[1].mesh), 4 * std::sin(pi / 8) * 2 * 4, 1e-11);
  expect_closed(s[2].mesh, 2);
  EXPECT_NEAR(volume_of(s[2].mesh), polygon_area(12) * 4, 1e-11);
  expect_closed(s[3].mesh, 2);
  EXPECT_NEAR(volume_of(s[3].mesh), 24, 1e-12);
  expect_near(extent_of(m, s[3]).low, {0, 20, -4});
  EXPECT_FALSE(s[4].mesh.closed);
  // Of the open profile two sides are across z; the one along z sweeps nothing.
  EXPECT_EQ(s[4].mesh.quads.size(), 2u);
  expect_sound(s[4].mesh);
}

TEST(Graphics, plates_lie_in_the_plane_of_their_corners) {
  DrawnModel m = sound_model_of(
      "MARKER/22, QP=0,4,4, PART=3\nMARKER/23, QP=3,4,4, PART=3\nMARKER/24, QP=3,0,4, PART=3\n"
      "GRAPHICS/1, PLATE, MARKERS=31,22,23,24, THICKNESS=0.5, RADIUS=1, SEG=16\n"
      "GRAPHICS/2, PLATE, MARKERS=30,23,31, THICKNESS=0.5\n");
  const auto s = m.shapes();
  ASSERT_EQ(s.size(), 2u) << render(m.remarks);
  expect_closed(s[0].mesh, 2);
  EXPECT_NEAR(volume_of(s[0].mesh), (12 + 14 + polygon_area(16)) * 0.5, 1e-11);
  expect_near(extent_of(m, s[0]).low, {-1, 19, 3.75}), expect_near(extent_of(m, s[0]).high, {4, 25, 4.25});
  expect_closed(s[1].mesh, 2);
  EXPECT_NEAR(volume_of(s[1].mesh), 0.5 * 4 * 5 * 0.5, 1e-11);
}

TEST(Graphics, links_go_from_marker_to_marker_on_the_body_of_the_first) {
  DrawnModel m = sound_model_of("GRAPHICS/1, LINK, I=1, J=30, WIDTH=2, DEPTH=1, SEG=8\n");
  const Shape s = m.shape();
  EXPECT_EQ(s.body, ground_body);
  expect_closed(s.mesh, 2);
  EXPECT_NEAR(volume_of(s.mesh), 20 * 2 + polygon_area(8), 1e-11);
  expect_near(extent_of(m, s).low, {-1, -1, -0.5}), expect_near(extent_of(m, s).high, {1, 21, 0.5});
}

TEST(Graphics, springs_are_as_long_as_their_markers_are_apart) {
  DrawnModel m = sound_model_of("GRAPHICS/1, SPDP, I=30, J=20, COILS=5, DA=1, DB=0.5, LC=2, LA=1, LB=1\n");
  auto poses = drawn_poses(*m.model);
  for (const double shift : {0.0, 6.0}) {
    poses[1].r = {10 + shift, 20, 0};
    poses[1].R = rotation_exponential({0.3, shift, 1});
    const auto s = m.shapes(poses);
    ASSERT_EQ(s.size(), 2u);
    EXPECT_EQ(m.model->body(s[0].body).label.text(), "PART/3");
    EXPECT_EQ(m.model->body(s[1].body).label.text(), "PART/2");
    double least = 1e9, most = -1e9, beside = 0;
    for (const Shape& half : s) {
      expect_sound(half.mesh);
      EXPECT_EQ(half.origin, Shape::Origin::spring_damper);
      for (Mesh::Index v = 0; v < half.mesh.vertices.size(); ++v) {
        const Vector p = half.global(v, poses);
        least = std::min(least, p.x), most = std::max(most, p.x), beside = std::max(beside, std::abs(p.y - 20));
      }
    }
    EXPECT_NEAR(least, 0, 1e-12);
    EXPECT_NEAR(most, 10 + shift, 1e-12);
    EXPECT_NEAR(beside, 0.5, 0.05);
  }
  EXPECT_TRUE(m.shapes(ShapeChoice{.spring_dampers = false}).empty());
}

TEST(Graphics, what_has_no_extent_is_left_out_with_a_remark) {
  DrawnModel m = sound_model_of(
      "MARKER/22, PART=3\nMARKER/23, QP=0,0,9, PART=3\nGRAPHICS/1, SPDP, I=30, J=22, COILS=3, DA=1\nGRAPHICS/2, LINK, "
      "I=30, J=22, WIDTH=1, DEPTH=1\nGRAPHICS/3, PLATE, MARKERS=30,31,23, THICKNESS=1\nGRAPHICS/4, OUTLINE=30,22\n"
      "GRAPHICS/5, FORCE, ETYPE=SFORCE, EID=7, EMARKER=39\n");
  EXPECT_TRUE(m.shapes().empty());
  ASSERT_EQ(m.remarks.items().size(), 4u) << render(m.remarks);
  for (const Diagnostic& d : m.remarks.items()) {
    EXPECT_EQ(d.code, "undrawn-shape");
    EXPECT_EQ(d.severity, Severity::warning);
    EXPECT_TRUE(d.at.source);
  }
}

TEST(Graphics, types_and_arguments_are_abbreviated_as_ever) {
  DrawnModel m = sound_model_of(
      "gra/1, cylind, cm=30, len=5, r=4, seg=20, sides=10\nGRA/2, PL, RM=30, XMI=0, XMA=1, YMI=0, YMA=1\n"
      "GRA/3, EX, RM=30, FILE=a.xmt_txt, EL=SHELL_10, FACETING_TOLERANCE=300\nGRA/4, O=30,31\nGRA/5, PLAT, "
      "MARK=1,1,1, TH=1\nGRAPHICS/7, B, CORNER=30, X=1, Y=1, Z=1\nGRAPHICS/6, BOX, COR=30, X=1, Y=1, Z=1, COLOR=red\n");
  const auto s = m.shapes();
  EXPECT_EQ(s.size(), 5u) << render(m.remarks);
  EXPECT_TRUE(m.model->settings.passed_over.empty());
}

TEST(Graphics, arguments_of_other_types_are_passed_over) {
  DrawnModel m = sound_model_of(
      "GRAPHICS/1, BOX, CORNER=30, X=1, Y=1, Z=1, SEG=20, RM=30\nGRAPHICS/2, BOX, CORNER=30, "
      "X=1, Y=1, Z=1, SEG=7\n");
  EXPECT_EQ(m.shapes().size(), 2u);
  EXPECT_THAT(m.model->settings.passed_over, ::testing::UnorderedElementsAre("GRAPHICS/SEG", "GRAPHICS/RM"));
}

struct Wrong {
  const char* statement;
  const char* problem;  // code and column
};
void PrintTo(const Wrong& w, std::ostream* out) { *out << w.statement; }
class WrongGraphics : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongGraphics, is_an_error_at_its_place) {
  const DrawnModel m = model_of(std::string("CURVE/1, CLOSED, MATRIX=1\nMATRIX/1, FULL=RORDER, ROWS=5, COLUMNS=3, "
                                            "VALUES=1,0,0, 0,1,0, -1,0,0, 0,-1,0, 1,0,0\n") +
                                GetParam().statement);
  std::string problems;
  for (const Diagnostic& d : m.diagnostics.items()) {
    const auto place = d.at.source->place(d.at.offset);
    EXPECT_EQ(place.line, 14u);
    EXPECT_EQ(d.severity, Severity::error);
    problems += (problems.empty() ? "" : ", ") + std::string(d.code) + " " + std::to_string(place.column);
  }
  EXPECT_EQ(problems, GetParam().problem) << GetParam().statement << "\n" << render(m.diagnostics);
}
INSTANTIATE_TEST_SUITE_P(
    table, WrongGraphics,
    ::testing::Values(
        Wrong{"GRAPHICS/1, BOX, CORNER=99, X=1, Y=1, Z=1", "unknown-marker 25"},
        Wrong{"GRAPHICS/1, BOX, CORNER=20, X=1, Y=0, Z=0", "value-out-of-range 34, value-out-of-range 39"},
        Wrong{"GRAPHICS/1, BOX, CORNER=20, X=1, Y=1", "missing-argument 1"},
        Wrong{"GRAPHICS/1, BOX, CORNER=39, X=1, Y=1, Z=1", "floating-marker 1"},
        Wrong{"GRAPHICS/1, CYLINDER, CM=20, LENGTH=1, RADIUS=0", "value-out-of-range 40"},
        Wrong{"GRAPHICS/1, CYLINDER, CM=20, LENGTH=1, RADIUS=-1", "value-out-of-range 40"},
        Wrong{"GRAPHICS/1, CYLINDER, CM=20, LENGTH=0, RADIUS=1", "value-out-of-range 30"},
        Wrong{"GRAPHICS/1, CYLINDER, CM=20, LENGTH=1, RADIUS=x", "expected-number 47"},
        Wrong{"GRAPHICS/1, CYLINDER, CM=20, LENGTH=1, RADIUS=1, RANGLE=361D", "value-out-of-range 50"},
        Wrong{"GRAPHICS/1, CYLINDER, CM=20, LENGTH=1, RADIUS=1, SEG=0", "value-out-of-range 54"},
        Wrong{"GRAPHICS/1, CYLINDER, CM=20, LENGTH=1, S=1", "ambiguous-argument 40, missing-argument 1"},
        Wrong{"GRAPHICS/1, FRUSTUM, CM=20, LENGTH=1, TOP=0, BOTTOM=0", "value-out-of-range 39"},
        Wrong{"GRAPHICS/1, FRUSTUM, CM=20, LENGTH=1, TOP=-1, BOTTOM=0", "value-out-of-range 43"},
        Wrong{"GRAPHICS/1, ELLIPSOID, CM=20, XSCALE=1, YSCALE=-1, ZSCALE=1", "value-out-of-range 41"},
        Wrong{"GRAPHICS/1, TORUS, CM=20, MAJOR_RADIUS=1, MINOR_RADIUS=1", "value-out-of-range 43"},
        Wrong{"GRAPHICS/1, TORUS, CM=20, RMAJOR=1", "missing-argument 1"},
        Wrong{"GRAPHICS/1, TORUS, CM=20, RMAJOR=1, MAJOR_RADIUS=2, RMINOR=0.1", "excluded-arguments 27"},
        Wrong{"GRAPHICS/1, CIRCLE, CM=20, RADIUS=0", "value-out-of-range 28"},
        Wrong{"GRAPHICS/1, ARC, CM=20, RADIUS=1, RANGLE=0", "value-out-of-range 35"},
        Wrong{"GRAPHICS/1, OUTLINE=20, 98, 99", "unknown-marker 25, unknown-marker 29"},
        Wrong{"GRAPHICS/1, OUTLINE=20", "wrong-count 13"}, Wrong{"GRAPHICS/1, OUTLINE=20, 0.5", "expected-integer 25"},
        Wrong{"GRAPHICS/1, CURVE, CID=9, CRM=20", "unknown-element 24"},
        Wrong{"GRAPHICS/1, PLANE, RM=20, XMIN=1, XMAX=0, YMIN=0, YMAX=1", "value-out-of-range 35"},
        Wrong{"GRAPHICS/1, PLATE, MARKERS=20,21, THICKNESS=1", "wrong-count 20"},
        Wrong{"GRAPHICS/1, PLATE, MARKERS=20,21,30, THICKNESS=1", "foreign-marker 1"},
        Wrong{"GRAPHICS/1, PLATE, MARKERS=20,21,20, THICKNESS=0", "value-out-of-range 38"},
        Wrong{"GRAPHICS/1, LINK, I=20, J=21, WIDTH=0, DEPTH=1", "value-out-of-range 31"},
        Wrong{"GRAPHICS/1, EXTRUSION, CID=1, CRM=20, LENGTH=0", "value-out-of-range 39"},
        Wrong{"GRAPHICS/1, EXTERNAL, RM=20, ELEMENT=A", "missing-argument 1"},
        Wrong{"GRAPHICS/1, SPDP, I=20, J=30, COILS=-1", "value-out-of-range 37"},
        Wrong{"GRAPHICS/1, FORCE, EMARKER=99", "unknown-marker 28"},
        Wrong{"GRAPHICS/1, BOX, SPDP, I=20, J=30", "duplicate-variant 18"},
        Wrong{"GRAPHICS/1, BALL, CM=20", "unknown-argument 13"}, Wrong{"GRAPHICS/1, CM=20", "missing-variant 1"},
        Wrong{"GRAPHICS/1, BOX=3", "unexpected-value 13"}));

class ExternalGraphics : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("dynalin_graphics_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  DrawnModel drawn(const std::string& line) const {
    DrawnModel m = model_of(line, (folder_ / "model.adm").string());
    EXPECT_TRUE(m.diagnostics.items().empty()) << render(m.diagnostics);
    return m;
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::filesystem::path folder_;
};

TEST_F(ExternalGraphics, comes_out_of_the_file_beside_the_dataset) {
  write("corner.obj",
        "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\no corner\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\no lid\nf 1 2 3\n");
  DrawnModel m = drawn("GRAPHICS/1, EXTERNAL, RM=31, FILE=corner.obj, ELEMENT=corner");
  const Shape s = m.shape();
  EXPECT_TRUE(m.remarks.items().empty()) << render(m.remarks);
  EXPECT_EQ(s.origin, Shape::Origin::file);
  expect_closed(s.mesh, 2);
  EXPECT_NEAR(volume_of(s.mesh), 8.0 / 6, 1e-12);
  expect_near(extent_of(m, s).low, {0, 20, 4});
}

TEST_F(ExternalGraphics, say_when_a_file_of_several_parts_has_none_of_the_name) {
  write("two.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\no corner\nf 1 3 2\nf 1 2 4\no lid\nf 1 2 3\n");
  DrawnModel m = drawn("GRAPHICS/1, EXTERNAL, RM=31, FILE=two.obj, ELEMENT=Lid");
  EXPECT_EQ(m.shape().mesh.triangles.size(), 3u);
  ASSERT_EQ(m.remarks.items().size(), 1u) << render(m.remarks);
  EXPECT_EQ(m.remarks.items().front().code, "geometry-part");
  EXPECT_THAT(m.remarks.items().front().message, HasSubstr("which has no part Lid"));
  EXPECT_THAT(m.remarks.items().front().hint, HasSubstr("corner, lid"));
  // Names of the only part are what a program calls it.
  write("one.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\no Unnamed\nf 1 3 2\n");
  DrawnModel one = drawn("GRAPHICS/1, EXTERNAL, RM=31, FILE=one.obj, ELEMENT=SHELL_1");
  EXPECT_EQ(one.shape().mesh.triangles.size(), 1u);
  EXPECT_TRUE(one.remarks.items().empty()) << render(one.remarks);
}

TEST_F(ExternalGraphics, that_cannot_be_read_is_remarked_where_the_file_is_named) {
  write("bad.stl", "solid\nvertex 1 2\n");
  write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n");
  struct {
    const char *file, *code, *text;
  } const cases[] = {{"gone.stl", "geometry-file", "gone.stl cannot be read"},
                     {"bad.stl", "geometry-file", "line 2: a vertex needs three numbers"},
                     {"part.xmt_txt", "geometry-format", "part.xmt_txt has a format that is not read"},
                     {"flat.obj", "undrawn-shape", "1 polygons"}};
  for (const auto& c : cases) {
    DrawnModel m = drawn(std::string("GRAPHICS/1, EXTERNAL, RM=31, FILE=") + c.file);
    EXPECT_EQ(m.shapes().size(), c.file == std::string("flat.obj") ? 1u : 0u);
    ASSERT_EQ(m.remarks.items().size(), 1u) << c.file;
    const Diagnostic& d = m.remarks.items().front();
    EXPECT_EQ(d.code, c.code);
    EXPECT_THAT(d.message, HasSubstr(c.text));
    EXPECT_EQ(d.at.source->place(d.at.offset).column, 30u);
    EXPECT_TRUE(m.shapes(ShapeChoice{.files = false}).empty());
    EXPECT_TRUE(m.remarks.items().empty()) << "a file that nobody wants is not looked at";
  }
}

}  // namespace
}  // namespace dynalin::graphics_test
