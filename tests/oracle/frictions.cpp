// Friction in joints: components along the axes of the joint, from markers and multipliers.
#include <algorithm>

#include "model.h"

namespace dynalin::oracle {

namespace {

// 0 up to a, 1 from b on.
Real step(Real x, Real a, Real b) {
  const Real s = std::clamp((x - a) / (b - a), Real(0), Real(1));
  return s * s * (3 - 2 * s);
}
// -1 up to -a, 1 from a on.
Real odd_step(Real x, Real a) { return 2 * step(x, -a, a) - 1; }

// The cubic of the size in the direction of a vector.
Vec odd_step(const Vec& v, Real a) {
  const Real size = norm(v);
  return size == 0 ? Vec{} : (odd_step(size, a) / size) * v;
}

Real stribeck(const Friction& f, Real speed) {
  const Real x = speed / f.velocity;
  return f.mu_dynamic + (f.mu_static - f.mu_dynamic) * std::exp(-x * x);
}

}  // namespace

// How the surfaces of a friction slip: each direction in which they do, and the lever of the force along it.
std::vector<Model::Slip> Model::slips(const Friction& f) const {
  const auto joint = static_cast<std::size_t>(joint_index_.at(f.joint));
  const auto [i, j] = joint_markers_[joint];
  const MarkerMotion& a = markers_[static_cast<std::size_t>(i)];
  const MarkerMotion& b = markers_[static_cast<std::size_t>(j)];
  const Vec w = a.w - b.w, v = a.v - b.v - cross(b.w, a.p - b.p);
  const Vec z_j = b.axis[2];
  const auto turns = [&](const Vec& axis, Real radius) { return Slip{axis, true, radius, radius * dot(w, axis)}; };
  switch (mechanism_.joints[joint].type) {
    case JointType::translational:
      return {{z_j, false, 1, dot(v, z_j)}};
    case JointType::cylindrical:
      return {{z_j, false, 1, dot(v, z_j)}, turns(z_j, f.pin)};
    case JointType::spherical:
      return {turns(b.axis[0], f.ball), turns(b.axis[1], f.ball), turns(b.axis[2], f.ball)};
    case JointType::hooke:
      return {turns(f.on_j ? b.axis[1] : a.axis[0], f.pin)};
    case JointType::universal:
      return {turns(f.on_j ? z_j : a.axis[2], f.pin)};
    default:
      return {turns(z_j, f.pin)};
  }
}

std::array<Real, 4> Model::pressing(const Friction& f) const {
  const int joint = joint_index_.at(f.joint);
  const Wrench r = joint_wrench(joint);
  const std::vector<Slip> slip = slips(f);
  if (slip.size() == 3) return {norm(r.f), 0, 0, 0};
  const Vec n = slip[0].axis;
  return {norm(cross(n, r.f)), std::fabs(dot(n, r.f)), norm(cross(n, r.t)), std::fabs(dot(n, r.t))};
}

Wrench Model::friction_wrench(std::size_t k) const {
  const Friction& f = mechanism_.frictions[k];
  const std::vector<Slip> slip = slips(f);
  const auto joint = static_cast<std::size_t>(joint_index_.at(f.joint));
  const JointType type = mechanism_.joints[joint].type;
  const auto [across, along, bending, torsion] = pressing(f);
  const bool of_force = (f.inputs & 1) != 0, of_bending = (f.inputs & 2) != 0, of_torsion = (f.inputs & 4) != 0;
  const auto [i, j] = joint_markers_[joint];
  Real force = 0;  // on the surface
  if (type == JointType::translational || type == JointType::cylindrical) {
    const Real moved = dot(between(i, j), markers_[static_cast<std::size_t>(j)].axis[2]) - friction_start_[k];
    const Real overlap = f.overlap + f.delta * moved;
    force = (of_force ? across : 0) + (of_bending ? bending / overlap : 0);
    if (type == JointType::translational && of_torsion) force += torsion / f.reaction;
  } else if (type == JointType::spherical) {
    force = of_force ? across : 0;
  } else {
    force = (of_force ? across + f.arm / f.pin * along : 0) + (of_bending ? bending / f.bending : 0);
  }

  Vec u, creep;  // components by slip
  for (std::size_t n = 0; n < slip.size(); ++n) {
    set_component(u, static_cast<int>(n), slip[n].speed);
    if (f.effect != 2) set_component(creep, static_cast<int>(n), z[friction_slot_[k] + n]);
  }
  const Real speed = norm(u), ends = f.ratio * f.velocity;
  const Vec b = odd_step(u, f.velocity), sigma = odd_step(creep, f.deformation);
  Vec s;
  Real mu = 0;
  if (f.lugre) {
    const std::vector<Real> rates = creep_rates(k);
    Vec bends;
    for (std::size_t n = 0; n < slip.size(); ++n) set_component(bends, static_cast<int>(n), rates[n]);
    mu = stribeck(f, speed);
    s = (1 / mu) * (f.bristles * creep + f.bristle_damping * bends + f.viscosity * u);
  } else if (f.effect == 2) {
    s = b;
    mu = f.mu_dynamic;
  } else {
    const Real size = norm(b), elastic = dot(sigma, sigma);
    s = sigma + (size + (1 - elastic) * (1 - size)) * b - size * size * sigma;
    mu = f.mu_static;
    if (f.effect == 1)
      s = (1 - step(speed, f.velocity, ends)) * s;
    else
      mu += (f.mu_dynamic - f.mu_static) * step(speed, f.velocity, ends);
  }
  const bool preloaded = (f.inputs & 8) != 0;
  Wrench out;
  for (std::size_t n = 0; n < slip.size(); ++n) {
    const Real preload = !preloaded ? 0 : slip[n].turns ? f.torque_preload : f.force_preload;
    const Real size = -component(s, static_cast<int>(n)) * (mu * force * slip[n].lever + preload);
    (slip[n].turns ? out.t : out.f) += size * slip[n].axis;
  }
  return out;
}

void Model::apply_frictions(std::vector<Wrench>& loads) const {
  for (std::size_t k = 0; k < mechanism_.frictions.size(); ++k) {
    const auto [i, j] = joint_markers_[static_cast<std::size_t>(joint_index_.at(mechanism_.frictions[k].joint))];
    const Wrench w = friction_wrench(k);
    const Vec at = markers_[static_cast<std::size_t>(i)].p;
    apply(loads, i, at, w, 1);
    apply(loads, j, at, w, -1);
  }
}

std::vector<Real> Model::creep_rates(std::size_t k) const {
  const Friction& f = mechanism_.frictions[k];
  std::vector<Real> rates;
  if (f.effect == 2) return rates;
  Real outwards = 0, square = 0;
  const std::vector<Slip> slip = slips(f);
  for (std::size_t n = 0; n < slip.size(); ++n) {
    const Real creep = z[friction_slot_[k] + n];
    outwards += creep * slip[n].speed;
    square += creep * creep;
  }
  if (f.lugre) {
    Real speed = 0;
    for (const Slip& direction : slip) speed = std::hypot(speed, direction.speed);
    for (std::size_t n = 0; n < slip.size(); ++n)
      rates.push_back(slip[n].speed - f.bristles * speed / stribeck(f, speed) * z[friction_slot_[k] + n]);
    return rates;
  }
  const Real share = outwards > 0 ? step(std::sqrt(square) / f.deformation, 0.9L, 1) / square : 0;
  for (std::size_t n = 0; n < slip.size(); ++n)
    rates.push_back(slip[n].speed - share * outwards * z[friction_slot_[k] + n]);
  return rates;
}

}  // namespace dynalin::oracle
