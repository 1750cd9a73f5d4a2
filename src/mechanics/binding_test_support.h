// A small system without a model, to which expressions are bound: the bodies of paths_test_support.h, three algebraic
// values, two states and a spring that exerts a wrench.
#pragma once

#include "expression/expression_test_support.h"
#include "mechanics/bound_expression.h"
#include "mechanics/paths_test_support.h"
#include "mechanics/wrench_source.h"

namespace dynalin::mechanics_test {

// SFORCE/1 between markers 2 and 5: stiffness, damping and an unknown that pushes as well.
struct Spring final : WrenchSource {
  const Paths* p = nullptr;
  double k = 1.4, c = 0.6, w = 0.8;  // w: times the first algebraic value
  bool acts_on_J = true;

  MarkerId marker_I(std::size_t) const override { return {2}; }
  MarkerId marker_J(std::size_t) const override { return {5}; }
  void wrench(const Motion& motion, std::size_t, Partials wanted, MarkerWrench& out) const override {
    out.pair = pair_motion(motion, p->marker(2), p->marker(5));
    const Taylor d = norm(out.pair.delta);
    out.force = along_line(out.pair, {-k * d.value - c * d.rate + w * motion.algebraic[0], -k, -c}, wanted);
    if (!acts_on_J) out.force.reaction = Reaction::none;
    const Vector line = value(out.pair.delta) / d.value;
    out.scalars.push_back({PartialBy::algebraic, 0, w * line, {}});
  }
  // On marker 2 along a path.
  RealVector force(const Moment& m, Real value) const {
    const auto delta = [](const Moment& n) { return n.origin(MarkerId{2}) - n.origin(MarkerId{5}); };
    const Real d = norm(delta(m)), rate = m.rate([&](const Moment&n) { return norm(delta(n)); });
    return delta(m) / d * (-k * d - c * rate + w * value);
  }
};

class SmallSystem final : public Signals, public Binder {
 public:
  explicit SmallSystem(unsigned seed = 7) : p(seed) {
    spring.p = &p;
    for (std::int32_t k = 0; k < 3; ++k) p.layout.add_algebraic(owner);
    for (std::int32_t k = 0; k < 2; ++k) p.layout.add_state({.owner = &owner});
    p.layout.add_row(owner, "row");
    p.layout.add_row(owner, "rate", RowLevel::velocity);
    p.motion.algebraic = {0.3, -0.8, 1.7};
    p.motion.state = {0.9, -1.2};
    p.motion.state_rate = {0.35, 0.65};
    p.motion.lambda = {0, 0};
  }

  BoundExpression bound(const std::string& text, Binding binding = Binding::equations) {
    texts_.push_back(std::make_unique<expression_test::ParsedText>(expression_test::parse(text)));
    if (texts_.back()->diagnostics.has_errors()) throw std::runtime_error(render(texts_.back()->diagnostics));
    BoundExpression e(texts_.back()->expression, *this, binding);
    p.motion.memory.resize(p.layout.memory.size());
    return e;
  }

  // Signals
  const Layout& layout() const override { return p.layout; }
  MarkerId marker(std::int64_t id) const override { return {static_cast<std::int32_t>(id)}; }
  MarkerId place_of(MarkerId m) const override { return m; }
  bool has_place(MarkerId m) const override { return m.index != unplaced; }
  Channel variable(VariableRef) const override { return {}; }
  Channel array_entry(ArrayRef, std::size_t) const override { return {}; }
  Channel data(const Atom& a) const override {
    const std::int32_t n = a.argument[0] - 1;
    switch (a.function->reads) {
      case DataSource::value:
        if (n == 8) return {Channel::Kind::constant, 0, 2.5};
        return n < 3 ? Channel{Channel::Kind::algebraic, n} : Channel{};
      case DataSource::state:
        return {Channel::Kind::state, n};
      case DataSource::state_rate:
        return {Channel::Kind::state_rate, n};
      default:
        return {};
    }
  }
  Element element(ElementHandle) const override { return {}; }
  Wrench wrench(std::string_view, std::int64_t id) const override { return id == 1 ? Wrench{&spring, 0} : Wrench{}; }
  std::span<const Wrench> wrenches_at(MarkerId m) const override {
    return m.index == 2 || m.index == 5 ? std::span(own_) : std::span<const Wrench>{};
  }

  // Binder
  const Signals& signals() const override { return *this; }
  Channel data(const Atom& a) override { return std::as_const(*this).data(a); }
  Channel rate_of(const Channel& c) override {  // the third value is the rate of the first
    if (c.kind == Channel::Kind::state) return {Channel::Kind::state_rate, c.index};
    if (c.kind == Channel::Kind::algebraic && c.index == 0) return {Channel::Kind::algebraic, 2};
    return {Channel::Kind::constant, 0, 0};
  }
  Channel delayed(const Atom&) override { return {Channel::Kind::algebraic, 1}; }
  void attach(SplineUse&) override {}
  std::int32_t sensor_value(std::int64_t) override { return p.layout.add_memory(owner, "value"); }
  void note_analysis() override { p.layout.reads_analysis = true; }
  void note_switches(const BoundExpression& e) override { switching.push_back(e); }
  std::int32_t add_memory(const ElementLabel& of, std::string_view name, double initial) override {
    return p.layout.add_memory(of, name, initial);
  }
  std::int32_t count_turns(Measure measure, MarkerId i, MarkerId j) override {
    return p.layout.count_turns(measure, i, j);
  }
  void problem(std::string_view code, const Span&, std::string, std::string) override { problems.emplace_back(code); }

  Paths p;
  Spring spring;
  std::vector<std::string> problems;
  std::vector<BoundExpression> switching;
  std::int32_t unplaced = -1;  // a floating marker that nothing gives a place

 private:
  ElementLabel owner{"VARIABLE", 1, {}, {}};
  std::array<Wrench, 1> own_{Wrench{&spring, 0}};
  std::vector<std::unique_ptr<expression_test::ParsedText>> texts_;
};

}  // namespace dynalin::mechanics_test
