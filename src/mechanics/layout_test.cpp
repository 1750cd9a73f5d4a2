// The numbering of unknowns.
#include "mechanics/layout.h"

#include <gtest/gtest.h>

#include "mechanics/paths_test_support.h"

namespace dynalin::mechanics_test::layout_test {
namespace {

TEST(Layout, bodies_have_the_coordinates_of_their_kind_one_after_another) {
  const Paths p;
  const auto& b = p.layout.bodies;
  EXPECT_EQ(b[0].offset, -1);
  EXPECT_EQ(b[0].count, 0);
  EXPECT_EQ(b[1].offset, 0);
  EXPECT_EQ(b[1].count, 6);
  EXPECT_EQ(b[2].offset, 6);
  EXPECT_EQ(b[3].offset, 12);
  EXPECT_EQ(b[3].count, 3);
  EXPECT_EQ(b[4].offset, 15);
  EXPECT_EQ(p.layout.body_coordinate_count, 21);
  EXPECT_EQ(p.layout.coordinate_count, 29);
}

TEST(Layout, coordinates_outside_bodies_stand_behind_them_and_keep_their_block) {
  Paths p;
  const ElementLabel label{"CVCV", 7, {}, {}};
  EXPECT_EQ(p.layout.add_extra(label, {StateType::cvcv}, {{"S", 0.25, 2.0, 0.1}}), 29);
  EXPECT_EQ(p.layout.coordinate_count, 30);
  EXPECT_EQ(p.layout.body_coordinate_count, 21);
  EXPECT_EQ(p.layout.extra_index(29), 8u);
  EXPECT_EQ(p.layout.extras.back().offset, 29);
  EXPECT_EQ(p.layout.extras.back().count, 1);
  EXPECT_EQ(p.layout.extras.back().kind.types.global, StateType::cvcv);
  EXPECT_EQ(p.layout.extras.back().kind.types.relative, StateType::cvcv);
}

TEST(Layout, coordinates_outside_bodies_are_numbered_by_their_place_unless_their_element_does) {
  Layout l;
  const ElementLabel label{"FLEX_BODY", 7, {}, {}};
  l.add_extra(label, {StateType::flex_body}, {{"Q1"}, {.name = "Q2", .number = 12}, {"Q3"}});
  ASSERT_EQ(l.extras.front().coordinates.size(), 3u);
  EXPECT_EQ(l.extras.front().coordinates[0].number, 1);
  EXPECT_EQ(l.extras.front().coordinates[1].number, 12);
  EXPECT_EQ(l.extras.front().coordinates[2].number, 3);
}

TEST(Layout, bodies_are_listed_as_their_element_says) {
  Layout l;
  const ElementLabel label{"FE_PART", 7, {}, {}};
  l.add_body(BodyKind::part, label);
  l.add_body(BodyKind::part, label, {.role = BodyRole::nodal, .node = 40, .states = {.types = StateType::fe_part}});
  EXPECT_TRUE(l.bodies[0].is_rigid());
  EXPECT_FALSE(l.bodies[0].is_node());
  EXPECT_TRUE(l.bodies[1].is_node());
  EXPECT_FALSE(l.bodies[1].is_rigid());
  EXPECT_EQ(l.bodies[1].listed.node, 40);
  EXPECT_EQ(l.bodies[1].listed.states.types.principal, StateType::fe_part);
}

TEST(Layout, coordinates_outside_bodies_follow_unless_their_element_says_that_a_body_deforms_by_them) {
  Layout l;
  const ElementLabel label{"FLEX_BODY", 7, {}, {}};
  l.add_extra(label, {StateType::flex_body}, {{"S"}});
  l.add_extra(label, {StateType::cvcv, ExtraRole::shape}, {{"Q1"}, {"Q2"}});
  l.add_extra(label, {StateType::cvcv, ExtraRole::nodal}, {{"SX"}});
  EXPECT_FALSE(l.extras[0].is_shape() || l.extras[0].is_deformation());
  EXPECT_TRUE(l.extras[1].is_shape() && l.extras[1].is_deformation());
  EXPECT_FALSE(l.extras[2].is_shape());
  EXPECT_TRUE(l.extras[2].is_deformation());
}

TEST(Layout, coordinates_are_named_by_axis_and_owner) {
  const Paths p;
  EXPECT_EQ(p.layout.coordinate_text(0), "DX of PART/2");
  EXPECT_EQ(p.layout.coordinate_text(5), "AZ of PART/2");
  EXPECT_EQ(p.layout.coordinate_text(6), "DX of PART/3");
  EXPECT_EQ(p.layout.coordinate_text(14), "DZ of POINT_MASS/4");
  EXPECT_EQ(p.layout.coordinate_text(15), "DX of PART/5");
  EXPECT_EQ(p.layout.coordinate_text(22), "Q2 of PART/2");
  EXPECT_EQ(p.layout.coordinate_text(28), "V of PTCV/1");
  EXPECT_EQ(p.layout.coordinate_text(29), "coordinate 30");
}

TEST(Layout, rows_values_states_and_memory_are_counted_from_zero) {
  Layout l;
  const ElementLabel joint{"JOINT", 3, {}, {}}, value{"VARIABLE", 9, {}, {}};
  EXPECT_EQ(l.add_row(joint, "Zi.Xj"), 0);
  EXPECT_EQ(l.add_row(joint, "Zi.Yj", RowLevel::velocity), 1);
  EXPECT_EQ(l.row_count(), 2u);
  EXPECT_EQ(l.rows[0].level, RowLevel::position);
  EXPECT_EQ(l.rows[1].level, RowLevel::velocity);
  EXPECT_EQ(l.rows[1].owner, &joint);
  EXPECT_EQ(l.add_algebraic(value), 0);
  EXPECT_EQ(l.add_algebraic(value, 2, 0.5), 1);
  EXPECT_EQ(l.algebraic[1].guess, 0.5);
  EXPECT_EQ(l.algebraic[1].component, 2);
  EXPECT_EQ(l.algebraic[1].rate, -1);
  EXPECT_EQ(l.add_state({.owner = &value, .initial = 4}), 0);
  EXPECT_EQ(l.states[0].initial, 4);
  EXPECT_EQ(l.add_memory(value, "held", 1.5), 0);
  EXPECT_EQ(l.add_memory(value, "next"), 1);
  EXPECT_EQ(l.memory, (Memory{1.5, 0.0}));
  EXPECT_EQ(l.memory_owners.size(), 2u);
}

TEST(Layout, an_angle_is_counted_once) {
  Layout l;
  const MarkerId a{3}, b{4};
  EXPECT_EQ(l.count_turns(Measure::AX, a, b), 0);
  EXPECT_EQ(l.count_turns(Measure::AY, a, b), 1);
  EXPECT_EQ(l.count_turns(Measure::AZ, a, b), 2);
  EXPECT_EQ(l.count_turns(Measure::AZ, b, a), 3);
  EXPECT_EQ(l.count_turns(Measure::AY, a, b), 1);
  EXPECT_EQ(l.angles.size(), 4u);
  EXPECT_EQ(l.memory.size(), 4u);
}

TEST(Layout, a_floating_marker_is_found_by_its_contact_alone) {
  Layout l;
  l.curve_points.push_back({MarkerId{4}, MarkerId{2}, nullptr, 7});
  ASSERT_TRUE(l.curve_point(MarkerId{4}));
  EXPECT_EQ(l.curve_point(MarkerId{4})->coordinate, 7);
  EXPECT_EQ(l.curve_point(MarkerId{2}), nullptr);  // the carrier is no floating marker
}

}  // namespace
}  // namespace dynalin::mechanics_test::layout_test
