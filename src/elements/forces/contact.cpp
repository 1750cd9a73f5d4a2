// CONTACT/id, IGEOM=id, …, JGEOM=id, …, IMPACT, STIFFNESS=, EXPONENT=, DAMPING=, DMAX=
// CONTACT/id, IGEOM=id, …, JGEOM=id, …, POISSON, PENALTY=, RESTITUTION_COEFFICIENT=
// CONTACT/id, IGEOM=id, …, JGEOM=id, …, NFUNCTION=USER(…) [, NROUTINE=]
//         [, COULOMB_FRICTION=ON, MU_STATIC=, MU_DYNAMIC=, STICTION_TRANSITION_VELOCITY=,
//         FRICTION_TRANSITION_VELOCITY= | , FFUNCTION=USER(…) [, FROUTINE=]]
//         [, IFLIP_GEOMETRY=id, …] [, JFLIP_GEOMETRY=id, …] [, IFLIP_NORMAL=id, …] [, JFLIP_NORMAL=id, …]
//
// GRAPHICS of two bodies push each other apart where they overlap (families/contact_force.h). With the penetration g
//
//     IMPACT      N = max(0, STIFFNESS g^EXPONENT + STEP(g, 0, 0, DMAX, DAMPING) g′)
//     POISSON     N = max(0, PENALTY g + c g′),      c = 2 ζ √(PENALTY m),     1/m = 1/m_I + 1/m_J
//
// with the ζ that lets two free bodies that meet centrally part with the RESTITUTION_COEFFICIENT of the speed at which
// they met: −ln r = 2 ζ acos ζ / √(1 − ζ²), of acosh where ζ > 1. The masses are those of the bodies, ground has no end
// of it.
//
// NFUNCTION and FFUNCTION call compiled routines in the place of either law (families/contact_routine.h).
//
// The GRAPHICS are all solids (geometry/touch.h) or all curves in a plane (geometry/plane_touch.h); POINTs go with
// both.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "elements/families/contact_sides.h"
#include "elements/families/friction_coefficients.h"
#include "elements/families/markers.h"
#include "expression/program.h"
#include "model/linear_remarks.h"
#include "model/schema.h"
#include "routine/statement_words.h"

namespace dynalin {

namespace {

struct Contact {
  std::vector<std::int64_t> igeom, jgeom, iflip, jflip, iflip_normal, jflip_normal;
  bool impact = false, poisson = false, augmented = false;
  std::optional<double> stiffness, exponent, damping, dmax;
  std::optional<double> penalty, restitution;
  OptionalWord friction;
  std::optional<double> mu_static, mu_dynamic, stiction_speed, friction_speed;
  Expression normal_function, friction_function;

