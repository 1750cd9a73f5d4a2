#include "linear/descriptor_form.h"

#include "perturbation/perturbation.h"
#include "perturbation/perturbed_point.h"

namespace dynalin {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

Sparse made_of(Eigen::Index rows, Eigen::Index columns, const Entries& entries) {
  Sparse m(rows, columns);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

}  // namespace

DescriptorForm descriptor_form(const Perturbation& linear) {
  const PerturbationEquations& p = *linear.equations;
  const StateSpace& model = linear.model;
  DescriptorForm out;
  out.time = model.time, out.of_equations = model.of_equations;
  out.states = model.states, out.inputs = model.inputs, out.outputs = model.outputs;
  out.pinput = model.pinput, out.poutput = model.poutput, out.rm = model.rm, out.pstate = model.pstate;
  out.original = model.original;
  out.first_state = p.state_columns();
  const Eigen::Index n = p.unknowns();
  const auto inputs = static_cast<Eigen::Index>(model.inputs.size());
  const auto outputs = static_cast<Eigen::Index>(model.outputs.size());
  Entries of_E, of_A, of_B, of_C;
  for (std::int32_t k = p.state_columns(); k < p.unknowns(); ++k) of_E.emplace_back(k, k, 1.0);
  for_each_entry(p.products(), [&](std::int32_t r, std::int32_t c, double v) { of_A.emplace_back(r, c, v); });
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(inputs); ++k) {
    for_each_in_column(p.by_states_and_inputs(), p.states() + k,
                       [&](std::int32_t r, double v) { of_B.emplace_back(r, k, v); });
  }
  for_each_entry(linear.at->outputs_by_unknowns(p),
                 [&](std::int32_t r, std::int32_t c, double v) { of_C.emplace_back(r, c, v); });
  out.E = made_of(n, n, of_E);
  out.A = made_of(n, n, of_A);
  out.B = made_of(n, inputs, of_B);
  out.C = made_of(outputs, n, of_C);
  out.D = Sparse(outputs, inputs);  // inputs are unknowns among a
  return out;
}

}  // namespace dynalin
