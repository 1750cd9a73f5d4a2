#include "perturbation/roundoff_scales.h"

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

// work(for_entries) for the columns of each vector, which have the same rows but for those that elements leave out;
// for_entries(visit) calls visit(entry, block) for what stands there.
template <class Work>
void RoundoffScales::for_blocks(const ColumnMatrix& m, bool by_coordinates, Work&& work) const {
  for (std::int32_t c = 0; c < m.columns;) {
    std::int32_t end = c + 1;
    while (by_coordinates && end < m.columns && group(end) == group(c)) ++end;
    work([&](auto&& visit) {
      for (std::int32_t k = m.start[static_cast<std::size_t>(c)]; k < m.start[static_cast<std::size_t>(end)]; ++k) {
        const auto at = static_cast<std::size_t>(k);
        visit(at, static_cast<std::size_t>(group(m.row[at])));
      }
    });
    c = end;
  }
}

std::vector<double> RoundoffScales::of(const Equations& eq, PartialBy family) const {
  const ColumnMatrix& m = eq.matrix(family);
  const std::span<const double> own = eq.sizes(family);
  std::vector<double> sizes(own.begin(), own.end());
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
        double& size = sizes[static_cast<std::size_t>(at - m.row.begin())];
        size = std::max(size, order * factor * inertia_sizes[static_cast<std::size_t>(k)]);
      }
    }
  }
  // The largest of a block counts.
  std::vector<double> largest(static_cast<std::size_t>(m.rows), 0.0);
  for_blocks(m, family <= PartialBy::acceleration, [&](auto&& for_entries) {
    for_entries([&](std::size_t k, std::size_t block) { largest[block] = std::max(largest[block], sizes[k]); });
    for_entries([&](std::size_t k, std::size_t block) { sizes[k] = largest[block]; });
    for_entries([&](std::size_t, std::size_t block) { largest[block] = 0; });
  });
  return sizes;
}

std::vector<double> RoundoffScales::roundings(const Equations& eq, PartialBy family, std::vector<double> sizes) const {
  const ColumnMatrix& m = eq.matrix(family);
  const std::span<const double> own = eq.sizes(family);
  const bool by_coordinates = family <= PartialBy::acceleration;
  const auto coordinates = static_cast<std::int32_t>(group_.size());
  struct Block {
    double largest = 0;
    bool exact = true;
  };
  std::vector<Block> blocks(static_cast<std::size_t>(m.rows));
  for_blocks(m, by_coordinates, [&](auto&& for_entries) {
    for_entries([&](std::size_t k, std::size_t at) { blocks[at].largest = std::max(blocks[at].largest, own[k]); });
    for_entries([&](std::size_t k, std::size_t at) {
      // Short as well must be what an entry is the sum of. Inertia that passes on what turns has larger sizes.
      const bool exact = sizes[k] <= blocks[at].largest && is_short(own[k], blocks[at].largest) &&
                         is_short(m.value[k], blocks[at].largest);
      if (!exact) blocks[at].exact = false;
    });
    for_entries([&](std::size_t k, std::size_t at) {
      const bool measured = by_coordinates || family == PartialBy::lambda || m.row[k] < coordinates;
      sizes[k] *= blocks[at].exact ? 0.0 : measured ? along_axes : as_read;
    });
    for_entries([&](std::size_t, std::size_t at) { blocks[at] = {}; });
  });
  return sizes;
}

}  // namespace dynalin
