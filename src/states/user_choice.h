// Which of the user's coordinates (PSTATE) become states, and which of the chosen ones give way to them.
//
// A coordinate of the user is taken if it is independent of those before it, however little it moves: only rounding
// refuses it. Each takes the place of the chosen coordinate that is wanted least among those it can stand for.
#pragma once

#include "states/state_choice.h"

namespace dynalin {

std::vector<StateChoice::Entry> gradient_of(const CandidateSet&, const Candidate&);
// What a unit of the scaled coordinates of the layout makes of a coordinate.
double unit_of(const System&, const std::vector<StateChoice::Entry>& gradient);

// Puts those that are taken before the chosen ones and says in a warning why others are not. Returns how far each moves
// while the chosen ones, and those before it, move by their units.
Result<std::vector<double>> prefer_user_coordinates(const System&, const ConstraintRows&, const CandidateSet&,
                                                    StateChoice&);

}  // namespace dynalin
