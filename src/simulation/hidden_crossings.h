// Functions that change their sign twice within a step of an integration: at its ends nothing is seen of it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace dynalin {

// Looks at two instants inside each step, where the cubic through the four values has an extremum beyond zero or next
// to it, and where a function may reach zero that changes no faster than it does between the instants looked at: a gap
// that is passed at a steady speed falls and rises again like a V, however narrow its dip. What comes and goes faster
// than anything that was seen of it may still be missed.
class HiddenCrossings {
 public:
  using Values = std::function<void(double t, std::span<double>)>;  // of all functions at an instant of the step

  // Where steps begin.
  void begin(std::span<const double> values) { before_.assign(values.begin(), values.end()); }
  // The instant just behind the first change of a sign before the second instant, whose values are `at_end`. Without
  // one the next stretch begins at the second instant, else at what was found. `reported`: what changes at the second
  // instant as far as the caller knows, all else that is another sign there counts as well; nothing where the caller
  // compares for itself.
  using Reported = std::optional<std::span<const int>>;
  std::optional<double> first(double from, double to, std::span<const double> at_end, const Values&,
                              const Reported& reported = {});
  // An instant within the step at which a sign is another one than at its beginning, the first that is looked at, and
  // not closed in on. The values of the beginning stay those of the step.
  std::optional<double> seen(double from, double to, std::span<const double> at_end, const Values&);
  // Of what was found: 1 upwards, −1 downwards, 0 not.
  std::span<const int> crossed() const { return crossed_; }

 private:
  // Values at a part of the step, 0 to 1.
  struct Look {
    double part;
    std::vector<double> values;
  };

  bool has_crossed(std::span<const double> values) const;
  std::vector<double> suspects(std::span<const double> at_end) const;
  const Look& look(double part, double from, double length, const Values&);
  std::optional<double> within_reach(double until) const;
  double closed_in(double from, double beyond, double tolerance, const Values&);

  std::vector<double> before_, now_;
  std::vector<Look>
      looks_;  // the first `looked_` in the order of their parts; what is behind is kept for the next step
  std::size_t looked_ = 0;
  std::vector<int> crossed_;
};

}  // namespace dynalin
