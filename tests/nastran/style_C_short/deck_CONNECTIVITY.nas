$ Linear model at time 0.5, OPENBOX
$ --- grid points ---
$ground
GRID    1               0.      0.      0.              123456
$model.ground.MARKER_1
GRID    1000001         0.      0.      1.      100     123456
$ --- scalar points ---
$TFSISO/1
SPOINT  3000001 THRU    3000002
$DIFF/4
SPOINT  3000004
$ --- rigid joints ---
$model.JOINT_1
RJOINT  3       1000001 1000021 12345
$ --- bushings ---
$model.BUSHING_1
CBUSH   6000000 6000000 1000031 1000021                         100
+       1.
$model.FIELD_2
CBUSH   6000001 6000001 1000031                                 0
$ --- relations ---
$model.JOINT_2
MPC     1       2       1       -.375   3       1       1.
+               3000004 0       -.071429
$model.JOINT_3
MPC     1       3       2       .33333332       2       -.333333
+               2       5       1.
$ --- fixed points ---
$model.JOINT_2
SPC     1       3       6       0.
$ --- initial conditions ---
$DIFF/4
TIC     2       3000004 0       2.      0.
$ --- matrix KVVV ---
$all forces
DMIG    KVVV    0       1       1       0
DMIG    KVVV    2       1               2       1       100.
+       3       1       -50.
DMIG    KVVV    3       1               2       1       -40.
+       3       1       45.33333
$ --- matrix BZZZ ---
$differential states
DMIG    BZZZ    0       6       1       0
DMIG    BZZZ    3000001 0               3000001 0       1.
DMIG    BZZZ    3000002 0               3000002 0       1.
DMIG    BZZZ    3000004 0               3000004 0       1.
