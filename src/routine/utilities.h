// What compiled routines call is not called by anything else: whoever loads them asks for it to be linked.
#pragma once

namespace dynalin {

void keep_utilities();
void keep_function_utilities();
void keep_data_utilities();

}  // namespace dynalin
