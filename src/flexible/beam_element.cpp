#include "flexible/beam_element.h"

#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

using Scalar = BeamMotion::Scalar;
using Turning = Dual<rotation_seeds>;

// Gauss points from −1 to 1. Three are exact for the strains of a straight element and for its rotational inertia, four
// for the products of cubics with an area that varies along it.
constexpr std::array<double, 3> three_places = {-0.77459666924148337704, 0.0, 0.77459666924148337704};
constexpr std::array<double, 3> three_weights = {5.0 / 9, 8.0 / 9, 5.0 / 9};
constexpr std::array<double, 4> four_places = {-0.86113631159405257522, -0.33998104358485626480,
                                               0.33998104358485626480, 0.86113631159405257522};
constexpr std::array<double, 4> four_weights = {0.34785484513745385737, 0.65214515486254614263,
                                                0.65214515486254614263, 0.34785484513745385737};

// Where the coordinates of the cubics r₁, r_s1, r₂, r_s2 and those of the spins stand.
constexpr std::array<Eigen::Index, 4> cubic_at = {0, 12, 6, 15};
constexpr std::array<Eigen::Index, 3> spin_at = {3, 9, 18};
constexpr Eigen::Index spin_place(std::size_t i) { return spin_at[i / 3] + static_cast<Eigen::Index>(i % 3); }

std::array<double, 4> cubics(double x, double length) {
  const double a = 0.5 * (1 + x), a2 = a * a, a3 = a2 * a;
  return {1 - 3 * a2 + 2 * a3, length * (a - 2 * a2 + a3), 3 * a2 - 2 * a3, length * (a3 - a2)};
}
std::array<double, 4> cubic_slopes(double x, double length) {
  const double a = 0.5 * (1 + x), up = 6 * (a - a * a) / length;
  return {-up, 1 - 4 * a + 3 * a * a, up, 3 * a * a - 2 * a};
}

BeamSection between(const std::array<BeamSection, 2>& ends, double x) {
  const double b = 0.5 * (1 + x), a = 1 - b;
  const auto mean = [&](double BeamSection::* what) { return a * (ends[0].*what) + b * (ends[1].*what); };
  return {mean(&BeamSection::area), mean(&BeamSection::torsion), mean(&BeamSection::yy),     mean(&BeamSection::zz),
          mean(&BeamSection::yz),   mean(&BeamSection::shear_y), mean(&BeamSection::shear_z)};
}

template <class T>
Vector values(const Vec3<T>& v) {
  return {value_of(v.x), value_of(v.y), value_of(v.z)};
}
template <class T>
Matrix3 values(const Mat3<T>& m) {
  return {values(m.x), values(m.y), values(m.z)};
}
Vector rates(const Vec3<Scalar>& v) { return {v.x.rate, v.y.rate, v.z.rate}; }
Vector accelerations(const Vec3<Scalar>& v) { return {v.x.acceleration, v.y.acceleration, v.z.acceleration}; }

Mat3<Turning> turned(const Mat3<Scalar>& R, std::size_t first) {
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

Vec3<Scalar> line_slope(const BeamMotion& m, const std::array<double, 4>& h) {
  return m.chord * h[2] + m.slope[0] * h[1] + m.slope[1] * h[3];
}

// J = tr(A S Aᵀ) − A S Aᵀ and the like.
Matrix3 traced(const Matrix3& m) { return Matrix3::diagonal(trace(m)) - m; }

Matrix3 second_moments(const BeamSection& s, double density) {
  Matrix3 S;
  S(1, 1) = density * s.zz, S(2, 2) = density * s.yy;
  S(1, 2) = S(2, 1) = density * s.yz;
  return S;
}

}  // namespace

