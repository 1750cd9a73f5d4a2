#include "command/settings_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>

#include "analysis/static_settings.h"
#include "command/command_catalogue.h"
#include "command/run_state.h"
#include "command/statement_text.h"

namespace dynalin {

namespace {

enum class Shown : std::uint8_t {
  text,      // as written
  number,    // 0.000100
  exponent,  //    1.000000e-05
  angle,     // 0.174533 (rad)
  pattern,   // TTTT
};

// A setting is an argument with its value, or that one of several words which was stated last.
struct Row {
  std::string_view label, words;  // blanks between the words
  std::string_view unstated;      // what holds where it is not stated, unless other settings say more (held)
  Shown shown = Shown::text;
};

constexpr std::string_view without_effect = "without effect";
constexpr auto equilibrium = std::to_array<Row>({
    {"ALIMIT", "ALIMIT", "0.174533 (rad)", Shown::angle},
    {"ERROR", "ERROR", "0.000100", Shown::number},
    {"IMBALANCE", "IMBALANCE", "0.000100", Shown::number},
    {"MAXIT", "MAXIT", "500"},
    {"PATTERN", "PATTERN", "none", Shown::pattern},
    {"STABILITY", "STABILITY", "none", Shown::number},
    {"TLIMIT", "TLIMIT", "none", Shown::number},
    {"METHOD", "METHOD", "ADVANCED"},
    {"ATOL", "ATOL", without_effect, Shown::number},
    {"RTOL", "RTOL", without_effect, Shown::number},
    {"MAXITL", "MAXITL", without_effect},
    {"ETAMAX", "ETAMAX", without_effect, Shown::number},
    {"ETA", "ETA", without_effect, Shown::number},
});
constexpr auto integrator = std::to_array<Row>({
    {"TYPE", "GSTIFF WSTIFF HASTIFF DSTIFF HHT NEWMARK ABAM RKF45 CONSTANT_BDF", "IDA"},
    {"FORMULATION", "I3 SI2 SI1", "SI2"},
    {"CORRECTOR", "CORRECTOR", without_effect},
    {"ERROR", "ERROR", "   1.000000e-03", Shown::exponent},
    {"HINIT", "HINIT", "found by the integrator", Shown::exponent},
    {"HMAX", "HMAX", "the output step", Shown::exponent},
    {"HMIN", "HMIN", "none", Shown::exponent},
    {"INTERPOLATE", "INTERPOLATE", "OFF"},
    {"MAXIT", "MAXIT", "4"},
    {"KMAX", "KMAX", "5"},
    {"ALPHA", "ALPHA", without_effect, Shown::number},
    {"BETA", "BETA", without_effect, Shown::number},
    {"GAMMA", "GAMMA", without_effect, Shown::number},
    {"PATTERN", "PATTERN", without_effect, Shown::pattern},
    {"FIXIT", "FIXIT", without_effect},
    {"HRATIO", "HRATIO", without_effect, Shown::number},
    {"MAXERR", "MAXERR", without_effect, Shown::exponent},
});
constexpr auto kinematics = std::to_array<Row>({
    {"ALIMIT", "ALIMIT", "0.523599 (rad)", Shown::angle},
    {"ERROR", "ERROR", "   1.000000e-10", Shown::exponent},
    {"MAXIT", "MAXIT", "25"},
    {"PATTERN", "PATTERN", without_effect, Shown::pattern},
    {"TLIMIT", "TLIMIT", "none", Shown::number},
    {"AERROR", "AERROR", without_effect, Shown::number},
    {"AMAXIT", "AMAXIT", without_effect},
    {"APATTERN", "APATTERN", without_effect, Shown::pattern},
    {"HMAX", "HMAX", "none", Shown::number},
});
constexpr auto initial_conditions = std::to_array<Row>({
    {"ALIMIT", "ALIMIT", "0.500000 (rad)", Shown::angle},
    {"ERROR", "ERROR", "   1.000000e-10", Shown::exponent},
    {"MAXIT", "MAXIT", "50"},
    {"PATTERN", "PATTERN", without_effect, Shown::pattern},
    {"TLIMIT", "TLIMIT", "none", Shown::exponent},
    {"VERROR", "VERROR", "   1.000000e-08", Shown::exponent},
    {"AERROR", "AERROR", "   1.000000e-08", Shown::exponent},
    {"AMAXIT", "AMAXIT", "100"},
    {"APATTERN", "APATTERN", without_effect, Shown::pattern},
});
constexpr auto linear_solver = std::to_array<Row>({
    {"TYPE", "AUTO CALAHAN HARWELL UMF", without_effect},
    {"STABILITY", "STABILITY", without_effect},
});
constexpr auto debug = std::to_array<Row>({
    {"EPRINT", "EPRINT NOEPRINT", "NOEPRINT"},
    {"VERBOSE", "VERBOSE NOVERBOSE", "NOVERBOSE"},
    {"DUMP", "DUMP NODUMP", "NODUMP"},
    {"RHSDUMP", "RHSDUMP NORHSDUMP", "NORHSDUMP"},
    {"JMDUMP", "JMDUMP NOJMDUMP", "NOJMDUMP"},
    {"REQDUMP", "REQDUMP NOREQDUMP", "NOREQDUMP"},
    {"TOPOLOGY", "TOPOLOGY NOTOPOLOGY", "NOTOPOLOGY"},
    {"DOF", "DOF NODOF", "NODOF"},
    {"SCREEN", "SCREEN NOSCREEN", "NOSCREEN"},
});
constexpr auto preferences = std::to_array<Row>({
    {"SOLVER", "SOLVER", "CXX"},
    {"SIMEXIT", "SIMEXIT", "OFF"},
    {"STATUS_MESSAGE", "STATUS_MESSAGE", "ON"},
    {"LIBPATH", "LIBPATH", ""},
    {"CONTACT_GEOMETRY_LIBRARY", "CONTACT_GEOMETRY_LIBRARY", ""},
    {"CONTACT_FACETING_TOLERANCE", "CONTACT_FACETING_TOLERANCE", ""},
    {"NTHREADS", "NTHREADS THREAD", ""},
    {"FLEX_LIMIT_CHECK", "FLEX_LIMIT_CHECK", ""},
});

std::span<const Row> rows_of(std::string_view command) {
  if (command == "EQUILIBRIUM") return equilibrium;
  if (command == "INTEGRATOR") return integrator;
  if (command == "KINEMATICS") return kinematics;
  if (command == "IC") return initial_conditions;
  if (command == "LSOLVER") return linear_solver;
  if (command == "DEBUG") return debug;
  if (command == "PREFERENCES") return preferences;
  return {};
}

bool has_word(std::string_view list, std::string_view word) {
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(' ', begin), list.size());
    if (list.substr(begin, end - begin) == word) return true;
    begin = end + 1;
  }
  return false;
}

