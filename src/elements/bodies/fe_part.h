// What others ask of FE_PART statements. Each node is a body of the model with the label of its FE_PART: the first has
// the place that the statement has among bodies, the others stand behind those of all statements. Mass and inertia of
// these Bodies are what each node stands for, a scale for those who compare; the beam itself has the inertia and tells
// it to others (elements/families/nodal_body.h).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "flexible/plane_beam.h"
#include "model/model.h"

namespace dynalin {

using BeamElements = std::vector<std::shared_ptr<const BeamElement>>;

// Where the coordinates of an element are among all, in the order of flexible/beam_element.h; −1 for those it has not.
using BeamColumns = std::array<std::int32_t, beam_coordinates>;

struct BeamBody {
  const ElementLabel* label = nullptr;
  std::vector<BodyId> nodes;
  std::vector<std::int64_t> numbers;       // of the nodes, as written
  const BeamElements* elements = nullptr;  // between neighbours
  std::optional<BeamPlane> plane;          // of a plane one
  Pose drawn;                              // BCS
  StatedVelocity velocity;                 // of the BCS, the whole moving as if rigid
  std::size_t first_extra = 0;             // among coordinates outside poses: slopes of all nodes, then middles

  std::size_t slope(std::size_t node) const { return first_extra + 3 * node; }
  std::size_t middle(std::size_t element) const { return first_extra + 3 * (nodes.size() + element); }
  std::size_t extra_count() const { return 3 * (nodes.size() + (plane ? 0 : elements->size())); }
  BeamColumns columns(const Layout&, std::size_t element) const;
  BeamMotion motion(const Motion&, std::size_t element) const;
};

// The rows of an element out of those of all coordinates; zero where it has none.
template <class Derived>
auto rows_of(const BeamColumns& columns, const Eigen::MatrixBase<Derived>& all) {
  using Rows = Eigen::Matrix<typename Derived::Scalar, beam_coordinates, Derived::ColsAtCompileTime>;
  Rows rows = Rows::Zero(static_cast<Eigen::Index>(beam_coordinates), all.cols());
  for (std::size_t k = 0; k < beam_coordinates; ++k) {
    if (columns[k] >= 0) rows.row(static_cast<Eigen::Index>(k)) = all.row(columns[k]);
  }
  return rows;
}

// All of the model, without the places of their coordinates outside poses.
std::vector<BeamBody> beam_bodies(const Model&);
// The same with them, when the layout has all coordinates.
std::vector<BeamBody> beam_bodies(const Model&, const Layout&);
}  // namespace dynalin
