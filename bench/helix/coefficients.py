#!/usr/bin/env python3
"""Thrust, torque and drag of a helix that turns about and moves along its axis, from `swimtwin resistance`.

    bench/helix/coefficients.py resistance.json [--radius R_m] [--viscosity eta] [--pitch P] [--length L_m]

The matrix is about the centre of the volume; the axis is a way off it (bench/helix/helix_surface.py).
"""
import argparse
import json
import math

# Rodenborn et al., PNAS 110 (2013), E338, as digitised by others: pitch in radii, thrust/(eta w R^2),
# torque/(eta w R^3), drag/(eta U R).
MEASURED = {2.226: (6.264, 131.93, 52.06), 3.677: (9.598, 100.80, 46.96), 6.509: (11.034, 81.93, 39.41),
            9.811: (9.569, 72.69, 35.29), 15.241: (7.845, 68.07, 34.12)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--radius", type=float, default=6.3e-3)
    parser.add_argument("--viscosity", type=float, default=1.0)
    parser.add_argument("--pitch", type=float, default=15.241)
    parser.add_argument("--length", type=float, default=130e-3)
    options = parser.parse_args()
    result = json.load(open(options.file, encoding="utf-8"))
    matrix, R, eta = result["matrix"], options.radius, options.viscosity

    half = math.pi * options.length / (options.pitch * R)  # half of the angle that the helix turns by
    offset = R * math.sin(half) / half  # of the centre from the axis, along y
    # Turning about the axis by one: the centre moves by (1, 0, 0) x (0, offset, 0) = (0, 0, offset).
    motion = (0, 0, offset, 1, 0, 0)
    load = [sum(row[j] * motion[j] for j in range(6)) for row in matrix]
    torque = load[3] + offset * load[2]  # (0, offset, 0) x force, along x
    ours = (abs(load[0]) / (eta * R**2), torque / (eta * R**3), matrix[0][0] / (eta * R))
    print("%d unknowns, asymmetry %.1e" % (result["n_unknowns"], result["asymmetry"]))
    theirs = MEASURED.get(options.pitch)
    for i, name in enumerate(("thrust/(eta w R^2)", "torque/(eta w R^3)", "drag/(eta U R)")):
        against = "   measured %8.3f   %+.1f %%" % (theirs[i], 100 * (ours[i] / theirs[i] - 1)) if theirs else ""
        print("%-20s %8.3f%s" % (name, ours[i], against))


if __name__ == "__main__":
    main()
