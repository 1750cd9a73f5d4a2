// The one seam between elements and the system: a Kernel holds all elements of one kind, contiguously, and
// is called once a pass. It knows formulas; it knows nothing of solvers.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "expression/switch_list.h"
#include "mechanics/equations.h"
#include "mechanics/pair.h"

namespace dynalin {

class Binder;
class BoundExpression;
class EventSource;

// A force or constraint element as the force functions of expressions see it: what acts on its I marker.
struct MarkerWrench {
  PairMotion pair;
  PairForce force;
  // Scalar unknowns the wrench depends on: λ of a joint, w of a FUNCTION-valued force, coordinates beyond the pair's.
  struct Scalar {
    PartialBy family;
    std::int32_t column;
    Vector force, torque;
  };
  std::vector<Scalar> scalars;
  // A marker with whose axes the wrench on I turns beyond what the pair says, by their rotation δφ in global axes.
  struct Turn {
    const MarkerPlace* axes;
    Matrix3 force, torque;
  };
  std::vector<Turn> turns;
  bool J_follows_I = false;  // J is a floating marker at the origin of I
  PairScratch scratch;       // what the element keeps while it is asked

  void clear() { scalars.clear(), turns.clear(), J_follows_I = false; }
};

// A scalar channel that expressions may read.
struct Channel {
  enum class Kind : std::uint8_t { none, constant, algebraic, state, state_rate } kind = Kind::none;
  std::int32_t index = -1;
  double constant = 0;
};

// What an element asks of the start beyond the poses and velocities of bodies.
struct StartCondition {
  const ElementLabel* owner = nullptr;
  std::string_view name;
  std::optional<double> displacement, velocity;
};

// Why an element has no finite value, or a value without a derivative: a sentence that names it.
struct UndefinedValue {
  const ElementLabel* of = nullptr;
  std::string reason;
  bool in_value = true;
};

// Elements that exert a wrench, for tables, reports and the force functions of expressions.
class WrenchSource {
 public:
  // How many wrenches its elements exert: one each, but where one acts on many markers.
  virtual std::size_t wrench_count(std::size_t elements) const { return elements; }
  virtual std::size_t element_of_wrench(std::size_t which) const { return which; }
  virtual MarkerId marker_I(std::size_t which) const = 0;
  virtual MarkerId marker_J(std::size_t which) const = 0;
  // The marker along whose axes the statement gives the components.
  virtual MarkerId marker_of_axes(std::size_t which) const { return marker_J(which); }
  virtual void wrench(const Motion&, std::size_t which, bool with_partials, MarkerWrench&) const = 0;

 protected:
  ~WrenchSource() = default;
};

// Elements that hold values which data functions read.
class ChannelSource {
 public:
  virtual Channel value_channel(std::size_t /*element*/) const { return {}; }  // VARVAL
  // The expression that gives this value, null if none does.
  virtual const BoundExpression* value_function(std::size_t /*element*/) const { return nullptr; }
  virtual Channel state_channel(std::size_t /*element*/, std::size_t /*n*/) const { return {}; }
  virtual Channel output_channel(std::size_t /*element*/, std::size_t /*n*/) const { return {}; }

 protected:
  ~ChannelSource() = default;
};

// Of elements that take some microseconds each.
constexpr std::size_t shares_of(std::size_t elements) {
  constexpr std::size_t of_a_share = 32;
  return elements / of_a_share + 1;
}

class Kernel {
 public:
  virtual ~Kernel() = default;

  // --- while a System is made -----------------------------------------------------------------------
  // When all elements have their numbers: bind expressions.
  virtual void bind(Binder&) {}
  // Adds the equation of the unknown `rate`, the time derivative of the algebraic unknown, if this kernel owns that
  // one.
  virtual bool add_rate_equation(std::int32_t /*algebraic*/, std::int32_t /*rate*/, Binder&) { return false; }

  // --- equations ------------------------------------------------------------------------------------
  // Constraint rows with their values and coefficients at all levels.
  virtual void constraints(const Motion&, ConstraintRows&) const {}
  // Conditions at the start, and a position row for each: the displacement less what is asked, or zero where only the
  // velocity is.
  virtual std::span<const StartCondition> starts() const { return {}; }
  virtual void start_rows(const Motion&, std::int32_t /*first_row*/, ConstraintRows&) const {}
  // The rates of the courses of motions (DifferentialState::course_of_motion), by their places among all states. They
  // depend on time and on each other.
  virtual void course_rates(const Motion&, std::span<double> /*state_rates*/) const {}
  // Residuals of balance, algebraic and differential equations, and the partials that are wanted.
  virtual void equations(const Motion&, Equations&) const {}
  // Into so many shares equations() may be divided for several threads. More than one: it goes once through elements
  // that take nothing from each other, those of Equations::share.
  virtual std::size_t shares() const { return 1; }

  // --- what others read of the elements, null where there is nothing ---------------------------------
  virtual const WrenchSource* wrenches() const { return nullptr; }
  virtual const ChannelSource* channels() const { return nullptr; }
  // For the report of an operating point: reactions that no function reads as well.
  virtual const WrenchSource* reported_wrenches() const { return wrenches(); }

  // --- events ---------------------------------------------------------------------------------------
  // Adds functions of the motion that change their sign where what the elements say has a kink or a jump of their own:
  // as many in the same order at every motion. Those of bound expressions (the ends of a STEP, the condition of an IF)
  // are known without.
  virtual void switches(const Motion&, ExpressionScratch&, SwitchList&) const {}
  // Elements that watch the motion and act on its simulation.
  virtual const EventSource* events() const { return nullptr; }
  // An accepted instant of a motion in time: what is read of the past is kept.
  virtual void record(const Motion&, DelayHistories&) const {}
  // The longest step in time that resolves what the elements do here.
  virtual double longest_step(const Motion&) const { return std::numeric_limits<double>::infinity(); }
  // An accepted configuration: take over what the memory holds (turn counts).
  virtual void remember(const Motion&, Memory&) const {}
  // Adds why elements yield no finite values or derivatives here.
  virtual void undefined_values(const Motion&, std::vector<UndefinedValue>&) const {}
  // A sentence on how a converged point lies outside of what an element describes, empty if it does not.
  virtual std::string domain_violation(const Motion&) const { return {}; }
};

}  // namespace dynalin
