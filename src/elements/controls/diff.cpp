// DIFF/id, FUNCTION= [, IC=z [, z′]] [, IMPLICIT] [, STATIC_HOLD] [, DYNAMIC_HOLD]
//
// One differential equation. Explicit, z′ = e(…), starting at IC. With IMPLICIT, e(z, z′, …) = 0: a state where e reads
// its own DIF1, otherwise an algebraic unknown that adds no state. Where DIFFs read each other's DIF1, there are as
// many states as the equations have rank in their rates (rate_reduction.h). DIF(id) reads z and DIF1(id) z′; that of an
// algebraic one is the exact time derivative of its equation. With STATIC_HOLD a static solution keeps z; otherwise it
// looks for z′ = 0. With DYNAMIC_HOLD z is constant but in statics: no state of the linear model, and z′ counts as
// zero.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "elements/controls/array.h"
#include "elements/controls/rate_reduction.h"
#include "elements/controls/spline.h"
#include "elements/controls/variable.h"
#include "elements/controls/variable_list.h"
#include "elements/families/function_equation.h"
#include "model/model.h"
#include "model/schema.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

struct Diff {
  std::vector<double> initial;
  bool implicit = false, static_hold = false, dynamic_hold = false;
  Expression function;
  bool algebraic = false;

  static constexpr std::array<Argument<Diff>, 5> arguments = {{
      {.name = "IC", .slot = &Diff::initial, .help = "z [, z′] at the start", .start = StatedStart::value},
      {.name = "FUNCTION", .slot = &Diff::function, .required = true, .help = "z′, or with IMPLICIT what is zero"},
      {.name = "IMPLICIT", .slot = &Diff::implicit, .help = "FUNCTION = 0"},
      {.name = "STATIC_HOLD", .slot = &Diff::static_hold, .help = "z keeps its value in statics"},
      {.name = "DYNAMIC_HOLD", .slot = &Diff::dynamic_hold, .help = "z is constant in linear models"},
  }};
};

bool reads_own_rate(const Diff& d, std::int64_t id) {
  const auto atoms = d.function.atoms();
  return std::any_of(atoms.begin(), atoms.end(),
                     [&](const Atom& a) { return a.function->reads == DataSource::state_rate && a.argument[0] == id; });
}

// Whether an expression can see rates of DIFFs that its own atoms do not show: through VARIABLEs, or by forces,
// accelerations and outputs of controllers.
bool hides_rates(const Model& model, const Expression& function) {
  std::set<std::int64_t> visited;
  const std::function<bool(const Expression&, bool)> hides = [&](const Expression& e, bool indirect) {
    for (const Atom& a : e.atoms()) {
      const AtomFunction& f = *a.function;
      if (f.family == AtomFamily::delay || f.family == AtomFamily::element_force ||
          f.family == AtomFamily::marker_force)
        return true;
      if (f.family == AtomFamily::marker_measure && f.order == 2) return true;
      if (f.reads == DataSource::state_rate && indirect) return true;
      const auto through = [&](VariableRef v) {
        return visited.insert(model.label(v).id).second && hides(variable_function(model, v), true);
      };
      if (f.reads == DataSource::value) {
        const auto v = model.find("VARIABLE", a.argument[0]);
        if (v && through({*v})) return true;
      } else if (f.reads == DataSource::list_entry) {
        const auto handle = model.find(f.statement, a.argument[0]);
        const auto* list = handle ? model.get<VariableList>(*handle) : nullptr;
        if (list && std::any_of(list->variables.begin(), list->variables.end(), through)) return true;
      } else if (f.reads == DataSource::array_entry) {
        const auto handle = model.find("ARRAY", a.argument[0]);
        const auto* array = handle ? model.get<Array>(*handle) : nullptr;
        if (!array || array->y) return true;  // outputs of controllers pass on what they are fed
        if (std::any_of(array->variables.begin(), array->variables.end(), through)) return true;
      }
    }
    return false;
  };
  return hides(function, false);
}

