// Flexible bodies against mechanisms of rigid parts that are the same, and against closed forms.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <numbers>

#include "flexible.h"
#include "run.h"
#include "system/flexible_test_support.h"

namespace dynalin::cases::flex_body_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class FlexBody : public Cases {};

// --- a beam -----------------------------------------------------------------------------------------
const LumpedBeam beam{6, 0.6, 4.2e6, 900, 1300, 2100, 1.9, 2.5e-3};

std::string held_beam(const std::string& more, const std::string& place = "") {
  return "Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1" + place + "\nFLEX_BODY/2, MNF_FILE=beam.fem" +
         (place.empty() ? "" : ", QG=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1") + more +
         "\nMARKER/21, FLEX_BODY=2, NODE_ID=1\nJOINT/1, FIXED, I=21, J=1\nEND\n";
}

std::vector<double> frequencies(const RunResult& r, std::size_t k = 0) {
  std::vector<double> list;
  for (const auto& e : r.eigenvalues(k)) {
    if (e.imag() > 0) list.push_back(std::abs(e) * 2 * std::numbers::pi);
  }
  std::ranges::sort(list);
  return list;
}

// All free-free modes of the beam span what it can do: clamped it is the clamped beam, whichever way it stands.
TEST_F(FlexBody, all_free_modes_clamped_are_the_clamped_beam) {
  const Vibration free = vibration(beam, 0), held = vibration(beam, 6);
  const ReducedBody body = reduced(beam, free.shapes.rightCols(free.shapes.cols() - 6));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  for (const std::string place : {"", ", QP=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1"}) {
    const RunResult r = run(held_beam(", CRATIO=0", place), "LINEAR/EIGENSOL\nSTOP\n");
    ASSERT_EQ(r.status, 0) << r.err << r.message;
    const auto found = frequencies(r);
    ASSERT_EQ(found.size(), 30u);
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_NEAR(found[k], std::sqrt(held.squares(static_cast<Eigen::Index>(k))), 1e-8 * found.back()) << k;
  }
}

