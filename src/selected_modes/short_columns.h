// Columns of which a few digits are enough, each in a unit of its own: half the memory.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <type_traits>

#include "base/dense_products.h"

namespace dynalin {

template <class S>
constexpr bool is_real = std::is_same_v<S, double>;
template <class S>
using ColumnsOf = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

// visit(first, count) for all rows, so many at a time that a copy of them stays small.
template <class Visit>
void for_few_rows(Eigen::Index rows, Visit&& visit) {
  constexpr Eigen::Index at_a_time = 4096;
  for (Eigen::Index first = 0; first < rows; first += at_a_time) visit(first, std::min(at_a_time, rows - first));
}

// S is double or std::complex<double>.
template <class S>
class ShortColumns {
 public:
  ShortColumns(Eigen::Index rows, Eigen::Index columns)
      : re_(rows, columns), im_(is_real<S> ? 0 : rows, is_real<S> ? 0 : columns), unit_(columns) {}

  void set(Eigen::Index first, const ColumnsOf<S>& columns) {
    for (Eigen::Index c = 0; c < columns.cols(); ++c) {
      const double largest = columns.rows() > 0 ? columns.col(c).cwiseAbs2().maxCoeff() : 0.0;
      unit_(first + c) = largest > 0 ? std::sqrt(largest) : 1.0;
      re_.col(first + c) = (columns.col(c).real() / unit_(first + c)).template cast<float>();
      if constexpr (!is_real<S>) im_.col(first + c) = (columns.col(c).imag() / unit_(first + c)).template cast<float>();
    }
  }
  // Aᴴ b for the first rows of b.
  ColumnsOf<S> adjoint_times(const ColumnsOf<S>& b) const {
    ColumnsOf<S> sum = ColumnsOf<S>::Zero(re_.cols(), b.cols());
    for_few_rows(re_.rows(),
                 [&](Eigen::Index first, Eigen::Index rows) { add_product(first, b.middleRows(first, rows), sum); });
    return unit_.asDiagonal() * sum;
  }
  // Aᴴ b, |A|ᵀ `rounding_of_b`, and the root of the sum of |A|² `variance`.
  struct Weighed {
    ColumnsOf<S> product;
    Eigen::MatrixXd rounding, deviation;
  };
  Weighed weigh(const ColumnsOf<S>& b, const Eigen::MatrixXd& rounding_of_b, const Eigen::MatrixXd& variance) const {
    const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(re_.cols(), b.cols());
    Weighed sum{zero.cast<S>(), zero, zero};
    for_few_rows(re_.rows(), [&](Eigen::Index first, Eigen::Index rows) {
      add_product(first, b.middleRows(first, rows), sum.product);
      Eigen::MatrixXd size = sizes_of_rows(first, rows).template cast<double>();
      sum.rounding += transposed_product(size, rounding_of_b.middleRows(first, rows));
      size = size.cwiseAbs2();
      sum.deviation += transposed_product(size, variance.middleRows(first, rows));
    });
    sum.product = unit_.asDiagonal() * sum.product;
    sum.rounding = unit_.asDiagonal() * sum.rounding;
    sum.deviation = unit_.asDiagonal() * sum.deviation.cwiseSqrt();
    return sum;
  }

 private:
  void add_product(Eigen::Index first, const ColumnsOf<S>& b, ColumnsOf<S>& sum) const {
    const auto times = [&](const Eigen::MatrixXf& a, const Eigen::MatrixXd& right) {
      return transposed_product(a.middleRows(first, b.rows()).template cast<double>(), right);
    };
    if constexpr (is_real<S>) {
      sum += times(re_, b);
    } else {
      const Eigen::Index columns = b.cols();
      Eigen::MatrixXd parts(b.rows(), 2 * columns);
      parts << b.real(), b.imag();
      const Eigen::MatrixXd re = times(re_, parts), im = times(im_, parts);
      sum.real() += re.leftCols(columns) + im.rightCols(columns);
      sum.imag() += re.rightCols(columns) - im.leftCols(columns);
    }
  }
  // |A|, whose squares would be beyond the range of these numbers.
  Eigen::ArrayXXf sizes_of_rows(Eigen::Index first, Eigen::Index rows) const {
    const Eigen::ArrayXXf re = re_.middleRows(first, rows).array().abs();
    if constexpr (is_real<S>) {
      return re;
    } else {
      const Eigen::ArrayXXf im = im_.middleRows(first, rows).array().abs(),
                            larger = re.max(im).max(std::numeric_limits<float>::min());
      return larger * (1 + (re.min(im) / larger).square()).sqrt();
    }
  }

  Eigen::MatrixXf re_, im_;  // the second of complex numbers alone
  Eigen::VectorXd unit_;
};

}  // namespace dynalin
