#include "system/carried_past.h"

namespace dynalin {

std::vector<const KeptPast*> pasts_of(const std::vector<EntryKey>& calls, const std::vector<KeptPast>& kept) {
  std::map<EntryKey, const KeptPast*> of_call;
  std::map<std::string_view, const KeptPast*> longest;  // of what is delayed
  for (const KeptPast& past : kept) {
    of_call.emplace(past.of, &past);
    if (past.history->empty()) continue;
    const auto [it, fresh] = longest.emplace(past.of.name, &past);
    if (!fresh && past.history->oldest() < it->second->history->oldest()) it->second = &past;
  }
  std::vector<const KeptPast*> found;
  for (const EntryKey& call : calls) {
    const auto own = of_call.find(call);
    const auto other = longest.find(call.name);
    const KeptPast* past = own != of_call.end() ? own->second : nullptr;
    found.push_back((past && !past->history->empty()) || other == longest.end() ? past : other->second);
  }
  return found;
}

std::shared_ptr<const DelayHistories> histories_of(const std::vector<const KeptPast*>& pasts) {
  if (pasts.empty()) return nullptr;
  auto histories = std::make_shared<DelayHistories>(pasts.size());
  for (std::size_t k = 0; k < pasts.size(); ++k)
    if (pasts[k]) histories->of_call[k] = pasts[k]->history->from_oldest();
  return histories;
}

}  // namespace dynalin
