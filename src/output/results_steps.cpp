#include "output/results_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace dynalin {

namespace {

// Units as results files name them.
std::string unit_name(const std::string& keyword) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 5> short_names = {
      {{"SECOND", "sec"}, {"MILLIMETER", "mm"}, {"CENTIMETER", "cm"}, {"KILOMETER", "km"}, {"KILOGRAM", "kg"}}};
  const auto found =
      std::find_if(short_names.begin(), short_names.end(), [&](const auto& n) { return n.first == keyword; });
  if (found != short_names.end()) return std::string(found->second);
  std::string name = keyword;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

std::string statement_of(const std::string& element) { return element.substr(0, element.find('/')); }
std::int64_t id_of(const std::string& element) { return std::stoll(element.substr(element.find('/') + 1)); }

// The last part of a view name, or "PART_2".
std::string entity_name(const std::string& element, const std::string& view_name) {
  if (const auto dot = view_name.rfind('.'); !view_name.empty())
    return dot == std::string::npos ? view_name : view_name.substr(dot + 1);
  std::string name = element;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

// Those of PART, JOINT, SFORCE, VARIABLE, PINPUT and POUTPUT are seen in files of others; the rest is formed like them.
std::string entity_type(const std::string& statement) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 16> types = {
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
       {"POUTPUT", "Plant_Output"}}};
  const auto found = std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.first == statement; });
  return found == types.end() ? statement : std::string(found->second);
}

constexpr std::array<std::string_view, 6> displacement = {"X", "Y", "Z", "PSI", "THETA", "PHI"};
constexpr std::array<std::string_view, 6> velocity = {"VX", "VY", "VZ", "WX", "WY", "WZ"};
constexpr std::array<std::string_view, 6> acceleration = {"ACCX", "ACCY", "ACCZ", "WDX", "WDY", "WDZ"};
constexpr std::array<std::string_view, 6> wrench = {"FX", "FY", "FZ", "TX", "TY", "TZ"};

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

void ResultsSteps::add(StepKind kind, const OperatingState& state) { steps_.push_back({kind, quantities(state)}); }

void ResultsSteps::add_loads(const std::vector<Load>& loads, Section section, std::vector<Quantity>& out) const {
  const std::string force = unit_name(units_.force), length = unit_name(units_.length);
  const std::string torque = force.empty() ? "" : force + "*" + length;
  std::map<std::string, int> count;
  for (const Load& l : loads) ++count[l.element];
  for (const Load& l : loads) {
    std::string name = entity_name(l.element, l.view_name);
    if (count[l.element] > 1) name += "_MARKER_" + std::to_string(l.marker_I);
    const Entity entity{name, name, entity_type(statement_of(l.element)), id_of(l.element)};
    for (std::size_t k = 0; k < 6; ++k)
      out.push_back(
          {section, entity, std::string(wrench[k]), k < 3 ? force : torque, k < 3 ? l.force[k] : l.torque[k - 3]});
  }
}

std::vector<ResultsSteps::Quantity> ResultsSteps::quantities(const OperatingState& state) const {
  const std::string length = unit_name(units_.length), time = unit_name(units_.time);
  const auto per_time = [&](const std::string& unit, std::string_view power) {
    return unit.empty() || time.empty() ? std::string() : unit + "/" + time + std::string(power);
  };
  std::vector<Quantity> list{{Section::time, {"time", "", "", 0}, "TIME", time, state.time}};
  const auto motion = [&](bool omitted, Section section, const auto& names, Triple BodyState::*first,
                          Triple BodyState::*second, const std::string& unit, const std::string& angular) {
    for (const BodyState& b : state.bodies) {
      const std::string name = entity_name(b.element, b.view_name), statement = statement_of(b.element);
      const std::size_t count = statement == "PART" ? 6 : 3;
      for (std::size_t k = 0; k < count && !omitted; ++k)
        list.push_back({section,
                        {name + "_XFORM", name, entity_type(statement), id_of(b.element)},
                        std::string(names[k]),
                        k < 3 ? unit : angular,
                        k < 3 ? (b.*first)[k] : (b.*second)[k - 3]});
    }
  };
  motion(settings_.without_displacements, Section::positions, displacement, &BodyState::position, &BodyState::angles,
         length, "rad");
  motion(settings_.without_velocities, Section::velocities, velocity, &BodyState::velocity,
         &BodyState::angular_velocity, per_time(length, ""), per_time("rad", ""));
  motion(settings_.without_accelerations, Section::accelerations, acceleration, &BodyState::acceleration,
         &BodyState::angular_acceleration, per_time(length, "**2"), per_time("rad", "**2"));
  if (!settings_.without_reactions) add_loads(state.reactions, Section::reactions, list);
  if (!settings_.without_forces) add_loads(state.forces, Section::forces, list);
  if (settings_.without_system_elements) return list;
  const auto value = [&](const std::string& element, const std::string& view_name, const std::string& component,
                         double v) {
    const std::string name = entity_name(element, view_name);
    list.push_back(
        {Section::values, {name, name, entity_type(statement_of(element)), id_of(element)}, component, "", v});
  };
  for (const VariableValue& v : state.variables) value("VARIABLE/" + std::to_string(v.id), v.view_name, "Q", v.value);
  for (const ChannelValues& c : state.plant_inputs) {
    for (std::size_t k = 0; k < c.values.size(); ++k)
      value(c.element, c.view_name, fmt::format("IN{}", k + 1), c.values[k]);
  }
  for (const ChannelValues& c : state.plant_outputs) {
    for (std::size_t k = 0; k < c.values.size(); ++k)
      value(c.element, c.view_name, fmt::format("OUT{}", k + 1), c.values[k]);
  }
  for (const StateValue& z : state.states) {
    value(z.element, z.view_name, fmt::format("Q{}", z.number), z.value);
    value(z.element, z.view_name, fmt::format("QDOT{}", z.number), z.rate);
  }
  return list;
}

