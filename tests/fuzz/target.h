// What the fuzz targets share. A target is one function of any bytes: libFuzzer calls it (preset `fuzz`), and so does
// replay.cpp in every other build. What must hold of all inputs is said with `demand`.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>

#include "base/diagnostics.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count);

namespace dynalin::fuzz {

inline std::string text_of(const std::uint8_t* bytes, std::size_t count) {
  return count == 0 ? std::string() : std::string(reinterpret_cast<const char*>(bytes), count);
}

// Ends the process where both a fuzzer and a replay see it.
inline void demand(bool holds, std::string_view what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz target: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

// Ends the process where an input took longer than it may; processor time, because machines are shared.
class TimeLimit {
 public:
  TimeLimit() = default;
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
  ~TimeLimit() {
    constexpr double longest = 10;  // seconds
    demand(static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC < longest, "it took too long");
  }

 private:
  std::clock_t begin_ = std::clock();
};

// Every message can be printed and explained, and stands inside its source.
inline void demand_sound(const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.items()) {
    demand(!d.message.empty() && find_explanation(d.code) != nullptr, "a diagnostic without message or explanation");
    if (!d.at.source) continue;
    demand(std::size_t{d.at.offset} + d.at.length <= d.at.source->text().size(), "a diagnostic outside its source");
  }
  demand(render(diagnostics).empty() == diagnostics.items().empty(), "diagnostics that print nothing");
}

}  // namespace dynalin::fuzz
