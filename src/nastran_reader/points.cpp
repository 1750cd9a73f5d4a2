#include "nastran_reader/points.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/degree.h"

namespace dynalin::nastran_reader {

namespace {

using Eigen::Matrix3d;

// Systems and grids define each other: systems by coordinates in others, or by grids, which lie in systems.
class Resolver {
 public:
  Resolver(const Deck& deck, Diagnostics& diagnostics, std::unordered_map<int, Axes>& found)
      : diagnostics_(diagnostics), found_(found) {
    found_[0] = {};
    for (const System& s : deck.systems) {
      const auto [at, is_new] = cards_.emplace(s.id.id, &s);
      if (!is_new)
        diagnostics_
            .error("duplicate-card-id", s.id.at, fmt::format("the coordinate system {} is defined twice", s.id.id))
            .notes.push_back({at->second->id.at, "the first one"});
    }
    for (const Grid& g : deck.grids) grids_.emplace(g.id.id, &g);
    for (const System& s : deck.systems) system(s.id.id, s.id.at);
  }

  // Nothing where it is missing or wrong, which has been told.
  const Axes* system(int id, const Span& named_at) {
    if (const auto done = found_.find(id); done != found_.end()) return &done->second;
    const auto card = cards_.find(id);
    if (card == cards_.end()) {
      diagnostics_.error("undefined-card-id", named_at, fmt::format("there is no coordinate system {}", id));
      return nullptr;
    }
    if (failed_.contains(id)) return nullptr;
    if (!open_.insert(id).second) {
      diagnostics_.error("degenerate-axes", card->second->id.at,
                         fmt::format("the coordinate system {} is defined by itself", id));
      failed_.insert(id);
      return nullptr;
    }
    const std::optional<Axes> axes = make(*card->second);
    open_.erase(id);
    if (!axes) {
      failed_.insert(id);
      return nullptr;
    }
    return &(found_[id] = *axes);
  }

  std::optional<Vector3d> place(const Grid& g) {
    const Axes* in = system(g.position_system.id, g.position_system.at);
    if (!in) return std::nullopt;
    return in->to_basic(g.x);
  }

 private:
  std::optional<Axes> make(const System& s) {
    Vector3d a, b, c;
    if (s.by_points.empty()) {
      const Axes* in = system(s.reference.id, s.reference.at);
      if (!in) return std::nullopt;
      const Axes reference = *in;
      a = reference.to_basic(s.a), b = reference.to_basic(s.b), c = reference.to_basic(s.c);
    } else {
      Vector3d* const at[] = {&a, &b, &c};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto grid = grids_.find(s.by_points[k].id);
        if (grid == grids_.end()) {
          diagnostics_.error("undefined-card-id", s.by_points[k].at,
                             fmt::format("there is no GRID {}", s.by_points[k].id));
          return std::nullopt;
        }
        const auto p = place(*grid->second);
        if (!p) return std::nullopt;
        *at[k] = *p;
      }
    }
    const Vector3d z = b - a, toward = c - a;
    const Vector3d y = z.cross(toward);
    // Rounding of the written coordinates decides the direction below this.
    constexpr double least_sine = 1e-8;
    if (!(z.norm() > 0) || !(y.norm() > least_sine * z.norm() * toward.norm())) {
      diagnostics_.error("degenerate-axes", s.id.at,
                         z.norm() > 0
                             ? fmt::format("the point C of the coordinate system {} lies on its z axis", s.id.id)
                             : fmt::format("the points A and B of the coordinate system {} coincide", s.id.id));
      return std::nullopt;
    }
    Axes out{s.kind, a, {}};
    out.axes.col(2) = z.normalized();
    out.axes.col(1) = y.normalized();
    out.axes.col(0) = out.axes.col(1).cross(out.axes.col(2));
    return out;
  }

  Diagnostics& diagnostics_;
  std::unordered_map<int, Axes>& found_;
  std::unordered_map<int, const System*> cards_;
  std::unordered_map<int, const Grid*> grids_;
  std::set<int> open_, failed_;
};

}  // namespace

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Vector3d Axes::to_basic(const Vector3d& x) const {
  Vector3d local = x;
  if (kind == System::Kind::cylindrical) {
    local = {x[0] * std::cos(x[1] * degree), x[0] * std::sin(x[1] * degree), x[2]};
  } else if (kind == System::Kind::spherical) {
    const double across = x[0] * std::sin(x[1] * degree);
    local = {across * std::cos(x[2] * degree), across * std::sin(x[2] * degree), x[0] * std::cos(x[1] * degree)};
  }
  return origin + axes * local;
}

Matrix3d Axes::at(const Vector3d& place) const {
  if (kind == System::Kind::rectangular) return axes;
  const Vector3d local = axes.transpose() * (place - origin);
  const double across = std::hypot(local.x(), local.y());
  // On the axis the directions are those of the system itself.
  if (across <= 1e-12 * local.norm() || across == 0) return axes;
  const double c = local.x() / across, s = local.y() / across;
  Matrix3d turned;
  if (kind == System::Kind::cylindrical) {
    turned << c, -s, 0, s, c, 0, 0, 0, 1;
  } else {
    const double r = local.norm(), st = across / r, ct = local.z() / r;
    turned << st * c, ct * c, -s, st * s, ct * s, c, ct, -st, 0;
  }
  return axes * turned;
}

Points::Points(const Deck& deck, Diagnostics& diagnostics) {
  Resolver resolver(deck, diagnostics, systems_);
  const auto add = [&](Point p) {
    const auto [at, is_new] = by_id_.emplace(p.id, points_.size());
    if (!is_new) {
      diagnostics.error("duplicate-card-id", p.at, fmt::format("the point {} is defined twice", p.id))
          .notes.push_back({points_[at->second].at, "the first one"});
      return;
    }
    p.first = freedoms_;
    freedoms_ += p.scalar ? 1 : 6;
    points_.push_back(std::move(p));
  };
  for (const Grid& g : deck.grids) {
    Point p;
    p.id = g.id.id, p.at = g.id.at, p.fixed = g.fixed;
    if (const auto place = resolver.place(g)) p.position = *place;
    if (const Axes* axes = resolver.system(g.system.id, g.system.at)) p.axes = axes->at(p.position);
    add(std::move(p));
  }
  for (const ScalarPoint& s : deck.scalars) {
    Point p;
    p.id = s.id.id, p.at = s.id.at, p.scalar = true;
    add(std::move(p));
  }
}

const Point* Points::find(int id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? nullptr : &points_[found->second];
}

const Axes* Points::system(int id) const {
  const auto found = systems_.find(id);
  return found == systems_.end() ? nullptr : &found->second;
}

std::optional<int> Points::freedom(const Freedom& f) const {
  const Point* p = find(f.point.id);
  if (!p) return std::nullopt;
  if (p->scalar) return f.component <= 1 ? std::optional(p->first) : std::nullopt;
  return f.component >= 1 ? std::optional(p->first + f.component - 1) : std::nullopt;
}

const Point& Points::point_of(int freedom) const {
  const auto after =
      std::upper_bound(points_.begin(), points_.end(), freedom, [](int f, const Point& p) { return f < p.first; });
  return *(after - 1);
}

std::string Points::name(int freedom) const {
  const Point& p = point_of(freedom);
  return p.scalar ? fmt::format("SPOINT {}", p.id) : fmt::format("GRID {} component {}", p.id, freedom - p.first + 1);
}

}  // namespace dynalin::nastran_reader
