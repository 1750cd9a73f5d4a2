// An expression whose atoms are tied to the unknowns of a system: it evaluates itself on a Motion and puts
// its exact partial derivatives where they belong.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "expression/expression.h"
#include "expression/measures.h"
#include "mechanics/binder.h"
#include "mechanics/coordinate_block.h"
#include "mechanics/equations.h"
#include "mechanics/undefined_value.h"

namespace dynalin {

// What an expression is bound for: the equations of a system, with the time derivatives of channels for add_rate. A
// condition is bound with zero for every DIF1: they cancel in the sum it is a term of. An observation is part of no
// equation: its kinks are none of the motion.
enum class Binding : std::uint8_t { equations, rates, condition, condition_rates, observation };

// What an expression is where two markers meet, whose distance it may read: that has one slope whichever way they part.
struct AtMeeting {
  double value = 0, by_distance = 0;
  // What it varies with besides, and whether it has a derivative by that.
  enum class Others : std::uint8_t { none, defined, undefined } others = Others::none;

  bool is_multiple_of_distance() const { return value == 0.0 && others == Others::none; }
};

class BoundExpression {
 public:
  BoundExpression() = default;
  BoundExpression(Expression, Binder&, Binding = Binding::equations);

  // Kinematic order: 0 displacements, 1 velocities, 2 accelerations or reactions.
  int order() const { return order_; }
  bool is_constant() const { return bound_atoms().empty(); }
  // The first atom that reads how a marker moves along a curve, null if none does.
  std::optional<Atom> atom_on_curve() const;

  double value(const Motion&, ExpressionScratch&) const;
  // With respect to the atoms of the expression, in their order; lives in the scratch.
  std::span<const double> partials(const Motion&, ExpressionScratch&) const;
  // Value and two rates; for expressions of order 0 without channels.
  Taylor along_motion(const Motion&, ExpressionScratch&) const;

  // The same with values of others in it: `given` has those of all atoms, of which the channels are taken.
  Taylor along_motion(const Motion&, ExpressionScratch&, std::span<const Taylor> given) const;

  // Adds factor · e to the residual of `row` and its partials to the matrices. Velocity partials go to
  // `velocity_family`: damping for forces and VARIABLEs, velocity for controllers.
  void add(const Motion&, Equations&, std::int32_t row, double factor, PartialBy velocity_family) const;
  // The same for the time derivative e′ along the motion; orders 0 and 1, without forces.
  void add_rate(const Motion&, Equations&, std::int32_t row, double factor, PartialBy velocity_family) const;
  double rate(const Motion&, ExpressionScratch&) const;  // e′
  // Adds the gradient of an expression of order 0 to a position row and returns its course, both times factor.
  Taylor add_position(const Motion&, ConstraintRows&, std::int32_t row, double factor = 1) const;
  // The same with values of others in it; what they are multiplied with is left in rows.scratch.taylor_partials, in the
  // order of the atoms and without the factor.
  void add_position(const Motion&, ConstraintRows&, std::int32_t row, const Taylor& factor,
                    std::span<const Taylor> given) const;
  // The same for a velocity row, order 0 or 1: value and rate are valid.
  Taylor add_velocity(const Motion&, ConstraintRows&, std::int32_t row, double factor = 1) const;

  // Adds the variation of the generalized forces that a multiplier exerts through a row made by the two above.
  void add_reaction_partials(const Motion&, Equations&, double lambda, RowLevel) const;

  // Functions that change their sign where it has a kink or a jump along the motion.
  bool has_switches() const;
  void switches(const Motion&, ExpressionScratch&, SwitchList&) const;
  // What tables that it reads have between the ends of a step.
  bool has_tables() const { return expression_.has_tables(); }
  void look_ahead(const Motion& from, const Motion& to, ExpressionScratch&, StepReach&) const;
  // Whether all it reads are positions, velocities, states and the time, none of which jumps without a slope that does.
  bool reads_states_only() const;

  bool reads_forces() const;
  AtMeeting where_they_meet(const Motion&, ExpressionScratch&, const MarkerPlace& I, const MarkerPlace& J) const;

  // Adds what is wrong when a value or partial is not finite: function, argument and reason.
  // With rates also what its time derivative or a second derivative does not have. In a search for kinks adds the
  // first of those instead.
  enum class Derivatives : std::uint8_t { first, with_rates };
  void find_undefined(const Motion&, const ElementLabel& of, UndefinedValues&, Derivatives = Derivatives::first) const;
  // The same without kinks and without the name of who has the function.
  struct Lack {
    std::string reason;  // empty if nothing is wrong
    bool in_value = true;
  };
  Lack undefined(const Motion&, Derivatives = Derivatives::first) const;

