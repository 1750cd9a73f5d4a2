#include "linear/physical_matrices.h"

#include <algorithm>
#include <unordered_set>

#include "analysis/augmented_system.h"
#include "perturbation/perturbed_point.h"
#include "system/sparse_lu.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

// to −= (entries) · of
void subtract_products(const std::vector<Triplet>& entries, const Matrix& of, Eigen::Ref<Matrix> to) {
  for (Index k = 0; k < to.cols(); ++k) {
    for (const Triplet& e : entries) to(e.row, k) -= e.value * of(e.column, k);
  }
}

}  // namespace

MotionMap& MotionMap::operator+=(const MotionMap& other) {
  of_accelerations += other.of_accelerations;
  of_rates += other.of_rates;
  of_coordinates += other.of_coordinates;
  of_states += other.of_states;
  of_inputs += other.of_inputs;
  return *this;
}

class PhysicalEquations::Assembly {
 public:
  Assembly(const System& system, const Perturbation& perturbation, DampingOfForces damping)
      : system_(system),
        augmented_(system),
        at_(*perturbation.at),
        rows_(at_.rows),
        eq_(at_.equations),
        choice_(at_.with_massless ? *at_.with_massless : at_.choice),
        cut_(system.layout().algebraic.size(), false) {
    for (const std::int32_t u : at_.inputs) cut_[static_cast<std::size_t>(u)] = true;
    out_.at_ = perturbation.at;
    out_.without_damping_ = at_.without_damping && damping == DampingOfForces::as_linearized;
    whole().inputs = perturbation.model.inputs, whole().outputs = perturbation.model.outputs;
  }

  Result<PhysicalEquations> run() {
    name();
    if (!find_motions()) return tl::unexpected(undetermined_positions());
    if (!solve())
      return tl::unexpected(Failure{
          "linear analysis", "the values of the model do not follow from its motion", {}, "undetermined-states"});
    return std::move(out_);
  }

 private:
  PhysicalMatrices& whole() { return out_.whole_; }
  Index rates() const { return static_cast<Index>(out_.whole_.with_rate.size()); }
  Index coordinates() const { return static_cast<Index>(out_.whole_.coordinates.size()); }
  Index states() const { return static_cast<Index>(choice_.differential.size()); }
  Index inputs() const { return static_cast<Index>(at_.inputs.size()); }
  // Where the columns of x′, x, z and u begin, behind those of x″.
  Index of_rates() const { return rates(); }
  Index of_coordinates() const { return 2 * rates(); }
  Index of_states() const { return of_coordinates() + coordinates(); }
  Index of_inputs() const { return of_states() + states(); }
  Index columns() const { return of_inputs() + inputs(); }

  void name() {
    for (std::size_t k = 0; k < choice_.coordinates.size(); ++k) {
      whole().coordinates.push_back(choice_.coordinates[k].label);
      if (choice_.has_rate[k]) whole().with_rate.push_back(k);
    }
    whole().states.assign(choice_.states.begin() + choice_.first_differential, choice_.states.end());
  }

  // δq and δq′; false where the chosen coordinates do not determine them.
  bool find_motions() {
    bool square = false;
    SparseLu on_positions, on_rates;
    const std::vector<bool> every(choice_.gradient.size(), true);
    ColumnMatrix level = level_matrix(rows_, choice_, choice_.active, every, square);
    if (!square || !on_positions.factor(level)) return false;
    const Index n = system_.layout().coordinate_count;
    Variations& v = out_.variations_;
    v.dq = v.dqdot = Matrix::Zero(n, columns());
    Matrix moved = Matrix::Zero(n, coordinates());
    moved.bottomRows(coordinates()).setIdentity();
    on_positions.solve(moved);
    v.dq.middleCols(of_coordinates(), coordinates()) = moved;

    level = level_matrix(rows_, choice_, choice_.velocity_active, choice_.has_rate, square);
    if (!square || !on_rates.factor(level)) return false;
    Matrix right = Matrix::Zero(n, rates() + coordinates());
    right.bottomLeftCorner(rates(), rates()).setIdentity();
    std::vector<Triplet> by_positions;
    std::int32_t r = 0;
    for_rows([&](const auto& row) {
      for (const auto& e : row) by_positions.push_back({r, e.column, e.c.v});
      ++r;
    });
    subtract_products(by_positions, moved, right.rightCols(coordinates()));
    on_rates.solve(right);
    v.dqdot.middleCols(of_rates(), rates()) = right.leftCols(rates());
    v.dqdot.middleCols(of_coordinates(), coordinates()) = right.rightCols(coordinates());
    out_.velocities_ = right.leftCols(rates());
    return true;
  }

