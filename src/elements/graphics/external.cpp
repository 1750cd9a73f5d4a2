// Shapes out of files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/read_file.h"
#include "elements/graphics/types.h"
#include "geometry/facet_file.h"

namespace dynalin::drawing {

void External::complete(ElementReader& reader) {
  folder = reader.folder();
  at = reader.at("FILE");
  reader.reads((std::filesystem::path(folder) / file).string());
}

void External::draw(Canvas& canvas) const {
  const std::string path = (std::filesystem::path(folder) / file).string();
  const std::string name = canvas.label().full_text();
  if (!is_facet_file(file)) {
    canvas.remark(
        "geometry-format", at, fmt::format("{} is not drawn: {} has a format that is not read", name, file),
        fmt::format("files of facets are: {}; a CAD program can write them", fmt::join(facet_file_endings(), ", ")));
    return;
  }
  const auto bytes = read_file(path);
  if (!bytes) {
    canvas.remark("geometry-file", at,
                  fmt::format("{} is not drawn: {} cannot be read: {}", name, path, bytes.error()));
    return;
  }
  auto facets = read_facets(file, *bytes, element);
  if (!facets) {
    canvas.remark("geometry-file", at, fmt::format("{} is not drawn: {}: {}", name, path, facets.error()));
    return;
  }
  // The name of the only part is often that of the program that wrote it.
  if (!element.empty() && facets->named_all && facets->parts.size() > 1) {
    const std::size_t shown = std::min<std::size_t>(facets->parts.size(), 10);
    canvas.remark(
        "geometry-part", at, fmt::format("{} shows all of {}, which has no part {}", name, path, element),
        fmt::format("its parts are: {}{}",
                    fmt::join(facets->parts.begin(), facets->parts.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                    facets->parts.size() > shown ? " …" : ""));
  }
  if (facets->flat > 0) {
    canvas.remark("undrawn-shape", at,
                  fmt::format("{} polygons of {}, which {} shows, have no area or cross themselves "
                              "and are left out",
                              facets->flat, path, name));
  }
  canvas.add(rm, std::move(facets->mesh));
}

}  // namespace dynalin::drawing
