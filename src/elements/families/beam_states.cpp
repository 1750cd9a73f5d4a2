#include "elements/families/beam_states.h"

namespace dynalin {

BeamStates::BeamStates(std::size_t nodes, const std::optional<BeamPlane>& plane)
    : nodes_(static_cast<std::int32_t>(nodes)), count_(plane ? 4 * nodes_ : 12 * nodes_ - 3), plane_(plane) {}

std::array<std::int32_t, 6> BeamStates::of_pose(std::size_t node) const {
  const auto k = static_cast<std::int32_t>(node);
  if (!plane_) {
    const std::int32_t first = 9 * k + 1;
    return {first, first + 1, first + 2, first + 3, first + 4, first + 5};
  }
  const std::int32_t held = first_held(node);
  std::array<std::int32_t, 6> number{};
  number[plane_->first] = 4 * k + 1, number[plane_->second] = 4 * k + 2, number[plane_->normal] = held;
  for (std::int32_t i = 0; i < 3; ++i) number[static_cast<std::size_t>(3 + i)] = held + 2 + i;
  return number;
}

std::array<std::int32_t, 3> BeamStates::of_slope(std::size_t node) const {
  const auto k = static_cast<std::int32_t>(node);
  if (!plane_) return {9 * k + 7, 9 * k + 8, 9 * k + 9};
  std::array<std::int32_t, 3> number{};
  number[plane_->first] = 4 * k + 3, number[plane_->second] = 4 * k + 4, number[plane_->normal] = first_held(node) + 1;
  return number;
}

std::array<std::int32_t, 3> BeamStates::of_middle(std::size_t element) const {
  const std::int32_t first = 9 * nodes_ + 3 * static_cast<std::int32_t>(element) + 1;
  return {first, first + 1, first + 2};
}

}  // namespace dynalin
