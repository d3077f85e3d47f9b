"""Check snapshots.h5 against trajectory.csv and the tail's area: check_snapshots.py FOLDER AREA_M2 N_SNAPSHOTS.

Exit code 77: h5py is not there.
"""
import csv
import math
import sys

try:
    import h5py
except ImportError:
    sys.exit(77)

folder, area, n_snapshots = sys.argv[1], float(sys.argv[2]), int(sys.argv[3])
SHAPES = {
    "tail/nodes_m": ("m", lambda n, m: (n, 2)),
    "tail/cells": ("1", None),
    "tail/clamped_nodes": ("1", None),
    "tail/mass/row_starts": ("1", lambda n, m: (2 * n + 1,)),
    "tail/mass/columns": ("1", None),
    "tail/mass/values": ("m^2", None),
    "snapshots/time_s": ("s", lambda n, m: (m,)),
    "snapshots/displacement_m": ("m", lambda n, m: (m, 2 * n)),
    "snapshots/velocity_m_s": ("m/s", lambda n, m: (m, 2 * n)),
    "snapshots/pose": ("m, m, rad", lambda n, m: (m, 3)),
    "snapshots/field_T": ("T", lambda n, m: (m, 3)),
}


def near(value, reference, tolerance, what):
    if not abs(value - reference) <= tolerance:
        sys.exit(f"{what}: {value} instead of {reference}, tolerance {tolerance}")


with h5py.File(f"{folder}/snapshots.h5") as file:
    nodes = file["tail/nodes_m"][:].tolist()
    n = len(nodes)
    for name, (units, shape) in SHAPES.items():
        data = file[name]
        text = data.attrs["units"]
        text = text.decode() if isinstance(text, bytes) else str(text)
        if text != units or not len(data.attrs["description"]):
            sys.exit(f"{name} has units {text!r} instead of {units!r}, or no description")
        if shape and data.shape != shape(n, n_snapshots):
            sys.exit(f"{name} has the shape {data.shape} instead of {shape(n, n_snapshots)}")
    for key in ("program_version", "command_line", "scene_text", "scene_hash", "created", "wall_time_s"):
        if key not in file.attrs:
            sys.exit(f"the root has no attribute {key}")

    # The shape functions sum to one: ones in both components give twice the area.
    near(math.fsum(file["tail/mass/values"][:].tolist()), 2 * area, 2 * area * 1e-10, "sum of the mass matrix")

    displacement = file["snapshots/displacement_m"][:].tolist()
    clamped = file["tail/clamped_nodes"][:].tolist()
    if not clamped or any(row[2 * a + i] for row in displacement for a in clamped for i in (0, 1)):
        sys.exit("a clamped node moves, or there is none")

    times, poses = file["snapshots/time_s"][:].tolist(), file["snapshots/pose"][:].tolist()
    velocity = file["snapshots/velocity_m_s"][:].tolist()

if any(not math.isfinite(v) for row in displacement + velocity + poses for v in row):
    sys.exit("a value is not finite")

# The tip: the node on the axis that lies farthest from the head.
tip = max(range(n), key=lambda a: nodes[a][0] - abs(nodes[a][1]))
with open(f"{folder}/trajectory.csv", encoding="utf-8") as file:
    rows = {round(float(row["time_s"]), 9): row for row in csv.DictReader(file)}
for time, (x, y, angle), d in zip(times, poses, displacement):
    row = rows[round(time, 9)]
    u, v = nodes[tip][0] + d[2 * tip], nodes[tip][1] + d[2 * tip + 1]
    c, s = math.cos(angle), math.sin(angle)
    for name, value in (("head_x_m", x), ("head_y_m", y), ("head_angle_rad", angle),
                        ("tail_tip_x_m", x + c * u - s * v), ("tail_tip_y_m", y + s * u + c * v)):
        near(value, float(row[name]), 1e-14, f"{name} at {time} s")
