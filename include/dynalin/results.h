// The plain values a linear analysis delivers. Frequencies in cycles per unit time, everything else in
// the units of the model; matrices by rows and columns as printed.
#pragma once

#include <complex>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dynalin/element_id.h"
#include "dynalin/matrix.h"
#include "dynalin/mode_selection.h"

namespace dynalin {

// Codes of the STATES matrix (LINEAR command, 5.2.6).
enum class StateType : int {
  part_euler = 1,
  lse = 2,
  tfsiso = 3,
  gse = 4,
  diff = 5,
  ptcv = 6,
  cvcv = 7,
  flex_body_euler = 8,
  point_mass_original = 9,
  pstate = 10,
  pstate_rate = 11,
  part = 21,
  fe_part = 27,
  flex_body = 28,
  point_mass = 29,
  part_relative = 31,
  flex_body_relative = 38,
  point_mass_relative = 39,
  delay = 101,  // ours: of a DELAY read as a Padé approximant
};

// One state of the linear model.
struct StateLabel {
  StateType type = StateType::part;
  std::int64_t element = 0;  // id of the PART, VARIABLE, TFSISO …
  int coordinate = 0;        // 1-based; rates follow after the coordinates of the element (7–12 for a PART)
  std::string text;          // "Global rotation AZ(BCS)"; for a rate the text of its coordinate
  ElementId owner;           // PART/2; nothing where the text names it
  bool is_rate = false;
};

struct ChannelLabel {  // one input or output
  std::int64_t variable = 0;
  std::string text;  // "VARIABLE/10"
};

// Tells results of one linear model from those of another: the same in all of one, and where the equations and names of
// states and channels are the same to the last bit. 0: of none.
using EquationsMark = std::uint64_t;

// s' = A s + B u, y = C s + D u with s = (x1', x1, x2', x2, …, z).
struct StateSpace {
  double time = 0;
  std::vector<StateLabel> states;
  std::size_t kinematic_states = 0;  // displacements and velocities together; differential states follow them
  std::vector<ChannelLabel> inputs, outputs;
  std::int64_t pinput = 0, poutput = 0;  // ids of the statements, 0 if none was asked for
  std::int64_t rm = 0, pstate = 0;       // marker of the RM option and id of the PSTATE, 0 if none
  bool without_damping = false, original = false;
  EquationsMark of_equations = 0;
  DenseMatrix A, B, C, D;
};

// M s″ + B s′ + K s = P u, y = C (s, s′) + D u with s = (x, z).
struct SecondOrder {
  double time = 0;
  std::vector<StateLabel> states;       // of s
  std::size_t differential_states = 0;  // the last of them
  std::vector<ChannelLabel> inputs, outputs;
  std::int64_t pinput = 0, poutput = 0;  // ids as in StateSpace
  std::int64_t rm = 0, pstate = 0;
  bool without_damping = false, original = false;
  EquationsMark of_equations = 0;
  DenseMatrix M, B, K, P, C, D;
};

// Eigenvalues λ/2π in printed order: real ones by ascending modulus, then complex pairs, one entry each with
// positive imaginary part, by ascending imaginary part.
struct EigenMode {
  std::complex<double> eigenvalue_hz;
  bool is_real = false;
  // How far a change of A moves the eigenvalue: |δλ| ≤ condition · ‖δA‖ to first order; infinite for a defective one.
  // 0 if it was not asked for.
  double condition = 0;
  double backward_error = 0;  // ‖A v − λ v‖ / ‖A‖ of the computed pair
  // |computed − exact| for the perturbation equations as assembled, λ/2π like the eigenvalue. 0 for a structural zero.
  double error_bound_hz = 0;
  // The value is the mean of so many eigenvalues within the bound, which the equations do not tell apart.
  std::size_t cluster_size = 1;
  bool structural_zero = false;  // zero because the model is free to move that way, not by computation
  bool refined = false;          // by inverse iteration on the sparse equations
  ElementId mover;         // the part with the largest motion, or the controller where no part moves; empty: not known
  std::string moves_most;  // its name for the reader, "PART/2 (wheel)"
};

// One entry of a mode shape: a coordinate of the model or a differential state.
struct ShapeLabel {
  ElementId element;     // PART/2
  std::string name;      // view name of it, empty if there is none
  std::string quantity;  // X Y Z of the origin of the BCS, RX RY RZ in global axes; "State 1"; a curve parameter
};

struct EigenSolution {
  double time = 0;
  std::int64_t rm = 0;      // marker of the RM option, 0 if none
  std::int64_t pstate = 0;  // 0 if none
  bool without_damping = false;
  bool original = false;             // option ORIGINAL
  std::size_t kinematic_states = 0;  // displacements and velocities together
  std::size_t differential_states = 0;
  EquationsMark of_equations = 0;
  std::vector<StateLabel> states;  // in the order of A
  std::vector<EigenMode> modes;
  std::optional<SelectedModes> selected;  // nothing: these are all modes
  // Eigenvectors of A, one column a mode in the same order, of length 1; empty if they were not asked for.
  ComplexDenseMatrix vectors;
  // The same motions in all coordinates of the model and the differential states, one column a mode; the entry of
  // largest modulus is 1.
  std::vector<ShapeLabel> shape_labels;
  ComplexDenseMatrix shapes;
};

}  // namespace dynalin
