// Flexible bodies with shapes that hardly have mass: their frequencies are far above all others, and what couples them
// with the slow ones at a bent point must not hide those.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <sstream>

#include "cases/run.h"
#include "reduction/reduce_program.h"
#include "reduction/test_models.h"

namespace dynalin::cases::light_shapes_test {
namespace {

std::string matrix_market(const reduction::SparseMatrix& m) {
  std::string entries;
  int count = 0;
  for (Eigen::Index c = 0; c < m.outerSize(); ++c) {
    for (reduction::SparseMatrix::InnerIterator e(m, c); e; ++e) {
      if (e.row() < e.col() || e.value() == 0) continue;
      entries += fmt::format("{} {} {:.17g}\n", e.row() + 1, e.col() + 1, e.value());
      ++count;
    }
  }
  return fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{0} {0} {1}\n{2}", m.rows(), count, entries);
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

class LightShapes : public Cases {
 protected:
  // A steel strip of 50 x 0.5 x 0.5 mm with its mass in seven nodes, without inertia of their own, as `dynalin reduce`
  // makes a body of it.
  void write_strip() const {
    constexpr double side = 5e-4, length = 0.05, I = side * side * side * side / 12;
    constexpr int elements = 6;
    const reduction::FiniteElementModel model = reduction::test::beam(
        elements, length, {2.1e11 * side * side, 8.1e10 * 1.69 * I, 2.1e11 * I, 2.1e11 * I, 7800 * side * side, 0});
    reduction::test::Triplets mass;
    std::string nodes, freedoms;
    for (int node = 0; node <= elements; ++node) {
      const double m = 7800 * side * side * length / elements * (node == 0 || node == elements ? 0.5 : 1);
      for (int d = 0; d < 3; ++d) mass.emplace_back(6 * node + d, 6 * node + d, m);
      nodes += fmt::format("{} {:.17g} 0 0\n", node + 1, length / elements * node);
      for (int d = 1; d <= 6; ++d) freedoms += fmt::format("{} {}\n", node + 1, d);
    }
    write("K.mtx", matrix_market(model.stiffness));
    write("M.mtx", matrix_market(reduction::test::matrix_of(model.stiffness.rows(), mass)));
    write("freedoms.txt", freedoms);
    write("nodes.txt", nodes);
    const auto in_folder = [&](const char* name) { return (folder_ / name).string(); };
    reduction::ReduceOptions options;
    options.stiffness = in_folder("K.mtx"), options.mass = in_folder("M.mtx");
    options.freedoms = in_folder("freedoms.txt"), options.nodes = in_folder("nodes.txt");
    options.output = in_folder("strip.fem");
    options.interface = {"1", "7"}, options.modes = 10;
    std::ostringstream out, err;
    ASSERT_EQ(reduction::reduce(options, out, err), 0) << err.str();
  }
};

TEST_F(LightShapes, leave_the_slow_modes_of_a_bent_strip_known) {
  write_strip();
  const auto slow = [&](double force) {
    const RunResult r = run(bent_by(force), "SIMULATE/STATICS\nLINEAR/EIGENSOL\nSTOP\n");
    EXPECT_EQ(r.status, 0) << r.err;
    if (force != 0) {
      EXPECT_THAT(r.message, ::testing::Not(::testing::HasSubstr("not told apart")));
    }
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