TEST_F(FlexBody, slender_beams_have_the_frequencies_of_theory) {
  const LumpedBeam fine{41, 1.0, 4e6, 400, 50, 50, 2.0, 1e-9};
  const Vibration free = vibration(fine, 0), held = vibration(fine, 6);
  const double unit = std::sqrt(fine.EIz / fine.mass_per_length);
  // Free-free, with the BCS of a beam that nothing holds.
  const ReducedBody loose = reduced(fine, free.shapes.middleCols(6, 6));
  write("beam.fem", modal_text(loose.nodes, loose.stiffness));
  RunResult r = run("Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=0\nEND\n",
                    "LINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err << r.message;
  auto found = frequencies(r);
  ASSERT_EQ(found.size(), 6u);
  for (const auto& [k, beta] : {std::pair<std::size_t, double>{0, 4.73004074}, {2, 7.85320462}, {4, 10.9956078}})
    EXPECT_NEAR(found[k], beta * beta * unit, 5e-3 * found[k]);
  // Clamped, by the modes of the clamped beam.
  const ReducedBody clamped = reduced(fine, held.shapes.leftCols(6));
  write("beam.fem", modal_text(clamped.nodes, clamped.stiffness));
  r = run(held_beam(", CRATIO=0"), "LINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err << r.message;
  found = frequencies(r);
  for (const auto& [k, beta] : {std::pair<std::size_t, double>{0, 1.87510407}, {2, 4.69409113}, {4, 7.85475744}})
    EXPECT_NEAR(found[k], beta * beta * unit, 5e-3 * found[k]);
}

// Frequencies of the pairs in cycles, ascending, with the damping of each.
std::vector<std::pair<double, double>> damping_ratios(const RunResult& r) {
  EXPECT_EQ(r.status, 0) << r.err << r.message;
  std::vector<std::pair<double, double>> list;
  for (const auto& e : r.eigenvalues(0)) {
    if (e.imag() > 0) list.emplace_back(std::abs(e), -e.real() / std::abs(e));
  }
  std::ranges::sort(list);
  return list;
}

TEST_F(FlexBody, damping_is_that_of_each_mode) {
  const Vibration held = vibration(beam, 6);
  // In a basis that mixes the modes.
  Eigen::MatrixXd mixed = held.shapes.leftCols(8);
  mixed.col(0) += 0.4 * mixed.col(5);
  mixed.col(3) -= 0.7 * mixed.col(1);
  const ReducedBody body = reduced(beam, mixed);
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const auto ratios = [&](const std::string& more) {
    return damping_ratios(run(held_beam(more), "LINEAR/EIGENSOL\nSTOP\n"));
  };
  for (const auto& [hertz, ratio] : ratios("")) {
    ASSERT_LT(hertz, 1000);
    EXPECT_NEAR(ratio, hertz < 100 ? 0.01 : 0.1, 1e-9) << hertz;
  }
  const auto stepped = ratios(", CRATIO=IF(FXFREQ-150: 0.02, 0.03, 0.05)");
  ASSERT_EQ(stepped.size(), 8u);
  for (const auto& [hertz, ratio] : stepped) EXPECT_NEAR(ratio, hertz < 150 ? 0.02 : 0.05, 1e-9) << hertz;
  for (const auto& [hertz, ratio] : ratios(", CRATIO=1E-4*FXFREQ\\")) EXPECT_NEAR(ratio, 1e-4 * hertz, 1e-9);
  EXPECT_NEAR(ratios(", CRATIO=0").front().second, 0, 1e-12);
  const auto limits = ratios("");
  EXPECT_LT(limits.front().first, 100);
  EXPECT_GT(stepped.back().first, 150);
}

// Unless stated it is a step of the frequency, just below and just above 100 and 1000 cycles; critical above, with two
// equal roots, of which rounding makes a pair or two as far apart as its root.
TEST_F(FlexBody, damping_that_is_not_stated_goes_by_the_frequency) {
  const std::array hertz = {99.9, 100.1, 999.0, 1001.0};
  std::vector<FlexibleNode> nodes = {{1, {}, 5, {.1, .1, .1}, {}, {}}};
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(4, 4);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    stiffness(at, at) = std::pow(2 * std::numbers::pi * hertz[k], 2);
    nodes.push_back({static_cast<std::int64_t>(k + 2), {0.3, 0, 0}, 1, {.01, .01, .01}, {}, {}});
  }
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    for (std::size_t k = 0; k < 4; ++k) nodes[p].moves.push_back({0, k + 1 == p ? 1.0 : 0.0, 0});
    nodes[p].turns.resize(4);
  }
  write("beam.fem", modal_text(nodes, stiffness));
  const RunResult r = run(held_beam(""), "LINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err << r.message;
  std::vector<std::complex<double>> expected;
  for (const auto& [k, ratio] : {std::pair<std::size_t, double>{0, 0.01}, {1, 0.1}, {2, 0.1}}) {
    for (const double side : {1, -1})
      expected.emplace_back(-ratio * hertz[k], side * std::sqrt(1 - ratio * ratio) * hertz[k]);
  }
  auto found = r.eigenvalues(0);
  ASSERT_EQ(found.size(), 8u);
  for (const auto& e : expected) {
    const auto nearest = std::ranges::min_element(found, {}, [&](auto f) { return std::abs(f - e); });
    EXPECT_LT(std::abs(*nearest - e), 1e-9 * std::abs(e)) << e;
    found.erase(nearest);
  }
  for (const auto& e : found) EXPECT_LT(std::abs(e + hertz[3]), 1e-6 * hertz[3]) << e;
  EXPECT_LT(std::abs(found[0] + found[1] + 2 * hertz[3]), 1e-9 * hertz[3]);
}

// The number of a mode is that of the file, whose order is its own, also where rounding of the file couples modes.
TEST_F(FlexBody, numbers_of_modes_are_those_of_the_file) {
  const auto ratios = [&](double coupling) {
    const Vector x{1, 0, 0}, y{0, 1, 0}, none{};
    std::vector<FlexibleNode> nodes = {{1, x, 1, {.1, .1, .1}, {x, coupling * x}, {none, none}},
                                       {2, -1.0 * x, 1, {.1, .1, .1}, {-1.0 * x, -coupling * x}, {none, none}},
                                       {3, y, 1, {.1, .1, .1}, {none, y}, {none, none}},
                                       {4, -1.0 * y, 1, {.1, .1, .1}, {none, -1.0 * y}, {none, none}}};
    write("beam.fem", modal_text(nodes, Eigen::MatrixXd{{9000, 0}, {0, 4000}}));
    const RunResult r =
        run("Body\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nFLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=FXMODE/100\nEND\n",
            "LINEAR/EIGENSOL\nSTOP\n");
    return damping_ratios(r);
  };
  for (const double coupling : {0.0, 1e-12, 1e-7}) {
    const auto found = ratios(coupling);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].second, 0.02, 1e-9) << coupling;
    EXPECT_NEAR(found[1].second, 0.01, 1e-9) << coupling;
  }
  // Shapes that are none of its modes: the lowest is the first.
  const auto found = ratios(0.3);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].second, 0.01, 1e-9);
  EXPECT_NEAR(found[1].second, 0.02, 1e-9);
}

