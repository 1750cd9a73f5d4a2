#include "nastran/export_point.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "perturbation/perturbed_point.h"

namespace dynalin::nastran {

StudyResult<Linearization> linearization_for(const Linearization& of, const ExportOptions& options) {
  if (of.request.without_damping == !options.use_damping) return of;
  LinearRequest request;
  request.without_damping = !options.use_damping;
  LinearOptions otherwise;
  otherwise.without_damping = request.without_damping;
  const bool reduced = of.linear.A.rows() == static_cast<Eigen::Index>(of.linear.model.states.size());
  auto again =
      reduced ? linearize(*of.system, of.point, otherwise) : linearize_unreduced(*of.system, of.point, otherwise);
  if (!again) return tl::unexpected(StudyFailure(again.error()));
  return Linearization{of.system, of.point, of.at_rest_as_found, request, std::move(*again)};
}

bool moves(const Linearization& of) {
  // A static solution leaves some of its loads, and where there are none something of what its stiffness could hold.
  constexpr double unmoving = 1e-12, balance = 1e-7, unloaded = 1e-10;
  for (std::size_t k = 0; k < of.point.velocity.size(); ++k) {
    if (std::abs(of.point.velocity[k]) > unmoving * of.system->coordinate_scale(static_cast<std::int32_t>(k)))
      return true;
  }
  // What accelerations take of the forces on each body.
  const PerturbedPoint& at = *of.linear.at;
  std::vector<double> inertia(static_cast<std::size_t>(at.equations.size()));
  at.equations.matrix(PartialBy::acceleration).multiply_add(of.point.acceleration, inertia);
  std::vector<double> held(inertia.size());
  const ColumnMatrix& stiffness = at.equations.matrix(PartialBy::position);
  for (std::int32_t c = 0; c < stiffness.columns; ++c) {
    for_each_in_column(stiffness, c, [&](std::int32_t r, double v) {
      held[static_cast<std::size_t>(r)] += std::abs(v) * of.system->coordinate_scale(c);
    });
  }
  for (std::size_t k = 0; k < of.system->coordinates(); ++k) {
    if (std::abs(inertia[k]) > std::max(balance * at.equations.magnitude()[k], unloaded * held[k])) return true;
  }
  return false;
}

}  // namespace dynalin::nastran
