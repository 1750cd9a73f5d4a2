#include "elements/families/contact_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/families/common_frame.h"
#include "elements/families/markers.h"
#include "geometry/contact_shape.h"
#include "geometry/frustum_touch.h"

namespace dynalin {

namespace {

using Names = std::array<std::string_view, 2>;

// All ids of an argument, each with its place.
std::vector<ListedShape> ids_of(std::string_view name, ElementReader& reader) {
  std::vector<ListedShape> list;
  if (!reader.given(name)) return list;
  const Span at = reader.at(name);
  for (const WrittenArgument& w : reader.statement().arguments) {
    if (w.name.offset != at.offset || w.name.source != at.source) continue;
    Diagnostics known;  // what is wrong with the list itself was reported when it was read
    const auto ids = read_integers(w, *w.name.source, known);
    if (!ids) continue;
    for (const WrittenInteger& id : *ids) {
      const auto graphics = reader.element("GRAPHICS", id);
      if (graphics) list.push_back({id.value, *graphics, id.at});
    }
  }
  return list;
}

std::vector<ListedShape> listed(std::string_view name, const Names& flips, ElementReader& reader) {
  std::vector<ListedShape> list = ids_of(name, reader);
  for (std::size_t k = 0; k < list.size(); ++k) {
    for (std::size_t n = 0; n < k; ++n) {
      if (list[n].id != list[k].id) continue;
      reader.error("duplicate-argument", list[k].at,
                   fmt::format("{} of {} lists GRAPHICS/{} twice", name, reader.label().text(), list[k].id));
      return {};
    }
  }
  for (const std::string_view flip : flips) {
    for (const ListedShape& turned : ids_of(flip, reader)) {
      const auto it = std::find_if(list.begin(), list.end(), [&](const ListedShape& l) { return l.id == turned.id; });
      if (it == list.end()) {
        reader.error(
            "unexpected-value", turned.at,
            fmt::format("{} of {} lists GRAPHICS/{}, which {} does not", flip, reader.label().text(), turned.id, name));
        return {};
      }
      if (it->reversed) {
        reader.error("excluded-arguments", turned.at,
                     fmt::format("{} turns GRAPHICS/{} inside out twice", reader.label().text(), turned.id),
                     fmt::format("{} and {} do the same: name it in one of them", flips[0], flips[1]));
        return {};
      }
      it->reversed = true;
    }
  }
  return list;
}

// All shapes of one side in the axes of the marker of the first one; false after an error, here or where they stand.
bool place(const Model& model, const ElementLabel& label, const std::vector<ListedShape>& list,
           std::vector<PlacedSide>& out, MarkerId& first, Diagnostics& diagnostics) {
  for (const ListedShape& l : list) {
    const ElementSet& set = model.set(l.graphics);
    if (!set.sound[static_cast<std::size_t>(l.graphics.index)]) return false;
    const auto* source = dynamic_cast<const ContactShapeSource*>(&set);
    std::string what;
    const auto shape =
        source ? source->contact_shape(static_cast<std::size_t>(l.graphics.index), model, what) : std::nullopt;
    if (!shape) {
      if (what.empty()) return false;
      diagnostics.error(
          "contact-shape", l.at,
          fmt::format("{} names {}, {}, which nothing can touch", label.text(), model.label(l.graphics).text(), what),
          "solids, files of facets that bound one, PLANE and POINT can be touched, or in a plane CURVE, CIRCLE, ARC, "
          "OUTLINE and POINT, all of each on one node where the body deforms");
      return false;
    }
    const Marker& marker = model.marker(shape->marker);
    if (marker.floating) return false;  // reported with the GRAPHICS
    const MarkerPlace& place = marker.place;
    if (out.empty()) {
      first = shape->marker;
      out.push_back({{shape->shape, l.reversed}, {{}, Matrix3::identity()}, true});
      continue;
    }
    const MarkerPlace& at = model.marker(first).place;
    if (!move_as_one(model, shape->marker, first)) {
      const bool other_node = on_one_body(model, shape->marker, first);
      const std::string body = model.body(at.body).label.text();
      diagnostics.error(other_node ? "contact-shape" : "foreign-marker", l.at,
                        other_node ? fmt::format("{} is on another node of {} than the first shape of this side of {}",
                                                 model.label(l.graphics).text(), body, label.text())
                                   : fmt::format("{} is on {}, the first shape of this side of {} on {}",
                                                 model.label(l.graphics).text(), model.body(place.body).label.text(),
                                                 label.text(), body),
                        other_node ? "a CONTACT for each node" : "a CONTACT for each pair of bodies");
      return false;
    }
    const Frame<double> from_first{transpose_times(at.R_BM, place.p_BM - at.p_BM),
                                   transpose_times(at.R_BM, place.R_BM)};
    out.push_back({{shape->shape, l.reversed}, from_first, shape->marker == first});
  }
  return true;
}

// What an error calls it.
std::string name_of(const solid::Side& side) {
  using namespace solid;
  struct Namer {
    std::string_view operator()(const Ball& b) const { return b.radius == 0 ? "a POINT" : "a sphere"; }
    std::string_view operator()(const Ellipsoid&) const { return "an ELLIPSOID"; }
    std::string_view operator()(const Frustum&) const { return "a CYLINDER or FRUSTUM"; }
    std::string_view operator()(const Torus&) const { return "a TORUS"; }
    std::string_view operator()(const Box&) const { return "a BOX"; }
    std::string_view operator()(const Plane&) const { return "a PLANE"; }
    std::string_view operator()(const Polyhedron& f) const {
      return f.body->convex() ? "a convex body of facets" : "a body of facets that is not convex";
    }
    std::string_view operator()(const Profile&) const { return "a curve"; }
  };
  const std::string_view name = std::visit(Namer{}, side.shape);
  return side.reversed ? fmt::format("the inside of {}", name) : std::string(name);
}

// Whether forces between a frustum and a body of facets jump where its mantle passes over a corner.
bool jumps(const solid::Side& a, const solid::Side& b) {
  const auto* facets = std::get_if<solid::Polyhedron>(&b.shape);
  return std::holds_alternative<solid::Frustum>(a.shape) && facets && facets->body->convex() &&
         jumps_at_corners(*facets->body->convex());
}

bool check_pairs(const Model& model, const ElementLabel& label, const ContactSides& sides, const ContactForce& f,
                 Diagnostics& diagnostics) {
  for (std::size_t a = 0; a < f.I.size(); ++a) {
    for (std::size_t b = 0; b < f.J.size(); ++b) {
      const ListedShape &I = sides[0][a], &J = sides[1][b];
      if (touch_count(f.I[a].side, f.J[b].side) > 0) {
        if (jumps(f.I[a].side, f.J[b].side) || jumps(f.J[b].side, f.I[a].side)) {
          diagnostics.warning(
              "jumping-contact", J.at,
              fmt::format("{} lets {} and {} touch: where a mantle passes over corners of facets in shallow bends the "
                          "force jumps, and impacts and rolling gain or lose energy",
                          label.text(), model.label(I.graphics).text(), model.label(J.graphics).text()),
              "an ELLIPSOID or spheres in the place of either keep it");
        }
        continue;
      }
      if (solid::is_profile(f.I[a].side) != solid::is_profile(f.J[b].side)) {
        const bool curve_is_I = solid::is_profile(f.I[a].side);
        diagnostics.error("contact-shape", J.at,
                          fmt::format("{} lets {}, a curve, touch {}, which is no curve", label.text(),
                                      model.label((curve_is_I ? I : J).graphics).text(),
                                      model.label((curve_is_I ? J : I).graphics).text()),
                          "curves touch curves and POINTs, solids touch solids and POINTs");
        return false;
      }
      diagnostics.error(
          "contact-pair-not-built", J.at,
          fmt::format("{} lets {}, {}, touch {}, {}, which is not available yet", label.text(),
                      model.label(J.graphics).text(), name_of(f.J[b].side), model.label(I.graphics).text(),
                      name_of(f.I[a].side)),
          "all solids touch each other, a PLANE and the walls of a cavity; but of cavities that are not drawn in "
          "facets "
          "ELLIPSOIDs touch BOX, CYLINDER and FRUSTUM alone, and CYLINDERs, FRUSTUMs, BOXes and bodies of facets no "
          "TORUS; only one of two closed curves is a cavity");
      return false;
    }
  }
  return true;
}

// Curves are seen along z of each other: that says nothing where their planes stand across each other.
bool check_planes(const Model& model, const ElementLabel& label, const ContactSides& sides, const ContactForce& f,
                  Diagnostics& diagnostics) {
  static constexpr double least_cosine = 0.98;
  const RelativeFrame<double> I = drawn_frame(model, f.i, f.j);
  const auto z_of = [](const PlacedSide& s) { return s.from_first.axes.z; };
  for (std::size_t a = 0; a < f.I.size(); ++a) {
    for (std::size_t b = 0; b < f.J.size(); ++b) {
      if (!solid::is_profile(f.I[a].side) || !solid::is_profile(f.J[b].side)) continue;
      const Vector z = z_of(f.I[a]);
      const double cosine = std::abs(dot(I.x * z.x + I.y * z.y + I.z * z.z, z_of(f.J[b])));
      if (cosine >= least_cosine) continue;
      diagnostics.error("contact-shape", sides[1][b].at,
                        fmt::format("the planes of {} and {}, curves of {}, incline by {:.3g} degrees",
                                    model.label(sides[0][a].graphics).text(), model.label(sides[1][b].graphics).text(),
                                    label.text(), std::acos(std::min(cosine, 1.0)) * 180 / std::numbers::pi),
                        "curves touch in one plane: z of their markers is the same or opposite");
      return false;
    }
  }
  return true;
}

}  // namespace

ContactSides read_sides(ElementReader& reader) {
  return {listed("IGEOM", {"IFLIP_GEOMETRY", "IFLIP_NORMAL"}, reader),
          listed("JGEOM", {"JFLIP_GEOMETRY", "JFLIP_NORMAL"}, reader)};
}

bool place_sides(const Model& model, const ElementLabel& label, const ContactSides& sides, ContactForce& f,
                 Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  const bool placed =
      place(model, label, sides[0], f.I, f.i, diagnostics) && place(model, label, sides[1], f.J, f.j, diagnostics);
  if (!placed || diagnostics.error_count() > errors) return false;
  // That is an error of its own, whatever the shapes.
  if (model.marker(f.i).place.body == model.marker(f.j).place.body) return true;
  return check_pairs(model, label, sides, f, diagnostics) && check_planes(model, label, sides, f, diagnostics);
}

}  // namespace dynalin
