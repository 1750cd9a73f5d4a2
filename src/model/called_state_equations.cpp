// The routines of a GSE: which of the two sets it calls, and under which names.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/called_routines.h"
#include "model/missing_routine.h"

namespace dynalin {

namespace {

constexpr int most_numbers = 10000;  // of one kind

// Names that stand in a list, with a library each or without: "control::deriv, ::update".
std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names(1);
  for (const char c : text) {
    const bool between =
        c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\'' || c == '"' || c == '(' || c == ')' || c == '&';
    if (c == ',') {
      names.emplace_back();
    } else if (!between) {
      names.back() += c;
    }
  }
  return names;
}

// A library alone, "control::", leaves the name to its default.
bool names_one(std::string_view written) { return !written.empty() && written.back() != ':'; }

}  // namespace

// One statement that calls them, and what was found of what it calls.
class CalledRoutines::StateCalls {
 public:
  StateCalls(CalledRoutines& called, const Statement& statement, const WrittenArgument* call)
      : called_(called),
        statement_(statement),
        at_(call ? call->value_span() : statement.at),
        kinds_(routines_of(called.catalogue_, statement.name)),
        said_(called.says(statement, call, kind_of(StateRoutine::system))) {}

  // Null after an error.
  std::shared_ptr<const StateEquations> find() {
    if (!said_) return nullptr;
    tell();
    if (!has_its_arrays() || !read_names() || !has_all_that_is_named()) return nullptr;
    if (!find_rates_and_outputs()) return nullptr;
    if (count(&sAdamsGSE::ND) > 0 && !(find_update() && find_period())) return nullptr;
    return found_;
  }

 private:
  const RoutineKind& kind_of(StateRoutine which) const { return kinds_[static_cast<std::size_t>(which)]; }
  const WrittenArgument* argument(std::string_view name) const { return called_.argument(statement_, name); }
  int integer(std::string_view name) const { return called_.integer(statement_, name); }
  std::size_t count(int sAdamsGSE::*of) const { return static_cast<std::size_t>(said_->gse.get()->*of); }

  // What every routine reads of the statement, with the constants that it is called with.
  void tell() {
    const RoutineConstants& constants = *said_->constants;
    auto gse = std::make_shared<sAdamsGSE>();
    gse->ID = static_cast<int>(statement_.id.value_or(0)), gse->NPAR = constants.count(), gse->PAR = constants.data();
    gse->NO = std::max(integer("NO"), 0), gse->NS = std::max(integer("NS"), 0);
    gse->ND = std::max(integer("ND"), 0);
    gse->U = integer("U"), gse->Y = integer("Y"), gse->X = integer("X"), gse->IC = integer("IC");
    gse->XD = integer("XD"), gse->ICD = integer("ICD");
    gse->NI = gse->U == 0 ? 0 : static_cast<int>(called_.size_of_list(ArrayClass::statement, gse->U).value_or(0));
    gse->STATIC_HOLD = argument("STATIC_HOLD") != nullptr, gse->IMPLICIT = argument("IMPLICIT") != nullptr;
    gse->STATICS_ONLY = argument("STATICS_ONLY") != nullptr;
    gse->SAMPLE_OFFSET = called_.real(statement_, "SAMPLE_OFFSET");
    said_->gse = std::move(gse);
    said_->told.structure = said_->gse;
  }

  // Whoever reads the statement says that numbers are too many, or that their ARRAYs are missing.
  bool has_its_arrays() const {
    const sAdamsGSE& gse = *said_->gse;
    const auto exists = [&](int array) { return called_.statement(ArrayClass::statement, array) != nullptr; };
    const bool placed = (gse.NS == 0 || exists(gse.X)) && (gse.ND == 0 || exists(gse.XD)) &&
                        (argument("U") == nullptr || exists(gse.U));
    return placed && std::max({gse.NS, gse.NO, gse.ND}) <= most_numbers;
  }

