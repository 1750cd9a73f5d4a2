#include "states/user_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

using Index = Eigen::Index;
using DenseVector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

// Relative to its gradient, the part of a motion that is no rounding, and one that is worth a word.
constexpr double independent = 1e-10;
constexpr double barely_independent = 1e-6;
constexpr std::size_t most_names = 4;

class Preference {
 public:
  Preference(const System& system, const CandidateSet& candidates, StateChoice& choice)
      : system_(system), candidates_(candidates), choice_(choice), count_(static_cast<Index>(choice.gradient.size())) {}

  Result<std::vector<double>> run(const ConstraintRows& rows) {
    bool square = false;
    const std::vector<bool> all(choice_.gradient.size(), true);
    const ColumnMatrix level = level_matrix(rows, choice_, choice_.active, all, square);
    if (!square || !lu_.factor(level)) return tl::unexpected(undetermined_positions());
    unit_.resize(count_);
    for (Index k = 0; k < count_; ++k) unit_(k) = unit_of(system_, choice_.gradient[static_cast<std::size_t>(k)]);
    basis_.resize(count_, 0);
    for (const Candidate& c : candidates_.own) consider(c);
    give_way();
    return std::move(units_);
  }

 private:
  // What the coordinate makes of the motions of the chosen ones, in their units.
  DenseVector motion_of(const std::vector<StateChoice::Entry>& gradient) const {
    Matrix row = Matrix::Zero(static_cast<Index>(system_.coordinates()), 1);
    for (const auto& e : gradient) row(e.column, 0) += e.c.g;
    lu_.solve_transposed(row);
    return row.col(0).tail(count_).cwiseProduct(unit_);
  }

  void consider(const Candidate& c) {
    std::vector<StateChoice::Entry> gradient = gradient_of(candidates_, c);
    const double given = unit_of(system_, gradient);
    const DenseVector motion = given > 0 ? motion_of(gradient) : DenseVector::Zero(count_);
    const double size = std::max(given, motion.norm());
    DenseVector rest = motion, along = DenseVector::Zero(basis_.cols());
    for (int twice = 0; twice < 2; ++twice) {
      const DenseVector part = basis_.transpose() * rest;
      rest -= basis_ * part;
      along += part;
    }
    const double left = size > 0 ? rest.norm() / size : 0;
    if (left > independent) {
      take(c, std::move(gradient), motion, rest, along);
      if (left < barely_independent) {
        choice_.warnings.warning(
            "dependent-coordinate", {},
            fmt::format("{} is nearly {}: only {:.1e} of its gradient is a motion of its own", c.state.label.text,
                        taken_.size() > 1 ? "dependent on those before it" : "constant", left));
      }
    } else if (given == 0) {
      refuse(c, "it is constant, to first order, wherever the model moves");
    } else if (motion.norm() <= independent * size) {
      refuse(c, "the constraints keep it constant here, to first order");
    } else {
      refuse(c, "it depends on " + names_of(along, motion.norm()));
    }
  }

  void refuse(const Candidate& c, const std::string& why) {
    choice_.warnings.warning("dependent-coordinate", {}, fmt::format("{} was not taken: {}", c.state.label.text, why));
  }

  void take(const Candidate& c, std::vector<StateChoice::Entry> gradient, const DenseVector& motion,
            const DenseVector& rest, const DenseVector& along) {
    const Index m = basis_.cols();
    basis_.conservativeResize(Eigen::NoChange, m + 1);
    basis_.col(m) = rest.normalized();
    triangle_.conservativeResizeLike(Matrix::Zero(m + 1, m + 1));
    triangle_.col(m).head(m) = along;
    triangle_(m, m) = rest.norm();
    sizes_.push_back(motion.norm());
    units_.push_back(rest.norm());
    taken_.push_back(c.state);
    gradients_.push_back(std::move(gradient));
    along_motion_.emplace_back(candidates_.gradients.along_motion(c.row));
  }

  // Of those taken before, the ones that make it up.
  std::string names_of(const DenseVector& along, double size) const {
    const DenseVector factors = triangle_.triangularView<Eigen::Upper>().solve(along);
    std::vector<std::string> names;
    std::size_t more = 0;
    for (std::size_t k = 0; k < taken_.size(); ++k) {
      if (std::abs(factors(static_cast<Index>(k))) * sizes_[k] <= independent * size) continue;
      if (names.size() < most_names) {
        names.push_back(fmt::format("VAR/{}", taken_[k].label.element));
      } else {
        ++more;
      }
    }
    std::string text = fmt::format("{}", fmt::join(names, ", "));
    if (more > 0) text += fmt::format(" and {} more", more);
    return text;
  }

  void give_way() {
    if (taken_.empty()) return;
    std::vector<SparseRow> rows(taken_.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      for (Index c = 0; c < count_; ++c) {
        const double v = basis_(c, static_cast<Index>(k));
        if (v == 0) continue;
        rows[k].column.push_back(static_cast<std::int32_t>(c));
        rows[k].value.push_back(v);
      }
    }
    std::vector<std::int32_t> order;
    for (auto k = static_cast<std::int32_t>(count_); k-- > 0;) order.push_back(k);
    const Elimination e = eliminate(std::move(rows), static_cast<std::int32_t>(count_), order);
    for (std::size_t k = 0; k < choice_.coordinates.size(); ++k) {
      if (e.dependent[k]) continue;
      taken_.push_back(choice_.coordinates[k]);
      gradients_.push_back(std::move(choice_.gradient[k]));
      along_motion_.emplace_back();
    }
    choice_.coordinates = std::move(taken_);
    choice_.gradient = std::move(gradients_);
    choice_.along_motion = std::move(along_motion_);
  }

  const System& system_;
  const CandidateSet& candidates_;
  StateChoice& choice_;
  Index count_;  // of the chosen coordinates
  SparseLu lu_;
  DenseVector unit_;
  Matrix basis_, triangle_;  // motions of those taken, in rows: their transpose is basis · triangle
  std::vector<double> sizes_, units_;
  std::vector<StateCoordinate> taken_;
  std::vector<std::vector<StateChoice::Entry>> gradients_;
  std::vector<std::optional<Taylor>> along_motion_;
};

}  // namespace

std::vector<StateChoice::Entry> gradient_of(const CandidateSet& candidates, const Candidate& c) {
  if (c.row < 0) return {{.column = c.coordinate, .size_of_g = 1.0F, .c = {1.0, 0.0, 0.0, 0.0}}};
  const auto row = candidates.gradients.row(c.row);
  return {row.begin(), row.end()};
}

double unit_of(const System& system, const std::vector<StateChoice::Entry>& gradient) {
  double unit = 0;
  for (const StateChoice::Entry& e : gradient)
    unit = std::max(unit, std::abs(e.c.g * system.coordinate_scale(e.column)));
  return unit;
}

Result<std::vector<double>> prefer_user_coordinates(const System& system, const ConstraintRows& rows,
                                                    const CandidateSet& candidates, StateChoice& choice) {
  if (candidates.own.empty()) return std::vector<double>{};
  return Preference(system, candidates, choice).run(rows);
}

}  // namespace dynalin