BeamElement::BeamElement(const BeamMaterial& material, const std::array<BeamSection, 2>& sections, const Vector& chord,
                         const std::array<Matrix3, 2>& axes)
    : material_(material), sections_(sections) {
  find_length(chord, axes);
  const RotationField<double> field(axes[0], axes[1], Vector{});
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Point& p = points_[k];
    p.x = three_places[k], p.weight = 0.5 * length_ * three_weights[k];
    p.slope = cubic_slopes(p.x, length_);
    const SectionRotation<double> section(field, p.x, length_);
    p.strain = transpose_times(section.R, chord * p.slope[2] + axes[0].x * p.slope[1] + axes[1].x * p.slope[3]);
    p.curvature = section.curvature;
    const BeamSection s = between(sections_, p.x);
    p.stretching = {material.E * s.area, material.G * s.area / s.shear_y, material.G * s.area / s.shear_z};
    p.torsion = material.G * s.torsion;
    p.yy = material.E * s.yy, p.zz = material.E * s.zz, p.yz = material.E * s.yz;
    p.second_moments = dynalin::second_moments(s, material.density);
  }
  mass_.setZero();
  first_moment_.setZero();
  for (std::size_t k = 0; k < four_places.size(); ++k) {
    const std::array<double, 4> h = cubics(four_places[k], length_);
    const Eigen::Map<const Eigen::Vector4d> H(h.data());
    const double mass = 0.5 * length_ * four_weights[k] * material.density * between(sections_, four_places[k]).area;
    mass_ += mass * H * H.transpose();
    first_moment_ += mass * H;
  }
}

// The arc length of the cubic whose slopes have length 1 at the ends: the length it is made with, found by repetition,
// which gains digits by the square of the angle between the ends each time.
void BeamElement::find_length(const Vector& chord, const std::array<Matrix3, 2>& axes) {
  length_ = norm(chord);
  for (int pass = 0; pass < 60; ++pass) {
    double arc = 0;
    for (std::size_t k = 0; k < four_places.size(); ++k) {
      const std::array<double, 4> h = cubic_slopes(four_places[k], length_);
      arc += 0.5 * length_ * four_weights[k] * norm(chord * h[2] + axes[0].x * h[1] + axes[1].x * h[3]);
    }
    const double change = std::abs(arc - length_);
    length_ = arc;
    if (change <= 1e-15 * arc) break;
  }
}

double BeamElement::mass() const { return 0.5 * length_ * material_.density * (sections_[0].area + sections_[1].area); }

double BeamElement::nodal_mass(std::size_t node) const {
  return length_ * material_.density * (sections_[node].area / 3 + sections_[1 - node].area / 6);
}

Matrix3 BeamElement::nodal_inertia(std::size_t node) const {
  const Matrix3 S = second_moments(sections_[node], material_.density);
  const double half = 0.5 * length_, along = material_.density * sections_[node].area * half * half * half / 3;
  Matrix3 J = half * traced(S);
  J(1, 1) += along, J(2, 2) += along;  // of a half rod about its end
  return J;
}

void BeamElement::forces(const BeamMotion& m, const Vector& gravity, bool with_partials, BeamForces& out) const {
  out.elastic.setZero(), out.inertia.setZero();
  if (with_partials) {
    out.stiffness.setZero(), out.damping.setZero(), out.by_position.setZero(), out.by_rate.setZero();
    out.mass.setZero();
  }
  const RotationField<Scalar> field(m.axes[0], m.axes[1], m.middle);
  if (with_partials) {
    const RotationField<Turning> turning = varied(m);
    for (const Point& p : points_) add_point(p, m, field, &turning, out);
  } else {
    for (const Point& p : points_) add_point(p, m, field, nullptr, out);
  }
  const std::array<Vector, 4> moving = {m.acceleration[0], accelerations(m.slope[0]), m.acceleration[1],
                                        accelerations(m.slope[1])};
  for (Eigen::Index a = 0; a < 4; ++a) {
    const Eigen::Index at = cubic_at[static_cast<std::size_t>(a)];
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      double sum = -gravity[i] * first_moment_(a);
      for (Eigen::Index b = 0; b < 4; ++b) {
        sum += mass_(a, b) * moving[static_cast<std::size_t>(b)][i];
        if (with_partials) out.mass(at + k, cubic_at[static_cast<std::size_t>(b)] + k) += mass_(a, b);
      }
      out.inertia(at + k) += sum;
    }
  }
}

