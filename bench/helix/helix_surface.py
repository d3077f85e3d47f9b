#!/usr/bin/env python3
"""Write the surface of a helical filament with rounded ends as curved triangles (.msh of gmsh, format 2.2, order 2).

    bench/helix/helix_surface.py FILE.msh [--pitch P] [--around N] [--stretch S]

Lengths are in helix radii times --radius. The helix winds about x, right-handed, and is its own image under a half turn
about y: the centre of its volume lies on the y axis (bench/helix/coefficients.py relies on it).
"""
import argparse
import math


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--radius", type=float, default=6.3, help="of the helix, to the middle of the filament")
    parser.add_argument("--filament", type=float, default=0.397, help="radius of the filament")
    parser.add_argument("--length", type=float, default=130.0, help="along the axis, of the middle of the filament")
    parser.add_argument("--pitch", type=float, default=15.241, help="in helix radii")
    parser.add_argument("--around", type=int, default=6, help="triangles around the filament")
    parser.add_argument("--stretch", type=float, default=2.0, help="length of triangles along the filament to their width")
    return parser.parse_args()


class Helix:
    def __init__(self, options):
        self.R, self.a = options.radius, options.filament
        self.pitch = options.pitch * options.radius
        self.turns = 2 * math.pi * options.length / self.pitch  # as an angle
        self.arc = self.turns * math.hypot(self.R, self.pitch / (2 * math.pi))

    def frame(self, s):
        """Point of the middle line at the arc length s from its middle, tangent, normal and binormal."""
        t = self.turns * s / self.arc
        rise = self.pitch / (2 * math.pi)
        length = math.hypot(self.R, rise)
        c, w = math.cos(t), math.sin(t)
        return ((rise * t, self.R * c, self.R * w), (rise / length, -self.R * w / length, self.R * c / length),
                (0.0, -c, -w), (self.R / length, rise * w / length, -rise * c / length))

    def point(self, u, phi):
        """On the surface; u runs along the filament, beyond both ends of the middle line as the angle on a cap."""
        s = min(max(u, -self.arc / 2), self.arc / 2)
        latitude = (u - s) / self.a
        x, tangent, normal, binormal = self.frame(s)
        r, along = self.a * math.cos(latitude), self.a * math.sin(latitude)
        return tuple(x[i] + along * tangent[i] + r * (math.cos(phi) * normal[i] + math.sin(phi) * binormal[i])
                     for i in range(3))


def triangles(helix, options):
    """Nodes, and triangles of six of them: vertices, then middles."""
    n = options.around
    step = options.stretch * 2 * helix.a * math.sin(math.pi / n)
    n_rings = max(2, round(helix.arc / step))
    cap = helix.a * math.pi / 4  # a ring half way up
    rings = [-helix.arc / 2 - cap] + [-helix.arc / 2 + helix.arc * i / n_rings for i in range(n_rings + 1)]
    rings.append(helix.arc / 2 + cap)
    nodes, number = [], {}

    def add(x):
        nodes.append(x)
        return len(nodes) - 1

    def angle(ring, k):
        return 2 * math.pi * (k + 0.5 * (ring % 2)) / n

    vertex = [[add(helix.point(u, angle(i, k))) for k in range(n)] for i, u in enumerate(rings)]
    place = {vertex[i][k]: (u, angle(i, k)) for i, u in enumerate(rings) for k in range(n)}
    poles = [add(helix.point(sign * (helix.arc / 2 + helix.a * math.pi / 2), 0.0)) for sign in (-1, 1)]

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in number:
            if b in poles:
                a, b = b, a
            if a in poles:
                u, phi = place[b]
                u = (u + (-1 if a == poles[0] else 1) * (helix.arc / 2 + helix.a * math.pi / 2)) / 2
            else:
                (u, phi), (v, psi) = place[a], place[b]
                psi = phi + (psi - phi + math.pi) % (2 * math.pi) - math.pi
                u, phi = (u + v) / 2, (phi + psi) / 2
            number[key] = add(helix.point(u, phi))
        return number[key]

    corners = []
    for i in range(len(rings) - 1):
        for k in range(n):
            a, b = vertex[i][k], vertex[i][(k + 1) % n]
            if i % 2 == 0:  # the next ring is half a step ahead
                c, d = vertex[i + 1][k], vertex[i + 1][(k + 1) % n]
                corners += [(a, c, b), (b, c, d)]
            else:
                c, d = vertex[i + 1][k], vertex[i + 1][(k + 1) % n]
                corners += [(a, d, b), (a, c, d)]
    for k in range(n):
        corners.append((poles[0], vertex[0][k], vertex[0][(k + 1) % n]))
        corners.append((poles[1], vertex[-1][(k + 1) % n], vertex[-1][k]))
    return nodes, [(a, b, c, middle(a, b), middle(b, c), middle(c, a)) for a, b, c in corners]


def write(file, nodes, faces):
    with open(file, "w", encoding="ascii") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n" % len(nodes))
        for i, x in enumerate(nodes):
            out.write("%d %.9g %.9g %.9g\n" % (i + 1, *x))
        out.write("$EndNodes\n$Elements\n%d\n" % len(faces))
        for i, face in enumerate(faces):
            out.write("%d 9 2 0 1 %s\n" % (i + 1, " ".join(str(a + 1) for a in face)))
        out.write("$EndElements\n")


def main():
    options = arguments()
    helix = Helix(options)
    nodes, faces = triangles(helix, options)
    write(options.file, nodes, faces)
    print("%s: %d triangles, filament of %.2f in %.3f turns" % (options.file, len(faces), helix.arc,
                                                               helix.turns / (2 * math.pi)))


if __name__ == "__main__":
    main()
