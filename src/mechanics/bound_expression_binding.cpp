// What the atoms of an expression stand for: markers, elements, channels.
#include <algorithm>
#include <optional>
#include <unordered_set>

#include "mechanics/bound_expression.h"
#include "mechanics/marker_references.h"

namespace dynalin {

namespace {

// Whether a measure looks at those of its k-th marker.
Axes axes_read_by(Measure m, std::size_t k) {
  switch (m) {
    case Measure::INCANG:
      return Axes::unread;
    case Measure::DX:
    case Measure::DY:
    case Measure::DZ:
    case Measure::DM:
    case Measure::VX:
    case Measure::VY:
    case Measure::VZ:
    case Measure::VM:
    case Measure::VR:
    case Measure::ACCX:
    case Measure::ACCY:
    case Measure::ACCZ:
    case Measure::ACCM:
      return k >= 2 ? Axes::read : Axes::unread;
    default:
      return Axes::read;
  }
}

// Null where it reads something else.
double IntegrationProgress::*read_of_integration(DataSource reads) {
  switch (reads) {
    case DataSource::processor_time:
      return &IntegrationProgress::processor_time;
    case DataSource::step_size:
      return &IntegrationProgress::step_size;
    case DataSource::step_order:
      return &IntegrationProgress::order;
    case DataSource::jacobians:
      return &IntegrationProgress::jacobians;
    case DataSource::evaluations:
      return &IntegrationProgress::evaluations;
    default:
      return nullptr;
  }
}

// Which of the markers i, j, k, l an argument names, if its measure looks at it. Sizes need no axes: their third
// argument is the frame in which derivatives in time are taken. The rate of a distance is the same in all of them.
std::optional<std::size_t> role_of_argument(Measure m, std::size_t argument) {
  switch (m) {
    case Measure::VM:
    case Measure::ACCM:
    case Measure::WDTM:
      return argument == 2 ? 3 : argument;
    case Measure::VR:
      return argument == 2 ? std::nullopt : std::optional(argument);
    default:
      return argument;
  }
}

// Whether a measure of two markers on one rigid body never changes, whoever looks at it.
bool is_constant_on_a_body(Measure m) {
  switch (m) {
    case Measure::DM:
    case Measure::VR:
    case Measure::WM:
    case Measure::WDTM:
    case Measure::AX:
    case Measure::AY:
    case Measure::AZ:
    case Measure::PSI:
    case Measure::THETA:
    case Measure::PHI:
    case Measure::YAW:
    case Measure::PITCH:
    case Measure::ROLL:
    case Measure::PSI_PLUS_PHI:
    case Measure::PSI_MINUS_PHI:
    case Measure::YAW_PLUS_ROLL:
    case Measure::YAW_MINUS_ROLL:
    case Measure::THETA_SQUARED:
      return true;
    default:
      return false;
  }
}

// A floating marker has no place of its own.
MarkerFrame find_marker(Binder& binder, const Atom& atom, std::int64_t id, Axes axes) {
  const Signals& signals = binder.signals();
  const MarkerId m = signals.marker(id);
  if (!signals.has_place(m)) {
    binder.problem("unplaced-marker", atom.at,
                   std::string(atom.at.text()) + " reads " + signals.layout().marker_label(m).full_text() +
                       ", a floating marker that no element gives a place");
  }
  return frame_of_marker(signals, m, axes);
}

}  // namespace

BoundExpression::BoundExpression(Expression expression, Binder& binder, Binding binding)
    : expression_(expression.with_curves([&](SplineUse& use) { binder.attach(use); })) {
  if (!expression_.is_constant()) bind_atoms(binder, binding);
  // What is bound for rates or conditions is bound for the equations as well.
  if (binding == Binding::equations && has_switches()) binder.note_switches(*this);
}

void BoundExpression::bind_atoms(Binder& binder, Binding binding) {
  std::unordered_set<std::int32_t> seen;  // of all_blocks: a sum may run over all bodies of a model
  bound_ = std::make_shared<Bound>();
  bound_->atoms.reserve(expression_.atoms().size());
  for (const Atom& atom : expression_.atoms()) {
    bound_->atoms.push_back(bind(atom, binder, binding));
    const BoundAtom& a = bound_->atoms.back();
    for (const CoordinateBlock& b : blocks(a)) {
      if (seen.insert(b.column).second) bound_->all_blocks.push_back(b);
    }
    using Kind = BoundAtom::Kind;
    if (a.kind == Kind::measure) order_ = std::max(order_, static_cast<int>(a.order));
    if (a.kind == Kind::force) order_ = 2;
    if (binding == Binding::rates || binding == Binding::condition_rates) {
      const bool impossible = a.kind == Kind::force || (a.kind == Kind::measure && a.order == 2) ||
                              (a.kind == Kind::channel && a.channel.kind == Channel::Kind::state_rate);
      if (impossible) {
        binder.problem("unknown-rate", atom.at,
                       std::string(atom.at.text()) +
                           " stands in an expression whose time derivative DIF1 or DELAY needs, and has none that is "
                           "known",
                       "a DELAY needs none as a Padé approximant, run with --pade");
      } else if (a.kind == Kind::channel) {
        bound_->atoms.back().rate = binder.rate_of(a.channel);
      }
    }
  }
  bound_->all_blocks.shrink_to_fit();
  bound_->atom_blocks.shrink_to_fit();
}

void BoundExpression::note_blocks(BoundAtom& a, const MarkerFrame& marker, const Layout& layout, bool poses_too) {
  for_each_coordinate_block(marker, layout, [&](const CoordinateBlock& b) {
    const std::span<const CoordinateBlock> known = blocks(a);
    if (!poses_too && b.kind != CoordinateBlock::Kind::curve_parameter) return;
    if (std::find(known.begin(), known.end(), b) != known.end()) return;
    bound_->atom_blocks.push_back(b);
    ++a.block_count;
  });
}

void BoundExpression::bind_force(BoundAtom& a, Force force, const Signals& signals) {
  a.kind = BoundAtom::Kind::force;
  note_blocks(a, force.axes_marker, signals.layout(), false);
  a.force = std::make_shared<const Force>(std::move(force));
}

std::optional<Atom> BoundExpression::atom_on_curve() const {
  for (std::size_t k = 0; k < bound_atoms().size(); ++k) {
    for (const CoordinateBlock& b : blocks(bound_atoms()[k]))
      if (b.kind == CoordinateBlock::Kind::curve_parameter) return expression_.atoms()[k];
  }
  return std::nullopt;
}

BoundExpression::BoundAtom BoundExpression::bind(const Atom& atom, Binder& binder, Binding binding) {
  BoundAtom a{};
  a.first_block = static_cast<std::uint32_t>(atom_blocks().size());
  switch (atom.function->family) {
    case AtomFamily::time:
      a.kind = BoundAtom::Kind::time;
      break;
    case AtomFamily::marker_measure:
      bind_measure(a, atom, binder);
      break;
    case AtomFamily::data:
      bind_data(a, atom, binder, binding);
      break;
    case AtomFamily::delay:
      a.kind = BoundAtom::Kind::channel;
      a.channel = binder.delayed(atom);
      break;
    case AtomFamily::element_force:
      bind_force(a, force_of_element(atom, binder), binder.signals());
      break;
    case AtomFamily::marker_force:
      bind_force(a, force_on_marker(atom, binder), binder.signals());
      break;
  }
  return a;
}

void BoundExpression::bind_measure(BoundAtom& a, const Atom& atom, Binder& binder) {
  const Signals& signals = binder.signals();
  a.kind = BoundAtom::Kind::measure;
  a.measure = *atom.function->measure;
  a.order = atom.function->order;
  a.places.fill({&signals.layout().marker(signals.marker(0))});
  for (std::size_t argument = 0; argument < atom.argument_count; ++argument) {
    const auto role = role_of_argument(a.measure, argument);
    if (role) a.places[*role] = find_marker(binder, atom, atom.argument[argument], axes_read_by(a.measure, *role));
  }
  // Rounding of what never changes is no gradient, least of all at a kink.
  const auto rigid = [&](std::size_t k) { return !a.places[k].curve && !a.places[k].place().shapes; };
  const bool one_body = a.places[0].place().body == a.places[1].place().body && rigid(0) && rigid(1);
  const bool constant = one_body && is_constant_on_a_body(a.measure);
  for (const MarkerFrame& place : a.places) note_blocks(a, place, signals.layout(), !constant);
  if (counts_turns(a.measure))
    a.memory = binder.count_turns(a.measure, signals.marker(atom.argument[0]), signals.marker(atom.argument[1]));
}

void BoundExpression::bind_data(BoundAtom& a, const Atom& atom, Binder& binder, Binding binding) {
  using Kind = BoundAtom::Kind;
  const AtomFunction& f = *atom.function;
  if (const auto progress = read_of_integration(f.reads)) {
    a.kind = Kind::progress;
    a.progress = progress;
    return;
  }
  switch (f.reads) {
    case DataSource::analysis:
      a.kind = Kind::mode;
      if (binding != Binding::observation) binder.note_analysis();
      return;
    case DataSource::sensor:
      a.kind = Kind::remembered;
      a.kept = binder.sensor_value(atom.argument[0]);
      return;
    case DataSource::none:
      binder.problem(
          "misplaced-function", atom.at,
          std::string(f.name) + " belongs to a place along a beam, which only the components of an FE_LOAD have");
      a.kind = Kind::constant;
      return;
    case DataSource::state_rate:
      if (binding != Binding::condition && binding != Binding::condition_rates) break;
      a.kind = Kind::constant;
      return;
    default:
      break;
  }
  a.channel = binder.data(atom);
  if (a.channel.kind == Channel::Kind::none) {
    binder.problem("unfilled-entry", atom.at,
                   std::string(atom.at.text()) + " reads an entry that does not exist, or that nothing fills");
    a.channel = {Channel::Kind::constant, 0, 0};
  }
  a.kind = a.channel.kind == Channel::Kind::constant ? Kind::constant : Kind::channel;
  a.constant = a.channel.constant;
}

BoundExpression::Force BoundExpression::force_of_element(const Atom& atom, Binder& binder) {
  Force force;
  if (const Signals::Wrench w = binder.signals().wrench(atom.function->statement, atom.argument[0]); w.source) {
    force.terms.push_back({w, atom.argument[1] == 1});  // an element taken out of the model exerts nothing
  }
  force.component = static_cast<std::uint8_t>(atom.argument[2]);
  force.axes_marker = find_marker(binder, atom, atom.argument[3], Axes::read);
  return force;
}

BoundExpression::Force BoundExpression::force_on_marker(const Atom& atom, Binder& binder) {
  static constexpr std::array<std::string_view, 8> names = {"FM", "FX", "FY", "FZ", "TM", "TX", "TY", "TZ"};
  const Signals& signals = binder.signals();
  Force force;
  const auto* const name = std::find(names.begin(), names.end(), atom.function->name);
  force.component = static_cast<std::uint8_t>(name - names.begin() + 1);
  const MarkerId i = signals.marker(atom.argument[0]);
  const bool from_all = atom.argument[1] == 0;
  const auto j = from_all ? std::nullopt : std::optional(signals.marker(atom.argument[1]));
  for (const MarkerLoad& l : loads_on(signals, i, j)) force.terms.push_back({l.wrench, l.on_J});
  force.axes_marker = find_marker(binder, atom, atom.argument[2], Axes::read);
  return force;
}

}  // namespace dynalin
