#include "elements/settings/analysis_settings.h"

#include "elements/settings/setting_set.h"

namespace dynalin {

extern constinit const Kind equilibrium = setting<WrittenEquilibrium>("EQUILIBRIUM", "Settings of static analyses.");
extern constinit const Kind ic = setting<WrittenInitialConditions>("IC", "Settings of the initial conditions.");
extern constinit const Kind integrator = setting<WrittenIntegrator>("INTEGRATOR", "Settings of the integrator.");
extern constinit const Kind kinematics = setting<WrittenKinematics>("KINEMATICS", "Settings of kinematic analyses.");
extern constinit const Kind lsolver = setting<WrittenLinearSolver>("LSOLVER", "Choice of the linear solver.");
extern constinit const Kind debug = setting<WrittenDebug>("DEBUG", "Diagnostic output.");
extern constinit const Kind preferences = setting<WrittenPreferences>("PREFERENCES", "Preferences of the solver.");

}  // namespace dynalin
