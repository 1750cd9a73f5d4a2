// A point and the states of the program as the oracle takes them.
#pragma once

#include "linear/linear_system.h"
#include "oracle/oracle.h"

namespace dynalin::oracle {

inline OraclePoint point_of(const System& system, const OperatingPoint& op) {
  OraclePoint point;
  point.time = op.time;
  const Layout& layout = system.layout();
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    BodyPoint body;
    body.body_id = static_cast<int>(block.label.id);
    body.is_point_mass = block.kind == ::dynalin::BodyKind::point_mass;
    for (std::size_t k = 0; k < 3; ++k) {
      body.position[k] = op.poses[b].r[k];
      for (std::size_t c = 0; c < 3; ++c) body.rotation[k][c] = op.poses[b].R(k, c);
      body.velocity[k] = op.velocity[static_cast<std::size_t>(block.offset) + k];
      if (block.count == 6) body.angular_velocity[k] = op.velocity[static_cast<std::size_t>(block.offset) + 3 + k];
    }
    point.bodies.push_back(body);
  }
  for (std::size_t k = 0; k < layout.states.size(); ++k) {
    const DifferentialState& z = layout.states[k];
    if (z.course_of_motion) continue;  // a constant of the instant
    point.z.push_back({static_cast<ElementClass>(z.type), static_cast<int>(z.owner->id), z.coordinate, op.state[k]});
  }
  return point;
}

inline ChosenState chosen(const StateLabel& label) {
  ChosenState s;
  if (label.type == StateType::part || label.type == StateType::point_mass) {
    const bool point = label.type == StateType::point_mass;
    s.kind = label.is_rate ? ChosenState::Kind::rate : ChosenState::Kind::coordinate;
    s.body_id = static_cast<int>(label.element);
    s.is_point_mass = point;
    s.coordinate = label.coordinate - 1 - (label.is_rate ? (point ? 3 : 6) : 0);
  } else if (label.type == StateType::pstate || label.type == StateType::pstate_rate) {
    s.kind = label.is_rate ? ChosenState::Kind::rate : ChosenState::Kind::coordinate;
    s.variable = static_cast<int>(label.element);
  } else {
    s.kind = ChosenState::Kind::differential;
    s.element = static_cast<ElementClass>(label.type);
    s.element_id = static_cast<int>(label.element);
    s.index = label.coordinate;
  }
  return s;
}

}  // namespace dynalin::oracle
