// VARIABLE/id, FUNCTION= [, IC=]
//
// An algebraic value v defined by v − e(…) = 0. It is an unknown of its own, so expressions may refer to each
// other and to themselves as long as the equations have a solution. IC is the first guess of the iteration.
#include "elements/controls/variable.h"

#include "elements/families/function_equation.h"
#include "model/schema.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

struct Variable {
  double initial = 0;
  Expression function;

  static constexpr std::array<Argument<Variable>, 2> arguments = {{
      {.name = "IC", .slot = &Variable::initial, .help = "first guess of the value", .start = StatedStart::value},
      {.name = "FUNCTION", .slot = &Variable::function, .required = true, .help = "the value"},
  }};
};

class VariableSet final : public TypedSet<Variable> {
 public:
  using TypedSet::TypedSet;
  void read(std::size_t k, ElementReader& reader) override { read_arguments(elements[k], reader); }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    std::vector<FunctionEquationKernel::Item> items;
    for (const Variable& v : elements) {
      items.push_back({.function = v.function, .form = FunctionEquationKernel::Form::value, .initial = v.initial});
    }
    return std::make_unique<FunctionEquationKernel>(std::move(items), labels, layout);
  }
};

constexpr std::array<RoutineKind, 1> variable_routines = {
    {{.routine = "varsub",
      .values = 1,
      .arguments = RoutineArguments::function,
      .told = [](const StatementWords& s) { return told<sAdamsVariable>(s, s.real("IC")); },
      .constants = value_of_function}}};

}  // namespace

const Expression& variable_function(const Model& model, VariableRef ref) { return model.get<Variable>(ref)->function; }

extern constinit const Kind variable =
    Kind{"VARIABLE",
         "",
         "An algebraic value given by an expression.",
         Kind::Role::element,
         detail::argument_infos<Variable>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<VariableSet>(kind); }}
        .calling(variable_routines)
        .giving(Kind::Gives::value)
        .with_example("VARIABLE/1, FUNCTION=0.5");

}  // namespace dynalin
