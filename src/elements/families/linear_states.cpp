#include "elements/families/linear_states.h"

#include "elements/families/defined_unknown.h"
#include "mechanics/binder.h"

namespace dynalin {

LinearStatesKernel::LinearStatesKernel(std::vector<LinearStates> laws, const std::vector<ElementLabel>& labels,
                                       Layout& layout) {
  for (std::size_t k = 0; k < laws.size(); ++k) {
    Element e{std::move(laws[k]), 0, 0, {}};
    const LinearStates& law = e.law;
    e.first_state = static_cast<std::int32_t>(layout.states.size());
    for (Eigen::Index n = 0; n < law.A.rows(); ++n) {
      layout.add_state({&labels[k], law.type, static_cast<std::int32_t>(n) + 1,
                        law.initial.empty() ? 0.0 : law.initial[static_cast<std::size_t>(n)], law.held_in_statics});
    }
    e.first_output = static_cast<std::int32_t>(layout.algebraic.size());
    for (Eigen::Index n = 0; n < law.C.rows(); ++n) {
      layout.add_algebraic(labels[k], static_cast<std::int32_t>(n) + 1);
    }
    elements_.push_back(std::move(e));
  }
}

void LinearStatesKernel::bind(Binder& binder) {
  for (Element& e : elements_) {
    for (const VariableRef u : e.law.inputs) e.inputs.push_back(binder.signals().variable(u).index);
  }
}

bool LinearStatesKernel::add_rate_equation(std::int32_t algebraic, std::int32_t rate, Binder& binder) {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Element& e = elements_[k];
    const Eigen::Index output = algebraic - e.first_output;
    if (output < 0 || output >= e.law.C.rows()) continue;
    OutputRate r{k, output, rate, {}};
    for (Eigen::Index c = 0; c < e.law.D.cols(); ++c) {
      const bool counts = e.law.D(output, c) != 0.0;
      const Channel u{Channel::Kind::algebraic, e.inputs[static_cast<std::size_t>(c)], 0};
      r.inputs.push_back(counts ? binder.rate_of(u) : Channel());
    }
    rates_.push_back(std::move(r));
    return true;
  }
  return false;
}

void LinearStatesKernel::equations(const Motion& motion, Equations& eq) const {
  // One row of [state or output] − M z − N u = 0.
  const auto add_row = [&](const Element& e, std::int32_t row, const Eigen::MatrixXd& M, const Eigen::MatrixXd& N,
                           Eigen::Index r) {
    double sum = 0;
    for (Eigen::Index c = 0; c < M.cols(); ++c) {
      const std::int32_t z = e.first_state + static_cast<std::int32_t>(c);
      sum += M(r, c) * motion.state[static_cast<std::size_t>(z)];
      eq.add(PartialBy::state, row, z, -M(r, c));
    }
    for (Eigen::Index c = 0; c < N.cols(); ++c) {
      const std::int32_t u = e.inputs[static_cast<std::size_t>(c)];
      sum += N(r, c) * motion.algebraic[static_cast<std::size_t>(u)];
      eq.add(PartialBy::algebraic, row, u, -N(r, c));
    }
    eq.add_residual(row, -sum);
  };
  for (const Element& e : elements_) {
    for (Eigen::Index r = 0; r < e.law.A.rows(); ++r) {
      const std::int32_t z = e.first_state + static_cast<std::int32_t>(r);
      const std::int32_t row = eq.state_row(z);
      add_state_rate(motion, eq, row, z);
      add_row(e, row, e.law.A, e.law.B, r);
    }
    for (Eigen::Index r = 0; r < e.law.C.rows(); ++r) {
      const std::int32_t row = begin_definition(motion, eq, e.first_output + static_cast<std::int32_t>(r));
      add_row(e, row, e.law.C, e.law.D, r);
    }
  }
  for (const OutputRate& r : rates_) {
    const Element& e = elements_[r.element];
    const std::int32_t row = begin_definition(motion, eq, r.rate);
    for (Eigen::Index c = 0; c < e.law.C.cols(); ++c) {
      const std::int32_t z = e.first_state + static_cast<std::int32_t>(c);
      eq.add_residual(row, -e.law.C(r.output, c) * motion.state_rate[static_cast<std::size_t>(z)]);
      eq.add(PartialBy::state_rate, row, z, -e.law.C(r.output, c));
    }
    for (std::size_t c = 0; c < r.inputs.size(); ++c) {
      if (r.inputs[c].kind != Channel::Kind::algebraic) continue;
      const double d = e.law.D(r.output, static_cast<Eigen::Index>(c));
      eq.add_residual(row, -d * motion.algebraic[static_cast<std::size_t>(r.inputs[c].index)]);
      eq.add(PartialBy::algebraic, row, r.inputs[c].index, -d);
    }
  }
}

Channel LinearStatesKernel::state_channel(std::size_t element, std::size_t n) const {
  return {Channel::Kind::state, elements_[element].first_state + static_cast<std::int32_t>(n), 0};
}

Channel LinearStatesKernel::output_channel(std::size_t element, std::size_t n) const {
  return {Channel::Kind::algebraic, elements_[element].first_output + static_cast<std::int32_t>(n), 0};
}

}  // namespace dynalin
