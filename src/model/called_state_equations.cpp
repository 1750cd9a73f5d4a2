// The routines of a GSE: which of the two sets it calls, and under which names.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/called_routines.h"

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

// By the order in which the language lists them.
struct CalledRoutines::StateRoutineNames {
  std::array<std::string, 4> interface {};  // gse_deriv, gse_update, gse_output, gse_samp
  std::array<std::string, 5> system{};      // gsesub, gsexx, gsexu, gseyx, gseyu
  bool asks_for_interface = false, asks_for_system = false;
  bool fit = true;  // else an error was reported
};

CalledRoutines::StateRoutineNames CalledRoutines::state_routine_names(const Statement& s) {
  StateRoutineNames names;
  const auto unfit = [&](std::string_view code, std::string_view word, std::string message) {
    diagnostics_.error(code, argument(s, word)->name, std::move(message));
    names.fit = false;
  };
  const auto take = [&](std::string_view word, auto& into) {
    const WrittenArgument* w = argument(s, word);
    if (!w || !w->has_value) return false;
    const auto list = names_in(w->value_span().text());
    if (list.size() > into.size()) {
      unfit("wrong-count", word,
            fmt::format("{} of {} names {} routines at most, not {}", word, s.at.text(), into.size(), list.size()));
    }
    std::copy_n(list.begin(), std::min(list.size(), into.size()), into.begin());
    return true;
  };
  names.asks_for_interface = take("INTERFACE", names.interface);
  names.asks_for_system = take("ROUTINE", names.system);
  if (names.asks_for_interface && names.asks_for_system) {
    unfit("excluded-arguments", "ROUTINE",
          fmt::format("{} names routines by INTERFACE or by ROUTINE, not both", s.at.text()));
  }
  return names;
}

sAdamsGSE CalledRoutines::says_of_states(const Statement& s, const RoutineConstants& constants) const {
  sAdamsGSE gse{};
  gse.ID = static_cast<int>(s.id.value_or(0)), gse.NPAR = constants.count(), gse.PAR = constants.data();
  gse.NO = std::max(integer(s, "NO"), 0), gse.NS = std::max(integer(s, "NS"), 0);
  gse.ND = std::max(integer(s, "ND"), 0);
  gse.U = integer(s, "U"), gse.Y = integer(s, "Y"), gse.X = integer(s, "X"), gse.IC = integer(s, "IC");
  gse.XD = integer(s, "XD"), gse.ICD = integer(s, "ICD");
  gse.NI = gse.U == 0 ? 0 : static_cast<int>(size_of_list(ArrayClass::statement, gse.U).value_or(0));
  gse.STATIC_HOLD = argument(s, "STATIC_HOLD") != nullptr, gse.IMPLICIT = argument(s, "IMPLICIT") != nullptr;
  gse.STATICS_ONLY = argument(s, "STATICS_ONLY") != nullptr;
  gse.SAMPLE_OFFSET = real(s, "SAMPLE_OFFSET");
  return gse;
}

std::vector<Expression> CalledRoutines::functions_of(const std::shared_ptr<const CompiledRoutine>& routine,
                                                     std::size_t first, std::size_t count, const Span& at) const {
  std::vector<Atom> inputs = routine->inputs();
  for (Atom& a : inputs) a.set_place(at);
  std::vector<Expression> values;
  for (std::size_t v = first; v < first + count; ++v) values.push_back(routine_expression(inputs, routine, v, at));
  return values;
}

