// Function expressions: parsed once into a flat program over *atoms*.
//
// An atom is anything an expression reads from outside itself: a marker measure DX(1,2), VARVAL(3),
// DIF(4), TIME, a force JOINT(1,0,2,0). The program is differentiated with respect to its atoms by
// one reverse sweep; the system chains the sparse gradient of each atom behind it. So one
// expression may touch any number of bodies at no extra cost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/time_taylor.h"
#include "dataset/dataset.h"
#include "expression/function_text.h"
#include "expression/measures.h"
#include "expression/spline.h"

namespace dynalin {

// What class of thing an argument of an atom function names.
enum class ReferenceClass : std::uint8_t {
  marker,   // 0 or left out means the global frame
  element,  // the id of a statement of class AtomFunction::statement
  index,    // a 1-based position, a flag or a component number
};

enum class AtomFamily : std::uint8_t {
  time,
  marker_measure,  // DX … WDTM, AX, PSI, INCANG …: a function of marker motions
  data,            // AtomFunction::reads says what
  marker_force,    // FX … TM (i, j, k): sum over all elements at marker i
  element_force,   // JOINT, MOTION, SFORCE, SPDP … (id, jflag, comp, rm)
  delay,           // DELAY(e, tau, history [, id]): a quantity of its own, made of expressions
};

// What an atom of the family `data` reads.
enum class DataSource : std::uint8_t {
  none,
  analysis,        // MODE: a number that the analysis decides
  processor_time,  // CPU …
  step_size,       // HSIZE
  step_order,      // ORDER
  jacobians,       // NJAC
  evaluations,     // NRHS: how an integration over time goes, constant in each of its steps
  sensor,          // SENVAL
  value,           // VARVAL
  array_entry,     // ARYVAL
  state,           // DIF
  state_rate,      // DIF1
  list_entry,      // PINVAL, POUVAL
  unknown,         // an algebraic unknown by its number in the layout: elements read theirs so, no text names one
};

// What no motion changes: a number that the analysis decides, how it goes, or what a SENSOR has stored.
constexpr bool stands_still(DataSource reads) { return reads >= DataSource::analysis && reads <= DataSource::sensor; }

// One function that yields an atom, as the parser knows it.
struct AtomFunction {
  std::string_view name;
  AtomFamily family;
  std::int8_t order;  // kinematic order: 0 displacements, 1 velocities, 2 accelerations, −1 decided
                      // by what it refers to
  std::uint8_t minimum_arguments;
  std::uint8_t maximum_arguments;
  std::string_view statement;  // class of the element named by the first argument, "" for markers
  bool built;                  // false: known to the language, not available yet
  FunctionText text{};
  std::string_view required_argument{};  // that the statement of the element must have
  DataSource reads = DataSource::none;
  std::optional<Measure> measure{};  // which it is, of the family marker_measure
};

// Table of all atom functions, in the order of the documentation.
std::span<const AtomFunction> atom_functions();
// The one of that upper-case name, nullptr if there is none.
const AtomFunction* find_atom_function(std::string_view name);
const AtomFunction& atom_function(Measure);
// What the zero-based argument of an atom function names.
ReferenceClass reference_class(const AtomFunction&, std::size_t argument);

struct DelayedCall;

struct Atom {
  const AtomFunction* function = nullptr;
  std::array<std::int32_t, 5> argument{};  // ids and indices as written, 0 where left out
  std::uint8_t argument_count = 0;
  Span at;  // of the call
  // Of each argument in the source of the call, for messages about ids. Large models have a great many atoms.
  struct Place {
    std::uint32_t offset = 0, length = 0;
  };
  std::array<Place, 5> argument_place{};
  std::shared_ptr<const DelayedCall> delayed = nullptr;  // of DELAY: what stands between its parentheses

  Span argument_at(std::size_t k) const { return {at.source, argument_place[k].offset, argument_place[k].length}; }
  void set_argument_at(std::size_t k, const Span& written) { argument_place[k] = {written.offset, written.length}; }
  // Where nothing of the text stands for arguments.
  void set_place(const Span& call) {
    at = call;
    argument_place.fill({call.offset, call.length});
  }
};

class ExpressionProgram;
class ProgramShapes;
struct ProgramDraft;

// The atoms of an expression: programs keep them in less memory, so that each is made when it is asked for. (What
// std::views::transform and iota are together; clang 14 does not compile these.)
class AtomList {
 public:
  class Iterator {
   public:
    using value_type = Atom;
    using reference = Atom;
    using pointer = void;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::input_iterator_tag;

    Iterator() = default;
    Atom operator*() const;
    Iterator& operator++() {
      ++number_;
      return *this;
    }
    Iterator operator++(int) { return {program_, number_++}; }
    bool operator==(const Iterator&) const = default;

   private:
    friend class AtomList;
    Iterator(const ExpressionProgram* program, std::uint32_t number) : program_(program), number_(number) {}

    const ExpressionProgram* program_ = nullptr;
    std::uint32_t number_ = 0;
  };

