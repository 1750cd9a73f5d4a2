// The equations of motion of a System in time, in the form of Gear, Gupta and Leimkuhler (1985), stabilized index 2:
//
//     q′ = T(q) (u + S Φ_qᵀ μ),   R(q, u, u′, λ, w, z, z′) = 0,   Φ(q, t) = 0,   Φ_q u + Φ_t = 0,   Ψ(q, u, t) = 0
//
// with quaternions for the rotations of bodies, so that no orientation is singular; their length, which T keeps, has no
// meaning. μ vanishes but for the errors of the integration. S makes rotations and displacements comparable.
//
// The Jacobian comes from the partials that elements give. They are taken along paths (δq, δq′, δq″); with δθ the
// rotation of a body, δω and δα the variations of its angular velocity and acceleration, global axes,
//
//     δθ′ = δω + ω×δθ,   δθ″ = δα + α×δθ + ω×δθ′,   δθ = 2 G(p)ᵀ δp / |p|²,   p′ = ½ G(p) ω
//
// What μ does to it is left out: μ is as small as the errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/partials.h"
#include "simulation/dae_problem.h"
#include "simulation/error_tolerance.h"
#include "simulation/events.h"
#include "simulation/explicit_values.h"
#include "simulation/motion_unknowns.h"

namespace dynalin {

class MotionEquations final : public DaeProblem {
 public:
  // Rows that are not `active` are left out. Mode, memory and histories are those of the point.
  MotionEquations(const System&, Events&, const OperatingPoint&, std::vector<bool> active, const ErrorTolerance&);

  const Motion& motion() const { return motion_; }  // where it was evaluated last
  const MotionUnknowns& unknowns() const { return unknowns_; }
  const std::vector<bool>& active() const { return active_; }
  double fastest() const { return fastest_; }  // of what was accepted: radians or lengths of the model, per time
  // Takes over what an accepted point remembers, and how large its velocities and states are.
  void accept(const OperatingPoint&);

  std::size_t size() const override { return unknowns_.size(); }
  bool residual(double t, std::span<const double> y, std::span<const double> yp, std::span<double> r) override;
  const ColumnMatrix* jacobian(double t, double c, std::span<const double> y, std::span<const double> yp) override;
  void weights(double step, std::span<const double> y, std::span<double> weight) const override;
  void terms(std::span<const double> y, std::span<const double> yp, std::span<double> size) const override;
  std::span<const double> differential() const override { return differential_; }
  std::size_t switch_count() const override { return events_.size(); }
  void switches(double t, std::span<const double> y, std::span<const double> yp, std::span<double> values) override;

  bool looks_ahead() const override { return system_.looks_ahead(); }
  double part_to_make(const Instant& from, const Instant& to) override;

  // Whether zeros of switches end steps; they do at first. Those of sensors always do.
  void watch_switches(bool watched) { switches_watched_ = watched; }

  // What has no finite value, of the last residual that had none; empty before.
  const std::string& undefined() const { return undefined_; }

  // How far the rows that are left out are from being met, in their scales.
  double left_out_violation(const OperatingPoint&);

 private:
  using Vector6 = std::array<double, 6>;

  void evaluate(double t, std::span<const double> y, std::span<const double> yp, Partials wanted);
  void kinematic_residual(std::span<const double> y, std::span<const double> yp, std::span<double> r) const;
  void kinematic_partials(double c, std::span<const double> y);
  void row_partials(std::span<const double> y);
  void balance_partials(double c, std::span<const double> y);
  void find_differential();
  bool holds(std::int32_t equation_row) const;
  // δθ of a body by its quaternion, three rows of four.
  struct Chart {
    std::array<std::array<double, 4>, 3> rotation;  // δθ = rotation δp
    Matrix3 w, z;                                   // [ω×], [α×] + [ω×][ω×]
  };
  void make_charts(std::span<const double> y);
  // Where a coordinate stands: its body, and which of its coordinates it is.
  struct Place {
    std::int32_t body = -1;  // −1 outside bodies
    std::int32_t component = 0;
  };
  // Adds the row of partials by δq of a coordinate and by δq′ at constant velocity, in terms of positions.
  void add_position(std::int32_t row, std::int32_t coordinate, double on_position, double on_rate,
                    double on_acceleration);
  double metric(std::int32_t coordinate) const {
    const double s = system_.coordinate_scale(coordinate);
    return s * s;
  }

  const System& system_;
  Events& events_;
  MotionUnknowns unknowns_;
  std::vector<bool> active_;
  ErrorTolerance tolerance_;
  Motion motion_, ahead_;                         // ahead_: where a step is expected to lead
  std::shared_ptr<const DelayHistories> delays_;  // that the motion reads
  ExpressionScratch scratch_;
  ConstraintRows rows_;
  Equations eq_;
  Accumulator jacobian_;
  std::vector<Place> places_;
  std::vector<Chart> charts_;  // by body
  std::vector<double> differential_;
  std::optional<ExplicitValues> between_;  // that sensors may read in between two points, where there are any
  bool switches_watched_ = true;
  std::string undefined_;
  mutable std::vector<double> rates_;  // of coordinates, scratch
  double fastest_ = 0;                 // rotation or way in lengths of the model, per time
  std::vector<double> largest_state_;  // so far
  double dilution_ = 1;                // weights against those unknowns that no error is asked of
};

}  // namespace dynalin
