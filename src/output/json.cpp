#include "output/json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "output/json_text.h"
#include "output/json_values.h"

namespace dynalin {

namespace {

// What belongs to one command, key by key; long lists of numbers as the text that will be written.
class CommandResult {
 public:
  CommandResult(std::initializer_list<std::pair<const char*, Json>> values) {
    for (const auto& [key, value] : values) members_.push_back({key, value, {}});
  }
  CommandResult& add(const char* key, Json value) {
    members_.push_back({key, std::move(value), {}});
    return *this;
  }
  template <class Write>
  CommandResult& write(const char* key, Write&& write) {
    JsonText text(depth_of_values);
    write(text);
    members_.push_back({key, {}, text.take()});
    return *this;
  }
  Json& operator[](std::string_view key) {
    for (Member& m : members_) {
      if (m.key == key) return m.value;
    }
    return members_.emplace_back(Member{std::string(key), {}, {}}).value;
  }
  // Whether it says which model follows this command.
  bool begins_model(const std::string& command) const {
    return members_.front().value == command &&
           std::ranges::any_of(members_, [](const Member& m) { return m.key == "model"; });
  }
  void write_to(JsonText& out) const {
    out.open('{');
    for (const Member& m : members_) {
      out.key(m.key);
      m.text.empty() ? out.value(m.value) : out.text(m.text);
    }
    out.close('}');
  }

 private:
  static constexpr std::size_t depth_of_values = 3;  // {"results": [{"key": …
  struct Member {
    std::string key;
    Json value;
    std::string text;  // instead of the value, unless empty
  };
  std::vector<Member> members_;
};

}  // namespace

struct JsonResults::Document {
  std::vector<CommandResult> results;
  Json warnings = Json::array(), errors = Json::array();
  Json units, status, files = Json::array();
};

namespace {

Json states(const std::vector<StateLabel>& labels) {
  Json list = Json::array();
  for (const StateLabel& s : labels) {
    std::string label = s.owner.empty() ? s.text : s.text + " " + s.owner.text();
    if (s.is_rate) label = "derivative of " + label;
    list.push_back(
        {{"label", label}, {"type", static_cast<int>(s.type)}, {"element", s.element}, {"coordinate", s.coordinate}});
  }
  return list;
}

// Writes a list, and each(k) its entries.
template <class Each>
void write_list(JsonText& out, std::size_t count, Each&& each) {
  out.open('[');
  for (std::size_t k = 0; k < count; ++k) {
    out.element();
    each(k);
  }
  out.close(']');
}

auto matrix(const DenseMatrix& m) {
  return [&](JsonText& out) {
    write_list(out, static_cast<std::size_t>(m.rows()), [&](std::size_t r) {
      write_list(out, static_cast<std::size_t>(m.cols()),
                 [&](std::size_t c) { out.number(m(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c))); });
    });
  };
}

void write_column(JsonText& out, const ComplexDenseMatrix& m, std::size_t k) {
  write_list(out, static_cast<std::size_t>(m.rows()),
             [&](std::size_t r) { out.complex(m(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k))); });
}

void write_eigenvalue(JsonText& out, double real, double imaginary) {
  out.key("real_hz"), out.number(real);
  out.key("imag_hz"), out.number(imaginary);
}

void write_eigenvalues(JsonText& out, const EigenSolution& e) {
  out.open('[');
  for (const EigenMode& m : e.modes) {
    const double re = m.eigenvalue_hz.real(), im = m.eigenvalue_hz.imag();
    const auto one = [&](double imaginary) {
      out.element();
      out.open('{');
      write_eigenvalue(out, re, imaginary);
      out.close('}');
    };
    one(m.is_real ? 0.0 : im);
    if (!m.is_real) one(-im);
  }
  out.close(']');
}

void write_mode(JsonText& out, const EigenSolution& e, std::size_t k) {
  const EigenMode& m = e.modes[k];
  out.open('{');
  write_eigenvalue(out, m.eigenvalue_hz.real(), m.is_real ? 0.0 : m.eigenvalue_hz.imag());
  // A defective eigenvalue has no finite condition number or bound; JSON knows no infinity.
  out.key("condition"), out.number(m.condition);
  out.key("backward_error"), out.number(m.backward_error);
  out.key("error_bound_hz"), out.number(m.error_bound_hz);
  out.key("cluster_size"), out.value(m.cluster_size);
  out.key("structural_zero"), out.value(m.structural_zero);
  out.key("refined"), out.value(m.refined);
  if (e.vectors.size() > 0) {
    out.key("moves_most"), out.value(m.moves_most);
    out.key("vector"), write_column(out, e.vectors, k);
    if (e.shapes.size() > 0) out.key("shape"), write_column(out, e.shapes, k);
  }
  out.close('}');
}

