#include "base/product_kernels.h"

namespace Eigen::internal {

DYNALIN_REAL_KERNELS()

}  // namespace Eigen::internal
