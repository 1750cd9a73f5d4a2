#include "system/sparse_lu.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <optional>

#include "system/klu_factors.h"
#include "system/lu_choice.h"
#include "system/mumps_matrix.h"
#include "system/nested_dissection.h"

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

namespace {

// MUMPS: multifrontal LU with nested dissection.
class MumpsFactors {
 public:
  MumpsFactors() {
    mumps_.control(33) = 1;        // the determinant is wanted
    mumps_.real_control(1) = 0.1;  // pivot threshold
    mumps_.count_null_pivots();
  }

  // Later matrices have the same pattern.
  bool factor(ColumnMatrix& m, const std::optional<std::vector<std::int32_t>>& place) {
    if (!known_) {
      for_each_entry(m, [&](std::int32_t r, std::int32_t c, double) { mumps_.add_place(r, c); });
      mumps_.eliminate_in(place);
      known_ = true;
    }
    return mumps_.factor(m.rows, m.value.data()) == 0 && mumps_.problem().infog[27] == 0;
  }
  int determinant_sign() const { return mumps_.problem().rinfog[11] < 0 ? -1 : 1; }
  void solve(double* x, int columns) { mumps_.solve(x, columns); }
  void solve_transposed(double* x, int columns) { mumps_.solve(x, columns, Transposed::yes); }
  std::size_t entries() const {
    const int count = mumps_.problem().infog[28];
    return count < 0 ? static_cast<std::size_t>(-count) * 1000000u : static_cast<std::size_t>(count);
  }

 private:
  MumpsMatrix<DMUMPS_STRUC_C> mumps_{MumpsSymmetry::none, 60};
  bool known_ = false;  // the pattern
};

// Several right-hand sides at a time go through the factors once, as many as KLU takes together, or few enough to stay
// in the cache.
// Those that are zero stay so: of rates where positions alone are given, and of imaginary parts.
constexpr Eigen::Index at_once_by_klu = 4, at_once_by_mumps = 16;
template <class Function>
void for_blocks(Eigen::Ref<Eigen::MatrixXd>& B, Eigen::Index most, Function&& solve) {
  std::vector<Eigen::Index> columns;
  for (Eigen::Index c = 0; c < B.cols(); ++c) {
    if (!B.col(c).isZero(0)) columns.push_back(c);
    if (static_cast<Eigen::Index>(columns.size()) < most && c + 1 < B.cols()) continue;
    if (!columns.empty()) solve(B(Eigen::all, columns));
    columns.clear();
  }
}

// Of a matrix that is not singular: the smallest pivot beside the largest, which counts units of rows and columns as
// well; where that fails, beside what it has been added up from.
constexpr double least_pivot = 1e-17, least_left_by_cancellation = 1e-14;

// Units, powers of two, of rows and columns.
struct BalancingUnits {
  Eigen::VectorXd row, column;
};
// `largest`: every row and every column has a largest entry near 1. Masses next to nothing beside constraints, whose
// rows and columns have such an entry as it is, take `mean`: entries are near 1 in the geometric mean of each.
enum class Balance : std::uint8_t { largest, mean };
BalancingUnits balancing_units(const ColumnMatrix& m, Balance balance) {
  const int sweeps = balance == Balance::largest ? 12 : 40;
  // Units and sizes of entries are added as powers of two: a logarithm of each entry does for all sweeps.
  struct Entry {
    std::int32_t row, column;
    double power;
  };
  std::vector<Entry> entries;
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) {
    const double power = std::log2(std::abs(v));
    if (std::isfinite(power)) entries.push_back({r, c, power});
  });
  Eigen::VectorXd of_row = Eigen::VectorXd::Zero(m.rows), of_column = Eigen::VectorXd::Zero(m.columns);
  // Of the entries of a row or a column.
  struct Sizes {
    double largest = -std::numeric_limits<double>::infinity(), sum = 0;
    int count = 0;
    void add(double power) { largest = std::max(largest, power), sum += power, ++count; }
  };
  bool changed = true;
  const auto adjust = [&](Eigen::VectorXd& unit, const std::vector<Sizes>& sizes) {
    for (Eigen::Index k = 0; k < unit.size(); ++k) {
      const Sizes& s = sizes[static_cast<std::size_t>(k)];
      if (s.count == 0) continue;
      const double less = std::round(0.5 * (balance == Balance::largest ? s.largest : s.sum / s.count));
      unit(k) -= less;
      changed = changed || less != 0;
    }
  };
  for (int sweep = 0; sweep < sweeps && changed; ++sweep) {
    std::vector<Sizes> row(static_cast<std::size_t>(m.rows)), column(static_cast<std::size_t>(m.columns));
    for (const Entry& e : entries) {
      const double power = e.power + of_row(e.row) + of_column(e.column);
      row[static_cast<std::size_t>(e.row)].add(power), column[static_cast<std::size_t>(e.column)].add(power);
    }
    changed = false;
    adjust(of_row, row);
    adjust(of_column, column);
  }
  const auto powers = [](double exponent) { return std::exp2(exponent); };
  return {of_row.unaryExpr(powers), of_column.unaryExpr(powers)};
}

