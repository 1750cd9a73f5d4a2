// The slope of a function that knows no derivatives, by differences of ever smaller steps and their extrapolation.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace dynalin {

struct Slope {
  double value;
  bool agreed;  // false where the steps say different things down to the last: at a jump, or a law that is not one
};
// Of all values of f at x, each with the best row of its own (Ridders). f writes its values into the span.
std::vector<Slope> extrapolated_slope(const std::function<void(double, std::span<double>)>& f, double x,
                                      std::size_t values);

// How often this thread took slopes that are differences for a linear model. What is counted while a model is
// linearized says whether differences are in it.
std::uint64_t differences_in_linear_models();
void count_difference_in_linear_model();

}  // namespace dynalin
