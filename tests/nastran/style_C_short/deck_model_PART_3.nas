$ Linear model at time 0.5, OPENBOX
$ --- grid points ---
$centre of mass of model.PART_3
GRID    3               1.-7    1250.   -.125
$model.PART_3.MARKER_31
GRID    1000031         0.      10.     0.
$nothing has this
GRID    1000099         7.      7.      7.
$ --- masses ---
$model.PART_3
CONM2   2       3       0       .001
$ --- rigid elements ---
$model.PART_3
RBE2    5       3       123456  1000031
$ --- fixed points ---
$model.PART_3
SPC     1       3       45      0.
$ --- grid points of graphics ---
$model.BOX_1
GRID    4000000         0.      0.      0.
GRID    4000001         1.      0.      0.
GRID    4000002         0.      1.      0.
GRID    4000003         1.      1.      0.
$ --- rigid elements ---
$model.BOX_1
RBE2    6       3       123456  4000000 4000001 4000002 4000003
$ --- graphics ---
$model.BOX_1
CQUAD4  7       1       4000000 4000001 4000003 4000002
$model.EXTERNAL_1
CTRIA3  8       1       4000000 4000001 4000002
$model.OUTLINE_1
PLOTEL  9       4000000 4000001
CROD    10      2       4000001 4000002
