// GSE/id, NO=, Y= [, NS=, X= [, IC=]] [, U=] [, ND=, XD= [, ICD=] [, SAMPLE_PERIOD=] [, SAMPLE_OFFSET=]]
//         [, IMPLICIT] [, STATIC_HOLD] [, STATICS_ONLY], FUNCTION=USER(…) [, INTERFACE= | ROUTINE=]
//
// State equations of compiled routines (include/dynalin/user_routine.h):
//
//     x′ = f(x, xd, u, t)       gse_deriv, with IMPLICIT f(x, x′, xd, u, t) = 0
//     y  = g(x, xd, u, t)       gse_output
//     xd = what gse_update gave at the last sample
//
// or x′ and y of gsesub. Samples are taken at SAMPLE_OFFSET and then after every SAMPLE_PERIOD, or as gse_samp says. A
// static solution looks for x′ = 0; with STATIC_HOLD it keeps x, and always xd. With STATICS_ONLY x and y keep what the
// last static solution gave them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "elements/controls/array.h"
#include "elements/families/state_equations.h"
#include "model/model.h"
#include "model/schema.h"
#include "model/told_beforehand.h"
#include "routine/state_equations.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

constexpr double most_numbers = 10000;  // of one kind

constexpr std::array<std::string_view, 2> schedule_arguments = {"SAMPLE_PERIOD", "SAMPLE_OFFSET"};

struct Gse {
  std::optional<std::int64_t> outputs, states, discrete;
  ArrayRef x, y, u, initial, xd, initial_discrete;
  Expression period, function;
  double offset = 0;
  bool implicit = false, static_hold = false, statics_only = false;
  std::shared_ptr<const StateEquations> routines;
  Span initial_at, initial_discrete_at;
  std::vector<double> x0, xd0;  // filled when all ARRAYs are known

  using E = Gse;
  static constexpr std::array<Argument<E>, 15> arguments = {{
      {.name = "NO",
       .slot = &E::outputs,
       .required = true,
       .minimum = 0,
       .help = "number of outputs",
       .maximum = most_numbers},
      {.name = "Y", .slot = &E::y, .help = "ARRAY of type Y for the outputs"},
      {.name = "NS", .slot = &E::states, .minimum = 0, .help = "number of states", .maximum = most_numbers},
      {.name = "X", .slot = &E::x, .help = "ARRAY of type X for the states"},
      {.name = "IC", .slot = &E::initial, .help = "ARRAY with the initial states", .start = StatedStart::value},
      {.name = "U", .slot = &E::u, .help = "ARRAY of type U with the inputs"},
      {.name = "ND", .slot = &E::discrete, .minimum = 0, .help = "number of discrete states", .maximum = most_numbers},
      {.name = "XD", .slot = &E::xd, .help = "ARRAY of type X for the discrete states"},
      {.name = "ICD",
       .slot = &E::initial_discrete,
       .help = "ARRAY with the initial discrete states",
       .start = StatedStart::value},
      {.name = schedule_arguments[0],
       .slot = &E::period,
       .unit = "time",
       .help = "from one sample to the next",
       .start = StatedStart::alone},
      {.name = schedule_arguments[1],
       .slot = &E::offset,
       .unit = "time",
       .help = "of the first sample",
       .start = StatedStart::alone},
      {.name = "IMPLICIT", .slot = &E::implicit, .help = "the routine gives what is zero"},
      {.name = "STATIC_HOLD", .slot = &E::static_hold, .help = "states keep their values in statics"},
      {.name = "STATICS_ONLY", .slot = &E::statics_only, .help = "states and outputs keep theirs but in statics"},
      {.name = "FUNCTION", .slot = &E::function, .required = true, .help = "USER(…): calls its routines"},
  }};

  std::size_t state_count() const { return static_cast<std::size_t>(states.value_or(0)); }
  std::size_t discrete_count() const { return static_cast<std::size_t>(discrete.value_or(0)); }
  std::size_t output_count() const { return static_cast<std::size_t>(outputs.value_or(0)); }
};

