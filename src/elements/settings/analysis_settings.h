// EQUILIBRIUM, IC, INTEGRATOR, KINEMATICS, LSOLVER, DEBUG and PREFERENCES as written, in datasets and as commands.
#pragma once

#include "model/schema.h"
#include "model/settings.h"

namespace dynalin {

// EQUILIBRIUM: MAXIT, ALIMIT and TLIMIT bound the search of statics, which goes on to rounding; ERROR and IMBALANCE say
// what is taken where that is not reached. STABILITY, PATTERN and METHOD have no meaning for that search.
struct WrittenEquilibrium {
  std::optional<double> error, imbalance, stability, tlimit, alimit;
  std::optional<std::int64_t> maxit;
  std::vector<std::string> pattern, method;
  Obsolete other;
  bool is_static = false, is_dynamic = false, defaults = false, list = false;

  using E = WrittenEquilibrium;
  static constexpr std::array<Argument<E>, 22> arguments = {{
      {.name = "ERROR",
       .slot = &E::error,
       .minimum = 0,
       .help = "largest correction, in model lengths or rad, where no exact equilibrium is found; 1e-4"},
      {.name = "IMBALANCE",
       .slot = &E::imbalance,
       .minimum = 0,
       .help = "largest force out of balance where no exact equilibrium is found; 1e-4"},
      {.name = "MAXIT", .slot = &E::maxit, .minimum = 1, .help = "iterations of the search downhill"},
      {.name = "ALIMIT", .slot = &E::alimit, .unit = unit::angle, .minimum = 0, .help = "largest rotation of a step"},
      {.name = "TLIMIT",
       .slot = &E::tlimit,
       .unit = unit::length,
       .minimum = 0,
       .help = "largest translation of a step"},
      {.name = "STABILITY", .slot = &E::stability, .minimum = 0},
      {.name = "PATTERN", .slot = &E::pattern},
      {.name = "METHOD", .slot = &E::method},
      {.name = "ATOL", .slot = &E::other},
      {.name = "RTOL", .slot = &E::other},
      {.name = "MAXITL", .slot = &E::other},
      {.name = "ETA", .slot = &E::other},
      {.name = "ETAMAX", .slot = &E::other},
      {.name = "STATIC", .slot = &E::is_static},
      {.name = "DYNAMIC", .slot = &E::is_dynamic},
      {.name = "ACCELERATION_ERROR", .slot = &E::other},
      {.name = "KINETIC_ENERGY_ERROR", .slot = &E::other},
      {.name = "GLOBAL_DAMPING", .slot = &E::other},
      {.name = "SETTLING_TIME", .slot = &E::other},
      {.name = "TEND", .slot = &E::other},
      {.name = "DEFAULT", .slot = &E::defaults, .help = "all settings as they are without the statement"},
      {.name = "LIST", .slot = &E::list},
  }};
  static constexpr std::array<std::string_view, 8> acting = {"ERROR",  "IMBALANCE", "MAXIT",   "ALIMIT",
                                                             "TLIMIT", "STATIC",    "DEFAULT", "LIST"};
  EquilibriumSettings stated() const { return {error, imbalance, stability, tlimit, alimit, maxit}; }
  void apply(EquilibriumSettings& s) const {
    if (defaults) s = {};
    take_over(s, stated());
  }
  void apply(Settings& s) const { apply(s.equilibrium); }
};

// IC: ERROR is how far redundant constraints may be from agreeing with the others, as a part of the model's length or
// in radians. Positions, velocities and accelerations are found to rounding, whatever the rest asks.
struct WrittenInitialConditions {
  std::optional<double> error, verror, aerror, tlimit, alimit;
  std::optional<std::int64_t> maxit, amaxit;
  std::vector<std::string> pattern, apattern;
  bool defaults = false, list = false;

  using E = WrittenInitialConditions;
  static constexpr std::array<Argument<E>, 11> arguments = {{
      {.name = "ERROR", .slot = &E::error, .minimum = 0, .help = "of redundant constraints, 1e-10"},
      {.name = "VERROR", .slot = &E::verror, .minimum = 0},
      {.name = "AERROR", .slot = &E::aerror, .minimum = 0},
      {.name = "MAXIT", .slot = &E::maxit, .minimum = 1},
      {.name = "AMAXIT", .slot = &E::amaxit, .minimum = 1},
      {.name = "TLIMIT", .slot = &E::tlimit, .unit = unit::length, .minimum = 0},
      {.name = "ALIMIT", .slot = &E::alimit, .unit = unit::angle, .minimum = 0},
      {.name = "PATTERN", .slot = &E::pattern},
      {.name = "APATTERN", .slot = &E::apattern},
      {.name = "DEFAULT", .slot = &E::defaults},
      {.name = "LIST", .slot = &E::list},
  }};
  static constexpr std::array<std::string_view, 3> acting = {"ERROR", "DEFAULT", "LIST"};
  InitialConditionSettings stated() const { return {error, verror, aerror, tlimit, alimit, maxit, amaxit}; }
  void apply(InitialConditionSettings& s) const {
    if (defaults) s = {};
    take_over(s, stated());
  }
  void apply(Settings& s) const { apply(s.initial_conditions); }
};

// Settings of what moves in time, of solvers and of diagnostic output: checked, and nothing acts on them.
struct WrittenIntegrator {
  bool flag = false;
  Obsolete value;
  std::optional<double> number;
  std::optional<std::int64_t> count;
  std::vector<std::string> words;

