// Datasets and command files as programs and people of several decades write them, each beside a twin that says the
// same in the plainest way. Their eigenvalues must agree: a misread number or word would show.
#include <gtest/gtest.h>

#include "cases/dataset_text.h"
#include "cases/run.h"

namespace dynalin::cases::written_twins_test {
namespace {

struct Twins {
  const char* name;
  std::string dataset, commands;  // as somebody wrote it
  std::string plain_dataset, plain_commands;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

const std::string eigensol = "model\nout\nLINEAR/EIGENSOL\nSTOP\n";
const std::string statics_first = "model\nout\nSIMULATE/STATICS\nLINEAR/EIGENSOL\nSTOP\n";

// A body on two bushings that stand askew, with everything that may be misread: angles, products of inertia, points.
const std::string plain_body = R"(plain
UNITS/SYSTEM=MKS
ACCGRAV/KGRAV=-9.81
PART/1, GROUND
MARKER/101, PART=1, QP=0.5,-0.25,0, REULER=0.52359877559829882,1.0471975511965976,0
MARKER/102, PART=1, QP=-0.5,0.25,0
PART/2, MASS=12.5, CM=200, IP=0.4,0.5,0.3,0.02,-0.01,0.03, QG=0,0,0.75, REULER=0.34906585039886590,0,0
MARKER/200, PART=2, QP=0.01,0.02,0.03
MARKER/201, PART=2, QP=0.5,0.25,-0.75, REULER=0.52359877559829882,1.0471975511965976,0
MARKER/202, PART=2, QP=-0.5,-0.25,-0.75, REULER=-0.34906585039886590,0,0
BUSHING/1, I=201, J=101, K=4000,5000,6000, KT=70,80,90, C=4,5,6, CT=0.7,0.8,0.9
BUSHING/2, I=202, J=102, K=3000,3500,20000, KT=10,20,30, C=1,2,3, CT=0,0,0
END
)";

const std::string column_export = R"(CARD IMAGE OF RUN 0042
UNITS/SYSTEM=MKS
ACCGRAV/                                      KGRAV=  -9.8100000E+00
PART/0001,    GROUND
MARKER/0101,  PART=0001, QP=   5.0000000E-01,
,                             -2.5000000E-01,
,                              0.0000000E+00
,             REULER=  30.0D ,  60.0D ,  0.0D
MARKER/0102,  PART=0001, QP=  -5.0000000E-01,
,                              2.5000000E-01,
,                              0.0000000E+00
PART/0002,    MASS=   1.2500000E+01, CM=0200
,             IP=     4.0000000E-01,
,                     5.0000000E-01,
,                     3.0000000E-01,
,                     2.0000000E-02,
,                    -1.0000000E-02,
,                     3.0000000E-02
,             QG=     0.0000000E+00, 0.0000000E+00, 7.5000000E-01
,             REULER= 20.0D, 0.0D, 0.0D
MARKER/0200,  PART=0002, QP=   1.0000000E-02, 2.0000000E-02, 3.0000000E-02
MARKER/0201,  PART=0002, QP=   5.0000000E-01, 2.5000000E-01,-7.5000000E-01
,             REULER=  30.0D ,  60.0D ,  0.0D
MARKER/0202,  PART=0002, QP=  -5.0000000E-01,-2.5000000E-01,-7.5000000E-01
,             REULER= -20.0D ,   0.0D ,  0.0D
BUSHING/0001, I=0201, J=0101
,             K=      4.0000000E+03, 5.0000000E+03, 6.0000000E+03
,             KT=     7.0000000E+01, 8.0000000E+01, 9.0000000E+01
,             C=      4.0000000E+00, 5.0000000E+00, 6.0000000E+00
,             CT=     7.0000000E-01, 8.0000000E-01, 9.0000000E-01
BUSHING/0002, I=0202, J=0102
,             K=      3.0000000E+03, 3.5000000E+03, 2.0000000E+04
,             KT=     1.0000000E+01, 2.0000000E+01, 3.0000000E+01
,             C=      1.0000000E+00, 2.0000000E+00, 3.0000000E+00
,             CT=     3*0.0
END
)";

const std::string commented_export = R"(Adams View model name: body_on_bushings
!
!-------------------------------- SYSTEM UNITS ---------------------------------
!
UNITS/
, FORCE = NEWTON
, MASS = KILOGRAM
! the pre-processor has written MILLIMETER here before
, LENGTH = METER        ! was = MILLIMETER
, TIME = SECOND
!
!----------------------------------- PARTS -------------------------------------
!
!----------------------------------- Ground ------------------------------------
!
!                            adams_view_name='ground'
PART/1
, GROUND
!
!                       adams_view_name='front; "left" & right'
MARKER/101
, PART = 1              ! , QP = 9, 9, 9
, QP = 0.5
! a comment, with a comma, between the values
, -0.25, 0
, REULER = 30D, 60D, 0D
!
MARKER/102, PART = 1, QP = -0.5, 0.25, 0 ! END
!
!------------------------------------ Part -------------------------------------
!                            adams_view_name='PART_2'
PART/2
, QG = 0, 0, 0.75
!, QG = 1, 1, 1
, REULER = 20D, 0D, 0D
, MASS = 12.5
, CM = 200
, IP = 0.4, 0.5, 0.3    ! moments
, 0.02                  ! Ixy

, -0.01, 0.03           ! Ixz, Iyz
!
!                              adams_view_name='cm'
MARKER/200
, PART = 2
, QP = 0.01, 0.02, 0.03
MARKER/201
, PART = 2
, QP = 0.5, 0.25, -0.75
, REULER = 30D, 60D, 0D
MARKER/202
, PART = 2
, QP = -0.5, -0.25, -0.75
, REULER = -20D, 0D, 0D
!
!----------------------------------- FORCES ------------------------------------
BUSHING/1
, I = 201
, J = 101
, C = 4, 5, 6
, K = 4000, 5000, 6000
, CT = 0.7, 0.8, 0.9
, KT = 70, 80, 90
! , FORCE = 1, 2, 3
BUSHING/2
, I = 202
, J = 102
, C = 1, 2, 3
, K = 3000, 3500, 20000
, CT = 0, 0, 0
, KT = 10, 20, 30
!
!------------------------- GRAVITATIONAL ACCELERATION --------------------------
!
ACCGRAV/
, KGRAV = -9.81
!
!----------------------------- ANALYSIS SETTINGS -------------------------------
!
OUTPUT/
, REQSAVE
, GRSAVE
!
RESULTS/
!
END
PART/3, this is no longer read
)";

