// The linear model as forces along the chosen coordinates: mass, damping and stiffness of the mechanism and of its
// elements.
#pragma once

#include <vector>

#include "dynalin/element_id.h"
#include "dynalin/matrix.h"
#include "dynalin/results.h"

namespace dynalin {

// What rows of results take of the variations. [rows × accelerations, rates, coordinates, states, inputs]
struct MotionMap {
  DenseMatrix of_accelerations, of_rates, of_coordinates, of_states, of_inputs;

  MotionMap& operator+=(const MotionMap&);
};

//     Q   = M x″ + C x′ + K x + Z z − P u        x the chosen coordinates, z differential states, u inputs
//     z′  = …,   y = …                           in the same five variations
//
// Q has to act along the coordinates to give them the motion; free motion is Q = 0. Symmetric where the forces are.
struct PhysicalMatrices {
  std::vector<StateLabel> coordinates;  // x
  std::vector<std::size_t> with_rate;   // those with x′ and x″: the rest follows from velocity constraints
  std::vector<StateLabel> states;       // z
  std::vector<ChannelLabel> inputs, outputs;
  MotionMap force;       // Q, one row for each x′: M, C, K, Z and −P
  MotionMap rate;        // x′ of all coordinates
  MotionMap state_rate;  // z′
  MotionMap output;      // y
};

// What one element contributes to Q; all of them add up to the whole.
struct ElementMatrices {
  ElementId element;
  MotionMap force;
};

}  // namespace dynalin
