#include "model.h"

#include <algorithm>
#include <numbers>
#include <set>

namespace dynalin::oracle {

namespace {

Mat inertia_about_cm(const Body& body, const Vec& from_im_to_cm) {
  const auto& ip = body.ip;
  Mat J{{Vec{ip[0], -static_cast<Real>(ip[3]), -static_cast<Real>(ip[4])},
         Vec{-static_cast<Real>(ip[3]), ip[1], -static_cast<Real>(ip[5])},
         Vec{-static_cast<Real>(ip[4]), -static_cast<Real>(ip[5]), ip[2]}}};
  // m (|s|^2 E - s s^T) = -m s^ s^
  const Mat S = skew(from_im_to_cm);
  return J + static_cast<Real>(body.mass) * (S * S);
}

}  // namespace

std::array<Real, 3> motion_values(const TimeFunction& f, Real t) {
  const Real amplitude = f.amplitude, frequency = f.frequency, phase = f.phase;
  const Real argument = frequency * t + phase;
  const Real s = std::sin(argument), c = std::cos(argument);
  return {f.c[0] + t * (f.c[1] + t * (f.c[2] + t * static_cast<Real>(f.c[3]))) + amplitude * s,
          f.c[1] + t * (2.0L * f.c[2] + t * 3.0L * f.c[3]) + amplitude * frequency * c,
          2.0L * f.c[2] + 6.0L * f.c[3] * t - amplitude * frequency * frequency * s};
}

std::vector<int> independent_rows(const Dense& m, Real tolerance) {
  std::vector<int> chosen;
  std::vector<std::vector<Real>> basis;
  for (std::size_t i = 0; i < m.rows(); ++i) {
    std::vector<Real> r(m.columns());
    Real before = 0;
    for (std::size_t j = 0; j < r.size(); ++j) {
      r[j] = m(i, j);
      before += r[j] * r[j];
    }
    for (int pass = 0; pass < 2; ++pass) {
      for (const auto& q : basis) {
        Real along = 0;
        for (std::size_t j = 0; j < r.size(); ++j) along += q[j] * r[j];
        for (std::size_t j = 0; j < r.size(); ++j) r[j] -= along * q[j];
      }
    }
    Real after = 0;
    for (const Real v : r) after += v * v;
    if (!(std::sqrt(after) > tolerance * std::sqrt(before))) continue;
    for (Real& v : r) v /= std::sqrt(after);
    basis.push_back(std::move(r));
    chosen.push_back(static_cast<int>(i));
  }
  return chosen;
}

Model::Model(const Mechanism& mechanism) : mechanism_(mechanism) {
  read_bodies();
  read_rows();
  read_controls();
  motion.resize(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto found = std::find_if(mechanism_.bodies.begin(), mechanism_.bodies.end(),
                                    [&](const Body& body) { return body.ref == bodies[b].ref; });
    const Triple& e = found->reuler;
    motion[b].p = to_vec(found->qg);
    motion[b].R = rotation_313(e[0], e[1], e[2]);
  }
  markers_.resize(marker_data_.size());
  update_positions();
  for (const MarkerMotion& a : markers_) {
    for (const MarkerMotion& b : markers_) length = std::max(length, norm(a.p - b.p));
  }
  active.resize(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) active[k] = static_cast<int>(k);
  lambda.assign(rows.size(), 0);
}

int Model::body_index(const BodyRef& ref) const {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].ref == ref) return static_cast<int>(b);
  }
  throw std::runtime_error("a body is missing");
}

