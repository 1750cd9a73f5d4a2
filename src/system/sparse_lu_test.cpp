// Sparse solutions against dense ones, and what is refused as singular.
#include "system/sparse_lu.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace dynalin::sparse_lu_test {
namespace {

// Entries at random places with a full diagonal somewhere; rows and columns in the units given.
std::vector<Triplet> drawn(std::mt19937& random, std::int32_t n) {
  std::uniform_real_distribution<double> number(-1, 1);
  std::uniform_int_distribution<std::int32_t> place(0, n - 1);
  std::vector<Triplet> t;
  const std::int32_t shift = place(random);
  for (std::int32_t k = 0; k < n; ++k) t.push_back({k, (k + shift) % n, 2 + number(random)});
  for (std::int32_t k = 0; k < 3 * n; ++k) t.push_back({place(random), place(random), number(random)});
  return t;
}
Eigen::MatrixXd dense(std::int32_t rows, std::int32_t columns, const std::vector<Triplet>& t) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(rows, columns);
  for (const Triplet& e : t) m(e.row, e.column) += e.value;
  return m;
}
Eigen::MatrixXd numbers(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::uniform_real_distribution<double> number(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return number(random); });
}

TEST(Compressed, adds_up_equal_places_keeps_zeros_and_sorts_rows) {
  const std::vector<Triplet> t = {{2, 1, 1}, {0, 1, 5}, {2, 1, -4}, {1, 0, 0}, {3, 2, 7}, {0, 2, 2}, {0, 2, -2}};
  const ColumnMatrix m = compressed(4, 3, t);
  EXPECT_EQ(m.rows, 4);
  EXPECT_EQ(m.columns, 3);
  EXPECT_EQ(m.start, (std::vector<std::int32_t>{0, 1, 3, 5}));
  EXPECT_EQ(m.row, (std::vector<std::int32_t>{1, 0, 2, 0, 3}));
  EXPECT_EQ(m.value, (std::vector<double>{0, 5, -3, 0, 7}));
}

TEST(Compressed, an_empty_matrix_has_columns_all_the_same) {
  const ColumnMatrix m = compressed(2, 3, {});
  EXPECT_EQ(m.start, (std::vector<std::int32_t>{0, 0, 0, 0}));
  EXPECT_TRUE(m.value.empty());
}

// What was analysed for one matrix serves the next of its pattern, whatever the values; another pattern and a matrix
// that was refused in between change nothing.
TEST(SparseLu, factors_matrices_of_one_pattern_and_of_others_one_after_another) {
  std::mt19937 random(5);
  for (const std::int32_t n : {30, 2500}) {  // the second has loops enough for nested dissection
    std::vector<Triplet> t = drawn(random, n);
    if (n > 2000) {
      std::uniform_int_distribution<std::int32_t> place(0, n - 1);
      for (std::int32_t k = 0; k < 2 * n; ++k) t.push_back({place(random), place(random), 0.3});
    }
    SparseLu lu;
    for (int turn = 0; turn < 5; ++turn) {
      std::uniform_real_distribution<double> number(0.5, 2);
      for (Triplet& e : t) e.value *= number(random);
      if (turn == 2) t.push_back({0, n - 1, 0.7});
      if (turn == 3) {
        std::vector<Triplet> nothing = t;
        for (Triplet& e : nothing) e.value = 0;
        EXPECT_FALSE(lu.factor(compressed(n, n, nothing)));
      }
      const ColumnMatrix A = compressed(n, n, t);
      ASSERT_TRUE(lu.factor(A));
      const Eigen::MatrixXd b = numbers(random, n, 2);
      Eigen::MatrixXd x = b, left = b;
      lu.solve(x);
      for (Eigen::Index c = 0; c < 2; ++c) {
        const auto size = static_cast<std::size_t>(n);
        A.multiply_add({x.col(c).data(), size}, {left.col(c).data(), size}, -1.0);
      }
      EXPECT_LE(left.cwiseAbs().maxCoeff(), 1e-9) << n << " " << turn;
    }
  }
}

