#include "nastran/export_point.h"

namespace dynalin::nastran {

StudyResult<Perturbation> perturbation_for(const Linearization& of, const ExportOptions& options) {
  if (of.request.without_damping == !options.use_damping) return static_cast<const Perturbation&>(of.linear);
  LinearOptions otherwise;
  otherwise.without_damping = !options.use_damping;
  auto again = perturb(*of.system, of.point, otherwise);
  if (!again) return tl::unexpected(StudyFailure(again.error()));
  return std::move(*again);
}

}  // namespace dynalin::nastran
