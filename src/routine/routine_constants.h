// The constants between the parentheses of USER(…), as a routine gets them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace dynalin {

class RoutineConstants {
 public:
  static constexpr std::size_t most = 30;

  RoutineConstants() = default;
  explicit RoutineConstants(std::span<const double> given) : count_(static_cast<int>(std::min(given.size(), most))) {
    std::copy_n(given.begin(), count_, value_.begin());
  }
  int count() const { return count_; }
  // Never null, and zeros beyond the last: some routines look before they ask how many there are.
  const double* data() const { return value_.data(); }

 private:
  int count_ = 0;
  std::array<double, most> value_{};
};

}  // namespace dynalin
