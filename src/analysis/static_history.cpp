#include "analysis/static_history.h"

#include <fmt/format.h>

#include <cmath>

namespace dynalin {

void StaticHistory::begin(std::string_view search) {
  search_ = search;
  progress_.tell(search);
}

void StaticHistory::add(double imbalance, double rate) {
  last_ = {imbalance, rate};
  if (count_ == 0) first_ = last_;
  if (imbalance < best_.imbalance) best_ = last_, best_at_ = count_;
  if (watch_) watch_(count_, imbalance);
  progress_.tell([&] { return fmt::format("{}: iteration {}, imbalance {:.2e}", search_, count_, imbalance); });
  ++count_;
}

std::vector<std::string> StaticHistory::lines() const {
  std::vector<std::string> list;
  const auto line = [&](int at, const Iteration& i, std::string_view what) {
    if (!std::isfinite(i.imbalance)) {
      list.push_back(fmt::format("iteration {}: a force is no finite number", at));
      return;
    }
    list.push_back(fmt::format("iteration {}: imbalance {:.5e}", at, i.imbalance));
    if (i.rate > 0) list.back() += fmt::format(" and a state that changes at a rate of {:.3e}", i.rate);
    list.back() += what;
  };
  if (count_ > 0) line(0, first_, "");
  if (best_at_ > 0 && best_at_ < count_ - 1) line(best_at_, best_, ", the least");
  if (count_ > 1) line(count_ - 1, last_, best_at_ == count_ - 1 ? ", the last and the least" : ", the last");
  return list;
}

}  // namespace dynalin
