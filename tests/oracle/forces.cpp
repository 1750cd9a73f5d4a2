#include <algorithm>

#include "gauss_points.h"
#include "model.h"

namespace dynalin::oracle {

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
  add_beam_masses(M);
  add_plane_beam_masses(M);
  add_flexible_masses(M);
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

Vec Model::between(int i, int j) const {
  return markers_[static_cast<std::size_t>(i)].p - markers_[static_cast<std::size_t>(j)].p;
}

Wrench Model::spring_wrench(std::size_t k) const {
  const SpringDamper& s = mechanism_.springs[k];
  const auto [i, j] = spring_markers_[k];
  const MarkerMotion& a = markers_[static_cast<std::size_t>(i)];
  const MarkerMotion& b = markers_[static_cast<std::size_t>(j)];
  if (s.direction == Direction::translational) {
    const Pair line = line_of_sight(i, j);
    return {(s.preload - s.k * (line.distance - s.free) - s.c * line.rate) * line.e, Vec{}};
  }
  const Real rate = dot(a.w - b.w, b.axis[2]);
  return {Vec{}, (s.preload - s.k * (angle_z(i, j) - s.free) - s.c * rate) * b.axis[2]};
}

void Model::apply_springs(std::vector<Wrench>& loads) const {
  for (std::size_t k = 0; k < mechanism_.springs.size(); ++k) {
    const auto [i, j] = spring_markers_[k];
    const Wrench w = spring_wrench(k);
    apply(loads, i, markers_[static_cast<std::size_t>(i)].p, w, 1);
    apply(loads, j, markers_[static_cast<std::size_t>(j)].p, w, -1);
  }
}

Wrench Model::sforce_wrench(std::size_t k) const {
  const Sforce& s = mechanism_.sforces[k];
  const auto [i, j] = sforce_markers_[k];
  const Real value = sforce_values[k];
  const Vec z_j = markers_[static_cast<std::size_t>(j)].axis[2];
  if (s.direction == Direction::rotational) return {Vec{}, value * z_j};
  if (s.reaction == Reaction::action_only) return {value * z_j, Vec{}};
  return {value * line_of_sight(i, j).e, Vec{}};
}

void Model::apply_sforces(std::vector<Wrench>& loads) const {
  for (std::size_t k = 0; k < mechanism_.sforces.size(); ++k) {
    const Sforce& s = mechanism_.sforces[k];
    const auto [i, j] = sforce_markers_[k];
    const Wrench w = sforce_wrench(k);
    apply(loads, i, markers_[static_cast<std::size_t>(i)].p, w, 1);
    if (s.reaction == Reaction::action_only) continue;
    apply(loads, j, markers_[static_cast<std::size_t>(j)].p, w, -1);
  }
}

Model::Displacements Model::displacements(int i_index, int j_index) const {
  const MarkerMotion& i = markers_[static_cast<std::size_t>(i_index)];
  const MarkerMotion& j = markers_[static_cast<std::size_t>(j_index)];
  const Vec d = i.p - j.p, v = i.v - j.v - cross(j.w, d), w = i.w - j.w;
  Displacements out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.y[k] = dot(d, j.axis[k]);
    out.rate[k] = dot(v, j.axis[k]);
    out.rate[3 + k] = dot(w, j.axis[k]);
  }
  out.y[3] = std::atan2(-dot(i.axis[2], j.axis[1]), dot(i.axis[2], j.axis[2]));
  out.y[4] = std::atan2(dot(i.axis[2], j.axis[0]), dot(i.axis[2], j.axis[2]));
  out.y[5] = std::atan2(dot(i.axis[0], j.axis[1]), dot(i.axis[0], j.axis[0]));
  return out;
}

Wrench Model::in_axes_of(int j, const std::array<Real, 6>& load) const {
  const auto& axis = markers_[static_cast<std::size_t>(j)].axis;
  Wrench out;
  for (std::size_t r = 0; r < 6; ++r) (r < 3 ? out.f : out.t) += load[r] * axis[r % 3];
  return out;
}

