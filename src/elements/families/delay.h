// DELAY(e, tau, history) in expressions: w = e(t − τ) is an unknown of its own with one equation.
//
// No analysis here moves in time, so t − τ lies before the start wherever τ > 0:
//
//     initial conditions     w = history(t − τ)
//     statics                w = e, for nothing varies in time
//     linear models          first order in τ:  δw = δe − τ δe′ − e′ δτ, with e′ the exact time derivative along the
//     motion
//                            or (1 − τs/2)/(1 + τs/2), one state z:  τ z′ = e − w,  w = 2 z − e
//
// A τ of zero or less is no delay, w = e.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "mechanics/bound_expression.h"
#include "mechanics/kernel.h"

namespace dynalin {

enum class DelayReading : std::uint8_t { first_order, pade };

class DelayKernel final : public Kernel {
 public:
  explicit DelayKernel(DelayReading reading) : reading_(reading) {}

  // The unknown of a call, made when it is met for the first time. `owner` names the statement it stands in.
  Channel channel_of(const Atom&, std::string owner, Layout&);
  // After all others, when every call is known.
  void bind(Binder&) override;
  void equations(const Motion&, Equations&) const override;
  void remember(const Motion&, Memory&) const override;
  void undefined_values(const Motion&, std::vector<UndefinedValue>&) const override;

 private:
  struct Call {
    Span at;
    std::shared_ptr<const DelayedCall> written;
    std::string owner;
    ElementLabel label;  // DELAY/1, DELAY/2 … in the order of the dataset
    std::int32_t unknown = -1, state = -1;
    bool never = false;  // τ is a constant that is no delay
    BoundExpression value{}, lag{};
    Expression history{};
  };
  void add_history(const Call&, const Motion&, Equations&, std::int32_t row, double tau) const;
  void add_first_order(const Call&, const Motion&, Equations&, std::int32_t row, double tau) const;
  void add_state(const Call&, const Motion&, Equations&, double tau) const;

  DelayReading reading_;
  std::deque<Call> calls_;                            // labels stay where they are
  std::map<std::uint32_t, std::int32_t> unknown_at_;  // by where a call begins in the dataset
};

}  // namespace dynalin
