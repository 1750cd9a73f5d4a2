// Where tests find files of the source tree. Its source alone is compiled with the place, so that the objects of all
// others are the same wherever the tree stands, and a compiler cache serves every checkout.
#pragma once

#include <filesystem>

namespace dynalin {

std::filesystem::path source_tree();
inline std::filesystem::path examples_folder() { return source_tree() / "examples"; }
inline std::filesystem::path element_pages() { return source_tree() / "docs/elements"; }
inline std::filesystem::path element_sources() { return source_tree() / "src/elements"; }
inline std::filesystem::path nastran_decks() { return source_tree() / "tests/nastran"; }
// Datasets as other programs and people write them, with their command files.
inline std::filesystem::path foreign_datasets() { return source_tree() / "tests/foreign"; }
std::filesystem::path foreign_routines();  // the folder of their compiled routines

}  // namespace dynalin