const std::string by_hand = R"(  my body on its two bushings, 3rd try
units/for=new,mas=kilog,len=met,tim=sec
acc/k=-9.81
pa/1,gr
ma/101,q=.5,-.25,0.,r=30d,60d,0
ma/102,q=-.5,.25
,0.
pa/2,m=12.5,cm=200,ip=.4,.5,.3,.02,-.01,.03,q=0,0,.75,r=20d,0,0
ma/200,q=.01,.02,.03
ma/201,q=.5,.25,-.75,r=30d,60d,0
ma/202,q=-.5,-.25,-.75,r=-20d,0,0
bu/1,i=201,j=101,k=4.e3,5e3,6.0e+3,kt=70,80,90,c=4,5,6,ct=.7,.8,.9
bu/2,i=202,j=102,k=3e+3,3.5e3,2e4,kt=10,20,30,c=1,2,3,ct=0,0,0
end
)";

// A four-bar linkage that stands still under a spring, with a curved law of force.
const std::string plain_linkage = R"(plain
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/10, PART=1
MARKER/11, PART=1, QP=4,0,0
MARKER/12, PART=1, QP=-1,3,0
PART/2, MASS=2, CM=20, IP=0.1,0.2,0.2
MARKER/20, PART=2, QP=0,0.5,0
MARKER/21, PART=2
MARKER/22, PART=2, QP=0,1,0
PART/3, MASS=3, CM=30, IP=0.1,1.5,1.5, QG=0,1,0
MARKER/30, PART=3, QP=2,0.5,0
MARKER/31, PART=3
MARKER/32, PART=3, QP=4,1,0
PART/4, MASS=2.5, CM=40, IP=0.1,0.4,0.4, QG=4,0,0
MARKER/40, PART=4, QP=0,1,0
MARKER/41, PART=4
MARKER/42, PART=4, QP=0,2,0
JOINT/1, REVOLUTE, I=21, J=10
JOINT/2, REVOLUTE, I=31, J=22
JOINT/3, REVOLUTE, I=32, J=42
JOINT/4, REVOLUTE, I=41, J=11
SFORCE/1, TRANSLATIONAL, I=22, J=12, FUNCTION=-400*(DM(22,12)-2)-5*VR(22,12)-20*(DM(22,12)-2)**3
SFORCE/2, ROTATIONAL, I=41, J=11, FUNCTION=-30*AZ(41,11)-IF(AZ(41,11)-1:2*WZ(41,11),3*WZ(41,11),4*WZ(41,11))
END
)";

