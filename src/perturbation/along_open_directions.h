#pragma once

namespace dynalin {

// What depends on open directions (PerturbationEquations::open_directions) by less than this share of the terms that it
// is a sum of does so by rounding.
inline constexpr double rounding_along_open_directions = 1e-11;

}  // namespace dynalin
