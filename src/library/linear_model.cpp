#include <utility>

#include "library/inside.h"
#include "linear/descriptor_form.h"

namespace dynalin::library {

LinearModel::Inside::Inside(Linearization of, OperatingPoint point, std::vector<Remark> said)
    : linear(std::move(of)), about(std::move(point)), remarks(std::move(said)) {}

const Linearization& LinearModel::Inside::whole() const {
  if (linear.has_state_matrix()) return linear;
  std::call_once(formed_, [&] {
    whole_ = value_or_throw(with_state_matrix(linear));
    has_whole_ = true;
  });
  return *whole_;
}

const Linearization& LinearModel::Inside::whole_of_matrices() const {
  if (auto fits = check_size_of_matrices(linear.states(), linear.request); !fits) fail(fits.error());
  return whole();
}

std::vector<Remark> LinearModel::Inside::remarks_of_whole() const {
  return has_whole_ ? remarks_of(new_remarks(whole_->remarks(), linear.remarks())) : std::vector<Remark>{};
}

std::vector<Remark> LinearModel::remarks_of_matrices() const {
  return remarks_of(dynalin::remarks_of_matrices(inside_->linear));
}

DescriptorForm LinearModel::descriptor_form() const { return dynalin::descriptor_form(inside_->linear.linear); }

}  // namespace dynalin::library
