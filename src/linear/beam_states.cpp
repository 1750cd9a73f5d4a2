#include "linear/beam_states.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "elements/bodies/fe_part.h"

namespace dynalin {

std::map<std::int32_t, StateCoordinate> beam_state_coordinates(const System& system) {
  static constexpr std::array names = {"displacement DX", "displacement DY", "displacement DZ",
                                       "rotation AX",     "rotation AY",     "rotation AZ"};
  const Layout& layout = system.layout();
  std::map<std::int32_t, StateCoordinate> list;
  // Of coordinates beyond poses, one after the other.
  std::vector<const std::string*> extra_names;
  for (const ExtraBlock& e : layout.extras) {
    for (std::int32_t k = 0; k < e.count; ++k) extra_names.push_back(&e.coordinates[static_cast<std::size_t>(k)].name);
  }
  for (const BeamBody& b : beam_bodies(system.model(), layout)) {
    const auto nodes = static_cast<int>(b.nodes.size()), count = b.plane ? 4 * nodes : 12 * nodes - 3;
    const auto put = [&](std::int32_t at, int number, std::string text) {
      StateLabel label{StateType::fe_part, b.label->id, number, std::move(text), b.label->element(), false};
      list.emplace(at,
                   state_coordinate(std::move(label), StateType::fe_part, number + count, system.coordinate_scale(at)));
    };
    const auto pose = [&](std::size_t node, std::size_t i, int number) {
      put(layout.body(b.nodes[node]).offset + static_cast<std::int32_t>(i), number,
          fmt::format("Global {}(node {})", names[i], b.numbers[node]));
    };
    const auto extra = [&](std::size_t at, int number) {
      put(layout.body_coordinate_count + static_cast<std::int32_t>(at), number, *extra_names[at]);
    };
    if (b.plane) {
      // Place and slope in the plane; the others, which rows hold, have numbers behind all states.
      const auto [first, second, normal] = *b.plane;
      int behind = 2 * count;
      for (std::size_t k = 0; k < b.nodes.size(); ++k) {
        const int number = 4 * static_cast<int>(k);
        pose(k, first, number + 1), pose(k, second, number + 2);
        extra(b.slope(k) + first, number + 3), extra(b.slope(k) + second, number + 4);
        pose(k, normal, ++behind), extra(b.slope(k) + normal, ++behind);
        for (std::size_t i = 3; i < 6; ++i) pose(k, i, ++behind);
      }
      continue;
    }
    for (std::size_t k = 0; k < b.nodes.size(); ++k) {
      const int number = 9 * static_cast<int>(k) + 1;
      for (std::size_t i = 0; i < 6; ++i) pose(k, i, number + static_cast<int>(i));
      for (std::size_t i = 0; i < 3; ++i) extra(b.slope(k) + i, number + 6 + static_cast<int>(i));
    }
    for (std::size_t e = 0; e < b.elements->size(); ++e) {
      for (std::size_t i = 0; i < 3; ++i)
        extra(b.middle(e) + i, 9 * nodes + 3 * static_cast<int>(e) + static_cast<int>(i) + 1);
    }
  }
  return list;
}

}  // namespace dynalin
