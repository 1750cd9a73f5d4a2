#include "analysis/massless.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Of the residuals in the order of the augmented equations: partials by q, q′ and z, and what they are made of.
struct AugmentedPartials {
  ColumnMatrix positions, rates, states, positions_size, rates_size, states_size;
};

AugmentedPartials augmented_partials(const AugmentedSystem& augmented, const ConstraintRows& rows, const Equations& eq,
                                     const MasslessRequest& request) {
  const std::int32_t n = eq.layout().coordinate_count;
  std::vector<Triplet> on_q, on_u, on_z, q_size, u_size, z_size;
  const auto take = [&](PartialBy family, std::vector<Triplet>& values, std::vector<Triplet>& sizes) {
    const ColumnMatrix& m = eq.matrix(family);
    const std::span<const double> size = eq.sizes(family);
    for (std::int32_t c = 0; c < m.columns; ++c) {
      for (std::int32_t e = m.start[static_cast<std::size_t>(c)]; e < m.start[static_cast<std::size_t>(c) + 1]; ++e) {
        const auto at = static_cast<std::size_t>(e);
        const auto w = static_cast<std::size_t>(m.row[at] - n);
        if (m.row[at] >= n && w < request.cut.size() && request.cut[w]) continue;
        values.push_back({augmented.equation(m.row[at]), c, m.value[at]});
        sizes.push_back({augmented.equation(m.row[at]), c, at < size.size() ? size[at] : std::abs(m.value[at])});
      }
    }
  };
  take(PartialBy::position, on_q, q_size);
  take(PartialBy::velocity, on_u, u_size);
  if (!request.without_damping) take(PartialBy::damping, on_u, u_size);
  take(PartialBy::state, on_z, z_size);
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (!request.active[static_cast<std::size_t>(k)]) continue;
    for (const auto& e : rows.row(k)) {
      on_q.push_back({augmented.lambda(k), e.column, e.c.a0});
      on_u.push_back({augmented.lambda(k), e.column, e.c.a1});
      q_size.push_back({augmented.lambda(k), e.column, std::abs(e.c.a0)});
      u_size.push_back({augmented.lambda(k), e.column, std::abs(e.c.a1)});
    }
  }
  const std::int32_t size = augmented.size(), z = static_cast<std::int32_t>(eq.layout().states.size());
  return {compressed(size, n, on_q),   compressed(size, n, on_u),   compressed(size, z, on_z),
          compressed(size, n, q_size), compressed(size, n, u_size), compressed(size, z, z_size)};
}

Matrix left_product(const Matrix& Y, const ColumnMatrix& m) {
  Matrix out = Matrix::Zero(Y.cols(), m.columns);
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) {
    if (v != 0.0) out.col(c) += v * Y.row(r).transpose();
  });
  return out;
}

Matrix product(const ColumnMatrix& m, const Matrix& x) {
  Matrix out = Matrix::Zero(m.rows, x.cols());
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) {
    if (v != 0.0) out.row(r) += v * x.row(c);
  });
  return out;
}

void drop_rounding(Matrix& values, const Matrix& sizes) {
  values = (values.array().abs() <= cancelled_units * epsilon * sizes.array()).select(0.0, values);
}

Matrix selected_rows(const Matrix& m, const std::vector<Index>& which) {
  Matrix out(static_cast<Index>(which.size()), m.cols());
  for (std::size_t k = 0; k < which.size(); ++k) out.row(static_cast<Index>(k)) = m.row(which[k]);
  return out;
}

// The augmented matrix with a unit of force in and a held acceleration out of each massless direction.
ColumnMatrix bordered(const ColumnMatrix& m, const MasslessDirections& d) {
  std::vector<Triplet> entries;
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
  for (std::size_t k = 0; k < d.coordinate.size(); ++k) {
    const std::int32_t at = m.rows + static_cast<std::int32_t>(k);
    entries.push_back({at, d.coordinate[k], 1.0});
    entries.push_back({d.coordinate[k], at, 1.0});
  }
  const std::int32_t size = m.rows + static_cast<std::int32_t>(d.coordinate.size());
  return compressed(size, size, entries);
}

// Roundings that components of directions may carry where they should be zero: those of their largest, in comparable
// units.
constexpr double component_units = 16;
Matrix with_rounding(const System& system, const Matrix& directions) {
  Matrix size = directions.cwiseAbs();
  for (Index k = 0; k < size.cols(); ++k) {
    double largest = 0;
    for (Index c = 0; c < size.rows(); ++c)
      largest = std::max(largest, size(c, k) / system.coordinate_scale(static_cast<std::int32_t>(c)));
    for (Index c = 0; c < size.rows(); ++c)
      size(c, k) += component_units * epsilon * largest * system.coordinate_scale(static_cast<std::int32_t>(c));
  }
  return size;
}

