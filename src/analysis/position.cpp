#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/assembly.h"
#include "analysis/initial.h"
#include "analysis/row_sizes.h"
#include "expression/parametric_curve.h"

namespace dynalin {

Violation position_violation(const System& system, const ConstraintRows& rows) {
  Violation v;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (rows.level(k) != RowLevel::position) continue;
    const double relative = std::abs(rows.along_motion(k).value) / row_scale(system, rows.row(k));
    if (relative > v.relative || std::isnan(relative)) v = {relative, k};
    if (std::isnan(relative)) break;
  }
  return v;
}

namespace {

bool beyond_an_end(const Layout& layout, const OperatingPoint& op) {
  return std::any_of(layout.curve_points.begin(), layout.curve_points.end(), [&](const CurvePoint& c) {
    return !c.curve->reaches(op.extra[layout.extra_index(c.coordinate)]);
  });
}

HeldStarts held_starts(const System& system, const Restated& restated) {
  HeldStarts held;
  bool any = false;
  for (const StartCondition& s : system.starts()) {
    held.push_back(s.displacement && restated.holds(*s.owner, s.arguments.displacement));
    any = any || held.back();
  }
  return any ? held : HeldStarts();
}

// How far bodies have been moved, squared: radians and lengths of the model.
double change(const System& system, const OperatingPoint& from, const OperatingPoint& to) {
  double sum = 0;
  for (std::size_t b = 0; b < from.poses.size(); ++b) {
    const Vector r = (to.poses[b].r - from.poses[b].r) / system.length();
    const Matrix3 turn = to.poses[b].R - from.poses[b].R;
    sum += dot(r, r);
    for (std::size_t k = 0; k < 3; ++k) sum += 0.5 * dot(turn[k], turn[k]);
  }
  return sum;
}

// From the drawn place and, if that fails, from places all over the curves. The least change counts.
std::optional<OperatingPoint> assemble_inside(const System& system, const OperatingPoint& drawn,
                                              const HeldStarts& starts, const Progress& progress) {
  constexpr std::size_t places = 12;
  const Layout& layout = system.layout();
  std::optional<OperatingPoint> best;
  const auto consider = [&](OperatingPoint from) {
    auto found = assemble(system, std::move(from), starts, Ends::kept, progress);
    if (!found || beyond_an_end(layout, *found)) return;
    if (!best || change(system, drawn, *found) < change(system, drawn, *best)) best = std::move(*found);
  };
  consider(drawn);
  if (best) return best;
  for (std::size_t k = 0; k < places; ++k) {
    OperatingPoint from = drawn;
    for (const CurvePoint& c : layout.curve_points) {
      const std::vector<double> all = c.curve->samples(places);
      from.extra[layout.extra_index(c.coordinate)] = all[k * (all.size() - 1) / (places - 1)];
    }
    consider(std::move(from));
  }
  return best;
}

// Coordinates of bodies that deform which EXACT asks to keep, angles where it names all three; empty if there are none.
std::vector<bool> exact_where_bodies_deform(const System& system) {
  const Layout& layout = system.layout();
  std::vector<bool> held;
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const Body& body = system.model().bodies[b];
    if (body.nature->modal.empty()) continue;
    const std::array<bool, 6>& exact = body.exact;
    const bool all_angles = exact[3] && exact[4] && exact[5];
    for (std::int32_t k = 0; k < layout.bodies[b].count; ++k) {
      if (k < 3 ? !exact[static_cast<std::size_t>(k)] : !all_angles) continue;
      held.resize(system.coordinates());
      held[static_cast<std::size_t>(layout.bodies[b].offset + k)] = true;
    }
  }
  return held;
}

}  // namespace

Result<OperatingPoint> assemble_position(const System& system, OperatingPoint op, Findings&, const Restated& restated,
                                         const Progress& progress) {
  const Layout& layout = system.layout();
  const HeldStarts starts = held_starts(system, restated);
  const bool searches = restated.is_all() && !layout.curve_points.empty();
  // A body deforms before a coordinate leaves where EXACT holds it, if that is enough.
  if (const std::vector<bool> held = exact_where_bodies_deform(system); !held.empty()) {
    auto bent = assemble(system, op, starts, Ends::passed, progress, held);
    if (bent && !(searches && beyond_an_end(layout, *bent))) return bent;
  }
  const OperatingPoint drawn = searches ? op : OperatingPoint();
  auto found = assemble(system, std::move(op), starts, Ends::passed, progress);
  if (searches && (!found || beyond_an_end(layout, *found))) {
    if (auto inside = assemble_inside(system, drawn, starts, progress)) return *std::move(inside);
  }
  return found;
}

}  // namespace dynalin
