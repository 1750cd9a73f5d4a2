#include "flexible/modal_body.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <charconv>
#include <cmath>

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// What files print of shapes and masses has nine digits and more.
constexpr double rigid_content = 1e-7, not_positive = 1e-12, differing_mass = 1e-6;
// Damping of fewer digits may have so much less than none.
constexpr double feeding = 1e-6;

std::optional<std::int64_t> integer(const std::string& word) {
  std::int64_t value = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

// Sums over the nodes, if the file has their masses.
std::optional<ModalInertia> nodal_sums(const ModalText& t, Diagnostics& out) {
  if (!t.lumped) return std::nullopt;
  MassPoints points;
  bool uneven = false;
  for (std::size_t p = 0; p < t.nodes(); ++p) {
    const auto& m = (*t.lumped)[p];
    uneven |= m[1] != m[0] || m[2] != m[0];
    points.mass.push_back(m[0]);
    points.at.push_back(t.position[p]);
    points.own.push_back({{m[3], 0, 0}, {0, m[4], 0}, {0, 0, m[5]}});
  }
  if (uneven) {
    out.warning("body-file-doubt", t.at[11],
                "RECORD GROUP 11 has masses that differ from axis to axis: those along x are taken");
  }
  points.translation = t.translation, points.rotation = t.rotation;
  return inertia_of(points);
}

void take_whole(const ModalText::Whole& whole, ModalInertia& I) {
  const Matrix3 s = skew(whole.centre);
  I.mass = whole.mass;
  I.first = whole.mass * whole.centre;
  I.tensor = whole.inertia + whole.mass * (transpose(s) * s);
}

// Records 14 to 18; entry(row, j, …) of rows that stand one behind the other.
void take_sums(const ModalText& t, ModalInertia& I) {
  const auto n = I.modes();
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t j = 0; j < n; ++j) {
      if (t.translation_sums) I.of_modes[j][c] = (*t.translation_sums)[c * n + j];
      if (t.turning_sums) I.turning[j][c] = (*t.turning_sums)[c * n + j];
    }
  }
  if (t.tensor_sums) {  // −I8
    for (std::size_t j = 0; j < n; ++j) {
      Matrix3 minus_I8;
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) minus_I8(r, c) = (*t.tensor_sums)[3 * (r * n + j) + c];
      }
      I.tensor_by_mode[j] = minus_I8 + transpose(minus_I8);
    }
  }
  if (t.turning_products) {
    for (std::size_t c = 0; c < 3; ++c) {
      MatrixXd& m = I.turning_by_mode[c];
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < n; ++k)
          m(static_cast<Index>(j), static_cast<Index>(k)) = (*t.turning_products)[(c * n + j) * n + k];
      }
      m = (0.5 * (m - m.transpose())).eval();
    }
  }
  if (t.tensor_products) {
    const auto I9 = [&](std::size_t r, std::size_t j, std::size_t k, std::size_t c) {
      return (*t.tensor_products)[3 * ((r * n + j) * n + k) + c];
    };
    for (std::size_t at = 0; at < tensor_components.size(); ++at) {
      const auto [r, c] = tensor_components[at];
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < n; ++k) {
          I.tensor_by_modes[at](static_cast<Index>(j), static_cast<Index>(k)) =
              -0.5 * (I9(r, j, k, c) + I9(c, j, k, r) + I9(r, k, j, c) + I9(c, k, j, r));
        }
      }
    }
  }
}

// "modes 1-6 and 9"
std::string list_of_modes(const std::vector<std::int64_t>& numbers) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t last = k;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    parts.push_back(last == k ? fmt::format("{}", numbers[k]) : fmt::format("{}-{}", numbers[k], numbers[last]));
    k = last + 1;
  }
  return fmt::format("{} {}", numbers.size() == 1 ? "mode" : "modes", fmt::join(parts, ", "));
}

// The modes that vectors, orthonormal columns, consist of.
std::vector<std::int64_t> modes_in(const MatrixXd& vectors, const ModalBody& body) {
  std::vector<std::int64_t> list;
  const VectorXd part = vectors.rowwise().norm();
  for (Index k = 0; k < part.size(); ++k) {
    if (part(k) > 0.3 * part.maxCoeff()) list.push_back(body.number[static_cast<std::size_t>(k)]);
  }
  return list;
}

}  // namespace

std::optional<std::size_t> ModalBody::node(std::int64_t label) const {
  const auto found = std::ranges::find_if(labels, [&](const std::string& l) { return integer(l) == label; });
  if (found == labels.end()) return std::nullopt;
  return static_cast<std::size_t>(found - labels.begin());
}

