#include "structural_zeros/carried_forces.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/dense_solvers.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Index = Eigen::Index;

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v(2), v(1), v(2), 0, -v(0), -v(1), v(0), 0;
  return m;
}

}  // namespace

// Rows of one element on one body, or of the law of one in its own axes: force, then moment by length.
struct CarriedForces::OnBody {
  Matrix change;                                    // 6 × directions
  Vector6 load;                                     // force and moment by length
  Matrix reactions;                                 // 6 × multipliers that are its own
  Vector6 sums;                                     // of the sizes of what makes up the change
  double made_of = 0;                               // the most that a component of the load has been added up from
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // of the BCS
  bool turns = true;
  Vector6 size = Vector6::Zero();  // that rows are in units of
  bool is_law = false;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // of the rows
};

CarriedForces::CarriedForces(const System& system, const Motion& motion, const ConstraintRows& rows,
                             const ElementPartials& partials)
    : bodies_(system.layout().bodies), length_(system.length()), rows_(rows), partials_(partials) {
  for (const BodyMotion& b : motion.bodies) places_.emplace_back(b.r.x, b.r.y, b.r.z);
  body_of_.assign(static_cast<std::size_t>(system.layout().coordinate_count), -1);
  for (std::size_t b = 1; b < bodies_.size(); ++b) {
    for (std::int32_t k = 0; k < bodies_[b].count; ++k)
      body_of_[static_cast<std::size_t>(bodies_[b].offset + k)] = static_cast<std::int32_t>(b);
  }
}

void CarriedForces::add(const Directions& d, std::vector<Eigen::RowVectorXd>& rows) const {
  std::map<std::int32_t, std::vector<OnBody>> bodies;
  std::vector<std::int32_t> group(bodies_.size());  // of bodies that elements connect
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](std::int32_t b) {
    while (group[static_cast<std::size_t>(b)] != b) b = group[static_cast<std::size_t>(b)];
    return b;
  };
  const double L = length_;
  for (const ElementContribution& e : partials_.elements()) {
    std::map<std::int32_t, OnBody> touched;
    std::map<std::int32_t, std::pair<Eigen::RowVectorXd, double>> alone;  // coordinates outside bodies
    const auto place = [&](std::int32_t row) -> OnBody& {
      const std::int32_t b = body_of_[static_cast<std::size_t>(row)];
      OnBody& on = touched[b];
      if (on.change.size() == 0) {
        on.change = Matrix::Zero(6, d.states.cols());
        on.load.setZero();
        on.sums.setZero();
        on.reactions = Matrix::Zero(6, static_cast<Index>(e.reactions.size()));
      }
      return on;
    };
    const auto spot = [&](std::int32_t row) -> std::pair<Index, double> {
      const std::int32_t k = row - bodies_[static_cast<std::size_t>(body_of_[static_cast<std::size_t>(row)])].offset;
      return {k, k < 3 ? 1.0 : 1 / L};
    };
    for (const ElementPartial& p : e.partials) {
      const Eigen::RowVectorXd change = p.value * d.change[Directions::at(p.family)].row(p.column);
      const double size = std::abs(p.value) * partials_.size_of(d, p);
      if (body_of_[static_cast<std::size_t>(p.row)] < 0) {
        auto& [sum, largest] = alone.try_emplace(p.row, Eigen::RowVectorXd::Zero(d.states.cols()), 0.0).first->second;
        sum += change;
        largest += size;
        continue;
      }
      OnBody& on = place(p.row);
      const auto [k, factor] = spot(p.row);
      on.change.row(k) += factor * change;
      on.sums(k) += factor * size;
    }
    for (const auto& [row, load] : e.load) {
      if (load.size == 0.0 || body_of_[static_cast<std::size_t>(row)] < 0) continue;
      OnBody& on = place(row);
      const auto [k, factor] = spot(row);
      on.load(k) += factor * load.value;
      on.made_of = std::max(on.made_of, factor * load.size);
    }
    for (std::size_t r = 0; r < e.reactions.size(); ++r) {
      for (const auto& entry : rows_.row(e.reactions[r])) {
        const std::int32_t b = body_of_[static_cast<std::size_t>(entry.column)];
        const auto on = touched.find(b);
        if (b < 0 || on == touched.end()) continue;
        const auto [k, factor] = spot(entry.column);
        on->second.reactions(k, static_cast<Index>(r)) += factor * entry.c.g;
      }
    }
    for (auto& [b, on] : touched) {
      group[static_cast<std::size_t>(root(b))] = root(touched.begin()->first);
      on.size.setConstant(std::max(on.sums.maxCoeff(), on.made_of));
      if (e.laws.empty() && on.size(0) > 0) bodies[b].push_back(std::move(on));
    }
    // Action and reaction of a law are one wrench.
    for (const ElementTrace::Law& law : e.laws) {
      if (touched.empty()) break;
      OnBody on = of_law(d, law);
      on.turns = std::any_of(touched.begin(), touched.end(),
                             [&](const auto& t) { return bodies_[static_cast<std::size_t>(t.first)].turns(); });
      bodies[touched.begin()->first].push_back(std::move(on));
    }
    // A coordinate outside bodies belongs to one element, whose reactions balance there.
    if (e.reactions.empty()) {
      for (const auto& [row, sum] : alone) {
        if (sum.second > 0) rows.push_back(sum.first / sum.second);
      }
    }
  }
  std::map<std::int32_t, std::vector<const OnBody*>> groups;
  for (auto& [b, list] : bodies) {
    for (OnBody& on : list) {
      if (!on.is_law) see_from_fixed_points(d, b, on);
      groups[root(b)].push_back(&on);
    }
  }
  for (const auto& [first, on] : groups) add_group(on, place_of(first), d.states.cols(), rows);
}