  static constexpr std::array<Argument<Contact>, 22> arguments = {{
      {.name = "IGEOM", .slot = &Contact::igeom, .required = true, .help = "GRAPHICS of the one body"},
      {.name = "JGEOM", .slot = &Contact::jgeom, .required = true, .help = "GRAPHICS of the other body"},
      {.name = "IMPACT",
       .slot = &Contact::impact,
       .help = "a spring and a damper in the penetration",
       .ends = "POISSON PENALTY RESTITUTION_COEFFICIENT NFUNCTION"},
      {.name = "POISSON",
       .slot = &Contact::poisson,
       .help = "a spring, and a damper after a coefficient of restitution",
       .ends = "IMPACT STIFFNESS EXPONENT DAMPING DMAX NFUNCTION"},
      {.name = "STIFFNESS",
       .slot = &Contact::stiffness,
       .unit = "force/length^EXPONENT",
       .minimum = 0,
       .help = "of IMPACT"},
      {.name = "EXPONENT", .slot = &Contact::exponent, .minimum = 1, .help = "of the penetration, of IMPACT"},
      {.name = "DAMPING",
       .slot = &Contact::damping,
       .unit = unit::damping,
       .minimum = 0,
       .help = "of IMPACT, from DMAX"},
      {.name = "DMAX",
       .slot = &Contact::dmax,
       .unit = unit::length,
       .help = "penetration at which all of DAMPING acts"},
      {.name = "PENALTY", .slot = &Contact::penalty, .unit = unit::stiffness, .help = "stiffness of POISSON"},
      {.name = "RESTITUTION_COEFFICIENT",
       .slot = &Contact::restitution,
       .minimum = 1e-3,
       .help = "of POISSON: speed after a blow by that before it",
       .maximum = 1},
      {.name = "COULOMB_FRICTION", .slot = &Contact::friction, .help = "ON, OFF or DYNAMICS_ONLY", .ends = "FFUNCTION"},
      {.name = "MU_STATIC", .slot = &Contact::mu_static, .minimum = 0, .help = "coefficient at the first speed"},
      {.name = "MU_DYNAMIC",
       .slot = &Contact::mu_dynamic,
       .minimum = 0,
       .help = "coefficient from the second speed on"},
      {.name = "STICTION_TRANSITION_VELOCITY",
       .slot = &Contact::stiction_speed,
       .unit = unit::velocity,
       .help = "slip speed at which MU_STATIC is reached"},
      {.name = "FRICTION_TRANSITION_VELOCITY",
       .slot = &Contact::friction_speed,
       .unit = unit::velocity,
       .help = "slip speed from which MU_DYNAMIC acts"},
      {.name = "IFLIP_GEOMETRY", .slot = &Contact::iflip, .help = "of IGEOM: those that are cavities"},
      {.name = "JFLIP_GEOMETRY", .slot = &Contact::jflip, .help = "of JGEOM: those that are cavities"},
      {.name = "IFLIP_NORMAL", .slot = &Contact::iflip_normal, .help = "the same as IFLIP_GEOMETRY"},
      {.name = "JFLIP_NORMAL", .slot = &Contact::jflip_normal, .help = "the same as JFLIP_GEOMETRY"},
      {.name = "AUGMENTED_LAGRANGIAN_FORMULATION", .slot = &Contact::augmented, .help = "read, without effect"},
      {.name = "NFUNCTION",
       .slot = &Contact::normal_function,
       .help = "USER(…): a compiled routine gives the pressure",
       .ends = "IMPACT STIFFNESS EXPONENT DAMPING DMAX POISSON PENALTY RESTITUTION_COEFFICIENT"},
      {.name = "FFUNCTION",
       .slot = &Contact::friction_function,
       .help = "USER(…): a compiled routine gives the friction",
       .ends = "COULOMB_FRICTION MU_STATIC MU_DYNAMIC STICTION_TRANSITION_VELOCITY FRICTION_TRANSITION_VELOCITY"},
  }};
};

// The ratio of damping that leaves r of the speed after a blow.
double damping_ratio(double r) {
  // 2 z arccos z / √(1 − z²), by an angle of the half that does not cancel where z is next to 1:
  // arccos z = 2 arcsin √((1 − z)/2), arcosh z = 2 arsinh √((z − 1)/2).
  const auto lost = [](double z) {
    const double half = std::sqrt(0.5 * std::abs(1 - z)), root = half * std::sqrt(2 * (1 + z));
    if (root == 0) return 2 * z;
    return 4 * z * (z < 1 ? std::asin(half) : std::asinh(half)) / root;
  };
  double low = 0, high = 1e3;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (lost(middle) < -std::log(r) ? low : high) = middle;
  }
  return low;
}

class ContactSet final : public TypedSet<Contact>, public LinearRemarks {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    Contact& c = elements[k];
    sides_.resize(k + 1), forces_.resize(k + 1);
    if (!read_arguments(c, reader)) return;
    sides_[k] = read_sides(reader);
    read_pressure(c, forces_[k], reader);
    read_friction(c, forces_[k], reader);
    if (c.augmented) {
      reader.warning("passed-over", reader.at("AUGMENTED_LAGRANGIAN_FORMULATION"),
                     fmt::format("AUGMENTED_LAGRANGIAN_FORMULATION of {} is passed over: contact is a force here",
                                 reader.label().text()));
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      ContactForce& f = forces_[k];
      if (sides_[k][0].empty() || sides_[k][1].empty()) continue;  // reported
      if (!place_sides(model, labels[k], sides_[k], f, diagnostics)) continue;
      check_pair(model, labels[k], f.i, f.j, {.rotation_of_I = turns(model, k, 0), .rotation_of_J = turns(model, k, 1)},
                 diagnostics);
      if (elements[k].poisson) finish_poisson(model, k, diagnostics);
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<ContactKernel>(forces_, labels, layout);
  }

