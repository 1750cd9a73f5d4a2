#include "linear/mode_shapes.h"

#include <array>
#include <cmath>

namespace dynalin {

void name_movers(const System& system, const OperatingPoint& op, const LinearSystem& linear, EigenSolution& solution) {
  const Layout& layout = system.layout();
  const auto states = static_cast<Eigen::Index>(linear.model.states.size());
  const double L2 = system.length() * system.length();
  for (std::size_t m = 0; m < solution.modes.size(); ++m) {
    const Eigen::VectorXcd v = solution.vectors.col(static_cast<Eigen::Index>(m));
    const Eigen::VectorXcd dq = linear.dq.leftCols(states) * v;
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
        const Vector turn = block.count == 6 ? Vector{part(3), part(4), part(5)} : Vector{};
        const Vector of_cm = r + cross(turn, c);
        size += dot(of_cm, of_cm) + L2 * dot(turn, turn);
      }
      // Equal motions within rounding belong to the part that comes first.
      if (size > most * (1 + 1e-6)) most = size, mover = &block.label;
    }
    std::string& name = solution.modes[m].moves_most;
    if (mover && std::sqrt(most) > 1e-9 * system.length() *
                                       v.tail(states - static_cast<Eigen::Index>(linear.kinematic_states)).norm()) {
      name = mover->full_text();
      continue;
    }
    Eigen::Index k = 0;
    v.cwiseAbs().maxCoeff(&k);
    name = solution.states[static_cast<std::size_t>(k)].owner;
  }
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
      solution.shape_labels[static_cast<std::size_t>(b.offset + k)] = {b.label.text(), b.label.view_name,
                                                                       std::string(names[static_cast<std::size_t>(k)])};
    }
  }
  for (const ExtraBlock& e : layout.extras) {
    for (std::int32_t k = 0; k < e.count; ++k) {
      solution.shape_labels[static_cast<std::size_t>(e.offset + k)] = {e.label.text(), e.label.view_name,
                                                                       e.coordinates[static_cast<std::size_t>(k)].name};
    }
  }
  for (Eigen::Index k = 0; k < differential; ++k) {
    const StateLabel& s = linear.model.states[static_cast<std::size_t>(states - differential + k)];
    solution.shape_labels[static_cast<std::size_t>(n + k)] = {s.owner, "", s.text};
  }
  solution.shapes.resize(n + differential, solution.vectors.cols());
  const auto T = linear.dq.leftCols(states);
  solution.shapes.topRows(n).real() = T * solution.vectors.real();
  solution.shapes.topRows(n).imag() = T * solution.vectors.imag();
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
