// A routine of a shared library, called for one statement.
//
// It is called first to learn what it reads. Its derivatives come from an entry of its own (dynalin_course), else from
// what it tells c_syspar; what of them is missing is differenced where that is allowed: never in a linear model, unless
// the user asks for it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/partials.h"
#include "dynalin/element_id.h"
#include "expression/routine.h"
#include "routine/differences.h"
#include "routine/routine_context.h"
#include "routine/routine_kinds.h"
#include "routine/routine_library.h"
#include "routine/statement_words.h"

namespace dynalin {

struct RoutineArgumentsNow;
struct RoutineFindings;
struct RoutineData;

enum class RoutineDifferences : std::uint8_t { not_in_linear_models, everywhere };

// What the statement says to its routine.
struct RoutineStatement {
  ElementId element;
  int id = 0;
  std::shared_ptr<const RoutineConstants> constants{};
  ToldToRoutine told{};
  int I = 0, J = 0;                        // of a FIELD
  std::shared_ptr<const sAdamsGSE> gse{};  // of a GSE, which is what it is told
  // Of an MFORCE.
  struct ModalLoad {
    int body = 0;  // id of its FLEX_BODY
    std::size_t modes = 0, cases = 0;
    std::vector<double> loads{};  // 6 + modes numbers for each case
    bool scaled = false;          // by FUNCTION: values are a scale and behind it the load; by FORCE the load alone
  };
  std::shared_ptr<const ModalLoad> modal{};
  // ARRAYs of numbers and of discrete states, ascending: constants in a linear model.
  std::shared_ptr<const std::vector<int>> constant_arrays{};
  std::shared_ptr<const RoutineData> data{};
};

// Routines that give the partial derivatives of a whole GSE: of x′ and of y, with respect to states and to inputs; and
// those of a COUPLER, the first and the second by its displacements. One that is not there has no address.
struct StatePartialRoutines {
  FoundRoutine of_x_by_x, of_x_by_u, of_y_by_x, of_y_by_u;
  FoundRoutine first, second;
};

class CompiledRoutine final : public Routine {
 public:
  // Calls the routine to learn what it reads, where sizes of ARRAYs are needed.
  CompiledRoutine(FoundRoutine, const RoutineKind&, std::size_t values, RoutineStatement, RoutineDifferences,
                  const SizeOfList&, StatePartialRoutines = {});

  // TIME, MODE but for a MOTION, and what it asked for, or instead of that what it gets as arguments (given_inputs.h).
  const std::vector<Atom>& inputs() const { return requests_.inputs; }
  std::size_t values() const { return values_; }
  // Of how many of them derivatives are asked: not of the load that an MFORCE scales, a function of time alone.
  std::size_t differentiated() const { return statement_.modal && statement_.modal->scaled ? 1 : values_; }
  // What was wrong when it was asked what it reads, empty if nothing was.
  const std::string& problem() const { return problem_; }
  // Whether it gave derivatives with respect to all that it asked for, when it was called to try.
  bool gives_derivatives() const { return gives_derivatives_; }
  // "gives no derivatives", or where it gave some "gives no derivative by VX(20, 1)", the first that it did not give.
  const std::string& lack_of_derivatives() const { return lack_of_derivatives_; }

  double value(const RoutineInputs<double>&, std::size_t which) const override;
  TimeTaylor<double> value(const RoutineInputs<TimeTaylor<double>>&, std::size_t which) const override;
  std::span<const double> partials(const RoutineInputs<double>&, std::size_t which) const override;
  std::span<const TimeTaylor<double>> partials(const RoutineInputs<TimeTaylor<double>>&,
                                               std::size_t which) const override;
  std::string name() const override;
  std::string reason_of_value(std::span<const double> inputs) const override;
  std::string reason_of_partials(std::span<const double> inputs) const override;

 private:
  // A MOTION depends on nothing but time, so that TIME takes the place of MODE, which is 0 to its routine.
  bool knows_mode() const { return kind_->arguments != RoutineArguments::of_time; }
  using Taylor = TimeTaylor<double>;
  struct Memory;        // of the last call in this thread
  struct CourseMemory;  // the same along the motion
  void call(double time, int flag, int iflag, double* values) const;
  void call_with_arguments(double time, int flag, int iflag, double* values) const;
  void call_field(RoutineArgumentsNow, double* values) const;
  void call_coupler(RoutineArgumentsNow, const FoundRoutine&, double* values) const;
  // Along the motion, from the routines of first and second derivatives.
  void fill_course_of_coupler(CourseMemory&) const;
  // Whether the value at other times is the same to the last digit: there is no routine for its derivative in time.
  bool depends_on_time(std::span<const double> inputs) const;
  void call_contact(RoutineArgumentsNow, double* values) const;
  void call_modal(RoutineArgumentsNow, double* values) const;
  // Of a whole GSE: partial derivatives that routines of their own give.
  void call_partials(double time, std::span<double> partials, std::span<char> given) const;
  // All values, and with partials those too; says why there are none.
  std::string evaluate(std::span<const double> inputs, std::span<double> values, std::span<double> partials,
                       std::span<char> given, std::string* miscount = nullptr) const;
  std::string evaluate_course(std::span<const double> inputs, int order, std::span<double> values,
                              std::span<double> partials) const;
  std::vector<Slope> slopes(std::span<const double> inputs, std::size_t input) const;
  void difference(std::size_t input, Memory&) const;
  // Hold derivatives that the routine gives against differences: of a COUPLER its first and second ones, of a MOTION
  // those by time, at some times of a run.
  void doubt_given(Memory&) const;
  void doubt_coupler(std::span<const double> inputs, std::span<const double> slopes, std::span<const double> curvatures,
                     RoutineFindings&) const;
  void doubt_motion(double time, std::span<const double> course, RoutineFindings&) const;
  std::string input_text(std::size_t input) const;  // "VX(20, 1)"
  // Of a whole GSE: the routines of partial derivatives that it would need and no library has.
  std::vector<std::string_view> absent_partials() const;
  bool may_difference(double mode) const;
  const Memory& remembered(const RoutineInputs<double>&, Partials wanted) const;
  const CourseMemory& remembered(const RoutineInputs<Taylor>&) const;
  void fill_course(CourseMemory&) const;
  RoutineContext context(RoutineContext::Phase) const;
  // `calls` call the routine, in that context or at these inputs; what went wrong there, empty if nothing did.
  template <class Calls>
  std::string at_work(RoutineContext& c, Calls&& calls) const {
    {
      const RoutineContext::Scope scope(c, what_.c_str());
      try {
        calls();
      } catch (...) {
        c.fail(caught_exception());
      }
    }
    return c.failure;
  }
  template <class Calls>
  std::string at_inputs(std::span<const double> inputs, Calls&& calls) const {
    RoutineContext c = context(RoutineContext::Phase::evaluating);
    c.inputs = inputs;
    return at_work(c, calls);
  }

  FoundRoutine found_;
  const RoutineKind* kind_;
  std::size_t values_;
  RoutineStatement statement_;
  RoutineDifferences differences_;
  StatePartialRoutines state_partials_;
  RoutineRequests requests_;
  // Inputs that are constants in a linear model, of which no derivatives are asked.
  std::vector<std::int32_t> constants_;
  SizeOfList size_of_;
  std::string what_;  // for a crash
  std::string problem_;
  bool gives_derivatives_ = false;
  std::string lack_of_derivatives_;
  std::uint64_t serial_;  // of this one among all that ever were
};

}  // namespace dynalin
