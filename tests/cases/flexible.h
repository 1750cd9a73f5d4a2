// Bodies of mass points that move by modes, and the text of their files.
#pragma once

#include <fmt/format.h>

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace dynalin::cases {

struct FlexibleNode {
  std::int64_t label;
  Vector at;
  double mass = 0;
  Vector own{};                      // principal inertias about itself, along the BCS
  std::vector<Vector> moves, turns;  // by a unit of each mode
};

// The generalized mass of mass points.
inline Eigen::MatrixXd mass_of(const std::vector<FlexibleNode>& nodes) {
  const auto n = static_cast<Eigen::Index>(nodes.front().moves.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  for (const FlexibleNode& p : nodes) {
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto a = static_cast<std::size_t>(j), b = static_cast<std::size_t>(k);
        M(j, k) += p.mass * dot(p.moves[a], p.moves[b]);
        for (std::size_t c = 0; c < 3; ++c) M(j, k) += p.own[c] * p.turns[a][c] * p.turns[b][c];
      }
    }
  }
  return M;
}

inline std::string record(int number, const Eigen::MatrixXd& m) {
  std::string t = fmt::format("**\n** RECORD GROUP {}\n", number);
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    for (Eigen::Index c = 0; c < m.cols(); ++c) t += fmt::format(" {:.17g}", m(r, c));
    t += "\n";
  }
  return t;
}

// Records 1, 2 and 5 to 11.
inline std::string modal_text(const std::vector<FlexibleNode>& nodes, const Eigen::MatrixXd& stiffness) {
  const std::size_t modes = nodes.front().moves.size();
  std::string t = fmt::format(
      "** RECORD GROUP 1,HEADER\n**   REVISION.  NODE, NORMAL, ATTACHMENT, CONSTRAINT, REJECTED\n"
      "   REV0 {} {} 0 0 0\n**\n** RECORD GROUP 2,NODES\n",
      nodes.size(), modes);
  for (const FlexibleNode& p : nodes) t += fmt::format(" {}\n", p.label);
  for (std::size_t c = 0; c < 3; ++c) {
    t += fmt::format("**\n** RECORD GROUP {}\n", 5 + c);
    for (const FlexibleNode& p : nodes) t += fmt::format(" {:.17g}\n", p.at[c]);
  }
  t += "**\n** RECORD GROUP 8,SHAPES\n";
  for (std::size_t k = 0; k < modes; ++k) {
    t += fmt::format("**    NORMAL MODE SHAPE #  {}\n", k + 1);
    for (const FlexibleNode& p : nodes) {
      const Vector &u = p.moves[k], &r = p.turns[k];
      t += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", u.x, u.y, u.z, r.x, r.y, r.z);
    }
  }
  t += record(9, mass_of(nodes)) + record(10, stiffness) + "**\n** RECORD GROUP 11\n";
  for (const FlexibleNode& p : nodes)
    t += fmt::format("{0:.17g} {0:.17g} {0:.17g} {1:.17g} {2:.17g} {3:.17g}\n", p.mass, p.own.x, p.own.y, p.own.z);
  return t;
}

// A straight beam along x of equal elements with lumped masses, free in all directions: its full matrices.
struct LumpedBeam {
  std::size_t nodes;
  double length, EA, GJ, EIy, EIz, mass_per_length, inertia_per_length;

  double element() const { return length / static_cast<double>(nodes - 1); }
  double mass_at(std::size_t p) const { return mass_per_length * element() * (p == 0 || p + 1 == nodes ? 0.5 : 1.0); }
  Vector own_at(std::size_t p) const {
    const double part = element() * (p == 0 || p + 1 == nodes ? 0.5 : 1.0);
    return part * inertia_per_length * Vector{1.0, 0.6, 0.7};
  }
  Eigen::MatrixXd M() const {
    Eigen::VectorXd m(6 * static_cast<Eigen::Index>(nodes));
    for (std::size_t p = 0; p < nodes; ++p) {
      const Vector J = own_at(p);
      m.segment<6>(6 * static_cast<Eigen::Index>(p)) << mass_at(p), mass_at(p), mass_at(p), J.x, J.y, J.z;
    }
    return m.asDiagonal();
  }
  Eigen::MatrixXd K() const {
    const auto n = 6 * static_cast<Eigen::Index>(nodes);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    const double h = element();
    const auto spread = [&](Eigen::Index first, const std::vector<Eigen::Index>& at, const Eigen::MatrixXd& k) {
      for (std::size_t r = 0; r < at.size(); ++r) {
        for (std::size_t c = 0; c < at.size(); ++c)
          K(first + at[r], first + at[c]) += k(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
      }
    };
    const Eigen::Matrix2d bar{{1, -1}, {-1, 1}};
    Eigen::Matrix4d bend;
    bend << 12, 6 * h, -12, 6 * h, 6 * h, 4 * h * h, -6 * h, 2 * h * h, -12, -6 * h, 12, -6 * h, 6 * h, 2 * h * h,
        -6 * h, 4 * h * h;
    const Eigen::Vector4d turned{1, -1, 1, -1};  // deflection along z turns about −y
    for (Eigen::Index e = 0; e + 6 < n; e += 6) {
      spread(e, {0, 6}, EA / h * bar);
      spread(e, {3, 9}, GJ / h * bar);
      spread(e, {1, 5, 7, 11}, EIz / (h * h * h) * bend);
      spread(e, {2, 4, 8, 10}, EIy / (h * h * h) * (turned.asDiagonal() * bend * turned.asDiagonal()));
    }
    return K;
  }
};

struct ReducedBody {
  std::vector<FlexibleNode> nodes;
  Eigen::MatrixXd stiffness;
};
// The beam by columns of shapes of all its freedoms.
inline ReducedBody reduced(const LumpedBeam& beam, const Eigen::MatrixXd& shapes) {
  ReducedBody body;
  for (std::size_t p = 0; p < beam.nodes; ++p) {
    FlexibleNode node{static_cast<std::int64_t>(p + 1),
                      {beam.element() * static_cast<double>(p), 0, 0},
                      beam.mass_at(p),
                      beam.own_at(p),
                      {},
                      {}};
    for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
      const Eigen::VectorXd u = shapes.col(k).segment<6>(6 * static_cast<Eigen::Index>(p));
      node.moves.push_back({u(0), u(1), u(2)});
      node.turns.push_back({u(3), u(4), u(5)});
    }
    body.nodes.push_back(std::move(node));
  }
  body.stiffness = shapes.transpose() * beam.K() * shapes;
  body.stiffness = 0.5 * (body.stiffness + body.stiffness.transpose()).eval();
  return body;
}
// Free vibration of the freedoms from `first` on, by ascending frequency: squares of rad/time, and shapes of all.
struct Vibration {
  Eigen::VectorXd squares;
  Eigen::MatrixXd shapes;
};
inline Vibration vibration(const LumpedBeam& beam, Eigen::Index first) {
  const Eigen::MatrixXd M = beam.M(), K = beam.K();
  const Eigen::Index n = M.rows() - first;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K.bottomRightCorner(n, n),
                                                                         M.bottomRightCorner(n, n));
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(M.rows(), n);
  shapes.bottomRows(n) = solver.eigenvectors();
  return {solver.eigenvalues(), shapes};
}

}  // namespace dynalin::cases
