// What the partials of a pair's wrench are made of: the sizes that their rounding is measured against. A ball that
// turns under its own force has partials that cancel as a whole, stiffness times distance against the turn of the
// force, and what is left of them is rounding of those.
#pragma once

#include <algorithm>
#include <cmath>

#include "mechanics/pair.h"
#include "mechanics/pair_blocks.h"

namespace dynalin {

// Component by component, without their signs.
inline Vector sizes(const Vector& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }
inline Matrix3 sizes(const Matrix3& m) { return {sizes(m.x), sizes(m.y), sizes(m.z)}; }
inline double largest(const Vector& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
inline double largest(const Matrix3& m) { return std::max({largest(m.x), largest(m.y), largest(m.z)}); }

// Of partials_by(): of the force and torque on I by the coordinates of a block and by their rates. Axes of J that are
// not along those of the ground turn the entries of a law into each other: the largest is the size of all.
BlockPartials sizes_by(const PairMotion&, const PairBlock&, const PairForce&);

}  // namespace dynalin
