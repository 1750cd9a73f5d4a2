#include "simulation/step_factors.h"

#include <klu.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "system/row_matching.h"

namespace dynalin {

namespace {

// Entries have appeared this often: from then on all of the pattern count.
constexpr std::int64_t analysis_limit = 40;
// Of the largest entry in the same row, and of that in the same column: one that is less is what cancellation leaves
// where there is nothing, and nothing to an iteration. Such ones alone are no reason for an analysis.
constexpr double least_of_column_and_row = 1e-14;
// The pivots of an earlier matrix serve a later one as long as factors do not grow by more than this over those that
// they were chosen for.
constexpr double further_growth = 1e-2;

}  // namespace

struct StepFactors::Klu {
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;

  Klu() {
    klu_defaults(&common);
    constexpr int minimum_degree = 0;
    common.ordering = minimum_degree;
  }
  ~Klu() { clear(); }
  Klu(const Klu&) = delete;
  Klu& operator=(const Klu&) = delete;

  void clear() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }
  // A matrix that does not fit is not a singular one.
  void throw_if_out_of_memory() const {
    if (common.status == KLU_OUT_OF_MEMORY || common.status == KLU_TOO_LARGE) throw std::bad_alloc();
  }
  void analyse(ColumnMatrix& m) {
    symbolic = klu_analyze(m.columns, m.start.data(), m.row.data(), &common);
    throw_if_out_of_memory();
  }
  // With the pivots of the factors before.
  bool refactor(ColumnMatrix& m) {
    return klu_refactor(m.start.data(), m.row.data(), m.value.data(), symbolic, numeric, &common) != 0 &&
           common.status != KLU_SINGULAR;
  }
  bool factor(ColumnMatrix& m) {
    klu_free_numeric(&numeric, &common);
    numeric = klu_factor(m.start.data(), m.row.data(), m.value.data(), symbolic, &common);
    throw_if_out_of_memory();
    if (numeric && common.status != KLU_SINGULAR) return true;
    klu_free_numeric(&numeric, &common);
    return false;
  }
  // Of entries, by the largest of each column: that of the matrix beside that of U.
  double reciprocal_growth(ColumnMatrix& m) {
    klu_rgrowth(m.start.data(), m.row.data(), m.value.data(), symbolic, numeric, &common);
    return common.rgrowth;
  }
};

StepFactors::StepFactors() : klu_(std::make_unique<Klu>()) {}
StepFactors::~StepFactors() = default;

bool StepFactors::needs_analysis(const ColumnMatrix& m) const {
  if (!klu_->symbolic || kept_.size() != m.value.size()) return true;
  const auto is_new = [&](std::size_t k) { return !kept_[k] && m.value[k] != 0.0; };
  std::vector<double> in_row;  // the largest
  for (std::size_t k = 0; k < kept_.size() && in_row.empty(); ++k) {
    if (is_new(k)) in_row.assign(static_cast<std::size_t>(m.rows), 0.0);
  }
  if (in_row.empty()) return false;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    double& largest = in_row[static_cast<std::size_t>(m.row[k])];
    largest = std::max(largest, std::abs(m.value[k]));
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.columns); ++c) {
    const auto first = static_cast<std::size_t>(m.start[c]), last = static_cast<std::size_t>(m.start[c + 1]);
    double in_column = 0;
    for (std::size_t k = first; k < last; ++k) in_column = std::max(in_column, std::abs(m.value[k]));
    for (std::size_t k = first; k < last; ++k) {
      const double size = std::abs(m.value[k]);
      if (is_new(k) && size > least_of_column_and_row * std::min(in_column, in_row[static_cast<std::size_t>(m.row[k])]))
        return true;
    }
  }
  return false;
}

void StepFactors::analyse(const ColumnMatrix& m) {
  klu_->clear();
  if (kept_.size() != m.value.size()) kept_.assign(m.value.size(), 0);
  const bool all = analyses_ >= analysis_limit;
  matrix_ = {.rows = m.rows, .columns = m.columns, .start = {0}, .row = {}, .value = {}};
  entries_.clear();
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.columns); ++c) {
    for (auto k = static_cast<std::size_t>(m.start[c]); k < static_cast<std::size_t>(m.start[c + 1]); ++k) {
      if (all || m.value[k] != 0.0) kept_[k] = 1;
      if (!kept_[k]) continue;
      entries_.push_back(k);
      matrix_.row.push_back(m.row[k]);
    }
    matrix_.start.push_back(static_cast<std::int32_t>(entries_.size()));
  }
  matrix_.value.resize(entries_.size());
  put_matched_rows_on_diagonal();
  klu_->analyse(matrix_);
  ++analyses_;
}

// And first in their columns: there KLU finds them without a search of its own, which would go through the whole model
// for each column.
void StepFactors::put_matched_rows_on_diagonal() {
  row_ = matched_rows(matrix_);
  std::vector<std::int32_t> place(row_.size());
  for (std::size_t k = 0; k < row_.size(); ++k) place[static_cast<std::size_t>(row_[k])] = static_cast<std::int32_t>(k);
  for (std::int32_t& r : matrix_.row) r = place[static_cast<std::size_t>(r)];
  for (std::size_t c = 0; c < row_.size(); ++c) {
    const auto first = static_cast<std::size_t>(matrix_.start[c]);
    for (auto k = first; k < static_cast<std::size_t>(matrix_.start[c + 1]); ++k) {
      if (matrix_.row[k] != static_cast<std::int32_t>(c)) continue;
      std::swap(matrix_.row[k], matrix_.row[first]);
      std::swap(entries_[k], entries_[first]);
    }
  }
  permuted_.resize(row_.size());
}

bool StepFactors::factor(const ColumnMatrix& m) {
  if (needs_analysis(m)) analyse(m);
  if (!klu_->symbolic) return false;
  std::ranges::transform(entries_, matrix_.value.begin(), [&](std::size_t k) { return m.value[k]; });
  if (klu_->numeric && klu_->refactor(matrix_) && klu_->reciprocal_growth(matrix_) >= further_growth * growth_)
    return true;
  if (!klu_->factor(matrix_)) return false;
  growth_ = klu_->reciprocal_growth(matrix_);
  return true;
}

void StepFactors::solve(std::span<double> x) {
  for (std::size_t k = 0; k < row_.size(); ++k) permuted_[k] = x[static_cast<std::size_t>(row_[k])];
  klu_solve(klu_->symbolic, klu_->numeric, matrix_.columns, 1, permuted_.data(), &klu_->common);
  std::ranges::copy(permuted_, x.begin());
}

std::size_t StepFactors::entries() const {
  const klu_numeric* n = klu_->numeric;
  return n ? static_cast<std::size_t>(n->lnz) + static_cast<std::size_t>(n->unz) : 0;
}

}  // namespace dynalin
