// Algebraic unknowns w with an equation of their own, w − … = 0: values that are named once, so that others may refer
// to them and the Jacobian stays sparse.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mechanics/bound_expression.h"
#include "mechanics/equations.h"

namespace dynalin {

inline double unknown_at(const Motion& motion, std::int32_t unknown) {
  return motion.algebraic[static_cast<std::size_t>(unknown)];
}

// Adds w to the residual of a row.
inline void add_unknown(const Motion& motion, Equations& eq, std::int32_t row, std::int32_t unknown) {
  eq.add_residual(row, unknown_at(motion, unknown));
  eq.add(PartialBy::algebraic, row, unknown, 1.0);
}
// Adds z′ to the residual of a row.
inline void add_state_rate(const Motion& motion, Equations& eq, std::int32_t row, std::int32_t state) {
  eq.add_residual(row, motion.state_rate[static_cast<std::size_t>(state)]);
  eq.add(PartialBy::state_rate, row, state, 1.0);
}
// Begins its own equation; the row that what w is has to be taken from.
inline std::int32_t begin_definition(const Motion& motion, Equations& eq, std::int32_t unknown) {
  const std::int32_t row = eq.algebraic_row(unknown);
  add_unknown(motion, eq, row, unknown);
  return row;
}

// One that an expression e defines: w − e = 0.
class DefinedUnknown {
 public:
  DefinedUnknown(std::int32_t unknown, Expression definition) : unknown_(unknown), definition_(std::move(definition)) {}

  void bind(Binder& binder) { bound_ = BoundExpression(definition_, binder); }
  std::int32_t column() const { return unknown_; }
  double at(const Motion& motion) const { return unknown_at(motion, unknown_); }
  void add_equation(const Motion& motion, Equations& eq) const {
    bound_.add(motion, eq, begin_definition(motion, eq, unknown_), -1.0, PartialBy::damping);
  }
  // The same where e is zero and counts as constant: entries of the pattern stay.
  void add_equation_of_zero(const Motion& motion, Equations& eq) const {
    bound_.add(motion, eq, begin_definition(motion, eq, unknown_), 0.0, PartialBy::damping);
  }
  // One that reads forces may read itself: there the unknown is all that is known.
  AtMeeting where_they_meet(const Motion& motion, ExpressionScratch& scratch, const MarkerPlace& I,
                            const MarkerPlace& J) const {
    if (bound_.reads_forces()) return {at(motion), 0.0, AtMeeting::Others::defined};
    return bound_.where_they_meet(motion, scratch, I, J);
  }
  void find_undefined(const Motion& motion, const ElementLabel& of, UndefinedValues& found) const {
    bound_.find_undefined(motion, of, found);
  }

 private:
  std::int32_t unknown_;
  Expression definition_;
  BoundExpression bound_;
};

}  // namespace dynalin
