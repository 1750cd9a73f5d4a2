// One scalar equation given by a function expression: VARIABLE and DIFF in all forms.
//
//     value               w − e = 0       VARIABLE
//     rate                z′ − e = 0      DIFF
//     implicit_state      e = 0           implicit DIFF that reads its own DIF1
//     implicit_algebraic  e = 0           implicit DIFF that does not: an algebraic unknown, no state
//     condition           Σ y h = 0       of equations h of several DIFFs in which all rates cancel: an algebraic
//     unknown
//
// A state may have the equation of another element, where its own has gone into a condition.
// Where DIF1 asks for the rate w′ of an algebraic unknown, the equation is differentiated once along the motion and w′
// becomes an unknown of its own.
#pragma once

#include <vector>

#include "mechanics/bound_expression.h"
#include "mechanics/channel_source.h"
#include "mechanics/kernel.h"

namespace dynalin {

class FunctionEquationKernel final : public Kernel, public ChannelSource {
 public:
  enum class Form : std::uint8_t { value, rate, implicit_state, implicit_algebraic, condition };
  struct Term {
    std::size_t of;  // the function of this element
    double factor;
    bool with_rate = false;  // plus the rate of that element's unknown
  };
  struct Item {
    Expression function;
    Form form = Form::value;
    double initial = 0, initial_rate = 0;
    bool held_in_statics = false, held_in_dynamics = false;
    std::vector<Term> terms = {};  // of the equation, where it is not the function of the element itself
    bool start_stated = false;     // of a condition: what it has to change of `initial` is worth a warning
  };

  FunctionEquationKernel(std::vector<Item>, const std::vector<ElementLabel>&, Layout&);
  // Elements whose equations determine their rates together, each group as the structure of its equations says.
  void couple(const std::vector<std::vector<std::size_t>>& groups) {
    for (const auto& items : groups) coupled_.push_back({items, {}});
  }
  void bind(Binder&) override;
  bool add_rate_equation(std::int32_t algebraic, std::int32_t rate, Binder&) override;
  void equations(const Motion&, Equations&) const override;
  const ChannelSource* channels() const override { return this; }
  Channel value_channel(std::size_t element) const override { return unknowns_[element]; }
  const BoundExpression* value_function(std::size_t element) const override;
  Channel state_channel(std::size_t element, std::size_t) const override { return unknowns_[element]; }
  void undefined_values(const Motion&, UndefinedValues&) const override;
  std::string domain_violation(const Motion&) const override;

 private:
  // Σ factor · function stands in the row of an item.
  struct Part {
    std::size_t item, of;
    double factor;
    BoundExpression function;
    Channel rate = {};  // that is added
  };
  struct RateEquation {
    std::int32_t rate;
    bool explicit_value;  // w′ − e′ = 0, else e′ = 0
    double factor;        // of e′
    BoundExpression function;
    std::size_t of;  // the item whose function it is
  };
  std::string uncancelled_rate(const Motion&) const;
  std::string singular_group(const Motion&) const;

  std::vector<Item> items_;
  std::vector<Channel> unknowns_;
  std::vector<Part> parts_;
  std::vector<Part> whole_;  // terms of conditions with their rates, which have to cancel
  std::vector<RateEquation> rates_;
  struct Group {
    std::vector<std::size_t> items, parts;
  };
  std::vector<Group> coupled_;
  const std::vector<ElementLabel>* labels_;
};

}  // namespace dynalin
