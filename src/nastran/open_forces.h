// Applied forces of an OPENBOX: those that are singled out, each as CBUSH with what is left of its exact matrices or as
// these alone, all others in common matrices with the geometric stiffness of reactions. Bodies that change their shape
// are among them, each singled out with its mass, damping and stiffness or in the common matrices.
//
// A CBUSH stands between grids at the markers, along the axes that the force has its components in or, for a force
// along the line between the markers, along that line alone. It has the diagonal of the stiffness and damping that the
// exact matrices have for motions of I, where that is positive and more than rounding. As Nastran assembles it, with
// its spring at I,
//
//     K = Dᵀ diag(k) D,    D u = Rᵀ (δp_I − δp_J − δθ_J × (I − J),  δθ_I − δθ_J),
//
// and what the exact matrices have beside is the residual.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "nastran/contributions.h"
#include "nastran/open_deck.h"

namespace dynalin::nastran {

class OpenForces {
 public:
  // All arguments must outlive this, and what the deck refers to.
  OpenForces(const System&, const Motion&, const OpenDeck&);

  // Adds bushes and matrices to the deck; `of_states` and what forces take of differential states go into matrices of
  // their own.
  StudyResult<void> add(std::vector<Contribution>, std::vector<MatrixEntry> of_states, Diagnostics& remarks);

 private:
  struct Place {  // of a bush
    BodyId body_I, body_J;
    Vector I, J;
    Matrix3 axes;
    bool along_line = false;
    std::int64_t grid_I = 0, grid_J = 0, system = 0;
  };

  StudyResult<void> choose_suffixes(const std::vector<Contribution>&, Diagnostics& remarks);
  StudyResult<void> take_suffix(const Editable&, std::string_view statement, Diagnostics& remarks);
  StudyResult<void> refuse(std::string message, Diagnostics& remarks) const;
  std::string automatic_suffix(const ElementLabel&);
  std::size_t longest_suffix() const;

  void add_bush(const ElementLabel&, std::vector<MatrixEntry>&, Diagnostics& remarks);
  bool find_place(const ElementLabel&, Place&);
  // Stiffness or damping of displacements of a point on a body in the force there, and of turns in the moment, along
  // axes; the largest of what each is a sum of.
  struct AtPoint {
    Matrix3 translation, rotation;
    double size_of_translation = 0, size_of_rotation = 0;
  };
  AtPoint at_point(const std::vector<MatrixEntry>&, MatrixKind, BodyId, const Vector& at, const Matrix3& axes) const;
  void subtract(const Place&, MatrixKind, const std::array<double, 6>&, std::vector<MatrixEntry>&) const;
  void add_matrices(const std::string& name, const std::string& suffix, std::vector<MatrixEntry>);

  const System& system_;
  const Motion& motion_;
  const OpenDeck open_;
  std::map<const ElementLabel*, std::string> suffix_;  // of what is singled out
  std::set<std::string> taken_;
};

}  // namespace dynalin::nastran
