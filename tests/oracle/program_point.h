// A point and the states of the program as the oracle takes them.
#pragma once

#include <algorithm>
#include <map>

#include "linear/linear_system.h"
#include "oracle/oracle.h"
#include "oracle/plane_beams.h"

namespace dynalin::oracle {

inline bool is_beam(const ElementLabel& label) { return label.statement == "FE_PART"; }

// Slopes of nodes, then middles of elements where it has any, one less than nodes: visit(which, place among coordinates
// outside poses, column).
template <class Visit>
void for_each_triple_of_beams(const Layout& layout, Visit&& visit) {
  for (const ExtraBlock& block : layout.extras) {
    if (!is_beam(block.label)) continue;
    const int id = 100 * static_cast<int>(block.label.id);
    const auto nodes =
        static_cast<int>(std::count_if(layout.bodies.begin(), layout.bodies.end(), [&](const BodyBlock& body) {
          return is_beam(body.label) && body.label.id == block.label.id;
        }));
    for (int k = 0; k < block.count / 3; ++k) {
      const BodyRef ref =
          k < nodes ? BodyRef{BodyKind::beam_slope, id + k} : BodyRef{BodyKind::beam_middle, id + k - nodes};
      visit(ref, layout.extra_index(block.offset) + static_cast<std::size_t>(3 * k),
            static_cast<std::size_t>(block.offset + 3 * k));
    }
  }
}

inline bool is_flexible(const ElementLabel& label) { return label.statement == "FLEX_BODY"; }

inline OraclePoint point_of(const System& system, const OperatingPoint& op) {
  OraclePoint point;
  point.time = op.time;
  const Layout& layout = system.layout();
  std::map<int, int> nodes_seen;
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    BodyPoint body;
    body.body_id = static_cast<int>(block.label.id);
    body.body_kind = block.kind == ::dynalin::BodyKind::point_mass ? BodyKind::point_mass : BodyKind::part;
    if (is_beam(block.label)) {
      body.body_kind = BodyKind::beam_node;
      body.body_id = 100 * body.body_id + nodes_seen[body.body_id]++;
    }
    if (is_flexible(block.label)) body.body_kind = BodyKind::flexible_frame;
    for (std::size_t k = 0; k < 3; ++k) {
      body.position[k] = op.poses[b].r[k];
      for (std::size_t c = 0; c < 3; ++c) body.rotation[k][c] = op.poses[b].R(k, c);
      body.velocity[k] = op.velocity[static_cast<std::size_t>(block.offset) + k];
      if (block.count == 6) body.angular_velocity[k] = op.velocity[static_cast<std::size_t>(block.offset) + 3 + k];
    }
    point.bodies.push_back(body);
  }
  for_each_triple_of_beams(layout, [&](const BodyRef& ref, std::size_t extra, std::size_t column) {
    BodyPoint triple;
    triple.body_kind = ref.kind, triple.body_id = ref.id;
    for (std::size_t k = 0; k < 3; ++k) {
      triple.position[k] = op.extra[extra + k], triple.velocity[k] = op.velocity[column + k];
      triple.rotation[k][k] = 1;
    }
    point.bodies.push_back(triple);
  });
  for (const ExtraBlock& block : layout.extras) {
    if (!is_flexible(block.label)) continue;
    BodyPoint modes;
    modes.body_kind = BodyKind::flexible_modes, modes.body_id = static_cast<int>(block.label.id);
    for (std::size_t k = 0; k < 3; ++k) {
      modes.position[k] = op.extra[layout.extra_index(block.offset) + k];
      modes.velocity[k] = op.velocity[static_cast<std::size_t>(block.offset) + k];
      modes.rotation[k][k] = 1;
    }
    point.bodies.push_back(modes);
  }
  for (std::size_t k = 0; k < layout.states.size(); ++k) {
    const DifferentialState& z = layout.states[k];
    if (z.course_of_motion) continue;  // a constant of the instant
    point.z.push_back({static_cast<ElementClass>(z.type), static_cast<int>(z.owner->id), z.coordinate, op.state[k]});
  }
  return point;
}

