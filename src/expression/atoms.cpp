// Table of the functions that yield atoms: names, kinematic orders, argument counts.
#include <array>

#include "expression/expression.h"

namespace dynalin {

namespace {

using enum AtomFamily;
using std::int8_t;
using std::uint8_t;

constexpr int8_t by_reference = -1;

constexpr AtomFunction measure(std::string_view name, int8_t order, uint8_t minimum, uint8_t maximum) {
  return {name, marker_measure, order, minimum, maximum, "", true};
}
constexpr AtomFunction from_data(std::string_view name, uint8_t arguments, std::string_view statement) {
  return {name, data, by_reference, arguments, arguments, statement, true};
}
constexpr AtomFunction at_marker(std::string_view name, uint8_t maximum) {
  return {name, marker_force, by_reference, 1, maximum, "", true};
}
enum Availability : bool { not_built = false, built = true };
// (id, jflag, comp, rm)
constexpr AtomFunction of_element(std::string_view name, std::string_view statement, Availability availability) {
  return {name, element_force, by_reference, 4, 4, statement, availability};
}

constexpr std::array table = {
    // clang-format off
    AtomFunction{"TIME", AtomFamily::time, 0, 0, 0, "", true},
    // Displacements: (i, j, k), (i, j) where no axes are needed.
    measure("DX", 0, 1, 3),     measure("DY", 0, 1, 3),     measure("DZ", 0, 1, 3),     measure("DM", 0, 1, 2),
    // Velocities: (i, j, k, l), (i, j, l) for the norms.
    measure("VX", 1, 1, 4),     measure("VY", 1, 1, 4),     measure("VZ", 1, 1, 4),     measure("VM", 1, 1, 3),
    measure("VR", 1, 1, 3),
    measure("WX", 1, 1, 3),     measure("WY", 1, 1, 3),     measure("WZ", 1, 1, 3),     measure("WM", 1, 1, 2),
    // Accelerations: (i, j, k, l), (i, j, l) for the norms.
    measure("ACCX", 2, 1, 4),   measure("ACCY", 2, 1, 4),   measure("ACCZ", 2, 1, 4),   measure("ACCM", 2, 1, 3),
    measure("WDTX", 2, 1, 4),   measure("WDTY", 2, 1, 4),   measure("WDTZ", 2, 1, 4),   measure("WDTM", 2, 1, 3),
    // Angles: (i, j).
    measure("AX", 0, 1, 2),     measure("AY", 0, 1, 2),     measure("AZ", 0, 1, 2),
    measure("PSI", 0, 1, 2),    measure("THETA", 0, 1, 2),  measure("PHI", 0, 1, 2),
    measure("YAW", 0, 1, 2),    measure("PITCH", 0, 1, 2),  measure("ROLL", 0, 1, 2),
    measure("INCANG", 0, 3, 3),
    // Axes of marker i, component by component in the axes of k: (i, k). The dot keeps the names out of the language.
    measure("UVX.X", 0, 1, 2),  measure("UVX.Y", 0, 1, 2),  measure("UVX.Z", 0, 1, 2),
    measure("UVY.X", 0, 1, 2),  measure("UVY.Y", 0, 1, 2),  measure("UVY.Z", 0, 1, 2),
    measure("UVZ.X", 0, 1, 2),  measure("UVZ.Y", 0, 1, 2),  measure("UVZ.Z", 0, 1, 2),
    // Angles together, smooth where each of them is not (smooth_angles.cpp); no names of the language either.
    measure("PSI.PLUS.PHI", 0, 1, 2),  measure("PSI.MINUS.PHI", 0, 1, 2),  measure("THETA.SQUARED", 0, 1, 2),
    measure("YAW.PLUS.ROLL", 0, 1, 2), measure("YAW.MINUS.ROLL", 0, 1, 2), measure("INCANG.SQUARED", 0, 3, 3),
    measure("INCANG.COSINE", 0, 3, 3),
    // Net force and torque on a marker: (i, j, k), (i, j).
    at_marker("FX", 3), at_marker("FY", 3), at_marker("FZ", 3), at_marker("FM", 2),
    at_marker("TX", 3), at_marker("TY", 3), at_marker("TZ", 3), at_marker("TM", 2),
    of_element("BEAM",     "BEAM",         built),
    of_element("BUSH",     "BUSHING",      built),
    of_element("FIELD",    "FIELD",        built),
    of_element("SFORCE",   "SFORCE",       built),
    of_element("SPDP",     "SPRINGDAMPER", built),
    of_element("VFORCE",   "VFORCE",       built),
    of_element("VTORQ",    "VTORQUE",      built),
    of_element("GFORCE",   "GFORCE",       built),
    of_element("NFORCE",   "NFORCE",       not_built),
    of_element("CONTACT",  "CONTACT",      not_built),
    of_element("FRICTION", "FRICTION",     not_built),
    of_element("JOINT",    "JOINT",        built),
    of_element("JPRIM",    "JPRIM",        built),
    of_element("MOTION",   "MOTION",       built),
    of_element("PTCV",     "PTCV",         built),
    of_element("CVCV",     "CVCV",         built),
    from_data("VARVAL", 1, "VARIABLE"),
    from_data("ARYVAL", 2, "ARRAY"),
    from_data("DIF",    1, "DIFF"),
    from_data("DIF1",   1, "DIFF"),
    from_data("PINVAL", 2, "PINPUT"),
    from_data("POUVAL", 2, "POUTPUT"),
    // What the sensor's EVALUATE stored when it last triggered: 0 before, constant while a model is linearized.
    AtomFunction{"SENVAL", data, 0, 1, 1, "SENSOR", true, "EVALUATE"},
    // Its arguments are expressions, but for an id in the fourth place.
    AtomFunction{"DELAY", AtomFamily::delay, by_reference, 3, 4, "", true},
    // The kind of analysis as a number: constant during each.
    AtomFunction{"MODE", data, 0, 0, 0, "", true},
    // clang-format on
};

}  // namespace

std::span<const AtomFunction> atom_functions() { return table; }

const AtomFunction* find_atom_function(std::string_view name) {
  for (const AtomFunction& f : table) {
    if (f.name == name) return &f;
  }
  return nullptr;
}

ReferenceClass reference_class(const AtomFunction& function, std::size_t argument) {
  if (function.statement.empty()) return ReferenceClass::marker;
  if (argument == 0) return ReferenceClass::element;
  const bool axes = function.family == AtomFamily::element_force && argument == 3;
  return axes ? ReferenceClass::marker : ReferenceClass::index;
}

}  // namespace dynalin
