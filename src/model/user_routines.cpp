#include "model/user_routines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "model/called_routines.h"
#include "model/missing_routine.h"

namespace dynalin {

namespace {

constexpr std::string_view hint_of_routine_in_expression =
    "VARIABLE/id, FUNCTION=USER(…) calls a routine, and expressions read VARVAL(id)";
Span span_of(const Token& token, const SourceText& source) { return {&source, token.offset, token.length}; }

class Replacement {
 public:
  Replacement(const Dataset& base, Catalogue catalogue, const BuildOptions& options, const RoutineOptions& routines,
              Diagnostics& diagnostics)
      : catalogue_(catalogue),
        value_(options.user_value),
        diagnostics_(diagnostics),
        called_(base, catalogue, routines, diagnostics) {
    if (!value_) return;
    if (!std::isfinite(*value_)) {
      diagnostics.error("value-out-of-range", {},
                        fmt::format("{} cannot take the place of compiled routines: it is no finite number", *value_));
      value_.reset();
      return;
    }
    std::string text = "CONSTANT/1";
    std::set<std::string_view> written;
    for (const Kind* kind : catalogue) {
      for (const RoutineKind& routine : kind->routines) {
        for (const ValueArgument& a : routine.constants) {
          if (!written.insert(a.name).second) continue;
          const std::string number = a.zero ? "0" : fmt::format("{:.17g}", *value_);
          text += fmt::format(", {}={}", a.name, fmt::join(std::vector<std::string>(a.numbers, number), ","));
        }
      }
    }
    constants_ = generated("--user-value of " + base.source->name(), text + "\n");
  }

  void apply(Statement& s) {
    const auto kind =
        std::find_if(catalogue_.begin(), catalogue_.end(), [&](const Kind* k) { return k->statement == s.name; });
    if (kind == catalogue_.end() || is_beside_model(**kind)) return;
    const auto routines = routines_of(catalogue_, s.name);
    const bool is_request = (*kind)->gives == Kind::Gives::requests;
    bool calls = refuses_expression(s);
    if (std::ranges::find(routines, RoutineArguments::system, &RoutineKind::arguments) != routines.end())
      return apply_to_state_equations(s);
    for (std::size_t k = 0; k < s.arguments.size();) {
      if (!calls_routine(s.arguments[k]) || s.arguments[k].damaged) {
        ++k;
        continue;
      }
      calls = true;
      if (call_library(s, k)) continue;
      if (is_request && !value_) return;  // without what it requests it is left out, where it is read
      replace(s, k);
    }
    const auto code = std::ranges::find_if(s.arguments, [&](const auto& w) { return called_.names_code(s, w); });
    if (!calls && code != s.arguments.end()) {
      if (is_request) return;
      diagnostics_.error("missing-routine", code->name,
                         fmt::format("{} names a compiled routine, and calls none with USER(…)", s.at.text()));
    }
    drop_names_of_code(s);
  }

  // Writes the calls into their statements.
  DatasetWithRoutines finish(std::shared_ptr<Dataset> out) {
    DatasetWithRoutines all;
    if (constants_) {
      out->origins.push_back(constants_);
      all.further_texts.push_back(constants_->source);
    }
    if (!calls_.empty()) {
      std::string text;
      for (const auto& [statement, arguments] : calls_) text += "CONSTANT/1" + arguments + "\n";
      const auto written = generated("calls of routines by " + out->source->name(), text);
      for (std::size_t k = 0; k < calls_.size(); ++k) {
        auto& arguments = calls_[k].first->arguments;
        const auto& more = written->statements[k].arguments;
        arguments.insert(arguments.size(), more);
      }
      out->origins.push_back(written);
      all.calls = written->source;
      all.further_texts.push_back(written->source);
      all.functions = std::move(called_.functions);
    }
    all.files = std::move(called_.files);
    all.data = called_.data();
    all.dataset = std::move(out);
    return all;
  }

 private:
  // Calls stand alone, and where one gives several values it does so in FUNCTION.
  bool refuses_expression(Statement& s) {
    bool refused = false;
    for (WrittenArgument& w : s.arguments) {
      if (!calls_routine(w)) continue;
      const Token* more = behind_call(w);
      if (!more && is_one_of_several(s, w)) {
        diagnostics_.error(
            "routine-in-expression", span_of(w.value()[0], *w.name.source),
            fmt::format("a routine is called by the FUNCTION of {}, and gives all of its values", s.at.text()),
            std::string(hint_of_routine_in_expression));
        refused = w.damaged = true;
      }
      if (!more) continue;
      diagnostics_.error("routine-in-expression", span_of(*more, *w.name.source),
                         fmt::format("USER(…) of {} is the whole of {}, and no part of an expression", s.at.text(),
                                     called_.full_name(s, w)),
                         std::string(hint_of_routine_in_expression));
      refused = w.damaged = true;
    }
    return refused;
  }

  bool is_one_of_several(const Statement& s, const WrittenArgument& w) const {
    const RoutineKind* kind = called_.kind_for(s, called_.full_name(s, w));
    return kind && kind->constants.size() > 1 && called_.full_name(s, w) != kind->argument;
  }
  void drop_names_of_code(Statement& s) const {
    s.arguments.erase_if([&](const WrittenArgument& w) { return called_.names_code(s, w); });
  }

  static std::shared_ptr<const Dataset> generated(std::string name, std::string text) {
    static constexpr std::array<std::string_view, 1> keywords = {"CONSTANT"};
    return std::make_shared<const Dataset>(
        parse_statements(std::make_shared<const SourceText>(std::move(name), std::move(text)), keywords).value);
  }

