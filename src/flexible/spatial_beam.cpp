#include "flexible/spatial_beam.h"

#include <algorithm>
#include <cmath>

#include "base/second_moments.h"
#include "flexible/beam_points.h"

namespace dynalin {

using beam::four_places, beam::second_moments, beam::three_places, beam::three_weights, beam::values;

namespace {

using Scalar = BeamMotion::Scalar;

// Where the coordinates of the spins stand.
constexpr std::array<Eigen::Index, 3> spin_at = {3, 9, 18};
constexpr Eigen::Index spin_place(std::size_t i) { return spin_at[i / 3] + static_cast<Eigen::Index>(i % 3); }

// Rotations with what the spins of both ends and φ, the variations of a rotation field, make of them.
using Turning = Dual<rotation_seeds>;

Mat3<Turning> turned(const Mat3<BeamMotion::Scalar>& R, std::size_t first) {
  Mat3<Turning> out;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector axis = values(R[c]);
    for (std::size_t r = 0; r < 3; ++r) out(r, c) = Turning(axis[r]);
    for (std::size_t k = 0; k < 3; ++k) {
      Vector e;
      e[k] = 1;
      const Vector by = cross(e, axis);
      for (std::size_t r = 0; r < 3; ++r) out(r, c).partial[first + k] = by[r];
    }
  }
  return out;
}
RotationField<Turning> varied(const BeamMotion& m) {
  Vec3<Turning> phi;
  for (std::size_t k = 0; k < 3; ++k) phi[k] = Turning(m.middle[k].value, 6 + k);
  return {turned(m.axes[0], 0), turned(m.axes[1], 3), phi};
}

Vector rates(const Vec3<Scalar>& v) { return {v.x.rate, v.y.rate, v.z.rate}; }
Vector accelerations(const Vec3<Scalar>& v) { return {v.x.acceleration, v.y.acceleration, v.z.acceleration}; }

// The parabolas that are 1 at the first end, in the middle, at the second end, and 0 at the others of these.
std::array<double, 3> parabolas(double x) { return {0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)}; }

template <class S>
Mat3<S> inverse(const Mat3<S>& m) {
  const Vec3<S> yz = cross(m.y, m.z);
  const S factor = 1.0 / dot(m.x, yz);
  return transpose(Mat3<S>{yz * factor, cross(m.z, m.x) * factor, cross(m.x, m.y) * factor});
}

// The strains Γ + e_x at both ends and in the middle between them: at the ends out of the slopes, in the middle what
// leads from one node to the other, Σ_g w_g R_g (Γ + e_x)_g = 2 chord/l over the points g.
template <class S>
struct Line {
  std::array<Vec3<S>, 3> strain;
  std::array<Mat3<S>, 3> share;                    // Σ w_g N_j(x_g) R_g
  Mat3<S> to_middle;                               // inverse of the middle one
  std::array<Vec3<S>, three_places.size()> slope;  // r′ at the points

  Line(const std::array<Mat3<S>, 2>& ends, const std::array<Vec3<S>, 2>& end_slopes, const Vec3<S>& chord,
       const std::array<SectionRotation<S>, three_places.size()>& sections, double length) {
    for (std::size_t g = 0; g < sections.size(); ++g) {
      const std::array<double, 3> N = parabolas(three_places[g]);
      for (std::size_t j = 0; j < 3; ++j) share[j] += (three_weights[g] * N[j]) * sections[g].R;
    }
    to_middle = inverse(share[1]);
    strain[0] = transpose_times(ends[0], end_slopes[0]);
    strain[2] = transpose_times(ends[1], end_slopes[1]);
    strain[1] = to_middle * (chord * (2 / length) - share[0] * strain[0] - share[2] * strain[2]);
    for (std::size_t g = 0; g < sections.size(); ++g) slope[g] = sections[g].R * at(three_places[g]);
  }
  Vec3<S> at(double x) const {
    const std::array<double, 3> N = parabolas(x);
    return strain[0] * N[0] + strain[1] * N[1] + strain[2] * N[2];
  }
};

