#include "output/results_file.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <array>
#include <cmath>
#include <iterator>

namespace dynalin {

namespace {

std::string state_map(const std::vector<StateLabel>& states) {
  std::string s = "<dl:StateMap>\n";
  int id = 0;
  for (const StateLabel& label : states) {
    s += fmt::format(
        "<dl:State id=\"{}\" type=\"{}\" element=\"{}\" coordinate=\"{}\" derivative=\"{}\" name=\"{}\" />\n", ++id,
        static_cast<int>(label.type), label.element, label.coordinate, label.is_rate ? 1 : 0,
        escaped(label.owner.empty() ? label.text : label.text + " " + label.owner.text()));
  }
  return s + "</dl:StateMap>\n";
}

std::string channel_map(std::string_view list, std::string_view entry, const std::vector<ChannelLabel>& channels) {
  if (channels.empty()) return {};
  std::string s = fmt::format("<dl:{}>\n", list);
  int id = 0;
  for (const ChannelLabel& c : channels)
    s += fmt::format("<dl:{} id=\"{}\" variable=\"{}\" name=\"{}\" />\n", entry, ++id, c.variable, escaped(c.text));
  return s + fmt::format("</dl:{}>\n", list);
}

}  // namespace

// As XML names what is no finite number.
std::string ResultsFile::number(double x) const {
  if (std::isnan(x)) return "NaN";
  if (std::isinf(x)) return x > 0 ? "INF" : "-INF";
  return fmt::format("{:.{}g}", x + 0.0, head_.digits);
}

void ResultsFile::add(const EigenSolution& e, const std::vector<ModalTable>& tables) {
  std::string s = fmt::format("<dl:Linear time=\"{}\" rm=\"{}\" pstate=\"{}\" damping=\"{}\" original=\"{}\">\n",
                              number(e.time), e.rm, e.pstate, e.without_damping ? 0 : 1, e.original ? 1 : 0);
  s += state_map(e.states);
  if (e.selected) s += selection(*e.selected);
  for (std::size_t k = 0; k < e.modes.size(); ++k) {
    const EigenMode& m = e.modes[k];
    const double size = std::abs(m.eigenvalue_hz);
    s += fmt::format("<dl:Mode number=\"{}\" real=\"{}\" imag=\"{}\" frequency=\"{}\" dampingRatio=\"{}\"", k + 1,
                     number(m.eigenvalue_hz.real()), number(m.is_real ? 0.0 : m.eigenvalue_hz.imag()), number(size),
                     number(size > 0 ? std::abs(m.eigenvalue_hz.real()) / size : 0.0));
    if (e.shapes.cols() == 0) {
      s += " />\n";
      continue;
    }
    if (std::isfinite(m.error_bound_hz)) s += fmt::format(" errorBound=\"{}\"", number(m.error_bound_hz));
    s += ">\n";
    // Entries of one element follow each other.
    for (std::size_t r = 0; r < e.shape_labels.size();) {
      const ShapeLabel& first = e.shape_labels[r];
      s += fmt::format("<dl:Entity name=\"{}\" entType=\"{}\" objectId=\"{}\">\n",
                       escaped(first.name.empty() ? first.element.text() : first.name),
                       escaped(first.element.statement), first.element.id);
      for (; r < e.shape_labels.size() && e.shape_labels[r].element == first.element; ++r) {
        const std::complex<double> v = e.shapes(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k));
        s += fmt::format("<dl:Component name=\"{}\">{} {}</dl:Component>\n", escaped(e.shape_labels[r].quantity),
                         number(v.real()), number(v.imag()));
      }
      s += "</dl:Entity>\n";
    }
    s += "</dl:Mode>\n";
  }
  for (const ModalTable& t : tables) s += table(t);
  blocks_.push_back(s + "</dl:Linear>\n");
}

std::string ResultsFile::selection(const SelectedModes& of) const {
  std::string region;
  if (const auto* nearest = std::get_if<NearestModes>(&of.wanted)) {
    region = fmt::format("nearest=\"{}\" frequency=\"{}\" radius=\"{}\"", nearest->count, number(nearest->frequency),
                         number(of.radius_hz));
  } else {
    const auto& band = std::get<ModesInBand>(of.wanted);
    region = fmt::format("low=\"{}\" high=\"{}\"", number(band.low), number(band.high));
  }
  return fmt::format("<dl:Selected {} found=\"{}\" counted=\"{}\" complete=\"{}\" />\n", region, of.found, of.counted,
                     of.complete ? 1 : 0);
}

std::string ResultsFile::table(const ModalTable& t) const {
  std::string columns;
  for (const std::string& c : t.columns) columns += (columns.empty() ? "" : ";") + c;
  std::string s = fmt::format("<dl:Table name=\"{}\" mode=\"{}\" columns=\"{}\">\n", t.name, t.mode, escaped(columns));
  for (const ModalTable::Row& row : t.rows) {
    s += fmt::format("<dl:Row element=\"{}\" part=\"{}\">", escaped(row.element.text()), row.part);
    for (std::size_t k = 0; k < row.values.size(); ++k) {
      s += (k > 0 ? " " : "") + number(row.values[k]);
      if (!row.imaginary.empty()) s += " " + number(row.imaginary[k]);
    }
    s += "</dl:Row>\n";
  }
  return s + "</dl:Table>\n";
}

