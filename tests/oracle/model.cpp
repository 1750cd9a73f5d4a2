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
  read_beams();
  read_plane_beams();
  read_flexibles();
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
  capture_offsets();
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
    body.dof = body.ref.kind == BodyKind::ground ? 0 : (turns(body.ref.kind) ? 6 : 3);
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
  for (const Gse& e : mechanism_.gses) {
    gse_slot_.push_back(slots.size());
    for (int k = 1; k <= e.states; ++k) slots.push_back({ElementClass::gse, e.id, k});
  }
  for (const Tfsiso& tf : mechanism_.tfsisos) {
    tfsiso_slot_.push_back(slots.size());
    for (std::size_t k = 1; k < tf.denominator.size(); ++k) {
      slots.push_back({ElementClass::tfsiso, tf.id, static_cast<int>(k)});
    }
  }
  for (std::size_t k = 0; k < mechanism_.diffs.size(); ++k) {
    const Diff& diff = mechanism_.diffs[k];
    diff_slot_.push_back(slots.size());
    diff_index_[diff.id] = k;
    if (diff.kind != DiffKind::algebraic) slots.push_back({ElementClass::diff, diff.id, 1});
  }
  for (const Friction& f : mechanism_.frictions) {
    friction_slot_.push_back(slots.size());
    const int count =
        f.effect == 2 ? 0
                      : surface_directions(mechanism_.joints[static_cast<std::size_t>(joint_index_.at(f.joint))].type);
    for (int k = 1; k <= count; ++k) slots.push_back({ElementClass::friction, f.id, k});
  }
  algebraic_values.assign(mechanism_.diffs.size(), 0);
  algebraic_rates.assign(mechanism_.diffs.size(), 0);
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
  touch_places_.assign(mechanism_.touches.size(), {});
  solve_contacts();
  for (Row& row : rows) row.gradient.clear();
  beam_directions_.clear();
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

}  // namespace dynalin::oracle
