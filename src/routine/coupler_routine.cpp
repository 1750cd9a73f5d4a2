// The routines of a COUPLER: what it holds at zero, and its first and second derivatives by displacements.
#include <algorithm>
#include <array>

#include "routine/call_routine.h"
#include "routine/given_inputs.h"
#include "routine/routine_memory.h"

namespace dynalin {

void CompiledRoutine::call_coupler(RoutineArgumentsNow now, const FoundRoutine& routine, double* values) const {
  const RoutineContext& c = *RoutineContext::current();
  std::array<double, most_given_to_coupler> displacements{};
  if (c.phase != RoutineContext::Phase::asking) {
    std::ranges::copy(c.inputs.subspan(first_given), displacements.begin());
  }
  now.given = displacements.data();
  call_routine(routine, *kind_, statement_, now, values);
}

bool CompiledRoutine::depends_on_time(std::span<const double> inputs) const {
  std::vector<double> at(inputs.begin(), inputs.end());
  std::array<double, 1> here{}, later{};
  evaluate(at, here, {}, {});
  for (const double step : {1.0, -0.37}) {
    at[0] = inputs[0] + step;
    evaluate(at, later, {}, {});
    if (here != later) return true;
  }
  return false;
}

// With the slopes f_k and the second derivatives H: f′ = Σ f_k q_k′, f″ = Σ f_k q_k″ + q′ᵀ H q′, f_k′ = Σ H_kl q_l′. Of
// f_k″ the part with third derivatives is not known where something moves.
void CompiledRoutine::fill_course_of_coupler(CourseMemory& m) const {
  const std::size_t n = m.inputs.size() / 3, count = n - first_given;
  std::vector<double> at(n), slopes(count, unknown_value), curvatures(count * count, unknown_value);
  for (std::size_t k = 0; k < n; ++k) at[k] = m.inputs[3 * k];
  double value = unknown_value;
  evaluate(at, {&value, 1}, {}, {});
  const std::string failure = at_inputs(at, [&] {
    call_coupler({at[0], 0, 0, 1}, state_partials_.first, slopes.data());
    call_coupler({at[0], 0, 0, 1}, state_partials_.second, curvatures.data());
  });
  if (!failure.empty()) value = unknown_value;
  if (failure.empty() && at[1] == linear_mode) doubt_coupler(at, slopes, curvatures, m.findings);
  const auto rate = [&](std::size_t k) { return m.inputs[3 * (first_given + k) + 1]; };
  const auto acceleration = [&](std::size_t k) { return m.inputs[3 * (first_given + k) + 2]; };
  Taylor& f = m.values[0];
  const double by_time = m.inputs[1] != 0.0 && depends_on_time(at) ? unknown_value : 0.0;
  f = {value, by_time, by_time};
  bool moves = false;
  for (std::size_t k = 0; k < count; ++k) {
    Taylor slope(slopes[k]);
    for (std::size_t l = 0; l < count; ++l) {
      const double h = curvatures[k + count * l];
      slope.rate += h * rate(l), slope.acceleration += h * acceleration(l);
    }
    moves = moves || rate(k) != 0.0;
    f.rate += slope.value * rate(k);
    f.acceleration += slope.value * acceleration(k) + slope.rate * rate(k);
    m.partials[first_given + k] = slope;
  }
  if (!moves) return;
  for (std::size_t k = 0; k < count; ++k) m.partials[first_given + k].acceleration = unknown_value;
}

}  // namespace dynalin
