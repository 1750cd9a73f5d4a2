#include "eigenvalues/balancing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dynalin::balancing_test {
namespace {

Eigen::MatrixXd in_units(const Eigen::MatrixXd& coupling, const std::vector<int>& power) {
  Eigen::VectorXd unit(coupling.rows());
  for (std::size_t k = 0; k < power.size(); ++k) unit(static_cast<Eigen::Index>(k)) = std::ldexp(1.0, power[k]);
  return unit.cwiseInverse().asDiagonal() * coupling * unit.asDiagonal();
}

TEST(BalancingPowers, of_a_block_whose_rounding_is_small_make_both_couplings_alike) {
  const Eigen::Matrix3d jordan{{5, 1, 0}, {0, 5, 1}, {1e-12, 0, 5}};
  const Eigen::MatrixXd balanced = in_units(jordan, balancing_powers(jordan));
  EXPECT_LT(balanced(0, 1) / balanced(1, 2), 4);
  EXPECT_GT(balanced(0, 1) / balanced(1, 2), 0.25);
  EXPECT_LT(balanced(0, 1) / balanced(2, 0), 4);
  EXPECT_GT(balanced(0, 1) / balanced(2, 0), 0.25);
}

TEST(BalancingPowers, keep_units_where_nothing_couples_or_only_one_way) {
  EXPECT_EQ(balancing_powers(Eigen::Matrix2d{{1, 0}, {0, 1e9}}), (std::vector<int>{0, 0}));
  EXPECT_EQ(balancing_powers(Eigen::Matrix2d{{1, 1e9}, {0, 1}}), (std::vector<int>{0, 0}));
}

}  // namespace
}  // namespace dynalin::balancing_test
