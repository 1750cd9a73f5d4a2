#include "mechanics/delay_history.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "expression/switch_list.h"

namespace dynalin {

namespace {

// Differences below these are what a new start of the integration adds to a value and its slope, relative to the
// largest there were, and no jumps.
constexpr double value_noise = 1e-6, slope_noise = 1e-3;
// Instants that lie nearer to each other than this share of what is interpolated would only add their noise.
constexpr double nearest_neighbour = 0.05;

bool same_time(double a, double b) {
  return std::abs(a - b) <= 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
}

// The polynomial through up to four values, by divided differences. A value with its slope stands there twice.
class Interpolation {
 public:
  void add(double time, double value) { put(time, value, 0); }
  void add(double time, double value, double slope) { put(time, value, slope), put(time, value, slope); }

  DelayHistory::Reading at(double s) const {
    std::array<double, 4> c = value_;
    for (std::size_t level = 1; level < count_; ++level) {
      for (std::size_t k = count_; k-- > level;) {
        const double width = time_[k] - time_[k - level];
        c[k] = width == 0 ? slope_[k] : (c[k] - c[k - 1]) / width;
      }
    }
    DelayHistory::Reading r{c[count_ - 1], 0, 1};
    for (std::size_t k = count_ - 1; k-- > 0;) {
      r.slope = r.slope * (s - time_[k]) + r.value;
      r.value = r.value * (s - time_[k]) + c[k];
      r.by_present *= (s - time_[k]) / (time_[count_ - 1] - time_[k]);
    }
    return r;
  }

