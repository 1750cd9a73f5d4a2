#include "routine/given_inputs.h"

#include <array>
#include <cstdint>

namespace dynalin {

namespace {

std::vector<Atom> of_field(int i, int j) {
  const std::array<int, 4> ids = {i, j, j, j};
  std::vector<Atom> inputs;
  const auto take = [&](std::initializer_list<std::string_view> names, std::size_t count) {
    for (const std::string_view name : names) inputs.push_back(*single_measure(name, std::span(ids).first(count)));
  };
  take({"DX", "DY", "DZ"}, 3), take({"AX", "AY", "AZ"}, 2);
  take({"VX", "VY", "VZ"}, 4), take({"WX", "WY", "WZ"}, 3);
  return inputs;
}

// Arguments of routines, which no expression of the language reads.
constexpr AtomFunction argument_named(std::string_view name) {
  return {.name = name,
          .family = AtomFamily::data,
          .order = -1,
          .minimum_arguments = 0,
          .maximum_arguments = 1,
          .statement = "",
          .built = true};
}
enum class Given : std::uint8_t { loci, ni, locj, nj, gap, gapdot, xdot, nforce, disp };
constexpr std::array<AtomFunction, 9> arguments = {
    argument_named("LOCI"), argument_named("NI"),     argument_named("LOCJ"),
    argument_named("NJ"),   argument_named("GAP"),    argument_named("GAPDOT"),
    argument_named("XDOT"), argument_named("NFORCE"), argument_named("DISP")};

// Each with the numbers it has, counted from 1 where it has several.
struct Listed {
  Given argument;
  std::size_t numbers;
};
std::vector<Atom> listed(std::initializer_list<Listed> list) {
  std::vector<Atom> inputs;
  for (const Listed& l : list) {
    for (std::size_t k = 1; k <= l.numbers; ++k) {
      Atom atom;
      atom.function = &arguments[static_cast<std::size_t>(l.argument)];
      if (l.numbers > 1) atom.argument[0] = static_cast<std::int32_t>(k), atom.argument_count = 1;
      inputs.push_back(atom);
    }
  }
  return inputs;
}

}  // namespace

std::vector<Atom> given_inputs(const RoutineKind& kind, const RoutineStatement& statement) {
  using enum Given;
  switch (kind.arguments) {
    case RoutineArguments::field:
      return of_field(statement.I, statement.J);
    case RoutineArguments::pressure:
      return listed({{loci, 3}, {ni, 3}, {locj, 3}, {nj, 3}, {gap, 1}, {gapdot, 1}});
    case RoutineArguments::friction:
      return listed({{loci, 3}, {locj, 3}, {xdot, 3}, {nforce, 1}});
    case RoutineArguments::coupler:
      return listed({{disp, statement.told.displacements}});
    default:
      return {};
  }
}

}  // namespace dynalin