TEST(SparseLu, solves_with_the_matrix_and_with_its_transpose_for_many_right_hand_sides) {
  std::mt19937 random(2);
  for (const std::int32_t n : {1, 5, 40}) {
    const auto t = drawn(random, n);
    const Eigen::MatrixXd A = dense(n, n, t), B = numbers(random, n, 37);
    SparseLu lu;
    ASSERT_TRUE(lu.factor(compressed(n, n, t)));
    Eigen::MatrixXd x = B, y = B;
    lu.solve(x);
    lu.solve_transposed(y);
    EXPECT_LE((A * x - B).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LE((A.transpose() * y - B).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_GE(lu.entries(), static_cast<std::size_t>(n));
  }
}

// Entries that are zero when a large pattern is analysed and not later, and others that become zero.
TEST(SparseLu, zeros_of_a_pattern_may_change_their_places) {
  std::mt19937 random(8);
  const std::int32_t n = 2500;
  std::vector<Triplet> t = drawn(random, n);
  std::uniform_int_distribution<std::int32_t> place(0, n - 1);
  for (std::int32_t k = 0; k < 2 * n; ++k) t.push_back({place(random), place(random), 0.3});
  SparseLu lu;
  for (const std::size_t zero : {3u, 4u, 3u, 100000u}) {
    std::vector<Triplet> now = t;
    for (std::size_t k = static_cast<std::size_t>(n); k < now.size(); k += zero) now[k].value = 0;
    const ColumnMatrix A = compressed(n, n, now);
    ASSERT_TRUE(lu.factor(A));
    const Eigen::MatrixXd b = numbers(random, n, 1);
    Eigen::MatrixXd x = b, left = b;
    lu.solve(x);
    A.multiply_add({x.data(), static_cast<std::size_t>(n)}, {left.data(), static_cast<std::size_t>(n)}, -1.0);
    EXPECT_LE(left.cwiseAbs().maxCoeff(), 1e-9) << zero;
  }
}

TEST(SparseLu, a_matrix_without_rows_has_nothing_to_solve) {
  SparseLu lu;
  ASSERT_TRUE(lu.factor(compressed(0, 0, {})));
  Eigen::MatrixXd x(0, 2);
  lu.solve(x);
  lu.solve_transposed(x);
  EXPECT_EQ(lu.entries(), 0u);
}

// R A C: forces in newtons beside values of a controller in parts per billion.
TEST(SparseLu, units_that_differ_by_twenty_orders_are_no_singularity) {
  std::mt19937 random(6);
  std::uniform_int_distribution<int> power(-35, 35);
  for (int draw = 0; draw < 10; ++draw) {
    const std::int32_t n = 12;
    auto t = drawn(random, n);
    std::vector<double> row(12), column(12);
    for (std::size_t k = 0; k < 12; ++k)
      row[k] = std::ldexp(1.0, power(random)), column[k] = std::ldexp(1.0, power(random));
    const Eigen::MatrixXd A = dense(n, n, t);
    for (Triplet& e : t) e.value *= row[static_cast<std::size_t>(e.row)] * column[static_cast<std::size_t>(e.column)];
    const Eigen::Map<const Eigen::VectorXd> R(row.data(), n), C(column.data(), n);
    SparseLu lu;
    ASSERT_TRUE(lu.factor(compressed(n, n, t)));
    const Eigen::MatrixXd expected = numbers(random, n, 3);
    Eigen::MatrixXd x = R.asDiagonal() * (A * expected), y = C.asDiagonal() * (A.transpose() * expected);
    lu.solve(x);
    lu.solve_transposed(y);
    EXPECT_LE((C.asDiagonal() * x - expected).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_LE((R.asDiagonal() * y - expected).cwiseAbs().maxCoeff(), 1e-10);
  }
}

// ⎡ M Gᵀ ⎤  Masses of next to nothing, beside which every row has an entry of a constraint near 1.
// ⎣ G 0  ⎦
TEST(SparseLu, small_masses_beside_constraints_are_no_singularity) {
  std::mt19937 random(3);
  for (const double mass : {1.0, 1e-12, 1e-20, 1e-30}) {
    constexpr Eigen::Index n = 9, m = 3;
    const Eigen::MatrixXd root = numbers(random, n, n), G = numbers(random, m, n);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, n + m);
    A.topLeftCorner(n, n) = mass * (root * root.transpose() + Eigen::MatrixXd::Identity(n, n));
    A.topRightCorner(n, m) = -G.transpose();
    A.bottomLeftCorner(m, n) = G;
    std::vector<Triplet> t;
    for (std::int32_t r = 0; r < n + m; ++r) {
      for (std::int32_t c = 0; c < n + m; ++c) {
        if (A(r, c) != 0) t.push_back({r, c, A(r, c)});
      }
    }
    SparseLu lu;
    ASSERT_TRUE(lu.factor(compressed(n + m, n + m, t))) << mass;
    Eigen::MatrixXd expected = numbers(random, n + m, 1);
    expected.bottomRows(m) *= mass;
    Eigen::MatrixXd x = A * expected;
    lu.solve(x);
    EXPECT_LE((x - expected).topRows(n).cwiseAbs().maxCoeff(), 1e-9) << mass;
    EXPECT_LE((x - expected).bottomRows(m).cwiseAbs().maxCoeff(), 1e-9 * mass) << mass;
  }
}

TEST(SparseLu, singular_matrices_are_refused) {
  const auto refused = [](const Eigen::MatrixXd& m) {
    std::vector<Triplet> t;
    for (std::int32_t r = 0; r < m.rows(); ++r) {
      for (std::int32_t c = 0; c < m.cols(); ++c) {
        if (m(r, c) != 0) t.push_back({r, c, m(r, c)});
      }
    }
    SparseLu lu;
    return !lu.factor(compressed(static_cast<std::int32_t>(m.rows()), static_cast<std::int32_t>(m.cols()), t));
  };
  EXPECT_TRUE(refused(Eigen::MatrixXd{{1, 2}, {0, 0}}));                            // an empty row
  EXPECT_TRUE(refused(Eigen::MatrixXd{{1, 0}, {2, 0}}));                            // an empty column
  EXPECT_TRUE(refused(Eigen::MatrixXd{{1, 2}, {2, 4}}));                            // dependent rows
  EXPECT_TRUE(refused(Eigen::MatrixXd{{1e9, 0, 0}, {0, 0.5, 0.25}, {0, 1, 0.5}}));  // beside a large number
  EXPECT_TRUE(refused(Eigen::MatrixXd{{0.1, 0.3e-8}, {0.3, 0.9e-8}}));              // but for rounding
  EXPECT_FALSE(refused(Eigen::MatrixXd{{1, 2}, {2, 4 + 1e-9}}));                    // nearly
  EXPECT_FALSE(refused(Eigen::MatrixXd{{1e15, 0}, {0, 1e-15}}));
  EXPECT_FALSE(refused(Eigen::MatrixXd{{0.1, 0.3e-20}, {0.3, 0.8e-20}}));  // a small unit
}

TEST(SparseLu, a_nearly_singular_matrix_is_solved_to_its_condition) {
  const double gap = 1e-7;
  const std::vector<Triplet> t = {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1 + gap}};
  SparseLu lu;
  ASSERT_TRUE(lu.factor(compressed(2, 2, t)));
  Eigen::MatrixXd x(2, 1);
  x << 2, 2 + gap;  // of (1, 1)
  lu.solve(x);
  EXPECT_NEAR(x(0, 0), 1, 1e-8);
  EXPECT_NEAR(x(1, 0), 1, 1e-8);
}

TEST(SparseLu, knows_the_sign_of_the_determinant) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-1, 1);
  for (int n = 1; n < 12; ++n) {
    for (int k = 0; k < 10; ++k) {
      std::uniform_int_distribution<int> place(0, n - 1);
      Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return draw(random); });
      for (int e = 0; e < n * n / 2; ++e) A(place(random), place(random)) = 0;
      std::vector<Triplet> t;
      for (int r = 0; r < n; ++r) {
        for (int c = 0; c < n; ++c) {
          if (A(r, c) != 0) t.push_back({r, c, A(r, c)});
        }
      }
      SparseLu lu;
      if (std::abs(A.determinant()) < 1e-6 || !lu.factor(compressed(n, n, t))) continue;
      EXPECT_EQ(lu.determinant_sign(), A.determinant() > 0 ? 1 : -1) << A;
    }
  }
}

