#include "reduction/craig_bampton.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/cycle.h"
#include "base/dense_solvers.h"
#include "reduction/inertia_factors.h"
#include "reduction/interface_rows.h"
#include "reduction/loose_parts.h"
#include "reduction/lowest_modes.h"

namespace dynalin::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// 1/ω² below this part of the largest may be rounding: the shape counts as one without mass. So does one, whatever its
// stiffness, that moves less than this part of the mass of the body, if all of that moved as far as the shape does at
// most: masses are not known better beside each other, and another unit of its own costs digits of all that it is made
// orthogonal to.
constexpr double massless = 1e-11;

// Shapes without mass count as if they vibrated so much faster than the fastest of the others, in squares: more would
// cost digits of the lowest.
constexpr double above_highest = 1e4;
// A pivot of stiffness that rounding may have left where nothing is strained.
constexpr double unstrained = 1e-14;
// Of rigid motions in units of the shapes, squared: they have no mass.
constexpr double massless_rigid = 1e-12;

// The rows and columns of these places.
SparseMatrix part(const SparseMatrix& matrix, const std::vector<Index>& rows, const std::vector<Index>& columns) {
  std::vector<Index> place(static_cast<std::size_t>(matrix.rows()), -1);
  for (std::size_t k = 0; k < rows.size(); ++k) place[static_cast<std::size_t>(rows[k])] = static_cast<Index>(k);
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (SparseMatrix::InnerIterator it(matrix, columns[c]); it; ++it) {
      const Index row = place[static_cast<std::size_t>(it.row())];
      if (row >= 0) entries.emplace_back(static_cast<std::int32_t>(row), static_cast<std::int32_t>(c), it.value());
    }
  }
  SparseMatrix result(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

// Whether the interface at rest holds the body: no free motion leaves all interface freedoms where they are. All of
// them as lengths: motions that rounding has mixed from translations and rotations have no unit of their own.
bool interface_holds(const MatrixXd& rigid_of_interface) {
  if (rigid_of_interface.cols() == 0) return true;
  if (rigid_of_interface.rows() < rigid_of_interface.cols()) return false;
  const VectorXd sizes = rigid_of_interface.colwise().norm();
  if (sizes.minCoeff() <= 0) return false;
  const Eigen::JacobiSVD<MatrixXd> svd(rigid_of_interface * sizes.cwiseInverse().asDiagonal());
  return svd.singularValues().minCoeff() > 1e-8 * svd.singularValues().maxCoeff();
}

struct Orthogonal {
  MatrixXd coordinates;  // shapes out of columns of T
  VectorXd squares;
  MatrixXd massless;  // as well, those without mass, of stiffness 1
  double off_diagonal = 0;
};

// What is not positive, and a motion that shows it, out of columns of T; none if there is no mass.
struct NotPositive {
  std::string_view what;
  VectorXd coordinates;
};

// The rows that say that a vector is orthogonal to rigid motions in m; of those without mass, plainly.
MatrixXd orthogonality(const MatrixXd& m, const MatrixXd& rigid) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> own(MatrixXd(rigid.transpose() * m * rigid));
  const MatrixXd z = rigid * own.eigenvectors();
  MatrixXd rows = m * z;
  for (Index c = 0; c < rows.cols(); ++c) {
    if (own.eigenvalues()[c] <= massless_rigid * own.eigenvalues().maxCoeff()) rows.col(c) = z.col(c);
    rows.col(c).normalize();
  }
  return rows;
}

