#include "base/working_folder.h"

#include <fcntl.h>
#include <unistd.h>

namespace dynalin {

namespace {

int kept = -1;  // a descriptor, so that a folder that is moved is found again

}  // namespace

void keep_working_folder() { kept = ::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC); }

void return_to_working_folder() {
  if (kept >= 0 && ::fchdir(kept) != 0) kept = -1;  // it is gone: names mean what they may
}

}  // namespace dynalin
