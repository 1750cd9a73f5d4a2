#include "system/entry_keys.h"

#include <array>

namespace dynalin {

namespace {

EntryKey key_of_owner(KeyCounter& keys, const ElementLabel* owner, std::string_view name) {
  return owner ? keys.next(owner->statement, owner->id, name) : keys.next("", 0, name);
}

template <class Entries, class KeyOf>
std::vector<EntryKey> keys_of(const Entries& entries, const KeyOf& key_of) {
  KeyCounter keys;
  std::vector<EntryKey> list;
  list.reserve(entries.size());
  for (const auto& entry : entries) list.push_back(key_of(keys, entry));
  return list;
}

}  // namespace

std::string EntryKey::text() const {
  std::string text = statement;
  if (id != 0) text += "/" + std::to_string(id);
  return name.empty() ? text : text + " " + name;
}

EntryKey KeyCounter::next(std::string_view statement, std::int64_t id, std::string_view name) {
  EntryKey key{std::string(statement), id, std::string(name), 0};
  const std::size_t number = count_[key]++;
  key.number = number;
  return key;
}

// Of several that a beam has as its nodes, those of one with as many are the same: others have other places.
std::vector<EntryKey> body_keys(const Layout& l) {
  std::map<std::pair<std::string_view, std::int64_t>, std::size_t> count;
  for (const BodyBlock& b : l.bodies) ++count[{b.label.statement, b.label.id}];
  return keys_of(l.bodies, [&](KeyCounter& keys, const BodyBlock& b) {
    const std::size_t of = count[{b.label.statement, b.label.id}];
    return keys.next(b.label.statement, b.label.id, of > 1 ? "one of " + std::to_string(of) : "");
  });
}

std::vector<EntryKey> extra_keys(const Layout& l) {
  return keys_of(l.extras, [](KeyCounter& keys, const ExtraBlock& e) { return key_of_owner(keys, &e.label, ""); });
}

std::vector<EntryKey> row_keys(const Layout& l) {
  return keys_of(l.rows, [](KeyCounter& keys, const ConstraintRow& r) { return key_of_owner(keys, r.owner, r.name); });
}

std::vector<EntryKey> value_keys(const Layout& l) {
  return keys_of(l.algebraic, [](KeyCounter& keys, const AlgebraicUnknown& w) {
    return key_of_owner(keys, w.owner, std::to_string(w.component));
  });
}

std::vector<EntryKey> state_keys(const Layout& l) {
  return keys_of(l.states, [](KeyCounter& keys, const DifferentialState& z) {
    return key_of_owner(keys, z.owner, std::to_string(z.coordinate));
  });
}

std::vector<EntryKey> memory_keys(const Layout& l) {
  return keys_of(l.memory_owners,
                 [](KeyCounter& keys, const MemoryOwner& m) { return key_of_owner(keys, m.element, m.name); });
}

std::vector<EntryKey> delay_keys(const Layout& l) {
  return keys_of(l.delay_calls,
                 [](KeyCounter& keys, const DelayOwner& d) { return keys.next(d.statement, d.id, d.delayed); });
}

std::string AngleName::text() const {
  static constexpr std::array names = {"AX", "AY", "AZ"};
  const auto about = static_cast<std::size_t>(measure) - static_cast<std::size_t>(Measure::AX);
  return names[about] + ("(" + std::to_string(i)) + "," + std::to_string(j) + ")";
}

std::vector<AngleName> angle_names(const Layout& l) {
  std::vector<AngleName> names;
  names.reserve(l.angles.size());
  for (const CountedAngle& a : l.angles) names.push_back({a.measure, l.marker_label(a.i).id, l.marker_label(a.j).id});
  return names;
}

std::vector<std::pair<std::size_t, std::size_t>> matches(const std::vector<EntryKey>& from,
                                                         const std::vector<EntryKey>& to) {
  std::map<EntryKey, std::size_t> place;
  for (std::size_t k = 0; k < from.size(); ++k) place.emplace(from[k], k);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 0; k < to.size(); ++k) {
    if (const auto it = place.find(to[k]); it != place.end()) pairs.emplace_back(it->second, k);
  }
  return pairs;
}

}  // namespace dynalin
