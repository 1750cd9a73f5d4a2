// What elements ask of the start: joints, curve contacts and flexible bodies with initial conditions of their own.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "mechanics/equations.h"

namespace dynalin {

// What an element asks of the start beyond the poses and velocities of bodies.
struct StartCondition {
  const ElementLabel* owner = nullptr;
  std::string_view name;
  std::optional<double> displacement, velocity;
  StartArguments arguments{};  // that state them
};

class StartSource {
 public:
  virtual std::span<const StartCondition> start_conditions() const = 0;
  // A position row for each of them: the displacement less what is asked, or zero where only the velocity is.
  virtual void start_rows(const Motion&, std::int32_t first_row, ConstraintRows&) const = 0;

 protected:
  ~StartSource() = default;
};

}  // namespace dynalin
