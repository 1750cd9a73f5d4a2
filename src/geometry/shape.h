// What a statement draws on a body.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh.h"
#include "mechanics/handles.h"
#include "mechanics/motion.h"

namespace dynalin {

struct Shape {
  enum class Origin : std::uint8_t { statement, file, spring_damper };

  ElementLabel label;  // of the statement, which lives as long as the model
  Origin origin = Origin::statement;
  BodyId body = ground_body;
  Mesh mesh;  // in the BCS of the body [length]
  // Of lines that go from body to body: the body of each vertex, in the BCS of which it stands. Empty where all
  // vertices are on `body`; faces never go from body to body.
  std::vector<BodyId> vertex_bodies;

  BodyId body_of(Mesh::Index v) const { return vertex_bodies.empty() ? body : vertex_bodies[v]; }
  // A vertex in global axes, the bodies at these poses (by BodyId).
  Vector global(Mesh::Index v, std::span<const Pose> poses) const {
    const Pose& pose = poses[static_cast<std::size_t>(body_of(v).index)];
    return pose.r + pose.R * mesh.vertices[v];
  }
};

}  // namespace dynalin
