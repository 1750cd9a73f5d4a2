#include "distributed/krylov_progress.h"

#include <algorithm>
#include <limits>

namespace dynalin {

bool KrylovProgress::is_found(const Value& value, double largest) {
  constexpr double rounding_of_largest = 4 * std::numeric_limits<double>::epsilon();
  return value.rest <= std::max(tolerance * value.size, rounding_of_largest * largest);
}

void KrylovProgress::look(Eigen::Index found, Eigen::Index all, double last, const std::optional<Value>& next) {
  constexpr double no_progress = 0.9, settled = 1e-6;
  // Of operators that are not symmetric `rest` does not bound how far off the value is: it is asked for with a margin.
  constexpr double nearly = 0.1, surely = 0.9;
  const bool below = found > 0 && last < least_;
  const bool ended = next && next->rest < nearly * next->size && next->size + next->rest < surely * least_;
  reached_ = found >= wanted_ || below || ended || found >= all;
  const double share = next ? next->rest / next->size : 0;
  idle_ = share_before_ && share > no_progress * *share_before_ && share < settled ? idle_ + 1 : 0;
  share_before_ = share;
}

}  // namespace dynalin
