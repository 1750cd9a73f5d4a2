#include <algorithm>
#include <numbers>

#include "evaluation.h"
#include "model.h"

namespace dynalin::oracle {

void Model::read_joint(std::size_t k) {
  using Type = Row::Type;
  struct Pattern {
    Type type;
    int axis_i, axis_j;
  };
  const std::vector<Pattern> coincide{{Type::point, 0, 0}, {Type::point, 0, 1}, {Type::point, 0, 2}};
  const std::vector<Pattern> aligned{{Type::direction, 2, 0}, {Type::direction, 2, 1}};
  const Joint& joint = mechanism_.joints[k];
  joint_index_[joint.id] = static_cast<int>(k);
  joint_markers_.push_back({marker_index(joint.i), marker_index(joint.j)});
  std::vector<Pattern> patterns;
  const auto is = [&](std::initializer_list<JointType> types) {
    return std::find(types.begin(), types.end(), joint.type) != types.end();
  };
  using enum JointType;
  if (is({revolute, spherical, universal, fixed, hooke, convel, atpoint})) patterns = coincide;
  if (is({translational, cylindrical, inline_})) patterns.assign(coincide.begin(), coincide.begin() + 2);
  if (is({planar, inplane, gcon_plane})) patterns.push_back(coincide[2]);
  if (is({revolute, translational, fixed, cylindrical, planar, orientation, parallel_axes})) {
    patterns.insert(patterns.end(), aligned.begin(), aligned.end());
  }
  if (is({translational, fixed, orientation, hooke, convel})) patterns.push_back({Type::direction, 0, 1});
  if (is({universal, perpendicular, gcon_right_angle})) patterns.push_back({Type::direction, 2, 2});
  if (is({screw, rackpin})) patterns.push_back({Type::expression, 0, 0});
  for (const Pattern& p : patterns) {
    Row row{p.type, joint_markers_[k][0], joint_markers_[k][1], p.axis_i, p.axis_j, static_cast<int>(k)};
    row.swapped = joint.type == convel && p.type == Type::direction;
    const Expr travel = measure(Measure::DZ, {joint.i, joint.j, joint.j});
    if (joint.type == screw) {
      row.function = travel - joint.size / (2 * std::numbers::pi) * measure(Measure::AZ, {joint.i, joint.j});
    }
    if (joint.type == rackpin) {
      // The pinion's turn about its z axis, against the line of the rack: z_J turns the other way in the axes of I.
      const Expr line = call(Function::atan2, {axis_component(Measure::UVZ, joint.j, joint.i, 1),
                                               axis_component(Measure::UVZ, joint.j, joint.i, 0)});
      row.function = travel + joint.size / 2 * line;
    }
    rows.push_back(row);
  }
}

// Position rows first, velocity rows last: a position row that is independent of the positions before it stays so.
void Model::read_rows() {
  for (std::size_t k = 0; k < carried_.size(); ++k) {
    for (int component = 0; component < 6; ++component) {
      Row row{Row::Type::shape};
      row.carried = k, row.component = component;
      rows.push_back(row);
    }
  }
  for (std::size_t k = 0; k < plane_nodes_.size(); ++k) {
    for (int component = 0; component < 5; ++component) {
      Row row{Row::Type::plane};
      row.carried = k, row.component = component;
      rows.push_back(row);
    }
  }
  for (std::size_t k = 0; k < mechanism_.joints.size(); ++k) read_joint(k);
  read_relations();
  read_motions();
  read_contacts();
  for (const bool of_rates : {false, true}) {
    for (const Gcon& g : mechanism_.gcons) {
      if (g.of_rates != of_rates) continue;
      Row row{Row::Type::expression};
      row.function = g.function;
      row.of_rates = of_rates;
      rows.push_back(row);
    }
  }
}

void Model::read_relations() {
  const auto displacement = [&](const Joint& joint, char freedom) {
    return freedom == 'T' ? measure(Measure::DZ, {joint.i, joint.j, joint.j})
                          : measure(Measure::AZ, {joint.i, joint.j});
  };
  const auto joint_of = [&](int id) -> const Joint& {
    return mechanism_.joints[static_cast<std::size_t>(joint_index_.at(id))];
  };
  for (const Coupler& c : mechanism_.couplers) {
    Row row{Row::Type::expression};
    row.function = constant(0);
    for (std::size_t k = 0; k < c.joints.size(); ++k) {
      row.function = row.function + c.scales[k] * displacement(joint_of(c.joints[k]), c.freedoms[k]);
    }
    rows.push_back(row);
  }
  // Each gear moves the pitch point along z of CV by b q + c p, with constants of the carrier.
  for (const Gear& g : mechanism_.gears) {
    Row row{Row::Type::expression};
    row.function = constant(0);
    const MarkerData& cv = marker_data_[static_cast<std::size_t>(marker_index(g.cv))];
    for (std::size_t k = 0; k < 2; ++k) {
      const Joint& joint = joint_of(g.joints[k]);
      const MarkerData& i = marker_data_[static_cast<std::size_t>(marker_index(joint.i))];
      const MarkerData& j = marker_data_[static_cast<std::size_t>(marker_index(joint.j))];
      const bool holds_j = j.body == cv.body;
      const MarkerData& at = holds_j ? j : i;
      const Real sign = (holds_j ? 1 : -1) * (k == 0 ? 1 : -1);
      const Vec axis = at.R.column[2], tooth = cv.R.column[2];
      const double b = static_cast<double>(sign * dot(cross(axis, cv.p - at.p), tooth));
      const double c = static_cast<double>(sign * dot(axis, tooth));
      if (joint.type != JointType::translational) row.function = row.function + b * displacement(joint, 'R');
      if (joint.type != JointType::revolute) row.function = row.function + c * displacement(joint, 'T');
    }
    rows.push_back(row);
  }
}

void Model::read_motions() {
  for (std::size_t k = 0; k < mechanism_.motions.size(); ++k) {
    const auto joint = static_cast<std::size_t>(joint_index_.at(mechanism_.motions[k].joint));
    const char freedom = mechanism_.motions[k].freedom;
    const int axis = freedom == 'X' ? 0 : freedom == 'Y' ? 1 : 2;
    Row row{freedom == 'R' ? Row::Type::angle : Row::Type::point,
            joint_markers_[joint][0],
            joint_markers_[joint][1],
            0,
            axis,
            -1,
            static_cast<int>(k)};
    if (freedom >= '1' && freedom <= '3') {
      // C = Rx(B1) Ry(B2) Rz(B3) holds e_J . e_I: its first row is (cos B2 cos B3, -cos B2 sin B3, sin B2), its last
      // column (sin B2, -sin B1 cos B2, cos B1 cos B2).
      const int i = mechanism_.joints[joint].i, j = mechanism_.joints[joint].j;
      const auto C = [&](int along_j, Measure axis_i) { return axis_component(axis_i, i, j, along_j); };
      row.type = Row::Type::expression;
      const Expr sine = C(0, Measure::UVZ);
      if (freedom == '1') row.function = call(Function::atan2, {-1.0 * C(1, Measure::UVZ), C(2, Measure::UVZ)});
      if (freedom == '2') row.function = call(Function::asin, {sine});
      if (freedom == '3') row.function = call(Function::atan2, {-1.0 * C(0, Measure::UVY), C(0, Measure::UVX)});
    }
    rows.push_back(row);
  }
}

// SCREW, RACKPIN and GEAR count from the configuration of the dataset; a COUPLER from the zero of its joints.
void Model::capture_offsets() {
  const std::size_t couplers = mechanism_.couplers.size();
  std::size_t relation = 0;
  for (Row& row : rows) {
    if (row.type != Row::Type::expression || row.of_rates || row.motion >= 0) continue;
    const bool of_joint = row.joint >= 0;
    const bool of_gear = !of_joint && relation >= couplers && relation < couplers + mechanism_.gears.size();
    if (!of_joint) ++relation;
    if (of_joint || of_gear) row.offset = evaluate(row.function);
  }
  for (const Friction& f : mechanism_.frictions) {
    const auto [i, j] = joint_markers_[static_cast<std::size_t>(joint_index_.at(f.joint))];
    friction_start_.push_back(dot(between(i, j), markers_[static_cast<std::size_t>(j)].axis[2]));
  }
}

// The gradient of an expression by body displacements, or by body velocities for a velocity row: one variation at a
// time. Velocity rows are affine, so that it needs no velocities.
const std::vector<Wrench>& Model::gradient_of(const Row& row) const {
  if (!row.gradient.empty()) return row.gradient;
  row.gradient.assign(bodies.size(), Wrench{});
  const Node& node = *row.function.node;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (node.op == Op::gap && !touches(static_cast<std::size_t>(node.ids[0]), static_cast<int>(b))) continue;
    for (int c = 0; c < 6; ++c) {
      Variation variation{static_cast<int>(b), Vec{}, Vec{}, row.of_rates};
      set_component(c < 3 ? variation.shift : variation.turn, c % 3, 1);
      const Real slope = Evaluator<Jet>(*this, &variation)(row.function).d;
      set_component(c < 3 ? row.gradient[b].f : row.gradient[b].t, c % 3, slope);
    }
  }
  return row.gradient;
}

