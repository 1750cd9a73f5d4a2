// The nonlinear mechanism evaluated in extended precision, and its state matrices by extrapolated central
// differences.
//
// Coordinates. r_n(t), R_n(t) is the nominal motion of a body through the operating point, with its true
// first and second derivatives there. The perturbed motion is r = r_n + y_r, R = exp(y_theta^) R_n with y in
// global axes; r is the origin of the BCS. A state is a component of y or of y', the change of a measured displacement
// or of its rate (PSTATE), or a differential state. For given states and inputs the position, velocity and acceleration
// levels are each solved by Newton; nothing is linearized by hand. Velocity constraints take rates and no coordinates.
//
// Angles are principal values at the operating point: a point that has turned through more than half a turn
// since time 0 is outside the oracle's reach when a rotational spring or an angle measure sees that turn.
#pragma once

#include <vector>

#include "mechanism.h"

namespace dynalin::oracle {

using Matrix = std::vector<std::vector<double>>;

enum class ElementClass { lse = 2, tfsiso = 3, gse = 4, diff = 5, friction = 102 };  // the type codes of STATES

struct ChosenState {
  enum class Kind { coordinate, rate, differential };
  Kind kind = Kind::coordinate;
  int body_id = 0;
  BodyKind body_kind = BodyKind::part;
  int coordinate = 0;  // 0..5: x y z rx ry rz, global axes
  ElementClass element = ElementClass::diff;
  int element_id = 0;
  int index = 1;     // 1-based within the element
  int variable = 0;  // of PSTATE: the coordinate is the value of this VARIABLE, a displacement or angle
};

struct BodyPoint {
  int body_id = 0;
  BodyKind body_kind = BodyKind::part;
  Triple position{};                      // of the BCS
  std::array<Triple, 3> rotation{};       // rows of R: components in BCS to components in global
  Triple velocity{}, angular_velocity{};  // of the BCS, global axes
};
struct DifferentialPoint {
  ElementClass element = ElementClass::diff;
  int element_id = 0, index = 1;
  double value = 0;
};
// Every moving body and every differential state must be present, in any order.
struct OraclePoint {
  double time = 0;
  std::vector<BodyPoint> bodies;
  std::vector<DifferentialPoint> z;
};

struct BodyAcceleration {
  int body_id = 0;
  BodyKind body_kind = BodyKind::part;
  Triple acceleration{}, angular_acceleration{};  // of the BCS, global axes
};

struct OracleLinearModel {
  Matrix A, B, C, D;
  Matrix A_error, B_error, C_error, D_error;  // absolute estimate per entry
  double error_estimate = 0;                  // largest over the four, each relative to its largest entry or 1
  std::vector<double> outputs, inputs;        // at the operating point
  std::vector<BodyAcceleration> accelerations;
  std::vector<double> differential_rates;  // in the order of OraclePoint::z as drawn_point writes it
  double polish = 0;  // largest change that put the given point on the constraints, relative to the model
};

// Precondition: the states are a valid set (coordinates complement the position constraints, rates those and the
// velocity constraints, so that there may be fewer rates; every differential state once). Throws std::runtime_error
// when a level cannot be solved, when the point is off the constraints by more than 1e-9, or when the set is not valid.
// Inputs of PINPUT are cut from their own expressions; clear Mechanism::pinput for the matrices of EIGENSOL.
[[nodiscard]] OracleLinearModel oracle_linearize(const Mechanism& mechanism, const OraclePoint& point,
                                                 const std::vector<ChosenState>& states);

// The point that the dataset describes at time 0. Velocities that are not stated are the smallest that
// satisfy the constraints.
[[nodiscard]] OraclePoint drawn_point(const Mechanism& mechanism);

// A well-conditioned set of states at the drawn point: rate, where it is free, and coordinate of each, then
// differential states in the order LSE, GSE, TFSISO, DIFF, FRICTION.
[[nodiscard]] std::vector<ChosenState> choose_states(const Mechanism& mechanism, const OraclePoint& point);

}  // namespace dynalin::oracle
