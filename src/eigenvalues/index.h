// Eigen counts with signs, the standard library without.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace dynalin {

inline std::size_t at(Eigen::Index k) { return static_cast<std::size_t>(k); }

}  // namespace dynalin
