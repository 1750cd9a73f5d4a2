// Meshes out of files that hold facets: STL, as text and binary, Wavefront OBJ and shell files (.shl). Files of CAD
// kernels (Parasolid, STEP, IGES …) hold curved surfaces and are not read.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "geometry/mesh.h"

namespace dynalin {

struct Facets {
  Mesh mesh;              // points that are equal digit by digit are one vertex; only those that something uses
  std::size_t flat = 0;   // polygons left out, which have no area or cross themselves
  bool named_all = true;  // false: `element` named a part of the file, and the mesh is that part
  std::vector<std::string> parts;  // names that the file gives to its solids, objects and groups, in alphabetical order
};

// Whether files with such an ending are read: "link.stl".
bool is_facet_file(std::string_view name);
// The endings of files that are read, with a point before them.
std::span<const std::string_view> facet_file_endings();

// The mesh of a file with the contents `bytes`; its name says the format. Where a solid, object or group of the file
// has the name `element`, it alone. The error is a reason, with the line in texts: "line 3: a number is missing".
tl::expected<Facets, std::string> read_facets(std::string_view name, std::string_view bytes,
                                              std::string_view element = {});

}  // namespace dynalin
