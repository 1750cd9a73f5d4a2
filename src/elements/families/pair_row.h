// The rows by which joints hold marker I to marker J, as seen from J.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace dynalin {

enum class PairRow : std::uint8_t {
  DX,  // the displacement of I along an axis of J
  DY,
  DZ,
  Xi_Yj,  // an axis of I and one of J are perpendicular
  Zi_Xj,
  Zi_Yj,
  Zi_Zj,
  equal_angles,  // from x of I to y of J, and from y of I to x of J
  thread,        // displacement along z goes with the turn about it
  pinion,        // displacement along z goes with a turn about z of I
};

// As lists of rows have it.
constexpr std::string_view name_of(PairRow row) {
  constexpr std::array<std::string_view, 10> names = {"DX",    "DY",    "DZ",          "Xi.Yj", "Zi.Xj",
                                                      "Zi.Yj", "Zi.Zj", "Xi.Yj-Yi.Xj", "DZ-AZ", "DZ-PINION"};
  return names[static_cast<std::size_t>(row)];
}

struct AxesOfPair {
  std::size_t of_I, of_J;  // 0, 1, 2 of x, y, z
};
// Those that a row asks to be perpendicular; nothing of rows that ask something else.
constexpr std::optional<AxesOfPair> perpendicular_axes(PairRow row) {
  switch (row) {
    case PairRow::Xi_Yj:
      return AxesOfPair{0, 1};
    case PairRow::Zi_Xj:
      return AxesOfPair{2, 0};
    case PairRow::Zi_Yj:
      return AxesOfPair{2, 1};
    case PairRow::Zi_Zj:
      return AxesOfPair{2, 2};
    default:
      return std::nullopt;
  }
}

constexpr bool has_row(std::span<const PairRow> rows, PairRow row) {
  return std::find(rows.begin(), rows.end(), row) != rows.end();
}
// Whether rows ask the z axes to be parallel.
constexpr bool hold_z_axes(std::span<const PairRow> rows) {
  return has_row(rows, PairRow::Zi_Xj) && has_row(rows, PairRow::Zi_Yj);
}

}  // namespace dynalin
