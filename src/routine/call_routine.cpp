#include "routine/call_routine.h"

#include <algorithm>
#include <iterator>

#include "routine/given_inputs.h"
#include "routine/routine_memory.h"

namespace dynalin {

namespace {

template <class Signature>
Signature* as(void* address) {
  return reinterpret_cast<Signature*>(address);
}

// What x of a friction routine points to: whoever calculates with it gets no number.
constexpr std::array<double, 3> no_deformation = {unknown_value, unknown_value, unknown_value};

void call_with_addresses(void* address, RoutineArguments arguments, const RoutineStatement& s,
                         const RoutineArgumentsNow& now, double* values) {
  const auto npar = s.constants->count();
  const double* par = s.constants->data();
  switch (arguments) {
    case RoutineArguments::function:
    case RoutineArguments::of_time:
      return as<void(const int*, const double*, const double*, const int*, const int*, const int*, double*)>(address)(
          &s.id, &now.time, par, &npar, &now.flag, &now.iflag, values);
    case RoutineArguments::plain:
      return as<void(const int*, const double*, const double*, const int*, const int*, double*)>(address)(
          &s.id, &now.time, par, &npar, &now.iflag, values);
    case RoutineArguments::counted:
      return as<void(const int*, const double*, const double*, const int*, const int*, const int*, const int*,
                     double*)>(address)(&s.id, &now.time, par, &npar, &now.flag, &now.iflag, &now.values, values);
    case RoutineArguments::system:
      return as<void(const int*, const double*, const double*, const int*, const int*, const int*, const int*,
                     const double*, const int*, const double*, const int*, double*, double*)>(address)(
          &s.id, &now.time, par, &npar, &now.flag, &now.iflag, &s.gse->NS, now.states.data(), &s.gse->NI,
          now.inputs.data(), &s.gse->NO, values, values + s.gse->NS);
    case RoutineArguments::field:
      return as<void(const int*, const double*, const double*, const int*, const double*, const double*, const int*,
                     const int*, double*, double*, double*)>(address)(&s.id, &now.time, par, &npar, now.displacement,
                                                                      now.velocity, &now.flag, &now.iflag, values,
                                                                      now.by_displacement, now.by_velocity);
    case RoutineArguments::coupler: {
      const auto count = static_cast<int>(s.told.displacements);
      return as<void(const int*, const double*, const double*, const int*, const double*, const int*, const int*,
                     double*)>(address)(&s.id, &now.time, par, &npar, now.given, &count, &now.iflag, values);
    }
    case RoutineArguments::modal: {
      const auto modes = static_cast<int>(s.modal->modes), cases = static_cast<int>(s.modal->cases);
      return as<void(const int*, const double*, const double*, const int*, const int*, const int*, const double*,
                     const int*, const int*, double*, int*, double*)>(address)(
          &s.id, &now.time, par, &npar, &now.flag, &now.iflag, s.modal->loads.data(), &modes, &cases, now.scale,
          now.load_case, values);
    }
    case RoutineArguments::damping:
    case RoutineArguments::curve:
      return;  // classes of their own call them
    case RoutineArguments::pressure:
      return as<void(const int*, const double*, const double*, const int*, const double*, const double*, const double*,
                     const double*, const double*, const double*, const double*, const double*, const int*, const int*,
                     double*)>(address)(&s.id, &now.time, par, &npar, now.given, now.given + 3, now.given + 6,
                                        now.given + 9, now.given + 12, now.given + 13, &unknown_value, &unknown_value,
                                        &now.flag, &now.iflag, values);
    case RoutineArguments::friction:
      return as<void(const int*, const double*, const double*, const int*, const double*, const double*, const double*,
                     const double*, const double*, const double*, const int*, const int*, double*)>(address)(
          &s.id, &now.time, par, &npar, now.given, now.given + 3, no_deformation.data(), now.given + 6, now.given + 9,
          &unknown_value, &now.flag, &now.iflag, values);
  }
}

void call_with_structure(void* address, RoutineArguments arguments, const RoutineStatement& s,
                         const RoutineArgumentsNow& now, double* values) {
  const void* told = s.told.structure.get();
  switch (arguments) {
    case RoutineArguments::function:
    case RoutineArguments::of_time:
      return as<void(const void*, double, int, int, double*)>(address)(told, now.time, now.flag, now.iflag, values);
    case RoutineArguments::plain:
      return as<void(const void*, double, int, double*)>(address)(told, now.time, now.iflag, values);
    case RoutineArguments::counted:
      return as<void(const void*, double, int, int, int, double*)>(address)(told, now.time, now.flag, now.iflag,
                                                                            now.values, values);
    case RoutineArguments::system:
      return as<void(const void*, double, int, int, int, const double*, int, const double*, int, double*, double*)>(
          address)(told, now.time, now.flag, now.iflag, s.gse->NS, now.states.data(), s.gse->NI, now.inputs.data(),
                   s.gse->NO, values, values + s.gse->NS);
    case RoutineArguments::field:
      return as<void(const void*, double, const double*, const double*, int, int, double*, double*, double*)>(address)(
          told, now.time, now.displacement, now.velocity, now.flag, now.iflag, values, now.by_displacement,
          now.by_velocity);
    case RoutineArguments::coupler:
      return as<void(const void*, double, const double*, int, double*)>(address)(told, now.time, now.given, now.iflag,
                                                                                 values);
    case RoutineArguments::modal:
      return as<void(const void*, double, int, int, const double*, int, int, double*, int*, double*)>(address)(
          told, now.time, now.flag, now.iflag, s.modal->loads.data(), static_cast<int>(s.modal->modes),
          static_cast<int>(s.modal->cases), now.scale, now.load_case, values);
    case RoutineArguments::damping:
    case RoutineArguments::curve:
      return;
    case RoutineArguments::pressure:
      return as<void(const void*, double, const double*, const double*, const double*, const double*, double, double,
                     double, double, int, int, double*)>(address)(
          told, now.time, now.given, now.given + 3, now.given + 6, now.given + 9, now.given[12], now.given[13],
          unknown_value, unknown_value, now.flag, now.iflag, values);
    case RoutineArguments::friction:
      return as<void(const void*, double, const double*, const double*, const double*, const double*, double, double,
                     int, int, double*)>(address)(told, now.time, now.given, now.given + 3, no_deformation.data(),
                                                  now.given + 6, now.given[9], unknown_value, now.flag, now.iflag,
                                                  values);
  }
}

}  // namespace

void call_routine(const FoundRoutine& found, const RoutineKind& kind, const RoutineStatement& statement,
                  const RoutineArgumentsNow& now, double* values) {
  if (found.convention == RoutineConvention::addresses)
    return call_with_addresses(found.address, kind.arguments, statement, now, values);
  call_with_structure(found.address, kind.arguments, statement, now, values);
}

void call_state_partials(const FoundRoutine& found, const RoutineStatement& s, const RoutineArgumentsNow& now,
                         double* matrix) {
  const auto npar = s.constants->count();
  if (found.convention == RoutineConvention::addresses) {
    return as<void(const int*, const double*, const double*, const int*, const int*, const int*, const double*,
                   const int*, const double*, const int*, double*)>(found.address)(
        &s.id, &now.time, s.constants->data(), &npar, &now.iflag, &s.gse->NS, now.states.data(), &s.gse->NI,
        now.inputs.data(), &s.gse->NO, matrix);
  }
  as<void(const void*, double, int, int, const double*, int, const double*, int, double*)>(found.address)(
      s.told.structure.get(), now.time, now.iflag, s.gse->NS, now.states.data(), s.gse->NI, now.inputs.data(),
      s.gse->NO, matrix);
}

}  // namespace dynalin
