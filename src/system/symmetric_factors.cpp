#include "system/symmetric_factors.h"

#include <cassert>
#include <vector>

#include "system/klu_factors.h"
#include "system/lu_choice.h"
#include "system/mumps_matrix.h"
#include "system/nested_dissection.h"
#include "system/sparse_lu.h"

namespace dynalin {

namespace {

ColumnMatrix both_triangles(const ColumnMatrix& lower) {
  std::vector<Triplet> both;
  for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double) {
    both.push_back({r, c, 0.0});
    if (r != c) both.push_back({c, r, 0.0});
  });
  return compressed(lower.rows, lower.columns, both);
}

}  // namespace

struct SymmetricFactors::Inertia {
  MumpsMatrix<DMUMPS_STRUC_C> mumps{MumpsSymmetry::symmetric, 60};
  std::int32_t rows;
  std::vector<double> value;
  std::int64_t negative = 0;

  Inertia(const ColumnMatrix& lower, const ColumnMatrix& both) : rows(lower.rows) {
    mumps.control(13) = 1;        // all pivots are counted
    mumps.real_control(1) = 0.1;  // pivot threshold
    for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double) { mumps.add_place(r, c); });
    mumps.eliminate_in(nested_dissection(both));
  }
  bool factor(std::vector<double> values) {
    value = std::move(values);
    const int status = mumps.factor(rows, value.data());
    negative = mumps.problem().infog[11];
    return status == 0;
  }
  void solve(Eigen::MatrixXd& b) {
    mumps.control(27) = static_cast<int>(b.cols());  // at once
    mumps.solve(b.data(), static_cast<int>(b.cols()));
  }
};

struct SymmetricFactors::Solving {
  KluFactors klu;
  ColumnMatrix matrix;                                       // both triangles
  std::vector<std::pair<std::int32_t, std::int32_t>> place;  // of each entry of the lower one
  bool serves = false;

  Solving(const ColumnMatrix& lower, ColumnMatrix both) : matrix(std::move(both)) {
    serves = klu.analyse(matrix) && !wants_nested_dissection(matrix, klu.predicted_entries());
    if (!serves) return;
    // Columns in order meet the entries of each row in order.
    std::vector<std::int32_t> next(matrix.start.begin(), matrix.start.end() - 1);
    place.reserve(lower.value.size());
    const auto take = [&](std::int32_t column) { return next[static_cast<std::size_t>(column)]++; };
    std::vector<std::int32_t> below(lower.value.size()), above(lower.value.size());
    std::size_t k = 0;
    for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double) { above[k++] = r == c ? -1 : take(r); });
    k = 0;
    for_each_entry(lower, [&](std::int32_t, std::int32_t c, double) { below[k++] = take(c); });
    for (k = 0; k < below.size(); ++k) place.emplace_back(below[k], above[k]);
  }

  bool factor(const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto [below, above] = place[k];
      matrix.value[static_cast<std::size_t>(below)] = values[k];
      if (above >= 0) matrix.value[static_cast<std::size_t>(above)] = values[k];
    }
    return klu.factor(matrix);
  }
};

SymmetricFactors::SymmetricFactors(const ColumnMatrix& lower, FactorsFor use) {
  if (lower.rows == 0) return;
  ColumnMatrix both = both_triangles(lower);
  if (use == FactorsFor::solving) {
    solving_ = std::make_unique<Solving>(lower, both);
    if (solving_->serves) return;
    solving_.reset();
  }
  inertia_ = std::make_unique<Inertia>(lower, both);
}

SymmetricFactors::~SymmetricFactors() = default;

bool SymmetricFactors::factor(std::vector<double> values) {
  if (solving_) return solving_->factor(values);
  return !inertia_ || inertia_->factor(std::move(values));
}

std::int64_t SymmetricFactors::negative_pivots() const {
  assert(!solving_);
  return inertia_ ? inertia_->negative : 0;
}

void SymmetricFactors::solve(Eigen::MatrixXd& b) const {
  if (solving_) return solving_->klu.solve(b.data(), solving_->matrix.rows, static_cast<int>(b.cols()));
  if (inertia_) inertia_->solve(b);
}

}  // namespace dynalin
