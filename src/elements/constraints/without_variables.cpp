#include "elements/constraints/without_variables.h"

#include <fmt/format.h>

#include <algorithm>

#include "elements/controls/variable_list.h"

namespace dynalin {

namespace {

// Of an ARRAY, from 0.
std::size_t entry(const Atom& atom) { return static_cast<std::size_t>(atom.argument[1] - 1); }

}  // namespace

std::optional<Expression> WithoutVariables::of(const Expression& function) {
  const std::size_t before = diagnostics_.error_count();
  Expression without = function.with_definitions([&](const Atom& atom) { return definition(atom); });
  if (diagnostics_.error_count() > before) return std::nullopt;
  return without;
}

std::optional<Expression> WithoutVariables::definition(const Atom& atom) {
  if (readable_.reads(atom)) return std::nullopt;
  if (const auto number = constant(atom)) return Expression::constant(*number);
  const auto variable = variable_of(atom);
  if (!variable) {
    diagnostics_.error(
        readable_.code, atom.at,
        fmt::format("{} depends on {}, it may depend on {}", label_.text(), atom.at.text(), readable_.in_words));
    return std::nullopt;
  }
  if (std::find(within_.begin(), within_.end(), *variable) != within_.end()) {
    diagnostics_.error(readable_.code, atom.at,
                       fmt::format("{}, which {} follows, depends on itself", atom.at.text(), label_.text()));
    return std::nullopt;
  }
  model_.followed_in_time.push_back({&label_, *variable});
  within_.push_back(*variable);
  auto course = of(variable_function(model_, *variable));
  within_.pop_back();
  return course;
}

const Array* WithoutVariables::array_of(const Atom& atom) const {
  if (atom.function->reads != DataSource::array_entry) return nullptr;
  const auto handle = model_.find(atom.function->statement, atom.argument[0]);
  return handle ? model_.get<Array>(*handle) : nullptr;
}

std::optional<double> WithoutVariables::constant(const Atom& atom) const {
  const Array* array = array_of(atom);
  return array && entry(atom) < array->numbers.size() ? std::optional(array->numbers[entry(atom)]) : std::nullopt;
}

std::optional<VariableRef> WithoutVariables::variable_of(const Atom& atom) const {
  const auto handle = model_.find(atom.function->statement, atom.argument[0]);
  if (!handle) return std::nullopt;
  if (atom.function->reads == DataSource::value) return VariableRef{*handle};
  const Array* array = array_of(atom);
  const auto* list = atom.function->reads == DataSource::list_entry ? model_.get<VariableList>(*handle) : nullptr;
  const std::vector<VariableRef>* variables = array ? &array->variables : list ? &list->variables : nullptr;
  if (!variables || entry(atom) >= variables->size()) return std::nullopt;
  return (*variables)[entry(atom)];
}

}  // namespace dynalin
