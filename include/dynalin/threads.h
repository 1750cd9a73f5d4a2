// How many threads work on one model. Results do not depend on it: what is added up is added in the same order.
#pragma once

#include <cstddef>

namespace dynalin {

// As many as the machine has cores until it is set, that of the caller among them. For the whole process; a model that
// calls compiled routines is evaluated by one. Those who work on several models at once do best with one for each.
std::size_t thread_count();
void set_thread_count(std::size_t);  // at least 1; waits for what is at work

}  // namespace dynalin
