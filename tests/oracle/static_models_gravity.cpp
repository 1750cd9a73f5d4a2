// What hangs, falls and stands: chains, cables, vehicles, plates.
#include "static_models.h"

namespace dynalin::oracle {

namespace {

Triple plus(const Triple& a, const Triple& b, double f = 1) {
  return {a[0] + f * b[0], a[1] + f * b[1], a[2] + f * b[2]};
}

Expr height(int i, int j) { return measure(Measure::DZ, {i, j, j}); }

// IMPACT(gap, rate, free, stiffness, exponent, damping, depth) between I and a plane through J across its z axis.
Expr floor_contact(int i, int j, double free, double stiffness, double exponent) {
  return call(Function::impact, {height(i, j), measure(Measure::VZ, {i, j, j}), constant(free), constant(stiffness),
                                 constant(exponent), constant(0.01 * stiffness), constant(0.01)});
}

}  // namespace

// Links drawn level, upright, in zigzag or at random, one end or both held by ground.
StaticModel hanging_chain(int k) {
  Draft d("chain", k);
  const int links = 4 + 3 * k;
  const double length = 0.4;
  const bool planar = k % 2 == 1, closed = k % 3 == 2;
  Triple end{};
  int last = d.marker(1, {}, z_along_y);
  for (int n = 0; n < links; ++n) {
    double angle = 0;  // above the horizontal
    if (k % 4 == 1) angle = 1.5707963267948966;
    if (k % 4 == 2 || k == 8) angle = n % 2 ? 1.2 : -1.2;
    if (k % 4 == 3) angle = d.uniform(-1.5, 1.5);
    const Triple half{length / 2 * std::cos(angle), 0, length / 2 * std::sin(angle)};
    const int link = d.part(1 + 0.5 * (n % 3), plus(end, half), {}, 0.15);
    const int tail = d.marker(link, plus({}, half, -1), z_along_y), head = d.marker(link, half, z_along_y);
    d.joint(planar ? JointType::revolute : JointType::spherical, tail, last);
    end = plus(end, half, 2), last = head;
  }
  if (closed) d.joint(JointType::spherical, last, d.marker(1, end));
  return d.done();
}

// Point masses on springs in a row between two anchors, drawn straight; springs far too long or short.
StaticModel cable(int k) {
  Draft d("cable", k);
  constexpr std::array free{0.02, 0.6, 1.0, 1.3, 3.0, 0.9, 1.05, 2.0};
  const int masses = 5 + 4 * (k % 4);
  const double span = 10, pitch = span / (masses + 1), stiffness = k < 5 ? 400 : 2e5;
  int last = d.marker(1, {});
  const double slope = k % 3 == 1 ? 0.7 : 0;
  for (int n = 1; n <= masses; ++n) {
    const int mass =
        d.point_mass(0.5 + 0.2 * (n % 4), {n * pitch, k % 2 ? 0.0 : 0.01 * std::sin(n), slope * n * pitch});
    d.spring(d.cm(mass), last, stiffness, free[static_cast<std::size_t>(k) % free.size()] * pitch);
    last = d.cm(mass);
  }
  d.spring(d.marker(1, {span, 0, slope * span}), last, stiffness,
           free[static_cast<std::size_t>(k) % free.size()] * pitch);
  return d.done();
}

// A body on four wheels, each held by a bushing and a spring, dropped from a height or drawn deep in the ground.
StaticModel vehicle(int k) {
  Draft d("vehicle", k);
  constexpr std::array drop{0.0, 0.5, 5.0, 60.0, -0.2, 0.1, 2.0, 20.0};
  const double h = drop[static_cast<std::size_t>(k) % drop.size()];
  const bool rolling = k % 2 == 1;
  const Triple roll = k < 4 ? Triple{} : Triple{0.05, 0.1 * k - 0.4, -0.05};
  const int chassis = d.part(1200, {0, 0, 0.7 + h}, roll, 1.0);
  const int road = d.marker(1, {});
  for (const double x : {-1.3, 1.3}) {
    for (const double y : {-0.8, 0.8}) {
      const int carrier = d.part(35, {x, y, 0.3 + h}, {}, 0.1);
      const int hub = d.marker(chassis, {x, y, -0.4});
      d.bushing(d.cm(carrier), hub, {3e5, 3e5, 4e4, 2e4, 2e4, 2e4}, {0, 0, 1000, 0, 0, 0});
      int wheel = carrier;
      if (rolling) {
        wheel = d.part(25, {x, y, 0.3 + h}, {}, 0.25);
        d.joint(JointType::revolute, d.marker(wheel, {}, z_along_y), d.marker(carrier, {}, z_along_y));
      }
      d.along_z(d.cm(wheel), road, floor_contact(d.cm(wheel), road, 0.3, 2e5, k % 3 == 0 ? 1.0 : 1.5));
    }
  }
  if (k % 3 == 2) {
    // An engine on four mounts.
    const int engine = d.part(180, {0.9, 0, 0.9 + h}, {}, 0.3);
    for (const double x : {-0.2, 0.2}) {
      for (const double y : {-0.25, 0.25})
        d.bushing(d.marker(engine, {x, y, -0.2}), d.marker(chassis, {0.9 + x, y, 0}), {5e4, 5e4, 9e4, 50, 50, 50});
    }
  }
  return d.done();
}

// A plate on contacts at its corners, tilted, far above the ground or deep in it, free to slide.
StaticModel dropped_plate(int k) {
  Draft d("plate", k);
  constexpr std::array height_at{0.4, 3.0, 1000.0, -0.05, -3.0, 30.0};
  constexpr std::array exponent{1.0, 1.5, 2.2};
  const int plate = d.part(40, {0, 0, height_at[static_cast<std::size_t>(k) % height_at.size()]},
                           {0.1 * k, 0.06 * k, 0.05 - 0.1 * k});
  const int ground_marker = d.marker(1, {});
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.4, 0.4}) {
      const int corner = d.marker(plate, {x, y, 0});
      d.along_z(corner, ground_marker,
                floor_contact(corner, ground_marker, 0.05, k % 2 ? 1e7 : 1e5,
                              exponent[static_cast<std::size_t>(k) % exponent.size()]));
    }
  }
  return d.done();
}

