// Time of each step from the dataset to all eigenvalues with their vectors, and the memory it has taken.
//
//     eigensolution chain 500             n links on hinges
//     eigensolution vehicle 200           n parts in a row, two bushings between neighbours
//     eigensolution rotor 100             a shaft of n BEAMs with discs, turning in two bearings
//     eigensolution rotor 1000 statics    no state matrix: it is dense
#include <dynalin/dynalin.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <numbers>
#include <string>

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

// A steel shaft 2 long and 0.1 thick at 100 rad/s, ten discs on it; bearings at both ends, one of which holds it along,
// and a soft drive that holds its angle.
std::string rotor(int n) {
  const double length = 2, d = 0.1, rho = 7810, E = 211e9, G = 81.2e9, spin = 100, pi = std::numbers::pi;
  const double A = pi * d * d / 4, I = A * d * d / 16, h = length / n;
  std::string s = "rotor\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\n";
  for (int k = 0; k <= n; ++k) {
    const double half = (k == 0 || k == n ? 0.5 : 1) * h, disc = k % std::max(1, n / 10) == n / 20 ? 20 : 0;
    s += fmt::format(
        "PART/{0}, MASS={1:.17g}, CM={0}, IP={2:.17g},{3:.17g},{3:.17g}, QG={4:.17g},0,0, VX=0, VY=0, VZ=0, WX={5}, "
        "WY=0, WZ=0\nMARKER/{0}\n",
        k + 2, rho * A * half + disc, 2 * rho * I * half + 0.02 * disc, rho * half * (A * h * h / 12 + I) + 0.01 * disc,
        h * k, spin);
    if (k == 0 || k == n) {
      s += fmt::format(
          "MARKER/{0}, PART=1, QP={1:.17g},0,0, REULER=90D,90D,0\nMARKER/{2}, PART={3}, REULER=90D,90D,0\n"
          "BUSHING/{0}, I={2}, J={0}, K=1E8,1E8,{4}, C=1E4,1E4,0, KT=0,0,{4}\n",
          n + 10 + (k > 0), h * k, n + 20 + (k > 0), k + 2, k == 0 ? "1E6" : "0");
    }
    if (k > 0) {
      s += fmt::format(
          "BEAM/{0}, I={1}, J={2}, LENGTH={3:.17g}, AREA={4:.17g}, IXX={5:.17g}, IYY={6:.17g}, IZZ={6:.17g}, "
          "EMODULUS={7:.17g}, GMODULUS={8:.17g}, ASY=1.13, ASZ=1.13\n",
          k, k + 2, k + 1, h, A, 2 * I, I, E, G);
    }
  }
  return s + "END\n";
}

}  // namespace

int main(int argc, char** argv) {
  const bool statics_only = argc == 4 && std::string(argv[3]) == "statics";
  const std::string kind = argc > 1 ? argv[1] : "";
  if ((argc != 3 && !statics_only) || (kind != "chain" && kind != "vehicle" && kind != "rotor")) {
    fmt::print("usage: eigensolution chain|vehicle|rotor NUMBER [statics]\n");
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
  const dynalin::Study study(dynalin::Model::from_text(kind == "chain"     ? hanging_chain(n)
                                                       : kind == "vehicle" ? vehicle(n)
                                                                           : rotor(n)));
  report("reading");
  auto point = study.initial_conditions();
  report("initial conditions");
  point = study.static_equilibrium(point);
  const int iterations = point.static_result().iterations;
  report(fmt::format("statics, {} iterations", iterations));
  if (statics_only) return 0;
  const auto matrices = study.linearize(point).state_space();
  report("state matrix");
  const auto solution = study.linearize(point).modes();
  report("state matrix and modes");
  fmt::print("{} states, first mode at {:.12g}\n", matrices.states.size(),
             std::abs(solution.modes.front().eigenvalue_hz));
}
