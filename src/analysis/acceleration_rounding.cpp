#include "analysis/acceleration_rounding.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "analysis/displace.h"
#include "analysis/row_sizes.h"
#include "system/elimination.h"

namespace dynalin {

namespace {

constexpr int samples = 3;
// In units of the last place: far enough that what comes of it is no rounding itself.
constexpr double units = 64;
// A sample is seldom the worst case.
constexpr double margin = 8;

// Where rows leave shapes no choice, when bodies have followed them as they can, modal coordinates are as exact as
// these rows are met: in units of the last place, what such roundings make of them.
void add_determined_shapes(const System& system, const OperatingPoint& op, std::vector<double>& size) {
  const Layout& layout = system.layout();
  const std::int32_t n = layout.coordinate_count;
  std::vector<bool> is_shape(static_cast<std::size_t>(n), false);
  for (const ExtraBlock& e : layout.extras) {
    if (e.is_shape()) std::fill_n(is_shape.begin() + e.offset, e.count, true);
  }
  std::vector<std::int32_t> order(static_cast<std::size_t>(n));  // of columns, shapes last
  std::iota(order.begin(), order.end(), 0);
  const auto shapes = std::stable_partition(order.begin(), order.end(),
                                            [&](std::int32_t k) { return !is_shape[static_cast<std::size_t>(k)]; });
  // What has stayed as it is drawn is exact.
  const auto moved = [&](std::int32_t k) { return op.extra[layout.extra_index(k)] != 0; };
  if (std::none_of(shapes, order.end(), moved)) return;
  ConstraintRows rows;
  rows.resize(layout);
  system.constraints(system.motion(op), rows);
  std::vector<SparseRow> scaled(static_cast<std::size_t>(rows.size()));
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (rows.level(k) == RowLevel::position) scaled[static_cast<std::size_t>(k)] = scaled_row(system, rows.row(k));
  }
  // Bodies come first, also in rows that shapes change more.
  const Elimination e = eliminate(scaled, n, order, {.pivot_threshold = 1e-6});
  const auto determined = [&](std::int32_t k) { return e.dependent[static_cast<std::size_t>(k)]; };
  if (std::none_of(shapes, order.end(), determined)) return;
  // ⎡ W Gᵀ ⎤, the least change: bodies all but free to move.
  // ⎣ G 0  ⎦
  constexpr double of_bodies = 1e-8;
  std::vector<Triplet> entries;
  Eigen::MatrixXd answers = Eigen::MatrixXd::Zero(n + rows.size(), samples);
  std::minstd_rand random(1);
  for (std::int32_t k = 0; k < n; ++k) entries.push_back({k, k, is_shape[static_cast<std::size_t>(k)] ? 1 : of_bodies});
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    const std::int32_t at = n + k;
    if (e.pivot_column[static_cast<std::size_t>(k)] < 0) {
      entries.push_back({at, at, 1.0});
      continue;
    }
    const SparseRow& row = scaled[static_cast<std::size_t>(k)];
    double terms = 0;
    for (std::size_t j = 0; j < row.column.size(); ++j) {
      const std::int32_t c = row.column[j];
      terms += std::abs(row.value[j]) * size[static_cast<std::size_t>(c)] / system.coordinate_scale(c);
      entries.push_back({at, c, row.value[j]});
      entries.push_back({c, at, row.value[j]});
    }
    for (int sample = 0; sample < samples; ++sample)
      answers(at, sample) = terms * std::uniform_real_distribution<double>(-1, 1)(random);
  }
  SparseLu lu;
  if (!lu.factor(compressed(n + rows.size(), n + rows.size(), entries))) return;
  lu.solve(answers);
  std::for_each(shapes, order.end(), [&](std::int32_t k) {
    double& own = size[static_cast<std::size_t>(k)];
    if (moved(k)) own = std::max(own, system.coordinate_scale(k) * answers.row(k).cwiseAbs().maxCoeff());
  });
}