void Model::read_bodies() {
  for (const Body& body : mechanism_.bodies) {
    BodyData data;
    data.ref = body.ref;
    if (body.ref.kind == BodyKind::ground) {
      bodies.insert(bodies.begin(), data);
    } else {
      bodies.push_back(data);
    }
  }
  for (BodyData& body : bodies) {
    body.dof = body.ref.kind == BodyKind::ground ? 0 : (body.ref.kind == BodyKind::part ? 6 : 3);
    body.offset = dofs;
    dofs += body.dof;
  }
  marker_data_.push_back({0, Vec{}, Mat{}});
  marker_index_[0] = 0;
  for (const Marker& marker : mechanism_.markers) {
    BodyRef owner = marker.body;
    marker_index_[marker.id] = static_cast<int>(marker_data_.size());
    marker_data_.push_back(
        {body_index(owner), to_vec(marker.qp), rotation_313(marker.reuler[0], marker.reuler[1], marker.reuler[2])});
  }
  for (const Body& body : mechanism_.bodies) {
    if (body.ref.kind == BodyKind::ground || body.cm == 0) continue;
    BodyData& data = bodies[static_cast<std::size_t>(body_index(body.ref))];
    const MarkerData& cm = marker_data_[static_cast<std::size_t>(marker_index(body.cm))];
    const int im_id = body.im == 0 ? body.cm : body.im;
    const MarkerData& im = marker_data_[static_cast<std::size_t>(marker_index(im_id))];
    data.mass = body.mass;
    data.c = cm.p;
    if (body.ref.kind == BodyKind::point_mass) {
      data.inertia = zero_matrix();
    } else {
      const Vec s = transpose(im.R) * (cm.p - im.p);
      data.inertia = im.R * inertia_about_cm(body, s) * transpose(im.R);
    }
  }
  for (const Body& body : mechanism_.bodies) {
    if (body.cm == 0) bodies[static_cast<std::size_t>(body_index(body.ref))].inertia = zero_matrix();
  }
}

void Model::read_rows() {
  using Type = Row::Type;
  struct Pattern {
    Type type;
    int axis_i, axis_j;
  };
  const std::vector<Pattern> coincide{{Type::point, 0, 0}, {Type::point, 0, 1}, {Type::point, 0, 2}};
  const std::vector<Pattern> aligned{{Type::direction, 2, 0}, {Type::direction, 2, 1}};
  for (std::size_t k = 0; k < mechanism_.joints.size(); ++k) {
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
    for (const Pattern& p : patterns) {
      rows.push_back({p.type, joint_markers_[k][0], joint_markers_[k][1], p.axis_i, p.axis_j, static_cast<int>(k), -1,
                      joint.type == convel && p.type == Type::direction});
    }
  }
  for (std::size_t k = 0; k < mechanism_.motions.size(); ++k) {
    const auto joint = static_cast<std::size_t>(joint_index_.at(mechanism_.motions[k].joint));
    const char freedom = mechanism_.motions[k].freedom;
    const int axis = freedom == 'X' ? 0 : freedom == 'Y' ? 1 : 2;
    rows.push_back({freedom == 'R' ? Type::angle : Type::point, joint_markers_[joint][0], joint_markers_[joint][1], 0,
                    axis, -1, static_cast<int>(k)});
  }
}

void Model::read_controls() {
  for (std::size_t k = 0; k < mechanism_.variables.size(); ++k) {
    variable_index_[mechanism_.variables[k].id] = static_cast<int>(k);
  }
  variable_values.assign(mechanism_.variables.size(), 0);
  cut.assign(mechanism_.variables.size(), 0);
  cut_values.assign(mechanism_.variables.size(), 0);
  sforce_values.assign(mechanism_.sforces.size(), 0);
  component_values.assign(6 * mechanism_.gforces.size(), 0);
  for (std::size_t k = 0; k < mechanism_.gforces.size(); ++k) {
    gforce_index_[mechanism_.gforces[k].id] = static_cast<int>(k);
  }
  for (std::size_t k = 0; k < mechanism_.arrays.size(); ++k) {
    array_index_[mechanism_.arrays[k].id] = static_cast<int>(k);
  }
  for (std::size_t k = 0; k < mechanism_.sforces.size(); ++k) {
    const Sforce& s = mechanism_.sforces[k];
    sforce_index_[s.id] = static_cast<int>(k);
    sforce_markers_.push_back({marker_index(s.i), marker_index(s.j)});
  }
  for (const SpringDamper& s : mechanism_.springs) {
    spring_markers_.push_back({marker_index(s.i), marker_index(s.j)});
  }
  for (const Lse& lse : mechanism_.lses) {
    lse_slot_.push_back(slots.size());
    for (int k = 1; k <= number_matrix(lse.a).rows; ++k) {
      slots.push_back({ElementClass::lse, lse.id, k});
    }
  }
  for (const Tfsiso& tf : mechanism_.tfsisos) {
    tfsiso_slot_.push_back(slots.size());
    for (std::size_t k = 1; k < tf.denominator.size(); ++k) {
      slots.push_back({ElementClass::tfsiso, tf.id, static_cast<int>(k)});
    }
  }
  for (const Diff& diff : mechanism_.diffs) {
    diff_slot_.push_back(slots.size());
    diff_of_id_[diff.id] = slots.size();
    slots.push_back({ElementClass::diff, diff.id, 1});
  }
  z.assign(slots.size(), 0);
}

