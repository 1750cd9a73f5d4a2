// Vector operations, taken apart into scalar nodes.
#include <algorithm>

#include "expression/program_builder.h"
#include "expression/vector_functions.h"

namespace dynalin {

Operand ProgramBuilder::vector(const Operand& x, const Operand& y, const Operand& z, const Span& at) {
  return {x.node, at, y.node, z.node, x.unknown || y.unknown || z.unknown};
}

Operand ProgramBuilder::negate_vector(const Operand& v, const Span& at) {
  std::array<Operand, 3> c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = negate(v.component(k), at);
  return vector(c[0], c[1], c[2], at);
}

Operand ProgramBuilder::combine(Kind sum, const Operand& v, const Operand& w) {
  std::array<Operand, 3> c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = binary(sum, v.component(k), w.component(k));
  return vector(c[0], c[1], c[2], join(v.at, w.at));
}

Operand ProgramBuilder::scale(Kind kind, const Operand& v, const Operand& s) {
  std::array<Operand, 3> c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = binary(kind, v.component(k), s);
  return vector(c[0], c[1], c[2], join(v.at, s.at));
}

Operand ProgramBuilder::dot(const Operand& v, const Operand& w) {
  std::array<Operand, 3> c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = binary(Kind::multiply, v.component(k), w.component(k));
  return binary(Kind::add, binary(Kind::add, c[0], c[1]), c[2]);
}

Operand ProgramBuilder::cross(const Operand& v, const Operand& w) {
  std::array<Operand, 3> c;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Operand forward = binary(Kind::multiply, v.component(i), w.component(j));
    c[k] = binary(Kind::subtract, forward, binary(Kind::multiply, v.component(j), w.component(i)));
  }
  return vector(c[0], c[1], c[2], join(v.at, w.at));
}

// MAG(DXYZ(1, 2)) is DM(1, 2), which is zero where no more than rounding is left of it.
std::optional<Operand> ProgramBuilder::size_of_measures(const Operand& v, const Span& at) {
  if (v.component(0).node != next() - 3) return std::nullopt;
  std::array<const Atom*, 3> parts;
  for (std::size_t k = 0; k < 3; ++k) {
    const Operand c = v.component(k);
    const DraftNode& node = program_.nodes[static_cast<std::size_t>(c.node)];
    if (node.kind != Kind::atom || c.node != next() - 3 + static_cast<std::int32_t>(k)) return std::nullopt;
    parts[k] = &program_.atoms[static_cast<std::size_t>(node.a)];
  }
  const VectorAtom* vector = vector_atom_of(parts[0]->function->name);
  if (!vector || vector->size.empty()) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k) {
    if (parts[k]->function->name != vector->components[k] || parts[k]->argument != parts[0]->argument)
      return std::nullopt;
  }
  const auto& [i, j, axes, frame, none] = parts[0]->argument;
  // The size does not read the marker of the axes, which has to be one for all that.
  if (axes != 0 && axes != i && axes != j) return std::nullopt;
  Atom size = *parts[0];
  size.function = find_atom_function(vector->size);
  size.at = at;
  const bool reads_frame = vector->size_arguments == VectorAtom::SizeArguments::i_j_l && frame != 0;
  size.argument = {i, j, reads_frame ? frame : 0, 0, 0};
  size.argument_count = reads_frame ? 3 : std::min<std::uint8_t>(size.argument_count, 2);
  size.argument_place[2] = size.argument_place[3];
  pop(3);
  return atom(size);
}

Operand ProgramBuilder::magnitude(const Operand& v, const Span& at) {
  if (const auto size = size_of_measures(v, at)) return *size;
  return call(vector_size(), std::array{v.component(0), v.component(1), v.component(2)}, at);
}

Operand ProgramBuilder::unit(const Operand& v, const Span& at) {
  std::array<Operand, 3> c;
  for (std::size_t k = 0; k < 3; ++k)
    c[k] = call(vector_direction(), std::array{v.component(k), v.component((k + 1) % 3), v.component((k + 2) % 3)}, at);
  return vector(c[0], c[1], c[2], at);
}

Operand ProgramBuilder::transform(const std::array<Operand, 3>& rows, const Operand& v, const Span& at) {
  return vector(dot(rows[0], v), dot(rows[1], v), dot(rows[2], v), at);
}

}  // namespace dynalin
