#include "library/edit_history.h"

#include <algorithm>

namespace dynalin::library {

EditHistory EditHistory::after(const std::shared_ptr<const System>& from, Restated restated) const {
  EditHistory next;
  next.earlier_ = earlier_;
  for (const Edit& e : edits_) {
    if (!e.from.expired())
      next.edits_.push_back(e);
    else
      (next.edits_.empty() ? next.earlier_ : next.edits_.back().restated).append(e.restated);
  }
  next.edits_.push_back({from, std::move(restated)});
  return next;
}

Restated EditHistory::restated_since(const std::shared_ptr<const System>& before) const {
  const auto same = [&](const Edit& e) { return !e.from.owner_before(before) && !before.owner_before(e.from); };
  auto first = std::find_if(edits_.begin(), edits_.end(), same);
  Restated all;
  if (first == edits_.end()) all = earlier_, first = edits_.begin();
  for (; first != edits_.end(); ++first) all.append(first->restated);
  return all;
}

}  // namespace dynalin::library
