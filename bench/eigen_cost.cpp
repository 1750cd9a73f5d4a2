// Cost of the full eigensolution against LAPACK alone on the same matrix, with the refinement timed apart.
//
//     eigen_cost 100 300 600     links of a hanging chain, two states each
#include <fmt/format.h>
#include <lapacke.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <optional>

#include "base/dense_products.h"
#include "eigenvalues/eigen.h"
#include "eigenvalues/eigen_refinement.h"
#include "elements/catalogue.h"
#include "hanging_chain.h"

namespace {

using namespace dynalin;

// Of this process: other work on the machine does not count.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// The best of several runs; what a run uses up is made anew before each.
template <class Prepare, class Function>
double seconds(Prepare&& prepare, Function&& work) {
  double best = std::numeric_limits<double>::infinity(), total = 0;
  for (int run = 0; run < 20 && (run < 3 || total < 1.0); ++run) {
    auto prepared = prepare();
    const double start = processor_seconds();
    work(prepared);
    const double taken = processor_seconds() - start;
    best = std::min(best, taken), total += taken;
  }
  return best;
}

void measure(int n) {
  auto dataset = parse_dataset(std::make_shared<const SourceText>("chain.adm", hanging_chain(n)));
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  const auto made = System::make(std::move(model.value)).value();
  const System& system = *made;
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
  std::optional<UnrefinedPairs> found;
  const double pairs = seconds([] { return 0; }, [&](int) { found = unrefined_pairs(*linear); });
  if (!found) return fmt::print("the QR iteration did not converge\n");
  const double zeros =
      seconds([] { return 0; },
              [&](int) { (void)split_zero_modes(linear->A, linear->rounding, linear->structural_zeros.get()); });
  const Eigen::MatrixXd exact = Eigen::MatrixXd::Zero(linear->A.rows(), linear->A.cols()), none;
  const StructuredPencil pencil(*linear->pencil, found->zero, exact, none);
  const double refining = seconds([&] { return found->pairs; }, [&](EigenPairs& p) { refine(pencil, found->zero, p); });
  // Backward errors; all else that eigensolve adds is a pass over the vectors.
  const double errors = seconds([] { return 0; }, [&](int) { real_product(linear->model.A, found->pairs.right); });
  const double whole = seconds([] { return 0; }, [&](int) { (void)eigensolve(*linear); });
  fmt::print(
      "{:5} states: dgeevx {:.4f} s; unrefined pairs {:.4f} s, of which zeros ({}) {:.4f} s; backward errors {:.4f} s; "
      "together {:.2f} of dgeevx; refinement {:.3f} s; eigensolve {:.3f} s\n",
      size, lapack, pairs, found->zero.count, zeros, errors, (pairs + errors) / lapack, refining, whole);
}

}  // namespace

int main(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) measure(std::atoi(argv[k]));
}