  void apply_to_state_equations(Statement& s) {
    const WrittenArgument* call = called_.argument(s, "FUNCTION");
    if (call && !calls_routine(*call)) {  // whoever reads it says what is wrong
      drop_names_of_code(s);
      return;
    }
    const Span at = call ? span_of(call->value()[0], *call->name.source) : s.at;
    std::shared_ptr<const StateEquations> equations;
    if (called_.has_libraries()) {
      equations = called_.find_state_equations(s, call);
    } else if (!called_.lacks_library()) {
      diagnostics_.error("missing-routine", at,
                         fmt::format("{} calls compiled routines, and no library that has them is named", s.at.text()),
                         std::string(missing_routine::name_a_library));
    }
    if (equations) calls_.emplace_back(&s, called_.written(equations, call ? call->value_span() : s.at));
    WrittenArguments kept;
    for (WrittenArgument& w : s.arguments) {
      if (called_.names_code(s, w) || (equations && calls_routine(w))) continue;
      if (calls_routine(w)) w.damaged = true;
      kept.push_back(w);
    }
    s.arguments = std::move(kept);
    // Without FUNCTION the statement has no second error of its own.
    if (!equations && !call) s.damaged = true;
  }

  // Whether that is done, or cannot be for a reason that is reported.
  bool call_library(Statement& s, std::size_t k) {
    WrittenArgument& call = s.arguments[k];
    if (called_.lacks_library() && !value_) call.damaged = true;
    if (!called_.has_libraries()) return call.damaged;
    std::string wanted;
    const std::size_t errors = diagnostics_.error_count();
    const bool apart = called_.is_kept_apart(s, call);
    const auto routine = apart ? nullptr : called_.find(s, call, wanted);
    if (apart ? !called_.keep_apart(s, call, wanted) : !routine) {
      if (diagnostics_.error_count() > errors) call.damaged = true;
      if (call.damaged || value_ || wanted.empty()) return call.damaged;
      diagnostics_.error("missing-routine", span_of(call.value()[0], *call.name.source),
                         fmt::format("{} calls {}, and no library has it", s.at.text(), wanted),
                         std::string(missing_routine::look_into_libraries));
      call.damaged = true;
      return true;
    }
    if (routine) calls_.emplace_back(&s, called_.written(s, call, routine));
    s.arguments.erase(k);
    return true;
  }

  void replace(Statement& s, std::size_t k) {
    WrittenArgument& call = s.arguments[k];
    const Span at = span_of(call.value()[0], *call.name.source);
    const RoutineKind* kind = called_.kind_for(s, called_.full_name(s, call));
    const bool can_be_constant = kind && !kind->constants.empty();
    if (!value_ || !can_be_constant) {
      diagnostics_.error(
          "missing-routine", at,
          fmt::format("{} calls a compiled routine, {}", s.at.text(),
                      kind ? "and no library that has it is named" : "which its kind of statement cannot do yet"),
          !can_be_constant ? std::string("no constant can take its place")
                           : std::string(missing_routine::name_a_library_or_a_value));
      call.damaged = true;
      return;
    }
    diagnostics_.warning(
        "missing-routine", at,
        fmt::format("{} calls a compiled routine: the constant {:g} takes its place", s.at.text(), *value_));
    // One value stands in the place of its own call, several in that of the one call that gives them all.
    const std::string_view own = called_.full_name(s, call);
    const bool single = kind->constants.size() == 1;
    s.arguments.erase(k);
    for (const WrittenArgument& w : constants_->statements.front().arguments) {
      const bool wanted =
          single ? w.name.text() == own
                 : std::ranges::find(kind->constants, w.name.text(), &ValueArgument::name) != kind->constants.end();
      if (wanted) s.arguments.push_back(w);
    }
  }

  Catalogue catalogue_;
  std::optional<double> value_;
  Diagnostics& diagnostics_;
  CalledRoutines called_;
  std::shared_ptr<const Dataset> constants_;
  std::vector<std::pair<Statement*, std::string>> calls_;  // and what takes the place of USER(…)
};

// Statements that may have to do with routines, found at the cost of a look at their arguments.
class Concerned {
 public:
  explicit Concerned(Catalogue catalogue) {
    std::set<std::string_view> all;
    for (const Kind* kind : catalogue) {
      for (const std::string_view name : names_of_code(kind->routines)) all.insert(name);
    }
    names_.assign(all.begin(), all.end());
  }
  bool operator()(const Statement& s) const {
    return std::ranges::any_of(s.arguments, [this](const WrittenArgument& w) {
      return calls_routine(w) || (w.has_value && w.name.length >= fewest_letters_of_code &&
                                  find_keyword(w.name.text(), names_).has_value());
    });
  }

 private:
  std::vector<std::string_view> names_;
};

}  // namespace

DatasetWithRoutines with_user_routines(std::shared_ptr<const Dataset> base, Catalogue catalogue,
                                       const BuildOptions& options, const RoutineOptions& routines,
                                       Diagnostics& diagnostics) {
  const Concerned concerned(catalogue);
  if (std::ranges::none_of(base->statements, concerned)) {
    // Libraries that nothing calls are not loaded, but a wrong name is one.
    for (const std::string& file : routines.libraries) {
      if (std::error_code none; !std::filesystem::exists(file, none))
        diagnostics.error("unusable-library", {}, fmt::format("{} cannot be loaded: there is no such file", file));
    }
    return {base, nullptr, {}, {}, nullptr, {}};
  }
  Replacement replacement(*base, catalogue, options, routines, diagnostics);
  auto out = std::make_shared<Dataset>();
  out->source = base->source;
  out->title = base->title;
  out->statements = base->statements;
  for (Statement& s : out->statements) {
    if (concerned(s)) replacement.apply(s);
  }
  out->origins = {base};
  return replacement.finish(std::move(out));
}

}  // namespace dynalin
