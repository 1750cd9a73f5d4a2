#include "mechanics/layout.h"

#include <array>

namespace dynalin {

namespace {
std::int32_t last_index(std::size_t size) { return static_cast<std::int32_t>(size) - 1; }
}  // namespace

std::int32_t Layout::add_body(BodyKind kind, ElementLabel label, const BodyListing& listed) {
  const std::int32_t count = kind == BodyKind::part ? 6 : kind == BodyKind::point_mass ? 3 : 0;
  bodies.push_back({kind, count > 0 ? coordinate_count : -1, count, std::move(label)});
  bodies.back().listed = listed;
  coordinate_count += count;
  body_coordinate_count = coordinate_count;
  return last_index(bodies.size());
}

std::int32_t Layout::add_extra(ElementLabel label, ExtraKind kind, std::vector<ExtraCoordinate> coordinates) {
  const std::int32_t offset = coordinate_count;
  const auto count = static_cast<std::int32_t>(coordinates.size());
  for (std::int32_t k = 0; k < count; ++k) {
    if (std::int32_t& number = coordinates[static_cast<std::size_t>(k)].number; number == 0) number = k + 1;
  }
  extras.push_back({offset, count, std::move(label), kind, std::move(coordinates)});
  coordinate_count += count;
  return offset;
}

const CurvePoint* Layout::curve_point(MarkerId m) const {
  for (const CurvePoint& p : curve_points) {
    if (p.marker == m) return &p;
  }
  return nullptr;
}

std::int32_t Layout::add_row(const ElementLabel& owner, std::string_view name, RowLevel level) {
  rows.push_back({&owner, name, level});
  return last_index(rows.size());
}

std::int32_t Layout::add_algebraic(const ElementLabel& owner, std::int32_t component, double guess) {
  algebraic.push_back({&owner, component, guess});
  return last_index(algebraic.size());
}

std::int32_t Layout::add_state(const DifferentialState& state) {
  states.push_back(state);
  return last_index(states.size());
}

std::int32_t Layout::add_memory(const ElementLabel& owner, std::string_view name, double initial) {
  memory.push_back(initial);
  memory_owners.push_back({&owner, name});
  return last_index(memory.size());
}

std::int32_t Layout::count_turns(Measure measure, MarkerId i, MarkerId j) {
  const auto bits = [](int index) { return static_cast<std::uint64_t>(index); };
  const int about = static_cast<int>(measure) - static_cast<int>(Measure::AX);
  const std::uint64_t key = bits(about) << 62 | bits(i.index) << 31 | bits(j.index);
  const auto [it, fresh] = entry_of_angle_.emplace(key, static_cast<std::int32_t>(memory.size()));
  if (fresh) {
    memory.push_back(0);
    memory_owners.emplace_back();
    angles.push_back({measure, i, j, it->second});
  }
  return it->second;
}

std::string Layout::coordinate_text(std::int32_t coordinate) const {
  static constexpr std::array names = {"DX", "DY", "DZ", "AX", "AY", "AZ"};
  for (const BodyBlock& b : bodies) {
    if (b.count > 0 && coordinate >= b.offset && coordinate < b.offset + b.count) {
      return std::string(names[static_cast<std::size_t>(coordinate - b.offset)]) + " of " + b.label.full_text();
    }
  }
  for (const ExtraBlock& e : extras) {
    if (coordinate >= e.offset && coordinate < e.offset + e.count) {
      return e.coordinates[static_cast<std::size_t>(coordinate - e.offset)].name + " of " + e.label.full_text();
    }
  }
  return "coordinate " + std::to_string(coordinate + 1);
}

}  // namespace dynalin
