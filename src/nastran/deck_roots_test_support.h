// What Nastran makes of a deck, densely and from the words of its cards alone: matrices in all degrees of freedom,
// the constraints eliminated by their null space, the finite roots of M s² + B s + K.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <complex>
#include <map>
#include <stdexcept>
#include <vector>

#include "analysis/statics.h"
#include "nastran/deck.h"
#include "study/linearization.h"
#include "system/model_test_support.h"

namespace dynalin::nastran_test {

using Complex = std::complex<double>;

template <class T>
T value_or_throw(StudyResult<T> result) {
  if (!result) throw std::runtime_error(result.error().analysis + ": " + result.error().message);
  return std::move(*result);
}

enum class Start { as_stated, at_rest };
// The linear model of a dataset (model_test_support.h) where it starts, or in static equilibrium.
inline Linearization linearization_of(std::shared_ptr<const System> system, Start start = Start::at_rest,
                                      const LinearRequest& request = {}) {
  auto point = value_or_throw(initial_conditions(as_drawn(std::move(system)))).point;
  if (start == Start::at_rest) point = value_or_throw(static_equilibrium(std::move(point), {})).point;
  return value_or_throw(linearized(point, request, Stateless::taken));
}
inline Linearization linearization_of(const std::string& text, Start start = Start::at_rest,
                                      const LinearRequest& request = {}) {
  return linearization_of(system_test::system_of(text), start, request);
}

// Every eigenvalue, both of a pair. [rad/time]
inline std::vector<Complex> eigenvalues_of(const Linearization& of) {
  std::vector<Complex> all;
  for (const EigenMode& mode : value_or_throw(modes_of(of, Vectors::none)).solution.modes) {
    const Complex s = mode.eigenvalue_hz * (2 * 3.14159265358979323846);
    for (std::size_t k = 0; k < mode.cluster_size; ++k) all.push_back(s);
    if (!mode.is_real) all.push_back(std::conj(s));
  }
  return all;
}

class DenseDeck {
 public:
  explicit DenseDeck(const nastran::Deck& deck) {
    using namespace nastran;
    axes_[0] = Eigen::Matrix3d::Identity();
    for (const CoordinateSystem& s : deck.systems) axes_[s.id] = matrix(s.axes);
    for (const auto* grids : {&deck.grids, &deck.shape_grids}) {
      for (const Grid& g : *grids) number(g.id, 6, g.position, g.displacement_system);
    }
    for (const ScalarPoint& p : deck.scalar_points) number(p.id, 1, {}, 0);
    M = B = K = Eigen::MatrixXd::Zero(size_, size_);
    for (const auto* grids : {&deck.grids, &deck.shape_grids}) {
      for (const Grid& g : *grids) fix(g.id, g.fixed);
    }
    for (const FixedPoint& f : deck.fixed_points) fix(f.point, f.components);
    for (const auto* elements : {&deck.rigid_elements, &deck.shape_ties}) {
      for (const RigidElement& e : *elements) {
        for (const std::int64_t d : e.dependent) tie(e.independent, d);
      }
    }
    for (const RigidJoint& j : deck.rigid_joints) join(j);
    for (const Relation& r : deck.relations) {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size_);
      for (const Relation::Term& t : r.terms) row(place(t.dof)) += t.coefficient;
      rows_.push_back(row);
    }
    for (const ConcentratedMass& m : deck.masses) add_mass(m);
    for (const Bush& b : deck.bushes) add_bush(b);
    for (const nastran::Matrix& m : deck.matrices) {
      for (const auto& e : m.entries)
        (m.kind == MatrixKind::M ? M : m.kind == MatrixKind::B ? B : K)(place(e.row), place(e.column)) += e.value;
    }
    eliminate();
  }

  Eigen::MatrixXd M, B, K;  // all degrees of freedom
  Eigen::MatrixXd free;     // motions that the constraints leave, a column each
  std::size_t rank = 0, rows = 0;

