#include "system/shifted_lu.h"

#include <klu.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <optional>
#include <span>

#include "system/klu_work.h"
#include "system/lu_choice.h"
#include "system/mumps_matrix.h"
#include "system/row_matching.h"
#include "system/sparse_lu.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;

class ComplexMumps {
 public:
  explicit ComplexMumps(const ColumnMatrix& m) : rows_(m.rows) {
    mumps_.eliminate_by_metis();
    mumps_.control(33) = 1;        // the determinant is wanted
    mumps_.real_control(1) = 0.1;  // pivot threshold
    for_each_entry(m, [&](std::int32_t r, std::int32_t c, double) { mumps_.add_place(r, c); });
  }
  bool factor(std::vector<Complex>& value) { return mumps_.factor(rows_, value.data()) == 0; }
  void solve(Complex* x, int columns, Transposed transposed) { mumps_.solve(x, columns, transposed); }
  Complex log_determinant() const {
    const ZMUMPS_STRUC_C& id = mumps_.problem();
    const Complex mantissa(id.rinfog[11], id.rinfog[12]);
    return std::log(mantissa) + static_cast<double>(id.infog[33]) * std::numbers::ln2;
  }

 private:
  std::int32_t rows_;
  MumpsMatrix<ZMUMPS_STRUC_C> mumps_{MumpsSymmetry::none, 60};
};

// The shift stands at these places, whatever it will be.
ColumnMatrix with_large_places(ColumnMatrix m, std::span<const std::size_t> places) {
  double largest = 0;
  for (const double v : m.value) largest = std::max(largest, std::abs(v));
  for (const std::size_t k : places) m.value[k] = largest;
  return m;
}

}  // namespace

struct ShiftedLu::Factors {
  ColumnMatrix matrix;                // with every shifted diagonal place
  std::vector<Complex> value;         // of S − σ E
  std::vector<std::size_t> diagonal;  // where the shifted places stand
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
  mutable KluWork work;
  mutable std::optional<ComplexMumps> mumps;
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
  std::vector<std::int32_t> rows = rows_for_analysis(with_large_places(f.matrix, f.diagonal));
  f.symbolic = klu_analyze(f.matrix.columns, f.matrix.start.data(), rows.data(), &f.common);
  if (f.common.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
  if (f.symbolic && wants_nested_dissection(f.matrix, predicted_entries())) f.mumps.emplace(f.matrix);
}

ShiftedLu::~ShiftedLu() {
  klu_z_free_numeric(&factors_->numeric, &factors_->common);
  klu_free_symbolic(&factors_->symbolic, &factors_->common);
}

double ShiftedLu::predicted_entries() const {
  return factors_->symbolic ? factors_->symbolic->lnz + factors_->symbolic->unz : 0;
}

bool ShiftedLu::factor(Complex shift) {
  Factors& f = *factors_;
  if (!f.symbolic) return false;
  f.value.assign(f.matrix.value.begin(), f.matrix.value.end());
  for (const std::size_t k : f.diagonal) f.value[k] -= shift;
  if (f.mumps) return f.mumps->factor(f.value);
  klu_z_free_numeric(&f.numeric, &f.common);
  f.numeric = klu_z_factor(f.matrix.start.data(), f.matrix.row.data(), reinterpret_cast<double*>(f.value.data()),
                           f.symbolic, &f.common);
  f.work.follow(f.numeric, 2);
  if (f.common.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
  return f.numeric && f.common.status == KLU_OK;
}

void ShiftedLu::solve(Eigen::VectorXcd& b) const {
  const Factors& f = *factors_;
  if (f.mumps) return f.mumps->solve(b.data(), 1, Transposed::no);
  f.work.with(f.common, [&](klu_numeric* factors, klu_common* common) {
    klu_z_solve(f.symbolic, factors, f.matrix.rows, 1, reinterpret_cast<double*>(b.data()), common);
  });
}

void ShiftedLu::solve_adjoint(Eigen::VectorXcd& b) const {
  const Factors& f = *factors_;
  if (f.mumps) {
    b = b.conjugate().eval();
    f.mumps->solve(b.data(), 1, Transposed::yes);
    b = b.conjugate().eval();
    return;
  }
  f.work.with(f.common, [&](klu_numeric* factors, klu_common* common) {
    klu_z_tsolve(f.symbolic, factors, f.matrix.rows, 1, reinterpret_cast<double*>(b.data()), 1, common);
  });
}

Complex ShiftedLu::log_determinant() const {
  const Factors& f = *factors_;
  if (f.mumps) return f.mumps->log_determinant();
  const auto n = static_cast<std::size_t>(f.symbolic->n);
  const auto* pivot = static_cast<const Complex*>(f.numeric->Udiag);
  Complex sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    sum += std::log(pivot[k]);
    if (f.numeric->Rs) sum += std::log(f.numeric->Rs[k]);
  }
  if (is_odd({f.numeric->Pnum, n}) != is_odd({f.symbolic->Q, n})) sum += Complex(0, std::numbers::pi);
  return {sum.real(), std::remainder(sum.imag(), 2 * std::numbers::pi)};
}

}  // namespace dynalin
