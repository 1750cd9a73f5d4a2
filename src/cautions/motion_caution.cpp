#include "cautions/motion_caution.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/row_sizes.h"
#include "analysis/static_equations.h"
#include "base/clearly_larger.h"
#include "dataset/characters.h"
#include "system/mass_centres.h"

namespace dynalin {

namespace {

constexpr double slight = 1e-6;    // accelerations beside gravity and the slowest mode, forces beside those at play
constexpr double unseen = 1e-9;    // turn beside the slowest mode, acceleration beside gravity and what that mode does
constexpr double roundings = 100;  // that forces may be off: the estimate counts each number once
constexpr double stated_digits = 1e-10;    // to which a dataset states coordinates, of the model's length
constexpr double unresisted = 1e-14;       // of a part's stiffness, along the whole model: forces that are nothing
constexpr double left_by_solving = 1e-12;  // what solving may leave of one movement beside the others

// Of the slowest mode that is not a structural zero [rad/time]; 0 if there is none.
double slowest_mode(const EigenSolution& modes) {
  double least = std::numeric_limits<double>::infinity();
  for (const EigenMode& m : modes.modes) {
    const double hz = std::abs(m.eigenvalue_hz);
    if (!m.structural_zero && hz > m.error_bound_hz) least = std::min(least, hz);
  }
  return std::isfinite(least) ? 2 * std::numbers::pi * least : 0.0;
}

// Which coordinates have forces on them that do not balance: they accelerate.
class Unbalanced {
 public:
  // Coordinates are known to a part of the model's length; accelerations below the least one are none.
  Unbalanced(const System& system, OperatingPoint op, double known, double least) : equations_(system) {
    const Eigen::VectorXd acceleration = as_vector(op.acceleration), velocity = as_vector(op.velocity);
    std::ranges::fill(op.acceleration, 0.0);
    equations_.look_at_motion();
    equations_.evaluate(op, Partials::yes);
    force_ = equations_.residual().head(acceleration.size());
    // What has no mass is in balance at any time: it accelerates as long as dampers move it.
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(acceleration.size()),
                          of_mass = equations_.forces_of_motion(still, acceleration),
                          of_dampers = equations_.forces_of_motion(velocity, still);
    for (Eigen::Index k = 0; k < force_.size(); ++k) {
      if (of_mass(k) == 0 && acceleration(k) != 0) force_(k) = of_dampers(k);
    }
    is_far_ = !(distance(known) <= known) || prescribed_acceleration(op) > least;
  }
  // Of coordinates that accelerate slightly: by what forces do that are stated to a few digits.
  bool any(std::int32_t first, std::int32_t count, bool slightly) const {
    for (std::int32_t k = first; is_far_ && k < first + count; ++k) {
      const double r = std::abs(force_(k));
      const bool by_digits = slightly && r <= slight * equations_.magnitude()(k);
      if (!by_digits && r > roundings * equations_.rounding()(k)) return true;
    }
    return false;
  }

 private:
  static Eigen::VectorXd as_vector(const std::vector<double>& x) {
    return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  }
  // How far displacements would have to go for balance, to first order, as a part of the model's length. Where nothing
  // resists them a little of the stiffness of each part does, or rounding of its forces would go far.
  double distance(double known) {
    equations_.measure_by(Yardstick::part);
    SparseLu lu;
    if (!equations_.factor(lu, equations_.tangent(unresisted / known, 1)))
      return std::numeric_limits<double>::infinity();
    Eigen::MatrixXd way = Eigen::MatrixXd::Zero(equations_.residual().size(), 1);
    way.topRows(force_.size()) = force_;
    lu.solve(way);
    double most = 0;
    for (Eigen::Index k = 0; k < force_.size(); ++k)
      most = std::max(most, std::abs(way(k, 0)) / equations_.system().coordinate_scale(static_cast<std::int32_t>(k)));
    return most;
  }

