#include "nastran/graphics.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "elements/graphics/drawn_model_test_support.h"

namespace dynalin::nastran::graphics_test {
namespace {

using ::testing::ElementsAre;

constexpr std::int64_t ground = -1;

// A deck with the bodies of the model: grids 2 and 3 of PART/2 and PART/3.
struct Drawn {
  DrawnModel of;
  Ids ids;
  Deck deck;
  Diagnostics remarks;
};
Drawn drawn(const std::string& lines, const ExportOptions& options = {}) {
  Drawn d{sound_model_of(lines), {}, {}, {}};
  for (const std::int64_t id : {1, 2, 3}) d.ids.take(IdSpace::point, id);
  d.ids.take(IdSpace::element, 1), d.ids.take(IdSpace::property, 1);
  d.deck.bodies = {{"PART/2", 2}, {"PART/3", 3}};
  add_graphics(*d.of.model, drawn_poses(*d.of.model), options, d.ids, d.deck, d.remarks);
  return d;
}

double area_of(const std::vector<Vector>& at) {
  Vector sum;
  for (std::size_t k = 1; k + 1 < at.size(); ++k) sum += cross(at[k] - at[0], at[k + 1] - at[0]);
  return 0.5 * norm(sum);
}

// What every deck with shapes must keep to.
void expect_legal(const Deck& deck) {
  std::map<std::int64_t, Vector> at;
  std::set<std::int64_t> held, elements{1}, properties{1}, materials;
  for (const Grid& g : deck.shape_grids) {
    EXPECT_TRUE(at.emplace(g.id, g.position).second) << g.id;
    EXPECT_GT(g.id, 3);
    if (!g.fixed.empty()) {
      EXPECT_EQ(g.fixed, "123456");
      EXPECT_EQ(g.body, ground);
      held.insert(g.id);
    }
  }
  for (const RigidElement& tie : deck.shape_ties) {
    EXPECT_TRUE(elements.insert(tie.id).second);
    ASSERT_GE(tie.body, 0);
    EXPECT_EQ(tie.independent, deck.bodies.at(static_cast<std::size_t>(tie.body)).grid);
    for (const std::int64_t g : tie.dependent) {
      EXPECT_TRUE(at.contains(g));
      EXPECT_TRUE(held.insert(g).second) << g << " is held twice";
    }
  }
  EXPECT_EQ(held.size(), at.size()) << "every grid is tied or fixed";
  for (const ShapeProperty& p : deck.shape_properties) {
    EXPECT_TRUE(properties.insert(p.id).second);
    EXPECT_TRUE(materials.insert(p.material).second);
    EXPECT_GT(p.thickness, 0);
  }
  for (const Shell& s : deck.shells) {
    EXPECT_TRUE(elements.insert(s.id).second);
    EXPECT_TRUE(properties.contains(s.property));
    std::vector<Vector> corners;
    for (const std::int64_t g : s.grids) corners.push_back(at.at(g));
    ASSERT_GE(corners.size(), 3u);
    ASSERT_LE(corners.size(), 4u);
    EXPECT_GT(area_of(corners), 0);
    for (std::size_t k = 0, n = corners.size(); k < n; ++k) {
      const auto turn = [&](std::size_t i) {
        return cross(corners[(i + 1) % n] - corners[i % n], corners[(i + 2) % n] - corners[(i + 1) % n]);
      };
      EXPECT_GT(dot(turn(k), turn(0)), 0) << "an angle of 180 degrees or more";
    }
  }
  for (const Line& l : deck.lines) {
    EXPECT_TRUE(elements.insert(l.id).second);
    EXPECT_GT(norm(at.at(l.grid_A) - at.at(l.grid_B)), 0);
    if (l.property != 0) {
      EXPECT_TRUE(properties.contains(l.property));
    }
  }
}

const std::string many =
    "GRAPHICS/1, CYLINDER, CM=21, LENGTH=4, RADIUS=0.5, SEG=8\nGRAPHICS/2, BOX, CORNER=1, X=1, Y=2, Z=3\n"
    "GRAPHICS/3, CIRCLE, CM=30, RADIUS=2, SEG=12\nGRAPHICS/4, OUTLINE=20,30,31\nGRAPHICS/5, SPDP, I=20, J=31, COILS=4, "
    "DA=1, DB=0.5, LC=1, LA=1, SEG=8\nGRAPHICS/6, POINT, RM=30\nGRAPHICS/7, ELLIPSOID, CM=30, XSCALE=1, YSCALE=2, "
    "ZSCALE=3, SEG=6\n";

std::size_t quads(const Deck& deck) {
  return static_cast<std::size_t>(
      std::ranges::count_if(deck.shells, [](const Shell& s) { return s.grids.size() == 4; }));
}
std::size_t plotels(const Deck& deck) {
  return static_cast<std::size_t>(std::ranges::count_if(deck.lines, [](const Line& l) { return l.property == 0; }));
}

TEST(DeckGraphics, are_shells_and_rods_that_ride_on_their_bodies) {
  const Drawn d = drawn(many);
  expect_legal(d.deck);
  EXPECT_TRUE(d.remarks.items().empty());
  // Cylinder 8, box 6, halves of four coils 16 each, the tube 8, the middle of three bands 6.
  EXPECT_EQ(quads(d.deck), 8u + 6u + 32u + 8u + 6u);
  EXPECT_EQ(d.deck.shells.size() - quads(d.deck), 16u + 16u + 12u);
  // The circle, one of the two pieces of the outline, the tip of the spring; the other piece joins two bodies.
  EXPECT_EQ(d.deck.lines.size(), 12u + 2u + 1u);
  EXPECT_EQ(plotels(d.deck), 1u);
  EXPECT_EQ(d.deck.shape_ties.size(), 2u);
  EXPECT_EQ(d.deck.shape_properties.size(), 2u);
}

TEST(DeckGraphics, stand_where_the_bodies_are) {
  const Drawn d = drawn("GRAPHICS/1, OUTLINE=21,31");
  ASSERT_EQ(d.deck.shape_grids.size(), 2u);
  EXPECT_NEAR(norm(d.deck.shape_grids[0].position - Vector{8, 1, 3}), 0, 1e-12);
  EXPECT_NEAR(norm(d.deck.shape_grids[1].position - Vector{0, 20, 4}), 0, 1e-12);
  EXPECT_EQ(d.deck.shape_grids[0].body, 0);
  EXPECT_EQ(d.deck.shape_grids[1].body, 1);
  EXPECT_THAT(d.deck.shape_ties.at(0).dependent, ElementsAre(d.deck.shape_grids[0].id));
  EXPECT_EQ(d.deck.lines.at(0).body, ground);
}

TEST(DeckGraphics, are_numbered_from_their_offsets) {
  ExportOptions options;
  options.graphics_grid_offset = 500, options.cquad4_offset = 2000, options.ctria3_offset = 3000;
  options.crod_offset = 4000, options.rbe2_offset = 5000, options.pshell_offset = 60, options.prod_offset = 70;
  options.material_card_number = 80;
  const Drawn d = drawn(
      "GRAPHICS/1, CYLINDER, CM=20, LENGTH=4, RADIUS=0.5, SEG=3\nGRAPHICS/2, ARC, CM=30, RADIUS=2, "
      "RANGLE=90D, SEG=2\n",
      options);
  expect_legal(d.deck);
  EXPECT_EQ(d.deck.shape_grids.front().id, 500);
  EXPECT_EQ(d.deck.shape_grids.back().id, 500 + 8 + 3 - 1);
  std::vector<std::int64_t> shells, lines, ties;
  for (const Shell& s : d.deck.shells) shells.push_back(s.id);
  for (const Line& l : d.deck.lines) lines.push_back(l.id);
  for (const RigidElement& t : d.deck.shape_ties) ties.push_back(t.id);
  EXPECT_THAT(shells, ElementsAre(2000, 2001, 2002, 3000, 3001, 3002, 3003, 3004, 3005));
  EXPECT_THAT(lines, ElementsAre(4000, 4001));
  EXPECT_THAT(ties, ElementsAre(5000, 5001));
  ASSERT_EQ(d.deck.shape_properties.size(), 2u);
  EXPECT_EQ(d.deck.shape_properties[0].id, 60);
  EXPECT_FALSE(d.deck.shape_properties[0].rod);
  EXPECT_EQ(d.deck.shape_properties[0].material, 80);
  EXPECT_EQ(d.deck.shape_properties[1].id, 70);
  EXPECT_TRUE(d.deck.shape_properties[1].rod);
  EXPECT_EQ(d.deck.shape_properties[1].material, 81);
}

TEST(DeckGraphics, have_lines_without_stiffness_where_that_is_wanted) {
  ExportOptions options;
  options.use_plotel = true;
  const Drawn d = drawn(many, options);
  expect_legal(d.deck);
  EXPECT_EQ(plotels(d.deck), d.deck.lines.size());
  EXPECT_FALSE(d.deck.shells.empty());
  EXPECT_EQ(d.deck.shape_properties.size(), 1u);
}

TEST(DeckGraphics, as_wireframe_are_each_edge_once_and_nothing_else) {
  ExportOptions options;
  options.use_wireframe = true;
  const Drawn d = drawn(many, options);
  expect_legal(d.deck);
  EXPECT_TRUE(d.deck.shells.empty());
  EXPECT_TRUE(d.deck.shape_properties.empty());
  std::set<std::pair<std::int64_t, std::int64_t>> edges;
  for (const Line& l : d.deck.lines) {
    EXPECT_EQ(l.property, 0);
    EXPECT_TRUE(edges.insert(std::minmax(l.grid_A, l.grid_B)).second);
  }
  EXPECT_EQ(drawn("GRAPHICS/2, BOX, CORNER=1, X=1, Y=2, Z=3\n", options).deck.lines.size(), 12u);
  // Around both ends, along the side, and the spokes of both ends.
  EXPECT_EQ(drawn("GRAPHICS/2, CYLINDER, CM=1, LENGTH=1, RADIUS=2, SEG=8\n", options).deck.lines.size(), 5u * 8u);
}

TEST(DeckGraphics, keep_springs_out_where_they_are_not_wanted_or_bodies_have_files) {
  ExportOptions without, files;
  without.export_spdp = false;
  files.file_name_style = FileStyle::C;
  for (const ExportOptions& options : {without, files}) {
    const Drawn d = drawn(many, options);
    expect_legal(d.deck);
    EXPECT_EQ(quads(d.deck), 8u + 6u + 6u);
  }
  const Drawn apart = drawn(many, files);
  EXPECT_EQ(plotels(apart.deck), 0u) << "a line between two bodies has no file";
}

TEST(DeckGraphics, are_left_out_by_directives) {
  ExportOptions none, facets;
  none.export_graphics = false;
  facets.export_external = false;
  const Drawn d = drawn(many, none);
  EXPECT_TRUE(d.deck.shape_grids.empty() && d.deck.shells.empty() && d.deck.lines.empty() && d.deck.shape_ties.empty());
  const std::string external = "GRAPHICS/1, EXTERNAL, RM=20, FILE=part.x_t\n";
  EXPECT_TRUE(drawn(external, facets).remarks.items().empty());
  const Drawn with = drawn(external);
  ASSERT_EQ(with.remarks.items().size(), 1u);
  EXPECT_EQ(with.remarks.items().front().code, "geometry-format");
}

TEST(DeckGraphics, name_the_first_card_of_each_shape) {
  const std::string named = "!    adams_view_name='flange'\nGRAPHICS/2, BOX, CORNER=20, X=1, Y=2, Z=3\n";
  ExportOptions by_id;
  by_id.use_view_names = false;
  const Drawn d = drawn(named), e = drawn(named, by_id);
  EXPECT_EQ(d.deck.shells.at(0).name, "flange");
  EXPECT_EQ(d.deck.shells.at(1).name, "");
  EXPECT_EQ(d.deck.shape_grids.at(0).name, "flange");
  EXPECT_EQ(d.deck.shape_grids.at(1).name, "");
  EXPECT_EQ(e.deck.shells.at(0).name, "GRAPHICS/2");
  EXPECT_EQ(d.deck.shape_ties.at(0).name, "PART/2");
}

}  // namespace
}  // namespace dynalin::nastran::graphics_test
