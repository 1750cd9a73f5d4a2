// Constraint rows of an OPENBOX, exactly as they are linearized; those that follow from others are left out.
//
// A joint is an RJOINT where its markers coincide and its rows hold components along the axes of J and nothing else,
// which is seen from the rows; else each row is an MPC on the grids. Rows on velocities g q′ + v q = 0 are no relation
// of displacements: a multiplier μ on a scalar point of its own holds each, with −gᵀ μ in the balance of forces.
#pragma once

#include <array>
#include <map>
#include <set>
#include <vector>

#include "nastran/contributions.h"
#include "nastran/open_deck.h"
#include "perturbation/perturbed_point.h"

namespace dynalin::nastran {

class OpenConstraints {
 public:
  // All arguments must outlive this, and what the deck refers to.
  OpenConstraints(const System&, const PerturbedPoint&, const OpenDeck&);

  // Adds joints and relations to the deck; what rows on velocities take comes back.
  std::vector<MatrixEntry> add();

 private:
  using Row = std::map<std::int32_t, double>;  // by unknown
  Row at_centres(std::int32_t row) const;
  bool add_joint(const ElementLabel&, const std::vector<Row>&);
  void add_relation(const ElementLabel&, const Row&);
  void add_velocity_row(std::int32_t row, std::vector<MatrixEntry>&);
  // What a row takes of force and torque on a body at a point, along given axes.
  std::array<double, 6> on_body(const Row&, BodyId, const Vector& at, const Matrix3& axes) const;

  const System& system_;
  const PerturbedPoint& at_;
  const OpenDeck open_;
  std::set<Dof> dependent_;  // of relations
};

}  // namespace dynalin::nastran
