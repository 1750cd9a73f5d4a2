// What two bodies of facets have in common: each volume that hangs together, with its integrals and how they change as
// one body moves. All of it comes from where edges of the one cross facets of the other: the surface of a volume is the
// part of either surface that is in the other body, and integrals over these parts are sums over the straight pieces
// that bound them.
#pragma once

#include <vector>

#include "geometry/facet_body.h"
#include "mechanics/path.h"

namespace dynalin {

// In the axes of J, from `origin`. As I moves by d + w × x, an integral grows by by_shift d + by_turn w: the surface of
// I sweeps over what is in front of it.
struct Overlap {
  // What of a facet bounds it.
  struct Part {
    FacetBody::Index triangle;
    double area = 0;  // [length²]
    Vector area_by_shift{}, area_by_turn{};
  };

  // The same of J, whose facets do not move.
  struct FixedPart : Part {
    Vector first{};  // ∫ x dS [length³]
    Matrix3 first_by_shift{}, first_by_turn{};
  };

  Vector origin;      // a place of its surface
  double volume = 0;  // [length³]
  Vector moment{};    // ∫ x dV [length⁴]
  Vector volume_by_shift{}, volume_by_turn{};
  Matrix3 moment_by_shift{}, moment_by_turn{};  // row: component of the integral
  std::vector<Vector> corners;                  // all of its surface, some more than once
  std::vector<Part> of_I;
  std::vector<FixedPart> of_J;
  bool whole = true;  // false: there are holes in it, through which the bodies reach
};

struct Overlaps {
  std::vector<Overlap> volumes;
  Vector aside{};         // I stood that far from where it is, next to nothing, so that no edge lies in a facet
  bool engulfed = false;  // a part of one body is wholly in the other
  bool definite = true;   // false: roundings leave open where surfaces cross
};

// `cavity`: J is what is around its facets instead of in them.
Overlaps find_overlaps(const FacetBody& I, const RelativeFrame<double>& I_from_J, const FacetBody& J, bool cavity);

}  // namespace dynalin
