// Ordinary differential equations x′ = f(t, x) integrated by the explicit methods of Boost.Odeint, which share nothing
// with the integrator of the program.
#pragma once

#include <boost/numeric/odeint.hpp>
#include <vector>

namespace dynalin::in_time {

using Values = std::vector<double>;

// x at times that ascend from that of `start`. Steps estimate their errors by derivatives that bends in the rate do not
// have: where there are some, none should be longer than the time from bend to bend.
template <class F>
std::vector<Values> integrated(F rate, Values start, const std::vector<double>& times, double longest_step = 0) {
  namespace odeint = boost::numeric::odeint;
  constexpr double tolerance = 1e-13, first_step = 1e-4;
  std::vector<Values> values;
  const auto system = [&](const Values& x, Values& xp, double t) { xp = rate(t, x); };
  const auto stepper =
      odeint::make_controlled(tolerance, tolerance, longest_step, odeint::runge_kutta_fehlberg78<Values>());
  odeint::integrate_times(stepper, system, start, times.begin(), times.end(), first_step,
                          [&](const Values& x, double) { values.push_back(x); });
  return values;
}

}  // namespace dynalin::in_time
