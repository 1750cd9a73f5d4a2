// EQUILIBRIUM, IC, INTEGRATOR, KINEMATICS, LSOLVER, DEBUG and PREFERENCES as written, in datasets and as commands.
#pragma once

#include "model/schema.h"
#include "model/settings.h"

namespace dynalin {

// EQUILIBRIUM: statics search on to rounding; ERROR and IMBALANCE say what is taken where that is not reached. METHOD,
// STABILITY and PATTERN ask for Newton's method first, DYNAMIC for a damped motion.
struct WrittenEquilibrium {
  std::optional<double> error, imbalance, stability, tlimit, alimit;
  std::optional<double> global_damping, acceleration_error, kinetic_energy_error, settling_time, end;
  std::optional<std::int64_t> maxit;
  std::vector<std::string> pattern, method;
  Obsolete other;
  bool is_static = false, is_dynamic = false, defaults = false, list = false;

  using E = WrittenEquilibrium;
  static constexpr std::string_view of_iterative_solver = "of an iterative linear solver; the one here is direct";
  static constexpr std::array<Argument<E>, 22> arguments = {{
      {.name = "ERROR",
       .slot = &E::error,
       .minimum = 0,
       .help = "largest correction, in model lengths or rad, where no exact equilibrium is found; 1e-4",
       .unstated = 1e-4},
      {.name = "IMBALANCE",
       .slot = &E::imbalance,
       .minimum = 0,
       .help = "largest force out of balance where no exact equilibrium is found; 1e-4",
       .unstated = 1e-4},
      {.name = "MAXIT",
       .slot = &E::maxit,
       .minimum = 1,
       .help = "iterations of the search downhill, 500, or of Newton's method, 25"},
      {.name = "ALIMIT",
       .slot = &E::alimit,
       .unit = unit::angle,
       .minimum = 0,
       .help = "largest rotation of a step, 10D"},
      {.name = "TLIMIT",
       .slot = &E::tlimit,
       .unit = unit::length,
       .minimum = 0,
       .help = "largest translation of a step; of Newton's method 20"},
      {.name = "STABILITY",
       .slot = &E::stability,
       .minimum = 0,
       .help = "multiple of the mass and damping matrices in the Jacobian of Newton's method, 1e-5"},
      {.name = "PATTERN",
       .slot = &E::pattern,
       .help = "T or F for each iteration of Newton's method: whether the Jacobian is evaluated anew"},
      {.name = "METHOD",
       .slot = &E::method,
       .help = "ORIGINAL: Newton's method before the other searches; ADVANCED, AGGRESSIVE, ALL: those alone"},
      {.name = "ATOL", .slot = &E::other, .help = of_iterative_solver},
      {.name = "RTOL", .slot = &E::other, .help = of_iterative_solver},
      {.name = "MAXITL", .slot = &E::other, .help = of_iterative_solver},
      {.name = "ETA", .slot = &E::other, .help = of_iterative_solver},
      {.name = "ETAMAX", .slot = &E::other, .help = of_iterative_solver},
      {.name = "STATIC", .slot = &E::is_static, .help = "without the damped motion of DYNAMIC"},
      {.name = "DYNAMIC", .slot = &E::is_dynamic, .help = "a damped motion before the other searches"},
      {.name = "ACCELERATION_ERROR",
       .slot = &E::acceleration_error,
       .minimum = 0,
       .help = "of that motion: the largest acceleration that may be rest, 1e-2",
       .unstated = 1e-2},
      {.name = "KINETIC_ENERGY_ERROR",
       .slot = &E::kinetic_energy_error,
       .minimum = 0,
       .help = "of that motion: the largest kinetic energy that may be rest, 1e-2",
       .unstated = 1e-2},
      {.name = "GLOBAL_DAMPING",
       .slot = &E::global_damping,
       .unit = unit::damping,
       .minimum = 0,
       .help = "of every part in that motion, 0",
       .unstated = 0},
      {.name = "SETTLING_TIME", .slot = &E::settling_time, .minimum = 0, .help = "longest time of that motion"},
      {.name = "TEND", .slot = &E::end, .minimum = 0, .help = "the same"},
      {.name = "DEFAULT", .slot = &E::defaults, .help = "all settings as they are without the statement"},
      {.name = "LIST", .slot = &E::list},
  }};
  static constexpr std::array<std::string_view, 17> acting = {"ERROR",
                                                              "IMBALANCE",
                                                              "MAXIT",
                                                              "ALIMIT",
                                                              "TLIMIT",
                                                              "STABILITY",
                                                              "PATTERN",
                                                              "METHOD",
                                                              "STATIC",
                                                              "DYNAMIC",
                                                              "DEFAULT",
                                                              "GLOBAL_DAMPING",
                                                              "ACCELERATION_ERROR",
                                                              "KINETIC_ENERGY_ERROR",
                                                              "SETTLING_TIME",
                                                              "TEND",
                                                              "LIST"};
  static constexpr std::array<std::string_view, 1> alternatives = {"STATIC DYNAMIC"};
  bool check(ElementReader&) const;
  EquilibriumSettings stated() const;
  void apply(EquilibriumSettings& s) const {
    if (defaults) s = {};
    take_over(s, stated());
  }
  void apply(Settings& s) const { apply(s.equilibrium); }
};

// IC: ERROR is how far redundant constraints may be from agreeing with the others, as a part of the model's length or
// in radians; VERROR and AERROR say so of velocities and accelerations, as a part of the terms of a constraint. MAXIT,
// TLIMIT and ALIMIT bound the iteration for positions, AMAXIT that for accelerations. All are found to rounding.
struct WrittenInitialConditions {
  std::optional<double> error, verror, aerror, tlimit, alimit;
  std::optional<std::int64_t> maxit, amaxit;
  std::vector<std::string> pattern, apattern;
  bool defaults = false, list = false;