  Eigen::Index place(nastran::Dof d) const {
    const auto found = first_.find(d.point);
    if (found == first_.end()) throw std::runtime_error("no point " + std::to_string(d.point));
    if ((d.component == 0) != (count_.at(d.point) == 1)) throw std::runtime_error("component of a wrong point");
    return found->second + std::max(0, d.component - 1);
  }

  // Roots below a bound, by ν = 1/(s − σ): those at infinity are ν = 0.
  std::vector<Complex> roots(double sigma, double bound) const {
    const Eigen::MatrixXd m = free.transpose() * M * free, b = free.transpose() * B * free,
                          k = free.transpose() * K * free;
    const Eigen::Index n = m.rows();
    const Eigen::FullPivLU<Eigen::MatrixXd> p(sigma * sigma * m + sigma * b + k);
    EXPECT_TRUE(n == 0 || p.matrixLU().diagonal().cwiseAbs().minCoeff() > 0) << "nothing holds or moves some freedom";
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    companion.topLeftCorner(n, n) = -p.solve(b + 2 * sigma * m);
    companion.topRightCorner(n, n) = -p.solve(m);
    companion.bottomLeftCorner(n, n).setIdentity();
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion, false);
    std::vector<Complex> finite;
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
      const Complex nu = solver.eigenvalues()(i);
      if (std::abs(nu) > 1 / bound) finite.push_back(sigma + 1.0 / nu);
    }
    return finite;
  }

  // Displacement of one degree of freedom by a force on another at frequency s. A force with a part along constraints
  // does not see them.
  Complex response(nastran::Dof at, nastran::Dof force, Complex s) const {
    const Eigen::MatrixXcd z = (free.transpose() * (s * s * M + s * B + K.cast<Complex>()) * free);
    const Eigen::VectorXcd load = free.row(place(force)).transpose().cast<Complex>();
    const Eigen::VectorXcd q = z.fullPivLu().solve(load);
    return (free.row(place(at)).cast<Complex>() * q)(0);
  }

 private:
  static Eigen::Vector3d vector(const Vector& v) { return {v.x, v.y, v.z}; }
  static Eigen::Matrix3d matrix(const Matrix3& m) {
    Eigen::Matrix3d r;
    for (std::size_t c = 0; c < 3; ++c) r.col(static_cast<Eigen::Index>(c)) = vector(m[c]);
    return r;
  }
  static Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
  }
  void number(std::int64_t id, int count, const Vector& position, std::int64_t cd) {
    if (!first_.emplace(id, size_).second) throw std::runtime_error("point " + std::to_string(id) + " twice");
    count_[id] = count, position_[id] = vector(position), cd_[id] = cd;
    if (!axes_.contains(cd)) throw std::runtime_error("no system " + std::to_string(cd));
    size_ += count;
  }
  void fix(std::int64_t id, const std::string& components) {
    for (const char c : components) {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size_);
      row(place({id, c - '0'})) = 1;
      rows_.push_back(row);
    }
  }
  // Translation and rotation of a point that moves with a grid, global axes. [6 × all]
  Eigen::MatrixXd motion(std::int64_t grid, const Eigen::Vector3d& at) const {
    if (count_.at(grid) != 6) throw std::runtime_error("no grid");
    const Eigen::Matrix3d R = axes_.at(cd_.at(grid));
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(6, size_);
    const Eigen::Index c = first_.at(grid);
    m.block(0, c, 3, 3) = R, m.block(3, c + 3, 3, 3) = R;
    m.block(0, c + 3, 3, 3) = -cross(at - position_.at(grid)) * R;
    return m;
  }
  void tie(std::int64_t independent, std::int64_t dependent) {
    const Eigen::MatrixXd difference =
        motion(dependent, position_.at(dependent)) - motion(independent, position_.at(dependent));
    for (Eigen::Index r = 0; r < 6; ++r) rows_.push_back(difference.row(r));
  }
  void join(const nastran::RigidJoint& j) {
    EXPECT_LT((position_.at(j.grid_A) - position_.at(j.grid_B)).norm(), 1e-9) << "RJOINT between distant grids";
    const Eigen::Matrix3d R = axes_.at(cd_.at(j.grid_B));
    const Eigen::MatrixXd A = motion(j.grid_A, position_.at(j.grid_A)), b = motion(j.grid_B, position_.at(j.grid_B));
    for (const char c : j.components) {
      const int k = c - '1';
      rows_.push_back(R.col(k % 3).transpose() * (A - b).middleRows(k < 3 ? 0 : 3, 3));
    }
  }
  void add_mass(const nastran::ConcentratedMass& m) {
    const Eigen::Index c = first_.at(m.grid);
    EXPECT_EQ(cd_.at(m.grid), 0);
    M.block(c, c, 3, 3).diagonal().array() += m.mass;
    M.block(c + 3, c + 3, 3, 3) += matrix(m.inertia);
  }
  void add_bush(const nastran::Bush& b) {
    const Eigen::Vector3d a = position_.at(b.grid_A), at = a + b.location * (position_.at(b.grid_B) - a);
    Eigen::MatrixXd relative = motion(b.grid_B, at) - motion(b.grid_A, at);
    const Eigen::Matrix3d R = axes_.at(b.system);
    relative.topRows(3) = (R.transpose() * relative.topRows(3)).eval();
    relative.bottomRows(3) = (R.transpose() * relative.bottomRows(3)).eval();
    for (std::size_t k = 0; k < 6; ++k) {
      const Eigen::RowVectorXd row = relative.row(static_cast<Eigen::Index>(k));
      K += b.stiffness[k] * row.transpose() * row;
      B += b.damping[k] * row.transpose() * row;
    }
  }
  void eliminate() {
    rows = rows_.size();
    if (rows == 0) {
      free = Eigen::MatrixXd::Identity(size_, size_);
      return;
    }
    Eigen::MatrixXd all(static_cast<Eigen::Index>(rows), size_);
    for (std::size_t r = 0; r < rows; ++r) all.row(static_cast<Eigen::Index>(r)) = rows_[r].normalized();
    Eigen::FullPivLU<Eigen::MatrixXd> lu(all);
    lu.setThreshold(1e-9);
    rank = static_cast<std::size_t>(lu.rank());
    // The kernel by rank of the LU itself keeps unit entries: no scale mixes with another.
    free = lu.dimensionOfKernel() > 0 ? lu.kernel() : Eigen::MatrixXd(size_, 0);
  }

  std::map<std::int64_t, Eigen::Index> first_;
  std::map<std::int64_t, int> count_;
  std::map<std::int64_t, Eigen::Vector3d> position_;
  std::map<std::int64_t, std::int64_t> cd_;
  std::map<std::int64_t, Eigen::Matrix3d> axes_;
  Eigen::Index size_ = 0;
  std::vector<Eigen::RowVectorXd> rows_;
};

