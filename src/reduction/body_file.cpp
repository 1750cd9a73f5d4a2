#include "reduction/body_file.h"

namespace dynalin::reduction {

BodyFile in_other_units(BodyFile body, const UnitFactors& factor) {
  const double first = factor.mass * factor.length, second = first * factor.length;
  body.places *= factor.length;
  // Translations are the same number of the new unit, and rotations are in radians for it.
  for (Eigen::Index node = 0; node < static_cast<Eigen::Index>(body.labels.size()); ++node)
    body.shapes.middleRows(6 * node + 3, 3) /= factor.length;
  body.mass *= factor.mass;
  body.stiffness *= factor.force / factor.length;
  body.total_mass *= factor.mass;
  body.centre *= factor.length;
  body.inertia *= second;
  body.i3 *= factor.mass;
  body.i4 *= first;
  body.i8 *= first;
  body.i5 *= factor.mass;
  body.i9 *= factor.mass;
  return body;
}

}  // namespace dynalin::reduction
