// The program of an expression while it is made: with everything at its place, in lists that grow.
#pragma once

#include <cstdint>
#include <vector>

#include "expression/expression.h"
#include "expression/functions.h"
#include "expression/program_shape.h"
#include "expression/routine.h"
#include "expression/spline.h"

namespace dynalin {

struct DraftNode {
  using Kind = ExpressionNode::Kind;
  Kind kind = Kind::constant;
  std::int32_t a = 0, b = 0;           // as of the node that it becomes, but for numbers of constants
  const Function* function = nullptr;  // of a call
  double constant = 0;                 // of a constant, or the exponent of a power
};

struct ProgramDraft {
  std::vector<DraftNode> nodes;  // the last one is the result
  std::vector<std::int32_t> operands;
  std::vector<Span> places;  // of each node
  std::vector<Atom> atoms;
  std::vector<SplineUse> splines;
  std::vector<RoutineUse> routines;
  Span at;

  // Keeps the memory of its lists.
  void clear() {
    nodes.clear(), operands.clear(), places.clear(), atoms.clear(), splines.clear(), routines.clear();
    at = {};
  }
  void add(const DraftNode& node, const Span& place) {
    nodes.push_back(node);
    places.push_back(place);
  }
};

// Nodes with kinks or jumps that depend on the motion.
std::vector<std::int32_t> switching_nodes(const ProgramDraft&);

}  // namespace dynalin