  void remark_at(const Model& model, const Motion& motion, double length, Diagnostics& remarks) const override {
    using Brink = ContactBrink::Kind;
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      const ContactForce& f = forces_[k];
      for (const ContactBrink& b : brinks(f, motion, model.marker(f.i).place, model.marker(f.j).place, length)) {
        if (b.kind == Brink::end_of_face) {
          remarks.warning("touching-contact", labels[k].at,
                          fmt::format("{} is just where a face ends in an edge: beyond it the surface is bent, and the "
                                      "linear model has the stiffness of one side",
                                      labels[k].full_text()));
          continue;
        }
        const std::string_view where = b.kind == Brink::touching     ? "just touching"
                                       : b.kind == Brink::letting_go ? "just letting go"
                                                                     : "just at the edge of its plane";
        remarks.warning(
            "touching-contact", labels[k].at,
            fmt::format("{} is {}: it pushes on one side of this point and not on the other, and the "
                        "linear model holds for one of them, {}",
                        labels[k].full_text(), where, b.pushes ? "that where it pushes" : "that where it is open"));
      }
    }
  }

 private:
  static void excluded(std::initializer_list<std::string_view> names, std::string_view owner, ElementReader& reader) {
    for (const std::string_view name : names) {
      if (!reader.given(name)) continue;
      reader.error("unexpected-argument", reader.at(name),
                   fmt::format("{} of {} goes with {}", name, reader.label().text(), owner));
      return;
    }
  }
  static bool needed(std::initializer_list<std::string_view> names, std::string_view owner, ElementReader& reader) {
    std::vector<std::string_view> missing;
    for (const std::string_view name : names) {
      if (!reader.given(name)) missing.push_back(name);
    }
    if (missing.empty()) return true;
    reader.error("missing-argument", reader.at(owner.substr(0, owner.find('='))),
                 fmt::format("{} of {} needs {}", owner, reader.label().text(), fmt::join(missing, ", ")));
    return false;
  }
  static bool positive(std::string_view name, double value, ElementReader& reader) {
    if (value > 0) return true;
    reader.error("value-out-of-range", reader.at(name),
                 fmt::format("{} of {} is {}, it must be more than 0", name, reader.label().text(), value));
    return false;
  }

