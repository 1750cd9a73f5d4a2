// An operating point as a step of a results file: a map that says which number is what, and the numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "dynalin/operating_state.h"
#include "dynalin/units.h"
#include "elements/settings/output_settings.h"
#include "system/request_values.h"

namespace dynalin {

enum class StepKind { initial_conditions, statics, quasi_statics, kinematics, dynamics };

class ResultsSteps {
 public:
  ResultsSteps(Units units, ResultsContents contents);

  // <StepMap>: the same text for all points of one model.
  std::string map(const OperatingState&, const PointRequests&) const;
  // The numbers in the order of the map, a line for the neighbours that belong to one element.
  std::string numbers(const OperatingState&, const PointRequests&,
                      const std::function<std::string(double)>& number) const;
  // <Units>, empty where the dataset does not name them.
  std::string units() const;

 private:
  enum class Unit : std::uint8_t {
    none,
    length,
    angle,
    velocity,
    angular_velocity,
    acceleration,
    angular_acceleration,
    force,
    torque,
    time
  };
  // Whose a number is: nobody's is the time.
  struct Owner {
    const ElementId* element = nullptr;
    const std::string* view_name = nullptr;
    bool is_pose = false;     // of a body
    std::int64_t node = 0;    // of an FE_PART
    std::int64_t marker = 0;  // of one of several wrenches
    const RequestInfo* request = nullptr;
  };
  struct Component {
    std::string_view name;
    int number = 0;  // behind the name, 0 for none
    Unit unit = Unit::none;
    const RequestComponent* requested = nullptr;
  };
  // use(owner, component, value) for every number of a step.
  template <class Use>
  void for_each(const OperatingState&, const PointRequests&, const Use&) const;
  template <class Use>
  void loads(const std::vector<Load>&, const Use&) const;
  std::string component(const Component&, std::size_t id) const;

  Units units_;
  ResultsContents contents_;
  std::vector<std::string> unit_names_;  // by Unit
};

// For attributes and contents of XML.
std::string escaped(std::string_view text);

}  // namespace dynalin