const std::string semicolons = R"(packed
UNITS/SYSTEM=MKS;ACCGRAV/JGRAV=-9.81;PART/1,GROUND;MARKER/10;MARKER/11,QP=4,0,0;MARKER/12,QP=-1,3,0
PART/2,MASS=2,CM=20,IP=0.1,0.2,0.2;MARKER/20,QP=0,0.5,0;MARKER/21;MARKER/22,QP=0,1,0;
PART/3,MASS=3,CM=30,IP=0.1,1.5,1.5,QG=0,1,0;MARKER/30,QP=2,0.5,0;MARKER/31;MARKER/32,QP=4,1,0 ! PART/3 ends; PART/4
PART/4,MASS=2.5,CM=40,IP=0.1,0.4,0.4,QG=4,0,0;MARKER/40,QP=0,1,0;MARKER/41;MARKER/42,QP=0,2,0;
JOINT/1,REVOLUTE,I=21,J=10;JOINT/2,REVOLUTE,I=31,J=22;JOINT/3,REVOLUTE,I=32,J=42;JOINT/4,REVOLUTE,I=41,J=11
SFORCE/1,TRANSLATIONAL,I=22,J=12,FUNCTION=-400*(DM(22,12)-2)-5*VR(22,12)-20*(DM(22,12)-2)**3;
SFORCE/2,ROTATIONAL,I=41,J=11,FUNCTION=-30*AZ(41,11)-IF(AZ(41,11)-1:2*WZ(41,11),3*WZ(41,11),4*WZ(41,11));END
)";

// Both laws over many lines, broken at every kind of place, with comments and blank lines within.
const std::string broken_laws = [] {
  std::string text = replaced(plain_linkage, "FUNCTION=-400*(DM(22,12)-2)-5*VR(22,12)-20*(DM(22,12)-2)**3",
                              R"(
,FUNCTION=-400 ! N/m
! of the line
,*(DM(22,
,12)-
, 2
,)-5*VR (22 , 12 )

! hardening
,-20*(DM
,(22,12) -2)
, **
,3)");
  return replaced(text, "FUNCTION=-30*AZ(41,11)-IF(AZ(41,11)-1:2*WZ(41,11),3*WZ(41,11),4*WZ(41,11))", R"(&
FUNCTION = &
  -30 * az(41,11) - & ! spring
, if( Az(41,11)-1 : 2*wz(41,11), &

     3*WZ(41,11),
, 4*wZ(41,11)))");
}();

// The laws stand in VARIABLEs that are written behind their use, with other words for the same.
const std::string by_variables = [] {
  std::string text = replaced(plain_linkage, "-400*(DM(22,12)-2)-5*VR(22,12)-20*(DM(22,12)-2)**3",
                              "VARVAL(0007) + VARVAL(8)*VARVAL(0008)\n, *VARVAL(8)*(-2.0E+001)");
  text = replaced(text, "-30*AZ(41,11)-IF(AZ(41,11)-1:2*WZ(41,11),3*WZ(41,11),4*WZ(41,11))",
                  "-(180D/PI)*30*AZ(41,11) - 2*DTOR*RTOD*WZ(41,11)");
  return replaced(text, "END\n",
                  "VARIABLE/7, IC=0, FUNCTION=-4.0E2*VARVAL(8)-VR(22,12)*5.\nVARIABLE/0008, FUNCTION = DM(22,12)\n, "
                  "-2\nEND\n");
}();

