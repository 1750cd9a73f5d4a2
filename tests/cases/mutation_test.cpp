// Thousands of datasets with mutilated text: no crash, no hang, and no output where the input is wrong.
#include <random>

#include "cases/dataset_text.h"
#include "places/draws.h"

namespace dynalin::cases::mutation_test {
namespace {

class Mutation : public Cases {};

// A dataset with a statement of nearly every kind.
std::string everything() {
  return two_bodies(
      "JOINT/2, CYLINDRICAL, I=30, J=5, ICTRAN=0.1,0.2\nMARKER/5, PART=1, QP=0.7,0.1,0.4\nJPRIM/1, INPLANE, I=21, "
      "J=3\nMOTION/1, JOINT=2, ROTATION, FUNCTION=0.1*SIN(2*TIME)\n"
      "GCON/1, FUNCTION=VX(22)-0.1*VY(21,1,20)\nPART/4, MASS=1, CM=40, IP=1,1,1\nMARKER/40\nMARKER/6, PART=1\nJOINT/3, "
      "REVOLUTE, I=40, J=6\nPART/5, MASS=1, CM=50, IP=1,1,1\nMARKER/50\nJOINT/4, TRANSLATIONAL, I=50, J=6\n"
      "COUPLER/1, JOINTS=4,3, TYPE=T:R, SCALES=-3\n"
      "BUSHING/1, I=31, J=21, K=1,2,3, KT=1,1,1, C=.1,.1,.1\nBEAM/1, I=30, J=20, LENGTH=1, AREA=1, IXX=1, IYY=1, "
      "IZZ=1, EMOD=1E2, GMOD=4E1, CRATIO=1E-3\n"
      "MARKER/29, PART=2, FLOATING\nGFORCE/1, I=31, JFLOAT=29, RM=22, "
      "FX=5*VX(31,21)-20*DX(31,21,31)\\FY=IF(DX(31,21):1,2,3)\\TZ=STEP(TIME,0,0,1,5)\n"
      "SFORCE/1, ROTATIONAL, ACTIONONLY, I=30, J=30, FUNCTION=-2*WZ(30)+AKISPL(DX(30),0,1)+MAG(DXYZ(30,20)%FXYZ(31))\n"
      "SPLINE/1, X=-1,0,1,2,3, Y=0,1,4,9,16, LINEAR\nVARIABLE/1, FUNCTION=VARVAL(2)*2+JOINT(1,0,2,0)\nVARIABLE/2, "
      "IC=3, FUNCTION=DIF(1)+ARYVAL(3,1)\n"
      "DIFF/1, IC=1, FUNCTION=-DIF(1)+DX(31)\nDIFF/2, IMPLICIT, IC=1,2, FUNCTION=DIF1(2)+DIF(2)\nARRAY/1, U, "
      "VARIABLES=2\nARRAY/2, X\nARRAY/3, Y\nTFSISO/1, U=1, X=2, Y=3, NUM=1,2, DEN=1,2,3\n"
      "MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=1,2,3,4\nPINPUT/1, VARIABLES=1\nPOUTPUT/1, "
      "VARIABLES=2\nPSTATE/1, VARIABLES=1\nREQUEST/1, F2=DX(1,2)\\F3=3\n"
      "GRAPHICS/1, CYLINDER, CM=20, LENGTH=3, RADIUS=2\nRESULTS/XRF\n");
}

std::string mutated(std::string text, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random() % n); };
  static const std::string pieces[] = {
      ",",      "=",    "/",         "\\",          "(",         ")",     "[",
      "]",      ":",    "!",         "&",           ";",         "\n",    "\n, ",
      "1E308",  "-1",   "0",         "99999999999", "D",         "1.5.2", "IF(",
      "**",     "%",    "'",         "\"",          "\t",        "\xFF",  std::string(1, '\0'),
      "PART/2", "I=20", "FUNCTION=", "VARVAL(1)",   "USER(1,2)", "END\n", "NaN",
      "1e-400"};
  const std::size_t changes = 1 + below(4);
  for (std::size_t c = 0; c < changes; ++c) {
    const std::size_t at = below(text.size() + 1);
    switch (below(7)) {
      case 0:
        if (at < text.size()) text.erase(at, 1 + below(6));
        break;
      case 1:
        text.insert(at, pieces[below(std::size(pieces))]);
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random() % 256);
        break;
      case 3: {  // a line away
        const std::size_t begin = text.rfind('\n', at), end = text.find('\n', at);
        if (begin != std::string::npos && end != std::string::npos && end > begin) text.erase(begin, end - begin);
        break;
      }
      case 4: {  // a piece of the text somewhere else
        const std::size_t from = below(text.size());
        text.insert(at, text.substr(from, below(40)));
        break;
      }
      case 5: {  // a digit changed
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text[digit] = static_cast<char>('0' + below(10));
        break;
      }
      default:
        text.resize(at);
    }
  }
  return text;
}

TEST_F(Mutation, mutilated_datasets_neither_crash_nor_leave_files) {
  const std::string base = everything();
  std::mt19937_64 random(20);
  const int count = draws(10000, 4000);
  int refused = 0, failed = 0, solved = 0;
  write("model.acf", "model\nmodel\nLINEAR/EIGENSOL\nLINEAR/STATEMAT, FILE=matrices, PINPUT=1, POUTPUT=1\n");
  for (int k = 0; k < count; ++k) {
    const std::string text = mutated(base, random);
    write("model.adm", text);
    const RunResult r = run_file("model.acf");
    ASSERT_TRUE(r.status == 0 || r.status == 1 || r.status == 2) << text;
    if (r.status == 1) {
      ++refused;
      ASSERT_NE(r.err.find("error"), std::string::npos) << text;
      ASSERT_FALSE(r.wrote("model.msg") || r.wrote("matrices") || r.wrote("results.json")) << text;
    } else {
      ++(r.status == 0 ? solved : failed);
      std::filesystem::remove(folder_ / "model.msg");
      std::filesystem::remove(folder_ / "matrices");
      std::filesystem::remove(folder_ / "results.json");
    }
  }
  std::cout << refused << " refused, " << failed << " failed in the analysis, " << solved << " solved\n";
  EXPECT_GT(refused, count * 3 / 10);
}

}  // namespace
}  // namespace dynalin::cases::mutation_test
