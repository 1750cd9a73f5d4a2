#include "flexible/modal_matrices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Eigen::MatrixXd;
using Values = Eigen::Map<const MatrixXd>;

constexpr std::array<std::string_view, 16> known = {"SELNOD", "T_MODE", "R_MODE",  "GENSTIFF", "INVAR1", "INVAR2",
                                                    "INVAR3", "INVAR4", "INVAR5",  "INVAR6",   "INVAR7", "INVAR8",
                                                    "INVAR9", "SELMOD", "GENDAMP", "MODLOAD"};
constexpr std::array<std::string_view, 10> required = {"SELNOD", "T_MODE", "R_MODE", "GENSTIFF", "INVAR1",
                                                       "INVAR2", "INVAR3", "INVAR4", "INVAR6",   "INVAR7"};
constexpr double as_written = 1e-8;  // of a symmetric matrix, by its largest entry
// States are numbered 1000000 + mode and rates 2000000 + mode.
constexpr std::int64_t highest_mode = 999'999;

class MatrixReader {
 public:
  MatrixReader(const Span& at, const std::string& owner, Diagnostics& out) : at_(at), owner_(owner), out_(out) {}

  bool collect(const std::vector<ModalMatrix>& all) {
    for (const ModalMatrix& m : all) {
      if (m.name.empty()) {
        fail(m.at, fmt::format("{} of {} has no NAME that says what it holds", m.label, owner_), names());
      } else if (std::ranges::find(known, m.name) == known.end()) {
        fail(m.at,
             fmt::format("{} of {} is named {}, which is none of the matrices of a body", m.label, owner_, m.name),
             names());
      } else if (!by_name_.emplace(m.name, &m).second) {
        const ModalMatrix& other = *by_name_.at(m.name);
        if (other.label == m.label) {
          fail(at_, fmt::format("{} stands twice among the MATRICES of {}", m.label, owner_), "");
        } else {
          fail(m.at, fmt::format("{} has two matrices {}: {} and {}", owner_, m.name, other.label, m.label), "");
        }
      } else if (!m.values.allFinite()) {
        fail(m.at, fmt::format("{} ({}) of {} has a number that is not finite", m.name, m.label, owner_), "");
      }
    }
    std::vector<std::string_view> missing;
    std::ranges::copy_if(required, std::back_inserter(missing), [&](std::string_view name) { return !has(name); });
    if (!missing.empty())
      fail(at_, fmt::format("{} lacks {} among its MATRICES", owner_, fmt::join(missing, ", ")),
           "MATRIX statements with these NAMEs");
    return sound_;
  }

  bool has(std::string_view name) const { return by_name_.contains(name); }
  Index rows(std::string_view name) const { return find(name).values.rows(); }
  Index columns(std::string_view name) const { return find(name).values.cols(); }
  const Span& statement(std::string_view name) const { return find(name).at; }
  Span place(std::string_view name, Index row, Index column) const { return find(name).place(row, column); }

  // The matrix if it has that size; else zeros, and an error.
  MatrixXd take(std::string_view name, Index rows, Index columns) {
    if (const auto found = by_name_.find(name); found != by_name_.end()) {
      const Values& m = found->second->values;
      if (m.rows() == rows && m.cols() == columns) return m;
      fail(found->second->at,
           fmt::format("{} ({}) of {} must be {} × {}, it is {} × {}", name, found->second->label, owner_, rows,
                       columns, m.rows(), m.cols()),
           "");
    }
    return MatrixXd::Zero(rows, columns);
  }
  MatrixXd take_symmetric(std::string_view name, Index size) {
    const MatrixXd m = take(name, size, size);
    Index r = 0, c = 0;
    if (size > 0 && !((m - m.transpose()).cwiseAbs().maxCoeff(&r, &c) <= as_written * m.cwiseAbs().maxCoeff()))
      fail(place(name, r, c),
           fmt::format("{} of {} is not symmetric: {:g} at {}, {} and {:g} at {}, {}", name, owner_, m(r, c), r + 1,
                       c + 1, m(c, r), c + 1, r + 1),
           "");
    return 0.5 * (m + m.transpose());
  }
  // The whole numbers from 1 to `largest` in the first column; `what` for the message: "the label of a node".
  std::vector<std::int64_t> take_numbers(std::string_view name, const MatrixXd& m, std::int64_t largest,
                                         std::string_view what) {
    std::vector<std::int64_t> numbers;
    std::set<std::int64_t> seen;
    for (Index k = 0; k < m.rows(); ++k) {
      const double x = m(k, 0);
      if (x != std::floor(x) || !(x >= 1 && x <= static_cast<double>(largest))) {
        fail(place(name, k, 0),
             fmt::format("{} of {} has {} in its first column, which is not {}", name, owner_, x, what),
             fmt::format("a whole number from 1 to {}", largest));
      } else if (!seen.insert(static_cast<std::int64_t>(x)).second) {
        fail(place(name, k, 0), fmt::format("{} of {} has {} twice", name, owner_, x), "");
      }
      if (!sound_) return numbers;
      numbers.push_back(static_cast<std::int64_t>(x));
    }
    return numbers;
  }
  bool sound() const { return sound_; }

 private:
  const ModalMatrix& find(std::string_view name) const { return *by_name_.find(name)->second; }
  static std::string names() { return fmt::format("one of {}", fmt::join(known, ", ")); }
  void fail(const Span& at, std::string message, std::string expected) {
    out_.error("body-matrices", at, std::move(message), std::move(expected));
    sound_ = false;
  }

