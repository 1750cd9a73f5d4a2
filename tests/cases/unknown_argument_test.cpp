// An argument that nothing knows is an error that names it, of every statement and every command there is.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/diagnostics.h"
#include "cases/run.h"
#include "command/command_catalogue.h"
#include "command/commands.h"
#include "elements/catalogue.h"

namespace dynalin::cases::unknown_argument_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class UnknownArguments : public Cases {
 protected:
  static std::string model(const std::string& statements) {
    return "t\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
           "JOINT/1, REVOLUTE, I=20, J=1\n" +
           statements + "END\n";
  }
};

// "JOINT/9, REVOLUTE, " or "EQUILIBRIUM/".
std::string beginning(const Kind& kind, int id) {
  const bool has_id = kind.role != Kind::Role::singleton && kind.role != Kind::Role::setting;
  std::string text = fmt::format("{}/{}", kind.statement, has_id ? fmt::format("{}, ", id) : "");
  if (!kind.variant.empty()) text += fmt::format("{}, ", kind.variant);
  return text;
}

// What has no table is read and passed over whole.
bool has_table(const Kind& kind) { return !kind.arguments.empty(); }

TEST_F(UnknownArguments, of_every_statement_are_errors_that_name_them) {
  int walked = 0;
  for (const Kind* kind : catalogue()) {
    if (!has_table(*kind) || kind->statement == "MATERIAL") continue;
    ++walked;
    for (const std::string written : {"QQZZQQ", "QQZZQQ=3"}) {
      const RunResult r = run(model(beginning(*kind, 99) + written + "\n"), "LINEAR/EIGENSOL\n");
      EXPECT_EQ(r.status, 1) << kind->statement << kind->variant;
      EXPECT_THAT(r.err,
                  HasSubstr(fmt::format("error: {} has no argument QQZZQQ [unknown-argument]", kind->statement)));
    }
  }
  EXPECT_GT(walked, 60);
}

TEST_F(UnknownArguments, that_miss_a_name_by_a_letter_are_errors_that_suggest_it) {
  for (const Kind* kind : catalogue()) {
    std::string statements;
    std::vector<std::string> slips;
    int id = 100;
    for (const ArgumentInfo& a : kind->arguments) {
      constexpr std::size_t long_enough = 4;  // of shorter names others may be as near
      if (a.elsewhere || a.name.size() < long_enough) continue;
      slips.push_back(std::string(a.name) + "Q");
      // What stands once has all of them in one statement.
      const bool goes_on = kind->role == Kind::Role::singleton && slips.size() > 1;
      if (goes_on) statements.back() = ',';
      statements += (goes_on ? "" : beginning(*kind, ++id)) + slips.back() + "=1\n";
    }
    if (slips.empty()) continue;
    const RunResult r = run(model(statements), "LINEAR/EIGENSOL\n");
    for (const std::string& slip : slips) {
      EXPECT_THAT(r.err,
                  HasSubstr(fmt::format("error: {} has no argument {} [unknown-argument]", kind->statement, slip)));
    }
    EXPECT_THAT(r.err, HasSubstr("hint: did you mean ")) << kind->statement;
  }
}

// Old datasets state colours and catalogue numbers of a material.
TEST_F(UnknownArguments, of_a_material_that_are_near_to_none_are_passed_over) {
  const RunResult r = run(model("MATERIAL/1, NAME=steel, DENSITY=7801, HARDNESS=3\n"), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("warning: nothing here acts on MATERIAL/HARDNESS"));
  EXPECT_THAT(run(model("MATERIAL/1, DENSITTY=3\n"), "LINEAR/EIGENSOL\n").err,
              AllOf(HasSubstr(":7:13: error: MATERIAL has no argument DENSITTY"), HasSubstr("did you mean DENSITY?")));
  EXPECT_THAT(run(model("MATERIAL/1, DENSITY=3, DENSITY=4\n"), "LINEAR/EIGENSOL\n").err,
              HasSubstr("error: DENSITY of MATERIAL/1 is given twice"));
  EXPECT_THAT(run(model("MATERIAL/1, DENSITY\n"), "LINEAR/EIGENSOL\n").err,
              HasSubstr("error: DENSITY of MATERIAL needs a value"));
}

TEST_F(UnknownArguments, of_every_command_are_errors_that_name_them) {
  int walked = 0;
  for (const CommandKind& row : command_catalogue()) {
    // The two that take any name, and what a comment behind STOP may say.
    if (row.use == CommandUse::refused || row.name == "HELP" || row.name == "STOP" || row.summary.empty()) continue;
    ++walked;
    for (const std::string written : {"QQZZQQ", "QQZZQQ=3"}) {
      const auto parsed =
          parse_commands(std::make_shared<const SourceText>("m.acf", fmt::format("{}/{}\n", row.name, written)));
      const bool classes = !row.classes.empty();
      std::string said = render(parsed.diagnostics);
      if (classes) said += run(model(""), fmt::format("{}/{}\n", row.name, written)).err;
      EXPECT_THAT(said, AllOf(HasSubstr("error: "), HasSubstr("^~~~~~"))) << row.name;
      EXPECT_THAT(said, ::testing::AnyOf(HasSubstr("has no argument QQZZQQ"), HasSubstr("takes no arguments"),
                                         HasSubstr("QQZZQQ is no class")))
          << row.name;
    }
  }
  EXPECT_GT(walked, 15);
  const auto stop = parse_commands(std::make_shared<const SourceText>("m.acf", "STOP/QQZZQQ\n"));
  EXPECT_THAT(render(stop.diagnostics), HasSubstr("STOP takes no arguments"));
}

TEST_F(UnknownArguments, of_definitions_by_command_are_errors_that_name_them) {
  const std::string dataset = model(
      "SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1\nVARIABLE/1, FUNCTION=1\nREQUEST/1, F2=TIME\n"
      "MREQUEST/1, DISPLACEMENT, PARTS=2\nMATERIAL/1, DENSITY=1\nSENSOR/1, FUNCTION=TIME, VALUE=9, GE, PRINT\n");
  for (const std::string name :
       {"PART", "MARKER", "JOINT", "SPRINGDAMPER", "VARIABLE", "REQUEST", "MREQUEST", "SENSOR"}) {
    EXPECT_THAT(run(dataset, name + "/1, QQZZQQ=3\n").err,
                HasSubstr(fmt::format("error: {} has no argument QQZZQQ [unknown-argument]", name)));
  }
  EXPECT_THAT(run(dataset, "MATERIAL/1, DENSITTY=3\n").err, HasSubstr("did you mean DENSITY?"));
}

// What an MREQUEST names may be missing: a model does without it.
TEST_F(UnknownArguments, of_requests_do_not_leave_them_out) {
  const RunResult r = run(model("MREQUEST/1, PARTS=2, DISPLACEMENT, COMENT=foo\n"), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, AllOf(HasSubstr(":7:36: error: MREQUEST has no argument COMENT [unknown-argument]"),
                           HasSubstr("      |                                    ^~~~~~\n"),
                           HasSubstr("hint: did you mean COMMENT?"), Not(HasSubstr("left out"))));
  const RunResult missing = run(model("MREQUEST/1, JOINTS=7, DISPLACEMENT\n"), "LINEAR/EIGENSOL\n");
  EXPECT_EQ(missing.status, 0) << missing.err;
  EXPECT_THAT(missing.err, HasSubstr("warning: MREQUEST/1 is left out"));
}

}  // namespace
}  // namespace dynalin::cases::unknown_argument_test
