#include "routine/compiled_routine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "routine/call_routine.h"
#include "routine/given_inputs.h"
#include "routine/routine_memory.h"
#include "routine/utilities.h"

namespace dynalin {

namespace {

std::uint64_t next_serial() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

Atom atom_without_ids(std::string_view name) {
  Atom atom;
  atom.function = find_atom_function(name);
  return atom;
}

// Arguments that its interface has and nobody here can say.
std::string_view what_is_not_known(RoutineArguments arguments) {
  if (arguments == RoutineArguments::pressure) return "; GAPDOTDOT and AREA are not known here, and no numbers";
  if (arguments == RoutineArguments::friction) return "; X and AREA are not known here, and no numbers";
  return "";
}

std::string_view way_to_derivatives(RoutineArguments arguments) {
  switch (arguments) {
    case RoutineArguments::field:
      return "all of dfddis and dfdvel, an entry with them, or --difference-user-routines";
    case RoutineArguments::pressure:
    case RoutineArguments::friction:
      return "an entry with them, or --difference-user-routines";
    default:
      return "c_syspar, an entry with them, or --difference-user-routines";
  }
}

}  // namespace

CompiledRoutine::CompiledRoutine(FoundRoutine found, const RoutineKind& kind, std::size_t values,
                                 RoutineStatement statement, RoutineDifferences differences, const SizeOfList& size_of,
                                 StatePartialRoutines state_partials)
    : found_(std::move(found)),
      kind_(&kind),
      values_(values),
      statement_(std::move(statement)),
      differences_(differences),
      state_partials_(std::move(state_partials)),
      size_of_(size_of),
      serial_(next_serial()) {
  keep_utilities();
  what_ = fmt::format("{}, called for {}", name(), statement_.element.text());
  requests_.inputs = {atom_without_ids("TIME"), atom_without_ids(knows_mode() ? "MODE" : "TIME")};
  const std::vector<Atom> given_to_it = given_inputs(kind, statement_);
  requests_.inputs.insert(requests_.inputs.end(), given_to_it.begin(), given_to_it.end());
  std::vector<double> ignored(values_);
  // Routines that pass over one of the first two ask when they are called for a value.
  for (const int iflag : {1, 3, 0}) {
    RoutineContext asking = context(RoutineContext::Phase::asking);
    asking.asked = &requests_;
    asking.size_of = &size_of_;
    // What comes as arguments it need not ask for.
    if (kind.arguments == RoutineArguments::system) {
      for (const int array : {statement_.gse->X, statement_.gse->U}) {
        if (array != 0) asking.request("ARRAY", {&array, 1}, Quantity::list);
      }
    }
    {
      const RoutineContext::Scope scope(asking, what_.c_str());
      try {
        call(0, 0, iflag, ignored.data());
      } catch (...) {
        asking.fail(caught_exception() + " when it was asked what it reads");
      }
    }
    if (problem_.empty()) problem_ = asking.failure;
  }
  size_of_ = nullptr;
  const AtomFunction* entry = find_atom_function("ARYVAL");
  for (std::size_t k = 0; k < requests_.inputs.size() && statement_.constant_arrays; ++k) {
    const Atom& input = requests_.inputs[k];
    if (input.function == entry && std::ranges::binary_search(*statement_.constant_arrays, input.argument[0]))
      constants_.push_back(static_cast<std::int32_t>(k));
  }
  if (!given_to_it.empty() && problem_.empty() && !requests_.list.empty()) {
    problem_ = fmt::format(
        "it asks for {}({}); the force of a {} is a function of {} that its routine gets, and of time",
        requests_.list.front().name, fmt::join(requests_.list.front().ids, ", "), statement_.element.statement,
        kind.arguments == RoutineArguments::field ? "the displacement and the velocity" : "the arguments");
  }
  if (kind.arguments == RoutineArguments::coupler && !found_.derivatives && problem_.empty() &&
      !(state_partials_.first && state_partials_.second)) {
    problem_ =
        "a COUPLER needs the first and second partial derivatives of what it holds at zero: the routines couxx and "
        "couxx2 beside it, or an entry with them";
  }
  if (found_.derivatives != nullptr || kind.arguments == RoutineArguments::of_time) gives_derivatives_ = true;
  if (gives_derivatives_ || !problem_.empty()) return;
  // A trial at zero: what counts is whether it gives them, not what they are there.
  std::vector<double> at_zero(requests_.inputs.size()), partials(values_ * at_zero.size());
  std::vector<char> given(at_zero.size());
  std::string miscount;
  evaluate(at_zero, ignored, partials, given, &miscount);
  const auto missing = std::find(given.begin() + 2, given.end(), 0);
  gives_derivatives_ = missing == given.end();
  if (gives_derivatives_) return;
  lack_of_derivatives_ = miscount.empty() ? "gives no derivatives" : miscount;
  if (!miscount.empty()) return;
  const auto told = std::count_if(given.begin() + 2, given.end(), [](char g) { return g != 0; });
  if (told > static_cast<std::ptrdiff_t>(constants_.size()))
    lack_of_derivatives_ = "gives no derivative by " + input_text(static_cast<std::size_t>(missing - given.begin()));
  const std::vector<std::string_view> absent = absent_partials();
  if (!absent.empty()) lack_of_derivatives_ += fmt::format(" and has no {} beside it", fmt::join(absent, ", "));
}

std::vector<std::string_view> CompiledRoutine::absent_partials() const {
  std::vector<std::string_view> absent;
  if (kind_->arguments != RoutineArguments::system) return absent;
  const sAdamsGSE& gse = *statement_.gse;
  const auto look = [&](const FoundRoutine& routine, int of, int by, std::string_view name) {
    if (of > 0 && by > 0 && !routine) absent.push_back(name);
  };
  look(state_partials_.of_x_by_x, gse.NS, gse.NS, "gsexx"), look(state_partials_.of_x_by_u, gse.NS, gse.NI, "gsexu");
  look(state_partials_.of_y_by_x, gse.NO, gse.NS, "gseyx"), look(state_partials_.of_y_by_u, gse.NO, gse.NI, "gseyu");
  return absent;
}

std::string CompiledRoutine::name() const {
  return fmt::format("the routine {} of {}", found_.name, found_.library->file());
}

RoutineContext CompiledRoutine::context(RoutineContext::Phase phase) const {
  RoutineContext c;
  c.phase = phase;
  c.requests = &requests_;
  c.values = differentiated();
  c.gse = statement_.gse.get();
  c.data = statement_.data.get();
  return c;
}

std::string CompiledRoutine::evaluate(std::span<const double> inputs, std::span<double> values,
                                      std::span<double> partials, std::span<char> given, std::string* miscount) const {
  RoutineContext c = context(RoutineContext::Phase::evaluating);
  c.inputs = inputs;
  c.partials = partials;
  c.given = given;
  // Whoever makes a table for a REQUEST may leave some of its columns out.
  const bool is_table = kind_->arguments == RoutineArguments::plain && values_ > 1;
  std::fill(values.begin(), values.end(), is_table ? 0.0 : unknown_value);
  const bool derivatives = !partials.empty() && kind_->arguments != RoutineArguments::of_time;
  at_work(c, [&] {
    call(inputs[0], derivatives ? 1 : 0, 0, values.data());
    if (derivatives && kind_->arguments == RoutineArguments::system) call_partials(inputs[0], partials, given);
    if (derivatives && kind_->arguments == RoutineArguments::coupler && state_partials_.first) {
      std::fill(partials.begin() + first_given, partials.end(), unknown_value);
      call_coupler({inputs[0], 0, 0, 1}, state_partials_.first, partials.data() + first_given);
      std::fill(given.begin() + first_given, given.end(), true);
    }
  });
  if (!given.empty()) {
    for (const std::int32_t k : constants_) given[static_cast<std::size_t>(k)] = true;
  }
  if (miscount) *miscount = c.miscount;
  if (!c.failure.empty()) std::fill(values.begin(), values.end(), unknown_value);
  return c.failure;
}

std::string CompiledRoutine::evaluate_course(std::span<const double> inputs, int order, std::span<double> values,
                                             std::span<double> partials) const {
  RoutineContext c = context(RoutineContext::Phase::evaluating);
  // A routine that asks c_sysfnc here as well gets the values.
  thread_local std::vector<double> plain;
  const auto stride = static_cast<std::size_t>(order) + 1;
  plain.clear();
  for (std::size_t k = 0; k < inputs.size(); k += stride) plain.push_back(inputs[k]);
  c.inputs = plain;
  std::fill(values.begin(), values.end(), unknown_value);
  std::fill(partials.begin(), partials.end(), unknown_value);
  const dynalin_course course = {statement_.id,
                                 statement_.constants->count(),
                                 statement_.constants->data(),
                                 static_cast<int>(requests_.inputs.size()),
                                 static_cast<int>(differentiated()),
                                 order,
                                 inputs.data(),
                                 values.data(),
                                 partials.data()};
  std::string failure = at_work(c, [&] { found_.derivatives(&course); });
  if (order > 0 || differentiated() == values_ || !failure.empty()) return failure;
  std::vector<double> all(values_);
  failure = evaluate(std::vector<double>(plain), all, {}, {});
  std::copy(all.begin() + static_cast<std::ptrdiff_t>(differentiated()), all.end(),
            values.begin() + static_cast<std::ptrdiff_t>(differentiated()));
  std::fill(partials.begin() + static_cast<std::ptrdiff_t>(differentiated() * plain.size()), partials.end(), 0.0);
  return failure;
}

const CompiledRoutine::Memory& CompiledRoutine::remembered(const RoutineInputs<double>& read, Partials wanted) const {
  thread_local Memory memory;
  thread_local std::vector<double> inputs;
  inputs.clear();
  for (std::size_t k = 0; k < read.size(); ++k) inputs.push_back(read[k]);
  if (!knows_mode()) inputs[1] = 0;
  const bool same = memory.serial == serial_ && same_bits(memory.inputs, inputs);
  if (same && (memory.has_partials || wanted == Partials::no)) return memory;
  memory.serial = serial_;
  memory.has_partials = wanted == Partials::yes;
  memory.findings = {};
  memory.inputs = inputs;
  memory.values.resize(values_);
  if (wanted == Partials::no) {
    evaluate(memory.inputs, memory.values, {}, {});
    return memory;
  }
  const std::size_t n = memory.inputs.size();
  memory.partials.assign(values_ * n, 0.0);
  memory.given.assign(n, false);
  if (found_.derivatives) {
    if (!evaluate_course(memory.inputs, 0, memory.values, memory.partials).empty())
      std::fill(memory.values.begin(), memory.values.end(), unknown_value);
    for (std::size_t v = 0; v < values_; ++v) memory.partials[v * n + 1] = 0.0;  // nothing depends on MODE smoothly
    memory.given.assign(n, true);
    doubt_given(memory);
    return memory;
  }
  evaluate(memory.inputs, memory.values, memory.partials, memory.given);
  doubt_given(memory);
  // No equation has an unknown for time: what is not said of it is not asked for.
  for (std::size_t k = 2; k < n; ++k) {
    if (memory.given[k]) continue;
    if (may_difference(memory.inputs[1])) {
      difference(k, memory);
    } else {
      for (std::size_t v = 0; v < values_; ++v) memory.partials[v * n + k] = unknown_value;
    }
  }
  return memory;
}

double CompiledRoutine::value(const RoutineInputs<double>& inputs, std::size_t which) const {
  return remembered(inputs, Partials::no).values[which];
}

std::span<const double> CompiledRoutine::partials(const RoutineInputs<double>& inputs, std::size_t which) const {
  const Memory& memory = remembered(inputs, Partials::yes);
  RoutineFindings* findings = RoutineFindings::current();
  if (findings && memory.inputs[1] == linear_mode) findings->add(memory.findings);
  return std::span(memory.partials).subspan(which * inputs.size(), inputs.size());
}

void CompiledRoutine::fill_course(CourseMemory& m) const {
  const std::size_t n = m.inputs.size() / 3;
  std::vector<double> values, partials;
  if (found_.derivatives) {
    values.resize(3 * values_), partials.resize(3 * values_ * n);
    evaluate_course(m.inputs, 2, values, partials);
    for (std::size_t v = 0; v < values_; ++v) m.values[v] = {values[3 * v], values[3 * v + 1], values[3 * v + 2]};
    for (std::size_t k = 0; k < m.partials.size(); ++k)
      m.partials[k] = {partials[3 * k], partials[3 * k + 1], partials[3 * k + 2]};
    for (std::size_t v = 0; v < values_; ++v) m.partials[v * n + 1] = Taylor(0.0);
    return;
  }
  if (kind_->arguments == RoutineArguments::coupler) return fill_course_of_coupler(m);
  if (kind_->arguments == RoutineArguments::of_time && n == 2) {
    std::array<double, 3> course{};
    const std::array<double, 2> at = {m.inputs[0], m.inputs[3]};
    course.fill(unknown_value);
    const bool failed = !at_inputs(at, [&] {
                           for (int order = 0; order < 3; ++order)
                             call(at[0], order, 0, &course[static_cast<std::size_t>(order)]);
                         }).empty();
    if (RoutineFindings* findings = RoutineFindings::current(); findings && !failed)
      doubt_motion(at[0], course, *findings);
    m.values[0] = failed ? Taylor(unknown_value) : Taylor(course[0], course[1], course[2]);
    return;
  }
  // Values and what the chain rule makes of first derivatives; of second ones nothing is known.
  std::vector<double> at(n);
  std::vector<char> given(n, false);
  for (std::size_t k = 0; k < n; ++k) at[k] = m.inputs[3 * k];
  values.resize(values_), partials.assign(values_ * n, 0.0);
  evaluate(at, values, partials, given);
  for (std::size_t v = 0; v < values_; ++v) {
    double rate = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const bool still = k == 1 || m.inputs[3 * k + 1] == 0.0;
      const double p = k == 1 ? 0.0 : given[k] ? partials[v * n + k] : unknown_value;
      m.partials[v * n + k] = k == 1 ? Taylor(0.0) : Taylor(p, unknown_value, unknown_value);
      if (!still) rate += p * m.inputs[3 * k + 1];
    }
    m.values[v] = {values[v], rate, unknown_value};
  }
}

