#include "expression/measures.h"

#include <limits>

#include "expression/measured_angles.h"
#include "expression/measured_zero.h"

namespace dynalin {

namespace {

using measured::largest;
using measured::magnitude;

// Of a value alone nothing is known but the value.
double rate_of(double x) { return detail::missing(x); }
template <std::size_t N, class T>
Dual<N, T> rate_of(const Dual<N, T>& x) {
  return detail::missing(x);
}
template <class T>
TimeTaylor<T> rate_of(const TimeTaylor<T>& x) {
  return dynalin::differentiate(x);
}
template <class T>
Vec3<T> differentiate(const Vec3<T>& v) {
  return {rate_of(v.x), rate_of(v.y), rate_of(v.z)};
}

// ω = ½ Σ a × a′ over the axes a of the frame.
template <class T>
Vec3<T> angular_velocity(const Frame<T>& f) {
  Vec3<T> sum{};
  for (std::size_t c = 0; c < 3; ++c) sum += cross(f.axes[c], differentiate(f.axes[c]));
  return sum * 0.5;
}

// Displacement of i from j.
template <class T>
Vec3<T> displacement(const MeasureFrames<T>& f) {
  return f.i.origin - f.j.origin;
}
// Its derivative as an observer on l sees it: r′ − ω_l × r.
template <class T>
Vec3<T> velocity(const MeasureFrames<T>& f) {
  const Vec3<T> r = displacement(f);
  return differentiate(r) - cross(angular_velocity(f.l), r);
}
// r″ − α_l × r − 2 ω_l × u − ω_l × (ω_l × r) with u = r′ − ω_l × r, which is u′ − ω_l × u.
template <class T>
Vec3<T> acceleration(const MeasureFrames<T>& f) {
  const Vec3<T> u = velocity(f);
  return differentiate(u) - cross(angular_velocity(f.l), u);
}
template <class T>
Vec3<T> relative_angular_velocity(const MeasureFrames<T>& f) {
  return angular_velocity(f.i) - angular_velocity(f.j);
}
// α_i − α_j − ω_l × (ω_i − ω_j)
template <class T>
Vec3<T> relative_angular_acceleration(const MeasureFrames<T>& f) {
  const Vec3<T> w = relative_angular_velocity(f);
  return differentiate(w) - cross(angular_velocity(f.l), w);
}

template <class T>
double size_of_displacement(const MeasureFrames<T>& f) {
  return largest(f.i.origin) + largest(f.j.origin);
}
template <class T>
double size_of_velocity(const MeasureFrames<T>& f) {
  return largest(differentiate(f.i.origin)) + largest(differentiate(f.j.origin)) +
         largest(angular_velocity(f.l)) * size_of_displacement(f);
}
template <class T>
double size_of_acceleration(const MeasureFrames<T>& f) {
  const Vec3<T> w = angular_velocity(f.l);
  return largest(differentiate(differentiate(f.i.origin))) + largest(differentiate(differentiate(f.j.origin))) +
         2 * largest(w) * size_of_velocity(f) + largest(differentiate(w)) * size_of_displacement(f);
}
template <class T>
double size_of_angular_velocity(const MeasureFrames<T>& f) {
  return largest(angular_velocity(f.i)) + largest(angular_velocity(f.j));
}
template <class T>
double size_of_angular_acceleration(const MeasureFrames<T>& f) {
  return largest(differentiate(angular_velocity(f.i))) + largest(differentiate(angular_velocity(f.j))) +
         largest(angular_velocity(f.l)) * size_of_angular_velocity(f);
}

}  // namespace

bool may_jump(Measure m) {
  switch (m) {
    case Measure::PSI:
    case Measure::PHI:
    case Measure::YAW:
    case Measure::ROLL:
    case Measure::PSI_PLUS_PHI:
    case Measure::PSI_MINUS_PHI:
    case Measure::YAW_PLUS_ROLL:
    case Measure::YAW_MINUS_ROLL:
      return true;
    default:
      return false;
  }
}

std::string_view place_without_gradient(Measure m) {
  switch (m) {
    case Measure::DM:
    case Measure::VM:
    case Measure::WM:
    case Measure::ACCM:
    case Measure::WDTM:
      return "where it is 0";
    case Measure::VR:
      return "where the markers coincide";
    case Measure::PSI:
    case Measure::PHI:
      return "where THETA is 0 or π";
    case Measure::YAW:
    case Measure::ROLL:
      return "where PITCH is π/2 or −π/2";
    case Measure::PSI_PLUS_PHI:
      return "where THETA is π";
    case Measure::PSI_MINUS_PHI:
      return "where THETA is 0";
    case Measure::YAW_PLUS_ROLL:
      return "where PITCH is −π/2";
    case Measure::YAW_MINUS_ROLL:
      return "where PITCH is π/2";
    case Measure::PITCH:
      return "where it is π/2 or −π/2";
    case Measure::THETA:
    case Measure::INCANG:
      return "where it is 0 or π";
    case Measure::THETA_SQUARED:
    case Measure::INCANG_SQUARED:
      return "where the angle is π";
    default:
      return {};
  }
}

template <class T>
T evaluate_measure(Measure measure, const MeasureFrames<T>& f) {
  const auto component = [&](const Vec3<T>& v, Measure x) {
    const auto axis = static_cast<std::size_t>(measure) - static_cast<std::size_t>(x);
    return dot(f.k.axes[axis], v);
  };
  // clang-format off
  switch (measure) {
    case Measure::DX: case Measure::DY: case Measure::DZ: return component(displacement(f), Measure::DX);
    case Measure::DM: return magnitude(displacement(f), size_of_displacement(f));
    case Measure::VX: case Measure::VY: case Measure::VZ: return component(velocity(f), Measure::VX);
    case Measure::VM: return magnitude(velocity(f), size_of_velocity(f));
    case Measure::VR: return rate_of(magnitude(displacement(f), size_of_displacement(f)));
    case Measure::WX: case Measure::WY: case Measure::WZ:
      return component(relative_angular_velocity(f), Measure::WX);
    case Measure::WM: return magnitude(relative_angular_velocity(f), size_of_angular_velocity(f));
    case Measure::ACCX: case Measure::ACCY: case Measure::ACCZ: return component(acceleration(f), Measure::ACCX);
    case Measure::ACCM: return magnitude(acceleration(f), size_of_acceleration(f));
    case Measure::WDTX: case Measure::WDTY: case Measure::WDTZ:
      return component(relative_angular_acceleration(f), Measure::WDTX);
    case Measure::WDTM: return magnitude(relative_angular_acceleration(f), size_of_angular_acceleration(f));
    case Measure::AX: return measured::angle_of_point(-measured::direction(f, 2, 3), measured::direction(f, 3, 3));
    case Measure::AY: return measured::angle_of_point(measured::direction(f, 1, 3), measured::direction(f, 3, 3));
    case Measure::AZ: return measured::angle_of_point(measured::direction(f, 2, 1), measured::direction(f, 1, 1));
    case Measure::PSI: return measured::psi_and_phi(f).first;
    case Measure::THETA: return measured::theta(f);
    case Measure::PHI: return measured::psi_and_phi(f).last;
    case Measure::YAW: return measured::yaw_and_roll(f).first;
    case Measure::PITCH: return measured::pitch(f);
    case Measure::ROLL: return measured::yaw_and_roll(f).last;
    case Measure::INCANG: return measured::Segments<T>(f).angle();
    case Measure::INCANG_SQUARED: return measured::Segments<T>(f).squared_angle();
    case Measure::INCANG_COSINE: return measured::Segments<T>(f).cosine();
    case Measure::THETA_SQUARED: return measured::theta_squared(f);
    case Measure::PSI_PLUS_PHI: return measured::psi_with_phi(f, 1.0);
    case Measure::PSI_MINUS_PHI: return measured::psi_with_phi(f, -1.0);
    case Measure::YAW_PLUS_ROLL: return measured::yaw_with_roll(f, 1.0);
    case Measure::YAW_MINUS_ROLL: return measured::yaw_with_roll(f, -1.0);
    case Measure::UVX_X: case Measure::UVX_Y: case Measure::UVX_Z: case Measure::UVY_X: case Measure::UVY_Y:
    case Measure::UVY_Z: case Measure::UVZ_X: case Measure::UVZ_Y: case Measure::UVZ_Z: {
      const auto n = static_cast<std::size_t>(measure) - static_cast<std::size_t>(Measure::UVX_X);
      return measured::direction(f, n % 3 + 1, n / 3 + 1);
    }
  }
  // clang-format on
  return T(std::numeric_limits<double>::quiet_NaN());
}

template double evaluate_measure(Measure, const MeasureFrames<double>&);
template Dual<6> evaluate_measure(Measure, const MeasureFrames<Dual<6>>&);
template Dual<6, Dual<6>> evaluate_measure(Measure, const MeasureFrames<Dual<6, Dual<6>>>&);
template TimeTaylor<double> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<double>>&);
template TimeTaylor<Dual<6>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<6>>>&);
template TimeTaylor<Dual<12>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<12>>>&);
template TimeTaylor<Dual<18>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<18>>>&);
template TimeTaylor<Dual<6, Dual<6>>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<6, Dual<6>>>>&);

}  // namespace dynalin
