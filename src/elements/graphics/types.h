// The types of GRAPHICS with their arguments. Each is complete once its statement is read and checked, and draws itself
// then wherever the bodies are.
//
// A type gives
//
//     static constexpr std::string_view type;                      // "BOX"
//     static constexpr std::array<Argument<T>, n> arguments;
//     void complete(ElementReader&);                               // ranges, and what goes together: errors
//     std::vector<MarkerId> markers() const;                       // that must be fixed on their bodies
//     void draw(Canvas&) const;
//
// and, where it is so,
//
//     static constexpr Shape::Origin origin;                                        // if no plain statement
//     void check(const Model&, const ElementLabel&, Diagnostics&) const;            // errors that need other ones
//     std::optional<ContactShape> contact_shape() const;                            // what CONTACTs can touch
// or, where it needs other statements,
//     std::optional<ContactShape> contact_shape(const Model&, std::string& why) const;
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "elements/graphics/arguments.h"
#include "elements/graphics/canvas.h"
#include "elements/graphics/swept_types.h"
#include "geometry/contact_shape.h"

namespace dynalin::drawing {

// BOX, CORNER=, X=, Y=, Z=: from the corner along the axes of its marker; extents may be negative.
struct Box {
  MarkerId corner;
  double x = 0, y = 0, z = 0;

