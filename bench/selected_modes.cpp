// Processor time of each step from the dataset to selected modes without a state matrix, and the memory it has taken.
//
//     selected_modes chain 2000 10            n links on hinges, the lowest modes
//     selected_modes damped 2000 10           the same with springs and dampers in the hinges, which are those of peers
//     selected_modes lattice 10 12 14 20      point masses in space, tied to their neighbours and to walls
//     selected_modes hinged 9 9 9 1           bodies in space, hinged to their neighbours
//     selected_modes rotor 1000 10 200        a turning shaft of n BEAMs in damped bearings, the modes of 10 to 200 Hz
//     selected_modes chain 2000 0             no modes: up to the perturbation equations
//     selected_modes chain 2000 write         the dataset alone, for the program itself
#include "selected_modes/selected_modes.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "analysis/statics.h"
#include "base/program_heap.h"
#include "beam_rotor.h"
#include "elements/catalogue.h"
#include "hanging_chain.h"
#include "hinged_lattice.h"
#include "mass_lattice.h"
#include "peak_memory.h"

namespace {

using namespace dynalin;

struct Problem {
  std::string text;
  ModeSelection wanted;
  bool statics = false, modes = true;
};

Problem problem(const std::string& kind, const std::vector<double>& v) {
  const auto n = [&](std::size_t k) { return static_cast<int>(v[k]); };
  const auto nearest = [&](std::size_t k, std::string text) {
    return Problem{std::move(text), NearestModes{static_cast<std::size_t>(v[k]), 0}, false, v[k] > 0};
  };
  if (kind == "chain" && v.size() == 2) return nearest(1, hanging_chain(n(0)));
  if (kind == "damped" && v.size() == 2) return nearest(1, damped_chain(n(0)));
  if (kind == "lattice" && v.size() == 4) return nearest(3, mass_lattice(n(0), n(1), n(2)));
  if (kind == "hinged" && v.size() == 4) return nearest(3, hinged_lattice(n(0), n(1), n(2)));
  if (kind == "rotor" && v.size() == 3) return {beam_rotor(n(0)), ModesInBand{v[1], v[2]}, true};
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  prepare_heap();
  const std::string kind = argc > 1 ? argv[1] : "", last_word = argc > 1 ? argv[argc - 1] : "";
  std::vector<double> numbers;
  for (int k = 2; k < argc; ++k) numbers.push_back(std::atof(argv[k]));
  std::clock_t last = std::clock();
  const auto report = [&](const char* what) {
    const std::clock_t now = std::clock();
    fmt::print("{:<26} {:8.3f} s  {:6.0f} MB\n", what, static_cast<double>(now - last) / CLOCKS_PER_SEC,
               peak_megabytes());
    std::fflush(stdout);
    last = now;
  };
  const auto [text, wanted, statics, modes] = problem(kind, numbers);
  if (text.empty()) {
    fmt::print(
        "usage: selected_modes chain|damped NUMBER MODES\n       selected_modes lattice|hinged NX NY NZ MODES\n"
        "       selected_modes rotor NUMBER LOW HIGH\n");
    return 3;
  }
  if (last_word == "write") return fmt::print("{}", text), 0;
  report("text");
  auto dataset = parse_dataset(std::make_shared<const SourceText>("bench.adm", text));
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  const auto system = System::make(std::move(model.value)).value();
  report("system");
  Findings findings;
  auto point = initial_conditions(*system, findings);
  if (!point) {
    fmt::print("{}\n", point.error().message);
    return 2;
  }
  report("initial conditions");
  if (statics) {
    StaticsReport ignored;
    point = static_operating_point(*system, std::move(*point), {}, ignored, findings);
    if (!point) {
      fmt::print("{}\n", point.error().message);
      return 2;
    }
    report("statics");
  }
  const auto perturbation = perturb(*system, *point, {});
  if (!perturbation) {
    fmt::print("{}\n", perturbation.error().message);
    return 2;
  }
  report("perturbation equations");
  if (!modes) return 0;
  const auto solution = eigensolve_selected(*system, *perturbation, wanted);
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
