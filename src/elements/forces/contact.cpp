// CONTACT/id, IGEOM=id, …, JGEOM=id, …, IMPACT, STIFFNESS=, EXPONENT=, DAMPING=, DMAX=
// CONTACT/id, IGEOM=id, …, JGEOM=id, …, POISSON, PENALTY=, RESTITUTION_COEFFICIENT=
//         [, COULOMB_FRICTION=ON, MU_STATIC=, MU_DYNAMIC=, STICTION_TRANSITION_VELOCITY=,
//         FRICTION_TRANSITION_VELOCITY=]
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
// The GRAPHICS are all solids (geometry/touch.h) or all curves in a plane (geometry/plane_touch.h); POINTs go with
// both.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "elements/families/contact_force.h"
#include "elements/families/markers.h"
#include "geometry/contact_shape.h"
#include "model/linear_remarks.h"
#include "model/schema.h"

namespace dynalin {

namespace {

struct Contact {
  std::vector<std::int64_t> igeom, jgeom, iflip, jflip, iflip_normal, jflip_normal;
  bool impact = false, poisson = false, augmented = false;
  std::optional<double> stiffness, exponent, damping, dmax;
  std::optional<double> penalty, restitution;
  OptionalWord friction;
  std::optional<double> mu_static, mu_dynamic, stiction_speed, friction_speed;
  UserSubroutine normal_function{"CNFSUB"}, friction_function{"CFFSUB"};

  static constexpr std::array<Argument<Contact>, 22> arguments = {{
      {.name = "IGEOM", .slot = &Contact::igeom, .required = true, .help = "GRAPHICS of the one body"},
      {.name = "JGEOM", .slot = &Contact::jgeom, .required = true, .help = "GRAPHICS of the other body"},
      {.name = "IMPACT", .slot = &Contact::impact, .help = "a spring and a damper in the penetration"},
      {.name = "POISSON",
       .slot = &Contact::poisson,
       .help = "a spring, and a damper after a coefficient of restitution"},
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
      {.name = "COULOMB_FRICTION", .slot = &Contact::friction, .help = "ON, OFF or DYNAMICS_ONLY"},
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
      {.name = "NFUNCTION", .slot = &Contact::normal_function, .help = "USER(…): not available"},
      {.name = "FFUNCTION", .slot = &Contact::friction_function, .help = "USER(…): not available"},
  }};
};

// A GRAPHICS of one side, and where the CONTACT names it.
struct Listed {
  std::int64_t id;
  ElementHandle graphics;
  Span at;
  bool reversed = false;
};

// The ratio of damping that leaves r of the speed after a blow.
double damping_ratio(double r) {
  const auto lost = [](double z) {
    if (std::abs(z - 1) < 1e-8) return 2.0;
    return z < 1 ? 2 * z * std::acos(z) / std::sqrt(1 - z * z) : 2 * z * std::acosh(z) / std::sqrt(z * z - 1);
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
    sides_[k] = {listed("IGEOM", {"IFLIP_GEOMETRY", "IFLIP_NORMAL"}, reader),
                 listed("JGEOM", {"JFLIP_GEOMETRY", "JFLIP_NORMAL"}, reader)};
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
      const std::size_t errors = diagnostics.error_count();
      const bool placed = place(model, k, 0, f.I, f.i, diagnostics) && place(model, k, 1, f.J, f.j, diagnostics);
      if (!placed || diagnostics.error_count() > errors) continue;
      if (!check_pairs(model, k, diagnostics) || !check_planes(model, k, diagnostics)) continue;
      check_pair(model, labels[k], f.i, f.j, {true, turns(model, k, 0), turns(model, k, 1)}, diagnostics);
      if (elements[k].poisson) finish_poisson(model, k, diagnostics);
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<ContactKernel>(forces_, labels, layout);
  }

  void remark_at(const Model& model, const Motion& motion, double length, Diagnostics& remarks) const override {
    constexpr double touching = 1e-9;
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      const ContactForce& f = forces_[k];
      const double gap = least_gap(f, motion, model.marker(f.i).place, model.marker(f.j).place);
      if (!(std::abs(gap) <= touching * length)) continue;
      remarks.warning("touching-contact", labels[k].at,
                      fmt::format("{} is just touching: it pushes on one side of this point and not on the other, and "
                                  "the linear model holds for one of them, {}",
                                  labels[k].full_text(), gap < 0 ? "that where it pushes" : "that where it is open"));
    }
  }

 private:
  using Names = std::array<std::string_view, 2>;

  // All ids of an argument, each with its place.
  static std::vector<Listed> ids_of(std::string_view name, ElementReader& reader) {
    std::vector<Listed> list;
    if (!reader.given(name)) return list;
    const Span at = reader.at(name);
    for (const WrittenArgument& w : reader.statement().arguments) {
      if (w.name.offset != at.offset || w.name.source != at.source) continue;
      Diagnostics known;  // what is wrong with the list itself was reported when it was read
      const auto ids = read_integers(w, *w.name.source, known);
      if (!ids) continue;
      for (const WrittenInteger& id : *ids) {
        const auto graphics = reader.element("GRAPHICS", id);
        if (graphics) list.push_back({id.value, *graphics, id.at});
      }
    }
    return list;
  }

