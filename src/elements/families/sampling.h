// Discrete states: values that the memory holds from one sample to the next. At an instant of sampling, in dynamics
// alone, each gets the value that its function has there, all at once; statics and linear models take them as they
// are. An output at such an instant shows them as they were before, one where a simulation begins as they are then.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/bound_expression.h"

namespace dynalin {

// Of one element.
class Sampling {
 public:
  struct Law {
    std::vector<Expression> update;
    std::vector<double> initial;  // zero where there are fewer
    Expression period;            // from one sample to the next, evaluated at each [time]
    double offset = 0;            // of the first sample [time]
    std::string update_name, period_name;
  };

  explicit Sampling(Law law) : law_(std::move(law)) {}
  void bind(const ElementLabel& owner, Binder&);

  std::size_t size() const { return law_.update.size(); }
  // Not a number where the last sample gave none.
  double value(const Motion&, std::size_t n) const;
  // Positive behind the next instant of sampling.
  double crossing(const Motion&) const;
  // At that instant, or about to be: instants are equal where they differ by no more than samples are late.
  bool is_due(const Motion& motion) const { return crossing(motion) >= -2 * slack(motion); }
  // Whether anything has changed.
  bool sample(const Motion&, Memory&) const;
  // Why there are no values, empty if there are.
  std::string failure(const Motion&) const;
  // Entries of the memory that say when the next sample is.
  std::vector<std::int32_t> schedule() const { return {next_kept_, period_kept_}; }
  // What the functions that have given none have to say for it.
  void find_undefined(const Motion&, const ElementLabel& of, UndefinedValues&) const;

 private:
  double next(const Motion& motion) const { return motion.memory[static_cast<std::size_t>(next_kept_)]; }
  double slack(const Motion&) const;
  double behind(double time, double period) const;

  Law law_;
  std::vector<BoundExpression> update_;
  BoundExpression period_;
  std::vector<std::int32_t> kept_;
  std::int32_t next_kept_ = -1, period_kept_ = -1;
};

}  // namespace dynalin
