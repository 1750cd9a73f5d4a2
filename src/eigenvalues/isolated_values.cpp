#include "eigenvalues/isolated_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "eigenvalues/index.h"
#include "eigenvalues/rounding.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

constexpr double least_relative_width = 1e-11;  // of a group: closer inspection may tell wider ones apart

class Discs {
 public:
  Discs(const EigenPairs& pairs, const EigenResiduals& residuals) : pairs_(pairs), residuals_(residuals) {
    const Index count = residuals.count();
    centre_.resize(count), diagonal_.resize(count);
    for (Index i = 0; i < count; ++i) {
      const Complex correction = residuals.g({i, false}, {i, false});
      centre_(i) = value(pairs, {i, false}) + correction;
      // Of a real eigenvalue what is not real in G_ii is rounding of its sum.
      const double off = pairs.real(i) ? std::abs(correction.imag()) : 0;
      if (pairs.real(i)) centre_(i).imag(0);
      diagonal_(i) = residuals.floor(i) + off + eps * std::abs(centre_(i));
    }
    // Parts x_l of an eigenvector are measured against 1/c_l, c_l the largest coupling from l: so stiff and soft ones
    // can stand beside each other.
    column_ = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::min());
    for (Index i = 0; i < count; ++i) {
      column_(i) = std::max(column_(i), residuals.floor(i));
      residuals.for_others(i, [&](const Member& j) { column_(j.at) = std::max(column_(j.at), size(i, j)); });
    }
    row_.resize(count);
    for (Index i = 0; i < count; ++i) {
      double sum = diagonal(i) / column_(i);
      residuals.for_others(i, [&](const Member& j) { sum += size(i, j) / column_(j.at); });
      row_(i) = sum;
    }
  }

  IsolatedValues run() {
    const Index count = residuals_.count();
    find_groups();
    for (Index i = 0; i < count; ++i) {
      if (group_[at(i)] == i) find_disc(i);
    }
    IsolatedValues out;
    out.all = true;
    for (Index i = 0; i < count; ++i) {
      if (group_[at(i)] != i) continue;
      for (Index j = 0; j < count; ++j) {
        if (group_[at(j)] == j && meet(i, j)) proven_[at(i)] = false;
      }
      const Disc& disc = disc_[at(i)];
      const bool narrow = disc.members.size() == 1 || disc.radius <= least_relative_width * std::abs(disc.centre);
      out.all = out.all && proven_[at(i)] && narrow;
    }
    if (std::find(proven_.begin(), proven_.end(), false) != proven_.end()) {
      // Discs and Gershgorin's side by side must count the same eigenvalues.
      for (Index i = 0; i < count; ++i) proven_[at(i)] = proven_[at(i)] && inside_gershgorin(i);
      join_discs();
    }
    for (Index i = 0; i < count; ++i) {
      const Disc& disc = disc_[at(group_[at(i)])];
      double bound = proven_[at(group_[at(i)])] ? disc.radius + std::abs(centre_(i) - disc.centre) : of_component(i);
      if (!pairs_.real(i) && !(centre_(i).imag() > 0)) bound = infinity;
      bound += 2 * residuals_.zero_coupling(i) + 2 * eps * std::abs(centre_(i));
      const bool known = std::isfinite(bound);
      out.all = out.all && known;
      out.values.push_back(known ? centre_(i) : value(pairs_, {i, false}));
      out.trust.push_back({known ? bound : infinity, residuals_.unknown(i), false, 1});
    }
    return out;
  }

 private:
  double size(Index i, const Member& j) const {
    return std::abs(residuals_.g({i, false}, j)) + residuals_.floor(i, j.at);
  }
  double diagonal(Index i) const { return diagonal_(i); }
  Complex member_centre(const Member& j) const { return j.conjugate ? std::conj(centre_(j.at)) : centre_(j.at); }
  double gap(Index i, const Member& j) const { return std::abs(centre_(i) - member_centre(j)) / upward; }

  // Without the second order: parts scaled by 1/c.
  double gershgorin(Index i) const { return column_(i) * row_(i) * upward * upward; }
  // Connected components of these discs hold as many eigenvalues as there are discs in them.
  void join_discs() {
    const Index count = residuals_.count();
    component_.resize(at(count)), closed_.assign(at(count), false);
    std::iota(component_.begin(), component_.end(), Index{0});
    for (Index i = 0; i < count; ++i) {
      residuals_.for_others(i, [&](const Member& j) {
        if (gap(i, j) > (gershgorin(i) + gershgorin(j.at)) * upward) return;
        const Index a = root(i), b = root(j.at);
        component_[at(std::max(a, b))] = std::min(a, b);
        if (j.conjugate) closed_[at(i)] = true;
      });
    }
    for (Index i = 0; i < count; ++i) {
      if (closed_[at(i)]) closed_[at(root(i))] = true;
    }
  }
  Index root(Index i) const {
    while (component_[at(i)] != i) i = component_[at(i)];
    return i;
  }
  double of_component(Index i) const {
    const Index component = root(i);
    double bound = gershgorin(i);
    residuals_.for_others(i, [&](const Member& j) {
      if (root(j.at) != component || (j.conjugate && !closed_[at(component)])) return;
      bound = std::max(bound, gap(i, j) * (upward * upward) + gershgorin(j.at));
    });
    return bound;
  }

  // Of eigenvalues that rounding mixes, as equal ones of equal parts of a model: Λ is as good as any normal matrix
  // there.
  struct Disc {
    std::vector<Index> members;
    Complex centre = 0;
    double spread = 0, radius = infinity;
  };
  void find_groups() {
    const Index count = residuals_.count();
    group_.resize(at(count)), disc_.resize(at(count)), proven_.assign(at(count), true);
    std::iota(group_.begin(), group_.end(), Index{0});
    for (Index i = 0; i < count; ++i) {
      for (Index j = 0; j < i; ++j) {
        const Member other{j, false};
        // The mean of both couplings, whatever the units that make one large and the other small.
        const double mixing = 2 * std::sqrt(size(i, other) * size(j, {i, false})) + diagonal(i) + diagonal(j);
        if (pairs_.real(i) != pairs_.real(j) || gap(i, other) > 4 * mixing) continue;
        const Index from = group_[at(i)], to = group_[at(j)];
        for (Index& g : group_) {
          if (g == std::max(from, to)) g = std::min(from, to);
        }
      }
    }
    for (Index i = 0; i < count; ++i) disc_[at(group_[at(i)])].members.push_back(i);
  }
  void find_disc(Index group) {
    Disc& disc = disc_[at(group)];
    for (const Index a : disc.members) disc.centre += centre_(a) / static_cast<double>(disc.members.size());
    for (const Index a : disc.members) disc.spread = std::max(disc.spread, std::abs(centre_(a) - disc.centre));
    double radius = disc.spread + diagonal(group);
    for (int round = 0; round < 8; ++round) {
      const double r = needed(group, radius);
      if (r <= radius) disc.radius = r;
      if (r <= radius || !std::isfinite(r)) break;
      radius = 1.1 * r;
    }
    // No eigenvalue of Λ + tE is between this radius and the one it was found for: inside are as many as there are
    // members.
    const bool upper = pairs_.real(group) || disc.centre.imag() > disc.radius;
    proven_[at(group)] = std::isfinite(disc.radius) && upper;
  }
  bool inside_gershgorin(Index group) const {
    const Disc& disc = disc_[at(group)];
    return std::any_of(disc.members.begin(), disc.members.end(),
                       [&](Index a) { return std::abs(centre_(a) - disc.centre) + disc.radius <= gershgorin(a); });
  }
  // Whether a disc meets another, or the mirror image of one.
  bool meet(Index i, Index j) const {
    const Disc &one = disc_[at(i)], &other = disc_[at(j)];
    if (!std::isfinite(one.radius) || !std::isfinite(other.radius)) return false;
    const double reach = (one.radius + other.radius) * upward;
    if (i != j && std::abs(one.centre - other.centre) <= reach) return true;
    return !pairs_.real(j) && std::abs(one.centre - std::conj(other.centre)) <= reach;
  }

  // What the disc of a group, of at most `radius`, must have as radius; infinity if that cannot be said.
  double needed(Index group, double radius) const {
    const Disc& disc = disc_[at(group)];
    double own = 0, mixed = 0;
    for (const Index a : disc.members) {
      own = std::max(own, diagonal(a));
      for (const Index b : disc.members) {
        if (a != b) mixed = std::hypot(mixed, size(a, {b, false}));
      }
    }
    own += mixed;
    double most = 0, largest = 0, second = 0, coupling = 0;
    bool apart = true;
    const auto add = [&](const Member& j) {
      const double distance = std::abs(disc.centre - member_centre(j)) / upward - radius;
      apart = apart && distance > 0;
      if (!apart) return;
      double from = 0, onto = 0;
      for (const Index a : disc.members) {
        const double column = std::abs(residuals_.g(j, {a, false})) + residuals_.floor(j.at, a), row = size(a, j);
        from = disc.members.size() == 1 ? column : std::hypot(from, column);
        onto = disc.members.size() == 1 ? row : std::hypot(onto, row);
      }
      const double feed = row_(j.at) / distance;
      most = std::max(most, column_(j.at) * feed);
      largest = std::max(largest, column_(j.at) * from / distance);
      second += onto * from / distance;
      coupling += onto * feed;
    };
    for (Index j = 0; j < residuals_.count() && apart; ++j) {
      if (group_[at(j)] != group) add({j, false});
      if (!pairs_.real(j)) add({j, true});
    }
    if (!apart || !(most <= 0.5)) return infinity;
    const double r = disc.spread + (own + second + coupling * largest / (1 - most)) * upward;
    return std::isfinite(r) ? r : infinity;
  }

  const EigenPairs& pairs_;
  const EigenResiduals& residuals_;
  Eigen::VectorXcd centre_;
  Eigen::VectorXd diagonal_, column_, row_;
  std::vector<Index> group_;  // the first of those that it is mixed with
  std::vector<Disc> disc_;    // of each group, at its first
  std::vector<bool> proven_;
  std::vector<Index> component_;
  std::vector<bool> closed_;  // with the conjugate of each of its members
};

}  // namespace

std::optional<IsolatedValues> isolated_values(const EigenPairs& pairs, const EigenResiduals& residuals) {
  if (!residuals.complete()) return std::nullopt;
  return Discs(pairs, residuals).run();
}

}  // namespace dynalin