  static constexpr std::string_view type = "BOX";
  static constexpr std::array<Argument<Box>, 4> arguments = {{
      needed("CORNER", &Box::corner, "marker at a corner, axes along the sides"),
      extent_of("X", &Box::x, "extent along x"),
      extent_of("Y", &Box::y, "extent along y"),
      extent_of("Z", &Box::z, "extent along z"),
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {corner}; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape() const;
};

// CYLINDER, CM=, LENGTH=, RADIUS= [, RANGLE=] [, SEG=, SIDES=]: from the centre of the bottom along z, which LENGTH may
// be against; a wedge from x on where RANGLE is less than a turn.
struct Cylinder {
  MarkerId cm;
  double length = 0, radius = 0, angle = 2 * std::numbers::pi;
  std::optional<std::int64_t> segments, sides;

  static constexpr std::string_view type = "CYLINDER";
  static constexpr std::array<Argument<Cylinder>, 6> arguments = {{
      needed("CM", &Cylinder::cm, "marker at the centre, or that of the bottom"),
      extent_of("LENGTH", &Cylinder::length, "along z, of either sign"),
      extent_of("RADIUS", &Cylinder::radius, "of a circle, an arc, a cylinder, the corners of a plate"),
      turn_by(&Cylinder::angle),
      segments_of(&Cylinder::segments),
      lines_of_sides(&Cylinder::sides),
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {cm}; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape() const;
};

// FRUSTUM, CM=, LENGTH=, TOP=, BOTTOM= [, RANGLE=] [, SEG=, SIDES=]: like a cylinder with two radii, one of which may
// be 0.
struct Frustum {
  MarkerId cm;
  double length = 0, top = 0, bottom = 0, angle = 2 * std::numbers::pi;
  std::optional<std::int64_t> segments, sides;

  static constexpr std::string_view type = "FRUSTUM";
  static constexpr std::array<Argument<Frustum>, 7> arguments = {{
      needed("CM", &Frustum::cm, "marker at the centre of the bottom"),
      extent_of("LENGTH", &Frustum::length, "along z"),
      {.name = "TOP",
       .slot = &Frustum::top,
       .required = true,
       .unit = unit::length,
       .minimum = 0,
       .help = "radius of a frustum at z = LENGTH"},
      {.name = "BOTTOM",
       .slot = &Frustum::bottom,
       .required = true,
       .unit = unit::length,
       .minimum = 0,
       .help = "radius of a frustum at its marker"},
      turn_by(&Frustum::angle),
      segments_of(&Frustum::segments),
      lines_of_sides(&Frustum::sides),
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {cm}; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape() const;
};

// ELLIPSOID, CM=, XSCALE=, YSCALE=, ZSCALE= [, SEG=]: whole lengths along the axes; three that are equal make a sphere.
struct Ellipsoid {
  MarkerId cm;
  double x = 0, y = 0, z = 0;
  std::optional<std::int64_t> segments;

  static constexpr std::string_view type = "ELLIPSOID";
  static constexpr std::array<Argument<Ellipsoid>, 5> arguments = {{
      needed("CM", &Ellipsoid::cm, "marker at the centre"),
      extent_of("XSCALE", &Ellipsoid::x, "diameter along x"),
      extent_of("YSCALE", &Ellipsoid::y, "diameter along y"),
      extent_of("ZSCALE", &Ellipsoid::z, "diameter along z"),
      segments_of(&Ellipsoid::segments),
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {cm}; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape() const;
};

// TORUS, CM=, MAJOR_RADIUS=, MINOR_RADIUS= [, RANGLE=] [, SEG=]: about z. RMAJOR and RMINOR are other names.
struct Torus {
  MarkerId cm;
  std::optional<double> major, minor, rmajor, rminor;
  double angle = 2 * std::numbers::pi;
  std::optional<std::int64_t> segments, sides;

  static constexpr std::string_view type = "TORUS";
  static constexpr std::array<Argument<Torus>, 8> arguments = {{
      needed("CM", &Torus::cm, "marker at the centre"),
      {.name = "MAJOR_RADIUS",
       .slot = &Torus::major,
       .unit = unit::length,
       .help = "of the circle that a tube follows"},
      {.name = "MINOR_RADIUS", .slot = &Torus::minor, .unit = unit::length, .help = "of the tube of a torus"},
      {.name = "RMAJOR", .slot = &Torus::rmajor, .unit = unit::length, .help = "another name of MAJOR_RADIUS"},
      {.name = "RMINOR", .slot = &Torus::rminor, .unit = unit::length, .help = "another name of MINOR_RADIUS"},
      turn_by(&Torus::angle),
      segments_of(&Torus::segments),
      lines_of_sides(&Torus::sides),
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {cm}; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape() const;
};

// CIRCLE, CM=, RADIUS= [, SEG=]: a line in the plane of x and y.
struct Circle {
  MarkerId cm;
  double radius = 0;
  std::optional<std::int64_t> segments;

  static constexpr std::string_view type = "CIRCLE";
  static constexpr std::array<Argument<Circle>, 3> arguments = {{
      needed("CM", &Circle::cm, "marker at the centre"),
      extent_of("RADIUS", &Circle::radius, "of the circle"),
      segments_of(&Circle::segments),
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {cm}; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape() const;
};

// ARC, CM=, RADIUS=, RANGLE= [, SEG=]: a line in the plane of x and y, from x on about z.
struct Arc {
  MarkerId cm;
  double radius = 0, angle = 0;
  std::optional<std::int64_t> segments;

  static constexpr std::string_view type = "ARC";
  static constexpr std::array<Argument<Arc>, 4> arguments = {{
      needed("CM", &Arc::cm, "marker at the centre"),
      extent_of("RADIUS", &Arc::radius, "of the arc"),
      {.name = "RANGLE", .slot = &Arc::angle, .required = true, .unit = unit::angle, .help = "its angle"},
      segments_of(&Arc::segments),
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {cm}; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape() const;
};

// OUTLINE=id, id, …: lines from marker to marker, which may be on several bodies.
struct OutlineOf {
  std::vector<std::int64_t> ids, also;
  std::vector<MarkerId> points;

  static constexpr std::string_view type = "OUTLINE";
  static constexpr std::array<Argument<OutlineOf>, 2> arguments = {{
      {.name = "OUTLINE", .slot = &OutlineOf::ids, .help = "the type: lines through the markers that it lists"},
      {.name = "MARKERS", .slot = &OutlineOf::also, .help = "markers at the corners", .ids_of = MarkerClass::statement},
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return points; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape(const Model&, std::string& why) const;
};

// CURVE, CID=, CRM= [, SEG=]: a CURVE in the axes of a marker.
struct CurveLine {
  CurveRef curve;
  MarkerId rm;
  std::optional<std::int64_t> segments;

  static constexpr std::string_view type = "CURVE";
  static constexpr std::array<Argument<CurveLine>, 3> arguments = {{
      needed("CID", &CurveLine::curve, "the CURVE"),
      needed("CRM", &CurveLine::rm, "marker in whose axes the curve is stated"),
      segments_of(&CurveLine::segments),
  }};
  void complete(ElementReader&) {}
  std::vector<MarkerId> markers() const { return {rm}; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape(const Model&, std::string& why) const;
};

// PLANE, RM=, XMIN=, XMAX=, YMIN=, YMAX=: a rectangle in the plane of x and y, seen from z.
struct Plane {
  MarkerId rm;
  double xmin = 0, xmax = 0, ymin = 0, ymax = 0;

  static constexpr std::string_view type = "PLANE";
  static constexpr std::array<Argument<Plane>, 5> arguments = {{
      needed("RM", &Plane::rm, "marker in whose axes it is stated"),
      extent_of("XMIN", &Plane::xmin, "where a plane begins"),
      extent_of("XMAX", &Plane::xmax, "where a plane ends"),
      extent_of("YMIN", &Plane::ymin, "where a plane begins"),
      extent_of("YMAX", &Plane::ymax, "where a plane ends"),
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {rm}; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape() const;
};

// POINT, RM=
struct Point {
  MarkerId rm;

  static constexpr std::string_view type = "POINT";
  static constexpr std::array<Argument<Point>, 1> arguments = {{
      needed("RM", &Point::rm, "marker at the point"),
  }};
  void complete(ElementReader&) {}
  std::vector<MarkerId> markers() const { return {rm}; }
  void draw(Canvas&) const;
  std::optional<ContactShape> contact_shape() const;
};

// EXTERNAL, RM=, FILE= [, ELEMENT=]: what a file of facets holds, in the axes of a marker. The file is read when
// somebody wants to see it.
struct External {
  MarkerId rm;
  std::string file, element, folder;
  std::optional<double> tolerance;
  Span at;

  static constexpr std::string_view type = "EXTERNAL";
  static constexpr Shape::Origin origin = Shape::Origin::file;
  static constexpr std::array<Argument<External>, 4> arguments = {{
      needed("RM", &External::rm, "marker in whose axes the file is stated"),
      needed("FILE", &External::file, "STL, OBJ or shell file"),
      {.name = "ELEMENT",
       .slot = &External::element,
       .help = "solid, object or group in the file, all unless it has it"},
      {.name = "FACETING_TOLERANCE",
       .slot = &External::tolerance,
       .help = "of files of CAD programs: read, without use"},
  }};
  void complete(ElementReader&);
  std::vector<MarkerId> markers() const { return {rm}; }
  void draw(Canvas&) const;
};

// SPDP, I=, J= [, COILS=, DA=] [, DB=, DC=, LC=, LD=] [, LA=, LB=]: a spring and a damper from marker to marker.
struct SpringDamper {
  MarkerId i, j;
  double coils = 0, da = 0, db = 0, dc = 0, dd = 0, la = 0, lb = 0, lc = 0, ld = 0;
  std::optional<std::int64_t> segments;

  static constexpr std::string_view type = "SPDP";
  static constexpr Shape::Origin origin = Shape::Origin::spring_damper;
  static constexpr std::array<Argument<SpringDamper>, 12> arguments = {{
      needed("I", &SpringDamper::i, "marker at one end"),
      needed("J", &SpringDamper::j, "marker at the other end"),
      {.name = "COILS", .slot = &SpringDamper::coils, .minimum = 0, .help = "of the spring", .maximum = 1000},
      unless_stated_zero("DA", &SpringDamper::da, "diameter of the spring"),
      unless_stated_zero("DB", &SpringDamper::db, "of the damper's tube at I"),
      unless_stated_zero("DC", &SpringDamper::dc, "of the damper's tube at J"),
      unless_stated_zero("DD", &SpringDamper::dd, "read, not drawn"),
      unless_stated_zero("LA", &SpringDamper::la, "straight piece at I"),
      unless_stated_zero("LB", &SpringDamper::lb, "straight piece at J"),
      unless_stated_zero("LC", &SpringDamper::lc, "length of the tube at I"),
      unless_stated_zero("LD", &SpringDamper::ld, "length of the tube at J"),
      segments_of(&SpringDamper::segments),
  }};
  void complete(ElementReader&) {}
  std::vector<MarkerId> markers() const { return {i, j}; }
  void draw(Canvas&) const;
};

// FORCE, ETYPE=, EID=, EMARKER=: an arrow that grows with a force; nothing of it is drawn.
struct ForceArrow {
  std::vector<std::string> element_type;
  std::optional<std::int64_t> element;
  MarkerId marker;

  static constexpr std::string_view type = "FORCE";
  static constexpr std::array<Argument<ForceArrow>, 3> arguments = {{
      {.name = "ETYPE", .slot = &ForceArrow::element_type, .help = "class of the force that an arrow stands for"},
      {.name = "EID", .slot = &ForceArrow::element, .help = "its id"},
      {.name = "EMARKER", .slot = &ForceArrow::marker, .help = "marker at the arrow"},
  }};
  void complete(ElementReader&) {}
  std::vector<MarkerId> markers() const { return {}; }
  void draw(Canvas&) const {}
};

}  // namespace dynalin::drawing
