#include "linear/structural_zeros.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "linear/null_space.h"
#include "system/sparse_lu.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Index = Eigen::Index;

// Of an element's own size: rounding of its partials and of the motion that they are multiplied with.
constexpr double vanishing = 1e-13;

Matrix columns_of(const Matrix& m, const std::vector<Index>& columns) { return m(Eigen::all, columns); }

}  // namespace

class StructuralZeros::Contributions {
 public:
  Contributions(const System& system, const Motion& motion, ConstraintRows rows, const ElementTrace& trace,
                const Equations& eq, const StateChoice& choice, const LinearSystem& motions, bool without_damping,
                const std::vector<std::int32_t>& massless)
      : bodies_(system.layout().bodies),
        length_(system.length()),
        state_count_(system.layout().states.size()),
        rows_(std::move(rows)),
        choice_(choice),
        n_(system.layout().coordinate_count),
        w_(static_cast<std::int32_t>(system.layout().algebraic.size())),
        dq_(motions.dq.leftCols(choice.size())),
        dqdot_(motions.dqdot.leftCols(choice.size())),
        dlambda_(motions.dlambda.leftCols(choice.size())),
        dw_(motions.dw.leftCols(choice.size())) {
    for (std::size_t k = 0; k < choice.gradient.size(); ++k) {
      if (choice.position_state[k] < 0) continue;
      positions_.push_back(choice.position_state[k]);
      rates_of_positions_.push_back(choice.rate_state[k]);
    }
    for (std::int32_t k = 0; k < n_; ++k) scale_.push_back(system.coordinate_scale(k));
    for (const BodyMotion& b : motion.bodies) places_.emplace_back(b.r.x, b.r.y, b.r.z);
    body_of_.assign(static_cast<std::size_t>(n_), -1);
    for (std::size_t b = 1; b < bodies_.size(); ++b) {
      for (std::int32_t k = 0; k < bodies_[b].count; ++k)
        body_of_[static_cast<std::size_t>(bodies_[b].offset + k)] = static_cast<std::int32_t>(b);
    }
    factor_rates(massless);
    sort_elements(trace, without_damping);
    find_driven(eq);
  }

  // Whether differential state k of the layout does not act on bodies.
  const std::vector<bool>& driven_states() const { return driven_; }

  Matrix beyond(const Matrix& earlier) const {
    const Index n = choice_.size(), free = static_cast<Index>(positions_.size());
    if (free == 0 || !rates_known_) return Matrix(n, 0);
    const Directions d = directions(earlier);
    std::vector<Eigen::RowVectorXd> rows;
    add_rates_that_follow(d, rows);
    add_readings(d, rows);
    add_forces(d, rows);
    const Matrix null = null_space(rows, d.states.cols(), vanishing * std::sqrt(static_cast<double>(d.states.cols())));
    return without(earlier, d.states * null);
  }

 private:
  // Columns: a unit of each chosen coordinate at rest in it, then what makes a displacement grow as each of the earlier
  // directions.
  struct Directions {
    Matrix states, rates_of_states;  // x and x′ that is wanted of it
    std::array<RowMajor, column_families> change;
    std::array<double, column_families> size{};  // largest change, in units of coordinates
  };

  struct Entry {
    PartialBy family;
    std::int32_t row, column;
    double value;
  };
  struct Element {
    std::vector<Entry> partials;
    std::map<std::int32_t, double> load;  // by row of the balance
    std::vector<std::int32_t> reactions;  // its constraint rows
  };
  struct Reading {  // one quantity in an algebraic or differential equation
    std::vector<Entry> partials;
    double coefficient;
  };

