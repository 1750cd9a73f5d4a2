// Where elements put what they contribute: constraint rows, residuals and their partial derivatives.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/partials.h"
#include "expression/expression.h"
#include "mechanics/accumulator.h"
#include "mechanics/element_trace.h"
#include "mechanics/layout.h"
#include "mechanics/pair_motion.h"

namespace dynalin {

struct ExpressionScratch {
  ExpressionWorkspace<double> plain;
  ExpressionWorkspace<Taylor> taylor;
  std::vector<double> atoms, partials;
  std::vector<Taylor> taylor_atoms, taylor_partials;
  std::vector<std::array<double, 12>> gradients;
};

// What a constraint row contributes in one coordinate at the levels above its own.
//
//   position row Φ(q,t):     δΦ = g δq,   δΦ′ = g δq′ + v δq,   δΦ″ = g δq″ + a1 δq′ + a0 δq
//                            with g = Φ_q, v = Φ_q′, a1 = 2 Φ_q′, a0 = Φ_q″
//   velocity row Ψ(q,q′,t):  δΨ = g δq′ + v δq,                 δΨ′ = g δq″ + a1 δq′ + a0 δq
//                            with g = Ψ_q′, v = Ψ_q, a1 = Ψ_q + (Ψ_q′)′, a0 = (Ψ_q)′
struct RowCoefficients {
  double g = 0, v = 0, a1 = 0, a0 = 0;
};

// All constraint rows: values at every level and sparse coefficients, stored by rows.
class ConstraintRows {
 public:
  void resize(const Layout& layout) { resize(layout, layout.row_count()); }
  // `count` rows that need not be those of the layout, such as gradients of chosen coordinates.
  void resize(const Layout&, std::size_t count);
  void begin() { scratch_row_ = -1; }

  // Value, rate and acceleration of a position row; of a velocity row Ψ, Ψ′ and nothing.
  void set(std::int32_t row, const Taylor& along_motion) { value_[static_cast<std::size_t>(row)] = along_motion; }
  void add(std::int32_t row, std::int32_t column, const RowCoefficients& c) {
    Entry& e = entry(row, column);
    e.c.g += c.g, e.c.v += c.v, e.c.a1 += c.a1, e.c.a0 += c.a0;
    e.size_of_g += static_cast<float>(std::abs(c.g));
  }
  // Gradient of a position row with respect to the pose of a body, along the motion.
  void add_pose(std::int32_t row, BodyId body, const Vec3<Taylor>& on_r, const Vec3<Taylor>& on_theta);
  void add_coordinate(std::int32_t row, std::int32_t column, const Taylor& g) { accumulate(entry(row, column), g); }

  // There are no further passes: places that nothing was added to go.
  void settle();

  // Makes a row empty: it holds nothing.
  void drop(std::int32_t row) {
    value_[static_cast<std::size_t>(row)] = Taylor();
    for (Entry& e : rows_[static_cast<std::size_t>(row)]) e = {.column = e.column};
  }

  struct Entry {
    std::int32_t column;
    float size_of_g = 0;  // of all that was added up to g, which may have cancelled
    RowCoefficients c{};
  };
  std::span<const Entry> row(std::int32_t k) const { return rows_[static_cast<std::size_t>(k)]; }
  const Taylor& along_motion(std::int32_t k) const { return value_[static_cast<std::size_t>(k)]; }
  std::int32_t size() const { return static_cast<std::int32_t>(rows_.size()); }
  const Layout& layout() const { return *layout_; }
  // Rows beyond those of the layout are on positions.
  RowLevel level(std::int32_t k) const {
    const auto at = static_cast<std::size_t>(k);
    return at < layout_->rows.size() ? layout_->rows[at].level : RowLevel::position;
  }

  ExpressionScratch scratch;

 private:
  static void accumulate(Entry& e, const Taylor& g) {
    e.c.g += g.value, e.c.v += g.rate, e.c.a1 += 2.0 * g.rate, e.c.a0 += g.acceleration;
    e.size_of_g += static_cast<float>(std::abs(g.value));
  }
  Entry& entry(std::int32_t row, std::int32_t column);

  const Layout* layout_ = nullptr;
  std::vector<Taylor> value_;
  std::vector<std::vector<Entry>> rows_;
  std::int32_t scratch_row_ = -1;
};

// The unknown a partial derivative is taken with respect to.
enum class PartialBy : std::uint8_t {
  position,      // δq
  velocity,      // δq′: inertia, constraints and controllers
  damping,       // δq′: forces and VARIABLEs, what NODAMPIN leaves out
  acceleration,  // δq″
  lambda,
  algebraic,
  state,
  state_rate,
};
inline constexpr std::size_t column_families = 8;

// Places of elements from `first` on and before `last`, to be walked through: std::views::iota, which clang 14 does not
// compile.
struct ElementRange {
  std::size_t first = 0, last = 0;

