#include "nastran_reader/case_command.h"

#include <gmock/gmock.h>

namespace dynalin::nastran_reader::case_command_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Each command with its values between bars.
std::vector<std::string> read(const std::string& text, Diagnostics& diagnostics) {
  const DeckLines deck = deck_lines_of_text("test.bdf", text, diagnostics);
  CommandReader reader(deck.lines, diagnostics);
  std::vector<std::string> all;
  while (const auto command = reader.next()) {
    std::string line = command->name;
    for (const Piece& p : command->values) line += "|" + std::string(p.text);
    all.push_back(line);
  }
  return all;
}

TEST(CaseCommand, takes_the_lines_that_follow_a_comma) {
  Diagnostics diagnostics;
  EXPECT_THAT(read("spc = 1\nSET 5 = 1,2 ,\n  7 THRU 9,\n 11\nMPC=2\n", diagnostics),
              ElementsAre("SPC|1", "SET|5|1|2|7 THRU 9|11", "MPC|2"));
  EXPECT_THAT(read("DLOAD = 4,", diagnostics), ElementsAre("DLOAD|4"));
  EXPECT_THAT(diagnostics.items(), IsEmpty());
}

TEST(CaseCommand, titles_are_text_whatever_is_in_them) {
  Diagnostics diagnostics;
  EXPECT_THAT(read("LABEL = one, two,\nTITLE = a (b\nSPC = 1\n", diagnostics),
              ElementsAre("LABEL|one, two,", "TITLE|a (b", "SPC|1"));
  EXPECT_THAT(diagnostics.items(), IsEmpty());
}

TEST(CaseCommand, parentheses_are_options_or_factors) {
  Diagnostics diagnostics;
  EXPECT_THAT(read("DISP(PLOT,PHASE) = ALL\nK2PP=(1.0,0.0)*KVVV, (2.0,0.0)*KZZZ\n", diagnostics),
              ElementsAre("DISP|ALL", "K2PP|(1.0,0.0)*KVVV|(2.0,0.0)*KZZZ"));
  EXPECT_THAT(read("PARAM,AUTOSPC,NO\n", diagnostics), ElementsAre("PARAM|AUTOSPC|NO"));
  EXPECT_THAT(diagnostics.items(), IsEmpty());
}

TEST(CaseCommand, passes_over_lines_that_are_none) {
  Diagnostics diagnostics;
  EXPECT_THAT(read("= 3\nDISP(PLOT = ALL\nSPC = 1\n", diagnostics), ElementsAre("SPC|1"));
  ASSERT_EQ(diagnostics.items().size(), 2u);
  EXPECT_EQ(diagnostics.items()[0].message, "this line of case control begins with no command");
  EXPECT_EQ(diagnostics.items()[1].message, "the parenthesis is not closed");
  EXPECT_EQ(diagnostics.items()[1].at.offset, 8u);
}

}  // namespace
}  // namespace dynalin::nastran_reader::case_command_test