  // False after an error.
  bool read_names() {
    const bool interface_fits = read_names("INTERFACE", interface_, asks_for_interface_);
    const bool system_fits = read_names("ROUTINE", system_, asks_for_system_);
    if (asks_for_interface_ && asks_for_system_) {
      return unfit("excluded-arguments", "ROUTINE",
                   fmt::format("{} names routines by INTERFACE or by ROUTINE, not both", statement_.at.text()));
    }
    return interface_fits && system_fits;
  }
  bool read_names(std::string_view word, std::span<std::string> into, bool& asks) {
    const WrittenArgument* w = argument(word);
    asks = w && w->has_value;
    if (!asks) return true;
    const auto list = names_in(w->value_span().text());
    std::copy_n(list.begin(), std::min(list.size(), into.size()), into.begin());
    return list.size() <= into.size() || unfit("wrong-count", word,
                                               fmt::format("{} of {} names {} routines at most, not {}", word,
                                                           statement_.at.text(), into.size(), list.size()));
  }
  bool unfit(std::string_view code, std::string_view word, std::string message) {
    called_.diagnostics_.error(code, argument(word)->name, std::move(message));
    return false;
  }

  // Also what this GSE does not call: the name is a slip.
  bool has_all_that_is_named() {
    const std::span<const std::string> names =
        asks_for_interface_ ? std::span<const std::string>(interface_) : std::span<const std::string>(system_);
    return std::ranges::all_of(names, [&](const std::string& written) {
      return !names_one(written) || find(written, {}) || missing(written, {});
    });
  }

  FoundRoutine find(const std::string& written, std::initializer_list<std::string_view> by_default) {
    return called_.find_named(written, {by_default.begin(), by_default.size()});
  }
  // It is missing where it is named, or else where it is called.
  bool missing(const std::string& written, std::string_view by_default, std::string_view hint = {}) {
    const WrittenArgument* naming =
        names_one(written) ? argument(asks_for_interface_ ? "INTERFACE" : "ROUTINE") : nullptr;
    called_.diagnostics_.error(
        "missing-routine", naming ? naming->value_span() : at_,
        fmt::format("{} calls {}, and no library has it", statement_.at.text(), naming ? written : by_default),
        std::string(hint.empty() ? missing_routine::look_into_libraries : hint));
    return false;
  }

  std::shared_ptr<const CompiledRoutine> made(FoundRoutine routine, StateRoutine which, std::size_t values,
                                              StatePartialRoutines partials = {}) {
    return called_.made(statement_, at_, std::move(routine), kind_of(which), values, *said_, std::move(partials));
  }
  std::vector<Expression> functions_of(const std::shared_ptr<const CompiledRoutine>& routine, std::size_t first,
                                       std::size_t count) const {
    std::vector<Atom> inputs = routine->inputs();
    for (Atom& a : inputs) a.set_place(at_);
    std::vector<Expression> values;
    for (std::size_t v = first; v < first + count; ++v) values.push_back(routine_expression(inputs, routine, v, at_));
    return values;
  }

  // By one routine for both or one for each, as the statement asks, and else as a library has them.
  bool find_rates_and_outputs() {
    const std::size_t rates = count(&sAdamsGSE::NS), outputs = count(&sAdamsGSE::NO);
    FoundRoutine of_rates = find(interface_[0], {kind_of(StateRoutine::derivatives).routine});
    FoundRoutine of_outputs = find(interface_[2], {kind_of(StateRoutine::outputs).routine});
    FoundRoutine of_both =
        asks_for_interface_ ? FoundRoutine{} : find(system_[0], {kind_of(StateRoutine::system).routine});
    const bool separate =
        asks_for_interface_ || (!asks_for_system_ && ((of_rates && rates > 0) || (of_outputs && outputs > 0)));
    if (rates + outputs > 0 && !separate) {
      if (of_both) return take_system(std::move(of_both));
      if (asks_for_system_) return missing(system_[0], kind_of(StateRoutine::system).routine);
    }
    return take_separate(std::move(of_rates), std::move(of_outputs));
  }