Real Model::drive(const Row& row, std::size_t derivative) const {
  return row.motion < 0 ? 0
                        : motion_values(mechanism_.motions[static_cast<std::size_t>(row.motion)].f, time)[derivative];
}

Real Model::row_position(const Row& row) const {
  if (row.type == Row::Type::shape) return shape_row(row)[0];
  if (row.type == Row::Type::plane) return plane_row(row)[0];
  const MarkerMotion& i = markers_[static_cast<std::size_t>(row.i)];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(row.j)];
  const Vec& e_j = j.axis[static_cast<std::size_t>(row.axis_j)];
  if (row.of_rates) return 0;
  if (row.type == Row::Type::expression) return evaluate(row.function) - row.offset - drive(row, 0);
  if (row.type == Row::Type::point) return dot(i.p - j.p, e_j) - drive(row, 0);
  if (row.type == Row::Type::direction) {
    const Real product = dot(i.axis[static_cast<std::size_t>(row.axis_i)], e_j);
    if (!row.swapped) return product;
    return product - dot(j.axis[static_cast<std::size_t>(row.axis_i)], i.axis[static_cast<std::size_t>(row.axis_j)]);
  }
  // A driven joint may have made many turns: the row is the remainder modulo one turn.
  return std::remainder(angle_z(row.i, row.j) - drive(row, 0), 2 * std::numbers::pi_v<Real>);
}

