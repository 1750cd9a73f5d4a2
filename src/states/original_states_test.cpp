// The principal frame of a body: along principal axes, nearest to the axes of its inertia data, by a stated rule where
// inertias are equal.
#include "states/original_states.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "base/degree.h"

namespace dynalin::original_states_test {
namespace {

Body body_with(const Vector& inertia, const Matrix3& principal, const Matrix3& R_BI) {
  Body b;
  const Matrix3 D{{inertia.x, 0, 0}, {0, inertia.y, 0}, {0, 0, inertia.z}};
  b.J_BC = principal * D * transpose(principal);
  b.R_BI = R_BI;
  return b;
}

void expect_frame(const Matrix3& a, const Matrix3& b, double tolerance = 1e-12) {
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a(r, c), b(r, c), tolerance) << "row " << r << " column " << c;
  }
}

// Every right-handed way to name three orthogonal lines x, y and z.
std::vector<Matrix3> namings(const Matrix3& frame) {
  std::vector<Matrix3> all;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == j) continue;
      for (const double a : {1.0, -1.0}) {
        for (const double b : {1.0, -1.0}) {
          const Vector x = frame[i] * a, y = frame[j] * b;
          all.push_back({x, y, cross(x, y)});
        }
      }
    }
  }
  return all;
}

double nearness(const Matrix3& frame, const Matrix3& to) { return trace(transpose_times(to, frame)); }

TEST(PrincipalAxes, keep_the_axes_of_a_diagonal_tensor_in_any_order) {
  const Matrix3 R = rotation_313(0.3, 1.1, -0.7);
  for (const Vector& inertia : {Vector{3, 1, 2}, Vector{1, 2, 3}, Vector{2, 3, 1.5}, Vector{1, 1, 1}, Vector{1, 1, 2},
                                Vector{2, 1, 1}, Vector{1, 2, 1}, Vector{0, 0, 0}, Vector{0, 0, 10}}) {
    expect_frame(principal_axes(body_with(inertia, R, R)), R);
  }
}

TEST(PrincipalAxes, are_the_nearest_of_all_frames_along_them) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-3, 3);
  for (int n = 0; n < 200; ++n) {
    const Matrix3 Q = rotation_313(angle(random), angle(random), angle(random));
    const Matrix3 R = rotation_313(angle(random), angle(random), angle(random));
    const Matrix3 P = principal_axes(body_with({3, 1.4, 2}, Q, R));
    const Matrix3 inertia = transpose(P) * body_with({3, 1.4, 2}, Q, R).J_BC * P;
    EXPECT_NEAR(inertia(0, 1), 0, 1e-14);
    EXPECT_NEAR(inertia(0, 2), 0, 1e-14);
    EXPECT_NEAR(inertia(1, 2), 0, 1e-14);
    double best = -1;
    for (const Matrix3& other : namings(Q)) best = std::max(best, nearness(other, R));
    EXPECT_NEAR(nearness(P, R), best, 1e-12);
    EXPECT_NEAR(dot(cross(P.x, P.y), P.z), 1, 1e-14);
  }
}

TEST(PrincipalAxes, of_two_equal_inertias_turn_least_about_the_axis_of_symmetry) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-3, 3);
  for (int n = 0; n < 50; ++n) {
    for (const double along : {0.4, 1.7}) {  // a rod and a disk
      const Matrix3 Q = rotation_313(angle(random), angle(random), angle(random));
      const Matrix3 R = rotation_313(angle(random), angle(random), angle(random));
      const Matrix3 P = principal_axes(body_with({1, 1, along}, Q, R));
      const Matrix3 inertia = transpose(P) * body_with({1, 1, along}, Q, R).J_BC * P;
      EXPECT_NEAR(inertia(0, 1), 0, 1e-14);
      EXPECT_NEAR(inertia(0, 2), 0, 1e-14);
      EXPECT_NEAR(inertia(1, 2), 0, 1e-14);
      // No frame with the axis of symmetry among its axes, turned about it by any angle, is nearer.
      double best = -1;
      for (int k = 0; k < 360; ++k) {
        const Matrix3 turned = Q * rotation_313(0.25 * k * degree, 0, 0);
        for (const Matrix3& other : namings(turned)) best = std::max(best, nearness(other, R));
      }
      EXPECT_GE(nearness(P, R), best - 1e-12);
      EXPECT_LE(nearness(P, R), best + 1e-4);  // the search steps by a quarter of a degree
    }
  }
}

TEST(PrincipalAxes, of_a_symmetric_body_by_hand) {
  // The axis of symmetry leans from z towards y by 30 degrees: the least turn is about x alone.
  const Matrix3 Q = rotation_313(0.9, 0, 0);
  const Matrix3 lean = rotation_313(0, -30 * degree, 0);
  expect_frame(principal_axes(body_with({2, 2, 1}, lean * Q, Matrix3::identity())), lean);
}

TEST(PrincipalAxes, halfway_between_two_namings_x_has_the_smaller_inertia) {
  // About z by 45 degrees: x may become either line; both turns are as large.
  const Matrix3 Q = rotation_313(45 * degree, 0, 0);
  expect_frame(principal_axes(body_with({1, 2, 3}, Q, Matrix3::identity())), Q);
  expect_frame(principal_axes(body_with({2, 1, 3}, Q, Matrix3::identity())), rotation_313(-45 * degree, 0, 0));
  // A line of symmetry halfway between x and y becomes x.
  const Matrix3 P = principal_axes(body_with({1, 2, 2}, Q, Matrix3::identity()));
  expect_frame(P, Q);
}

TEST(PrincipalAxes, equality_is_judged_against_the_largest_inertia) {
  const Matrix3 Q = rotation_313(0.4, 0.6, -0.2);
  expect_frame(principal_axes(body_with({1000, 1000 + 1e-8, 1000 - 1e-8}, Q, Matrix3::identity())),
               Matrix3::identity());
  expect_frame(principal_axes(body_with({1000, 1001, 1002}, Q, Matrix3::identity())), Q, 1e-9);
}

TEST(PrincipalAxes, angles_are_singular_where_z_is_vertical) {
  EXPECT_TRUE(euler_singular({0, 0, 1}));
  EXPECT_TRUE(euler_singular({0, 0, -1}));
  EXPECT_TRUE(euler_singular({0, 0.9e-3, -1}));
  EXPECT_FALSE(euler_singular({1.1e-3, 0, 1}));
  EXPECT_FALSE(euler_singular({0, 1, 0}));
}

}  // namespace
}  // namespace dynalin::original_states_test