  using E = WrittenInitialConditions;
  static constexpr std::array<Argument<E>, 11> arguments = {{
      {.name = "ERROR", .slot = &E::error, .minimum = 0, .help = "of redundant constraints, 1e-10", .unstated = 1e-10},
      {.name = "VERROR", .slot = &E::verror, .minimum = 0, .help = "the same on velocities; 100 ERROR, at least 1e-8"},
      {.name = "AERROR",
       .slot = &E::aerror,
       .minimum = 0,
       .help = "the same on accelerations; 100 ERROR, at least 1e-8"},
      {.name = "MAXIT", .slot = &E::maxit, .minimum = 1, .help = "iterations for positions, 50", .unstated = 50},
      {.name = "AMAXIT",
       .slot = &E::amaxit,
       .minimum = 1,
       .help = "iterations for accelerations, 100",
       .unstated = 100},
      {.name = "TLIMIT",
       .slot = &E::tlimit,
       .unit = unit::length,
       .minimum = 0,
       .help = "largest translation of an iteration"},
      {.name = "ALIMIT",
       .slot = &E::alimit,
       .unit = unit::angle,
       .minimum = 0,
       .help = "largest rotation of an iteration, 0.5 rad"},
      {.name = "PATTERN", .slot = &E::pattern},
      {.name = "APATTERN", .slot = &E::apattern},
      {.name = "DEFAULT", .slot = &E::defaults, .help = "all settings as they are without the statement"},
      {.name = "LIST", .slot = &E::list},
  }};
  static constexpr std::array<std::string_view, 9> acting = {"ERROR",  "VERROR", "AERROR",  "MAXIT", "AMAXIT",
                                                             "TLIMIT", "ALIMIT", "DEFAULT", "LIST"};
  InitialConditionSettings stated() const { return {error, verror, aerror, tlimit, alimit, maxit, amaxit}; }
  void apply(InitialConditionSettings& s) const {
    if (defaults) s = {};
    take_over(s, stated());
  }
  void apply(Settings& s) const { apply(s.initial_conditions); }
};

// INTEGRATOR: SUNDIALS IDA integrates the equations in stabilized index 2, whichever method is named. ERROR and the
// bounds of its steps and order act on it; what belongs to other methods has no meaning for it.
struct WrittenIntegrator {
  bool gstiff = false, wstiff = false, hastiff = false, dstiff = false, hht = false, newmark = false, abam = false;
  bool rkf45 = false, constant_bdf = false, i3 = false, si2 = false, si1 = false;
  std::optional<double> error, hmax, hinit, hmin, number;
  std::optional<std::int64_t> kmax, maxit, count;
  std::vector<std::string> interpolate, words;
  Obsolete value;
  bool defaults = false, list = false;

