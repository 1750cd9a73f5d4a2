#include "nastran/unused_items.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace dynalin::nastran {

namespace {

std::unordered_set<std::int64_t> used_points(const Deck& deck) {
  std::unordered_set<std::int64_t> used;
  for (const ConcentratedMass& m : deck.masses) used.insert(m.grid);
  for (const RigidJoint& j : deck.rigid_joints) used.insert({j.grid_A, j.grid_B});
  // A grid that only rides along with another is not used by that.
  for (const auto* ties : {&deck.rigid_elements, &deck.shape_ties}) {
    for (const RigidElement& e : *ties) used.insert(e.independent);
  }
  for (const Relation& r : deck.relations) {
    for (const Relation::Term& t : r.terms) used.insert(t.dof.point);
  }
  for (const FixedPoint& f : deck.fixed_points) used.insert(f.point);
  for (const Bush& b : deck.bushes) used.insert({b.grid_A, b.grid_B});
  for (const Matrix& m : deck.matrices) {
    for (const Matrix::Entry& e : m.entries) used.insert({e.row.point, e.column.point});
  }
  for (const InitialState& s : deck.initial_states) used.insert(s.dof.point);
  for (const Shell& s : deck.shells) used.insert(s.grids.begin(), s.grids.end());
  for (const Line& l : deck.lines) used.insert({l.grid_A, l.grid_B});
  for (const InputPoint& p : deck.inputs) used.insert(p.grid);
  for (const OutputPoint& p : deck.outputs) used.insert(p.grid);
  used.insert(deck.mode_points.begin(), deck.mode_points.end());
  return used;
}

}  // namespace

void remove_unused(Deck& deck, const ExportOptions& options, std::vector<std::string>& details) {
  const auto asked = [&](std::string_view what) {
    return std::ranges::find(options.remove_unused_items, what) != options.remove_unused_items.end();
  };
  if (asked("cbush")) {
    const auto is_zero = [](double v) { return v == 0; };
    const auto count = std::erase_if(deck.bushes, [&](const Bush& b) {
      return std::ranges::all_of(b.stiffness, is_zero) && std::ranges::all_of(b.damping, is_zero);
    });
    details.push_back(fmt::format("CBUSH cards taken out: {}", count));
  }
  if (!asked("grid")) return;
  const std::unordered_set<std::int64_t> used = used_points(deck);
  const auto unused = [&](const Grid& g) { return !used.contains(g.id); };
  const auto count = std::erase_if(deck.grids, unused) + std::erase_if(deck.shape_grids, unused);
  for (auto* ties : {&deck.rigid_elements, &deck.shape_ties}) {
    for (RigidElement& e : *ties) std::erase_if(e.dependent, [&](std::int64_t id) { return !used.contains(id); });
    std::erase_if(*ties, [](const RigidElement& e) { return e.dependent.empty(); });
  }
  details.push_back(fmt::format("GRID cards taken out: {}", count));
}

}  // namespace dynalin::nastran