template <class S>
std::array<SectionRotation<S>, three_places.size()> sections_of(const RotationField<S>& field, double length) {
  return {SectionRotation<S>(field, three_places[0], length), SectionRotation<S>(field, three_places[1], length),
          SectionRotation<S>(field, three_places[2], length)};
}

// Of a line along the x axes of these sections that spans the chord.
double length_between(const Vector& chord, const std::array<Matrix3, 2>& axes) {
  const RotationField<double> field(axes[0], axes[1], Vector{});
  // Of its points the sections do not depend on the length but for curvatures.
  Vector mean;
  const auto unit = sections_of(field, 1.0);
  for (std::size_t k = 0; k < unit.size(); ++k) mean += (0.5 * three_weights[k]) * unit[k].R.x;
  return norm(chord) / norm(mean);
}

}  // namespace

SpatialBeam::SpatialBeam(const BeamMaterial& material, const std::array<BeamSection, 2>& sections, const Vector& chord,
                         const std::array<Matrix3, 2>& axes)
    : BeamElement(material, sections, length_between(chord, axes)) {
  const RotationField<double> field(axes[0], axes[1], Vector{});
  const auto sections_there = sections_of(field, length());
  const Line<double> line(axes, {axes[0].x, axes[1].x}, chord, sections_there, length());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Point& p = points_[k];
    p.x = three_places[k], p.weight = 0.5 * length() * three_weights[k];
    p.strain = line.at(p.x);
    p.curvature = sections_there[k].curvature;
    const BeamSection s = section_at(p.x);
    p.stretching = {material.E * s.area, material.G * s.area / s.shear_y, material.G * s.area / s.shear_z};
    p.torsion = material.G * s.torsion;
    p.yy = material.E * s.yy, p.zz = material.E * s.zz, p.yz = material.E * s.yz;
    p.second_moments = second_moments(s, material.density);
  }
}

void SpatialBeam::forces(const BeamMotion& m, const Vector& gravity, Partials wanted, BeamForces& out) const {
  out.clear(wanted);
  const RotationField<Scalar> field(m.axes[0], m.axes[1], m.middle);
  const auto sections = sections_of(field, length());
  const Strains strains = strains_of(m, sections);
  const Stresses stresses = stresses_of(strains);
  for (std::size_t k = 0; k < point_count; ++k) {
    for (std::size_t a = 0; a < beam_coordinates; ++a) {
      out.elastic(static_cast<Eigen::Index>(a)) += dot(stresses.force[k], values(strains.of_strain[k][a])) +
                                                   dot(stresses.moment[k], values(strains.of_curvature[k][a]));
    }
  }
  if (wanted == Partials::yes) {
    add_stiffness(strains, out);
    const auto varied_sections = sections_of(varied(m), length());
    add_held_stresses(m, varied_sections, stresses, out);
    for (std::size_t k = 0; k < point_count; ++k) add_spin(points_[k], sections[k], &varied_sections[k], out);
  } else {
    for (std::size_t k = 0; k < point_count; ++k) add_spin(points_[k], sections[k], nullptr, out);
  }
  add_translation(m, gravity, wanted, out);
}

