// Which markers move as one: those of a rigid body, and on a body that deforms those of one node.
#pragma once

#include <algorithm>
#include <vector>

#include "model/model.h"

namespace dynalin {

// On one body as statements name it; the nodes of an FE_PART are bodies of their own.
inline bool on_one_body(const Model& model, MarkerId a, MarkerId b) {
  const ElementLabel &A = model.body(model.marker(a).place.body).label,
                     &B = model.body(model.marker(b).place.body).label;
  return A.statement == B.statement && A.id == B.id;
}

inline constexpr double rounding_of_places = 1e-12;  // of their sizes: nearer ones are one

// Whether neither moves against the other.
inline bool move_as_one(const Model& model, MarkerId a, MarkerId b) {
  const MarkerPlace &A = model.marker(a).place, &B = model.marker(b).place;
  if (A.body != B.body || (A.shapes == nullptr) != (B.shapes == nullptr)) return false;
  if (A.shapes == B.shapes) return true;
  const auto same = [](const std::vector<Vector>& x, const std::vector<Vector>& y) {
    return std::ranges::equal(x, y,
                              [](const Vector& v, const Vector& w) { return v.x == w.x && v.y == w.y && v.z == w.z; });
  };
  const Vector node_A = A.p_BM - A.shapes->offset, node_B = B.p_BM - B.shapes->offset;
  return A.shapes->first == B.shapes->first && same(A.shapes->translation, B.shapes->translation) &&
         same(A.shapes->rotation, B.shapes->rotation) &&
         norm(node_A - node_B) <= rounding_of_places * (norm(A.p_BM) + norm(B.p_BM) + norm(node_A));
}

}  // namespace dynalin
