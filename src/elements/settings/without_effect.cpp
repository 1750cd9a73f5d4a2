// Statements that a linear model does not need.
#include "elements/families/kept_as_text.h"

namespace dynalin {

namespace {

constexpr Kind inert(std::string_view statement, std::string_view summary) {
  return kept_as_text(statement, summary, Kind::Role::inert);
}

}  // namespace

extern constinit const Kind graphics = inert("GRAPHICS", "A shape for the display.");
extern constinit const Kind request = inert("REQUEST", "Output of time histories.");
extern constinit const Kind mrequest = inert("MREQUEST", "Output of time histories for groups of elements.");
extern constinit const Kind output = inert("OUTPUT", "What is written to which file.");
extern constinit const Kind results = inert("RESULTS", "Contents of the results file.");
extern constinit const Kind debug = inert("DEBUG", "Diagnostic output.");
extern constinit const Kind lsolver = inert("LSOLVER", "Choice of the linear solver.");
extern constinit const Kind integrator = inert("INTEGRATOR", "Settings of the integrator.");
extern constinit const Kind kinematics = inert("KINEMATICS", "Settings of kinematic analyses.");
extern constinit const Kind equilibrium = inert("EQUILIBRIUM", "Settings of static analyses.");
extern constinit const Kind ic = inert("IC", "Settings of the initial conditions.");
extern constinit const Kind femdata = inert("FEMDATA", "Output of loads for finite-element programs.");
extern constinit const Kind timgraphics = inert("TIMGRAPHICS", "Graphics over time.");
extern constinit const Kind string = inert("STRING", "Text for subroutines.");
extern constinit const Kind material = inert("MATERIAL", "Material data.");

}  // namespace dynalin
