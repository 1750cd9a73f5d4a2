// Linear differential states: z′ = A z + B u, y = C z + D u, for LSE and TFSISO.
//
// u are values of VARIABLEs. Every entry of y is one algebraic unknown with the equation y − C z − D u = 0.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/channel_source.h"
#include "mechanics/kernel.h"

namespace dynalin {

struct LinearStates {
  StateType type = StateType::lse;
  Eigen::MatrixXd A, B, C, D;  // with as many columns in B and D as there are inputs
  std::vector<VariableRef> inputs;
  std::vector<double> initial;  // z at the start
  bool held_in_statics = false;
};

class LinearStatesKernel final : public Kernel, public ChannelSource {
 public:
  LinearStatesKernel(std::vector<LinearStates>, const std::vector<ElementLabel>&, Layout&);
  void bind(Binder&) override;
  bool add_rate_equation(std::int32_t algebraic, std::int32_t rate, Binder&) override;
  void equations(const Motion&, Equations&) const override;
  const ChannelSource* channels() const override { return this; }
  Channel state_channel(std::size_t element, std::size_t n) const override;
  Channel output_channel(std::size_t element, std::size_t n) const override;

 private:
  struct Element {
    LinearStates law;
    std::int32_t first_state = 0, first_output = 0;
    std::vector<std::int32_t> inputs;  // algebraic unknowns
  };
  // y′ − C z′ − D u′ = 0 of one output.
  struct OutputRate {
    std::size_t element;
    Eigen::Index output;
    std::int32_t rate;
    std::vector<Channel> inputs;  // u′, none where D has a zero
  };
  std::vector<Element> elements_;
  std::vector<OutputRate> rates_;
};

}  // namespace dynalin
