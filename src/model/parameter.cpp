#include "model/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "dataset/word_list.h"

namespace dynalin {

namespace {

using Refusal = tl::unexpected<Diagnostic>;

Refusal refusal(std::string_view code, std::string message, std::string hint = {}) {
  return Refusal(Diagnostic{Severity::error, code, {}, std::move(message), std::move(hint), {}});
}

std::string name_of(const ElementId& e) { return e.id == 0 ? e.statement : e.text(); }

// One argument of a statement that is a number or several.
struct Place {
  const Statement* statement = nullptr;  // nothing where the dataset need not have it
  const ArgumentInfo* argument = nullptr;
  std::vector<const WrittenArgument*> written{};  // several of one that repeats; empty where it is not stated
  std::string_view instead{};                     // an argument that is stated and excludes it
};

using Lists = std::vector<std::vector<double>>;

class Finder {
 public:
  Finder(const Dataset& dataset, Catalogue catalogue) : dataset_(dataset), kinds_(catalogue) {}

  tl::expected<Place, Diagnostic> find(const ParameterRef& p) const {
    Place place{statement_of(p.element), nullptr};
    const auto kind = kind_of(p, place.statement);
    if (!kind) return Refusal(kind.error());
    std::vector<std::string_view> names;
    for (const ArgumentInfo& a : (*kind)->arguments) names.push_back(a.name);
    const auto k = find_keyword(p.argument, names);
    if (k && (*kind)->arguments[*k].elsewhere) {
      const ArgumentInfo& of_another = (*kind)->arguments[*k];
      return refusal("unknown-argument", fmt::format("{} has no argument {}", name_of(p.element), of_another.name),
                     fmt::format("{} {}", of_another.name, of_another.help));
    }
    if (!k) {
      const std::string_view near = nearest_word(p.argument, names);
      return refusal("unknown-argument", fmt::format("{} has no argument {}", name_of(p.element), p.argument),
                     near.empty() ? fmt::format("its arguments are {}", fmt::join(names, ", "))
                                  : fmt::format("did you mean {}?", near));
    }
    place.argument = &(*kind)->arguments[*k];
    if (place.statement) {
      for (const WrittenArgument& w : place.statement->arguments) {
        const auto which = find_keyword(w.name.text(), names);
        if (which && *which == *k) place.written.push_back(&w);
        if (which && lists_word(place.argument->ends, names[*which])) place.instead = names[*which];
      }
    }
    if (!takes_numbers(*place.argument) && !is_written_number(place)) {
      return refusal("expected-number",
                     fmt::format("{} of {} is no number ({})", place.argument->name, name_of(p.element),
                                 place.argument->is_flag ? "a bare word" : place.argument->value_text()));
    }
    const std::size_t count = place.argument->count;
    if (p.list != 1 && !place.argument->repeats)
      return refusal("wrong-count", fmt::format("{} of {} is written once, none is number {}", place.argument->name,
                                                name_of(p.element), p.list));
    if (p.index == 0 || (count > 0 && p.index > count)) return beyond(p, count);
    return place;
  }

  // All numbers of the argument, list by list: as written, else what holds without it.
  tl::expected<Lists, Diagnostic> numbers(const ParameterRef& p, const Place& place) const {
    const std::optional<double> unstated = place.argument->unstated();
    if (place.written.empty() && unstated && place.argument->count > 0 && place.instead.empty())
      return Lists{std::vector<double>(place.argument->count, *unstated)};
    if (place.written.empty())
      return refusal("unstated-number", fmt::format("{} of {} is not stated", place.argument->name, name_of(p.element)),
                     place.instead.empty() ? std::string("what holds without it is no number of its own")
                                           : fmt::format("{} is, which stands instead of it", place.instead));
    Diagnostics problems;
    Lists lists;
    for (const WrittenArgument* w : place.written) {
      auto values = read_reals(*w, *w->name.source, problems);
      if (!values) return Refusal(problems.items().front());
      lists.push_back(std::move(*values));
    }
    return lists;
  }

  // Why the lists have no such number, nothing if they have it.
  static std::optional<Diagnostic> beyond(const ParameterRef& p, const Lists& lists) {
    if (p.list == 0 || p.list > lists.size()) {
      return refusal("wrong-count", fmt::format("{} of {} is written {} time{}, none is number {}", p.argument,
                                                name_of(p.element), lists.size(), lists.size() == 1 ? "" : "s", p.list))
          .value();
    }
    const std::size_t count = lists[p.list - 1].size();
    return p.index == 0 || p.index > count ? std::optional(beyond(p, count).value()) : std::nullopt;
  }

