#include "system/system.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "elements/controls/array.h"
#include "elements/controls/spline.h"
#include "elements/controls/variable_list.h"

namespace dynalin {

class System::SystemSignals final : public Signals {
 public:
  SystemSignals(System& system, DelayKernel& delays)
      : system_(system), delays_(delays), kernel_of_set_(system.model_->sets.size(), nullptr) {}

  void own(std::size_t set, const Kernel* kernel) { kernel_of_set_[set] = kernel; }

  // Which elements hold each marker, for the sums FX … TM.
  void index_markers() {
    at_marker_.resize(system_.layout_.markers.size());
    for (std::size_t s = 0; s < kernel_of_set_.size(); ++s) {
      const Kernel* kernel = kernel_of_set_[s];
      if (!kernel || !kernel->has_wrench()) continue;
      for (std::size_t k = 0; k < kernel->wrench_count(system_.model_->sets[s]->size()); ++k) {
        const MarkerId i = kernel->marker_I(k), j = kernel->marker_J(k);
        at_marker_[static_cast<std::size_t>(i.index)].push_back({kernel, k});
        if (!(i == j)) at_marker_[static_cast<std::size_t>(j.index)].push_back({kernel, k});
      }
    }
  }

  const Layout& layout() const override { return system_.layout_; }
  MarkerId marker(std::int64_t id) const override { return system_.model_->find_marker(id).value_or(global_frame); }
  MarkerId place_of(MarkerId m) const override {
    const MarkerId followed = system_.model_->marker(m).follows;
    return followed.valid() ? followed : m;
  }
  bool has_place(MarkerId m) const override {
    const Marker& marker = system_.model_->marker(m);
    return !marker.floating || marker.follows.valid() || system_.layout_.curve_point(m);
  }
  Channel variable(VariableRef ref) const override {
    return kernel(ref)->value_channel(static_cast<std::size_t>(ref.index));
  }
  std::size_t array_size(ArrayRef ref) const override { return system_.model_->get<Array>(ref)->entries(); }
  Channel array_entry(ArrayRef ref, std::size_t n) const override {
    const Array& a = *system_.model_->get<Array>(ref);
    if (n >= a.entries()) return {};
    if (a.u) return variable(a.variables[n]);
    if ((a.x || a.y) && !a.owner.valid()) return {};
    if (a.x) return kernel(a.owner)->state_channel(static_cast<std::size_t>(a.owner.index), n);
    if (a.y) return kernel(a.owner)->output_channel(static_cast<std::size_t>(a.owner.index), n);
    return {Channel::Kind::constant, 0, a.numbers[n]};
  }
  Channel data(const Atom& atom) const override {
    const std::string_view name = atom.function->name;
    const auto handle = system_.model_->find(atom.function->statement, atom.argument[0]);
    if (!handle) return {};
    const auto n = static_cast<std::size_t>(atom.argument[1] - 1);
    if (name == "VARVAL") return variable({*handle});
    if (name == "ARYVAL") return array_entry({*handle}, n);
    if (name == "DIF" || name == "DIF1") {
      Channel c = kernel(*handle)->state_channel(static_cast<std::size_t>(handle->index), 0);
      return name == "DIF1" ? rate_of(c) : c;
    }
    const auto* list = system_.model_->get<VariableList>(*handle);  // PINVAL, POUVAL
    return list && n < list->variables.size() ? variable(list->variables[n]) : Channel{};
  }
  Element element(std::string_view statement, std::int64_t id) const override {
    const auto handle = system_.model_->find(statement, id);
    if (!handle) return {};
    return element(*handle);
  }
  Element element(ElementHandle h) const override { return {kernel(h), static_cast<std::size_t>(h.index)}; }
  std::vector<Element> elements_at(MarkerId m) const override { return at_marker_[static_cast<std::size_t>(m.index)]; }
  Channel rate_of(const Channel& c) const override {
    if (c.kind == Channel::Kind::state && !system_.layout_.states[static_cast<std::size_t>(c.index)].held_in_dynamics)
      return {Channel::Kind::state_rate, c.index, 0};
    if (c.kind != Channel::Kind::algebraic) return {Channel::Kind::constant, 0, 0};
    const auto [it, fresh] = rates_.emplace(c.index, -1);
    if (fresh) {
      const ElementLabel& owner = *system_.layout_.algebraic[static_cast<std::size_t>(c.index)].owner;
      it->second = system_.layout_.add_algebraic(owner);
      system_.layout_.algebraic[static_cast<std::size_t>(c.index)].rate = it->second;
      rates_to_make_.emplace_back(c.index, it->second);
    }
    return {Channel::Kind::algebraic, it->second, 0};
  }
  Channel delayed(const Atom& atom) const override {
    return delays_.channel_of(atom, "in " + statement_at(atom.at), system_.layout_);
  }
  void problem(std::string_view code, const Span& at, std::string text, std::string hint) const override {
    system_.layout_.problems.error(code, at, std::move(text), std::move(hint));
  }

