// A Cartesian robot: three carriages, each on the one before, held by controllers that move them, with friction on
// every axis as a compiled routine or as an expression.
#pragma once

#include <fmt/format.h>

#include <string>

namespace dynalin {

enum class Friction : std::uint8_t { routine, expression };

inline std::string robot(Friction friction) {
  std::string text =
      "Cartesian robot\n"
      "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND\n"
      "PART/1, GROUND\nMARKER/1, PART=1\n";
  const char axes[] = "XYZ";
  // Joints slide along the z axes of their markers.
  const std::string along[] = {"REULER=90D,90D,0D", "REULER=0D,-90D,0D", "REULER=0D,0D,0D"};
  // Forces act along the z axis of J; what they would do to the carriage before is taken by its joint.
  for (int k = 1; k <= 3; ++k) {
    const int part = k + 1, before = k, base = before == 1 ? 1 : 10 * before;
    text += fmt::format("PART/{0}, MASS={1}, CM={2}, IP=1,1,1, V{3}=0.2", part, 40 - 10 * k, 10 * part, axes[0]);
    for (int j = 2; j <= k; ++j) text += fmt::format(", V{}=0.2", axes[j - 1]);
    text += fmt::format("\nMARKER/{}, PART={}\n", 10 * part, part);
    text += fmt::format("MARKER/{}, PART={}, {}\n", 10 * part + 1, part, along[k - 1]);
    text += fmt::format("MARKER/{}, PART={}, {}\n", 1000 + k, before, along[k - 1]);
    text += fmt::format("JOINT/{}, TRANSLATIONAL, I={}, J={}\n", k, 10 * part + 1, 1000 + k);
    text += fmt::format(
        "SFORCE/{0}, TRANSLATION, ACTIONONLY, I={1}, J={2}, "
        "FUNCTION=-2000*(D{3}({4},{5},{5})-0.3*TIME)-100*(V{3}({4},{5},{5})-0.3)\n",
        k, 10 * part + 1, 1000 + k, axes[k - 1], 10 * part, base);
    const std::string v = fmt::format("V{}({},{},{})", axes[k - 1], 10 * part, base, base);
    const std::string rate = fmt::format("({0}-1E5*ABS({0})/(10+5*EXP(-({0}/0.05)**2))*DIF({1}))", v, k);
    const std::string constants = fmt::format("USER({},{},{},{},1E5,300,4,10,15,0.05)", k, 10 * part, base, k);
    const bool called = friction == Friction::routine;
    text += fmt::format("DIFF/{}, IC=1E-5, FUNCTION={}\n", k, called ? constants : rate);
    text += fmt::format("SFORCE/{}, TRANSLATION, ACTIONONLY, I={}, J={}, FUNCTION={}\n", 10 + k, 10 * part + 1,
                        1000 + k, called ? constants : fmt::format("-(1E5*DIF({})+300*{}+4*{})", k, rate, v));
  }
  return text + "END\n";
}

}  // namespace dynalin
