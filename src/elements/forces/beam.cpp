// BEAM/id, I=, J=, LENGTH=, AREA=, IXX=, IYY=, IZZ=, EMODULUS=, GMODULUS= [, ASY=] [, ASZ=] [, CMATRIX= | CRATIO=]
//
// A massless elastic beam along x of J that is at rest with I at (LENGTH, 0, 0) and parallel axes
// (families/linear_wrench.h). Timoshenko's stiffness of I relative to J, with Py = 12 E Izz ASY/(G A L²), Pz = 12 E Iyy
// ASZ/(G A L²):
//
//     K11 = E A/L    K22 = 12 E Izz/(L³ (1+Py))    K26 = −6 E Izz/(L² (1+Py))    K66 = (4+Py) E Izz/(L (1+Py))
//     K44 = G Ixx/L  K33 = 12 E Iyy/(L³ (1+Pz))    K35 = +6 E Iyy/(L² (1+Pz))    K55 = (4+Pz) E Iyy/(L (1+Pz))
#include <fmt/format.h>

#include "elements/families/linear_wrench.h"

namespace dynalin {

namespace {

struct Beam {
  MarkerId i, j;
  double length = 0, area = 0, ixx = 0, iyy = 0, izz = 0, emodulus = 0, gmodulus = 0, asy = 0, asz = 0;
  std::vector<double> damping;
  std::optional<double> ratio;
  std::vector<std::string> formulation;

  static constexpr std::string_view keyword = "BEAM";
  static constexpr std::string_view summary = "Massless elastic beam along x of J.";
  static constexpr std::array<Argument<Beam>, 14> arguments = {{
      {.name = "I", .slot = &Beam::i, .required = true, .help = "marker at the far end"},
      {.name = "J", .slot = &Beam::j, .required = true, .help = "marker at the near end, x along the beam"},
      {.name = "LENGTH", .slot = &Beam::length, .required = true, .unit = unit::length, .help = "undeformed"},
      {.name = "AREA",
       .slot = &Beam::area,
       .required = true,
       .unit = "length²",
       .minimum = 0,
       .help = "area of the cross section"},
      {.name = "IXX",
       .slot = &Beam::ixx,
       .required = true,
       .unit = "length⁴",
       .minimum = 0,
       .help = "torsion constant"},
      {.name = "IYY", .slot = &Beam::iyy, .required = true, .unit = "length⁴", .minimum = 0, .help = "about y"},
      {.name = "IZZ", .slot = &Beam::izz, .required = true, .unit = "length⁴", .minimum = 0, .help = "about z"},
      {.name = "EMODULUS",
       .slot = &Beam::emodulus,
       .required = true,
       .unit = "force/length²",
       .minimum = 0,
       .help = "Young's modulus"},
      {.name = "GMODULUS",
       .slot = &Beam::gmodulus,
       .required = true,
       .unit = "force/length²",
       .minimum = 0,
       .help = "shear modulus"},
      {.name = "ASY", .slot = &Beam::asy, .minimum = 0, .help = "shear area ratio in y, 0: no shear deflection"},
      {.name = "ASZ", .slot = &Beam::asz, .minimum = 0, .help = "shear area ratio in z"},
      {.name = "CMATRIX",
       .slot = &Beam::damping,
       .help = "21 values: lower triangle by columns",
       .ends = "CRATIO",
       .count = 21},
      {.name = "CRATIO",
       .slot = &Beam::ratio,
       .unit = "time",
       .help = "damping as part of the stiffness",
       .ends = "CMATRIX"},
      {.name = "FORMULATION", .slot = &Beam::formulation, .help = "LINEAR"},
  }};

  LinearLaw law(ElementReader& reader) const {
    LinearLaw w{i, j, {}, {}, {length, 0, 0, 0, 0, 0}, {}};
    const std::string name = reader.label().text();
    if (!(length > 0)) {
      reader.error("value-out-of-range", reader.at("LENGTH"), fmt::format("LENGTH of {} must be positive", name));
      return w;
    }
    if (!formulation.empty()) check_formulation(reader);
    for (const auto& [value, word] : {std::pair{asy, "ASY"}, std::pair{asz, "ASZ"}}) {
      if (value > 0 && gmodulus * area == 0) {
        reader.error("value-out-of-range", reader.at(word),
                     fmt::format("{} of {} needs GMODULUS and AREA", word, name));
        return w;
      }
    }
    const double E = emodulus, L = length;
    const double py = asy > 0 ? 12 * E * izz * asy / (gmodulus * area * L * L) : 0;
    const double pz = asz > 0 ? 12 * E * iyy * asz / (gmodulus * area * L * L) : 0;
    w.K[0][0] = E * area / L;
    w.K[3][3] = gmodulus * ixx / L;
    w.K[1][1] = 12 * E * izz / (L * L * L * (1 + py));
    w.K[1][5] = w.K[5][1] = -6 * E * izz / (L * L * (1 + py));
    w.K[5][5] = (4 + py) * E * izz / (L * (1 + py));
    w.K[2][2] = 12 * E * iyy / (L * L * L * (1 + pz));
    w.K[2][4] = w.K[4][2] = 6 * E * iyy / (L * L * (1 + pz));
    w.K[4][4] = (4 + pz) * E * iyy / (L * (1 + pz));
    if (ratio && !damping.empty()) {
      reader.error("excluded-arguments", reader.at("CRATIO"),
                   fmt::format("{} takes CMATRIX or CRATIO, not both", name));
    }
    std::array<double, 21> lower{};
    take_values(damping, "CMATRIX", lower, reader);
    for (std::size_t c = 0, n = 0; c < 6; ++c) {
      for (std::size_t r = c; r < 6; ++r, ++n) w.C[r][c] = w.C[c][r] = lower[n];
    }
    if (ratio) w.C = scaled(w.K, *ratio);
    return w;
  }

 private:
  void check_formulation(ElementReader& reader) const {
    static constexpr std::array<std::string_view, 3> words = {"LINEAR", "NONLINEAR", "STRING"};
    const auto k = find_keyword(formulation[0], words);
    if (!k) {
      reader.error("unknown-word", reader.at("FORMULATION"),
                   fmt::format("FORMULATION is LINEAR, NONLINEAR or STRING, not {}", formulation[0]));
    } else if (*k != 0) {
      reader.error("argument-not-built", reader.at("FORMULATION"),
                   fmt::format("the law of the {} formulation is not published; only LINEAR is available", words[*k]));
    }
  }
};

}  // namespace

extern constinit const Kind beam = linear_wrench<Beam>().with_example("BEAM/1, IXX=0.5");

}  // namespace dynalin
