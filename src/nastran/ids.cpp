#include "nastran/ids.h"

#include <algorithm>
#include <iterator>

namespace dynalin::nastran {

Ids::Runs::const_iterator Ids::run_with(const Runs& runs, std::int64_t id) {
  const auto after = runs.upper_bound(id);
  if (after == runs.begin()) return runs.end();
  const auto run = std::prev(after);
  return run->second >= id ? run : runs.end();
}

bool Ids::is_free(IdSpace space, std::int64_t id) const {
  const Runs& runs = taken_[static_cast<std::size_t>(space)];
  return run_with(runs, id) == runs.end();
}

std::int64_t Ids::take(IdSpace space, std::int64_t wanted) {
  Runs& runs = taken_[static_cast<std::size_t>(space)];
  std::int64_t id = std::max<std::int64_t>(wanted, 1);
  if (const auto run = run_with(runs, id); run != runs.end()) id = run->second + 1;
  // The new number joins the run before it, and that run the one after it.
  auto run = run_with(runs, id - 1) != runs.end() ? std::prev(runs.upper_bound(id)) : runs.emplace(id, id).first;
  run->second = id;
  if (const auto next = std::next(run); next != runs.end() && next->first == id + 1) {
    run->second = next->second;
    runs.erase(next);
  }
  return id;
}

}  // namespace dynalin::nastran
