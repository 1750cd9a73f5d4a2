#include "linear/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "analysis/displace.h"
#include "linear/eigen.h"

namespace dynalin {

namespace {

using Solution = std::pair<LinearSystem, EigenSolution>;

std::optional<Solution> modes_at(const System& system, const OperatingPoint& op, std::string& reason) {
  auto linear = linearize(system, op, {});
  if (!linear) {
    reason = linear.error().message;
    return std::nullopt;
  }
  auto modes = eigensolve(*linear);
  if (!modes) {
    reason = modes.error().message;
    return std::nullopt;
  }
  return Solution{std::move(*linear), std::move(*modes)};
}

std::ptrdiff_t structural_zeros(const EigenSolution& modes) {
  return std::count_if(modes.modes.begin(), modes.modes.end(), [](const EigenMode& m) { return m.structural_zero; });
}

// How all coordinates move along the motions that the linear model leaves free, in different shares.
Eigen::VectorXd free_motion(const System& system, const LinearSystem& linear, const EigenSolution& modes) {
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(system.layout().coordinate_count);
  double share = 1;
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    if (!modes.modes[k].structural_zero) continue;
    const Eigen::VectorXd moved = linear.displacements(modes.vectors.col(static_cast<Eigen::Index>(k))).col(0).real();
    double size = 0;
    for (Eigen::Index c = 0; c < moved.size(); ++c)
      size = std::max(size, std::abs(moved(c)) / system.coordinate_scale(static_cast<std::int32_t>(c)));
    if (size > 0) motion += share / size * moved;
    share *= -std::numbers::phi / 2;
  }
  return motion;
}

std::string largest_of(const System& system, const Eigen::VectorXd& motion) {
  std::int32_t most = 0;
  double size = 0;
  for (std::int32_t c = 0; c < motion.size(); ++c) {
    const double moved = std::abs(motion(c)) / system.coordinate_scale(c);
    if (moved > size * (1 + 1e-9)) size = moved, most = c;
  }
  return system.layout().coordinate_text(most);
}

// Whether motions that nothing resists here are resisted, or driven, a little further on: then their force begins with
// a higher order than the linear model has. Where the model is free it stays so.
bool is_free_here_alone(const System& system, const OperatingPoint& at_rest, const Eigen::VectorXd& motion,
                        std::ptrdiff_t zeros) {
  constexpr double distance = 1e-3;
  OperatingPoint there = at_rest;
  displace(system, there, distance * motion, {1.0});
  Findings ignored;
  auto moved = assemble_position(system, std::move(there), ignored);
  if (moved) moved = solve_acceleration(system, std::move(*moved), ignored);
  if (!moved) return true;
  std::string unused;
  const auto beside = modes_at(system, *moved, unused);
  return !beside || structural_zeros(beside->second) < zeros;
}

}  // namespace

Stability stability_of(const System& system, const OperatingPoint& at_rest) {
  constexpr std::size_t affordable = 300;
  Stability s;
  if (system.coordinates() > affordable) {
    s.reason = "the model is too large to look at it in passing, LINEAR/EIGENSOL tells";
    return s;
  }
  const auto found = modes_at(system, at_rest, s.reason);
  if (!found) return s;
  const auto& [linear, modes] = *found;
  double largest = 0;
  for (const EigenMode& m : modes.modes) largest = std::max(largest, std::abs(m.eigenvalue_hz));
  for (const EigenMode& m : modes.modes) s.growing_modes += m.eigenvalue_hz.real() > 1e-7 * largest;
  if (s.growing_modes > 0) {
    s.verdict = Stability::Verdict::unstable;
    return s;
  }
  const Eigen::VectorXd motion = free_motion(system, linear, modes);
  if (motion.size() > 0 && motion.cwiseAbs().maxCoeff() > 0 &&
      is_free_here_alone(system, at_rest, motion, structural_zeros(modes))) {
    s.reason =
        fmt::format("to first order nothing holds {} here, and beside this point something does or drives it away",
                    largest_of(system, motion));
    return s;
  }
  s.verdict = Stability::Verdict::stable;
  return s;
}

std::string Stability::text() const {
  switch (verdict) {
    case Verdict::stable:
      return "nothing grows";
    case Verdict::unstable:
      return fmt::format("unstable: {} {}", growing_modes, growing_modes == 1 ? "mode grows" : "modes grow");
    case Verdict::unknown:
      break;
  }
  return "stability not known: " + reason;
}

}  // namespace dynalin
