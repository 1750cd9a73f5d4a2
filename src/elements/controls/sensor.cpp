// SENSOR/id, FUNCTION=, VALUE= [, ERROR=] [, EVALUATE=] …
//
// Watches an expression over time and stops or changes a simulation when it meets VALUE. SENVAL(id) reads what EVALUATE
// gave when the sensor last triggered, and 0 before that. No analysis here moves in time, so no sensor triggers: the
// statement is kept as text, and SENVAL is the constant 0 in every linear model.
#include "model/kind.h"

namespace dynalin {

namespace {

class SensorSet final : public ElementSet {
 public:
  using ElementSet::ElementSet;
  void append(ElementLabel label) override {
    labels.push_back(std::move(label));
    sound.push_back(true);
  }
  void read(std::size_t, ElementReader&) override {}
};

}  // namespace

extern constinit const Kind sensor = {
    "SENSOR",
    "",
    "Stops or changes a simulation over time; never acts on a linear model.",
    Kind::Role::element,
    {},
    [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<SensorSet>(kind); }};

}  // namespace dynalin