  bool take_system(FoundRoutine found) {
    const std::size_t rates = count(&sAdamsGSE::NS), outputs = count(&sAdamsGSE::NO);
    StatePartialRoutines partials = {find(system_[1], {"gsexx"}),
                                     find(system_[2], {"gsexu"}),
                                     find(system_[3], {"gseyx"}),
                                     find(system_[4], {"gseyu"}),
                                     {},
                                     {}};
    const auto routine = made(std::move(found), StateRoutine::system, rates + outputs, std::move(partials));
    if (!routine) return false;
    found_->derivatives = functions_of(routine, 0, rates);
    found_->outputs = functions_of(routine, rates, outputs);
    return true;
  }

  bool take_separate(FoundRoutine of_rates, FoundRoutine of_outputs) {
    constexpr std::string_view either = "a GSE calls gse_deriv and gse_output, or gsesub alone";
    const std::size_t rates = count(&sAdamsGSE::NS), outputs = count(&sAdamsGSE::NO);
    if (rates > 0 && !of_rates) return missing(interface_[0], kind_of(StateRoutine::derivatives).routine, either);
    if (outputs > 0 && !of_outputs) return missing(interface_[2], kind_of(StateRoutine::outputs).routine, either);
    const auto take = [&](FoundRoutine found, StateRoutine which, std::size_t values, std::vector<Expression>& to) {
      if (values == 0) return true;
      const auto routine = made(std::move(found), which, values);
      if (routine) to = functions_of(routine, 0, values);
      return routine != nullptr;
    };
    const bool has_rates = take(std::move(of_rates), StateRoutine::derivatives, rates, found_->derivatives);
    return take(std::move(of_outputs), StateRoutine::outputs, outputs, found_->outputs) && has_rates;
  }

  // Of discrete states.
  bool find_update() {
    FoundRoutine update = find(interface_[1], {kind_of(StateRoutine::update).routine});
    if (!update)
      return missing(interface_[1], kind_of(StateRoutine::update).routine, "ND discrete states need gse_update");
    const std::size_t values = count(&sAdamsGSE::ND);
    const auto updates = made(std::move(update), StateRoutine::update, values);
    if (!updates) return false;
    found_->update = functions_of(updates, 0, values), found_->update_name = updates->name();
    return true;
  }

  // The time between samples, where the statement does not have it as a number.
  bool find_period() {
    const WrittenArgument* period = argument("SAMPLE_PERIOD");
    if (period && !calls_routine(*period)) return true;
    FoundRoutine sample = find(interface_[3], {kind_of(StateRoutine::sample).routine, "gse_sample"});
    if (!sample) {
      return missing(interface_[3], kind_of(StateRoutine::sample).routine,
                     "SAMPLE_PERIOD= gives the time between samples as well");
    }
    if (period) {
      auto constants = called_.constants_of(*period, said_->element);
      if (!constants) return false;
      said_->constants = std::make_shared<const RoutineConstants>(*constants);
      tell();
    }
    const auto samples = made(std::move(sample), StateRoutine::sample, 1);
    if (!samples) return false;
    found_->period = functions_of(samples, 0, 1).front(), found_->period_name = samples->name();
    return true;
  }

  CalledRoutines& called_;
  const Statement& statement_;
  const Span at_;  // of the call
  const std::span<const RoutineKind> kinds_;
  std::optional<RoutineStatement> said_;
  // Names as they are written, by the order in which the language lists them.
  std::array<std::string, 4> interface_{};  // gse_deriv, gse_update, gse_output, gse_samp
  std::array<std::string, 5> system_{};     // gsesub, gsexx, gsexu, gseyx, gseyu
  bool asks_for_interface_ = false, asks_for_system_ = false;
  std::shared_ptr<StateEquations> found_ = std::make_shared<StateEquations>();
};

std::shared_ptr<const StateEquations> CalledRoutines::find_state_equations(const Statement& s,
                                                                           const WrittenArgument* call) {
  return StateCalls(*this, s, call).find();
}

std::string CalledRoutines::written(std::shared_ptr<const StateEquations> equations, const Span& at) {
  functions.push_back(StateEquations::written(std::move(equations), at));
  return fmt::format(", FUNCTION={}", functions.size() - 1);
}

}  // namespace dynalin
