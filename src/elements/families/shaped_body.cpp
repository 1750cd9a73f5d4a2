#include "elements/families/shaped_body.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/degree.h"
#include "elements/families/weighed_mass.h"

namespace dynalin {

namespace {

// A part of the mass matrix below this many roundings is what it cannot tell from zero.
constexpr double mass_units = 4;

constexpr double fast_turning = 0.1, far_bent = 0.1, far_turned = 10 * degree;

// Of all nodes, three rows each.
double farthest_node(const Eigen::VectorXd& by_nodes) {
  double most = 0;
  for (Eigen::Index k = 0; k + 2 < by_nodes.size(); k += 3) most = std::max(most, by_nodes.segment<3>(k).norm());
  return most;
}

}  // namespace

ShapedBody::ShapedBody(const Model& model, const Layout& layout, const FlexibleBody& of)
    : model_(&model),
      of_(of),
      pose_(layout.body(of.body).offset),
      modes_(layout.body_coordinate_count + static_cast<std::int32_t>(of.first)) {}

Vec3<Taylor> ShapedBody::centre_in_body(const Motion& motion, BodyId) const {
  const ModalInertia& inertia = shape().inertia;
  Vec3<Taylor> c{};
  if (!(inertia.mass > 0)) return c;  // INVARIANTS may leave it out
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Taylor sum(inertia.first[axis]);
    for (std::size_t k = 0; k < inertia.modes(); ++k)
      sum += motion.outside_poses(of_.first + k) * inertia.of_modes[k][axis];
    c[axis] = sum / inertia.mass;
  }
  return c;
}

// What the mass matrix tells from zero, in coordinates that have a unit each on its diagonal.
void ShapedBody::add_momentum_rows(const Motion& motion, std::vector<SparseRow>& rows) const {
  const Eigen::Index n = shape().modes();
  const Matrix3& R = motion.body(of_.body).R;
  const Eigen::MatrixXd mass = shape().inertia.matrix(modal_coordinates(motion));
  const Eigen::VectorXd unit = mass.diagonal().cwiseSqrt();
  const Eigen::VectorXd inverse = unit.unaryExpr([](double x) { return x > 0 ? 1 / x : 0.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      Eigen::MatrixXd(inverse.asDiagonal() * mass * inverse.asDiagonal()));
  const double zero = mass_units * std::numeric_limits<double>::epsilon() * static_cast<double>(6 + n);
  for (Eigen::Index k = 0; k < 6 + n; ++k) {
    if (solver.eigenvalues()(k) <= zero) continue;
    const Eigen::VectorXd v = unit.cwiseProduct(solver.eigenvectors().col(k));
    SparseRow row;
    for (std::int32_t i = 0; i < 6; i += 3) {
      const Vector global = R * Vector{v(i), v(i + 1), v(i + 2)};
      for (std::int32_t c = 0; c < 3; ++c) {
        row.column.push_back(pose_ + i + c);
        row.value.push_back(global[static_cast<std::size_t>(c)]);
      }
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      row.column.push_back(modes_ + static_cast<std::int32_t>(i));
      row.value.push_back(v(6 + i));
    }
    rows.push_back(std::move(row));
  }
}

std::vector<WeighedPart> ShapedBody::weighed_parts(const Motion& motion) const {
  if (mass() == 0) return {};
  WeighedPart part{std::vector<std::int32_t>(static_cast<std::size_t>(6 + shape().modes())),
                   {},
                   root_of_mass(shape().inertia.matrix(modal_coordinates(motion)))};
  std::iota(part.columns.begin(), part.columns.begin() + 6, pose_);
  std::iota(part.columns.begin() + 6, part.columns.end(), modes_);
  // Along the axes of the BCS: Rᵀ of what is along global ones.
  const Eigen::Matrix3d R = eigen_matrix(motion.body(of_.body).R);
  part.root.leftCols(3) = (part.root.leftCols(3) * R.transpose()).eval();
  part.root.middleCols(3, 3) = (part.root.middleCols(3, 3) * R.transpose()).eval();
  return {part};
}

KineticEnergy ShapedBody::kinetic_energy(const Motion& motion, const Eigen::VectorXcd& velocity) const {
  const Eigen::VectorXd q = modal_coordinates(motion);
  const Matrix3& R = motion.body(of_.body).R;
  const ComplexVector u = complex_vector(velocity, pose_), w = complex_vector(velocity, pose_ + 3);
  const ComplexVector u_in_body = transpose(R) * u, w_in_body = transpose(R) * w;
  Eigen::VectorXcd own(6 + shape().modes());
  own << u_in_body.x, u_in_body.y, u_in_body.z, w_in_body.x, w_in_body.y, w_in_body.z,
      velocity.segment(modes_, shape().modes());
  const Eigen::MatrixXd M = shape().inertia.matrix(q);
  return {kinetic_terms(mass(), u, R * shape().inertia.tensor_at(q) * transpose(R), w),
          0.5 * (own.real().dot(M * own.real()) + own.imag().dot(M * own.imag()))};
}

std::optional<double> ShapedBody::own_work(const Motion&, PartialBy by, const Eigen::VectorXcd& u) const {
  const Eigen::VectorXcd q = u.segment(modes_, shape().modes());
  const Eigen::MatrixXd& m = by == PartialBy::position ? shape().stiffness : shape().damping;
  return q.real().dot(m * q.real()) + q.imag().dot(m * q.imag());
}

void ShapedBody::start_velocity(const Motion&, const Holds& holds, std::span<double> of_all) const {
  if (holds(model_->body(of_.body).nature->modal_kind.starts.velocity))
    std::ranges::copy(shape().rate, of_all.begin() + modes_);
}

void ShapedBody::add_cautions(const Motion& motion, Diagnostics& out) const {
  if (shape().modes() == 0) return;
  const double speed = norm(motion.body(of_.body).w);
  const double lowest = own_modes(shape(), model_->units.ucf).frequency.minCoeff();
  if (speed > fast_turning * lowest) {
    out.warning("fast-flexible-body", label().at,
                fmt::format("{} turns at {:.3g} rad/{}, {:.2g} of its lowest frequency: its modes know no geometric "
                            "stiffening",
                            label().full_text(), speed, model_->units.time_symbol(), speed / lowest));
  }
  const Eigen::VectorXd q = modal_coordinates(motion);
  const double length = shape().length;
  const double bent = farthest_node(shape().translation * q), turned = farthest_node(shape().rotation * q);
  if ((length > 0 && bent > far_bent * length) || turned > far_turned) {
    out.warning("far-bent-body", label().at,
                fmt::format("{} is bent by {:.3g} of its length and turned within by {:.3g} degrees: linear modes hold "
                            "for a tenth and ten degrees",
                            label().full_text(), length > 0 ? bent / length : 0.0, turned / degree));
  }
}

std::optional<std::string> ShapedBody::summary() const {
  std::string line = fmt::format("{}: mass {:.6g}", label().full_text(), mass());
  if (const Eigen::Index modes = shape().modes(); modes > 0) {
    const Eigen::VectorXd hertz = own_modes(shape(), model_->units.ucf).frequency / (2 * std::numbers::pi);
    line += fmt::format(", {} mode{} from {:.6g} to {:.6g} {}", modes, modes == 1 ? "" : "s", hertz.minCoeff(),
                        hertz.maxCoeff(), model_->units.frequency());
  }
  return line;
}

}  // namespace dynalin
