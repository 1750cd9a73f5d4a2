// Bodies of modes as what they are: masses with inertia at nodes that follow the shapes in a frame that moves at will.
//
// A node at s stands at r + R (s + sum shift_j q_j); its inertia, along the axes of the frame, has the angular velocity
// w + R sum turn_j q_j'. Forces are those of d'Alembert for the masses; for the inertias those of Lagrange of
// T = (w + turn q') . J (w + turn q') / 2, as these angular velocities belong to no rotation. A node that carries
// markers is a body without mass, turned by exp(turn q), that rows tie to frame and modes.
#include <cmath>

#include "model.h"

namespace dynalin::oracle {

Mat inertia_of(const Flexible::Node& node) {
  const auto& j = node.inertia;
  return {{Vec{j[0], -static_cast<Real>(j[3]), -static_cast<Real>(j[4])},
           Vec{-static_cast<Real>(j[3]), j[1], -static_cast<Real>(j[5])},
           Vec{-static_cast<Real>(j[4]), -static_cast<Real>(j[5]), j[2]}}};
}

Real lowest_frequency(const Flexible& f) {
  std::array<std::array<Real, 3>, 3> mass{};
  for (const Flexible::Node& n : f.nodes) {
    const Mat J = inertia_of(n);
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c)
        mass[r][c] +=
            n.mass * dot(to_vec(n.shift[r]), to_vec(n.shift[c])) + dot(to_vec(n.turn[r]), J * to_vec(n.turn[c]));
    }
  }
  // Of M⁻¹K inverse iteration finds the smallest: K⁻¹M by powers.
  const auto row = [](const auto& a, std::size_t r) { return Vec{a[r][0], a[r][1], a[r][2]}; };
  const Vec k0 = row(f.stiffness, 0), k1 = row(f.stiffness, 1), k2 = row(f.stiffness, 2);
  const Real determinant = dot(k0, cross(k1, k2));
  Vec q{1, 0.7, 0.4};
  Real size = 0;
  for (int step = 0; step < 200; ++step) {
    const Vec p{dot(row(mass, 0), q), dot(row(mass, 1), q), dot(row(mass, 2), q)};
    const Vec next = (1 / determinant) * (p.x * cross(k1, k2) + p.y * cross(k2, k0) + p.z * cross(k0, k1));
    size = norm(next);
    q = (1 / size) * next;
  }
  return 1 / std::sqrt(size);
}

namespace {

Vec sum_of(const std::array<Triple, 3>& by_mode, const Vec& q) {
  return q.x * to_vec(by_mode[0]) + q.y * to_vec(by_mode[1]) + q.z * to_vec(by_mode[2]);
}

Mat matrix(const std::array<std::array<double, 3>, 3>& rows) {
  return transpose(Mat{{to_vec(rows[0]), to_vec(rows[1]), to_vec(rows[2])}});
}

Mat inverse(const Mat& m) { return {{solve3(m, Vec{1, 0, 0}), solve3(m, Vec{0, 1, 0}), solve3(m, Vec{0, 0, 1})}}; }

// Of the modes alone.
Mat modal_mass(const Flexible& f) {
  Mat sum = zero_matrix();
  for (const Flexible::Node& n : f.nodes) {
    const Mat shift{{to_vec(n.shift[0]), to_vec(n.shift[1]), to_vec(n.shift[2])}};
    const Mat turn{{to_vec(n.turn[0]), to_vec(n.turn[1]), to_vec(n.turn[2])}};
    sum = sum + static_cast<Real>(n.mass) * (transpose(shift) * shift) + transpose(turn) * (inertia_of(n) * turn);
  }
  return sum;
}

// By the iteration of Denman and Beavers.
Mat square_root(Mat a) {
  Mat b;
  for (int k = 0; k < 40; ++k) {
    const Mat next = 0.5L * (a + inverse(b));
    b = 0.5L * (b + inverse(a));
    a = next;
  }
  return a;
}

}  // namespace

