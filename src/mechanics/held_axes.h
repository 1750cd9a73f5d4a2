// Elements whose equations hold axes of two markers in line, and would hold them in the opposite direction as well.
#pragma once

#include <cstdint>

namespace dynalin {

// Of markers I and J of its wrenches.
class HeldAxes {
 public:
  enum class Axes : std::uint8_t { none, z, all };
  virtual Axes held_axes() const = 0;

 protected:
  ~HeldAxes() = default;
};

}  // namespace dynalin
