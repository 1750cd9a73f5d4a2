// Cost of the full eigensolution against LAPACK alone on the same matrix, with the refinement timed apart.
//
//     eigen_cost 100 300 600     links of a hanging chain, two states each
#include <fmt/format.h>
#include <lapacke.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>

#include "elements/catalogue.h"
#include "hanging_chain.h"
#include "linear/dense_products.h"
#include "linear/eigen.h"
#include "linear/eigen_refinement.h"
#include "linear/zero_modes.h"

namespace {

using namespace dynalin;

// The best of several runs; what a run uses up is made anew before each.
template <class Prepare, class Function>
double seconds(Prepare&& prepare, Function&& work) {
  double best = std::numeric_limits<double>::infinity(), total = 0;
  for (int run = 0; run < 20 && (run < 3 || total < 1.0); ++run) {
    auto prepared = prepare();
    const auto start = std::chrono::steady_clock::now();
    work(prepared);
    const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = std::min(best, taken), total += taken;
  }
  return best;
}

void measure(int n) {
  auto dataset = parse_dataset(std::make_shared<const SourceText>("chain.adm", hanging_chain(n)));
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  const System system{std::shared_ptr<const Model>(std::move(model.value))};
  Findings findings;
  const auto op = initial_conditions(system, findings);
  if (!op) return fmt::print("{}\n", op.error().message);
  const auto linear = linearize(system, *op, {});
  if (!linear) return fmt::print("{}\n", linear.error().message);
  const auto size = static_cast<lapack_int>(linear->model.A.rows());
  Eigen::MatrixXd left(size, size), right(size, size);
  Eigen::VectorXd re(size), im(size), scale(size), of_values(size), of_vectors(size);
  lapack_int low = 0, high = 0;
  double norm = 0;
  const auto solve = [&](Eigen::MatrixXd A) {
    LAPACKE_dgeevx(LAPACK_COL_MAJOR, 'B', 'V', 'V', 'N', size, A.data(), size, re.data(), im.data(), left.data(), size,
                   right.data(), size, &low, &high, scale.data(), &norm, of_values.data(), of_vectors.data());
  };
  const double lapack = seconds([] { return 0; }, [&](int) { solve(linear->model.A); });
  ZeroModes zero;
  const double splitting =
      seconds([] { return 0; }, [&](int) { zero = split_zero_modes(linear->model.A, linear->rounding); });
  // What eigensolve refines are the pairs of the balanced matrix; this model has no zero modes.
  solve(zero.block);
  right = zero.scale.asDiagonal() * right;
  left = zero.scale.cwiseInverse().asDiagonal() * left;
  EigenPairs pairs;
  pairs.right.resize(size, size), pairs.left.resize(size, size);
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < size; ++k) {
    if (im(k) < 0) continue;
    pairs.values.emplace_back(re(k), im(k));
    pairs.right.col(count).real() = right.col(k), pairs.left.col(count).real() = left.col(k);
    pairs.right.col(count).imag().setZero(), pairs.left.col(count).imag().setZero();
    if (im(k) > 0) pairs.right.col(count).imag() = right.col(k + 1), pairs.left.col(count).imag() = left.col(k + 1);
    ++count;
  }
  pairs.right.conservativeResize(size, count), pairs.left.conservativeResize(size, count);
  pairs.right.colwise().normalize(), pairs.left.colwise().normalize();
  const double refining = seconds([&] { return pairs; }, [&](EigenPairs& p) { refine(*linear->equations, zero, p); });
  // Backward errors; all else that eigensolve adds is a pass over the vectors.
  const double errors = seconds([] { return 0; }, [&](int) { real_product(linear->model.A, pairs.right); });
  const double whole = seconds([] { return 0; }, [&](int) { (void)eigensolve(*linear); });
  fmt::print(
      "{:5} states: eigensolve {:.3f} s; zeros {:.3f} s ({}), dgeevx {:.3f} s, backward errors {:.3f} s, "
      "refinement {:.3f} s; without refinement {:.2f} of dgeevx by the parts, {:.2f} by the difference\n",
      size, whole, splitting, zero.count, lapack, errors, refining, (splitting + lapack + errors) / lapack,
      (whole - refining) / lapack);
}

}  // namespace

int main(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) measure(std::atoi(argv[k]));
}
