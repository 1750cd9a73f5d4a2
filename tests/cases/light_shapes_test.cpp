// Flexible bodies with shapes that hardly have mass: their frequencies are far above all others, and what couples them
// with the slow ones at a bent point must not hide those.
#include <dynalin/study.h>
#include <gmock/gmock.h>

#include "cases/flexible.h"
#include "cases/run.h"
#include "reduction/craig_bampton.h"
#include "reduction/test_models.h"

namespace dynalin::cases::light_shapes_test {
namespace {

// A steel strip of 50 x 0.5 x 0.5 mm with its mass in seven nodes, without inertia of their own.
std::string strip() {
  constexpr double side = 5e-4, length = 0.05, I = side * side * side * side / 12;
  constexpr int elements = 6;
  reduction::FiniteElementModel model = reduction::test::beam(
      elements, length, {2.1e11 * side * side, 8.1e10 * 1.69 * I, 2.1e11 * I, 2.1e11 * I, 7800 * side * side, 0});
  reduction::test::Triplets mass;
  std::vector<double> of_node;
  for (int node = 0; node <= elements; ++node) {
    of_node.push_back(7800 * side * side * length / elements * (node == 0 || node == elements ? 0.5 : 1));
    for (int d = 0; d < 3; ++d) mass.emplace_back(6 * node + d, 6 * node + d, of_node.back());
  }
  model.mass = reduction::test::matrix_of(model.stiffness.rows(), mass);
  Diagnostics diagnostics;
  const auto reduced = reduction::reduce_model(model, {.interface = {1, elements + 1}, .modes = 10}, diagnostics);
  if (!reduced) return {};
  std::vector<FlexibleNode> nodes;
  for (int node = 0; node <= elements; ++node) {
    FlexibleNode n{node + 1, {length / elements * node, 0, 0}, of_node[static_cast<std::size_t>(node)], {}, {}, {}};
    for (Eigen::Index k = 0; k < reduced->shapes.cols(); ++k) {
      const auto part = reduced->shapes.col(k).segment<6>(6 * node);
      n.moves.push_back({part(0), part(1), part(2)});
      n.turns.push_back({part(3), part(4), part(5)});
    }
    nodes.push_back(std::move(n));
  }
  return modal_text(nodes, reduced->squares.asDiagonal().toDenseMatrix());
}

std::string bent_by(double force) {
  return fmt::format(
      "Strip\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/5, FLOATING\nFLEX_BODY/2, MNF_FILE=strip.fem, "
      "CRATIO=0\n"
      "MARKER/21, NODE_ID=1\nMARKER/22, NODE_ID=7\nJOINT/1, FIXED, I=21, J=1\n"
      "VFORCE/1, I=22, JFLOAT=5, RM=1, FX=0\\FY={}\\FZ=0\nEND\n",
      force);
}

}  // namespace

class LightShapes : public Cases {};

TEST_F(LightShapes, leave_the_slow_modes_of_a_bent_strip_known) {
  write("strip.fem", strip());
  const auto slow = [&](double force) {
    const RunResult r = run(bent_by(force), "SIMULATE/STATICS\nLINEAR/EIGENSOL\nSTOP\n");
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.message, ::testing::HasSubstr("Stability: nothing grows"));
    EXPECT_THAT(r.message, ::testing::Not(::testing::HasSubstr("not told apart")));
    std::vector<double> list;
    for (const auto& e : r.eigenvalues(r.result(1).contains("eigenvalues") ? 1 : 0)) {
      if (e.imag() > 0) list.push_back(e.imag());
    }
    std::ranges::sort(list);
    return list;
  };
  const std::vector<double> straight = slow(0), bent = slow(0.05);
  ASSERT_EQ(bent.size(), 16u);
  ASSERT_EQ(straight.size(), 16u);
  for (std::size_t k = 0; k < 13; ++k) EXPECT_NEAR(bent[k], straight[k], 1e-3 * straight[k]) << k;
  EXPECT_NEAR(bent[0], 165.59, 0.02);
}

}  // namespace dynalin::cases::light_shapes_test
