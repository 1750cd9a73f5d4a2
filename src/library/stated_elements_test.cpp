// Statements as values become those of a dataset, and nothing besides.
#include "library/stated_elements.h"

#include <gmock/gmock.h>

namespace dynalin::library::stated_elements_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// What is wrong, one below the other.
std::string faults(const std::vector<StatedElement>& elements, const std::string& title = "t") {
  return render(dataset_of(title, elements).diagnostics);
}

TEST(StatedElements, are_read_as_the_statements_they_say) {
  const auto made = dataset_of("A cart", {{{"UNITS", 0}, {{"SYSTEM", "MKS"}}},
                                          {{"PART", 1}, {"GROUND"}},
                                          {{"MARKER", 1}, {}},
                                          {{"PART", 2}, {{"MASS", 0.1}, {"CM", 20}}, "cart"}});
  EXPECT_THAT(made.diagnostics.items(), IsEmpty());
  EXPECT_EQ(made.value.title, "A cart");
  ASSERT_THAT(made.value.statements, SizeIs(4));
  EXPECT_EQ(made.value.statements[0].name, "UNITS");
  EXPECT_FALSE(made.value.statements[0].id);
  const Statement& cart = made.value.statements[3];
  EXPECT_EQ(cart.id, 2);
  EXPECT_EQ(cart.view_name(), "cart");
  ASSERT_THAT(cart.arguments, SizeIs(2));
  EXPECT_EQ(cart.arguments[0].name.text(), "MASS");
  EXPECT_EQ(cart.arguments[0].value_span().text(), "0.10000000000000001");  // to the last bit
  EXPECT_EQ(cart.arguments[1].value_span().text(), "20");
}

TEST(StatedElements, long_lists_go_over_several_lines) {
  std::vector<double> numbers(40);
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<double>(k);
  const auto made = dataset_of("t", {{{"ARRAY", 1}, {{"SIZE", 40}, {"NUMBERS", numbers}}}});
  EXPECT_THAT(made.diagnostics.items(), IsEmpty());
  Diagnostics none;
  const WrittenArgument& list = made.value.statements.at(0).arguments.at(1);
  EXPECT_EQ(read_reals(list, *list.name.source, none), numbers);
}

TEST(StatedElements, values_that_are_more_than_a_value_are_refused) {
  const auto variable = [](StatedArgument a) { return faults({{{"VARIABLE", 1}, {std::move(a)}}}); };
  EXPECT_EQ(variable({"FUNCTION", "TIME"}), "");
  for (const char* text : {"", "TIME\nPART/9", "TIME ! a remark", "TIME &"})
    EXPECT_THAT(variable({"FUNCTION", text}), HasSubstr("the value of FUNCTION is empty, or holds a comment")) << text;
  EXPECT_THAT(variable({"FUNCTION", "TIME, IC=5"}), HasSubstr("VARIABLE/1 has 1 argument, and is read with 2"));
  EXPECT_THAT(variable({"FUNCTION", std::numeric_limits<double>::infinity()}), HasSubstr("no finite number"));
  EXPECT_THAT(variable({"FUNCTION", StatedArgument::Numbers{}}), HasSubstr("FUNCTION has no numbers"));
  EXPECT_THAT(variable({"FUNCTION", StatedArgument::Ids{}}), HasSubstr("FUNCTION has no ids"));
  EXPECT_THAT(variable({"FUNC TION", 1.0}), HasSubstr("'FUNC TION' is no name of an argument"));
  EXPECT_THAT(faults({{{"PART/3\nPART", 2}, {}}}), HasSubstr("names no statement"));
  EXPECT_THAT(faults({{{"PART", -2}, {}}}), HasSubstr("names no statement"));
  EXPECT_THAT(faults({{{"PART", 2}, {}, "a'b"}}), HasSubstr("a view name holds a quote"));
  EXPECT_THAT(faults({}, "two\nlines"), HasSubstr("the title has several lines"));
  EXPECT_THAT(faults({{{"END", 1}, {}}, {{"PART", 2}, {}}}), HasSubstr("error"));
}

}  // namespace
}  // namespace dynalin::library::stated_elements_test
