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

// Rows of z that hang together, and which of these sets the columns of A leave alone.
class Sets {
 public:
  Sets(const ColumnMatrix& A, const Eigen::VectorXd& z, const Layout& layout) : sets_(index(A.rows)) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(A.columns), terms = sum;
    std::vector<std::int32_t> reader(index(A.columns), -1);
    for_each_entry(A, [&](std::int32_t r, std::int32_t c, double v) {
      if (z(r) == 0 || v == 0) return;
      sum(c) += z(r) * v;
      terms(c) += std::abs(z(r) * v);
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
  double work = 0;
  Eigen::Vector3d way = Eigen::Vector3d::Zero(), turn = way;  // sums over the parts,
  double ways = 0, turns = 0;                                 // and over what each of their components is
  std::vector<std::size_t> bodies;

  std::optional<UnheldMotion> load(const StaticEquations& equations) const {
    const double length = equations.system().length(), count = static_cast<double>(bodies.size());
    const bool turning = turns * length > least_turn * ways;
    const Eigen::Vector3d along = (turning ? turn : way) / count;
    if (!(along.norm() * count > in_common * (turning ? turns : ways))) return std::nullopt;
    const Eigen::Vector3d f = work / along.squaredNorm() * along;
    if (!(f.norm() / (turning ? length : 1.0) > force_balance * equations.force_scale())) return std::nullopt;
    return UnheldMotion{bodies, turning, {f(0), f(1), f(2)}};
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
  for (double& v : z) {
    if (std::abs(v) < negligible * size) v = 0;
  }
  const Layout& layout = equations.system().layout();
  Sets sets(A, z, layout);
  std::map<std::size_t, Driven> motions;
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    for (std::int32_t k = 0; k < block.count; ++k) {
      const std::int32_t at = block.offset + k;
      const auto set = z(at) != 0 ? sets.unopposed(at) : std::nullopt;
      if (!set) continue;
      Driven& m = motions[*set];
      const double y = z(at) * scales.row(at);
      (k < 3 ? m.way(k) : m.turn(k - 3)) += y;
      (k < 3 ? m.ways : m.turns) += std::abs(y);
      m.work -= y * r(at);
      if (m.bodies.empty() || m.bodies.back() != b) m.bodies.push_back(b);
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