const NumberMatrix& Model::number_matrix(int id) const {
  for (const NumberMatrix& m : mechanism_.matrices) {
    if (m.id == id) return m;
  }
  throw std::runtime_error("a MATRIX is missing");
}

void Model::update_positions() {
  for (std::size_t k = 0; k < markers_.size(); ++k) {
    const MarkerData& data = marker_data_[k];
    const BodyMotion& body = motion[static_cast<std::size_t>(data.body)];
    const Mat R = k == 0 ? Mat{} : body.R * data.R;
    markers_[k].p = k == 0 ? Vec{} : body.p + body.R * data.p;
    markers_[k].axis = R.column;
  }
}

void Model::update_velocities() {
  for (std::size_t k = 0; k < markers_.size(); ++k) {
    const BodyMotion& body = motion[static_cast<std::size_t>(marker_data_[k].body)];
    MarkerMotion& m = markers_[k];
    m.w = body.w;
    m.v = body.v + cross(body.w, m.p - body.p);
    for (std::size_t c = 0; c < 3; ++c) m.axis1[c] = cross(body.w, m.axis[c]);
  }
}

void Model::update_accelerations() {
  for (std::size_t k = 0; k < markers_.size(); ++k) {
    const BodyMotion& body = motion[static_cast<std::size_t>(marker_data_[k].body)];
    MarkerMotion& m = markers_[k];
    m.al = body.al;
    const Vec arm = m.p - body.p;
    m.a = body.a + cross(body.al, arm) + cross(body.w, cross(body.w, arm));
    for (std::size_t c = 0; c < 3; ++c) {
      m.axis2[c] = cross(body.al, m.axis[c]) + cross(body.w, m.axis1[c]);
    }
  }
}

// ------------------------------------------------------------------------------------ constraints

Real Model::row_position(const Row& row) const {
  const MarkerMotion& i = markers_[static_cast<std::size_t>(row.i)];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(row.j)];
  const Vec& e_j = j.axis[static_cast<std::size_t>(row.axis_j)];
  Real drive = 0;
  if (row.motion >= 0) {
    drive = motion_values(mechanism_.motions[static_cast<std::size_t>(row.motion)].f, time)[0];
  }
  if (row.type == Row::Type::point) return dot(i.p - j.p, e_j) - drive;
  if (row.type == Row::Type::direction) {
    const Real product = dot(i.axis[static_cast<std::size_t>(row.axis_i)], e_j);
    if (!row.swapped) return product;
    return product - dot(j.axis[static_cast<std::size_t>(row.axis_i)], i.axis[static_cast<std::size_t>(row.axis_j)]);
  }
  // A driven joint may have made many turns: the row is the remainder modulo one turn.
  return std::remainder(angle_z(row.i, row.j) - drive, 2 * std::numbers::pi_v<Real>);
}

