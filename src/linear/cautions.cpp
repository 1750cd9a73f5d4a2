#include "linear/cautions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cmath>
#include <numbers>

#include "linear/configuration.h"
#include "linear/reach.h"
#include "linear/stiction_caution.h"

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
  constexpr double far = 1e5;
  const auto found = largest_disproportion(system, linear, far);
  if (!found) return;
  const StateLabel& s = linear.model.states[found->state];
  out.warning("near-singular", {},
              fmt::format("near a singular configuration: {} moves {:.1e} times as far as the chosen {} of {}",
                          system.layout().coordinate_text(found->coordinate), found->times, s.text, s.owner.text()));
}

void motion(const System& system, const OperatingPoint& op, const EigenSolution& modes, Diagnostics& out) {
  // Against what the fastest mode does to the model as a whole, and gravity.
  double fastest = 0;
  for (const EigenMode& m : modes.modes) fastest = std::max(fastest, 2 * std::numbers::pi * std::abs(m.eigenvalue_hz));
  const double L = system.length();
  const double scale = std::max(norm(system.model().gravity), L * fastest * fastest);
  double most = std::max(1e-6 * scale, 1e-12 * L);
  struct {
    const ElementLabel* part = nullptr;
    double acceleration, turning, spin_up;
  } found{};
  const Motion motion = system.motion(op);
  for (std::size_t b = 1; b < motion.bodies.size(); ++b) {
    const BodyMotion& m = motion.bodies[b];
    // Of the mass centre: where the origin of a part lies is the choice of its author.
    const double a = norm(m.rddot + m.Rddot * system.model().bodies[b].p_BC), w = norm(m.w), spin_up = norm(m.wdot);
    const double size = a + L * (w * w + spin_up);
    if (size > most * (1 + 1e-9)) most = size, found = {&system.layout().bodies[b].label, a, w, spin_up};
  }
  if (!found.part) return;
  const Units& units = system.model().units;
  const std::string time = units.time_symbol();
  std::string length = units.length.empty() ? "length" : units.length;
  for (char& c : length) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  out.warning(
      "accelerating-point", found.part->at,
      fmt::format("the operating point accelerates or turns, most of all {0} (acceleration of its mass centre {1:.5g} "
                  "{4}/{5}², angular velocity {2:.5g} rad/{5}, angular acceleration {3:.5g} rad/{5}²): the "
                  "eigenvalues hold for this instant, and mode shapes may be strange",
                  found.part->full_text(), found.acceleration, found.turning, found.spin_up, length, time));
}

void overdamping(const System& system, const LinearSystem& linear, const EigenSolution& modes, Diagnostics& out) {
  if (modes.without_damping) return;
  int falling = 0, others = 0;
  const EigenMode* slowest = nullptr;
  std::size_t number = 0;
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const EigenMode& m = modes.modes[k];
    if (!m.is_real || !system.model().find_body(m.mover.statement, m.mover.id)) continue;
    const bool falls = m.eigenvalue_hz.real() < 0;
    ++(falls ? falling : others);
    if (falls && !slowest) slowest = &m, number = k + 1;
  }
  // Coordinates of first order bring one real mode each.
  const int pairs = (falling - others - static_cast<int>(linear.first_order)) / 2;
  if (pairs < 1 || !slowest) return;
  out.warning("overdamped-modes", {},
              fmt::format("{} mode{} overdamped, the slowest is mode {} of {}: with NODAMPIN the vibrations behind "
                          "them show",
                          pairs, pairs == 1 ? " is" : "s are", number, slowest->moves_most));
}

}  // namespace

Diagnostics cautions(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                     const EigenSolution& modes) {
  Diagnostics out;
  singular_configuration(system, op, linear, out);
  empty_rows(system, op, out);
  disproportion(system, linear, out);
  motion(system, op, modes, out);
  overdamping(system, linear, modes, out);
  stiction_cautions(system, op, linear, modes, out);
  return out;
}

}  // namespace dynalin
