// Frequency response against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/cycle.h"
#include "nastran_reader/solve.h"

namespace dynalin::nastran_reader::response_test {
namespace {

using Complex = std::complex<double>;

struct Answer {
  Prepared p;
  std::vector<ResponseCase> cases;
};
Answer answer(const std::string& control, const std::string& bulk) {
  Diagnostics reading;
  Deck deck = deck_of_text("test.bdf", "SOL 108\nCEND\n" + control + "BEGIN BULK\n" + bulk + "ENDDATA\n", reading);
  Answer a{prepare(std::move(deck), std::move(reading), Purpose::solve), {}};
  EXPECT_FALSE(a.p.diagnostics.has_errors()) << render(a.p.diagnostics);
  if (a.p.diagnostics.has_errors()) return a;
  auto cases = solve_response(a.p, a.p.diagnostics);
  EXPECT_TRUE(cases.has_value());
  if (cases) a.cases = std::move(*cases);
  return a;
}

// m = 2, b = 0.3, k = 50 along x of grid 1.
const std::string oscillator = "GRID,1,,,,,,23456\nCONM2,1,1,,2.\nCELAS2,2,50.,1,1\nCDAMP2,3,.3,1,1\n";
Complex compliance(double f) {
  const double w = cycle * f;
  return 1.0 / Complex(50 - 2 * w * w, 0.3 * w);
}

TEST(Response, of_an_oscillator_to_a_force_with_phase_and_delay) {
  const Answer a = answer("FREQ = 6\nDLOAD = 2\nDISP = ALL\n",
                          oscillator +
                              "FREQ1,6,.1,.05,20\nRLOAD1,2,3,.02,30.,5\nFORCE,3,1,,4.,.5,0.,0.\n"
                              "TABLED1,5\n,0.,1.,2.,3.,ENDT\n");
  ASSERT_EQ(a.cases.size(), 1u);
  ASSERT_EQ(a.cases[0].frequencies.size(), 21u);
  for (std::size_t k = 0; k < 21; ++k) {
    const double f = a.cases[0].frequencies[k];
    EXPECT_NEAR(f, 0.1 + 0.05 * double(k), 1e-15);
    const Complex load = 2 * (1 + f) * std::polar(1.0, std::numbers::pi / 6 - cycle * f * .02);
    const Complex expected = compliance(f) * load;
    EXPECT_LT(std::abs(a.cases[0].displacements(0, static_cast<Eigen::Index>(k)) - expected),
              1e-13 * std::abs(expected));
  }
}

TEST(Response, of_loads_that_nothing_feels_is_zero_and_said_so) {
  // About an axis that is held, and along the one that is free.
  const std::string bulk =
      oscillator + "FREQ,6,.3\nRLOAD1,2,3,,,1.\nRLOAD1,4,5,,,1.\nMOMENT,3,1,,4.,.5,0.,0.\nFORCE,5,1,,4.,1.,0.,0.\n";
  const Answer a = answer("FREQ = 6\nDLOAD = 2\nDISP = ALL\n", bulk);
  EXPECT_EQ(a.cases[0].displacements.norm(), 0);
  std::size_t said = 0;
  for (const Diagnostic& d : a.p.diagnostics.items()) {
    if (d.code != "idle-load") continue;
    ++said;
    EXPECT_EQ(d.message, "RLOAD1 2 excites nothing: constraints hold all that its loads act on");
  }
  EXPECT_EQ(said, 1u);
}

TEST(Response, of_subcases_with_cards_for_phases_and_sums_of_loads) {
  const Answer a = answer(
      "FREQ = 6\nSET 9 = 2\nSUBCASE 10\n LABEL = one\n DLOAD = 20\n DISP(PUNCH) = 9\nSUBCASE 11\n DLOAD = 21\n DISP = "
      "ALL\n",
      oscillator +
          "SPOINT,2\nMPC,1,2,,1.,1,1,-3.\nFREQ2,6,.5,2.,2\nFREQ,6,.75\n"
          "RLOAD1,21,3,7,8,,2.\nRLOAD1,22,3,,,1.5\nDLOAD,20,2.,1.,21,-3.,22\nDAREA,3,1,1,4.\n"
          "DPHASE,8,1,1,90.\nDELAY,7,1,1,.1\n");
  ASSERT_EQ(a.cases.size(), 2u);
  EXPECT_EQ(a.cases[0].label, "one");
  EXPECT_EQ(a.cases[0].points, (std::vector<int>{2}));
  EXPECT_EQ(a.cases[1].points, (std::vector<int>{1, 2}));
  const std::vector<double> expected{.5, .75, 1, 2};
  ASSERT_EQ(a.cases[0].frequencies.size(), 4u);
  for (Eigen::Index k = 0; k < 4; ++k) {
    const double f = expected[static_cast<std::size_t>(k)];
    EXPECT_NEAR(a.cases[0].frequencies[static_cast<std::size_t>(k)], f, 1e-14);
    // i · 2 · 4 · exp(i(π/2 − ωτ)), and 4 · 1.5
    const Complex first = Complex(0, 2) * 4.0 * std::polar(1.0, std::numbers::pi / 2 - cycle * f * .1), second = 6;
    EXPECT_LT(std::abs(a.cases[1].displacements(0, k) - first * compliance(f)), 1e-13);
    EXPECT_LT(std::abs(a.cases[0].displacements(0, k) - 2.0 * (first - 3.0 * second) * compliance(f)), 1e-12);
  }
}

// A force acts along CID, the answer is along CD, and constraints carry both.
TEST(Response, in_axes_of_grids_on_a_rigid_body) {
  const Answer a =
      answer("FREQ = 6\nDLOAD = 2\nDISP = ALL\nSPC = 1\n",
             "CORD2R,7,,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\nGRID,1\nGRID,2,,2.,0.,0.,7\nRBE2,5,1,123456,2\nSPC1,1,12345,1\n"
             "CONM2,1,1,,1.\n,1.,,1.,,,4.\nCELAS2,2,9.,1,6\nFREQ,6,.3\nRLOAD1,2,3,,,1.\nFORCE,3,2,7,1.,5.,0.,0.\n");
  ASSERT_EQ(a.cases.size(), 1u);
  // The force of 5 along x of 7, which is basic y, turns the body about z with a lever of 2.
  const double w = cycle * .3, angle = 10 / (9 - 4 * w * w);
  const Point& p = *a.p.points->find(2);
  EXPECT_NEAR(a.cases[0].displacements(p.first, 0).real(), 2 * angle, 1e-13);
  EXPECT_NEAR(a.cases[0].displacements(p.first + 1, 0).real(), 0, 1e-13);
  EXPECT_NEAR(a.cases[0].displacements(p.first + 5, 0).real(), angle, 1e-13);
}

TEST(Response, is_zero_where_everything_is_held) {
  const Answer a = answer("FREQ = 6\nDLOAD = 2\nDISP = ALL\n",
                          "GRID,1,,,,,,123456\nFREQ,6,.3\nRLOAD1,2,3,,,1.\nFORCE,3,1,,1.,5.,0.,0.\n");
  ASSERT_EQ(a.cases.size(), 1u);
  EXPECT_TRUE(a.cases[0].displacements.isZero(0));
}

}  // namespace
}  // namespace dynalin::nastran_reader::response_test
