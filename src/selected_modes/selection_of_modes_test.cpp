// Which modes a selection takes out of all of them.
#include "selected_modes/selection_of_modes.h"

#include <gtest/gtest.h>

namespace dynalin::selection_of_modes_test {
namespace {

EigenMode mode(double re, double im, bool zero = false) {
  EigenMode m;
  m.eigenvalue_hz = {re, im};
  m.is_real = im == 0;
  m.structural_zero = zero;
  return m;
}

// Two zeros, real modes, a triple root with roundings of its own, and single ones.
EigenSolution all_modes() {
  EigenSolution all;
  all.modes = {mode(0, 0, true), mode(0, 0, true),   mode(-0.5, 0),      mode(-7, 0), mode(-0.1, 1),
               mode(0, 2),       mode(0, 2 + 2e-15), mode(0, 2 + 4e-15), mode(-3, 4), mode(-0.01, 8)};
  const auto n = static_cast<Eigen::Index>(all.modes.size());
  all.vectors = Eigen::MatrixXcd::Zero(17, n);
  for (Eigen::Index k = 0; k < n; ++k) all.vectors(k, k) = static_cast<double>(k);
  return all;
}

// The modes that were taken, by their places among all.
std::vector<int> taken(const EigenSolution& selected) {
  std::vector<int> places;
  for (Eigen::Index k = 0; k < selected.vectors.cols(); ++k)
    places.push_back(static_cast<int>(selected.vectors.col(k).cwiseAbs().maxCoeff()));
  return places;
}

TEST(SelectionOfModes, takes_the_nearest_with_zeros_of_the_structure_beside_them) {
  const EigenSolution two = selected_of(all_modes(), NearestModes{2, 0});
  EXPECT_EQ(taken(two), (std::vector<int>{0, 1, 2, 4}));
  EXPECT_TRUE(two.modes[0].structural_zero && two.modes[1].structural_zero);
  ASSERT_TRUE(two.selected);
  EXPECT_TRUE(two.selected->complete);
  EXPECT_EQ(two.selected->by, CountedBy::full_solution);
  // Both zeros, one real value, a pair.
  EXPECT_EQ(two.selected->found, 5u);
  EXPECT_EQ(two.selected->counted, 5u);
  EXPECT_GT(two.selected->radius_hz, std::abs(std::complex<double>(-0.1, 1)));
  EXPECT_LT(two.selected->radius_hz, 2);
}

TEST(SelectionOfModes, takes_all_that_are_equally_near) {
  EXPECT_EQ(taken(selected_of(all_modes(), NearestModes{3, 0})), (std::vector<int>{0, 1, 2, 4, 5, 6, 7}));
  EXPECT_EQ(taken(selected_of(all_modes(), NearestModes{1, 2})), (std::vector<int>{0, 1, 5, 6, 7}));
}

// The disc about a point off the origin need not hold zeros and conjugates.
TEST(SelectionOfModes, counts_what_is_in_the_disc) {
  const EigenSolution one = selected_of(all_modes(), NearestModes{1, 7.9});
  EXPECT_EQ(taken(one), (std::vector<int>{0, 1, 9}));
  EXPECT_EQ(one.selected->found, 1u);
}

TEST(SelectionOfModes, takes_what_is_there_where_more_is_asked_for) {
  const EigenSolution all = selected_of(all_modes(), NearestModes{100, 0});
  EXPECT_EQ(all.modes.size(), 10u);
  EXPECT_EQ(all.selected->found, 2u + 2u + 2u * 6u);
  const EigenSolution none = selected_of(EigenSolution{}, NearestModes{3, 0});
  EXPECT_TRUE(none.modes.empty());
  EXPECT_EQ(none.selected->found, 0u);
}

// Values belong to it that may be inside within their bounds, and no others.
TEST(SelectionOfModes, takes_a_band_with_its_borders) {
  EigenSolution all = all_modes();
  for (const std::size_t k : {5u, 6u}) all.modes[k].error_bound_hz = 1e-14;
  all.modes[7] = mode(0, 2 + 1e-10), all.modes[7].error_bound_hz = 1e-13;
  EXPECT_EQ(taken(selected_of(all, ModesInBand{0, 2})), (std::vector<int>{0, 1, 2, 4, 5, 6}));
  EXPECT_EQ(taken(selected_of(all, ModesInBand{2 + 1e-10 + 5e-14, 3})), (std::vector<int>{0, 1, 7}));
  EXPECT_EQ(selected_of(all, ModesInBand{2 + 1e-10 + 5e-14, 3}).selected->found, 2u);
}

TEST(SelectionOfModes, takes_a_band_with_all_of_an_equal_value_at_its_border) {
  EigenSolution all = all_modes();
  for (EigenMode& m : all.modes) m.error_bound_hz = m.structural_zero ? 0 : 1e-14;
  const EigenSolution low = selected_of(all, ModesInBand{0, 2});
  EXPECT_EQ(taken(low), (std::vector<int>{0, 1, 2, 4, 5, 6, 7}));
  EXPECT_EQ(low.selected->found, 2u + 1u + 2u * 4u);
  EXPECT_EQ(low.selected->radius_hz, 0);
  EXPECT_EQ(taken(selected_of(all, ModesInBand{2, 4})), (std::vector<int>{0, 1, 5, 6, 7, 8}));
  EXPECT_EQ(selected_of(all, ModesInBand{2, 4}).selected->found, 8u);  // no zeros in it
  EXPECT_EQ(taken(selected_of(all, ModesInBand{0, 6})), (std::vector<int>{0, 1, 2, 4, 5, 6, 7, 8}));
  EXPECT_EQ(taken(selected_of(all, ModesInBand{5, 7})), (std::vector<int>{0, 1}));
}

TEST(SelectionOfModes, leaves_out_strong_damping_beyond_the_band) {
  EigenSolution all = all_modes();
  all.modes[8] = mode(-9, 4);
  EXPECT_EQ(taken(selected_of(all, ModesInBand{2, 5})), (std::vector<int>{0, 1, 5, 6, 7}));
}

}  // namespace
}  // namespace dynalin::selection_of_modes_test