// The modes of k, m in what is orthogonal in m to the columns of `rigid`. `slowest`: 1/ω² of the slowest mode of the
// body where it is held, beside which rounding shows itself where no shape has a mass.
// `mass_share`: of shapes out of columns of T, by their mass.
template <class MassShare>
tl::expected<Orthogonal, NotPositive> orthogonal_shapes(const MatrixXd& k, const MatrixXd& m, const MatrixXd& rigid,
                                                        double slowest, const MassShare& mass_share) {
  // Translations, rotations and modes have units of their own: those of stiffness, and of mass where they only move the
  // whole.
  const double square = slowest > 0 ? 1 / slowest : m.trace() > 0 ? k.trace() / m.trace() : 0.0;
  const VectorXd unit = (k.diagonal() + square * m.diagonal()).cwiseSqrt().cwiseInverse();
  const auto D = unit.asDiagonal();
  const MatrixXd ms = D * m * D, ks = D * k * D;
  MatrixXd basis = MatrixXd::Identity(m.rows(), m.rows());
  if (rigid.cols() > 0) {
    MatrixXd z = unit.cwiseInverse().asDiagonal() * rigid;
    z.colwise().normalize();
    const Eigen::HouseholderQR<MatrixXd> qr(orthogonality(ms, z));
    basis = columns_of_q(qr, m.rows()).rightCols(m.rows() - rigid.cols());
  }
  const MatrixXd kq = basis.transpose() * ks * basis, mq = basis.transpose() * ms * basis;
  const Eigen::LLT<MatrixXd> root(MatrixXd(0.5 * (kq + kq.transpose())));
  const auto lowest = [&](const MatrixXd& of) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> own(of);
    return VectorXd(D * (basis * own.eigenvectors().col(0)));
  };
  // The rows have units such that what is stiff is near 1.
  if (root.info() != Eigen::Success || MatrixXd(root.matrixL()).diagonal().cwiseAbs2().minCoeff() < unstrained)
    return tl::unexpected(NotPositive{"stiffness", lowest(0.5 * (kq + kq.transpose()))});
  MatrixXd inverse = root.matrixL().solve(mq);
  inverse = root.matrixL().solve(inverse.transpose()).eval();
  // 1/ω² and not ω²: the lowest are the most exact ones, and shapes without mass end at zero.
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(0.5 * (inverse + inverse.transpose())));
  const VectorXd values = eigen.eigenvalues().reverse();
  const bool only_these = slowest == 0;
  slowest = std::max(slowest, values[0]);
  if (!(slowest > 0) || values[values.size() - 1] < -1e-8 * slowest)
    return tl::unexpected(NotPositive{"mass", lowest(0.5 * (mq + mq.transpose()))});
  const MatrixXd of_stiffness_1 = basis * root.matrixU().solve(eigen.eigenvectors().rowwise().reverse());
  const VectorXd shares = mass_share(MatrixXd(D * of_stiffness_1), values);
  std::vector<Index> heavy, light;
  for (Index c = 0; c < values.size(); ++c) {
    const bool has_mass = shares[c] > massless || (only_these && c == 0);
    (values[c] > massless * slowest && has_mass ? heavy : light).push_back(c);
  }
  const auto count = static_cast<Index>(heavy.size());
  MatrixXd v = of_stiffness_1(Eigen::all, heavy);
  // Rounding of the high shapes is taken out by the low ones: Cholesky in ascending order.
  for (int pass = 0; pass < 2; ++pass) {
    const VectorXd size = (v.transpose() * ms * v).diagonal().cwiseSqrt();
    v = v * size.cwiseInverse().asDiagonal();
    const MatrixXd m_of_v = v.transpose() * ms * v;
    const Eigen::LLT<MatrixXd> m_root(MatrixXd(0.5 * (m_of_v + m_of_v.transpose())));
    if (m_root.info() != Eigen::Success) return tl::unexpected(NotPositive{"mass", lowest(mq)});
    v = m_root.matrixL().solve(v.transpose()).transpose();
  }
  Orthogonal result;
  const MatrixXd k_of_v = v.transpose() * ks * v, m_of_v = v.transpose() * ms * v;
  result.squares = k_of_v.diagonal();
  MatrixXd s = of_stiffness_1(Eigen::all, light);
  s -= v * (result.squares.cwiseInverse().asDiagonal() * (v.transpose() * ks * s)).eval();
  s = s * (s.transpose() * ks * s).diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
  result.massless = D * s;
  for (Index c = 0; c < count; ++c) {
    for (Index r = 0; r < count; ++r) {
      if (r == c) continue;
      const double in_k = std::abs(k_of_v(r, c)) / std::sqrt(result.squares[r] * result.squares[c]);
      result.off_diagonal = std::max({result.off_diagonal, std::abs(m_of_v(r, c)), in_k});
    }
  }
  result.coordinates = D * v;
  return result;
}