// The entries of `m` that stand in a pattern, zero where there are none; nothing if others are not zero.
bool take_values(const ColumnMatrix& m, ColumnMatrix& pattern) {
  if (m.rows != pattern.rows || m.columns != pattern.columns) return false;
  for (std::int32_t c = 0; c < m.columns; ++c) {
    const auto column = static_cast<std::size_t>(c);
    auto k = static_cast<std::size_t>(pattern.start[column]);
    const auto end = static_cast<std::size_t>(pattern.start[column + 1]);
    for (auto e = static_cast<std::size_t>(m.start[column]); e < static_cast<std::size_t>(m.start[column + 1]); ++e) {
      for (; k < end && pattern.row[k] < m.row[e]; ++k) pattern.value[k] = 0;
      if (k < end && pattern.row[k] == m.row[e]) {
        pattern.value[k++] = m.value[e];
      } else if (m.value[e] != 0) {
        return false;
      }
    }
    for (; k < end; ++k) pattern.value[k] = 0;
  }
  return true;
}

ColumnMatrix without_zeros(ColumnMatrix m) {
  std::size_t kept = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.columns); ++c) {
    const auto first = static_cast<std::size_t>(m.start[c]), last = static_cast<std::size_t>(m.start[c + 1]);
    m.start[c] = static_cast<std::int32_t>(kept);
    // Behind `first`, which the column before has not reached.
    for (std::size_t k = first; k < last; ++k) {
      if (m.value[k] == 0) continue;
      m.row[kept] = m.row[k];
      m.value[kept++] = m.value[k];
    }
  }
  m.start.back() = static_cast<std::int32_t>(kept);
  m.row.resize(kept), m.value.resize(kept);
  m.row.shrink_to_fit(), m.value.shrink_to_fit();
  return m;
}

}  // namespace

struct SparseLu::Factors {
  ColumnMatrix matrix;
  std::unique_ptr<KluFactors> klu;
  std::unique_ptr<MumpsFactors> mumps;
  std::optional<BalancingUnits> units;  // of the matrix that was factored
  bool keeps_zeros = false;
  std::optional<std::vector<std::int32_t>> order;  // for MUMPS

