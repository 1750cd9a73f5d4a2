// What single elements contribute to stiffness, damping and mass of an OPENBOX, at the mass centres.
//
// An element's partials stand in coordinates of the BCS, with moments about its origin. About the mass centre, c from
// the BCS, the moment is M_C = M_B − c × F, whose variation has the force itself,
//
//     δM_C = δM_B − c × δF − (δθ × c) × F.
//
// In the sum over all elements of a body at rest F is nothing; of one element alone the term decides.
#pragma once

#include <vector>

#include "nastran/algebraic_forms.h"
#include "nastran/open_points.h"

namespace dynalin::nastran {

struct MatrixEntry {
  MatrixKind kind;
  std::int32_t row, column;  // unknowns (open_points.h)
  double value;
};
// Adds up entries of one place; sums that are nothing beside `rounding` of the sizes of their parts vanish.
void add_up(std::vector<MatrixEntry>&, double rounding = 2e-15);

struct Contribution {
  enum class Of : std::uint8_t { rigid_body, changing_body, constraint, force };
  const ElementLabel* element;
  Of of;
  std::vector<MatrixEntry> entries;  // added up
};

class Contributions {
 public:
  Contributions(const System&, const Perturbation&, const AlgebraicForms&, const OpenPoints&);

  // All that are not nothing, in the order of the model.
  std::vector<Contribution> of_elements() const;
  // Rows of the differential equations.
  std::vector<MatrixEntry> of_states() const;

 private:
  void take(const std::vector<std::size_t>& pieces, std::vector<MatrixEntry>&) const;
  // A form in a row that is given already.
  void add(const MotionForm&, std::int32_t row, double factor, std::vector<MatrixEntry>&) const;

  const System& system_;
  const PerturbedPoint& at_;
  const AlgebraicForms& forms_;
  const OpenPoints& points_;
};

}  // namespace dynalin::nastran
