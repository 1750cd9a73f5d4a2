#include "study/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "base/remark_of.h"
#include "elements/catalogue.h"
#include "system/operating_state.h"

namespace dynalin {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

StudyFailure failure(std::string why) { return StudyFailure({"measuring", std::move(why), {}, "unexpected-text"}); }

// A VARIABLE for each function, of which neither the model nor the functions know.
class Measuring {
 public:
  explicit Measuring(std::span<const std::string> functions) : functions_(functions) {}

  StudyResult<std::shared_ptr<const Dataset>> variables(const Dataset& base) {
    for (const std::string& f : functions_) {
      if (f.find_first_of("\r\n") != std::string::npos) return tl::unexpected(failure("a function has several lines"));
    }
    choose_ids(base);
    std::string text = "functions\n";
    for (std::size_t k = 0; k < functions_.size(); ++k) text += statement_before(k) + functions_[k] + '\n';
    source_ = std::make_shared<const SourceText>("functions", text + "END\n");
    auto parsed = parse_dataset(source_);
    if (parsed.diagnostics.has_errors()) return tl::unexpected(failure_of(parsed.diagnostics));
    // A comma may begin another argument.
    for (std::size_t k = 0; k < functions_.size(); ++k) {
      if (k >= parsed.value.statements.size() || parsed.value.statements[k].arguments.size() != 1)
        return tl::unexpected(failure(fmt::format("'{}' is not one function", functions_[k])));
    }
    return std::make_shared<const Dataset>(std::move(parsed.value));
  }
  const std::vector<std::int64_t>& ids() const { return ids_; }

  // What is wrong with them, at its place in the functions alone, one a line.
  StudyFailure failure_of(const Diagnostics& found) const {
    std::string lines;
    std::vector<std::size_t> begins;
    for (const std::string& f : functions_) begins.push_back(lines.size()), lines += f + '\n';
    const SourceText text("functions", lines);
    Diagnostics problems;
    for (const Diagnostic& d : found.items()) {
      Diagnostic& moved = d.severity == Severity::error ? problems.error(d.code, {}, in_own_words(d.message))
                                                        : problems.warning(d.code, {}, in_own_words(d.message));
      if (in_own_words(d.hint) == d.hint) moved.hint = d.hint;  // not what has an id near one of these
      if (d.at.source != source_.get()) {
        moved.at = d.at;
        continue;
      }
      const SourceText::Place place = d.at.source->place(d.at.offset);
      if (place.line < 2 || place.line > functions_.size() + 1) continue;  // neither the title nor END
      const std::size_t k = place.line - 2, before = statement_before(k).size() + 1;
      const std::size_t column = std::min(place.column - std::min(place.column, before), functions_[k].size());
      moved.at = {&text, static_cast<std::uint32_t>(begins[k] + column),
                  static_cast<std::uint32_t>(std::min<std::size_t>(d.at.length, functions_[k].size() - column))};
    }
    StudyFailure failure({"measuring", render(problems), {}, problems.items().front().code});
    failure.problems = remarks_of(problems);
    return failure;
  }
  // An analysis of them all has failed.
  StudyFailure failure_of(StudyFailure f) const {
    f.message = in_own_words(std::move(f.message));
    for (std::string& d : f.details) d = in_own_words(std::move(d));
    return f;
  }

 private:
  std::string variable(std::size_t k) const { return fmt::format("VARIABLE/{}", ids_[k]); }
  std::string statement_before(std::size_t k) const { return variable(k) + ", FUNCTION="; }

  // The largest that no VARIABLE has, and that no function could mean: none has that number in it.
  void choose_ids(const Dataset& base) {
    std::set<std::int64_t> taken;
    for (const Statement& s : base.statements) {
      if (s.name == "VARIABLE" && s.id) taken.insert(*s.id);
    }
    for (const std::string& f : functions_) {
      for (auto at = f.begin(); (at = std::find_if(at, f.end(), is_digit)) != f.end();) {
        const auto end = std::find_if_not(at, f.end(), is_digit);
        std::int64_t number = 0;
        std::from_chars(&*at, &*at + (end - at), number);  // 0 where it is too long for an id
        taken.insert(number);
        at = end;
      }
    }
    constexpr std::int64_t longest = 99'999'999;  // longer ones are warned of
    for (std::int64_t id = longest; ids_.size() < functions_.size(); --id) {
      if (!taken.contains(id)) ids_.push_back(id);
    }
  }

  std::string in_own_words(std::string text) const {
    for (std::size_t k = 0; k < functions_.size(); ++k) {
      const std::string name = variable(k), said = fmt::format("the function '{}'", functions_[k]);
      for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at)) {
        const std::size_t end = at + name.size();
        const bool is_longer_id = end < text.size() && is_digit(text[end]);
        if (!is_longer_id) text.replace(at, name.size(), said);
        at += is_longer_id ? name.size() : said.size();
      }
    }
    return text;
  }

  std::span<const std::string> functions_;
  std::vector<std::int64_t> ids_;
  SourceRef source_;
};

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
std::optional<std::vector<double>> read_off(const StudyPoint& point, const StudyPoint& carried,
                                            std::span<const std::int64_t> ids) {
  const Layout &before = point.system->layout(), &now = carried.system->layout();
  const auto as_many = [](const auto& more, const auto& as) { return more.size() == as.size(); };
  if (!point.consistent || now.coordinate_count != before.coordinate_count || !as_many(now.rows, before.rows) ||
      !as_many(now.states, before.states) || !as_many(now.delay_calls, before.delay_calls) ||
      !as_many(now.memory_owners, before.memory_owners) || now.algebraic.size() != before.algebraic.size() + ids.size())
    return std::nullopt;
  const Motion motion = carried.system->motion(carried.values);
  ExpressionScratch scratch;
  std::vector<double> values;
  for (const std::int64_t id : ids) {
    values.push_back(function_of(*carried.system, id).value(motion, scratch));
    if (!std::isfinite(values.back())) return std::nullopt;
  }
  return values;
}

}  // namespace

StudyResult<std::vector<double>> measured(const StudyPoint& point, const std::shared_ptr<const Dataset>& statements,
                                          std::span<const std::string> functions, const ModelOptions& options) {
  Measuring measuring(functions);
  const auto variables = measuring.variables(*statements);
  if (!variables) return tl::unexpected(variables.error());
  const auto made = edited_model({.system = point.system}, {{together(statements, *variables), {}}, {}}, options);
  if (made.diagnostics.has_errors()) return tl::unexpected(measuring.failure_of(made.diagnostics));
  const System& system = *made.value.system;
  StudyPoint carried = continued(point, made.value.system, {});
  if (auto known = read_off(point, carried, measuring.ids())) return *std::move(known);
  auto found = initial_conditions(std::move(carried));
  if (!found) return tl::unexpected(measuring.failure_of(std::move(found.error())));
  std::vector<double> values;
  for (const std::int64_t id : measuring.ids())
    values.push_back(variable_value(system, found->point.values, id).value());
  return values;
}

}  // namespace dynalin