  using E = WrittenIntegrator;
  static constexpr std::string_view method = "a method of Adams; SUNDIALS IDA integrates instead";
  static constexpr std::string_view form = "a form of the equations; stabilized index 2 is used instead";
  static constexpr std::array<Argument<E>, 38> arguments = {{
      {.name = "GSTIFF", .slot = &E::gstiff, .help = method},
      {.name = "WSTIFF", .slot = &E::wstiff, .help = method},
      {.name = "HASTIFF", .slot = &E::hastiff, .help = method},
      {.name = "DSTIFF", .slot = &E::dstiff, .help = method},
      {.name = "HHT", .slot = &E::hht, .help = method},
      {.name = "NEWMARK", .slot = &E::newmark, .help = method},
      {.name = "ABAM", .slot = &E::abam, .help = method},
      {.name = "RKF45", .slot = &E::rkf45, .help = method},
      {.name = "CONSTANT_BDF", .slot = &E::constant_bdf, .help = method},
      {.name = "I3", .slot = &E::i3, .help = form},
      {.name = "SI2", .slot = &E::si2, .help = "stabilized index 2"},
      {.name = "SI1", .slot = &E::si1, .help = form},
      {.name = "ERROR",
       .slot = &E::error,
       .minimum = 0,
       .help = "what errors may add up to: part of the model's length, of a radian, of the fastest motion; 1e-3",
       .unstated = 1e-3},
      {.name = "HMAX", .slot = &E::hmax, .unit = "time", .minimum = 0, .help = "longest step; an interval of output"},
      {.name = "HINIT", .slot = &E::hinit, .unit = "time", .minimum = 0, .help = "first step"},
      {.name = "HMIN", .slot = &E::hmin, .unit = "time", .minimum = 0, .help = "a shorter step ends the simulation"},
      {.name = "KMAX",
       .slot = &E::kmax,
       .minimum = 1,
       .help = "highest order; 5 is the most that is used",
       .unstated = 5},
      {.name = "MAXIT", .slot = &E::maxit, .minimum = 1, .help = "iterations of a step, 4", .unstated = 4},
      {.name = "CORRECTOR", .slot = &E::words},
      {.name = "INTERPOLATE", .slot = &E::interpolate, .help = "ON: steps may be longer than an interval of output"},
      {.name = "ALPHA", .slot = &E::number},
      {.name = "BETA", .slot = &E::number},
      {.name = "GAMMA", .slot = &E::number},
      {.name = "PATTERN", .slot = &E::words},
      {.name = "ADAPTIVITY", .slot = &E::number},
      {.name = "SCALE", .slot = &E::value},
      {.name = "FIXIT", .slot = &E::count},
      {.name = "HRATIO", .slot = &E::number},
      {.name = "MAXERR", .slot = &E::number},
      {.name = "PHASE", .slot = &E::value},
      {.name = "DTOL", .slot = &E::number},
      {.name = "REUSE", .slot = &E::value},
      {.name = "TRELAX", .slot = &E::value},
      {.name = "VRTOL", .slot = &E::value},
      {.name = "BETA_BDF", .slot = &E::value},
      {.name = "ORDER", .slot = &E::count},
      {.name = "DEFAULT", .slot = &E::defaults, .help = "all settings as they are without the statement"},
      {.name = "LIST", .slot = &E::list},
  }};
  static constexpr std::array<std::string_view, 21> acting = {
      "GSTIFF", "WSTIFF", "HASTIFF", "DSTIFF", "HHT",  "NEWMARK", "ABAM",  "RKF45",       "CONSTANT_BDF", "I3",  "SI2",
      "SI1",    "ERROR",  "HMAX",    "HINIT",  "HMIN", "KMAX",    "MAXIT", "INTERPOLATE", "DEFAULT",      "LIST"};
  static constexpr std::array<std::string_view, 2> alternatives = {
      "GSTIFF WSTIFF HASTIFF DSTIFF HHT NEWMARK ABAM RKF45 CONSTANT_BDF", "I3 SI2 SI1"};
  bool check(ElementReader&) const;
  IntegratorSettings stated() const {
    IntegratorSettings s;
    s.error = error, s.largest_step = hmax, s.first_step = hinit, s.least_step = hmin;
    const std::array<std::pair<bool, const char*>, 9> types = {{{gstiff, "GSTIFF"},
                                                                {wstiff, "WSTIFF"},
                                                                {hastiff, "HASTIFF"},
                                                                {dstiff, "DSTIFF"},
                                                                {hht, "HHT"},
                                                                {newmark, "NEWMARK"},
                                                                {abam, "ABAM"},
                                                                {rkf45, "RKF45"},
                                                                {constant_bdf, "CONSTANT_BDF"}}};
    for (const auto& [given, name] : types) {
      if (given) s.type = name;
    }
    if (i3 || si2 || si1) s.formulation = i3 ? "I3" : si2 ? "SI2" : "SI1";
    s.largest_order = kmax, s.iteration_limit = maxit;
    if (!interpolate.empty()) s.interpolate = interpolate.front() != "OFF";
    return s;
  }
  void apply(IntegratorSettings& s) const {
    if (defaults) s = {};
    take_over(s, stated());
  }
  void apply(Settings& s) const { apply(s.integrator); }
};

// KINEMATICS: MAXIT, ALIMIT and TLIMIT bound the iteration for positions, of which a longer one halves the step, HMAX
// the steps themselves; ERROR is how far redundant constraints may be from agreeing with the others on the way.
// Positions and accelerations are found to rounding, whatever the rest asks.
struct WrittenKinematics {
  std::optional<double> error, aerror, tlimit, alimit, hmax;
  std::optional<std::int64_t> maxit, amaxit;
  std::vector<std::string> pattern, apattern;
  bool defaults = false, list = false;

