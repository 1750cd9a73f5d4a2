#include "nastran_reader/equations.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <map>

#include "nastran_reader/selection.h"

namespace dynalin::nastran_reader {

namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Triplets = std::vector<Eigen::Triplet<double>>;

// What cancels up to rounding of terms of this size is zero.
void clear_rounding(Eigen::Ref<Eigen::MatrixXd> m, double size) {
  const double unit = 8 * std::numeric_limits<double>::epsilon() * size;
  m = (m.array().abs() <= unit).select(0, m);
}

class Assembly {
 public:
  Assembly(const Deck& deck, const Points& points) : deck_(deck), points_(points) {}

  Equations run() {
    for (const Mass& m : deck_.masses) mass(m);
    for (const ScalarElement& e : deck_.scalar_elements) scalar(e);
    for (const Bush& b : deck_.bushes) bush(b);
    direct();
    constraints();
    Equations out;
    const int n = points_.freedoms();
    for (const auto& [matrix, triplets] : {std::pair(&out.M, &m_), std::pair(&out.B, &b_), std::pair(&out.K, &k_)}) {
      matrix->resize(n, n);
      matrix->setFromTriplets(triplets->begin(), triplets->end());
    }
    out.rows = std::move(rows_);
    out.fixed.assign(static_cast<std::size_t>(n), false);
    fix(out.fixed);
    return out;
  }

 private:
  static void add(Triplets& to, int i, int j, double value) {
    if (value != 0) to.emplace_back(i, j, value);
  }

