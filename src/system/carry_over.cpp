#include "system/carry_over.h"

#include <algorithm>
#include <set>

#include "mechanics/stated_memory_source.h"
#include "system/carried_pairs.h"
#include "system/carried_past.h"
#include "system/carried_turns.h"
#include "system/found_followers.h"
#include "system/moved_origin.h"
#include "system/sources.h"

namespace dynalin {

namespace {

// Whether a state begins as it is stated: a course of a MOTION may do so without its rate, and its rate without it.
bool begins(const Restated& restated, const DifferentialState& state) {
  if (!state.owner) return false;
  return state.start_argument.empty() ? restated.begins(*state.owner)
                                      : restated.holds(*state.owner, state.start_argument);
}

void copy_block(const std::vector<double>& from, std::int32_t at, std::vector<double>& to, std::int32_t into,
                std::int32_t count) {
  for (std::int32_t k = 0; k < count; ++k)
    to[static_cast<std::size_t>(into + k)] = from[static_cast<std::size_t>(at + k)];
}

// Entries of the memory that begin as arguments state them which are stated anew.
std::set<std::size_t> stated_memory(const System& system, const Restated& restated) {
  std::set<std::size_t> entries;
  if (restated.empty()) return entries;
  std::vector<StatedMemory> list;
  for_each_source<StatedMemorySource>(
      system, [&](const ElementSet&, const StatedMemorySource& source) { source.stated_memory(list); });
  for (const StatedMemory& m : list) {
    const auto holds = [&](std::string_view argument) { return restated.holds(*m.of, argument); };
    if (std::ranges::any_of(m.arguments, holds)) entries.insert(m.entries.begin(), m.entries.end());
  }
  return entries;
}

// What no element has remembered before begins at the point.
void take_over_memory(const System& from, const OperatingPoint& op, const System& to, const Restated& restated,
                      OperatingPoint& out) {
  OperatingPoint begun = out;
  begun.mode = AnalysisMode::initial_conditions;
  to.remember(begun);
  out.memory = std::move(begun.memory);
  const std::set<std::size_t> stated = stated_memory(to, restated);
  for (const auto& [a, b] : matches(memory_keys(from.layout()), memory_keys(to.layout()))) {
    const ElementLabel* owner = to.layout().memory_owners[b].element;
    if ((!owner || !restated.begins(*owner)) && !stated.contains(b)) out.memory[b] = op.memory[a];
  }
}

RowsBefore rows_before(const System& from, const OperatingPoint& op, const System& to) {
  RowsBefore before(to.layout().row_count());
  if (!has_followers(from.layout()) || !has_followers(to.layout())) return before;
  ConstraintRows rows;
  rows.resize(from.layout());
  from.constraints(from.motion(op), rows);
  for (const auto& [a, b] : matches(row_keys(from.layout()), row_keys(to.layout())))
    before[b] = rows.along_motion(static_cast<std::int32_t>(a)).value;
  return before;
}

}  // namespace

OperatingPoint carried_over(const System& from, const OperatingPoint& op, const System& to, const Restated& restated) {
  const Layout &old = from.layout(), &now = to.layout();
  OperatingPoint out = to.drawn();
  out.time = op.time;
  out.mode = op.mode;
  out.redundancy_tolerance = op.redundancy_tolerance, out.initial_conditions = op.initial_conditions;

  for (const auto& [a, b] : matches(body_keys(old), body_keys(now))) {
    const BodyBlock &before = old.bodies[a], &after = now.bodies[b];
    if (before.count != after.count || restated.begins(after.label)) continue;
    out.poses[b] = op.poses[a];
    copy_block(op.velocity, before.offset, out.velocity, after.offset, after.count);
    copy_block(op.acceleration, before.offset, out.acceleration, after.offset, after.count);
    const Body &was = from.model().bodies[a], &is = to.model().bodies[b];
    if ((was.origin_at.valid() || is.origin_at.valid()) && after.turns())
      move_origin(out, b, after.offset, is.origin_offset - was.origin_offset);
  }

  for (const auto& [a, b] : matches(extra_keys(old), extra_keys(now))) {
    const ExtraBlock &before = old.extras[a], &after = now.extras[b];
    // The shape of a body starts anew with its place.
    if (before.count != after.count || restated.begins(after.label)) continue;
    if (!restated.holds(after.label, after.kind.starts.displacement))
      copy_block(op.extra, static_cast<std::int32_t>(old.extra_index(before.offset)), out.extra,
                 static_cast<std::int32_t>(now.extra_index(after.offset)), after.count);
    copy_block(op.velocity, before.offset, out.velocity, after.offset, after.count);
    copy_block(op.acceleration, before.offset, out.acceleration, after.offset, after.count);
  }

  find_followers(to, rows_before(from, op, to), out);

  for (const auto& [a, b] : matches(row_keys(old), row_keys(now))) out.lambda[b] = op.lambda[a];

  for (const auto& [a, b] : matches(value_keys(old), value_keys(now))) {
    const ElementLabel* owner = now.algebraic[b].owner;
    if (!owner || !restated.begins(*owner)) out.algebraic[b] = op.algebraic[a];
  }

  std::vector<bool> known(now.states.size(), false);
  for (const auto& [a, b] : matches(state_keys(old), state_keys(now))) {
    if (now.states[b].type == StateType::delay) continue;  // these are numbered anew
    if (begins(restated, now.states[b])) continue;
    out.state[b] = op.state[a];
    out.state_rate[b] = op.state_rate[a];
    known[b] = true;
  }

  for (const auto& [a, b] : matches(delay_keys(old), delay_keys(now))) {
    const std::int32_t before = old.delay_calls[a].state, after = now.delay_calls[b].state;
    if (before < 0 || after < 0) continue;
    copy_block(op.state, before, out.state, after, 1);
    copy_block(op.state_rate, before, out.state_rate, after, 1);
  }

  take_over_memory(from, op, to, restated, out);
  std::set<std::size_t> found = take_over_pairs(known_pairs(from, op), to, out).found;
  std::erase_if(found, [&](std::size_t k) { return begins(restated, now.states[k]); });
  // So begin courses that nothing knows yet and nothing states.
  for (std::size_t k = 0; k < now.states.size(); ++k)
    if (now.states[k].goes_on && !known[k]) found.insert(k);
  take_over_turns(known_turns(from, op), to, out);
  if (op.delays) {
    std::vector<KeptPast> kept;
    const std::vector<EntryKey> calls = delay_keys(old);
    for (std::size_t k = 0; k < calls.size(); ++k) kept.push_back({calls[k], &op.delays->of_call[k]});
    out.delays = histories_of(pasts_of(delay_keys(now), kept));
  }
  begin_as_found(to, found, out);
  return out;
}

}  // namespace dynalin
