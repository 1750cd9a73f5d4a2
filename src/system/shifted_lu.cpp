#include "system/shifted_lu.h"

#include <klu.h>

#include <cmath>
#include <new>
#include <numbers>
#include <optional>

#include "system/lu_choice.h"
#include "system/mumps_call.h"
#include "system/row_matching.h"
#include "system/sparse_lu.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;

class ComplexMumps {
 public:
  explicit ComplexMumps(const ColumnMatrix& m) {
    id_.job = -1, id_.par = 1, id_.sym = 0;
    call();
    for (const int k : {1, 2, 3, 4}) control(k) = 0;  // no printing
    control(7) = 5;                                   // METIS
    control(14) = 60;                                 // room for delayed pivots, percent
    control(33) = 1;                                  // the determinant is wanted
    id_.cntl[0] = 0.1;                                // pivot threshold
    for_each_entry(m, [&](std::int32_t r, std::int32_t c, double) {
      row_.push_back(r + 1);
      column_.push_back(c + 1);
    });
    id_.n = m.rows;
    id_.nnz = static_cast<MUMPS_INT8>(row_.size());
    id_.irn = row_.data(), id_.jcn = column_.data();
  }
  ~ComplexMumps() {
    id_.job = -2;
    call();
  }
  ComplexMumps(const ComplexMumps&) = delete;
  ComplexMumps& operator=(const ComplexMumps&) = delete;

  bool factor(std::vector<Complex>& value) {
    id_.a = reinterpret_cast<ZMUMPS_COMPLEX*>(value.data());
    for (int tries = 0; tries < 4; ++tries) {
      id_.job = analysed_ ? 2 : 4;
      call();
      analysed_ = analysed_ || id_.infog[0] >= 0 || id_.infog[0] == -8 || id_.infog[0] == -9;
      // −8, −9: the working space was too small for the pivots that had to be delayed.
      if (id_.infog[0] != -8 && id_.infog[0] != -9) break;
      control(14) *= 3;
    }
    constexpr int allocation_failed = -13;
    if (id_.infog[0] == allocation_failed) throw std::bad_alloc();
    return id_.infog[0] == 0;
  }
  void solve(Complex* x, int columns, bool transposed) {
    id_.rhs = reinterpret_cast<ZMUMPS_COMPLEX*>(x), id_.nrhs = columns, id_.lrhs = id_.n;
    control(9) = transposed ? 0 : 1;
    id_.job = 3;
    call();
  }
  Complex log_determinant() const {
    const Complex mantissa(id_.rinfog[11], id_.rinfog[12]);
    return std::log(mantissa) + static_cast<double>(id_.infog[33]) * std::numbers::ln2;
  }

 private:
  int& control(int k) { return id_.icntl[k - 1]; }
  void call() { call_mumps(id_); }
  ZMUMPS_STRUC_C id_{};
  std::vector<int> row_, column_;
  bool analysed_ = false;
};

}  // namespace

struct ShiftedLu::Factors {
  ColumnMatrix matrix;                // with every shifted diagonal place
  std::vector<Complex> value;         // of S − σ E
  std::vector<std::size_t> diagonal;  // where the shifted places stand
  mutable klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
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
  std::vector<std::int32_t> rows = rows_for_analysis(f.matrix);
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
  if (f.common.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
  return f.numeric && f.common.status == KLU_OK;
}

void ShiftedLu::solve(Eigen::VectorXcd& b) const {
  const Factors& f = *factors_;
  if (f.mumps) return f.mumps->solve(b.data(), 1, false);
  klu_z_solve(f.symbolic, f.numeric, f.matrix.rows, 1, reinterpret_cast<double*>(b.data()), &f.common);
}

void ShiftedLu::solve_adjoint(Eigen::VectorXcd& b) const {
  const Factors& f = *factors_;
  if (f.mumps) {
    b = b.conjugate().eval();
    f.mumps->solve(b.data(), 1, true);
    b = b.conjugate().eval();
    return;
  }
  klu_z_tsolve(f.symbolic, f.numeric, f.matrix.rows, 1, reinterpret_cast<double*>(b.data()), 1, &f.common);
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
