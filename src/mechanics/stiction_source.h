// Elements whose surfaces may stick to each other: at a point where they do, each is a spring that a model in motion
// does not have.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mechanics/motion.h"

namespace dynalin {

struct Stiction {
  std::size_t element = 0;
  std::string joint;                  // "JOINT/3", whose surfaces they are
  std::int32_t first_state = 0;       // creep, a differential state for each direction of slip [length]
  std::array<double, 3> stiffness{};  // of the surfaces in these directions [force/length]
  std::size_t directions = 0;
};

class StictionSource {
 public:
  // Adds what sticks and bears a load.
  virtual void sticking(const Motion&, std::vector<Stiction>&) const = 0;
  // At a place of a search for an equilibrium: adds a sentence on each element that bears nearly all it can there, or
  // whose surfaces hold nothing at rest.
  virtual void exhausted(const Motion&, std::vector<std::string>&) const = 0;

 protected:
  ~StictionSource() = default;
};

}  // namespace dynalin
