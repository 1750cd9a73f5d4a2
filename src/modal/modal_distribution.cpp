#include "modal/modal_distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/clearly_larger.h"
#include "mechanics/pair_blocks.h"
#include "modal/wrench_work.h"
#include "perturbation/perturbed_point.h"
#include "states/original_states.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;

}  // namespace

ModalDistribution::ModalDistribution(const System& system, const LinearSystem& linear, const EigenSolution& solution)
    : system_(system), linear_(linear), solution_(solution), motion_(linear.at->motion), eq_(linear.at->equations) {
  if (linear.principal_states) {
    CandidateSet set;
    set.gradients.resize(system.layout(), static_cast<std::size_t>(system.layout().body_coordinate_count));
    set.gradients.begin();
    add_principal_candidates(system, motion_, 0, set);
    original_ = std::move(set.gradients);
  }
  // The algebraic block alone: ∂a/∂w.
  const auto n = system.layout().coordinate_count;
  const auto w = static_cast<std::int32_t>(system.layout().algebraic.size());
  std::vector<Triplet> entries;
  for_each_entry(eq_.matrix(PartialBy::algebraic), [&](std::int32_t r, std::int32_t c, double v) {
    if (r >= n && r < n + w) entries.push_back({r - n, c, v});
  });
  if (w > 0) algebraic_solved_ = algebraic_.factor(compressed(w, w, entries));
}

Eigen::VectorXcd ModalDistribution::scaled_vector(std::size_t mode) const {
  Eigen::VectorXcd z = solution_.vectors.col(static_cast<Eigen::Index>(mode));
  Eigen::Index largest = 0;
  z.cwiseAbs().maxCoeff(&largest);
  return z / z(largest);
}

Eigen::VectorXcd ModalDistribution::displacements(const Eigen::VectorXcd& z) const { return linear_.displacements(z); }

Eigen::VectorXcd ModalDistribution::velocities(const Eigen::VectorXcd& z) const {
  // Without mass velocities follow from forces, which positions and differential states make as well.
  if (linear_.has_massless_states) return linear_.velocities(z);
  Eigen::VectorXcd rates = z;
  for (Eigen::Index k = 0; k < rates.size(); ++k) {
    if (!solution_.states[static_cast<std::size_t>(k)].is_rate) rates(k) = 0;
  }
  return linear_.velocities(rates);
}

std::vector<std::size_t> ModalDistribution::bodies_by_id() const {
  std::vector<std::size_t> order;
  const auto& bodies = system_.layout().bodies;
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    if (bodies[b].count > 0) order.push_back(b);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return bodies[a].label.id < bodies[b].label.id; });
  return order;
}

std::vector<std::pair<const ElementLabel*, KineticEnergy>> ModalDistribution::kinetic_energies(
    const Eigen::VectorXcd& v) const {
  std::vector<std::pair<const ElementLabel*, KineticEnergy>> list;
  for (const BodySource* body : system_.bodies())
    list.emplace_back(&system_.layout().body(body->bodies().front()).label, body->kinetic_energy(motion_, v));
  std::ranges::stable_sort(list, {}, [](const auto& of) { return of.first->id; });
  return list;
}

std::vector<ModalRow<double>> ModalDistribution::rows_of_bodies(const Eigen::VectorXcd& u, PartialBy family) const {
  std::vector<ModalRow<double>> rows;
  for (const BodySource* body : system_.bodies()) {
    const std::optional<double> work = body->own_work(motion_, family, u);
    if (!work) continue;
    ModalRow<double> row{&system_.layout().body(body->bodies().front()).label, 0,
                         std::vector<double>(7, std::numeric_limits<double>::quiet_NaN())};
    row.values[0] = 0.5 * *work;
    rows.push_back(std::move(row));
  }
  std::ranges::stable_sort(rows, {},
                           [](const ModalRow<double>& r) { return std::pair(r.element->statement, r.element->id); });
  return rows;
}

double ModalDistribution::largest_original(const Eigen::VectorXcd& z) const {
  const Eigen::VectorXcd dq = displacements(z);
  double largest = 0;
  for (std::int32_t k = 0; k < original_->size(); ++k) {
    Complex p = 0;
    for (const auto& entry : original_->row(k)) p += entry.c.g * dq(entry.column);
    largest = std::max(largest, std::abs(p));
  }
  return largest;
}

ModeHeader ModalDistribution::header(std::size_t mode) const {
  const Complex hz = solution_.modes[mode].eigenvalue_hz;
  const double size = std::abs(hz), omega = 2 * std::numbers::pi * size;
  Eigen::VectorXcd z = scaled_vector(mode);
  if (original_) {
    // Rates of the coordinates are among the entries that the default compares.
    const double largest = std::max(1.0, omega) * largest_original(z);
    if (largest > 0) z /= largest;
  }
  const auto energy = [&](const Eigen::VectorXcd& v) {
    double sum = 0;
    for (const auto& of : kinetic_energies(v)) sum += of.second.total();
    return sum;
  };
  ModeHeader h;
  h.frequency = size;
  if (size == 0) {
    h.mass = 2 * energy(displacements(z));
    return h;
  }
  h.damping_ratio = std::abs(hz.real()) / size;
  h.kinetic_energy = energy(velocities(z));
  h.stiffness = 2 * h.kinetic_energy;
  h.mass = h.stiffness / (omega * omega);
  return h;
}