void write_table(JsonText& out, const ModalTable& table) {
  out.open('{');
  out.key("table"), out.value(table.name);
  out.key("mode"), out.value(table.mode > 0 ? Json(table.mode) : Json());
  out.key("columns"), out.value(table.columns);
  out.key("rows");
  write_list(out, table.rows.size(), [&](std::size_t r) {
    const ModalTable::Row& row = table.rows[r];
    out.open('{');
    if (row.element.empty()) {
      out.key("mode"), out.value(row.part);
    } else {
      out.key("element"), out.value(row.element.text());
      out.key("part"), out.value(row.part > 0 ? Json(row.part) : Json());
      out.key("name"), out.value(row.name);
    }
    out.key("values");
    write_list(out, row.values.size(), [&](std::size_t k) {
      if (row.imaginary.empty())
        out.number(row.values[k]);
      else
        out.complex({row.values[k], row.imaginary[k]});
    });
    out.close('}');
  });
  out.close('}');
}

Json shape_labels(const std::vector<ShapeLabel>& labels) {
  Json list = Json::array();
  for (const ShapeLabel& l : labels) {
    list.push_back({{"element", l.element.text()}, {"quantity", l.quantity}});
    if (!l.name.empty()) list.back()["name"] = l.name;
  }
  return list;
}

Json selected(const SelectedModes& s) {
  static constexpr std::array<std::string_view, 4> names = {"nothing", "full_solution", "inertia", "winding_number"};
  Json region;
  if (const auto* nearest = std::get_if<NearestModes>(&s.wanted)) {
    region = {{"nearest", nearest->count}, {"frequency_hz", nearest->frequency}, {"radius_hz", s.radius_hz}};
  } else {
    const auto& band = std::get<ModesInBand>(s.wanted);
    region = {{"band_hz", {band.low, band.high}}};
  }
  region["found"] = s.found;
  region["counted"] = s.by == CountedBy::nothing ? Json() : Json(s.counted);
  region["counted_by"] = names[static_cast<std::size_t>(s.by)];
  region["complete"] = s.complete;
  if (!s.doubt.empty()) region["doubt"] = s.doubt;
  return region;
}

Json names_of_channels(const std::vector<ChannelLabel>& labels) {
  Json list = Json::array();
  for (const ChannelLabel& c : labels) list.push_back({{"label", c.text}, {"variable", c.variable}});
  return list;
}

template <class Matrices>
CommandResult& with_channels(CommandResult& result, const Matrices& of) {
  return result.add("states", states(of.states))
      .add("inputs", names_of_channels(of.inputs))
      .add("outputs", names_of_channels(of.outputs));
}

}  // namespace

JsonResults::JsonResults(Kept kept) : document_(kept == Kept::results ? std::make_unique<Document>() : nullptr) {}
JsonResults::~JsonResults() = default;

void JsonResults::add_plain(const std::string& command, double time) {
  if (!document_) return;
  if (!document_->results.empty() && document_->results.back().begins_model(command)) {
    document_->results.back()["time"] = time;
    return;
  }
  document_->results.push_back(CommandResult{{"command", command}, {"time", time}});
}

void JsonResults::add(const std::string& command, const EigenSolution& e) {
  if (!document_) return;
  CommandResult result = {{"command", command},
                          {"time", e.time},
                          {"states", states(e.states)},
                          {"shape_entries", shape_labels(e.shape_labels)}};
  result.write("eigenvalues", [&](JsonText& out) { write_eigenvalues(out, e); });
  result.write("modes",
               [&](JsonText& out) { write_list(out, e.modes.size(), [&](std::size_t k) { write_mode(out, e, k); }); });
  if (e.selected) result.add("selected", selected(*e.selected));
  document_->results.push_back(std::move(result));
}

void JsonResults::add(const std::string& command, const StateSpace& s) {
  if (!document_) return;
  CommandResult result = {{"command", command}, {"time", s.time}};
  result.write("A", matrix(s.A)).write("B", matrix(s.B)).write("C", matrix(s.C)).write("D", matrix(s.D));
  document_->results.push_back(std::move(with_channels(result, s)));
}

