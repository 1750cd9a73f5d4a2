#include "nastran/closed_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "linear/physical_matrices.h"
#include "mechanics/pair_blocks.h"
#include "nastran/export_point.h"
#include "nastran/marker_grids.h"
#include "perturbation/perturbed_point.h"

namespace dynalin::nastran {

namespace {

using Eigen::Index;

class ClosedBox {
 public:
  ClosedBox(const System& system, const Perturbation& perturbation, const PhysicalEquations& physical,
            const ExportOptions& options, Diagnostics& remarks)
      : system_(system),
        at_(*perturbation.at),
        matrices_(physical.whole()),
        moves_(physical.of_unknowns(PartialBy::position).of_coordinates),
        options_(options),
        remarks_(remarks),
        markers_(system, at_.motion, options, ids_, deck_,
                 [this](Grid& g, MarkerId m, const Matrix3& axes) { follow(g, m, axes); }) {
    deck_.time = perturbation.model.time;
    deck_.states = perturbation.model.states.size();
  }

  StudyResult<Deck> run() {
    clear_rounding();
    add_points();
    add_matrices();
    if (auto done = markers_.add_asked(remarks_); !done) return tl::unexpected(done.error());
    if (auto done = markers_.add_channels(remarks_); !done) return tl::unexpected(done.error());
    if (!deck_.inputs.empty() && forces_read_reactions()) {
      remarks_.warning(
          "export-differs", {},
          "forces or values of the model depend on reactions, which forces at input channels change beside "
          "the coordinates: the exported response leaves that out");
    }
    return std::move(deck_);
  }

 private:
  Index coordinates() const { return static_cast<Index>(matrices_.coordinates.size()); }
  Index states() const { return static_cast<Index>(matrices_.states.size()); }
  Dof coordinate(Index k) const { return {coordinate_[static_cast<std::size_t>(k)], 0}; }
  Dof state(Index k) const { return {state_[static_cast<std::size_t>(k)], 0}; }
  Dof with_rate(Index k) const {
    return coordinate(static_cast<Index>(matrices_.with_rate[static_cast<std::size_t>(k)]));
  }

  // What a coordinate does not move is moved by the rounding of the rest.
  void clear_rounding() {
    for (Index k = 0; k < moves_.cols(); ++k) {
      double size = 0;
      const auto scaled = [&](Index r) {
        return std::abs(moves_(r, k)) / system_.coordinate_scale(static_cast<std::int32_t>(r));
      };
      for (Index r = 0; r < moves_.rows(); ++r) size = std::max(size, scaled(r));
      for (Index r = 0; r < moves_.rows(); ++r) {
        if (scaled(r) <= 1e-15 * size) moves_(r, k) = 0;
      }
    }
  }

  std::int64_t add_point(std::string name) {
    deck_.scalar_points.push_back({{-1, std::move(name)}, ids_.take(IdSpace::point, options_.grid_offset)});
    return deck_.scalar_points.back().id;
  }
  void add_points() {
    Grid ground;
    ground.name = "ground";
    ground.id = ids_.take(IdSpace::point, options_.grid_offset);
    ground.fixed = "123456";
    deck_.grids.push_back(std::move(ground));
    const auto text = [](const StateLabel& s) {
      return s.owner.empty() ? s.text : fmt::format("{} of {}", s.text, s.owner.text());
    };
    for (const StateLabel& s : matrices_.coordinates) coordinate_.push_back(add_point(text(s)));
    for (const StateLabel& s : matrices_.states) state_.push_back(add_point(text(s)));
  }

  void add(MatrixKind kind, Dof row, Dof column, double value) {
    if (value != 0.0) matrix_[static_cast<std::size_t>(kind)].entries.push_back({row, column, value});
  }
  // One row of what depends on motion, times a factor.
  void add_row(Dof row, const MotionMap& map, Index r, double factor) {
    for (Index k = 0; k < map.of_accelerations.cols(); ++k) {
      add(MatrixKind::M, row, with_rate(k), factor * map.of_accelerations(r, k));
      add(MatrixKind::B, row, with_rate(k), factor * map.of_rates(r, k));
    }
    for (Index k = 0; k < coordinates(); ++k) add(MatrixKind::K, row, coordinate(k), factor * map.of_coordinates(r, k));
    for (Index k = 0; k < states(); ++k) add(MatrixKind::K, row, state(k), factor * map.of_states(r, k));
  }

  void add_matrices() {
    for (std::size_t k = 0; k < matrix_.size(); ++k) {
      matrix_[k].kind = static_cast<MatrixKind>(k);
      matrix_[k].suffix = options_.forces_dmig_name;
    }
    for (Index k = 0; k < static_cast<Index>(matrices_.with_rate.size()); ++k)
      add_row(with_rate(k), matrices_.force, k, 1);
    for (Index k = 0; k < states(); ++k) {
      add(MatrixKind::B, state(k), state(k), 1);
      add_row(state(k), matrices_.state_rate, k, -1);
    }
    for (Index k = 0; k < coordinates(); ++k) {
      if (!std::ranges::binary_search(matrices_.with_rate, static_cast<std::size_t>(k))) add_dependent_rate(k);
    }
    for (Matrix& m : matrix_) {
      if (!m.entries.empty()) deck_.matrices.push_back(std::move(m));
    }
  }

