#include "study/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

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

// Of the VARIABLE.
const BoundExpression& function_of(const System& system, std::int64_t id) {
  const Signals::Element variable = system.signals().element(*system.model().find(VariableClass::statement, id));
  return *variable.kernel->channels()->value_function(variable.index);
}

// Values of functions that read nothing but what the point has, as it was carried over: no unknowns come with them,
// nothing that is remembered or delayed. Nothing where an analysis has to find more.
std::optional<std::vector<double>> read_off(const StudyPoint& point, const StudyPoint& carried, std::int64_t first,
                                            std::size_t count) {
  const Layout &before = point.system->layout(), &now = carried.system->layout();
  const auto as_many = [](const auto& more, const auto& as) { return more.size() == as.size(); };
  if (!point.consistent || now.coordinate_count != before.coordinate_count || !as_many(now.rows, before.rows) ||
      !as_many(now.states, before.states) || !as_many(now.delay_calls, before.delay_calls) ||
      !as_many(now.memory_owners, before.memory_owners) || now.algebraic.size() != before.algebraic.size() + count)
    return std::nullopt;
  Motion motion = carried.system->motion(carried.values);
  ExpressionScratch scratch;
  std::vector<double> values;
  for (const bool again : {false, true}) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t id = first + static_cast<std::int64_t>(k);
      const double value = function_of(*carried.system, id).value(motion, scratch);
      if (!std::isfinite(value)) return std::nullopt;
      if (!again)
        values.push_back(value);
      else if (value != values[k])
        return std::nullopt;  // they read each other
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto variable =
          carried.system->model().find(VariableClass::statement, first + static_cast<std::int64_t>(k));
      motion.algebraic[static_cast<std::size_t>(carried.system->signals().variable({*variable}).index)] = values[k];
    }
  }
  return values;
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
  StudyPoint carried = continued(point, made.value.system, {});
  if (auto known = read_off(point, carried, first, functions.size())) return *std::move(known);
  auto found = initial_conditions(std::move(carried));
  if (!found) return tl::unexpected(found.error());
  std::vector<double> values;
  for (std::size_t k = 0; k < functions.size(); ++k)
    values.push_back(variable_value(system, found->point.values, first + static_cast<std::int64_t>(k)).value());
  return values;
}

}  // namespace dynalin
