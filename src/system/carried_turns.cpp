#include "system/carried_turns.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace dynalin {

namespace {

// So far may axes be from parallel, by their sine, that are held parallel to rounding.
constexpr double sine_of_parallel = 1e-6;

// An angle that is turned by a rotation of one body in another.
struct Turning {
  AngleName name;
  const MarkerPlace *I, *J;

  static std::optional<Turning> of(const AngleName& name, const System& system) {
    const auto i = system.model().find_marker(name.i), j = system.model().find_marker(name.j);
    if (!i || !j) return std::nullopt;
    for (const MarkerId m : {*i, *j})
      if (system.model().marker(m).floating || system.layout().marker(m).shapes) return std::nullopt;
    return Turning{name, &system.layout().marker(*i), &system.layout().marker(*j)};
  }
  double principal(const Motion& motion) const {
    return principal_angle(name.measure, motion.axes(*I), motion.axes(*J));
  }
  Vector axis(const Motion& motion, const MarkerPlace& m) const {
    return motion.axes(m)[static_cast<std::size_t>(name.measure) - static_cast<std::size_t>(Measure::AX)];
  }
  Vector axis(const Motion& motion) const { return axis(motion, *J); }
  std::pair<std::int32_t, std::int32_t> bodies() const { return std::minmax({I->body.index, J->body.index}); }
};

// How often one angle turns as the other does: once, backwards, or 0 where that is not known.
int turns_with(const Turning& a, const Turning& b, const Motion& motion) {
  const bool same = a.I->body == b.I->body && a.J->body == b.J->body;
  const bool swapped = a.I->body == b.J->body && a.J->body == b.I->body;
  if (!same && !swapped) return 0;
  const Vector along = a.axis(motion);
  for (const Vector& other : {a.axis(motion, *a.I), b.axis(motion, *b.I), b.axis(motion)})
    if (!(norm(cross(along, other)) < sine_of_parallel)) return 0;
  return (dot(along, b.axis(motion)) > 0) == same ? 1 : -1;
}

}  // namespace

KnownTurns known_turns(const System& system, const OperatingPoint& op) {
  KnownTurns known;
  const std::vector<AngleName> names = angle_names(system.layout());
  for (std::size_t k = 0; k < names.size(); ++k)
    known.emplace(names[k], op.memory[static_cast<std::size_t>(system.layout().angles[k].memory)]);
  return known;
}

std::vector<AngleName> take_over_turns(const KnownTurns& known, const System& system, OperatingPoint& op) {
  const Layout& layout = system.layout();
  const std::vector<AngleName> names = angle_names(layout);
  std::vector<std::size_t> unknown;
  for (std::size_t k = 0; k < names.size(); ++k) {
    double& total = op.memory[static_cast<std::size_t>(layout.angles[k].memory)];
    if (const auto it = known.find(names[k]); it != known.end())
      total = it->second;
    else
      unknown.push_back(k);
  }
  if (unknown.empty()) return {};

  // Those of the same two bodies alone come into question.
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::pair<Turning, double>>> others;
  for (const auto& [name, total] : known)
    if (const auto turning = Turning::of(name, system)) others[turning->bodies()].emplace_back(*turning, total);
  const Motion here = system.motion(op), drawn = system.motion(system.drawn());
  std::vector<AngleName> begun;
  for (const std::size_t k : unknown) {
    const auto turning = Turning::of(names[k], system);
    std::optional<double> near;
    if (const auto of_pair = turning ? others.find(turning->bodies()) : others.end(); of_pair != others.end()) {
      for (const auto& [other, total] : of_pair->second) {
        const int way = turns_with(*turning, other, here);
        if (way == 0) continue;
        near = way * total + turning->principal(drawn) - way * other.principal(drawn);
        break;
      }
    }
    if (!near) begun.push_back(names[k]);
    op.memory[static_cast<std::size_t>(layout.angles[k].memory)] = near.value_or(0.0);
  }
  system.count_turns(here, op.memory);
  return begun;
}

}  // namespace dynalin
