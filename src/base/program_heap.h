// The heap of a program: how it grows, and what it keeps of what was freed. For the main function of programs: it holds
// for the whole process.
#pragma once

namespace dynalin {

// As large models want it; nothing where the C library is not glibc.
//
// Columns of all unknowns come and go: given back to the system each time, they would have to be cleared, page by page,
// a third of a run for selected modes of very large models. What one thread frees another takes: all have one arena, as
// nothing that they share allocates much.
//
// A quarter of the machine's memory, which costs nothing before it is written to, is asked for in large pages: with
// small ones a model of 20 000 bodies takes 200 000 faults, and a quarter of the time goes to finding pages. Where the
// process is limited in its addresses all pages are small.
//
// The system clears pages as they are first written to, which of some gigabytes takes seconds. Where threads share the
// work (set_thread_count comes before), another one goes ahead by up to 96 MB in heaps of more than half a gigabyte.
void prepare_heap();

}  // namespace dynalin