 private:
  // Where partials go; those by velocities to a family of their own.
  struct IntoEquation {
    Equations& eq;
    std::int32_t row;
    PartialBy velocity_family;
  };
  struct IntoConstraint {
    ConstraintRows& rows;
    std::int32_t row;
    RowLevel level;
  };
  struct ForceTerm {
    Signals::Wrench wrench;
    bool on_J = false;
  };
  struct Force {
    std::vector<ForceTerm> terms;
    std::uint8_t component = 1;  // 1–8: FM FX FY FZ TM TX TY TZ
    MarkerFrame axes_marker;
  };
  struct BoundAtom {
    enum class Kind : std::uint8_t { time, mode, progress, constant, remembered, channel, measure, force } kind;
    double constant = 0;
    double IntegrationProgress::*progress = nullptr;
    Channel channel, rate;  // rate: of the channel, where it is wanted
    Measure measure = Measure::DX;
    std::int8_t order = 0;
    std::array<MarkerFrame, 4> places;               // i, j, k, l
    std::uint32_t first_block = 0, block_count = 0;  // what they depend on, in atom_blocks
    std::int32_t memory = -1;                        // total angle of a measure that counts turns
    std::int32_t kept = -1;                          // where the memory holds what is remembered
    std::shared_ptr<const Force> force;              // of the kind force alone: most atoms are none
  };

  void bind_atoms(Binder&, Binding);
  BoundAtom bind(const Atom&, Binder&, Binding);
  void bind_measure(BoundAtom&, const Atom&, Binder&);
  void bind_data(BoundAtom&, const Atom&, Binder&, Binding);
  void bind_force(BoundAtom&, Force, const Signals&);
  static Force force_of_element(const Atom&, Binder&);
  static Force force_on_marker(const Atom&, Binder&);
  void note_blocks(BoundAtom&, const MarkerFrame&, const Layout&, bool poses_too);
  // What atoms are tied to: the same of all copies, as System keeps one more of each expression with kinks.
  struct Bound {
    std::vector<CoordinateBlock> all_blocks;   // all that the measures depend on
    std::vector<CoordinateBlock> atom_blocks;  // the same atom by atom
    std::vector<BoundAtom> atoms;
  };
  template <class T>
  std::span<const T> list(std::vector<T> Bound::*which) const {
    return bound_ ? std::span<const T>((*bound_).*which) : std::span<const T>();
  }
  std::span<const CoordinateBlock> all_blocks() const { return list(&Bound::all_blocks); }
  std::span<const CoordinateBlock> atom_blocks() const { return list(&Bound::atom_blocks); }
  std::span<const BoundAtom> bound_atoms() const { return list(&Bound::atoms); }
  std::span<const CoordinateBlock> blocks(const BoundAtom& a) const {
    return atom_blocks().subspan(a.first_block, a.block_count);
  }
  double atom_value(const BoundAtom&, const Motion&) const;
  double force_value(const BoundAtom&, const Motion&) const;
  void fill_rates(const Motion&, ExpressionScratch&) const;  // atoms with their values and rates
  Taylor atom_along_motion(const BoundAtom&, const Motion&) const;
  // A factor of zero leaves nothing of a gradient that is not defined, if `passes_over`.
  void add_atom(const BoundAtom&, const Motion&, const IntoEquation&, double factor, bool passes_over) const;
  template <std::size_t N>
  static void add_measure_gradient(const BoundAtom&, const Motion&, const CoordinateBlock&, const IntoEquation&,
                                   double factor, bool passes_over);
  bool has_gradient(const BoundAtom&, const Motion&) const;
  bool is_size_of_nothing(const BoundAtom&, const Motion&) const;
  void add_force(const BoundAtom&, const Motion&, const IntoEquation&, double factor) const;
  // Partials of X and X′ of a measure by δq, δq′ … of one block.
  struct Factors {
    double of_value, of_rate;
  };
  template <std::size_t N>
  static void add_measure_rate(const BoundAtom&, const Motion&, const CoordinateBlock&, const IntoEquation&,
                               const Factors&);
  // Adds partial · (path gradient of the measure) at the levels a constraint row has.
  void add_measure_to_row(const BoundAtom&, const Motion&, const IntoConstraint&, const Taylor& partial) const;
  template <std::size_t N>
  static void add_block_to_row(const BoundAtom&, const Motion&, const CoordinateBlock&, const IntoConstraint&,
                               const Taylor& partial);
  void fill_along_motion(const Motion&, std::span<const Taylor> given, std::vector<Taylor>& atoms) const;
  template <class Factor>
  Taylor add_to_row(const Motion&, const IntoConstraint&, const Factor& factor, std::span<const Taylor> given) const;

  double gradient(const ExpressionScratch&, std::size_t atom, const CoordinateBlock&, std::size_t seed) const;
  // Whether a partial of zero makes the gradient of an atom vanish where that is not defined.
  bool passes_over(std::size_t atom, const ExpressionScratch&) const;
  static bool is_size(const BoundAtom&);  // of a vector: never negative
  void find_kink(const Motion&, double length, const ElementLabel& of, UndefinedValues&, Derivatives) const;
  std::string kink_along(std::size_t moved, double size, std::vector<double>& values, ExpressionScratch&) const;
  std::string kink_of_rate_along(std::size_t moved, double size, ExpressionScratch&) const;
  std::string undefined_in_value(const Motion&, const std::vector<double>& atoms) const;
  std::string undefined_in_gradient(const Motion&, const std::vector<double>& atoms, Derivatives) const;

  Expression expression_;
  std::shared_ptr<Bound> bound_;  // constant once it is made, null without atoms
  int order_ = 0;
};

}  // namespace dynalin
