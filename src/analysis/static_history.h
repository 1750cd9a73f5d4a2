// What a search for an equilibrium has seen: enough for a short account of it.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace dynalin {

// Called with every iteration; for a line that shows progress.
using StaticProgress = std::function<void(int iteration, double imbalance)>;

class StaticHistory {
 public:
  explicit StaticHistory(StaticProgress progress) : progress_(std::move(progress)) {}

  void add(double imbalance);
  int iterations() const { return count_; }
  // The first, the best and the last.
  std::vector<std::string> lines() const;

 private:
  StaticProgress progress_;
  int count_ = 0, best_at_ = 0;
  double first_ = 0, best_ = std::numeric_limits<double>::infinity(), last_ = 0;
};

}  // namespace dynalin
