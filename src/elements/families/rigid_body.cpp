#include "elements/families/rigid_body.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numeric>

#include "elements/families/weighed_mass.h"

namespace dynalin {

namespace {

// A principal inertia below this many roundings of the tensor is what the mass matrix cannot tell from zero.
constexpr double inertia_units = 4;

// Principal axes (global) about which a body has inertia.
std::vector<Vector> axes_with_inertia(const Body& body, const Matrix3& R) {
  const Eigen::Matrix3d J = eigen_matrix(R * body.J_BC * transpose(R));
  const Eigen::Matrix3d tensor = 0.5 * (J + J.transpose());
  const double zero = inertia_units * std::numeric_limits<double>::epsilon() *
                      (tensor.cwiseAbs().maxCoeff() + body.mass * dot(body.p_BC, body.p_BC));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  std::vector<Vector> axes;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(solver.eigenvalues()(k)) <= zero) continue;
    const Eigen::Vector3d v = solver.eigenvectors().col(k);
    axes.push_back({v(0), v(1), v(2)});
  }
  return axes;
}

}  // namespace

RigidBody::RigidBody(const Model& model, const Layout& layout, BodyId id)
    : body_(&model.body(id)), id_(id), first_(layout.body(id).offset), turns_(layout.body(id).turns()) {}

Vec3<Taylor> RigidBody::centre_in_body(const Motion&, BodyId) const {
  const Vector& c = body_->p_BC;
  return {Taylor(c.x), Taylor(c.y), Taylor(c.z)};
}

bool RigidBody::lacks_inertia() const {
  if (body_->mass == 0) return true;
  if (!turns_) return false;
  // Far from singular without a look at the principal values.
  const Matrix3& J = body_->J_BC;
  const double mean = trace(J) / 3, determinant = dot(cross(J.x, J.y), J.z);
  if (determinant > 1e-9 * mean * mean * mean && mean > 1e-9 * body_->mass * dot(body_->p_BC, body_->p_BC))
    return false;
  return axes_with_inertia(*body_, Matrix3::identity()).size() < 3;
}

void RigidBody::add_momentum_rows(const Motion& motion, std::vector<SparseRow>& rows) const {
  const Matrix3& R = motion.body(id_).R;
  const auto add = [&](const Vector& on_r, const Vector& on_theta) {
    SparseRow row;
    for (std::int32_t k = 0; k < (turns_ ? 6 : 3); ++k) {
      row.column.push_back(first_ + k);
      row.value.push_back(k < 3 ? on_r[static_cast<std::size_t>(k)] : on_theta[static_cast<std::size_t>(k - 3)]);
    }
    rows.push_back(std::move(row));
  };
  if (body_->mass != 0) {
    const Vector c = R * body_->p_BC;
    for (const Vector& unit : unit_vectors) add(unit, cross(c, unit));
  }
  if (!turns_) return;
  for (const Vector& axis : axes_with_inertia(*body_, R)) add({}, axis);
}

std::vector<WeighedPart> RigidBody::weighed_parts(const Motion& motion) const {
  if (body_->user_mass == 0) return {};
  const Eigen::Index count = turns_ ? 6 : 3;
  WeighedPart part{std::vector<std::int32_t>(static_cast<std::size_t>(count)), {}, Eigen::MatrixXd::Zero(count, count)};
  std::iota(part.columns.begin(), part.columns.end(), first_);
  part.root.diagonal().head<3>().setConstant(std::sqrt(body_->user_mass));
  if (!turns_) return {part};
  const Matrix3& R = motion.body(id_).R;
  part.arm = R * body_->p_BC;
  const Matrix3 J = R * body_->J_BC * transpose(R);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal((body_->user_mass / body_->mass) * eigen_matrix(J));
  part.root.bottomRightCorner<3, 3>() =
      principal.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * principal.eigenvectors().transpose();
  return {part};
}

KineticEnergy RigidBody::kinetic_energy(const Motion& motion, const Eigen::VectorXcd& velocity) const {
  const Matrix3& R = motion.body(id_).R;
  ComplexVector v = complex_vector(velocity, first_), w{};
  if (turns_) {
    w = complex_vector(velocity, first_ + 3);
    v += cross(w, R * body_->p_BC);
  }
  const double factor = body_->mass > 0 ? body_->user_mass / body_->mass : 1.0;
  const Matrix3 J = R * (factor * body_->J_BC) * transpose(R);
  return {kinetic_terms(body_->user_mass, v, J, w)};
}

}  // namespace dynalin
