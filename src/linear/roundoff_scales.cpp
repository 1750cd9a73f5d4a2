#include "linear/roundoff_scales.h"

#include <algorithm>
#include <numeric>

namespace dynalin {

RoundoffScales::RoundoffScales(const Layout& layout, const Motion& motion)
    : group_(static_cast<std::size_t>(layout.coordinate_count)), turning_(group_.size(), 0.0) {
  std::iota(group_.begin(), group_.end(), std::int32_t{0});
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    const double turning = std::sqrt(dot(motion.bodies[b].w, motion.bodies[b].w) + norm(motion.bodies[b].wdot));
    for (std::int32_t k = 0; k < block.count; ++k) {
      const auto at = static_cast<std::size_t>(block.offset + k);
      group_[at] = block.offset + k - k % 3;
      turning_[at] = turning;
    }
  }
}

ColumnMatrix RoundoffScales::of(const Equations& eq, PartialBy family) const {
  ColumnMatrix m = eq.matrix(family);
  const std::span<const double> sizes = eq.sizes(family);
  std::copy(sizes.begin(), sizes.end(), m.value.begin());
  // Inertia gives partials by displacements and rates what is derived from those by accelerations.
  const double order = family == PartialBy::position ? 2 : family == PartialBy::velocity ? 1 : 0;
  if (order > 0) {
    const ColumnMatrix& inertia = eq.matrix(PartialBy::acceleration);
    const std::span<const double> inertia_sizes = eq.sizes(PartialBy::acceleration);
    for (std::int32_t c = 0; c < m.columns; ++c) {
      const double factor = std::pow(turning_[static_cast<std::size_t>(c)], order);
      if (factor == 0) continue;
      const auto first = m.row.begin() + m.start[static_cast<std::size_t>(c)],
                 last = m.row.begin() + m.start[static_cast<std::size_t>(c) + 1];
      for (std::int32_t k = inertia.start[static_cast<std::size_t>(c)];
           k < inertia.start[static_cast<std::size_t>(c) + 1]; ++k) {
        const auto at = std::lower_bound(first, last, inertia.row[static_cast<std::size_t>(k)]);
        if (at == last || *at != inertia.row[static_cast<std::size_t>(k)]) continue;
        double& size = m.value[static_cast<std::size_t>(at - m.row.begin())];
        size = std::max(size, order * factor * inertia_sizes[static_cast<std::size_t>(k)]);
      }
    }
  }
  // Columns of one group have the same rows but for those that elements leave out; the largest of a block counts.
  const bool by_coordinates = family <= PartialBy::acceleration;
  std::vector<double> largest(static_cast<std::size_t>(m.rows), 0.0);
  for (std::int32_t c = 0; c < m.columns;) {
    std::int32_t end = c + 1;
    while (by_coordinates && end < m.columns && group(end) == group(c)) ++end;
    const auto for_block = [&](auto&& visit) {
      for (std::int32_t k = m.start[static_cast<std::size_t>(c)]; k < m.start[static_cast<std::size_t>(end)]; ++k) {
        const auto at = static_cast<std::size_t>(k);
        visit(m.value[at], largest[static_cast<std::size_t>(group(m.row[at]))]);
      }
    };
    for_block([](double size, double& most) { most = std::max(most, size); });
    for_block([](double& size, double& most) { size = most; });
    for_block([](double, double& most) { most = 0; });
    c = end;
  }
  return m;
}

ColumnMatrix RoundoffScales::roundings(const Equations& eq, PartialBy family, ColumnMatrix sizes) const {
  const ColumnMatrix& m = eq.matrix(family);
  const std::span<const double> own = eq.sizes(family);
  const bool by_coordinates = family <= PartialBy::acceleration;
  const auto coordinates = static_cast<std::int32_t>(group_.size());
  struct Block {
    double largest = 0;
    bool exact = true;
  };
  std::vector<Block> blocks(static_cast<std::size_t>(m.rows));
  for (std::int32_t c = 0; c < m.columns;) {
    std::int32_t end = c + 1;
    while (by_coordinates && end < m.columns && group(end) == group(c)) ++end;
    const auto for_block = [&](auto&& visit) {
      for (std::int32_t k = m.start[static_cast<std::size_t>(c)]; k < m.start[static_cast<std::size_t>(end)]; ++k) {
        const auto at = static_cast<std::size_t>(k);
        visit(at, blocks[static_cast<std::size_t>(group(m.row[at]))]);
      }
    };
    for_block([&](std::size_t k, Block& b) { b.largest = std::max(b.largest, own[k]); });
    for_block([&](std::size_t k, Block& b) {
      // Sums that cancel, and inertia that passes on what turns, have larger sizes than the entries.
      if (own[k] > std::abs(m.value[k]) || sizes.value[k] > b.largest || !is_short(m.value[k], b.largest))
        b.exact = false;
    });
    for_block([&](std::size_t k, Block& b) {
      const bool measured = by_coordinates || family == PartialBy::lambda || m.row[k] < coordinates;
      sizes.value[k] *= b.exact ? 0.0 : measured ? along_axes : as_read;
    });
    for_block([](std::size_t, Block& b) { b = {}; });
    c = end;
  }
  return sizes;
}

}  // namespace dynalin
