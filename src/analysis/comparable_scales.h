// Rows and columns of comparable size, so that a small stiffness of its own is told from none: R J C.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "system/sparse_lu.h"

namespace dynalin {

struct ComparableScales {
  Eigen::VectorXd row, column;

  explicit ComparableScales(const ColumnMatrix& J)
      : row(Eigen::VectorXd::Ones(J.rows)), column(Eigen::VectorXd::Ones(J.columns)) {
    for (int pass = 0; pass < 3; ++pass) {
      for (const bool by_column : {true, false}) {
        Eigen::VectorXd& scale = by_column ? column : row;
        Eigen::VectorXd largest = Eigen::VectorXd::Zero(scale.size());
        for_each_entry(J, [&](std::int32_t r, std::int32_t c, double v) {
          double& m = largest(by_column ? c : r);
          m = std::max(m, std::abs(v) * row(r) * column(c));
        });
        for (Eigen::Index k = 0; k < scale.size(); ++k) {
          if (largest(k) > 0) scale(k) /= largest(k);
        }
      }
    }
  }

  ColumnMatrix of(ColumnMatrix J) const {
    std::size_t at = 0;
    const ColumnMatrix unscaled = J;
    for_each_entry(unscaled, [&](std::int32_t r, std::int32_t c, double v) { J.value[at++] = v * row(r) * column(c); });
    return J;
  }
};

}  // namespace dynalin
