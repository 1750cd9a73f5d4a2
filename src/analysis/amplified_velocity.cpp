#include "analysis/amplified_velocity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/velocity_norm.h"
#include "dataset/characters.h"

namespace dynalin {

namespace {

constexpr double amplified = 1000;

// Of one body: its mass centre and its turn, in lengths of the model and by its length.
struct BodySpeed {
  double of_centre = 0, turning = 0;
  double size(double length) const { return std::max(of_centre, length * turning); }
};

BodySpeed speed_of(const System& system, const Motion& motion, std::size_t body, const Eigen::VectorXd& velocity) {
  const BodyBlock& block = system.layout().bodies[body];
  const auto at = [&](std::int32_t k) { return velocity(block.offset + k); };
  if (block.count == 0) return {};
  const Vector v{at(0), at(1), at(2)};
  if (!block.turns()) return {norm(v), 0};
  const Vector w{at(3), at(4), at(5)};
  return {norm(v + cross(w, motion.bodies[body].R * system.model().bodies[body].p_BC)), norm(w)};
}

}  // namespace

void warn_of_amplified_velocity(const System& system, const Motion& motion, const StatedChange& change,
                                std::span<const VelocityCondition> stated,
                                const Eigen::Ref<const Eigen::VectorXd>& multipliers, Diagnostics& warnings) {
  // The change is as large, by the norm that it is the least of, as what each statement adds to: multiplier by miss.
  const VelocityCondition* most_asking = nullptr;
  double asked = 0, most_added = 0;
  for (std::size_t k = 0; k < stated.size(); ++k) {
    const double off = std::abs(miss(stated[k], change.before).value);
    const double added = std::abs(multipliers(static_cast<Eigen::Index>(k))) * off;
    asked = std::max(asked, off * unit_of(system, stated[k]));
    if (added > most_added) most_asking = &stated[k], most_added = added;
  }
  const double L = system.length();
  const Eigen::VectorXd added = change.after - change.before;
  std::size_t fastest = 0;
  BodySpeed speed;
  for (std::size_t b = 1; b < system.layout().bodies.size(); ++b) {
    const BodySpeed s = speed_of(system, motion, b, added);
    if (s.size(L) > speed.size(L)) fastest = b, speed = s;
  }
  if (!most_asking || !(speed.size(L) > amplified * asked)) return;
  const Units& units = system.model().units;
  warnings.warning(
      "amplified-velocity", most_asking->at,
      fmt::format("the initial velocity {} = {:g} is kept by others that are {:.3g} times as large, most of all of {} "
                  "(mass centre {:.5g} {}/{}, angular velocity {:.5g} rad/{})",
                  most_asking->text, most_asking->value, speed.size(L) / asked,
                  system.layout().bodies[fastest].label.full_text(), speed.of_centre,
                  units.length.empty() ? "length" : lower_case(units.length), units.time_symbol(), speed.turning,
                  units.time_symbol()),
      "near a dead centre state the velocity of the part that turns, and not of the one that it hardly moves");
}

}  // namespace dynalin
