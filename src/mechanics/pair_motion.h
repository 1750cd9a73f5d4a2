// The motion of marker I as seen from marker J, and the room in which elements keep that of several pairs while they
// are evaluated.
#pragma once

#include <array>
#include <vector>

#include "mechanics/motion.h"
#include "mechanics/path.h"

namespace dynalin {

struct PairMotion {
  BodyId body_I, body_J;
  Mat3<Taylor> axes_J;             // global
  RelativeFrame<Taylor> relative;  // I seen from J
  Vec3<Taylor> arm_I, arm_J;       // from the BCS of the body to its marker, global axes
  Vec3<Taylor> arm;                // from the BCS of J's body to the origin of I
  Vec3<Taylor> delta;              // from J to I
  Vector w_J;                      // angular velocity of J
  // Of markers on bodies that change their shape, and what these move by; the motion outlives the pair.
  const NodeShapes *shapes_I = nullptr, *shapes_J = nullptr;
  const Motion* motion = nullptr;
};

using Array6 = std::array<double, 6>;
using Array66 = std::array<Array6, 6>;  // [row][column]

// The displacement y = (DX, DY, DZ, AX, AY, AZ)(I,J) in the axes of J, its gradient by the relative pose, and the rate
// y′ (velocity seen from J, relative angular velocity) with its gradients by pose and rate of pose.
struct RelativeDisplacement {
  Array6 y{}, rate{};
  Array66 on_pose{}, rate_on_pose{}, rate_on_rate{};
};

struct PairScratch {
  std::vector<PairMotion> pairs;
  std::vector<RelativeDisplacement> displacements;
};

}  // namespace dynalin