std::pair<std::vector<ModalRow<Complex>>, Complex> ModalDistribution::shape(std::size_t mode) const {
  const Eigen::VectorXcd z = scaled_vector(mode), dq = displacements(z);
  std::vector<ModalRow<Complex>> rows;
  for (const std::size_t b : bodies_by_id()) {
    const BodyBlock& block = system_.layout().bodies[b];
    ComplexVector3 of_cm = three(dq, block.offset), turn{};
    if (block.turns()) {
      turn = three(dq, block.offset + 3);
      add(of_cm, times(-skew(motion_.bodies[b].R * system_.model().bodies[b].p_BC), turn));
    }
    rows.push_back({&block.label, block.listed.node, {of_cm[0], of_cm[1], of_cm[2], turn[0], turn[1], turn[2]}});
  }
  // As they stand among the states of the linear model, by type and id.
  const auto& states = system_.layout().states;
  for (std::size_t at = solution_.states.size() - solution_.differential_states; at < solution_.states.size(); ++at) {
    const StateLabel& s = solution_.states[at];
    const auto of = std::ranges::find_if(states, [&](const DifferentialState& state) {
      return state.varies() && s.type == state.type && s.element == state.owner->id && s.coordinate == state.coordinate;
    });
    const bool several = std::ranges::count(states, of->owner, &DifferentialState::owner) > 1;
    rows.push_back({of->owner, several ? of->coordinate : 0, {z(static_cast<Eigen::Index>(at))}});
  }
  Complex largest = 0;
  for (const auto& row : rows) {
    for (const Complex& v : row.values) {
      if (is_clearly_larger(std::abs(v), std::abs(largest))) largest = v;
    }
  }
  return {std::move(rows), largest};
}

std::vector<ModalRow<Complex>> ModalDistribution::coordinates(std::size_t mode) const {
  auto [rows, largest] = shape(mode);
  for (auto& row : rows) {
    for (Complex& v : row.values) v = largest == Complex(0) ? Complex(0) : v / largest;
  }
  return std::move(rows);
}

std::vector<ModalRow<Complex>> ModalDistribution::markers(std::size_t mode, std::span<const MarkerId> list) const {
  const Complex largest = shape(mode).second;
  const Eigen::VectorXcd dq = displacements(scaled_vector(mode));
  const Layout& layout = system_.layout();
  std::vector<ModalRow<Complex>> rows;
  for (const MarkerId m : list) {
    const MarkerPlace& place =
        layout.marker(system_.signals().place_of(m));  // a floating one is where its force puts it
    ComplexVector3 moved{}, turned{};
    for_each_block(motion_, place, layout, [&](const PairBlock& b) {
      ComplexVector3 moves{};
      for (std::size_t k = 0; k < b.count; ++k) moves[k] = dq(b.column + static_cast<std::int32_t>(k));
      add(moved, times(b.moves, moves));
      add(turned, times(b.turns, moves));
    });
    ModalRow<Complex> row{&layout.marker_label(m)};
    row.carrier = &layout.body(layout.marker(m).body).label;
    for (const ComplexVector3& part : {moved, turned}) {
      for (const Complex& v : part) row.values.push_back(largest == Complex(0) ? Complex(0) : v / largest);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<ModalRow<double>> ModalDistribution::kinetic(std::size_t mode) const {
  const Eigen::VectorXcd z = scaled_vector(mode);
  const bool at_rest = solution_.modes[mode].eigenvalue_hz == Complex(0);
  const Eigen::VectorXcd v = at_rest ? displacements(z) : velocities(z);
  const auto energies = kinetic_energies(v);
  const bool any_shapes = std::ranges::any_of(energies, [](const auto& of) { return of.second.whole.has_value(); });
  std::vector<ModalRow<double>> rows;
  double total = 0;
  for (const auto& [label, energy] : energies) {
    ModalRow<double> row{label, 0, {energy.terms.begin(), energy.terms.end()}};
    if (any_shapes)
      row.values.push_back(energy.whole ? *energy.whole - energy.sum() : std::numeric_limits<double>::quiet_NaN());
    row.values.push_back(energy.total());
    total += energy.total();
    rows.push_back(std::move(row));
  }
  for (auto& row : rows) {
    for (double& x : row.values) x = total != 0 ? 100 * x / total : 0;
  }
  return rows;
}

}  // namespace dynalin