  using E = WrittenKinematics;
  static constexpr std::array<Argument<E>, 11> arguments = {{
      {.name = "ERROR", .slot = &E::error, .minimum = 0, .help = "of redundant constraints, that of IC"},
      {.name = "AERROR", .slot = &E::aerror, .minimum = 0},
      {.name = "MAXIT",
       .slot = &E::maxit,
       .minimum = 1,
       .help = "iterations for the positions of a step, 25",
       .unstated = 25},
      {.name = "AMAXIT", .slot = &E::amaxit, .minimum = 1},
      {.name = "TLIMIT",
       .slot = &E::tlimit,
       .unit = unit::length,
       .minimum = 0,
       .help = "largest translation of an iteration"},
      {.name = "ALIMIT",
       .slot = &E::alimit,
       .unit = unit::angle,
       .minimum = 0,
       .help = "largest rotation of an iteration, 30 degrees"},
      {.name = "HMAX", .slot = &E::hmax, .unit = "time", .minimum = 0, .help = "largest step"},
      {.name = "PATTERN", .slot = &E::pattern},
      {.name = "APATTERN", .slot = &E::apattern},
      {.name = "DEFAULT", .slot = &E::defaults, .help = "all settings as they are without the statement"},
      {.name = "LIST", .slot = &E::list},
  }};
  static constexpr std::array<std::string_view, 7> acting = {"ERROR", "MAXIT",   "TLIMIT", "ALIMIT",
                                                             "HMAX",  "DEFAULT", "LIST"};
  KinematicsSettings stated() const { return {error, aerror, tlimit, alimit, hmax, maxit, amaxit}; }
  void apply(KinematicsSettings& s) const {
    if (defaults) s = {};
    take_over(s, stated());
  }
  void apply(Settings& s) const { apply(s.kinematics); }
};

struct WrittenLinearSolver {
  bool flag = false;
  Obsolete value;

  using E = WrittenLinearSolver;
  static constexpr std::array<Argument<E>, 7> arguments = {{
      {.name = "AUTO", .slot = &E::flag},
      {.name = "CALAHAN", .slot = &E::flag},
      {.name = "HARWELL", .slot = &E::flag},
      {.name = "UMF", .slot = &E::flag},
      {.name = "STABILITY", .slot = &E::value},
      {.name = "DEFAULT", .slot = &E::flag},
      {.name = "LIST", .slot = &E::flag},
  }};
  static constexpr std::array<std::string_view, 1> acting = {"LIST"};
  void apply(Settings&) const {}
};

struct WrittenDebug {
  bool eprint = false, noeprint = false, flag = false;