// The slider on a turning arm: velocities, markers by points, references to markers.
const std::string plain_arm = R"(plain
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/6, PART=1
PART/2, MASS=3, CM=7, IP=10,10,10, WZ=10
MARKER/5, PART=2
MARKER/7, PART=2, QP=1,0,0
MARKER/10, PART=2, REULER=90D,90D,0
PART/3, MASS=3, CM=8, IP=10,10,10, WZ=10
MARKER/8, PART=3, QP=10,0,0
MARKER/9, PART=3, REULER=90D,90D,0
JOINT/1, REVOLUTE, I=5, J=6
JOINT/2, TRANSLATIONAL, I=9, J=10
SPRINGDAMPER/1, TRANSLATIONAL, I=6, J=8, K=5, LENGTH=10
END
)";
const std::string arm_commands = "model\nout\nLINEAR/EIGENSOL\nLINEAR/EIGENSOL, RM=5\n";
const std::string arm_by_points = R"(arm, axes by points
UNITS/SYSTEM=MKS
PART/1, GROUND, MATERIAL=steel
MARKER/6
PART/2, MASS=3, CM=7, IP=10,10,10, WX=0, WY=0, WZ=10, EXACT=X:Y:Z
MARKER/5
MARKER/7, QP=1,0,0
MARKER/10, ZP=1,0,0, XP=0,1,0
PART/3, MASS=3, CM=8, IP=10,10,10, WZ=5.7295779513082323E+02D, WM=6, VX=0, VY=100, VZ=0, VM=6, EXACT=X
MARKER/8, QP=10,0,0
MARKER/9, USEXP, XP=0,3,0, ZP=7,2,0
JOINT/1, REV, I=5, J=6, IC=0D, 10
JOINT/2, TRANS, I=9, J=10, IC=0, 0
SPRINGDAMPER/1, TRANSLATION, I=6, J=8, K=5, C=0, LENGTH=10, FORCE=0
END
)";

// A controller by matrices, whose numbers run over many lines.
const std::string plain_loop = R"(plain
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1,1,1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=ARYVAL(13,1)-50*DZ(20,1)+AKISPL(DZ(20,1),0,1)
VARIABLE/1, FUNCTION=DZ(20,1)
ARRAY/11, U, VARIABLES=1
ARRAY/12, X
ARRAY/13, Y
MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=-3,1,-2,-5
MATRIX/2, FULL=RORDER, ROWS=2, COLUMNS=1, VALUES=4,0.5
MATRIX/3, FULL=RORDER, ROWS=1, COLUMNS=2, VALUES=-1,-2
LSE/1, X=12, U=11, Y=13, A=1, B=2, C=3
SPLINE/1, X=-2,-1,0,1,2, Y=30,12,0,-15,-45
END
)";
const std::string loop_over_lines = R"(ADAMS/View model name: loop
UNITS/SYSTEM = MKS
PART/01, GROUND
MARKER/01
PART/02, MASS = 2.0, CM = 20
, IP = 1.0, 1.0
, 1.0
MARKER/20
JOINT/01, TRANSLATIONAL, I = 20, J = 1
STRING/1, STRING = gains of the 2nd controller, see page 7
SPLINE/01
, X = -2, -1,
, 0, 1, &
2
, Y = 30
,12,0
, -15
, -45
MATRIX/01
, FULL
, CORDER
, ROWS = 2
, COLUMNS = 2
, VALUES = -3
, -2
, 1
, -5
MATRIX/02, SPARSE, I = 1, 2, J = 1, 1
, VALUES = 4.0000000000000000E+000
, 5.0000000000000000E-001
MATRIX/03, FULL=RORD, ROWS=1, COL=2, VAL=-1,-2
ARRAY/11, U, SIZE=1, VARIABLES=1
ARRAY/12, X, SIZE=2
ARRAY/13, Y, SIZE=1
LSE/01, X = 12, U = 11, Y = 13
, A = 1, B = 2
, C = 3
VARIABLE/01
, FUNCTION = DZ(20, 1)
SFORCE/01, TRANSLATIONAL, ACTIONONLY
, I = 20, J = 1
, FUNCTION = ARYVAL(13,1) -
, 50*DZ(20,1) + AKISPL(
, DZ(20,1),
, 0, 1)
END
)";

