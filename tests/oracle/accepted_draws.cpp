#include "accepted_draws.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace dynalin::oracle {

namespace {

std::filesystem::path file_of(std::uint64_t seed) {
  return std::filesystem::path(ACCEPTED_DRAWS) / std::to_string(seed);
}

}  // namespace

std::optional<AcceptedDraw> accepted_draw(std::uint64_t seed) {
  AcceptedDraw draw;
  if (std::ifstream(file_of(seed)) >> draw.attempt >> draw.softenings) return draw;
  return std::nullopt;
}

void remember_accepted_draw(std::uint64_t seed, const AcceptedDraw& draw) {
  // Others read while this is written: whole files take the place of none. What can't be written is found again.
  std::filesystem::path written = file_of(seed);
  written += "." + std::to_string(getpid());
  std::error_code ignored;
  if (std::ofstream(written) << draw.attempt << ' ' << draw.softenings << '\n')
    std::filesystem::rename(written, file_of(seed), ignored);
}

}  // namespace dynalin::oracle