// The arguments that were stated, those of the dataset first, by their full names.
class Stated {
 public:
  Stated(std::string_view command, const RunState& run) : command_(command) {
    for (const ArgumentInfo& a : find_command(command)->arguments) names_.push_back(a.name);
    for (const Statement& s : run.system().model().dataset->statements) take(s);
    for (const Command& c : run.settings_done) take(*c.statement);
  }
  // Of the words of a row that which was stated last; nothing if none was.
  const WrittenArgument* last(std::string_view words, std::string_view& word) const {
    const WrittenArgument* found = nullptr;
    for (const auto& [name, argument] : list_) {
      if (has_word(words, name)) found = argument, word = name;
    }
    return found;
  }
  // In the order in which they came, the last of each.
  const std::vector<std::pair<std::string_view, const WrittenArgument*>>& all() const { return list_; }

 private:
  void take(const Statement& s) {
    if (command_ == "INTEGRATOR" && (s.name == "GSTIFF" || s.name == "WSTIFF")) {
      shorthands_.emplace_back().name = s.keyword();
      add(s.name, shorthands_.back());
    } else if (s.name != command_) {
      return;
    }
    for (const WrittenArgument& w : s.arguments) {
      const auto k = find_keyword(w.name.text(), names_);
      if (!k || names_[*k] == "LIST") continue;
      if (names_[*k] == "DEFAULT") {
        list_.clear();
        continue;
      }
      add(names_[*k], w);
    }
  }
  void add(std::string_view name, const WrittenArgument& w) {
    std::erase_if(list_, [&](const auto& known) { return known.first == name; });
    list_.emplace_back(name, &w);
  }

  std::string_view command_;
  std::vector<std::string_view> names_;
  std::vector<std::pair<std::string_view, const WrittenArgument*>> list_;
  std::deque<WrittenArgument> shorthands_;  // GSTIFF and WSTIFF as arguments of INTEGRATOR
};

std::string number_text(double number, Shown shown) {
  if (shown == Shown::angle) return fmt::format("{:.6f} (rad)", number);
  const bool plain = number == 0 || (std::abs(number) >= 1e-4 && std::abs(number) < 1e12);
  return shown == Shown::exponent || !plain ? fmt::format("{:15.6e}", number) : fmt::format("{:.6f}", number);
}

