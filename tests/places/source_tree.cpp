#include "places/source_tree.h"

std::filesystem::path dynalin::source_tree() { return SOURCE_TREE; }