  // KLU or MUMPS, by the pattern alone.
  bool analyse() {
    klu = std::make_unique<KluFactors>();
    if (!klu->analyse(matrix)) return false;
    if (!wants_nested_dissection(matrix, klu->predicted_entries())) return true;
    klu.reset();
    // Bodies that stand along the axes leave most entries of their constraints zero. What turns up later among them is
    // taken for a sign that all will. KLU's matching of rows and columns may take n² steps without them.
    order = nested_dissection(matrix);
    if (!keeps_zeros) matrix = without_zeros(std::move(matrix));
    mumps = std::make_unique<MumpsFactors>();
    return true;
  }
  bool factor() {
    units.reset();
    if (mumps) return mumps->factor(matrix, order);
    return (klu->factor(matrix) && klu->least_pivot() > least_pivot) || factor_balanced(Balance::largest) ||
           factor_balanced(Balance::mean);
  }
  // For units that differ so much that no pivot can be compared with another.
  bool factor_balanced(Balance balance) {
    units = balancing_units(matrix, balance);
    ColumnMatrix balanced = matrix;
    for (std::int32_t c = 0; c < balanced.columns; ++c) {
      for (auto k = static_cast<std::size_t>(balanced.start[static_cast<std::size_t>(c)]);
           k < static_cast<std::size_t>(balanced.start[static_cast<std::size_t>(c) + 1]); ++k) {
        balanced.value[k] *= units->row(balanced.row[k]) * units->column(c);
      }
    }
    return klu->factor(balanced) && klu->most_cancelled() > least_left_by_cancellation;
  }

  Eigen::Index at_once() const { return mumps ? at_once_by_mumps : at_once_by_klu; }
  void solve(Eigen::MatrixXd& x) const {
    const auto columns = static_cast<int>(x.cols());
    if (units) x = units->row.asDiagonal() * x;
    mumps ? mumps->solve(x.data(), columns) : klu->solve(x.data(), matrix.rows, columns);
    if (units) x = units->column.asDiagonal() * x;
  }
  void solve_transposed(Eigen::MatrixXd& x) const {
    const auto columns = static_cast<int>(x.cols());
    if (units) x = units->column.asDiagonal() * x;
    mumps ? mumps->solve_transposed(x.data(), columns) : klu->solve_transposed(x.data(), matrix.rows, columns);
    if (units) x = units->row.asDiagonal() * x;
  }
};

SparseLu::SparseLu() = default;
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::factor(ColumnMatrix matrix) {
  const bool analysed = factors_ && take_values(matrix, factors_->matrix);
  if (!analysed) {
    const bool again = factors_ && factors_->matrix.rows == matrix.rows;
    factors_ = std::make_unique<Factors>();
    factors_->matrix = std::move(matrix), factors_->keeps_zeros = again;
  }
  if (factors_->matrix.rows == 0) return true;
  if (!analysed && !factors_->analyse()) {
    factors_.reset();
    return false;
  }
  return factors_->factor();
}

void SparseLu::solve(Eigen::Ref<Eigen::MatrixXd> B, Refined refined) const {
  const Factors& f = *factors_;
  const auto n = static_cast<std::size_t>(f.matrix.rows);
  if (n == 0) return;
  Eigen::MatrixXd b, x;
  for_blocks(B, f.at_once(), [&](auto&& columns) {
    x = columns;
    if (refined == Refined::yes) b = x;
    f.solve(x);
    if (refined == Refined::no) {
      columns = x;
      return;
    }
    for (Eigen::Index c = 0; c < b.cols(); ++c) {
      f.matrix.multiply_add({x.col(c).data(), n}, {b.col(c).data(), n}, -1.0);
    }
    f.solve(b);
    columns = x + b;
  });
}

void SparseLu::solve_transposed(Eigen::Ref<Eigen::MatrixXd> B) const {
  const Factors& f = *factors_;
  if (f.matrix.rows == 0) return;
  Eigen::MatrixXd x;
  for_blocks(B, f.at_once(), [&](auto&& block) {
    x = block;
    f.solve_transposed(x);
    block = x;
  });
}

int SparseLu::determinant_sign() const {
  if (factors_->matrix.rows == 0) return 1;
  return factors_->mumps ? factors_->mumps->determinant_sign() : factors_->klu->determinant_sign();
}

std::size_t SparseLu::entries() const {
  return factors_->mumps ? factors_->mumps->entries() : factors_->klu ? factors_->klu->entries() : 0;
}

}  // namespace dynalin
