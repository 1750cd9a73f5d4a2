// Work that all cores share. Results do not depend on how many there are: each task writes what is its own, and who
// adds up does it in the order of the tasks.
#pragma once

#include <cstddef>
#include <functional>

#include "dynalin/threads.h"

namespace dynalin {

// Calls task(0) … task(count − 1) once each, task(0) in the thread of the caller, and returns when all are done. Of
// what tasks throw the first by number is thrown on. Where the threads are at work already, in a task or for another
// caller, the caller does everything.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& task);

}  // namespace dynalin