  // Accelerations follow from those of states; along freedoms without mass any will do, as no force depends on them.
  void factor_rates(const std::vector<std::int32_t>& massless) {
    bool square = false;
    const auto vacant = static_cast<std::int32_t>(massless.size());
    ColumnMatrix level = level_matrix(rows_, choice_, choice_.velocity_active, choice_.has_rate, square, vacant);
    if (!square) return;
    if (vacant > 0) {
      std::vector<Triplet> entries;
      for_each_entry(level, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
      std::int32_t r = n_ - vacant;
      for (const std::int32_t c : massless) entries.push_back({r++, c, 1 / scale(c)});
      level = compressed(n_, n_, entries);
    }
    rates_known_ = rates_.factor(level);
  }

  double scale(std::int32_t coordinate) const { return scale_[static_cast<std::size_t>(coordinate)]; }
  static std::size_t at(PartialBy family) { return static_cast<std::size_t>(family); }
  double unit(PartialBy family, std::int32_t column) const {
    return at(family) <= at(PartialBy::acceleration) ? scale(column) : 1.0;
  }

  void sort_elements(const ElementTrace& trace, bool without_damping) {
    std::map<std::int32_t, std::size_t> of_row;  // constraint row -> element
    for (std::size_t e = 0; e < trace.elements.size(); ++e) {
      const ElementTrace::Element& noted = trace.elements[e];
      Element* element = nullptr;
      const auto known = noted.row_count > 0 ? of_row.find(noted.first_row) : of_row.end();
      if (known != of_row.end()) {
        element = &elements_[known->second];
      } else {
        for (std::int32_t r = 0; r < noted.row_count; ++r) of_row[noted.first_row + r] = elements_.size();
        element = &elements_.emplace_back();
        for (std::int32_t r = 0; r < noted.row_count; ++r) element->reactions.push_back(noted.first_row + r);
      }
      for (std::size_t k = noted.first_partial; k < trace.end_of_partials(e); ++k) {
        const ElementTrace::Partial& p = trace.partials[k];
        if (without_damping && p.family == PartialBy::damping) continue;
        if (!std::isfinite(p.value)) continue;  // of functions without a derivative: nothing comes of them
        if (p.row < n_) {
          element->partials.push_back({p.family, p.row, p.column, p.value});
        } else {
          read(p, trace);
        }
      }
      for (std::size_t k = noted.first_load; k < trace.end_of_loads(e); ++k) {
        element->load[trace.loads[k].row] += trace.loads[k].value;
      }
    }
  }

  void read(const ElementTrace::Partial& p, const ElementTrace& trace) {
    const std::int32_t unknown = p.row - n_;
    if (p.family == PartialBy::algebraic && p.column == unknown) return;  // what the equation defines
    if (p.family == PartialBy::state_rate && p.column == unknown - w_) return;
    std::vector<Reading>& readings = readings_[p.row];
    const Entry entry{p.family, p.row, p.column, p.value};
    const bool part_of_term = at(p.family) <= at(PartialBy::acceleration) && p.term >= 0;
    if (part_of_term && !readings.empty() && last_term_ == p.term) {
      readings.back().partials.push_back(entry);
    } else {
      readings.push_back({{entry}, part_of_term ? trace.coefficients[static_cast<std::size_t>(p.term)] : p.value});
    }
    last_term_ = part_of_term ? p.term : -1;
  }

  // Which states act on bodies, and which algebraic unknowns bodies or such states read directly.
  void find_driven(const Equations& eq) {
    std::vector<bool> acts(static_cast<std::size_t>(eq.size()), false);  // equations that bodies depend on
    for (std::int32_t r = 0; r < n_; ++r) acts[static_cast<std::size_t>(r)] = true;
    const auto owner_of = [&](PartialBy family, std::int32_t c) -> std::int32_t {
      if (family == PartialBy::algebraic) return n_ + c;
      return family == PartialBy::state || family == PartialBy::state_rate ? n_ + w_ + c : -1;
    };
    for (bool changed = true; changed;) {
      changed = false;
      for (const PartialBy family : {PartialBy::algebraic, PartialBy::state, PartialBy::state_rate}) {
        for_each_entry(eq.matrix(family), [&](std::int32_t r, std::int32_t c, double v) {
          const auto owner = static_cast<std::size_t>(owner_of(family, c));
          if (v == 0.0 || !acts[static_cast<std::size_t>(r)] || acts[owner]) return;
          acts[owner] = changed = true;
        });
      }
    }
    for (std::size_t k = 0; k < state_count_; ++k) driven_.push_back(!acts[static_cast<std::size_t>(n_ + w_) + k]);
    for_each_entry(eq.matrix(PartialBy::algebraic), [&](std::int32_t r, std::int32_t c, double v) {
      if (r < n_ && v != 0.0) held_rows_.push_back(n_ + c);
    });
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(state_count_); ++k) {
      if (!driven_[static_cast<std::size_t>(k)]) held_rows_.push_back(n_ + w_ + k);
    }
    std::sort(held_rows_.begin(), held_rows_.end());
    held_rows_.erase(std::unique(held_rows_.begin(), held_rows_.end()), held_rows_.end());
  }