// The roots of a deck are the eigenvalues, all of them and nothing else below `factor` times the largest.
inline void expect_roots(const nastran::Deck& deck, std::vector<Complex> expected, double tolerance = 1e-8,
                         double factor = 1e3) {
  const DenseDeck dense(deck);
  EXPECT_EQ(deck.states, expected.size());
  double largest = 0, smallest = 1e300;
  for (const Complex& s : expected) {
    largest = std::max(largest, std::abs(s));
    if (std::abs(s) > 0) smallest = std::min(smallest, std::abs(s));
  }
  if (largest == 0) largest = smallest = 1;
  std::vector<Complex> found = dense.roots(0.77 * smallest + 0.11 * largest, factor * largest);
  EXPECT_EQ(found.size(), expected.size());
  for (const Complex& s : expected) {
    const auto nearest = std::ranges::min_element(found, {}, [&](const Complex& f) { return std::abs(f - s); });
    if (nearest == found.end()) {
      ADD_FAILURE() << "no root for " << s;
      continue;
    }
    // A multiple zero comes out of a dense solution as the root of its rounding.
    EXPECT_LE(std::abs(*nearest - s), s == Complex(0) ? 1e-5 * largest : tolerance * std::abs(s))
        << s << " against " << *nearest;
    found.erase(nearest);
  }
}

}  // namespace dynalin::nastran_test
