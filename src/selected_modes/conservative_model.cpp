#include "selected_modes/conservative_model.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "perturbation/perturbation.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;

// What may be of partials that rounding alone makes asymmetric, of the sizes of what was added up to them.
constexpr double asymmetry_of_rounding = 1e-8;

bool vanishes(const ColumnMatrix& m, std::int32_t rows) {
  bool any = false;
  for_each_entry(m, [&](std::int32_t r, std::int32_t, double v) { any = any || (r < rows && v != 0); });
  return !any;
}

bool at_rest(std::span<const ConstraintRows::Entry> row) {
  return std::all_of(row.begin(), row.end(), [](const auto& e) { return e.c.v == 0 && e.c.a1 == 0; });
}

bool is_symmetric(const Equations& equations, PartialBy family, std::int32_t n) {
  const ColumnMatrix& m = equations.matrix(family);
  const auto sizes = equations.sizes(family);
  std::vector<Triplet> difference, size;
  for (std::int32_t c = 0; c < m.columns; ++c) {
    for (auto k = static_cast<std::size_t>(m.start[static_cast<std::size_t>(c)]);
         k < static_cast<std::size_t>(m.start[static_cast<std::size_t>(c) + 1]); ++k) {
      const std::int32_t r = m.row[k];
      if (r >= n || r == c || sizes[k] == 0) continue;
      difference.push_back({std::max(r, c), std::min(r, c), r > c ? m.value[k] : -m.value[k]});
      size.push_back({std::max(r, c), std::min(r, c), sizes[k]});
    }
  }
  const ColumnMatrix off = compressed(n, n, difference), of = compressed(n, n, size);
  for (std::size_t k = 0; k < off.value.size(); ++k) {
    if (!(std::abs(off.value[k]) <= asymmetry_of_rounding * of.value[k])) return false;
  }
  return true;
}

// Whether the equations are those of masses on springs.
bool is_conservative(const Perturbation& p) {
  const PerturbedPoint& at = *p.at;
  const Equations& eq = at.equations;
  const std::int32_t n = p.equations->coordinates();
  if (at.massless || p.differential_states > 0 || at.choice.splits_unequally()) return false;
  if (!vanishes(eq.matrix(PartialBy::velocity), n) || !vanishes(eq.matrix(PartialBy::lambda), n) ||
      !vanishes(eq.matrix(PartialBy::algebraic), n) || !vanishes(eq.matrix(PartialBy::state), n) ||
      !vanishes(eq.matrix(PartialBy::state_rate), n))
    return false;
  if (!at.without_damping && !vanishes(eq.matrix(PartialBy::damping), n)) return false;
  std::int32_t active = 0;
  for (std::int32_t k = 0; k < at.rows.size(); ++k) {
    if (!at.choice.active[static_cast<std::size_t>(k)]) continue;
    if (at.rows.level(k) != RowLevel::position || !at_rest(at.rows.row(k))) return false;
    ++active;
  }
  if (p.equations->states() != 2 * (n - active)) return false;
  return std::all_of(at.choice.gradient.begin(), at.choice.gradient.end(), [](const auto& g) { return at_rest(g); }) &&
         is_symmetric(eq, PartialBy::position, n) && is_symmetric(eq, PartialBy::acceleration, n);
}

}  // namespace

std::shared_ptr<const ConservativeModel> ConservativeModel::make(const Perturbation& perturbation) {
  if (!is_conservative(perturbation)) return nullptr;
  std::shared_ptr<const ConservativeModel> model(new ConservativeModel(perturbation));
  return model->has_positive_mass() ? model : nullptr;
}

ConservativeModel::ConservativeModel(const Perturbation& perturbation)
    : at_(perturbation.at),
      owner_(perturbation.equations),
      equations_(*owner_),
      choice_(at_->choice),
      coordinates_(equations_.coordinates()) {
  const auto n = static_cast<std::int32_t>(coordinates_);
  std::vector<Triplet> stiffness, mass;
  const auto take = [&](PartialBy family, std::vector<Triplet>& to, std::vector<Triplet>& other) {
    for_each_entry(at_->equations.matrix(family), [&](std::int32_t r, std::int32_t c, double v) {
      if (r >= n || v == 0) return;
      const std::int32_t row = std::max(r, c), column = std::min(r, c);
      to.push_back({row, column, r == c ? v : 0.5 * v});
      other.push_back({row, column, 0.0});
    });
  };
  take(PartialBy::position, stiffness, mass);
  take(PartialBy::acceleration, mass, stiffness);
  std::vector<Triplet> of_accelerations;
  for_each_entry(at_->equations.matrix(PartialBy::acceleration), [&](std::int32_t r, std::int32_t c, double v) {
    if (r < n && v != 0) of_accelerations.push_back({r, c, v});
  });
  of_accelerations_ = compressed(n, n, of_accelerations);
  std::int32_t row = n;
  for (std::int32_t k = 0; k < at_->rows.size(); ++k) {
    if (!at_->choice.active[static_cast<std::size_t>(k)]) continue;
    for (const auto& e : at_->rows.row(k)) {
      if (e.c.g == 0) continue;
      stiffness.push_back({row, e.column, e.c.g});
      mass.push_back({row, e.column, 0.0});
    }
    ++row;
  }
  rows_ = row - n;
  stiffness_ = compressed(row, row, stiffness);
  mass_ = compressed(row, row, mass).value;
}

