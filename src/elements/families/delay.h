// DELAY(e, tau, history) in expressions: w = e(t − τ) is an unknown of its own with one equation.
//
//     before the start       w = history(t − τ)
//     motion in time         w from what is kept of e at accepted instants (mechanics/delay_history.h)
//     statics                w = e, for nothing varies in time
//     linear models          first order in τ:  δw = δe − τ δe′ − e′ δτ, with e′ the exact time derivative along the
//     motion
//                            or (1 − τs/2)/(1 + τs/2), one state z:  τ z′ = e − w,  w = 2 z − e
//
// A τ of zero or less is no delay, w = e. What is kept reaches back by the longest delay: by τ where that is a number,
// to the start of the motion where it varies.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "dataset/dataset.h"
#include "mechanics/bound_expression.h"
#include "mechanics/channel_source.h"
#include "mechanics/delay_history.h"
#include "mechanics/event_source.h"
#include "mechanics/kernel.h"

namespace dynalin {

enum class DelayReading : std::uint8_t { first_order, pade };

// Where a call stands: in which statement, as which of the dataset, and whether a command wrote it.
struct DelayPlace {
  const Statement* statement = nullptr;
  std::size_t number = 0;
  bool edited = false;
};

class DelayKernel final : public Kernel, public DelaySource, public SwitchSource {
 public:
  explicit DelayKernel(DelayReading reading) : reading_(reading) {}

  // The unknown of a call, made when it is met for the first time.
  Channel channel_of(const Atom&, const DelayPlace&, Layout&);
  // After all others, when every call is known.
  void bind(Binder&) override;
  void equations(const Motion&, Equations&) const override;
  void undefined_values(const Motion&, UndefinedValues&) const override;

  const SwitchSource* kinks() const override { return this; }
  // Where t − τ passes a jump or a kink of e, a kink of the history before the start, or τ zero.
  void switches(const Motion&, ExpressionScratch&, SwitchList&) const override;

  const DelaySource* delays() const override { return this; }
  void record(const Motion&, DelayHistories&) const override;
  void record_behind(const Motion&, const Motion&, bool, DelayHistories&) const override;
  double next_event(double time, const DelayHistories&) const override;  // of delays that are numbers
  void look_ahead(const Motion&, const Motion&, StepReach&) const override;
  // The shortest delay that is a number. One that varies may vanish on the way, and steps must not with it.
  double longest_step(const Motion&) const override;

 private:
  struct Call {
    Span at;
    std::shared_ptr<const DelayedCall> written;
    DelayPlace place;
    std::string owner;   // "in SFORCE/3"
    ElementLabel label;  // DELAY/1, DELAY/2 … in the order of the dataset
    std::int32_t unknown = -1, state = -1;
    std::size_t index = 0;  // among Layout::delay_calls
    bool never = false;     // τ is a constant that is no delay
    bool with_rate = false;
    BoundExpression value{}, lag{};
    Expression history{};
  };
  // `keep` takes the call, its history, value and slope now, and what is read no more.
  template <class Keep>
  void record_each(const Motion&, DelayHistories&, const Keep& keep) const;
  static const DelayHistory* kept(const Call&, const Motion&);  // null where nothing is
  static DelayHistory::Reading before_start(const Call&, double time, ExpressionScratch&);
  void add_past(const Call&, const Motion&, Equations&, std::int32_t row, double tau) const;
  void add_first_order(const Call&, const Motion&, Equations&, std::int32_t row, double tau) const;
  void add_state(const Call&, const Motion&, Equations&, double tau) const;

  DelayReading reading_;
  std::deque<Call> calls_;                                                          // labels stay where they are
  std::map<std::pair<const SourceText*, std::uint32_t>, std::int32_t> unknown_at_;  // by where a call begins
};

}  // namespace dynalin
