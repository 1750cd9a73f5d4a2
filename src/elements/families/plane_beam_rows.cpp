#include "elements/families/plane_beam_rows.h"

namespace dynalin {

namespace {

Vec3<Taylor> constant(const Vector& v) { return {Taylor(v.x), Taylor(v.y), Taylor(v.z)}; }
Vec3<Taylor> along(const BodyMotion& body, const Vector& v) { return body.axes() * constant(v); }

}  // namespace

PlaneBeamRows::PlaneBeamRows(const BeamBody& beam, const Model& model, Layout& layout) : plane_(*beam.plane) {
  const Vector& normal = unit_vectors[plane_.normal];
  for (std::size_t k = 0; k < beam.nodes.size(); ++k) {
    const Pose& drawn = model.body(beam.nodes[k]).pose;
    Node node{beam.nodes[k],
              0,
              layout.body(beam.nodes[k]).offset,
              layout.body_coordinate_count + static_cast<std::int32_t>(beam.slope(k)),
              beam.slope(k),
              drawn.r[plane_.normal],
              transpose_times(drawn.R, normal),
              transpose_times(drawn.R, cross(normal, drawn.R.x))};
    for (std::size_t row = 0; row < row_names.size(); ++row) {
      const std::int32_t at = layout.add_row(*beam.label, row_names[row]);
      if (row == 0) node.first_row = at;
    }
    for (std::int32_t i = 3; i < 6; ++i) layout.followers.insert(node.offset + i);
    nodes_.push_back(node);
  }
}

void PlaneBeamRows::constraints(const Motion& motion, ConstraintRows& rows) const {
  const Vec3<Taylor> none{}, normal = constant(unit_vectors[plane_.normal]);
  for (const Node& node : nodes_) {
    const BodyMotion& body = motion.body(node.body);
    const Vec3<Taylor> m = along(body, node.m), t = along(body, node.t);
    const Vec3<Taylor> s{motion.outside_poses(node.extra), motion.outside_poses(node.extra + 1),
                         motion.outside_poses(node.extra + 2)};
    std::int32_t row = node.first_row;
    Taylor height = along_motion(body.r, body.rdot, body.rddot)[plane_.normal];
    height.value -= node.height;
    rows.set(row, height);
    rows.add_pose(row++, node.body, normal, none);
    for (const std::size_t axis : {plane_.first, plane_.second}) {
      rows.set(row, m[axis]);
      rows.add_pose(row++, node.body, none, cross(m, constant(unit_vectors[axis])));
    }
    rows.set(row, s[plane_.normal]);
    rows.add_coordinate(row++, node.slope + static_cast<std::int32_t>(plane_.normal), Taylor(1.0));
    rows.set(row, dot(s, t));
    rows.add_pose(row, node.body, none, cross(t, s));
    for (std::int32_t i = 0; i < 3; ++i) rows.add_coordinate(row, node.slope + i, t[static_cast<std::size_t>(i)]);
  }
}

// Torques λ (m × a) and λ (t × s) turn with m and t, the second changes with s, and so does the force λ t on s with t.
void PlaneBeamRows::equations(const Motion& motion, Equations& eq) const {
  if (!eq.wants(PartialBy::position)) return;
  const auto add = [&](std::int32_t row, std::int32_t column, double factor, const Vector& v) {
    const std::array<double, 3> values = {-factor * v.x, -factor * v.y, -factor * v.z};
    eq.add(PartialBy::position, row, column, values);
  };
  for (const Node& node : nodes_) {
    eq.begin_constraint(node.first_row, static_cast<std::int32_t>(row_names.size()));
    const Matrix3& R = motion.body(node.body).R;
    const Vector m = R * node.m, t = R * node.t;
    const Vector s{motion.extra[node.extra], motion.extra[node.extra + 1], motion.extra[node.extra + 2]};
    const double* lambda = motion.lambda.data() + node.first_row;
    const std::int32_t spin = node.offset + 3;
    for (std::int32_t i = 0; i < 3; ++i) {
      const Vector& e = unit_vectors[static_cast<std::size_t>(i)];
      add(spin, spin + i, lambda[1], cross(cross(e, m), unit_vectors[plane_.first]));
      add(spin, spin + i, lambda[2], cross(cross(e, m), unit_vectors[plane_.second]));
      add(spin, spin + i, lambda[4], cross(cross(e, t), s));
      add(spin, node.slope + i, lambda[4], cross(t, e));
      add(node.slope, spin + i, lambda[4], cross(e, t));
    }
  }
}

}  // namespace dynalin
