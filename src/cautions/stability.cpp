#include "cautions/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "analysis/displace.h"
#include "analysis/rest_beside.h"
#include "base/clearly_larger.h"
#include "base/cycle.h"
#include "base/dense_products.h"
#include "eigenvalues/eigen.h"
#include "eigenvalues/rounding.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;

// Of the modulus of a value: what grows more slowly than that is taken for a swing.
constexpr double least_growth = 1e-9;
// What a rate of growth may be off, of the fastest rate of the model, where one cannot be told from none.
constexpr double unnoticed = 1e-7;

struct Value {
  std::complex<double> hz;
  double bound;

  double most() const { return hz.real() + bound; }
  // A zero that is computed is as large as its bound to first order makes it, by a hair more or less.
  bool grows() const { return hz.real() > 2 * bound && hz.real() > least_growth * std::abs(hz); }
  bool does_not_grow() const { return most() <= std::max(0.0, least_growth * std::abs(hz)); }
};

// All eigenvalues but the structural zeros, and their vectors in columns.
struct Spectrum {
  std::vector<Value> values;
  Eigen::MatrixXcd vectors;

  double largest() const {
    double modulus = 0;
    for (const Value& v : values) modulus = std::max(modulus, std::abs(v.hz));
    return modulus;
  }
};

std::optional<LinearSystem> linear_at(const System& system, const OperatingPoint& op, std::string& reason) {
  auto linear = linearize(system, op, {});
  if (linear) return std::move(*linear);
  reason = linear.error().message;
  return std::nullopt;
}

ZeroModes zeros_of(const LinearSystem& linear) {
  return split_zero_modes(linear.A, linear.rounding, linear.structural_zeros.get());
}

// To first order, of the residual and of rounding: |δλ| ≤ |y|ᵀ(|A x − λ x| + (n ε |A| + uncertainty) |x|) / |yᴴx|.
std::vector<Value> bounded(const LinearSystem& linear, const EigenPairs& pairs) {
  if (pairs.values.empty()) return {};
  const auto n = static_cast<double>(linear.A.rows());
  const Matrix off = n * eps * linear.A.cwiseAbs() + linear.rounding + linear.uncertainty;
  const Matrix spread = off * pairs.right.cwiseAbs();
  const Eigen::MatrixXcd image = real_product(linear.A, pairs.right);
  std::vector<Value> values;
  for (std::size_t k = 0; k < pairs.values.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const Eigen::VectorXd residual = (image.col(at) - pairs.values[k] * pairs.right.col(at)).cwiseAbs();
    const double off_by = pairs.left.col(at).cwiseAbs().dot(residual + spread.col(at));
    values.push_back({pairs.values[k] / cycle, off_by / std::abs(pairs.left.col(at).dot(pairs.right.col(at))) / cycle});
  }
  return values;
}

// As the QR iteration gives it where that says of each value which way it goes, and refined otherwise.
std::optional<Spectrum> spectrum_of(const LinearSystem& linear, std::string& reason) {
  if (const auto quick = unrefined_pairs(linear)) {
    auto values = bounded(linear, quick->pairs);
    if (std::all_of(values.begin(), values.end(), [](const Value& v) { return v.grows() || v.does_not_grow(); }))
      return Spectrum{std::move(values), quick->pairs.right};
  }
  const auto solution = eigensolve(linear);
  if (!solution) {
    reason = solution.error().message;
    return std::nullopt;
  }
  Spectrum spectrum;
  std::vector<Eigen::Index> columns;
  for (std::size_t k = 0; k < solution->modes.size(); ++k) {
    const EigenMode& m = solution->modes[k];
    if (m.structural_zero) continue;
    spectrum.values.push_back({m.eigenvalue_hz, m.error_bound_hz});
    columns.push_back(static_cast<Eigen::Index>(k));
  }
  spectrum.vectors = solution->vectors(Eigen::all, columns);
  return spectrum;
}