 private:
  void put(double time, double value, double slope) {
    time_[count_] = time, value_[count_] = value, slope_[count_++] = slope;
  }
  std::array<double, 4> time_{}, value_{}, slope_{};
  std::size_t count_ = 0;
};

void pass(Interpolation& course, const DelayHistory::Instant& i) {
  std::isfinite(i.slope) ? course.add(i.time, i.value, i.slope) : course.add(i.time, i.value);
}

}  // namespace

DelayHistory::Reading DelayHistory::at(double s) const {
  // The interval that holds s: behind an event where s is at one, before the last instant where s is there.
  std::size_t low = std::max<std::size_t>(instants_until(s), 1) - 1;
  if (low + 1 == size() && low > 0 && !instant(low).begins) --low;
  Interpolation course;
  if (low + 1 == size() || instant(low + 1).begins) {
    course.add(instant(low).time, instant(low).value);
    Reading r = course.at(s);
    r.slope = std::isfinite(instant(low).slope) ? instant(low).slope : 0.0;
    r.by_present = 0;
    return r;
  }
  const Instant &before = instant(low), &behind = instant(low + 1);
  if (std::isfinite(before.slope) && std::isfinite(behind.slope)) {
    pass(course, before), pass(course, behind);
  } else {
    // One neighbour on each side, or two on one.
    const double near = nearest_neighbour * (behind.time - before.time);
    const auto left = instant_before(low, near), right = instant_behind(low + 1, near);
    const auto further = left && !right   ? instant_before(*left, near)
                         : right && !left ? instant_behind(*right, near)
                                          : std::nullopt;
    course.add(before.time, before.value), course.add(behind.time, behind.value);
    for (const auto& k : {left, right, further})
      if (k) course.add(instant(*k).time, instant(*k).value);
  }
  Reading r = course.at(s);
  r.by_present = 0;
  return r;
}

DelayHistory::Reading DelayHistory::at(double s, double t, double present) const {
  const std::size_t last = size() - 1;
  const double near = nearest_neighbour * (t - end_);
  Interpolation course;
  if (const auto k = instant_before(last, near)) {
    const auto further = std::isfinite(instant(last).slope) ? std::nullopt : instant_before(*k, near);
    if (further) course.add(instant(*further).time, instant(*further).value);
    course.add(instant(*k).time, instant(*k).value);
  }
  pass(course, instant(last));
  course.add(t, present);
  return course.at(s);
}

std::optional<std::size_t> DelayHistory::instant_before(std::size_t k, double distance) const {
  for (std::size_t j = k; j > 0 && !instant(j).begins; --j)
    if (instant(k).time - instant(j - 1).time >= distance) return j - 1;
  return std::nullopt;
}

std::optional<std::size_t> DelayHistory::instant_behind(std::size_t k, double distance) const {
  for (std::size_t j = k + 1; j < size() && !instant(j).begins; ++j)
    if (instant(j).time - instant(k).time >= distance) return j;
  return std::nullopt;
}

double DelayHistory::switching(double s) const { return knot_switch(breaks_, s, breaks_dropped_); }

bool DelayHistory::jumps(double value, double slope) const {
  const Instant& last = instant(size() - 1);
  // A slope that is not known on one side tells nothing.
  return std::abs(value - last.value) > value_noise * largest_value_ ||
         std::abs(slope - last.slope) > slope_noise * largest_slope_;
}

double DelayHistory::next_break(double s) const {
  const auto next = std::upper_bound(breaks_.begin(), breaks_.end(), s);
  return next == breaks_.end() ? std::numeric_limits<double>::infinity() : *next;
}

void DelayHistory::look_ahead(double s0, double s1, StepReach& reach) const {
  if (empty() || !(s1 > s0)) return;
  const auto share = [&](double s) { return (s - s0) / (s1 - s0); };
  const auto first = std::upper_bound(breaks_.begin(), breaks_.end(), s0);
  const bool breaks_off = first != breaks_.end() && *first < s1;
  if (breaks_off && first + 1 != breaks_.end() && first[1] < s1) reach.end_at(share(0.5 * (first[0] + first[1])));
  // The instants of the smooth course ahead.
  std::size_t low = instants_until(s0);
  const std::size_t high = breaks_off ? instants_until(*first) - 1 : instants_until(s1);  // behind the last of them
  if (s0 < oldest() || high < low + 2) return;
  const Instant& last = instant(high - 1);
  const Reading begin = at(s0);
  const ExpectedCourse expected(s0, begin.value, begin.slope, last.time, last.value);
  for (; low + 1 < high && share(instant(low).time) < reach.share(); ++low) {
    const Instant& i = instant(low);
    if (std::abs(i.value - expected.at(i.time)) > reach.tolerance() * largest_value_)
      return reach.end_at(share(i.time));
  }
}

std::size_t DelayHistory::instants_until(double s) const {
  std::size_t low = 0, high = size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (instant(middle).time <= s) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

void DelayHistory::note_size(double value, double slope) {
  largest_value_ = std::max(largest_value_, std::abs(value));
  if (std::isfinite(slope)) largest_slope_ = std::max(largest_slope_, std::abs(slope));
}

void DelayHistory::append_behind(double time, double value, double slope, double oldest, bool changes) {
  if (empty() || time < end_) return append(time, value, slope, oldest);
  note_size(value, slope);
  if (changes || jumps(value, slope)) add({time, value, slope, true});
  drop(oldest);
}

void DelayHistory::append(double time, double value, double slope, double oldest) {
  const bool again = !empty() && same_time(time, end_);
  if (!empty() && !again && time < end_) *this = DelayHistory();
  note_size(value, slope);
  if (empty()) {
    start_ = time;
    add({time, value, slope, true});
  } else if (!again) {
    add({time, value, slope, false});
  } else if (instant(size() - 1).begins && !recent_.empty()) {
    recent_.back() = {recent_.back().time, value, slope, true};  // before anything has followed from it
  } else if (jumps(value, slope)) {
    add({end_, value, slope, true});
  }
  drop(oldest);
}

std::vector<DelayHistory::Instant> DelayHistory::instants() const {
  std::vector<Instant> list;
  for (std::size_t k = 0; k < size(); ++k) list.push_back(instant(k));
  return list;
}

DelayHistory DelayHistory::of(double start, const std::vector<Instant>& instants) {
  DelayHistory h;
  h.start_ = start;
  for (const Instant& i : instants) {
    h.largest_value_ = std::max(h.largest_value_, std::abs(i.value));
    if (std::isfinite(i.slope)) h.largest_slope_ = std::max(h.largest_slope_, std::abs(i.slope));
    h.add(i);
  }
  return h;
}

DelayHistory DelayHistory::from_oldest() const {
  if (empty() || oldest() <= start_) return *this;
  std::vector<Instant> kept = instants();
  kept.front().begins = true;
  return of(kept.front().time, kept);
}

void DelayHistory::add(const Instant& i) {
  end_ = i.time;
  if (i.begins) breaks_.push_back(i.time);
  recent_.push_back(i);
  if (recent_.size() < chunk_size) return;
  full_.push_back(std::make_shared<const Chunk>(std::move(recent_)));
  recent_.clear();
}

// Whole chunks, and a further one is kept: what is read needs neighbours.
void DelayHistory::drop(double oldest) {
  std::size_t chunks = 0;
  while (chunks + 2 < full_.size() && full_[chunks + 1]->back().time < oldest) ++chunks;
  full_.erase(full_.begin(), full_.begin() + static_cast<std::ptrdiff_t>(chunks));
  const auto kept = std::lower_bound(breaks_.begin(), breaks_.end(), oldest);
  const auto passed = kept - breaks_.begin();
  if (passed > 64) {
    breaks_dropped_ += static_cast<std::size_t>(passed);
    breaks_.erase(breaks_.begin(), kept);
  }
}

}  // namespace dynalin
