// Which attempt at a seed was the first that was acceptable. To find it takes most of the time of a draw, and many
// programs of tests draw the same seeds: what one has found the others read, from a directory that is emptied whenever
// the generator is built anew.
#pragma once

#include <cstdint>
#include <optional>

namespace dynalin::oracle {

[[nodiscard]] std::optional<std::uint64_t> accepted_attempt(std::uint64_t seed);
void remember_accepted_attempt(std::uint64_t seed, std::uint64_t attempt);

}  // namespace dynalin::oracle
