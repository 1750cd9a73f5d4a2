// One scalar equation given by a function expression: VARIABLE, w − e = 0, and explicit DIFF, z′ − e = 0.
#pragma once

#include <vector>

#include "mechanics/bound_expression.h"
#include "mechanics/kernel.h"

namespace dynalin {

class FunctionEquationKernel final : public Kernel {
 public:
  enum class Unknown : std::uint8_t { algebraic, state };
  struct Item {
    Expression function;
    double initial = 0;
    bool held_in_statics = false;
  };

  FunctionEquationKernel(Unknown, std::vector<Item>, const std::vector<ElementLabel>&, Layout&);
  void bind(const Signals&) override;
  void equations(const Motion&, Equations&) const override;
  void remember(const Motion&, Memory&) const override;
  Channel value_channel(std::size_t element) const override;
  Channel state_channel(std::size_t element, std::size_t) const override;
  std::string fault(const Motion&) const override;

 private:
  Unknown unknown_;
  std::int32_t first_;
  std::vector<Item> items_;
  std::vector<BoundExpression> functions_;
  const std::vector<ElementLabel>* labels_;
};

}  // namespace dynalin
