#include "system/system.h"

#include <algorithm>
#include <limits>

#include "system/shared_pass.h"
#include "system/signal_table.h"
#include "system/system_binder.h"

namespace dynalin {

tl::expected<std::shared_ptr<const System>, Diagnostics> System::make(std::shared_ptr<const Model> model,
                                                                      const SystemOptions& options) {
  std::shared_ptr<System> system(new System(std::move(model)));
  system->number_bodies();
  system->make_kernels(options);
  if (system->layout_.problems.has_errors()) return tl::unexpected(std::move(system->layout_.problems));
  system->scale_coordinates();
  system->turns_.remember(system->motion(system->drawn()), system->layout_.memory);
  return system;
}

System::System(std::shared_ptr<const Model> model)
    : model_(std::move(model)), signals_(std::make_unique<SignalTable>(*model_, layout_)) {}
System::~System() = default;

void System::number_bodies() {
  layout_.bodies.reserve(model_->bodies.size());
  for (const Body& b : model_->bodies) layout_.add_body(b.kind, b.label, b.nature->listed);
  for (const Body& b : model_->bodies) {
    if (!b.nature->modal.empty()) layout_.add_extra(b.label, b.nature->modal_kind, b.nature->modal);
  }
  for (const Body& b : model_->bodies) {
    if (!b.origin_at.valid()) continue;
    layout_.remarks.warning("distant-origin", b.label.at,
                            b.label.full_text() + " has its BCS far from all its markers: the origin of " +
                                model_->marker(b.origin_at).label->full_text() +
                                " is taken instead, and its translations are meant where they are those of the BCS");
  }
  layout_.markers.reserve(model_->markers.size());
  layout_.marker_labels.reserve(model_->markers.size());
  for (const Marker& m : model_->markers) {
    layout_.markers.push_back(&m.place);
    layout_.marker_labels.push_back(m.label);
  }
}

void System::make_kernels(const SystemOptions& options) {
  for (std::size_t s = 0; s < model_->sets.size(); ++s) {
    if (model_->sets[s]->size() == 0 || !model_->sets[s]->active) continue;
    if (auto kernel = model_->sets[s]->make_kernel(*model_, layout_)) {
      signals_->own(s, *kernel);
      kernels_.push_back(std::move(kernel));
    }
  }
  signals_->index_markers();
  SystemBinder binder(*model_, layout_, *signals_, options.delays);
  binder.bind(kernels_);
  switching_ = binder.take_switching();
  looks_ahead_ = std::ranges::any_of(switching_, [](const BoundExpression& e) { return e.has_tables(); });
  find_angles(options.counted_before);
  for (const auto& kernel : kernels_) {
    if (const SwitchSource* kinks = kernel->kinks())
      (kernel->delays() ? delay_switches_ : switch_sources_).push_back(kinks);
    if (const EventSource* events = kernel->events()) event_sources_.push_back(events);
    if (const DelaySource* delays_of = kernel->delays()) delay_sources_.push_back(delays_of);
    looks_ahead_ = looks_ahead_ || kernel->delays();
    if (const StartSource* starts = kernel->starts()) {
      const auto own = starts->start_conditions();
      start_sources_.push_back(starts);
      starts_.insert(starts_.end(), own.begin(), own.end());
    }
    const std::vector<const BodySource*> bodies = kernel->bodies();
    bodies_.insert(bodies_.end(), bodies.begin(), bodies.end());
  }
  std::ranges::sort(bodies_, {}, [](const BodySource* b) { return b->bodies().front().index; });
}

void System::find_angles(const std::vector<AngleName>& counted_before) {
  for (const AngleName& a : counted_before) {
    const auto i = model_->find_marker(a.i), j = model_->find_marker(a.j);
    if (i && j && signals_->has_place(*i) && signals_->has_place(*j)) layout_.count_turns(a.measure, *i, *j);
  }
  turns_ = TurnCounter(*signals_);
}

void System::scale_coordinates() {
  // Markers at which nothing acts are no measure of the mechanism: axes of ground, what requests and graphics show.
  std::vector<MarkerId> acted_on;
  for (std::size_t k = 1; k < model_->markers.size(); ++k) {
    const MarkerId m{static_cast<std::int32_t>(k)};
    if (!signals_->wrenches_at(m).empty()) acted_on.push_back(m);
  }
  length_ = model_->characteristic_length(acted_on);
  // Markers that stand at one place of a curve but for rounding are no scale of what moves along it.
  constexpr double coincide = 1e-9;
  for (const CurvePoint& p : layout_.curve_points) {
    const double size = p.curve->least_speed() * p.curve->range();
    if (length_ <= coincide * size) length_ = size;
  }
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
  std::stable_partition(preference_.begin(), preference_.end(),
                        [&](std::int32_t k) { return !layout_.followers.contains(k); });
}

const Signals& System::signals() const { return *signals_; }

OperatingPoint System::drawn() const {
  OperatingPoint op;
  op.redundancy_tolerance = model_->settings.initial_conditions.error.value_or(op.redundancy_tolerance);
  op.initial_conditions = model_->settings.initial_conditions;
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
  m.progress = op.progress;
  m.bodies.resize(layout_.bodies.size());
  const auto vector_at = [](const std::vector<double>& x, std::int32_t k) {
    const auto i = static_cast<std::size_t>(k);
    return Vector{x[i], x[i + 1], x[i + 2]};
  };
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    const BodyBlock& block = layout_.bodies[b];
    const bool moves = block.count > 0, turns = block.turns();
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
  m.delays = op.delays.get();
  return m;
}

void System::switches(const Motion& motion, ExpressionScratch& scratch, SwitchList& list) const {
  list.clear();
  for (const SwitchSource* kinks : delay_switches_) kinks->switches(motion, scratch, list);
  switches_of_elements(motion, scratch, list);
}

void System::switches_of_elements(const Motion& motion, ExpressionScratch& scratch, SwitchList& list) const {
  for (const SwitchSource* kinks : switch_sources_) kinks->switches(motion, scratch, list);
  for (const BoundExpression& e : switching_) e.switches(motion, scratch, list);
}

void System::look_ahead(const Motion& from, const Motion& to, ExpressionScratch& scratch, StepReach& reach) const {
  for (const DelaySource* delays : delay_sources_) delays->look_ahead(from, to, reach);
  for (const BoundExpression& e : switching_) e.look_ahead(from, to, scratch, reach);
}

std::shared_ptr<DelayHistories> System::histories_of(const OperatingPoint& op) const {
  return op.delays ? std::make_shared<DelayHistories>(*op.delays)
                   : std::make_shared<DelayHistories>(layout_.delay_calls.size());
}

void System::record(OperatingPoint& op) const {
  if (layout_.delay_calls.empty()) return;
  auto histories = histories_of(op);
  const Motion m = motion(op);
  for (const DelaySource* delays : delay_sources_) delays->record(m, *histories);
  op.delays = std::move(histories);
}

void System::record_behind(const OperatingPoint& before, OperatingPoint& op) const {
  if (layout_.delay_calls.empty()) return;
  auto histories = histories_of(op);
  const Motion a = motion(before), b = motion(op);
  ExpressionScratch scratch;
  SwitchList at_a, at_b;
  switches_of_elements(a, scratch, at_a), switches_of_elements(b, scratch, at_b);
  const bool by_elements = changes_between(at_a, at_b);
  for (const DelaySource* delays : delay_sources_) delays->record_behind(a, b, by_elements, *histories);
  op.delays = std::move(histories);
}

double System::next_event(const OperatingPoint& op) const {
  double next = std::numeric_limits<double>::infinity();
  if (!op.delays) return next;
  for (const DelaySource* delays : delay_sources_) next = std::min(next, delays->next_event(op.time, *op.delays));
  return next;
}

double System::longest_step(const Motion& motion) const {
  double longest = std::numeric_limits<double>::infinity();
  for (const DelaySource* delays : delay_sources_) longest = std::min(longest, delays->longest_step(motion));
  return longest;
}

void System::constraints(const Motion& motion, ConstraintRows& rows) const {
  rows.begin();
  for (const auto& kernel : kernels_) kernel->constraints(motion, rows);
}

void System::start_rows(const Motion& motion, std::int32_t first_row, ConstraintRows& rows) const {
  for (const StartSource* starts : start_sources_) {
    starts->start_rows(motion, first_row, rows);
    first_row += static_cast<std::int32_t>(starts->start_conditions().size());
  }
}

void System::equations(const Motion& motion, const ConstraintRows& rows, Equations& eq,
                       std::initializer_list<PartialBy> wanted) const {
  const auto pass = [&] {
    eq.begin(wanted);
    add_equations(kernels_, motion, model_->calls_routines ? Threads::one : Threads::all, eq);
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
    eq.begin_constraint(k);
    for (const auto& e : rows.row(k)) eq.add_residual(e.column, -lambda * e.c.g);
  }
}

void System::course_rates(const Motion& motion, std::span<double> state_rates) const {
  for (const auto& kernel : kernels_) kernel->course_rates(motion, state_rates);
}

void System::remember(OperatingPoint& op) const {
  const Motion m = motion(op);
  for (const auto& kernel : kernels_) kernel->remember(m, op.memory);
  turns_.remember(m, op.memory);
}

std::vector<UndefinedValue> System::undefined_values(const Motion& motion) const {
  UndefinedValues found;
  for (const auto& kernel : kernels_) kernel->undefined_values(motion, found);
  return found.values();
}

std::vector<Kink> System::kinks(const Motion& motion) const {
  UndefinedValues found = UndefinedValues::search_for_kinks(length());
  for (const auto& kernel : kernels_) kernel->undefined_values(motion, found);
  return found.kinks();
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

Partition System::partition(const ConstraintRows& rows, RowLevel last, const std::vector<bool>& left_out) const {
  const auto counts = [&](std::int32_t k) {
    if (!left_out.empty() && left_out[static_cast<std::size_t>(k)]) return false;
    return last == RowLevel::velocity || rows.level(k) == RowLevel::position;
  };
  std::vector<SparseRow> scaled(static_cast<std::size_t>(rows.size()));
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (counts(k)) scaled[static_cast<std::size_t>(k)] = scaled_row(*this, rows.row(k));
  }
  const std::vector<std::int32_t> order(preference_.rbegin(), preference_.rend());
  const Elimination e = eliminate(std::move(scaled), layout_.coordinate_count, order);
  Partition p;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    p.active.push_back(e.pivot_column[static_cast<std::size_t>(k)] >= 0);
    if (counts(k) && !p.active.back()) p.redundant.push_back(k);
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
