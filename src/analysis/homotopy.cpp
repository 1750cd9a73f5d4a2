#include "analysis/homotopy.h"

#include <algorithm>
#include <cmath>

#include "analysis/balance.h"
#include "analysis/static_step.h"

namespace dynalin {

namespace {

// Relative; keeps the matrix regular where a freedom or an integrator is indifferent.
constexpr double regularization = 1e-10;

class Curve {
 public:
  Curve(StaticEquations& equations, const OperatingPoint& start) : equations_(equations), system_(equations.system()) {
    equations_.evaluate(start, Partials::yes);
    load_ = equations_.residual();
    const AugmentedSystem& augmented = equations_.augmented();
    load_.segment(augmented.lambda(0), augmented.algebraic(0) - augmented.lambda(0)).setZero();
    force_ = equations_.force_scale();
    here_ = {start, 0};
    weigh(start);
  }

  std::optional<OperatingPoint> follow(bool forward, const HomotopyOptions& options) {
    const auto n = equations_.augmented().size();
    if (!load_.allFinite() || equations_.merit(force_) == 0) return std::nullopt;
    Eigen::VectorXd border = Eigen::VectorXd::Zero(n + 1);
    border(n) = forward ? 1 : -1;
    auto tangent = direction(border);
    if (!tangent) {
      // A limit point to begin with: any border that is not orthogonal to the curve will do.
      for (Eigen::Index k = 0; k < n; ++k) border(k) = std::cos(1.0 + 0.7 * static_cast<double>(k)) * weight_(k);
      tangent = direction(border);
    }
    double length = std::min(0.02, options.longest_step);
    for (int step = 0; step < options.step_limit && tangent && length > 1e-7;) {
      const Eigen::VectorXd metric = weight_.cwiseProduct(weight_).cwiseProduct(*tangent);
      int iterations = 0;
      auto next = corrected(at(here_, *tangent, length), metric, iterations);
      if (next && (here_.s < 1) != (next->s < 1)) {
        if (auto rest = corrected({next->op, 1}, {}, iterations)) return rest->op;
        next.reset();
      }
      std::optional<Eigen::VectorXd> turned;
      if (next) turned = direction(metric);
      // cos of the angle between two tangents; a sharp turn means that the step may have left the curve.
      const double along = turned ? metric.dot(*turned) : 0;
      if (along < 0.8) {
        length *= 0.4;
        continue;
      }
      here_ = std::move(*next);
      system_.remember(here_.op);
      tangent = std::move(turned);
      if (iterations <= 4 && along > 0.95) length = std::min(1.6 * length, options.longest_step);
      ++step;
    }
    return std::nullopt;
  }

 private:
  struct Place {
    OperatingPoint op;
    double s = 0;
  };

  // The metric of the arc length. Reactions follow from the rest and do not count.
  void weigh(const OperatingPoint& op) {
    const AugmentedSystem& augmented = equations_.augmented();
    weight_ = Eigen::VectorXd::Ones(augmented.size() + 1);
    weight_.head(augmented.size()) = equations_.column_units(op).cwiseInverse();
    weight_.segment(augmented.lambda(0), augmented.algebraic(0) - augmented.lambda(0)).setZero();
  }

  // ⎡ H_x  H_s ⎤
  // ⎣ border    ⎦ at the point that was evaluated last; without a border, H_x alone with s fixed.
  ColumnMatrix matrix(const Eigen::VectorXd& border) const {
    const ColumnMatrix J = equations_.tangent(regularization, regularization);
    std::vector<Triplet> entries;
    for_each_entry(J, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
    for (std::int32_t k = 0; k < J.rows; ++k) {
      entries.push_back({k, J.columns, load_(k)});
      if (border.size() > 0) entries.push_back({J.rows, k, border(k)});
    }
    entries.push_back({J.rows, J.columns, border.size() > 0 ? border(J.columns) : 1.0});
    return compressed(J.rows + 1, J.columns + 1, entries);
  }

  // The unit tangent of the curve with border · t > 0.
  std::optional<Eigen::VectorXd> direction(const Eigen::VectorXd& border) {
    if (!equations_.residual().allFinite() || !equations_.factor(lu_, matrix(border))) return std::nullopt;
    Eigen::MatrixXd t = Eigen::MatrixXd::Zero(border.size(), 1);
    t(border.size() - 1, 0) = 1;
    lu_.solve(t);
    const double size = weight_.cwiseProduct(t.col(0)).norm();
    if (!std::isfinite(size) || size == 0) return std::nullopt;
    return Eigen::VectorXd(t.col(0) / size);
  }

  Place at(const Place& from, const Eigen::VectorXd& tangent, double length) const {
    return {moved(system_, from.op, equations_.augmented(), tangent, length, {1.0}),
            from.s + length * tangent(tangent.size() - 1)};
  }

  // Newton back to the curve across the border, or at fixed s without one.
  std::optional<Place> corrected(Place p, const Eigen::VectorXd& border, int& iterations) {
    const auto n = equations_.augmented().size();
    double before = std::numeric_limits<double>::infinity();
    for (iterations = 0; iterations < 10; ++iterations) {
      equations_.evaluate(p.op, Partials::yes);
      Eigen::MatrixXd step = Eigen::MatrixXd::Zero(n + 1, 1);
      step.col(0).head(n) = (1 - p.s) * load_ - equations_.residual();
      const double level = std::sqrt(equations_.merit(step.col(0).head(n), force_));
      if (!std::isfinite(level) || level > 10 * before) return std::nullopt;
      if (level < force_balance) return p;
      before = level;
      if (!equations_.factor(lu_, matrix(border))) return std::nullopt;
      lu_.solve(step);
      if (weight_.cwiseProduct(step.col(0)).norm() > 1) return std::nullopt;
      p = at(p, step.col(0), 1);
    }
    return std::nullopt;
  }

  StaticEquations& equations_;
  const System& system_;
  Eigen::VectorXd load_, weight_;
  SparseLu lu_;
  double force_ = 1;
  Place here_;
};

}  // namespace

std::optional<OperatingPoint> follow_to_rest(StaticEquations& equations, const OperatingPoint& start, bool forward,
                                             const HomotopyOptions& options) {
  return Curve(equations, start).follow(forward, options);
}

}  // namespace dynalin