// Six components with backslashes.
const std::string plain_components = R"(plain
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/9, PART=1, FLOATING
PART/2, MASS=2, CM=20, IP=1,2,3
MARKER/20, PART=2
GFORCE/1, I=20, JFLOAT=9, RM=1, FX=-100*DX(20,1)\FY=-200*DY(20,1)\FZ=-300*DZ(20,1)\TX=-10*AX(20,1)\TY=-20*AY(20,1)\TZ=-30*AZ(20,1)
END
)";
const std::string components_by_line = R"(components
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1
MARKER/9, FLOATING
PART/2, MASS=2, CM=20, IP=1,2,3
MARKER/20
GFORCE/1
, I = 20
, JFLOAT = 9
, RM = 1
, FX = - 100.0*
, DX(20,1)\
, FY = - 200.0*DY(20,1)   \
, FZ = - 3.0E+002*DZ(20,1)\,
, TX = - 10.0*AX(20,1)\ ! about x
, TY =
, - 20.0*AY(20,1)\
! about z
, TZ = - 30.0*AZ(20,1)\
END
)";

const std::string plain_inches = R"(plain
UNITS/SYSTEM=IPS
ACCGRAV/KGRAV=-386.0885826771653
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=20, CM=20, IP=5,6,7
MARKER/20, PART=2
BUSHING/1, I=20, J=1, K=10,20,30, KT=1,2,3
END
)";

