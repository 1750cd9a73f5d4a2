// JOURNAL/id, I=, J=, RADIUS=, LENGTH=, CLEARANCE=, VISCOSITY= [, SPEED=]
//
// A short plain journal bearing: shaft marker I in the bore of J, whose axis is z of J. The film is as thin as
// h = c − x cos θ − y sin θ at the angle θ from x of J, where (x, y) is the origin of I and c the clearance. The
// pressure of a film of length L (short-bearing form of the Reynolds equation),
//
//     p(θ, z) = 6 μ/h³ (L²/4 − z²) (a cos θ + b sin θ),     a = x′ + ω y/2,   b = y′ − ω x/2
//
// acts where it is positive, on the half of the circumference about the direction (a, b); the other half is cavitated.
// ω is the spin of I relative to J about z of J, and SPEED. With V = |(a, b)|, p = (x a + y b)/(c V),
// q = (y a − x b)/(c V), s² = 1 − p² − q² and β = π/2 + atan(p/s) the force on I along and across that direction is
//
//     F = −μ R L³/c³ (I₁ (a, b) + I₂ (−b, a))
//     I₁ = ∫ cos²ψ/(1 − p cos ψ − q sin ψ)³ dψ = 3 p/s⁴ + β (s² + 3 p²)/s⁵                    −π/2 ≤ ψ ≤ π/2
//     I₂ = ∫ cos ψ sin ψ/(1 − p cos ψ − q sin ψ)³ dψ = 2 q/s⁴ + p² q/(s⁴ (1 − q²)) + 3 β p q/s⁵
//
// second derivatives of ∫ dψ/(1 − p cos ψ − q sin ψ) = 2 β/s. The film shears: with the whole circumference wet,
//
//     T_z = −2π μ ω R³ L/(c s) − (x F_y − y F_x)/2       on I
//
// and the opposite of both on J's body at the origin of I.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "elements/families/linear_wrench.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

namespace {

struct Journal {
  MarkerId i, j;
  double radius = 0, length = 0, clearance = 0;  // [length]
  double viscosity = 0;                          // [force·time/length²]
  double speed = 0;                              // [rad/time]

  static constexpr std::array<Argument<Journal>, 7> arguments = {{
      {.name = "I", .slot = &Journal::i, .required = true, .help = "marker at the middle of the shaft in the bearing"},
      {.name = "J",
       .slot = &Journal::j,
       .required = true,
       .help = "marker at the middle of the bore, z along its axis"},
      {.name = "RADIUS",
       .slot = &Journal::radius,
       .required = true,
       .unit = unit::length,
       .help = "radius of the shaft"},
      {.name = "LENGTH",
       .slot = &Journal::length,
       .required = true,
       .unit = unit::length,
       .help = "length of the bearing along its axis"},
      {.name = "CLEARANCE",
       .slot = &Journal::clearance,
       .required = true,
       .unit = unit::length,
       .help = "radius of the bore less that of the shaft"},
      {.name = "VISCOSITY",
       .slot = &Journal::viscosity,
       .required = true,
       .unit = "force·time/length^2",
       .help = "dynamic viscosity of the film"},
      {.name = "SPEED",
       .slot = &Journal::speed,
       .unit = unit::angular_velocity,
       .help = "spin about z of J that the film has besides that of I"},
  }};
};

// Load (F_x, F_y, T_z) on I in the axes of J, of x, y, x′, y′ and the relative spin. A film in which nothing moves
// exerts none; but in the middle its slope depends on the way in which it will, and there is none.
using Film = Dual<5>;
std::array<Film, 3> film_load(const Journal& bearing, const std::array<Film, 5>& at) {
  const auto& [x, y, x_rate, y_rate, spin] = at;
  const double c = bearing.clearance, R = bearing.radius, L = bearing.length, mu = bearing.viscosity;
  const Film omega = spin + bearing.speed;
  const Film a = x_rate + 0.5 * omega * y, b = y_rate - 0.5 * omega * x;
  const Film s = sqrt(1.0 - (x * x + y * y) / (c * c));
  Film along(std::numbers::pi / 2), across(0.0);
  if (const Film speed2 = a * a + b * b; speed2.value > 0) {
    const Film speed = sqrt(speed2) * c;
    const Film p = (x * a + y * b) / speed, q = (y * a - x * b) / speed;
    const Film beta = atan2(s, -p), s4 = s * s * s * s;
    along = 3.0 * p / s4 + beta * (s * s + 3.0 * p * p) / (s4 * s);
    across = 2.0 * q / s4 + p * p * q / (s4 * (1.0 - q * q)) + 3.0 * beta * p * q / (s4 * s);
  } else if (x.value != 0 || y.value != 0) {
    along.partial.fill(std::numeric_limits<double>::quiet_NaN());
  }
  const double size = mu * R * L * (L / c) * (L / c) / c;
  const Film F_x = -size * (along * a - across * b), F_y = -size * (along * b + across * a);
  const double drag = 2 * std::numbers::pi * mu * R * R * L * (R / c);
  return {F_x, F_y, -drag * omega / s - 0.5 * (x * F_y - y * F_x)};
}

class JournalKernel final : public Kernel, public WrenchSource {
 public:
  JournalKernel(const std::vector<Journal>& bearings, const std::vector<ElementLabel>& labels, Layout& layout)
      : labels_(&labels) {
    for (const Journal& b : bearings) placed_.push_back({&b, &layout.marker(b.i), &layout.marker(b.j)});
  }

