#include "base/product_kernels.h"

namespace Eigen::internal {

DYNALIN_COMPLEX_KERNELS()

}  // namespace Eigen::internal