// The same body in metres and in millimetres, with modal coordinates that are lengths.
TEST_F(FlexBody, units_change_nothing) {
  const Vibration held = vibration(beam, 6);
  ReducedBody body = reduced(beam, held.shapes.leftCols(5));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const auto dataset = [](bool millimetres) {
    const double l = millimetres ? 1000 : 1;
    return fmt::format(
        "Beam\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={}, TIME=SECOND\nACCGRAV/JGRAV={:.17g}\nPART/1, GROUND\n"
        "MARKER/1\nMARKER/2, QP={:.17g},{:.17g},0\nFLEX_BODY/2, MNF_FILE=beam.fem, WZ=20\nMARKER/21, "
        "NODE_ID=1\nMARKER/22, NODE_ID=6\n"
        "JOINT/1, REVOLUTE, I=21, J=1\nSPRINGDAMPER/1, TRANS, I=22, J=2, K={:.17g}, C={:.17g}, LENGTH={:.17g}\nEND\n",
        millimetres ? "MILLIMETER" : "METER", -9.81 * l, 0.5 * l, 0.4 * l, 300 / l, 2 / l, 0.2 * l);
  };
  const RunResult metres = run(dataset(false), "SIM/INITIAL\nLINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(metres.status, 0) << metres.err << metres.message;
  for (FlexibleNode& p : body.nodes) {
    p.at = 1000.0 * p.at, p.own = 1e6 * p.own;
    for (Vector& turn : p.turns) turn = 0.001 * turn;
  }
  body.stiffness *= 1e-3;
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const RunResult millimetres = run(dataset(true), "SIM/INITIAL\nLINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(millimetres.status, 0) << millimetres.err << millimetres.message;
  const auto a = metres.eigenvalues(1), b = millimetres.eigenvalues(1);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), 12u);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LT(std::abs(a[k] - b[k]), 1e-9 * (1 + std::abs(a[k]))) << k;
}

// A pendulum of a body that hardly bends, and of a part.
TEST_F(FlexBody, stiff_modes_make_a_part) {
  LumpedBeam stiff = beam;
  stiff.EA *= 1e4, stiff.GJ *= 1e4, stiff.EIy *= 1e4, stiff.EIz *= 1e4;
  const Vibration free = vibration(stiff, 0);
  const ReducedBody body = reduced(stiff, free.shapes.middleCols(6, 10));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  double mass = 0, inertia = 0, own = 0;
  for (const FlexibleNode& p : body.nodes) {
    mass += p.mass, inertia += p.mass * (p.at.x - 0.3) * (p.at.x - 0.3), own += p.own.x;
  }
  // Held about its own axis as well: a centre that modes move off it by 1e-17 would turn it by any angle else.
  const std::string rest =
      "JOINT/1, SPHERICAL, I=21, J=1\nSPRINGDAMPER/1, ROT, I=21, J=1, KT=2, CT=0.1\n"
      "SPRINGDAMPER/2, ROT, I=22, J=2, KT=3\nEND\n";
  const std::string head =
      "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/IGRAV=9.81\nPART/1, GROUND\nMARKER/1\nMARKER/2, REULER=90D,90D,0\n";
  const RunResult flexible = run(
      head +
          "FLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=0\nMARKER/21, NODE_ID=1\nMARKER/22, NODE_ID=1, REULER=90D,90D,0\n" +
          rest,
      "SIM/STATIC\nLINEAR/EIGENSOL\nSTOP\n");
  const RunResult rigid = run(head +
                                  fmt::format("PART/2, MASS={:.17g}, CM=20, IP={:.17g},{:.17g},{:.17g}\nMARKER/20, "
                                              "QP=0.3,0,0\nMARKER/21\nMARKER/22, REULER=90D,90D,0\n",
                                              mass, own, inertia + 0.6 * own, inertia + 0.7 * own) +
                                  rest,
                              "SIM/STATIC\nLINEAR/EIGENSOL\nSTOP\n");
  ASSERT_EQ(flexible.status, 0) << flexible.err << flexible.message;
  ASSERT_EQ(rigid.status, 0) << rigid.err << rigid.message;
  const auto expected = rigid.eigenvalues(rigid.json.at("results").size() - 1);
  const auto found = flexible.eigenvalues(flexible.json.at("results").size() - 1);
  for (const auto& e : expected) {
    double nearest = 1e300;
    for (const auto& f : found) nearest = std::min(nearest, std::abs(e - f));
    EXPECT_LE(nearest, 1e-7 * std::abs(e)) << e;  // the modes give by 3e-8 of what the springs do
  }
}

