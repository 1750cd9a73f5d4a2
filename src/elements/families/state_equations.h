// States and outputs whose equations are functions, several in one element: GSE.
//
//     z′ − f(z, u, d, t) = 0      or implicit  f(z, z′, u, d, t) = 0      each state
//     y − g(z, u, d, t) = 0                                               each output, an algebraic unknown
//     d − what was sampled last = 0                                       each discrete state, another
//
// An element that works in statics alone keeps its states and its outputs everywhere else.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "elements/families/sampling.h"
#include "mechanics/bound_expression.h"
#include "mechanics/channel_source.h"
#include "mechanics/event_source.h"
#include "mechanics/kernel.h"
#include "mechanics/stated_memory_source.h"

namespace dynalin {

struct StateEquationsLaw {
  std::vector<Expression> derivatives, outputs;
  std::vector<double> initial;  // zero where there are fewer
  Sampling::Law sampling;       // of no states where there is none
  bool implicit = false, held_in_statics = false, in_statics_only = false;
  std::span<const std::string_view> schedule_arguments{};  // that say when samples are taken
};

class StateEquationsKernel final : public Kernel, public ChannelSource, public EventSource, public StatedMemorySource {
 public:
  StateEquationsKernel(std::vector<StateEquationsLaw>, const std::vector<ElementLabel>&, StateType, Layout&);
  void bind(Binder&) override;
  bool add_rate_equation(std::int32_t algebraic, std::int32_t rate, Binder&) override;
  void equations(const Motion&, Equations&) const override;
  void remember(const Motion&, Memory&) const override;
  void undefined_values(const Motion&, UndefinedValues&) const override;
  std::string domain_violation(const Motion&) const override;

  const ChannelSource* channels() const override { return this; }
  // Discrete states follow the others.
  Channel state_channel(std::size_t element, std::size_t n) const override;
  Channel output_channel(std::size_t element, std::size_t n) const override;

  const EventSource* events() const override { return sampled_.empty() ? nullptr : this; }
  std::size_t event_count() const override { return sampled_.size(); }
  void crossings(const Motion&, ExpressionScratch&, SwitchList&) const override;
  void act(const Motion&, std::span<const int> crossed, Memory&, EventAction&) const override;
  void act_at_start(const Motion&, Memory&, EventAction&) const override;

  void stated_memory(std::vector<StatedMemory>&) const override;

 private:
  struct Element {
    StateEquationsLaw law;
    Sampling sampling;
    std::int32_t first_state = 0, first_output = 0, first_discrete = 0;
    std::vector<BoundExpression> derivatives{}, outputs{};
    std::vector<std::int32_t> kept_outputs{};  // in the memory, of one that works in statics alone
    bool solves_for_rates() const { return law.implicit && !law.in_statics_only; }
  };
  struct OutputRate {
    std::size_t element;
    std::int32_t rate;
    std::optional<BoundExpression> function;  // of what changes in time
  };
  static bool rests(const Element&, const Motion&);
  bool sample(const Motion&, Memory&) const;

  std::vector<Element> elements_;
  std::vector<std::size_t> sampled_;  // those with discrete states
  std::vector<OutputRate> rates_;
  const std::vector<ElementLabel>* labels_;
};

}  // namespace dynalin
