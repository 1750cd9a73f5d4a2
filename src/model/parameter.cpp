#include "model/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "model/kind_finder.h"

namespace dynalin {

namespace {

using Refusal = tl::unexpected<std::string>;

// One argument of a statement that is a number or a list of them.
struct Place {
  std::size_t statement;               // of the dataset
  std::string_view argument;           // its whole name
  bool is_list = false;                // of any length
  std::size_t count = 1;               // of numbers, where it is no list
  std::optional<std::size_t> written;  // among the arguments of the statement
};

bool is_number(const ArgumentInfo& a) { return a.value == "real" || a.value == "reals" || a.value == "x, y, z"; }

class Finder {
 public:
  Finder(const Dataset& dataset, Catalogue catalogue) : dataset_(dataset), kinds_(catalogue) {}

  tl::expected<Place, std::string> find(const ParameterRef& p) const {
    const auto& all = dataset_.statements;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Statement& s) {
      return s.name == p.element.statement && s.id.value_or(0) == p.element.id;
    });
    if (found == all.end()) return Refusal(fmt::format("{} does not exist", name_of(p.element)));
    Diagnostics unused;
    std::size_t variant = 0;
    const Kind* kind = kinds_.find(*found, variant, unused);
    if (!kind) return Refusal(fmt::format("{} is not read", name_of(p.element)));
    std::vector<std::string_view> names;
    for (const ArgumentInfo& a : kind->arguments) names.push_back(a.name);
    const auto k = find_keyword(p.argument, names);
    if (!k || kind->arguments[*k].elsewhere)
      return Refusal(fmt::format("{} has no argument {}", name_of(p.element), p.argument));
    const ArgumentInfo& a = kind->arguments[*k];
    if (!is_number(a)) {
      return Refusal(fmt::format("{} of {} is {}, no number", a.name, name_of(p.element),
                                 a.is_flag ? "a bare word" : fmt::format("{}", a.value)));
    }
    Place place{static_cast<std::size_t>(found - all.begin()), a.name, a.value == "reals", a.value == "real" ? 1u : 3u,
                std::nullopt};
    for (std::size_t i = 0; i < found->arguments.size(); ++i) {
      const auto which = find_keyword(found->arguments[i].name.text(), names);
      if (which && *which == *k) place.written = i;
    }
    if (p.index == 0 || (!place.is_list && p.index > place.count)) return Refusal(beyond(p, place.count));
    return place;
  }

  // All numbers of a written argument.
  tl::expected<std::vector<double>, std::string> numbers(const ParameterRef& p, const Place& place) const {
    if (!place.written) return Refusal(fmt::format("{} of {} is not stated", place.argument, name_of(p.element)));
    const WrittenArgument& w = dataset_.statements[place.statement].arguments[*place.written];
    Diagnostics problems;
    auto values = read_reals(w, *w.name.source, problems);
    if (!values) return Refusal(problems.items().front().message);
    if (p.index > values->size()) return Refusal(beyond(p, values->size()));
    return std::move(*values);
  }

 private:
  static std::string name_of(const ElementId& e) { return e.id == 0 ? e.statement : e.text(); }
  static std::string beyond(const ParameterRef& p, std::size_t count) {
    return fmt::format("{} of {} has {} value{}, none is number {}", p.argument, name_of(p.element), count,
                       count == 1 ? "" : "s", p.index);
  }

  const Dataset& dataset_;
  KindFinder kinds_;
};

}  // namespace

std::string ParameterRef::text() const {
  const std::string list = index == 1 ? "" : fmt::format("[{}]", index);
  return fmt::format("{} {}{}", element.id == 0 ? element.statement : element.text(), argument, list);
}

