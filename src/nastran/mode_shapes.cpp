#include "nastran/mode_shapes.h"

#include <algorithm>
#include <complex>
#include <map>
#include <numbers>

#include "base/clearly_larger.h"
#include "perturbation/perturbed_point.h"

namespace dynalin::nastran {

StudyResult<void> add_modes(const Linearization& of, const OpenPoints& points, Deck& deck) {
  using Complex = std::complex<double>;
  const auto found = modes_of(of, Vectors::right);
  if (!found) return tl::unexpected(found.error());
  const EigenSolution& solution = found->solution;
  const ComplexDenseMatrix moved = of.linear.displacements(solution.vectors);
  const StateChoice& choice = of.linear.at->choice;
  const auto& bodies = of.system->layout().bodies;

  std::map<std::int64_t, std::size_t> grids;  // of bodies
  for (std::size_t b = 1; b < bodies.size(); ++b) grids[points.grid({static_cast<std::int32_t>(b)})] = b;
  // Rows of the modes themselves, or of their displacements.
  struct Row {
    const ComplexDenseMatrix* of;
    Eigen::Index at;
  };
  std::map<std::int64_t, Row> scalar_points;
  for (std::size_t k = 0; k < choice.differential.size(); ++k) {
    scalar_points[points.dof(points.unknown_of_state(choice.differential[k])).point] = {
        &solution.vectors, choice.first_differential + static_cast<Eigen::Index>(k)};
  }
  for (const ExtraBlock& e : of.system->layout().extras) {
    if (!e.is_deformation()) continue;
    for (std::int32_t k = e.offset; k < e.offset + e.count; ++k) scalar_points[points.dof(k).point] = {&moved, k};
  }
  for (const auto& [id, b] : grids) deck.mode_points.push_back(id);
  for (const auto& [id, row] : scalar_points) deck.mode_points.push_back(id);

  for (std::size_t m = 0; m < solution.modes.size(); ++m) {
    const auto column = static_cast<Eigen::Index>(m);
    std::vector<std::array<Complex, 6>> shape;
    for (const auto& [id, b] : grids) {
      std::array<Complex, 6>& u = shape.emplace_back();
      for (std::int32_t k = 0; k < bodies[b].count; ++k)
        u[static_cast<std::size_t>(k)] = moved(bodies[b].offset + k, column);
      const Vector& arm = points.arm({static_cast<std::int32_t>(b)});
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        u[k] += u[3 + i] * arm[j] - u[3 + j] * arm[i];
      }
    }
    for (const auto& [id, row] : scalar_points) shape.push_back({(*row.of)(row.at, column)});
    Complex largest = 0;
    for (const auto& u : shape) {
      for (const Complex& v : u) {
        if (is_clearly_larger(std::abs(v), std::abs(largest))) largest = v;
      }
    }
    const Complex s = solution.modes[m].eigenvalue_hz * (2 * std::numbers::pi);
    DeckMode& mode = deck.modes.emplace_back();
    mode.eigenvalue = {s.real(), s.imag()};
    for (const auto& u : shape) {
      auto& out = mode.shape.emplace_back();
      for (std::size_t k = 0; k < 6; ++k) {
        const Complex v = largest == Complex(0) ? Complex(0) : u[k] / largest;
        out[k] = {v.real(), v.imag()};
      }
    }
  }
  return {};
}

}  // namespace dynalin::nastran
