#include "routine/curve_routine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "routine/differences.h"
#include "routine/guarded_values.h"
#include "routine/routine_context.h"
#include "routine/routine_findings.h"
#include "routine/routine_memory.h"
#include "routine/utilities.h"

namespace dynalin {

namespace {

constexpr Vec3<double> nowhere = {unknown_value, unknown_value, unknown_value};

std::uint64_t next_curve() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

bool is_known(const Vec3<double>& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Runs `calls` in a context that has nothing of a model; says what went wrong.
template <class Calls>
std::string outside_of_model(const std::string& what, Calls&& calls) {
  static const RoutineRequests nothing;
  static constexpr std::array<double, 2> time_and_mode{};
  RoutineContext c;
  c.requests = &nothing, c.inputs = time_and_mode, c.values = 3;
  {
    const RoutineContext::Scope scope(c, what.c_str());
    try {
      calls(c);
    } catch (...) {
      c.fail(caught_exception());
    }
  }
  return c.failure;
}

}  // namespace

struct CurveRoutine::Memory {
  std::uint64_t serial = 0;
  double u = 0;
  std::array<std::optional<Vec3<double>>, highest_order + 1> known;
  std::string failure;
};

CurveRoutine::CurveRoutine(FoundRoutine found, CurveStatement statement, RoutineDifferences differences)
    : found_(std::move(found)), statement_(std::move(statement)), differences_(differences), serial_(next_curve()) {
  keep_utilities();
  what_ = fmt::format("{}, called for {}", name(), statement_.element.text());
}

std::string CurveRoutine::name() const {
  return fmt::format("the routine {} of {}", found_.name, found_.library->file());
}

CurveRoutine::Memory& CurveRoutine::remembered(double u) const {
  thread_local Memory memory;
  if (memory.serial != serial_ || memory.u != u) memory = {serial_, u, {}, {}};
  return memory;
}

std::string CurveRoutine::call(double u, int order, Vec3<double>& out) const {
  out = nowhere;
  thread_local std::vector<double> memory;
  GuardedValues values(memory, 3);
  std::ranges::fill(values.own(), unknown_value);
  const CurveStatement& s = statement_;
  const int npar = s.parameters.count(), iflag = 0;
  const double* par = s.parameters.data();
  const std::string failure = outside_of_model(what_, [&](RoutineContext& c) {
    if (found_.convention == RoutineConvention::addresses) {
      using Signature = void(const int*, const double*, const int*, const double*, const int*, const int*, double*);
      reinterpret_cast<Signature*>(found_.address)(&s.id, par, &npar, &u, &order, &iflag, values.data());
    } else {
      using Signature = void(const sAdamsCurve*, double, int, int, double*);
      const sAdamsCurve curve = {s.id, npar, par, s.closed, s.order, s.first, s.last};
      reinterpret_cast<Signature*>(found_.address)(&curve, u, order, iflag, values.data());
    }
    if (values.are_exceeded()) c.fail(fmt::format("it writes more than the three values of {}", s.element.text()));
  });
  const std::span<const double> own = values.own();
  if (failure.empty()) out = {own[0], own[1], own[2]};
  return failure;
}

// Along u + t the partial derivatives by the parameter have the second and the third one as their rates.
std::string CurveRoutine::call_entry(double u, Memory& m) const {
  constexpr std::size_t inputs = 3, of_parameter = 2, stride = 3;
  std::array<double, inputs * stride> input{};
  input[stride * of_parameter] = u, input[stride * of_parameter + 1] = 1;
  std::array<double, 3 * stride> value;
  std::array<double, 3 * stride * inputs> partial;
  value.fill(unknown_value), partial.fill(unknown_value);
  const CurveStatement& s = statement_;
  const dynalin_course course = {s.id, s.parameters.count(), s.parameters.data(), inputs,        3,
                                 2,    input.data(),         value.data(),        partial.data()};
  const std::string failure = outside_of_model(what_, [&](RoutineContext&) { found_.derivatives(&course); });
  for (std::size_t order = 0; order < m.known.size(); ++order) {
    Vec3<double> c = nowhere;
    for (std::size_t v = 0; v < 3 && failure.empty(); ++v)
      c[v] = order == 0 ? value[stride * v] : partial[stride * (inputs * v + of_parameter) + order - 1];
    m.known[order] = c;
  }
  return failure;
}

Vec3<double> CurveRoutine::derivative(double u, int order) const {
  RoutineFindings* findings = RoutineFindings::current();
  const bool linear = findings && findings->of_linear_model;
  const bool differenced = order == highest_order && !found_.derivatives;
  if (differenced && linear && differences_ != RoutineDifferences::everywhere) return nowhere;
  if (differenced && linear) findings->differenced = true;
  Memory& m = remembered(u);
  std::optional<Vec3<double>>& known = m.known[static_cast<std::size_t>(order)];
  if (known) return *known;
  if (found_.derivatives) {
    m.failure = call_entry(u, m);
  } else if (!differenced) {
    known.emplace();
    if (std::string failure = call(u, order, *known); m.failure.empty()) m.failure = std::move(failure);
  } else {
    Vec3<double> second;
    const auto at = [&](double x, std::span<double> values) {
      call(x, 2, second);
      for (std::size_t k = 0; k < 3; ++k) values[k] = second[k];
    };
    const std::vector<Slope> slope = extrapolated_slope(at, u, 3);
    known = nowhere;
    for (std::size_t k = 0; k < 3; ++k) (*known)[k] = slope[k].agreed ? slope[k].value : unknown_value;
  }
  if (linear && findings->curves.insert(serial_).second) {
    if (std::string wrong = wrong_derivative(u); !wrong.empty()) findings->wrong_partials.insert(std::move(wrong));
  }
  return *remembered(u).known[static_cast<std::size_t>(order)];
}

std::string CurveRoutine::wrong_derivative(double u) const {
  Vec3<double> c;
  const auto lower_orders = [&](double x, std::span<double> values) {
    for (int order = 0; order < 2; ++order) {
      call(x, order, c);
      for (std::size_t k = 0; k < 3; ++k) values[3 * static_cast<std::size_t>(order) + k] = c[k];
    }
  };
  const std::vector<Slope> slope = extrapolated_slope(lower_orders, u, 6);
  for (int order = 1; order < 3; ++order) {
    Vec3<double> given = derivative(u, order);
    for (std::size_t k = 0; k < 3; ++k) {
      const Slope& found = slope[3 * static_cast<std::size_t>(order - 1) + k];
      if (!contradicts(found, given[k])) continue;
      return fmt::format("{} gives {:.6g} as derivative {} of {} at the parameter {:.6g}, and {} changes by {:.6g}",
                         what_, given[k], order, "xyz"[k], u, order == 1 ? "its value" : "derivative 1", found.value);
    }
  }
  return {};
}

std::string CurveRoutine::reason_of_value(double u) const {
  for (int order = 0; order < 3; ++order) {
    if (is_known(derivative(u, order))) continue;
    const std::string& failure = remembered(u).failure;
    return fmt::format("{} has no value at the parameter {:.6g}: {}", name(), u,
                       failure.empty() ? fmt::format("with IORD {} it gives no finite numbers", order) : failure);
  }
  return {};
}

std::string CurveRoutine::reason_of_derivatives(double u) const {
  if (std::string reason = reason_of_value(u); !reason.empty()) return reason;
  if (found_.derivatives || differences_ == RoutineDifferences::everywhere)
    return fmt::format("three derivatives of {} are known, and a linear model of what moves here needs a fourth one",
                       name());
  return fmt::format(
      "{} gives two derivatives, and a linear model needs a third one here: an entry with it, or "
      "--difference-user-routines",
      name());
}

}  // namespace dynalin
