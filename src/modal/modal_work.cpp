// Rows of strain and dissipation: what forces work along a mode, and where that is nothing but rounding.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/cycle.h"
#include "modal/modal_distribution.h"
#include "modal/wrench_work.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;

// Relative size of what is left where motions cancel; zero modes come with a little more than the rounding of a number.
constexpr double rounding_of_motions = 1e-10;

}  // namespace

Eigen::VectorXd ModalDistribution::algebraic_size(const Eigen::VectorXcd& dq, PartialBy family) const {
  const auto n = static_cast<Eigen::Index>(system_.layout().coordinate_count);
  const auto w = static_cast<Eigen::Index>(system_.layout().algebraic.size());
  if (w == 0 || !algebraic_solved_) return Eigen::VectorXd::Zero(w);
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(eq_.size());
  const auto add_sizes = [&](PartialBy c) {
    auto size = eq_.sizes(c).begin();  // of what was added up to each partial, which may have cancelled
    for_each_entry(eq_.matrix(c),
                   [&](std::int32_t r, std::int32_t k, double) { rows(r) += *size++ * std::abs(dq(k)); });
  };
  add_sizes(family);
  if (family == PartialBy::damping) add_sizes(PartialBy::velocity);
  const Eigen::MatrixXd given = rows.segment(n, w);
  Eigen::MatrixXd solved = given;
  algebraic_.solve(solved);
  return solved.cwiseAbs().cwiseMax(given).col(0);
}

Eigen::VectorXcd ModalDistribution::algebraic_change(const Eigen::VectorXcd& dq, PartialBy family) const {
  const auto n = static_cast<Eigen::Index>(system_.layout().coordinate_count);
  const auto w = static_cast<Eigen::Index>(system_.layout().algebraic.size());
  Eigen::VectorXcd change = Eigen::VectorXcd::Zero(w);
  if (w == 0 || !algebraic_solved_) return change;
  for (const bool imaginary : {false, true}) {
    const Eigen::VectorXd x = imaginary ? Eigen::VectorXd(dq.imag()) : Eigen::VectorXd(dq.real());
    Eigen::VectorXd rows = Eigen::VectorXd::Zero(eq_.size());
    const auto subtract = [&](PartialBy c) {
      eq_.matrix(c).multiply_add({x.data(), static_cast<std::size_t>(x.size())},
                                 {rows.data(), static_cast<std::size_t>(rows.size())}, -1.0);
    };
    subtract(family);
    if (family == PartialBy::damping) subtract(PartialBy::velocity);  // algebraic DIFFs
    Eigen::MatrixXd right = rows.segment(n, w);
    algebraic_.solve(right);
    change += imaginary ? Complex(0, 1) * right.col(0) : Eigen::VectorXcd(right.col(0).cast<Complex>());
  }
  return change;
}

// Sets of elements that have rows, in the order of the tables: by the name of the statement.
std::vector<std::size_t> ModalDistribution::sets_with_rows() const {
  const auto& sets = system_.model().sets;
  std::vector<std::size_t> list;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (sets[s]->kind().energy_rows != Kind::EnergyRows::none && sets[s]->size() > 0 && sets[s]->active)
      list.push_back(s);
  }
  std::stable_sort(list.begin(), list.end(),
                   [&](std::size_t a, std::size_t b) { return sets[a]->kind().statement < sets[b]->kind().statement; });
  return list;
}

// Whether velocities are rounding_of_motions: where the eigenvalue may be zero, no more than its bound, or next to
// nothing of the fastest mode, makes of displacements, and in other proportions than these. Where the model moves they
// are more.
bool ModalDistribution::rests(std::size_t mode, const Eigen::VectorXcd& z, const Eigen::VectorXcd& velocities) const {
  constexpr double margin = 10, rounding_of_rates = 1e-14, proportional = 1e-3;
  const EigenMode& of = solution_.modes[mode];
  if (of.structural_zero || !(std::abs(of.eigenvalue_hz) <= of.error_bound_hz)) return false;
  const Eigen::VectorXcd u = displacements(z);
  const auto largest = [](const Eigen::VectorXcd& x) { return x.cwiseAbs().maxCoeff(); };
  double fastest = 0;
  for (const EigenMode& m : solution_.modes) fastest = std::max(fastest, std::abs(m.eigenvalue_hz));
  const double rate = cycle * std::max(margin * of.error_bound_hz, rounding_of_rates * fastest);
  return largest(velocities) <= rate * largest(u) &&
         largest(velocities - cycle * of.eigenvalue_hz * u) > proportional * largest(velocities);
}

