// The slope of a function that knows no derivatives, by differences of ever smaller steps and their extrapolation.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace dynalin {

// Of all values of f at x, each with the best row of its own (Ridders). f writes its values into the span.
std::vector<double> extrapolated_slope(const std::function<void(double, std::span<double>)>& f, double x,
                                       std::size_t values);

}  // namespace dynalin
