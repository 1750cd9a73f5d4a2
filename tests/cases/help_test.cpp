// dynalin help and dynalin explain: every name has a page, every code has advice, slips find what was meant.
#include "command/help.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <regex>

#include "base/diagnostics.h"
#include "cases/run.h"
#include "command/command_catalogue.h"
#include "command/commands.h"
#include "elements/catalogue.h"
#include "expression/function_manual.h"
#include "places/source_tree.h"

namespace dynalin::cases::help_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Printed {
  int status = -1;
  std::string out, err;
};
Printed help(std::string_view name) {
  std::ostringstream out, err;
  const int status = print_help(name, out, err);
  return {status, out.str(), err.str()};
}
Printed explain(std::string_view code) {
  std::ostringstream out, err;
  const int status = print_explanation(code, out, err);
  return {status, out.str(), err.str()};
}
std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

TEST(Help, lists_statements_commands_and_functions) {
  const Printed all = help("");
  EXPECT_EQ(all.status, done);
  for (const Kind* kind : catalogue()) EXPECT_THAT(all.out, HasSubstr(std::string(kind->statement)));
  for (const CommandKind& row : command_catalogue()) EXPECT_THAT(all.out, HasSubstr(std::string(row.name)));
  for (const FunctionEntry& f : function_manual()) EXPECT_THAT(all.out, HasSubstr(std::string(f.name)));
  for (const auto title : {"Statements of a dataset", "Commands", "Functions of expressions", "not available yet"})
    EXPECT_THAT(all.out, HasSubstr(title));
  EXPECT_LT(count(all.out, "\n"), 150u);
  EXPECT_THAT(all.out, HasSubstr("  settings and output\n    OUTPUT "));
  EXPECT_THAT(all.out, HasSubstr("  read, without effect\n    LSOLVER FEMDATA SECTION FE_NODE TIMGRAPHICS\n"));
}

TEST(Help, has_a_page_for_every_name) {
  for (const Kind* kind : catalogue()) {
    EXPECT_EQ(help(kind->statement).status, done) << kind->statement;
    if (!kind->variant.empty()) {
      EXPECT_THAT(help(kind->variant).out, HasSubstr(std::string(kind->variant)));
    }
  }
  for (const CommandKind& row : command_catalogue()) EXPECT_EQ(help(row.name).status, done) << row.name;
  for (const FunctionEntry& f : function_manual()) {
    EXPECT_THAT(help(f.name).out, HasSubstr(std::string(f.name))) << f.name;
  }
}

TEST(Help, shows_all_statements_that_have_a_type) {
  EXPECT_THAT(help("TRANSLATIONAL").out,
              AllOf(HasSubstr("JOINT/id"), HasSubstr("SFORCE/id"), HasSubstr("SPRINGDAMPER/id")));
}

TEST(Help, says_what_an_argument_belongs_to) {
  EXPECT_THAT(help("eigensol").out,
              AllOf(HasSubstr("EIGENSOL is an argument of\n  LINEAR (command)\n"), HasSubstr("eigenvalues")));
  EXPECT_THAT(help("JFLOAT").out, AllOf(HasSubstr("  VFORCE\n"), HasSubstr("  PTCV\n"), Not(HasSubstr("command"))));
  for (const CommandKind& row : command_catalogue()) {
    for (const ArgumentInfo& a : row.arguments) {
      if (a.name == "class") continue;  // stands for the names of classes
      EXPECT_EQ(help(a.name).status, done) << row.name << ' ' << a.name;
    }
  }
}

TEST(Help, shows_what_a_function_takes) {
  const Printed step = help("step");
  EXPECT_EQ(step.status, done);
  EXPECT_THAT(step.out, AllOf(HasSubstr("STEP(x, x0, h0, x1, h1)"), HasSubstr("where it begins and ends"),
                              HasSubstr("[as h0, h1]")));
  EXPECT_THAT(help("DX").out, AllOf(HasSubstr("DX(i [, j [, k]])"), HasSubstr("[length]")));
  EXPECT_THAT(help("USER").out, AllOf(HasSubstr("compiled routine"), HasSubstr("ROUTINE=")));
  EXPECT_THAT(help("HSIZE").out, HasSubstr("length of the last step"));
  EXPECT_THAT(help("FXFREQ").out, HasSubstr("not available yet"));
}