  Directions directions(const Matrix& earlier) const {
    const Index n = choice_.size(), free = static_cast<Index>(positions_.size()), more = earlier.cols();
    Directions d;
    d.states = Matrix::Zero(n, free + more);
    d.rates_of_states = d.states;
    for (Index k = 0; k < free; ++k) d.states(positions_[static_cast<std::size_t>(k)], k) = 1;
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      if (rates_of_positions_[k] >= 0) d.states.row(rates_of_positions_[k]).tail(more) = earlier.row(positions_[k]);
    }
    d.rates_of_states.rightCols(more) = earlier;
    set_changes(d);
    // Every column in units of the largest thing that it moves. Velocities displace condensed freedoms without mass
    // only, by rounding if they are a rigid motion.
    Eigen::VectorXd factor = Eigen::VectorXd::Ones(free + more);
    for (Index c = 0; c < factor.size(); ++c) {
      double size = 0;
      for (const PartialBy family : {PartialBy::position, PartialBy::velocity}) {
        if (family == PartialBy::position && c >= free) continue;
        for (std::int32_t k = 0; k < n_; ++k) size = std::max(size, std::abs(d.change[at(family)](k, c)) / scale(k));
        if (size > 0) break;
      }
      if (size > 0) factor(c) = 1 / size;
    }
    d.states = d.states * factor.asDiagonal();
    d.rates_of_states = d.rates_of_states * factor.asDiagonal();
    for (RowMajor& m : d.change) m = m * factor.asDiagonal();
    for (std::size_t f = 0; f < column_families; ++f) {
      for (Index k = 0; k < d.change[f].rows(); ++k) {
        if (d.change[f].cols() == 0) continue;
        const double u = unit(static_cast<PartialBy>(f), static_cast<std::int32_t>(k));
        d.size[f] = std::max(d.size[f], d.change[f].row(k).cwiseAbs().maxCoeff() / u);
      }
    }
    return d;
  }

  void set_changes(Directions& d) const {
    const Index free = static_cast<Index>(positions_.size()), more = d.states.cols() - free;
    std::vector<Index> at_positions(positions_.begin(), positions_.end());
    const auto image = [&](const Matrix& m) {
      Matrix out(m.rows(), d.states.cols());
      out << columns_of(m, at_positions), m * d.states.rightCols(more);
      return out;
    };
    const Matrix dq = image(dq_), dqdot = image(dqdot_);
    Matrix right = Matrix::Zero(n_, d.states.cols());
    Index r = 0;
    const auto row_of = [&](const auto& row) {
      for (const auto& e : row) right.row(r) -= e.c.a1 * dqdot.row(e.column) + e.c.a0 * dq.row(e.column);
    };
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (!choice_.velocity_active[static_cast<std::size_t>(k)]) continue;
      row_of(rows_.row(k));
      ++r;
    }
    for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
      if (!choice_.has_rate[k]) continue;
      right.row(r) = d.rates_of_states.row(choice_.rate_state[k]);
      row_of(choice_.gradient[k]);
      ++r;
    }
    rates_.solve(right);
    d.change[at(PartialBy::position)] = dq;
    d.change[at(PartialBy::velocity)] = d.change[at(PartialBy::damping)] = dqdot;
    d.change[at(PartialBy::acceleration)] = right;
    d.change[at(PartialBy::lambda)] = image(dlambda_);
    d.change[at(PartialBy::algebraic)] = image(dw_);
    const Index states = static_cast<Index>(state_count_);
    d.change[at(PartialBy::state)] = d.change[at(PartialBy::state_rate)] = RowMajor::Zero(states, d.states.cols());
  }

  // Coordinates without a rate of their own change as the others make them; that must be what is wanted.
  void add_rates_that_follow(const Directions& d, std::vector<Eigen::RowVectorXd>& rows) const {
    for (std::size_t k = 0; k < choice_.gradient.size(); ++k) {
      if (choice_.has_rate[k] || choice_.position_state[k] < 0) continue;
      Eigen::RowVectorXd sum = -d.rates_of_states.row(choice_.position_state[k]);
      double size = sum.cwiseAbs().maxCoeff();
      for (const auto& e : choice_.gradient[k]) {
        sum += e.c.g * d.change[at(PartialBy::velocity)].row(e.column) +
               e.c.v * d.change[at(PartialBy::position)].row(e.column);
        const double u = scale(e.column);
        size = std::max({size, std::abs(e.c.g) * u * d.size[at(PartialBy::velocity)],
                         std::abs(e.c.v) * u * d.size[at(PartialBy::position)]});
      }
      if (size > 0) rows.push_back(sum / size);
    }
  }

  // What a held equation reads stays what it is, quantity by quantity; those that are taken with equal weight may
  // change together, as two displacements whose difference is meant.
  void add_readings(const Directions& d, std::vector<Eigen::RowVectorXd>& rows) const {
    for (const std::int32_t row : held_rows_) {
      const auto found = readings_.find(row);
      if (found == readings_.end()) continue;
      std::map<double, std::pair<Eigen::RowVectorXd, double>> groups;  // by weight: change and size
      for (const Reading& reading : found->second) {
        if (reading.coefficient == 0.0 || !std::isfinite(reading.coefficient)) continue;
        auto& [sum, size] =
            groups.try_emplace(std::abs(reading.coefficient), Eigen::RowVectorXd::Zero(d.states.cols()), 0.0)
                .first->second;
        for (const Entry& p : reading.partials) {
          sum += p.value * d.change[at(p.family)].row(p.column);
          size = std::max(size, std::abs(p.value) * size_of(d, p));
        }
      }
      for (const auto& [weight, group] : groups) {
        if (group.second > 0) rows.push_back(group.first / group.second);
      }
    }
  }

  double size_of(const Directions& d, const Entry& p) const {
    // A quantity that is itself defined by an equation is as exact as what it is made of.
    if (p.family == PartialBy::algebraic) return size_of_algebraic(d, p.column, 0);
    if (p.family == PartialBy::lambda) return d.change[at(p.family)].row(p.column).cwiseAbs().maxCoeff();
    return unit(p.family, p.column) * d.size[at(p.family)];
  }
  double size_of_algebraic(const Directions& d, std::int32_t unknown, int depth) const {
    double size = d.change[at(PartialBy::algebraic)].row(unknown).cwiseAbs().maxCoeff();
    const auto found = readings_.find(n_ + unknown);
    if (found == readings_.end() || depth > 8) return size;
    for (const Reading& reading : found->second) {
      for (const Entry& p : reading.partials) {
        size = std::max(
            size, std::abs(p.value) *
                      (p.family == PartialBy::algebraic ? size_of_algebraic(d, p.column, depth + 1) : size_of(d, p)));
      }
    }
    return size;
  }

  // Rows of one element on one body, force then moment by length, in units of its size.
  struct OnBody {
    Matrix change;                                    // 6 × directions
    Vector6 load;                                     // force and moment by length
    Matrix reactions;                                 // 6 × multipliers that are its own
    Vector6 sums;                                     // of the sizes of what makes up the change
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  // of the BCS
    bool turns = true;
    double size = 0;
  };

  void add_forces(const Directions& d, std::vector<Eigen::RowVectorXd>& rows) const {
    std::map<std::int32_t, std::vector<OnBody>> bodies;
    std::vector<std::int32_t> group(bodies_.size());  // of bodies that elements connect
    std::iota(group.begin(), group.end(), 0);
    const auto root = [&](std::int32_t b) {
      while (group[static_cast<std::size_t>(b)] != b) b = group[static_cast<std::size_t>(b)];
      return b;
    };
    const double L = length_;
    for (const Element& e : elements_) {
      std::map<std::int32_t, OnBody> touched;
      std::map<std::int32_t, std::pair<Eigen::RowVectorXd, double>> alone;  // coordinates outside bodies
      const auto place = [&](std::int32_t row) -> OnBody& {
        const std::int32_t b = body_of_[static_cast<std::size_t>(row)];
        OnBody& on = touched[b];
        if (on.change.size() == 0) {
          on.change = Matrix::Zero(6, d.states.cols());
          on.load.setZero();
          on.sums.setZero();
          on.reactions = Matrix::Zero(6, static_cast<Index>(e.reactions.size()));
        }
        return on;
      };
      const auto spot = [&](std::int32_t row) -> std::pair<Index, double> {
        const std::int32_t k = row - bodies_[static_cast<std::size_t>(body_of_[static_cast<std::size_t>(row)])].offset;
        return {k, k < 3 ? 1.0 : 1 / L};
      };
      for (const Entry& p : e.partials) {
        const Eigen::RowVectorXd change = p.value * d.change[at(p.family)].row(p.column);
        const double size = std::abs(p.value) * size_of(d, p);
        if (body_of_[static_cast<std::size_t>(p.row)] < 0) {
          auto& [sum, largest] = alone.try_emplace(p.row, Eigen::RowVectorXd::Zero(d.states.cols()), 0.0).first->second;
          sum += change;
          largest += size;
          continue;
        }
        OnBody& on = place(p.row);
        const auto [k, factor] = spot(p.row);
        on.change.row(k) += factor * change;
        on.sums(k) += factor * size;
      }
      for (const auto& [row, load] : e.load) {
        if (load == 0.0 || body_of_[static_cast<std::size_t>(row)] < 0) continue;
        OnBody& on = place(row);
        const auto [k, factor] = spot(row);
        on.load(k) += factor * load;
      }
      for (std::size_t r = 0; r < e.reactions.size(); ++r) {
        for (const auto& entry : rows_.row(e.reactions[r])) {
          const std::int32_t b = body_of_[static_cast<std::size_t>(entry.column)];
          const auto on = touched.find(b);
          if (b < 0 || on == touched.end()) continue;
          const auto [k, factor] = spot(entry.column);
          on->second.reactions(k, static_cast<Index>(r)) += factor * entry.c.g;
        }
      }
      for (auto& [b, on] : touched) {
        group[static_cast<std::size_t>(root(b))] = root(touched.begin()->first);
        on.size = std::max(on.sums.maxCoeff(), on.load.cwiseAbs().maxCoeff());
        if (on.size > 0) bodies[b].push_back(std::move(on));
      }
      // A coordinate outside bodies belongs to one element, whose reactions balance there.
      if (e.reactions.empty()) {
        for (const auto& [row, sum] : alone) {
          if (sum.second > 0) rows.push_back(sum.first / sum.second);
        }
      }
    }
    std::map<std::int32_t, std::vector<const OnBody*>> groups;
    for (auto& [b, list] : bodies) {
      for (OnBody& on : list) {
        see_from_fixed_points(d, b, on);
        groups[root(b)].push_back(&on);
      }
    }
    for (const auto& [first, on] : groups) add_group(on, place_of(first), d.states.cols(), rows);
  }

  Eigen::Vector3d place_of(std::int32_t body) const { return places_[static_cast<std::size_t>(body)]; }

  // Moments are about the BCS, which moves: about the point where it was they change by δr × f more.
  void see_from_fixed_points(const Directions& d, std::int32_t b, OnBody& on) const {
    const BodyBlock& block = bodies_[static_cast<std::size_t>(b)];
    on.place = place_of(b);
    on.turns = block.count == 6;
    if (!on.turns) return;
    const auto moved = d.change[at(PartialBy::position)].middleRows(block.offset, 3);
    on.change.bottomRows(3) -= cross_matrix(on.load.head<3>()) * moved / length_;
  }

  // δW − τ × W of all that acts on bodies that elements connect, reactions left out along what their own multipliers
  // can do, and the best τ taken out.
  void add_group(const std::vector<const OnBody*>& on, const Eigen::Vector3d& origin, Index directions,
                 std::vector<Eigen::RowVectorXd>& rows) const {
    const Index count = static_cast<Index>(on.size());
    Matrix carried = Matrix::Zero(6 * count + 6, 6), change = Matrix::Zero(6 * count + 6, directions);
    for (Index e = 0; e < count; ++e) {
      const OnBody& part = *on[static_cast<std::size_t>(e)];
      const Eigen::Vector3d f = part.load.head<3>(), t = part.load.tail<3>();
      const Eigen::Matrix3d of_f = cross_matrix(f);
      Eigen::Matrix<double, 6, 6> by_motion = Eigen::Matrix<double, 6, 6>::Zero();  // of (turn, displacement by length)
      by_motion.block<3, 3>(0, 0) = -of_f;
      if (part.turns) {
        by_motion.block<3, 3>(3, 0) = -cross_matrix(t) + of_f * cross_matrix((part.place - origin) / length_);
        by_motion.block<3, 3>(3, 3) = -of_f;
      }
      Matrix left = Matrix::Identity(6, 6);
      if (part.reactions.cols() > 0 && !part.reactions.isZero(0)) {
        Matrix g = part.reactions;
        for (Index c = 0; c < g.cols(); ++c) {
          if (const double s = g.col(c).norm(); s > 0) g.col(c) /= s;
        }
        const Eigen::ColPivHouseholderQR<Matrix> qr(g);
        Matrix Q = qr.householderQ() * Matrix::Identity(6, qr.rank());
        left -= Q * Q.transpose();
      }
      carried.middleRows(6 * e, 6) = left * by_motion / part.size;
      change.middleRows(6 * e, 6) = left * part.change / part.size;
    }
    // Axes move about as far as bodies do: no load so small that only a long way would explain a change.
    carried.bottomRows(6) = 1e-2 * vanishing * Matrix::Identity(6, 6);
    const Eigen::HouseholderQR<Matrix> qr(carried);
    change.applyOnTheLeft(qr.householderQ().adjoint());
    change.topRows(6).setZero();
    change.applyOnTheLeft(qr.householderQ());
    for (Index r = 0; r < 6 * count; ++r) rows.push_back(change.row(r));
  }
  static Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0, -v(2), v(1), v(2), 0, -v(0), -v(1), v(0), 0;
    return m;
  }

  // What directions have beyond the span of earlier ones: coordinates, rates and differential states in units of the
  // largest of their kind.
  Matrix without(const Matrix& earlier, const Matrix& found) const {
    Matrix all(found.rows(), earlier.cols() + found.cols());
    all << earlier, found;
    std::array<double, 3> unit{};
    const auto kind = [&](Index k) -> double& {
      return unit[k >= choice_.first_differential ? 2 : choice_.states[static_cast<std::size_t>(k)].is_rate ? 1 : 0];
    };
    for (Index k = 0; k < all.rows() && all.cols() > 0; ++k)
      kind(k) = std::max(kind(k), all.row(k).cwiseAbs().maxCoeff());
    for (Index k = 0; k < all.rows(); ++k) {
      if (kind(k) > 0) all.row(k) /= kind(k);
    }
    Matrix fresh = all.rightCols(found.cols());
    fresh.colwise().normalize();
    if (earlier.cols() > 0) {
      const Eigen::ColPivHouseholderQR<Matrix> known(all.leftCols(earlier.cols()));
      const Matrix Q = known.householderQ() * Matrix::Identity(all.rows(), known.rank());
      for (int pass = 0; pass < 2; ++pass) fresh -= Q * (Q.transpose() * fresh);
    }
    if (fresh.cols() == 0 || !fresh.allFinite()) return Matrix(found.rows(), 0);
    const Eigen::ColPivHouseholderQR<Matrix> qr(fresh);
    Index rank = 0;
    while (rank < std::min(fresh.rows(), fresh.cols()) && std::abs(qr.matrixR()(rank, rank)) > 1e-6) ++rank;
    fresh = (fresh * qr.colsPermutation()).leftCols(rank).eval();
    for (Index k = 0; k < fresh.rows(); ++k) {
      if (kind(k) > 0) fresh.row(k) *= kind(k);
    }
    return fresh;
  }

  const std::vector<BodyBlock> bodies_;
  const double length_;
  const std::size_t state_count_;
  std::vector<double> scale_;            // of coordinates
  std::vector<Eigen::Vector3d> places_;  // of the BCS of bodies
  const ConstraintRows rows_;
  const StateChoice choice_;
  const std::int32_t n_, w_;
  const Matrix dq_, dqdot_, dlambda_, dw_;
  std::vector<std::int32_t> positions_;           // states that are coordinates
  std::vector<std::int32_t> rates_of_positions_;  // −1 for those without
  std::vector<std::int32_t> body_of_;             // rows of the balance, −1 outside bodies
  SparseLu rates_;
  bool rates_known_ = false;
  std::vector<Element> elements_;
  std::map<std::int32_t, std::vector<Reading>> readings_;  // by equation
  std::vector<std::int32_t> held_rows_;  // of algebraic unknowns that act on bodies, and of states that do
  std::vector<bool> driven_;
  std::int32_t last_term_ = -1;
};

StructuralZeros::StructuralZeros(const System& system, const Motion& motion, ConstraintRows rows,
                                 const ElementTrace& trace, const Equations& eq, const StateChoice& choice,
                                 const LinearSystem& motions, bool without_damping,
                                 const std::vector<std::int32_t>& massless)
    : driven_(static_cast<std::size_t>(choice.size()), false),
      contributions_(std::make_unique<const Contributions>(system, motion, std::move(rows), trace, eq, choice, motions,
                                                           without_damping, massless)) {
  for (std::size_t k = 0; k < choice.differential.size(); ++k) {
    driven_[static_cast<std::size_t>(choice.first_differential) + k] =
        contributions_->driven_states()[static_cast<std::size_t>(choice.differential[k])];
  }
}

StructuralZeros::~StructuralZeros() = default;

Eigen::MatrixXd StructuralZeros::beyond(const Eigen::MatrixXd& earlier) const {
  return contributions_->beyond(earlier);
}

}  // namespace dynalin
