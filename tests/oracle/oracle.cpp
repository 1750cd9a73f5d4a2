#include "oracle.h"

#include <algorithm>
#include <stdexcept>

#include "neighbourhood.h"

namespace dynalin::oracle {

namespace {

struct Extrapolated {
  std::vector<Real> value, error;
  Real relative = 0;
};

// Central differences at h, h/2, h/4 … on so many levels, extrapolated in h^2. The error is the last change of the
// diagonal of the tableau, which belongs to the less accurate of the two entries.
template <class F>
Extrapolated extrapolate(F&& f, Real h, int levels) {
  std::vector<std::vector<std::vector<Real>>> T(static_cast<std::size_t>(levels));
  for (int k = 0; k < levels; ++k) {
    const auto level = static_cast<std::size_t>(k);
    const Real step = std::ldexp(h, -k);
    std::vector<Real> d = f(step);
    const std::vector<Real> back = f(-step);
    for (std::size_t i = 0; i < d.size(); ++i) {
      d[i] = (d[i] - back[i]) / (2 * step);
      if (!std::isfinite(d[i])) throw std::runtime_error("a function has no value nearby");
    }
    T[level].push_back(d);
    for (std::size_t m = 1; m <= level; ++m) {
      std::vector<Real> better = T[level][m - 1];
      const Real weight = std::ldexp(1.0L, static_cast<int>(2 * m)) - 1;
      for (std::size_t i = 0; i < better.size(); ++i) {
        better[i] += (T[level][m - 1][i] - T[level - 1][m - 1][i]) / weight;
      }
      T[level].push_back(better);
    }
  }
  const std::vector<Real>&last = T.back().back(), &before = T[T.size() - 2].back();
  Extrapolated result{last, last, 0};
  Real largest = 1, worst = 0;
  for (std::size_t i = 0; i < result.value.size(); ++i) {
    result.error[i] = std::fabs(last[i] - before[i]);
    largest = std::max(largest, std::fabs(result.value[i]));
    worst = std::max(worst, result.error[i]);
  }
  result.relative = worst / largest;
  return result;
}

// Starts with a step that suits gentle nonlinearities and shrinks it while that pays. What is not sharp then, for the
// rounding of small steps or the curvature in large ones, gets more levels.
template <class F>
Extrapolated differentiate(F&& f, const Real first_step) {
  Extrapolated best;
  best.relative = -1;
  const auto attempt = [&](int levels, int attempts, Real enough) {
    Real h = first_step;
    for (int k = 0; k < attempts && (best.relative < 0 || best.relative >= enough); ++k, h /= 4) {
      try {
        Extrapolated next = extrapolate(f, h, levels);
        if (best.relative < 0 || next.relative < best.relative) best = std::move(next);
      } catch (const std::runtime_error&) {
        // Too far away for Newton, or for a function: the next, smaller step decides.
        if (k + 1 == attempts && best.relative < 0) throw;
      }
    }
  };
  attempt(4, 10, 1e-14L);
  attempt(6, 4, 1e-12L);
  return best;
}

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
  std::vector<Real> x(n, 0), u(inputs, 0);
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
      x[j] = h;
      std::vector<Real> value = near.evaluate(x, u);
      x[j] = 0;
      return value;
    };
    store(differentiate(along, first_step * near.step(j)), result.A, result.A_error, result.C, result.C_error, j);
  }
  for (std::size_t j = 0; j < inputs; ++j) {
    const auto along = [&](Real h) {
      u[j] = h;
      std::vector<Real> value = near.evaluate(x, u);
      u[j] = 0;
      return value;
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
    result.accelerations.push_back({ref.id, ref.kind == BodyKind::point_mass, to_triple(m.a), to_triple(m.al)});
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
