// FE_PART/id, TYPE={3DBEAM | 2DBEAMXY | 2DBEAMYZ | 2DBEAMZX}, MATERIAL=, {[NODE_LABELS=,] COORDINATES= | NODE_LABELS=,
// X= [, Y=, Z=, PSI=, THETA=, PHI=]}, {SECTION= | AREA=, IYY=, IZZ= [, IYZ=, IXX=]} [, ASY=, ASZ=, {CRATIOK= |
// CRATIO=}, QG=, {REULER= | ZG=, XG=}, VX= … WZ=, VM=, WM=]
//
// A beam with mass that may bend, twist, stretch and shear as far as it will: a geometrically exact beam between nodes
// that have positions, axes and slopes of their own (flexible/spatial_beam.h). One of a 2D type stays in a plane
// parallel to two global axes, where it bends and stretches (flexible/plane_beam.h). Nodes are stated in the BCS,
// undeformed, with the x axis along the line of centroids. A list of numbers has one for each node, or one for all;
// COORDINATES and SECTION have a row for each, which begins with its label (fe_part_rows.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "elements/bodies/fe_part.h"
#include "model/schema.h"

namespace dynalin {

struct FePart {
  std::string type;
  std::optional<std::int64_t> material;
  std::vector<std::int64_t> numbers;
  std::vector<double> coordinates, sections;  // rows as written, of which the lists below are made
  std::vector<double> x, y, z, psi, theta, phi;
  std::vector<double> area, torsion, yy, zz, yz, shear_y, shear_z;
  double damping = 0;
  std::optional<double> damping_by_mass;
  Vector origin;
  std::optional<Vector> angles, z_point, x_point;
  std::optional<double> vx, vy, vz, wx, wy, wz;
  MarkerId vm, wm;
  Matrix3 axes = Matrix3::identity();
  ElementHandle made_of;
  Span material_at;
  std::optional<BeamPlane> plane;
  BeamElements elements;
  std::vector<BodyId> nodes;