// The largest displacement of each shape is positive: signs do not depend on the solver.
void settle_signs(MatrixXd& shapes) {
  for (Index c = 0; c < shapes.cols(); ++c) {
    Index largest = 0;
    shapes.col(c).cwiseAbs().maxCoeff(&largest);
    if (shapes(largest, c) < 0) shapes.col(c) = -shapes.col(c);
  }
}

class Reducer {
 public:
  Reducer(const FiniteElementModel& model, const ReductionRequest& request, Diagnostics& diagnostics)
      : model_(model), request_(request), diagnostics_(diagnostics) {}

  tl::expected<Reduction, std::string> run() {
    const tl::unexpected<std::string> told{std::string()};
    if (!check_diagonals()) return told;
    const auto rows = interface_rows(model_.freedoms, request_.interface, request_.rotations_required, diagnostics_);
    if (!rows) return told;
    const std::vector<Index>&b = rows->interface, &i = rows->interior;
    const MatrixXd rigid = rigid_motions(model_);
    const FreeMotions free = free_motions(model_, rigid);
    reduction_.properties = mass_properties(model_, rigid);
    if (reduction_.properties.mass == 0) {
      diagnostics_.error("fe-matrix-not-positive", Span{}, "a translation of the body moves no mass",
                         "the stiffness may stand where the mass belongs");
      return told;
    }
    reduction_.strain_of_rigid = free.strain;
    reduction_.rigid_removed = free.directions.cols();
    reduction_.constraint_modes = static_cast<Index>(b.size());
    const MatrixXd rigid_of_interface = MatrixXd(rigid(b, Eigen::all)) * free.directions;
    if (!interface_holds(arms(b).asDiagonal() * rigid_of_interface)) {
      diagnostics_.error("fe-interface", Span{},
                         fmt::format("the body can move as a rigid body while its interface node{} {} stand{} still",
                                     request_.interface.size() == 1 ? "" : "s", fmt::join(request_.interface, ", "),
                                     request_.interface.size() == 1 ? "s" : ""),
                         "one node with rotations, or three nodes that are not on a line, hold it");
      return told;
    }
    MatrixXd shapes = MatrixXd::Zero(rigid.rows(), reduction_.constraint_modes);
    for (std::size_t k = 0; k < b.size(); ++k) shapes(b[k], static_cast<Index>(k)) = 1;
    if (!i.empty()) {
      const auto modes = add_interior(b, i, shapes);
      if (!modes) return tl::unexpected(modes.error());
    }
    const MatrixXd m = shapes.transpose() * (model_.mass * shapes),
                   k = shapes.transpose() * (model_.stiffness * shapes);
    MatrixXd rigid_coordinates = MatrixXd::Zero(shapes.cols(), free.directions.cols());
    rigid_coordinates.topRows(rigid_of_interface.rows()) = rigid_of_interface;
    if (shapes.cols() == rigid_coordinates.cols()) {
      reduction_.shapes.resize(shapes.rows(), 0), reduction_.squares.resize(0);
      return std::move(reduction_);
    }
    const VectorXd& held = reduction_.fixed_interface;
    auto orthogonal = orthogonal_shapes(0.5 * (k + k.transpose()), 0.5 * (m + m.transpose()), rigid_coordinates,
                                        held.size() > 0 ? 1 / held.minCoeff() : 0.0,
                                        [&](const MatrixXd& coordinates, const VectorXd& masses) {
                                          return mass_shares(all_freedoms(), shapes * coordinates, masses);
                                        });
    if (!orthogonal) {
      const bool of_stiffness = orthogonal.error().what == "stiffness";
      const SparseMatrix& matrix = of_stiffness ? model_.stiffness : model_.mass;
      const auto motion = [&] {
        const VectorXd moved = shapes * orthogonal.error().coordinates;
        return VectorXd(matrix.diagonal().cwiseAbs().cwiseSqrt().cwiseProduct(moved));
      };
      refuse_motion(of_stiffness,
                    fmt::format("the {} is not positive in the shapes of the reduction", orthogonal.error().what),
                    all_freedoms(), motion,
                    free.directions.cols() > 0 && free.directions.cols() < 6
                        ? fmt::format("of its six rigid motions {} strain nothing: are the places of the nodes in the "
                                      "lengths of the matrices, and in the order of the freedoms?",
                                      free.directions.cols())
                        : "a part that is not connected, or a mechanism, can move without being strained");
      return told;
    }
    reduction_.shapes = shapes * orthogonal->coordinates;
    reduction_.squares = std::move(orthogonal->squares);
    add_massless(shapes * orthogonal->massless);
    reduction_.off_diagonal = orthogonal->off_diagonal;
    settle_signs(reduction_.shapes);
    return std::move(reduction_);
  }

