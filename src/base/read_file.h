// Reads an input file whole, or says why not: a part of a file is never taken for all of it.
#pragma once

#include <string>
#include <tl/expected.hpp>

namespace dynalin {

// The bytes of a regular file. Folders, pipes and devices are refused, which might hang or never end, and so are files
// of more than 4 GiB. The error is a reason to stand behind the name: "it is a directory".
tl::expected<std::string, std::string> read_file(const std::string& path);

}  // namespace dynalin
