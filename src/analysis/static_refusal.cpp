#include "analysis/static_refusal.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/part_names.h"
#include "analysis/settled_reactions.h"
#include "analysis/unheld_motion.h"
#include "base/joined_sets.h"
#include "mechanics/stiction_source.h"
#include "system/sources.h"

namespace dynalin {

namespace {

constexpr double negligible_force = 1e-9;  // of stiffnesses and forces, relative

// "; FRICTION/1 bears 9.8, as much as …" of all whose limit is reached.
std::string exhausted_friction(const System& system, const Motion& motion) {
  std::vector<std::string> sentences;
  for_each_source<StictionSource>(
      system, [&](const ElementSet&, const StictionSource& source) { source.exhausted(motion, sentences); });
  constexpr std::size_t most = 5;
  const std::size_t count = sentences.size();
  if (count > most) sentences.resize(most), sentences.push_back(fmt::format("{} more do the same", count - most));
  return sentences.empty() ? std::string() : fmt::format("; {}", fmt::join(sentences, "; "));
}

}  // namespace

std::vector<std::string> unheld_parts(StaticEquations& equations, const OperatingPoint& op) {
  equations.evaluate(op, Partials::yes);
  if (!equations.residual().allFinite()) return {};
  const System& system = equations.system();
  const Layout& layout = system.layout();
  std::vector<std::size_t> body_of(system.coordinates(), 0);
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    for (std::int32_t k = 0; k < layout.bodies[b].count; ++k)
      body_of[static_cast<std::size_t>(layout.bodies[b].offset + k)] = b;
  }
  const auto body = [&](std::int32_t k) {
    return static_cast<std::size_t>(k) < body_of.size() ? body_of[static_cast<std::size_t>(k)] : 0;
  };
  const ColumnMatrix J = equations.tangent(0, 0);
  const Eigen::VectorXd unit = equations.column_units(op);

  // The sum of forces on a group changes by Σ_columns s_c δ_c. Along a direction e with e · s_c = 0 for all c it is
  // constant, reactions between the parts of the group included.
  JoinedSets groups(layout.bodies.size());  // of bodies that a column of the tangent connects
  std::vector<std::size_t> touched(static_cast<std::size_t>(J.columns), 0);
  std::vector<Eigen::Vector3d> sum(static_cast<std::size_t>(J.columns), Eigen::Vector3d::Zero());
  double largest = 0;
  for_each_entry(J, [&](std::int32_t r, std::int32_t c, double v) {
    const std::size_t b = body(r);
    if (b == 0 || v == 0) return;
    std::size_t& other = touched[static_cast<std::size_t>(c)];
    if (other == 0) other = body(c) != 0 ? body(c) : b;
    groups.join(b, other);
    if (const std::int32_t axis = r - layout.bodies[b].offset; axis < 3) {
      sum[static_cast<std::size_t>(c)](axis) += v * unit(c);
      largest = std::max(largest, std::abs(v * unit(c)));
    }
  });
  std::map<std::size_t, Eigen::Matrix3d> resistance;
  std::map<std::size_t, Eigen::Vector3d> force;
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const std::size_t g = groups.of(b);
    members[g].push_back(b);
    resistance.try_emplace(g, Eigen::Matrix3d::Zero());
    force.try_emplace(g, Eigen::Vector3d::Zero()).first->second -=
        equations.residual().segment<3>(layout.bodies[b].offset);
  }
  for (std::size_t c = 0; c < sum.size(); ++c) {
    if (touched[c] != 0) resistance[groups.of(touched[c])] += sum[c] * sum[c].transpose();
  }
  std::vector<std::string> sentences;
  for (const auto& [g, bodies] : members) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> directions(resistance[g]);
    Eigen::Vector3d left = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) {
      // The eigenvalue itself is a square, whose rounding would hide what is small.
      const Eigen::Vector3d e = directions.eigenvectors().col(k);
      double most = 0;
      for (std::size_t c = 0; c < sum.size(); ++c) {
        if (touched[c] != 0 && groups.of(touched[c]) == g) most = std::max(most, std::abs(e.dot(sum[c])));
      }
      if (most <= negligible_force * largest) left += e.dot(force[g]) * e;
    }
    if (!(left.norm() > negligible_force * equations.force_scale())) continue;
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (std::abs(left(k)) < 1e-6 * left.norm()) left(k) = 0;
    }
    sentences.push_back(fmt::format("nothing holds {} against the force ({:.5g}, {:.5g}, {:.5g})",
                                    part_names(layout, bodies), left(0), left(1), left(2)));
  }
  return sentences;
}

Failure static_refusal(StaticEquations& equations, OperatingPoint op, const std::vector<std::string>& proof,
                       std::vector<std::string> history) {
  const System& system = equations.system();
  Failure f{"statics", "no equilibrium was found", std::move(history), "no-equilibrium"};
  const auto no_value = [&] {
    equations.evaluate(op, Partials::yes);
    const Eigen::VectorXd sum = equations.residual() + equations.rounding();
    if (sum.allFinite()) return false;
    f.message = system.undefined_value(system.motion(op)), f.code = "undefined-value";
    for (Eigen::Index k = 0; k < sum.size() && f.message.empty(); ++k) {
      if (!std::isfinite(sum(k)))
        f.message = "a term in the equation of " + equations.equation_text(k) + " has no finite value or slope";
    }
    return true;
  };
  if (no_value()) return f;
  if (const auto unheld = proof.empty() ? unheld_parts(equations, op) : proof; !unheld.empty()) {
    f.message += fmt::format(": {}", fmt::join(unheld, "; ")) + exhausted_friction(system, system.motion(op));
    return f;
  }
  // What nothing opposes where it comes closest to rest may be held elsewhere, but no search came there.
  if (const auto driven = unheld_everywhere(equations, {op}); !driven.empty()) {
    f.message += fmt::format(": where it is closest to rest {}", fmt::join(driven, "; ")) +
                 exhausted_friction(system, system.motion(op));
    return f;
  }
  settle(equations, op);
  if (no_value()) return f;
  if (equations.has_undefined_partials()) {
    if (const std::string reason = system.undefined_value(system.motion(op)); !reason.empty())
      f.message += ": " + reason;
    return f;
  }
  if (const std::string worst = equations.worst(equations.force_scale()); !worst.empty()) f.message += ": " + worst;
  f.message += exhausted_friction(system, system.motion(op));
  const auto names = undetermined(system, equations.augmented(), equations.tangent(0, 0));
  if (!names.empty()) f.message += fmt::format("; the tangent leaves {} undetermined", fmt::join(names, ", "));
  if (const std::string reason = system.domain_violation(system.motion(op)); !reason.empty())
    f.message += "; " + reason;
  return f;
}

}  // namespace dynalin