// With the spins w_g of the points the middle strain follows as the line that it leads along does:
//     share δΓ_m = 2 δchord/l + Σ w_g r′_g × w_g − Σ share δΓ of both ends,     δΓ = Rᵀ(δr_s + r_s × θ) there.
SpatialBeam::Strains SpatialBeam::strains_of(const BeamMotion& m,
                                             const std::array<SectionRotation<Scalar>, point_count>& sections) const {
  const Line<Scalar> line(m.axes, m.slope, m.chord, sections, length());
  std::array<std::array<Vec3<Scalar>, beam_coordinates>, 3> of{};  // at the first end, in the middle, at the second
  for (std::size_t end = 0; end < 2; ++end) {
    auto& own = of[2 * end];
    const std::size_t slope = 12 + 3 * end, spin = 6 * end + 3, place = 6 * end;
    for (std::size_t k = 0; k < 3; ++k) {
      Vector e;
      e[k] = 1;
      for (std::size_t i = 0; i < 3; ++i) own[slope + k][i] = m.axes[end][i][k];
      own[spin + k] = transpose_times(m.axes[end], cross(m.slope[end], e));
      of[1][place + k] = line.to_middle[k] * ((end == 0 ? -2 : 2) / length());
      of[1][slope + k] -= line.to_middle * (line.share[2 * end] * own[slope + k]);
      of[1][spin + k] -= line.to_middle * (line.share[2 * end] * own[spin + k]);
    }
  }
  Strains s;
  for (std::size_t g = 0; g < point_count; ++g) {
    s.curvature[g] = sections[g].curvature;
    s.strain[g] = line.at(points_[g].x);
    for (std::size_t i = 0; i < rotation_seeds; ++i) {
      const auto at = static_cast<std::size_t>(spin_place(i));
      of[1][at] += line.to_middle * (cross(line.slope[g], sections[g].spin[i]) * three_weights[g]);
      s.of_curvature[g][at] = transpose_times(sections[g].R, sections[g].spin_slope[i]);
    }
  }
  for (std::size_t g = 0; g < point_count; ++g) {
    const std::array<double, 3> N = parabolas(points_[g].x);
    for (std::size_t a = 0; a < beam_coordinates; ++a)
      s.of_strain[g][a] = of[0][a] * N[0] + of[1][a] * N[1] + of[2][a] * N[2];
  }
  return s;
}

Vector SpatialBeam::stretching(const Point& p, const Vector& g) {
  return {p.stretching.x * g.x, p.stretching.y * g.y, p.stretching.z * g.z};
}
Vector SpatialBeam::bending(const Point& p, const Vector& k) {
  return {p.torsion * k.x, p.yy * k.y - p.yz * k.z, p.zz * k.z - p.yz * k.y};
}

SpatialBeam::Stresses SpatialBeam::stresses_of(const Strains& s) const {
  Stresses out;
  const double c = material().damping;
  for (std::size_t k = 0; k < point_count; ++k) {
    const Point& p = points_[k];
    out.force[k] = p.weight * stretching(p, values(s.strain[k]) - p.strain + c * rates(s.strain[k]));
    out.moment[k] = p.weight * bending(p, values(s.curvature[k]) - p.curvature + c * rates(s.curvature[k]));
  }
  return out;
}

void SpatialBeam::add_stiffness(const Strains& s, BeamForces& out) const {
  const double c = material().damping;
  for (std::size_t k = 0; k < point_count; ++k) {
    const Point& p = points_[k];
    for (std::size_t b = 0; b < beam_coordinates; ++b) {
      const auto column = static_cast<Eigen::Index>(b);
      const Vec3<Scalar>&strain = s.of_strain[k][b], &curvature = s.of_curvature[k][b];
      const Vector by_rate = p.weight * stretching(p, values(strain)),
                   by_rate_M = p.weight * bending(p, values(curvature));
      const Vector by_place = by_rate + (c * p.weight) * stretching(p, rates(strain)),
                   by_place_M = by_rate_M + (c * p.weight) * bending(p, rates(curvature));
      for (std::size_t a = 0; a < beam_coordinates; ++a) {
        const auto row = static_cast<Eigen::Index>(a);
        const Vector g = values(s.of_strain[k][a]), bends = values(s.of_curvature[k][a]);
        out.stiffness(row, column) += dot(by_place, g) + dot(by_place_M, bends);
        out.damping(row, column) += c * (dot(by_rate, g) + dot(by_rate_M, bends));
      }
    }
  }
}

