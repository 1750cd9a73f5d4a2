// LINEAR's arguments for tables of modes: whatever is in the list of tables can be asked for, and is held to the rules.
#include "command/linear_command.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "command/command_catalogue.h"
#include "command/command_reader.h"
#include "command/commands.h"
#include "command/commands/linear.h"
#include "study/modal_tables.h"

namespace dynalin {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;

Parsed<CommandFile> read(const std::string& arguments) {
  return parse_commands(std::make_shared<const SourceText>("line", "LINEAR/" + arguments + "\n"));
}
std::vector<std::string> codes_of(const std::string& arguments) {
  std::vector<std::string> codes;
  const auto parsed = read(arguments);
  for (const Diagnostic& d : parsed.diagnostics.items()) codes.emplace_back(d.code);
  return codes;
}
ModalTableRequest request_of(const std::string& arguments) {
  const auto parsed = read(arguments);
  EXPECT_FALSE(parsed.diagnostics.has_errors()) << render(parsed.diagnostics);
  if (parsed.diagnostics.has_errors()) return {};
  return action_of<commands::Linear>(parsed.value.commands.front())->command.tables;
}

// The shapes of markers need the markers.
std::string with_markers(const ModalTableKind& kind) { return kind.name == "MRANGE" ? "MLIST=20, " : ""; }

TEST(LinearTables, are_asked_for_by_the_numbers_of_modes) {
  for (const ModalTableKind& kind : modal_table_kinds()) {
    const std::string name(kind.name), before = "EIGENSOL, " + with_markers(kind) + name;
    const ModeRange range = request_of(before + "=2,5").of(name);
    EXPECT_EQ(range.first, 2) << name;
    EXPECT_EQ(range.last, 5) << name;
    EXPECT_EQ(request_of(before + "=3").of(name).last, 3) << name;
    EXPECT_EQ(request_of(before + "=3").modes.size(), 1u) << name;
    for (const char* wrong : {"=5,2", "=0"})
      EXPECT_THAT(codes_of(before + wrong), Contains("value-out-of-range")) << name;
    EXPECT_THAT(codes_of("STATEMAT, FILE=a, " + with_markers(kind) + name + "=1"), Contains("wrong-option")) << name;
    EXPECT_THAT(codes_of("EIGENSOL, NOVECTOR, " + with_markers(kind) + name + "=1"), Contains("excluded-arguments"));
    const bool all = kind.asked == TableAsked::all_or_by_numbers;
    EXPECT_EQ(codes_of(before + "=ALL").empty(), all) << name;
    EXPECT_EQ(codes_of(before + "=1,2,3").empty(), false) << name;
  }
}

TEST(LinearTables, of_some_kinds_are_asked_for_by_frequency) {
  for (const ModalTableKind& kind : modal_table_kinds()) {
    const std::string name(kind.name), by_frequency = "F" + name;
    if (kind.asked != TableAsked::by_numbers_or_frequency) {
      EXPECT_THAT(codes_of("EIGENSOL, " + by_frequency + "=0.5,9"), Contains("unknown-argument")) << name;
      continue;
    }
    const ModeRange range = request_of("EIGENSOL, " + by_frequency + "=0.5,9").of(name);
    EXPECT_EQ(range.lowest_hz, 0.5) << name;
    EXPECT_EQ(range.highest_hz, 9) << name;
    EXPECT_THAT(codes_of("EIGENSOL, " + by_frequency + "=9,0.5"), Contains("value-out-of-range")) << name;
    EXPECT_THAT(codes_of("EIGENSOL, " + by_frequency + "=9"), Contains("wrong-count")) << name;
    EXPECT_THAT(codes_of("EIGENSOL, " + by_frequency + "=0.5,9, " + name + "=1"), Contains("excluded-arguments"));
    EXPECT_THAT(codes_of("EIGENSOL, NOVECTOR, " + by_frequency + "=0.5,9"), Contains("excluded-arguments"));
    EXPECT_THAT(codes_of("MKB, FILE=a, " + by_frequency + "=0.5,9"), Contains("wrong-option")) << name;
  }
}

// What could not be read was reported then; nothing is made of the rest, whose rules nobody has looked at.
TEST(LinearTables, of_a_command_that_was_not_read_whole_ask_for_nothing) {
  for (const char* written : {"EIGENSOL, FSTRAIN==1", "EIGENSOL, COORDS==", "STATEMAT==, FSTRAIN=1"}) {
    const SourceRef source = std::make_shared<const SourceText>("line", std::string("LINEAR/") + written + "\n");
    const Parsed<Dataset> parsed = parse_statements(source, command_names());
    ASSERT_TRUE(parsed.value.statements.front().damaged) << written;
    Diagnostics diagnostics;
    const Statement& statement = parsed.value.statements.front();
    const ElementLabel label{statement.name, 0, "", statement.at};
    CommandReader reader(statement, *source, diagnostics, label);
    EXPECT_FALSE(read_linear(reader)) << written;
  }
}

TEST(LinearTables, have_their_help_in_the_list_of_tables) {
  for (const ModalTableKind& kind : modal_table_kinds()) {
    const auto arguments = linear_arguments();
    const auto found = std::ranges::find(arguments, kind.name, &ArgumentInfo::name);
    ASSERT_NE(found, arguments.end()) << kind.name;
    EXPECT_TRUE(found->help.starts_with(kind.help)) << kind.name;
  }
  EXPECT_THAT(codes_of("EIGENSOL, COORDS=1, NAMES, TABLE_PRECISION=4"), IsEmpty());
}

}  // namespace
}  // namespace dynalin