 private:
  std::vector<Index> all_freedoms() const {
    std::vector<Index> list(model_.freedoms.size());
    std::iota(list.begin(), list.end(), Index{0});
    return list;
  }

  // What a unit of each of these freedoms moves its place by: of a rotation, what is as far away as the radius of
  // gyration; nothing of a coordinate without a place.
  VectorXd arms(const std::vector<Index>& freedoms) const {
    const MassProperties& p = reduction_.properties;
    // All in one point it has none but for rounding, and rotations nothing to compare with.
    const bool extended = p.inertia.trace() > 1e-12 * p.matrix.diagonal().tail<3>().sum();
    const double radius = extended ? std::sqrt(p.inertia.trace() / p.mass) : 1.0;
    VectorXd arm(static_cast<Index>(freedoms.size()));
    for (std::size_t k = 0; k < freedoms.size(); ++k) {
      const int direction = model_.freedoms[static_cast<std::size_t>(freedoms[k])].direction;
      arm[static_cast<Index>(k)] = direction < 1 ? 0.0 : direction > 3 ? radius : 1.0;
    }
    return arm;
  }

  // Of the mass of the body, if all of it moved as far as each shape of these freedoms does at most.
  VectorXd mass_shares(const std::vector<Index>& freedoms, const MatrixXd& shapes, const VectorXd& masses) const {
    const VectorXd farthest = (arms(freedoms).asDiagonal() * shapes).cwiseAbs().colwise().maxCoeff().transpose();
    return masses.cwiseQuotient(reduction_.properties.mass * farthest.cwiseAbs2());
  }

  // An error that names what is loose or, of a motion of these freedoms, the one that moves most, where it is written.
  template <class Motion>
  void refuse_motion(bool of_stiffness, std::string message, const std::vector<Index>& freedoms, const Motion& motion,
                     std::string hint) {
    const auto loose = of_stiffness ? loose_part(model_, request_.interface.front()) : std::nullopt;
    Index row = 0;
    if (loose) {
      row = loose->row;
      message += ": " + loose->text;
    } else {
      motion().cwiseAbs().maxCoeff(&row);
      row = freedoms[static_cast<std::size_t>(row)];
      message += fmt::format(", most of all where {} moves", name_of(model_.freedoms[static_cast<std::size_t>(row)]));
    }
    const auto& at = of_stiffness ? model_.stiffness_at : model_.mass_at;
    diagnostics_.error("fe-matrix-not-positive", at ? at(row) : Span{}, std::move(message), std::move(hint));
  }

