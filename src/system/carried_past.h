// The past that the DELAYs of one system have read, for those of another.
#pragma once

#include <memory>
#include <vector>

#include "mechanics/delay_history.h"
#include "system/entry_keys.h"

namespace dynalin {

// A past and the call that has kept it.
struct KeptPast {
  EntryKey of;
  const DelayHistory* history = nullptr;
};

// For each call the past that is its own: that of the same call, or else the longest of any call that delays the same.
// Null where none is kept.
std::vector<const KeptPast*> pasts_of(const std::vector<EntryKey>& calls, const std::vector<KeptPast>&);

// The histories of these calls, which begin no earlier than what is kept; null if there are no calls.
std::shared_ptr<const DelayHistories> histories_of(const std::vector<const KeptPast*>&);

}  // namespace dynalin
