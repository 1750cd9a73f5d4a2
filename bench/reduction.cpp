// Craig–Bampton of a cube of n x n x n bricks with three corners and their opposite as interface:
// reduction N [MODES]
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "reduction/craig_bampton.h"
#include "reduction/inertia_invariants.h"
#include "reduction/test_models.h"

namespace {

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main(int count, char** words) {
  using namespace dynalin::reduction;
  const int n = count > 1 ? std::atoi(words[1]) : 31;
  const int modes = count > 2 ? std::atoi(words[2]) : 20;
  test::Block block;
  block.elements = {n, n, n}, block.size = {0.31, 0.31, 0.31};
  const FiniteElementModel model = test::bricks(block);
  ReductionRequest request;
  request.interface = {block.node(0, 0, 0), block.node(n, 0, 0), block.node(0, n, 0), block.node(n, n, n)};
  request.modes = modes, request.rotations_required = false;
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
