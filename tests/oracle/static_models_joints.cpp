// Loops with preload, redundant joints, gears, screws and couplers, motions, freedoms that nothing holds.
#include "static_models.h"

namespace dynalin::oracle {

namespace {

struct Point {
  double x = 0, z = 0;
};
Triple in_space(const Point& p) { return {p.x, 0, p.z}; }
Point middle(const Point& a, const Point& b) { return {(a.x + b.x) / 2, (a.z + b.z) / 2}; }

// A bar between two points of the plane y = 0, with a hinge about y at each end.
struct Bar {
  int part, tail, head;
};
Bar bar(Draft& d, double mass, const Point& a, const Point& b) {
  const Point m = middle(a, b);
  const int part = d.part(mass, in_space(m));
  return {part, d.marker(part, {a.x - m.x, 0, a.z - m.z}, z_along_y),
          d.marker(part, {b.x - m.x, 0, b.z - m.z}, z_along_y)};
}

// Four bars between pivots at 0 and (ground, 0), the crank at an angle: two hinges too many for space.
struct Loop {
  Bar crank, coupler, rocker;
  int first_joint;
};
Loop four_bar(Draft& d, double ground_length, double crank, double coupler, double rocker, double angle) {
  const Point o{}, e{ground_length, 0}, a{crank * std::cos(angle), crank * std::sin(angle)};
  const double dx = e.x - a.x, dz = e.z - a.z, r = std::hypot(dx, dz);
  const double along = (coupler * coupler - rocker * rocker + r * r) / (2 * r);
  const double across = std::sqrt(std::max(0.0, coupler * coupler - along * along));
  const Point b{a.x + (along * dx - across * dz) / r, a.z + (along * dz + across * dx) / r};
  Loop l{bar(d, 2, o, a), bar(d, 3, a, b), bar(d, 2, e, b), 0};
  l.first_joint = d.joint(JointType::revolute, l.crank.tail, d.marker(1, in_space(o), z_along_y));
  d.joint(JointType::revolute, l.coupler.tail, l.crank.head);
  d.joint(JointType::revolute, l.rocker.tail, d.marker(1, in_space(e), z_along_y));
  d.joint(JointType::revolute, l.coupler.head, l.rocker.head);
  return l;
}

}  // namespace

StaticModel preloaded_loop(int k) {
  Draft d("loop", k);
  constexpr std::array angle{0.4, 1.2, 2.0, -0.5, 2.8, 0.9};
  const Loop l = four_bar(d, 2, 0.8, 2.1, 1.4, angle[static_cast<std::size_t>(k) % angle.size()]);
  // A spring across the loop far from its length, one from the coupler to ground, one with a preload.
  d.spring(l.coupler.tail, l.rocker.tail, 300 + 400 * k, k % 2 ? 0.1 : 4);
  d.spring(d.cm(l.coupler.part), d.marker(1, {1, 0, 3}), 200, 1, k % 3 ? 0 : 800);
  d.torsion(l.crank.tail, d.marker(1, {}, z_along_y), 20, 1.5);
  return d.done();
}

// A crank that a motion holds, a spring and weights on the rest.
StaticModel driven_loop(int k) {
  Draft d("driven", k);
  constexpr std::array value{0.3, 1.5, -0.7, 2.9};
  const Loop l = four_bar(d, 2.2, 0.6, 2.1, 1.5, 0.8);
  d.drive(l.first_joint, value[static_cast<std::size_t>(k) % value.size()], 'R');
  // A pendulum on the coupler, and a slider on a spring from it.
  const Triple hung = d.at(l.coupler.part);
  const int pendulum = d.part(4, {hung[0] + 0.5, hung[1], hung[2] + 0.2});
  d.joint(JointType::spherical, d.marker(pendulum, {-0.5, 0, -0.2}), d.cm(l.coupler.part));
  const int slider = d.part(1, {0, 1, 0}, z_along_x);
  d.joint(JointType::translational, d.cm(slider), d.marker(1, {0, 1, 0}, z_along_x));
  d.spring(d.cm(slider), d.cm(l.coupler.part), 500, k % 2 ? 0.05 : 5);
  return d.done();
}

// Doors on two or three hinges about a leaning axis, with a spring that closes them.
StaticModel redundant_door(int k) {
  Draft d("door", k);
  const double lean = 0.1 + 0.4 * k;
  const Triple axes{0, lean, 0};
  const double s = std::sin(lean), c = std::cos(lean);
  const int door = d.part(15, {0.5, 0, 0}, axes);
  for (int n = 0; n < 2 + k % 2; ++n) {
    const double z = 0.6 * n - 0.5;
    d.joint(JointType::revolute, d.marker(door, {-0.5, 0, z}), d.marker(1, {0, -s * z, c * z}, axes));
  }
  d.torsion(d.marker(door, {-0.5, 0, 0}), d.marker(1, {}, axes), 3.0 * k, 1.2);
  d.spring(d.marker(door, {0.5, 0, 0}), d.marker(1, {-1, -1, 0.3}), 60, k == 3 ? 5 : 0.2);
  return d.done();
}

// Freedoms that nothing holds and nothing loads, beside others that must be found.
StaticModel indifferent(int k) {
  Draft d("indifferent", k);
  const int pendulum = d.part(1, {0, 3, 0.7});
  d.joint(JointType::spherical, d.marker(pendulum, {0, 0, -0.7}), d.marker(1, {0, 3, 0}));
  if (k == 0 || k == 5) {  // a wheel on its shaft
    const int wheel = d.part(3, {});
    d.joint(JointType::revolute, d.marker(wheel, {}, z_along_x), d.marker(1, {}, z_along_x));
  }
  if (k == 1 || k == 5) {  // a carriage on a level track with a pendulum on it
    const int carriage = d.part(3, {0, -3, 0}, z_along_x);
    d.joint(JointType::translational, d.cm(carriage), d.marker(1, {0, -3, 0}, z_along_x));
    const int hung = d.part(1, {0.6, -3, 0.1});
    d.joint(JointType::spherical, d.marker(hung, {-0.6, 0, -0.1}), d.marker(carriage, {}));
  }
  if (k == 2 || k == 5) {  // a block on a table
    const int block = d.part(2, {0, -6, 0});
    d.joint(JointType::planar, d.cm(block), d.marker(1, {0, -6, 0}));
  }
  if (k == 3 || k == 5) {  // three rings
    int last = d.marker(1, {0, -9, 0}, z_along_x);
    int ring = 0;
    for (int n = 0; n < 3; ++n) {
      ring = d.part(1, {0, -9, 0});
      d.joint(JointType::revolute, d.marker(ring, {}, n % 2 ? z_along_y : z_along_x), last);
      last = d.marker(ring, {}, n % 2 ? z_along_x : z_along_y);
    }
    d.spring(d.marker(ring, {0.3, 0, 0}), d.marker(1, {0, -9, 2}), 10, 0.5);
  }
  if (k == 4) {  // two blocks on a table, joined by a spring far from its length
    const int a = d.part(2, {0, -6, 0}), b = d.part(1, {0.01, -6.5, 0});
    for (const int block : {a, b}) d.joint(JointType::planar, d.cm(block), d.marker(1, {0, -6, 0}));
    d.spring(d.marker(a, {0.1, 0, 0}), d.marker(b, {0, 0.2, 0}), 1000, 5);
  }
  return d.done();
}

// Couplers, racks and screws with weights and springs.
StaticModel geared(int k) {
  Draft d("geared", k);
  std::vector<int> joints;
  for (int n = 0; n < 2; ++n) {  // pendulums about y, drawn up and aside
    const Triple at{1.5 * n + 0.4, 0, 0.5 - 0.8 * n};
    const int p = d.part(1 + 2 * n, at);
    joints.push_back(d.joint(JointType::revolute, d.marker(p, {-0.4, 0, -0.5 + 0.8 * n}, z_along_y),
                             d.marker(1, {1.5 * n, 0, 0}, z_along_y)));
  }
  if (k % 2 == 0) d.mechanism().couplers.push_back({1, joints, {1.0, k == 2 ? -0.5 : 1.5}, "RR"});
  if (k % 2 == 1) {  // a screw carries a nut on a spring
    const int nut = d.part(2, {0, 2, 0});
    const int i = d.cm(nut), j = d.marker(1, {0, 2, 0});
    d.joint(JointType::cylindrical, i, j);
    d.joint(JointType::screw, i, j);
    d.mechanism().joints.back().size = 0.5;
    d.spring(d.marker(nut, {0.2, 0, 0}), d.marker(1, {0.2, 2, 2}), 200, k == 1 ? 0.5 : 3);
  }
  return d.done();
}

// Pendulums on torsion springs far from their angle, and upside down on weak ones.
StaticModel torsion_pendulum(int k) {
  Draft d("torsion", k);
  constexpr std::array stiffness{0.5, 5.0, 20.0, 1.0, 400.0};
  constexpr std::array free{1.8, -1.9, 1.4, 0.0, -1.5};
  const auto n = static_cast<std::size_t>(k) % free.size();
  int last = d.marker(1, {}, z_along_y);
  for (int link = 0; link < 3; ++link) {
    const int p = d.part(1, {0, 0, 0.5 + link}, {}, 0.2);
    const int tail = d.marker(p, {0, 0, -0.5}, z_along_y);
    d.joint(JointType::revolute, tail, last);
    d.torsion(tail, last, stiffness[n] / (1 + link), free[n]);
    last = d.marker(p, {0, 0, 0.5}, z_along_y);
  }
  return d.done();
}

}  // namespace dynalin::oracle
