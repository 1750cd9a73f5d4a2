// The law of dry friction in joints by its equations, for one, two or three directions of slip: what the program's
// motion is compared with.
#pragma once

#include <cmath>
#include <cstddef>

#include "time/reference_integration.h"

namespace dynalin::in_time {

struct DryFriction {
  double mu_static = 0.5, mu_dynamic = 0.3, stiction_velocity = 0.01, deformation = 1e-4;
  double ratio = 1.5;  // of the slip at which sliding begins to that at which stiction ends

  double coefficient(const Values& slip) const {
    const double v = size(slip) / stiction_velocity;
    return v <= 1       ? mu_static
           : v >= ratio ? mu_dynamic
                        : mu_static + (mu_dynamic - mu_static) * step((v - 1) / (ratio - 1));
  }
  // Of size 1 at most, along what friction acts against.
  Values direction(const Values& slip, const Values& creep) const {
    const Values b = odd(slip, stiction_velocity), sigma = odd(creep, deformation);
    const double fast = size(b), elastic = size(sigma);
    Values s(slip.size());
    for (std::size_t k = 0; k < s.size(); ++k)
      s[k] = sigma[k] * (1 - fast * fast) + b[k] * fast + b[k] * (1 - fast) * (1 - elastic * elastic);
    return s;
  }
  Values creep_rate(const Values& slip, const Values& creep) const {
    double outwards = 0;
    for (std::size_t k = 0; k < slip.size(); ++k) outwards += slip[k] * creep[k];
    const double bent = size(creep), left = bent / deformation;
    Values rate = slip;
    if (outwards <= 0 || left < 0.9) return rate;
    const double share = left < 1 ? step(10 * (left - 0.9)) : 1;
    for (std::size_t k = 0; k < rate.size(); ++k) rate[k] -= share * outwards * creep[k] / (bent * bent);
    return rate;
  }
  static double size(const Values& v) {
    double square = 0;
    for (const double x : v) square += x * x;
    return std::sqrt(square);
  }

 private:
  static double step(double x) { return x * x * (3 - 2 * x); }
  static Values odd(Values v, double full) {
    const double x = size(v) / full;
    for (double& c : v) c = x < 1 ? c / full * (3 - x * x) / 2 : c / (x * full);
    return v;
  }
};

}  // namespace dynalin::in_time
