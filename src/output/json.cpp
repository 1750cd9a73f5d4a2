#include "output/json.h"

#include <nlohmann/json.hpp>
#include <ostream>

namespace dynalin {

using Json = nlohmann::ordered_json;

struct JsonResults::Document {
  Json results = Json::array();
};

namespace {

Json states(const std::vector<StateLabel>& labels) {
  Json list = Json::array();
  for (const StateLabel& s : labels) {
    std::string label = s.owner.empty() ? s.text : s.text + " " + s.owner;
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

Json channels(const std::vector<ChannelLabel>& labels) {
  Json list = Json::array();
  for (const ChannelLabel& c : labels) list.push_back({{"label", c.text}, {"variable", c.variable}});
  return list;
}

}  // namespace

JsonResults::JsonResults() : document_(std::make_unique<Document>()) {}
JsonResults::~JsonResults() = default;

void JsonResults::add_plain(const std::string& command, double time) {
  document_->results.push_back({{"command", command}, {"time", time}});
}

void JsonResults::add(const std::string& command, const EigenSolution& e) {
  Json values = Json::array();
  for (const EigenMode& m : e.modes) {
    const double re = m.eigenvalue_hz.real() + 0.0, im = m.eigenvalue_hz.imag();
    values.push_back({{"real_hz", re}, {"imag_hz", m.is_real ? 0.0 : im}});
    if (!m.is_real) values.push_back({{"real_hz", re}, {"imag_hz", -im}});
  }
  document_->results.push_back(
      {{"command", command}, {"time", e.time}, {"states", states(e.states)}, {"eigenvalues", std::move(values)}});
}

void JsonResults::add(const std::string& command, const StateSpace& s) {
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

void JsonResults::write(std::ostream& out) const {
  // Commands are kept as written; bytes that are no UTF-8 become replacement characters.
  out << Json{{"results", document_->results}}.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace dynalin
