#include "output/results_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "dataset/characters.h"

namespace dynalin {

namespace {

// Units as results files name them.
std::string unit_name(const std::string& keyword) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 5> short_names = {
      {{"SECOND", "sec"}, {"MILLIMETER", "mm"}, {"CENTIMETER", "cm"}, {"KILOMETER", "km"}, {"KILOGRAM", "kg"}}};
  const auto found =
      std::find_if(short_names.begin(), short_names.end(), [&](const auto& n) { return n.first == keyword; });
  if (found != short_names.end()) return std::string(found->second);
  return lower_case(keyword);
}

// The last part of a view name, or "PART_2".
std::string entity_name(const ElementId& element, const std::string& view_name) {
  if (view_name.empty()) return fmt::format("{}_{}", element.statement, element.id);
  const auto dot = view_name.rfind('.');
  return dot == std::string::npos ? view_name : view_name.substr(dot + 1);
}

// Those of PART, JOINT, SFORCE, VARIABLE, PINPUT, POUTPUT and REQUEST are seen in files of others; the rest is formed
// like them.
std::string_view entity_type(std::string_view statement) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 18> types = {
      {{"PART", "Part"},
       {"POINT_MASS", "Point_Mass"},
       {"JOINT", "Joint"},
       {"JPRIM", "Joint_Primitive"},
       {"MOTION", "Motion"},
       {"SFORCE", "Single_Component_Force"},
       {"SPRINGDAMPER", "Spring_Damper"},
       {"BUSHING", "Bushing"},
       {"FIELD", "Field"},
       {"BEAM", "Beam"},
       {"VFORCE", "Vector_Force"},
       {"VTORQUE", "Vector_Torque"},
       {"GFORCE", "General_Force"},
       {"VARIABLE", "ADAMS_Variable"},
       {"PINPUT", "Plant_Input"},
       {"POUTPUT", "Plant_Output"},
       {"REQUEST", "Request"},
       {"MREQUEST", "Request"}}};
  const auto found = std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.first == statement; });
  return found == types.end() ? statement : found->second;
}

constexpr std::array<std::string_view, 6> position_names = {"X", "Y", "Z", "PSI", "THETA", "PHI"};
constexpr std::array<std::string_view, 6> velocity_names = {"VX", "VY", "VZ", "WX", "WY", "WZ"};
constexpr std::array<std::string_view, 6> acceleration_names = {"ACCX", "ACCY", "ACCZ", "WDX", "WDY", "WDZ"};
constexpr std::array<std::string_view, 6> wrench_names = {"FX", "FY", "FZ", "TX", "TY", "TZ"};

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

ResultsSteps::ResultsSteps(Units units, ResultsContents contents)
    : units_(std::move(units)), contents_(std::move(contents)) {
  const std::string meters = unit_name(units_.length), seconds = unit_name(units_.time),
                    newtons = unit_name(units_.force);
  const auto per_time = [&](const std::string& unit, std::string_view power) {
    return unit.empty() || seconds.empty() ? std::string() : unit + "/" + seconds + std::string(power);
  };
  unit_names_ = {"",
                 meters,
                 "rad",
                 per_time(meters, ""),
                 per_time("rad", ""),
                 per_time(meters, "**2"),
                 per_time("rad", "**2"),
                 newtons,
                 newtons.empty() ? "" : newtons + "*" + meters,
                 seconds};
}

template <class Use>
void ResultsSteps::loads(const std::vector<Load>& list, const Use& use) const {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Load& l = list[k];
    // Those of one element follow each other.
    const bool one_of_many =
        (k > 0 && list[k - 1].element == l.element) || (k + 1 < list.size() && list[k + 1].element == l.element);
    const Owner owner{&l.element, &l.view_name, false, 0, one_of_many ? l.marker_I : 0, nullptr};
    for (std::size_t c = 0; c < 6; ++c)
      use(owner, Component{wrench_names[c], 0, c < 3 ? Unit::force : Unit::torque, nullptr},
          c < 3 ? l.force[c] : l.torque[c - 3]);
  }
}

