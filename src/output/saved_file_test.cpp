#include "output/saved_file.h"

#include <gtest/gtest.h>

namespace dynalin::saved_file_test {
namespace {

TEST(SavedFile, keeps_what_states_tell_of) {
  SavedFile file;
  KnownPair bristles{.of = {"FRICTION", 4, "", 0},
                     .joint = 7,
                     .motion = "sleeve",
                     .ends = {{{30, {"FE_PART", 3, "one of 3", 2}, {0.1, 1.0 / 3, 3}, {0, 0, 1}},
                               {1, {"PART", 1, "", 0}, {4, 5, 6}, {0, 1, 0}}}},
                     .directions = {{1, 0, 0}, {0, 0.6, 0.8}},
                     .radius = 0.2};
  const KnownPair course{.of = {"MOTION", 5, "", 0}, .motion = "B1", .ends = {}, .directions = {}};
  file.point.pairs = {bristles, course};
  const auto text = saved_text(file);
  ASSERT_TRUE(text);
  const auto read = read_saved(*text);
  ASSERT_TRUE(read) << read.error();
  EXPECT_EQ(*saved_text(*read), *text);
  ASSERT_EQ(read->point.pairs.size(), 2u);
  const KnownPair& back = read->point.pairs[0];
  EXPECT_EQ(back.of, bristles.of);
  EXPECT_EQ(back.joint, 7);
  EXPECT_EQ(back.motion, "sleeve");
  EXPECT_EQ(back.ends[0].body, bristles.ends[0].body);
  EXPECT_EQ(back.ends[0].at.y, 1.0 / 3);
  EXPECT_EQ(back.ends[1].axis.y, 1);
  EXPECT_EQ(back.directions.at(1).z, 0.8);
  EXPECT_EQ(back.radius, 0.2);
  EXPECT_FALSE(read->point.pairs[1].slips());
}

}  // namespace
}  // namespace dynalin::saved_file_test