  using E = WrittenIntegrator;
  static constexpr std::array<Argument<E>, 38> arguments = {{
      {.name = "GSTIFF", .slot = &E::flag},       {.name = "WSTIFF", .slot = &E::flag},
      {.name = "HASTIFF", .slot = &E::flag},      {.name = "DSTIFF", .slot = &E::flag},
      {.name = "HHT", .slot = &E::flag},          {.name = "NEWMARK", .slot = &E::flag},
      {.name = "ABAM", .slot = &E::flag},         {.name = "RKF45", .slot = &E::flag},
      {.name = "CONSTANT_BDF", .slot = &E::flag}, {.name = "I3", .slot = &E::flag},
      {.name = "SI2", .slot = &E::flag},          {.name = "SI1", .slot = &E::flag},
      {.name = "ERROR", .slot = &E::number},      {.name = "HMAX", .slot = &E::number},
      {.name = "HINIT", .slot = &E::number},      {.name = "HMIN", .slot = &E::number},
      {.name = "KMAX", .slot = &E::count},        {.name = "MAXIT", .slot = &E::count},
      {.name = "CORRECTOR", .slot = &E::words},   {.name = "INTERPOLATE", .slot = &E::words},
      {.name = "ALPHA", .slot = &E::number},      {.name = "BETA", .slot = &E::number},
      {.name = "GAMMA", .slot = &E::number},      {.name = "PATTERN", .slot = &E::words},
      {.name = "ADAPTIVITY", .slot = &E::number}, {.name = "SCALE", .slot = &E::value},
      {.name = "FIXIT", .slot = &E::count},       {.name = "HRATIO", .slot = &E::number},
      {.name = "MAXERR", .slot = &E::number},     {.name = "PHASE", .slot = &E::value},
      {.name = "DTOL", .slot = &E::number},       {.name = "REUSE", .slot = &E::value},
      {.name = "TRELAX", .slot = &E::value},      {.name = "VRTOL", .slot = &E::value},
      {.name = "BETA_BDF", .slot = &E::value},    {.name = "ORDER", .slot = &E::count},
      {.name = "DEFAULT", .slot = &E::flag},      {.name = "LIST", .slot = &E::flag},
  }};
  static constexpr std::array<std::string_view, 1> acting = {"LIST"};
  void apply(Settings&) const {}
};

struct WrittenKinematics {
  bool flag = false;
  std::optional<double> number;
  std::optional<std::int64_t> count;
  std::vector<std::string> words;

  using E = WrittenKinematics;
  static constexpr std::array<Argument<E>, 11> arguments = {{
      {.name = "ERROR", .slot = &E::number, .minimum = 0},
      {.name = "AERROR", .slot = &E::number, .minimum = 0},
      {.name = "MAXIT", .slot = &E::count, .minimum = 1},
      {.name = "AMAXIT", .slot = &E::count, .minimum = 1},
      {.name = "TLIMIT", .slot = &E::number, .minimum = 0},
      {.name = "ALIMIT", .slot = &E::number, .minimum = 0},
      {.name = "HMAX", .slot = &E::number, .minimum = 0},
      {.name = "PATTERN", .slot = &E::words},
      {.name = "APATTERN", .slot = &E::words},
      {.name = "DEFAULT", .slot = &E::flag},
      {.name = "LIST", .slot = &E::flag},
  }};
  static constexpr std::array<std::string_view, 1> acting = {"LIST"};
  void apply(Settings&) const {}
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
  bool flag = false;

  using E = WrittenDebug;
  static constexpr std::array<Argument<E>, 20> arguments = {{
      {.name = "EPRINT", .slot = &E::flag},   {.name = "NOEPRINT", .slot = &E::flag},
      {.name = "VERBOSE", .slot = &E::flag},  {.name = "NOVERBOSE", .slot = &E::flag},
      {.name = "DUMP", .slot = &E::flag},     {.name = "NODUMP", .slot = &E::flag},
      {.name = "RHSDUMP", .slot = &E::flag},  {.name = "NORHSDUMP", .slot = &E::flag},
      {.name = "JMDUMP", .slot = &E::flag},   {.name = "NOJMDUMP", .slot = &E::flag},
      {.name = "REQDUMP", .slot = &E::flag},  {.name = "NOREQDUMP", .slot = &E::flag},
      {.name = "TOPOLOGY", .slot = &E::flag}, {.name = "NOTOPOLOGY", .slot = &E::flag},
      {.name = "DOF", .slot = &E::flag},      {.name = "NODOF", .slot = &E::flag},
      {.name = "SCREEN", .slot = &E::flag},   {.name = "NOSCREEN", .slot = &E::flag},
      {.name = "YYDUMP", .slot = &E::flag},   {.name = "LIST", .slot = &E::flag},
  }};
  static constexpr std::array<std::string_view, 1> acting = {"LIST"};
  void apply(Settings&) const {}
};

// PREFERENCES: which solver a dataset was written for is worth a word, for it decides on the states of LINEAR.
struct WrittenPreferences {
  std::vector<std::string> solver;
  bool flag = false;
  Obsolete value;
  std::string text;

  using E = WrittenPreferences;
  static constexpr std::array<Argument<E>, 14> arguments = {{
      {.name = "SOLVER", .slot = &E::solver, .help = "F77 or CXX"},
      {.name = "LIST", .slot = &E::flag},
      {.name = "STATUS_MESSAGE", .slot = &E::value},
      {.name = "SIMEXIT", .slot = &E::value},
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
  static constexpr std::array<std::string_view, 2> acting = {"SOLVER", "LIST"};
  void note(Diagnostics& remarks) const {
    if (solver.empty() || !(solver.front().starts_with("F77") || solver.front().starts_with("FOR"))) return;
    remarks.warning("fortran-solver", {},
                    "PREFERENCES/SOLVER=F77 asks for the FORTRAN solver: LINEAR with ORIGINAL gives the states and the "
                    "coupling of that solver");
  }
  void apply(Settings& s) const { note(s.remarks); }
};

}  // namespace dynalin
