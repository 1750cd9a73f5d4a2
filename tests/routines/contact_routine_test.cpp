// Normal force and friction of a CONTACT by compiled routines: against the laws of the statement, in C, Fortran and by
// formulas that are differentiated; and what goes wrong.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "routines/with_libraries.h"

namespace dynalin::cases::contact_routine_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string head = "Contact\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1, REULER=0.3,0,0\n";
const std::string floor = "GRAPHICS/1, PLANE, RM=1, XMIN=-9, XMAX=9, YMIN=-9, YMAX=9\n";
// A ball that rolls, slips and spins, lower than its radius.
const std::string ball =
    "PART/2, MASS=2, CM=2, IP=0.008,0.01,0.012, QG=0.1,0.05,0.096, VX=0.3, VZ=-0.02, WY=0.5, WZ=0.4\nMARKER/2, "
    "REULER=0.2,0.4,0.1\nGRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n";
const std::string model = head + floor + ball;
const std::string impact = "IMPACT, STIFFNESS=2E4, EXPONENT=1.5, DAMPING=40, DMAX=0.001";
const std::string coulomb =
    "COULOMB_FRICTION=ON, MU_STATIC=0.4, MU_DYNAMIC=0.3, STICTION_TRANSITION_VELOCITY=0.2, "
    "FRICTION_TRANSITION_VELOCITY=0.5";
const std::string between = "CONTACT/1, IGEOM=2, JGEOM=1, ";
const std::string normal = "NFUNCTION=USER(2E4,1.5,40,0.001)", friction = "FFUNCTION=USER(0.4,0.3,0.2,0.5,0)";

class ContactRoutines : public WithLibraries {
 protected:
  RunResult with(const std::string& dataset, bool differences = false,
                 const std::vector<std::string>& commands = {"LINEAR/EIGENSOL"}) const {
    return WithLibraries::with(dataset, {C_CONTACT, CPP_ROUTINES}, differences, commands);
  }
};

TEST_F(ContactRoutines, are_the_laws_of_the_statement) {
  const std::vector<std::string> all = {normal + ", " + coulomb, impact + ", " + friction, normal + ", " + friction};
  const std::string by_formula = ", NROUTINE=formulas::pressure_by_formula",
                    slip_by_formula = ", FROUTINE=formulas::friction_by_formula";
  const RunResult written = with(model + between + impact + ", " + coulomb + "\n");
  // Slipping at 0.3 less 0.1 · 0.5, at the speed of rising friction, and at rest.
  for (const std::string motion : {"VX=0.3", "VX=0.12", "VX=0.9", "VX=0.05"}) {
    std::string moved = model;
    moved.replace(moved.find("VX=0.3"), 6, motion);
    const RunResult law = with(moved + between + impact + ", " + coulomb + "\n");
    expect_same(with(moved + between + normal + by_formula + ", " + coulomb + "\n"), law, 1e-12);
    expect_same(with(moved + between + impact + ", " + friction + slip_by_formula + "\n"), law, 1e-12);
    expect_same(with(moved + between + normal + by_formula + ", " + friction + slip_by_formula + "\n"), law, 1e-12);
    for (const std::string& called : all) expect_same(with(moved + between + called + "\n", true), law, 1e-8);
  }
  // Whatever the rest does: with friction the eigenvalues are others.
  const RunResult without = with(model + between + impact + "\n");
  ASSERT_EQ(without.eigenvalues(0).size(), written.eigenvalues(0).size());
  double off = 0;
  for (std::size_t k = 0; k < without.eigenvalues(0).size(); ++k)
    off = std::max(off, std::abs(without.eigenvalues(0)[k] - written.eigenvalues(0)[k]));
  EXPECT_GT(off, 0.1);
}

// Strain and dissipation of a routine that is the law of the statement are those of the law, mode by mode.
TEST_F(ContactRoutines, have_their_rows_in_tables_of_energy) {
  const std::string held = model + "BUSHING/1, I=2, J=1, K=50,60,70, KT=1,2,3, C=0.1,0.1,0.1, CT=0.01,0.01,0.01\n",
                    formulas = ", NROUTINE=formulas::pressure_by_formula, " + friction +
                               ", FROUTINE=formulas::friction_by_formula\n";
  const std::vector<std::string> tables = {"LINEAR/EIGENSOL, STRAIN=1,6, DISSIPAT=1,6"};
  const auto shares = [&](const std::string& contact) {
    const RunResult r = with(held + between + contact, false, tables);
    EXPECT_EQ(r.status, 0) << r.err;
    std::map<std::string, std::vector<double>> of_table;
    if (r.json.is_null()) return of_table;
    for (const auto& table : r.result(0).at("tables")) {
      for (const auto& row : table.at("rows")) {
        if (row.value("element", "") != "CONTACT/1") continue;
        auto& all = of_table[table.at("table").get<std::string>()];
        for (const auto& share : row.at("values")) all.push_back(share.get<double>());
      }
    }
    return of_table;
  };
  const auto law = shares(impact + ", " + coulomb + "\n"), called = shares(normal + formulas);
  for (const std::string table : {"STRAIN", "DISSIPAT"}) {
    ASSERT_TRUE(law.contains(table) && called.contains(table)) << table;
    const std::vector<double>&expected = law.at(table), &found = called.at(table);
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_GT(*std::ranges::max_element(expected), 1) << table;  // of a hundred
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_NEAR(found[k], expected[k], 1e-9 * (1 + std::abs(expected[k]))) << table << k;
  }
}