  struct Place {
    std::size_t k;
    std::size_t operator*() const { return k; }
    Place& operator++() {
      ++k;
      return *this;
    }
    bool operator==(const Place&) const = default;
  };
  Place begin() const { return {first}; }
  Place end() const { return {last}; }
};

// What one share of a pass adds, in its order, until it is its turn (Equations::take).
struct Contributions {
  struct Residual {
    std::int32_t row;
    double value, size;
  };
  struct Run {
    PartialBy family;
    std::int32_t row, column;
    std::uint32_t count, sizes;
  };
  std::vector<Residual> residuals;
  std::vector<Run> runs;
  std::vector<double> values;  // of all runs, those of each before its sizes

  void clear() { residuals.clear(), runs.clear(), values.clear(); }
};

// Residuals of the force balance (one row a coordinate: inertia − applied − reactions = 0), of the algebraic
// equations (w − g = 0) and of the differential ones (z′ − f = 0), in this order, and their partials.
class Equations {
 public:
  void resize(const Layout&);
  // The partials of later passes come with the sizes of what was added up to them.
  void keep_sizes();
  void begin(std::initializer_list<PartialBy> wanted);
  void finish();  // builds patterns after a recording pass
  bool needs_second_pass() const { return recording_; }
  // There are no further passes: of a large model the room that they need is a good part of all.
  void settle();

  // Where several threads share a pass, each evaluates shares of the elements of a kernel, in an object of its own that
  // keeps what is added; taken share by share in order, it gives the sums of a single thread to the last bit.
  struct Share {
    std::size_t number = 0, of = 1;
  };
  void become_share_of(const Equations& whole, Share);
  void take(const Contributions&);
  const Contributions& contributions() const { return kept_; }
  // Of the elements of a kernel those that are evaluated now: all, if it shares its work with nobody. Their places, or
  // themselves.
  ElementRange share(std::size_t elements) const {
    return {elements * share_.number / share_.of, elements * (share_.number + 1) / share_.of};
  }
  template <class Element>
  std::span<const Element> share(const std::vector<Element>& all) const {
    const ElementRange places = share(all.size());
    return std::span(all).subspan(places.first, places.last - places.first);
  }
  // Where shares are evaluated, kept with their memory from pass to pass.
  std::vector<Equations>& desks(std::size_t count) {
    desks_.resize(count);
    return desks_;
  }
  // Where they are noted, for what an element knows beyond what it adds.
  ElementTrace* noted() const { return wants_any_ ? trace_ : nullptr; }
  // What each element adds on its own can only be told one after the other.
  bool can_be_shared() const { return !trace_; }

  // Later passes also note what each element adds on its own.
  void note_elements(ElementTrace* trace) { trace_ = trace; }
  // What follows is added by another element, whose label outlives the trace.
  void begin_element(const ElementLabel& of) {
    if (trace_) trace_->begin(&of, -1, 0);
  }
  // The same for one that holds constraint rows: their reactions belong to it.
  void begin_constraint(std::int32_t first_row, std::int32_t row_count = 1) {
    if (trace_) trace_->begin(layout_->rows[static_cast<std::size_t>(first_row)].owner, first_row, row_count);
  }

  // What follows, until the next call, is one quantity that an algebraic or differential equation reads, times the
  // coefficient.
  void begin_term(double coefficient) {
    if (!trace_) return;
    trace_->term = static_cast<std::int32_t>(trace_->coefficients.size());
    trace_->coefficients.push_back(coefficient);
  }
  void end_terms() {
    if (trace_) trace_->term = -1;
  }

  bool wants(PartialBy c) const { return wanted_[static_cast<std::size_t>(c)]; }
  bool wants_partials() const { return wants_any_; }
  Partials wanted_partials() const { return wants_any_ ? Partials::yes : Partials::no; }

  std::int32_t algebraic_row(std::int32_t k) const { return layout_->coordinate_count + k; }
  std::int32_t state_row(std::int32_t k) const {
    return algebraic_row(static_cast<std::int32_t>(layout_->algebraic.size())) + k;
  }

