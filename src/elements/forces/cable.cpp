// CABLE/id, MARKERS=, K= [, C=] [, LENGTH=] [, FORCE=]
//
// A cable without mass that runs from marker to marker, without friction where it passes one, under one tension
//
//     T = FORCE + K (L − LENGTH) + C L′        L: the sum of the distances from each marker to the next
//
// wherever that pulls; else it is slack, T = 0. Each of its spans pulls the two markers that it joins towards each
// other with T. Where two of them meet a span has no direction: unless the cable is slack, the analysis says which.
#include <fmt/format.h>

#include "elements/families/markers.h"
#include "mechanics/event_source.h"
#include "mechanics/kernel.h"
#include "mechanics/pair_blocks.h"
#include "mechanics/wrench_source.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct Cable {
  std::vector<std::int64_t> ids;
  double stiffness = 0;    // [force/length]
  double damping = 0;      // [force·time/length]
  double free_length = 0;  // [length]
  double preload = 0;      // [force] at L = free_length
  std::vector<MarkerId> markers;

  static constexpr std::array<Argument<Cable>, 5> arguments = {{
      {.name = "MARKERS",
       .slot = &Cable::ids,
       .required = true,
       .help = "the markers that it runs along, in order",
       .ids_of = MarkerClass::statement},
      {.name = "K",
       .slot = &Cable::stiffness,
       .required = true,
       .unit = unit::stiffness,
       .minimum = 0,
       .help = "stiffness of the whole cable"},
      {.name = "C", .slot = &Cable::damping, .unit = unit::damping, .minimum = 0, .help = "damping"},
      {.name = "LENGTH",
       .slot = &Cable::free_length,
       .unit = unit::length,
       .minimum = 0,
       .help = "length of the whole cable at which FORCE is its tension"},
      {.name = "FORCE", .slot = &Cable::preload, .unit = unit::force, .help = "tension at L = LENGTH"},
  }};
};

class CableKernel final : public Kernel, public WrenchSource, public SwitchSource {
 public:
  CableKernel(const std::vector<Cable>& cables, const std::vector<ElementLabel>& labels, Layout& layout)
      : layout_(layout), labels_(&labels) {
    for (const Cable& c : cables) {
      Placed p{c, {}};
      for (const MarkerId m : c.markers) p.places.push_back(layout.marker(m));
      for (std::size_t k = 0; k + 1 < c.markers.size(); ++k) spans_.emplace_back(cables_.size(), k);
      cables_.push_back(std::move(p));
    }
  }

  void equations(const Motion& motion, Equations& eq) const override {
    for (std::size_t at = 0; at < cables_.size(); ++at) {
      eq.begin_element((*labels_)[at]);
      const Placed& p = cables_[at];
      std::vector<PairMotion>& spans = eq.pair_scratch.pairs;
      const Tension tension = look(p, motion, spans);
      for (std::size_t k = 0; k < spans.size(); ++k) {
        apply(spans[k], pull(spans[k], tension, eq.wanted_partials()), eq);
        if (!eq.wants_partials()) continue;
        for (std::size_t l = 0; l < spans.size(); ++l) {
          if (l != k) apply_cross_partials(spans[k], spans[l], change(spans[k], spans[l], tension), eq);
        }
      }
    }
  }

  // A wrench for each span, on its second marker.
  const WrenchSource* wrenches() const override { return this; }
  std::size_t wrench_count(std::size_t) const override { return spans_.size(); }
  std::size_t element_of_wrench(std::size_t w) const override { return spans_[w].first; }
  MarkerId marker_I(std::size_t w) const override { return marker(w, 1); }
  MarkerId marker_J(std::size_t w) const override { return marker(w, 0); }
  void wrench(const Motion& motion, std::size_t w, Partials wanted, MarkerWrench& out) const override {
    const auto [at, k] = spans_[w];
    std::vector<PairMotion>& spans = out.scratch.pairs;
    const Tension tension = look(cables_[at], motion, spans);
    out.pair = spans[k];
    out.force = pull(spans[k], tension, wanted);
    if (wanted == Partials::no) return;
    for (std::size_t l = 0; l < spans.size(); ++l) {
      if (l == k) continue;
      const PairForce f = change(spans[k], spans[l], tension);
      for_each_block(spans[l], layout_, [&](const PairBlock& block) {
        const BlockPartials on = partials_by(block, f);
        for (std::size_t c = 0; c < block.count; ++c) {
          const std::int32_t column = block.column + static_cast<std::int32_t>(c);
          out.scalars.push_back({PartialBy::position, column, on.force[c], on.torque[c]});
          out.scalars.push_back({PartialBy::damping, column, on.force_by_rate[c], on.torque_by_rate[c]});
        }
      });
    }
  }

