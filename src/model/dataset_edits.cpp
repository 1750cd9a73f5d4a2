#include "model/dataset_edits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>

#include "base/enumeration.h"
#include "dataset/word_list.h"
#include "model/model.h"

namespace dynalin {

namespace {

using Names = std::span<const std::string_view>;

std::string key(std::string_view statement, std::int64_t id) { return fmt::format("{}/{}", statement, id); }

bool contains(Names names, std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); }

// The argument of this kind that a written name means.
const ArgumentInfo* info_of(const Kind* kind, std::string_view word) {
  if (!kind) return nullptr;
  std::vector<std::string_view> names;
  for (const ArgumentInfo& info : kind->arguments) names.push_back(info.name);
  const auto k = find_keyword(word, names);
  return k ? &kind->arguments[*k] : nullptr;
}

// Its full name, or the word as written.
std::string_view full_name(const Kind* kind, std::string_view word) {
  const ArgumentInfo* info = info_of(kind, word);
  return info ? info->name : word;
}

bool is_variant(const WrittenArgument& w, Names variants, const Kind* kind) {
  if (variants.empty() || !find_keyword(w.name.text(), variants)) return false;
  const std::string_view name = full_name(kind, w.name.text());
  return !kind || std::none_of(kind->arguments.begin(), kind->arguments.end(),
                               [&](const ArgumentInfo& a) { return a.name == name && a.is_flag; });
}

// LIST prints what is defined, and changes nothing.
bool is_list(const WrittenArgument& w, const Kind* kind) {
  return full_name(kind, w.name.text()) == w.name.text() && w.name.length == 4 &&
         find_keyword(w.name.text(), std::array<std::string_view, 1>{"LIST"}).has_value();
}

// What may be meant by a word that is no class: one of several that begin so, a misspelt one, or any.
std::string class_hint(std::string_view word, Names classes) {
  std::vector<std::string_view> tied;
  if (find_keyword(word, classes, &tied)) tied.clear();
  if (!tied.empty()) return fmt::format("it could be {}", enumeration(tied, "or"));
  const std::string_view near = nearest_word(word, classes);
  return near.empty() ? fmt::format("one of {}", fmt::join(classes, ", ")) : fmt::format("did you mean {}?", near);
}

// Takes arguments that stood there before the edit out; their places stay until all are read.
template <class Wanted>
void end(Statement& target, std::size_t before, const Kind* kind, const Wanted& wanted) {
  for (std::size_t k = 0; k < before; ++k) {
    WrittenArgument& old = target.arguments[k];
    if (old.name.source && wanted(full_name(kind, old.name.text()))) old.name.source = nullptr;
  }
}

std::string text_of(const WrittenArgument& w) {
  std::string text;
  for (const Token& t : w.value()) text += fmt::format("{} ", Span{w.name.source, t.offset, t.length}.text());
  return text;
}

}  // namespace

DatasetEditor::DatasetEditor(std::shared_ptr<const Dataset> base, std::shared_ptr<const Dataset> written,
                             Catalogue catalogue, Diagnostics& diagnostics)
    : finder_(catalogue), base_(std::move(base)), out_(std::make_shared<Dataset>()), diagnostics_(diagnostics) {
  out_->source = base_->source;
  out_->title = base_->title;
  out_->statements = base_->statements;
  for (std::size_t k = 0; k < base_->statements.size(); ++k) {
    const Statement& s = base_->statements[k];
    if (s.name.empty()) continue;
    const auto at = place_.try_emplace(key(s.name, finder_.identity_of(s)), k).first;
    if (is_setting(s.name)) at->second = k;  // of several the last decides
  }
  // What is a copy itself holds no tokens: whatever its statements point into is among its own origins.
  out_->origins = base_->origins.empty() ? std::vector{base_} : base_->origins;
  if (out_->origins.back() != written) out_->origins.push_back(std::move(written));
}

std::optional<std::size_t> DatasetEditor::place_of(std::string_view statement, std::int64_t id) const {
  const auto it = place_.find(key(statement, id));
  return it == place_.end() ? std::nullopt : std::optional(it->second);
}

Statement& DatasetEditor::changed(std::size_t place) {
  touched_.insert(place);
  return out_->statements[place];
}

// The same arguments with the same values, in whatever order.
bool DatasetEditor::is_as_before(std::size_t place) const {
  const Statement &was = base_->statements[place], &is = out_->statements[place];
  if (was.inactive != is.inactive || was.damaged || is.damaged) return false;
  using Entry = std::tuple<std::string, bool, std::string>;
  const auto sorted = [&](const Statement& s) {
    const Kind* kind = kind_of(s);
    std::vector<Entry> entries;
    for (const WrittenArgument& w : s.arguments)
      entries.emplace_back(full_name(kind, w.name.text()), w.has_value, text_of(w));
    std::ranges::stable_sort(entries, {}, [](const Entry& e) { return std::get<0>(e); });
    return entries;
  };
  return sorted(was) == sorted(is);
}

