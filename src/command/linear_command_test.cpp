// LINEAR's arguments for tables of modes: whatever is in the list of tables can be asked for, and is held to the rules.
#include "command/linear_command.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "command/command_catalogue.h"
#include "command/command_reader.h"
#include "command/commands.h"
#include "command/commands/linear.h"
#include "study/modal_tables.h"

namespace dynalin::linear_command_test {
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

std::optional<ModeSelection> selection_of(const std::string& arguments) {
  const auto parsed = read("EIGENSOL, " + arguments);
  EXPECT_FALSE(parsed.diagnostics.has_errors()) << render(parsed.diagnostics);
  if (parsed.diagnostics.has_errors()) return std::nullopt;
  return action_of<commands::Linear>(parsed.value.commands.front())->command.selection;
}
// The code of the only problem and the column of its caret.
std::pair<std::string, std::size_t> problem_of(const std::string& arguments) {
  const auto parsed = read(arguments);
  EXPECT_EQ(parsed.diagnostics.items().size(), 1u) << arguments << "\n" << render(parsed.diagnostics);
  if (parsed.diagnostics.items().empty()) return {};
  const Diagnostic& d = parsed.diagnostics.items().front();
  return {std::string(d.code), d.at.offset + 1};
}

TEST(LinearSelection, is_a_number_of_modes_near_a_frequency_or_a_band) {
  const auto nearest = std::get<NearestModes>(selection_of("NMODES=20, NEAR=3.5").value());
  EXPECT_EQ(nearest.count, 20u);
  EXPECT_EQ(nearest.frequency, 3.5);
  EXPECT_EQ(std::get<NearestModes>(selection_of("NMODES=1").value()).frequency, 0);
  const auto band = std::get<ModesInBand>(selection_of("BAND=0,2.5").value());
  EXPECT_EQ(band.low, 0);
  EXPECT_EQ(band.high, 2.5);
  EXPECT_FALSE(selection_of("COORDS=1,3").has_value());
}

TEST(LinearSelection, is_held_to_rules_each_of_which_points_at_its_argument) {
  using Problem = std::pair<std::string, std::size_t>;
  EXPECT_EQ(problem_of("EIGENSOL, NMODES=3, BAND=1,2"), Problem("excluded-arguments", 28));
  EXPECT_EQ(problem_of("EIGENSOL, NEAR=2"), Problem("missing-argument", 18));
  EXPECT_EQ(problem_of("EIGENSOL, BAND=2,1"), Problem("value-out-of-range", 18));
  EXPECT_EQ(problem_of("EIGENSOL, BAND=-1,1"), Problem("value-out-of-range", 18));
  EXPECT_EQ(problem_of("EIGENSOL, BAND=1,1"), Problem("value-out-of-range", 18));
  EXPECT_EQ(problem_of("EIGENSOL, BAND=1"), Problem("wrong-count", 18));
  EXPECT_EQ(problem_of("EIGENSOL, BAND=1,2,3"), Problem("wrong-count", 18));
  EXPECT_EQ(problem_of("EIGENSOL, NMODES=0").first, "value-out-of-range");
  EXPECT_EQ(problem_of("EIGENSOL, NMODES=-5").first, "value-out-of-range");
  EXPECT_EQ(problem_of("EIGENSOL, NMODES=1, NEAR=-5").first, "value-out-of-range");
  EXPECT_EQ(problem_of("EIGENSOL, NMODES=1.5").first, "expected-integer");
  EXPECT_EQ(problem_of("EIGENSOL, NMODES=5, ENERGY_PER_MODE=ALL"), Problem("excluded-arguments", 28));
  EXPECT_EQ(problem_of("STATEMAT, FILE=a, NMODES=3"), Problem("wrong-option", 26));
  EXPECT_EQ(problem_of("MKB, FILE=a, BAND=1,3"), Problem("wrong-option", 21));
  EXPECT_EQ(problem_of("EIGENSOL, DESCRIPTOR"), Problem("wrong-option", 18));
  EXPECT_EQ(problem_of("MKB, FILE=a, DESCRIPTOR"), Problem("wrong-option", 21));
  EXPECT_EQ(problem_of("STATEMAT, FILE=a, FORMAT=MATLAB, DESCRIPTOR"), Problem("excluded-arguments", 41));
  EXPECT_EQ(problem_of("STATEMAT, FILE=-, DESCRIPTOR"), Problem("wrong-option", 18));
}

// Short forms of the original arguments mean what they did before there were others.
TEST(LinearSelection, leaves_abbreviations_what_they_were) {
  EXPECT_TRUE(request_of("EIGENSOL, D=1").modes.contains("DISSIPAT"));
  EXPECT_TRUE(request_of("EIGENSOL, K=1, ENERGY=1").modes.contains("ENERGY_PER_MODE"));
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
}  // namespace dynalin::linear_command_test
