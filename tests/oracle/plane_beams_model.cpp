// Plane beams of a model: their elements on what they stand between, and the rows that keep their nodes in the plane.
//
// A node is a body of six coordinates, its slope a triple. Five rows leave the place and the slope in the plane: the
// place keeps its height above the plane through the origin; what pointed along the normal in the node where it was
// drawn still does; the slope lies in the plane, and along what was the x axis, so that the node turns with it.
#include "model.h"

namespace dynalin::oracle {

namespace {

PlanePose<Real> still(const PlanePose<Jet>& p) {
  const auto values = [](const Vector3<Jet>& v) { return Vec{v.x.v, v.y.v, v.z.v}; };
  return {{values(p.r[0]), values(p.r[1])}, {values(p.s[0]), values(p.s[1])}};
}

// A direction fixed in a body, and its first and second rate.
struct FixedDirection {
  Vec e, first, second;
  FixedDirection(const BodyMotion& body, const Vec& in_body)
      : e(body.R * in_body), first(cross(body.w, e)), second(cross(body.al, e) + cross(body.w, first)) {}
};

}  // namespace

void Model::read_plane_beams() {
  for (const Beam& b : mechanism_.beams) {
    if (!b.is_plane()) continue;
    const auto index = [&](const BodyRef& ref) { return static_cast<std::size_t>(body_index(ref)); };
    const Vec normal = unit(axes_of(b.plane).normal);
    const Mat bcs = rotation_313(b.reuler);
    for (std::size_t k = 0; k < b.nodes(); ++k) {
      const Mat back = transpose(bcs * rotation_313(b.angles[k]));
      const Vec in_node = back * normal;
      plane_nodes_.push_back({b.plane, index(b.node(k)), index(b.slope(k)),
                              dot(normal, to_vec(b.qg) + bcs * to_vec(b.places[k])), in_node,
                              cross(in_node, Vec{1, 0, 0})});
    }
    std::vector<Real> lengths;
    const std::size_t first_piece = plane_pieces_.size();
    for (std::size_t k = 0; k + 1 < b.nodes(); ++k) {
      PlanePiece piece;
      piece.plane = b.plane;
      piece.element = PlaneElement(b, k, mechanism_.ucf);
      piece.body = {index(b.node(k)), index(b.slope(k)), index(b.node(k + 1)), index(b.slope(k + 1))};
      lengths.push_back(piece.element.length());
      plane_pieces_.push_back(piece);
    }
    const std::vector<LoadedSpan> spans = loaded_spans(b, lengths);
    for (std::size_t k = 0; k < spans.size(); ++k) plane_pieces_[first_piece + k].span = spans[k];
  }
}

PlanePose<Jet> Model::pose_along_motion(const PlanePiece& piece) const {
  const PlaneAxes axes = axes_of(piece.plane);
  const auto along = [&](std::size_t part) {
    const BodyMotion& m = motion[piece.body[part]];
    return in_plane(axes, Vector3<Jet>{{m.p.x, m.v.x, m.a.x}, {m.p.y, m.v.y, m.a.y}, {m.p.z, m.v.z, m.a.z}});
  };
  return {{along(0), along(2)}, {along(1), along(3)}};
}

void Model::apply_plane_beams(std::vector<Wrench>& loads) const {
  for (const PlanePiece& piece : plane_pieces_) {
    const PlaneAxes axes = axes_of(piece.plane);
    const PlanePose<Jet> along = pose_along_motion(piece);
    const PlaneLoads own = piece.element.loads(along, to_vec(mechanism_.gravity));
    const PlaneLoads more = piece.element.loads(still(along), line_loads(piece.span, {}));
    for (std::size_t k = 0; k < plane_freedoms; ++k)
      loads[piece.body[k / 2]].f += (own[k] + more[k]) * unit(k % 2 == 0 ? axes.a : axes.b);
  }
}

void Model::add_plane_beam_masses(Dense& mass) const {
  for (const PlanePiece& piece : plane_pieces_) {
    const PlaneAxes axes = axes_of(piece.plane);
    const auto row = [&](std::size_t k) {
      return static_cast<std::size_t>(bodies[piece.body[k / 2]].offset + (k % 2 == 0 ? axes.a : axes.b));
    };
    for (std::size_t a = 0; a < plane_freedoms; ++a) {
      for (std::size_t b = 0; b < plane_freedoms; ++b) mass(row(a), row(b)) += piece.element.mass(a, b);
    }
  }
}

std::array<Real, 3> Model::plane_row(const Row& row) const {
  const PlaneNode& n = plane_nodes_[row.carried];
  const PlaneAxes axes = axes_of(n.plane);
  const BodyMotion &node = motion[n.node], &s = motion[n.slope];
  const Vec normal = unit(axes.normal);
  switch (row.component) {
    case 0:
      return {dot(normal, node.p) - n.height, dot(normal, node.v), dot(normal, node.a)};
    case 1:
    case 2: {
      const Vec in_plane = unit(row.component == 1 ? axes.a : axes.b);
      const FixedDirection up(node, n.normal);
      return {dot(in_plane, up.e), dot(in_plane, up.first), dot(in_plane, up.second)};
    }
    case 3:
      return {dot(normal, s.p), dot(normal, s.v), dot(normal, s.a)};
    default: {
      const FixedDirection m(node, n.across);
      return {dot(s.p, m.e), dot(s.v, m.e) + dot(s.p, m.first),
              dot(s.a, m.e) + 2 * dot(s.v, m.first) + dot(s.p, m.second)};
    }
  }
}

void Model::apply_plane_row(std::vector<Wrench>& loads, const Row& row, Real size) const {
  const PlaneNode& n = plane_nodes_[row.carried];
  const PlaneAxes axes = axes_of(n.plane);
  const Mat& R = motion[n.node].R;
  switch (row.component) {
    case 0:
      loads[n.node].f += size * unit(axes.normal);
      break;
    case 1:
    case 2:
      loads[n.node].t += size * cross(R * n.normal, unit(row.component == 1 ? axes.a : axes.b));
      break;
    case 3:
      loads[n.slope].f += size * unit(axes.normal);
      break;
    default:
      loads[n.slope].f += size * (R * n.across);
      loads[n.node].t += size * cross(R * n.across, motion[n.slope].p);
  }
}

}  // namespace dynalin::oracle
