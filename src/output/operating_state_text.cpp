#include "output/operating_state_text.h"

#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "dataset/characters.h"

namespace dynalin {

namespace {

std::string lower(const std::string& text, std::string_view otherwise) {
  return text.empty() ? std::string(otherwise) : lower_case(text);
}

std::string named(const ElementId& element, const std::string& view_name) {
  return view_name.empty() ? element.text() : element.text() + " (" + view_name + ")";
}

class Tables {
 public:
  Tables(std::ostream& out, const OperatingState& state, const Units& units, const StateTables& wanted)
      : out_(out), state_(state), wanted_(wanted) {
    length_ = lower(units.length, "length"), force_ = lower(units.force, "force"), time_ = units.time_symbol();
    for (const BodyState& b : state.bodies) widen(b.name);
    for (const auto* list : {&state.reactions, &state.forces}) {
      for (const Load& l : *list) widen(label(l));
    }
    for (const VariableValue& v : state.variables) widen(label(v));
    for (const StateValue& z : state.states) widen(label(z));
  }

  void write() {
    motion(fmt::format("positions of the BCS [{}], angles psi, theta, phi (3-1-3) [rad]", length_),
           {"X", "Y", "Z", "PSI", "THETA", "PHI"}, &BodyState::position, &BodyState::angles);
    if (!wanted_.short_form) {
      motion(fmt::format("velocities of the BCS, global [{0}/{1}, rad/{1}]", length_, time_),
             {"VX", "VY", "VZ", "WX", "WY", "WZ"}, &BodyState::velocity, &BodyState::angular_velocity);
      motion(fmt::format("accelerations of the BCS, global [{0}/{1}2, rad/{1}2]", length_, time_),
             {"ACCX", "ACCY", "ACCZ", "WDX", "WDY", "WDZ"}, &BodyState::acceleration, &BodyState::angular_acceleration);
    }
    loads("reactions", state_.reactions);
    loads("forces", state_.forces);
    if (wanted_.short_form) return;
    column("VARIABLEs", "value", state_.variables,
           [](const VariableValue& v) { return fmt::format("{:>14.6g}", v.value); });
    column("differential states", "value           rate", state_.states,
           [](const StateValue& z) { return fmt::format("{:>14.6g} {:>14.6g}", z.value, z.rate); });
    column("further coordinates", "value           rate", state_.parameters,
           [](const ParameterValue& p) { return fmt::format("{:>14.6g} {:>14.6g}", p.value, p.rate); });
  }

 private:
  using Heads = std::array<std::string_view, 6>;

  static std::string label(const Load& l) {
    return fmt::format("{} on MARKER/{}", named(l.element, l.view_name), l.marker_I);
  }
  static std::string label(const VariableValue& v) { return named({"VARIABLE", v.id}, v.view_name); }
  static std::string label(const StateValue& z) {
    return fmt::format("{} state {}", named(z.element, z.view_name), z.number);
  }
  static std::string label(const ParameterValue& p) { return p.element.text() + " " + p.name; }
  void widen(const std::string& text) { width_ = std::max(width_, std::min<std::size_t>(text.size(), 64)); }

  void head(std::string_view title, const Heads& heads) {
    fmt::print(out_, "\n  {}\n  {:{}}", title, "", width_);
    for (const std::string_view h : heads) fmt::print(out_, " {:>12}", h);
    out_ << '\n';
  }
  void row(const std::string& name, const Triple& a, const Triple& b) {
    fmt::print(out_, "  {:{}}", name, width_);
    for (const Triple* t : {&a, &b}) {
      // A component below the rounding of its vector is what other axes would have left of it.
      const double rounding = std::numeric_limits<double>::epsilon() / 2 * std::hypot((*t)[0], (*t)[1], (*t)[2]);
      for (const double v : *t) fmt::print(out_, " {:>12.6g}", std::abs(v) <= rounding ? 0.0 : v);
    }
  }
  void rest(std::size_t count) {
    if (count > wanted_.rows) fmt::print(out_, "  ... and {} more\n", count - wanted_.rows);
  }

  void motion(std::string_view title, const Heads& heads, Triple BodyState::*first, Triple BodyState::*second) {
    if (state_.bodies.empty()) return;
    head(title, heads);
    for (std::size_t k = 0; k < std::min(state_.bodies.size(), wanted_.rows); ++k) {
      const BodyState& b = state_.bodies[k];
      row(b.name, b.*first, b.*second);
      out_ << '\n';
    }
    rest(state_.bodies.size());
  }

  void loads(std::string_view title, const std::vector<Load>& list) {
    if (list.empty()) return;
    head(fmt::format("{} on marker I, along the axes of the marker behind them [{}, {}*{}]", title, force_, force_,
                     length_),
         {"FX", "FY", "FZ", "TX", "TY", "TZ"});
    for (std::size_t k = 0; k < std::min(list.size(), wanted_.rows); ++k) {
      row(label(list[k]), list[k].force_in_axes, list[k].torque_in_axes);
      out_ << (list[k].axes ? fmt::format("  MARKER/{}\n", list[k].axes) : std::string("  global\n"));
    }
    rest(list.size());
  }

  template <class Value, class Text>
  void column(std::string_view title, std::string_view heading, const std::vector<Value>& list, const Text& text) {
    if (list.empty()) return;
    fmt::print(out_, "\n  {}\n  {:{}} {:>14}\n", title, "", width_, heading);
    for (const Value& v : list) fmt::print(out_, "  {:{}} {}\n", label(v), width_, text(v));
  }

  std::ostream& out_;
  const OperatingState& state_;
  StateTables wanted_;
  std::string length_, force_, time_;
  std::size_t width_ = 8;
};

}  // namespace

void write_operating_state(std::ostream& out, const OperatingState& state, const Units& units,
                           const StateTables& wanted) {
  if (!wanted.short_form) fmt::print(out, "\n  Operating point at time = {:.5E}\n", state.time);
  Tables(out, state, units, wanted).write();
  out << '\n';
}

}  // namespace dynalin
