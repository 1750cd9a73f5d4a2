#include "output/json.h"

#include <array>
#include <cmath>
#include <ostream>

#include "output/json_values.h"

namespace dynalin {

struct JsonResults::Document {
  Json results = Json::array(), warnings = Json::array(), errors = Json::array();
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

Json matrix(const Eigen::MatrixXd& m) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < m.cols(); ++c) row.push_back(m(r, c) + 0.0);
    rows.push_back(std::move(row));
  }
  return rows;
}

Json column(const Eigen::MatrixXcd& m, std::size_t k) {
  Json list = Json::array();
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    const std::complex<double> v = m(r, static_cast<Eigen::Index>(k));
    list.push_back({v.real() + 0.0, v.imag() + 0.0});
  }
  return list;
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
  return region;
}

Json channels(const std::vector<ChannelLabel>& labels) {
  Json list = Json::array();
  for (const ChannelLabel& c : labels) list.push_back({{"label", c.text}, {"variable", c.variable}});
  return list;
}

}  // namespace

JsonResults::JsonResults(Kept kept) : document_(kept == Kept::results ? std::make_unique<Document>() : nullptr) {}
JsonResults::~JsonResults() = default;

void JsonResults::add_plain(const std::string& command, double time) {
  if (!document_) return;
  document_->results.push_back({{"command", command}, {"time", time}});
}

void JsonResults::add(const std::string& command, const EigenSolution& e) {
  if (!document_) return;
  Json values = Json::array();
  for (const EigenMode& m : e.modes) {
    const double re = m.eigenvalue_hz.real() + 0.0, im = m.eigenvalue_hz.imag();
    values.push_back({{"real_hz", re}, {"imag_hz", m.is_real ? 0.0 : im}});
    if (!m.is_real) values.push_back({{"real_hz", re}, {"imag_hz", -im}});
  }
  Json modes = Json::array();
  for (std::size_t k = 0; k < e.modes.size(); ++k) {
    const EigenMode& m = e.modes[k];
    Json mode = {{"real_hz", m.eigenvalue_hz.real() + 0.0}, {"imag_hz", m.is_real ? 0.0 : m.eigenvalue_hz.imag()}};
    // A defective eigenvalue has no finite condition number or bound; JSON knows no infinity.
    mode["condition"] = std::isfinite(m.condition) ? Json(m.condition) : Json();
    mode["backward_error"] = m.backward_error;
    mode["error_bound_hz"] = std::isfinite(m.error_bound_hz) ? Json(m.error_bound_hz) : Json();
    mode["cluster_size"] = m.cluster_size;
    mode["structural_zero"] = m.structural_zero;
    mode["refined"] = m.refined;
    if (e.vectors.size() > 0) {
      mode["moves_most"] = m.moves_most;
      mode["vector"] = column(e.vectors, k);
      if (e.shapes.size() > 0) mode["shape"] = column(e.shapes, k);
    }
    modes.push_back(std::move(mode));
  }
  document_->results.push_back({{"command", command},
                                {"time", e.time},
                                {"states", states(e.states)},
                                {"shape_entries", shape_labels(e.shape_labels)},
                                {"eigenvalues", std::move(values)},
                                {"modes", std::move(modes)}});
  if (e.selected) document_->results.back()["selected"] = selected(*e.selected);
}

void JsonResults::add(const std::string& command, const StateSpace& s) {
  if (!document_) return;
  document_->results.push_back({{"command", command},
                                {"time", s.time},
                                {"A", matrix(s.A)},
                                {"B", matrix(s.B)},
                                {"C", matrix(s.C)},
                                {"D", matrix(s.D)},
                                {"states", states(s.states)},
                                {"inputs", channels(s.inputs)},
                                {"outputs", channels(s.outputs)}});
}

void JsonResults::add(const std::string& command, const SecondOrder& s) {
  if (!document_) return;
  Eigen::MatrixXd KB(s.K.rows(), s.K.cols() + s.B.cols());
  KB << s.K, s.B;
  document_->results.push_back({{"command", command},
                                {"time", s.time},
                                {"M", matrix(s.M)},
                                {"KB", matrix(KB)},
                                {"B", matrix(s.B)},
                                {"K", matrix(s.K)},
                                {"P", matrix(s.P)},
                                {"C", matrix(s.C)},
                                {"D", matrix(s.D)},
                                {"states", states(s.states)},
                                {"inputs", channels(s.inputs)},
                                {"outputs", channels(s.outputs)}});
}

void JsonResults::add(const std::string& command, const DescriptorForm& s) {
  if (!document_) return;
  document_->results.push_back({{"command", command},
                                {"time", s.time},
                                {"unknowns", s.A.rows()},
                                {"entries", s.A.nonZeros()},
                                {"first_state", s.first_state + 1},
                                {"states", states(s.states)},
                                {"inputs", channels(s.inputs)},
                                {"outputs", channels(s.outputs)}});
}

void JsonResults::add_printed(const std::string& command, double time, const std::string& text) {
  if (!document_) return;
  document_->results.push_back({{"command", command}, {"time", time}, {"text", text}});
}

void JsonResults::add_model(const std::string& command, const std::string& title, const Units& units) {
  if (!document_) return;
  document_->results.push_back({{"command", command}, {"time", 0.0}, {"model", title}, {"units", json_of(units)}});
}

void JsonResults::add_export(const std::string& command, std::string_view type, double time,
                             const std::vector<std::string>& files) {
  if (!document_) return;
  document_->results.push_back({{"command", command}, {"time", time}, {"export", type}, {"files", files}});
}

void JsonResults::add(const std::string& command, const OperatingState& s) {
  if (!document_) return;
  document_->results.push_back({{"command", command}, {"time", s.time}, {"operating_point", json_of(s)}});
}

void JsonResults::add(const std::string& command, const StaticResult& s) {
  if (!document_) return;
  document_->results.push_back({{"command", command},
                                {"time", s.at_rest.time},
                                {"iterations", s.iterations},
                                {"imbalance", s.imbalance},
                                {"stability", json_of(s.stability)},
                                {"operating_point", json_of(s.at_rest)}});
}

void JsonResults::add(const std::string& command, double time, const History& h) {
  if (!document_) return;
  document_->results.push_back({{"command", command}, {"time", time}, {"history", json_of(h)}});
}

void JsonResults::add_tables(const std::vector<ModalTable>& tables) {
  if (!document_) return;
  if (tables.empty()) return;
  Json list = Json::array();
  for (const ModalTable& table : tables) list.push_back(json_of(table));
  document_->results.back()["tables"] = std::move(list);
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
                              const std::vector<std::string>& details) {
  if (!document_) return;
  document_->errors.push_back({{"command", command}, {"message", message}, {"details", details}});
}

void JsonResults::finish(const Units& units, int status, const std::vector<std::string>& files) {
  if (!document_) return;
  document_->units = json_of(units);
  document_->status = status;
  document_->files = files;
}

void JsonResults::write(std::ostream& out) const {
  const Json all = {{"results", document_->results}, {"units", document_->units},   {"warnings", document_->warnings},
                    {"errors", document_->errors},   {"status", document_->status}, {"files", document_->files}};
  // Commands are kept as written; bytes that are no UTF-8 become replacement characters.
  out << all.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace dynalin
