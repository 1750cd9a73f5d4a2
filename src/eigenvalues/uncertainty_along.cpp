#include "eigenvalues/uncertainty_along.h"

#include <algorithm>
#include <cmath>

#include "base/dense_products.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;

// |y|ᵀ U |x|
Matrix along_entries(const Matrix& U, const EigenPairs& pairs) {
  const Matrix onto = U.transpose(), right = pairs.right.cwiseAbs(), left = pairs.left.cwiseAbs();
  return transposed_product(left, transposed_product(onto, right));
}

// Whether any eigenvalue would be known to fewer digits than double precision could have: a closer look costs as much
// as a product with all unknowns.
bool is_wide(const Matrix& along, const EigenPairs& pairs) {
  constexpr double uncertainty_worth_a_look = 1e-10;
  for (Index i = 0; i < along.cols(); ++i) {
    const auto unit = std::abs(pairs.left.col(i).dot(pairs.right.col(i)));
    if (along(i, i) > uncertainty_worth_a_look * unit * std::abs(pairs.values[static_cast<std::size_t>(i)]))
      return true;
  }
  return false;
}

// √Σ(|y_r| ρ_rc |x_c|)², of rows with roundings alone.
Matrix along_coefficients(const PerturbationEquations& equations, const EigenPairs& pairs) {
  const Matrix each = equations.rounding_variances(Matrix(Matrix::Ones(equations.unknowns(), 1)));
  std::vector<Index> rounded;
  for (Index r = 0; r < each.rows(); ++r) {
    if (each(r, 0) > 0) rounded.push_back(r);
  }
  const Index count = pairs.right.cols();
  Matrix variances(static_cast<Index>(rounded.size()), count), left = variances;
  for_column_blocks(count, [&](Index first, Index columns) {
    const ComplexMatrix x = pairs.right.middleCols(first, columns), y = pairs.left.middleCols(first, columns);
    variances.middleCols(first, columns) = equations.rounding_variances(
        all_unknowns(by_parts(x, [&](const Matrix& m) { return equations.complete(m); }), x))(rounded, Eigen::all);
    left.middleCols(first, columns) =
        all_unknowns(by_parts(y, [&](const Matrix& m) { return equations.complete_left(m); }), y)(rounded, Eigen::all)
            .cwiseAbs2();
  });
  return transposed_product(left, variances).cwiseSqrt();
}

}  // namespace

Matrix uncertainty_along(const StructuredPencil& pencil, const EigenPairs& pairs) {
  Matrix along = along_entries(pencil.uncertainty(), pairs);
  if (!along.allFinite() || !is_wide(along, pairs)) return along;
  Matrix closer = along_coefficients(pencil.equations(), pairs);
  if (pencil.beside_coefficients().size() > 0) closer += along_entries(pencil.beside_coefficients(), pairs);
  if (!closer.allFinite()) return along;
  return along.cwiseMin(closer);
}

double uncertainty_along(const StructuredPencil& pencil, const Eigen::VectorXcd& y, const Eigen::VectorXcd& x) {
  const Index n = pencil.equations().states();
  double along = std::sqrt(y.cwiseAbs2().dot(pencil.equations().rounding_variances(Eigen::MatrixXcd(x)).col(0)));
  const Matrix& beside = pencil.beside_coefficients();
  if (beside.size() > 0) along += y.tail(n).cwiseAbs().dot(beside * x.tail(n).cwiseAbs());
  return along;
}

}  // namespace dynalin
