#include "expression/measures.h"

#include <array>
#include <limits>

namespace dynalin {

namespace {

template <class T>
Vec3<T> differentiate(const Vec3<T>& v) {
  return {dynalin::differentiate(v.x), dynalin::differentiate(v.y), dynalin::differentiate(v.z)};
}

// ω = ½ Σ a × a′ over the axes a of the frame.
template <class T>
Vec3<T> angular_velocity(const Frame<T>& f) {
  Vec3<T> sum{};
  for (std::size_t c = 0; c < 3; ++c) sum += cross(f.axes[c], differentiate(f.axes[c]));
  return sum * 0.5;
}

// The norm, with gradient zero where it has none.
template <class T>
T magnitude(const Vec3<T>& v) {
  if (value_of(v.x) == 0.0 && value_of(v.y) == 0.0 && value_of(v.z) == 0.0) return T(0.0);
  return norm(v);
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

// Entry (row, column) of the matrix whose columns are the axes of i in the axes of j, counted from 1.
template <class T>
T direction(const MeasureFrames<T>& f, std::size_t row, std::size_t column) {
  return dot(f.j.axes[row - 1], f.i.axes[column - 1]);
}

// The angle at j between the segments to i and to k.
template <class T>
T included_angle(const MeasureFrames<T>& f) {
  const Vec3<T> a = f.i.origin - f.j.origin, b = f.k.origin - f.j.origin;
  return atan2(norm(cross(a, b)), dot(a, b));
}

}  // namespace

std::optional<Measure> find_measure(std::string_view name) {
  static constexpr std::array<std::string_view, 40> names = {
      "DX",     "DY",    "DZ",    "DM",    "VX",    "VY",    "VZ",    "VM",    "VR",    "WX",
      "WY",     "WZ",    "WM",    "ACCX",  "ACCY",  "ACCZ",  "ACCM",  "WDTX",  "WDTY",  "WDTZ",
      "WDTM",   "AX",    "AY",    "AZ",    "PSI",   "THETA", "PHI",   "YAW",   "PITCH", "ROLL",
      "INCANG", "UVX.X", "UVX.Y", "UVX.Z", "UVY.X", "UVY.Y", "UVY.Z", "UVZ.X", "UVZ.Y", "UVZ.Z"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k] == name) return static_cast<Measure>(k);
  }
  return std::nullopt;
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
    case Measure::DM: return magnitude(displacement(f));
    case Measure::VX: case Measure::VY: case Measure::VZ: return component(velocity(f), Measure::VX);
    case Measure::VM: return magnitude(velocity(f));
    case Measure::VR: return dynalin::differentiate(magnitude(displacement(f)));
    case Measure::WX: case Measure::WY: case Measure::WZ:
      return component(relative_angular_velocity(f), Measure::WX);
    case Measure::WM: return magnitude(relative_angular_velocity(f));
    case Measure::ACCX: case Measure::ACCY: case Measure::ACCZ: return component(acceleration(f), Measure::ACCX);
    case Measure::ACCM: return magnitude(acceleration(f));
    case Measure::WDTX: case Measure::WDTY: case Measure::WDTZ:
      return component(relative_angular_acceleration(f), Measure::WDTX);
    case Measure::WDTM: return magnitude(relative_angular_acceleration(f));
    case Measure::AX: return atan2(-direction(f, 2, 3), direction(f, 3, 3));
    case Measure::AY: return atan2(direction(f, 1, 3), direction(f, 3, 3));
    case Measure::AZ: return atan2(direction(f, 2, 1), direction(f, 1, 1));
    case Measure::PSI: return atan2(direction(f, 1, 3), -direction(f, 2, 3));
    case Measure::THETA: return acos(direction(f, 3, 3));
    case Measure::PHI: return atan2(direction(f, 3, 1), direction(f, 3, 2));
    case Measure::YAW: return atan2(direction(f, 2, 1), direction(f, 1, 1));
    case Measure::PITCH: return asin(direction(f, 3, 1));
    case Measure::ROLL: return atan2(direction(f, 3, 2), direction(f, 3, 3));
    case Measure::INCANG: return included_angle(f);
    case Measure::UVX_X: case Measure::UVX_Y: case Measure::UVX_Z: case Measure::UVY_X: case Measure::UVY_Y:
    case Measure::UVY_Z: case Measure::UVZ_X: case Measure::UVZ_Y: case Measure::UVZ_Z: {
      const auto n = static_cast<std::size_t>(measure) - static_cast<std::size_t>(Measure::UVX_X);
      return direction(f, n % 3 + 1, n / 3 + 1);
    }
  }
  // clang-format on
  return T(std::numeric_limits<double>::quiet_NaN());
}

template TimeTaylor<double> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<double>>&);
template TimeTaylor<Dual<6>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<6>>>&);
template TimeTaylor<Dual<12>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<12>>>&);
template TimeTaylor<Dual<18>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<18>>>&);
template TimeTaylor<Dual<6, Dual<6>>> evaluate_measure(Measure, const MeasureFrames<TimeTaylor<Dual<6, Dual<6>>>>&);

}  // namespace dynalin