std::string ModalBody::near_nodes(std::int64_t label) const {
  std::vector<std::int64_t> known;
  for (const std::string& l : labels) {
    if (const auto n = integer(l)) known.push_back(*n);
  }
  std::ranges::stable_sort(known, {}, [&](std::int64_t n) { return std::abs(n - label); });
  constexpr std::size_t enough = 4;
  const bool all = known.size() <= enough;
  known.resize(std::min(known.size(), enough));
  return fmt::format("{} {}", all ? "its file has the nodes" : "of the nodes of its file the nearest are",
                     fmt::join(known, ", "));
}

std::string ModalBody::fed_modes() const {
  const MatrixXd even = 0.5 * (damping + damping.transpose());
  std::vector<std::int64_t> fed;
  for (Index k = 0; k < even.rows(); ++k) {
    // Without damping of its own a mode must have none together with others.
    if (even(k, k) < 0 || (even(k, k) == 0 && !even.col(k).isZero(0)))
      fed.push_back(number[static_cast<std::size_t>(k)]);
  }
  if (!fed.empty()) return list_of_modes(fed);
  // Each compared with its own: one mode may be damped millions of times more than another.
  const VectorXd unit = even.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0.0; });
  const Eigen::SelfAdjointEigenSolver<MatrixXd> own(MatrixXd(unit.asDiagonal() * even * unit.asDiagonal()));
  const Index bad =
      std::count_if(own.eigenvalues().begin(), own.eigenvalues().end(), [](double x) { return x < -feeding; });
  return bad == 0 ? "" : list_of_modes(modes_in(own.eigenvectors().leftCols(bad), *this));
}

double ModalBody::reach(Index mode) const {
  // Of the whole mass in the mean: nodes on the axis of a torsion do not move, and their places say nothing of it.
  double longest = std::sqrt(std::max(0.0, inertia.modal(mode, mode)) / inertia.mass);
  for (std::size_t p = 0; p < position.size(); ++p)
    longest = std::max(longest, translation.col(mode).segment<3>(3 * static_cast<Index>(p)).norm());
  return longest;
}

void ModalBody::make_rigid() {
  ModalInertia rigid = empty_inertia(0);
  rigid.mass = inertia.mass, rigid.first = inertia.first, rigid.tensor = inertia.tensor;
  inertia = std::move(rigid);
  translation.conservativeResize(Eigen::NoChange, 0), rotation.conservativeResize(Eigen::NoChange, 0);
  stiffness.resize(0, 0), damping.resize(0, 0), generalized_damping.resize(0, 0);
  displacement.resize(0), rate.resize(0);
  number.clear(), holds_displacement.clear(), holds_rate.clear();
  if (loads.size() > 0) loads.conservativeResize(6, Eigen::NoChange);
}

std::optional<ModalBody> modal_body_of(ModalText t, const SourceText& file, Diagnostics& out) {
  const bool sums = t.translation_sums && t.turning_sums;
  if (!t.lumped && !t.whole) {
    out.error("body-file", t.at[1], fmt::format("{} says nothing of the mass of the body as a whole", file.name()),
              "RECORD GROUP 11, masses of the nodes, or 12, mass, centre of mass and inertia");
    return std::nullopt;
  }
  if (!t.lumped && !sums && t.modes() > 0) {
    out.error("body-file", t.at[12],
              fmt::format("{} does not say how the modes move the centre of mass and turn the body", file.name()),
              "RECORD GROUP 11, masses of the nodes, or 14 and 15, the inertia invariants I3 and I4");
    return std::nullopt;
  }
  ModalBody b;
  if (auto from_nodes = nodal_sums(t, out)) {
    b.inertia = std::move(*from_nodes);
    const double scale = t.modes() > 0 ? t.mass.diagonal().cwiseAbs().maxCoeff() : 0;
    const double off = t.modes() > 0 ? (b.inertia.modal - t.mass).cwiseAbs().maxCoeff() : 0;
    if (off > differing_mass * scale) {
      out.warning("body-file-doubt", t.at[9],
                  fmt::format("the masses of the nodes give a generalized mass that differs from RECORD GROUP 9 by "
                              "{:.2g} of its largest entry",
                              off / scale),
                  "the file lists some of the nodes only, or a consistent mass was reduced; RECORD GROUP 9 is taken");
    }
  } else {
    b.inertia = empty_inertia(static_cast<std::size_t>(t.modes()));
    if (t.modes() > 0 && !(t.tensor_sums && t.turning_products && t.tensor_products)) {
      out.warning("body-file-doubt", t.at[14],
                  fmt::format("{} has not all of RECORD GROUP 16, 17 and 18: the inertia of the body does not follow "
                              "its deformation",
                              file.name()));
    }
  }
  if (t.whole) {
    const double of_nodes = t.lumped ? b.inertia.mass : t.whole->mass;
    if (std::abs(of_nodes - t.whole->mass) > differing_mass * t.whole->mass) {
      out.warning("body-file-doubt", t.at[12],
                  fmt::format("RECORD GROUP 12 states a mass of {:.7g}, the masses of the nodes add up to {:.7g}",
                              t.whole->mass, of_nodes),
                  "the file lists some of the nodes only, or one of them is in other units; RECORD GROUP 12 is taken, "
                  "and the nodes for what the modes move of the body");
    }
    take_whole(*t.whole, b.inertia);
  }
  take_sums(t, b.inertia);
  b.inertia.modal = t.mass;
  for (Index k = 1; k <= t.modes(); ++k) b.number.push_back(k);
  b.labels = std::move(t.labels), b.position = std::move(t.position);
  b.translation = std::move(t.translation), b.rotation = std::move(t.rotation);
  b.stiffness = std::move(t.stiffness);
  b.damping = MatrixXd::Zero(t.modes(), t.modes());
  if (t.damping) b.generalized_damping = std::move(*t.damping);
  b.displacement = t.displacement, b.rate = t.rate;
  b.holds_displacement.assign(static_cast<std::size_t>(t.modes()), false);
  b.holds_rate = b.holds_displacement;
  if (!check_modal_body(b, {t.at[t.whole ? 12 : 11], t.at[9], t.at[10], t.at[8], file.name(), {}}, out))
    return std::nullopt;
  return b;
}