std::shared_ptr<const StateEquations> CalledRoutines::find_state_equations(const Statement& s,
                                                                           const WrittenArgument* call) {
  const auto kinds = routines_of(catalogue_, s.name);
  const auto kind_of = [&](StateRoutine which) -> const RoutineKind& { return kinds[static_cast<std::size_t>(which)]; };
  auto what = says(s, call, kind_of(StateRoutine::system));
  if (!what) return nullptr;
  const auto tell = [&] {
    what->gse = std::make_shared<const sAdamsGSE>(says_of_states(s, *what->constants));
    what->told.structure = what->gse;
  };
  tell();
  const sAdamsGSE gse = *what->gse;
  // Whoever reads the statement says that these are too many, or that their ARRAYs are missing.
  const auto exists = [&](int array) { return statement(ArrayClass::statement, array) != nullptr; };
  const bool placed = (gse.NS == 0 || exists(gse.X)) && (gse.ND == 0 || exists(gse.XD)) &&
                      (argument(s, "U") == nullptr || exists(gse.U));
  if (!placed || std::max({gse.NS, gse.NO, gse.ND}) > most_numbers) return nullptr;
  const auto ns = static_cast<std::size_t>(gse.NS), no = static_cast<std::size_t>(gse.NO),
             nd = static_cast<std::size_t>(gse.ND);
  const Span at = call ? call->value_span() : s.at;
  const StateRoutineNames names = state_routine_names(s);
  if (!names.fit) return nullptr;
  const auto find = [&](const std::string& written, std::initializer_list<std::string_view> by_default) {
    return find_named(written, {by_default.begin(), by_default.size()});
  };
  // Where it is named, or else where it is called.
  const auto missing = [&](const std::string& written, std::string_view by_default, std::string_view hint = {}) {
    const WrittenArgument* naming =
        names_one(written) ? argument(s, names.asks_for_interface ? "INTERFACE" : "ROUTINE") : nullptr;
    diagnostics_.error(
        "missing-routine", naming ? naming->value_span() : at,
        fmt::format("{} calls {}, and no library has it", s.at.text(), naming ? written : by_default),
        hint.empty() ? "--user-library names libraries; nm -D FILE.so lists what is in one" : std::string(hint));
    return nullptr;
  };
  // Also what this GSE does not call: the name is a slip.
  for (const std::string& written : names.asks_for_interface ? std::span<const std::string>(names.interface)
                                                             : std::span<const std::string>(names.system)) {
    if (names_one(written) && !find(written, {})) return missing(written, {});
  }

  auto out = std::make_shared<StateEquations>();
  FoundRoutine derivatives = find(names.interface[0], {kind_of(StateRoutine::derivatives).routine});
  FoundRoutine outputs = find(names.interface[2], {kind_of(StateRoutine::outputs).routine});
  FoundRoutine system =
      names.asks_for_interface ? FoundRoutine{} : find(names.system[0], {kind_of(StateRoutine::system).routine});
  const bool separate =
      names.asks_for_interface || (!names.asks_for_system && ((derivatives && ns > 0) || (outputs && no > 0)));
  if (ns + no > 0 && !separate && names.asks_for_system && !system)
    return missing(names.system[0], kind_of(StateRoutine::system).routine);
  if (ns + no > 0 && !separate && system) {
    StatePartialRoutines partials = {find(names.system[1], {"gsexx"}),
                                     find(names.system[2], {"gsexu"}),
                                     find(names.system[3], {"gseyx"}),
                                     find(names.system[4], {"gseyu"}),
                                     {},
                                     {}};
    const auto routine =
        made(s, at, std::move(system), kind_of(StateRoutine::system), ns + no, *what, std::move(partials));
    if (!routine) return nullptr;
    out->derivatives = functions_of(routine, 0, ns, at), out->outputs = functions_of(routine, ns, no, at);
  } else {
    constexpr std::string_view either = "a GSE calls gse_deriv and gse_output, or gsesub alone";
    if (ns > 0 && !derivatives) return missing(names.interface[0], kind_of(StateRoutine::derivatives).routine, either);
    if (no > 0 && !outputs) return missing(names.interface[2], kind_of(StateRoutine::outputs).routine, either);
    const auto take = [&](FoundRoutine found, const RoutineKind& kind, std::size_t count, std::vector<Expression>& to) {
      if (count == 0) return true;
      const auto routine = made(s, at, std::move(found), kind, count, *what);
      if (routine) to = functions_of(routine, 0, count, at);
      return routine != nullptr;
    };
    const bool first = take(std::move(derivatives), kind_of(StateRoutine::derivatives), ns, out->derivatives);
    if (!take(std::move(outputs), kind_of(StateRoutine::outputs), no, out->outputs) || !first) return nullptr;
  }
  if (nd == 0) return out;

  FoundRoutine update = find(names.interface[1], {kind_of(StateRoutine::update).routine});
  if (!update)
    return missing(names.interface[1], kind_of(StateRoutine::update).routine, "ND discrete states need gse_update");
  const auto updates = made(s, at, std::move(update), kind_of(StateRoutine::update), nd, *what);
  if (!updates) return nullptr;
  out->update = functions_of(updates, 0, nd, at), out->update_name = updates->name();
  const WrittenArgument* period = argument(s, "SAMPLE_PERIOD");
  if (period && !calls_routine(*period)) return out;
  FoundRoutine sample = find(names.interface[3], {kind_of(StateRoutine::sample).routine, "gse_sample"});
  if (!sample) {
    return missing(names.interface[3], kind_of(StateRoutine::sample).routine,
                   "SAMPLE_PERIOD= gives the time between samples as well");
  }
  if (period) {
    auto constants = constants_of(*period, what->element);
    if (!constants) return nullptr;
    what->constants = std::make_shared<const RoutineConstants>(*constants);
    tell();
  }
  const auto samples = made(s, at, std::move(sample), kind_of(StateRoutine::sample), 1, *what);
  if (!samples) return nullptr;
  out->period = functions_of(samples, 0, 1, at).front(), out->period_name = samples->name();
  return out;
}

std::string CalledRoutines::written(std::shared_ptr<const StateEquations> equations, const Span& at) {
  functions.push_back(StateEquations::written(std::move(equations), at));
  return fmt::format(", FUNCTION={}", functions.size() - 1);
}

}  // namespace dynalin
