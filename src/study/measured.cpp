#include "study/measured.h"

#include <fmt/format.h>

#include <algorithm>

#include "elements/catalogue.h"
#include "system/operating_state.h"

namespace dynalin {

namespace {

// The dataset with a VARIABLE for each function, which have ids that no other one has.
std::shared_ptr<const Dataset> with_variables(const std::shared_ptr<const Dataset>& base,
                                              std::span<const std::string> functions, std::int64_t& first) {
  first = 1;
  for (const Statement& s : base->statements) {
    if (s.name == "VARIABLE" && s.id) first = std::max(first, std::int64_t{*s.id} + 1);
  }
  std::string text = "functions\n";
  for (std::size_t k = 0; k < functions.size(); ++k)
    text += fmt::format("VARIABLE/{}, FUNCTION={}\n", first + static_cast<std::int64_t>(k), functions[k]);
  auto parsed = parse_dataset(std::make_shared<const SourceText>("functions", text + "END\n"));
  const auto added = std::make_shared<const Dataset>(std::move(parsed.value));
  auto all = std::make_shared<Dataset>();
  all->source = base->source;
  all->title = base->title;
  all->statements = base->statements;
  all->statements.insert(all->statements.end(), added->statements.begin(), added->statements.end());
  all->origins = {base, added};
  return all;
}

StudyFailure failure(const Diagnostics& why) { return StudyFailure({"measuring", render(why), {}}); }

}  // namespace

StudyResult<std::vector<double>> measured(const StudyPoint& point, std::span<const std::string> functions,
                                          const ModelOptions& options) {
  std::int64_t first = 0;
  const auto dataset = with_variables(point.system->model().dataset, functions, first);
  const auto made = edited_model({.system = point.system}, {{dataset, {}}, {}}, options);
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
