#include "base/progress.h"

#include <gtest/gtest.h>

#include <vector>

namespace dynalin::progress_test {
namespace {

TEST(Progress, what_is_told_has_the_names_of_all_parts_before_it) {
  std::vector<std::string> shown;
  const Progress whole([&](std::string text) { shown.push_back(std::move(text)); });
  const Progress part = whole.of("modes").of("bounds");
  whole.tell("begun");
  part.tell([] { return std::string("left vectors"); });
  EXPECT_EQ(shown, (std::vector<std::string>{"begun", "modes: bounds: left vectors"}));
}

TEST(Progress, nothing_is_put_into_words_where_nobody_watches) {
  bool asked = false;
  Progress().of("modes").tell([&] { return asked = true, std::string("left vectors"); });
  EXPECT_FALSE(asked);
}

}  // namespace
}  // namespace dynalin::progress_test
