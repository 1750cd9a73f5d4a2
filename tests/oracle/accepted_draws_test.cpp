#include "accepted_draws.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "generator.h"

namespace dynalin::oracle::accepted_draws_test {
namespace {

std::string after_title(const std::string& dataset) { return dataset.substr(dataset.find('\n')); }

TEST(AcceptedDraws, remembered_is_the_first_draw_of_a_seed_that_is_acceptable) {
  for (const std::uint64_t seed : {14u, 27u}) {
    const std::string text = dataset_text(random_mechanism(seed));
    const auto attempt = accepted_attempt(seed);
    ASSERT_TRUE(attempt);
    EXPECT_GT(*attempt, 0u);
    for (std::uint64_t k = 0; k < *attempt; ++k) EXPECT_THROW((void)Draw(seed, k).mechanism(), std::runtime_error);
    EXPECT_EQ(after_title(text), after_title(dataset_text(Draw(seed, *attempt).mechanism())));
    EXPECT_EQ(text, dataset_text(random_mechanism(seed)));
  }
}

}  // namespace
}  // namespace dynalin::oracle::accepted_draws_test