Real Model::row_velocity(const Row& row) const {
  const MarkerMotion& i = markers_[static_cast<std::size_t>(row.i)];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(row.j)];
  const auto ai = static_cast<std::size_t>(row.axis_i), aj = static_cast<std::size_t>(row.axis_j);
  Real drive = 0;
  if (row.motion >= 0) {
    drive = motion_values(mechanism_.motions[static_cast<std::size_t>(row.motion)].f, time)[1];
  }
  if (row.type == Row::Type::point) {
    return dot(i.v - j.v, j.axis[aj]) + dot(i.p - j.p, j.axis1[aj]) - drive;
  }
  if (row.type == Row::Type::direction) {
    const auto rate = [](const MarkerMotion& m, std::size_t a, const MarkerMotion& n, std::size_t b) {
      return dot(m.axis1[a], n.axis[b]) + dot(m.axis[a], n.axis1[b]);
    };
    return rate(i, ai, j, aj) - (row.swapped ? rate(j, ai, i, aj) : 0);
  }
  // Along motions that keep the z axes parallel the rate of AZ is the relative rate about z_J.
  return dot(i.w - j.w, j.axis[2]) - drive;
}

Real Model::row_acceleration(const Row& row) const {
  const MarkerMotion& i = markers_[static_cast<std::size_t>(row.i)];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(row.j)];
  const auto ai = static_cast<std::size_t>(row.axis_i), aj = static_cast<std::size_t>(row.axis_j);
  Real drive = 0;
  if (row.motion >= 0) {
    drive = motion_values(mechanism_.motions[static_cast<std::size_t>(row.motion)].f, time)[2];
  }
  if (row.type == Row::Type::point) {
    return dot(i.a - j.a, j.axis[aj]) + 2 * dot(i.v - j.v, j.axis1[aj]) + dot(i.p - j.p, j.axis2[aj]) - drive;
  }
  if (row.type == Row::Type::direction) {
    const auto second = [](const MarkerMotion& m, std::size_t a, const MarkerMotion& n, std::size_t b) {
      return dot(m.axis2[a], n.axis[b]) + 2 * dot(m.axis1[a], n.axis1[b]) + dot(m.axis[a], n.axis2[b]);
    };
    return second(i, ai, j, aj) - (row.swapped ? second(j, ai, i, aj) : 0);
  }
  return dot(i.al - j.al, j.axis[2]) + dot(i.w - j.w, j.axis1[2]) - drive;
}

Wrench Model::row_wrench(const Row& row) const {
  const MarkerMotion& i = markers_[static_cast<std::size_t>(row.i)];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(row.j)];
  const auto ai = static_cast<std::size_t>(row.axis_i), aj = static_cast<std::size_t>(row.axis_j);
  if (row.type == Row::Type::point) return {j.axis[aj], Vec{}};
  if (row.type == Row::Type::direction) {
    const Vec t = cross(i.axis[ai], j.axis[aj]);
    return {Vec{}, row.swapped ? t - cross(i.axis[aj], j.axis[ai]) : t};
  }
  return {Vec{}, j.axis[2]};
}

Dense Model::gradient() const {
  Dense G(rows.size(), static_cast<std::size_t>(dofs));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Wrench unit = row_wrench(rows[k]);
    const Vec at = markers_[static_cast<std::size_t>(rows[k].i)].p;
    const auto add = [&](int marker, Real sign) {
      const int b = marker_data_[static_cast<std::size_t>(marker)].body;
      const BodyData& body = bodies[static_cast<std::size_t>(b)];
      const Vec moment = cross(at - motion[static_cast<std::size_t>(b)].p, unit.f) + unit.t;
      for (int c = 0; c < body.dof; ++c) {
        const Real entry = c < 3 ? component(unit.f, c) : component(moment, c - 3);
        G(k, static_cast<std::size_t>(body.offset + c)) += sign * entry;
      }
    };
    add(rows[k].i, 1);
    add(rows[k].j, -1);
  }
  return G;
}

