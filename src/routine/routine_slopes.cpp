// Differences of compiled routines: in the place of derivatives that they do not give, and beside those that they do.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "routine/call_routine.h"
#include "routine/differences.h"
#include "routine/given_inputs.h"
#include "routine/routine_memory.h"

namespace dynalin {

bool CompiledRoutine::may_difference(double mode) const {
  return differences_ == RoutineDifferences::everywhere || mode != linear_mode;
}

// Of all values at once.
std::vector<Slope> CompiledRoutine::slopes(std::span<const double> inputs, std::size_t input) const {
  std::vector<double> moved(inputs.begin(), inputs.end());
  const auto at = [&](double x, std::span<double> values) {
    moved[input] = x;
    evaluate(moved, values, {}, {});
  };
  return extrapolated_slope(at, inputs[input], values_);
}

void CompiledRoutine::difference(std::size_t input, Memory& memory) const {
  const std::vector<Slope> slope = slopes(memory.inputs, input);
  memory.findings.differenced = true;
  for (std::size_t v = 0; v < values_; ++v) {
    // An iteration may go by what is not quite a derivative, a linear model may not.
    const bool taken = slope[v].agreed || memory.inputs[1] != linear_mode;
    memory.partials[v * memory.inputs.size() + input] = taken ? slope[v].value : unknown_value;
    if (slope[v].half_kink == 0) continue;
    memory.findings.kinks.insert(
        fmt::format("{} has a kink here: by {} its slope is {:.6g} on one side and {:.6g} on the other", what_,
                    input_text(input), slope[v].value - slope[v].half_kink, slope[v].value + slope[v].half_kink));
  }
}

// A wrong derivative has eigenvalues with narrow bounds like a right one: what differences contradict is said.
void CompiledRoutine::doubt_given(Memory& memory) const {
  if (!found_ || memory.inputs[1] != linear_mode) return;
  const std::size_t n = memory.inputs.size();
  // A value near 0 may be what is left of large ones.
  std::vector<double> greatest(values_);
  for (std::size_t v = 0; v < values_; ++v) {
    for (std::size_t k = 2; k < n; ++k) {
      if (const double change = change_by(memory.partials[v * n + k], memory.inputs[k]); change > greatest[v])
        greatest[v] = change;
    }
  }
  for (std::size_t k = 2; k < n; ++k) {
    if (!memory.given[k] || std::ranges::binary_search(constants_, static_cast<std::int32_t>(k))) continue;
    const std::vector<Slope> slope = slopes(memory.inputs, k);
    for (std::size_t v = 0; v < values_; ++v) {
      const double given = memory.partials[v * n + k];
      if (!contradicts(slope[v], given, memory.inputs[k], greatest[v])) continue;
      memory.findings.wrong_partials.insert(
          fmt::format("{} gives {:.6g} as its derivative by {}, and its values change by {:.6g}", what_, given,
                      input_text(k), slope[v].value));
    }
  }
}

void CompiledRoutine::doubt_coupler(std::span<const double> inputs, std::span<const double> first,
                                    std::span<const double> second, RoutineFindings& findings) const {
  const auto said = [&](const char* which, double given, const std::string& by, const char* what, double found) {
    findings.wrong_partials.insert(
        fmt::format("{} has {:.6g} as {} by {}, and {} changes by {:.6g}", what_, given, which, by, what, found));
  };
  const auto displacement = [](std::size_t k) { return fmt::format("displacement {}", k + 1); };
  double greatest = 0;
  for (std::size_t k = 0; k < first.size(); ++k)
    greatest = std::max(greatest, change_by(first[k], inputs[first_given + k]));
  for (std::size_t k = 0; k < first.size(); ++k) {
    const Slope slope = slopes(inputs, first_given + k).front();
    if (contradicts(slope, first[k], inputs[first_given + k], greatest))
      said("its derivative", first[k], displacement(k), "its value", slope.value);
    std::vector<double> moved(inputs.begin(), inputs.end());
    const auto gradient = [&](double x, std::span<double> values) {
      moved[first_given + k] = x;
      std::ranges::fill(values, unknown_value);
      at_inputs(moved, [&] { call_coupler({moved[0], 0, 0, 1}, state_partials_.first, values.data()); });
    };
    const std::vector<Slope> of_gradient = extrapolated_slope(gradient, inputs[first_given + k], first.size());
    for (std::size_t l = 0; l < first.size(); ++l) {
      const double given = second[l + first.size() * k];
      if (contradicts(of_gradient[l], given))
        said("its second derivative", given, displacement(l) + " and " + displacement(k), "the first one",
             of_gradient[l].value);
    }
  }
}

void CompiledRoutine::doubt_motion(double time, std::span<const double> course, RoutineFindings& findings) const {
  const auto [found, fresh] = findings.motions.try_emplace(serial_, RoutineFindings::Times{time, time});
  RoutineFindings::Times& times = found->second;
  if (!fresh && !(time > times.next)) return;
  times.next = times.first + 1.5 * (time - times.first);
  const auto lower_orders = [&](double t, std::span<double> values) {
    std::ranges::fill(values, unknown_value);
    const std::array<double, 2> at = {t, 0};
    at_inputs(at, [&] {
      for (int order = 0; order < 2; ++order) call(t, order, 0, &values[static_cast<std::size_t>(order)]);
    });
  };
  const std::vector<Slope> slope = extrapolated_slope(lower_orders, time, 2);
  for (std::size_t order = 1; order < 3; ++order) {
    if (!contradicts(slope[order - 1], course[order])) continue;
    findings.wrong_partials.insert(
        fmt::format("{} gives {:.6g} as derivative {} at TIME {:.6g}, and {} changes by {:.6g}", what_, course[order],
                    order, time, order == 1 ? "its value" : "derivative 1", slope[order - 1].value));
    times.next = std::numeric_limits<double>::infinity();  // once is enough
    return;
  }
}

std::string CompiledRoutine::input_text(std::size_t input) const {
  const Atom& by = requests_.inputs[input];
  return fmt::format("{}({})", by.function->name, fmt::join(std::span(by.argument).first(by.argument_count), ", "));
}

}  // namespace dynalin
