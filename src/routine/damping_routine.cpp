#include "routine/damping_routine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "routine/routine_context.h"
#include "routine/utilities.h"

namespace dynalin {

DampingRoutine::DampingRoutine(FoundRoutine found, const ElementId& of, int id, const RoutineConstants& parameters)
    : found_(std::move(found)), id_(id), parameters_(parameters) {
  keep_utilities();
  what_ = fmt::format("the routine {} of {}, called for {}", found_.name, found_.library->file(), of.text());
}

std::string DampingRoutine::ratios(std::span<const double> frequencies, std::span<double> out) const {
  std::string problem = call(0, 0, frequencies, out);
  if (!problem.empty()) return problem;
  std::vector<double> later(out.size());
  problem = call(1, 1e-3, frequencies, later);
  if (problem.empty() && !std::ranges::equal(out, later))
    problem =
        "it gives other ratios at another time or for another step, and the damping of a flexible body is constant";
  return problem;
}

std::string DampingRoutine::call(double time, double step, std::span<const double> frequencies,
                                 std::span<double> out) const {
  static const RoutineRequests nothing;
  const std::array<double, 2> time_and_mode = {time, 0};
  RoutineContext c;
  c.requests = &nothing, c.inputs = time_and_mode, c.values = out.size();
  const int npar = parameters_.count(), modes = static_cast<int>(out.size());
  const double* par = parameters_.data();
  {
    const RoutineContext::Scope scope(c, what_.c_str());
    try {
      if (found_.convention == RoutineConvention::addresses) {
        using Signature = void(const int*, const double*, const double*, const int*, const double*, const int*,
                               const double*, double*);
        reinterpret_cast<Signature*>(found_.address)(&id_, &time, par, &npar, frequencies.data(), &modes, &step,
                                                     out.data());
      } else {
        using Signature = void(const sAdamsCratio*, double, const double*, int, double, double*);
        const sAdamsCratio statement = {{id_}, npar, par};
        reinterpret_cast<Signature*>(found_.address)(&statement, time, frequencies.data(), modes, step, out.data());
      }
    } catch (...) {
      c.fail(caught_exception());
    }
  }
  return c.failure;
}

}  // namespace dynalin
