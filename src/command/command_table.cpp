#include "command/command_table.h"

#include <algorithm>
#include <array>
#include <vector>

#include "command/linear_command.h"
#include "command/written_commands.h"
#include "elements/settings/analysis_settings.h"
#include "elements/settings/output_settings.h"

namespace dynalin {

namespace {

// The class is a bare word.
constexpr std::array<ArgumentInfo, 3> switching = {{
    {"class", true, true, "", "", "JOINT, SFORCE … : constraints, forces, sensors; the bare word"},
    {"ID", false, false, "ids", "", "the elements"},
    {"RANGE", false, false, "ids", "", "instead of ID: the first and the last id"},
}};

// Made at the first use, so that nothing runs before main.
const std::vector<CommandRow>& rows() {
  static const std::vector<CommandRow> table = {
      CommandRow{"SIMULATE", CommandUse::analysis, "finds an operating point", "SIMULATE/STATICS",
                 detail::argument_infos<WrittenSimulate>},
      CommandRow{"LINEAR", CommandUse::analysis, "linearizes about the operating point and writes what comes out",
                 "LINEAR/EIGENSOL, RM=5, KINETIC=1,4", linear_arguments()},

      CommandRow{"ACTIVATE", CommandUse::model, "takes elements into the model again", "ACTIVATE/JOINT, ID=3",
                 switching},
      CommandRow{"DEACTIVATE", CommandUse::model, "takes elements out of the model", "DEACTIVATE/JOINT, RANGE=1,9",
                 switching},
      CommandRow{"ACCGRAV", CommandUse::model, "", "ACCGRAV/KGRAV=0"},
      CommandRow{"ARRAY", CommandUse::model, "", "ARRAY/1, NUMBERS=1,2"},
      CommandRow{"BEAM", CommandUse::model, "", "BEAM/1, IXX=0.5"},
      CommandRow{"BUSHING", CommandUse::model, "", "BUSHING/1, K=0,0,500"},
      CommandRow{"CONTACT", CommandUse::model, "", ""},
      CommandRow{"COUPLER", CommandUse::model, "", ""},
      CommandRow{"CURVE", CommandUse::model, "", ""},
      CommandRow{"CVCV", CommandUse::model, "", ""},
      CommandRow{"DIFF", CommandUse::model, "", "DIFF/1, FUNCTION=-DIF(1)"},
      CommandRow{"FIELD", CommandUse::model, "", "FIELD/1, CRATIO=0.02"},
      CommandRow{"FLEX_BODY", CommandUse::model, "", ""},
      CommandRow{"FRICTION", CommandUse::model, "", ""},
      CommandRow{"GCON", CommandUse::model, "", "GCON/1, FUNCTION=DX(20,1)-0.1"},
      CommandRow{"GEAR", CommandUse::model, "", ""},
      CommandRow{"GFORCE", CommandUse::model, "", ""},
      CommandRow{"GSE", CommandUse::model, "", ""},
      CommandRow{"JOINT", CommandUse::model, "", "JOINT/1, FIXED"},
      CommandRow{"JPRIM", CommandUse::model, "", ""},
      CommandRow{"LSE", CommandUse::model, "", ""},
      CommandRow{"MARKER", CommandUse::model, "", "MARKER/20, QP=0,0,0.1"},
      CommandRow{"MATRIX", CommandUse::model, "", ""},
      CommandRow{"MFORCE", CommandUse::model, "", ""},
      CommandRow{"MOTION", CommandUse::model, "", "MOTION/1, FUNCTION=20*TIME"},
      CommandRow{"NFORCE", CommandUse::model, "", ""},
      CommandRow{"PART", CommandUse::model, "", "PART/2, MASS=3.5"},
      CommandRow{"PINPUT", CommandUse::model, "", ""},
      CommandRow{"POINT_MASS", CommandUse::model, "", "POINT_MASS/3, MASS=2"},
      CommandRow{"POUTPUT", CommandUse::model, "", ""},
      CommandRow{"PSTATE", CommandUse::model, "", ""},
      CommandRow{"PTCV", CommandUse::model, "", ""},
      CommandRow{"SENSOR", CommandUse::model, "", ""},
      CommandRow{"SFORCE", CommandUse::model, "", "SFORCE/1, FUNCTION=-300*DZ(20,1)"},
      CommandRow{"SPLINE", CommandUse::model, "", "SPLINE/1, Y=0,1,4,9"},
      CommandRow{"SPRINGDAMPER", CommandUse::model, "", "SPRINGDAMPER/1, K=2000"},
      CommandRow{"TFSISO", CommandUse::model, "", "TFSISO/1, NUMERATOR=2"},
      CommandRow{"VARIABLE", CommandUse::model, "", "VARIABLE/1, FUNCTION=0.5"},
      CommandRow{"VFORCE", CommandUse::model, "", ""},
      CommandRow{"VTORQUE", CommandUse::model, "", ""},

      CommandRow{"EQUILIBRIUM", CommandUse::setting, "how SIMULATE/STATICS searches",
                 "EQUILIBRIUM/MAXIT=100, ALIMIT=5D", detail::argument_infos<WrittenEquilibrium>,
                 WrittenEquilibrium::acting},
      CommandRow{"IC", CommandUse::setting, "how far constraints may be from agreeing at the start", "IC/ERROR=1E-6",
                 detail::argument_infos<WrittenInitialConditions>, WrittenInitialConditions::acting},
      CommandRow{"PREFERENCES", CommandUse::setting, "which solver the model was written for", "PREFERENCES/SOLVER=CXX",
                 detail::argument_infos<WrittenPreferences>, WrittenPreferences::acting},
      CommandRow{"INTEGRATOR", CommandUse::setting, "of simulations over time: checked, nothing acts on it",
                 "INTEGRATOR/GSTIFF, ERROR=1E-4", detail::argument_infos<WrittenIntegrator>, WrittenIntegrator::acting},
      CommandRow{"KINEMATICS", CommandUse::setting, "of kinematic simulations: checked, nothing acts on it",
                 "KINEMATICS/ERROR=1E-6", detail::argument_infos<WrittenKinematics>, WrittenKinematics::acting},
      CommandRow{"LSOLVER", CommandUse::setting, "of the solver of equations: checked, nothing acts on it",
                 "LSOLVER/UMF", detail::argument_infos<WrittenLinearSolver>, WrittenLinearSolver::acting},
      CommandRow{"OUTPUT", CommandUse::setting, "of the files of simulations: checked, nothing acts on it",
                 "OUTPUT/NOPRINT", detail::argument_infos<WrittenOutput>, WrittenOutput::acting},
      CommandRow{"REQUEST", CommandUse::setting, "of time histories: checked, nothing acts on it",
                 "REQUEST/1, DISPLACEMENT, I=20, J=1", detail::argument_infos<WrittenRequest>},
      CommandRow{"DEBUG", CommandUse::setting, "of what a solver prints of its work: checked, nothing acts on it",
                 "DEBUG/EPRINT", detail::argument_infos<WrittenDebug>, WrittenDebug::acting},

      CommandRow{"FILE", CommandUse::run, "names the dataset", "FILE/MODEL=car, OUTPUT_PREFIX=car_loaded",
                 detail::argument_infos<WrittenFile>},
      CommandRow{"ENVIRONMENT", CommandUse::run, "sets an environment variable that LINEAR or statics look at",
                 "ENVIRONMENT/NAME=MSC_LINEAR_PBCS_STATES, VALUE=1", detail::argument_infos<WrittenEnvironment>},
      CommandRow{"STOP", CommandUse::run, "ends the file; what stands behind it is not read", "STOP"},

      CommandRow{"GSTIFF", CommandUse::without_effect, "an integrator", "GSTIFF"},
      CommandRow{"HELP", CommandUse::without_effect, "for a session at a prompt", "HELP"},
      CommandRow{"INFO", CommandUse::without_effect, "prints measures of markers in other programs", "INFO"},
      CommandRow{"MENU", CommandUse::without_effect, "for a session at a prompt", "MENU"},
      CommandRow{"SHOW", CommandUse::without_effect, "prints statistics in other programs",
                 "SHOW STATISTICS=SIMULATION"},
      CommandRow{"STRING", CommandUse::without_effect, "text for compiled routines", "STRING/1, STRING=text"},
      CommandRow{"TIME", CommandUse::without_effect, "prints the time in other programs", "TIME"},
      CommandRow{"WSTIFF", CommandUse::without_effect, "an integrator", "WSTIFF"},

      CommandRow{"CONTROL", CommandUse::not_built, "a compiled routine that gives the commands",
                 "CONTROL/FUNCTION=USER(1)"},
      CommandRow{"RELOAD", CommandUse::not_built, "goes on from a saved state", "RELOAD/STATES, FILE=saved"},
      CommandRow{"SAVE", CommandUse::not_built, "saves a state", "SAVE/STATES, FILE=saved"},
      CommandRow{"SYSTEM", CommandUse::not_built, "runs a command of the operating system", "SYSTEM"},
  };
  return table;
}

}  // namespace

std::span<const CommandRow> command_table() { return rows(); }

std::span<const std::string_view> command_names() {
  static const auto names = [] {
    std::vector<std::string_view> list;
    for (const CommandRow& row : rows()) list.push_back(row.name);
    return list;
  }();
  return names;
}

const CommandRow* find_command(std::string_view name) {
  const auto found =
      std::find_if(rows().begin(), rows().end(), [&](const CommandRow& row) { return row.name == name; });
  return found == rows().end() ? nullptr : &*found;
}

}  // namespace dynalin
