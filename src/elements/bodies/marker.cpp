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
      {.name = "PART", .slot = &MarkerStatement::part, .help = "the part it belongs to"},
      {.name = "POINT_MASS", .slot = &MarkerStatement::point_mass, .help = "the point mass it belongs to"},
      {.name = "QP", .slot = &MarkerStatement::origin, .unit = unit::length, .help = "origin in the body's axes"},
      {.name = "REULER", .slot = &MarkerStatement::angles, .unit = unit::angle, .help = "3-1-3 angles"},
      {.name = "ZP", .slot = &MarkerStatement::z_point, .unit = unit::length, .help = "point on +z"},
      {.name = "XP", .slot = &MarkerStatement::x_point, .unit = unit::length, .help = "point in the x-z plane"},
      {.name = "USEXP", .slot = &MarkerStatement::use_x_point, .help = "XP lies on +x, ZP fixes the plane"},
      {.name = "FLOATING", .slot = &MarkerStatement::floating, .help = "placed by a force element"},
      {.name = "RM", .slot = &MarkerStatement::reference, .help = "marker whose frame QP and axes refer to"},
  }};
};

class MarkerSet final : public TypedSet<MarkerStatement> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    MarkerStatement& m = elements[k];
    if (!read_arguments(m, reader)) return;
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
    for (std::size_t k = 0; k < elements.size(); ++k) {
      Marker& marker = model.markers[k + 1];
      marker.floating = elements[k].floating;
      marker.place = {elements[k].owner, elements[k].origin, elements[k].axes};
      if (elements[k].reference.valid()) refer(k, model, diagnostics);
    }
  }

 private:
  // The place in the body's axes of a marker given in the frame of another, which may be given so itself.
  void refer(std::size_t k, Model& model, Diagnostics& diagnostics) {
    MarkerPlace place{elements[k].owner, elements[k].origin, elements[k].axes};
    std::size_t at = k;
    for (std::size_t steps = 0; elements[at].reference.valid(); ++steps) {
      const auto next = static_cast<std::size_t>(elements[at].reference.index) - 1;
      if (steps > elements.size()) {
        diagnostics.error("circular-reference", labels[k].at,
                          fmt::format("{} refers to itself through RM", labels[k].text()));
        return;
      }
      if (elements[next].owner != elements[k].owner) {
        diagnostics.error("foreign-reference", labels[k].at,
                          fmt::format("RM of {} is on another body", labels[k].text()));
        return;
      }
      place.p_BM = elements[next].origin + elements[next].axes * place.p_BM;
      place.R_BM = elements[next].axes * place.R_BM;
      at = next;
    }
    model.markers[k + 1].place = place;
  }
};

}  // namespace

extern constinit const Kind marker = {
    "MARKER",
    "",
    "A point with axes on a body.",
    Kind::Role::marker,
    detail::argument_infos<MarkerStatement>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<MarkerSet>(kind); }};

}  // namespace dynalin
