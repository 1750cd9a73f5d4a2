#include "nastran/open_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "nastran/names.h"
#include "system/mass_centres.h"

namespace dynalin::nastran {

namespace {

// What the example of use_adams_ids adds to the ids of parts; no directive changes it.
constexpr std::int64_t part_offset = 100000;

}  // namespace

OpenPoints::OpenPoints(const System& system, const Motion& motion, const ExportOptions& options, Ids& ids, Deck& deck)
    : system_(system), motion_(motion), options_(options), ids_(ids), deck_(deck) {
  const Layout& layout = system.layout();
  Motion undeformed = motion;
  for (const ExtraBlock& extra : layout.extras) {
    for (std::int32_t k = 0; k < extra.count && extra.is_shape(); ++k)
      undeformed.extra[layout.extra_index(extra.offset + k)] = 0;
  }
  const std::vector<Vec3<Taylor>> centres = centres_in_bodies(system, undeformed);
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) arms_.push_back(motion.bodies[b].R * value(centres[b]));
  body_of_.resize(system.coordinates());
  dofs_.resize(system.coordinates());
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) add_body(b);
  for (const ExtraBlock& extra : layout.extras) {
    for (std::int32_t k = 0; k < extra.count; ++k) {
      ScalarPoint p;
      p.name =
          fmt::format("{}, {}", name_of(extra.label, options), extra.coordinates[static_cast<std::size_t>(k)].name);
      p.id = ids.take(IdSpace::point,
                      options.use_adams_ids ? options.spoint_offset + extra.label.id : options.grid_offset);
      dofs_[static_cast<std::size_t>(extra.offset + k)] = {p.id, 0};
      deck.scalar_points.push_back(std::move(p));
    }
  }
  for (const DifferentialState& z : layout.states) {
    states_.push_back(z.varies() ? static_cast<std::int32_t>(dofs_.size()) : -1);
    if (z.varies()) add_unknown(fmt::format("{}, state {}", name_of(*z.owner, options), z.coordinate), z.owner->id);
  }
}

void OpenPoints::tie(const Grid& grid, BodyId body, std::int64_t of) {
  RigidElement e;
  static_cast<Owner&>(e) = grid;
  e.id = ids_.take(IdSpace::element, options_.rbe2_offset + (options_.use_adams_ids ? of : 0));
  e.independent = this->grid(body);
  e.dependent = {grid.id};
  deck_.rigid_elements.push_back(std::move(e));
}

// Behind the number that a marker with an id has, and none that another one has or will have.
std::int64_t OpenPoints::number_beside(std::int64_t id) {
  constexpr int steps = 64;  // in a row without a gap there may be many more
  const Model& model = system_.model();
  for (std::int64_t near = id; near < id + steps; ++near) {
    const std::int64_t number = options_.marker_offset + near;
    const bool of_marker = near > 0 && model.find_marker(near);
    if (!of_marker && ids_.is_free(IdSpace::point, number)) return ids_.take(IdSpace::point, number);
  }
  if (!last_marker_) {
    last_marker_ = 0;
    for (const Marker& m : model.markers) last_marker_ = std::max(*last_marker_, m.label ? m.label->id : 0);
  }
  const std::int64_t behind = options_.marker_offset + *last_marker_ + 1;
  return ids_.take(IdSpace::point, behind < Ids::largest ? behind : options_.marker_offset + id);
}

std::int64_t OpenPoints::add_riding_grid(BodyId body, std::string name, const Vector& at, std::int64_t system,
                                         std::int64_t of) {
  Grid g;
  g.body = body_in_deck(body);
  g.name = std::move(name);
  g.id = options_.use_adams_ids ? number_beside(of) : ids_.take(IdSpace::point, options_.grid_offset);
  g.position = at;
  g.displacement_system = system;
  deck_.grids.push_back(g);
  tie(g, body, of);
  return g.id;
}

std::int32_t OpenPoints::add_unknown(std::string name, std::int64_t wanted) {
  ScalarPoint p;
  p.name = std::move(name);
  p.id = ids_.take(IdSpace::point, options_.use_adams_ids ? options_.spoint_offset + wanted : options_.grid_offset);
  dofs_.push_back({p.id, 0});
  deck_.scalar_points.push_back(std::move(p));
  return static_cast<std::int32_t>(dofs_.size()) - 1;
}

void OpenPoints::add_body(std::size_t b) {
  const BodyBlock& block = system_.layout().bodies[b];
  const std::string own = name_of(block.label, options_);
  const std::string name = block.is_node() ? fmt::format("{}, node {}", own, block.listed.node) : own;
  const std::int64_t offset = block.kind == BodyKind::point_mass ? options_.pointmass_offset : part_offset;
  Grid g;
  g.id = ids_.take(IdSpace::point, options_.use_adams_ids ? offset + block.label.id : options_.grid_offset);
  g.body = static_cast<std::int32_t>(b) - 1;
  g.name = block.is_node() || block.kind == BodyKind::ground ? name : name_of("centre of mass", block.label, options_);
  g.position = motion_.bodies[b].r + arms_[b];
  grids_.push_back(g.id);
  if (block.kind == BodyKind::ground) {
    g.position = {};
    g.fixed = "123456";
    deck_.grids.push_back(std::move(g));
    return;
  }
  deck_.bodies.push_back({name, g.id});
  if (!block.turns()) deck_.fixed_points.push_back({{g.body, g.name}, g.id, "456"});
  for (std::int32_t k = 0; k < block.count; ++k) {
    dofs_[static_cast<std::size_t>(block.offset + k)] = {g.id, k + 1};
    body_of_[static_cast<std::size_t>(block.offset + k)] = BodyId{static_cast<std::int32_t>(b)};
  }
  deck_.grids.push_back(std::move(g));
}

}  // namespace dynalin::nastran
