#include "routine/state_equations.h"

#include <algorithm>
#include <limits>

#include "expression/program.h"

namespace dynalin {

namespace {

// The place of the functions in an expression.
class Carrier final : public Routine {
 public:
  explicit Carrier(std::shared_ptr<const StateEquations> functions) : functions_(std::move(functions)) {}
  const std::shared_ptr<const StateEquations>& functions() const { return functions_; }

  double value(const RoutineInputs<double>&, std::size_t) const override { return none; }
  TimeTaylor<double> value(const RoutineInputs<TimeTaylor<double>>&, std::size_t) const override { return none; }
  std::span<const double> partials(const RoutineInputs<double>& read, std::size_t) const override {
    thread_local std::vector<double> all;
    all.assign(read.size(), none);
    return all;
  }
  std::span<const TimeTaylor<double>> partials(const RoutineInputs<TimeTaylor<double>>& read,
                                               std::size_t) const override {
    thread_local std::vector<TimeTaylor<double>> all;
    all.assign(read.size(), none);
    return all;
  }
  std::string name() const override { return "the routines of a GSE"; }
  std::string reason_of_value(std::span<const double>) const override { return "a GSE has many values"; }
  std::string reason_of_partials(std::span<const double>) const override { return "a GSE has many values"; }

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::shared_ptr<const StateEquations> functions_;
};

}  // namespace

Expression StateEquations::written(std::shared_ptr<const StateEquations> functions, const Span& at) {
  std::vector<Atom> inputs;
  const auto note = [&](const Expression& e) {
    for (const Atom& a : e.atoms()) {
      const bool known = std::any_of(inputs.begin(), inputs.end(), [&](const Atom& other) {
        return other.function == a.function && other.argument == a.argument;
      });
      if (!known) inputs.push_back(a);
    }
  };
  for (const auto* list : {&functions->derivatives, &functions->outputs, &functions->update})
    std::for_each(list->begin(), list->end(), note);
  if (functions->period) note(*functions->period);
  return routine_expression(std::move(inputs), std::make_shared<const Carrier>(std::move(functions)), 0, at);
}

std::shared_ptr<const StateEquations> StateEquations::of(const Expression& e) {
  const auto routines = e.program().routines();
  if (routines.size() != 1) return nullptr;
  const auto* carrier = dynamic_cast<const Carrier*>(routines.front().routine.get());
  return carrier ? carrier->functions() : nullptr;
}

}  // namespace dynalin
