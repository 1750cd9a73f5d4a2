// Springs far from their lengths, snap-through, forces that grow, parts without mass, beams, controllers.
#include "static_models.h"

namespace dynalin::oracle {

namespace {

Expr along(int axis, int i, int j) {
  constexpr std::array measures{Measure::DX, Measure::DY, Measure::DZ};
  return measure(measures[static_cast<std::size_t>(axis)], {i, j, j});
}
Expr cube(const Expr& x) { return x * square(x); }

}  // namespace

// A body on eight springs from its corners, all much too long or too short.
StaticModel stretched_body(int k) {
  Draft d("springs", k);
  constexpr std::array factor{0.01, 0.3, 3.0, 8.0, 1.5, 25.0};
  const int body = d.part(10 + 20 * k, {0, 0, 0}, d.box(0.4));
  for (int n = 0; n < 8; ++n) {
    const double x = n & 1 ? 0.5 : -0.5, y = n & 2 ? 0.4 : -0.4, z = n & 4 ? 0.3 : -0.3;
    const Triple off = d.box(0.3);
    d.spring(d.marker(body, {x, y, z}), d.marker(1, {4 * x + off[0], 4 * y + off[1], 4 * z + off[2]}), 800 + 200 * n,
             factor[static_cast<std::size_t>(k) % factor.size()] * 2.2);
  }
  return d.done();
}

// Two bars on springs over a slide: flat, upright, near the load at which it snaps through, and beyond.
StaticModel snapping_frame(int k) {
  Draft d("snap", k);
  constexpr std::array rise{0.3, 0.0, 0.3, 0.3, -0.1, 0.25};
  constexpr std::array load{1.0, 0.2, 2.6, 2.7, 1.0, 40.0};
  const auto n = static_cast<std::size_t>(k) % rise.size();
  const int top = d.part(load[n], {0, 0, rise[n]});
  d.joint(JointType::translational, d.cm(top), d.marker(1, {}));
  for (const double x : {-1.0, 1.0}) d.spring(d.cm(top), d.marker(1, {x, 0, 0}), 1000, 1.0440306508910550);
  if (k == 5) {  // a second storey
    const int roof = d.part(1, {0, 0, 0.6});
    d.joint(JointType::translational, d.cm(roof), d.marker(1, {}));
    for (const double y : {-0.5, 0.5}) d.spring(d.cm(roof), d.marker(top, {0, y, 0}), 2000, 0.61);
  }
  return d.done();
}

// Cubic, exponential and one-sided springs, two wells, a follower.
StaticModel growing_force(int k) {
  Draft d("growing", k);
  const int ground_marker = d.marker(1, {});
  const int mass = d.part(2, {3.0 - k, 0.5 * k, 2.0});
  const int i = d.cm(mass), j = ground_marker;
  const auto each = [&](const auto& law) {
    d.force(i, {law(along(0, i, j)), law(along(1, i, j)), law(along(2, i, j))});
  };
  const int spin = d.marker(1, {});
  d.bushing(d.marker(mass, {}), spin, {0, 0, 0, 3, 3, 3});
  switch (k % 6) {
    case 0:
      each([](const Expr& x) { return -5.0 * cube(x); });
      break;
    case 1:
      each([](const Expr& x) { return -1.0 * call(Function::sinh, {4.0 * x}); });
      break;
    case 2:  // two wells in each direction
      each([](const Expr& x) { return 30.0 * x - 40.0 * cube(x); });
      break;
    case 3:  // slack in a band
      each([](const Expr& x) {
        return -1e4 * (call(Function::dim, {x, constant(0.5)}) - call(Function::dim, {constant(-0.5), x}));
      });
      break;
    case 4: {  // a rope that only pulls, with a stop on its way
      const Expr length = measure(Measure::DM, {i, j});
      d.spring(i, d.marker(1, {2, 0, 4}), 30, 1);
      each([&](const Expr& x) { return -200.0 * call(Function::dim, {length, constant(1)}) * x / length; });
      break;
    }
    default: {  // pushed along its own axis, which turns against a spring
      const int hinged = d.part(1, {0, 0, -3});
      d.joint(JointType::spherical, d.marker(hinged, {0, 0, -0.5}), d.marker(1, {0, 0, -3.5}));
      d.bushing(d.marker(hinged, {0, 0, -0.5}), d.marker(1, {0, 0, -3.5}), {0, 0, 0, 12, 12, 12});
      const int tip = d.marker(hinged, {0.1, 0, 0.5}), floating = d.marker(1, {}), axes = d.marker(hinged, {});
      for (Marker& m : d.mechanism().markers) m.floating = m.floating || m.id == floating;
      GeneralForce follower;
      follower.id = 9000, follower.i = tip, follower.jfloat = floating, follower.rm = axes;
      follower.component[2] = constant(-4);
      d.mechanism().gforces.push_back(follower);
      each([](const Expr& x) { return -100.0 * x; });
    }
  }
  return d.done();
}

// Parts without mass between springs and bushings.
StaticModel massless_between(int k) {
  Draft d("massless", k);
  const int parts = 3 + k;
  const bool hinged = k % 3 != 0;
  const Triple pitch{0.6, 0.1 * (k % 2), 0.05};
  int last = d.marker(1, {});
  for (int n = 1; n <= parts; ++n) {
    const Triple at{n * pitch[0], n * pitch[1], n * pitch[2]};
    const int p = n % 2 == 1 ? d.massless(at) : d.part(2, at);
    const int tail = d.marker(p, {-pitch[0], -pitch[1], -pitch[2]});
    if (hinged) {
      d.joint(JointType::spherical, tail, last);
      d.bushing(tail, last, {0, 0, 0, 30, 30, 30});
    } else {
      d.bushing(tail, last, {2000, 2000, 3000, 60, 60, 60}, {20, 0, 40, 0, 0, 0});
    }
    last = d.marker(p, {});
  }
  d.spring(last, d.marker(1, {0.6 * parts + 1, 0, 1}), 300, 0.3);
  return d.done();
}

// A row of parts on beams, drawn straight, heavy enough to bend; or on fields.
StaticModel bent_beam(int k) {
  Draft d("beam", k);
  constexpr std::array section{4e-4, 2e-5, 1e-5, 2e-4, 1.5e-5};
  const double length = 0.25, area = section[static_cast<std::size_t>(k) % section.size()];
  const int parts = 4 + 2 * k;
  int last = d.marker(1, {});
  for (int n = 1; n <= parts; ++n) {
    const int p = d.part(n == parts ? 3 : 0.3, {length * n, 0, 0}, {}, 0.05);
    if (k == 3)
      d.field(d.marker(p, {}), last, {4e4, 2e4, 2e4, 300, 200, 200}, {length * 1.2, 0.02, 0, 0, 0.05, 0});
    else
      d.beam(d.marker(p, {}), last, length, area);
    last = d.marker(p, {});
  }
  if (k == 2) d.spring(last, d.marker(1, {1, 2, 1}), 300, 0.5);
  return d.done();
}

// Positions that controllers hold: integrators, filters, algebraic loops.
StaticModel controlled(int k) {
  Draft d("control", k);
  const int base = d.marker(1, {});
  const int slider = d.part(5, {0, 0, 1.5});
  const int i = d.cm(slider), j = base;
  d.joint(JointType::translational, i, j);
  const Expr place = measure(Measure::DZ, {i, j, j});
  Mechanism& m = d.mechanism();
  switch (k % 5) {
    case 0:  // levelled by an integrator
      m.diffs.push_back({1, 0.0, constant(0.4) - place});
      d.along_z(i, j, 200.0 * (constant(0.4) - place) + 80.0 * dif(1));
      break;
    case 1:  // a filter with a cubic actuator
      m.diffs.push_back({1, 3.0, place - dif(1)});
      d.along_z(i, j, -100.0 * cube(dif(1)));
      break;
    case 2:  // a gas spring by its pressure
      m.variables.push_back({1, call(Function::raise, {constant(0.5) / (place + constant(0.1)), constant(1.4)})});
      d.along_z(i, j, 100.0 * varval(1));
      break;
    case 3:  // an algebraic loop of two variables
      m.variables.push_back({1, 0.3 * varval(2) + place});
      m.variables.push_back({2, 0.5 * call(Function::tanh, {varval(1)})});
      d.along_z(i, j, constant(20) - 60.0 * varval(1) - 10.0 * varval(2));
      break;
    default:  // two integrators in a row behind a saturation
      m.diffs.push_back({1, 1.0, constant(1) - place - 0.5 * dif(1)});
      m.diffs.push_back({2, 0.0, dif(1) - constant(0.2)});
      d.along_z(i, j, 100.0 * call(Function::tanh, {0.8 * dif(1) + 0.3 * dif(2)}) - 30.0 * (place - constant(1)));
  }
  return d.done();
}

}  // namespace dynalin::oracle
