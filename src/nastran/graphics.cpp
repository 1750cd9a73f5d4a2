#include "nastran/graphics.h"

#include <map>
#include <utility>

#include "geometry/shape_source.h"
#include "model/model.h"
#include "nastran/names.h"

namespace dynalin::nastran {

namespace {

class Drawer {
 public:
  Drawer(const Model& model, std::span<const Pose> poses, const ExportOptions& options, Ids& ids, Deck& deck)
      : model_(model), poses_(poses), options_(options), ids_(ids), deck_(deck) {}

  void add(const Shape& shape) {
    name_ = name_of(shape.label, options_);
    const std::vector<std::int64_t> grids = add_grids(shape);
    const auto& mesh = shape.mesh;
    if (options_.use_wireframe) {
      for (const Mesh::Edge& e : distinct_edges(mesh)) add_line(shape, e, grids);
      return;
    }
    const auto add_faces = [&](const auto& faces, std::int64_t offset) {
      for (const auto& face : faces) {
        Shell shell{owner(shape.body), ids_.take(IdSpace::element, offset), shell_property(), {}};
        for (const Mesh::Index v : face) shell.grids.push_back(grids[v]);
        deck_.shells.push_back(std::move(shell));
      }
    };
    add_faces(mesh.quads, options_.cquad4_offset);
    add_faces(mesh.triangles, options_.ctria3_offset);
    for (const Mesh::Edge& e : mesh.segments) add_line(shape, e, grids);
  }

  void add_ties() {
    for (auto& [body, grids] : riding_) {
      const Body& on = deck_.bodies[body];
      deck_.shape_ties.push_back({{static_cast<std::int32_t>(body), on.name},
                                  ids_.take(IdSpace::element, options_.rbe2_offset),
                                  on.grid,
                                  std::move(grids)});
    }
  }

 private:
  static constexpr double thin = 1e-3;  // of the length of the model

  // The name stands before the first card of a kind alone.
  Owner owner(BodyId body) { return {body == ground_body ? -1 : body.index - 1, std::exchange(name_, {})}; }

  std::vector<std::int64_t> add_grids(const Shape& shape) {
    std::vector<std::int64_t> grids;
    const std::string name = name_;
    for (Mesh::Index v = 0; v < shape.mesh.vertices.size(); ++v) {
      const BodyId body = shape.body_of(v);
      Grid grid;
      static_cast<Owner&>(grid) = owner(body);
      grid.id = ids_.take(IdSpace::point, options_.graphics_grid_offset);
      grid.position = shape.global(v, poses_);
      // What is drawn on a flexible body stays where it is, as the LINEAR command leaves it.
      if (body == ground_body || model_.body(body).nature->listed.role == BodyRole::shaped)
        grid.fixed = "123456";
      else
        riding_[static_cast<std::size_t>(body.index - 1)].push_back(grid.id);
      grids.push_back(grid.id);
      deck_.shape_grids.push_back(std::move(grid));
    }
    name_ = name;
    return grids;
  }

  void add_line(const Shape& shape, const Mesh::Edge& e, const std::vector<std::int64_t>& grids) {
    const bool between_bodies = shape.body_of(e[0]) != shape.body_of(e[1]);
    if (between_bodies && options_.file_name_style == FileStyle::C) return;
    const bool plotel = options_.use_wireframe || options_.use_plotel || between_bodies;
    const BodyId on = between_bodies ? ground_body : shape.body_of(e[0]);
    deck_.lines.push_back({owner(on), ids_.take(IdSpace::element, options_.crod_offset), plotel ? 0 : rod_property(),
                           grids[e[0]], grids[e[1]]});
  }

  std::int64_t shell_property() { return property(shell_, options_.pshell_offset, false); }
  std::int64_t rod_property() { return property(rod_, options_.prod_offset, true); }
  // One for all shapes, made when first wanted, with a material of its own. A shell has a thickness, a rod an area.
  std::int64_t property(std::int64_t& known, std::int64_t offset, bool rod) {
    if (known == 0) {
      known = ids_.take(IdSpace::property, offset);
      const double size = thin * model_.characteristic_length();
      deck_.shape_properties.push_back(
          {{}, known, ids_.take(IdSpace::material, options_.material_card_number), rod, rod ? size * size : size});
    }
    return known;
  }

  const Model& model_;
  std::span<const Pose> poses_;
  const ExportOptions& options_;
  Ids& ids_;
  Deck& deck_;
  std::string name_;
  std::map<std::size_t, std::vector<std::int64_t>> riding_;  // by Deck::bodies
  std::int64_t shell_ = 0, rod_ = 0;
};

}  // namespace

void add_graphics(const Model& model, std::span<const Pose> poses, const ExportOptions& options, Ids& ids, Deck& deck,
                  Diagnostics& remarks) {
  if (!options.export_graphics) return;
  const ShapeChoice choice{.files = options.export_external,
                           .spring_dampers = options.export_spdp && options.file_name_style != FileStyle::C};
  Drawer drawer(model, poses, options, ids, deck);
  for (const Shape& shape : shapes_of(model, poses, remarks, choice)) drawer.add(shape);
  drawer.add_ties();
}

}  // namespace dynalin::nastran
