#include "simulation/event_density.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

// Events in a row with hardly time to gather speed between them, after which they are passed over for some steps.
constexpr int event_limit = 200;
constexpr std::int64_t steps_between_events = 20, steps_without_events = 200;
// Events on next to no way, after which time does not pass in any number of them.
constexpr int crowd_limit = 10000;
constexpr double next_to_no_way = 1e-9;      // of the whole time
constexpr double part_that_jumps = 0.1;      // of a value, beside what changes with the point
constexpr double rounding_of_values = 1e-9;  // of the largest value so far

}  // namespace

Result<void> EventDensity::pass(double time, double duration) {
  if (time - crowd_from_ > next_to_no_way * duration) crowd_from_ = time, crowd_ = 0;
  if (++crowd_ <= crowd_limit) return {};
  return tl::unexpected(
      Failure{"dynamics",
              fmt::format("at time {:.9g}: {} events within a billionth of the run", time, crowd_limit),
              {"the period of a sampling, or the time from one switch of a function to the next, is next to nothing "
               "beside the time of the run"},
              "stopped-integration"});
}

void EventDensity::note_jumps(const Layout& layout, const std::vector<double>& values, const std::vector<double>& rates,
                              const OperatingPoint& behind) {
  jumping_.clear();
  largest_values_.resize(values.size()), largest_rates_.resize(rates.size());
  const auto note = [&](double from, double to, double& largest, const ElementLabel& owner) {
    const double size = std::max(std::abs(from), std::abs(to));
    largest = std::max(largest, size);
    if (std::abs(to - from) > std::max(part_that_jumps * size, rounding_of_values * largest))
      jumping_.insert(owner.full_text());
  };
  for (std::size_t k = 0; k < values.size(); ++k)
    note(values[k], behind.algebraic[k], largest_values_[k], *layout.algebraic[k].owner);
  const auto follows_time = [&](const ElementLabel* owner) {
    return std::ranges::find(layout.velocity_driven, owner) != layout.velocity_driven.end();
  };
  for (std::size_t k = 0; k < rates.size(); ++k)
    if (!follows_time(layout.states[k].owner))
      note(rates[k], behind.state_rate[k], largest_rates_[k], *layout.states[k].owner);
}

void EventDensity::note_restart(std::int64_t steps, double time, const Kinks& kinks, Diagnostics& warnings) {
  const bool close = last_ && steps - *last_ <= steps_between_events;
  last_ = steps;
  close_ = close ? close_ + 1 : 0;
  if (close_ != event_limit || said_) return;
  said_ = true;
  const std::string jumps = fmt::format("{}", fmt::join(jumping_, ", "));
  std::set<std::string> bending;
  for (const Kink& kink : kinks())
    if (kink.of) bending.insert(kink.of->full_text());
  std::erase_if(bending, [&](const std::string& name) { return jumping_.contains(name); });
  const std::string bends = fmt::format("{}", fmt::join(bending, ", "));
  std::string what, hint;
  if (!jumps.empty()) {
    what = "; what jumps to and fro is " + jumps;
    hint =
        "a jump that holds the motion at its own edge, like dry friction by SIGN or IF, asks for steps of next to "
        "nothing: give it a slope (STEP)";
  }
  if (!bends.empty()) {
    what += "; what has a kink there is " + bends;
    if (hint.empty())
      hint =
          "a kink that the motion comes back to at once, like MAX(0,f) where f is about 0, asks for short steps: make "
          "it round, for example STEP(f,-d,0,d,1)*f";
  }
  warnings.warning("dense-events", {},
                   fmt::format("at time {:g} functions switch without end: from there on kinks and jumps are at times "
                               "stepped over, within the error that is allowed{}",
                               time, what),
                   std::move(hint));
}

bool EventDensity::watches() const { return close_ < event_limit; }

bool EventDensity::watch_again(std::int64_t steps) {
  if (watches() || steps - last_.value_or(0) <= steps_without_events) return false;
  close_ = 0;
  return true;
}

}  // namespace dynalin