bool ConservativeModel::has_positive_mass() const {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> value = mass_;
  std::size_t k = 0;
  for_each_entry(stiffness_, [&](std::int32_t r, std::int32_t c, double v) {
    if (r >= coordinates_) {
      value[k] = v;
    } else if (mass_[k] != 0) {
      entries.emplace_back(r, c, mass_[k]);
    }
    ++k;
  });
  Eigen::SparseMatrix<double> M(coordinates_, coordinates_);
  M.setFromTriplets(entries.begin(), entries.end());
  if (Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>(M).info() == Eigen::Success) return true;
  // Bodies without inertia about an axis that joints hold.
  SymmetricFactors factors(stiffness_);
  return factors.factor(std::move(value)) && factors.negative_pivots() == rows_;
}

Matrix ConservativeModel::forces(const Matrix& a) const {
  const auto n = static_cast<std::size_t>(coordinates_);
  Matrix f = Matrix::Zero(coordinates_, a.cols());
  const auto multiply = [&](std::size_t column) {
    const auto c = static_cast<Index>(column);
    of_accelerations_.multiply_add({a.col(c).data(), n}, {f.col(c).data(), n});
  };
  const auto columns = static_cast<std::size_t>(a.cols());
  if (coordinates_ > long_column) {
    in_parallel(columns, multiply);
  } else {
    for (std::size_t c = 0; c < columns; ++c) multiply(c);
  }
  return f;
}

Matrix ConservativeModel::states_of(const Matrix& v) const {
  Matrix x = Matrix::Zero(equations_.states(), v.cols());
  for (Index c = 0; c < v.cols(); ++c) {
    for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
      for (const auto& e : choice_.gradient[k]) x(choice_.position_state[k], c) += e.c.g * v(e.column, c);
    }
  }
  return x;
}

Matrix ConservativeModel::states_transposed(const Matrix& x) const {
  Matrix v = Matrix::Zero(coordinates_, x.cols());
  for (Index c = 0; c < x.cols(); ++c) {
    for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
      for (const auto& e : choice_.gradient[k]) v(e.column, c) += e.c.g * x(choice_.position_state[k], c);
    }
  }
  return v;
}

Eigen::MatrixXcd ConservativeModel::motions(const Eigen::MatrixXcd& of_states) const {
  return equations_.motions(of_states).topRows(coordinates_);
}

// Of bᵀ a = −bᵀ F⁻¹ G x with b on coordinates alone.
Matrix ConservativeModel::motions_transposed(const Matrix& f) const {
  Matrix b = Matrix::Zero(equations_.state_columns(), f.cols());
  b.topRows(coordinates_) = f;
  const Matrix y = equations_.solve_transposed(std::move(b));
  Matrix x = Matrix::Zero(equations_.states(), f.cols());
  for (const std::int32_t k : choice_.position_state) {
    for_each_in_column(equations_.by_states_and_inputs(), k,
                       [&](std::int32_t r, double v) { x.row(k) -= v * y.row(r); });
  }
  return x;
}

bool ConservativeFactors::factor(double sigma) {
  sigma_ = sigma;
  std::vector<double> value = model_->stiffness().value;
  for (std::size_t k = 0; k < value.size(); ++k) value[k] -= sigma * model_->mass()[k];
  return factors_.factor(std::move(value));
}

Matrix ConservativeFactors::solve(const Matrix& forces) const {
  Matrix b = Matrix::Zero(model_->coordinates() + model_->rows(), forces.cols());
  b.topRows(model_->coordinates()) = forces;
  factors_.solve(b);
  return b.topRows(model_->coordinates());
}

}  // namespace dynalin
