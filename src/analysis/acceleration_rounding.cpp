#include "analysis/acceleration_rounding.h"

#include <algorithm>
#include <limits>

#include "analysis/displace.h"

namespace dynalin {

namespace {

constexpr int samples = 3;
// In units of the last place: far enough that what comes of it is no rounding itself.
constexpr double units = 64;
// A sample is seldom the worst case.
constexpr double margin = 8;

}  // namespace

Shake shake(const Layout& layout, const OperatingPoint& op, double places, std::minstd_rand& random) {
  const double amplitude = places * std::numeric_limits<double>::epsilon();
  const auto draw = [&] { return amplitude * std::uniform_real_distribution<double>(-1, 1)(random); };
  const auto size_of = [](const Vector& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  Shake s{Eigen::VectorXd::Zero(layout.coordinate_count), Eigen::VectorXd::Zero(layout.coordinate_count)};
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    for (std::int32_t k = 0; k < block.count; ++k) {
      const auto first = static_cast<std::size_t>(block.offset + k - k % 3);
      s.step(block.offset + k) = draw() * (k < 3 ? size_of(op.poses[b].r) : 1.0);
      s.velocity(block.offset + k) =
          draw() * size_of({op.velocity[first], op.velocity[first + 1], op.velocity[first + 2]});
    }
  }
  for (std::size_t k = 0; k < op.extra.size(); ++k) {
    const auto at = layout.body_coordinate_count + static_cast<Eigen::Index>(k);
    s.step(at) = draw() * std::max(1.0, std::abs(op.extra[k]));
    s.velocity(at) = draw() * std::abs(op.velocity[static_cast<std::size_t>(at)]);
  }
  return s;
}

OperatingPoint shaken(const System& system, OperatingPoint op, const Shake& s, double direction) {
  displace(system, op, direction * s.step, {1.0});
  for (std::size_t k = 0; k < op.velocity.size(); ++k) {
    op.velocity[k] += direction * s.velocity(static_cast<Eigen::Index>(k));
  }
  return op;
}

Eigen::VectorXd rounding_of_accelerations(const System& system, const SparseLu& lu, const OperatingPoint& op,
                                          const MissingForces& missing) {
  const Layout& layout = system.layout();
  const Eigen::VectorXd here = missing(op);
  Eigen::MatrixXd answers(here.size(), 2 * samples);  // both ways, side by side
  std::minstd_rand random(1);
  for (int sample = 0; sample < samples; ++sample) {
    const Shake s = shake(layout, op, units, random);
    for (const int way : {0, 1}) {
      auto answer = answers.col(2 * sample + way);
      answer = missing(shaken(system, op, s, way == 0 ? 1 : -1)) - here;
      if (!answer.allFinite()) answer.setZero();
    }
  }
  lu.solve(answers);
  Eigen::VectorXd worst = Eigen::VectorXd::Zero(here.size());
  for (int sample = 0; sample < samples; ++sample) {
    worst = worst.cwiseMax(answers.col(2 * sample).cwiseAbs().cwiseMin(answers.col(2 * sample + 1).cwiseAbs()));
  }
  for (const BodyBlock& block : layout.bodies) {
    for (std::int32_t k = 0; k < block.count; k += 3) {
      worst.segment<3>(block.offset + k).setConstant(worst.segment<3>(block.offset + k).maxCoeff());
    }
  }
  return margin / units * worst;
}

Eigen::VectorXd missing_beside(const System& system, const OperatingPoint& op, const MissingForces& missing) {
  std::minstd_rand random(1);
  return missing(shaken(system, op, shake(system.layout(), op, units, random), 1));
}

double rounding_of_answer() { return margin / units; }

Eigen::VectorXd rounding_of_solution(const SparseLu& lu, const Eigen::VectorXd& terms) {
  Eigen::MatrixXd answers(terms.size(), samples);
  std::minstd_rand random(1);
  for (Eigen::Index k = 0; k < answers.size(); ++k) {
    answers(k) = terms(k % terms.size()) * std::uniform_real_distribution<double>(-1, 1)(random);
  }
  lu.solve(answers);
  return margin * std::numeric_limits<double>::epsilon() * answers.cwiseAbs().rowwise().maxCoeff();
}

}  // namespace dynalin
