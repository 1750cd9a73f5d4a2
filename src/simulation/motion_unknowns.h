// Where the unknowns of a motion in time stand among those of the integrator, and its equations, which are as many:
//
//     q    positions: r of every body, p its unit quaternion, coordinates outside bodies     q′ = T(q) (u + S Φ_qᵀ μ)
//     u    velocities: v and ω along the global axes, rates of the others                    balance of forces
//     λ    a multiplier for each constraint row                                              Φ′ = 0, velocity rows Ψ =
//     0 μ    one for each row on positions                                                     Φ = 0 w    algebraic
//     values                                                                  w = f z    differential states z′ = f
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "system/system.h"

namespace dynalin {

using Quaternion = std::array<double, 4>;  // of any length but zero; the scalar first

Quaternion quaternion_of(const Matrix3& rotation);
Matrix3 rotation_of(const Quaternion&);

class MotionUnknowns {
 public:
  explicit MotionUnknowns(const System&);

  std::size_t size() const { return size_; }
  // The first of the three of a body's origin, behind which its quaternion stands if it turns.
  std::int32_t position(std::size_t body) const { return position_[body]; }
  std::int32_t quaternion(std::size_t body) const { return position_[body] + 3; }
  std::int32_t extra(std::size_t k) const { return extra_ + static_cast<std::int32_t>(k); }
  std::int32_t velocity(std::int32_t coordinate) const { return velocity_ + coordinate; }
  std::int32_t lambda(std::int32_t row) const { return lambda_ + row; }
  // −1 for a row on velocities.
  std::int32_t mu(std::int32_t row) const { return mu_[static_cast<std::size_t>(row)]; }
  std::int32_t algebraic(std::int32_t k) const { return algebraic_ + k; }
  std::int32_t state(std::int32_t k) const { return state_ + k; }
  // Where row r of Equations (balance, algebraic, differential) stands.
  std::int32_t equation(std::int32_t r) const { return r < n_ ? velocity_ + r : r - n_ + algebraic_; }

  // A point as values and rates; multipliers of drift are zero.
  void pack(const OperatingPoint&, std::span<double> y, std::span<double> yp) const;
  // The other way round; what the unknowns do not hold stays as it is.
  void unpack(double t, std::span<const double> y, std::span<const double> yp, OperatingPoint&) const;
  void unpack(double t, std::span<const double> y, std::span<const double> yp, Motion&) const;
  // "DX of PART/3", "VARIABLE/2"
  std::string text(std::int64_t unknown) const;

 private:
  const System& system_;
  std::int32_t n_, extra_ = 0, velocity_ = 0, lambda_ = 0, algebraic_ = 0, state_ = 0;
  std::vector<std::int32_t> position_, mu_;
  std::size_t size_ = 0;
};

}  // namespace dynalin