// A grid in space fills in so much that the other method takes over.
TEST(SparseLu, loops_in_all_directions_are_solved_as_well) {
  constexpr std::int32_t side = 13, n = side * side * side;
  std::vector<Triplet> t;
  const auto join = [&](std::int32_t a, std::int32_t b) {
    t.push_back({a, b, -1.0});
    t.push_back({b, a, -0.5});  // not symmetric
  };
  for (std::int32_t k = 0; k < n; ++k) {
    t.push_back({k, k, 6.5});
    if (k % side + 1 < side) join(k, k + 1);
    if (k / side % side + 1 < side) join(k, k + side);
    if (k + side * side < n) join(k, k + side * side);
  }
  const ColumnMatrix A = compressed(n, n, t);
  SparseLu lu;
  ASSERT_TRUE(lu.factor(A));
  Eigen::VectorXd expected(n);
  for (std::int32_t k = 0; k < n; ++k) expected(k) = std::sin(1.0 + k);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n, 1), y = x;
  for_each_entry(A, [&](std::int32_t r, std::int32_t c, double v) {
    x(r, 0) += v * expected(c);
    y(c, 0) += v * expected(r);
  });
  lu.solve(x);
  lu.solve_transposed(y);
  EXPECT_EQ(lu.determinant_sign(), 1);  // its diagonal dominates
  ColumnMatrix turned = A;
  for (auto k = static_cast<std::size_t>(A.start[5]); k < static_cast<std::size_t>(A.start[6]); ++k)
    turned.value[k] *= -1;
  ASSERT_TRUE(lu.factor(turned));
  EXPECT_EQ(lu.determinant_sign(), -1);
  EXPECT_LE((x - expected).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LE((y - expected).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(SparseLu, refuses_a_singular_grid_too) {
  constexpr std::int32_t side = 13, n = side * side * side;
  std::vector<Triplet> t;
  const auto join = [&](std::int32_t a, std::int32_t b) {
    for (const auto& [r, c] : {std::pair{a, b}, {b, a}}) {
      t.push_back({r, c, -1.0});
      t.push_back({r, r, 1.0});
    }
  };
  for (std::int32_t k = 0; k < n; ++k) {  // every row adds up to zero
    if (k % side + 1 < side) join(k, k + 1);
    if (k / side % side + 1 < side) join(k, k + side);
    if (k + side * side < n) join(k, k + side * side);
  }
  SparseLu lu;
  EXPECT_FALSE(lu.factor(compressed(n, n, t)));
}

}  // namespace
}  // namespace dynalin::sparse_lu_test