tl::expected<ParameterRef, std::string> parse_parameter(std::string_view text) {
  const auto wrong = [&] {
    return Refusal(fmt::format("'{}' names no parameter: STATEMENT/id ARGUMENT, or ARGUMENT[n] of a list", text));
  };
  const auto number = [](std::string_view digits, auto& into) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), into);
    return error == std::errc() && end == digits.data() + digits.size();
  };
  const std::size_t gap = text.find_first_of(" \t");
  if (gap == std::string_view::npos) return wrong();
  std::string_view element = text.substr(0, gap), argument = text.substr(gap);
  argument.remove_prefix(argument.find_first_not_of(" \t") == std::string_view::npos
                             ? argument.size()
                             : argument.find_first_not_of(" \t"));
  ParameterRef p;
  if (const std::size_t slash = element.find('/'); slash != std::string_view::npos) {
    if (!number(element.substr(slash + 1), p.element.id) || p.element.id < 1) return wrong();
    element = element.substr(0, slash);
  }
  p.element.statement = statement_name(element);
  if (p.element.statement.empty()) return wrong();
  if (argument.ends_with(']')) {
    const std::size_t open = argument.find('[');
    if (open == std::string_view::npos || !number(argument.substr(open + 1, argument.size() - open - 2), p.index) ||
        p.index < 1)
      return wrong();
    argument = argument.substr(0, open);
  }
  if (argument.empty() || argument.find_first_of(" \t/[],") != std::string_view::npos) return wrong();
  p.argument = argument;
  std::transform(p.argument.begin(), p.argument.end(), p.argument.begin(),
                 [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
  return p;
}

tl::expected<double, std::string> parameter(const Dataset& dataset, const ParameterRef& p, Catalogue catalogue) {
  const Finder finder(dataset, catalogue);
  const auto place = finder.find(p);
  if (!place) return Refusal(place.error());
  const auto values = finder.numbers(p, *place);
  if (!values) return Refusal(values.error());
  return (*values)[p.index - 1];
}

tl::expected<std::shared_ptr<const Dataset>, std::vector<std::string>> with_parameters(
    std::shared_ptr<const Dataset> base, std::span<const ParameterValue> changes, Catalogue catalogue) {
  const Finder finder(*base, catalogue);
  std::vector<std::string> problems;
  // All numbers of each argument that changes.
  struct Change {
    Place place;
    std::vector<double> values;
  };
  std::map<std::pair<std::size_t, std::string_view>, Change> arguments;
  for (const auto& [p, value] : changes) {
    const auto place = finder.find(p);
    if (!place) {
      problems.push_back(place.error());
      continue;
    }
    if (!std::isfinite(value)) {
      problems.push_back(fmt::format("{} is to be {}, which is no finite number", p.text(), value));
      continue;
    }
    const auto [it, fresh] = arguments.try_emplace({place->statement, place->argument}, Change{*place, {}});
    if (fresh) {
      const bool single = !place->written && !place->is_list && place->count == 1;
      auto values = single ? std::vector<double>{value} : finder.numbers(p, *place);
      if (!values) {
        problems.push_back(values.error());
        arguments.erase(it);
        continue;
      }
      it->second.values = std::move(*values);
    }
    if (p.index > it->second.values.size()) {
      problems.push_back(finder.numbers(p, *place).error());
      continue;
    }
    it->second.values[p.index - 1] = value;
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));

  // The new values as a text of their own, a statement for each argument.
  std::string text;
  for (const auto& [where, change] : arguments) {
    const Statement& s = base->statements[change.place.statement];
    text += s.id ? fmt::format("{}/{}, {}=", s.name, *s.id, change.place.argument)
                 : fmt::format("{}/{}=", s.name, change.place.argument);
    for (std::size_t k = 0; k < change.values.size(); ++k)
      text += fmt::format("{}{:.17g}", k == 0 ? "" : k % 4 == 0 ? ",\n, " : ", ", change.values[k]);
    text += '\n';
  }
  auto parsed =
      parse_statements(std::make_shared<const SourceText>("(parameters)", std::move(text)), statement_names());
  for (const Diagnostic& d : parsed.diagnostics.items()) problems.push_back(d.message);
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  const auto written = std::make_shared<const Dataset>(std::move(parsed.value));

  auto out = std::make_shared<Dataset>();
  out->source = base->source;
  out->title = base->title;
  out->statements = base->statements;
  out->origins = {base, written};
  std::size_t next = 0;
  for (const auto& [where, change] : arguments) {
    const WrittenArgument& replacement = written->statements[next++].arguments.front();
    auto& of = out->statements[change.place.statement].arguments;
    if (change.place.written) {
      of[*change.place.written] = replacement;
    } else {
      of.push_back(replacement);
    }
  }
  return out;
}

}  // namespace dynalin
