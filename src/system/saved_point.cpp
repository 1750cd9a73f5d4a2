#include "system/saved_point.h"

#include <algorithm>
#include <set>

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

// What is remembered belongs to an expression, or to an element as a whole, and a past to a call of DELAY; the element
// is the statement that it stands in. Statements that edits changed have arguments in other texts.
std::vector<EntryKey> keys_by_place(const System& system, const std::vector<Span>& owners) {
  std::map<std::pair<const SourceText*, std::uint32_t>, const Statement*> in;
  for (const Span& owner : owners) in.emplace(std::pair(owner.source, owner.offset), nullptr);
  const auto claim = [&](const Statement& s, const Span& from, std::uint32_t end) {
    for (auto it = in.lower_bound({from.source, from.offset}); it != in.end(); ++it) {
      if (it->first.first != from.source || it->first.second >= end) return;
      it->second = &s;
    }
  };
  if (!in.empty() && system.model().dataset) {
    for (const Statement& s : system.model().dataset->statements) {
      claim(s, s.at, s.at.offset + s.at.length);
      for (const WrittenArgument& a : s.arguments) {
        const Span value = a.value_span();
        claim(s, a.name, value.offset + value.length);
      }
    }
  }
  KeyCounter keys;
  std::vector<EntryKey> list;
  for (const Span& owner : owners) {
    const Statement* s = in.at({owner.source, owner.offset});
    const bool whole = s && s->at.source == owner.source && s->at.offset == owner.offset;
    list.push_back(keys.next(s ? s->name : "", s ? s->id.value_or(0) : 0, whole ? "" : owner.text()));
  }
  return list;
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
    for (const Saved& entry : saved) keys.push_back(entry.of);
    std::vector<bool> taken(saved.size()), found(here.size());
    for (const auto& [a, b] : matches(keys, here)) {
      if (!place(saved[a], b)) continue;
      taken[a] = found[b] = true;
    }
    for (std::size_t k = 0; k < saved.size(); ++k) {
      if (!taken[k]) name(keys[k], not_here_, restored_.not_here);
    }
    for (std::size_t k = 0; k < here.size(); ++k) {
      if (!found[k]) name(here[k], not_saved_, restored_.not_saved);
    }
  }
  OperatingPoint& point() { return restored_.point; }
  RestoredPoint finish() && { return std::move(restored_); }

 private:
  static void name(const EntryKey& key, std::set<std::string>& known, std::vector<std::string>& list) {
    const std::string text = EntryKey{key.statement, key.id, "", 0}.text();
    if (known.insert(text).second) list.push_back(text);
  }

  RestoredPoint restored_;
  std::set<std::string> not_here_, not_saved_;
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
  saved.memory = saved_values(keys_by_place(system, layout.memory_owners), op.memory);
  keys = state_keys(layout);
  for (std::size_t k = 0; k < keys.size(); ++k)
    saved.states.push_back({std::move(keys[k]), op.state[k], op.state_rate[k]});
  if (op.delays) {
    keys = keys_by_place(system, layout.delay_calls);
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
  restorer.restore(saved.multipliers, row_keys(layout), into(op.lambda));
  restorer.restore(saved.values, value_keys(layout), into(op.algebraic));
  restorer.restore(saved.memory, keys_by_place(system, layout.memory_owners), into(op.memory));
  restorer.restore(saved.states, state_keys(layout), [&](const SavedPoint::State& from, std::size_t k) {
    op.state[k] = from.value, op.state_rate[k] = from.rate;
    return true;
  });
  if (!saved.delays.empty()) {
    auto delays = std::make_shared<DelayHistories>(layout.delay_calls.size());
    restorer.restore(saved.delays, keys_by_place(system, layout.delay_calls),
                     [&](const SavedPoint::Delay& from, std::size_t k) {
                       delays->of_call[k] = DelayHistory::of(from.start, from.instants);
                       return true;
                     });
    op.delays = std::move(delays);
  }
  return std::move(restorer).finish();
}

}  // namespace dynalin
