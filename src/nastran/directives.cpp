#include "nastran/directives.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "dataset/characters.h"
#include "nastran/directive_values.h"
#include "nastran/force_types.h"

namespace dynalin::nastran {

namespace {

struct Reason {
  unsigned bit;
  std::string_view text;
  bool (*holds)(Box, const ExportOptions&);
};
constexpr std::array<Reason, 11> reasons = {{
    {in_closed_box, "CLOSEDBOX", [](Box box, const ExportOptions&) { return box == Box::closed; }},
    {in_sol_107, "SOL 107", [](Box, const ExportOptions& o) { return o.solution_number == 107; }},
    {in_sol_108, "SOL 108", [](Box, const ExportOptions& o) { return o.solution_number == 108; }},
    {without_cbush, "export_cbush = no", [](Box, const ExportOptions& o) { return !o.export_cbush; }},
    {with_wireframe, "use_wireframe = yes", [](Box, const ExportOptions& o) { return o.use_wireframe; }},
    {outside_style_A, "file_name_style = B or C",
     [](Box, const ExportOptions& o) { return o.file_name_style != FileStyle::A; }},
    {in_style_B, "file_name_style = B", [](Box, const ExportOptions& o) { return o.file_name_style == FileStyle::B; }},
    {outside_style_C, "file_name_style = A or B",
     [](Box, const ExportOptions& o) { return o.file_name_style != FileStyle::C; }},
    {with_adams_ids, "use_adams_ids = yes, but for CLOSEDBOX",
     [](Box box, const ExportOptions& o) { return box == Box::open && o.use_adams_ids; }},
    {without_adams_ids, "use_adams_ids = no", [](Box, const ExportOptions& o) { return !o.use_adams_ids; }},
    {with_hess, "eigc_method = hess", [](Box, const ExportOptions& o) { return o.eigc_method == EigenMethod::hess; }},
}};

// Words of enumerations, in the order of their enumerators.
constexpr std::array<std::string_view, 2> yes_no = {"yes", "no"};
template <class E>
constexpr auto words_of = std::array<std::string_view, 0>{};
template <>
constexpr std::array<std::string_view, 2> words_of<Automset> = {"yes", "lusol"};
template <>
constexpr std::array<std::string_view, 2> words_of<EigenMethod> = {"hess", "clan"};
template <>
constexpr std::array<std::string_view, 3> words_of<Output> = {"plot", "punch", "both"};
template <>
constexpr std::array<std::string_view, 2> words_of<Spacing> = {"linear", "log"};
template <>
constexpr std::array<std::string_view, 3> words_of<FileStyle> = {"A", "B", "C"};

constexpr std::array<std::string_view, 2> unused_item_words = {"cbush", "grid"};
constexpr std::size_t longest_line = 64;   // behind SUBTITLE = there are as many columns of 72, about
constexpr std::size_t longest_suffix = 7;  // behind one letter

template <class... F>
struct Cases : F... {
  using F::operator()...;
};
template <class... F>
Cases(F...) -> Cases<F...>;  // clang 14 does not deduce it by itself

// Value and text of each kind of slot.
class Taker {
 public:
  Taker(const Directive& d, const WrittenValue& w, ExportOptions& to, Diagnostics& diagnostics)
      : d_(d), value_(w.value), to_(to), place_{d.name, diagnostics} {}

