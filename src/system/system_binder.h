// Binds the kernels of a System that is being made: what their expressions read beyond the unknowns of the elements is
// numbered here, once, and what stands in the way is noted.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "elements/families/delay.h"
#include "mechanics/binder.h"
#include "mechanics/bound_expression.h"
#include "system/signal_table.h"

namespace dynalin {

class SystemBinder final : public Binder {
 public:
  SystemBinder(const Model& model, Layout& layout, const SignalTable& signals, DelayReading delays)
      : model_(model),
        layout_(layout),
        signals_(signals),
        own_(std::make_unique<DelayKernel>(delays)),
        delays_(*own_) {}

  // Binds all kernels, adds the one of the delays that they read, and equations for the rates.
  void bind(std::vector<std::unique_ptr<Kernel>>&);

  // All expressions with kinks or jumps: copies, for those of the kernels may move.
  std::vector<BoundExpression> take_switching() { return std::move(switching_); }

  const Signals& signals() const override { return signals_; }
  Channel data(const Atom&) override;
  Channel rate_of(const Channel&) override;
  Channel delayed(const Atom&) override;
  void attach(SplineUse&) override;
  std::int32_t sensor_value(std::int64_t id) override;
  void note_analysis() override { layout_.reads_analysis = true; }
  void note_switches(const BoundExpression& e) override { switching_.push_back(e); }
  std::int32_t add_memory(const ElementLabel& owner, std::string_view name, double initial) override {
    return layout_.add_memory(owner, name, initial);
  }
  std::int32_t count_turns(Measure measure, MarkerId i, MarkerId j) override {
    return layout_.count_turns(measure, i, j);
  }
  void problem(std::string_view code, const Span& at, std::string text, std::string hint) override {
    layout_.problems.error(code, at, std::move(text), std::move(hint));
  }

 private:
  void make_rates(const std::vector<std::unique_ptr<Kernel>>&);
  DelayPlace place_of(const Span&) const;

  const Model& model_;
  Layout& layout_;
  const SignalTable& signals_;
  std::unique_ptr<DelayKernel> own_;  // until it stands among the kernels
  DelayKernel& delays_;
  std::map<std::int32_t, std::int32_t> rates_;          // of algebraic unknowns
  std::map<std::int64_t, std::int32_t> sensor_values_;  // in the memory
  std::vector<BoundExpression> switching_;
  std::vector<std::pair<std::int32_t, std::int32_t>> rates_to_make_;
  std::map<std::pair<std::int64_t, SplineMethod>, std::shared_ptr<const SplineCurves>> curves_;
};

}  // namespace dynalin
