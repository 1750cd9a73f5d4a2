#include "flexible/modal_body.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <random>

namespace dynalin::modal_body_test {

namespace {

constexpr std::size_t nodes = 5, modes = 2;

struct MassPoint {
  double mass;
  Vector at;
  std::array<Vector, modes> moves;
};

std::vector<MassPoint> mass_points() {
  std::minstd_rand bits(7);
  const auto draw = [&] { return std::uniform_real_distribution<double>(-1, 1)(bits); };
  std::vector<MassPoint> points(nodes);
  for (MassPoint& p : points) {
    p.mass = 2 + draw(), p.at = {draw(), draw(), draw()};
    for (Vector& u : p.moves) u = {draw(), draw(), draw()};
  }
  return points;
}

std::string row(const std::vector<double>& numbers) {
  std::string line;
  for (const double x : numbers) line += fmt::format("{:.17g} ", x);
  return line + "\n";
}

std::string record(int number, const std::vector<double>& numbers) {
  return fmt::format("**\n** RECORD GROUP {}\n", number) + row(numbers);
}

// Records 1 to 10; of rejected modes the file has shapes and nothing else.
std::string shapes_of(const std::vector<MassPoint>& points, std::size_t rejected = 0) {
  std::string text = fmt::format("** RECORD GROUP 1\n**\n REV0 {} {} 1 0 {}\n**\n** RECORD GROUP 2\n", nodes,
                                 modes + rejected - 1, rejected);
  for (std::size_t p = 1; p <= nodes; ++p) text += fmt::format(" {}\n", p);
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> places;
    for (const MassPoint& p : points) places.push_back(p.at[c]);
    text += record(static_cast<int>(5 + c), places);
  }
  text += "**\n** RECORD GROUP 8\n";
  for (std::size_t k = 0; k < rejected; ++k) {
    text += "** REJECTED\n";
    for (std::size_t p = 0; p < nodes; ++p) text += row({9, 8, 7, 6, 5, 4});
  }
  std::vector<double> mass;
  for (std::size_t k = 0; k < modes; ++k) {
    text += "** MODE\n";
    for (const MassPoint& p : points) text += row({p.moves[k].x, p.moves[k].y, p.moves[k].z, 0, 0, 0});
    for (std::size_t j = 0; j < modes; ++j) {
      mass.push_back(0);
      for (const MassPoint& p : points) mass.back() += p.mass * dot(p.moves[k], p.moves[j]);
    }
  }
  return text + record(9, mass) + record(10, {3, 0, 0, 5});
}

ModalBody body_of(const std::string& text) {
  const SourceText file("body.fem", text);
  Diagnostics said;
  auto records = read_modal_text(file, said);
  if (!records) throw std::runtime_error("not read");
  auto body = modal_body_of(std::move(*records), file, said);
  if (!body) throw std::runtime_error("no body");
  return *body;
}

}  // namespace

// Sums over mass points as the file states them (records 12 and 14 to 18, with the signs that the format has: −I8 and
// +I9) against those that the program makes of the same points (record 11).
TEST(ModalBody, of_stated_sums_is_that_of_the_mass_points) {
  const std::vector<MassPoint> points = mass_points();
  std::vector<double> lumped;
  double mass = 0;
  Vector first{};
  for (const MassPoint& p : points) {
    lumped.insert(lumped.end(), {p.mass, p.mass, p.mass, 0, 0, 0});
    mass += p.mass, first += p.mass * p.at;
  }
  const Vector centre = (1 / mass) * first;
  Matrix3 inertia;
  std::vector<double> I3(3 * modes), I4(3 * modes), I8(9 * modes), I5(3 * modes * modes), I9(9 * modes * modes);
  for (const MassPoint& p : points) {
    const Matrix3 d = skew(p.at - centre);
    inertia = inertia + p.mass * (transpose(d) * d);
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t j = 0; j < modes; ++j) {
        I3[r * modes + j] += p.mass * p.moves[j][r];
        I4[r * modes + j] += p.mass * cross(p.at, p.moves[j])[r];
        const Matrix3 sj = skew(p.at) * skew(p.moves[j]);
        for (std::size_t c = 0; c < 3; ++c) I8[3 * (r * modes + j) + c] -= p.mass * sj(r, c);
        for (std::size_t k = 0; k < modes; ++k) {
          I5[(r * modes + j) * modes + k] += p.mass * cross(p.moves[j], p.moves[k])[r];
          const Matrix3 jk = skew(p.moves[j]) * skew(p.moves[k]);
          for (std::size_t c = 0; c < 3; ++c) I9[3 * ((r * modes + j) * modes + k) + c] += p.mass * jk(r, c);
        }
      }
    }
  }
  std::vector<double> whole = {mass, centre.x, centre.y, centre.z};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) whole.push_back(inertia(r, c));
  }
  const std::string shapes = shapes_of(points);
  const ModalInertia of_points = body_of(shapes + record(11, lumped)).inertia;
  const ModalInertia stated = body_of(shapes + record(12, whole) + record(14, I3) + record(15, I4) + record(16, I8) +
                                      record(17, I5) + record(18, I9))
                                  .inertia;
  const Eigen::VectorXd q = Eigen::Vector2d(0.3, -0.7);
  EXPECT_LT((of_points.matrix(q) - stated.matrix(q)).cwiseAbs().maxCoeff(), 1e-13 * mass);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_LT((of_points.turning_by_mode[c] - stated.turning_by_mode[c]).cwiseAbs().maxCoeff(), 1e-13 * mass);
  // And both are what the points are, moved by q.
  Matrix3 moved;
  for (const MassPoint& p : points) {
    const Matrix3 x = skew(p.at + q(0) * p.moves[0] + q(1) * p.moves[1]);
    moved = moved + p.mass * (transpose(x) * x);
  }
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(stated.tensor_at(q)(r, c), moved(r, c), 1e-13 * mass);
  }
}

TEST(ModalBody, passes_over_rejected_modes) {
  const std::vector<MassPoint> points = mass_points();
  std::vector<double> lumped;
  for (const MassPoint& p : points) lumped.insert(lumped.end(), {p.mass, p.mass, p.mass, 0, 0, 0});
  const ModalBody whole = body_of(shapes_of(points) + record(11, lumped)),
                  without = body_of(shapes_of(points, 2) + record(11, lumped));
  EXPECT_EQ(without.modes(), static_cast<Eigen::Index>(modes));
  EXPECT_EQ(without.translation, whole.translation);
  EXPECT_EQ(without.rotation, whole.rotation);
}

}  // namespace dynalin::modal_body_test