Real Model::row_velocity(const Row& row) const {
  if (row.type == Row::Type::shape) return shape_row(row)[1];
  if (row.type == Row::Type::plane) return plane_row(row)[1];
  const MarkerMotion& i = markers_[static_cast<std::size_t>(row.i)];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(row.j)];
  const auto ai = static_cast<std::size_t>(row.axis_i), aj = static_cast<std::size_t>(row.axis_j);
  if (row.of_rates) return evaluate(row.function);
  if (row.type == Row::Type::expression) return evaluate_along(row.function).d - drive(row, 1);
  if (row.type == Row::Type::point) {
    return dot(i.v - j.v, j.axis[aj]) + dot(i.p - j.p, j.axis1[aj]) - drive(row, 1);
  }
  if (row.type == Row::Type::direction) {
    const auto rate = [](const MarkerMotion& m, std::size_t a, const MarkerMotion& n, std::size_t b) {
      return dot(m.axis1[a], n.axis[b]) + dot(m.axis[a], n.axis1[b]);
    };
    return rate(i, ai, j, aj) - (row.swapped ? rate(j, ai, i, aj) : 0);
  }
  // Along motions that keep the z axes parallel the rate of AZ is the relative rate about z_J.
  return dot(i.w - j.w, j.axis[2]) - drive(row, 1);
}

