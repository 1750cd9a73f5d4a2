#include "reduction/lowest_modes.h"

#include <gtest/gtest.h>

#include "reduction/test_models.h"

namespace dynalin::reduction::lowest_modes_test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// A model clamped where `is_held` says so.
FiniteElementModel held(const FiniteElementModel& model, bool (*is_held)(const Eigen::Vector3d&)) {
  FiniteElementModel result;
  result.nodes = model.nodes;
  test::Triplets keep;
  for (std::size_t row = 0; row < model.freedoms.size(); ++row) {
    const Freedom& f = model.freedoms[row];
    if (is_held(model.nodes.at(f.node))) continue;
    keep.emplace_back(static_cast<std::int32_t>(row), static_cast<std::int32_t>(result.freedoms.size()), 1.0);
    result.freedoms.push_back(f);
  }
  SparseMatrix T(static_cast<Index>(model.freedoms.size()), static_cast<Index>(result.freedoms.size()));
  T.setFromTriplets(keep.begin(), keep.end());
  result.stiffness = T.transpose() * model.stiffness * T;
  result.mass = T.transpose() * model.mass * T;
  return result;
}

FiniteElementModel square_plate() {
  return held(test::bricks({.elements = {12, 12, 2}, .size = {0.3, 0.3, 0.02}}), [](const Eigen::Vector3d& x) {
    return x[0] < 1e-9 || x[1] < 1e-9 || x[0] > 0.3 - 1e-9 || x[1] > 0.3 - 1e-9;
  });
}

// More freedoms than are taken as dense: a subspace, against all eigenvalues of the dense matrices.
TEST(LowestModes, of_a_square_plate_all_pairs_are_found) {
  const FiniteElementModel plate = square_plate();
  ASSERT_GT(plate.mass.rows(), 1000);
  const VectorXd all = test::all_squares(plate);
  const auto modes = lowest_modes(plate.stiffness, plate.mass, InertiaFactors(plate.stiffness), {.count = 24});
  ASSERT_TRUE(modes.has_value()) << modes.error();
  ASSERT_GE(modes->squares.size(), 24);
  for (Index k = 0; k < modes->squares.size(); ++k) EXPECT_NEAR(modes->squares[k] / all[k], 1, 1e-9) << k;
  const Eigen::MatrixXd m = modes->shapes.transpose() * plate.mass * modes->shapes;
  EXPECT_LT((m - Eigen::MatrixXd::Identity(m.rows(), m.cols())).cwiseAbs().maxCoeff(), 1e-9);
  const Eigen::MatrixXd residual =
      plate.stiffness * modes->shapes - plate.mass * modes->shapes * modes->squares.asDiagonal();
  const Eigen::MatrixXd force = plate.stiffness * modes->shapes;
  EXPECT_LT((residual.colwise().norm().array() / force.colwise().norm().array()).maxCoeff(), 1e-7);
}

TEST(LowestModes, below_a_frequency_are_as_many_as_there_are) {
  const FiniteElementModel plate = square_plate();
  const VectorXd all = test::all_squares(plate);
  for (const Index k : {0, 1, 6, 13}) {
    const double between = all[k] * (1 + 1e-4);
    const auto modes = lowest_modes(plate.stiffness, plate.mass, InertiaFactors(plate.stiffness), {.below = between});
    ASSERT_TRUE(modes.has_value()) << modes.error();
    EXPECT_EQ(modes->squares.size(), (all.array() < between).count());
  }
}

