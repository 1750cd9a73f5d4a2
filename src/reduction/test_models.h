// Finite-element models made in tests: beams of Euler and Bernoulli, blocks of eight-node bricks.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <vector>

#include "reduction/finite_element_model.h"

namespace dynalin::reduction::test {

using Triplets = std::vector<Eigen::Triplet<double, std::int32_t>>;

inline SparseMatrix matrix_of(Eigen::Index n, const Triplets& entries) {
  SparseMatrix m(n, n);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

struct Section {
  double EA = 2.1e11 * 6e-4, GJ = 8.1e10 * 4.7e-8, EIy = 2.1e11 * 2e-8, EIz = 2.1e11 * 4.5e-8;
  double mass = 7800 * 6e-4, polar = 7800 * 6.5e-8;  // a length
};

// Stiffness and consistent mass of one element along its x axis: u v w and rotations of the first end, then the second.
inline void beam_element(const Section& s, double L, Eigen::Matrix<double, 12, 12>& k,
                         Eigen::Matrix<double, 12, 12>& m) {
  k.setZero(), m.setZero();
  const auto bar = [&](int a, int b, double stiff, double mass) {
    k(a, a) += stiff, k(b, b) += stiff, k(a, b) -= stiff, k(b, a) -= stiff;
    m(a, a) += mass / 3, m(b, b) += mass / 3, m(a, b) += mass / 6, m(b, a) += mass / 6;
  };
  bar(0, 6, s.EA / L, s.mass * L), bar(3, 9, s.GJ / L, s.polar * L);
  // Deflection along v with rotation about z; along w rotations about y have the other sign.
  const auto bend = [&](std::array<int, 4> at, double sign, double EI) {
    Eigen::Matrix4d kb, mb;
    kb << 12, 6 * L, -12, 6 * L, 6 * L, 4 * L * L, -6 * L, 2 * L * L, -12, -6 * L, 12, -6 * L, 6 * L, 2 * L * L, -6 * L,
        4 * L * L;
    mb << 156, 22 * L, 54, -13 * L, 22 * L, 4 * L * L, 13 * L, -3 * L * L, 54, 13 * L, 156, -22 * L, -13 * L,
        -3 * L * L, -22 * L, 4 * L * L;
    const Eigen::Vector4d signs(1, sign, 1, sign);
    kb = signs.asDiagonal() * (EI / (L * L * L) * kb) * signs.asDiagonal();
    mb = signs.asDiagonal() * (s.mass * L / 420 * mb) * signs.asDiagonal();
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 4; ++c) {
        k(at[static_cast<std::size_t>(r)], at[static_cast<std::size_t>(c)]) += kb(r, c);
        m(at[static_cast<std::size_t>(r)], at[static_cast<std::size_t>(c)]) += mb(r, c);
      }
    }
  };
  bend({1, 5, 7, 11}, 1, s.EIz), bend({2, 4, 8, 10}, -1, s.EIy);
}

// A straight beam of `elements` from `start` along the first axis of `axes`; nodes 1, 2, …, each with six freedoms.
inline FiniteElementModel beam(int elements, double length, const Section& section = {},
                               const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity(),
                               const Eigen::Vector3d& start = Eigen::Vector3d::Zero()) {
  Eigen::Matrix<double, 12, 12> k, m, turn = Eigen::Matrix<double, 12, 12>::Zero();
  const double L = length / elements;
  beam_element(section, L, k, m);
  for (int block = 0; block < 4; ++block) turn.block<3, 3>(3 * block, 3 * block) = axes;
  k = turn * k * turn.transpose(), m = turn * m * turn.transpose();
  FiniteElementModel model;
  for (int node = 0; node <= elements; ++node) {
    model.nodes[node + 1] = start + axes.col(0) * (L * node);
    for (int d = 1; d <= 6; ++d) model.freedoms.push_back({node + 1, d});
  }
  Triplets stiffness, mass;
  for (int e = 0; e < elements; ++e) {
    for (int r = 0; r < 12; ++r) {
      for (int c = 0; c < 12; ++c) {
        stiffness.emplace_back(6 * e + r, 6 * e + c, k(r, c));
        mass.emplace_back(6 * e + r, 6 * e + c, m(r, c));
      }
    }
  }
  const auto n = static_cast<Eigen::Index>(model.freedoms.size());
  model.stiffness = matrix_of(n, stiffness), model.mass = matrix_of(n, mass);
  return model;
}

struct Block {
  std::array<int, 3> elements = {8, 2, 2};
  Eigen::Vector3d size = {0.4, 0.02, 0.03};
  double modulus = 2.1e11, poisson = 0.3, density = 7800;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();

  NodeLabel node(int i, int j, int k) const {
    return 1 + i + (elements[0] + 1) * (j + static_cast<NodeLabel>(elements[1] + 1) * k);
  }
};

