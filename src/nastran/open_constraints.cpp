#include "nastran/open_constraints.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "nastran/names.h"

namespace dynalin::nastran {

namespace {

// The components that rows of six hold, if they hold nothing else: "12345", empty if they mix components.
std::string unit_components(Eigen::MatrixXd rows) {
  constexpr double other_components = 1e-9;  // as good as positions satisfy constraints
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const double size = rows.row(r).norm();
    if (size == 0) return {};
    rows.row(r) /= size;
  }
  std::string components;
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    Eigen::Index i = 0, c = 0;
    rows.bottomRows(rows.rows() - r).cwiseAbs().maxCoeff(&i, &c);
    rows.row(r).swap(rows.row(r + i));
    if (std::abs(rows(r, c)) < 1e-6) return {};
    rows.row(r) /= rows(r, c);
    for (Eigen::Index k = 0; k < rows.rows(); ++k) {
      if (k != r) rows.row(k) -= (rows(k, c) * rows.row(r)).eval();
    }
    components += static_cast<char>('1' + c);
  }
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    for (Eigen::Index c = 0; c < 6; ++c) {
      if (c != components[static_cast<std::size_t>(r)] - '1' && std::abs(rows(r, c)) > other_components) return {};
    }
  }
  std::ranges::sort(components);
  return components;
}

}  // namespace

OpenConstraints::OpenConstraints(const System& system, const PerturbedPoint& at, const OpenDeck& open)
    : system_(system), at_(at), open_(open) {}

OpenConstraints::Row OpenConstraints::at_centres(std::int32_t row) const {
  std::map<std::int32_t, std::pair<double, double>> sums;  // and the sizes of their parts
  double largest = 0;
  for (const auto& e : at_.rows.row(row)) {
    open_.points.by_centres(e.column, [&](std::int32_t c, double along) {
      sums[c].first += along * e.c.g;
      sums[c].second += std::abs(along * e.c.g);
    });
    largest = std::max(largest, std::abs(e.c.g) * system_.coordinate_scale(e.column));
  }
  Row form;
  for (const auto& [c, sum] : sums) {
    const bool counts =
        std::abs(sum.first) > 4e-15 * sum.second && std::abs(sum.first) * system_.coordinate_scale(c) > 1e-15 * largest;
    if (counts) form[c] = sum.first;
  }
  return form;
}

std::vector<MatrixEntry> OpenConstraints::add() {
  std::vector<MatrixEntry> of_velocities;
  const auto& rows = system_.layout().rows;
  const auto& choice = at_.choice;
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(rows.size());) {
    const ElementLabel* owner = rows[static_cast<std::size_t>(k)].owner;
    std::vector<Row> active;
    for (; k < static_cast<std::int32_t>(rows.size()) && rows[static_cast<std::size_t>(k)].owner == owner; ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (rows[at].level == RowLevel::velocity) {
        if (choice.velocity_active[at]) add_velocity_row(k, of_velocities);
      } else if (choice.active[at]) {
        active.push_back(at_centres(k));
      }
    }
    if (active.empty() || (open_.options.use_rjoints && add_joint(*owner, active))) continue;
    for (const Row& row : active) add_relation(*owner, row);
  }
  return of_velocities;
}

void OpenConstraints::add_velocity_row(std::int32_t row, std::vector<MatrixEntry>& entries) {
  const ElementLabel& owner = *system_.layout().rows[static_cast<std::size_t>(row)].owner;
  const std::int32_t multiplier = open_.points.add_unknown("multiplier of " + name_of(owner, open_.options), owner.id);
  for (const auto& e : at_.rows.row(row)) {
    open_.points.by_centres(e.column, [&](std::int32_t c, double along) {
      entries.push_back({MatrixKind::B, multiplier, c, along * e.c.g});
      entries.push_back({MatrixKind::K, multiplier, c, along * e.c.v});
      entries.push_back({MatrixKind::K, c, multiplier, -along * e.c.g});
    });
  }
}