std::string ResultsFile::matrix(std::string_view name, const DenseMatrix& m) const {
  if (m.size() == 0) return {};
  std::string s =
      fmt::format("<dl:Matrix name=\"{}\" rows=\"{}\" columns=\"{}\" order=\"column\">\n", name, m.rows(), m.cols());
  for (Eigen::Index c = 0; c < m.cols(); ++c) {
    for (Eigen::Index r = 0; r < m.rows(); ++r) s += number(m(r, c)) + (r + 1 < m.rows() ? " " : "\n");
  }
  return s + "</dl:Matrix>\n";
}

template <class Matrices>
std::string ResultsFile::head(const Matrices& m, std::string_view option) const {
  std::string s = fmt::format(
      "<dl:Linear option=\"{}\" time=\"{}\" rm=\"{}\" pstate=\"{}\" pinput=\"{}\" poutput=\"{}\" damping=\"{}\" "
      "original=\"{}\">\n",
      option, number(m.time), m.rm, m.pstate, m.pinput, m.poutput, m.without_damping ? 0 : 1, m.original ? 1 : 0);
  s += state_map(m.states);
  s += channel_map("Inputs", "Input", m.inputs);
  return s + channel_map("Outputs", "Output", m.outputs);
}

void ResultsFile::add(const StateSpace& model) {
  std::string s = head(model, "STATEMAT");
  s += matrix("A", model.A) + matrix("B", model.B) + matrix("C", model.C) + matrix("D", model.D);
  blocks_.push_back(s + "</dl:Linear>\n");
}

void ResultsFile::add(const SecondOrder& model) {
  DenseMatrix KB(model.K.rows(), model.K.cols() + model.B.cols());
  KB << model.K, model.B;
  std::string s = head(model, "MKB") + matrix("M", model.M) + matrix("KB", KB);
  s += matrix("P", model.P) + matrix("C", model.C) + matrix("D", model.D);
  blocks_.push_back(s + "</dl:Linear>\n");
}

ResultsFile::ResultsFile(std::ostream& out, ResultsHead head)
    : out_(out), head_(std::move(head)), steps_(head_.units, head_.contents) {
  fmt::print(out_,
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Results xmlns=\"http://www.mscsoftware.com/:xrf10\" "
             "xmlns:dl=\"urn:dynalin:linear:1\">\n");
  fmt::print(out_, "<Bibliography>\n<File schema=\"xrf\" version=\"2.0.0.0\" />\n");
  if (!head_.contents.comment.empty())
    fmt::print(out_, "<Revision version=\"1\" derivedFrom=\"-unknown-\"><Comment>{}</Comment></Revision>\n",
               escaped(head_.contents.comment));
  fmt::print(out_, "</Bibliography>\n");
}

void ResultsFile::begin_analysis() {
  in_analysis_ = true;
  fmt::print(out_, "<Analysis name=\"ANALYSIS_{:02d}\" Solver=\"Dynalin {}\">\n<ModelInfo title=\"{}\" />\n{}",
             ++analyses_, head_.version, escaped(head_.title), steps_.units());
}

void ResultsFile::end_analysis(Ending ending) {
  for (const std::string& block : blocks_) out_ << block;
  blocks_.clear(), map_.clear();
  in_analysis_ = false;
  fmt::print(out_, "<TerminationStatus runTermObject=\"\" runStatus=\"{}\" />\n</Analysis>\n",
             ending == Ending::successful ? "Successful" : "Failed");
}

namespace {

std::string_view data_name(StepKind kind) {
  static constexpr std::array<std::string_view, 5> names = {"initialConditions", "static", "quasiStatic", "kinematic",
                                                            "dynamic"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace

void ResultsFile::begin(StepKind kind) {
  end();
  kind_ = kind;
}

void ResultsFile::add(const OperatingState& state, const PointRequests& requests) {
  if (!in_data_) {
    std::string map = steps_.map(state, requests);
    if (in_analysis_ && !map_.empty() && map != map_) end_analysis(Ending::successful);
    if (!in_analysis_) begin_analysis();
    if (map_.empty()) {
      map_ = std::move(map);
      fmt::print(out_, "<StepMap name=\"map_{:03d}\">\n{}</StepMap>\n", analyses_, map_);
    }
    const std::string_view name = data_name(kind_);
    fmt::print(out_, "<Data name=\"{}_{:03d}\" id=\"{}\">\n", name, ++count_[name], ++data_);
    in_data_ = true;
  }
  fmt::print(out_, "<Step type=\"{}\">\n{}</Step>\n", data_name(kind_),
             steps_.numbers(state, requests, [this](double x) { return number(x); }));
}

void ResultsFile::end() {
  if (in_data_) out_ << "</Data>\n";
  in_data_ = false;
}

void ResultsFile::finish(Ending ending) {
  end();
  if (!in_analysis_) begin_analysis();
  end_analysis(ending);
  out_ << "</Results>\n";
}

}  // namespace dynalin
