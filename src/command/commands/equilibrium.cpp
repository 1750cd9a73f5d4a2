// EQUILIBRIUM/…: how SIMULATE/STATICS searches.
#include "command/commands/equilibrium.h"

#include <fmt/format.h>

#include <cmath>

#include "analysis/static_settings.h"

namespace dynalin::commands {

namespace {

constexpr auto equilibrium_rows = std::to_array<SettingRow>({
    {"ALIMIT", "ALIMIT", "0.174533 (rad)", Shown::angle, true},
    {"ERROR", "ERROR", "0.000100", Shown::number},
    {"IMBALANCE", "IMBALANCE", "0.000100", Shown::number},
    {"MAXIT", "MAXIT", "500"},
    {"PATTERN", "PATTERN", "none", Shown::pattern},
    {"STABILITY", "STABILITY", "none", Shown::number},
    {"TLIMIT", "TLIMIT", "none", Shown::number, true},
    {"METHOD", "METHOD", "ADVANCED"},
    {"ATOL", "ATOL", without_effect, Shown::number},
    {"RTOL", "RTOL", without_effect, Shown::number},
    {"MAXITL", "MAXITL", without_effect},
    {"ETAMAX", "ETAMAX", without_effect, Shown::number},
    {"ETA", "ETA", without_effect, Shown::number},
});

// What holds where other arguments decide: defaults that follow them, and statements that they leave without effect.
std::optional<std::string> equilibrium_held(std::string_view label, bool stated, const Settings& settings) {
  const StaticsOptions options = statics_options(settings.equilibrium);
  const bool newton = options.original.has_value();
  const OriginalMethod method = options.original.value_or(OriginalMethod());
  if (label == "METHOD" && options.motion) return "DYNAMIC";
  if (label == "METHOD" && !stated && newton) return "ORIGINAL";
  if (label == "MAXIT") return fmt::format("{}", newton ? method.iteration_limit : options.iteration_limit);
  if (label == "PATTERN" || label == "STABILITY") {
    if (!newton) return std::string(stated ? without_effect : "none");
    if (stated) return std::nullopt;
    return label == "PATTERN" ? std::string("TTTTTTTTTT") : shown_number(method.stability, Shown::number);
  }
  if (label == "TLIMIT") {
    const double most = newton ? method.limits.translation : options.limits.translation;
    return std::isfinite(most) ? shown_number(most, Shown::number) : "none";
  }
  return std::nullopt;
}

// How the damped motion ends, where one comes first.
SettingLines motion_lines(const Settings& settings) {
  const auto motion = statics_options(settings.equilibrium).motion;
  if (!motion) return {};
  SettingLines lines;
  lines.emplace_back("GLOBAL_DAMPING", shown_number(motion->global_damping, Shown::number));
  lines.emplace_back("ACCELERATION_ERROR", shown_number(motion->acceleration_error, Shown::number));
  lines.emplace_back("KINETIC_ENERGY_ERROR", shown_number(motion->kinetic_energy_error, Shown::number));
  lines.emplace_back("SETTLING_TIME", std::isfinite(motion->longest_time)
                                          ? shown_number(motion->longest_time, Shown::number)
                                          : std::string("none"));
  return lines;
}

constexpr SettingList equilibrium_list{.rows = equilibrium_rows, .held = equilibrium_held, .more = motion_lines};

}  // namespace

std::span<const CommandKind> equilibrium() {
  static constexpr CommandKind kind = setting<Equilibrium>("EQUILIBRIUM", "how SIMULATE/STATICS searches",
                                                           "EQUILIBRIUM/MAXIT=100, ALIMIT=5D", equilibrium_list);
  return {&kind, 1};
}

}  // namespace dynalin::commands