std::vector<double> sizes_of_point(const System& system, const OperatingPoint& op) {
  std::vector<double> size = coordinate_sizes(system.layout(), op);
  add_determined_shapes(system, op, size);
  return size;
}

}  // namespace

Shake shake(const Layout& layout, const OperatingPoint& op, const std::vector<double>& size, double places,
            std::minstd_rand& random) {
  const double amplitude = places * std::numeric_limits<double>::epsilon();
  const auto draw = [&] { return amplitude * std::uniform_real_distribution<double>(-1, 1)(random); };
  const auto speed = [&](std::size_t k) {
    if (static_cast<std::int32_t>(k) >= layout.body_coordinate_count) return std::abs(op.velocity[k]);
    const auto* v = &op.velocity[k - k % 3];
    return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  };
  Shake s{Eigen::VectorXd::Zero(layout.coordinate_count), Eigen::VectorXd::Zero(layout.coordinate_count)};
  for (std::size_t k = 0; k < size.size(); ++k) {
    s.step(static_cast<Eigen::Index>(k)) = draw() * size[k];
    s.velocity(static_cast<Eigen::Index>(k)) = draw() * speed(k);
  }
  return s;
}

OperatingPoint shaken(const System& system, OperatingPoint op, const Shake& s, double direction) {
  displace(system, op, direction * s.step, {1.0});
  for (std::size_t k = 0; k < op.velocity.size(); ++k) {
    op.velocity[k] += direction * s.velocity(static_cast<Eigen::Index>(k));
  }
  return op;
}

Eigen::VectorXd rounding_of_accelerations(const System& system, const SparseLu& lu, const OperatingPoint& op,
                                          const MissingForces& missing) {
  const Layout& layout = system.layout();
  const std::vector<double> size = sizes_of_point(system, op);
  const Eigen::VectorXd here = missing(op);
  Eigen::MatrixXd answers(here.size(), 2 * samples);  // both ways, side by side
  std::minstd_rand random(1);
  for (int sample = 0; sample < samples; ++sample) {
    const Shake s = shake(layout, op, size, units, random);
    for (const int way : {0, 1}) {
      auto answer = answers.col(2 * sample + way);
      answer = missing(shaken(system, op, s, way == 0 ? 1 : -1)) - here;
      if (!answer.allFinite()) answer.setZero();
    }
  }
  lu.solve(answers);
  Eigen::VectorXd worst = Eigen::VectorXd::Zero(here.size());
  for (int sample = 0; sample < samples; ++sample) {
    worst = worst.cwiseMax(answers.col(2 * sample).cwiseAbs().cwiseMin(answers.col(2 * sample + 1).cwiseAbs()));
  }
  for (const BodyBlock& block : layout.bodies) {
    for (std::int32_t k = 0; k < block.count; k += 3) {
      worst.segment<3>(block.offset + k).setConstant(worst.segment<3>(block.offset + k).maxCoeff());
    }
  }
  return margin / units * worst;
}

Eigen::VectorXd missing_beside(const System& system, const OperatingPoint& op, const MissingForces& missing) {
  std::minstd_rand random(1);
  return missing(shaken(system, op, shake(system.layout(), op, sizes_of_point(system, op), units, random), 1));
}

double rounding_of_answer() { return margin / units; }

Eigen::VectorXd rounding_of_solution(const SparseLu& lu, const Eigen::VectorXd& terms) {
  Eigen::MatrixXd answers(terms.size(), samples);
  std::minstd_rand random(1);
  for (Eigen::Index k = 0; k < answers.size(); ++k) {
    answers(k) = terms(k % terms.size()) * std::uniform_real_distribution<double>(-1, 1)(random);
  }
  lu.solve(answers);
  return margin * std::numeric_limits<double>::epsilon() * answers.cwiseAbs().rowwise().maxCoeff();
}

}  // namespace dynalin
