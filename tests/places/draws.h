// How much of what is drawn, or goes on for long, a run of the tests looks at. With DYNALIN_DRAWS=all in the
// environment it is all of it, otherwise a part, and of the mechanisms that are drawn the first ten of every thirty:
// any ten in a row have everything that goes by the number of a seed (oracle/generator.h).
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace dynalin {

inline bool all_are_drawn() {
  const char* const wanted = std::getenv("DYNALIN_DRAWS");
  return wanted && std::string_view(wanted) == "all";
}

// So much of what there is.
template <class Number>
Number draws(Number all, Number ordinary) {
  return all_are_drawn() ? all : ordinary;
}

// Those that must touch count by themselves.
inline bool is_drawn(std::uint64_t seed) {
  return all_are_drawn() || (seed - 1) % 30 < 10 || (seed > 220 && seed <= 230);
}

// Of those from `first` to `last`.
inline std::vector<std::uint64_t> drawn_seeds(std::uint64_t first, std::uint64_t last) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    if (is_drawn(seed)) seeds.push_back(seed);
  }
  return seeds;
}

}  // namespace dynalin