  // What constraints ask for besides, as those of motions do: no displacement brings it to an end.
  double prescribed_acceleration(const OperatingPoint& without_acceleration) const {
    const System& system = equations_.system();
    ConstraintRows rows;
    rows.resize(system.layout());
    system.constraints(system.motion(without_acceleration), rows);
    double most = 0;
    for (std::int32_t k = 0; k < rows.size(); ++k) {
      const Taylor along = rows.along_motion(k);
      const double asked = rows.level(k) == RowLevel::position ? along.acceleration : along.rate;
      most = std::max(most, std::abs(asked) * system.length() / row_scale(system, rows.row(k)));
    }
    return most;
  }

  StaticEquations equations_;
  Eigen::VectorXd force_;
  bool is_far_ = true;
};

// What turns are compared with: the slowest mode, or without modes what gravity makes of the size of the model.
double slowest_motion(const System& system, const EigenSolution* modes) {
  return modes ? slowest_mode(*modes) : std::sqrt(norm(system.model().gravity) / system.length());
}

struct Movement {
  double acceleration = 0, turning = 0, spin_up = 0, deformation = 0;
  double of_shape = 0;  // deformation as far as it moves anything [length/time²]

  double size(double length) const { return acceleration + length * (turning * turning + spin_up); }
  // The same, and 0 for what is rounding.
  Movement seen(double length) const {
    const double least = left_by_solving * std::max(size(length), of_shape);
    Movement m = *this;
    if (acceleration <= least) m.acceleration = 0;
    if (length * turning * turning <= left_by_solving * least) m.turning = 0;
    if (length * spin_up <= least) m.spin_up = 0;
    if (of_shape <= least) m.deformation = 0;
    return m;
  }
};

std::vector<Movement> movements(const System& system, const Motion& motion) {
  std::vector<Movement> of(motion.bodies.size());
  const std::vector<Vec3<Taylor>> centres = mass_centres(system, motion);
  for (std::size_t b = 1; b < of.size(); ++b) {
    const BodyMotion& m = motion.bodies[b];
    // Of the mass centre: where the origin of a part lies is the choice of its author.
    of[b] = {norm(acceleration(centres[b])), norm(m.w), norm(m.wdot)};
  }
  return of;
}

}  // namespace

void motion_caution(const System& system, const OperatingPoint& op, const EigenSolution* modes,
                    double left_by_integration, Diagnostics& out) {
  const Layout& layout = system.layout();
  const double L = system.length(), slowest = slowest_motion(system, modes);
  const Motion motion = system.motion(op);
  std::vector<Movement> movement = movements(system, motion);
  double least = std::numeric_limits<double>::infinity();
  for (const double a : {norm(system.model().gravity), L * slowest * slowest})
    if (a > 0) least = std::min(least, a);
  if (!std::isfinite(least)) least = 0;
  const auto turns = [&](const Movement& m) { return m.turning > std::max(unseen, left_by_integration) * slowest; };
  const auto accelerates = [&](const Movement& m, double part) {
    return m.acceleration + L * m.spin_up > part * least;
  };

  std::vector<bool> counts(movement.size(), false);
  const bool bends = std::ranges::any_of(layout.extras, &ExtraBlock::is_deformation);
  const auto may_accelerate = [&](const Movement& m) { return accelerates(m, unseen); };
  if (bends || std::any_of(movement.begin() + 1, movement.end(), may_accelerate)) {
    const Unbalanced unbalanced(system, op, std::max(stated_digits, left_by_integration), unseen * least);
    for (std::size_t b = 1; b < movement.size(); ++b) {
      const BodyBlock& block = layout.bodies[b];
      const Movement& m = movement[b];
      counts[b] = may_accelerate(m) && unbalanced.any(block.offset, block.count, !accelerates(m, slight));
    }
    for (const ExtraBlock& e : layout.extras) {
      if (!e.is_deformation()) continue;
      const auto owner = std::ranges::find_if(
          layout.bodies, [&](const BodyBlock& b) { return b.label.element() == e.label.element(); });
      if (owner == layout.bodies.end()) continue;
      const auto b = static_cast<std::size_t>(owner - layout.bodies.begin());
      const auto first = motion.extra_acceleration.begin() + static_cast<std::ptrdiff_t>(layout.extra_index(e.offset));
      Movement m = movement[b];
      double of_block = 0;
      for (std::int32_t k = 0; k < e.count; ++k) {
        const double q = std::abs(first[k]), moves = q * L / system.coordinate_scale(e.offset + k);
        m.deformation = std::max(m.deformation, q);
        of_block = std::max(of_block, moves);
      }
      if (!unbalanced.any(e.offset, e.count, of_block <= slight * least)) continue;
      m.of_shape = std::max(m.of_shape, of_block);
      movement[b] = m;
      counts[b] = counts[b] || m.deformation > 0;
    }
  }

  std::size_t most = 0;
  for (std::size_t b = 1; b < movement.size(); ++b) {
    if (!counts[b] && !turns(movement[b])) continue;
    if (most == 0 || is_clearly_larger(movement[b].size(L), movement[most].size(L), equal_solutions)) most = b;
  }
  if (most == 0) return;
  const Movement m = movement[most].seen(L);
  const ElementLabel& part = layout.bodies[most].label;
  const bool is_node =
      std::ranges::count_if(layout.bodies, [&](const BodyBlock& b) { return b.label.element() == part.element(); }) > 1;
  const Units& units = system.model().units;
  const std::string time = units.time_symbol();
  const std::string length = units.length.empty() ? "length" : lower_case(units.length);
  out.warning("accelerating-point", part.at,
              fmt::format("the operating point accelerates or turns, most of all {0} (acceleration of {7} {1:.5g} "
                          "{4}/{5}², angular velocity {2:.5g} rad/{5}, angular acceleration {3:.5g} rad/{5}²{6}): {8}",
                          part.full_text(), m.acceleration, m.turning, m.spin_up, length, time,
                          m.deformation > 0 ? fmt::format(", of a coordinate of its shape {:.5g}", m.deformation) : "",
                          is_node ? "one of its nodes" : "its mass centre",
                          modes ? "the eigenvalues hold for this instant, and mode shapes may be strange"
                                : "the matrices hold for this instant"));
}

void reference_caution(const System& system, const OperatingPoint& op, const EigenSolution* modes, MarkerId reference,
                       double left_by_integration, Diagnostics& out) {
  const Marker& marker = system.model().marker(reference);
  const Motion motion = system.motion(op);
  const double speed = norm(rate(motion.frame(marker.place).origin)), turning = norm(motion.body(marker.place.body).w);
  const double L = system.length(), least = std::max(unseen, left_by_integration) * slowest_motion(system, modes);
  if (speed <= L * least && turning <= least) return;
  const Units& units = system.model().units;
  std::vector<std::string> of_nodes;
  for (const BodyBlock& block : system.layout().bodies) {
    const std::string name = block.label.text();
    if (block.is_node() && std::ranges::find(of_nodes, name) == of_nodes.end()) of_nodes.push_back(name);
  }
  out.warning("moving-reference", marker.label->at,
              fmt::format("RM=MARKER/{} moves at this point (velocity {:.5g} {}/{}, angular velocity {:.5g} rad/{}): "
                          "eigenvalues, shapes and transfer functions are those seen from a moving frame{}",
                          marker.label->id, speed, units.length.empty() ? "length" : lower_case(units.length),
                          units.time_symbol(), turning, units.time_symbol(),
                          of_nodes.empty() ? ""
                                           : fmt::format(", but for nodes of {}, whose states are displacements along "
                                                         "global axes as without RM",
                                                         fmt::join(of_nodes, ", "))));
}

}  // namespace dynalin
