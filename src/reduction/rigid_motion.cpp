#include "reduction/rigid_motion.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dynalin::reduction {

namespace {

// A motion strains nothing if its forces are below this part of |K||R|. Matrices have at least eight digits; one node
// in a million that is held gives more.
constexpr double strains_nothing = 1e-7;
// Of the sum of the sizes that make the mass of a translation.
constexpr double massless_translation = 1e-9;

}  // namespace

Eigen::MatrixXd rigid_motions(const FiniteElementModel& model) {
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model.freedoms.size()), 6);
  for (Eigen::Index row = 0; row < rigid.rows(); ++row) {
    const Freedom& f = model.freedoms[static_cast<std::size_t>(row)];
    if (f.direction >= 4) rigid(row, f.direction - 1) = 1;
    if (f.direction < 1 || f.direction > 3) continue;
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(f.direction - 1);
    rigid.block<1, 3>(row, 0) = along.transpose();
    // along · (ω × s) = ω · (s × along)
    rigid.block<1, 3>(row, 3) = model.nodes.at(f.node).cross(along).transpose();
  }
  return rigid;
}

FreeMotions free_motions(const FiniteElementModel& model, const Eigen::MatrixXd& rigid) {
  // Rotations about the middle of the nodes, so that their translations do not hide them.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double count = 0;
  for (const Freedom& f : model.freedoms) {
    if (f.direction == 1) middle += model.nodes.at(f.node), ++count;
  }
  if (count > 0) middle /= count;
  Eigen::Matrix<double, 6, 6> about_middle = Eigen::Matrix<double, 6, 6>::Identity();
  for (Eigen::Index k = 0; k < 3; ++k) about_middle.block<3, 1>(0, 3 + k) = middle.cross(Eigen::Vector3d::Unit(k));
  Eigen::MatrixXd motions = rigid * about_middle;
  const SparseMatrix sizes = model.stiffness.cwiseAbs();
  const Eigen::VectorXd scale = (sizes * motions.cwiseAbs()).colwise().norm().transpose();
  for (Eigen::Index k = 0; k < 6; ++k) {
    if (scale[k] > 0) about_middle.col(k) /= scale[k], motions.col(k) /= scale[k];
  }
  const Eigen::MatrixXd forces = model.stiffness * motions;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> strain(Eigen::MatrixXd(forces.transpose() * forces));
  FreeMotions free;
  Eigen::Index r = 0;
  while (r < 6 && std::sqrt(std::max(0.0, strain.eigenvalues()[r])) < strains_nothing) ++r;
  free.directions = about_middle * strain.eigenvectors().leftCols(r);
  if (r > 0) free.strain = std::sqrt(std::max(0.0, strain.eigenvalues()[r - 1]));
  return free;
}

MassProperties mass_properties(const FiniteElementModel& model, const Eigen::MatrixXd& rigid) {
  MassProperties p;
  p.matrix = rigid.transpose() * (model.mass * rigid);
  const Eigen::Vector3d along = p.matrix.diagonal().head<3>();
  p.mass = along.mean();
  const Eigen::MatrixXd sizes = rigid.leftCols<3>().cwiseAbs();
  const SparseMatrix of_mass = model.mass.cwiseAbs();
  if (!(p.mass > massless_translation * (sizes.transpose() * (of_mass * sizes)).trace())) p.mass = 0;
  p.uneven = p.mass > 0 ? (along.maxCoeff() - along.minCoeff()) / p.mass : 0;
  // The block of rotations and translations is I2^, of I2 = mass · centre.
  const Eigen::Matrix3d moment = p.matrix.block<3, 3>(3, 0);
  const Eigen::Vector3d first(moment(2, 1) - moment(1, 2), moment(0, 2) - moment(2, 0), moment(1, 0) - moment(0, 1));
  p.centre = p.mass > 0 ? Eigen::Vector3d(first / (2 * p.mass)) : Eigen::Vector3d::Zero();
  const Eigen::Matrix3d to_centre =
      p.mass * (p.centre.squaredNorm() * Eigen::Matrix3d::Identity() - p.centre * p.centre.transpose());
  p.inertia = p.matrix.block<3, 3>(3, 3) - to_centre;
  p.inertia = 0.5 * (p.inertia + p.inertia.transpose()).eval();
  return p;
}

}  // namespace dynalin::reduction