  // Equations for the rates that bound expressions asked for; each may ask for more.
  void make_rates() {
    while (!rates_to_make_.empty()) {
      const auto [algebraic, rate] = rates_to_make_.back();
      rates_to_make_.pop_back();
      const bool made =
          std::any_of(system_.kernels_.begin(), system_.kernels_.end(),
                      [&, a = algebraic, r = rate](auto& k) { return k->add_rate_equation(a, r, *this); });
      if (!made) {
        const ElementLabel& owner = *system_.layout_.algebraic[static_cast<std::size_t>(algebraic)].owner;
        problem("unknown-rate", owner.at,
                "a DIF1 or a DELAY needs the time derivative of " + owner.full_text() + ", which is not available",
                "a DELAY needs none as a Padé approximant, run with --pade");
      }
    }
  }

  // Calls of one SPLINE by one method share their curves.
  void attach(SplineUse& use) const override {
    const bool shares = !use.component && !use.spectrum;
    if (shares) use.curves = curves_[{use.id, use.method}];
    if (use.curves) return;
    attach_data(*system_.model_, use);
    if (shares) curves_[{use.id, use.method}] = use.curves;
  }
  std::int32_t add_memory(const Span& owner, double initial) const override {
    return system_.layout_.add_memory(owner, initial);
  }

 private:
  // "SFORCE/3", the statement of the dataset in which something stands.
  std::string statement_at(const Span& at) const {
    const auto& all = system_.model_->dataset->statements;
    // What a command wrote stands elsewhere than its statement.
    for (const Statement& s : all) {
      if (at.source == s.at.source) break;
      for (const WrittenArgument& w : s.arguments) {
        const Span& v = w.value_span;
        if (v.source == at.source && at.offset >= v.offset && at.offset < v.offset + v.length) return text_of(s);
      }
    }
    const auto next = std::upper_bound(all.begin(), all.end(), at.offset,
                                       [](std::uint32_t offset, const Statement& s) { return offset < s.at.offset; });
    if (next == all.begin()) return {};
    return text_of(*std::prev(next));
  }
  static std::string text_of(const Statement& s) {
    return std::string(s.name) + (s.id ? "/" + std::to_string(*s.id) : "");
  }
  const Kernel* kernel(ElementHandle h) const { return kernel_of_set_[static_cast<std::size_t>(h.set)]; }