  static void read_pressure(const Contact& c, ContactForce& f, ElementReader& reader) {
    if (reader.given("NFUNCTION")) {
      f.normal_routine = routine_of(c.normal_function, "NFUNCTION", reader);
      excluded({"IMPACT", "POISSON"}, "no NFUNCTION", reader);
      excluded({"STIFFNESS", "EXPONENT", "DAMPING", "DMAX"}, "IMPACT", reader);
      excluded({"PENALTY", "RESTITUTION_COEFFICIENT"}, "POISSON", reader);
      return;
    }
    if (c.impact == c.poisson) {
      if (c.impact) {
        reader.error("duplicate-variant", reader.at("POISSON"),
                     fmt::format("{} is both IMPACT and POISSON", reader.label().text()));
      } else {
        reader.error("missing-variant", reader.statement().at, "CONTACT needs its type",
                     "IMPACT, POISSON or NFUNCTION=USER(…)");
      }
      return;
    }
    if (c.impact) {
      excluded({"PENALTY", "RESTITUTION_COEFFICIENT"}, "POISSON", reader);
      if (!needed({"STIFFNESS", "EXPONENT", "DAMPING", "DMAX"}, "IMPACT", reader)) return;
      if (!positive("DMAX", *c.dmax, reader)) return;
      f.pressure = {*c.stiffness, *c.exponent, *c.damping, *c.dmax};
    } else {
      excluded({"STIFFNESS", "EXPONENT", "DAMPING", "DMAX"}, "IMPACT", reader);
      if (!needed({"PENALTY", "RESTITUTION_COEFFICIENT"}, "POISSON", reader)) return;
      if (!positive("PENALTY", *c.penalty, reader)) return;
      f.pressure = {*c.penalty, 1, 0, 0};
    }
  }

  // Null after an error.
  static std::shared_ptr<const Routine> routine_of(const Expression& function, std::string_view name,
                                                   ElementReader& reader) {
    const auto routines = function.program().routines();
    if (!routines.empty()) return routines.front().routine;
    reader.error("unknown-word", reader.at(name),
                 fmt::format("{} of {} is USER(…), the call of a compiled routine, and no expression", name,
                             reader.label().text()));
    return nullptr;
  }

  static void read_friction(const Contact& c, ContactForce& f, ElementReader& reader) {
    if (reader.given("FFUNCTION")) {
      f.friction_routine = routine_of(c.friction_function, "FFUNCTION", reader);
      excluded({"COULOMB_FRICTION", "MU_STATIC", "MU_DYNAMIC", "STICTION_TRANSITION_VELOCITY",
                "FRICTION_TRANSITION_VELOCITY"},
               "no FFUNCTION", reader);
      return;
    }
    static constexpr std::array<std::string_view, 3> words = {"ON", "OFF", "DYNAMICS_ONLY"};
    const std::optional<std::size_t> word = c.friction.given ? find_keyword(c.friction.word, words) : 1;
    if (c.friction.given && (c.friction.word.empty() || !word)) {
      reader.error("unknown-word", reader.at("COULOMB_FRICTION"),
                   fmt::format("COULOMB_FRICTION of {} is ON, OFF or DYNAMICS_ONLY", reader.label().text()));
      return;
    }
    if (!c.friction.given) {
      excluded({"MU_STATIC", "MU_DYNAMIC", "STICTION_TRANSITION_VELOCITY", "FRICTION_TRANSITION_VELOCITY"},
               "COULOMB_FRICTION=ON", reader);
    }
    if (word == 1) return;
    if (!needed({"MU_STATIC", "MU_DYNAMIC", "STICTION_TRANSITION_VELOCITY", "FRICTION_TRANSITION_VELOCITY"},
                fmt::format("COULOMB_FRICTION={}", words[*word]), reader))
      return;
    if (!positive("STICTION_TRANSITION_VELOCITY", *c.stiction_speed, reader)) return;
    if (!(*c.friction_speed > *c.stiction_speed)) {
      reader.error("value-out-of-range", reader.at("FRICTION_TRANSITION_VELOCITY"),
                   fmt::format("FRICTION_TRANSITION_VELOCITY of {} is {}, it must be more than "
                               "STICTION_TRANSITION_VELOCITY, {}",
                               reader.label().text(), *c.friction_speed, *c.stiction_speed));
      return;
    }
    warn_of_coefficient_order(*c.mu_static, *c.mu_dynamic, reader);
    f.friction = SlipFriction{*c.mu_static, *c.mu_dynamic, *c.stiction_speed, *c.friction_speed};
    f.friction_in_statics = word == 0;
  }

