#include "selected_modes/mode_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/cycle.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;

}  // namespace

// Values v of A are found as 1/(v − σ), which converges to a hundredth of that, and non-normal ones are less sure.
bool KnownModes::is_real(Complex v, Complex shift) {
  constexpr double found_to = 1e-9;
  return std::abs(v.imag()) <= found_to * std::abs(v - shift);
}

KnownModes::KnownModes(const std::vector<Complex>& values, Complex shift) {
  std::vector<Complex> below;
  for (const Complex& v : values) {
    if (is_real(v, shift)) {
      upper_.emplace_back(v.real(), 0.0);
    } else {
      (v.imag() > 0 ? upper_ : below).push_back(v.imag() > 0 ? v : std::conj(v));
    }
  }
  // Each below is the other member of one above, or of a mode that is not above. Far from the shift both come with
  // roundings of their own: what has found no other at first may take one that is not as near.
  std::vector<bool> met(upper_.size(), false);
  for (const double as_near : {1e-6, 1e-3}) {
    std::erase_if(below, [&](Complex v) {
      std::size_t best = met.size();
      for (std::size_t k = 0; k < met.size(); ++k) {
        const bool free = !met[k] && upper_[k].imag() != 0;
        if (free && (best == met.size() || std::abs(upper_[k] - v) < std::abs(upper_[best] - v))) best = k;
      }
      if (best == met.size() || std::abs(upper_[best] - v) > as_near * std::abs(v)) return false;
      met[best] = true;
      return true;
    });
  }
  upper_.insert(upper_.end(), below.begin(), below.end());
}

std::vector<Complex> KnownModes::all() const {
  std::vector<Complex> both = upper_;
  for (const Complex& v : upper_) {
    if (v.imag() != 0) both.push_back(std::conj(v));
  }
  return both;
}

bool belongs_to(const ModesInBand& band, Complex value, double bound) {
  constexpr double of_conversion = 4 * std::numeric_limits<double>::epsilon();
  const double size = std::abs(value), slack = std::clamp(bound, of_conversion * size, equal_distances * size);
  const double f = std::abs(value.imag());
  return f >= band.low - slack && f <= band.high + slack && std::abs(value.real()) <= band.high + slack;
}

bool ModeRegion::has(Complex v) const {
  if (is_disc) return std::abs(v - centre) <= radius;
  const double slack = equal_distances * std::abs(v), f = std::abs(v.imag());
  return f >= low - slack && f <= high + slack && v.real() >= left - slack && v.real() <= right + slack;
}

double ModeRegion::distance_to_border(Complex v) const {
  if (is_disc) return std::abs(std::abs(v - centre) - radius);
  const double f = std::abs(v.imag());
  const double out_re = std::max({left - v.real(), v.real() - right, 0.0}),
               out_im = std::max({low > 0 ? low - f : 0.0, f - high, 0.0});
  if (out_re > 0 || out_im > 0) return std::hypot(out_re, out_im);
  const double of_im = low > 0 ? std::min(f - low, high - f) : high - f;
  return std::min({v.real() - left, right - v.real(), of_im});
}

Border ModeRegion::border() const { return is_disc ? circle(centre, radius) : rectangle(left, right, low, high); }

Eigen::Index ModeRegion::count(const KnownModes& modes) const {
  const auto all = modes.all();
  return static_cast<Eigen::Index>(std::count_if(all.begin(), all.end(), [&](Complex v) { return has(v); }));
}

std::optional<ModeRegion> disc_of(const NearestModes& wanted, const KnownModes& modes, Eigen::Index zeros,
                                  bool everything) {
  ModeRegion disc;
  disc.centre = {0, cycle * wanted.frequency};
  std::vector<Complex> others = modes.upper();
  std::sort(others.begin(), others.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  others.erase(others.begin(), others.begin() + std::min(zeros, static_cast<Eigen::Index>(others.size())));
  std::sort(others.begin(), others.end(),
            [&](Complex a, Complex b) { return std::abs(a - disc.centre) < std::abs(b - disc.centre); });
  const auto distance = [&](std::size_t k) { return std::abs(others[k] - disc.centre); };
  if (others.empty() || wanted.count == 0) {
    if (wanted.count == 0 || everything) return disc;
    return std::nullopt;
  }
  std::size_t last = std::min(wanted.count, others.size()) - 1;
  while (last + 1 < others.size() &&
         distance(last + 1) <= distance(last) + equal_distances * std::max(std::abs(others[last]), disc.centre.imag()))
    ++last;
  if (last + 1 < others.size()) {
    disc.radius = 0.5 * (distance(last) + distance(last + 1));
  } else if (everything) {
    disc.radius = 2 * distance(last);
  } else {
    return std::nullopt;
  }
  return disc;
}

ModeRegion region_of(const ModesInBand& band) {
  ModeRegion r;
  r.is_disc = false;
  r.low = cycle * band.low, r.high = cycle * band.high;
  r.left = -r.high, r.right = r.high;
  return r;
}

ModeRegion countable(const ModeRegion& region, const KnownModes& modes, int attempt) {
  const auto all = modes.all();
  if (region.is_disc) {
    // Between the moduli of the last inside and the first outside, of both members of pairs.
    double inside = 0, outside = 2 * region.radius;
    for (const Complex& v : all) {
      const double d = std::abs(v - region.centre);
      if (d <= region.radius) inside = std::max(inside, d);
      if (d > region.radius) outside = std::min(outside, d);
    }
    constexpr double shares[] = {0.5, 0.37, 0.63, 0.26, 0.74};
    ModeRegion moved = region;
    moved.radius = inside + shares[attempt % 5] * (outside - inside);
    return moved;
  }
  ModeRegion best = region;
  double farthest = -1;
  for (int k = 0; k < 6; ++k) {
    const double by = (1 + 0.13 * attempt) * 1e-3 * std::pow(2.0, k) * (region.high - region.low);
    ModeRegion moved = region;
    moved.high += by, moved.left -= by, moved.right += by;
    if (region.low > 0) moved.low = std::max(moved.low - by, 0.5 * moved.low);
    double nearest = by;
    for (const Complex& v : all) nearest = std::min(nearest, moved.distance_to_border(v));
    if (nearest > 1.5 * farthest) farthest = nearest, best = moved;
  }
  return best;
}

}  // namespace dynalin
