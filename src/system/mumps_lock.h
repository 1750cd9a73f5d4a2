// The Fortran core of MUMPS keeps state of its own, for all kinds of numbers: one call at a time.
#pragma once

#include <mutex>

namespace dynalin {

inline std::mutex& mumps_lock() {
  static std::mutex one_at_a_time;
  return one_at_a_time;
}

}  // namespace dynalin