  void operator()(bool ExportOptions::*slot) const {
    if (const auto k = read_choice(value_, yes_no, place_)) to_.*slot = *k == 0;
  }
  void operator()(std::int64_t ExportOptions::*slot) const { take_integer(slot); }
  void operator()(std::optional<std::int64_t> ExportOptions::*slot) const { take_integer(slot); }
  void operator()(double ExportOptions::*slot) const { take_real(slot); }
  void operator()(std::optional<double> ExportOptions::*slot) const { take_real(slot); }
  void operator()(std::string ExportOptions::*slot) const {
    if (allowed(read_string(value_), value_)) to_.*slot = read_string(value_);
  }
  void operator()(std::optional<std::string> ExportOptions::*slot) const {
    if (allowed(read_string(value_), value_)) to_.*slot = read_string(value_);
  }
  void operator()(std::vector<std::string> ExportOptions::*slot) const {
    auto names = read_names(value_, place_);
    if (!names) return;
    const std::vector<Span> at = split_list(value_);
    for (std::size_t k = 0; k < names->size(); ++k) {
      if (!allowed((*names)[k], at[k])) return;
    }
    to_.*slot = std::move(*names);
  }
  void operator()(std::vector<IdRange> ExportOptions::*slot) const {
    if (auto ranges = read_ranges(value_, place_)) to_.*slot = std::move(*ranges);
  }
  void operator()(std::vector<ClanRegion> ExportOptions::*slot) const {
    if (const auto region = read_region(value_, place_)) (to_.*slot).push_back(*region);
  }
  void operator()(const Editables& e) const {
    const std::vector<Span> parts = split_list(value_);
    const std::size_t first = e.with_type ? 1 : 0;
    Editable made;
    if (parts.size() != first + 2) {
      place_.error(value_, fmt::format("{} takes {}, {} values are there", d_.name, values_text(d_), parts.size()));
      return;
    }
    if (e.with_type) {
      const auto type = read_choice(parts[0], force_types(), place_);
      if (!type) return;
      made.type = force_types()[*type];
    }
    if (e.by_name) {
      made.name = read_string(parts[first]);
      if (made.name.empty()) return place_.error(value_, fmt::format("{} takes a name, and it is empty", d_.name));
    } else {
      made.id = read_integer(parts[first], place_);
      if (!made.id) return;
    }
    made.suffix = read_string(parts[first + 1]);
    if (suffix_allowed(made.suffix, parts[first + 1])) (to_.*e.list).push_back(std::move(made));
  }
  template <class E>
  void operator()(E ExportOptions::*slot) const {
    if (const auto k = read_choice(value_, words_of<E>, place_)) to_.*slot = static_cast<E>(*k);
  }

 private:
  template <class T>
  void take_integer(T ExportOptions::*slot) const {
    const auto value = read_integer(value_, place_);
    if (!value) return;
    if (d_.name == "solution_number" && *value != 107 && *value != 108) {
      place_.error(value_, fmt::format("{} is 107 or 108, not {}", d_.name, *value));
    } else if (in_range(static_cast<double>(*value))) {
      to_.*slot = *value;
    }
  }
  template <class T>
  void take_real(T ExportOptions::*slot) const {
    const auto value = read_real(value_, place_);
    if (value && in_range(*value)) to_.*slot = *value;
  }
  bool in_range(double value) const {
    if (value >= d_.minimum && value <= d_.maximum) return true;
    place_.error(value_, value < d_.minimum
                             ? fmt::format("{} is at least {}, not {}", d_.name, d_.minimum, value_.text())
                             : fmt::format("{} is at most {}, not {}", d_.name, d_.maximum, value_.text()));
    return false;
  }
  bool suffix_allowed(const std::string& text, const Span& at) const {
    const bool sound = !text.empty() && text.size() <= longest_suffix &&
                       std::ranges::all_of(text, [](char c) { return is_letter(c) || is_digit(c); });
    if (!sound)
      place_.error(at, fmt::format("{} takes one to {} letters and digits for the end of names of matrices, not \"{}\"",
                                   d_.name, longest_suffix, text));
    return sound;
  }
  bool allowed(const std::string& text, const Span& at) const {
    switch (d_.rule) {
      case TextRule::any:
        return true;
      case TextRule::case_control_line:
        if (text.size() <= longest_line) return true;
        place_.error(at, fmt::format("{} has {} characters, {} fit into the line", d_.name, text.size(), longest_line));
        return false;
      case TextRule::matrix_suffix:
        return suffix_allowed(text, at);
      case TextRule::file_extension:
        if (text.find('/') == std::string::npos) return true;
        place_.error(at, fmt::format("{} is the end of a file name, without a folder", d_.name));
        return false;
      case TextRule::unused_items:
        return read_choice(at, unused_item_words, place_).has_value();
    }
    return true;
  }

