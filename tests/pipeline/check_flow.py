"""Compare flow.h5 with the fields of the same instants: check_flow.py RUN. Prints how many were compared and the root mean
square of the difference at the fluid's nodes in the plane z = 0 off the swimmer, relative to the largest speed."""
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import numpy

from vtu import Mesh

run = sys.argv[1]
entries = ElementTree.parse(f"{run}/fields/fluid.pvd").getroot().findall("Collection/DataSet")
fluid_at = {round(float(entry.get("timestep")), 9): entry.get("file") for entry in entries}
differences, largest, n_compared = [], 0.0, 0
with h5py.File(f"{run}/flow.h5") as flow:
    for instant in flow["instants"].values():
        mesh = Mesh(f"{run}/fields/{fluid_at[round(float(instant.attrs['time_s']), 9)]}")
        points, velocities = numpy.array(mesh.points), numpy.array(mesh.fields["velocity_m_s"])
        x, y, u = instant["x_m"][:], instant["y_m"][:], instant["velocity_m_s"][:]
        u, part = u.reshape(len(y), len(x), -1), instant["part"][:].reshape(len(y), len(x))
        i = numpy.floor((points[:, 0] - x[0]) / (x[1] - x[0])).astype(int)
        j = numpy.floor((points[:, 1] - y[0]) / (y[1] - y[0])).astype(int)
        inside = (points[:, 2] == 0) & (i >= 0) & (j >= 0) & (i < len(x) - 1) & (j < len(y) - 1)
        points, velocities, i, j = points[inside], velocities[inside], i[inside], j[inside]
        s, t = (points[:, 0] - x[i]) / (x[1] - x[0]), (points[:, 1] - y[j]) / (y[1] - y[0])
        s, t = s[:, None], t[:, None]
        bilinear = ((1 - s) * (1 - t) * u[j, i] + s * (1 - t) * u[j, i + 1]
                    + (1 - s) * t * u[j + 1, i] + s * t * u[j + 1, i + 1])
        in_fluid = (part[j, i] * part[j, i + 1] * part[j + 1, i] * part[j + 1, i + 1]) == 1  # no kink between samples
        differences.append((bilinear - velocities[:, :u.shape[2]])[in_fluid])
        largest = max(largest, numpy.linalg.norm(velocities, axis=1).max())
        n_compared += 1
print(n_compared, numpy.sqrt((numpy.concatenate(differences) ** 2).sum(axis=1).mean()) / largest)
