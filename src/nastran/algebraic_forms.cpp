#include "nastran/algebraic_forms.h"

#include <Eigen/LU>
#include <cmath>

#include "linear/physical_matrices.h"
#include "mechanics/accumulator.h"

namespace dynalin::nastran {

namespace {

constexpr std::array families = {PartialBy::position, PartialBy::velocity,  PartialBy::damping, PartialBy::acceleration,
                                 PartialBy::lambda,   PartialBy::algebraic, PartialBy::state,   PartialBy::state_rate};

}  // namespace

void AlgebraicForms::add(PartialBy family, std::int32_t column, double value, MotionForm& form) const {
  const auto put_in = [&](const MotionForm& other) {
    for (const auto& [key, v] : other) form[key] += value * v;
  };
  switch (family) {
    case PartialBy::algebraic:
      return put_in(algebraic_[static_cast<std::size_t>(column)]);
    case PartialBy::lambda:
      return put_in(lambda_[static_cast<std::size_t>(column)]);
    case PartialBy::damping:
      if (!without_damping_) form[{PartialBy::velocity, column}] += value;
      return;
    default:
      form[{family, column}] += value;
  }
}

MotionForm AlgebraicForms::row(const System& system, std::int32_t r) const {
  MotionForm form;
  for (const auto& [key, v] : rows_[static_cast<std::size_t>(r - system.layout().coordinate_count)])
    add(key.first, key.second, v, form);
  return form;
}

// Which equation comes when.
class AlgebraicForms::Solving {
 public:
  Solving(AlgebraicForms& forms, std::size_t count)
      : forms_(forms), count_(count), readers_(count), done_(count, false) {}

  bool run() {
    std::vector<std::size_t> open(count_), later;
    std::vector<std::size_t> ready;
    for (std::size_t w = 0; w < count_; ++w) {
      for (const auto& [key, v] : forms_.rows_[w]) {
        const auto read = static_cast<std::size_t>(key.second);
        if (key.first != PartialBy::algebraic || v == 0.0 || read == w) continue;
        ++open[w];
        readers_[read].push_back(w);
      }
      if (open[w] == 0) ready.push_back(w);
    }
    // What needs nothing that is not known.
    while (!ready.empty()) {
      const std::size_t w = ready.back();
      ready.pop_back();
      if (!settle(w)) continue;
      for (const std::size_t reader : readers_[w]) {
        if (--open[reader] == 0) ready.push_back(reader);
      }
    }
    // What nothing else that is left needs waits until loops are solved.
    std::vector<std::size_t> needed(count_);
    std::vector<bool> waits(count_, false);
    for (std::size_t w = 0; w < count_; ++w) {
      for (const std::size_t reader : readers_[w]) needed[w] += done_[reader] ? 0 : 1;
    }
    for (std::size_t w = 0; w < count_; ++w) {
      if (!done_[w] && needed[w] == 0 && diagonal(w) != 0.0) later.push_back(w), waits[w] = true;
    }
    for (std::size_t k = 0; k < later.size(); ++k) {
      for (const auto& [key, v] : forms_.rows_[later[k]]) {
        const auto read = static_cast<std::size_t>(key.second);
        if (key.first != PartialBy::algebraic || v == 0.0 || done_[read] || waits[read]) continue;
        if (--needed[read] == 0 && diagonal(read) != 0.0) later.push_back(read), waits[read] = true;
      }
    }
    std::vector<std::size_t> loops;
    for (std::size_t w = 0; w < count_; ++w) {
      if (!done_[w] && !waits[w]) loops.push_back(w);
    }
    if (!solve(loops)) return false;
    for (; !later.empty(); later.pop_back()) settle(later.back());
    return true;
  }