bool check_modal_body(const ModalBody& b, const ModalPlaces& at, Diagnostics& out) {
  const MatrixXd& M = b.inertia.modal;
  const Index n = M.rows();
  // INVARIANTS may leave none to a body without modes.
  if (!(b.inertia.mass >= 0) || (b.inertia.mass == 0 && n > 0) || !std::isfinite(b.inertia.mass)) {
    out.error("body-mass", at.whole, fmt::format("the mass {:g} in {} is not positive", b.inertia.mass, at.file));
    return false;
  }
  if (n == 0) return true;
  for (Index k = 0; k < n; ++k) {
    if (M(k, k) > 0) continue;
    out.error("body-mass", at.mass_of_mode ? at.mass_of_mode(k) : at.mass,
              fmt::format("the generalized mass of mode {} in {} is {:g}", b.number[static_cast<std::size_t>(k)],
                          at.file, M(k, k)),
              "a static shape without mass is no mode: give it its mass, or leave it out");
    return false;
  }
  // Compared with each other: coordinates may be lengths of any size.
  const VectorXd unit = M.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = unit.asDiagonal() * M * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> of_mass(scaled);
  const auto below = [](const VectorXd& values, double limit) {
    return static_cast<Index>(std::count_if(values.begin(), values.end(), [&](double x) { return !(x > limit); }));
  };
  if (const Index bad = below(of_mass.eigenvalues(), not_positive); bad > 0) {
    out.error("body-mass", at.mass,
              fmt::format("the generalized mass in {} is not positive: {} depend on each other", at.file,
                          list_of_modes(modes_in(of_mass.eigenvectors().leftCols(bad), b))));
    return false;
  }
  // What the modes have beside motions of the body as a whole, in parts of what they have.
  const MatrixXd whole = b.inertia.matrix(VectorXd::Zero(n));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> rigid(MatrixXd(whole.topLeftCorner(6, 6)));
  if (rigid.eigenvalues()(0) < -1e-9 * rigid.eigenvalues()(5)) {
    out.error(
        "body-mass", at.whole,
        fmt::format("the inertia in {} is not positive: some motion of the body as a whole has less than no energy",
                    at.file),
        "mass, its first moment and the inertia tensor belong together");
    return false;
  }
  const double none = 1e-14 * std::max(rigid.eigenvalues().maxCoeff(), 1e-300);
  const VectorXd inverse = rigid.eigenvalues().unaryExpr([&](double x) { return x > none ? 1 / x : 0.0; });
  const MatrixXd coupling = rigid.eigenvectors().transpose() * whole.topRightCorner(6, n);
  const MatrixXd left = M - coupling.transpose() * inverse.asDiagonal() * coupling;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> beside(left, M);
  if (beside.eigenvalues()(0) < -rigid_content) {
    const MatrixXd vectors = unit.cwiseInverse().asDiagonal() * beside.eigenvectors().leftCols(1);
    out.error(
        "body-mass", at.mass,
        fmt::format("the inertia in {} is not positive: {} with the body as a whole {} less than no energy", at.file,
                    list_of_modes(modes_in(vectors, b)), modes_in(vectors, b).size() == 1 ? "has" : "have"),
        "the generalized mass and what the mass of the nodes makes of the shapes do not go together");
    return false;
  }
  if (const Index bad = below(beside.eigenvalues(), rigid_content); bad > 0) {
    const MatrixXd vectors = unit.cwiseInverse().asDiagonal() * beside.eigenvectors().leftCols(bad);
    const auto list = modes_in(vectors, b);
    out.error("body-mass", at.shapes,
              fmt::format("{} in {} {}: the body has these already", list_of_modes(list), at.file,
                          bad == 1 && list.size() == 1 ? "is a rigid-body motion" : "make rigid-body motions"),
              "leave the modes of frequency zero out of the file");
    return false;
  }
  // Each mode beside itself: a shape of next to no mass is 10²⁰ times as stiff as others, which are no less for it.
  const VectorXd own = b.stiffness.diagonal().unaryExpr([](double k) { return k > 0 ? 1 / std::sqrt(k) : 1; });
  const Eigen::SelfAdjointEigenSolver<MatrixXd> of_stiffness(
      MatrixXd(own.asDiagonal() * b.stiffness * own.asDiagonal()));
  if (const Index bad = below(of_stiffness.eigenvalues(), not_positive); bad > 0) {
    const MatrixXd& vectors = of_stiffness.eigenvectors().leftCols(bad);
    out.error("body-stiffness", at.stiffness,
              fmt::format("the generalized stiffness in {} is not positive: there is none for {}", at.file,
                          list_of_modes(modes_in(vectors, b))));
    return false;
  }
  return true;
}

