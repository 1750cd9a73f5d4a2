#include "linear/candidates.h"

#include <fmt/format.h>

#include <array>

#include "elements/controls/variable_list.h"
#include "linear/original_states.h"
#include "linear/user_coordinates.h"

namespace dynalin {

namespace {

constexpr std::array names = {"DX", "DY", "DZ", "AX", "AY", "AZ"};

StateLabel coordinate_label(const Layout& layout, std::int32_t coordinate, std::int64_t rm, bool owns_marker) {
  StateLabel label;
  for (const BodyBlock& b : layout.bodies) {
    if (b.count == 0 || coordinate < b.offset || coordinate >= b.offset + b.count) continue;
    const auto k = static_cast<std::size_t>(coordinate - b.offset);
    const bool turns = k >= 3;
    label.element = b.label.id;
    label.owner = b.label.text();
    label.coordinate = static_cast<int>(k) + 1;
    const bool point = b.kind == BodyKind::point_mass;
    const std::string_view what = turns ? "rotation" : "displacement";
    if (rm == 0) {
      label.type = point ? StateType::point_mass : StateType::part;
      label.text = fmt::format("Global {} {}(BCS)", what, names[k]);
    } else {
      label.type = point ? StateType::point_mass_relative : StateType::part_relative;
      const std::string_view seen = owns_marker ? "GROUND" : "BCS";
      label.text = turns ? fmt::format("Relative {} {}({},{})", what, names[k], seen, rm)
                         : fmt::format("Relative {} {}({},{},{})", what, names[k], seen, rm, rm);
    }
    return label;
  }
  for (const ExtraBlock& e : layout.extras) {
    if (coordinate < e.offset || coordinate >= e.offset + e.count) continue;
    label.element = e.label.id;
    label.owner = e.label.text();
    label.type = e.label.statement == "CVCV" ? StateType::cvcv : StateType::ptcv;
    label.coordinate = coordinate - e.offset + 1;
    label.text = e.coordinates[static_cast<std::size_t>(coordinate - e.offset)].name;
  }
  return label;
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
  }
}

}  // namespace

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
    set.warnings.push_back(
        fmt::format("RM={} asks for coordinates relative to that marker: the coordinates of the original "
                    "implementation are not used",
                    layout.marker_labels[static_cast<std::size_t>(options.rm.index)].id));
  }
  set.gradients.resize(layout, count);
  set.gradients.begin();
  std::int32_t row = 0;

  if (own) {
    if (auto failure = add_user_candidates(system, motion, *own, row, set)) return tl::unexpected(*failure);
    row += static_cast<std::int32_t>(set.own.size());
  }
  if (principal) {
    row = add_principal_candidates(system, motion, row, set);
    for (std::int32_t k = layout.body_coordinate_count; k < layout.coordinate_count; ++k) {
      set.wanted.push_back({k, -1, coordinate_label(layout, k, 0, false)});
      set.moves.push_back({{k, 1.0}});
    }
    return set;
  }
  auto& plain = relative ? set.fallback : set.wanted;
  for (const std::int32_t coordinate : system.preference()) {
    // Coordinates outside bodies know no frame: they are wanted as they are.
    if (relative && coordinate >= layout.body_coordinate_count) continue;
    plain.push_back({coordinate, -1, coordinate_label(layout, coordinate, 0, false)});
  }
  if (!relative) return set;

  const MarkerPlace& b = layout.marker(options.rm);
  const std::int64_t id = layout.marker_labels[static_cast<std::size_t>(options.rm.index)].id;
  std::vector<std::int32_t> row_of(system.coordinates(), -1);
  for (std::size_t k = 1; k < layout.bodies.size(); ++k) {
    const BodyBlock& block = layout.bodies[k];
    add_relative_rows(motion, block, BodyId{static_cast<std::int32_t>(k)}, b, row, set.gradients);
    for (std::int32_t i = 0; i < block.count; ++i) row_of[static_cast<std::size_t>(block.offset + i)] = row++;
  }
  const std::int32_t owner_offset = layout.body(b.body).offset;
  for (const std::int32_t coordinate : system.preference()) {
    if (row_of[static_cast<std::size_t>(coordinate)] < 0) {
      set.wanted.push_back({coordinate, -1, coordinate_label(layout, coordinate, 0, false)});
      continue;
    }
    const bool owns =
        owner_offset >= 0 && coordinate >= owner_offset && coordinate < owner_offset + layout.body(b.body).count;
    set.wanted.push_back(
        {-1, row_of[static_cast<std::size_t>(coordinate)], coordinate_label(layout, coordinate, id, owns)});
  }
  return set;
}

}  // namespace dynalin
