// INVPSD(x, spline, f0, f1, n, log, seed): a signal with a given power spectral density.
//
//     y(x) = Σ_k A_k SIN(2π f_k x + φ_k),   k = 1 … n
//
// The range f0 … f1 is cut into n equal bands; f_k is the middle of band k and A_k²/2 the integral of the density over
// it, so that the mean square of y is the integral of the density from f0 to f1. Between its points the density is a
// straight line, with log = 1 a straight line in the logarithms of both; beyond them it is zero. The phases φ_k are
// 2π times the numbers in [0, 1) that the generator SplitMix64, started at seed, yields: the same on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dynalin {

struct SplineData;

struct SpectrumBands {
  double lowest = 0, highest = 0;  // f0, f1 [1/unit of x]
  std::int32_t count = 0;          // n
  bool logarithmic = false;
  std::int64_t seed = 0;
};

class HarmonicSignal {
 public:
  // Of data without fault.
  HarmonicSignal(const SplineData&, const SpectrumBands&);

  // T is double, TimeTaylor or Dual over them.
  template <class T>
  T at(const T& x) const;

  struct Harmonic {
    double amplitude, frequency, phase;
  };
  const std::vector<Harmonic>& harmonics() const { return harmonics_; }

 private:
  std::vector<Harmonic> harmonics_;
};

// Why data are no density that can be interpolated so, "value 3 of Y is -1"; empty if they are.
std::string why_no_spectrum(const SplineData&, bool logarithmic);

}  // namespace dynalin
