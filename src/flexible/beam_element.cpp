#include "flexible/beam_element.h"

#include "base/second_moments.h"
#include "flexible/beam_points.h"

namespace dynalin {

using beam::cubic_at, beam::cubics, beam::four_places, beam::four_weights, beam::second_moments;

void BeamForces::clear(Partials wanted) {
  elastic.setZero(), inertia.setZero();
  if (wanted == Partials::no) return;
  stiffness.setZero(), damping.setZero(), by_position.setZero(), by_rate.setZero(), mass.setZero();
}

BeamElement::BeamElement(const BeamMaterial& material, const std::array<BeamSection, 2>& sections, double length)
    : material_(material), sections_(sections), length_(length) {
  mass_.setZero();
  first_moment_.setZero();
  for (std::size_t k = 0; k < four_places.size(); ++k) {
    const std::array<double, 4> h = cubics(four_places[k], length_);
    const Eigen::Map<const Eigen::Vector4d> H(h.data());
    const double mass = 0.5 * length_ * four_weights[k] * material.density * section_at(four_places[k]).area;
    mass_ += mass * H * H.transpose();
    first_moment_ += mass * H;
  }
}

BeamSection BeamElement::section_at(double x) const {
  const double b = 0.5 * (1 + x), a = 1 - b;
  const auto mean = [&](double BeamSection::*what) { return a * (sections_[0].*what) + b * (sections_[1].*what); };
  return {mean(&BeamSection::area), mean(&BeamSection::torsion), mean(&BeamSection::yy),     mean(&BeamSection::zz),
          mean(&BeamSection::yz),   mean(&BeamSection::shear_y), mean(&BeamSection::shear_z)};
}

double BeamElement::mass() const { return 0.5 * length_ * material_.density * (sections_[0].area + sections_[1].area); }

double BeamElement::nodal_mass(std::size_t node) const {
  return length_ * material_.density * (sections_[node].area / 3 + sections_[1 - node].area / 6);
}

Matrix3 BeamElement::nodal_inertia(std::size_t node) const {
  const Matrix3 S = second_moments(sections_[node], material_.density);
  const double half = 0.5 * length_, along = material_.density * sections_[node].area * half * half * half / 3;
  Matrix3 J = half * inertia_tensor(S);
  J(1, 1) += along, J(2, 2) += along;  // of a half rod about its end
  return J;
}

void BeamElement::add_translation(const BeamMotion& m, const Vector& gravity, Partials wanted, BeamForces& out) const {
  const auto accelerations = [](const Vec3<BeamMotion::Scalar>& v) {
    return Vector{v.x.acceleration, v.y.acceleration, v.z.acceleration};
  };
  const std::array<Vector, 4> moving = {m.acceleration[0], accelerations(m.slope[0]), m.acceleration[1],
                                        accelerations(m.slope[1])};
  for (Eigen::Index a = 0; a < 4; ++a) {
    const Eigen::Index at = cubic_at[static_cast<std::size_t>(a)];
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      double sum = -gravity[i] * first_moment_(a);
      for (Eigen::Index b = 0; b < 4; ++b) {
        sum += mass_(a, b) * moving[static_cast<std::size_t>(b)][i];
        if (wanted == Partials::yes) out.mass(at + k, cubic_at[static_cast<std::size_t>(b)] + k) += mass_(a, b);
      }
      out.inertia(at + k) += sum;
    }
  }
}

BeamMatrix BeamElement::mass_matrix(const BeamMotion&) const {
  BeamMatrix out = BeamMatrix::Zero();
  for (Eigen::Index a = 0; a < 4; ++a) {
    for (Eigen::Index b = 0; b < 4; ++b) {
      for (Eigen::Index k = 0; k < 3; ++k)
        out(cubic_at[static_cast<std::size_t>(a)] + k, cubic_at[static_cast<std::size_t>(b)] + k) = mass_(a, b);
    }
  }
  return out;
}

std::array<double, 9> BeamElement::kinetic_terms(const BeamMotion&, const BeamVector& velocity) const {
  std::array<double, 9> terms{};
  for (Eigen::Index k = 0; k < 3; ++k) {
    Eigen::Vector4d v;
    for (Eigen::Index a = 0; a < 4; ++a) v(a) = velocity(cubic_at[static_cast<std::size_t>(a)] + k);
    terms[static_cast<std::size_t>(k)] = v.dot(mass_ * v);
  }
  return terms;
}

}  // namespace dynalin
