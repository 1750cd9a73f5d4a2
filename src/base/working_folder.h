// The folder that names of files are relative to. Compiled routines may change that of the process.
#pragma once

namespace dynalin {

void keep_working_folder();       // as it is now
void return_to_working_folder();  // the one that was kept, if any

}  // namespace dynalin
