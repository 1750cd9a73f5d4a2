#include "elements/families/flexible_body.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>

#include "elements/families/defined_unknown.h"
#include "elements/families/flexible_motion.h"
#include "routine/routine_data.h"

namespace dynalin {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using flexible_motion::Balance;
using flexible_motion::ByPose;
using flexible_motion::Contracted;
using flexible_motion::Felt;
using flexible_motion::Path;
using flexible_motion::pose_seeds;
using Index = Eigen::Index;

constexpr std::array families = {PartialBy::position, PartialBy::velocity, PartialBy::acceleration};

void add_rows(PartialBy family, std::int32_t row, std::int32_t column, const VectorXd& values, Equations& eq) {
  eq.add(family, row, column, {values.data(), static_cast<std::size_t>(values.size())});
}
// The whole of it, or what is not zero in a matrix that never changes.
void add_matrix(PartialBy family, std::int32_t at, const MatrixXd& m, bool all, Equations& eq) {
  if (!eq.wants(family)) return;
  for (Index c = 0; c < m.cols(); ++c) {
    const auto column = at + static_cast<std::int32_t>(c);
    if (all) {
      eq.add(family, at, column, {m.data() + c * m.rows(), static_cast<std::size_t>(m.rows())});
      continue;
    }
    for (Index r = 0; r < m.rows(); ++r) {
      if (m(r, c) != 0) eq.add(family, at + static_cast<std::int32_t>(r), column, m(r, c));
    }
  }
}

ModalInertia dynamical(ModalInertia I, double ucf) {
  const double f = 1 / ucf;
  I.mass *= f, I.first = f * I.first, I.tensor = f * I.tensor, I.modal *= f;
  for (std::size_t k = 0; k < I.modes(); ++k) {
    I.of_modes[k] = f * I.of_modes[k], I.turning[k] = f * I.turning[k];
    I.tensor_by_mode[k] = f * I.tensor_by_mode[k];
  }
  for (MatrixXd& m : I.turning_by_mode) m *= f;
  for (MatrixXd& m : I.tensor_by_modes) m *= f;
  return I;
}

}  // namespace

FlexibleBodyKernel::FlexibleBodyKernel(const std::vector<FlexibleBody>& all, const Model& model, Layout& layout)
    : gravity_(model.gravity) {
  for (const FlexibleBody& f : all) {
    const Body& body = model.body(f.body);
    Item item{f.body,
              f.flexible,
              dynamical(f.flexible->inertia, model.units.ucf),
              layout.body_coordinate_count + static_cast<std::int32_t>(f.first),
              f.first,
              false};
    for (const MatrixXd& m : item.inertia.turning_by_mode) item.couples |= !m.isZero(0);
    for (const MatrixXd& m : item.inertia.tensor_by_modes) item.couples |= !m.isZero(0);
    for (std::size_t k = 0; k < body.nature->modal.size(); ++k) {
      const auto at = static_cast<Index>(k);
      const bool place = f.flexible->holds_displacement[k], rate = f.flexible->holds_rate[k];
      if (!place && !rate) continue;
      starts_.push_back({&body.label, body.nature->modal[k].name,
                         place ? std::optional(f.flexible->displacement(at)) : std::nullopt,
                         rate ? std::optional(f.flexible->rate(at)) : std::nullopt, body.nature->modal_kind.starts});
      start_places_.push_back({items_.size(), at});
    }
    const bool read = model.routine_data && model.routine_data->modes_read.contains(static_cast<int>(body.label.id));
    for (std::size_t m = 0; read && m < body.nature->modal.size(); ++m) {
      for (const int derivative : {0, 1}) {
        readings_.push_back({f.body, m, derivative, item.first_column + static_cast<std::int32_t>(m),
                             item.first_extra + m, layout.add_algebraic(body.label)});
      }
    }
    items_.push_back(std::move(item));
    bodies_.emplace_back(model, layout, f);
  }
}

std::vector<const BodySource*> FlexibleBodyKernel::bodies() const {
  std::vector<const BodySource*> list;
  for (const ShapedBody& b : bodies_) list.push_back(&b);
  return list;
}

Channel FlexibleBodyKernel::shape_channel(BodyId body, std::size_t mode, int derivative) const {
  const auto found = std::ranges::find_if(
      readings_, [&](const Reading& r) { return r.body == body && r.mode == mode && r.derivative == derivative; });
  return found == readings_.end() ? Channel{} : Channel{Channel::Kind::algebraic, found->algebraic, 0};
}

bool FlexibleBodyKernel::add_rate_equation(std::int32_t algebraic, std::int32_t rate, Binder&) {
  const auto found = std::ranges::find(readings_, algebraic, &Reading::algebraic);
  if (found == readings_.end() || found->derivative > 1) return false;
  Reading of_rate = *found;
  ++of_rate.derivative, of_rate.algebraic = rate;
  readings_.push_back(of_rate);
  return true;
}

void FlexibleBodyKernel::read(const Reading& r, const Motion& motion, Equations& eq) {
  constexpr std::array family = {PartialBy::position, PartialBy::damping, PartialBy::acceleration};
  const std::array values = {motion.extra[r.extra], motion.extra_rate[r.extra], motion.extra_acceleration[r.extra]};
  const auto d = static_cast<std::size_t>(r.derivative);
  eq.begin_element(eq.layout().body(r.body).label);
  const std::int32_t row = begin_definition(motion, eq, r.algebraic);
  eq.add_residual(row, -values[d]);
  eq.add(family[d], row, r.column, -1.0);
}

