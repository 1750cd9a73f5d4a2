#include "output/saved_file.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "output/json_values.h"

namespace dynalin {

namespace {

constexpr std::string_view mark = "save";
constexpr int version_written = 3;

std::uint64_t hash(std::string_view text, std::uint64_t start = 0xcbf29ce484222325U) {  // FNV-1a
  for (const char c : text) start = (start ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return start;
}

std::string digits(std::uint64_t value) { return fmt::format("{:016x}", value); }

// Texts are bytes as the user has them. What is no UTF-8 is kept byte by byte, as the characters of Latin-1.
Json json_of_text(const std::string& text) {
  try {
    (void)Json(text).dump();
    return text;
  } catch (const Json::type_error&) {
    std::string wide;
    for (const char c : text) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x80) {
        wide += c;
      } else {
        wide += static_cast<char>(0xC0 | (byte >> 6));
        wide += static_cast<char>(0x80 | (byte & 0x3F));
      }
    }
    return {{"latin1", wide}};
  }
}

std::string text_of(const Json& json) {
  if (json.is_string()) return json.get<std::string>();
  const std::string wide = json.at("latin1").get<std::string>();
  std::string text;
  for (std::size_t k = 0; k < wide.size(); ++k) {
    const auto byte = static_cast<unsigned char>(wide[k]);
    if (byte < 0x80 || k + 1 == wide.size())
      text += wide[k];
    else
      text += static_cast<char>(((byte & 0x03) << 6) | (static_cast<unsigned char>(wide[++k]) & 0x3F));
  }
  return text;
}

Json json_of_texts(const std::vector<std::string>& texts) {
  Json list = Json::array();
  for (const std::string& text : texts) list.push_back(json_of_text(text));
  return list;
}

std::vector<std::string> texts_of(const Json& json) {
  std::vector<std::string> list;
  for (const Json& text : json) list.push_back(text_of(text));
  return list;
}

Json json_of(const EntryKey& key) {
  return {{"statement", key.statement}, {"id", key.id}, {"name", json_of_text(key.name)}, {"number", key.number}};
}

EntryKey key_of(const Json& json) {
  return {json.at("statement"), json.at("id"), text_of(json.at("name")), json.at("number")};
}

Json json_of(const Vector& v) { return {v.x, v.y, v.z}; }
Vector vector_of(const Json& json) { return {json.at(0), json.at(1), json.at(2)}; }

Json json_of(const std::vector<SavedPoint::Value>& values) {
  Json list = Json::array();
  for (const SavedPoint::Value& v : values) list.push_back({{"of", json_of(v.of)}, {"value", v.value}});
  return list;
}

std::vector<SavedPoint::Value> values_of(const Json& json) {
  std::vector<SavedPoint::Value> list;
  for (const Json& v : json) list.push_back({key_of(v.at("of")), v.at("value")});
  return list;
}

Json json_of(const std::vector<KnownPair>& pairs) {
  Json list = Json::array();
  for (const KnownPair& p : pairs) {
    Json ends = Json::array(), directions = Json::array();
    for (const KnownPair::End& e : p.ends)
      ends.push_back(
          {{"marker", e.marker}, {"body", json_of(e.body)}, {"at", json_of(e.at)}, {"axis", json_of(e.axis)}});
    for (const Vector& d : p.directions) directions.push_back(json_of(d));
    list.push_back({{"of", json_of(p.of)},
                    {"joint", p.joint},
                    {"motion", p.motion},
                    {"ends", std::move(ends)},
                    {"directions", std::move(directions)},
                    {"radius", p.radius}});
  }
  return list;
}

std::vector<KnownPair> pairs_of(const Json& json) {
  std::vector<KnownPair> list;
  for (const Json& p : json) {
    KnownPair pair{
        .of = key_of(p.at("of")), .joint = p.at("joint"), .motion = p.at("motion"), .ends = {}, .directions = {}};
    pair.radius = p.at("radius");
    for (std::size_t k = 0; k < pair.ends.size(); ++k) {
      const Json& end = p.at("ends").at(k);
      pair.ends[k] = {end.at("marker"), key_of(end.at("body")), vector_of(end.at("at")), vector_of(end.at("axis"))};
    }
    for (const Json& d : p.at("directions")) pair.directions.push_back(vector_of(d));
    list.push_back(std::move(pair));
  }
  return list;
}

Json json_of(const SavedPoint& p) {
  Json bodies = Json::array(), coordinates = Json::array(), states = Json::array(), delays = Json::array();
  for (const SavedPoint::Body& b : p.bodies) {
    bodies.push_back({{"of", json_of(b.of)},
                      {"position", json_of(b.pose.r)},
                      {"axes", {json_of(b.pose.R.x), json_of(b.pose.R.y), json_of(b.pose.R.z)}},
                      {"origin_offset", json_of(b.origin_offset)},
                      {"velocity", b.velocity},
                      {"acceleration", b.acceleration}});
  }
  for (const SavedPoint::Coordinates& c : p.coordinates) {
    coordinates.push_back(
        {{"of", json_of(c.of)}, {"values", c.values}, {"velocity", c.velocity}, {"acceleration", c.acceleration}});
  }
  for (const SavedPoint::State& s : p.states)
    states.push_back({{"of", json_of(s.of)}, {"value", s.value}, {"rate", s.rate}});
  for (const SavedPoint::Delay& d : p.delays) {
    Json instants = Json::array();
    for (const DelayHistory::Instant& i : d.instants)
      instants.push_back({i.time, i.value, std::isfinite(i.slope) ? Json(i.slope) : Json(), i.begins});
    delays.push_back({{"of", json_of(d.of)}, {"start", d.start}, {"instants", std::move(instants)}});
  }
  Json turns = Json::array();
  for (const auto& [of, total] : p.turns)
    turns.push_back({{"about", static_cast<int>(of.measure) - static_cast<int>(Measure::AX)},
                     {"i", of.i},
                     {"j", of.j},
                     {"value", total}});
  return {{"time", p.time},
          {"analysis", static_cast<int>(p.mode)},
          {"redundancy_tolerance", p.redundancy_tolerance},
          {"bodies", std::move(bodies)},
          {"coordinates", std::move(coordinates)},
          {"multipliers", json_of(p.multipliers)},
          {"values", json_of(p.values)},
          {"states", std::move(states)},
          {"pairs", json_of(p.pairs)},
          {"memory", json_of(p.memory)},
          {"turns", std::move(turns)},
          {"delays", std::move(delays)}};
}

SavedPoint point_of(const Json& json) {
  SavedPoint p;
  p.time = json.at("time"), p.redundancy_tolerance = json.at("redundancy_tolerance");
  p.mode = static_cast<AnalysisMode>(json.at("analysis").get<int>());
  for (const Json& b : json.at("bodies")) {
    const Json& axes = b.at("axes");
    p.bodies.push_back(
        {key_of(b.at("of")),
         {vector_of(b.at("position")), {vector_of(axes.at(0)), vector_of(axes.at(1)), vector_of(axes.at(2))}},
         vector_of(b.at("origin_offset")),
         b.at("velocity"),
         b.at("acceleration")});
  }
  for (const Json& c : json.at("coordinates"))
    p.coordinates.push_back({key_of(c.at("of")), c.at("values"), c.at("velocity"), c.at("acceleration")});
  p.multipliers = values_of(json.at("multipliers")), p.values = values_of(json.at("values"));
  p.memory = values_of(json.at("memory"));
  for (const Json& t : json.at("turns")) {
    const auto measure = static_cast<Measure>(static_cast<int>(Measure::AX) + t.at("about").get<int>());
    p.turns.emplace(AngleName{measure, t.at("i"), t.at("j")}, t.at("value"));
  }
  for (const Json& s : json.at("states")) p.states.push_back({key_of(s.at("of")), s.at("value"), s.at("rate")});
  // A file that was written before they were kept has none.
  p.pairs = pairs_of(json.value("pairs", Json::array()));
  for (const Json& d : json.at("delays")) {
    SavedPoint::Delay delay{key_of(d.at("of")), d.at("start"), {}};
    for (const Json& i : d.at("instants")) {
      const double slope = i.at(2).is_null() ? std::numeric_limits<double>::quiet_NaN() : i.at(2).get<double>();
      delay.instants.push_back({i.at(0), i.at(1), slope, i.at(3)});
    }
    p.delays.push_back(std::move(delay));
  }
  return p;
}

Json json_of(const SavedFile::Model& m) {
  Json further = Json::array();
  for (const auto& f : m.further) further.push_back({{"path", json_of_text(f.path)}, {"fingerprint", f.fingerprint}});
  return {{"path", json_of_text(m.path)},
          {"text", json_of_text(m.text)},
          {"edits", json_of_texts(m.edits)},
          {"pade", m.pade},
          {"files", std::move(further)},
          {"settings", json_of_texts(m.settings)},
          {"environment", json_of_texts(m.environment)}};
}

SavedFile::Model model_of(const Json& json) {
  SavedFile::Model m;
  m.path = text_of(json.at("path")), m.text = text_of(json.at("text")), m.pade = json.at("pade");
  m.edits = texts_of(json.at("edits")), m.settings = texts_of(json.at("settings"));
  m.environment = texts_of(json.at("environment"));
  for (const Json& f : json.at("files")) m.further.push_back({text_of(f.at("path")), f.at("fingerprint")});
  return m;
}

// Each element with the arguments that are stated anew; it begins with all that it has where it names none.
Json json_of(const Restated& restated) {
  Json list = Json::array();
  for (const auto& [statement, id] : restated.anew()) list.push_back({{"statement", statement}, {"id", id}});
  for (const auto& [element, arguments] : restated.arguments())
    list.push_back({{"statement", element.first}, {"id", element.second}, {"arguments", arguments}});
  return list;
}

Restated restated_of(const Json& json) {
  Restated restated;
  for (const Json& entry : json) {
    const Restated::Element element(entry.at("statement"), entry.at("id"));
    if (!entry.contains("arguments")) restated.begin(element);
    for (const Json& argument : entry.value("arguments", Json::array()))
      restated.state(element, argument.get<std::string>());
  }
  return restated;
}

bool all_finite(const Json& json) {
  if (json.is_number_float()) return std::isfinite(json.get<double>());
  for (const Json& inner : json) {
    if ((inner.is_structured() || inner.is_number_float()) && !all_finite(inner)) return false;
  }
  return true;
}

SavedFile file_of(const Json& json) {
  SavedFile f;
  f.title = text_of(json.at("title"));
  f.model_title = text_of(json.at("model")), f.fingerprint = json.at("fingerprint");
  if (const Json& system = json.at("system"); !system.is_null()) f.system = model_of(system);
  f.started = json.at("started"), f.consistent = json.at("consistent");
  f.restated = restated_of(json.at("restated"));
  f.redundant_rows = texts_of(json.at("redundant_rows"));
  f.point = point_of(json.at("point"));
  if (const Json& s = json.at("statics"); !s.is_null())
    f.statics = {s.at("iterations"), s.at("imbalance"), point_of(s.at("at_rest"))};
  return f;
}

}  // namespace

