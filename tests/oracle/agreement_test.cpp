// The program's state matrices against the nonlinear oracle: generated mechanisms in space with loops, preload,
// massless links, motions, forces that read reactions and accelerations, and control states, at points where the
// angular velocity is not parallel to the angular acceleration.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "elements/catalogue.h"
#include "expression/functions.h"
#include "expression/vector_functions.h"
#include "linear/linear_system.h"
#include "model/routine_options.h"
#include "oracle/generator.h"
#include "oracle/model.h"
#include "oracle/program_point.h"
#include "places/draws.h"

namespace dynalin::oracle::agreement_test {
namespace {

// Largest difference of an entry beyond what the extrapolation leaves open, relative to the largest entry.
void expect_agreement(const Eigen::MatrixXd& ours, const Matrix& theirs, const Matrix& error, const char* name) {
  ASSERT_EQ(static_cast<std::size_t>(ours.rows()), theirs.size()) << name;
  double scale = 1;
  for (const auto& row : theirs) {
    for (const double v : row) scale = std::max(scale, std::abs(v));
  }
  for (std::size_t r = 0; r < theirs.size(); ++r) {
    ASSERT_EQ(static_cast<std::size_t>(ours.cols()), theirs[r].size()) << name;
    for (std::size_t c = 0; c < theirs[r].size(); ++c) {
      const double v = ours(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
      EXPECT_NEAR(v, theirs[r][c], 1e-9 * scale + 10 * error[r][c]) << name << "(" << r + 1 << "," << c + 1 << ")";
    }
  }
}

// Bristles of frictions at rest where the dataset starts: here undeformed, elastic or yielding, either way.
void deform_bristles(const Mechanism& mechanism, const System& system, OperatingPoint& op, std::uint64_t seed) {
  const std::vector<DifferentialState>& states = system.layout().states;
  for (std::size_t k = 0; k < states.size(); ++k) {
    for (const Friction& f : mechanism.frictions) {
      if (states[k].owner->statement != "FRICTION" || states[k].owner->id != f.id) continue;
      const auto directions =
          static_cast<double>(surface_directions(mechanism.joints[static_cast<std::size_t>(f.joint - 1)].type));
      constexpr std::array<double, 4> shares = {0, 0.5, 0.95, -0.93};
      op.state[k] = shares[(seed + static_cast<std::uint64_t>(f.id)) % 4] * f.deformation / std::sqrt(directions);
    }
  }
}

void compare(std::uint64_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Mechanism mechanism = random_mechanism(seed);
  const std::string text = dataset_text(mechanism);
  auto dataset = parse_dataset(std::make_shared<const SourceText>("generated.adm", text));
  ASSERT_FALSE(dataset.diagnostics.has_errors()) << render(dataset.diagnostics) << text;
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue(), {},
                           {.libraries = {GENERATED_ROUTINES}});
  ASSERT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
  const auto made = System::make(std::move(model.value)).value();
  const System& system = *made;
  Findings findings;
  auto op = initial_conditions(system, findings);
  ASSERT_TRUE(op) << op.error().message << "\n" << text;
  deform_bristles(mechanism, system, *op, seed);
  put_beams(mechanism, system, *op);
  op = solve_acceleration(system, *std::move(op), findings);
  ASSERT_TRUE(op) << op.error().message << "\n" << text;

  LinearOptions options;
  options.pinput = system.model().find("PINPUT", 1);
  if (mechanism.pstate.id != 0) options.pstate = system.model().find("PSTATE", 1);
  options.poutput = system.model().find("POUTPUT", 1);
  auto linear = linearize(system, *op, options);
  ASSERT_TRUE(linear) << linear.error().message;
  const auto differences = [&] {
    std::vector<ChosenState> states;
    for (const StateLabel& label : linear->model.states) states.push_back(chosen(label, mechanism));
    return oracle_linearize(mechanism, point_of(system, *op), states);
  };
  std::optional<OracleLinearModel> found;
  try {
    found = differences();
  } catch (const std::runtime_error&) {
    ASSERT_TRUE(options.pstate) << text;
  }
  // A user's coordinate that hardly moves blunts all differences by it: then those by the default ones are taken.
  if (options.pstate && (!found || found->error_estimate > 1e-9)) {
    options.pstate.reset();
    linear = linearize(system, *op, options);
    ASSERT_TRUE(linear) << linear.error().message;
    found = differences();
  }
  const OracleLinearModel& oracle = *found;
  // Differences that are not sharp themselves prove nothing.
  EXPECT_LE(oracle.error_estimate, 1e-9);
  expect_agreement(linear->model.A, oracle.A, oracle.A_error, "A");
  expect_agreement(linear->model.B, oracle.B, oracle.B_error, "B");
  expect_agreement(linear->model.C, oracle.C, oracle.C_error, "C");
  expect_agreement(linear->model.D, oracle.D, oracle.D_error, "D");
  ASSERT_FALSE(::testing::Test::HasFailure()) << text;
}

// Of those that each take long an ordinary run looks at one of two.
struct TwoSeeds {
  std::uint64_t always, with_all;
};
void PrintTo(const TwoSeeds& seeds, std::ostream* out) { *out << seeds.always; }

void compare(const TwoSeeds& seeds) {
  if (all_are_drawn()) {
    ASSERT_NO_FATAL_FAILURE(compare(seeds.with_all));
  }
  compare(seeds.always);
}

class Agreement : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Agreement, state_matrices_equal_differences_of_the_nonlinear_model) {
  for (const std::uint64_t seed : drawn_seeds(GetParam(), GetParam() + 29)) ASSERT_NO_FATAL_FAILURE(compare(seed));
}
INSTANTIATE_TEST_SUITE_P(generated, Agreement, ::testing::Range<std::uint64_t>(1, 241, 30));

// Of elements between two or three nodes, far bent, stretched and twisted, in motion and under loads along them.
class BeamAgreement : public ::testing::TestWithParam<TwoSeeds> {};

TEST_P(BeamAgreement, state_matrices_equal_differences_of_the_nonlinear_model) { compare(GetParam()); }
INSTANTIATE_TEST_SUITE_P(generated, BeamAgreement,
                         ::testing::Values(TwoSeeds{243, 241}, TwoSeeds{244, 242}, TwoSeeds{246, 245}));

// Of beams in each of the planes, far bent and stretched, that carry a part which nothing else holds.
class PlaneBeamAgreement : public ::testing::TestWithParam<TwoSeeds> {};

TEST_P(PlaneBeamAgreement, state_matrices_equal_differences_of_the_nonlinear_model) { compare(GetParam()); }
INSTANTIATE_TEST_SUITE_P(generated, PlaneBeamAgreement,
                         ::testing::Values(TwoSeeds{282, 281}, TwoSeeds{284, 283}, TwoSeeds{286, 285}));

// With state equations of compiled routines.
class GseAgreement : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(GseAgreement, state_matrices_equal_differences_of_the_nonlinear_model) { compare(GetParam()); }
INSTANTIATE_TEST_SUITE_P(generated, GseAgreement, ::testing::Range<std::uint64_t>(261, 267));

// Of bodies of modes, deformed and in motion, under modal loads.
class FlexibleAgreement : public ::testing::TestWithParam<TwoSeeds> {};

TEST_P(FlexibleAgreement, state_matrices_equal_differences_of_the_nonlinear_model) { compare(GetParam()); }
INSTANTIATE_TEST_SUITE_P(generated, FlexibleAgreement,
                         ::testing::Values(TwoSeeds{272, 271}, TwoSeeds{274, 273}, TwoSeeds{276, 275}));

// Of such bodies that turn about as fast as they vibrate.
class SpinningAgreement : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SpinningAgreement, state_matrices_equal_differences_of_the_nonlinear_model) { compare(GetParam()); }
INSTANTIATE_TEST_SUITE_P(generated, SpinningAgreement, ::testing::Range<std::uint64_t>(behind_friction, 360));