  using E = WrittenDebug;
  static constexpr std::array<Argument<E>, 20> arguments = {{
      {.name = "EPRINT", .slot = &E::eprint, .help = "iterations of statics in the message file"},
      {.name = "NOEPRINT", .slot = &E::noeprint, .help = "without them"},
      {.name = "VERBOSE", .slot = &E::flag},
      {.name = "NOVERBOSE", .slot = &E::flag},
      {.name = "DUMP", .slot = &E::flag},
      {.name = "NODUMP", .slot = &E::flag},
      {.name = "RHSDUMP", .slot = &E::flag},
      {.name = "NORHSDUMP", .slot = &E::flag},
      {.name = "JMDUMP", .slot = &E::flag},
      {.name = "NOJMDUMP", .slot = &E::flag},
      {.name = "REQDUMP", .slot = &E::flag},
      {.name = "NOREQDUMP", .slot = &E::flag},
      {.name = "TOPOLOGY", .slot = &E::flag},
      {.name = "NOTOPOLOGY", .slot = &E::flag},
      {.name = "DOF", .slot = &E::flag},
      {.name = "NODOF", .slot = &E::flag},
      {.name = "SCREEN", .slot = &E::flag},
      {.name = "NOSCREEN", .slot = &E::flag},
      {.name = "YYDUMP", .slot = &E::flag},
      {.name = "LIST", .slot = &E::flag},
  }};
  static constexpr std::array<std::string_view, 3> acting = {"EPRINT", "NOEPRINT", "LIST"};
  void apply(Settings& s) const {
    if (eprint || noeprint) s.prints_iterations = eprint;
  }
};

// PREFERENCES: which solver a dataset was written for is worth a word, for it decides on the states of LINEAR.
struct WrittenPreferences {
  std::vector<std::string> solver;
  OptionalWord simexit, status_message;
  bool flag = false;
  Obsolete value;
  std::string text;

  using E = WrittenPreferences;
  static constexpr std::array<Argument<E>, 14> arguments = {{
      {.name = "SOLVER", .slot = &E::solver, .help = "F77 or FORTRAN, which bring a remark, or CXX"},
      {.name = "LIST", .slot = &E::flag},
      {.name = "STATUS_MESSAGE",
       .slot = &E::status_message,
       .help = "as a command: OFF takes away the line that shows how far a command is"},
      {.name = "SIMEXIT", .slot = &E::simexit, .help = "as a command: a command that fails ends the session"},
      {.name = "LIBPATH", .slot = &E::text},
      {.name = "CONTACT_GEOMETRY_LIBRARY", .slot = &E::text},
      {.name = "CONTACT_FACETING_TOLERANCE", .slot = &E::value},
      {.name = "CONTACT_FACETING_TYPE", .slot = &E::value},
      {.name = "THREAD", .slot = &E::value},
      {.name = "NTHREADS", .slot = &E::value},
      {.name = "FLEX_LIMIT_CHECK", .slot = &E::value},
      {.name = "FLEX_LIMIT_CHECK_ACTION", .slot = &E::value},
      {.name = "FLEX_LIMIT_CHECK_CRITERIA", .slot = &E::value},
      {.name = "FUNCTION_ERROR", .slot = &E::value},
  }};
  static constexpr std::array<std::string_view, 4> acting = {"SOLVER", "LIST", "SIMEXIT", "STATUS_MESSAGE"};
  bool check(ElementReader&) const;
  void note(Diagnostics& remarks) const {
    if (solver.empty() || !solver.front().starts_with('F')) return;  // F77 or FORTRAN
    remarks.warning("fortran-solver", {},
                    "PREFERENCES/SOLVER=" + solver.front() +
                        " asks for the FORTRAN solver: LINEAR with ORIGINAL gives the states and the coupling of that "
                        "solver");
  }
  // The session is no matter of the dataset.
  void apply(Settings& s) const {
    note(s.remarks);
    if (simexit.given) s.pass_over("PREFERENCES/SIMEXIT");
    if (status_message.given) s.pass_over("PREFERENCES/STATUS_MESSAGE");
  }
};

}  // namespace dynalin
