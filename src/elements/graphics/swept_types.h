// Types of GRAPHICS that are swept or widened from a line: types.h says what a type gives.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "elements/graphics/arguments.h"
#include "elements/graphics/canvas.h"
#include "geometry/contact_shape.h"

namespace dynalin::drawing {

// PLATE, MARKERS=id, id, id, …, THICKNESS= [, RADIUS=] [, SEG=]: a polygon with markers of one body at its corners,
// widened by RADIUS with arcs about them, half of THICKNESS to either side of it.
struct Plate {
  std::vector<std::int64_t> ids;
  double thickness = 0, radius = 0;
  std::optional<std::int64_t> segments;
  std::vector<MarkerId> corners;

  static constexpr std::string_view type = "PLATE";
  static constexpr std::array<Argument<Plate>, 4> arguments = {{
      needed("MARKERS", &Plate::ids, "markers at the corners"),
      extent_of("THICKNESS", &Plate::thickness, "of a plate"),
      unless_stated_zero("RADIUS", &Plate::radius, "of its corners"),
      segments_of(&Plate::segments),
  }};
  void complete(ElementReader&);
  void check(const Model&, const ElementLabel&, Diagnostics&) const;
  std::vector<MarkerId> markers() const { return corners; }
  void draw(Canvas&) const;
};

// LINK, I=, J=, WIDTH=, DEPTH= [, SEG=]: a bar with round ends about two markers, on the body of I, DEPTH along z of I.
struct Link {
  MarkerId i, j;
  double width = 0, depth = 0;
  std::optional<std::int64_t> segments;

  static constexpr std::string_view type = "LINK";
  static constexpr std::array<Argument<Link>, 5> arguments = {{
      needed("I", &Link::i, "marker at one end, on the body of the link"),
      needed("J", &Link::j, "marker at the other end"),
      extent_of("WIDTH", &Link::width, "of a link, across"),
      extent_of("DEPTH", &Link::depth, "of a link, along z of I"),
      segments_of(&Link::segments),
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {i, j}; }
  void draw(Canvas&) const;
};

// EXTRUSION, CID=, CRM=, LENGTH= [, SEG=]: what a CURVE sweeps along z of the marker that carries it.
struct Extrusion {
  CurveRef curve;
  MarkerId rm;
  double length = 0;
  std::optional<std::int64_t> segments;

  static constexpr std::string_view type = "EXTRUSION";
  static constexpr std::array<Argument<Extrusion>, 4> arguments = {{
      needed("CID", &Extrusion::curve, "the CURVE that is its profile"),
      needed("CRM", &Extrusion::rm, "marker in whose axes the curve is stated"),
      extent_of("LENGTH", &Extrusion::length, "along z"),
      segments_of(&Extrusion::segments),
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {rm}; }
  void draw(Canvas&) const;
};

// REVOLUTION, CID=, CRM= [, RANGLE=] [, SEG=, SIDES=]: what a CURVE sweeps about z of the marker that carries it.
struct Revolution {
  CurveRef curve;
  MarkerId rm;
  double angle = 2 * std::numbers::pi;
  std::optional<std::int64_t> segments, sides;

  static constexpr std::string_view type = "REVOLUTION";
  static constexpr std::array<Argument<Revolution>, 5> arguments = {{
      needed("CID", &Revolution::curve, "the CURVE that is its profile"),
      needed("CRM", &Revolution::rm, "marker about whose z it turns"),
      turn_by(&Revolution::angle),
      segments_of(&Revolution::segments),
      {.name = "SIDES",
       .slot = &Revolution::sides,
       .minimum = 1,
       .help = "pieces along the profile of a revolution",
       .maximum = most_segments},
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {rm}; }
  void draw(Canvas&) const;
};

}  // namespace dynalin::drawing