const std::vector<Twins>& twins() {
  static const std::vector<Twins> table = {
      {"columns and continuation cards of an old export", replaced(column_export, "3*0.0", "0.0, 0.0, 0.0"),
       statics_first, plain_body, statics_first},
      {"a new export with comments in every place", commented_export,
       "\nfile/model=model\n! Insert ACF commands here:\nsimulate/static\n!\nlinear/eigensol\n! done\nstop\n",
       plain_body, statics_first},
      {"the same with carriage returns and tabs", replaced(replaced(commented_export, ", ", ",\t"), "\n", "\t\r\n"),
       "model.adm\r\nout\r\n\tsim/stat\r\n\tlin/eig\t! modes\r\nstop\r\n", plain_body, statics_first},
      {"typed by hand in short words", by_hand, "model\n\nsi/sta\nli/ei\n", plain_body, statics_first},
      {"typed by hand in upper case, from the console", replaced(by_hand, "  my body", "MY BODY"),
       "file/mod=model,out=run1\nSIM/STATIC\nLIN/EIGEN\nSTO\n", plain_body, statics_first},
      {"several statements on each line", semicolons, statics_first, plain_linkage, statics_first},
      {"laws over many lines with comments within", broken_laws, statics_first, plain_linkage, statics_first},
      {"laws by variables behind their use", by_variables, "model\nout\nSIMULATE/STATICS\nLINEAR/EIGENSOL\n",
       plain_linkage, statics_first},
      {"laws that commands state over several lines",
       replaced(replaced(plain_linkage, "-20*(DM(22,12)-2)**3", ""), "-30*AZ(41,11)-IF", "-IF"),
       "! laws of the second variant\nfile/model=model.adm, &\n  output_prefix=out ! names\nsforce/1, &\n"
       "fu = -400*(dm(22,12)-2) & ! spring\n -5*vr(22,12)\n, -20*(dm(22,12)-2)**3\nSFORCE/2\n"
       ", FUNCTION = - 30*AZ(41,11)\n! damping\n, - 2*WZ(41,11)\nSIMULATE/STATICS\nLINEAR/EIGENSOL\n",
       plain_linkage, statics_first},
      {"axes by points and velocities along markers", arm_by_points,
       "model\nout\nLINEAR/EIGENSOL\nLINEAR / EIGENSOLUTION , RM = 0005\n", plain_arm, arm_commands},
      {"upper and lower case of degrees and exponents",
       replaced(replaced(replaced(plain_arm, "MARKER/9, PART=3, REULER=90D,90D,0",
                                  "MARKER/9, PART=3, REULER=9.0E+1D,.9e2d,0.0D"),
                         "REULER=90D,90D,0", "REULER=+90.d,1.5707963267948966,0e0"),
                "K=5", "K=0.5e+001"),
       arm_commands, plain_arm, arm_commands},
      {"the arm after other things were tried", "title: the arm/2\n" + plain_arm.substr(plain_arm.find('\n') + 1),
       "model\nout\npart/3, mass=30\nspringdamper/1, k=77\nPART/3, &\n , MASS=3.0\nSPRINGDAMPER/1, K=5., C=0\n"
       "DEACTIVATE/JOINT, ID=2\nACTIVATE/JOINT, ID=2\nLINEAR/EIGENSOL\nLINEAR/EIGENSOL, RM=5\nstop\nstop and more\n",
       plain_arm, arm_commands},
      {"a controller whose numbers run over lines", loop_over_lines, eigensol, plain_loop, eigensol},
      {"six components, a line each", components_by_line, eigensol, plain_components, eigensol},
      {"units word by word in any order",
       replaced(plain_inches, "UNITS/SYSTEM=IPS",
                "UNITS/TIME = SECOND,LENGTH=INCH,\n, force = pound_force\n, Mass = Pound_Mass"),
       "model\nmodel\nint/gstiff, err=1e-5\nSIMULATE/STATICS\nout/nopri\nLINEAR/EIGENSOL, NODAMPING\n", plain_inches,
       statics_first},
      {"letters of other alphabets in titles and comments",
       replaced(replaced(plain_inches, "plain\n",
                         "Fahrwerk f\xC3\xBCr Stra\xC3\x9F"
                         "e, Gr\xF6\xDF"
                         "e 3\n"),
                "MARKER/20, PART=2", "! Aufh\xE4ngung hinten / \xE8\xBB\x8A\nMARKER/20, PART=2 ! \xB0"),
       statics_first, plain_inches, statics_first},
      {"one statement on a line of five thousand columns",
       replaced(plain_inches, "K=10,20,30", std::string(2500, ' ') + "K=10," + std::string(2500, '\t') + "20,30"),
       statics_first, plain_inches, statics_first},
  };
  return table;
}

class WrittenTwins : public Cases, public ::testing::WithParamInterface<std::size_t> {
 protected:
  RunResult run_named(const std::string& dataset, const std::string& commands) const {
    write("model.adm", dataset);
    write("run.acf", commands);
    return run_file("run.acf");
  }
};

TEST_P(WrittenTwins, have_the_same_eigenvalues) {
  const Twins& t = twins()[GetParam()];
  SCOPED_TRACE(t.name);
  const RunResult written = run_named(t.dataset, t.commands);
  ASSERT_EQ(written.status, 0) << written.err;
  const RunResult plain = run_named(t.plain_dataset, t.plain_commands);
  ASSERT_EQ(plain.status, 0) << plain.err;
  const auto spectra = [](const RunResult& r) {
    std::vector<std::vector<std::complex<double>>> all;
    for (std::size_t k = 0; k < r.json.at("results").size(); ++k) {
      if (r.result(k).contains("eigenvalues")) all.push_back(r.eigenvalues(k));
    }
    return all;
  };
  const auto a = spectra(written), b = spectra(plain);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_FALSE(a[k].empty());
    expect_same(a[k], b[k], 1e-10);
  }
}
INSTANTIATE_TEST_SUITE_P(all, WrittenTwins, ::testing::Range<std::size_t>(0, twins().size()));

}  // namespace
}  // namespace dynalin::cases::written_twins_test
