#include "linear/stability.h"

#include <fmt/format.h>

#include <algorithm>

#include "linear/eigen.h"

namespace dynalin {

Stability stability_of(const System& system, const OperatingPoint& at_rest) {
  constexpr std::size_t affordable = 300;
  Stability s;
  if (system.coordinates() > affordable) {
    s.reason = "the model is too large to look at it in passing, LINEAR/EIGENSOL tells";
    return s;
  }
  const auto linear = linearize(system, at_rest, {});
  if (!linear) {
    s.reason = linear.error().message;
    return s;
  }
  const auto modes = eigensolve(*linear, Vectors::none);
  if (!modes) {
    s.reason = modes.error().message;
    return s;
  }
  double largest = 0;
  for (const EigenMode& m : modes->modes) largest = std::max(largest, std::abs(m.eigenvalue_hz));
  for (const EigenMode& m : modes->modes) s.growing_modes += m.eigenvalue_hz.real() > 1e-7 * largest;
  s.verdict = s.growing_modes == 0 ? Stability::Verdict::stable : Stability::Verdict::unstable;
  return s;
}

std::string Stability::text() const {
  switch (verdict) {
    case Verdict::stable:
      return "nothing grows";
    case Verdict::unstable:
      return fmt::format("unstable: {} {}", growing_modes, growing_modes == 1 ? "mode grows" : "modes grow");
    case Verdict::unknown:
      break;
  }
  return "stability not known: " + reason;
}

}  // namespace dynalin
