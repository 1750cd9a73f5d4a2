// Modes beside zeros in long chains: what the zeros would be amplified into is not handed out as a shape.
#include <gmock/gmock.h>

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

}  // namespace
}  // namespace dynalin::cases::chained_zeros_shapes_test
