// What holds the nodes of a beam of a plane: each stays in the plane, turns about the normal n alone, and turns there
// as its slope s does. With the directions of the node m, along n as drawn, and t, along n × x of the node as drawn,
//
//     n·r = const,     a·m = 0,   b·m = 0,     n·s = 0,     s·t = 0
//
// (a and b in the plane) leave r and s in the plane, four coordinates a node.
#pragma once

#include "elements/families/beam_place.h"
#include "mechanics/kernel.h"

namespace dynalin {

class PlaneBeamRows {
 public:
  // Adds the rows of all nodes to the layout, and says that rotations follow slopes. The beam has a plane.
  PlaneBeamRows(const BeamBody&, const Model&, Layout&);
  void constraints(const Motion&, ConstraintRows&) const;
  // Adds how the reactions change with the coordinates.
  void equations(const Motion&, Equations&) const;

 private:
  static constexpr std::array<std::string_view, 5> row_names = {"out of plane", "tilt along the first axis",
                                                                "tilt along the second axis", "slope out of plane",
                                                                "direction of the slope"};
  struct Node {
    BodyId body;
    std::int32_t first_row, offset, slope;  // coordinates of the pose and of the slope
    std::size_t extra;                      // of the slope, among coordinates outside poses
    double height;                          // n·r
    Vector m, t;                            // axes of the node
  };
  BeamPlane plane_;
  std::vector<Node> nodes_;
};

}  // namespace dynalin
