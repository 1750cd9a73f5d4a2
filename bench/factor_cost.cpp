// What the factors of S − σ E take: entries, operations, memory and processor time, for models that grow. Started by
// mpirun (DYNALIN_DISTRIBUTED) all processes take part.
//
//     factor_cost chain 10000         links on hinges
//     factor_cost lattice 10 10 10    point masses in space, tied to their neighbours and to walls
//     factor_cost hinged 5 5 5        bodies in space, hinged to their neighbours: half of the rows are redundant
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>

#include "base/arbitrary_vector.h"
#include "distributed/mumps_call.h"
#include "distributed/team.h"
#include "elements/catalogue.h"
#include "hanging_chain.h"
#include "hinged_lattice.h"
#include "linear/linear_system.h"
#include "mass_lattice.h"
#include "peak_memory.h"
#include "perturbation/perturbation.h"
#include "system/shifted_lu.h"

namespace {

using namespace dynalin;

class Clock {
 public:
  // Processor time of this process and time on the wall, since the last lap.
  std::string lap() {
    const auto cpu = std::clock();
    const auto wall = std::chrono::steady_clock::now();
    const double seconds = static_cast<double>(cpu - cpu_) / CLOCKS_PER_SEC;
    const std::string text =
        fmt::format("{:.3g} s ({:.3g} s on the wall)", seconds, std::chrono::duration<double>(wall - wall_).count());
    cpu_ = cpu, wall_ = wall;
    return text;
  }

 private:
  std::clock_t cpu_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

int measure(const std::string& text) {
  auto dataset = parse_dataset(std::make_shared<const SourceText>("bench.adm", text));
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  const auto system = System::make(std::move(model.value)).value();
  Findings findings;
  Clock clock;
  const auto point = initial_conditions(*system, findings);
  if (!point) return fmt::print("{}\n", point.error().message), 2;
  fmt::print("initial conditions    {}, up to here {:.0f} MB\n", clock.lap(), peak_megabytes());
  const auto perturbation = perturb(*system, *point, {});
  if (!perturbation) return fmt::print("{}\n", perturbation.error().message), 2;
  const PerturbationEquations& equations = *perturbation->equations;
  fmt::print("perturbation          {}, up to here {:.0f} MB\n", clock.lap(), peak_megabytes());
  const ColumnMatrix& m = equations.products();
  fmt::print("unknowns {}, states {}, entries {}\n", m.columns, equations.states(), m.value.size());
  const FactorCost before = last_mumps_factors();
  ShiftedLu lu(m, equations.states());
  fmt::print("KLU's analysis        {}, {:.4g} entries of its factors\n", clock.lap(), lu.predicted_entries());
  if (!lu.factor({1.3, 2.1})) return fmt::print("singular\n"), 2;
  fmt::print("analysis and factors  {}, up to here {:.0f} MB\n", clock.lap(), peak_megabytes());
  if (!lu.factor({1.4, 2.2})) return fmt::print("singular\n"), 2;
  fmt::print("factors once more     {}\n", clock.lap());
  const FactorCost cost = last_mumps_factors();
  if (cost.unknowns != before.unknowns || cost.entries != before.entries) {
    fmt::print("MUMPS: {:.4g} entries, {:.4g} of them here; {:.4g} operations; {:.0f} MB, largest process {:.0f} MB\n",
               cost.entries, cost.entries_here, cost.operations, cost.megabytes, cost.megabytes_of_largest_process);
  }
  Eigen::VectorXcd b = arbitrary_vector(m.columns, 1);
  clock.lap();
  for (int k = 0; k < 10; ++k) lu.solve(b), b.normalize();
  fmt::print("ten solutions         {}\n", clock.lap());
  return 0;
}

int run(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "";
  const auto number = [&](int k) { return std::atoi(argv[k]); };
  if (kind == "chain" && argc == 3) return measure(hanging_chain(number(2)));
  if (kind == "lattice" && argc == 5) return measure(mass_lattice(number(2), number(3), number(4)));
  if (kind == "hinged" && argc == 5) return measure(hinged_lattice(number(2), number(3), number(4)));
  fmt::print("usage: factor_cost chain N | lattice NX NY NZ | hinged NX NY NZ\n");
  return 3;
}

}  // namespace

int main(int argc, char** argv) {
  Team team;
  if (!team.leads()) return team.serve();
  return team.end(run(argc, argv));
}
