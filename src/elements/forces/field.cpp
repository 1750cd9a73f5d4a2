// FIELD/id, I=, J=, {KMATRIX= [, CMATRIX= | CRATIO=] [, FORCE=] | FUNCTION=USER(…)} [, LENGTH=]
//
// A linear force of all six displacements (families/linear_wrench.h): KMATRIX and CMATRIX are 6 × 6 and entered by
// columns, they need not be symmetric. FORCE acts at the displacement LENGTH. CRATIO: CMATRIX = CRATIO · KMATRIX.
// FUNCTION calls a compiled routine of the user, which says force and torque as a function of displacement and
// velocity.
#include <fmt/format.h>

#include "elements/families/linear_wrench.h"
#include "expression/program.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

struct Field {
  MarkerId i, j;
  std::vector<double> stiffness, damping, force, length;
  std::optional<double> ratio;
  Expression function;

  static constexpr std::string_view keyword = "FIELD";
  static constexpr std::string_view summary = "Linear force of all six displacements, with full matrices.";
  static constexpr std::array<Argument<Field>, 8> arguments = {{
      {.name = "I", .slot = &Field::i, .required = true, .help = "marker the force acts on"},
      {.name = "J", .slot = &Field::j, .required = true, .help = "marker the reaction acts on, and whose axes count"},
      {.name = "KMATRIX",
       .slot = &Field::stiffness,
       .help = "36 values by columns: stiffness",
       .ends = "FUNCTION",
       .count = 36},
      {.name = "CMATRIX",
       .slot = &Field::damping,
       .help = "36 values by columns: damping",
       .ends = "CRATIO",
       .count = 36},
      {.name = "CRATIO",
       .slot = &Field::ratio,
       .unit = "time",
       .help = "CMATRIX = CRATIO · KMATRIX",
       .ends = "CMATRIX"},
      {.name = "FORCE", .slot = &Field::force, .help = "3 forces and 3 torques at LENGTH", .count = 6, .unstated = 0},
      {.name = "LENGTH",
       .slot = &Field::length,
       .help = "3 lengths and 3 angles at which FORCE acts",
       .count = 6,
       .unstated = 0},
      {.name = "FUNCTION",
       .slot = &Field::function,
       .help = "USER(…): calls a compiled routine",
       .ends = "KMATRIX CMATRIX CRATIO FORCE"},
  }};

  LinearLaw law(ElementReader& reader) const {
    LinearLaw w{i, j, {}, {}, {}, {}};
    std::array<double, 36> K{}, C{};
    take_values(stiffness, "KMATRIX", K, reader);
    take_values(damping, "CMATRIX", C, reader);
    take_values(force, "FORCE", w.force, reader);
    take_values(length, "LENGTH", w.length, reader);
    if (reader.given("FUNCTION")) {
      w.routine = routine(reader);
    } else if (!reader.given("KMATRIX")) {
      reader.error("missing-argument", reader.statement().at, fmt::format("{} needs KMATRIX", reader.label().text()));
    }
    if (ratio && !damping.empty()) {
      reader.error("excluded-arguments", reader.at("CRATIO"),
                   fmt::format("{} takes CMATRIX or CRATIO, not both", reader.label().text()));
    }
    w.K = by_columns(K);
    w.C = ratio ? scaled(w.K, *ratio) : by_columns(C);
    return w;
  }

  // Null after an error.
  std::shared_ptr<const Routine> routine(ElementReader& reader) const {
    const auto routines = function.program().routines();
    if (!routines.empty()) return routines.front().routine;
    reader.error("unknown-word", reader.at("FUNCTION"),
                 fmt::format("FUNCTION of {} is USER(…), the call of a compiled routine, and no expression",
                             reader.label().text()));
    return nullptr;
  }
};

// A constant in the place of its routine is a force without stiffness.
constexpr std::array<ValueArgument, 2> constants_of_field = {{{"KMATRIX", 36, true}, {"FORCE", 6}}};
constexpr std::array<RoutineKind, 1> field_routines = {
    {{.routine = "fiesub",
      .values = 6,
      .arguments = RoutineArguments::field,
      .told = [](const StatementWords& s) { return told<sAdamsField>(s, s.integer("I"), s.integer("J")); },
      .constants = constants_of_field}}};

}  // namespace

extern constinit const Kind field = linear_wrench<Field>().calling(field_routines).with_example("FIELD/1, CRATIO=0.02");

}  // namespace dynalin
