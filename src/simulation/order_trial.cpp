#include "simulation/order_trial.h"

#include <algorithm>

namespace dynalin {

namespace {

constexpr int stable_order = 2;
constexpr std::int64_t window = 500;
// Of a trial: steps that it takes to grow after a start, and those whose length counts.
constexpr std::int64_t growing = 100, measured = 200;
constexpr double long_run = 30000;   // steps ahead that are worth a trial
constexpr double much_longer = 1.5;  // steps that settle for the other order
constexpr std::int64_t least_pause = 5000, most_pause = 1000000;

}  // namespace

int OrderTrial::other() const { return order_ == stable_order ? highest_ : stable_order; }

std::optional<int> OrderTrial::after_step(double length, double ahead) {
  if (highest_ <= stable_order) return std::nullopt;
  ++steps_, ++since_trial_;
  if (!on_trial_ || steps_ > growing) time_ += length;
  const auto begin_window = [&] { steps_ = 0, time_ = 0; };
  if (on_trial_) {
    if (steps_ < growing + measured) return std::nullopt;
    const bool better = time_ > much_longer * known_ * static_cast<double>(measured);
    begin_window();
    on_trial_ = false, since_trial_ = 0;
    pause_ = better ? least_pause : std::clamp(2 * pause_, least_pause, most_pause);
    if (better) return std::nullopt;
    order_ = other();
    return order_;
  }
  if (steps_ < window) return std::nullopt;
  known_ = time_ / static_cast<double>(window);
  begin_window();
  if (since_trial_ < pause_ || !(ahead > long_run * known_)) return std::nullopt;
  on_trial_ = true;
  order_ = other();
  return order_;
}

}  // namespace dynalin
