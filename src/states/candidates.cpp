#include "states/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "elements/controls/variable_list.h"
#include "mechanics/node_variations.h"
#include "states/original_states.h"
#include "states/user_coordinates.h"

namespace dynalin {

namespace {

constexpr std::array coordinate_names = {"DX", "DY", "DZ", "AX", "AY", "AZ"};

// Each coordinate of the layout as a state, those of rigid bodies and of the BCS of others as they are seen from marker
// `rm` (0: global axes), which `owner` carries. `of` says which of the type codes they have.
std::vector<StateCoordinate> listed_coordinates(const System& system, std::int64_t rm, BodyId owner,
                                                StateType StateTypes::*of) {
  const Layout& layout = system.layout();
  std::vector<StateCoordinate> list(system.coordinates());
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    const bool owns_marker = owner == BodyId{static_cast<std::int32_t>(b)};
    for (std::int32_t k = 0; k < block.count; ++k) {
      StateCoordinate& state = list[static_cast<std::size_t>(block.offset + k)];
      state = global_coordinate(system, block, k);
      if (rm == 0 || block.is_node()) continue;
      const std::string_view name = coordinate_names[static_cast<std::size_t>(k)],
                             seen = owns_marker ? "GROUND" : "BCS";
      state.label.type = state.rate.type = block.listed.states.types.*of;
      state.label.text = state.rate.text = k < 3 ? fmt::format("Relative displacement {}({},{},{})", name, seen, rm, rm)
                                                 : fmt::format("Relative rotation {}({},{})", name, seen, rm);
    }
  }
  for (const ExtraBlock& e : layout.extras) {
    for (std::int32_t k = 0; k < e.count; ++k) {
      const ExtraCoordinate& c = e.coordinates[static_cast<std::size_t>(k)];
      StateLabel label{e.kind.types.*of, e.label.id, c.number, c.name, e.label.element(), false};
      list[static_cast<std::size_t>(e.offset + k)] = state_coordinate(
          std::move(label), e.kind.types.*of, c.number + e.kind.rates_behind, system.coordinate_scale(e.offset + k));
    }
  }
  return list;
}

// How the modal coordinates of the body that carries a marker move it; nothing of one on a rigid body.
std::vector<NodeVariations::One> moved_by_modes(const Motion& motion, const MarkerPlace& marker) {
  std::vector<NodeVariations::One> by;
  if (!marker.shapes) return by;
  const NodeVariations variations(motion, marker.body, *marker.shapes);
  for (std::size_t mode = 0; mode < marker.shapes->translation.size(); ++mode) by.push_back(variations.by(mode));
  return by;
}

// Gradient rows of one body's coordinates relative to marker b:
// translation R_bᵀ(r_B − r_b), rotation R_bᵀ(δθ_B − δθ_b); for the owner of b the ground seen from b.
void add_relative_rows(const Motion& motion, const BodyBlock& block, BodyId body, const MarkerPlace& b,
                       std::int32_t first, ConstraintRows& rows) {
  const bool owner = b.body == body;
  const BodyMotion& reference = motion.body(b.body);
  const Frame<Taylor> frame = motion.frame(b);
  const Vec3<Taylor> r_ref = along_motion(reference.r, reference.rdot, reference.rddot);
  const BodyMotion& own = motion.body(owner ? ground_body : body);
  const Vec3<Taylor> r = along_motion(own.r, own.rdot, own.rddot);
  const Vec3<Taylor> arm = r - r_ref;  // from the BCS of the marker's body to the point seen
  const Vec3<Taylor> none{};
  const std::vector<NodeVariations::One> modes = moved_by_modes(motion, b);
  const Vec3<Taylor> seen = arm - motion.arm(b);
  for (std::int32_t k = 0; k < block.count; ++k) {
    const Vec3<Taylor>& e = frame.axes[static_cast<std::size_t>(k % 3)];
    const std::int32_t row = first + k;
    rows.set(row, Taylor());
    if (k < 3) {
      // δ(e·(r − r_b)) = e·δr − e·δr_ref − (arm × e)·δθ_ref: only what moves against the marker counts.
      if (!owner) rows.add_pose(row, body, e, none);
      if (b.body != ground_body) rows.add_pose(row, b.body, -e, -cross(arm, e));
    } else {
      if (!owner) rows.add_pose(row, body, none, e);
      if (b.body != ground_body) rows.add_pose(row, b.body, none, -e);
    }
    for (std::size_t m = 0; m < modes.size(); ++m) {
      const Taylor along =
          k < 3 ? dot(e, modes[m].moves) + dot(cross(seen, e), modes[m].turns) : dot(e, modes[m].turns);
      rows.add_coordinate(row, rows.layout().body_coordinate_count + static_cast<std::int32_t>(b.shapes->first + m),
                          -along);
    }
  }
}

// As the default preference has them.
void put_followers_last(const Layout& layout, CandidateSet& set) {
  std::vector<Candidate> last;
  std::vector<CandidateSet::Moves> last_moves;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < set.wanted.size(); ++k) {
    if (layout.followers.contains(set.wanted[k].coordinate)) {
      last.push_back(std::move(set.wanted[k])), last_moves.push_back(std::move(set.moves[k]));
    } else if (kept++ != k) {
      set.wanted[kept - 1] = std::move(set.wanted[k]), set.moves[kept - 1] = std::move(set.moves[k]);
    }
  }
  std::ranges::move(last, set.wanted.begin() + static_cast<std::ptrdiff_t>(kept));
  std::ranges::move(last_moves, set.moves.begin() + static_cast<std::ptrdiff_t>(kept));
}

}  // namespace

