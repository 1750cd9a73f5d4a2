// Table of the functions that yield atoms: names, kinematic orders, argument counts.
#include <algorithm>
#include <array>
#include <optional>

#include "expression/expression.h"
#include "expression/name_index.h"

namespace dynalin {

namespace {

using enum AtomFamily;
using enum Measure;
using std::int8_t;
using std::uint8_t;

constexpr int8_t by_reference = -1;

constexpr std::string_view markers =
    "i, j, k, l  ids of markers, 0 or left out for the global frame; trailing ones may be left out";
constexpr std::string_view marker_of_force =
    "i  id of the marker that is acted on\n"
    "j  id of the other marker; 0 or left out: all elements that act on i\n"
    "k  id of the marker whose axes are used, 0 or left out for global ones: FX(5, 0, 7)";
constexpr std::string_view element_of_force =
    "id     of the statement\n"
    "jflag  0: on its I marker, 1: on its J marker\n"
    "comp   1 … 8: FM, FX, FY, FZ, TM, TX, TY, TZ\n"
    "rm     id of the marker whose axes are used, 0 for global ones";

constexpr AtomFunction measure(std::string_view name, Measure which, int8_t order, uint8_t minimum, uint8_t maximum,
                               FunctionText text = {}) {
  return {name, marker_measure, order, minimum, maximum, "", true, text, {}, DataSource::none, which};
}
constexpr AtomFunction from_data(std::string_view name, DataSource reads, uint8_t arguments, std::string_view statement,
                                 FunctionText text) {
  return {name, data, by_reference, arguments, arguments, statement, true, text, {}, reads};
}
// Constant in each step, 0 before anything is integrated.
constexpr AtomFunction of_integration(std::string_view name, DataSource reads, std::string_view meaning) {
  return {name, data, 0, 0, 0, "", true, {"", meaning, "", "of a simulation over time; 0 before the first"}, {}, reads};
}
constexpr AtomFunction at_marker(std::string_view name, uint8_t maximum, std::string_view meaning,
                                 std::string_view unit) {
  return {name,         marker_force,
          by_reference, 1,
          maximum,      "",
          true,         {maximum == 3 ? "i [, j [, k]]" : "i [, j]", meaning, unit, marker_of_force}};
}
// An FE_LOAD puts what it reads in its place; nothing else has any.
constexpr AtomFunction of_place(std::string_view name, std::string_view meaning, std::string_view unit) {
  return {name,
          data,
          by_reference,
          1,
          1,
          "",
          true,
          {"n", meaning, unit, "n  1, 2, 3 for x, y, z of the line, 4, 5, 6 of its sections; in FE_LOAD alone"}};
}
enum Availability : bool { not_built = false, built = true };
constexpr AtomFunction of_element(std::string_view name, std::string_view statement, Availability availability,
                                  std::string_view meaning) {
  return {
      name, element_force, by_reference, 4,
      4,    statement,     availability, {"id, jflag, comp, rm", meaning, "force, or force·length", element_of_force}};
}

constexpr std::array atom_table = {
    AtomFunction{"TIME",
                 AtomFamily::time,
                 0,
                 0,
                 0,
                 "",
                 true,
                 {"", "the time", "time", "in a linear model that of the operating point"}},
    // Displacements: (i, j, k), (i, j) where no axes are needed.
    measure("DX", DX, 0, 1, 3,
            {"i [, j [, k]]", "x of the displacement of marker i from j, along the axes of k", "length", markers}),
    measure("DY", DY, 0, 1, 3,
            {"i [, j [, k]]", "y of the displacement of marker i from j, along the axes of k", "length", markers}),
    measure("DZ", DZ, 0, 1, 3,
            {"i [, j [, k]]", "z of the displacement of marker i from j, along the axes of k", "length", markers}),
    measure("DM", DM, 0, 1, 2, {"i [, j]", "distance of marker i from j", "length", markers}),
    // Velocities: (i, j, k, l), (i, j, l) for the norms.
    measure("VX", VX, 1, 1, 4,
            {"i [, j [, k [, l]]]",
             "x of the velocity of marker i relative to j, along the axes of k, derivative taken in l", "length/time",
             markers}),
    measure("VY", VY, 1, 1, 4,
            {"i [, j [, k [, l]]]",
             "y of the velocity of marker i relative to j, along the axes of k, derivative taken in l", "length/time",
             markers}),
    measure("VZ", VZ, 1, 1, 4,
            {"i [, j [, k [, l]]]",
             "z of the velocity of marker i relative to j, along the axes of k, derivative taken in l", "length/time",
             markers}),
    measure("VM", VM, 1, 1, 3,
            {"i [, j [, l]]", "size of the velocity of marker i relative to j, derivative taken in l", "length/time",
             markers}),
    measure("VR", VR, 1, 1, 3,
            {"i [, j [, l]]", "rate of the distance of marker i from j, positive where they separate", "length/time",
             markers}),
    measure("WX", WX, 1, 1, 3,
            {"i [, j [, k]]", "x of the angular velocity of marker i relative to j, along the axes of k", "rad/time",
             markers}),
    measure("WY", WY, 1, 1, 3,
            {"i [, j [, k]]", "y of the angular velocity of marker i relative to j, along the axes of k", "rad/time",
             markers}),
    measure("WZ", WZ, 1, 1, 3,
            {"i [, j [, k]]", "z of the angular velocity of marker i relative to j, along the axes of k", "rad/time",
             markers}),
    measure("WM", WM, 1, 1, 2,
            {"i [, j]", "size of the angular velocity of marker i relative to j", "rad/time", markers}),
    // Accelerations: (i, j, k, l), (i, j, l) for the norms.
    measure("ACCX", ACCX, 2, 1, 4,
            {"i [, j [, k [, l]]]",
             "x of the acceleration of marker i relative to j, along the axes of k, derivative taken in l",
             "length/time²", markers}),
    measure("ACCY", ACCY, 2, 1, 4,
            {"i [, j [, k [, l]]]",
             "y of the acceleration of marker i relative to j, along the axes of k, derivative taken in l",
             "length/time²", markers}),
    measure("ACCZ", ACCZ, 2, 1, 4,
            {"i [, j [, k [, l]]]",
             "z of the acceleration of marker i relative to j, along the axes of k, derivative taken in l",
             "length/time²", markers}),
    measure("ACCM", ACCM, 2, 1, 3,
            {"i [, j [, l]]", "size of the acceleration of marker i relative to j, derivative taken in l",
             "length/time²", markers}),
    measure("WDTX", WDTX, 2, 1, 4,
            {"i [, j [, k [, l]]]",
             "x of the angular acceleration of marker i relative to j, along the axes of k, derivative taken in l",
             "rad/time²", markers}),
    measure("WDTY", WDTY, 2, 1, 4,
            {"i [, j [, k [, l]]]",
             "y of the angular acceleration of marker i relative to j, along the axes of k, derivative taken in l",
             "rad/time²", markers}),
    measure("WDTZ", WDTZ, 2, 1, 4,
            {"i [, j [, k [, l]]]",
             "z of the angular acceleration of marker i relative to j, along the axes of k, derivative taken in l",
             "rad/time²", markers}),
    measure("WDTM", WDTM, 2, 1, 3,
            {"i [, j [, l]]", "size of the angular acceleration of marker i relative to j, derivative taken in l",
             "rad/time²", markers}),
    // Angles: (i, j).
    measure("AX", AX, 0, 1, 2,
            {"i [, j]", "angle of marker i about the x axis of j; whole turns are counted", "rad", markers}),
    measure("AY", AY, 0, 1, 2,
            {"i [, j]", "angle of marker i about the y axis of j; whole turns are counted", "rad", markers}),
    measure("AZ", AZ, 0, 1, 2,
            {"i [, j]", "angle of marker i about the z axis of j; whole turns are counted", "rad", markers}),
    measure("PSI", PSI, 0, 1, 2,
            {"i [, j]", "first of the 3-1-3 angles (about z, new x, new z) from j to i", "rad", markers}),
    measure("THETA", THETA, 0, 1, 2,
            {"i [, j]", "second of the 3-1-3 angles (about z, new x, new z) from j to i", "rad", markers}),
    measure("PHI", PHI, 0, 1, 2,
            {"i [, j]", "third of the 3-1-3 angles (about z, new x, new z) from j to i", "rad", markers}),
    measure("YAW", YAW, 0, 1, 2,
            {"i [, j]", "first of the 3-2-1 angles (about z, new y, new x) from j to i", "rad", markers}),
    measure("PITCH", PITCH, 0, 1, 2,
            {"i [, j]", "the negative of the second of the 3-2-1 angles from j to i", "rad", markers}),
    measure("ROLL", ROLL, 0, 1, 2, {"i [, j]", "third of the 3-2-1 angles from j to i", "rad", markers}),
    measure("INCANG", INCANG, 0, 3, 3,
            {"i, j, k", "angle at marker j between the lines to i and to k, 0 … π", "rad", "i, j, k  ids of markers"}),
    // Axes of marker i, component by component in the axes of k: (i, k). The dot keeps the names out of the language.
    measure("UVX.X", UVX_X, 0, 1, 2),
    measure("UVX.Y", UVX_Y, 0, 1, 2),
    measure("UVX.Z", UVX_Z, 0, 1, 2),
    measure("UVY.X", UVY_X, 0, 1, 2),
    measure("UVY.Y", UVY_Y, 0, 1, 2),
    measure("UVY.Z", UVY_Z, 0, 1, 2),
    measure("UVZ.X", UVZ_X, 0, 1, 2),
    measure("UVZ.Y", UVZ_Y, 0, 1, 2),
    measure("UVZ.Z", UVZ_Z, 0, 1, 2),
    // Angles together, smooth where each of them is not (smooth_angles.cpp); no names of the language either.
    measure("PSI.PLUS.PHI", PSI_PLUS_PHI, 0, 1, 2),
    measure("PSI.MINUS.PHI", PSI_MINUS_PHI, 0, 1, 2),
    measure("THETA.SQUARED", THETA_SQUARED, 0, 1, 2),
    measure("YAW.PLUS.ROLL", YAW_PLUS_ROLL, 0, 1, 2),
    measure("YAW.MINUS.ROLL", YAW_MINUS_ROLL, 0, 1, 2),
    measure("INCANG.SQUARED", INCANG_SQUARED, 0, 3, 3),
    measure("INCANG.COSINE", INCANG_COSINE, 0, 3, 3),
    // Net force and torque on a marker: (i, j, k), (i, j).
    at_marker("FX", 3, "x of the force on marker i of all elements between i and j, along the axes of k", "force"),
    at_marker("FY", 3, "y of the force on marker i of all elements between i and j, along the axes of k", "force"),
    at_marker("FZ", 3, "z of the force on marker i of all elements between i and j, along the axes of k", "force"),
    at_marker("FM", 2, "size of the force on marker i of all elements between i and j", "force"),
    at_marker("TX", 3, "x of the torque on marker i of all elements between i and j, along the axes of k",
              "force·length"),
    at_marker("TY", 3, "y of the torque on marker i of all elements between i and j, along the axes of k",
              "force·length"),
    at_marker("TZ", 3, "z of the torque on marker i of all elements between i and j, along the axes of k",
              "force·length"),
    at_marker("TM", 2, "size of the torque on marker i of all elements between i and j", "force·length"),
    of_element("BEAM", "BEAM", built, "a component of the force or torque of a BEAM"),
    of_element("BUSH", "BUSHING", built, "a component of the force or torque of a BUSHING"),
    of_element("FIELD", "FIELD", built, "a component of the force or torque of a FIELD"),
    of_element("SFORCE", "SFORCE", built, "a component of the force or torque of a SFORCE"),
    of_element("SPDP", "SPRINGDAMPER", built, "a component of the force or torque of a SPRINGDAMPER"),
    of_element("VFORCE", "VFORCE", built, "a component of the force or torque of a VFORCE"),
    of_element("VTORQ", "VTORQUE", built, "a component of the force or torque of a VTORQUE"),
    of_element("GFORCE", "GFORCE", built, "a component of the force or torque of a GFORCE"),
    of_element("NFORCE", "NFORCE", not_built, "a component of the force or torque of a NFORCE"),
    of_element("CONTACT", "CONTACT", built, "a component of the force or torque of a CONTACT"),
    of_element("FRICTION", "FRICTION", built, "a component of the force or torque of a FRICTION"),
    of_element("JOINT", "JOINT", built, "a component of the reaction of a JOINT"),
    of_element("JPRIM", "JPRIM", built, "a component of the reaction of a JPRIM"),
    of_element("MOTION", "MOTION", built, "a component of the reaction of a MOTION"),
    of_element("PTCV", "PTCV", built, "a component of the reaction of a PTCV"),
    of_element("CVCV", "CVCV", built, "a component of the reaction of a CVCV"),
    from_data("VARVAL", DataSource::value, 1, "VARIABLE",
              {"id", "value of a VARIABLE", "what the VARIABLE has", "id  of the VARIABLE"}),
    from_data("ARYVAL", DataSource::array_entry, 2, "ARRAY",
              {"id, n", "entry n of an ARRAY", "what the entry has",
               "id  of the ARRAY\n"
               "n   which entry, from 1"}),
    from_data("DIF", DataSource::state, 1, "DIFF", {"id", "state of a DIFF", "what the DIFF has", "id  of the DIFF"}),
    from_data("DIF1", DataSource::state_rate, 1, "DIFF",
              {"id", "time derivative of the state of a DIFF", "that of the DIFF per time", "id  of the DIFF"}),
    from_data("PINVAL", DataSource::list_entry, 2, "PINPUT",
              {"id, n", "entry n of a PINPUT", "what the VARIABLE has",
               "id  of the PINPUT\n"
               "n   which of its VARIABLEs, from 1"}),
    from_data("POUVAL", DataSource::list_entry, 2, "POUTPUT",
              {"id, n", "entry n of a POUTPUT", "what the VARIABLE has",
               "id  of the POUTPUT\n"
               "n   which of its VARIABLEs, from 1"}),
    // What the sensor's EVALUATE stored when it last triggered: 0 before, constant while a model is linearized.
    AtomFunction{"SENVAL",
                 data,
                 0,
                 1,
                 1,
                 "SENSOR",
                 true,
                 {"id", "what EVALUATE of a SENSOR gave when it last triggered, 0 before", "what EVALUATE has",
                  "id  of the SENSOR"},
                 "EVALUATE",
                 DataSource::sensor},
    // Its arguments are expressions, but for an id in the fourth place.
    AtomFunction{"DELAY",
                 AtomFamily::delay,
                 by_reference,
                 3,
                 4,
                 "",
                 true,
                 {"e, tau, history [, id]", "e as it was tau ago", "as e",
                  "e        any expression without a DELAY\n"
                  "tau      how long ago [time]\n"
                  "history  what e was before the start: a constant or a function of TIME [as e]\n"
                  "id       of an ARRAY with settings of the interpolation, without effect on linear models"}},
    // The kind of analysis as a number: constant during each.
    AtomFunction{
        "MODE",
        data,
        0,
        0,
        0,
        "",
        true,
        {"",
         "which analysis is at work: 1 kinematics, 3 initial conditions, 4 dynamics, 5 statics, 6 quasi-statics, 7 "
         "linear",
         "", ""},
        {},
        DataSource::analysis},
    of_integration("CPU", DataSource::processor_time, "processor time that the run has taken so far, seconds"),
    of_integration("HSIZE", DataSource::step_size, "length of the last step [time]"),
    of_integration("ORDER", DataSource::step_order, "order of the last step"),
    of_integration("NJAC", DataSource::jacobians, "how often the Jacobian has been evaluated"),
    of_integration("NRHS", DataSource::evaluations, "how often the equations have been evaluated"),
    // An FE_LOAD puts numbers in its place; nothing else has any.
    AtomFunction{"S",
                 data,
                 0,
                 0,
                 0,
                 "",
                 true,
                 {"", "place along the beam that an FE_LOAD acts on: 0 at its first node, 1 at its last", "",
                  "in FE_LOAD alone"}},
    of_place("SD", "component n of the position of the beam at S, global axes; its angles PSI, THETA, PHI, n = 4 to 6",
             "length, angle"),
    of_place("SV", "component n of the velocity of the beam at S, global axes; of its angular velocity, n = 4 to 6",
             "length/time, angle/time"),
    of_place("SA",
             "component n of the acceleration of the beam at S, global axes; of its angular acceleration, n = 4 to 6",
             "length/time², angle/time²"),
};

}  // namespace

std::span<const AtomFunction> atom_functions() { return atom_table; }

const AtomFunction* find_atom_function(std::string_view name) {
  static const NameIndex<AtomFunction> names = {atom_table};
  return names.find(name);
}

const AtomFunction& atom_function(Measure measure) {
  return *std::ranges::find(atom_table, std::optional(measure), &AtomFunction::measure);
}

ReferenceClass reference_class(const AtomFunction& function, std::size_t argument) {
  if (function.statement.empty())
    return function.family == AtomFamily::data ? ReferenceClass::index : ReferenceClass::marker;
  if (argument == 0) return ReferenceClass::element;
  const bool axes = function.family == AtomFamily::element_force && argument == 3;
  return axes ? ReferenceClass::marker : ReferenceClass::index;
}

}  // namespace dynalin
