#include "routine/differences.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynalin {

namespace {
constexpr double first_step = 1.0 / 128;  // of the size of x, 1 at least
constexpr std::size_t most_steps = 24, most_orders = 4;
constexpr double good_enough = 1e-11;  // relative change of the last extrapolation
// The best extrapolation may be off by this part of itself, or make as little difference over the first step.
constexpr double disagreement = 0.01, hidden_by_rounding = 1e-6;

thread_local std::uint64_t counted_in_linear_models = 0;
}  // namespace

// Central differences are even in the step h, so that halving it removes h², h⁴ ... one after the other. The row whose
// extrapolations agree best counts: first the steps are too wide, at last rounding rules.
std::vector<Slope> extrapolated_slope(const std::function<void(double, std::span<double>)>& f, double x,
                                      std::size_t values) {
  struct Column {
    std::vector<double> row;
    double best = std::numeric_limits<double>::quiet_NaN(), error = std::numeric_limits<double>::infinity();
  };
  std::vector<Column> columns(values);
  std::vector<double> above(values), below(values);
  double h = first_step * std::max(1.0, std::abs(x));
  for (std::size_t step = 0; step < most_steps; ++step, h /= 2) {
    const double up = x + h, down = x - h;
    if (up == x || down == x) break;
    f(up, above), f(down, below);
    bool done = true;
    for (std::size_t v = 0; v < values; ++v) {
      Column& c = columns[v];
      std::vector<double> next = {(above[v] - below[v]) / (up - down)};
      double factor = 4;
      for (std::size_t k = 0; k < std::min(c.row.size(), most_orders); ++k, factor *= 4) {
        next.push_back((factor * next[k] - c.row[k]) / (factor - 1));
        const double error = std::max(std::abs(next[k + 1] - next[k]), std::abs(next[k + 1] - c.row[k]));
        if (error < c.error) c.error = error, c.best = next[k + 1];
      }
      c.row = std::move(next);
      done = done && c.error <= good_enough * std::abs(c.best);
    }
    if (done) break;
  }
  const double width = first_step * std::max(1.0, std::abs(x));
  std::vector<Slope> slope;
  for (std::size_t v = 0; v < values; ++v) {
    const Column& c = columns[v];
    const double size = std::max(std::abs(above[v]), std::abs(below[v]));
    slope.push_back(
        {c.best, c.error <= disagreement * std::abs(c.best) || c.error * width <= hidden_by_rounding * size});
  }
  return slope;
}

std::uint64_t differences_in_linear_models() { return counted_in_linear_models; }
void count_difference_in_linear_model() { ++counted_in_linear_models; }

}  // namespace dynalin
