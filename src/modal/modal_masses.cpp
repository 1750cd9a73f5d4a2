#include "modal/modal_masses.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/clearly_larger.h"
#include "modal/mass_root.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;
using Index = Eigen::Index;

// What the table of coordinates shows of each mode: mass centres and rotations of all bodies, differential states.
ComplexMatrix table_entries(const System& system, const OperatingPoint& op, const EigenSolution& modes,
                            const ComplexMatrix& displacement) {
  const Layout& layout = system.layout();
  std::vector<Eigen::RowVectorXcd> rows;
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    ComplexMatrix of = displacement.middleRows(block.offset, block.count);
    if (block.turns()) {
      const Matrix3 arm = skew(op.poses[b].R * system.model().bodies[b].p_BC);
      for (Index i = 0; i < 3; ++i) {
        for (Index j = 0; j < 3; ++j)
          of.row(i) -= arm(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) * of.row(3 + j);
      }
    }
    for (Index i = 0; i < of.rows(); ++i) rows.push_back(of.row(i));
  }
  for (Index k = modes.vectors.rows() - static_cast<Index>(modes.differential_states); k < modes.vectors.rows(); ++k)
    rows.push_back(modes.vectors.row(k));
  ComplexMatrix out(static_cast<Index>(rows.size()), displacement.cols());
  for (std::size_t k = 0; k < rows.size(); ++k) out.row(static_cast<Index>(k)) = rows[k];
  return out;
}

// Modal coordinates of flexible bodies and of beams, which are in no table.
ComplexMatrix entries_beside(const System& system, const ComplexMatrix& displacement) {
  std::vector<Index> rows;
  for (const ExtraBlock& e : system.layout().extras) {
    if (!e.is_deformation()) continue;
    for (Index k = e.offset; k < e.offset + e.count; ++k) rows.push_back(k);
  }
  return displacement(rows, Eigen::all);
}

// The first of entries that are equally large but for rounding.
Complex largest_entry(const Eigen::VectorXcd& entries) {
  Complex largest = 0;
  for (const Complex& v : entries) {
    if (is_clearly_larger(std::abs(v), std::abs(largest))) largest = v;
  }
  return largest;
}

// Equal eigenvalues, or what cannot be told from them, have vectors of any basis of their space.
bool are_equal(const EigenMode& a, const EigenMode& b) {
  constexpr double equal = 1e-9;  // to which eigensolutions take values for equal
  return std::abs(a.eigenvalue_hz - b.eigenvalue_hz) <=
         equal * std::abs(b.eigenvalue_hz) + a.error_bound_hz + b.error_bound_hz;
}

}  // namespace

ModalMasses modal_masses(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                         const EigenSolution& modes, MarkerId frame) {
  Vector origin{};
  Matrix3 axes = Matrix3::identity();
  if (frame.valid()) {
    const MarkerPlace& place = system.layout().marker(system.signals().place_of(frame));
    const Motion motion = system.motion(op);
    origin = motion.point(place), axes = motion.axes(place);
  }
  const MassRoot root(system, op);
  const Matrix rigid = root.of_rigid_motion(origin, axes);
  const ComplexMatrix displacement = linear.displacements(modes.vectors);
  ComplexMatrix shapes(rigid.rows(), displacement.cols());
  shapes.real() = root.of(displacement.real());
  shapes.imag() = root.of(displacement.imag());
  ComplexMatrix entries = table_entries(system, op, modes, displacement);
  ComplexMatrix beside = entries_beside(system, displacement);

  ModalMasses out;
  for (Index d = 0; d < 6; ++d) out.total[static_cast<std::size_t>(d)] = rigid.col(d).squaredNorm();
  out.modes.resize(modes.modes.size());
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const auto at = static_cast<Index>(k);
    const double before = shapes.col(at).norm();
    for (int twice = 0; twice < 2; ++twice) {
      for (std::size_t j = 0; j < k; ++j) {
        if (!are_equal(modes.modes[j], modes.modes[k])) continue;
        const auto other = shapes.col(static_cast<Index>(j));
        if (!(other.squaredNorm() > 0)) continue;
        const Complex part = other.dot(shapes.col(at)) / other.squaredNorm();
        shapes.col(at) -= other * part;
        entries.col(at) -= entries.col(static_cast<Index>(j)) * part;
        beside.col(at) -= beside.col(static_cast<Index>(j)) * part;
      }
    }
    // Where a body bends and none moves, its modal coordinates are all that there is.
    constexpr double moving_part = 1e-9;
    Complex largest = largest_entry(entries.col(at));
    const Complex bending = largest_entry(beside.col(at));
    if (std::abs(largest) <= moving_part * std::abs(bending)) largest = bending;
    ModalMasses::Row& row = out.modes[k];
    if (!(shapes.col(at).norm() > 1e-7 * before) || largest == Complex(0)) {
      row.kind = before > 0 ? ModalMasses::Row::Kind::repeated : ModalMasses::Row::Kind::still;
      shapes.col(at).setZero();
      continue;
    }
    shapes.col(at) /= largest;
    entries.col(at) /= largest, beside.col(at) /= largest;
    row.generalized = shapes.col(at).squaredNorm();
    // Beside the largest that a motion of this size can have, what rounding makes of a sum that is zero: of motions in
    // this direction that cancel, and of one that is all there is in it and is rounding itself.
    const double rounding =
        std::min(1e-8, std::max(64.0, modes.modes[k].condition) * std::numeric_limits<double>::epsilon());
    for (Index d = 0; d < 6; ++d) {
      const Complex L = shapes.col(at).dot(rigid.col(d).cast<Complex>());
      if (std::abs(L) <= rounding * shapes.col(at).norm() * rigid.col(d).norm()) continue;
      row.participation[static_cast<std::size_t>(d)] = L / row.generalized;
      row.effective[static_cast<std::size_t>(d)] = std::norm(L) / row.generalized;
    }
  }
  return out;
}

}  // namespace dynalin
