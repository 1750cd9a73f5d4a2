#include "system/carry_over.h"

#include <algorithm>
#include <map>
#include <set>

#include "mechanics/stated_memory_source.h"
#include "mechanics/stiction_source.h"
#include "system/carried_past.h"
#include "system/carried_turns.h"
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

// Courses of motions that nothing knows yet and nothing states begin with the displacement and the velocity that the
// point has.
void take_up_courses(const System& system, const std::vector<bool>& known, OperatingPoint& op) {
  const Layout& layout = system.layout();
  const auto begins = [&](std::int32_t k) {
    return k >= 0 && !known[static_cast<std::size_t>(k)] && layout.states[static_cast<std::size_t>(k)].goes_on;
  };
  const auto has_course = [&](const ConstraintRow& r) { return begins(r.course) || begins(r.course_rate); };
  if (std::none_of(layout.rows.begin(), layout.rows.end(), has_course)) return;
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

// Bristles between markers that an edit has swapped: with the sign that their states have now, or 0 where these are
// others.
using Swapped = std::map<std::pair<std::string_view, std::int64_t>, double>;
Swapped swapped_bristles(const System& from, const System& to) {
  const auto all = [](const System& system) {
    std::vector<BristlesBetween> list;
    for_each_source<StictionSource>(system,
                                    [&](const ElementSet&, const StictionSource& source) { source.surfaces(list); });
    return list;
  };
  using Ends = std::pair<std::int64_t, std::int64_t>;
  const auto ends = [](const System& s, const BristlesBetween& b) {
    return Ends(s.layout().marker_label(b.i).id, s.layout().marker_label(b.j).id);
  };
  std::map<std::pair<std::string_view, std::int64_t>, Ends> before;
  for (const BristlesBetween& b : all(from)) before[{b.of->statement, b.of->id}] = ends(from, b);
  Swapped swapped;
  for (const BristlesBetween& b : all(to)) {
    const auto was = before.find({b.of->statement, b.of->id});
    const Ends now = ends(to, b);
    if (was == before.end() || now.first == now.second || was->second != Ends(now.second, now.first)) continue;
    swapped[was->first] = b.opposite_from_other_end ? -1 : 0;
  }
  return swapped;
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

// What no element has remembered before begins at the point, and so does what bristles saw from the other end.
void take_over_memory(const System& from, const OperatingPoint& op, const System& to, const Restated& restated,
                      const Swapped& swapped, OperatingPoint& out) {
  OperatingPoint begun = out;
  begun.mode = AnalysisMode::initial_conditions;
  to.remember(begun);
  out.memory = std::move(begun.memory);
  const std::set<std::size_t> stated = stated_memory(to, restated);
  for (const auto& [a, b] : matches(memory_keys(from.layout()), memory_keys(to.layout()))) {
    const ElementLabel* owner = to.layout().memory_owners[b].element;
    const bool begins = owner && (restated.begins(*owner) || swapped.contains({owner->statement, owner->id}));
    if (!begins && !stated.contains(b)) out.memory[b] = op.memory[a];
  }
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

  for (const auto& [a, b] : matches(row_keys(old), row_keys(now))) out.lambda[b] = op.lambda[a];

  for (const auto& [a, b] : matches(value_keys(old), value_keys(now))) {
    const ElementLabel* owner = now.algebraic[b].owner;
    if (!owner || !restated.begins(*owner)) out.algebraic[b] = op.algebraic[a];
  }

  std::vector<bool> known(now.states.size(), false);
  const Swapped swapped = swapped_bristles(from, to);
  for (const auto& [a, b] : matches(state_keys(old), state_keys(now))) {
    const ElementLabel* owner = now.states[b].owner;
    if (now.states[b].type == StateType::delay) continue;  // these are numbered anew
    if (begins(restated, now.states[b])) continue;
    const auto turned = owner ? swapped.find({owner->statement, owner->id}) : swapped.end();
    const double sign = turned == swapped.end() ? 1 : turned->second;
    if (sign == 0) continue;
    out.state[b] = sign * op.state[a];
    out.state_rate[b] = sign * op.state_rate[a];
    known[b] = true;
  }

  for (const auto& [a, b] : matches(delay_keys(old), delay_keys(now))) {
    const std::int32_t before = old.delay_calls[a].state, after = now.delay_calls[b].state;
    if (before < 0 || after < 0) continue;
    copy_block(op.state, before, out.state, after, 1);
    copy_block(op.state_rate, before, out.state_rate, after, 1);
  }

  take_over_memory(from, op, to, restated, swapped, out);
  take_over_turns(known_turns(from, op), to, out);
  if (op.delays) {
    std::vector<KeptPast> kept;
    const std::vector<EntryKey> calls = delay_keys(old);
    for (std::size_t k = 0; k < calls.size(); ++k) kept.push_back({calls[k], &op.delays->of_call[k]});
    out.delays = histories_of(pasts_of(delay_keys(now), kept));
  }
  take_up_courses(to, known, out);
  return out;
}

}  // namespace dynalin
