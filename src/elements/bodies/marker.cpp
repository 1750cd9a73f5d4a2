// MARKER/id, {PART= | POINT_MASS= | FLEX_BODY=, NODE_ID= | FE_PART=, NODE_LABEL=}, QP=, {REULER= | ZP=, XP= [, USEXP]},
// FLOATING, RM=
//
// A point with axes on a body. QP is its origin and REULER (3-1-3) or the points ZP, XP its axes, all in the body
// coordinate system, or in the frame of marker RM. Without an owner it belongs to the body stated before it. On a
// flexible body or a beam it is carried by a node: of a flexible body QP counts from there, of a beam it is in the body
// coordinate system as ever.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <unordered_map>

#include "elements/bodies/fe_part.h"
#include "elements/bodies/flex_body.h"
#include "elements/families/markers.h"
#include "elements/families/orientation.h"
#include "model/model.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct MarkerStatement {
  BodyId part, point_mass, flex_body, beam;
  std::optional<std::int64_t> node, label_of_node;
  Vector origin;
  std::optional<Vector> angles, z_point, x_point;
  bool use_x_point = false, floating = false;
  MarkerId reference;

  static constexpr std::array<Argument<MarkerStatement>, 13> arguments = {{
      {.name = "PART",
       .slot = &MarkerStatement::part,
       .help = "the part it belongs to",
       .ends = "POINT_MASS FLEX_BODY NODE_ID FE_PART NODE_LABEL"},
      {.name = "POINT_MASS",
       .slot = &MarkerStatement::point_mass,
       .help = "the point mass it belongs to",
       .ends = "PART FLEX_BODY NODE_ID FE_PART NODE_LABEL"},
      {.name = "FLEX_BODY",
       .slot = &MarkerStatement::flex_body,
       .help = "the flexible body it belongs to",
       .ends = "PART POINT_MASS FE_PART NODE_LABEL"},
      {.name = "NODE_ID",
       .slot = &MarkerStatement::node,
       .help = "node of the flexible body or of the beam that carries it",
       .ends = "NODE_LABEL"},
      {.name = "FE_PART",
       .slot = &MarkerStatement::beam,
       .help = "the beam it belongs to",
       .ends = "PART POINT_MASS FLEX_BODY"},
      {.name = "NODE_LABEL",
       .slot = &MarkerStatement::label_of_node,
       .help = "the same as NODE_ID of a beam",
       .ends = "NODE_ID"},
      {.name = "QP", .slot = &MarkerStatement::origin, .unit = unit::length, .help = "origin in the body's axes"},
      {.name = "REULER",
       .slot = &MarkerStatement::angles,
       .unit = unit::angle,
       .help = "3-1-3 angles",
       .ends = "ZP XP USEXP",
       .unstated = 0},
      {.name = "ZP", .slot = &MarkerStatement::z_point, .unit = unit::length, .help = "point on +z", .ends = "REULER"},
      {.name = "XP",
       .slot = &MarkerStatement::x_point,
       .unit = unit::length,
       .help = "point in the x-z plane",
       .ends = "REULER"},
      {.name = "USEXP",
       .slot = &MarkerStatement::use_x_point,
       .help = "XP lies on +x, ZP fixes the plane",
       .ends = "REULER"},
      {.name = "FLOATING", .slot = &MarkerStatement::floating, .help = "placed by a force element"},
      {.name = "RM", .slot = &MarkerStatement::reference, .help = "marker whose frame QP and axes refer to"},
  }};
};

// What stays of it, beside the marker of the model, until all bodies are known.
struct ReadMarker {
  MarkerId reference;
};

// Of the few that a node carries.
struct NamedNode {
  std::int64_t number;
  Span at;
  bool states_place;  // with QP, or in the frame of another marker; a floating one has none
};

// Arguments of the language that are known and missing here. They must not take abbreviations from the others.
constexpr std::array<std::string_view, 3> not_built = {"CURVE", "SURFACE", "VELOCITY"};

