#include "linear/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "elements/bodies/fe_part.h"
#include "elements/bodies/flex_body.h"
#include "elements/controls/variable_list.h"
#include "linear/beam_states.h"
#include "linear/original_states.h"
#include "linear/user_coordinates.h"
#include "mechanics/node_variations.h"

namespace dynalin {

namespace {

// Modal coordinates of bodies are numbered behind it as states, their rates behind the double of it.
constexpr std::int32_t first_modal_number = 1000000;
constexpr std::array names = {"DX", "DY", "DZ", "AX", "AY", "AZ"};

// Each coordinate of the layout as a state, those of bodies as they are seen from marker `rm` (0: global axes), which
// `owner` carries. Modal coordinates have the type `of_modes`.
std::vector<StateCoordinate> listed_coordinates(const System& system, std::int64_t rm, BodyId owner,
                                                StateType of_modes) {
  const Layout& layout = system.layout();
  const std::vector<const ModalBody*> flexible = flexible_by_body(system.model());
  std::vector<StateCoordinate> list(system.coordinates());
  const auto put = [&](std::int32_t at, StateType type, const ElementLabel& of, std::int32_t k, std::int32_t rates,
                       std::string text) {
    StateLabel label{type, of.id, static_cast<int>(k) + 1, std::move(text), of.element(), false};
    list[static_cast<std::size_t>(at)] =
        state_coordinate(std::move(label), type, static_cast<int>(rates + k) + 1, system.coordinate_scale(at));
  };
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    const bool point = block.kind == BodyKind::point_mass;
    const bool owns_marker = owner == BodyId{static_cast<std::int32_t>(b)};
    const StateType type = rm == 0 ? (point         ? StateType::point_mass
                                      : flexible[b] ? StateType::flex_body
                                                    : StateType::part)
                                   : (point         ? StateType::point_mass_relative
                                      : flexible[b] ? StateType::flex_body_relative
                                                    : StateType::part_relative);
    for (std::int32_t k = 0; k < block.count; ++k) {
      const bool turns = k >= 3;
      const std::string_view what = turns ? "rotation" : "displacement", name = names[static_cast<std::size_t>(k)];
      const std::string_view seen = owns_marker ? "GROUND" : "BCS";
      put(block.offset + k, type, block.label, k, block.count,
          rm == 0 ? fmt::format("Global {} {}(BCS)", what, name)
          : turns ? fmt::format("Relative {} {}({},{})", what, name, seen, rm)
                  : fmt::format("Relative {} {}({},{},{})", what, name, seen, rm, rm));
    }
  }
  std::set<std::int32_t> modal;
  for (const FlexibleBody& f : flexible_bodies(system.model())) {
    const ElementLabel& of = layout.body(f.body).label;
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(f.flexible->modes()); ++k) {
      const std::int32_t at = layout.body_coordinate_count + static_cast<std::int32_t>(f.first) + k;
      const auto number = static_cast<std::int32_t>(f.flexible->number[static_cast<std::size_t>(k)]) - 1;
      put(at, of_modes, of, first_modal_number + number, first_modal_number,
          fmt::format("Modal generalized coordinate Q{}", number + 1));
      modal.insert(at);
    }
  }
  for (const ExtraBlock& e : layout.extras) {
    if (modal.contains(e.offset)) continue;
    for (std::int32_t k = 0; k < e.count; ++k)
      put(e.offset + k, e.kind.type, e.label, k, 0, e.coordinates[static_cast<std::size_t>(k)].name);
  }
  for (auto& [at, state] : beam_state_coordinates(system)) list[static_cast<std::size_t>(at)] = std::move(state);
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
      listed_coordinates(system, 0, {}, principal ? StateType::flex_body_euler : StateType::flex_body);
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
  const std::vector<bool> of_beams = beam_nodes(system.model());
  for (std::size_t k = 1; k < layout.bodies.size(); ++k) {
    const BodyBlock& block = layout.bodies[k];
    if (of_beams[k]) {
      row += block.count;
      continue;
    }
    add_relative_rows(motion, block, BodyId{static_cast<std::int32_t>(k)}, b, row, set.gradients);
    for (std::int32_t i = 0; i < block.count; ++i) row_of[static_cast<std::size_t>(block.offset + i)] = row++;
  }
  std::vector<StateCoordinate> seen = listed_coordinates(system, id, b.body, StateType::flex_body_relative);
  for (const std::int32_t coordinate : system.preference()) {
    const auto at = static_cast<std::size_t>(coordinate);
    // Coordinates outside bodies and those of beams know no frame: they are wanted as they are.
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
