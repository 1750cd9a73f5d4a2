#include "places/source_tree.h"

std::filesystem::path dynalin::source_tree() { return SOURCE_TREE; }
std::filesystem::path dynalin::foreign_routines() { return FOREIGN_ROUTINES; }
