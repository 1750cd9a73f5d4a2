// Datasets of beams of finite elements.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "cases/study_of.h"

namespace dynalin::cases {

// A straight beam along x of its BCS with nodes at equal distances, a rectangle of height h (along y) and width w.
struct StraightBeam {
  int elements = 4;
  double length = 1, height = 0.01, width = 0.01;
  double E = 0, density = 0;  // 0: EI about z and the mass by length are 1
  double poisson = 0.3;
  std::string further{};  // arguments
  int id = 2;
  std::string type = "3DBEAM";

  double area() const { return height * width; }
  double zz() const { return width * height * height * height / 12; }
  double yy() const { return height * width * width * width / 12; }
  double modulus() const { return E > 0 ? E : 1 / zz(); }
  double mass_by_volume() const { return density > 0 ? density : 1 / area(); }

  // With MARKER/{id}1 at its first node and MARKER/{id}2 at its last.
  std::string text() const {
    std::vector<int> labels;
    std::vector<std::string> places;
    for (int k = 0; k <= elements; ++k) {
      labels.push_back(k + 1);
      places.push_back(fmt::format("{:.17g}", length * k / elements));
    }
    return fmt::format(
        "MATERIAL/{0}, DENSITY={1:.17g}, YOUNGS_MODULUS={2:.17g}, POISSONS_RATIO={3:.17g}\n"
        "FE_PART/{0}, TYPE={11}, MATERIAL={0}, NODE_LABELS={4}\n, X={5}\n, AREA={6:.17g}, IYY={7:.17g}, "
        "IZZ={8:.17g}{9}\n"
        "MARKER/{0}1, FE_PART={0}, NODE_LABEL=1\nMARKER/{0}2, FE_PART={0}, NODE_LABEL={10}, QP={12},0,0\n",
        id, mass_by_volume(), modulus(), poisson, fmt::join(labels, ","), fmt::join(places, "\n, "), area(), yy(), zz(),
        further, elements + 1, type, places.back());
  }
};

inline std::string beam_model(const std::string& statements) {
  return "Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, FLOATING\n" + statements + "END\n";
}
// Clamped at its first node, with a force or moment on the last one, of ground's axes or of those of the marker RM.
inline std::string clamped_beam(const StraightBeam& beam, const std::string& further = "") {
  return beam_model(beam.text() + fmt::format("JOINT/1, FIXED, I={}1, J=1\n", beam.id) + further);
}

// In steps of the load, each from the equilibrium before.
inline library::OperatingPoint loaded(const std::function<std::string(double)>& dataset, int steps) {
  auto study = study_of(dataset(1.0 / steps));
  auto point = study.static_equilibrium();
  for (int k = 2; k <= steps; ++k) {
    auto next = study_of(dataset(static_cast<double>(k) / steps));
    point = next.static_equilibrium(next.continued(point));
    study = next;
  }
  return point;
}

}  // namespace dynalin::cases