// Which values cannot be told from zero, or are so small beside the fastest that what makes them may be no more than
// that the equilibrium is known to rounding.
std::vector<std::size_t> slow_ones(const std::vector<Value>& values, double limit) {
  std::vector<std::size_t> slow;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::abs(values[k].hz) <= std::max(limit, values[k].bound)) slow.push_back(k);
  }
  return slow;
}

// Whether time may as well run backwards: displacements make accelerations and rates make displacements, nothing else.
bool is_reversible(const LinearSystem& linear) {
  if (linear.differential_states > 0) return false;
  for (std::size_t r = 0; r < linear.model.states.size(); ++r) {
    for (std::size_t c = 0; c < linear.model.states.size(); ++c) {
      if (linear.model.states[r].is_rate == linear.model.states[c].is_rate &&
          linear.A(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) != 0)
        return false;
    }
  }
  return true;
}

// With λ also −λ̄ is an eigenvalue there: where a circle around the imaginary axis holds one alone, it is on the axis.
bool stays_on_axis(const std::vector<Value>& values, std::size_t which) {
  const Value& v = values[which];
  const double radius = v.bound + std::abs(v.hz.real());
  if (!(std::abs(v.hz.imag()) > radius)) return false;
  const std::complex<double> centre(0, v.hz.imag());
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k != which && std::abs(values[k].hz - centre) <= radius + values[k].bound) return false;
  }
  return true;
}

// How all coordinates move along what the linear model leaves free, its zeros and modes that are hardly more: motions
// of which none is made of the others, each of unit size in its largest coordinate.
Matrix free_motions(const System& system, const LinearSystem& linear, const ZeroModes& zeros,
                    const Eigen::MatrixXcd& slow) {
  constexpr double moves_nothing = 1e-8;  // of a vector of unit length, what is computed of displacements
  constexpr double same_motion = 1e-4;    // what is left of one beside others says how far both are known
  const Matrix of_zeros = linear.displacements(zeros.vectors().cast<std::complex<double>>()).real();
  const Eigen::MatrixXcd of_slow = linear.displacements(slow);
  Matrix motions(of_zeros.rows(), of_zeros.cols() + 2 * of_slow.cols());
  motions.leftCols(of_zeros.cols()) = of_zeros;
  motions.middleCols(of_zeros.cols(), of_slow.cols()) = of_slow.real();
  motions.rightCols(of_slow.cols()) = of_slow.imag();
  Eigen::VectorXd unit(motions.rows());
  for (Eigen::Index c = 0; c < unit.size(); ++c) unit(c) = system.coordinate_scale(static_cast<std::int32_t>(c));
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    const double size = motions.col(k).cwiseQuotient(unit).lpNorm<Eigen::Infinity>();
    if (!(size > (k < of_zeros.cols() ? 0.0 : moves_nothing))) motions.col(k).setZero();
  }
  motions = basis_of_motions(motions, unit, same_motion);
  for (Eigen::Index k = 0; k < motions.cols(); ++k)
    motions.col(k) /= motions.col(k).cwiseQuotient(unit).lpNorm<Eigen::Infinity>();
  return motions;
}

// All of them together, in different shares.
Eigen::VectorXd together(const Matrix& motions) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(motions.rows());
  double share = 1;
  for (Eigen::Index k = 0; k < motions.cols(); ++k, share *= -std::numbers::phi / 2) sum += share * motions.col(k);
  return sum;
}

std::string largest_of(const System& system, const Eigen::VectorXd& motion) {
  std::int32_t most = 0;
  double size = 0;
  for (std::int32_t c = 0; c < motion.size(); ++c) {
    const double moved = std::abs(motion(c)) / system.coordinate_scale(c);
    if (is_clearly_larger(moved, size, equal_solutions)) size = moved, most = c;
  }
  return system.layout().coordinate_text(most);
}

