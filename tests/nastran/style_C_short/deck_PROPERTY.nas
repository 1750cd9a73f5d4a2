$ Linear model at time 0.5, OPENBOX
$ --- properties of bushings ---
$model.BUSHING_1
PBUSH   6000000 K       1.+4    2.+4    3.+4    0.      0.      5.
+               B       10.     20.     30.     0.      0.      0.
$model.FIELD_2
PBUSH   6000001 K       0.      0.      0.      0.      0.      0.
$ --- properties of graphics ---
PSHELL  1       1000    .01
MAT1    1000    1.              .3
PROD    2       1000    1.-4
