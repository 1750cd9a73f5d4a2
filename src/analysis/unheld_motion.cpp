#include "analysis/unheld_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "analysis/balance.h"
#include "analysis/comparable_scales.h"
#include "analysis/part_names.h"
#include "base/joined_sets.h"

namespace dynalin {

namespace {

constexpr double opposed = 1e-9;     // of the terms of a column, above which a motion is opposed
constexpr double negligible = 1e-7;  // of the largest, below which an equation takes no part
constexpr double tiny = 1e-15;       // holds what no equation reads
constexpr double balanced = 1e3;     // residuals in units of rounding
constexpr double least_left = 1e-6;  // of the forces, that no motion opposes
// Of a model's length by which a turn moves its points, against the way of the parts: what turns about an axis a
// thousand lengths away goes straight.
constexpr double least_turn = 1e-3;
// Of what parts move one by one, that they move together: those that go against each other have no common force.
constexpr double in_common = 1e-6;
constexpr double least_part = 1e-2;    // of the way of the part that moves most, of those that count as moving with it
constexpr double no_component = 1e-6;  // of a load

// z = ρ − A x with the least |z|, of A = R J C: what of ρ the columns of A cannot make.
//
//     ⎡ 1   A  ⎤ ⎡ z ⎤   ⎡ ρ ⎤
//     ⎣ Aᵀ  −ε ⎦ ⎣ x ⎦ = ⎣ 0 ⎦
Eigen::VectorXd beyond_columns(StaticEquations& equations, const ColumnMatrix& A, const Eigen::VectorXd& rho) {
  std::vector<Triplet> entries;
  const std::int32_t n = A.rows;
  for (std::int32_t k = 0; k < n; ++k) {
    entries.push_back({k, k, 1.0});
    entries.push_back({n + k, n + k, -tiny});
  }
  for_each_entry(A, [&](std::int32_t r, std::int32_t c, double v) {
    entries.push_back({r, n + c, v});
    entries.push_back({n + c, r, v});
  });
  SparseLu lu;
  if (!equations.factor(lu, compressed(2 * n, 2 * n, entries))) return Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(2 * n, 1);
  x.col(0).head(n) = rho;
  lu.solve(x);
  return x.col(0).head(n);
}

std::size_t index(std::int32_t k) { return static_cast<std::size_t>(k); }

// Rows of z that hang together, and which of these sets the columns of A leave alone. What takes no part, of `all`, is
// no zero: a stiff element makes something of it.
class Sets {
 public:
  Sets(const ColumnMatrix& A, const Eigen::VectorXd& z, const Eigen::VectorXd& all, const Layout& layout)
      : sets_(index(A.rows)) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(A.columns), terms = sum;
    std::vector<std::int32_t> reader(index(A.columns), -1);
    for_each_entry(A, [&](std::int32_t r, std::int32_t c, double v) {
      sum(c) += all(r) * v;
      terms(c) += std::abs(all(r) * v);
      if (z(r) == 0 || v == 0) return;
      std::int32_t& other = reader[index(c)];
      if (other < 0) other = r;
      sets_.join(index(r), index(other));
    });
    // One force on a part, not three components.
    for (const BodyBlock& b : layout.bodies) {
      std::int32_t first = -1;
      for (std::int32_t k = b.offset; k < b.offset + std::min(b.count, 3); ++k) {
        if (z(k) == 0) continue;
        if (first >= 0) sets_.join(index(k), index(first));
        first = k;
      }
    }
    const double size = z.cwiseAbs().maxCoeff();
    for (Eigen::Index c = 0; c < sum.size(); ++c) {
      const std::int32_t r = reader[static_cast<std::size_t>(c)];
      if (r >= 0 && std::abs(sum(c)) > opposed * std::max(terms(c), size)) is_opposed_.insert(sets_.of(index(r)));
    }
  }
  std::optional<std::size_t> unopposed(std::int32_t row) {
    const std::size_t set = sets_.of(index(row));
    return is_opposed_.contains(set) ? std::nullopt : std::optional(set);
  }

 private:
  JoinedSets sets_;
  std::set<std::size_t> is_opposed_;
};

// What moves along one set of rows, and the work that is done along it.
struct Driven {
  struct Part {
    Eigen::Vector3d way = Eigen::Vector3d::Zero(), turn = way;
  };
  double work = 0;
  std::map<std::size_t, Part> parts;

