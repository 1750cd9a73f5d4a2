#include "system/system_binder.h"

#include <algorithm>

#include "elements/controls/spline.h"

namespace dynalin {

void SystemBinder::bind(std::vector<std::unique_ptr<Kernel>>& kernels) {
  for (auto& kernel : kernels) kernel->bind(*this);
  kernels.push_back(std::move(own_));
  delays_.bind(*this);
  make_rates(kernels);
}

Channel SystemBinder::data(const Atom& atom) {
  const Channel c = signals_.data(atom);
  return atom.function->reads == DataSource::state_rate && c.kind != Channel::Kind::none ? rate_of(c) : c;
}

Channel SystemBinder::rate_of(const Channel& c) {
  if (c.kind == Channel::Kind::state && !layout_.states[static_cast<std::size_t>(c.index)].held_in_dynamics)
    return {Channel::Kind::state_rate, c.index, 0};
  if (c.kind != Channel::Kind::algebraic) return {Channel::Kind::constant, 0, 0};
  const auto [it, fresh] = rates_.emplace(c.index, -1);
  if (fresh) {
    const ElementLabel& owner = *layout_.algebraic[static_cast<std::size_t>(c.index)].owner;
    it->second = layout_.add_algebraic(owner);
    layout_.algebraic[static_cast<std::size_t>(c.index)].rate = it->second;
    rates_to_make_.emplace_back(c.index, it->second);
  }
  return {Channel::Kind::algebraic, it->second, 0};
}

Channel SystemBinder::delayed(const Atom& atom) { return delays_.channel_of(atom, place_of(atom.at), layout_); }

// One that is taken out of the model keeps its value.
std::int32_t SystemBinder::sensor_value(std::int64_t id) {
  const auto [it, fresh] = sensor_values_.emplace(id, -1);
  if (fresh) it->second = layout_.add_memory(model_.label(*model_.find("SENSOR", id)), "value");
  return it->second;
}

// Calls of one SPLINE by one method share their curves.
void SystemBinder::attach(SplineUse& use) {
  const bool shares = !use.component && !use.spectrum;
  if (shares) use.curves = curves_[{use.id, use.method}];
  if (use.curves) return;
  attach_data(model_, use);
  if (shares) curves_[{use.id, use.method}] = use.curves;
}

// Equations for the rates that bound expressions asked for; each may ask for more.
void SystemBinder::make_rates(const std::vector<std::unique_ptr<Kernel>>& kernels) {
  while (!rates_to_make_.empty()) {
    const auto [algebraic, rate] = rates_to_make_.back();
    rates_to_make_.pop_back();
    const bool made = std::any_of(kernels.begin(), kernels.end(),
                                  [&, a = algebraic, r = rate](auto& k) { return k->add_rate_equation(a, r, *this); });
    if (made) continue;
    const ElementLabel& owner = *layout_.algebraic[static_cast<std::size_t>(algebraic)].owner;
    problem("unknown-rate", owner.at,
            "a DIF1 or a DELAY needs the time derivative of " + owner.full_text() + ", which is not available",
            "a DELAY needs none as a Padé approximant, run with --pade");
  }
}

// The statement of the dataset in which something stands.
DelayPlace SystemBinder::place_of(const Span& at) const {
  const auto& all = model_.dataset->statements;
  // What a command wrote stands elsewhere than its statement.
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (at.source == all[k].at.source) break;
    for (const WrittenArgument& w : all[k].arguments) {
      const Span v = w.value_span();
      if (v.source == at.source && at.offset >= v.offset && at.offset < v.offset + v.length) return {&all[k], k, true};
    }
  }
  const auto next = std::upper_bound(all.begin(), all.end(), at.offset,
                                     [](std::uint32_t offset, const Statement& s) { return offset < s.at.offset; });
  if (next == all.begin()) return {};
  return {&*std::prev(next), static_cast<std::size_t>(next - all.begin()) - 1, false};
}

}  // namespace dynalin
