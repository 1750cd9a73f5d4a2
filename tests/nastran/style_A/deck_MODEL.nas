$ Linear model at time 0.5, OPENBOX
$ --- grid points ---
$ground
GRID*   1                               0.              0.
*       0.                              123456
$centre of mass of model.PART_2
GRID*   2                               .333333333333333-2.5
*       0.
$centre of mass of model.PART_3
GRID*   3                               1.-7            1250.
*       -.125
$model.PART_2.MARKER_21
GRID*   1000021                         0.              0.
*       1.              100
$model.ground.MARKER_1
GRID*   1000001                         0.              0.
*       1.              100             123456
$model.PART_3.MARKER_31
GRID*   1000031                         0.              10.
*       0.
$nothing has this
GRID*   1000099                         7.              7.
*       7.
$ --- scalar points ---
$TFSISO/1
SPOINT* 3000001         THRU            3000002
*
$DIFF/4
SPOINT* 3000004
*
$ --- coordinate systems ---
$axes of model.PART_2.MARKER_21
CORD2R* 100             0               0.              0.
*       1.              0.              0.              10001.
*       8.+3            6.+3            1.
*
$ --- masses ---
$model.PART_2
CONM2*  1               2               0               12.5
*
*       4.              -.5             5.              .25
*       -.125           6.
$model.PART_3
CONM2*  2               3               0               .001
*
$ --- rigid elements ---
$model.PART_2
RBE2*   4               2               123456          1000021
*
$model.PART_3
RBE2*   5               3               123456          1000031
*
$ --- rigid joints ---
$model.JOINT_1
RJOINT* 3               1000001         1000021         12345
*
$ --- bushings ---
$model.BUSHING_1
CBUSH*  6000000         6000000         1000031         1000021
*                                                       100
*       1.
*
$model.FIELD_2
CBUSH*  6000001         6000001         1000031
*                                                       0
$ --- properties of bushings ---
$model.BUSHING_1
PBUSH*  6000000         K               1.+4            2.+4
*       3.+4            0.              0.              5.
*                       B               10.             20.
*       30.             0.              0.              0.
$model.FIELD_2
PBUSH*  6000001         K               0.              0.
*       0.              0.              0.              0.
$ --- relations ---
$model.JOINT_2
MPC*    1               2               1               -.375
*       3               1               1.
*                       3000004         0               -.07142857142857
*
$model.JOINT_3
MPC*    1               3               2               .333333333333333
*       2               2               -.33333333333333
*                       2               5               1.
*
$ --- fixed points ---
$model.PART_3
SPC*    1               3               45              0.
*
$model.JOINT_2
SPC*    1               3               6               0.
*
$ --- initial conditions ---
$model.PART_2
TIC*    2               2               1               0.
*       -1.5
$DIFF/4
TIC*    2               3000004         0               2.
*       0.
