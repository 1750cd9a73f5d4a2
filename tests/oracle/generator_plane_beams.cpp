// Plane beams of a draw: stated without deformation in a plane along two global axes, with sections turned about the
// line. The first node carries a part that nothing else holds, so that no row says again what the plane says; the last
// one may be held in the plane by what else there is. Nodes that are not held are somewhere else in the plane.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "generator.h"

namespace dynalin::oracle {

namespace {

// Columns along a, b and the normal.
Mat axes_of_plane(BeamPlane plane) {
  const PlaneAxes axes = axes_of(plane);
  return {{unit(axes.a), unit(axes.b), unit(axes.normal)}};
}

// A drawn shape in which no element is near what has no direction in the middle, or turns back.
void check_bend(const Vec& chord, const Vec& before, const Vec& after, Real length) {
  const Vec middle = (1.5L / length) * chord - 0.25L * (before + after);
  for (const Vec& s : {before, after}) {
    if (dot(middle, s) < 0.3L * norm(s)) throw std::runtime_error("a plane beam is bent too far");
  }
}

}  // namespace

void Draw::draw_plane_beam() {
  Beam b;
  b.id = static_cast<int>(m_.beams.size()) + 1;
  b.plane = plane_;
  const std::size_t n = chance(0.2) ? 2 : 3 + static_cast<std::size_t>(pick(2));
  const Mat plane = axes_of_plane(b.plane);
  b.qg = to_triple(box(L_));
  // The BCS anywhere, or in the plane.
  b.reuler = angles_313(chance(0.6) ? orientation() : plane * rotation_z(uniform(-3, 3)));
  const Mat bcs = rotation_313(b.reuler);
  const double l = L_ * uniform(0.6, 0.9), arc = chance(0.6) ? uniform(-0.8, 0.8) : 0;
  const double roll = chance(0.4) ? 0 : uniform(-3, 3), twist = chance(0.5) ? uniform(-0.4, 0.4) : 0;
  Vec at = box(L_);
  double heading = uniform(-3, 3);
  for (std::size_t k = 0; k < n; ++k) {
    if (k > 0) {
      at += l * (plane * Vec{std::cos(heading + arc / 2), std::sin(heading + arc / 2), 0});
      heading += arc;
    }
    b.places.push_back(to_triple(transpose(bcs) * (at - to_vec(b.qg))));
    const Mat section = plane * rotation_z(heading) * rotation_x(roll + static_cast<double>(k) * twist);
    b.angles.push_back(angles_313(transpose(bcs) * section));
  }
  draw_sections(b, n, {.flatness = 0.5, .skewed = 0.7, .lightest = 1, .heaviest = 3});
  m_.beams.push_back(b);
  join_plane_beam(b);
}

void Draw::join_plane_beam(const Beam& b) {
  std::vector<BodyRef> solid;
  for (const BodyRef& ref : bodies_) {
    if (ref == ground || (ref.kind == BodyKind::part && body(ref).mass > 0)) solid.push_back(ref);
  }
  add_body(BodyKind::part);
  const BodyRef carried = bodies_.back();
  add_bodies_of(b);
  const BodyRef first = b.node(0), last = b.node(b.nodes() - 1);
  const JointType type =
      one_of(std::vector{JointType::fixed, JointType::revolute, JointType::spherical, JointType::universal});
  chance(0.5) ? connect(first, carried, type) : connect(carried, first, type);
  // Lines and planes that hold the place where it may move, or an angle.
  const bool last_too = chance(0.5);
  if (last_too)
    connect(last, one_of(solid), one_of(std::vector{JointType::inline_, JointType::inplane, JointType::perpendicular}));
  const auto change = [&](const BodyRef& ref) -> Body& {
    return *std::find_if(m_.bodies.begin(), m_.bodies.end(), [&](const Body& body) { return body.ref == ref; });
  };
  const Mat plane = axes_of_plane(b.plane);
  for (std::size_t k = 0; k < b.nodes(); ++k) {
    Body& node = change(b.node(k));
    Mat R = rotation_313(node.reuler);
    if (k > 0 && !(last_too && b.node(k) == last)) {
      R = rotation_exponential(static_cast<Real>(uniform(-0.5, 0.5)) * plane.column[2]) * R;
      const Vec shift = plane * Vec{uniform(-0.15, 0.15) * L_, uniform(-0.15, 0.15) * L_, 0};
      node.qg = to_triple(to_vec(node.qg) + shift), node.reuler = angles_313(R);
    }
    change(b.slope(k)).qg = to_triple(static_cast<Real>(uniform(0.85, 1.15)) * R.column[0]);
    const int id = add_marker(b.node(k), {to_vec(node.qg) + box(0.3 * L_), orientation()});
    all_.push_back(id), oriented_.push_back(id), bodies_.push_back(b.node(k));
  }
  for (std::size_t k = 0; k + 1 < b.nodes(); ++k) {
    check_bend(to_vec(body(b.node(k + 1)).qg) - to_vec(body(b.node(k)).qg), to_vec(body(b.slope(k)).qg),
               to_vec(body(b.slope(k + 1)).qg), PlaneElement(b, k, m_.ucf).length());
  }
  const int id = add_marker(carried, {to_vec(body(carried).qg) + box(0.6 * L_), orientation()});
  all_.push_back(id), oriented_.push_back(id);
}

}  // namespace dynalin::oracle
