// Expressions inside models: vectors against their components, splines against the functions they run through.
#include "cases/dataset_text.h"

namespace dynalin::cases::expression_test {
namespace {

class Expressions : public Cases {
 protected:
  // Two bodies on springs, moving, with a force and a controller made of the expression given.
  std::vector<std::complex<double>> solve(const std::string& expression, const std::string& more = "") const {
    const RunResult r = run(two_bodies("SFORCE/1, TRANSLATIONAL, I=30, J=20, FUNCTION=VARVAL(1)\n"
                                       "VARIABLE/1, FUNCTION=" +
                                       expression + "\nDIFF/1, FUNCTION=-2*DIF(1)+VARVAL(1)\n" + more),
                            "SIMULATE/INITIAL\nLINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.eigenvalues(1) : std::vector<std::complex<double>>();
  }
};

TEST_F(Expressions, vectors_are_what_their_components_are) {
  const std::pair<const char*, const char*> rows[] = {
      {"DXYZ(31,21)*VXYZ(31,21)", "DX(31,21)*VX(31,21)+DY(31,21)*VY(31,21)+DZ(31,21)*VZ(31,21)"},
      {"MAG(DXYZ(31,21)%WXYZ(30,20,21))",
       "SQRT((DY(31,21)*WZ(30,20,21)-DZ(31,21)*WY(30,20,21))**2+(DZ(31,21)*WX(30,20,21)-DX(31,21)*WZ(30,20,21))**2+(DX("
       "31,21)*WY(30,20,21)-DY(31,21)*WX(30,20,21))**2)"},
      {"UV(DXYZ(31,3))*[1,2,3]", "(DX(31,3)+2*DY(31,3)+3*DZ(31,3))/DM(31,3)"},
      {"0.1*MAG(ACCXYZ(31,21,30,20))", "0.1*SQRT(ACCX(31,21,30,20)**2+ACCY(31,21,30,20)**2+ACCZ(31,21,30,20)**2)"},
      {"0.1*FXYZ(20)*[0,1,0]+0.2*TXYZ(22,0,31)*[0,0,1]", "0.1*FY(20)+0.2*TZ(22,0,31)"},
      {"TRANS(DXYZ(31,3),21)*[1,2,3]", "DX(31,3,21)+2*DY(31,3,21)+3*DZ(31,3,21)"},
      {"TRANS(DXYZ(31,3,30),21,30)*[1,2,3]", "DX(31,3,21)+2*DY(31,3,21)+3*DZ(31,3,21)"},
      {"DXYZ(31,3)*UVY(21)", "DY(31,3,21)"},
      {"DXYZ(31,3,30)*UVX(21,30)", "DX(31,3,21)"},
      {"TRANS([1,2,3],21)*TRANS([3,-1,2],31,30)+WDTXYZ(30,20)*[0,0.1,0]",
       "([1,2,3]*[UVX(21)*[1,0,0],UVY(21)*[1,0,0],UVZ(21)*[1,0,0]])*0+TRANS([1,2,3],21)*TRANS([3,-1,2],31,30)+0.1*WDTY("
       "30,20)"},
  };
  for (const auto& [vector, scalar] : rows) {
    SCOPED_TRACE(vector);
    expect_same(solve(vector), solve(scalar), 1e-10);
  }
}

// The points of a cubic, so that CUBSPL is the cubic itself and INTERP between its points too.
// Marker 0 is the global frame, as the first argument as well.
TEST_F(Expressions, the_first_marker_may_be_the_global_frame) {
  const auto same = [&](const std::string& one, const std::string& other) {
    const auto expected = solve(other);
    ASSERT_FALSE(expected.empty()) << other;
    expect_same(solve(one), expected, 1e-10);
  };
  same("3*DX(0,20)+5*DZ(0,30)", "-3*DX(20)-5*DZ(30)");
  same("2*DM(0,20)", "2*DM(20)");
  same("2*VZ(0,30)", "-2*VZ(30)");
  same("7*DXYZ(0,30)*[0,1,0]", "-7*DY(30)");
  same("7*TRANS(DXYZ(30),0)*[0,1,0]", "7*DY(30)");
  same("4*UVZ(0,20)*UVX(0,20)+DX(20)+3*UVX(0,20)*[0,1,0]", "DX(20)+3*UVY(20)*[1,0,0]");
}

TEST_F(Expressions, splines_in_forces_are_the_functions_they_run_through) {
  std::string x = "X=", y = "Y=", y2;
  for (int k = -3; k <= 4; ++k) {
    const double p = 0.5 * k, f = 1 - 2 * p + 0.5 * p * p + 0.3 * p * p * p;
    x += fmt::format("{}{}", k > -3 ? "," : "", p), y += fmt::format("{}{:.17g}", k > -3 ? "," : "", f);
    y2 += fmt::format(",{:.17g}", 3 * f);
  }
  const std::string cubic = "(1-2*DX(31,21)+0.5*DX(31,21)**2+0.3*DX(31,21)**3)";
  expect_same(solve("CUBSPL(DX(31,21),0,7)", "SPLINE/7, " + x + ", " + y + "\n"), solve(cubic), 1e-10);
  expect_same(solve("INTERP(DX(31,21),3,7)", "SPLINE/7, " + x + ", " + y + "\n"), solve(cubic), 1e-10);
  expect_same(solve("CUBSPL(DX(31,21),0,7,1)", "SPLINE/7, " + x + ", " + y + "\n"),
              solve("-2+DX(31,21)+0.9*DX(31,21)**2"), 1e-10);
  // A family over z = 1 and 2 that grows from f to 3 f.
  std::string first = y;
  first.insert(2, "1,");
  const std::string family = "SPLINE/7, " + x + ", " + first + ", Y=2" + y2 + "\n";
  expect_same(solve("CUBSPL(DX(31,21),1.5+0.1*VX(30,20),7)", family), solve(cubic + "*(1+2*(0.5+0.1*VX(30,20)))"),
              1e-10);
  // From a file with blocks.
  std::string file = "$ measured\n[OTHER]\n0 1\n1 2\n[BUMP]\n UNITS = m\n{ x  y }\n";
  for (int k = -3; k <= 4; ++k) {
    const double p = 0.5 * k;
    file += fmt::format("{} 99 {:.17g}\n", p, 1 - 2 * p + 0.5 * p * p + 0.3 * p * p * p);
  }
  write("bump.txt", file);
  expect_same(solve("CUBSPL(DX(31,21),0,7)", "SPLINE/7, FILE=bump.txt, BLOCK=bump, CHANNEL=2\n"), solve(cubic), 1e-10);
}

TEST_F(Expressions, implicit_equations_are_what_they_can_be_solved_for) {
  const std::string u = "(DX(31,21)+0.3*VY(30,20))";
  const std::string explicit_state = "DIFF/2, IC=0.4, FUNCTION=(" + u + "-2*DIF(2))/3\n";
  expect_same(solve("DIF(2)+DIF1(2)", "DIFF/2, IMPLICIT, IC=0.4, FUNCTION=3*DIF1(2)+2*DIF(2)-" + u + "\n"),
              solve("DIF(2)+DIF1(2)", explicit_state), 1e-10);
  // Nonlinear in the rate: z′³ = u − z + 8 with z′ near 2.
  expect_same(solve("DIF(2)+DIF1(2)", "DIFF/2, IMPLICIT, IC=0.4,2, FUNCTION=DIF1(2)**3+DIF(2)-8-" + u + "\n"),
              solve("DIF(2)+DIF1(2)", "DIFF/2, IC=0.4, FUNCTION=(8+" + u + "-DIF(2))**(1/3)\n"), 1e-10);
  // Two equations that share both rates.
  expect_same(solve("DIF(2)+DIF1(3)", "DIFF/2, IMPLICIT, FUNCTION=DIF1(2)+DIF1(3)+DIF(2)-" + u +
                                          "\nDIFF/3, IMPLICIT, FUNCTION=DIF1(2)-2*DIF1(3)-DIF(3)\n"),
              solve("DIF(2)+DIF1(3)", "DIFF/2, FUNCTION=(2*(" + u + "-DIF(2))+DIF(3))/3\nDIFF/3, FUNCTION=((" + u +
                                          "-DIF(2))-DIF(3))/3\n"),
              1e-10);
}

TEST_F(Expressions, algebraic_equations_add_no_state_and_know_their_rate) {
  const std::string x = "DX(31,21)", v = "VX(31,21,21,21)";
  const auto plain = solve("0.3*" + x + "**2");
  expect_same(solve("DIF(2)", "DIFF/2, IMPLICIT, FUNCTION=DIF(2)-0.3*" + x + "**2\n"), plain, 1e-10);
  // DX in the axes of a marker that turns: its rate is not VX in the ground.
  const std::string own = "DX(31,21,21)";
  expect_same(
      solve("DIF1(2)", "DIFF/2, IMPLICIT, IC=0.5, FUNCTION=DIF(2)**2+DIF(2)-" + own + "-0.5*TIME\n"),
      solve("(" + v + "+0.5)/(2*VARVAL(2)+1)", "VARIABLE/2, IC=0.5, FUNCTION=(" + own + "+0.5*TIME)/(VARVAL(2)+1)\n"),
      1e-9);
  // Through a variable, another algebraic equation and a state.
  expect_same(solve("DIF1(3)", "VARIABLE/2, FUNCTION=" + own +
                                   "**2\nDIFF/2, IMPLICIT, FUNCTION=DIF(2)-VARVAL(2)-3*DIF(1)\n"
                                   "DIFF/3, IMPLICIT, FUNCTION=2*DIF(3)-DIF(2)\n"),
              solve("0.5*(2*" + own + "*" + v + "+3*DIF1(1))"), 1e-9);
  // A velocity: its rate is an acceleration.
  expect_same(solve("0.1*DIF1(2)", "DIFF/2, IMPLICIT, FUNCTION=DIF(2)-VR(31,21)**2\n"),
              solve("0.2*VR(31,21)*(VXYZ(31,21)*VXYZ(31,21)+DXYZ(31,21)*ACCXYZ(31,21)-VR(31,21)**2)/DM(31,21)"), 1e-9);
}

TEST_F(Expressions, a_rate_that_is_not_known_is_an_error_that_names_it) {
  const RunResult r =
      run("x\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
          "DIFF/2, IMPLICIT, FUNCTION=DIF(2)-ACCX(20)\nDIFF/3, FUNCTION=DIF1(2)\nEND\n",
          "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.err.find("ACCX(20)"), std::string::npos) << r.err;
  EXPECT_FALSE(r.wrote("model.msg"));
}

TEST_F(Expressions, entries_that_do_not_exist_are_errors) {
  const std::string base = "ARRAY/1, IC, NUMBERS=1,2\nARRAY/2, X\nPINPUT/1, VARIABLES=1\nVARIABLE/1, FUNCTION=";
  for (const char* atom : {"ARYVAL(1,3)", "ARYVAL(2,1)", "PINVAL(1,2)"}) {
    const RunResult r = run(two_bodies(base + atom + "\n"), "LINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 1) << atom;
    EXPECT_NE(r.err.find(atom), std::string::npos) << r.err;
    EXPECT_FALSE(r.wrote("model.msg"));
  }
}

}  // namespace
}  // namespace dynalin::cases::expression_test
