#include "system/carried_pairs.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "mechanics/pair_state_source.h"
#include "system/sources.h"

namespace dynalin {

namespace {

// Up to which lines, and points by the radius of the surface there, are the same.
constexpr double alike = 1e-3;

using Id = std::pair<std::string_view, std::int64_t>;
Id id_of(const EntryKey& key) { return {key.statement, key.id}; }

bool same_markers(const KnownPair& a, const KnownPair& b) {
  for (std::size_t k = 0; k < 2; ++k)
    if (a.ends[k].marker != b.ends[k].marker || a.ends[k].body != b.ends[k].body) return false;
  return a.joint == b.joint && a.motion == b.motion;
}

// Of the motion its first word: which end has a bar of a cross is a matter of how the ends are called.
std::string_view kind_of(const KnownPair& pair) {
  return std::string_view(pair.motion).substr(0, pair.motion.find(' '));
}

// Whether the surfaces of `now` are those of `before`: of the same joint and bodies, and at the same place.
bool same_surfaces(const KnownPair& before, const KnownPair& now, bool swapped) {
  if (before.joint != now.joint || kind_of(before) != kind_of(now) || before.directions.size() != now.directions.size())
    return false;
  for (std::size_t k = 0; k < 2; ++k)
    if (before.ends[k].body != now.ends[swapped ? 1 - k : k].body) return false;
  const Vector at = before.ends[1].at, axis = before.ends[1].axis;
  const bool is_ball = norm(axis) == 0;
  return std::ranges::all_of(now.ends, [&](const KnownPair::End& end) {
    if (norm(cross(axis, end.axis)) > alike) return false;
    const Vector off = end.at - at;
    return now.radius == 0 || norm(is_ball ? off : cross(axis, off)) <= alike * now.radius;
  });
}

// By which the states of `now` come out of those of `before`, row by row; nothing where they begin anew.
using Turned = std::vector<std::vector<double>>;
std::optional<Turned> turned(const KnownPair& before, const KnownPair& now) {
  const bool swapped = before.ends[0].body != now.ends[0].body;
  if (!now.slips() || !same_surfaces(before, now, swapped)) return std::nullopt;
  const std::size_t count = now.directions.size();
  const bool is_ball = norm(now.ends[1].axis) == 0;
  Turned by(count, std::vector<double>(count, 0.0));
  for (std::size_t r = 0; r < count; ++r) {
    for (std::size_t c = 0; c < count; ++c) {
      const double cosine = dot(now.directions[r], before.directions[c]);
      const double along = is_ball ? cosine : r == c ? std::copysign(1.0, cosine) : 0.0;
      by[r][c] = swapped ? -along : along;
    }
  }
  return by;
}

std::vector<double> times(const Turned& by, const std::vector<double>& all, const std::vector<std::size_t>& places) {
  std::vector<double> out;
  for (const std::vector<double>& row : by) {
    double sum = 0;
    for (std::size_t c = 0; c < row.size(); ++c) sum += row[c] * all[places[c]];
    out.push_back(sum);
  }
  return out;
}

// What these elements remember begins at the point.
void begin_memory(const System& system, const std::set<Id>& of, OperatingPoint& op) {
  if (of.empty()) return;
  const Layout& layout = system.layout();
  const auto begins = [&](std::size_t k) {
    const ElementLabel* owner = layout.memory_owners[k].element;
    return owner && of.contains({owner->statement, owner->id});
  };
  OperatingPoint begun = op;
  begun.mode = AnalysisMode::initial_conditions;
  for (std::size_t k = 0; k < begun.memory.size(); ++k)
    if (begins(k)) begun.memory[k] = layout.memory[k];
  system.remember(begun);
  for (std::size_t k = 0; k < begun.memory.size(); ++k)
    if (begins(k)) op.memory[k] = begun.memory[k];
}

}  // namespace

std::vector<KnownPair> known_pairs(const System& system, const OperatingPoint& op) {
  std::vector<KnownPair> list;
  if (!has_source<PairStateSource>(system)) return list;
  const Layout& layout = system.layout();
  const std::vector<EntryKey> bodies = body_keys(layout);
  std::vector<PairStates> states;
  const Motion motion = system.motion(op);
  for_each_source<PairStateSource>(
      system, [&](const ElementSet&, const PairStateSource& source) { source.pair_states(motion, states); });
  for (const PairStates& s : states) {
    KnownPair pair{.of = {std::string(s.of->statement), s.of->id, "", 0},
                   .joint = s.joint,
                   .motion = std::string(s.motion),
                   .ends = {},
                   .directions = s.directions,
                   .radius = s.radius};
    for (std::size_t k = 0; k < 2; ++k) {
      const PairStates::End& end = s.ends[k];
      pair.ends[k] = {layout.marker_label(end.marker).id,
                      bodies[static_cast<std::size_t>(layout.marker(end.marker).body.index)], end.at, end.axis};
    }
    list.push_back(std::move(pair));
  }
  return list;
}

ChangedPairs take_over_pairs(const std::vector<KnownPair>& before, const System& to, OperatingPoint& op) {
  ChangedPairs changed;
  std::map<Id, const KnownPair*> known;
  for (const KnownPair& pair : before) known.emplace(id_of(pair.of), &pair);
  if (known.empty()) return changed;
  const Layout& layout = to.layout();
  std::map<Id, std::vector<std::size_t>> states;
  for (std::size_t k = 0; k < layout.states.size(); ++k)
    if (const ElementLabel* owner = layout.states[k].owner) states[{owner->statement, owner->id}].push_back(k);
  std::set<Id> begun;
  const std::vector<KnownPair> pairs = known_pairs(to, op);
  for (const KnownPair& now : pairs) {
    const auto was = known.find(id_of(now.of));
    if (was == known.end() || same_markers(*was->second, now)) continue;
    const std::vector<std::size_t>& places = states[id_of(now.of)];
    if (!now.slips()) {
      changed.found.insert(places.begin(), places.end());
      continue;
    }
    const auto by = turned(*was->second, now);
    const Turned none(places.size(), std::vector<double>(places.size(), 0.0));
    const std::vector<double> creep = times(by.value_or(none), op.state, places),
                              rate = times(by.value_or(none), op.state_rate, places);
    for (std::size_t k = 0; k < places.size(); ++k) op.state[places[k]] = creep[k], op.state_rate[places[k]] = rate[k];
    if (!by) changed.anew.push_back(now.of.text());
    begun.insert(id_of(now.of));
  }
  begin_memory(to, begun, op);
  return changed;
}

void begin_as_found(const System& system, const std::set<std::size_t>& states, OperatingPoint& op) {
  if (states.empty()) return;
  const Layout& layout = system.layout();
  const auto begins = [&](std::int32_t k) { return k >= 0 && states.contains(static_cast<std::size_t>(k)); };
  for (const std::size_t k : states) op.state[k] = layout.states[k].initial;  // angles count from there
  ConstraintRows rows;
  rows.resize(layout);
  system.constraints(system.motion(op), rows);
  for (std::size_t k = 0; k < layout.rows.size(); ++k) {
    const ConstraintRow& r = layout.rows[k];
    const Taylor& off = rows.along_motion(static_cast<std::int32_t>(k));
    if (begins(r.course)) op.state[static_cast<std::size_t>(r.course)] += off.value;
    if (begins(r.course_rate)) op.state[static_cast<std::size_t>(r.course_rate)] += off.rate;
  }
}

}  // namespace dynalin
