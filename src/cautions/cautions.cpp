#include "cautions/cautions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/dense_solvers.h"
#include "cautions/motion_caution.h"
#include "cautions/stiction_caution.h"
#include "linear/configuration.h"
#include "linear/reach.h"

namespace dynalin {

namespace {

void singular_configuration(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                            Diagnostics& out) {
  const auto gained = freedoms_gained(system, op, linear);
  if (!gained) return;
  std::vector<std::string> rows;
  for (const std::int32_t r : gained->rows) rows.push_back(system.row_text(r));
  out.warning("singular-configuration", system.layout().rows[static_cast<std::size_t>(gained->rows.front())].owner->at,
              fmt::format("the configuration is singular: {} {} redundant here and not right beside it; the model has "
                          "{} more degree{} of "
                          "freedom than nearby, and modes and frequencies change abruptly",
                          fmt::join(rows, ", "), rows.size() == 1 ? "is" : "are", gained->count,
                          gained->count == 1 ? "" : "s"));
}

void empty_rows(const System& system, const OperatingPoint& op, Diagnostics& out) {
  for (const std::int32_t r : rows_that_hold_nothing(system, op)) {
    out.warning("empty-constraint", system.layout().rows[static_cast<std::size_t>(r)].owner->at,
                fmt::format("{} holds nothing here: no small motion changes it, and what it is to hold moves freely",
                            system.row_text(r)));
  }
}

void disproportion(const System& system, const LinearSystem& linear, Diagnostics& out) {
  constexpr double disproportionate = 1e5;
  const auto found = largest_disproportion(system, linear, disproportionate);
  if (!found) return;
  const StateLabel& s = linear.model.states[found->state];
  out.warning("near-singular", {},
              fmt::format("near a singular configuration: {} moves {:.1e} times as far as the chosen {} of {}",
                          system.layout().coordinate_text(found->coordinate), found->times, s.text, s.owner.text()));
}

// Files of matrices show all digits that a number has, with no word of how many are right.
void few_digits(const System& system, const OperatingPoint& op, const LinearSystem& linear, Diagnostics& out) {
  constexpr double worth_a_word = 1e-8;
  const LeastKnownRate found = least_known_rate(system, op, linear);
  if (found.part <= worth_a_word) return;
  const StateLabel& s = linear.model.states[found.state];
  out.warning(
      "rounded-matrix", {},
      fmt::format("rounding leaves few digits: what the matrices make of the rate of {} of {} may be off by {:.0e} "
                  "of its size",
                  s.text, s.owner.text(), found.part));
}

// A difference in a slope that the linear model does not see, or a jump.
void kinks(const System& system, const Motion& motion, Diagnostics& out) {
  for (const Kink& k : system.kinks(motion)) out.warning("kink", k.of->at, k.text);
}

// A vibration that is damped just so much that it does not swing has two equal values and one shape: rounding moves
// them apart along either axis, by far more than the equal values of equal parts.
bool at_the_limit(const EigenSolution& modes, const EigenMode& m) {
  constexpr double rounding = 1e-11, apart_by_chance = 1e-6, one_vector = 1e12;
  const double size = std::abs(m.eigenvalue_hz);
  if (m.cluster_size > 1) return m.error_bound_hz > rounding * size;
  return std::ranges::any_of(modes.modes, [&](const EigenMode& other) {
    const double distance = std::abs(m.eigenvalue_hz - other.eigenvalue_hz),
                 bound = m.error_bound_hz + other.error_bound_hz;
    if (&other == &m || !other.is_real) return false;
    return std::isfinite(bound)
               ? bound > rounding * size && distance <= bound
               : distance <= apart_by_chance * size && (distance > rounding * size || m.condition > one_vector);
  });
}

// Of so many zeros of bodies, those that stand alone, beside a value that falls, as of a part that nothing but a damper
// holds: a freedom that nothing holds at all has a chain of two, a shape and the velocity in which it grows.
int zeros_that_stand_alone(const EigenSolution& modes, const std::vector<Eigen::Index>& zeros) {
  if (zeros.empty()) return 0;
  constexpr double dependent = 1e-9;
  const Eigen::MatrixXd shapes = modes.vectors(Eigen::all, zeros).real().colwise().normalized();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(shapes);
  qr.setThreshold(dependent);
  return std::max(0, 2 * static_cast<int>(qr.rank()) - static_cast<int>(zeros.size()));
}

void overdamping(const System& system, const LinearSystem& linear, const EigenSolution& modes, Diagnostics& out) {
  if (modes.without_damping) return;
  int falling = 0, growing = 0, elsewhere = 0;
  std::vector<Eigen::Index> zeros;
  const EigenMode* slowest = nullptr;
  std::size_t number = 0;
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const EigenMode& m = modes.modes[k];
    if (!system.model().find_body(m.mover.statement, m.mover.id)) {
      elsewhere += m.is_real ? 1 : 2;
      continue;
    }
    if (m.structural_zero) zeros.push_back(static_cast<Eigen::Index>(k));
    if (!m.is_real || m.eigenvalue_hz == 0.0 || at_the_limit(modes, m)) continue;
    const bool falls = m.eigenvalue_hz.real() < 0;
    ++(falls ? falling : growing);
    if (falls && !slowest) slowest = &m, number = k + 1;
  }
  // Coordinates of first order and states of controllers bring one real mode each, and there are as many of the states
  // among those of bodies as no mode of their own shows: a controller that moves bodies is no vibration behind them.
  const int of_controllers = std::max(0, static_cast<int>(linear.differential_states) - elsewhere);
  const int alone = growing + zeros_that_stand_alone(modes, zeros);
  const int pairs = (falling - alone - static_cast<int>(linear.first_order) - of_controllers) / 2;
  if (pairs < 1 || !slowest) return;
  out.warning("overdamped-modes", {},
              fmt::format("{} mode{} overdamped, the slowest is mode {} of {}: with NODAMPIN the vibrations behind "
                          "them show",
                          pairs, pairs == 1 ? " is" : "s are", number, slowest->moves_most));
}

Diagnostics cautions_of_point(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                              const EigenSolution* modes, double left_by_integration) {
  Diagnostics out;
  singular_configuration(system, op, linear, out);
  empty_rows(system, op, out);
  disproportion(system, linear, out);
  motion_caution(system, op, modes, left_by_integration, out);
  const Motion motion = system.motion(op);
  kinks(system, motion, out);
  for (const BodySource* body : system.bodies()) body->add_cautions(motion, out);
  return out;
}

}  // namespace

Diagnostics cautions_of_matrices(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                                 double left_by_integration) {
  Diagnostics out = cautions_of_point(system, op, linear, nullptr, left_by_integration);
  few_digits(system, op, linear, out);
  return out;
}

Diagnostics cautions(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                     const EigenSolution& modes, double left_by_integration) {
  Diagnostics out = cautions_of_point(system, op, linear, &modes, left_by_integration);
  overdamping(system, linear, modes, out);
  stiction_cautions(system, op, linear, modes, out);
  return out;
}

}  // namespace dynalin
