#include "model/argument_info.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "elements/catalogue.h"

namespace dynalin::argument_info_test {
namespace {

const ArgumentInfo& argument(std::string_view statement, std::string_view name) {
  for (const Kind* kind : catalogue()) {
    if (kind->statement != statement) continue;
    for (const ArgumentInfo& a : kind->arguments) {
      if (a.name == name && !a.elsewhere) return a;
    }
  }
  static const ArgumentInfo none{};
  return none;
}

TEST(ArgumentInfos, say_what_a_value_is) {
  struct Row {
    const char *statement, *argument;
    ValueKind value;
    const char *text, *ids_of;
    bool numbers, may_be_number;
  };
  for (const Row& row : {Row{"BUSHING", "K", ValueKind::numbers, "reals", "", true, false},
                         Row{"MARKER", "QP", ValueKind::vector, "x, y, z", "", true, false},
                         Row{"BUSHING", "I", ValueKind::marker, "marker", "MARKER", false, false},
                         Row{"MARKER", "PART", ValueKind::body, "body", "PART", false, false},
                         Row{"MARKER", "POINT_MASS", ValueKind::body, "body", "POINT_MASS", false, false},
                         Row{"SPRINGDAMPER", "K", ValueKind::number, "real", "", true, false},
                         Row{"MOTION", "JOINT", ValueKind::element, "id", "JOINT", false, false},
                         Row{"PINPUT", "VARIABLES", ValueKind::elements, "variables", "VARIABLE", false, false},
                         Row{"CABLE", "MARKERS", ValueKind::ids, "ids", "MARKER", false, false},
                         Row{"REQUEST", "RM", ValueKind::integer, "integer", "MARKER", true, false},
                         Row{"MATRIX", "I", ValueKind::ids, "ids", "", false, false},
                         Row{"VARIABLE", "FUNCTION", ValueKind::expression, "expression", "", false, true}}) {
    const ArgumentInfo& a = argument(row.statement, row.argument);
    EXPECT_EQ(a.value, row.value) << row.statement << ' ' << row.argument;
    EXPECT_EQ(a.value_text(), row.text) << row.statement << ' ' << row.argument;
    EXPECT_EQ(a.ids_of, row.ids_of) << row.statement << ' ' << row.argument;
    EXPECT_EQ(takes_numbers(a), row.numbers) << row.statement << ' ' << row.argument;
    EXPECT_EQ(may_be_number(a), row.may_be_number) << row.statement << ' ' << row.argument;
  }
}

// The text is for the manual: who adds a unit says beside it whether degrees are meant.
TEST(ArgumentInfos, say_of_every_unit_whether_it_has_an_angle) {
  for (const Kind* kind : catalogue()) {
    for (const ArgumentInfo& a : kind->arguments) {
      const bool named = a.unit.text.find("rad") != std::string_view::npos;
      EXPECT_EQ(a.unit.has_angle, named) << kind->statement << '/' << a.name << " [" << a.unit.text << ']';
    }
  }
}

TEST(ArgumentInfos, name_statements_that_there_are) {
  for (const Kind* kind : catalogue()) {
    for (const ArgumentInfo& a : kind->arguments) {
      const auto is = [&](const Kind* k) { return k->statement == a.ids_of; };
      EXPECT_TRUE(a.ids_of.empty() || std::ranges::any_of(catalogue(), is))
          << kind->statement << '/' << a.name << ' ' << a.ids_of;
    }
  }
}

}  // namespace
}  // namespace dynalin::argument_info_test
