"""Check the field files of a run: check_fields.py FOLDER END_TIME_S. Whole, quadratic, finite, and up to the end."""
import math
import os
import sys
import xml.etree.ElementTree as ElementTree

from vtu import QUADRATIC_TRIANGLES, Mesh

folder, end_time = sys.argv[1], float(sys.argv[2])
FIELDS = {"fluid": {"velocity_m_s": 3, "pressure_Pa": 1}, "tail": {"displacement_m": 3}}

for name, fields in FIELDS.items():
    entries = ElementTree.parse(f"{folder}/{name}.pvd").getroot().findall("Collection/DataSet")
    times = [float(entry.get("timestep")) for entry in entries]
    if len(times) < 2 or times != sorted(set(times)) or abs(times[-1] - end_time) > 1e-9:
        sys.exit(f"{name}.pvd has the times {times}, which do not lead to {end_time}")
    listed = [entry.get("file") for entry in entries]
    there = sorted(file for file in os.listdir(folder) if file.startswith(name) and file.endswith(".vtu"))
    if sorted(listed) != there:
        sys.exit(f"{name}.pvd names {listed}, but there are {there}")
    for file in listed:
        mesh = Mesh(f"{folder}/{file}")
        if not set(mesh.types) <= QUADRATIC_TRIANGLES or any(len(cell) != 6 for cell in mesh.cells):
            sys.exit(f"{file} has other cells than quadratic triangles")
        for field, width in fields.items():
            if len(mesh.fields[field]) != len(mesh.points) or len(mesh.fields[field][0]) != width:
                sys.exit(f"{file}: {field} is not one value of {width} numbers per point")
        if any(not math.isfinite(v) for rows in (mesh.points, *mesh.fields.values()) for row in rows for v in row):
            sys.exit(f"{file} has a value that is not finite")
        if any(not 0 <= node < len(mesh.points) for cell in mesh.cells for node in cell):
            sys.exit(f"{file} has a cell with a node that is not there")
print(" ".join(str(time) for time in times))
