// The degrees of freedom of an OPENBOX: a GRID at the mass centre of each body, of flexible ones that of the undeformed
// one, and at each node of a beam, along the global axes; an SPOINT for each coordinate outside poses and each
// differential state.
//
// Unknowns count as in the layout, the coordinates of a part taken at its mass centre instead of its BCS: with c from
// the BCS to the mass centre
//
//     δr_B = δr_C + c × δθ,    so of a form g·δq on coordinates of the BCS    g_θ(C) = g_θ(B) + g_r × c
//
// and forces likewise, M_C = M_B + F × c. Behind them come the differential states, then multipliers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nastran/deck.h"
#include "nastran/export_options.h"
#include "nastran/ids.h"
#include "system/system.h"

namespace dynalin::nastran {

class OpenPoints {
 public:
  // Adds bodies, grids and scalar points to the deck. All arguments must outlive this.
  OpenPoints(const System&, const Motion&, const ExportOptions&, Ids&, Deck&);

  std::int64_t grid(BodyId b) const { return grids_[static_cast<std::size_t>(b.index)]; }
  // From the BCS to the mass centre, and where that is, global axes.
  const Vector& arm(BodyId b) const { return arms_[static_cast<std::size_t>(b.index)]; }
  Vector centre(BodyId b) const { return motion_.body(b).r + arm(b); }
  std::int32_t body_in_deck(BodyId b) const { return b.index - 1; }  // −1 of the ground
  // A flexible body, or a node of a beam: its inertia is in matrices.
  bool changes_shape(BodyId b) const { return !system_.layout().body(b).is_rigid(); }

  std::int32_t coordinates() const { return static_cast<std::int32_t>(body_of_.size()); }
  Dof dof(std::int32_t unknown) const { return dofs_[static_cast<std::size_t>(unknown)]; }
  // −1 of states that the linear model holds.
  std::int32_t unknown_of_state(std::int32_t k) const { return states_[static_cast<std::size_t>(k)]; }
  bool is_coordinate(std::int32_t unknown) const { return unknown < coordinates(); }
  BodyId body_of(std::int32_t coordinate) const { return body_of_[static_cast<std::size_t>(coordinate)]; }
  // An RBE2 from the grid of a body to one that rides on it, and such a grid with it. `of` is the id of the marker by
  // which both are numbered, 0 where there is none.
  void tie(const Grid&, BodyId, std::int64_t of);
  std::int64_t add_riding_grid(BodyId, std::string name, const Vector& at, std::int64_t system, std::int64_t of);
  // Another scalar point.
  std::int32_t add_unknown(std::string name, std::int64_t wanted);

  // What a unit along a coordinate of the BCS is along those of the mass centre: visit(coordinate, factor).
  template <class Visit>
  void by_centres(std::int32_t coordinate, const Visit& visit) const {
    visit(coordinate, 1.0);
    const BodyId b = body_of(coordinate);
    if (!b.valid()) return;
    const BodyBlock& block = system_.layout().body(b);
    const std::int32_t k = coordinate - block.offset;
    if (!block.turns() || k > 2) return;
    Vector unit;
    unit[static_cast<std::size_t>(k)] = 1;
    const Vector turn = cross(unit, arm(b));
    for (std::int32_t i = 0; i < 3; ++i) {
      if (turn[static_cast<std::size_t>(i)] != 0.0) visit(block.offset + 3 + i, turn[static_cast<std::size_t>(i)]);
    }
  }

 private:
  void add_body(std::size_t b);
  std::int64_t number_beside(std::int64_t id);

  const System& system_;
  const Motion& motion_;
  const ExportOptions& options_;
  Ids& ids_;
  Deck& deck_;
  std::vector<std::int64_t> grids_;          // by body
  std::optional<std::int64_t> last_marker_;  // the largest id, once it is asked for
  std::vector<Vector> arms_;                 // by body; of flexible ones to the undeformed centre
  std::vector<BodyId> body_of_;              // of coordinates, invalid outside bodies
  std::vector<Dof> dofs_;                    // of unknowns
  std::vector<std::int32_t> states_;
};

}  // namespace dynalin::nastran