  static std::vector<Listed> listed(std::string_view name, const Names& flips, ElementReader& reader) {
    std::vector<Listed> list = ids_of(name, reader);
    for (std::size_t k = 0; k < list.size(); ++k) {
      for (std::size_t n = 0; n < k; ++n) {
        if (list[n].id != list[k].id) continue;
        reader.error("duplicate-argument", list[k].at,
                     fmt::format("{} of {} lists GRAPHICS/{} twice", name, reader.label().text(), list[k].id));
        return {};
      }
    }
    for (const std::string_view flip : flips) {
      for (const Listed& turned : ids_of(flip, reader)) {
        const auto it = std::find_if(list.begin(), list.end(), [&](const Listed& l) { return l.id == turned.id; });
        if (it == list.end()) {
          reader.error("unexpected-value", turned.at,
                       fmt::format("{} of {} lists GRAPHICS/{}, which {} does not", flip, reader.label().text(),
                                   turned.id, name));
          return {};
        }
        if (it->reversed) {
          reader.error("excluded-arguments", turned.at,
                       fmt::format("{} turns GRAPHICS/{} inside out twice", reader.label().text(), turned.id),
                       fmt::format("{} and {} do the same: name it in one of them", flips[0], flips[1]));
          return {};
        }
        it->reversed = true;
      }
    }
    return list;
  }

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
    if (c.impact == c.poisson) {
      if (reader.given("NFUNCTION")) return;
      if (c.impact) {
        reader.error("duplicate-variant", reader.at("POISSON"),
                     fmt::format("{} is both IMPACT and POISSON", reader.label().text()));
      } else {
        reader.error("missing-variant", reader.statement().at, "CONTACT needs its type", "IMPACT or POISSON");
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

  static void read_friction(const Contact& c, ContactForce& f, ElementReader& reader) {
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
                "COULOMB_FRICTION=ON", reader))
      return;
    if (!positive("STICTION_TRANSITION_VELOCITY", *c.stiction_speed, reader)) return;
    if (!(*c.friction_speed > *c.stiction_speed)) {
      reader.error("value-out-of-range", reader.at("FRICTION_TRANSITION_VELOCITY"),
                   fmt::format("FRICTION_TRANSITION_VELOCITY of {} is {}, it must be more than "
                               "STICTION_TRANSITION_VELOCITY, {}",
                               reader.label().text(), *c.friction_speed, *c.stiction_speed));
      return;
    }
    f.friction = SlipFriction{*c.mu_static, *c.mu_dynamic, *c.stiction_speed, *c.friction_speed};
    f.friction_in_statics = word == 0;
  }

  // All shapes of one side in the axes of the marker of the first one; false after an error, here or where they stand.
  bool place(const Model& model, std::size_t k, std::size_t side, std::vector<PlacedSide>& out, MarkerId& first,
             Diagnostics& diagnostics) const {
    for (const Listed& l : sides_[k][side]) {
      const ElementSet& set = model.set(l.graphics);
      if (!set.sound[static_cast<std::size_t>(l.graphics.index)]) return false;
      const auto* source = dynamic_cast<const ContactShapeSource*>(&set);
      std::string what;
      const auto shape =
          source ? source->contact_shape(static_cast<std::size_t>(l.graphics.index), model, what) : std::nullopt;
      if (!shape) {
        if (what.empty()) return false;
        diagnostics.error(
            "contact-shape", l.at,
            fmt::format("{} names {}, {}, which nothing can touch", labels[k].text(), model.label(l.graphics).text(),
                        what),
            "whole ELLIPSOIDs, CYLINDERs, FRUSTUMs and TORUSes, BOX, PLANE and POINT can be touched, or in a "
            "plane CURVE, CIRCLE, ARC, OUTLINE and POINT");
        return false;
      }
      const Marker& marker = model.marker(shape->marker);
      if (marker.floating) return false;  // reported with the GRAPHICS
      const MarkerPlace& place = marker.place;
      if (out.empty()) {
        first = shape->marker;
        out.push_back({{shape->shape, l.reversed}, {{}, Matrix3::identity()}, true});
        continue;
      }
      const MarkerPlace& at = model.marker(first).place;
      if (place.body != at.body || place.shapes || at.shapes) {
        const bool flexible = place.body == at.body;
        diagnostics.error(flexible ? "contact-shape" : "foreign-marker", l.at,
                          flexible ? fmt::format("{} of {} stands on a body that changes its shape, beside others",
                                                 model.label(l.graphics).text(), labels[k].text())
                                   : fmt::format("{} is on {}, the first shape of this side of {} on {}",
                                                 model.label(l.graphics).text(), model.body(place.body).label.text(),
                                                 labels[k].text(), model.body(at.body).label.text()),
                          flexible ? "a CONTACT for each of them" : "a CONTACT for each pair of bodies");
        return false;
      }
      const Frame<double> from_first{transpose_times(at.R_BM, place.p_BM - at.p_BM),
                                     transpose_times(at.R_BM, place.R_BM)};
      out.push_back({{shape->shape, l.reversed}, from_first, shape->marker == first});
    }
    return true;
  }