void BeamElement::add_point(const Point& p, const BeamMotion& m, const RotationField<Scalar>& field,
                            const RotationField<Turning>* turning, BeamForces& out) const {
  const SectionRotation<Scalar> section(field, p.x, length_);
  const Vec3<Scalar> slope = line_slope(m, p.slope);
  const Vec3<Scalar> strain = transpose_times(section.R, slope);
  const Matrix3 R = values(section.R);
  const double c = material_.damping;
  const auto stretching = [&](const Vector& g) {
    return Vector{p.stretching.x * g.x, p.stretching.y * g.y, p.stretching.z * g.z};
  };
  const auto bending = [&](const Vector& k) {
    return Vector{p.torsion * k.x, p.yy * k.y - p.yz * k.z, p.zz * k.z - p.yz * k.y};
  };
  const Vector N = p.weight * stretching(values(strain) - p.strain + c * rates(strain));
  const Vector M = p.weight * bending(values(section.curvature) - p.curvature + c * rates(section.curvature));
  const Vector n = R * N, r_slope = values(slope);

  // What each coordinate makes of both strains, along the motion.
  std::array<Vec3<Scalar>, beam_coordinates> of_strain{}, of_curvature{};
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3<Scalar>& g = of_strain[static_cast<std::size_t>(cubic_at[a]) + k];
      for (std::size_t i = 0; i < 3; ++i) g[i] = section.R[i][k] * p.slope[a];
    }
  }
  for (std::size_t i = 0; i < rotation_seeds; ++i) {
    const auto at = static_cast<std::size_t>(spin_place(i));
    of_strain[at] = transpose_times(section.R, cross(slope, section.spin[i]));
    of_curvature[at] = transpose_times(section.R, section.spin_slope[i]);
  }
  for (std::size_t a = 0; a < beam_coordinates; ++a) {
    out.elastic(static_cast<Eigen::Index>(a)) += dot(N, values(of_strain[a])) + dot(M, values(of_curvature[a]));
  }

  // The section's own inertia on its axes: A S Aᵀ, Ȧ S Aᵀ, Ä S Aᵀ.
  const Matrix3 SA = p.weight * (p.second_moments * transpose(R));
  const Matrix3 rate{rates(section.R.x), rates(section.R.y), rates(section.R.z)};
  const Matrix3 acceleration{accelerations(section.R.x), accelerations(section.R.y), accelerations(section.R.z)};
  const Matrix3 G0 = R * SA, G1 = rate * SA, G2 = acceleration * SA;
  const Vector moment{G2(2, 1) - G2(1, 2), G2(0, 2) - G2(2, 0), G2(1, 0) - G2(0, 1)};
  for (std::size_t i = 0; i < rotation_seeds; ++i) out.inertia(spin_place(i)) += dot(values(section.spin[i]), moment);
  if (!turning) return;

  for (std::size_t b = 0; b < beam_coordinates; ++b) {
    const auto column = static_cast<Eigen::Index>(b);
    const Vector of_rate = p.weight * stretching(values(of_strain[b])),
                 of_rate_M = p.weight * bending(values(of_curvature[b]));
    const Vector of_place = of_rate + c * p.weight * stretching(rates(of_strain[b])),
                 of_place_M = of_rate_M + c * p.weight * bending(rates(of_curvature[b]));
    for (std::size_t a = 0; a < beam_coordinates; ++a) {
      const auto row = static_cast<Eigen::Index>(a);
      const Vector g = values(of_strain[a]), k = values(of_curvature[a]);
      out.stiffness(row, column) += dot(of_place, g) + dot(of_place_M, k);
      out.damping(row, column) += c * (dot(of_rate, g) + dot(of_rate_M, k));
    }
  }
  // The stresses held, what they work on changes.
  const SectionRotation<Turning> vary(*turning, p.x, length_);
  const Vec3<Turning> n_turns = vary.R * N, m_turns = vary.R * M;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < rotation_seeds; ++i) {
        const double both = p.slope[a] * n_turns[k].partial[i];
        out.stiffness(cubic_at[a] + static_cast<Eigen::Index>(k), spin_place(i)) += both;
        out.stiffness(spin_place(i), cubic_at[a] + static_cast<Eigen::Index>(k)) +=
            p.slope[a] * cross(values(section.spin[i]), n)[k];
      }
    }
  }
  for (std::size_t i = 0; i < rotation_seeds; ++i) {
    const Turning work = dot(n_turns, cross(r_slope, vary.spin[i])) + dot(m_turns, vary.spin_slope[i]);
    const Turning turned_moment = dot(vary.spin[i], moment);
    for (std::size_t k = 0; k < rotation_seeds; ++k) {
      out.stiffness(spin_place(i), spin_place(k)) += work.partial[k];
      out.by_position(spin_place(i), spin_place(k)) += turned_moment.partial[k];
    }
  }
  // δT = J δϑ″ + 2 (tr G₁ − G₁) δϑ′ + (G₂ᵀ − G₂) δϑ with the spin ϑ = w δq along the motion.
  const Matrix3 J = traced(G0), swing = 2 * traced(G1), fling = transpose(G2) - G2;
  for (std::size_t k = 0; k < rotation_seeds; ++k) {
    const Vector w = values(section.spin[k]), w1 = rates(section.spin[k]), w2 = accelerations(section.spin[k]);
    const Vector by_acceleration = J * w, by_rate = 2 * (J * w1) + swing * w,
                 by_position = J * w2 + swing * w1 + fling * w;
    for (std::size_t i = 0; i < rotation_seeds; ++i) {
      const Vector own = values(section.spin[i]);
      out.mass(spin_place(i), spin_place(k)) += dot(own, by_acceleration);
      out.by_rate(spin_place(i), spin_place(k)) += dot(own, by_rate);
      out.by_position(spin_place(i), spin_place(k)) += dot(own, by_position);
    }
  }
}