class DiffSet final : public TypedSet<Diff> {
 public:
  using TypedSet::TypedSet;
  void read(std::size_t k, ElementReader& reader) override {
    Diff& d = elements[k];
    if (!read_arguments(d, reader)) return;
    if (d.initial.size() > 2) {
      reader.error("wrong-count", reader.at("IC"), fmt::format("IC has {} values, it takes 1 or 2", d.initial.size()));
    }
    if (d.implicit && !reads_own_rate(d, reader.label().id)) {
      d.algebraic = true;
      for (const std::string_view hold : {"STATIC_HOLD", "DYNAMIC_HOLD"}) {
        if (!reader.given(hold)) continue;
        reader.error("unexpected-argument", reader.at(hold),
                     fmt::format("{} is algebraic, as its FUNCTION does not read DIF1({}): there is no state to hold",
                                 reader.label().text(), reader.label().id));
      }
    }
    if (!d.implicit && d.initial.size() == 2) {
      reader.error("wrong-count", reader.at("IC"), "the second value of IC goes with IMPLICIT");
    }
  }
  std::unique_ptr<Kernel> make_kernel(const Model& model, Layout& layout) const override {
    using Form = FunctionEquationKernel::Form;
    std::vector<DiffEquation> equations;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Diff& d = elements[k];
      const std::int64_t id = labels[k].id;
      const Expression function = d.function.with_curves([&](SplineUse& use) { attach_data(model, use); });
      equations.push_back({id, function, d.implicit, reads_own_rate(d, id), hides_rates(model, d.function),
                           d.initial.empty() ? 0.0 : d.initial[0], d.initial.size() > 1 ? d.initial[1] : 0.0,
                           d.dynamic_hold});
    }
    const RateReduction reduction = reduce_rates(equations);
    for (const RateReduction::Refusal& r : reduction.refusals) {
      layout.problems.error("unfit-condition", labels[r.members.front()].at, text(r));
    }

    std::vector<FunctionEquationKernel::Item> items;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Diff& d = elements[k];
      const RateReduction::Role& role = reduction.roles[k];
      FunctionEquationKernel::Item item{.function = d.function,
                                        .form = Form::rate,
                                        .initial = equations[k].initial,
                                        .initial_rate = equations[k].initial_rate,
                                        .held_in_statics = d.static_hold,
                                        .held_in_dynamics = d.dynamic_hold,
                                        .start_stated = !d.algebraic && !d.initial.empty()};
      const auto sign = [&](std::size_t of) { return elements[of].implicit ? 1.0 : -1.0; };
      if (d.dynamic_hold) {
        // z′ − e = 0 in both forms: it is asked for where z′ = 0 alone.
      } else if (role.is_state) {
        item.form = d.implicit ? Form::implicit_state : Form::rate;
        if (role.equation != k) {
          item.terms = {{role.equation, sign(role.equation), !elements[role.equation].implicit}};
        }
        if (d.algebraic) {
          layout.remarks.warning("implicit-diff", labels[k].at,
                                 fmt::format("{} does not read its own DIF1, but it takes its rate to solve the "
                                             "equations that do: it is a state",
                                             labels[k].full_text()));
        }
      } else {
        item.form = role.condition.empty() ? Form::implicit_algebraic : Form::condition;
        for (const RateReduction::Term& t : role.condition) {
          item.terms.push_back({t.of, t.factor * sign(t.of), !elements[t.of].implicit});
        }
        layout.remarks.warning("implicit-diff", labels[k].at, remark(k, role));
      }
      items.push_back(std::move(item));
    }
    auto kernel = std::make_unique<FunctionEquationKernel>(std::move(items), labels, layout);
    kernel->couple(reduction.coupled);
    return kernel;
  }

 private:
  std::string names(const std::vector<std::size_t>& members) const {
    std::vector<std::size_t> sorted = members;
    std::sort(sorted.begin(), sorted.end(), [&](auto a, auto b) { return labels[a].id < labels[b].id; });
    std::vector<std::string> list;
    for (const std::size_t k : sorted) list.push_back(labels[k].full_text());
    return fmt::format("{}", fmt::join(list, ", "));
  }

  std::string text(const RateReduction::Refusal& r) const {
    return fmt::format(
        "the equations of {} do not determine their rates: even with the derivatives of the combinations without DIF1 "
        "some stay free (higher index)",
        names(r.members));
  }

  std::string remark(std::size_t k, const RateReduction::Role& role) const {
    if (elements[k].algebraic) {
      return fmt::format("{} does not read its own DIF1: it is algebraic and contributes no state",
                         labels[k].full_text());
    }
    std::vector<std::size_t> of;
    for (const RateReduction::Term& t : role.condition) of.push_back(t.of);
    return fmt::format(
        "{} follows from a condition without DIF1 that is in the equations of {}: it contributes no state",
        labels[k].full_text(), names(of));
  }
};

constexpr std::array<RoutineKind, 1> diff_routines = {
    {{.routine = "difsub",
      .values = 1,
      .arguments = RoutineArguments::function,
      .told =
          [](const StatementWords& s) {
            return told<sAdamsDiff>(s, s.has("STATIC_HOLD"), s.has("IMPLICIT"), s.real("IC"), s.real("IC", 1));
          },
      .constants = value_of_function}}};

}  // namespace

extern constinit const Kind diff =
    Kind{"DIFF",
         "",
         "One differential state given by an expression.",
         Kind::Role::element,
         detail::argument_infos<Diff>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<DiffSet>(kind); }}
        .calling(diff_routines)
        .with_example("DIFF/1, FUNCTION=-DIF(1)");

}  // namespace dynalin
