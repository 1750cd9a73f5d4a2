// Eigenvalues that are equal although nothing is defective: each has a vector of its own, whichever way it is found.
#include <Eigen/SVD>
#include <random>

#include "cases/dataset_text.h"

namespace dynalin::cases::equal_values_test {
namespace {

using Complex = std::complex<double>;

class EqualValues : public Cases {
 protected:
  RunResult solve(const Eigen::MatrixXd& A, const std::string& arguments, std::int64_t dense_up_to) const {
    std::string text = fmt::format(
        "Values\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMATRIX/1, FULL=RORDER, ROWS={0}, COLUMNS={0}, VALUES=", A.rows());
    for (Eigen::Index r = 0; r < A.rows(); ++r) {
      for (Eigen::Index c = 0; c < A.cols(); ++c)
        text += fmt::format("{}{}", c > 0 ? "," : r > 0 ? "\n," : "", A(r, c));
    }
    SessionOptions options;
    options.dense_up_to = dense_up_to;
    return run(text + "\nARRAY/1, X\nLSE/1, X=1, A=1\nEND\n", "LINEAR/EIGENSOL" + arguments + "\n", options);
  }
  // How many directions the vectors of all modes near a value have.
  static Eigen::Index directions(const RunResult& r, double value) {
    std::vector<std::vector<Complex>> vectors;
    for (const auto& mode : r.result(0).at("modes")) {
      const Complex at(mode.at("real_hz"), mode.at("imag_hz"));
      if (std::abs(at * 2.0 * std::numbers::pi - value) > 1e-6) continue;
      auto& v = vectors.emplace_back();
      for (const auto& entry : mode.at("vector")) v.emplace_back(entry[0], entry[1]);
    }
    if (vectors.empty()) return 0;
    Eigen::MatrixXcd all(static_cast<Eigen::Index>(vectors[0].size()), static_cast<Eigen::Index>(vectors.size()));
    for (std::size_t k = 0; k < vectors.size(); ++k)
      all.col(static_cast<Eigen::Index>(k)) =
          Eigen::Map<const Eigen::VectorXcd>(vectors[k].data(), all.rows()).normalized();
    return (Eigen::JacobiSVD<Eigen::MatrixXcd>(all).singularValues().array() > 1e-3).count();
  }
};

TEST_F(EqualValues, have_as_many_directions_as_there_are) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> entry(-3, 3);
  for (int draw = 0; draw < 12; ++draw) {
    // S diag(−2, −2, −2, −5, −1) S⁻¹, all of integers.
    const Eigen::Index n = 5;
    Eigen::MatrixXd lower = Eigen::MatrixXd::Identity(n, n), upper = lower;
    for (Eigen::Index r = 0; r < n; ++r) {
      for (Eigen::Index c = 0; c < r; ++c) lower(r, c) = entry(random), upper(c, r) = entry(random);
    }
    const Eigen::VectorXd values{{-2, -2, -2, -5, -1}};
    const Eigen::MatrixXd S = lower * upper;
    const Eigen::MatrixXd inverse =
        (upper.triangularView<Eigen::UnitUpper>().solve(
             lower.triangularView<Eigen::UnitLower>().solve(Eigen::MatrixXd::Identity(n, n))))
            .array()
            .round();
    ASSERT_EQ(S * inverse, Eigen::MatrixXd::Identity(n, n));
    const RunResult r = solve(S * values.asDiagonal() * inverse, "", 400);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(directions(r, -2), 3) << draw;
    EXPECT_EQ(directions(r, -5), 1) << draw;
    EXPECT_EQ(directions(r, -1), 1) << draw;
  }
}

TEST_F(EqualValues, zeros_of_a_matrix_of_rank_one_have_all_of_its_null_space) {
  const Eigen::VectorXd b{{-3, 0, 1, 2, -2, 2, 1, 3}};
  const Eigen::MatrixXd A = -b * b.transpose();
  for (const std::int64_t dense_up_to : {400, 2}) {
    for (const char* arguments : {"", ", BAND=0,1", ", NMODES=1", ", NMODES=2", ", NMODES=3"}) {
      const RunResult r = solve(A, arguments, dense_up_to);
      ASSERT_EQ(r.status, 0) << arguments << dense_up_to << r.err;
      EXPECT_EQ(directions(r, 0), 7) << arguments << " " << dense_up_to;
    }
  }
}

}  // namespace
}  // namespace dynalin::cases::equal_values_test
