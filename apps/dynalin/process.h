// The process that the program is: its standard streams, the processor it runs on and the memory it may have.
#pragma once

#include <string>
#include <tl/expected.hpp>

// A standard stream that is closed would give its number to the next file that is opened, and what is meant for the
// terminal would end up there. It is opened the wrong way round, so that using it fails.
void open_standard_streams();

// Commands that another program or a file gives; nobody waits for a device.
bool has_piped_input();
// All of standard input; the error is a reason.
tl::expected<std::string, std::string> read_commands();

// OpenBLAS takes its kernels for the oldest processors where it does not know the one it finds, as those that are newer
// than itself: eigenvalues then take twice the time. It chooses before the program begins, which begins anew with those
// for what the processor has. OPENBLAS_CORETYPE in the environment is left alone.
void use_kernels_of_processor(char** arguments);

// Where a limit on memory has no room for the threads of the linear algebra they would wait for theirs for ever, and
// the program with them when it ends. They are there before it begins: it begins anew without them. Under any limit it
// takes now what it needs itself; false if that is too much already.
bool prepare_for_limited_memory(char** arguments);
// Whether more threads than one may work under the limit.
bool has_memory_for_threads();
