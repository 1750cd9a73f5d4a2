#include "nastran_reader/deflation.h"

#include <lapacke.h>

#include <cmath>
#include <limits>
#include <new>
#include <utility>

namespace dynalin::nastran_reader {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double rank_tolerance(Index n) { return 64 * std::sqrt(static_cast<double>(std::max<Index>(n, 1))) * epsilon; }

double reciprocal_power(double x) { return x > 0 ? std::exp2(-std::round(std::log2(x))) : 1; }

// a − x b, where entries that cancel up to rounding are zero.
MatrixXd clean_difference(const MatrixXd& a, const MatrixXd& x, const MatrixXd& b) {
  MatrixXd difference = a - x * b;
  const MatrixXd size = a.cwiseAbs() + x.cwiseAbs() * b.cwiseAbs();
  return (difference.array().abs() <= 16 * epsilon * size.array()).select(0, difference);
}

// Unknowns that the rows of `m` determine: x(dependent) = factors · x(independent). False if rows are lacking.
bool solve_for(const MatrixXd& m, DependentRows& unknowns) {
  // Rows of the transpose are unknowns: of them as many are independent as there are equations.
  const DependentRows columns = dependent_rows(m.transpose());
  if (static_cast<Index>(columns.independent.size()) < m.rows()) return false;
  unknowns.independent = columns.dependent;
  unknowns.dependent = columns.independent;
  // m_d x_d + m_d factorsᵀ x_i = 0 with m_d regular.
  unknowns.factors = -columns.factors.transpose();
  return true;
}

}  // namespace

Scales equilibrating(MatrixXd m) {
  Scales s{VectorXd::Ones(m.rows()), VectorXd::Ones(m.cols())};
  if (m.size() == 0) return s;
  for (int pass = 0; pass < 8; ++pass) {
    const VectorXd rows =
        m.cwiseAbs().rowwise().maxCoeff().unaryExpr([](double x) { return reciprocal_power(std::sqrt(x)); });
    const VectorXd columns = m.cwiseAbs().colwise().maxCoeff().transpose().unaryExpr(
        [](double x) { return reciprocal_power(std::sqrt(x)); });
    m = rows.asDiagonal() * m * columns.asDiagonal();
    s.rows.array() *= rows.array();
    s.columns.array() *= columns.array();
  }
  return s;
}

DependentRows dependent_rows(const MatrixXd& m) {
  DependentRows out;
  Scales scales = equilibrating(m);
  // Of rows that say the same the larger one is kept, or rounding in a row that should be zero would speak for others.
  // The weight is so slight that it takes few digits of what is small for good.
  scales.rows.array() *= m.cwiseAbs().rowwise().maxCoeff().array().max(1e-40).pow(1.0 / 16);
  MatrixXd transposed = scales.of(m).transpose();
  const Index rows = m.rows(), height = m.cols();
  std::vector<lapack_int> order(static_cast<std::size_t>(rows), 0);
  Index rank = 0;
  if (rows > 0 && height > 0) {
    VectorXd unused(std::min(rows, height));
    if (LAPACKE_dgeqp3(LAPACK_COL_MAJOR, static_cast<lapack_int>(height), static_cast<lapack_int>(rows),
                       transposed.data(), static_cast<lapack_int>(height), order.data(), unused.data()) != 0)
      throw std::bad_alloc();
    const double least = rank_tolerance(std::max(rows, height)) * std::max(1.0, std::abs(transposed(0, 0)));
    while (rank < std::min(rows, height) && std::abs(transposed(rank, rank)) > least) ++rank;
  } else {
    for (Index k = 0; k < rows; ++k) order[static_cast<std::size_t>(k)] = static_cast<lapack_int>(k + 1);
  }
  for (Index k = 0; k < rows; ++k) {
    const Index at = order[static_cast<std::size_t>(k)] - 1;
    (k < rank ? out.independent : out.dependent).push_back(at);
  }
  MatrixXd factors = transposed.topRightCorner(rank, rows - rank);
  if (factors.size() > 0) transposed.topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace(factors);
  factors = (factors.array().abs() <= rank_tolerance(rows)).select(0, factors);
  // Back to rows as they are: scaled row k is rows(k) times it.
  out.factors = scales.rows(out.dependent).cwiseInverse().asDiagonal() * factors.transpose() *
                scales.rows(out.independent).asDiagonal();
  return out;
}

Index deflate_infinite(Pencil& p) {
  Index gone = 0;
  while (p.E.rows() > 0) {
    const DependentRows rows = dependent_rows(p.E);
    if (rows.dependent.empty()) break;
    const MatrixXd equations =
        clean_difference(p.A(rows.dependent, Eigen::all), rows.factors, p.A(rows.independent, Eigen::all));
    DependentRows unknowns;
    if (!solve_for(equations, unknowns)) return -1;
    const auto condensed = [&](const MatrixXd& m) {
      const MatrixXd kept = m(rows.independent, Eigen::all);
      return clean_difference(kept(Eigen::all, unknowns.independent), -kept(Eigen::all, unknowns.dependent),
                              unknowns.factors);
    };
    MatrixXd E = condensed(p.E), A = condensed(p.A);
    p.E = std::move(E), p.A = std::move(A);
    gone += static_cast<Index>(rows.dependent.size());
  }
  return gone;
}

Index deflate_zero(Pencil& p) {
  std::swap(p.E, p.A);
  const Index gone = deflate_infinite(p);
  std::swap(p.E, p.A);
  return gone;
}

}  // namespace dynalin::nastran_reader
