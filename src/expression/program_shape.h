// What the programs of expressions have in common that differ in their numbers and ids alone. Large models repeat the
// same formula for one element after the other: such expressions share one shape, and each keeps little more than its
// numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dynalin {

class SourceText;
struct AtomFunction;
struct Function;

struct ExpressionNode {
  enum class Kind : std::uint8_t {
    constant,  // constant number b
    atom,      // atom number a
    negate,    // −a
    add,       // a + b
    subtract,  // a − b
    multiply,  // a b
    divide,    // a / b
    power,     // a ** constant number b
    call,      // function of operands[b] … operands[b + a − 1]
    spline,    // spline number a at x = operands[b], z = operands[b + 1]
    routine,   // routine number a, reads routines[a].inputs nodes from operands[b] on
    branch,    // looks at node a; operands[b …]: first node of each of three branches, then the merge
    jump,      // to node a
    merge,     // of branch a; operands[b …]: result node of each of three branches
  };
  Kind kind = Kind::constant;
  std::uint16_t function = 0;  // of a call: its number among the functions of the shape
  std::int32_t a = 0, b = 0;

  friend bool operator==(const ExpressionNode&, const ExpressionNode&) = default;
};

struct ProgramShape {
  // Counted from where the expression begins, modulo 2³² where it stands in front of that.
  struct Place {
    std::uint32_t offset = 0, length = 0;
    friend bool operator==(const Place&, const Place&) = default;
  };
  struct ShapeOfAtom {
    const AtomFunction* function = nullptr;
    Place at;
    std::uint32_t first_argument = 0, argument_count = 0;
    friend bool operator==(const ShapeOfAtom&, const ShapeOfAtom&) = default;
  };

  const SourceText* source = nullptr;      // where the expressions stand
  std::uint32_t length = 0;                // of the text of each
  std::uint32_t constants = 0;             // that nodes have
  std::vector<ExpressionNode> nodes;       // the last one is the result
  std::vector<std::int32_t> operands;      // that nodes refer to
  std::vector<std::int32_t> switching;     // nodes with kinks or jumps that depend on the motion
  std::vector<const Function*> functions;  // that are called, each once
  std::vector<Place> places;               // of each node
  std::vector<ShapeOfAtom> atoms;
  std::vector<Place> arguments;  // of the atoms, where they stand

  friend bool operator==(const ProgramShape&, const ProgramShape&) = default;
};

}  // namespace dynalin