const CompiledRoutine::CourseMemory& CompiledRoutine::remembered(const RoutineInputs<Taylor>& read) const {
  thread_local CourseMemory memory;
  thread_local std::vector<double> inputs;
  inputs.clear();
  for (std::size_t k = 0; k < read.size(); ++k)
    inputs.insert(inputs.end(), {read[k].value, read[k].rate, read[k].acceleration});
  if (!knows_mode()) std::fill_n(inputs.begin() + 3, 3, 0.0);
  if (memory.serial == serial_ && same_bits(memory.inputs, inputs)) return memory;
  memory.serial = serial_;
  memory.inputs = inputs;
  memory.findings = {};
  memory.values.assign(values_, Taylor(unknown_value));
  memory.partials.assign(values_ * read.size(), Taylor(0.0));
  fill_course(memory);
  return memory;
}

TimeTaylor<double> CompiledRoutine::value(const RoutineInputs<Taylor>& inputs, std::size_t which) const {
  return remembered(inputs).values[which];
}

std::span<const TimeTaylor<double>> CompiledRoutine::partials(const RoutineInputs<Taylor>& inputs,
                                                              std::size_t which) const {
  const CourseMemory& memory = remembered(inputs);
  RoutineFindings* findings = RoutineFindings::current();
  if (findings && memory.inputs[3] == linear_mode) findings->add(memory.findings);
  return std::span(memory.partials).subspan(which * inputs.size(), inputs.size());
}

std::string CompiledRoutine::reason_of_value(std::span<const double> inputs) const {
  std::vector<double> values(values_);
  std::string reason = evaluate(inputs, values, {}, {});
  if (reason.empty()) reason = fmt::format("its value is no finite number{}", what_is_not_known(kind_->arguments));
  return fmt::format("{} has no value at TIME {:g}: {}", name(), inputs[0], reason);
}

std::string CompiledRoutine::reason_of_partials(std::span<const double> inputs) const {
  if (kind_->arguments == RoutineArguments::coupler && !found_.derivatives) {
    return fmt::format("{} gives no third derivatives, and a linear model of what moves needs them: an entry with them",
                       name());
  }
  if (gives_derivatives_) return fmt::format("{} gives no finite derivatives at TIME {:g}", name(), inputs[0]);
  if (differences_ == RoutineDifferences::everywhere) {
    return fmt::format(
        "{} {}, and differences of its values do not agree at TIME {:g}: it jumps here, or remembers how it was called",
        name(), lack_of_derivatives_, inputs[0]);
  }
  return fmt::format("{} {}, and a linear model needs them: {}", name(), lack_of_derivatives_,
                     way_to_derivatives(kind_->arguments));
}

}  // namespace dynalin
