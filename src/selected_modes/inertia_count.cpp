#include "selected_modes/inertia_count.h"

#include <cmath>

#include "base/arbitrary_vector.h"
#include "perturbation/perturbation.h"

namespace dynalin {

using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;

// From displacements v the equations have the accelerations a(v). If T v = −a(v) − σ v is singular at no place between
// the equations and what was factored, both have as many ω² below σ: the powers of 1 − (factored)⁻¹ T shrink.
bool InertiaCount::stands_for_the_equations(double sigma) const {
  constexpr int steps = 4;
  const ConservativeModel& model = factors_.model();
  const PerturbationEquations& equations = model.equations();
  const auto size = [&](const Matrix& v) { return std::sqrt(std::abs(v.col(0).dot(model.forces(v).col(0)))); };
  Matrix x = Matrix::Zero(equations.states(), 1);
  const Eigen::VectorXd start = arbitrary_vector(equations.states(), 3).real();
  for (const std::int32_t k : model.positions()) x(k, 0) = start(k);
  Matrix v = factors_.solve(model.forces(equations.complete(x, SparseLu::Refined::no).topRows(model.coordinates())));
  for (int step = 0; step < steps; ++step) {
    const double before = size(v);
    if (!(before > 0) || !std::isfinite(before)) return step > 0 && before == 0;
    // Of v as the equations have it, to the last digit.
    const Matrix all = equations.complete(model.states_of(v));
    v = all.topRows(model.coordinates());
    v -= factors_.solve(model.forces(-all.middleRows(equations.accelerations(), model.coordinates()) - sigma * v));
    if (!(size(v) <= largest_difference * before)) return false;
  }
  return true;
}

std::optional<Index> InertiaCount::below(double sigma) {
  const auto [known, is_new] = below_.try_emplace(sigma);
  if (!is_new) return known->second;
  if (!factors_.factor(sigma) || !stands_for_the_equations(sigma)) return std::nullopt;
  return known->second = factors_.below();
}

std::optional<Index> InertiaCount::eigenvalues_inside(const ModeRegion& region) {
  const auto between = [&](double low, double high) -> std::optional<Index> {
    const auto up_to = below(high), from = up_to ? below(low) : std::nullopt;
    return from ? std::optional(*up_to - *from) : std::nullopt;
  };
  if (!region.is_disc) {
    const auto modes =
        between(region.low > 0 ? region.low * region.low : -region.right * region.right, region.high * region.high);
    return modes ? std::optional(2 * *modes) : std::nullopt;
  }
  if (region.centre.real() != 0) return std::nullopt;
  // Where the circle meets the imaginary axis; below zero it has the other members of pairs, and real values.
  const double far = region.centre.imag() + region.radius, near = region.centre.imag() - region.radius;
  if (near >= 0) return between(near * near, far * far);
  const auto upper = between(far * near, far * far), lower = upper ? between(far * near, near * near) : std::nullopt;
  return lower ? std::optional(*upper + *lower) : std::nullopt;
}

}  // namespace dynalin
