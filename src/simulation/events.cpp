#include "simulation/events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace dynalin {

Events::Events(const System& system) : system_(&system) {
  system.switches(system.motion(system.drawn()), scratch_, list_);
  switches_ = list_.value.size();
  for (const EventSource* source : system.event_sources()) sensors_ += source->event_count();
}

void Events::values(const Motion& motion, std::span<double> values) {
  system_->switches(motion, scratch_, list_);
  for (const EventSource* source : system_->event_sources()) source->crossings(motion, scratch_, list_);
  assert(list_.value.size() == size() && values.size() == size());
  // Where a change of sign means nothing there is none.
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = list_.counts[k] ? list_.value[k] : 1.0;
}

void Events::watched(const Motion& motion, std::span<double> values) {
  list_.clear();
  for (const EventSource* source : system_->event_sources()) source->crossings(motion, scratch_, list_);
  assert(list_.value.size() == sensors_ && values.size() == sensors_);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = list_.counts[k] ? list_.value[k] : 1.0;
}

bool Events::watched_is_finite(const Motion& motion) {
  if (sensors_ == 0) return true;
  list_.clear();
  for (const EventSource* source : system_->event_sources()) source->crossings(motion, scratch_, list_);
  return !list_.any_undefined;
}

EventAction Events::at_start(OperatingPoint& op) {
  EventAction action;
  const Motion motion = system_->motion(op);
  for (const EventSource* source : system_->event_sources()) source->act_at_start(motion, op.memory, action);
  finish(action, op);
  return action;
}

EventAction Events::at(std::span<const int> crossed, OperatingPoint& op) {
  assert(crossed.size() == size());
  EventAction action;
  const Motion motion = system_->motion(op);
  system_->switches(motion, scratch_, list_);
  for (std::size_t k = 0; k < switches_; ++k) action.restart = action.restart || (crossed[k] != 0 && list_.counts[k]);
  std::span<const int> rest = crossed.subspan(switches_);
  for (const EventSource* source : system_->event_sources()) {
    source->act(motion, rest.first(source->event_count()), op.memory, action);
    rest = rest.subspan(source->event_count());
  }
  finish(action, op);
  return action;
}

std::vector<int> Events::passed(std::span<const double> from, std::span<const double> to) const {
  std::vector<int> all(size(), 0);
  const auto sign = [](double v) { return (v > 0) - (v < 0); };
  for (std::size_t k = switches_; k < std::min({all.size(), from.size(), to.size()}); ++k)
    if (sign(from[k]) != 0 && sign(from[k]) != sign(to[k])) all[k] = -sign(from[k]);
  return all;
}

void Events::finish(EventAction& action, const OperatingPoint& op) const {
  if (action.dump) action.text += dump_of(*system_, op);
}

std::string dump_of(const System& system, const OperatingPoint& op) {
  const Layout& layout = system.layout();
  std::string text = fmt::format("values at time {:.10g}\n", op.time);
  const auto line = [&](const std::string& name, std::span<const double> values) {
    text += "  " + name + ":";
    for (const double v : values) text += fmt::format(" {:.10g}", v);
    text += '\n';
  };
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    const Pose& pose = op.poses[b];
    line(block.label.full_text() + " origin", std::array{pose.r.x, pose.r.y, pose.r.z});
    for (const auto& [axis, e] : {std::pair{" x axis", pose.R.x}, std::pair{" y axis", pose.R.y}})
      if (block.turns()) line(block.label.full_text() + axis, std::array{e.x, e.y, e.z});
  }
  for (std::int32_t k = 0; k < layout.coordinate_count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (k >= layout.body_coordinate_count)
      line(layout.coordinate_text(k),
           std::array{op.extra[layout.extra_index(k)], op.velocity[at], op.acceleration[at]});
    else
      line(layout.coordinate_text(k) + ", rates", std::array{op.velocity[at], op.acceleration[at]});
  }
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(layout.row_count()); ++k)
    line("multiplier of " + system.row_text(k), std::array{op.lambda[static_cast<std::size_t>(k)]});
  for (std::size_t k = 0; k < layout.algebraic.size(); ++k) {
    const AlgebraicUnknown& a = layout.algebraic[k];
    const std::string component = a.component > 0 ? fmt::format(", component {}", a.component) : "";
    line(a.owner->full_text() + component, std::array{op.algebraic[k]});
  }
  for (std::size_t k = 0; k < layout.states.size(); ++k)
    line(fmt::format("state {} of {}", layout.states[k].coordinate, layout.states[k].owner->full_text()),
         std::array{op.state[k], op.state_rate[k]});
  return text;
}

}  // namespace dynalin
