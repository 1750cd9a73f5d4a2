// What reduce writes is what a FLEX_BODY takes, and what it does not take is refused with the cause.
#include "reduction/body_check.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "flexible/modal_body.h"
#include "reduction/body_file_writer.h"
#include "reduction/inertia_invariants.h"
#include "reduction/test_models.h"

namespace dynalin::reduction::body_check_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Without the rows of node 1, as programs write matrices of what is clamped there.
FiniteElementModel clamped(FiniteElementModel model) {
  const Eigen::Index left = model.mass.rows() - 6;
  model.stiffness = SparseMatrix(model.stiffness.bottomRightCorner(left, left));
  model.mass = SparseMatrix(model.mass.bottomRightCorner(left, left));
  model.freedoms.erase(model.freedoms.begin(), model.freedoms.begin() + 6);
  return model;
}

FiniteElementModel lumped(FiniteElementModel model, double inertia) {
  model.mass.setZero();
  for (std::size_t k = 0; k < model.freedoms.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    model.mass.coeffRef(row, row) = model.freedoms[k].direction > 3 ? inertia : 0.9;
  }
  return model;
}

struct Checked {
  bool taken = false, read = false;
  std::string said;
  Reduction reduction;
};

// By the check, and by reading what is written.
Checked check(const FiniteElementModel& model, std::vector<NodeLabel> interface, Eigen::Index modes,
              const UnitFactors& factors = {}) {
  Checked result;
  Diagnostics diagnostics;
  ReductionRequest request;
  request.interface = interface, request.modes = modes;
  auto reduction = reduce_model(model, request, diagnostics);
  if (!reduction) {
    ADD_FAILURE() << reduction.error() << render(diagnostics);
    return result;
  }
  if (std::ranges::count(interface, 1) == 0) interface.push_back(1);
  const BodyFile body = in_other_units(
      body_of(model, *reduction, interface, InertiaOrder::follows_deformation, "made in a test"), factors);
  result.taken = check_body(body, *reduction, "body.fem", diagnostics);
  result.said = render(diagnostics);
  std::ostringstream out;
  write_body_file(out, body);
  const SourceText text("body.fem", out.str());
  Diagnostics found;
  auto records = read_modal_text(text, found);
  result.read = records && modal_body_of(std::move(*records), text, found);
  result.reduction = std::move(*reduction);
  return result;
}

// Motions of the whole are nearly in the modes of a clamped beam, and its consistent mass has lost more along the beam
// than across it.
TEST(BodyCheck, refuses_a_clamped_beam_whose_mass_differs_by_direction) {
  const FiniteElementModel beam = clamped(test::beam(4, 1));
  for (const Eigen::Index modes : {0, 2, 5, 10, 18}) {
    const Checked c = check(beam, {5}, modes);
    EXPECT_EQ(c.taken, c.read) << modes;
    EXPECT_EQ(c.taken, modes == 0) << modes << c.said;
  }
  const std::string said = check(beam, {5}, 18).said;
  EXPECT_THAT(said, HasSubstr("no FLEX_BODY would take the reduced body: the inertia in body.fem is not positive"));
  EXPECT_THAT(said, HasSubstr("the mass in the matrices differs between x, y and z by"));
  EXPECT_THAT(said, HasSubstr("hold the body against 6 of its 6 motions as a whole"));
  EXPECT_THAT(said, HasSubstr("leave freedoms that were held in the matrices and hold the body there by a JOINT"));
}

TEST(BodyCheck, is_the_same_in_other_units) {
  const FiniteElementModel beam = clamped(test::beam(4, 1));
  for (const UnitFactors& factors : {UnitFactors{1000, 1, 1}, UnitFactors{1000, 1e-3, 1}, UnitFactors{1e-3, 10, 1e6}}) {
    const Checked c = check(beam, {5}, 5, factors);
    EXPECT_FALSE(c.taken);
    EXPECT_FALSE(c.read);
    EXPECT_TRUE(check(test::beam(4, 1), {1, 5}, 5, factors).taken);
  }
}

// Of masses alike in all directions only a body whose modes have motions of the whole to the last digit is refused.
TEST(BodyCheck, takes_a_clamped_body_of_even_mass_in_few_modes) {
  const FiniteElementModel beam = clamped(lumped(test::beam(4, 1), 1e-3));
  for (const Eigen::Index modes : {0, 2, 5, 18}) {
    const Checked c = check(beam, {5}, modes);
    EXPECT_EQ(c.taken, c.read) << modes;
    EXPECT_EQ(c.taken, modes < 18) << modes << c.said;
  }
  const std::string said = check(beam, {5}, 18).said;
  EXPECT_THAT(said, HasSubstr("rigid-body motion"));
  EXPECT_THAT(said, Not(HasSubstr("differs between")));
}

TEST(BodyCheck, takes_lumped_masses_without_inertia) {
  for (const double inertia : {0.0, 1e-3}) {
    for (const Eigen::Index modes : {0, 4, 100}) {
      const Checked c = check(lumped(test::beam(4, 1), inertia), {1, 5}, modes);
      EXPECT_TRUE(c.taken && c.read) << inertia << " " << modes << c.said;
    }
    const Checked c = check(clamped(lumped(test::beam(4, 1), inertia)), {5}, 3);
    EXPECT_EQ(c.taken, c.read) << c.said;
  }
}

TEST(BodyCheck, refuses_springs_to_ground_that_hold_the_body_in_its_modes) {
  FiniteElementModel beam = test::beam(4, 1);
  beam.stiffness.coeffRef(0, 0) += 1e5;
  const Checked c = check(beam, {1, 5}, 100);
  EXPECT_FALSE(c.taken);
  EXPECT_FALSE(c.read);
  EXPECT_EQ(c.reduction.rigid_removed, 5);
  EXPECT_THAT(c.said, HasSubstr("hold the body against 1 of its 6 motions as a whole"));
  EXPECT_THAT(c.said, HasSubstr("leave springs to ground to BUSHINGs"));
}

}  // namespace
}  // namespace dynalin::reduction::body_check_test