TEST_F(FlexBody, tables_share_out_its_energy_and_mass) {
  const Vibration free = vibration(beam, 0);
  const ReducedBody body = reduced(beam, free.shapes.middleCols(6, 6));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const RunResult r =
      run("Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=beam.fem\nMARKER/21, NODE_ID=1\n"
          "PART/3, MASS=0.4, CM=30, IP=1E-3,2E-3,3E-3, QG=0.6,0.1,0\nMARKER/30\nMARKER/31, PART=3, QP=0,-0.1,0\n"
          "MARKER/26, FLEX_BODY=2, NODE_ID=6\nJOINT/1, SPHERICAL, I=31, J=26\n"
          "BUSHING/1, I=21, J=1, K=3E3,4E3,5E3, KT=60,70,80, C=2,3,4, CT=0.1,0.1,0.1\nBUSHING/2, I=31, J=26, "
          "KT=5,6,7\nEND\n",
          "LINEAR/EIGENSOL, KINETIC=1,9, STRAIN=1,9, DISSIPAT=1,9, MASS_PER_MODE=1,40\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err << r.message;
  bool seen_modal = false;
  for (const auto& table : r.result(0).at("tables")) {
    const std::string kind = table.at("table");
    if (kind == "KINETIC") {
      double sum = 0;
      EXPECT_EQ(table.at("columns").size(), 11u);
      for (const auto& row : table.at("rows")) {
        const auto& values = row.at("values");
        sum += values.back().get<double>();
        if (values[9].is_null()) continue;
        double parts = 0;
        for (std::size_t k = 0; k < 10; ++k) parts += values[k].get<double>();
        EXPECT_NEAR(parts, values[10].get<double>(), 1e-9);
        seen_modal |= std::abs(values[9].get<double>()) > 1;
      }
      EXPECT_NEAR(sum, 100, 1e-9);
    }
  }
  EXPECT_TRUE(seen_modal) << r.json.dump(1).substr(0, 3000);
  EXPECT_THAT(r.text("model.txt"), HasSubstr("FLEX"));
}

// What is drawn apart is brought together by moving it, not by bending it.
TEST_F(FlexBody, drawn_off_its_joint_moves_as_a_whole) {
  const Vibration free = vibration(beam, 0);
  const ReducedBody body = reduced(beam, free.shapes.middleCols(6, 8));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const std::string exact = held_beam(", CRATIO=0", ", QP=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1"),
                    commands = "LINEAR/EIGENSOL\nSTOP\n";
  std::string apart = exact;
  apart.replace(apart.find("QG=0.3,-0.2,0.7, REULER=0.4,0.9,-1.1"), 36, "QG=0.33,-0.15,0.65, REULER=0.45,0.85,-1");
  const RunResult good = run(exact, commands), moved = run(apart, commands);
  ASSERT_EQ(good.status, 0) << good.err;
  ASSERT_EQ(moved.status, 0) << moved.err;
  const std::vector<double> expected = frequencies(good), found = frequencies(moved);
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_EQ(expected.size(), 8u);
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-9 * expected[k]);
}

// It bends before a coordinate leaves where EXACT holds it.
TEST_F(FlexBody, bends_where_exact_holds_it) {
  const Vibration free = vibration(beam, 0);
  const ReducedBody body = reduced(beam, free.shapes.middleCols(6, 8));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const Vector end = body.nodes.back().at;
  const RunResult r =
      run(fmt::format("Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP={:.17g},{:.17g},{:.17g}\nFLEX_BODY/2, "
                      "MNF_FILE=beam.fem, CRATIO=0, EXACT=X:Y:Z:PSI:THETA:PHI\nMARKER/21, NODE_ID={}\nJPRIM/1, INLINE, "
                      "I=21, J=1\nEND\n",
                      end.x, end.y + 1e-3, end.z, body.nodes.back().label),
          "SIMULATE/INITIAL\n");
  ASSERT_EQ(r.status, 0) << r.err << r.message;
  EXPECT_THAT(r.err, Not(HasSubstr("cannot keep")));
  const auto& state = r.result(0).at("operating_point");
  for (const double x : state.at("bodies").at(0).at("position").get<std::vector<double>>()) EXPECT_NEAR(x, 0, 1e-13);
  double bent = 0;
  for (const auto& q : state.at("curve_parameters")) bent = std::max(bent, std::abs(q.at("value").get<double>()));
  EXPECT_GT(bent, 1e-5);
}

