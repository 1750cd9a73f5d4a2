// A deck as typed cards. References are the numbers as written; nothing here knows what they lead to.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "nastran_reader/case_control.h"
#include "nastran_reader/deck_lines.h"

namespace dynalin::nastran_reader {

using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// The number of another card, and where it is written. 0 where the field is blank.
struct Reference {
  int id = 0;
  Span at;
};

// A set of components of a grid as bits: component c (1 to 6) is bit c - 1. Of a scalar point the set is 1.
using Components = unsigned;

// One component of one point; component 0 is that of a scalar point.
struct Freedom {
  Reference point;
  int component = 0;
  Span component_at;
};

struct Grid {
  Reference id;
  Reference position_system, system;  // CP, CD
  Vector3d x = Vector3d::Zero();      // in CP
  Components fixed = 0;               // PS
};

struct ScalarPoint {
  Reference id;
};

struct System {
  enum class Kind { rectangular, cylindrical, spherical };
  Reference id;
  Kind kind = Kind::rectangular;
  Reference reference;               // RID
  Vector3d a, b, c;                  // in it
  std::vector<Reference> by_points;  // of CORD1x: three grids in place of a, b, c
};

struct Mass {
  Reference id;
  Reference grid, system;  // the number -1: the offset is a point of the basic system
  double mass = 0;
  Vector3d offset = Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the mass centre, physical signs
  std::optional<Matrix6> matrix;                      // of CONM1, in place of all that
};

// CELASi, CDAMPi, CMASSi.
struct ScalarElement {
  enum class Kind { stiffness, damping, mass };
  std::string card;
  Reference id;
  Kind kind = Kind::stiffness;
  Reference property;  // where the value is not on the card itself
  double value = 0;
  std::vector<Freedom> ends;  // one or two; an end without a point is ground
};

struct Bush {
  Reference id, property, a, b;  // b of number 0: ground
  std::optional<Reference> direction_grid;
  std::optional<Vector3d> direction;  // X1..X3 in CD of a
  std::optional<Reference> system;    // CID
  double along = 0.5;                 // S
  std::optional<Reference> offset_system;
  Vector3d offset = Vector3d::Zero();
};

struct BushProperty {
  Reference id;
  Eigen::Matrix<double, 6, 1> stiffness = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 1> damping = Eigen::Matrix<double, 6, 1>::Zero();
};

struct Mpc {
  Reference set;
  Span at;
  struct Term {
    Freedom freedom;
    double coefficient = 0;
    Span at;
  };
  std::vector<Term> terms;
};

// RBE2, RJOINT, RBAR: what they share is that some components depend on others rigidly.
struct RigidElement {
  enum class Kind { spider, joint, bar };
  Kind kind = Kind::spider;
  Reference id;
  Reference a;                       // GN, GA
  std::vector<Reference> dependent;  // GMi, GB
  Components components = 0;         // CM, CB
  Span components_at;
  // Of RBAR: independent at A and B, dependent at A and B.
  Components free_a = 0, free_b = 0, tied_a = 0, tied_b = 0;
};

struct Spc {
  Reference set;
  Reference point;
  Components components = 0;  // 0: of a scalar point
  Span components_at;
  double value = 0;
  Span at;
  int last = 0;  // of ID1 THRU ID2, which takes the points that are there; 0 for one point
};

struct SetSum {
  Reference set;
  std::vector<Reference> of;
};

struct DirectMatrix {
  std::string name;
  Span at;
  bool has_header = false;
  int form = 0;  // IFO
  int type = 0;  // TIN
  struct Term {
    Freedom row, column;
    double value = 0;
    Span at;
  };
  std::vector<Term> terms;
  std::optional<Span> without_d;  // of the first term that is not written in double precision
};

struct ComplexMethod {
  Reference id;
  std::string method;
  std::optional<int> wanted;
};

struct Frequencies {
  Reference set;
  std::vector<double> values;  // cycles per unit of time
};

// A number, or the number of a card that has it.
struct NumberOrCard {
  double value = 0;
  Reference card;
};

struct DynamicLoad {  // RLOAD1
  Reference id, excitation;
  NumberOrCard delay, phase, real_part, imaginary_part;
  Span at;
};

struct LoadSum {  // DLOAD
  Reference id;
  double factor = 1;
  std::vector<std::pair<double, Reference>> parts;
};

struct PointLoad {  // FORCE, MOMENT
  Reference set, grid, system;
  Vector3d vector = Vector3d::Zero();
  bool moment = false;
};

struct FreedomValue {  // DAREA, DPHASE, DELAY, TIC
  Reference set;
  Freedom freedom;
  double value = 0;
};

struct Table {
  Reference id;
  bool x_log = false, y_log = false;
  std::vector<std::pair<double, double>> points;
  double at(double x) const;
};

// Elements whose stiffness nobody assembles here: right only where they cannot deform.
struct UndeformedElement {
  std::string card;
  Reference id, property;
  std::vector<Reference> grids;
};

struct PlainProperty {  // PROD, PSHELL
  std::string card;
  Reference id;
  std::vector<Reference> materials;
  double thickness = 0, added_mass = 0;
};

struct Material {
  Reference id;
  double density = 0;
};

struct Kept {
  std::size_t count = 0;
  Span first;
};

struct Deck {
  DeckLines text;
  CaseControl control;
  std::map<std::string, std::pair<std::string, Span>> parameters;
  std::vector<Grid> grids;
  std::vector<ScalarPoint> scalars;
  std::vector<System> systems;
  std::vector<Mass> masses;
  std::vector<ScalarElement> scalar_elements;
  std::map<std::string, std::map<int, double>> scalar_properties;  // PELAS, PDAMP, PMASS
  std::vector<Bush> bushes;
  std::vector<BushProperty> bush_properties;
  std::vector<Mpc> mpcs;
  std::vector<SetSum> mpc_sums, spc_sums;
  std::vector<RigidElement> rigid;
  std::vector<Spc> spcs;
  std::vector<DirectMatrix> matrices;  // a name once
  std::vector<ComplexMethod> methods;
  std::vector<Frequencies> frequencies;
  std::vector<DynamicLoad> dynamic_loads;
  std::vector<LoadSum> load_sums;
  std::vector<PointLoad> point_loads;
  std::vector<FreedomValue> areas, phases, delays, initial;
  std::vector<Table> tables;
  std::vector<UndeformedElement> undeformed;
  std::vector<PlainProperty> plain_properties;
  std::vector<Material> materials;
  std::map<std::string, Kept> unknown;  // cards of which nothing is known
  std::map<std::string, Kept> idle;     // cards that change no result here

  double parameter(const std::string& name, double otherwise) const;
  bool automatic_dependents() const;  // PARAM,AUTOMSET
  bool automatic_spc() const;         // AUTOSPC, on unless it is switched off
};

// Reads and types every card; references are not followed.
Deck read_deck(const std::string& path, Diagnostics&);
Deck deck_of_text(std::string name, std::string text, Diagnostics&);

}  // namespace dynalin::nastran_reader
