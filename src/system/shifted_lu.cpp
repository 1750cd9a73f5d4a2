#include "system/shifted_lu.h"

#include <klu.h>

#include <new>

#include "system/sparse_lu.h"

namespace dynalin {

struct ShiftedLu::Factors {
  ColumnMatrix matrix;                      // with every shifted diagonal place
  std::vector<std::complex<double>> value;  // of S − σ E
  std::vector<std::size_t> diagonal;        // where the shifted places stand
  mutable klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
};

ShiftedLu::ShiftedLu(const ColumnMatrix& S, std::int32_t shifted) : factors_(std::make_unique<Factors>()) {
  Factors& f = *factors_;
  std::vector<Triplet> entries;
  entries.reserve(S.value.size() + static_cast<std::size_t>(shifted));
  for_each_entry(S, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
  for (std::int32_t c = S.columns - shifted; c < S.columns; ++c) entries.push_back({c, c, 0.0});
  f.matrix = compressed(S.rows, S.columns, entries);
  for (std::int32_t c = S.columns - shifted; c < S.columns; ++c) {
    auto k = static_cast<std::size_t>(f.matrix.start[static_cast<std::size_t>(c)]);
    while (f.matrix.row[k] != c) ++k;
    f.diagonal.push_back(k);
  }
  klu_defaults(&f.common);
  f.common.tol = 0.1;
  f.symbolic = klu_analyze(f.matrix.columns, f.matrix.start.data(), f.matrix.row.data(), &f.common);
  if (f.common.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
}

ShiftedLu::~ShiftedLu() {
  klu_z_free_numeric(&factors_->numeric, &factors_->common);
  klu_free_symbolic(&factors_->symbolic, &factors_->common);
}

double ShiftedLu::predicted_entries() const {
  return factors_->symbolic ? factors_->symbolic->lnz + factors_->symbolic->unz : 0;
}

bool ShiftedLu::factor(std::complex<double> shift) {
  Factors& f = *factors_;
  if (!f.symbolic) return false;
  f.value.assign(f.matrix.value.begin(), f.matrix.value.end());
  for (const std::size_t k : f.diagonal) f.value[k] -= shift;
  klu_z_free_numeric(&f.numeric, &f.common);
  f.numeric = klu_z_factor(f.matrix.start.data(), f.matrix.row.data(), reinterpret_cast<double*>(f.value.data()),
                           f.symbolic, &f.common);
  if (f.common.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
  return f.numeric && f.common.status == KLU_OK;
}

void ShiftedLu::solve(Eigen::VectorXcd& b) const {
  const Factors& f = *factors_;
  klu_z_solve(f.symbolic, f.numeric, f.matrix.rows, 1, reinterpret_cast<double*>(b.data()), &f.common);
}

void ShiftedLu::solve_adjoint(Eigen::VectorXcd& b) const {
  const Factors& f = *factors_;
  klu_z_tsolve(f.symbolic, f.numeric, f.matrix.rows, 1, reinterpret_cast<double*>(b.data()), 1, &f.common);
}

}  // namespace dynalin