BeamMatrix BeamElement::mass_matrix(const BeamMotion& m) const {
  BeamMatrix out = BeamMatrix::Zero();
  for (Eigen::Index a = 0; a < 4; ++a) {
    for (Eigen::Index b = 0; b < 4; ++b) {
      for (Eigen::Index k = 0; k < 3; ++k)
        out(cubic_at[static_cast<std::size_t>(a)] + k, cubic_at[static_cast<std::size_t>(b)] + k) = mass_(a, b);
    }
  }
  const RotationField<double> field(values(m.axes[0]), values(m.axes[1]), values(m.middle));
  for (const Point& p : points_) {
    const SectionRotation<double> section(field, p.x, length_);
    const Matrix3 J = traced(p.weight * (section.R * p.second_moments * transpose(section.R)));
    for (std::size_t i = 0; i < rotation_seeds; ++i) {
      for (std::size_t k = 0; k < rotation_seeds; ++k)
        out(spin_place(i), spin_place(k)) += dot(section.spin[i], J * section.spin[k]);
    }
  }
  return out;
}

std::array<double, 9> BeamElement::kinetic_terms(const BeamMotion& m, const BeamVector& velocity) const {
  std::array<double, 9> terms{};
  for (Eigen::Index k = 0; k < 3; ++k) {
    Eigen::Vector4d v;
    for (Eigen::Index a = 0; a < 4; ++a) v(a) = velocity(cubic_at[static_cast<std::size_t>(a)] + k);
    terms[static_cast<std::size_t>(k)] = v.dot(mass_ * v);
  }
  const RotationField<double> field(values(m.axes[0]), values(m.axes[1]), values(m.middle));
  for (const Point& p : points_) {
    const SectionRotation<double> section(field, p.x, length_);
    const Matrix3 J = traced(p.weight * (section.R * p.second_moments * transpose(section.R)));
    Vector w;
    for (std::size_t i = 0; i < rotation_seeds; ++i) w += section.spin[i] * velocity(spin_place(i));
    for (std::size_t k = 0; k < 3; ++k) terms[3 + k] += J(k, k) * w[k] * w[k];
    terms[6] += 2 * J(0, 1) * w.x * w.y, terms[7] += 2 * J(0, 2) * w.x * w.z, terms[8] += 2 * J(1, 2) * w.y * w.z;
  }
  return terms;
}

double BeamElement::largest_turn(const BeamMotion& m) {
  const Vector apart = rotation::logarithm(transpose_times(values(m.axes[0]), values(m.axes[1])));
  return std::max(norm(apart), 2 * norm(values(m.middle)));
}

}  // namespace dynalin