Wrench Model::linear_wrench(const LinearForce& f) const {
  const Displacements at = displacements(marker_index(f.i), marker_index(f.j));
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
  } else {
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) K[r][c] = f.k[r][c];
    }
  }
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < 6; ++c) C[r][c] = f.ratio != 0 ? f.ratio * K[r][c] : static_cast<Real>(f.c[r][c]);
  }
  std::array<Real, 6> load{};
  for (std::size_t r = 0; r < 6; ++r) {
    load[r] = f.force[r];
    for (std::size_t c = 0; c < 6; ++c) {
      const Real free = f.kind == LinearKind::beam ? (c == 0 ? f.beam[0] : 0) : f.length[c];
      load[r] -= K[r][c] * (at.y[c] - free) + C[r][c] * at.rate[c];
    }
  }
  return in_axes_of(marker_index(f.j), load);
}

// Each marker takes its six rows.
std::vector<Wrench> Model::nforce_wrenches(const Nforce& f) const {
  const std::size_t n = f.i.size();
  std::vector<Real> y(6 * n), rate(6 * n);
  for (std::size_t m = 0; m < n; ++m) {
    const Displacements at = displacements(marker_index(f.i[m]), marker_index(f.j));
    for (std::size_t c = 0; c < 6; ++c) {
      y[6 * m + c] = at.y[c] - (f.length != 0 ? number_matrix(f.length).values[6 * m + c] : 0);
      rate[6 * m + c] = at.rate[c];
    }
  }
  std::vector<Wrench> wrenches;
  const std::vector<double>& K = number_matrix(f.k).values;
  for (std::size_t m = 0; m < n; ++m) {
    std::array<Real, 6> load{};
    for (std::size_t r = 0; r < 6; ++r) {
      const std::size_t row = 6 * m + r;
      if (f.force != 0) load[r] = number_matrix(f.force).values[row];
      for (std::size_t c = 0; c < 6 * n; ++c) {
        const Real k = K[row * 6 * n + c];
        const Real damping = f.c != 0 ? static_cast<Real>(number_matrix(f.c).values[row * 6 * n + c]) : f.ratio * k;
        load[r] -= k * y[c] + damping * rate[c];
      }
    }
    wrenches.push_back(in_axes_of(marker_index(f.j), load));
  }
  return wrenches;
}

// The body of J balances them.
void Model::apply_nforces(std::vector<Wrench>& loads) const {
  for (const Nforce& f : mechanism_.nforces) {
    const std::vector<Wrench> wrenches = nforce_wrenches(f);
    for (std::size_t m = 0; m < wrenches.size(); ++m) {
      const Vec at = markers_[static_cast<std::size_t>(marker_index(f.i[m]))].p;
      apply(loads, marker_index(f.i[m]), at, wrenches[m], 1);
      apply(loads, marker_index(f.j), at, wrenches[m], -1);
    }
  }
}

Real Model::cable_tension(const Cable& f) const {
  Real tension = f.force - f.k * f.length;
  for (std::size_t m = 1; m < f.markers.size(); ++m) {
    const Pair span = line_of_sight(marker_index(f.markers[m]), marker_index(f.markers[m - 1]));
    tension += f.k * span.distance + f.c * span.rate;
  }
  return tension;
}

std::vector<Wrench> Model::cable_wrenches(const Cable& f) const {
  const Real tension = std::max<Real>(0, cable_tension(f));
  std::vector<Wrench> wrenches;
  for (std::size_t m = 1; m < f.markers.size(); ++m)
    wrenches.push_back({-tension * line_of_sight(marker_index(f.markers[m]), marker_index(f.markers[m - 1])).e, Vec{}});
  return wrenches;
}

void Model::apply_cables(std::vector<Wrench>& loads) const {
  for (const Cable& f : mechanism_.cables) {
    const std::vector<Wrench> wrenches = cable_wrenches(f);
    for (std::size_t m = 1; m < f.markers.size(); ++m) {
      for (const auto& [marker, sign] : {std::pair(f.markers[m], 1), std::pair(f.markers[m - 1], -1)}) {
        const int at = marker_index(marker);
        apply(loads, at, markers_[static_cast<std::size_t>(at)].p, wrenches[m - 1], sign);
      }
    }
  }
}