void Model::read_flexibles() {
  for (const Flexible& f : mechanism_.flexibles) {
    FlexibleData data;
    data.frame = static_cast<std::size_t>(body_index(f.frame()));
    data.modes = static_cast<std::size_t>(body_index(f.modes()));
    // A part of critical damping of every mode: 2 ratio M (M^-1 K)^1/2.
    const Mat M = (1 / static_cast<Real>(mechanism_.ucf)) * modal_mass(f);
    data.damping =
        (2 * static_cast<Real>(f.ratio)) * (M * square_root(inverse(M) * matrix(f.stiffness))) + matrix(f.damping);
    for (std::size_t k = 0; k < f.nodes.size(); ++k) {
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (bodies[b].ref == f.node(k)) carried_.push_back({flexible_data_.size(), k, b});
      }
    }
    flexible_data_.push_back(data);
  }
}

Model::ShapeMotion Model::shape_motion(std::size_t flexible, std::size_t node) const {
  const FlexibleData& data = flexible_data_[flexible];
  const Flexible::Node& n = mechanism_.flexibles[flexible].nodes[node];
  const BodyMotion &f = motion[data.frame], &q = motion[data.modes];
  const Mat& R = f.R;
  ShapeMotion s;
  s.arm = R * (to_vec(n.place) + sum_of(n.shift, q.p));
  const Vec rate = R * sum_of(n.shift, q.v), second = R * sum_of(n.shift, q.a);
  s.p = f.p + s.arm;
  s.v = f.v + cross(f.w, s.arm) + rate;
  s.a = f.a + cross(f.al, s.arm) + cross(f.w, cross(f.w, s.arm)) + 2.0L * cross(f.w, rate) + second;
  const Vec turn = sum_of(n.turn, q.p), turn_rate = sum_of(n.turn, q.v);
  const Mat J = left_jacobian(turn);
  const Vec spin = R * (J * turn_rate);
  s.T = R * rotation_exponential(turn);
  s.w = f.w + spin;
  s.al = f.al + cross(f.w, spin) + R * (left_jacobian_rate(turn, turn_rate) * turn_rate + J * sum_of(n.turn, q.a));
  for (std::size_t k = 0; k < 3; ++k) s.shift[k] = R * to_vec(n.shift[k]), s.turn[k] = R * (J * to_vec(n.turn[k]));
  return s;
}

namespace {

// Which axis of the node is normal to which of the shape.
struct Axes {
  std::size_t of_node, of_shape;
};
Axes axes_of(int component) {
  const auto k = static_cast<std::size_t>(component - 3);
  return {k, (k + 1) % 3};
}
}  // namespace

std::array<Real, 3> Model::shape_row(const Row& row) const {
  const Carried& c = carried_[row.carried];
  const ShapeMotion s = shape_motion(c.flexible, c.node);
  const BodyMotion& n = motion[c.body];
  if (row.component < 3) {
    const Vec e = unit(row.component);
    return {dot(e, n.p - s.p), dot(e, n.v - s.v), dot(e, n.a - s.a)};
  }
  const Axes k = axes_of(row.component);
  const Vec &x = n.R.column[k.of_node], &t = s.T.column[k.of_shape];
  const Vec x1 = cross(n.w, x), t1 = cross(s.w, t);
  const Vec x2 = cross(n.al, x) + cross(n.w, x1), t2 = cross(s.al, t) + cross(s.w, t1);
  return {dot(x, t), dot(x1, t) + dot(x, t1), dot(x2, t) + 2 * dot(x1, t1) + dot(x, t2)};
}

void Model::apply_shape(std::vector<Wrench>& loads, const Row& row, Real size) const {
  const Carried& c = carried_[row.carried];
  const ShapeMotion s = shape_motion(c.flexible, c.node);
  Wrench &node = loads[c.body], &frame = loads[flexible_data_[c.flexible].frame];
  Vec& modes = loads[flexible_data_[c.flexible].modes].f;
  if (row.component < 3) {
    const Vec f = size * unit(row.component);
    node.f += f, frame.f += -f, frame.t += -cross(s.arm, f);
    modes += -Vec{dot(f, s.shift[0]), dot(f, s.shift[1]), dot(f, s.shift[2])};
    return;
  }
  const Axes k = axes_of(row.component);
  const Vec t = size * cross(motion[c.body].R.column[k.of_node], s.T.column[k.of_shape]);
  node.t += t, frame.t += -t;
  modes += -Vec{dot(t, s.turn[0]), dot(t, s.turn[1]), dot(t, s.turn[2])};
}