  // Whether a side needs rotations: not a ball alone that slides.
  bool turns(const Model&, std::size_t k, std::size_t side) const {
    const ContactForce& f = forces_[k];
    const auto& shapes = side == 0 ? f.I : f.J;
    return f.friction || f.friction_routine || shapes.size() > 1 ||
           !std::holds_alternative<solid::Ball>(shapes[0].side.shape);
  }

  // Of all that the statement of the body stands for: nodes of an FE_PART have shares of its mass.
  static double mass_of(const Model& model, BodyId id) {
    const Body& one = model.body(id);
    if (one.nature->listed.role != BodyRole::nodal) return one.mass;
    double sum = 0;
    for (const Body& b : model.bodies)
      if (b.label.statement == one.label.statement && b.label.id == one.label.id) sum += b.mass;
    return sum;
  }

  void finish_poisson(const Model& model, std::size_t k, Diagnostics& diagnostics) {
    double inverse = 0;
    for (const MarkerId m : {forces_[k].i, forces_[k].j}) {
      const BodyId body = model.marker(m).place.body;
      if (body == ground_body) continue;
      const double mass = mass_of(model, body);
      if (!(mass > 0)) {
        diagnostics.error("contact-without-mass", labels[k].at,
                          fmt::format("POISSON of {} needs the mass of {}, which has none", labels[k].text(),
                                      model.body(body).label.text()),
                          "IMPACT states its damping itself");
        return;
      }
      inverse += 1 / mass;
    }
    Pressure& p = forces_[k].pressure;
    if (elements[k].restitution && inverse > 0)
      p.damping = 2 * damping_ratio(*elements[k].restitution) * std::sqrt(p.stiffness / inverse);
  }

  std::vector<ContactSides> sides_;
  std::vector<ContactForce> forces_;
};

// Of each GRAPHICS also whether it is turned inside out.
ToldToRoutine told_of_contact(const StatementWords& s) {
  struct Side {
    std::vector<int> shapes, reversed;
  };
  const auto side = [&](const std::string& which) {
    Side out{s.integers(which + "GEOM"), {}};
    std::vector<int> turned = s.integers(which + "FLIP_GEOMETRY");
    const std::vector<int> more = s.integers(which + "FLIP_NORMAL");
    turned.insert(turned.end(), more.begin(), more.end());
    for (const int id : out.shapes) out.reversed.push_back(std::ranges::find(turned, id) != turned.end());
    return out;
  };
  return told_with(std::array<Side, 2>{side("I"), side("J")}, [&](const std::array<Side, 2>& sides) {
    const auto& [I, J] = sides;
    return sAdamsContactFriction{{s.id(), static_cast<int>(I.shapes.size()), static_cast<int>(J.shapes.size()),
                                  I.shapes.data(), J.shapes.data(), I.reversed.data(), J.reversed.data()},
                                 s.constants().count(),
                                 s.constants().data()};
  });
}
constexpr RoutineKind normal_routine = {.routine = "cnfsub",
                                        .values = 3,
                                        .arguments = RoutineArguments::pressure,
                                        .told = told_of_contact,
                                        .argument = "NFUNCTION",
                                        .names_routine = "NROUTINE"};
constexpr RoutineKind friction_routine = {.routine = "cffsub",
                                          .values = 3,
                                          .arguments = RoutineArguments::friction,
                                          .told = told_of_contact,
                                          .argument = "FFUNCTION",
                                          .names_routine = "FROUTINE"};
constexpr std::array<RoutineKind, 2> contact_routines = {normal_routine, friction_routine};

}  // namespace

extern constinit const Kind contact =
    Kind{"CONTACT",
         "",
         "Pressure and friction where shapes of two bodies overlap.",
         Kind::Role::element,
         detail::argument_infos<Contact>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<ContactSet>(kind); },
         Kind::EnergyRows::one}
        .deactivatable()
        .calling(contact_routines)
        .with_example("CONTACT/1, STIFFNESS=2E5");

}  // namespace dynalin
