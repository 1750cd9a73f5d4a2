#include "linear/beam_states.h"

#include <fmt/format.h>

#include <array>

#include "elements/bodies/fe_part.h"

namespace dynalin {

std::map<std::int32_t, StateCoordinate> beam_state_coordinates(const System& system) {
  static constexpr std::array names = {"displacement DX", "displacement DY", "displacement DZ",
                                       "rotation AX",     "rotation AY",     "rotation AZ"};
  const Layout& layout = system.layout();
  std::map<std::int32_t, StateCoordinate> list;
  for (const BeamBody& b : beam_bodies(system.model(), layout)) {
    const auto nodes = static_cast<int>(b.nodes.size()), count = 12 * nodes - 3;
    const auto put = [&](std::int32_t at, int number, std::string text) {
      StateLabel label{StateType::fe_part, b.label->id, number, std::move(text), b.label->element(), false};
      list.emplace(at,
                   state_coordinate(std::move(label), StateType::fe_part, number + count, system.coordinate_scale(at)));
    };
    const auto extra = [&](std::size_t at, int number) {
      for (const ExtraBlock& e : layout.extras) {
        const auto coordinate = layout.body_coordinate_count + static_cast<std::int32_t>(at);
        if (coordinate >= e.offset && coordinate < e.offset + e.count)
          put(coordinate, number, e.coordinates[static_cast<std::size_t>(coordinate - e.offset)].name);
      }
    };
    for (std::size_t k = 0; k < b.nodes.size(); ++k) {
      const int first = 9 * static_cast<int>(k) + 1;
      for (int i = 0; i < 6; ++i) {
        put(layout.body(b.nodes[k]).offset + i, first + i,
            fmt::format("Global {}(node {})", names[static_cast<std::size_t>(i)], b.numbers[k]));
      }
      for (std::size_t i = 0; i < 3; ++i) extra(b.slope(k) + i, first + 6 + static_cast<int>(i));
    }
    for (std::size_t e = 0; e < b.elements->size(); ++e) {
      for (std::size_t i = 0; i < 3; ++i)
        extra(b.middle(e) + i, 9 * nodes + 3 * static_cast<int>(e) + static_cast<int>(i) + 1);
    }
  }
  return list;
}

}  // namespace dynalin
