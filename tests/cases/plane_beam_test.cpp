// Beams of finite elements that stay in a plane: discrete values of closed form, large deflections, and the beam in
// space that is held there.
#include <dynalin/study.h>
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "cases/fe_parts.h"
#include "cases/modal_sums_cases.h"
#include "cases/study_of.h"

namespace dynalin::cases::plane_beam_test {
namespace {

constexpr double pi = std::numbers::pi;

// A beam along the first axis of its plane, its first node at a marker of ground of its own axes.
struct Plane {
  const char *type, *axes;
  std::size_t first, second, normal;
};
constexpr std::array<Plane, 3> planes = {{{"2DBEAMXY", "REULER=0,0,0", 0, 1, 2},
                                          {"2DBEAMYZ", "REULER=90D,90D,0", 1, 2, 0},
                                          {"2DBEAMZX", "REULER=0,90D,90D", 2, 0, 1}}};

StraightBeam plane_beam(int elements, const Plane& plane = planes[0], const std::string& further = "") {
  return {.elements = elements,
          .height = 0.01,
          .width = 0.02,
          .further = fmt::format(", QG=0.3,-0.2,0.5, {}{}", plane.axes, further),
          .type = plane.type};
}
// Clamped at MARKER/3 of ground; its tip is MARKER/22.
std::string clamped(int elements, const Plane& plane, const std::string& statements = "",
                    const std::string& further = "") {
  return beam_model(plane_beam(elements, plane, further).text() +
                    fmt::format("MARKER/3, PART=1, QP=0.3,-0.2,0.5, {}\nJOINT/1, FIXED, I=21, J=3\n", plane.axes) +
                    statements);
}

std::vector<double> frequencies(const library::LinearModel& linear) {
  std::vector<double> all;
  for (const EigenMode& m : linear.modes(library::ModeShapes::left_out).modes) {
    if (m.eigenvalue_hz.imag() > 0) all.push_back(2 * pi * m.eigenvalue_hz.imag());
  }
  std::ranges::sort(all);
  return all;
}
std::vector<double> frequencies(const std::string& dataset) { return frequencies(study_of(dataset).linearize()); }

// Elements of the cubic with places and slopes, EI, EA and the mass by length 1.
struct Cubics {
  Eigen::MatrixXd bending, stretch, mass;
  explicit Cubics(int elements) {
    const double l = 1.0 / elements;
    const Eigen::Index n = 2 * elements + 2;
    bending = stretch = mass = Eigen::MatrixXd::Zero(n, n);
    Eigen::Matrix4d k, t, m;
    k << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l, -6 * l,
        4 * l * l;
    t << 36, 3 * l, -36, 3 * l, 3 * l, 4 * l * l, -3 * l, -l * l, -36, -3 * l, 36, -3 * l, 3 * l, -l * l, -3 * l,
        4 * l * l;
    m << 156, 22 * l, 54, -13 * l, 22 * l, 4 * l * l, 13 * l, -3 * l * l, 54, 13 * l, 156, -22 * l, -13 * l, -3 * l * l,
        -22 * l, 4 * l * l;
    for (Eigen::Index e = 0; e < elements; ++e) {
      bending.block<4, 4>(2 * e, 2 * e) += k / (l * l * l);
      stretch.block<4, 4>(2 * e, 2 * e) += 1 / (30 * l) * t;
      mass.block<4, 4>(2 * e, 2 * e) += l / 420 * m;
    }
  }
};
// At a clamp place and slope across are held, along the beam the place alone.
constexpr Eigen::Index held_across = 2, held_along = 1;

std::vector<double> discrete_frequencies(int elements, double EA) {
  const Cubics c(elements);
  std::vector<double> all;
  const auto add = [&](const Eigen::MatrixXd& K, Eigen::Index held) {
    const Eigen::Index n = K.rows() - held;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K.bottomRightCorner(n, n),
                                                                           c.mass.bottomRightCorner(n, n));
    for (const double x : solver.eigenvalues()) all.push_back(std::sqrt(x));
  };
  add(c.bending, held_across), add(EA * c.stretch, held_along);
  std::ranges::sort(all);
  return all;
}
// What of the mass all modes together move as a base does.
double discrete_mass(int elements, Eigen::Index held) {
  const Cubics c(elements);
  Eigen::VectorXd base = Eigen::VectorXd::Zero(c.mass.rows());
  for (Eigen::Index k = 0; k < base.size(); k += 2) base(k) = 1;
  const Eigen::Index n = base.size() - held;
  const Eigen::VectorXd L = c.mass.bottomRows(n) * base;
  return L.dot(c.mass.bottomRightCorner(n, n).llt().solve(L));
}

// Its in-plane coordinates along the axes of the plane.
std::array<double, 2> in(const Plane& p, const Triple& v) { return {v[p.first], v[p.second]}; }
std::array<double, 2> tip(const Plane& p, const library::OperatingPoint& point) {
  const auto at = in(p, point.marker(22).position), from = in(p, point.marker(3).position);
  return {at[0] - from[0], at[1] - from[1]};
}

std::string component(const char* kind, std::size_t axis, double value) {
  return fmt::format("{}{}={:.17g}", kind, "XYZ"[axis], value);
}

}  // namespace

