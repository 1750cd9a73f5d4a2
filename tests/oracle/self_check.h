// What the checks of the oracle share: small mechanisms by hand, matrices compared, polynomials.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "mechanism.h"
#include "model.h"
#include "oracle.h"

namespace dynalin::oracle {

constexpr double pi = std::numbers::pi;
constexpr Triple origin{0, 0, 0};

using Kind = ChosenState::Kind;

inline ChosenState rate(int body, int coordinate) { return {Kind::rate, body, BodyKind::part, coordinate, {}, 0, 1}; }
inline ChosenState value(int body, int coordinate) {
  return {Kind::coordinate, body, BodyKind::part, coordinate, {}, 0, 1};
}
inline ChosenState tfsiso_state(int id) {
  return {Kind::differential, 0, BodyKind::part, 0, ElementClass::tfsiso, id, 1};
}

inline Mechanism with_ground() {
  Mechanism m;
  m.bodies.resize(1);
  m.bodies[0].ref = ground;
  return m;
}

inline BodyRef add_part(Mechanism& m, int id, double mass, const std::array<double, 6>& ip, int cm) {
  Body b;
  b.ref = {BodyKind::part, id};
  b.mass = mass;
  b.ip = ip;
  b.cm = cm;
  m.bodies.push_back(b);
  return b.ref;
}

inline Body& body(Mechanism& m, int id) {
  for (Body& b : m.bodies) {
    if (b.ref == BodyRef{BodyKind::part, id}) return b;
  }
  throw std::logic_error("no such part");
}

inline OracleLinearModel linearize_drawn(const Mechanism& m, const std::vector<ChosenState>& states) {
  return oracle_linearize(m, drawn_point(m), states);
}

inline void expect_matrix(const Matrix& actual, const Matrix& expected, double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(actual[i].size(), expected[i].size());
    for (std::size_t j = 0; j < expected[i].size(); ++j) {
      EXPECT_NEAR(actual[i][j], expected[i][j], tolerance) << "(" << i + 1 << "," << j + 1 << ")";
    }
  }
}

// Coefficients of det(sE - A), highest power first and equal to 1, by the recursion of Faddeev and
// Leverrier.
inline std::vector<double> characteristic_polynomial(const Matrix& A) {
  const std::size_t n = A.size();
  std::vector<std::vector<Real>> M(n, std::vector<Real>(n, 0)), AM = M;
  std::vector<double> c{1};
  for (std::size_t k = 1; k <= n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) M[i][j] = AM[i][j] + (i == j ? c.back() : 0);
    }
    Real trace = 0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        AM[i][j] = 0;
        for (std::size_t l = 0; l < n; ++l) AM[i][j] += A[i][l] * M[l][j];
      }
      trace += AM[i][i];
    }
    c.push_back(static_cast<double>(-trace / static_cast<Real>(k)));
  }
  return c;
}

}  // namespace dynalin::oracle
