// Modes beside zeros in long chains: what the zeros would be amplified into is not handed out as a shape.
#include <gmock/gmock.h>

#include <Eigen/LU>
#include <cmath>

#include "cases/dataset_text.h"

namespace dynalin::cases::chained_zeros_shapes_test {
namespace {

class ChainedZeros : public Cases {};

// A chain of 70 masses, and nowhere near it integrators in a row: they are not moved by it.
TEST_F(ChainedZeros, integrators_beside_a_chain_stand_still_in_its_modes) {
  for (const int integrators : {6, 7, 11}) {
    std::string text = "Chain\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
    for (int k = 2; k < 72; ++k) {
      text += fmt::format(
          "POINT_MASS/{0}, MASS=1, CM={0}\nMARKER/{0}, POINT_MASS={0}\n"
          "BUSHING/{0}, I={0}, J={1}, K=100,110,130, KT=0,0,0, C=0,0,0, CT=0,0,0\n",
          k, k - 1);
    }
    const int n = integrators + 1;
    text += fmt::format("MATRIX/1, FULL=RORDER, ROWS={0}, COLUMNS={0}, VALUES=", n);
    for (int r = 0; r < n; ++r) {
      for (int c = 0; c < n; ++c) text += fmt::format("{}{}", c == 0 ? (r == 0 ? "" : "\n,") : ",", c == r + 1 ? 1 : 0);
    }
    text.back() = '0';
    text.replace(text.size() - 1, 1, "-2");
    const RunResult r = run(text + "\nARRAY/1, X\nLSE/1, X=1, A=1\nEND\n", "LINEAR/EIGENSOL, NMODES=3\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const nlohmann::json& result = r.result(0);
    std::size_t looked_at = 0;
    for (std::size_t m = 0; m < result.at("modes").size(); ++m) {
      const auto& mode = result.at("modes")[m];
      if (mode.at("structural_zero").get<bool>()) continue;
      EXPECT_LE(mode.at("backward_error").get<double>(), 1e-9) << integrators;
      const auto& shape = mode.at("vector");
      const std::size_t states = shape.size();
      double largest = 0;
      for (const auto& entry : shape) largest = std::max(largest, std::abs(entry[0].get<double>()));
      for (std::size_t k = states - static_cast<std::size_t>(n); k < states; ++k)
        EXPECT_LE(std::abs(shape[k][0].get<double>()), 1e-9 * largest) << integrators << " " << k;
      ++looked_at;
    }
    EXPECT_GE(looked_at, 3u);
  }
}

// What chains end with is not all that is null: a combination of links may be, where two chains end alike.
TEST_F(ChainedZeros, vectors_of_zeros_span_all_that_is_null) {
  const char* const diffs =
      "Integrators\nPART/1, GROUND\nDIFF/1, FUNCTION=0\nDIFF/2, FUNCTION=0\nDIFF/3, FUNCTION=DIF(1)+DIF(2)\nEND\n";
  const char* const carts =
      "Carts\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/2, TRANSLATIONAL, I=20, "
      "J=1\nPART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nJOINT/3, TRANSLATIONAL, I=30, J=1\n"
      "DIFF/1, FUNCTION=DZ(20,1)+DZ(30,1)\nEND\n";
  for (const auto& [text, zeros, independent] : {std::tuple(diffs, 3u, 2), std::tuple(carts, 5u, 2)}) {
    const RunResult r = run(text, "LINEAR/EIGENSOL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto& modes = r.result(0).at("modes");
    ASSERT_EQ(modes.size(), zeros);
    Eigen::MatrixXd vectors(zeros, zeros);
    for (Eigen::Index c = 0; c < vectors.cols(); ++c) {
      const auto& mode = modes[static_cast<std::size_t>(c)];
      EXPECT_TRUE(mode.at("structural_zero").get<bool>());
      EXPECT_EQ(mode.at("backward_error").get<double>(), 0);
      for (Eigen::Index k = 0; k < vectors.rows(); ++k)
        vectors(k, c) = mode.at("vector")[static_cast<std::size_t>(k)][0].get<double>();
    }
    EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(vectors).rank(), independent) << vectors;
  }
}

}  // namespace
}  // namespace dynalin::cases::chained_zeros_shapes_test
