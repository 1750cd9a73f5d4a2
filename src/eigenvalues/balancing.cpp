#include "eigenvalues/balancing.h"

#include <cmath>

#include "eigenvalues/index.h"

namespace dynalin {

std::vector<int> balancing_powers(Eigen::MatrixXd coupling) {
  constexpr int most_rounds = 100;
  coupling.diagonal().setZero();
  std::vector<int> power(at(coupling.rows()), 0);
  bool changed = true;
  for (int round = 0; changed && round < most_rounds; ++round) {
    changed = false;
    for (Eigen::Index a = 0; a < coupling.rows(); ++a) {
      const double of_row = coupling.row(a).norm(), of_column = coupling.col(a).norm();
      if (!(of_row > 0 && of_column > 0)) continue;
      const int exponent = static_cast<int>(std::lround(std::log2(of_row / of_column) / 2));
      if (exponent == 0) continue;
      const double f = std::ldexp(1.0, exponent);
      coupling.col(a) *= f, coupling.row(a) /= f;
      power[at(a)] += exponent;
      changed = true;
    }
  }
  return power;
}

}  // namespace dynalin
