// The curve in which a plane cuts a torus (of Perseus: spiric). With a along the plane's steepest way and b across it,
// level, at each a the height z says how far from the axis both surfaces of the tube are, R ± q with q² = r² − z², and
// so what b is. Seen along b the plane is a straight line, and the torus two discs and what is between them. The curve
// consists of stretches over a, the outer one and the inner one on either side of b = 0. They go on into each other
// where the line enters a disc (b = 0) and where it leaves what is between them (q = 0): in one or two loops, of which
// the one may be in the other.
#pragma once

#include <vector>

#include "geometry/torus_solid.h"

namespace dynalin {

class SpiricCurve {
 public:
  // n · x = height, with the torus to the left as seen from the tip of n.
  SpiricCurve(const TorusSolid&, const Vector& normal, double height);

  struct Place {
    std::size_t stretch = 0;
    double turn = 0;  // from 0 where the stretch begins to π where it ends
  };
  struct Loop {
    std::vector<std::size_t> stretches;  // one after the other
    bool is_hole = false;
  };
  const std::vector<Loop>& loops() const { return loops_; }
  Vector at(const Place&) const;
  // Of a place on the curve: where on it that is, the loop, and which stretch of that.
  Place find(const Vector&) const;
  std::size_t loop_of(std::size_t stretch) const { return stretches_[stretch].loop; }
  std::size_t order_of(std::size_t stretch) const { return stretches_[stretch].order; }
  // Which way it goes on, of any length.
  Vector tangent(const Vector& p) const { return cross(normal_, torus_.gradient(p)); }
  // The way across the curve from a place on a hole, and how far it is to the other side of the torus.
  Vector out_of_hole(const Place&) const;

 private:
  struct Stretch {
    bool outer, upper;  // upper: b > 0
    double low, high;   // of a
    bool low_flat, high_flat;
    std::size_t loop = none, order = 0;
    bool increases() const { return outer != upper; }
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  double a_at(const Place&) const;
  double across_at(double side, double a) const;
  std::size_t next_of(std::size_t) const;
  void link();

  const TorusSolid& torus_;
  Vector normal_, along_, level_;  // along a, along b
  double height_, sine_, cosine_;  // of the normal: away from the axis and along it
  std::vector<Stretch> stretches_;
  std::vector<Loop> loops_;
};

}  // namespace dynalin
