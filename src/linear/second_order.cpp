#include "linear/second_order.h"

#include <algorithm>

namespace dynalin {

Result<SecondOrder> second_order(const StateSpace& model, std::size_t first_order) {
  SecondOrder out;
  out.time = model.time, out.of_equations = model.of_equations;
  out.pinput = model.pinput, out.poutput = model.poutput;
  out.inputs = model.inputs, out.outputs = model.outputs;
  // Rates stand before their coordinates; differential states come last.
  std::vector<Eigen::Index> rate, coordinate, differential;
  for (std::size_t k = 0; k < model.states.size(); ++k) {
    const StateLabel& s = model.states[k];
    const auto at = static_cast<Eigen::Index>(k);
    (s.is_rate ? rate : k >= model.kinematic_states ? differential : coordinate).push_back(at);
  }
  if (rate.size() + first_order != coordinate.size()) {
    return tl::unexpected(Failure{"linear analysis",
                                  "a model with velocity constraints has fewer rates than coordinates and no "
                                  "second-order form",
                                  {},
                                  "no-second-order"});
  }
  // Coordinates of first order stand with the differential states, behind those that have a rate before them.
  if (first_order > 0) {
    const auto follows_rate = [&](Eigen::Index k) {
      return k > 0 && model.states[static_cast<std::size_t>(k) - 1].is_rate;
    };
    const auto first = std::stable_partition(coordinate.begin(), coordinate.end(), follows_rate);
    differential.insert(differential.begin(), first, coordinate.end());
    coordinate.erase(first, coordinate.end());
  }
  const auto n = static_cast<Eigen::Index>(rate.size()), m = static_cast<Eigen::Index>(differential.size());
  const auto inputs = model.B.cols(), outputs = model.C.rows();
  std::vector<Eigen::Index> s = coordinate;
  s.insert(s.end(), differential.begin(), differential.end());
  std::vector<Eigen::Index> equations = rate;
  equations.insert(equations.end(), differential.begin(), differential.end());
  for (const Eigen::Index k : s) out.states.push_back(model.states[static_cast<std::size_t>(k)]);
  out.differential_states = model.states.size() - model.kinematic_states;

  out.M = out.B = out.K = Eigen::MatrixXd::Zero(n + m, n + m);
  out.P = Eigen::MatrixXd::Zero(n + m, inputs);
  out.C = Eigen::MatrixXd::Zero(outputs, 2 * (n + m));
  for (Eigen::Index i = 0; i < n + m; ++i) {
    const Eigen::Index row = equations[static_cast<std::size_t>(i)];
    if (i < n)
      out.M(i, i) = 1;
    else
      out.B(i, i) = 1;
    for (Eigen::Index k = 0; k < n; ++k) out.B(i, k) -= model.A(row, rate[static_cast<std::size_t>(k)]);
    for (Eigen::Index k = 0; k < n + m; ++k) out.K(i, k) = -model.A(row, s[static_cast<std::size_t>(k)]);
    if (inputs > 0) out.P.row(i) = model.B.row(row);
  }
  for (Eigen::Index k = 0; k < n + m && outputs > 0; ++k) out.C.col(k) = model.C.col(s[static_cast<std::size_t>(k)]);
  for (Eigen::Index k = 0; k < n && outputs > 0; ++k) {
    out.C.col(n + m + k) = model.C.col(rate[static_cast<std::size_t>(k)]);
  }
  out.D = model.D;
  return out;
}

}  // namespace dynalin
