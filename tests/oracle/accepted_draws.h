// Which attempt at a seed was the first that was acceptable. To find it, and to see that it is, takes most of the time
// of a draw, and many programs of tests draw the same seeds: what one has found the others read, from a directory that
// is emptied whenever the generator is built anew.
#pragma once

#include <cstdint>
#include <optional>

namespace dynalin::oracle {

struct AcceptedDraw {
  std::uint64_t attempt = 0;
  int softenings = 0;  // how many times its friction was made less until nothing jammed
};

[[nodiscard]] std::optional<AcceptedDraw> accepted_draw(std::uint64_t seed);
void remember_accepted_draw(std::uint64_t seed, const AcceptedDraw& draw);

}  // namespace dynalin::oracle
