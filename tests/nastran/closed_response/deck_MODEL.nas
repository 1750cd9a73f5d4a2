$ Linear model at time 0, CLOSEDBOX
$ --- grid points ---
$ground
GRID*   1                               0.              0.
*       0.                              123456
$MARKER/21
GRID*   4                               0.              0.
*       1.              100
$ --- scalar points ---
SPOINT* 2               THRU            3
*
$ --- coordinate systems ---
$MARKER/21
CORD2R* 100             0               0.              0.
*       1.              0.              0.              2.
*       1.              0.              1.
*
$ --- relations ---
$MARKER/21
MPC*    1               4               1               -.25
*       2               0               1.
MPC*    1               4               2               1.
*       3               0               -.5
$ --- fixed points ---
$MARKER/21
SPC*    1               4               3456            0.
*
