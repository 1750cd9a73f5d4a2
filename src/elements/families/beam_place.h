// A beam of finite elements as the model has it: its nodes, its elements, and where their coordinates are.
#pragma once

#include <array>
#include <memory>
#include <optional>
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
  std::vector<Vector> places;              // of the nodes in the BCS, undeformed
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

// Where their coordinates outside poses are, when the layout has them.
void find_coordinates(std::vector<BeamBody>&, const Layout&);

}  // namespace dynalin