// A joint that the body can follow as a whole changes nothing of its shape, nor of how that changes.
TEST_F(FlexBody, keeps_the_shape_that_is_stated_where_joints_allow_it) {
  const Vibration free = vibration(beam, 0);
  const ReducedBody body = reduced(beam, free.shapes.middleCols(6, 4));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const std::vector<double> shape = {0.01, 0.02, -0.01, 0.005}, rate = {0.5, -0.6, 0.7, -0.2};
  const std::string stated = fmt::format(", CRATIO=0, DMODE={}, VMODE={}", fmt::join(shape, ","), fmt::join(rate, ","));
  for (const char* joint : {"FIXED", "SPHERICAL", "REVOLUTE"}) {
    std::string dataset =
        held_beam(stated + (joint == std::string("REVOLUTE") ? ", VX=1" : ""), ", QP=0.35,-0.1,0.6, REULER=0.5,0.7,-1");
    dataset.replace(dataset.find("FIXED"), 5, joint);
    const RunResult r = run(dataset, "SIMULATE/INITIAL\n");
    ASSERT_EQ(r.status, 0) << r.err;
    const auto& coordinates = r.result(0).at("operating_point").at("curve_parameters");
    ASSERT_EQ(coordinates.size(), shape.size());
    for (std::size_t k = 0; k < shape.size(); ++k) {
      EXPECT_NEAR(coordinates[k].at("value").get<double>(), shape[k], 1e-14) << joint;
      EXPECT_NEAR(coordinates[k].at("rate").get<double>(), rate[k], 1e-11) << joint;
    }
  }
}

// --- files that are wrong ---------------------------------------------------------------------------
TEST_F(FlexBody, wrong_files_are_errors_at_their_place) {
  const Vibration held = vibration(beam, 6);
  const ReducedBody body = reduced(beam, held.shapes.leftCols(2));
  const std::string good = modal_text(body.nodes, body.stiffness);
  const auto with = [&](const std::string& old, const std::string& now) {
    std::string t = good;
    const auto at = t.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    t.replace(at, old.size(), now);
    return t;
  };
  const auto refused = [&](const std::string& text, const std::string& said) {
    write("beam.fem", text);
    const RunResult r = run(held_beam(""), "LINEAR/EIGENSOL\nSTOP\n");
    EXPECT_NE(r.status, 0);
    EXPECT_THAT(r.err, HasSubstr(said));
  };
  refused(with(" 6\n**\n** RECORD GROUP 5", "**\n** RECORD GROUP 5"),
          "beam.fem:12:1: error: RECORD GROUP 2 ends after 5 of 6 labels");
  refused(with(" 6\n**\n** RECORD GROUP 5", " 6\n7\n**\n** RECORD GROUP 5"),
          "beam.fem:12:1: error: RECORD GROUP 2 holds more numbers than 6 labels");
  refused(with("REV0 6 2", "REV0 6 3"), "RECORD GROUP 8 ends after 0 of 6 × 6 numbers of shape 3");
  refused(with("** RECORD GROUP 9", "** RECORD GROUP 77"), "RECORD GROUP 77 is not known");
  refused(with(" 3\n", " x3y\n 2\n"), "node 2 is given twice");
  refused(with("NORMAL MODE SHAPE #  1\n0", "NORMAL MODE SHAPE #  1\nnought"), "nought is no number");
  refused(std::string("\0\1\2MNF", 6), "is a binary modal neutral file: this format is not public");
  refused("bmod....", "give the .fem text file that it was made from");
  const std::string masses = good.substr(good.find("** RECORD GROUP 11"));
  const auto first = masses.find('\n') + 1;
  std::string negative = good;
  negative.insert(good.find(masses) + first, "-");
  refused(negative, "a node has no mass or inertia of -");
  const auto whole = [&](const std::string& numbers) { return good + "** RECORD GROUP 12\n" + numbers + "\n"; };
  refused(whole("0 0 0 0 1 0 0 0 1 0 0 0 1"), "RECORD GROUP 12 states a mass of 0");
  refused(whole("1 0 0 0 1 0.2 0 0.1 1 0 0 0 1"),
          "the inertia of RECORD GROUP 12 is not symmetric: it has 0.2 and 0.1");
  refused(whole("1 0 0 0 1 0 0 0 -1 0 0 0 1"), "RECORD GROUP 12 states a moment of inertia of -1");
  refused(good + "** RECORD GROUP 17\n0 1 1 0 0 0 0 0 0 0 0 0\n", "RECORD GROUP 17 is of no body: modes 2 and 1");
  std::string products = "** RECORD GROUP 18\n";
  for (int k = 0; k < 36; ++k) products += k == 4 ? "1 " : "0 ";
  refused(good + products + "\n", "RECORD GROUP 18 is of no body");
  // Modes that the body has already.
  const Vibration free = vibration(beam, 0);
  const ReducedBody rigid = reduced(beam, free.shapes.middleCols(4, 4));
  refused(modal_text(rigid.nodes, rigid.stiffness), "modes 1-2 in ");
  // Masses of its nodes that go beyond its generalized mass.
  ReducedBody heavy = body;
  for (FlexibleNode& node : heavy.nodes) node.mass *= 30;
  std::string text = modal_text(heavy.nodes, body.stiffness);
  const auto record_of = [](const std::string& t) {
    const std::size_t from = t.find("** RECORD GROUP 9");
    return t.substr(from, t.find("** RECORD GROUP 10") - from);
  };
  text.replace(text.find(record_of(text)), record_of(text).size(), record_of(good));
  refused(text, "beam.fem is not positive");
  write("beam.fem", good);
  const RunResult both = run(held_beam(", MATRICES=1"), "STOP\n");
  EXPECT_THAT(both.err, HasSubstr("FLEX_BODY/2 takes its data from MNF_FILE or from MATRICES, not from both"));
  // Mass and its first moment without the inertia tensor.
  const RunResult halved = run(held_beam(", INVARIANTS=T:T:T:T:T:T:F:T:T"), "STOP\n");
  EXPECT_NE(halved.status, 0);
  EXPECT_THAT(halved.err, HasSubstr("the inertia in what INVARIANTS leaves of the body is not positive: some motion of "
                                    "the body as a whole has less than no energy"));
  const RunResult r =
      run("Beam\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=TIME\nMARKER/21, NODE_ID=9\n"
          "MARKER/22\nEND\n",
          "STOP\n");
  EXPECT_THAT(r.err, HasSubstr("model.adm:5:12: error: FLEX_BODY/2 has no node 9"));
  EXPECT_THAT(r.err, HasSubstr("MARKER/22 on FLEX_BODY/2 needs NODE_ID"));
  const RunResult ratio =
      run("Beam\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=0.01*NOPE(FXFREQ)\nEND\n", "STOP\n");
  EXPECT_THAT(ratio.err, HasSubstr("model.adm:4:45: error: "));
}

