// Vector operations, taken apart into scalar nodes.
#include "expression/program_builder.h"

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

Operand ProgramBuilder::magnitude(const Operand& v, const Span& at) {
  return call(*find_function("SQRT"), std::array{dot(v, v)}, at);
}

Operand ProgramBuilder::unit(const Operand& v, const Span& at) {
  Operand u = scale(Kind::divide, v, magnitude(v, at));
  u.at = at;
  return u;
}

Operand ProgramBuilder::transform(const std::array<Operand, 3>& rows, const Operand& v, const Span& at) {
  return vector(dot(rows[0], v), dot(rows[1], v), dot(rows[2], v), at);
}

}  // namespace dynalin