  void mass(const Mass& m) {
    const Point* p = points_.find(m.grid.id);
    if (!p || p->scalar) return;
    Matrix6 in_basic;
    if (m.matrix) {
      const Matrix3d R = points_.system(m.system.id)->at(p->position);
      Matrix6 turn = Matrix6::Zero();
      turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R;
      in_basic = turn * *m.matrix * turn.transpose();
    } else {
      const bool at_point = m.system.id == -1;
      // A system of any type gives the directions of its Cartesian axes.
      const Matrix3d R = at_point ? Matrix3d(Matrix3d::Identity()) : points_.system(m.system.id)->axes;
      const Vector3d arm = at_point ? Vector3d(m.offset - p->position) : Vector3d(R * m.offset);
      const Matrix3d d = cross_matrix(arm);
      in_basic.topLeftCorner<3, 3>() = m.mass * Matrix3d::Identity();
      in_basic.topRightCorner<3, 3>() = -m.mass * d;
      in_basic.bottomLeftCorner<3, 3>() = m.mass * d;
      in_basic.bottomRightCorner<3, 3>() = R * m.inertia * R.transpose() - m.mass * d * d;
    }
    Matrix6 turn = Matrix6::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = p->axes;
    Matrix6 local = turn.transpose() * in_basic * turn;
    for (const auto& [i, j] : {std::pair<Index, Index>{0, 0}, {0, 3}, {3, 0}, {3, 3}}) {
      auto block = local.block<3, 3>(i, j);
      clear_rounding(block, in_basic.block<3, 3>(i, j).cwiseAbs().maxCoeff());
    }
    const double scale = deck_.parameter("WTMASS", 1);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) add(m_, p->first + i, p->first + j, scale * local(i, j));
    }
  }

  void scalar(const ScalarElement& e) {
    double value = e.value;
    if (e.property.id > 0) {
      const char* card = e.kind == ScalarElement::Kind::stiffness ? "PELAS"
                         : e.kind == ScalarElement::Kind::damping ? "PDAMP"
                                                                  : "PMASS";
      value = deck_.scalar_properties.at(card).at(e.property.id);
    }
    if (e.kind == ScalarElement::Kind::mass) value *= deck_.parameter("WTMASS", 1);
    Triplets& to = e.kind == ScalarElement::Kind::stiffness ? k_ : e.kind == ScalarElement::Kind::damping ? b_ : m_;
    std::vector<int> at;
    for (const Freedom& f : e.ends) at.push_back(*points_.freedom(f));
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (std::size_t j = 0; j < at.size(); ++j) add(to, at[i], at[j], i == j ? value : -value);
    }
  }

  Matrix3d bush_axes(const Bush& b, const Point& a, const Point* end) const {
    if (b.system) return points_.system(b.system->id)->at(a.position);
    Matrix3d axes;
    const Vector3d x = (end->position - a.position).normalized();
    Vector3d toward = x.unitOrthogonal();
    if (b.direction_grid) {
      toward = points_.find(b.direction_grid->id)->position - a.position;
    } else if (b.direction) {
      toward = a.axes * *b.direction;
    }
    const Vector3d z = x.cross(toward).normalized();
    axes << x, z.cross(x), z;
    return axes;
  }

  void bush(const Bush& b) {
    const Point *a = points_.find(b.a.id), *end = b.b.id > 0 ? points_.find(b.b.id) : nullptr;
    const BushProperty* property = nullptr;
    for (const BushProperty& p : deck_.bush_properties) {
      if (p.id.id == b.property.id) property = &p;
    }
    const Matrix3d axes = bush_axes(b, *a, end);
    Vector3d place = a->position;
    if (b.offset_system) {
      place = points_.system(b.offset_system->id)->to_basic(b.offset);
    } else if (end) {
      place += b.along * (end->position - a->position);
    }
    // The motion of each end at the place of the spring, along its axes.
    const auto motion = [&](const Point& p) {
      const Vector3d arm = place - p.position;
      Matrix6 m = Matrix6::Zero();
      m.topLeftCorner<3, 3>() = m.bottomRightCorner<3, 3>() = axes.transpose() * p.axes;
      m.topRightCorner<3, 3>() = -axes.transpose() * cross_matrix(arm) * p.axes;
      auto turn = m.topLeftCorner<3, 3>();
      clear_rounding(turn, 1);
      auto turn_too = m.bottomRightCorner<3, 3>();
      clear_rounding(turn_too, 1);
      auto lever = m.topRightCorner<3, 3>();
      clear_rounding(lever, arm.norm());
      return m;
    };
    const Index columns = end ? 12 : 6;
    Eigen::MatrixXd relative(6, columns);
    relative.leftCols(6) = -motion(*a);
    if (end) relative.rightCols(6) = motion(*end);
    for (const auto& [values, to] : {std::pair(&property->stiffness, &k_), std::pair(&property->damping, &b_)}) {
      if (values->isZero(0)) continue;
      const Eigen::MatrixXd m = relative.transpose() * values->asDiagonal() * relative;
      for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < columns; ++j) {
          const int row = i < 6 ? a->first + i : end->first + i - 6, column = j < 6 ? a->first + j : end->first + j - 6;
          add(*to, row, column, m(i, j));
        }
      }
    }
  }

  void direct() {
    struct Use {
      const char *command, *parameter;
      Triplets* to;
    };
    const Use uses[] = {{"K2PP", nullptr, &k_}, {"B2PP", nullptr, &b_}, {"M2PP", nullptr, &m_},
                        {"K2GG", "CK2", &k_},   {"B2GG", "CB2", &b_},   {"M2GG", "CM2", &m_}};
    for (const Use& use : uses) {
      const auto named = deck_.control.matrices.find(use.command);
      if (named == deck_.control.matrices.end()) continue;
      const double scale = use.parameter ? deck_.parameter(use.parameter, 1) : 1;
      for (const MatrixUse& u : named->second) {
        for (const DirectMatrix& m : deck_.matrices) {
          if (m.name != u.name) continue;
          for (const DirectMatrix::Term& t : m.terms) {
            const int i = *points_.freedom(t.row), j = *points_.freedom(t.column);
            const double value = scale * u.factor * t.value;
            add(*use.to, i, j, value);
            if (m.form == 6 && i != j) add(*use.to, j, i, value);
          }
        }
      }
    }
  }

  void constraints() {
    const std::set<int> sets = sets_of(deck_.control.mpc, deck_.mpc_sums);
    for (const Mpc& m : deck_.mpcs) {
      if (!sets.contains(m.set.id)) continue;
      std::map<int, double> terms;
      for (const Mpc::Term& t : m.terms) terms[*points_.freedom(t.freedom)] += t.coefficient;
      ConstraintRow row{{}, fmt::format("MPC of set {}", m.set.id), m.at};
      for (const auto& [f, value] : terms) {
        if (value != 0) row.terms.emplace_back(f, value);
      }
      rows_.push_back(std::move(row));
    }
    for (const RigidElement& r : deck_.rigid) {
      const Point* a = points_.find(r.a.id);
      for (const Reference& d : r.dependent) {
        const Point* b = points_.find(d.id);
        if (r.kind == RigidElement::Kind::bar) {
          bar(r, *a, *b);
          continue;
        }
        Matrix6 map = rigid_map(*a, *b);
        if (r.kind == RigidElement::Kind::joint) map.topRightCorner<3, 3>().setZero();
        for (int c = 0; c < 6; ++c) {
          if (!(r.components >> c & 1)) continue;
          ConstraintRow row;
          row.terms.emplace_back(b->first + c, -1.0);
          for (int k = 0; k < 6; ++k) {
            if (map(c, k) != 0) row.terms.emplace_back(a->first + k, map(c, k));
          }
          row.card = r.kind == RigidElement::Kind::joint
                         ? fmt::format("RJOINT {} component {}", r.id.id, c + 1)
                         : fmt::format("RBE2 {} grid {} component {}", r.id.id, d.id, c + 1);
          row.at = d.at;
          rows_.push_back(std::move(row));
        }
      }
    }
  }

  // Six independent components give the rigid motion, and that the others.
  void bar(const RigidElement& r, const Point& a, const Point& b) {
    Eigen::Matrix<double, 12, 6> motion;
    motion.topRows<6>().setIdentity();
    motion.bottomRows<6>() = rigid_map(a, b);
    Matrix6 free;
    std::vector<int> at;
    for (int k = 0; k < 12; ++k) {
      const Components set = k < 6 ? r.free_a : r.free_b;
      if (!(set >> (k % 6) & 1)) continue;
      free.row(static_cast<Index>(at.size())) = motion.row(k);
      at.push_back((k < 6 ? a.first : b.first) + k % 6);
    }
    const Eigen::Matrix<double, 12, 6> by_free = motion * free.fullPivLu().inverse();
    for (int k = 0; k < 12; ++k) {
      const Components set = k < 6 ? r.tied_a : r.tied_b;
      if (!(set >> (k % 6) & 1)) continue;
      ConstraintRow row;
      row.terms.emplace_back((k < 6 ? a.first : b.first) + k % 6, -1.0);
      for (Index c = 0; c < 6; ++c) {
        if (by_free(k, c) != 0) row.terms.emplace_back(at[static_cast<std::size_t>(c)], by_free(k, c));
      }
      row.card = fmt::format("RBAR {} component {}", r.id.id, k % 6 + 1);
      row.at = r.id.at;
      rows_.push_back(std::move(row));
    }
  }

  void fix(std::vector<bool>& fixed) const {
    const auto set = [&](const Point& p, Components components) {
      if (p.scalar) {
        fixed[static_cast<std::size_t>(p.first)] = true;
        return;
      }
      for (int c = 0; c < 6; ++c) {
        if (components >> c & 1) fixed[static_cast<std::size_t>(p.first + c)] = true;
      }
    };
    for (const Point& p : points_.all()) {
      if (p.fixed) set(p, p.fixed);
    }
    const std::set<int> sets = sets_of(deck_.control.spc, deck_.spc_sums);
    for (const Spc& s : deck_.spcs) {
      if (!sets.contains(s.set.id)) continue;
      for (const Point* p : held_points(s, points_)) set(*p, s.components);
    }
  }

  const Deck& deck_;
  const Points& points_;
  Triplets m_, b_, k_;
  std::vector<ConstraintRow> rows_;
};

}  // namespace

Matrix6 rigid_map(const Point& a, const Point& b) {
  const Vector3d arm = b.position - a.position;
  Matrix6 m = Matrix6::Zero();
  m.topLeftCorner<3, 3>() = b.axes.transpose() * a.axes;
  auto turn = m.topLeftCorner<3, 3>();
  clear_rounding(turn, 1);
  m.bottomRightCorner<3, 3>() = m.topLeftCorner<3, 3>();
  m.topRightCorner<3, 3>() = -b.axes.transpose() * cross_matrix(arm) * a.axes;
  auto lever = m.topRightCorner<3, 3>();
  clear_rounding(lever, arm.norm());
  return m;
}

Equations assemble(const Deck& deck, const Points& points) { return Assembly(deck, points).run(); }

}  // namespace dynalin::nastran_reader
