#include "elements/families/contact_force.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "elements/families/contact_routine.h"
#include "geometry/box_touch.h"
#include "geometry/plane_touch.h"

namespace dynalin {

namespace {

using SeededPair = Dual<12>;
// Of one pair of shapes, neither of which has more corners than a box.
constexpr std::size_t most_touches = std::max({most_plane_touches, box_touches, most_touches_in_space});

template <class T>
RelativeFrame<T> at_instant(const RelativeFrame<TimeTaylor<T>>& f, T TimeTaylor<T>::*part) {
  const auto pick = [&](const Vec3<TimeTaylor<T>>& v) { return Vec3<T>{v.x.*part, v.y.*part, v.z.*part}; };
  return {pick(f.p), pick(f.x), pick(f.y), pick(f.z)};
}

template <class T, class U>
Vec3<T> along(const RelativeFrame<T>& f, const Vec3<U>& v) {
  return f.x * v.x + f.y * v.y + f.z * v.z;
}

// One shape seen from another, out of the first marker of I seen from that of J.
template <class T>
RelativeFrame<T> shape_from_shape(const RelativeFrame<T>& I, const PlacedSide& on_I, const PlacedSide& on_J) {
  RelativeFrame<T> f = I;
  if (!on_I.is_first) {
    const Frame<double>& a = on_I.from_first;
    f = {I.p + along(I, a.origin), along(I, a.axes.x), along(I, a.axes.y), along(I, a.axes.z)};
  }
  if (!on_J.is_first) {
    const Frame<double>& b = on_J.from_first;
    f = {transpose_times(b.axes, f.p - b.origin), transpose_times(b.axes, f.x), transpose_times(b.axes, f.y),
         transpose_times(b.axes, f.z)};
  }
  return f;
}

// How far the balls about both shapes are apart, negative where they overlap. A curve reaches along its z as far as
// the other shape goes.
template <class T>
double apart(const RelativeFrame<T>& f, const solid::Side& I, const solid::Side& J) {
  const solid::Bounds a = solid::bounds(I), b = solid::bounds(J);
  const Vec3<T> between = f.p + along(f, a.centre) - b.centre;
  Vector distance = value_of(between);
  if (solid::is_profile(I)) distance = distance - dot(distance, value_of(f.z)) * value_of(f.z);
  if (solid::is_profile(J)) distance.z = 0;
  return norm(distance) - a.radius - b.radius;
}

// visit(touches of a pair of shapes, in the axes of J's first marker, and the pair): of all that may be near each
// other. far(number of touches, at least how far apart) of all others.
template <class T, class Visit, class Far>
void for_each_pair(const ContactForce& c, const RelativeFrame<T>& I, const Visit& visit, const Far& far) {
  std::array<Touch<T>, most_touches> room;
  std::vector<Touch<T>> more_room;
  for (const PlacedSide& on_I : c.I) {
    for (const PlacedSide& on_J : c.J) {
      const RelativeFrame<T> f = shape_from_shape(I, on_I, on_J);
      const std::size_t count = touch_count(on_I.side, on_J.side);
      if (const double gap = apart(f, on_I.side, on_J.side); gap > 0) {
        far(count, gap);
        continue;
      }
      if (count > room.size()) more_room.resize(count);
      const std::span<Touch<T>> touches(count > room.size() ? more_room.data() : room.data(), count);
      find_touches(on_I.side, on_J.side, f, touches);
      if (!on_J.is_first) {
        const Frame<double>& b = on_J.from_first;
        for (Touch<T>& t : touches) t.normal = b.axes * t.normal, t.point = b.origin + b.axes * t.point;
      }
      visit(touches, on_I, on_J);
    }
  }
}
template <class T, class Visit>
void for_each_touch(const ContactForce& c, const RelativeFrame<T>& I, const Visit& visit) {
  for_each_pair(
      c, I,
      [&](std::span<Touch<T>> touches, const PlacedSide& on_I, const PlacedSide& on_J) {
        for (const Touch<T>& t : touches) {
          if constexpr (std::is_invocable_v<Visit, const Touch<T>&>) {
            visit(t);
          } else {
            visit(t, on_I, on_J);
          }
        }
      },
      [](std::size_t, double) {});
}

bool is_closed(const ContactForce& c, const RelativeFrame<double>& I) {
  bool closed = false;
  for_each_touch(c, I, [&](const Touch<double>& t) { closed = closed || t.closed(); });
  return closed;
}

// The velocity of I's material at a point, seen from J.
template <class T>
Vec3<T> velocity_at(const Vec3<T>& point, const RelativeFrame<T>& I, const RelativeFrame<T>& rate) {
  const Vec3<T> arm = point - I.p;
  return rate.p + along(rate, Vec3<T>{dot(I.x, arm), dot(I.y, arm), dot(I.z, arm)});
}

// As routines are told of it.
template <class T>
ContactPlace<T> place_of(const Touch<T>& t, const RelativeFrame<T>& I, const T& gap_rate, const PlacedSide& on_I,
                         const PlacedSide& on_J) {
  const auto seen_from_I = [&](const Vec3<T>& v) {
    return transpose_times(on_I.from_first.axes, Vec3<T>{dot(I.x, v), dot(I.y, v), dot(I.z, v)});
  };
  const Vec3<T> half = t.normal * T(0.5 * t.gap);
  ContactPlace<T> p;
  p.point_I = seen_from_I(t.point + half - I.p) - transpose_times(on_I.from_first.axes, on_I.from_first.origin);
  p.normal_I = seen_from_I(-t.normal);
  p.point_J = transpose_times(on_J.from_first.axes, t.point - half - on_J.from_first.origin);
  p.normal_J = transpose_times(on_J.from_first.axes, t.normal);
  p.gap = t.gap, p.gap_rate = gap_rate;
  return p;
}

// Angular velocity of I seen from J about a direction: ½ Σ a × a′ over the axes of I.
template <class T>
T spin_about(const Vec3<T>& direction, const RelativeFrame<T>& I, const RelativeFrame<T>& rate) {
  const Vec3<T> twice = cross(I.x, rate.x) + cross(I.y, rate.y) + cross(I.z, rate.z);
  return dot(direction, twice) * 0.5;
}

template <class T>
struct ForceAndTorque {
  Vec3<T> force{T(0.0), T(0.0), T(0.0)}, torque{T(0.0), T(0.0), T(0.0)};  // on I at its origin, axes of J
  Levers levers;
};

template <class T>
ForceAndTorque<T> contact_wrench(const ContactForce& c, const RelativeFrame<TimeTaylor<T>>& along_motion, bool rubs,
                                 const Motion& motion) {
  const RoutineTime at{motion.time, static_cast<double>(motion.mode)};
  const RelativeFrame<T> I = at_instant(along_motion, &TimeTaylor<T>::value);
  const RelativeFrame<T> rate = at_instant(along_motion, &TimeTaylor<T>::rate);
  ForceAndTorque<T> sum;
  for_each_touch(c, I, [&](const Touch<T>& t, const PlacedSide& on_I, const PlacedSide& on_J) {
    if (!t.closed()) return;
    const Vec3<T> v = velocity_at(t.point, I, rate);
    const T apart = dot(t.normal, v);
    const bool calls = c.normal_routine || c.friction_routine;
    const ContactPlace<T> place = calls ? place_of(t, I, apart, on_I, on_J) : ContactPlace<T>();
    const T N =
        c.normal_routine ? called_pressure(*c.normal_routine, place, at) : pressure(c.pressure, T(-t.gap), T(-apart));
    // A routine may also pull.
    if (!c.normal_routine && !(value_of(N) > 0)) return;
    if (!t.defined) {  // undefined_values says what it is
      const T no(std::numeric_limits<double>::quiet_NaN());
      sum.force = sum.torque = {no, no, no};
      return;
    }
    const T share = N * t.weight;
    Vec3<T> F = t.normal * share;
    const Vec3<T> arm = t.point - I.p, slip = v - t.normal * apart;
    if (c.friction_routine) {
      const ContactSlip<T> slips{t.normal, slip, spin_about(t.normal, I, rate), share};
      const ContactFriction<T> friction = called_friction(*c.friction_routine, place, slips, at);
      F += friction.force, sum.torque += friction.torque;
    } else if (rubs) {
      F -= slip * (friction_slope(*c.friction, slip) * share);
    }
    sum.force += F;
    sum.torque += cross(arm, F);
    sum.levers.force += norm(Vector{value_of(F.x), value_of(F.y), value_of(F.z)});
    sum.levers.arm = std::max(sum.levers.arm, norm(Vector{value_of(arm.x), value_of(arm.y), value_of(arm.z)}));
  });
  return sum;
}

// How far both bodies may move without a look at their shapes, so that a solid does not get through another one.
double way_through(const ContactForce& c) {
  double least = std::numeric_limits<double>::infinity();
  for (const PlacedSide& on_I : c.I) {
    for (const PlacedSide& on_J : c.J) {
      const double a = solid::bounds(on_I.side).radius, b = solid::bounds(on_J.side).radius;
      if (!std::isfinite(a) || !std::isfinite(b) || a + b == 0) continue;
      if (solid::is_profile(on_I.side) || solid::is_profile(on_J.side)) continue;
      least = std::min(least, 0.5 * std::max(std::min(a, b), 0.05 * std::max(a, b)));
    }
  }
  return least;
}

RelativeFrame<double> plain(const PairMotion& pair) { return at_instant(pair.relative, &Taylor::value); }

}  // namespace

std::vector<ContactBrink> brinks(const ContactForce& c, const Motion& motion, const MarkerPlace& place_I,
                                 const MarkerPlace& place_J, double length) {
  constexpr double near_brink = 1e-9;
  const PairMotion pair = pair_motion(motion, place_I, place_J);
  const RelativeFrame<double> I = plain(pair), rate = at_instant(pair.relative, &Taylor::rate);
  std::vector<ContactBrink> found;
  using Brink = ContactBrink::Kind;
  const auto add = [&](Brink kind, bool pushes) {
    if (std::ranges::none_of(found, [&](const ContactBrink& b) { return b.kind == kind; }))
      found.push_back({kind, pushes});
  };
  for_each_touch(c, I, [&](const Touch<double>& t) {
    if (t.inside >= 0 && std::abs(t.gap) <= near_brink * length) return add(Brink::touching, t.closed());
    if (t.gap > 0) return;
    if (std::abs(t.inside) <= near_brink * length) add(Brink::end_of_plane, t.closed());
    if (!t.closed()) return;
    if (t.seam <= near_brink * length) add(Brink::end_of_face, true);
    if (c.normal_routine) return;  // its kinks are its own
    // The elastic part and that of the damper cancel.
    const double N = pressure(c.pressure, -t.gap, -dot(t.normal, velocity_at(t.point, I, rate)));
    if (std::abs(N) <= near_brink * pressure(c.pressure, -t.gap, 0.0)) add(Brink::letting_go, N > 0);
  });
  return found;
}

ContactKernel::ContactKernel(const std::vector<ContactForce>& laws, const std::vector<ElementLabel>& labels,
                             Layout& layout)
    : labels_(&labels) {
  for (const ContactForce& law : laws) {
    forces_.push_back({&law, &layout.marker(law.i), &layout.marker(law.j)});
    const double way = way_through(law);
    for (const MarkerPlace* m : {forces_.back().I, forces_.back().J}) {
      double& largest = layout.bodies[static_cast<std::size_t>(m->body.index)].largest_step;
      largest = std::min(largest, way);
    }
  }
}

PairForce ContactKernel::force_of(const Placed& p, const PairMotion& pair, const Motion& motion, Partials wanted) {
  const ContactForce& c = *p.law;
  const bool at_rest = is_equilibrium(motion.mode);
  const bool rubs = c.friction && (c.friction_in_statics || !at_rest);
  RelativeWrench w;
  w.depends_on_rate = true;
  if (wanted == Partials::yes && is_closed(c, plain(pair))) {
    const ForceAndTorque<SeededPair> sum = contact_wrench(c, path::seeded<12>(pair.relative), rubs, motion);
    w.levers = sum.levers;
    for (std::size_t r = 0; r < 6; ++r) {
      const SeededPair& component = r < 3 ? sum.force[r] : sum.torque[r - 3];
      (r < 3 ? w.force[r] : w.torque[r - 3]) = component.value;
      for (std::size_t k = 0; k < 6; ++k) {
        w.on_pose[r][k] = component.partial[k];
        w.on_rate[r][k] = component.partial[6 + k];
      }
    }
  } else if (wanted == Partials::no) {
    const ForceAndTorque<double> sum = contact_wrench(c, pair.relative, rubs, motion);
    w.force = sum.force, w.torque = sum.torque, w.levers = sum.levers;
  }
  return spread(pair, w, wanted);
}

void ContactKernel::equations(const Motion& motion, Equations& eq) const {
  for (const std::size_t k : eq.share(forces_.size())) {
    const Placed& p = forces_[k];
    eq.begin_element((*labels_)[k]);
    const PairMotion pair = pair_motion(motion, *p.I, *p.J);
    apply(pair, force_of(p, pair, motion, eq.wanted_partials()), eq);
  }
}

void ContactKernel::wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const {
  out.pair = pair_motion(motion, *forces_[k].I, *forces_[k].J);
  out.force = force_of(forces_[k], out.pair, motion, wanted);
}

void ContactKernel::switches(const Motion& motion, ExpressionScratch&, SwitchList& list) const {
  for (const Placed& p : forces_) {
    const ContactForce& c = *p.law;
    const PairMotion pair = pair_motion(motion, *p.I, *p.J);
    const RelativeFrame<double> I = plain(pair), rate = at_instant(pair.relative, &Taylor::rate);
    const auto add = [&](const Touch<double>& t) {
      const bool closed = t.closed() && !c.normal_routine;
      list.add(t.gap, t.inside >= 0);
      list.add(closed ? pressure(c.pressure, -t.gap, -dot(t.normal, velocity_at(t.point, I, rate))) : 1.0, closed);
      list.add(std::isfinite(t.inside) ? t.inside : 1.0, t.gap < 0);
    };
    // Of many places, as facets have, each changes the force by little: the first that closes is told.
    for_each_pair(
        c, I,
        [&](std::span<Touch<double>> touches, const PlacedSide&, const PlacedSide&) {
          if (touches.size() <= most_touches) return std::for_each(touches.begin(), touches.end(), add), void();
          const auto nearer = [](const Touch<double>& a, const Touch<double>& b) {
            return std::pair(a.inside < 0, a.gap) < std::pair(b.inside < 0, b.gap);
          };
          add(*std::min_element(touches.begin(), touches.end(), nearer));
        },
        [&](std::size_t count, double gap) {
          Touch<double> t;
          t.gap = gap;
          for (std::size_t k = 0; k < (count <= most_touches ? count : 1); ++k) add(t);
        });
  }
}

namespace {

// Why the routines of a contact have no value or no derivative here, empty if they have all.
struct RoutineLack {
  std::string reason;
  bool in_value = true;
};
RoutineLack lack_at(const detail::ContactArguments<double>& arguments, const Routine& routine, bool is_pressure) {
  const auto finite = [](double x) { return std::isfinite(x); };
  std::array<double, 3> values{};
  for (std::size_t k = 0; k < 3; ++k) values[k] = arguments.called(routine, k);
  if (!std::ranges::all_of(values, finite)) return {routine.reason_of_value(arguments.values())};
  if (is_pressure && (values[1] != 0 || values[2] != 0)) {
    return {
        fmt::format("{} gives {:g} and {:g} behind its first value; a normal force is one number, and the other "
                    "two are 0",
                    routine.name(), values[1], values[2])};
  }
  for (std::size_t k = 0; k < (is_pressure ? 1 : 3); ++k) {
    if (!std::ranges::all_of(routine.partials(arguments.plain(), k).subspan(first_given), finite))
      return {routine.reason_of_partials(arguments.values()), false};
  }
  return {};
}

RoutineLack routine_lack(const ContactForce& c, const PairMotion& pair, const Motion& motion) {
  const RelativeFrame<double> I = plain(pair), rate = at_instant(pair.relative, &Taylor::rate);
  const RoutineTime at{motion.time, static_cast<double>(motion.mode)};
  RoutineLack lack;
  for_each_touch(c, I, [&](const Touch<double>& t, const PlacedSide& on_I, const PlacedSide& on_J) {
    if (!t.closed() || !t.defined || !lack.reason.empty()) return;
    const Vector v = velocity_at(t.point, I, rate);
    const double apart = dot(t.normal, v);
    const ContactPlace<double> place = place_of(t, I, apart, on_I, on_J);
    double N = pressure(c.pressure, -t.gap, -apart);
    if (c.normal_routine) {
      const auto arguments = pressure_arguments(place, at);
      lack = lack_at(arguments, *c.normal_routine, true);
      N = arguments.called(*c.normal_routine, 0);
    }
    if (!c.friction_routine || !lack.reason.empty() || (!c.normal_routine && !(N > 0))) return;
    const ContactSlip<double> slip{t.normal, v - t.normal * apart, spin_about(t.normal, I, rate), N * t.weight};
    const auto arguments = friction_arguments(place, slip, at);
    lack = lack_at(arguments, *c.friction_routine, false);
    if (!lack.reason.empty()) return;
    const Vector F = called_friction(*c.friction_routine, place, slip, at).force;
    if (std::isfinite(F.x)) return;
    lack.reason = fmt::format("{} gives a force of {:g} where nothing slips, and it has no direction there",
                              c.friction_routine->name(), arguments.called(*c.friction_routine, 0));
  });
  return lack;
}

}  // namespace

void ContactKernel::undefined_values(const Motion& motion, UndefinedValues& values) const {
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const Placed& p = forces_[k];
    const ElementLabel& label = (*labels_)[k];
    const PairMotion pair = pair_motion(motion, *p.I, *p.J);
    bool undefined = false;
    for_each_touch(*p.law, plain(pair),
                   [&](const Touch<double>& t) { undefined = undefined || (t.closed() && !t.defined); });
    if (undefined) {
      values.add(UndefinedValue{
          &label, fmt::format("the shapes of {} touch all around or in more places than can be told apart, at "
                              "no place in particular: its force has no one direction or place",
                              label.full_text())});
    }
    if (undefined || !(p.law->normal_routine || p.law->friction_routine)) continue;
    const RoutineLack lack = routine_lack(*p.law, pair, motion);
    if (!lack.reason.empty()) values.add(UndefinedValue{&label, label.full_text() + ": " + lack.reason, lack.in_value});
  }
}

void ContactKernel::exhausted(const Motion& motion, std::vector<std::string>& sentences) const {
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const Placed& p = forces_[k];
    if (!p.law->friction || !is_closed(*p.law, plain(pair_motion(motion, *p.I, *p.J)))) continue;
    sentences.push_back(fmt::format("friction of {} {}", (*labels_)[k].full_text(),
                                    p.law->friction_in_statics
                                        ? "goes by the speed of slip and holds nothing at rest"
                                        : "is left out of statics by DYNAMICS_ONLY, and would hold nothing at rest"));
  }
}

}  // namespace dynalin