  const Span& at_;
  const std::string& owner_;
  Diagnostics& out_;
  std::map<std::string_view, const ModalMatrix*, std::less<>> by_name_;
  bool sound_ = true;
};

Matrix3 block(const MatrixXd& m, Index at) {
  Matrix3 b;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) b(r, c) = m(static_cast<Index>(r), 3 * at + static_cast<Index>(c));
  }
  return b;
}
Vector column(const MatrixXd& m, Index at) { return {m(0, at), m(1, at), m(2, at)}; }

ModalInertia inertia_of(MatrixReader& in, Index n) {
  ModalInertia I = empty_inertia(static_cast<std::size_t>(n));
  I.mass = in.take("INVAR1", 1, 1)(0, 0);
  I.first = column(in.take("INVAR2", 3, 1), 0);
  const MatrixXd moves = in.take("INVAR3", 3, n), turns = in.take("INVAR4", 3, n), I5 = in.take("INVAR5", 3, n * n),
                 I8 = in.take("INVAR8", 3, 3 * n), I9 = in.take("INVAR9", 3, 3 * n * n);
  I.modal = in.take_symmetric("INVAR6", n);
  I.tensor = block(in.take_symmetric("INVAR7", 3), 0);
  for (Index j = 0; j < n; ++j) {
    const auto mode = static_cast<std::size_t>(j);
    I.of_modes[mode] = column(moves, j), I.turning[mode] = column(turns, j);
    const Matrix3 product = block(I8, j);
    I.tensor_by_mode[mode] = -1.0 * (product + transpose(product));
    for (Index k = 0; k < n; ++k) {
      for (Index c = 0; c < 3; ++c)
        I.turning_by_mode[static_cast<std::size_t>(c)](j, k) = 0.5 * (I5(c, j * n + k) - I5(c, k * n + j));
      const Matrix3 pair = block(I9, j * n + k), other = block(I9, k * n + j);
      const Matrix3 sum = pair + other;
      for (std::size_t at = 0; at < tensor_components.size(); ++at) {
        const auto [r, c] = tensor_components[at];
        I.tensor_by_modes[at](j, k) = -0.5 * (sum(r, c) + sum(c, r));
      }
    }
  }
  return I;
}

}  // namespace

std::optional<ModalBody> modal_body_of(const std::vector<ModalMatrix>& all, const Span& at, const std::string& owner,
                                       Diagnostics& out) {
  MatrixReader in(at, owner, out);
  if (!in.collect(all)) return std::nullopt;
  const Index nodes = in.rows("SELNOD"), n = in.columns("T_MODE");
  ModalBody b;
  const MatrixXd selected = in.take("SELNOD", nodes, 4);
  b.translation = in.take("T_MODE", 3 * nodes, n), b.rotation = in.take("R_MODE", 3 * nodes, n);
  b.inertia = inertia_of(in, n);
  b.stiffness = in.columns("GENSTIFF") == 1 && n != 1 ? MatrixXd(in.take("GENSTIFF", n, 1).col(0).asDiagonal())
                                                      : in.take_symmetric("GENSTIFF", n);
  b.damping = MatrixXd::Zero(n, n);
  if (in.has("GENDAMP")) b.generalized_damping = in.take_symmetric("GENDAMP", n);
  b.loads = in.has("MODLOAD") ? in.take("MODLOAD", 6 + n, in.columns("MODLOAD")) : MatrixXd(6 + n, 0);
  constexpr std::int64_t largest_label = 9'000'000'000'000'000;  // exact in a double
  for (const std::int64_t label : in.take_numbers("SELNOD", selected, largest_label, "the label of a node"))
    b.labels.push_back(std::to_string(label));
  for (Index p = 0; p < nodes; ++p) b.position.push_back({selected(p, 1), selected(p, 2), selected(p, 3)});
  if (in.has("SELMOD")) {
    const Index columns = in.rows("SELMOD") == n && in.columns("SELMOD") == 2 ? 2 : 1;
    const MatrixXd modes = in.take("SELMOD", n, columns);
    if (in.sound()) b.number = in.take_numbers("SELMOD", modes, highest_mode, "the number of a mode");
    if (columns == 2)
      out.warning("body-file-doubt", in.statement("SELMOD"),
                  fmt::format("the second column of SELMOD of {} is passed over", owner));
  } else {
    for (Index k = 1; k <= n; ++k) b.number.push_back(k);
  }
  if (!in.sound()) return std::nullopt;
  if (n > 0 && !(in.has("INVAR5") && in.has("INVAR8") && in.has("INVAR9"))) {
    out.warning("body-file-doubt", at,
                fmt::format("{} has not all of INVAR5, INVAR8 and INVAR9: the inertia of the body does not follow its "
                            "deformation",
                            owner));
  }
  b.displacement = b.rate = Eigen::VectorXd::Zero(n);
  b.holds_displacement.assign(static_cast<std::size_t>(n), false);
  b.holds_rate = b.holds_displacement;
  const auto diagonal = [&](std::string_view name) {
    return [&in, name](Index k) { return in.place(name, k, in.columns(name) == 1 ? 0 : k); };
  };
  const ModalPlaces places{
      in.statement("INVAR1"), in.statement("INVAR6"), in.statement("GENSTIFF"), in.statement("T_MODE"), owner,
      diagonal("INVAR6")};
  if (!check_modal_body(b, places, out)) return std::nullopt;
  return b;
}

}  // namespace dynalin
