// DIFF/id, FUNCTION= [, IC=] [, STATIC_HOLD]
//
// One differential state: z′ = e(…), starting at IC. DIF(id) reads z and DIF1(id) z′. With STATIC_HOLD a static
// solution keeps z; otherwise it looks for z′ = 0.
#include <fmt/format.h>

#include "elements/families/function_equation.h"
#include "model/model.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct Diff {
  std::vector<double> initial;
  bool implicit = false, static_hold = false, dynamic_hold = false;
  Expression function;

  static constexpr std::array<Argument<Diff>, 5> arguments = {{
      {.name = "IC", .slot = &Diff::initial, .help = "z [, z′] at the start"},
      {.name = "FUNCTION", .slot = &Diff::function, .required = true, .help = "z′"},
      {.name = "IMPLICIT", .slot = &Diff::implicit, .help = "0 = FUNCTION: not available yet"},
      {.name = "STATIC_HOLD", .slot = &Diff::static_hold, .help = "z keeps its value in statics"},
      {.name = "DYNAMIC_HOLD", .slot = &Diff::dynamic_hold, .help = "not available yet"},
  }};
};

class DiffSet final : public TypedSet<Diff> {
 public:
  using TypedSet::TypedSet;
  void read(std::size_t k, ElementReader& reader) override {
    Diff& d = elements[k];
    if (!read_arguments(d, reader)) return;
    if (d.initial.size() > 2) {
      reader.error("wrong-count", reader.at("IC"), fmt::format("IC has {} values, it takes 1 or 2", d.initial.size()));
    }
    for (const auto& [flag, name] : {std::pair{d.implicit, "IMPLICIT"}, std::pair{d.dynamic_hold, "DYNAMIC_HOLD"}}) {
      if (flag)
        reader.error("argument-not-built", reader.at(name), fmt::format("{} of DIFF is not available yet", name));
    }
  }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    std::vector<FunctionEquationKernel::Item> items;
    for (const Diff& d : elements) {
      items.push_back({d.function, d.initial.empty() ? 0.0 : d.initial[0], d.static_hold});
    }
    return std::make_unique<FunctionEquationKernel>(FunctionEquationKernel::Unknown::state, std::move(items), labels,
                                                    layout);
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
