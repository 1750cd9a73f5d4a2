// The graphics file (.gra): where every part is at each time, in the layout of files of others:
//
//      A.G8    2026-11-23 02:13:00  M_KGS_N_RACA 1.000000000000000E+00       units, lengths a metre
//     title (80)
//          2    2    0    0    0    0    0    0    0                          parts with the ground, markers, no
//          graphics
//               1         1                                                   id of a part, kind: 2 for a point mass
//               1         1  0.00000E+00  0.00000E+00  0.00000E+00       0    id of a marker, its part, where on it, 0
//        0.00000E+00  0.00000E+00  0.00000E+00                                its 3-1-3 angles
//       -9.99999E+05                                                          before the first time: poses as drawn
//        0.00000E+00  …                                                       x, y, z, ψ, θ, φ of each part that can
//        move 0.00000E+00                                                          time, and the same again
//
// Markers are the fixed ones. Angles are in radians. Graphics are in the dataset and not repeated here.
#pragma once

#include <ctime>
#include <iosfwd>
#include <vector>

#include "dynalin/operating_state.h"
#include "model/model.h"

namespace dynalin {

class GraphicsFile {
 public:
  GraphicsFile(std::ostream&, const Model&, std::time_t);
  void add(double time, const std::vector<BodyState>&);

 private:
  std::ostream& out_;
};

}  // namespace dynalin
