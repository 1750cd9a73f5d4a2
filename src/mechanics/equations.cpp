#include "mechanics/equations.h"

#include <algorithm>

namespace dynalin {

namespace {

std::array<double, 6> six(double factor, const Vector& f, const Vector& m) {
  return {factor * f.x, factor * f.y, factor * f.z, factor * m.x, factor * m.y, factor * m.z};
}

}  // namespace

void ConstraintRows::resize(const Layout& layout, std::size_t count) {
  layout_ = &layout;
  value_.assign(count, Taylor());
  rows_.assign(count, {});
}

ConstraintRows::Entry& ConstraintRows::entry(std::int32_t row, std::int32_t column) {
  auto& entries = rows_[static_cast<std::size_t>(row)];
  // The first touch of a row in a pass clears it; its places stay, so nothing is allocated again.
  if (row != scratch_row_) {
    for (Entry& e : entries) e = {.column = e.column};
    scratch_row_ = row;
  }
  for (Entry& e : entries) {
    if (e.column == column) return e;
  }
  constexpr std::size_t of_two_bodies = 12;  // what nearly all rows have, without room that nothing takes
  if (entries.empty()) entries.reserve(of_two_bodies);
  return entries.emplace_back(Entry{.column = column});
}

void ConstraintRows::settle() {
  const auto is_empty = [](const Entry& e) {
    return e.size_of_g == 0 && e.c.g == 0 && e.c.v == 0 && e.c.a1 == 0 && e.c.a0 == 0;
  };
  for (std::vector<Entry>& entries : rows_) {
    std::erase_if(entries, is_empty);
    entries.shrink_to_fit();
  }
}

void ConstraintRows::add_pose(std::int32_t row, BodyId body, const Vec3<Taylor>& on_r, const Vec3<Taylor>& on_theta) {
  const BodyBlock& block = layout_->body(body);
  for (std::int32_t k = 0; k < block.count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    accumulate(entry(row, block.offset + k), k < 3 ? on_r[i] : on_theta[i - 3]);
  }
}

void Equations::resize(const Layout& layout) {
  layout_ = &layout;
  const auto n = layout.coordinate_count;
  const auto m = static_cast<std::int32_t>(layout.rows.size());
  const auto w = static_cast<std::int32_t>(layout.algebraic.size());
  const auto z = static_cast<std::int32_t>(layout.states.size());
  residual_.assign(static_cast<std::size_t>(n + w + z), 0.0);
  magnitude_ = residual_;
  const std::array<std::int32_t, column_families> columns = {n, n, n, n, m, w, z, z};
  for (std::size_t k = 0; k < column_families; ++k) matrices_[k].resize(n + w + z, columns[k]);
}

void Equations::keep_sizes() {
  keeps_sizes_ = true;
  for (Accumulator& a : matrices_) a.keep_sizes();
}

std::vector<Equations::Undefined> Equations::clear_undefined() {
  std::vector<Undefined> found;
  for (std::size_t f = 0; f < column_families; ++f) {
    const auto family = static_cast<PartialBy>(f);
    if (!wants(family)) continue;
    matrices_[f].clear_undefined([&](std::int32_t row, std::int32_t column) {
      found.push_back({family, row, column});
    });
  }
  return found;
}

void Equations::begin(std::initializer_list<PartialBy> wanted) {
  std::fill(residual_.begin(), residual_.end(), 0.0);
  std::fill(magnitude_.begin(), magnitude_.end(), 0.0);
  wanted_.fill(false);
  wants_any_ = wanted.size() > 0;
  recording_ = false;
  if (trace_) trace_->clear();
  for (const PartialBy c : wanted) {
    const auto k = static_cast<std::size_t>(c);
    wanted_[k] = true;
    recording_ = recording_ || !matrices_[k].recorded();
    matrices_[k].begin();
  }
}

void Equations::note(PartialBy family, std::int32_t row, std::int32_t column, std::span<const double> values) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k] == 0.0) continue;
    trace_->partials.push_back({family, row + static_cast<std::int32_t>(k), column, values[k], trace_->term});
  }
}

void Equations::become_share_of(const Equations& whole, Share share) {
  layout_ = whole.layout_, wanted_ = whole.wanted_, wants_any_ = whole.wants_any_;
  keeps_sizes_ = whole.keeps_sizes_;
  share_ = share, keeps_ = true;
  kept_.clear();
}

void Equations::take(const Contributions& c) {
  for (const auto& r : c.residuals) add_residual(r.row, r.value, r.size);
  std::size_t at = 0;
  for (const auto& run : c.runs) {
    const auto all = std::span(c.values).subspan(at, run.count + run.sizes);
    add(run.family, run.row, run.column, all.first(run.count), all.last(run.sizes));
    at += all.size();
  }
}

void Equations::finish() {
  for (std::size_t k = 0; k < column_families; ++k) {
    if (wanted_[k]) matrices_[k].finish();
  }
}

void Equations::settle() {
  std::vector<Equations>().swap(desks_);
  for (Accumulator& a : matrices_) a.settle();
}

void Equations::apply_inertia(BodyId body, const Vector& force, const Vector& moment, const Cancelled& cancelled) {
  const BodyBlock& block = layout_->body(body);
  if (block.count == 0) return;
  for (std::int32_t k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    add_residual(block.offset + k, force[at], std::abs(force[at]) + cancelled.force);
    if (block.turns()) add_residual(block.offset + 3 + k, moment[at], std::abs(moment[at]) + cancelled.moment);
  }
}

void Equations::apply_at(BodyId body, const Vector& arm, const Vector& force, const Vector& torque, double cancelled) {
  const BodyBlock& block = layout_->body(body);
  if (block.count == 0) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto row = block.offset + static_cast<std::int32_t>(k);
    add_residual(row, -force[k]);
    if (!block.turns()) continue;
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    const double one = arm[next] * force[last], other = arm[last] * force[next];
    add_residual(row + 3, -(one - other + torque[k]),
                 std::abs(one) + std::abs(other) + std::max(std::abs(torque[k]), cancelled));
  }
}

void Equations::add_block(PartialBy family, BodyId on, Columns columns, const Block& partials, double factor) {
  for (std::size_t k = 0; k < columns.count; ++k) {
    add_column(family, on, columns.first + static_cast<std::int32_t>(k), partials.force[k], partials.moment[k], factor);
  }
}

void Equations::add_block(PartialBy family, BodyId on, Columns columns, const Block& partials, const Block& sizes,
                          double factor) {
  const BodyBlock& block = layout_->body(on);
  if (block.count == 0 || !wants(family)) return;
  const auto rows = static_cast<std::size_t>(block.count);
  for (std::size_t k = 0; k < columns.count; ++k) {
    const auto values = six(factor, partials.force[k], partials.moment[k]),
               of = six(factor, sizes.force[k], sizes.moment[k]);
    add(family, block.offset, columns.first + static_cast<std::int32_t>(k), std::span(values).first(rows),
        std::span(of).first(rows));
  }
}

void Equations::add_column(PartialBy family, BodyId on, std::int32_t column, const Vector& force, const Vector& moment,
                           double factor) {
  const BodyBlock& block = layout_->body(on);
  if (block.count == 0 || !wants(family)) return;
  const std::array<double, 6> values = six(factor, force, moment);
  add(family, block.offset, column, std::span(values).first(static_cast<std::size_t>(block.count)));
}

}  // namespace dynalin