  System& system_;
  DelayKernel& delays_;
  std::vector<const Kernel*> kernel_of_set_;
  std::vector<std::vector<Element>> at_marker_;
  mutable std::map<std::int32_t, std::int32_t> rates_;  // of algebraic unknowns
  mutable std::vector<std::pair<std::int32_t, std::int32_t>> rates_to_make_;
  mutable std::map<std::pair<std::int64_t, SplineMethod>, std::shared_ptr<const SplineCurves>> curves_;
};

System::System(std::shared_ptr<const Model> model, const SystemOptions& options) : model_(std::move(model)) {
  layout_.bodies.reserve(model_->bodies.size());
  for (const Body& b : model_->bodies) layout_.add_body(b.kind, b.label);
  for (const Body& b : model_->bodies) {
    if (!b.origin_at.valid()) continue;
    layout_.remarks.warning("distant-origin", b.label.at,
                            b.label.full_text() + " has its BCS far from all its markers: the origin of " +
                                model_->marker(b.origin_at).label.full_text() +
                                " is taken instead, and its translations are meant where they are those of the BCS");
  }
  layout_.markers.reserve(model_->markers.size());
  layout_.marker_labels.reserve(model_->markers.size());
  for (const Marker& m : model_->markers) {
    layout_.markers.push_back(m.place);
    layout_.marker_labels.push_back(m.label);
  }
  auto delays = std::make_unique<DelayKernel>(options.delays);
  signals_ = std::make_unique<SystemSignals>(*this, *delays);
  for (std::size_t s = 0; s < model_->sets.size(); ++s) {
    if (model_->sets[s]->size() == 0 || !model_->sets[s]->active) continue;
    if (auto kernel = model_->sets[s]->make_kernel(*model_, layout_)) {
      signals_->own(s, kernel.get());
      kernels_.push_back(std::move(kernel));
    }
  }
  signals_->index_markers();
  for (auto& kernel : kernels_) kernel->bind(*signals_);
  kernels_.push_back(std::move(delays));
  kernels_.back()->bind(*signals_);
  signals_->make_rates();

  for (const auto& kernel : kernels_) {
    const auto own = kernel->starts();
    starts_.insert(starts_.end(), own.begin(), own.end());
  }
  length_ = model_->characteristic_length();
  state_settings(model_->settings.initial_conditions);
  scale_.assign(coordinates(), 1.0);
  std::vector<const BodyBlock*> blocks;
  for (const BodyBlock& b : layout_.bodies) {
    if (b.count == 0) continue;
    blocks.push_back(&b);
    for (std::int32_t k = 0; k < 3; ++k) scale_[static_cast<std::size_t>(b.offset + k)] = length_;
  }
  std::stable_sort(blocks.begin(), blocks.end(),
                   [](const BodyBlock* a, const BodyBlock* b) { return a->label.id < b->label.id; });
  for (const BodyBlock* b : blocks) {
    for (std::int32_t k = 3; k < b->count; ++k) preference_.push_back(b->offset + k);
    for (std::int32_t k = 0; k < 3; ++k) preference_.push_back(b->offset + k);
  }
  for (const ExtraBlock& e : layout_.extras) {
    for (std::int32_t k = 0; k < e.count; ++k) {
      const double speed = e.coordinates[static_cast<std::size_t>(k)].speed;
      if (speed > 0) scale_[static_cast<std::size_t>(e.offset + k)] = length_ / speed;
      preference_.push_back(e.offset + k);
    }
  }
}

System::~System() = default;

const Signals& System::signals() const { return *signals_; }

OperatingPoint System::drawn() const {
  OperatingPoint op;
  op.poses.reserve(model_->bodies.size());
  for (const Body& b : model_->bodies) op.poses.push_back(b.pose);
  for (const ExtraBlock& e : layout_.extras) {
    for (const ExtraCoordinate& c : e.coordinates) op.extra.push_back(c.initial);
  }
  op.velocity.assign(coordinates(), 0.0);
  op.acceleration.assign(coordinates(), 0.0);
  op.lambda.assign(layout_.row_count(), 0.0);
  for (const AlgebraicUnknown& a : layout_.algebraic) op.algebraic.push_back(a.guess);
  for (const DifferentialState& z : layout_.states) op.state.push_back(z.initial);
  for (const DifferentialState& z : layout_.states) op.state_rate.push_back(z.initial_rate);
  op.memory = layout_.memory;
  return op;
}

Motion System::motion(const OperatingPoint& op) const {
  Motion m;
  m.time = op.time;
  m.mode = op.mode;
  m.bodies.resize(layout_.bodies.size());
  const auto vector_at = [](const std::vector<double>& x, std::int32_t k) {
    const auto i = static_cast<std::size_t>(k);
    return Vector{x[i], x[i + 1], x[i + 2]};
  };
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    const BodyBlock& block = layout_.bodies[b];
    const bool moves = block.count > 0, turns = block.count == 6;
    m.bodies[b].set(op.poses[b], moves ? vector_at(op.velocity, block.offset) : Vector{},
                    turns ? vector_at(op.velocity, block.offset + 3) : Vector{},
                    moves ? vector_at(op.acceleration, block.offset) : Vector{},
                    turns ? vector_at(op.acceleration, block.offset + 3) : Vector{});
  }
  const auto first = static_cast<std::ptrdiff_t>(layout_.body_coordinate_count);
  m.extra = op.extra;
  m.extra_rate.assign(op.velocity.begin() + first, op.velocity.end());
  m.extra_acceleration.assign(op.acceleration.begin() + first, op.acceleration.end());
  m.lambda = op.lambda;
  m.algebraic = op.algebraic;
  m.state = op.state;
  m.state_rate = op.state_rate;
  m.memory = op.memory;
  return m;
}

