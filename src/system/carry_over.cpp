#include "system/carry_over.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace dynalin {

namespace {

// What an entry belongs to, and which of those entries it is: equal ones are counted.
using Key = std::tuple<std::string, std::int64_t, std::string, std::size_t>;

class Keys {
 public:
  Key next(std::string_view statement, std::int64_t id, std::string_view name) {
    Key key{std::string(statement), id, std::string(name), 0};
    std::get<3>(key) = count_[key]++;
    return key;
  }

 private:
  std::map<Key, std::size_t> count_;
};

// Pairs of places (in `from`, in `to`) with equal keys; `key_of(layout, k, keys)` for each of `count` entries.
template <class KeyOf>
std::vector<std::pair<std::size_t, std::size_t>> matches(const Layout& from, std::size_t from_count, const Layout& to,
                                                         std::size_t to_count, const KeyOf& key_of) {
  std::map<Key, std::size_t> place;
  Keys from_keys, to_keys;
  for (std::size_t k = 0; k < from_count; ++k) place.emplace(key_of(from, k, from_keys), k);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 0; k < to_count; ++k) {
    if (const auto it = place.find(key_of(to, k, to_keys)); it != place.end()) pairs.emplace_back(it->second, k);
  }
  return pairs;
}

Key key_of_owner(const ElementLabel* owner, std::string_view name, Keys& keys) {
  return owner ? keys.next(owner->statement, owner->id, name) : keys.next("", 0, name);
}

Key key_of_place(const Span& at, Keys& keys) {
  return keys.next(at.source ? at.source->name() : std::string(), static_cast<std::int64_t>(at.offset), "");
}

bool is_restated(const Restated& restated, std::string_view statement, std::int64_t id) {
  return restated.starts.contains({std::string(statement), id});
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

// The BCS of body k goes on at another point of the body.
void move_origin(OperatingPoint& op, std::size_t k, std::int32_t offset, const Vector& by) {
  const auto three = [offset](std::vector<double>& values, std::int32_t first) {
    double* x = values.data() + offset + first;
    return Vector{x[0], x[1], x[2]};
  };
  const auto add = [offset](std::vector<double>& values, const Vector& change) {
    for (std::size_t i = 0; i < 3; ++i) values[static_cast<std::size_t>(offset) + i] += change[i];
  };
  const Vector d = op.poses[k].R * by, w = three(op.velocity, 3), alpha = three(op.acceleration, 3);
  op.poses[k].r += d;
  add(op.velocity, cross(w, d));
  add(op.acceleration, cross(alpha, d) + cross(w, cross(w, d)));
}

}  // namespace

OperatingPoint carried_over(const System& from, const OperatingPoint& op, const System& to, const Restated& restated) {
  const Layout &old = from.layout(), &now = to.layout();
  OperatingPoint out = to.drawn();
  out.time = op.time;
  out.mode = op.mode;
  out.redundancy_tolerance = op.redundancy_tolerance;

  const auto body_key = [](const Layout& l, std::size_t k, Keys& keys) {
    return keys.next(l.bodies[k].label.statement, l.bodies[k].label.id, "");
  };
  for (const auto& [a, b] : matches(old, old.bodies.size(), now, now.bodies.size(), body_key)) {
    const BodyBlock &before = old.bodies[a], &after = now.bodies[b];
    if (before.count != after.count || is_restated(restated, after.label.statement, after.label.id)) continue;
    out.poses[b] = op.poses[a];
    copy_block(op.velocity, before.offset, out.velocity, after.offset, after.count);
    copy_block(op.acceleration, before.offset, out.acceleration, after.offset, after.count);
    const Body &was = from.model().bodies[a], &is = to.model().bodies[b];
    if ((was.origin_at.valid() || is.origin_at.valid()) && after.turns())
      move_origin(out, b, after.offset, is.origin_offset - was.origin_offset);
  }

  const auto extra_key = [](const Layout& l, std::size_t k, Keys& keys) {
    return key_of_owner(&l.extras[k].label, "", keys);
  };
  for (const auto& [a, b] : matches(old, old.extras.size(), now, now.extras.size(), extra_key)) {
    const ExtraBlock &before = old.extras[a], &after = now.extras[b];
    if (before.count != after.count) continue;
    copy_block(op.extra, static_cast<std::int32_t>(old.extra_index(before.offset)), out.extra,
               static_cast<std::int32_t>(now.extra_index(after.offset)), after.count);
    copy_block(op.velocity, before.offset, out.velocity, after.offset, after.count);
    copy_block(op.acceleration, before.offset, out.acceleration, after.offset, after.count);
  }

  const auto row_key = [](const Layout& l, std::size_t k, Keys& keys) {
    return key_of_owner(l.rows[k].owner, l.rows[k].name, keys);
  };
  for (const auto& [a, b] : matches(old, old.rows.size(), now, now.rows.size(), row_key)) out.lambda[b] = op.lambda[a];

  const auto value_key = [](const Layout& l, std::size_t k, Keys& keys) {
    return key_of_owner(l.algebraic[k].owner, std::to_string(l.algebraic[k].component), keys);
  };
  for (const auto& [a, b] : matches(old, old.algebraic.size(), now, now.algebraic.size(), value_key)) {
    const ElementLabel* owner = now.algebraic[b].owner;
    if (!owner || !is_restated(restated, owner->statement, owner->id)) out.algebraic[b] = op.algebraic[a];
  }

  const auto state_key = [](const Layout& l, std::size_t k, Keys& keys) {
    return key_of_owner(l.states[k].owner, std::to_string(l.states[k].coordinate), keys);
  };
  std::vector<bool> known(now.states.size(), false);
  for (const auto& [a, b] : matches(old, old.states.size(), now, now.states.size(), state_key)) {
    const ElementLabel* owner = now.states[b].owner;
    if (owner && is_restated(restated, owner->statement, owner->id)) continue;
    out.state[b] = op.state[a];
    out.state_rate[b] = op.state_rate[a];
    known[b] = true;
  }

  // What is remembered belongs to a place in the text, which an edit leaves where it is.
  const auto memory_key = [](const Layout& l, std::size_t k, Keys& keys) {
    return key_of_place(l.memory_owners[k], keys);
  };
  for (const auto& [a, b] : matches(old, old.memory.size(), now, now.memory.size(), memory_key))
    out.memory[b] = op.memory[a];
  if (op.delays && !now.delay_calls.empty()) {
    const auto call_key = [](const Layout& l, std::size_t k, Keys& keys) {
      return key_of_place(l.delay_calls[k], keys);
    };
    auto delays = std::make_shared<DelayHistories>(now.delay_calls.size());
    for (const auto& [a, b] : matches(old, old.delay_calls.size(), now, now.delay_calls.size(), call_key))
      delays->of_call[b] = op.delays->of_call[a];
    out.delays = std::move(delays);
  }
  take_up_courses(to, known, out);
  return out;
}

}  // namespace dynalin
