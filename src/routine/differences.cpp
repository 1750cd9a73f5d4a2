#include "routine/differences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace dynalin {

namespace {

constexpr double first_step = 1.0 / 128;  // of the size of x, 1 at least
constexpr std::size_t most_steps = 24, least_steps = 4, most_orders = 4;
constexpr double good_enough = 1e-11;  // relative change of the last extrapolation
// The best extrapolation may be off by this part of itself, or make as little difference over the first step.
constexpr double disagreement = 0.01, hidden_by_rounding = 1e-6;

using ValuesAt = std::function<void(double, std::span<double>)>;
constexpr double infinity = std::numeric_limits<double>::infinity();

double largest(double a, double b) { return std::max(std::abs(a), std::abs(b)); }

// One step on both sides of x.
struct Row {
  double step = 0;        // half the way from below to above
  double difference = 0;  // the central one, as it is
  double half_bend = 0;   // half of what the slopes on both sides differ by
  std::vector<double> extrapolated = {};
  double best = 0, error = infinity;  // of the extrapolations
};

// What one value does, row by row.
class Course {
 public:
  void add(double step, double below, double here, double above) {
    Row row{step, (above - below) / (2 * step), (above - 2 * here + below) / (2 * step)};
    row.extrapolated = {row.difference};
    const std::vector<double> none, &before = rows_.empty() ? none : rows_.back().extrapolated;
    double factor = 4;
    for (std::size_t k = 0; k < std::min(before.size(), most_orders); ++k, factor *= 4) {
      const double next = (factor * row.extrapolated[k] - before[k]) / (factor - 1);
      row.extrapolated.push_back(next);
      const double error = largest(next - row.extrapolated[k], next - before[k]);
      if (error < row.error) row.error = error, row.best = next;
    }
    size_ = largest(above, below);
    rows_.push_back(std::move(row));
  }

  // Nothing that further steps could tell: the last row is good, and what the earlier ones made of themselves agrees.
  bool settled() const {
    if (rows_.size() < least_steps) return false;
    const Row& last = rows_.back();
    if (std::ranges::all_of(rows_, [](const Row& r) { return r.difference == 0; })) return true;
    return last.error <= good_enough * std::abs(last.best) && std::ranges::all_of(rows_, [&](const Row& r) {
             return !(r.error <= disagreement * std::abs(r.best)) ||
                    std::abs(r.best - last.best) <= 4 * r.error + disagreement * disagreement * std::abs(last.best);
           });
  }

  // The step below which nothing is seen of what wider steps show: the function may have grains of such a size.
  std::optional<double> grain() const {
    const auto seen = std::find_if(rows_.rbegin(), rows_.rend(), [](const Row& r) { return r.difference != 0; });
    if (seen == rows_.rend() || seen == rows_.rbegin()) return std::nullopt;
    return seen->step;
  }

  // `noise` is how far values lie beside the smooth law that they stand for.
  Slope slope(double noise, double width) const {
    std::size_t best = 0;
    double least = infinity;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      double error = rows_[i].error + noise / rows_[i].step;
      // What smaller steps see beside the slope is noise, or a jump: of the same size in every step.
      for (std::size_t j = i + 1; j < rows_.size(); ++j)
        error = std::max(error, std::abs(rows_[j].difference - rows_[i].best) * rows_[j].step / rows_[i].step);
      if (error < least) least = error, best = i;
    }
    if (least == infinity) return {std::numeric_limits<double>::quiet_NaN(), infinity, false};
    const double value = rows_[best].best, unseen = hidden_by_rounding * size_ / width;
    Slope found{value, least, least <= disagreement * std::abs(value) || least <= unseen, unseen};
    found.half_kink = half_kink(best, least);
    return found;
  }

 private:
  // Of a smooth law the bend halves with the step, at a kink it stays.
  double half_kink(std::size_t at, double error) const {
    if (rows_.size() < 3) return 0;
    at = std::max(at, std::size_t{2});
    const double last = rows_[at].half_bend;
    const bool seen = std::abs(last) > std::max(disagreement * std::abs(rows_[at].best), 8 * error);
    const bool stays = std::abs(rows_[at - 2].half_bend - last) < 0.25 * std::abs(last);
    return seen && stays ? last : 0;
  }

  std::vector<Row> rows_;
  double size_ = 0;  // of the values at the last step
};

// From the differences of third and fourth order of neighbouring values, which a smooth law has none of (Moré and
// Wild).
constexpr std::size_t noise_points = 24;
double noise_of(std::array<double, noise_points> d) {
  double noise = 0;
  for (std::size_t order = 1; order <= 4; ++order) {
    for (std::size_t p = 0; p + order < noise_points; ++p) d[p] = d[p + 1] - d[p];
    const double gain = order == 3 ? std::sqrt(20.0) : std::sqrt(70.0);  // of independent errors
    for (std::size_t p = 0; order >= 3 && p + order < noise_points; ++p) noise = std::max(noise, std::abs(d[p]) / gain);
  }
  return noise;
}

// Of one value around a step that is as wide as its grains, if it has any. On both sides of x, of which the quieter one
// counts: there may be a kink on the other. Two spacings: one of them may be a whole number of grains.
double noise_beside(const ValuesAt& f, double x, double grain, std::size_t value, std::size_t values) {
  double least = infinity;
  std::vector<double> at(values);
  for (const double side : {1.0, -1.0}) {
    double noise = 0;
    for (const double spacing : {2.618 * grain, 6.854 * grain}) {
      std::array<double, noise_points> course;
      for (std::size_t p = 0; p < noise_points; ++p) {
        f(x + side * spacing * static_cast<double>(p + 1), at);
        course[p] = at[value];
      }
      noise = std::max(noise, noise_of(course));
    }
    least = std::min(least, noise);
  }
  return least;
}

}  // namespace

// Central differences are even in the step h, so that halving it removes h², h⁴ ... one after the other. The row whose
// extrapolations agree best counts: first the steps are too wide, at last rounding rules.
std::vector<Slope> extrapolated_slope(const ValuesAt& f, double x, std::size_t values) {
  const double width = first_step * std::max(1.0, std::abs(x));
  std::vector<Course> courses(values);
  std::vector<double> here(values), above(values), below(values);
  f(x, here);
  double h = width;
  for (std::size_t step = 0; step < most_steps; ++step, h /= 2) {
    const double up = x + h, down = x - h;
    if (up == x || down == x) break;
    f(up, above), f(down, below);
    for (std::size_t v = 0; v < values; ++v) courses[v].add(0.5 * (up - down), below[v], here[v], above[v]);
    if (std::ranges::all_of(courses, [](const Course& c) { return c.settled(); })) break;
  }
  std::vector<Slope> slopes;
  for (std::size_t v = 0; v < values; ++v) {
    const std::optional<double> grain = courses[v].settled() ? std::nullopt : courses[v].grain();
    slopes.push_back(courses[v].slope(grain ? noise_beside(f, x, *grain, v, values) : 0, width));
  }
  return slopes;
}

}  // namespace dynalin
