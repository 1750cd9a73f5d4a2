#include "analysis/static_history.h"

#include <fmt/format.h>

#include <cmath>

namespace dynalin {

void StaticHistory::add(double imbalance) {
  if (count_ == 0) first_ = imbalance;
  if (imbalance < best_) best_ = imbalance, best_at_ = count_;
  last_ = imbalance;
  if (progress_) progress_(count_, imbalance);
  ++count_;
}

std::vector<std::string> StaticHistory::lines() const {
  std::vector<std::string> list;
  const auto line = [&](int at, double imbalance, std::string_view what) {
    list.push_back(std::isfinite(imbalance) ? fmt::format("iteration {}: imbalance {:.5e}{}", at, imbalance, what)
                                            : fmt::format("iteration {}: a force is no finite number", at));
  };
  if (count_ > 0) line(0, first_, "");
  if (best_at_ > 0 && best_at_ < count_ - 1) line(best_at_, best_, ", the least");
  if (count_ > 1) line(count_ - 1, last_, best_at_ == count_ - 1 ? ", the last and the least" : ", the last");
  return list;
}

}  // namespace dynalin
