#include "modal/mode_shapes.h"

#include <array>
#include <cmath>

#include "base/parallel.h"
#include "modal/mass_root.h"

namespace dynalin {

namespace {

// Ties within this go to the body that comes first.
constexpr double equal_shares = 1e-6;

// The body that moves furthest, by √(|δr_C|² + L²|δθ|²); null if none moves.
const ElementLabel* furthest(const System& system, const OperatingPoint& op, const Eigen::VectorXcd& dq) {
  const Layout& layout = system.layout();
  const double L2 = system.length() * system.length();
  double most = 0;
  const ElementLabel* mover = nullptr;
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    const Vector c = op.poses[b].R * system.model().bodies[b].p_BC;
    double size = 0;
    for (const bool imaginary : {false, true}) {
      const auto part = [&](std::int32_t k) {
        const std::complex<double> x = dq(block.offset + k);
        return imaginary ? x.imag() : x.real();
      };
      const Vector r{part(0), part(1), part(2)};
      const Vector turn = block.turns() ? Vector{part(3), part(4), part(5)} : Vector{};
      const Vector of_cm = r + cross(turn, c);
      size += dot(of_cm, of_cm) + L2 * dot(turn, turn);
    }
    if (size > most * (1 + equal_shares)) most = size, mover = &block.label;
  }
  return mover;
}

// The body with the largest share of the kinetic energy, null if nothing that has mass moves.
const ElementLabel* most_energetic(const System& system, const MassRoot& root, const Eigen::VectorXcd& v) {
  Eigen::MatrixXd columns(v.size(), 2);
  columns << v.real(), v.imag();
  const Eigen::MatrixXd weighed = root.of(columns);
  double most = 0;
  const ElementLabel* mover = nullptr;
  for (std::size_t k = 0; k < root.bodies(); ++k) {
    const double energy = weighed.middleRows(root.first_row(k), root.rows(k)).squaredNorm();
    if (energy > most * (1 + equal_shares)) most = energy, mover = &system.layout().bodies[root.body(k)].label;
  }
  return mover;
}

}  // namespace

void name_movers(const System& system, const OperatingPoint& op, const LinearSystem& linear, EigenSolution& solution) {
  const auto states = static_cast<Eigen::Index>(linear.model.states.size());
  const auto differential = states - static_cast<Eigen::Index>(linear.kinematic_states);
  const MassRoot root(system, op);
  std::vector<Eigen::Index> rates;
  for (Eigen::Index k = 0; k < states; ++k) {
    if (linear.model.states[static_cast<std::size_t>(k)].is_rate) rates.push_back(k);
  }
  in_parallel(solution.modes.size(), [&](std::size_t m) {
    const Eigen::VectorXcd z = solution.vectors.col(static_cast<Eigen::Index>(m));
    const auto displacements = [&]() -> Eigen::VectorXcd { return linear.displacements(z).col(0); };
    EigenMode& mode = solution.modes[m];
    const bool at_rest = mode.eigenvalue_hz == std::complex<double>(0);
    Eigen::VectorXcd of_rates = Eigen::VectorXcd::Zero(states);
    of_rates(rates) = z(rates);
    const ElementLabel* body =
        most_energetic(system, root, at_rest ? displacements() : Eigen::VectorXcd(linear.velocities(of_rates).col(0)));
    // A freedom without mass is what a mode may consist of; controllers that turn it are named before it.
    if (!body && z.tail(differential).norm() <= 1e-9 * z.norm()) body = furthest(system, op, displacements());
    if (body) {
      mode.mover = body->element();
      mode.moves_most = body->full_text();
      return;
    }
    const Eigen::Index first = differential > 0 ? states - differential : 0;
    Eigen::Index k = 0;
    z.tail(states - first).cwiseAbs().maxCoeff(&k);
    mode.mover = solution.states[static_cast<std::size_t>(first + k)].owner;
    mode.moves_most = mode.mover.text();
  });
}

void map_shapes(const System& system, const LinearSystem& linear, EigenSolution& solution) {
  static constexpr std::array<std::string_view, 6> names = {"X", "Y", "Z", "RX", "RY", "RZ"};
  const Layout& layout = system.layout();
  const auto states = static_cast<Eigen::Index>(linear.model.states.size());
  const auto differential = static_cast<Eigen::Index>(linear.differential_states);
  const auto n = static_cast<Eigen::Index>(layout.coordinate_count);
  solution.shape_labels.assign(static_cast<std::size_t>(n + differential), {});
  for (const BodyBlock& b : layout.bodies) {
    for (std::int32_t k = 0; k < b.count; ++k) {
      solution.shape_labels[static_cast<std::size_t>(b.offset + k)] = {
          b.label.element(), std::string(b.label.view_name), std::string(names[static_cast<std::size_t>(k)])};
    }
  }
  for (const ExtraBlock& e : layout.extras) {
    for (std::int32_t k = 0; k < e.count; ++k) {
      solution.shape_labels[static_cast<std::size_t>(e.offset + k)] = {
          e.label.element(), std::string(e.label.view_name), e.coordinates[static_cast<std::size_t>(k)].name};
    }
  }
  for (Eigen::Index k = 0; k < differential; ++k) {
    const StateLabel& s = linear.model.states[static_cast<std::size_t>(states - differential + k)];
    solution.shape_labels[static_cast<std::size_t>(n + k)] = {s.owner, "", s.text};
  }
  solution.shapes.resize(n + differential, solution.vectors.cols());
  solution.shapes.topRows(n) = linear.displacements(solution.vectors);
  solution.shapes.bottomRows(differential) = solution.vectors.bottomRows(differential);
  for (Eigen::Index c = 0; c < solution.shapes.cols(); ++c) {
    Eigen::Index largest = 0;
    auto shape = solution.shapes.col(c);
    if (shape.size() == 0) continue;
    shape.cwiseAbs().maxCoeff(&largest);
    const std::complex<double> unit = shape(largest);
    if (unit == 0.0) continue;
    shape /= unit;
    shape(largest) = 1;
  }
}

}  // namespace dynalin