// Of each joint that may rub, in each regime of its friction and by LuGre's law.
class FrictionAgreement : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(FrictionAgreement, state_matrices_equal_differences_of_the_nonlinear_model) { compare(GetParam()); }
INSTANTIATE_TEST_SUITE_P(generated, FrictionAgreement,
                         ::testing::Range<std::uint64_t>(first_of_friction, behind_friction));

// Of bodies that run along curves with an axis.
class RiderAgreement : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(RiderAgreement, state_matrices_equal_differences_of_the_nonlinear_model) { compare(GetParam()); }
INSTANTIATE_TEST_SUITE_P(generated, RiderAgreement, ::testing::Range<std::uint64_t>(311, 321));

// Of shafts on films of oil.
class JournalAgreement : public ::testing::TestWithParam<TwoSeeds> {};

TEST_P(JournalAgreement, state_matrices_equal_differences_of_the_nonlinear_model) { compare(GetParam()); }
INSTANTIATE_TEST_SUITE_P(generated, JournalAgreement,
                         ::testing::Values(TwoSeeds{322, 321}, TwoSeeds{324, 323}, TwoSeeds{326, 325}));

// Of solids that press on each other, four pairs in each: the list is in generator_solids.cpp.
class SolidAgreement : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SolidAgreement, state_matrices_equal_differences_of_the_nonlinear_model) { compare(GetParam()); }
// In 292 a plane touches a curve in two places, and the program may take the other one than was drawn: 302 has the same
// pairs.
INSTANTIATE_TEST_SUITE_P(generated, SolidAgreement,
                         ::testing::Values(291, 302, 293, 294, 295, 296, 297, 298, 299, 300));