void JsonResults::add(const std::string& command, const SecondOrder& s) {
  if (!document_) return;
  DenseMatrix KB(s.K.rows(), s.K.cols() + s.B.cols());
  KB << s.K, s.B;
  CommandResult result = {{"command", command}, {"time", s.time}};
  result.write("M", matrix(s.M)).write("KB", matrix(KB)).write("B", matrix(s.B)).write("K", matrix(s.K));
  result.write("P", matrix(s.P)).write("C", matrix(s.C)).write("D", matrix(s.D));
  document_->results.push_back(std::move(with_channels(result, s)));
}

void JsonResults::add(const std::string& command, const DescriptorForm& s) {
  if (!document_) return;
  CommandResult result = {{"command", command},
                          {"time", s.time},
                          {"unknowns", s.A.rows()},
                          {"entries", s.A.nonZeros()},
                          {"first_state", s.first_state + 1}};
  document_->results.push_back(std::move(with_channels(result, s)));
}

void JsonResults::add_printed(const std::string& command, double time, const std::string& text) {
  if (!document_) return;
  document_->results.push_back(CommandResult{{"command", command}, {"time", time}, {"text", text}});
}

void JsonResults::add_model(const std::string& command, const std::string& title, const Units& units) {
  if (!document_) return;
  document_->results.push_back(
      CommandResult{{"command", command}, {"time", 0.0}, {"model", title}, {"units", json_of(units)}});
}

void JsonResults::add_export(const std::string& command, std::string_view type, double time,
                             const std::vector<std::string>& files) {
  if (!document_) return;
  document_->results.push_back(CommandResult{{"command", command}, {"time", time}, {"export", type}, {"files", files}});
}

void JsonResults::add(const std::string& command, const OperatingState& s) {
  if (!document_) return;
  document_->results.push_back(CommandResult{{"command", command}, {"time", s.time}, {"operating_point", json_of(s)}});
}

void JsonResults::add(const std::string& command, const StaticResult& s) {
  if (!document_) return;
  document_->results.push_back(CommandResult{{"command", command},
                                             {"time", s.at_rest.time},
                                             {"iterations", s.iterations},
                                             {"imbalance", s.imbalance},
                                             {"stability", json_of(s.stability)},
                                             {"operating_point", json_of(s.at_rest)}});
}

void JsonResults::add(const std::string& command, double time, const History& h) {
  if (!document_) return;
  document_->results.push_back(CommandResult{{"command", command}, {"time", time}, {"history", json_of(h)}});
}

void JsonResults::add_tables(const std::vector<ModalTable>& tables) {
  if (!document_) return;
  if (tables.empty()) return;
  document_->results.back().write("tables", [&](JsonText& out) {
    write_list(out, tables.size(), [&](std::size_t k) { write_table(out, tables[k]); });
  });
}

void JsonResults::add_point(const OperatingState& s) {
  if (!document_) return;
  document_->results.back()["operating_point"] = json_of(s);
}

void JsonResults::add_requests(const std::vector<RequestValues>& requests) {
  if (!document_) return;
  document_->results.back()["operating_point"]["requests"] = json_of(requests);
}

void JsonResults::add_warning(const std::string& command, const Remark& r) {
  if (!document_) return;
  Json warning = json_of(r);
  warning["command"] = command.empty() ? Json() : Json(command);
  document_->warnings.push_back(std::move(warning));
}

void JsonResults::add_failure(const std::string& command, const std::string& message,
                              const std::vector<std::string>& details, std::string_view code) {
  if (!document_) return;
  Json failure = {{"command", command}, {"message", message}, {"details", details}};
  if (!code.empty()) failure["code"] = code;
  document_->errors.push_back(std::move(failure));
}

void JsonResults::finish(const Units& units, int status, const std::vector<std::string>& files) {
  if (!document_) return;
  document_->units = json_of(units);
  document_->status = status;
  document_->files = files;
}

void JsonResults::write(std::ostream& out) const {
  JsonText text;
  text.open('{');
  text.key("results");
  text.open('[');
  for (const CommandResult& r : document_->results) {
    text.element();
    r.write_to(text);
    out << text.take();
  }
  text.close(']');
  const auto of_run = [&](const char* key, const Json& value) { text.key(key), text.value(value); };
  of_run("units", document_->units), of_run("warnings", document_->warnings), of_run("errors", document_->errors);
  of_run("status", document_->status), of_run("files", document_->files);
  text.close('}');
  out << text.take() << '\n';
}

}  // namespace dynalin
