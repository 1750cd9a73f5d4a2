#include "study/measured.h"

#include <fmt/format.h>

#include <algorithm>

#include "elements/catalogue.h"
#include "system/operating_state.h"

namespace dynalin {

namespace {

StudyFailure failure(const Diagnostics& why) { return StudyFailure({"measuring", render(why), {}}); }

// The first of ids that no VARIABLE has.
std::int64_t first_free(const Dataset& base) {
  std::int64_t first = 1;
  for (const Statement& s : base.statements) {
    if (s.name == "VARIABLE" && s.id) first = std::max(first, std::int64_t{*s.id} + 1);
  }
  return first;
}

// A VARIABLE for each function, with ids from `first` on.
StudyResult<std::shared_ptr<const Dataset>> variables_of(std::span<const std::string> functions, std::int64_t first) {
  std::string text = "functions\n";
  for (std::size_t k = 0; k < functions.size(); ++k) {
    if (functions[k].find_first_of("\r\n") != std::string::npos)
      return tl::unexpected(StudyFailure({"measuring", "a function has several lines", {}}));
    text += fmt::format("VARIABLE/{}, FUNCTION={}\n", first + static_cast<std::int64_t>(k), functions[k]);
  }
  auto parsed = parse_dataset(std::make_shared<const SourceText>("functions", text + "END\n"));
  if (parsed.diagnostics.has_errors()) return tl::unexpected(failure(parsed.diagnostics));
  // A comma may begin another argument.
  for (std::size_t k = 0; k < functions.size(); ++k) {
    if (k >= parsed.value.statements.size() || parsed.value.statements[k].arguments.size() != 1)
      return tl::unexpected(StudyFailure({"measuring", fmt::format("'{}' is not one function", functions[k]), {}}));
  }
  return std::make_shared<const Dataset>(std::move(parsed.value));
}

std::shared_ptr<const Dataset> together(const std::shared_ptr<const Dataset>& base,
                                        const std::shared_ptr<const Dataset>& added) {
  auto all = std::make_shared<Dataset>();
  all->source = base->source;
  all->title = base->title;
  all->statements = base->statements;
  all->statements.insert(all->statements.end(), added->statements.begin(), added->statements.end());
  all->origins = {base, added};
  return all;
}

}  // namespace

StudyResult<std::vector<double>> measured(const StudyPoint& point, const std::shared_ptr<const Dataset>& statements,
                                          std::span<const std::string> functions, const ModelOptions& options) {
  const std::int64_t first = first_free(*statements);
  const auto variables = variables_of(functions, first);
  if (!variables) return tl::unexpected(variables.error());
  const auto made = edited_model({.system = point.system}, {{together(statements, *variables), {}}, {}}, options);
  if (made.diagnostics.has_errors()) return tl::unexpected(failure(made.diagnostics));
  const System& system = *made.value.system;
  auto found = initial_conditions(continued(point, made.value.system, {}));
  if (!found) return tl::unexpected(found.error());
  std::vector<double> values;
  for (std::size_t k = 0; k < functions.size(); ++k)
    values.push_back(variable_value(system, found->point.values, first + static_cast<std::int64_t>(k)).value());
  return values;
}

}  // namespace dynalin
