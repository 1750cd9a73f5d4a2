// Tests that set the number of threads give it back.
#pragma once

#include "dynalin/threads.h"

namespace dynalin {

class KeepsThreadCount {
 public:
  KeepsThreadCount() = default;
  ~KeepsThreadCount() { set_thread_count(before_); }
  KeepsThreadCount(const KeepsThreadCount&) = delete;
  KeepsThreadCount& operator=(const KeepsThreadCount&) = delete;

 private:
  const std::size_t before_ = thread_count();
};

}  // namespace dynalin
