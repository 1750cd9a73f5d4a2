#include "system/sparse_lu.h"

#include <klu.h>

#include <algorithm>

namespace dynalin {

ColumnMatrix compressed(std::int32_t rows, std::int32_t columns, std::span<const Triplet> triplets) {
  // Sorting by row first and then, stably, by column takes two counting passes and no comparison.
  std::vector<std::int32_t> by_row(triplets.size()), count(static_cast<std::size_t>(std::max(rows, columns)) + 2);
  for (const Triplet& t : triplets) ++count[static_cast<std::size_t>(t.row) + 1];
  for (std::size_t k = 1; k < count.size(); ++k) count[k] += count[k - 1];
  for (std::size_t k = 0; k < triplets.size(); ++k) {
    by_row[static_cast<std::size_t>(count[static_cast<std::size_t>(triplets[k].row)]++)] = static_cast<std::int32_t>(k);
  }
  ColumnMatrix m;
  m.rows = rows, m.columns = columns;
  m.start.assign(static_cast<std::size_t>(columns) + 1, 0);
  for (const Triplet& t : triplets) ++m.start[static_cast<std::size_t>(t.column) + 1];
  for (std::size_t c = 0; c < static_cast<std::size_t>(columns); ++c) m.start[c + 1] += m.start[c];
  std::vector<std::int32_t> fill(m.start.begin(), m.start.end() - 1);
  m.row.resize(triplets.size());
  m.value.resize(triplets.size());
  for (const std::int32_t k : by_row) {
    const Triplet& t = triplets[static_cast<std::size_t>(k)];
    const auto c = static_cast<std::size_t>(t.column);
    std::int32_t& end = fill[c];
    if (end > m.start[c] && m.row[static_cast<std::size_t>(end) - 1] == t.row) {
      m.value[static_cast<std::size_t>(end) - 1] += t.value;
    } else {
      m.row[static_cast<std::size_t>(end)] = t.row;
      m.value[static_cast<std::size_t>(end++)] = t.value;
    }
  }
  std::int32_t kept = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(columns); ++c) {
    const std::int32_t first = m.start[c];
    m.start[c] = kept;
    for (std::int32_t k = first; k < fill[c]; ++k, ++kept) {
      m.row[static_cast<std::size_t>(kept)] = m.row[static_cast<std::size_t>(k)];
      m.value[static_cast<std::size_t>(kept)] = m.value[static_cast<std::size_t>(k)];
    }
  }
  m.start.back() = kept;
  m.row.resize(static_cast<std::size_t>(kept));
  m.value.resize(static_cast<std::size_t>(kept));
  return m;
}

struct SparseLu::Factors {
  ColumnMatrix matrix;
  mutable klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;

  ~Factors() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }
};

SparseLu::SparseLu() = default;
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::factor(ColumnMatrix matrix) {
  auto f = std::make_unique<Factors>();
  klu_defaults(&f->common);
  // A stricter pivot choice than KLU's default: accuracy of the state matrix is worth the fill.
  f->common.tol = 0.1;
  f->matrix = std::move(matrix);
  ColumnMatrix& m = f->matrix;
  if (m.rows == 0) {
    factors_ = std::move(f);
    return true;
  }
  f->symbolic = klu_analyze(m.columns, m.start.data(), m.row.data(), &f->common);
  if (!f->symbolic) return false;
  f->numeric = klu_factor(m.start.data(), m.row.data(), m.value.data(), f->symbolic, &f->common);
  if (!f->numeric || f->common.status == KLU_SINGULAR) return false;
  klu_rcond(f->symbolic, f->numeric, &f->common);
  if (!(f->common.rcond > 1e-17)) return false;
  factors_ = std::move(f);
  return true;
}

void SparseLu::solve(Eigen::Ref<Eigen::MatrixXd> B) const {
  Factors& f = *factors_;
  const int n = f.matrix.rows;
  if (n == 0) return;
  for (Eigen::Index c = 0; c < B.cols(); ++c) {
    Eigen::VectorXd b = B.col(c), x = b;
    klu_solve(f.symbolic, f.numeric, n, 1, x.data(), &f.common);
    f.matrix.multiply_add({x.data(), static_cast<std::size_t>(n)}, {b.data(), static_cast<std::size_t>(n)}, -1.0);
    klu_solve(f.symbolic, f.numeric, n, 1, b.data(), &f.common);
    B.col(c) = x + b;
  }
}

void SparseLu::solve_transposed(Eigen::Ref<Eigen::MatrixXd> B) const {
  Factors& f = *factors_;
  if (f.matrix.rows == 0) return;
  for (Eigen::Index c = 0; c < B.cols(); ++c) {
    Eigen::VectorXd x = B.col(c);
    klu_tsolve(f.symbolic, f.numeric, f.matrix.rows, 1, x.data(), &f.common);
    B.col(c) = x;
  }
}

double SparseLu::reciprocal_condition() const { return factors_->common.rcond; }

std::size_t SparseLu::entries() const {
  if (!factors_->numeric) return 0;
  return static_cast<std::size_t>(factors_->numeric->lnz) + static_cast<std::size_t>(factors_->numeric->unz);
}

}  // namespace dynalin
