// The coordinates that a pair of markers depends on, block by block, and what a force on the pair is by each.
#pragma once

#include <algorithm>

#include "mechanics/node_variations.h"
#include "mechanics/pair.h"

namespace dynalin {

// Up to three coordinates next to each other and how they move a marker, such as one of a pair: δp = moves δq, δφ =
// turns δq, a column each, global axes.
struct PairBlock {
  enum class Kind : std::uint8_t { translation, rotation, modal } kind = Kind::translation;
  bool of_J = false;
  std::int32_t column = 0;
  std::size_t count = 3;
  std::size_t first_shape = 0;  // of modal coordinates
  Matrix3 moves, turns;
  Matrix3 moves_rate, turns_rate;
};

// A force on I by the coordinates of one block and by their rates.
struct BlockPartials {
  Matrix3 force, torque;
  Matrix3 force_by_rate, torque_by_rate;
};
BlockPartials partials_by(const PairBlock&, const PairForce&);

// Modal coordinates of the body of one marker.
template <class Visit>
void for_each_modal_block(const Motion& motion, BodyId body, const NodeShapes* shapes, const Layout& layout,
                          Visit&& visit) {
  if (!shapes) return;
  const NodeVariations variations(motion, body, *shapes);
  const std::size_t count = shapes->translation.size();
  for (std::size_t first = 0; first < count; first += 3) {
    PairBlock b;
    b.kind = PairBlock::Kind::modal;
    b.column = layout.body_coordinate_count + static_cast<std::int32_t>(shapes->first + first);
    b.count = std::min<std::size_t>(3, count - first);
    b.first_shape = first;
    for (std::size_t k = 0; k < b.count; ++k) {
      const NodeVariations::One v = variations.by(first + k);
      b.moves[k] = value(v.moves), b.moves_rate[k] = rate(v.moves);
      b.turns[k] = value(v.turns), b.turns_rate[k] = rate(v.turns);
    }
    visit(b);
  }
}

// All that one marker depends on; `arm` from the BCS of its body.
template <class Visit>
void for_each_block(const Motion& motion, BodyId id, const Vec3<Taylor>& arm, const NodeShapes* shapes,
                    const Layout& layout, Visit&& visit) {
  const BodyBlock& body = layout.body(id);
  PairBlock b;
  if (body.count > 0) {
    b.column = body.offset;
    b.moves = Matrix3::identity();
    visit(b);
  }
  if (body.turns()) {
    b.kind = PairBlock::Kind::rotation;
    b.column = body.offset + 3;
    b.moves = -skew(value(arm)), b.moves_rate = -skew(rate(arm));
    b.turns = Matrix3::identity();
    visit(b);
  }
  for_each_modal_block(motion, id, shapes, layout, visit);
}
template <class Visit>
void for_each_block(const Motion& motion, const MarkerPlace& m, const Layout& layout, Visit&& visit) {
  for_each_block(motion, m.body, motion.arm(m), m.shapes, layout, visit);
}
// visit(const PairBlock&): those of I, then those of J.
template <class Visit>
void for_each_block(const PairMotion& p, const Layout& layout, Visit&& visit) {
  for_each_block(*p.motion, p.body_I, p.arm_I, p.shapes_I, layout, visit);
  for_each_block(*p.motion, p.body_J, p.arm_J, p.shapes_J, layout, [&](PairBlock& b) {
    b.of_J = true;
    visit(b);
    b.of_J = false;
  });
}

// visit(column, count, turns): the coordinates that turn the axes of a marker, on whichever body.
template <class Visit>
void for_each_turning_block(const Motion& motion, const MarkerPlace& marker, const Layout& layout, Visit&& visit) {
  const BodyBlock& body = layout.body(marker.body);
  if (body.turns()) visit(body.offset + 3, std::size_t{3}, Matrix3::identity());
  for_each_modal_block(motion, marker.body, marker.shapes, layout,
                       [&](const PairBlock& b) { visit(b.column, b.count, b.turns); });
}

}  // namespace dynalin