std::string value_text(const WrittenArgument& w, Shown shown) {
  std::string text = argument_text(w);
  if (shown == Shown::pattern) {
    std::erase_if(text, [](char c) { return c == ':' || c == ' '; });
    return text;
  }
  if (shown == Shown::text) return text;
  Diagnostics unused;
  const auto number = read_real(w, *w.name.source, unused);
  return number ? number_text(*number, shown) : text;
}

using Lines = std::vector<std::pair<std::string, std::string>>;

// What holds where other arguments decide: defaults that follow them, and statements that they leave without effect.
std::optional<std::string> held_in_statics(std::string_view label, bool stated, const EquilibriumSettings& settings) {
  const StaticsOptions options = statics_options(settings);
  const bool newton = options.original.has_value();
  const OriginalMethod method = options.original.value_or(OriginalMethod());
  if (label == "METHOD" && options.motion) return "DYNAMIC";
  if (label == "METHOD" && !stated && newton) return "ORIGINAL";
  if (label == "MAXIT") return fmt::format("{}", newton ? method.iteration_limit : options.iteration_limit);
  if (label == "PATTERN" || label == "STABILITY") {
    if (!newton) return std::string(stated ? without_effect : "none");
    if (stated) return std::nullopt;
    return label == "PATTERN" ? std::string("TTTTTTTTTT") : number_text(method.stability, Shown::number);
  }
  if (label == "TLIMIT") {
    const double most = newton ? method.limits.translation : options.limits.translation;
    return std::isfinite(most) ? number_text(most, Shown::number) : "none";
  }
  return std::nullopt;
}

std::optional<std::string> held(std::string_view command, std::string_view label, bool stated,
                                const Settings& settings) {
  if (command == "EQUILIBRIUM") return held_in_statics(label, stated, settings.equilibrium);
  if (stated) return std::nullopt;
  if (command == "INTEGRATOR" && label == "HMAX" && settings.integrator.interpolate.value_or(false)) return "none";
  const double redundancy = settings.initial_conditions.error.value_or(1e-10);
  if (command == "KINEMATICS" && label == "ERROR") return number_text(redundancy, Shown::exponent);
  if (command == "IC" && (label == "VERROR" || label == "AERROR"))
    return number_text(std::max(100 * redundancy, 1e-8), Shown::exponent);
  return std::nullopt;
}

// How the damped motion ends, where one comes first.
void add_motion(const EquilibriumSettings& settings, Lines& lines) {
  const auto motion = statics_options(settings).motion;
  if (!motion) return;
  lines.emplace_back("GLOBAL_DAMPING", number_text(motion->global_damping, Shown::number));
  lines.emplace_back("ACCELERATION_ERROR", number_text(motion->acceleration_error, Shown::number));
  lines.emplace_back("KINETIC_ENERGY_ERROR", number_text(motion->kinetic_energy_error, Shown::number));
  lines.emplace_back("SETTLING_TIME", std::isfinite(motion->longest_time)
                                          ? number_text(motion->longest_time, Shown::number)
                                          : std::string("none"));
}

}  // namespace

std::string settings_list(std::string_view command, const RunState& run) {
  const Stated stated(command, run);
  const std::span<const Row> rows = rows_of(command);
  Lines lines;
  for (const Row& row : rows) {
    std::string_view word;
    const WrittenArgument* w = stated.last(row.words, word);
    std::string value(row.unstated);
    if (w && w->has_value) value = value_text(*w, row.shown);
    if (w && !w->has_value) value = row.words == word ? "ON" : word;
    if (const auto in_force = held(command, row.label, w != nullptr, run.settings)) value = *in_force;
    lines.emplace_back(row.label, std::move(value));
  }
  if (command == "EQUILIBRIUM") add_motion(run.settings.equilibrium, lines);
  // Settings without a list of their own: what was stated.
  if (rows.empty()) {
    for (const auto& [name, w] : stated.all()) lines.emplace_back(name, w->has_value ? argument_text(*w) : "ON");
  }
  std::size_t width = 0;
  for (const auto& [label, value] : lines) width = std::max(width, label.size());
  std::string text = fmt::format("\nCurrent {} settings are:\n", command);
  for (const auto& [label, value] : lines) text += fmt::format("   {:<{}} = {}\n", label, width, value);
  if (lines.empty()) text += "   none is stated\n";
  return text + "\n";
}

}  // namespace dynalin
