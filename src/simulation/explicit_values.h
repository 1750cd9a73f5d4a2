// Values that are functions of the rest of a point, as those of VARIABLEs are, in between two points of an integration:
// what an integration has of them there is no more exact than it needs them, which is not at all where nothing that
// moves reads them.
#pragma once

#include <vector>

#include "mechanics/bound_expression.h"
#include "system/system.h"

namespace dynalin {

class ExplicitValues {
 public:
  // Which read each other is seen at this motion.
  ExplicitValues(const System&, const Motion&);

  // Evaluates them, but for those that depend on themselves and what reads these.
  void evaluate(Motion&, ExpressionScratch&) const;

 private:
  struct Value {
    std::size_t unknown;
    const BoundExpression* function;
  };
  std::vector<Value> in_order_;  // each behind what it reads
};

}  // namespace dynalin
