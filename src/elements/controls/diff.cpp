// DIFF/id, FUNCTION= [, IC=z [, z′]] [, IMPLICIT] [, STATIC_HOLD]
//
// One differential equation. Explicit, z′ = e(…), starting at IC. With IMPLICIT, e(z, z′, …) = 0: a state where e reads
// its own DIF1, otherwise an algebraic unknown that adds no state. DIF(id) reads z and DIF1(id) z′; that of an
// algebraic one is the exact time derivative of its equation. With STATIC_HOLD a static solution keeps z; otherwise it
// looks for z′ = 0.
#include <fmt/format.h>

#include <algorithm>

#include "elements/families/function_equation.h"
#include "model/model.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct Diff {
  std::vector<double> initial;
  bool implicit = false, static_hold = false, dynamic_hold = false;
  Expression function;
  bool algebraic = false;

  static constexpr std::array<Argument<Diff>, 5> arguments = {{
      {.name = "IC", .slot = &Diff::initial, .help = "z [, z′] at the start"},
      {.name = "FUNCTION", .slot = &Diff::function, .required = true, .help = "z′, or with IMPLICIT what is zero"},
      {.name = "IMPLICIT", .slot = &Diff::implicit, .help = "FUNCTION = 0"},
      {.name = "STATIC_HOLD", .slot = &Diff::static_hold, .help = "z keeps its value in statics"},
      {.name = "DYNAMIC_HOLD", .slot = &Diff::dynamic_hold, .help = "not available yet"},
  }};
};

bool reads_own_rate(const Diff& d, std::int64_t id) {
  const auto atoms = d.function.atoms();
  return std::any_of(atoms.begin(), atoms.end(),
                     [&](const Atom& a) { return a.function->name == "DIF1" && a.argument[0] == id; });
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
    if (d.dynamic_hold) {
      reader.error("argument-not-built", reader.at("DYNAMIC_HOLD"), "DYNAMIC_HOLD of DIFF is not available yet");
    }
    if (d.implicit && !reads_own_rate(d, reader.label().id)) {
      d.algebraic = true;
      if (d.static_hold) {
        reader.error("unexpected-argument", reader.at("STATIC_HOLD"),
                     fmt::format("{} is algebraic, as its FUNCTION does not read DIF1({}): there is no state to hold",
                                 reader.label().text(), reader.label().id));
      }
    }
    if (!d.implicit && d.initial.size() == 2) {
      reader.error("wrong-count", reader.at("IC"), "the second value of IC goes with IMPLICIT");
    }
  }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    using Form = FunctionEquationKernel::Form;
    std::vector<FunctionEquationKernel::Item> items;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Diff& d = elements[k];
      if (d.algebraic) {
        layout.remarks.push_back(fmt::format("{} does not read its own DIF1: it is algebraic and contributes no state",
                                             labels[k].full_text()));
      }
      const Form form = d.algebraic ? Form::implicit_algebraic : d.implicit ? Form::implicit_state : Form::rate;
      items.push_back({d.function, form, d.initial.empty() ? 0.0 : d.initial[0],
                       d.initial.size() > 1 ? d.initial[1] : 0.0, d.static_hold});
    }
    return std::make_unique<FunctionEquationKernel>(std::move(items), labels, layout);
  }
};

}  // namespace

extern constinit const Kind diff = {
    "DIFF",
    "",
    "One differential state given by an expression.",
    Kind::Role::element,
    detail::argument_infos<Diff>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<DiffSet>(kind); }};

}  // namespace dynalin
