#include "output/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace dynalin {
namespace {

TEST(JsonResults, replace_bytes_that_are_no_text) {
  JsonResults results;
  results.add_plain("SHOW/\xE9", 0.5);
  std::ostringstream out;
  results.write(out);
  const auto parsed = nlohmann::json::parse(out.str());
  EXPECT_EQ(parsed["results"][0]["command"], "SHOW/\xEF\xBF\xBD");
}

}  // namespace
}  // namespace dynalin
