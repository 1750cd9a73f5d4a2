// Selected modes of generated mechanisms against all modes of their state matrices, at regions drawn at random:
// clusters, defective values and structural zeros included.
#include "selected_modes/selected_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "eigenvalues/eigen.h"
#include "elements/catalogue.h"
#include "oracle/oracle.h"
#include "places/draws.h"
#include "selected_modes/selection_of_modes.h"

namespace dynalin::oracle::selected_modes_test {
namespace {

std::string text_of(const ModeSelection& wanted) {
  if (const auto* nearest = std::get_if<NearestModes>(&wanted))
    return "the " + std::to_string(nearest->count) + " nearest to " + std::to_string(nearest->frequency);
  const auto& band = std::get<ModesInBand>(wanted);
  return "from " + std::to_string(band.low) + " to " + std::to_string(band.high);
}

// Of a mode that is no zero of the structure, whether its bound tells it from zero: if not, a pair is as good as two
// real values.
bool told_from_zero(const EigenMode& m) { return m.structural_zero || std::abs(m.eigenvalue_hz) > m.error_bound_hz; }

// Every mode found has one of its own among all that its bound and the other's reach.
void expect_same(const EigenSolution& found, const EigenSolution& expected) {
  ASSERT_TRUE(found.selected);
  // Where not even bounds of the full solution tell which modes these are, the selection must not say that it knows.
  EXPECT_TRUE(found.selected->complete || !expected.selected->complete) << found.selected->doubt;
  const bool all_told =
      std::ranges::all_of(found.modes, told_from_zero) && std::ranges::all_of(expected.modes, told_from_zero);
  if (all_told) {
    EXPECT_EQ(found.selected->found, expected.selected->found);
    EXPECT_EQ(found.selected->counted, expected.selected->counted);
  }
  // Where values are not told apart, pairs may be taken for two real ones.
  const bool sharp = all_told && std::ranges::all_of(found.modes, [](const EigenMode& m) {
                       return m.error_bound_hz <= 1e-3 * std::abs(m.eigenvalue_hz) || std::abs(m.eigenvalue_hz) < 1e-6;
                     });
  if (sharp) {
    ASSERT_EQ(found.modes.size(), expected.modes.size());
  }
  struct Value {
    std::complex<double> hz;
    double bound;
  };
  std::vector<Value> left;
  for (const EigenMode& e : expected.modes) {
    left.push_back({e.eigenvalue_hz, e.error_bound_hz});
    if (!e.is_real && !told_from_zero(e)) left.push_back({std::conj(e.eigenvalue_hz), e.error_bound_hz});
  }
  for (const EigenMode& m : found.modes) {
    if (left.empty()) break;
    const auto distance = [&](const Value& e) { return std::abs(e.hz - m.eigenvalue_hz) - e.bound - m.error_bound_hz; };
    const auto best = std::ranges::min_element(left, {}, distance);
    EXPECT_LE(distance(*best), 0) << m.eigenvalue_hz << " against " << best->hz;
    left.erase(best);
  }
}

class SelectedModesOfMechanisms : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SelectedModesOfMechanisms, are_those_of_the_full_solution) {
  int counted = 0, tried = 0, doubted = 0;
  for (const std::uint64_t seed : drawn_seeds(GetParam(), std::min<std::uint64_t>(GetParam() + 29, 220))) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto dataset =
        parse_dataset(std::make_shared<const SourceText>("generated.adm", dataset_text(random_mechanism(seed))));
    ASSERT_FALSE(dataset.diagnostics.has_errors()) << render(dataset.diagnostics);
    auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
    ASSERT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
    const auto system = System::make(std::move(model.value)).value();
    Findings findings;
    const auto op = initial_conditions(*system, findings);
    ASSERT_TRUE(op) << op.error().message;
    auto linear = linearize(*system, *op, {});
    ASSERT_TRUE(linear) << linear.error().message;
    const auto all = eigensolve(*linear);
    ASSERT_TRUE(all) << all.error().message;
    std::vector<double> moduli;
    for (const EigenMode& m : all->modes) {
      if (std::abs(m.eigenvalue_hz) > 1e-6) moduli.push_back(std::abs(m.eigenvalue_hz));
    }
    if (moduli.empty()) continue;

    std::mt19937_64 random(seed);
    const auto drawn = [&] {
      const double modulus = moduli[random() % moduli.size()];
      return modulus * (0.5 + std::ldexp(static_cast<double>(random() >> 11U), -53));
    };
    std::vector<ModeSelection> selections{NearestModes{1 + random() % moduli.size(), 0},
                                          NearestModes{1 + random() % moduli.size(), drawn()}};
    const double one = drawn(), other = drawn();
    selections.emplace_back(ModesInBand{std::min(one, other), std::max(one, other)});
    selections.emplace_back(ModesInBand{0, drawn()});
    for (const ModeSelection& wanted : selections) {
      SCOPED_TRACE(text_of(wanted));
      const auto found = eigensolve_selected(*system, *linear, wanted);
      ASSERT_TRUE(found) << found.error().message;
      expect_same(*found, selected_of(*all, wanted));
      const CountedBy by = found->selected->by;
      counted += by == CountedBy::winding_number || by == CountedBy::inertia, ++tried;
      doubted += !found->selected->complete;
    }
  }
  // Where bounds leave open what is a zero all modes tell, and where vectors or values are not exact they have better
  // ones. Of ten mechanisms more may be of that kind than of thirty.
  EXPECT_GE(counted, draws(0.85, 0.75) * tried) << "the full solution stands in for few";
  EXPECT_LE(doubted, 0.05 * tried);
}
INSTANTIATE_TEST_SUITE_P(generated, SelectedModesOfMechanisms, ::testing::Range<std::uint64_t>(1, 221, 30));

}  // namespace
}  // namespace dynalin::oracle::selected_modes_test
