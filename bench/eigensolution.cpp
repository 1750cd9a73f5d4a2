// Time of each step from the dataset to all eigenvalues with their vectors, and the memory it has taken.
//
//     eigensolution chain 500             n links on hinges
//     eigensolution vehicle 200           n parts in a row, two bushings between neighbours
//     eigensolution rotor 100             a shaft of n BEAMs with discs, turning in two bearings
//     eigensolution rotor 1000 statics    no state matrix: it is dense
//     eigensolution vehicle 200 write     the dataset alone, for the program itself
#include <dynalin/dynalin.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <string>

#include "base/program_heap.h"
#include "beam_rotor.h"
#include "hanging_chain.h"
#include "peak_memory.h"

namespace {

std::string vehicle(int n) {
  std::string s = "vehicle\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,0.5,0\n";
  for (int k = 1; k <= n; ++k) {
    s += fmt::format(
        "PART/{0}, MASS=2, CM={0}0, IP=0.2,0.3,0.4, QG={1:.17g},0,{2:.17g}, REULER={3:.17g},0.2,0\nMARKER/{0}0\n"
        "MARKER/{0}1, QP=-0.1,0,0\nMARKER/{0}2, QP=-0.1,0.5,0\nMARKER/{0}3, QP=0.1,0,0\nMARKER/{0}4, QP=0.1,0.5,0\n",
        k + 1, 0.2 * k, 0.01 * k, 0.03 * k);
    for (int side = 0; side < 2; ++side) {
      const std::string j = k == 1 ? std::to_string(side + 1) : fmt::format("{}{}", k, side + 3);
      s += fmt::format("BUSHING/{}{}, I={}{}, J={}, K=1E5,2E5,3E5, KT=1E3,2E3,3E3, C=10,20,30, CT=1,2,3\n", k, side,
                       k + 1, side + 1, j);
    }
  }
  return s + "END\n";
}

}  // namespace

int main(int argc, char** argv) {
  dynalin::prepare_heap();
  const std::string word = argc == 4 ? argv[3] : "";
  const bool statics_only = word == "statics", write = word == "write";
  const std::string kind = argc > 1 ? argv[1] : "";
  if ((argc != 3 && !statics_only && !write) || (kind != "chain" && kind != "vehicle" && kind != "rotor")) {
    fmt::print("usage: eigensolution chain|vehicle|rotor NUMBER [statics|write]\n");
    return 3;
  }
  const int n = std::atoi(argv[2]);
  auto last = std::chrono::steady_clock::now();
  const auto report = [&](const std::string& what) {
    const auto now = std::chrono::steady_clock::now();
    fmt::print("{:<26} {:8.3f} s  {:6.0f} MB\n", what, std::chrono::duration<double>(now - last).count(),
               peak_megabytes());
    last = now;
  };
  const std::string text = kind == "chain" ? hanging_chain(n) : kind == "vehicle" ? vehicle(n) : beam_rotor(n);
  if (write) return fmt::print("{}", text), 0;
  const dynalin::Study study(dynalin::Model::from_text(text));
  report("reading");
  auto point = study.initial_conditions();
  report("initial conditions");
  point = study.static_equilibrium(point);
  report("statics");
  // Which is found when it is asked for.
  const auto found = point.static_result();
  report("stability");
  fmt::print("{} iterations, {}\n", found.iterations, found.stability.text());
  if (statics_only) return 0;
  const auto matrices = study.linearize(point).state_space();
  report("state matrix");
  const auto solution = study.linearize(point).modes();
  report("state matrix and modes");
  fmt::print("{} states, first mode at {:.12g}\n", matrices.states.size(),
             std::abs(solution.modes.front().eigenvalue_hz));
}
