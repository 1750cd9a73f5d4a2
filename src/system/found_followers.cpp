#include "system/found_followers.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "mechanics/follower_source.h"
#include "system/sources.h"

namespace dynalin {

namespace {

// So much may rounding change a row, as part of what its coordinates do in it: bodies may have other origins.
constexpr double rounding_of_rows = 1e-12;

double size_of(const System& system, std::span<const ConstraintRows::Entry> row) {
  double size = 0;
  for (const double entry : scaled_row(system, row).value) size = std::hypot(size, entry);
  return size;
}

}  // namespace

bool has_followers(const Layout& layout) {
  return std::ranges::any_of(layout.extras, [](const ExtraBlock& e) { return e.kind.role == ExtraRole::follower; });
}

void find_followers(const System& system, const RowsBefore& before, OperatingPoint& op) {
  if (!has_followers(system.layout())) return;
  const Motion motion = system.motion(op);
  ConstraintRows rows;
  rows.resize(system.layout());
  system.constraints(motion, rows);
  const auto as_before = [&](std::int32_t row) {
    const std::optional<double>& was = before[static_cast<std::size_t>(row)];
    const double is = rows.along_motion(row).value;
    return was && (is == *was || std::abs(is - *was) <= rounding_of_rows * size_of(system, rows.row(row)));
  };
  for_each_source<FollowerSource>(system, [&](const ElementSet&, const FollowerSource& source) {
    const std::span<const Follower> all = source.followers();
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Follower& f = all[k];
      bool stays = true;
      for (std::int32_t r = 0; r < f.rows; ++r) stays = stays && as_before(f.first_row + r);
      if (stays) continue;
      const auto first =
          op.extra.begin() + static_cast<std::ptrdiff_t>(system.layout().extra_index(f.first_coordinate));
      source.find(k, motion, {first, static_cast<std::size_t>(f.coordinates)});
    }
  });
}

}  // namespace dynalin
