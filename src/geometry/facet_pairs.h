// Which facets of two bodies may meet, and how far both surfaces are apart.
#pragma once

#include <utility>
#include <vector>

#include "geometry/facet_body.h"
#include "mechanics/path.h"

namespace dynalin {

// Triangles of I and of J whose boxes overlap: all that meet, and some that do not.
std::vector<std::pair<FacetBody::Index, FacetBody::Index>> near_pairs(const FacetBody& I,
                                                                      const RelativeFrame<double>& I_from_J,
                                                                      const FacetBody& J);
// Between surfaces that do not cross. [length]
double least_distance(const FacetBody& I, const RelativeFrame<double>& I_from_J, const FacetBody& J);

}  // namespace dynalin
