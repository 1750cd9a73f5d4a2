#include "model/called_routines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "routine/damping_routine.h"

namespace dynalin {

namespace {

// "friction", "libfriction.so" and "friction.so" are one.
std::string stem(std::string_view file) {
  std::string name = std::filesystem::path(file).filename().string();
  if (const auto dot = name.find(".so"); dot != std::string::npos) name.resize(dot);
  if (name.starts_with("lib")) name.erase(0, 3);
  return name;
}

std::string unquoted(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\'' || text.front() == '"')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\'' || text.back() == '"')) text.remove_suffix(1);
  return std::string(text);
}

}  // namespace

bool calls_routine(const WrittenArgument& w) {
  static constexpr std::array<std::string_view, 1> user = {"USER"};
  if (w.damaged || w.value().size() < 2) return false;
  const auto text = [&](std::size_t k) {
    return w.name.source->text().substr(w.value()[k].offset, w.value()[k].length);
  };
  return w.value()[0].kind == TokenKind::word && find_keyword(text(0), user) == 0 && text(0).size() == user[0].size() &&
         text(1) == "(";
}

std::span<const RoutineKind> routines_of(Catalogue catalogue, std::string_view statement) {
  const auto found = std::ranges::find(catalogue, statement, [](const Kind* kind) { return kind->statement; });
  return found == catalogue.end() ? std::span<const RoutineKind>() : (*found)->routines;
}

std::vector<std::string_view> names_of_code(std::span<const RoutineKind> kinds) {
  std::vector<std::string_view> names = {"ROUTINE", "INTERFACE"};
  for (const RoutineKind& k : kinds) names.push_back(k.names_routine);
  return names;
}

const Token* behind_call(const WrittenArgument& w) {
  int depth = 0;
  for (std::size_t k = 1; k < w.value().size(); ++k) {
    const std::string_view text = w.name.source->text().substr(w.value()[k].offset, w.value()[k].length);
    depth += text == "(" ? 1 : text == ")" ? -1 : 0;
    if (depth == 0) return k + 1 < w.value().size() ? &w.value()[k + 1] : nullptr;
  }
  return nullptr;
}

CalledRoutines::CalledRoutines(const Dataset& dataset, Catalogue catalogue, const RoutineOptions& options,
                               Diagnostics& diagnostics)
    : dataset_(dataset),
      catalogue_(catalogue),
      finder_(catalogue),
      differences_(options.differences ? RoutineDifferences::everywhere : RoutineDifferences::not_in_linear_models),
      diagnostics_(diagnostics) {
  for (const Kind* kind : catalogue) {
    if (kind->told_beforehand || !kind->ground_word.empty()) told_.emplace(kind->statement, kind);
  }
  if (!options.libraries.empty()) constant_arrays_ = constant_arrays(), data_ = ids_of_data();
  for (const std::string& file : options.libraries) {
    if (std::error_code none; std::filesystem::is_directory(file, none)) {
      folders_.push_back(file);
      continue;
    }
    std::string reason;
    if (auto library = RoutineLibrary::load(file, reason)) {
      libraries_.push_back(std::move(library));
    } else {
      diagnostics_.error("unusable-library", {}, fmt::format("{} cannot be loaded: {}", file, reason));
      lacks_library_ = true;
    }
  }
}

// A dataset alone makes nothing run that the user did not name.
std::vector<CalledRoutines::Library> CalledRoutines::libraries_named(std::string_view name) {
  std::vector<Library> found;
  for (const Library& l : libraries_) {
    if (stem(l->file()) == stem(name)) found.push_back(l);
  }
  for (const std::string& folder : folders_) {
    const std::string wanted = stem(name);
    for (const std::string& file :
         {std::filesystem::path(name).filename().string(), wanted + ".so", "lib" + wanted + ".so"}) {
      const auto path = std::filesystem::path(folder) / file;
      std::error_code none;
      if (!std::filesystem::is_regular_file(path, none)) continue;
      std::string reason;
      if (auto library = RoutineLibrary::load(path.string(), reason)) {
        files.push_back(path.string());
        found.push_back(std::move(library));
      } else {
        diagnostics_.error("unusable-library", {}, fmt::format("{} cannot be loaded: {}", path.string(), reason));
      }
      break;
    }
  }
  return found;
}

