// nx × ny × nz point masses in space, tied to their neighbours and to walls: six states a mass, modes in closed form.
#pragma once

#include <fmt/format.h>

#include <string>

inline std::string mass_lattice(int nx, int ny, int nz) {
  std::string masses = "lattice\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n", ties;
  const int count[] = {nx, ny, nz};
  const auto at = [&](const int* p) { return 2 + (p[0] * ny + p[1]) * nz + p[2]; };
  int tie = 0, wall = 1 + nx * ny * nz;
  for (int k = 0; k < nx * ny * nz; ++k) {
    const int place[] = {k / (ny * nz), k / nz % ny, k % nz};
    const int own = at(place);
    masses += fmt::format("POINT_MASS/{0}, MASS=1, QG={1},{2},{3}\nMARKER/{0}, POINT_MASS={0}\n", own, place[0],
                          place[1], place[2]);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        int next[] = {place[0], place[1], place[2]};
        next[axis] += step;
        const bool inside = next[axis] >= 0 && next[axis] < count[axis];
        if (inside && step < 0) continue;  // tied from there
        const int other = inside ? at(next) : ++wall;
        if (!inside) ties += fmt::format("MARKER/{}, PART=1, QP={},{},{}\n", other, next[0], next[1], next[2]);
        ties += fmt::format("BUSHING/{}, I={}, J={}, K=1E4,1E4,1E4\n", ++tie, own, other);
      }
    }
  }
  return masses + ties + "END\n";
}