  // Rows that hold rates: constraints, then the gradients of coordinates with a rate.
  template <class Take>
  void for_rows(const Take& take) const {
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (choice_.velocity_active[static_cast<std::size_t>(k)]) take(rows_.row(k));
    }
    for (const std::size_t k : out_.whole_.with_rate) take(choice_.gradient[k]);
  }

  // Unknowns by x″, x′, x, z and u, then what whole() has of them; false where they do not follow from the motion.
  bool solve() {
    SparseLu lu;
    if (!factor(lu)) return false;
    Matrix x = Matrix::Zero(unknowns(), columns());
    take_by_equations(x);
    take_by_held_accelerations(x);
    for (Index k = 0; k < inputs(); ++k)
      x(augmented_.algebraic(at_.inputs[static_cast<std::size_t>(k)]), of_inputs() + k) = 1;
    lu.solve(x);

    Variations& v = out_.variations_;
    v.dqddot = x.topRows(system_.layout().coordinate_count);
    v.dlambda = x.middleRows(augmented_.lambda(0), rows_.size());
    v.dw = x.middleRows(augmented_.algebraic(0), static_cast<Index>(system_.layout().algebraic.size()));
    v.dz_rate = x.middleRows(augmented_.state(0), static_cast<Index>(system_.layout().states.size()));
    whole().force = out_.split(x.bottomRows(rates()));
    take_rates();
    take_outputs();
    return true;
  }

  // Those of the augmented matrix and what holds each of x″, with the gradient of whose coordinate it acts.
  Index unknowns() const { return augmented_.size() + rates(); }
  std::int32_t held(Index k) const { return static_cast<std::int32_t>(augmented_.size() + k); }
  const auto& gradient_of_rate(Index k) const {
    return choice_.gradient[out_.whole_.with_rate[static_cast<std::size_t>(k)]];
  }

  bool factor(SparseLu& lu) {
    std::vector<Triplet> entries;
    for_each_entry(augmented_.matrix(eq_, rows_, choice_.velocity_active, {}, cut_),
                   [&](std::int32_t r, std::int32_t c, double v) {
                     entries.push_back({r, c, v});
                   });
    for (Index k = 0; k < rates(); ++k) {
      for (const auto& e : gradient_of_rate(k)) {
        entries.push_back({held(k), e.column, e.c.g});
        entries.push_back({e.column, held(k), -e.c.g});
      }
    }
    const auto all = static_cast<std::int32_t>(unknowns());
    return lu.factor(compressed(all, all, entries));
  }

  // What motions and states do to the equations.
  void take_by_equations(Matrix& x) {
    Variations& v = out_.variations_;
    v.dz = Matrix::Zero(static_cast<Index>(system_.layout().states.size()), columns());
    for (Index k = 0; k < states(); ++k) v.dz(choice_.differential[static_cast<std::size_t>(k)], of_states() + k) = 1;
    // Column by column: one of either matrix fits where a row of them is spread over all of it.
    const auto subtract = [&](PartialBy family, const Matrix& of) {
      std::vector<Triplet> counted;
      for_each_entry(eq_.matrix(family), [&](std::int32_t r, std::int32_t c, double value) {
        const std::int32_t w = r - system_.layout().coordinate_count;
        const bool replaced = w >= 0 && w < static_cast<std::int32_t>(cut_.size()) && cut_[static_cast<std::size_t>(w)];
        if (!replaced) counted.push_back({augmented_.equation(r), c, value});
      });
      subtract_products(counted, of, x);
    };
    subtract(PartialBy::position, v.dq);
    subtract(PartialBy::velocity, v.dqdot);
    if (!out_.without_damping_) subtract(PartialBy::damping, v.dqdot);
    subtract(PartialBy::state, v.dz);
  }

  // Constraints and gradients of coordinates, differentiated twice.
  void take_by_held_accelerations(Matrix& x) const {
    std::vector<Triplet> by_rates, by_positions;
    const auto hold = [&](Index row, const auto& gradient) {
      for (const auto& e : gradient) {
        by_rates.push_back({static_cast<std::int32_t>(row), e.column, e.c.a1});
        by_positions.push_back({static_cast<std::int32_t>(row), e.column, e.c.a0});
      }
    };
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (choice_.velocity_active[static_cast<std::size_t>(k)]) hold(augmented_.lambda(k), rows_.row(k));
    }
    for (Index k = 0; k < rates(); ++k) {
      hold(held(k), gradient_of_rate(k));
      x(held(k), k) += 1;
    }
    subtract_products(by_rates, out_.variations_.dqdot, x);
    subtract_products(by_positions, out_.variations_.dq, x);
  }

  // Of coordinates and of differential states.
  void take_rates() {
    const Variations& v = out_.variations_;
    Matrix rate = Matrix::Zero(coordinates(), columns());
    for (Index k = 0; k < coordinates(); ++k) {
      for (const auto& e : choice_.gradient[static_cast<std::size_t>(k)])
        rate.row(k) += e.c.g * v.dqdot.row(e.column) + e.c.v * v.dq.row(e.column);
    }
    // What is held has its own rate, but for rounding.
    for (Index k = 0; k < rates(); ++k) {
      auto row = rate.row(static_cast<Index>(whole().with_rate[static_cast<std::size_t>(k)]));
      row.setZero();
      row(of_rates() + k) = 1;
    }
    whole().rate = out_.split(rate);
    Matrix state_rate(states(), columns());
    for (Index k = 0; k < states(); ++k)
      state_rate.row(k) = v.dz_rate.row(choice_.differential[static_cast<std::size_t>(k)]);
    whole().state_rate = out_.split(state_rate);
  }

  void take_outputs() {
    Matrix output(static_cast<Index>(at_.outputs.size()), columns());
    for (std::size_t k = 0; k < at_.outputs.size(); ++k)
      output.row(static_cast<Index>(k)) = out_.variations_.dw.row(at_.outputs[k]);
    if (out_.without_damping_) see_damping(output);
    whole().output = out_.split(output);
  }

  // Outputs keep what they see of velocities where damping is left out.
  void see_damping(Matrix& outputs) const {
    for_each_entry(at_.damping_in_outputs(), [&](std::int32_t output, std::int32_t rate, double value) {
      outputs.row(output) += value * out_.variations_.dqdot.row(rate);
    });
  }

  const System& system_;
  const AugmentedSystem augmented_;
  const PerturbedPoint& at_;
  const ConstraintRows& rows_;
  const Equations& eq_;
  const StateChoice& choice_;
  std::vector<bool> cut_;  // algebraic equations that inputs replace
  PhysicalEquations out_;
};

