#include "analysis/assembly_moves.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analysis/row_sizes.h"
#include "base/degree.h"
#include "system/operating_state.h"

namespace dynalin {

namespace {

// Parts of the model's length, or radians: more than the digits of a dataset leave open, and than is changed by them.
constexpr double drawn_open = 1e-4, kept = 1e-6;
constexpr std::size_t named = 10;  // constraints of a model that was drawn apart

struct Move {
  double distance = 0, turn = 0;  // [length], [rad]
};

Move move_of(const OperatingPoint& from, const OperatingPoint& to, std::size_t body) {
  const auto &a = from.poses[body], &b = to.poses[body];
  Matrix3 turn;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t r = 0; r < 3; ++r) turn[c][r] = dot(a.R[r], b.R[c]);
  }
  const double twice_sine = std::hypot(turn[1][2] - turn[2][1], turn[2][0] - turn[0][2], turn[0][1] - turn[1][0]);
  return {norm(b.r - a.r), std::atan2(twice_sine, turn[0][0] + turn[1][1] + turn[2][2] - 1)};
}

std::string text_of(const Move& m, double length) {
  std::string text;
  if (m.distance > kept * length) text = fmt::format("moves it by {:.4g}", m.distance);
  if (m.turn > kept)
    text += fmt::format("{}turns it by {:.4g} degrees", text.empty() ? "" : " and ", m.turn * 180 / std::numbers::pi);
  return text;
}

// A constraint that is open as drawn, and the body it holds that moves most.
struct OpenConstraint {
  const ElementLabel* owner = nullptr;
  std::size_t body = 0;
  double moved = 0;
};

std::vector<OpenConstraint> open_constraints(const System& system, const OperatingPoint& drawn,
                                             const OperatingPoint& assembled) {
  const Layout& layout = system.layout();
  std::vector<std::size_t> body_of(static_cast<std::size_t>(layout.body_coordinate_count));
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    for (std::int32_t k = 0; k < block.count; ++k) body_of[static_cast<std::size_t>(block.offset + k)] = b;
  }
  std::vector<bool> follows(static_cast<std::size_t>(layout.coordinate_count), false);
  for (const ExtraBlock& e : layout.extras) {
    for (std::int32_t k = 0; k < e.count && !e.is_deformation(); ++k)
      follows[static_cast<std::size_t>(e.offset + k)] = true;
  }
  ConstraintRows rows;
  rows.resize(layout, layout.row_count());
  system.constraints(system.motion(drawn), rows);
  std::vector<OpenConstraint> list;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    const ConstraintRow& row = layout.rows[static_cast<std::size_t>(k)];
    if (rows.level(k) != RowLevel::position || row.prescribed) continue;
    const double open = std::abs(rows.along_motion(k).value) / row_scale(system, rows.row(k));
    if (!(open > drawn_open)) continue;
    // Nobody draws a point of contact.
    const auto of_row = rows.row(k);
    if (std::any_of(of_row.begin(), of_row.end(),
                    [&](const auto& e) { return follows[static_cast<std::size_t>(e.column)]; }))
      continue;
    if (list.empty() || list.back().owner != row.owner) list.push_back({row.owner});
    OpenConstraint& constraint = list.back();
    for (const auto& e : of_row) {
      if (e.column >= layout.body_coordinate_count) continue;
      const std::size_t body = body_of[static_cast<std::size_t>(e.column)];
      const Move m = move_of(drawn, assembled, body);
      const double moved = std::max(m.distance / system.length(), m.turn);
      if (moved > constraint.moved) constraint.body = body, constraint.moved = moved;
    }
  }
  return list;
}

// Of a body, what EXACT asks to keep and what is not kept: "X from 0.3 to 0".
std::vector<std::string> changed_coordinates(const System& system, const OperatingPoint& drawn,
                                             const OperatingPoint& assembled, std::size_t body) {
  static constexpr std::array<const char*, 6> names = {"X", "Y", "Z", "PSI", "THETA", "PHI"};
  const std::array<bool, 6>& exact = system.model().bodies[body].exact;
  const auto &from = drawn.poses[body], &to = assembled.poses[body];
  std::vector<std::string> list;
  for (std::size_t k = 0; k < 3; ++k) {
    if (exact[k] && std::abs(to.r[k] - from.r[k]) > kept * system.length())
      list.push_back(fmt::format("{} from {:g} to {:g}", names[k], from.r[k], to.r[k]));
  }
  const Triple before = angles_313(from.R), after = angles_313(to.R);
  // With a vertical axis z only the sum of the others says anything.
  const bool determined = std::sin(before[1]) > kept && std::sin(after[1]) > kept;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool one_of_two = k != 1 && !determined;
    if (!exact[3 + k] || one_of_two) continue;
    if (std::abs(std::remainder(after[k] - before[k], 2 * std::numbers::pi)) > kept)
      list.push_back(fmt::format("{} from {:g}D to {:g}D", names[3 + k], before[k] / degree, after[k] / degree));
  }
  return list;
}

}  // namespace

void warn_of_moves(const System& system, const OperatingPoint& drawn, const OperatingPoint& assembled,
                   Diagnostics& warnings) {
  const Layout& layout = system.layout();
  const auto same = [](const Vector& a, const Vector& b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
  const auto stays = [&](std::size_t b) {
    const auto &from = drawn.poses[b], &to = assembled.poses[b];
    return same(from.r, to.r) && same(from.R.x, to.R.x) && same(from.R.y, to.R.y);
  };
  std::vector<std::size_t> moved;
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    if (!stays(b)) moved.push_back(b);
  }
  if (moved.empty()) return;
  std::size_t said = 0, unsaid = 0;
  for (const OpenConstraint& c : open_constraints(system, drawn, assembled)) {
    const std::string what = text_of(move_of(drawn, assembled, c.body), system.length());
    if (what.empty()) continue;
    if (++said > named) {
      ++unsaid;
      continue;
    }
    warnings.warning(
        "drawn-open", c.owner->at,
        fmt::format("{} does not hold as drawn: of the parts it joins, {} moves most to meet it, assembly {}",
                    c.owner->full_text(), layout.bodies[c.body].label.full_text(), what));
  }
  if (unsaid > 0)
    warnings.warning("drawn-open", {},
                     fmt::format("{} more constraint{} not hold as drawn", unsaid, unsaid == 1 ? " does" : "s do"));
  for (const std::size_t b : moved) {
    const auto changed = changed_coordinates(system, drawn, assembled, b);
    if (changed.empty()) continue;
    warnings.warning("changed-position", layout.bodies[b].label.at,
                     fmt::format("{} cannot keep what EXACT asks for: assembly changes {}",
                                 layout.bodies[b].label.full_text(), fmt::join(changed, ", ")));
  }
}

}  // namespace dynalin
