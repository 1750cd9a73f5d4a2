#include "oracle.h"

#include <algorithm>

#include "differences.h"
#include "neighbourhood.h"

namespace dynalin::oracle {

namespace {

Matrix matrix(std::size_t rows, std::size_t columns) { return Matrix(rows, std::vector<double>(columns, 0.0)); }

double relative_error(const Matrix& value, const Matrix& error) {
  double largest = 1, worst = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    for (std::size_t j = 0; j < value[i].size(); ++j) {
      largest = std::max(largest, std::fabs(value[i][j]));
      worst = std::max(worst, error[i][j]);
    }
  }
  return worst / largest;
}

}  // namespace

OracleLinearModel oracle_linearize(const Mechanism& mechanism, const OraclePoint& point,
                                   const std::vector<ChosenState>& states) {
  Neighbourhood near(mechanism, point, states);
  const std::size_t n = states.size(), inputs = near.input_count();
  const std::size_t outputs = mechanism.poutput.variables.size();
  OracleLinearModel result;
  result.A = result.A_error = matrix(n, n);
  result.B = result.B_error = matrix(n, inputs);
  result.C = result.C_error = matrix(outputs, n);
  result.D = result.D_error = matrix(outputs, inputs);
  const std::vector<Real> x(n, 0), u(inputs, 0);
  const auto store = [&](const Extrapolated& column, Matrix& top, Matrix& top_error, Matrix& low, Matrix& low_error,
                         std::size_t j) {
    for (std::size_t i = 0; i < n; ++i) {
      top[i][j] = static_cast<double>(column.value[i]);
      top_error[i][j] = static_cast<double>(column.error[i]);
    }
    for (std::size_t i = 0; i < outputs; ++i) {
      low[i][j] = static_cast<double>(column.value[n + i]);
      low_error[i][j] = static_cast<double>(column.error[n + i]);
    }
  };
  constexpr Real first_step = 0x1p-6L;
  for (std::size_t j = 0; j < n; ++j) {
    const auto along = [&](Real h) {
      std::vector<Real> beside = x;
      beside[j] = h;
      return near.evaluate(beside, u);
    };
    store(differentiate(along, first_step * near.step(j)), result.A, result.A_error, result.C, result.C_error, j);
  }
  for (std::size_t j = 0; j < inputs; ++j) {
    const auto along = [&](Real h) {
      std::vector<Real> beside = u;
      beside[j] = h;
      return near.evaluate(x, beside);
    };
    store(differentiate(along, first_step), result.B, result.B_error, result.D, result.D_error, j);
  }
  const std::vector<Real> at_point = near.evaluate(x, u);
  for (std::size_t i = 0; i < outputs; ++i) {
    result.outputs.push_back(static_cast<double>(at_point[n + i]));
  }
  for (const Real v : near.nominal_inputs()) result.inputs.push_back(static_cast<double>(v));
  for (std::size_t b = 1; b < near.model().bodies.size(); ++b) {
    const BodyRef& ref = near.model().bodies[b].ref;
    const BodyMotion& m = near.nominal()[b];
    result.accelerations.push_back({ref.id, ref.kind, to_triple(m.a), to_triple(m.al)});
  }
  for (const Real v : near.model().differential_rates()) {
    result.differential_rates.push_back(static_cast<double>(v));
  }
  result.polish = static_cast<double>(near.moved());
  result.error_estimate =
      std::max({relative_error(result.A, result.A_error), relative_error(result.B, result.B_error),
                relative_error(result.C, result.C_error), relative_error(result.D, result.D_error)});
  return result;
}

}  // namespace dynalin::oracle