void OpenConstraints::add_relation(const ElementLabel& owner, const Row& row) {
  if (row.empty()) return;
  if (row.size() == 1) {
    // One that is alone in its row does not move.
    const Dof dof = open_.points.dof(row.begin()->first);
    open_.deck.fixed_points.push_back({{-1, name_of(owner, open_.options)}, dof.point, std::to_string(dof.component)});
    return;
  }
  // The largest comes first, by what it moves. One that depends on another row already does not depend on this as well,
  // if others are nearly as large.
  double largest = 0, largest_coefficient = 0;
  const auto moves = [&](const auto& term) { return std::abs(term.second) * system_.coordinate_scale(term.first); };
  for (const auto& term : row) {
    largest = std::max(largest, moves(term));
    largest_coefficient = std::max(largest_coefficient, std::abs(term.second));
  }
  auto first = row.end();
  for (const bool fresh : {true, false}) {
    for (auto term = row.begin(); term != row.end() && first == row.end(); ++term) {
      const bool free = !dependent_.contains(open_.points.dof(term->first));
      if (fresh ? free && moves(*term) >= 0.1 * largest : moves(*term) == largest) first = term;
    }
  }
  dependent_.insert(open_.points.dof(first->first));
  Relation relation;
  relation.name = name_of(owner, open_.options);
  relation.terms.push_back({open_.points.dof(first->first), first->second / largest_coefficient});
  for (auto term = row.begin(); term != row.end(); ++term) {
    if (term != first) relation.terms.push_back({open_.points.dof(term->first), term->second / largest_coefficient});
  }
  open_.deck.relations.push_back(std::move(relation));
}

std::array<double, 6> OpenConstraints::on_body(const Row& row, BodyId body, const Vector& at,
                                               const Matrix3& axes) const {
  const BodyBlock& block = system_.layout().body(body);
  Vector force, torque;
  for (std::int32_t k = 0; k < block.count; ++k) {
    const auto found = row.find(block.offset + k);
    if (found != row.end()) (k < 3 ? force : torque)[static_cast<std::size_t>(k % 3)] = found->second;
  }
  torque -= cross(at - open_.points.centre(body), force);
  force = transpose_times(axes, force), torque = transpose_times(axes, torque);
  return {force.x, force.y, force.z, torque.x, torque.y, torque.z};
}

bool OpenConstraints::add_joint(const ElementLabel& owner, const std::vector<Row>& rows) {
  const ReportedWrench* wrench = open_.wrenches.of(owner);
  if (!wrench || rows.size() > 6) return false;
  const MarkerId I = wrench->source->marker_I(wrench->which), J = wrench->source->marker_J(wrench->which);
  if (!I.valid() || !J.valid()) return false;
  const Model& model = system_.model();
  if (model.marker(I).floating || model.marker(J).floating) return false;
  const MarkerPlace &at_I = system_.layout().marker(I), &at_J = system_.layout().marker(J);
  if (at_I.shapes || at_J.shapes || at_I.body == at_J.body) return false;
  const Vector p = at_.motion.point(at_J);
  const double length = system_.length();
  if (norm(at_.motion.point(at_I) - p) > 1e-9 * length) return false;
  const Matrix3 axes = at_.motion.axes(at_J);

  Eigen::MatrixXd components(static_cast<Eigen::Index>(rows.size()), 6);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const auto& [unknown, v] : rows[r]) {
      const BodyId b = open_.points.body_of(unknown);
      if (b != at_I.body && b != at_J.body) return false;
    }
    const auto on_I = on_body(rows[r], at_I.body, p, axes), on_J = on_body(rows[r], at_J.body, p, axes);
    const bool I_moves = at_I.body != ground_body, J_moves = at_J.body != ground_body;
    for (std::size_t c = 0; c < 6; ++c) {
      const double unit = c < 3 ? 1 : 1 / length;
      components(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = unit * (I_moves ? on_I[c] : -on_J[c]);
    }
    if (!I_moves || !J_moves) continue;
    const double size = components.row(static_cast<Eigen::Index>(r)).norm();
    for (std::size_t c = 0; c < 6; ++c) {
      if (std::abs(on_I[c] + on_J[c]) * (c < 3 ? 1 : 1 / length) > 1e-9 * size) return false;
    }
  }
  const std::string held = unit_components(std::move(components));
  if (held.empty()) return false;
  RigidJoint joint;
  joint.name = name_of(owner, open_.options);
  joint.id =
      open_.ids.take(IdSpace::element, open_.options.rjoint_offset + (open_.options.use_adams_ids ? owner.id : 0));
  joint.grid_B = open_.markers.grid_of(J, Axes::local);
  // Of the body of I at the place of J and along its axes, so that components of both are the same.
  joint.grid_A = open_.points.add_riding_grid(at_I.body, fmt::format("{}, I", joint.name), p,
                                              open_.markers.system_of(J), system_.layout().marker_label(I).id);
  joint.components = held;
  open_.deck.rigid_joints.push_back(std::move(joint));
  return true;
}

}  // namespace dynalin::nastran
