#include "reduction/inertia_factors.h"

#include <new>
#include <stdexcept>
#include <vector>

#include "system/mumps_matrix.h"

namespace dynalin::reduction {

struct InertiaFactors::Inside {
  MumpsMatrix<DMUMPS_STRUC_C> mumps{MumpsSymmetry::symmetric, 40};
  std::vector<double> value;
  bool singular = false;

  explicit Inside(const SparseMatrix& matrix) {
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) {
      for (SparseMatrix::InnerIterator it(matrix, c); it; ++it) {
        if (it.row() < c) continue;
        mumps.add_place(static_cast<std::int32_t>(it.row()), static_cast<std::int32_t>(c));
        value.push_back(it.value());
      }
    }
    mumps.eliminate_by_metis();
    mumps.count_null_pivots();
    const int status = mumps.factor(static_cast<std::int32_t>(matrix.rows()), value.data());
    constexpr int too_small = -9;
    if (status == too_small) throw std::bad_alloc();
    // The structure alone may be singular.
    if (status < 0 && status != -6 && status != -10) throw std::runtime_error("a sparse matrix was not factored");
    singular = status < 0;
  }
};

InertiaFactors::InertiaFactors(const SparseMatrix& matrix) : inside_(std::make_unique<Inside>(matrix)) {}
InertiaFactors::~InertiaFactors() = default;
InertiaFactors::InertiaFactors(InertiaFactors&&) noexcept = default;

Eigen::Index InertiaFactors::negative() const { return inside_->mumps.problem().infog[11]; }
Eigen::Index InertiaFactors::null_pivots() const { return inside_->singular ? 1 : inside_->mumps.problem().infog[27]; }

void InertiaFactors::solve(Eigen::Ref<Eigen::MatrixXd> x) const {
  // As many columns as stay in the cache with the front they meet.
  constexpr Eigen::Index most = 32;
  for (Eigen::Index first = 0; first < x.cols(); first += most) {
    Eigen::MatrixXd block = x.middleCols(first, std::min(most, x.cols() - first));
    inside_->mumps.control(27) = static_cast<int>(most);
    inside_->mumps.solve(block.data(), static_cast<int>(block.cols()));
    x.middleCols(first, block.cols()) = block;
  }
}

}  // namespace dynalin::reduction
