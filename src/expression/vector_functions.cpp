#include "expression/vector_functions.h"

namespace dynalin {

namespace {

constexpr std::array<VectorAtom, 10> atoms = {{
    {"DXYZ", {"DX", "DY", "DZ"}},
    {"VXYZ", {"VX", "VY", "VZ"}},
    {"ACCXYZ", {"ACCX", "ACCY", "ACCZ"}},
    {"WXYZ", {"WX", "WY", "WZ"}},
    {"WDTXYZ", {"WDTX", "WDTY", "WDTZ"}},
    {"FXYZ", {"FX", "FY", "FZ"}},
    {"TXYZ", {"TX", "TY", "TZ"}},
    {"UVX", {"UVX.X", "UVX.Y", "UVX.Z"}},
    {"UVY", {"UVY.X", "UVY.Y", "UVY.Z"}},
    {"UVZ", {"UVZ.X", "UVZ.Y", "UVZ.Z"}},
}};

using Kind = SpecialFunction::Kind;
constexpr std::array<SpecialFunction, 9> special = {{
    {"UV", Kind::unit, 1, 1},
    {"MAG", Kind::magnitude, 1, 1},
    {"TRANS", Kind::transform, 2, 3},
    {"AKISPL", Kind::akispl, 3, 4},
    {"CUBSPL", Kind::cubspl, 3, 4},
    {"INTERP", Kind::interp, 3, 4},
    {"CURVE", Kind::curve, 4, 4},
    {"INVPSD", Kind::spectrum, 7, 7},
    {"ORIENT", Kind::orientation, 3, 4},
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
std::span<const SpecialFunction> special_functions() { return special; }
const SpecialFunction* find_special_function(std::string_view name) { return find_in(special, name); }

}  // namespace dynalin
