#include "linear/mass_root.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace dynalin {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

namespace {
// Coordinates without mass have no unit of their own.
double size_or_one(double x) { return x > 0 ? x : 1.0; }
}  // namespace

MassRoot::MassRoot(const System& system, const OperatingPoint& op) : length_(system.length()) {
  const Layout& layout = system.layout();
  const std::vector<FlexibleBody> flexible = flexible_bodies(system.model());
  const std::vector<bool> of_beams = beam_nodes(system.model());
  Index next = 0;
  const Motion motion = system.motion(op);
  for (const BeamBody& beam : beam_bodies(system.model(), layout)) {
    const auto first = static_cast<std::size_t>(beam.nodes.front().index);
    Item item{first, layout.bodies[first].offset, true, 0, {}};
    item.first_row = next;
    add_beam(system, motion, beam, item);
    next += 6 + item.modes;
    items_.push_back(std::move(item));
  }
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    const Body& body = system.model().bodies[b];
    if (block.count == 0 || body.user_mass == 0 || of_beams[b]) continue;
    Item item{b, block.offset, block.turns(), std::sqrt(body.user_mass), op.poses[b].R * body.p_BC};
    item.centre = op.poses[b].r + item.arm;
    item.first_row = next;
    const auto found =
        std::ranges::find(flexible, static_cast<std::int32_t>(b), [](const FlexibleBody& f) { return f.body.index; });
    if (found != flexible.end()) {
      add_flexible(system, op, *found, item);
      next += 6 + item.modes;
      items_.push_back(std::move(item));
      continue;
    }
    next += 6;
    const Matrix3 J = op.poses[b].R * body.J_BC * transpose(op.poses[b].R);
    const double factor = body.user_mass / body.mass;
    Eigen::Matrix3d inertia;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) inertia(r, c) = factor * J(static_cast<std::size_t>(r), static_cast<std::size_t>(c));
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(inertia);
    item.inertia_root =
        principal.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * principal.eigenvectors().transpose();
    items_.push_back(item);
  }
}

void MassRoot::add_flexible(const System& system, const OperatingPoint& op, const FlexibleBody& f, Item& item) {
  item.modes = f.flexible->modes();
  item.first_mode = system.layout().body_coordinate_count + static_cast<std::int32_t>(f.first);
  const Matrix mass =
      f.flexible->inertia.matrix(Eigen::Map<const Eigen::VectorXd>(op.extra.data() + f.first, item.modes));
  const Eigen::VectorXd unit = mass.diagonal().cwiseSqrt().unaryExpr(&size_or_one);
  const Eigen::SelfAdjointEigenSolver<Matrix> parts(
      Matrix(unit.cwiseInverse().asDiagonal() * mass * unit.cwiseInverse().asDiagonal()));
  item.root =
      parts.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * parts.eigenvectors().transpose() * unit.asDiagonal();
  // Along the axes of the BCS: Rᵀ of what is along global ones.
  Eigen::Matrix3d R;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      R(r, c) = op.poses[item.body].R(static_cast<std::size_t>(r), static_cast<std::size_t>(c));
  }
  item.root.leftCols(3) = (item.root.leftCols(3) * R.transpose()).eval();
  item.root.middleCols(3, 3) = (item.root.middleCols(3, 3) * R.transpose()).eval();
}

void MassRoot::add_beam(const System& system, const Motion& motion, const BeamBody& beam, Item& item) {
  double mass = 0;
  for (std::size_t e = 0; e < beam.elements->size(); ++e) {
    const BeamElement& element = *(*beam.elements)[e];
    Item::Element& of = item.elements.emplace_back();
    of.columns = beam.columns(system.layout(), e);
    of.motion = beam.motion(motion, e);
    of.places = {motion.body(beam.nodes[e]).r, motion.body(beam.nodes[e + 1]).r};
    const BeamMatrix M = system.model().units.ucf * element.mass_matrix(of.motion);
    const BeamVector unit = M.diagonal().cwiseSqrt().unaryExpr(&size_or_one);
    const Eigen::SelfAdjointEigenSolver<Matrix> parts(
        Matrix(unit.cwiseInverse().asDiagonal() * M * unit.cwiseInverse().asDiagonal()));
    of.root =
        parts.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * parts.eigenvectors().transpose() * unit.asDiagonal();
    mass += system.model().units.ucf * element.mass();
  }
  item.mass_root = std::sqrt(mass);
  item.modes = static_cast<Index>(beam_coordinates * beam.elements->size()) - 6;
}