  bool check_diagonals() {
    const auto refuse = [&](const SparseMatrix& matrix, std::string_view what, const auto& at) {
      const VectorXd diagonal = matrix.diagonal();
      if (diagonal.minCoeff() >= 0) return true;
      Index row = 0;
      diagonal.minCoeff(&row);
      const Freedom& f = model_.freedoms[static_cast<std::size_t>(row)];
      diagnostics_.error("fe-matrix-not-positive", at ? at(row) : Span{},
                         fmt::format("the {} of {} is negative: {:.6g}", what, name_of(f), diagonal[row]));
      return false;
    };
    return refuse(model_.stiffness, "stiffness", model_.stiffness_at) && refuse(model_.mass, "mass", model_.mass_at);
  }

  // The file has a mass of 1 for each shape. What these yield belongs to the interface: they are kept, and too fast for
  // that mass to matter. With the motions of the body they have no mass in common.
  void add_massless(const MatrixXd& unit_stiffness) {
    const Index first = reduction_.squares.size(), count = unit_stiffness.cols();
    reduction_.massless = count;
    if (count == 0) return;
    const double square =
        above_highest * (first > 0 ? reduction_.squares[first - 1] : reduction_.fixed_interface.maxCoeff());
    reduction_.shapes.conservativeResize(Eigen::NoChange, first + count);
    reduction_.shapes.rightCols(count) = std::sqrt(square) * unit_stiffness;
    reduction_.squares.conservativeResize(first + count);
    reduction_.squares.tail(count).setConstant(square);
  }

  // Fills the constraint modes inside the body and appends the fixed-interface modes.
  tl::expected<void, std::string> add_interior(const std::vector<Index>& b, const std::vector<Index>& i,
                                               MatrixXd& shapes) {
    const SparseMatrix k_ii = part(model_.stiffness, i, i), m_ii = part(model_.mass, i, i);
    const InertiaFactors factors(k_ii);
    if (factors.null_pivots() > 0 || factors.negative() > 0) {
      const Index count = factors.negative() > 0 ? factors.negative() : factors.null_pivots();
      refuse_motion(
          true,
          factors.negative() > 0
              ? fmt::format("the stiffness inside has {} negative eigenvalue{}", count, count == 1 ? "" : "s")
              : fmt::format("with the interface held, {} motion{} nothing", count,
                            count == 1 ? " strains" : "s strain"),
          i, [&] { return weakest_motion(k_ii); },
          "a part that is not connected, or a mechanism, can move without being strained");
      return tl::unexpected(std::string());
    }
    MatrixXd inside = -MatrixXd(part(model_.stiffness, i, b));
    factors.solve(inside);
    const double w = cycle * request_.highest_frequency;
    const auto modes = lowest_modes(k_ii, m_ii, factors, {request_.modes, w * w});
    if (!modes) return tl::unexpected(modes.error());
    // Inside the body what has no mass is moved by what has: it needs no shapes of its own.
    const VectorXd shares = mass_shares(i, modes->shapes, VectorXd::Ones(modes->shapes.cols()));
    std::vector<Index> heavy;
    for (Index c = 0; c < shares.size(); ++c) {
      if (shares[c] > massless) heavy.push_back(c);
    }
    const Index first = shapes.cols(), count = static_cast<Index>(heavy.size());
    shapes.conservativeResize(Eigen::NoChange, first + count);
    shapes.rightCols(count).setZero();
    shapes(i, Eigen::seqN(0, first)) = inside;
    shapes(i, Eigen::seqN(first, count)) = modes->shapes(Eigen::all, heavy);
    reduction_.fixed_interface = modes->squares(heavy);
    return {};
  }

  const FiniteElementModel& model_;
  const ReductionRequest& request_;
  Diagnostics& diagnostics_;
  Reduction reduction_;
};

}  // namespace

tl::expected<Reduction, std::string> reduce_model(const FiniteElementModel& model, const ReductionRequest& request,
                                                  Diagnostics& diagnostics) {
  return Reducer(model, request, diagnostics).run();
}

}  // namespace dynalin::reduction
