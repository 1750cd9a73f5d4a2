// Everything that is known of a mechanism at one instant, as plain values: where its parts are, how they move, what its
// constraints and forces exert, and what its VARIABLEs and states hold. Units of the dataset, angles in radians;
// vectors along the global axes unless something else is said.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dynalin/element_id.h"

namespace dynalin {

using Triple = std::array<double, 3>;

// A PART, POINT_MASS or FLEX_BODY, or a node of an FE_PART. Position and motion are those of the origin of its body
// coordinate system (BCS).
struct BodyState {
  std::string name;               // "PART/2", or with its view name "PART/2 (wheel)"; "FE_PART/3 node 1"
  ElementId element;              // PART/2
  std::int64_t node = 0;          // of an FE_PART, 0 for all others
  std::string view_name;          // "wheel", empty if it has none
  bool turns = true;              // false of a POINT_MASS, which has no angles
  Triple position{};              // [length]
  std::array<Triple, 3> axes{};   // its x, y and z axis
  Triple angles{};                // ψ, θ, φ of the body-fixed 3-1-3 sequence, REULER [rad]; zero for a POINT_MASS
  Triple velocity{};              // [length/time]
  Triple angular_velocity{};      // [rad/time]
  Triple acceleration{};          // [length/time²]
  Triple angular_acceleration{};  // [rad/time²]
  // Of the mass centre.
  Triple centre_position{}, centre_velocity{}, centre_acceleration{};
};

// A force and a torque that an element exerts on the body of its marker I, at the origin of I; the opposite acts at the
// same point on the body of J.
struct Load {
  ElementId element;      // JOINT/3
  std::string variant;    // "REVOLUTE", empty if the statement has one kind only
  std::string view_name;  // empty if it has none
  std::int64_t marker_I = 0, marker_J = 0;
  Triple force{}, torque{};  // [force], [force·length]
  // The same along the axes of a marker: RM of VFORCE, VTORQUE and GFORCE, J of everything else; 0 stands for the
  // global frame, which takes the place of floating markers.
  std::int64_t axes = 0;
  Triple force_in_axes{}, torque_in_axes{};
};

// One equation of a constraint. The reaction is the multiplier times the gradient of the row.
struct ConstraintValue {
  ElementId element;  // JOINT/3
  std::string row;    // "Zi.Xj"
  double multiplier = 0;
  bool redundant = false;  // follows from others: it is left out, and its multiplier is zero
};

struct VariableValue {
  std::int64_t id = 0;
  std::string view_name;
  double value = 0;
};

// A differential state: of DIFF, LSE, GSE, TFSISO …
struct StateValue {
  ElementId element;  // LSE/4
  std::string view_name;
  int number = 1;              // among the states of the element
  double value = 0, rate = 0;  // [unit of the state, which its equation gives it], [that/time]
};

// A coordinate beside the poses of bodies: a parameter of a curve at a point of contact, a modal coordinate.
struct ParameterValue {
  ElementId element;  // PTCV/1
  std::string name;
  double value = 0, rate = 0;  // [of the curve's parameter; 1 of a modal coordinate], [that/time]
};

// PINPUT and POUTPUT: the values of their VARIABLEs.
struct ChannelValues {
  ElementId element;  // PINPUT/1
  std::string view_name;
  std::vector<double> values;
};

struct OperatingState {
  double time = 0;
  std::vector<BodyState> bodies;             // without the ground, in the order of the dataset
  std::vector<Load> reactions;               // of constraints that act on markers
  std::vector<Load> forces;                  // of force elements; one for each marker where an element acts on several
  std::vector<ConstraintValue> constraints;  // every row of every constraint; GCON, COUPLER and GEAR have nothing else
  std::vector<VariableValue> variables;
  std::vector<StateValue> states;
  std::vector<ParameterValue> parameters;
  std::vector<ChannelValues> plant_inputs, plant_outputs;
};

// Whether a small disturbance of an equilibrium grows, by the eigenvalues of its linear model.
struct Stability {
  enum class Verdict { stable, unstable, unknown } verdict = Verdict::unknown;
  int growing_modes = 0;
  std::string reason;  // why it is not known
  // "nothing grows", "unstable: 2 modes grow", "stability not known: …"
  std::string text() const;
};

// What a static analysis found, the solution itself: at rest.
struct StaticResult {
  int iterations = 0;
  double imbalance = 0;  // largest unbalanced force [force], or moment by the length of the model
  Stability stability;
  OperatingState at_rest;
};

}  // namespace dynalin