bool lacks_inertia(const ModalInertia& I) {
  const MatrixXd M = I.matrix(VectorXd::Zero(static_cast<Index>(I.modes())));
  if (!(M.diagonal().minCoeff() > 0)) return true;
  const VectorXd unit = M.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(MatrixXd(unit.asDiagonal() * M * unit.asDiagonal()),
                                                       Eigen::EigenvaluesOnly);
  return !(solver.eigenvalues()(0) > not_positive);
}

namespace {

// Off the diagonal, beside the root of the product of what stands on it: what files with seven digits leave.
constexpr double rounded_coupling = 1e-6;
bool all_but_diagonal(const MatrixXd& m) {
  const VectorXd unit = m.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = unit.asDiagonal() * m * unit.asDiagonal();
  return (scaled - MatrixXd(scaled.diagonal().asDiagonal())).cwiseAbs().maxCoeff() <= rounded_coupling;
}

// Each mode takes the coordinate with the largest share in it; where two of one frequency share theirs, as they come.
std::vector<Index> nearest_coordinates(const OwnModes& m) {
  MatrixXd share = (m.mass.diagonal().cwiseSqrt().asDiagonal() * m.shapes).cwiseAbs();
  std::vector<Index> coordinate(static_cast<std::size_t>(m.shapes.cols()));
  for (std::size_t taken = 0; taken < coordinate.size(); ++taken) {
    Index row = 0, mode = 0;
    share.maxCoeff(&row, &mode);
    coordinate[static_cast<std::size_t>(mode)] = row;
    share.row(row).setConstant(-1), share.col(mode).setConstant(-1);
  }
  return coordinate;
}

}  // namespace

OwnModes own_modes(const ModalBody& b, double ucf) {
  OwnModes m;
  m.mass = b.inertia.modal / ucf;
  if (b.modes() == 0) return m;
  if (m.mass.isDiagonal(0) && b.stiffness.isDiagonal(0)) {
    const VectorXd square = b.stiffness.diagonal().cwiseQuotient(m.mass.diagonal());
    std::vector<Index> order(static_cast<std::size_t>(b.modes()));
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Index>(k);
    std::ranges::stable_sort(order, {}, [&](Index k) { return square(k); });
    m.frequency.resize(b.modes());
    m.shapes = MatrixXd::Zero(b.modes(), b.modes());
    for (Index k = 0; k < b.modes(); ++k) {
      const Index at = order[static_cast<std::size_t>(k)];
      m.frequency(k) = std::sqrt(square(at));
      m.shapes(at, k) = 1 / std::sqrt(m.mass(at, at));
    }
    m.coordinate = std::move(order);
    return m;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(b.stiffness, m.mass);
  m.frequency = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  m.shapes = solver.eigenvectors();
  if (all_but_diagonal(m.mass) && all_but_diagonal(b.stiffness)) m.coordinate = nearest_coordinates(m);
  return m;
}

MatrixXd modal_damping(const OwnModes& m, const std::function<double(Index)>& ratio) {
  VectorXd factor(m.frequency.size());
  for (Index k = 0; k < factor.size(); ++k) factor(k) = 2 * ratio(k) * m.frequency(k);
  const MatrixXd moved = m.mass * m.shapes;
  return moved * factor.asDiagonal() * moved.transpose();
}

}  // namespace dynalin
