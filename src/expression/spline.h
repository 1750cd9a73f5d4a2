// Curves and families of curves through data points, as AKISPL, CUBSPL and INTERP read them (function expressions,
// section 11).
//
// Every piece is the cubic with given values and slopes at its two points; the methods differ in the slopes. Akima
// takes weighted differences of the neighbours, the cubic spline those that make the second derivative continuous, with
// the third derivative at each end that of the cubic through the four points there (Forsythe, Malcolm, Moler). At a
// point the piece to its right counts. Beyond the data goes the parabola through the three last points, or the line
// through the two last. A family is interpolated linearly in its second variable z.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "base/dual.h"
#include "base/source.h"
#include "base/time_taylor.h"
#include "expression/parametric_curve.h"
#include "expression/spectrum.h"
#include "expression/step_reach.h"
#include "expression/switch_list.h"

namespace dynalin {

enum class SplineMethod : std::uint8_t { akima, cubic, linear };

struct SplineData {
  std::vector<double> x;               // strictly increasing, at least 4
  std::vector<double> z;               // of the curves of a family, strictly increasing; empty for a single curve
  std::vector<std::vector<double>> y;  // one list a curve
  bool linear_extrapolation = false;
};

class SplineCurves {
 public:
  SplineCurves(std::shared_ptr<const SplineData>, SplineMethod);

  // Value, or derivative 1 or 2 with respect to x; T is double, TimeTaylor or Dual over them.
  template <class T>
  T at(const T& x, const T& z, int derivative) const;

  // y(x + s, z + h) = (along_0 + along_1 s + along_2 s² + along_3 s³) + h (the same with by_z), exact on the piece
  // there.
  struct Expansion {
    std::array<double, 4> along{}, by_z{};
  };
  Expansion expand(double x, double z) const;

  // Where the value, or that derivative of it, has a kink or a jump, and where the data end. At the points between a
  // jump of the second derivative is left to the error control of an integration: tables of measured data have
  // thousands of them.
  void switches(double x, double z, int derivative, SwitchList&) const;
  // Ends a step that leads from x0 to x1 where it would pass over what the curve, or that derivative of it, does
  // between.
  void look_ahead(double x0, double z0, double x1, double z1, int derivative, StepReach&) const;

 private:
  // Coefficients of y = c0 + c1 s + c2 s² + c3 s³ with s = x − origin.
  struct Piece {
    double origin = 0;
    double c[4] = {0, 0, 0, 0};
  };
  const Piece& piece(std::size_t curve, double x) const;
  // Of a family: the curve below z, or the last but one.
  std::size_t curve_below(double z) const;

  std::shared_ptr<const SplineData> data_;
  SplineMethod method_;
  std::array<double, 3> range_{};           // of the values at the points, and of both derivatives
  std::vector<std::vector<Piece>> pieces_;  // of each curve: left of the data, between the points, right of the data
};

// A call inside an expression of a function that reads a SPLINE, or a CURVE.
struct SplineUse {
  std::int64_t id = 0;
  SplineMethod method = SplineMethod::akima;
  int derivative = 0;
  std::optional<std::size_t> component;   // of a CURVE at the parameter x: 0–2; nothing for a SPLINE
  std::optional<SpectrumBands> spectrum;  // of INVPSD, which takes the SPLINE as a power spectral density
  Span at, id_at;
  std::shared_ptr<const SplineCurves> curves;
  std::shared_ptr<const HarmonicSignal> signal;
  std::shared_ptr<const ParametricCurve> parametric;

  std::string_view statement() const { return component ? "CURVE" : "SPLINE"; }

  // NaN before curves are attached.
  template <class T>
  T evaluate(const T& x, const T& z) const;
  void switches(double x, double z, SwitchList&) const;
  void look_ahead(double x0, double z0, double x1, double z1, StepReach&) const;
};

}  // namespace dynalin