void Model::place_nodes() {
  for (const Carried& c : carried_) {
    const ShapeMotion s = shape_motion(c.flexible, c.node);
    BodyMotion& n = motion[c.body];
    n = {s.p, s.T, s.v, s.w, s.a, s.al};
  }
}

Vec Model::elastic_force(std::size_t flexible) const {
  const FlexibleData& data = flexible_data_[flexible];
  const BodyMotion& q = motion[data.modes];
  return -(matrix(mechanism_.flexibles[flexible].stiffness) * q.p) - data.damping * q.v;
}

void Model::apply_flexibles(std::vector<Wrench>& loads) const {
  const Vec g = to_vec(mechanism_.gravity);
  const Real ucf = mechanism_.ucf;
  for (std::size_t b = 0; b < flexible_data_.size(); ++b) {
    const Flexible& body = mechanism_.flexibles[b];
    const FlexibleData& data = flexible_data_[b];
    const BodyMotion &f = motion[data.frame], &q = motion[data.modes];
    const Mat back = transpose(f.R);
    Wrench& frame = loads[data.frame];
    Vec& modes = loads[data.modes].f;
    modes += elastic_force(b);
    for (std::size_t k = 0; k < body.nodes.size(); ++k) {
      const Flexible::Node& n = body.nodes[k];
      const ShapeMotion s = shape_motion(b, k);
      const Vec force = (n.mass / ucf) * (g - s.a);
      frame.f += force, frame.t += cross(s.arm, force);
      modes += Vec{dot(force, s.shift[0]), dot(force, s.shift[1]), dot(force, s.shift[2])};
      const Mat J = (1 / ucf) * inertia_of(n);
      const Vec L = J * (back * f.w + sum_of(n.turn, q.v)), L1 = J * (back * f.al + sum_of(n.turn, q.a));
      frame.t += -(f.R * (L1 + cross(back * f.w, L)));
      modes += -Vec{dot(to_vec(n.turn[0]), L1), dot(to_vec(n.turn[1]), L1), dot(to_vec(n.turn[2]), L1)};
    }
    for (const ModalForce& m : mechanism_.mforces) {
      if (m.flexible != body.id) continue;
      const auto& load = body.loads[static_cast<std::size_t>(m.load)];
      const Real w = evaluate(m.scale);
      const Vec force = f.R * (w * Vec{load[0], load[1], load[2]}), torque = f.R * (w * Vec{load[3], load[4], load[5]});
      frame.f += force, frame.t += torque;
      modes += w * Vec{load[6], load[7], load[8]};
      if (m.jfloat != 0) apply(loads, marker_index(m.jfloat), f.p, {force, torque}, -1);
    }
  }
}

void Model::add_flexible_masses(Dense& mass) const {
  for (std::size_t b = 0; b < flexible_data_.size(); ++b) {
    const FlexibleData& data = flexible_data_[b];
    const Mat& R = motion[data.frame].R;
    const auto column = [&](std::size_t k) {
      return static_cast<std::size_t>(k < 6 ? bodies[data.frame].offset : bodies[data.modes].offset - 6) + k;
    };
    for (std::size_t node = 0; node < mechanism_.flexibles[b].nodes.size(); ++node) {
      const Flexible::Node& n = mechanism_.flexibles[b].nodes[node];
      const ShapeMotion s = shape_motion(b, node);
      std::array<Vec, 9> v, w;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec e = unit(static_cast<int>(k));
        v[k] = e, v[3 + k] = cross(e, s.arm), v[6 + k] = s.shift[k];
        w[3 + k] = e, w[6 + k] = R * to_vec(n.turn[k]);
      }
      const Mat J = R * inertia_of(n) * transpose(R);
      for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t k = 0; k < 9; ++k)
          mass(column(i), column(k)) += n.mass * dot(v[i], v[k]) + dot(w[i], J * w[k]);
      }
    }
  }
}

}  // namespace dynalin::oracle