tl::expected<std::string, std::string> saved_text(const SavedFile& f) {
  Json statics;
  if (f.statics)
    statics = {{"iterations", f.statics->iterations},
               {"imbalance", f.statics->imbalance},
               {"at_rest", json_of(f.statics->at_rest)}};
  const Json content = {{"title", json_of_text(f.title)},
                        {"model", json_of_text(f.model_title)},
                        {"fingerprint", f.fingerprint},
                        {"system", f.system ? json_of(*f.system) : Json()},
                        {"started", f.started},
                        {"consistent", f.consistent},
                        {"restated", json_of(f.restated)},
                        {"redundant_rows", json_of_texts(f.redundant_rows)},
                        {"point", json_of(f.point)},
                        {"statics", std::move(statics)}};
  if (!all_finite(content)) return tl::unexpected(std::string("a value of the point is not a number"));
  const Json all = {
      {"dynalin", mark}, {"version", version_written}, {"check", fingerprint(content.dump())}, {"content", content}};
  return all.dump(1) + "\n";
}

tl::expected<SavedFile, std::string> read_saved(std::string_view text) {
  const auto wrong = [](std::string why) { return tl::unexpected(std::move(why)); };
  const Json all = Json::parse(text, nullptr, false);
  if (all.is_discarded()) {
    const std::string_view start = text.substr(0, 40);
    return wrong(start.find("\"dynalin\"") != start.npos ? "it is cut off or damaged" : "it was not written by SAVE");
  }
  if (!all.is_object() || all.value("dynalin", Json()) != mark) return wrong("it was not written by SAVE");
  const Json version = all.value("version", Json());
  if (version != version_written)
    return wrong(
        fmt::format("it is of version {}, and this program reads version {}", version.dump(), version_written));
  const Json content = all.value("content", Json());
  if (all.value("check", Json()) != fingerprint(content.dump()))
    return wrong("it was altered after SAVE had written it");
  try {
    return file_of(content);
  } catch (const Json::exception& e) {
    return wrong(fmt::format("it is incomplete: {}", e.what()));
  }
}

std::string fingerprint(std::string_view text) { return digits(hash(text)); }

std::string fingerprint(std::string_view text, const std::vector<std::string>& edits) {
  std::uint64_t value = hash(text);
  for (const std::string& edit : edits) value = hash(edit, hash("\n", value));
  return digits(value);
}

}  // namespace dynalin
