// The place where a routine writes its values, with room behind them: what it writes beyond its own would be somebody
// else's.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace dynalin {

class GuardedValues {
 public:
  // In `memory`, which one call at a time uses.
  GuardedValues(std::vector<double>& memory, std::size_t count) : all_(memory), count_(count) {
    all_.assign(count + room, untouched);
  }

  double* data() { return all_.data(); }
  std::span<double> own() { return std::span(all_).first(count_); }
  // How many have been written, if more than its own.
  std::size_t written() const {
    const auto beyond = std::span(all_).subspan(count_);
    const auto last = std::find_if(beyond.rbegin(), beyond.rend(), [](double v) { return v != untouched; });
    return count_ + static_cast<std::size_t>(beyond.rend() - last);
  }
  bool are_exceeded() const { return written() > count_; }

 private:
  static constexpr std::size_t room = 64;
  static constexpr double untouched = -6.0221407e-301;  // no value of anything

  std::vector<double>& all_;
  const std::size_t count_;
};

}  // namespace dynalin