  void equations(const Motion& motion, Equations& eq) const override {
    for (const std::size_t k : eq.share(placed_.size())) {
      eq.begin_element((*labels_)[k]);
      const PairMotion pair = pair_motion(motion, *placed_[k].I, *placed_[k].J);
      apply(pair, force_of(*placed_[k].bearing, pair, eq.wanted_partials()), eq);
    }
  }
  std::size_t shares() const override { return shares_of(placed_.size()); }

  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return placed_[k].bearing->i; }
  MarkerId marker_J(std::size_t k) const override { return placed_[k].bearing->j; }
  void wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const override {
    out.pair = pair_motion(motion, *placed_[k].I, *placed_[k].J);
    out.force = force_of(*placed_[k].bearing, out.pair, wanted);
  }

  void undefined_values(const Motion& motion, UndefinedValues& undefined) const override {
    for (std::size_t k = 0; k < placed_.size(); ++k) {
      const Journal& bearing = *placed_[k].bearing;
      const RelativeDisplacement d = displacement_of(pair_motion(motion, *placed_[k].I, *placed_[k].J));
      const double x = d.y[0], y = d.y[1], omega = d.rate[5] + bearing.speed, away = std::hypot(x, y);
      const std::string name = (*labels_)[k].full_text();
      if (!(away < bearing.clearance)) {
        undefined.add(
            UndefinedValue{&(*labels_)[k],
                           fmt::format("the shaft of {} is {:.6g} from the axis of its bearing, whose clearance is "
                                       "{:.6g}: there is no film left",
                                       name, away, bearing.clearance),
                           true});
      } else if (away > 0 && d.rate[0] + omega * y / 2 == 0 && d.rate[1] - omega * x / 2 == 0) {
        undefined.add(
            UndefinedValue{&(*labels_)[k],
                           fmt::format("nothing moves in the film of {}, which could resist in any direction with "
                                       "another force",
                                       name),
                           false});
      }
    }
  }

 private:
  struct Placed {
    const Journal* bearing;    // of the model
    const MarkerPlace *I, *J;  // of the layout
  };
  static RelativeDisplacement displacement_of(const PairMotion& pair) {
    return relative_displacement(pair, CountedAngles{});
  }
  static PairForce force_of(const Journal& bearing, const PairMotion& pair, Partials wanted) {
    const RelativeDisplacement d = displacement_of(pair);
    const std::array<Film, 3> load = film_load(
        bearing, {Film(d.y[0], 0), Film(d.y[1], 1), Film(d.rate[0], 2), Film(d.rate[1], 3), Film(d.rate[5], 4)});
    RelativeWrench w;
    w.depends_on_rate = true;
    w.force = {load[0].value, load[1].value, 0}, w.torque = {0, 0, load[2].value};
    static constexpr std::array<std::size_t, 3> rows = {0, 1, 5}, rates = {0, 1, 5};
    for (std::size_t n = 0; n < 3 && wanted == Partials::yes; ++n) {
      const auto& slope = load[n].partial;
      for (std::size_t k = 0; k < 6; ++k) {
        for (std::size_t c = 0; c < 2; ++c) w.on_pose[rows[n]][k] += slope[c] * d.on_pose[c][k];
        for (std::size_t c = 0; c < 3; ++c) {
          w.on_pose[rows[n]][k] += slope[2 + c] * d.rate_on_pose[rates[c]][k];
          w.on_rate[rows[n]][k] += slope[2 + c] * d.rate_on_rate[rates[c]][k];
        }
      }
    }
    return spread(pair, w, wanted);
  }

  std::vector<Placed> placed_;
  const std::vector<ElementLabel>* labels_;
};

class JournalSet final : public TypedSet<Journal> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    const Journal& b = elements[k];
    if (!read_arguments(elements[k], reader)) return;
    const auto positive = [&](double value, std::string_view name) {
      if (value > 0) return;
      reader.error("value-out-of-range", reader.at(name),
                   fmt::format("{} of {} must be positive", name, reader.label().text()));
    };
    positive(b.radius, "RADIUS"), positive(b.length, "LENGTH");
    positive(b.clearance, "CLEARANCE"), positive(b.viscosity, "VISCOSITY");
  }
  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k)
      check_pair(model, labels[k], elements[k].i, elements[k].j, {.rotation_of_I = true, .rotation_of_J = true},
                 diagnostics);
  }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<JournalKernel>(elements, labels, layout);
  }
};

}  // namespace

extern constinit const Kind journal =
    Kind{"JOURNAL",
         "",
         "A short journal bearing with an oil film.",
         Kind::Role::element,
         detail::argument_infos<Journal>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<JournalSet>(kind); },
         Kind::EnergyRows::one}
        .deactivatable()
        .with_example("JOURNAL/1, VISCOSITY=0.02");

}  // namespace dynalin