void FlexibleBodyKernel::start_rows(const Motion& motion, std::int32_t first_row, ConstraintRows& rows) const {
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    const auto [item, mode] = start_places_[k];
    const Item& of = items_[item];
    Taylor q = motion.outside_poses(of.first_extra + static_cast<std::size_t>(mode));
    q.value = starts_[k].displacement ? q.value - *starts_[k].displacement : 0.0;
    const std::int32_t row = first_row + static_cast<std::int32_t>(k);
    rows.set(row, q);
    rows.add_coordinate(row, of.first_column + static_cast<std::int32_t>(mode), Taylor(1.0));
  }
}

void FlexibleBodyKernel::equations(const Motion& motion, Equations& eq) const {
  for (const Reading& r : readings_) read(r, motion, eq);
  for (const Item& item : items_) {
    eq.begin_element(eq.layout().body(item.body).label);
    const ModalInertia& I = item.inertia;
    const std::size_t n = I.modes();
    const BodyMotion& b = motion.body(item.body);
    const std::int32_t column = eq.layout().body(item.body).offset, modes = item.first_column;
    const Path<double> path{along_motion(b.r, b.rdot, b.rddot), b.axes()};
    const Contracted c = flexible_motion::contract(I, motion, item.first_extra);

    const Balance<double> of_body = balance(I.mass, path, c.shape, gravity_);
    // The derivatives of axes are of the size of ω² and α in all directions, also where they turn nothing.
    const double turning = 0.25 * (norm(b.wdot) + dot(b.w, b.w));
    eq.apply_inertia(item.body, of_body.force, of_body.moment,
                     {.force = turning * norm(c.shape.arm()), .moment = turning * c.shape.polar()});
    const Felt<double> felt(path, gravity_);
    const VectorXd inertia = I.modal * c.q2;
    for (std::size_t k = 0; k < n; ++k) {
      const double felt_by_mode = felt.by(I.of_modes[k], c.G[k], c.G1[k], c.J[k]) + inertia(static_cast<Index>(k));
      eq.add_residual(
          modes + static_cast<std::int32_t>(k), felt_by_mode,
          std::abs(felt_by_mode) + turning * (norm(c.G[k]) + norm(c.J[k].x) + norm(c.J[k].y) + norm(c.J[k].z)));
    }
    if (eq.wants_partials()) {
      // By the pose.
      const Path<ByPose> varied_path = varied(path);
      const Balance<ByPose> by_pose =
          balance(I.mass, varied_path, flexible_motion::constant<pose_seeds>(c.shape), gravity_);
      const Felt<ByPose> felt_by_pose(varied_path, gravity_);
      MatrixXd of_modes(static_cast<Index>(n), static_cast<Index>(pose_seeds));
      for (std::size_t k = 0; k < n; ++k) {
        const ByPose Q = felt_by_pose.by(I.of_modes[k], c.G[k], c.G1[k], c.J[k]);
        of_modes.row(static_cast<Index>(k)) = Eigen::Map<const Eigen::RowVectorXd>(Q.partial.data(), pose_seeds);
      }
      const auto column_of = [](const auto& balanced, std::size_t seed) {
        const auto of = [&](const auto& v) { return Vector{v.x.partial[seed], v.y.partial[seed], v.z.partial[seed]}; };
        return std::pair{of(balanced.force), of(balanced.moment)};
      };
      for (std::size_t seed = 0; seed < pose_seeds; ++seed) {
        const auto [force, moment] = column_of(by_pose, seed);
        const auto at = column + static_cast<std::int32_t>(seed % 6);
        eq.add_column(families[seed / 6], item.body, at, force, moment, 1.0);
        if (n > 0) add_rows(families[seed / 6], modes, at, of_modes.col(static_cast<Index>(seed)), eq);
      }
      // By the modal coordinates.
      const Path<Dual<3>> fixed_path = flexible_motion::constant<3>(path);
      for (std::size_t k = 0; k < n; ++k) {
        const Balance<Dual<3>> by_mode = balance(I.mass, fixed_path, varied(c, I.of_modes[k], k), gravity_);
        for (std::size_t level = 0; level < 3; ++level) {
          const auto [force, moment] = column_of(by_mode, level);
          eq.add_column(families[level], item.body, modes + static_cast<std::int32_t>(k), force, moment, 1.0);
        }
      }
      // δQ_k = 2 w·I5_jk ξ′ + (w·I5_jk)′ ξ − ½ w·J,kj w ξ
      if (item.couples) {
        MatrixXd by_q = MatrixXd::Zero(static_cast<Index>(n), static_cast<Index>(n)), by_rate = by_q;
        for (std::size_t a = 0; a < 3; ++a) {
          by_rate -= (2 * felt.w[a]) * I.turning_by_mode[a];
          by_q -= felt.wdot[a] * I.turning_by_mode[a];
        }
        for (std::size_t at = 0; at < felt.squares.size(); ++at) by_q -= felt.squares[at] * I.tensor_by_modes[at];
        add_matrix(PartialBy::position, modes, by_q, true, eq);
        add_matrix(PartialBy::velocity, modes, by_rate, true, eq);
      }
      add_matrix(PartialBy::acceleration, modes, I.modal, false, eq);
    }
    add_stiffness(item, motion, eq);
  }
}

void FlexibleBodyKernel::add_stiffness(const Item& item, const Motion& motion, Equations& eq) const {
  const ModalBody& b = *item.flexible;
  const Index n = b.modes();
  const Eigen::Map<const VectorXd> q(motion.extra.data() + item.first_extra, n),
      rate(motion.extra_rate.data() + item.first_extra, n);
  const VectorXd force = b.stiffness * q + b.damping * rate;
  for (Index k = 0; k < n; ++k) eq.add_residual(item.first_column + static_cast<std::int32_t>(k), force(k));
  add_matrix(PartialBy::position, item.first_column, b.stiffness, false, eq);
  add_matrix(PartialBy::damping, item.first_column, b.damping, false, eq);
}

}  // namespace dynalin
