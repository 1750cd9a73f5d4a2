#include "eigenvalues/equal_values.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "analysis/initial.h"
#include "eigenvalues/eigen.h"
#include "system/model_test_support.h"

namespace dynalin::equal_values_test {
namespace {

using ComplexMatrix = Eigen::MatrixXcd;

// Two discs alike and a third on hinges with springs, and what the first two are coupled by in one direction only.
struct Discs {
  std::shared_ptr<const System> system;
  Perturbation perturbation;
  LinearSystem linear;
  EigenPairs pairs;

  explicit Discs(const std::string& coupling) {
    std::string text;
    for (const char* disc : {"2", "3", "4"}) {
      const std::string id = disc, stiffness = id == "4" ? "9" : "4";
      text += "PART/" + id + ", MASS=1, CM=" + id + "0, IP=1,1,1\nMARKER/" + id + "0\nJOINT/" + id +
              ", REVOLUTE, I=" + id + "0, J=1\nSPRINGDAMPER/" + id + ", ROTATIONAL, I=" + id +
              "0, J=1, KT=" + stiffness + "\n";
    }
    system = system_test::system_of(text + coupling);
    Findings findings;
    perturbation = perturb(*system, initial_conditions(*system, findings).value(), {}).value();
    linear = reduce(*system, perturbation).value();
    pairs = unrefined_pairs(linear).value().pairs;
  }
  // Largest |y_iᴴ x_j| of two, against |y_iᴴ x_i|, of the equal ones.
  double mixing() const {
    double most = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        if (i != j)
          most = std::max(
              most, std::abs(pairs.left.col(i).dot(pairs.right.col(j)) / pairs.left.col(i).dot(pairs.right.col(i))));
      }
    }
    return most;
  }
  double residual() const {
    double most = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const std::complex<double> value = pairs.values[static_cast<std::size_t>(i)];
      most = std::max(most, (linear.A * pairs.right.col(i) - value * pairs.right.col(i)).norm());
      most = std::max(most, (linear.A.adjoint() * pairs.left.col(i) - std::conj(value) * pairs.left.col(i)).norm());
    }
    return most;
  }
};

TEST(equal_values, get_vectors_that_are_dual) {
  Discs discs("");
  ASSERT_EQ(discs.pairs.right.cols(), 3);
  // The equal ones, 2j, all but parallel, and their duals all but orthogonal to them.
  std::vector<Eigen::Index> equal;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (std::abs(discs.pairs.values[static_cast<std::size_t>(i)] - std::complex<double>(0, 2)) < 1e-9)
      equal.push_back(i);
  }
  ASSERT_EQ(equal.size(), 2u);
  Eigen::Matrix2cd mix;
  mix << 1.0, 1.0, 0.0, 1e-9;
  const ComplexMatrix right = discs.pairs.right(Eigen::all, equal) * mix;
  const ComplexMatrix left = discs.pairs.left(Eigen::all, equal) * mix.inverse().adjoint();
  discs.pairs.right(Eigen::all, equal) = right.colwise().normalized();
  discs.pairs.left(Eigen::all, equal) = left.colwise().normalized();
  EXPECT_LT(std::abs(discs.pairs.left.col(equal[0]).dot(discs.pairs.right.col(equal[0]))), 1e-8);
  separate_equal_values(*discs.perturbation.equations, discs.pairs);
  EXPECT_LT(discs.mixing(), 1e-12);
  EXPECT_LT(discs.residual(), 1e-12);
  for (Eigen::Index i = 0; i < 3; ++i) EXPECT_GT(std::abs(discs.pairs.left.col(i).dot(discs.pairs.right.col(i))), 0.1);
}

// A torque on one disc by the angle of the other: the equal values have one vector.
TEST(equal_values, of_a_chain_stay_as_they_are) {
  Discs discs("SFORCE/1, ROTATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=0.5*AZ(30,1)\n");
  const EigenPairs before = discs.pairs;
  separate_equal_values(*discs.perturbation.equations, discs.pairs);
  EXPECT_EQ(discs.pairs.right, before.right);
  EXPECT_EQ(discs.pairs.left, before.left);
}

}  // namespace
}  // namespace dynalin::equal_values_test