std::string_view CalledRoutines::full_name(const Statement& s, const WrittenArgument& w) const {
  const std::string_view written = w.name.text();
  std::vector<std::string_view> names;
  std::vector<bool> bare;
  for (const Kind* kind : catalogue_) {
    if (kind->statement != s.name) continue;
    for (const ArgumentInfo& a : kind->arguments) names.push_back(a.name), bare.push_back(a.is_flag);
  }
  const auto own = find_keyword(written, names);
  // The statement's own names come first, as R of RM; a bare word has no value, as RO of a rotational SFORCE.
  if (own && !(bare[*own] && w.has_value)) return names[*own];
  const std::vector<std::string_view> of_routines = names_of_code(routines_of(catalogue_, s.name));
  const auto other = w.has_value ? find_keyword(written, of_routines) : std::nullopt;
  if (other) return of_routines[*other];
  return own ? names[*own] : std::string_view();
}

bool CalledRoutines::names_code(const Statement& s, const WrittenArgument& w) const {
  return w.has_value && w.name.length >= fewest_letters_of_code &&
         std::ranges::count(names_of_code(routines_of(catalogue_, s.name)), full_name(s, w)) > 0;
}

const WrittenArgument* CalledRoutines::argument(const Statement& s, std::string_view name) const {
  const auto found = std::find_if(s.arguments.begin(), s.arguments.end(),
                                  [&](const WrittenArgument& w) { return full_name(s, w) == name; });
  return found == s.arguments.end() ? nullptr : &*found;
}

// 0 where nothing or no number is written: whoever reads the statement says so.
int CalledRoutines::integer(const Statement& s, std::string_view name) const {
  const WrittenArgument* w = argument(s, name);
  if (!w || !w->has_value || w->damaged) return 0;
  Diagnostics ignored;
  const auto value = read_integer(*w, *w->name.source, ignored);
  return value ? static_cast<int>(value->value) : 0;
}

std::vector<double> CalledRoutines::reals(const Statement& s, std::string_view name) const {
  const WrittenArgument* w = argument(s, name);
  if (!w || !w->has_value || w->damaged) return {};
  Diagnostics ignored;
  return read_reals(*w, *w->name.source, ignored).value_or(std::vector<double>());
}

double CalledRoutines::real(const Statement& s, std::string_view name) const {
  const std::vector<double> all = reals(s, name);
  return all.empty() ? 0 : all.front();
}

std::string CalledRoutines::text(const Statement& s, std::string_view name) const {
  const WrittenArgument* w = argument(s, name);
  if (!w || !w->has_value || w->damaged || w->value().empty()) return {};
  Diagnostics ignored;
  return read_text(*w, *w->name.source, ignored).value_or("");
}

const RoutineKind* CalledRoutines::kind_for(const Statement& s, std::string_view argument) const {
  const auto kinds = routines_of(catalogue_, s.name);
  const auto found = std::ranges::find(kinds, argument, &RoutineKind::argument);
  return found != kinds.end() ? &*found : kinds.empty() ? nullptr : &kinds.front();
}

std::vector<int> CalledRoutines::integers(const Statement& s, std::string_view name) const {
  std::vector<int> all;
  const WrittenArgument* w = argument(s, name);
  if (!w || !w->has_value || w->damaged) return all;
  Diagnostics ignored;
  if (const auto list = read_integers(*w, *w->name.source, ignored)) {
    for (const WrittenInteger& i : *list) all.push_back(static_cast<int>(i.value));
  }
  return all;
}

