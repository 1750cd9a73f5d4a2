// nx × ny × nz bodies in space, hinged to all neighbours: half of the rows are redundant.
#pragma once

#include <fmt/format.h>

#include <string>

inline std::string hinged_lattice(int nx, int ny, int nz) {
  std::string text = "lattice\nUNITS/SYSTEM=MKS\nPART/1, GROUND\n";
  const auto body = [&](int x, int y, int z) { return (z * ny + y) * nx + x + 2; };
  int joint = 0;
  std::string joints;
  text += "MARKER/1\n";
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const int b = body(x, y, z), m = 10 * b;
        text += fmt::format("PART/{}, MASS=1, CM={}, IP=0.1,0.1,0.1, QG={},{},{}\nMARKER/{}\n", b, m, x, y, z, m);
        // Hinges halfway to the six neighbours; axes along the next direction in turn.
        static constexpr const char* places[] = {"0.5,0,0", "-0.5,0,0", "0,0.5,0", "0,-0.5,0", "0,0,0.5", "0,0,-0.5"};
        static constexpr const char* axes[] = {"0,0,0", "0,0,0", "90D,90D,0", "90D,90D,0", "0,90D,0", "0,90D,0"};
        for (int k = 0; k < 6; ++k) text += fmt::format("MARKER/{}, QP={}, REULER={}\n", m + 1 + k, places[k], axes[k]);
        const auto hinge = [&](int other, int k) {
          joints += fmt::format("JOINT/{}, REVOLUTE, I={}, J={}\n", ++joint, m + 1 + k, 10 * other + 2 + k);
        };
        if (x + 1 < nx) hinge(body(x + 1, y, z), 0);
        if (y + 1 < ny) hinge(body(x, y + 1, z), 2);
        if (z + 1 < nz) hinge(body(x, y, z + 1), 4);
      }
    }
  }
  joints += fmt::format("MARKER/2, PART=1, QP=0,0,-0.5, REULER=0,90D,0\nJOINT/{}, REVOLUTE, I={}, J=2\n", ++joint,
                        10 * body(0, 0, 0) + 6);
  return text + joints + "END\n";
}