StateCoordinate state_coordinate(StateLabel label, StateType rate_type, int rate_number, double scale) {
  StateLabel rate = label;
  rate.type = rate_type;
  rate.coordinate = rate_number;
  rate.is_rate = true;
  return {std::move(label), std::move(rate), scale};
}

StateCoordinate global_coordinate(const System& system, const BodyBlock& block, std::int32_t k) {
  const PoseStates& listed = block.listed.states;
  const auto at = static_cast<std::size_t>(k);
  const std::string of = block.is_node() ? fmt::format("node {}", block.listed.node) : std::string("BCS");
  StateLabel label{listed.types.global,
                   block.label.id,
                   listed.number[at],
                   fmt::format("Global {} {}({})", k < 3 ? "displacement" : "rotation", coordinate_names[at], of),
                   block.label.element(),
                   false};
  return state_coordinate(std::move(label), listed.types.global, listed.number[at] + listed.rates_behind,
                          system.coordinate_scale(block.offset + k));
}

Result<CandidateSet> state_candidates(const System& system, const Motion& motion, const LinearOptions& options) {
  const Layout& layout = system.layout();
  CandidateSet set;
  std::size_t count = 0;
  const VariableList* own = options.pstate ? system.model().get<VariableList>(*options.pstate) : nullptr;
  if (own) count += own->variables.size();
  const bool relative = options.rm.valid();
  const bool principal = options.principal_states && !relative;
  if (relative || principal) count += static_cast<std::size_t>(layout.body_coordinate_count);
  if (relative && options.principal_states) {
    set.warnings.warning(
        "options-disagree", {},
        fmt::format("RM={} asks for coordinates relative to that marker: the coordinates of the original "
                    "implementation are not used",
                    layout.marker_label(options.rm).id));
  }
  set.gradients.resize(layout, count);
  set.gradients.begin();
  std::int32_t row = 0;

  if (own) {
    if (auto failure = add_user_candidates(system, motion, *own, row, set)) return tl::unexpected(*failure);
    row += static_cast<std::int32_t>(set.own.size());
  }
  std::vector<StateCoordinate> global =
      listed_coordinates(system, 0, {}, principal ? &StateTypes::principal : &StateTypes::global);
  const auto as_it_is = [&](std::int32_t k) {
    return Candidate{k, -1, std::move(global[static_cast<std::size_t>(k)])};
  };
  if (principal) {
    row = add_principal_candidates(system, motion, row, set);
    for (std::int32_t k = layout.body_coordinate_count; k < layout.coordinate_count; ++k) {
      set.wanted.push_back(as_it_is(k));
      set.moves.push_back({{k, 1.0}});
    }
    put_followers_last(layout, set);
    return set;
  }
  if (!relative) {
    for (const std::int32_t coordinate : system.preference()) set.wanted.push_back(as_it_is(coordinate));
    return set;
  }

  const MarkerPlace& b = layout.marker(options.rm);
  const std::int64_t id = layout.marker_label(options.rm).id;
  std::vector<std::int32_t> row_of(system.coordinates(), -1);
  for (std::size_t k = 1; k < layout.bodies.size(); ++k) {
    const BodyBlock& block = layout.bodies[k];
    if (block.is_node()) {
      row += block.count;
      continue;
    }
    add_relative_rows(motion, block, BodyId{static_cast<std::int32_t>(k)}, b, row, set.gradients);
    for (std::int32_t i = 0; i < block.count; ++i) row_of[static_cast<std::size_t>(block.offset + i)] = row++;
  }
  std::vector<StateCoordinate> seen = listed_coordinates(system, id, b.body, &StateTypes::relative);
  for (const std::int32_t coordinate : system.preference()) {
    const auto at = static_cast<std::size_t>(coordinate);
    // Coordinates outside bodies and those of nodes know no frame: they are wanted as they are.
    if (row_of[at] < 0) {
      set.wanted.push_back({coordinate, -1, std::move(seen[at])});
      continue;
    }
    set.wanted.push_back({-1, row_of[at], std::move(seen[at])});
    set.fallback.push_back(as_it_is(coordinate));
  }
  return set;
}

}  // namespace dynalin