Matrix MassRoot::of(const Matrix& columns) const {
  Matrix out = Matrix::Zero(row_count(), columns.cols());
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const Item& item = items_[k];
    for (std::size_t e = 0; e < item.elements.size(); ++e) {
      const Item::Element& element = item.elements[e];
      constexpr auto n = static_cast<Index>(beam_coordinates);
      out.middleRows(item.first_row + n * static_cast<Index>(e), n) = element.root * rows_of(element.columns, columns);
    }
    if (!item.elements.empty()) continue;
    if (item.root.size() > 0) {
      out.middleRows(item.first_row, 6 + item.modes) =
          item.root.leftCols(6) * columns.middleRows(item.offset, 6) +
          item.root.rightCols(item.modes) * columns.middleRows(item.first_mode, item.modes);
      continue;
    }
    Matrix move = columns.middleRows(item.offset, 3);
    if (item.turns) {
      const Matrix turn = columns.middleRows(item.offset + 3, 3);
      for (Index c = 0; c < columns.cols(); ++c) {
        const Vector v = cross(Vector{turn(0, c), turn(1, c), turn(2, c)}, item.arm);
        for (std::size_t i = 0; i < 3; ++i) move(static_cast<Index>(i), c) += v[i];
      }
      out.middleRows(item.first_row + 3, 3) = item.inertia_root * turn;
    }
    out.middleRows(item.first_row, 3) = item.mass_root * move;
  }
  return out;
}

Eigen::RowVectorXd MassRoot::size_of(const Matrix& columns) const {
  double heaviest = 0;
  for (const Item& item : items_) heaviest = std::max(heaviest, item.mass_root);
  return heaviest * std::max(length_, 1.0) * columns.cwiseAbs().colwise().maxCoeff();
}

void MassRoot::weigh_rigid_motion(const Item& item, const Vector& origin, const Matrix3& axes, Matrix& out) {
  constexpr auto n = static_cast<Index>(beam_coordinates);
  for (std::size_t e = 0; e < item.elements.size(); ++e) {
    const Item::Element& element = item.elements[e];
    Eigen::Matrix<double, beam_coordinates, 6> motion = Eigen::Matrix<double, beam_coordinates, 6>::Zero();
    for (std::size_t d = 0; d < 3; ++d) {
      const Vector axis = axes[d];
      const auto put = [&](Index row, Index column, const Vector& v) {
        for (std::size_t i = 0; i < 3; ++i) motion(row + static_cast<Index>(i), column) = v[i];
      };
      const auto moved = static_cast<Index>(d), turned = moved + 3;
      for (std::size_t node = 0; node < 2; ++node) {
        const auto first = static_cast<Index>(6 * node);
        put(first, moved, axis);
        put(first, turned, cross(axis, element.places[node] - origin));
        put(first + 3, turned, axis);
        put(12 + static_cast<Index>(3 * node), turned, cross(axis, value(element.motion.slope[node])));
      }
    }
    out.block(item.first_row + n * static_cast<Index>(e), 0, n, 6) = element.root * motion;
  }
}

Matrix MassRoot::of_rigid_motion(const Vector& origin, const Matrix3& axes) const {
  Matrix out = Matrix::Zero(row_count(), 6);
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const Index at = items_[k].first_row;
    if (!items_[k].elements.empty()) {
      weigh_rigid_motion(items_[k], origin, axes, out);
      continue;
    }
    for (std::size_t d = 0; d < 3; ++d) {
      const Vector e{axes(0, d), axes(1, d), axes(2, d)};
      const Vector by_turn = cross(e, items_[k].centre - origin);
      const Eigen::Vector3d axis(e[0], e[1], e[2]);
      if (items_[k].root.size() > 0) {
        const Matrix& root = items_[k].root;
        const auto column = static_cast<Index>(d);
        out.block(at, column, root.rows(), 1) = root.leftCols(3) * axis;
        out.block(at, column + 3, root.rows(), 1) =
            root.leftCols(3) * Eigen::Vector3d(by_turn[0], by_turn[1], by_turn[2]) + root.middleCols(3, 3) * axis;
        continue;
      }
      out.block(at, static_cast<Index>(d), 3, 1) = items_[k].mass_root * axis;
      out.block(at, static_cast<Index>(d) + 3, 3, 1) =
          items_[k].mass_root * Eigen::Vector3d(by_turn[0], by_turn[1], by_turn[2]);
      if (items_[k].turns) out.block(at + 3, static_cast<Index>(d) + 3, 3, 1) = items_[k].inertia_root * axis;
    }
  }
  return out;
}

}  // namespace dynalin