  const Directive& d_;
  const Span& value_;
  ExportOptions& to_;
  ValuePlace place_;
};

}  // namespace

std::string ignored_text(unsigned ignored) {
  std::vector<std::string_view> texts;
  for (const Reason& r : reasons) {
    if (ignored & r.bit) texts.push_back(r.text);
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

unsigned holding(unsigned ignored, Box box, const ExportOptions& options) {
  unsigned hold = never;
  for (const Reason& r : reasons) {
    if ((ignored & r.bit) && r.holds(box, options)) hold |= r.bit;
  }
  return hold;
}

std::span<const DirectiveGroup> directive_groups() {
  static const std::array<DirectiveGroup, 5> groups = {{
      {"What is solved", solution_directives(), {}},
      {"Frequency response", response_directives(), response_blocks()},
      {"What is exported, and as what", item_directives(), {}},
      {"Numbers of cards", number_directives(), {}},
      {"Text and files", file_directives(), {}},
  }};
  return groups;
}

const Directive* find_directive(std::string_view name) {
  for (const DirectiveGroup& group : directive_groups()) {
    for (const Directive& d : group.directives) {
      if (d.name == name || (!d.also.empty() && d.also == name)) return &d;
    }
  }
  return nullptr;
}

const Block* find_block(std::string_view name) {
  for (const DirectiveGroup& group : directive_groups()) {
    for (const Block& b : group.blocks) {
      if (b.name == name) return &b;
    }
  }
  return nullptr;
}

std::vector<std::string_view> directive_names() {
  std::vector<std::string_view> names = {"verbatim"};
  for (const DirectiveGroup& group : directive_groups()) {
    for (const Directive& d : group.directives) names.push_back(d.name);
    for (const Block& b : group.blocks) names.push_back(b.name);
  }
  return names;
}

std::string values_text(const Directive& d) {
  const auto choice = [](auto words) { return fmt::format("{}", fmt::join(words, " | ")); };
  return std::visit(
      Cases{
          [&](bool ExportOptions::*) { return choice(yes_no); },
          [&](std::int64_t ExportOptions::*) {
            return std::string(d.name == "solution_number" ? "107 | 108" : "integer");
          },
          [](std::optional<std::int64_t> ExportOptions::*) { return std::string("integer"); },
          [](double ExportOptions::*) { return std::string("real"); },
          [](std::optional<double> ExportOptions::*) { return std::string("real"); },
          [](std::string ExportOptions::*) { return std::string("string"); },
          [](std::optional<std::string> ExportOptions::*) { return std::string("string"); },
          [&](std::vector<std::string> ExportOptions::*) {
            return d.rule == TextRule::unused_items ? choice(unused_item_words) + ", both with a comma" : "names";
          },
          [](std::vector<IdRange> ExportOptions::*) { return std::string("ids and ranges: 1, 3, 45-52"); },
          [](std::vector<ClanRegion> ExportOptions::*) { return std::string("five reals and an integer"); },
          [](const Editables& e) {
            return fmt::format("{}{}, suffix", e.with_type ? "type, " : "", e.by_name ? "name" : "id");
          },
          [&]<class E>(E ExportOptions::*) { return choice(words_of<E>); },
      },
      d.slot);
}

std::string fallback_text(const Directive& d) {
  if (!d.fallback.empty()) return std::string(d.fallback);
  const ExportOptions defaults;
  return std::visit(Cases{
                        [&](bool ExportOptions::*slot) { return std::string(defaults.*slot ? "yes" : "no"); },
                        [&](std::int64_t ExportOptions::*slot) { return std::to_string(defaults.*slot); },
                        [&](double ExportOptions::*slot) { return fmt::format("{}", defaults.*slot); },
                        [&](std::string ExportOptions::*slot) { return defaults.*slot; },
                        [&]<class T>(std::optional<T> ExportOptions::*) { return std::string(); },
                        [&]<class T>(std::vector<T> ExportOptions::*) { return std::string(); },
                        [](const Editables&) { return std::string(); },
                        [&]<class E>(E ExportOptions::*slot) {
                          return std::string(words_of<E>[static_cast<std::size_t>(defaults.*slot)]);
                        },
                    },
                    d.slot);
}

void store(const Directive& d, const WrittenValue& written, ExportOptions& to, Diagnostics& diagnostics) {
  const bool blank_has_meaning = d.name == "include_directory" || d.rule == TextRule::case_control_line;
  if (written.value.length == 0 && !blank_has_meaning) {
    ValuePlace{d.name, diagnostics}.error(written.key, fmt::format("{} has no value", d.name),
                                          fmt::format("{} = {}", d.name, values_text(d)));
    return;
  }
  std::visit(Taker(d, written, to, diagnostics), d.slot);
}

}  // namespace dynalin::nastran
