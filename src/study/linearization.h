// The linear model of a point, and what LINEAR takes out of it.
#pragma once

#include "dynalin/linear_request.h"
#include "linear/eigen.h"
#include "study/study_point.h"

namespace dynalin {

// The point of a study is behind it as far as its values go: a static solution may be taken as it was found.
struct Linearization {
  std::shared_ptr<const System> system;
  OperatingPoint point;
  bool at_rest_as_found = false;  // the point is not that of the study
  LinearRequest request;
  LinearSystem linear;  // its state space is labelled by the request

  const Diagnostics& remarks() const { return linear.warnings; }
};

// What comes of a model without states.
enum class Stateless : std::uint8_t { refused, taken };

// Whether the state matrix is formed; without it the linear model is an operator of the size of the model.
enum class Reduction : std::uint8_t { state_matrix, none };

// The point must be consistent (initial_conditions).
StudyResult<Linearization> linearized(const StudyPoint&, const LinearRequest&, Stateless = Stateless::refused,
                                      Reduction = Reduction::state_matrix);

struct ModesFound {
  EigenSolution solution;
  Diagnostics remarks;
};
StudyResult<ModesFound> modes_of(const Linearization&, Vectors);
StudyResult<SecondOrder> second_order_form(const Linearization&);

}  // namespace dynalin
