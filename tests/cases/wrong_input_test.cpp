// Wrong input: every problem with its code, line and column, and nothing written.
#include <gmock/gmock.h>

#include <iterator>
#include <set>
#include <sstream>

#include "base/diagnostics.h"
#include "cases/run.h"

namespace dynalin::cases::wrong_input_test {
namespace {

// Where the text stands: behind nine lines of a sound dataset, as the whole dataset, or as commands from line 3 on.
enum class Place { added, whole, command };
struct Wrong {
  Place place;
  const char* text;
  std::vector<std::string> problems;  // "code line:column"
};

const std::string sound =
    "Wrong input\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, "
    "PART=2\n"
    "MARKER/21, PART=2, QP=0,0,1\nJOINT/1, REVOLUTE, I=20, J=1\nVARIABLE/1, FUNCTION=1\n";

const std::vector<Wrong>& table() {
  // clang-format off
  static const std::vector<Wrong> rows = {
    {Place::added, "PA/9, MASS=1, CM=90", {"unknown-marker 10:18"}},
    {Place::added, "GRX/1", {"unknown-statement 10:1"}},
    {Place::added, "JOINT/5", {"missing-variant 10:1"}},
    {Place::added, "PART/9, QG=1\x01"",2", {"bad-character 10:13"}},
    {Place::added, "PART/0, MASS=1", {"bad-id 10:6"}},
    {Place::added, "PART/99999999999, MASS=1", {"bad-id 10:6"}},
    {Place::added, "PART/9, MASS=1D3, CM=90", {"expected-number 10:15", "unknown-marker 10:22"}},
    {Place::added, "PART/9,, QG=1,2,3", {"empty-argument 10:8"}},
    {Place::added, "PART/9, QG=1 2 3", {"expected-comma 10:14"}},
    {Place::added, "JOINT/9, FIXED, I=2.5, J=1", {"expected-integer 10:19"}},
    {Place::added, "PART/9, QG=1,2,x", {"wrong-count 10:12", "missing-value 10:16"}},
    {Place::added, "PART/9, EXACT=1:2", {"expected-word 10:15"}},
    {Place::added, "PART/123456789, QG=1,2,3", {"long-id 10:6"}},
    {Place::added, "PART/9, QG=", {"missing-value 10:11"}},
    {Place::added, "MARKER/9, QP=1,,3", {"missing-value 10:16"}},
    {Place::whole, "PART/1, GROUND\nEND\n", {"missing-title 1:1", "no-units 0:0"}},
    {Place::whole, "title\nPART/1, GROUND\n", {"missing-end 2:15", "no-units 0:0"}},
    {Place::whole, "", {"empty-dataset 1:1"}},
    {Place::whole, "   \n \n", {"empty-dataset 1:1"}},
    {Place::added, "this is no statement", {"not-a-statement 10:1"}},
    {Place::added, "PART/9, QG=1e999,2,3", {"number-overflow 10:12"}},
    {Place::added, "PART/9, = 3", {"stray-equals 10:9"}},
    {Place::added, "VARIABLE/9, FUNCTION=(1+2", {"unbalanced-parenthesis 10:22"}},
    {Place::added, "VARIABLE/9, FUNCTION=1+2)", {"unbalanced-parenthesis 10:25"}},
    {Place::added, "PART/9, 3 4", {"unexpected-text 10:9"}},
    {Place::added, "FOO/9, X=1", {"unknown-statement 10:1"}},
    {Place::added, "PART/9, QG=1,2", {"wrong-count 10:12"}},
    {Place::added, "PART/9, MASS=1 kg, CM=20", {"expected-number 10:16"}},
    {Place::added, "MARKER/9, PART=2, QP=1 mm, 2 mm, 3 mm", {"expected-number 10:24"}},
    {Place::added, "MARKER/9, FLEX_BODY=3, NODE_ID=7", {"unknown-body 10:21"}},
    {Place::added, "MARKER/9, PART=2, CURVE=1, VELOCITY=3", {"argument-not-built 10:19"}},
    {Place::added, "MARKER/9, FE_PART=3, NODE_LABEL=1", {"unknown-body 10:19"}},
    {Place::added, "FE_PART/9, TYPE=2DBEAMXY, MATERIAL=9, NODE_LABELS=1,2, X=0,1, Z=0,0.1, AREA=1, IYY=1, IZZ=1\nMATERIAL/9, DENSITY=1, YOUNGS_MODULUS=1, POISSONS_RATIO=0", {"value-out-of-range 10:56"}},
    {Place::added, "FE_PART/9, TYPE=2DBEAMXY, MATERIAL=9, NODE_LABELS=1,2, X=0,1, AREA=1, IYY=1, IZZ=1, VX=2, VZ=3, WX=1\nMATERIAL/9, DENSITY=1, YOUNGS_MODULUS=1, POISSONS_RATIO=0", {"passed-over 10:91", "passed-over 10:97"}},
    {Place::added, "FE_PART/9, TYPE=2DBEAMYZ, MATERIAL=9, NODE_LABELS=1,2, X=0,1, AREA=1, IYY=1, IZZ=1\nMATERIAL/9, DENSITY=1, YOUNGS_MODULUS=1, POISSONS_RATIO=0", {"value-out-of-range 10:12"}},
    {Place::added, "FE_PART/9, TYPE=2DBEAMZX, MATERIAL=9, NODE_LABELS=1,2, X=0,1, PSI=0.1, AREA=1, IYY=1, IZZ=1\nMATERIAL/9, DENSITY=1, YOUNGS_MODULUS=1, POISSONS_RATIO=0", {"value-out-of-range 10:63"}},
    {Place::added, "FE_PART/9, TYPE=4DBEAM, MATERIAL=1, NODE_LABELS=1,2, X=0,1, AREA=1, IYY=1, IZZ=1", {"unknown-word 10:12"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=1, NODE_LABELS=1,2, X=0,1,2, AREA=1, IYY=1, IZZ=1", {"wrong-count 10:54"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=1, NODE_LABELS=1,1, X=0,1, AREA=1, IYY=1, IZZ=1", {"value-out-of-range 10:37"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=1, NODE_LABELS=1,2, X=1,0, AREA=1, IYY=1, IZZ=1", {"value-out-of-range 10:1"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=1, NODE_LABELS=1,2, X=0,1, AREA=0, IYY=1, IZZ=1", {"value-out-of-range 10:61"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=1, NODE_LABELS=1,2, X=0,1, AREA=1, IYY=1, IZZ=1", {"unknown-element 10:25"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, NODE_LABELS=1,2, X=0,1, AREA=1, IYY=1, IZZ=1", {"missing-argument 10:1"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, X=0,1, SECTION=1,1,1,1,0,2,2,1,1,1,0,2", {"excluded-arguments 10:78"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, PHI=1, SECTION=1,1,1,1,0,2,2,1,1,1,0,2", {"excluded-arguments 10:78"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2, IYZ=0", {"excluded-arguments 10:111"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2, CRATIOK=1, CRATIO=1", {"excluded-arguments 10:122"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2, CRATIOM=0.1", {"argument-not-built 10:111"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0,3, SECTION=1,1,1,1,0,2,2,1,1,1,0,2", {"wrong-count 10:37"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2,3", {"wrong-count 10:78"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2.5,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2", {"expected-integer 10:63"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,1,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2", {"value-out-of-range 10:63"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, NODE_LABELS=1,3, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2", {"unknown-node 10:80"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, NODE_LABELS=1,2,3, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2", {"wrong-count 10:56"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,3,1,1,1,0,2", {"unknown-node 10:98"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, SECTION=2,1,1,1,0,2", {"wrong-count 10:78"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,0", {"value-out-of-range 10:108"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,0,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2", {"value-out-of-range 10:65"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,2,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2", {"value-out-of-range 10:71"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0, SECTION=1,1,1,1,0,2", {"wrong-count 10:37"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, NODE_LABELS=1,2, X=0,1", {"missing-argument 10:1", "missing-argument 10:1", "missing-argument 10:1"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, COORDINATES=1,0,0,0,0,0,0,2,1,0,0,0,0,0, SECTION=1,1,1,1,0,2,2,1,1,1,0,2\nMATERIAL/9, DENSITY=1, YOUNGS_MODULUS=1, POISSONS_RATIO=0\nMARKER/9, NODE_LABEL=2", {"marker-off-node 12:1"}},
    {Place::added, "SENSOR/9, FUNCTION=TIME, VALUE=1, GE, HALTING", {"unknown-argument 10:39"}},
    {Place::added, "PART/9, IP=1,2", {"missing-cm 10:1", "wrong-count 10:9", "inertia-without-mass 10:9"}},
    {Place::added, "FIELD/9, I=20, J=1, KMATRIX=1,2,3", {"wrong-count 10:21"}},
    {Place::added, "BUSHING/9, I=20, J=1, K=1", {"wrong-count 10:23"}},
    {Place::added, "BEAM/9, I=20, J=1, LENGTH=1, AREA=1, IXX=1, IYY=1, IZZ=1, EMOD=1, GMOD=1, CMATRIX=1,2", {"wrong-count 10:75"}},
    {Place::added, "VARIABLE/9, FUNCTION=DX(20,1,0,0)", {"wrong-argument-count 10:22"}},
    {Place::added, "VARIABLE/9, FUNCTION=FX(0,1)", {"argument-range 10:25"}},
    {Place::added, "VARIABLE/9, FUNCTION=", {"missing-value 10:21"}},
    {Place::added, "VARIABLE/9, FUNCTION=SQRT(-3)", {"function-domain 10:22"}},
    {Place::added, "VARIABLE/9, FUNCTION=USER(1)", {"missing-routine 10:22"}},
    {Place::added, "VARIABLE/9, FUNCTION=2*USER(1)", {"routine-in-expression 10:24"}},
    {Place::added, "VARIABLE/9, FUNCTION=SENVAL(3)", {"unknown-element 10:29"}},
    {Place::added, "VARIABLE/9, FUNCTION=SENVAL(3)\nSENSOR/3, FUNCTION=TIME, VALUE=1, HALT", {"missing-argument 10:29"}},
    {Place::added, "SENSOR/3, FUNCTION=TIME\nSENSOR/3, FUNCTION=TIME", {"duplicate-id 11:1"}},
    {Place::added, "VARIABLE/9, FUNCTION=INVPSD(TIME,3,0,1,9,0,1)", {"unknown-element 10:34"}},
    {Place::added, "VARIABLE/9, FUNCTION=INVPSD(TIME,3,0,1,9,0,1)\nSPLINE/3, X=0,1,2,3, Y=1,1,-1,1", {"spline-data 10:34"}},
    {Place::added, "VARIABLE/9, FUNCTION=INVPSD(TIME,3,0,1,9,1,1)\nSPLINE/3, X=0,1,2,3, Y=1,1,1,1", {"spline-data 10:34"}},
    {Place::added, "VARIABLE/9, FUNCTION=INVPSD(TIME,3,0,1,9,0,1)\nSPLINE/3, X=0,1,2,3, Y=1,1,1,1,1, Y=2,1,1,1,1", {"spline-data 10:34"}},
    {Place::added, "VARIABLE/9, FUNCTION=(1,2)", {"misplaced-separator 10:24"}},
    {Place::added, "VARIABLE/9, FUNCTION=DX", {"missing-arguments 10:22"}},
    {Place::added, "VARIABLE/9, FUNCTION=1+*2", {"missing-operand 10:24"}},
    {Place::added, "VARIABLE/9, FUNCTION=2 3", {"missing-operator 10:24"}},
    {Place::added, "VARIABLE/9, FUNCTION=FOO(1)", {"unknown-function 10:22"}},
    {Place::added, "VARIABLE/9, FUNCTION=DXYZ(20)", {"vector-mismatch 10:22"}},
    {Place::added, "VARIABLE/9, FUNCTION=SIN(1,2)", {"wrong-argument-count 10:22"}},
    {Place::added, "JOINT/9, REVOLUTE, I=20, J=1, IC=1,2,3", {"wrong-count 10:31"}},
    {Place::added, "MOTION/9, JOINT=1, FUNCTION=1, D=3", {"unexpected-value 10:32"}},
    {Place::added, "DIFF/9, IMPLICIT, FUNCTION=DIF(9)-1, DYNAMIC_HOLD", {"unexpected-argument 10:38"}},
    {Place::added, "VARIABLE/9, FUNCTION=2*ARYVAL(9,3)\nARRAY/9, NUMBERS=1,2", {"unfilled-entry 10:24"}},
    {Place::added, "VARIABLE/9, FUNCTION=DELAY(VARVAL(1),1,0,9)", {"unknown-element 10:42"}},
    {Place::added, "VARIABLE/9, FUNCTION=DELAY(VARVAL(8),DX(29),AKISPL(TIME,0,7))", {"unknown-element 10:35", "unknown-marker 10:41", "unknown-element 10:59"}},
    {Place::added, "VARIABLE/9, FUNCTION=DELAY(SFORCE(9,0,1,0),1,0)\nSFORCE/9, TRANSLATIONAL, I=21, J=1, FUNCTION=1", {"unknown-rate 10:28"}},
    {Place::added, "JOINT/9, REVOLUTE, I=20, J=1, FRICTION=ON, MU_STAT_ROT=0.3, INNER=2, PRELOAD_ONLY", {"obsolete-argument 10:31"}},
    {Place::added, "MARKER/9, PART=2, LABEL = foot\nJOINT/9, REVOLUTE, I=20, J=1, LABEL=hinge of a", {"obsolete-argument 10:19"}},
    {Place::added, "FRICTION/9, JOINT=9\nJOINT/9, PLANAR, I=20, J=1", {"unfit-joint 10:1"}},
    {Place::added, "FRICTION/9, JOINT=9, BALL_RADIUS=2\nJOINT/9, REVOLUTE, I=20, J=1", {"unread-argument 10:22"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=ALL:PRELOAD\nJOINT/9, REVOLUTE, I=20, J=1", {"excluded-arguments 10:22"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=PRELOAD:NONE\nJOINT/9, REVOLUTE, I=20, J=1", {"excluded-arguments 10:22"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=REACTION:TORS\nJOINT/9, REVOLUTE, I=20, J=1", {"unread-argument 10:22"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=REAC:BEND, REACTION_ARM=2\nJOINT/9, SPHERICAL, I=20, J=1", {"unread-argument 10:22", "unread-argument 10:40"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=REAC, FRICTION_TORQUE_PRELOAD=2\nJOINT/9, REVOLUTE, I=20, J=1", {"unread-argument 10:35"}},
    {Place::added, "FRICTION/9, JOINT=9, EFFECT=SLIDING, MAX=2, MU_STATIC=1\nJOINT/9, REVOLUTE, I=20, J=1", {"unread-argument 10:38"}},
    {Place::added, "FRICTION/9, JOINT=9, EFFECT=STICTION, MU_DYNAMIC=0.2\nJOINT/9, REVOLUTE, I=20, J=1", {"unread-argument 10:39"}},
    {Place::added, "FRICTION/9, JOINT=9, FORMULATION=LUGRE, TRANSITION=2, MAX=1, BRISTLE=9\nJOINT/9, REVOLUTE, I=20, J=1", {"unread-argument 10:41", "unread-argument 10:55"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=REAC, REACTION_ARM=2, INITIAL_OVERLAP=3, OVERLAP_DELTA=INCREASE\nJOINT/9, TRANSLATIONAL, I=20, J=1", {"unread-argument 10:35", "unread-argument 10:51"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=BEND, REACTION_ARM=2, INITIAL_OVERLAP=3\nJOINT/9, TRANSLATIONAL, I=20, J=1", {"unread-argument 10:35"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=BEND:PRELOAD, FRICTION_ARM=2, BENDING_REACTION_ARM=2, PIN_RADIUS=3\nJOINT/9, REVOLUTE, I=20, J=1", {"unread-argument 10:43"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=REAC, FRICTION_ARM=2, BENDING_REACTION_ARM=2, PIN_RADIUS=3\nJOINT/9, HOOKE, I=20, J=1", {"unread-argument 10:51"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=PRELOAD, FRICTION_TORQUE_PRELOAD=2, MU_STATIC=0.3, TRANSITION=2, MAX=1\nJOINT/9, REVOLUTE, I=20, J=1", {"unread-argument 10:65", "joint-in-stiction 10:1"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=PRELOAD, FRICTION_TORQUE_PRELOAD=2, EFFECT=STICTION, TRANSITION=2\nJOINT/9, REVOLUTE, I=20, J=1", {"joint-in-stiction 10:1"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=PRELOAD, FRICTION_TORQUE_PRELOAD=2, FORMULATION=LUGRE, MU_STATIC=0.4\nJOINT/9, REVOLUTE, I=20, J=1", {"joint-in-stiction 10:1"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=NONE, PIN_RADIUS=2, MU_STATIC=0.4, FRICTION_ARM=1\nJOINT/9, REVOLUTE, I=20, J=1", {"unread-argument 10:35", "unread-argument 10:64"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=NONE\nJOINT/9, REVOLUTE, I=20, J=1", {}},
    {Place::added, "FRICTION/9, JOINT=9, EFFECT=SLIDING, INACTIVE=STATIC\nJOINT/9, REVOLUTE, I=20, J=1", {"unread-argument 10:38"}},
    {Place::added, "FRICTION/9, JOINT=9, EFFECT=SLIDING, FORMULATION=LUGRE, MU_STATIC=0.4\nJOINT/9, REVOLUTE, I=20, J=1", {"unexpected-argument 10:22"}},
    {Place::added, "FRICTION/9, JOINT=9, INPUTS=TORS, BALL_RADIUS=2, MU_STATIC=0.6\nJOINT/9, SPHERICAL, I=20, J=1", {"unread-argument 10:22", "unread-argument 10:35"}},
    {Place::added, "FRICTION/9, JOINT=9, MU_DYNAMIC=0.6\nJOINT/9, REVOLUTE, I=20, J=1", {"coefficient-order 10:22"}},
    {Place::added, "FRICTION/9, JOINT=9, MU_STATIC=0.2\nJOINT/9, REVOLUTE, I=20, J=1", {"coefficient-order 10:22"}},
    {Place::added, "FRICTION/9, JOINT=9, I_YOKE\nFRICTION/8, JOINT=9, J_YOKE\nFRICTION/7, JOINT=9\nJOINT/9, HOOKE, I=20, J=1", {"friction-twice 12:1"}},
    {Place::added, "FRICTION/9, JOINT=9, MU_STATIC=-1\nJOINT/9, REVOLUTE, I=20, J=1", {"value-out-of-range 10:32"}},
    {Place::added, "FRICTION/9, JOINT=9, TRANSITION=1, MAX=0\nJOINT/9, REVOLUTE, I=20, J=1", {"value-out-of-range 10:22", "value-out-of-range 10:36"}},
    {Place::added, "FRICTION/9, JOINT=9, EFFECT=SLOW\nJOINT/9, REVOLUTE, I=20, J=1", {"unknown-word 10:22"}},
    {Place::added, "FRICTION/9, JOINT=9, I_YOKE, J_YOKE\nJOINT/9, HOOKE, I=20, J=1", {"excluded-arguments 10:30"}},
    {Place::added, "FRICTION/9, JOINT=9, FORMULATION=LUGRE, EFFECT=SLIDING\nJOINT/9, HOOKE, I=20, J=1", {"unexpected-argument 10:41"}},
    {Place::added, "FRICTION/9, JOINT=9, FORM=LU, MU_DYNAMIC=0\nJOINT/9, HOOKE, I=20, J=1", {"value-out-of-range 10:31"}},
    {Place::added, "FRICTION/9, JOINT=9, DAMPING=1\nJOINT/9, HOOKE, I=20, J=1", {"unexpected-argument 10:22"}},
    {Place::added, "FRICTION/9, JOINT=8", {"unknown-element 10:19"}},
    {Place::added, "PART/9, GROUND, MASS=1", {"duplicate-ground 10:1", "argument-of-ground 10:9"}},
    {Place::added, "MARKER/9, PART=2, RM=8\nMARKER/8, PART=2, RM=9", {"circular-reference 10:1", "circular-reference 11:1"}},
    {Place::added, "MARKER/9, PART=2, REULER=1,2,3, ZP=1,2,3", {"conflicting-orientation 10:33"}},
    {Place::added, "MARKER/9, PART=2, ZP=0,0,0", {"degenerate-orientation 10:19"}},
    {Place::added, "MARKER/9, PART=2, ZP=0,0,1, XP=0,0,2", {"degenerate-orientation 10:29"}},
    {Place::added, "PART/9, MASS=1, MASS=2, CM=20", {"duplicate-argument 10:17"}},
    {Place::added, "PART/9, GROUND", {"duplicate-ground 10:1"}},
    {Place::added, "PART/2, MASS=1", {"duplicate-id 10:1"}},
    {Place::added, "UNITS/SYSTEM=MKS", {"duplicate-statement 10:1"}},
    {Place::added, "JOINT/9, REVOLUTE, FIXED, I=20, J=1", {"duplicate-variant 10:20"}},
    {Place::added, "FIELD/9, I=20, J=1, CRATIO=1, KMATRIX=1, CMATRIX=1", {"excluded-arguments 10:21", "wrong-count 10:31", "wrong-count 10:42"}},
    {Place::added, "VFORCE/9, I=20, JFLOAT=1, RM=1, FX=1", {"fixed-marker 10:1"}},
    {Place::added, "MARKER/9, PART=2, FLOATING\nJOINT/9, FIXED, I=9, J=1", {"floating-marker 11:1"}},
    {Place::added, "PART/9, MASS=1, CM=20", {"foreign-marker 10:1"}},
    {Place::added, "PART/9, MASS=1, CM=90\nMARKER/90, PART=9, FLOATING", {"foreign-marker 10:1"}},
    {Place::added, "MARKER/9, PART=2, RM=1", {"foreign-reference 10:1"}},
    {Place::added, "MOTION/9, JOINT=1, FUNCTION=DX(20,1)", {"function-of-state 10:29"}},
    {Place::added, "MOTION/9, JOINT=1, FUNCTION=VARVAL(9)\nVARIABLE/9, FUNCTION=DX(20,1)", {"function-of-state 11:22"}},
    {Place::added, "MOTION/9, JOINT=1, FUNCTION=VARVAL(9)\nVARIABLE/9, FUNCTION=TIME+VARVAL(9)", {"function-of-state 11:27"}},
    {Place::added, "PART/9, MASS=1, CM=90, IP=1,1,9\nMARKER/90, PART=9", {"impossible-inertia 10:1"}},
    {Place::added, "TFSISO/9, U=1, X=2, Y=3, NUM=1,2,3, DEN=1,2\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y", {"improper-transfer-function 10:26"}},
    {Place::added, "PART/9, CM=90, IP=1,1,1\nMARKER/90, PART=9", {"inertia-without-mass 10:16"}},
    {Place::added, "JOINT/9, FIXED, I=20", {"missing-argument 10:1"}},
    {Place::added, "PART/9, MASS=1", {"missing-cm 10:1"}},
    {Place::added, "PART/9, IP=1,1,1", {"missing-cm 10:1", "inertia-without-mass 10:9"}},
    {Place::whole, "t\nUNITS/SYSTEM=MKS\nPART/2, MASS=1, CM=20\nMARKER/20\nEND\n", {"missing-ground 0:0"}},
    {Place::added, "PART, MASS=1", {"not-a-statement 10:1"}},
    {Place::added, "MARKER, PART=2", {"not-a-statement 10:1"}},
    {Place::whole, "t\nMARKER/1\nPART/1, GROUND\nEND\n", {"missing-owner 2:1"}},
    {Place::added, "JOINT/9, I=20, J=1", {"missing-variant 10:1"}},
    {Place::added, "JPRIM/9, I=20, J=1", {"missing-variant 10:1"}},
    {Place::whole, "t\nUNITS/SYSTEM=MKS, LENGTH=METER\nPART/1, GROUND\nEND\n", {"mixed-units 2:1"}},
    {Place::whole, "t\nUNITS/LENGTH=METER\nPART/1, GROUND\nEND\n", {"mixed-units 2:1"}},
    {Place::added, "PART/9, MASS=1, CM=90, IP=1,1,-1\nMARKER/90, PART=9", {"negative-inertia 10:1"}},
    {Place::added, "MARKER/9, PART=2, FLOATING, QP=1,2,3", {"placed-floating-marker 10:19"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nJOINT/9, FIXED, I=90, J=1", {"rotation-of-point-mass 12:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nSPRINGDAMPER/9, ROTATIONAL, I=90, J=1, KT=1", {"rotation-of-point-mass 12:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nBUSHING/9, I=90, J=1, KT=1,1,1", {"rotation-of-point-mass 12:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nBUSHING/9, I=20, J=90, K=1,2,3", {"moment-on-point-mass 12:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nBUSHING/9, I=21, J=90, K=1,2,3", {"rotation-of-point-mass 12:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nBUSHING/9, I=20, J=90, K=1,1,1, FORCE=0,5,0", {"rotation-of-point-mass 12:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nBUSHING/9, I=21, J=90, K=1,1,1, C=1,0,0", {"rotation-of-point-mass 12:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nBUSHING/9, I=20, J=90, K=1,1,1, C=.2,.2,.2", {"moment-on-point-mass 12:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nFIELD/9, I=20, J=90, LENGTH=0,0,1,0,0,0, KMATRIX=1,0,0,0,0,0,0,1,0,0,0,0,0,0,1,0,0,0,"
     "0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0", {"rotation-of-point-mass 12:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nMARKER/91, FLOATING\nVTORQUE/9, I=20, JFLOAT=91, RM=1, TZ=5", {"rotation-of-point-mass 13:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nMARKER/91, FLOATING\nGFORCE/9, I=20, JFLOAT=91, RM=1, FX=1\\TZ=5", {"rotation-of-point-mass 13:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nMARKER/9, PART=1, FLOATING\nGFORCE/9, I=90, JFLOAT=9, RM=1, FX=1\\TZ=5", {"rotation-of-point-mass 13:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nMARKER/91, FLOATING\nGFORCE/9, I=20, JFLOAT=91, RM=1, FX=DX(90,20)\\TZ=0", {}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nBUSHING/9, I=20, J=90, K=2,2,2", {}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nBUSHING/9, I=90, J=20, K=1,2,3, C=.2,0,0", {}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90\nJOINT/9, SPHERICAL, I=90, J=1\nFRICTION/9, JOINT=9", {"rotation-of-point-mass 13:1"}},
    {Place::added, "MARKER/9, PART=2, FLOATING\nPART/8, MASS=1, CM=80, IP=1,1,1, VX=1, VM=9\nMARKER/80", {"floating-marker 11:1"}},
    {Place::added, "MARKER/9, PART=2, FLOATING\nPART/8, MASS=1, CM=80, IP=1,1,1, WX=1, WM=9\nMARKER/80", {"floating-marker 11:1"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, NODE_LABELS=1,2, X=0,1, AREA=1, IYY=1, IZZ=1, VX=1, VM=9\n"
     "MATERIAL/9, DENSITY=1, YOUNGS_MODULUS=1, POISSONS_RATIO=0\nMARKER/9, PART=2, FLOATING", {"floating-marker 10:1"}},
    {Place::added, "POINT_MASS/9, MASS=1, CM=90\nMARKER/90, FLOATING", {"foreign-marker 10:1"}},
    {Place::added, "MARKER/9, PART=2, FLOATING\nGCON/9, I=9, FUNCTION=DX(21,1)", {"floating-marker 11:1"}},
    {Place::added, "MARKER/9, PART=1, FLOATING\nPART/8, MASS=1, CM=80, IP=1,1,1\nMARKER/80\nJOINT/8, TRANS, I=80, J=1\nGEAR/9, JOINTS=1,8, CV=9",
     {"floating-marker 14:1"}},
    {Place::added, "MARKER/9, PART=2, FLOATING\nMARKER/90, PART=2, RM=9, QP=1,0,0", {"floating-marker 11:1"}},
    {Place::added, "MARKER/9, PART=1, FLOATING\nGFORCE/9, I=20, JFLOAT=9, RM=1, FUNCTION=1", {"unknown-word 11:33"}},
    {Place::added, "VARIABLE/8, FUNCTION=TRANS([TIME,0,0],99)*[1,0,0]", {"unknown-marker 10:39"}},
    {Place::added, "VARIABLE/8, FUNCTION=MAG(DXYZ(99,98))", {"unknown-marker 10:31", "unknown-marker 10:34"}},
    {Place::whole, "only a title\nEND\n", {"missing-ground 0:0"}},
    {Place::command, "SIMULATE/TRANSIENT, DISP, END=1", {"unexpected-argument 3:21"}},
    {Place::added, "JOINT/9, FIXED, I=20, J=21", {"same-body 10:1"}},
    {Place::added, "SFORCE/9, TRANSLATIONAL, I=20, J=21, FUNCTION=1", {"same-body 10:1"}},
    {Place::added, "JPRIM/9, INLINE, I=21, J=20", {"same-body 10:1"}},
    {Place::added, "LSE/8, X=2, U=1, A=1\nLSE/9, X=2, U=1, A=1\nMATRIX/1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1\nARRAY/1, U, VARIABLES=1\nARRAY/2, X", {"missing-argument 10:13", "missing-argument 11:13"}},
    {Place::added, "FLEX_BODY/9", {"missing-argument 10:1"}},
    {Place::added, "UCON/9", {"statement-not-built 10:1"}},
    {Place::added, "GSE/9, NO=1, Y=1, FUNCTION=USER(1)\nARRAY/1, Y", {"missing-routine 10:28"}},
    {Place::added, "MARKER/9, PART=2, POINT_MASS=7\nPOINT_MASS/7", {"two-owners 10:19"}},
    {Place::added, "ARRAY/9, U, X", {"two-types 10:1"}},
    {Place::added, "JOINT/9, SPHERICAL, I=20, J=1\nMOTION/9, JOINT=9, FUNCTION=1", {"undrivable-joint 11:1"}},
    {Place::added, "JOINT/9, FIXED, I=20, J=1\nCOUPLER/9, JOINTS=1,9, SCALES=1", {"undrivable-joint 11:1"}},
    {Place::added, "JOINT/9, PLANAR, I=20, J=1\nMOTION/9, JOINT=9, FUNCTION=TIME", {"undrivable-joint 11:1"}},
    {Place::added, "ARRAY/9, X, NUMBERS=1", {"unexpected-argument 10:13"}},
    {Place::added, "JOINT/9, REVOLUTE, I=20, J=1, PITCH=3", {"unexpected-argument 10:31"}},
    {Place::added, "JOINT/9, SCREW, I=20, J=1, PD=3", {"missing-argument 10:1", "unexpected-argument 10:28"}},
    {Place::added, "JOINT/9, SPHERICAL, I=20, J=1, IC=3", {"unexpected-argument 10:32"}},
    {Place::added, "MOTION/9, JOINT=1, FUNCTION=1, ICDISP=2", {"unexpected-argument 10:32"}},
    {Place::added, "PART/9=3", {"stray-equals 10:7"}},
    {Place::added, "JOINT/9, FIXED=3, I=20, J=1", {"missing-variant 10:1"}},
    {Place::added, "PART/9, FOO=1", {"unknown-argument 10:9"}},
    {Place::added, "SPRINGDAMPER/9, TRANSLATIONAL, I=20, J=1, KT=3", {"unexpected-argument 10:43"}},
    {Place::added, "SPRINGDAMPER/9, ROTATIONAL, I=20, J=1, K=3", {"unexpected-argument 10:40"}},
    {Place::added, "MARKER/9, PART=77", {"unknown-body 10:16"}},
    {Place::added, "MARKER/9, POINT_MASS=2", {"unknown-body 10:22"}},
    {Place::added, "JOINT/9, FIXED, I=20, J=77", {"unknown-marker 10:25"}},
    {Place::added, "VARIABLE/9, FUNCTION=VARVAL(77)", {"unknown-element 10:29"}},
    {Place::added, "MOTION/9, JOINT=77, FUNCTION=1", {"unknown-element 10:17"}},
    {Place::added, "VARIABLE/9, FUNCTION=AKISPL(TIME,0,77)", {"unknown-element 10:36"}},
    {Place::whole,
     "t\nUNITS/FORCE=NEWTON, MASS=KILOGRAM,\nLENGTH=METER, TIME=SECOND\nPART/1, GROUND\nEND\n",
     {"not-a-statement 3:1"}},
    {Place::whole, "t\nUNITS/LENGTH=FURLONG, MASS=KILOGRAM, FORCE=NEWTON, TIME=SECOND\nPART/1, GROUND\nEND\n", {"unknown-unit 2:7"}},
    {Place::added, "PART/9, EXACT=X:FOO", {"unknown-word 10:9"}},
    {Place::added, "COUPLER/9, JOINTS=1,1, SCALES=1, TYPE=T:Q", {"unknown-word 10:34"}},
    {Place::added, "MATRIX/9, FILE=no_such.mat, NAME=a", {"unreadable-file 10:11"}},
    {Place::added, "SPLINE/9, FILE=no_such.txt", {"unreadable-file 10:11"}},
    {Place::added, "SPRINGDAMPER/9, TRANSLATIONAL, I=20, J=1, K=-3", {"value-out-of-range 10:45"}},
    {Place::added, "BUSHING/9, I=20, J=1, K=1,-1,1", {"value-out-of-range 10:23"}},
    {Place::added, "PART/9, MASS=-1, CM=90", {"value-out-of-range 10:14", "unknown-marker 10:21"}},
    {Place::added, "LSE/9, X=1, U=1, A=1\nMATRIX/1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1\nARRAY/1, U, VARIABLES=1", {"missing-argument 10:13"}},
    {Place::added, "JOINT/9, CYLINDRICAL, I=20, J=1\nMOTION/9, JOINT=9, FUNCTION=1", {"wrong-freedom 11:1"}},
    {Place::added, "MOTION/9, JOINT=1, TRANSLATION, FUNCTION=1", {"wrong-freedom 10:1"}},
    {Place::added, "MOTION/9, I=20, J=1, FUNCTION=1", {"wrong-freedom 10:1"}},
    {Place::added, "MOTION/9, ROTATION, I=20, J=1, B3, FUNCTION=1", {"excluded-arguments 10:11"}},
    {Place::added, "MOTION/9, JOINT=1, I=20, J=1, X, FUNCTION=1", {"excluded-arguments 10:1"}},
    {Place::added, "MOTION/9, FUNCTION=1", {"missing-argument 10:1"}},
    {Place::added, "LSE/9, X=2, U=1, A=1\nMATRIX/1, FULL=RORDER, ROWS=1, COLUMNS=2, VALUES=1,2\nARRAY/1, U, VARIABLES=1\nARRAY/2, X", {"missing-argument 10:13"}},
    {Place::added, "MATRIX/9, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=1,2,3", {"wrong-count 10:43"}},
    {Place::added, "TFSISO/9, U=1, X=2, Y=3, NUM=1, DEN=1,2,0\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y", {"zero-leading-coefficient 10:33"}},
    {Place::added, "TFSISO/9, U=1, X=2, Y=3, NUM=1, DEN=2,8,1E-120\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y", {"spread-poles 10:33"}},
    {Place::added, "JOINT/9, REVOLUTE, I=29, J=1\nMARKER/29, PART=2, REULER=0,180D,0", {"opposed-axes 10:1"}},
    {Place::added, "GEAR/9, JOINTS=1,8, CV=20\nJOINT/8, REVOLUTE, I=20, J=1", {"suspicious-gear 10:1", "suspicious-gear 10:1", "empty-constraint 10:1"}},
    {Place::added, "GEAR/9, JOINTS=1,8, CV=5\nMARKER/5, PART=1, QP=1,0,0\nJOINT/8, REVOLUTE, I=20, J=1", {"suspicious-gear 10:1", "suspicious-gear 10:1", "empty-constraint 10:1"}},
    {Place::added, "GEAR/9, JOINTS=1, CV=1", {"wrong-count 10:9"}},
    {Place::added, "COUPLER/9, JOINTS=1, SCALES=1", {"wrong-count 10:12"}},
    {Place::added, "COUPLER/9, JOINTS=1,1,1, SCALES=1", {"same-joint-twice 10:12", "wrong-count 10:26"}},
    {Place::added, "GCON/9, FUNCTION=ACCX(20)", {"unfit-constraint 10:18"}},
    {Place::added, "GCON/9, FUNCTION=ABS(DX(20))", {"unfit-constraint 10:18"}},
    {Place::added, "GCON/9, FUNCTION=IMPACT(DX(20),VX(20),1,1E3,1.5,0,0.1)", {"unfit-constraint 10:18"}},
    {Place::added, "GCON/9, FUNCTION=JOINT(1,0,2,0)", {"unfit-constraint 10:18"}},
    {Place::added, "SPLINE/9, X=1,2,3, Y=1,2,3", {"spline-data 10:11"}},
    {Place::added, "SPLINE/9, X=1,2,2,3, Y=1,2,3,4", {"spline-data 10:11"}},
    {Place::added, "SPLINE/9, X=1,2,3,4, Y=1,2,3", {"wrong-count 10:22"}},
    {Place::added, "PART/9, QG=1,2,3, ZG=1,2,3, REULER=1,2,3", {"conflicting-orientation 10:19"}},
    {Place::added, ", QG=1,2,3", {"unknown-argument 10:3"}},
    {Place::whole, "t\n, MASS=1\nPART/1, GROUND\nEND\n", {"stray-continuation 2:1"}},
    {Place::added, "NFORCE/9, IMARKERS=20, J=1, FUNCTION=USER(1)", {"missing-routine 10:38"}},
    {Place::added, "BEAM/9, I=20, J=1, LENGTH=1, AREA=1, IXX=1, IYY=1, IZZ=1, EMOD=1, GMOD=1, FORM=STRING", {"argument-not-built 10:75"}},
    {Place::added, "SFORCE/9, ROTATIONAL, I=20, J=1", {"missing-argument 10:1"}},
    {Place::added, "VARIABLE/9, FUNCTION=BUSH(77,0,1,0)", {"unknown-element 10:27"}},
    {Place::added, "JOINT/9, SCREW, I=20, J=1", {"missing-argument 10:1"}},
    {Place::added, "JOINT/9, RACKPIN, I=20, J=1", {"missing-argument 10:1"}},
    {Place::command, "LINEAR/EIGENSOL, STATEMAT, FILE=x", {"excluded-arguments 3:18", "wrong-option 3:28"}},
    {Place::command, "LINEAR", {"missing-option 3:1"}},
    {Place::command, "LINEAR/MKB", {"missing-argument 3:8"}},
    {Place::command, "FOO/1", {"unknown-command 3:1"}},
    {Place::command, "SIMULATE/TRANSIENT", {"missing-argument 3:1"}},
    {Place::command, "SIMULATE/DYNAMICS, END=1, DURATION=1", {"excluded-arguments 3:27"}},
    {Place::command, "SIMULATE/DYNAMICS, END=1, STEPS=2, DTOUT=1", {"excluded-arguments 3:27"}},
    {Place::command, "SIMULATE/DYNAMICS, DURATION=-1, DTOUT=0", {"value-out-of-range 3:20", "value-out-of-range 3:33"}},
    {Place::command, "SIMULATE/STATICS, STEPS=3", {"missing-argument 3:19"}},
    {Place::command, "SIMULATE/INITIAL_CONDITIONS, END=3", {"unexpected-argument 3:30"}},
    {Place::command, "SIMULATE", {"missing-option 3:1"}},
    {Place::command, "LINEAR/EIGENSOL, MASS_PER_MODE=ALL, MODAL_RM=99", {"unknown-element 3:46"}},
    {Place::command, "LINEAR/EIGENSOL, ENERGY_PER_MODE=SOME", {"value-out-of-range 3:18"}},
    {Place::command, "LINEAR/EIGENSOL, NOVECTOR, ENERGY_PER_MODE=2,1", {"value-out-of-range 3:28", "excluded-arguments 3:28"}},
    {Place::command, "LINEAR/STATEMAT, FILE=x, KINETIC=1", {"wrong-option 3:26"}},
    {Place::command, "LINEAR/EIGENSOL, FILE=x", {"wrong-option 3:18"}},
    {Place::command, "FILE/COMMAND=x", {"unreadable-file 3:6"}},
    {Place::command, "FILE/COMMAND=model", {"command-file-cycle 3:6"}},
    {Place::command, "FILE/MODEL=x", {"missing-model 3:6"}},
    {Place::command, "LINEAR/EIGENSOL, PSTATE=9", {"unknown-element 3:25"}},
    {Place::command, "LINEAR/EIGENSOL, RM=9", {"unknown-element 3:21"}},
    {Place::command, "LINEAR/EXPORT", {"missing-argument 3:8", "missing-argument 3:8"}},
    {Place::command, "ACTIVATE/MOTION, ID=3", {"unknown-element 3:21"}},
    {Place::command, "ACTIVATE/JOINT, ID=1", {"already-so 3:20"}},
    {Place::command, "CONTROL/1", {"refused-command 3:1"}},
    {Place::command, "ENVIRONMENT/VALUE=1", {"missing-argument 3:1"}},
    {Place::command, "LINEAR/EIGENSOL, ORIGINAL=1", {"unexpected-value 3:18"}},
    {Place::command, "LINEAR/STATEMAT, FILE=x, NODAMPIN, ORIGINAL", {"wrong-option 3:26"}},
    {Place::command, "LINEAR/EXPORT, TYPE=CLOSEDBOX, FILE=-", {"wrong-option 3:32"}},
    {Place::command, "LINEAR/EXPORT, TYPE=BOX, FILE=x", {"unknown-word 3:16"}},
    {Place::command, "LINEAR/EXPORT, TYPE=OPENBOX, FILE=x, RM=1, PINPUT=1, KINETIC=1, NODAMPIN, NAMES, ORIGINAL", {"wrong-option 3:38", "wrong-option 3:44", "wrong-option 3:54", "wrong-option 3:65", "wrong-option 3:75", "wrong-option 3:82"}},
    {Place::command, "LINEAR/EXPORT, TYPE=OPENBOX, FILE=x, CONFIG=nowhere.cfg", {"unreadable-file 3:45"}},
    {Place::command, "LINEAR/MKB, FILE=x, CONFIG=a", {"wrong-option 3:21"}},
    {Place::added, "SPRINGDAMPER/9, TRANSLATIONAL, I=20, J=1, K=3, ANGLE=2", {"unexpected-argument 10:48"}},
    {Place::added, "PART/9, M=1, CM=20, V=3", {"ambiguous-argument 10:21"}},
    {Place::added, "ARRAY/9, U, VARIABLES=1\nLSE/9, X=9, U=9, A=1, B=1\nMATRIX/1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1", {"wrong-array-type 11:1"}},
    {Place::added, "ARRAY/7, X\nARRAY/9, U, VARIABLES=1\nLSE/8, X=7, U=9, A=1, B=1\nLSE/9, X=7, U=9, A=1, B=1\nMATRIX/1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1", {"shared-array 13:1"}},
    {Place::added, "ARRAY/7, X, SIZE=3\nARRAY/9, U, VARIABLES=1\nLSE/8, X=7, U=9, A=1, B=1\nMATRIX/1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1", {"wrong-size 10:1"}},
    {Place::added, "PART/9, MASS=1, CM=90, IM=20\nMARKER/90, PART=9", {"foreign-marker 10:1"}},
    {Place::added, "MARKER/9, PART=2, USEXP, ZP=0,0,1", {"missing-argument 10:19"}},
    {Place::added, "MARKER/9, PART=2, ZP=1,0,0, USEXP, XP=2,0,0", {"degenerate-orientation 10:19"}},
    {Place::added, "MARKER/9, PART=2, XP=0,0,2", {"degenerate-orientation 10:19"}},
    {Place::added, "MARKER/9, PART=2, QP=1,1,0, XP=1,1,-3", {"degenerate-orientation 10:29"}},
    {Place::added, "PART/9, GROUND\nPART/10, GROUND", {"duplicate-ground 10:1", "duplicate-ground 11:1"}},
    {Place::added, "JOINT/1, FIXED, I=20, J=1", {"duplicate-id 10:1"}},
    {Place::added, "MARKER/20, PART=1", {"duplicate-id 10:1"}},
    {Place::added, "JOINT/9, FIXED, I=77, J=78", {"unknown-marker 10:19", "unknown-marker 10:25"}},
    {Place::added, "GEAR/9, JOINTS=1,8, CV=5\nMARKER/5, PART=3\nPART/3\nPART/4\nMARKER/40, PART=4\nJOINT/8, REVOLUTE, I=40, J=20", {"foreign-marker 10:1", "foreign-marker 10:1"}},
    {Place::added, "VARIABLE/9, FUNCTION=((1+2)", {"unbalanced-parenthesis 10:22"}},
    {Place::added, "VARIABLE/9, FUNCTION=SINN(1)", {"unknown-function 10:22"}},
    {Place::added, "SPLINE/9, X=1,2,3,4", {"missing-argument 10:1"}},
    {Place::added, "VFORCE/9, I=20, JFLOAT=9, RM=1, FX=1\nMARKER/9, PART=2, FLOATING", {"same-body 10:1"}},
    {Place::added, "MARKER/9, PART=1, FLOATING\nVFORCE/9, I=20, JFLOAT=9, RM=9, FX=1", {"floating-marker 11:1"}},
    {Place::added, "MATRIX/9, SPARSE, I=1, J=3, VALUES=2, ROWS=2, COLUMNS=2", {"value-out-of-range 10:19"}},
    {Place::added, "MATRIX/9, ROWS=2", {"missing-argument 10:1"}},
    {Place::added, "MATRIX/9, SPARSE, I=1,1, J=1,1, VALUES=-1,-2", {"matrix-entry 10:23"}},
    {Place::added, "MATRIX/9, SPARSE, ROWS=2, I=1,2,2,1, J=1,1,2,1, VALUES=1,2,3,1", {"matrix-entry 10:35"}},
    {Place::added, "MATRIX/9, SPARSE, I=1, J=1, VALUES=1, FILE=a, NAME=b", {"excluded-arguments 10:39"}},
    {Place::added, "MATRIX/9, SPARSE, I=1, J=1, VALUES=1, FULL=RORDER", {"excluded-arguments 10:11"}},
    {Place::added, "C=1", {"not-a-statement 10:1"}},
    {Place::added, "PA/9, MA=1", {"missing-cm 10:1"}},
    {Place::added, "ACCGRAV/IGRAV=1, FOO=2", {"unknown-argument 10:18"}},
    {Place::added, "MARKER/9, PART=2, REULER=1,2", {"wrong-count 10:26"}},
    {Place::command, "SI", {"missing-option 3:1"}},
    {Place::command, "SIMULATE/DYNAMICS, END=1E300", {"value-out-of-range 3:24"}},
    {Place::command, "SIMULATE/DYNAMICS, DURATION=1E300, STEPS=3", {"value-out-of-range 3:29"}},
    {Place::command, "SIMULATE/DYNAMICS, END=1, STEPS=1000000000", {"value-out-of-range 3:33"}},
    {Place::command, "SIMULATE/DYNAMICS, END=NaN, STEPS=2", {"expected-number 3:24"}},
    {Place::command, "SIMULATE/DYNAMICS, END=1E999, STEPS=2", {"number-overflow 3:24"}},
    {Place::command, "FILE/MODEL=m, FOO=1", {"unknown-argument 3:15"}},
    {Place::command, "LINEAR/EIG, NODAMPIN=3", {"unexpected-value 3:13"}},
    {Place::command, "LINEAR/EIGENSOL\nFILE/MODEL=m", {"missing-model 4:6"}},
    {Place::command, "LINEAR/STATEMAT", {"missing-argument 3:8"}},
    {Place::command, "LINEAR/STATEMAT, FILE=x, FORMAT=FOO", {"unknown-word 3:26"}},
    {Place::added, "INTEGRATOR/GSTIFF, HHT", {"excluded-arguments 10:20"}},
    {Place::command, "INTEGRATOR/SI2, I3", {"excluded-arguments 3:17"}},
    {Place::command, "INTEGRATOR/ERROR=0", {"value-out-of-range 3:12"}},
    {Place::command, "INTEGRATOR/HMAX=1, HMIN=2", {"value-out-of-range 3:12"}},
    {Place::command, "INTEGRATOR/GSTIFF, KMAX=9", {"value-out-of-range 3:20"}},
    {Place::command, "INTEGRATOR/INTERPOLATE=MAYBE", {"unknown-word 3:12"}},
    {Place::command, "EQUILIBRIUM/STATIC, DYNAMIC", {"excluded-arguments 3:21"}},
    {Place::command, "PREFERENCES/SIMEXIT=MAYBE", {"unknown-word 3:13"}},
    {Place::command, "PREFERENCES/STATUS_MESSAGE=MAYBE", {"unknown-word 3:13"}},
    {Place::added, "PREFERENCES/SOLVER=XX", {"unknown-word 10:13"}},
    {Place::command, "OUTPUT/REQSAVE, NOREQSAVE", {"excluded-arguments 3:17"}},
    {Place::added, "COUPLER/1, JOINTS=1,1, SCALES=1,2", {"same-joint-twice 10:12"}},
    {Place::added, "JOINT/2, CYLINDRICAL, I=21, J=1\nCOUPLER/1, JOINTS=1,2,2, TYPE=R:T:T, SCALES=1,2,1", {"same-joint-twice 11:12"}},
    {Place::added, "GEAR/1, JOINTS=1,1, CV=1", {"same-joint-twice 10:9"}},
    {Place::added, "MARKER/9, PART=2, REULER=0,60D,0\nSPRINGDAMPER/1, ROTATIONAL, I=9, J=1, KT=1", {"skew-axes 11:1"}},
    {Place::added, "MARKER/9, PART=2, REULER=0,180D,0\nSFORCE/1, ROTATIONAL, I=9, J=1, FUNCTION=1", {"skew-axes 11:1", "accelerating-point 5:1"}},
    {Place::added, "SFORCE/1, TRANSLATIONAL, I=20, J=1, FUNCTION=0", {"no-line-of-action 10:1"}},
    {Place::added, "PART/9, MASS=2D, CM=90, IP=1,1,1\nMARKER/90, PART=9", {"degrees-without-angle 10:14"}},
    {Place::added, "MARKER/9, PART=2, QP=1,90D,0", {"degrees-without-angle 10:24"}},
    {Place::added, "TFSISO/9, U=1, X=2, Y=3, NUM=30D, DEN=1,2D\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y", {"degrees-without-angle 10:30", "degrees-without-angle 10:41"}},
    {Place::added, "MATRIX/9, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=30D\nARRAY/9, IC, NUMBERS=30D\nSPLINE/9, X=1D,2D,3D,4D, Y=1D,2D,3D,4D\nVARIABLE/9, IC=30D, FUNCTION=1", {}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9, FUNCTION=USER(1)\nMATRIX/9, FULL=RORDER, ROWS=1, COLUMNS=3, VALUES=1,2,3", {"missing-routine 10:35"}},
    {Place::command, "LINEAR/STATEMAT, FILE=model.adm", {"file-in-use 3:23"}},
    {Place::command, "LINEAR/STATEMAT, FILE=model.msg", {"file-in-use 3:23"}},
    {Place::command, "LINEAR/STATEMAT, FILE=nowhere/x", {"unwritable-file 3:23"}},
    {Place::command, "LINEAR/STATEMAT, FILE=x\nPART/2, MASS=2\nLINEAR/STATEMAT, FILE=./x", {"replaced-result 5:23"}},
    {Place::command, "LINEAR/STATEMAT, FILE=x\nLINEAR/MKB, FILE=x", {"replaced-result 4:18"}},
    {Place::command, "LINEAR/STATEMAT, FILE=x\nSAVE/STATES, FILE=x", {"file-in-use 3:23"}},
    {Place::command, "LINEAR/EIGENSOL, COORDS=1, TABLE_PRECISION=2147483647", {"value-out-of-range 3:44"}},
    {Place::command, "LINEAR/EIGENSOL, COORDS=1, TABLE_PRECISION=1E300", {"expected-integer 3:44"}},
    {Place::added, "RESULTS/XRF, DECIMALPLACES=1E300", {"expected-integer 10:28"}},
    {Place::added, "RESULTS/XRF, DECIMALPLACES=2147483647", {"value-out-of-range 10:28"}},
    {Place::added, "RESULTS/DECIMALPLACES=0", {"value-out-of-range 10:23"}},
    {Place::added, "MATRIX/9, FULL=RORDER, ROWS=4294967296, COLUMNS=4294967296, VALUES=1", {"wrong-count 10:61"}},
    {Place::added, "MATRIX/9, SPARSE, ROWS=2147483647, COLUMNS=2147483647, I=1, J=1, VALUES=1", {"value-out-of-range 10:11"}},
    {Place::added, "MATRIX/9, SPARSE, I=2147483647, J=2147483647, VALUES=1", {"value-out-of-range 10:11"}},
    {Place::added, "MATRIX/9, SPARSE, I=0, J=0, VALUES=1", {"value-out-of-range 10:19"}},
    {Place::command, "LINEAR/EIGENSOL, MLIST=0, MRANGE=1", {"unknown-element 3:24"}},
    {Place::added, "CURVE/9, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=1, COLUMNS=3, VALUES=1,2,3", {"missing-argument 10:1"}},
    {Place::added, "CURVE/9, OPEN, CLOSED, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=1, COLUMNS=3, VALUES=1,2,3", {"excluded-arguments 10:16"}},
    {Place::added, "CURVE/9, OPEN", {"missing-argument 10:1"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=8", {"unknown-element 10:23"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9", {"curve-data 10:16"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=2, VALUES=1,2,3,4,5,6,7,8", {"wrong-size 10:16"}},
    {Place::added, "CURVE/9, CLOSED, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"curve-data 10:18"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,1,2,3,1,2,3,1,2,3", {"curve-data 10:16"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9, ORDER=1\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"value-out-of-range 10:26"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9, ORDER=2\nMATRIX/9, FULL RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"rough-curve 10:26"}},
    {Place::added, "CURVE/9, CLOSED, MATRIX=9, ORDER=3\nMATRIX/9, FULL, RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,3", {"rough-curve 10:28"}},
    {Place::added, "MATRIX/9, FULL=RORDER, CORDER, ROWS=1, COLUMNS=1, VALUES=1", {"unknown-word 10:11"}},
    {Place::added, "MATRIX/9, FULL, ROWS=1, COLUMNS=1, VALUES=1", {"unknown-word 10:11"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9, ORDER=5\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"value-out-of-range 10:26"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9, ORDER=17\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"value-out-of-range 10:26"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9, CONTROL_POINTS=5\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"argument-not-built 10:26"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9, CURVE_POINTS, CONTROL_POINTS\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"excluded-arguments 10:40"}},
    {Place::added, "CURVE/9, OPEN, MATRIX=9, MINPAR=0\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"unexpected-argument 10:26"}},
    {Place::added, "PTCV/9, I=20, JFLOAT=9, RM=1\nMARKER/9, PART=1, FLOATING", {"missing-argument 10:1"}},
    {Place::added, "PTCV/9, I=20, JFLOAT=9, RM=1, CURVE=7\nMARKER/9, PART=1, FLOATING", {"unknown-element 10:37"}},
    {Place::added, "PTCV/9, I=20, JFLOAT=9, RM=1, CURVE=9, ICM=1\nMARKER/9, PART=1, FLOATING\nCURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"unexpected-argument 10:40"}},
    {Place::added, "PTCV/9, I=20, JFLOAT=9, RM=1, CURVE=9\nMARKER/9, PART=1\nCURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"fixed-marker 10:1"}},
    {Place::added, "PTCV/9, I=20, JFLOAT=9, RM=1, CURVE=9\nMARKER/9, PART=2, FLOATING\nCURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"foreign-marker 10:1"}},
    {Place::added, "PTCV/9, I=20, JFLOAT=9, RM=21, CURVE=9\nMARKER/9, PART=2, FLOATING\nCURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"same-body 10:1"}},
    {Place::added, "PTCV/9, I=20, JFLOAT=9, RM=1, CURVE=9, DISP=1,2,3, ICM=20\nMARKER/9, PART=1, FLOATING\nCURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"foreign-marker 10:1"}},
    {Place::added, "CVCV/9, IFLOAT=8, ICURVE=9, IRM=20, JFLOAT=9, JCURVE=9, JRM=1\nMARKER/9, PART=1, FLOATING\nMARKER/8, PART=2, FLOATING\nCURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"curve-data 10:1"}},
    {Place::added, "CVCV/9, IFLOAT=8, ICURVE=9, IRM=20, JFLOAT=8, JCURVE=9, JRM=1\nMARKER/8, PART=2, FLOATING\nCURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,0,4,5,0,7,8,0,1,2,0", {"foreign-marker 10:1"}},
    {Place::added, "CVCV/9, IFLOAT=8, ICURVE=9, IRM=20, JCURVE=9, JRM=1, IICM=20\nMARKER/8, PART=2, FLOATING\nCURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,0,4,5,0,7,8,0,1,2,0", {"missing-argument 10:1"}},
    {Place::added, "VARIABLE/9, FUNCTION=CURVE(0.5,0,1,77)", {"unknown-element 10:36"}},
    {Place::added, "VARIABLE/9, FUNCTION=1+DX(9)\nMARKER/9, PART=1, FLOATING", {"unplaced-marker 10:24"}},
    {Place::added, "VARIABLE/9, FUNCTION=ARYVAL(9,1)\nARRAY/9, X", {"unfilled-entry 10:22"}},
    {Place::added, "GCON/9, FUNCTION=DX(20,1,9)\nPTCV/9, I=20, JFLOAT=9, RM=1, CURVE=9\nMARKER/9, PART=1, FLOATING\nCURVE/9, OPEN, MATRIX=9\nMATRIX/9, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4", {"unfit-constraint 10:18"}},
    {Place::added, "FIELD/9, I=20, J=1, FUNCTION=USER(1,2), LENGTH=1,2,3,4,5,6", {"missing-routine 10:30"}},
    {Place::added, "FIELD/9, I=20, J=1, FUNCTION=3*DX(20,1)", {"unknown-word 10:21"}},
    {Place::added, "FIELD/9, I=20, J=1, NONLINEAR, KMATRIX=1", {"unknown-argument 10:21"}},
    {Place::added, "VARIABLE/9, FUNCTION=NFORCE(1,0,2,0)", {"function-not-built 10:22"}},
    {Place::added, "FLEX_BODY/9\nMFORCE/9, FLEX_BODY=9, CASE_INDEX=1, SCALE=SIN(TIME)", {"missing-argument 10:1"}},
    {Place::added, "FLEX_BODY/9, MATRICES=9\nMATRIX/9, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1", {"body-matrices 10:14", "body-matrices 11:1"}},
    {Place::added, "FLEX_BODY/9, MATRICES=91,92,93,94,95,96,97,98,99,90,89, CRATIO=0\\, GENERALIZED_DAMPING=FULL\n"
     "MATRIX/91, NAME=SELNOD, FULL=RORDER, ROWS=1, COLUMNS=4, VALUES=1,0,0,0\n"
     "MATRIX/92, NAME=T_MODE, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=1,0,0\n"
     "MATRIX/93, NAME=R_MODE, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0\n"
     "MATRIX/94, NAME=GENSTIFF, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=8\n"
     "MATRIX/95, NAME=INVAR1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=3\n"
     "MATRIX/96, NAME=INVAR2, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0\n"
     "MATRIX/97, NAME=INVAR3, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0\n"
     "MATRIX/98, NAME=INVAR4, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0\n"
     "MATRIX/99, NAME=INVAR6, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=2\n"
     "MATRIX/89, NAME=GENDAMP, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=-2\n"
     "MATRIX/90, NAME=INVAR7, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=1,0,0,0,1,0,0,0,1",
     {"body-file-doubt 10:14", "body-damping 10:68"}},
    {Place::added, "FLEX_BODY/9, MATRICES=91,92,93,94,95,96,97,98,99,90\nMFORCE/9, FLEX_BODY=9, CASE_INDEX=1, SCALE=1\n"
     "MATRIX/91, NAME=SELNOD, FULL=RORDER, ROWS=1, COLUMNS=4, VALUES=1,0,0,0\n"
     "MATRIX/92, NAME=T_MODE, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=1,0,0\n"
     "MATRIX/93, NAME=R_MODE, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0\n"
     "MATRIX/94, NAME=GENSTIFF, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=8\n"
     "MATRIX/95, NAME=INVAR1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=3\n"
     "MATRIX/96, NAME=INVAR2, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0\n"
     "MATRIX/97, NAME=INVAR3, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0\n"
     "MATRIX/98, NAME=INVAR4, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0\n"
     "MATRIX/99, NAME=INVAR6, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=2\n"
     "MATRIX/90, NAME=INVAR7, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=1,0,0,0,1,0,0,0,1",
     {"body-file-doubt 10:14", "missing-load 11:24"}},
    {Place::added, "MFORCE/9, FLEX_BODY=9, CASE_INDEX=1, SCALE=1", {"unknown-body 10:21"}},
    {Place::added, "FE_LOAD/9, FE_PART=3, FX=1", {"unknown-body 10:20"}},
    {Place::added, "FE_LOAD/9, FX=1", {"missing-argument 10:1"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, NODE_LABELS=1,2, X=0,1, AREA=1, IYY=1, IZZ=1\n"
     "MATERIAL/9, DENSITY=1, YOUNGS_MODULUS=1, POISSONS_RATIO=0\nMARKER/9, PART=2, FLOATING\n"
     "FE_LOAD/1, FE_PART=9\nFE_LOAD/2, FE_PART=9, RM=77, FX=1\nFE_LOAD/3, FE_PART=9, FX=SD(7)\n"
     "FE_LOAD/4, FE_PART=9, FUNCTION=USER(1)\nFE_LOAD/5, FE_PART=9, FUNCTION=3\nFE_LOAD/6, FE_PART=2, FX=1",
     {"missing-argument 13:1", "unknown-marker 14:26", "argument-range 15:29", "missing-routine 16:32",
      "argument-not-built 17:23", "unknown-body 18:20"}},
    {Place::added, "FE_PART/9, TYPE=3DBEAM, MATERIAL=9, NODE_LABELS=1,2, X=0,1, AREA=1, IYY=1, IZZ=1\n"
     "MATERIAL/9, DENSITY=1, YOUNGS_MODULUS=1, POISSONS_RATIO=0\nMARKER/9, PART=2, FLOATING\n"
     "FE_LOAD/1, FE_PART=9, RM=9, FX=1", {"floating-marker 13:1"}},
    {Place::added, "VARIABLE/9, FUNCTION=1+S", {"misplaced-function 10:24"}},
    {Place::added, "VARIABLE/9, FUNCTION=1+SV(2)", {"misplaced-function 10:24"}},
    {Place::added, "VARIABLE/9, FUNCTION=SA(0)+SD(7)", {"argument-range 10:25", "argument-range 10:31"}},
    {Place::added, "FLEX_BODY/9\nMFORCE/9, FLEX_BODY=9, CASE_INDEX=1", {"missing-argument 10:1", "missing-argument 11:24"}},
    {Place::added, "FLEX_BODY/9\nMFORCE/9, FLEX_BODY=9, FORCE=USER(1)", {"missing-argument 10:1", "missing-routine 11:30"}},
    {Place::added, "PART/, MASS=1", {"missing-id 10:1"}},
    {Place::added, "JOINT/, FIXED, I=20, J=1", {"missing-id 10:1"}},
    {Place::added, "PART/9, MASS=1, CM=1E2D, QG=1,2,3", {"expected-integer 10:20"}},
    {Place::added, "PART/9, QG=1D3,2,3", {"expected-number 10:13"}},
    {Place::added, "PART/9, MASS=1.5D3E2", {"expected-number 10:17"}},
    {Place::added, "JOINT/9, UNIVERSAL, I=21, J=1", {"parallel-axes 10:1"}},
    {Place::command, "LINEAR/STATEMAT, FILE=x, PINPUT=7, POUTPUT=8", {"unknown-element 3:33", "unknown-element 3:44"}},
    {Place::command, "LINEAR/EIGENSOL, MLIST=1,20,999, MRANGE=1", {"unknown-element 3:29"}},
    {Place::command, "INFO/DISPLACEMENT, I=20, J=999", {"unknown-element 3:28"}},
    {Place::command, "RELOAD/STATES, FILE=nofile", {"unusable-save 3:21"}},
    {Place::command, "LINEAR/EIGENSOL\nSTOP/FOO", {"unknown-argument 4:6"}},
    {Place::command, "LINEAR/EIGENSOL\nSTOP/5", {"unexpected-text 4:1"}},
    {Place::added, "END/5\nVARIABLE/55, FUNCTION=1", {"unexpected-text 10:5"}},
    {Place::added, "VARIABLE/9, FUNCTION=1E-400", {"number-underflow 10:22"}},
    {Place::added, "REQUEST/1, F2=TIME, CNAMES=\"a\",\"b\",\"c\",\"d\",\"e\",\"f\",\"g\",\"h\",\"i\"", {"wrong-count 10:21"}},
    {Place::added, "EQUILIBRIUM/MAXIT=3\nEQUILIBRIUM/MAXIT=9", {"duplicate-argument 11:13"}},
    {Place::added, "OUTPUT/REQSAVE\nOUTPUT/NOREQSAVE", {"duplicate-argument 11:8"}},
    {Place::added, "RESULTS/XRF, DECIMALPLACES=8\nRESULTS/DECIMALPLACES=9", {"duplicate-argument 11:9"}},
    {Place::added, "MARKER/9, PART=2, REULER=0,90D,0\nBUSHING/9, I=9, J=1, KT=1,1,1", {"skew-axes 11:1"}},
    {Place::added, "RESULTS/", {"passed-over 10:1"}},
    {Place::added, "VARIABLE/9, FUNCTION=0\nVARIABLE/8, FUNCTION=0\nPINPUT/1, VARIABLES=9,8,9,9\nPOUTPUT/1, VARIABLES=8,8", {"variable-twice 12:25", "variable-twice 13:24"}},
    {Place::command, "LINEAR/EIGENSOL, KINETIC=1, NAMES", {"passed-over 3:29"}},
  };
  // clang-format on
  return rows;
}

class WrongInput : public Cases, public ::testing::WithParamInterface<std::size_t> {};

// "code line:column" of every problem of the two files, in the order of the output.
std::vector<std::string> problems_of(const std::string& err) {
  std::vector<std::string> list;
  std::istringstream lines(err);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t bracket = line.rfind(" [");
    const bool error = line.find("error: ") != std::string::npos, warning = line.find("warning: ") != std::string::npos;
    if (bracket == std::string::npos || line.back() != ']' || (!error && !warning)) continue;
    const std::string code = line.substr(bracket + 2, line.size() - bracket - 3);
    const std::size_t file = line.find("model.a");
    std::string at = "0:0";
    if (file != std::string::npos) at = line.substr(file + 10, line.find(": ", file) - file - 10);
    list.push_back(code + " " + at);
  }
  return list;
}

TEST_P(WrongInput, is_reported_with_code_line_and_column) {
  const Wrong& w = table()[GetParam()];
  write("model.adm", w.place == Place::whole
                         ? w.text
                         : sound + (w.place == Place::added ? std::string(w.text) + "\n" : "") + "END\n");
  write("model.acf", std::string("model\nmodel\n") + (w.place == Place::command ? w.text : "LINEAR/EIGENSOL") + "\n");
  const RunResult r = run_file("model.acf");
  EXPECT_EQ(problems_of(r.err), w.problems) << w.text << "\n" << r.err;
  const bool wrong = r.err.find("error: ") != std::string::npos && r.status == 1;
  if (wrong) {
    EXPECT_FALSE(r.wrote("model.msg"));
    EXPECT_FALSE(r.wrote("results.json"));
  }
}
INSTANTIATE_TEST_SUITE_P(table, WrongInput, ::testing::Range<std::size_t>(0, table().size()));

TEST(WrongInputTable, has_every_code_but_those_that_unit_tests_hold) {
  std::set<std::string> covered = {
      // dataset/statements_test, lexer and parser tests
      "ambiguous-keyword", "degrees-not-exponent", "not-text", "too-many-errors", "empty-expression", "missing-id",
      // command_file_test, edit_commands_test
      "dropped-argument", "missing-model", "inactive-joint",
      // newcomer_test
      "missing-prefix",
      // implicit_diff_test
      "unfit-condition",
      // dataset/matrix_file_test
      "matrix-complex", "matrix-count", "matrix-empty-column", "matrix-entry", "matrix-file-type", "matrix-header",
      "matrix-implied-point", "matrix-missing", "matrix-number", "matrix-scale-factor", "matrix-truncated",
      // nastran/configuration_test, nastran/deck_text_test
      "directive-syntax", "directive-value", "dropped-entries", "ignored-directive", "missing-directive",
      "unknown-channel", "unknown-directive",
      // export_test
      "ambiguous-name", "idle-channel", "taken-number", "two-markers",
      // parameter_test
      "no-parameter", "unstated-number",
      // save_reload_test
      "unusable-save",
      // contact_test
      "contact-pair-not-built", "contact-shape", "contact-without-mass",
      // flex_body_test
      "binary-body-file", "body-file", "body-file-doubt", "body-mass", "body-stiffness", "unknown-node",
      // routines/user_routine_test
      "differenced-routine", "missing-routine", "routine-failed", "unusable-library"};
  for (const Wrong& w : table()) {
    for (const std::string& p : w.problems) covered.insert(p.substr(0, p.find(' ')));
  }
  // What these lists have is held by remark_test, failure_code_test, nastran_reader/check_test and
  // reduction/reduce_program_test.
  static constexpr std::string_view elsewhere[] = {
#define DYNALIN_DIAGNOSTIC(code, text, advice) code,
#include "base/diagnostics/failures.def"
#include "base/diagnostics/nastran_reader.def"
#include "base/diagnostics/reduction.def"
#include "base/diagnostics/remarks.def"
#undef DYNALIN_DIAGNOSTIC
  };
  covered.insert(std::begin(elsewhere), std::end(elsewhere));
  for (const Explanation& e : explanations()) EXPECT_TRUE(covered.contains(std::string(e.code))) << e.code;
}

}  // namespace
}  // namespace dynalin::cases::wrong_input_test
