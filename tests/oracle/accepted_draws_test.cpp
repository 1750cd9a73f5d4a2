#include "accepted_draws.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "generator.h"

namespace dynalin::oracle::accepted_draws_test {
namespace {

std::string after_title(const std::string& dataset) { return dataset.substr(dataset.find('\n')); }

TEST(AcceptedDraws, remembered_is_the_first_draw_of_a_seed_that_is_acceptable) {
  int softenings = 0;
  for (const std::uint64_t seed : {14u, 27u, 34u}) {
    const std::string text = dataset_text(random_mechanism(seed));
    const auto known = accepted_draw(seed);
    ASSERT_TRUE(known);
    EXPECT_GT(known->attempt, 0u);
    for (std::uint64_t k = 0; k < known->attempt; ++k)
      EXPECT_THROW((void)Draw(seed, k).mechanism(), std::runtime_error);
    Draw anew(seed, known->attempt);
    EXPECT_EQ(after_title(text), after_title(dataset_text(anew.mechanism())));
    EXPECT_EQ(anew.softenings(), known->softenings);
    EXPECT_EQ(text, dataset_text(random_mechanism(seed)));
    softenings += known->softenings;
  }
  EXPECT_GT(softenings, 0);
}

}  // namespace
}  // namespace dynalin::oracle::accepted_draws_test
