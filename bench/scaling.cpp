// How time and memory grow with the model: reading, initial conditions, assembly, elimination and choice of states, for
// chains and for a lattice of loops with redundant joints.
//
//     scaling chain 100000      a chain of revolute joints with a spring at each
//     scaling tangled 100000    the same chain with its parts numbered at random
//     scaling lattice 10000     a bar of 3 × 3 × n/9 bodies, hinged to all neighbours
#include <fmt/format.h>

#include <cstring>
#include <ctime>
#include <numeric>
#include <random>

#include "analysis/initial.h"
#include "elements/catalogue.h"
#include "hinged_lattice.h"
#include "peak_memory.h"
#include "states/state_choice.h"
#include "system/system.h"

namespace {

using namespace dynalin;

// Of this process: other work on the machine does not count.
class Clock {
 public:
  double lap() {
    const double now = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    const double taken = now - last_;
    last_ = now;
    return taken;
  }

 private:
  double last_ = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
};

std::string chain(int n, bool tangled) {
  std::vector<int> id(static_cast<std::size_t>(n) + 1);
  std::iota(id.begin(), id.end(), 1);
  if (tangled) std::shuffle(id.begin() + 1, id.end(), std::mt19937(1));
  std::string text = "chain\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\n";
  for (int k = 1; k <= n; ++k) {
    const int p = id[static_cast<std::size_t>(k)], m = 4 * p;
    const int before = k == 1 ? 1 : 4 * id[static_cast<std::size_t>(k) - 1] + 2;
    text += fmt::format(
        "PART/{}, MASS=1, CM={}, IP=0.1,0.1,0.1, QG=0,{},0\nMARKER/{}, QP=0,-0.5,0\nMARKER/{}\nMARKER/{}, QP=0,-1,0\n",
        p, m, 1 - k, m, m + 1, m + 2);
    text +=
        fmt::format("JOINT/{0}, REVOLUTE, I={1}, J={2}\nSPRINGDAMPER/{0}, ROTATIONAL, I={1}, J={2}, KT=10, CT=0.1\n", k,
                    m + 1, before);
  }
  return text + "END\n";
}

std::string lattice(int n) {
  constexpr int side = 3;
  return hinged_lattice(side, side, std::max(1, n / (side * side)));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return fmt::print("usage: scaling chain|tangled|lattice BODIES\n"), 3;
  const int n = std::atoi(argv[2]);
  const std::string kind = argv[1];
  const std::string text = kind == "lattice" ? lattice(n) : chain(n, kind == "tangled");
  fmt::print("{} of {} bodies, {:.1f} MB of text\n", kind, n, static_cast<double>(text.size()) / 1e6);

  Clock clock;
  auto parsed = parse_dataset(std::make_shared<const SourceText>("bench.adm", text));
  fmt::print("  statements        {:8.3f} s\n", clock.lap());
  auto built = build_model(std::make_shared<const Dataset>(std::move(parsed.value)), catalogue());
  if (parsed.diagnostics.has_errors() || built.diagnostics.has_errors()) {
    fmt::print("{}{}", render(parsed.diagnostics, 5), render(built.diagnostics, 5));
    return 1;
  }
  fmt::print("  model             {:8.3f} s\n", clock.lap());
  const auto made = System::make(std::move(built.value)).value();
  const System& system = *made;
  fmt::print("  system            {:8.3f} s   {:.0f} MB\n", clock.lap(), peak_megabytes());

  Findings findings;
  auto op = assemble_position(system, system.drawn(), findings);
  if (op) op = initial_velocity(system, std::move(*op), findings);
  if (!op) return fmt::print("failed: {}\n", op.error().message), 2;
  fmt::print("  position, velocity{:8.3f} s   {:.0f} MB\n", clock.lap(), peak_megabytes());
  op = solve_acceleration(system, std::move(*op), findings);
  if (!op) return fmt::print("failed: {}\n", op.error().message), 2;
  fmt::print("  acceleration      {:8.3f} s   {:.0f} MB\n", clock.lap(), peak_megabytes());

  ConstraintRows rows;
  rows.resize(system.layout());
  Equations eq;
  eq.resize(system.layout());
  const Motion motion = system.motion(*op);
  const auto all = {PartialBy::position, PartialBy::velocity,  PartialBy::damping, PartialBy::acceleration,
                    PartialBy::lambda,   PartialBy::algebraic, PartialBy::state,   PartialBy::state_rate};
  system.constraints(motion, rows);
  system.equations(motion, rows, eq, all);
  clock.lap();
  system.constraints(motion, rows);
  fmt::print("  constraint rows   {:8.3f} s\n", clock.lap());
  system.equations(motion, rows, eq, all);
  fmt::print("  all partials      {:8.3f} s\n", clock.lap());
  const Partition p = system.partition(rows, RowLevel::position);
  fmt::print("  elimination       {:8.3f} s   {} rows, {} redundant, {} freedoms\n", clock.lap(), rows.size(),
             p.redundant.size(), p.independent.size());
  const auto candidates = state_candidates(system, motion, {});
  fmt::print("  candidates        {:8.3f} s\n", clock.lap());
  const auto choice = choose_states(system, motion, rows, {});
  fmt::print("  choice of states  {:8.3f} s   {} states\n", clock.lap(), choice ? choice->size() : 0);
  fmt::print("  peak memory       {:8.0f} MB\n", peak_megabytes());
}