TEST_F(FlexBody, states_have_their_codes) {
  const Vibration held = vibration(beam, 6);
  const ReducedBody body = reduced(beam, held.shapes.leftCols(2));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const RunResult r = run(held_beam(""), "LINEAR/STATEMAT, FILE=x\nLINEAR/STATEMAT, FILE=y, RM=1\nSTOP\n");
  ASSERT_EQ(r.status, 0) << r.err << r.message;
  for (const auto& [k, type] : {std::pair<std::size_t, int>{0, 28}, {1, 38}}) {
    const auto& states = r.result(k).at("states");
    ASSERT_EQ(states.size(), 4u);
    EXPECT_THAT(states.dump(), HasSubstr(fmt::format("{}", type)));
    EXPECT_THAT(states.dump(), HasSubstr("1000002"));
    EXPECT_THAT(states.dump(), HasSubstr("2000001"));
    EXPECT_THAT(states.dump(), HasSubstr("Modal generalized coordinate Q1"));
  }
  const RunResult original = run(held_beam(""), "LINEAR/EIGENSOL, ORIGINAL\nSTOP\n");
  ASSERT_EQ(original.status, 0) << original.err;
  for (const auto& state : original.result(0).at("states")) EXPECT_EQ(state.at("type"), 8);
}

TEST_F(FlexBody, beyond_its_linear_modes_is_warned_of) {
  const Vibration held = vibration(beam, 6);
  const ReducedBody body = reduced(beam, held.shapes.leftCols(2));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const double lowest = std::sqrt(held.squares(0));
  double mass = 0;
  for (const FlexibleNode& n : body.nodes) mass += n.mass;
  const auto said = [&](const std::string& more) {
    const RunResult r = run(fmt::format("Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, "
                                        "MNF_FILE=beam.fem, CRATIO=0{}\nMARKER/21, NODE_ID=1\nJOINT/1, REVOLUTE, I=21, "
                                        "J=1\nEND\n",
                                        more),
                            "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.message, HasSubstr(fmt::format("FLEX_BODY/2: mass {:.6g}, 2 modes from ", mass)));
    return r.err;
  };
  EXPECT_THAT(said(fmt::format(", WZ={}", 0.09 * lowest)), Not(HasSubstr("fast-flexible-body")));
  EXPECT_THAT(said(fmt::format(", WZ={}", 0.11 * lowest)), HasSubstr("0.11 of its lowest frequency"));
  EXPECT_THAT(said(""), Not(HasSubstr("far-bent-body")));
  EXPECT_THAT(said(", DMODE=5,0"), HasSubstr("far-bent-body"));
  EXPECT_THAT(said(", DMODE=0.01,0"), Not(HasSubstr("far-bent-body")));
  EXPECT_THAT(said(", DMODE=0.01,0, CHAR_LEN=0.001"), HasSubstr("far-bent-body"));
}

// The length that its bending is measured against is that of the body, wherever it is drawn.
TEST_F(FlexBody, is_bent_far_from_a_tenth_of_its_length_on) {
  const Vibration held = vibration(beam, 6);
  const ReducedBody body = reduced(beam, held.shapes.leftCols(2));
  const double length = norm(body.nodes.back().at - body.nodes.front().at);
  double farthest = 0;
  for (const FlexibleNode& n : body.nodes) farthest = std::max(farthest, norm(n.moves.front()));
  for (const double beside : {0.0, 100.0}) {
    std::vector<FlexibleNode> nodes = body.nodes;
    for (FlexibleNode& n : nodes) n.at.y += beside;
    write("beam.fem", modal_text(nodes, body.stiffness));
    for (const double bent : {0.09, 0.11}) {
      const RunResult r = run(fmt::format("Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=0,{},0\nFLEX_BODY/2, "
                                          "MNF_FILE=beam.fem, CRATIO=0, DMODE={:.17g},0\nMARKER/21, NODE_ID=1\n"
                                          "JOINT/1, FIXED, I=21, J=1\nEND\n",
                                          beside, bent * length / farthest),
                              "LINEAR/EIGENSOL\n");
      ASSERT_EQ(r.status, 0) << r.err;
      EXPECT_EQ(r.err.find("far-bent-body") != std::string::npos, bent > 0.1) << r.err;
    }
  }
}

// Mass, its moment and inertia are those of a rigid body.
TEST_F(FlexBody, of_three_invariants_is_a_part) {
  const Vibration held = vibration(beam, 6);
  const ReducedBody body = reduced(beam, held.shapes.leftCols(2));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  const auto swinging = [&](const std::string& more) {
    return run(
        "Beam\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, "
        "MNF_FILE=beam.fem, REULER=-90D,0,0" +
            more + "\nMARKER/21, NODE_ID=1\nJOINT/1, REVOLUTE, I=21, J=1\nEND\n",
        "LINEAR/EIGENSOL\nSTOP\n");
  };
  const RunResult rigid = swinging(", INVARIANTS=T:T:F:F:F:F:T:F:F"), whole = swinging("");
  ASSERT_EQ(rigid.status, 0) << rigid.err;
  ASSERT_EQ(whole.status, 0) << whole.err;
  ASSERT_EQ(rigid.eigenvalues(0).size(), 2u);
  EXPECT_GT(whole.eigenvalues(0).size(), 2u);
  double first = 0, second = 0;
  for (const FlexibleNode& n : body.nodes) first += n.mass * n.at.x, second += n.mass * n.at.x * n.at.x + n.own[2];
  EXPECT_NEAR(std::abs(rigid.eigenvalues(0)[0].imag()) * 2 * std::numbers::pi, std::sqrt(9.81 * first / second),
              1e-9 * std::sqrt(9.81 * first / second));
}

// Free, turning and deformed: what nothing acts on moves on with its mass centre.
TEST_F(FlexBody, nothing_accelerates_the_mass_centre_of_a_free_body) {
  const std::string dataset =
      "Dumb-bell\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n"
      "FLEX_BODY/2, MATRICES=1,2,3,4,5,6,7,8,9,10,11,12,13, CRATIO=0, QG=10,0,0, WZ=3, WY=-1, VY=-2, DMODE=0.2, "
      "VMODE=0.6\nMARKER/21, FLEX_BODY=2, NODE_ID=1\n" +
      system_test::dumb_bell_matrices + "END\n";
  const RunResult r = run(dataset, "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  for (const auto& body : r.result(0).at("operating_point").at("bodies")) {
    if (body.at("element") != "FLEX_BODY/2") continue;
    // (m1 r1 + m2 r2)/3 with z of 0.2·(-0.5) and 0.2·0.5, and their velocities v + w × r + (-0.5, 0.5) 0.6 z.
    const Vector c{2.0 / 3, 0, 0.5 * 0.2 / 3}, w{0, -1, 3};
    const Vector position = Vector{10, 0, 0} + c,
                 velocity = Vector{0, -2, 0} + cross(w, c) + Vector{0, 0, 0.5 * 0.6 / 3};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(body.at("mass_centre").at("position").at(k).get<double>(), position[k], 1e-13);
      EXPECT_NEAR(body.at("mass_centre").at("velocity").at(k).get<double>(), velocity[k], 1e-13);
      EXPECT_NEAR(body.at("mass_centre").at("acceleration").at(k).get<double>(), 0, 1e-12);
    }
    EXPECT_GT(std::abs(body.at("acceleration").at(0).get<double>()), 1);
  }
  EXPECT_THAT(r.err, HasSubstr("acceleration of its mass centre"));
}