class GseSet final : public TypedSet<Gse> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    Gse& e = elements[k];
    const bool readable = read_arguments(e, reader);
    const std::string name = reader.label().text();
    const auto goes_with = [&](std::string_view count, bool counted, std::string_view array,
                               std::initializer_list<std::string_view> others) {
      if (counted && !reader.given(array))
        reader.error("missing-argument", reader.at(count), fmt::format("{} of {} needs {}", count, name, array));
      if (counted) return;
      for (const std::string_view other : others) {
        if (!reader.given(other)) continue;
        reader.error("unexpected-argument", reader.at(other), fmt::format("{} of {} needs {}", other, name, count));
      }
    };
    goes_with("NS", e.state_count() > 0, "X", {"X", "IC"});
    goes_with("NO", e.output_count() > 0, "Y", {"Y"});
    goes_with("ND", e.discrete_count() > 0, "XD", {"XD", "ICD", "SAMPLE_PERIOD", "SAMPLE_OFFSET"});
    if (!readable) return;
    e.routines = StateEquations::of(e.function);
    if (!e.routines) {
      reader.error("unknown-word", reader.at("FUNCTION"),
                   fmt::format("FUNCTION of {} is USER(…), the call of compiled routines, and no expression", name));
    }
    if (reader.given("SAMPLE_PERIOD") && e.period.is_constant()) {
      ExpressionWorkspace<double> workspace;
      const double period = e.period.evaluate<double>({}, workspace);
      if (!(period > 0)) {
        reader.error("value-out-of-range", reader.at("SAMPLE_PERIOD"),
                     fmt::format("SAMPLE_PERIOD of {} must be positive, it is {:g}", name, period));
      }
    }
    e.initial_at = reader.at("IC"), e.initial_discrete_at = reader.at("ICD");
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) complete(k, model, diagnostics);
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    std::vector<StateEquationsLaw> laws;
    for (const Gse& e : elements) {
      const StateEquations& r = *e.routines;
      laws.push_back(
          {.derivatives = r.derivatives,
           .outputs = r.outputs,
           .initial = e.x0,
           .sampling = {r.update, e.xd0, r.period.value_or(e.period), e.offset, r.update_name, r.period_name},
           .implicit = e.implicit,
           .held_in_statics = e.static_hold,
           .in_statics_only = e.statics_only,
           .schedule_arguments = schedule_arguments});
    }
    return std::make_unique<StateEquationsKernel>(std::move(laws), labels, StateType::gse, layout);
  }

 private:
  void complete(std::size_t k, Model& model, Diagnostics& diagnostics) {
    Gse& e = elements[k];
    if (e.u.valid()) input_array(model, e.u, labels[k], diagnostics);
    const auto take = [&](ArrayRef ref, std::string_view argument, const Span& at, std::size_t size,
                          std::vector<double>& numbers) {
      if (!ref.valid()) return;
      const Array& ic = *model.get<Array>(ref);
      if (ic.u || ic.x || ic.y || ic.numbers.size() != size) {
        diagnostics.error("wrong-size", at,
                          fmt::format("{} of {} must hold {} numbers", argument, labels[k].text(), size));
      } else {
        numbers = ic.numbers;
      }
    };
    take(e.initial, "IC", e.initial_at, e.state_count(), e.x0);
    take(e.initial_discrete, "ICD", e.initial_discrete_at, e.discrete_count(), e.xd0);
    const ElementHandle self = *model.find("GSE", labels[k].id);
    const auto claim = [&](ArrayRef ref, const OwnedEntries& entries) {
      if (ref.valid()) claim_array(model, ref, entries, self, labels[k], diagnostics);
    };
    claim(e.x, {'X', e.state_count()});
    claim(e.xd, {'X', e.discrete_count(), "XD", e.state_count()});
    claim(e.y, {'Y', e.output_count()});
  }
};

constexpr RoutineKind interface_of_gse(std::string_view routine) {
  return {.routine = routine, .values = 0, .arguments = RoutineArguments::counted, .names_routine = "INTERFACE"};
}
constexpr RoutineKind sampled(RoutineKind kind) {
  kind.sampled = true;
  return kind;
}
// In the order of StateRoutine.
constexpr std::array<RoutineKind, 5> gse_routines = {
    interface_of_gse("gse_deriv"), interface_of_gse("gse_output"), sampled(interface_of_gse("gse_update")),
    RoutineKind{.routine = "gse_samp", .values = 1, .arguments = RoutineArguments::plain, .names_routine = "INTERFACE"},
    RoutineKind{.routine = "gsesub", .values = 0, .arguments = RoutineArguments::system}};

}  // namespace

namespace {

std::optional<std::size_t> count_in_gse(const StatementWords& s, std::string_view argument) {
  return static_cast<std::size_t>(std::max(s.integer(argument), 0));
}
std::vector<FilledList> filled_by_gse(const StatementWords& s) {
  return {{ArrayClass::statement, s.integer("X"), count_in_gse(s, "NS")},
          {ArrayClass::statement, s.integer("XD"), count_in_gse(s, "ND"), true},
          {ArrayClass::statement, s.integer("Y"), count_in_gse(s, "NO")}};
}
constexpr ToldBeforehand told_of_gse = {.size = [](const StatementWords& s) { return count_in_gse(s, "NS"); },
                                        .fills = filled_by_gse};

}  // namespace

extern constinit const Kind gse =
    Kind{"GSE",
         "",
         "State equations of compiled routines, continuous and sampled.",
         Kind::Role::element,
         detail::argument_infos<Gse>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<GseSet>(kind); }}
        .calling(gse_routines)
        .telling(told_of_gse)
        .with_example("GSE/1, STATIC_HOLD");

}  // namespace dynalin