Dense Model::mass_matrix() const {
  Dense M(static_cast<std::size_t>(dofs), static_cast<std::size_t>(dofs));
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    const BodyData& body = bodies[b];
    const Mat& R = motion[b].R;
    const Mat S = skew(R * body.c);
    const Mat J = R * body.inertia * transpose(R) + -body.mass * (S * S);
    for (int r = 0; r < body.dof; ++r) {
      for (int c = 0; c < body.dof; ++c) {
        Real entry = 0;
        if (r < 3 && c < 3) entry = r == c ? body.mass : 0;
        if (r < 3 && c >= 3) entry = -body.mass * component(S.column[static_cast<std::size_t>(c - 3)], r);
        if (r >= 3 && c < 3) entry = body.mass * component(S.column[static_cast<std::size_t>(c)], r - 3);
        if (r >= 3 && c >= 3) entry = component(J.column[static_cast<std::size_t>(c - 3)], r - 3);
        M(static_cast<std::size_t>(body.offset + r), static_cast<std::size_t>(body.offset + c)) = entry;
      }
    }
  }
  return M;
}

// ----------------------------------------------------------------------------------------- forces

Model::Pair Model::line_of_sight(int i, int j) const {
  const MarkerMotion& a = markers_[static_cast<std::size_t>(i)];
  const MarkerMotion& b = markers_[static_cast<std::size_t>(j)];
  const Vec d = a.p - b.p;
  const Real distance = norm(d);
  const Vec e = (1 / distance) * d;
  return {e, distance, dot(e, a.v - b.v)};
}

Real Model::angle_z(int i, int j) const {
  const MarkerMotion& a = markers_[static_cast<std::size_t>(i)];
  const MarkerMotion& b = markers_[static_cast<std::size_t>(j)];
  return std::atan2(dot(a.axis[0], b.axis[1]), dot(a.axis[0], b.axis[0]));
}

void Model::apply(std::vector<Wrench>& loads, int marker, const Vec& at, const Wrench& w, Real sign) const {
  const auto b = static_cast<std::size_t>(marker_data_[static_cast<std::size_t>(marker)].body);
  loads[b].f += sign * w.f;
  loads[b].t += sign * (cross(at - motion[b].p, w.f) + w.t);
}

void Model::apply_springs(std::vector<Wrench>& loads) const {
  for (std::size_t k = 0; k < mechanism_.springs.size(); ++k) {
    const SpringDamper& s = mechanism_.springs[k];
    const auto [i, j] = spring_markers_[k];
    const MarkerMotion& a = markers_[static_cast<std::size_t>(i)];
    const MarkerMotion& b = markers_[static_cast<std::size_t>(j)];
    if (s.direction == Direction::translational) {
      const Pair line = line_of_sight(i, j);
      const Real f = s.preload - s.k * (line.distance - s.free) - s.c * line.rate;
      apply(loads, i, a.p, {f * line.e, Vec{}}, 1);
      apply(loads, j, b.p, {f * line.e, Vec{}}, -1);
    } else {
      const Real rate = dot(a.w - b.w, b.axis[2]);
      const Real t = s.preload - s.k * (angle_z(i, j) - s.free) - s.c * rate;
      apply(loads, i, a.p, {Vec{}, t * b.axis[2]}, 1);
      apply(loads, j, b.p, {Vec{}, t * b.axis[2]}, -1);
    }
  }
}

Wrench Model::sforce_wrench(const Sforce& s, Real value) const {
  const auto [i, j] = sforce_markers_[static_cast<std::size_t>(sforce_index_.at(s.id))];
  const Vec z_j = markers_[static_cast<std::size_t>(j)].axis[2];
  if (s.direction == Direction::rotational) return {Vec{}, value * z_j};
  if (s.reaction == Reaction::action_only) return {value * z_j, Vec{}};
  return {value * line_of_sight(i, j).e, Vec{}};
}

void Model::apply_sforces(std::vector<Wrench>& loads) const {
  for (std::size_t k = 0; k < mechanism_.sforces.size(); ++k) {
    const Sforce& s = mechanism_.sforces[k];
    const auto [i, j] = sforce_markers_[k];
    const Wrench w = sforce_wrench(s, sforce_values[k]);
    apply(loads, i, markers_[static_cast<std::size_t>(i)].p, w, 1);
    if (s.reaction == Reaction::action_only) continue;
    apply(loads, j, markers_[static_cast<std::size_t>(j)].p, w, -1);
  }
}

