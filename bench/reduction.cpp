// Craig–Bampton of a cube of n x n x n bricks with three corners and their opposite as interface:
// reduction N [MODES]
// reduction N write      the files of the cube alone, for `dynalin reduce`, and its command without the program
#include <fmt/format.h>
#include <fmt/os.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string_view>

#include "reduction/craig_bampton.h"
#include "reduction/inertia_invariants.h"
#include "reduction/test_models.h"

namespace {

using namespace dynalin::reduction;

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// The lower triangle, as Matrix Market has it.
void write_matrix(const char* name, const SparseMatrix& matrix) {
  const SparseMatrix lower = matrix.triangularView<Eigen::Lower>();
  auto out = fmt::output_file(name);
  out.print("%%MatrixMarket matrix coordinate real symmetric\n{} {} {}\n", lower.rows(), lower.cols(),
            lower.nonZeros());
  for (Eigen::Index column = 0; column < lower.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry)
      out.print("{} {} {:.17g}\n", entry.row() + 1, entry.col() + 1, entry.value());
  }
}

void write_files(const FiniteElementModel& model, const ReductionRequest& request) {
  write_matrix("stiffness.mtx", model.stiffness);
  write_matrix("mass.mtx", model.mass);
  auto freedoms = fmt::output_file("freedoms.txt"), nodes = fmt::output_file("nodes.txt");
  for (const Freedom& f : model.freedoms) freedoms.print("{} {}\n", f.node, f.direction);
  for (const auto& [label, at] : model.nodes)
    nodes.print("{} {:.17g} {:.17g} {:.17g}\n", label, at.x(), at.y(), at.z());
  fmt::print(
      "reduce --stiffness stiffness.mtx --mass mass.mtx --freedoms freedoms.txt --nodes nodes.txt --interface {} "
      "--translations-only --modes {} --output cube.fem\n",
      fmt::join(request.interface, ","), request.modes);
}

}  // namespace

int main(int count, char** words) {
  const int n = count > 1 ? std::atoi(words[1]) : 31;
  const bool writes = count > 2 && words[2] == std::string_view("write");
  const int modes = count > 2 && !writes ? std::atoi(words[2]) : 20;
  test::Block block;
  block.elements = {n, n, n}, block.size = {0.31, 0.31, 0.31};
  const FiniteElementModel model = test::bricks(block);
  ReductionRequest request;
  request.interface = {block.node(0, 0, 0), block.node(n, 0, 0), block.node(0, n, 0), block.node(n, n, n)};
  request.modes = modes, request.rotations_required = false;
  if (writes) return write_files(model, request), 0;
  dynalin::Diagnostics diagnostics;
  const double begin = processor_time();
  const auto reduction = reduce_model(model, request, diagnostics);
  const double reduced = processor_time();
  if (!reduction) {
    std::fprintf(stderr, "%s%s\n", reduction.error().c_str(), render(diagnostics).c_str());
    return 1;
  }
  body_of(model, *reduction, request.interface, InertiaOrder::follows_deformation, "bench");
  std::printf("%zu freedoms, %td modes: reduction %.1f s, invariants %.1f s\n", model.freedoms.size(),
              reduction->shapes.cols(), reduced - begin, processor_time() - reduced);
  return 0;
}
