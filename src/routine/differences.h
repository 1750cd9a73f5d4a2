// The slope of a function that knows no derivatives, by differences of ever smaller steps and their extrapolation.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace dynalin {

struct Slope {
  double value;
  double error;  // what it may be off by, as far as the steps show
  bool agreed;   // false where the steps say different things down to the last: at a jump, or a law that is not one
  double unseen = 0;     // a slope so small makes no difference beside the value itself
  double half_kink = 0;  // where slopes differ from side to side: value − half_kink below x, value + half_kink above
};
// Of all values of f at x, each with the best row of its own (Ridders). f writes its values into the span.
std::vector<Slope> extrapolated_slope(const std::function<void(double, std::span<double>)>& f, double x,
                                      std::size_t values);

// How much is made by a derivative over the way that the first steps at x go by.
double change_by(double derivative, double x);

// Whether a slope at x says something else than the derivative that was given, by more than either is known and by more
// than is lost in the rounding of `greatest_change`, what any argument makes in the same value.
bool contradicts(const Slope&, double given, double x = 0, double greatest_change = 0);

}  // namespace dynalin
