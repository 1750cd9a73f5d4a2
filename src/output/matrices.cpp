#include "output/matrices.h"

#include <fmt/chrono.h>
#include <fmt/ostream.h>

namespace dynalin {

namespace {

// STATES, PINPUT and POUTPUT of either form.
template <class Form>
void add_lists(const Form& s, std::vector<NamedMatrix>& out) {
  Eigen::MatrixXd states(3, static_cast<Eigen::Index>(s.states.size()));
  for (std::size_t k = 0; k < s.states.size(); ++k) {
    const StateLabel& label = s.states[k];
    states.col(static_cast<Eigen::Index>(k)) << static_cast<double>(label.type), static_cast<double>(label.element),
        static_cast<double>(label.coordinate);
  }
  out.push_back({"STATES", "st", states, true});
  const auto channels = [&](const char* name, const char* suffix, std::int64_t id,
                            const std::vector<ChannelLabel>& list) {
    if (!id) return;
    Eigen::MatrixXd m(static_cast<Eigen::Index>(list.size()) + 1, 1);
    m(0, 0) = static_cast<double>(id);
    for (std::size_t k = 0; k < list.size(); ++k)
      m(static_cast<Eigen::Index>(k) + 1, 0) = static_cast<double>(list[k].variable);
    out.push_back({name, suffix, m});
  };
  channels("PINPUT", "pi", s.pinput, s.inputs);
  channels("POUTPUT", "po", s.poutput, s.outputs);
}

}  // namespace

std::vector<NamedMatrix> named_matrices(const StateSpace& s) {
  std::vector<NamedMatrix> out;
  out.push_back({"A", "a", s.A});
  if (s.pinput) out.push_back({"B", "b", s.B});
  if (s.poutput) out.push_back({"C", "c", s.C});
  if (s.pinput && s.poutput) out.push_back({"D", "d", s.D});
  add_lists(s, out);
  return out;
}

std::vector<NamedMatrix> named_matrices(const SecondOrder& s) {
  std::vector<NamedMatrix> out;
  Eigen::MatrixXd KB(s.K.rows(), s.K.cols() + s.B.cols());
  KB << s.K, s.B;
  out.push_back({"M", "m", s.M});
  out.push_back({"KB", "kb", KB});
  if (s.pinput) out.push_back({"P", "p", s.P});
  if (s.poutput) out.push_back({"C", "c", s.C});
  if (s.pinput && s.poutput) out.push_back({"D", "d", s.D});
  add_lists(s, out);
  return out;
}

void write_fsave(std::ostream& out, const std::vector<NamedMatrix>& matrices, std::time_t date) {
  fmt::print(out, "MATRIXx                      VERSION   700{:5d}    {:%Y-%m-%d %H:%M:%S}\n", matrices.size(),
             fmt::localtime(date));
  for (std::size_t k = 0; k < matrices.size(); ++k) {
    const NamedMatrix& m = matrices[k];
    const bool last = k % 4 == 3 || k + 1 == matrices.size();
    fmt::print(out, "{:<10s}{:5d}{:5d}{}", m.name, m.value.rows(), m.value.cols(), last ? "\n" : "");
  }
  for (const NamedMatrix& m : matrices) {
    fmt::print(out, "{:<10s}{:5d}{:5d}{:5d}{:<20s}\n", m.name, m.value.rows(), m.value.cols(), 0, "(3(1PE25.17))");
    for (Eigen::Index k = 0; k < m.value.size(); ++k) {
      // + 0.0 turns a negative zero into the plain one.
      fmt::print(out, "{:25.17e}{}", m.value.data()[k] + 0.0, k % 3 == 2 || k + 1 == m.value.size() ? "\n" : "");
    }
  }
}

void write_matlab(std::ostream& out, const NamedMatrix& m) {
  const Eigen::MatrixXd v = m.transposed_in_matlab ? Eigen::MatrixXd(m.value.transpose()) : m.value;
  for (Eigen::Index r = 0; r < v.rows(); ++r) {
    for (Eigen::Index c = 0; c < v.cols(); ++c) fmt::print(out, "{}{:.17e}", c ? " " : "", v(r, c) + 0.0);
    out << '\n';
  }
}

}  // namespace dynalin
