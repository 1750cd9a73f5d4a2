#include "expression/vector_functions.h"

#include <algorithm>

namespace dynalin {

namespace {

constexpr std::string_view marker_ids =
    "i, j, k, l  ids of markers, 0 or left out for the global frame; trailing ones may be left out";
constexpr std::string_view axis_markers = "i, k  ids of markers, k left out for global axes";
constexpr std::string_view spline_arguments =
    "x           where it is read [as X of the SPLINE]\n"
    "z           which curve of a family, 0 for a single one [as Z of the SPLINE]\n"
    "id          of the SPLINE\n"
    "derivative  0, 1 or 2, with respect to x";

using SizeArguments = VectorAtom::SizeArguments;
constexpr std::array<VectorAtom, 10> atoms = {{
    {"DXYZ",
     {"DX", "DY", "DZ"},
     {"i [, j [, k]]", "the displacement [DX, DY, DZ] of i from j, in the axes of k", "length", marker_ids},
     "DM"},
    {"VXYZ",
     {"VX", "VY", "VZ"},
     {"i [, j [, k [, l]]]", "the velocity [VX, VY, VZ] of i relative to j, in the axes of k, derivative taken in l",
      "length/time", marker_ids},
     "VM",
     SizeArguments::i_j_l},
    {"ACCXYZ",
     {"ACCX", "ACCY", "ACCZ"},
     {"i [, j [, k [, l]]]",
      "the acceleration [ACCX, ACCY, ACCZ] of i relative to j, in the axes of k, derivative taken in l", "length/time²",
      marker_ids},
     "ACCM",
     SizeArguments::i_j_l},
    {"WXYZ",
     {"WX", "WY", "WZ"},
     {"i [, j [, k]]", "the angular velocity [WX, WY, WZ] of i relative to j, in the axes of k", "rad/time",
      marker_ids},
     "WM"},
    {"WDTXYZ",
     {"WDTX", "WDTY", "WDTZ"},
     {"i [, j [, k [, l]]]",
      "the angular acceleration [WDTX, WDTY, WDTZ] of i relative to j, in the axes of k, derivative taken in l",
      "rad/time²", marker_ids},
     "WDTM",
     SizeArguments::i_j_l},
    {"FXYZ",
     {"FX", "FY", "FZ"},
     {"i [, j [, k]]", "the force [FX, FY, FZ] on marker i, in the axes of k", "force", marker_ids},
     "FM"},
    {"TXYZ",
     {"TX", "TY", "TZ"},
     {"i [, j [, k]]", "the torque [TX, TY, TZ] on marker i, in the axes of k", "force·length", marker_ids},
     "TM"},
    {"UVX",
     {"UVX.X", "UVX.Y", "UVX.Z"},
     {"i [, k]", "the x axis of marker i, a vector of length 1, in the axes of k", "1", axis_markers}},
    {"UVY",
     {"UVY.X", "UVY.Y", "UVY.Z"},
     {"i [, k]", "the y axis of marker i, a vector of length 1, in the axes of k", "1", axis_markers}},
    {"UVZ",
     {"UVZ.X", "UVZ.Y", "UVZ.Z"},
     {"i [, k]", "the z axis of marker i, a vector of length 1, in the axes of k", "1", axis_markers}},
}};

using Special = SpecialFunction::Kind;
constexpr std::array<SpecialFunction, 9> special = {{
    {"UV", Special::unit, 1, 1, {"v", "the vector v divided by its length", "1", "v  not zero"}},
    {"MAG",
     Special::magnitude,
     1,
     1,
     {"v", "the length of the vector v, a number", "as v", "v  any vector: MAG(DXYZ(1,2))"}},
    {"TRANS",
     Special::transform,
     2,
     3,
     {"v, i [, j]", "the vector v, whose components are in the axes of j, in those of i", "as v",
      "i, j  ids of markers, 0 for global axes"}},
    {"AKISPL",
     Special::akispl,
     3,
     4,
     {"x, z, id [, derivative]", "a SPLINE at x by the method of Akima",
      "as Y of the SPLINE; per unit of x with each derivative", spline_arguments}},
    {"CUBSPL",
     Special::cubspl,
     3,
     4,
     {"x, z, id [, derivative]", "a SPLINE at x by a cubic spline",
      "as Y of the SPLINE; per unit of x with each derivative", spline_arguments}},
    {"INTERP",
     Special::interp,
     3,
     4,
     {"x, method, id [, derivative]", "a SPLINE at x by straight lines or by cubics",
      "as Y of the SPLINE; per unit of x with each derivative",
      "x           where it is read [as X of the SPLINE]\n"
      "method      1: straight lines, 3: a cubic spline\n"
      "id          of the SPLINE\n"
      "derivative  0, 1 or 2, with respect to x"}},
    {"CURVE",
     Special::curve,
     4,
     4,
     {"u, derivative, component, id", "a coordinate of a CURVE, or its derivative", "length",
      "u           parameter along the curve\n"
      "derivative  0, 1 or 2, with respect to u\n"
      "component   1, 2, 3: x, y, z\n"
      "id          of the CURVE"}},
    {"INVPSD",
     Special::spectrum,
     7,
     7,
     {"x, id, f0, f1, n, log, seed", "a signal of n sines whose power spectral density is that of a SPLINE",
      "root of density times frequency",
      "x       often TIME\n"
      "id      of the SPLINE: density over frequency in cycles per unit of x\n"
      "f0, f1  lowest and highest frequency [cycles per unit of x]\n"
      "n       number of sines, 2 … 199\n"
      "log     1: the spline is read in logarithms, else 0\n"
      "seed    of the phases; the same one gives the same signal"}},
    {"ORIENT",
     Special::orientation,
     3,
     4,
     {"system, component, i [, j]", "one angle or Euler parameter of the orientation of marker i in the axes of j",
      "rad, or 1",
      "system     1 … 6: body-fixed angles 123, 231, 312, 132, 213, 321;\n"
      "           7 … 12: 121, 131, 212, 232, 313, 323; 27: Euler parameters\n"
      "component  1 … 3, of Euler parameters 1 … 4\n"
      "i, j       ids of markers, 0 for the global frame"}},
}};

template <class Table>
const typename Table::value_type* find_in(const Table& table, std::string_view name) {
  for (const auto& f : table) {
    if (f.name == name) return &f;
  }
  return nullptr;
}

}  // namespace

std::span<const VectorAtom> vector_atoms() { return atoms; }
const VectorAtom* find_vector_atom(std::string_view name) { return find_in(atoms, name); }
const VectorAtom* vector_atom_of(std::string_view first_component) {
  const auto found =
      std::ranges::find_if(atoms, [&](const VectorAtom& v) { return v.components[0] == first_component; });
  return found == atoms.end() ? nullptr : &*found;
}
std::span<const SpecialFunction> special_functions() { return special; }
const SpecialFunction* find_special_function(std::string_view name) { return find_in(special, name); }

}  // namespace dynalin
