// Linear differential states: z′ = A z + B u, y = C z + D u, for LSE and TFSISO.
//
// u are values of VARIABLEs. Every entry of y is one algebraic unknown with the equation y − C z − D u = 0.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/kernel.h"

namespace dynalin {

struct LinearStates {
  StateType type = StateType::lse;
  Eigen::MatrixXd A, B, C, D;  // with as many columns in B and D as there are inputs
  std::vector<VariableRef> inputs;
  std::vector<double> initial;  // z at the start
  bool held_in_statics = false;
};

class LinearStatesKernel final : public Kernel {
 public:
  LinearStatesKernel(std::vector<LinearStates>, const std::vector<ElementLabel>&, Layout&);
  void bind(const Signals&) override;
  void equations(const Motion&, Equations&) const override;
  Channel state_channel(std::size_t element, std::size_t n) const override;
  Channel output_channel(std::size_t element, std::size_t n) const override;

 private:
  struct Element {
    LinearStates law;
    std::int32_t first_state = 0, first_output = 0;
    std::vector<std::int32_t> inputs;  // algebraic unknowns
  };
  std::vector<Element> elements_;
};

}  // namespace dynalin
