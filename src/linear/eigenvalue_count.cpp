#include "linear/eigenvalue_count.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynalin {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;
constexpr double largest_step = 1.0;  // of log; a phase is lost at π
constexpr int most_divisions = 24;
constexpr int pieces = 4;  // between two corners, to begin with

class Winding {
 public:
  Winding(ShiftedLu& lu, const Border& border, const std::vector<Complex>& known)
      : lu_(lu), border_(border), known_(known) {}

  // Of the smoothed determinant; nothing if the border is too near an eigenvalue.
  std::optional<double> phase() {
    double sum = 0;
    for (std::size_t c = 0; c + 1 < border_.corners.size(); ++c) {
      const double from = border_.corners[c], to = border_.corners[c + 1];
      for (int k = 0; k < pieces; ++k) {
        const double a = from + (to - from) * k / pieces, b = from + (to - from) * (k + 1) / pieces;
        if (!last_ && !(last_ = logarithm(a))) return std::nullopt;
        const auto next = logarithm(b);
        if (!next) return std::nullopt;
        const auto change = between(a, *last_, b, *next, 0);
        if (!change) return std::nullopt;
        sum += *change;
        last_ = next;
      }
    }
    return sum;
  }

 private:
  std::optional<Complex> logarithm(double t) {
    const Complex sigma = border_.at(t);
    if (!lu_.factor(sigma)) return std::nullopt;
    Complex value = lu_.log_determinant();
    for (const Complex& p : known_) {
      if (sigma == p) return std::nullopt;
      value -= std::log(sigma - p);
    }
    if (!std::isfinite(value.real()) || !std::isfinite(value.imag())) return std::nullopt;
    return value;
  }
  std::optional<double> between(double a, Complex at_a, double b, Complex at_b, int divisions) {
    const double turned = std::remainder(at_b.imag() - at_a.imag(), 2 * pi);
    if (std::abs(turned) <= largest_step && std::abs(at_b.real() - at_a.real()) <= largest_step) return turned;
    if (divisions == most_divisions) return std::nullopt;
    const double m = 0.5 * (a + b);
    const auto middle = logarithm(m);
    if (!middle) return std::nullopt;
    const auto first = between(a, at_a, m, *middle, divisions + 1);
    if (!first) return std::nullopt;
    const auto second = between(m, *middle, b, at_b, divisions + 1);
    if (!second) return std::nullopt;
    return *first + *second;
  }

  ShiftedLu& lu_;
  const Border& border_;
  const std::vector<Complex>& known_;
  std::optional<Complex> last_;
};

}  // namespace

Border circle(Complex centre, double radius) {
  if (centre.imag() == 0) {
    const auto at = [=](double t) -> Complex {
      if (t == 0 || t == 1) return centre.real() + (t == 0 ? radius : -radius);
      return centre + std::polar(radius, pi * t);
    };
    return {at, true, {0, 0.5, 1}};
  }
  return {[=](double t) { return centre + std::polar(radius, 2 * pi * t); }, false, {0, 0.25, 0.5, 0.75, 1}};
}

Border rectangle(double left, double right, double low, double high) {
  std::vector<Complex> corner{{right, low}, {right, high}, {left, high}, {left, low}};
  const bool half = low <= 0;
  if (half) {
    corner.front().imag(0), corner.back().imag(0);
  } else {
    corner.push_back(corner.front());
  }
  std::vector<double> place{0};
  for (std::size_t k = 1; k < corner.size(); ++k) place.push_back(place.back() + std::abs(corner[k] - corner[k - 1]));
  for (double& p : place) p /= place.back();
  const auto at = [corner, place](double t) {
    std::size_t k = 1;
    while (k + 1 < place.size() && t > place[k]) ++k;
    const double share = (t - place[k - 1]) / (place[k] - place[k - 1]);
    return share <= 0 ? corner[k - 1] : share >= 1 ? corner[k] : corner[k - 1] + share * (corner[k] - corner[k - 1]);
  };
  return {at, half, place};
}

std::optional<Eigen::Index> eigenvalues_inside(ShiftedLu& lu, const Border& border, const std::vector<Complex>& known,
                                               const std::function<bool(Complex)>& inside) {
  const auto phase = Winding(lu, border, known).phase();
  if (!phase) return std::nullopt;
  const double turns = *phase / (border.upper_half ? pi : 2 * pi);
  // Both ends are real, or the same: what is not whole was not followed.
  if (std::abs(turns - std::round(turns)) > 1e-3) return std::nullopt;
  return static_cast<Eigen::Index>(std::lround(turns)) +
         static_cast<Eigen::Index>(std::count_if(known.begin(), known.end(), inside));
}

}  // namespace dynalin
