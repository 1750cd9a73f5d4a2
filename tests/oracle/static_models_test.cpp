// Statics on the models of users' kinds: each comes to rest, which the oracle's own forces confirm, or the refusal
// proves that it cannot.
#include "oracle/static_models.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "analysis/statics.h"
#include "elements/catalogue.h"
#include "model.h"

namespace dynalin::oracle::static_models_test {
namespace {

using ::testing::HasSubstr;

// What is left of the forces on all parts, moments by the length of the model, when reactions have taken what they can:
// the part of gravity and of the force elements that is orthogonal to all constraint gradients.
struct Balance {
  double unbalanced = 0, largest = 0;  // and the largest of the terms that forces are made of
  double apart = 0;                    // of constraints
  double rate = 0;                     // of differential states
};

std::vector<Real> loads(Model& model, const std::vector<Real>& values) {
  std::vector<Real> x(model.algebra_size(), 0);
  std::copy(values.begin(), values.end(), x.begin() + model.dofs);
  model.unpack_algebra(x);
  return model.algebra_residual();
}

Balance balance_at(Model& model) {
  Balance b;
  model.update_positions();
  model.update_velocities();
  for (const Row& row : model.rows) {
    Real off = model.row_position(row);
    // The oracle's angles are principal ones, and a screw counts turns.
    if (row.joint >= 0 && row.type == Row::Type::expression)
      off = std::remainder(off, static_cast<Real>(model.mechanism().joints[static_cast<std::size_t>(row.joint)].size));
    b.apart = std::max(b.apart, static_cast<double>(std::fabs(off) / model.length));
  }
  model.active.clear();
  // VARIABLEs and forces: each iteration carries values one reference further, and loops contract.
  std::vector<Real> values(model.algebra_size() - static_cast<std::size_t>(model.dofs), 0);
  std::vector<Real> r;
  for (int pass = 0; pass < 200; ++pass) {
    r = loads(model, values);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] -= r[static_cast<std::size_t>(model.dofs) + k];
  }
  r = loads(model, values);
  for (const Real rate : model.differential_rates()) b.rate = std::max(b.rate, static_cast<double>(std::fabs(rate)));

  std::vector<Real> force(static_cast<std::size_t>(model.dofs));
  std::vector<Real> unit(force.size(), 1);  // moments by the length
  for (std::size_t body = 1; body < model.bodies.size(); ++body) {
    for (int c = 3; c < model.bodies[body].dof; ++c)
      unit[static_cast<std::size_t>(model.bodies[body].offset + c)] = 1 / model.length;
  }
  for (std::size_t k = 0; k < force.size(); ++k) force[k] = r[k] * unit[k];
  for (const auto& body : model.bodies)
    b.largest = std::max(b.largest, static_cast<double>(body.mass * norm(to_vec(model.mechanism().gravity))));
  for (const ForceLoad& load : model.force_loads())
    b.largest = std::max(
        {b.largest, static_cast<double>(norm(load.on_i.f)), static_cast<double>(norm(load.on_i.t) / model.length)});
  // Stiff laws are differences of large terms.
  const auto length = static_cast<double>(model.length);
  for (const LinearForce& f : model.mechanism().linears) {
    b.largest = std::max(b.largest, f.beam[1] * f.beam[5]);
    for (std::size_t c = 0; c < 3; ++c) b.largest = std::max(b.largest, f.k[c][c] * length);
  }
  for (const SpringDamper& f : model.mechanism().springs) b.largest = std::max(b.largest, f.k * length);
  const Dense G = model.gradient();
  std::vector<std::vector<Real>> basis;
  const auto less = [&](std::vector<Real>& v) {
    for (int pass = 0; pass < 2; ++pass) {
      for (const auto& q : basis) {
        Real along = 0;
        for (std::size_t k = 0; k < v.size(); ++k) along += q[k] * v[k];
        for (std::size_t k = 0; k < v.size(); ++k) v[k] -= along * q[k];
      }
    }
  };
  const auto size = [](const std::vector<Real>& v) {
    Real sum = 0;
    for (const Real x : v) sum += x * x;
    return std::sqrt(sum);
  };
  for (std::size_t row = 0; row < G.rows(); ++row) {
    std::vector<Real> q(force.size());
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = G(row, k) * unit[k];
    const Real before = size(q);
    less(q);
    const Real left = size(q);
    if (!(left > 1e-9L * before)) continue;
    for (Real& x : q) x /= left;
    basis.push_back(std::move(q));
  }
  less(force);
  b.unbalanced = static_cast<double>(size(force));
  return b;
}

void take_over(Model& model, const System& system, const OperatingPoint& op) {
  const Layout& layout = system.layout();
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    const bool point = layout.bodies[b].kind == ::dynalin::BodyKind::point_mass;
    const BodyRef ref{point ? BodyKind::point_mass : BodyKind::part, static_cast<int>(layout.bodies[b].label.id)};
    BodyMotion& m = model.motion[static_cast<std::size_t>(model.body_index(ref))];
    const Pose& pose = op.poses[b];
    m.p = {pose.r.x, pose.r.y, pose.r.z};
    for (std::size_t c = 0; c < 3; ++c) m.R.column[c] = {pose.R[c].x, pose.R[c].y, pose.R[c].z};
    m.v = m.w = Vec{};
  }
  for (std::size_t k = 0; k < layout.states.size(); ++k) {
    for (std::size_t s = 0; s < model.slots.size(); ++s) {
      if (model.slots[s].element_id == layout.states[k].owner->id) model.z[s] = op.state[k];
    }
  }
}

std::shared_ptr<const System> system_of(const Mechanism& mechanism) {
  auto dataset = parse_dataset(std::make_shared<const SourceText>("generated.adm", dataset_text(mechanism)));
  auto built = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  if (built.diagnostics.has_errors()) {
    ADD_FAILURE() << render(built.diagnostics);
    return nullptr;
  }
  return System::make(std::move(built.value)).value();
}

class StaticModels : public ::testing::TestWithParam<std::size_t> {};

TEST_P(StaticModels, come_to_rest_or_say_what_makes_rest_impossible) {
  const StaticModel described = static_models()[GetParam()];
  SCOPED_TRACE(described.name);
  const auto system = system_of(described.mechanism);
  ASSERT_TRUE(system);
  Findings findings;
  StaticsReport report;
  const auto op = find_equilibrium(*system, system->drawn(), {}, report, findings);
  // The longest way to a rest takes 232; where there is none the search goes on to its limits.
  if (described.proof.empty()) {
    EXPECT_LE(report.iterations, 300);
  }
  if (!described.proof.empty()) {
    ASSERT_FALSE(op);
    for (const std::string& part : described.proof) EXPECT_THAT(op.error().message, HasSubstr(part));
    return;
  }
  ASSERT_TRUE(op) << op.error().message;
  // The oracle's angles are principal ones.
  if (std::any_of(op->memory.begin(), op->memory.end(), [](double angle) { return std::abs(angle) > 3.1; })) return;
  Model model(described.mechanism);
  take_over(model, *system, *op);
  const Balance b = balance_at(model);
  EXPECT_LE(b.apart, 1e-12);
  EXPECT_LE(b.unbalanced, 1e-9 * b.largest);
  EXPECT_LE(b.rate, 1e-9);
}
INSTANTIATE_TEST_SUITE_P(generated, StaticModels, ::testing::Range<std::size_t>(0, static_models().size()));

}  // namespace
}  // namespace dynalin::oracle::static_models_test
