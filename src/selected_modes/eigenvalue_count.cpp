#include "selected_modes/eigenvalue_count.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dynalin {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;
// Of the logarithm. A phase is lost at π; of 3000 drawn discs with most eigenvalues unknown, steps of 1 gave 11 wrong
// counts, these none.
constexpr double largest_step = 0.5;
// Where pieces between two corners end, to begin with. In even pieces 16 eigenvalues missing in the middle of a circle
// would turn the phase of each by 2π, and be seen in none; in these nothing below 399 does.
constexpr std::array<double, 5> pieces{0, 0.2, 0.37, 0.68, 1};
constexpr double uneven_middle = 0.43;
constexpr double least_piece = 1e-9;  // of the border

class Winding {
 public:
  Winding(ShiftedLu& lu, const Border& border, const std::vector<Complex>& known, std::size_t most_points,
          const Progress& progress)
      : lu_(lu), border_(border), known_(known), most_points_(most_points), progress_(progress) {}

  // Of the smoothed determinant; nothing if the border is too near an eigenvalue.
  std::optional<double> phase() {
    for (std::size_t c = 0; c + 1 < border_.corners.size(); ++c) {
      const double from = border_.corners[c], to = border_.corners[c + 1];
      for (const double share : pieces) {
        if (share == 0 && c > 0) continue;  // the corner before
        if (!add(points_.end(), from + (to - from) * share)) return std::nullopt;
      }
    }
    // Of changes that are not seen for what they are, by 2π or more, some would be seen between these points: what half
    // as long pieces say again is taken.
    std::optional<double> before;
    for (;;) {
      smooth();
      double sum = 0;
      std::vector<double> all, large;
      for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
        const Complex change = points_[k + 1].rest - points_[k].rest;
        const double turned = std::remainder(change.imag(), 2 * pi), length = points_[k + 1].t - points_[k].t;
        sum += turned;
        all.push_back(points_[k].t + uneven_middle * length);
        if (std::abs(turned) <= largest_step && std::abs(change.real()) <= largest_step) continue;
        if (length < least_piece) return std::nullopt;
        large.push_back(all.back());
      }
      if (large.empty()) {
        if (before && std::abs(*before - sum) < 1) return sum;
        before = sum;
      }
      for (const double t : large.empty() ? all : large) {
        const auto next = std::find_if(points_.begin(), points_.end(), [&](const Point& p) { return p.t > t; });
        if (points_.size() >= most_points_ || !add(next, t)) return std::nullopt;
      }
    }
  }

 private:
  struct Point {
    double t;
    Complex place;      // in units of the region
    Complex logarithm;  // of the determinant without what is known
    Complex rest;       // without the polynomial
  };

  bool add(std::vector<Point>::iterator before, double t) {
    const Complex sigma = border_.at(t);
    progress_.tell([&] { return fmt::format("point {} of a border", points_.size() + 1); });
    if (!lu_.factor(sigma)) return false;
    Complex value = lu_.log_determinant();
    for (const Complex& p : known_) {
      if (sigma == p) return false;
      value -= std::log(sigma - p);
    }
    if (!std::isfinite(value.real()) || !std::isfinite(value.imag())) return false;
    points_.insert(before, {t, (sigma - border_.centre) / border_.radius, value, value});
    return true;
  }

  // The polynomial of least squares for the moduli; its coefficients are real where half a border stands for all.
  void smooth() {
    const auto rows = static_cast<Eigen::Index>(points_.size());
    const Eigen::Index degree = border_.upper_half ? rows / 4 : rows / 8, per_power = border_.upper_half ? 1 : 2;
    Eigen::MatrixXd powers(rows, 1 + per_power * degree);
    Eigen::VectorXd moduli(rows);
    std::vector<std::vector<Complex>> of_point;
    for (Eigen::Index r = 0; r < rows; ++r) {
      const Point& p = points_[static_cast<std::size_t>(r)];
      std::vector<Complex>& power = of_point.emplace_back(1, Complex(1));
      for (Eigen::Index k = 1; k <= degree; ++k) power.push_back(power.back() * p.place);
      moduli(r) = p.logarithm.real();
      powers(r, 0) = 1;
      for (Eigen::Index k = 1; k <= degree; ++k) {
        const Complex v = power[static_cast<std::size_t>(k)];
        powers(r, 1 + per_power * (k - 1)) = v.real();
        if (per_power == 2) powers(r, 2 * k) = -v.imag();
      }
    }
    const Eigen::VectorXd c = powers.colPivHouseholderQr().solve(moduli);
    for (Eigen::Index r = 0; r < rows; ++r) {
      Point& p = points_[static_cast<std::size_t>(r)];
      Complex sum = c(0);
      for (Eigen::Index k = 1; k <= degree; ++k) {
        const Eigen::Index at = 1 + per_power * (k - 1);
        sum += Complex(c(at), per_power == 2 ? c(at + 1) : 0) *
               of_point[static_cast<std::size_t>(r)][static_cast<std::size_t>(k)];
      }
      p.rest = p.logarithm - sum;
    }
  }

  ShiftedLu& lu_;
  const Border& border_;
  const std::vector<Complex>& known_;
  const std::size_t most_points_;
  const Progress& progress_;
  std::vector<Point> points_;
};

}  // namespace

Border circle(Complex centre, double radius) {
  if (centre.imag() == 0) {
    const auto at = [=](double t) -> Complex {
      if (t == 0 || t == 1) return centre.real() + (t == 0 ? radius : -radius);
      return centre + std::polar(radius, pi * t);
    };
    return {at, true, {0, 0.5, 1}, centre, radius};
  }
  return {[=](double t) { return centre + std::polar(radius, 2 * pi * t); },
          false,
          {0, 0.25, 0.5, 0.75, 1},
          centre,
          radius};
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
  const Complex centre(0.5 * (left + right), half ? 0 : 0.5 * (low + high));
  return {at, half, place, centre, std::abs(Complex(right, high) - centre)};
}

std::optional<Eigen::Index> eigenvalues_inside(ShiftedLu& lu, const Border& border, const std::vector<Complex>& known,
                                               const std::function<bool(Complex)>& inside,
                                               std::size_t most_factorizations, const Progress& progress) {
  const auto phase = Winding(lu, border, known, most_factorizations, progress).phase();
  if (!phase) return std::nullopt;
  const double turns = *phase / (border.upper_half ? pi : 2 * pi);
  // Both ends are real, or the same: what is not whole was not followed.
  if (std::abs(turns - std::round(turns)) > 1e-3) return std::nullopt;
  return static_cast<Eigen::Index>(std::lround(turns)) +
         static_cast<Eigen::Index>(std::count_if(known.begin(), known.end(), inside));
}

}  // namespace dynalin
