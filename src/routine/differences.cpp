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
constexpr std::size_t utmost_steps = 60;  // where a slope falls with the step towards a point nearer than all of those
// Parts of the last step, no whole numbers of each other, at which a law may turn out to be another one near by.
constexpr std::array nearer = {0.0371, 0.00139, 5.17e-5};
constexpr double seen_nearer = 1e-7;             // relative change of the slope or its bend
constexpr double settled_extrapolation = 1e-11;  // relative change of the last extrapolation
// The best extrapolation may be off by this part of itself, or make as little difference over the first step.
constexpr double disagreement = 0.01, hidden_by_rounding = 1e-6;

using ValuesAt = std::function<void(double, std::span<double>)>;
constexpr double infinity = std::numeric_limits<double>::infinity();

double largest(double a, double b) { return std::max(std::abs(a), std::abs(b)); }

// Of a difference quotient.
double rounding(double size, double step) { return 8 * std::numeric_limits<double>::epsilon() * size / step; }

// One step on both sides of x.
struct Row {
  double step = 0;        // half the way from below to above
  double difference = 0;  // the central one, as it is
  double half_bend = 0;   // half of what the slopes on both sides differ by
  double size = 0;        // of the values
  std::vector<double> extrapolated = {};
  double best = 0, error = infinity;  // of the extrapolations
};

Row row_of(double step, double below, double here, double above) {
  return {step, (above - below) / (2 * step), (above - 2 * here + below) / (2 * step), largest(above, below)};
}

// A difference quotient that falls like a power of the step, as that of x |x| or of a force that sets in with the depth
// to 1.5, tends to its limit more slowly than extrapolation by whole powers can see.
struct Fall {
  double limit = 0, error = infinity;
  double left = 0;       // of the quotient above the limit at the smallest step
  bool followed = true;  // down to that step
};
constexpr double slowest_fall = 0.93, unlike_falls = 0.02;

// What one value does, row by row.
class Course {
 public:
  void add(double step, double below, double here, double above) {
    Row row = row_of(step, below, here, above);
    row.extrapolated = {row.difference};
    const std::vector<double> none, &before = rows_.empty() ? none : rows_.back().extrapolated;
    double factor = 4;
    for (std::size_t k = 0; k < std::min(before.size(), most_orders); ++k, factor *= 4) {
      const double next = (factor * row.extrapolated[k] - before[k]) / (factor - 1);
      row.extrapolated.push_back(next);
      const double error = largest(next - row.extrapolated[k], next - before[k]);
      if (error < row.error) row.error = error, row.best = next;
    }
    rows_.push_back(std::move(row));
  }

  // Nothing that further steps could tell: the last row is good, and what the earlier ones made of themselves agrees.
  bool settled() const {
    if (rows_.size() < least_steps || doubted_) return false;
    const Row& last = rows_.back();
    if (std::ranges::all_of(rows_, [](const Row& r) { return r.difference == 0; })) return true;
    return last.error <= settled_extrapolation * std::abs(last.best) && std::ranges::all_of(rows_, [&](const Row& r) {
             return !(r.error <= disagreement * std::abs(r.best)) ||
                    std::abs(r.best - last.best) <= 4 * r.error + disagreement * disagreement * std::abs(last.best);
           });
  }

  // Whether a smaller step than the last shows another law than all before it, which may have passed over what there
  // is.
  void look_nearer(double step, double below, double here, double above) {
    const Row &last = rows_.back(), near = row_of(step, below, here, above);
    const double alike = seen_nearer * std::abs(last.best) + rounding(largest(near.size, here), step);
    if (!(std::abs(near.difference - last.best) <= 2 * std::abs(last.difference - last.best) + alike) ||
        !(std::abs(near.half_bend) <= (1 + disagreement) * std::abs(last.half_bend) + alike))
      doubted_ = true;
    looks_.push_back(near);
  }

