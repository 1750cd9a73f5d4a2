// SENSOR/id, FUNCTION=, VALUE= [, EQ | GE | LE] [, ERROR=] [, EVALUATE=] …
//
// Watches an expression over time and stops or changes a simulation when it meets VALUE. SENVAL(id) reads what EVALUATE
// gave when the sensor last triggered, and 0 before that. No analysis here moves in time, so no sensor triggers: its
// arguments are checked by name, and SENVAL is the constant 0 in every linear model.
#include "elements/families/kept_as_text.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct WrittenSensor {
  Obsolete expression;
  bool flag = false;
  std::optional<double> number;

  using E = WrittenSensor;
  static constexpr std::array<Argument<E>, 21> arguments = {{
      {.name = "FUNCTION", .slot = &E::expression, .help = "what is watched"},
      {.name = "VALUE", .slot = &E::number, .help = "at which it triggers"},
      {.name = "EQ", .slot = &E::flag, .help = "triggers where FUNCTION meets VALUE (default)"},
      {.name = "GE", .slot = &E::flag, .help = "where it is VALUE or more"},
      {.name = "LE", .slot = &E::flag, .help = "where it is VALUE or less"},
      {.name = "ERROR", .slot = &E::number, .help = "how near to VALUE is near enough"},
      {.name = "TIME_ERROR", .slot = &E::number, .help = "the same in time"},
      {.name = "ANGULAR", .slot = &E::flag, .help = "angles count modulo whole turns"},
      {.name = "BISECTION", .slot = &E::flag, .help = "how the instant is searched for"},
      {.name = "INTERPOLATION", .slot = &E::flag, .help = "the same"},
      {.name = "EVALUATE", .slot = &E::expression, .help = "what SENVAL reads after it triggered"},
      {.name = "HALT", .slot = &E::flag, .help = "ends the run"},
      {.name = "RETURN", .slot = &E::flag, .help = "ends the simulation"},
      {.name = "RESTART", .slot = &E::flag, .help = "begins the integration anew"},
      {.name = "CODGEN", .slot = &E::flag, .help = "factors the Jacobian anew"},
      {.name = "PRINT", .slot = &E::flag, .help = "writes a step of output"},
      {.name = "YYDUMP", .slot = &E::flag, .help = "writes the state of the solver"},
      {.name = "DT", .slot = &E::number, .unit = "time", .help = "time between outputs from then on"},
      {.name = "STEPSIZE", .slot = &E::number, .unit = "time", .help = "next step of the integration"},
      {.name = "LABEL", .slot = &E::expression, .help = "a name"},
      {.name = "ROUTINE", .slot = &E::expression, .help = "of a compiled FUNCTION"},
  }};
};

class SensorSet final : public TextSet {
 public:
  using TextSet::TextSet;
  void read(std::size_t, ElementReader& reader) override {
    WrittenSensor checked;
    read_arguments(checked, reader);
  }
};

}  // namespace

extern constinit const Kind sensor = Kind{
    "SENSOR",
    "",
    "Stops or changes a simulation over time; never acts on a linear model.",
    Kind::Role::element,
    detail::argument_infos<WrittenSensor>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<SensorSet>(kind);
    }}.deactivatable();

}  // namespace dynalin