 private:
  // Of settings that are stated several times the last decides.
  const Statement* statement_of(const ElementId& e) const {
    const std::int64_t id = kinds_.needs_no_id(e.statement) ? 0 : e.id;
    const auto wanted = [&](const Statement& s) { return s.name == e.statement && kinds_.identity_of(s) == id; };
    const auto& all = dataset_.statements;
    const auto& kinds = kinds_.kinds_of(e.statement);
    if (!kinds.empty() && kinds.front()->role == Kind::Role::setting) {
      const auto last = std::find_if(all.rbegin(), all.rend(), wanted);
      return last == all.rend() ? nullptr : &*last;
    }
    const auto found = std::find_if(all.begin(), all.end(), wanted);
    return found == all.end() ? nullptr : &*found;
  }

  static bool is_written_number(const Place& place) {
    if (!may_be_number(*place.argument) || place.written.size() != 1 || !place.written.front()->has_value) return false;
    Diagnostics unread;
    const auto values = read_reals(*place.written.front(), *place.written.front()->name.source, unread);
    return values && values->size() == 1;
  }

  tl::expected<const Kind*, Diagnostic> kind_of(const ParameterRef& p, const Statement* statement) const {
    if (statement) {
      Diagnostics unread;
      std::size_t variant = 0;
      if (const Kind* kind = kinds_.find(*statement, variant, unread)) return kind;
      return Refusal(unread.items().front());
    }
    if (kinds_.needs_no_id(p.element.statement)) return kinds_.kinds_of(p.element.statement).front();
    return refusal("unknown-element", fmt::format("{} does not exist", name_of(p.element)), nearest_id(p.element));
  }

  std::string nearest_id(const ElementId& e) const {
    std::optional<std::int64_t> near;
    for (const Statement& s : dataset_.statements) {
      if (s.name == e.statement && s.id && (!near || std::abs(*s.id - e.id) < std::abs(*near - e.id))) near = s.id;
    }
    return near ? fmt::format("{}/{} exists", e.statement, *near) : std::string();
  }

  static Refusal beyond(const ParameterRef& p, std::size_t count) {
    return refusal("wrong-count", fmt::format("{} of {} has {} value{}, none is number {}", p.argument,
                                              name_of(p.element), count, count == 1 ? "" : "s", p.index));
  }