// From a fall to rest, and linear there: equilibria and motions need no derivatives of the routine.
TEST_F(ContactRoutines, lead_to_the_same_motion_and_equilibrium) {
  const std::string more =
      "BUSHING/1, I=2, J=1, K=5,5,5, C=1,1,1, KT=3,3,3, CT=0.1,0.1,0.1\nREQUEST/1, F2=DX(2,1)\\F3="
      "DZ(2,1)\\F4=CONTACT(1,0,2,1)\\F6=CONTACT(1,0,4,1)\\F7=CONTACT(1,0,6,1)\n";
  const std::vector<std::string> commands = {"SIMULATE/TRANSIENT, END=0.2, STEPS=10", "SIMULATE/INITIAL",
                                             "SIMULATE/STATICS", "LINEAR/EIGENSOL"};
  std::string start = model;
  start.replace(start.find("0.096"), 5, "0.15 ");
  const RunResult law = with(start + between + impact + ", " + coulomb + "\n" + more, false, commands);
  ASSERT_EQ(law.status, 0) << law.err;
  const std::string formulas = ", NROUTINE=formulas::pressure_by_formula, ";
  std::vector<RunResult> called = {
      with(start + between + normal + formulas + friction + ", FROUTINE=formulas::friction_by_formula\n" + more, false,
           commands),
      with(start + between + normal + ", " + friction + "\n" + more, true, commands)};
#ifdef FORTRAN_CONTACT
  called.push_back(
      WithLibraries::with(start + between + normal + ", " + friction + "\n" + more, {FORTRAN_CONTACT}, true, commands));
#endif
  for (const RunResult& r : called) {
    ASSERT_EQ(r.status, 0) << r.err;
    for (const std::size_t at : {1u, 2u}) {
      const auto a = requested(r, at), b = requested(law, at);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-4 * (1 + std::abs(b[k]))) << at << " " << k;
    }
    expect_same(r, law, 1e-7, 3);
  }
}

// Friction that turns about the normal brakes the spin of a ball as a torque in the opposite direction would.
TEST_F(ContactRoutines, may_brake_the_spin) {
  const std::string drill = "FFUNCTION=USER(0.4,0.3,0.2,0.5,0.05)";
  const std::string torque = "MARKER/9, PART=1, FLOATING\nVTORQUE/1, I=2, JFLOAT=9, RM=1, TZ=-0.05*WZ(2,1,1)\\\n";
  const RunResult written = with(model + between + impact + ", " + coulomb + "\n" + torque);
  expect_same(with(model + between + impact + ", " + drill + ", FROUTINE=formulas::friction_by_formula\n"), written,
              1e-12);
}

// A ball that has turned about x of the floor's normal: what the routine is told of places and normals is where they
// are, which a force on the centre says in other words.
TEST_F(ContactRoutines, are_told_the_places_and_normals) {
  const RunResult r =
      with(model + between + "NFUNCTION=USER(3E3), NROUTINE=contact::places\n" +
               "VARIABLE/1, FUNCTION=0.1-DZ(2,1,1)\n"  // penetration
               // From I's marker along its axes to 0.1 below it, and of the marker of J.
               "VARIABLE/2, FUNCTION=-0.1*UVX(2,1)*[0,0,1]\nVARIABLE/3, FUNCTION=-0.1*UVZ(2,1)*[0,0,1]\n"
               "REQUEST/1, F2=CONTACT(1,0,4,1)\\F3=3E3*VARVAL(1)/(1+VARVAL(2)**2+DX(2,1,1)**2)-3*UVX(2,1)"
               "*[0,0,1]+2+VARVAL(3)+DY(2,1,1)\n",
           false, {"SIMULATE/INITIAL"});
  const auto values = requested(r, 0);
  ASSERT_GE(values.size(), 2u);
  EXPECT_GT(std::abs(values[0]), 5);
  EXPECT_NEAR(values[0], values[1], 1e-11 * std::abs(values[1]));
  // Differences and derivatives agree.
  expect_same(with(model + between + "NFUNCTION=USER(3E3), NROUTINE=contact::places\n", true),
              with(model + between + "NFUNCTION=USER(3E3), NROUTINE=formulas::places_by_formula\n"), 1e-8);
}