// Coordinates as large as vectors of this size are unclear: each may be this much or nothing.
Eigen::VectorXcd ModalDistribution::unclear_motion(const Eigen::VectorXcd& u) const {
  constexpr double unclear = 1e-13;
  double size = 0;
  const auto scale = [&](Eigen::Index k) { return system_.coordinate_scale(static_cast<std::int32_t>(k)); };
  const auto coordinates = static_cast<Eigen::Index>(system_.coordinates());
  for (Eigen::Index k = 0; k < coordinates; ++k) size = std::max(size, std::abs(u(k)) / scale(k));
  Eigen::VectorXcd motion = unclear * u.cwiseAbs().cast<Complex>();
  for (Eigen::Index k = 0; k < coordinates; ++k) motion(k) = unclear * size * scale(k);
  return motion;
}

std::vector<ModalRow<double>> ModalDistribution::force_rows(std::size_t mode, PartialBy family) const {
  const bool strain = family == PartialBy::position;
  const Eigen::VectorXcd z = scaled_vector(mode);
  const Eigen::VectorXcd u = strain ? displacements(z) : velocities(z);
  const WrenchWork work(system_.layout(), family, u, algebraic_change(u, family), algebraic_size(u, family));
  // What dampers do where nothing but the rounding_of_motions of vectors moves them, is nothing: a power goes by their
  // square.
  const Eigen::VectorXcd unclear = strain ? u : unclear_motion(u);
  const WrenchWork of_rounding(system_.layout(), family, unclear, algebraic_change(unclear, family),
                               algebraic_size(unclear, family));
  std::vector<ModalRow<double>> rows;
  double total = 0, parts = 0, of_elements = 0;
  double without_cancellation = 0;  // what the energy would be if no motions cancelled
  double of_unclear = 0;
  double distance = 1;  // of the bodies from the origin, in lengths of the model
  for (const BodyMotion& b : motion_.bodies) distance = std::max(distance, norm(b.r) / system_.length());
  MarkerWrench w;
  for (const std::size_t s : sets_with_rows()) {
    const ElementSet& set = *system_.model().sets[s];
    const Signals::Element first = system_.signals().element(ElementHandle{static_cast<std::int32_t>(s), 0});
    const WrenchSource& wrenches = *first.kernel->wrenches();
    for (std::size_t which = 0; which < wrenches.wrench_count(set.size()); ++which) {
      w.clear();
      wrenches.wrench(motion_, which, Partials::yes, w);
      const WrenchWork::Done done = work.of(w);
      without_cancellation += done.without_cancellation;
      if (!strain) of_unclear += of_rounding.of(w).without_cancellation;
      ModalRow<double> row{&set.labels[wrenches.element_of_wrench(which)], 0, std::vector<double>(7, 0.0)};
      if (set.kind().energy_rows == Kind::EnergyRows::each_marker)
        row.part = system_.model().marker(wrenches.marker_I(which)).label->id;
      for (std::size_t k = 0; k < 6; ++k) {
        row.values[0] += done.along[k];
        parts += std::abs(done.along[k]);
        const bool shown = w.force.components != (k < 3 ? Components::torque : Components::force);
        row.values[1 + k] = shown ? done.along[k] : std::numeric_limits<double>::quiet_NaN();
      }
      // Others share out what they do without it.
      for (double& x : row.values) {
        if (std::abs(x) <= distance * done.rounding) x = 0;
      }
      total += row.values[0];
      of_elements += std::abs(row.values[0]);
      rows.push_back(std::move(row));
    }
  }
  if (auto of_bodies = rows_of_bodies(u, family); !of_bodies.empty()) {
    for (const ModalRow<double>& row : of_bodies) {
      total += row.values[0];
      parts += std::abs(row.values[0]);
      of_elements += std::abs(row.values[0]);
      without_cancellation += std::abs(row.values[0]);
    }
    rows.insert(rows.end(), of_bodies.begin(), of_bodies.end());
    std::ranges::stable_sort(rows, {}, [](const ModalRow<double>& r) { return r.element->statement; });
  }
  // No share of nothing: motions of rigid bodies leave roundings in every element. A spring that is slack but for the
  // rounding_of_motions of its own force, which is that of the places it joins, does work in a turn of the model.
  const double least =
      strain ? 64 * std::numeric_limits<double>::epsilon() * distance : rounding_of_motions * rounding_of_motions;
  const bool nothing = (!strain && (rests(mode, z, u) || parts <= of_unclear)) ||
                       parts <= least * without_cancellation || of_elements <= rounding_of_motions * parts;
  // Where elements do something and all of them together nothing, there are no shares of it.
  const bool cancelling = std::abs(total) <= rounding_of_motions * of_elements;
  const double whole = cancelling ? std::numeric_limits<double>::quiet_NaN() : total;
  for (auto& row : rows) {
    for (double& x : row.values) x = nothing ? x * 0 : 100 * x / whole;
  }
  return rows;
}

}  // namespace dynalin