// Puts the beams into the shapes that were drawn, which no statement states, and gives all bodies the velocities drawn.
inline void put_beams(const Mechanism& mechanism, const System& system, OperatingPoint& op) {
  if (mechanism.beams.empty()) return;
  const OraclePoint drawn = drawn_point(mechanism);
  const auto at = [&](const BodyRef& ref) {
    return *std::find_if(drawn.bodies.begin(), drawn.bodies.end(), [&](const BodyPoint& b) {
      return BodyRef{b.body_kind, b.body_id} == ref;
    });
  };
  const Layout& layout = system.layout();
  op.memory = layout.memory;  // turns count from here: where the dataset starts is another point
  const OraclePoint before = point_of(system, op);
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyPoint to = at({before.bodies[b - 1].body_kind, before.bodies[b - 1].body_id});
    const auto column = static_cast<std::size_t>(layout.bodies[b].offset);
    for (std::size_t k = 0; k < 3; ++k) {
      op.velocity[column + k] = to.velocity[k];
      if (turns(to.body_kind)) op.velocity[column + 3 + k] = to.angular_velocity[k];
      if (!of_beam(to.body_kind)) continue;
      op.poses[b].r[k] = to.position[k];
      for (std::size_t c = 0; c < 3; ++c) op.poses[b].R(k, c) = to.rotation[k][c];
    }
  }
  for_each_triple_of_beams(layout, [&](const BodyRef& ref, std::size_t extra, std::size_t column) {
    const BodyPoint to = at(ref);
    for (std::size_t k = 0; k < 3; ++k) op.extra[extra + k] = to.position[k], op.velocity[column + k] = to.velocity[k];
  });
}

// Of the states of a plane beam: places and slopes of its nodes along the axes of the plane.
inline ChosenState chosen_of_plane(const StateLabel& label, const Beam& beam) {
  const int nodes = static_cast<int>(beam.nodes()), c = label.coordinate - 1 - (label.is_rate ? 4 * nodes : 0);
  const PlaneAxes axes = axes_of(beam.plane);
  const auto k = static_cast<std::size_t>(c / 4);
  const BodyRef ref = c % 4 < 2 ? beam.node(k) : beam.slope(k);
  ChosenState s;
  s.kind = label.is_rate ? ChosenState::Kind::rate : ChosenState::Kind::coordinate;
  s.body_id = ref.id, s.body_kind = ref.kind;
  s.coordinate = c % 2 == 0 ? axes.a : axes.b;
  return s;
}

inline ChosenState chosen(const StateLabel& label, const Mechanism& mechanism) {
  ChosenState s;
  if (label.type == StateType::part || label.type == StateType::point_mass) {
    const bool point = label.type == StateType::point_mass;
    s.kind = label.is_rate ? ChosenState::Kind::rate : ChosenState::Kind::coordinate;
    s.body_id = static_cast<int>(label.element);
    s.body_kind = point ? BodyKind::point_mass : BodyKind::part;
    s.coordinate = label.coordinate - 1 - (label.is_rate ? (point ? 3 : 6) : 0);
  } else if (label.type == StateType::flex_body) {
    s.kind = label.is_rate ? ChosenState::Kind::rate : ChosenState::Kind::coordinate;
    s.body_id = static_cast<int>(label.element);
    const bool modal = label.coordinate > 1000000;
    s.body_kind = modal ? BodyKind::flexible_modes : BodyKind::flexible_frame;
    s.coordinate = modal ? label.coordinate % 1000000 - 1 : label.coordinate - 1 - (label.is_rate ? 6 : 0);
  } else if (label.type == StateType::fe_part) {
    const Beam& beam = *std::find_if(mechanism.beams.begin(), mechanism.beams.end(),
                                     [&](const Beam& b) { return b.id == static_cast<int>(label.element); });
    if (beam.is_plane()) return chosen_of_plane(label, beam);
    const int nodes = static_cast<int>(beam.nodes());
    const int c = label.coordinate - 1 - (label.is_rate ? 12 * nodes - 3 : 0), beyond = c - 9 * nodes;
    s.kind = label.is_rate ? ChosenState::Kind::rate : ChosenState::Kind::coordinate;
    const BodyRef ref = beyond >= 0  ? beam.middle(static_cast<std::size_t>(beyond / 3))
                        : c % 9 >= 6 ? beam.slope(static_cast<std::size_t>(c / 9))
                                     : beam.node(static_cast<std::size_t>(c / 9));
    s.body_id = ref.id, s.body_kind = ref.kind;
    s.coordinate = beyond >= 0 ? beyond % 3 : c % 9 >= 6 ? c % 9 - 6 : c % 9;
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