// Between the parentheses of USER(…).
std::optional<std::vector<double>> CalledRoutines::constants_of(const WrittenArgument& call, const ElementId& of) {
  const SourceText& source = *call.name.source;
  const auto tokens = call.value();
  const Token& last = tokens.back();
  if (source.text().substr(last.offset, last.length) != ")") {
    diagnostics_.error("unbalanced-parenthesis", {&source, tokens[0].offset, tokens[0].length},
                       fmt::format("the parenthesis of USER in {} is not closed behind its constants", of.text()));
    return std::nullopt;
  }
  if (tokens.size() <= 3) return std::vector<double>();
  WrittenArgument constants = call;
  constants.set_value(tokens.subspan(2, tokens.size() - 3));
  auto values = read_reals(constants, source, diagnostics_);
  constexpr std::size_t most = RoutineConstants::most;
  if (values && values->size() > most) {
    diagnostics_.error(
        "wrong-count", constants.value_span(),
        fmt::format("USER of {} has {} constants, and takes {} at most", of.text(), values->size(), most),
        "a routine reads more from an ARRAY, by its id");
    return std::nullopt;
  }
  return values;
}

FoundRoutine CalledRoutines::called_by(const Statement& s, const RoutineKind& kind, std::string& wanted,
                                       StatePartialRoutines& partials) {
  wanted = kind.routine;
  if (const auto* named = argument(s, kind.names_routine); named && named->has_value) {
    std::string text = unquoted(named->value_span().text());
    if (kind.arguments == RoutineArguments::coupler) partials = routines_beside(text);
    wanted = text;
    if (const auto last = text.find_last_of(':'); last != std::string::npos && last + 1 < text.size())
      wanted = text.substr(last + 1) + " of " + text.substr(0, text.find(':'));
    return find_named(text, {});
  }
  if (kind.arguments == RoutineArguments::coupler) {
    partials.first = find_routine(libraries_, "couxx"), partials.second = find_routine(libraries_, "couxx2");
  }
  return find_routine(libraries_, kind.routine);
}

std::shared_ptr<const CompiledRoutine> CalledRoutines::find(const Statement& s, const WrittenArgument& call,
                                                            std::string& wanted) {
  const std::string_view by = full_name(s, call);
  const RoutineKind* kind = kind_for(s, by);
  if (!kind || !has_libraries()) return nullptr;
  StatePartialRoutines partials;
  FoundRoutine found = called_by(s, *kind, wanted, partials);
  if (!found) return nullptr;
  auto what = says(s, &call, *kind);
  if (!what) return nullptr;
  std::size_t values = kind->values > 0 ? kind->values : what->told.values;
  if (kind->arguments == RoutineArguments::modal) {
    what->modal = modal_load_of(s, by == "FUNCTION");
    if (!what->modal) {
      diagnostics_.error("routine-failed", call.value_span(),
                         fmt::format("{} calls a routine for the modes of FLEX_BODY/{}, which are not known",
                                     s.at.text(), integer(s, "FLEX_BODY")));
      return nullptr;
    }
    values = 6 + what->modal->modes + (what->modal->scaled ? 1 : 0);
  }
  return made(s, call.value_span(), std::move(found), *kind, values, std::move(*what), std::move(partials));
}

bool CalledRoutines::is_kept_apart(const Statement& s, const WrittenArgument& call) const {
  const RoutineKind* kind = kind_for(s, full_name(s, call));
  return kind && (kind->arguments == RoutineArguments::damping || kind->arguments == RoutineArguments::curve);
}

bool CalledRoutines::keep_apart(const Statement& s, const WrittenArgument& call, std::string& wanted) {
  StatePartialRoutines none;
  const RoutineKind& kind = *kind_for(s, full_name(s, call));
  FoundRoutine found = called_by(s, kind, wanted, none);
  if (!found) return false;
  auto what = says(s, &call, kind);
  if (!what) return false;
  if (kind.arguments == RoutineArguments::curve) {
    data_->called_curves[what->id] =
        std::make_shared<const CurveRoutine>(std::move(found), curve_of(s, *what), differences_);
    return true;
  }
  data_->damping[what->id] =
      std::make_shared<const DampingRoutine>(std::move(found), what->element, what->id, *what->constants);
  return true;
}

