// Complex shifts of a sparse matrix against dense solutions.
#include "system/shifted_lu.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "system/sparse_lu.h"

namespace dynalin::shifted_lu_test {
namespace {

using Complex = std::complex<double>;

struct Draw {
  std::int32_t n = 9, shifted = 4;
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(9, 9);
  ColumnMatrix sparse;
  Eigen::VectorXcd b;

  Draw() {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> number(-1, 1);
    std::uniform_int_distribution<std::int32_t> place(0, n - 1);
    std::vector<Triplet> t;
    // Shifted places of the diagonal are left empty but for one.
    for (std::int32_t k = 0; k < n; ++k) {
      if (k < n - shifted || k == n - 2) t.push_back({k, k, 2 + number(random)});
    }
    for (std::int32_t k = 0; k < 25; ++k) {
      const std::int32_t r = place(random), c = place(random);
      if (r != c) t.push_back({r, c, number(random)});
    }
    for (const Triplet& e : t) S(e.row, e.column) += e.value;
    sparse = compressed(n, n, t);
    b = Eigen::VectorXcd::NullaryExpr(n, [&] { return Complex(number(random), number(random)); });
  }
  Eigen::MatrixXcd at(Complex shift) const {
    Eigen::MatrixXcd m = S.cast<Complex>();
    for (std::int32_t k = n - shifted; k < n; ++k) m(k, k) -= shift;
    return m;
  }
};

TEST(ShiftedLu, solves_for_every_shift_with_one_pattern) {
  const Draw d;
  ShiftedLu lu(d.sparse, d.shifted);
  EXPECT_GE(lu.predicted_entries(), 9);
  for (const Complex shift : {Complex(3, 0), Complex(-1, 2.5), Complex(0.1, -40)}) {
    ASSERT_TRUE(lu.factor(shift));
    Eigen::VectorXcd x = d.b, y = d.b;
    lu.solve(x);
    lu.solve_adjoint(y);
    EXPECT_LE((d.at(shift) * x - d.b).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LE((d.at(shift).adjoint() * y - d.b).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(ShiftedLu, a_shift_onto_a_value_is_refused_and_the_next_one_is_not) {
  // diag(1; 2, 3) with a shift in the last two places
  const ColumnMatrix S = compressed(3, 3, std::vector<Triplet>{{0, 0, 1}, {1, 1, 2}, {2, 2, 3}});
  ShiftedLu lu(S, 2);
  EXPECT_FALSE(lu.factor(3.0));
  EXPECT_TRUE(lu.factor(1.0));  // the first place is not shifted
  Eigen::VectorXcd x = Eigen::VectorXcd::Ones(3);
  lu.solve(x);
  EXPECT_NEAR(x(0).real(), 1, 1e-15);
  EXPECT_NEAR(x(1).real(), 1, 1e-15);
  EXPECT_NEAR(x(2).real(), 0.5, 1e-15);
}

TEST(ShiftedLu, without_shifted_places_the_shift_does_nothing) {
  const Draw d;
  ShiftedLu lu(d.sparse, 0);
  ASSERT_TRUE(lu.factor({5, 7}));
  Eigen::VectorXcd x = d.b;
  lu.solve(x);
  EXPECT_LE((d.S.cast<Complex>() * x - d.b).cwiseAbs().maxCoeff(), 1e-10);
}

}  // namespace
}  // namespace dynalin::shifted_lu_test
