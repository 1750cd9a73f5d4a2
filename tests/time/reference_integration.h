// Ordinary differential equations x′ = f(t, x) integrated by the explicit methods of Boost.Odeint, which share nothing
// with the integrator of the program.
#pragma once

#include <boost/numeric/odeint.hpp>
#include <vector>

namespace dynalin::in_time {

using Values = std::vector<double>;

// x at times that ascend from that of `start`.
template <class F>
std::vector<Values> integrated(F rate, Values start, const std::vector<double>& times) {
  namespace odeint = boost::numeric::odeint;
  constexpr double tolerance = 1e-13, first_step = 1e-4;
  std::vector<Values> values;
  const auto system = [&](const Values& x, Values& xp, double t) { xp = rate(t, x); };
  odeint::integrate_times(odeint::make_controlled<odeint::runge_kutta_fehlberg78<Values>>(tolerance, tolerance), system,
                          start, times.begin(), times.end(), first_step,
                          [&](const Values& x, double) { values.push_back(x); });
  return values;
}

}  // namespace dynalin::in_time