Wrench Model::linear_wrench(const LinearForce& f) const {
  const MarkerMotion& i = markers_[static_cast<std::size_t>(marker_index(f.i))];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(marker_index(f.j))];
  const Vec d = i.p - j.p, v = i.v - j.v - cross(j.w, d), w = i.w - j.w;
  std::array<Real, 6> y{}, rate{};
  for (std::size_t k = 0; k < 3; ++k) {
    y[k] = dot(d, j.axis[k]);
    rate[k] = dot(v, j.axis[k]);
    rate[3 + k] = dot(w, j.axis[k]);
  }
  y[3] = std::atan2(-dot(i.axis[2], j.axis[1]), dot(i.axis[2], j.axis[2]));
  y[4] = std::atan2(dot(i.axis[2], j.axis[0]), dot(i.axis[2], j.axis[2]));
  y[5] = std::atan2(dot(i.axis[0], j.axis[1]), dot(i.axis[0], j.axis[0]));
  std::array<std::array<Real, 6>, 6> K{}, C{};
  if (f.kind == LinearKind::beam) {
    const Real L = f.beam[0], A = f.beam[1], Ixx = f.beam[2], Iyy = f.beam[3], Izz = f.beam[4], E = f.beam[5],
               G = f.beam[6];
    // Flexibilities of a cantilever under tip force and tip moment, inverted: an independent road to the stiffness.
    const auto bending = [&](Real I, Real shear, Real& kff, Real& kfm, Real& kmm) {
      const Real u_f = L * L * L / (3 * E * I) + shear * L / (G * A), u_m = L * L / (2 * E * I), t_m = L / (E * I);
      const Real det = u_f * t_m - u_m * u_m;
      kff = t_m / det, kfm = -u_m / det, kmm = u_f / det;
    };
    K[0][0] = E * A / L, K[3][3] = G * Ixx / L;
    Real ff = 0, fm = 0, mm = 0;
    bending(Izz, f.beam[7], ff, fm, mm);
    K[1][1] = ff, K[1][5] = K[5][1] = fm, K[5][5] = mm;
    bending(Iyy, f.beam[8], ff, fm, mm);
    K[2][2] = ff, K[2][4] = K[4][2] = -fm, K[4][4] = mm;
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) C[r][c] = f.ratio * K[r][c];
    }
  } else {
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) K[r][c] = f.k[r][c], C[r][c] = f.c[r][c];
    }
  }
  Wrench out;
  for (std::size_t r = 0; r < 6; ++r) {
    Real load = f.force[r];
    for (std::size_t c = 0; c < 6; ++c) {
      const Real free = f.kind == LinearKind::beam ? (c == 0 ? f.beam[0] : 0) : f.length[c];
      load -= K[r][c] * (y[c] - free) + C[r][c] * rate[c];
    }
    (r < 3 ? out.f : out.t) += load * j.axis[r % 3];
  }
  return out;
}

Wrench Model::general_wrench(std::size_t k) const {
  const MarkerMotion& rm = markers_[static_cast<std::size_t>(marker_index(mechanism_.gforces[k].rm))];
  Wrench out;
  for (std::size_t c = 0; c < 6; ++c) (c < 3 ? out.f : out.t) += component_values[6 * k + c] * rm.axis[c % 3];
  return out;
}

