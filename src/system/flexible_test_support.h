// A flexible body for tests that is small enough to be written down.
#pragma once

#include <string>

namespace dynalin::system_test {

// MATRICES 1 to 13 of a FLEX_BODY: masses 1 and 2 on the x axis of the BCS, at 0 and 1. The mode moves the one of 1
// along z by −0.5 and the other by 0.5, and has inertia of its own within.
inline const std::string dumb_bell_matrices =
    "MATRIX/1, NAME=SELNOD, FULL=RORDER, ROWS=2, COLUMNS=4, VALUES=1,0,0,0, 2,1,0,0\n"
    "MATRIX/2, NAME=T_MODE, FULL=RORDER, ROWS=6, COLUMNS=1, VALUES=0,0,-0.5,0,0,0.5\n"
    "MATRIX/3, NAME=R_MODE, FULL=RORDER, ROWS=6, COLUMNS=1, VALUES=0,0,0,0,0,0\n"
    "MATRIX/4, NAME=GENSTIFF, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=800\n"
    "MATRIX/5, NAME=INVAR1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=3\n"
    "MATRIX/6, NAME=INVAR2, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=2,0,0\n"
    "MATRIX/7, NAME=INVAR3, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0.5\n"
    "MATRIX/8, NAME=INVAR4, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,-1,0\n"
    "MATRIX/9, NAME=INVAR5, FULL=RORDER, ROWS=3, COLUMNS=1, VALUES=0,0,0\n"
    "MATRIX/10, NAME=INVAR6, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=2\n"
    "MATRIX/11, NAME=INVAR7, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=0.1,0,0, 0,2,0, 0,0,2\n"
    "MATRIX/12, NAME=INVAR8, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=0,0,0, 0,0,0, 1,0,0\n"
    "MATRIX/13, NAME=INVAR9, FULL=RORDER, ROWS=3, COLUMNS=3, VALUES=-0.75,0,0, 0,-0.75,0, 0,0,0\n";

}  // namespace dynalin::system_test
