// The parts of a facet that are in a torus: what is bounded by parts of its sides and by arcs of the curve in which its
// plane cuts the torus. Where the arcs go from a side to the next one is found along the curve's loops, on which sides
// enter and leave the torus by turns.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/facet_arrangement.h"
#include "geometry/spiric_arc.h"

namespace dynalin {

// One part that hangs together, to the left of what bounds it, as seen from outside of what is full.
struct TorusSection {
  // A part of a side of the facet.
  struct Edge {
    std::uint64_t key;  // the same as seen from the facet across
    std::size_t side;
    Vector from, to;
  };
  // A line on the torus from where a side leaves that to where one enters it, or a closed one.
  struct Chain {
    bool closed = false;
    std::uint64_t begin = 0, end = 0;  // where sides cross the torus: the same as seen from the facets across
    Vector from, to;
    std::vector<SpiricPiece> arcs;  // none where roundings have left none
  };
  FacetBody::Index triangle;
  Vector normal;
  std::vector<Edge> edges;
  std::vector<Chain> chains;
};

struct TorusSections {
  std::vector<TorusSection> list;
  bool consistent = true;  // false: roundings leave open which place of the curve comes behind which
};
// None of a facet that is beside the torus. The surface stands in the axes of the torus.
TorusSections sections_of(const TorusSolid&, const PlacedSurface&, FacetBody::Index triangle);

}  // namespace dynalin
