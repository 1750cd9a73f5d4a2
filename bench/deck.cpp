// What an open box costs: parts in a row, every second pair of them hinged, each with a preloaded bushing and a spring
// to the ground and a cylinder to look at; at rest, as drawn.
//
//     deck 1000           time of each step, size of the files, largest memory
//     deck 1000 FOLDER    and the files there, for `dynalin nastran check FOLDER/deck.dat`
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "elements/catalogue.h"
#include "nastran/export.h"
#include "peak_memory.h"

namespace {

using namespace dynalin;

std::string dataset(int parts) {
  std::string text = "row\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n";
  const auto out = std::back_inserter(text);
  for (int k = 2; k < parts + 2; ++k) {
    const int m = 10 * k, x = k - 2;
    fmt::format_to(out, "PART/{0}, MASS={1}, CM={2}, IP=0.1,0.2,0.3, QG={3},0,0\nMARKER/{2}\n", k, 1 + 0.1 * (k % 7), m,
                   x);
    fmt::format_to(out, "MARKER/{}, QP=-0.5,0,0\nMARKER/{}, QP=0.5,0,0\n", m + 1, m + 2);
    fmt::format_to(out, "MARKER/{}, PART=1, QP={},0,-1\nMARKER/{}, PART=1, QP={},0,0\n", m + 3, x, m + 4, x);
    if (k % 2 == 0 && k > 2) fmt::format_to(out, "JOINT/{}, REVOLUTE, I={}, J={}\n", k, m + 1, m - 8);
    fmt::format_to(out,
                   "BUSHING/{0}, I={1}, J={2}, K=1000,1100,1200, C=1,2,3, KT=10,20,30, CT=0.1,0.2,0.3, FORCE=0,0,40\n"
                   "SPRINGDAMPER/{0}, TRANSLATIONAL, I={1}, J={3}, K=400, C=2, LENGTH=0.9\n"
                   "GRAPHICS/{0}, CYLINDER, CM={4}, LENGTH=0.5, RADIUS=0.1\n",
                   k, m, m + 4, m + 3, m + 1);
  }
  return text + "END\n";
}

double seconds(std::clock_t since) { return static_cast<double>(std::clock() - since) / CLOCKS_PER_SEC; }

template <class T>
auto value(T&& result) {
  if (!result) fmt::print("{}\n", result.error().message), std::exit(1);
  return std::move(*result);
}

}  // namespace

int main(int argc, char** argv) {
  const int parts = argc > 1 ? std::atoi(argv[1]) : 1000;
  const auto report = [](const char* what, std::clock_t since) {
    fmt::print("{:24}{:8.3f} s  {:8.0f} MB\n", what, seconds(since), peak_megabytes());
  };
  std::clock_t begun = std::clock();
  auto read = parse_dataset(std::make_shared<const SourceText>("row.adm", dataset(parts)));
  auto model = build_model(std::make_shared<const Dataset>(std::move(read.value)), catalogue());
  const auto system = System::make(std::move(model.value)).value();
  report("dataset and model", begun);
  begun = std::clock();
  const FoundPoint point = value(initial_conditions(as_drawn(system)));
  report("initial conditions", begun);
  begun = std::clock();
  const Linearization linear = value(linearized(point.point, {}, Stateless::taken, Reduction::none));
  report("perturbation equations", begun);
  begun = std::clock();
  const std::string file = (std::filesystem::path(argc > 2 ? argv[2] : ".") / "deck").string();
  const auto deck = value(nastran::export_deck(linear, nastran::Box::open, {}, file));
  report("deck", begun);
  for (const auto& remark : deck.remarks.items()) fmt::print("{}\n", remark.message);
  std::size_t size = 0;
  for (const auto& f : deck.files) {
    size += f.text.size();
    if (argc > 2) std::ofstream(f.name, std::ios::binary) << f.text;
  }
  fmt::print("{} files, {:.1f} MB\n", deck.files.size(), static_cast<double>(size) / 1e6);
}