std::string ResultsSteps::text(const std::function<std::string(double)>& number) const {
  std::string s;
  if (!units_.length.empty()) {
    s += fmt::format("<Units angle=\"rad\" length=\"{}\" mass=\"{}\" time=\"{}\" />\n", unit_name(units_.length),
                     unit_name(units_.mass), unit_name(units_.time));
  }
  if (steps_.empty()) return s;
  // Places by section, then in the order of their first appearance.
  using Key = std::pair<std::string, std::string>;  // entity and component
  const auto key = [](const Quantity& q) { return Key(q.entity.type + q.entity.name, q.component); };
  std::map<Key, std::size_t> place;
  std::vector<const Quantity*> known;
  for (const Step& step : steps_) {
    for (const Quantity& q : step.quantities) {
      if (place.emplace(key(q), 0).second) known.push_back(&q);
    }
  }
  std::stable_sort(known.begin(), known.end(), [](auto* a, auto* b) { return a->section < b->section; });
  std::map<std::string, std::vector<const Quantity*>> of_entity;
  std::vector<std::string> entities;
  for (std::size_t k = 0; k < known.size(); ++k) {
    place[key(*known[k])] = k;
    auto& members = of_entity[key(*known[k]).first];
    if (members.empty()) entities.push_back(key(*known[k]).first);
    members.push_back(known[k]);
  }
  s += "<StepMap name=\"map_001\">\n";
  for (const std::string& name : entities) {
    const Entity& e = of_entity[name].front()->entity;
    s += fmt::format("<Entity name=\"{}\"", escaped(e.name));
    if (!e.type.empty())
      s += fmt::format(" entity=\"{}\" entType=\"{}\" objectId=\"{}\"", escaped(e.element), escaped(e.type), e.id);
    s += ">\n";
    for (const Quantity* q : of_entity[name]) {
      s += fmt::format("<Component name=\"{}\"", q->component);
      if (!q->unit.empty()) s += fmt::format(" unitsValue=\"{}\"", escaped(q->unit));
      s += fmt::format(" id=\"{}\" />\n", place[key(*q)] + 1);
    }
    s += "</Entity>\n";
  }
  s += "</StepMap>\n";
  std::map<std::string_view, int> count;
  int id = 0;
  for (const Step& step : steps_) {
    const std::string_view kind = step.kind == StepKind::statics ? "static" : "initialConditions";
    std::vector<double> values(known.size(), 0.0);
    for (const Quantity& q : step.quantities) values[place.at(key(q))] = q.value;
    s += fmt::format("<Data name=\"{0}_{1:03d}\" id=\"{2}\">\n<Step type=\"{0}\">\n", kind, ++count[kind], ++id);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const bool ends = k + 1 == values.size() || key(*known[k]).first != key(*known[k + 1]).first;
      s += number(values[k]) + (ends ? "\n" : " ");
    }
    s += "</Step>\n</Data>\n";
  }
  return s;
}

}  // namespace dynalin