  std::optional<UnheldMotion> load(const StaticEquations& equations) const {
    const double length = equations.system().length();
    Part sum;
    double ways = 0, turns = 0, farthest = 0, most_turned = 0;  // sums over what each component is
    for (const auto& [b, p] : parts) {
      sum.way += p.way, sum.turn += p.turn;
      ways += p.way.lpNorm<1>(), turns += p.turn.lpNorm<1>();
      farthest = std::max(farthest, p.way.norm() + length * p.turn.norm());
      most_turned = std::max(most_turned, p.turn.norm());
    }
    const bool turning = turns * length > least_turn * ways;
    // Those that hardly move along do so at one point and not at another.
    UnheldMotion motion{{}, turning, {}};
    double count = 0;
    for (const auto& [b, p] : parts) {
      if (p.way.norm() + length * p.turn.norm() > least_part * farthest) motion.bodies.push_back(b);
      if (turning ? p.turn.norm() > least_part * most_turned : p.way.norm() > least_part * farthest) ++count;
    }
    const Eigen::Vector3d along = (turning ? sum.turn : sum.way) / count;
    if (!(along.norm() * count > in_common * (turning ? turns : ways))) return std::nullopt;
    const Eigen::Vector3d f = work / along.squaredNorm() * along;
    if (!(f.norm() / (turning ? length : 1.0) > force_balance * equations.force_scale())) return std::nullopt;
    motion.load = {f(0), f(1), f(2)};
    return motion;
  }
};

}  // namespace

std::vector<UnheldMotion> unheld_motions(StaticEquations& equations, const OperatingPoint& op) {
  equations.evaluate(op, Partials::yes);
  const Eigen::VectorXd& r = equations.residual();
  if (!r.allFinite()) return {};
  const ColumnMatrix J = equations.tangent(0, 0);
  const ComparableScales scales(J);
  const ColumnMatrix A = scales.of(J);
  Eigen::VectorXd rho = scales.row.cwiseProduct(r);
  // What is balanced within its rounding is balanced, and values are those of their functions.
  for (Eigen::Index k = 0; k < rho.size(); ++k) {
    if (k >= equations.augmented().lambda(0) || std::abs(r(k)) <= balanced * equations.rounding()(k)) rho(k) = 0;
  }
  if (rho.isZero(0)) return {};
  Eigen::VectorXd z = beyond_columns(equations, A, rho);
  const double size = z.cwiseAbs().maxCoeff();
  if (!z.allFinite() || !(size > least_left * rho.cwiseAbs().maxCoeff())) return {};
  const Eigen::VectorXd all = z;
  for (double& v : z) {
    if (std::abs(v) < negligible * size) v = 0;
  }
  const Layout& layout = equations.system().layout();
  Sets sets(A, z, all, layout);
  std::map<std::size_t, Driven> motions;
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    for (std::int32_t k = 0; k < block.count; ++k) {
      const std::int32_t at = block.offset + k;
      const auto set = z(at) != 0 ? sets.unopposed(at) : std::nullopt;
      if (!set) continue;
      Driven& m = motions[*set];
      const double y = z(at) * scales.row(at);
      Driven::Part& part = m.parts[b];
      (k < 3 ? part.way(k) : part.turn(k - 3)) += y;
      m.work -= y * r(at);
    }
  }
  std::vector<UnheldMotion> list;
  for (const auto& [set, m] : motions) {
    if (auto motion = m.load(equations)) list.push_back(std::move(*motion));
  }
  return list;
}

std::vector<std::string> unheld_everywhere(StaticEquations& equations, const std::vector<OperatingPoint>& points) {
  std::vector<UnheldMotion> first;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::vector<UnheldMotion> here = unheld_motions(equations, points[k]);
    if (k == 0) first = here;
    std::erase_if(first, [&](const UnheldMotion& m) {
      return std::none_of(here.begin(), here.end(), [&](const UnheldMotion& other) {
        return other.bodies == m.bodies && other.turning == m.turning;
      });
    });
    if (first.empty()) return {};
  }
  std::vector<std::string> sentences;
  for (UnheldMotion& m : first) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::abs(m.load[c]) < no_component * norm(m.load)) m.load[c] = 0;
    }
    sentences.push_back(fmt::format("nothing holds {} against the {} ({:.5g}, {:.5g}, {:.5g})",
                                    part_names(equations.system().layout(), m.bodies), m.turning ? "moment" : "force",
                                    m.load.x, m.load.y, m.load.z));
  }
  return sentences;
}

}  // namespace dynalin
