#include "system/symmetric_factors.h"

#include <new>
#include <vector>

#include "system/mumps_call.h"
#include "system/nested_dissection.h"
#include "system/sparse_lu.h"

namespace dynalin {

struct SymmetricFactors::Factors {
  DMUMPS_STRUC_C id{};
  std::vector<int> row, column, place;
  std::vector<double> value;
  bool analysed = false;
  std::int64_t negative = 0;

  int& control(int k) { return id.icntl[k - 1]; }
  void call(int job) {
    id.job = job;
    call_mumps(id);
  }
};

SymmetricFactors::SymmetricFactors(const ColumnMatrix& lower) : factors_(std::make_unique<Factors>()) {
  Factors& f = *factors_;
  constexpr int general_symmetric = 2;
  f.id.par = 1, f.id.sym = general_symmetric;
  f.call(-1);
  for (const int k : {1, 2, 3, 4}) f.control(k) = 0;  // no printing
  f.control(13) = 1;                                  // all pivots are counted
  f.control(14) = 60;                                 // room for delayed pivots, percent
  f.id.cntl[0] = 0.1;                                 // pivot threshold
  std::vector<Triplet> both;
  for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double) {
    f.row.push_back(r + 1), f.column.push_back(c + 1);
    both.push_back({r, c, 0.0});
    if (r != c) both.push_back({c, r, 0.0});
  });
  const auto order = nested_dissection(compressed(lower.rows, lower.columns, both));
  constexpr int as_given = 1, automatic = 7;
  f.control(7) = order ? as_given : automatic;
  if (order) {
    for (const std::int32_t p : *order) f.place.push_back(p + 1);
    f.id.perm_in = f.place.data();
  }
  f.id.n = lower.rows;
  f.id.nnz = static_cast<MUMPS_INT8>(f.row.size());
  f.id.irn = f.row.data(), f.id.jcn = f.column.data();
}

SymmetricFactors::~SymmetricFactors() { factors_->call(-2); }

bool SymmetricFactors::factor(std::vector<double> values) {
  Factors& f = *factors_;
  if (f.id.n == 0) return true;
  f.value = std::move(values);
  f.id.a = f.value.data();
  constexpr int analyse_and_factor = 4, factor_again = 2, allocation_failed = -13;
  for (int tries = 0; tries < 4; ++tries) {
    f.call(f.analysed ? factor_again : analyse_and_factor);
    // −8, −9: the working space was too small for the pivots that had to be delayed.
    const bool too_small = f.id.infog[0] == -8 || f.id.infog[0] == -9;
    f.analysed = f.analysed || f.id.infog[0] >= 0 || too_small;
    if (!too_small) break;
    f.control(14) *= 3;
  }
  if (f.id.infog[0] == allocation_failed) throw std::bad_alloc();
  f.negative = f.id.infog[11];
  return f.id.infog[0] == 0;
}

std::int64_t SymmetricFactors::negative_pivots() const { return factors_->negative; }

void SymmetricFactors::solve(Eigen::MatrixXd& b) const {
  Factors& f = *factors_;
  if (f.id.n == 0) return;
  f.id.rhs = b.data(), f.id.nrhs = static_cast<int>(b.cols()), f.id.lrhs = f.id.n;
  constexpr int solve_all = 3;
  f.control(27) = static_cast<int>(b.cols());  // at once
  f.call(solve_all);
}

}  // namespace dynalin