// Names outside of brackets are required, those inside may be left out.
TEST(Help, agrees_with_the_argument_counts_of_functions) {
  for (const FunctionEntry& f : function_manual()) {
    if (!f.built) continue;
    EXPECT_FALSE(f.text.meaning.empty()) << f.name;
    const std::string_view text = f.text.arguments;
    const bool endless = text.find("…") != std::string_view::npos;
    std::size_t required = 0, all = 0, depth = 0;
    bool in_name = false;
    for (const char c : text) {
      depth += c == '[';
      depth -= c == ']';
      const bool letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
      if (letter && !in_name) ++all, required += depth == 0;
      in_name = letter;
    }
    EXPECT_EQ(required, f.minimum_arguments) << f.name;
    if (!endless) {
      EXPECT_EQ(all, f.maximum_arguments) << f.name;
    }
    EXPECT_TRUE(all == 0 || !f.text.unit.empty()) << f.name;
  }
}

TEST(Help, shows_shared_arguments_of_types_once) {
  const Printed joint = help("JOINT");
  EXPECT_EQ(count(joint.out, "marker on the first body"), 1u);
  EXPECT_EQ(count(joint.out, "\n    REVOLUTE "), 1u);
  EXPECT_EQ(count(joint.out, "obsolete, ignored"), 1u);
  // It is a statement, a command and a function.
  EXPECT_THAT(joint.out, AllOf(HasSubstr("JOINT/id, type"), HasSubstr("As a command"), HasSubstr("JOINT(id, jflag")));
  const Printed spring = help("springd");
  EXPECT_THAT(spring.out, AllOf(HasSubstr("arguments of TRANSLATIONAL"), HasSubstr("arguments of ROTATIONAL")));
  EXPECT_EQ(count(spring.out, "KT="), 1u);
}

TEST(Help, says_of_every_argument_of_an_analysis_what_it_does) {
  for (const auto name : {"LINEAR", "SIMULATE", "FILE", "ENVIRONMENT"}) {
    const CommandKind* row = find_command(name);
    ASSERT_TRUE(row);
    const std::string page = help(name).out;
    for (const ArgumentInfo& a : row->arguments) {
      EXPECT_FALSE(a.help.empty()) << name << '/' << a.name;
      EXPECT_THAT(page, HasSubstr(std::string(a.name)));
    }
  }
  EXPECT_THAT(help("lin").out, AllOf(HasSubstr("eigenvalues and mode shapes"), HasSubstr("LINEAR/EIGENSOL, RM=5")));
}

TEST(Help, has_text_for_arguments_of_elements) {
  for (const Kind* kind : catalogue()) {
    if (catalogue_group(*kind) == "settings and output") continue;
    EXPECT_FALSE(kind->summary.empty()) << kind->statement;
    for (const ArgumentInfo& a : kind->arguments) {
      EXPECT_TRUE(a.elsewhere || !a.help.empty()) << kind->statement << '/' << a.name;
    }
  }
}

TEST(Help, has_examples_of_commands_that_are_read) {
  for (const CommandKind& row : command_catalogue()) {
    if (row.example.empty()) continue;
    const auto parsed = parse_commands(std::make_shared<const SourceText>("example", std::string(row.example) + "\n"));
    EXPECT_EQ(parsed.diagnostics.has_errors(), row.use == CommandUse::refused) << row.example << '\n'
                                                                               << render(parsed.diagnostics);
  }
}

TEST(Help, takes_commands_as_they_are_written) {
  EXPECT_EQ(help("LINEAR/EIGENSOL").out, help("LINEAR").out);
  EXPECT_EQ(help("LINEAR/EIGENSOL").status, done);
}

TEST(Help, finds_types_and_arguments_by_their_beginning) {
  const Printed hinge = help("rev");
  EXPECT_EQ(hinge.status, done);
  EXPECT_THAT(hinge.out, AllOf(HasSubstr("JOINT/id, REVOLUTE, arguments\n"), HasSubstr("Hinge"),
                               HasSubstr("marker on the first body"), Not(HasSubstr("types\n"))));
  for (const auto name : {"joint revolute", "joint/revolute", "jo/rev", "JOINT/5, REVOLUTE, I=20", "JOINT, rev"})
    EXPECT_EQ(help(name).out, hinge.out) << name;
  EXPECT_THAT(help("spher").out, HasSubstr("JOINT/id, SPHERICAL"));
  EXPECT_THAT(help("sfor trans").out, AllOf(HasSubstr("SFORCE/id, TRANSLATIONAL"), Not(HasSubstr("JOINT"))));
  EXPECT_EQ(help("eigens").out, help("EIGENSOL").out);
  EXPECT_EQ(help("part/2, mass=3").out, help("PART").out);
  EXPECT_EQ(help("part/list").out, help("PART").out);
  EXPECT_EQ(help("deactivate/joint").out, help("DEACTIVATE").out);
  // Every type by itself, under each of its statements.
  for (const Kind* kind : catalogue()) {
    if (kind->variant.empty()) continue;
    const Printed page = help(fmt::format("{}/{}", kind->statement, kind->variant));
    EXPECT_EQ(page.status, done) << kind->variant;
    EXPECT_THAT(page.out, AllOf(HasSubstr(fmt::format("{}/id, {}", kind->statement, kind->variant)),
                                HasSubstr(std::string(kind->summary))));
  }
}

