// The examples that can be run as they are: not those whose folders have a `prepare` to be run first, which have tests
// of their own (tests/scripts).
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "places/source_tree.h"

namespace dynalin {

// Files below a folder with examples, by their extension (".acf").
inline std::vector<std::filesystem::path> files_of_examples(const std::filesystem::path& folder,
                                                            std::string_view extension) {
  std::vector<std::filesystem::path> list;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto& file = entry.path();
    if (file.extension() == extension && !std::filesystem::exists(file.parent_path() / "prepare")) list.push_back(file);
  }
  std::sort(list.begin(), list.end());
  return list;
}

}  // namespace dynalin
