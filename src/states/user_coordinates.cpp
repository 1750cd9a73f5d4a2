#include "states/user_coordinates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "elements/controls/variable.h"
#include "expression/functions.h"

namespace dynalin {

namespace {

constexpr double coincident = 1e-12;  // distance of two points at one place, relative to the model

std::string place_text(const Span& at) {
  if (!at.source) return {};
  const auto [line, column] = at.source->place(at.offset);
  return fmt::format("{}:{}:{}: ", at.source->name(), line, column);
}

// A VARIABLE and those it reads, spelled out: values run forward through the chain, derivatives backward.
class Chain {
 public:
  Chain(const System& system, const Motion& motion, VariableRef of) : system_(system), motion_(motion), of_(of) {}

  std::optional<Failure> add_gradient(ConstraintRows& rows, std::int32_t row) {
    if (auto failure = visit(of_, Span{})) return failure;
    if (!moves_) return refused({}, "does not depend on positions");
    links_.back().factor = Taylor(1.0, 0.0, 0.0);
    for (std::size_t k = links_.size(); k-- > 0;) {
      const Link& link = links_[k];
      link.function->add_position(motion_, rows, row, link.factor, link.given);
      for (const auto& [atom, other] : link.reads)
        links_[other].factor += link.factor * rows.scratch.taylor_partials[atom];
    }
    rows.set(row, links_.back().value);
    return finite(rows.row(row));
  }

 private:
  struct Link {
    VariableRef variable;
    const BoundExpression* function = nullptr;
    std::vector<std::pair<std::size_t, std::size_t>> reads;  // atom, link
    std::vector<Taylor> given;                               // values of atoms
    Taylor value, factor;                                    // factor: ∂(the coordinate)/∂(this value)
  };

  Failure refused(const Span& at, const std::string& why) const {
    const Span& place = at.source ? at : variable_function(system_.model(), of_).at();
    return {
        "linear analysis",
        fmt::format("{}{} cannot be a PSTATE coordinate: it {}, and a coordinate is a smooth function of positions and "
                    "time",
                    place_text(place), system_.model().label(of_).full_text(), why),
        {},
        "unusable-coordinate"};
  }
  std::string reader(VariableRef variable) const {
    return variable == of_ ? "reads" : fmt::format("reads, through {},", system_.model().label(variable).text());
  }

  // Puts a VARIABLE behind all that it reads.
  std::optional<Failure> visit(VariableRef variable, const Span& from) {
    const std::int32_t index = system_.signals().variable(variable).index;
    if (const auto found = place_.find(index); found != place_.end()) {
      if (found->second != open) return std::nullopt;
      return refused(from,
                     fmt::format("depends on {}, which depends on itself", system_.model().label(variable).text()));
    }
    place_[index] = open;
    const Expression& e = variable_function(system_.model(), variable);
    for (const Expression::Call& call : e.calls()) {
      if (!has_kinks(call.name)) continue;
      return refused(call.at, fmt::format("{} {}, which is not smooth", reader(variable), call.at.text()));
    }
    Link link;
    link.variable = variable;
    const Signals::Element element = system_.signals().element(variable);
    link.function = element.kernel->channels()->value_function(element.index);
    link.given.resize(e.atoms().size());
    for (std::size_t k = 0; k < e.atoms().size(); ++k) {
      if (auto failure = read(e.atoms()[k], k, variable, link)) return failure;
    }
    ExpressionScratch scratch;
    link.value = link.function->along_motion(motion_, scratch, link.given);
    place_[index] = links_.size();
    links_.push_back(std::move(link));
    return std::nullopt;
  }