// Coordinates relative to a marker on the flexible body: what the same expressions have, as outputs and as states.
TEST_F(FlexBody, coordinates_relative_to_a_node_go_with_its_modes) {
  const Vibration held = vibration(beam, 6);
  const ReducedBody body = reduced(beam, held.shapes.leftCols(4));
  write("beam.fem", modal_text(body.nodes, body.stiffness));
  std::string measures, list;
  int id = 0;
  for (const int of : {31, 1}) {
    for (const std::string name : {"DX", "DY", "DZ"})
      measures += fmt::format("VARIABLE/{}, FUNCTION={}({},22,22)\n", ++id, name, of);
  }
  for (int v = 1; v <= id; ++v) list += fmt::format("{}{}", v > 1 ? "," : "", v);
  const auto model = [&](const std::string& motion) {
    return "Beam\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/3, MASS=3, CM=31, IP=4,5,6, QG=2,0.3,0.1" + motion +
           "\nMARKER/31\nFLEX_BODY/2, MNF_FILE=beam.fem, CRATIO=0" +
           (motion.empty() ? "" : ", VMODE=0.8,-0.4,0.5,0.2, WZ=0.7") +
           "\nMARKER/21, FLEX_BODY=2, NODE_ID=1\nMARKER/22, FLEX_BODY=2, NODE_ID=4\n"
           "BUSHING/1, I=22, J=31, K=1E5,1E5,2E5, KT=500,600,700\nBUSHING/2, I=21, J=1, K=1E5,2E5,1E5, "
           "KT=500,600,700\n" +
           measures + "POUTPUT/1, VARIABLES=" + list + "\nPSTATE/1, VARIABLES=" + list + "\nEND\n";
  };
  const RunResult r = run(model(""), "LINEAR/STATEMAT, FILE=x, RM=22, POUTPUT=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto C = r.matrix(0, "C");
  ASSERT_EQ(C.size(), static_cast<std::size_t>(id));
  for (std::size_t row = 0; row < C.size(); ++row) {
    for (std::size_t k = 0; k < C[row].size(); ++k) {
      if (std::abs(C[row][k]) < 1e-12) continue;
      EXPECT_NEAR(C[row][k], 1, 1e-12);
      const std::string label = r.result(0).at("states").at(k).at("label");
      EXPECT_THAT(label, HasSubstr(row < 3 ? "(BCS,22,22) PART/3" : "(GROUND,22,22) FLEX_BODY/2"));
      EXPECT_THAT(label, HasSubstr(row % 3 == 0 ? "DX" : row % 3 == 1 ? "DY" : "DZ"));
    }
  }
  // In motion eigenvalues depend on the coordinates.
  const RunResult moving =
      run(model(", WZ=5, VX=2"), "LINEAR/EIGENSOL, RM=22\nLINEAR/EIGENSOL, RM=22, PSTATE=1\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(moving.status, 0) << moving.err;
  const auto relative = moving.eigenvalues(0), own = moving.eigenvalues(1), global = moving.eigenvalues(2);
  ASSERT_EQ(relative.size(), own.size());
  double largest = 0, apart = 0;
  for (std::size_t k = 0; k < own.size(); ++k) {
    largest = std::max(largest, std::abs(own[k]));
    apart = std::max(apart, std::abs(global[k] - own[k]));
  }
  for (std::size_t k = 0; k < own.size(); ++k) EXPECT_NEAR(std::abs(relative[k] - own[k]), 0, 1e-7 * largest) << k;
  EXPECT_GT(apart, 1e-4 * largest);
}

}  // namespace
}  // namespace dynalin::cases::flex_body_test
