#!/usr/bin/env python3
"""The connecting rod as a mesh for CalculiX: 0.4 x 0.03 x 0.02 m of steel along x, 16 elements of 20 nodes, rigid ends.

Nodes 1001 and 1003 are the middles of the ends, where the pins are; 1002 and 1004 carry their rotations.
Units: metre, kilogram, newton, second.
"""
ELEMENTS, LENGTH, HEIGHT, WIDTH = 16, 0.4, 0.03, 0.02  # along x, z and y

number = {}
for i in range(2 * ELEMENTS + 1):
    for j in range(3):
        for k in range(3):
            if (i % 2) + (j % 2) + (k % 2) <= 1:  # corners and middles of edges
                number[i, j, k] = len(number) + 1

print("** Connecting rod between two pins; made by mesh.py")
print("*NODE, NSET=ALL")
for (i, j, k), n in number.items():
    print(f"{n}, {LENGTH * i / (2 * ELEMENTS):.9g}, {WIDTH * (j - 1) / 2:.9g}, {HEIGHT * (k - 1) / 2:.9g}")
for n, x in ((1001, 0), (1002, 0), (1003, LENGTH), (1004, LENGTH)):
    print(f"{n}, {x:.9g}, 0, 0")

# The corners of the lower and the upper face, then the edges between them: lower, upper, upright.
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
PLACES = CORNERS + [tuple((a + b) // 2 for a, b in zip(CORNERS[f], CORNERS[t])) for f, t in EDGES]
print("*ELEMENT, TYPE=C3D20, ELSET=ROD")
for e in range(ELEMENTS):
    nodes = [number[2 * e + i, j, k] for i, j, k in PLACES]
    print(f"{e + 1}, " + ", ".join(map(str, nodes[:15])) + ",\n" + ", ".join(map(str, nodes[15:])))

for name, end in (("CRANK_END", 0), ("SLIDER_END", 2 * ELEMENTS)):
    nodes = [n for (i, _, _), n in number.items() if i == end]
    print(f"*NSET, NSET={name}\n" + ", ".join(map(str, nodes)))
print("*RIGID BODY, NSET=CRANK_END, REF NODE=1001, ROT NODE=1002")
print("*RIGID BODY, NSET=SLIDER_END, REF NODE=1003, ROT NODE=1004")
print("*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n7800")
print("*SOLID SECTION, ELSET=ROD, MATERIAL=STEEL")
