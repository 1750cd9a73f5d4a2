#!/usr/bin/env python3
"""The chains of hanging_chain.h by SciPy, as a yardstick: optional, with Debian's python3-scipy.

    /usr/bin/python3 bench/yardstick_chain.py chain 20000 10
    /usr/bin/python3 bench/yardstick_chain.py damped 20000 10

Displacements u of the lower ends of all rods, which a specialist would choose by hand: tridiagonal mass, pentadiagonal
stiffness, written down and not found from a dataset, and ARPACK with shift-invert at zero. No error bounds, no count of
modes, no mode shapes in space. Prints the time from the numbers to the values, and the memory it has taken.
"""
import resource
import sys
import time

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as la


def matrices(n, length, mass, bending, damping):
    """M, C, K of rods that turn by (u_k - u_{k-1})/l, the tension of the weight below along each."""
    l, m = length / n, mass / n
    turn = sp.diags([np.ones(n), -np.ones(n - 1)], [0, -1]) / l
    mean = sp.diags([np.full(n, 0.5), np.full(n - 1, 0.5)], [0, -1])
    relative = sp.diags([np.ones(n), -np.ones(n - 1)], [0, -1]) @ turn
    weight = 9.81 * m * l * (n - np.arange(1, n + 1) + 0.5)
    M = m * mean.T @ mean + m * l * l / 12 * turn.T @ turn
    spring = bending / l * relative.T @ relative
    return M.tocsc(), (damping * spring).tocsc(), (turn.T @ sp.diags(weight) @ turn + spring).tocsc()


def main():
    kind, n, modes = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    start = time.process_time()
    if kind == "chain":
        M, _, K = matrices(n, 1, 1, 0, 0)
        squares = la.eigsh(K, modes, M, sigma=0, return_eigenvectors=False)
        values = 1j * np.sqrt(np.sort(squares))
    else:
        M, C, K = matrices(n, 10, 10, 1, 1e-3)
        one = sp.identity(n, format="csc")
        A, E = sp.bmat([[None, one], [-K, -C]], format="csc"), sp.block_diag([one, M], format="csc")
        values = la.eigs(A, 2 * modes, E, sigma=0, return_eigenvectors=False)
        values = sorted(values[values.imag > 0], key=abs)
    taken = time.process_time() - start
    for v in values:
        print(f"{v.real / (2 * np.pi):.15g} {v.imag / (2 * np.pi):+.15g}i Hz")
    print(f"{taken:.2f} s, {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB")


main()
