#include "elements/settings/analysis_settings.h"

#include <fmt/format.h>

#include "base/enumeration.h"
#include "dataset/characters.h"
#include "elements/settings/setting_set.h"

namespace dynalin {

namespace {

constexpr std::array<std::string_view, 4> methods = {"ORIGINAL", "ADVANCED", "AGGRESSIVE", "ALL"};
constexpr std::array<std::string_view, 2> yes_or_no = {"TRUE", "FALSE"};
constexpr std::array<std::string_view, 2> on_or_off = {"ON", "OFF"};
constexpr std::array<std::string_view, 6> switches = {"ON", "OFF", "YES", "NO", "TRUE", "FALSE"};
constexpr std::array<std::string_view, 3> solvers = {"F77", "FORTRAN", "CXX"};
constexpr std::size_t longest_pattern = 10;

bool begins(std::string_view word, std::string_view written) { return !written.empty() && word.starts_with(written); }

// The word that a beginning of it means.
template <std::size_t n>
std::optional<std::size_t> found(const std::array<std::string_view, n>& words, std::string_view written) {
  std::optional<std::size_t> one;
  for (std::size_t k = 0; k < n; ++k) {
    if (!begins(words[k], written)) continue;
    if (one) return std::nullopt;
    one = k;
  }
  return one;
}

template <std::size_t n>
bool check_words(const std::vector<std::string>& written, const std::array<std::string_view, n>& words,
                 std::string_view argument, ElementReader& reader) {
  for (const std::string& w : written) {
    if (found(words, w)) continue;
    reader.error(
        "unknown-word", reader.at(argument),
        fmt::format("{} of {} takes {}, not {}", argument, reader.label().statement, enumeration(words, "or"), w));
    return false;
  }
  return true;
}

}  // namespace

bool WrittenEquilibrium::check(ElementReader& reader) const {
  if (!check_words(method, methods, "METHOD", reader) || !check_words(pattern, yes_or_no, "PATTERN", reader))
    return false;
  if (method.size() > 1) {
    reader.error("unknown-word", reader.at("METHOD"), "METHOD of EQUILIBRIUM takes one word");
    return false;
  }
  if (pattern.size() <= longest_pattern) return true;
  reader.error("value-out-of-range", reader.at("PATTERN"),
               fmt::format("PATTERN of EQUILIBRIUM has at most {} entries", longest_pattern));
  return false;
}

bool WrittenIntegrator::check(ElementReader& reader) const {
  if (!check_words(interpolate, on_or_off, "INTERPOLATE", reader)) return false;
  const auto refuse = [&](std::string_view argument, std::string why) {
    reader.error("value-out-of-range", reader.at(argument), fmt::format("{} of INTEGRATOR {}", argument, why));
    return false;
  };
  if (error == 0.0) return refuse("ERROR", "must be more than 0");
  const std::int64_t highest_order = abam ? 12 : 6;
  if (kmax > highest_order) return refuse("KMAX", fmt::format("is {}, the highest order is {}", *kmax, highest_order));
  if (hmin && hmax && *hmax > 0 && *hmax < *hmin) return refuse("HMAX", fmt::format("is {:g}, less than HMIN", *hmax));
  return true;
}

bool WrittenPreferences::check(ElementReader& reader) const {
  bool ok = check_words(solver, solvers, "SOLVER", reader);
  for (const auto& [word, name] : {std::pair{&simexit, "SIMEXIT"}, std::pair{&status_message, "STATUS_MESSAGE"}}) {
    if (word->given && !word->word.empty()) ok &= check_words({upper_case(word->word)}, switches, name, reader);
  }
  return ok;
}

EquilibriumSettings WrittenEquilibrium::stated() const {
  EquilibriumSettings s;
  s.error = error, s.imbalance = imbalance, s.stability = stability;
  s.translation_limit = tlimit, s.rotation_limit = alimit, s.iteration_limit = maxit;
  if (!pattern.empty()) {
    auto& anew = s.pattern.emplace();
    for (const std::string& w : pattern) anew.push_back(found(yes_or_no, w) == 0u);
  }
  if (!method.empty()) s.newton = found(methods, method.front()) == 0u;
  if (is_static || is_dynamic) s.by_motion = is_dynamic;
  s.global_damping = global_damping, s.acceleration_error = acceleration_error;
  s.kinetic_energy_error = kinetic_energy_error;
  s.settling_time = settling_time && end ? std::min(*settling_time, *end) : settling_time ? settling_time : end;
  return s;
}

extern constinit const Kind equilibrium = setting<WrittenEquilibrium>("EQUILIBRIUM", "Settings of static analyses.");
extern constinit const Kind ic = setting<WrittenInitialConditions>("IC", "Settings of the initial conditions.");
extern constinit const Kind integrator = setting<WrittenIntegrator>("INTEGRATOR", "Settings of the integrator.");
extern constinit const Kind kinematics = setting<WrittenKinematics>("KINEMATICS", "Settings of kinematic analyses.");
extern constinit const Kind lsolver =
    setting<WrittenLinearSolver>("LSOLVER", "Choice of the linear solver.").without_effect();
extern constinit const Kind debug = setting<WrittenDebug>("DEBUG", "Diagnostic output.");
extern constinit const Kind preferences = setting<WrittenPreferences>("PREFERENCES", "Preferences of the solver.");

}  // namespace dynalin