// Two bodies that have nothing to do with each other, and are the same: every frequency twice, exactly.
TEST(LowestModes, of_equal_bodies_are_all_pairs) {
  const FiniteElementModel one =
      held(test::bricks({.elements = {10, 4, 4}}), [](const Eigen::Vector3d& x) { return x[0] < 1e-9; });
  const Index n = one.mass.rows();
  test::Triplets k, m;
  for (Index c = 0; c < n; ++c) {
    for (int copy = 0; copy < 3; ++copy) {
      const auto at = [&](Index i) { return static_cast<std::int32_t>(i + copy * n); };
      for (SparseMatrix::InnerIterator it(one.stiffness, c); it; ++it) k.emplace_back(at(it.row()), at(c), it.value());
      for (SparseMatrix::InnerIterator it(one.mass, c); it; ++it) m.emplace_back(at(it.row()), at(c), it.value());
    }
  }
  const SparseMatrix K = test::matrix_of(3 * n, k), M = test::matrix_of(3 * n, m);
  const VectorXd all = test::all_squares(one);
  const auto modes = lowest_modes(K, M, InertiaFactors(K), {.count = 10});
  ASSERT_TRUE(modes.has_value()) << modes.error();
  ASSERT_EQ(modes->squares.size(), 12);
  // The dense values are less exact: their rounding is that of the highest frequency.
  for (Index j = 0; j < 12; ++j) EXPECT_NEAR(modes->squares[j] / all[j / 3], 1, 1e-8) << j;
}

// As of elements with reduced integration: the mass is singular, and what it cannot see has no part in the shapes.
TEST(LowestModes, of_a_singular_mass) {
  FiniteElementModel plate = square_plate();
  for (Index c = 0; c < plate.mass.cols(); ++c) {
    for (SparseMatrix::InnerIterator it(plate.mass, c); it; ++it) {
      if (it.row() % 2 == 0 || c % 2 == 0) it.valueRef() = 0;
    }
  }
  const Eigen::MatrixXd K(plate.stiffness), M(plate.mass);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> all(M, K, Eigen::EigenvaluesOnly);
  const auto modes = lowest_modes(plate.stiffness, plate.mass, InertiaFactors(plate.stiffness), {.count = 12});
  ASSERT_TRUE(modes.has_value()) << modes.error();
  ASSERT_GE(modes->squares.size(), 12);
  for (Index k = 0; k < modes->squares.size(); ++k)
    EXPECT_NEAR(modes->squares[k] * all.eigenvalues()[K.rows() - 1 - k], 1, 1e-9) << k;
  const Eigen::MatrixXd force = plate.stiffness * modes->shapes;
  const Eigen::MatrixXd residual = force - plate.mass * modes->shapes * modes->squares.asDiagonal();
  EXPECT_LT((residual.colwise().norm().array() / force.colwise().norm().array()).maxCoeff(), 1e-7);
}

// As of one row of elements with reduced integration: what the mass does not see but for rounding, of either sign, is
// strained by next to nothing.
TEST(LowestModes, of_soft_shapes_without_mass_are_none) {
  for (const double rounding : {-1e-15, 0.0, 1e-15}) {
    SparseMatrix stiffness(2, 2), mass(2, 2);
    for (Index r = 0; r < 2; ++r) {
      for (Index c = 0; c < 2; ++c) {
        stiffness.insert(r, c) = r == c ? 50 + 5e-10 : 50 - 5e-10;
        mass.insert(r, c) = r == 1 && c == 1 ? 1 + rounding : 1;
      }
    }
    const auto modes = lowest_modes(stiffness, mass, InertiaFactors(stiffness), {.count = 2});
    ASSERT_TRUE(modes.has_value()) << modes.error();
    ASSERT_EQ(modes->squares.size(), 1);
    EXPECT_NEAR(modes->squares[0], 50, 1e-9);
  }
}

// Of a lumped mass on many freedoms there are no more modes than freedoms with mass.
TEST(LowestModes, are_no_more_than_masses) {
  FiniteElementModel plate = square_plate();
  SparseMatrix mass(plate.mass.rows(), plate.mass.cols());
  for (const Index k : {10, 301, 642}) mass.insert(k, k) = 2.0;
  const auto modes = lowest_modes(plate.stiffness, mass, InertiaFactors(plate.stiffness), {.count = 12});
  ASSERT_TRUE(modes.has_value()) << modes.error();
  EXPECT_EQ(modes->squares.size(), 3);
}

}  // namespace
}  // namespace dynalin::reduction::lowest_modes_test
