// One pass through the equations of all elements, by one thread or shared by all of them with the same sums.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "mechanics/kernel.h"

namespace dynalin {

enum class Threads : std::uint8_t { one, all };

// Kernel by kernel, what each adds. Threads evaluate shares of elements beside each other; what these add is taken in
// the order in which one thread would have added it. A pass that is too small for that is one thread's.
void add_equations(std::span<const std::unique_ptr<Kernel>>, const Motion&, Threads, Equations&);

}  // namespace dynalin
