#include "output/json_values.h"

#include <fmt/format.h>

#include <cmath>

namespace dynalin {

namespace {

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }
Json marker_or_null(std::int64_t id) { return id == 0 ? Json() : Json(id); }

Json body(const BodyState& b) {
  return {
      {"element", b.node > 0 ? fmt::format("{} node {}", b.element.text(), b.node) : b.element.text()},
      {"name", b.view_name},
      {"position", b.position},
      {"angles", b.angles},
      {"axes", b.axes},
      {"velocity", b.velocity},
      {"angular_velocity", b.angular_velocity},
      {"acceleration", b.acceleration},
      {"angular_acceleration", b.angular_acceleration},
      {"mass_centre",
       {{"position", b.centre_position}, {"velocity", b.centre_velocity}, {"acceleration", b.centre_acceleration}}}};
}

Json load(const Load& l) {
  return {{"element", l.element.text()},
          {"type", l.variant},
          {"name", l.view_name},
          {"i", l.marker_I},
          {"j", marker_or_null(l.marker_J)},
          {"axes", marker_or_null(l.axes)},
          {"force", l.force_in_axes},
          {"torque", l.torque_in_axes},
          {"global_force", l.force},
          {"global_torque", l.torque}};
}

template <class Value, class Make>
Json list_of(const std::vector<Value>& values, const Make& make) {
  Json list = Json::array();
  for (const Value& v : values) list.push_back(make(v));
  return list;
}

// What is missing is not a number, which JSON does not know.
Json finite(const std::vector<double>& values) {
  return list_of(values, [](double v) { return std::isfinite(v) ? Json(v) : Json(); });
}

Json channels(const ChannelValues& c) {
  return {{"element", c.element.text()}, {"name", c.view_name}, {"values", c.values}};
}

}  // namespace

Json json_of(const Units& u) {
  return {{"stated", u.stated},           {"force", text_or_null(u.force)},
          {"mass", text_or_null(u.mass)}, {"length", text_or_null(u.length)},
          {"time", text_or_null(u.time)}, {"angle", "RADIAN"},
          {"frequency", u.frequency()},   {"consistency_factor", u.ucf}};
}

Json json_of(const OperatingState& s) {
  return {
      {"time", s.time},
      {"bodies", list_of(s.bodies, body)},
      {"reactions", list_of(s.reactions, load)},
      {"forces", list_of(s.forces, load)},
      {"constraints", list_of(s.constraints,
                              [](const ConstraintValue& c) -> Json {
                                return {{"element", c.element.text()},
                                        {"row", c.row},
                                        {"multiplier", c.multiplier},
                                        {"redundant", c.redundant}};
                              })},
      {"variables",
       list_of(s.variables,
               [](const VariableValue& v) -> Json {
                 return {{"element", "VARIABLE/" + std::to_string(v.id)}, {"name", v.view_name}, {"value", v.value}};
               })},
      {"states", list_of(s.states,
                         [](const StateValue& z) -> Json {
                           return {{"element", z.element.text()},
                                   {"name", z.view_name},
                                   {"number", z.number},
                                   {"value", z.value},
                                   {"rate", z.rate}};
                         })},
      {"curve_parameters",
       list_of(s.parameters,
               [](const ParameterValue& p) -> Json {
                 return {{"element", p.element.text()}, {"parameter", p.name}, {"value", p.value}, {"rate", p.rate}};
               })},
      {"plant_inputs", list_of(s.plant_inputs, channels)},
      {"plant_outputs", list_of(s.plant_outputs, channels)}};
}

Json json_of(const std::vector<RequestValues>& requests) {
  return list_of(requests, [](const RequestValues& r) -> Json {
    return {{"element", r.request.text()},
            {"name", r.view_name},
            {"components", r.components},
            {"values", finite(r.values)}};
  });
}

Json json_of(const History& h) {
  Json variables = Json::object(), requests = Json::object();
  for (const VariableHistory& v : h.variables) variables[std::to_string(v.id)] = finite(v.values);
  for (const RequestHistory& r : h.requests) {
    Json values = Json::array();
    for (const std::vector<double>& step : r.values) values.push_back(finite(step));
    // A REQUEST by its number, what an MREQUEST watches by its whole name.
    const std::string key = r.request.of.empty() ? std::to_string(r.request.element.id) : r.request.text();
    requests[key] = {{"components", r.components}, {"values", std::move(values)}};
  }
  return {{"times", h.times}, {"variables", std::move(variables)}, {"requests", std::move(requests)}};
}

Json json_of(const Stability& s) {
  const bool known = s.verdict != Stability::Verdict::unknown;
  return {{"verdict", s.verdict == Stability::Verdict::stable     ? "stable"
                      : s.verdict == Stability::Verdict::unstable ? "unstable"
                                                                  : "unknown"},
          {"growing_modes", known ? Json(s.growing_modes) : Json()},
          {"reason", text_or_null(s.reason)}};
}

Json json_of(const Remark& r) {
  Json at;
  if (!r.file.empty()) at = {{"file", r.file}, {"line", r.line}, {"column", r.column}};
  return {{"code", r.code}, {"message", r.message}, {"hint", text_or_null(r.hint)}, {"at", at}};
}

}  // namespace dynalin