// The same of left null vectors: what follows from components of forces, algebraic and differential equations, has
// theirs; reactions have those of the inertia that they balance.
Matrix with_rounding(const System& system, const AugmentedSystem& augmented, const ColumnMatrix& m,
                     const Matrix& left) {
  const Index n = augmented.lambda(0);
  Matrix size = left.cwiseAbs();
  Matrix rounding = Matrix::Zero(left.rows(), left.cols());
  rounding.topRows(n) = with_rounding(system, left.topRows(n)) - size.topRows(n);
  for (int pass = 0; pass < 3; ++pass) {
    for (std::int32_t c = augmented.algebraic(0); c < augmented.size(); ++c) {
      double own = 0;
      Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(left.cols());
      for_each_in_column(m, c, [&](std::int32_t r, double v) {
        if (r == c)
          own = std::abs(v);
        else
          sum += std::abs(v) * rounding.row(r);
      });
      if (own > 0) rounding.row(c) = sum / own;
    }
  }
  std::vector<double> largest(static_cast<std::size_t>(augmented.size()), 0.0);
  for (std::int32_t c = 0; c < n; ++c) {
    for_each_in_column(m, c, [&](std::int32_t r, double v) {
      double& most = largest[static_cast<std::size_t>(r)];
      most = std::max(most, std::abs(v));
    });
  }
  for (std::int32_t c = 0; c < n; ++c) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(left.cols());
    for_each_in_column(m, c, [&](std::int32_t r, double v) {
      if (r < n) sum += std::abs(v) * (rounding.row(r) + component_units * epsilon * size.row(r));
    });
    for_each_in_column(m, c, [&](std::int32_t r, double v) {
      const bool reaction = r >= augmented.lambda(0) && r < augmented.algebraic(0);
      if (reaction && std::abs(v) >= 0.1 * largest[static_cast<std::size_t>(r)])
        rounding.row(r) = rounding.row(r).cwiseMax(sum / std::abs(v));
    });
  }
  return size + rounding;
}

// Whether an acceleration that a force on the freedom itself reads stands for a mass, Yᵀ A N with the null vectors of
// both sides: a left one alone would leave its rounding, times masses that have nothing to do with the freedom.
bool has_virtual_mass(const ColumnMatrix& m, const Matrix& left, const Matrix& left_size, const Matrix& right) {
  ColumnMatrix size = m;
  for (double& v : size.value) v = std::abs(v);
  const Matrix mass = left.transpose() * product(m, right);
  const Matrix terms = left_size.transpose() * product(size, right.cwiseAbs());
  return (mass.array().abs() > 1e-12 * terms.array()).any();
}

}  // namespace

bool lacks_mass(const System& system) {
  // Coordinates outside bodies by which none deforms have no inertia.
  return std::ranges::any_of(system.bodies(), &BodySource::lacks_inertia) ||
         !std::ranges::all_of(system.layout().extras, &ExtraBlock::is_deformation);
}

MasslessDirections massless_directions(const System& system, const Motion& motion, const ConstraintRows& rows,
                                       const std::vector<bool>& active) {
  const std::int32_t n = system.layout().coordinate_count;
  std::vector<SparseRow> all;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (active[static_cast<std::size_t>(k)]) all.push_back(scaled_row(system, rows.row(k)));
  }
  const std::size_t constraints = all.size();
  for (const BodySource* body : system.bodies()) body->add_momentum_rows(motion, all);
  for (std::size_t k = constraints; k < all.size(); ++k) {
    for (std::size_t e = 0; e < all[k].column.size(); ++e) all[k].value[e] *= system.coordinate_scale(all[k].column[e]);
  }
  const std::vector<SparseRow> kept = all;
  const std::vector<std::int32_t> order(system.preference().rbegin(), system.preference().rend());
  const Elimination e = eliminate(std::move(all), n, order);
  MasslessDirections d;
  for (const std::int32_t c : system.preference()) {
    if (!e.dependent[static_cast<std::size_t>(c)]) d.coordinate.push_back(c);
  }
  const auto count = static_cast<Index>(d.coordinate.size());
  d.basis = Matrix::Zero(n, count);
  if (count == 0) return d;
  std::vector<Triplet> entries;
  std::int32_t r = 0;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (e.pivot_column[k] < 0) continue;
    double size = 0;
    for (const double v : kept[k].value) size = std::max(size, std::abs(v));
    for (std::size_t i = 0; i < kept[k].column.size(); ++i)
      entries.push_back({r, kept[k].column[i], kept[k].value[i] / size});
    ++r;
  }
  for (Index k = 0; k < count; ++k) {
    const std::int32_t c = d.coordinate[static_cast<std::size_t>(k)];
    entries.push_back({r, c, 1.0});
    d.basis(r++, k) = 1.0 / system.coordinate_scale(c);
  }
  SparseLu lu;
  if (!lu.factor(compressed(n, n, entries))) return {Matrix::Zero(n, 0), {}};
  lu.solve(d.basis);
  for (std::int32_t c = 0; c < n; ++c) d.basis.row(c) *= system.coordinate_scale(c);
  for (Index k = 0; k < count; ++k) {
    for (Index j = 0; j < count; ++j) d.basis(d.coordinate[static_cast<std::size_t>(j)], k) = j == k ? 1.0 : 0.0;
  }
  return d;
}

