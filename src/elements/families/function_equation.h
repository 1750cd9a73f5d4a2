// One scalar equation given by a function expression: VARIABLE and DIFF in all forms.
//
//     value               w − e = 0       VARIABLE
//     rate                z′ − e = 0      DIFF
//     implicit_state      e = 0           implicit DIFF that reads its own DIF1
//     implicit_algebraic  e = 0           implicit DIFF that does not: an algebraic unknown, no state
//
// Where DIF1 asks for the rate w′ of an algebraic unknown, the equation is differentiated once along the motion and w′
// becomes an unknown of its own.
#pragma once

#include <vector>

#include "mechanics/bound_expression.h"
#include "mechanics/kernel.h"

namespace dynalin {

class FunctionEquationKernel final : public Kernel {
 public:
  enum class Form : std::uint8_t { value, rate, implicit_state, implicit_algebraic };
  struct Item {
    Expression function;
    Form form = Form::value;
    double initial = 0, initial_rate = 0;
    bool held_in_statics = false;
  };

  FunctionEquationKernel(std::vector<Item>, const std::vector<ElementLabel>&, Layout&);
  void bind(const Signals&) override;
  bool add_rate_equation(std::int32_t algebraic, std::int32_t rate, const Signals&) override;
  void equations(const Motion&, Equations&) const override;
  void remember(const Motion&, Memory&) const override;
  Channel value_channel(std::size_t element) const override { return unknowns_[element]; }
  Channel state_channel(std::size_t element, std::size_t) const override { return unknowns_[element]; }
  std::string fault(const Motion&) const override;

 private:
  struct RateEquation {
    std::int32_t rate;
    bool explicit_value;  // w′ − e′ = 0, else e′ = 0
    BoundExpression function;
  };
  std::vector<Item> items_;
  std::vector<Channel> unknowns_;
  std::vector<BoundExpression> functions_;
  std::vector<RateEquation> rates_;
  const std::vector<ElementLabel>* labels_;
};

}  // namespace dynalin