  static constexpr std::array<Argument<FePart>, 33> arguments = {{
      {.name = "TYPE",
       .slot = &FePart::type,
       .required = true,
       .help = "3DBEAM, 2DBEAMXY, 2DBEAMYZ or 2DBEAMZX",
       .start = StatedStart::place},
      {.name = "MATERIAL",
       .slot = &FePart::material,
       .required = true,
       .help = "the MATERIAL that it is made of",
       .ids_of = "MATERIAL"},
      {.name = "NODE_LABELS",
       .slot = &FePart::numbers,
       .help = "labels of the nodes, from end to end; as in COORDINATES unless stated"},
      {.name = "COORDINATES",
       .slot = &FePart::coordinates,
       .unit = {"length, rad", true},
       .help = "of each node its label, x, y, z in the BCS and the 3-1-3 angles of its axes",
       .ends = "X Y Z PSI THETA PHI",
       .start = StatedStart::place},
      {.name = "X",
       .slot = &FePart::x,
       .unit = unit::length,
       .help = "places of the nodes in the BCS",
       .start = StatedStart::place},
      {.name = "Y",
       .slot = &FePart::y,
       .unit = unit::length,
       .help = "the same along y; 0 unless stated",
       .start = StatedStart::place},
      {.name = "Z",
       .slot = &FePart::z,
       .unit = unit::length,
       .help = "the same along z; 0 unless stated",
       .start = StatedStart::place},
      {.name = "PSI",
       .slot = &FePart::psi,
       .unit = unit::angle,
       .help = "axes of the nodes in the BCS, 3-1-3 angles: about z",
       .start = StatedStart::place},
      {.name = "THETA",
       .slot = &FePart::theta,
       .unit = unit::angle,
       .help = "then about x",
       .start = StatedStart::place},
      {.name = "PHI", .slot = &FePart::phi, .unit = unit::angle, .help = "then about z", .start = StatedStart::place},
      {.name = "SECTION",
       .slot = &FePart::sections,
       .unit = "length², length⁴",
       .help = "of each node its label, AREA, IYY, IZZ, IYZ and IXX",
       .ends = "AREA IXX IYY IZZ IYZ"},
      {.name = "AREA", .slot = &FePart::area, .unit = "length²", .help = "of the section"},
      {.name = "IXX", .slot = &FePart::torsion, .unit = "length⁴", .help = "of torsion; IYY + IZZ unless stated"},
      {.name = "IYY", .slot = &FePart::yy, .unit = "length⁴", .help = "integral of z²"},
      {.name = "IZZ", .slot = &FePart::zz, .unit = "length⁴", .help = "integral of y²"},
      {.name = "IYZ", .slot = &FePart::yz, .unit = "length⁴", .help = "integral of y·z; 0 unless stated"},
      {.name = "ASY", .slot = &FePart::shear_y, .help = "area by that which carries shear along y; 1.2 unless stated"},
      {.name = "ASZ", .slot = &FePart::shear_z, .help = "the same along z"},
      {.name = "CRATIOK",
       .slot = &FePart::damping,
       .unit = "time",
       .minimum = 0,
       .help = "damping by stiffness: stresses of strain rates; 0 unless stated",
       .ends = "CRATIO"},
      {.name = "CRATIO",
       .slot = &FePart::damping,
       .unit = "time",
       .minimum = 0,
       .help = "the same as CRATIOK",
       .ends = "CRATIOK"},
      {.name = "CRATIOM",
       .slot = &FePart::damping_by_mass,
       .minimum = 0,
       .help = "0: damping by mass is not available"},
      {.name = "QG",
       .slot = &FePart::origin,
       .unit = unit::length,
       .help = "origin of the BCS",
       .start = StatedStart::place},
      {.name = "REULER",
       .slot = &FePart::angles,
       .unit = unit::angle,
       .help = "3-1-3 angles of the BCS",
       .ends = "ZG XG",
       .start = StatedStart::place,
       .unstated = 0},
      {.name = "ZG",
       .slot = &FePart::z_point,
       .unit = unit::length,
       .help = "global point on +z of the BCS",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "XG",
       .slot = &FePart::x_point,
       .unit = unit::length,
       .help = "global point in the x-z plane",
       .ends = "REULER",
       .start = StatedStart::place},
      {.name = "VX",
       .slot = &FePart::vx,
       .unit = unit::velocity,
       .help = "initial velocity of the BCS, with which all moves as if rigid",
       .start = StatedStart::velocity},
      {.name = "VY",
       .slot = &FePart::vy,
       .unit = unit::velocity,
       .help = "the same along y",
       .start = StatedStart::velocity},
      {.name = "VZ",
       .slot = &FePart::vz,
       .unit = unit::velocity,
       .help = "the same along z",
       .start = StatedStart::velocity},
      {.name = "WX",
       .slot = &FePart::wx,
       .unit = unit::angular_velocity,
       .help = "initial angular velocity of the whole",
       .start = StatedStart::velocity},
      {.name = "WY",
       .slot = &FePart::wy,
       .unit = unit::angular_velocity,
       .help = "the same about y",
       .start = StatedStart::velocity},
      {.name = "WZ",
       .slot = &FePart::wz,
       .unit = unit::angular_velocity,
       .help = "the same about z",
       .start = StatedStart::velocity},
      {.name = "VM",
       .slot = &FePart::vm,
       .help = "axes of VX, VY, VZ; global by default",
       .start = StatedStart::velocity_axes},
      {.name = "WM",
       .slot = &FePart::wm,
       .help = "axes of WX, WY, WZ; those of the BCS by default",
       .start = StatedStart::angular_axes},
  }};
};

// In the BCS, undeformed.
Vector place_of_node(const FePart&, std::size_t node);
Matrix3 axes_of_node(const FePart&, std::size_t node);
BeamSection section_of(const FePart&, std::size_t node);

// Finds the plane of its type; false after an error where the arguments describe no beam.
bool describes_beam(FePart&, ElementReader&);
// Whether a beam of a plane lies in it, with the axes of the BCS known, and which arguments it does without.
void check_plane(const FePart&, ElementReader&);

}  // namespace dynalin
