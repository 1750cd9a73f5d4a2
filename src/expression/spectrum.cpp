#include "expression/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "expression/functions.h"
#include "expression/spline.h"

namespace dynalin {

namespace {

// SplitMix64 (Steele, Lea, Flood 2014); the 53 highest bits as a number in [0, 1).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  double next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

// ∫ of the straight line through (x0, y0) and (x1, y1) from a to b.
double area_of_line(double x0, double y0, double x1, double y1, double a, double b) {
  const double slope = (y1 - y0) / (x1 - x0);
  return (b - a) * (y0 + slope * (0.5 * (a + b) - x0));
}

// The same where the line is one in the logarithms, y = y0 (x/x0)^m:
// ∫ = y_a a (e^{(m+1) ℓ} − 1)/(m + 1) with ℓ = ln(b/a).
double area_of_power(double x0, double y0, double x1, double y1, double a, double b) {
  const double m = std::log(y1 / y0) / std::log(x1 / x0), l = std::log(b / a), q = (m + 1) * l;
  const double at_a = y0 * std::pow(a / x0, m);
  return at_a * a * l * (q == 0.0 ? 1.0 : std::expm1(q) / q);
}

double power_between(const SplineData& d, bool logarithmic, double low, double high) {
  const std::vector<double>&x = d.x, &y = d.y[0];
  double sum = 0;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    const double a = std::max(low, x[k]), b = std::min(high, x[k + 1]);
    if (!(a < b)) continue;
    sum += logarithmic ? area_of_power(x[k], y[k], x[k + 1], y[k + 1], a, b)
                       : area_of_line(x[k], y[k], x[k + 1], y[k + 1], a, b);
  }
  return sum;
}

}  // namespace

HarmonicSignal::HarmonicSignal(const SplineData& data, const SpectrumBands& bands) {
  SplitMix64 random(static_cast<std::uint64_t>(bands.seed));
  const double width = (bands.highest - bands.lowest) / bands.count;
  const auto edge = [&](std::int32_t k) { return k == bands.count ? bands.highest : bands.lowest + k * width; };
  for (std::int32_t k = 0; k < bands.count; ++k) {
    const double power = power_between(data, bands.logarithmic, edge(k), edge(k + 1));
    harmonics_.push_back(
        {std::sqrt(2.0 * std::max(0.0, power)), 0.5 * (edge(k) + edge(k + 1)), 2.0 * std::numbers::pi * random.next()});
  }
}

template <class T>
T HarmonicSignal::at(const T& x) const {
  using std::sin;
  T sum(0.0);
  for (const Harmonic& h : harmonics_) {
    sum += h.amplitude * sin(T(2.0 * std::numbers::pi * h.frequency * x + T(h.phase)));
  }
  return sum;
}

std::string why_no_spectrum(const SplineData& d, bool logarithmic) {
  if (d.y.size() != 1) return "it is a family of curves";
  for (std::size_t k = 0; k < d.x.size(); ++k) {
    if (d.x[k] < 0 || (logarithmic && d.x[k] == 0)) return fmt::format("value {} of X is {:g}", k + 1, d.x[k]);
    if (d.y[0][k] < 0 || (logarithmic && d.y[0][k] == 0)) return fmt::format("value {} of Y is {:g}", k + 1, d.y[0][k]);
  }
  return {};
}

template double HarmonicSignal::at(const double&) const;
template TimeTaylor<double> HarmonicSignal::at(const TimeTaylor<double>&) const;
template Seeded HarmonicSignal::at(const Seeded&) const;
template TimeTaylor<Seeded> HarmonicSignal::at(const TimeTaylor<Seeded>&) const;

}  // namespace dynalin