EditedDataset DatasetEditor::finish() && {
  const bool same = restated_.empty() && out_->statements.size() == base_->statements.size() &&
                    std::ranges::all_of(touched_, [&](std::size_t place) { return is_as_before(place); });
  if (same) return {base_, {}};
  drop_origins();
  return {std::move(out_), std::move(restated_)};
}

// Texts of earlier edits that nothing is left of.
void DatasetEditor::drop_origins() {
  std::set<const SourceText*> used;
  const SourceText* last = nullptr;
  const auto use = [&](const SourceText* text) {
    if (std::exchange(last, text) != text) used.insert(text);
  };
  for (const Statement& s : out_->statements) {
    use(s.at.source);
    for (const WrittenArgument& w : s.arguments) use(w.name.source);
  }
  std::erase_if(out_->origins, [&](const auto& origin) { return !used.contains(origin->source.get()); });
}

const Kind* DatasetEditor::kind_of(const Statement& s) const {
  Diagnostics unused;
  std::size_t at = 0;
  return finder_.find(s, at, unused);
}

bool DatasetEditor::is_setting(std::string_view statement) const {
  const auto& kinds = finder_.kinds_of(statement);
  return !kinds.empty() && kinds.front()->role == Kind::Role::setting;
}

void DatasetEditor::redefine(const Statement& command) {
  const bool without_id = finder_.needs_no_id(command.name);
  if (!without_id && !command.id) {
    if (!command.damaged)
      diagnostics_.error("missing-id", command.at, fmt::format("{} needs an id: {}/1", command.name, command.name));
    return;
  }
  const auto target = place_of(command.name, finder_.identity_of(command));
  if (!target && without_id) {
    Statement& added = out_->statements.emplace_back(command);
    added.arguments.erase_if([&](const WrittenArgument& w) { return !w.has_value && is_list(w, kind_of(command)); });
    place_.emplace(key(command.name, 0), out_->statements.size() - 1);
    return;
  }
  if (!target) {
    diagnostics_.error("unknown-element", command.at, fmt::format("{} does not exist", key(command.name, *command.id)),
                       "a command changes what the dataset defines");
    return;
  }
  merge(changed(*target), command);
}

void DatasetEditor::merge(Statement& target, const Statement& command) {
  std::vector<std::string_view> variants;
  for (const Kind* kind : finder_.kinds_of(command.name)) {
    if (!kind->variant.empty()) variants.push_back(kind->variant);
  }
  const Kind* kind = kind_of(target);
  const Kind* const before_command = kind;
  const auto is_type = [&](const WrittenArgument& w) { return !w.has_value && is_variant(w, variants, kind); };
  const auto type = std::ranges::find_if(command.arguments, is_type);
  const auto again =
      type == command.arguments.end() ? type : std::find_if(std::next(type), command.arguments.end(), is_type);
  if (again != command.arguments.end()) {
    const auto name = [&](const WrittenArgument& w) { return variants[*find_keyword(w.name.text(), variants)]; };
    diagnostics_.error("duplicate-variant", again->name,
                       fmt::format("{} is both {} and {}", command.at.text(), name(*type), name(*again)));
    return;
  }
  // Another type first: it decides what the names of the others mean.
  if (type != command.arguments.end()) {
    target.arguments.erase_if(
        [&](const WrittenArgument& old) { return !old.has_value && is_variant(old, variants, kind); });
    target.arguments.push_back(*type);
    kind = kind_of(target);
  }
  if (kind != before_command && kind) {
    // What only the type before has goes with it.
    std::vector<std::string_view> dropped;
    target.arguments.erase_if([&](const WrittenArgument& old) {
      const ArgumentInfo* info = info_of(kind, old.name.text());
      if (is_variant(old, variants, kind) || (info && !info->elsewhere)) return false;
      dropped.push_back(full_name(before_command, old.name.text()));
      return true;
    });
    if (!dropped.empty())
      diagnostics_.warning(
          "dropped-argument", command.at,
          fmt::format("{} of {} {} dropped with its type: {} has no such argument", fmt::join(dropped, ", "),
                      target.at.text(), dropped.size() == 1 ? "is" : "are", kind->variant));
  }
  const std::size_t before = target.arguments.size();
  for (const WrittenArgument& w : command.arguments) {
    if (!w.has_value && (is_variant(w, variants, kind) || is_list(w, kind))) continue;
    const ArgumentInfo* info = info_of(kind, w.name.text());
    const std::string_view name = info ? info->name : w.name.text();
    end(target, before, kind,
        [&](std::string_view old) { return old == name || (info && lists_word(info->ends, old)); });
    target.arguments.push_back(w);
    if (info) note_start(command, *info);
  }
  target.arguments.erase_if([](const WrittenArgument& w) { return w.name.source == nullptr; });
  target.damaged = target.damaged || command.damaged;
}