  const SwitchSource* kinks() const override { return this; }
  void switches(const Motion& motion, ExpressionScratch&, SwitchList& list) const override {
    std::vector<PairMotion> spans;
    for (const Placed& p : cables_) list.add(look(p, motion, spans).law);
  }
  void undefined_values(const Motion& motion, UndefinedValues& undefined) const override {
    for (std::size_t at = 0; at < cables_.size(); ++at) {
      const Placed& p = cables_[at];
      const ElementLabel& label = (*labels_)[at];
      if (std::vector<PairMotion> spans; look(p, motion, spans).is_slack()) continue;
      for (std::size_t k = 0; k + 1 < p.places.size(); ++k) {
        if (!markers_meet(pair_motion(motion, p.places[k + 1], p.places[k]))) continue;
        undefined.add(UndefinedValue{
            &label, fmt::format("markers {} and {} of {} coincide, the cable between them has no direction",
                                p.cable.ids[k], p.cable.ids[k + 1], label.full_text())});
      }
    }
  }

 private:
  struct Placed {
    Cable cable;
    std::vector<MarkerPlace> places;
  };
  // T, which is nothing where the law is negative. What it depends on stays the same: the pattern of the equations
  // does not know whether the cable is taut.
  struct Tension {
    double law = 0, value = 0;
    double on_length = 0, on_rate = 0;
    bool is_damped = false;

    // Nothing acts, along whatever line.
    bool is_slack() const { return value == 0.0 && on_length == 0.0 && on_rate == 0.0; }
  };

  MarkerId marker(std::size_t w, std::size_t end) const {
    const auto [at, k] = spans_[w];
    return cables_[at].cable.markers[k + end];
  }
  static Tension look(const Placed& p, const Motion& motion, std::vector<PairMotion>& spans) {
    const Cable& c = p.cable;
    spans.clear();
    Taylor length;
    for (std::size_t k = 0; k + 1 < p.places.size(); ++k) {
      spans.push_back(pair_motion(motion, p.places[k + 1], p.places[k]));
      const Vec3<Taylor>& span = spans.back().delta;
      length += markers_meet(spans.back()) ? Taylor(0.0, norm(rate(span)), 0.0) : norm(span);
    }
    const bool is_damped = c.damping != 0.0;
    const double law = c.preload + c.stiffness * (length.value - c.free_length) + c.damping * length.rate;
    return law > 0 ? Tension{law, law, c.stiffness, c.damping, is_damped} : Tension{law, 0, 0, 0, is_damped};
  }
  // On the second marker of a span; its partials are those with the length of the span itself.
  static PairForce pull(const PairMotion& span, const Tension& t, Partials wanted) {
    PairForce f = t.is_slack()         ? around_origin({}, wanted)
                  : markers_meet(span) ? without_direction(wanted)
                                       : along_line(span, {-t.value, -t.on_length, -t.on_rate}, wanted);
    f.depends_on_velocity = t.is_damped;
    return f;
  }
  // How that of `span` changes with the length of another: δf = −u (K δd + C δd′) with δd′ = w·δΔ′ + w′·δΔ.
  static PairForce change(const PairMotion& span, const PairMotion& other, const Tension& t) {
    PairForce f;
    f.reaction = Reaction::at_J;
    f.components = Components::force;
    f.depends_on_velocity = t.is_damped;
    if (t.is_slack()) return f;
    const Vector u = value(span.delta) / norm(value(span.delta));
    const Vec3<Taylor> w = other.delta / norm(other.delta);
    const Matrix3 on_delta = -outer(u, t.on_length * value(w) + t.on_rate * rate(w));
    const Matrix3 on_delta_rate = -t.on_rate * outer(u, value(w));
    f.force_on_position.origin_I = on_delta, f.force_on_position.origin_J = -on_delta;
    if (f.depends_on_velocity)
      f.force_on_velocity.origin_I = on_delta_rate, f.force_on_velocity.origin_J = -on_delta_rate;
    return f;
  }

  const Layout& layout_;
  const std::vector<ElementLabel>* labels_;
  std::vector<Placed> cables_;
  std::vector<std::pair<std::size_t, std::size_t>> spans_;  // cable, and place of the span in it
};

class CableSet final : public TypedSet<Cable> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    Cable& c = elements[k];
    if (!read_arguments(c, reader)) return;
    for (const std::int64_t id : c.ids) {
      if (const auto m = reader.marker({id, reader.at("MARKERS")}, "MARKERS")) c.markers.push_back(*m);
    }
    if (c.ids.size() > 1) return;
    reader.error("wrong-count", reader.at("MARKERS"),
                 fmt::format("{} needs at least two markers", reader.label().text()));
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const std::vector<MarkerId>& m = elements[k].markers;
      bool joins = false;
      for (std::size_t n = 0; n + 1 < m.size(); ++n) {
        check_pair(model, labels[k], m[n + 1], m[n], {.different_bodies = false}, diagnostics);
        joins = joins || model.marker(m[n + 1]).place.body != model.marker(m[n]).place.body;
      }
      if (joins || m.size() < 2) continue;
      diagnostics.error("same-body", labels[k].at,
                        fmt::format("all markers of {} are on {}", labels[k].text(),
                                    model.body(model.marker(m[0]).place.body).label.text()));
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<CableKernel>(elements, labels, layout);
  }
};

}  // namespace

extern constinit const Kind cable =
    Kind{"CABLE",
         "",
         "A cable that runs along markers under one tension.",
         Kind::Role::element,
         detail::argument_infos<Cable>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<CableSet>(kind); },
         Kind::EnergyRows::each_marker}
        .deactivatable();

}  // namespace dynalin