Matrix MasslessLimit::damped_directions() const {
  Matrix out(directions.basis.rows(), damped());
  for (Index k = 0; k < damped(); ++k)
    out.col(k) = directions.basis.col(damping.pivot_column[static_cast<std::size_t>(k)]);
  return out;
}

Matrix MasslessLimit::damped_rows(const Matrix& of) const { return selected_rows(of, damping.pivot_row); }

std::string names_of(const System& system, const MasslessDirections& d, const Matrix& combinations) {
  std::vector<std::string> names;
  for (Index k = 0; k < combinations.rows() && names.size() < 6; ++k) {
    if (combinations.row(k).cwiseAbs().maxCoeff() > 1e-6)
      names.push_back(system.layout().coordinate_text(d.coordinate[static_cast<std::size_t>(k)]));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

Result<std::optional<MasslessLimit>> massless_limit(const System& system, const Motion& motion,
                                                    const ConstraintRows& rows, const Equations& eq,
                                                    const MasslessRequest& request) {
  using Out = std::optional<MasslessLimit>;
  MasslessLimit limit;
  limit.directions = massless_directions(system, motion, rows, request.active);
  const Index k = limit.count();
  if (k == 0) return Out();
  const AugmentedSystem augmented(system);
  const ColumnMatrix matrix = augmented.matrix(eq, rows, request.active, {}, request.cut);
  SparseLu lu;
  // Singular in more than the freedoms without mass, or beside virtual masses: the plain equations say it.
  if (!lu.factor(bordered(matrix, limit.directions))) return Out();
  Matrix y = Matrix::Zero(augmented.size() + k, k);
  y.bottomRows(k).setIdentity();
  limit.right = y;
  lu.solve_transposed(y);
  lu.solve(limit.right);
  limit.left = y.topRows(augmented.size());
  limit.right.conservativeResize(augmented.size(), Eigen::NoChange);
  const Matrix size = with_rounding(system, augmented, matrix, limit.left);
  if (has_virtual_mass(matrix, limit.left, size, limit.right)) return Out();
  // Components that are rounding of the solution would couple what has nothing to do with each other.
  for (Index c = 0; c < k; ++c) {
    auto column = limit.left.col(c);
    for (const auto& [first, last] : {std::pair<Index, Index>{0, augmented.lambda(0)},
                                      {augmented.lambda(0), augmented.algebraic(0)},
                                      {augmented.algebraic(0), augmented.size()}}) {
      if (first == last) continue;
      auto group = column.segment(first, last - first);
      const double zero = cancelled_units * epsilon * group.cwiseAbs().maxCoeff();
      group = (group.array().abs() <= zero).select(0.0, group);
    }
  }

  const AugmentedPartials partials = augmented_partials(augmented, rows, eq, request);
  const Matrix along = with_rounding(system, limit.directions.basis);
  const auto balance = [&](const ColumnMatrix& of, const ColumnMatrix& sizes, Matrix& value, Matrix& its_size) {
    value = left_product(limit.left, of);
    its_size = left_product(size, sizes);
    drop_rounding(value, its_size);
  };
  balance(partials.positions, partials.positions_size, limit.on_positions, limit.on_positions_size);
  balance(partials.rates, partials.rates_size, limit.on_rates, limit.on_rates_size);
  balance(partials.states, partials.states_size, limit.on_states, limit.on_states_size);
  limit.residual_on_rates = product(partials.rates, limit.directions.basis);

  const Matrix C = limit.on_rates * limit.directions.basis;
  limit.damping = rank_split(C, limit.on_rates_size * along);
  const Matrix Z = limit.condensed_directions();
  limit.stiffness = limit.condensed_rows(limit.on_positions) * Z;
  const Matrix stiffness_size = limit.damping.left_null.cwiseAbs().transpose() * limit.on_positions_size *
                                (along * limit.damping.right_null.cwiseAbs());
  drop_rounding(limit.stiffness, stiffness_size);
  const RankSplit held = rank_split(limit.stiffness, stiffness_size);
  if (!held.other_column.empty()) {
    const std::string names = names_of(system, limit.directions, limit.damping.right_null * held.right_null);
    return tl::unexpected(Failure{
        "limit of vanishing mass",
        fmt::format("the accelerations are not determined: nothing fixes {}: there is neither mass nor {} "
                    "along it",
                    names,
                    request.without_damping ? "stiffness, and NODAMPIN leaves damping out" : "damping nor stiffness"),
        {names},
        "undetermined-accelerations"});
  }
  return Out(std::move(limit));
}

}  // namespace dynalin