void DatasetEditor::note_start(const Statement& command, const ArgumentInfo& argument) {
  if (argument.start == StatedStart::nothing) return;
  const Restated::Element element(command.name, *command.id);
  switch (argument.start) {
    case StatedStart::nothing:
      return;
    case StatedStart::place:
    case StatedStart::value:
      return restated_.begin(element);
    case StatedStart::velocity_axes:
      for (const std::string_view name : StatedVelocity::cm_names) restated_.state(element, name);
      return;
    case StatedStart::angular_axes:
      for (const std::string_view name : StatedVelocity::angular_names) restated_.state(element, name);
      return;
    case StatedStart::velocity:
    case StatedStart::alone:
      restated_.state(element, argument.name);
  }
}

void DatasetEditor::switch_elements(const Statement& command, bool inactive, Names classes) {
  std::string_view statement;
  const WrittenArgument *ids = nullptr, *range = nullptr;
  static constexpr std::array<std::string_view, 2> lists = {"ID", "RANGE"};
  for (const WrittenArgument& w : command.arguments) {
    if (!w.has_value) {
      if (!read_class(w, command, statement, classes)) return;
      continue;
    }
    const auto which = find_keyword(w.name.text(), lists);
    if (!which) {
      diagnostics_.error("unknown-argument", w.name, fmt::format("{} has no argument {}", command.name, w.name.text()),
                         "its arguments are a class, and ID or RANGE");
      return;
    }
    const WrittenArgument*& list = *which == 0 ? ids : range;
    if (list) {
      diagnostics_
          .error("duplicate-argument", w.name, fmt::format("{} of {} is given twice", lists[*which], command.name),
                 *which == 0 ? "one ID takes several ids: ID=1, 2" : "one RANGE a command")
          .notes.push_back({list->name, "the first one is here"});
      return;
    }
    list = &w;
  }
  if (statement.empty() || (!ids && !range)) {
    if (!command.damaged)
      diagnostics_.error("missing-argument", command.at, fmt::format("{} needs a class, and ID or RANGE", command.name),
                         fmt::format("{}/JOINT, ID=1", command.name));
    return;
  }
  if (ids && range) {
    diagnostics_.error("excluded-arguments", range->name, "ID and RANGE exclude each other");
    return;
  }
  if (range) return switch_range(*range, statement, inactive);
  const auto list = read_integers(*ids, *ids->name.source, diagnostics_);
  if (!list) return;
  for (const WrittenInteger& id : *list) {
    if (const auto place = place_of(statement, id.value)) {
      switch_one(changed(*place), inactive, id.at);
    } else {
      diagnostics_.error("unknown-element", id.at, fmt::format("{} does not exist", key(statement, id.value)));
    }
  }
}

void DatasetEditor::switch_range(const WrittenArgument& range, std::string_view statement, bool inactive) {
  const auto ends = read_integers(range, *range.name.source, diagnostics_);
  if (!ends) return;
  if (ends->size() != 2) {
    diagnostics_.error("wrong-count", range.value_span(), fmt::format("RANGE takes 2 ids, found {}", ends->size()));
    return;
  }
  if (ends->front().value > ends->back().value) {
    diagnostics_.error(
        "value-out-of-range", range.value_span(),
        fmt::format("RANGE begins at {} and ends before, at {}", ends->front().value, ends->back().value));
    return;
  }
  const std::int64_t first = ends->front().value, last = ends->back().value;
  bool any = false;
  const auto change = [&](std::size_t place) { changed(place).inactive = inactive, any = true; };
  // Of few ids each is found by itself, so that many commands do not go through all statements each.
  constexpr std::size_t lookup_in_comparisons = 8;
  const auto ids = static_cast<std::uint64_t>(last) - static_cast<std::uint64_t>(first);
  if (ids < out_->statements.size() / lookup_in_comparisons) {
    for (std::int64_t id = first; id <= last; ++id) {
      if (const auto place = place_of(statement, id)) change(*place);
    }
  } else {
    for (std::size_t k = 0; k < out_->statements.size(); ++k) {
      const Statement& s = out_->statements[k];
      if (s.name == statement && s.id && *s.id >= first && *s.id <= last) change(k);
    }
  }
  if (!any)
    diagnostics_.error("unknown-element", range.value_span(),
                       fmt::format("no {} has an id from {} to {}", statement, first, last));
}

bool DatasetEditor::read_class(const WrittenArgument& w, const Statement& command, std::string_view& statement,
                               Names classes) {
  const std::string_view name = statement_name(w.name.text());
  const auto& kinds = finder_.kinds_of(name);
  const bool can = contains(classes, name) || (!kinds.empty() && kinds.front()->can_be_deactivated);
  if (!can) {
    diagnostics_.error("unknown-word", w.name, fmt::format("{} is no class that {} takes", w.name.text(), command.name),
                       class_hint(w.name.text(), classes));
    return false;
  }
  if (!statement.empty()) {
    diagnostics_.error("excluded-arguments", w.name, fmt::format("{} takes one class", command.name));
    return false;
  }
  statement = name;
  return true;
}

void DatasetEditor::switch_one(Statement& s, bool inactive, const Span& at) {
  if (s.inactive == inactive) {
    diagnostics_.warning("already-so", at,
                         fmt::format("{} is {} already", s.at.text(), inactive ? "inactive" : "active"));
  }
  s.inactive = inactive;
}

}  // namespace dynalin