// One element has 3.53273 and 34.8069 (3.51602 and 22.0345 in the limit): what the cubic with a consistent mass has.
TEST(PlaneBeam, clamped_has_the_frequencies_of_the_cubic_in_every_plane) {
  // About the normal the section has EI = 1 where the normal is z of the section, else that of the width.
  for (const Plane& plane : planes) {
    for (const int n : {1, 2, 5}) {
      const StraightBeam beam = plane_beam(n, plane);
      const std::vector<double> found = frequencies(clamped(n, plane)),
                                expected = discrete_frequencies(n, beam.modulus() * beam.area());
      ASSERT_EQ(found.size(), expected.size()) << plane.type;
      for (std::size_t k = 0; k < found.size(); ++k)
        EXPECT_NEAR(found[k], expected[k], 1e-8 * expected[k]) << plane.type << ' ' << k;
    }
  }
  EXPECT_NEAR(frequencies(clamped(1, planes[0]))[0], 3.53273, 5e-6);
  EXPECT_NEAR(frequencies(clamped(1, planes[0]))[1], 34.8069, 5e-5);
}

// The second moment about the normal counts: sections turned about the beam bend about other axes of theirs.
TEST(PlaneBeam, bends_about_the_normal_of_its_plane) {
  const auto first = [](double roll) {
    return frequencies(clamped(2, planes[0], "", fmt::format(", THETA={:.17g}, IYZ=2E-9", roll)))[0];
  };
  const StraightBeam beam = plane_beam(2);
  const double straight = first(0);
  for (const double roll : {0.3, pi / 2, 2.0}) {
    const double y = std::sin(roll), z = std::cos(roll), I = z * z * beam.zz() + y * y * beam.yy() - 2 * y * z * 2e-9;
    EXPECT_NEAR(first(roll) / straight, std::sqrt(I / beam.zz()), 1e-9) << roll;
  }
}

TEST(PlaneBeam, free_in_its_plane_it_has_six_zeros) {
  const auto linear = study_of(beam_model(plane_beam(4).text())).linearize();
  std::size_t zeros = 0;
  for (const EigenMode& m : linear.modes(library::ModeShapes::left_out).modes)
    zeros += m.eigenvalue_hz == std::complex<double>(0);
  EXPECT_EQ(zeros, 6u);
  EXPECT_NEAR(frequencies(linear)[0], 4.73004074 * 4.73004074, 2e-3 * 22);
}

TEST(PlaneBeam, an_end_moment_rolls_it_up_into_a_circle) {
  for (const Plane& plane : planes) {
    const auto dataset = [&](double load) {
      return clamped(4, plane,
                     "VTORQUE/1, I=22, JFLOAT=2, RM=1, " + component("T", plane.normal, 2 * pi * load) + "\n");
    };
    const auto point = loaded(dataset, 8);
    EXPECT_NEAR(tip(plane, point)[0], 0, 1e-9) << plane.type;
    EXPECT_NEAR(tip(plane, point)[1], 0, 1e-9) << plane.type;
    EXPECT_NEAR(point.marker(22).axes[0][plane.first], 1, 1e-9);
  }
}

