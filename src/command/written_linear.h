// LINEAR as it is written: every argument with its value, before any rule is looked at.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/schema.h"
#include "study/modal_tables.h"

namespace dynalin {

using Integers = std::vector<std::int64_t>;

// What asks for one table.
struct WrittenTable {
  Integers numbers;
  std::vector<double> frequencies;
  std::string all_or_numbers;
};

struct WrittenLinear {
  using Id = std::optional<std::int64_t>;

  bool eigensol = false, statemat = false, mkb = false, nastran_export = false;
  bool no_damping = false, no_vector = false, original = false, names = false, descriptor = false;
  Id rm, pstate, pinput, poutput, modal_rm, table_precision, mode_count;
  std::optional<double> near;
  std::vector<double> band;
  Integers mlist;
  std::string file, config;
  std::vector<std::string> format, type;
  std::vector<WrittenTable> tables = std::vector<WrittenTable>(modal_table_kinds().size());

  static constexpr std::array<Argument<WrittenLinear>, 23> arguments = {{
      {.name = "EIGENSOL", .slot = &WrittenLinear::eigensol, .help = "eigenvalues and mode shapes"},
      {.name = "STATEMAT", .slot = &WrittenLinear::statemat, .help = "state matrices A, B, C, D"},
      {.name = "MKB", .slot = &WrittenLinear::mkb, .help = "mass, stiffness and damping matrices of second order"},
      {.name = "EXPORT", .slot = &WrittenLinear::nastran_export, .help = "a Nastran deck (`dynalin help export`)"},
      {.name = "NODAMPIN", .slot = &WrittenLinear::no_damping, .help = "damping of forces counts as zero"},
      {.name = "NOVECTOR", .slot = &WrittenLinear::no_vector, .help = "eigenvalues alone, no mode shapes and tables"},
      {.name = "ORIGINAL",
       .slot = &WrittenLinear::original,
       .help = "coordinates and rules of the original implementation (docs/linear.md)"},
      {.name = "NAMES",
       .slot = &WrittenLinear::names,
       .help = "names of elements behind their ids in these tables, with a TABLE_PRECISION above 2"},
      {.name = "RM",
       .slot = &WrittenLinear::rm,
       .minimum = 1,
       .help = "marker in whose axes, turning with it, parts are described",
       .ids_of = MarkerClass::statement},
      {.name = "PSTATE",
       .slot = &WrittenLinear::pstate,
       .minimum = 1,
       .help = "the PSTATE whose VARIABLEs are the coordinates",
       .ids_of = "PSTATE"},
      {.name = "PINPUT",
       .slot = &WrittenLinear::pinput,
       .minimum = 1,
       .help = "the PINPUT whose VARIABLEs are the inputs of B and D",
       .ids_of = "PINPUT"},
      {.name = "POUTPUT",
       .slot = &WrittenLinear::poutput,
       .minimum = 1,
       .help = "the POUTPUT whose VARIABLEs are the outputs of C and D",
       .ids_of = "POUTPUT"},
      {.name = "FILE",
       .slot = &WrittenLinear::file,
       .help = "where the matrices or the deck go, relative to the command file"},
      {.name = "FORMAT",
       .slot = &WrittenLinear::format,
       .help = "of that file: MATRIXX, one for all, or MATLAB, one a matrix"},
      {.name = "TYPE",
       .slot = &WrittenLinear::type,
       .help = "of EXPORT: OPENBOX, element by element, or CLOSEDBOX, matrices of the whole"},
      {.name = "CONFIG",
       .slot = &WrittenLinear::config,
       .help = "of EXPORT: a file of directives, relative to the command file"},
      {.name = "MLIST",
       .slot = &WrittenLinear::mlist,
       .help = "markers whose motion in the modes MRANGE is shown",
       .ids_of = MarkerClass::statement},
      {.name = "MODAL_RM",
       .slot = &WrittenLinear::modal_rm,
       .minimum = 1,
       .help = "marker about which MASS_PER_MODE counts moments",
       .ids_of = MarkerClass::statement},
      {.name = "TABLE_PRECISION",
       .slot = &WrittenLinear::table_precision,
       .minimum = 2,
       .help = "decimals in these tables, 2 unless stated",
       .maximum = 100},
      {.name = "NMODES",
       .slot = &WrittenLinear::mode_count,
       .minimum = 1,
       .help = "of EIGENSOL: so many modes instead of all, the nearest to NEAR (an argument of Dynalin's)"},
      {.name = "NEAR",
       .slot = &WrittenLinear::near,
       .unit = "1/time",
       .minimum = 0,
       .help = "the frequency that NMODES are nearest to, 0 unless stated (of Dynalin's)"},
      {.name = "BAND",
       .slot = &WrittenLinear::band,
       .unit = "1/time",
       .help = "of EIGENSOL: all modes between two frequencies instead of all (of Dynalin's)"},
      {.name = "DESCRIPTOR",
       .slot = &WrittenLinear::descriptor,
       .help = "of STATEMAT: the sparse equations E, A, B, C, D instead of the state matrices (of Dynalin's)"},
  }};
};

}  // namespace dynalin
