// The linear model of a point, and what LINEAR takes out of it.
#pragma once

#include <limits>

#include "dynalin/linear_request.h"
#include "eigenvalues/eigen.h"
#include "study/study_point.h"

namespace dynalin {

// The point of a study is behind it as far as its values go: a static solution may be taken as it was found.
struct Linearization {
  std::shared_ptr<const System> system;
  OperatingPoint point;
  bool at_rest_as_found = false;  // the point is not that of the study
  LinearRequest request;
  LinearSystem linear;       // its state space is labelled by the request
  bool differenced = false;  // slopes in it are differences of compiled routines

  const Diagnostics& remarks() const { return linear.warnings; }
  std::size_t states() const { return linear.model.states.size(); }
  bool has_state_matrix() const { return static_cast<std::size_t>(linear.A.rows()) == states(); }
};

// What comes of a model without states.
enum class Stateless : std::uint8_t { refused, taken };
// Of matrices: D is left where both of its sides are asked for, of a mechanism that only passes loads on.
inline Stateless stateless_matrices(const LinearRequest& request) {
  return request.pinput && request.poutput ? Stateless::taken : Stateless::refused;
}
Failure no_states(const System&);

// Up to how many states the state matrix is formed; without it the linear model is an operator of the size of the
// model.
struct Reduction {
  std::size_t up_to = std::numeric_limits<std::size_t>::max();
  bool has_linear_model = true;  // or else nothing is asked but what elements contribute
  static const Reduction state_matrix, none;
};
inline constexpr Reduction Reduction::state_matrix{};
inline constexpr Reduction Reduction::none{0, false};

// Sizes by measured cost (docs/performance.md): from here on selected modes are cheaper without the state matrix, all
// modes are worth a word before they are computed, and matrices of gigabytes are not what anybody meant.
inline constexpr std::size_t selected_from_all_up_to = 400, all_modes_unannounced_up_to = 3000,
                             state_matrices_up_to = 5000;

// The point must be consistent (initial_conditions).
StudyResult<Linearization> linearized(const StudyPoint&, const LinearRequest&, Stateless = Stateless::refused,
                                      Reduction = Reduction::state_matrix);

struct ModesFound {
  EigenSolution solution;
  Diagnostics remarks;
};
// Of a model with its state matrix.
StudyResult<ModesFound> modes_of(const Linearization&, Vectors, const Progress& = {});
// What a reader of the matrices has to know, as modes_of() says it beside modes.
Diagnostics remarks_of_matrices(const Linearization&);
// The selected ones of any.
StudyResult<ModesFound> modes_of(const Linearization&, Vectors, const ModeSelection&, const Progress& = {});
StudyResult<SecondOrder> second_order_form(const Linearization&);

// The same with its state matrix, and what forming that has to say besides (new_remarks).
StudyResult<Linearization> with_state_matrix(Linearization);

// What all modes of so many states cost, where that is worth a word.
Diagnostics cost_of_all_modes(std::size_t states);
// Refuses state matrices above the size that the request states, or else the one above.
StudyResult<void> check_size_of_matrices(std::size_t states, const LinearRequest&);

}  // namespace dynalin