  void add_dependent_rate(Index k) {
    const Dof multiplier = {
        add_point("multiplier of the rate of " + matrices_.coordinates[static_cast<std::size_t>(k)].text), 0};
    add(MatrixKind::K, coordinate(k), multiplier, 1);
    add(MatrixKind::B, multiplier, coordinate(k), 1);
    add_row(multiplier, matrices_.rate, k, -1);
    for (Index j = 0; j < matrices_.rate.of_rates.cols(); ++j)
      add(MatrixKind::K, with_rate(j), multiplier, -matrices_.rate.of_rates(k, j));
  }

  // u − Φ x = 0 for each component of the grid.
  void follow(Grid& grid, MarkerId marker, const Matrix3& axes) {
    Eigen::Matrix<double, 6, Eigen::Dynamic> by_coordinates, sizes;
    by_coordinates.setZero(6, coordinates());
    sizes.setZero(6, coordinates());
    const auto take = [&](Index component, std::int32_t column, double value) {
      by_coordinates.row(component) += value * moves_.row(column);
      sizes.row(component) += std::abs(value) * moves_.row(column).cwiseAbs();
    };
    for_each_block(at_.motion, system_.layout().marker(marker), system_.layout(), [&](const PairBlock& b) {
      const Matrix3 moves = transpose(axes) * b.moves, turns = transpose(axes) * b.turns;
      for (std::size_t k = 0; k < b.count; ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          const std::int32_t column = b.column + static_cast<std::int32_t>(k);
          take(static_cast<Index>(c), column, moves[k][c]);
          take(static_cast<Index>(c + 3), column, turns[k][c]);
        }
      }
    });
    for (int c = 0; c < 6; ++c) {
      Relation relation;
      relation.name = grid.name;
      relation.terms.push_back({{grid.id, c + 1}, 1.0});
      for (Index k = 0; k < coordinates(); ++k) {
        if (std::abs(by_coordinates(c, k)) > 1e-14 * sizes(c, k))
          relation.terms.push_back({coordinate(k), -by_coordinates(c, k)});
      }
      if (relation.terms.size() > 1)
        deck_.relations.push_back(std::move(relation));
      else
        grid.fixed += std::to_string(c + 1);
    }
  }

  bool forces_read_reactions() const {
    // Equations that do, through values as well; of values that nothing else reads nothing comes.
    const Layout& layout = system_.layout();
    const std::int32_t values = at_.equations.algebraic_row(0),
                       states = values + static_cast<std::int32_t>(layout.algebraic.size());
    std::vector<bool> reads(static_cast<std::size_t>(states) + layout.states.size());
    bool found = false, any = false;
    const auto mark = [&](std::int32_t row) {
      if (reads[static_cast<std::size_t>(row)]) return;
      reads[static_cast<std::size_t>(row)] = any = true;
      found = found || row < values || row >= states;
    };
    for_each_entry(at_.equations.matrix(PartialBy::lambda), [&](std::int32_t row, std::int32_t, double v) {
      if (v != 0.0) mark(row);
    });
    while (std::exchange(any, false) && !found) {
      for_each_entry(at_.equations.matrix(PartialBy::algebraic), [&](std::int32_t row, std::int32_t value, double v) {
        if (v != 0.0 && reads[static_cast<std::size_t>(values + value)]) mark(row);
      });
    }
    return found;
  }

  const System& system_;
  const PerturbedPoint& at_;
  const PhysicalMatrices& matrices_;
  Eigen::MatrixXd moves_;  // coordinates of the layout by those chosen
  const ExportOptions& options_;
  Diagnostics& remarks_;
  Ids ids_;
  Deck deck_;
  MarkerGrids markers_;
  std::vector<std::int64_t> coordinate_, state_;  // their points
  std::array<Matrix, 3> matrix_;                  // by kind
};

}  // namespace

StudyResult<Deck> closed_box(const Linearization& of, const ExportOptions& options, Diagnostics& remarks) {
  const auto at = linearization_for(of, options);
  if (!at) return tl::unexpected(at.error());
  const auto physical = PhysicalEquations::make(*of.system, at->linear);
  if (!physical) return tl::unexpected(StudyFailure(physical.error()));
  if (physical->whole().coordinates.empty()) {
    return tl::unexpected(StudyFailure(
        {"export", "the model has no degrees of freedom: it can be exported as OPENBOX, not as CLOSEDBOX", {}}));
  }
  return ClosedBox(*of.system, at->linear, *physical, options, remarks).run();
}

}  // namespace dynalin::nastran
