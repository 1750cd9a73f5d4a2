#include "linear/modal_distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "linear/original_states.h"
#include "linear/wrench_work.h"
#include "mechanics/pair_blocks.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;

}  // namespace

ModalDistribution::ModalDistribution(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                                     const EigenSolution& solution)
    : system_(system),
      linear_(linear),
      solution_(solution),
      motion_(system.motion(op)),
      flexible_(system.model().bodies.size()) {
  for (const FlexibleBody& f : flexible_bodies(system.model())) flexible_[static_cast<std::size_t>(f.body.index)] = f;
  beams_ = beam_bodies(system.model(), system.layout());
  beam_of_.assign(flexible_.size(), nullptr);
  node_.assign(flexible_.size(), 0);
  for (const BeamBody& b : beams_) {
    beam_of_[static_cast<std::size_t>(b.nodes.front().index)] = &b;
    for (std::size_t k = 0; k < b.nodes.size(); ++k) node_[static_cast<std::size_t>(b.nodes[k].index)] = b.numbers[k];
  }
  motion_.mode = AnalysisMode::linear;  // a DELAY follows what it delays, as in linearize()
  ConstraintRows rows;
  rows.resize(system.layout());
  eq_.resize(system.layout());
  eq_.keep_sizes();
  system.constraints(motion_, rows);
  system.equations(motion_, rows, eq_,
                   {PartialBy::position, PartialBy::damping, PartialBy::velocity, PartialBy::algebraic});
  eq_.clear_undefined();  // linearize() has refused those that count
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

// ½ m |v_C|² and ½ ωᴴ J ω term by term, global axes.
std::array<double, 9> ModalDistribution::kinetic_terms(std::size_t body, const Eigen::VectorXcd& v) const {
  if (beam_of_[body]) return beam_terms(*beam_of_[body], v);
  if (node_[body] > 0) return {};  // the first one has it all
  const Body& b = system_.model().bodies[body];
  const BodyBlock& block = system_.layout().bodies[body];
  std::array<double, 9> terms{};
  ComplexVector3 of_cm = three(v, block.offset);
  ComplexVector3 w{};
  const Matrix3& R = motion_.bodies[body].R;
  if (block.turns()) {
    w = three(v, block.offset + 3);
    add(of_cm, times(-skew(R * b.p_BC), w));
  }
  // In user units: no factor of consistency.
  const double factor = b.mass > 0 ? b.user_mass / b.mass : 1.0;
  for (std::size_t k = 0; k < 3; ++k) terms[k] = 0.5 * b.user_mass * std::norm(of_cm[k]);
  const Matrix3 about = flexible_[body]
                            ? flexible_[body]->flexible->inertia.tensor_at(modal_coordinates(*flexible_[body]))
                            : factor * b.J_BC;
  const Matrix3 J = R * about * transpose(R);
  for (std::size_t k = 0; k < 3; ++k) terms[3 + k] = 0.5 * J(k, k) * std::norm(w[k]);
  const auto product = [&](std::size_t i, std::size_t j) { return J(i, j) * std::real(w[i] * std::conj(w[j])); };
  terms[6] = product(0, 1), terms[7] = product(0, 2), terms[8] = product(1, 2);
  return terms;
}

std::array<double, 9> ModalDistribution::beam_terms(const BeamBody& b, const Eigen::VectorXcd& v) const {
  std::array<double, 9> terms{};
  for (std::size_t e = 0; e < b.elements->size(); ++e) {
    const BeamMotion motion = b.motion(motion_, e);
    const auto own = rows_of(b.columns(system_.layout(), e), v);
    for (const BeamVector& part : {BeamVector(own.real()), BeamVector(own.imag())}) {
      const auto twice = (*b.elements)[e]->kinetic_terms(motion, part);
      for (std::size_t k = 0; k < terms.size(); ++k) terms[k] += 0.5 * system_.model().units.ucf * twice[k];
    }
  }
  return terms;
}

double ModalDistribution::beam_work(const BeamBody& b, const Eigen::VectorXcd& u, PartialBy family) const {
  double sum = 0;
  BeamForces f;
  for (std::size_t e = 0; e < b.elements->size(); ++e) {
    (*b.elements)[e]->forces(b.motion(motion_, e), {}, true, f);
    const auto own = rows_of(b.columns(system_.layout(), e), u);
    const BeamMatrix& m = family == PartialBy::position ? f.stiffness : f.damping;
    for (const BeamVector& part : {BeamVector(own.real()), BeamVector(own.imag())}) sum += part.dot(m * part);
  }
  return sum;
}

Eigen::VectorXd ModalDistribution::modal_coordinates(const FlexibleBody& f) const {
  return Eigen::Map<const Eigen::VectorXd>(motion_.extra.data() + f.first, f.flexible->modes());
}

double ModalDistribution::flexible_energy(const FlexibleBody& f, const Eigen::VectorXcd& v) const {
  const BodyBlock& block = system_.layout().body(f.body);
  const Matrix3& R = motion_.body(f.body).R;
  Eigen::VectorXcd local(6 + f.flexible->modes());
  for (std::size_t part = 0; part < 2; ++part) {
    for (std::size_t k = 0; k < 3; ++k) {
      Complex sum = 0;
      for (std::size_t c = 0; c < 3; ++c) sum += R(c, k) * v(block.offset + static_cast<Eigen::Index>(3 * part + c));
      local(static_cast<Eigen::Index>(3 * part + k)) = sum;
    }
  }
  local.tail(f.flexible->modes()) =
      v.segment(system_.layout().body_coordinate_count + static_cast<Eigen::Index>(f.first), f.flexible->modes());
  const Eigen::MatrixXd M = f.flexible->inertia.matrix(modal_coordinates(f));
  return 0.5 * (local.real().dot(M * local.real()) + local.imag().dot(M * local.imag()));
}

std::vector<ModalRow<double>> ModalDistribution::flexible_rows(const Eigen::VectorXcd& u, PartialBy family) const {
  std::vector<ModalRow<double>> rows;
  for (const auto& f : flexible_) {
    if (!f) continue;
    const Eigen::VectorXcd q =
        u.segment(system_.layout().body_coordinate_count + static_cast<Eigen::Index>(f->first), f->flexible->modes());
    const Eigen::MatrixXd& m = family == PartialBy::position ? f->flexible->stiffness : f->flexible->damping;
    ModalRow<double> row{&system_.layout().body(f->body).label, 0,
                         std::vector<double>(7, std::numeric_limits<double>::quiet_NaN())};
    row.values[0] = 0.5 * (q.real().dot(m * q.real()) + q.imag().dot(m * q.imag()));
    rows.push_back(std::move(row));
  }
  for (const BeamBody& b : beams_) {
    ModalRow<double> row{b.label, 0, std::vector<double>(7, std::numeric_limits<double>::quiet_NaN())};
    row.values[0] = 0.5 * beam_work(b, u, family);
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
    for (const std::size_t b : bodies_by_id()) {
      if (flexible_[b]) {
        sum += flexible_energy(*flexible_[b], v);
        continue;
      }
      for (const double term : kinetic_terms(b, v)) sum += term;
    }
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
    rows.push_back({&block.label, node_[b], {of_cm[0], of_cm[1], of_cm[2], turn[0], turn[1], turn[2]}});
  }
  const auto& states = system_.layout().states;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!states[k].varies()) continue;
    // The states of the model follow the coordinates, by type and id.
    const auto found = std::find_if(solution_.states.begin(), solution_.states.end(), [&](const StateLabel& s) {
      return s.type == states[k].type && s.element == states[k].owner->id && s.coordinate == states[k].coordinate;
    });
    const bool several = std::count_if(states.begin(), states.end(), [&](const DifferentialState& other) {
                           return other.owner == states[k].owner;
                         }) > 1;
    rows.push_back({states[k].owner, several ? states[k].coordinate : 0, {z(found - solution_.states.begin())}});
  }
  Complex largest = 0;
  for (const auto& row : rows) {
    for (const Complex& v : row.values) {
      if (std::abs(v) > std::abs(largest) * (1 + 1e-12)) largest = v;
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
  std::vector<ModalRow<double>> rows;
  double total = 0;
  for (const std::size_t b : bodies_by_id()) {
    if (node_[b] > 0 && !beam_of_[b]) continue;
    const auto terms = kinetic_terms(b, v);
    ModalRow<double> row{&system_.layout().bodies[b].label, 0, {terms.begin(), terms.end()}};
    double sum = 0;
    for (const double t : terms) sum += t;
    const bool any_flexible = std::ranges::any_of(flexible_, [](const auto& f) { return f.has_value(); });
    if (flexible_[b]) {
      const double whole = flexible_energy(*flexible_[b], v);
      row.values.push_back(whole - sum);
      sum = whole;
    } else if (any_flexible) {
      row.values.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    row.values.push_back(sum);
    total += sum;
    rows.push_back(std::move(row));
  }
  for (auto& row : rows) {
    for (double& x : row.values) x = total != 0 ? 100 * x / total : 0;
  }
  return rows;
}

}  // namespace dynalin
