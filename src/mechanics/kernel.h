// The one seam between elements and the system: a Kernel holds all elements of one kind, contiguously, and
// is called once a pass. It knows formulas; it knows nothing of solvers.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mechanics/equations.h"
#include "mechanics/undefined_value.h"

namespace dynalin {

class Binder;
class BodySource;
class ChannelSource;
class DelaySource;
class EventSource;
class StartSource;
class SwitchSource;
class WrenchSource;

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
  // The rates of the courses of motions (DifferentialState::course_of_motion), by their places among all states. They
  // depend on time and on each other.
  virtual void course_rates(const Motion&, std::span<double> /*state_rates*/) const {}
  // Residuals of balance, algebraic and differential equations, and the partials that are wanted.
  virtual void equations(const Motion&, Equations&) const {}
  // Into so many shares equations() may be divided for several threads. More than one: it goes once through elements
  // that take nothing from each other, those of Equations::share.
  virtual std::size_t shares() const { return 1; }

  // --- points ---------------------------------------------------------------------------------------
  // An accepted configuration: take over what the memory holds (turn counts).
  virtual void remember(const Motion&, Memory&) const {}
  // Adds why elements yield no finite values or derivatives here, or where functions that they read bend or jump.
  virtual void undefined_values(const Motion&, UndefinedValues&) const {}
  // A sentence on how a converged point lies outside of what an element describes, empty if it does not.
  virtual std::string domain_violation(const Motion&) const { return {}; }

  // --- what others see of the elements, each a class of its own and null where there is nothing -------
  virtual const WrenchSource* wrenches() const { return nullptr; }
  // For the report of an operating point: reactions that no function reads as well.
  virtual const WrenchSource* reported_wrenches() const { return wrenches(); }
  virtual const ChannelSource* channels() const { return nullptr; }
  virtual const StartSource* starts() const { return nullptr; }
  virtual const SwitchSource* kinks() const { return nullptr; }
  virtual const EventSource* events() const { return nullptr; }
  virtual const DelaySource* delays() const { return nullptr; }
  // Of those that are bodies, one for each.
  virtual std::vector<const BodySource*> bodies() const { return {}; }
};

}  // namespace dynalin
