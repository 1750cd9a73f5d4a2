#include "routine/routine_kinds.h"

#include <array>

namespace dynalin {

namespace {
using enum RoutineArguments;
constexpr std::array<RoutineKind, 19> kinds = {{
    {"VARIABLE", "varsub", 1, function},
    {"SFORCE", "sfosub", 1, function},
    {"GFORCE", "gfosub", 6, function},
    {"VFORCE", "vfosub", 3, function},
    {"VTORQUE", "vtosub", 3, function},
    {"FIELD", "fiesub", 6, field},
    {"CONTACT", "cnfsub", 3, pressure, "NFUNCTION", "NROUTINE"},
    {"CONTACT", "cffsub", 3, friction, "FFUNCTION", "FROUTINE"},
    {"COUPLER", "cousub", 1, coupler},
    {"FLEX_BODY", "dmpsub", 0, damping, "CRATIO"},
    {"NFORCE", "nfosub", 0, function},
    {"MFORCE", "mfosub", 0, modal},
    {"MFORCE", "mfosub", 0, modal, "FORCE"},
    {"CURVE", "cursub", 3, curve},
    {"DIFF", "difsub", 1, function},
    {"MOTION", "motsub", 1, of_time},
    {"REQUEST", "reqsub", 8, plain},
    {"SENSOR", "sensub", 1, plain},
    {"SENSOR", "sevsub", 1, plain, "EVALUATE", "EVALUATE_ROUTINE"},
}};
constexpr StateEquationKinds of_gse = {{"GSE", "gse_deriv", 0, counted},
                                       {"GSE", "gse_output", 0, counted},
                                       {"GSE", "gse_update", 0, counted},
                                       {"GSE", "gse_samp", 1, plain},
                                       {"GSE", "gsesub", 0, RoutineArguments::system}};
}  // namespace

const StateEquationKinds& state_equation_kinds() { return of_gse; }

std::span<const RoutineKind> routine_kinds() { return kinds; }

}  // namespace dynalin
