"""Compare the field files of two runs: compare_fields.py FOLDER FOLDER. Same files, same points, fields within 1e-5."""
import os
import sys

from vtu import Mesh

folders = sys.argv[1:3]
names = [sorted(file for file in os.listdir(folder) if file.endswith(".vtu")) for folder in folders]
if names[0] != names[1]:
    sys.exit(f"the folders hold {names[0]} and {names[1]}")
for name in names[0]:
    one, two = (Mesh(f"{folder}/{name}") for folder in folders)
    if one.cells != two.cells:
        sys.exit(f"{name}: the cells differ")
    for what, a, b in [("points", one.points, two.points)] + [(f, one.fields[f], two.fields[f]) for f in one.fields]:
        scale = max(abs(v) for row in a for v in row)
        difference = max(abs(v - w) for p, q in zip(a, b, strict=True) for v, w in zip(p, q, strict=True))
        if difference > 1e-5 * scale:  # single precision, linear solver tolerance 1e-7
            sys.exit(f"{name}: {what} differ by {difference / scale:.1e} of their largest value")
print(len(names[0]))
