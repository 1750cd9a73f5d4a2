// The manual says what the program does: pages are compared with the tables of the program, their examples are run.
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "cases/run.h"
#include "command/command_catalogue.h"
#include "elements/catalogue.h"
#include "elements/settings/analysis_settings.h"
#include "elements/settings/output_settings.h"
#include "expression/function_manual.h"
#include "places/source_tree.h"

namespace dynalin::cases::manual_test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path pages = element_pages();  // docs/elements
const fs::path docs = pages.parent_path();

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// The texts of the fences ```language.
std::vector<std::string> fences(const std::string& page, const std::string& language) {
  std::vector<std::string> list;
  bool inside = false, wanted = false;
  for (const std::string& line : lines_of(page)) {
    if (line.starts_with("```")) {
      inside = !inside;
      wanted = inside && line.substr(3) == language;
      if (wanted) list.emplace_back();
    } else if (wanted) {
      list.back() += line + "\n";
    }
  }
  return list;
}

class Manual : public Cases {};

// The picture of the first page: each of its lines, in this order.
TEST_F(Manual, shows_what_the_first_example_prints) {
  const auto pictures = fences(read_file(docs.parent_path() / "README.md"), "");
  ASSERT_EQ(pictures.size(), 1u);
  const RunResult r = run_example("rotating_slider", "rotating_slider.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr(pictures.front()));
}

TEST_F(Manual, runs_every_example_of_the_page_on_commands) {
  const std::string page = read_file(docs / "commands.md");
  const auto datasets = fences(page, "adm"), commands = fences(page, "acf");
  ASSERT_EQ(datasets.size(), 1u);
  ASSERT_GE(commands.size(), 4u);
  for (const std::string& c : commands) {
    const RunResult r = run(datasets.front(), c);
    EXPECT_EQ(r.status, 0) << c << r.err;
  }
}

// Whether a row of the page names the statement and the argument.
template <class Written>
void expect_passed_over(const std::string& page, const std::string& statement) {
  for (const auto& argument : Written::arguments) {
    if (std::ranges::find(Written::acting, argument.name) != Written::acting.end()) continue;
    const auto named = [&](const std::string& line) {
      return line.find("`" + statement + "`") != std::string::npos &&
             line.find("`" + std::string(argument.name) + "`") != std::string::npos;
    };
    EXPECT_TRUE(std::ranges::any_of(lines_of(page), named)) << statement << '/' << argument.name;
  }
}

TEST_F(Manual, lists_all_that_settings_pass_over) {
  const std::string page = read_file(docs / "not-built.md");
  expect_passed_over<WrittenEquilibrium>(page, "EQUILIBRIUM");
  expect_passed_over<WrittenInitialConditions>(page, "IC");
  expect_passed_over<WrittenKinematics>(page, "KINEMATICS");
  expect_passed_over<WrittenIntegrator>(page, "INTEGRATOR");
  expect_passed_over<WrittenOutput>(page, "OUTPUT");
  expect_passed_over<WrittenResults>(page, "RESULTS");
}

TEST_F(Manual, names_every_command_on_its_page) {
  const std::string page = read_file(docs / "commands.md");
  for (const CommandKind& row : command_catalogue()) {
    if (row.use == CommandUse::model && row.summary.empty()) continue;  // a statement that is defined anew
    EXPECT_THAT(page, HasSubstr(std::string(row.name))) << row.name;
  }
}

TEST_F(Manual, has_each_kind_of_element_in_its_index) {
  const std::string index = read_file(pages / "README.md");
  const auto rows = lines_of(index);
  std::set<std::string> linked;
  for (const Kind* kind : catalogue()) {
    if (catalogue_group(*kind) == "settings and output") {
      EXPECT_THAT(index, HasSubstr("`" + std::string(kind->statement) + "`"));
      continue;
    }
    const std::string type = kind->variant.empty() ? "" : "`" + std::string(kind->variant) + "`";
    const std::string begin = "| `" + std::string(kind->statement) + "` | " + type + " | [";
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& line) { return line.starts_with(begin); });
    ASSERT_NE(row, rows.end()) << "docs/elements/README.md lacks " << begin << "page](page.md) | " << kind->summary
                               << " |";
    EXPECT_TRUE(row->ends_with("| " + std::string(kind->summary) + " |")) << *row;
    const auto opening = row->find("](") + 2, closing = row->find(')', opening);
    linked.insert(row->substr(opening, closing - opening));
  }
  for (const auto& entry : fs::directory_iterator(pages)) {
    const std::string name = entry.path().filename().string();
    if (name != "README.md") {
      EXPECT_EQ(linked.erase(name), 1u) << name;
    }
  }
  EXPECT_TRUE(linked.empty()) << *linked.begin();
}

// Whatever the program refuses by name as not available is on the page of what is missing, and nothing else is.
TEST_F(Manual, names_all_that_is_not_built) {
  const std::string page = read_file(docs / "not-built.md");
  std::set<std::string_view> built;
  for (const Kind* kind : catalogue()) built.insert(kind->statement);
  for (const std::string_view name : statement_names()) {
    if (name == "END") continue;
    const bool named = page.find("`" + std::string(name) + "`") != std::string::npos;
    if (!built.contains(name)) {
      EXPECT_TRUE(named) << name;
    }
  }
  for (const FunctionEntry& f : function_manual()) {
    if (!f.built) {
      EXPECT_THAT(page, HasSubstr("`" + std::string(f.name)));
    }
  }
  for (const std::string& line : lines_of(page)) {
    if (!line.starts_with("| `") || line.find("| error |") == std::string::npos) continue;
    const std::string name = line.substr(3, line.find_first_of("`/", 3) - 3);
    if (!find_command(name)) {
      EXPECT_FALSE(built.contains(name)) << line;
    }
  }
}

// Every link of a page leads to a file.
TEST_F(Manual, has_no_dead_links) {
  std::vector<fs::path> files{docs.parent_path() / "README.md", docs.parent_path() / "CONTRIBUTING.md"};
  for (const auto& entry : fs::recursive_directory_iterator(docs)) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
  for (const fs::path& file : files) {
    const std::string text = read_file(file);
    for (auto at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
      target = target.substr(0, target.find('#'));
      if (target.empty() || target.starts_with("http") || target.find_first_of(" \n,") != std::string::npos) continue;
      EXPECT_TRUE(fs::exists(file.parent_path() / target)) << file << " links to " << target;
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::manual_test