Result<PhysicalEquations> PhysicalEquations::make(const System& system, const Perturbation& perturbation,
                                                  DampingOfForces damping) {
  return Assembly(system, perturbation, damping).run();
}

MotionMap PhysicalEquations::split(const Matrix& by_all) const {
  const auto r = static_cast<Index>(whole_.with_rate.size()), p = static_cast<Index>(whole_.coordinates.size());
  const auto z = static_cast<Index>(whole_.states.size()), u = static_cast<Index>(whole_.inputs.size());
  return {by_all.leftCols(r), by_all.middleCols(r, r), by_all.middleCols(2 * r, p), by_all.middleCols(2 * r + p, z),
          by_all.rightCols(u)};
}

const Matrix& PhysicalEquations::variation(PartialBy family) const {
  switch (family) {
    case PartialBy::position:
      return variations_.dq;
    case PartialBy::velocity:
    case PartialBy::damping:
      return variations_.dqdot;
    case PartialBy::acceleration:
      return variations_.dqddot;
    case PartialBy::lambda:
      return variations_.dlambda;
    case PartialBy::algebraic:
      return variations_.dw;
    case PartialBy::state:
      return variations_.dz;
    case PartialBy::state_rate:
      break;
  }
  return variations_.dz_rate;
}

std::vector<const ElementLabel*> PhysicalEquations::elements() const {
  std::vector<const ElementLabel*> list;
  std::unordered_set<const ElementLabel*> known;
  const auto n = static_cast<std::int32_t>(velocities_.rows());
  for (std::size_t e = 0; e < at_->trace().elements.size(); ++e) {
    const ElementTrace::Element& element = at_->trace().elements[e];
    const auto first = at_->trace().partials.begin() + static_cast<std::ptrdiff_t>(element.first_partial),
               last = at_->trace().partials.begin() + static_cast<std::ptrdiff_t>(at_->trace().end_of_partials(e));
    const bool contributes = std::any_of(first, last, [&](const ElementTrace::Partial& p) { return p.row < n; });
    if (contributes && known.insert(element.of).second) list.push_back(element.of);
  }
  return list;
}

MotionMap PhysicalEquations::of(const ElementLabel& label) const {
  const auto n = static_cast<std::int32_t>(velocities_.rows());
  Matrix sum = Matrix::Zero(velocities_.cols(), variations_.dq.cols());
  Eigen::RowVectorXd balance(variations_.dq.cols());
  for (std::size_t e = 0; e < at_->trace().elements.size(); ++e) {
    if (!at_->trace().elements[e].of || !same_element(*at_->trace().elements[e].of, label)) continue;
    // Row by row of the balance: few of them belong to one element.
    std::vector<ElementTrace::Partial> partials(
        at_->trace().partials.begin() + static_cast<std::ptrdiff_t>(at_->trace().elements[e].first_partial),
        at_->trace().partials.begin() + static_cast<std::ptrdiff_t>(at_->trace().end_of_partials(e)));
    std::erase_if(partials, [&](const ElementTrace::Partial& p) {
      return p.row >= n || (without_damping_ && p.family == PartialBy::damping);
    });
    std::stable_sort(partials.begin(), partials.end(), [](const auto& a, const auto& b) { return a.row < b.row; });
    for (std::size_t k = 0; k < partials.size();) {
      const std::int32_t row = partials[k].row;
      balance.setZero();
      for (; k < partials.size() && partials[k].row == row; ++k)
        balance += partials[k].value * variation(partials[k].family).row(partials[k].column);
      sum += velocities_.row(row).transpose() * balance;
    }
  }
  return split(sum);
}

}  // namespace dynalin
