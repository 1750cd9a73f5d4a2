// The linear model of a mechanism at an operating point.
#pragma once

#include <memory>
#include <vector>

#include "dynalin/descriptor_form.h"
#include "dynalin/linear_request.h"
#include "dynalin/modal_table.h"
#include "dynalin/operating_point.h"
#include "dynalin/physical_matrices.h"
#include "dynalin/results.h"

namespace dynalin::library {

struct Modes : EigenSolution {
  std::vector<Remark> remarks;  // what makes them other than they look
};

// Eigenvalues alone take a fraction of the time.
enum class ModeShapes : bool { left_out, wanted };

// Constant. Results are computed when they are asked for; whatever needs the state matrix forms it, once.
class LinearModel {
 public:
  // s' = A s + B u, y = C s + D u. These and the next throw above LinearRequest::dense_up_to states.
  StateSpace state_space() const;
  // M s″ + B s′ + K s = P u.
  SecondOrder second_order() const;
  // The same with all equations kept, sparse, whatever the size of the model.
  DescriptorForm descriptor_form() const;
  // The same as forces: M, C and K of the mechanism along the chosen coordinates, and what each element contributes to
  // them, in the order of the dataset.
  PhysicalMatrices physical_matrices() const;
  std::vector<ElementMatrices> element_matrices() const;
  // All of them. A model without states has none, and throws.
  Modes modes(ModeShapes = ModeShapes::wanted) const;
  // Some of them, with the same values and vectors; where the model is large bounds are those of the sparse equations,
  // which may be wider. `selected` says whether they are all that was asked for. Large models are solved for these
  // alone: time and memory grow with the model, not with the cube and square of it.
  Modes modes(const ModeSelection&, ModeShapes = ModeShapes::wanted) const;
  // What moves in them, and where the energy is; `modes` are those of this model. ENERGY_PER_MODE needs all of them.
  // Throws if they are not, or have no shapes, and where the request names a table or a marker that does not exist.
  ModalTables tables(const EigenSolution& modes, const ModalTableRequest&) const;

  const LinearRequest& request() const;
  // What the model is linear about.
  const OperatingPoint& operating_point() const;
  // Of finding the point, if it was not consistent before, and of linearizing.
  const std::vector<Remark>& remarks() const;
  // What makes matrices other than they look, as that the point accelerates; modes() says it of modes. Computed anew
  // at each call.
  std::vector<Remark> remarks_of_matrices() const;

  struct Inside;
  explicit LinearModel(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}
  const Inside& inside() const { return *inside_; }

 private:
  std::shared_ptr<const Inside> inside_;
};

}  // namespace dynalin::library