// Eight-node bricks with full integration; three freedoms a node.
inline FiniteElementModel bricks(const Block& b) {
  const Eigen::Vector3d h(b.size[0] / b.elements[0], b.size[1] / b.elements[1], b.size[2] / b.elements[2]);
  static constexpr int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const double lambda = b.modulus * b.poisson / ((1 + b.poisson) * (1 - 2 * b.poisson));
  const double shear = b.modulus / (2 * (1 + b.poisson));
  Eigen::Matrix<double, 6, 6> law = Eigen::Matrix<double, 6, 6>::Zero();
  law.topLeftCorner<3, 3>().setConstant(lambda);
  for (int d = 0; d < 3; ++d) law(d, d) += 2 * shear, law(3 + d, 3 + d) = shear;
  Eigen::Matrix<double, 24, 24> k = Eigen::Matrix<double, 24, 24>::Zero();
  Eigen::Matrix<double, 8, 8> m = Eigen::Matrix<double, 8, 8>::Zero();
  const double volume = h.prod();
  for (const auto& point : corner) {
    const Eigen::Vector3d at = (Eigen::Vector3d(point[0], point[1], point[2]).array() * 2 - 1) / std::sqrt(3.0);
    Eigen::Matrix<double, 6, 24> strain = Eigen::Matrix<double, 6, 24>::Zero();
    Eigen::Matrix<double, 8, 1> shape;
    for (int a = 0; a < 8; ++a) {
      Eigen::Vector3d one, slope;
      for (int d = 0; d < 3; ++d) {
        const double s = 2 * corner[a][d] - 1;
        one[d] = (1 + s * at[d]) / 2, slope[d] = s / h[d];
      }
      shape[a] = one.prod();
      const Eigen::Vector3d g(slope[0] * one[1] * one[2], slope[1] * one[0] * one[2], slope[2] * one[0] * one[1]);
      const int c = 3 * a;
      strain(0, c) = g[0], strain(1, c + 1) = g[1], strain(2, c + 2) = g[2];
      strain(3, c) = g[1], strain(3, c + 1) = g[0], strain(4, c + 1) = g[2], strain(4, c + 2) = g[1];
      strain(5, c) = g[2], strain(5, c + 2) = g[0];
    }
    k += strain.transpose() * law * strain * (volume / 8);
    m += b.density * volume / 8 * shape * shape.transpose();
  }
  Eigen::Matrix<double, 24, 24> turn = Eigen::Matrix<double, 24, 24>::Zero();
  for (int a = 0; a < 8; ++a) turn.block<3, 3>(3 * a, 3 * a) = b.axes;
  k = turn * k * turn.transpose();
  FiniteElementModel model;
  for (int l = 0; l <= b.elements[2]; ++l) {
    for (int j = 0; j <= b.elements[1]; ++j) {
      for (int i = 0; i <= b.elements[0]; ++i) {
        const NodeLabel node = b.node(i, j, l);
        model.nodes.emplace_hint(model.nodes.end(), node,
                                 b.corner + b.axes * Eigen::Vector3d(i * h[0], j * h[1], l * h[2]));
        for (int d = 1; d <= 3; ++d) model.freedoms.push_back({node, d});
      }
    }
  }
  Triplets stiffness, mass;
  for (int l = 0; l < b.elements[2]; ++l) {
    for (int j = 0; j < b.elements[1]; ++j) {
      for (int i = 0; i < b.elements[0]; ++i) {
        std::array<std::int32_t, 8> first{};
        for (std::size_t a = 0; a < 8; ++a)
          first[a] = static_cast<std::int32_t>(3 * (b.node(i + corner[a][0], j + corner[a][1], l + corner[a][2]) - 1));
        for (int r = 0; r < 24; ++r) {
          for (int c = 0; c < 24; ++c) {
            const std::int32_t row = first[static_cast<std::size_t>(r / 3)] + r % 3;
            const std::int32_t column = first[static_cast<std::size_t>(c / 3)] + c % 3;
            stiffness.emplace_back(row, column, k(r, c));
            if (r % 3 == c % 3) mass.emplace_back(row, column, m(r / 3, c / 3));
          }
        }
      }
    }
  }
  const auto n = static_cast<Eigen::Index>(model.freedoms.size());
  model.stiffness = matrix_of(n, stiffness), model.mass = matrix_of(n, mass);
  return model;
}

// The same model with the nodes of its face x = 0 tied to a node `label` in the middle of it with six freedoms.
inline FiniteElementModel with_rigid_face(const FiniteElementModel& model, const std::vector<NodeLabel>& face,
                                          NodeLabel label) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const NodeLabel node : face) middle += model.nodes.at(node) / static_cast<double>(face.size());
  FiniteElementModel tied;
  tied.nodes = model.nodes;
  tied.nodes[label] = middle;
  const auto is_slave = [&](NodeLabel node) { return std::find(face.begin(), face.end(), node) != face.end(); };
  Triplets transformation;
  for (const Freedom& f : model.freedoms) {
    if (!is_slave(f.node)) tied.freedoms.push_back(f);
  }
  const auto first = static_cast<std::int32_t>(tied.freedoms.size());
  for (int d = 1; d <= 6; ++d) tied.freedoms.push_back({label, d});
  std::int32_t next = 0;
  for (std::size_t row = 0; row < model.freedoms.size(); ++row) {
    const Freedom& f = model.freedoms[row];
    const auto r = static_cast<std::int32_t>(row);
    if (!is_slave(f.node)) {
      transformation.emplace_back(r, next++, 1.0);
      continue;
    }
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(f.direction - 1);
    const Eigen::Vector3d turn = (model.nodes.at(f.node) - middle).cross(along);
    transformation.emplace_back(r, first + f.direction - 1, 1.0);
    for (int d = 0; d < 3; ++d) transformation.emplace_back(r, first + 3 + d, turn[d]);
  }
  SparseMatrix T(static_cast<Eigen::Index>(model.freedoms.size()), static_cast<Eigen::Index>(tied.freedoms.size()));
  T.setFromTriplets(transformation.begin(), transformation.end());
  tied.stiffness = T.transpose() * model.stiffness * T;
  tied.mass = T.transpose() * model.mass * T;
  return tied;
}

// All ω² of a small model, ascending.
inline Eigen::VectorXd all_squares(const FiniteElementModel& model) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      Eigen::MatrixXd(model.stiffness), Eigen::MatrixXd(model.mass), Eigen::EigenvaluesOnly);
  return eigen.eigenvalues();
}

}  // namespace dynalin::reduction::test
