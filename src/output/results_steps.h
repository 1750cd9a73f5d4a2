// Operating points as the steps of a results file: a map that says which number is what, and behind it the numbers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dynalin/operating_state.h"
#include "dynalin/units.h"
#include "model/settings.h"

namespace dynalin {

enum class StepKind { initial_conditions, statics, quasi_statics, kinematics, dynamics };

class ResultsSteps {
 public:
  ResultsSteps(Units units, ResultsSettings settings) : units_(std::move(units)), settings_(std::move(settings)) {}
  void add(StepKind, const OperatingState&);

  // <Units>, <StepMap> and all <Data>; elements that a step does not have are zero there.
  std::string text(const std::function<std::string(double)>& number) const;

 private:
  // The part of a step that a number stands in; all numbers of one part follow each other.
  enum class Section { time, positions, velocities, accelerations, reactions, forces, values };
  struct Entity {
    std::string name, element, type;
    std::int64_t id = 0;
  };
  struct Quantity {
    Section section;
    Entity entity;
    std::string component, unit;
    double value;
  };
  struct Step {
    StepKind kind;
    std::vector<Quantity> quantities;
  };

  std::vector<Quantity> quantities(const OperatingState&) const;
  void add_loads(const std::vector<Load>&, Section, std::vector<Quantity>&) const;

  Units units_;
  ResultsSettings settings_;
  std::vector<Step> steps_;
};

// For attributes and contents of XML.
std::string escaped(std::string_view text);

}  // namespace dynalin