  bool check_pairs(const Model& model, std::size_t k, Diagnostics& diagnostics) const {
    const ContactForce& f = forces_[k];
    for (std::size_t a = 0; a < f.I.size(); ++a) {
      for (std::size_t b = 0; b < f.J.size(); ++b) {
        if (touch_count(f.I[a].side, f.J[b].side) > 0) continue;
        const Listed &I = sides_[k][0][a], &J = sides_[k][1][b];
        if (solid::is_profile(f.I[a].side) != solid::is_profile(f.J[b].side)) {
          const bool curve_is_I = solid::is_profile(f.I[a].side);
          diagnostics.error("contact-shape", J.at,
                            fmt::format("{} lets {}, a curve, touch {}, which is no curve", labels[k].text(),
                                        model.label((curve_is_I ? I : J).graphics).text(),
                                        model.label((curve_is_I ? J : I).graphics).text()),
                            "curves touch curves and POINTs, solids touch solids and POINTs");
          return false;
        }
        diagnostics.error(
            "contact-pair-not-built", J.at,
            fmt::format("contact of {} of {} with {} of {} is not available yet", model.label(J.graphics).text(),
                        labels[k].text(), model.label(I.graphics).text(), labels[k].text()),
            "all solids touch each other, a PLANE and the walls of a cavity; but of cavities ELLIPSOIDs touch BOX, "
            "CYLINDER "
            "and FRUSTUM alone, and CYLINDERs, FRUSTUMs and BOXes no TORUS; only one of two closed curves is a cavity");
        return false;
      }
    }
    return true;
  }

  // Curves are seen along z of each other: that says nothing where their planes stand across each other.
  bool check_planes(const Model& model, std::size_t k, Diagnostics& diagnostics) const {
    static constexpr double least_cosine = 0.98;
    const ContactForce& f = forces_[k];
    const RelativeFrame<double> I = drawn_frame(model, f.i, f.j);
    const auto z_of = [](const PlacedSide& s) { return s.from_first.axes.z; };
    for (std::size_t a = 0; a < f.I.size(); ++a) {
      for (std::size_t b = 0; b < f.J.size(); ++b) {
        if (!solid::is_profile(f.I[a].side) || !solid::is_profile(f.J[b].side)) continue;
        const Vector z = z_of(f.I[a]);
        const double cosine = std::abs(dot(I.x * z.x + I.y * z.y + I.z * z.z, z_of(f.J[b])));
        if (cosine >= least_cosine) continue;
        diagnostics.error(
            "contact-shape", sides_[k][1][b].at,
            fmt::format("the planes of {} and {}, curves of {}, incline by {:.3g} degrees",
                        model.label(sides_[k][0][a].graphics).text(), model.label(sides_[k][1][b].graphics).text(),
                        labels[k].text(), std::acos(std::min(cosine, 1.0)) * 180 / std::numbers::pi),
            "curves touch in one plane: z of their markers is the same or opposite");
        return false;
      }
    }
    return true;
  }

  // Whether a side needs rotations: not a ball alone that slides.
  bool turns(const Model&, std::size_t k, std::size_t side) const {
    const ContactForce& f = forces_[k];
    const auto& shapes = side == 0 ? f.I : f.J;
    return f.friction || shapes.size() > 1 || !std::holds_alternative<solid::Ball>(shapes[0].side.shape);
  }

  void finish_poisson(const Model& model, std::size_t k, Diagnostics& diagnostics) {
    double inverse = 0;
    for (const MarkerId m : {forces_[k].i, forces_[k].j}) {
      const BodyId body = model.marker(m).place.body;
      if (body == ground_body) continue;
      if (!(model.body(body).mass > 0)) {
        diagnostics.error("contact-without-mass", labels[k].at,
                          fmt::format("POISSON of {} needs the mass of {}, which has none", labels[k].text(),
                                      model.body(body).label.text()),
                          "IMPACT states its damping itself");
        return;
      }
      inverse += 1 / model.body(body).mass;
    }
    Pressure& p = forces_[k].pressure;
    if (elements[k].restitution && inverse > 0)
      p.damping = 2 * damping_ratio(*elements[k].restitution) * std::sqrt(p.stiffness / inverse);
  }

  std::vector<std::array<std::vector<Listed>, 2>> sides_;
  std::vector<ContactForce> forces_;
};

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
        .with_example("CONTACT/1, STIFFNESS=2E5");

}  // namespace dynalin