// The stresses held, what they work on changes: with ν_j the forces on the strains of the ends and the middle, n =
// share⁻ᵀ ν_m and μ = ν − shareᵀ n of each end they work
//     2 n·δchord/l + Σ w_g n·(r′_g × w_g) + Σ μ·δΓ of both ends + Σ R_g M_g·w_g′
void SpatialBeam::add_held_stresses(const BeamMotion& m,
                                    const std::array<SectionRotation<Turning>, point_count>& sections,
                                    const Stresses& stresses, BeamForces& out) const {
  const auto constant = [](const Vec3<Scalar>& v) {
    return Vec3<Turning>{Turning(v.x.value), Turning(v.y.value), Turning(v.z.value)};
  };
  const std::array<Mat3<Turning>, 2> axes = {turned(m.axes[0], 0), turned(m.axes[1], 3)};
  const std::array<Vec3<Turning>, 2> slopes = {constant(m.slope[0]), constant(m.slope[1])};
  const Line<Turning> line(axes, slopes, constant(m.chord), sections, length());
  std::array<Vector, 3> on{};
  for (std::size_t g = 0; g < point_count; ++g) {
    const std::array<double, 3> N = parabolas(points_[g].x);
    for (std::size_t j = 0; j < 3; ++j) on[j] += N[j] * stresses.force[g];
  }
  const Vec3<Turning> n = transpose_times(line.to_middle, on[1]);
  const std::array<Vec3<Turning>, 2> mu = {on[0] - transpose_times(line.share[0], n),
                                           on[2] - transpose_times(line.share[2], n)};
  // Forces on places and slopes turn; forces on spins change by places and slopes in the same way.
  const auto add_both = [&](Eigen::Index at, const Vec3<Turning>& force) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < rotation_seeds; ++i) {
        const double change = force[static_cast<std::size_t>(k)].partial[i];
        out.stiffness(at + k, spin_place(i)) += change;
        out.stiffness(spin_place(i), at + k) += change;
      }
    }
  };
  add_both(0, n * (-2 / length()));
  add_both(6, n * (2 / length()));
  std::array<Turning, rotation_seeds> work{};
  for (std::size_t end = 0; end < 2; ++end) {
    const Vec3<Turning> force = axes[end] * mu[end], couple = cross(force, slopes[end]);
    add_both(static_cast<Eigen::Index>(12 + 3 * end), force);
    for (std::size_t k = 0; k < 3; ++k) work[3 * end + k] += couple[k];
  }
  for (std::size_t g = 0; g < point_count; ++g) {
    const Vec3<Turning> couple = cross(n, line.slope[g]) * three_weights[g],
                        moment = sections[g].R * stresses.moment[g];
    for (std::size_t i = 0; i < rotation_seeds; ++i)
      work[i] += dot(couple, sections[g].spin[i]) + dot(moment, sections[g].spin_slope[i]);
  }
  for (std::size_t i = 0; i < rotation_seeds; ++i) {
    for (std::size_t k = 0; k < rotation_seeds; ++k) out.stiffness(spin_place(i), spin_place(k)) += work[i].partial[k];
  }
}

// The section's own inertia on its axes: A S Aᵀ, Ȧ S Aᵀ, Ä S Aᵀ.
void SpatialBeam::add_spin(const Point& p, const SectionRotation<Scalar>& section, const SectionRotation<Turning>* vary,
                           BeamForces& out) const {
  const Matrix3 R = values(section.R), SA = p.weight * (p.second_moments * transpose(R));
  const Matrix3 rate{rates(section.R.x), rates(section.R.y), rates(section.R.z)};
  const Matrix3 acceleration{accelerations(section.R.x), accelerations(section.R.y), accelerations(section.R.z)};
  const Matrix3 G0 = R * SA, G1 = rate * SA, G2 = acceleration * SA;
  const Vector torque{G2(2, 1) - G2(1, 2), G2(0, 2) - G2(2, 0), G2(1, 0) - G2(0, 1)};
  for (std::size_t i = 0; i < rotation_seeds; ++i) out.inertia(spin_place(i)) += dot(values(section.spin[i]), torque);
  if (!vary) return;
  // δT = J δϑ″ + 2 (tr G₁ − G₁) δϑ′ + (G₂ᵀ − G₂) δϑ with the spin ϑ = w δq along the motion.
  const Matrix3 J = inertia_tensor(G0), swing = 2 * inertia_tensor(G1), fling = transpose(G2) - G2;
  for (std::size_t k = 0; k < rotation_seeds; ++k) {
    const Vector w = values(section.spin[k]), w1 = rates(section.spin[k]), w2 = accelerations(section.spin[k]);
    const Vector by_acceleration = J * w, by_rate = 2 * (J * w1) + swing * w,
                 by_position = J * w2 + swing * w1 + fling * w;
    for (std::size_t i = 0; i < rotation_seeds; ++i) {
      const Vector own = values(section.spin[i]);
      out.mass(spin_place(i), spin_place(k)) += dot(own, by_acceleration);
      out.by_rate(spin_place(i), spin_place(k)) += dot(own, by_rate);
      out.by_position(spin_place(i), spin_place(k)) += dot(own, by_position) + dot(vary->spin[i], torque).partial[k];
    }
  }
}

