// FLEX_BODY/id, {MNF_FILE= | MATRICES=} [, QG=, {REULER= | ZG=, XG=}, VX= … WZ=, VM=, WM=, EXACT=, CRATIO=,
// GENERALIZED_DAMPING=, DMODE=, VMODE=, MODAL_EXACT_DISP=, MODAL_EXACT_VEL=, INVARIANTS=, CHAR_LEN=, REPRESENTATION=]
//
// An elastic body by its modes: it moves as a whole with its BCS and deforms by the modal coordinates q, of which the
// file, or MATRIX statements, have shapes, generalized mass and stiffness. Deflections are small, motions of the whole
// are not. Velocities are those of the BCS, along the axes of VM (global) and WM (its own).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flexible/modal_body.h"
#include "model/schema.h"

namespace dynalin {

struct FlexBody {
  std::string file, database, deck;
  std::vector<std::int64_t> matrices;
  std::optional<std::int64_t> index_in_database;
  Vector origin;
  std::optional<Vector> angles, z_point, x_point;
  std::optional<double> vx, vy, vz, wx, wy, wz;
  MarkerId vm, wm;
  std::vector<std::string> exact;
  std::string ratio, generalized_damping, representation;
  std::vector<double> displacements, rates;
  std::vector<std::int64_t> held_displacements, held_rates;
  std::vector<std::string> invariants;
  std::optional<double> dynamic_limit, stability_factor;
  double length = 0;
  Matrix3 axes = Matrix3::identity();
  std::vector<ElementHandle> data;  // the MATRIX statements
  // Where arguments stand that are looked at when the modes are known, and the expression of CRATIO, whose frequencies
  // are known when the units are.
  Span matrices_at, displacements_at, rates_at, held_displacements_at, held_rates_at, damping_at, invariants_at,
      ratio_at;
  bool adds_generalized_damping = false, is_rigid = false;
  std::shared_ptr<ModalBody> flexible;

  static constexpr std::array<Argument<FlexBody>, 29> arguments = {{
      {.name = "MNF_FILE",
       .slot = &FlexBody::file,
       .help = "modal body file: text of nodes, shapes, generalized mass and stiffness",
       .ends = "MATRICES"},
      {.name = "MATRICES",
       .slot = &FlexBody::matrices,
       .help = "MATRIX statements that hold the body, each by its NAME",
       .ends = "MNF_FILE",
       .ids_of = MatrixClass::statement},
      {.name = "DB_FILE", .slot = &FlexBody::database, .help = "database of bodies: not available"},
      {.name = "INDEX_IN_DB", .slot = &FlexBody::index_in_database, .help = "which of DB_FILE: not available"},
      {.name = "BDF_FILE", .slot = &FlexBody::deck, .help = "nonlinear body: not available"},
      {.name = "QG",
       .slot = &FlexBody::origin,
       .unit = unit::length,
       .help = "origin of the BCS",
       .start = StatedStart::place},
      {.name = "REULER",
       .slot = &FlexBody::angles,
       .unit = unit::angle,
       .help = "3-1-3 angles of the BCS",
       .ends = "ZG XG",
       .start = StatedStart::place,
       .unstated = 0},
      {.name = "ZG",
       .slot = &FlexBody::z_point,
       .unit = unit::length,
       .help = "global point on +z of the BCS",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "XG",
       .slot = &FlexBody::x_point,
       .unit = unit::length,
       .help = "global point in the x-z plane",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "VX",
       .slot = &FlexBody::vx,
       .unit = unit::velocity,
       .help = "initial velocity of the BCS",
       .start = StatedStart::velocity},
      {.name = "VY",
       .slot = &FlexBody::vy,
       .unit = unit::velocity,
       .help = "the same along y",
       .start = StatedStart::velocity},
      {.name = "VZ",
       .slot = &FlexBody::vz,
       .unit = unit::velocity,
       .help = "the same along z",
       .start = StatedStart::velocity},
      {.name = "WX",
       .slot = &FlexBody::wx,
       .unit = unit::angular_velocity,
       .help = "initial angular velocity",
       .start = StatedStart::velocity},
      {.name = "WY",
       .slot = &FlexBody::wy,
       .unit = unit::angular_velocity,
       .help = "the same about y",
       .start = StatedStart::velocity},
      {.name = "WZ",
       .slot = &FlexBody::wz,
       .unit = unit::angular_velocity,
       .help = "the same about z",
       .start = StatedStart::velocity},
      {.name = "VM",
       .slot = &FlexBody::vm,
       .help = "axes of VX, VY, VZ; global by default",
       .start = StatedStart::velocity_axes},
      {.name = "WM",
       .slot = &FlexBody::wm,
       .help = "axes of WX, WY, WZ; those of the BCS by default",
       .start = StatedStart::angular_axes},
      {.name = "EXACT", .slot = &FlexBody::exact, .help = "coordinates the assembly should keep: X:Y:Z:PSI:THETA:PHI"},
      {.name = "CRATIO",
       .slot = &FlexBody::ratio,
       .help = "damping of each mode in parts of the critical, an expression in FXFREQ (cycles/s) and FXMODE; 0.01 "
               "below 100 cycles/s, 0.1 below 1000 and 1 above by default"},
      {.name = "GENERALIZED_DAMPING",
       .slot = &FlexBody::generalized_damping,
       .help = "FULL or INTERNAL_ONLY adds the damping matrix of the file, OFF (default) does not"},
      {.name = "DMODE",
       .slot = &FlexBody::displacements,
       .help = "modal coordinates at the start; those of the file by default",
       .start = StatedStart::alone},
      {.name = "VMODE",
       .slot = &FlexBody::rates,
       .help = "their rates at the start; those of the file by default",
       .start = StatedStart::alone},
      {.name = "MODAL_EXACT_DISP", .slot = &FlexBody::held_displacements, .help = "modes that keep DMODE"},
      {.name = "MODAL_EXACT_VEL", .slot = &FlexBody::held_rates, .help = "modes that keep VMODE"},
      {.name = "INVARIANTS",
       .slot = &FlexBody::invariants,
       .help = "nine times T or F: which inertia invariants count; all by default"},
      {.name = "DYNAMIC_LIMIT", .slot = &FlexBody::dynamic_limit, .help = "modes without mass: not available"},
      {.name = "STABILITY_FACTOR", .slot = &FlexBody::stability_factor, .help = "their damping: not available"},
      {.name = "CHAR_LEN",
       .slot = &FlexBody::length,
       .unit = unit::length,
       .minimum = 0,
       .help = "length of the body, beside which it is bent little; of its nodes where it is not stated"},
      {.name = "REPRESENTATION",
       .slot = &FlexBody::representation,
       .help = "MODAL (default) or RIGID, the body without its modes"},
  }};
};

}  // namespace dynalin
