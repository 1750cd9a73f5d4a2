// MARKER/id, {PART= | POINT_MASS=}, QP=, {REULER= | ZP=, XP= [, USEXP]}, FLOATING, RM=
//
// A point with axes on a body. QP is its origin and REULER (3-1-3) or the points ZP, XP its axes, all in the body
// coordinate system, or in the frame of marker RM. Without an owner it belongs to the body stated before it.
#include <fmt/format.h>

#include "elements/families/orientation.h"
#include "model/model.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct MarkerStatement {
  BodyId part, point_mass;
  Vector origin;
  std::optional<Vector> angles, z_point, x_point;
  bool use_x_point = false, floating = false;
  MarkerId reference;
  BodyId owner;
  Matrix3 axes = Matrix3::identity();

  static constexpr std::array<Argument<MarkerStatement>, 9> arguments = {{
      {.name = "PART", .slot = &MarkerStatement::part, .help = "the part it belongs to", .ends = "POINT_MASS"},
      {.name = "POINT_MASS",
       .slot = &MarkerStatement::point_mass,
       .help = "the point mass it belongs to",
       .ends = "PART"},
      {.name = "QP", .slot = &MarkerStatement::origin, .unit = unit::length, .help = "origin in the body's axes"},
      {.name = "REULER",
       .slot = &MarkerStatement::angles,
       .unit = unit::angle,
       .help = "3-1-3 angles",
       .ends = "ZP XP USEXP"},
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

// Arguments of the language that are known and missing here. They must not take abbreviations from the others.
constexpr std::array<std::string_view, 6> not_built = {"FLEX_BODY", "NODE_ID", "FE_PART",
                                                       "CURVE",     "SURFACE", "VELOCITY"};

bool names_what_is_not_built(ElementReader& reader) {
  bool found = false;
  for (const WrittenArgument& w : reader.statement().arguments) {
    if (find_keyword(w.name.text(), detail::argument_names<MarkerStatement>)) continue;
    const auto k = find_keyword(w.name.text(), not_built);
    if (!k) continue;
    // The rest of the statement follows from the first.
    if (!found) {
      reader.error("argument-not-built", w.name,
                   fmt::format("{} of {} is not available yet", not_built[*k], reader.label().text()));
    }
    found = true;
  }
  return found;
}

class MarkerSet final : public TypedSet<MarkerStatement> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    MarkerStatement& m = elements[k];
    if (names_what_is_not_built(reader) || !read_arguments(m, reader)) return;
    if (m.part.valid() && m.point_mass.valid()) {
      reader.error("two-owners", reader.at("POINT_MASS"),
                   fmt::format("{} belongs to a PART and to a POINT_MASS", reader.label().text()));
    }
    m.owner = m.part.valid() ? m.part : m.point_mass;
    if (!m.owner.valid()) {
      const auto body = reader.preceding_body();
      if (!body) {
        reader.error("missing-owner", reader.statement().at,
                     fmt::format("{} states no owner and no body stands before it", reader.label().text()));
        return;
      }
      m.owner = *body;
    }
    if (m.floating && (reader.given("QP") || m.angles || m.z_point || m.x_point)) {
      reader.error("placed-floating-marker", reader.at("FLOATING"),
                   fmt::format("{} is FLOATING and takes no place of its own", reader.label().text()));
    }
    if (m.use_x_point && !m.x_point) {
      reader.error("missing-argument", reader.at("USEXP"), "USEXP needs XP");
      return;
    }
    const auto axes =
        orientation({m.angles, m.z_point, m.x_point, m.use_x_point, "REULER", "ZP", "XP"}, m.origin, reader);
    if (axes) m.axes = *axes;
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    // Marker k of this set is marker k + 1 of the model.
    state_.assign(elements.size(), State::as_written);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      Marker& marker = model.markers[k + 1];
      marker.floating = elements[k].floating;
      marker.place = {elements[k].owner, elements[k].origin, elements[k].axes};
    }
    for (std::size_t k = 0; k < elements.size(); ++k) refer(k, model, diagnostics);
    // All that counts is in the model now.
    std::vector<MarkerStatement>().swap(elements);
    std::vector<State>().swap(state_);
  }

 private:
  enum class State : std::uint8_t { as_written, on_the_way, placed, faulty };

  std::size_t reference_of(std::size_t k) const { return static_cast<std::size_t>(elements[k].reference.index) - 1; }

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
      } else if (elements[next].owner != elements[marker].owner) {
        state_[marker] = State::faulty;
        diagnostics.error("foreign-reference", labels[marker].at,
                          fmt::format("RM of {} is on another body", labels[marker].text()));
      } else if (state_[next] == State::faulty) {
        state_[marker] = State::faulty;  // said of the other one
      } else {
        MarkerPlace& place = model.markers[marker + 1].place;
        const MarkerPlace& reference = model.markers[next + 1].place;
        place.p_BM = reference.p_BM + reference.R_BM * place.p_BM;
        place.R_BM = reference.R_BM * place.R_BM;
        state_[marker] = State::placed;
      }
    }
  }

  std::vector<State> state_;
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
