// Static equilibria of generated mechanisms, checked by the oracle's own equations: at the point found nothing
// accelerates and no state changes. What has no equilibrium that is found says why.
#include "analysis/statics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "elements/catalogue.h"
#include "oracle/resting.h"
#include "places/draws.h"

namespace dynalin::oracle::statics_test {
namespace {

class Statics : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Statics, generated_mechanisms_come_to_rest_or_say_why_not) {
  const auto seeds = drawn_seeds(GetParam(), std::min<std::uint64_t>(GetParam() + 29, 100));
  int found = 0, refused = 0;
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Mechanism mechanism = random_resting_mechanism(seed);
    const std::string text = dataset_text(mechanism);
    auto dataset = parse_dataset(std::make_shared<const SourceText>("generated.adm", text));
    auto built = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
    ASSERT_FALSE(built.diagnostics.has_errors()) << render(built.diagnostics);
    const auto made = System::make(std::move(built.value)).value();
    const System& system = *made;
    Findings findings;
    StaticsReport report;
    StaticsOptions options;
    if (!all_are_drawn()) options.effort_limit *= 0.1;  // these are small, and what is not found by then rarely is
    const auto op = find_equilibrium(system, system.drawn(), options, report, findings);
    if (!op) {
      ++refused;
      EXPECT_FALSE(op.error().message.empty());
      std::cout << "seed " << seed << ": " << op.error().message << '\n';
      continue;
    }
    ++found;
    // Total angles beyond half a turn are not the oracle's principal ones.
    bool turned = false;
    for (const double angle : op->memory) turned = turned || std::abs(angle) > 3.1;
    // Nor does it know splines beyond their points, where the search may have led.
    if (turned || !mechanism.splines.empty()) continue;
    hold_motions(mechanism);
    const Layout& layout = system.layout();
    Model model(mechanism);
    model.clock = 0;
    for (const ExtraBlock& e : layout.extras) {
      for (std::size_t k = 0; k < mechanism.contacts.size(); ++k) {
        const bool two = mechanism.contacts[k].two_curves;
        if (mechanism.contacts[k].id != e.label.id || two != (e.label.statement == "CVCV")) continue;
        const double* parameter = &op->extra[layout.extra_index(e.offset)];
        model.look_for_contact_at(k, two ? parameter[0] : 0, parameter[two ? 1 : 0]);
      }
    }
    for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
      const BodyRef ref{
          layout.bodies[b].kind == ::dynalin::BodyKind::point_mass ? BodyKind::point_mass : BodyKind::part,
          static_cast<int>(layout.bodies[b].label.id)};
      BodyMotion& m = model.motion[static_cast<std::size_t>(model.body_index(ref))];
      const Pose& pose = op->poses[b];
      m.p = {pose.r.x, pose.r.y, pose.r.z};
      for (std::size_t c = 0; c < 3; ++c) m.R.column[c] = {pose.R[c].x, pose.R[c].y, pose.R[c].z};
      m.v = m.w = Vec{};
    }
    for (std::size_t k = 0; k < layout.states.size(); ++k) {
      const DifferentialState& z = layout.states[k];
      for (std::size_t s = 0; s < model.slots.size(); ++s) {
        const DifferentialSlot& slot = model.slots[s];
        if (static_cast<int>(slot.element) == static_cast<int>(z.type) && slot.element_id == z.owner->id &&
            slot.index == z.coordinate) {
          model.z[s] = op->state[k];
        }
      }
    }
    model.update_positions();
    model.update_velocities();
    // Screws, gears and couplers count turns, which the memory holds as such; the oracle's angles are principal ones.
    const std::vector<double> first = system.drawn().memory;
    for (std::size_t k = 0; k < first.size(); ++k) turned = turned || std::abs(op->memory[k] - first[k]) > 0.9;
    bool counted = false;
    for (const Row& row : model.rows) {
      const double off = std::abs(static_cast<double>(model.row_position(row)));
      const bool relation = row.type == Row::Type::expression && row.motion < 0;
      counted = counted || (relation && turned && off > 0.1);
      if (!counted) {
        EXPECT_LE(off, 1e-10 * static_cast<double>(model.length));
      }
    }
    if (counted) continue;
    try {
      model.unpack_algebra(solve_algebra(model));
    } catch (const std::runtime_error&) {
      continue;  // the oracle's own search begins at zero and may miss a solution of an algebraic loop
    }
    for (const BodyMotion& m : model.motion) {
      EXPECT_LT(norm(m.a), 1e-6 * model.length) << text;
      EXPECT_LT(norm(m.al), 1e-6) << text;
    }
    for (const Real rate : model.differential_rates()) EXPECT_NEAR(static_cast<double>(rate), 0, 1e-7);
  }
  std::cout << found << " equilibria, " << refused << " refused\n";
  EXPECT_GE(found, 0.8 * static_cast<double>(seeds.size()));
}
INSTANTIATE_TEST_SUITE_P(generated, Statics, ::testing::Range<std::uint64_t>(1, 101, 30));

}  // namespace
}  // namespace dynalin::oracle::statics_test