// Pressures and shear of the film summed around the shaft. With the pressure integrated over the length,
// P = mu L^3 a(t)/h^3 where a, the rate at which the film is squeezed, is positive; what turns the shaft is
// -(h/2 dP/dt + mu omega R^2 L/h) R, the whole film shearing.
Wrench Model::journal_wrench(const Journal& f) const {
  const Displacements at = displacements(marker_index(f.i), marker_index(f.j));
  const Real c = f.clearance, R = f.radius, L = f.length, mu = f.viscosity, omega = at.rate[5] + f.speed;
  const Real a = at.rate[0] + omega * at.y[1] / 2, b = at.rate[1] - omega * at.y[0] / 2;
  const Real pi = std::acos(-1.0L), middle = std::atan2(b, a);
  constexpr int panels = 64;
  std::array<Real, 6> load{};
  for (const bool wet : {true, false}) {
    for (int k = 0; k < panels; ++k) {
      for (const GaussPoint& g : four_points()) {
        const Real from_middle = pi * ((static_cast<Real>(k) + g.at) / panels - 0.5L) + (wet ? 0 : pi);
        const Real cosine = std::cos(middle + from_middle), sine = std::sin(middle + from_middle);
        const Real h = c - at.y[0] * cosine - at.y[1] * sine, slope = at.y[0] * sine - at.y[1] * cosine;
        const Real weight = g.weight * pi / panels * R;
        load[5] -= weight * mu * omega * R * R * L / h;
        if (!wet) continue;
        const Real squeeze = a * cosine + b * sine, squeeze_slope = b * cosine - a * sine;
        const Real pressure = mu * L * L * L * squeeze / (h * h * h);
        const Real pressure_slope =
            mu * L * L * L * (squeeze_slope / (h * h * h) - 3 * squeeze * slope / (h * h * h * h));
        load[0] -= weight * pressure * cosine;
        load[1] -= weight * pressure * sine;
        load[5] -= weight * h / 2 * pressure_slope;
      }
    }
  }
  return in_axes_of(marker_index(f.j), load);
}

void Model::apply_journals(std::vector<Wrench>& loads) const {
  for (const Journal& f : mechanism_.journals) {
    const Wrench w = journal_wrench(f);
    const Vec at = markers_[static_cast<std::size_t>(marker_index(f.i))].p;
    apply(loads, marker_index(f.i), at, w, 1);
    apply(loads, marker_index(f.j), at, w, -1);
  }
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

// --------------------------------------------------------------------------- the algebraic system

std::size_t Model::algebraic_unknowns() const {
  std::size_t count = 0;
  for (const Diff& diff : mechanism_.diffs) {
    count += diff.kind != DiffKind::algebraic ? 0U : diff.rate_read ? 2U : 1U;
  }
  return count;
}

std::size_t Model::algebra_size() const {
  return static_cast<std::size_t>(dofs) + active.size() + variable_values.size() + sforce_values.size() +
         component_values.size() + algebraic_unknowns();
}

std::vector<int> Model::algebra_groups() const {
  std::vector<int> groups;
  for (const BodyData& body : bodies) {
    for (int c = 0; c < body.dof; ++c) groups.push_back(c < 3 && body.ref.kind < BodyKind::beam_slope ? 0 : 1);
  }
  for (const int k : active) {
    const Row& row = rows[static_cast<std::size_t>(k)];
    const Row::Type type = row.type;
    const bool force =
        type == Row::Type::point || type == Row::Type::shape || (type == Row::Type::plane && row.component == 0);
    groups.push_back(force ? 2 : type == Row::Type::expression ? 4 : 3);
  }
  int next = 5;
  while (groups.size() < algebra_size()) groups.push_back(next++);
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
  for (std::size_t k = 0; k < mechanism_.diffs.size(); ++k) {
    const Diff& diff = mechanism_.diffs[k];
    if (diff.kind != DiffKind::algebraic) continue;
    algebraic_values[k] = x[at++];
    if (diff.rate_read) algebraic_rates[k] = x[at++];
  }
  update_accelerations();
}

std::vector<Real> Model::algebra_residual() const {
  std::vector<Wrench> loads(bodies.size());
  apply_springs(loads);
  apply_sforces(loads);
  apply_linears(loads);
  apply_nforces(loads);
  apply_cables(loads);
  apply_journals(loads);
  apply_frictions(loads);
  apply_touches(loads);
  apply_beams(loads);
  apply_plane_beams(loads);
  apply_flexibles(loads);
  for (const int k : active) apply_row(loads, rows[static_cast<std::size_t>(k)], lambda[static_cast<std::size_t>(k)]);
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
  for (std::size_t k = 0; k < mechanism_.diffs.size(); ++k) {
    const Diff& diff = mechanism_.diffs[k];
    if (diff.kind != DiffKind::algebraic) continue;
    residual.push_back(evaluate(diff.function));
    if (diff.rate_read) residual.push_back(evaluate_along(diff.function).d);  // stays zero along the motion
  }
  return residual;
}

}  // namespace dynalin::oracle
