// When forces are in balance.
#pragma once

namespace dynalin {

// What an equation of forces may be off, of the terms that it is a sum of, or all of them together of the forces at
// play: below it a point is judged as one of rest.
inline constexpr double force_balance = 1e-9;

}  // namespace dynalin
