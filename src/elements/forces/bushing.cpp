// BUSHING/id, I=, J=, K=, KT=, C=, CT=, FORCE=, TORQUE=
//
// Springs and dampers along and about the axes of J, uncoupled (families/linear_wrench.h):
//
//     F = FORCE − K d − C v,      T = TORQUE − KT (AX, AY, AZ) − CT ω         on I, in the axes of J
//
// with the displacement d, the velocity v seen from J and the relative angular velocity ω.
#include <fmt/format.h>

#include "elements/families/linear_wrench.h"

namespace dynalin {

namespace {

struct Bushing {
  MarkerId i, j;
  std::vector<double> stiffness, angular_stiffness, damping, angular_damping, force, torque;

  static constexpr std::string_view keyword = "BUSHING";
  static constexpr std::string_view summary = "Linear springs and dampers along and about three axes.";
  static constexpr std::array<Argument<Bushing>, 8> arguments = {{
      {.name = "I", .slot = &Bushing::i, .required = true, .help = "marker the force acts on"},
      {.name = "J", .slot = &Bushing::j, .required = true, .help = "marker the reaction acts on, and whose axes count"},
      {.name = "K",
       .slot = &Bushing::stiffness,
       .unit = unit::stiffness,
       .help = "3 values, along x, y, z",
       .count = 3,
       .unstated = 0},
      {.name = "KT",
       .slot = &Bushing::angular_stiffness,
       .unit = unit::angular_stiffness,
       .help = "3 values",
       .count = 3,
       .unstated = 0},
      {.name = "C", .slot = &Bushing::damping, .unit = unit::damping, .help = "3 values", .count = 3, .unstated = 0},
      {.name = "CT",
       .slot = &Bushing::angular_damping,
       .unit = unit::angular_damping,
       .help = "3 values",
       .count = 3,
       .unstated = 0},
      {.name = "FORCE",
       .slot = &Bushing::force,
       .unit = unit::force,
       .help = "3 values at zero displacement",
       .count = 3,
       .unstated = 0},
      {.name = "TORQUE",
       .slot = &Bushing::torque,
       .unit = unit::torque,
       .help = "3 values at zero displacement",
       .count = 3,
       .unstated = 0},
  }};

  static constexpr bool says_all = true;  // its law needs nothing but what could be read
  LinearLaw law(ElementReader& reader) const {
    LinearLaw w{i, j, {}, {}, {}, {}};
    const auto diagonal = [&](const std::vector<double>& translation, std::string_view name,
                              const std::vector<double>& rotation, std::string_view rotation_name, auto&& put) {
      std::array<double, 3> t{}, r{};
      take_values(translation, name, t, reader);
      take_values(rotation, rotation_name, r, reader);
      for (std::size_t k = 0; k < 3; ++k) put(k, t[k]), put(k + 3, r[k]);
      return std::pair{t, r};
    };
    const auto check = [&](const std::array<double, 3>& values, std::string_view name) {
      for (const double v : values) {
        if (v >= 0) continue;
        reader.error("value-out-of-range", reader.at(name),
                     fmt::format("{} of {} is negative", name, reader.label().text()));
        return;
      }
    };
    const auto k = diagonal(stiffness, "K", angular_stiffness, "KT", [&](std::size_t n, double v) { w.K[n][n] = v; });
    const auto c = diagonal(damping, "C", angular_damping, "CT", [&](std::size_t n, double v) { w.C[n][n] = v; });
    diagonal(force, "FORCE", torque, "TORQUE", [&](std::size_t n, double v) { w.force[n] = v; });
    check(k.first, "K"), check(k.second, "KT"), check(c.first, "C"), check(c.second, "CT");
    return w;
  }
};

}  // namespace

extern constinit const Kind bushing = linear_wrench<Bushing>().with_example("BUSHING/1, K=0,0,500");

}  // namespace dynalin
