// A steel shaft 2 long and 0.1 thick at 100 rad/s, of n BEAMs: ten discs on it; bearings at both ends, one of which
// holds it along, and a soft drive that holds its angle. Twelve states a part.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>

inline std::string beam_rotor(int n) {
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