  std::optional<Failure> read(const Atom& atom, std::size_t k, VariableRef variable, Link& link) {
    const auto wrong = [&](std::string_view what) {
      return refused(atom.at, fmt::format("{} {}, {}", reader(variable), atom.at.text(), what));
    };
    const AtomFunction& f = *atom.function;
    switch (f.family) {
      case AtomFamily::time:
        return std::nullopt;
      case AtomFamily::marker_measure:
        moves_ = moves_ || f.order == 0;
        if (f.name == "DM" && coincide(atom)) return wrong("a distance that is zero and has no derivatives");
        if (f.order == 0) return std::nullopt;
        return wrong(f.order == 1 ? "a velocity" : "an acceleration");
      case AtomFamily::marker_force:
      case AtomFamily::element_force:
        return wrong("a force");
      case AtomFamily::delay:
        return wrong("a delayed value");
      case AtomFamily::data:
        break;
    }
    if (f.reads == DataSource::state_rate) return wrong("the rate of a differential equation");
    if (stands_still(f.reads)) return std::nullopt;
    const Channel channel = system_.signals().data(atom);
    if (channel.kind == Channel::Kind::constant || channel.kind == Channel::Kind::none) return std::nullopt;
    if (channel.kind != Channel::Kind::algebraic) return wrong("a differential state");
    const ElementLabel& owner = *system_.layout().algebraic[static_cast<std::size_t>(channel.index)].owner;
    const auto other_variable = system_.model().find_as<VariableClass>(owner);
    if (!other_variable) return wrong(fmt::format("which {} gives", owner.text()));
    if (auto failure = visit(*other_variable, atom.at)) return failure;
    const std::size_t other = place_.at(channel.index);
    link.reads.emplace_back(k, other);
    link.given[k] = links_[other].value;
    return std::nullopt;
  }

  // Whether the first two markers of a measure are at one point but for rounding.
  bool coincide(const Atom& atom) const {
    const auto origin = [&](std::size_t k) {
      const MarkerId marker = system_.signals().marker(k < atom.argument_count ? atom.argument[k] : 0);
      return value(motion_.frame(system_.layout().marker(system_.signals().place_of(marker))).origin);
    };
    return norm(origin(0) - origin(1)) <= coincident * system_.length();
  }

  std::optional<Failure> finite(std::span<const ConstraintRows::Entry> row) const {
    const bool fine = std::all_of(row.begin(), row.end(), [](const auto& e) {
      return std::isfinite(e.c.g) && std::isfinite(e.c.v) && std::isfinite(e.c.a0);
    });
    if (fine) return std::nullopt;
    for (const Link& link : links_) {
      UndefinedValues undefined_values;
      link.function->find_undefined(motion_, system_.model().label(link.variable), undefined_values,
                                    BoundExpression::Derivatives::with_rates);
      if (!undefined_values.values().empty())
        return refused(variable_function(system_.model(), link.variable).at(),
                       "has no derivatives here (" + undefined_values.values().front().reason + ")");
    }
    return refused({}, "has no derivatives here");
  }

  static constexpr std::size_t open = static_cast<std::size_t>(-1);

  const System& system_;
  const Motion& motion_;
  VariableRef of_;
  std::map<std::int32_t, std::size_t> place_;  // of algebraic values among the links
  std::vector<Link> links_;                    // each behind those it reads
  bool moves_ = false;
};

}  // namespace

std::optional<Failure> add_user_candidates(const System& system, const Motion& motion, const VariableList& list,
                                           std::int32_t row, CandidateSet& set) {
  for (const VariableRef ref : list.variables) {
    if (auto failure = Chain(system, motion, ref).add_gradient(set.gradients, row)) return failure;
    Candidate c;
    c.row = row++;
    StateLabel label{StateType::pstate, system.model().label(ref).id, 1, "", {}, false};
    label.text = fmt::format("PSTATE VARIABLE VAR/{} {}", label.element,
                             on_one_line(variable_function(system.model(), ref).at()));
    c.state = state_coordinate(std::move(label), StateType::pstate_rate, 2, 0);
    set.own.push_back(std::move(c));
  }
  return std::nullopt;
}

}  // namespace dynalin
