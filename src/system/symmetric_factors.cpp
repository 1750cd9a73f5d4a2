#include "system/symmetric_factors.h"

#include <cassert>
#include <new>
#include <vector>

#include "system/klu_factors.h"
#include "system/lu_choice.h"
#include "system/mumps_call.h"
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
  DMUMPS_STRUC_C id{};
  std::vector<int> row, column, place;
  std::vector<double> value;
  bool analysed = false;
  std::int64_t negative = 0;

  Inertia(const ColumnMatrix& lower, const ColumnMatrix& both) {
    constexpr int general_symmetric = 2;
    id.par = 1, id.sym = general_symmetric;
    call(-1);
    for (const int k : {1, 2, 3, 4}) control(k) = 0;  // no printing
    control(13) = 1;                                  // all pivots are counted
    control(14) = 60;                                 // room for delayed pivots, percent
    id.cntl[0] = 0.1;                                 // pivot threshold
    for_each_entry(lower,
                   [&](std::int32_t r, std::int32_t c, double) { row.push_back(r + 1), column.push_back(c + 1); });
    const auto order = nested_dissection(both);
    constexpr int as_given = 1, automatic = 7;
    control(7) = order ? as_given : automatic;
    if (order) {
      for (const std::int32_t p : *order) place.push_back(p + 1);
      id.perm_in = place.data();
    }
    id.n = lower.rows;
    id.nnz = static_cast<MUMPS_INT8>(row.size());
    id.irn = row.data(), id.jcn = column.data();
  }
  ~Inertia() { call(-2); }
  Inertia(const Inertia&) = delete;
  Inertia& operator=(const Inertia&) = delete;

  int& control(int k) { return id.icntl[k - 1]; }
  void call(int job) {
    id.job = job;
    call_mumps(id);
  }

  bool factor(std::vector<double> values) {
    value = std::move(values);
    id.a = value.data();
    constexpr int analyse_and_factor = 4, factor_again = 2, allocation_failed = -13;
    for (int tries = 0; tries < 4; ++tries) {
      call(analysed ? factor_again : analyse_and_factor);
      // −8, −9: the working space was too small for the pivots that had to be delayed.
      const bool too_small = id.infog[0] == -8 || id.infog[0] == -9;
      analysed = analysed || id.infog[0] >= 0 || too_small;
      if (!too_small) break;
      control(14) *= 3;
    }
    if (id.infog[0] == allocation_failed) throw std::bad_alloc();
    negative = id.infog[11];
    return id.infog[0] == 0;
  }
  void solve(Eigen::MatrixXd& b) {
    id.rhs = b.data(), id.nrhs = static_cast<int>(b.cols()), id.lrhs = id.n;
    constexpr int solve_all = 3;
    control(27) = static_cast<int>(b.cols());  // at once
    call(solve_all);
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