TEST(Help, says_what_a_beginning_could_be) {
  const Printed r = help("sp");
  EXPECT_EQ(r.status, wrong_usage);
  EXPECT_THAT(r.err, AllOf(HasSubstr("sp may be short for several names"), HasSubstr("SPLINE, SPRINGDAMPER"),
                           HasSubstr(" and SPHERICAL\n")));
  const Printed hinge = help("joint/hinge");
  EXPECT_EQ(hinge.status, wrong_usage);
  EXPECT_THAT(hinge.err, AllOf(HasSubstr("JOINT has no type or argument hinge"), HasSubstr("REVOLUTE, TRANSLATIONAL")));
  EXPECT_THAT(help("linear eigensoll").err,
              AllOf(HasSubstr("has no argument eigensoll"), HasSubstr("EIGENSOL exists")));
  EXPECT_THAT(help("nodampinn").err, HasSubstr("NODAMPIN exists"));
}

TEST(Help, names_what_is_near_to_an_unknown_word) {
  const Printed r = help("BUSHIGN");
  EXPECT_EQ(r.status, wrong_usage);
  EXPECT_THAT(r.err, AllOf(HasSubstr("no statement, command or function BUSHIGN"), HasSubstr("BUSHING")));
  EXPECT_THAT(help("AKISPLL").err, HasSubstr("AKISPL"));
  EXPECT_THAT(help("SIMULTE").err, HasSubstr("SIMULATE"));
  EXPECT_THAT(help("REVLUTE").err, HasSubstr("REVOLUTE"));
  EXPECT_THAT(help("qqqqqq").err, HasSubstr("dynalin help"));
}

TEST(Explain, lists_every_code_in_a_line) {
  const Printed all = explain("");
  EXPECT_EQ(all.status, done);
  for (const Explanation& e : explanations()) {
    EXPECT_EQ(count("\n" + all.out, "\n" + std::string(e.code) + " "), 1u) << e.code;
  }
}

TEST(Explain, says_more_than_the_message) {
  for (const Explanation& e : explanations()) {
    const Printed r = explain(e.code);
    EXPECT_EQ(r.status, done);
    EXPECT_THAT(r.out, AllOf(HasSubstr(std::string(e.text)), HasSubstr(std::string(e.advice))));
  }
  EXPECT_EQ(explain("[unknown-marker]").status, done);  // as it stands in a message
  EXPECT_EQ(explain("Unknown-MARKER").status, done);
  const Printed slip = explain("unknwon-marker");
  EXPECT_EQ(slip.status, wrong_usage);
  EXPECT_THAT(slip.err, HasSubstr("unknown-marker exists"));
}

TEST(Explain, finds_a_code_by_a_word_of_its_message) {
  const Printed list = explain("Drawn");
  EXPECT_EQ(list.status, done);
  EXPECT_THAT(list.out, AllOf(HasSubstr("\ndrawn-open "), HasSubstr("\nskew-axes "),
                              HasSubstr("says what to do about one of them"), Not(HasSubstr("unknown-marker"))));
  // One alone is explained.
  EXPECT_EQ(explain("DRAWN constraint").out, explain("drawn-open").out);
  for (const Explanation& e : explanations()) {
    const Printed r = explain(e.text);
    EXPECT_THAT(r.out, HasSubstr(std::string(e.code))) << e.text;
  }
  EXPECT_EQ(explain("statics found no point of rest").out, explain("no-equilibrium").out);
  EXPECT_EQ(explain("zyxwv").status, wrong_usage);
}

// A code that nothing reports has no business in the list, and every code that is reported is listed.
TEST(Explain, covers_the_codes_of_the_program) {
  const auto source = element_sources().parent_path();
  std::string all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source)) {
    const auto extension = entry.path().extension();
    if (extension != ".cpp" && extension != ".h") continue;
    if (entry.path().filename().string().ends_with("_test.cpp")) continue;
    all += read_file(entry.path());
  }
  for (const Explanation& e : explanations()) {
    EXPECT_NE(all.find('"' + std::string(e.code) + '"'), std::string::npos) << e.code << " is reported nowhere";
  }
  const std::regex reported(R"re((?:error|warning|problem)\(\s*"([a-z]+(?:-[a-z]+)+)")re");
  for (std::sregex_iterator it(all.begin(), all.end(), reported), end; it != end; ++it) {
    EXPECT_TRUE(find_explanation((*it)[1].str())) << (*it)[1].str() << " is not listed";
  }
}

}  // namespace
}  // namespace dynalin::cases::help_test