void Model::apply_linears(std::vector<Wrench>& loads) const {
  for (const LinearForce& f : mechanism_.linears) {
    const int i = marker_index(f.i), j = marker_index(f.j);
    const Wrench w = linear_wrench(f);
    const Vec delta = markers_[static_cast<std::size_t>(i)].p - markers_[static_cast<std::size_t>(j)].p;
    apply(loads, i, markers_[static_cast<std::size_t>(i)].p, w, 1);
    apply(loads, j, markers_[static_cast<std::size_t>(j)].p, {-w.f, -w.t - cross(delta, w.f)}, 1);
  }
  for (std::size_t k = 0; k < mechanism_.gforces.size(); ++k) {
    const GeneralForce& f = mechanism_.gforces[k];
    const Vec at = markers_[static_cast<std::size_t>(marker_index(f.i))].p;
    apply(loads, marker_index(f.i), at, general_wrench(k), 1);
    apply(loads, marker_index(f.jfloat), at, general_wrench(k), -1);
  }
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

// --------------------------------------------------------------------------- the algebraic system

std::size_t Model::algebra_size() const {
  return static_cast<std::size_t>(dofs) + active.size() + variable_values.size() + sforce_values.size() +
         component_values.size();
}

std::vector<int> Model::algebra_groups() const {
  std::vector<int> groups;
  for (const BodyData& body : bodies) {
    for (int c = 0; c < body.dof; ++c) groups.push_back(c < 3 ? 0 : 1);
  }
  for (const int k : active) {
    groups.push_back(rows[static_cast<std::size_t>(k)].type == Row::Type::point ? 2 : 3);
  }
  int next = 4;
  for (std::size_t k = 0; k < variable_values.size() + sforce_values.size() + component_values.size(); ++k) {
    groups.push_back(next++);
  }
  return groups;
}

void Model::unpack_algebra(const std::vector<Real>& x) {
  std::size_t at = 0;
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    BodyMotion& m = motion[b];
    m.a = {x[at], x[at + 1], x[at + 2]};
    m.al = bodies[b].dof == 6 ? Vec{x[at + 3], x[at + 4], x[at + 5]} : Vec{};
    at += static_cast<std::size_t>(bodies[b].dof);
  }
  lambda.assign(rows.size(), 0);
  for (const int k : active) lambda[static_cast<std::size_t>(k)] = x[at++];
  for (Real& v : variable_values) v = x[at++];
  for (Real& v : sforce_values) v = x[at++];
  for (Real& v : component_values) v = x[at++];
  update_accelerations();
}

std::vector<Real> Model::algebra_residual() const {
  std::vector<Wrench> loads(bodies.size());
  apply_springs(loads);
  apply_sforces(loads);
  apply_linears(loads);
  for (const int k : active) {
    const Row& row = rows[static_cast<std::size_t>(k)];
    const Wrench unit = row_wrench(row);
    const Vec at = markers_[static_cast<std::size_t>(row.i)].p;
    apply(loads, row.i, at, unit, lambda[static_cast<std::size_t>(k)]);
    apply(loads, row.j, at, unit, -lambda[static_cast<std::size_t>(k)]);
  }
  const Vec g = to_vec(mechanism_.gravity);
  const Real ucf = mechanism_.ucf;
  std::vector<Real> residual;
  residual.reserve(algebra_size());
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    const BodyData& body = bodies[b];
    const BodyMotion& m = motion[b];
    const Vec c = m.R * body.c;
    const Vec a_c = m.a + cross(m.al, c) + cross(m.w, cross(m.w, c));
    const Vec force = (body.mass / ucf) * (a_c - g) - loads[b].f;
    residual.insert(residual.end(), {force.x, force.y, force.z});
    if (body.dof == 3) continue;
    const auto inertia = [&](const Vec& w) { return (1 / ucf) * (m.R * (body.inertia * (transpose(m.R) * w))); };
    const Vec about_cm = loads[b].t - cross(c, loads[b].f);
    const Vec torque = inertia(m.al) + cross(m.w, inertia(m.w)) - about_cm;
    residual.insert(residual.end(), {torque.x, torque.y, torque.z});
  }
  for (const int k : active) residual.push_back(row_acceleration(rows[static_cast<std::size_t>(k)]));
  for (std::size_t k = 0; k < variable_values.size(); ++k) {
    const Real target = cut[k] != 0 ? cut_values[k] : evaluate(mechanism_.variables[k].function);
    residual.push_back(variable_values[k] - target);
  }
  for (std::size_t k = 0; k < sforce_values.size(); ++k) {
    residual.push_back(sforce_values[k] - evaluate(mechanism_.sforces[k].function));
  }
  for (std::size_t k = 0; k < component_values.size(); ++k) {
    const std::optional<Expr>& e = mechanism_.gforces[k / 6].component[k % 6];
    residual.push_back(component_values[k] - (e ? evaluate(*e) : 0));
  }
  return residual;
}

}  // namespace dynalin::oracle
