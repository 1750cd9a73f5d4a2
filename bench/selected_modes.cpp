// Processor time of each step from the dataset to the lowest modes without a state matrix, and the memory it has taken.
//
//     selected_modes chain 2000 10            n links on hinges, so many modes
//     selected_modes lattice 10 12 14 20      point masses in space, tied to their neighbours and to walls
//     selected_modes chain 2000 0             no modes: up to the perturbation equations
#include "linear/selected_modes.h"

#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <string>

#include "elements/catalogue.h"
#include "hanging_chain.h"
#include "mass_lattice.h"
#include "peak_memory.h"

namespace {

using namespace dynalin;

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "";
  const bool chain = kind == "chain" && argc == 4;
  if (!chain && !(kind == "lattice" && argc == 6)) {
    fmt::print("usage: selected_modes chain NUMBER MODES\n       selected_modes lattice NX NY NZ MODES\n");
    return 3;
  }
  const auto number = [&](int k) { return std::atoi(argv[k]); };
  std::clock_t last = std::clock();
  const auto report = [&](const char* what) {
    const std::clock_t now = std::clock();
    fmt::print("{:<26} {:8.3f} s  {:6.0f} MB\n", what, static_cast<double>(now - last) / CLOCKS_PER_SEC,
               peak_megabytes());
    last = now;
  };
  const std::string text = chain ? hanging_chain(number(2)) : mass_lattice(number(2), number(3), number(4));
  report("text");
  auto dataset = parse_dataset(std::make_shared<const SourceText>("bench.adm", text));
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  const auto system = System::make(std::move(model.value)).value();
  report("system");
  Findings findings;
  const auto point = initial_conditions(*system, findings);
  if (!point) {
    fmt::print("{}\n", point.error().message);
    return 2;
  }
  report("initial conditions");
  const auto perturbation = perturb(*system, *point, {});
  if (!perturbation) {
    fmt::print("{}\n", perturbation.error().message);
    return 2;
  }
  report("perturbation equations");
  if (number(chain ? 3 : 5) == 0) return 0;
  const auto modes = static_cast<std::size_t>(number(chain ? 3 : 5));
  const auto solution = eigensolve_selected(*system, *perturbation, NearestModes{modes, 0});
  if (!solution) {
    fmt::print("{}\n", solution.error().message);
    return 2;
  }
  report("selected modes");
  for (const EigenMode& m : solution->modes)
    fmt::print("{:.15g} {:+.15g}i Hz, bound {:.1e}\n", m.eigenvalue_hz.real(), m.eigenvalue_hz.imag(),
               m.error_bound_hz);
  fmt::print("complete: {}, {} of {}{} in a disc of {:.6g} Hz\n", solution->selected->complete,
             solution->selected->found, solution->selected->counted,
             solution->selected->by == CountedBy::inertia ? " by inertia" : "", solution->selected->radius_hz);
  return 0;
}