// A slider between stops, drawn beyond one of them, or between them under its weight.
StaticModel slider_between_stops(int k) {
  Draft d("stops", k);
  constexpr std::array start{-4.0, 0.3, 7.0, 0.999, 60.0};
  constexpr std::array lean{0.0, 0.4, 1.2, 1.5707963267948966, 0.9};
  const auto n = static_cast<std::size_t>(k) % start.size();
  const Triple axes{1.5707963267948966, lean[n], 0};
  const double s = std::sin(lean[n]), c = std::cos(lean[n]);
  const int base = d.marker(1, {}, axes);
  const int slider = d.part(3, {start[n] * s, 0, start[n] * c}, axes);
  d.joint(JointType::translational, d.cm(slider), base);
  d.along_z(d.cm(slider), base,
            call(Function::bistop,
                 {height(d.cm(slider), base), measure(Measure::VZ, {d.cm(slider), base, base}), constant(0),
                  constant(1), constant(k % 2 ? 1e6 : 1e8), constant(1.5 + 0.3 * k), constant(100), constant(1e-3)}));
  // A second part hangs on the first.
  const int weight = d.part(1, d.at(slider));
  d.joint(JointType::spherical, d.marker(weight, {0, 0, 0}), d.cm(slider));
  d.spring(d.marker(weight, {0, 0, 0.4}), d.marker(1, {0, 5, -3}), 20, 1);
  return d.done();
}

// Parts that nothing holds against their weight or a constant load.
StaticModel held_by_nothing(int k) {
  Draft d("unheld", k);
  switch (k) {
    case 0: {
      d.part(2, {1, 2, 3});
      return d.refused({"nothing holds PART/2", "(0, 0, -19.62)"});
    }
    case 1: {
      const int a = d.part(2, {}), b = d.part(3, {1, 0, 0});
      d.spring(d.cm(a), d.cm(b), 100, 0.8);
      return d.refused({"nothing holds PART/2, PART/3", "(0, 0, -49.05)"});
    }
    case 2: {
      const int slide = d.part(2, {}, {0, 0.5, 0});
      d.joint(JointType::translational, d.cm(slide), d.marker(1, {}, {0, 0.5, 0}));
      return d.refused({"nothing holds PART/2"});
    }
    case 3: {  // a shaft under a torque
      const int shaft = d.part(2, {});
      d.joint(JointType::revolute, d.cm(shaft), d.marker(1, {}));
      d.torque(d.cm(shaft), d.marker(1, {}), constant(5));
      return d.refused({"nothing holds PART/2", "moment"});
    }
    case 4: {  // a driven wheel on a body on springs
      const int body = d.part(20, {}), wheel = d.part(2, {0.5, 0, 0});
      d.bushing(d.cm(body), d.marker(1, {}), {1e4, 1e4, 1e4, 500, 500, 500});
      const int i = d.marker(wheel, {}, z_along_y), j = d.marker(body, {0.5, 0, 0}, z_along_y);
      d.joint(JointType::revolute, i, j);
      d.torque(i, j, constant(0.7));
      return d.refused({"nothing holds PART/3", "moment"});
    }
    case 5: {  // a screw under the weight of its nut
      const int nut = d.part(2, {});
      const int i = d.cm(nut), j = d.marker(1, {});
      d.joint(JointType::cylindrical, i, j);
      const int screw = d.joint(JointType::screw, i, j);
      d.mechanism().joints.back().size = 0.02;
      (void)screw;
      return d.refused({"nothing holds PART/2"});
    }
    case 6: {  // a pushed block on a table, beside a pendulum
      const int block = d.part(4, {}), pendulum = d.part(1, {3, 0, 0});
      d.joint(JointType::planar, d.cm(block), d.marker(1, {}));
      d.joint(JointType::spherical, d.marker(pendulum, {-0.5, 0, 0}), d.marker(1, {2.5, 0, 0}));
      d.force(d.cm(block), {constant(2), constant(-1), std::nullopt});
      return d.refused({"nothing holds PART/2", "(2, -1, 0)"});
    }
    default: {  // masses that hold each other
      int last = 0;
      for (int n = 0; n < 6; ++n) {
        const int mass = d.point_mass(1, {0.7 * n, 0.1 * n * n, 0});
        if (last != 0) d.spring(d.cm(mass), d.cm(last), 50, 0.5);
        last = mass;
      }
      return d.refused({"nothing holds POINT_MASS/2", "(0, 0, -58.86)"});
    }
  }
}

}  // namespace dynalin::oracle