// Shapes on either side, one of them a cavity; the marker of a second shape is its own.
TEST_F(ContactRoutines, say_what_the_statement_says) {
  const std::string shapes =
      head +
      "GRAPHICS/1, BOX, CORNER=1, X=2, Y=2, Z=2\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0.3,0.4,0.095\nMARKER/20\n"
      "MARKER/2\nMARKER/3, QP=0.5,0,0.001, REULER=0.1,0.2,0.3\n"
      "GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n"
      "GRAPHICS/3, ELLIPSOID, CM=3, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\n";
  std::string turned = shapes;
  turned.replace(turned.find(", REULER=0.3,0,0"), 16, "");
  const std::string both = "CONTACT/1, IGEOM=2,3, JGEOM=1, JFLIP_GEOMETRY=1, ";
  const RunResult law = with(turned + both + impact + ", " + coulomb + "\n");
  expect_same(
      with(turned + both + normal + ", NROUTINE=contact::Normalc, " + friction + ", FROUTINE=Frictionc\n", true), law,
      1e-8);
  // Told of its own marker: a law of the place on the second shape is that of it alone.
  const std::string one = "CONTACT/1, IGEOM=3, JGEOM=1, JFLIP_GEOMETRY=1, ";
  const std::string second = "NFUNCTION=USER(3E3), NROUTINE=formulas::places_by_formula\n";
  std::string only_second = turned;
  only_second.replace(only_second.find("MARKER/2\n"), 9, "MARKER/2, QP=0,0,0.3\n");
  expect_same(with(only_second + both + second), with(only_second + one + second), 1e-12);
}

TEST_F(ContactRoutines, without_derivatives_are_refused_in_linear_models_unless_differences_are_asked_for) {
  for (const std::string& called : {normal + ", " + coulomb, impact + ", " + friction}) {
    const RunResult refused = with(model + between + called + "\n");
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err,
                AllOf(HasSubstr("[differenced-routine]"), HasSubstr("CONTACT/1: the routine c"),
                      HasSubstr("an entry with them, or --difference-user-routines"), Not(HasSubstr("c_syspar"))));
    const RunResult differenced = with(model + between + called + "\n", true);
    ASSERT_EQ(differenced.status, 0) << differenced.err;
    // But for what is zero by structure.
    const auto modes = differenced.result(0).at("modes");
    EXPECT_TRUE(std::ranges::any_of(modes, [](const auto& m) { return m.at("error_bound_hz").is_null(); }));
  }
}

TEST_F(ContactRoutines, that_cannot_be_say_why) {
  const auto said = [&](const std::string& law, int status, const std::string& what = model) {
    const RunResult r = with(what + between + law + "\n", true);
    EXPECT_EQ(r.status, status) << r.err;
    return r.err;
  };
  EXPECT_THAT(said("NFUNCTION=USER(3E3), NROUTINE=uses_area", 2),
              AllOf(HasSubstr("CONTACT/1: the routine uses_area"), HasSubstr("GAPDOTDOT and AREA are not known")));
  EXPECT_THAT(said(impact + ", FFUNCTION=USER(3E3), FROUTINE=deforms", 2),
              AllOf(HasSubstr("CONTACT/1: the routine deforms"), HasSubstr("X and AREA are not known")));
  EXPECT_THAT(said("NFUNCTION=USER(3E3), NROUTINE=three_values", 2),
              AllOf(HasSubstr("CONTACT/1"), HasSubstr("gives 1 and 0 behind its first value")));
  EXPECT_THAT(said("NFUNCTION=USER(3E3), NROUTINE=asks_for_more", 1),
              AllOf(HasSubstr("[routine-failed]"), HasSubstr("DM(2, 1)"), HasSubstr("CONTACT/1")));
  std::string still = model;
  still.replace(still.find("VX=0.3, VZ=-0.02, WY=0.5, WZ=0.4"), 32, "");
  EXPECT_THAT(said(impact + ", FFUNCTION=USER(0.3), FROUTINE=pushes_at_rest", 2, still),
              AllOf(HasSubstr("CONTACT/1"), HasSubstr("where nothing slips, and it has no direction")));
  EXPECT_THAT(said("NFUNCTION=USER(3E3), NROUTINE=nobody", 1), HasSubstr("[missing-routine]"));
  EXPECT_THAT(said("NFUNCTION=3*TIME", 1), AllOf(HasSubstr("[unknown-word]"), HasSubstr("USER(")));
  EXPECT_THAT(said(normal + ", " + impact, 1), HasSubstr("IMPACT of CONTACT/1 goes with no NFUNCTION"));
  EXPECT_THAT(said(impact + ", " + coulomb + ", " + friction, 1),
              HasSubstr("COULOMB_FRICTION of CONTACT/1 goes with no FFUNCTION"));
  EXPECT_THAT(said(impact + ", NROUTINE=cnfsub", 1), HasSubstr("calls none with USER("));
}

}  // namespace
}  // namespace dynalin::cases::contact_routine_test
