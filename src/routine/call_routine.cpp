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
  const auto npar = s.parameters.count();
  const double* par = s.parameters.data();
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
      const auto count = static_cast<int>(s.coupled.size());
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

// Every one of these but those of a CONTACT and an MFORCE begins with id and constants.
union WhatItSays {
  sAdamsVariable variable;
  sAdamsSforce sforce;
  sAdamsGforce gforce;
  sAdamsVforce vforce;
  sAdamsDiff diff;
  sAdamsField field;
  sAdamsMotion motion;
  sAdamsRequest request;
  sAdamsSensor sensor;
  sAdamsGSE gse;
  sAdamsContactFriction contact;
  sAdamsCoupler coupler;
  sAdamsNforce nforce;
  sAdamsMforce mforce;
};

WhatItSays what_it_says(std::string_view statement, const RoutineStatement& s) {
  const auto npar = s.parameters.count();
  const double* par = s.parameters.data();
  WhatItSays all{};
  all.variable = {s.id, npar, par, s.initial};
  if (statement == "SFORCE")
    all.sforce = {s.id, npar, par, s.I, s.J, s.action_only, s.rotation ? "ROTATION" : "TRANSLATION"};
  if (statement == "GFORCE") all.gforce = {s.id, npar, par, s.I, s.RM, s.JFLOAT};
  if (statement == "VFORCE" || statement == "VTORQUE") all.vforce = {s.id, npar, par, s.I, s.JFLOAT, s.RM};
  if (statement == "FIELD") all.field = {s.id, npar, par, s.I, s.J};
  if (statement == "DIFF") all.diff = {s.id, npar, par, s.static_hold, s.implicit, s.initial, s.initial_rate};
  if (statement == "MOTION") {
    const RoutineStatement::Drive& d = s.drive;
    all.motion = {s.id, npar, par, d.joint, d.type, s.I, s.J, {d.axis[0], d.axis[1]}, d.level};
  }
  if (statement == "SENSOR") {
    const RoutineStatement::Watch& w = s.watch;
    all.sensor = {s.id, npar, par, w.value, w.error, {w.condition[0], w.condition[1]}};
  }
  if (statement == "REQUEST") {
    all.request = {s.id, npar, par, s.heading->comment.c_str(), {}};
    for (std::size_t k = 0; k < s.heading->titles.size(); ++k) all.request.TITLE[k] = s.heading->titles[k].c_str();
  }
  if (statement == "COUPLER") {
    all.coupler = {s.id, npar, par, static_cast<int>(s.coupled.size()), {}, {}};
    for (std::size_t k = 0; k < std::min(s.coupled.size(), std::size(all.coupler.JOINTS)); ++k)
      all.coupler.JOINTS[k] = s.coupled[k].joint, all.coupler.TYPE[k] = s.coupled[k].type;
  }
  if (statement == "CONTACT") {
    const RoutineStatement::Sides& sides = *s.sides;
    all.contact = {{s.id, static_cast<int>(sides.I.size()), static_cast<int>(sides.J.size()), sides.I.data(),
                    sides.J.data(), sides.reversed_I.data(), sides.reversed_J.data()},
                   npar,
                   par};
  }
  if (statement == "NFORCE")
    all.nforce = {s.id, npar, par, static_cast<int>(s.markers->size()), s.markers->data(), s.J};
  if (statement == "MFORCE") all.mforce = {{s.modal->body}, s.id, npar, par, s.JFLOAT};
  if (statement == "GSE") {
    all.gse = *s.gse;
    all.gse.ID = s.id, all.gse.NPAR = npar, all.gse.PAR = par;
  }
  return all;
}

void call_with_statement(void* address, RoutineArguments arguments, const WhatItSays& s,
                         const RoutineStatement::ModalLoad* modal, const RoutineArgumentsNow& now, double* values) {
  switch (arguments) {
    case RoutineArguments::function:
    case RoutineArguments::of_time:
      return as<void(const void*, double, int, int, double*)>(address)(&s, now.time, now.flag, now.iflag, values);
    case RoutineArguments::plain:
      return as<void(const void*, double, int, double*)>(address)(&s, now.time, now.iflag, values);
    case RoutineArguments::counted:
      return as<void(const void*, double, int, int, int, double*)>(address)(&s, now.time, now.flag, now.iflag,
                                                                            now.values, values);
    case RoutineArguments::system:
      return as<void(const void*, double, int, int, int, const double*, int, const double*, int, double*, double*)>(
          address)(&s, now.time, now.flag, now.iflag, s.gse.NS, now.states.data(), s.gse.NI, now.inputs.data(),
                   s.gse.NO, values, values + s.gse.NS);
    case RoutineArguments::field:
      return as<void(const void*, double, const double*, const double*, int, int, double*, double*, double*)>(address)(
          &s, now.time, now.displacement, now.velocity, now.flag, now.iflag, values, now.by_displacement,
          now.by_velocity);
    case RoutineArguments::coupler:
      return as<void(const void*, double, const double*, int, double*)>(address)(&s, now.time, now.given, now.iflag,
                                                                                 values);
    case RoutineArguments::modal:
      return as<void(const void*, double, int, int, const double*, int, int, double*, int*, double*)>(address)(
          &s, now.time, now.flag, now.iflag, modal->loads.data(), static_cast<int>(modal->modes),
          static_cast<int>(modal->cases), now.scale, now.load_case, values);
    case RoutineArguments::damping:
    case RoutineArguments::curve:
      return;
    case RoutineArguments::pressure:
      return as<void(const void*, double, const double*, const double*, const double*, const double*, double, double,
                     double, double, int, int, double*)>(address)(
          &s, now.time, now.given, now.given + 3, now.given + 6, now.given + 9, now.given[12], now.given[13],
          unknown_value, unknown_value, now.flag, now.iflag, values);
    case RoutineArguments::friction:
      return as<void(const void*, double, const double*, const double*, const double*, const double*, double, double,
                     int, int, double*)>(address)(&s, now.time, now.given, now.given + 3, no_deformation.data(),
                                                  now.given + 6, now.given[9], unknown_value, now.flag, now.iflag,
                                                  values);
  }
}

}  // namespace

void call_routine(const FoundRoutine& found, const RoutineKind& kind, const RoutineStatement& statement,
                  const RoutineArgumentsNow& now, double* values) {
  if (found.convention == RoutineConvention::addresses)
    return call_with_addresses(found.address, kind.arguments, statement, now, values);
  call_with_statement(found.address, kind.arguments, what_it_says(kind.statement, statement), statement.modal.get(),
                      now, values);
}

void call_state_partials(const FoundRoutine& found, const RoutineStatement& s, const RoutineArgumentsNow& now,
                         double* matrix) {
  const auto npar = s.parameters.count();
  if (found.convention == RoutineConvention::addresses) {
    return as<void(const int*, const double*, const double*, const int*, const int*, const int*, const double*,
                   const int*, const double*, const int*, double*)>(found.address)(
        &s.id, &now.time, s.parameters.data(), &npar, &now.iflag, &s.gse->NS, now.states.data(), &s.gse->NI,
        now.inputs.data(), &s.gse->NO, matrix);
  }
  const WhatItSays all = what_it_says("GSE", s);
  as<void(const void*, double, int, int, const double*, int, const double*, int, double*)>(found.address)(
      &all, now.time, now.iflag, s.gse->NS, now.states.data(), s.gse->NI, now.inputs.data(), s.gse->NO, matrix);
}

}  // namespace dynalin
