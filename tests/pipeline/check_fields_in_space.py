"""Check the field files of a run in space: check_fields_in_space.py RUN HEAD_BACK_X_M. Quadratic, finite and complete; at
no-slip walls (y and z at the box's ends) the fluid rests, at the head it moves as a rigid body that turns as the run says."""
import csv
import os
import sys
import xml.etree.ElementTree as ElementTree

import numpy

from vtu import QUADRATIC_TETRAHEDRA, QUADRATIC_TRIANGLES, Mesh

run, head_back_x = sys.argv[1], float(sys.argv[2])
fields = f"{run}/fields"
KINDS = {"fluid": (QUADRATIC_TETRAHEDRA, 10, {"velocity_m_s": 3, "pressure_Pa": 1}),
         "tail": (QUADRATIC_TETRAHEDRA, 10, {"displacement_m": 3}),
         "body": (QUADRATIC_TRIANGLES, 6, {"displacement_m": 3})}
EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]  # of the nodes behind the vertices, as VTK wants them
FLOAT32 = 1e-6  # relative: numbers are written with seven digits


def files_of(name):
    entries = ElementTree.parse(f"{fields}/{name}.pvd").getroot().findall("Collection/DataSet")
    listed = [entry.get("file") for entry in entries]
    there = sorted(file for file in os.listdir(fields) if file.startswith(name) and file.endswith(".vtu"))
    if sorted(listed) != there:
        sys.exit(f"{name}.pvd names {listed}, but there are {there}")
    return listed


last = {}
for name, (types, n_nodes, arrays) in KINDS.items():
    n_vertices = 4 if n_nodes == 10 else 3
    for file in files_of(name):
        mesh = last[name] = Mesh(f"{fields}/{file}")
        if not set(mesh.types) <= types or any(len(cell) != n_nodes for cell in mesh.cells):
            sys.exit(f"{file} has other cells than quadratic ones with {n_nodes} nodes")
        if not all(0 <= node < len(mesh.points) for cell in mesh.cells for node in cell):
            sys.exit(f"{file} has a cell with a node that is not there")
        place = numpy.array(mesh.points)[numpy.array(mesh.cells)]
        for node, (a, b) in enumerate(EDGES[:n_nodes - n_vertices], n_vertices):
            off = numpy.linalg.norm(place[:, node] - (place[:, a] + place[:, b]) / 2, axis=1)
            if (off > 0.3 * numpy.linalg.norm(place[:, b] - place[:, a], axis=1)).any():
                sys.exit(f"{file} has node {node} of a cell far from the middle of its edge")
        for field, width in arrays.items():
            if numpy.shape(mesh.fields[field]) != (len(mesh.points), width):
                sys.exit(f"{file}: {field} is not one value of {width} numbers per point")
        if not all(numpy.isfinite(rows).all() for rows in (mesh.points, *mesh.fields.values())):
            sys.exit(f"{file} has a value that is not finite")

with open(f"{fields}/view.py", encoding="utf-8") as script:
    compile(script.read(), "view.py", "exec")

x, u = numpy.array(last["fluid"].points), numpy.array(last["fluid"].fields["velocity_m_s"])
largest = numpy.abs(u).max()
for axis in (1, 2):
    for end in (x[:, axis].min(), x[:, axis].max()):
        wall = numpy.abs(x[:, axis] - end) < FLOAT32 * numpy.ptp(x[:, axis])
        if wall.sum() < 6 or numpy.abs(u[wall]).max() > FLOAT32 * largest:
            sys.exit(f"velocity {numpy.abs(u[wall]).max()} m/s at the wall {'xyz'[axis]} = {end}")

body = numpy.array(last["body"].points)
at_rest = body - numpy.array(last["body"].fields["displacement_m"])
# From the head's front, whose edge a tail does not touch, to short of its root.
head = body[at_rest[:, 0] < head_back_x - 1e-6]
iterate = 1e-3 * numpy.ptp(body[:, 0])  # the fluid's mesh is where the step's last iteration began, the body where it ended
at_head = numpy.zeros(len(x), dtype=bool)
for point in head:
    at_head |= ((x - point) ** 2).sum(axis=1) < iterate ** 2
if at_head.sum() < 20:
    sys.exit(f"only {at_head.sum()} nodes of the fluid are on the head")
r, v = x[at_head], u[at_head]
zero, one = numpy.zeros(len(r)), numpy.ones(len(r))
# v = U + omega x r, unknowns (U, omega)
rows = numpy.concatenate([numpy.stack([one, zero, zero, zero, r[:, 2], -r[:, 1]], 1),
                          numpy.stack([zero, one, zero, -r[:, 2], zero, r[:, 0]], 1),
                          numpy.stack([zero, zero, one, r[:, 1], -r[:, 0], zero], 1)])
motion = numpy.linalg.lstsq(rows, v.T.reshape(-1), rcond=None)[0]
misfit = numpy.abs(rows @ motion - v.T.reshape(-1)).max()
if misfit > 10 * FLOAT32 * largest:
    sys.exit(f"the head's surface is {misfit} m/s off a rigid motion")

with open(f"{run}/trajectory.csv", encoding="utf-8") as table:
    angle = [(float(row["time_s"]), float(row["head_angle_rad"])) for row in csv.DictReader(table)][-3:]
step = angle[2][0] - angle[1][0]
omega = (1.5 * angle[2][1] - 2 * angle[1][1] + 0.5 * angle[0][1]) / step  # BDF2, as the run steps
if abs(motion[5] - omega) > 1e-4 * abs(omega):
    sys.exit(f"the head's surface turns at {motion[5]} rad/s, the head at {omega}")
print(len(files_of("body")), len(files_of("tail")), len(files_of("fluid")))