// Inextensible elastica under a dead force of 10 EI/L² at its tip; published tables.
TEST(PlaneBeam, a_dead_force_bends_it_into_the_elastica) {
  const Plane& plane = planes[1];
  const auto dataset = [&](double load) {
    return clamped(8, plane, "VFORCE/1, I=22, JFLOAT=2, RM=1, " + component("F", plane.second, 10 * load) + "\n");
  };
  const auto at = tip(plane, loaded(dataset, 4));
  EXPECT_NEAR(at[0], 0.445004, 2e-4);
  EXPECT_NEAR(at[1], 0.810609, 2e-4);
}

// Slender and far bent: a beam in space whose nodes are held in the plane, stiff against shear, is the same.
TEST(PlaneBeam, far_bent_is_the_beam_in_space_that_is_held_in_the_plane) {
  constexpr int n = 6;
  const std::string force = "VFORCE/1, I=22, JFLOAT=2, RM=1, FX=-2, FY=4\n";
  StraightBeam space = plane_beam(n);
  space.type = "3DBEAM", space.further += ", ASY=1E-3, ASZ=1E-3";
  std::string held =
      beam_model(space.text() + "MARKER/3, PART=1, QP=0.3,-0.2,0.5\nJOINT/1, FIXED, I=21, J=3\n" + force);
  std::string primitives;
  for (int k = 2; k <= n + 1; ++k) {
    primitives +=
        fmt::format("MARKER/{0}, FE_PART=2, NODE_LABEL={1}, QP={2:.17g},0,0\nJPRIM/{1}, INPLANE, I={0}, J=3\n", 30 + k,
                    k, (k - 1.0) / n);
    primitives += fmt::format("JPRIM/{1}, PARALLEL_AXES, I={0}, J=3\n", 30 + k, 100 + k);
  }
  held.insert(held.rfind("END"), primitives);
  const auto at_rest = [](const std::string& dataset) {
    const auto study = study_of(dataset);
    const auto point = study.static_equilibrium();
    return std::pair(point.marker(22).position, frequencies(study.linearize(point)));
  };
  const auto plane = at_rest(clamped(n, planes[0], force)), there = at_rest(held);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(plane.first[k], there.first[k], 1e-4) << k;
  EXPECT_GT(plane.first[1], 0.4);
  for (std::size_t k = 0; k < 3; ++k) {
    double nearest = 1e300;  // of those, which may also move out of the plane between the nodes
    for (const double x : there.second) nearest = std::min(nearest, std::abs(x - plane.second[k]));
    EXPECT_LT(nearest, 2e-3 * plane.second[k]) << k;
  }
}

TEST(PlaneBeam, is_damped_by_its_stiffness) {
  const double undamped = frequencies(clamped(2, planes[0]))[0];
  std::vector<double> real;
  for (const EigenMode& m :
       study_of(clamped(2, planes[0], "", ", CRATIO=0.002")).linearize().modes(library::ModeShapes::left_out).modes) {
    if (!m.is_real) real.push_back(-2 * pi * m.eigenvalue_hz.real());
  }
  EXPECT_NEAR(*std::ranges::min_element(real), 0.001 * undamped * undamped, 1e-7);
}

// Weight as a load along it; moments along it add up, whatever its shape.
TEST(PlaneBeam, carries_loads_along_it) {
  const Plane& plane = planes[2];
  const auto along = study_of(clamped(3, plane, "FE_LOAD/1, FE_PART=2, FX=3\n")),
             weight = study_of(clamped(3, plane, "ACCGRAV/IGRAV=3\n"));
  const auto a = along.static_equilibrium(), b = weight.static_equilibrium();
  EXPECT_GT(tip(plane, a)[1], 0.3);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(tip(plane, a)[k], tip(plane, b)[k], 1e-9);
  EXPECT_NEAR(a.load({"JOINT", 1}).force[0], -3, 1e-8);
  const std::vector<double> of_a = frequencies(along.linearize(a)), of_b = frequencies(weight.linearize(b));
  for (std::size_t k = 0; k < of_a.size(); ++k) EXPECT_NEAR(of_a[k], of_b[k], 1e-9 * of_b[k]);

  const double EI = plane_beam(3, plane).modulus() * plane_beam(3, plane).zz();
  const auto bent = study_of(clamped(3, plane, "FE_LOAD/1, FE_PART=2, TY=1.2\n")).static_equilibrium();
  EXPECT_NEAR(bent.marker(22).axes[0][0], std::sin(0.6 / EI), 1e-6);
  EXPECT_NEAR(bent.load({"JOINT", 1}).torque[1], -1.2, 1e-9);
}

