// What is said of ids that are given twice, whose first statements have no element yet when the second is met.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "elements/catalogue.h"
#include "model/model.h"

namespace dynalin::build_model_test {
namespace {

Diagnostics problems_of(const std::string& text, const SourceRef& source) {
  auto parsed = parse_dataset(source);
  EXPECT_FALSE(parsed.diagnostics.has_errors()) << text;
  return build_model(std::make_shared<const Dataset>(std::move(parsed.value)), catalogue()).diagnostics;
}

TEST(BuildModel, says_where_what_is_defined_twice_stands_first) {
  const std::string text =
      "twice\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20\nMARKER/20\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, FIXED, I=20, J=1\nMARKER/20\nJOINT/2, REVOLUTE, I=20, J=1\n"
      "UNITS/SYSTEM=MKS\nPART/2, MASS=2, CM=20\nMARKER/21, PART=2\nJOINT/3, FIXED, I=20, J=1\n"
      "JOINT/3, REVOLUTE, I=20, J=1\nJOINT/1, FIXED, I=20, J=1\nMARKER/21, PART=2\nEND\n";
  const auto source = std::make_shared<const SourceText>("twice.adm", text);
  const auto line = [&](const Span& at) { return std::to_string(source->place(at.offset).line); };
  std::vector<std::string> said;
  const Diagnostics problems = problems_of(text, source);
  for (const Diagnostic& d : problems.items()) {
    if (!d.code.starts_with("duplicate")) continue;
    ASSERT_EQ(d.notes.size(), 1u);
    said.push_back(std::string(d.code) + " " + line(d.at) + " " + line(d.notes[0].at));
  }
  EXPECT_EQ(said, (std::vector<std::string>{"duplicate-id 9 6", "duplicate-id 10 8", "duplicate-statement 11 2",
                                            "duplicate-id 12 5", "duplicate-id 15 14", "duplicate-id 16 7",
                                            "duplicate-id 17 13"}));
}

// The first ones are looked up all together: a second each must not cost a search each.
TEST(BuildModel, finds_a_great_many_first_ones) {
  constexpr int count = 20'000;
  std::string text = "many\nPART/1, GROUND\n";
  for (int time = 0; time < 2; ++time)
    for (int k = 1; k <= count; ++k) text += "MARKER/" + std::to_string(k) + ", PART=1\n";
  text += "END\n";
  const auto source = std::make_shared<const SourceText>("many.adm", text);
  const Diagnostics problems = problems_of(text, source);
  ASSERT_EQ(problems.error_count(), static_cast<std::size_t>(count));
  for (const Diagnostic& d : problems.items()) {
    ASSERT_EQ(d.notes.size(), 1u);
    const std::size_t second = source->place(d.at.offset).line, first = source->place(d.notes[0].at.offset).line;
    ASSERT_EQ(second, first + count);
  }
}

}  // namespace
}  // namespace dynalin::build_model_test
