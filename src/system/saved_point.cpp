#include "system/saved_point.h"

#include <algorithm>
#include <set>

#include "system/carried_past.h"
#include "system/found_followers.h"
#include "system/moved_origin.h"

namespace dynalin {

namespace {

std::vector<double> part(const std::vector<double>& all, std::int32_t offset, std::int32_t count) {
  const auto first = all.begin() + offset;
  return {first, first + count};
}

void put(const std::vector<double>& values, std::vector<double>& all, std::int32_t offset) {
  std::copy(values.begin(), values.end(), all.begin() + offset);
}

std::vector<SavedPoint::Value> saved_values(std::vector<EntryKey> keys, const std::vector<double>& values) {
  std::vector<SavedPoint::Value> list;
  for (std::size_t k = 0; k < keys.size(); ++k) list.push_back({std::move(keys[k]), values[k]});
  return list;
}

// Puts what was saved where it belongs, and names what has no partner.
class Restorer {
 public:
  explicit Restorer(const System& system) { restored_.point = system.drawn(); }

  template <class Saved, class Place>
  void restore(const std::vector<Saved>& saved, const std::vector<EntryKey>& here, const Place& place) {
    std::vector<EntryKey> keys;
    std::set<Restated::Element> known;
    for (const Saved& entry : saved) keys.push_back(entry.of), known.insert(element_of(entry.of));
    std::vector<bool> taken(saved.size()), found(here.size());
    for (const auto& [a, b] : matches(keys, here)) {
      taken[a] = found[b] = true;
      if (place(saved[a], b)) continue;
      name(here[b], others_, restored_.others);
      begin_shape(here[b]);
    }
    for (std::size_t k = 0; k < saved.size(); ++k) {
      if (!taken[k]) name(keys[k], not_here_, restored_.not_here);
    }
    for (std::size_t k = 0; k < here.size(); ++k) {
      if (found[k]) continue;
      name(here[k], not_saved_, restored_.not_saved);
      if (known.contains(element_of(here[k]))) continue;
      if constexpr (std::is_same_v<Saved, SavedPoint::Coordinates>)
        begin_shape(here[k]);  // its place is that of the body
      else
        restored_.begun.begin(element_of(here[k]));
    }
  }
  void begin_anew(const std::vector<AngleName>& angles) {
    for (const AngleName& a : angles) restored_.not_saved.push_back(a.text());
  }
  void begin_anew(const std::vector<std::string>& elements) {
    restored_.not_saved.insert(restored_.not_saved.end(), elements.begin(), elements.end());
  }
  void restore_pasts(const std::vector<SavedPoint::Delay>& saved, const std::vector<EntryKey>& calls) {
    std::vector<DelayHistory> histories;
    for (const SavedPoint::Delay& d : saved) histories.push_back(DelayHistory::of(d.start, d.instants));
    std::vector<KeptPast> kept;
    for (std::size_t k = 0; k < saved.size(); ++k) kept.push_back({saved[k].of, &histories[k]});
    const std::vector<const KeptPast*> pasts = pasts_of(calls, kept);
    restored_.point.delays = histories_of(pasts);
    std::set<const KeptPast*> taken(pasts.begin(), pasts.end());
    for (const KeptPast& past : kept)
      if (!taken.contains(&past)) name(past.of, not_here_, restored_.not_here);
    for (std::size_t k = 0; k < calls.size(); ++k)
      if (!pasts[k]) name(calls[k], not_saved_, restored_.not_saved);
  }
  OperatingPoint& point() { return restored_.point; }
  RestoredPoint finish() && { return std::move(restored_); }

 private:
  static Restated::Element element_of(const EntryKey& key) { return {key.statement, key.id}; }
  void begin_shape(const EntryKey& key) {
    for (const char* start : {"DMODE", "VMODE"}) restored_.begun.state(element_of(key), start);
  }
  static void name(const EntryKey& key, std::set<std::string>& known, std::vector<std::string>& list) {
    const std::string text = EntryKey{key.statement, key.id, "", 0}.text();
    if (known.insert(text).second) list.push_back(text);
  }

