// The GRAPHICS that a CONTACT is between.
#include <initializer_list>
#include <string>
#include <utility>

#include "mechanism.h"
#include "text.h"

namespace dynalin::oracle {

namespace {

using Argument = std::pair<const char*, double>;

std::string graphics(int id, const std::string& type, const std::string& marker,
                     std::initializer_list<Argument> arguments) {
  std::string text = "GRAPHICS/" + std::to_string(id) + "\n, " + type + "\n, " + marker + "\n";
  for (const auto& [name, value] : arguments) text += ", " + std::string(name) + " = " + number(value) + "\n";
  return text;
}

std::string solid_text(int id, int marker, const Solid& s) {
  const auto& [a, b, c] = s.size;
  const std::string at = std::to_string(marker), centre = "CM = " + at;
  switch (s.shape) {
    case SolidShape::ellipsoid:
      return graphics(id, "ELLIPSOID", centre, {{"XSCALE", a}, {"YSCALE", b}, {"ZSCALE", c}});
    case SolidShape::box:
      return graphics(id, "BOX", "CORNER = " + at, {{"X", a}, {"Y", b}, {"Z", c}});
    case SolidShape::frustum:
      if (b == c) return graphics(id, "CYLINDER", centre, {{"LENGTH", a}, {"RADIUS", b}});
      return graphics(id, "FRUSTUM", centre, {{"LENGTH", a}, {"BOTTOM", b}, {"TOP", c}});
    case SolidShape::torus:
      return graphics(id, "TORUS", centre, {{"MAJOR_RADIUS", a}, {"MINOR_RADIUS", b}});
    case SolidShape::wedge:
      return graphics(id, "CYLINDER", centre, {{"LENGTH", a}, {"RADIUS", b}, {"RANGLE", c}, {"SEG", 3}});
  }
  return {};
}

std::string ball_text(int id, int marker, double radius) {
  return solid_text(id, marker, {SolidShape::ellipsoid, {2 * radius, 2 * radius, 2 * radius}});
}

}  // namespace

std::string shapes_text(const Touch& t) {
  const int on_i = 2 * t.id - 1, on_j = 2 * t.id;
  const std::string j = std::to_string(t.j);
  switch (t.kind) {
    case TouchKind::solids:
      return solid_text(on_i, t.i, t.solid_i) + solid_text(on_j, t.j, t.solid_j);
    case TouchKind::disc_on_curve:
      return graphics(on_i, "CIRCLE", "CM = " + std::to_string(t.i), {{"RADIUS", t.radius_i}}) +
             graphics(on_j, "CURVE", "CID = " + std::to_string(t.curve) + "\n, CRM = " + j, {});
    case TouchKind::balls:
      return ball_text(on_i, t.i, t.radius_i) + ball_text(on_j, t.j, t.radius_j);
    case TouchKind::ball_on_plane:
      break;
  }
  const double far = 50 * t.radius_i;
  return ball_text(on_i, t.i, t.radius_i) +
         graphics(on_j, "PLANE", "RM = " + j, {{"XMIN", -far}, {"XMAX", far}, {"YMIN", -far}, {"YMAX", far}});
}

}  // namespace dynalin::oracle
