// What a routine is given as arguments at this moment, by the kind of its statement.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "routine/call_routine.h"
#include "routine/compiled_routine.h"
#include "routine/given_inputs.h"
#include "routine/guarded_values.h"
#include "routine/routine_memory.h"

namespace dynalin {

namespace {

constexpr std::size_t inputs_of_field = 12;

// The ARRAY of states or inputs of a GSE among what its routine reads, and its values at this moment.
struct ReadArray {
  const RoutineRequest* request = nullptr;
  std::vector<double> values;
};
ReadArray read_array(const RoutineContext& c, int array, int size) {
  ReadArray out;
  out.values.assign(static_cast<std::size_t>(size), 0.0);
  out.request = array == 0 ? nullptr : c.known("ARRAY", {&array, 1}, Quantity::list);
  if (!out.request || c.phase == RoutineContext::Phase::asking) return out;
  for (std::size_t k = 0; k < out.values.size(); ++k)
    out.values[k] = c.inputs[static_cast<std::size_t>(out.request->inputs[k])];
  return out;
}

}  // namespace

void CompiledRoutine::call(double time, int flag, int iflag, double* values) const {
  thread_local std::vector<double> memory;
  GuardedValues guarded(memory, values_);
  std::copy_n(values, values_, guarded.data());
  call_with_arguments(time, flag, iflag, guarded.data());
  std::ranges::copy(guarded.own(), values);
  if (guarded.are_exceeded()) {
    RoutineContext::current()->fail(
        fmt::format("it writes {} values, and {} has {}", guarded.written(), statement_.element.text(), values_));
  }
}

void CompiledRoutine::call_with_arguments(double time, int flag, int iflag, double* values) const {
  RoutineArgumentsNow now{time, flag, iflag, static_cast<int>(values_)};
  if (kind_->arguments == RoutineArguments::field) return call_field(now, values);
  if (kind_->arguments == RoutineArguments::coupler) return call_coupler(now, found_, values);
  if (kind_->arguments == RoutineArguments::pressure || kind_->arguments == RoutineArguments::friction)
    return call_contact(now, values);
  if (kind_->arguments == RoutineArguments::modal) return call_modal(now, values);
  if (kind_->arguments != RoutineArguments::system) return call_routine(found_, *kind_, statement_, now, values);
  const sAdamsGSE& gse = *statement_.gse;
  const RoutineContext& c = *RoutineContext::current();
  const ReadArray states = read_array(c, gse.X, gse.NS), inputs = read_array(c, gse.U, gse.NI);
  now.states = states.values, now.inputs = inputs.values;
  call_routine(found_, *kind_, statement_, now, values);
}

void CompiledRoutine::call_contact(RoutineArgumentsNow now, double* values) const {
  const RoutineContext& c = *RoutineContext::current();
  std::array<double, std::max(given_to_pressure, given_to_friction)> given{};
  if (c.phase != RoutineContext::Phase::asking) std::ranges::copy(c.inputs.subspan(first_given), given.begin());
  now.given = given.data();
  call_routine(found_, *kind_, statement_, now, values);
}

// A load of its own counts where no load case is named. Those of FORCE have neither case nor scale.
void CompiledRoutine::call_modal(RoutineArgumentsNow now, double* values) const {
  const RoutineStatement::ModalLoad& m = *statement_.modal;
  double scale = unknown_value;
  int number = 0;
  now.scale = &scale, now.load_case = &number;
  call_routine(found_, *kind_, statement_, now, m.scaled ? values + 1 : values);
  if (!m.scaled) return;
  values[0] = scale;
  RoutineContext& c = *RoutineContext::current();
  if (number == 0 || c.phase == RoutineContext::Phase::asking) return;
  if (number < 0 || static_cast<std::size_t>(number) > m.cases)
    return c.fail(fmt::format("it takes modal load {}, and FLEX_BODY/{} has {}", number, m.body, m.cases));
  const std::size_t count = 6 + m.modes;
  std::copy_n(m.loads.begin() + static_cast<std::ptrdiff_t>(count * (static_cast<std::size_t>(number) - 1)), count,
              values + 1);
}

// A column of derivatives counts if all of it is written.
void CompiledRoutine::call_field(RoutineArgumentsNow now, double* values) const {
  RoutineContext& c = *RoutineContext::current();
  std::array<double, inputs_of_field> arguments{};
  if (c.phase != RoutineContext::Phase::asking) {
    std::ranges::copy(c.inputs.subspan(first_given, inputs_of_field), arguments.begin());
  }
  std::array<double, 72> partials{};
  partials.fill(unknown_value);
  now.displacement = arguments.data(), now.velocity = &arguments[6];
  now.by_displacement = partials.data(), now.by_velocity = &partials[36];
  call_routine(found_, *kind_, statement_, now, values);
  if (!c.wants_partials()) return;
  for (std::size_t k = 0; k < inputs_of_field; ++k) {
    const auto column = std::span(partials).subspan(6 * k, 6);
    if (!std::ranges::all_of(column, [](double p) { return std::isfinite(p); })) continue;
    for (std::size_t v = 0; v < 6; ++v) c.partials[v * c.inputs.size() + first_given + k] = column[v];
    c.given[first_given + k] = true;
  }
}

void CompiledRoutine::call_partials(double time, std::span<double> partials, std::span<char> given) const {
  const sAdamsGSE& gse = *statement_.gse;
  const RoutineContext& c = *RoutineContext::current();
  const ReadArray states = read_array(c, gse.X, gse.NS), inputs = read_array(c, gse.U, gse.NI);
  const RoutineArgumentsNow now{time, 1, 0, static_cast<int>(values_), states.values, inputs.values};
  const auto take = [&](const ReadArray& by, const FoundRoutine& of_x, const FoundRoutine& of_y) {
    const bool whole = (of_x || gse.NS == 0) && (of_y || gse.NO == 0);
    if (!by.request || !whole) return;
    const std::size_t inputs_in_all = requests_.inputs.size();
    const auto place = [&](const FoundRoutine& routine, int first, int rows) {
      const auto count = static_cast<std::size_t>(rows);
      std::vector<double> matrix(count * by.values.size(), unknown_value);
      if (matrix.empty()) return;
      call_state_partials(routine, statement_, now, matrix.data());
      for (std::size_t k = 0; k < matrix.size(); ++k) {
        const std::size_t value = static_cast<std::size_t>(first) + k % count;
        partials[value * inputs_in_all + static_cast<std::size_t>(by.request->inputs[k / count])] += matrix[k];
      }
    };
    place(of_x, 0, gse.NS), place(of_y, gse.NS, gse.NO);
    for (const std::int32_t k : by.request->inputs) given[static_cast<std::size_t>(k)] = true;
  };
  take(states, state_partials_.of_x_by_x, state_partials_.of_y_by_x);
  take(inputs, state_partials_.of_x_by_u, state_partials_.of_y_by_u);
}

}  // namespace dynalin
