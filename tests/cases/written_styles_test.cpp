// The same few mechanisms as different programs and people write them. Every one of them is a mass on a spring or a
// pendulum with a frequency known beforehand, so a misread number shows.
#include <gtest/gtest.h>

#include <numbers>

#include "cases/run.h"

namespace dynalin::cases::written_styles_test {
namespace {

struct Style {
  const char* name;
  std::string dataset, commands;
  double omega;  // of the one oscillation of the last eigensolution
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// A pre-processor's export: one argument a line, banners, names in comments.
const std::string exported =
    "Adams View model name: MODEL_1\n!\n!-------------------------------- SYSTEM UNITS "
    "---------------------------------\n"
    "!\nUNITS/\n, FORCE = NEWTON\n, MASS = KILOGRAM\n, LENGTH = MILLIMETER\n, TIME = SECOND\n!\n"
    "!----------------------------------- PARTS -------------------------------------\n!\n"
    "!                            adams_view_name='ground'\nPART/1\n, GROUND\n!\n"
    "!                           adams_view_name='MARKER_1'\nMARKER/1\n, PART = 1\n, QP = 0, 100, 0\n!\n"
    "!                            adams_view_name='PART_2'\nPART/2\n, QG = 0, 100, 0\n, MASS = 0.5\n, CM = 2\n"
    ", IP = 1.0E+003, 1.0E+003, 1.0E+003\n!\n!                              adams_view_name='cm'\nMARKER/2\n, PART = "
    "2\n"
    "!\n!                           adams_view_name='JOINT_1'\nJOINT/1\n, TRANSLATIONAL\n, I = 2\n, J = 1\n!\n"
    "!                          adams_view_name='SPRING_1.sforce'\nSFORCE/1\n, TRANSLATIONAL\n, ACTIONONLY\n, I = 2\n"
    ", J = 1\n, FUNCTION = - 0.2*DZ(2,1)\n, - 0.0*VZ(2,1)\n, + 0.0\n!\n"
    "!------------------------- GRAVITATIONAL ACCELERATION --------------------------\n!\nACCGRAV/\n, JGRAV = "
    "-9806.65\n!\n!----------------------------- ANALYSIS SETTINGS -------------------------------\n!\n"
    "OUTPUT/\n, REQSAVE\n, GRSAVE\n!\nINTEGRATOR/\n, HHT\n, ERROR = 5.0E-006\n, HMAX = 0.002\n!\nRESULTS/\n, XRF\n!\n"
    "END\n";

const std::string by_hand =
    "mass on a spring\nunits/system=mks\npart/1, ground\nmarker/1\npart/2, mass=1, cm=20, ip=1,1,1\nmarker/20\n"
    "joint/1, translational, i=20, j=1\nbushing/1, i=20, j=1, k=0,0,400\nend\n";

const std::string model_and_prefix = "model\nout\nLINEAR/EIGENSOL\nSTOP\n";

const std::vector<Style>& styles() {
  static const std::vector<Style> table = {
      {"export of a current pre-processor", exported, model_and_prefix, 20},
      {"its command file", exported,
       "\nfile/model=model\n! Insert ACF commands "
       "here:\npreferences/solver=CXX\nSIMULATE/STATIC\nLINEAR/EIGENSOL\nstop\n",
       20},
      {"its command file with settings", exported,
       "\nfile/model=model, output_prefix=run_1\npreferences/list,status_message=on\noutput/noprint\ncontrol\n", 0},
      {"lower case throughout", by_hand, "model\nout\nsim/stat\nlin/eig\nstop\n", 20},
      {"lines that end with carriage return and line feed", replaced(exported, "\n", "\r\n"),
       replaced(model_and_prefix, "\n", "\r\n"), 20},
      {"lines that end with carriage return alone", replaced(by_hand, "\n", "\r"),
       replaced(model_and_prefix, "\n", "\r"), 20},
      {"tabs for blanks", replaced(exported, " = ", "\t=\t\t"), replaced(model_and_prefix, "/", "\t/\t"), 20},
      {"a byte order mark", "\xEF\xBB\xBF" + by_hand, "\xEF\xBB\xBF" + model_and_prefix, 20},
      {"no line end at the end", by_hand.substr(0, by_hand.size() - 1), "model\nout\nLINEAR/EIGENSOL", 20},
      {"trailing blanks", replaced(by_hand, "\n", "   \t \n"), replaced(model_and_prefix, "\n", "  \n"), 20},
      {"comments everywhere",
       "! title\n!\nUNITS/SYSTEM=MKS ! units\n  ! indented\nPART/1, ! first\n! between\n , GROUND ! "
       "ground\n\n\nMARKER/1 "
       "!\nPART/2, MASS=1, ! mass\n\n!\n , CM=20\n! and\n, IP=1,1 ! two\n!\n!\n,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, "
       "I=20, J=1\nBUSHING/1, I=20, J=1, K=0,0 ! kz next\n,400\nEND ! end\n! behind\nnot read\n",
       "! comment first\n! another\nFILE/MODEL=model ! the model\n!\nSIM/STAT ! static\n! between\n\nLINEAR/ &\n  "
       "EIGENSOL ! the end\n! stop\nstop ! now\nrubbish (\n",
       20},
      {"continuation by ampersands",
       replaced(by_hand, "mass=1, cm=20, ip=1,1,1", "mass=1, &\n cm=20, & ! centre\n , ip=1, &\n1,1"),
       "model\nout\nLINEAR/EIGENSOL, &\n NODAMPIN, &\n , NOVECTOR\n", 20},
      {"commas at both ends of lines",
       replaced(by_hand, "bushing/1, i=20, j=1, k=0,0,400", "bushing/1,\n, i=20,\n, j=1,\n, k=0,\n,0,\n, 400"),
       model_and_prefix, 20},
      {"several statements on a line",
       "t\nUNITS/SYSTEM=MKS;PART/1,GROUND;MARKER/1;PART/2,MASS=1,CM=20,IP=1,1,1;MARKER/20;\nJOINT/"
       "1,TRANSLATIONAL,I=20,J=1;"
       "BUSHING/1,I=20,J=1,K=0,0,400;\nEND\n",
       model_and_prefix, 20},
      {"the shortest abbreviations",
       "t\nUNI/SYS=MKS\nACC/J=-10\nP/99, G\nM/99\nP/1, M=1, CM=1, IP=0,0,1.5\nM/1\nM/2, Q=0,1\n,0\nJ/1, RE, I=2, "
       "J=99\nR/1, "
       "D, I=1, J=99, C=what, ever\nEQU/MAX=50\nRES/XRF\nOUT/REQS\nEND\n",
       "model\nout\nsi/sta\nli/ei\n", 2},
      {"abbreviations of the reference's examples",
       "t\nuni/mas=kilogram,for=newton,len=meter,tim=second\npa/99, "
       "ground\nma/99,qp=0,0,0\npa/1,ma=1,cm=1,ip=1,1,1\nma/1\n"
       "ma/2,qp=0,0,5\njoint/1,tran,i=1,j=99\nspringdamper/1,tran,i=2,j=3,k=400,c=0,l=5\nma/3,pa=99\nvari/1,fun=0\n"
       "accgrav/i=0,j=0,k=0\nresult/format\nend\n",
       "model\nout\nlin/eig\n", 20},
      {"numbers as FORTRAN writes them",
       "t\nUNITS/SYSTEM=MKS\nPART/01, GROUND\nMARKER/0001, PART = 01\nPART/002, MASS=+1., CM=020, IP=1,.1E+1,1.0E+000\n"
       "MARKER/020, REULER=0D, 360D, 6.283185307179586\nJOINT/01, TRANSLATIONAL, I=20, J=1\nBUSHING/1, I=20, J=1, "
       "K=0,0.,4.0E+002\nEND\n",
       model_and_prefix, 20},
      {"a slash and a line behind the keyword", replaced(by_hand, "units/system=mks", "units/\n,system=mks"),
       model_and_prefix, 20},
      {"blanks around every sign", replaced(replaced(replaced(by_hand, "=", " = "), "/", " / "), ",", " , "),
       "model\nout\nLINEAR / EIGENSOL\n", 20},
      {"forgotten commas", replaced(by_hand, "mass=1, cm=20, ip", "mass=1 cm=20 ip"), model_and_prefix, 20},
      {"no title", replaced(by_hand, "mass on a spring\n", ""), model_and_prefix, 20},
      {"a title that looks like a statement", replaced(by_hand, "mass on a spring", "ADAMS/View model name: PART/1"),
       model_and_prefix, 20},
      {"no END", replaced(by_hand, "end\n", ""), model_and_prefix, 20},
      {"statements in any order",
       "t\nBUSHING/1, I=20, J=1, K=0,0,400\nJOINT/1, TRANSLATIONAL, I=20, J=1\nMARKER/20, PART=2\nMARKER/1, PART=1\n"
       "PART/2, MASS=1, CM=20, IP=1,1,1\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nEND\n",
       model_and_prefix, 20},
      {"expressions broken at every sign",
       "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, "
       "TRANSLATIONAL, "
       "I=20, J=1\nMARKER/9, FLOATING, PART=1\nVFORCE/1, I=20, JFLOAT=9, RM=1\n, FX = 0\\FY = 0\\\n, FZ = -IF(TIME-1:\n"
       ",(1000/\n,10*\n,DZ(20,\n,1)\n,)*4,\n, 0, 0)\nEND\n",
       model_and_prefix, 20},
      {"an old export with everything around",
       "ADAMS/View model name: old\nUNITS/FORCE = NEWTON, MASS = KILOGRAM, LENGTH = METER, TIME = SECOND\n"
       "MATERIAL/1, NAME = steel, YOUNGS_MODULUS = 2.07E+11, POISSONS_RATIO = 0.29\n, DENSITY = 7801\nPART/1, GROUND, "
       "MATERIAL = steel\nMARKER/17172491, PART = 1\nPART/4, MASS = 1, CM = 13, IP = 1, 1\n, 1, MATERIAL = steel\n"
       "MARKER/13, PART = 4\nGRAPHICS/41, CYLINDER, CM = 13, LENGTH = 0.3, RADIUS = 0.03\nGRAPHICS/46, FORCE, ETYPE = "
       "SFORCE, EID = 7, EMARKER = 13\nJOINT/9, TRANSLATIONAL, I = 13, J = 17172491\nSFORCE/7, TRANSLATIONAL, "
       "ACTIONONLY, I "
       "= 13, J = 17172491, FUNCTION = -4.0E+02*\n,DZ(13,\n,17172491)\nREQUEST/04, F2=ORIENT(27,1,13,17172491)\\"
       "F3=DX(13),C=EULER PARAMETERS\nOUTPUT/REQSAVE, GRSAVE\nRESULTS/\nEND\n",
       model_and_prefix, 20},
      {"an edit, as generators of wind turbines write it",
       replaced(by_hand, "end\n", "JOINT/2, FIXED, I=20, J=1\nMOTION/1, JOINT=1, VELOCITY, FUNCTION=0\nEND\n"),
       "model\nout\n! Lock:\nDEACTIVATE/MOTION , ID = 1\nDEACTIVATE/JOINT , RANGE = 2 , 9\nSIMULATE/STATICS\n"
       "LINEAR/EIGENSOL, COORDS = 1 , 25\nSTOP\n",
       20},
      {"a chain of statics with loosening settings", replaced(by_hand, "end\n", "accgrav/k=-9.81\nend\n"),
       "model\nout\nint/hht\nequil/maxit=100,stab=1e-2,error=1,imb=1,tlim=1,alim=2.0D\nsim/stat\nequil/stab=1e-4\nsim/"
       "stat\n"
       "equil/list\nsho stat=sim\nlinear/eigen\n",
       20}};
  return table;
}

class WrittenStyles : public Cases, public ::testing::WithParamInterface<std::size_t> {};

TEST_P(WrittenStyles, of_datasets_and_command_files_are_read) {
  const Style& s = styles()[GetParam()];
  write("model.adm", s.dataset);
  write("run.acf", s.commands);
  const RunResult r = run_file("run.acf");
  if (s.omega == 0) {  // CONTROL needs a routine
    EXPECT_EQ(r.status, 1) << s.name << r.err;
    return;
  }
  ASSERT_EQ(r.status, 0) << s.name << "\n" << r.err;
  std::size_t last = 0;
  for (std::size_t k = 0; k < r.json.at("results").size(); ++k) {
    if (r.result(k).contains("eigenvalues")) last = k;
  }
  SCOPED_TRACE(s.name);
  expect_eigenvalues(r.eigenvalues(last), {{0, s.omega / (2 * std::numbers::pi)}}, 1e-11);
}
INSTANTIATE_TEST_SUITE_P(all, WrittenStyles, ::testing::Range<std::size_t>(0, styles().size()));

}  // namespace
}  // namespace dynalin::cases::written_styles_test
