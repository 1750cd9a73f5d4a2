// CURSUB: a curve in space by a compiled routine, which gives the point and two derivatives by the parameter; an entry
// of its own gives the third one as well. It is called while the model is read, and so knows nothing of it.
#pragma once

#include <cstdint>
#include <string>

#include "expression/curve_law.h"
#include "routine/compiled_routine.h"

namespace dynalin {

// What a CURVE says to its routine.
struct CurveStatement {
  ElementId element;
  int id = 0;
  RoutineConstants parameters{};
  bool closed = false;
  int order = 0;  // 0 where nothing is written
  double first = -1, last = 1;
};

class CurveRoutine final : public CurveLaw {
 public:
  CurveRoutine(FoundRoutine, CurveStatement, RoutineDifferences);

  // The third one comes of an entry, else of differences of the second: in a linear model where those are allowed.
  Vec3<double> derivative(double u, int order) const override;
  std::string reason_of_value(double u) const override;
  std::string reason_of_derivatives(double u) const override;

  const CurveStatement& statement() const { return statement_; }
  std::string name() const;  // "the routine cursub of cam.so"
  // A sentence where a first or second derivative at u is not the one of what it belongs to, else empty.
  std::string wrong_derivative(double u) const;

 private:
  struct Memory;  // of the parameter that was asked for last in this thread
  Memory& remembered(double u) const;
  // Says what went wrong, empty if nothing did.
  std::string call(double u, int order, Vec3<double>& out) const;
  std::string call_entry(double u, Memory&) const;

  FoundRoutine found_;
  CurveStatement statement_;
  RoutineDifferences differences_;
  std::string what_;
  std::uint64_t serial_;
};

}  // namespace dynalin
