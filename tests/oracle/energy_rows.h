// What each force element works in a mode, by differences of the forces of the nonlinear model.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "oracle.h"

namespace dynalin::oracle {

// strain: forces follow displacements alone, with rates held; dissipation: velocities alone, with the pose held.
// Multipliers, accelerations and differential states with their rates are held in both; VARIABLEs, FUNCTION-valued
// forces and algebraic DIFFs are solved.
enum class Energy { strain, dissipation };

struct EnergyRow {
  std::string statement;
  int id = 0, marker = 0;  // marker: I, where the element has a row for each of its markers
  std::array<double, 6>
      along{};  // X Y Z of the force, RX RY RZ of the torque, global axes; of a FLEX_BODY its three modes
  std::array<double, 6> error{};  // of the differences
  bool shows_force = true, shows_torque = true;
  double without_cancellation = 0;  // size of the work if no motions cancelled
};

// −½ Re (δf · ū) with the motion u of I against the point of J's body where the reaction acts, and likewise for torque
// and rotation. `mode` holds the states, in the order given; of a velocity mode the rates alone count.
[[nodiscard]] std::vector<EnergyRow> energy_rows(const Mechanism& mechanism, const OraclePoint& point,
                                                 const std::vector<ChosenState>& states,
                                                 const std::vector<std::complex<double>>& mode, Energy energy);

}  // namespace dynalin::oracle