  AtomList(const ExpressionProgram& program, std::size_t count)
      : program_(&program), count_(static_cast<std::uint32_t>(count)) {}
  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  Atom operator[](std::size_t k) const { return *Iterator(program_, static_cast<std::uint32_t>(k)); }
  Iterator begin() const { return {program_, 0}; }
  Iterator end() const { return {program_, count_}; }

 private:
  const ExpressionProgram* program_;
  std::uint32_t count_;
};

// Scratch memory of one evaluation; kept by the caller so that evaluation allocates nothing.
template <class T>
struct ExpressionWorkspace {
  std::vector<T> value, adjoint;
  std::vector<char> reached;  // nodes on which the result depends, even if only with a derivative of zero here
  std::vector<double> order;  // of the growth of nodes, where an infinite slope has to be judged
  std::vector<char> smooth;
};

// The place in an expression where a value or a derivative stopped being a finite number.
struct UndefinedOperation {
  std::string function;  // name of the function or sign of the operator, as in the language
  Span at;               // the call, or the operator with its operands
  std::string reason;    // "SQRT of -3", "the derivative of SQRT is infinite at 0"
};
enum class UndefinedSearch : std::uint8_t { value, value_and_partials };

class Expression {
 public:
  Expression();  // the constant 0
  static Expression constant(double);
  static Expression of_atom(const Atom&);

  AtomList atoms() const;                               // each distinct atom once
  bool is_constant() const { return atoms().empty(); }  // a spline at constant arguments is
  Span at() const;
  // For what looks at how it is made, instead of evaluating it.
  const ExpressionProgram& program() const { return *program_; }

  // Value at the given atom values. T is double or TimeTaylor<double>. Only the selected branch of
  // an IF is evaluated.
  template <class T>
  T evaluate(std::span<const T> atoms, ExpressionWorkspace<T>&) const;
  // Value and the partial derivative with respect to every atom (zero for atoms of branches not
  // taken).
  template <class T>
  T evaluate(std::span<const T> atoms, std::span<T> partials, ExpressionWorkspace<T>&) const;

  // Whether the result depends on an atom at all, after an evaluation with partials; the partial may be zero.
  template <class T>
  bool reaches(std::size_t atom, const ExpressionWorkspace<T>&) const;

  // The call of a size that is zero and grows in every direction, after an evaluation with partials, where its slope
  // counts as zero.
  std::optional<Span> size_of_nothing(ExpressionWorkspace<double>&) const;

  // Whether it may have kinks or jumps along a motion, and functions that change their sign where it has: as many in
  // the same order at all atom values.
  bool has_switches() const;
  void switches(std::span<const double> atoms, ExpressionWorkspace<double>&, SwitchList&) const;

  // Whether it reads tables at arguments that move, and what these have between the ends of a step.
  bool has_tables() const { return has_switches() && !splines().empty(); }
  void look_ahead(std::span<const double> from, std::span<const double> to, ExpressionWorkspace<double>&,
                  StepReach&) const;

  // Functions that are called, IF among them, each call once.
  struct Call {
    std::string_view name;
    Span at;
  };
  std::vector<Call> calls() const;

  // Splines and curves it refers to, and the same expression with their data attached; without it has no value.
  std::span<const SplineUse> splines() const;
  Expression with_curves(const std::function<void(SplineUse&)>& attach) const;

  // The same with other expressions in the place of atoms, where `define` gives one.
  Expression with_definitions(const std::function<std::optional<Expression>(const Atom&)>& define) const;

  // Names the function that makes the value, or else a partial derivative, infinite or undefined at
  // these atom values (SQRT at 0 times what is 0 as well may have any derivative); nothing if all are finite. On
  // TimeTaylor the time derivatives count too, so all atoms should have theirs. Allocates.
  template <class T>
  std::optional<UndefinedOperation> find_undefined(std::span<const T> atoms, UndefinedSearch) const;

 private:
  explicit Expression(std::shared_ptr<const ExpressionProgram>);
  friend class ExpressionParser;
  friend Expression parse_expression(std::span<const Token>, const SourceText&, Diagnostics&, ProgramShapes&);
  friend struct VectorExpression parse_vector_expression(std::span<const Token>, const SourceText&, Diagnostics&,
                                                         ProgramShapes&);
  std::shared_ptr<const ExpressionProgram> program_;
};

// DELAY(e, tau, history [, id]): e as it was tau ago, history(TIME) where that lies before the start.
struct DelayedCall {
  Expression value, lag, history;
  std::string delayed;     // the first as written, in capitals and without blanks
  std::int32_t array = 0;  // ARRAY with settings of the interpolation, 0 for none
  Span array_at;
};

// Parses the tokens of a value. Continuation commas are white space here. Reports all it can find;
// the result after an error is the constant 0. The spans of the result point into the source text,
// which must outlive it. Expressions that are read with the same shapes share what they have in common.
Expression parse_expression(std::span<const Token>, const SourceText&, Diagnostics&, ProgramShapes&);
Expression parse_expression(std::span<const Token>, const SourceText&, Diagnostics&);

// The three components of an expression whose value is a vector.
struct VectorExpression {
  std::array<Expression, 3> component;
};
VectorExpression parse_vector_expression(std::span<const Token>, const SourceText&, Diagnostics&, ProgramShapes&);

}  // namespace dynalin