bool names_what_is_not_built(ElementReader& reader) {
  bool found = false;
  for (const WrittenArgument& w : reader.statement().arguments) {
    const auto k = find_keyword(w.name.text(), not_built);
    if (!k || find_keyword(w.name.text(), detail::argument_names<MarkerStatement>)) continue;
    // The rest of the statement follows from the first.
    if (!found) {
      reader.error("argument-not-built", w.name,
                   fmt::format("{} of {} is not available yet", not_built[*k], reader.label().text()));
    }
    found = true;
  }
  return found;
}

class MarkerSet final : public TypedSet<ReadMarker> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    MarkerStatement m;
    if (names_what_is_not_built(reader) || !read_arguments(m, reader)) return;
    const auto owner = owner_of(m, reader);
    if (!owner) return;
    if (m.floating && (reader.given("QP") || m.angles || m.z_point || m.x_point)) {
      reader.error("placed-floating-marker", reader.at("FLOATING"),
                   fmt::format("{} is FLOATING and takes no place of its own", reader.label().text()));
    }
    if (m.use_x_point && !m.x_point) {
      reader.error("missing-argument", reader.at("USEXP"), "USEXP needs XP");
      return;
    }
    const Span node_at = reader.at(m.label_of_node ? "NODE_LABEL" : "NODE_ID");
    if (m.node && m.label_of_node) {
      reader.error("two-owners", node_at, fmt::format("{} has NODE_ID and NODE_LABEL", reader.label().text()));
    }
    elements[k].reference = m.reference;
    if (const auto node = m.label_of_node ? m.label_of_node : m.node)
      nodes_.emplace(k, NamedNode{*node, node_at, reader.given("QP") || m.floating || m.reference.valid()});
    Marker& marker = *reader.own_marker();
    marker.floating = m.floating;
    marker.place.body = *owner, marker.place.p_BM = m.origin;
    const auto axes =
        orientation({m.angles, m.z_point, m.x_point, "REULER", "ZP", "XP", m.use_x_point}, m.origin, reader);
    if (axes) marker.place.R_BM = *axes;
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    state_.assign(elements.size(), State::as_written);
    const std::vector<FlexibleBody> flexible = flexible_bodies(model);
    const std::vector<BeamBody> beams = beam_bodies(model);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      if (const BeamBody* beam = beam_of(marker_of(k, model), beams)) {
        put_on_beam(k, *beam, model, diagnostics);
      } else {
        put_on_node(k, flexible, model, diagnostics);
      }
    }
    for (std::size_t k = 0; k < elements.size(); ++k) refer(k, model, diagnostics);
    for (std::size_t k = 0; k < elements.size(); ++k) add_shapes(k, flexible, model);
    // All that counts is in the model now.
    std::vector<ReadMarker>().swap(elements);
    std::vector<State>().swap(state_);
    nodes_.clear();
  }

 private:
  enum class State : std::uint8_t { as_written, on_the_way, placed, faulty };

  // The body that it names, or that is stated before it.
  static std::optional<BodyId> owner_of(const MarkerStatement& m, ElementReader& reader) {
    const std::array<std::pair<std::string_view, BodyId>, 4> owners = {
        {{"PART", m.part}, {"POINT_MASS", m.point_mass}, {"FLEX_BODY", m.flex_body}, {"FE_PART", m.beam}}};
    std::optional<BodyId> named;
    std::string_view first;
    for (const auto& [word, owner] : owners) {
      if (!owner.valid()) continue;
      if (named) {
        reader.error("two-owners", reader.at(word),
                     fmt::format("{} belongs to a {} and to a {}", reader.label().text(), first, word));
        break;
      }
      named = owner, first = word;
    }
    if (named) return named;
    const auto body = reader.preceding_body();
    if (!body) {
      reader.error("missing-owner", reader.statement().at,
                   fmt::format("{} states no owner and no body stands before it", reader.label().text()));
    }
    return body;
  }

  std::size_t reference_of(std::size_t k) const { return static_cast<std::size_t>(elements[k].reference.index) - 1; }

  // Marker k of this set is marker k + 1 of the model.
  static Marker& marker_of(std::size_t k, Model& model) { return model.markers[k + 1]; }
  const NamedNode* node_of(std::size_t k) const {
    const auto found = nodes_.find(k);
    return found == nodes_.end() ? nullptr : &found->second;
  }

  static const FlexibleBody* flexible_owner(const Marker& m, const std::vector<FlexibleBody>& flexible) {
    const auto found = std::ranges::find(flexible, m.place.body, &FlexibleBody::body);
    return found == flexible.end() ? nullptr : &*found;
  }

  static const BeamBody* beam_of(const Marker& m, const std::vector<BeamBody>& beams) {
    const auto found = std::ranges::find(beams, m.place.body, [](const BeamBody& b) { return b.nodes.front(); });
    return found == beams.end() ? nullptr : &*found;
  }

  // A node of a beam is a body of its own, which carries what is stated in the BCS with the offset that it is drawn at.
  void put_on_beam(std::size_t k, const BeamBody& beam, Model& model, Diagnostics& diagnostics) const {
    const NamedNode* named = node_of(k);
    const std::string name = labels[k].text(), owner = beam.label->text();
    if (!named) {
      diagnostics.error("missing-argument", labels[k].at, fmt::format("{} on {} needs NODE_LABEL", name, owner),
                        "the node of the beam that carries it");
      return;
    }
    const auto node = std::ranges::find(beam.numbers, named->number);
    if (node == beam.numbers.end()) {
      diagnostics.error("unknown-node", named->at, fmt::format("{} has no node {}", owner, named->number),
                        fmt::format("its nodes are {}", fmt::join(beam.numbers, ", ")));
      return;
    }
    Marker& marker = marker_of(k, model);
    MarkerPlace& place = marker.place;
    const auto index = static_cast<std::size_t>(node - beam.numbers.begin());
    place.body = beam.nodes[index];
    if (elements[k].reference.valid()) return;  // in the frame of a marker of the same node
    const Matrix3 from_bcs = transpose(model.body(place.body).pose.R) * beam.drawn.R;
    if (!marker.floating) place.p_BM = from_bcs * (place.p_BM - beam.places[index]);
    place.R_BM = from_bcs * place.R_BM;
    if (!named->states_place) warn_of_place(k, beam, index, diagnostics);
  }

  // Who leaves QP out may mean the node.
  void warn_of_place(std::size_t k, const BeamBody& beam, std::size_t node, Diagnostics& diagnostics) const {
    constexpr double same_place = 1e-9;
    const Vector& at = beam.places[node];
    double extent = 0;
    for (const Vector& place : beam.places) extent = std::max(extent, norm(place));
    if (norm(at) <= same_place * extent) return;
    diagnostics.warning(
        "marker-off-node", labels[k].at,
        fmt::format(
            "{0} states no QP and is at the origin of {1}, {2:g} away from its node {3} at ({4:g}, {5:g}, {6:g})",
            labels[k].text(), beam.label->text(), norm(at), beam.numbers[node], at.x, at.y, at.z),
        fmt::format("QP={}, {}, {} puts it at the node, QP=0, 0, 0 says that the origin is meant", at.x, at.y, at.z));
  }

  // On a flexible body QP counts from the node, but for one that is placed in the frame of another marker.
  void put_on_node(std::size_t k, const std::vector<FlexibleBody>& flexible, Model& model,
                   Diagnostics& diagnostics) const {
    Marker& m = marker_of(k, model);
    const FlexibleBody* owner = flexible_owner(m, flexible);
    if (owner && !owner->flexible) return;  // its own statement has errors
    const NamedNode* named = node_of(k);
    if (!owner && !named) return;
    const std::string name = labels[k].text();
    const ElementLabel& body = model.body(m.place.body).label;
    if (!owner) {
      // A FLEX_BODY or FE_PART that is none has errors of its own.
      if (body.statement != "FLEX_BODY" && body.statement != "FE_PART")
        diagnostics.error("unknown-node", named->at,
                          fmt::format("{} names a node, but {} is no FLEX_BODY and no FE_PART", name, body.text()));
      return;
    }
    if (!named && m.floating) return;
    if (!named) {
      diagnostics.error("missing-argument", labels[k].at, fmt::format("{} on {} needs NODE_ID", name, body.text()),
                        "the node of the body that carries it");
      return;
    }
    const auto node = owner->flexible->node(named->number);
    if (!node) {
      diagnostics.error("unknown-node", named->at, fmt::format("{} has no node {}", body.text(), named->number),
                        owner->flexible->near_nodes(named->number));
      return;
    }
    if (!elements[k].reference.valid()) m.place.p_BM += owner->flexible->position[*node];
  }

  void add_shapes(std::size_t k, const std::vector<FlexibleBody>& flexible, Model& model) const {
    const NamedNode* named = node_of(k);
    if (!named) return;
    MarkerPlace& place = marker_of(k, model).place;
    const FlexibleBody* owner = flexible_owner(marker_of(k, model), flexible);
    const auto node = owner && owner->flexible ? owner->flexible->node(named->number) : std::nullopt;
    if (!node || owner->flexible->modes() == 0) return;
    const ModalBody& body = *owner->flexible;
    auto shapes = std::make_unique<NodeShapes>();
    shapes->first = owner->first;
    shapes->offset = place.p_BM - body.position[*node];
    const auto row = 3 * static_cast<Eigen::Index>(*node);
    for (Eigen::Index mode = 0; mode < body.modes(); ++mode) {
      const auto of = [&](const Eigen::MatrixXd& x) {
        return Vector{x(row, mode), x(row + 1, mode), x(row + 2, mode)};
      };
      shapes->translation.push_back(of(body.translation));
      shapes->rotation.push_back(of(body.rotation));
    }
    place.shapes = shapes.get();
    model.node_shapes.push_back(std::move(shapes));
  }

  // The place in the body's axes of a marker given in the frame of another, which may be given so itself. Each is
  // placed once, however long the chain.
  void refer(std::size_t k, Model& model, Diagnostics& diagnostics) {
    std::vector<std::size_t> chain;
    std::size_t at = k;
    for (; elements[at].reference.valid() && state_[at] == State::as_written; at = reference_of(at)) {
      state_[at] = State::on_the_way;
      chain.push_back(at);
    }
    bool circular = !chain.empty() && state_[at] == State::on_the_way;  // from `at` on
    for (; !chain.empty(); chain.pop_back()) {
      const std::size_t marker = chain.back(), next = reference_of(marker);
      if (circular) {
        state_[marker] = State::faulty;
        diagnostics.error("circular-reference", labels[marker].at,
                          fmt::format("{} refers to itself through RM", labels[marker].text()));
        circular = marker != at;
      } else if (marker_of(next, model).place.body != marker_of(marker, model).place.body) {
        state_[marker] = State::faulty;
        diagnostics.error("foreign-reference", labels[marker].at,
                          fmt::format("RM of {} is on another body", labels[marker].text()));
      } else if (!check_fixed(model, labels[marker], elements[marker].reference, "RM", diagnostics)) {
        state_[marker] = State::faulty;
      } else if (state_[next] == State::faulty) {
        state_[marker] = State::faulty;  // said of the other one
      } else {
        MarkerPlace& place = marker_of(marker, model).place;
        const MarkerPlace& reference = marker_of(next, model).place;
        place.p_BM = reference.p_BM + reference.R_BM * place.p_BM;
        place.R_BM = reference.R_BM * place.R_BM;
        state_[marker] = State::placed;
      }
    }
  }

  std::vector<State> state_;
  std::unordered_map<std::size_t, NamedNode> nodes_;  // by marker
};

}  // namespace

extern constinit const Kind marker = Kind{
    "MARKER",
    "",
    "A point with axes on a body.",
    Kind::Role::marker,
    detail::argument_infos<MarkerStatement>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<MarkerSet>(kind);
    }}.with_example("MARKER/20, QP=0,0,0.1");

}  // namespace dynalin