  // Falls, and smaller steps than usual tell where to: the values themselves are as small.
  bool falls_on(double width) const {
    const Row& last = rows_.back();
    return rounding(last.size, last.step) < 1e-3 * std::abs(last.difference) && fall(0).error < infinity &&
           !slope(0, width).agreed;
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
    if (doubted_) noise = std::max(noise, noise_of_last_rows());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      double error = rows_[i].error + noise / rows_[i].step;
      // What smaller steps see beside the slope is noise, or a jump: of the same size in every step.
      for (std::size_t j = i + 1; j < rows_.size(); ++j)
        error = std::max(error, std::abs(rows_[j].difference - rows_[i].best) * rows_[j].step / rows_[i].step);
      if (error < least || (doubted_ && error <= least)) least = error, best = i;
    }
    const Fall central = fall(0);
    if (central.error < least) return slope_of_fall(central, width);
    if (least == infinity) return {std::numeric_limits<double>::quiet_NaN(), infinity, false};
    const double value = rows_[best].best, unseen = unseen_at(width);
    Slope found{value, least, least <= disagreement * std::abs(value) || least <= unseen, unseen};
    if (!found.agreed) {
      const Slope sides = slope_of_fall(fall_of_sides(), width);
      if (sides.agreed) return sides;
    }
    found.half_kink = half_kink(best, value, least);
    return found;
  }

 private:
  double unseen_at(double width) const { return hidden_by_rounding * rows_.back().size / width; }

  // Two ratios of neighbouring changes that are the same give the power and with it the limit (Aitken), which the
  // changes of rows behind have to keep to. Even powers are left to the extrapolation by them.
  // `side` is 0 for the central difference, 1 for that above x and −1 for that below.
  Fall fall(double side) const {
    Fall least;
    const auto quotient = [&](std::size_t i) { return rows_[i].difference + side * rows_[i].half_bend; };
    const auto change = [&](std::size_t i) { return quotient(i) - quotient(i - 1); };
    for (std::size_t i = 3; i < rows_.size(); ++i) {
      const double ratio = change(i) / change(i - 1), before = change(i - 1) / change(i - 2);
      const bool falls = ratio > 0 && ratio < slowest_fall && before < slowest_fall;
      if (!falls || !(std::abs(ratio - before) <= unlike_falls * ratio) || std::abs(ratio - 0.25) < 0.01) continue;
      const auto limit_at = [&](std::size_t k, double r) { return quotient(k) + change(k) * r / (1 - r); };
      Fall here{limit_at(i, ratio)};
      here.error = std::abs(here.limit - limit_at(i - 1, before));
      here.left = quotient(i) - here.limit;
      for (std::size_t j = i + 1; j < rows_.size(); ++j) {
        here.left *= ratio;
        const double off = std::abs(quotient(j) - here.limit - here.left);
        here.error = std::max(here.error, off * rows_[j].step / rows_[i].step);
        if (!(off <= unlike_falls * std::abs(here.left) + rounding(rows_[j].size, rows_[j].step)))
          here.followed = false;
      }
      if (here.error <= least.error) least = here;
    }
    return least;
  }

  // Beside the lowest point of |x|^1.5 the central differences do not fall, those of both sides do.
  Fall fall_of_sides() const {
    const Fall up = fall(1), down = fall(-1);
    return {(up.limit + down.limit) / 2, std::max(up.error, down.error) + std::abs(up.limit - down.limit) / 2,
            largest(up.left, down.left), up.followed && down.followed};
  }

  // By which the last steps do not agree with each other, made of the values.
  double noise_of_last_rows() const {
    constexpr std::size_t last = 6;
    double noise = 0;
    for (std::size_t i = rows_.size() - std::min(rows_.size(), last); i < rows_.size(); ++i)
      if (rows_[i].error < infinity) noise = std::max(noise, rows_[i].error * rows_[i].step);
    return noise;
  }

  Slope slope_of_fall(const Fall& f, double width) const {
    const double value = std::abs(f.limit) <= f.error ? 0 : f.limit, left = std::abs(f.left);
    const bool agreed = f.error <= disagreement * std::abs(value) || f.error <= unseen_at(width) ||
                        (f.followed && f.error <= disagreement * left);
    // What lies nearer than the smallest step has a slope of a few times what that step still shows.
    Slope found{value, f.error, agreed, std::max(unseen_at(width), 4 * left)};
    found.half_kink = half_kink(rows_.size() - 1, value, std::max(f.error, left));
    return found;
  }

  // Of a smooth law the bend halves with the step, at a kink it stays.
  double half_kink(std::size_t at, double slope, double error) const {
    if (rows_.size() < 3) return 0;
    at = std::max(at, std::size_t{2});
    const bool looked = settled() && looks_.size() > 1;
    const Row &wide = looked ? looks_[0] : rows_[at - 2], &narrow = looked ? looks_[1] : rows_[at];
    const double last = narrow.half_bend;
    const bool seen = std::abs(last) > std::max(disagreement * std::abs(slope), 8 * error);
    const bool stays = std::abs(wide.half_bend - last) < 0.25 * std::abs(last);
    return seen && stays ? last : 0;
  }

  std::vector<Row> rows_, looks_;  // those of looks for a law near by are not extrapolated
  bool doubted_ = false;
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
  const auto each = [&](double h, const auto& told) {
    const double up = x + h, down = x - h;
    if (up == x || down == x) return false;
    f(up, above), f(down, below);
    for (std::size_t v = 0; v < values; ++v) told(courses[v], 0.5 * (up - down), below[v], here[v], above[v]);
    return true;
  };
  const auto settled = [&] { return std::ranges::all_of(courses, &Course::settled); };
  bool falls_on = false;
  double h = width;
  for (std::size_t step = 0; step < (falls_on ? utmost_steps : most_steps); ++step, h /= 2) {
    if (!each(h, [](Course& c, auto... row) { c.add(row...); })) break;
    if (settled()) {
      for (const double part : nearer) each(part * h, [](Course& c, auto... row) { c.look_nearer(row...); });
      if (settled()) break;
    }
    if (step + 1 >= most_steps)
      falls_on = std::ranges::any_of(courses, [&](const Course& c) { return c.falls_on(width); });
  }
  std::vector<Slope> slopes;
  for (std::size_t v = 0; v < values; ++v) {
    const std::optional<double> grain = courses[v].settled() ? std::nullopt : courses[v].grain();
    slopes.push_back(courses[v].slope(grain ? noise_beside(f, x, *grain, v, values) : 0, width));
  }
  return slopes;
}

double change_by(double derivative, double x) { return std::abs(derivative) * std::max(1.0, std::abs(x)); }

bool contradicts(const Slope& slope, double given, double x, double greatest_change) {
  constexpr double unlike = 1e-3, change_that_is_lost = 1e-13;
  const double size = std::max(std::abs(given), std::abs(slope.value)), off = std::abs(given - slope.value);
  if (change_by(off, x) <= change_that_is_lost * greatest_change) return false;
  if (!slope.agreed || !(off > unlike * size + 4 * slope.error + slope.unseen)) return false;
  return slope.half_kink == 0 || off > 1.01 * std::abs(slope.half_kink);  // one side, or between both
}

}  // namespace dynalin
