// The compiled routine of a MOTION and what it is told of it.
#pragma once

#include <array>
#include <string_view>

#include "routine/routine_kinds.h"
#include "routine/statement_words.h"

namespace dynalin {

// Of a joint without ROTATION or TRANSLATION its type says what moves.
inline ToldToRoutine told_of_motion(const StatementWords& s) {
  static constexpr std::array<std::string_view, 6> axes = {"X", "Y", "Z", "B1", "B2", "B3"};
  static constexpr std::array<std::string_view, 3> levels = {"DISPLACEMENT", "VELOCITY", "ACCELERATION"};
  static constexpr std::array<std::string_view, 2> ways = {"ROTATIONAL", "TRANSLATIONAL"};
  const int joint = s.integer("JOINT");
  const auto axis = s.word_among(axes), way = s.word_among(ways);
  const bool translates = axis ? *axis < 3 : way ? *way == 1 : s.slides(joint);
  sAdamsMotion said{s.id(),
                    s.constants().count(),
                    s.constants().data(),
                    joint,
                    translates ? "TRANSLATION" : "ROTATION",
                    s.integer("I"),
                    s.integer("J"),
                    {},
                    levels[s.word_among(levels).value_or(0)].data()};
  if (axis) axes[*axis].copy(said.Which, sizeof said.Which);
  return {std::make_shared<const sAdamsMotion>(said)};
}

inline constexpr std::array<RoutineKind, 1> motion_routines = {{{.routine = "motsub",
                                                                 .values = 1,
                                                                 .arguments = RoutineArguments::of_time,
                                                                 .told = told_of_motion,
                                                                 .constants = value_of_function}}};

}  // namespace dynalin
