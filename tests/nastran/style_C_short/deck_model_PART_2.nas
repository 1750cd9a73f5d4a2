$ Linear model at time 0.5, OPENBOX
$ --- grid points ---
$centre of mass of model.PART_2
GRID    2               .3333333-2.5    0.
$model.PART_2.MARKER_21
GRID    1000021         0.      0.      1.      100
$ --- coordinate systems ---
$axes of model.PART_2.MARKER_21
CORD2R  100     0       0.      0.      1.      0.      0.      10001.
+       8.+3    6.+3    1.
$ --- masses ---
$model.PART_2
CONM2   1       2       0       12.5
+       4.      -.5     5.      .25     -.125   6.
$ --- rigid elements ---
$model.PART_2
RBE2    4       2       123456  1000021
$ --- initial conditions ---
$model.PART_2
TIC     2       2       1       0.      -1.5