BeamMatrix SpatialBeam::mass_matrix(const BeamMotion& m) const {
  BeamMatrix out = BeamElement::mass_matrix(m);
  const RotationField<double> field(values(m.axes[0]), values(m.axes[1]), values(m.middle));
  for (const Point& p : points_) {
    const SectionRotation<double> section(field, p.x, length());
    const Matrix3 J = inertia_tensor(p.weight * (section.R * p.second_moments * transpose(section.R)));
    for (std::size_t i = 0; i < rotation_seeds; ++i) {
      for (std::size_t k = 0; k < rotation_seeds; ++k)
        out(spin_place(i), spin_place(k)) += dot(section.spin[i], J * section.spin[k]);
    }
  }
  return out;
}

std::array<double, 9> SpatialBeam::kinetic_terms(const BeamMotion& m, const BeamVector& velocity) const {
  std::array<double, 9> terms = BeamElement::kinetic_terms(m, velocity);
  const RotationField<double> field(values(m.axes[0]), values(m.axes[1]), values(m.middle));
  for (const Point& p : points_) {
    const SectionRotation<double> section(field, p.x, length());
    const Matrix3 J = inertia_tensor(p.weight * (section.R * p.second_moments * transpose(section.R)));
    Vector w;
    for (std::size_t i = 0; i < rotation_seeds; ++i) w += section.spin[i] * velocity(spin_place(i));
    for (std::size_t k = 0; k < 3; ++k) terms[3 + k] += J(k, k) * w[k] * w[k];
    terms[6] += 2 * J(0, 1) * w.x * w.y, terms[7] += 2 * J(0, 2) * w.x * w.z, terms[8] += 2 * J(1, 2) * w.y * w.z;
  }
  return terms;
}

double SpatialBeam::largest_turn(const BeamMotion& m) const {
  const Vector apart = rotation::logarithm(transpose_times(values(m.axes[0]), values(m.axes[1])));
  return std::max(norm(apart), 2 * norm(values(m.middle)));
}

bool SpatialBeam::turns_sections(std::size_t coordinate) const { return is_beam_rotation(coordinate); }

BeamElement::Spins SpatialBeam::spins(const BeamMotion& m) const {
  Spins out{};
  const RotationField<double> field(values(m.axes[0]), values(m.axes[1]), values(m.middle));
  for (std::size_t g = 0; g < beam_load_points; ++g) {
    const SectionRotation<double> section(field, four_places[g], length());
    for (std::size_t i = 0; i < rotation_seeds; ++i) out[g][static_cast<std::size_t>(spin_place(i))] = section.spin[i];
  }
  return out;
}

BeamElement::SectionMotion SpatialBeam::section_along(const BeamMotion& m, std::size_t load_point) const {
  const SectionRotation<Scalar> section(RotationField<Scalar>(m.axes[0], m.axes[1], m.middle), four_places[load_point],
                                        length());
  SectionMotion out{section.R, {}};
  for (std::size_t i = 0; i < rotation_seeds; ++i) out.spin[static_cast<std::size_t>(spin_place(i))] = section.spin[i];
  return out;
}

BeamMatrix SpatialBeam::moments_by_position(const BeamMotion& m, const Moments& moments) const {
  BeamMatrix out = BeamMatrix::Zero();
  const RotationField<Turning> field = varied(m);
  for (std::size_t g = 0; g < beam_load_points; ++g) {
    const SectionRotation<Turning> section(field, four_places[g], length());
    for (std::size_t i = 0; i < rotation_seeds; ++i) {
      const Turning work = dot(section.spin[i], moments[g]);
      for (std::size_t k = 0; k < rotation_seeds; ++k) out(spin_place(i), spin_place(k)) += work.partial[k];
    }
  }
  return out;
}

}  // namespace dynalin