template <class Use>
void ResultsSteps::for_each(const OperatingState& state, const PointRequests& requests, const Use& use) const {
  use(Owner{}, Component{"TIME", 0, Unit::time, nullptr}, state.time);
  const ResultsSettings& less = contents_.settings;
  const auto motion = [&](bool omitted, const auto& names, Triple BodyState::*first, Triple BodyState::*second,
                          Unit unit, Unit angular) {
    for (std::size_t b = 0; b < state.bodies.size() && !omitted; ++b) {
      const BodyState& body = state.bodies[b];
      const std::size_t count = body.turns ? 6 : 3;
      for (std::size_t k = 0; k < count; ++k)
        use(Owner{&body.element, &body.view_name, true, body.node, 0, nullptr},
            Component{names[k], 0, k < 3 ? unit : angular, nullptr}, k < 3 ? (body.*first)[k] : (body.*second)[k - 3]);
    }
  };
  motion(less.without_displacements, position_names, &BodyState::position, &BodyState::angles, Unit::length,
         Unit::angle);
  motion(less.without_velocities, velocity_names, &BodyState::velocity, &BodyState::angular_velocity, Unit::velocity,
         Unit::angular_velocity);
  motion(less.without_accelerations, acceleration_names, &BodyState::acceleration, &BodyState::angular_acceleration,
         Unit::acceleration, Unit::angular_acceleration);
  if (!less.without_reactions) loads(state.reactions, use);
  if (!less.without_forces) loads(state.forces, use);
  if (!less.without_system_elements) {
    for (const VariableValue& v : state.variables) {
      const ElementId variable{"VARIABLE", v.id};
      use(Owner{&variable, &v.view_name, false, 0, 0, nullptr}, Component{"Q", 0, Unit::none, nullptr}, v.value);
    }
    const auto channels = [&](const std::vector<ChannelValues>& list, std::string_view component) {
      for (const ChannelValues& c : list) {
        for (std::size_t k = 0; k < c.values.size(); ++k)
          use(Owner{&c.element, &c.view_name, false, 0, 0, nullptr},
              Component{component, static_cast<int>(k) + 1, Unit::none, nullptr}, c.values[k]);
      }
    };
    channels(state.plant_inputs, "IN");
    channels(state.plant_outputs, "OUT");
    for (const StateValue& z : state.states) {
      const Owner owner{&z.element, &z.view_name, false, 0, 0, nullptr};
      use(owner, Component{"Q", z.number, Unit::none, nullptr}, z.value);
      use(owner, Component{"QDOT", z.number, Unit::none, nullptr}, z.rate);
    }
  }
  for (std::size_t r = 0; r < requests.infos.size() && contents_.requests; ++r) {
    const RequestInfo& info = *requests.infos[r];
    const auto unit_at = [&](int place) {
      const bool rotation = place > 4;
      switch (info.kind) {
        case RequestKind::displacement:
          return rotation ? Unit::angle : Unit::length;
        case RequestKind::velocity:
          return rotation ? Unit::angular_velocity : Unit::velocity;
        case RequestKind::acceleration:
          return rotation ? Unit::angular_acceleration : Unit::acceleration;
        case RequestKind::force:
          return rotation ? Unit::torque : Unit::force;
        case RequestKind::functions:
          break;
      }
      return Unit::none;
    };
    for (std::size_t k = 0; k < info.components().size(); ++k) {
      const RequestComponent& c = info.components()[k];
      if (c.in_results)
        use(Owner{&info.request.element, &info.view_name, false, 0, 0, &info},
            Component{c.called(), 0, unit_at(c.place), &c}, requests.values[r].values[k]);
    }
  }
}

std::string ResultsSteps::component(const Component& c, std::size_t id) const {
  std::string s = fmt::format("<Component name=\"{}", escaped(c.name));
  if (c.number > 0) s += std::to_string(c.number);
  s += '"';
  const bool given = c.requested && !c.requested->unit.empty();
  const std::string& unit = given ? c.requested->unit : unit_names_[static_cast<std::size_t>(c.unit)];
  if (!unit.empty()) s += fmt::format(" unitsValue=\"{}\"", escaped(unit));
  if (c.requested && !c.requested->label.empty()) s += fmt::format(" plotLabel=\"{}\"", escaped(c.requested->label));
  return s + fmt::format(" id=\"{}\" />\n", id);
}

std::string ResultsSteps::map(const OperatingState& state, const PointRequests& requests) const {
  struct Entity {
    std::string head, components;
  };
  std::vector<Entity> entities;
  std::map<std::string, std::size_t> place;
  std::size_t id = 0;
  for_each(state, requests, [&](const Owner& owner, const Component& c, double) {
    std::string head = "<Entity name=\"time\">\n";
    if (owner.element) {
      std::string name = entity_name(*owner.element, *owner.view_name);
      if (owner.node) name += "_node_" + std::to_string(owner.node);
      if (owner.marker) name += "_MARKER_" + std::to_string(owner.marker);
      if (owner.request && !owner.request->results_name.empty()) name = owner.request->results_name;
      head = fmt::format("<Entity name=\"{}{}\" entity=\"{}\" entType=\"{}\" objectId=\"{}\">\n", escaped(name),
                         owner.is_pose ? "_XFORM" : "", escaped(name), escaped(entity_type(owner.element->statement)),
                         owner.element->id);
    }
    const auto [at, fresh] = place.emplace(head, entities.size());
    if (fresh) entities.push_back({std::move(head), {}});
    entities[at->second].components += component(c, ++id);
  });
  std::string s;
  for (const Entity& e : entities) s += e.head + e.components + "</Entity>\n";
  return s;
}

std::string ResultsSteps::numbers(const OperatingState& state, const PointRequests& requests,
                                  const std::function<std::string(double)>& number) const {
  std::string s;
  Owner before;
  ElementId element_before;
  for_each(state, requests, [&](const Owner& owner, const Component&, double value) {
    const ElementId element = owner.element ? *owner.element : ElementId();
    const bool same = element == element_before && owner.node == before.node && owner.marker == before.marker &&
                      owner.request == before.request;
    if (!s.empty()) s += same ? ' ' : '\n';
    s += number(value);
    before = owner, element_before = element;
  });
  return s + "\n";
}

std::string ResultsSteps::units() const {
  if (units_.length.empty()) return {};
  return fmt::format("<Units angle=\"rad\" length=\"{}\" mass=\"{}\" time=\"{}\" />\n", unit_name(units_.length),
                     unit_name(units_.mass), unit_name(units_.time));
}

}  // namespace dynalin