void System::constraints(const Motion& motion, ConstraintRows& rows) const {
  rows.begin();
  for (const auto& kernel : kernels_) kernel->constraints(motion, rows);
}

void System::start_rows(const Motion& motion, std::int32_t first_row, ConstraintRows& rows) const {
  for (const auto& kernel : kernels_) {
    kernel->start_rows(motion, first_row, rows);
    first_row += static_cast<std::int32_t>(kernel->starts().size());
  }
}

void System::equations(const Motion& motion, const ConstraintRows& rows, Equations& eq,
                       std::initializer_list<PartialBy> wanted) const {
  const auto pass = [&] {
    eq.begin(wanted);
    for (const auto& kernel : kernels_) kernel->equations(motion, eq);
  };
  pass();
  if (eq.needs_second_pass()) {
    eq.finish();
    pass();
  }
  // Reactions: the generalized force of row k is λ_k times its gradient.
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    const double lambda = motion.lambda[static_cast<std::size_t>(k)];
    if (lambda == 0.0) continue;
    eq.begin_element(k, 1);
    for (const auto& e : rows.row(k)) eq.add_residual(e.column, -lambda * e.c.g);
  }
}

void System::remember(OperatingPoint& op) const {
  const Motion m = motion(op);
  for (const auto& kernel : kernels_) kernel->remember(m, op.memory);
}

std::vector<UndefinedValue> System::undefined_values(const Motion& motion) const {
  std::vector<UndefinedValue> found;
  for (const auto& kernel : kernels_) kernel->undefined_values(motion, found);
  return found;
}

std::string System::undefined_value(const Motion& motion) const {
  const std::vector<UndefinedValue> found = undefined_values(motion);
  const auto first = std::find_if(found.begin(), found.end(), [](const UndefinedValue& f) { return f.in_value; });
  if (first != found.end()) return first->reason;
  return found.empty() ? std::string() : found.front().reason;
}

std::string System::domain_violation(const Motion& motion) const {
  for (const auto& kernel : kernels_) {
    std::string reason = kernel->domain_violation(motion);
    if (!reason.empty()) return reason;
  }
  return {};
}

SparseRow scaled_row(const System& system, std::span<const ConstraintRows::Entry> entries) {
  SparseRow row;
  row.column.reserve(entries.size());
  row.value.reserve(entries.size());
  for (const auto& e : entries) {
    row.column.push_back(e.column);
    row.value.push_back(e.c.g * system.coordinate_scale(e.column));
  }
  return row;
}

Partition System::partition(const ConstraintRows& rows, bool velocity_rows_too) const {
  std::vector<SparseRow> scaled(static_cast<std::size_t>(rows.size()));
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (velocity_rows_too || rows.level(k) == RowLevel::position) {
      scaled[static_cast<std::size_t>(k)] = scaled_row(*this, rows.row(k));
    }
  }
  const std::vector<std::int32_t> order(preference_.rbegin(), preference_.rend());
  const Elimination e = eliminate(std::move(scaled), layout_.coordinate_count, order);
  Partition p;
  p.smallest_pivot = e.smallest_pivot;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    const bool counts = velocity_rows_too || rows.level(k) == RowLevel::position;
    p.active.push_back(e.pivot_column[static_cast<std::size_t>(k)] >= 0);
    if (counts && !p.active.back()) p.redundant.push_back(k);
  }
  for (const std::int32_t c : preference_) {
    if (!e.dependent[static_cast<std::size_t>(c)]) p.independent.push_back(c);
  }
  return p;
}

std::string System::row_text(std::int32_t row) const {
  if (const auto at = static_cast<std::size_t>(row); at >= layout_.rows.size()) {
    const StartCondition& s = starts_[at - layout_.rows.size()];
    return "the initial " + std::string(s.name) + " of " + s.owner->full_text();
  }
  const ConstraintRow& r = layout_.rows[static_cast<std::size_t>(row)];
  return std::string(r.name) + " in " + r.owner->full_text();
}

}  // namespace dynalin
