// Differences of compiled routines: in the place of derivatives that they do not give, and beside those that they do.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "routine/differences.h"
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
  constexpr double unlike = 1e-3;
  const std::size_t n = memory.inputs.size();
  for (std::size_t k = 2; k < n; ++k) {
    if (!memory.given[k] || std::ranges::binary_search(constants_, static_cast<std::int32_t>(k))) continue;
    const std::vector<Slope> slope = slopes(memory.inputs, k);
    for (std::size_t v = 0; v < values_; ++v) {
      const double given = memory.partials[v * n + k], size = std::max(std::abs(given), std::abs(slope[v].value));
      const double off = std::abs(given - slope[v].value);
      if (!slope[v].agreed || !(off > unlike * size + 4 * slope[v].error + slope[v].unseen)) continue;
      if (slope[v].half_kink != 0 && off <= 1.01 * std::abs(slope[v].half_kink)) continue;  // one side, or between both
      memory.findings.wrong_partials.insert(
          fmt::format("{} gives {:.6g} as its derivative by {}, and its values change by {:.6g}", what_, given,
                      input_text(k), slope[v].value));
    }
  }
}

std::string CompiledRoutine::input_text(std::size_t input) const {
  const Atom& by = requests_.inputs[input];
  return fmt::format("{}({})", by.function->name, fmt::join(std::span(by.argument).first(by.argument_count), ", "));
}

}  // namespace dynalin