Real Model::row_acceleration(const Row& row) const {
  if (row.type == Row::Type::shape) return shape_row(row)[2];
  if (row.type == Row::Type::plane) return plane_row(row)[2];
  const MarkerMotion& i = markers_[static_cast<std::size_t>(row.i)];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(row.j)];
  const auto ai = static_cast<std::size_t>(row.axis_i), aj = static_cast<std::size_t>(row.axis_j);
  if (row.type == Row::Type::expression) {
    const Jet along = evaluate_along(row.function);
    return row.of_rates ? along.d : along.dd - drive(row, 2);
  }
  if (row.type == Row::Type::point) {
    return dot(i.a - j.a, j.axis[aj]) + 2 * dot(i.v - j.v, j.axis1[aj]) + dot(i.p - j.p, j.axis2[aj]) - drive(row, 2);
  }
  if (row.type == Row::Type::direction) {
    const auto second = [](const MarkerMotion& m, std::size_t a, const MarkerMotion& n, std::size_t b) {
      return dot(m.axis2[a], n.axis[b]) + 2 * dot(m.axis1[a], n.axis1[b]) + dot(m.axis[a], n.axis2[b]);
    };
    return second(i, ai, j, aj) - (row.swapped ? second(j, ai, i, aj) : 0);
  }
  return dot(i.al - j.al, j.axis[2]) + dot(i.w - j.w, j.axis1[2]) - drive(row, 2);
}

Wrench Model::row_wrench(const Row& row) const {
  const MarkerMotion& i = markers_[static_cast<std::size_t>(row.i)];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(row.j)];
  const auto ai = static_cast<std::size_t>(row.axis_i), aj = static_cast<std::size_t>(row.axis_j);
  switch (row.type) {
    case Row::Type::point:
      return {j.axis[aj], Vec{}};
    case Row::Type::direction: {
      const Vec t = cross(i.axis[ai], j.axis[aj]);
      return {Vec{}, row.swapped ? t - cross(i.axis[aj], j.axis[ai]) : t};
    }
    case Row::Type::angle:
      return {Vec{}, j.axis[2]};
    case Row::Type::expression:
    case Row::Type::shape:
    case Row::Type::plane:
      break;
  }
  // Of an expression of I and J alone: what it does to the body of I, moved to the origin of I.
  const auto b = static_cast<std::size_t>(marker_data_[static_cast<std::size_t>(row.i)].body);
  const Wrench& on_body = gradient_of(row)[b];
  return {on_body.f, on_body.t - cross(i.p - motion[b].p, on_body.f)};
}

void Model::apply_row(std::vector<Wrench>& loads, const Row& row, Real size) const {
  if (row.type == Row::Type::expression) {
    const std::vector<Wrench>& gradient = gradient_of(row);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      loads[b].f += size * gradient[b].f;
      loads[b].t += size * gradient[b].t;
    }
    return;
  }
  if (row.type == Row::Type::shape) return apply_shape(loads, row, size);
  if (row.type == Row::Type::plane) return apply_plane_row(loads, row, size);
  const Wrench unit = row_wrench(row);
  const Vec at = markers_[static_cast<std::size_t>(row.i)].p;
  apply(loads, row.i, at, unit, size);
  apply(loads, row.j, at, unit, -size);
}

Dense Model::gradient() const {
  Dense G(rows.size(), static_cast<std::size_t>(dofs));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::vector<Wrench> unit(bodies.size());
    apply_row(unit, rows[k], 1);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      for (int c = 0; c < bodies[b].dof; ++c) {
        G(k, static_cast<std::size_t>(bodies[b].offset + c)) =
            c < 3 ? component(unit[b].f, c) : component(unit[b].t, c - 3);
      }
    }
  }
  return G;
}

Wrench Model::joint_wrench(int joint) const {
  Wrench sum;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].joint != joint) continue;
    const Wrench unit = row_wrench(rows[k]);
    sum.f += lambda[k] * unit.f;
    sum.t += lambda[k] * unit.t;
  }
  return sum;
}

Wrench Model::motion_wrench(int motion_number) const {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].motion != motion_number) continue;
    const Wrench unit = row_wrench(rows[k]);
    return {lambda[k] * unit.f, lambda[k] * unit.t};
  }
  return {};
}

}  // namespace dynalin::oracle
