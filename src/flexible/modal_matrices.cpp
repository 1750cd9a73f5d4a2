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

class MatrixReader {
 public:
  MatrixReader(const Span& at, const std::string& owner, Diagnostics& out) : at_(at), owner_(owner), out_(out) {}

  bool collect(const std::vector<ModalMatrix>& all) {
    for (const ModalMatrix& m : all) {
      if (m.name.empty()) {
        fail(fmt::format("{} of {} has no NAME that says what it holds", m.label, owner_), names());
      } else if (std::ranges::find(known, m.name) == known.end()) {
        fail(fmt::format("{} of {} is named {}, which is none of the matrices of a body", m.label, owner_, m.name),
             names());
      } else if (!by_name_.emplace(m.name, &m).second) {
        fail(fmt::format("{} has two matrices {}: {} and {}", owner_, m.name, by_name_.at(m.name)->label, m.label), "");
      } else if (!m.values.allFinite()) {
        fail(fmt::format("{} ({}) of {} has a number that is not finite", m.name, m.label, owner_), "");
      }
    }
    std::vector<std::string_view> missing;
    std::ranges::copy_if(required, std::back_inserter(missing), [&](std::string_view name) { return !has(name); });
    if (!missing.empty())
      fail(fmt::format("{} lacks {} among its MATRICES", owner_, fmt::join(missing, ", ")),
           "MATRIX statements with these NAMEs");
    return sound_;
  }

  bool has(std::string_view name) const { return by_name_.contains(name); }
  Index rows(std::string_view name) const { return by_name_.find(name)->second->values.rows(); }
  Index columns(std::string_view name) const { return by_name_.find(name)->second->values.cols(); }

  // The matrix if it has that size; else zeros, and an error.
  MatrixXd take(std::string_view name, Index rows, Index columns) {
    if (const auto found = by_name_.find(name); found != by_name_.end()) {
      const Values& m = found->second->values;
      if (m.rows() == rows && m.cols() == columns) return m;
      fail(fmt::format("{} ({}) of {} must be {} × {}, it is {} × {}", name, found->second->label, owner_, rows,
                       columns, m.rows(), m.cols()),
           "");
    }
    return MatrixXd::Zero(rows, columns);
  }
  MatrixXd take_symmetric(std::string_view name, Index size) {
    const MatrixXd m = take(name, size, size);
    if (size > 0 && !((m - m.transpose()).cwiseAbs().maxCoeff() <= as_written * m.cwiseAbs().maxCoeff()))
      fail(fmt::format("{} of {} is not symmetric", name, owner_), "");
    return 0.5 * (m + m.transpose());
  }
  // The whole numbers in a column; `what` for the message: "a label of a node".
  std::vector<std::int64_t> take_numbers(std::string_view name, const MatrixXd& m, std::string_view what) {
    std::vector<std::int64_t> numbers;
    std::set<std::int64_t> seen;
    for (Index k = 0; k < m.rows(); ++k) {
      const double x = m(k, 0);
      constexpr double largest = 9e15;  // exact in a double
      if (x != std::floor(x) || !(std::abs(x) < largest)) {
        fail(fmt::format("{} of {} has {} in its first column, which is not {}", name, owner_, x, what), "");
      } else if (!seen.insert(static_cast<std::int64_t>(x)).second) {
        fail(fmt::format("{} of {} has {} twice", name, owner_, x), "");
      }
      if (!sound_) return numbers;
      numbers.push_back(static_cast<std::int64_t>(x));
    }
    return numbers;
  }
  bool sound() const { return sound_; }

 private:
  static std::string names() { return fmt::format("one of {}", fmt::join(known, ", ")); }
  void fail(std::string message, std::string expected) {
    out_.error("body-matrices", at_, std::move(message), std::move(expected));
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
  for (const std::int64_t label : in.take_numbers("SELNOD", selected, "the label of a node"))
    b.labels.push_back(std::to_string(label));
  for (Index p = 0; p < nodes; ++p) b.position.push_back({selected(p, 1), selected(p, 2), selected(p, 3)});
  if (in.has("SELMOD")) {
    b.number = in.take_numbers("SELMOD", in.take("SELMOD", n, 1), "the number of a mode");
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
  if (!check_modal_body(b, {at, at, at, owner}, out)) return std::nullopt;
  return b;
}

}  // namespace dynalin
