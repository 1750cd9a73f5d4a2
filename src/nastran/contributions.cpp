#include "nastran/contributions.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace dynalin::nastran {

void add_up(std::vector<MatrixEntry>& entries, double rounding) {
  const auto key = [](const MatrixEntry& e) { return std::tuple(e.kind, e.column, e.row); };
  std::ranges::stable_sort(entries, {}, key);
  std::size_t count = 0;
  for (std::size_t k = 0; k < entries.size();) {
    MatrixEntry sum = entries[k];
    double size = std::abs(sum.value);
    std::size_t last = k + 1;
    for (; last < entries.size() && key(entries[last]) == key(sum); ++last) {
      sum.value += entries[last].value;
      size += std::abs(entries[last].value);
    }
    k = last;
    if (std::abs(sum.value) > rounding * size) entries[count++] = sum;
  }
  entries.resize(count);
}

Contributions::Contributions(const System& system, const Perturbation& perturbation, const AlgebraicForms& forms,
                             const OpenPoints& points)
    : system_(system), at_(*perturbation.at), forms_(forms), points_(points) {}

void Contributions::add(const MotionForm& form, std::int32_t row, double factor,
                        std::vector<MatrixEntry>& entries) const {
  for (const auto& [key, v] : form) {
    const auto [family, column] = key;
    const MatrixKind kind = family == PartialBy::acceleration                                  ? MatrixKind::M
                            : family == PartialBy::velocity || family == PartialBy::state_rate ? MatrixKind::B
                                                                                               : MatrixKind::K;
    const double value = factor * v;
    if (value == 0.0) continue;
    if (family == PartialBy::state || family == PartialBy::state_rate) {
      if (const std::int32_t z = points_.unknown_of_state(column); z >= 0) entries.push_back({kind, row, z, value});
      continue;
    }
    points_.by_centres(column, [&](std::int32_t c, double along) { entries.push_back({kind, row, c, along * value}); });
  }
}

void Contributions::take(const std::vector<std::size_t>& pieces, std::vector<MatrixEntry>& entries) const {
  const std::int32_t n = points_.coordinates();
  const ElementTrace& trace = at_.trace();
  std::map<std::int32_t, MotionForm> rows;
  std::map<std::int32_t, Vector> forces;  // on bodies, as they stand in the balance
  for (const std::size_t e : pieces) {
    for (std::size_t k = trace.elements[e].first_partial; k < trace.end_of_partials(e); ++k) {
      const ElementTrace::Partial& p = trace.partials[k];
      // What has no derivative stands in nothing that counts: the linear model was refused else.
      if (p.row < n && std::isfinite(p.value)) forms_.add(p.family, p.column, p.value, rows[p.row]);
    }
    for (std::size_t k = trace.elements[e].first_load; k < trace.end_of_loads(e); ++k) {
      const ElementTrace::Load& l = trace.loads[k];
      const BodyId b = points_.body_of(l.row);
      if (!b.valid() || !system_.layout().body(b).turns()) continue;
      const std::int32_t component = l.row - system_.layout().body(b).offset;
      if (component < 3) forces[b.index][static_cast<std::size_t>(component)] += l.value;
    }
  }
  for (const auto& [row, form] : rows) {
    points_.by_centres(row, [&, &of_row = form](std::int32_t r, double along) { add(of_row, r, along, entries); });
  }
  for (const auto& [b, force] : forces) {
    const Matrix3 turn = -(skew(force) * skew(points_.arm({b})));
    const std::int32_t first = system_.layout().body({b}).offset + 3;
    for (std::int32_t c = 0; c < 3; ++c) {
      for (std::int32_t r = 0; r < 3; ++r) {
        const double value = turn(static_cast<std::size_t>(r), static_cast<std::size_t>(c));
        if (value != 0.0) entries.push_back({MatrixKind::K, first + r, first + c, value});
      }
    }
  }
}

std::vector<Contribution> Contributions::of_elements() const {
  std::unordered_map<const ElementLabel*, Contribution::Of> bodies;
  std::unordered_set<const ElementLabel*> constraints;
  const auto& blocks = system_.layout().bodies;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const bool changes = points_.changes_shape({static_cast<std::int32_t>(b)});
    bodies[&blocks[b].label] = changes ? Contribution::Of::changing_body : Contribution::Of::rigid_body;
  }
  for (const ConstraintRow& r : system_.layout().rows) constraints.insert(r.owner);
  // One element may have several places in the trace: its forces, its reactions.
  std::vector<std::pair<const ElementLabel*, std::vector<std::size_t>>> elements;
  std::unordered_map<const ElementLabel*, std::size_t> known;
  for (std::size_t e = 0; e < at_.trace().elements.size(); ++e) {
    const ElementLabel* of = at_.trace().elements[e].of;
    if (!of) continue;
    const auto [place, is_new] = known.emplace(of, elements.size());
    if (is_new) elements.emplace_back(of, std::vector<std::size_t>{});
    elements[place->second].second.push_back(e);
  }
  std::vector<Contribution> list;
  for (const auto& [of, pieces] : elements) {
    Contribution c{of, Contribution::Of::force, {}};
    if (const auto body = bodies.find(of); body != bodies.end())
      c.of = body->second;
    else if (constraints.contains(of))
      c.of = Contribution::Of::constraint;
    take(pieces, c.entries);
    add_up(c.entries);
    const bool exerts = c.of == Contribution::Of::force;  // one without partials may be wanted all the same
    if (!c.entries.empty() || exerts) list.push_back(std::move(c));
  }
  return list;
}

std::vector<MatrixEntry> Contributions::of_states() const {
  std::vector<MatrixEntry> entries;
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(system_.layout().states.size()); ++k) {
    const std::int32_t row = points_.unknown_of_state(k);
    if (row >= 0) add(forms_.row(system_, at_.equations.state_row(k)), row, 1, entries);
  }
  add_up(entries);
  return entries;
}

}  // namespace dynalin::nastran