 private:
  double diagonal(std::size_t w) const {
    double sum = 0;
    for (const auto& [key, v] : forms_.rows_[w]) {
      if (key.first == PartialBy::algebraic && static_cast<std::size_t>(key.second) == w) sum += v;
    }
    return sum;
  }
  // The negative of what a row has beside the unknowns that `own` counts.
  template <class Own>
  MotionForm known(std::size_t w, const Own& own) const {
    MotionForm form;
    for (const auto& [key, v] : forms_.rows_[w]) {
      if (key.first == PartialBy::algebraic && own(static_cast<std::size_t>(key.second), v)) continue;
      if (key.first == PartialBy::lambda)
        form[key] -= v;  // put in when all are known
      else
        forms_.add(key.first, key.second, -v, form);
    }
    return form;
  }
  bool settle(std::size_t w) {
    const double d = diagonal(w);
    if (d == 0.0) return false;
    MotionForm form = known(w, [&](std::size_t read, double) { return read == w; });
    for (auto& [key, v] : form) v /= d;
    forms_.algebraic_[w] = std::move(form);
    return done_[w] = true;
  }
  bool solve(const std::vector<std::size_t>& loops) {
    const auto n = static_cast<Eigen::Index>(loops.size());
    if (n == 0) return true;
    std::map<std::size_t, Eigen::Index> place;
    for (Eigen::Index k = 0; k < n; ++k) place[loops[static_cast<std::size_t>(k)]] = k;
    Eigen::MatrixXd among = Eigen::MatrixXd::Zero(n, n);
    std::vector<MotionForm> right;
    for (Eigen::Index k = 0; k < n; ++k) {
      right.push_back(known(loops[static_cast<std::size_t>(k)], [&](std::size_t read, double v) {
        const auto found = place.find(read);
        if (found != place.end()) among(k, found->second) += v;
        return found != place.end() || v == 0.0;
      }));
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(among);
    if (!lu.isInvertible()) return false;
    const Eigen::MatrixXd inverse = lu.inverse();
    for (Eigen::Index r = 0; r < n; ++r) {
      MotionForm& form = forms_.algebraic_[loops[static_cast<std::size_t>(r)]];
      for (Eigen::Index k = 0; k < n; ++k) {
        if (inverse(r, k) == 0.0) continue;
        for (const auto& [key, v] : right[static_cast<std::size_t>(k)]) form[key] += inverse(r, k) * v;
      }
      done_[loops[static_cast<std::size_t>(r)]] = true;
    }
    return true;
  }

  AlgebraicForms& forms_;
  std::size_t count_;
  std::vector<std::vector<std::size_t>> readers_;
  std::vector<bool> done_;
};

namespace {

// Multipliers by motions of all coordinates.
Result<std::vector<MotionForm>> multipliers(const System& system, const Perturbation& perturbation) {
  const auto physical = PhysicalEquations::make(system, perturbation);
  if (!physical) return tl::unexpected(physical.error());
  const PerturbedPoint& at = *perturbation.at;
  const StateChoice& choice = at.with_massless ? *at.with_massless : at.choice;
  const MotionMap by = physical->of_unknowns(PartialBy::lambda);
  std::vector<MotionForm> forms(static_cast<std::size_t>(at.rows.size()));
  for (std::size_t k = 0; k < forms.size(); ++k) {
    const auto r = static_cast<Eigen::Index>(k);
    MotionForm& form = forms[k];
    const auto add = [&](PartialBy family, std::int32_t column, double v) {
      if (v != 0.0) form[{family, column}] += v;
    };
    const std::vector<std::size_t>& with_rate = physical->whole().with_rate;
    for (std::size_t j = 0; j < with_rate.size(); ++j) {
      const auto c = static_cast<Eigen::Index>(j);
      for (const auto& e : choice.gradient[with_rate[j]]) {
        add(PartialBy::acceleration, e.column, by.of_accelerations(r, c) * e.c.g);
        add(PartialBy::velocity, e.column, by.of_accelerations(r, c) * e.c.a1 + by.of_rates(r, c) * e.c.g);
        add(PartialBy::position, e.column, by.of_accelerations(r, c) * e.c.a0 + by.of_rates(r, c) * e.c.v);
      }
    }
    for (std::size_t j = 0; j < choice.gradient.size(); ++j) {
      for (const auto& e : choice.gradient[j])
        add(PartialBy::position, e.column, by.of_coordinates(r, static_cast<Eigen::Index>(j)) * e.c.g);
    }
    for (std::size_t j = 0; j < choice.differential.size(); ++j)
      add(PartialBy::state, choice.differential[j], by.of_states(r, static_cast<Eigen::Index>(j)));
  }
  return forms;
}

}  // namespace

Result<AlgebraicForms> AlgebraicForms::make(const System& system, const Perturbation& perturbation) {
  const PerturbedPoint& at = *perturbation.at;
  const std::int32_t n = system.layout().coordinate_count;
  AlgebraicForms forms;
  forms.without_damping_ = at.without_damping;
  forms.rows_.resize(static_cast<std::size_t>(at.equations.size() - n));
  bool reads_multipliers = false;
  for (const PartialBy family : families) {
    for_each_entry(at.equations.matrix(family), [&](std::int32_t r, std::int32_t c, double v) {
      if (v == 0.0) return;
      if (family == PartialBy::lambda) reads_multipliers = true;
      if (r >= n) forms.rows_[static_cast<std::size_t>(r - n)].push_back({{family, c}, v});
    });
  }
  forms.algebraic_.resize(system.layout().algebraic.size());
  if (!Solving(forms, forms.algebraic_.size()).run())
    return tl::unexpected(Failure{"export", "the values of the model do not follow from its motion", {}});
  if (!reads_multipliers) return forms;
  auto lambda = multipliers(system, perturbation);
  if (!lambda) return tl::unexpected(lambda.error());
  forms.lambda_ = std::move(*lambda);
  for (MotionForm& form : forms.algebraic_) {
    MotionForm without;
    for (const auto& [key, v] : form) forms.add(key.first, key.second, v, without);
    form = std::move(without);
  }
  return forms;
}

}  // namespace dynalin::nastran
