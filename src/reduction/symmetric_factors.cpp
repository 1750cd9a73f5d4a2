#include "reduction/symmetric_factors.h"

#include <new>
#include <stdexcept>
#include <vector>

#include "system/mumps_call.h"

namespace dynalin::reduction {

struct SymmetricFactors::Inside {
  DMUMPS_STRUC_C id{};
  std::vector<int> row, column;
  std::vector<double> value;

  explicit Inside(const SparseMatrix& matrix) {
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) {
      for (SparseMatrix::InnerIterator it(matrix, c); it; ++it) {
        if (it.row() < c) continue;
        row.push_back(static_cast<int>(it.row()) + 1);
        column.push_back(static_cast<int>(c) + 1);
        value.push_back(it.value());
      }
    }
    constexpr int symmetric = 2, by_metis = 5;
    id.job = -1, id.par = 1, id.sym = symmetric;
    call();
    for (const int k : {1, 2, 3, 4}) control(k) = 0;  // no printing
    control(7) = by_metis;
    control(14) = 40;     // room for delayed pivots, percent
    control(24) = 1;      // null pivots are counted, not divided by
    id.cntl[2] = -1e-14;  // relative to the scaled matrix
    id.n = static_cast<int>(matrix.rows());
    id.nnz = static_cast<MUMPS_INT8>(value.size());
    id.irn = row.data(), id.jcn = column.data(), id.a = value.data();
    for (int tries = 0; tries < 4; ++tries) {
      id.job = tries == 0 ? 4 : 2;
      call();
      // −8, −9: the working space was too small for the pivots that had to be delayed.
      if (id.infog[0] != -8 && id.infog[0] != -9) break;
      control(14) *= 3;
    }
    constexpr int allocation_failed = -13, too_small = -9;
    if (id.infog[0] == allocation_failed || id.infog[0] == too_small) throw std::bad_alloc();
    // The structure alone may be singular.
    if (id.infog[0] < 0 && id.infog[0] != -6 && id.infog[0] != -10)
      throw std::runtime_error("a sparse matrix was not factored");
    singular = id.infog[0] < 0;
  }
  ~Inside() {
    id.job = -2;
    call();
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

  int& control(int k) { return id.icntl[k - 1]; }
  void call() { call_mumps(id); }
  bool singular = false;
};

SymmetricFactors::SymmetricFactors(const SparseMatrix& matrix) : inside_(std::make_unique<Inside>(matrix)) {}
SymmetricFactors::~SymmetricFactors() = default;
SymmetricFactors::SymmetricFactors(SymmetricFactors&&) noexcept = default;

Eigen::Index SymmetricFactors::negative() const { return inside_->id.infog[11]; }
Eigen::Index SymmetricFactors::null_pivots() const { return inside_->singular ? 1 : inside_->id.infog[27]; }

void SymmetricFactors::solve(Eigen::Ref<Eigen::MatrixXd> x) const {
  // As many columns as stay in the cache with the front they meet.
  constexpr Eigen::Index most = 32;
  for (Eigen::Index first = 0; first < x.cols(); first += most) {
    Eigen::MatrixXd block = x.middleCols(first, std::min(most, x.cols() - first));
    DMUMPS_STRUC_C& id = inside_->id;
    id.rhs = block.data(), id.nrhs = static_cast<int>(block.cols()), id.lrhs = id.n;
    inside_->control(27) = static_cast<int>(most);
    id.job = 3;
    inside_->call();
    x.middleCols(first, block.cols()) = block;
  }
}

}  // namespace dynalin::reduction