// Moments are about the BCS, which moves: about the point where it was they change by δr × f more.
void CarriedForces::see_from_fixed_points(const Directions& d, std::int32_t b, OnBody& on) const {
  const BodyBlock& block = bodies_[static_cast<std::size_t>(b)];
  on.place = place_of(b);
  on.turns = block.turns();
  if (!on.turns) return;
  const auto moved = d.change[Directions::at(PartialBy::position)].middleRows(block.offset, 3);
  on.change.bottomRows(3) -= cross_matrix(on.load.head<3>()) * moved / length_;
}

// Each component against what makes it up: one that is soft is seen beside others that are stiff.
CarriedForces::OnBody CarriedForces::of_law(const Directions& d, const ElementTrace::Law& law) const {
  OnBody on;
  on.is_law = true;
  on.change = Matrix::Zero(6, d.states.cols());
  on.sums.setZero();
  const Vector6 unit = (Vector6() << 1, 1, 1, 1 / length_, 1 / length_, 1 / length_).finished();
  for (const ElementTrace::Law::Partial& p : law.partials) {
    const Eigen::Map<const Vector6> value(p.value.data());
    const double size = partials_.size_of(d, {p.family, 0, p.column, 1.0});
    on.change += unit.cwiseProduct(value) * d.change[Directions::at(p.family)].row(p.column);
    on.sums += unit.cwiseProduct(value.cwiseAbs()) * size;
  }
  const auto vector = [](const Vector& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  const Eigen::Vector3d f = vector(law.force), t = vector(law.torque) / length_;
  on.load << f, t;
  on.place = vector(law.origin);
  on.axes << vector(law.axes.x), vector(law.axes.y), vector(law.axes.z);
  const Eigen::Vector3d own_f = (on.axes.transpose() * f).cwiseAbs(), own_t = (on.axes.transpose() * t).cwiseAbs();
  for (Index a = 0; a < 3; ++a) {  // what turns into it
    const Index b = (a + 1) % 3, c = (a + 2) % 3;
    const double across = std::max(own_f(b), own_f(c));
    on.size(a) = on.sums(a) + across;
    on.size(3 + a) = on.sums(3 + a) + std::max(own_t(b), own_t(c)) + across;
  }
  return on;
}

// δW − τ × W of all that acts on bodies that elements connect, reactions left out along what their own multipliers
// can do, and the best τ taken out.
void CarriedForces::add_group(const std::vector<const OnBody*>& on, const Eigen::Vector3d& origin, Index directions,
                              std::vector<Eigen::RowVectorXd>& rows) const {
  const Index count = static_cast<Index>(on.size());
  Matrix carried = Matrix::Zero(6 * count + 6, 6), change = Matrix::Zero(6 * count + 6, directions);
  for (Index e = 0; e < count; ++e) {
    const OnBody& part = *on[static_cast<std::size_t>(e)];
    const Eigen::Vector3d f = part.load.head<3>(), t = part.load.tail<3>();
    const Eigen::Matrix3d of_f = cross_matrix(f);
    Eigen::Matrix<double, 6, 6> by_motion = Eigen::Matrix<double, 6, 6>::Zero();  // of (turn, displacement by length)
    by_motion.block<3, 3>(0, 0) = -of_f;
    if (part.turns) {
      by_motion.block<3, 3>(3, 0) = -cross_matrix(t) + of_f * cross_matrix((part.place - origin) / length_);
      by_motion.block<3, 3>(3, 3) = -of_f;
    }
    Matrix left = Matrix::Identity(6, 6);
    if (part.reactions.cols() > 0 && !part.reactions.isZero(0)) {
      Matrix g = part.reactions;
      for (Index c = 0; c < g.cols(); ++c) {
        if (const double s = g.col(c).norm(); s > 0) g.col(c) /= s;
      }
      const Eigen::ColPivHouseholderQR<Matrix> qr(g);
      Matrix Q = columns_of_q(qr, qr.rank());
      left -= Q * Q.transpose();
    }
    Matrix own = part.change;
    if (part.is_law) {
      if (!part.turns) own.bottomRows(3).setZero();
      by_motion.topRows(3) = part.axes.transpose() * by_motion.topRows(3).eval();
      by_motion.bottomRows(3) = part.axes.transpose() * by_motion.bottomRows(3).eval();
    }
    const Vector6 of_size = part.size.unaryExpr([](double size) { return size > 0 ? 1 / size : 0.0; });
    carried.middleRows(6 * e, 6) = of_size.asDiagonal() * (left * by_motion);
    change.middleRows(6 * e, 6) = of_size.asDiagonal() * (left * own);
  }
  // Axes move about as far as bodies do: no load so small that only a long way would explain a change.
  carried.bottomRows(6) = 1e-2 * vanishing * Matrix::Identity(6, 6);
  const Eigen::HouseholderQR<Matrix> qr(carried);
  change.applyOnTheLeft(qr.householderQ().adjoint());
  change.topRows(6).setZero();
  change.applyOnTheLeft(qr.householderQ());
  for (Index r = 0; r < 6 * count; ++r) rows.push_back(change.row(r));
}

}  // namespace dynalin