// Whether motions that nothing resists here are resisted, or driven, a little further on: then their force begins with
// a higher order than the linear model has. Where the model is free it stays so. A way that is straight in the
// coordinates leaves the equilibria that lie along a curve, as those of a part that turns about an axis far from its
// BCS: everything but the motions is brought to rest again.
bool is_free_here_alone(const System& system, const OperatingPoint& at_rest, const Matrix& motions, Eigen::Index zeros,
                        std::size_t slow, double limit) {
  constexpr double as_slow = 10;  // times the limit, or what is a little faster there would be taken for held
  const auto displaced = [&](double distance) {
    OperatingPoint there = at_rest;
    displace(system, there, distance * together(motions), {1.0});
    Findings ignored;
    if (auto rest = rest_beside(system, there, motions)) there = std::move(*rest);
    auto moved = assemble_position(system, std::move(there), ignored);
    return moved ? solve_acceleration(system, std::move(*moved), ignored) : moved;
  };
  // Where rounding hides all that is done about it, accelerations have lost it already: a higher order grows faster.
  Result<OperatingPoint> moved;
  for (const double distance : {1e-3, 1e-2, 1e-1}) {
    moved = displaced(distance);
    if (!moved || std::ranges::any_of(moved->acceleration, [](double a) { return a != 0; })) break;
  }
  if (!moved) return true;
  if (std::ranges::all_of(moved->acceleration, [](double a) { return a == 0; })) return false;
  std::string unused;
  const auto beside = linear_at(system, *moved, unused);
  if (!beside) return true;
  const Eigen::Index zeros_beside = zeros_of(*beside).count;
  if (zeros_beside >= zeros + static_cast<Eigen::Index>(slow)) return false;
  const auto spectrum = spectrum_of(*beside, unused);
  if (!spectrum) return true;
  const auto slow_beside = static_cast<Eigen::Index>(slow_ones(spectrum->values, as_slow * limit).size());
  return zeros_beside + slow_beside < zeros + static_cast<Eigen::Index>(slow);
}

}  // namespace

Stability stability_of(const System& system, const OperatingPoint& at_rest) {
  constexpr std::size_t affordable = 600;  // states at most
  Stability s;
  if (2 * system.coordinates() + system.layout().states.size() > affordable) {
    s.reason = "the model is too large to look at it in passing, LINEAR/EIGENSOL tells";
    return s;
  }
  const auto linear = linear_at(system, at_rest, s.reason);
  const auto spectrum = linear ? spectrum_of(*linear, s.reason) : std::nullopt;
  if (!spectrum) return s;
  double hidden = 0;
  const bool reversible = is_reversible(*linear);
  for (std::size_t k = 0; k < spectrum->values.size(); ++k) {
    const Value& v = spectrum->values[k];
    if (v.grows()) {
      ++s.growing_modes;
    } else if (!v.does_not_grow() && !(reversible && stays_on_axis(spectrum->values, k))) {
      hidden = std::max(hidden, v.most());
    }
  }
  if (s.growing_modes > 0) {
    s.verdict = Stability::Verdict::unstable;
    return s;
  }
  const double limit = unnoticed * spectrum->largest();
  if (hidden > limit) {
    s.reason = fmt::format("rounding hides whether a mode grows by up to {:.2g} cycles per time", hidden);
    return s;
  }
  const ZeroModes zeros = zeros_of(*linear);
  const std::vector<std::size_t> slow = slow_ones(spectrum->values, limit);
  Eigen::MatrixXcd slow_vectors(linear->A.rows(), static_cast<Eigen::Index>(slow.size()));
  for (std::size_t k = 0; k < slow.size(); ++k)
    slow_vectors.col(static_cast<Eigen::Index>(k)) = spectrum->vectors.col(static_cast<Eigen::Index>(slow[k]));
  const Matrix motions = free_motions(system, *linear, zeros, slow_vectors);
  if (motions.size() > 0 && is_free_here_alone(system, at_rest, motions, zeros.count, slow.size(), limit)) {
    s.reason =
        fmt::format("to first order nothing holds {} here, and beside this point something does or drives it away",
                    largest_of(system, together(motions)));
    return s;
  }
  s.verdict = Stability::Verdict::stable;
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
