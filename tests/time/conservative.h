// Mechanisms that lose no energy, with a second way to their motion: closed forms, or equations of motion derived by
// hand in fewest coordinates and integrated by Boost.Odeint. VARIABLE/1 … are what the second way tells as well;
// VARIABLE/90 is the energy.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace dynalin::in_time {

struct Conservative {
  std::string name, dataset;
  double period = 1;       // of something that comes back [time]
  double energy_unit = 1;  // that of the motion, by which a change of energy counts
  // Values of VARIABLE/1 … at times that ascend from 0.
  std::function<std::vector<std::vector<double>>(const std::vector<double>& times)> truth;
};

Conservative pendulum();
Conservative tumbling_body();
Conservative heavy_top();
Conservative spatial_four_bar();
Conservative slider_crank();
Conservative gyroscope();

std::vector<Conservative> all_conservative();

}  // namespace dynalin::in_time
