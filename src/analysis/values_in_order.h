// Values of expressions that read each other, one after the other.
#pragma once

#include <cstdint>
#include <vector>

namespace dynalin {

// Those of a chain come after what they read. Those that read each other in a circle begin somewhere: what the first
// of them reads of the circle is left out.
class ValuesInOrder {
 public:
  explicit ValuesInOrder(std::int32_t count)
      : readers_(static_cast<std::size_t>(count)),
        open_(static_cast<std::size_t>(count), 0),
        seen_(static_cast<std::size_t>(count), false) {}

  void reads(std::int32_t reader, std::int32_t read, double slope) {
    readers_[static_cast<std::size_t>(read)].push_back({reader, slope});
    ++open_[static_cast<std::size_t>(reader)];
  }

  // Calls `visit(reader, read, slope)` for each reading, once all readings of what is read have been visited. Once.
  template <class Visit>
  void for_each_reading(Visit&& visit) {
    const auto count = static_cast<std::int32_t>(open_.size());
    for (std::int32_t k = 0; k < count; ++k) {
      if (open_[static_cast<std::size_t>(k)] == 0) see(k);
    }
    pass_on(visit);
    for (std::int32_t k = 0; k < count; ++k) see(k), pass_on(visit);
  }

 private:
  struct Reading {
    std::int32_t reader;
    double slope;
  };

  void see(std::int32_t k) {
    if (seen_[static_cast<std::size_t>(k)]) return;
    seen_[static_cast<std::size_t>(k)] = true;
    known_.push_back(k);
  }
  template <class Visit>
  void pass_on(Visit& visit) {
    while (!known_.empty()) {
      const std::int32_t from = known_.back();
      known_.pop_back();
      for (const Reading& to : readers_[static_cast<std::size_t>(from)]) {
        if (seen_[static_cast<std::size_t>(to.reader)]) continue;
        visit(to.reader, from, to.slope);
        if (--open_[static_cast<std::size_t>(to.reader)] == 0) see(to.reader);
      }
    }
  }

  std::vector<std::vector<Reading>> readers_;  // of each value
  std::vector<int> open_;                      // readings of each value that have not been visited
  std::vector<bool> seen_;
  std::vector<std::int32_t> known_;
};

}  // namespace dynalin
