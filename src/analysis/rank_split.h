// Rank and null vectors of a small square matrix whose entries carry roundings of known sizes.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dynalin {

// Sums that cancel to less than this many roundings of their terms are zero.
inline constexpr double cancelled_units = 64;

struct RankSplit {
  std::vector<Eigen::Index> pivot_row, pivot_column, other_row, other_column;
  Eigen::MatrixXd right_null, left_null;  // columns, the identity in the other columns (rows)
};
RankSplit rank_split(const Eigen::MatrixXd& values, const Eigen::MatrixXd& sizes);

}  // namespace dynalin