// Of "library::value, first, second" the second and the third, in the library of the first where they name none;
// `text` keeps the first.
StatePartialRoutines CalledRoutines::routines_beside(std::string& text) {
  StatePartialRoutines beside;
  const std::string all = std::exchange(text, text.substr(0, text.find(',')));
  text = unquoted(text);
  const auto last = text.find_last_of(':');
  const std::string library = last == std::string::npos ? "" : text.substr(0, last + 1);
  std::size_t from = all.find(',');
  for (FoundRoutine* routine : {&beside.first, &beside.second}) {
    if (from == std::string::npos) break;
    const std::size_t to = all.find(',', from + 1);
    std::string name = unquoted(std::string_view(all).substr(from + 1, to == std::string::npos ? to : to - from - 1));
    if (name.find(':') == std::string::npos) name.insert(0, library);
    *routine = find_named(name, {});
    from = to;
  }
  return beside;
}

FoundRoutine CalledRoutines::find_named(std::string_view written, std::span<const std::string_view> default_names) {
  const auto colon = written.find(':');
  std::vector<Library> named;
  if (colon != std::string_view::npos && colon > 0) named = libraries_named(written.substr(0, colon));
  const std::vector<Library>& libraries = colon != std::string_view::npos && colon > 0 ? named : libraries_;
  const auto last = written.find_last_of(':');
  const std::string_view name = last == std::string_view::npos ? written : written.substr(last + 1);
  if (!name.empty()) return find_routine(libraries, name);
  for (const std::string_view by_default : default_names) {
    if (FoundRoutine found = find_routine(libraries, by_default)) return found;
  }
  return {};
}

// Null after an error.
std::shared_ptr<const CompiledRoutine> CalledRoutines::made(const Statement& s, const Span& at, FoundRoutine found,
                                                            const RoutineKind& kind, std::size_t values,
                                                            RoutineStatement what, StatePartialRoutines partials) {
  const auto size_of = [this](std::string_view statement, std::int32_t id) { return size_of_list(statement, id); };
  auto routine = std::make_shared<const CompiledRoutine>(std::move(found), kind, values, std::move(what), differences_,
                                                         size_of, std::move(partials));
  if (!routine->problem().empty()) {
    diagnostics_.error("routine-failed", at,
                       fmt::format("{} of {} cannot be used: {}", routine->name(), s.at.text(), routine->problem()));
    return nullptr;
  }
  for (const Atom& a : routine->inputs())
    if (reads_modes(a)) data_->modes_read.insert(a.argument[0]);
  // What is called once in a while has nobody who asks for its derivatives.
  const bool has_slopes = kind.arguments != RoutineArguments::plain && !kind.sampled;
  if (!routine->gives_derivatives() && has_slopes) {
    const bool everywhere = differences_ == RoutineDifferences::everywhere;
    diagnostics_.warning(
        "differenced-routine", at,
        fmt::format("{} of {} {}: {}", routine->name(), s.at.text(), routine->lack_of_derivatives(),
                    everywhere ? "differences take their place, and eigenvalues have no bound"
                               : "statics and dynamics take differences in their iterations, LINEAR refuses it"));
  }
  return routine;
}

std::string CalledRoutines::written(const Statement& s, const WrittenArgument& call,
                                    std::shared_ptr<const CompiledRoutine> routine) {
  const Span at = call.value_span();
  const RoutineKind& kind = *kind_for(s, full_name(s, call));
  std::vector<Atom> inputs = routine->inputs();
  for (Atom& a : inputs) a.set_place(at);
  std::string text;
  const auto take = [&](std::string_view name, std::size_t value) {
    text += fmt::format(", {}={}", name, functions.size());
    functions.push_back(routine_expression(inputs, routine, value, at));
  };
  for (std::size_t v = 0; v < kind.components.size(); ++v) take(kind.components[v].name, v);
  // A FIELD and a CONTACT take the routine with all of its values over from the first.
  if (kind.components.empty()) take(kind.argument, 0);
  return text;
}

}  // namespace dynalin
