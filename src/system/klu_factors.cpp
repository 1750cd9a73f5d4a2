#include "system/klu_factors.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>
#include <vector>

#include "system/lu_choice.h"
#include "system/row_matching.h"

namespace dynalin {

bool KluFactors::analyse(ColumnMatrix& m) {
  // A stricter pivot choice than KLU's default: accuracy of the state matrix is worth the fill.
  common_.tol = 0.1;
  std::vector<std::int32_t> rows = rows_for_analysis(m);
  symbolic_ = klu_analyze(m.columns, m.start.data(), rows.data(), &common_);
  throw_if_out_of_memory();
  return symbolic_ != nullptr;
}

bool KluFactors::factor(ColumnMatrix& m) {
  klu_free_numeric(&numeric_, &common_);
  numeric_ = klu_factor(m.start.data(), m.row.data(), m.value.data(), symbolic_, &common_);
  work_.follow(numeric_, 1);
  throw_if_out_of_memory();
  return numeric_ && common_.status != KLU_SINGULAR;
}

double KluFactors::least_pivot() {
  klu_rcond(symbolic_, numeric_, &common_);
  return common_.rcond;
}

double KluFactors::most_cancelled() {
  const auto n = static_cast<std::size_t>(symbolic_->n);
  std::vector<int> lp(n + 1), up(n + 1), li(static_cast<std::size_t>(numeric_->lnz)),
      ui(static_cast<std::size_t>(numeric_->unz));
  std::vector<double> lx(li.size()), ux(ui.size());
  if (!klu_extract(numeric_, symbolic_, lp.data(), li.data(), lx.data(), up.data(), ui.data(), ux.data(), nullptr,
                   nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, &common_)) {
    throw_if_out_of_memory();
    return 0;
  }
  // Row k of L meets column k of U: both by columns, so L is gone through once and U looked up by rows.
  std::vector<std::vector<std::pair<int, double>>> u_rows(n);
  std::vector<double> pivot(n, 0.0), taken(n, 0.0);
  for (std::size_t c = 0; c < n; ++c) {
    for (auto k = static_cast<std::size_t>(up[c]); k < static_cast<std::size_t>(up[c + 1]); ++k) {
      const auto r = static_cast<std::size_t>(ui[k]);
      if (r == c) {
        pivot[c] = std::abs(ux[k]);
      } else {
        u_rows[r].emplace_back(static_cast<int>(c), std::abs(ux[k]));
      }
    }
  }
  std::vector<double> below(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto first = static_cast<std::size_t>(lp[i]), last = static_cast<std::size_t>(lp[i + 1]);
    for (std::size_t k = first; k < last; ++k) below[static_cast<std::size_t>(li[k])] = std::abs(lx[k]);
    for (const auto& [c, u] : u_rows[i]) taken[static_cast<std::size_t>(c)] += below[static_cast<std::size_t>(c)] * u;
    for (std::size_t k = first; k < last; ++k) below[static_cast<std::size_t>(li[k])] = 0;
  }
  double least = 1;
  for (std::size_t k = 0; k < n; ++k) least = std::min(least, pivot[k] / (pivot[k] + taken[k]));
  return least;
}

// Rows are scaled by positive numbers, and L has ones on its diagonal.
int KluFactors::determinant_sign() const {
  const auto n = static_cast<std::size_t>(symbolic_->n);
  const auto* pivot = static_cast<const double*>(numeric_->Udiag);
  const auto negative = std::count_if(pivot, pivot + n, [](double p) { return p < 0; });
  const bool odd = is_odd({numeric_->Pnum, n}) != is_odd({symbolic_->Q, n});
  return (negative % 2 != 0) != odd ? -1 : 1;
}

// A matrix that does not fit is not a singular one.
void KluFactors::throw_if_out_of_memory() const {
  if (common_.status == KLU_OUT_OF_MEMORY || common_.status == KLU_TOO_LARGE) throw std::bad_alloc();
}

}  // namespace dynalin
