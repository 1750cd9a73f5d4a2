// A flexible body as the model has it: nodes with their shapes, inertia, stiffness and damping by modal coordinates.
// Everything in units of the model, masses not divided by its factor of consistency.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "flexible/modal_inertia.h"
#include "flexible/modal_text.h"

namespace dynalin {

struct ModalBody {
  std::vector<std::string> labels;        // of the nodes
  std::vector<Vector> position;           // of the nodes in the BCS
  Eigen::MatrixXd translation, rotation;  // x, y, z of each node in turn, a column for each mode
  std::vector<std::int64_t> number;       // of each mode in its file
  ModalInertia inertia;
  Eigen::MatrixXd stiffness;                         // [force/length] where modal coordinates are lengths
  Eigen::MatrixXd generalized_damping;               // as the file has it, empty if it has none
  Eigen::MatrixXd damping;                           // what acts [force·time/length]
  Eigen::VectorXd displacement, rate;                // at the start
  std::vector<bool> holds_displacement, holds_rate;  // in the assembly
  bool lacks_inertia = false;  // a motion of it has none: a line of points does not resist its own turn
  double length = 0;           // CHAR_LEN, or how far apart its nodes are [length]
  Eigen::MatrixXd loads;       // a column for each case: force, torque about the BCS, then of the modes

  Eigen::Index modes() const { return displacement.size(); }
  std::optional<std::size_t> node(std::int64_t label) const;
  // "11, 12 and 21": the nodes whose labels are nearest.
  std::string near_nodes(std::int64_t label) const;
  // The modes that the damping which acts feeds with energy beyond rounding of what is written, "mode 3" or "modes
  // 2-4": its symmetric part is negative for motions of them. Empty if it takes energy from every motion or none.
  std::string fed_modes() const;
  // How far a unit of a coordinate moves the body: its mass in the mean, or the node that goes farthest [length].
  double reach(Eigen::Index mode) const;
  // The rigid body that is left without modes.
  void make_rigid();
};

// The body of a file; nothing after an error.
std::optional<ModalBody> modal_body_of(ModalText, const SourceText&, Diagnostics&);

// Looks at what a body is made of: masses and stiffness that are positive, modes that are none of the rigid body.
// False after an error; `at` says where each of them stands.
struct ModalPlaces {
  Span whole, mass, stiffness, shapes;  // of the whole body, and generalized
  std::string file;
  std::function<Span(Eigen::Index mode)> mass_of_mode;  // where that can be said
};
bool check_modal_body(const ModalBody&, const ModalPlaces&, Diagnostics&);

// Whether the mass matrix of the undeformed body is singular.
bool lacks_inertia(const ModalInertia&);

// Modes of the body held in no way but for its BCS, K V = M V Ω², Vᵀ M V = 1 with M/ucf: by ascending frequency.
struct OwnModes {
  // Of each its coordinate, where they are the modes of the file but for rounding; empty where M or K couple these.
  std::vector<Eigen::Index> coordinate;
  Eigen::VectorXd frequency;  // [rad/time]
  Eigen::MatrixXd shapes;
  Eigen::MatrixXd mass;  // M/ucf
};
OwnModes own_modes(const ModalBody&, double ucf);
// M V diag(2 ζ ω) Vᵀ M with the part ζ of critical damping of each mode.
Eigen::MatrixXd modal_damping(const OwnModes&, const std::function<double(Eigen::Index)>& ratio);

}  // namespace dynalin