// A new element or function without a place in the generator fails here, and so does one that runs of the tests which
// take a part of the seeds would compare once or not at all.
TEST(Generated, mechanisms_hold_every_element_and_function_of_the_program) {
  std::vector<std::uint64_t> seeds = drawn_seeds(1, 240);
  seeds.insert(seeds.end(), {243, 244, 246, 261, 262, 272, 274, 311, 312, 322, 324});
  std::vector<std::string> texts;
  for (const std::uint64_t seed : seeds) texts.push_back(dataset_text(random_mechanism(seed)));
  const auto holding = [&](const std::string& word) {
    return std::ranges::count_if(texts, [&](const std::string& text) { return text.find(word) != std::string::npos; });
  };
  const auto holds = [&](const std::string& word) { return holding(word) > 0; };
  for (const Kind* kind : catalogue()) {
    if (is_beside_model(*kind)) continue;
    EXPECT_GE(holding("\n" + std::string(kind->statement) + "/"), 2) << kind->statement;
    if (!kind->variant.empty()) {
      EXPECT_GE(holding(", " + std::string(kind->variant)), 2) << kind->variant;
    }
  }
  for (const auto& family : {elementary_functions(), contact_functions(), series_functions()}) {
    for (const ::dynalin::Function& f : family) EXPECT_TRUE(holds(std::string(f.name) + "(")) << f.name;
  }
  for (const AtomFunction& f : atom_functions()) {
    if (!f.built || f.maximum_arguments == 0 || f.name.find('.') != std::string_view::npos) continue;
    EXPECT_TRUE(holds(std::string(f.name) + "(")) << f.name;
  }
  for (const SpecialFunction& f : special_functions()) EXPECT_TRUE(holds(std::string(f.name) + "(")) << f.name;
  for (const VectorAtom& f : vector_atoms()) EXPECT_TRUE(holds(std::string(f.name) + "(")) << f.name;
}

}  // namespace
}  // namespace dynalin::oracle::agreement_test