  void add_residual(std::int32_t row, double value) { add_residual(row, value, std::abs(value)); }
  // `size` is what the value has been added up from.
  void add_residual(std::int32_t row, double value, double size) {
    if (keeps_) return kept_.residuals.push_back({row, value, size});
    if (trace_ && row < layout_->coordinate_count) trace_->loads.push_back({row, value, size});
    residual_[static_cast<std::size_t>(row)] += value;
    magnitude_[static_cast<std::size_t>(row)] += size;
  }
  // Force and moment about the BCS origin that act against a body's inertia, global axes. A component has been added up
  // from itself and what cancels in any of them, `cancelled` in size.
  struct Cancelled {
    double force, moment;
  };
  void apply_inertia(BodyId body, const Vector& force, const Vector& moment, const Cancelled& cancelled);
  // The same of a force at a point, `arm` from the BCS origin, and a torque: what makes the moment may cancel, and
  // so may what the torque has been added up from, `cancelled` in size.
  void apply_at(BodyId body, const Vector& arm, const Vector& force, const Vector& torque, double cancelled = 0);
  void add(PartialBy family, std::int32_t row, std::int32_t column, double value) {
    add(family, row, column, {&value, 1});
  }
  // `sizes` are what the values have been added up from, nothing if they are what they are.
  void add(PartialBy family, std::int32_t row, std::int32_t column, std::span<const double> values,
           std::span<const double> sizes = {}) {
    if (!wants(family)) return;
    if (keeps_) return keep(family, row, column, values, sizes);
    if (trace_) note(family, row, column, values);
    matrices_[static_cast<std::size_t>(family)].add(row, column, values, sizes);
  }
  bool keeps_sizes() const { return keeps_sizes_; }
  // Coordinates side by side, of which each has a column of a block.
  struct Columns {
    std::int32_t first;
    std::size_t count = 3;
  };
  struct Block {
    Matrix3 force, moment;
  };
  // Partials of force and moment on `on` with respect to these, times `factor`.
  void add_block(PartialBy family, BodyId on, Columns, const Block&, double factor);
  // The same with what they have been added up from; asked for where sizes are kept.
  void add_block(PartialBy family, BodyId on, Columns, const Block&, const Block& sizes, double factor);
  // The same with respect to one scalar unknown.
  void add_column(PartialBy family, BodyId on, std::int32_t column, const Vector& force, const Vector& moment,
                  double factor = -1.0);

  // Partials that are no finite numbers, of functions without a derivative here. They become zero: an iteration does
  // without them, a linear model only if nothing comes of them.
  struct Undefined {
    PartialBy family;
    std::int32_t row, column;
  };
  std::vector<Undefined> clear_undefined();
  // Those that have cancelled but for rounding, of which an iteration would make stiffness; sizes must be kept.
  void clear_rounding(PartialBy family) { matrices_[static_cast<std::size_t>(family)].clear_rounding(); }

  std::span<const double> residual() const { return residual_; }
  std::span<double> residual() { return residual_; }
  // Sum of the sizes of all that was added to a row: what its rounding is measured against.
  std::span<const double> magnitude() const { return magnitude_; }
  const ColumnMatrix& matrix(PartialBy c) const { return matrices_[static_cast<std::size_t>(c)].matrix(); }
  std::span<const double> sizes(PartialBy c) const { return matrices_[static_cast<std::size_t>(c)].sizes(); }
  std::int32_t size() const { return static_cast<std::int32_t>(residual_.size()); }
  const Layout& layout() const { return *layout_; }

  ExpressionScratch scratch;
  PairScratch pair_scratch;

 private:
  void note(PartialBy, std::int32_t row, std::int32_t column, std::span<const double> values);
  void keep(PartialBy family, std::int32_t row, std::int32_t column, std::span<const double> values,
            std::span<const double> sizes) {
    kept_.runs.push_back(
        {family, row, column, static_cast<std::uint32_t>(values.size()), static_cast<std::uint32_t>(sizes.size())});
    kept_.values.insert(kept_.values.end(), values.begin(), values.end());
    kept_.values.insert(kept_.values.end(), sizes.begin(), sizes.end());
  }

  const Layout* layout_ = nullptr;
  ElementTrace* trace_ = nullptr;
  std::vector<double> residual_, magnitude_;
  std::array<Accumulator, column_families> matrices_;
  std::array<bool, column_families> wanted_{};
  bool wants_any_ = false;
  bool recording_ = false;
  bool keeps_sizes_ = false;
  Share share_;
  bool keeps_ = false;  // what is added, for another to take
  Contributions kept_;
  std::vector<Equations> desks_;
};

}  // namespace dynalin