  const Dataset& dataset_;
  KindFinder kinds_;
};

// Whether a number is the next one behind a list that may have any length: IP[4] behind three.
bool grows(const ArgumentInfo& a, const ParameterRef& p, std::size_t length) {
  return a.count == 0 && p.index == length + 1;
}

// The new values of one argument, of one that repeats all its lists, as a statement of their own.
std::string statement_of(const ElementId& element, std::string_view argument, const Lists& lists) {
  std::string text = name_of(element);
  for (std::size_t n = 0; n < lists.size(); ++n) {
    text += fmt::format("{}{}=", n > 0 ? ",\n, " : element.id == 0 ? "/" : ", ", argument);
    const std::vector<double>& values = lists[n];
    for (std::size_t k = 0; k < values.size(); ++k)
      text += fmt::format("{}{:.17g}", k == 0 ? "" : k % 4 == 0 ? ",\n, " : ", ", values[k]);
  }
  return text + '\n';
}

}  // namespace

std::string ParameterRef::text() const {
  const std::string which = list == 1 ? "" : fmt::format("[{}]", list);
  const std::string number = list == 1 && index == 1 ? "" : fmt::format("[{}]", index);
  return fmt::format("{} {}{}{}", name_of(element), argument, which, number);
}

tl::expected<ParameterRef, Diagnostic> parse_parameter(std::string_view text) {
  const auto wrong = [&](std::string hint = {}) {
    return refusal("no-parameter", fmt::format("'{}' names no parameter", text),
                   hint.empty()
                       ? "STATEMENT/id ARGUMENT, ARGUMENT[n] of several numbers, ARGUMENT[m][n] of several lists"
                       : std::move(hint));
  };
  const auto number = [](std::string_view digits, auto& into) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), into);
    return error == std::errc() && end == digits.data() + digits.size();
  };
  const std::size_t gap = text.find_first_of(" \t");
  const std::size_t name = gap == std::string_view::npos ? gap : text.find_first_not_of(" \t", gap);
  if (name == std::string_view::npos) return wrong();
  std::string_view element = text.substr(0, gap), argument = text.substr(name);
  ParameterRef p;
  if (const std::size_t slash = element.find('/'); slash != std::string_view::npos) {
    if (!number(element.substr(slash + 1), p.element.id) || p.element.id < 1) return wrong();
    element = element.substr(0, slash);
  }
  p.element.statement = statement_name(element);
  if (p.element.statement.empty()) {
    const std::string_view near = nearest_word(element, statement_names());
    return wrong(near.empty() ? std::string() : fmt::format("did you mean {}?", near));
  }
  if (const std::size_t open = argument.find('['); open != std::string_view::npos) {
    const std::string_view places = argument.substr(open);
    const std::size_t next = places.find("][");
    const bool of_lists = next != std::string_view::npos;
    if (!places.ends_with(']') || (of_lists && (!number(places.substr(1, next - 1), p.list) || p.list < 1)))
      return wrong();
    const std::size_t digits = of_lists ? next + 2 : 1;
    if (!number(places.substr(digits, places.size() - digits - 1), p.index) || p.index < 1) return wrong();
    argument = argument.substr(0, open);
  }
  if (argument.empty() || argument.find_first_of(" \t/[],") != std::string_view::npos) return wrong();
  p.argument = argument;
  std::transform(p.argument.begin(), p.argument.end(), p.argument.begin(),
                 [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
  return p;
}

tl::expected<double, Diagnostic> parameter(const Dataset& dataset, const ParameterRef& p, Catalogue catalogue) {
  const Finder finder(dataset, catalogue);
  const auto place = finder.find(p);
  if (!place) return Refusal(place.error());
  const auto values = finder.numbers(p, *place);
  if (!values) return Refusal(values.error());
  if (const auto wrong = Finder::beyond(p, *values)) return Refusal(*wrong);
  return (*values)[p.list - 1][p.index - 1];
}

tl::expected<EditedDataset, Diagnostics> with_parameters(std::shared_ptr<const Dataset> base,
                                                         std::span<const ParameterChange> changes,
                                                         Catalogue catalogue) {
  const Finder finder(*base, catalogue);
  Diagnostics problems;
  const auto refuse = [&](const Diagnostic& d) { problems.error(d.code, d.at, d.message, d.hint); };
  // All numbers of each argument that changes.
  std::map<std::pair<ElementId, std::string_view>, Lists> arguments;
  for (const auto& [p, value] : changes) {
    const auto place = finder.find(p);
    if (!place) {
      refuse(place.error());
      continue;
    }
    if (!std::isfinite(value)) {
      refuse(refusal("value-out-of-range", fmt::format("{} is to be {}, which is no finite number", p.text(), value))
                 .value());
      continue;
    }
    Lists& lists = arguments[{p.element, place->argument->name}];
    if (lists.empty()) {
      const bool is_first =
          place->written.empty() && (place->argument->count == 1 || (p.list == 1 && grows(*place->argument, p, 0)));
      auto before = is_first ? Lists{{value}} : finder.numbers(p, *place);
      if (!before) {
        refuse(before.error());
        continue;
      }
      lists = std::move(*before);
    }
    if (p.list > 0 && p.list <= lists.size()) {
      std::vector<double>& list = lists[p.list - 1];
      if (grows(*place->argument, p, list.size())) list.push_back(value);
    }
    if (const auto missing = Finder::beyond(p, lists)) {
      refuse(*missing);
      continue;
    }
    lists[p.list - 1][p.index - 1] = value;
  }
  if (problems.has_errors()) return tl::unexpected(std::move(problems));

  std::string text;
  for (const auto& [argument, lists] : arguments) text += statement_of(argument.first, argument.second, lists);
  auto parsed =
      parse_statements(std::make_shared<const SourceText>("(parameters)", std::move(text)), statement_names());
  problems.append(std::move(parsed.diagnostics));
  const auto written = std::make_shared<const Dataset>(std::move(parsed.value));
  DatasetEditor editor(std::move(base), written, catalogue, problems);
  for (const Statement& s : written->statements) editor.redefine(s);
  if (problems.has_errors()) return tl::unexpected(std::move(problems));
  return std::move(editor).finish();
}

}  // namespace dynalin