// It turns about a hinge as the rod that it is, and stays in its plane.
TEST(PlaneBeam, swings_like_a_rigid_rod) {
  const std::string hinge = "ACCGRAV/JGRAV=-9.81\nMARKER/3, PART=1\nJOINT/1, REVOLUTE, I=21, J=3\n";
  const StraightBeam beam{
      .elements = 2, .height = 0.05, .width = 0.05, .E = 2e9, .density = 2000, .further = ", WZ=2", .type = "2DBEAMXY"};
  const double m = 2000 * 0.0025, J = m / 12;
  const std::string rod = fmt::format(
      "PART/2, MASS={0:.17g}, CM=20, IP={1:.17g},{1:.17g},{1:.17g}, WZ=2, VY=1\nMARKER/20, QP=0.5,0,0\n"
      "MARKER/21\nMARKER/22, QP=1,0,0\n",
      m, J);
  const auto end = [&](const std::string& body) {
    return study_of(beam_model(body + hinge)).simulate({.end = 0.7, .error = 1e-6}).point.marker(22).position;
  };
  const Triple a = end(beam.text()), b = end(rod);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 2e-3) << k;
  EXPECT_NEAR(a[2], 0, 1e-10);
}

class PlaneBeamFiles : public ModalSumCases {};

TEST_F(PlaneBeamFiles, states_are_places_and_slopes_in_the_plane) {
  for (const std::string original : {"", ", ORIGINAL"}) {
    const RunResult r =
        run(clamped(1, planes[1]), "LINEAR/EIGENSOL" + original + "\nLINEAR/STATEMAT, FILE=m" + original + "\n");
    ASSERT_EQ(r.status, 0) << r.err;
    std::vector<std::string> states;
    std::vector<int> types;
    for (const auto& s : r.result(1).at("states")) {
      if (!s.at("label").get<std::string>().starts_with("derivative")) states.push_back(s.at("label"));
      types.push_back(s.at("type"));
    }
    EXPECT_THAT(types, ::testing::Each(27)) << original;
    std::ranges::sort(states);
    EXPECT_THAT(states,
                ::testing::ElementsAre("Global displacement DY(node 2) FE_PART/2",
                                       "Global displacement DZ(node 2) FE_PART/2", "Slope SY of node 1 FE_PART/2",
                                       "Slope SY of node 2 FE_PART/2", "Slope SZ of node 2 FE_PART/2"));
  }
}

TEST_F(PlaneBeamFiles, effective_masses_and_energies_are_whole) {
  const std::string model = clamped(2, planes[0]);
  const std::string text = tables(model, "MASS_PER_MODE=ALL");
  const std::vector<double> sums = row(text, "Modal effective mass", "Sum");
  EXPECT_NEAR(sums[0], discrete_mass(2, held_along), 1e-6);
  EXPECT_NEAR(sums[1], discrete_mass(2, held_across), 1e-6);
  EXPECT_GT(sums[1], 0.8);
  const RunResult r = run(model, "LINEAR/EIGENSOL, KINETIC=1, STRAIN=1\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.text("model.txt").find("FE_P/2       | 100.00"), std::string::npos) << r.text("model.txt");
}

TEST_F(PlaneBeamFiles, says_which_arguments_have_no_influence) {
  const RunResult r = run(clamped(1, planes[0], "", ", IXX=1E-8, ASY=2"), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.err.find("IXX, ASY of FE_PART/2 have no influence"), std::string::npos) << r.err;
}

}  // namespace dynalin::cases::plane_beam_test
