// Elements whose memory begins anew in part where a command states arguments, while they go on as they were.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "mechanics/layout.h"

namespace dynalin {

struct StatedMemory {
  const ElementLabel* of = nullptr;
  std::span<const std::string_view> arguments;
  std::vector<std::int32_t> entries;  // that any of these begins
};

class StatedMemorySource {
 public:
  virtual void stated_memory(std::vector<StatedMemory>&) const = 0;

 protected:
  ~StatedMemorySource() = default;
};

}  // namespace dynalin
