// INTEGRATOR/…: how SIMULATE/DYNAMICS integrates.
#include "command/commands/integrator.h"

namespace dynalin::commands {

namespace {

constexpr auto integrator_rows = std::to_array<SettingRow>({
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

std::optional<std::string> integrator_held(std::string_view label, bool stated, const Settings& settings) {
  if (stated || label != "HMAX" || !settings.integrator.interpolate.value_or(false)) return std::nullopt;
  return "none";
}

constexpr std::array<std::string_view, 2> shorthands = {"GSTIFF", "WSTIFF"};
constexpr SettingList integrator_list{.rows = integrator_rows, .held = integrator_held, .shorthands = shorthands};

}  // namespace

std::span<const CommandKind> integrator() {
  static constexpr CommandKind kind = setting<Integrator>("INTEGRATOR", "how SIMULATE/DYNAMICS integrates",
                                                          "INTEGRATOR/GSTIFF, ERROR=1E-4", integrator_list);
  return {&kind, 1};
}

}  // namespace dynalin::commands
