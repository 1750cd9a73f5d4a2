#include "model/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>

#include "base/enumeration.h"

namespace dynalin {

std::optional<Span> ElementReader::at_argument(std::string_view argument) const {
  for (const Assignment& a : assignments) {
    if (a.name == argument) return a.at;
  }
  return std::nullopt;
}

Span ElementReader::at(std::string_view argument) const { return at_argument(argument).value_or(statement_->at); }

namespace {

// Commands and settings have no id.
std::string owner_of(const ElementReader& r) {
  return r.label().id > 0 ? r.label().text() : std::string(r.label().statement);
}

bool check_range(double value, const WrittenArgument& w, const ValueLimits& limits, ElementReader& r) {
  if (value >= limits.minimum && value <= limits.maximum) return true;
  const bool low = !(value >= limits.minimum);
  const std::string owner = owner_of(r);
  r.error("value-out-of-range", w.value_span(),
          fmt::format("{} of {} is {}, it must be at {} {}", limits.argument, owner, value, low ? "least" : "most",
                      low ? limits.minimum : limits.maximum));
  return false;
}

}  // namespace

bool read_value(double& slot, const WrittenArgument& w, const ValueLimits& limits, ElementReader& r) {
  const auto v = read_real(w, *w.name.source, r.diagnostics());
  if (!v || !check_range(*v, w, limits, r)) return false;
  slot = *v;
  return true;
}

bool read_value(ElsewhereOnly&, const WrittenArgument& w, const ValueLimits& limits, ElementReader& r) {
  r.error("unexpected-argument", w.name,
          fmt::format("{} does not go with this type of {}", limits.argument, r.label().statement));
  return false;
}

bool read_value(std::optional<double>& slot, const WrittenArgument& w, const ValueLimits& limits, ElementReader& r) {
  double v = 0;
  if (!read_value(v, w, limits, r)) return false;
  slot = v;
  return true;
}

bool read_value(Vector& slot, const WrittenArgument& w, const ValueLimits&, ElementReader& r) {
  const auto v = read_reals(w, *w.name.source, r.diagnostics(), 3);
  if (!v) return false;
  slot = {(*v)[0], (*v)[1], (*v)[2]};
  return true;
}

bool read_value(std::optional<Vector>& slot, const WrittenArgument& w, const ValueLimits& limits, ElementReader& r) {
  Vector v;
  if (!read_value(v, w, limits, r)) return false;
  slot = v;
  return true;
}

bool read_value(std::vector<double>& slot, const WrittenArgument& w, const ValueLimits&, ElementReader& r) {
  auto v = read_reals(w, *w.name.source, r.diagnostics());
  if (!v) return false;
  slot = std::move(*v);
  return true;
}

bool read_value(std::vector<std::vector<double>>& slot, const WrittenArgument& w, const ValueLimits& limits,
                ElementReader& r) {
  return read_value(slot.emplace_back(), w, limits, r);
}

bool read_value(std::optional<std::int64_t>& slot, const WrittenArgument& w, const ValueLimits& limits,
                ElementReader& r) {
  const auto v = read_integer(w, *w.name.source, r.diagnostics());
  if (!v || !check_range(static_cast<double>(v->value), w, limits, r)) return false;
  slot = v->value;
  return true;
}

bool read_value(MarkerId& slot, const WrittenArgument& w, const ValueLimits& limits, ElementReader& r) {
  const auto v = read_integer(w, *w.name.source, r.diagnostics());
  if (!v) return false;
  const auto id = r.marker(*v, limits.argument);
  if (!id) return false;
  slot = *id;
  return true;
}

bool read_value(BodyId& slot, const WrittenArgument& w, const ValueLimits& limits, ElementReader& r) {
  const auto v = read_integer(w, *w.name.source, r.diagnostics());
  if (!v) return false;
  const auto id = r.body(limits.argument, *v);
  if (!id) return false;
  slot = *id;
  return true;
}

bool read_value(WordOrCount& slot, const WrittenArgument& w, const ValueLimits& limits, ElementReader& r) {
  slot.given = true;
  return !w.has_value || read_value(slot.count, w, limits, r);
}

bool read_value(OptionalWord& slot, const WrittenArgument& w, const ValueLimits&, ElementReader& r) {
  slot.given = true;
  if (!w.has_value) return true;
  const auto word = read_word(w, *w.name.source, r.diagnostics());
  if (word) slot.word = std::string(word->text());
  return word.has_value();
}

bool read_value(UserSubroutine& slot, const WrittenArgument& w, const ValueLimits& limits, ElementReader& r) {
  if (w.damaged) return false;  // reported when the text was read
  static constexpr std::array<std::string_view, 1> user = {"USER"};
  const std::string owner = owner_of(r);
  const Span first = w.value().empty() ? w.value_span() : Span{w.name.source, w.value()[0].offset, w.value()[0].length};
  if (find_keyword(first.text(), user)) {
    r.error("function-not-built", first,
            fmt::format("{} calls the user subroutine {}; user subroutines are not available", owner, slot.name));
  } else {
    r.error("unknown-word", first,
            fmt::format("{} of {} is USER(…), the call of a subroutine {}, and no expression", limits.argument, owner,
                        slot.name));
  }
  return false;
}

bool read_value(ElementHandle& slot, std::string_view statement, const WrittenArgument& w, ElementReader& r) {
  const auto v = read_integer(w, *w.name.source, r.diagnostics());
  if (!v) return false;
  const auto handle = r.element(statement, *v);
  if (!handle) return false;
  slot = *handle;
  return true;
}

bool read_value(std::vector<ElementHandle>& slot, std::string_view statement, const WrittenArgument& w,
                ElementReader& r) {
  const auto ids = read_integers(w, *w.name.source, r.diagnostics());
  if (!ids) return false;
  bool ok = true;
  for (const WrittenInteger& id : *ids) {
    const auto handle = r.element(statement, id);
    ok = ok && handle.has_value();
    slot.push_back(handle.value_or(ElementHandle{}));
  }
  return ok;
}

bool read_value(std::vector<std::int64_t>& slot, const WrittenArgument& w, const ValueLimits&, ElementReader& r) {
  const auto ids = read_integers(w, *w.name.source, r.diagnostics());
  if (!ids) return false;
  slot.clear();
  for (const WrittenInteger& id : *ids) slot.push_back(id.value);
  return true;
}

bool read_value(Expression& slot, const WrittenArgument& w, const ValueLimits&, ElementReader& r) {
  auto e = r.expression(w);
  if (!e) return false;
  slot = std::move(*e);
  return true;
}

bool read_value(VectorExpression& slot, const WrittenArgument& w, const ValueLimits&, ElementReader& r) {
  auto v = r.vector_expression(w);
  if (!v) return false;
  slot = std::move(*v);
  return true;
}

bool read_value(std::string& slot, const WrittenArgument& w, const ValueLimits&, ElementReader& r) {
  // Where nothing may stand for a text, it was warned of when it was read.
  if (w.has_value && !w.damaged && w.value().empty()) {
    slot.clear();
    return true;
  }
  auto text = read_text(w, *w.name.source, r.diagnostics());
  if (!text) return false;
  slot = std::move(*text);
  return true;
}

bool read_value(std::vector<std::string>& slot, const WrittenArgument& w, const ValueLimits&, ElementReader& r) {
  const auto words = read_words(w, *w.name.source, r.diagnostics());
  if (!words) return false;
  slot.clear();
  for (const Span& word : *words) {
    std::string upper(word.text());
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    slot.push_back(std::move(upper));
  }
  return true;
}

namespace {

// The argument whose value ends right before a bare word, without a comma between them.
const WrittenArgument* goes_on_from(const WrittenArgument& word, const ElementReader& r) {
  const auto& all = r.statement().arguments;
  const WrittenArgument *const first = all.data(), *const end_of_all = first + all.size();
  if (word.has_value || !std::less<>()(first, &word) || !std::less<>()(&word, end_of_all)) return nullptr;
  const WrittenArgument& before = *(&word - 1);
  if (!before.has_value || before.name.source != word.name.source) return nullptr;
  const Span value = before.value_span();
  const std::uint32_t end = value.offset + value.length;
  if (end > word.name.offset) return nullptr;
  const std::string_view between = word.name.source->text().substr(end, word.name.offset - end);
  return between.find(',') == std::string_view::npos ? &before : nullptr;
}

// LABEL says something to people, in any statement; one remark stands for all.
bool is_label(const WrittenArgument& written, std::span<const std::string_view> names, ElementReader& r) {
  static constexpr std::array<std::string_view, 1> label = {"LABEL"};
  const std::string_view name = written.name.text();
  if (!written.has_value || name.size() != label[0].size() || !find_keyword(name, label)) return false;
  if (std::ranges::find(names, label[0]) != names.end()) return false;
  if (!r.label_is_known)
    r.warning("obsolete-argument", written.name, "LABEL names nothing and is passed over, here and wherever it stands",
              "the name of an element is in the comment before it: ! adams_view_name='…'");
  r.label_is_known = true;
  return true;
}

}  // namespace

namespace detail {

std::optional<std::size_t> find_argument(const WrittenArgument& written, std::span<const ArgumentInfo> infos,
                                         std::span<const std::string_view> names, ElementReader& r) {
  // The word that chose the variant was recorded when the kind was found.
  for (const auto& a : r.assignments) {
    if (a.at.offset == written.name.offset && a.at.source == written.name.source) return infos.size();
  }
  if (is_label(written, names, r)) return infos.size();
  std::vector<std::string_view> tied;
  const auto k = find_keyword(written.name.text(), names, &tied);
  const std::string_view owner = r.label().statement;
  if (!k) {
    if (!tied.empty()) {
      r.error("ambiguous-argument", written.name,
              fmt::format("{} of {} could be {}", written.name.text(), owner, enumeration(tied, "or")));
      return std::nullopt;
    }
    const auto near = nearest_word(written.name.text(), names);
    if (const WrittenArgument* before = goes_on_from(written, r)) {
      r.error("unknown-argument", written.name, fmt::format("{} has no argument {}", owner, written.name.text()),
              fmt::format("an operator or parentheses are missing before it if it belongs to {}", before->name.text()));
      return std::nullopt;
    }
    r.error("unknown-argument", written.name, fmt::format("{} has no argument {}", owner, written.name.text()),
            near.empty() ? fmt::format("its arguments are {}", fmt::join(names, ", "))
                         : fmt::format("did you mean {}?", near));
    return std::nullopt;
  }
  const ArgumentInfo& info = infos[*k];
  // One that repeats is known by its first, so that there are never more to search than the statement has arguments.
  if (!r.given(info.name)) {
    r.assignments.push_back({info.name, written.name});
  } else if (!info.repeats) {
    r.error("duplicate-argument", written.name, fmt::format("{} of {} is given twice", info.name, owner_of(r)));
    return std::nullopt;
  }
  if (info.is_flag && written.has_value) {
    r.error("unexpected-value", written.name, fmt::format("{} of {} takes no value", info.name, owner));
    return std::nullopt;
  }
  if (!info.is_flag && !info.value_optional && !written.has_value) {
    r.error("missing-value", written.name,
            fmt::format("{} of {} needs a value: {}", info.name, owner, info.value_text()), std::string(info.help));
    return std::nullopt;
  }
  return k;
}

void warn_of_degrees(std::string_view argument, const Unit& unit, const WrittenArgument& written, ElementReader& r) {
  if (unit.empty() || unit.has_angle) return;
  const auto value = written.value();
  const auto degrees = std::find_if(value.begin(), value.end(), [](const Token& t) { return t.degrees; });
  if (degrees == value.end()) return;
  r.warning("degrees-without-angle", {&r.source(), degrees->offset, degrees->length},
            fmt::format("D means degrees, and {} is no angle: its number is multiplied by π/180", argument),
            fmt::format("{} takes [{}]; write E for an exponent", argument, unit.text));
}

bool check_required(std::span<const ArgumentInfo> infos, ElementReader& r) {
  if (r.statement().damaged) return false;  // what looks missing may stand in the part that could not be read
  bool ok = true;
  for (const ArgumentInfo& info : infos) {
    if (!info.required || r.given(info.name)) continue;
    r.error("missing-argument", r.statement().at, fmt::format("{} needs {}", owner_of(r), info.name),
            info.help.empty() ? std::string() : std::string(info.help));
    ok = false;
  }
  return ok;
}

}  // namespace detail
}  // namespace dynalin