  RestoredPoint restored_;
  std::set<std::string> not_here_, not_saved_, others_;
};

}  // namespace

SavedPoint saved_point(const System& system, const OperatingPoint& op) {
  const Layout& layout = system.layout();
  SavedPoint saved;
  saved.time = op.time, saved.mode = op.mode, saved.redundancy_tolerance = op.redundancy_tolerance;
  std::vector<EntryKey> keys = body_keys(layout);
  for (std::size_t k = 1; k < layout.bodies.size(); ++k) {  // the ground stays
    const BodyBlock& b = layout.bodies[k];
    saved.bodies.push_back({std::move(keys[k]), op.poses[k], system.model().bodies[k].origin_offset,
                            part(op.velocity, b.offset, b.count), part(op.acceleration, b.offset, b.count)});
  }
  keys = extra_keys(layout);
  for (std::size_t k = 0; k < layout.extras.size(); ++k) {
    const ExtraBlock& e = layout.extras[k];
    saved.coordinates.push_back({std::move(keys[k]),
                                 part(op.extra, static_cast<std::int32_t>(layout.extra_index(e.offset)), e.count),
                                 part(op.velocity, e.offset, e.count), part(op.acceleration, e.offset, e.count)});
  }
  saved.multipliers = saved_values(row_keys(layout), op.lambda);
  saved.values = saved_values(value_keys(layout), op.algebraic);
  keys = memory_keys(layout);
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (layout.memory_owners[k].element) saved.memory.push_back({std::move(keys[k]), op.memory[k]});
  saved.turns = known_turns(system, op);
  keys = state_keys(layout);
  for (std::size_t k = 0; k < keys.size(); ++k)
    saved.states.push_back({std::move(keys[k]), op.state[k], op.state_rate[k]});
  saved.pairs = known_pairs(system, op);
  if (op.delays) {
    keys = delay_keys(layout);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const DelayHistory& past = op.delays->of_call[k];
      saved.delays.push_back({std::move(keys[k]), past.start(), past.instants()});
    }
  }
  return saved;
}

RestoredPoint restored_point(const SavedPoint& saved, const System& system) {
  const Layout& layout = system.layout();
  Restorer restorer(system);
  OperatingPoint& op = restorer.point();
  op.time = saved.time, op.mode = saved.mode, op.redundancy_tolerance = saved.redundancy_tolerance;

  std::vector<EntryKey> bodies = body_keys(layout);
  bodies.erase(bodies.begin());
  restorer.restore(saved.bodies, bodies, [&](const SavedPoint::Body& from, std::size_t place) {
    const std::size_t k = place + 1;
    const BodyBlock& b = layout.bodies[k];
    const auto count = static_cast<std::size_t>(b.count);
    if (from.velocity.size() != count || from.acceleration.size() != count) return false;
    op.poses[k] = from.pose;
    put(from.velocity, op.velocity, b.offset), put(from.acceleration, op.acceleration, b.offset);
    const Vector moved = system.model().bodies[k].origin_offset - from.origin_offset;
    if (b.turns() && (moved.x != 0 || moved.y != 0 || moved.z != 0)) move_origin(op, k, b.offset, moved);
    return true;
  });
  restorer.restore(saved.coordinates, extra_keys(layout), [&](const SavedPoint::Coordinates& from, std::size_t k) {
    const ExtraBlock& e = layout.extras[k];
    const auto count = static_cast<std::size_t>(e.count);
    if (from.values.size() != count || from.velocity.size() != count || from.acceleration.size() != count) return false;
    put(from.values, op.extra, static_cast<std::int32_t>(layout.extra_index(e.offset)));
    put(from.velocity, op.velocity, e.offset), put(from.acceleration, op.acceleration, e.offset);
    return true;
  });
  const auto into = [](std::vector<double>& values) {
    return [&values](const SavedPoint::Value& from, std::size_t k) {
      values[k] = from.value;
      return true;
    };
  };
  RowsBefore met(layout.row_count());  // as a point that an analysis has found has them
  restorer.restore(saved.multipliers, row_keys(layout), [&](const SavedPoint::Value& from, std::size_t k) {
    op.lambda[k] = from.value, met[k] = 0.0;
    return true;
  });
  find_followers(system, met, op);
  restorer.restore(saved.values, value_keys(layout), into(op.algebraic));
  std::vector<EntryKey> remembered = memory_keys(layout);
  // Of what elements remember: angles have no key here.
  std::erase_if(remembered, [](const EntryKey& key) { return key.statement.empty(); });
  std::vector<std::size_t> entries;
  for (std::size_t k = 0; k < layout.memory_owners.size(); ++k)
    if (layout.memory_owners[k].element) entries.push_back(k);
  restorer.restore(saved.memory, remembered, [&](const SavedPoint::Value& from, std::size_t k) {
    op.memory[entries[k]] = from.value;
    return true;
  });
  restorer.begin_anew(take_over_turns(saved.turns, system, op));
  restorer.restore(saved.states, state_keys(layout), [&](const SavedPoint::State& from, std::size_t k) {
    op.state[k] = from.value, op.state_rate[k] = from.rate;
    return true;
  });
  const ChangedPairs changed = take_over_pairs(saved.pairs, system, op);
  restorer.begin_anew(changed.anew);
  begin_as_found(system, changed.found, op);
  if (!saved.delays.empty()) restorer.restore_pasts(saved.delays, delay_keys(layout));
  return std::move(restorer).finish();
}

}  // namespace dynalin
