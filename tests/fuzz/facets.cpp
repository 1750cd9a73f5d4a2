// Any bytes as a file of facets of each format; a mesh that is read refers to nothing but its own vertices, all of
// which it uses.
#include <cmath>
#include <string>
#include <vector>

#include "geometry/facet_file.h"
#include "target.h"

namespace dynalin::fuzz {
namespace {

void demand_sound_mesh(const Mesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  const auto use = [&](const auto& corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      demand(corners[k] < used.size(), "a vertex that does not exist");
      demand(corners[k] != corners[(k + 1) % corners.size()], "a side without length");
      used[corners[k]] = true;
    }
  };
  for (const auto& q : mesh.quads) use(q);
  for (const auto& t : mesh.triangles) use(t);
  for (const auto& s : mesh.segments) use(s);
  for (const bool one : used) demand(one, "a vertex that nothing uses");
  for (const Vector& p : mesh.vertices)
    demand(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "a coordinate that is not finite");
  demand(!mesh.closed || is_watertight(mesh), "a closed mesh with a hole");
  demand(distinct_edges(mesh).size() <= 4 * mesh.faces() + mesh.segments.size(), "too many edges");
}

}  // namespace
}  // namespace dynalin::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  const fuzz::TimeLimit limit;
  const std::string text = fuzz::text_of(bytes, count);
  for (const std::string_view ending : facet_file_endings()) {
    for (const char* element : {"", "a"}) {
      const auto facets = read_facets("fuzz" + std::string(ending), text, element);
      if (facets)
        fuzz::demand_sound_mesh(facets->mesh);
      else
        fuzz::demand(!facets.error().empty(), "an error without a reason");
    }
  }
  return 0;
}
